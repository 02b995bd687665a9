//! A pair in a draw under a motion, and the tables that keep such cases.

use std::path::Path;

use jostle_io::Values;

use crate::columns::Table;
use crate::fault::CityError;

/// A pair in a draw under a motion, as a part keeps it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Case {
    pub(crate) pair: usize,
    pub(crate) draw: usize,
    pub(crate) motion: usize,
    /// Buildings of the row.
    pub(crate) row: usize,
    /// Width \[m\]; `None` for a wall in common.
    pub(crate) gap: Option<f64>,
    /// Greatest approach of the free buildings \[m\].
    pub(crate) closing: f64,
    pub(crate) force: f64,
    pub(crate) impulse: f64,
    pub(crate) impacts: usize,
    /// Impacts of a slab on columns.
    pub(crate) column_impacts: usize,
    /// Greatest drift ratio alone and in the row, left and right \[–\].
    pub(crate) drift: [[f64; 2]; 2],
    /// Greatest acceleration alone and in the row, left and right \[m/s²\].
    pub(crate) acceleration: [[f64; 2]; 2],
    /// Damage state alone and in the row, left and right.
    pub(crate) state: [[usize; 2]; 2],
}

/// A column of a table of cases: its name, and its number of a case.
type Column = (&'static str, fn(&Case) -> f64);

const WHOLE: [Column; 10] = [
    ("pair", |case| case.pair as f64),
    ("draw", |case| case.draw as f64),
    ("motion", |case| case.motion as f64),
    ("row_buildings", |case| case.row as f64),
    ("impacts", |case| case.impacts as f64),
    ("column_impacts", |case| case.column_impacts as f64),
    ("left_state_alone", |case| case.state[0][0] as f64),
    ("right_state_alone", |case| case.state[0][1] as f64),
    ("left_state", |case| case.state[1][0] as f64),
    ("right_state", |case| case.state[1][1] as f64),
];
const REAL: [Column; 11] = [
    ("closing_m", |case| case.closing),
    ("force_n", |case| case.force),
    ("impulse_ns", |case| case.impulse),
    ("left_drift_ratio_alone", |case| case.drift[0][0]),
    ("right_drift_ratio_alone", |case| case.drift[0][1]),
    ("left_drift_ratio", |case| case.drift[1][0]),
    ("right_drift_ratio", |case| case.drift[1][1]),
    ("left_acceleration_alone_m_s2", |case| {
        case.acceleration[0][0]
    }),
    ("right_acceleration_alone_m_s2", |case| {
        case.acceleration[0][1]
    }),
    ("left_acceleration_m_s2", |case| case.acceleration[1][0]),
    ("right_acceleration_m_s2", |case| case.acceleration[1][1]),
];

/// The table of a part.
pub(crate) fn case_columns(cases: &[Case]) -> Vec<(String, Values)> {
    let mut columns: Vec<(String, Values)> = WHOLE
        .iter()
        .map(|(name, of)| {
            let values = cases.iter().map(|case| Some(of(case) as i32));
            ((*name).to_owned(), Values::Whole(values.collect()))
        })
        .collect();
    columns.push((
        "gap_m".to_owned(),
        Values::Instant(cases.iter().map(|case| case.gap).collect()),
    ));
    columns.extend(REAL.iter().map(|(name, of)| {
        // Batches step with seven digits; the rest would only fill the disk.
        let values = cases.iter().map(|case| f64::from(of(case) as f32));
        ((*name).to_owned(), Values::Real(values.collect()))
    }));
    columns
}

/// Cases of a part.
pub(crate) fn read_cases(path: &Path) -> Result<(Vec<Case>, Table), CityError> {
    let table = Table::read(path)?;
    let number = |name: &str| table.numbers(path, name);
    let whole = |name: &str| -> Result<Vec<usize>, CityError> {
        Ok(number(name)?
            .iter()
            .map(|number| *number as usize)
            .collect())
    };
    let of = |column: &[f64], at: usize| column[at];
    let [pair, draw, motion, row] = [
        whole("pair")?,
        whole("draw")?,
        whole("motion")?,
        whole("row_buildings")?,
    ];
    let [impacts, column_impacts] = [whole("impacts")?, whole("column_impacts")?];
    let states = [
        [whole("left_state_alone")?, whole("right_state_alone")?],
        [whole("left_state")?, whole("right_state")?],
    ];
    let drifts = [
        [
            number("left_drift_ratio_alone")?,
            number("right_drift_ratio_alone")?,
        ],
        [number("left_drift_ratio")?, number("right_drift_ratio")?],
    ];
    let accelerations = [
        [
            number("left_acceleration_alone_m_s2")?,
            number("right_acceleration_alone_m_s2")?,
        ],
        [
            number("left_acceleration_m_s2")?,
            number("right_acceleration_m_s2")?,
        ],
    ];
    let [gap, closing, force, impulse] = [
        number("gap_m")?,
        number("closing_m")?,
        number("force_n")?,
        number("impulse_ns")?,
    ];
    let cases = (0..table.rows)
        .map(|at| Case {
            pair: pair[at],
            draw: draw[at],
            motion: motion[at],
            row: row[at],
            gap: Some(gap[at]).filter(|gap| gap.is_finite()),
            closing: closing[at],
            force: force[at],
            impulse: impulse[at],
            impacts: impacts[at],
            column_impacts: column_impacts[at],
            drift: drifts.map(|drift| drift.map(|column| of(column, at))),
            acceleration: accelerations
                .map(|acceleration| acceleration.map(|column| of(column, at))),
            state: [0, 1].map(|which| [0, 1].map(|side| states[which][side][at])),
        })
        .collect();
    Ok((cases, table))
}
