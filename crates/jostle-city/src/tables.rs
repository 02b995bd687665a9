//! Tables of a city: buildings, pairs, blocks, and what was mended.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use geo::Polygon;
use jostle_io::{CityFile, Values, csv_field, write_atomically, write_values_parquet};
use serde_json::json;

use crate::blocks::Block;
use crate::building::Building;
use crate::fault::CityError;
use crate::inventory::{Attribute, Columns, Inventory};
use crate::mend::Mend;
use crate::neighbours::Neighbours;
use crate::plane::Plane;

/// Overlaps per building above which footprints are refused \[–\].
const MOST_OVERLAPS: f64 = 0.05;

/// Names of columns by what they say.
pub(crate) fn columns_of(named: &[(&'static str, String)]) -> Result<Columns, CityError> {
    let mut columns = Columns::default();
    for (attribute, name) in named {
        let attribute: Attribute = attribute.parse().map_err(CityError::Input)?;
        columns.0.insert(attribute, name.clone());
    }
    Ok(columns)
}

/// Refuses footprints that lie on each other: they are several surveys of the same buildings.
///
/// # Errors
///
/// When pairs that share more than a fifth of the smaller outline are more than 5 % of the buildings.
pub(crate) fn refuse_overlaps(
    path: &Path,
    inventory: &Inventory,
    found: &Neighbours,
) -> Result<(), CityError> {
    let share = found.overlaps.len() as f64 / inventory.buildings.len() as f64;
    if share <= MOST_OVERLAPS {
        return Ok(());
    }
    let [a, b] = found.overlaps[0].map(|at| &inventory.buildings[at]);
    Err(CityError::of(
        path,
        format!(
            "{} pairs of {} buildings share more than a fifth of the smaller outline, such as {} (row {}) and {} (row {}): \
             the file seems to hold the same buildings twice; keep one survey of them",
            found.overlaps.len(),
            inventory.buildings.len(),
            a.id,
            a.row,
            b.id,
            b.row
        ),
    ))
}

/// Writes the tables of an inventory and its neighbours: `buildings.parquet` (GeoParquet), `pairs.parquet`,
/// `blocks.parquet` and `mended.csv`.
///
/// # Errors
///
/// When a file cannot be written.
pub fn write_tables(
    folder: &Path,
    inventory: &Inventory,
    neighbours: &Neighbours,
    blocks: &[Block],
) -> Result<(), CityError> {
    std::fs::create_dir_all(folder).map_err(|error| CityError::of(folder, error))?;
    let columns = building_columns(&inventory.buildings);
    write_buildings(&folder.join("buildings.parquet"), inventory, columns)?;
    let name = |at: usize| inventory.buildings[at].id.clone();
    let pairs = &neighbours.pairs;
    let texts = |of: &dyn Fn(usize) -> String| Values::Text((0..pairs.len()).map(of).collect());
    let reals = |of: &dyn Fn(usize) -> f64| Values::Real((0..pairs.len()).map(of).collect());
    let whole = |of: &dyn Fn(usize) -> usize| {
        Values::Whole(
            (0..pairs.len())
                .map(|at| i32::try_from(of(at)).ok())
                .collect(),
        )
    };
    let columns = vec![
        ("pair".to_owned(), whole(&|at| at)),
        ("left".to_owned(), texts(&|at| name(pairs[at].buildings[0]))),
        (
            "right".to_owned(),
            texts(&|at| name(pairs[at].buildings[1])),
        ),
        ("distance_m".to_owned(), reals(&|at| pairs[at].distance)),
        ("face_m".to_owned(), reals(&|at| pairs[at].face)),
        (
            "normal_deg".to_owned(),
            reals(&|at| pairs[at].normal.to_degrees()),
        ),
        (
            "floor_offset_m".to_owned(),
            reals(&|at| pairs[at].floor_offset),
        ),
        (
            "height_ratio".to_owned(),
            reals(&|at| pairs[at].height_ratio),
        ),
        (
            "position".to_owned(),
            texts(&|at| pairs[at].position.name().to_owned()),
        ),
    ];
    write_values_parquet(
        &folder.join("pairs.parquet"),
        "Pairs of neighbours",
        &[],
        columns,
    )?;
    let whole = |of: &dyn Fn(&Block) -> usize| {
        Values::Whole(
            blocks
                .iter()
                .map(|block| i32::try_from(of(block)).ok())
                .collect(),
        )
    };
    let columns = vec![
        ("buildings".to_owned(), whole(&|own| own.buildings.len())),
        ("pairs".to_owned(), whole(&|own| own.pairs.len())),
        ("tree".to_owned(), whole(&|own| usize::from(own.is_tree()))),
        (
            "first".to_owned(),
            Values::Text(blocks.iter().map(|own| name(own.buildings[0])).collect()),
        ),
    ];
    write_values_parquet(
        &folder.join("blocks.parquet"),
        "Blocks of neighbours",
        &[],
        columns,
    )?;
    write_atomically(
        &folder.join("mended.csv"),
        mended_csv(&inventory.mends).as_bytes(),
    )?;
    Ok(())
}

/// What is known of buildings, without their outlines.
pub(crate) fn building_columns(buildings: &[Building]) -> Vec<(String, Values)> {
    let whole =
        |of: &dyn Fn(&Building) -> Option<i32>| Values::Whole(buildings.iter().map(of).collect());
    vec![
        (
            "id".to_owned(),
            Values::Text(buildings.iter().map(|own| own.id.clone()).collect()),
        ),
        (
            "storeys".to_owned(),
            whole(&|own| own.storeys.and_then(|own| i32::try_from(own).ok())),
        ),
        (
            "height_m".to_owned(),
            Values::Instant(buildings.iter().map(|own| own.height).collect()),
        ),
        ("year".to_owned(), whole(&|own| own.year)),
        (
            "type".to_owned(),
            Values::Text(
                buildings
                    .iter()
                    .map(|own| own.kind.clone().unwrap_or_default())
                    .collect(),
            ),
        ),
        (
            "area_m2".to_owned(),
            Values::Real(buildings.iter().map(|own| own.area).collect()),
        ),
    ]
}

/// Writes buildings with their outlines as GeoParquet 1.1.
pub(crate) fn write_buildings(
    path: &Path,
    inventory: &Inventory,
    mut columns: Vec<(String, Values)>,
) -> Result<(), CityError> {
    let outlines = inventory
        .buildings
        .iter()
        .map(|building| binary(&inventory.plane.outline(&building.outline)));
    columns.push(("geometry".to_owned(), Values::Bytes(outlines.collect())));
    // Without a reference system readers take longitude and latitude; null says that it is unknown.
    let mut column = json!({ "encoding": "WKB", "geometry_types": ["Polygon"] });
    if inventory.plane == Plane::Metres {
        column["crs"] = serde_json::Value::Null;
    }
    let geo = json!({ "version": "1.1.0", "primary_column": "geometry", "columns": { "geometry": column } });
    write_values_parquet(path, "Buildings", &[("geo", geo.to_string())], columns)?;
    Ok(())
}

/// An outline as WKB.
fn binary(polygon: &Polygon) -> Vec<u8> {
    let mut bytes = Vec::new();
    // Writing into memory cannot fail, and an outline has two dimensions.
    let _ = wkb::writer::write_polygon(&mut bytes, polygon, &wkb::writer::WriteOptions::default());
    bytes
}

/// What was mended, one line each.
fn mended_csv(mends: &[Mend]) -> String {
    let mut text = String::from("row,id,what,detail\n");
    for mend in mends {
        let _ = writeln!(
            text,
            "{},{},{},{}",
            mend.row,
            csv_field(&mend.id),
            csv_field(mend.what),
            csv_field(&mend.detail)
        );
    }
    text
}

/// What a folder says of its run.
pub(crate) struct Known {
    pub(crate) city_file: PathBuf,
    pub(crate) draws: usize,
    pub(crate) tolerance: f64,
    pub(crate) fingerprint: String,
}

impl Known {
    pub(crate) fn read(folder: &Path) -> Result<Self, CityError> {
        let path = folder.join(KNOWN);
        if !path.exists() {
            return Err(CityError::lacks(&path, "run"));
        }
        let text = jostle_io::read_text_file(&path, 1 << 20)
            .map_err(|error| CityError::of(&path, error))?;
        let known: serde_json::Value =
            serde_json::from_str(&text).map_err(|error| CityError::of(&path, error))?;
        let known_of = || {
            Some(Self {
                city_file: PathBuf::from(known["city_file"].as_str()?),
                draws: usize::try_from(known["draws"].as_u64()?).ok()?,
                tolerance: known["tolerance"].as_f64()?,
                fingerprint: known["fingerprint"].as_str()?.to_owned(),
            })
        };
        known_of().ok_or_else(|| CityError::of(&path, "is not what `jostle city run` wrote"))
    }
}

/// The file that says whose results a folder holds.
const KNOWN: &str = "city.json";

/// Says whose results a folder holds; refuses one that holds those of another city file.
pub(crate) fn claim(folder: &Path, file: &CityFile, fingerprint: &str) -> Result<(), CityError> {
    if folder.join(KNOWN).exists() && Known::read(folder)?.fingerprint != fingerprint {
        return Err(CityError::of(
            folder,
            "holds the run of another city file, inventory or motion, or with other options; choose another folder with \
             --out, or remove it",
        ));
    }
    let whole = std::path::absolute(&file.path).unwrap_or_else(|_| file.path.clone());
    let known = json!({
        "jostle": env!("CARGO_PKG_VERSION"),
        "city_file": whole,
        "draws": file.draws,
        "tolerance": file.tolerance,
        "fingerprint": fingerprint,
    });
    write_atomically(&folder.join(KNOWN), format!("{known:#}\n").as_bytes())?;
    Ok(())
}
