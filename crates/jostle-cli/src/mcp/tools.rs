//! The tools, each with its arguments.

use std::sync::atomic::{AtomicBool, Ordering};

use jostle::RunEnd;
use jostle_io::{Dimension, Files, parse_option};
use jostle_run::{describe_summary, stopped_by};
use jostle_study::{GapError, GapSettings, critical_gaps};
use serde::Deserialize;
use serde_json::{Value, json};

use super::arguments::{ModelArguments, read, schema};
use super::{explain, study};
use crate::failure::Failure;

/// Whether the assistant has lost interest.
pub(super) type Cancelled<'a> = &'a (dyn Fn() -> bool + Sync);

/// A tool.
pub(super) struct Tool {
    pub(super) name: &'static str,
    description: &'static str,
    /// Schema of its arguments.
    arguments: fn() -> Value,
    /// Answers in text.
    pub(super) call: fn(&Files, Value, Cancelled<'_>) -> Result<String, Failure>,
}

/// Every tool.
pub(super) const TOOLS: [Tool; 6] = [
    Tool {
        name: "check",
        description: "Checks a model without running it: all faults with line and remedy, or masses, periods, contacts, warnings and the expected work.",
        arguments: || schema(&json!({})),
        call: |files, arguments, _| check(files, arguments),
    },
    Tool {
        name: "run",
        description: "Runs a model with contact and without: peaks of floors and contacts, impacts, the gap needed under this motion, warnings, checks. Takes from milliseconds to minutes; check tells how long.",
        arguments: run_schema,
        call: run,
    },
    Tool {
        name: "gap",
        description: "Finds the gap needed under every record of a model, with that of rules and codes for separation, and what happens with the gap of each rule.",
        arguments: gap_schema,
        call: gap,
    },
    Tool {
        name: "study",
        description: "Runs many cases of a model, up to 2000, and returns one row of CSV for each: inputs and results.",
        arguments: study::arguments,
        call: study::study,
    },
    Tool {
        name: "explain",
        description: "Explains a key of model files, a quantity of results, or a check, by name: storey_height, gap[0].width, storey_drift_peak, B2.",
        arguments: explain::arguments,
        call: |_, arguments, _| explain::explain(arguments),
    },
    Tool {
        name: "schema",
        description: "Lists the keys of model files: the sections, or all keys of one section; or the quantities of results, or the checks.",
        arguments: explain::schema_arguments,
        call: |_, arguments, _| explain::schema(arguments),
    },
];

impl Tool {
    /// As the protocol lists it.
    pub(super) fn described(&self) -> rmcp::model::Tool {
        let schema = match (self.arguments)() {
            Value::Object(schema) => schema,
            _ => serde_json::Map::new(),
        };
        rmcp::model::Tool::new(self.name, self.description, schema)
            .with_annotations(rmcp::model::ToolAnnotations::new().read_only(true))
    }
}

fn check(files: &Files, arguments: Value) -> Result<String, Failure> {
    let asked: ModelArguments = read(arguments, &schema(&json!({})))?;
    Ok(jostle_run::check(&asked.open(files)?)?.text)
}

#[derive(Deserialize)]
struct RunArguments {
    #[serde(flatten)]
    model: ModelArguments,
    #[serde(default)]
    json: bool,
}

fn run_schema() -> Value {
    schema(&json!({
        "json": {
            "type": "boolean",
            "description": "Return summary.json with every number instead of a short text. Default: false."
        }
    }))
}

fn run(files: &Files, arguments: Value, cancelled: Cancelled<'_>) -> Result<String, Failure> {
    let asked: RunArguments = read(arguments, &run_schema())?;
    let opened = asked.model.open(files)?;
    if opened.input.records().len() > 1 {
        return Err(Failure::Input(format!(
            "the model has several records; choose one: set = {{\"motion.record\": {:?}}}, or use gap or study",
            opened.input.records()[0]
        )));
    }
    let prepared = opened.prepare()?;
    prepared.check_digits(None)?;
    // With histories, from which filtered accelerations follow, as on the command line.
    let settings = prepared.settings(true);
    prepared.check_histories(settings, true, None)?;
    let stop = AtomicBool::new(false);
    let mut observer = stopped_by(&stop, |_, _| {
        if cancelled() {
            stop.store(true, Ordering::Relaxed);
        }
    });
    let mut ran = prepared.run(settings, &mut observer);
    ran.run_without_contact(settings, &mut observer);
    ran.run_isolation_bounds(true, &mut observer);
    drop(observer);
    match ran.outcome.end_of_all() {
        RunEnd::Completed => {}
        RunEnd::Stopped => return Err(Failure::Stopped),
        RunEnd::Failed(error) => return Err(Failure::Analysis(error.to_string())),
    }
    let summary = ran.summary();
    Ok(match asked.json {
        true => jostle_io::summary_json(&summary),
        false => describe_summary(&summary, &ran.prepared.input, None),
    })
}

#[derive(Deserialize)]
struct GapArguments {
    #[serde(flatten)]
    model: ModelArguments,
    #[serde(default)]
    json: bool,
    tolerance: Option<String>,
}

fn gap_schema() -> Value {
    schema(&json!({
        "json": {
            "type": "boolean",
            "description": "Return every number as JSON instead of a text. Default: false."
        },
        "tolerance": {
            "type": "string",
            "description": "Precision of the gap. Default: \"0.1 mm\"."
        }
    }))
}

fn gap(files: &Files, arguments: Value, cancelled: Cancelled<'_>) -> Result<String, Failure> {
    let asked: GapArguments = read(arguments, &gap_schema())?;
    let text = asked.tolerance.as_deref().unwrap_or("0.1 mm");
    let tolerance = parse_option("tolerance", text, Dimension::Length).map_err(Failure::Input)?;
    if tolerance < 1e-9 {
        return Err(Failure::Input("tolerance: must be at least 1e-9 m".into()));
    }
    let opened = asked.model.open(files)?;
    let settings = GapSettings {
        tolerance,
        codes: opened.input.codes.clone(),
        outcomes: true,
        reversed: true,
        curve: 0,
    };
    let mut found = Vec::new();
    for input in opened.input.each_record() {
        let (motion, _) = opened.plan_of(&input)?;
        match critical_gaps(&input.model, &motion, &settings, cancelled) {
            Ok(gaps) => found.extend(gaps),
            Err(GapError::Stopped) => return Err(Failure::Stopped),
            Err(error @ GapError::Run(_)) => return Err(Failure::Analysis(error.to_string())),
            Err(error) => return Err(input.fault("gap", error.to_string()).into()),
        }
    }
    let title = &opened.input.model.title;
    Ok(match asked.json {
        true => jostle_run::gap_json(title, &found, &opened.input.warnings),
        false => crate::gap::describe(title, &found),
    })
}
