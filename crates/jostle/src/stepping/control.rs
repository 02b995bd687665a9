//! Step control while contacts are closed: as few steps as the tolerance allows (theory, Eqs. G2, G3 and Q6).

use std::f64::consts::PI;

use super::clock::Clock;
use super::plan::{ContactSteps, Plan};
use crate::interface::Contact;

/// Number of steps per half cycle at the present stiffness, relative to the planned one, above which accuracy stops
/// improving.
const MOST_FINER: f64 = 4.0;
/// Margin of an estimate below the target before steps are doubled, in addition to the factor of doubling.
const SLACK: f64 = 1.5;

/// What a step of a closed contact has shown.
pub(super) struct Observed {
    /// Its length \[s\].
    pub(super) step: f64,
    /// F′ at its end \[N/m\].
    pub(super) stiffness: f64,
    /// ∂F/∂δ̇ there; 0 if the error is one of displacements only, so that a dashpot needs no finer steps \[N·s/m\].
    pub(super) damping: f64,
    /// Error of the force over half a cycle of such steps, relative to the greatest of the gap \[–\].
    pub(super) error: f64,
    /// Its order in the step.
    pub(super) order: i32,
}

/// Half a cycle of a contact of stiffness F′ \[s\].
pub(super) fn half_cycle(contact: &Contact, stiffness: f64) -> f64 {
    PI * (contact.effective_mass() / stiffness).sqrt()
}

/// The next division.
pub(super) fn next_division(
    plan: &Plan,
    contact: &Contact,
    observed: &Observed,
    division: u32,
    clock: &Clock,
) -> u32 {
    let ContactSteps::PerImpact { steps, tolerance } = plan.contact_steps else {
        return division;
    };
    let Observed {
        step,
        stiffness,
        damping,
        error,
        order,
    } = *observed;
    // The time scale of an overdamped contact is m/c, which may be much less than half a cycle.
    let quickest = stiffness.max(damping * damping / contact.effective_mass());
    if quickest <= 0.0 || !error.is_finite() {
        return division;
    }
    let half_cycle = half_cycle(contact, quickest);
    if error > tolerance && step * MOST_FINER * steps > half_cycle {
        plan.finer(division)
    } else if error * SLACK * 2.0_f64.powi(order) < tolerance
        && division > 1
        && clock.is_on_grid(division / 2)
        && !plan.is_too_coarse(division / 2, contact, stiffness)
    {
        division / 2
    } else {
        division
    }
}
