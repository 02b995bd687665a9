//! `jostle study`: many cases of one model.

mod columns;

use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::time::Instant;

use jostle_io::shown::follow;
use jostle_io::{Dimension, ModelTree, StudyFile, parse_option};
use jostle_study::{
    Done, Incidence, Progress, RunSettings, Study, StudyError, of_folder, run, run_case,
    run_folder, settle, varied,
};

use crate::failure::Failure;
use crate::progress::Bar;
use crate::stop::stop_on_interrupt;
use crate::terminal;
use jostle_run::{counted_grouped, grouped};

/// Default folder of results.
const RESULTS: &str = "jostle-out";
/// Name of the study with options of its own.
const ANGLES: &str = "angles";

#[derive(Debug, clap::Args)]
#[command(after_help = "The same command resumes after any interruption.\n\
                  Ready-made studies: table2, gap-sweep, ida, fragility, sensitivity, tornado, angles;\n  \
                  jostle study gap-sweep model.toml\n  \
                  jostle study angles model.toml --step 10deg")]
pub(crate) struct StudyArgs {
    /// Study file (TOML or JSON), the name of a ready-made study, or a results folder to continue
    study: PathBuf,
    /// Model of a ready-made study: a file, or the name of a built-in example; the same as --base
    #[arg(conflicts_with = "base")]
    model: Option<PathBuf>,
    /// angles: step between angles of incidence [default: 5deg]
    #[arg(long, value_name = "QUANTITY")]
    step: Option<String>,
    /// angles: first angle, from x counter-clockwise [default: 0deg]
    #[arg(long, value_name = "QUANTITY", allow_hyphen_values = true)]
    from: Option<String>,
    /// angles: last angle [default: full circle]
    #[arg(long, value_name = "QUANTITY", allow_hyphen_values = true)]
    to: Option<String>,
    /// angles: plot this column of the table against the angle; may be repeated [default: forces, impacts, peaks of buildings]
    #[arg(long, value_name = "COLUMN")]
    quantity: Vec<String>,
    /// Use this base model: a file, or the name of a built-in example
    #[arg(long, value_name = "MODEL")]
    base: Option<PathBuf>,
    /// Folder for the results [default: jostle-out/STUDY, or jostle-out/MODEL-STUDY for a ready-made study of a given model]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Number of threads [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    jobs: Option<u32>,
    /// Run only the I-th of N equal shares, for job arrays; all may use one folder
    #[arg(long, value_name = "I/N", value_parser = shard)]
    shard: Option<(u64, u64)>,
    /// Run only this case, with histories and report, in runs/ of the folder; may be repeated
    #[arg(long, value_name = "NUMBER", conflicts_with = "shard")]
    case: Vec<u64>,
    /// Omit the report and its tables when all cases are finished
    #[arg(long)]
    no_report: bool,
    /// Write cases.csv even for more than 200 000 cases
    #[arg(long, conflicts_with = "no_report")]
    csv: bool,
    /// Continue in a folder that another build of jostle started
    #[arg(long)]
    any_build: bool,
    /// Check the study and print the number of cases and the columns; run nothing
    #[arg(long)]
    check: bool,
}

/// `3/8`: the third of eight.
pub(crate) fn shard(text: &str) -> Result<(u64, u64), String> {
    let number = |text: &str| text.trim().parse::<u64>().ok();
    let parsed = text
        .split_once('/')
        .and_then(|(index, of)| Some((number(index)?, number(of)?)));
    match parsed {
        Some((index, of)) if 1 <= index && index <= of => Ok((index - 1, of)),
        _ => Err("expected I/N with I from 1 to N, such as 3/8".into()),
    }
}

pub(crate) fn study(args: &StudyArgs) -> Result<(), Failure> {
    let (mut study, out) = open(args)?;
    study.any_build = args.any_build;
    follow(study.file.base.units());
    for text in &study.warnings {
        terminal::remark(&warning(text));
    }
    if args.check {
        return terminal::print(&description(&study));
    }
    std::fs::create_dir_all(&out).map_err(|error| {
        Failure::Input(format!("cannot make the folder {}: {error}", out.display()))
    })?;
    let flag = stop_on_interrupt();
    let stop = || flag.load(Ordering::Relaxed);
    if !args.case.is_empty() {
        return single(args, &study, &out, &stop);
    }
    terminal::remark(&headline(&study));
    let (shard, shards) = args.shard.unwrap_or((0, 1));
    let settings = RunSettings {
        jobs: args.jobs.map(|jobs| jobs as usize),
        shard,
        shards,
        only: None,
    };
    let started = Instant::now();
    let bar = Bar::new("");
    let show = |progress: Progress| {
        let (finished, cases) = (progress.finished, progress.cases);
        bar.show(finished as f64 / cases.max(1) as f64, || {
            // Cases of earlier runs do not count for the rate.
            let rate = progress.computed as f64 / started.elapsed().as_secs_f64().max(1e-3);
            format!("{finished} of {cases} cases, {rate:.1} per second")
        });
    };
    let remark = |text: &str| bar.remark(&warning(text));
    let done = run(&study, &out, &settings, &stop, &show, &remark);
    bar.finish();
    let done = done?;
    terminal::print(&outcome(
        &study,
        &done,
        &out,
        started.elapsed().as_secs_f64(),
    ))?;
    if done.stopped {
        return Err(Failure::Stopped);
    }
    if done.complete && !args.no_report {
        let written = jostle_study::finish(&study, &out, args.csv)?;
        terminal::print(&written)?;
    }
    Ok(())
}

fn warning(text: &str) -> String {
    format!(
        "{} {text}",
        jostle_run::styled(jostle_run::LOUD, "warning:")
    )
}

/// The study, and the folder for its results.
fn open(args: &StudyArgs) -> Result<(Study, PathBuf), Failure> {
    let path = &args.study;
    if path.is_dir() {
        if args.base.is_some() {
            return Err(Failure::Input(format!(
                "--base: {} is a folder of results, which has its base model in its manifest.json; omit --base",
                path.display()
            )));
        }
        let known = of_folder(path)?.ok_or_else(|| {
            Failure::Input(format!(
                "{} is a folder without a manifest.json; name a study file, or a folder of results",
                path.display()
            ))
        })?;
        return Ok((known, args.out.clone().unwrap_or_else(|| path.clone())));
    }
    let named = path.to_str().filter(|_| !path.exists());
    let ready = named.filter(|name| jostle_study::ready_made_names().contains(name));
    if let (None, Some(model)) = (ready, &args.model) {
        return Err(Failure::Input(format!(
            "{}: only ready-made studies take a model, and {} is none; give the base model of a study file with --base",
            model.display(),
            path.display()
        )));
    }
    let incidence = args.incidence(ready)?;
    let stem = args.model.as_deref().map(jostle_run::name_of);
    let name = match (ready, stem) {
        (Some(name), Some(model)) => format!("{model}-{name}"),
        (Some(name), None) => name.to_owned(),
        (None, _) => jostle_run::name_of(path),
    };
    let out = args
        .out
        .clone()
        .unwrap_or_else(|| Path::new(RESULTS).join(name));
    // A single case belongs to the results in the folder: it has their base model.
    if !args.case.is_empty()
        && args.base.is_none()
        && args.model.is_none()
        && let Some(known) = of_folder(&out)?
    {
        let same = match ready {
            Some(name) => known.file.name() == name,
            None => StudyFile::text_of(path).is_ok_and(|text| text == known.file.text()),
        };
        if same {
            return Ok((known, out));
        }
    }
    let base = args.base.as_deref().or(args.model.as_deref());
    let base = base.map(ModelTree::find).transpose()?;
    let (file, notes) = match (ready, base) {
        (Some(ANGLES), None) => {
            return Err(Failure::Input(
                "angles: name a model whose buildings have a plan: jostle study angles model.toml"
                    .into(),
            ));
        }
        (Some(ANGLES), Some(base)) => jostle_study::incidence(base, &incidence)?,
        (Some(name), base) => jostle_study::ready_made(name, base)?,
        (None, base) => (StudyFile::load(path, base)?, Vec::new()),
    };
    let mut study = Study::new(file)?;
    study.warnings.extend(notes);
    Ok((study, out))
}

impl StudyArgs {
    /// Range of angles; refused for other studies.
    fn incidence(&self, ready: Option<&str>) -> Result<Incidence, Failure> {
        let options = [
            ("--step", &self.step),
            ("--from", &self.from),
            ("--to", &self.to),
        ];
        if ready != Some(ANGLES) {
            let given = options.iter().find(|(_, value)| value.is_some());
            let quantity = (!self.quantity.is_empty()).then_some("--quantity");
            if let Some(name) = given.map(|(name, _)| *name).or(quantity) {
                return Err(Failure::Input(format!(
                    "{name}: belongs to jostle study angles; study files say what varies themselves"
                )));
            }
        }
        let angle = |index: usize| -> Result<Option<f64>, Failure> {
            let (name, value) = options[index];
            let Some(text) = value else { return Ok(None) };
            let parsed = parse_option(name, text, Dimension::Dimensionless);
            let radians = parsed.map_err(Failure::Input)?;
            // 30 deg is not 30.000000000000004°.
            Ok(Some((radians.to_degrees() * 1e9).round() / 1e9))
        };
        let usual = Incidence::default();
        let from = angle(1)?.unwrap_or(usual.from);
        let incidence = Incidence {
            from,
            to: angle(2)?.unwrap_or(from + usual.to),
            step: angle(0)?.unwrap_or(usual.step),
            quantities: self.quantity.clone(),
        };
        if let Err(problem) = incidence.angles() {
            return Err(Failure::Input(format!("--from, --to, --step: {problem}")));
        }
        Ok(incidence)
    }
}

fn headline(study: &Study) -> String {
    let design = &study.file.design;
    let seed = if design.samples.is_some() {
        format!(", seed {}", design.seed)
    } else {
        String::new()
    };
    let inputs: Vec<&str> = study.layout.inputs.iter().map(|c| &c.name[..]).collect();
    let mut text = format!(
        "{}: {}{seed}, over {}",
        jostle_run::styled(jostle_run::BOLD, &study.file.title),
        counted_grouped(study.design.cases, "case"),
        inputs.join(", ")
    );
    for one in varied(study) {
        text += &format!("\n  {}", one.text());
    }
    text
}

fn description(study: &Study) -> String {
    let names = study.layout.names();
    format!(
        "{}\n{} in {}; fingerprint {}\n{} columns:\n{}",
        headline(study),
        counted_grouped(study.design.cases, "row"),
        counted_grouped(study.parts(), "part"),
        study.fingerprint,
        names.len(),
        columns::by_owner(&names)
    )
}

fn single(
    args: &StudyArgs,
    study: &Study,
    out: &Path,
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<(), Failure> {
    if let Some(case) = args.case.iter().find(|case| **case >= study.design.cases) {
        return Err(Failure::Input(format!(
            "--case: there is no case {case}; there are {}, counted from 0",
            grouped(study.design.cases)
        )));
    }
    settle(study, out)?;
    for &case in &args.case {
        let folder = run_folder(out, case);
        if !run_case(study, case, &folder, stop)? {
            return Err(Failure::Stopped);
        }
        terminal::print(&folder.join("report.html").display().to_string())?;
    }
    Ok(())
}

fn outcome(study: &Study, done: &Done, out: &Path, wall: f64) -> String {
    let progress = done.progress;
    let rate = if progress.computed > 0 {
        format!(
            " ({} now, {:.1} per second)",
            grouped(progress.computed),
            progress.computed as f64 / wall.max(1e-9)
        )
    } else {
        String::new()
    };
    let mut lines = vec![format!(
        "{} of {} finished{rate}",
        grouped(progress.finished),
        counted_grouped(progress.cases, "case")
    )];
    if done.failed > 0 {
        lines.push(format!(
            "{} could not be computed: see the columns status and reason",
            counted_grouped(done.failed, "case")
        ));
    }
    if done.stopped {
        lines.push("stopped; the same command resumes from here".to_owned());
    } else if !done.complete {
        let missing = (0..study.parts())
            .filter(|part| !jostle_study::dataset::part_path(out, study.part(*part).start).exists())
            .count();
        lines.push(format!(
            "{} of other shards {} still missing",
            counted_grouped(missing as u64, "part"),
            if missing == 1 { "is" } else { "are" }
        ));
    }
    lines.push(format!(
        "table: {}",
        out.join("cases").join("*.parquet").display()
    ));
    lines.join("\n")
}

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::Output(_) => Self::Analysis(error.to_string()),
            _ => Self::Input(error.to_string()),
        }
    }
}
