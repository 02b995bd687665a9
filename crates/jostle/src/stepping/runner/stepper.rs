//! The interface between the runner and a stepper.

use super::link_touches::LinkTouch;
use super::{ContactTrial, RunState};
use crate::motion::Ground;
use crate::state::Episode;
use crate::stepping::clock::{Clock, NextStep};
use crate::stepping::events::Cubic;
use crate::stepping::gap_forces::StepForce;
use crate::stepping::outcome::StepError;
use crate::stepping::step_friction::FrictionPath;

/// What a sudden change of velocities by a momentum law does.
#[derive(Clone, Copy, Debug)]
pub(in crate::stepping) struct Jump {
    /// \[N·s\].
    pub(in crate::stepping) impulse: f64,
    /// \[J\].
    pub(in crate::stepping) dissipated: f64,
    /// Opening rate afterwards \[m/s\].
    pub(in crate::stepping) separation_speed: f64,
}

/// Steps the buildings of a run. Slot 0 is for steps off the grid, every other slot for one division of the
/// free-vibration step.
pub(in crate::stepping) trait Stepper {
    /// Whether steps end at corners of contact forces.
    fn ends_steps_at_corners(&self, run: &RunState<'_>) -> bool;

    /// Records the start of the run.
    fn record_start(&mut self, run: &mut RunState<'_>);

    /// Why a row of the histories could not be kept.
    fn history_fault(&self) -> Option<&str>;

    /// Takes several steps at once in which nothing touches; false where there are none.
    fn take_free_steps(&mut self, run: &mut RunState<'_>) -> bool {
        let _ = run;
        false
    }

    /// Closing of a contact now \[m\].
    fn closing(&self, run: &RunState<'_>, contact: usize) -> f64;

    /// Rate of closing of a contact now \[m/s\].
    fn closing_rate(&self, run: &RunState<'_>, contact: usize) -> f64;

    /// Slip along the face of a contact with friction and its rate now \[m, m/s\].
    fn slip(&self, run: &RunState<'_>, contact: usize) -> [f64; 2] {
        let _ = (run, contact);
        [0.0; 2]
    }

    /// Ends of the edge that the corner of a contact touches, by their index in [`crate::System::edge_ends`].
    fn edge_ends(&self, contact: usize) -> std::ops::Range<usize> {
        let _ = contact;
        0..0
    }

    /// How far a corner is inside of such an end, and its rate \[m, m/s\]: now, or at the end of the tried step.
    fn edge_end(&self, run: &RunState<'_>, end: usize, tried: bool) -> [f64; 2] {
        let _ = (run, end, tried);
        [f64::INFINITY, 0.0]
    }

    /// Brings the friction of a closed contact to the end of the accepted step with its start and length \[s\] and the contact
    /// force over it; returns the friction over the step.
    fn follow_friction(
        &mut self,
        run: &RunState<'_>,
        contact: usize,
        episode: &mut Episode,
        pressed: &StepForce,
        span: [f64; 2],
    ) -> Option<FrictionPath> {
        let _ = (run, contact, episode, pressed, span);
        None
    }

    /// A sudden change of the friction along a contact \[N\].
    fn change_friction(&mut self, run: &RunState<'_>, contact: usize, change: f64) {
        let _ = (run, contact, change);
    }

    /// Into how many parts the free-vibration step is divided now.
    fn division(&self, run: &RunState<'_>) -> u32;

    /// Prepares a slot for a step.
    fn prepare(&mut self, run: &mut RunState<'_>, next: &NextStep) -> Result<usize, StepError>;

    /// Prepares slot 0 for a step of a length \[s\].
    fn prepare_length(&mut self, run: &mut RunState<'_>, length: f64) -> Result<(), StepError>;

    /// Length of the steps of a slot \[s\].
    fn length(&self, slot: usize) -> f64;

    /// Takes the step to `end` without accepting it, and fills the trials.
    fn try_step(
        &mut self,
        run: &mut RunState<'_>,
        slot: usize,
        end: Clock,
    ) -> Result<(), StepError>;

    /// A closed contact whose motion or force the tried step does not resolve.
    fn unresolved_contact(&self, run: &RunState<'_>, step: f64) -> Option<usize> {
        let _ = (run, step);
        None
    }

    /// A closed contact that would open and close again within the tried step.
    fn contact_that_opens_unseen(&self, run: &RunState<'_>, step: f64) -> Option<usize> {
        let _ = (run, step);
        None
    }

    /// The first link with a gap or slack that closes or opens within the tried step.
    fn link_touch(&self, run: &RunState<'_>, step: f64) -> Option<LinkTouch> {
        let _ = (run, step);
        None
    }

    /// By how much such a link is closed at the end of the tried step, and its rate \[m, m/s\].
    fn link_overlap(&self, run: &RunState<'_>, link: usize) -> [f64; 2] {
        let _ = (run, link);
        [0.0; 2]
    }

    /// Gives a link that touches now the force of its dashpot; whether it had none.
    fn begin_link_force(&mut self, run: &RunState<'_>, link: usize) -> bool {
        let _ = (run, link);
        false
    }

    /// Share of the tried step at which a dashpot first changes on the way, or a panel falls out.
    fn sudden_change(&self, run: &RunState<'_>, step: f64) -> Option<f64> {
        let _ = (run, step);
        None
    }

    /// Gives dashpots that have changed over the accepted step their force of now, and takes out panels that fall now.
    fn make_sudden_changes(&mut self, run: &RunState<'_>) {
        let _ = run;
    }

    /// A step is about to be accepted.
    fn before_step(&mut self, run: &mut RunState<'_>, step: f64);

    /// Adds impulse and work of a closed contact over the tried step to its episode; `closed` is its place in the list of
    /// closed contacts.
    fn gather(
        &mut self,
        run: &mut RunState<'_>,
        closed: usize,
        episode: &mut Episode,
        curve: &Cubic,
        step: f64,
    );

    /// Moves the buildings to the end of the tried step.
    fn advance(&mut self, run: &mut RunState<'_>, slot: usize) -> Result<(), StepError>;

    /// Takes over what depends on the time at the end of the step.
    fn arrive(&mut self, run: &mut RunState<'_>, slot: usize);

    /// Rate of the force of a closed contact at the end of the accepted step, before anything opens \[N/s\].
    fn end_slope(
        &mut self,
        run: &RunState<'_>,
        contact: usize,
        trial: &ContactTrial,
        episode: &Episode,
        step: f64,
    ) -> f64;

    /// Division that a closed contact needs after a step that began at `start` \[s\]; the greatest force of its gap is up
    /// to date. `closed` is its place in the list of closed contacts.
    fn next_division(
        &self,
        run: &RunState<'_>,
        closed: usize,
        episode: &Episode,
        start: f64,
        step: f64,
    ) -> u32;

    /// Lets steps grow again after impacts.
    fn relax_divisions(&mut self, run: &mut RunState<'_>) {
        let _ = run;
    }

    /// Peaks, history and balance of the accepted step, which began at `start`.
    fn after_step(
        &mut self,
        run: &mut RunState<'_>,
        start: f64,
        step: f64,
        ground: [Ground; 2],
        was_closed: bool,
    ) -> Result<(), StepError>;

    /// A contact touches at a rate and is about to be closed.
    fn before_touch(&mut self, run: &RunState<'_>, contact: usize, rate: f64) {
        let _ = (run, contact, rate);
    }

    /// Division for a contact that closes, no coarser than the planned one.
    fn division_at_touch(
        &self,
        run: &RunState<'_>,
        contact: usize,
        rate: f64,
        episode: &Episode,
        planned: u32,
    ) -> u32 {
        let _ = (run, contact, rate, episode);
        planned
    }

    /// A contact has opened.
    fn after_release(&mut self, run: &RunState<'_>, contact: usize) {
        let _ = (run, contact);
    }

    /// A sudden change of the ground acceleration of a building \[m/s²\].
    fn change_ground(&mut self, run: &RunState<'_>, building: usize, change: Ground);

    /// A sudden change of a contact force \[N\].
    fn change_force(&mut self, run: &RunState<'_>, contact: usize, change: f64);

    /// A contact closing at a rate opens at once with `restitution` times that.
    fn jump_velocities(
        &mut self,
        run: &mut RunState<'_>,
        contact: usize,
        restitution: f64,
        rate: f64,
    ) -> Jump;

    /// Forces have changed suddenly, all of them by now; `velocities`: velocities too.
    fn restart(&mut self, run: &RunState<'_>, velocities: bool) {
        let _ = (run, velocities);
    }

    /// An event has been applied.
    fn after_event(&mut self, run: &RunState<'_>) {
        let _ = run;
    }
}
