//! Contacts that close, push and open, in modal coordinates.

use super::stepper::ModalStepper;
use crate::contact::momentum;
use crate::simd;
use crate::state::{ContactPhase, Episode};
use crate::stepping::coupling::Closed;
use crate::stepping::predicted_force::{AHEAD, Drift, PredictedForce};
use crate::stepping::runner::{Jump, RunState};
use crate::stepping::step_friction::{FRICTION_PARTS, StepFriction};

/// Fewest and most parts of a free step after velocities have jumped: dashpots and high modes answer at once, and soon no
/// more.
const AFTER_JUMP: [u32; 2] = [16, 1024];
/// Steps then in which accelerations are taken at their ends only.
pub(super) const STRUCK_STEPS: u32 = 2;
/// Steps per radian of the highest mode after a momentum impact.
const STEPS_PER_RADIAN: f64 = 2.0;
/// Friction of a closed contact, if it has any.
fn friction_of(run: &RunState<'_>, contact: usize, episode: &Episode) -> Option<StepFriction> {
    let law = run.system.contacts[contact].friction.as_ref()?.law;
    let mut closed = run.coupling.closed.iter();
    Some(StepFriction {
        contact,
        normal: closed.position(|closed| closed.contact == contact)?,
        law,
        origin: episode.friction.origin,
        pressed: episode.force,
        start: None,
    })
}

impl ModalStepper<'_> {
    /// A contact closing at `rate` opens at once with `restitution` times that.
    pub(super) fn strike(
        &mut self,
        run: &mut RunState<'_>,
        index: usize,
        restitution: f64,
        rate: f64,
    ) -> Jump {
        let contact = &run.system.contacts[index];
        let impulse = momentum::impulse(restitution, contact.effective_mass(), rate);
        let before: f64 = self.v[0].iter().map(|v| 0.5 * v * v).sum();
        self.reduced.push_apart(index, impulse, &mut self.v[0]);
        let division = self.division_after_jump(run, index);
        run.contact_division[index] = run.contact_division[index].max(division);
        self.open_steps[index] = 0;
        let dissipated = before - self.v[0].iter().map(|v| 0.5 * v * v).sum::<f64>();
        let by_grounds = impulse * run.grounds.closing(index, 0)[1];
        let dissipated = dissipated + by_grounds;
        self.energy.contact += dissipated;
        self.energy.ground += by_grounds;
        let [rate, before] = &mut self.rate;
        before.copy_from_slice(rate);
        let watched = [&mut self.u[0][..], &mut rate[..]];
        self.reduced.show_all([&self.q[0], &self.v[0]], watched);
        self.add_grounds(run, 0);
        self.jump_links();
        Jump {
            impulse,
            dissipated,
            separation_speed: -self.reduced.closing(index, &self.rate[0]),
        }
    }

    /// Division of free-vibration steps that resolves the highest modes of buildings after a momentum impact.
    fn division_after_jump(&self, run: &RunState<'_>, index: usize) -> u32 {
        let struck = run.system.contacts[index].ports.buildings();
        let modes = struck.into_iter().flatten().flat_map(|building| {
            let modes = self.reduced.buildings[building].modes.clone();
            &self.reduced.stiffness[modes]
        });
        let highest = modes.fold(0.0_f64, |most, k| most.max(*k)).sqrt();
        let wanted = (STEPS_PER_RADIAN * highest * run.plan.step).ceil() as u32;
        let [fewest, most] = AFTER_JUMP;
        wanted.next_power_of_two().clamp(fewest, most)
    }

    /// Loads of the tried step while nothing is known of the forces at its end: every contact force begins as predicted,
    /// and bends so that it ends at nothing. Then a force at the end sets in as the square of time.
    pub(super) fn predict_forces(&mut self, run: &mut RunState<'_>, step: f64) {
        self.bend.fill(0.0);
        run.coupling.clear();
        for (place, &index) in self.reduced.graph.order.iter().enumerate() {
            let contact = self.reduced.contact_of[index];
            let ContactPhase::Closed(episode) = &run.phases[contact] else {
                continue;
            };
            let (friction, predicted, start) = if contact == index {
                let mut drift = self.drift(run, index, step);
                drift.start -= run.widths[index];
                let pressed = &run.system.contacts[index];
                let predicted =
                    PredictedForce::of_contact(pressed, episode, drift, [run.time, step]);
                (None, predicted, episode.force)
            } else {
                let Some(mut friction) = friction_of(run, contact, episode) else {
                    continue;
                };
                let before = episode.friction.force;
                let predicted = self.predict_friction(run, index, &mut friction, before, step);
                (Some(friction), predicted, before)
            };
            let closed = Closed {
                contact: index,
                friction,
                law: run.system.contacts[contact].law,
                memory: episode.memory,
                free: 0.0,
                free_rate: 0.0,
                rate_gain: 0.0,
                indentation: 0.0,
                force: 0.0,
                start_slope: predicted.slope,
                turn: None,
                start_acceleration: 0.0,
                link: None,
            };
            if self.reduced.plan.is_none() {
                let bend = predicted.bend(start, 0.0);
                self.reduced.push_apart(index, bend, &mut self.bend);
            }
            run.coupling.closed.push(closed);
            run.coupling.places.push(place);
            self.predicted[index] = predicted;
        }
        self.push_bends_in_plan(run);
    }

    /// Bends of the forces of contacts of buildings in space, face by face.
    fn push_bends_in_plan(&mut self, run: &RunState<'_>) {
        let Some(plan) = &self.reduced.plan else {
            return;
        };
        let closed = &run.coupling.closed;
        if closed.is_empty() {
            return;
        }
        let equations = &mut self.plan_equations;
        equations.list_points(plan, closed);
        for (point, closed_contact) in closed.iter().enumerate() {
            let start = match (&closed_contact.friction, closed_contact.contact) {
                (Some(friction), _) => match &run.phases[friction.contact] {
                    ContactPhase::Closed(episode) => episode.friction.force,
                    ContactPhase::Open => 0.0,
                },
                (None, contact) => run.phases[contact].force(),
            };
            let bend = self.predicted[closed_contact.contact].bend(start, 0.0);
            equations.add_bend(point, bend);
        }
        equations.push_bends(self.reduced, plan, &mut self.bend);
    }

    /// Relative motion of a contact over a step if its faces go on as they accelerate now.
    fn drift(&self, run: &RunState<'_>, index: usize, step: f64) -> Drift {
        let closing = |watched: &[Vec<f64>; 2]| self.reduced.closing(index, &watched[0]);
        let [along, across, _] = self.peaks.driven();
        if run.grounds_at(0).is_split() {
            return self.drift_on_own_grounds(run, index, step);
        }
        let driven = self.reduced.closing(index, along);
        let [then, now] = run.ground;
        let mut jerk = closing(&self.unloaded_jerk) - driven * (now[0] - then[0]) / step;
        if !across.is_empty() {
            jerk -= self.reduced.closing(index, across) * (now[1] - then[1]) / step;
        }
        Drift {
            start: closing(&self.u),
            rate: closing(&self.rate),
            acceleration: closing(&self.acceleration),
            jerk,
        }
    }

    /// The same on grounds that differ.
    fn drift_on_own_grounds(&self, run: &RunState<'_>, index: usize, step: f64) -> Drift {
        let closing = |watched: &[Vec<f64>; 2]| self.reduced.closing(index, &watched[0]);
        let [then, now] = [0, 1].map(|time| run.grounds_at(time));
        let joint = self.reduced.joint_of_port(index);
        let [moved_then, moved_now] = [0, 1].map(|time| run.grounds.closing(joint, time)[2]);
        let mut jerk = closing(&self.unloaded_jerk) + (moved_now - moved_then) / step;
        let rate_under = |building: usize| {
            let [then, now] = [then, now].map(|all| all.of(building));
            [0, 1, 2].map(|axis| (now[axis] - then[axis]) / step)
        };
        if let Some(plan) = &self.reduced.plan {
            for (share, side) in plan.sides_of(index) {
                let driven = [&self.reduced.participation, &self.reduced.across];
                for (rate, list) in rate_under(side.building).into_iter().zip(driven) {
                    let driven = &list[side.modes.clone()];
                    jerk += share * simd::dot(&side.loads[..driven.len()], driven) * rate;
                }
            }
        }
        let sides = self.reduced.ports[index].into_iter().zip([1.0, -1.0]);
        for (port, sign) in sides {
            let Some(port) = port else { continue };
            let rate = rate_under(port.building);
            jerk -= sign * self.peaks.driven_by(port.watched, rate);
        }
        Drift {
            start: closing(&self.u),
            rate: closing(&self.rate),
            acceleration: closing(&self.acceleration),
            jerk,
        }
    }

    /// Friction over a step if the faces go on as they accelerate now.
    fn predict_friction(
        &mut self,
        run: &RunState<'_>,
        index: usize,
        friction: &mut StepFriction,
        before: f64,
        step: f64,
    ) -> PredictedForce {
        let ContactPhase::Closed(episode) = &run.phases[friction.contact] else {
            return PredictedForce::default();
        };
        let contact = &run.system.contacts[friction.contact];
        let pressing = self.drift(run, friction.contact, step);
        let sliding = self.drift(run, index, step);
        let width = run.widths[friction.contact];
        let path = friction.follow(before, |share| {
            let [closing, rate] = pressing.after(share * step);
            let indentation = closing - width;
            let pressed = contact.law.follow(indentation, rate, &episode.memory);
            [sliding.after(share * step)[0], pressed.force]
        });
        self.friction_paths[index - run.phases.len()] = path;
        let end = path.end();
        PredictedForce {
            end,
            slope: (path.ends[0] - before) * FRICTION_PARTS as f64 / step,
            rise: 6.0 * path.mean() - 4.0 * before - 2.0 * end,
        }
    }

    /// Rate of a contact force just after the present; modal accelerations stand in `scratch` \[N/s\].
    pub(super) fn slope_from_here(&self, run: &RunState<'_>, index: usize) -> f64 {
        let ContactPhase::Closed(episode) = run.phases[index] else {
            return 0.0;
        };
        let law = &run.system.contacts[index].law;
        if law.starts_steeply() && episode.since == run.time {
            // No cubic follows a root of the time.
            return 0.0;
        }
        let ahead = AHEAD * run.plan.step / f64::from(run.contact_division[index]);
        let acceleration = self.relative_acceleration(run, index);
        let width = run.widths[index];
        let rate = self.reduced.closing(index, &self.rate[0]) + acceleration * ahead;
        let indentation = self.reduced.closing(index, &self.u[0]) - width + rate * ahead;
        let response = law.follow(indentation, rate, &episode.memory);
        response.by_indentation * rate + response.by_rate * acceleration
    }

    /// Relative acceleration of the faces of a contact; modal ones stand in `scratch`, in space those of ends of faces are known
    /// \[m/s²\].
    pub(super) fn relative_acceleration(&self, run: &RunState<'_>, index: usize) -> f64 {
        let apart = match &self.reduced.plan {
            Some(plan) => self.plan_equations.acceleration(plan, index),
            None => self.reduced.closing_of_modes(index, &self.scratch),
        };
        apart + run.grounds.closing(index, 0)[2]
    }
}
