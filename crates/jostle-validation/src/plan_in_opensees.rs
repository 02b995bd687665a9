//! Buildings in space through model files, against OpenSees on the exported script.

use jostle::history::{Peak, PeaksOf};
use jostle::system::Direction;
use jostle::{Pounding, Settings};
use jostle_io::Input;
use serde_json::Value;

use crate::data::{at, document, list, number};
use crate::fibre_ends;
use crate::files::{case, model, run_model};
use crate::row::Row;
use crate::yielding::{OF_FIBRES, of_links};

const CASES: [(&str, &str, &str, f64); 19] = [
    case!("plan_symmetric", 1e-4),
    case!("plan_eccentric", 1e-4),
    case!("plan_elements", 1e-4),
    case!("plan_five_beside_three", 1e-4),
    case!("plan_around_a_corner", 2e-4),
    // Stepped by 0.4 ms, near contact 0.04 ms.
    case!("plan_space_frames", 3e-4),
    // Corners slide off at ends of steps, which is of first order.
    case!("plan_corners", 3e-4),
    // Bearings return to their circle along the radius, which is of first order: steps five times as long moved the force of a light
    // blow by 1.9e-3, so that a quarter of that is left.
    case!("plan_isolated", 5e-4),
    case!("plan_isolated_frame", 3e-4),
    case!("plan_fibres", 3e-4),
    // Stepped by 0.2 ms, near contact 0.02 ms.
    case!("plan_frames", 3e-4),
    case!("plan_walls", 3e-4),
    case!("plan_fibre_walls", 3e-4),
    case!("plan_base", 3e-4),
    case!("plan_uplift", 3e-4),
    case!("plan_failing", 9e-4),
    case!("plan_askew", 3e-4),
    case!("plan_links", 3e-4),
    case!("plan_falling", 9e-4),
];
/// Ours, on peak forces and displacements \[–\].
const TOLERANCE: f64 = 1e-4;

/// All rows of this family.
#[must_use]
pub fn rows() -> Vec<Row> {
    CASES
        .iter()
        .flat_map(|(name, text, answer, error)| {
            compare(name, model(text), &document(answer), *error)
        })
        .collect()
}

fn compare(case: &str, mut input: Input, expected: &Value, error: f64) -> Vec<Row> {
    let source = format!("opensees/{case}");
    input.model.analysis.tolerance = TOLERANCE;
    let duration = input
        .ground_motion()
        .expect("the record is built in")
        .duration;
    let settings = Settings {
        pounding: Pounding::Included,
        record_interval: None,
        ..Settings::default()
    };
    let (system, outcome) = run_model(&input, None, settings, duration);
    let tolerance = TOLERANCE + error;
    let mut rows = Vec::new();
    // Walls that give way come after the buildings; jostle counts their motion along their normals.
    let buildings = list(expected, "/buildings").iter().enumerate();
    for (index, stored) in buildings.take(input.model.buildings.len()) {
        let name = &system.buildings[index].name;
        let own = fibre_ends::rows(&source, (&system, &outcome), index, stored, OF_FIBRES);
        rows.extend(own);
        // Of an isolated building the mat comes first.
        let mat = outcome.peaks.floor(index, 0);
        let mat = mat.across().moves().then_some(mat);
        let floors: Vec<PeaksOf> = mat.into_iter().chain(outcome.peaks.floors(index)).collect();
        for (what, key, unit, direction) in [
            ("along x [m]", "displacement", "m", Direction::Along),
            ("across [m]", "displacement_across", "m", Direction::Across),
            ("rotations [rad]", "rotation", "rad", Direction::Turning),
        ] {
            type Side = (&'static str, fn(Peak) -> f64);
            let sides: [Side; 2] = [
                ("max", |peak| peak.greatest.value),
                ("min", |peak| peak.least.value),
            ];
            for (side, extreme) in sides {
                let wanted: Vec<f64> = list(stored, "/floors")
                    .iter()
                    .map(|floor| number(floor, &format!("/{key}_{side}_{unit}")))
                    .collect();
                // Of buildings that do not move in a direction only rounding is left.
                if wanted.iter().all(|value| value.abs() < 1e-9) {
                    continue;
                }
                let moved = floors
                    .iter()
                    .map(|floor| floor.to(direction).displacement());
                let got: Vec<f64> = moved.map(extreme).collect();
                rows.push(Row::worst_of(
                    &source,
                    format!("{name}, {side}. {what}"),
                    &wanted,
                    &got,
                    tolerance,
                ));
            }
        }
    }
    for stored in list(expected, "/faces") {
        let face = number(stored, "/face") as usize;
        let impacts: Vec<f64> = outcome
            .face_impacts
            .iter()
            .filter(|impact| impact.face == face)
            .map(|impact| impact.peak_force.value)
            .collect();
        let kind = at(stored, "/kind").as_str().unwrap_or_default();
        let wanted = number(stored, "/impact_count");
        rows.push(Row::absolute(
            &source,
            format!("{kind} {face}, impacts"),
            wanted,
            impacts.len() as f64,
            0.0,
        ));
        if wanted > 0.0 {
            rows.push(Row::relative(
                &source,
                format!("{kind} {face}, peak force [N]"),
                number(stored, "/peak_force_n"),
                impacts.iter().copied().fold(0.0, f64::max),
                tolerance,
            ));
        }
    }
    rows.extend(of_links(&source, (&system, &outcome), expected, tolerance));
    rows
}
