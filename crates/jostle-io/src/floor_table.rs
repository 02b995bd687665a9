//! `floor_spectra.parquet`: response spectra of floors, one row per floor, run, damping ratio and period.

use std::path::Path;

use jostle::Summary;
use jostle::results::floor_spectra::{FloorCurve, FloorSpectra};

use crate::output::OutputError;
use crate::tables::{Values, write_values_parquet};

/// Columns of the table of floor spectra. `contact` is `with` or `without`.
#[must_use]
pub fn floor_spectra_columns(found: &FloorSpectra) -> Vec<(&'static str, Values)> {
    type Row<'a> = (usize, &'static str, &'a FloorCurve, usize);
    let mut rows: Vec<Row<'_>> = Vec::new();
    for (index, floor) in found.floors.iter().enumerate() {
        let with = Some(("with", &floor.response));
        let without = floor
            .without_contact
            .as_ref()
            .map(|without_contact| ("without", without_contact));
        for (contact, response) in with.into_iter().chain(without) {
            for curve in &response.spectra {
                let periods = 0..found.periods_s.len();
                rows.extend(periods.map(|period| (index, contact, curve, period)));
            }
        }
    }
    let text = |of: &dyn Fn(&Row<'_>) -> String| Values::Text(rows.iter().map(of).collect());
    let real = |of: &dyn Fn(&Row<'_>) -> f64| Values::Real(rows.iter().map(of).collect());
    let floor = rows
        .iter()
        .map(|row| i32::try_from(found.floors[row.0].floor).ok());
    vec![
        (
            "building",
            text(&|row| found.floors[row.0].building.clone()),
        ),
        ("floor", Values::Whole(floor.collect())),
        ("height_m", real(&|row| found.floors[row.0].height_m)),
        ("contact", text(&|row| row.1.to_owned())),
        ("damping", real(&|row| row.2.damping)),
        ("period_s", real(&|row| found.periods_s[row.3])),
        ("displacement_m", real(&|row| row.2.displacement_m[row.3])),
        (
            "pseudo_acceleration_m_s2",
            real(&|row| row.2.pseudo_acceleration_m_s2[row.3]),
        ),
        (
            "total_acceleration_m_s2",
            real(&|row| row.2.total_acceleration_m_s2[row.3]),
        ),
    ]
}

/// Writes the table of floor spectra.
///
/// # Errors
/// [`OutputError`] with path and reason.
pub fn write_floor_spectra_parquet(
    path: &Path,
    summary: &Summary,
    found: &FloorSpectra,
) -> Result<(), OutputError> {
    let columns = floor_spectra_columns(found).into_iter();
    let columns = columns.map(|(name, values)| (name.to_owned(), values));
    write_values_parquet(path, &summary.title, &[], columns.collect())
}
