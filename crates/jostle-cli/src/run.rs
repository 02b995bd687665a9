//! `jostle run`: one analysis.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use jostle::method::MethodSurvey;
use jostle::results::gradient::Gradient;
use jostle::{Outcome, RunEnd, Solver};
use jostle_io::{FloorSpectraRequest, ModelTree, TreeValue};
use jostle_run::{
    Content, EXAMPLE, FileKind, FolderClaim, GradientRequest, Opened, Pace, Prepared, Ran, Results,
    Stage, describe_summary, earlier_files, grouped, may_write, stopped_by,
};
use jostle_section::capacity::CapacityRule;

use crate::args::{RunArgs, SolverName};
use crate::failure::Failure;
use crate::printer::Printer;
use crate::progress::{Bar, StageBar};
use crate::replace::Target;
use crate::stop::stop_on_interrupt;
use crate::terminal;

/// Time after which the speed of a run is known \[s\].
const PATIENCE: f64 = 1.0;
/// Expected time of a run from which it is said what it takes \[s\].
const LONG: f64 = 5.0;

/// Default folder of results.
const RESULTS: &str = "jostle-out";

pub(crate) fn run(args: &RunArgs) -> Result<(), Failure> {
    let mut opened = args.model.open()?;
    let printer = Printer::find(args)?;
    if let Some(solver) = args.solver {
        Arc::make_mut(&mut opened.input).model.analysis.solver = match solver {
            SolverName::Auto => None,
            SolverName::Riccati => Some(Solver::Riccati),
            SolverName::Stiffness => Some(Solver::Stiffness),
            SolverName::Product => Some(Solver::Product),
            SolverName::Modal => Some(Solver::Modal),
            SolverName::Series => Some(Solver::Series),
        };
    }
    if args.members || !args.capacity.is_empty() {
        follow_members(&mut opened, &args.capacity)?;
    }
    if args.floor_spectra && opened.input.floor_spectra.is_none() {
        let input = Arc::make_mut(&mut opened.input);
        let all = FloorSpectraRequest::of_all_floors(&input.model.buildings);
        input.floor_spectra = Some(all);
    }
    if opened.input.records().len() > 1 {
        if !args.gradients.is_empty() {
            return Err(Failure::Input(
                "--gradients: goes with one record; choose it with --record".to_owned(),
            ));
        }
        let out = folder(args, &opened.name);
        return crate::suite::run(args, &opened, out, printer.as_ref());
    }
    for (option, given) in [
        ("--governing", args.governing.is_some()),
        ("--jobs", args.jobs.is_some()),
    ] {
        if given {
            return Err(Failure::Input(format!(
                "{option}: goes with a model of several records, record = [\"a.at2\", \"b.at2\"]; this run has one"
            )));
        }
    }
    let gradients = wanted_gradients(args)?;
    let of_model = opened.input.warnings.len();
    terminal::warn_of_model(&opened.input, &opened.input.warnings);
    let prepared = opened.prepare()?;
    terminal::warn_of_model(&prepared.input, &prepared.input.warnings[of_model..]);
    if args.force {
        terminal::warn_all(&prepared.lost_digits());
    } else {
        prepared.check_digits(Some("--force runs it anyway"))?;
    }
    let out = folder(args, &opened.name);
    let settings = prepared.settings(out.is_some() || !args.no_report);
    if !args.force {
        let both = !args.no_report;
        prepared.check_histories(settings, both, Some("--force runs it anyway"))?;
    }
    let workbook = Target::of_option(args.xlsx.as_ref(), FileKind::WORKBOOK, args.force)?;
    let mut claim = None;
    if let Some(out) = &out {
        std::fs::create_dir_all(out).map_err(|error| {
            Failure::Input(format!("cannot make the folder {}: {error}", out.display()))
        })?;
        claim = Some(FolderClaim::new(out)?);
        replace_earlier(out, args.force)?;
        if printer.is_some() {
            may_write(&out.join("report.pdf"), Some(FileKind::PDF), args.force)?;
        }
    }
    let analysed = analyse(
        args,
        prepared,
        out.as_deref(),
        printer.as_ref(),
        workbook.as_ref(),
        gradients.as_ref(),
        &stop_on_interrupt(),
    );
    drop(claim);
    analysed
}

/// Runs, writes and prints.
fn analyse(
    args: &RunArgs,
    prepared: Prepared,
    out: Option<&Path>,
    printer: Option<&Printer>,
    workbook: Option<&Target>,
    gradients: Option<&GradientRequest>,
    stop: &AtomicBool,
) -> Result<(), Failure> {
    let settings = prepared.settings(out.is_some() || !args.no_report);
    let mut bar = StageBar::default();
    let expected = prepared.expect(settings, !args.no_report);
    let mut pace = Some(Pace::new(&prepared));
    let mut observer = stopped_by(stop, |stage, progress| {
        if let Some(running) = &mut pace {
            let [elapsed, seconds] = running.look(progress);
            let known = elapsed > PATIENCE && seconds.is_finite();
            if stage != Stage::Pounding || known {
                if known && stage == Stage::Pounding && seconds > LONG {
                    terminal::remark(&format!(
                        "expected: {} steps, {}",
                        grouped(expected.steps),
                        expected.text(seconds)
                    ));
                }
                pace = None;
            }
        }
        bar.show(stage, progress.time, progress.duration);
    });
    let mut ran = prepared.run(settings, &mut observer);
    let mut summary = ran.summary();
    // Before the run without contact, so that nothing is lost if that one is ended by force.
    if let Some(out) = out {
        ran.results(&summary).write(out, Content::TABLES)?;
    }
    if !args.no_report {
        ran.run_without_contact(settings, &mut observer);
        summary = ran.summary();
    }
    if args.sensitivity {
        ran.run_other_contacts(&mut observer);
    }
    ran.run_isolation_bounds(ran.without_contact.is_some(), &mut observer);
    if ran.has_variants() {
        summary = ran.summary();
    }
    drop(observer);
    bar.finish();
    if let Some(request) = gradients {
        ran.gradients = found_gradients(request, stop)?;
        summary = ran.summary();
    }
    if let Some(out) = out.filter(|_| args.no_report && ran.has_variants()) {
        ran.results(&summary).write(out, Content::TABLES)?;
    }
    if let Some(out) = out.filter(|_| !args.no_report) {
        let methods = surveys(args, &ran)?;
        let results = Results {
            methods: &methods,
            ..ran.results(&summary)
        };
        results.write(out, Content::REPORT)?;
        if let Some(printer) = printer {
            printer.print(&out.join("report.html"))?;
        }
    }
    if let Some(target) = workbook {
        let bytes = jostle_run::workbook(&summary)
            .map_err(|problem| Failure::Analysis(format!("--xlsx: {problem}")))?;
        jostle_io::write_atomically(&target.path, &bytes)?;
        target.written();
    }
    if args.json {
        terminal::print(&jostle_io::summary_json(&summary))?;
    } else {
        let report = out.map(|out| result(out, args.no_report));
        // Warnings of the model are on standard error already.
        let warnings = &ran.prepared.input.warnings;
        summary.notes.retain(|note| !warnings.contains(note));
        terminal::print(&describe_summary(
            &summary,
            &ran.prepared.input,
            report.as_deref(),
        ))?;
    }
    ending(&ran.outcome, out)?;
    let failed = ran.contact_sensitivity.as_ref().is_some_and(Result::is_err)
        || ran.isolation_bounds.as_ref().is_some_and(Result::is_err);
    if stop.load(Ordering::Relaxed) && failed {
        terminal::remark(
            "stopped in the runs with other contacts or bearings; the run itself is complete",
        );
        return Err(Failure::Stopped);
    }
    match ran.without_contact.map(|run| run.end) {
        Some(RunEnd::Stopped) => {
            let kept = out.map_or_else(String::new, |out| format!(" and is in {}", out.display()));
            terminal::remark(&format!(
                "stopped in the run without contact; the run with contact is complete{kept}"
            ));
            Err(Failure::Stopped)
        }
        _ => Ok(()),
    }
}

/// What `--gradients` asks for, if it is given.
fn wanted_gradients(args: &RunArgs) -> Result<Option<GradientRequest>, Failure> {
    if args.gradients.is_empty() {
        return Ok(None);
    }
    let model = &args.model;
    let path = model.model.as_deref().unwrap_or(Path::new(EXAMPLE));
    let mut tree = ModelTree::find(path)?;
    if model.accept_unusual {
        tree.set("analysis.accept_unusual", &TreeValue::Flag(true))
            .map_err(|error| Failure::Input(error.to_string()))?;
    }
    let request = GradientRequest::new(tree, &args.gradients, &model.overrides()?)?;
    Ok(Some(request))
}

/// Derivatives of the peaks; empty, with a remark, if they were stopped.
fn found_gradients(request: &GradientRequest, stop: &AtomicBool) -> Result<Vec<Gradient>, Failure> {
    let bar = Bar::new("");
    let found = request.gradients(&|| stop.load(Ordering::Relaxed), &|done, of| {
        bar.show_count(done, of, "runs for gradients");
    });
    bar.finish();
    Ok(found?.unwrap_or_else(|| {
        terminal::remark("stopped in the runs for gradients; the run itself is complete");
        Vec::new()
    }))
}

/// Asks for the greatest forces of all columns and beams, and for demands over capacities by these rules; by those of the
/// model file, or all where capacities are known, if none is named.
fn follow_members(opened: &mut Opened, rules: &[String]) -> Result<(), Failure> {
    let input = Arc::make_mut(&mut opened.input);
    let rules: Vec<CapacityRule> = rules
        .iter()
        .filter_map(|name| CapacityRule::from_name(name))
        .collect();
    if rules.is_empty() {
        input.ask_for_members();
    } else {
        input.ask_for_capacity(&rules);
        if input.model.analysis.members.capacities.is_empty() {
            let missing = match input.members.reinforced.is_empty() {
                true => {
                    "no member has bars; add steel = \"HRB400\", bars = \"12 d20\", ties = \"d10 @ 100 mm\" to column, and likewise to beam; or yield_strength = \"355 MPa\" to a profile, with the rule aisc360"
                }
                false => {
                    "members have bars, but no ties; add ties = \"d10 @ 100 mm\" to column, and likewise to beam"
                }
            };
            return Err(Failure::Input(format!("--capacity: {missing}")));
        }
    }
    let model = &input.model;
    if let Err(faults) = model.check() {
        let problems: Vec<&str> = faults.iter().map(|fault| &fault.problem[..]).collect();
        return Err(Failure::Input(format!(
            "--members: {}",
            problems.join("; ")
        )));
    }
    Arc::make_mut(&mut opened.system).follow_members(&model.analysis.members);
    Ok(())
}

/// Surveys of the method for the report, if they were asked for.
fn surveys(args: &RunArgs, ran: &Ran) -> Result<Vec<MethodSurvey>, Failure> {
    if args.method {
        Ok(jostle_run::survey_methods(&ran.prepared.system)?)
    } else {
        Ok(Vec::new())
    }
}

/// Reports that results of an earlier run are replaced, and refuses to replace other files.
fn replace_earlier(out: &Path, force: bool) -> Result<(), Failure> {
    let earlier = earlier_files(out, force)?;
    if !earlier.is_empty() {
        terminal::remark(&format!(
            "{} holds results of an earlier run, which are replaced: {}",
            out.display(),
            earlier.join(", ")
        ));
    }
    Ok(())
}

/// The folder for results, if any are to be written.
fn folder(args: &RunArgs, name: &str) -> Option<PathBuf> {
    let default = || (!args.json).then(|| Path::new(RESULTS).join(name));
    args.out.clone().or_else(default)
}

/// The main result file.
fn result(out: &Path, no_report: bool) -> PathBuf {
    out.join(if no_report {
        "summary.json"
    } else {
        "report.html"
    })
}

/// Whether the run counts as done.
fn ending(outcome: &Outcome, out: Option<&Path>) -> Result<(), Failure> {
    let kept = out.map_or_else(String::new, |out| {
        format!("; results up to then are in {}", out.display())
    });
    if outcome.interrupted {
        let kept = out.map_or_else(String::new, |out| format!(" and is in {}", out.display()));
        terminal::remark(&format!(
            "stopped while the run was repeated with other steps to meet the tolerance; the run before is complete{kept}"
        ));
        return Err(Failure::Stopped);
    }
    match &outcome.end {
        RunEnd::Completed => Ok(()),
        RunEnd::Stopped => {
            terminal::remark(&format!("stopped{kept}"));
            Err(Failure::Stopped)
        }
        RunEnd::Failed(error) => Err(Failure::Analysis(format!("{error}{kept}"))),
    }
}
