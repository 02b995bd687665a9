//! Pages: what their text promises, and what they show in a browser.

#![allow(
    clippy::unwrap_used,
    reason = "a test stops at the first surprise, helpers included"
)]

mod browser;
mod fixture;
mod messages;
mod page;
mod pushover;
mod sources;
mod space;
mod study;
mod units;
