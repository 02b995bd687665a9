//! A trilinear curve of equal energy.

use jostle::hysteresis::Corner;

use crate::curve::{AnalysisError, EventKind, MomentCurvature};

/// Trilinear moment–curvature curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trilinear {
    /// First crack: curvature \[1/m\] and moment \[N·m\].
    pub cracking: Corner,
    /// Effective yield.
    pub yielding: Corner,
    /// End of the curve.
    pub ultimate: Corner,
}

impl MomentCurvature {
    /// The trilinear curve of equal energy.
    ///
    /// # Errors
    /// [`AnalysisError::Brittle`] when the section yields before it cracks.
    pub fn trilinear(&self) -> Result<Trilinear, AnalysisError> {
        Trilinear::fit(self)
    }
}

impl Trilinear {
    /// Fits a curve: through the first crack, along the line through first yield, and on to the end of the
    /// curve; the corner between the last two lies where the area below equals that of the curve.
    ///
    /// First yield is where the tension bars yield or the outermost concrete reaches its strength, whichever is
    /// first. Where that would make the last line fall it is level, with the moment of equal area.
    ///
    /// # Errors
    /// [`AnalysisError::Brittle`] when first yield lies below the cracking moment.
    pub(crate) fn fit(curve: &MomentCurvature) -> Result<Self, AnalysisError> {
        let end = curve.points.last().copied().unwrap_or_default();
        let at = |kind| {
            curve.event(kind).map(|event| Corner {
                deformation: event.curvature,
                force: event.moment,
            })
        };
        let first_yield = [EventKind::TensionYield, EventKind::PeakStress]
            .into_iter()
            .filter_map(at)
            .min_by(|a, b| a.deformation.total_cmp(&b.deformation))
            .unwrap_or(end);
        let cracking = at(EventKind::Cracking).unwrap_or(Corner {
            deformation: 0.5 * first_yield.deformation,
            force: 0.5 * first_yield.force,
        });
        let slope =
            (first_yield.force - cracking.force) / (first_yield.deformation - cracking.deformation);
        if !(slope > 0.0 && slope.is_finite()) {
            return Err(AnalysisError::Brittle {
                cracking: 1e-3 * cracking.force,
                yielding: 1e-3 * first_yield.force,
            });
        }
        let area: f64 = curve
            .points
            .windows(2)
            .map(|ends| {
                0.5 * (ends[0].force + ends[1].force) * (ends[1].deformation - ends[0].deformation)
            })
            .sum();
        let corner = |curvature: f64| Corner {
            deformation: curvature,
            force: cracking.force + slope * (curvature - cracking.deformation),
        };
        let below = |yielding: Corner, last: f64| {
            0.5 * (cracking.force * cracking.deformation
                + (cracking.force + yielding.force) * (yielding.deformation - cracking.deformation)
                + (yielding.force + last) * (end.deformation - yielding.deformation))
        };
        let bisect = |level: bool| {
            let (mut low, mut high) = (cracking.deformation, end.deformation);
            for _ in 0..200 {
                let middle = 0.5 * (low + high);
                let yielding = corner(middle);
                let last = if level { yielding.force } else { end.force };
                if below(yielding, last) < area {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            corner(0.5 * (low + high))
        };
        let mut yielding = bisect(false);
        let mut ultimate = end;
        if yielding.force > end.force || end.deformation <= yielding.deformation {
            yielding = bisect(true);
            ultimate.force = yielding.force;
        }
        Ok(Self {
            cracking,
            yielding,
            ultimate,
        })
    }

    /// Slope before cracking \[N·m²\].
    #[must_use]
    pub fn initial(&self) -> f64 {
        self.cracking.force / self.cracking.deformation
    }

    /// Slope between cracking and yield \[N·m²\].
    #[must_use]
    pub fn post_cracking(&self) -> f64 {
        (self.yielding.force - self.cracking.force)
            / (self.yielding.deformation - self.cracking.deformation)
    }

    /// Slope after yield, ≥ 0 \[N·m²\].
    #[must_use]
    pub fn post_yield(&self) -> f64 {
        let span = self.ultimate.deformation - self.yielding.deformation;
        if span > 0.0 {
            (self.ultimate.force - self.yielding.force) / span
        } else {
            0.0
        }
    }
}
