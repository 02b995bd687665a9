//! Contacts that close and open: found in tried steps, and applied.

use super::{RunState, Runner, Stepper};
use crate::history::{Impact, Sliding};
use crate::state::{ContactPhase, Episode};
use crate::stepping::clock::NextStep;
use crate::stepping::events::{Crossing, Cubic};
use crate::stepping::outcome::StepError;

/// What a tried step would do at a contact.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::stepping) struct ContactTrial {
    pub(in crate::stepping) indentation: f64,
    pub(in crate::stepping) rate: f64,
    pub(in crate::stepping) force: f64,
}

/// A contact closes or opens within a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Event {
    pub(super) contact: usize,
    pub(super) crossing: Crossing,
    /// The end of an edge that a corner slides off; `None` where the indentation itself crosses zero.
    pub(super) end: Option<usize>,
    /// Share of the step.
    pub(super) at: f64,
}

/// Where a step that was to end on an event has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Landing {
    /// Where it began: another event happened there first, or finer steps are needed; time stands still.
    AtStart,
    /// Later, on the event or as near as it could be found.
    Later,
}

/// A touch is located when the faces are this close \[m\].
const TOUCH: f64 = 1e-13;
/// Contacts this close to touching, and closing, close together with another \[m\].
pub(crate) const TOGETHER: f64 = 1e-12;
/// An event nearer than this share of a step happens at its start.
pub(super) const AT_ONCE: f64 = 1e-4;
/// Episodes that reach no deeper are grazes, not impacts: a touch is located to a thousandth of this \[m\].
const GRAZE: f64 = 1e-10;
/// Impact speeds are reported as at least this, so that ratios to them are finite \[m/s\].
pub(crate) const SLOWEST_IMPACT: f64 = 1e-9;
/// Sudden changes of velocity at one instant before bodies in touch are left to push each other.
const MOST_JUMPS: usize = 10_000;
/// Corrections of the length of a step that is to end on an event.
const MOST_CORRECTIONS: usize = 12;

impl<S: Stepper> Runner<'_, S> {
    /// The first touch, or release with a jump of force, in the tried step.
    pub(super) fn first_event(&self, step: f64) -> Option<Event> {
        if !self.run.pounding {
            return None;
        }
        let mut first: Option<Event> = None;
        for &contact in &self.run.near {
            if let Some(event) = self.first_sliding_off(contact, step)
                && first.is_none_or(|first| event.at < first.at)
            {
                first = Some(event);
            }
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
                    end: None,
                    at,
                };
                if !self.undoes_a_touch(&event, step) && self.finds_its_edge(&event, step) {
                    first = Some(event);
                }
            }
        }
        first
    }

    /// Where a closed contact of a corner slides off its edge in the tried step.
    fn first_sliding_off(&self, contact: usize, step: f64) -> Option<Event> {
        let ends = self.stepper.edge_ends(contact);
        if ends.is_empty() || self.run.is_open(contact) {
            return None;
        }
        let crossing = Crossing::Downwards;
        let of_end = |end: usize| {
            let at = self.edge_end_curve(end, step).first_crossing(crossing)?;
            Some(Event {
                contact,
                crossing,
                end: Some(end),
                at,
            })
        };
        ends.filter_map(of_end).min_by(|a, b| a.at.total_cmp(&b.at))
    }

    /// Whether the corner of a contact is before its edge at an event that closes it. One that was behind the edge without
    /// touching it is no touch as it comes back.
    fn finds_its_edge(&self, event: &Event, step: f64) -> bool {
        let mut ends = self.stepper.edge_ends(event.contact);
        if ends.is_empty() || event.crossing == Crossing::Downwards {
            return true;
        }
        let width = self.run.widths[event.contact];
        self.stepper.closing(&self.run, event.contact) - width <= TOGETHER
            && ends.all(|end| self.edge_end_curve(end, step).value(event.at) > 0.0)
    }

    /// How far the corner of a contact is inside of an end of its edge over the tried step.
    fn edge_end_curve(&self, end: usize, step: f64) -> Cubic {
        let [now, then] = [false, true].map(|tried| self.stepper.edge_end(&self.run, end, tried));
        Cubic::new(now[0], now[1], then[0], then[1], step)
    }

    /// What crosses zero at an event, at the end of the tried step, and its rate \[m, m/s\].
    fn crossed(&self, event: &Event) -> [f64; 2] {
        let trial = self.run.trials[event.contact];
        match event.end {
            Some(end) => self.stepper.edge_end(&self.run, end, true),
            None => [trial.indentation, trial.rate],
        }
    }

    /// Direction of the crossing that would end the step at a contact.
    fn awaited(&self, contact: usize) -> Option<Crossing> {
        let trial = &self.run.trials[contact];
        if self.run.is_open(contact) {
            let turned_back =
                || trial.rate < 0.0 && self.stepper.closing_rate(&self.run, contact) > 0.0;
            (trial.indentation > 0.0 || turned_back()).then_some(Crossing::Upwards)
        } else {
            let law = &self.run.system.contacts[contact].law;
            (trial.indentation < 0.0 && law.jumps_at_release()).then_some(Crossing::Downwards)
        }
    }

    /// Whether a contact would open at the very instant at which it closed. Where bodies rest against each other,
    /// steps of different length may disagree about which contact closes; it must stay closed for a step.
    fn undoes_a_touch(&self, event: &Event, step: f64) -> bool {
        matches!(self.run.phases[event.contact], ContactPhase::Closed(episode)
            if event.crossing == Crossing::Downwards && episode.since == self.run.time)
            && event.at * step <= self.shortest_step(event)
    }

    /// An event nearer than this happens at the start of the step \[s\].
    pub(super) fn shortest_step(&self, event: &Event) -> f64 {
        let (run, contact) = (&self.run, &self.run.system.contacts[event.contact]);
        let division = run.plan.division(contact, run.trials[event.contact].rate);
        AT_ONCE * run.plan.step / f64::from(self.stepper.division(run).max(division))
    }

    /// Motion of a contact over the tried step.
    pub(super) fn indentation_curve(&self, contact: usize, step: f64) -> Cubic {
        self.run.indentation_curve(&self.stepper, contact, step)
    }

    /// Repeats the step so that it ends on an event, or on an earlier one met on the way.
    pub(super) fn step_to(
        &mut self,
        mut event: Event,
        next: &NextStep,
    ) -> Result<Landing, StepError> {
        let mut length = event.at * next.length;
        for _ in 0..MOST_CORRECTIONS {
            self.try_length(length)?;
            if let Some(other) = self.first_event(length).filter(|other| {
                let is_same = other.contact == event.contact && other.end == event.end;
                !is_same && other.at < 1.0 - 1e-9
            }) {
                if other.at * length <= self.shortest_step(&other) {
                    // It happens before anything moves: no step so short could be taken.
                    self.read_contacts();
                    self.apply_event(other);
                    return Ok(Landing::AtStart);
                }
                event = other;
                length *= other.at;
                continue;
            }
            let [value, rate] = self.crossed(&event);
            let corrected = length - value / rate;
            let wrong_way = (event.crossing == Crossing::Upwards) != (rate > 0.0);
            if value.abs() <= TOUCH || wrong_way || !(corrected > 0.0 && corrected < next.length) {
                break;
            }
            length = corrected;
            self.run.work.repeated_steps += 1;
        }
        let [value, rate] = self.crossed(&event);
        let reached = match event.crossing {
            Crossing::Upwards => value >= -TOGETHER && rate > 0.0,
            Crossing::Downwards => value <= TOGETHER && rate < 0.0,
        };
        // The step that was last tried, should the corrections not have come to an end.
        let tried = self.stepper.length(0);
        if let Some(contact) = self.stepper.contact_that_opens_unseen(&self.run, tried) {
            let finer = self.run.plan.finer(self.stepper.division(&self.run));
            let division = &mut self.run.contact_division[contact];
            if finer > *division && self.run.plan.chooses_contact_steps() {
                *division = finer;
                return Ok(Landing::AtStart);
            }
        }
        self.accept(0, self.run.clock.after(tried))?;
        if reached {
            self.apply_event(event);
        }
        Ok(Landing::Later)
    }

    /// Tries a step of a length from here.
    pub(super) fn try_length(&mut self, length: f64) -> Result<(), StepError> {
        let (run, stepper) = (&mut self.run, &mut self.stepper);
        stepper.prepare_length(run, length)?;
        stepper.try_step(run, 0, run.clock.after(length))
    }

    /// Sets the trials to the present.
    pub(super) fn read_contacts(&mut self) {
        for near in 0..self.run.near.len() {
            let contact = self.run.near[near];
            let width = self.run.widths[contact];
            let indentation = self.stepper.closing(&self.run, contact) - width;
            let rate = self.stepper.closing_rate(&self.run, contact);
            let trial = &mut self.run.trials[contact];
            (trial.indentation, trial.rate) = (indentation, rate);
        }
    }

    /// Closes or opens contacts at the present instant, whose indentations and rates stand in the trials.
    pub(super) fn apply_event(&mut self, event: Event) {
        if event.crossing == Crossing::Downwards {
            self.release(event.contact, event.end.is_some());
        } else {
            let struck = self.apply_momentum_laws(event.contact);
            for near in 0..self.run.near.len() {
                let index = self.run.near[near];
                if (index == event.contact && !struck) || self.is_closing(index) {
                    self.close(index);
                }
            }
        }
        self.stepper.after_event(&self.run);
    }

    /// A contact opens with a jump of its force; `slid_off`: because its corner slid off the edge.
    fn release(&mut self, contact: usize, slid_off: bool) {
        let ContactPhase::Closed(mut episode) = self.run.phases[contact] else {
            return;
        };
        if episode.force != 0.0 {
            self.stepper
                .change_force(&self.run, contact, -episode.force);
            self.stepper
                .change_friction(&self.run, contact, -episode.friction.force);
            self.stepper.restart(&self.run, false);
        }
        episode.end = self.run.time;
        episode.separation_speed = -self.run.trials[contact].rate;
        episode.slid_off = slid_off;
        self.run.report_impact(contact, &episode, true);
        self.run.open(contact, &episode);
        self.stepper.after_release(&self.run, contact);
    }

    /// Whether an open contact touches and closes now.
    fn is_closing(&self, index: usize) -> bool {
        let trial = &self.run.trials[index];
        if !self.run.is_open(index) || trial.indentation < -TOGETHER || trial.rate <= 0.0 {
            return false;
        }
        let mut ends = self.stepper.edge_ends(index);
        ends.is_empty()
            || (trial.indentation <= TOGETHER
                && ends.all(|end| self.stepper.edge_end(&self.run, end, false)[0] > TOGETHER))
    }

    /// Lets momentum laws act on a contact and on all others that touch and close, one after the other, until none
    /// closes any more. Whether the given contact was struck.
    fn apply_momentum_laws(&mut self, first: usize) -> bool {
        let mut struck = false;
        let mut next = Some(first);
        for _ in 0..MOST_JUMPS {
            let Some(index) = next else { break };
            let rate = self.run.trials[index].rate;
            if let Some(restitution) = self.run.system.contacts[index].law.rebound(rate) {
                struck |= index == first;
                self.strike(index, restitution, rate);
            } else if index != first {
                break;
            }
            next = self.run.near.iter().copied().find(|&other| {
                let law = &self.run.system.contacts[other].law;
                self.is_closing(other) && law.rebound(self.run.trials[other].rate).is_some()
            });
        }
        if struck {
            self.follow_jumps();
            self.stepper.restart(&self.run, true);
        }
        struck
    }

    /// A contact that closes at `rate` opens at once, in space with all points of its face that touch and close: each by its
    /// rate before, so that a face that hits flat does not turn.
    fn strike(&mut self, first: usize, restitution: f64, rate: f64) {
        let contacts = &self.run.system.contacts;
        let face_of = |contact: usize| contacts[contact].plan.map(|place| place.face);
        let face = face_of(first);
        let points = self.run.near.iter().copied().filter(|&other| {
            other != first && face.is_some() && face_of(other) == face && self.is_closing(other)
        });
        let others: Vec<(usize, f64, f64)> = points
            .filter_map(|other| {
                let rate = self.run.trials[other].rate;
                Some((other, contacts[other].law.rebound(rate)?, rate))
            })
            .collect();
        let listed = self.run.impacts.len();
        self.jump_apart(first, restitution, rate);
        for &(other, restitution, rate) in &others {
            self.jump_apart(other, restitution, rate);
        }
        if !others.is_empty() {
            // What the other points did changes how each of them separates.
            for impact in &mut self.run.impacts[listed..] {
                impact.separation_speed = -self.run.trials[impact.contact].rate;
            }
        }
        if let Some(face) = face {
            self.list_strike(face);
        }
    }

    /// Lists the points of a face that the momentum law has struck now as one impact.
    fn list_strike(&mut self, face: usize) {
        let (contacts, now) = (&self.run.system.contacts, self.run.time);
        let struck = self.run.impacts.iter().rev();
        let struck = struck.take_while(|impact| impact.start == now);
        let (mut sum, mut moment) = (0.0, [0.0; 2]);
        for impact in struck.filter(|impact| impact.end == now) {
            if let Some(place) = contacts[impact.contact].plan
                && place.face == face
            {
                sum += impact.impulse;
                for (moment, at) in moment.iter_mut().zip(place.at) {
                    *moment += impact.impulse * at;
                }
            }
        }
        let centre = moment.map(|moment| moment / sum);
        self.run.face_forces.strike(face, now, centre);
    }

    /// A contact closing at `rate` opens at once with `restitution` times that.
    fn jump_apart(&mut self, contact: usize, restitution: f64, rate: f64) {
        let (run, stepper) = (&mut self.run, &mut self.stepper);
        let jump = stepper.jump_velocities(run, contact, restitution, rate);
        self.read_contacts();
        let time = self.run.time;
        self.run.impacts.push(Impact {
            contact,
            start: time,
            end: time,
            peak_force: 0.0,
            peak_force_at: time,
            peak_indentation: 0.0,
            impact_speed: rate,
            separation_speed: jump.separation_speed,
            finished: true,
            impulse: jump.impulse,
            dissipated: jump.dissipated,
            sliding: Sliding::default(),
        });
    }

    /// Forces of closed contacts with dashpots after velocities have jumped.
    fn follow_jumps(&mut self) {
        for near in 0..self.run.near.len() {
            let index = self.run.near[near];
            if let ContactPhase::Closed(mut episode) = self.run.phases[index] {
                let law = &self.run.system.contacts[index].law;
                let change = episode.jump(law, &self.run.trials[index], self.run.time);
                if let Some(friction) = &self.run.system.contacts[index].friction {
                    // What presses may hold no more.
                    let episode_friction = &mut episode.friction;
                    let [slip, _] = self.stepper.slip(&self.run, index);
                    let (force, _) =
                        friction
                            .law
                            .force(slip, episode_friction.origin, episode.force);
                    self.stepper
                        .change_friction(&self.run, index, force - episode_friction.force);
                    (episode_friction.origin, episode_friction.force) =
                        (friction.law.origin(slip, force), force);
                }
                self.run.phases[index] = ContactPhase::Closed(episode);
                self.stepper.change_force(&self.run, index, change);
            }
        }
    }

    /// A contact begins to push.
    fn close(&mut self, index: usize) {
        let contact = &self.run.system.contacts[index];
        let rate = self.run.trials[index].rate.max(0.0);
        self.stepper.before_touch(&self.run, index, rate);
        let mut memory = contact.law.touch(rate);
        memory.crushed_before = self.run.crushed[index];
        let mut episode = Episode::new(self.run.time, rate.max(SLOWEST_IMPACT), memory);
        episode.force = contact.law.onset(rate);
        episode.peak_force = episode.force;
        if contact.friction.is_some() {
            let [slip, speed] = self.stepper.slip(&self.run, index);
            let friction = &mut episode.friction;
            (friction.origin, friction.touched_at, friction.slip_speed) = (slip, slip, speed);
            friction.peak.at = self.run.time;
        }
        // The division that the impact expected of this rate needs, in view of the strongest of the gap so far.
        let expected = contact.law.elastic_force(contact.effective_mass(), rate);
        let strongest = &mut self.run.strongest[contact.gap];
        *strongest = strongest.max(expected);
        let share = if *strongest > 0.0 {
            expected / *strongest
        } else {
            0.0
        };
        let planned = self.run.plan.first_division(contact, rate, share);
        let division = self
            .stepper
            .division_at_touch(&self.run, index, rate, &episode, planned);
        self.run.contact_division[index] = division;
        self.run.finest_in_contact = self.run.finest_in_contact.max(division);
        self.run.phases[index] = ContactPhase::Closed(episode);
        self.stepper.change_force(&self.run, index, episode.force);
        self.stepper.restart(&self.run, false);
    }
}

impl RunState<'_> {
    /// Motion of a contact over the tried step.
    pub(in crate::stepping) fn indentation_curve(
        &self,
        stepper: &impl Stepper,
        contact: usize,
        step: f64,
    ) -> Cubic {
        let trial = &self.trials[contact];
        Cubic::new(
            stepper.closing(self, contact) - self.widths[contact],
            stepper.closing_rate(self, contact),
            trial.indentation,
            trial.rate,
            step,
        )
    }
}

/// An episode as an impact, if it ever pushed and was more than a graze. One that the end of the run cuts off is not
/// `finished`.
pub(super) fn impact_of(contact: usize, episode: &Episode, finished: bool) -> Option<Impact> {
    let pushed = episode.peak_force > 0.0 && episode.end > episode.since;
    (pushed && episode.peak_indentation > GRAZE).then_some(Impact {
        contact,
        start: episode.since,
        end: episode.end,
        peak_force: episode.peak_force,
        peak_force_at: episode.peak_force_at,
        peak_indentation: episode.peak_indentation,
        impact_speed: episode.impact_speed,
        // Bodies that still approach, or rest against each other, have not separated.
        separation_speed: if finished {
            episode.separation_speed.max(0.0)
        } else {
            0.0
        },
        finished,
        impulse: episode.impulse,
        dissipated: episode.work,
        sliding: Sliding {
            slip_speed: episode.friction.slip_speed,
            peak_force: episode.friction.peak.value,
            peak_force_at: episode.friction.peak.at,
            slip_peak: episode.friction.slip_peak,
            impulse: episode.friction.impulse,
            friction: episode.friction.work,
            slid_off: episode.slid_off,
        },
    })
}
