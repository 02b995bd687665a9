//! Footprints of buildings and what is known of them.

mod columns;
mod csv_table;
mod geojson_file;
mod parquet_table;
mod reference_system;

use std::collections::BTreeMap;
use std::path::Path;

use geo::{Area, BoundingRect, Coord, Geometry, MapCoords, Polygon};

use jostle_classes::GemFacts;

use crate::building::Building;
use crate::fault::CityError;
use crate::mend::{Mend, named_apart, repeats, unlikely_heights, whole};
use crate::plane::Plane;
use reference_system::Coordinates;

pub use columns::{Attribute, Columns};

/// Footprints below this are sheds and slivers \[m²\].
pub(crate) const LEAST_AREA: f64 = 20.0;
/// No city has buildings half of which are larger than this \[m²\].
const GREATEST_MEDIAN: f64 = 1e6;

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
    /// Which columns gave an attribute, each in the rows where those before it have nothing.
    pub columns: BTreeMap<Attribute, Vec<String>>,
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
    coordinates: Coordinates,
    buildings: Vec<Building>,
    mends: Vec<Mend>,
    rows: usize,
    points: usize,
    columns: BTreeMap<Attribute, Vec<String>>,
}

impl<'a> Gathered<'a> {
    fn new(path: &'a Path, options: &'a ReadOptions) -> Self {
        Self {
            path,
            options,
            plane: options.metres.then_some(Plane::Metres),
            coordinates: Coordinates::Unknown,
            buildings: Vec::new(),
            mends: Vec::new(),
            rows: 0,
            points: 0,
            columns: BTreeMap::new(),
        }
    }

    /// Names of the columns that may hold outlines.
    fn geometry_names(&self) -> Vec<String> {
        self.options.columns.names(Attribute::Footprint)
    }

    /// Takes the reference system that the file names, if it names one.
    fn stand_in(&mut self, named: Option<(Coordinates, String)>) -> Result<(), CityError> {
        let Some((coordinates, name)) = named else {
            return Ok(());
        };
        self.coordinates = coordinates.agree(self.path, &name, self.options.metres)?;
        if coordinates == Coordinates::WebMercator {
            // Its metres are not true.
            self.plane = None;
        }
        Ok(())
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
            level: None,
            kind: None,
        };
        let mut unread = None;
        // Of several columns for an attribute the first of the list that has a value in this row counts.
        let mut given: BTreeMap<Attribute, (usize, &(String, String))> = BTreeMap::new();
        for field in &record.fields {
            let Some((attribute, rank)) = self.options.columns.attribute(&field.0) else {
                continue;
            };
            let first = given
                .get(&attribute)
                .is_none_or(|(known, _)| rank <= *known);
            if first {
                given.insert(attribute, (rank, field));
            }
        }
        for (attribute, (_, (name, text))) in given {
            let known = self.columns.entry(attribute).or_default();
            if !known.contains(name) {
                known.push(name.clone());
            }
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
                Attribute::Id => building.id.clone_from(text),
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
                        unread = Some(text.trim().to_owned());
                    }
                }
            }
        }
        let facts = building
            .kind
            .as_deref()
            .map(GemFacts::of)
            .unwrap_or_default();
        building.level = facts.level;
        building.storeys = building.storeys.or(facts.storeys);
        building.year = building.year.or(facts.year);
        let mut noted = |what: &'static str, detail: String| {
            self.mends.push(Mend {
                id: building.id.clone(),
                row,
                what,
                detail,
            });
        };
        if let Some(text) = unread {
            noted(
                "no year",
                format!("a year has four digits, found \"{text}\""),
            );
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
        for part in &mut parts {
            *part = part.map_coords(|at| self.coordinates.unprojected(at));
        }
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
        if self
            .buildings
            .iter()
            .all(|building| building.storeys.is_none())
            && !self.columns.contains_key(&Attribute::Storeys)
            && !self.columns.contains_key(&Attribute::Height)
        {
            return fault(
                "no column says how tall the buildings are: give storeys (such as \"storeys\", \"NumberOfStories\", \
                         \"building:levels\") or height in m (\"height\"), or name the column (--column storeys=NAME)",
            );
        }
        let of_degrees = matches!(self.plane, Some(Plane::Degrees { .. }));
        let mut areas: Vec<f64> = (self.buildings.iter())
            .map(|building| building.area)
            .collect();
        areas.sort_by(f64::total_cmp);
        let median = areas[areas.len() / 2];
        if of_degrees && median > GREATEST_MEDIAN {
            return fault(&format!(
                "read as degrees of longitude and latitude, half of the buildings cover more than {:.0} km² each; if the coordinates are \
                 metres, say so (--metres, or metres = true in the city file)",
                1e-6 * median
            ));
        }
        self.mends.extend(repeats(&mut self.buildings));
        self.mends.extend(named_apart(&mut self.buildings));
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
        self.mends.extend(unlikely_heights(&mut self.buildings));
        Ok(Inventory {
            buildings: self.buildings,
            plane: self.plane.unwrap_or(Plane::Metres),
            mends: self.mends,
            rows: self.rows,
            columns: self.columns,
        })
    }
}

/// The first year from 1000 to 2199 of a text: four digits by themselves, or the beginning of a date of eight.
fn year_of(text: &str) -> Option<i32> {
    let digits = text.split(|letter: char| !letter.is_ascii_digit());
    let mut years = digits.filter_map(|digits| {
        let day = digits.get(4..).unwrap_or("");
        let is_date = || {
            let [month, day] = [day.get(..2)?, day.get(2..)?].map(|part| part.parse().unwrap_or(0));
            ((1..=12).contains(&month) && (1..=31).contains(&day)).then_some(())
        };
        let alone = day.is_empty() || (day.len() == 4 && is_date().is_some());
        let year: i32 = digits.get(..4).filter(|_| alone)?.parse().ok()?;
        (1000..2200).contains(&year).then_some(year)
    });
    years.next()
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
