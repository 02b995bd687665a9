//! The accuracy of each solver formulation on the buildings of a model, in words.

use std::fmt::Write;

use jostle::System;
use jostle::method::MethodSurvey;

use crate::error::RunError;
use crate::numbers::{counted, grouped};
use crate::style::{BOLD, DIM, styled};

/// Surveys the accuracy of every solver formulation on every building.
///
/// # Errors
/// [`RunError::Analysis`] if a reference solution fails.
pub fn survey_methods(system: &System) -> Result<Vec<MethodSurvey>, RunError> {
    let surveys = system.structures().iter().map(MethodSurvey::new);
    let surveys: Result<Vec<_>, _> = surveys.collect();
    surveys.map_err(|error| RunError::Analysis(error.to_string()))
}

/// Surveys in words.
#[must_use]
pub fn methods_text(surveys: &[MethodSurvey]) -> String {
    let mut text = String::new();
    for survey in surveys {
        // Writing to a string cannot fail.
        let _ = describe(&mut text, survey);
    }
    text
}

fn describe(text: &mut String, survey: &MethodSurvey) -> std::fmt::Result {
    writeln!(text, "{}", styled(BOLD, &survey.name))?;
    let mut elements = vec![format!(
        "{} lumped masses",
        grouped(survey.lumped_masses as u64)
    )];
    for (count, name) in [
        (survey.members, "massless beam"),
        (survey.hinges, "hinge"),
        (survey.springs, "storey spring"),
    ] {
        if count > 0 {
            elements.push(counted(count, name));
        }
    }
    writeln!(text, "  {}", elements.join(", "))?;
    let product = match survey.product_unknowns {
        0 if survey.yields => "knows no yielding".to_owned(),
        0 => "no transfer path through this building".to_owned(),
        unknowns => format!(
            "{} unknowns, a full matrix of {}",
            grouped(unknowns as u64),
            grouped((unknowns * unknowns) as u64)
        ),
    };
    writeln!(text, "  product    {product}")?;
    writeln!(
        text,
        "  Riccati    {} displacements, {} entries of L: {} multiply-adds per solution",
        grouped(survey.degrees_of_freedom as u64),
        grouped(survey.couplings as u64),
        grouped((2 * survey.couplings + survey.degrees_of_freedom) as u64)
    )?;
    writeln!(
        text,
        "  stiffness  {} displacements, {} entries before factorising",
        grouped(survey.degrees_of_freedom as u64),
        grouped(survey.stiffness_entries as u64)
    )?;
    writeln!(
        text,
        "  relative error of one step, against direct stiffness"
    )?;
    if survey.yields {
        writeln!(text, "      step   Riccati")?;
        for row in &survey.accuracy {
            writeln!(
                text,
                "  {:>5} ms  {:>8}",
                row.step * 1e3,
                error(row.riccati)
            )?;
        }
        return writeln!(
            text,
            "  {}\n",
            styled(
                DIM,
                "hinges have their initial stiffness; the product and the element-by-element form do not support yielding"
            )
        );
    }
    writeln!(
        text,
        "      step     product  (expected)  element by element   Riccati"
    )?;
    for row in &survey.accuracy {
        writeln!(
            text,
            "  {:>5} ms  {:>10}  {:>10}  {:>18}  {:>8}",
            row.step * 1e3,
            error(row.product),
            format!("{:.0} digits", row.product_digits_expected.max(0.0)),
            error(row.elementwise),
            error(row.riccati)
        )?;
    }
    writeln!(
        text,
        "  {}\n",
        styled(DIM, "solver = \"product\" is refused below 6 digits")
    )
}

fn error(error: f64) -> String {
    if !error.is_finite() {
        "overflow".to_owned()
    } else if error > 1.0 {
        "lost".to_owned()
    } else {
        format!("{error:.0e}")
    }
}
