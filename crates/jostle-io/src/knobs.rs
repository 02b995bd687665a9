//! Every key of a model file with its value, unit and range, for pages with input fields.

use serde::Serialize;

use crate::ModelTree;
use crate::keys::{Key, Kind, Section, keys_of, range_of};
use crate::quantity::{Dimension, split_number};
use crate::reader::join;
use crate::tree::{Node, Value};

/// One key of a model file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Knob {
    /// Path, as [`ModelTree::set`] takes it.
    pub path: String,
    /// Owner of the key: the name of a building, the neighbours of a gap, or a table of the file.
    pub group: String,
    /// Name of the key, with those of inner tables.
    pub name: String,
    /// Description, one line.
    pub doc: &'static str,
    /// Type of its value.
    pub kind: KnobKind,
    /// Its value as typed into a field, texts without quotes; `None` where the file does not state it.
    pub value: Option<String>,
    /// Default value.
    pub default: Option<&'static str>,
    /// Words to choose from.
    pub choices: &'static [&'static str],
    /// The number in the value, if it is one.
    pub number: Option<f64>,
    /// Its unit as written.
    pub unit: String,
    /// Name of the dimension and its unit in SI, such as `a length` and `m`.
    pub dimension: Option<(&'static str, &'static str)>,
    /// Usual range in SI: outside, jostle warns.
    pub usual: Option<[f64; 2]>,
}

/// Type of the value of a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum KnobKind {
    /// A quantity with its unit, a number, or a list of them.
    Quantity,
    /// A whole number.
    Count,
    /// True or false.
    Flag,
    /// One of some words.
    Choice,
    /// Anything else, as in the file.
    Text,
}

impl ModelTree {
    /// Every key that the tables of the file have or could have, in the order of the file. Rarely used absent
    /// tables are omitted.
    #[must_use]
    pub fn knobs(&self) -> Vec<Knob> {
        let mut knobs = Vec::new();
        table(
            Some(&self.root),
            &[Section::Root],
            "",
            ("model", ""),
            &mut knobs,
        );
        knobs
    }
}

/// Names of a group and of the tables within it.
type At<'a> = (&'a str, &'a str);

fn table(node: Option<&Node>, sections: &[Section], path: &str, at: At<'_>, into: &mut Vec<Knob>) {
    let empty = crate::tree::Table::default();
    let table = match node.map(|node| &node.value) {
        Some(Value::Table(table)) => table,
        None => &empty,
        // A fault that the reader reports.
        Some(_) => return,
    };
    let kind_sections: &[Section] = match table.get("kind").map(|node| &node.value) {
        Some(Value::Text(kind)) if kind == "shear" => &[Section::Shear],
        Some(Value::Text(kind)) if kind == "given" => &[Section::Given],
        Some(Value::Text(kind)) if kind == "space-frame" => &[Section::Shear, Section::SpaceFrame],
        _ => &[Section::Frame],
    };
    let kinds = [
        Section::Frame,
        Section::Shear,
        Section::SpaceFrame,
        Section::Given,
    ];
    let is_own = |section: &Section| kind_sections.contains(section) || !kinds.contains(section);
    let sections: Vec<Section> = sections.iter().copied().filter(is_own).collect();
    let keys: Vec<&Key> = keys_of(&sections).collect();
    for (index, key) in keys.iter().enumerate() {
        // A space frame has hinges of its own kind.
        if keys[index + 1..].iter().any(|later| later.name == key.name) {
            continue;
        }
        let node = table.get(key.name);
        entry(key, node, &sections, &join(path, key.name), at, into);
    }
}

/// Tables that are offered although the file does not have them.
const OFFERED: [&str; 4] = ["motion", "analysis", "damping", "joint"];

fn entry(
    key: &Key,
    node: Option<&Node>,
    sections: &[Section],
    path: &str,
    (group, within): At<'_>,
    into: &mut Vec<Knob>,
) {
    let name = join(within, key.name);
    let inner: &[Section] = match &key.kind {
        Kind::Table(section)
        | Kind::TablePerStorey(section)
        | Kind::TablePerPlace(section)
        | Kind::NumberOrTable(section)
        | Kind::NumbersOrTable(section)
        | Kind::TextOrTable(section)
        | Kind::ChoiceOrTable(_, section) => std::slice::from_ref(section),
        Kind::WordOrTable(_, sections) | Kind::Tables(sections) | Kind::TableOf(sections) => {
            sections
        }
        _ => &[],
    };
    let group = if path == key.name && inner.len() == 1 {
        key.name
    } else {
        group
    };
    let within = if path == key.name { "" } else { name.as_str() };
    match node.map(|node| &node.value) {
        Some(Value::Table(named)) if matches!(key.kind, Kind::Named(_)) => {
            let Kind::Named(section) = &key.kind else {
                return;
            };
            for named in &named.entries {
                // A path has no way to write other names; the text of the file has.
                if !named.key.contains(['.', '[']) {
                    let sections = std::slice::from_ref(section);
                    let (path, within) = (join(path, &named.key), join(&name, &named.key));
                    table(Some(&named.node), sections, &path, (group, &within), into);
                }
            }
            return;
        }
        Some(Value::Table(_)) if !inner.is_empty() => {
            return table(node, inner, path, (group, within), into);
        }
        Some(Value::List(list)) if !inner.is_empty() => {
            for (index, one) in list.iter().enumerate() {
                let path = format!("{path}[{index}]");
                let named = crate::model_tree::name_of(one);
                let (group, within) = if matches!(key.kind, Kind::Tables(_)) {
                    let fallback = format!("{} {}", key.name, index + 1);
                    (
                        if named.is_empty() { fallback } else { named },
                        String::new(),
                    )
                } else if matches!(key.kind, Kind::TablePerPlace(_)) {
                    (group.to_owned(), format!("{name} {}", index + 1))
                } else {
                    (group.to_owned(), format!("{name} of storey {}", index + 1))
                };
                table(Some(one), inner, &path, (&group, &within), into);
            }
            return;
        }
        None if matches!(key.kind, Kind::Tables(_)) => return,
        None if matches!(key.kind, Kind::TableOf(_)) => return,
        None if matches!(key.kind, Kind::Table(_)) => {
            if OFFERED.contains(&key.name) {
                table(None, inner, path, (group, within), into);
            }
            return;
        }
        _ => {}
    }
    let (kind, choices) = kind_of(&key.kind);
    let typed = node.map(typed);
    let (number, unit) = match node.map(|node| &node.value) {
        Some(Value::Integer(value)) => (Some(*value as f64), String::new()),
        Some(Value::Number(value)) => (Some(*value), String::new()),
        Some(Value::Text(text)) if kind == KnobKind::Quantity => match split_number(text) {
            Some((number, unit)) => (Some(number), unit.trim().to_owned()),
            None => (None, String::new()),
        },
        _ => (None, String::new()),
    };
    into.push(Knob {
        path: path.to_owned(),
        group: group.to_owned(),
        name,
        doc: key.doc,
        kind,
        value: typed,
        default: key.default,
        choices,
        number,
        unit,
        dimension: dimension(&key.kind).map(|d| (d.noun(), d.si_unit())),
        usual: range_of(sections, key.name).map(|range| range.usual),
    });
}

fn kind_of(kind: &Kind) -> (KnobKind, &'static [&'static str]) {
    match kind {
        Kind::Count => (KnobKind::Count, &[]),
        Kind::Flag => (KnobKind::Flag, &[]),
        Kind::Choice(words) | Kind::Word(words) | Kind::ChoiceOrTable(words, _) => {
            (KnobKind::Choice, words)
        }
        kind if dimension(kind).is_some() => (KnobKind::Quantity, &[]),
        _ => (KnobKind::Text, &[]),
    }
}

/// The dimension of a value that is typed into a field: not of lists of points, nor where a grade is usual.
fn dimension(kind: &Kind) -> Option<Dimension> {
    match kind {
        Kind::Plan | Kind::PlanPoints | Kind::PlanStiffness => None,
        Kind::GradeOr(_) | Kind::Concrete(_) | Kind::ConcreteOr(_) => None,
        kind => kind.dimension(),
    }
}

/// A value as typed into a field: texts without quotes, all else as in a TOML file.
fn typed(node: &Node) -> String {
    match &node.value {
        Value::Text(text) => text.clone(),
        _ => crate::rewrite::literal(node, crate::Format::Toml),
    }
}

impl crate::TreeValue {
    /// The value of a text typed into a field: numbers, `true` and `false`, lists and tables as in a TOML file, all
    /// else a text, such as `20 mm`.
    #[must_use]
    pub fn typed(text: &str) -> Self {
        let text = text.trim();
        let plain = Self::Text(text.to_owned());
        let quoted = text.len() > 1 && text.starts_with('"') && text.ends_with('"');
        let is_value = text.starts_with(['[', '{'])
            || quoted
            || matches!(text, "true" | "false")
            || text.parse::<f64>().is_ok_and(f64::is_finite);
        if !is_value || text.contains('\n') {
            return plain;
        }
        if let Ok(number) = text.parse::<i64>() {
            return Self::Integer(number);
        }
        if let Ok(number) = text.parse::<f64>() {
            return Self::Number(number);
        }
        let parsed = crate::tree::toml_tree::parse(&format!("value = {text}"));
        let value = parsed.ok().and_then(|root| match root.value {
            Value::Table(table) => table.get("value").and_then(Self::from_node),
            _ => None,
        });
        value.unwrap_or(plain)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TreeValue;

    fn paper() -> Vec<Knob> {
        ModelTree::builtin("paper")
            .unwrap_or_else(|error| panic!("{error}"))
            .knobs()
    }

    fn find<'k>(knobs: &'k [Knob], path: &str) -> &'k Knob {
        let found = knobs.iter().find(|knob| knob.path == path);
        found.unwrap_or_else(|| panic!("no {path}"))
    }

    #[test]
    fn values_come_with_unit_and_range() {
        let knobs = paper();
        let gap = find(&knobs, "gap[0].width");
        assert_eq!((gap.group.as_str(), gap.name.as_str()), ("J1-J2", "width"));
        assert_eq!((gap.number, gap.unit.as_str()), (Some(100.0), "mm"));
        assert_eq!(gap.usual, Some([1e-5, 2.0]));
        let law = find(&knobs, "gap[0].law");
        assert_eq!(law.kind, KnobKind::Choice);
        assert!(law.choices.contains(&"kelvin"));
        let ratio = find(&knobs, "building[1].damping.ratio");
        assert_eq!(
            (ratio.group.as_str(), ratio.name.as_str()),
            ("J2", "damping.ratio")
        );
        assert_eq!(find(&knobs, "building[0].p_delta").value, None);
        assert_eq!(find(&knobs, "motion.pga").group, "motion");
        assert!(
            knobs.iter().all(|knob| knob.path != "building[0].mass"),
            "of shear buildings"
        );
    }

    #[test]
    fn ports_have_knobs_of_their_own() {
        let text = "[[building]]\nname = \"A\"\nkind = \"given\"\nmatrices = \"a.npz\"\n\n[building.ports]\n\"1\" = { dof = 1, height = \"4.2 m\" }\nroof = { dof = 2, height = \"7.8 m\" }\n";
        let base = std::path::Path::new("");
        let tree = ModelTree::parse("m", text, crate::Format::Toml, base)
            .unwrap_or_else(|error| panic!("{error}"));
        let knobs = tree.knobs();
        let roof = find(&knobs, "building[0].ports.roof.height");
        assert_eq!(
            (roof.group.as_str(), roof.name.as_str()),
            ("A", "ports.roof.height")
        );
        assert_eq!((roof.number, roof.unit.as_str()), (Some(7.8), "m"));
        assert_eq!(
            find(&knobs, "building[0].ports.1.dof").kind,
            KnobKind::Count
        );
        let height = TreeValue::typed("8 m");
        let text = tree.rewritten("building[0].ports.roof.height", Some(&height));
        let text = text.unwrap_or_else(|error| panic!("{error}"));
        assert!(
            text.contains("roof = { dof = 2, height = \"8 m\" }"),
            "{text}"
        );
    }

    #[test]
    fn every_path_can_be_set() {
        let tree = ModelTree::builtin("paper").unwrap_or_else(|error| panic!("{error}"));
        for knob in tree.knobs() {
            let mut tree = tree.clone();
            if let Err(error) = tree.set(&knob.path, &TreeValue::Number(1.0)) {
                panic!("{error}");
            }
        }
    }

    #[test]
    fn typed_texts_become_values() {
        assert_eq!(TreeValue::typed(" 20 mm "), TreeValue::Text("20 mm".into()));
        assert_eq!(TreeValue::typed("3"), TreeValue::Integer(3));
        assert_eq!(TreeValue::typed("0.5"), TreeValue::Number(0.5));
        assert_eq!(TreeValue::typed("true"), TreeValue::Flag(true));
        let list = vec![TreeValue::Text("1 t".into()), TreeValue::Text("2 t".into())];
        assert_eq!(
            TreeValue::typed("[\"1 t\", \"2 t\"]"),
            TreeValue::List(list)
        );
        assert_eq!(TreeValue::typed("[1"), TreeValue::Text("[1".into()));
    }
}
