//! Friction along closed contacts, in modal coordinates.

use super::stepper::ModalStepper;
use crate::state::Episode;
use crate::stepping::events::Cubic;
use crate::stepping::gap_forces::StepForce;
use crate::stepping::runner::RunState;
use crate::stepping::step_friction::{FRICTION_PARTS, FrictionPath};

/// Share of the limit from which friction counts as at its limit.
const AT_LIMIT: f64 = 1.0 - 1e-9;

impl ModalStepper<'_> {
    /// Brings the friction of a contact to the end of an accepted step with its start and length \[s\] and the contact force
    /// over it. Returns the friction as predicted, with the end it has come to.
    pub(super) fn finish_friction(
        &self,
        run: &RunState<'_>,
        contact: usize,
        episode: &mut Episode,
        pressed: &StepForce,
        [start, step]: [f64; 2],
    ) -> Option<FrictionPath> {
        let place = self.reduced.friction[contact]?;
        let law = run.system.contacts[contact].friction.as_ref()?.law;
        let trial = &run.trials[place];
        let friction = &mut episode.friction;
        let bend = self.predicted[place].bend(friction.force, trial.force);
        friction.impulse += step * (0.5 * (friction.force + trial.force) - bend / 6.0);
        // The buildings have moved on: what was is in the second list.
        let [then, before] =
            [&self.u[1], &self.rate[1]].map(|list| self.reduced.closing(place, list));
        let slip = Cubic::new(then, before, trial.indentation, trial.rate, step);
        for at in slip.turning_points().chain([1.0]) {
            friction.slip_peak = friction
                .slip_peak
                .max((slip.value(at) - friction.touched_at).abs());
        }
        let greatest = pressed.ends[0].max(pressed.ends[1]).max(pressed.peak.value);
        let mut path = self.friction_paths[place - run.phases.len()];
        path.ends[FRICTION_PARTS - 1] = trial.force;
        friction
            .peak
            .widen(&[path], law.coefficient * greatest, [start, step]);
        friction.origin = law.origin(trial.indentation, trial.force);
        friction.force = trial.force;
        Some(path)
    }

    /// Adds the rate of friction to the modal jerks; it has this force, and its contact this force and rate of force \[N, N/s\].
    ///
    /// Within its limit μF friction grows as the slip does; at the limit no faster than that.
    pub(super) fn push_friction_slope(
        &mut self,
        run: &RunState<'_>,
        contact: usize,
        force: f64,
        [pressed, pressed_slope]: [f64; 2],
    ) {
        let (Some(place), Some(friction)) = (
            self.reduced.friction[contact],
            &run.system.contacts[contact].friction,
        ) else {
            return;
        };
        let law = friction.law;
        let rate = self.reduced.closing(place, &self.rate[0]);
        let mut slope = law.stiffness * rate;
        if force.abs() >= AT_LIMIT * law.coefficient * pressed.max(0.0) {
            let sign = if force == 0.0 { rate } else { force }.signum();
            slope = sign * (sign * slope).min(law.coefficient * pressed_slope);
        }
        self.push_slope(place, slope);
    }
}
