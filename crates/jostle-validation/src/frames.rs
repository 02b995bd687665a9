//! Seven frames given node by node: frequencies, statics and 200 Newmark steps against independent programs.

use jostle::eigen::modes;
use jostle::system::BuildingSystem;
use jostle::{Plan, Solver, System};
use serde_json::Value;

use crate::data::{at, document, entries, list, number, numbers};
use crate::row::Row;
use crate::structures::{explicit_frame, run, sampled, static_answer, uniform};

const SOURCE: &str = "theory/oracle_frames";
const GRAVITY: f64 = 9.81;
const ROOF_LOAD: f64 = 1e5;

fn stored_frames() -> Value {
    document(include_str!("../data/theory/oracle_frames.json"))
}

/// One of the stored frames, undamped.
pub(crate) fn stored(name: &str) -> BuildingSystem {
    explicit_frame(name, at(&stored_frames(), &format!("/{name}")))
}

/// All rows of this family.
#[must_use]
pub fn rows() -> Vec<Row> {
    let frames = stored_frames();
    let mut rows = Vec::new();
    for (name, frame) in entries(&frames, "") {
        let building = explicit_frame(name, frame);
        rows.push(frequencies(name, frame, &building));
        rows.extend(lateral(name, frame, &building));
        rows.extend(gravity(name, frame, &building));
        for solver in [Solver::Riccati, Solver::Stiffness] {
            let expected = at(frame, "/newmark/floor_x_first_column");
            rows.extend(newmark(SOURCE, name, frame, &building, solver, expected));
        }
    }
    rows.extend(second_newmark(&frames));
    rows
}

fn frequencies(name: &str, frame: &Value, building: &BuildingSystem) -> Row {
    let expected = numbers(frame, "/omega");
    let got: Vec<f64> = modes(building, expected.len())
        .expect("the frame stands")
        .iter()
        .map(|mode| mode.circular_frequency)
        .collect();
    let relative: Vec<f64> = expected.iter().zip(&got).map(|(e, g)| g / e).collect();
    let worst = (0..expected.len())
        .max_by(|&a, &b| {
            (relative[a] - 1.0)
                .abs()
                .total_cmp(&(relative[b] - 1.0).abs())
        })
        .expect("a frame has modes");
    let quantity = format!(
        "{name}, ω₁…{}, worst: ω of mode {} [rad/s]",
        expected.len(),
        worst + 1
    );
    Row::relative(SOURCE, quantity, expected[worst], got[worst], 1e-9)
}

fn joints(frame: &Value, floor: usize) -> Vec<usize> {
    let floors = list(frame, "/floor_joint_nodes");
    let floor = if floor == usize::MAX {
        floors.len() - 1
    } else {
        floor
    };
    list(&floors[floor], "")
        .iter()
        .map(|node| node.as_u64().expect("a node") as usize)
        .collect()
}

fn lateral(name: &str, frame: &Value, building: &BuildingSystem) -> Vec<Row> {
    let roof = joints(frame, usize::MAX);
    let equations = &building.equations;
    let mut load = vec![0.0; equations.len()];
    load[equations.horizontal(roof[0]).expect("the roof moves")] = ROOF_LOAD;
    let answer = static_answer(building, load);
    let x: Vec<f64> = building
        .floors
        .iter()
        .map(|floor| answer[floor.dof])
        .collect();
    let theta = |node: &usize| answer[equations.rotation(*node).expect("joints turn")];
    let theta: Vec<f64> = roof.iter().map(theta).collect();
    let expected = |key: &str| {
        numbers(
            frame,
            &format!("/static/lateral_1e5N_roof_first_column/{key}"),
        )
    };
    vec![
        Row::worst_of(
            SOURCE,
            format!("{name}, 100 kN at the roof, x of floors [m]"),
            &expected("floor_x"),
            &x,
            1e-10,
        ),
        Row::worst_of(
            SOURCE,
            format!("{name}, 100 kN at the roof, θ of roof joints [rad]"),
            &expected("joint_theta_roof"),
            &theta,
            1e-10,
        ),
    ]
}

fn gravity(name: &str, frame: &Value, building: &BuildingSystem) -> Vec<Row> {
    let equations = &building.equations;
    let load = equations
        .vertical_mass
        .iter()
        .map(|mass| -GRAVITY * mass)
        .collect();
    let answer = static_answer(building, load);
    let first = joints(frame, 0);
    let theta = |node: &usize| answer[equations.rotation(*node).expect("joints turn")];
    let theta: Vec<f64> = first.iter().map(theta).collect();
    let expected = numbers(frame, "/static/gravity_9p81/joint_theta_floor1");
    let mut rows = Vec::new();
    if expected.iter().any(|theta| *theta != 0.0) {
        rows.push(Row::worst_of(
            SOURCE,
            format!("{name}, gravity, θ of first-floor joints [rad]"),
            &expected,
            &theta,
            1e-10,
        ));
    } else {
        let largest = theta
            .iter()
            .fold(0.0, |largest: f64, theta| largest.max(theta.abs()));
        rows.push(Row::absolute(
            SOURCE,
            format!("{name}, gravity, θ of first-floor joints [rad]"),
            0.0,
            largest,
            1e-18,
        ));
    }
    if let Some(expected) = at(frame, "/static/gravity_9p81/beam_mid_y_floor1_span0").as_f64() {
        let middle = middle_of_first_beam(building, &first);
        let y = answer[equations.vertical(middle).expect("the beam sags")];
        rows.push(Row::relative(
            SOURCE,
            format!("{name}, gravity, y in the middle of the first beam [m]"),
            expected,
            y,
            1e-10,
        ));
    }
    rows
}

/// The lumped mass in the middle between the first two joints of a floor.
fn middle_of_first_beam(building: &BuildingSystem, joints: &[usize]) -> usize {
    let nodes = &building.discretization.stick_model.nodes;
    let (a, b) = (nodes[joints[0]], nodes[joints[1]]);
    let there = |node: &&jostle::structure::Node| {
        (node.y - a.y).abs() < 1e-6 && (node.x - 0.5 * (a.x + b.x)).abs() < 1e-6
    };
    let found = nodes
        .iter()
        .find(there)
        .expect("the beam has a node in its middle");
    nodes
        .iter()
        .position(|node| node == found)
        .expect("it is one of the nodes")
}

/// a_g = 2 sin 7t + sin(23t + 0.3), from x = v = a = 0.
fn newmark(
    source: &str,
    name: &str,
    frame: &Value,
    building: &BuildingSystem,
    solver: Solver,
    expected: &Value,
) -> Vec<Row> {
    let mut building = building.clone();
    building.structure.equations.alpha = number(frame, "/newmark/alphaM");
    building.structure.equations.beta = number(frame, "/newmark/betaK");
    let step = number(frame, "/newmark/dt");
    let floors: Vec<usize> = building.floors.iter().map(|floor| floor.dof).collect();
    let system = System::of_buildings(vec![building]);
    let plan = Plan {
        solver,
        ..uniform(step)
    };
    let with = match solver {
        Solver::Riccati => "Riccati",
        Solver::Stiffness => "direct stiffness",
        Solver::Product => "product",
        Solver::Modal => "modal",
        Solver::Series => "series",
    };
    entries(expected, "")
        .map(|(steps, expected)| {
            let count = steps.parse().expect("a number of steps");
            let motion = sampled(step, count, |t| {
                2.0 * (7.0 * t).sin() + (23.0 * t + 0.3).sin()
            });
            let state = run(&system, &motion, &plan, None).state;
            let got: Vec<f64> = floors.iter().map(|dof| state.displacement[*dof]).collect();
            let quantity = format!("{name}, {with}, x of floors after {steps} steps [m]");
            Row::worst_of(source, quantity, &numbers(expected, ""), &got, 1e-9)
        })
        .collect()
}

/// Frame B by another independent calculation.
fn second_newmark(frames: &Value) -> Vec<Row> {
    let stored = document(include_str!("../data/theory/oracle_frame_newmark.json"));
    let frame = at(frames, "/B_2bay5");
    let building = explicit_frame("B_2bay5", frame);
    let expected = at(&stored, "/floor_x");
    newmark(
        "theory/oracle_frame_newmark",
        "B_2bay5",
        frame,
        &building,
        Solver::Riccati,
        expected,
    )
}
