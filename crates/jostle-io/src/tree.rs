//! A tree of values with their positions in the file, the same from TOML and from JSON.

mod json_tree;
pub(crate) mod toml_tree;

use std::path::Path;

use crate::fault::{Fault, InputError};
use crate::source::{Source, Span};

/// Syntax of a model file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Format {
    /// TOML 1.1.
    #[default]
    Toml,
    /// JSON, without comments.
    Json,
}

impl Format {
    /// JSON for names that end in `.json`, else TOML.
    #[must_use]
    pub fn of_path(path: &Path) -> Self {
        match path.extension() {
            Some(extension) if extension.eq_ignore_ascii_case("json") => Self::Json,
            _ => Self::Toml,
        }
    }

    /// JSON for texts that begin with a brace or a comment of JSON, which no TOML does.
    #[must_use]
    pub fn of_text(text: &str) -> Self {
        if text.trim_start().starts_with(['{', '/']) {
            Self::Json
        } else {
            Self::Toml
        }
    }
}

/// A value and the bytes it covers.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub(crate) span: Span,
    pub(crate) value: Value,
}

#[derive(Clone, Debug)]
pub(crate) enum Value {
    Text(String),
    Integer(i64),
    Number(f64),
    Flag(bool),
    List(Vec<Node>),
    Table(Table),
    /// Something no model file uses; the name goes into the message.
    Other(&'static str),
}

/// Entries in the order of the file.
#[derive(Clone, Debug, Default)]
pub(crate) struct Table {
    pub(crate) entries: Vec<Entry>,
}

#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub(crate) key: String,
    pub(crate) key_span: Span,
    pub(crate) node: Node,
}

impl Table {
    pub(crate) fn get(&self, key: &str) -> Option<&Node> {
        self.entries
            .iter()
            .find(|entry| entry.key == key)
            .map(|entry| &entry.node)
    }
}

impl Node {
    /// Type of the value with its article, for messages.
    pub(crate) fn describe(&self) -> String {
        match &self.value {
            Value::Text(text) => format!("\"{}\"", crate::quantity::shorten(text)),
            Value::Integer(value) => value.to_string(),
            Value::Number(value) => crate::quantity::show_number(*value),
            Value::Flag(value) => value.to_string(),
            Value::List(_) => "a list".into(),
            Value::Table(_) => "a table".into(),
            Value::Other(name) => (*name).into(),
        }
    }
}

/// A syntax error: its place, what is wrong.
pub(crate) struct SyntaxError {
    pub(crate) span: Span,
    pub(crate) problem: String,
}

/// Largest model file \[bytes\].
pub(crate) const LARGEST_FILE: usize = 16 << 20;

/// Decodes the bytes of a model file, without a byte-order mark.
pub(crate) fn decode<'a>(name: &str, bytes: &'a [u8]) -> Result<&'a str, InputError> {
    if bytes.len() > LARGEST_FILE {
        return Err(too_large(name));
    }
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let valid = bytes.get(..error.valid_up_to()).unwrap_or_default();
        let line = 1 + valid.iter().filter(|byte| **byte == b'\n').count();
        InputError::whole(
            name,
            format!("the text is not UTF-8 (first seen in line {line})"),
            Some("save the file with the encoding UTF-8".into()),
        )
    })?;
    Ok(text.strip_prefix('\u{feff}').unwrap_or(text))
}

/// The error for a file of more than [`LARGEST_FILE`].
pub(crate) fn too_large(name: &str) -> InputError {
    let problem = "the file has more than 16 MiB, the most that a model file may have";
    InputError::whole(name, problem.to_owned(), None)
}

/// Parses a text whose root must be a table.
pub(crate) fn parse(source: &Source, format: Format) -> Result<Node, InputError> {
    let parsed = match format {
        Format::Toml => toml_tree::parse(source.text()),
        Format::Json => json_tree::parse(source.text()),
    };
    parsed.map_err(|errors| InputError {
        name: source.name.clone(),
        faults: errors
            .into_iter()
            .map(|error| Fault {
                path: String::new(),
                place: Some(source.place(&error.span)),
                problem: error.problem,
                remedy: None,
            })
            .collect(),
        more: 0,
    })
}
