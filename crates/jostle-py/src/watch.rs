//! Long work beside Python: without its lock, with Ctrl-C and reports of progress.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use pyo3::prelude::*;

use crate::error::AnalysisError;

/// Interval at which Ctrl-C and progress are looked for.
const LOOK_UP: Duration = Duration::from_millis(50);

/// What work asks and tells while it runs.
pub(crate) struct Watch<'w> {
    halt: &'w AtomicBool,
    latest: &'w Mutex<Option<[f64; 2]>>,
}

impl Watch<'_> {
    /// Whether to stop.
    pub(crate) fn stops(&self) -> bool {
        self.halt.load(Ordering::Relaxed)
    }

    /// Tells how much of how much is done.
    pub(crate) fn note(&self, done: f64, of: f64) {
        *self.latest.lock().unwrap_or_else(PoisonError::into_inner) = Some([done, of]);
    }
}

/// Does work in a thread of its own. Ctrl-C and what the observer raises stop it.
///
/// # Errors
/// What stopped it.
pub(crate) fn watched<T: Send>(
    py: Python<'_>,
    observer: Option<&Py<PyAny>>,
    work: impl FnOnce(&Watch<'_>) -> T + Send,
) -> PyResult<T> {
    let halt = AtomicBool::new(false);
    let latest: Mutex<Option<[f64; 2]>> = Mutex::new(None);
    let mut stopped: Option<PyErr> = None;
    let done = py.detach(|| {
        std::thread::scope(|scope| {
            let watch = Watch {
                halt: &halt,
                latest: &latest,
            };
            let work = scope.spawn(move || work(&watch));
            // Signals reach Python in its own thread only.
            while !work.is_finished() {
                std::thread::sleep(if stopped.is_some() {
                    LOOK_UP / 10
                } else {
                    LOOK_UP
                });
                if stopped.is_some() {
                    continue;
                }
                let progress = *latest.lock().unwrap_or_else(PoisonError::into_inner);
                let heeded = Python::attach(|py| {
                    py.check_signals()?;
                    if let (Some(observer), Some([done, of])) = (observer, progress) {
                        observer.call1(py, (done, of))?;
                    }
                    Ok(())
                });
                if let Err(error) = heeded {
                    stopped = Some(error);
                    halt.store(true, Ordering::Relaxed);
                }
            }
            work.join()
        })
    });
    match stopped {
        Some(error) => Err(error),
        None => done.map_err(|_| AnalysisError::new_err("the program failed inside")),
    }
}
