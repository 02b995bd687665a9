//! The loops over forces of columns and beams in several steps, compiled for the widest available registers. Operations are
//! not fused or reordered between register widths, so the bits are the same on every processor.

use pulp::{Simd, WithSimd};

use super::member_reach::{BatchReach, PARTS, PartRows, low_modes};
use super::member_steps::{INSTANTS, Steps};
use super::members::{MemberRows, tests_look_always};
use super::mode_kernels::ROWS;
use super::peaks::{BEYOND, Ends};

/// Rounding of sums over modes that are taken in different ways, relative to the greatest force.
const ROUNDING: f64 = 1e-9;

/// Numbers of eight rows.
pub(super) type Rows = [f64; ROWS];
/// Values of rows while modes are at rest.
pub(super) const AT_REST: Rows = [0.0; ROWS];

/// Adds sums over modes, list by list; `terms`: rows of a block and modal values, mode by mode.
#[inline(always)]
fn add_terms<'a, S: Simd, const N: usize>(
    simd: S,
    terms: impl Iterator<Item = (&'a Rows, [f64; N])>,
    to: [&mut Rows; N],
) {
    // As many registers as a block needs at any width.
    let registers = ROWS / S::F64_LANES;
    let mut sums = [[simd.splat_f64s(0.0); ROWS]; N];
    for (sums, to) in sums.iter_mut().zip(&to) {
        let (to, _) = S::as_simd_f64s(&to[..]);
        sums[..registers].copy_from_slice(&to[..registers]);
    }
    for (shape, values) in terms {
        let (shape, _) = S::as_simd_f64s(shape);
        for (sums, value) in sums.iter_mut().zip(values) {
            let value = simd.splat_f64s(value);
            for register in 0..registers {
                let more = simd.mul_f64s(shape[register], value);
                sums[register] = simd.add_f64s(sums[register], more);
            }
        }
    }
    for (sums, to) in sums.iter().zip(to) {
        let (to, _) = S::as_mut_simd_f64s(&mut to[..]);
        to[..registers].copy_from_slice(&sums[..registers]);
    }
}

/// Adds sums of a block of rows over modes.
#[inline(always)]
pub(super) fn add_sums<S: Simd>(simd: S, block: &[Rows], modal: &[f64], to: &mut Rows) {
    let terms = block.iter().zip(modal);
    add_terms(simd, terms.map(|(shape, a)| (shape, [*a])), [to]);
}

/// Sums of a block of rows over modes.
#[inline(always)]
fn sums<S: Simd>(simd: S, block: &[Rows], modal: &[f64]) -> Rows {
    let mut sums = [0.0; ROWS];
    add_sums(simd, block, modal, &mut sums);
    sums
}

/// Adds the sums over some modes at every wanted instant, up to four instants at a time; `list` returns their modal values.
#[inline(always)]
pub(super) fn add_sums_at<'a, S: Simd>(
    simd: S,
    block: &[Rows],
    list: impl Fn(usize) -> &'a [f64],
    wanted: &[bool],
    to: &mut [Rows],
) {
    let mut at = 0;
    while let Some(first) = wanted[at..].iter().position(|wanted| *wanted) {
        at += first;
        // Zipped lists need no bounds checks.
        match (&wanted[at..], &mut to[at..]) {
            ([true, true, true, true, ..], [to_a, to_b, to_c, to_d, ..]) => {
                let [a, b, c, d] = [0, 1, 2, 3].map(|more| list(at + more));
                let terms = block.iter().zip(a).zip(b).zip(c).zip(d);
                let terms = terms.map(|((((shape, a), b), c), d)| (shape, [*a, *b, *c, *d]));
                add_terms(simd, terms, [to_a, to_b, to_c, to_d]);
                at += 4;
            }
            ([true, true, ..], [to_a, to_b, ..]) => {
                let [a, b] = [0, 1].map(|more| list(at + more));
                let terms = block.iter().zip(a).zip(b);
                let terms = terms.map(|((shape, a), b)| (shape, [*a, *b]));
                add_terms(simd, terms, [to_a, to_b]);
                at += 2;
            }
            (_, to) => {
                if let Some(to) = to.first_mut() {
                    add_sums(simd, block, list(at), to);
                }
                at += 1;
            }
        }
    }
}

#[inline(always)]
fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

#[inline(always)]
fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// Greatest and least of every row.
#[inline(always)]
pub(super) fn range_of(values: &[Rows]) -> [Rows; 2] {
    let Some((first, others)) = values.split_first() else {
        return [[0.0; ROWS]; 2];
    };
    let mut range = [*first; 2];
    for value in others {
        for row in 0..ROWS {
            range[0][row] = greater(range[0][row], value[row]);
            range[1][row] = lesser(range[1][row], value[row]);
        }
    }
    range
}

/// Greatest and least values of a block so far.
pub(super) struct Limits<'a> {
    pub(super) greatest: &'a mut Rows,
    pub(super) least: &'a mut Rows,
    /// What its values may lack.
    pub(super) loose: Rows,
}

impl Limits<'_> {
    /// What every row may still change by before it exceeds its greatest or least value.
    #[inline(always)]
    pub(super) fn slack(&self, [high, low]: [&Rows; 2]) -> Rows {
        let mut slack = [0.0; ROWS];
        for (row, slack) in slack.iter_mut().enumerate() {
            let (above, below) = (self.greatest[row] - high[row], low[row] - self.least[row]);
            let range = self.greatest[row] - self.least[row];
            *slack = lesser(above, below) - self.loose[row] - ROUNDING * range;
        }
        slack
    }

    /// Takes in values.
    #[inline(always)]
    pub(super) fn take(&mut self, values: &Rows) {
        for row in 0..ROWS {
            self.greatest[row] = greater(self.greatest[row], values[row]);
            self.least[row] = lesser(self.least[row], values[row]);
        }
    }

    /// Takes in cubics between the ends of a step.
    #[inline(always)]
    pub(super) fn widen(&mut self, [then, now]: [&Rows; 2], slopes: [&Rows; 2], step: f64) {
        for row in 0..ROWS {
            let ends = Ends {
                then: [then[row], slopes[0][row]],
                now: [now[row], slopes[1][row]],
            };
            let known = [self.greatest[row], self.least[row]];
            [self.greatest[row], self.least[row]] = ends.extremes(known, step);
        }
    }
}

/// What modes that move so far use up of the slack of every row.
#[inline(always)]
pub(super) fn uses(norms: &PartRows, parts: &[f64; PARTS]) -> Rows {
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
pub(super) fn covers(slack: &Rows, used: &Rows) -> bool {
    let mut all = true;
    for (slack, used) in slack.iter().zip(used) {
        all &= slack >= used;
    }
    all
}

/// Most that cubics with these slopes go beyond their ends.
#[inline(always)]
pub(super) fn beyond(slopes: [&Rows; 2], step: f64) -> Rows {
    let mut beyond = [0.0; ROWS];
    for (row, beyond) in beyond.iter_mut().enumerate() {
        *beyond = BEYOND * step * (slopes[0][row].abs() + slopes[1][row].abs());
    }
    beyond
}

/// Steps within which a row may exceed its greatest or least value, and the instants at their ends.
pub(super) struct Near {
    pub(super) steps: [bool; INSTANTS],
    pub(super) ends: [bool; INSTANTS],
}

impl Near {
    /// `values`: at the instants, without the part that `used` bounds.
    #[inline(always)]
    pub(super) fn find(limits: &Limits<'_>, values: &[Rows], used: &Rows) -> Self {
        let mut near = Self {
            steps: [false; INSTANTS],
            ends: [false; INSTANTS],
        };
        let is_near = |value: &Rows| !covers(&limits.slack([value; 2]), used);
        let mut before = values.first().is_some_and(is_near);
        for (step, value) in values.iter().skip(1).enumerate() {
            let now = is_near(value);
            if before | now {
                near.steps[step] = true;
                near.ends[step] = true;
                near.ends[step + 1] = true;
            }
            before = now;
        }
        near
    }

    /// All instants of a number of steps.
    pub(super) fn all(steps: usize) -> Self {
        Self {
            steps: std::array::from_fn(|step| step < steps),
            ends: std::array::from_fn(|end| end <= steps),
        }
    }
}

/// A batch of steps of the forces of one building that displacements determine.
pub(super) struct FollowOwn<'a> {
    pub(super) rows: &'a MemberRows,
    pub(super) reach: &'a BatchReach,
    pub(super) greatest: &'a mut [Rows],
    pub(super) least: &'a mut [Rows],
    pub(super) with_off: &'a mut [Rows],
    pub(super) loose: &'a [Rows],
    pub(super) steps: Steps<'a>,
}

impl WithSimd for FollowOwn<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let always = tests_look_always();
        let Self {
            rows, reach, steps, ..
        } = self;
        let (low, last) = (low_modes(steps.modes), steps.count());
        let every = [true; INSTANTS];
        for (block, norms) in rows.norms.iter().enumerate() {
            let limits = Limits {
                greatest: &mut self.greatest[block],
                least: &mut self.least[block],
                loose: self.loose[block],
            };
            if !always && covers(&limits.slack([&AT_REST; 2]), &uses(norms, &reach.size)) {
                continue;
            }
            let shapes = &rows.shapes[block * steps.modes..(block + 1) * steps.modes];
            let mut values = [[0.0; ROWS]; INSTANTS];
            let values = &mut values[..=last];
            let list = |instant| steps.list(instant, 0);
            add_sums_at(simd, &shapes[..low], list, &every[..=last], values);
            let near = if always {
                Near::all(last)
            } else {
                let used = uses(norms, &reach.of_low());
                let [high, least] = range_of(values);
                if covers(&limits.slack([&high, &least]), &used) {
                    continue;
                }
                Near::find(&limits, values, &used)
            };
            let list = |instant| &steps.list(instant, 0)[low..];
            add_sums_at(simd, &shapes[low..], list, &near.ends[..=last], values);
            let mut exact = ExactSteps {
                rows,
                block,
                steps: &steps,
                limits,
                with_off: &mut self.with_off[block],
                values,
                missed: [[0.0; ROWS]; INSTANTS],
                is_taken: [false; INSTANTS],
            };
            exact.take_ends(simd, &near, always);
            exact.take_between(simd, &near, &uses(norms, &reach.beyond), always);
        }
    }
}

/// A block of forces whose values are known at the ends of some steps.
struct ExactSteps<'a> {
    rows: &'a MemberRows,
    block: usize,
    steps: &'a Steps<'a>,
    limits: Limits<'a>,
    with_off: &'a mut Rows,
    /// By shapes, instant by instant, and what accelerations add where they were taken in.
    values: &'a [Rows],
    missed: [Rows; INSTANTS],
    is_taken: [bool; INSTANTS],
}

impl ExactSteps<'_> {
    /// Takes in what may exceed the limits at the ends of steps. The greatest and the least come first: next to them others
    /// seldom count.
    #[inline(always)]
    fn take_ends<S: Simd>(&mut self, simd: S, near: &Near, always: bool) {
        let (mut top, mut bottom) = ([f64::NEG_INFINITY; ROWS], [f64::INFINITY; ROWS]);
        for (values, is_end) in self.values.iter().zip(near.ends) {
            if is_end {
                for row in 0..ROWS {
                    top[row] = greater(top[row], values[row]);
                    bottom[row] = lesser(bottom[row], values[row]);
                }
            }
        }
        for row in 0..ROWS {
            let loose = self.limits.loose[row];
            if top[row] + loose <= self.limits.greatest[row] {
                top[row] = f64::INFINITY;
            }
            if bottom[row] - loose >= self.limits.least[row] {
                bottom[row] = f64::NEG_INFINITY;
            }
        }
        for instant in 0..self.values.len() {
            let values = &self.values[instant];
            let mut is_extreme = false;
            for row in 0..ROWS {
                is_extreme |= (values[row] >= top[row]) | (values[row] <= bottom[row]);
            }
            if near.ends[instant] && is_extreme {
                self.take(simd, instant);
            }
        }
        for instant in 0..self.values.len() {
            if !near.ends[instant] {
                continue;
            }
            let slack = self.limits.slack([&self.values[instant]; 2]);
            if always || !covers(&slack, &[0.0; ROWS]) {
                self.take(simd, instant);
            }
        }
    }

    /// Takes in an instant.
    #[inline(always)]
    fn take<S: Simd>(&mut self, simd: S, instant: usize) {
        if self.is_taken[instant] {
            return;
        }
        self.is_taken[instant] = true;
        let mut off = [0.0; ROWS];
        if !self.rows.missed.is_empty() {
            let range = self.block * self.steps.modes..(self.block + 1) * self.steps.modes;
            let accelerations = self.steps.list(instant, 2);
            self.missed[instant] = sums(simd, &self.rows.missed[range.clone()], accelerations);
            off = sums(simd, &self.rows.off[range], accelerations);
        }
        let value = self.value(instant);
        self.limits.take(&value);
        // Where the first step begins, accelerations may have jumped: the end of the step before counts.
        if instant > 0 {
            for row in 0..ROWS {
                let with_off = value[row].abs() + off[row].abs();
                self.with_off[row] = greater(self.with_off[row], with_off);
            }
        }
    }

    #[inline(always)]
    fn value(&self, instant: usize) -> Rows {
        let mut value = self.values[instant];
        for (value, missed) in value.iter_mut().zip(&self.missed[instant]) {
            *value += missed;
        }
        value
    }

    /// Takes in what exceeds the limits within steps; `most`: most that any step goes beyond its ends.
    #[inline(always)]
    fn take_between<S: Simd>(&mut self, simd: S, near: &Near, most: &Rows, always: bool) {
        let shapes =
            &self.rows.shapes[self.block * self.steps.modes..(self.block + 1) * self.steps.modes];
        let mut wanted = [false; INSTANTS];
        let mut steps = [false; INSTANTS];
        for step in 0..self.steps.count() {
            if near.steps[step] && (always || !covers(&self.slack_in(step), most)) {
                steps[step] = true;
                wanted[step] = true;
                wanted[step + 1] = true;
            }
        }
        let mut rates = [[0.0; ROWS]; INSTANTS];
        let all = ..=self.steps.count();
        let list = |instant| self.steps.list(instant, 1);
        add_sums_at(simd, shapes, list, &wanted[all], &mut rates[all]);
        for (step, length) in self.steps.lengths.iter().enumerate() {
            let slopes = [&rates[step], &rates[step + 1]];
            let is_near = || always || !covers(&self.slack_in(step), &beyond(slopes, *length));
            if steps[step] && is_near() {
                self.take(simd, step);
                self.take(simd, step + 1);
                let ends = [step, step + 1].map(|end| self.value(end));
                self.limits.widen(ends.each_ref(), slopes, *length);
            }
        }
    }

    /// What rows may still go beyond the ends of a step.
    #[inline(always)]
    fn slack_in(&self, step: usize) -> Rows {
        let [high, least] = range_of(&self.values[step..step + 2]);
        self.limits.slack([&high, &least])
    }
}

/// What accelerations up to these may add to the rows of one building, with what may be off.
pub(super) fn set_loose(rows: &MemberRows, accelerations: &[f64], loose: &mut [Rows]) {
    let blocks = rows.missed.chunks(accelerations.len().max(1));
    let blocks = blocks.zip(rows.off.chunks(accelerations.len().max(1)));
    for (loose, (missed, off)) in loose.iter_mut().zip(blocks) {
        *loose = [0.0; ROWS];
        for ((missed, off), a) in missed.iter().zip(off).zip(accelerations) {
            for (row, loose) in loose.iter_mut().enumerate() {
                *loose += (missed[row].abs() + off[row].abs()) * a;
            }
        }
    }
}
