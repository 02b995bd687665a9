//! Footprints of a GeoJSON file, feature by feature.

use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use geo::Geometry;
use geojson::{Feature, FeatureReader, GeometryValue, JsonValue};

use super::{Gathered, Record};
use crate::fault::CityError;

pub(super) fn read(path: &Path, gathered: &mut Gathered<'_>) -> Result<(), CityError> {
    if let Some(name) = reference_system(path)? {
        gathered.check_system(&name)?;
    }
    let file = jostle_io::open_file(path).map_err(|error| CityError::of(path, error))?;
    for (at, feature) in FeatureReader::from_reader(BufReader::new(file))
        .features()
        .enumerate()
    {
        let row = at + 1;
        let feature = feature.map_err(|error| {
            CityError::of(
                path,
                format!(
                    "feature {row}: a GeoJSON FeatureCollection of polygons is needed ({error})"
                ),
            )
        })?;
        gathered.take(record(feature, row))?;
    }
    Ok(())
}

/// Bytes at both ends of a file in which its system of coordinates is named, before or behind the features.
const ENDS: u64 = 65_536;

/// The name of the system of coordinates, as GeoJSON of 2008 states it beside its features:
/// `"crs": { "type": "name", "properties": { "name": "urn:ogc:def:crs:EPSG::2227" } }`.
fn reference_system(path: &Path) -> Result<Option<String>, CityError> {
    let fault = |error: std::io::Error| CityError::of(path, error);
    let mut file = jostle_io::open_file(path).map_err(|error| CityError::of(path, error))?;
    let size = file.metadata().map_err(fault)?.len();
    let (mut head, mut tail) = (Vec::new(), Vec::new());
    (&mut file)
        .take(ENDS)
        .read_to_end(&mut head)
        .map_err(fault)?;
    file.seek(SeekFrom::Start(size.saturating_sub(ENDS)))
        .map_err(fault)?;
    (&mut file)
        .take(ENDS)
        .read_to_end(&mut tail)
        .map_err(fault)?;
    let [head, tail] = [head, tail].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    let before = head.split("\"features\"").next().unwrap_or_default();
    let behind = tail.rsplit(']').next().unwrap_or_default();
    let named = |text: &str| {
        text.split_once("\"crs\"")
            .and_then(|(_, after)| after.split_once("\"properties\""))
            .and_then(|(_, after)| after.split_once("\"name\""))
            .and_then(|(_, after)| after.split('"').nth(1))
            .map(str::to_owned)
    };
    Ok(named(before).or_else(|| named(behind)))
}

/// A feature as a row.
pub(super) fn record(feature: Feature, row: usize) -> Record {
    let text = |value: JsonValue| match value {
        JsonValue::Null => None,
        JsonValue::String(content) => Some(content).filter(|content| !content.trim().is_empty()),
        other => Some(other.to_string()),
    };
    let mut fields: Vec<(String, String)> = feature
        .properties
        .into_iter()
        .flatten()
        .filter_map(|(name, value)| Some((name, text(value)?)))
        .collect();
    if let Some(id) = feature.id {
        let id = match id {
            geojson::feature::Id::String(id) => id,
            geojson::feature::Id::Number(number) => number.to_string(),
        };
        fields.push(("id".into(), id));
    }
    let geometry = match feature.geometry {
        None => Err("no geometry".to_owned()),
        Some(geometry) => outlines(geometry),
    };
    Record {
        row,
        geometry,
        fields,
    }
}

/// The outlines of a geometry. Positions of fewer than two numbers would end the conversion.
pub(super) fn outlines(geometry: geojson::Geometry) -> Result<Geometry<f64>, String> {
    let whole = |polygon: &Vec<Vec<geojson::Position>>| {
        polygon
            .iter()
            .flatten()
            .all(|polygon| polygon.as_slice().len() >= 2)
    };
    let sound = match &geometry.value {
        GeometryValue::Polygon { coordinates } => whole(coordinates),
        GeometryValue::MultiPolygon { coordinates } => coordinates.iter().all(whole),
        GeometryValue::Point { .. } | GeometryValue::MultiPoint { .. } => {
            return Ok(Geometry::Point(geo::Point::new(0.0, 0.0)));
        }
        _ => return Err("neither a polygon nor a multipolygon".to_owned()),
    };
    if !sound {
        return Err("a position of fewer than two numbers".to_owned());
    }
    Geometry::try_from(geometry).map_err(|error| error.to_string())
}
