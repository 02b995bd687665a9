//! Walls at points of a plan that yield, through a model file, against a script of OpenSees that does not come from the exporter.

use jostle::history::FloorPeaks;
use jostle::{Pounding, Settings};
use serde_json::Value;

use crate::data::{at, document, list, number, numbers};
use crate::files::{model, run_model};
use crate::row::Row;

const SOURCE: &str = "opensees/yielding_in_plan";
/// Both take the same steps with the same method. OpenSees reads displacements at the ends of steps and so misses (ωh)²/8 of a peak at
/// most, with ω of 30 rad/s.
const DISPLACEMENTS: f64 = 5e-5;
/// Forces are read at the ends of steps by both; OpenSees iterates until 1e-6 N are out of balance.
const FORCES: f64 = 1e-8;

/// All rows of this family.
#[must_use]
pub fn rows() -> Vec<Row> {
    let input = model(include_str!("../data/opensees/yielding_in_plan.toml"));
    let expected = document(include_str!("../data/opensees/yielding_in_plan.json"));
    let settings = Settings {
        pounding: Pounding::Included,
        record_interval: None,
    };
    let (_, outcome) = run_model(&input, None, settings, 8.0);
    let plan = &outcome.in_plan[0];
    let mut rows = Vec::new();
    let directions = [
        ("along x [m]", &outcome.floors[0]),
        ("across [m]", &plan.across),
        ("rotation [rad]", &plan.turning),
    ];
    type Side = (&'static str, fn(&FloorPeaks) -> f64);
    let sides: [Side; 2] = [
        ("max", |peaks| peaks.displacement_max.value),
        ("min", |peaks| peaks.displacement_min.value),
    ];
    for (component, (what, peaks)) in directions.into_iter().enumerate() {
        for (side, own) in sides {
            let floors = list(&expected, &format!("/displacement_{side}")).iter();
            let wanted: Vec<f64> = floors
                .map(|floor| number(floor, &format!("/{component}")))
                .collect();
            let got: Vec<f64> = peaks.iter().map(own).collect();
            let what = format!("{side}. {what}");
            rows.push(Row::worst_of(SOURCE, what, &wanted, &got, DISPLACEMENTS));
        }
    }
    let walls = list(&expected, "/wall_forces_peak_n").iter();
    let wanted: Vec<f64> = walls.flat_map(|wall: &Value| numbers(wall, "")).collect();
    let got: Vec<f64> = outcome.springs.iter().map(|own| own.peak_force).collect();
    let what = "greatest forces of walls [N]".to_owned();
    rows.push(Row::worst_of(SOURCE, what, &wanted, &got, FORCES));
    let base = numbers(at(&expected, "/base_shear_peak_n"), "");
    for (what, wanted, got) in [
        ("base shear along x [N]", base[0], outcome.base_shear[0]),
        (
            "base shear across [N]",
            base[1],
            plan.across[0].storey_shear,
        ),
        (
            "base torque [N·m]",
            number(&expected, "/base_torque_peak_n_m"),
            plan.turning[0].storey_shear,
        ),
    ] {
        rows.push(Row::relative(SOURCE, what.to_owned(), wanted, got, FORCES));
    }
    rows
}
