//! Two free masses under contact laws.

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;

use jostle::LawKind;
use serde_json::json;

use crate::error::argument_error;

/// Numbers as JSON, and the curve: time, indentation, rate, force, one row each.
type Collided<'py> = (String, Bound<'py, PyArray2<f64>>);

/// Collisions for options as on the command line.
#[pyfunction]
pub(crate) fn collide<'py>(py: Python<'py>, options: Vec<String>) -> PyResult<Vec<Collided<'py>>> {
    let found = py
        .detach(|| jostle_cli::collisions(&options))
        .map_err(argument_error)?;
    let as_rows = |(numbers, collision): (serde_json::Value, jostle::contact::FreeCollision)| {
        let curve = &collision.curve;
        let mut rows = Vec::with_capacity(4 * curve.len());
        rows.extend(curve.iter().map(|point| point.time));
        rows.extend(curve.iter().map(|point| point.indentation));
        rows.extend(curve.iter().map(|point| point.rate));
        rows.extend(curve.iter().map(|point| point.force));
        let table = PyArray1::from_vec(py, rows).reshape([4, curve.len()])?;
        Ok((numbers.to_string(), table))
    };
    found.into_iter().map(as_rows).collect()
}

/// The contact laws as JSON.
#[pyfunction]
pub(crate) fn contact_laws() -> String {
    let laws = LawKind::ALL.into_iter().map(|kind| {
        let variant = match kind {
            LawKind::ModifiedKelvin(variant) => Some(variant.name()),
            _ => None,
        };
        json!({
            "law": kind.name(),
            "variant": variant,
            "stiffness_unit": if kind.is_hertzian() { "N/m^1.5" } else { "N/m" },
            "dissipative": kind.is_dissipative(),
        })
    });
    laws.collect::<serde_json::Value>().to_string()
}
