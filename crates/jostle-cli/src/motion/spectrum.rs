//! `jostle motion spectrum`: response spectra as JSON, CSV, Parquet or a table.

use std::fmt::Write;

use jostle_io::shown::{ACCELERATION, LENGTH, SMALL_SPEED, Shown};
use jostle_io::{Dimension, write_columns_parquet};
use jostle_motion::{
    Reading, ResponseSpectrum, ductility_spectrum, response_spectrum, spaced_periods,
};
use jostle_run::{FileKind, Inelastic, spectra_json};

use super::args::{PeaksAt, SpectrumArgs};
use super::source::{quantities, quantity, wrong};
use crate::failure::Failure;
use crate::replace::Target;
use crate::terminal;
use jostle_run::{BOLD, styled};

pub(super) fn spectrum(args: &SpectrumArgs) -> Result<(), Failure> {
    let as_csv = Target::of_option(args.csv.as_ref(), FileKind::SPECTRA, args.force)?;
    let as_parquet = Target::of_option(args.parquet.as_ref(), FileKind::TABLE, args.force)?;
    let record = args.record.open()?;
    let dampings = quantities("--damping", &args.damping, Dimension::Dimensionless)?;
    let mut periods = quantities("--periods", &args.periods, Dimension::Time)?;
    if periods.is_empty() {
        periods = spaced_periods(0.02, 10.0, 200);
    }
    let reading = match args.peaks {
        PeaksAt::Steps => Reading::Steps,
        PeaksAt::Between => Reading::Between,
    };
    let elastic = response_spectrum(&record.motion, &periods, &dampings, reading).map_err(wrong)?;
    let post_yield = quantity("--post-yield", &args.post_yield, Dimension::Dimensionless)?;
    let mut inelastic = Vec::new();
    for &damping in &dampings {
        for &ductility in &quantities("--ductility", &args.ductility, Dimension::Dimensionless)? {
            let found =
                ductility_spectrum(&record.motion, &periods, ductility, damping, post_yield);
            inelastic.push((damping, found.map_err(wrong)?));
        }
    }
    let mut written = Vec::new();
    if let Some(target) = &as_csv {
        target.write(&csv(&columns(&elastic, &inelastic)))?;
        written.push(target.path.display().to_string());
    }
    if let Some(target) = &as_parquet {
        write_columns_parquet(&target.path, &record.name, columns(&elastic, &inelastic))?;
        target.written();
        written.push(target.path.display().to_string());
    }
    if args.json {
        terminal::print(&format!("{:#}", spectra_json(&elastic, &inelastic)))
    } else if written.is_empty() {
        terminal::print(&table(&record.name, &elastic, &inelastic))
    } else {
        terminal::print(&format!("{} written", written.join(" and ")))
    }
}

/// Columns of a table, named with damping in percent, ductility and unit.
fn columns(elastic: &ResponseSpectrum, inelastic: &[Inelastic]) -> Vec<(String, Vec<f64>)> {
    let mut columns = vec![("period_s".to_owned(), elastic.periods.clone())];
    let percent = |damping: f64| format!("{}pct", (1e4 * damping).round() / 100.0);
    for curve in &elastic.curves {
        let z = percent(curve.damping);
        columns.push((format!("sd_{z}_m"), curve.displacement.clone()));
        columns.push((format!("psv_{z}_m_s"), curve.pseudo_velocity.clone()));
        columns.push((format!("psa_{z}_m_s2"), curve.pseudo_acceleration.clone()));
        columns.push((format!("sa_{z}_m_s2"), curve.total_acceleration.clone()));
    }
    for (damping, spectrum) in inelastic {
        let kind = format!("mu{}_{}", spectrum.ductility, percent(*damping));
        columns.push((
            format!("ay_{kind}_m_s2"),
            spectrum.yield_acceleration.clone(),
        ));
        columns.push((format!("reduction_{kind}"), spectrum.reduction.clone()));
        columns.push((format!("sd_{kind}_m"), spectrum.displacement.clone()));
    }
    columns
}

fn csv(columns: &[(String, Vec<f64>)]) -> String {
    let names: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).collect();
    let mut text = names.join(",") + "\n";
    for row in 0..columns.first().map_or(0, |(_, values)| values.len()) {
        let fields: Vec<String> = columns
            .iter()
            .map(|(_, values)| values[row].to_string())
            .collect();
        text += &(fields.join(",") + "\n");
    }
    text
}

fn table(name: &str, elastic: &ResponseSpectrum, inelastic: &[Inelastic]) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    for curve in &elastic.curves {
        let _ = writeln!(
            text,
            "{}, damping {} %",
            styled(BOLD, name),
            100.0 * curve.damping
        );
        let [length, speed, acceleration] = [LENGTH, SMALL_SPEED, ACCELERATION].map(Shown::name);
        let _ = writeln!(
            text,
            "  period s{:>10}{:>11}{:>10}{:>10}",
            format!("SD {length}"),
            format!("PSV {speed}"),
            format!("PSA {acceleration}"),
            format!("SA {acceleration}")
        );
        for (k, period) in elastic.periods.iter().enumerate() {
            let _ = writeln!(
                text,
                "  {period:8.4} {:>9} {:>10} {:>9} {:>9}",
                LENGTH.number(curve.displacement[k], 3),
                SMALL_SPEED.number(curve.pseudo_velocity[k], 2),
                ACCELERATION.number(curve.pseudo_acceleration[k], 4),
                ACCELERATION.number(curve.total_acceleration[k], 4)
            );
        }
    }
    for (damping, spectrum) in inelastic {
        let _ = writeln!(
            text,
            "{}, damping {} %, ductility {}",
            styled(BOLD, name),
            100.0 * damping,
            spectrum.ductility
        );
        let _ = writeln!(
            text,
            "  period s{:>12}  reduction{:>10}",
            format!("yield {}", ACCELERATION.name()),
            format!("SD {}", LENGTH.name())
        );
        for (k, period) in spectrum.periods.iter().enumerate() {
            let _ = writeln!(
                text,
                "  {period:8.4} {:>11} {:10.3} {:>9}",
                ACCELERATION.number(spectrum.yield_acceleration[k], 4),
                spectrum.reduction[k],
                LENGTH.number(spectrum.displacement[k], 3)
            );
        }
    }
    text
}
