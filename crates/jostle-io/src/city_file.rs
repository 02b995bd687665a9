//! City files: footprints, what is assumed of their buildings and gaps, and the motion.

use std::path::{Path, PathBuf};

use crate::city_motion::{self, CityMotion};
use crate::fault::InputError;
use crate::files::Files;
use crate::keys::Section;
use crate::model_file;
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};
use crate::source::Source;
use crate::tree::{self, Format, Node};
use crate::types_tables::{self, TypesTables};

/// How the design level of a building is found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CityLevel {
    /// From its year of construction, by the first years of the levels low, moderate and high; `None` takes those of
    /// California.
    ByYear(Option<[Option<i32>; 3]>),
    /// One for all, by its name.
    Of(String),
}

/// A city file, read and checked as far as that is possible without its inventory.
#[derive(Clone, Debug, PartialEq)]
pub struct CityFile {
    /// Where it stands; empty for a text.
    pub path: PathBuf,
    /// Title of the pages.
    pub title: String,
    /// Path of the footprints.
    pub inventory: PathBuf,
    /// Whether its coordinates are metres, not degrees.
    pub metres: bool,
    /// What a column says (`storeys`, …) and its name, where that differs from the usual ones.
    pub columns: Vec<(&'static str, String)>,
    /// Buildings no farther apart on the map are neighbours \[m\].
    pub reach: f64,
    /// Structural type of buildings without one.
    pub kind: String,
    /// How design levels are found.
    pub level: CityLevel,
    /// Tables of types.
    pub types: TypesTables,
    /// Standard deviations of the logarithms of storey stiffness, strength and damping \[–\].
    pub scatter: [f64; 3],
    /// Median of the widths of gaps \[m\].
    pub gap_median: f64,
    /// Standard deviation of their logarithm \[–\].
    pub gap_scatter: f64,
    /// Whether the median is that of the file, not the default.
    pub gap_is_given: bool,
    /// Share of pairs with a wall in common, 0…1 \[–\].
    pub party_wall: f64,
    /// Stiffness of hertz-damp \[N/m^1.5\].
    pub contact_stiffness: f64,
    /// Restitution, 0…1 \[–\].
    pub restitution: f64,
    /// Standard deviation of the logarithm of the contact stiffness \[–\].
    pub contact_scatter: f64,
    /// What shakes it.
    pub motion: CityMotion,
    /// Draws for every motion, 1…65,536.
    pub draws: usize,
    /// Relative error of peaks \[–\].
    pub tolerance: f64,
    /// Least number of rows that are run again in full.
    pub sample: usize,
    /// Warnings of unusual values.
    pub warnings: Vec<String>,
}

/// Columns of an inventory that may have a name of their own.
const COLUMNS: [&str; 6] = ["id", "footprint", "storeys", "height", "year", "type"];

impl CityFile {
    /// Reads the city file at a path: JSON if its name ends in `.json`, else TOML.
    ///
    /// # Errors
    /// All faults at once.
    pub fn load(path: &Path) -> Result<Self, InputError> {
        let (name, text) = model_file::read_text(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let read = Self::parse(&name, &text, Format::of_path(path), folder)?;
        Ok(Self {
            path: path.to_owned(),
            ..read
        })
    }

    /// Reads the text of a city file. `name` stands in messages; paths start from `folder`.
    ///
    /// # Errors
    /// All faults at once.
    pub fn parse(
        name: &str,
        text: &str,
        format: Format,
        folder: &Path,
    ) -> Result<Self, InputError> {
        let text = tree::decode(name, text.as_bytes())?;
        let source = Source::new(name, text);
        let root = tree::parse(&source, format)?;
        let mut reader = Reader::new(&source);
        let read = read_root(&mut reader, &root, &Files::beside(folder), folder);
        let warnings = reader.take_warnings();
        let error = reader.into_error();
        match read {
            Some(mut root) if error.faults.is_empty() => {
                root.warnings = warnings;
                Ok(root)
            }
            _ => Err(error),
        }
    }
}

fn read_root(
    reader: &mut Reader<'_>,
    root: &Node,
    files: &Files,
    folder: &Path,
) -> Option<CityFile> {
    let field = Field::root(root);
    let view = reader.open(&field, &[Section::City])?;
    let title = reader.get(&view, "title");
    let title = title.and_then(|field| reader.text(&field));
    let inventory = inventory(reader, &view, folder);
    let buildings = reader.table(
        &view,
        "buildings",
        &[Section::CityBuildings, Section::TypesTable],
    );
    let kind = text(reader, buildings.as_ref(), "type").unwrap_or_else(|| "C1".to_owned());
    let level = level(reader, buildings.as_ref());
    let types = types_tables::read(reader, &view, buildings.as_ref(), folder);
    let scatter = [
        ("stiffness_scatter", 0.1),
        ("strength_scatter", 0.25),
        ("damping_scatter", 0.1),
    ]
    .map(|(key, usual)| number(reader, buildings.as_ref(), key, usual, [0.0, 2.0]));
    let gap = reader.table(&view, "gap", &[Section::CityGap]);
    let median = gap.as_ref().and_then(|view| reader.get(view, "median"));
    let gap_is_given = median.is_some();
    let gap_median = median.map_or(Some(0.025), |field| {
        reader.positive(&field, Dimension::Length)
    });
    let gap_scatter = number(reader, gap.as_ref(), "scatter", 0.8, [0.0, 3.0]);
    let party_wall = number(reader, gap.as_ref(), "party_wall", 0.0, [0.0, 1.0]);
    let contact = reader.table(&view, "contact", &[Section::CityContact]);
    let stiffness = contact
        .as_ref()
        .and_then(|view| reader.get(view, "stiffness"));
    let stiffness = stiffness.map_or(Some(2.75e9), |field| {
        reader.positive(&field, Dimension::HertzStiffness)
    });
    let restitution = number(reader, contact.as_ref(), "restitution", 0.65, [0.0, 1.0]);
    let contact_scatter = number(reader, contact.as_ref(), "scatter", 0.3, [0.0, 3.0]);
    let motion = match reader.get(&view, "motion") {
        Some(field) => city_motion::read(reader, &field, files, folder),
        None => {
            reader.missing(
                &view,
                "motion",
                "add [motion] with record = \"el-centro-1940-ns\"",
            );
            None
        }
    };
    let run = reader.table(&view, "run", &[Section::CityRun]);
    let draws = count(reader, run.as_ref(), "draws", 25, [1, 1 << 16]);
    let tolerance = number(reader, run.as_ref(), "tolerance", 1e-2, [1e-3, 1e-1]);
    let sample = count(reader, run.as_ref(), "sample", 20, [0, 100_000]);
    let (inventory, metres, columns, reach) = inventory?;
    Some(CityFile {
        path: PathBuf::new(),
        title: title.unwrap_or_else(|| "City".to_owned()),
        inventory,
        metres,
        columns,
        reach,
        kind,
        level: level?,
        types: types?,
        scatter: [scatter[0]?, scatter[1]?, scatter[2]?],
        gap_median: gap_median?,
        gap_scatter: gap_scatter?,
        gap_is_given,
        party_wall: party_wall?,
        contact_stiffness: stiffness?,
        restitution: restitution?,
        contact_scatter: contact_scatter?,
        motion: motion?,
        draws: draws?,
        tolerance: tolerance?,
        sample: sample?,
        warnings: Vec::new(),
    })
}

/// How design levels are found: a name, `"year"`, or a table of first years.
fn level(reader: &mut Reader<'_>, buildings: Option<&View<'_>>) -> Option<CityLevel> {
    let Some(field) = buildings.and_then(|view| reader.get(view, "level")) else {
        return Some(CityLevel::ByYear(None));
    };
    if field.as_text().is_some() {
        let name = reader.text(&field)?;
        return Some(if name == "year" {
            CityLevel::ByYear(None)
        } else {
            CityLevel::Of(name)
        });
    }
    let view = reader.open(&field, &[Section::CityLevels])?;
    let years = ["low", "moderate", "high"].map(|key| {
        let field = reader.get(&view, key)?;
        Some(i32::try_from(reader.count(&field)?).unwrap_or(i32::MAX))
    });
    let given: Vec<i32> = years.into_iter().flatten().collect();
    if given.is_empty() || given.windows(2).any(|pair| pair[0] >= pair[1]) {
        reader.bad(
            &field,
            "expected first years that rise from low to high, such as { low = 1950, moderate = 1975, high = 2000 }"
                .to_owned(),
        );
        return None;
    }
    Some(CityLevel::ByYear(Some(years)))
}

/// Path, whether coordinates are metres, names of columns, reach.
type Inventory = (PathBuf, bool, Vec<(&'static str, String)>, f64);

fn inventory(reader: &mut Reader<'_>, view: &View<'_>, folder: &Path) -> Option<Inventory> {
    let Some(view) = reader.table(view, "inventory", &[Section::CityInventory]) else {
        if !view.has("inventory") {
            reader.missing(
                view,
                "inventory",
                "add [inventory] with file = \"footprints.geojson\"",
            );
        }
        return None;
    };
    let file = match reader.get(&view, "file") {
        Some(field) => reader.text(&field),
        None => {
            reader.missing(&view, "file", "add file = \"footprints.geojson\"");
            None
        }
    };
    let metres = reader.get(&view, "metres");
    let metres = metres
        .and_then(|field| reader.flag(&field))
        .unwrap_or(false);
    let named = reader.table(&view, "columns", &[Section::CityColumns]);
    let mut columns = Vec::new();
    for column in COLUMNS {
        if let Some(name) = text(reader, named.as_ref(), column) {
            columns.push((column, name));
        }
    }
    let reach = reader.get(&view, "reach");
    let reach = reach.map_or(Some(0.5), |field| {
        reader.positive(&field, Dimension::Length)
    });
    Some((folder.join(file?), metres, columns, reach?))
}

fn text(reader: &mut Reader<'_>, view: Option<&View<'_>>, key: &'static str) -> Option<String> {
    let field = reader.get(view?, key)?;
    reader.text(&field)
}

/// A number within limits, or the usual one where the key is absent.
pub(crate) fn number(
    reader: &mut Reader<'_>,
    view: Option<&View<'_>>,
    key: &'static str,
    usual: f64,
    [least, most]: [f64; 2],
) -> Option<f64> {
    let Some(field) = view.and_then(|view| reader.get(view, key)) else {
        return Some(usual);
    };
    let value = reader.quantity(&field, Dimension::Dimensionless)?;
    if (least..=most).contains(&value) {
        return Some(value);
    }
    reader.bad(
        &field,
        format!("must lie between {least} and {most}, found {value}"),
    );
    None
}

/// A whole number within limits, or the usual one where the key is absent.
pub(crate) fn count(
    reader: &mut Reader<'_>,
    view: Option<&View<'_>>,
    key: &'static str,
    usual: usize,
    [least, most]: [usize; 2],
) -> Option<usize> {
    let Some(field) = view.and_then(|view| reader.get(view, key)) else {
        return Some(usual);
    };
    let value = reader.count(&field)?;
    if (least..=most).contains(&value) {
        return Some(value);
    }
    reader.bad(
        &field,
        format!("must lie between {least} and {most}, found {value}"),
    );
    None
}

/// Keys that the reader asks for.
#[cfg(test)]
pub(crate) fn keys_asked(
    source: &Source,
    root: &Node,
) -> std::collections::BTreeSet<(Section, &'static str)> {
    let mut reader = Reader::new(source);
    let _ = read_root(
        &mut reader,
        root,
        &Files::beside(Path::new("")),
        Path::new(""),
    );
    reader.asked
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_city_file_has_its_defaults_and_its_faults_at_their_lines() {
        let text = "[inventory]\nfile = \"a.geojson\"\n[motion]\nrecord = \"el-centro-1940-ns\"\n";
        let parse =
            |text: &str| CityFile::parse("city.toml", text, Format::Toml, Path::new("there"));
        let city = parse(text).expect("a city");
        assert_eq!(city.inventory, Path::new("there/a.geojson"));
        assert_eq!(
            (city.gap_median, city.gap_is_given, city.draws),
            (0.025, false, 25)
        );
        assert_eq!(city.level, CityLevel::ByYear(None));
        let error = parse("[inventory]\nfil = \"a\"\n[gap]\nmedian = \"-3 mm\"\nparty_wall = 2\n")
            .expect_err("faults");
        let error = error.to_string();
        for wanted in [
            "file",
            "motion",
            "gap.median",
            "gap.party_wall",
            "city.toml:4",
            "city.toml:5",
        ] {
            assert!(error.contains(wanted), "{wanted}: {error}");
        }
    }
}
