//! `[motion]` of a city file: one motion for all, or motions and intensities that differ from place to place.

use std::path::{Path, PathBuf};

use crate::files::Files;
use crate::keys::Section;
use crate::model_file;
use crate::motion_spec::{MotionSpec, Scaling};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// What shakes a city.
#[derive(Clone, Debug, PartialEq)]
pub enum CityMotion {
    /// One or several motions, the same everywhere.
    Common(MotionSpec),
    /// Motions at points, as the tools of SimCenter list them.
    Grid {
        /// `EventGrid.csv`.
        file: PathBuf,
        /// Unit of the accelerations.
        unit: String,
        /// Greatest distance of a building from a point \[m\].
        reach: f64,
    },
    /// Records that are scaled to the intensities of every place.
    Scaled {
        /// Where these stand.
        intensities: IntensityFile,
        /// One or several records, unscaled.
        records: MotionSpec,
        /// Records that a place takes.
        choose: usize,
        /// Greatest distance of a building from a site, where intensities stand at sites \[m\].
        reach: f64,
    },
}

/// A file of intensities.
#[derive(Clone, Debug, PartialEq)]
pub enum IntensityFile {
    /// `grid.xml` of a ShakeMap: medians on a regular grid.
    ShakeMap(PathBuf),
    /// Ground motion fields of OpenQuake: intensities of every event at sites.
    Fields {
        /// Table of intensities, `event_id,site_id,gmv_…`.
        file: PathBuf,
        /// Table of sites, `site_id,lon,lat`.
        sites: PathBuf,
    },
}

/// Greatest distance from a point of a grid that is not told \[m\].
const REACH: f64 = 10e3;
/// Keys of a motion at points.
const OF_GRID: [&str; 3] = ["grid", "unit", "site_reach"];

pub(crate) fn read(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    files: &Files,
    folder: &Path,
) -> Option<CityMotion> {
    const SECTIONS: &[Section] = &[Section::Motion, Section::CityMotion];
    let view = reader.reopen(field, SECTIONS);
    let Some(view) = view else {
        reader.open(field, SECTIONS);
        return None;
    };
    let mut path = |key: &'static str| {
        let field = reader.get(&view, key)?;
        let text = reader.text(&field)?;
        Some((field, folder.join(text)))
    };
    let [grid, shakemap, gmf, sites] = ["grid", "shakemap", "gmf", "sites"].map(&mut path);
    let choose = reader.get(&view, "choose");
    let reach = reader.get(&view, "site_reach");
    let reach_value = reach.as_ref().map_or(Some(REACH), |field| {
        reader.positive(field, Dimension::Length)
    });
    let count = choose.as_ref().map_or(Some(1), |field| {
        let value = reader.count(field)?;
        if (1..=1000).contains(&value) {
            return Some(value);
        }
        reader.bad(field, format!("must lie between 1 and 1000, found {value}"));
        None
    });
    if let Some((_, file)) = grid {
        reader.open(field, SECTIONS);
        let entries = field.named_entries().unwrap_or_default();
        for (key, other) in entries
            .iter()
            .filter(|named_entry| !OF_GRID.contains(&named_entry.0))
        {
            *reader.bad(
                other,
                "does not go with grid, whose points have their own motions",
            ) = Some(format!("remove {key}"));
        }
        let unit = reader.get(&view, "unit");
        let unit = match unit {
            Some(field) => reader.text(&field),
            None => {
                reader.missing(
                    &view,
                    "unit",
                    "say the unit of the accelerations, which the files of a grid do not state: unit = \"g\"",
                );
                None
            }
        };
        return Some(CityMotion::Grid {
            file,
            unit: unit?,
            reach: reach_value?,
        });
    }
    let records = model_file::motion::read_in(reader, field, files, SECTIONS);
    let intensities = match (shakemap, gmf, sites) {
        (Some(_), Some((field, _)), _) => {
            *reader.bad(&field, "does not go with shakemap") =
                Some("keep either shakemap or gmf".into());
            return None;
        }
        (Some(_), None, Some((field, _))) => {
            *reader.bad(
                &field,
                "does not go with shakemap, whose grid has its places",
            ) = Some("remove sites".into());
            return None;
        }
        (Some((_, file)), None, None) => IntensityFile::ShakeMap(file),
        (None, Some((_, file)), Some((_, sites))) => IntensityFile::Fields { file, sites },
        (None, Some(_), None) => {
            reader.missing(
                &view,
                "sites",
                "say where the sites are: sites = \"sites.csv\" with site_id, lon and lat",
            );
            return None;
        }
        (None, None, sites) => {
            let alone = [sites.map(|site| site.0), choose, reach];
            for field in alone.into_iter().flatten() {
                *reader.bad(&field, "needs intensities of places") =
                    Some("add shakemap = \"grid.xml\", or gmf and sites, or remove it".into());
            }
            return Some(CityMotion::Common(records?));
        }
    };
    let records = records?;
    scaled_otherwise(reader, &view, &records);
    Some(CityMotion::Scaled {
        intensities,
        records,
        choose: count?,
        reach: reach_value?,
    })
}

/// Records that a map scales have no scale of their own, and a wave has no spectrum to choose by.
fn scaled_otherwise(reader: &mut Reader<'_>, view: &View<'_>, records: &MotionSpec) {
    if records.scaling == Scaling::AsRecorded {
        return;
    }
    for key in ["pga", "scale", "match"] {
        if let Some(field) = reader.get(view, key) {
            *reader.bad(
                &field,
                "does not go with intensities of places, which scale the records",
            ) = Some(format!("remove {key}"));
        }
    }
}
