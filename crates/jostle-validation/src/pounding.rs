//! A five-storey and a ten-storey frame hit each other 23 times: an independent program at 20 µs.

use std::f64::consts::PI;

use jostle::contact::ForceLaw;
use jostle::interface::Contact;
use jostle::{GroundMotion, System};
use serde_json::Value;

use crate::Extent;
use crate::data::{at, document, list, number, numbers};
use crate::row::Row;
use crate::structures::{explicit_frame, run, sampled, uniform};

const SOURCE: &str = "theory/oracle_pounding";

/// All rows of this family.
#[must_use]
pub fn rows(extent: Extent) -> Vec<Row> {
    let stored = document(include_str!("../data/theory/oracle_pounding.json"));
    let system = system(&stored);
    let mut rows = frequencies(&stored, &system);
    rows.extend(compare(&stored, &system, 1e-3, 5e-3));
    rows.extend(compare(&stored, &system, 2e-4, 3e-4));
    if extent == Extent::Full {
        // As fine as the reference; it takes the impact speed from a chord, and peaks from the steps.
        rows.extend(compare(&stored, &system, 2e-5, 1e-4));
    }
    rows
}

fn system(stored: &Value) -> System {
    let mut left = explicit_frame("left", at(stored, "/left"));
    let mut right = explicit_frame("right", at(stored, "/right"));
    let (alpha, beta) = (numbers(stored, "/alphaM"), numbers(stored, "/betaK"));
    for (side, building) in [&mut left, &mut right].into_iter().enumerate() {
        (
            building.structure.equations.alpha,
            building.structure.equations.beta,
        ) = (alpha[side], beta[side]);
    }
    let ports = [
        left.discretization.right_face.clone(),
        right.discretization.left_face.clone(),
    ];
    let mut system = System::of_buildings(vec![left, right]);
    for (&a, &b) in ports[0].iter().zip(&ports[1]) {
        let contact = system
            .contact_between((0, a), (1, b))
            .expect("floors have mass");
        system.contacts.push(Contact {
            width: number(stored, "/gap"),
            law: ForceLaw::Hertz {
                stiffness: 2e9,
                damping: 0.793_100_908_858_094_1,
            },
            ..contact
        });
    }
    system
}

fn frequencies(stored: &Value, system: &System) -> Vec<Row> {
    ["left", "right"]
        .iter()
        .zip(&system.buildings)
        .map(|(side, building)| {
            let expected = numbers(stored, &format!("/omega_{side}"));
            let got: Vec<f64> = building
                .lateral_modes()
                .take(3)
                .map(|mode| mode.circular_frequency)
                .collect();
            Row::worst_of(
                SOURCE,
                format!("{side} frame, ω₁…₃ [rad/s]"),
                &expected,
                &got,
                1e-9,
            )
        })
        .collect()
}

/// a_g = 4 [sin(2π 1.1 t) + 0.7 sin(2π 2.3 t + 0.5) + 0.5 sin(2π 4.7 t + 1)] min(1, t), straight within 20 µs.
fn motion(duration: f64) -> GroundMotion {
    let step = 2e-5;
    sampled(step, (duration / step).round() as usize, |t| {
        let wave = |frequency: f64, phase: f64| (2.0 * PI * frequency * t + phase).sin();
        4.0 * (wave(1.1, 0.0) + 0.7 * wave(2.3, 0.5) + 0.5 * wave(4.7, 1.0)) * t.min(1.0)
    })
}

fn compare(stored: &Value, system: &System, step: f64, tolerance: f64) -> Vec<Row> {
    let outcome = run(system, &motion(number(stored, "/T")), &uniform(step), None);
    let name = |what: &str| format!("h = {} ms, {what}", step * 1e3);
    let of_floor = |floor: usize| {
        outcome
            .impacts
            .iter()
            .filter(move |impact| impact.contact == floor)
    };
    let mut rows = vec![Row::absolute(
        SOURCE,
        name("number of impacts"),
        number(stored, "/contact_events"),
        outcome.impacts.len() as f64,
        0.0,
    )];
    let forces = numbers(stored, "/peak_force_N");
    let impulses = numbers(stored, "/impulse_Ns");
    for floor in 0..list(stored, "/peak_force_N").len() {
        let force = of_floor(floor).fold(0.0, |peak: f64, impact| peak.max(impact.peak_force));
        let impulse: f64 = of_floor(floor).map(|impact| impact.impulse).sum();
        let number = floor + 1;
        if forces[floor] == 0.0 {
            rows.push(Row::absolute(
                SOURCE,
                name(&format!("floor {number}, peak force [N]")),
                0.0,
                force,
                0.0,
            ));
            continue;
        }
        rows.push(Row::relative(
            SOURCE,
            name(&format!("floor {number}, peak force [N]")),
            forces[floor],
            force,
            tolerance,
        ));
        rows.push(Row::relative(
            SOURCE,
            name(&format!("floor {number}, impulse [N·s]")),
            impulses[floor],
            impulse,
            tolerance,
        ));
    }
    for (key, got) in [
        ("input", outcome.energy.input),
        ("viscous", outcome.energy.damped),
        ("contact", outcome.energy.contact),
    ] {
        let expected = number(stored, &format!("/energy_J/{key}"));
        rows.push(Row::relative(
            SOURCE,
            name(&format!("{key} energy [J]")),
            expected,
            got,
            tolerance,
        ));
    }
    rows
}
