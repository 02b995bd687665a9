//! A stick on a footing that lifts off, against an integrator of eighth order.

use std::ops::ControlFlow;

use jostle::history::{Column, Kind, Owner};
use jostle::{Plan, Settings, System, simulate};
use serde_json::Value;

use super::files::GRAVITY;
use crate::data::{document, number};
use crate::files::model;
use crate::row::Row;

const NAME: &str = "members/h_rocking_footing";

/// Tolerances of the program, and of the comparison.
const RUNS: [(f64, f64); 3] = [(1e-3, 1e-3), (1e-5, 1e-5), (1e-6, 1e-6)];

/// All rows of the case.
pub(super) fn rows() -> Vec<Row> {
    let case = document(include_str!("../../data/members/h_rocking_footing.json"));
    let runs = RUNS.into_iter();
    runs.flat_map(|(tolerance, close)| compare(&case, tolerance, close))
        .collect()
}

/// The model file.
fn file(input: &Value, tolerance: f64) -> String {
    let of = |key: &str| number(input, key);
    format!(
        r#"motion = {{ record = "el-centro-1940-ns", scale = {scale:?}, duration = {duration:?} }}
analysis = {{ tolerance = {tolerance:?} }}
[[building]]
name = "J"
kind = "frame"
storeys = 1
storey_height = {height:?}
spans = []
column = {{ EI = {bending:?}, EA = {axial:?} }}
beam = {{ EI = 1 }}
density = 0
column_segments = 1
floor_mass = {mass:?}
axial = "flexible"
gravity = true
damping = {{ alpha = {alpha:?}, beta = 0, relative_to = "ground" }}
foundation = {{ length = {length:?}, width = 1, mass = {own:?}, rotary_inertia = {turned:?}, uplift = true, springs = 2, vertical_stiffness = {stiffness:?}, vertical_damping = {damping:?} }}
"#,
        scale = GRAVITY * of("/scale"),
        duration = of("/duration_s"),
        height = of("/height_m"),
        bending = of("/EI"),
        axial = of("/EA"),
        mass = of("/mass_kg"),
        alpha = of("/alpha"),
        length = of("/spring_x_m/1") - of("/spring_x_m/0"),
        own = of("/footing_mass_kg"),
        turned = of("/footing_inertia_kg_m2"),
        stiffness = of("/spring_k/0") + of("/spring_k/1"),
        damping = of("/spring_c/0") + of("/spring_c/1"),
    )
}

fn compare(case: &Value, tolerance: f64, close: f64) -> Vec<Row> {
    let input = model(&file(&case["input"], tolerance));
    let system = System::assemble(&input.model).expect("a sound model");
    let motion = input.ground_motion().expect("the record is built in");
    let plan = Plan::choose(&system, &motion, &input.model.analysis).expect("a sound plan");
    let outcome = simulate(&system, &motion, &plan, Settings::default(), |_| {
        ControlFlow::Continue(())
    });
    let building = &system.buildings[0];
    let foundation = building.foundation.expect("it stands on one");
    let of_foundation = Column::along(Owner::Foundation(0), Kind::Displacement);
    let followed = [
        ("top", Column::displacement(0, 1)),
        ("foot.rise", of_foundation.up()),
        ("foot.rotation", of_foundation.turning()),
    ];
    let (mut expected, mut got) = (Vec::new(), Vec::new());
    let mut rows = Vec::new();
    for (name, column) in followed {
        let peak = outcome.peaks.get(column).expect("it is followed");
        let place = format!("/results/displacement/{name}");
        let due = ["max_m", "min_m"].map(|key| number(case, &format!("{place}/{key}")));
        let quantity = format!("peaks of {name} [m, rad], tolerance {tolerance:e}");
        let found = [peak.greatest.value, peak.least.value];
        rows.push(Row::worst_of(NAME, quantity, &due, &found, close));
    }
    let top = building.discretization.floors[0];
    let u = &outcome.state.displacement;
    let at_the_end = [
        ("top", building.equations.horizontal(top)),
        ("top.rise", building.equations.vertical(top)),
        ("foot.rise", foundation.rise),
        ("foot.rotation", Some(foundation.turning)),
    ];
    for (name, dof) in at_the_end {
        expected.push(number(case, &format!("/results/histories/{name}/10")));
        got.push(u[dof.expect("it moves")]);
    }
    let quantity = format!("displacements at 10 s [m, rad], tolerance {tolerance:e}");
    rows.push(Row::worst_of(NAME, quantity, &expected, &got, close));
    let force = |spring: usize| {
        let peaks = outcome.peaks.owned_by(Owner::Spring(spring));
        -peaks.of(Kind::Force).size()
    };
    let due = ["soil1", "soil2"].map(|soil| number(case, &format!("/results/force/{soil}/min")));
    let quantity = format!("forces of contact springs [N], tolerance {tolerance:e}");
    rows.push(Row::worst_of(
        NAME,
        quantity,
        &due,
        &[force(0), force(1)],
        close,
    ));
    rows
}
