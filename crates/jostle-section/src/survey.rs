//! All results for one member end, by both methods.

use jostle::hysteresis::Side;

use crate::curve::{AnalysisError, MomentCurvature, Options};
use crate::fit::Trilinear;
use crate::formula::Member;
use crate::member::EndCurve;
use crate::section::Section;

/// A section in a member, with its curves.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionSurvey {
    /// Its position, for display.
    pub name: String,
    /// The section.
    pub section: Section,
    /// Column or beam.
    pub member: Member,
    /// Axial compression \[N\].
    pub compression: f64,
    /// Length of the member \[m\].
    pub length: f64,
    /// By formulas.
    pub formula: EndCurve,
    /// Fibre by fibre.
    pub analysis: Result<Analysis, AnalysisError>,
}

/// Outcome of the analysis of both sides.
#[derive(Clone, Debug, PartialEq)]
pub struct Analysis {
    /// Moment and curvature, positive and negative.
    pub curves: [MomentCurvature; 2],
    /// The curves fitted to them.
    pub fits: [Trilinear; 2],
    /// Moment and rotation of the member end.
    pub ends: EndCurve,
}

impl SectionSurvey {
    /// Does everything.
    #[must_use]
    pub fn new(
        name: String,
        section: Section,
        member: Member,
        compression: f64,
        length: f64,
    ) -> Self {
        let analysis = analyse(&section, compression, length);
        Self {
            name,
            formula: EndCurve::by_formula(&section, compression, length, member),
            analysis,
            section,
            member,
            compression,
            length,
        }
    }

    /// Stiffness of the gross member end, 6 E I / L \[N·m/rad\].
    #[must_use]
    pub fn gross_stiffness(&self) -> f64 {
        6.0 * self.section.gross_rigidity() / self.length
    }

    /// Whether both sides are equal.
    #[must_use]
    pub fn is_symmetric(&self) -> bool {
        self.section.is_symmetric()
    }

    /// The sides to show: one if both are equal.
    #[must_use]
    pub fn sides(&self) -> &'static [Side] {
        if self.is_symmetric() {
            &[Side::Positive]
        } else {
            &Side::BOTH
        }
    }
}

fn analyse(section: &Section, compression: f64, length: f64) -> Result<Analysis, AnalysisError> {
    let flipped = section.flipped();
    let one = |section: &Section| {
        let curve = MomentCurvature::new(section, compression, Options::default())?;
        let fit = curve.trilinear()?;
        Ok((curve, fit))
    };
    let (a, fit_a) = one(section)?;
    let (b, fit_b) = if section.is_symmetric() {
        (a.clone(), fit_a)
    } else {
        one(&flipped)?
    };
    Ok(Analysis {
        ends: EndCurve {
            sides: [
                EndCurve::side_of(section, &fit_a, length),
                EndCurve::side_of(&flipped, &fit_b, length),
            ],
        },
        curves: [a, b],
        fits: [fit_a, fit_b],
    })
}
