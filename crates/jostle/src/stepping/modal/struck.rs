//! Greatest accelerations within a step after a jump of velocities, where they do not follow a cubic: dashpots and quick
//! modes answer at once.

use super::reduced::Reduced;
use super::step_table::StepTable;
use crate::system::GroundsAt;

/// Levels of instants at which the exact motion is evaluated, each closer to the start than the one before.
const LEVELS: usize = 3;
/// Parts into which the step is divided, and the first part of every level again.
const PARTS: u32 = 8;

/// Start of a step and its loads, p₀ + (p₁ − p₀)τ + b(τ² − τ).
#[derive(Clone, Copy)]
pub(super) struct StruckStep<'a> {
    pub(super) q: &'a [f64],
    pub(super) v: &'a [f64],
    pub(super) loads: [&'a [f64]; 2],
    pub(super) bend: &'a [f64],
    /// Ground acceleration at both ends \[m/s²\].
    pub(super) ground: [GroundsAt<'a>; 2],
    pub(super) step: f64,
}

/// Evaluates the exact motion within steps.
#[derive(Default)]
pub(super) struct WithinStep {
    tables: [StepTable; LEVELS],
    /// Modal displacement, velocity and load at both ends of a part.
    q: [Vec<f64>; 2],
    v: [Vec<f64>; 2],
    p: [Vec<f64>; 2],
    bend: Vec<f64>,
    modal: Vec<f64>,
    spare: Vec<f64>,
    /// The last three instants, the latest first, with total accelerations there \[s, m/s²\].
    last: [(f64, Vec<f64>); 3],
    greatest: Vec<f64>,
}

impl WithinStep {
    /// Greatest total acceleration of every monitored point within a step \[m/s²\].
    pub(super) fn greatest(&mut self, reduced: &Reduced, start: &StruckStep<'_>) -> &[f64] {
        self.begin(reduced, start);
        let mut part = start.step / f64::from(PARTS.pow(LEVELS as u32));
        let mut time = 0.0;
        for (level, first) in (0..LEVELS).zip([1, 2, 2]) {
            if self.tables[level].step != part {
                self.tables[level].set(reduced, part, None);
            }
            for index in first..=PARTS {
                let end = f64::from(index) * part;
                self.take_part(reduced, start, level, [time, end]);
                time = end;
            }
            part *= f64::from(PARTS);
        }
        &self.greatest
    }

    fn begin(&mut self, reduced: &Reduced, start: &StruckStep<'_>) {
        let (modes, watched) = (reduced.modes(), reduced.watched());
        for pair in [&mut self.q, &mut self.v, &mut self.p] {
            pair.iter_mut().for_each(|list| list.resize(modes, 0.0));
        }
        for list in [&mut self.bend, &mut self.modal] {
            list.resize(modes, 0.0);
        }
        for list in [&mut self.spare, &mut self.greatest] {
            list.resize(watched, 0.0);
        }
        for (time, list) in &mut self.last {
            *time = f64::NAN;
            list.resize(watched, 0.0);
        }
        self.greatest.fill(0.0);
        self.q[0].copy_from_slice(start.q);
        self.v[0].copy_from_slice(start.v);
        self.p[0].copy_from_slice(start.loads[0]);
        self.evaluate(reduced, start, 0.0);
    }

    fn take_part(
        &mut self,
        reduced: &Reduced,
        start: &StruckStep<'_>,
        level: usize,
        [then, now]: [f64; 2],
    ) {
        let tau = now / start.step;
        let length = (now - then) / start.step;
        let loads = start.loads[0].iter().zip(start.loads[1]).zip(start.bend);
        let ends = self.p[1].iter_mut().zip(&mut self.bend);
        for ((end, own_bend), ((p0, p1), bend)) in ends.zip(loads) {
            *end = p0 + (p1 - p0) * tau + bend * (tau * tau - tau);
            *own_bend = bend * length * length;
        }
        let ([q0, q1], [v0, v1], [p0, p1]) = (&mut self.q, &mut self.v, &mut self.p);
        let of = [&q0[..], v0, p0, p1, &self.bend];
        self.tables[level].advance(reduced.arch(), of, [q1, v1]);
        for pair in [&mut self.q, &mut self.v, &mut self.p] {
            pair.swap(0, 1);
        }
        self.evaluate(reduced, start, now);
    }

    /// Total accelerations at an instant, and the greatest of the parabola through the last three.
    fn evaluate(&mut self, reduced: &Reduced, start: &StruckStep<'_>, time: f64) {
        let motion = self.q[0].iter().zip(&self.v[0]).zip(&self.p[0]);
        let factors = reduced.damping.iter().zip(&reduced.stiffness);
        for ((a, ((q, v), p)), (d, k)) in self.modal.iter_mut().zip(motion).zip(factors) {
            *a = p - d * v - k * q;
        }
        self.last.rotate_right(1);
        let [latest, middle, first] = &mut self.last;
        latest.0 = time;
        let modal = [&self.modal[..], &self.modal];
        reduced.show(modal, [&mut latest.1, &mut self.spare]);
        for (index, building) in reduced.buildings.iter().enumerate() {
            let [g0, g1] = start.ground.map(|all| all.of(index));
            let ground = [0, 1, 2].map(|axis| g0[axis] + (g1[axis] - g0[axis]) * time / start.step);
            for place in building.watched.clone() {
                latest.1[place] += reduced.directions[place].of_ground(ground);
            }
        }
        for (place, greatest) in self.greatest.iter_mut().enumerate() {
            *greatest = greatest.max(latest.1[place].abs());
            if first.0.is_finite() {
                let points = [&*first, &*middle, &*latest].map(|(time, list)| (*time, list[place]));
                *greatest = greatest.max(turning_value(points));
            }
        }
    }
}

/// Magnitude of the vertex of a parabola through three points, if the middle one is an extreme; otherwise 0.
fn turning_value([(t0, y0), (t1, y1), (t2, y2)]: [(f64, f64); 3]) -> f64 {
    let (rise, fall) = (y1 - y0, y2 - y1);
    if rise * fall >= 0.0 {
        return 0.0;
    }
    let (first, second) = (rise / (t1 - t0), fall / (t2 - t1));
    let curvature = (second - first) / (t2 - t0);
    let slope = first + curvature * (t1 - t0);
    (y1 - slope * slope / (4.0 * curvature)).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_vertex_of_a_parabola_is_exact() {
        let value = |t: f64| 3.0 - 2.0 * (t - 0.4) * (t - 0.4);
        let points = [0.1, 0.35, 1.1].map(|t| (t, value(t)));
        assert!((turning_value(points) - 3.0).abs() < 1e-14);
        let rising = [0.0, 0.1, 0.3].map(|t| (t, value(t)));
        assert_eq!(turning_value(rising), 0.0);
    }
}
