//! Free floors that collide once, from given velocities: independent integrations in high accuracy, which momentum and closed forms of
//! rigid bodies confirm.

use std::ops::ControlFlow;

use jostle::stepping::simulate_from;
use jostle::{
    Analysis, Building, ContactLaw, Damping, Gap, GroundMotion, LawKind, Model, Outcome, Plan,
    PlanContact, RestitutionIs, Settings, State, Structure, System, Tier, TierStorey, Tiers,
};
use serde_json::Value;

use crate::data::{at, document, list, number, numbers};
use crate::row::Row;
use crate::space::{point, points};

/// Tolerance of the program, and that of the comparison: the references are good to 1e-8.
const RUNS: [(f64, f64); 2] = [(1e-3, 1e-4), (1e-6, 1e-6)];

/// Circular frequency of the springs that hold the floors, so soft that they change displacements of 0.3 s by 5e-10 \[rad/s\].
const ALMOST_FREE: f64 = 1e-4;

/// The references read sums of the points of a face at the ends of their own steps, which miss the top by up to 3.3e-5.
const SUMS: f64 = 4e-5;

/// The top of the sum of the points of S2b under `hertz`, from an integration with continuous output (DOP853, relative tolerance
/// 1e-13, steps of at most 20 µs), which agrees with the reference in all else \[N\].
const TOP_OF_HERTZ: f64 = 1_938_075.484_49;

/// All rows of this family.
#[must_use]
pub fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    for (name, text) in [
        (
            "space/S2a_central",
            include_str!("../data/space/S2a_central.json"),
        ),
        (
            "space/S2b_eccentric_face",
            include_str!("../data/space/S2b_eccentric_face.json"),
        ),
        (
            "space/S2c_corner_on_edge",
            include_str!("../data/space/S2c_corner_on_edge.json"),
        ),
        (
            "space/S3a_corner_slides",
            include_str!("../data/space/S3a_corner_slides.json"),
        ),
        (
            "space/S3b_corner_sticks",
            include_str!("../data/space/S3b_corner_sticks.json"),
        ),
        (
            "space/S3c_face",
            include_str!("../data/space/S3c_face.json"),
        ),
    ] {
        let document = document(text);
        let inputs = at(&document, "/inputs");
        for case in list(&document, "/cases") {
            for (tolerance, limit) in RUNS {
                rows.extend(compare(name, inputs, case, tolerance, limit));
            }
        }
    }
    rows
}

fn building(stored: &Value) -> Building {
    let floor = &list(stored, "/floors")[0];
    let tier = Tier {
        mass: number(floor, "/mass_kg"),
        polar_mass: number(floor, "/polar_mass_kg_m2"),
        centre: point(at(floor, "/centre_of_mass_m")),
        plan: points(at(floor, "/corners_m")),
    };
    let squared = ALMOST_FREE * ALMOST_FREE;
    let [sway, torsion] = [tier.mass * squared, tier.polar_mass * squared];
    Building {
        name: at(stored, "/name").as_str().expect("a name").to_owned(),
        structure: Structure::Tiers(Tiers {
            storeys: vec![TierStorey {
                stiffness: [sway, sway, torsion],
                centre: tier.centre,
            }],
            storey_heights: vec![number(floor, "/height_m")],
            floors: vec![tier],
            ..Tiers::default()
        }),
        damping: Damping::Rayleigh {
            alpha: 0.0,
            beta: 0.0,
        },
        ..Building::default()
    }
}

fn model(inputs: &Value, case: &Value, tolerance: f64) -> Model {
    let contacts = list(case, "/contacts");
    let first = &contacts[0];
    let share = number(first, "/share");
    let law = ContactLaw {
        kind: LawKind::from_name(at(case, "/law").as_str().expect("a law")).expect("a known law"),
        stiffness: number(first, "/stiffness") / share,
        restitution: case["restitution_put_in"].as_f64().unwrap_or(1.0),
        restitution_is: RestitutionIs::Input,
    };
    let width = contacts.iter().map(|contact| number(contact, "/gap_m"));
    let width = width.fold(f64::INFINITY, f64::min);
    let mut gap = Gap::between([Some(0), Some(1)], width, law);
    gap.in_plan = PlanContact {
        // A corner has one point, whatever is asked of faces.
        points: contacts.len().max(2),
        friction: first["friction"].as_f64().unwrap_or(0.0),
        tangential_stiffness: first["tangential_stiffness_n_m"]
            .as_f64()
            .map(|contact| contact / share),
        ..PlanContact::default()
    };
    Model {
        title: "free floors".to_owned(),
        buildings: list(inputs, "/buildings").iter().map(building).collect(),
        gaps: vec![gap],
        analysis: Analysis {
            tolerance,
            ..Analysis::default()
        },
        ..Model::default()
    }
}

/// A run from the velocities of the case.
fn run(system: &System, model: &Model, inputs: &Value) -> Outcome {
    let duration = number(inputs, "/duration_s");
    let still = GroundMotion::sampled("still", 0.5 * duration, vec![0.0; 3]);
    let plan = Plan::choose(system, &still, &model.analysis).expect("modal stepping");
    let mut state = State::at_rest(system, 0.0);
    let velocities = numbers(inputs, "/initial_velocity");
    for (building, building_velocities) in system.buildings.iter().zip(velocities.chunks_exact(3)) {
        for (track, velocity) in building.tracks.iter().zip(building_velocities) {
            state.velocity[track.dof] = *velocity;
        }
    }
    let settings = Settings {
        record_interval: None,
        ..Settings::default()
    };
    simulate_from(system, &still, &plan, settings, state, |_| {
        ControlFlow::Continue(())
    })
}

/// Velocities and displacements at the end, forces, impulses and work, relative to the greatest of their kind.
fn compare(source: &str, inputs: &Value, case: &Value, tolerance: f64, limit: f64) -> Vec<Row> {
    let model = model(inputs, case, tolerance);
    let system = System::assemble(&model).expect("a sound model");
    let outcome = run(&system, &model, inputs);
    let law = at(case, "/law").as_str().unwrap_or_default();
    let mut rows = Vec::new();
    let mut kind = |what: &str, expected: Vec<f64>, got: Vec<f64>| {
        let greatest = expected.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        if greatest < 1e-9 {
            return;
        }
        assert_eq!(expected.len(), got.len(), "{source}, {law}: {what}");
        let apart = expected.iter().zip(&got).map(|(a, b)| b - a);
        let worst = apart.fold(0.0, |most: f64, apart| {
            if apart.abs() > most.abs() {
                apart
            } else {
                most
            }
        });
        rows.push(Row::relative(
            source,
            format!(
                "{law}, tolerance {tolerance:.0e}, {what}, worst of {}",
                got.len()
            ),
            greatest,
            greatest + worst,
            limit,
        ));
    };
    let tracks = || {
        system
            .buildings
            .iter()
            .flat_map(|building| &building.tracks)
    };
    kind(
        "velocities after the impact [m/s, rad/s]",
        numbers(case, "/velocity_after"),
        tracks()
            .map(|track| outcome.state.velocity[track.dof])
            .collect(),
    );
    kind(
        "displacements at the end [m, rad]",
        numbers(case, "/displacement_at_end"),
        tracks()
            .map(|track| outcome.state.displacement[track.dof])
            .collect(),
    );
    let contacts = list(case, "/contacts_expected");
    let all = 0..system.contacts.len();
    let impacts = |contact: usize| {
        let all = outcome.impacts.iter();
        all.filter(move |impact| impact.contact == contact)
    };
    let of = |key: &str| {
        contacts
            .iter()
            .map(|contact| number(contact, key))
            .collect()
    };
    kind(
        "numbers of impacts",
        of("/impact_count"),
        all.clone()
            .map(|impact| impacts(impact).count() as f64)
            .collect(),
    );
    kind(
        "peak forces of points [N]",
        of("/peak_force_n"),
        all.clone()
            .map(|contact| {
                impacts(contact)
                    .map(|impact| impact.peak_force)
                    .fold(0.0, f64::max)
            })
            .collect(),
    );
    // Along the normal and along the face, relative to the greatest.
    let mut expected: Vec<f64> = of("/impulse_n_s");
    expected.extend::<Vec<f64>>(of("/tangential_impulse_n_s"));
    let normal = all
        .clone()
        .map(|contact| impacts(contact).map(|impact| impact.impulse).sum());
    let tangential = all.map(|contact| impacts(contact).map(|impact| impact.sliding.impulse).sum());
    kind(
        "impulses [N·s]",
        expected,
        normal.chain(tangential).collect(),
    );
    let faces = list(case, "/faces_expected").iter();
    let stored = faces
        .map(|face| number(face, "/peak_force_n"))
        .fold(0.0, f64::max);
    let tops = outcome
        .face_impacts
        .iter()
        .map(|face_impact| face_impact.peak_force.value);
    let top = tops.fold(0.0, f64::max);
    let mut sum = |what: &str, expected: f64, limit: f64| {
        let quantity = format!("{law}, tolerance {tolerance:.0e}, {what}");
        rows.push(Row::relative(source, quantity, expected, top, limit));
    };
    sum("peak force of the face [N]", stored, limit.max(SUMS));
    if (source, law) == ("space/S2b_eccentric_face", "hertz") {
        sum("top of the force of the face [N]", TOP_OF_HERTZ, limit);
    }
    rows
}
