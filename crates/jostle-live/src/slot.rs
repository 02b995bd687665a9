//! The latest of several jobs: a new job replaces the waiting one and cancels the running one.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Condvar, Mutex, PoisonError};

/// Holds at most one job.
#[derive(Debug)]
pub(crate) struct Slot<T> {
    job: Mutex<Option<T>>,
    ready: Condvar,
    /// Number of the latest job.
    latest: AtomicU64,
    closed: AtomicBool,
}

impl<T> Slot<T> {
    pub(crate) fn new() -> Self {
        Self {
            job: Mutex::new(None),
            ready: Condvar::new(),
            latest: AtomicU64::new(0),
            closed: AtomicBool::new(false),
        }
    }

    /// Puts a job in; the one before is stale from now on.
    pub(crate) fn put(&self, job: T) {
        self.replace(Some(job));
    }

    /// Makes the present job stale without a new one.
    pub(crate) fn cancel(&self) {
        self.replace(None);
    }

    fn replace(&self, job: Option<T>) {
        let mut held = self.job.lock().unwrap_or_else(PoisonError::into_inner);
        self.latest.fetch_add(1, Ordering::Relaxed);
        *held = job;
        self.ready.notify_all();
    }

    /// Waits for a job; `None` once the slot is closed.
    pub(crate) fn take(&self) -> Option<(T, u64)> {
        let mut held = self.job.lock().unwrap_or_else(PoisonError::into_inner);
        loop {
            if self.closed.load(Ordering::Relaxed) {
                return None;
            }
            if let Some(job) = held.take() {
                return Some((job, self.latest.load(Ordering::Relaxed)));
            }
            held = self
                .ready
                .wait(held)
                .unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Whether a job has been replaced or cancelled.
    pub(crate) fn is_stale(&self, number: u64) -> bool {
        self.closed.load(Ordering::Relaxed) || self.latest.load(Ordering::Relaxed) != number
    }

    /// Ends the waiting and the running job.
    pub(crate) fn close(&self) {
        self.closed.store(true, Ordering::Relaxed);
        self.cancel();
    }
}
