//! Triple friction pendulums led to and fro, against stages in series that are rigid until they slide, and against the closed form of
//! first loading.

use jostle::System;
use jostle::hysteresis::{Hysteresis, HysteresisMemory};
use serde_json::Value;

use crate::data::{document, list, number, numbers};
use crate::files::model;
use crate::row::Row;

const NAME: &str = "members/k_triple_friction_pendulum";

/// Displacement before any surface slides; the reference has none \[m\].
const SLIP: f64 = 1e-9;

/// Of the greatest force or travel; the reference is stored with eight digits.
const CLOSE: f64 = 1e-7;

/// Length of a step of the reference \[m\].
const STEP: f64 = 2e-3;

/// All rows of the case.
pub(super) fn rows() -> Vec<Row> {
    let case = document(include_str!(
        "../../data/members/k_triple_friction_pendulum.json"
    ));
    let spring = spring(&case["input"]);
    vec![
        first_loading(&case, &spring),
        cyclic(&case, &spring, 1, "force"),
        cyclic(&case, &spring, 2, "inner travel"),
        cyclic(&case, &spring, 3, "lower travel"),
        cyclic(&case, &spring, 4, "upper travel"),
        energy(&case, &spring),
    ]
}

/// The bearings of a model file.
fn spring(input: &Value) -> Hysteresis {
    let file = format!(
        r#"motion = {{ kind = "sine", amplitude = 1, period = 1, duration = 1 }}
[[building]]
name = "A"
kind = "shear"
mass = [1e4]
stiffness = [1e8]
storey_height = 3
isolation = {{ kind = "triple-friction-pendulum", mat_mass = 1e4, radius = {}, friction = {}, capacity = {}, weight = {:?}, slip_displacement = {SLIP:?} }}
"#,
        input["R_eff_m"],
        input["mu"],
        input["d_m"],
        number(input, "/W_n"),
    );
    let system = System::assemble(&model(&file).model).expect("a sound model");
    system.buildings[0].equations.springs[0].hysteresis
}

/// Force at the corners of first loading; at the first one the spring slides already.
fn first_loading(case: &Value, spring: &Hysteresis) -> Row {
    let points = list(case, "/first_loading/points_u_m_F_n");
    let (mut due, mut got) = (Vec::new(), Vec::new());
    for point in points {
        let [u, force] = [number(point, "/0"), number(point, "/1")];
        due.push(force);
        got.push(
            spring
                .respond(&HysteresisMemory::default(), u.max(SLIP))
                .force,
        );
    }
    Row::worst_of(NAME, "force of first loading [N]", &due, &got, CLOSE)
}

/// What it goes through.
fn led(case: &Value, spring: &Hysteresis, mut visit: impl FnMut(f64, &HysteresisMemory)) {
    let (mut memory, mut at) = (HysteresisMemory::default(), 0.0);
    for to in numbers(case, "/input/amplitudes_m") {
        let steps = ((to - at) / STEP).abs().round().max(1.0);
        for step in 1..=steps as usize {
            let there = at + (to - at) * step as f64 / steps;
            memory = spring.respond(&memory, there).memory;
            visit(there, &memory);
        }
        at = to;
    }
}

/// One column of the table, at the displacements that it names.
fn cyclic(case: &Value, spring: &Hysteresis, column: usize, name: &str) -> Row {
    let points = list(case, "/cyclic/points");
    let (mut due, mut got) = (Vec::new(), Vec::new());
    let mut visited = 0;
    led(case, spring, |at, memory| {
        visited += 1;
        let Some(point) = points.get(due.len()) else {
            return;
        };
        if visited % 10 != 0 || (number(point, "/0") - at).abs() > 1e-6 {
            return;
        }
        due.push(number(point, &format!("/{column}")));
        got.push(match column {
            1 => memory.force(),
            stage => spring.places(memory)[stage - 2],
        });
    });
    assert_eq!(due.len(), points.len(), "every point is met");
    let unit = if column == 1 { "N" } else { "m" };
    Row::worst_of(
        NAME,
        format!("{name} to and fro [{unit}]"),
        &due,
        &got,
        CLOSE,
    )
}

/// The reference sums trapezia between its steps, from the first one on. That is 0.12 % less than the work, because corners lie within
/// steps.
fn energy(case: &Value, spring: &Hysteresis) -> Row {
    let (mut sum, mut before) = (0.0, None::<[f64; 2]>);
    led(case, spring, |at, memory| {
        let here = [at, memory.force()];
        if let Some([from, force]) = before {
            sum += 0.5 * (force + here[1]) * (at - from);
        }
        before = Some(here);
    });
    let due = number(case, "/cyclic/energy_j");
    Row::relative(NAME, "trapezia of the whole path [J]", due, sum, 1e-5)
}
