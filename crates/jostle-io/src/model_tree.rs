//! A model file as a tree whose values can be changed before it is read: what studies vary.

use std::fmt;
use std::path::Path;
use std::sync::Arc;

use crate::builtin_model;
use crate::fault::InputError;
use crate::files::Files;
use crate::model_file::{self, Input};
use crate::quantity::split_number;
use crate::reader::join;
use crate::record_list;
use crate::shown::Units;
use crate::source::Source;
use crate::tree::{self, Entry, Format, Node, Table, Value};
use crate::unit::Unit;

/// A model file, parsed but not yet read. Values can be replaced by path; [`ModelTree::input`] then reads the
/// tree as if it had been written that way.
#[derive(Clone, Debug)]
pub struct ModelTree {
    source: Arc<Source>,
    pub(crate) root: Node,
    files: Files,
}

/// A value for a model file.
#[derive(Clone, Debug, PartialEq)]
pub enum TreeValue {
    /// Text, quantities with units included.
    Text(String),
    /// Whole number.
    Integer(i64),
    /// Number.
    Number(f64),
    /// True or false.
    Flag(bool),
    /// List.
    List(Vec<TreeValue>),
    /// Table, in order.
    Table(Vec<(String, TreeValue)>),
}

/// Why a value cannot be put where a path points.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{path}: {problem}")]
pub struct PathError {
    /// The path as asked for.
    pub path: String,
    /// The problem, and a valid alternative.
    pub problem: String,
}

impl PathError {
    /// A problem with a path.
    #[must_use]
    pub fn new(path: &str, problem: String) -> Self {
        Self {
            path: crate::quantity::shorten(path),
            problem,
        }
    }
}

/// One step of a path.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Part {
    /// A key of a table, or the `name` of an entry of a list.
    Key(String),
    Index(usize),
    /// Every entry, `[*]`.
    Every,
}

/// Operation on the value at the end of a path.
enum Change<'v> {
    Replace(&'v TreeValue),
    Multiply(f64),
}

/// Mutually exclusive keys: setting one removes the others.
pub(crate) const ALTERNATIVES: [(&str, &[&str]); 4] = [
    ("pga", &["scale", "match"]),
    ("scale", &["pga", "match"]),
    ("match", &["pga", "scale"]),
    ("record", &["kind", "amplitude", "period", "centre"]),
];

impl ModelTree {
    /// Parses the model file at a path. A name ending in `.json` is JSON, any other TOML.
    ///
    /// # Errors
    /// When the file cannot be read or is not TOML or JSON; its contents are checked by [`ModelTree::input`].
    pub fn load(path: &Path) -> Result<Self, InputError> {
        let (name, text) = model_file::read_text(path)?;
        let base = path.parent().unwrap_or(Path::new(""));
        Self::parse(&name, &text, Format::of_path(path), base)
    }

    /// Parses the text of a model file. `name` is used in messages; `base` is the folder of records.
    ///
    /// # Errors
    /// Syntax errors.
    pub fn parse(name: &str, text: &str, format: Format, base: &Path) -> Result<Self, InputError> {
        Self::parse_with(name, text, format, Files::beside(base))
    }

    /// The same for a model that may read these files only.
    ///
    /// # Errors
    /// Syntax errors.
    pub fn parse_with(
        name: &str,
        text: &str,
        format: Format,
        files: Files,
    ) -> Result<Self, InputError> {
        let source = Source::new(name, tree::decode(name, text.as_bytes())?);
        let root = tree::parse(&source, format)?;
        Ok(Self::new(Arc::new(source), root, files))
    }

    /// The model file at a path, or the built-in model of that name.
    ///
    /// # Errors
    /// As [`ModelTree::load`].
    pub fn find(path: &Path) -> Result<Self, InputError> {
        // A folder, say of earlier results, may have the name of a built-in model.
        let name = path.to_str().filter(|_| !path.exists() || path.is_dir());
        match name.filter(|name| builtin_model::model_names().contains(name)) {
            Some(name) => Self::builtin(name),
            None => Self::load(path),
        }
    }

    /// A built-in model.
    ///
    /// # Errors
    /// If the name is unknown.
    pub fn builtin(name: &str) -> Result<Self, InputError> {
        // Says which names there are.
        builtin_model(name)?;
        let text = builtin_model::model_text(name).unwrap_or_default();
        Self::parse(name, text, Format::Toml, Path::new(""))
    }

    pub(crate) fn new(source: Arc<Source>, root: Node, files: Files) -> Self {
        Self {
            source,
            root,
            files,
        }
    }

    /// Whether the tree is a part of this text.
    pub(crate) fn is_of(&self, source: &Arc<Source>) -> bool {
        Arc::ptr_eq(&self.source, source)
    }

    /// The text that was parsed.
    #[must_use]
    pub fn text(&self) -> &str {
        self.source.text()
    }

    /// Name of the file.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.source.name
    }

    /// The folder from where records are looked for.
    #[must_use]
    pub fn base(&self) -> &Path {
        self.files.folder()
    }

    /// What the model may read, and what it asked for so far.
    #[must_use]
    pub fn files(&self) -> &Files {
        &self.files
    }

    /// Names of the files that the model names, as written, whether they are there or not: the model is read, with its
    /// ground motion and with every record that it lists.
    #[must_use]
    pub fn named_files(&self) -> Vec<String> {
        let mut tree = self.clone();
        tree.files = self.files.afresh();
        for record in 0..self.records().len().max(1) {
            let mut one = tree.clone();
            one.keep_record(record);
            // Faults are reported where the model is run; the report has what was asked for until then.
            let _ = one.input().and_then(|input| input.ground_motion());
        }
        tree.files.asked()
    }

    /// Puts a value in at a path such as `gap[0].width`, `gap[*].width`, `building.J1.column.depth` or
    /// `motion.pga`. Tables that are absent are made.
    ///
    /// A way of scaling the motion (`pga`, `scale`, `match`) takes the place of the one in the file, a record
    /// that of an analytic wave.
    ///
    /// # Errors
    /// [`PathError`] when the path leads nowhere; then nothing is changed.
    pub fn set(&mut self, path: &str, value: &TreeValue) -> Result<(), PathError> {
        self.change(path, &Change::Replace(value))
    }

    /// Multiplies the number, the quantity or the list of such at a path.
    ///
    /// # Errors
    /// [`PathError`] when there is nothing, or no number.
    pub fn multiply(&mut self, path: &str, factor: f64) -> Result<(), PathError> {
        self.change(path, &Change::Multiply(factor))
    }

    /// The values at a path, in the order of the file: several if the path contains `[*]`, none if there is no
    /// value.
    #[must_use]
    pub fn values(&self, path: &str) -> Vec<TreeValue> {
        let mut found = Vec::new();
        if let Ok(parts) = parts(path) {
            collect(&self.root, &parts, &mut found);
        }
        found
    }

    /// The one number or quantity at a path, in SI; `None` where there is none, a list, or several.
    #[must_use]
    pub fn number(&self, path: &str) -> Option<f64> {
        match &self.values(path)[..] {
            [TreeValue::Integer(integer)] => Some(*integer as f64),
            [TreeValue::Number(number)] => Some(*number),
            [TreeValue::Text(text)] => {
                let (number, unit) = split_number(text)?;
                Some(number * Unit::parse(unit).ok()?.factor)
            }
            _ => None,
        }
    }

    /// The records that the file lists for a run to choose from; empty if it names one, or none.
    #[must_use]
    pub fn records(&self) -> Vec<String> {
        record_list::listed(&self.root)
    }

    /// Keeps one record of the list, by its position.
    pub fn keep_record(&mut self, index: usize) {
        record_list::keep(&mut self.root, index);
    }

    fn change(&mut self, path: &str, change: &Change<'_>) -> Result<(), PathError> {
        // A record out of the list of the model comes with its components across and vertical.
        if let ("motion.record", Change::Replace(TreeValue::Text(name))) = (path, change)
            && let Some(index) = self.records().iter().position(|record| record == name)
        {
            self.keep_record(index);
            return Ok(());
        }
        let wrong = |problem: String| PathError::new(path, problem);
        let parts = parts(path).map_err(wrong)?;
        let mut root = self.root.clone();
        apply_at(&mut root, &parts, "", change).map_err(wrong)?;
        self.root = root;
        Ok(())
    }

    /// The system of units that the model asks for in texts and pages.
    #[must_use]
    pub fn units(&self) -> Option<Units> {
        match self.values("output.units").into_iter().next()? {
            TreeValue::Text(name) => Units::named(&name),
            _ => None,
        }
    }

    /// Reads and checks the tree.
    ///
    /// # Errors
    /// All faults at once. A value that was set has no line.
    pub fn input(&self) -> Result<Input, InputError> {
        model_file::read_tree(Arc::clone(&self.source), self.root.clone(), &self.files)
    }
}

/// Most steps of a path. What follows a path calls itself once a step; no key of a model takes a tenth of that.
const MOST_PARTS: usize = 64;

/// The steps of a path.
pub(crate) fn parts(path: &str) -> Result<Vec<Part>, String> {
    const EXAMPLE: &str = "write it like gap[0].width, gap[*].width or building.J1.damping.ratio";
    if path.split(['.', '[']).nth(MOST_PARTS).is_some() {
        return Err(format!("has more than {MOST_PARTS} parts; {EXAMPLE}"));
    }
    let mut parts = Vec::new();
    for piece in path.split('.') {
        let (key, indices) = match piece.find('[') {
            Some(at) => piece.split_at(at),
            None => (piece, ""),
        };
        if key.trim().is_empty() {
            return Err(format!("is not a path; {EXAMPLE}"));
        }
        parts.push(Part::Key(key.trim().to_owned()));
        let mut rest = indices;
        while !rest.is_empty() {
            let inside = rest.strip_prefix('[').and_then(|rest| rest.split_once(']'));
            let Some((index, after)) = inside else {
                return Err(format!("has unpaired brackets; {EXAMPLE}"));
            };
            parts.push(match index.trim() {
                "*" => Part::Every,
                index => Part::Index(
                    index
                        .parse()
                        .map_err(|_| format!("\"[{index}]\" is no index; {EXAMPLE}"))?,
                ),
            });
            rest = after;
        }
    }
    Ok(parts)
}

/// Tables of a model that stand in lists.
const LISTS: [&str; 4] = ["building", "gap", "link", "wall"];

fn apply_at(node: &mut Node, parts: &[Part], at: &str, change: &Change<'_>) -> Result<(), String> {
    let Some((part, rest)) = parts.split_first() else {
        return match change {
            Change::Replace(value) => {
                *node = value.node();
                Ok(())
            }
            Change::Multiply(factor) => multiply(node, *factor),
        };
    };
    let here = if at.is_empty() { "the model" } else { at };
    match (part, &mut node.value) {
        (Part::Key(key), Value::Table(table)) => {
            if at == "motion" {
                let others = ALTERNATIVES.iter().find(|(name, _)| name == key);
                let others = others.map_or(&[][..], |(_, others)| others);
                table
                    .entries
                    .retain(|entry| !others.contains(&entry.key.as_str()));
            }
            let known = table.entries.iter().position(|entry| entry.key == *key);
            let index = match (known, change) {
                (Some(index), _) => index,
                (None, Change::Multiply(_)) => {
                    return Err(format!("{here} has no {key} to multiply"));
                }
                (None, Change::Replace(_)) => {
                    if matches!(rest.first(), Some(Part::Index(_) | Part::Every)) {
                        return Err(format!("{here} has no {key}"));
                    }
                    if at.is_empty() && LISTS.contains(&key.as_str()) && !rest.is_empty() {
                        return Err(format!(
                            "{here} has no [[{key}]]; write one in the model file first"
                        ));
                    }
                    table.entries.push(Entry {
                        key: key.clone(),
                        key_span: 0..0,
                        node: Node {
                            span: 0..0,
                            value: Value::Table(Table::default()),
                        },
                    });
                    table.entries.len() - 1
                }
            };
            apply_at(&mut table.entries[index].node, rest, &join(at, key), change)
        }
        (Part::Key(key), Value::List(list)) => {
            let names: Vec<String> = list.iter().map(name_of).collect();
            match names.iter().position(|name| name == key) {
                Some(index) => apply_at(&mut list[index], rest, &join(at, key), change),
                None => Err(format!(
                    "{here} is a list without an entry named \"{key}\"; say which one, such as {here}[0], or {here}[*] for all"
                )),
            }
        }
        (Part::Index(index), Value::List(list)) => {
            let count = list.len();
            match list.get_mut(*index) {
                Some(entry) => apply_at(entry, rest, &format!("{at}[{index}]"), change),
                None => Err(format!(
                    "{here} has {count} entr{}, counted from 0; there is no [{index}]",
                    if count == 1 { "y" } else { "ies" }
                )),
            }
        }
        (Part::Every, Value::List(list)) => {
            if list.is_empty() {
                return Err(format!("{here} is empty"));
            }
            for (index, entry) in list.iter_mut().enumerate() {
                apply_at(entry, rest, &format!("{at}[{index}]"), change)?;
            }
            Ok(())
        }
        (Part::Index(_) | Part::Every, _) => Err(format!("{here} is not a list")),
        (Part::Key(key), _) => Err(format!(
            "{here} is a single value and has no {key}; write a table in the model file first"
        )),
    }
}

/// Adds the values at a path below a node.
fn collect(node: &Node, parts: &[Part], into: &mut Vec<TreeValue>) {
    let Some((part, rest)) = parts.split_first() else {
        into.extend(TreeValue::from_node(node));
        return;
    };
    let below: Vec<&Node> = match (part, &node.value) {
        (Part::Key(key), Value::Table(table)) => table.get(key).into_iter().collect(),
        (Part::Key(key), Value::List(list)) => {
            let named = list.iter().find(|entry| name_of(entry) == *key);
            named.into_iter().collect()
        }
        (Part::Index(index), Value::List(list)) => list.get(*index).into_iter().collect(),
        (Part::Every, Value::List(list)) => list.iter().collect(),
        _ => Vec::new(),
    };
    for node in below {
        collect(node, rest, into);
    }
}

/// The name by which an entry of a list can be called: its `name`, or for a gap its neighbours.
pub(crate) fn name_of(node: &Node) -> String {
    let Value::Table(table) = &node.value else {
        return String::new();
    };
    let text = |node: &Node| match &node.value {
        Value::Text(text) => text.clone(),
        _ => String::new(),
    };
    if let Some(name) = table.get("name") {
        return text(name);
    }
    match table.get("between").map(|node| &node.value) {
        Some(Value::List(pair)) => pair.iter().map(text).collect::<Vec<_>>().join("-"),
        _ => String::new(),
    }
}

fn multiply(node: &mut Node, factor: f64) -> Result<(), String> {
    let product = match &mut node.value {
        Value::Integer(value) => Value::Number(*value as f64 * factor),
        Value::Number(value) => Value::Number(*value * factor),
        Value::Text(text) => match split_number(text) {
            Some((number, unit)) => Value::Text(quantity_text(number * factor, unit)),
            None => {
                return Err(format!(
                    "\"{text}\" is not a number that could be multiplied"
                ));
            }
        },
        Value::List(list) => {
            return list
                .iter_mut()
                .try_for_each(|entry| multiply(entry, factor));
        }
        _ => return Err(format!("{} cannot be multiplied", node.describe())),
    };
    node.value = product;
    Ok(())
}

/// A number and a unit as written in a file; reading it returns the same number to the last bit.
pub(crate) fn quantity_text(number: f64, unit: &str) -> String {
    let unit = unit.trim();
    if unit.is_empty() {
        format!("{number:?}")
    } else {
        format!("{number:?} {unit}")
    }
}

impl TreeValue {
    pub(crate) fn node(&self) -> Node {
        let value = match self {
            Self::Text(text) => Value::Text(text.clone()),
            Self::Integer(value) => Value::Integer(*value),
            Self::Number(value) => Value::Number(*value),
            Self::Flag(value) => Value::Flag(*value),
            Self::List(list) => Value::List(list.iter().map(Self::node).collect()),
            Self::Table(table) => Value::Table(Table {
                entries: table
                    .iter()
                    .map(|(key, value)| Entry {
                        key: key.clone(),
                        key_span: 0..0,
                        node: value.node(),
                    })
                    .collect(),
            }),
        };
        Node { span: 0..0, value }
    }

    /// The value of a node; `None` for dates and similar values.
    pub(crate) fn from_node(node: &Node) -> Option<Self> {
        Some(match &node.value {
            Value::Text(text) => Self::Text(text.clone()),
            Value::Integer(value) => Self::Integer(*value),
            Value::Number(value) => Self::Number(*value),
            Value::Flag(value) => Self::Flag(*value),
            Value::List(list) => {
                Self::List(list.iter().map(Self::from_node).collect::<Option<_>>()?)
            }
            Value::Table(table) => Self::Table(
                table
                    .entries
                    .iter()
                    .map(|entry| Some((entry.key.clone(), Self::from_node(&entry.node)?)))
                    .collect::<Option<_>>()?,
            ),
            Value::Other(_) => return None,
        })
    }
}

impl fmt::Display for TreeValue {
    /// Texts plain, everything else as in a model file.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let list = |f: &mut fmt::Formatter<'_>, entries: Vec<String>, marks: [&str; 2]| {
            write!(f, "{}{}{}", marks[0], entries.join(", "), marks[1])
        };
        match self {
            Self::Text(text) => f.write_str(text),
            Self::Integer(value) => write!(f, "{value}"),
            Self::Number(value) => write!(f, "{value}"),
            Self::Flag(value) => write!(f, "{value}"),
            Self::List(entries) => list(
                f,
                entries.iter().map(ToString::to_string).collect(),
                ["[", "]"],
            ),
            Self::Table(entries) => {
                let entries = entries
                    .iter()
                    .map(|(key, value)| format!("{key} = {value}"));
                list(f, entries.collect(), ["{ ", " }"])
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paper() -> ModelTree {
        ModelTree::builtin("paper").unwrap_or_else(|error| panic!("{error}"))
    }

    fn text(text: &str) -> TreeValue {
        TreeValue::Text(text.into())
    }

    #[test]
    fn changed_values_are_read_as_if_written() {
        let mut tree = paper();
        for (path, value) in [
            ("gap[*].width", text("35 mm")),
            ("building.J1.storeys", TreeValue::Integer(4)),
            ("motion.scale", TreeValue::Number(0.5)),
            ("analysis.tolerance", TreeValue::Number(0.01)),
        ] {
            tree.set(path, &value)
                .unwrap_or_else(|error| panic!("{error}"));
        }
        tree.multiply("building[1].beam_mass", 2.0)
            .unwrap_or_else(|error| panic!("{error}"));
        let input = tree.input().unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(input.model.gaps[0].width(), 0.035);
        assert_eq!(input.model.buildings[0].floors(), 4);
        assert_eq!(input.model.analysis.tolerance, 0.01);
        let motion = input.motion.unwrap_or_else(|| panic!("a motion"));
        // The peak of the file has given way to the factor.
        assert_eq!(motion.scaling, crate::Scaling::Factor(0.5));
        match &input.model.buildings[1].structure {
            jostle::Structure::Frame(frame) => assert_eq!(frame.beam_mass[0], 11_700.0),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn paths_that_lead_nowhere_say_so() {
        let mut tree = paper();
        for (path, expected) in [
            ("gap[3].width", "there is no [3]"),
            ("gap.width", "gap[0]"),
            ("title.x", "single value"),
            ("gap[x].width", "no index"),
            ("building[0].mass[0]", "has no mass"),
            ("link.damping", "has no [[link]]"),
            ("", "not a path"),
            (&"a.".repeat(60_000), "more than 64 parts"),
            (&format!("a{}", "[0]".repeat(60_000)), "more than 64 parts"),
        ] {
            let error = tree.set(path, &TreeValue::Number(1.0));
            let error = error
                .err()
                .map(|error| error.to_string())
                .unwrap_or_default();
            assert!(error.contains(expected), "{path}: {error}");
        }
        let error = tree.multiply("motion.record", 2.0);
        assert!(error.is_err(), "a name cannot be multiplied");
    }
}
