//! The reference system that a file of footprints names.
//!
//! Coordinates of GeoJSON are longitude and latitude on WGS 84 (RFC 7946). Its version of 2008 let a file name another system in `crs`, and
//! GDAL still writes it; GeoParquet names it in its note `geo`.

use std::io::Read;
use std::path::Path;

use geo::Coord;
use serde_json::Value;

use crate::fault::CityError;

/// What the coordinates of a file are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Coordinates {
    /// Longitude and latitude, on WGS 84 or within two metres of it \[°\].
    Degrees,
    /// Universal transverse Mercator \[m\]: lengths are true to 4e-4 near the middle of a zone.
    Metres,
    /// Web Mercator, whose lengths grow with latitude.
    WebMercator,
    /// The file says that they are in no known system.
    Unknown,
}

/// Radius of the sphere of Web Mercator \[m\].
const RADIUS: f64 = 6_378_137.0;

impl Coordinates {
    /// By a name such as `urn:ogc:def:crs:EPSG::4326`, `EPSG:4326` or `urn:ogc:def:crs:OGC:1.3:CRS84`; `None` if it is another system.
    pub(super) fn named(name: &str) -> Option<Self> {
        let code = name.trim().rsplit([':', '/', '#']).next().unwrap_or(name);
        if ["CRS84", "CRS84h", "WGS84", "WGS 84"]
            .iter()
            .any(|known| code.eq_ignore_ascii_case(known))
        {
            return Some(Self::Degrees);
        }
        match code.parse().ok()? {
            // WGS 84, ETRS89 and NAD83; GeoJSON has the longitude first whatever their order is.
            4326 | 4979 | 4258 | 4269 => Some(Self::Degrees),
            3857 | 900_913 | 102_100 | 102_113 => Some(Self::WebMercator),
            // On WGS 84 north and south, on ETRS89 and on NAD83.
            32_601..=32_660 | 32_701..=32_760 | 25_828..=25_838 | 26_901..=26_923 => {
                Some(Self::Metres)
            }
            _ => None,
        }
    }

    /// Refuses coordinates that are not what the user said.
    pub(super) fn agree(self, path: &Path, name: &str, metres: bool) -> Result<Self, CityError> {
        let problem = match (self, metres) {
            (Self::Degrees, true) => {
                "are degrees, not metres: leave out --metres (metres = true in the city file)"
            }
            (Self::Metres, false) => {
                "are metres: say so (--metres, or metres = true in the city file)"
            }
            (Self::Unknown, false) => {
                "are in no known system: if they are metres, say so (--metres, or metres = true in the city file); if they are degrees, \
                 write EPSG:4326 there"
            }
            _ => return Ok(self),
        };
        Err(CityError::of(
            path,
            format!("coordinates by its crs ({name}) {problem}"),
        ))
    }

    /// Refuses a system that is none of these.
    pub(super) fn refuse(path: &Path, name: &str) -> CityError {
        CityError::of(
            path,
            format!(
                "its coordinates are in {name}: give longitude and latitude (ogr2ogr -t_srs EPSG:4326), UTM in metres with --metres, or Web \
                 Mercator; if they are metres of another true-length plane, remove this crs and say --metres (metres = true in the city file)"
            ),
        )
    }

    /// Longitude and latitude of a point of Web Mercator \[°\]; other points stay.
    pub(super) fn unprojected(self, at: Coord) -> Coord {
        match self {
            Self::WebMercator => Coord {
                x: (at.x / RADIUS).to_degrees(),
                y: libm::atan(libm::sinh(at.y / RADIUS)).to_degrees(),
            },
            _ => at,
        }
    }
}

/// A file of GeoJSON without anything but its `crs`; one that says `null` has one.
#[derive(serde::Deserialize)]
struct Head {
    #[serde(default, deserialize_with = "as_it_is")]
    crs: Option<Value>,
}

fn as_it_is<'de, D: serde::Deserializer<'de>>(value: D) -> Result<Option<Value>, D::Error> {
    serde::Deserialize::deserialize(value).map(Some)
}

/// The `crs` of a GeoJSON file, and what it is called; `None` without one. Files that are no JSON are told of where they are read.
pub(super) fn of_geojson(
    path: &Path,
    file: impl Read,
) -> Result<Option<(Coordinates, String)>, CityError> {
    let mut file = serde_json::Deserializer::from_reader(std::io::BufReader::new(file));
    let Ok(Head { crs }) = serde::Deserialize::deserialize(&mut file) else {
        return Ok(None);
    };
    match crs {
        None => Ok(None),
        Some(Value::Null) => Ok(Some((Coordinates::Unknown, "null".to_owned()))),
        Some(crs) => {
            let name = crs["properties"]["name"].as_str().map(str::to_owned);
            let name = name.unwrap_or_else(|| crs.to_string());
            let found = Coordinates::named(&name);
            let found = found.ok_or_else(|| Coordinates::refuse(path, &name))?;
            Ok(Some((found, name)))
        }
    }
}

/// The same of a column of a GeoParquet file, in PROJJSON.
pub(super) fn of_geoparquet(
    path: &Path,
    column: &Value,
) -> Result<Option<(Coordinates, String)>, CityError> {
    match column.get("crs") {
        None => Ok(None),
        Some(Value::Null) => Ok(Some((Coordinates::Unknown, "null".to_owned()))),
        Some(crs) => {
            let id = &crs["id"];
            let code = id["code"].as_str().map(str::to_owned);
            let code = code.or_else(|| Some(id["code"].as_u64()?.to_string()));
            let authority = id["authority"].as_str().unwrap_or("EPSG");
            let name = match code {
                Some(code) => format!("{authority}:{code}"),
                None => crs["name"]
                    .as_str()
                    .unwrap_or("a system without a name")
                    .to_owned(),
            };
            let found = Coordinates::named(&name);
            let found = found.ok_or_else(|| Coordinates::refuse(path, &name))?;
            Ok(Some((found, name)))
        }
    }
}
