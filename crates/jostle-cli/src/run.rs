//! `jostle run`: one analysis.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use jostle::stepping::{Progress, find_sensitivity, modal};
use jostle::{
    GroundMotion, Outcome, Plan, Pounding, Run, RunEnd, Settings, Solver, Summary, simulate,
};
use jostle_report::{Page, ReinforcedSection};

use crate::args::{RunArgs, SolverName};
use crate::failure::Failure;
use crate::open::Opened;
use crate::progress::TimeBar;
use crate::replace::{Kind, may_write};
use crate::{method, run_text, terminal};

/// Where results go when nothing else is said.
const RESULTS: &str = "jostle-out";

pub(crate) fn run(args: &RunArgs) -> Result<(), Failure> {
    let mut opened = args.model.open()?;
    if let Some(solver) = args.solver {
        opened.input.model.analysis.solver = match solver {
            SolverName::Auto => None,
            SolverName::Riccati => Some(Solver::Riccati),
            SolverName::Stiffness => Some(Solver::Stiffness),
            SolverName::Product => Some(Solver::Product),
            SolverName::Modal => Some(Solver::Modal),
        };
    }
    if args.members {
        follow_all_members(&mut opened)?;
    }
    opened.warn();
    let (motion, plan) = opened.plan()?;
    if let Some(warning) = opened.input.unusual_motion(&motion) {
        terminal::warn(&warning);
        opened.input.warnings.push(warning);
    }
    if let Err(refusal) = plan
        .check_digits(&opened.system)
        .map_err(|error| error.to_string())
    {
        if !args.force {
            let problem = format!("{refusal}; --force runs it all the same");
            return Err(opened.input.fault("analysis.solver", problem).into());
        }
        terminal::warn(&refusal);
    }
    let out = folder(args, &opened);
    if let Some(out) = &out {
        std::fs::create_dir_all(out).map_err(|error| {
            Failure::Input(format!("cannot make the folder {}: {error}", out.display()))
        })?;
        replace_earlier(out, args.force)?;
    }

    let stop = stop_on_interrupt();
    let started = Instant::now();
    // Energies are audited where histories are recorded, so that these are needed even where nobody writes them.
    // Modal stepping audits in every step, and rows cost it steps; so that numbers do not depend on whether they are
    // written, it goes without only where a summary is all that is wanted.
    let seen = out.is_some() || !args.no_report || plan.solver != Solver::Modal;
    let settings = Settings {
        record_interval: Settings::default().record_interval.filter(|_| seen),
        ..Settings::default()
    };
    // Both runs step the same shapes; what is wrong with them the run says.
    let shapes = (plan.solver == Solver::Modal)
        .then(|| modal::Reduction::of(&opened.system, &plan).ok())
        .flatten();
    let shapes = shapes.as_ref();
    let mut outcome = watch(&opened, &motion, &plan, settings, shapes, &stop);
    let wall = started.elapsed().as_secs_f64();
    let mut bar = TimeBar::new("sensitivity    ");
    let observer = shown_by(&mut bar, &stop);
    find_sensitivity(&opened.system, &motion, &plan, &mut outcome, observer);
    bar.finish();
    let model = &opened.input.model;
    let sum_up = |without_contact| {
        let mut summary = Summary::of(&Run {
            model,
            system: &opened.system,
            motion: &motion,
            plan: &plan,
            outcome: &outcome,
            without_contact,
            wall,
        });
        opened.input.add_notes(&mut summary);
        summary
    };
    let mut summary = sum_up(None);
    // Before the run without contact, so that nothing is lost if that one is ended by force.
    if let (Some(out), Some(history)) = (&out, &outcome.history) {
        jostle_io::write_history_parquet(&out.join("history.parquet"), model, &summary, history)?;
        jostle_io::write_impacts_parquet(&out.join("impacts.parquet"), &summary)?;
        if !outcome.springs.is_empty() {
            let path = out.join("hinges.parquet");
            jostle_io::write_hinges_parquet(&path, &opened.system, &outcome, &summary)?;
        }
        if let Some(history) = &outcome.member_history {
            let path = out.join("members.parquet");
            jostle_io::write_members_parquet(&path, &opened.system, history, &summary)?;
        }
        jostle_io::write_summary_json(&out.join("summary.json"), &summary)?;
    }

    let compares =
        !args.no_report && !opened.system.contacts.is_empty() && outcome.end == RunEnd::Completed;
    let without = compares.then(|| {
        let settings = Settings {
            pounding: Pounding::Excluded,
            ..settings
        };
        watch(&opened, &motion, &plan, settings, shapes, &stop)
    });
    let twin = without.as_ref().filter(|run| run.end == RunEnd::Completed);
    if let Some(run) = &without {
        summary = sum_up(twin);
        summary.notes.extend(not_compared(run, motion.duration));
    }
    if let (Some(out), Some(history)) = (&out, &outcome.history) {
        if !args.no_report {
            let without_contact = twin.and_then(|twin| twin.history.as_ref());
            let sections = reinforced(&opened);
            let methods = if args.method {
                method::survey(&opened.system)?
            } else {
                Vec::new()
            };
            let page = Page {
                model,
                motion: &motion,
                summary: &summary,
                history,
                without_contact,
                springs: outcome.spring_history.as_ref(),
                sections: &sections,
                methods: &methods,
            };
            jostle_io::write_atomically(
                &out.join("report.html"),
                jostle_report::render(&page).as_bytes(),
            )?;
        }
        if without.is_some() {
            jostle_io::write_summary_json(&out.join("summary.json"), &summary)?;
        }
    }
    if args.json {
        terminal::print(&jostle_io::summary_json(&summary))?;
    } else {
        let report = out.as_deref().map(|out| result(out, args.no_report));
        // Warnings of the model are on standard error already.
        let warnings = &opened.input.warnings;
        summary.notes.retain(|note| !warnings.contains(note));
        terminal::print(&run_text::describe(&summary, report.as_deref()))?;
    }
    ending(&outcome.end, out.as_deref())?;
    match without.map(|run| run.end) {
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

/// Asks for the greatest forces of all columns and beams.
fn follow_all_members(opened: &mut Opened) -> Result<(), Failure> {
    let model = &mut opened.input.model;
    model.analysis.members.envelopes = true;
    if let Err(faults) = model.check() {
        let problems: Vec<&str> = faults.iter().map(|fault| &fault.problem[..]).collect();
        return Err(Failure::Input(format!(
            "--members: {}",
            problems.join("; ")
        )));
    }
    opened.system.follow_members(&model.analysis.members);
    Ok(())
}

/// Why nothing is compared with a run without contact, if it did not reach its end.
fn not_compared(without: &Outcome, duration: f64) -> Option<String> {
    let reason = match &without.end {
        RunEnd::Completed => return None,
        RunEnd::Stopped => format!(
            "was interrupted at t = {:.3} s of {duration:.3} s",
            without.state.time
        ),
        RunEnd::Failed(error) => format!("failed: {error}"),
    };
    Some(format!(
        "the run without contact {reason}; nothing is compared with it"
    ))
}

/// The files of a run.
const FILES: [(&str, Kind); 6] = [
    ("summary.json", Kind::SUMMARY),
    ("history.parquet", Kind::TABLE),
    ("impacts.parquet", Kind::TABLE),
    ("hinges.parquet", Kind::TABLE),
    ("members.parquet", Kind::TABLE),
    ("report.html", Kind::REPORT),
];

/// Files of an earlier run in a folder, which a run replaces.
///
/// # Errors
/// A file is none of a run, and `force` is not given.
pub(crate) fn replaced_by_a_run(out: &Path, force: bool) -> Result<Vec<&'static str>, Failure> {
    let mut earlier = Vec::new();
    for (name, kind) in FILES {
        if may_write(&out.join(name), Some(kind), force)? {
            earlier.push(name);
        }
    }
    Ok(earlier)
}

/// Says that results of an earlier run go, and refuses to replace what is none.
fn replace_earlier(out: &Path, force: bool) -> Result<(), Failure> {
    let earlier = replaced_by_a_run(out, force)?;
    if !earlier.is_empty() {
        terminal::remark(&format!(
            "{} holds results of an earlier run, which are replaced: {}",
            out.display(),
            earlier.join(", ")
        ));
    }
    Ok(())
}

/// Reinforced sections of the model, alike ones told once.
fn reinforced(opened: &Opened) -> Vec<ReinforcedSection<'_>> {
    let mut sections: Vec<ReinforcedSection<'_>> = Vec::new();
    for member in &opened.input.reinforced {
        let alike = sections.iter_mut().find(|known| {
            known.building == member.building
                && known.member == member.member
                && *known.section == member.section
        });
        match alike {
            Some(known) => known.add(member.floor, member.compression),
            None => sections.push(ReinforcedSection {
                building: member.building,
                member: member.member,
                section: &member.section,
                floors: [member.floor; 2],
                compression: [member.compression; 2],
            }),
        }
    }
    sections
}

/// The folder for results, if any are to be written.
fn folder(args: &RunArgs, opened: &Opened) -> Option<PathBuf> {
    let default = || (!args.json).then(|| Path::new(RESULTS).join(&opened.name));
    args.out.clone().or_else(default)
}

/// The file that a user will want to open.
fn result(out: &Path, no_report: bool) -> PathBuf {
    out.join(if no_report {
        "summary.json"
    } else {
        "report.html"
    })
}

/// Set by Ctrl-C; a second one ends the program at once.
pub(crate) fn stop_on_interrupt() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&stop);
    // Without a handler Ctrl-C still stops the program, only less gently.
    let _ = ctrlc::set_handler(move || {
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    });
    stop
}

/// Runs with a progress bar, which appears only on a terminal and only if the run takes a while.
fn watch(
    opened: &Opened,
    motion: &GroundMotion,
    plan: &Plan,
    settings: Settings,
    shapes: Option<&modal::Reduction>,
    stop: &AtomicBool,
) -> Outcome {
    let mut bar = TimeBar::new(if settings.pounding == Pounding::Included {
        "pounding       "
    } else {
        "without contact"
    });
    let observer = shown_by(&mut bar, stop);
    let outcome = match shapes {
        Some(shapes) => modal::simulate(&opened.system, motion, plan, settings, shapes, observer),
        None => simulate(&opened.system, motion, plan, settings, observer),
    };
    bar.finish();
    outcome
}

/// An observer that shows the time reached and stops the run on Ctrl-C.
fn shown_by<'a>(
    bar: &'a mut TimeBar,
    stop: &'a AtomicBool,
) -> impl FnMut(Progress) -> ControlFlow<()> + use<'a> {
    move |Progress { time, duration }| {
        bar.show(time, duration);
        if stop.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

/// Whether the run counts as done.
fn ending(end: &RunEnd, out: Option<&Path>) -> Result<(), Failure> {
    let kept = out.map_or_else(String::new, |out| {
        format!("; what was computed until then is in {}", out.display())
    });
    match end {
        RunEnd::Completed => Ok(()),
        RunEnd::Stopped => {
            terminal::remark(&format!("stopped{kept}"));
            Err(Failure::Stopped)
        }
        RunEnd::Failed(error) => Err(Failure::Analysis(format!("{error}{kept}"))),
    }
}
