//! Runs the records of a suite on all cores; finished records are never run again.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use jostle::{RunEnd, StepError};
use jostle_io::{summary_json, write_atomically};
use jostle_run::{Content, FileKind, RunError, Stage, earlier_files, may_write};

use super::fingerprint::{FINISHED, fingerprint, finished, finished_text};
use super::results::{RecordResult, RecordStatus, SuiteResults};
use super::{Suite, SuiteRecord};
use crate::study::StudyError;

/// What is made of every record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SuiteOptions {
    /// A report and the run without contact.
    pub report: bool,
    /// Runs with other contact stiffnesses and restitutions.
    pub sensitivity: bool,
    /// Threads; `None` is one for every core.
    pub jobs: Option<usize>,
}

/// How far a suite has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SuiteProgress {
    /// Records that are finished, those of earlier runs included.
    pub finished: usize,
    /// Records.
    pub records: usize,
    /// Part of the work that is done, 0 to 1 \[–\].
    pub share: f64,
}

/// Results of a run of a suite.
#[derive(Debug)]
pub struct SuiteDone {
    /// All results; `None` if it was stopped before the last record.
    pub results: Option<SuiteResults>,
    /// Records that were finished already.
    pub kept: usize,
    /// Records that are finished now.
    pub finished: usize,
}

/// Kinds of the files of a suite beside the folders of its records.
const SUITE: FileKind = FileKind {
    name: "suite of jostle",
    marks: &["\"title\":", "\"jostle\":", "\"governing\":"],
};
const PAGE: FileKind = FileKind {
    name: "page of a suite",
    marks: &["<html", " – suite</title>"],
};
const FINISHED_KIND: FileKind = FileKind {
    name: "file of jostle",
    marks: &["\"jostle\":", "\"fingerprint\":"],
};

/// Whether a folder holds files of an earlier suite, which a run replaces or continues.
///
/// # Errors
/// [`RunError::Kept`] if jostle did not write one of the files and `force` is false.
pub fn earlier_suite_files(suite: &Suite, folder: &Path, force: bool) -> Result<bool, RunError> {
    let mut earlier = false;
    for (name, kind) in [
        ("suite.json", SUITE),
        ("suite.parquet", FileKind::TABLE),
        ("suite.html", PAGE),
    ] {
        earlier |= may_write(&folder.join(name), Some(kind), force)?;
    }
    for index in 0..suite.records.len() {
        let place = suite.place(index, folder);
        earlier |= !earlier_files(&place, force)?.is_empty();
        may_write(&place.join(FINISHED), Some(FINISHED_KIND), force)?;
    }
    Ok(earlier)
}

/// Parts of the work of one record: the run itself, the search for sensitive results, the run without contact.
const WORK: [f64; 3] = [0.45, 0.1, 0.45];

impl Suite {
    /// Runs every record that is not finished yet, into its own folder in `folder`; without a folder all results stay in
    /// memory. `stop` is asked often; records that are finished by then are kept.
    ///
    /// # Errors
    /// [`StudyError::Output`] when files cannot be written.
    pub fn run(
        &self,
        folder: Option<&Path>,
        options: &SuiteOptions,
        stop: &(dyn Fn() -> bool + Sync),
        progress: &(dyn Fn(SuiteProgress) + Sync),
    ) -> Result<SuiteDone, StudyError> {
        let count = self.records.len();
        let work = Work {
            suite: self,
            folder,
            options,
            stop,
            progress,
            next: AtomicUsize::new(0),
            shares: (0..count).map(|_| AtomicU64::new(0)).collect(),
            kept: AtomicUsize::new(0),
            results: Mutex::new((0..count).map(|_| None).collect()),
            halt: AtomicBool::new(false),
            error: Mutex::new(None),
        };
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let threads = options.jobs.unwrap_or(cores).clamp(1, count.max(1));
        std::thread::scope(|scope| {
            for _ in 1..threads {
                scope.spawn(|| work.labour());
            }
            work.labour();
        });
        if let Some(error) = work
            .error
            .into_inner()
            .unwrap_or_else(PoisonError::into_inner)
        {
            return Err(error);
        }
        let kept = work.kept.load(Ordering::Relaxed);
        let results = work
            .results
            .into_inner()
            .unwrap_or_else(PoisonError::into_inner);
        let finished = results.iter().flatten().count();
        let all: Option<Vec<RecordResult>> = results.into_iter().collect();
        let results = all.map(|records| SuiteResults::new(self, records));
        if let (Some(results), Some(folder)) = (&results, folder) {
            results.write(self, folder, options.report)?;
        }
        Ok(SuiteDone {
            results,
            kept,
            finished,
        })
    }
}

/// Data shared by all threads.
struct Work<'a> {
    suite: &'a Suite,
    folder: Option<&'a Path>,
    options: &'a SuiteOptions,
    stop: &'a (dyn Fn() -> bool + Sync),
    progress: &'a (dyn Fn(SuiteProgress) + Sync),
    next: AtomicUsize,
    /// Bits of the share of every record that is done.
    shares: Vec<AtomicU64>,
    kept: AtomicUsize,
    results: Mutex<Vec<Option<RecordResult>>>,
    /// An error has occurred: nobody begins anything more.
    halt: AtomicBool,
    error: Mutex<Option<StudyError>>,
}

impl Work<'_> {
    fn labour(&self) {
        loop {
            let index = self.next.fetch_add(1, Ordering::Relaxed);
            let ended = self.halt.load(Ordering::Relaxed) || (self.stop)();
            let Some(record) = self.suite.records.get(index).filter(|_| !ended) else {
                return;
            };
            match self.one(index, record) {
                Ok(Some(result)) => {
                    let mut results = self.results.lock().unwrap_or_else(PoisonError::into_inner);
                    results[index] = Some(result);
                    drop(results);
                    self.advance(index, 1.0);
                }
                Ok(None) => return,
                Err(error) => {
                    self.halt.store(true, Ordering::Relaxed);
                    let mut first = self.error.lock().unwrap_or_else(PoisonError::into_inner);
                    first.get_or_insert(error);
                    return;
                }
            }
        }
    }

    fn advance(&self, index: usize, share: f64) {
        self.shares[index].store(share.to_bits(), Ordering::Relaxed);
        let shares = self.shares.iter();
        let shares: Vec<f64> = shares
            .map(|bits| f64::from_bits(bits.load(Ordering::Relaxed)))
            .collect();
        (self.progress)(SuiteProgress {
            finished: shares.iter().filter(|share| **share >= 1.0).count(),
            records: shares.len(),
            share: shares.iter().sum::<f64>() / shares.len() as f64,
        });
    }

    /// One record; `None` when it was stopped.
    fn one(&self, index: usize, record: &SuiteRecord) -> Result<Option<RecordResult>, StudyError> {
        let failed = |error: RunError| StudyError::Output(error.to_string());
        let prepared = record.prepare().map_err(failed)?;
        let print = fingerprint(&prepared, self.options);
        let place = self.folder.map(|folder| self.suite.place(index, folder));
        let known = place.as_deref().and_then(|place| finished(place, &print));
        if let Some(summary) = known {
            self.kept.fetch_add(1, Ordering::Relaxed);
            return Ok(Some(RecordResult::new(record, summary)));
        }
        let settings = prepared.settings(place.is_some() || self.options.report);
        prepared.check_histories(settings, self.options.report, None)?;
        let mut observer = |stage: Stage, progress: jostle::stepping::Progress| {
            let part = (progress.time / progress.duration).clamp(0.0, 1.0);
            let share = match stage {
                Stage::Pounding => WORK[0] * part,
                Stage::Sensitivity => WORK[0] + WORK[1] * part,
                Stage::WithoutContact | Stage::ContactSensitivity | Stage::IsolationBounds => {
                    WORK[0] + WORK[1] + WORK[2] * part
                }
            };
            self.advance(index, share.min(0.999));
            let ended = (self.stop)() || self.halt.load(Ordering::Relaxed);
            if ended {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        let mut ran = prepared.run(settings, &mut observer);
        // So that files are the same for every number of threads and on every machine.
        ran.wall = 0.0;
        if self.options.report {
            ran.run_without_contact(settings, &mut observer);
        }
        if self.options.sensitivity {
            ran.run_other_contacts(&mut observer);
        }
        ran.run_isolation_bounds(ran.without_contact.is_some(), &mut observer);
        let ended = *ran.outcome.end_of_all() == RunEnd::Stopped
            || ran
                .without_contact
                .as_ref()
                .is_some_and(|run| *run.end_of_all() == RunEnd::Stopped)
            || (self.stop)()
            || self.halt.load(Ordering::Relaxed);
        if ended {
            return Ok(None);
        }
        let summary = ran.summary();
        let text = summary_json(&summary);
        if let Some(place) = &place {
            std::fs::create_dir_all(place)
                .map_err(|error| StudyError::Output(format!("{}: {error}", place.display())))?;
            // Without this file the record is run again: it must not describe files that are about to be replaced.
            let mark = place.join(FINISHED);
            match std::fs::remove_file(&mark) {
                Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                    return Err(StudyError::Output(format!("{}: {error}", mark.display())));
                }
                _ => {}
            }
            let content = Content {
                tables: true,
                report: self.options.report,
            };
            ran.results(&summary).write(place, content)?;
            write_atomically(&mark, finished_text(&print, &text).as_bytes())?;
        }
        let mut result = RecordResult::new(record, text);
        if let RunEnd::Failed(StepError::Collapse { .. }) = &ran.outcome.end {
            result.status = RecordStatus::Collapsed;
        }
        Ok(Some(result))
    }
}
