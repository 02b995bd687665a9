//! Distributions of a study file.

use super::factor::{Measured, measure};
use crate::keys::{DISTRIBUTIONS, Section};
use crate::model_tree::{TreeValue, quantity_text};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// A distribution, possibly truncated, in the unit in which it was written.
#[derive(Clone, Debug, PartialEq)]
pub struct Distribution {
    /// Its shape.
    pub shape: Shape,
    /// Nothing below this is drawn.
    pub low: Option<f64>,
    /// Nothing above this is drawn.
    pub high: Option<f64>,
    /// Unit of all of these, as written.
    pub unit: String,
    /// Size of that unit in SI.
    pub unit_size: f64,
}

/// Shape of a distribution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// Equally likely between two values.
    Uniform {
        /// Least.
        from: f64,
        /// Greatest.
        to: f64,
    },
    /// Normal.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation, > 0.
        deviation: f64,
    },
    /// Lognormal.
    LogNormal {
        /// Median, > 0.
        median: f64,
        /// Standard deviation of the natural logarithm, > 0 \[–\].
        dispersion: f64,
    },
}

impl Distribution {
    /// The value for the model.
    #[must_use]
    pub fn value(&self, number: f64) -> TreeValue {
        if self.unit.is_empty() {
            TreeValue::Number(number)
        } else {
            TreeValue::Text(quantity_text(number, &self.unit))
        }
    }
}

pub(super) fn read(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    dimension: Option<Dimension>,
) -> Option<Distribution> {
    let view = reader.open(field, &[Section::Distribution])?;
    let Some(kind) = reader.get(&view, "kind") else {
        reader.missing(
            &view,
            "kind",
            "add kind = \"uniform\", \"normal\" or \"lognormal\"",
        );
        return None;
    };
    let kind = reader.choice(&kind, DISTRIBUTIONS, &[])?;
    let allowed: &[&str] = match kind {
        "uniform" => &["kind", "from", "to"],
        "normal" => &["kind", "mean", "deviation", "cov", "low", "high"],
        _ => &["kind", "median", "mean", "dispersion", "cov", "low", "high"],
    };
    for key in [
        "from",
        "to",
        "mean",
        "deviation",
        "cov",
        "median",
        "dispersion",
        "low",
        "high",
    ] {
        if let Some(field) = reader.get(&view, key).filter(|_| !allowed.contains(&key)) {
            *reader.bad(&field, format!("does not go with a {kind} distribution")) =
                Some(format!("known here: {}", allowed.join(", ")));
        }
    }
    let mut units = Units {
        dimension,
        unit: None,
    };
    let low = units.optional(reader, &view, "low")?;
    let high = units.optional(reader, &view, "high")?;
    let shape = match kind {
        "uniform" => {
            let from = units.required(reader, &view, "from")?;
            let to = units.required(reader, &view, "to")?;
            if from >= to {
                reader.bad(field, "from must be smaller than to");
                return None;
            }
            Shape::Uniform { from, to }
        }
        "normal" => {
            let mean = units.required(reader, &view, "mean")?;
            let deviation = match positive_number(reader, &view, "cov")? {
                Some(cov) => cov * mean.abs(),
                None => units.required(reader, &view, "deviation")?,
            };
            if deviation <= 0.0 {
                reader.bad(field, "the standard deviation must be greater than zero");
                return None;
            }
            Shape::Normal { mean, deviation }
        }
        _ => lognormal(reader, &view, field, &mut units)?,
    };
    if let (Some(low), Some(high)) = (low, high)
        && low >= high
    {
        reader.bad(field, "low must be smaller than high");
        return None;
    }
    let (unit, unit_size) = units.unit.unwrap_or((String::new(), 1.0));
    Some(Distribution {
        shape,
        low,
        high,
        unit,
        unit_size,
    })
}

/// A lognormal by median or mean, and by dispersion or coefficient of variation.
fn lognormal(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    field: &Field<'_>,
    units: &mut Units,
) -> Option<Shape> {
    let dispersion = match positive_number(reader, view, "cov")? {
        Some(cov) => libm::log(cov.mul_add(cov, 1.0)).sqrt(),
        None => match positive_number(reader, view, "dispersion")? {
            Some(dispersion) => dispersion,
            None => {
                reader.missing(
                    view,
                    "dispersion",
                    "add dispersion = 0.3, the standard deviation of the logarithm, or cov = 0.3",
                );
                return None;
            }
        },
    };
    let median = match units.optional(reader, view, "mean")? {
        Some(mean) => mean * libm::exp(-0.5 * dispersion * dispersion),
        None => units.required(reader, view, "median")?,
    };
    if median <= 0.0 {
        reader.bad(field, "the median must be greater than zero");
        return None;
    }
    Some(Shape::LogNormal { median, dispersion })
}

/// A plain number greater than zero, if it is there.
fn positive_number(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    key: &'static str,
) -> Option<Option<f64>> {
    match reader.get(view, key) {
        Some(field) => reader.positive(&field, Dimension::Dimensionless).map(Some),
        None => Some(None),
    }
}

/// Holds all quantities of a table to one unit.
struct Units {
    dimension: Option<Dimension>,
    unit: Option<(String, f64)>,
}

impl Units {
    /// `None` after a fault, `Some(None)` when the key is absent.
    fn optional(
        &mut self,
        reader: &mut Reader<'_>,
        view: &View<'_>,
        key: &'static str,
    ) -> Option<Option<f64>> {
        let Some(field) = reader.get(view, key) else {
            return Some(None);
        };
        let Measured { number, unit, size } = measure(reader, &field, self.dimension)?;
        match &self.unit {
            Some((known, _)) if *known != unit => {
                let problem =
                    format!("has the unit \"{unit}\" where another value has \"{known}\"");
                *reader.bad(&field, problem) = Some("write all values with one unit".into());
                None
            }
            _ => {
                self.unit = Some((unit, size));
                Some(Some(number))
            }
        }
    }

    fn required(
        &mut self,
        reader: &mut Reader<'_>,
        view: &View<'_>,
        key: &'static str,
    ) -> Option<f64> {
        match self.optional(reader, view, key)? {
            Some(number) => Some(number),
            None => {
                reader.missing(view, key, format!("add {key}"));
                None
            }
        }
    }
}
