//! Classes files: classes of buildings, their neighbours, gaps, motions, and how much is run.

use std::path::Path;
use std::sync::Arc;

use crate::city_file::{count, number};
use crate::fault::InputError;
use crate::files::Files;
use crate::keys::{ALIGNMENTS, MEASURES, POSITIONS, Section};
use crate::model_file;
use crate::motion_spec::MotionSpec;
use crate::origin::Origin;
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};
use crate::source::Source;
use crate::tree::{self, Format, Node};
use crate::types_tables::{self, TypesTables};

/// Kinds of buildings: every type with every number of storeys.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClassesSide {
    /// Types: names of the table of types, or taxonomy strings of GEM.
    pub types: Vec<String>,
    /// Storeys, 1…16.
    pub storeys: Vec<usize>,
    /// Design level: high, moderate, low or pre.
    pub level: String,
    /// Path of the level, for faults.
    pub path: String,
}

/// How strong a motion is said to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClassesMeasure {
    /// Peak ground acceleration.
    Pga,
    /// Pseudo-acceleration at the first period of the class, damping 5 %.
    SaT1,
    /// Geometric mean of pseudo-accelerations from 0.2 to 3 times that period, damping 5 %.
    AvgSa,
}

/// A classes file, read and checked as far as that is possible without its records and the table of types.
#[derive(Clone, Debug)]
pub struct ClassesFile {
    /// Title of the page.
    pub title: String,
    /// Tables of types.
    pub types: TypesTables,
    /// Classes whose fragility is sought.
    pub class: ClassesSide,
    /// Their neighbours.
    pub neighbour: ClassesSide,
    /// Widths of gaps, rising \[m\].
    pub gaps: Vec<f64>,
    /// Whether the floors of neighbours lie half a storey higher.
    pub half_storey_up: Vec<bool>,
    /// Whether the class stands between two neighbours.
    pub in_the_middle: Vec<bool>,
    /// Area of a floor \[m²\].
    pub area: f64,
    /// Stiffness of hertz-damp \[N/m^1.5\].
    pub contact_stiffness: f64,
    /// Restitution, 0…1 \[–\].
    pub restitution: f64,
    /// Standard deviation of the logarithm of the contact stiffness \[–\].
    pub contact_scatter: f64,
    /// The motion or motions.
    pub motion: MotionSpec,
    /// Measure of intensity.
    pub measure: ClassesMeasure,
    /// Intensities to which every motion is scaled, rising \[m/s²\]; none takes motions as they are.
    pub levels: Vec<f64>,
    /// Draws for every motion, 1…65,536.
    pub draws: usize,
    /// Standard deviations of the logarithms of storey stiffness, strength and damping \[–\].
    pub scatter: [f64; 3],
    /// Relative error of peaks \[–\].
    pub tolerance: f64,
    /// Least number of rows that are run again in full.
    pub sample: usize,
    /// Resamples of the bootstrap.
    pub resamples: usize,
    /// Warnings of unusual values.
    pub warnings: Vec<String>,
    origin: Origin,
}

impl ClassesMeasure {
    /// All, in the order of their names in a file.
    const ALL: [Self; 3] = [Self::Pga, Self::SaT1, Self::AvgSa];

    /// Its name in a file.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Pga => MEASURES[0],
            Self::SaT1 => MEASURES[1],
            Self::AvgSa => MEASURES[2],
        }
    }
}

impl ClassesFile {
    /// Reads the classes file at a path: JSON if its name ends in `.json`, else TOML.
    ///
    /// # Errors
    /// All faults at once.
    pub fn load(path: &Path) -> Result<Self, InputError> {
        let (name, text) = model_file::read_text(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::parse(&name, &text, Format::of_path(path), folder)
    }

    /// Reads the text of a classes file. `name` stands in messages; paths start from `folder`.
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
        let source = Arc::new(Source::new(name, text));
        let root = tree::parse(&source, format)?;
        let origin = Origin {
            source: Arc::clone(&source),
            root: root.clone(),
        };
        let mut reader = Reader::new(&source);
        let read = read_root(&mut reader, &root, &Files::beside(folder), folder, origin);
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

    /// An error about a field that only came to light after reading: it shows the line of the file.
    #[must_use]
    pub fn fault(&self, path: &str, problem: impl Into<String>) -> InputError {
        self.origin.fault(path, problem)
    }
}

fn read_root(
    reader: &mut Reader<'_>,
    root: &Node,
    files: &Files,
    folder: &Path,
    origin: Origin,
) -> Option<ClassesFile> {
    let field = Field::root(root);
    let view = reader.open(&field, &[Section::Classes])?;
    let title = reader.get(&view, "title");
    let title = title.map_or_else(
        || Some("Classes of buildings".to_owned()),
        |field| reader.text(&field),
    );
    let buildings = reader.table(&view, "buildings", &[Section::TypesTable]);
    let types = types_tables::read(reader, &view, buildings.as_ref(), folder);
    if !view.has("class") {
        reader.missing(
            &view,
            "class",
            "add [class] with types = [\"C1\"] and storeys = [3]",
        );
    }
    let class = side(reader, &view, "class");
    let neighbour = if view.has("neighbour") {
        side(reader, &view, "neighbour")
    } else {
        class.clone()
    };
    let pair = reader.table(&view, "pair", &[Section::ClassesPair]);
    let gaps = rising(
        reader,
        pair.as_ref(),
        "gaps",
        Dimension::Length,
        &[0.01, 0.05],
    );
    let up = words(
        reader,
        pair.as_ref(),
        "alignment",
        &ALIGNMENTS,
        &ALIGNMENTS[..1],
    );
    let middle = words(
        reader,
        pair.as_ref(),
        "position",
        &POSITIONS,
        &POSITIONS[..1],
    );
    let area = positive(reader, pair.as_ref(), "area", Dimension::Area, 200.0);
    let contact = reader.table(&view, "contact", &[Section::CityContact]);
    let stiffness = positive(
        reader,
        contact.as_ref(),
        "stiffness",
        Dimension::HertzStiffness,
        2.75e9,
    );
    let restitution = number(reader, contact.as_ref(), "restitution", 0.65, [0.0, 1.0]);
    let contact_scatter = number(reader, contact.as_ref(), "scatter", 0.3, [0.0, 3.0]);
    let motion = match reader.get(&view, "motion") {
        Some(field) => model_file::motion::read(reader, &field, files),
        None => {
            reader.missing(
                &view,
                "motion",
                "add [motion] with record = \"el-centro-1940-ns\", or with a list of records",
            );
            None
        }
    };
    let intensity = reader.table(&view, "intensity", &[Section::ClassesIntensity]);
    let measure = intensity
        .as_ref()
        .and_then(|view| reader.get(view, "measure"));
    let measure = measure.map_or(Some(MEASURES[0]), |field| {
        reader.choice(&field, &MEASURES, &[])
    });
    let levels = rising(
        reader,
        intensity.as_ref(),
        "levels",
        Dimension::Acceleration,
        &[],
    );
    let run = reader.table(&view, "run", &[Section::ClassesRun]);
    let draws = count(reader, run.as_ref(), "draws", 10, [1, 1 << 16]);
    let scatter = [
        ("stiffness_scatter", 0.1),
        ("strength_scatter", 0.25),
        ("damping_scatter", 0.1),
    ]
    .map(|(key, usual)| number(reader, run.as_ref(), key, usual, [0.0, 2.0]));
    let tolerance = number(reader, run.as_ref(), "tolerance", 1e-2, [1e-3, 1e-1]);
    let sample = count(reader, run.as_ref(), "sample", 20, [0, 100_000]);
    let resamples = count(reader, run.as_ref(), "resamples", 200, [0, 100_000]);
    let measure = measure?;
    Some(ClassesFile {
        title: title?,
        types: types?,
        class: class?,
        neighbour: neighbour?,
        gaps: gaps?,
        half_storey_up: up?.iter().map(|up| *up == ALIGNMENTS[1]).collect(),
        in_the_middle: middle?
            .iter()
            .map(|middle| *middle == POSITIONS[1])
            .collect(),
        area: area?,
        contact_stiffness: stiffness?,
        restitution: restitution?,
        contact_scatter: contact_scatter?,
        motion: motion?,
        measure: ClassesMeasure::ALL
            .into_iter()
            .find(|candidate| candidate.name() == measure)?,
        levels: levels?,
        draws: draws?,
        scatter: [scatter[0]?, scatter[1]?, scatter[2]?],
        tolerance: tolerance?,
        sample: sample?,
        resamples: resamples?,
        warnings: Vec::new(),
        origin,
    })
}

/// `[class]` or `[neighbour]`.
fn side(reader: &mut Reader<'_>, view: &View<'_>, key: &'static str) -> Option<ClassesSide> {
    let table = reader.table(view, key, &[Section::ClassesSide])?;
    let types = match reader.get(&table, "types") {
        None => {
            reader.missing(&table, "types", "add types = [\"C1\"]");
            None
        }
        Some(field) => list(reader, &field, "[\"C1\", \"URM\"]", |reader, field| {
            reader.text(field)
        }),
    };
    let storeys = match reader.get(&table, "storeys") {
        None => {
            reader.missing(&table, "storeys", "add storeys = [3]");
            None
        }
        Some(field) => list(reader, &field, "[2, 4, 6]", |reader, field| {
            let value = reader.count(field)?;
            if (1..=16).contains(&value) {
                return Some(value);
            }
            reader.bad(field, format!("must lie between 1 and 16, found {value}"));
            None
        }),
    };
    let level = reader.get(&table, "level");
    let level = level.map_or(Some("moderate"), |field| {
        reader.choice(&field, &crate::keys::LEVELS, &[])
    });
    Some(ClassesSide {
        types: types?,
        storeys: storeys?,
        level: level?.to_owned(),
        path: table.path.clone(),
    })
}

/// Entries of a list that is not empty and repeats none.
fn list<'n, T: PartialEq>(
    reader: &mut Reader<'_>,
    field: &Field<'n>,
    example: &str,
    read: impl Fn(&mut Reader<'_>, &Field<'n>) -> Option<T>,
) -> Option<Vec<T>> {
    let Some(entries) = field.entries().filter(|entry| !entry.is_empty()) else {
        let found = field.node.describe();
        reader.bad(
            field,
            format!("expected a list such as {example}, found {found}"),
        );
        return None;
    };
    let read: Vec<Option<T>> = entries.iter().map(|entry| read(reader, entry)).collect();
    let all: Vec<T> = read.into_iter().collect::<Option<_>>()?;
    for (at, element) in all.iter().enumerate() {
        if all[..at].contains(element) {
            reader.bad(&entries[at], "stands in the list twice".to_owned());
            return None;
        }
    }
    Some(all)
}

/// Quantities ≥ 0 that rise, or the usual ones where the key is absent.
fn rising(
    reader: &mut Reader<'_>,
    view: Option<&View<'_>>,
    key: &'static str,
    dimension: Dimension,
    usual: &[f64],
) -> Option<Vec<f64>> {
    let Some(field) = view.and_then(|view| reader.get(view, key)) else {
        return Some(usual.to_vec());
    };
    let example = if dimension == Dimension::Length {
        "[\"10 mm\", \"50 mm\"]"
    } else {
        "[\"0.2 g\", \"0.4 g\"]"
    };
    let all = list(reader, &field, example, |reader, field| {
        reader.positive(field, dimension)
    })?;
    if all.windows(2).all(|pair| pair[0] < pair[1]) {
        return Some(all);
    }
    reader.bad(&field, "must rise from entry to entry".to_owned());
    None
}

/// Words of a list, or the usual ones where the key is absent.
fn words(
    reader: &mut Reader<'_>,
    view: Option<&View<'_>>,
    key: &'static str,
    known: &[&'static str],
    usual: &[&'static str],
) -> Option<Vec<&'static str>> {
    let Some(field) = view.and_then(|view| reader.get(view, key)) else {
        return Some(usual.to_vec());
    };
    let example = format!("[\"{}\"]", known.join("\", \""));
    list(reader, &field, &example, |reader, field| {
        reader.choice(field, known, &[])
    })
}

/// A quantity > 0, or the usual one where the key is absent.
fn positive(
    reader: &mut Reader<'_>,
    view: Option<&View<'_>>,
    key: &'static str,
    dimension: Dimension,
    usual: f64,
) -> Option<f64> {
    let field = view.and_then(|view| reader.get(view, key));
    field.map_or(Some(usual), |field| reader.positive(&field, dimension))
}

/// Keys that the reader asks for.
#[cfg(test)]
pub(crate) fn keys_asked(
    source: &Arc<Source>,
    root: &Node,
) -> std::collections::BTreeSet<(Section, &'static str)> {
    let mut reader = Reader::new(source);
    let origin = Origin {
        source: Arc::clone(source),
        root: root.clone(),
    };
    let _ = read_root(
        &mut reader,
        root,
        &Files::beside(Path::new("")),
        Path::new(""),
        origin,
    );
    reader.asked
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<ClassesFile, InputError> {
        ClassesFile::parse("classes.toml", text, Format::Toml, Path::new(""))
    }

    #[test]
    fn a_classes_file_has_its_defaults() {
        let file = parse(
            "[class]\ntypes = [\"C1\"]\nstoreys = [3]\n[motion]\nrecord = \"el-centro-1940-ns\"\n",
        )
        .expect("classes");
        assert_eq!(file.neighbour, file.class);
        assert_eq!(file.gaps, [0.01, 0.05]);
        assert_eq!(file.half_storey_up, [false]);
        assert_eq!(file.in_the_middle, [false]);
        assert_eq!((file.measure, file.levels.len()), (ClassesMeasure::Pga, 0));
    }

    #[test]
    fn faults_stand_at_their_lines_with_a_remedy() {
        let text = "[class]\ntypes = \"C1\"\nstoreys = [0]\nlevel = \"hihg\"\n[pair]\ngaps = [\"5 mm\", \"2 mm\"]\n\
                    alignment = [\"half\"]\narea = \"20 s\"\n[intensity]\nmeasure = \"PGV\"\n[run]\ndraw = 3\n";
        let error = parse(text).expect_err("faults").to_string();
        for wanted in [
            "classes.toml:2",
            "expected a list such as [\"C1\", \"URM\"]",
            "classes.toml:3",
            "between 1 and 16",
            "did you mean \"high\"",
            "must rise",
            "half-storey",
            "classes.toml:8",
            "AvgSA",
            "did you mean \"draws\"",
            "add [motion]",
        ] {
            assert!(error.contains(wanted), "{wanted}: {error}");
        }
    }
}
