//! Pages in a real browser, by the [DevTools protocol](https://chromedevtools.github.io/devtools-protocol/).
//!
//! Needs a Chromium on the machine. If `JOSTLE_SKIP_BROWSER` is set, [`open_page`] and [`open_address`] return `None`, and
//! the test is left out. All tests of a process share one Chromium. Pages that are open at the same time have contexts of their
//! own: they share no storage and do not see each other.

mod connection;
mod page;
mod process;

pub use page::{Mouse, Page};
pub use process::Browser;

use std::sync::OnceLock;

/// The browser that all tests of this process share. It ends with the process.
static SHARED: OnceLock<Browser> = OnceLock::new();

/// Whether tests that need a browser are left out.
#[must_use]
pub fn skipped() -> bool {
    std::env::var_os("JOSTLE_SKIP_BROWSER").is_some()
}

/// Opens the text of a page, from a file, in a window of this size \[px\]; `None` if browser tests are left out.
#[must_use]
pub fn open_page(text: &str, width: u32, height: u32) -> Option<Page> {
    (!skipped()).then(|| {
        SHARED
            .get_or_init(Browser::start)
            .open_page(text, width, height)
    })
}

/// Opens an address in a window of this size \[px\]; `None` if browser tests are left out.
#[must_use]
pub fn open_address(address: &str, width: u32, height: u32) -> Option<Page> {
    (!skipped()).then(|| {
        SHARED
            .get_or_init(Browser::start)
            .open(address, width, height)
    })
}
