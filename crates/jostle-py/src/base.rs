//! The text of a model file, to vary, to change and to save it.

use std::collections::{BTreeMap, HashMap};
use std::path::PathBuf;

use jostle_io::{Files, Format, InputError, ModelTree, TreeValue};
use pyo3::prelude::*;

use crate::error::{argument_error, input_error};

/// Name, text, whether it is JSON, folder, and files in memory by name, of a model.
pub(crate) type Base = (String, String, bool, PathBuf, HashMap<String, String>);

pub(crate) fn format_of(json: bool) -> Format {
    if json { Format::Json } else { Format::Toml }
}

pub(crate) fn tree_of((name, text, json, folder, files): Base) -> Result<ModelTree, InputError> {
    let held: BTreeMap<String, Vec<u8>> = files
        .into_iter()
        .map(|(name, text)| (name, text.into_bytes()))
        .collect();
    let files = Files::beside(&folder).with(held);
    ModelTree::parse_with(&name, &text, format_of(json), files)
}

/// The text of a model with values put in at paths; a value is JSON, `None` removes the key.
#[pyfunction]
pub(crate) fn rewritten(
    py: Python<'_>,
    base: Base,
    edits: Vec<(String, Option<String>)>,
) -> PyResult<String> {
    let (name, json, folder, files) = (base.0.clone(), base.2, base.3.clone(), base.4.clone());
    py.detach(|| {
        let mut tree = tree_of(base).map_err(|error| input_error(&error))?;
        let mut text = tree.text().to_owned();
        for (path, value) in edits {
            let value = value.map(|value| value_of(&value)).transpose()?;
            text = tree
                .rewritten(&path, value.as_ref())
                .map_err(|error| argument_error(error.to_string()))?;
            let next = (
                name.clone(),
                text.clone(),
                json,
                folder.clone(),
                files.clone(),
            );
            tree = tree_of(next).map_err(|error| input_error(&error))?;
        }
        Ok(text)
    })
}

/// The text of a model as TOML.
#[pyfunction]
pub(crate) fn as_toml(base: Base) -> PyResult<String> {
    let tree = tree_of(base).map_err(|error| input_error(&error))?;
    Ok(tree.toml())
}

/// Names of the files that a model names, as written.
#[pyfunction]
pub(crate) fn named_files(py: Python<'_>, base: Base) -> PyResult<Vec<String>> {
    let tree = tree_of(base).map_err(|error| input_error(&error))?;
    Ok(py.detach(|| tree.named_files()))
}

fn value_of(json: &str) -> PyResult<TreeValue> {
    let text = format!("{{\"value\": {json}}}");
    let tree = ModelTree::parse_with("value", &text, Format::Json, Files::held(BTreeMap::new()));
    let tree = tree.map_err(|error| input_error(&error))?;
    let value = tree.values("value").pop();
    value.ok_or_else(|| argument_error("a model cannot hold nothing"))
}
