//! Step control while contacts are closed: as few steps as the tolerance allows (theory, Eqs. G2, G3 and Q6).

use std::f64::consts::PI;

use super::StepEquations;
use super::clock::Clock;
use super::plan::{ContactSteps, Plan};
use super::simulation::Simulation;
use crate::state::Episode;
use crate::system::Contact;

/// Number of steps per half cycle at the present stiffness, relative to the planned one, above which accuracy stops
/// improving.
const MOST_FINER: f64 = 4.0;
/// Margin of an estimate below the target before steps are doubled, in addition to the factor of doubling.
const SLACK: f64 = 1.5;

impl<E: StepEquations> Simulation<'_, E> {
    /// Rate of change of the closing rate of a contact \[m/s²\].
    pub(super) fn relative_acceleration(&self, index: usize) -> f64 {
        let faces = &self.system.contacts[index].faces;
        faces.closing(&self.state.acceleration)
    }

    /// At first contact: the division for the expected impact at this closing rate, relative to the greatest force
    /// of the gap so far.
    pub(super) fn choose_division(&mut self, index: usize, rate: f64) {
        let contact = &self.system.contacts[index];
        let expected = contact.law.elastic_force(contact.effective_mass(), rate);
        let strongest = &mut self.strongest[contact.gap];
        *strongest = strongest.max(expected);
        let share = if *strongest > 0.0 {
            expected / *strongest
        } else {
            0.0
        };
        self.contact_division[index] = self.plan.first_division(contact, rate, share);
        self.finest_in_contact = self.finest_in_contact.max(self.contact_division[index]);
    }

    /// After a step of a closed contact: finer steps where its error endangers the tolerance, coarser ones where the
    /// grid allows and the error is far below.
    ///
    /// The trapezoidal rule has an error of h² Δa/12 in the displacement of a step. Over the π/(ωh) steps of half a
    /// cycle at the present contact stiffness, ω² = F′/m, this is an error of the force of F′ h² |Δa|/12 · π/(ωh),
    /// relative to the greatest force of the gap.
    pub(super) fn control_division(&mut self, closed: usize, step: f64, episode: &Episode) {
        let closed = &self.coupling.closed[closed];
        let index = closed.contact;
        let contact = &self.system.contacts[index];
        let strongest = &mut self.strongest[contact.gap];
        *strongest = strongest.max(episode.peak_force);
        let strongest = *strongest;
        let trial = self.trials[index];
        let response = contact
            .law
            .follow(trial.indentation, trial.rate, &episode.memory);
        let stiffness = response.by_indentation;
        let half_cycle = half_cycle(contact, stiffness);
        let change = self.relative_acceleration(index) - closed.start_acceleration;
        let observed = Observed {
            step,
            stiffness,
            damping: 0.0,
            error: stiffness * step * change.abs() / 12.0 * half_cycle / strongest,
            order: 2,
        };
        let division = &mut self.contact_division[index];
        *division = next_division(self.plan, contact, &observed, *division, &self.clock);
        self.finest_in_contact = self.finest_in_contact.max(*division);
    }
}

/// Result of a step of a closed contact.
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
fn half_cycle(contact: &Contact, stiffness: f64) -> f64 {
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
