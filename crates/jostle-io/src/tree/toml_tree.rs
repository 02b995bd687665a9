//! The value tree of a TOML text.

use jostle::linear::sort_by_key;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::source::{BACKSLASH, Span};
use crate::tree::{Entry, Node, SyntaxError, Table, Value};

/// Quotation marks of word processors.
const TYPOGRAPHIC: [char; 5] = ['\u{201c}', '\u{201d}', '\u{201e}', '\u{2018}', '\u{2019}'];

/// Parses a whole text; reports every syntax error that the parser can distinguish.
pub(crate) fn parse(text: &str) -> Result<Node, Vec<SyntaxError>> {
    let (root, errors) = DeTable::parse_recoverable(text);
    if errors.is_empty() {
        return Ok(Node {
            span: 0..0,
            value: Value::Table(table(root.get_ref())),
        });
    }
    let mut faults: Vec<SyntaxError> = errors
        .into_iter()
        .map(|error| {
            let span = error.span().unwrap_or(0..0);
            let before = text.get(..span.start).unwrap_or_default();
            let line = before.rsplit('\n').next().unwrap_or_default();
            let after = text.get(span.start..).unwrap_or_default();
            let quoted = after
                .lines()
                .next()
                .unwrap_or_default()
                .contains(TYPOGRAPHIC);
            let problem = match quoted {
                true => "typographic quotation marks: use straight ones, as in \"Left\"".to_owned(),
                false => problem(error.message(), line.trim_start().starts_with("[[")),
            };
            SyntaxError { span, problem }
        })
        .collect();
    sort_by_key(&mut faults, |fault| fault.span.start);
    // One slip often confuses the rest of its line: keep the first message of a line.
    let line = |span: &Span| {
        text.get(..span.start)
            .map_or(0, |t| t.matches('\n').count())
    };
    faults.dedup_by_key(|fault| line(&fault.span));
    // Limits the number of messages for a file that is not TOML.
    faults.truncate(8);
    Err(faults)
}

/// The message of a syntax error in one line, with the remedies for a path of Windows and for a list of tables after a single one.
fn problem(message: &str, in_list: bool) -> String {
    let line = message.trim().replace('\n', "; ");
    if line.contains("escaped value") {
        format!("{line}; {BACKSLASH}")
    } else if line.contains("duplicate key") && in_list {
        format!(
            "{line}: write the first one as a table in double brackets too, or all of them as one list"
        )
    } else {
        line
    }
}

fn table(parsed: &DeTable<'_>) -> Table {
    let mut entries: Vec<Entry> = parsed
        .iter()
        .map(|(key, value)| Entry {
            key: key.get_ref().to_string(),
            key_span: key.span(),
            node: node(value),
        })
        .collect();
    // The parser sorts by name; faults read better in the order of the file.
    sort_by_key(&mut entries, |entry| entry.key_span.start);
    Table { entries }
}

fn node(parsed: &Spanned<DeValue<'_>>) -> Node {
    let value = match parsed.get_ref() {
        DeValue::String(text) => Value::Text(text.to_string()),
        DeValue::Integer(integer) => {
            let digits = integer.as_str();
            match i64::from_str_radix(digits, integer.radix()) {
                Ok(integer) => Value::Integer(integer),
                // Too long for an integer, not for a number.
                Err(_) => Value::Number(digits.parse().unwrap_or(f64::INFINITY)),
            }
        }
        DeValue::Float(number) => Value::Number(number.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(flag) => Value::Flag(*flag),
        DeValue::Datetime(_) => Value::Other("a date"),
        DeValue::Array(list) => Value::List(list.iter().map(node).collect()),
        DeValue::Table(inner) => Value::Table(table(inner)),
    };
    Node {
        span: parsed.span(),
        value,
    }
}
