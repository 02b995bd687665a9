//! `jostle collide`: two free masses meet under one contact law, or all of them.

use std::fmt::Write;

use jostle::contact::{
    BilinearShape, FreeCollision, ModifiedKelvin, RubberBumper, effective_mass, hertz_indentation,
};
use jostle::{ContactLaw, LawKind, RestitutionIs};
use jostle_io::{Dimension, parse_quantity};
use jostle_report::{CollidedLaw, Collisions};
use serde_json::{Value, json};

use crate::args::CollideArgs;
use crate::failure::Failure;
use crate::numbers::{kn, mm};
use crate::replace::{Kind, Target};
use crate::terminal::{self, BOLD, DIM, styled};

pub(crate) fn collide(args: &CollideArgs) -> Result<(), Failure> {
    let table = Target::of_option(args.csv.as_ref(), Kind::COLLISION_CURVES, args.force)?;
    let page = Target::of_option(args.html.as_ref(), Kind::REPORT, args.force)?;
    let collisions = compute(args)?;
    if let Some(table) = &table {
        table.write(&curves(&collisions))?;
    }
    if let Some(page) = &page {
        page.write(&jostle_report::render_collisions(&collisions))?;
    }
    if args.json {
        let mut laws: Vec<Value> = collisions.laws.iter().map(as_json).collect();
        let answer = if args.all {
            json!({ "laws": laws })
        } else {
            laws.pop().unwrap_or_default()
        };
        return terminal::print(&format!("{answer:#}"));
    }
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = describe(&mut text, &collisions, args);
    terminal::print(&text)
}

/// Collisions for options as on the command line, each with its numbers as in the JSON.
///
/// # Errors
/// The complaint, which begins with the option.
pub fn collisions(options: &[String]) -> Result<Vec<(Value, FreeCollision)>, String> {
    #[derive(clap::Parser)]
    #[command(no_binary_name = true)]
    struct Options {
        #[command(flatten)]
        args: CollideArgs,
    }
    let parsed = <Options as clap::Parser>::try_parse_from(options).map_err(|error| {
        let text = error.render().to_string();
        let first = text.lines().next().unwrap_or_default();
        first.trim_start_matches("error: ").to_owned()
    })?;
    let collisions = compute(&parsed.args).map_err(|failure| failure.to_string())?;
    let laws = collisions.laws.into_iter();
    Ok(laws.map(|law| (as_json(&law), law.collision)).collect())
}

fn compute(args: &CollideArgs) -> Result<Collisions, Failure> {
    let positive = |option: &str, text: &str, dimension| {
        let value = parse_quantity(text, dimension)
            .map_err(|error| Failure::Input(format!("{option}: {error}")))?;
        if value > 0.0 {
            Ok(value)
        } else {
            Err(Failure::Input(format!(
                "{option}: must be greater than zero, found {text}"
            )))
        }
    };
    let masses = [
        positive("--m1", &args.m1, Dimension::Mass)?,
        positive("--m2", &args.m2, Dimension::Mass)?,
    ];
    let speed = positive("--speed", &args.speed, Dimension::Speed)?;
    let restitution = positive("--restitution", &args.restitution, Dimension::Dimensionless)?;
    if restitution > 1.0 {
        return Err(Failure::Input(format!(
            "--restitution: must be greater than 0 and at most 1, found {restitution}"
        )));
    }
    let shape = BilinearShape {
        yield_share: positive("--yield-share", &args.yield_share, Dimension::Dimensionless)?,
        design_speed: args
            .design_speed
            .as_ref()
            .map(|text| positive("--design-speed", text, Dimension::Speed))
            .transpose()?,
    };
    if shape.yield_share >= 0.5 {
        return Err(Failure::Input(format!(
            "--yield-share: must lie between 0 and 0.5, found {}",
            shape.yield_share
        )));
    }
    let bumper = RubberBumper {
        thickness: positive("--thickness", &args.thickness, Dimension::Length)?,
        exponent: positive("--exponent", &args.exponent, Dimension::Dimensionless)?,
    };
    if !(1.0..=6.0).contains(&bumper.exponent) {
        return Err(Failure::Input(format!(
            "--exponent: must lie between 1 and 6, found {}",
            bumper.exponent
        )));
    }
    let kinds = kinds(args, shape, bumper);
    let energy = effective_mass(masses[0], masses[1]) * speed * speed;
    let stiffness = Stiffness::read(args, &kinds, energy)?;
    let restitution_is = if args.restitution_is == "realised" {
        RestitutionIs::Realised
    } else {
        RestitutionIs::Input
    };
    let mut laws = Vec::new();
    for kind in kinds {
        let law = ContactLaw {
            kind,
            stiffness: stiffness.of(kind),
            restitution,
            restitution_is,
        };
        let least = law.least_restitution();
        if restitution <= least {
            if args.all {
                continue;
            }
            return Err(Failure::Input(format!(
                "--restitution: {} cannot realise {restitution}; at least {least:.4}",
                kind.name()
            )));
        }
        let numbers = law.between(masses[0], masses[1]);
        laws.push(CollidedLaw {
            law,
            collision: FreeCollision::of(&numbers, masses[0], masses[1], speed),
        });
    }
    let stiffnesses = format!(
        "Stiffness {:.4e} N/m^1.5 for the Hertz family, {:.4e} N/m for the others: the same secant at the greatest elastic Hertz indentation.",
        stiffness.hertz, stiffness.linear
    );
    Ok(Collisions {
        masses,
        speed,
        restitution,
        stiffnesses,
        laws,
    })
}

fn kinds(args: &CollideArgs, shape: BilinearShape, bumper: RubberBumper) -> Vec<LawKind> {
    let with_parameters = |kind| match kind {
        LawKind::Bilinear(_) => LawKind::Bilinear(shape),
        LawKind::Rubber(_) => LawKind::Rubber(bumper),
        other => other,
    };
    let all = LawKind::ALL.into_iter().map(with_parameters);
    if args.all {
        return all.collect();
    }
    let variant = ModifiedKelvin::MahmoudJankowski;
    let wanted = |kind: &LawKind| {
        kind.name() == args.law
            && match kind {
                LawKind::ModifiedKelvin(found) => {
                    (*found == variant) == (args.variant == variant.name())
                }
                _ => true,
            }
    };
    all.filter(wanted).collect()
}

/// The stiffness in the units of both families.
struct Stiffness {
    hertz: f64,
    linear: f64,
}

impl Stiffness {
    /// Reads it in either unit; a bare number is in that of the law. The other follows from k_linear = k_Hertz √δ with
    /// δ = (5 m v²/(4k))^0.4; `energy` is m v².
    fn read(args: &CollideArgs, kinds: &[LawKind], energy: f64) -> Result<Self, Failure> {
        let bare_is_hertzian = args.all || kinds.iter().any(|kind| kind.is_hertzian());
        let (first, second) = if bare_is_hertzian {
            (Dimension::HertzStiffness, Dimension::Stiffness)
        } else {
            (Dimension::Stiffness, Dimension::HertzStiffness)
        };
        let text = args.stiffness.as_deref().unwrap_or("2e9 N/m^1.5");
        let (value, dimension) = match parse_quantity(text, first) {
            Ok(value) => (value, first),
            Err(error) => match parse_quantity(text, second) {
                Ok(value) => (value, second),
                Err(_) => return Err(Failure::Input(format!("--stiffness: {error}"))),
            },
        };
        if value <= 0.0 {
            return Err(Failure::Input(format!(
                "--stiffness: must be greater than zero, found {text}"
            )));
        }
        let hertz = if dimension == Dimension::HertzStiffness {
            value
        } else {
            (value / (1.25 * energy).powf(0.2)).powf(1.25)
        };
        let linear = if dimension == Dimension::Stiffness {
            value
        } else {
            hertz * hertz_indentation(hertz, energy, 1.0).sqrt()
        };
        Ok(Self { hertz, linear })
    }

    fn of(&self, kind: LawKind) -> f64 {
        if kind.is_hertzian() {
            self.hertz
        } else {
            self.linear
        }
    }
}

fn as_json(collided: &CollidedLaw) -> Value {
    let CollidedLaw { law, collision } = collided;
    let variant = match law.kind {
        LawKind::ModifiedKelvin(variant) => Some(variant.name()),
        _ => None,
    };
    json!({
        "law": law.kind.name(),
        "variant": variant,
        "stiffness": law.stiffness,
        "stiffness_unit": if law.kind.is_hertzian() { "N/m^1.5" } else { "N/m" },
        "restitution": law.restitution,
        "impact_speed_m_s": collision.impact_speed,
        "separation_speed_m_s": collision.separation_speed,
        "realised_restitution": collision.realised_restitution(),
        "peak_force_n": collision.peak_force,
        "peak_force_at_s": collision.peak_force_at,
        "least_force_n": collision.least_force,
        "peak_indentation_m": collision.peak_indentation,
        "duration_s": collision.duration,
        "impulse_n_s": collision.impulse,
        "dissipated_j": collision.dissipated,
    })
}

fn curves(collisions: &Collisions) -> String {
    let mut text = "law,time_s,indentation_m,rate_m_s,force_n\n".to_owned();
    for CollidedLaw { law, collision } in &collisions.laws {
        for point in &collision.curve {
            let _ = writeln!(
                text,
                "{},{:e},{:e},{:e},{:e}",
                law.kind.full_name(),
                point.time,
                point.indentation,
                point.rate,
                point.force
            );
        }
    }
    text
}

fn describe(text: &mut String, collisions: &Collisions, args: &CollideArgs) -> std::fmt::Result {
    let [m1, m2] = collisions.masses;
    let heading = format!(
        "{} t against {} t at {} m/s, restitution {} ({})",
        m1 * 1e-3,
        m2 * 1e-3,
        collisions.speed,
        collisions.restitution,
        if args.restitution_is == "realised" {
            "realised"
        } else {
            "in the published formulas"
        }
    );
    writeln!(text, "{}", styled(BOLD, &heading))?;
    writeln!(text, "{}\n", styled(DIM, &collisions.stiffnesses))?;
    writeln!(
        text,
        "law                                  realised e   peak force  indentation   duration  dissipated"
    )?;
    for CollidedLaw { law, collision } in &collisions.laws {
        let force = collision.peak_force.map_or("–".to_owned(), kn);
        writeln!(
            text,
            "{:36} {:>10.4}  {:>8} kN  {:>8} mm  {:>6.2} ms  {:>7.3} kJ",
            law.kind.full_name(),
            collision.realised_restitution(),
            force,
            mm(collision.peak_indentation),
            collision.duration * 1e3,
            collision.dissipated * 1e-3
        )?;
    }
    for path in [&args.csv, &args.html].into_iter().flatten() {
        writeln!(text, "→ {}", styled(BOLD, &path.display().to_string()))?;
    }
    Ok(())
}
