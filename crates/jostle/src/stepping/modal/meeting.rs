//! Contacts in modal coordinates: closing, forces, opening.

use std::f64::consts::PI;

use super::walk::Walk;
use crate::contact::{ContactResponse, ForceLaw, momentum};
use crate::history::Impact;
use crate::state::{ContactPhase, Episode};
use crate::stepping::clock::Stride;
use crate::stepping::control;
use crate::stepping::coupling::Closed;
use crate::stepping::events::{Crossing, Cubic};
use crate::stepping::impacts::{
    AT_ONCE, Event, MOST_BLOWS, SLOWEST_IMPACT, TOGETHER, TOUCH, impact_of,
};
use crate::stepping::outcome::StepError;

/// Smallest and largest number of parts of a free-vibration step after a jump of velocities: dashpots and high
/// modes respond quickly and decay soon.
const AFTER_BLOW: [u32; 2] = [16, 1024];
/// Number of steps then in which accelerations are evaluated at their ends only.
const STRUCK_STEPS: u32 = 2;
/// Steps per radian of the fastest mode after an impact of the momentum law.
const STEPS_PER_RADIAN: f64 = 2.0;
/// Offset at which the slope of a force is evaluated, as a fraction of a step: beyond any corner at which the last
/// step ended.
const AHEAD: f64 = 1e-3;
/// Parts of a step in which a force starts or ends.
const CORNER_PARTS: u32 = 16;

/// A contact force predicted at the start of a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Foreseen {
    /// At the end of the step \[N\].
    pub(super) end: f64,
    /// Its slope at the start \[N/s\].
    slope: f64,
    /// Increment over the step with the initial slope of the parabola of the same mean and end \[N\].
    rise: f64,
}

impl Foreseen {
    /// b in F₀ + (F₁ − F₀)τ + b(τ² − τ), a parabola with the predicted initial slope \[N\].
    pub(super) fn bend(&self, start: f64, end: f64) -> f64 {
        end - start - self.rise
    }
}

impl Walk<'_> {
    /// Motion of contact `index` over the trial step.
    pub(super) fn indentation_curve(&self, index: usize, step: f64) -> Cubic {
        let trial = &self.trials[index];
        Cubic::new(
            self.reduced.closing(index, &self.u[0]) - self.system.contacts[index].width,
            self.reduced.closing(index, &self.rate[0]),
            trial.indentation,
            trial.rate,
            step,
        )
    }

    /// The first contact, or release with a jump of force, in the trial step.
    pub(super) fn first_event(&self, step: f64) -> Option<Event> {
        if !self.pounding {
            return None;
        }
        let mut first: Option<Event> = None;
        for contact in 0..self.phases.len() {
            let Some(crossing) = self.awaited(contact) else {
                continue;
            };
            let curve = self.indentation_curve(contact, step);
            if let Some(at) = curve.first_crossing(crossing)
                && first.is_none_or(|event| at < event.at)
            {
                let event = Event {
                    contact,
                    crossing,
                    at,
                };
                if !self.undoes_a_touch(&event, step) {
                    first = Some(event);
                }
            }
        }
        first
    }

    /// A closed contact that would open and close again within the trial step.
    pub(super) fn opens_unseen(&self, step: f64) -> Option<usize> {
        let closed = self.coupling.closed.iter();
        let mut unseen = closed.filter(|closed| {
            let trial = &self.trials[closed.contact];
            let parting = self.reduced.closing(closed.contact, &self.rate[0]) < 0.0;
            if !parting || trial.rate <= 0.0 || closed.law.jumps_at_release() {
                return false;
            }
            let curve = self.indentation_curve(closed.contact, step);
            curve.turning_points().any(|at| curve.value(at) < 0.0)
        });
        unseen.next().map(|closed| closed.contact)
    }

    /// A closed contact whose force differs from the prediction by more than the greatest force so far: the
    /// predicted mean is then meaningless.
    pub(super) fn goes_unforeseen(&self) -> Option<usize> {
        if !self.plan.chooses_contact_steps() {
            return None;
        }
        let mut closed = self.coupling.closed.iter().map(|closed| closed.contact);
        closed.find(|&index| {
            let known = match self.phases[index] {
                ContactPhase::Closed(episode) => episode.force.abs(),
                ContactPhase::Open => 0.0,
            };
            let strongest = self.strongest[self.system.contacts[index].gap];
            let missed = (self.trials[index].force - self.foreseen[index].end).abs();
            missed > known.max(strongest)
        })
    }

    /// Whether a contact would open at the very instant at which it closed.
    fn undoes_a_touch(&self, event: &Event, step: f64) -> bool {
        matches!(self.phases[event.contact], ContactPhase::Closed(episode)
            if event.crossing == Crossing::Downwards && episode.since == self.time)
            && event.at * step <= self.shortest_step(event)
    }

    /// An event within this time occurs at the start of the step \[s\].
    pub(super) fn shortest_step(&self, event: &Event) -> f64 {
        let contact = &self.system.contacts[event.contact];
        let division = self.plan.division(contact, self.trials[event.contact].rate);
        AT_ONCE * self.plan.step / f64::from(self.division().max(division))
    }

    /// Repeats the step so that it ends on an event, or on an earlier one found in the repetition; false if that
    /// one occurred at the start and time does not advance.
    pub(super) fn step_to(&mut self, mut event: Event, stride: &Stride) -> Result<bool, StepError> {
        let mut length = event.at * stride.length;
        for _ in 0..20 {
            self.set_odd(length);
            self.try_step(0, self.clock.after(length))?;
            if let Some(other) = self
                .first_event(length)
                .filter(|other| other.contact != event.contact && other.at < 1.0 - 1e-9)
            {
                if other.at * length <= self.shortest_step(&other) {
                    self.read_contacts();
                    self.happen(other);
                    return Ok(false);
                }
                event = other;
                length *= other.at;
                continue;
            }
            let trial = self.trials[event.contact];
            let corrected = length - trial.indentation / trial.rate;
            let wrong_way = (event.crossing == Crossing::Upwards) != (trial.rate > 0.0);
            if trial.indentation.abs() <= TOUCH
                || wrong_way
                || !(corrected > 0.0 && corrected < stride.length)
            {
                break;
            }
            length = corrected;
            self.work.repeated_steps += 1;
        }
        let trial = self.trials[event.contact];
        let reached = match event.crossing {
            Crossing::Upwards => trial.indentation >= -TOGETHER && trial.rate > 0.0,
            Crossing::Downwards => trial.indentation <= TOGETHER && trial.rate < 0.0,
        };
        let tried = self.tables[0].step;
        if let Some(contact) = self.opens_unseen(tried) {
            let finer = self.plan.finer(self.division());
            if finer > self.contact_division[contact] && self.plan.chooses_contact_steps() {
                self.contact_division[contact] = finer;
                return Ok(false);
            }
        }
        self.accept(0, self.clock.after(tried));
        if reached {
            self.read_contacts();
            self.happen(event);
        }
        Ok(true)
    }

    /// Closes or opens contacts at the present instant, with the indentations and rates in `trials`.
    pub(super) fn happen(&mut self, event: Event) {
        let time = self.time;
        if event.crossing == Crossing::Downwards {
            if let ContactPhase::Closed(mut episode) = self.phases[event.contact] {
                self.jump(event.contact, -episode.force);
                (episode.end, episode.separation_speed) = (time, -self.trials[event.contact].rate);
                self.report_impact(event.contact, &episode, true);
                self.open(event.contact);
            }
            return;
        }
        let struck = self.strike(event.contact);
        for index in 0..self.phases.len() {
            if (index == event.contact && !struck) || self.is_closing(index) {
                self.close(index);
            }
        }
    }

    fn open(&mut self, index: usize) {
        self.phases[index] = ContactPhase::Open;
        self.clearance[index] = 0.0;
        self.open_steps[index] = 0;
    }

    /// Whether an open contact closes now.
    fn is_closing(&self, index: usize) -> bool {
        let trial = &self.trials[index];
        self.is_open(index) && trial.indentation >= -TOGETHER && trial.rate > 0.0
    }

    /// Applies momentum laws to a contact and all others that close at this instant, one after the other, until
    /// none is closing. Returns whether the given contact had an impact.
    fn strike(&mut self, first: usize) -> bool {
        let mut struck = false;
        let mut next = Some(first);
        for _ in 0..MOST_BLOWS {
            let Some(index) = next else { break };
            let rate = self.trials[index].rate;
            if let Some(restitution) = self.system.contacts[index].law.rebound(rate) {
                struck |= index == first;
                self.blow(index, restitution, rate);
            } else if index != first {
                break;
            }
            next = (0..self.phases.len()).find(|&other| {
                let law = &self.system.contacts[other].law;
                self.is_closing(other) && law.rebound(self.trials[other].rate).is_some()
            });
        }
        if struck {
            self.struck = STRUCK_STEPS;
            self.follow_jumps();
            self.start_anew();
        }
        struck
    }

    /// Forces of closed contacts with dashpots after velocities have jumped.
    fn follow_jumps(&mut self) {
        for index in 0..self.phases.len() {
            if let ContactPhase::Closed(mut episode) = self.phases[index] {
                let law = &self.system.contacts[index].law;
                let change = episode.jump(law, &self.trials[index], self.time);
                self.phases[index] = ContactPhase::Closed(episode);
                self.reduced.push_apart(index, change, &mut self.p[0]);
            }
        }
    }

    /// A contact closing at `rate` opens instantly at `restitution` times that rate.
    fn blow(&mut self, index: usize, restitution: f64, rate: f64) {
        let contact = &self.system.contacts[index];
        let impulse = momentum::impulse(restitution, contact.effective_mass(), rate);
        let before: f64 = self.v[0].iter().map(|v| 0.5 * v * v).sum();
        self.reduced.push_apart(index, impulse, &mut self.v[0]);
        let division = self.division_after_blow(index);
        self.contact_division[index] = self.contact_division[index].max(division);
        self.open_steps[index] = 0;
        let dissipated = before - self.v[0].iter().map(|v| 0.5 * v * v).sum::<f64>();
        self.energy.contact += dissipated;
        let watched = [&mut self.u[0][..], &mut self.rate[0][..]];
        self.reduced.show([&self.q[0], &self.v[0]], watched);
        self.read_contacts();
        let time = self.time;
        self.impacts.push(Impact {
            contact: index,
            start: time,
            end: time,
            peak_force: 0.0,
            peak_force_at: time,
            peak_indentation: 0.0,
            impact_speed: rate,
            separation_speed: -self.trials[index].rate,
            finished: true,
            impulse,
            dissipated,
        });
    }

    /// Division of free-vibration steps that resolves the fastest modes of buildings after an impact.
    fn division_after_blow(&self, index: usize) -> u32 {
        let struck = self.system.contacts[index].faces.buildings();
        let modes = struck.into_iter().flatten().flat_map(|building| {
            let modes = self.reduced.buildings[building].modes.clone();
            &self.reduced.stiffness[modes]
        });
        let quickest = modes.fold(0.0_f64, |most, k| most.max(*k)).sqrt();
        let wanted = (STEPS_PER_RADIAN * quickest * self.plan.step).ceil() as u32;
        let [fewest, most] = AFTER_BLOW;
        wanted.next_power_of_two().clamp(fewest, most)
    }

    /// The force of a contact starts.
    fn close(&mut self, index: usize) {
        let contact = &self.system.contacts[index];
        let rate = self.trials[index].rate.max(0.0);
        self.doubt_touch(index, rate);
        let mut episode =
            Episode::new(self.time, rate.max(SLOWEST_IMPACT), contact.law.touch(rate));
        episode.force = contact.law.onset(rate);
        episode.peak_force = episode.force;
        let expected = contact.law.elastic_force(contact.effective_mass(), rate);
        let strongest = &mut self.strongest[contact.gap];
        *strongest = strongest.max(expected);
        let share = if *strongest > 0.0 {
            expected / *strongest
        } else {
            0.0
        };
        let mut division = self.plan.first_division(contact, rate, share);
        // A slow first contact may be followed by a large force.
        let acceleration = self.reduced.closing(index, &self.acceleration[0]);
        loop {
            let step = self.plan.step / f64::from(division);
            let end = rate + acceleration * step;
            let reached = 0.5 * step * (rate + end);
            let stiffness = contact
                .law
                .follow(reached, end, &episode.memory)
                .by_indentation;
            if !self.plan.is_too_coarse(division, contact, stiffness) {
                break;
            }
            division = self.plan.finer(division);
        }
        self.contact_division[index] = division;
        self.finest_in_contact = self.finest_in_contact.max(division);
        self.phases[index] = ContactPhase::Closed(episode);
        self.reduced
            .push_apart(index, episode.force, &mut self.p[0]);
        self.start_anew();
    }

    /// A sudden change of a contact force.
    fn jump(&mut self, index: usize, change: f64) {
        if change != 0.0 {
            self.reduced.push_apart(index, change, &mut self.p[0]);
            self.start_anew();
        }
    }

    /// Loads of the trial step before the end forces are known: every contact force starts as predicted and is a
    /// parabola that ends at zero. An end force is then added as the square of time.
    pub(super) fn let_forces_set_out(&mut self, step: f64) {
        self.bend.fill(0.0);
        self.coupling.clear();
        for (index, phase) in self.phases.iter().enumerate() {
            let ContactPhase::Closed(episode) = phase else {
                continue;
            };
            let foreseen = self.foresee(index, episode, step);
            let closed = Closed {
                contact: index,
                law: self.system.contacts[index].law,
                memory: episode.memory,
                free: 0.0,
                free_rate: 0.0,
                rate_gain: 0.0,
                indentation: 0.0,
                force: 0.0,
                start_slope: foreseen.slope,
                turn: None,
                start_acceleration: 0.0,
            };
            let bend = foreseen.bend(episode.force, 0.0);
            self.reduced.push_apart(index, bend, &mut self.bend);
            self.coupling.closed.push(closed);
            self.foreseen[index] = foreseen;
        }
    }

    /// A contact force over a step for the present relative acceleration and jerk.
    fn foresee(&self, index: usize, episode: &Episode, step: f64) -> Foreseen {
        let contact = &self.system.contacts[index];
        let closing = |watched: &[Vec<f64>; 2]| self.reduced.closing(index, &watched[0]);
        let start = closing(&self.u) - self.system.contacts[index].width;
        let (rate, acceleration) = (closing(&self.rate), closing(&self.acceleration));
        let driven = self.reduced.closing(index, self.peaks.driven());
        let jerk = closing(&self.loose) - driven * (self.ground[1] - self.ground[0]) / step;
        let respond =
            |indentation: f64, rate: f64| contact.law.follow(indentation, rate, &episode.memory);
        let force = |share: f64| {
            let t = share * step;
            let indentation = start + t * (rate + t / 2.0 * (acceleration + t / 3.0 * jerk));
            let rate = rate + t * (acceleration + t / 2.0 * jerk);
            respond(indentation, rate).force
        };
        let (before, half, end) = (episode.force, force(0.5), force(1.0));
        let smooth = before != 0.0 && end != 0.0;
        let mean = if smooth {
            (before + 4.0 * half + end) / 6.0
        } else {
            // Forces start with different powers of time, and end within a step.
            let parts = f64::from(CORNER_PARTS);
            let at = |part: u32| force(f64::from(part) / parts);
            let inside = |first: u32| (first..CORNER_PARTS).step_by(2).map(at).sum::<f64>();
            (before + 4.0 * inside(1) + 2.0 * inside(2) + end) / (3.0 * parts)
        };
        let rise = 6.0 * mean - 4.0 * before - 2.0 * end;
        let slope = if episode.since == self.time {
            // The laws have not been updated yet.
            rise / step
        } else {
            let response = respond(start, rate);
            response.by_indentation * rate + response.by_rate * acceleration
        };
        Foreseen { end, slope, rise }
    }

    /// Rate of a contact force just after the present; modal accelerations are in `scratch` \[N/s\].
    pub(super) fn slope_from_here(&self, index: usize) -> f64 {
        let ContactPhase::Closed(episode) = self.phases[index] else {
            return 0.0;
        };
        let law = &self.system.contacts[index].law;
        if law.starts_steeply() && episode.since == self.time {
            // A cubic cannot follow a root of time.
            return 0.0;
        }
        let ahead = AHEAD * self.plan.step / f64::from(self.contact_division[index]);
        let acceleration = self.relative_acceleration(index);
        let width = self.system.contacts[index].width;
        let rate = self.reduced.closing(index, &self.rate[0]) + acceleration * ahead;
        let indentation = self.reduced.closing(index, &self.u[0]) - width + rate * ahead;
        let response = law.follow(indentation, rate, &episode.memory);
        response.by_indentation * rate + response.by_rate * acceleration
    }

    /// Relative acceleration of the points of a contact; modal ones are in `scratch` \[m/s²\].
    fn relative_acceleration(&self, index: usize) -> f64 {
        self.reduced.closing_of_modes(index, &self.scratch)
    }

    /// Updates every closed contact over the step, before the state changes.
    pub(super) fn gather_episodes(&mut self, step: f64) {
        for closed in 0..self.coupling.closed.len() {
            let index = self.coupling.closed[closed].contact;
            let ContactPhase::Closed(mut episode) = self.phases[index] else {
                continue;
            };
            let (law, start) = (self.system.contacts[index].law, self.time);
            let curve = self.indentation_curve(index, step);
            let trial = self.trials[index];
            let force = [episode.force, trial.force];
            let bend = self.foreseen[index].bend(force[0], force[1]);
            episode.impulse += step * (0.5 * (force[0] + force[1]) - bend / 6.0);
            self.coupling.closed[closed].turn =
                episode.follow_indentation(&law, &curve, &trial, start, step);
            self.phases[index] = ContactPhase::Closed(episode);
        }
    }

    /// Updates peaks of forces and opened contacts, after the state has changed.
    pub(super) fn finish_episodes(&mut self, step: f64, start: f64) {
        for closed in 0..self.coupling.closed.len() {
            let index = self.coupling.closed[closed].contact;
            let ContactPhase::Closed(mut episode) = self.phases[index] else {
                continue;
            };
            let trial = self.trials[index];
            let (law, turn) = (
                self.system.contacts[index].law,
                self.coupling.closed[closed].turn,
            );
            let response = law.follow(trial.indentation, trial.rate, &episode.memory);
            let acceleration = self.relative_acceleration(index);
            let slope = if self.at_corner {
                // Before the corner at which the step ends, on its own side.
                let back = -AHEAD * step;
                let (depth, rate) = (
                    trial.indentation + trial.rate * back,
                    trial.rate + acceleration * back,
                );
                let before = law.follow(depth, rate, &episode.memory);
                before.by_indentation * rate + before.by_rate * acceleration
            } else {
                response.by_indentation * trial.rate + response.by_rate * acceleration
            };
            let slopes = [self.coupling.closed[closed].start_slope, slope];
            episode.follow_force(&law, &trial, slopes, turn, start, step);
            // The slope at the end also applies if the contact opens there.
            self.reduced.push_apart(index, slope, &mut self.jerk);
            if episode.since < start {
                self.control_division(index, step, &response, &episode);
            }
            if episode.advance(&law, &trial, turn) {
                self.report_impact(index, &episode, true);
                self.open(index);
            } else {
                self.phases[index] = ContactPhase::Closed(episode);
            }
        }
    }

    /// After a step of a closed contact: finer steps where its error endangers the tolerance, coarser ones where the grid
    /// allows and the error is far below (theory, Eq. Q6).
    ///
    /// The predicted motion omits terms of fourth order in h, so its end force has an error e, and the step has an
    /// error of h e/24 in the impulse. Over the π/(ωh) steps of half a cycle at the present contact stiffness, this
    /// is an error of the force of π e/24. A factor of four covers forces that start as t^1.5, which have larger
    /// errors.
    fn control_division(
        &mut self,
        index: usize,
        step: f64,
        response: &ContactResponse,
        episode: &Episode,
    ) {
        let stiffness = response.by_indentation;
        let contact = &self.system.contacts[index];
        let strongest = &mut self.strongest[contact.gap];
        *strongest = strongest.max(episode.peak_force);
        let missed = (self.trials[index].force - self.foreseen[index].end).abs();
        let observed = control::Observed {
            step,
            stiffness,
            damping: response.by_rate,
            error: PI / 6.0 * missed / *strongest,
            order: 4,
        };
        let division = &mut self.contact_division[index];
        *division = if self.plan.is_too_coarse(*division, contact, stiffness) {
            self.plan.finer(*division)
        } else {
            control::next_division(self.plan, contact, &observed, *division, &self.clock)
        };
        self.finest_in_contact = self.finest_in_contact.max(*division);
    }

    /// Distance within which a contact may be made or missed within the tolerance \[m\].
    pub(super) fn doubt(&self, index: usize) -> f64 {
        self.tolerance
            * self.system.contacts[index]
                .width
                .max(self.peaks.closing[index].value)
    }

    /// Records a marginal contact: small indentation, small opening before it, or lasting contact because of a low
    /// speed.
    fn doubt_touch(&mut self, index: usize, rate: f64) {
        let doubt = self.doubt(index);
        let acceleration = self.reduced.closing(index, &self.acceleration[0]);
        let turns = acceleration < 0.0 && rate * rate < -2.0 * acceleration * doubt;
        let law = &self.system.contacts[index].law;
        let rests = matches!(law, ForceLaw::Restitution { .. });
        if turns || rests || self.clearance[index] < doubt {
            self.doubtful_from.get_or_insert(self.time);
        }
    }

    /// Records contacts that nearly closed, or nearly opened, in the trial step.
    pub(super) fn doubt_turns(&mut self, step: f64) {
        for index in 0..self.phases.len() {
            let (then, now) = (
                self.reduced.closing(index, &self.rate[0]),
                self.trials[index].rate,
            );
            if self.is_open(index) {
                let clear = -self.trials[index].indentation;
                self.clearance[index] = self.clearance[index].max(clear);
            }
            if then * now >= 0.0 {
                continue;
            }
            let curve = self.indentation_curve(index, step);
            let nearest = curve
                .turning_points()
                .map(|at| curve.value(at).abs())
                .fold(f64::INFINITY, f64::min);
            if nearest < self.doubt(index) {
                self.doubtful_from.get_or_insert(self.time);
            }
        }
    }

    /// Adds an episode to the impacts, if it counts as one.
    pub(super) fn report_impact(&mut self, contact: usize, episode: &Episode, finished: bool) {
        self.impacts.extend(impact_of(contact, episode, finished));
    }
}
