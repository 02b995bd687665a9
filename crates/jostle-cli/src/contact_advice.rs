//! `jostle contact-advice`: stiffness and restitution of contacts from slabs, material and masses.

use std::fmt::Write;
use std::path::PathBuf;

use jostle_io::Overrides;
use jostle_io::shown::{FORCE, HEIGHT, HERTZ_STIFFNESS, MASS, SPEED, STIFFNESS, Shown};
use jostle_run::{AdviceOptions, BOLD, ContactAdvice, DIM, RangeAdvice, styled};

use crate::failure::Failure;
use crate::open::open_model;
use crate::terminal;

#[derive(Debug, clap::Args)]
pub(crate) struct ContactAdviceArgs {
    /// Model file (TOML or JSON), or the name of a built-in example: gives the colliding masses
    model: Option<PathBuf>,
    /// Colliding masses, such as "40 t" or "40 t, 60 t" (left, right); needed without a model
    #[arg(long, value_name = "QUANTITY")]
    mass: Option<String>,
    /// Length of the slabs in the direction of the impact; with --width and --thickness it adds estimates from E A/L and waves
    #[arg(long, value_name = "QUANTITY")]
    length: Option<String>,
    /// Width of the slabs in contact
    #[arg(long, value_name = "QUANTITY")]
    width: Option<String>,
    /// Thickness of the slabs
    #[arg(long, value_name = "QUANTITY")]
    thickness: Option<String>,
    /// Concrete grade, which gives the modulus: C30, C30/37, "f'c = 4 ksi"
    #[arg(long, value_name = "GRADE")]
    concrete: Option<String>,
    /// Modulus of elasticity instead [default: 30 GPa]
    #[arg(long, value_name = "QUANTITY")]
    modulus: Option<String>,
    /// Poisson's ratio
    #[arg(long, value_name = "NUMBER", default_value = "0.2")]
    poisson_ratio: String,
    /// Density
    #[arg(long, value_name = "QUANTITY", default_value = "2500 kg/m3")]
    density: String,
    /// Impact speed
    #[arg(long, value_name = "QUANTITY", default_value = "0.4 m/s")]
    speed: String,
    /// Print JSON and nothing else
    #[arg(long)]
    json: bool,
}

pub(crate) fn contact_advice(args: &ContactAdviceArgs) -> Result<(), Failure> {
    let opened = match &args.model {
        Some(path) => Some(open_model(Some(path), &Overrides::default(), false)?),
        None => None,
    };
    let options = AdviceOptions {
        mass: args.mass.clone(),
        length: args.length.clone(),
        width: args.width.clone(),
        thickness: args.thickness.clone(),
        concrete: args.concrete.clone(),
        modulus: args.modulus.clone(),
        poisson_ratio: args.poisson_ratio.clone(),
        density: args.density.clone(),
        speed: args.speed.clone(),
    };
    let advice = jostle_run::contact_advice(opened.as_ref(), &options)?;
    if args.json {
        let value = serde_json::json!({ "contacts": advice });
        return terminal::print(&serde_json::to_string_pretty(&value).unwrap_or_default());
    }
    let mut text = String::new();
    for one in &advice {
        // Writing to a string cannot fail.
        let _ = describe(&mut text, one);
    }
    terminal::print(&text)
}

fn describe(text: &mut String, advice: &ContactAdvice) -> std::fmt::Result {
    let mass = |mass: Option<f64>| match mass {
        Some(mass) => MASS.text(mass, 1),
        None => "a rigid wall".to_owned(),
    };
    let place = match advice.height_m {
        Some(height) => format!(", floors at {}", HEIGHT.text(height, 2)),
        None => String::new(),
    };
    let heading = format!(
        "{} ↔ {}{place}: {} against {} at {} {}",
        advice.between[0],
        advice.between[1],
        mass(advice.masses_kg[0]),
        mass(advice.masses_kg[1]),
        SPEED.stated(advice.speed_m_s),
        SPEED.name()
    );
    writeln!(text, "{}", styled(BOLD, &heading))?;
    if let Some(wave) = &advice.wave {
        writeln!(
            text,
            "A wave crosses the floors in {:.2} and {:.2} ms. Elastic-rod estimate: {} for {:.2} ms; restitution {:.2}.",
            1e3 * wave.transit_s[0],
            1e3 * wave.transit_s[1],
            FORCE.text(wave.peak_force_n, 1),
            1e3 * wave.duration_s,
            wave.restitution
        )?;
    }
    writeln!(
        text,
        "\nstiffness                             value        peak force    duration"
    )?;
    let force = FORCE.name();
    for estimate in &advice.estimates {
        let (value, unit) = match Shown::named(estimate.unit) {
            Some(shown) => (shown.of(estimate.stiffness), shown.name()),
            None => (estimate.stiffness, estimate.unit),
        };
        let value = format!("{value:.3e} {unit}");
        writeln!(
            text,
            "{:30} {value:>20}  {:>8} {force}  {:>7.2} ms{}",
            estimate.name,
            FORCE.number(estimate.peak_force_n, 1),
            1e3 * estimate.duration_s,
            if estimate.is_valid {
                ""
            } else {
                "   outside its validity"
            }
        )?;
        let words = format!("  {}: {}", estimate.source, estimate.validity);
        writeln!(text, "{}", styled(DIM, &words))?;
    }
    writeln!(text, "\nRecommended for the [[gap]]:\n")?;
    let e = advice.restitution;
    writeln!(text, "law = \"hertz-damp\"")?;
    writeln!(text, "{}", stiffness(advice.hertz, HERTZ_STIFFNESS))?;
    writeln!(
        text,
        "restitution = {:.2}   # {:.2} to {:.2}",
        e.value, e.low, e.high
    )?;
    writeln!(text, "restitution_is = \"realised\"")?;
    if let Some(linear) = advice.linear {
        writeln!(
            text,
            "\nor, with a linear spring:\n\nlaw = \"kelvin-no-tension\""
        )?;
        writeln!(text, "{}", stiffness(linear, STIFFNESS))?;
        writeln!(
            text,
            "restitution = {:.2}   # {:.2} to {:.2}",
            e.value, e.low, e.high
        )?;
    }
    writeln!(text)?;
    let unit = STIFFNESS.name();
    if let Some(rule) = &advice.lateral {
        writeln!(
            text,
            "Many studies take 10 to 100 times the lateral stiffness of the stiffer neighbour for linear laws. \n\
             \"{}\", lateral stiffness at this floor: {:.2e} {unit}, which gives {:.1e} to {:.1e} {unit}. This range is a convention, not a measurement.",
            rule.of,
            STIFFNESS.of(rule.lateral_n_m),
            STIFFNESS.of(rule.low_n_m),
            STIFFNESS.of(rule.high_n_m)
        )?;
    }
    for note in &advice.notes {
        writeln!(text, "{note}")?;
    }
    writeln!(
        text,
        "The stiffness is known to an order of magnitude. \"jostle run --sensitivity\" repeats a run with both ends of this range and\n\
         restitution ± 0.15, and gives the spread of every result."
    )?;
    writeln!(text)
}

fn stiffness(range: RangeAdvice, shown: Shown) -> String {
    format!(
        "stiffness = \"{:.2e} {}\"   # {:.1e} to {:.1e}",
        shown.of(range.value),
        shown.name(),
        shown.of(range.low),
        shown.of(range.high)
    )
}
