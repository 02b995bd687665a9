//! Data of a run that do not depend on the stepper.

use super::contact_events::{ContactTrial, impact_of};
use crate::history::{Column, Impact, Kind, Owner, Peaks, Work};
use crate::interface::Contact;
use crate::model::Solver;
use crate::motion::{Ground, GroundMotion};
use crate::state::{ContactPhase, Episode, State};
use crate::stepping::clock::Clock;
use crate::stepping::coupling::ContactEquations;
use crate::stepping::face_forces::FaceForces;
use crate::stepping::gap_forces::GapForces;
use crate::stepping::outcome::{Outcome, Pounding, RunEnd, Settings};
use crate::stepping::plan::Plan;
use crate::system::{GroundsAt, RunGrounds, System};

/// Shortest step to a corner of a ground acceleration, in free-vibration steps.
const SHORTEST_TO_CORNER: f64 = 1e-5;

/// Clock, contacts and results of a run.
pub(in crate::stepping) struct RunState<'a> {
    pub(in crate::stepping) system: &'a System,
    pub(in crate::stepping) motion: &'a GroundMotion,
    pub(in crate::stepping) plan: &'a Plan,
    pub(in crate::stepping) pounding: bool,
    pub(in crate::stepping) clock: Clock,
    /// Time now \[s\].
    pub(in crate::stepping) time: f64,
    /// Ground acceleration now and at the end of the tried step \[m/s²\].
    pub(in crate::stepping) ground: [Ground; 2],
    /// Grounds of the single buildings, if they have their own.
    pub(in crate::stepping) grounds: RunGrounds<'a>,
    /// Whether the accelerations of any of them may jump.
    pub(in crate::stepping) ground_jumps: bool,
    /// Whether steps end at corners that are not on the grid.
    pub(in crate::stepping) cuts_at_corners: bool,
    pub(in crate::stepping) phases: Vec<ContactPhase>,
    /// Depth to which ended impacts have crushed every contact, and its gap, wider by that \[m\].
    pub(in crate::stepping) crushed: Vec<f64>,
    pub(in crate::stepping) widths: Vec<f64>,
    /// Contacts that are closed, or that can have touched in the tried step, in rising order: all but those that the stepper
    /// excludes. Only their trials are up to date.
    pub(in crate::stepping) near: Vec<usize>,
    /// Of contacts, then of links, or of friction along contacts in the order of contacts.
    pub(in crate::stepping) trials: Vec<ContactTrial>,
    /// Into how many parts every contact divides the free-vibration step.
    pub(in crate::stepping) contact_division: Vec<u32>,
    pub(in crate::stepping) finest_in_contact: u32,
    /// Greatest force of every gap so far, measured or expected of an impact under way \[N\].
    pub(in crate::stepping) strongest: Vec<f64>,
    pub(in crate::stepping) gap_forces: GapForces,
    /// Impacts of the faces of buildings in space.
    pub(in crate::stepping) face_forces: FaceForces,
    pub(in crate::stepping) coupling: ContactEquations,
    /// Whether this step ends at a corner of a contact force.
    pub(in crate::stepping) at_corner: bool,
    pub(in crate::stepping) impacts: Vec<Impact>,
    pub(in crate::stepping) work: Work,
}

impl<'a> RunState<'a> {
    pub(in crate::stepping) fn new(
        system: &'a System,
        motion: &'a GroundMotion,
        plan: &'a Plan,
        settings: Settings,
    ) -> Self {
        let ground = motion.components(0.0);
        let contacts = system.contacts.len();
        let gaps = system.contacts.iter().map(|contact| contact.gap + 1);
        Self {
            system,
            motion,
            plan,
            pounding: settings.pounding == Pounding::Included,
            clock: if matches!(plan.solver, Solver::Modal | Solver::Series) {
                Clock::ending_at_record_points(plan.step)
            } else {
                Clock::new(plan.step)
            },
            time: 0.0,
            ground: [ground, ground],
            grounds: RunGrounds::new(system, motion),
            ground_jumps: motion.grounds.is_some(),
            cuts_at_corners: plan.chooses_contact_steps() && motion.has_corners_off(plan.step),
            phases: vec![ContactPhase::Open; contacts],
            crushed: vec![0.0; contacts],
            widths: system.contacts.iter().map(Contact::touches_at).collect(),
            near: (0..contacts).collect(),
            trials: vec![
                ContactTrial::default();
                contacts + system.links.len().max(system.frictions().count())
            ],
            contact_division: vec![1; contacts],
            finest_in_contact: 0,
            strongest: vec![0.0; gaps.max().unwrap_or(0)],
            gap_forces: GapForces::new(system),
            face_forces: FaceForces::new(system),
            coupling: ContactEquations::default(),
            at_corner: false,
            impacts: Vec::new(),
            work: Work::default(),
        }
    }

    /// What no stepper finds itself: impacts, forces of gaps and faces, and work.
    pub(in crate::stepping) fn into_outcome(self, mut peaks: Peaks, end: RunEnd) -> Outcome {
        let gaps = self.gap_forces.peaks.into_iter().enumerate();
        peaks.extend(gaps.map(|(gap, force)| {
            let column = Column::along(Owner::Gap(gap), Kind::Force);
            (column, force.into())
        }));
        Outcome {
            peaks,
            impacts: self.impacts,
            face_impacts: self.face_forces.impacts,
            work: self.work,
            end,
            ..Outcome::default()
        }
    }

    /// Time to the next corner of any ground acceleration that steps must end on, if buildings have grounds of their own:
    /// every one that is not on the grid, and jumps \[s\].
    pub(in crate::stepping) fn until_corner(&self) -> f64 {
        if !self.ground_jumps {
            return f64::INFINITY;
        }
        // What is so close has been reached.
        let from = self.time + SHORTEST_TO_CORNER * self.plan.step;
        let corner = self.grounds.next_corner(from, self.cuts_at_corners);
        corner.map_or(f64::INFINITY, |corner| corner - self.time)
    }

    /// Ground accelerations now (0), or at the end of the tried step (1).
    pub(in crate::stepping) fn grounds_at(&self, time: usize) -> GroundsAt<'_> {
        self.grounds.at(time, self.ground[time])
    }

    /// Moves the grounds to the end of the tried step \[s\].
    pub(in crate::stepping) fn move_grounds(&mut self, end: f64) {
        self.ground[1] = self.motion.components(end);
        self.grounds.try_end(end);
    }

    /// Whether the tried step has a closed contact.
    pub(in crate::stepping) fn in_contact(&self) -> bool {
        let mut closed = self.coupling.closed.iter();
        closed.any(|closed| closed.contact < self.phases.len())
    }

    /// Takes over the contacts of a state.
    pub(in crate::stepping) fn take_contacts(&mut self, state: &State) {
        self.phases.clone_from(&state.contacts);
        for (contact, depth) in state.crushed.iter().enumerate() {
            self.crushed[contact] = *depth;
            self.widths[contact] = self.system.contacts[contact].touches_at() + depth;
        }
    }

    /// Opens a contact; what it has crushed stays crushed.
    pub(super) fn open(&mut self, contact: usize, episode: &Episode) {
        let depth = episode.memory.crushed;
        if depth > 0.0 {
            self.crushed[contact] += depth;
            self.widths[contact] =
                self.system.contacts[contact].touches_at() + self.crushed[contact];
        }
        self.phases[contact] = ContactPhase::Open;
    }

    /// Whether a contact is open.
    pub(in crate::stepping) fn is_open(&self, index: usize) -> bool {
        self.phases[index] == ContactPhase::Open
    }

    /// Lists an episode as an impact, if it was one.
    pub(in crate::stepping) fn report_impact(
        &mut self,
        contact: usize,
        episode: &Episode,
        finished: bool,
    ) {
        self.impacts.extend(impact_of(contact, episode, finished));
    }
}
