//! Walls at points of a plan, and members of a space frame, that yield, through model files, against scripts of OpenSees that do not
//! come from the exporter.

use jostle::history::{Kind, Owner, PeaksOf};
use jostle::system::Direction;
use jostle::{Pounding, Settings};
use serde_json::Value;

use crate::data::{at, document, list, number, numbers};
use crate::files::{model, run_model};
use crate::row::Row;

/// A model, what OpenSees made of it, and how far it may be off.
struct Case {
    source: &'static str,
    model: &'static str,
    answer: &'static str,
    duration: f64,
    /// Where the greatest forces of all springs stand, and what they are.
    springs: [&'static str; 2],
    /// Of greatest displacements, which OpenSees reads at the ends of steps, so that it misses (ωh)²/8 of a peak at most, and of
    /// forces, which both read there.
    tolerances: [f64; 2],
}

/// Both take the same steps with the same method; ω is 30 rad/s, and OpenSees iterates until 1e-6 N are out of balance.
const WALLS: Case = Case {
    source: "opensees/yielding_in_plan",
    model: include_str!("../data/opensees/yielding_in_plan.toml"),
    answer: include_str!("../data/opensees/yielding_in_plan.json"),
    duration: 8.0,
    springs: ["/wall_forces_peak_n", "greatest forces of walls [N]"],
    tolerances: [5e-5, 1e-8],
};

/// The same, with steps of 1 ms and ω of 20 rad/s. Springs of OpenSees stand for what is rigid here, with 10⁶ times the stiffness of a
/// column at least: forces of members that they carry beside hinges change by less than a tenth of that.
const SPACE_FRAME: Case = Case {
    source: "opensees/yielding_space_frame",
    model: include_str!("../data/opensees/yielding_space_frame.toml"),
    answer: include_str!("../data/opensees/yielding_space_frame.json"),
    duration: 5.0,
    springs: [
        "/hinge_moments_peak_n_m",
        "greatest moments of hinges [N·m]",
    ],
    tolerances: [5e-5, 1e-7],
};

/// All rows of walls.
#[must_use]
pub fn rows() -> Vec<Row> {
    compare(&WALLS)
}

/// All rows of the space frame.
#[must_use]
pub fn space_frame_rows() -> Vec<Row> {
    compare(&SPACE_FRAME)
}

fn compare(case: &Case) -> Vec<Row> {
    let (input, expected) = (model(case.model), document(case.answer));
    let [of_displacements, of_forces] = case.tolerances;
    let settings = Settings {
        pounding: Pounding::Included,
        record_interval: None,
        ..Settings::default()
    };
    let (_, outcome) = run_model(&input, None, settings, case.duration);
    let floors = outcome.peaks.floors(0);
    let moving =
        |direction| -> Vec<PeaksOf> { floors.iter().map(|floor| floor.to(direction)).collect() };
    let mut rows = Vec::new();
    let directions = [
        ("along x [m]", moving(Direction::Along)),
        ("across [m]", moving(Direction::Across)),
        ("rotation [rad]", moving(Direction::Turning)),
    ];
    type Side = (&'static str, fn(&PeaksOf<'_>) -> f64);
    let sides: [Side; 2] = [
        ("max", |peaks| peaks.displacement_max().value),
        ("min", |peaks| peaks.displacement_min().value),
    ];
    for (component, (what, peaks)) in directions.into_iter().enumerate() {
        for (side, extreme) in sides {
            let floors = list(&expected, &format!("/displacement_{side}")).iter();
            let wanted: Vec<f64> = floors
                .map(|floor| number(floor, &format!("/{component}")))
                .collect();
            let got: Vec<f64> = peaks.iter().map(extreme).collect();
            let what = format!("{side}. {what}");
            rows.push(Row::worst_of(
                case.source,
                what,
                &wanted,
                &got,
                of_displacements,
            ));
        }
    }
    let [path, what] = case.springs;
    let springs = list(&expected, path).iter();
    let each = |spring: &Value| {
        spring
            .as_f64()
            .map_or_else(|| numbers(spring, ""), |value| vec![value])
    };
    let wanted: Vec<f64> = springs.flat_map(each).collect();
    let force = |spring| {
        outcome
            .peaks
            .owned_by(Owner::Spring(spring))
            .of(Kind::Force)
    };
    let count = outcome.state.springs.len();
    let got: Vec<f64> = (0..count).map(|spring| force(spring).size()).collect();
    let what = what.to_owned();
    rows.push(Row::worst_of(case.source, what, &wanted, &got, of_forces));
    let base = numbers(at(&expected, "/base_shear_peak_n"), "");
    for (what, wanted, got) in [
        (
            "base shear along x [N]",
            base[0],
            outcome.peaks.base_shear(0),
        ),
        (
            "base shear across [N]",
            base[1],
            floors[0].across().storey_shear(),
        ),
        (
            "base torque [N·m]",
            number(&expected, "/base_torque_peak_n_m"),
            floors[0].turning().storey_shear(),
        ),
    ] {
        rows.push(Row::relative(
            case.source,
            what.to_owned(),
            wanted,
            got,
            of_forces,
        ));
    }
    rows
}
