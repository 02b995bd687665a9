//! Evaluations of a study file: fragility curves and curves of demand over intensity.

use crate::choices::FragilityMethod;
use crate::keys::{FRAGILITY_METHODS, Section};
use crate::quantity::{Dimension, split_number};
use crate::reader::{Field, Reader, View};
use crate::tree::Value;
use crate::unit::Unit;

/// A fragility curve to fit.
#[derive(Clone, Debug, PartialEq)]
pub struct FragilityWanted {
    /// Column with the intensity.
    pub intensity: String,
    /// Column with the demand.
    pub demand: String,
    /// The event is a demand above this \[SI\]; zero with `impact_count` is pounding.
    pub threshold: f64,
    /// Factors; one curve is fitted for each of their values.
    pub by: Vec<String>,
    /// How it is fitted.
    pub method: FragilityMethod,
    /// Resampled fits for the confidence band; 0 for none.
    pub bootstrap: usize,
    /// Confidence of the band, between 0 and 1 \[–\].
    pub confidence: f64,
}

/// Curves of demand over intensity, one for each record or other varied key.
#[derive(Clone, Debug, PartialEq)]
pub struct IdaWanted {
    /// Column with the intensity.
    pub intensity: String,
    /// Column with the demand.
    pub demand: String,
}

pub(super) fn fragilities(reader: &mut Reader<'_>, view: &View<'_>) -> Vec<FragilityWanted> {
    tables(reader, view, "fragility")
        .iter()
        .filter_map(|field| fragility(reader, field))
        .collect()
}

pub(super) fn idas(reader: &mut Reader<'_>, view: &View<'_>) -> Vec<IdaWanted> {
    tables(reader, view, "ida")
        .iter()
        .filter_map(|field| {
            let view = reader.open(field, &[Section::Ida])?;
            Some(IdaWanted {
                intensity: column(reader, &view, "intensity", "intensity = \"pga_m_s2\"")?,
                demand: column(reader, &view, "demand", "demand = \"peak_force_n\"")?,
            })
        })
        .collect()
}

/// One table, or a list of them.
fn tables<'n>(reader: &mut Reader<'_>, view: &View<'n>, key: &'static str) -> Vec<Field<'n>> {
    match reader.get(view, key) {
        Some(field) => match field.entries() {
            Some(entries) => entries,
            None => vec![field],
        },
        None => Vec::new(),
    }
}

fn fragility(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<FragilityWanted> {
    let view = reader.open(field, &[Section::Fragility])?;
    let intensity = column(reader, &view, "intensity", "intensity = \"pga_m_s2\"");
    let demand = match reader.get(&view, "demand") {
        Some(field) => reader.text(&field),
        None => Some("impact_count".to_owned()),
    };
    let threshold = match reader.get(&view, "threshold") {
        Some(field) => threshold(reader, &field),
        None => Some(0.0),
    };
    let by = match reader.get(&view, "by") {
        Some(field) if field.entries().is_some() => texts(reader, &field),
        Some(field) => reader.text(&field).map(|name| vec![name]),
        None => Some(Vec::new()),
    };
    let method = match reader.get(&view, "method") {
        Some(field) => {
            FragilityMethod::from_name(reader.choice(&field, FRAGILITY_METHODS, &[])?)?
        }
        None => FragilityMethod::MultipleStripe,
    };
    let bootstrap = match reader.get(&view, "bootstrap") {
        Some(field) => reader.count(&field)?,
        None => 500,
    };
    let confidence = match reader.get(&view, "confidence") {
        Some(field) => {
            let value = reader.quantity(&field, Dimension::Dimensionless)?;
            if !(value > 0.0 && value < 1.0) {
                reader.bad(&field, format!("must lie between 0 and 1, found {value}"));
                return None;
            }
            value
        }
        None => 0.9,
    };
    let (threshold, method) = (threshold?, method);
    if method != FragilityMethod::MultipleStripe && threshold <= 0.0 {
        *reader.bad(
            field,
            "the cloud methods need a threshold greater than zero",
        ) = Some(
            "add demand = \"closing_peak_m\" and threshold = \"50 mm\", or method = \"stripes\""
                .into(),
        );
        return None;
    }
    Some(FragilityWanted {
        intensity: intensity?,
        demand: demand?,
        threshold,
        by: by?,
        method,
        bootstrap,
        confidence,
    })
}

/// A number of any dimension, in SI.
fn threshold(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<f64> {
    let number = match &field.node.value {
        Value::Integer(value) => Some(*value as f64),
        Value::Number(value) => Some(*value),
        Value::Text(text) => split_number(text)
            .and_then(|(number, unit)| Some(number * Unit::parse(unit).ok()?.factor)),
        _ => None,
    };
    if number.is_none_or(|number| !number.is_finite()) {
        let found = field.node.describe();
        reader.bad(
            field,
            format!("expected a number, or one with a unit such as \"500 kN\", found {found}"),
        );
    }
    number.filter(|number| number.is_finite())
}

fn column(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    key: &'static str,
    example: &str,
) -> Option<String> {
    match reader.get(view, key) {
        Some(field) => reader.text(&field),
        None => {
            reader.missing(
                view,
                key,
                format!("name a column of the results: {example}"),
            );
            None
        }
    }
}

/// A list of texts.
pub(super) fn texts(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<Vec<String>> {
    let Some(entries) = field.entries() else {
        let found = field.node.describe();
        reader.bad(field, format!("expected a list of texts, found {found}"));
        return None;
    };
    entries.iter().map(|entry| reader.text(entry)).collect()
}
