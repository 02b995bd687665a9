//! Quantities of arguments: numbers in SI, or texts with units.

use jostle_io::{Dimension, parse_quantity};
use pyo3::prelude::*;

use crate::error::argument_error;

/// Reads a quantity into SI; `kind` is "length", "time", "acceleration", "frequency", "force", "mass", "speed" or "number".
#[pyfunction]
pub(crate) fn quantity(text: &str, kind: &str) -> PyResult<f64> {
    let dimension = match kind {
        "length" => Dimension::Length,
        "time" => Dimension::Time,
        "acceleration" => Dimension::Acceleration,
        "frequency" => Dimension::Frequency,
        "force" => Dimension::Force,
        "mass" => Dimension::Mass,
        "speed" => Dimension::Speed,
        _ => Dimension::Dimensionless,
    };
    parse_quantity(text, dimension).map_err(|error| argument_error(error.to_string()))
}
