//! Reading the stored reference numbers.

use serde_json::Value;

/// A stored document.
pub(crate) fn document(text: &str) -> Value {
    serde_json::from_str(text).expect("stored data are valid JSON")
}

/// The value at a path such as `/expected/F_max`.
pub(crate) fn at<'a>(value: &'a Value, path: &str) -> &'a Value {
    value
        .pointer(path)
        .unwrap_or_else(|| panic!("stored data have {path}"))
}

/// The number at a path.
pub(crate) fn number(value: &Value, path: &str) -> f64 {
    at(value, path)
        .as_f64()
        .unwrap_or_else(|| panic!("{path} is a number"))
}

/// The list of numbers at a path; other values are omitted.
pub(crate) fn numbers(value: &Value, path: &str) -> Vec<f64> {
    list(value, path).iter().filter_map(Value::as_f64).collect()
}

/// The list at a path.
pub(crate) fn list<'a>(value: &'a Value, path: &str) -> &'a [Value] {
    at(value, path)
        .as_array()
        .unwrap_or_else(|| panic!("{path} is a list"))
}

/// The entries of the table at a path.
pub(crate) fn entries<'a>(
    value: &'a Value,
    path: &str,
) -> impl Iterator<Item = (&'a str, &'a Value)> + use<'a> {
    let table = at(value, path)
        .as_object()
        .unwrap_or_else(|| panic!("{path} is a table"));
    table.iter().map(|(key, entry)| (key.as_str(), entry))
}
