//! Progress of a run on a terminal.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};
use jostle_run::Stage;

use crate::terminal;

/// Shortest duration with a progress bar.
const PATIENCE: Duration = Duration::from_millis(500);
/// Time between lines where no terminal shows a bar.
const SILENCE: Duration = Duration::from_secs(30);
/// Environment variable that disables both, with the value `off`.
const SWITCH: &str = "JOSTLE_PROGRESS";

/// How far work has come and how long it takes: a bar on a terminal, after a while; elsewhere a line now and then.
pub(crate) struct Bar {
    bar: ProgressBar,
    state: Mutex<State>,
}

struct State {
    /// What is worked on.
    what: String,
    started: Instant,
    /// Whether a person watches, or a log may get lines.
    is_watched: bool,
    tells: bool,
    shown: bool,
    told: Instant,
    /// Share at which this work began, and when \[–\].
    first: Option<(f64, Instant)>,
}

impl Bar {
    /// A bar with a text before it.
    pub(crate) fn new(what: &str) -> Self {
        let bar = ProgressBar::with_draw_target(Some(1000), ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template("{prefix}{wide_bar} {percent:>3} %  {msg}")
        {
            bar.set_style(style);
        }
        let is_off = std::env::var_os(SWITCH).is_some_and(|value| value == "off");
        let is_watched = terminal::is_watched() && !is_off;
        let state = State {
            what: String::new(),
            started: Instant::now(),
            is_watched,
            tells: !is_watched && !is_off,
            shown: false,
            told: Instant::now(),
            first: None,
        };
        let bar = Self {
            bar,
            state: Mutex::new(state),
        };
        bar.restart(what);
        bar
    }

    /// Begins with other work; the bar stays where it is.
    pub(crate) fn restart(&self, what: &str) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        what.clone_into(&mut state.what);
        state.first = None;
        self.bar.reset();
        let gap = if what.is_empty() { "" } else { " " };
        self.bar.set_prefix(format!("{what}{gap}"));
    }

    /// Shows the share that is done, 0 to 1, and how far that is in words.
    pub(crate) fn show(&self, share: f64, reached: impl FnOnce() -> String) {
        self.show_with(share, true, reached);
    }

    /// The same where more work may turn out to be needed: no remaining time is shown.
    pub(crate) fn show_open(&self, share: f64, reached: impl FnOnce() -> String) {
        self.show_with(share, false, reached);
    }

    fn show_with(&self, share: f64, knows_end: bool, reached: impl FnOnce() -> String) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let now = Instant::now();
        let (first, began) = *state.first.get_or_insert((share, now));
        if state.is_watched && !state.shown && now - state.started > PATIENCE {
            let target = ProgressDrawTarget::stderr_with_hz(5);
            self.bar.set_draw_target(target);
            state.shown = true;
        }
        let is_due = state.tells && now - state.told > SILENCE;
        if !state.shown && !is_due {
            return;
        }
        let mut text = reached();
        let rate = (share - first) / (now - began).as_secs_f64().max(1e-3);
        if knows_end && rate > 0.0 {
            let left = Duration::from_secs_f64(((1.0 - share).max(0.0) / rate).min(1e9));
            text += &format!(", {} left", HumanDuration(left));
        }
        if is_due {
            state.told = now;
            let colon = if state.what.is_empty() { "" } else { ": " };
            terminal::remark(&format!("{}{colon}{text}", state.what));
        } else {
            self.bar.set_position((1000.0 * share) as u64);
            self.bar.set_message(text);
        }
    }

    /// Shows the time reached, and the time to reach \[s\].
    pub(crate) fn show_time(&self, time: f64, duration: f64) {
        self.show(time / duration, || format!("{time:.1} of {duration:.1} s"));
    }

    /// Shows how many of how many are done.
    pub(crate) fn show_count(&self, done: usize, of: usize, things: &str) {
        let share = done as f64 / of.max(1) as f64;
        self.show(share, || format!("{done} of {of} {things}"));
    }

    /// Prints a remark above the bar.
    pub(crate) fn remark(&self, text: &str) {
        self.bar.suspend(|| terminal::remark(text));
    }

    /// Removes the bar from the terminal.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// A bar for each stage of a run in turn.
#[derive(Default)]
pub(crate) struct StageBar(Option<(Stage, Bar)>);

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
            self.0 = Some((stage, Bar::new(prefix)));
        }
        if let Some((_, bar)) = &self.0 {
            bar.show_time(time, duration);
        }
    }

    /// Removes the bar from the terminal.
    pub(crate) fn finish(&mut self) {
        if let Some((_, bar)) = self.0.take() {
            bar.finish();
        }
    }
}
