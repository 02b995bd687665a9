//! Contacts that close and open: located in trial steps, applied, and followed to their end.

use super::StepEquations;
use super::clock::Stride;
use super::events::Crossing;
use super::outcome::StepError;
use super::simulation::Simulation;
use super::trial::ContactTrial;
use crate::history::Impact;
use crate::state::{ContactPhase, Episode};

/// A contact closes or opens within a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Event {
    pub(super) contact: usize,
    pub(super) crossing: Crossing,
    /// Fraction of the step.
    pub(super) at: f64,
}

/// End of a step that should end on an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Landing {
    /// At its start: another event occurred there first, and time does not advance.
    AtStart,
    /// Later, on the event or as close as possible.
    Later,
}

/// Tolerance of the location of first contact \[m\].
pub(super) const TOUCH: f64 = 1e-13;
/// Closing contacts within this distance close together with another one \[m\].
pub(super) const TOGETHER: f64 = 1e-12;
/// An event within this fraction of a step occurs at its start.
pub(super) const AT_ONCE: f64 = 1e-4;
/// Episodes that are not deeper are grazing contacts, not impacts: first contact is located to a thousandth of this
/// \[m\].
const GRAZE: f64 = 1e-10;
/// Impact speeds are reported as at least this, so that ratios to them are finite \[m/s\].
pub(super) const SLOWEST_IMPACT: f64 = 1e-9;
/// Largest number of momentum impacts at one instant before lasting contact starts.
pub(super) const MOST_BLOWS: usize = 10_000;

impl<E: StepEquations> Simulation<'_, E> {
    /// The first contact, or release with a jump of force, in the trial step.
    pub(super) fn first_event(&self, step: f64) -> Option<Event> {
        if !self.pounding {
            return None;
        }
        let mut first: Option<Event> = None;
        for (contact, phase) in self.state.contacts.iter().enumerate() {
            let trial = &self.trials[contact];
            let turned_back = || trial.rate < 0.0 && self.closing_rate(contact) > 0.0;
            let crossing = match phase {
                ContactPhase::Open if trial.indentation > 0.0 || turned_back() => Crossing::Upwards,
                ContactPhase::Closed(_)
                    if trial.indentation < 0.0
                        && self.system.contacts[contact].law.jumps_at_release() =>
                {
                    Crossing::Downwards
                }
                _ => continue,
            };
            if let Some(at) = self
                .indentation_curve(contact, step)
                .first_crossing(crossing)
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

    /// Whether a contact would open at the very instant at which it closed. For bodies at rest against each other,
    /// steps of different length may give different contacts; the contact must stay closed for one step.
    fn undoes_a_touch(&self, event: &Event, step: f64) -> bool {
        matches!(self.state.contacts[event.contact], ContactPhase::Closed(episode)
            if event.crossing == Crossing::Downwards && episode.since == self.state.time)
            && event.at * step <= self.shortest_step(event)
    }

    /// An event within this time occurs at the start of the step \[s\].
    pub(super) fn shortest_step(&self, event: &Event) -> f64 {
        let contact = &self.system.contacts[event.contact];
        let division = self.plan.division(contact, self.trials[event.contact].rate);
        AT_ONCE * self.plan.step / f64::from(self.division().max(division))
    }

    /// Repeats the step so that it ends on an event, or on an earlier one found in the repetition.
    pub(super) fn step_to(
        &mut self,
        mut event: Event,
        stride: &Stride,
    ) -> Result<Landing, StepError> {
        let mut length = event.at * stride.length;
        for _ in 0..12 {
            self.factorize(0, length)?;
            self.try_step(0, self.clock.after(length))?;
            if let Some(other) = self
                .first_event(length)
                .filter(|other| other.contact != event.contact && other.at < 1.0 - 1e-9)
            {
                if other.at * length <= self.shortest_step(&other) {
                    // It occurs at the start: the step would be too short.
                    self.read_contacts();
                    self.happen(other);
                    return Ok(Landing::AtStart);
                }
                event = other;
                length *= other.at;
                continue;
            }
            let trial = self.trials[event.contact];
            let correction = -trial.indentation / trial.rate;
            let corrected = length + correction;
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
        let ContactTrial {
            indentation, rate, ..
        } = self.trials[event.contact];
        let reached = match event.crossing {
            Crossing::Upwards => indentation >= -TOGETHER && rate > 0.0,
            Crossing::Downwards => indentation <= TOGETHER && rate < 0.0,
        };
        // The last trial step, if the corrections have not converged.
        let tried = self.factors[0].coefficients.step;
        self.accept(0, self.clock.after(tried))?;
        if reached {
            self.happen(event);
        }
        Ok(Landing::Later)
    }

    /// Rate of closing of a contact at the present instant \[m/s\].
    fn closing_rate(&self, index: usize) -> f64 {
        let faces = &self.system.contacts[index].faces;
        faces.closing(&self.state.velocity)
    }

    /// Sets `trials` to the present.
    pub(super) fn read_contacts(&mut self) {
        for (index, contact) in self.system.contacts.iter().enumerate() {
            self.trials[index].indentation =
                contact.faces.closing(&self.state.displacement) - contact.width;
            self.trials[index].rate = self.closing_rate(index);
        }
    }

    /// Closes or opens contacts at the present instant, with the indentations and rates in `trials`.
    pub(super) fn happen(&mut self, event: Event) {
        let time = self.state.time;
        if event.crossing == Crossing::Downwards {
            if let ContactPhase::Closed(mut episode) = self.state.contacts[event.contact] {
                self.jump(event.contact, -episode.force);
                (episode.end, episode.separation_speed) = (time, -self.trials[event.contact].rate);
                self.report_impact(event.contact, &episode, true);
                self.state.contacts[event.contact] = ContactPhase::Open;
            }
            self.recorder
                .after_jump(self.system, &self.state, self.ground[0]);
            return;
        }
        let struck = self.strike(event.contact);
        for index in 0..self.system.contacts.len() {
            if (index == event.contact && !struck) || self.is_closing(index) {
                self.close(index);
            }
        }
        self.recorder
            .after_jump(self.system, &self.state, self.ground[0]);
    }

    /// Whether an open contact closes now.
    fn is_closing(&self, index: usize) -> bool {
        let ContactTrial {
            indentation, rate, ..
        } = self.trials[index];
        self.state.contacts[index] == ContactPhase::Open && indentation >= -TOGETHER && rate > 0.0
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
                self.read_contacts();
            } else if index != first {
                break;
            }
            next = (0..self.system.contacts.len()).find(|&other| {
                self.is_closing(other)
                    && self.system.contacts[other]
                        .law
                        .rebound(self.trials[other].rate)
                        .is_some()
            });
        }
        if struck {
            self.follow_jumps();
        }
        struck
    }

    /// Forces of closed contacts with dashpots after velocities have jumped.
    fn follow_jumps(&mut self) {
        for index in 0..self.system.contacts.len() {
            if let ContactPhase::Closed(mut episode) = self.state.contacts[index] {
                let law = &self.system.contacts[index].law;
                let change = episode.jump(law, &self.trials[index], self.state.time);
                self.state.contacts[index] = ContactPhase::Closed(episode);
                self.jump(index, change);
            }
        }
    }

    /// The force of a contact starts.
    fn close(&mut self, index: usize) {
        let contact = &self.system.contacts[index];
        let rate = self.trials[index].rate.max(0.0);
        let mut episode = Episode::new(
            self.state.time,
            rate.max(SLOWEST_IMPACT),
            contact.law.touch(rate),
        );
        episode.force = contact.law.onset(rate);
        episode.peak_force = episode.force;
        self.choose_division(index, rate);
        self.jump(index, episode.force);
        self.state.contacts[index] = ContactPhase::Closed(episode);
    }

    /// A sudden change of a contact force changes the accelerations of the two points (theory, Eq. H2).
    fn jump(&mut self, index: usize, change: f64) {
        for (face, sign) in self.system.contacts[index].faces.sides() {
            self.state.acceleration[face.dof] += sign * change / face.mass;
        }
    }

    /// Updates every closed contact over the step, before the state changes.
    pub(super) fn gather_episodes(&mut self, step: f64) {
        for closed in 0..self.coupling.closed.len() {
            let index = self.coupling.closed[closed].contact;
            let Some(&ContactPhase::Closed(mut episode)) = self.state.contacts.get(index) else {
                continue;
            };
            let (law, start) = (self.system.contacts[index].law, self.state.time);
            let curve = self.indentation_curve(index, step);
            let trial = self.trials[index];
            let force = [episode.force, trial.force];
            let mean = 0.5 * (force[0] + force[1]);
            episode.impulse += step * mean;
            let work = mean * (curve.end - curve.start);
            episode.work += work;
            self.audit.contact += work;
            self.coupling.closed[closed].turn =
                episode.follow_indentation(&law, &curve, &trial, start, step);
            self.state.contacts[index] = ContactPhase::Closed(episode);
            self.coupling.closed[closed].start_acceleration = self.relative_acceleration(index);
            self.coupling.closed[closed].start_slope =
                self.force_slope(index, curve.start, curve.start_rise / step, &episode);
        }
    }

    /// dF/dt of a contact with the present accelerations \[N/s\].
    fn force_slope(&self, index: usize, indentation: f64, rate: f64, episode: &Episode) -> f64 {
        let acceleration = self.relative_acceleration(index);
        let law = &self.system.contacts[index].law;
        let response = law.follow(indentation, rate, &episode.memory);
        response.by_indentation * rate + response.by_rate * acceleration
    }

    /// Updates peaks of forces and opened contacts, after the state has changed.
    pub(super) fn finish_episodes(&mut self, step: f64, start: f64) {
        for closed in 0..self.coupling.closed.len() {
            let index = self.coupling.closed[closed].contact;
            let Some(&ContactPhase::Closed(mut episode)) = self.state.contacts.get(index) else {
                continue;
            };
            let trial = self.trials[index];
            let (law, turn) = (
                self.system.contacts[index].law,
                self.coupling.closed[closed].turn,
            );
            let slopes = [
                self.coupling.closed[closed].start_slope,
                self.force_slope(index, trial.indentation, trial.rate, &episode),
            ];
            episode.follow_force(&law, &trial, slopes, turn, start, step);
            self.control_division(closed, step, &episode);
            self.state.contacts[index] = if episode.advance(&law, &trial, turn) {
                self.report_impact(index, &episode, true);
                ContactPhase::Open
            } else {
                ContactPhase::Closed(episode)
            };
        }
    }

    /// Adds an episode to the impacts, if it counts as one.
    pub(super) fn report_impact(&mut self, contact: usize, episode: &Episode, finished: bool) {
        self.impacts.extend(impact_of(contact, episode, finished));
    }
}

/// An episode as an impact, if it had a force and was more than grazing. An impact in progress at the end of the
/// run is not `finished`.
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
        // Bodies that still approach or rest against each other have not separated.
        separation_speed: if finished {
            episode.separation_speed.max(0.0)
        } else {
            0.0
        },
        finished,
        impulse: episode.impulse,
        dissipated: episode.work,
    })
}
