//! `jostle motion synth`: artificial motions.

use jostle_io::Dimension;
use jostle_io::shown::Shown;
use jostle_motion::{Measures, measures};
use jostle_run::{Noise, Pulse, SpectrumMatch, made_by_recipe, motion_in_short};

use super::args::{
    SynthCommand, SynthNoiseArgs, SynthPulseArgs, SynthRecipeArgs, SynthSpectrumArgs,
};
use super::source::{open, quantities, quantity, write, wrong};
use crate::failure::Failure;
use crate::terminal;

pub(super) fn synth(command: &SynthCommand) -> Result<(), Failure> {
    match command {
        SynthCommand::Spectrum(args) => spectrum(args),
        SynthCommand::Noise(args) => noise(args),
        SynthCommand::Pulse(args) => pulse(args),
        SynthCommand::Recipe(args) => by_recipe(args),
    }
}

fn spectrum(args: &SynthSpectrumArgs) -> Result<(), Failure> {
    let target = args.target.open()?;
    let pga = args.pga.as_ref();
    let peak = pga.map(|text| quantity("--pga", text, Dimension::Acceleration));
    let wanted = SpectrumMatch {
        record: args.record.as_deref().map(open).transpose()?,
        step: quantity("--step", &args.wave.step, Dimension::Time)?,
        duration: quantity("--duration", &args.duration, Dimension::Time)?,
        seed: args.seed,
        peak: peak.transpose()?,
        periods: quantities("--periods", &args.periods, Dimension::Time)?
            .try_into()
            .ok(),
        damping: quantity("--damping", &args.damping, Dimension::Dimensionless)?,
        tolerance: quantity("--tolerance", &args.tolerance, Dimension::Dimensionless)?,
    };
    let made = wanted.make(&target)?;
    write(
        &args.wave.out,
        args.wave.force,
        &made.name,
        &made.matched.motion,
    )?;
    terminal::print(&format!(
        "{}: {}\n{}\n{}",
        args.wave.out.display(),
        motion_in_short(&made.matched.motion),
        made.closeness(),
        strength(made.before.as_ref(), &made.after)
    ))?;
    if let Some(warning) = made.warning() {
        terminal::warn(&warning);
    }
    Ok(())
}

/// Peaks, Arias intensity and significant duration of a matched motion, beside those of its record.
fn strength(before: Option<&Measures>, after: &Measures) -> String {
    let mut lines = match before {
        None => Vec::new(),
        Some(_) => vec![format!(
            "  {:<26}{:>12}{:>12}{:>9}",
            "", "record", "matched", "ratio"
        )],
    };
    for (what, unit, decimals, value) in MEASURES {
        let conversion = Shown::named(unit);
        let unit = conversion.map_or(unit, Shown::name);
        let shown =
            |m: &Measures| conversion.map_or(value(m), |conversion| conversion.of(value(m)));
        let after = shown(after);
        let row = match before.map(shown) {
            None => format!("  {what:<26}{after:>12.decimals$} {unit}"),
            Some(before) => format!(
                "  {:<26}{before:>12.decimals$}{after:>12.decimals$}{:>9.2}",
                format!("{what} [{unit}]"),
                after / before
            ),
        };
        lines.push(row);
    }
    lines.join("\n")
}

/// A measure in a unit: its name, the unit, decimals, and its value.
type InUnit = (&'static str, &'static str, usize, fn(&Measures) -> f64);

/// What matching may change beyond the spectrum.
const MEASURES: [InUnit; 5] = [
    ("peak acceleration", "m/s²", 4, |m| m.pga.value),
    ("peak velocity", "m/s", 4, |m| m.pgv.value),
    ("peak displacement", "m", 4, |m| m.pgd.value),
    ("Arias intensity", "m/s", 4, |m| m.arias),
    ("duration 5–95 %", "s", 2, |m| m.d5_95[1] - m.d5_95[0]),
];

fn noise(args: &SynthNoiseArgs) -> Result<(), Failure> {
    let number = |option, text: &str| quantity(option, text, Dimension::Dimensionless);
    let made = Noise {
        step: quantity("--step", &args.wave.step, Dimension::Time)?,
        duration: quantity("--duration", &args.duration, Dimension::Time)?,
        pga: quantity("--pga", &args.pga, Dimension::Acceleration)?,
        seed: args.seed,
        frequency: quantity("--frequency", &args.frequency, Dimension::Frequency)?,
        ground_damping: number("--ground-damping", &args.ground_damping)?,
        corner: quantity("--corner", &args.corner, Dimension::Frequency)?,
        corner_damping: number("--corner-damping", &args.corner_damping)?,
    }
    .make()?;
    write(&args.wave.out, args.wave.force, &made.name, &made.motion)?;
    terminal::print(&format!(
        "{}: {}",
        args.wave.out.display(),
        motion_in_short(&made.motion)
    ))
}

fn pulse(args: &SynthPulseArgs) -> Result<(), Failure> {
    let number = |option, text: &str| quantity(option, text, Dimension::Dimensionless);
    let time = |option, text: &str| quantity(option, text, Dimension::Time);
    let made = Pulse {
        shape: args.shape.clone(),
        velocity: quantity("--velocity", &args.velocity, Dimension::Speed)?,
        period: time("--period", &args.period)?,
        gamma: number("--gamma", &args.gamma)?,
        phase: number("--phase", &args.phase)?,
        rest: [
            time("--before", &args.before)?,
            time("--after", &args.after)?,
        ],
        step: time("--step", &args.wave.step)?,
    }
    .make()?;
    write(&args.wave.out, args.wave.force, &made.name, &made.motion)?;
    terminal::print(&format!(
        "{}: {}, PGV {:.4} m/s",
        args.wave.out.display(),
        motion_in_short(&made.motion),
        measures(&made.motion).map_err(wrong)?.pgv.value
    ))
}

fn by_recipe(args: &SynthRecipeArgs) -> Result<(), Failure> {
    let made = made_by_recipe(&args.name)?;
    let (name, motion) = made.motion();
    write(&args.out, args.force, name, motion)?;
    terminal::print(&format!(
        "{}: {}\n{}",
        args.out.display(),
        motion_in_short(motion),
        made.closeness()
    ))
}
