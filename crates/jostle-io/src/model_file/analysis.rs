//! `[analysis]`: steps, accuracy and solver.

use jostle::{Analysis, Solver};

use crate::keys::{LATER_SOLVERS, SOLVERS, Section};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader};

pub(super) fn read(reader: &mut Reader<'_>, field: &Field<'_>) -> Analysis {
    let mut analysis = Analysis::default();
    let Some(view) = reader.open(field, &[Section::Analysis]) else {
        return analysis;
    };
    if let Some(field) = reader.get(&view, "step") {
        analysis.step = step(reader, &field);
    }
    if let Some(field) = reader.get(&view, "contact_step") {
        analysis.contact_step = step(reader, &field);
    }
    if let Some(field) = reader.get(&view, "tolerance") {
        let value = reader.quantity(&field, Dimension::Dimensionless);
        analysis.tolerance = value.unwrap_or(analysis.tolerance);
    }
    if let Some(field) = reader.get(&view, "energy_tolerance") {
        let value = reader.quantity(&field, Dimension::Dimensionless);
        analysis.energy_tolerance = value.unwrap_or(analysis.energy_tolerance);
    }
    if let Some(field) = reader.get(&view, "solver") {
        analysis.solver = match reader.choice(&field, SOLVERS, LATER_SOLVERS) {
            Some("stiffness") => Solver::Stiffness,
            Some("product") => Solver::Product,
            _ => Solver::Riccati,
        };
    }
    analysis
}

/// A time, or `"auto"`.
fn step(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<f64> {
    if field.as_text() == Some("auto") {
        return None;
    }
    reader.quantity(field, Dimension::Time)
}
