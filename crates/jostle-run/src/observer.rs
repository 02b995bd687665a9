//! How a run reports its progress and is stopped.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

use jostle::stepping::Progress;

/// Which of its runs a model is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// The run with contact.
    Pounding,
    /// The run with gaps a little changed, which shows whether results are sensitive.
    Sensitivity,
    /// The run in which the buildings pass through each other.
    WithoutContact,
    /// A run with another contact stiffness or restitution.
    ContactSensitivity,
    /// A run at a bound of the properties of bearings.
    IsolationBounds,
}

/// Called with the stage, the time reached and the time to reach; stops the run with `ControlFlow::Break`.
pub type Observer<'a> = dyn FnMut(Stage, Progress) -> ControlFlow<()> + 'a;

/// An observer that reports progress and stops once the flag is set.
pub fn stopped_by<'a>(
    flag: &'a AtomicBool,
    mut report: impl FnMut(Stage, Progress) + 'a,
) -> impl FnMut(Stage, Progress) -> ControlFlow<()> + 'a {
    move |stage, progress| {
        report(stage, progress);
        if flag.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}
