//! Two free masses under contact laws.

use std::collections::HashMap;

use jostle::LawKind;
use jostle::contact::ModifiedKelvin;
use jostle_report::CollidedLaw;
use jostle_run::{AdviceOptions, CollideOptions, collision_json};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use serde_json::json;

use crate::error::argument_error;
use crate::model::Model;

/// Numbers as JSON, and the curve: time, indentation, rate, force, one row each.
type Collided<'py> = (String, Bound<'py, PyArray2<f64>>);

/// Collisions under one law, or under all without one; what is given has the names and values of the command line.
#[pyfunction]
#[pyo3(signature = (law, given))]
pub(crate) fn collide<'py>(
    py: Python<'py>,
    law: Option<String>,
    given: HashMap<String, String>,
) -> PyResult<Vec<Collided<'py>>> {
    let mut options = CollideOptions {
        all: law.is_none(),
        ..CollideOptions::default()
    };
    if let Some(law) = law {
        options.law = law;
    }
    for (name, value) in given {
        put(&mut options, &name, value)?;
    }
    let found = py
        .detach(|| jostle_run::collide(&options))
        .map_err(|error| argument_error(error.to_string()))?;
    let as_rows = |collided: CollidedLaw| {
        let curve = &collided.collision.curve;
        let mut rows = Vec::with_capacity(4 * curve.len());
        rows.extend(curve.iter().map(|point| point.time));
        rows.extend(curve.iter().map(|point| point.indentation));
        rows.extend(curve.iter().map(|point| point.rate));
        rows.extend(curve.iter().map(|point| point.force));
        let table = PyArray1::from_vec(py, rows).reshape([4, curve.len()])?;
        Ok((collision_json(&collided).to_string(), table))
    };
    found.laws.into_iter().map(as_rows).collect()
}

/// Sets one option.
fn put(options: &mut CollideOptions, name: &str, value: String) -> PyResult<()> {
    match name {
        "m1" => options.m1 = value,
        "m2" => options.m2 = value,
        "speed" => options.speed = value,
        "stiffness" => options.stiffness = Some(value),
        "restitution" => options.restitution = value,
        "restitution_is" => options.restitution_is = value,
        "damping" => options.damping = Some(value),
        "formula" => options.formula = Some(value),
        "variant" => options.variant = value,
        "yield_share" => options.yield_share = value,
        "design_speed" => options.design_speed = Some(value),
        "thickness" => options.thickness = value,
        "exponent" => options.exponent = value,
        other => return Err(argument_error(format!("{other}: there is no such option"))),
    }
    Ok(())
}

/// Advice on contacts as the JSON of `jostle contact-advice`; what is given has the names and values of the command line.
#[pyfunction]
#[pyo3(signature = (model, given))]
pub(crate) fn contact_advice(
    py: Python<'_>,
    model: Option<&Model>,
    given: HashMap<String, String>,
) -> PyResult<String> {
    let mut options = AdviceOptions::default();
    for (name, value) in given {
        match name.as_str() {
            "mass" => options.mass = Some(value),
            "length" => options.length = Some(value),
            "width" => options.width = Some(value),
            "thickness" => options.thickness = Some(value),
            "concrete" => options.concrete = Some(value),
            "modulus" => options.modulus = Some(value),
            "poisson_ratio" => options.poisson_ratio = value,
            "density" => options.density = value,
            "speed" => options.speed = value,
            other => return Err(argument_error(format!("{other}: there is no such option"))),
        }
    }
    let opened = model.map(|model| &model.opened);
    let found = py
        .detach(|| jostle_run::contact_advice(opened, &options))
        .map_err(|error| argument_error(error.to_string()))?;
    serde_json::to_string(&found).map_err(|error| argument_error(error.to_string()))
}

/// The contact laws as JSON.
#[pyfunction]
pub(crate) fn contact_laws() -> String {
    let laws = LawKind::ALL.into_iter().map(|kind| {
        let variant = kind.variant().map(ModifiedKelvin::name);
        json!({
            "law": kind.name(),
            "variant": variant,
            "stiffness_unit": if kind.is_hertzian() { "N/m^1.5" } else { "N/m" },
            "dissipative": kind.is_dissipative(),
        })
    });
    laws.collect::<serde_json::Value>().to_string()
}
