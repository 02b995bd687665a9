//! Records of NHERI SimCenter: JSON with `dT` and `data_x`, `data_y` or `data_z`, or an event with its time series. They state no unit.

use serde::Deserialize;

use crate::record::channel::Direction;
use crate::record::contents::{Contents, Scale, Trace};
use crate::record::error::RecordError;
use crate::record::formats::RecordFormat;
use crate::record::header::malformed;
use crate::record::lines::LineMap;

const FORMAT: RecordFormat = RecordFormat::SimCenter;

/// A record, or a file around one.
#[derive(Default, Deserialize)]
#[serde(default)]
struct RecordTable {
    name: String,
    #[serde(rename = "dT")]
    step: Option<f64>,
    #[serde(rename = "numSteps")]
    count: Option<usize>,
    data_x: Option<Vec<f64>>,
    data_y: Option<Vec<f64>>,
    data_z: Option<Vec<f64>>,
    #[serde(rename = "Events")]
    events: Vec<Event>,
}

/// An event, whose series are its components.
#[derive(Default, Deserialize)]
#[serde(default)]
struct Event {
    name: String,
    #[serde(rename = "dT")]
    step: Option<f64>,
    #[serde(rename = "numSteps")]
    count: Option<usize>,
    #[serde(rename = "timeSeries")]
    series: Vec<Series>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Series {
    name: String,
    #[serde(rename = "dT")]
    step: Option<f64>,
    data: Option<Vec<f64>>,
}

/// Reads the components as channels `x`, `y` and `z`.
pub(crate) fn read(bytes: &[u8]) -> Result<Contents, RecordError> {
    let table: RecordTable = serde_json::from_slice(without_mark(bytes))
        .map_err(|error| malformed(FORMAT, error.line().max(1), error.to_string()))?;
    let mut contents = Contents::new(FORMAT, Scale::Loose);
    contents.event = table.name;
    let mut count = table.count;
    let mut found = vec![
        ("x", table.step, table.data_x),
        ("y", table.step, table.data_y),
        ("z", table.step, table.data_z),
    ];
    if let Some(event) = table.events.into_iter().next() {
        contents.event = event.name;
        count = count.or(event.count);
        for series in event.series {
            for (component, step, values) in &mut found {
                if values.is_none() && series.name == format!("data_{component}") {
                    (*step, *values) = (series.step.or(event.step), series.data.clone());
                }
            }
        }
    }
    let fault = |problem: String| malformed(FORMAT, 1, problem);
    for (component, step, values) in found {
        let Some(values) = values else { continue };
        if step.is_some_and(|step| step <= 0.0) {
            return Err(fault(format!(
                "dT of data_{component} must be greater than 0"
            )));
        }
        if let Some(count) = count.filter(|candidate| *candidate != values.len()) {
            return Err(fault(format!(
                "data_{component} has {} values, numSteps says {count}",
                values.len()
            )));
        }
        let mut lines = LineMap::default();
        lines.note(1, values.len());
        contents.traces.push(Trace {
            name: component.to_owned(),
            direction: match component {
                "z" => Direction::Vertical,
                _ => Direction::Horizontal,
            },
            unit: None,
            step,
            values,
            lines,
            peak: None,
        });
    }
    if contents.traces.is_empty() {
        return Err(fault("has none of data_x, data_y and data_z".to_owned()));
    }
    Ok(contents)
}

/// Whether a text is a table of JSON.
pub(crate) fn is_table(bytes: &[u8]) -> bool {
    let mut marks = without_mark(bytes)
        .iter()
        .filter(|without_mark| !without_mark.is_ascii_whitespace());
    marks.next() == Some(&b'{') && marks.next() == Some(&b'"')
}

/// Windows writes a mark before the text.
fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}
