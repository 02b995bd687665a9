//! Messages between page and server, as JSON. A frame alone is binary: see [`binary`].

use jostle_io::{InputError, Knob, TreeValue};
use serde::{Deserialize, Serialize};

/// What the page asks.
#[derive(Debug, Deserialize)]
#[serde(tag = "op", rename_all = "kebab-case")]
pub(crate) enum Request {
    /// Change a model and run it.
    Run(Run),
    /// Stop the run.
    Stop,
    /// Results over the range of one key.
    Curve(Curve),
    /// Stop the curve.
    StopCurve,
    /// The report of a run as a file.
    Report(Run),
    /// The study that computes a curve in full, as a file.
    Study(Curve),
}

/// A model and what to change in it.
#[derive(Clone, Debug, Deserialize)]
pub(crate) struct Run {
    /// Number by which the answer refers to the request.
    pub(crate) id: u64,
    /// Text of the model file.
    pub(crate) text: String,
    /// Paths, and values as typed; an empty one removes the key.
    #[serde(default)]
    pub(crate) edits: Vec<(String, String)>,
    /// Which of several records of the model to take, from 0.
    #[serde(default)]
    pub(crate) record: usize,
}

/// A curve over one key.
#[derive(Clone, Debug, Deserialize)]
pub(crate) struct Curve {
    #[serde(flatten)]
    pub(crate) run: Run,
    #[serde(flatten)]
    pub(crate) axis: Axis,
    /// Second key of a map.
    #[serde(default)]
    pub(crate) across: Option<Axis>,
    /// Names of records; empty for that of the model.
    #[serde(default)]
    pub(crate) records: Vec<String>,
}

/// Values of one key at equal distances.
#[derive(Clone, Debug, Deserialize)]
pub(crate) struct Axis {
    /// Where the value goes.
    pub(crate) path: String,
    /// Unit of the values.
    pub(crate) unit: String,
    /// First and last value.
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) points: usize,
    /// Whether values are whole numbers.
    #[serde(default)]
    pub(crate) whole: bool,
}

impl Axis {
    /// Whether the values are widths of gaps.
    pub(crate) fn is_width(&self) -> bool {
        self.path.starts_with("gap") && self.path.ends_with(".width")
    }

    /// Value of a point, from 0, without digits that come from arithmetic.
    pub(crate) fn value(&self, index: usize, count: usize) -> f64 {
        let share = index as f64 / (count - 1) as f64;
        let x = self.from + share * (self.to - self.from);
        let x = format!("{x:.9e}").parse().unwrap_or(x);
        if self.whole { x.round() } else { x }
    }

    /// A value as the model file takes it.
    pub(crate) fn put(&self, x: f64) -> TreeValue {
        if self.whole {
            TreeValue::Integer(x as i64)
        } else if self.unit.is_empty() {
            TreeValue::Number(x)
        } else {
            TreeValue::Text(format!("{x} {}", self.unit))
        }
    }
}

/// What the server says.
#[derive(Debug, Serialize)]
#[serde(tag = "op", rename_all = "kebab-case")]
pub(crate) enum Reply<'a> {
    /// First message: the model that was opened.
    Hello {
        name: &'a str,
        text: &'a str,
        /// Version of the engine.
        version: &'static str,
        /// Names of records to choose from.
        records: Vec<String>,
        /// Its values; none if it cannot be read.
        knobs: Vec<Knob>,
    },
    /// The model cannot be run as it stands.
    Faults {
        id: u64,
        /// Text with the changes in it, if they could be made.
        text: Option<String>,
        knobs: Option<Vec<Knob>>,
        faults: Vec<Fault>,
    },
    /// A long run: share done. A page with the engine inside hears it from its worker.
    #[cfg(not(target_family = "wasm"))]
    Progress { id: u64, share: f64 },
    /// Accuracy and notes of a run whose frame was sent, once it is known whether its results are sensitive.
    Accuracy {
        id: u64,
        text: String,
        notes: Vec<String>,
    },
    /// The run was stopped.
    Stopped { id: u64 },
    /// Points of a curve.
    Points {
        id: u64,
        points: Vec<Point>,
        /// Points of the whole curve.
        of: usize,
    },
    /// Gaps that rules ask for, and the smallest without pounding.
    Marks { id: u64, marks: Vec<Mark> },
    /// Why a curve has no points, or no marks.
    NoCurve { id: u64, problem: String },
    /// A file to keep.
    File {
        id: u64,
        name: String,
        kind: &'a str,
        text: String,
    },
}

/// Results at one value, or at one value of each of two keys.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Point {
    /// Index of the record.
    pub(crate) record: usize,
    /// Value, in the unit of the curve.
    pub(crate) x: f64,
    /// Value of the second key of a map, in its unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) z: Option<f64>,
    /// Peak force \[kN\], impacts, storey drift \[%\], floor acceleration \[m/s²\]; `None` where the run failed.
    pub(crate) y: Option<[f64; 4]>,
}

/// A width on the axis of gaps.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Mark {
    pub(crate) name: String,
    pub(crate) source: String,
    /// Width \[m\].
    pub(crate) width: f64,
    /// Whether it is the smallest gap without pounding, and no rule.
    pub(crate) needed: bool,
}

/// A fault beside its field.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Fault {
    pub(crate) path: String,
    pub(crate) line: Option<usize>,
    pub(crate) column: Option<usize>,
    pub(crate) problem: String,
    pub(crate) remedy: Option<String>,
}

/// Faults in the reader's words.
pub(crate) fn faults(error: &InputError) -> Vec<Fault> {
    let one = |fault: &jostle_io::Fault| Fault {
        path: fault.path.clone(),
        line: fault.place.as_ref().map(|place| place.line),
        column: fault.place.as_ref().map(|place| place.column),
        problem: fault.problem.clone(),
        remedy: fault.remedy.clone(),
    };
    error.faults.iter().map(one).collect()
}

/// A fault without a place.
pub(crate) fn fault(path: &str, problem: impl Into<String>) -> Vec<Fault> {
    vec![Fault {
        path: path.to_owned(),
        line: None,
        column: None,
        problem: problem.into(),
        remedy: None,
    }]
}

/// A binary message: the length of a JSON text in bytes (u32, little-endian), the text padded with spaces to a multiple
/// of four bytes, and numbers (f32, little-endian).
pub(crate) fn binary(json: &str, numbers: &[f32]) -> Vec<u8> {
    let length = json.len().next_multiple_of(4);
    let mut bytes = Vec::with_capacity(4 + length + 4 * numbers.len());
    bytes.extend_from_slice(&(length as u32).to_le_bytes());
    bytes.extend_from_slice(json.as_bytes());
    bytes.resize(4 + length, b' ');
    for number in numbers {
        bytes.extend_from_slice(&number.to_le_bytes());
    }
    bytes
}
