//! Closed contacts over an accepted step.

use super::{Runner, Stepper};
use crate::state::ContactPhase;

impl<S: Stepper> Runner<'_, S> {
    /// Before the buildings move on: what every closed contact does over the step.
    pub(super) fn gather_episodes(&mut self, step: f64) {
        for closed in 0..self.run.coupling.closed.len() {
            let index = self.run.coupling.closed[closed].contact;
            let Some(&ContactPhase::Closed(mut episode)) = self.run.phases.get(index) else {
                continue;
            };
            let (law, start) = (self.run.system.contacts[index].law, self.run.time);
            let curve = self.indentation_curve(index, step);
            let trial = self.run.trials[index];
            self.stepper
                .gather(&mut self.run, closed, &mut episode, &curve, step);
            self.run.coupling.closed[closed].turn =
                episode.follow_indentation(&law, &curve, &trial, start, step);
            self.run.phases[index] = ContactPhase::Closed(episode);
        }
    }

    /// After the buildings have moved on: peaks of the forces, the next division, and contacts that have opened.
    pub(super) fn finish_episodes(&mut self, step: f64, start: f64) {
        for closed in 0..self.run.coupling.closed.len() {
            let index = self.run.coupling.closed[closed].contact;
            let Some(&ContactPhase::Closed(mut episode)) = self.run.phases.get(index) else {
                continue;
            };
            let trial = self.run.trials[index];
            let contact = &self.run.system.contacts[index];
            let turn = self.run.coupling.closed[closed].turn;
            let slopes = [
                self.run.coupling.closed[closed].start_slope,
                self.stepper
                    .end_slope(&self.run, index, &trial, &episode, step),
            ];
            let force = episode.follow_force(&contact.law, &trial, slopes, turn, start, step);
            self.run.gap_forces.add(contact.gap, force);
            if let Some(place) = contact.plan {
                self.run.face_forces.add(index, place.face, place.at, force);
            }
            let strongest = &mut self.run.strongest[contact.gap];
            *strongest = strongest.max(episode.peak_force);
            let division = self
                .stepper
                .next_division(&self.run, closed, &episode, start, step);
            self.run.contact_division[index] = division;
            self.run.finest_in_contact = self.run.finest_in_contact.max(division);
            let path =
                self.stepper
                    .follow_friction(&self.run, index, &mut episode, &force, [start, step]);
            if let (Some(place), Some(friction), Some(path)) =
                (contact.plan, &contact.friction, path)
            {
                let faces = &mut self.run.face_forces;
                faces.add_friction(place.face, friction.law.coefficient, path);
            }
            if episode.advance(&contact.law, &trial, turn) {
                self.run.report_impact(index, &episode, true);
                self.run.open(index, &episode);
                self.stepper.after_release(&self.run, index);
            } else {
                self.run.phases[index] = ContactPhase::Closed(episode);
            }
        }
        self.run.gap_forces.finish_step(start, step);
        self.run.face_forces.finish_step(start, step);
    }
}
