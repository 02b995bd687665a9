//! `jostle gap`: the smallest gap without pounding, compared with rules and codes.

use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

use jostle::separation::{Code, CodeInputs, JointSystem};
use jostle_io::shown::{FORCE, GROUND_ACCELERATION, HEIGHT, LENGTH};
use jostle_io::{Dimension, parse_option};
use jostle_study::{CriticalGap, GapError, GapProgress, GapSettings, search_gaps};

use crate::args::ModelArgs;
use crate::failure::Failure;
use crate::progress::Bar;
use crate::stop::stop_on_interrupt;
use crate::terminal;
use jostle_report::{required_width, rows_of_rules};
use jostle_run::{
    GAP_PAGE, RuleGap, counted, earlier_gap_files, gap_json, gap_sets, write_gap_files,
};

#[derive(Debug, clap::Args)]
pub(crate) struct GapArgs {
    /// Model file (TOML or JSON), or the name of a built-in example; without it, the built-in "paper"
    model: Option<PathBuf>,
    /// Scale the motions to this peak ground acceleration
    #[arg(long, value_name = "QUANTITY")]
    pga: Option<String>,
    /// Use this ground motion: a built-in name or a file; repeat for a set of records [default: all records of the model]
    #[arg(long, value_name = "RECORD")]
    record: Vec<String>,
    /// Precision of the gap
    #[arg(long, value_name = "QUANTITY", default_value = "0.1mm")]
    tolerance: String,
    /// Structural system for GB 50011: that of the building that requires the wider joint [default: codes.system of the model,
    /// else frame]
    #[arg(long, value_name = "SYSTEM", value_parser = JointSystem::ALL.map(JointSystem::name))]
    system: Option<String>,
    /// List the rules of this code only; repeat for several [default: codes.show of the model, else all]
    #[arg(long, value_name = "CODE", value_parser = Code::ALL.map(Code::name))]
    code: Vec<String>,
    /// Accept values outside their usual ranges, like accept_unusual = true in the model file
    #[arg(long)]
    accept_unusual: bool,
    /// Do not run the model with the gaps that the rules require
    #[arg(long)]
    no_outcomes: bool,
    /// Also compute force and impacts at N equally spaced widths from zero to the gap needed, 2 to 10000
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=10_000))]
    curve: Option<u32>,
    /// Folder for the page, the numbers and the tables [default: jostle-out/MODEL-gap; with --json, none]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace files in the folder that jostle did not write
    #[arg(long)]
    force: bool,
    /// Print JSON and nothing else
    #[arg(long)]
    json: bool,
}

pub(crate) fn gap(args: &GapArgs) -> Result<(), Failure> {
    let tolerance =
        parse_option("--tolerance", &args.tolerance, Dimension::Length).map_err(Failure::Input)?;
    if tolerance < 1e-9 {
        return Err(Failure::Input(
            "--tolerance: must be at least 1e-9 m".into(),
        ));
    }
    let flag = stop_on_interrupt();
    let stop = || flag.load(Ordering::Relaxed);
    let records: Vec<Option<String>> = if args.record.is_empty() {
        vec![None]
    } else {
        args.record.iter().cloned().map(Some).collect()
    };
    let mut found: Vec<CriticalGap> = Vec::new();
    let (mut title, mut notes) = (String::new(), Vec::new());
    let mut out = None;
    let (mut searched, mut stopped) = (0, false);
    'records: for record in &records {
        let model = ModelArgs {
            model: args.model.clone(),
            pga: args.pga.clone(),
            angle: None,
            gap: None,
            record: record.clone(),
            accept_unusual: args.accept_unusual,
        };
        let opened = model.open()?;
        let settings = GapSettings {
            tolerance,
            codes: args.codes(&opened.input.codes),
            outcomes: !args.no_outcomes,
            reversed: true,
            curve: args.curve.map_or(0, |points| points as usize),
        };
        if out.is_none() {
            out = args.folder(&opened.name)?;
        }
        title.clone_from(&opened.input.model.title);
        for warning in &opened.input.warnings {
            note(&mut notes, &opened.input.with_line(warning));
        }
        let inputs = opened.input.each_record();
        let of = inputs.len() * records.len();
        for input in inputs {
            let (motion, _) = opened.plan_of(&input)?;
            if let Some(warning) = input.unusual_motion(&motion) {
                note(&mut notes, &input.with_line(&warning));
            }
            searched += 1;
            let prefix = match of {
                1 => motion.name.clone(),
                _ => format!("{} ({searched} of {of})", motion.name),
            };
            let bar = Bar::new(&prefix);
            let report = |progress: &GapProgress| {
                let GapProgress { between, done, of } = progress;
                // The search itself shows how many runs it needs.
                bar.show_open(done / (*of).max(1) as f64, || {
                    let runs = format!("{} of at least {of} runs", done.floor());
                    match between {
                        Some(between) => format!("{}, {runs}", between.join(" ↔ ")),
                        None => runs,
                    }
                });
            };
            let search = search_gaps(&input.model, &motion, &settings, &stop, &report);
            bar.finish();
            match search {
                Ok(search) => {
                    found.extend(search.gaps);
                    stopped = search.stopped;
                }
                Err(GapError::Stopped) => stopped = true,
                Err(error @ GapError::Run(_)) => {
                    return Err(Failure::Analysis(error.to_string()));
                }
                Err(error) => return Err(input.fault("gap", error.to_string()).into()),
            }
            if stopped {
                break 'records;
            }
        }
    }
    if stopped {
        let rest = "stopped: what follows lacks the records and outcomes that were not run";
        note(&mut notes, rest);
        if found.is_empty() {
            return Err(Failure::Stopped);
        }
    }
    if let Some(out) = &out {
        write_gap_files(out, &title, &found, &notes)?;
    }
    if args.json {
        terminal::print(&gap_json(&title, &found, &notes))?;
    } else {
        let mut text = describe(&title, &found);
        if let Some(out) = &out {
            text += &format!("→ {}\n", out.join(GAP_PAGE).display());
        }
        terminal::print(&text)?;
    }
    match stopped {
        true => Err(Failure::Stopped),
        false => Ok(()),
    }
}

impl GapArgs {
    /// The folder for files, made and looked through, if some are to be written.
    fn folder(&self, name: &str) -> Result<Option<PathBuf>, Failure> {
        let default = || (!self.json).then(|| Path::new("jostle-out").join(format!("{name}-gap")));
        let Some(out) = self.out.clone().or_else(default) else {
            return Ok(None);
        };
        std::fs::create_dir_all(&out).map_err(|error| {
            Failure::Input(format!("cannot make the folder {}: {error}", out.display()))
        })?;
        let earlier = earlier_gap_files(&out, self.force)?;
        if !earlier.is_empty() {
            terminal::remark(&format!(
                "{} holds results of an earlier search, which are replaced: {}",
                out.display(),
                earlier.join(", ")
            ));
        }
        Ok(Some(out))
    }

    /// Inputs of the model, changed by the options.
    fn codes(&self, of_model: &CodeInputs) -> CodeInputs {
        let mut codes = of_model.clone();
        if let Some(system) = self.system.as_deref().and_then(JointSystem::named) {
            codes.system = Some(system);
        }
        if !self.code.is_empty() {
            codes.shown = self
                .code
                .iter()
                .filter_map(|name| Code::named(name))
                .collect();
        }
        codes
    }
}

/// Prints a warning once and keeps it for the notes.
fn note(notes: &mut Vec<String>, warning: &str) {
    if !notes.iter().any(|known| known == warning) {
        terminal::warn(warning);
        notes.push(warning.to_owned());
    }
}

/// The gaps beside those of rules and codes, as text.
pub(crate) fn describe(title: &str, found: &[CriticalGap]) -> String {
    let mut text = format!("{}\n", jostle_run::styled(jostle_run::BOLD, title));
    for gap in found {
        text += &format!(
            "\n{}  under {}, {}\n",
            gap.between.join(" ↔ "),
            gap.motion,
            GROUND_ACCELERATION.text(gap.pga_m_s2, 1)
        );
        if gap.motion_is_reduced {
            text += "  The motion is reduced (motion = \"reduced\" under [codes]), and so are the gap needed, ABS, SRSS and DDC.\n  Code gaps refer to the full motion: run it in full to compare them.\n";
        }
        let bracket = match gap.pounding_at_m {
            Some(hit) => format!("at {} there is an impact", millimetres(hit)),
            None => "no impact even if they touch at rest".to_owned(),
        };
        let reversed = gap.reversed_gap_m.map_or_else(String::new, |reversed| {
            format!(", {} with the motion reversed", required_width(reversed))
        });
        text += &format!(
            "  gap needed {}{reversed}  ({bracket}; {}, closest at {})\n",
            jostle_run::styled(jostle_run::BOLD, &required_width(gap.gap_m)),
            counted(gap.runs, "run"),
            HEIGHT.text(gap.height_m, 2)
        );
        if let Some([lower, upper]) = gap.gap_at_bounds_m {
            text += &format!(
                "  over the bounds of the bearings {}  (lower {}, upper {}, the larger of the two signs; rules are compared with it)\n",
                jostle_run::styled(jostle_run::BOLD, &required_width(gap.needed_m())),
                required_width(lower),
                required_width(upper)
            );
        }
        if let Some(rho) = gap.ddc_correlation {
            text += &format!(
                "  periods {:.3} and {:.3} s, damping {:.1} and {:.1} %, correlation {rho:.4}\n",
                gap.periods_s[0],
                gap.periods_s[1],
                100.0 * gap.damping[0],
                100.0 * gap.damping[1]
            );
        }
        let has_outcomes = gap.rules.iter().any(|rule| rule.worse_outcome().is_some());
        text += "  rule                       gap     ÷ needed";
        text += match (has_outcomes, gap.gap_at_bounds_m.is_some()) {
            (true, false) => "   outcome with this gap, worse of both signs\n",
            (true, true) => "   outcome with this gap and nominal bearings, worse of both signs\n",
            (false, _) => "\n",
        };
        for (name, rule) in rows_of_rules(&gap.rules, |rule| (&rule.rule, rule.gap_m)) {
            let ratio = rule
                .ratio_of_both_signs
                .or(rule.ratio)
                .map_or("–".to_owned(), |ratio| format!("{ratio:.2}"));
            let led = outcome(rule);
            let line = format!(
                "  {name:<24} {:>9}   {ratio:>7}   {led}",
                required_width(rule.gap_m)
            );
            text += line.trim_end();
            text.push('\n');
        }
        text += &inputs(gap);
    }
    let mut pairs = found.iter().map(|gap| &gap.between);
    if pairs
        .next()
        .is_some_and(|first| pairs.any(|pair| pair != first))
    {
        text += "\nEach gap is searched while the others are out of reach: impacts at other gaps can make it close by more.\n";
    }
    let mut fewest = usize::MAX;
    for set in gap_sets(found) {
        let records = set.gaps.len();
        fewest = fewest.min(records);
        if records > 1 {
            text += &format!(
                "\n{} over {}, the larger of the two signs: greatest {}, mean {}, standard deviation {}\n",
                set.governing.between.join(" ↔ "),
                counted(records, "record"),
                required_width(set.governing.needed_m()),
                LENGTH.text(set.mean_m, 1),
                LENGTH.text(set.deviation_m, 1)
            );
        }
    }
    if fewest < FEW_RECORDS {
        text += &format!(
            "\n{} not give a design value: codes require 3, 7 or 11 records.",
            match fewest {
                1 => "One record does".to_owned(),
                several => format!("{} do", counted(several, "record")),
            }
        );
    } else {
        text += "\nYou are responsible for the choice of records.";
    }
    text + " Code gaps are minimum values: add construction tolerance, temperature and tilt.\n"
}

/// What a gap leads to, by the sign of the motion with the greater force.
fn outcome(rule: &RuleGap) -> String {
    let Some(worse) = rule.worse_outcome() else {
        return String::new();
    };
    if worse.impact_count == 0 {
        return "no impact".to_owned();
    }
    let when = match worse.is_reversed {
        true => "with the motion reversed".to_owned(),
        false => format!("from {:.2} s", rule.first_impact_s.unwrap_or(0.0)),
    };
    let impacts = counted(worse.impact_count, "impact");
    format!(
        "{impacts}, up to {}, {when}",
        FORCE.text(worse.peak_force_n, 1)
    )
}

/// Records below which no code takes a result \[–\].
const FEW_RECORDS: usize = 3;

/// Inputs of codes, distances from property lines, and rules without a value.
fn inputs(gap: &CriticalGap) -> String {
    let mut text = String::new();
    let mut shown: Option<(&str, &[String])> = None;
    for rule in &gap.rules {
        let stated = (rule.code.unwrap_or_default(), &rule.inputs[..]);
        if !rule.inputs.is_empty() && shown != Some(stated) {
            // All intensities of GB 50011 share their inputs.
            let name = rule.rule.split(", ").next().unwrap_or_default();
            text += &format!("  {name}: {}\n", rule.inputs.join("; "));
            shown = Some(stated);
        }
        if let Some([left, right]) = rule.setbacks_m {
            text += &format!(
                "  {}: {} from the property line {}, {} {}\n",
                rule.rule,
                gap.between[0],
                LENGTH.text(left, 1),
                gap.between[1],
                LENGTH.text(right, 1)
            );
        }
    }
    for rule in &gap.left_out {
        text += &format!("  {} is left out: it needs {}\n", rule.rule, rule.needs);
    }
    if text.is_empty() {
        return text;
    }
    format!("  inputs of codes ([codes] in the model file changes them)\n{text}")
}

fn millimetres(metres: f64) -> String {
    LENGTH.text(metres, 2)
}
