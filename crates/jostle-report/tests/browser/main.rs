//! The pages in a real browser: they play, scrub, zoom, turn dark, fit a phone, and never complain.
//!
//! Needs a chromium on the machine; set `JOSTLE_SKIP_BROWSER` to do without.

#![allow(
    clippy::unwrap_used,
    reason = "a test stops at the first surprise, helpers included"
)]

#[path = "../fixture/mod.rs"]
mod fixture;

mod colours;
mod motion_pages;
mod opened;
mod other_pages;
mod run_page;
mod space_page;
