//! `jostle run` of a model with several records.

use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

use jostle_motion::GoverningRule;
use jostle_run::{FolderClaim, Opened};
use jostle_study::suite::{Suite, SuiteOptions, SuiteProgress, earlier_suite_files};

use crate::args::RunArgs;
use crate::failure::Failure;
use crate::printer::Printer;
use crate::progress::Bar;
use crate::stop::stop_on_interrupt;
use crate::terminal;

pub(crate) fn run(
    args: &RunArgs,
    opened: &Opened,
    out: Option<PathBuf>,
    printer: Option<&Printer>,
) -> Result<(), Failure> {
    if args.method {
        return Err(Failure::Input(
            "--method: goes with one record; choose one with --record".into(),
        ));
    }
    if args.xlsx.is_some() {
        return Err(Failure::Input(
            "--xlsx: goes with one record; choose one with --record".into(),
        ));
    }
    let rule = args.governing.as_deref().and_then(GoverningRule::from_name);
    let suite = Suite::new(opened, rule)?;
    terminal::warn_all(&suite.warnings);
    if let Some(out) = &out {
        make(out)?;
        if earlier_suite_files(&suite, out, args.force)? {
            terminal::remark(&format!(
                "{} holds an earlier run of such a suite; records that are finished there are kept",
                out.display()
            ));
        }
    }
    let claim = out.as_deref().map(FolderClaim::new).transpose()?;
    let options = SuiteOptions {
        report: !args.no_report,
        sensitivity: args.sensitivity,
        jobs: args.jobs.map(|jobs| jobs as usize),
    };
    let flag = stop_on_interrupt();
    let stop = || flag.load(Ordering::Relaxed);
    let bar = Bar::new("");
    let show = |progress: SuiteProgress| {
        bar.show(progress.share, || {
            format!("{} of {} records", progress.finished, progress.records)
        });
    };
    let done = suite.run(out.as_deref(), &options, &stop, &show);
    drop(claim);
    bar.finish();
    let done = done?;
    let Some(results) = &done.results else {
        let kept = match out {
            Some(_) => "; the same command continues from here",
            None => "",
        };
        terminal::remark(&format!(
            "stopped: {} of {} records are finished{kept}",
            done.finished,
            suite.records.len()
        ));
        return Err(Failure::Stopped);
    };
    if let (Some(printer), Some(out)) = (printer, &out) {
        for record in &results.records {
            printer.print(&out.join(&record.folder).join("report.html"))?;
        }
        printer.print(&out.join("suite.html"))?;
    }
    if args.json {
        terminal::print(&results.json())?;
    } else {
        if done.kept > 0 {
            let be = if done.kept == 1 { "was" } else { "were" };
            let records = jostle_run::counted(done.kept, "record");
            terminal::remark(&format!("{records} {be} finished already"));
        }
        let page = out.as_deref().map(|out| out.join("suite.html"));
        terminal::print(&results.describe(page.as_deref()))?;
    }
    let failed: Vec<&str> = results
        .records
        .iter()
        .filter(|record| record.reason.is_some())
        .map(|record| record.motion())
        .collect();
    if failed.is_empty() {
        return Ok(());
    }
    Err(Failure::Analysis(format!(
        "{} of {} records did not reach their end: {}",
        failed.len(),
        results.records.len(),
        failed.join(", ")
    )))
}

fn make(out: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(out).map_err(|error| {
        Failure::Input(format!("cannot make the folder {}: {error}", out.display()))
    })
}
