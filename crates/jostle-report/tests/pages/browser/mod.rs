//! The pages in a real browser: they play, scrub, zoom, turn dark, fit a phone, and never complain.
//!
//! Needs a chromium on the machine; set `JOSTLE_SKIP_BROWSER` to do without.

mod colours;
mod motion_pages;
pub(crate) mod opened;
mod other_pages;
mod run_page;
mod space_page;
