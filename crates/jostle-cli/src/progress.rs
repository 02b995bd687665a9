//! Progress of a run on a terminal.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use jostle_run::Stage;

use crate::terminal;

/// Shortest duration with a progress bar.
const PATIENCE: Duration = Duration::from_millis(500);

/// A bar over the time of a run, which appears only on a terminal and only after a while.
pub(crate) struct TimeBar {
    bar: ProgressBar,
    started: Instant,
    shown: bool,
}

impl TimeBar {
    /// A bar with a text before it.
    pub(crate) fn new(prefix: &str) -> Self {
        let bar = ProgressBar::with_draw_target(Some(1000), ProgressDrawTarget::hidden());
        let template = "{prefix} {wide_bar} {percent:>3} %  {msg}  {eta} left";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        bar.set_prefix(prefix.to_owned());
        Self {
            bar,
            started: Instant::now(),
            shown: false,
        }
    }

    /// Begins with another run under another text; the bar stays where it is.
    pub(crate) fn restart(&self, prefix: &str) {
        self.bar.reset();
        self.bar.set_prefix(prefix.to_owned());
    }

    /// Shows the time reached, and the time to reach \[s\].
    pub(crate) fn show(&mut self, time: f64, duration: f64) {
        if !self.shown && terminal::is_watched() && self.started.elapsed() > PATIENCE {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
            self.shown = true;
        }
        if self.shown {
            self.bar.set_position((1000.0 * time / duration) as u64);
            self.bar
                .set_message(format!("{time:.1} of {duration:.1} s"));
        }
    }

    /// Removes the bar from the terminal.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// A bar over a count of things, which appears only on a terminal and only after a while.
pub(crate) struct CountBar {
    bar: ProgressBar,
    started: Instant,
    shown: AtomicBool,
}

impl CountBar {
    /// A bar with what is counted, such as `pairs`.
    pub(crate) fn new(things: &str) -> Self {
        let bar = ProgressBar::with_draw_target(Some(1), ProgressDrawTarget::hidden());
        let template = format!(
            "{{wide_bar}} {{percent:>3}} %  {{human_pos}} of {{human_len}} {things}  {{eta}} left"
        );
        if let Ok(style) = ProgressStyle::with_template(&template) {
            bar.set_style(style);
        }
        Self {
            bar,
            started: Instant::now(),
            shown: AtomicBool::new(false),
        }
    }

    /// Shows how many of how many are done.
    pub(crate) fn show(&self, done: usize, of: usize) {
        let due = terminal::is_watched() && self.started.elapsed() > PATIENCE;
        if due && !self.shown.swap(true, Ordering::Relaxed) {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        if self.shown.load(Ordering::Relaxed) {
            self.bar.set_length(of as u64);
            self.bar.set_position(done as u64);
        }
    }

    /// Removes the bar from the terminal.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// A bar for each stage of a run in turn.
#[derive(Default)]
pub(crate) struct StageBar(Option<(Stage, TimeBar)>);

impl StageBar {
    /// Shows the time reached, and the time to reach \[s\].
    pub(crate) fn show(&mut self, stage: Stage, time: f64, duration: f64) {
        if self.0.as_ref().is_none_or(|(shown, _)| *shown != stage) {
            self.finish();
            let prefix = match stage {
                Stage::Pounding => "pounding       ",
                Stage::Sensitivity => "sensitivity    ",
                Stage::WithoutContact => "without contact",
                Stage::ContactSensitivity => "other contacts",
                Stage::IsolationBounds => "bearing bounds ",
            };
            self.0 = Some((stage, TimeBar::new(prefix)));
        }
        if let Some((_, bar)) = &mut self.0 {
            bar.show(time, duration);
        }
    }

    /// Removes the bar from the terminal.
    pub(crate) fn finish(&mut self) {
        if let Some((_, bar)) = self.0.take() {
            bar.finish();
        }
    }
}
