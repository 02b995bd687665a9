//! Footprints of a GeoParquet file: WKB in a column of bytes.

use std::path::Path;

use geo::Geometry;
use geo_traits::to_geo::ToGeoGeometry;
use jostle_io::undamaged;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use serde_json::Value;

use super::{Gathered, Record, reference_system};
use crate::fault::CityError;

pub(super) fn read(path: &Path, gathered: &mut Gathered<'_>) -> Result<(), CityError> {
    undamaged(|| read_whole(path, gathered)).map_err(|problem| {
        // Faults of the file name it already.
        let named = problem.starts_with(&path.display().to_string());
        if named {
            CityError::Input(problem)
        } else {
            CityError::of(path, problem)
        }
    })
}

fn read_whole(path: &Path, gathered: &mut Gathered<'_>) -> Result<(), CityError> {
    let fault = |error: &dyn std::fmt::Display| CityError::of(path, error);
    let file = jostle_io::open_file(path).map_err(|error| fault(&error))?;
    let reader = SerializedFileReader::new(file).map_err(|error| fault(&error))?;
    let notes = reader
        .metadata()
        .file_metadata()
        .key_value_metadata()
        .cloned();
    let geo = notes
        .into_iter()
        .flatten()
        .find(|note| note.key == "geo")
        .and_then(|note| note.value);
    let geo: Option<Value> = geo.and_then(|geo| serde_json::from_str(&geo).ok());
    let primary = geo.as_ref().and_then(|geo| geo["primary_column"].as_str());
    if let (Some(geo), Some(primary)) = (&geo, primary) {
        let column = &geo["columns"][primary];
        gathered.stand_in(reference_system::of_geoparquet(path, column)?)?;
    }
    let names = match primary {
        Some(primary) => vec![primary.to_owned()],
        None => gathered.geometry_names(),
    };
    let mut found = false;
    let rows = reader.get_row_iter(None).map_err(|error| fault(&error))?;
    for (at, row) in rows.enumerate() {
        let row = row.map_err(|error| fault(&error))?;
        let mut geometry = Err("no geometry".to_owned());
        let mut fields = Vec::new();
        for (name, field) in row.into_columns() {
            let bytes = match &field {
                Field::Bytes(bytes) if names.contains(&name) => Some(bytes),
                _ => None,
            };
            if let Some(bytes) = bytes {
                found = true;
                geometry = footprint(bytes.data());
                continue;
            }
            let text = match field {
                Field::Null
                | Field::Bytes(_)
                | Field::Group(_)
                | Field::ListInternal(_)
                | Field::MapInternal(_) => continue,
                Field::Str(field) => field,
                other => other.to_string(),
            };
            if !text.trim().is_empty() {
                fields.push((name, text));
            }
        }
        gathered.take(Record {
            row: at + 1,
            geometry,
            fields,
        })?;
    }
    if !found {
        return Err(CityError::of(
            path,
            format!(
                "no column of WKB outlines ({}): GeoParquet names it in its note \"geo\"",
                names.join(", ")
            ),
        ));
    }
    Ok(())
}

fn footprint(bytes: &[u8]) -> Result<Geometry<f64>, String> {
    // Collections may hold collections without end, and hold no building.
    match kind(bytes) {
        Some(3 | 6) => {}
        Some(1 | 4) => return Ok(Geometry::Point(geo::Point::new(0.0, 0.0))),
        Some(_) => return Err("neither a polygon nor a multipolygon".to_owned()),
        None => return Err("no WKB: cut short".to_owned()),
    }
    let read = wkb::reader::read_wkb(bytes).map_err(|error| format!("no WKB: {error}"))?;
    read.try_to_geometry()
        .ok_or_else(|| "an empty geometry".to_owned())
}

/// Kind of a geometry by the head of its WKB: 1 point, 3 polygon, 4 multipoint, 6 multipolygon, whatever its dimensions.
fn kind(bytes: &[u8]) -> Option<u32> {
    let word: [u8; 4] = bytes.get(1..5)?.try_into().ok()?;
    let word = if bytes[0] == 0 {
        u32::from_be_bytes(word)
    } else {
        u32::from_le_bytes(word)
    };
    // The upper bits say in EWKB, the thousands in ISO, that there are Z, M or a reference system.
    Some((word & 0x0fff_ffff) % 1000)
}
