//! Buildings on bearings, and moat walls: independent integrations in high accuracy.

use std::ops::ControlFlow;

use jostle::hysteresis::Hysteresis;
use jostle::structure::{Discretization, Node, Spring, StickModel, Support};
use jostle::system::BuildingSystem;
use jostle::{
    Analysis, Base, Building, ContactLaw, Damping, FloorPairs, Gap, GroundMotion, Isolation,
    Isolator, LawKind, Level, Model, Outcome, Plan, RestitutionIs, RunEnd, Settings, Shear, Solver,
    SpeedFriction, Structure, System, Wall, simulate,
};
use jostle_io::builtin_record;
use serde_json::Value;

use crate::data::{at, document, list, number, numbers};
use crate::files::{model, run_model};
use crate::row::Row;

/// Free-vibration and contact step \[s\], and the tolerance of the comparison: the method is of second order.
const FINE: ([f64; 2], f64) = ([2e-4, 2e-5], 2e-5);
/// Automatic steps at this tolerance.
const AUTOMATIC: f64 = 1e-3;

/// All rows of this family.
#[must_use]
pub fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    for (name, text) in [
        (
            "ground/G1a_lead_rubber_el_centro",
            include_str!("../data/ground/G1a_lead_rubber_el_centro.json"),
        ),
        (
            "ground/G1b_lead_rubber_damping_relative_to_mat",
            include_str!("../data/ground/G1b_lead_rubber_damping_relative_to_mat.json"),
        ),
        (
            "ground/G2a_moat_wall_hertz_damp",
            include_str!("../data/ground/G2a_moat_wall_hertz_damp.json"),
        ),
        (
            "ground/G2b_moat_wall_linear",
            include_str!("../data/ground/G2b_moat_wall_linear.json"),
        ),
        (
            "ground/G2c_moat_wall_many_impacts",
            include_str!("../data/ground/G2c_moat_wall_many_impacts.json"),
        ),
        (
            "ground/G3c_friction_pendulum_five_storeys",
            include_str!("../data/ground/G3c_friction_pendulum_five_storeys.json"),
        ),
    ] {
        let case = document(text);
        rows.extend(building_case(name, &case));
        if name.contains("pendulum") {
            rows.extend(file_case(name, &case));
        }
    }
    for (name, text) in [
        (
            "ground/G3a_friction_pendulum_sdof",
            include_str!("../data/ground/G3a_friction_pendulum_sdof.json"),
        ),
        (
            "ground/G3b_friction_pendulum_velocity",
            include_str!("../data/ground/G3b_friction_pendulum_velocity.json"),
        ),
    ] {
        let case = document(text);
        rows.extend(block_case(name, &case));
        rows.extend(file_case(name, &case));
    }
    rows
}

fn friction(stored: &Value) -> SpeedFriction {
    match stored["friction"].as_f64() {
        Some(constant) => SpeedFriction::constant(constant),
        None => SpeedFriction {
            slow: number(stored, "/friction_slow"),
            fast: number(stored, "/friction_fast"),
            rate: number(stored, "/rate_s_m"),
        },
    }
}

fn isolation(stored: &Value, mat_mass: f64) -> Isolation {
    let isolator = match at(stored, "/kind").as_str() {
        Some("lead-rubber") => {
            let stiffness = number(stored, "/initial_stiffness_n_m");
            Isolator::LeadRubber {
                stiffness,
                yield_force: number(stored, "/yield_force_n"),
                post_yield: number(stored, "/post_yield_stiffness_n_m") / stiffness,
            }
        }
        _ => Isolator::Pendulum {
            radius: number(stored, "/radius_m"),
            friction: friction(stored),
            slip_displacement: number(stored, "/slip_displacement_m"),
        },
    };
    Isolation {
        weight: stored["weight_n"].as_f64(),
        ..Isolation::new(isolator, mat_mass)
    }
}

fn model_of(inputs: &Value) -> Model {
    let stored = at(inputs, "/building");
    let mass = numbers(stored, "/floor_mass_kg");
    let damping = at(stored, "/superstructure_damping");
    let building = Building {
        name: "A".to_owned(),
        structure: Structure::Shear(Shear {
            stiffness: numbers(stored, "/storey_stiffness_n_m"),
            storey_heights: vec![number(stored, "/storey_height_m"); mass.len()],
            mass,
        }),
        damping: Damping::Rayleigh {
            alpha: number(damping, "/alpha_1_s"),
            beta: number(damping, "/beta_s"),
        },
        base: Base {
            isolation: Some(isolation(
                at(inputs, "/isolation"),
                number(stored, "/mat_mass_kg"),
            )),
            ..Base::default()
        },
        ..Building::default()
    };
    let (mut walls, mut gaps) = (Vec::new(), Vec::new());
    if let Some(stored) = inputs.get("wall") {
        walls.push(Wall {
            name: "moat".to_owned(),
            stiffness: Some(number(stored, "/stiffness_n_m")),
            damping: number(stored, "/damping_n_s_m"),
            mass: number(stored, "/mass_kg"),
            line: None,
        });
        let contact = at(inputs, "/contact");
        let law = at(contact, "/law").as_str().expect("a law");
        let law = ContactLaw {
            kind: LawKind::from_name(law).expect("a known law"),
            stiffness: number(contact, "/stiffness"),
            restitution: contact["restitution_input"].as_f64().unwrap_or(1.0),
            restitution_is: RestitutionIs::Input,
        };
        let mut gap = Gap::between([Some(0), Some(1)], number(inputs, "/gap_m"), law);
        gap.floors = FloorPairs::Listed(vec![[Level::Floor(0), Level::Wall]]);
        gaps.push(gap);
    }
    Model {
        title: "ground".to_owned(),
        buildings: vec![building],
        gaps,
        walls,
        ..Model::default()
    }
}

fn motion(inputs: &Value) -> GroundMotion {
    let mut record = builtin_record("el-centro-1940-ns").expect("it is built in");
    record.duration = number(inputs, "/duration_s");
    record.scale *= number(inputs, "/motion/factor");
    record
}

fn run(system: &System, motion: &GroundMotion, analysis: &Analysis) -> Outcome {
    let plan = Plan::choose(system, motion, analysis).expect("steps");
    let settings = Settings {
        record_interval: None,
        ..Settings::default()
    };
    let outcome = simulate(system, motion, &plan, settings, |_| {
        ControlFlow::Continue(())
    });
    assert_eq!(outcome.end, RunEnd::Completed);
    outcome
}

/// Automatic steps, and small ones: what to call them, settings, and tolerance of the comparison.
fn settings() -> [(&'static str, Analysis, f64); 2] {
    let ([step, contact_step], limit) = FINE;
    let fine = Analysis {
        step: Some(step),
        contact_step: Some(contact_step),
        solver: Some(Solver::Riccati),
        ..Analysis::default()
    };
    let automatic = Analysis {
        tolerance: AUTOMATIC,
        ..Analysis::default()
    };
    [
        ("automatic steps", automatic, AUTOMATIC),
        ("small steps", fine, limit),
    ]
}

/// The worst of pairs of expected and computed numbers, relative to the greatest expected one.
fn worst(source: &str, what: String, pairs: &[(f64, f64)], limit: f64) -> Row {
    let greatest = pairs
        .iter()
        .fold(0.0, |most: f64, pair| most.max(pair.0.abs()));
    let apart = |pair: &(f64, f64)| (pair.1 - pair.0).abs();
    let worst = pairs.iter().max_by(|a, b| apart(a).total_cmp(&apart(b)));
    let worst = worst.copied().unwrap_or_default();
    Row::relative(
        source,
        format!("{what}, worst of {}", pairs.len()),
        greatest,
        greatest + (worst.1 - worst.0),
        limit,
    )
}

fn building_case(source: &str, case: &Value) -> Vec<Row> {
    let inputs = at(case, "/inputs");
    let model = model_of(inputs);
    let system = System::assemble(&model).expect("a sound model");
    let motion = motion(inputs);
    let mut rows = Vec::new();
    for (steps, analysis, limit) in settings() {
        let outcome = run(&system, &motion, &analysis);
        let peak = |name: &str, which: &str| number(case, &format!("/peaks/{name}/{which}/value"));
        let floors = &outcome.peaks.floors(0);
        let mat = &outcome.peaks.floor(0, 0);
        let mut displacements = vec![
            (peak("mat", "max"), mat.displacement_max().value),
            (peak("mat", "min"), mat.displacement_min().value),
        ];
        let both = |name: &str| peak(name, "max").abs().max(peak(name, "min").abs());
        let mut accelerations = vec![(both("total_acceleration_1"), mat.total_acceleration())];
        for (index, floor) in floors.iter().enumerate() {
            let name = format!("floor{}", index + 1);
            displacements.push((peak(&name, "max"), floor.displacement_max().value));
            displacements.push((peak(&name, "min"), floor.displacement_min().value));
            let name = format!("total_acceleration_{}", index + 2);
            accelerations.push((both(&name), floor.total_acceleration()));
        }
        let mut row = |what: &str, pairs: &[(f64, f64)], limit: f64| {
            rows.push(worst(source, format!("{steps}, {what}"), pairs, limit));
        };
        row("displacements [m]", &displacements, limit);
        row("total accelerations [m/s2]", &accelerations, 10.0 * limit);
        let energy = |key: &str| number(case, &format!("/energy_at_end/{key}"));
        row(
            "energies [J]",
            &[
                (energy("input_j"), outcome.energy.input),
                (energy("damped_j"), outcome.energy.damped),
            ],
            limit,
        );
        if inputs.get("wall").is_none() {
            continue;
        }
        let wall = &outcome.peaks.floor(1, 0);
        row(
            "displacements of the wall [m]",
            &[
                (peak("moat", "max"), wall.displacement_max().value),
                (peak("moat", "min"), wall.displacement_min().value),
            ],
            limit,
        );
        let contact = at(case, "/contacts/mat-moat");
        let impacts = list(contact, "/impacts");
        let pairs = |key: &str, of: fn(&jostle::Impact) -> f64| -> Vec<(f64, f64)> {
            let both = impacts.iter().zip(&outcome.impacts);
            both.map(|(stored, got)| (number(stored, key), of(got)))
                .collect()
        };
        row(
            "number of impacts [-]",
            &[(impacts.len() as f64, outcome.impacts.len() as f64)],
            1e-12,
        );
        row(
            "instants of touch [s]",
            &pairs("/start_s", |impact| impact.start),
            limit,
        );
        row(
            "peak forces of impacts [N]",
            &pairs("/peak_force_n", |impact| impact.peak_force),
            limit,
        );
        row(
            "impulses [N.s]",
            &pairs("/impulse_n_s", |impact| impact.impulse),
            limit,
        );
    }
    rows
}

/// A rigid block on sliding bearings alone.
fn block_case(source: &str, case: &Value) -> Vec<Row> {
    let inputs = at(case, "/inputs");
    let stored = at(inputs, "/isolation");
    let (weight, mass) = (number(stored, "/weight_n"), number(inputs, "/mass_kg"));
    let law = friction(stored);
    let node = |support: Support, mass: f64| {
        let at = Node::at(0.0, if mass > 0.0 { 1.0 } else { 0.0 });
        at.with_mass(mass).held(support)
    };
    let slider = Hysteresis::sliding(
        number(stored, "/stick_stiffness_n_m"),
        [law.slow, law.fast].map(|mu| mu * weight),
        law.rate,
    );
    let springs = [
        Spring::elastic([0, 1], weight / number(stored, "/radius_m")),
        Spring {
            hysteresis: Some(slider.expect("sound numbers")),
            ..Spring::elastic([0, 1], 0.0)
        },
    ];
    let sticks = StickModel {
        nodes: vec![node(Support::Fixed, 0.0), node(Support::Guided, mass)],
        springs: springs.to_vec(),
        ..StickModel::default()
    };
    let discretization = Discretization {
        stick_model: sticks,
        floors: vec![1],
        left_face: vec![1],
        right_face: vec![1],
        ..Discretization::default()
    };
    let system = System::of_buildings(vec![BuildingSystem::new("block", discretization)]);
    let motion = motion(inputs);
    let mut rows = Vec::new();
    for (steps, analysis, limit) in settings() {
        let outcome = run(&system, &motion, &analysis);
        let peak = |which: &str| number(case, &format!("/peaks/u/{which}/value"));
        let floor = outcome.peaks.floor(0, 1);
        rows.push(worst(
            source,
            format!("{steps}, displacements [m]"),
            &[
                (peak("max"), floor.displacement_max().value),
                (peak("min"), floor.displacement_min().value),
            ],
            limit,
        ));
        let input = number(case, "/energy_at_end/input_j");
        rows.push(worst(
            source,
            format!("{steps}, input energy [J]"),
            &[(input, outcome.energy.input)],
            limit,
        ));
    }
    rows
}

/// Mass \[kg\] and stiffness \[N/m\] of the storey of a block, which in a model file is a mat with almost all of its mass.
const LIGHT_STOREY: [f64; 2] = [100.0, 1e7];

/// Sliding bearings through a model file, as a user writes it.
fn file_case(source: &str, case: &Value) -> Vec<Row> {
    let inputs = at(case, "/inputs");
    let stored = at(inputs, "/isolation");
    let (mass, stiffness, mat, beta, name) = match inputs.get("building") {
        Some(building) => (
            numbers(building, "/floor_mass_kg"),
            numbers(building, "/storey_stiffness_n_m"),
            number(building, "/mat_mass_kg"),
            number(building, "/superstructure_damping/beta_s"),
            "mat",
        ),
        None => {
            let [mass, stiffness] = LIGHT_STOREY;
            let mat = number(inputs, "/mass_kg") - mass;
            (vec![mass], vec![stiffness], mat, 0.0, "u")
        }
    };
    let law = friction(stored);
    let friction = if law.is_constant() {
        law.slow.to_string()
    } else {
        let SpeedFriction { slow, fast, rate } = law;
        format!("{{ slow = {slow:?}, fast = {fast:?}, rate = {rate:?} }}")
    };
    let duration = number(inputs, "/duration_s");
    let text = format!(
        r#"
[motion]
record = "el-centro-1940-ns"
scale = {:?}
duration = {duration:?}
[[building]]
name = "A"
kind = "shear"
storey_height = 3.2
mass = {mass:?}
stiffness = {stiffness:?}
damping = {{ alpha = 0, beta = {beta:?} }}
[building.isolation]
kind = "friction-pendulum"
mat_mass = {mat:?}
weight = {:?}
radius = {:?}
slip_displacement = {:?}
friction = {friction}
"#,
        number(inputs, "/motion/factor"),
        number(stored, "/weight_n"),
        number(stored, "/radius_m"),
        number(stored, "/slip_displacement_m"),
    );
    let mut input = model(&text);
    let mut rows = Vec::new();
    for (steps, analysis, limit) in settings() {
        input.model.analysis = analysis;
        let settings = Settings {
            record_interval: None,
            ..Settings::default()
        };
        let (_, outcome) = run_model(&input, None, settings, duration);
        let mat = &outcome.peaks.floor(0, 0);
        let peak = |which: &str| number(case, &format!("/peaks/{name}/{which}/value"));
        rows.push(worst(
            source,
            format!("model file, {steps}, displacements of the mat [m]"),
            &[
                (peak("max"), mat.displacement_max().value),
                (peak("min"), mat.displacement_min().value),
            ],
            limit,
        ));
    }
    rows
}
