//! Keys, quantities and checks by name, from the pages that list them.

use jostle_io::{check_reference, model_reference, nearest_name, quantity_reference};
use serde::Deserialize;
use serde_json::{Value, json};

use super::arguments::read;
use crate::failure::Failure;

#[derive(Deserialize)]
struct ExplainArguments {
    name: String,
}

pub(super) fn arguments() -> Value {
    json!({
        "type": "object",
        "additionalProperties": false,
        "required": ["name"],
        "properties": {
            "name": {
                "type": "string",
                "description": "A key or its path, a quantity or a column, or a check: storey_height, gap[0].width, base_shear_peak_n, B2."
            }
        }
    })
}

/// A row of a table: heading of its section, names of its columns, cells.
struct Row<'p> {
    heading: &'p str,
    columns: Vec<&'p str>,
    cells: Vec<&'p str>,
}

/// All rows of the tables of a page.
fn rows(page: &str) -> Vec<Row<'_>> {
    let mut rows = Vec::new();
    let (mut heading, mut columns) = ("", Vec::new());
    for line in page.lines() {
        if let Some(title) = line.strip_prefix("## ") {
            heading = title;
            columns.clear();
        } else if line.starts_with("|---") {
        } else if line.starts_with('|') {
            let cells: Vec<&str> = line.trim_matches('|').split(" | ").map(str::trim).collect();
            if columns.is_empty() {
                columns = cells;
            } else {
                rows.push(Row {
                    heading,
                    columns: columns.clone(),
                    cells,
                });
            }
        } else {
            columns.clear();
        }
    }
    rows
}

pub(super) fn explain(given: Value) -> Result<String, Failure> {
    let asked: ExplainArguments = read(given, &arguments())?;
    // Of a path the last key.
    let last = asked.name.trim().rsplit('.').next().unwrap_or_default();
    let name = last.split('[').next().unwrap_or_default();
    let mut text = String::new();
    let mut names = Vec::new();
    let pages = [
        ("Key of model files", model_reference()),
        ("Quantity of results", quantity_reference()),
        ("Check", check_reference()),
    ];
    for (what, page) in &pages {
        for row in rows(page) {
            let trim_matches = row.cells.iter().take(2).map(|cell| cell.trim_matches('`'));
            if trim_matches.clone().any(|cell| cell == name) {
                text += &format!("{what}, {}\n", row.heading);
                for (column, cell) in row.columns.iter().zip(&row.cells) {
                    if !cell.is_empty() {
                        text += &format!("  {column}: {cell}\n");
                    }
                }
            }
            names.extend(
                row.cells
                    .first()
                    .map(|cell| cell.trim_matches('`').to_owned()),
            );
        }
    }
    if !text.is_empty() {
        return Ok(text);
    }
    let nearest = nearest_name(name, names.iter().map(|name| &name[..]));
    let hint = nearest.map_or_else(String::new, |nearest| format!("; did you mean {nearest}?"));
    Err(Failure::Input(format!(
        "there is no key, quantity or check {name:?}{hint}"
    )))
}

#[derive(Deserialize)]
struct SchemaArguments {
    #[serde(default)]
    of: Of,
    section: Option<String>,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Of {
    #[default]
    Model,
    Results,
    Checks,
}

pub(super) fn schema_arguments() -> Value {
    json!({
        "type": "object",
        "additionalProperties": false,
        "properties": {
            "of": {
                "type": "string",
                "enum": ["model", "results", "checks"],
                "description": "Keys of model files, quantities of results, or checks. Default: model."
            },
            "section": {
                "type": "string",
                "description": "Heading of a section, or words of it, such as [[gap]] or shear. Without it the headings are listed."
            }
        }
    })
}

pub(super) fn schema(given: Value) -> Result<String, Failure> {
    let asked: SchemaArguments = read(given, &schema_arguments())?;
    let page = match asked.of {
        Of::Model => model_reference(),
        Of::Results => quantity_reference(),
        Of::Checks => check_reference(),
    };
    let mut sections = page.split("\n## ");
    let head = sections.next().unwrap_or_default();
    let sections: Vec<&str> = sections.collect();
    let heading = |section: &&str| section.lines().next().unwrap_or_default().replace('`', "");
    let headings: Vec<String> = sections.iter().map(heading).collect();
    let Some(wanted) = asked.section else {
        return Ok(format!("{head}\nSections:\n{}\n", headings.join("\n")));
    };
    let wanted = wanted.replace('`', "");
    let chosen: Vec<usize> = match headings.iter().position(|heading| *heading == wanted) {
        Some(exact) => vec![exact],
        None => (0..headings.len())
            .filter(|&at| headings[at].contains(&wanted))
            .collect(),
    };
    if chosen.is_empty() {
        return Err(Failure::Input(format!(
            "section: there is none with {wanted:?}; there are {}",
            headings.join("; ")
        )));
    }
    let text = chosen.iter().map(|&at| format!("## {}\n", sections[at]));
    Ok(text.collect())
}
