//! Runs the cases of a study on all cores; finished cases are never lost.

use std::any::Any;
use std::collections::VecDeque;
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use crate::case;
use crate::dataset::{
    Claim, Journal, PartFault, cases_of, journal_path, keep_copy, no_journal, owner_of, part_path,
    set_aside, settle, settle_for_part, strangers, verify, write_part,
};
use crate::row::{Row, Status};
use crate::single::{add_run_without_contact, run_case, run_until, write_run};
use crate::study::{Study, StudyError};
use jostle_run::CaseCache;

/// Which part of a study this process computes, and how.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RunSettings {
    /// Threads; `None` is one for every core.
    pub jobs: Option<usize>,
    /// Every `shards`-th part, from the one with number `shard`, 0-based.
    pub shard: u64,
    /// 1 computes everything.
    pub shards: u64,
    /// Computes this part only and looks at no other file of the folder, so that the time of a part does not depend on their number:
    /// for workers that are given one part each. `shard` and `shards` have no effect then.
    pub only: Option<u64>,
}

impl Default for RunSettings {
    fn default() -> Self {
        Self {
            jobs: None,
            shard: 0,
            shards: 1,
            only: None,
        }
    }
}

/// How far a study has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Cases that are finished, those of earlier runs included.
    pub finished: u64,
    /// Cases that this process has computed.
    pub computed: u64,
    /// Cases to finish.
    pub cases: u64,
}

/// Results of a run of a study besides its files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Done {
    /// How far it came.
    pub progress: Progress,
    /// Cases of this process that failed.
    pub failed: u64,
    /// Whether it was asked to stop.
    pub stopped: bool,
    /// Whether every part of the whole study is there.
    pub complete: bool,
}

/// How often a waiting thread looks up.
const LOOK_UP: Duration = Duration::from_millis(50);
/// Time after which it is said who is waited for.
const WAIT: Duration = Duration::from_secs(5);
/// Time after which what another process computes, without finishing a case, is computed here as well by threads that have
/// nothing else to do. Both compute the same rows.
const STALE: Duration = Duration::from_secs(30);

/// Runs what is not finished yet. `stop` is asked often; what is finished by then stays.
///
/// Every finished part is verified: its checksum, its study and the numbers of its cases. A file that fails is moved
/// to `set-aside/`, `remark` says so in one sentence or two, and its cases are computed again.
///
/// # Errors
/// [`StudyError::Folder`] when the folder holds another study, [`StudyError::Output`] when nothing more can be written.
pub fn run(
    study: &Study,
    folder: &Path,
    settings: &RunSettings,
    stop: &(dyn Fn() -> bool + Sync),
    progress: &(dyn Fn(Progress) + Sync),
    remark: &(dyn Fn(&str) + Sync),
) -> Result<Done, StudyError> {
    let case_cache = CaseCache::default();
    let compute = |case: u64| compute(study, folder, &case_cache, case, stop);
    let hooks = Hooks {
        stop,
        progress,
        remark,
    };
    let mut done = run_with(study, folder, settings, hooks, &compute)?;
    if done.complete && settings.only.is_none() {
        done.stopped = !remake_histories(study, folder, stop)?;
    }
    Ok(done)
}

/// Makes the files of single cases that are missing beside finished parts, say because only the parts were copied. `false`
/// when it was stopped.
fn remake_histories(
    study: &Study,
    folder: &Path,
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<bool, StudyError> {
    for &case in &study.file.histories {
        let run_folder = run_folder(folder, case);
        if run_folder.join("summary.json").exists() {
            continue;
        }
        // A case that cannot be run is a row with its reason.
        match run_case(study, case, &run_folder, stop) {
            Ok(true) | Err(StudyError::Input(_) | StudyError::Column(_)) => {}
            Ok(false) => return Ok(false),
            Err(error) => return Err(error),
        }
    }
    Ok(true)
}

/// Callbacks of a run for interruption and progress.
#[derive(Clone, Copy)]
pub(crate) struct Hooks<'a> {
    pub(crate) stop: &'a (dyn Fn() -> bool + Sync),
    pub(crate) progress: &'a (dyn Fn(Progress) + Sync),
    pub(crate) remark: &'a (dyn Fn(&str) + Sync),
}

/// The same for any way of computing a case; `None` when it was stopped.
pub(crate) fn run_with(
    study: &Study,
    folder: &Path,
    settings: &RunSettings,
    hooks: Hooks<'_>,
    compute: &(dyn Fn(u64) -> Result<Option<Row>, StudyError> + Sync),
) -> Result<Done, StudyError> {
    let parts: VecDeque<u64> = match settings.only {
        Some(part) => {
            settle_for_part(study, folder)?;
            VecDeque::from([part])
        }
        None => {
            settle(study, folder)?;
            let in_shard = |part: &u64| part % settings.shards == settings.shard;
            (0..study.parts()).filter(in_shard).collect()
        }
    };
    let cases = parts.iter().map(|part| count(study, *part)).sum();
    let work = Work {
        study,
        folder,
        queue: Mutex::new(Queue {
            parts,
            taken: VecDeque::new(),
            current: None,
            waiting: None,
        }),
        finished: AtomicU64::new(0),
        computed: AtomicU64::new(0),
        failed: AtomicU64::new(0),
        cases,
        error: Mutex::new(None),
        halt: AtomicBool::new(false),
        unlocked: AtomicBool::new(false),
        hooks,
    };
    if settings.only.is_none() {
        work.clear_strangers()?;
    }
    let threads = settings.jobs.unwrap_or(0);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| StudyError::Output(error.to_string()))?;
    pool.broadcast(|_| work.labour(compute));
    work.report();
    if let Some(error) = lock(&work.error).take() {
        return Err(error);
    }
    let complete = match settings.only {
        Some(_) => work.now().finished == work.cases,
        None => work.is_complete(settings)?,
    };
    Ok(Done {
        progress: work.now(),
        failed: work.failed.load(Ordering::Relaxed),
        stopped: (hooks.stop)() && !complete,
        complete,
    })
}

fn count(study: &Study, part: u64) -> u64 {
    let cases = study.part(part);
    cases.end - cases.start
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // A panic outside the computation of a case would be a fault of this file; the data stay usable.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Data shared by all threads.
struct Work<'a> {
    study: &'a Study,
    folder: &'a Path,
    queue: Mutex<Queue>,
    finished: AtomicU64,
    computed: AtomicU64,
    failed: AtomicU64,
    cases: u64,
    error: Mutex<Option<StudyError>>,
    /// An error has occurred: no thread begins another case.
    halt: AtomicBool,
    /// It was said that the file system has no locks.
    unlocked: AtomicBool,
    hooks: Hooks<'a>,
}

/// Work not yet distributed.
struct Queue {
    parts: VecDeque<u64>,
    /// Parts that other processes compute.
    taken: VecDeque<u64>,
    current: Option<Arc<Part>>,
    /// Since when all that is left is computed by others, and whether it was said.
    waiting: Option<(Instant, bool)>,
}

/// A part under way.
struct Part {
    number: u64,
    inner: Mutex<Inner>,
}

struct Inner {
    journal: Option<Journal>,
    rows: Vec<Option<Row>>,
    /// Cases that no thread has begun.
    open: VecDeque<u64>,
    /// Cases without a row.
    missing: usize,
}

impl Work<'_> {
    fn labour(&self, compute: &(dyn Fn(u64) -> Result<Option<Row>, StudyError> + Sync)) {
        while let Some((part, case)) = self.next() {
            let computed = catch_unwind(AssertUnwindSafe(|| compute(case)));
            let row = match computed {
                Ok(Ok(Some(row))) => row,
                Ok(Ok(None)) => return,
                Ok(Err(error)) => return self.fail(error),
                Err(panic) => {
                    let reason = format!("the program failed on this case: {}", message(&*panic));
                    case::failed(self.study, case, &reason)
                }
            };
            self.computed.fetch_add(1, Ordering::Relaxed);
            if row.status == Status::Failed {
                self.failed.fetch_add(1, Ordering::Relaxed);
            }
            if let Err(error) = self.keep(&part, row) {
                return self.fail(error);
            }
            self.report();
        }
    }

    fn now(&self) -> Progress {
        Progress {
            finished: self.finished.load(Ordering::Relaxed),
            computed: self.computed.load(Ordering::Relaxed),
            cases: self.cases,
        }
    }

    fn report(&self) {
        (self.hooks.progress)(self.now());
    }

    fn fail(&self, error: StudyError) {
        self.halt.store(true, Ordering::Relaxed);
        lock(&self.error).get_or_insert(error);
    }

    /// The next case to compute; `None` if all are done.
    fn next(&self) -> Option<(Arc<Part>, u64)> {
        let mut queue = lock(&self.queue);
        loop {
            if self.halt.load(Ordering::Relaxed) || (self.hooks.stop)() {
                return None;
            }
            if let Some(part) = &queue.current {
                let case = lock(&part.inner).open.pop_front();
                if let Some(case) = case {
                    return Some((Arc::clone(part), case));
                }
                queue.current = None;
            }
            let Some(number) = queue.parts.pop_front() else {
                if queue.taken.is_empty() {
                    return None;
                }
                // Others are at work on the rest; if one of them dies, its part is taken over.
                std::thread::sleep(LOOK_UP);
                queue.waiting.get_or_insert((Instant::now(), false));
                let taken = std::mem::take(&mut queue.taken);
                queue.parts = taken;
                self.report();
                continue;
            };
            match self.open(number) {
                Ok(Opened::Ours(part)) => queue.current = Some(part),
                Ok(Opened::Finished) => {
                    let count = count(self.study, number);
                    self.finished.fetch_add(count, Ordering::Relaxed);
                }
                Ok(Opened::Taken) => match self.take_over(number, &mut queue.waiting) {
                    Ok(None) => queue.taken.push_back(number),
                    Ok(Some(part)) => queue.current = Some(part),
                    Err(error) => {
                        self.fail(error);
                        return None;
                    }
                },
                Err(error) => {
                    self.fail(error);
                    return None;
                }
            }
        }
    }

    /// Claims a part, unless it is finished. A file in its place that is not this part is set aside.
    fn open(&self, number: u64) -> Result<Opened, StudyError> {
        let cases = self.study.part(number);
        let journal_path = journal_path(self.folder, cases.start);
        let remove = |journal: io::Result<Journal>| match journal {
            Ok(journal) => journal
                .remove()
                .map_err(|error| unwritable(&journal_path, &error)),
            Err(_) => Ok(()),
        };
        let first_look = verify(self.study, self.folder, number);
        if first_look.is_ok() && !journal_path.exists() {
            return Ok(Opened::Finished);
        }
        let (journal, known) = match (self.claim(number)?, &first_look) {
            // Remains of a process that was killed between writing the part and removing its journal.
            (Claim::Ours(journal, _), Ok(_)) => {
                remove(journal)?;
                return Ok(Opened::Finished);
            }
            (Claim::Taken, Ok(_)) => return Ok(Opened::Finished),
            (Claim::Taken, Err(_)) => return Ok(Opened::Taken),
            (Claim::Ours(journal, rows), Err(_)) => (journal, rows),
        };
        // It may have been finished between the first look and the claim.
        match verify(self.study, self.folder, number) {
            Ok(_) => {
                remove(journal)?;
                return Ok(Opened::Finished);
            }
            Err(fault) => self.clear(number, &fault, "computed again")?,
        }
        if let Err(error) = &journal
            && !self.unlocked.swap(true, Ordering::Relaxed)
        {
            self.remark(&format!(
                "{} cannot be locked: {error}. Several processes on this folder would compute the same cases, with the same results.",
                journal_path.display()
            ));
        }
        self.begin(number, journal.ok(), known).map(Opened::Ours)
    }

    /// Computes what another process has claimed but does not go on with, if there is nothing else to do; says before who is
    /// waited for.
    fn take_over(
        &self,
        number: u64,
        waiting: &mut Option<(Instant, bool)>,
    ) -> Result<Option<Arc<Part>>, StudyError> {
        let Some((since, said)) = waiting else {
            return Ok(None);
        };
        if since.elapsed() < WAIT {
            return Ok(None);
        }
        let path = journal_path(self.folder, self.study.part(number).start);
        let (owner, idle) = owner_of(&path);
        let ago = idle.map_or_else(String::new, |idle| {
            format!(", and finished the last case {} s ago", idle.as_secs())
        });
        let cases = cases_of(self.study, number);
        if since.elapsed() > STALE && idle.is_none_or(|idle| idle > STALE) {
            self.remark(&format!(
                "{owner} has {cases}{ago}. They are computed here as well."
            ));
            let known = Journal::finished(&path, &self.study.fingerprint);
            return self.begin(number, None, known).map(Some);
        }
        if !std::mem::replace(said, true) {
            self.remark(&format!("waiting for {owner}, which has {cases}{ago}"));
        }
        Ok(None)
    }

    /// Begins with a part of which some rows are known.
    fn begin(
        &self,
        number: u64,
        journal: Option<Journal>,
        known: Vec<Row>,
    ) -> Result<Arc<Part>, StudyError> {
        let cases = self.study.part(number);
        let mut rows: Vec<Option<Row>> = cases.clone().map(|_| None).collect();
        for row in known {
            let index = row
                .case
                .checked_sub(cases.start)
                .map(|index| index as usize);
            if let Some(place) = index.and_then(|index| rows.get_mut(index)) {
                *place = Some(row);
            }
        }
        let open: VecDeque<u64> = cases
            .clone()
            .zip(&rows)
            .filter(|(_, row)| row.is_none())
            .map(|(case, _)| case)
            .collect();
        let missing = open.len();
        self.finished
            .fetch_add((rows.len() - missing) as u64, Ordering::Relaxed);
        let part = Arc::new(Part {
            number,
            inner: Mutex::new(Inner {
                journal,
                rows,
                open,
                missing,
            }),
        });
        if missing == 0 {
            self.write(&part, &mut lock(&part.inner))?;
        }
        Ok(part)
    }

    /// Notes a row, and writes the part when it was the last.
    fn keep(&self, part: &Part, row: Row) -> Result<(), StudyError> {
        let mut inner = lock(&part.inner);
        if let Some(journal) = &mut inner.journal {
            let path = journal.path().to_owned();
            journal
                .append(&row)
                .map_err(|error| unwritable(&path, &error))?;
        }
        let index = (row.case - self.study.part(part.number).start) as usize;
        if let Some(place) = inner.rows.get_mut(index).filter(|place| place.is_none()) {
            *place = Some(row);
            inner.missing -= 1;
            self.finished.fetch_add(1, Ordering::Relaxed);
        }
        if inner.missing == 0 {
            self.write(part, &mut inner)?;
        }
        Ok(())
    }

    fn write(&self, part: &Part, inner: &mut Inner) -> Result<(), StudyError> {
        let rows: Vec<Row> = std::mem::take(&mut inner.rows)
            .into_iter()
            .flatten()
            .collect();
        write_part(self.study, self.folder, part.number, &rows)?;
        if let Some(journal) = inner.journal.take() {
            let path = journal.path().to_owned();
            journal
                .remove()
                .map_err(|error| unwritable(&path, &error))?;
        }
        Ok(())
    }

    /// Claims the journal of a part; that of another study is kept.
    fn claim(&self, number: u64) -> Result<Claim, StudyError> {
        let path = journal_path(self.folder, self.study.part(number).start);
        if let Some(fault) = no_journal(&path) {
            let moved = set_aside(self.folder, &path, "no-journal");
            if let Some(now) = moved.map_err(|error| unwritable(&path, &error))? {
                self.remark(&format!(
                    "{} {fault}. It was moved to {}.",
                    path.display(),
                    now.display()
                ));
            }
        }
        let keep = |bytes: &[u8]| {
            let kept = keep_copy(self.folder, &path, "other-study", bytes)?;
            self.remark(&format!(
                "{} belongs to another study, or its beginning is damaged. It was kept as {}; {} are computed again.",
                path.display(),
                kept.display(),
                cases_of(self.study, number)
            ));
            Ok(())
        };
        let claim = Journal::claim(&path, &self.study.fingerprint, &keep)
            .map_err(|error| unwritable(&path, &error))?;
        if let Claim::Ours(Ok(journal), _) = &claim {
            journal.name_owner();
        }
        Ok(claim)
    }

    /// Moves aside the file of a part that is not this part, and reports the reason and the fate of its cases.
    fn clear(&self, number: u64, fault: &PartFault, what_now: &str) -> Result<(), StudyError> {
        let path = part_path(self.folder, self.study.part(number).start);
        let Some(label) = fault.label() else {
            return match fault {
                PartFault::Unreadable(error) => Err(unwritable(&path, error)),
                _ => Ok(()),
            };
        };
        let moved = set_aside(self.folder, &path, label);
        if let Some(now) = moved.map_err(|error| unwritable(&path, &error))? {
            self.remark(&format!(
                "{} {fault}. It was moved to {}; {} are {what_now}.",
                path.display(),
                now.display(),
                cases_of(self.study, number)
            ));
        }
        Ok(())
    }

    /// Moves aside Parquet files that do not belong to this study: readers of all files would include them.
    fn clear_strangers(&self) -> Result<(), StudyError> {
        for path in strangers(self.study, self.folder) {
            let moved = set_aside(self.folder, &path, "no-part");
            if let Some(now) = moved.map_err(|error| unwritable(&path, &error))? {
                self.remark(&format!(
                    "{} is no part of this study. It was moved to {}, because programs that read cases/*.parquet would mix it in.",
                    path.display(),
                    now.display()
                ));
            }
        }
        Ok(())
    }

    /// Whether every part of the whole study is there. Parts of other shares are verified once all are there.
    fn is_complete(&self, settings: &RunSettings) -> Result<bool, StudyError> {
        let there = |part: u64| part_path(self.folder, self.study.part(part).start).exists();
        if !(0..self.study.parts()).all(there) {
            return Ok(false);
        }
        let others =
            (0..self.study.parts()).filter(|part| part % settings.shards != settings.shard);
        for part in others {
            if verify(self.study, self.folder, part).is_ok() {
                continue;
            }
            if let Claim::Ours(journal, rows) = self.claim(part)? {
                if let Err(fault) = verify(self.study, self.folder, part) {
                    let what_now = "missing: run the share that they belong to once more";
                    self.clear(part, &fault, what_now)?;
                }
                if let (Ok(journal), true) = (journal, rows.is_empty()) {
                    let path = journal.path().to_owned();
                    journal
                        .remove()
                        .map_err(|error| unwritable(&path, &error))?;
                }
            }
        }
        let complete = (0..self.study.parts()).all(there);
        if complete {
            // Nothing is under way; what is there is of another process, which removes it.
            let _ = std::fs::remove_dir(self.folder.join("under-way"));
        }
        Ok(complete)
    }

    fn remark(&self, text: &str) {
        (self.hooks.remark)(text);
    }
}

enum Opened {
    Ours(Arc<Part>),
    Finished,
    Taken,
}

fn unwritable(path: &Path, error: &io::Error) -> StudyError {
    StudyError::Output(format!("{}: {error}", path.display()))
}

/// The text of a panic.
fn message(panic: &(dyn Any + Send)) -> String {
    panic
        .downcast_ref::<&str>()
        .map(|text| (*text).to_owned())
        .or_else(|| panic.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "no reason given".to_owned())
}

/// Where the histories of a case lie.
#[must_use]
pub fn run_folder(folder: &Path, case: u64) -> PathBuf {
    folder.join("runs").join(format!("case-{case:010}"))
}

fn compute(
    study: &Study,
    folder: &Path,
    case_cache: &CaseCache,
    number: u64,
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<Option<Row>, StudyError> {
    let mut prepared = match study.prepare(case_cache, number) {
        Ok(prepared) => prepared,
        Err(error) => return Ok(Some(case::failed(study, number, &error.to_string()))),
    };
    let keep = study.file.histories.contains(&number);
    let (settings, shown) = (prepared.settings(false), prepared.settings(true));
    // A row holds no spectra of floors, and their rows of histories cost time.
    let spectra = Arc::make_mut(&mut prepared.input).floor_spectra.take();
    let Some(mut ran) = run_until(prepared, settings, stop) else {
        return Ok(None);
    };
    if study.file.without_contact && !add_run_without_contact(&mut ran, settings, stop) {
        return Ok(None);
    }
    let row = case::row_of(study, number, &ran);
    if keep {
        // Rows of histories cost modal stepping steps: the row of the study is that of the run without them.
        let kept = if settings == shown && spectra.is_none() {
            Some(ran)
        } else {
            Arc::make_mut(&mut ran.prepared.input).floor_spectra = spectra;
            run_until(ran.prepared, shown, stop)
        };
        let folder = run_folder(folder, number);
        let written = kept.map(|kept| write_run(kept, shown, &folder, stop));
        if !written.transpose()?.unwrap_or_default() {
            return Ok(None);
        }
    }
    Ok(Some(row))
}

#[cfg(test)]
mod tests {
    use jostle_io::{Format, StudyFile};

    use super::*;

    const STUDY: &str = r#"
base = "paper"
[[vary]]
path = "gap[0].width"
range = { from = 0.01, to = 0.5, count = 50 }
"#;

    fn study() -> Study {
        let file = StudyFile::parse("s.toml", STUDY, Format::Toml, Path::new(""), None);
        Study::new(file.unwrap_or_else(|error| panic!("{error}")))
            .unwrap_or_else(|error| panic!("{error}"))
    }

    fn hooks<'a>(stop: &'a (dyn Fn() -> bool + Sync)) -> Hooks<'a> {
        Hooks {
            stop,
            progress: &|_| {},
            remark: &|_| {},
        }
    }

    fn quick(study: &Study, case: u64) -> Row {
        let mut row = case::blank(study, case);
        row.reason = format!("made up for case {case}");
        row
    }

    #[test]
    fn a_panic_in_one_case_is_a_row_and_the_rest_goes_on() {
        let study = study();
        let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
        let compute = |case: u64| {
            assert!(case != 17, "a bug that only case 17 has");
            Ok(Some(quick(&study, case)))
        };
        let settings = RunSettings {
            jobs: Some(3),
            ..RunSettings::default()
        };
        let done = run_with(&study, folder.path(), &settings, hooks(&|| false), &compute);
        let done = done.unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((done.failed, done.progress.finished), (1, 50));
        assert!(done.complete);
        let table = crate::dataset::read_columns(&study, folder.path(), &["status", "reason"]);
        let table = table.unwrap_or_else(|error| panic!("{error}"));
        for case in 0..50 {
            let (status, reason) = (&table.texts["status"][case], &table.texts["reason"][case]);
            if case == 17 {
                assert_eq!(status, "failed");
                assert!(reason.contains("a bug that only case 17 has"), "{reason}");
            } else {
                assert_eq!(status, "completed");
                assert_eq!(*reason, format!("made up for case {case}"));
            }
        }
    }

    /// A process that dies with a part half done loses nothing that was finished: the cases computed by both add up.
    #[test]
    fn finished_cases_of_an_unfinished_part_are_not_computed_again() {
        let study = study();
        let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
        let one = RunSettings {
            jobs: Some(1),
            ..RunSettings::default()
        };
        let counted = AtomicU64::new(0);
        let compute = |case: u64| {
            counted.fetch_add(1, Ordering::Relaxed);
            Ok(Some(quick(&study, case)))
        };
        let stop = || counted.load(Ordering::Relaxed) >= 23;
        let done = run_with(&study, folder.path(), &one, hooks(&stop), &compute);
        assert!(done.is_ok_and(|done| done.stopped && !done.complete));
        let first = counted.swap(0, Ordering::Relaxed);
        let done = run_with(&study, folder.path(), &one, hooks(&|| false), &compute);
        assert!(done.is_ok_and(|done| done.complete));
        assert_eq!(first, 23);
        assert_eq!(counted.load(Ordering::Relaxed), 50 - 23);
    }
}
