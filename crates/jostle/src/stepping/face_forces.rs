//! Total force of the points of a face of two buildings in space, impact by impact.

use super::gap_forces::{StepForce, peak_of_sum};
use crate::history::{Extreme, FaceImpact};
use crate::system::System;

/// Impacts of every face: from the first of its points that touches to the last that parts.
pub(super) struct FaceForces {
    /// In the order in which they began.
    pub(super) impacts: Vec<FaceImpact>,
    /// Of every face, the index of its impact under way.
    current: Vec<Option<usize>>,
    /// Closed points of the step just accepted: face, place in plan, and force.
    step: Vec<(usize, [f64; 2], StepForce)>,
    /// Those of one face.
    together: Vec<StepForce>,
    /// Friction at the end of the step of every closed point of a face, and ±μ of those that slipped all through it.
    rubbed: Vec<(usize, f64, Option<f64>)>,
}

impl FaceForces {
    pub(super) fn new(system: &System) -> Self {
        let places = system.contacts.iter().filter_map(|contact| contact.plan);
        let faces = places.map(|place| place.face + 1).max().unwrap_or(0);
        let points = if faces == 0 { 0 } else { system.contacts.len() };
        Self {
            impacts: Vec::new(),
            current: vec![None; faces],
            step: Vec::with_capacity(points),
            together: Vec::with_capacity(points),
            rubbed: Vec::with_capacity(points),
        }
    }

    /// Adds a closed point of the step just accepted.
    pub(super) fn add(&mut self, face: usize, at: [f64; 2], force: StepForce) {
        self.step.push((face, at, force));
    }

    /// Adds the friction of such a point at the end of the step \[N\], and ±μ if it slipped all through it.
    pub(super) fn rub(&mut self, face: usize, force: f64, slipped: Option<f64>) {
        self.rubbed.push((face, force, slipped));
    }

    /// Greatest total friction of a face in the step: at its end, or with the greatest contact force if all its points slip
    /// the same way.
    fn friction(&self, face: usize, pressed: Extreme, end: f64) -> Extreme {
        let own = || self.rubbed.iter().filter(|(own, ..)| *own == face);
        let sum: f64 = own().map(|(_, force, _)| force).sum();
        let all = own()
            .map(|(.., slipped)| *slipped)
            .reduce(|a, b| if a == b { a } else { None });
        match all.flatten() {
            Some(share) if share.abs() * pressed.value > sum.abs() => Extreme {
                value: share.abs() * pressed.value,
                at: pressed.at,
            },
            _ => Extreme {
                value: sum.abs(),
                at: end,
            },
        }
    }

    /// Updates impacts after a step \[s\] that began at `start` \[s\].
    pub(super) fn finish_step(&mut self, start: f64, step: f64) {
        for face in 0..self.current.len() {
            let own = self.step.iter().filter(|(own, ..)| *own == face);
            self.together.clear();
            self.together.extend(own.map(|(.., force)| *force));
            if self.together.is_empty() {
                self.current[face] = None;
                continue;
            }
            let index = *self.current[face].get_or_insert_with(|| {
                self.impacts.push(FaceImpact::beginning(face, start));
                self.impacts.len() - 1
            });
            let peak = peak_of_sum(&self.together, start, step);
            let friction = self.friction(face, peak, start + step);
            let impact = &mut self.impacts[index];
            impact.end = start + step;
            if friction.value > impact.peak_friction.value {
                impact.peak_friction = friction;
            }
            if peak.value <= impact.peak_force.value {
                continue;
            }
            impact.peak_force = peak;
            let fraction = (peak.at - start) / step;
            let (mut sum, mut moment) = (0.0, [0.0; 2]);
            for (_, at, force) in self.step.iter().filter(|(own, ..)| *own == face) {
                let force = force.at(fraction);
                sum += force;
                moment = [moment[0] + force * at[0], moment[1] + force * at[1]];
            }
            if sum > 0.0 {
                impact.centre = moment.map(|moment| moment / sum);
            }
        }
        self.step.clear();
        self.rubbed.clear();
    }
}
