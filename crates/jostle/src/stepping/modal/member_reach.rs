//! How far modes can have carried the forces of columns and beams since they were last computed.
//!
//! A force is F = Σ s q over modes. By Cauchy's inequality it changes by no more than ‖s/ω‖ ‖ω Δq‖ over any set of modes.
//! The lowest modes are taken in groups, for which the way since the last computation counts. Of all others, which are many
//! and fast, the size at the instant counts. Within a step, a cubic leaves the range of its ends by no more than
//! [`BEYOND`] times the step and the sum of its end slopes.

use std::ops::Range;

use pulp::{Arch, NullaryFnOnce};

use super::mode_kernels::ROWS;
use super::peaks::BEYOND;

/// Groups of low modes.
pub(super) const GROUPS: usize = 3;
/// Ends of these groups; together they fill one list of lanes.
const ENDS: [usize; GROUPS] = [1, 3, ROWS];
/// Parts of a bound: those groups, and the rest.
pub(super) const PARTS: usize = GROUPS + 1;

/// Modes of every part.
pub(super) fn parts(modes: usize) -> [Range<usize>; PARTS] {
    std::array::from_fn(|part| {
        let start = if part == 0 { 0 } else { ENDS[part - 1] };
        let end = ENDS.get(part).copied().unwrap_or(modes);
        start.min(modes)..end.min(modes)
    })
}

/// Number of modes in groups.
pub(super) fn low_modes(modes: usize) -> usize {
    ENDS[GROUPS - 1].min(modes)
}

/// ‖s/ω‖ of a row, part by part.
pub(super) fn norms(row: &[f64], stiffness: &[f64]) -> [f64; PARTS] {
    parts(row.len()).map(|part| {
        let squares = row[part.clone()].iter().zip(&stiffness[part]);
        squares.map(|(s, k)| s * s / k).sum::<f64>().sqrt()
    })
}

/// Numbers of eight rows, part by part.
pub(super) type PartRows = [[f64; ROWS]; PARTS];

/// Norms of rows in blocks of eight; padding rows are zero.
pub(super) fn norms_in_blocks<'a>(
    rows: impl Iterator<Item = &'a Vec<f64>>,
    stiffness: &[f64],
) -> Vec<PartRows> {
    let mut blocks: Vec<PartRows> = Vec::new();
    for (index, row) in rows.enumerate() {
        if index % ROWS == 0 {
            blocks.push([[0.0; ROWS]; PARTS]);
        }
        if let Some(block) = blocks.last_mut() {
            for (part, norm) in block.iter_mut().zip(norms(row, stiffness)) {
                part[index % ROWS] = norm;
            }
        }
    }
    blocks
}

/// What the modes of a building have done in a step and before.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Reach {
    /// Number of modes in groups.
    pub(super) low: usize,
    /// Way of every group so far: Σ ‖ω Δq‖.
    pub(super) way: [f64; GROUPS],
    /// ‖ω Δq‖ over the step, and what a cubic may add within, part by part.
    pub(super) moved: [f64; PARTS],
    pub(super) beyond: [f64; PARTS],
    /// Most that every part reaches within the step: ‖ω q‖.
    pub(super) size: [f64; PARTS],
    /// ‖ω q̇‖ and ‖ω q̈‖ at the end of the step, part by part.
    pub(super) rate: [f64; PARTS],
    pub(super) quickening: [f64; PARTS],
    /// The same of q̇ at its start.
    pub(super) rate_before: [f64; PARTS],
    /// What a cubic of velocities may add within.
    pub(super) beyond_rates: [f64; PARTS],
    size_before: [f64; PARTS],
    quickening_before: [f64; PARTS],
}

impl Reach {
    /// Of a building with so many modes, at rest.
    pub(super) fn new(modes: usize) -> Self {
        Self {
            low: low_modes(modes),
            ..Self::default()
        }
    }

    /// Adds a step; lists are displacements, velocities and accelerations.
    pub(super) fn add(
        &mut self,
        arch: Arch,
        stiffness: &[f64],
        now: [&[f64]; 3],
        then: &[f64],
        step: f64,
    ) {
        self.rate_before = self.rate;
        self.quickening_before = self.quickening;
        let norms = arch.dispatch(Norms {
            stiffness,
            now,
            then,
        });
        let [moved, rate, quickening, size] = norms;
        (self.moved, self.rate, self.quickening) = (moved, rate, quickening);
        for part in 0..PARTS {
            self.beyond[part] = BEYOND * step * (self.rate[part] + self.rate_before[part]);
            self.beyond_rates[part] =
                BEYOND * step * (self.quickening[part] + self.quickening_before[part]);
            self.size[part] = size[part].max(self.size_before[part]) + self.beyond[part];
        }
        self.size_before = size;
        for (way, moved) in self.way.iter_mut().zip(&self.moved) {
            *way += moved;
        }
    }

    /// Replaces velocities and accelerations at the end of the last step.
    pub(super) fn restart(&mut self, arch: Arch, stiffness: &[f64], jumped: [&[f64]; 2]) {
        let [rate, quickening] = jumped;
        let norms = arch.dispatch(Norms {
            stiffness,
            now: [rate, rate, quickening],
            then: rate,
        });
        let [_, rate, quickening, _] = norms;
        (self.rate, self.quickening) = (rate, quickening);
    }
}

/// The most that the modes of a building do within some steps, part by part.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct BatchReach {
    /// ‖ω q‖, and what cubics may add to the ends of a step.
    pub(super) size: [f64; PARTS],
    pub(super) beyond: [f64; PARTS],
    /// The same of velocities.
    pub(super) rates: [f64; PARTS],
    pub(super) beyond_rates: [f64; PARTS],
}

impl BatchReach {
    /// Adds a step.
    pub(super) fn add(&mut self, step: &Reach) {
        for part in 0..PARTS {
            let rate = step.rate[part].max(step.rate_before[part]) + step.beyond_rates[part];
            self.size[part] = self.size[part].max(step.size[part]);
            self.beyond[part] = self.beyond[part].max(step.beyond[part]);
            self.rates[part] = self.rates[part].max(rate);
            self.beyond_rates[part] = self.beyond_rates[part].max(step.beyond_rates[part]);
        }
    }

    /// How far low modes go beyond the ends of a step, and how far all others are from rest.
    #[inline(always)]
    pub(super) fn of_low(&self) -> [f64; PARTS] {
        let mut parts = self.beyond;
        parts[GROUPS] = self.size[GROUPS];
        parts
    }
}

/// ‖ω Δq‖, ‖ω q̇‖, ‖ω q̈‖ and ‖ω q‖ of every part.
struct Norms<'a> {
    stiffness: &'a [f64],
    now: [&'a [f64]; 3],
    then: &'a [f64],
}

/// Sums of squares over a chunk of modes, lane by lane: k Δq², k q̇², k q̈² and k q².
#[inline(always)]
fn squares(k: &[f64], lists: [&[f64]; 4], lanes: &mut [[f64; ROWS]; 4]) {
    let [q, then, v, a] = lists;
    for (lane, k) in k.iter().enumerate() {
        let change = q[lane] - then[lane];
        lanes[0][lane] += k * change * change;
        lanes[1][lane] += k * v[lane] * v[lane];
        lanes[2][lane] += k * a[lane] * a[lane];
        lanes[3][lane] += k * q[lane] * q[lane];
    }
}

impl NullaryFnOnce for Norms<'_> {
    type Output = [[f64; PARTS]; 4];

    #[inline(always)]
    fn call(self) -> Self::Output {
        let n = self.stiffness.len();
        let [q, v, a] = self.now.map(|list| &list[..n]);
        let (stiffness, then) = (&self.stiffness[..n], &self.then[..n]);
        let low = low_modes(n);
        let part = |range: Range<usize>| [q, then, v, a].map(|list| &list[range.clone()]);
        let (mut grouped, mut rest) = ([[0.0; ROWS]; 4], [[0.0; ROWS]; 4]);
        squares(&stiffness[..low], part(0..low), &mut grouped);
        let whole = low + (n - low) / ROWS * ROWS;
        for first in (low..whole).step_by(ROWS) {
            let range = first..first + ROWS;
            squares(&stiffness[range.clone()], part(range), &mut rest);
        }
        squares(&stiffness[whole..], part(whole..n), &mut rest);
        let mut norms = [[0.0; PARTS]; 4];
        for (sums, (grouped, rest)) in norms.iter_mut().zip(grouped.iter().zip(&rest)) {
            let mut start = 0;
            for (sum, end) in sums.iter_mut().zip(ENDS) {
                *sum = grouped[start..end].iter().sum();
                start = end;
            }
            sums[GROUPS] = rest.iter().sum();
            for sum in sums {
                *sum = sum.sqrt();
            }
        }
        norms
    }
}

/// When a block of forces has to be computed again.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlockWatch {
    /// Share of its slack that every part uses up per unit.
    per: [f64; PARTS],
    /// That of the ways when it was computed; −∞ if it is due in any case.
    base: f64,
}

impl BlockWatch {
    pub(super) const DUE: Self = Self {
        per: [0.0; PARTS],
        base: f64::NEG_INFINITY,
    };

    /// Whether a force of the block may exceed its greatest or least value within the step; `more`: what besides modal
    /// displacements uses up the slack.
    #[inline(always)]
    pub(super) fn is_due(&self, reach: &Reach, more: f64) -> bool {
        let mut used = self.per[GROUPS] * reach.size[GROUPS] + more - self.base;
        for part in 0..GROUPS {
            used += self.per[part] * (reach.way[part] + reach.beyond[part]);
        }
        used >= 1.0
    }

    /// After rows had these slacks with their low modes alone; `norms`: change of every row per ‖ω Δq‖.
    #[inline(always)]
    pub(super) fn set(&mut self, reach: &Reach, norms: &PartRows, slack: &[f64; ROWS]) {
        *self = Self::DUE;
        let mut per = [0.0_f64; PARTS];
        for row in 0..ROWS {
            if norms.iter().all(|part| part[row] == 0.0) {
                continue;
            }
            if slack[row] <= 0.0 {
                return;
            }
            for (per, norms) in per.iter_mut().zip(norms) {
                *per = per.max(norms[row] / slack[row]);
            }
        }
        let base = per.iter().zip(&reach.way).map(|(per, way)| per * way).sum();
        *self = Self { per, base };
    }
}
