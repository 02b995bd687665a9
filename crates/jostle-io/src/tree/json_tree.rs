//! The value tree of a JSON text.

use std::collections::HashSet;

use jsonc_parser::ast;
use jsonc_parser::common::Ranged;
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};

use crate::tree::{Entry, Node, SyntaxError, Table, Value};

/// Plain JSON: nothing that other JSON readers would refuse.
const STRICT: ParseOptions = ParseOptions {
    allow_comments: false,
    allow_loose_object_property_names: false,
    allow_trailing_commas: false,
    allow_missing_commas: false,
    allow_single_quoted_strings: false,
    allow_hexadecimal_numbers: false,
    allow_unary_plus_numbers: false,
    allow_bare_decimal_point_numbers: false,
    allow_non_finite_numbers: false,
    allow_extended_string_escapes: false,
};

/// Parses a whole text; the root must be an object, and no object may name a key twice.
pub(crate) fn parse(text: &str) -> Result<Node, Vec<SyntaxError>> {
    let parsed = parse_to_ast(text, &CollectOptions::default(), &STRICT).map_err(|error| {
        let range = error.range();
        vec![SyntaxError {
            span: range.start..range.end,
            problem: lower_first(&error.kind().to_string()),
        }]
    })?;
    let mut repeated = Vec::new();
    match parsed.value {
        Some(root @ ast::Value::Object(_)) => {
            let root = node(&root, &mut repeated);
            if repeated.is_empty() {
                Ok(root)
            } else {
                Err(repeated)
            }
        }
        other => Err(vec![SyntaxError {
            span: other.map_or(0..0, |value| value.start()..value.end()),
            problem: "a model file must be an object: { \"building\": [ … ] }".into(),
        }]),
    }
}

fn node(parsed: &ast::Value<'_>, repeated: &mut Vec<SyntaxError>) -> Node {
    let value = match parsed {
        ast::Value::StringLit(text) => Value::Text(text.value.to_string()),
        ast::Value::NumberLit(number) => match number.value.parse::<i64>() {
            Ok(integer) => Value::Integer(integer),
            Err(_) => Value::Number(number.value.parse().unwrap_or(f64::NAN)),
        },
        ast::Value::BooleanLit(flag) => Value::Flag(flag.value),
        ast::Value::NullKeyword(_) => Value::Other("null"),
        ast::Value::Array(list) => {
            Value::List(list.elements.iter().map(|e| node(e, repeated)).collect())
        }
        ast::Value::Object(object) => Value::Table(table(object, repeated)),
    };
    Node {
        span: parsed.start()..parsed.end(),
        value,
    }
}

fn table(object: &ast::Object<'_>, repeated: &mut Vec<SyntaxError>) -> Table {
    let mut table = Table::default();
    let mut seen = HashSet::new();
    for property in &object.properties {
        let key = property.name.as_str();
        let key_span = property.name.start()..property.name.end();
        if !seen.insert(key) && repeated.len() < 100 {
            repeated.push(SyntaxError {
                span: key_span.clone(),
                problem: format!(
                    "the key \"{}\" appears here twice",
                    crate::quantity::shorten(key)
                ),
            });
        }
        table.entries.push(Entry {
            key: key.to_owned(),
            key_span,
            node: node(&property.value, repeated),
        });
    }
    table
}

fn lower_first(text: &str) -> String {
    let mut chars = text.chars();
    chars
        .next()
        .map_or_else(String::new, |c| c.to_lowercase().chain(chars).collect())
}
