//! Mass, damping and stiffness of a building as full matrices, with the indices of floors and contacts.

use jostle::System;
use jostle::linear::SparseSymmetric;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;

use crate::error::argument_error;

/// Masses; K, C with one row per degree of freedom; mass driven by the ground; degrees of freedom of the floors.
pub(crate) type Matrices<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<f64>>,
    Vec<usize>,
);

pub(crate) fn matrices<'py>(
    py: Python<'py>,
    system: &System,
    building: usize,
) -> PyResult<Matrices<'py>> {
    let building = &system.buildings[building];
    let equations = &building.equations;
    if !equations.springs.is_empty() {
        return Err(argument_error(format!(
            "\"{}\" may yield and has no unique stiffness matrix; remove its hinges",
            building.name
        )));
    }
    let n = equations.len();
    let (mut stiffness, mut damping) = (vec![0.0; n * n], vec![0.0; n * n]);
    let parts: [(&SparseSymmetric, f64, f64); 3] = [
        (&equations.stiffness, 1.0, equations.beta),
        (&equations.undamped, 1.0, 0.0),
        (&equations.dashpots, 0.0, 1.0),
    ];
    for (matrix, stiffens, damps) in parts {
        let mut add = |row: usize, column: usize, value: f64| {
            stiffness[row * n + column] += stiffens * value;
            damping[row * n + column] += damps * value;
        };
        for column in 0..matrix.diagonal.len() {
            add(column, column, matrix.diagonal[column]);
            for entry in matrix.starts[column]..matrix.starts[column + 1] {
                let row = matrix.rows[entry] as usize;
                add(row, column, matrix.values[entry]);
                add(column, row, matrix.values[entry]);
            }
        }
    }
    for (dof, mass) in equations.mass.iter().enumerate() {
        damping[dof * n + dof] += equations.alpha * mass;
    }
    let floors = building.floors.iter();
    let square = |values: Vec<f64>| PyArray1::from_vec(py, values).reshape([n, n]);
    Ok((
        PyArray1::from_slice(py, &equations.mass),
        square(stiffness)?,
        square(damping)?,
        PyArray1::from_slice(py, &equations.driven_mass),
        floors.map(|floor| floor.dof - building.offset).collect(),
    ))
}
