//! The live page in a real browser; what its server refuses.

#![allow(
    clippy::unwrap_used,
    reason = "a test stops at the first surprise, helpers included"
)]

mod browser;
mod safety;
mod scan;
