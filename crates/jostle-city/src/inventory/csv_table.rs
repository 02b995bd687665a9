//! Footprints in a column of a CSV file, as WKT or GeoJSON.

use std::path::Path;

use geo::Geometry;
use geojson::GeoJson;
use wkt::TryFromWkt;

use super::geojson_file::outlines;
use super::{Gathered, Record};
use crate::fault::CityError;

pub(super) fn read(path: &Path, gathered: &mut Gathered<'_>) -> Result<(), CityError> {
    let file = jostle_io::open_file(path).map_err(|error| CityError::of(path, error))?;
    let mut table = csv::ReaderBuilder::new().flexible(true).from_reader(file);
    let fault = |error: csv::Error| CityError::of(path, error);
    let header: Vec<String> = table
        .headers()
        .map_err(fault)?
        .iter()
        .map(|header| header.trim_start_matches('\u{feff}').trim().to_owned())
        .collect();
    let wanted = gathered.geometry_names();
    let geometry = header
        .iter()
        .position(|header| wanted.contains(header) || wanted.contains(&header.to_lowercase()));
    let Some(geometry) = geometry else {
        let known = |lower: &str| header.iter().any(|header| header.to_lowercase() == lower);
        let points = known("latitude") || known("lat");
        let problem = if points {
            "there are only points (latitude and longitude): neighbours need outlines, in a column \"Footprint\" as WKT or \
             GeoJSON"
        } else {
            "no column with outlines: \"Footprint\", \"geometry\" or \"wkt\" as WKT or GeoJSON is needed, or name the column \
             (--column footprint=NAME)"
        };
        return Err(CityError::of(path, problem));
    };
    for (at, row) in table.records().enumerate() {
        let row = row.map_err(fault)?;
        let fields = header.iter().zip(row.iter()).enumerate();
        let fields = fields
            .filter(|(at, (_, text))| *at != geometry && !text.trim().is_empty())
            .map(|(_, (name, text))| (name.clone(), text.to_owned()));
        gathered.take(Record {
            row: at + 1,
            geometry: footprint(row.get(geometry).unwrap_or("")),
            fields: fields.collect(),
        })?;
    }
    Ok(())
}

/// An outline of WKT or GeoJSON text.
fn footprint(text: &str) -> Result<Geometry<f64>, String> {
    let text = text.trim();
    if text.is_empty() {
        return Err("no geometry".to_owned());
    }
    if !text.starts_with('{') {
        // Collections may hold collections without end, and hold no building.
        let kind: String = text.chars().take_while(char::is_ascii_alphabetic).collect();
        return match kind.to_ascii_uppercase().as_str() {
            "POLYGON" | "MULTIPOLYGON" => {
                Geometry::try_from_wkt_str(text).map_err(|error| format!("no WKT: {error}"))
            }
            "POINT" | "MULTIPOINT" => Ok(Geometry::Point(geo::Point::new(0.0, 0.0))),
            _ => Err("neither POLYGON nor MULTIPOLYGON".to_owned()),
        };
    }
    let parsed: GeoJson = text
        .parse()
        .map_err(|error| format!("no GeoJSON: {error}"))?;
    let geometry = match parsed {
        GeoJson::Geometry(geometry) => Some(geometry),
        GeoJson::Feature(feature) => feature.geometry,
        GeoJson::FeatureCollection(collection) => collection
            .features
            .into_iter()
            .next()
            .and_then(|feature| feature.geometry),
    };
    let geometry = geometry.ok_or("no geometry")?;
    outlines(geometry)
}
