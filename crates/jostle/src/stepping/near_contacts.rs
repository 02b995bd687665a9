//! Contacts that are made or missed by less than the tolerance.

use super::runner::{RunState, Stepper};
use crate::contact::ForceLaw;

/// How near contacts come to being decided otherwise.
#[derive(Clone, Debug)]
pub(super) struct NearContacts {
    /// How far every open contact has opened since it was closed; infinite before it ever was \[m\].
    clearance: Vec<f64>,
    /// First instant at which a contact was made or missed by less than the tolerance \[s\].
    pub(super) doubtful_from: Option<f64>,
}

/// Motion of the faces of a contact now.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    pub(super) rate: f64,
    pub(super) acceleration: f64,
    /// How far from touching an event may be made or missed within the tolerance \[m\].
    pub(super) doubt: f64,
    /// How far the contact has opened since it was closed, if the stepper follows that itself \[m\].
    pub(super) clearance: Option<f64>,
}

/// How far from touching an event of a contact may be made or missed within the tolerance, for its greatest closing so far
/// \[m\].
pub(super) fn doubt(run: &RunState<'_>, contact: usize, closing: f64) -> f64 {
    run.plan.tolerance() * run.widths[contact].max(closing)
}

impl NearContacts {
    pub(super) fn new(contacts: usize) -> Self {
        Self {
            clearance: vec![f64::INFINITY; contacts],
            doubtful_from: None,
        }
    }

    /// Notes a touch that is hardly one: faces that turn back before they are far in, that were hardly apart before, or
    /// that stay together because they are too slow to bounce.
    pub(super) fn at_touch(&mut self, run: &RunState<'_>, contact: usize, touch: Touch) {
        let Touch {
            rate,
            acceleration,
            doubt,
            clearance,
        } = touch;
        let turns = acceleration < 0.0 && rate * rate < -2.0 * acceleration * doubt;
        let law = &run.system.contacts[contact].law;
        let rests = matches!(law, ForceLaw::Restitution { .. });
        let clearance = clearance.unwrap_or(self.clearance[contact]);
        if turns || rests || clearance < doubt {
            self.doubtful_from.get_or_insert(run.time);
        }
    }

    /// Notes faces that nearly touched, or nearly parted, in the tried step; `closing`: the greatest closing of every
    /// contact so far.
    pub(super) fn at_turns<S: Stepper>(
        &mut self,
        run: &RunState<'_>,
        stepper: &S,
        step: f64,
        closing: impl Fn(usize) -> f64,
    ) {
        for &contact in &run.near {
            let then = stepper.closing_rate(run, contact);
            let now = run.trials[contact].rate;
            if run.is_open(contact) {
                let clear = -run.trials[contact].indentation;
                self.clearance[contact] = self.clearance[contact].max(clear);
            }
            if then * now >= 0.0 {
                continue;
            }
            let curve = run.indentation_curve(stepper, contact, step);
            let face = run.phases[contact].face();
            let nearest = curve
                .turning_points()
                .map(|at| (curve.value(at) - face).abs())
                .fold(f64::INFINITY, f64::min);
            if nearest < doubt(run, contact, closing(contact)) {
                self.doubtful_from.get_or_insert(run.time);
            }
        }
    }

    /// A contact has opened.
    pub(super) fn after_release(&mut self, contact: usize) {
        self.clearance[contact] = 0.0;
    }
}
