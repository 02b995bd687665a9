//! Step control while contacts are closed: as few steps as the tolerance allows (theory, Eqs. G2 and G3).

use std::f64::consts::PI;

use super::StepEquations;
use super::clock::Clock;
use super::plan::{ContactSteps, Plan};
use super::simulation::Simulation;
use crate::state::Episode;
use crate::system::Contact;

/// Steps of a half cycle at the present stiffness, relative to those planned, beyond which finer ones gain nothing.
const MOST_FINER: f64 = 4.0;
/// How far an estimate must lie below the target before steps are doubled: doubling multiplies it by four.
const SLACK: f64 = 6.0;

impl<E: StepEquations> Simulation<'_, E> {
    /// Rate of change of the closing rate of a contact \[m/s²\].
    pub(super) fn relative_acceleration(&self, index: usize) -> f64 {
        let faces = &self.system.contacts[index].faces;
        faces.closing(&self.state.acceleration)
    }

    /// At a touch: the division that the impact expected of this closing rate needs, in view of the strongest impact of
    /// the gap so far.
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
    /// The trapezoidal rule misses h² Δa/12 of a displacement in a step. Over the π/(ωh) steps of half a cycle at the
    /// present contact stiffness, ω² = F′/m, that is an error of the force of F′ h² |Δa|/12 · π/(ωh), relative to the
    /// greatest force of the gap.
    pub(super) fn control_division(&mut self, closed: usize, step: f64, episode: &Episode) {
        let closed = &self.coupling.closed[closed];
        let index = closed.contact;
        let contact = &self.system.contacts[index];
        let strongest = &mut self.strongest[contact.gap];
        *strongest = strongest.max(episode.peak_force);
        let trial = self.trials[index];
        let observed = Observed {
            step,
            slope: contact
                .law
                .follow(trial.indentation, trial.rate, &episode.memory)
                .by_indentation,
            strongest: *strongest,
            acceleration_change: (self.relative_acceleration(index) - closed.start_acceleration)
                .abs(),
        };
        let division = &mut self.contact_division[index];
        *division = next_division(self.plan, contact, &observed, *division, &self.clock);
        self.finest_in_contact = self.finest_in_contact.max(*division);
    }
}

/// What a step of a closed contact has shown.
pub(super) struct Observed {
    /// Its length \[s\].
    pub(super) step: f64,
    /// F′ at its end \[N/m\].
    pub(super) slope: f64,
    /// Greatest force of the gap so far \[N\].
    pub(super) strongest: f64,
    /// |Δa| of the closing \[m/s²\].
    pub(super) acceleration_change: f64,
}

/// The division to go on with.
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
        slope,
        strongest,
        acceleration_change,
    } = *observed;
    if slope <= 0.0 || strongest <= 0.0 {
        return division;
    }
    let half_cycle = PI * (contact.effective_mass() / slope).sqrt();
    let error = slope * step * acceleration_change / 12.0 * half_cycle / strongest;
    if error > tolerance && step * MOST_FINER * steps > half_cycle {
        plan.finer(division)
    } else if error * SLACK < tolerance
        && division > 1
        && clock.is_on_grid(division / 2)
        && division / 2 >= plan.coarsest(contact, slope)
    {
        division / 2
    } else {
        division
    }
}
