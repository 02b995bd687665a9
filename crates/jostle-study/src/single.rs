//! One case with everything a single run leaves behind.

use std::path::Path;

use jostle_io::{
    write_atomically, write_history_parquet, write_impacts_parquet, write_members_parquet,
    write_summary_json,
};
use jostle_report::Page;

use crate::case::{CaseError, Ran, Workshop};
use crate::study::{Study, StudyError};

/// Runs one case with its histories and writes `summary.json`, `history.parquet`, `impacts.parquet` and
/// `report.html` into a folder. `false` when it was stopped.
///
/// # Errors
/// [`StudyError`] when the case is wrong or its files cannot be written.
pub fn run_case(
    study: &Study,
    case: u64,
    folder: &Path,
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<bool, StudyError> {
    let prepared = Workshop::default().prepare(study, case);
    let prepared = prepared.map_err(|error| match error {
        CaseError::Input(error) => StudyError::from(error),
        CaseError::Path(error) => StudyError::Column(error.to_string()),
    })?;
    match prepared.run(jostle::Settings::default(), stop) {
        Some(ran) => write_run(&ran, folder).map(|()| true),
        None => Ok(false),
    }
}

pub(crate) fn write_run(ran: &Ran, folder: &Path) -> Result<(), StudyError> {
    std::fs::create_dir_all(folder)
        .map_err(|error| StudyError::Output(format!("{}: {error}", folder.display())))?;
    let (model, summary) = (&ran.prepared.input.model, &ran.summary);
    if let Some(history) = &ran.outcome.history {
        write_history_parquet(&folder.join("history.parquet"), model, summary, history)?;
        write_impacts_parquet(&folder.join("impacts.parquet"), summary)?;
        if let Some(members) = &ran.outcome.member_history {
            let (path, system) = (folder.join("members.parquet"), &ran.prepared.system);
            write_members_parquet(&path, system, members, summary)?;
        }
        let page = Page {
            model,
            motion: &ran.prepared.motion,
            summary,
            history,
            without_contact: None,
            springs: ran.outcome.spring_history.as_ref(),
            sections: &[],
            methods: &[],
        };
        write_atomically(
            &folder.join("report.html"),
            jostle_report::render(&page).as_bytes(),
        )?;
    }
    write_summary_json(&folder.join("summary.json"), summary)?;
    Ok(())
}
