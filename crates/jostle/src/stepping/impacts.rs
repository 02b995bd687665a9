//! Contacts that close and open: found in tried steps, made to happen, followed to the end.

use super::StepEquations;
use super::clock::Stride;
use super::events::{Crossing, Cubic, bisect};
use super::outcome::StepError;
use super::simulation::Simulation;
use super::trial::ContactTrial;
use crate::history::{Extreme, Impact};
use crate::state::{ContactPhase, Episode};

/// A contact closes or opens within a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Event {
    pub(super) contact: usize,
    pub(super) crossing: Crossing,
    /// Share of the step.
    pub(super) at: f64,
}

/// Where a step that was to end on an event has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Landing {
    /// Where it began: another event happened there first, and time stands still.
    AtStart,
    /// Later, on the event or as near as it could be found.
    Later,
}

/// A touch is located when the faces are this close \[m\].
const TOUCH: f64 = 1e-13;
/// Contacts this close to touching, and closing, close together with another \[m\].
const TOGETHER: f64 = 1e-12;
/// An event nearer than this share of a step happens at its start.
const AT_ONCE: f64 = 1e-4;
/// Laws that divide by the impact speed see at least this much \[m/s\].
const SLOWEST_IMPACT: f64 = 1e-6;

impl<E: StepEquations> Simulation<'_, E> {
    /// The first touch, or release with a jump of force, in the tried step.
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

    /// Whether a contact would open at the very instant at which it closed. Where bodies rest against each other,
    /// steps of different length may disagree about which contact closes; it must stay closed for a step.
    fn undoes_a_touch(&self, event: &Event, step: f64) -> bool {
        matches!(self.state.contacts[event.contact], ContactPhase::Closed(episode)
            if event.crossing == Crossing::Downwards && episode.since == self.state.time)
            && event.at * step <= self.shortest_step(event)
    }

    /// An event nearer than this happens at the start of the step \[s\].
    pub(super) fn shortest_step(&self, event: &Event) -> f64 {
        let contact = &self.system.contacts[event.contact];
        let division = self.plan.division(contact, self.trials[event.contact].rate);
        AT_ONCE * self.plan.step / f64::from(self.division().max(division))
    }

    /// Repeats the step so that it ends on an event, or on an earlier one met on the way.
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
                    // It happens before anything moves: no step so short could be taken.
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
        // The step that was last tried, should the corrections not have come to an end.
        let tried = self.factors[0].coefficients.step;
        self.accept(0, self.clock.after(tried))?;
        if reached {
            self.happen(event);
        }
        Ok(Landing::Later)
    }

    /// Rate of closing of a contact at the present instant \[m/s\].
    fn closing_rate(&self, index: usize) -> f64 {
        let [i, j] = self.system.contacts[index].dofs;
        self.state.velocity[i] - self.state.velocity[j]
    }

    /// Sets `trials` to the present.
    pub(super) fn read_contacts(&mut self) {
        for (index, contact) in self.system.contacts.iter().enumerate() {
            let [i, j] = contact.dofs;
            self.trials[index].indentation =
                self.state.displacement[i] - self.state.displacement[j] - contact.width;
            self.trials[index].rate = self.closing_rate(index);
        }
    }

    /// Closes or opens contacts at the present instant, whose indentations and rates stand in `trials`.
    pub(super) fn happen(&mut self, event: Event) {
        let time = self.state.time;
        if event.crossing == Crossing::Downwards {
            if let ContactPhase::Closed(mut episode) = self.state.contacts[event.contact] {
                self.jump(event.contact, -episode.force);
                (episode.end, episode.separation_speed) = (time, -self.trials[event.contact].rate);
                self.report_impact(event.contact, &episode);
                self.state.contacts[event.contact] = ContactPhase::Open;
            }
            return;
        }
        for index in 0..self.system.contacts.len() {
            let ContactTrial {
                indentation, rate, ..
            } = self.trials[index];
            let open = self.state.contacts[index] == ContactPhase::Open;
            if index == event.contact || (open && indentation >= -TOGETHER && rate > 0.0) {
                let contact = &self.system.contacts[index];
                let impact_speed = rate.max(SLOWEST_IMPACT);
                let mut episode = Episode::new(time, impact_speed);
                episode.force = contact.law.onset(rate.max(0.0));
                episode.peak_force = episode.force;
                self.contact_division[index] = self.plan.division(contact, impact_speed);
                self.finest_in_contact = self.finest_in_contact.max(self.contact_division[index]);
                self.jump(index, episode.force);
                self.state.contacts[index] = ContactPhase::Closed(episode);
            }
        }
    }

    /// A sudden change of a contact force changes the accelerations of the two faces (theory, Eq. H2).
    fn jump(&mut self, index: usize, change: f64) {
        let contact = &self.system.contacts[index];
        self.state.acceleration[contact.dofs[0]] -= change / contact.masses[0];
        self.state.acceleration[contact.dofs[1]] += change / contact.masses[1];
    }

    /// Before the state moves on: what every closed contact does over the step.
    pub(super) fn gather_episodes(&mut self, step: f64) {
        for closed in 0..self.coupling.closed.len() {
            let index = self.coupling.closed[closed].contact;
            let ContactPhase::Closed(mut episode) = self.state.contacts[index] else {
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
            let deepest = curve.peak(start, step).map_or(curve.end, |peak| peak.value);
            episode.peak_indentation = episode.peak_indentation.max(deepest);
            if force[0] > 0.0 && force[1] <= 0.0 {
                let (speed, rate) = (episode.impact_speed, |at: f64| curve.rise(at) / step);
                let at = bisect(0.0, 1.0, |at| {
                    law.respond(curve.value(at), rate(at), speed).force <= 0.0
                });
                (episode.end, episode.separation_speed) = (start + at * step, -rate(at));
            } else if force[1] > 0.0 {
                (episode.end, episode.separation_speed) = (start + step, -trial.rate);
            }
            self.state.contacts[index] = ContactPhase::Closed(episode);
            self.coupling.closed[closed].start_slope =
                self.force_slope(index, curve.start, curve.start_rise / step, &episode);
        }
    }

    /// dF/dt of a contact with the present accelerations \[N/s\].
    fn force_slope(&self, index: usize, indentation: f64, rate: f64, episode: &Episode) -> f64 {
        let contact = &self.system.contacts[index];
        let [i, j] = contact.dofs;
        let acceleration = self.state.acceleration[i] - self.state.acceleration[j];
        let response = contact.law.respond(indentation, rate, episode.impact_speed);
        response.by_indentation * rate + response.by_rate * acceleration
    }

    /// After the state has moved on: peaks of the forces, and contacts that have opened.
    pub(super) fn finish_episodes(&mut self, step: f64, start: f64) {
        for closed in 0..self.coupling.closed.len() {
            let index = self.coupling.closed[closed].contact;
            let ContactPhase::Closed(mut episode) = self.state.contacts[index] else {
                continue;
            };
            let trial = self.trials[index];
            let start_slope = self.coupling.closed[closed].start_slope;
            let end_slope = self.force_slope(index, trial.indentation, trial.rate, &episode);
            let mut peak = Extreme {
                value: trial.force,
                at: start + step,
            };
            if episode.force > 0.0 && trial.force > 0.0 {
                let curve = Cubic::new(episode.force, start_slope, trial.force, end_slope, step);
                peak = curve.peak(start, step).unwrap_or(peak);
            }
            if peak.value > episode.peak_force {
                (episode.peak_force, episode.peak_force_at) = (peak.value, peak.at);
            }
            episode.force = trial.force;
            let leaving = trial.indentation <= 0.0 && trial.rate <= 0.0;
            self.state.contacts[index] =
                if leaving && !self.system.contacts[index].law.jumps_at_release() {
                    self.report_impact(index, &episode);
                    ContactPhase::Open
                } else {
                    ContactPhase::Closed(episode)
                };
        }
    }

    /// Lists an episode as an impact, if it ever pushed.
    pub(super) fn report_impact(&mut self, contact: usize, episode: &Episode) {
        if episode.peak_force > 0.0 && episode.end > episode.since {
            self.impacts.push(Impact {
                contact,
                start: episode.since,
                end: episode.end,
                peak_force: episode.peak_force,
                peak_force_at: episode.peak_force_at,
                peak_indentation: episode.peak_indentation,
                impact_speed: episode.impact_speed,
                separation_speed: episode.separation_speed,
                impulse: episode.impulse,
                dissipated: episode.work,
            });
        }
    }
}
