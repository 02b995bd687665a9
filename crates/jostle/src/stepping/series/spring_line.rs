//! The straight line on which a spring moves, and where it leaves it.

use super::power_series::{PARTS, Powers};
use crate::hysteresis::{Hysteresis, HysteresisMemory, Rates, Side};

/// The line on which a spring moves now.
#[derive(Clone, Copy, Debug)]
pub(super) struct SpringLine {
    /// A point of it: deformation and force.
    deformation: f64,
    force: f64,
    pub(super) tangent: f64,
    /// Direction of the motion, where the spring may move one way only.
    towards: Side,
    /// Whether the way back is the same line.
    both_ways: bool,
    /// Deformations at which it ends: towards the negative and the positive side.
    ends: [f64; 2],
    /// Greatest deformation on record of either side, with the sign of the side.
    greatest: [f64; 2],
}

/// Why a spring leaves its line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Leaving {
    /// It comes to the end towards a side.
    End(Side),
    /// It turns back, and another line leads there.
    Turn,
}

/// Two slopes that differ by no more than this share are those of one line.
const SAME_SLOPE: f64 = 1e-12;
/// An end nearer than this, as a share of the yield deformation, has been reached.
const REACHED: f64 = 1e-13;
/// Ends in one place that are passed at once.
const MOST_ENDS_AT_ONCE: usize = 8;

impl SpringLine {
    /// The line from the committed point of a spring that moves towards a side, or either way.
    pub(super) fn from_here(
        spring: &Hysteresis,
        memory: &mut HysteresisMemory,
        towards: Side,
    ) -> Self {
        let yielding = |side: Side| spring.backbone().side(side).yielding.deformation;
        // Past the end where the spring stands already.
        for _ in 0..MOST_ENDS_AT_ONCE {
            let end = spring.next_corner(memory, towards);
            if !end.is_finite() {
                break;
            }
            let near = REACHED * yielding(towards).max(end.abs());
            let ahead = towards.sign() * (end - memory.deformation());
            if !(ahead > 0.0 && ahead <= near) {
                break;
            }
            let past = end + towards.sign() * near;
            let [force, _] = spring.answer(memory, past, &Rates::default());
            spring.commit(memory, past, force);
        }
        let ahead = |side: Side| {
            let end = spring.next_corner(memory, side);
            let here = memory.deformation();
            let probe = if end.is_finite() {
                0.5 * (here + end)
            } else {
                here + side.sign() * yielding(side)
            };
            let tangent = spring.answer(memory, probe, &Rates::default())[1];
            (end, tangent, probe)
        };
        let (end, tangent, on_it) = ahead(towards);
        let (other_end, other_tangent, on_the_other) = ahead(towards.opposite());
        // Where the force is zero, each passage leaves its mark on a spring with damage, whatever the slopes.
        let leaves_marks = spring.is_damaged_on_the_way(memory, &[on_it, on_the_other, on_it]);
        let apart = (tangent - other_tangent).abs();
        let ends = match towards {
            Side::Negative => [end, other_end],
            Side::Positive => [other_end, end],
        };
        Self {
            deformation: memory.deformation(),
            force: memory.force(),
            tangent,
            towards,
            both_ways: !leaves_marks
                && apart <= SAME_SLOPE * tangent.abs().max(other_tangent.abs()),
            ends,
            greatest: [
                -memory.greatest(Side::Negative),
                memory.greatest(Side::Positive),
            ],
        }
    }

    /// Force at a deformation on the line.
    #[inline]
    pub(super) fn force_at(&self, deformation: f64) -> f64 {
        self.force + self.tangent * (deformation - self.deformation)
    }

    /// Whether a rate of the deformation leads the other way than the line.
    pub(super) fn goes_against(&self, rate: f64) -> bool {
        !self.both_ways && self.towards.sign() * rate < 0.0
    }

    /// The side to which the spring goes on after leaving the line.
    pub(super) fn next_side(&self, leaving: Leaving) -> Side {
        match leaving {
            Leaving::End(side) => side,
            Leaving::Turn => self.towards.opposite(),
        }
    }

    /// Takes note of a deformation on the line.
    pub(super) fn keep_record(&mut self, deformation: f64) {
        let [least, most] = self.greatest;
        self.greatest = [least.min(deformation), most.max(deformation)];
    }

    /// Deformation of an end.
    pub(super) fn end(&self, side: Side) -> f64 {
        match side {
            Side::Negative => self.ends[0],
            Side::Positive => self.ends[1],
        }
    }

    /// Whether motion from a deformation, by at most `swing` and with a rate that may change its sign or not, certainly stays
    /// on the line and sets no record.
    #[inline]
    pub(super) fn certainly_stays(&self, start: f64, swing: f64, keeps_direction: bool) -> bool {
        if self.both_ways {
            start - swing > self.ends[0].max(self.greatest[0])
                && start + swing < self.ends[1].min(self.greatest[1])
        } else {
            keeps_direction && self.towards.sign() * (self.end(self.towards) - start) > swing
        }
    }

    /// The share of the step at which the spring first leaves the line, and why. `record` takes the shares at which it turns
    /// on the line before that and sets a record, and the deformations there.
    pub(super) fn leaves(
        &self,
        motion: &Powers,
        mut record: impl FnMut(f64, f64),
    ) -> Option<(f64, Leaving)> {
        let mut start = 0.0;
        let [mut before, mut rate] = motion.value_and_rate(0.0);
        if !self.both_ways && rate * self.towards.sign() <= 0.0 {
            // It has just turned: rounding decides what is left of its rate.
            rate = self.towards.sign();
        }
        for part in 1..=PARTS {
            let end = f64::from(part) / f64::from(PARTS);
            let [reached, end_rate] = motion.value_and_rate(end);
            if end_rate != 0.0 && (rate > 0.0) != (end_rate > 0.0) && rate != 0.0 {
                let rates = [(start, rate), (end, end_rate)];
                let turn = Powers::root(rates, |s| motion.rate_and_curvature(s));
                let at = motion.value(turn);
                if let Some(left) = self.ends_within([(start, before), (turn, at)], motion) {
                    return Some(left);
                }
                if !self.both_ways {
                    return Some((turn, Leaving::Turn));
                }
                if at < self.greatest[0] || at > self.greatest[1] {
                    record(turn, at);
                }
                (start, before) = (turn, at);
            }
            if let Some(left) = self.ends_within([(start, before), (end, reached)], motion) {
                return Some(left);
            }
            (start, before) = (end, reached);
            rate = if end_rate == 0.0 { rate } else { end_rate };
        }
        None
    }

    /// The end of the line within a part of the step, given by shares and deformations, in which the motion keeps its direction.
    #[inline]
    fn ends_within(
        &self,
        [(start, before), (end, reached)]: [(f64, f64); 2],
        motion: &Powers,
    ) -> Option<(f64, Leaving)> {
        let side = Side::from_change(reached - before);
        if !self.both_ways && side != self.towards {
            return None;
        }
        let limit = self.end(side);
        if side.sign() * (reached - limit) < 0.0 {
            return None;
        }
        let at = if side.sign() * (before - limit) >= 0.0 {
            start
        } else {
            let ends = [(start, before - limit), (end, reached - limit)];
            Powers::root(ends, |s| {
                let [value, rate] = motion.value_and_rate(s);
                [value - limit, rate]
            })
        };
        Some((at, Leaving::End(side)))
    }
}
