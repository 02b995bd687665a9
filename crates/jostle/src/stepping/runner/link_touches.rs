//! Links that become taut or slack, touch or part: steps end there, so that forces begin and end where they should.

use super::contact_events::{AT_ONCE, Landing};
use super::{Runner, Stepper};
use crate::stepping::clock::NextStep;
use crate::stepping::events::Crossing;
use crate::stepping::outcome::StepError;

/// A link with a gap or slack that closes or opens within the tried step.
#[derive(Clone, Copy, Debug)]
pub(in crate::stepping) struct LinkTouch {
    /// Index of the link in the system.
    pub(in crate::stepping) link: usize,
    pub(in crate::stepping) crossing: Crossing,
    /// Share of the step.
    pub(in crate::stepping) at: f64,
}

/// A touch is located when the ends are this close \[m\].
const TOUCH: f64 = 1e-13;
/// Corrections of the length of a step that is to end on a touch.
const MOST_CORRECTIONS: usize = 12;

impl<S: Stepper> Runner<'_, S> {
    /// Lets a step end where a link touches before a share of it; `None` if none does.
    pub(super) fn end_at_link_touch(
        &mut self,
        next: &NextStep,
        before: f64,
    ) -> Result<Option<Landing>, StepError> {
        let touch = self.stepper.link_touch(&self.run, next.length);
        let Some(touch) = touch.filter(|touch| touch.at < before) else {
            return Ok(None);
        };
        if touch.at <= AT_ONCE {
            // It touches at the start; a dashpot then has its force at once.
            let begins = touch.crossing == Crossing::Upwards
                && self.stepper.begin_link_force(&self.run, touch.link);
            return Ok(begins.then_some(Landing::AtStart));
        }
        self.run.work.repeated_steps += 1;
        self.step_to_link_touch(touch, next).map(Some)
    }

    /// Repeats the step so that it ends where a link touches, or on an earlier event.
    fn step_to_link_touch(
        &mut self,
        mut touch: LinkTouch,
        next: &NextStep,
    ) -> Result<Landing, StepError> {
        let mut length = touch.at * next.length;
        for _ in 0..MOST_CORRECTIONS {
            self.try_length(length)?;
            if let Some(event) = self.first_event(length) {
                let shorter = NextStep { length, ..*next };
                return self.step_to(event, &shorter);
            }
            let other = self.stepper.link_touch(&self.run, length);
            if let Some(other) =
                other.filter(|other| other.link != touch.link && (AT_ONCE..1.0).contains(&other.at))
            {
                touch = other;
                length *= other.at;
                continue;
            }
            let [overlap, rate] = self.stepper.link_overlap(&self.run, touch.link);
            let wrong_way = (touch.crossing == Crossing::Upwards) != (rate > 0.0);
            let corrected = length - overlap / rate;
            let usable = corrected > 0.0 && corrected < next.length;
            if overlap.abs() <= TOUCH || wrong_way || !usable {
                break;
            }
            length = corrected;
            self.run.work.repeated_steps += 1;
        }
        let tried = self.stepper.length(0);
        self.accept(0, self.run.clock.after(tried))?;
        if touch.crossing == Crossing::Upwards {
            self.stepper.begin_link_force(&self.run, touch.link);
        }
        Ok(Landing::Later)
    }
}
