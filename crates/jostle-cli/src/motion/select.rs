//! `jostle motion select`: whether a set of motions is suitable for time-history analysis.

use std::fmt::Write;

use jostle_io::{Dimension, selection_json};
use jostle_motion::{Candidate, MainPeriod, Origin, SelectionCheck, check_selection};
use jostle_report::{SelectionPage, render_selection};

use super::args::SelectArgs;
use super::source::{open, quantities, quantity, wrong};
use crate::failure::Failure;
use crate::replace::Target;
use crate::terminal;
use jostle_run::FileKind;
use jostle_run::{BOLD, LOUD, styled};

pub(super) fn select(args: &SelectArgs) -> Result<(), Failure> {
    let page = Target::of_option(args.html.as_ref(), FileKind::REPORT, args.force)?;
    let target = args.target.open()?;
    let damping = quantity("--damping", &args.damping, Dimension::Dimensionless)?;
    let peak = match &args.pga {
        _ if args.unscaled => None,
        Some(text) => Some(quantity("--pga", text, Dimension::Acceleration)?),
        None => target.peak_ground_acceleration(),
    };
    let periods = main_periods(args)?;
    let mut set = Vec::new();
    for (names, origin) in [
        (&args.natural, Origin::Natural),
        (&args.artificial, Origin::Artificial),
    ] {
        for name in names {
            let record = open(name)?;
            let motion = match peak {
                Some(peak) => record.motion.scaled_to_peak(peak).map_err(wrong)?,
                None => record.motion,
            };
            set.push(Candidate {
                name: record.name,
                motion,
                origin,
            });
        }
    }
    if set.is_empty() {
        return Err(Failure::Input(
            "no motions; name some with --natural and --artificial".into(),
        ));
    }
    let check = check_selection(&set, &target, &periods, damping).map_err(wrong)?;
    if let Some(file) = &page {
        let page = SelectionPage {
            target: &target,
            damping,
            periods: &periods,
            set: &set,
            check: &check,
        };
        file.write(&render_selection(&page).map_err(wrong)?)?;
    }
    if args.json {
        terminal::print(&format!("{:#}", selection_json(&set, &check, &periods)))?;
        return verdict(&check);
    }
    let mut text = format!("{}\n", styled(BOLD, &target.name()));
    describe(&mut text, &set, &check, &periods);
    if let Some(path) = &args.html {
        let _ = writeln!(text, "\n{}", path.display());
    }
    terminal::print(&text)?;
    verdict(&check)
}

/// A set that does not meet its code gives the exit code of a failed analysis.
fn verdict(check: &SelectionCheck) -> Result<(), Failure> {
    if check.passes() {
        return Ok(());
    }
    let unmet = check.rules.iter().filter(|rule| !rule.met).count();
    Err(Failure::Analysis(format!(
        "the set does not meet {}: {unmet} of {} rules",
        check.code.clause(),
        check.rules.len()
    )))
}

fn main_periods(args: &SelectArgs) -> Result<Vec<MainPeriod>, Failure> {
    let periods = quantities("--periods", &args.periods, Dimension::Time)?;
    let ratios = quantities("--mass-ratios", &args.mass_ratios, Dimension::Dimensionless)?;
    if !ratios.is_empty() && ratios.len() != periods.len() {
        let problem = format!(
            "--mass-ratios: {} values for {} periods",
            ratios.len(),
            periods.len()
        );
        return Err(Failure::Input(problem));
    }
    let ratio = |i: usize| ratios.get(i).copied().unwrap_or(1.0);
    let pairs = periods.into_iter().enumerate();
    Ok(pairs
        .map(|(i, period)| MainPeriod {
            period,
            mass_ratio: ratio(i),
        })
        .collect())
}

fn describe(text: &mut String, set: &[Candidate], check: &SelectionCheck, periods: &[MainPeriod]) {
    // Writing to a string cannot fail.
    let _ = write!(text, "  {:32}", "response over code at T =");
    for main in periods {
        let _ = write!(text, "{:>9}", format!("{} s", main.period));
    }
    let _ = writeln!(text, "{:>12}{:>12}", "base shear", "duration");
    for (i, candidate) in set.iter().enumerate() {
        let name: String = candidate.name.chars().take(30).collect();
        let _ = write!(text, "  {name:32}");
        for ratio in &check.ratios[i] {
            let _ = write!(text, "{ratio:9.3}");
        }
        let duration = format!("{:.1} s", check.effective_duration[i]);
        let _ = writeln!(text, "{:12.3}{duration:>12}", check.base_shear[i]);
    }
    let _ = write!(text, "  {:32}", "mean");
    for [_, _, difference] in &check.mean {
        let _ = write!(text, "{:9.3}", 1.0 + difference);
    }
    let mean = check.base_shear.iter().sum::<f64>() / set.len() as f64;
    let _ = writeln!(text, "{mean:12.3}\n");
    let _ = writeln!(text, "  {}", check.code.clause());
    for rule in &check.rules {
        let verdict = if rule.met {
            "yes".to_owned()
        } else {
            styled(LOUD, "no ")
        };
        let _ = writeln!(
            text,
            "  {verdict}  {}: {} ({})",
            rule.found, rule.asked, rule.clause
        );
    }
    for note in &check.notes {
        let _ = writeln!(text, "       {note}");
    }
}
