//! Friction along closed contacts in direct steps.

use super::{Direct, moved_by_grounds};
use crate::contact::ForceLaw;
use crate::interface::Friction;
use crate::state::{ContactPhase, Episode};
use crate::stepping::coupling::Closed;
use crate::stepping::events::Cubic;
use crate::stepping::gap_forces::StepForce;
use crate::stepping::runner::RunState;
use crate::stepping::step_friction::{FRICTION_PARTS, FrictionPath, StepFriction, StepStart};

impl Direct {
    /// Friction along a contact, and its place among the trials.
    fn friction_along<'a>(
        &self,
        run: &RunState<'a>,
        contact: usize,
    ) -> Option<(usize, &'a Friction)> {
        let friction = run.system.contacts[contact].friction.as_ref()?;
        Some((self.joints.friction_of(contact)?, friction))
    }

    /// Slip along a contact and its rate now \[m, m/s\].
    pub(super) fn slip_now(&self, run: &RunState<'_>, contact: usize) -> [f64; 2] {
        let along = self.friction_along(run, contact);
        along.map_or([0.0; 2], |(place, friction)| {
            let [shift, shift_rate, _] = run.grounds.closing(place, 0);
            let ports = &friction.ports;
            [
                ports.closing(&self.state.displacement) + shift,
                ports.closing(&self.state.velocity) + shift_rate,
            ]
        })
    }

    /// Motion along and across a closed contact at the start of the step \[s\].
    fn start_of(
        &self,
        run: &RunState<'_>,
        contact: usize,
        episode: &Episode,
        step: f64,
    ) -> StepStart {
        let system_contact = &run.system.contacts[contact];
        let [shift, shift_rate, _] = run.grounds.closing(contact, 0);
        let [closing, rate] = [&self.state.displacement, &self.state.velocity]
            .map(|list| system_contact.ports.closing(list));
        StepStart {
            step,
            slip: self.slip_now(run, contact),
            indentation: [closing + shift - run.widths[contact], rate + shift_rate],
            force: episode.friction.force,
            origin: episode.friction.origin,
        }
    }

    /// Friction along a closed contact among the unknowns of the step; `index`: its place among the trials.
    pub(super) fn friction_in_step(
        &self,
        run: &RunState<'_>,
        index: usize,
        contact: usize,
        rate_gain: f64,
        step: f64,
    ) -> Option<Closed> {
        let ContactPhase::Closed(episode) = &run.phases[contact] else {
            return None;
        };
        let law = run.system.contacts[contact].friction.as_ref()?.law;
        let trial = &run.trials[index];
        Some(Closed {
            contact: index,
            law: ForceLaw::Hertz {
                stiffness: 0.0,
                damping: 0.0,
            },
            memory: episode.memory,
            free: trial.indentation,
            free_rate: trial.rate,
            rate_gain,
            indentation: trial.indentation,
            force: 0.0,
            start_slope: 0.0,
            turn: None,
            start_acceleration: 0.0,
            friction: Some(StepFriction {
                contact,
                // Known once all are listed.
                normal: 0,
                law,
                origin: episode.friction.origin,
                pressed: episode.force,
                start: Some(self.start_of(run, contact, episode, step)),
            }),
            link: None,
        })
    }

    /// Adds impulse and work of friction along a contact over the tried step to its episode.
    pub(super) fn gather_friction(
        &mut self,
        run: &RunState<'_>,
        contact: usize,
        episode: &mut Episode,
        step: f64,
    ) {
        let Some((place, friction)) = self.friction_along(run, contact) else {
            return;
        };
        let trial = &run.trials[place];
        let (law, memory) = (run.system.contacts[contact].law, episode.memory);
        let [slip, pressing] =
            [place, contact].map(|index| [run.trials[index].indentation, run.trials[index].rate]);
        let start = self.start_of(run, contact, episode, step);
        let mut following = StepFriction {
            contact,
            normal: contact,
            law: friction.law,
            origin: start.origin,
            pressed: run.trials[contact].force,
            start: None,
        };
        let press = |deep: f64, rate: f64| law.follow(deep, rate, &memory).force;
        self.friction_paths[place - run.phases.len() - run.system.links.len()] =
            following.follow_from(&start, slip, pressing, press);
        let friction = &mut episode.friction;
        let mean = 0.5 * (friction.force + trial.force);
        let [from, rate] = start.slip;
        let slipped = trial.indentation - from;
        friction.impulse += step * mean;
        friction.work += mean * slipped;
        self.audit.friction += mean * slipped;
        self.audit.ground += mean * moved_by_grounds(run, place);
        let slip = Cubic::new(from, rate, trial.indentation, trial.rate, step);
        for at in slip.turning_points().chain([1.0]) {
            friction.slip_peak = friction
                .slip_peak
                .max((slip.value(at) - friction.touched_at).abs());
        }
    }

    /// Brings friction along a contact to the end of an accepted step with its start and length \[s\].
    pub(super) fn finish_friction(
        &self,
        run: &RunState<'_>,
        contact: usize,
        episode: &mut Episode,
        pressed: &StepForce,
        span: [f64; 2],
    ) -> Option<FrictionPath> {
        let (place, friction) = self.friction_along(run, contact)?;
        let (law, trial) = (friction.law, &run.trials[place]);
        let friction = &mut episode.friction;
        let greatest = pressed.ends[0].max(pressed.ends[1]).max(pressed.peak.value);
        let mut path = self.friction_paths[place - run.phases.len() - run.system.links.len()];
        path.ends[FRICTION_PARTS - 1] = trial.force;
        friction
            .peak
            .widen(&[path], law.coefficient * greatest, span);
        friction.origin = law.origin(trial.indentation, trial.force);
        friction.force = trial.force;
        Some(path)
    }
}
