//! The pages in a real browser: they play, scrub, zoom, turn dark, fit a phone, and never complain.
//!
//! Needs a chromium on the machine; set `JOSTLE_SKIP_BROWSER` to do without.

mod colours;
mod motion_pages;
mod other_pages;
mod pushover_page;
mod run_page;
mod space_page;

use std::sync::LazyLock;

use jostle_report::render;
use jostle_testkit::browser::{Page, open_page};

use crate::fixture::{Run, alone, in_space, row_of_three, two_frames, yielding};

/// A run and the text of its page, which takes long to write without optimisation.
struct Shown {
    run: Run,
    text: String,
}

impl Shown {
    fn new(run: Run) -> Self {
        let text = render(&run.page());
        Self { run, text }
    }

    fn open(&self, width: u32, height: u32) -> Option<Page> {
        open_page(&self.text, width, height)
    }
}

// Written once for all tests that open them.
static TWO_FRAMES: LazyLock<Shown> = LazyLock::new(|| Shown::new(two_frames(0.1)));
static ALONE: LazyLock<Shown> = LazyLock::new(|| Shown::new(alone()));
static ROW_OF_THREE: LazyLock<Shown> = LazyLock::new(|| Shown::new(row_of_three()));
static YIELDING: LazyLock<Shown> = LazyLock::new(|| Shown::new(yielding()));
static IN_SPACE: LazyLock<Shown> = LazyLock::new(|| Shown::new(in_space()));
