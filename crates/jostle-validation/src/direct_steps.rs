//! Direct steps of what yields, slides and strikes, at several tolerances, against an independent program.

use jostle::{Outcome, Pounding, Settings, System};
use jostle_io::{Format, Input, read_model_text};

use crate::data::{document, list, number};
use crate::files::run_model;
use crate::row::Row;

/// A model with its number.
struct Case {
    name: &'static str,
    model: &'static str,
    what: &'static str,
    number: fn(&System, &Outcome) -> f64,
    /// The greatest of its kind in the building or gap.
    greatest: fn(&System, &Outcome) -> f64,
}

const CASES: [Case; 3] = [
    Case {
        name: "isolated_18",
        model: include_str!("../data/direct/isolated_18.json"),
        what: "impulse at floor 3 [N·s]",
        number: |system, outcome| impulse(system, outcome),
        greatest: |system, outcome| impulse(system, outcome),
    },
    Case {
        name: "isolated_33",
        model: include_str!("../data/direct/isolated_33.json"),
        what: "acceleration of floor 1 of B2 [m/s²]",
        number: |_, outcome| outcome.peaks.floor(1, 1).total_acceleration(),
        greatest: |_, outcome| acceleration(outcome, 1),
    },
    Case {
        name: "isolated_49",
        model: include_str!("../data/direct/isolated_49.json"),
        what: "acceleration of the mat [m/s²]",
        number: |_, outcome| outcome.peaks.floor(0, 0).total_acceleration(),
        greatest: |_, outcome| acceleration(outcome, 0),
    },
];

/// Tolerances of runs.
const TOLERANCES: [f64; 3] = [1e-3, 5e-4, 2e-4];

fn impulse(system: &System, outcome: &Outcome) -> f64 {
    let at_floor = |contact: usize| system.contacts[contact].ports.floors() == [Some(3), Some(3)];
    let impacts = outcome
        .impacts
        .iter()
        .filter(|impact| at_floor(impact.contact));
    impacts.map(|impact| impact.impulse).sum()
}

fn acceleration(outcome: &Outcome, building: usize) -> f64 {
    let floors = outcome.peaks.floors(building).into_iter();
    floors
        .map(|floor| floor.total_acceleration())
        .fold(0.0, f64::max)
}

fn input(case: &Case) -> Input {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/data/direct");
    match read_model_text(case.name, case.model, Format::Json, folder.as_ref()) {
        Ok(input) => input,
        Err(error) => panic!("{error}"),
    }
}

/// All rows of this family: the tolerance is kept, and the run says that it is.
#[must_use]
pub fn rows() -> Vec<Row> {
    let expected = document(include_str!("../data/direct/expected.json"));
    let settings = Settings {
        pounding: Pounding::Included,
        record_interval: None,
        ..Settings::default()
    };
    let mut rows = Vec::new();
    for (case, expected) in CASES.iter().zip(list(&expected, "")) {
        let value = number(expected, "/value");
        // Its own steps leave a third of what they change, or a little more.
        let left = (value - number(expected, "/at_twice_the_step")).abs();
        for tolerance in TOLERANCES {
            let mut input = input(case);
            input.model.analysis.tolerance = tolerance;
            let duration = input.ground_motion().expect("the record is there").duration;
            let (system, outcome) = run_model(&input, None, settings, duration);
            let greatest = (case.greatest)(&system, &outcome);
            let residual = outcome
                .accuracy
                .map_or(f64::INFINITY, |accuracy| accuracy.residual);
            let source = format!("direct/{}", case.name);
            rows.push(Row::absolute(
                &source,
                format!("{} at {tolerance:.0e}", case.what),
                value,
                (case.number)(&system, &outcome),
                tolerance * greatest + left,
            ));
            rows.push(Row::absolute(
                &source,
                format!("estimated error ÷ tolerance, at a tolerance of {tolerance:.0e}"),
                0.0,
                residual / tolerance,
                1.0,
            ));
        }
    }
    rows
}
