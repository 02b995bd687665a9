//! `buildings.parquet` and `floors.parquet`: peaks with contact, without, and their ratios.

use std::path::Path;

use jostle::quantity::Read;
use jostle::results::response::{BuildingResponse, FloorResponse};
use jostle::results::summary::{BuildingSummary, FloorSummary};
use jostle::{Quantity, Summary};

use crate::output::OutputError;
use crate::tables::{Values, quantity_columns, write_table};

/// Columns of a list of quantities over rows; each quantity that is compared is followed by its value without contact and its
/// amplification, absent if there was no run without contact.
fn compared_columns<T>(
    quantities: &'static [Quantity<T>],
    rows: &[(&T, Option<&T>)],
) -> Vec<(String, Values)> {
    let mut columns = Vec::new();
    for quantity in quantities.iter().filter(|quantity| quantity.places.table) {
        let rows_of = || rows.iter().map(|row| row.0);
        let quantity_columns = quantity_columns(std::slice::from_ref(quantity), rows_of);
        columns.extend(quantity_columns.map(|(name, values)| (name.to_owned(), values)));
        if !quantity.places.compared {
            continue;
        }
        let without = rows.iter().map(|row| quantity.value(row.1?));
        let without = match quantity.read {
            Read::Real(_) | Read::Optional(_) => Values::Instant(without.collect()),
            Read::Whole(_) => Values::Whole(without.map(|v| v.map(|v| v as i32)).collect()),
        };
        columns.push((quantity.name_without_contact(), without));
        let ratios = rows.iter().map(|row| quantity.amplification(row.0, row.1?));
        columns.push((
            quantity.name_of_amplification(),
            Values::Instant(ratios.collect()),
        ));
    }
    columns
}

/// The columns of the table of buildings, one row each.
#[must_use]
pub fn building_columns(summary: &Summary) -> Vec<(String, Values)> {
    let buildings = || summary.buildings.iter();
    let names = buildings().map(|building| building.name.clone());
    let mut columns = vec![("building".to_owned(), Values::Text(names.collect()))];
    let quantity_columns = quantity_columns(BuildingSummary::QUANTITIES, buildings);
    columns.extend(quantity_columns.map(|(name, values)| (name.to_owned(), values)));
    let rows: Vec<_> = buildings()
        .map(|building| (&building.response, building.without_contact.as_ref()))
        .collect();
    columns.extend(compared_columns(BuildingResponse::QUANTITIES, &rows));
    columns
}

/// The columns of the table of floors: one row each, building by building, from the ground up.
#[must_use]
pub fn floor_columns(summary: &Summary) -> Vec<(String, Values)> {
    let buildings = || summary.buildings.iter();
    let floors = || buildings().flat_map(|building| building.floors.with_mat());
    let names = buildings().flat_map(|building| building.floors.with_mat().map(|_| &building.name));
    let mut columns = vec![(
        "building".to_owned(),
        Values::Text(names.cloned().collect()),
    )];
    let quantity_columns = quantity_columns(FloorSummary::QUANTITIES, floors);
    columns.extend(quantity_columns.map(|(name, values)| (name.to_owned(), values)));
    let rows: Vec<_> = floors()
        .map(|floor| (&floor.response, floor.without_contact.as_ref()))
        .collect();
    columns.extend(compared_columns(FloorResponse::QUANTITIES, &rows));
    columns
}

/// Writes the table of buildings; see [`building_columns`].
///
/// # Errors
/// [`OutputError`] with path and reason.
pub fn write_buildings_parquet(path: &Path, summary: &Summary) -> Result<(), OutputError> {
    write_table(path, summary, building_columns(summary))
}

/// Writes the table of floors; see [`floor_columns`].
///
/// # Errors
/// [`OutputError`] with path and reason.
pub fn write_floors_parquet(path: &Path, summary: &Summary) -> Result<(), OutputError> {
    write_table(path, summary, floor_columns(summary))
}
