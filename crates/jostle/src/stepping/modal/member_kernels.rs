//! The loops over forces of columns and beams in a step, compiled for the widest available registers. Operations are not
//! fused or reordered between register widths, so the bits are the same on every processor.

use pulp::NullaryFnOnce;

use super::member_reach::{BlockWatch, PARTS, PartRows, Reach};
use super::members::{MemberRows, Passed, PassedBounds, tests_look_always};
use super::mode_kernels::ROWS;
use super::peaks::{BEYOND, Ends};
use crate::state::ContactPhase;

/// Rounding of sums over modes that are taken in different ways, relative to the greatest force.
const ROUNDING: f64 = 1e-9;

/// Sums of a block of rows over modes, list by list.
#[inline(always)]
fn sums<const N: usize>(block: &[[f64; ROWS]], modal: [&[f64]; N]) -> [[f64; ROWS]; N] {
    let mut sums = [[0.0; ROWS]; N];
    let modal = modal.map(|list| &list[..block.len()]);
    for (mode, shape) in block.iter().enumerate() {
        for (sums, list) in sums.iter_mut().zip(&modal) {
            let value = list[mode];
            for (sum, shape) in sums.iter_mut().zip(shape) {
                *sum += shape * value;
            }
        }
    }
    sums
}

/// The same of one list in three parts, which do not wait for each other.
#[inline(always)]
fn sums_by_thirds(block: &[[f64; ROWS]], modal: &[f64]) -> [f64; ROWS] {
    let third = block.len() / 3;
    let [first, second, last] = [0, 1, 2].map(|part| &block[part * third..(part + 1) * third]);
    let [a, b, c] = [0, 1, 2].map(|part| &modal[part * third..(part + 1) * third]);
    let mut sums = [[0.0; ROWS]; 3];
    for mode in 0..third {
        for row in 0..ROWS {
            sums[0][row] += first[mode][row] * a[mode];
            sums[1][row] += second[mode][row] * b[mode];
            sums[2][row] += last[mode][row] * c[mode];
        }
    }
    let mut all = [0.0; ROWS];
    for (row, all) in all.iter_mut().enumerate() {
        *all = (sums[0][row] + sums[1][row]) + sums[2][row];
    }
    all
}

/// Greatest and least values of a block so far.
struct Limits<'a> {
    greatest: &'a mut [f64; ROWS],
    least: &'a mut [f64; ROWS],
    /// What its values may lack.
    loose: [f64; ROWS],
}

impl Limits<'_> {
    /// What every row may still change by before it exceeds its greatest or least value.
    #[inline(always)]
    fn slack(&self, [high, low]: [&[f64; ROWS]; 2]) -> [f64; ROWS] {
        let mut slack = [0.0; ROWS];
        for (row, slack) in slack.iter_mut().enumerate() {
            let (above, below) = (self.greatest[row] - high[row], low[row] - self.least[row]);
            let range = self.greatest[row] - self.least[row];
            let least = if above < below { above } else { below };
            *slack = least - self.loose[row] - ROUNDING * range;
        }
        slack
    }

    #[inline(always)]
    fn widen(&mut self, row: usize, ends: Ends, step: f64) {
        let known = [self.greatest[row], self.least[row]];
        [self.greatest[row], self.least[row]] = ends.extremes(known, step);
    }
}

/// What modes that move so far use up of the slack of every row.
#[inline(always)]
fn uses(norms: &PartRows, parts: &[f64; PARTS]) -> [f64; ROWS] {
    let mut used = [0.0; ROWS];
    for (norms, part) in norms.iter().zip(parts) {
        for (used, norm) in used.iter_mut().zip(norms) {
            *used += norm * part;
        }
    }
    used
}

/// Whether no row can exceed its greatest or least value. Rows that never move have no slack and need none.
#[inline(always)]
fn covers(slack: &[f64; ROWS], used: &[f64; ROWS]) -> bool {
    let mut all = true;
    for (slack, used) in slack.iter().zip(used) {
        all &= slack >= used;
    }
    all
}

/// The greater and the lesser of two values of every row, and what cubics with these slopes may go beyond.
#[inline(always)]
fn range_of(
    [then, now]: [&[f64; ROWS]; 2],
    slopes: [&[f64; ROWS]; 2],
    step: f64,
) -> [[f64; ROWS]; 3] {
    let mut range = [[0.0; ROWS]; 3];
    for row in 0..ROWS {
        let (a, b) = (then[row], now[row]);
        range[0][row] = if a > b { a } else { b };
        range[1][row] = if a > b { b } else { a };
        range[2][row] = BEYOND * step * (slopes[0][row].abs() + slopes[1][row].abs());
    }
    range
}

/// Sums of a block at the end of the last step for which it was computed. They begin the next one.
#[derive(Clone, Copy, Default)]
pub(super) struct KeptSums {
    /// Step after which values and rates hold, and that of what shapes miss; 0 for none.
    after: [u64; 2],
    value: [f64; ROWS],
    rate: [f64; ROWS],
    missed: [f64; ROWS],
}

/// A step of the forces of one building that displacements determine.
pub(super) struct FollowOwn<'a> {
    pub(super) rows: &'a MemberRows,
    pub(super) watch: &'a mut [BlockWatch],
    pub(super) kept: &'a mut [KeptSums],
    /// Number of this step, from 2.
    pub(super) number: u64,
    pub(super) reach: &'a Reach,
    pub(super) greatest: &'a mut [[f64; ROWS]],
    pub(super) least: &'a mut [[f64; ROWS]],
    pub(super) with_off: &'a mut [[f64; ROWS]],
    pub(super) loose: &'a [[f64; ROWS]],
    /// Modal displacements, velocities and accelerations.
    pub(super) now: [&'a [f64]; 3],
    pub(super) then: [&'a [f64]; 3],
    pub(super) step: f64,
}

impl NullaryFnOnce for FollowOwn<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self {
            rows,
            reach,
            step,
            number,
            ..
        } = self;
        let (count, low) = (self.now[0].len(), reach.low);
        let of_low = reach.of_low();
        let ([q, v, a], [q_then, v_then, a_then]) = (self.now, self.then);
        let blocks = self.watch.iter_mut().zip(self.kept).enumerate();
        for (block, (watch, kept)) in blocks {
            let always = tests_look_always();
            if !always && !watch.is_due(reach, 0.0) {
                continue;
            }
            let own = block * count..(block + 1) * count;
            let shapes = &rows.shapes[own.clone()];
            let norms = &rows.norms[block];
            let mut limits = Limits {
                greatest: &mut self.greatest[block],
                least: &mut self.least[block],
                loose: self.loose[block],
            };
            // By low modes alone, then by all, then with what shapes miss.
            let [by_low] = sums(&shapes[..low], [q]);
            let slack = limits.slack([&by_low; 2]);
            if !always && covers(&slack, &uses(norms, &of_low)) {
                watch.set(reach, norms, &slack);
                continue;
            }
            let (value_then, rate_then);
            let (value, rate);
            if kept.after[0] + 1 == number {
                (value_then, rate_then) = (kept.value, kept.rate);
                [value, rate] = sums(shapes, [q, v]);
            } else {
                [value, value_then, rate, rate_then] = sums(shapes, [q, q_then, v, v_then]);
            }
            (kept.value, kept.rate, kept.after[0]) = (value, rate, number);
            let [high, least, beyond] = range_of([&value_then, &value], [&rate_then, &rate], step);
            if !always && covers(&limits.slack([&high, &least]), &beyond) {
                watch.set(reach, norms, &slack);
                continue;
            }
            *watch = BlockWatch::DUE;
            let (mut missed, mut off) = ([[0.0; ROWS]; 2], [0.0; ROWS]);
            if !rows.missed.is_empty() {
                let rows_missed = &rows.missed[own.clone()];
                if kept.after[1] + 1 == number {
                    missed[0] = kept.missed;
                    [missed[1]] = sums(rows_missed, [a]);
                } else {
                    missed = sums(rows_missed, [a_then, a]);
                }
                (kept.missed, kept.after[1]) = (missed[1], number);
                [off] = sums(&rows.off[own], [a]);
            }
            let with_off = &mut self.with_off[block];
            for row in 0..ROWS {
                let ends = Ends {
                    then: [value_then[row] + missed[0][row], rate_then[row]],
                    now: [value[row] + missed[1][row], rate[row]],
                };
                limits.widen(row, ends, step);
                with_off[row] = with_off[row].max(ends.now[0].abs() + off[row].abs());
            }
        }
    }
}

/// When a block of axial forces that pass through beams has to be computed again.
#[derive(Clone, Copy)]
pub(super) struct PassedWatch {
    modes: BlockWatch,
    /// Share of its slack per ‖ω q̇‖, ground acceleration and contact force.
    rates: [f64; PARTS],
    ground: f64,
    pushed: f64,
}

/// What drives a building within a step beside its modal displacements.
#[derive(Clone, Copy)]
pub(super) struct Drive<'a> {
    /// ‖ω q̇‖, part by part.
    pub(super) rates: [f64; PARTS],
    pub(super) ground: f64,
    pub(super) phases: &'a [ContactPhase],
    /// Sum of the contact forces.
    pub(super) pushes: f64,
}

impl PassedWatch {
    pub(super) const DUE: Self = Self {
        modes: BlockWatch::DUE,
        rates: [0.0; PARTS],
        ground: 0.0,
        pushed: 0.0,
    };

    #[inline(always)]
    fn is_due(&self, reach: &Reach, drive: &Drive<'_>) -> bool {
        let mut more = self.ground * drive.ground + self.pushed * drive.pushes;
        for (own, rate) in self.rates.iter().zip(&drive.rates) {
            more += own * rate;
        }
        self.modes.is_due(reach, more)
    }

    #[inline(always)]
    fn set(&mut self, reach: &Reach, bounds: &PassedBounds, slack: &[f64; ROWS]) {
        self.modes.set(reach, &bounds.norms, slack);
        let most = |list: &[f64; ROWS]| {
            let mut most = 0.0_f64;
            for (own, slack) in list.iter().zip(slack) {
                if *own > 0.0 {
                    most = most.max(own / slack.max(f64::EPSILON));
                }
            }
            most
        };
        self.rates = bounds.norms_of_rates.each_ref().map(most);
        self.ground = most(&bounds.ground);
        self.pushed = bounds.pushed.iter().map(most).fold(0.0, f64::max);
    }
}

impl PassedBounds {
    /// Adds what drives rows beside modal displacements.
    #[inline(always)]
    fn add_drive(&self, drive: &Drive<'_>, used: &mut [f64; ROWS]) {
        let by_rates = uses(&self.norms_of_rates, &drive.rates);
        for (row, used) in used.iter_mut().enumerate() {
            *used += by_rates[row] + self.ground[row] * drive.ground;
        }
        if drive.pushes == 0.0 {
            return;
        }
        for (pushed, phase) in self.pushed.iter().zip(drive.phases) {
            let force = phase.force().abs();
            for (used, pushed) in used.iter_mut().zip(pushed) {
                *used += pushed * force;
            }
        }
    }
}

/// A step of axial forces that pass through rigid beams of one building.
pub(super) struct FollowPassed<'a> {
    pub(super) passed: &'a Passed,
    pub(super) watch: &'a mut [PassedWatch],
    pub(super) kept: &'a mut [KeptSums],
    /// Number of this step, from 2.
    pub(super) number: u64,
    pub(super) reach: &'a Reach,
    pub(super) greatest: &'a mut [[f64; ROWS]],
    pub(super) least: &'a mut [[f64; ROWS]],
    /// Modal displacements, velocities, accelerations and jerks, one after the other.
    pub(super) now: &'a [f64],
    pub(super) then: &'a [f64],
    /// Number of modes.
    pub(super) count: usize,
    /// Ground acceleration at both ends.
    pub(super) ground: [f64; 2],
    pub(super) drive: Drive<'a>,
    /// Whether accelerations follow a cubic.
    pub(super) cubic: bool,
    /// Whether nothing drives modes but the ground and contacts.
    pub(super) is_bounded: bool,
    pub(super) step: f64,
}

impl NullaryFnOnce for FollowPassed<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self {
            passed,
            reach,
            count,
            drive,
            step,
            number,
            ..
        } = self;
        let [ground_then, ground] = self.ground;
        let (values, rates) = (3 * count, count..4 * count);
        let blocks = self.watch.iter_mut().zip(self.kept).enumerate();
        for (block, (watch, kept)) in blocks {
            let bounded = self.is_bounded && !tests_look_always();
            if bounded && !watch.is_due(reach, &drive) {
                continue;
            }
            let bounds = &passed.bounds[block];
            let rows = block * ROWS..((block + 1) * ROWS).min(passed.forms.len());
            let mut limits = Limits {
                greatest: &mut self.greatest[block],
                least: &mut self.least[block],
                loose: [0.0; ROWS],
            };
            *watch = PassedWatch::DUE;
            if bounded {
                let [by_low] = sums(&bounds.low, [&self.now[..reach.low]]);
                let slack = limits.slack([&by_low; 2]);
                let mut needed = uses(&bounds.norms, &reach.of_low());
                bounds.add_drive(&drive, &mut needed);
                if covers(&slack, &needed) {
                    watch.set(reach, bounds, &slack);
                    continue;
                }
            }
            let shares = &passed.shares[block * values..(block + 1) * values];
            let more = |value: &mut [f64; ROWS], ground: f64| {
                for (value, at) in value.iter_mut().zip(rows.clone()) {
                    *value += passed.ground[at][0] * ground;
                }
            };
            let push = |value: &mut [f64; ROWS]| {
                if drive.pushes == 0.0 {
                    return;
                }
                for (value, at) in value.iter_mut().zip(rows.clone()) {
                    let contacts = passed.contacts[at].iter();
                    *value -= contacts.map(|c| drive.phases[*c].force()).sum::<f64>();
                }
            };
            if !self.cubic {
                let mut value = sums_by_thirds(shares, self.now);
                more(&mut value, ground);
                push(&mut value);
                for (row, value) in value.iter().enumerate() {
                    limits.greatest[row] = limits.greatest[row].max(*value);
                    limits.least[row] = limits.least[row].min(*value);
                }
                continue;
            }
            let (mut value, mut rate);
            let (mut value_then, mut rate_then);
            if kept.after[0] + 1 == number {
                (value_then, rate_then) = (kept.value, kept.rate);
                [value, rate] = sums(shares, [self.now, &self.now[rates.clone()]]);
            } else {
                [value, value_then, rate, rate_then] = sums(
                    shares,
                    [
                        self.now,
                        self.then,
                        &self.now[rates.clone()],
                        &self.then[rates.clone()],
                    ],
                );
                more(&mut value_then, ground_then);
            }
            more(&mut value, ground);
            (kept.value, kept.rate, kept.after[0]) = (value, rate, number);
            push(&mut value);
            let slope = (ground - ground_then) / step;
            for (row, at) in rows.clone().enumerate() {
                rate[row] += passed.ground[at][1] * slope;
                rate_then[row] += passed.ground[at][1] * slope;
            }
            for row in 0..ROWS {
                let ends = Ends {
                    then: [value_then[row], rate_then[row]],
                    now: [value[row], rate[row]],
                };
                limits.widen(row, ends, step);
            }
        }
    }
}

/// Raises the greatest accelerations of modes, and what they may add to the rows of one building; whether any rose.
pub(super) fn raise_accelerations(
    rows: &MemberRows,
    accelerations: &[f64],
    known: &mut [f64],
    loose: &mut [[f64; ROWS]],
) -> bool {
    let mut any = false;
    for (a, known) in accelerations.iter().zip(&*known) {
        any |= a.abs() > *known;
    }
    if !any {
        return false;
    }
    for (mode, (a, known)) in accelerations.iter().zip(known).enumerate() {
        if a.abs() <= *known {
            continue;
        }
        let more = AHEAD * a.abs() - *known;
        *known += more;
        for (block, loose) in loose.iter_mut().enumerate() {
            let at = block * accelerations.len() + mode;
            let lists = rows.missed[at].iter().zip(&rows.off[at]);
            for (loose, (missed, off)) in loose.iter_mut().zip(lists) {
                *loose += (missed.abs() + off.abs()) * more;
            }
        }
    }
    true
}

/// Margin of greatest accelerations, so that they are seldom raised.
const AHEAD: f64 = 1.25;
