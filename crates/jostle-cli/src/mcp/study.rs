//! Many cases of a model, in memory as far as the assistant is concerned: the folder of the study goes away.

use jostle_io::{Files, Format, StudyFile};
use jostle_study::{RunSettings, Study, ready_made_names};
use serde::Deserialize;
use serde_json::{Map, Value, json};

use super::arguments::{ModelArguments, read, schema};
use super::tools::Cancelled;
use crate::failure::Failure;

/// Most cases of a study.
const MOST: u64 = 2000;
/// Longest table that is returned \[bytes\].
const LONGEST: usize = 1 << 20;

#[derive(Deserialize)]
struct StudyArguments {
    #[serde(flatten)]
    model: ModelArguments,
    #[serde(default)]
    vary: Map<String, Value>,
    study: Option<String>,
    #[serde(default)]
    columns: Vec<String>,
}

pub(super) fn arguments() -> Value {
    schema(&json!({
        "vary": {
            "type": "object",
            "description": "Values of every key that varies, by path; all combinations are run: {\"gap[*].width\": [\"20 mm\", \"40 mm\"], \"motion.pga\": [\"0.2 g\", \"0.4 g\"]}."
        },
        "study": {
            "type": "string",
            "enum": ready(),
            "description": "A ready-made study of the model instead of vary."
        },
        "columns": {
            "type": "array",
            "items": { "type": "string" },
            "description": "Columns of the table to return; * stands for any characters. Default: inputs, status, impacts, forces, closing."
        }
    }))
}

/// Ready-made studies; those over angles need options of their own.
fn ready() -> Vec<&'static str> {
    let names = ready_made_names().into_iter();
    names.filter(|name| *name != "angles").collect()
}

/// Columns that are returned if none are asked for, beside the inputs.
const USUAL: [&str; 8] = [
    "status",
    "reason",
    "impact_count",
    "peak_force_n",
    "first_impact_s",
    "impulse_n_s",
    "closing_peak_m",
    "pga_m_s2",
];

pub(super) fn study(
    files: &Files,
    given: Value,
    cancelled: Cancelled<'_>,
) -> Result<String, Failure> {
    let asked: StudyArguments = read(given, &arguments())?;
    let tree = asked.model.tree(files)?;
    let study = match (&asked.study, asked.vary.is_empty()) {
        (Some(name), true) if ready().contains(&&name[..]) => {
            let (file, notes) = jostle_study::ready_made(name, Some(tree))?;
            let mut study = Study::new(file)?;
            study.warnings.extend(notes);
            study
        }
        (Some(name), true) => {
            return Err(Failure::Input(format!(
                "study: there is no ready-made study {name:?}; there are {}",
                ready().join(", ")
            )));
        }
        (None, false) => {
            let vary: Vec<Value> = asked
                .vary
                .iter()
                .map(|(path, values)| json!({ "path": path, "values": values }))
                .collect();
            let text = json!({ "vary": vary }).to_string();
            let folder = files.folder();
            let file = StudyFile::parse("vary", &text, Format::Json, folder, Some(tree))?;
            Study::new(file)?
        }
        _ => {
            return Err(Failure::Input(
                "give either vary, values by path, or study, the name of a ready-made one".into(),
            ));
        }
    };
    let cases = study.design.cases;
    if cases > MOST {
        return Err(Failure::Input(format!(
            "the study has {cases} cases, and at most {MOST} are run here; use the command jostle study"
        )));
    }
    let folder = tempfile::tempdir()
        .map_err(|error| Failure::Analysis(format!("no folder can be made: {error}")))?;
    let settings = RunSettings {
        jobs: None,
        shard: 0,
        shards: 1,
        only: None,
    };
    let done = jostle_study::run(
        &study,
        folder.path(),
        &settings,
        cancelled,
        &|_| {},
        &|_| {},
    )?;
    if done.stopped {
        return Err(Failure::Stopped);
    }
    table(&study, folder.path(), &asked.columns, done.failed)
}

/// The rows as CSV with the columns that are wanted.
fn table(
    study: &Study,
    folder: &std::path::Path,
    wanted: &[String],
    failed: u64,
) -> Result<String, Failure> {
    jostle_study::finish(study, folder, true)?;
    let bytes = jostle_io::read_file(&folder.join("cases.csv"), 256 << 20)
        .map_err(|error| Failure::Analysis(format!("the table {error}")))?;
    let text = String::from_utf8_lossy(&bytes);
    let names = split(text.lines().next().unwrap_or_default());
    let inputs = &study.layout.inputs;
    let input = |name: &str| name == "case" || inputs.iter().any(|input| input.name == name);
    let keep: Vec<usize> = (0..names.len())
        .filter(|&index| match wanted.is_empty() {
            true => input(names[index]) || USUAL.contains(&names[index]),
            false => wanted.iter().any(|pattern| matches(pattern, names[index])),
        })
        .collect();
    if keep.is_empty() {
        return Err(Failure::Input(format!(
            "columns: none of {} is in the table; its columns are {}",
            wanted.join(", "),
            names.join(", ")
        )));
    }
    let mut table = String::new();
    for line in text.lines() {
        let cells = split(line);
        let row: Vec<&str> = keep
            .iter()
            .map(|&index| cells.get(index).copied().unwrap_or_default())
            .collect();
        table += &row.join(",");
        table.push('\n');
    }
    if table.len() > LONGEST {
        return Err(Failure::Input(format!(
            "the table has {} bytes, and at most {LONGEST} are returned; name fewer columns",
            table.len()
        )));
    }
    for warning in &study.warnings {
        table += &format!("# warning: {warning}\n");
    }
    if failed > 0 {
        table += &format!("# {failed} cases could not be computed: see status and reason\n");
    }
    Ok(table)
}

/// Cells of a line of CSV, quotes included.
fn split(line: &str) -> Vec<&str> {
    let mut cells = Vec::new();
    let (mut start, mut quoted) = (0, false);
    for (at, byte) in line.bytes().enumerate() {
        match byte {
            b'"' => quoted = !quoted,
            b',' if !quoted => {
                cells.push(&line[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    cells.push(&line[start..]);
    cells
}

/// Whether a name has the form of a pattern, in which `*` stands for any characters.
fn matches(pattern: &str, name: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == name,
        Some((head, rest)) => name.strip_prefix(head).is_some_and(|left| {
            (0..=left.len())
                .filter(|&at| left.is_char_boundary(at))
                .any(|at| matches(rest, &left[at..]))
        }),
    }
}
