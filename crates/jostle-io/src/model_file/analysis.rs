//! `[analysis]`: steps, accuracy and solver.

use jostle::{Analysis, Integrator, Solver};

use crate::choices::IntegratorMethod as Method;
use crate::keys::{INTEGRATORS, SOLVERS, Section};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader};
use crate::tree::Value;
use crate::unusual::Accepted;

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
    if let Some(field) = reader.get(&view, "collapse_drift") {
        let value = reader.quantity(&field, Dimension::Dimensionless);
        analysis.collapse_drift = value.unwrap_or(analysis.collapse_drift);
    }
    if let Some(field) = reader.get(&view, "energy_tolerance") {
        let value = reader.quantity(&field, Dimension::Dimensionless);
        analysis.energy_tolerance = value.unwrap_or(analysis.energy_tolerance);
    }
    if let Some(field) = reader.get(&view, "solver") {
        // "auto" is none of them.
        analysis.solver = reader
            .choice(&field, SOLVERS, &[])
            .and_then(Solver::from_name);
    }
    // Accepting unusual values also accepts the work that they cause.
    if reader.accepted.covers("analysis.step") {
        analysis.most_work = f64::INFINITY;
    }
    if let Some(field) = reader.get(&view, "accept_unusual") {
        check_accepted(reader, &field);
    }
    if let Some(field) = reader.get(&view, "integrator") {
        analysis.integrator = integrator(reader, &field);
    }
    analysis
}

/// Unusual values that are accepted; faults are noted where the table is read.
pub(super) fn accepted(reader: &mut Reader<'_>, field: &Field<'_>) -> Accepted {
    let Some(view) = reader.reopen(field, &[Section::Analysis]) else {
        return Accepted::Nothing;
    };
    let Some(field) = reader.get(&view, "accept_unusual") else {
        return Accepted::Nothing;
    };
    match (&field.node.value, field.entries()) {
        (Value::Flag(true), _) => Accepted::Everything,
        (_, Some(entries)) => Accepted::Paths(
            entries
                .iter()
                .filter_map(|entry| entry.as_text().map(str::to_owned))
                .collect(),
        ),
        _ => Accepted::Nothing,
    }
}

/// Notes what is neither true nor false nor a list of fields.
fn check_accepted(reader: &mut Reader<'_>, field: &Field<'_>) {
    match field.entries() {
        Some(entries) => {
            for entry in &entries {
                reader.text(entry);
            }
        }
        None if matches!(field.node.value, Value::Flag(_)) => {}
        None => {
            let found = field.node.describe();
            reader.bad(
                field,
                format!("expected true, false or a list of fields such as [\"building[0].spans\"], found {found}"),
            );
        }
    }
}

/// A word, or a table with the numbers of the method.
fn integrator(reader: &mut Reader<'_>, field: &Field<'_>) -> Integrator {
    let usual = |method: Method| match method {
        Method::AverageAcceleration | Method::Newmark => Integrator::default(),
        Method::Hht => Integrator::hht(0.05),
        Method::GeneralizedAlpha => Integrator::generalized_alpha(0.8),
    };
    if !matches!(field.node.value, Value::Table(_)) {
        let method = reader.choice(field, INTEGRATORS, &[]);
        let method = method.and_then(Method::from_name);
        return method.map_or_else(Integrator::default, usual);
    }
    let Some(view) = reader.open(field, &[Section::Integrator]) else {
        return Integrator::default();
    };
    let method = match reader.get(&view, "method") {
        Some(field) => reader.choice(&field, INTEGRATORS, &[]),
        None => {
            reader.missing(&view, "method", "add method = \"hht\", for instance");
            None
        }
    };
    let Some(method) = method.and_then(Method::from_name) else {
        return Integrator::default();
    };
    let belongs: &[&str] = match method {
        Method::AverageAcceleration => &[],
        Method::Newmark => &["beta", "gamma"],
        Method::Hht => &["alpha"],
        Method::GeneralizedAlpha => &["spectral_radius"],
    };
    let name = method.name();
    let mut number = |key: &'static str, range: std::ops::RangeInclusive<f64>| {
        let field = reader.get(&view, key)?;
        if !belongs.contains(&key) {
            *reader.bad(&field, format!("does not belong to {name}")) = Some(match belongs {
                [] => "remove it".to_owned(),
                keys => format!("{name} takes {}", keys.join(" and ")),
            });
            return None;
        }
        let value = reader.quantity(&field, Dimension::Dimensionless)?;
        if range.contains(&value) {
            return Some(value);
        }
        let remedy = reader.bad(
            &field,
            format!(
                "must lie between {} and {:.4}, found {value}",
                range.start(),
                range.end()
            ),
        );
        if key == "alpha" && range.contains(&-value) {
            *remedy = Some(format!(
                "it counts as positive what Hilber, Hughes and Taylor count as negative: write {}",
                -value
            ));
        }
        None
    };
    let (beta, gamma) = (number("beta", 0.0..=1.0), number("gamma", 0.5..=1.5));
    let alpha = number("alpha", 0.0..=1.0 / 3.0);
    let radius = number("spectral_radius", 0.0..=1.0);
    match method {
        Method::AverageAcceleration => Integrator::default(),
        Method::Newmark => Integrator::newmark(beta.unwrap_or(0.25), gamma.unwrap_or(0.5)),
        Method::Hht => alpha.map_or_else(|| usual(method), Integrator::hht),
        Method::GeneralizedAlpha => {
            radius.map_or_else(|| usual(method), Integrator::generalized_alpha)
        }
    }
}

/// A time, or `"auto"`.
fn step(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<f64> {
    if field.as_text() == Some("auto") {
        return None;
    }
    reader.quantity(field, Dimension::Time)
}
