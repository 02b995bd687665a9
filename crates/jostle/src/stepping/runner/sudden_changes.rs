//! Forces that jump on the way: dashpots in proportion to the tangents of springs that yield, and panels that fall out. Steps end
//! there.

use super::contact_events::Landing;
use super::{Runner, Stepper};
use crate::stepping::clock::NextStep;
use crate::stepping::outcome::StepError;

/// Share of a step to which a jump is located, and the shortest step to one or from it: shorter ones lose digits of accelerations.
const CLOSE: f64 = 1e-4;
/// Factor by which a step that ends before its jump grows further from trial to trial.
const FURTHER: f64 = 8.0;
/// Largest number of trials.
const MOST_TRIES: usize = 12;

impl<S: Stepper> Runner<'_, S> {
    /// Ends the step in a slot at such a jump, at a share of it, or on an earlier event.
    pub(super) fn step_to_sudden_change(
        &mut self,
        at: f64,
        slot: usize,
        next: &NextStep,
    ) -> Result<Landing, StepError> {
        if 1.0 - at <= CLOSE {
            self.accept(slot, next.end)?;
            self.stepper.make_sudden_changes(&self.run);
            return Ok(Landing::Later);
        }
        self.run.work.repeated_steps += 1;
        let close = CLOSE * next.length;
        let (mut length, mut further) = ((at * next.length).max(close), close);
        for _ in 0..MOST_TRIES {
            self.try_length(length)?;
            if let Some(event) = self.first_event(length) {
                let shorter = NextStep { length, ..*next };
                return self.step_to(event, &shorter);
            }
            let corrected = match self.stepper.sudden_change(&self.run, length) {
                // Just past it.
                Some(share) if (1.0 - share) * length <= close => break,
                Some(share) => share * length + 0.5 * close,
                None => {
                    further *= FURTHER;
                    length + further
                }
            };
            if corrected + close >= next.length {
                break;
            }
            length = corrected.max(close);
            self.run.work.repeated_steps += 1;
        }
        let tried = self.stepper.length(0);
        self.accept(0, self.run.clock.after(tried))?;
        self.stepper.make_sudden_changes(&self.run);
        Ok(Landing::Later)
    }
}
