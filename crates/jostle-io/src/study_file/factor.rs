//! `[[vary]]` of a study file: what varies, and through which values.

use std::path::Path;
use std::sync::Arc;

use super::distribution::{self, Distribution};
use super::table::{InputTable, TableColumn};
use crate::builtin;
use crate::keys::{KEYS, Kind, SPACINGS, Section};
use crate::model_tree::{ModelTree, TreeValue, quantity_text};
use crate::quantity::{Dimension, check_magnitude, split_number, unit_size};
use crate::reader::{Field, Reader, View};
use crate::source::Span;
use crate::tree::{Node, Value};
use crate::unit::Unit;

/// Something that varies.
#[derive(Clone, Debug)]
pub struct Factor {
    /// Name, unique in the study.
    pub name: String,
    /// Where its value goes in the model file; at least one path.
    pub paths: Vec<String>,
    /// Whether the value multiplies the value of the model instead of replacing it.
    pub multiplies: bool,
    /// Its values.
    pub values: FactorValues,
    /// Unit of numbers as the end of a column name: `m`, `m_s2`, or empty.
    pub unit: String,
    /// Whether it is the list of records of the base model, and not an entry of the study file.
    pub from_model: bool,
    /// Number of its `[[vary]]`; the columns of a table share one.
    pub entry: usize,
    pub(crate) span: Span,
}

impl Factor {
    /// Whether it is the angle of the motion in plan, in numbers.
    #[must_use]
    pub fn is_angle(&self) -> bool {
        let is_numeric = match &self.values {
            FactorValues::Listed(levels) => levels.iter().all(|level| level.number.is_some()),
            FactorValues::Drawn(_) => true,
            FactorValues::Table(column) => column.is_numeric,
        };
        is_numeric && !self.multiplies && self.paths.iter().any(|path| path == ANGLE)
    }

    /// Whether its values decide which motion a case has.
    pub(super) fn chooses_motion(&self) -> bool {
        let mut paths = self.paths.iter();
        paths.any(|path| matches!(&path[..], "motion" | RECORD | "motion.kind"))
    }
}

/// Values of a factor.
#[derive(Clone, Debug, PartialEq)]
pub enum FactorValues {
    /// One after the other; at least one.
    Listed(Vec<Level>),
    /// Drawn from a distribution.
    Drawn(Distribution),
    /// The rows of a table; those of all its columns go together.
    Table(TableColumn),
}

impl FactorValues {
    /// Number of values; `None` if they are drawn.
    #[must_use]
    pub fn count(&self) -> Option<usize> {
        match self {
            Self::Listed(levels) => Some(levels.len()),
            Self::Drawn(_) => None,
            Self::Table(column) => usize::try_from(column.table.rows()).ok(),
        }
    }
}

/// One value of a factor.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Value for the model.
    pub value: TreeValue,
    /// The same as it was written, for tables.
    pub label: String,
    /// Its number in SI, if it is one.
    pub number: Option<f64>,
}

/// A number and its unit.
pub(super) struct Measured {
    pub(super) number: f64,
    pub(super) unit: String,
    /// Size of the unit in SI.
    pub(super) size: f64,
}

/// Path of the angle of the motion of a model.
const ANGLE: &str = "motion.angle";
/// Path of the record of a model.
const RECORD: &str = "motion.record";

/// Most values of a list.
const MOST_LEVELS: usize = 1_000_000;

pub(super) fn read_all(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    folder: &Path,
) -> Option<Vec<Factor>> {
    let Some(entries) = field.entries().filter(|entries| !entries.is_empty()) else {
        *reader.bad(field, "expected at least one [[vary]]") =
            Some("write [[vary]] with two pairs of brackets".into());
        return None;
    };
    let mut factors: Vec<Factor> = Vec::new();
    let mut whole = true;
    for (index, entry) in entries.iter().enumerate() {
        let Some(found) = read(reader, entry, index, folder) else {
            whole = false;
            continue;
        };
        for factor in found {
            if factors.iter().any(|known| known.name == factor.name) {
                let problem = format!("a second factor is named \"{}\"", factor.name);
                *reader.bad(entry, problem) = Some("give one of them another name = \"…\"".into());
                whole = false;
                continue;
            }
            factors.push(factor);
        }
    }
    whole.then_some(factors)
}

/// The factors of a table, one for each of its columns.
fn read_table(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    field: &Field<'_>,
    entry: usize,
    folder: &Path,
) -> Option<Vec<Factor>> {
    for key in [
        "path",
        "name",
        "multiply",
        "values",
        "range",
        "distribution",
        "files",
    ] {
        if let Some(other) = reader.get(view, key) {
            *reader.bad(&other, "cannot be combined with table") =
                Some("the columns of the table are named as the keys of the model".into());
            return None;
        }
    }
    let name = reader.text(field)?;
    let table = match InputTable::open(&folder.join(&name)) {
        Ok(table) => Arc::new(table),
        Err(problem) => {
            *reader.bad(field, format!("{name}: {problem}")) = Some(
                "a table is a CSV file, or a Parquet file without compression or with LZ4 or Snappy; its columns are named as the keys of the model, such as gap[0].width".into(),
            );
            return None;
        }
    };
    let wanted = match reader.get(view, "columns") {
        Some(columns) => {
            let wanted = super::wanted::texts(reader, &columns)?;
            if let Some(missing) = wanted.iter().find(|wanted| !table.names().contains(wanted)) {
                let problem = format!(
                    "{name} has no column \"{missing}\"; it has {}",
                    table.names().join(", ")
                );
                reader.bad(&columns, problem);
                return None;
            }
            wanted
        }
        None => table.names().to_vec(),
    };
    let mut factors = Vec::new();
    for path in wanted {
        let column = table.names().iter().position(|name| *name == path)?;
        let dimension = dimension_of(&path);
        let is_numeric = match table.is_numeric(column, dimension) {
            Ok(is_numeric) => is_numeric,
            Err(problem) => {
                reader.bad(field, problem);
                return None;
            }
        };
        let values = FactorValues::Table(TableColumn {
            table: Arc::clone(&table),
            column,
            is_numeric,
            dimension,
        });
        factors.push(Factor {
            unit: if is_numeric {
                unit_suffix(&values, dimension)
            } else {
                String::new()
            },
            name: path.clone(),
            paths: vec![path],
            multiplies: false,
            values,
            from_model: false,
            entry,
            span: field.node.span.clone(),
        });
    }
    Some(factors)
}

fn read(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    entry: usize,
    folder: &Path,
) -> Option<Vec<Factor>> {
    let view = reader.open(field, &[Section::Vary])?;
    if let Some(field) = reader.get(&view, "table") {
        return read_table(reader, &view, &field, entry, folder);
    }
    if let Some(field) = reader.get(&view, "columns") {
        *reader.bad(&field, "goes with table only") = Some("remove it".into());
        return None;
    }
    let paths = match reader.get(&view, "path") {
        Some(field) if field.entries().is_some() => super::wanted::texts(reader, &field)?,
        Some(field) => vec![reader.text(&field)?],
        None => {
            reader.missing(
                &view,
                "path",
                "say where the value goes in the model file: path = \"gap[0].width\"",
            );
            return None;
        }
    };
    let Some(first) = paths.first().cloned() else {
        let field = reader.get(&view, "path")?;
        reader.bad(&field, "must not be empty");
        return None;
    };
    let name = match reader.get(&view, "name") {
        Some(field) => reader.text(&field)?,
        None => first.clone(),
    };
    let multiplies = match reader.get(&view, "multiply") {
        Some(field) => reader.flag(&field)?,
        None => false,
    };
    let dimension = if multiplies {
        Some(Dimension::Dimensionless)
    } else {
        dimension_of(&first)
    };
    let (values, at) = values(reader, &view, dimension, &first, folder)?;
    let mut values = values;
    if let FactorValues::Listed(levels) = &values {
        if levels.is_empty() {
            reader.fault(&at, view.path.clone(), "has no values");
            return None;
        }
        if multiplies && levels.iter().any(|level| level.number.is_none()) {
            reader.fault(&at, view.path.clone(), "multiply needs numbers");
            return None;
        }
    }
    if first.ends_with("record")
        && let FactorValues::Listed(levels) = &mut values
    {
        levels
            .iter_mut()
            .for_each(|level| find_record(level, folder));
    }
    let unit = unit_suffix(&values, dimension);
    Some(vec![Factor {
        name,
        paths,
        multiplies,
        values,
        unit,
        from_model: false,
        entry,
        span: at,
    }])
}

/// The records that a model lists, as a factor; `None` unless there are several.
pub(super) fn of_records(model: &ModelTree) -> Option<Factor> {
    let records = model.records();
    if records.len() < 2 {
        return None;
    }
    let level = |name: String| Level {
        label: name.clone(),
        value: TreeValue::Text(name),
        number: None,
    };
    Some(Factor {
        name: RECORD.to_owned(),
        paths: vec![RECORD.to_owned()],
        multiplies: false,
        values: FactorValues::Listed(records.into_iter().map(level).collect()),
        unit: String::new(),
        from_model: true,
        entry: usize::MAX,
        span: 0..0,
    })
}

/// Paths of records are relative to the study.
fn find_record(level: &mut Level, folder: &Path) {
    if let TreeValue::Text(name) = &mut level.value {
        let path = folder.join(name.as_str());
        if builtin::builtin_record(name).is_none()
            && path.is_file()
            && let Ok(absolute) = std::path::absolute(&path)
        {
            *name = absolute.to_string_lossy().into_owned();
        }
    }
}

/// The values and where they stand.
fn values(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    dimension: Option<Dimension>,
    path: &str,
    folder: &Path,
) -> Option<(FactorValues, Span)> {
    let given = ["values", "range", "distribution", "files"].map(|key| reader.get(view, key));
    let mut present = given.iter().flatten();
    let Some(field) = present.next() else {
        reader.missing(
            view,
            "values",
            "add values = […], range = { from, to, count }, distribution = { … } or files = \"records/*.at2\"",
        );
        return None;
    };
    if let Some(second) = present.next() {
        let problem = format!("cannot be combined with {}", field.path);
        *reader.bad(second, problem) = Some("keep one of them".into());
        return None;
    }
    let at = field.node.span.clone();
    let [list, range_field, drawn, files] = &given;
    let values = if let Some(field) = list {
        FactorValues::Listed(listed(reader, field, dimension)?)
    } else if let Some(field) = range_field {
        FactorValues::Listed(range(reader, field, dimension)?)
    } else if let Some(field) = drawn {
        FactorValues::Drawn(distribution::read(reader, field, dimension)?)
    } else {
        let field = files.as_ref()?;
        if !path.ends_with("record") {
            *reader.bad(field, "goes with records only") =
                Some("use values, or path = \"motion.record\"".into());
            return None;
        }
        FactorValues::Listed(files_of(reader, field, folder)?)
    };
    Some((values, at))
}

fn listed(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    dimension: Option<Dimension>,
) -> Option<Vec<Level>> {
    let Some(entries) = field.entries() else {
        let found = field.node.describe();
        *reader.bad(field, format!("expected a list, found {found}")) =
            Some("write values = [\"20 mm\", \"40 mm\"]".into());
        return None;
    };
    if entries.len() > MOST_LEVELS {
        reader.bad(field, format!("has more than {MOST_LEVELS} values"));
        return None;
    }
    let mut levels = Vec::new();
    for entry in &entries {
        let Some(value) = TreeValue::from_node(entry.node) else {
            let found = entry.node.describe();
            reader.bad(entry, format!("{found} has no place in a model"));
            return None;
        };
        levels.push(Level {
            label: value.to_string(),
            number: number_of(entry.node, dimension),
            value,
        });
    }
    Some(levels)
}

/// The number of a value in SI, if it is one.
fn number_of(node: &Node, dimension: Option<Dimension>) -> Option<f64> {
    match &node.value {
        Value::Integer(value) => Some(*value as f64),
        Value::Number(value) => Some(*value),
        Value::Text(text) => number_of_text(text, dimension),
        _ => None,
    }
}

/// The number of a text with a unit in SI, if it is one.
pub(super) fn number_of_text(text: &str, dimension: Option<Dimension>) -> Option<f64> {
    let (number, unit) = split_number(text)?;
    Some(number * size_of(unit, dimension)?)
}

fn size_of(unit: &str, dimension: Option<Dimension>) -> Option<f64> {
    if unit.trim().is_empty() {
        return Some(1.0);
    }
    match dimension {
        Some(dimension) => unit_size(unit, unit, dimension).ok(),
        None => Unit::parse(unit).ok().map(|unit| unit.factor),
    }
}

fn range(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    dimension: Option<Dimension>,
) -> Option<Vec<Level>> {
    let view = reader.open(field, &[Section::Range])?;
    let ends = ["from", "to"].map(|key| match reader.get(&view, key) {
        Some(field) => measure(reader, &field, dimension),
        None => {
            reader.missing(&view, key, format!("add {key}"));
            None
        }
    });
    let [from, to] = ends;
    let (from, to) = (from?, to?);
    if from.unit != to.unit {
        let problem = format!("from has the unit \"{}\", to \"{}\"", from.unit, to.unit);
        *reader.bad(field, problem) = Some("write both with one unit".into());
        return None;
    }
    let Some(count) = reader.get(&view, "count") else {
        reader.missing(&view, "count", "say how many values: count = 11");
        return None;
    };
    let number = reader.count(&count)?;
    if !(1..=MOST_LEVELS).contains(&number) {
        reader.bad(&count, format!("must lie between 1 and {MOST_LEVELS}"));
        return None;
    }
    let spacing = match reader.get(&view, "spacing") {
        Some(field) => reader.choice(&field, SPACINGS, &[])?,
        None => "linear",
    };
    if spacing == "log" && (from.number <= 0.0 || to.number <= 0.0) {
        reader.bad(field, "logarithmic spacing needs ends greater than zero");
        return None;
    }
    let last = number.saturating_sub(1).max(1) as f64;
    let at = |index: usize| {
        if index == 0 {
            return from.number;
        }
        if index + 1 == number {
            return to.number;
        }
        let share = index as f64;
        match spacing {
            "log" => from.number * libm::pow(to.number / from.number, share / last),
            _ => from.number + (to.number - from.number) * share / last,
        }
    };
    let level = |number: f64| {
        let value = if from.unit.is_empty() {
            TreeValue::Number(number)
        } else {
            TreeValue::Text(quantity_text(number, &from.unit))
        };
        Level {
            label: value.to_string(),
            value,
            number: Some(number * from.size),
        }
    };
    Some((0..number).map(|index| level(at(index))).collect())
}

/// A number with its unit.
pub(super) fn measure(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    dimension: Option<Dimension>,
) -> Option<Measured> {
    if let Some(dimension) = dimension {
        // Says what is wrong.
        reader.quantity(field, dimension)?;
    }
    let plain = |number: f64| Measured {
        number,
        unit: String::new(),
        size: 1.0,
    };
    let measured = match &field.node.value {
        Value::Integer(value) => Some(plain(*value as f64)),
        Value::Number(value) => Some(plain(*value)),
        Value::Text(text) => split_number(text).and_then(|(number, unit)| {
            Some(Measured {
                number,
                unit: unit.trim().to_owned(),
                size: size_of(unit, dimension)?,
            })
        }),
        _ => None,
    };
    let usable = |number: f64| check_magnitude(number, Dimension::Dimensionless).is_ok();
    let measured = measured.filter(|measured| usable(measured.number));
    if measured.is_none() {
        let found = field.node.describe();
        reader.bad(
            field,
            format!("expected a number, or one with a unit such as \"20 mm\", found {found}"),
        );
    }
    measured
}

/// Files of a folder whose names match a pattern, sorted.
fn files_of(reader: &mut Reader<'_>, field: &Field<'_>, folder: &Path) -> Option<Vec<Level>> {
    let pattern = reader.text(field)?;
    let path = folder.join(&pattern);
    let wanted = path.file_name().unwrap_or_default().to_string_lossy();
    let inside = path.parent().unwrap_or(Path::new(""));
    let look = if inside == Path::new("") {
        Path::new(".")
    } else {
        inside
    };
    let entries = match std::fs::read_dir(look) {
        Ok(entries) => entries,
        Err(error) => {
            reader.bad(field, format!("{}: {error}", look.display()));
            return None;
        }
    };
    let mut names: Vec<String> = entries
        .flatten()
        .filter(|entry| entry.path().is_file())
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .filter(|name| fits(name, &wanted))
        .collect();
    names.sort();
    if names.is_empty() {
        reader.bad(field, format!("no file fits {}", path.display()));
        return None;
    }
    let before = Path::new(&pattern).parent().unwrap_or(Path::new(""));
    let level = |name: String| {
        let path = before.join(name).to_string_lossy().into_owned();
        Level {
            value: TreeValue::Text(path.clone()),
            label: path,
            number: None,
        }
    };
    Some(names.into_iter().map(level).collect())
}

/// Whether a name matches a pattern in which `*` matches any text. What lies between two stars is taken at its first
/// place: any later one leaves less for the rest.
fn fits(name: &str, pattern: &str) -> bool {
    let mut pieces = pattern.split('*');
    let first = pieces.next().unwrap_or("");
    let Some(mut rest) = name.strip_prefix(first) else {
        return false;
    };
    let Some(last) = pieces.next_back() else {
        return rest.is_empty();
    };
    for piece in pieces {
        match rest.find(piece) {
            Some(at) => rest = &rest[at + piece.len()..],
            None => return false,
        }
    }
    rest.ends_with(last)
}

/// The dimension of the key that a path ends with, where the key has one everywhere.
fn dimension_of(path: &str) -> Option<Dimension> {
    let last = path.rsplit('.').next()?;
    let last = last.split('[').next()?;
    let study = [Section::Distribution, Section::Range, Section::Fragility];
    let mut found = KEYS
        .iter()
        .filter(|key| key.name == last && !study.contains(&key.section))
        .map(|key| match key.kind {
            Kind::Quantity(dimension)
            | Kind::PerStorey(dimension)
            | Kind::Quantities(dimension)
            | Kind::WordOr(_, dimension) => Some(dimension),
            _ => None,
        });
    let first = found.next()??;
    found.all(|other| other == Some(first)).then_some(first)
}

/// The SI unit of the numbers of a factor as the end of a column name.
fn unit_suffix(values: &FactorValues, dimension: Option<Dimension>) -> String {
    let spell = |dimension: Dimension| -> String {
        match dimension {
            Dimension::Dimensionless => String::new(),
            Dimension::Frequency => "per_s".into(),
            other => other
                .si_unit()
                .to_lowercase()
                .replace("^1.5", "1_5")
                .replace(['/', '.'], "_"),
        }
    };
    if let Some(dimension) = dimension {
        return spell(dimension);
    }
    let unit = match values {
        FactorValues::Drawn(distribution) => distribution.unit.clone(),
        FactorValues::Listed(levels) => match levels.first().map(|level| &level.value) {
            Some(TreeValue::Text(text)) => split_number(text)
                .map(|(_, unit)| unit.trim().to_owned())
                .unwrap_or_default(),
            _ => String::new(),
        },
        FactorValues::Table(column) => match column.level(0) {
            Ok(Some(Level { label, .. })) => split_number(&label)
                .map(|(_, unit)| unit.trim().to_owned())
                .unwrap_or_default(),
            _ => String::new(),
        },
    };
    let unit = Unit::parse(&unit).ok().filter(|_| !unit.is_empty());
    unit.and_then(|unit| {
        let mut all = Dimension::ALL.into_iter();
        all.find(|dimension| unit.has_dimension(dimension.exponents()))
    })
    .map(spell)
    .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_match_any_text_and_take_no_time() {
        for (name, pattern, expected) in [
            ("a.at2", "a.at2", true),
            ("a.at2", "*.at2", true),
            ("a.at2", "a*", true),
            ("a.at2", "*", true),
            ("ab.at2", "a*b*.at2", true),
            ("a.at2", "a.at2*.at2", false),
            ("a.at", "*.at2", false),
            ("aab", "a*ab", true),
            ("ab", "ab*b", false),
        ] {
            assert_eq!(fits(name, pattern), expected, "{name} {pattern}");
        }
        assert!(!fits(&"a".repeat(200), &("a*".repeat(100) + "b")));
        assert!(fits(&"a".repeat(200), &("*".repeat(60_000) + "a")));
    }
}
