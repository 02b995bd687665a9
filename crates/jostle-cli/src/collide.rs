//! `jostle collide`: the collision of two free masses under one contact law, or under all of them.

use std::fmt::Write;

use jostle_io::shown::{ENERGY, FORCE, LENGTH, MASS, SPEED, Shown};
use jostle_report::{CollidedLaw, Collisions};
use jostle_run::{BOLD, CollideOptions, DIM, FileKind, collision_json, styled};
use serde_json::{Value, json};

use crate::args::CollideArgs;
use crate::failure::Failure;
use crate::replace::Target;
use crate::terminal;

pub(crate) fn collide(args: &CollideArgs) -> Result<(), Failure> {
    let table = Target::of_option(args.csv.as_ref(), FileKind::COLLISION_CURVES, args.force)?;
    let page = Target::of_option(args.html.as_ref(), FileKind::REPORT, args.force)?;
    let collisions = jostle_run::collide(&args.options())?;
    if let Some(table) = &table {
        table.write(&curves(&collisions))?;
    }
    if let Some(page) = &page {
        page.write(&jostle_report::render_collisions(&collisions))?;
    }
    if args.json {
        let mut laws: Vec<Value> = collisions.laws.iter().map(collision_json).collect();
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

impl CollideArgs {
    fn options(&self) -> CollideOptions {
        CollideOptions {
            law: self.law.clone(),
            formula: self.formula.clone(),
            all: self.all,
            m1: self.m1.clone(),
            m2: self.m2.clone(),
            speed: self.speed.clone(),
            stiffness: self.stiffness.clone(),
            restitution: self.restitution.clone(),
            restitution_is: self.restitution_is.clone(),
            damping: self.damping.clone(),
            variant: self.variant.clone(),
            yield_share: self.yield_share.clone(),
            design_speed: self.design_speed.clone(),
            thickness: self.thickness.clone(),
            exponent: self.exponent.clone(),
        }
    }
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
    let by_coefficient = match args.restitution_is.as_str() {
        "realised" => "realised",
        _ => "in the published formulas",
    };
    let loses = match (&args.damping, collisions.restitution) {
        (None, Some(e)) => format!("restitution {e} ({by_coefficient})"),
        (None, None) => "by the formula".to_owned(),
        (damping, _) => format!("dashpot {}", damping.as_deref().unwrap_or_default()),
    };
    let mass = MASS.name();
    let heading = format!(
        "{} {mass} against {} {mass} at {} {}, {loses}",
        MASS.stated(m1),
        MASS.stated(m2),
        SPEED.stated(collisions.speed),
        SPEED.name()
    );
    writeln!(text, "{}", styled(BOLD, &heading))?;
    writeln!(text, "{}\n", styled(DIM, &collisions.stiffnesses))?;
    writeln!(
        text,
        "law                                  realised e   peak force  indentation   duration  dissipated"
    )?;
    let [kn, length, energy] = [FORCE, LENGTH, ENERGY].map(Shown::name);
    for CollidedLaw { law, collision } in &collisions.laws {
        let force = collision
            .peak_force
            .map_or("–".to_owned(), |force| FORCE.number(force, 1));
        writeln!(
            text,
            "{:36} {:>10.4}  {:>8} {kn}  {:>8} {length}  {:>6.2} ms  {:>7} {energy}",
            law.kind.full_name(),
            collision.realised_restitution(),
            force,
            LENGTH.number(collision.peak_indentation, 1),
            collision.duration * 1e3,
            ENERGY.number(collision.dissipated, 3)
        )?;
    }
    for path in [&args.csv, &args.html].into_iter().flatten() {
        writeln!(text, "→ {}", styled(BOLD, &path.display().to_string()))?;
    }
    Ok(())
}
