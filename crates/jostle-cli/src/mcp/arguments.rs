//! The model that a tool is asked about.

use std::collections::BTreeMap;
use std::path::Path;

use jostle_io::{Files, Format, ModelTree, TreeValue, model_names, model_text};
use jostle_run::{EXAMPLE, Opened, name_of};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};

use crate::failure::Failure;

/// Largest model file \[bytes\].
const LARGEST: usize = 8 << 20;

/// Which model, and what to change in it.
#[derive(Debug, Default, Deserialize)]
pub(super) struct ModelArguments {
    /// A file in the folder, or a built-in example.
    model: Option<String>,
    /// The text of a model file instead.
    text: Option<String>,
    /// Values by path, such as `gap[*].width`.
    #[serde(default)]
    set: BTreeMap<String, Value>,
}

/// Schema of [`ModelArguments`], with further properties.
pub(super) fn schema(more: &Value) -> Value {
    let mut schema = json!({
        "type": "object",
        "additionalProperties": false,
        "properties": {
            "model": {
                "type": "string",
                "description": "Model file in the folder of the server (TOML or JSON), or a built-in example: paper, paper-inelastic. Default: paper."
            },
            "text": {
                "type": "string",
                "description": "Text of a model file, instead of model."
            },
            "set": {
                "type": "object",
                "description": "Values to change, by path: {\"gap[*].width\": \"30 mm\", \"motion.pga\": \"0.3 g\", \"building[0].floor_mass\": \"40 t\"}."
            },
        },
    });
    if let (Some(properties), Some(more)) = (schema["properties"].as_object_mut(), more.as_object())
    {
        properties.extend(more.clone());
    }
    schema
}

/// Reads the arguments of a tool; unknown ones are refused with those that exist.
pub(super) fn read<T: DeserializeOwned>(arguments: Value, schema: &Value) -> Result<T, Failure> {
    let known = schema["properties"].as_object();
    let given = arguments.as_object().into_iter().flatten();
    for (name, _) in given {
        if known.is_some_and(|known| !known.contains_key(name)) {
            let names: Vec<&str> = known
                .into_iter()
                .flatten()
                .map(|(key, _)| &key[..])
                .collect();
            return Err(Failure::Input(format!(
                "there is no argument {name:?}; there are {}",
                names.join(", ")
            )));
        }
    }
    serde_json::from_value(arguments).map_err(|error| Failure::Input(format!("arguments: {error}")))
}

impl ModelArguments {
    /// The model with its changes, which may read what these files allow.
    pub(super) fn tree(&self, files: &Files) -> Result<ModelTree, Failure> {
        let mut tree = self.unchanged(files)?;
        for (path, value) in &self.set {
            let value = value_of(path, value)?;
            tree.set(path, &value)
                .map_err(|error| Failure::Input(format!("set: {error}")))?;
        }
        Ok(tree)
    }

    fn unchanged(&self, files: &Files) -> Result<ModelTree, Failure> {
        let name = match (&self.model, &self.text) {
            (Some(_), Some(_)) => {
                return Err(Failure::Input(
                    "give either model, a file, or text, not both".into(),
                ));
            }
            (None, Some(text)) => {
                return Ok(ModelTree::parse_with(
                    "text",
                    text,
                    Format::of_text(text),
                    files.afresh(),
                )?);
            }
            (name, None) => name.as_deref().unwrap_or(EXAMPLE),
        };
        let path = Path::new(name);
        let bytes = match files.read(name, LARGEST) {
            Ok(bytes) => bytes,
            // A file takes precedence over a built-in model of the same name.
            Err(error) => match model_text(name) {
                Some(text) => text.as_bytes().to_vec(),
                None => {
                    let builtin = model_names().join(", ");
                    return Err(Failure::Input(format!(
                        "{name}: {error}; name a file in the folder of the server, or {builtin}"
                    )));
                }
            },
        };
        let text = String::from_utf8(bytes)
            .map_err(|_| Failure::Input(format!("{name}: is not UTF-8 text")))?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let format = Format::of_path(path);
        Ok(ModelTree::parse_with(
            name,
            &text,
            format,
            files.starting_in(folder),
        )?)
    }

    /// The model, read and assembled.
    pub(super) fn open(&self, files: &Files) -> Result<Opened, Failure> {
        let name = self.model.as_deref().map(Path::new).map(name_of);
        let input = self.tree(files)?.input()?;
        Ok(Opened::new(input, name.unwrap_or_else(|| "model".into()))?)
    }
}

/// A value of JSON as one of a model file.
fn value_of(path: &str, value: &Value) -> Result<TreeValue, Failure> {
    let no_value = || {
        Failure::Input(format!(
            "set: {path}: expected a text, a number, a flag, a list or a table"
        ))
    };
    Ok(match value {
        Value::Null => return Err(no_value()),
        Value::Bool(flag) => TreeValue::Flag(*flag),
        Value::String(text) => TreeValue::Text(text.clone()),
        Value::Number(number) => match number.as_i64() {
            Some(whole) => TreeValue::Integer(whole),
            None => TreeValue::Number(number.as_f64().ok_or_else(no_value)?),
        },
        Value::Array(list) => {
            let list = list.iter().map(|entry| value_of(path, entry));
            TreeValue::List(list.collect::<Result<_, _>>()?)
        }
        Value::Object(table) => {
            let table = table
                .iter()
                .map(|(key, entry)| Ok((key.clone(), value_of(path, entry)?)));
            TreeValue::Table(table.collect::<Result<_, Failure>>()?)
        }
    })
}
