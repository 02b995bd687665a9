//! Total force of the points of a face of two buildings in space, impact by impact.

use super::gap_forces::{StepForce, peak_of_many};
use super::step_friction::FrictionPath;
use crate::history::{Extreme, FaceImpact};
use crate::interface::MOST_POINTS;
use crate::system::System;

/// Impacts of every face: from the first of its points that touches to the last that parts.
pub(super) struct FaceForces {
    /// In the order in which they began.
    pub(super) impacts: Vec<FaceImpact>,
    /// Of every face, the index of its impact under way.
    current: Vec<Option<usize>>,
    /// Faces with closed points in the step just accepted, and in the one before, in rising order.
    closed: Vec<usize>,
    closed_before: Vec<usize>,
    /// Of every contact, its number among the points of its face.
    point: Vec<usize>,
    /// Closed points of the step just accepted.
    step: Vec<ClosedPoint>,
    /// Those of one face.
    together: Vec<StepForce>,
    /// Friction of closed points over the step just accepted, with their faces and coefficients; and that of one face.
    friction: Vec<(usize, f64, FrictionPath)>,
    friction_of_face: Vec<FrictionPath>,
}

/// A closed point over a step.
#[derive(Clone, Copy)]
struct ClosedPoint {
    face: usize,
    /// Number among the points of the face.
    point: usize,
    /// Place in plan \[m\].
    at: [f64; 2],
    force: StepForce,
}

impl FaceForces {
    pub(super) fn new(system: &System) -> Self {
        let places = system.contacts.iter().filter_map(|contact| contact.plan);
        let faces = places.map(|place| place.face + 1).max().unwrap_or(0);
        let points = if faces == 0 { 0 } else { system.contacts.len() };
        let mut counted = vec![0; faces];
        let point = system.contacts.iter().map(|contact| {
            let count = contact.plan.and_then(|place| counted.get_mut(place.face));
            count.map_or(0, |count| {
                *count += 1;
                *count - 1
            })
        });
        let point = point.collect();
        Self {
            impacts: Vec::new(),
            current: vec![None; faces],
            closed: Vec::with_capacity(faces),
            closed_before: Vec::with_capacity(faces),
            point,
            step: Vec::with_capacity(points),
            together: Vec::with_capacity(points),
            friction: Vec::with_capacity(points),
            friction_of_face: Vec::with_capacity(points),
        }
    }

    /// Adds a closed point of the step just accepted: its contact, its face and its place in plan.
    pub(super) fn add(&mut self, contact: usize, face: usize, at: [f64; 2], force: StepForce) {
        self.step.push(ClosedPoint {
            face,
            point: self.point[contact],
            at,
            force,
        });
    }

    /// Adds the friction of such a point over the step, with its coefficient \[–\].
    pub(super) fn add_friction(&mut self, face: usize, coefficient: f64, path: FrictionPath) {
        self.friction.push((face, coefficient, path));
    }

    /// Points of a face were struck at an instant \[s\] by the momentum law; `centre`: that of their impulses so far \[m\]. They
    /// are part of the impact under way, if there is one.
    pub(super) fn strike(&mut self, face: usize, instant: f64, centre: [f64; 2]) {
        if self.current[face].is_some() {
            return;
        }
        let last = self
            .impacts
            .iter_mut()
            .rev()
            .find(|impact| impact.face == face);
        match last {
            Some(impact) if impact.start == instant && impact.end == instant => {
                impact.centre = centre;
            }
            _ => self.impacts.push(FaceImpact {
                centre,
                peak_force: Extreme {
                    value: 0.0,
                    at: instant,
                },
                ..FaceImpact::beginning(face, instant)
            }),
        }
    }

    /// Updates impacts after a step \[s\] that began at `start` \[s\].
    pub(super) fn finish_step(&mut self, start: f64, step: f64) {
        // Points of a face follow each other; faces in rising order.
        if !self.step.is_sorted_by_key(|closed| closed.face) {
            self.step.sort_unstable_by_key(|closed| closed.face);
            self.friction.sort_unstable_by_key(|(face, ..)| *face);
        }
        let closed = std::mem::take(&mut self.step);
        let friction = std::mem::take(&mut self.friction);
        let (mut points, mut rubbed) = (&closed[..], &friction[..]);
        self.closed.clear();
        while let Some(&ClosedPoint { face, .. }) = points.first() {
            let touching = points.iter().take_while(|point| point.face == face).count();
            let rubbing = rubbed
                .iter()
                .take_while(|(rubbed_face, ..)| *rubbed_face == face)
                .count();
            self.finish_face(face, &points[..touching], &rubbed[..rubbing], [start, step]);
            (points, rubbed) = (&points[touching..], &rubbed[rubbing..]);
            self.closed.push(face);
        }
        for face in self.closed_before.drain(..) {
            if self.closed.binary_search(&face).is_err() {
                self.current[face] = None;
            }
        }
        std::mem::swap(&mut self.closed, &mut self.closed_before);
        (self.step, self.friction) = (closed, friction);
        self.step.clear();
        self.friction.clear();
    }

    /// Updates the impact of a face with its closed points and the friction at them.
    fn finish_face(
        &mut self,
        face: usize,
        points: &[ClosedPoint],
        rubbed: &[(usize, f64, FrictionPath)],
        [start, step]: [f64; 2],
    ) {
        let index = *self.current[face].get_or_insert_with(|| {
            self.impacts.push(FaceImpact::beginning(face, start));
            self.impacts.len() - 1
        });
        self.together.clear();
        self.together
            .extend(points.iter().map(|closed| closed.force));
        let peak = peak_of_many(&self.together, start, step);
        let impact = &mut self.impacts[index];
        impact.end = start + step;
        if let Some((_, coefficient, _)) = rubbed.first() {
            let limit = coefficient * impact.peak_force.value.max(peak.value);
            self.friction_of_face.clear();
            self.friction_of_face
                .extend(rubbed.iter().map(|(.., path)| *path));
            let paths = &self.friction_of_face;
            impact.peak_friction.widen(paths, limit, [start, step]);
        }
        if peak.value <= impact.peak_force.value {
            return;
        }
        impact.peak_force = peak;
        let fraction = (peak.at - start) / step;
        let (mut sum, mut moment) = (0.0, [0.0; 2]);
        impact.point_forces = [0.0; MOST_POINTS];
        for closed in points {
            let force = closed.force.at(fraction);
            sum += force;
            moment = [
                moment[0] + force * closed.at[0],
                moment[1] + force * closed.at[1],
            ];
            if let Some(point_force) = impact.point_forces.get_mut(closed.point) {
                *point_force = force;
            }
        }
        if sum > 0.0 {
            impact.centre = moment.map(|moment| moment / sum);
        }
    }
}
