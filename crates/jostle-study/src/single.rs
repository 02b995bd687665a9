//! One case with all files of a single run.

use std::ops::ControlFlow;
use std::path::Path;

use jostle::{RunEnd, Settings};
use jostle_run::{Content, Prepared, Ran, Stage};

use crate::study::{Study, StudyError};
use jostle_run::{CaseCache, CaseError};

/// Runs one case with its histories and writes the files of `jostle run` into a folder. `false` when it was stopped.
///
/// # Errors
/// [`StudyError`] when the case is wrong or its files cannot be written.
pub fn run_case(
    study: &Study,
    case: u64,
    folder: &Path,
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<bool, StudyError> {
    let prepared = study.prepare(&CaseCache::default(), case);
    let prepared = prepared.map_err(|error| match error {
        CaseError::Input(error) => StudyError::from(error),
        CaseError::Path(error) => StudyError::Column(error.to_string()),
    })?;
    let settings = prepared.settings(true);
    prepared.check_histories(settings, true, None)?;
    match run_until(prepared, settings, stop) {
        Some(ran) => write_run(ran, settings, folder, stop),
        None => Ok(false),
    }
}

/// Runs a case; `None` when it was stopped.
pub(crate) fn run_until(
    prepared: Prepared,
    settings: Settings,
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<Ran> {
    let mut stopped = false;
    let mut watch = observer(stop);
    let mut ran = prepared.run(settings, &mut |stage, progress| {
        let flow = watch(stage, progress);
        stopped |= flow.is_break();
        flow
    });
    // So that results are the same on every machine.
    ran.wall = 0.0;
    // Without a search for sensitivity to its end, a row would depend on when the study was stopped.
    (!stopped).then_some(ran)
}

/// Runs a case without contact as well, unless it has that run. `false` when it was stopped.
pub(crate) fn add_run_without_contact(
    ran: &mut Ran,
    settings: Settings,
    stop: &(dyn Fn() -> bool + Sync),
) -> bool {
    if ran.without_contact.is_none() {
        ran.run_without_contact(settings, &mut observer(stop));
    }
    let without = ran.without_contact.as_ref();
    without.is_none_or(|run| *run.end_of_all() != RunEnd::Stopped)
}

/// Runs a case without contact as well, for its report, and writes its files. `false` when it was stopped.
pub(crate) fn write_run(
    mut ran: Ran,
    settings: Settings,
    folder: &Path,
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<bool, StudyError> {
    if !add_run_without_contact(&mut ran, settings, stop) {
        return Ok(false);
    }
    ran.run_isolation_bounds(true, &mut observer(stop));
    if stop() {
        return Ok(false);
    }
    std::fs::create_dir_all(folder)
        .map_err(|error| StudyError::Output(format!("{}: {error}", folder.display())))?;
    let summary = ran.summary();
    ran.results(&summary).write(folder, Content::ALL)?;
    Ok(true)
}

fn observer(
    stop: &(dyn Fn() -> bool + Sync),
) -> impl FnMut(Stage, jostle::stepping::Progress) -> ControlFlow<()> {
    move |_, _| {
        if stop() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}
