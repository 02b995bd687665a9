//! Motions at points, as the tools of NHERI SimCenter write them: `EventGrid.csv` lists points (`GP_file,Longitude,Latitude`), the file
//! of a point lists records (`TH_file,factor`), and a record is JSON with `dT` and `data_x`, `data_y`. x points east and y north.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use jostle_io::{
    BearingSpec, MotionSource, MotionSpec, RecordFormat, RecordOptions, Scaling, parse_info,
    read_file,
};
use sha2::{Digest, Sha256};

use super::sites::{Nearest, degrees, number, rows};
use super::{Shaking, Source, Strength};
use crate::blocks::Block;
use crate::fault::CityError;
use crate::inventory::Inventory;

/// Largest record \[bytes\].
const LARGEST: usize = 256 << 20;

pub(super) fn read(
    path: &Path,
    unit: &str,
    reach: f64,
    inventory: &Inventory,
    blocks: &[Block],
    place_of: &mut [u32],
) -> Result<Shaking, CityError> {
    let (mut files, mut points) = (Vec::new(), Vec::new());
    rows(
        path,
        [&["GP_file"], &["Longitude"], &["Latitude"]],
        &mut |_| Ok(()),
        &mut |line, [file, longitude, latitude], _| {
            files.push(file.to_owned());
            points.push([
                degrees(path, line, "Longitude", longitude)?,
                degrees(path, line, "Latitude", latitude)?,
            ]);
            Ok(())
        },
    )?;
    let nearest = Nearest::of(path, &points, reach, inventory, blocks)?;
    nearest.spread(blocks, place_of);
    let folder = path.parent().unwrap_or(Path::new(""));
    // Several points may share records.
    let mut known: BTreeMap<PathBuf, usize> = BTreeMap::new();
    let mut sources = Vec::new();
    let mut places: Vec<Vec<Strength>> = Vec::with_capacity(nearest.used.len());
    let mut across = None;
    for at in &nearest.used {
        let listed = folder.join(&files[*at]);
        let mut strengths = Vec::new();
        let has_factor = std::cell::Cell::new(None);
        rows(
            &listed,
            [&["TH_file"]],
            &mut |header| {
                has_factor.set(
                    header
                        .iter()
                        .position(|header| header.eq_ignore_ascii_case("factor")),
                );
                Ok(())
            },
            &mut |line, [file], row| {
                let factor = has_factor.get().and_then(|at| row.get(at));
                let factor = match factor.filter(|factor| !factor.is_empty()) {
                    Some(text) => number(&listed, line, "factor", text)?,
                    None => 1.0,
                };
                let record = record_path(&listed, file);
                let motion = match known.get(&record) {
                    Some(at) => *at,
                    None => {
                        if !record.is_file() {
                            return Err(CityError::of(
                                &listed,
                                format!("line {line}: there is no file {}", record.display()),
                            ));
                        }
                        let across = match across {
                            Some(known) => known,
                            None => *across.insert(has_component(&record, "y")?),
                        };
                        sources.push(Source {
                            spec: spec(&record, unit, across),
                            resolved: None,
                        });
                        known.insert(record, sources.len() - 1);
                        sources.len() - 1
                    }
                };
                strengths.push(Strength { motion, factor });
                Ok(())
            },
        )?;
        if strengths.is_empty() {
            return Err(CityError::of(&listed, "lists no record"));
        }
        if let Some(first) = places.first()
            && first.len() != strengths.len()
        {
            return Err(CityError::of(
                &listed,
                format!(
                    "lists {} records, and {} lists {}: every point needs as many",
                    strengths.len(),
                    files[nearest.used[0]],
                    first.len()
                ),
            ));
        }
        places.push(strengths);
    }
    let count = places.first().map_or(0, Vec::len);
    if count == 0 {
        // A city without neighbours needs no motion.
        places = vec![Vec::new()];
    }
    let told = vec![format!(
        "{}: {} of {} points stand next to a block, the farthest {:.1} km away, with {count} motions each",
        path.display(),
        nearest.used.len(),
        points.len(),
        1e-3 * nearest.farthest
    )];
    Ok(Shaking {
        sources,
        names: (1..=count)
            .map(|at| format!("motion {at} of the point"))
            .collect(),
        places,
        place_of: Vec::new(),
        told,
        has_directions: across.unwrap_or(false),
    })
}

/// Records are named with or without their ending.
fn record_path(listed: &Path, name: &str) -> PathBuf {
    let folder = listed.parent().unwrap_or(Path::new(""));
    let is_json = Path::new(name)
        .extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("json"));
    folder.join(if is_json {
        name.to_owned()
    } else {
        format!("{name}.json")
    })
}

fn has_component(record: &Path, component: &str) -> Result<bool, CityError> {
    let bytes = read_file(record, LARGEST).map_err(|error| CityError::of(record, error))?;
    let options = RecordOptions {
        format: Some(RecordFormat::SimCenter),
        component: Some("1".to_owned()),
        ..RecordOptions::default()
    };
    let info = parse_info(&bytes, &options).map_err(|error| CityError::of(record, error))?;
    Ok(info
        .channels
        .iter()
        .any(|channel| channel.name == component))
}

/// A record with its component y, if there is one, a right angle from x.
fn spec(record: &Path, unit: &str, across: bool) -> MotionSpec {
    let one = |component: &str| MotionSpec {
        source: MotionSource::Record {
            name: record.display().to_string(),
            files: jostle_io::Files::beside(Path::new("")),
            options: RecordOptions {
                unit: Some(unit.to_owned()),
                component: Some(component.to_owned()),
                format: Some(RecordFormat::SimCenter),
                ..RecordOptions::default()
            },
        },
        scaling: Scaling::AsRecorded,
        reverse: false,
        duration: None,
        bearing: None,
        grounds: None,
    };
    let bearing = across.then(|| {
        Box::new(BearingSpec {
            angle: 0.0,
            across: Some(one("y")),
        })
    });
    MotionSpec {
        bearing,
        ..one("x")
    }
}

/// Adds the bytes of a record and its unit, not its place: the same city may be moved.
pub(super) fn hash(spec: &MotionSpec, hash: &mut Sha256) -> Result<(), CityError> {
    if let MotionSource::Record { name, options, .. } = &spec.source {
        let path = Path::new(name);
        let bytes = read_file(path, LARGEST).map_err(|error| CityError::of(path, error))?;
        hash.update(bytes);
        hash.update(format!("{options:?}"));
    }
    Ok(())
}
