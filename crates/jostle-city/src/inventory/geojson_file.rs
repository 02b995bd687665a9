//! Footprints of a GeoJSON file, feature by feature.

use std::io::BufReader;
use std::path::Path;

use geo::Geometry;
use geojson::{Feature, FeatureReader, GeometryValue, JsonValue};

use super::{Gathered, Record, reference_system};
use crate::fault::CityError;

pub(super) fn read(path: &Path, gathered: &mut Gathered<'_>) -> Result<(), CityError> {
    let open = || jostle_io::open_file(path).map_err(|error| CityError::of(path, error));
    gathered.stand_in(reference_system::of_geojson(path, open()?)?)?;
    let file = open()?;
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
