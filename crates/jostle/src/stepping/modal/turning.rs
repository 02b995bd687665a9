//! Accelerations at turning points within a step, from the exact motion of the modes: cubics between the ends lose the
//! highest modes, to which accelerations are most sensitive.

use super::mode_kernels::LANES;
use super::peaks::Ends;
use super::reduced::Reduced;
use super::response::Responses;
use super::step_table::filled;
use crate::stepping::events::Cubic;
use crate::system::{Direction, GroundsAt};

/// Fraction of the greatest value so far from which turning points of cubics are looked at exactly.
pub(super) const NEAR_GREATEST: f64 = 0.95;
/// Gain of a step towards the exact turning point above which the motion there is evaluated as well \[–\].
const WORTH_A_STEP: f64 = 1e-5;

/// Motion of all modes within a step.
#[derive(Clone, Copy)]
pub(super) struct StepMotion<'a> {
    /// Modal displacements and velocities at the start.
    pub(super) start: [&'a [f64]; 2],
    pub(super) loads: Loads<'a>,
    /// Ground acceleration at both ends \[m/s²\].
    pub(super) ground: [GroundsAt<'a>; 2],
    pub(super) step: f64,
}

/// Modal loads over a step.
#[derive(Clone, Copy)]
pub(super) enum Loads<'a> {
    /// Of the ground alone.
    Ground,
    /// p₀ + (p₁ − p₀)τ + b(τ² − τ).
    Parabolas([&'a [f64]; 3]),
}

impl StepMotion<'_> {
    /// Load of a mode at a fraction of the step, its rate, and its bend from the start up to there.
    fn load(&self, reduced: &Reduced, mode: usize, tau: f64) -> [f64; 4] {
        let [first, last, bend] = match self.loads {
            Loads::Ground => {
                let [then, now] = self.ground.map(|all| all.common);
                let share = -reduced.participation[mode];
                let along = [share * then[0], share * now[0]];
                match reduced.across.get(mode) {
                    Some(across) => [along[0] - across * then[1], along[1] - across * now[1], 0.0],
                    None => [along[0], along[1], 0.0],
                }
            }
            Loads::Parabolas(lists) => lists.map(|list| list[mode]),
        };
        let rise = last - first;
        [
            first,
            first + rise * tau + bend * (tau * tau - tau),
            bend * tau * tau,
            (rise + bend * (2.0 * tau - 1.0)) / self.step,
        ]
    }

    /// Total acceleration of a floor in a direction at a fraction of the step, and its rate \[m/s², m/s³\].
    fn acceleration(
        &self,
        reduced: &Reduced,
        building: usize,
        (floor, direction): (usize, Direction),
        tau: f64,
    ) -> [f64; 2] {
        let reduced_building = &reduced.buildings[building];
        let grounds = self.ground.map(|all| all.of(building));
        let [g0, g1] = grounds.map(|ground| direction.of_ground(ground));
        let mut sums = [g0 + (g1 - g0) * tau, (g1 - g0) / self.step];
        for first in reduced_building.modes.clone().step_by(LANES) {
            let modes = first..(first + LANES).min(reduced_building.modes.end);
            let (damping, stiffness) = (
                &reduced.damping[modes.clone()],
                &reduced.stiffness[modes.clone()],
            );
            let responses = Responses::of_several(
                reduced.arch(),
                filled(damping),
                filled(stiffness),
                tau * self.step,
            );
            for (lane, mode) in modes.enumerate() {
                let [start, end, bend, rate] = self.load(reduced, mode, tau);
                let inputs = [self.start[0][mode], self.start[1][mode], start, end, bend];
                let [q, v] = [&responses.displacement, &responses.velocity].map(|rows| {
                    let terms = rows
                        .iter()
                        .zip(inputs)
                        .map(|(row, input)| row[lane] * input);
                    terms.sum::<f64>()
                });
                let (d, k) = (damping[lane], stiffness[lane]);
                let a = end - d * v - k * q;
                let jerk = rate - d * a - k * v;
                let shape = reduced_building.of_blocks(
                    &reduced_building.blocks,
                    floor,
                    mode - reduced_building.modes.start,
                );
                sums[0] += shape * a;
                sums[1] += shape * jerk;
            }
        }
        sums
    }

    /// Greatest magnitude so far of the total acceleration of a floor, with its ends in this step.
    pub(super) fn greatest_acceleration(
        &self,
        reduced: &Reduced,
        building: usize,
        floor: (usize, Direction),
        ends: Ends,
        known: f64,
    ) -> f64 {
        let mut greatest = known.max(ends.then[0].abs()).max(ends.now[0].abs());
        if !ends.may_exceed(NEAR_GREATEST * greatest, self.step) {
            return greatest;
        }
        let Ends { then, now } = ends;
        let curve = Cubic::new(then[0], then[1], now[0], now[1], self.step);
        for at in curve.turning_points() {
            if curve.value(at).abs() <= NEAR_GREATEST * greatest {
                continue;
            }
            let [value, rate] = self.acceleration(reduced, building, floor, at);
            greatest = greatest.max(value.abs());
            // Newton's step towards the exact turning point.
            let change = -rate * self.step / curve.curvature(at);
            let gain = 0.5 * change * rate * self.step * value.signum();
            if gain > WORTH_A_STEP * greatest {
                let [value, _] =
                    self.acceleration(reduced, building, floor, (at + change).clamp(0.01, 1.0));
                greatest = greatest.max(value.abs());
            } else if gain > 0.0 {
                greatest = greatest.max(value.abs() + gain);
            }
        }
        greatest
    }
}
