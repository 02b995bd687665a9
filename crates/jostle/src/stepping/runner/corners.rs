//! Corners of contact forces over time: where the slope of a force jumps, so does that of accelerations, whose
//! peaks are often there. Steps end at corners.

use super::contact_events::{AT_ONCE, Landing};
use super::{Runner, Stepper};
use crate::state::ContactPhase;
use crate::stepping::clock::NextStep;
use crate::stepping::events::{Cubic, bisect};
use crate::stepping::outcome::StepError;

/// Fraction of a step to which a corner is located, in tolerances, and its upper bound \[–\].
const CLOSENESS: f64 = 0.1;
const WIDEST: f64 = 1e-4;
/// Largest number of trials.
const MOST_TRIES: usize = 6;
/// Largest extension of a step to reach a corner, as a fraction of it.
const EXTENSION: f64 = 1.5;

/// A corner of a contact force within a trial step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    contact: usize,
    kind: Kind,
    /// Fraction of the step.
    at: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// The force ends.
    Release,
    /// The motion reverses, and a dashpot or a slider starts or stops acting; with the sign of the rate before.
    Turn { sign: f64 },
    /// The stiffness changes at an indentation \[m\]; with the sign of the rate before.
    Kink { sign: f64, indentation: f64 },
}

impl<S: Stepper> Runner<'_, S> {
    /// The first corner within the tried step and before a share of it.
    pub(super) fn first_corner(&self, step: f64, before: f64) -> Option<Corner> {
        let mut first: Option<Corner> = None;
        let contacts = self.run.phases.len();
        // Links follow the contacts.
        let closed = self.run.coupling.closed.iter();
        for index in closed
            .map(|closed| closed.contact)
            .filter(|index| *index < contacts)
        {
            for kind in self.kinds(index).into_iter().flatten() {
                let reached = first.map_or(before, |first| first.at);
                // A closer corner is the one at which the last step ended.
                if let Some(at) = self.corner_at(index, kind, step, 1.0)
                    && at < reached
                    && at > AT_ONCE
                {
                    let contact = index;
                    first = Some(Corner { contact, kind, at });
                }
            }
        }
        first
    }

    /// Corners that the force of a closed contact may reach next.
    fn kinds(&self, index: usize) -> [Option<Kind>; 3] {
        let ContactPhase::Closed(episode) = self.run.phases[index] else {
            return [None; 3];
        };
        let law = &self.run.system.contacts[index].law;
        let rate = self.stepper.closing_rate(&self.run, index);
        let sign = rate.signum();
        let release = episode.force > 0.0 && law.has_corner_at_release();
        let indentation = law.kink(rate > 0.0, &episode.memory);
        [
            release.then_some(Kind::Release),
            law.has_corner_at_turn().then_some(Kind::Turn { sign }),
            indentation
                .is_finite()
                .then_some(Kind::Kink { sign, indentation }),
        ]
    }

    /// Fraction of the trial step at which a corner is reached, if it is before `most`.
    fn corner_at(&self, index: usize, kind: Kind, step: f64, most: f64) -> Option<f64> {
        let ContactPhase::Closed(episode) = self.run.phases[index] else {
            return None;
        };
        let law = &self.run.system.contacts[index].law;
        let curve = self.indentation_curve(index, step);
        let ends = |curve: &Cubic, at: f64| {
            let rate = curve.rise(at) / step;
            law.follow(curve.value(at), rate, &episode.memory).force <= 0.0
        };
        let past = |at: f64| match kind {
            Kind::Release => ends(&curve, at),
            Kind::Turn { sign } => sign * curve.rise(at) <= 0.0,
            Kind::Kink { sign, indentation } => sign * (curve.value(at) - indentation) >= 0.0,
        };
        let end = [1.0, most].into_iter().find(|at| past(*at))?;
        Some(bisect(0.0, end, past))
    }

    /// Repeats the step so that it ends at a corner, or on an earlier event; false if the event occurred at the
    /// start and time does not advance.
    pub(super) fn step_to_corner(
        &mut self,
        corner: Corner,
        next: &NextStep,
    ) -> Result<Landing, StepError> {
        let Corner { contact, kind, at } = corner;
        let close = (CLOSENESS * self.run.plan.tolerance()).min(WIDEST);
        let mut length = at * next.length;
        for _ in 0..MOST_TRIES {
            self.try_length(length)?;
            if let Some(event) = self.first_event(length) {
                let shorter = NextStep { length, ..*next };
                return self.step_to(event, &shorter);
            }
            let Some(share) = self.corner_at(contact, kind, length, EXTENSION) else {
                break;
            };
            let corrected = share * length;
            if (share - 1.0).abs() <= close || corrected >= next.length {
                break;
            }
            length = corrected;
            self.run.work.repeated_steps += 1;
        }
        let tried = self.stepper.length(0);
        self.run.at_corner = true;
        let accepted = self.accept(0, self.run.clock.after(tried));
        self.run.at_corner = false;
        accepted?;
        self.stepper.restart(&self.run, false);
        Ok(Landing::Later)
    }
}
