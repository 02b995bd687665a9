//! The text of a model file with one value changed: comments, order and spacing of all else stay.

use std::ops::Range;

use crate::model_tree::{ALTERNATIVES, Part, name_of, parts};
use crate::reader::join;
use crate::tree::{Format, Node, Table, Value};
use crate::{ModelTree, PathError, TreeValue};

impl ModelTree {
    /// The text of the model file with a value set at a path, or with the key removed (`None`). The path is one of
    /// [`ModelTree::set`]; keys that exclude the new one are removed as there.
    ///
    /// The new text always reads as the tree that [`ModelTree::set`] makes. If the file is written in a way that
    /// cannot be edited in place, the text is rewritten without comments.
    ///
    /// # Errors
    /// [`PathError`] when the path leads nowhere.
    pub fn rewritten(&self, path: &str, value: Option<&TreeValue>) -> Result<String, PathError> {
        let wrong = |problem: String| PathError::new(path, problem);
        let mut wanted = self.clone();
        match value {
            Some(value) => wanted.set(path, value)?,
            None => {
                let parts = parts(path).map_err(wrong)?;
                remove(&mut wanted.root, &parts);
            }
        }
        let edited = self.edited(path, value);
        if let Some(text) = edited {
            let read = self.again(&text);
            if read.is_some_and(|read| same(&read.root, &wanted.root)) {
                return Ok(text);
            }
        }
        Ok(match Format::of_text(self.text()) {
            Format::Toml => toml_text(&wanted.root),
            Format::Json => json_text(&wanted.root, 0) + "\n",
        })
    }

    /// The tree as TOML: the text itself if it is TOML, else written anew, without comments.
    #[must_use]
    pub fn toml(&self) -> String {
        match Format::of_text(self.text()) {
            Format::Toml => self.text().to_owned(),
            Format::Json => toml_text(&self.root),
        }
    }

    /// The text edited in place; `None` where that is not possible.
    fn edited(&self, path: &str, value: Option<&TreeValue>) -> Option<String> {
        let parts = parts(path).ok()?;
        if let Some(every) = parts.iter().position(|part| *part == Part::Every) {
            let list = descend(&self.root, &parts[..every]).0;
            let Value::List(list) = &list.value else {
                return None;
            };
            let mut text = self.text().to_owned();
            for index in 0..list.len() {
                let one = path.replacen("[*]", &format!("[{index}]"), 1);
                text = self.again(&text)?.edited(&one, value)?;
            }
            return Some(text);
        }
        if let (Some(_), Some((_, others))) = (
            value,
            ALTERNATIVES
                .iter()
                .find(|(name, _)| path == join("motion", name)),
        ) {
            let mut text = self.text().to_owned();
            for other in *others {
                let other = join("motion", other);
                let tree = self.again(&text)?;
                if !tree.values(&other).is_empty() {
                    text = tree.edited(&other, None)?;
                }
            }
            return self.again(&text)?.put(&parts, value);
        }
        self.put(&parts, value)
    }

    fn again(&self, text: &str) -> Option<Self> {
        Self::parse_with(
            self.name(),
            text,
            Format::of_text(text),
            self.files().clone(),
        )
        .ok()
    }

    fn put(&self, parts: &[Part], value: Option<&TreeValue>) -> Option<String> {
        let text = self.text();
        let format = Format::of_text(text);
        let (node, found) = descend(&self.root, parts);
        let Some(value) = value else {
            if found < parts.len() {
                return Some(text.to_owned());
            }
            return removed(text, &self.root, parts);
        };
        if found == parts.len() {
            let is_heading = matches!(node.value, Value::Table(_))
                && !text.get(node.span.clone())?.starts_with('{');
            return (!is_heading)
                .then(|| splice(text, node.span.clone(), &literal(&value.node(), format)));
        }
        let Value::Table(table) = &node.value else {
            return None;
        };
        let keys: Option<Vec<&str>> = parts[found..]
            .iter()
            .map(|part| match part {
                Part::Key(key) => Some(key.as_str()),
                _ => None,
            })
            .collect();
        let keys = keys?;
        let written = literal(&value.node(), format);
        let inline = text.get(node.span.clone())?.starts_with('{');
        if format == Format::Json || inline {
            let start = node.span.start + text.get(node.span.start..)?.find('{')? + 1;
            let comma = if table.entries.is_empty() { "" } else { "," };
            let entry = match format {
                Format::Json => {
                    let closing = "}".repeat(keys.len() - 1);
                    let opening: Vec<String> = keys
                        .iter()
                        .map(|key| format!("{}: ", quoted(key)))
                        .collect();
                    format!("{}{written}{closing}{comma}", opening.join("{"))
                }
                Format::Toml => format!(" {} = {written}{comma}", dotted(&keys)),
            };
            return Some(splice(text, start..start, &entry));
        }
        let line = format!("{} = {written}", dotted(&keys));
        if found == 0 {
            return Some(match &keys[..] {
                [_] => splice(text, 0..0, &format!("{line}\n")),
                [table, rest @ ..] => {
                    let end = if text.ends_with('\n') { "" } else { "\n" };
                    format!("{text}{end}\n[{table}]\n{} = {written}\n", dotted(rest))
                }
                [] => return None,
            });
        }
        // Behind the heading of the table.
        let end = line_end(text, node.span.start);
        Some(splice(text, end..end, &format!("\n{line}")))
    }
}

/// The deepest node along a path, and how many steps lead there.
fn descend<'n>(root: &'n Node, parts: &[Part]) -> (&'n Node, usize) {
    let mut node = root;
    for (depth, part) in parts.iter().enumerate() {
        let next = match (part, &node.value) {
            (Part::Key(key), Value::Table(table)) => table.get(key),
            (Part::Key(key), Value::List(list)) => list.iter().find(|entry| name_of(entry) == *key),
            (Part::Index(index), Value::List(list)) => list.get(*index),
            _ => None,
        };
        match next {
            Some(next) => node = next,
            None => return (node, depth),
        }
    }
    (node, parts.len())
}

/// Removes what a path leads to, if it leads anywhere.
fn remove(node: &mut Node, parts: &[Part]) {
    match (parts, &mut node.value) {
        ([Part::Key(key)], Value::Table(table)) => {
            table.entries.retain(|entry| entry.key != *key);
        }
        ([Part::Key(key), rest @ ..], Value::Table(table)) => {
            for entry in table.entries.iter_mut().filter(|entry| entry.key == *key) {
                remove(&mut entry.node, rest);
            }
        }
        ([Part::Key(key), rest @ ..], Value::List(list)) if !rest.is_empty() => {
            for entry in list.iter_mut().filter(|entry| name_of(entry) == *key) {
                remove(entry, rest);
            }
        }
        ([Part::Index(index), rest @ ..], Value::List(list)) if !rest.is_empty() => {
            if let Some(entry) = list.get_mut(*index) {
                remove(entry, rest);
            }
        }
        ([Part::Every, rest @ ..], Value::List(list)) if !rest.is_empty() => {
            for entry in list {
                remove(entry, rest);
            }
        }
        _ => {}
    }
}

/// The text without an entry of a table.
fn removed(text: &str, root: &Node, parts: &[Part]) -> Option<String> {
    let (Part::Key(key), above) = parts.split_last()? else {
        return None;
    };
    let Value::Table(table) = &descend(root, above).0.value else {
        return None;
    };
    let entry = table.entries.iter().find(|entry| entry.key == *key)?;
    let (mut start, mut end) = (entry.key_span.start, entry.node.span.end);
    if end <= start {
        return None;
    }
    let line_start = text[..start].rfind('\n').map_or(0, |at| at + 1);
    if Format::of_text(text) == Format::Toml && text[line_start..start].trim().is_empty() {
        let end = line_end(text, end);
        return Some(splice(text, line_start..(end + 1).min(text.len()), ""));
    }
    // In braces, with one of the commas around it.
    let after = text[end..].trim_start();
    if after.starts_with(',') {
        end = text.len() - after.len() + 1;
        end += text[end..].len() - text[end..].trim_start_matches(' ').len();
    } else {
        let before = text[..start].trim_end();
        if before.ends_with(',') {
            start = before.len() - 1;
        }
    }
    Some(splice(text, start..end, ""))
}

fn line_end(text: &str, at: usize) -> usize {
    text[at..].find('\n').map_or(text.len(), |end| at + end)
}

fn splice(text: &str, range: Range<usize>, with: &str) -> String {
    format!("{}{with}{}", &text[..range.start], &text[range.end..])
}

/// Whether two trees are equal; the order of keys does not matter.
fn same(a: &Node, b: &Node) -> bool {
    match (&a.value, &b.value) {
        (Value::Text(a), Value::Text(b)) => a == b,
        (Value::Integer(a), Value::Integer(b)) => a == b,
        (Value::Number(a), Value::Number(b)) => a.to_bits() == b.to_bits(),
        (Value::Flag(a), Value::Flag(b)) => a == b,
        (Value::List(a), Value::List(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b))
        }
        (Value::Table(a), Value::Table(b)) => {
            let holds = |entry: &crate::tree::Entry| {
                b.get(&entry.key)
                    .is_some_and(|node| same(&entry.node, node))
            };
            a.entries.len() == b.entries.len() && a.entries.iter().all(holds)
        }
        _ => false,
    }
}

fn quoted(text: &str) -> String {
    // The escapes of JSON are those of TOML; TOML also requires this one.
    serde_json::to_string(text)
        .unwrap_or_default()
        .replace('\u{7f}', "\\u007f")
}

fn bare(key: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-');
    if !key.is_empty() && key.chars().all(plain) {
        key.to_owned()
    } else {
        quoted(key)
    }
}

fn dotted(keys: &[&str]) -> String {
    let keys: Vec<String> = keys.iter().map(|key| bare(key)).collect();
    keys.join(".")
}

/// A value on one line.
pub(crate) fn literal(node: &Node, format: Format) -> String {
    match &node.value {
        Value::Text(text) => quoted(text),
        Value::Integer(value) => value.to_string(),
        Value::Number(value) => format!("{value:?}"),
        Value::Flag(value) => value.to_string(),
        Value::List(list) => {
            let list: Vec<String> = list.iter().map(|node| literal(node, format)).collect();
            format!("[{}]", list.join(", "))
        }
        Value::Table(Table { entries }) => {
            let entries = entries.iter().map(|entry| match format {
                Format::Toml => format!("{} = {}", bare(&entry.key), literal(&entry.node, format)),
                Format::Json => format!("{}: {}", quoted(&entry.key), literal(&entry.node, format)),
            });
            format!("{{ {} }}", entries.collect::<Vec<_>>().join(", "))
        }
        // No key of a model file accepts one: it is always a fault.
        Value::Other(name) => quoted(name),
    }
}

/// A whole file: values first, then a heading for each table and each entry of a list of tables.
fn toml_text(root: &Node) -> String {
    let Value::Table(root) = &root.value else {
        return String::new();
    };
    let lines = |table: &Table| -> String {
        let line = |entry: &crate::tree::Entry| {
            format!(
                "{} = {}\n",
                bare(&entry.key),
                literal(&entry.node, Format::Toml)
            )
        };
        table.entries.iter().map(line).collect()
    };
    let (mut values, mut tables) = (String::new(), String::new());
    for entry in &root.entries {
        let key = bare(&entry.key);
        match &entry.node.value {
            Value::Table(table) => tables += &format!("\n[{key}]\n{}", lines(table)),
            Value::List(list)
                if !list.is_empty() && list.iter().all(|n| matches!(n.value, Value::Table(_))) =>
            {
                for node in list {
                    if let Value::Table(table) = &node.value {
                        tables += &format!("\n[[{key}]]\n{}", lines(table));
                    }
                }
            }
            _ => values += &format!("{key} = {}\n", literal(&entry.node, Format::Toml)),
        }
    }
    values + &tables
}

fn json_text(node: &Node, depth: usize) -> String {
    let indent = "  ".repeat(depth + 1);
    let outer = "  ".repeat(depth);
    match &node.value {
        Value::Table(table) if depth < 2 && !table.entries.is_empty() => {
            let line = |entry: &crate::tree::Entry| {
                let value = json_text(&entry.node, depth + 1);
                format!("{indent}{}: {value}", quoted(&entry.key))
            };
            let lines: Vec<String> = table.entries.iter().map(line).collect();
            format!("{{\n{}\n{outer}}}", lines.join(",\n"))
        }
        _ => literal(node, Format::Json),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn tree(text: &str) -> ModelTree {
        ModelTree::parse("test", text, Format::of_text(text), Path::new(""))
            .unwrap_or_else(|error| panic!("{error}"))
    }

    fn rewrite(text: &str, path: &str, value: Option<TreeValue>) -> String {
        tree(text)
            .rewritten(path, value.as_ref())
            .unwrap_or_else(|error| panic!("{error}"))
    }

    fn mm(text: &str) -> Option<TreeValue> {
        Some(TreeValue::Text(text.into()))
    }

    const FILE: &str = "title = \"T\"  # kept\n\n[motion]\nscale = 2 # strong\nrecord = \"r\"\n\n[[building]]\nname = \"A\"\ndamping = { ratio = 0.05, modes = [1, 3] }\n\n[[gap]]\nwidth = \"10 mm\"   # narrow\n[[gap]]\nwidth = \"20 mm\"\n";

    #[test]
    fn one_value_changes_and_all_else_stays() {
        assert_eq!(
            rewrite(FILE, "gap[0].width", mm("12 mm")),
            FILE.replace("\"10 mm\"", "\"12 mm\"")
        );
        assert_eq!(
            rewrite(FILE, "gap[*].width", mm("12 mm")),
            FILE.replace("\"10 mm\"", "\"12 mm\"")
                .replace("\"20 mm\"", "\"12 mm\"")
        );
        assert_eq!(
            rewrite(
                FILE,
                "building.A.damping.ratio",
                Some(TreeValue::Number(0.02))
            ),
            FILE.replace("0.05", "0.02")
        );
    }

    #[test]
    fn absent_keys_are_put_under_their_heading() {
        assert_eq!(
            rewrite(FILE, "gap[1].law", mm("hertz")),
            FILE.replace(
                "[[gap]]\nwidth = \"20",
                "[[gap]]\nlaw = \"hertz\"\nwidth = \"20"
            )
        );
        assert_eq!(
            rewrite(
                FILE,
                "building[0].damping.alpha",
                Some(TreeValue::Number(1.0))
            ),
            FILE.replace("{ ratio", "{ alpha = 1.0, ratio")
        );
        assert_eq!(
            rewrite(FILE, "analysis.step", mm("1 ms")),
            format!("{FILE}\n[analysis]\nstep = \"1 ms\"\n")
        );
        assert_eq!(
            rewrite(FILE, "building[0].base.mass", mm("1 t")),
            FILE.replace("[[building]]", "[[building]]\nbase.mass = \"1 t\"")
        );
    }

    #[test]
    fn what_excludes_the_new_key_goes() {
        assert_eq!(
            rewrite(FILE, "motion.pga", mm("1 m/s2")),
            FILE.replace("scale = 2 # strong\n", "")
                .replace("[motion]", "[motion]\npga = \"1 m/s2\"")
        );
    }

    #[test]
    fn removed_keys_take_their_line_or_their_comma() {
        assert_eq!(
            rewrite(FILE, "motion.scale", None),
            FILE.replace("scale = 2 # strong\n", "")
        );
        assert_eq!(
            rewrite(FILE, "building[0].damping.ratio", None),
            FILE.replace("ratio = 0.05, ", "")
        );
        assert_eq!(
            rewrite(FILE, "building[0].damping.modes", None),
            FILE.replace(", modes = [1, 3]", "")
        );
        assert_eq!(rewrite(FILE, "gap[0].law", None), FILE);
    }

    #[test]
    fn json_stays_json() {
        let text =
            r#"{ "building": [ { "name": "A", "damping": {} } ], "motion": { "scale": 1 } }"#;
        assert_eq!(
            rewrite(
                text,
                "building[0].damping.ratio",
                Some(TreeValue::Number(0.02))
            ),
            text.replace("{}", "{\"ratio\": 0.02}")
        );
        let text = rewrite(text, "motion.match.value", mm("1 m/s2"));
        assert_eq!(tree(&text).values("motion.match.value").len(), 1);
    }

    #[test]
    fn what_cannot_be_edited_in_place_is_written_anew() {
        // The table of the match has a heading of its own.
        let text = format!("{FILE}\n[motion.match]\nvalue = \"1 m/s2\"\n")
            .replace("scale = 2 # strong\n", "");
        let after = rewrite(&text, "motion.pga", mm("2 m/s2"));
        let read = tree(&after);
        assert_eq!(read.values("motion.pga").len(), 1);
        assert!(read.values("motion.match").is_empty(), "{after}");
        assert_eq!(read.values("gap[*].width").len(), 2);
    }
}
