//! Maps of comparisons: which columns of measurements belong to which results of a model.

use std::path::Path;
use std::sync::Arc;

use crate::fault::InputError;
use crate::keys::Section;
use crate::model_file;
use crate::origin::Origin;
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};
use crate::source::{Source, Span};
use crate::tree::{self, Format, Value};

/// Which measurements are compared with what.
#[derive(Clone, Debug)]
pub struct ComparisonMap {
    /// The motion of the table.
    pub table: TableMotion,
    /// Whether the sign of the table motion is changed.
    pub reverse: bool,
    /// Corner frequency of the low-pass of the table motion \[Hz\].
    pub low_pass: Option<f64>,
    /// Instant of the data at which the run begins \[s\].
    pub start: Option<f64>,
    /// Instant of the data at which it ends \[s\].
    pub end: Option<f64>,
    /// Histories to compare.
    pub columns: Vec<ComparedColumn>,
    /// Impacts to compare.
    pub impacts: Vec<ComparedImpacts>,
    origin: Origin,
}

/// How the motion of the table was measured.
#[derive(Clone, Debug, PartialEq)]
pub enum TableMotion {
    /// By its acceleration.
    Acceleration(NamedColumn),
    /// By its displacement.
    Displacement(NamedColumn),
}

/// The name of a column, and where it stands in the map.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedColumn {
    /// Name, or number from 1 after the times.
    pub name: String,
    path: String,
    span: Span,
}

/// One measured history and its computed counterpart.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparedColumn {
    /// The column of the data.
    pub measured: NamedColumn,
    /// The column of `history.parquet`.
    pub computed: NamedColumn,
    /// A column of the data that is subtracted, such as the displacement of the table.
    pub relative_to: Option<NamedColumn>,
    /// Whether the sign of the measured values is changed.
    pub reverse: bool,
    /// The mean of the measured values over this time from the first instant of the data on is subtracted \[s\].
    pub zero: Option<f64>,
}

/// How impacts show in the data.
#[derive(Clone, Debug, PartialEq)]
pub enum ImpactSign {
    /// The magnitude of an acceleration rises above this value \[m/s²\].
    Acceleration(NamedColumn, f64),
    /// The magnitude of the signal of a contact sensor rises above this value, in the unit of the file.
    Sensor(NamedColumn, f64),
    /// The left displacement less the right one rises above this width; `None` takes the gap of the model \[m\].
    Closing([NamedColumn; 2], Option<f64>),
}

/// Measured impacts and the contacts they are compared with.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparedImpacts {
    /// How they show.
    pub sign: ImpactSign,
    /// A gap such as `J1-J2`, or a contact such as `J1-J2.floor5-5`; `None` is all contacts.
    pub contact: Option<NamedColumn>,
    /// Greatest distance of a matched pair, > 0 \[s\].
    pub window: f64,
    /// Measured signs that follow each other sooner are one impact, ≥ 0 \[s\].
    pub separation: f64,
    /// The mean of the measured values over this time from the first instant of the data on is subtracted \[s\].
    pub zero: Option<f64>,
}

/// Usual greatest distance of matched impacts \[s\].
const WINDOW: f64 = 0.02;
/// Usual least distance of measured impacts \[s\].
const SEPARATION: f64 = 0.05;

impl ComparisonMap {
    /// Reads the map at a path: JSON if its name ends in `.json`, else TOML.
    ///
    /// # Errors
    /// All faults at once, with their lines.
    pub fn load(path: &Path) -> Result<Self, InputError> {
        let (name, text) = model_file::read_text(path)?;
        Self::parse(&name, &text, Format::of_path(path))
    }

    /// Reads the text of a map. `name` stands in messages.
    ///
    /// # Errors
    /// All faults at once, with their lines.
    pub fn parse(name: &str, text: &str, format: Format) -> Result<Self, InputError> {
        let text = tree::decode(name, text.as_bytes())?;
        let source = Arc::new(Source::new(name, text));
        let root = tree::parse(&source, format)?;
        let origin = Origin { source, root };
        let mut reader = Reader::new(&origin.source);
        let read = read_root(&mut reader, &origin);
        let error = reader.into_error();
        match read {
            Some(map) if error.faults.is_empty() => Ok(map),
            _ => Err(error),
        }
    }

    /// A fault of a name in the map, at its line.
    #[must_use]
    pub fn fault(&self, at: &NamedColumn, problem: impl Into<String>) -> InputError {
        self.origin.fault(&at.path, problem)
    }

    /// A fault of a key of the map, such as `low_pass`, at its line.
    #[must_use]
    pub fn fault_at(&self, path: &str, problem: impl Into<String>) -> InputError {
        self.origin.fault(path, problem)
    }
}

fn read_root(reader: &mut Reader<'_>, origin: &Origin) -> Option<ComparisonMap> {
    let view = reader.open(&Field::root(&origin.root), &[Section::Comparison])?;
    let acceleration = named(reader, &view, "table_acceleration");
    let displacement = named(reader, &view, "table_displacement");
    let table = match (acceleration, displacement) {
        (Some(column), None) => Some(TableMotion::Acceleration(column)),
        (None, Some(column)) => Some(TableMotion::Displacement(column)),
        (Some(_), Some(second)) => {
            let problem = "cannot be combined with table_acceleration";
            *reader.fault(&second.span, second.path, problem) = Some("keep one of them".into());
            None
        }
        (None, None) if view.has("table_acceleration") || view.has("table_displacement") => None,
        (None, None) => {
            reader.missing(
                &view,
                "table_acceleration",
                "name the column of the table's acceleration, table_acceleration = \"A1\", or that of its displacement, table_displacement = \"D1\"",
            );
            None
        }
    };
    let columns = tables(reader, &view, "column", compared_column);
    let impacts = tables(reader, &view, "impacts", compared_impacts);
    if columns.as_ref().is_some_and(Vec::is_empty) && impacts.as_ref().is_some_and(Vec::is_empty) {
        reader.missing(
            &view,
            "column",
            "add [[column]] with measured = \"D2\" and computed = \"J1.floor1.displacement_m\"",
        );
    }
    let start = time(reader, &view, "start");
    let end = time(reader, &view, "end");
    if let (Some(start), Some(end)) = (start, end)
        && end <= start
        && let Some(field) = reader.get(&view, "end")
    {
        reader.bad(
            &field,
            format!("{end} s does not come after start, {start} s"),
        );
    }
    Some(ComparisonMap {
        table: table?,
        reverse: flag(reader, &view, "reverse"),
        low_pass: match reader.get(&view, "low_pass") {
            Some(field) => reader.positive(&field, Dimension::Frequency),
            None => None,
        },
        start,
        end,
        columns: columns?,
        impacts: impacts?,
        origin: origin.clone(),
    })
}

fn compared_column(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<ComparedColumn> {
    let view = reader.open(field, &[Section::ComparedColumn])?;
    let measured = needed(reader, &view, "measured", "measured = \"D2\"");
    let computed = needed(
        reader,
        &view,
        "computed",
        "computed = \"J1.floor1.displacement_m\"",
    );
    Some(ComparedColumn {
        relative_to: named(reader, &view, "relative_to"),
        reverse: flag(reader, &view, "reverse"),
        zero: span_of_time(reader, &view, "zero"),
        measured: measured?,
        computed: computed?,
    })
}

fn compared_impacts(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<ComparedImpacts> {
    let view = reader.open(field, &[Section::ComparedImpacts])?;
    let before = reader.count_faults();
    let acceleration = named(reader, &view, "acceleration");
    let sensor = named(reader, &view, "sensor");
    let closing = match reader.get(&view, "closing") {
        Some(field) => pair(reader, &field),
        None => None,
    };
    let level = match reader.get(&view, "level") {
        Some(field) => reader.positive(&field, Dimension::Dimensionless),
        None => None,
    };
    let above = match reader.get(&view, "above") {
        Some(field) => reader.positive(&field, Dimension::Acceleration),
        None => None,
    };
    let width = match reader.get(&view, "width") {
        Some(field) => reader.quantity(&field, Dimension::Length),
        None => None,
    };
    let sign = match (acceleration, sensor, closing) {
        (Some(column), None, None) => match above {
            Some(above) => Some(ImpactSign::Acceleration(column, above)),
            None => {
                need(
                    reader,
                    &view,
                    before,
                    "above",
                    "state the acceleration above which there is an impact: above = \"2 g\"",
                );
                None
            }
        },
        (None, Some(column), None) => match level {
            Some(level) => Some(ImpactSign::Sensor(column, level)),
            None => {
                need(
                    reader,
                    &view,
                    before,
                    "level",
                    "state the value above which there is contact, in the unit of the file: level = 2.5",
                );
                None
            }
        },
        (None, None, Some(columns)) => Some(ImpactSign::Closing(columns, width)),
        (None, None, None) => {
            need(
                reader,
                &view,
                before,
                "acceleration",
                "say how impacts show: acceleration = \"A2\" with above = \"2 g\", sensor = \"C1\" with level = 2.5, or closing = [\"D1\", \"D2\"]",
            );
            None
        }
        _ => {
            let problem = "acceleration, sensor and closing exclude each other";
            *reader.bad(field, problem) = Some("keep one of them".into());
            None
        }
    };
    let window = match reader.get(&view, "window") {
        Some(field) => reader.positive(&field, Dimension::Time),
        None => Some(WINDOW),
    };
    let separation = match reader.get(&view, "separation") {
        Some(_) => span_of_time(reader, &view, "separation"),
        None => Some(SEPARATION),
    };
    Some(ComparedImpacts {
        contact: named(reader, &view, "contact"),
        zero: span_of_time(reader, &view, "zero"),
        sign: sign?,
        window: window?,
        separation: separation?,
    })
}

/// Notes that a key is missing, unless faults of the same table explain it.
fn need(reader: &mut Reader<'_>, view: &View<'_>, before: usize, key: &str, remedy: &str) {
    if reader.count_faults() == before {
        reader.missing(view, key, remedy);
    }
}

fn needed(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    key: &'static str,
    example: &str,
) -> Option<NamedColumn> {
    if !view.has(key) {
        reader.missing(view, key, format!("add {example}"));
    }
    named(reader, view, key)
}

fn named(reader: &mut Reader<'_>, view: &View<'_>, key: &'static str) -> Option<NamedColumn> {
    let field = reader.get(view, key)?;
    column(reader, &field)
}

/// A name, or a number of a column.
fn column(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<NamedColumn> {
    let name = match &field.node.value {
        Value::Integer(number) => number.to_string(),
        _ => reader.text(field)?,
    };
    Some(NamedColumn {
        name,
        path: field.path.clone(),
        span: field.node.span.clone(),
    })
}

fn pair(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<[NamedColumn; 2]> {
    let entries = field.entries().unwrap_or_default();
    if let [left, right] = &entries[..] {
        let (left, right) = (column(reader, left), column(reader, right));
        return Some([left?, right?]);
    }
    let found = field.node.describe();
    reader.bad(
        field,
        format!("expected the displacements left and right of the gap, such as [\"D1\", \"D2\"], found {found}"),
    );
    None
}

fn flag(reader: &mut Reader<'_>, view: &View<'_>, key: &'static str) -> bool {
    let field = reader.get(view, key);
    field.is_some_and(|field| reader.flag(&field) == Some(true))
}

/// An instant.
fn time(reader: &mut Reader<'_>, view: &View<'_>, key: &'static str) -> Option<f64> {
    let field = reader.get(view, key)?;
    reader.quantity(&field, Dimension::Time)
}

/// A length of time, zero or more.
fn span_of_time(reader: &mut Reader<'_>, view: &View<'_>, key: &'static str) -> Option<f64> {
    let field = reader.get(view, key)?;
    let value = reader.quantity(&field, Dimension::Time)?;
    if value < 0.0 {
        reader.bad(&field, format!("must not be negative, found {value} s"));
        return None;
    }
    Some(value)
}

/// A list of tables, or one; `None` if one of them has faults.
fn tables<T>(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    key: &'static str,
    read: fn(&mut Reader<'_>, &Field<'_>) -> Option<T>,
) -> Option<Vec<T>> {
    let Some(field) = reader.get(view, key) else {
        return Some(Vec::new());
    };
    let entries = field.entries().unwrap_or_else(|| vec![field]);
    let read: Vec<Option<T>> = entries.iter().map(|entry| read(reader, entry)).collect();
    read.into_iter().collect()
}

/// The keys that reading a map asks for.
#[cfg(test)]
pub(crate) fn keys_asked(
    source: &Source,
    root: &tree::Node,
) -> std::collections::BTreeSet<(Section, &'static str)> {
    let source = Arc::new(source.clone());
    let root = root.clone();
    let origin = Origin { source, root };
    let mut reader = Reader::new(&origin.source);
    let _ = read_root(&mut reader, &origin);
    reader.asked
}
