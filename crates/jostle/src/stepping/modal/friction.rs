//! Friction along closed contacts, in modal coordinates.

use super::stepper::ModalStepper;
use crate::history::Extreme;
use crate::state::Episode;
use crate::stepping::runner::RunState;

impl ModalStepper<'_> {
    /// Brings the friction of a contact to the end of an accepted step with its start and length \[s\], in which the contact
    /// force peaks so.
    pub(super) fn rub(
        &self,
        run: &RunState<'_>,
        contact: usize,
        episode: &mut Episode,
        peak: Extreme,
        [start, step]: [f64; 2],
    ) -> Option<f64> {
        let place = self.reduced.friction[contact]?;
        let friction = run.system.contacts[contact].friction.as_ref()?;
        let trial = &run.trials[place];
        let own = &mut episode.friction;
        let bend = self.predicted[place].bend(own.force, trial.force);
        own.impulse += step * (0.5 * (own.force + trial.force) - bend / 6.0);
        own.slip_peak = own
            .slip_peak
            .max((trial.indentation - own.touched_at).abs());
        // What slips peaks with the contact force; what sticks is followed from step to step.
        let slips = |force: f64, pressed: f64| {
            force != 0.0 && force.abs() >= friction.coefficient * pressed * (1.0 - 1e-9)
        };
        let slid = slips(own.force, episode.force)
            && slips(trial.force, run.trials[contact].force)
            && own.force * trial.force > 0.0;
        let at_peak = (slid && peak.at > start && peak.at < start + step)
            .then_some((friction.coefficient * peak.value, peak.at));
        for (force, at) in at_peak
            .into_iter()
            .chain([(trial.force.abs(), start + step)])
        {
            if force > own.peak {
                (own.peak, own.peak_at) = (force, at);
            }
        }
        own.origin = friction.origin(trial.indentation, trial.force);
        own.force = trial.force;
        slid.then(|| friction.coefficient.copysign(trial.force))
    }

    /// Adds the rate of friction to the modal jerks, where its contact has this force and rate of force \[N, N/s\].
    pub(super) fn push_friction_slope(
        &mut self,
        run: &RunState<'_>,
        contact: usize,
        pressed: f64,
        episode: &Episode,
        pressed_slope: f64,
    ) {
        let (Some(place), Some(friction)) = (
            self.reduced.friction[contact],
            &run.system.contacts[contact].friction,
        ) else {
            return;
        };
        let [slip, rate] =
            [&self.u[0], &self.rate[0]].map(|list| self.reduced.closing(place, list));
        let (force, sticks) = friction.force(slip, episode.friction.origin, pressed);
        let sticking = friction.stiffness * rate;
        let bound = friction.coefficient * pressed_slope;
        let slope = if sticks && sticking.abs() <= bound.abs().max(force.abs()) && force != 0.0 {
            sticking
        } else {
            bound.copysign(if force == 0.0 {
                rate
            } else {
                force * pressed_slope
            })
        };
        self.reduced.push_apart(place, slope, &mut self.jerk);
    }
}
