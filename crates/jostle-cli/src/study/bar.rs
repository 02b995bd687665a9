//! Progress of a study, with rate and time left.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use jostle_study::Progress;

use crate::terminal;

/// Studies shorter than this need no progress bar.
const PATIENCE: Duration = Duration::from_millis(500);

/// A bar that a terminal shows if the study takes some time.
pub(super) struct Bar {
    bar: ProgressBar,
    started: Instant,
    shown: AtomicBool,
}

impl Bar {
    pub(super) fn new() -> Self {
        let bar = ProgressBar::with_draw_target(Some(1), ProgressDrawTarget::hidden());
        let template = "{bar:36} {human_pos} of {human_len} cases  {msg}";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        Self {
            bar,
            started: Instant::now(),
            shown: AtomicBool::new(false),
        }
    }

    pub(super) fn show(&self, progress: Progress) {
        if !self.shown.load(Ordering::Relaxed) {
            if !terminal::is_watched() || self.started.elapsed() < PATIENCE {
                return;
            }
            if !self.shown.swap(true, Ordering::Relaxed) {
                self.bar
                    .set_draw_target(ProgressDrawTarget::stderr_with_hz(4));
            }
        }
        // Cases of earlier runs do not count for the rate.
        let rate = progress.computed as f64 / self.started.elapsed().as_secs_f64().max(1e-3);
        let left = progress.cases.saturating_sub(progress.finished) as f64;
        self.bar.set_length(progress.cases);
        self.bar.set_position(progress.finished);
        if rate > 0.0 {
            let seconds = (left / rate).min(1e9);
            self.bar.set_message(format!(
                "{rate:.1} per second, {} left",
                indicatif::HumanDuration(Duration::from_secs_f64(seconds))
            ));
        }
    }

    /// Prints a remark above the bar.
    pub(super) fn remark(&self, text: &str) {
        self.bar.suspend(|| terminal::remark(text));
    }

    pub(super) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}
