//! `jostle motion synth`: artificial motions.

use jostle_io::Dimension;
use jostle_motion::{
    Envelope, GroundFilter, Makris, MatchSettings, Matched, Mavroeidis, Measures, PulseShape,
    RECIPES, SineSettings, StochasticSettings, TargetSpectrum, match_spectrum, measures,
    near_fault_pulse, recipe, spectrum_compatible, stochastic,
};

use super::args::{
    SynthCommand, SynthNoiseArgs, SynthPulseArgs, SynthRecipeArgs, SynthSpectrumArgs,
};
use super::source::{in_short, open, quantities, quantity, write, wrong};
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
    let seed_record = args.record.as_deref().map(open).transpose()?;
    let step = match &seed_record {
        Some(record) => record.motion.step(),
        None => quantity("--step", &args.wave.step, Dimension::Time)?,
    };
    let peak = match &args.pga {
        Some(text) => Some(quantity("--pga", text, Dimension::Acceleration)?),
        None => target.peak_ground_acceleration(),
    };
    let periods = match &quantities("--periods", &args.periods, Dimension::Time)?[..] {
        [first, last] => [*first, *last],
        _ => [0.05_f64.max(4.0 * step), 6.0_f64.min(target.range()[1])],
    };
    let matching = MatchSettings {
        periods,
        damping: quantity("--damping", &args.damping, Dimension::Dimensionless)?,
        tolerance: quantity("--tolerance", &args.tolerance, Dimension::Dimensionless)?,
        peak,
    };
    let matched = match &seed_record {
        Some(record) => match_spectrum(&record.motion, &target, &matching).map_err(wrong)?,
        None => {
            let duration = quantity("--duration", &args.duration, Dimension::Time)?;
            let settings = SineSettings {
                step,
                envelope: Envelope::of_duration(duration),
                seed: args.seed,
                matching,
            };
            spectrum_compatible(&target, &settings).map_err(wrong)?
        }
    };
    let name = match &seed_record {
        Some(record) => format!("{} matched to {}", record.name, target.name()),
        None => format!("sines of seed {} matched to {}", args.seed, target.name()),
    };
    write(&args.wave.out, args.wave.force, &name, &matched.motion)?;
    let after = measures(&matched.motion).map_err(wrong)?;
    let before = match &seed_record {
        Some(record) => Some(measures(&record.motion).map_err(wrong)?),
        None => None,
    };
    terminal::print(&format!(
        "{}: {}\n{}\n{}",
        args.wave.out.display(),
        in_short(&matched.motion),
        closeness(&matched, &target, &matching),
        strength(before.as_ref(), &after)
    ))?;
    if let Some(warning) = before.and_then(|before| displacement_warning(&before, &after)) {
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
        let after = value(after);
        let row = match before.map(value) {
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
    ("significant duration", "s", 2, |m| m.d5_95[1] - m.d5_95[0]),
];

/// Growth of the peak displacement, over that of the peak acceleration, from which on a matched record is warned
/// about \[–\].
const MOST_GROWTH: f64 = 2.5;

/// A warning if matching made the displacement of a record much greater.
fn displacement_warning(before: &Measures, after: &Measures) -> Option<String> {
    let scaled = before.pgd.value * after.pga.value / before.pga.value;
    let growth = after.pgd.value / scaled;
    (growth > MOST_GROWTH).then(|| {
        format!(
            "the peak displacement grew from {:.0} to {:.0} mm, {growth:.1} times that of the record with the same peak acceleration: matching added long periods. End the range earlier with --periods, or take another record",
            1e3 * before.pgd.value,
            1e3 * after.pgd.value
        )
    })
}

fn closeness(matched: &Matched, target: &TargetSpectrum, matching: &MatchSettings) -> String {
    format!(
        "{}: largest difference {:.1} % at {:.3} s, over {} to {} s with {} % damping; ends at rest where it began",
        target.name(),
        100.0 * matched.misfit,
        matched.worst_period,
        matching.periods[0],
        matching.periods[1],
        100.0 * matching.damping
    )
}

fn noise(args: &SynthNoiseArgs) -> Result<(), Failure> {
    let number = |option, text: &str| quantity(option, text, Dimension::Dimensionless);
    let corner = quantity("--corner", &args.corner, Dimension::Frequency)?;
    let duration = quantity("--duration", &args.duration, Dimension::Time)?;
    let settings = StochasticSettings {
        step: quantity("--step", &args.wave.step, Dimension::Time)?,
        envelope: Envelope::of_duration(duration),
        seed: args.seed,
        filter: GroundFilter {
            frequency: quantity("--frequency", &args.frequency, Dimension::Frequency)?,
            damping: number("--ground-damping", &args.ground_damping)?,
            high_pass: match number("--corner-damping", &args.corner_damping)? {
                _ if corner == 0.0 => None,
                damping => Some([corner, damping]),
            },
        },
        peak: quantity("--pga", &args.pga, Dimension::Acceleration)?,
    };
    let motion = stochastic(&settings).map_err(wrong)?;
    let name = format!("filtered noise of seed {}", args.seed);
    write(&args.wave.out, args.wave.force, &name, &motion)?;
    terminal::print(&format!(
        "{}: {}",
        args.wave.out.display(),
        in_short(&motion)
    ))
}

fn pulse(args: &SynthPulseArgs) -> Result<(), Failure> {
    let number = |option, text: &str| quantity(option, text, Dimension::Dimensionless);
    let time = |option, text: &str| quantity(option, text, Dimension::Time);
    let shape = match args.shape.to_lowercase().as_str() {
        "mavroeidis" => PulseShape::Mavroeidis(Mavroeidis {
            gamma: number("--gamma", &args.gamma)?,
            phase: number("--phase", &args.phase)?,
        }),
        "makris-a" => PulseShape::Makris(Makris::A),
        "makris-b" => PulseShape::Makris(Makris::B),
        other => match other.strip_prefix("makris-c").and_then(|n| n.parse().ok()) {
            Some(cycles) => PulseShape::Makris(Makris::C(cycles)),
            None => {
                let known = "mavroeidis, makris-a, makris-b, makris-c1, makris-c2, …";
                let problem = format!("--shape must be one of {known}; found \"{}\"", args.shape);
                return Err(Failure::Input(problem));
            }
        },
    };
    let motion = near_fault_pulse(
        &shape,
        quantity("--velocity", &args.velocity, Dimension::Speed)?,
        time("--period", &args.period)?,
        time("--step", &args.wave.step)?,
        [
            time("--before", &args.before)?,
            time("--after", &args.after)?,
        ],
    )
    .map_err(wrong)?;
    let name = format!("{} pulse, {}, {}", args.shape, args.velocity, args.period);
    write(&args.wave.out, args.wave.force, &name, &motion)?;
    terminal::print(&format!(
        "{}: {}, PGV {:.4} m/s",
        args.wave.out.display(),
        in_short(&motion),
        measures(&motion).map_err(wrong)?.pgv.value
    ))
}

fn by_recipe(args: &SynthRecipeArgs) -> Result<(), Failure> {
    let Some(recipe) = recipe(&args.name) else {
        let known: Vec<_> = RECIPES.iter().map(|recipe| recipe.name).collect();
        let problem = format!(
            "there is no recipe \"{}\"; known: {}",
            args.name,
            known.join(", ")
        );
        return Err(Failure::Input(problem));
    };
    let matched = recipe.make().map_err(wrong)?;
    write(&args.out, args.force, recipe.name, &matched.motion)?;
    terminal::print(&format!(
        "{}: {}\n{}",
        args.out.display(),
        in_short(&matched.motion),
        closeness(&matched, &recipe.target(), &recipe.matching())
    ))
}
