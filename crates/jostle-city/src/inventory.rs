//! Footprints of buildings and what is known of them.

mod columns;
mod csv_table;
mod geojson_file;
mod parquet_table;

use std::collections::BTreeMap;
use std::path::Path;

use geo::{Area, BoundingRect, Coord, Geometry, MapCoords, Polygon};
use jostle_classes::GemFacts;

use crate::building::Building;
use crate::fault::CityError;
use crate::mend::{Mend, renamed, repeats, whole};
use crate::plane::Plane;

pub use columns::{Attribute, Columns};

/// Footprints below this are sheds and slivers \[m²\].
pub(crate) const LEAST_AREA: f64 = 20.0;

/// The largest buildings cover about one square kilometre \[m²\].
const MOST_AREA: f64 = 4e6;

/// Systems in feet: state planes of the United States (EPSG).
const FEET: [std::ops::RangeInclusive<u32>; 2] = [2222..=2289, 3417..=3420];

/// A file of footprints, read and mended.
#[derive(Clone, Debug)]
pub struct Inventory {
    /// Those that are kept.
    pub buildings: Vec<Building>,
    /// The plane of their outlines.
    pub plane: Plane,
    /// What was mended or left out, in the order of the rows.
    pub mends: Vec<Mend>,
    /// Rows read.
    pub rows: usize,
    /// Which column gave an attribute.
    pub columns: BTreeMap<Attribute, String>,
}

/// One row of a file as its reader gives it.
pub(crate) struct Record {
    pub(crate) row: usize,
    /// The footprint, or why there is none.
    pub(crate) geometry: Result<Geometry<f64>, String>,
    /// Names and texts of the other columns; absent and empty ones are left out.
    pub(crate) fields: Vec<(String, String)>,
}

/// How an inventory is read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// Columns that have other names than the usual ones.
    pub columns: Columns,
    /// Coordinates are metres, not degrees.
    pub metres: bool,
}

impl Inventory {
    /// Reads GeoJSON (`.geojson`, `.json`), GeoParquet (`.parquet`) or CSV with a column of footprints as WKT or
    /// GeoJSON (`.csv`).
    ///
    /// # Errors
    ///
    /// When the file cannot be read, has no outlines or no column that says how tall buildings are, or has
    /// coordinates that are neither degrees nor said to be metres. Invalid outlines are mended, never an error.
    pub fn read(path: &Path, options: &ReadOptions) -> Result<Self, CityError> {
        let extension = path
            .extension()
            .unwrap_or_default()
            .to_string_lossy()
            .to_lowercase();
        let mut gathered = Gathered::new(path, options);
        match extension.as_str() {
            "geojson" | "json" => geojson_file::read(path, &mut gathered)?,
            "csv" | "txt" => csv_table::read(path, &mut gathered)?,
            "parquet" | "geoparquet" => parquet_table::read(path, &mut gathered)?,
            _ => {
                return Err(CityError::of(
                    path,
                    "footprints are read from .geojson, .json, .parquet and .csv files",
                ));
            }
        }
        gathered.finish()
    }
}

/// What was read so far.
pub(crate) struct Gathered<'a> {
    path: &'a Path,
    options: &'a ReadOptions,
    plane: Option<Plane>,
    buildings: Vec<Building>,
    mends: Vec<Mend>,
    rows: usize,
    points: usize,
    columns: BTreeMap<Attribute, String>,
}

impl<'a> Gathered<'a> {
    fn new(path: &'a Path, options: &'a ReadOptions) -> Self {
        Self {
            path,
            options,
            plane: options.metres.then_some(Plane::Metres),
            buildings: Vec::new(),
            mends: Vec::new(),
            rows: 0,
            points: 0,
            columns: BTreeMap::new(),
        }
    }

    /// Refuses a named system of coordinates that is not what they are read as.
    ///
    /// # Errors
    /// Degrees that are said to be metres, others that are not said to be metres, and systems that are not in metres of the ground.
    fn check_system(&self, name: &str) -> Result<(), CityError> {
        let upper = name.to_uppercase();
        let code = upper.rsplit([':', '/']).next().unwrap_or_default();
        // WGS 84, ETRS89, NAD 83 and others of the same within a few metres.
        let degrees = [
            "CRS84", "CRS83", "CRS84H", "4326", "4979", "4258", "4269", "4283", "4612", "6668",
        ];
        let is_degrees = degrees.contains(&code);
        let remedy = "write the file anew in WGS 84 (EPSG:4326)";
        let problem = match self.options.metres {
            true if is_degrees => {
                "has degrees of longitude and latitude: leave out metres".to_owned()
            }
            false if is_degrees => return Ok(()),
            false => format!(
                "is not known to have degrees of longitude and latitude: {remedy}, or say that coordinates are metres if they are (--metres, or metres = true in the city file)"
            ),
            // Web Mercator stretches by 1/cos φ; state planes of the United States are in feet.
            true if ["3857", "900913", "102100", "3785", "3395"].contains(&code) => {
                format!("has metres at the equator alone: {remedy}")
            }
            true if code
                .parse::<u32>()
                .is_ok_and(|code| FEET.iter().any(|range| range.contains(&code)))
                || upper.contains("FTUS") =>
            {
                format!("is in feet: {remedy}, or in a system in metres")
            }
            true => return Ok(()),
        };
        Err(CityError::of(
            self.path,
            format!("the system of coordinates \"{name}\" {problem}"),
        ))
    }

    /// Names of the columns that may hold outlines.
    fn geometry_names(&self) -> Vec<String> {
        self.options.columns.names(Attribute::Footprint)
    }

    /// Takes a row.
    fn take(&mut self, record: Record) -> Result<(), CityError> {
        self.rows += 1;
        let row = record.row;
        let mut building = Building {
            id: row.to_string(),
            row,
            outline: Polygon::empty(),
            area: 0.0,
            storeys: None,
            height: None,
            year: None,
            kind: None,
            level: None,
        };
        // Of several columns for one attribute, the one that was met first holds where it says something, else another.
        let mut of_row: BTreeMap<Attribute, (&str, &str)> = BTreeMap::new();
        for (name, text) in &record.fields {
            let Some(attribute) = self.options.columns.attribute(name) else {
                continue;
            };
            let first = self
                .columns
                .entry(attribute)
                .or_insert_with(|| name.clone());
            if first == name || !of_row.contains_key(&attribute) {
                of_row.insert(attribute, (name, text));
            }
        }
        let mut unread = None;
        for (attribute, (name, text)) in of_row {
            let number = || {
                let text = text.trim();
                text.parse::<f64>()
                    .ok()
                    .filter(|number| number.is_finite())
                    .ok_or_else(|| {
                        CityError::of(
                            self.path,
                            format!(
                                "row {row}: column \"{name}\": a number is needed, found \"{text}\""
                            ),
                        )
                    })
            };
            match attribute {
                Attribute::Id => text.clone_into(&mut building.id),
                Attribute::Type => building.kind = Some(text.trim().to_owned()),
                Attribute::Footprint => {}
                Attribute::Storeys => {
                    let value = number()?;
                    if value >= 0.5 {
                        building.storeys = Some(value.round() as usize);
                    }
                }
                Attribute::Height => {
                    building.height = Some(number()?).filter(|number| *number > 0.0);
                }
                Attribute::Year => {
                    building.year = year_of(text);
                    if building.year.is_none() {
                        unread = Some(format!("the year \"{}\" is not read", text.trim()));
                    }
                }
            }
        }
        if let Some(kind) = &building.kind {
            let said = GemFacts::of(kind);
            building.level = said.level;
            building.storeys = building.storeys.or(said.storeys);
            building.year = building.year.or(said.year);
        }
        let mut noted = |what: &'static str, detail: String| {
            self.mends.push(Mend {
                id: building.id.clone(),
                row,
                what,
                detail,
            });
        };
        if let Some(detail) = unread {
            noted("assumed", detail);
        }
        let geometry = match record.geometry {
            Ok(geometry) => geometry,
            Err(problem) => {
                noted("no outline", problem);
                return Ok(());
            }
        };
        let mut parts: Vec<Polygon> = match geometry {
            Geometry::Polygon(polygon) => vec![polygon],
            Geometry::MultiPolygon(polygon) => polygon.0,
            Geometry::Point(_) | Geometry::MultiPoint(_) => {
                self.points += 1;
                noted("no outline", "a point".into());
                return Ok(());
            }
            _ => {
                noted("no outline", "neither a polygon nor a multipolygon".into());
                return Ok(());
            }
        };
        let plane = match self.plane {
            Some(plane) => plane,
            None => {
                let first = parts
                    .first()
                    .and_then(|part| part.exterior().0.first().copied());
                let Some(first) = first else {
                    noted("no outline", "an empty polygon".into());
                    return Ok(());
                };
                let plane = Plane::Degrees {
                    origin: [first.x, first.y],
                };
                *self.plane.insert(plane)
            }
        };
        let finite = |coord: &Coord| coord.x.is_finite() && coord.y.is_finite();
        let all = |wanted: &dyn Fn(&Coord) -> bool| {
            parts.iter().flat_map(|part| &part.exterior().0).all(wanted)
        };
        if !all(&finite) {
            noted("no outline", "coordinates that are no numbers".into());
            return Ok(());
        }
        if let Plane::Degrees { .. } = plane
            && !all(&|point| point.x.abs() <= 180.0 && point.y.abs() <= 90.0)
        {
            return Err(CityError::of(
                self.path,
                format!(
                    "row {row}: coordinates beyond ±180° and ±90° are not degrees of longitude and latitude; if they are \
                     metres, say so (--metres, or metres = true in the city file)"
                ),
            ));
        }
        for part in &mut parts {
            *part = part.map_coords(|point| plane.metres(point));
        }
        let (outline, mended) = whole(parts);
        let Some(outline) = outline else {
            noted("no outline", "no area".into());
            return Ok(());
        };
        if let Some(how) = mended {
            noted("mended", how);
        }
        building.area = outline.unsigned_area();
        if let Plane::Degrees { .. } = plane
            && building.area > MOST_AREA
        {
            return Err(CityError::of(
                self.path,
                format!(
                    "row {row}: an outline of {:.0} km² is no building: coordinates are read as degrees of longitude and latitude; \
                     if they are metres, say so (--metres, or metres = true in the city file)",
                    1e-6 * building.area
                ),
            ));
        }
        building.outline = outline;
        if building.area < LEAST_AREA {
            noted(
                "left out",
                format!("{:.1} m² is less than {LEAST_AREA} m²", building.area),
            );
            return Ok(());
        }
        self.buildings.push(building);
        Ok(())
    }

    fn finish(mut self) -> Result<Inventory, CityError> {
        let fault = |problem: &str| Err(CityError::of(self.path, problem));
        if self.rows == 0 {
            return fault("there are no rows");
        }
        if self.buildings.is_empty() && self.points > 0 {
            return fault(
                "there are only points: neighbours need outlines (polygons of footprints)",
            );
        }
        if self.buildings.is_empty() {
            return fault("no row has an outline of a building of 20 m² or more");
        }
        if !self.columns.contains_key(&Attribute::Storeys)
            && !self.columns.contains_key(&Attribute::Height)
        {
            return fault(
                "no column says how tall the buildings are: give storeys (such as \"storeys\", \"NumberOfStories\", \
                         \"building:levels\") or height in m (\"height\"), or name the column (--column storeys=NAME)",
            );
        }
        self.mends.extend(repeats(&mut self.buildings));
        self.mends.extend(renamed(&mut self.buildings));
        self.mends.sort_by_key(|mend| mend.row);
        let unknown =
            |building: &&Building| building.storeys.is_none() && building.height.is_none();
        for building in self.buildings.iter().filter(unknown) {
            self.mends.push(Mend {
                id: building.id.clone(),
                row: building.row,
                what: "assumed",
                detail: "1 storey: neither storeys nor height are given".into(),
            });
        }
        Ok(Inventory {
            buildings: self.buildings,
            plane: self.plane.unwrap_or(Plane::Metres),
            mends: self.mends,
            rows: self.rows,
            columns: self.columns,
        })
    }
}

/// The year of a date such as 1931-05, 12/05/1975 or c. 1900: its first four digits that stand together.
fn year_of(text: &str) -> Option<i32> {
    let mut runs = text.split(|c: char| !c.is_ascii_digit());
    let run = runs.find(|run| run.len() >= 4)?;
    run[..4].parse().ok().filter(|year| *year > 0)
}

/// The middle of all buildings \[m\].
pub(crate) fn extent(buildings: &[Building]) -> Option<geo::Rect> {
    let mut boxes = buildings
        .iter()
        .filter_map(|building| building.outline.bounding_rect());
    let first = boxes.next()?;
    Some(boxes.fold(first, |all, value| {
        let [low, high] = [all.min(), all.max()];
        geo::Rect::new(
            Coord {
                x: low.x.min(value.min().x),
                y: low.y.min(value.min().y),
            },
            Coord {
                x: high.x.max(value.max().x),
                y: high.y.max(value.max().y),
            },
        )
    }))
}
