//! The promised numbers by the reference, and how far a run is from them.

use jostle::{GroundMotion, System};

use super::explicit::{self, Fineness};
use super::quantities::{Quantity, quantities_of};
use super::reference::{Accuracy, Peaks, run};

/// Share of a tolerance that the reference itself may be uncertain by.
const UNCERTAIN: f64 = 0.1;

/// Promised numbers by the reference.
#[derive(Clone, Debug, Default)]
pub struct Truth {
    /// Quantities with the values of the reference.
    pub quantities: Vec<Quantity>,
    /// Their change under the perturbation.
    pub shifts: Vec<f64>,
}

/// A difference over its scale; none of a quantity that stays zero is none.
pub(super) fn share(difference: f64, scale: f64) -> f64 {
    if difference == 0.0 {
        0.0
    } else {
        difference / scale
    }
}

/// Error of every quantity over its scale; `None` where the reference is uncertain.
pub(super) fn errors(truth: &Truth, got: &[f64], tolerance: f64) -> Vec<Option<f64>> {
    let all = truth.quantities.iter().zip(&truth.shifts).zip(got);
    all.map(|((quantity, shift), got)| {
        let scale = if quantity.scale > 0.0 {
            quantity.scale
        } else {
            got.abs()
        };
        let relative = |value: f64| share(value, scale).abs();
        (relative(*shift) <= UNCERTAIN * tolerance).then(|| relative(got - quantity.value))
    })
    .collect()
}

/// The reference of a motion with its change under the perturbation, for which the motion may be another, and the peaks it
/// comes from.
pub(super) fn true_peaks(
    system: &System,
    [motion, perturbed]: [&GroundMotion; 2],
) -> Result<(Truth, Peaks), String> {
    let (peaks, other) = if explicit::is_needed(system) {
        let other = explicit::run(system, perturbed, Fineness::OTHER)?;
        (explicit::run(system, motion, Fineness::FINE)?, other)
    } else {
        let peaks = run(system, motion, Accuracy::FINE)?;
        let other = if system.contacts.is_empty() {
            peaks.clone()
        } else {
            run(system, perturbed, Accuracy::OTHER)?
        };
        (peaks, other)
    };
    let quantities = quantities_of(system, &peaks);
    let others = quantities_of(system, &other);
    let shifts = quantities.iter().zip(&others);
    let shifts = shifts.map(|(a, b)| b.value - a.value).collect();
    Ok((Truth { quantities, shifts }, peaks))
}
