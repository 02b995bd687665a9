//! Forward and back substitution along one group of chains.

use super::{LANES, Lanes};

/// One group in a substitution.
pub(super) struct ChainSubstitution<'a> {
    pub(super) chains: usize,
    /// First of its columns at every link.
    pub(super) firsts: &'a [u32],
    /// Rows of its far and near ends, chain by chain.
    pub(super) far: &'a [[u32; LANES]],
    pub(super) near: &'a [[u32; LANES]],
    /// A block for every link: inverse pivots, entries of L to the links behind, farthest first, and to the near ends.
    pub(super) entries: &'a [Lanes],
    /// Values of links between forward and back substitution.
    pub(super) scratch: &'a mut [Lanes],
}

impl ChainSubstitution<'_> {
    #[inline(always)]
    pub(super) fn substitute<const BAND: usize, const NEAR: usize, const FORWARD: bool>(
        self,
        load: &mut [f64],
    ) {
        if FORWARD {
            self.forward::<BAND, NEAR>(load);
        } else {
            self.back::<BAND, NEAR>(load);
        }
    }

    #[inline(always)]
    fn forward<const BAND: usize, const NEAR: usize>(self, load: &mut [f64]) {
        let mut registers = Registers::<BAND, NEAR>::zero();
        let mut blocks = self.entries.chunks_exact(1 + BAND + NEAR);
        let (columns, ends) = self.scratch.split_at_mut(self.firsts.len());
        for ((scratch, first), block) in columns.iter_mut().zip(self.firsts).zip(&mut blocks) {
            *scratch = registers.forward(block, at(load, *first));
        }
        for ((scratch, rows), block) in ends.iter_mut().zip(self.far).zip(blocks) {
            *scratch = registers.forward(block, [0.0; LANES]);
            add(load, rows, scratch, self.chains);
        }
        for (sum, rows) in registers.near.iter().zip(self.near) {
            add(load, rows, sum, self.chains);
        }
    }

    #[inline(always)]
    fn back<const BAND: usize, const NEAR: usize>(self, load: &mut [f64]) {
        let mut registers = Registers::<BAND, NEAR>::zero();
        for (values, rows) in registers.near.iter_mut().zip(self.near) {
            *values = rows.map(|row| load[row as usize]);
        }
        let columns = self.firsts.len() * (1 + BAND + NEAR);
        let (columns, ends) = self.entries.split_at(columns);
        let ends = ends.chunks_exact(1 + BAND + NEAR);
        for (rows, block) in self.far.iter().zip(ends).rev() {
            registers.back(block, rows.map(|row| load[row as usize]));
        }
        let blocks = columns.chunks_exact(1 + BAND + NEAR);
        for ((scratch, first), block) in self.scratch.iter().zip(self.firsts).zip(blocks).rev() {
            let found = registers.back(block, *scratch);
            put(load, *first, &found, self.chains);
        }
    }
}

/// Registers of a substitution.
struct Registers<const BAND: usize, const NEAR: usize> {
    /// Values of the links behind, nearest last: results in forward substitution, partial sums in back
    /// substitution.
    behind: [Lanes; BAND],
    /// Values of the near ends: partial sums in forward substitution, solutions in back substitution.
    near: [Lanes; NEAR],
}

impl<const BAND: usize, const NEAR: usize> Registers<BAND, NEAR> {
    fn zero() -> Self {
        Self {
            behind: [[0.0; LANES]; BAND],
            near: [[0.0; LANES]; NEAR],
        }
    }

    /// Processes the load of the next link and returns its value divided by the pivot.
    #[inline(always)]
    fn forward(&mut self, block: &[Lanes], load: Lanes) -> Lanes {
        let mut sum = load;
        for k in 0..BAND {
            subtract(&mut sum, &block[1 + k], &self.behind[k]);
        }
        for end in 0..NEAR {
            subtract(&mut self.near[end], &block[1 + BAND + end], &sum);
        }
        for k in 1..BAND {
            self.behind[k - 1] = self.behind[k];
        }
        self.behind[BAND - 1] = sum;
        for lane in 0..LANES {
            sum[lane] *= block[0][lane];
        }
        sum
    }

    /// Processes the value of the next link and returns its solution.
    #[inline(always)]
    fn back(&mut self, block: &[Lanes], scratch: Lanes) -> Lanes {
        let mut sum = scratch;
        for end in 0..NEAR {
            subtract(&mut sum, &block[1 + BAND + end], &self.near[end]);
        }
        for lane in 0..LANES {
            sum[lane] += self.behind[BAND - 1][lane];
        }
        for k in (1..BAND).rev() {
            self.behind[k] = self.behind[k - 1];
            subtract(&mut self.behind[k], &block[1 + k], &sum);
        }
        self.behind[0] = [0.0; LANES];
        subtract(&mut self.behind[0], &block[1], &sum);
        sum
    }
}

/// A register of a list from an index on.
#[inline(always)]
fn at(list: &[f64], first: u32) -> Lanes {
    let mut values = [0.0; LANES];
    let first = first as usize;
    values.copy_from_slice(&list[first..first + LANES]);
    values
}

/// Writes one value per chain to a list, from an index on.
#[inline(always)]
fn put(list: &mut [f64], first: u32, values: &Lanes, chains: usize) {
    let first = first as usize;
    let lanes = &mut list[first..first + LANES];
    if chains == LANES {
        lanes.copy_from_slice(values);
    } else {
        for lane in 0..LANES {
            lanes[lane] = if lane < chains {
                values[lane]
            } else {
                lanes[lane]
            };
        }
    }
}

/// Adds one value per chain to a list.
#[inline(always)]
fn add(list: &mut [f64], rows: &[u32; LANES], values: &Lanes, chains: usize) {
    for (row, value) in rows.iter().zip(values).take(chains) {
        list[*row as usize] += value;
    }
}

#[inline(always)]
fn subtract(from: &mut Lanes, a: &Lanes, b: &Lanes) {
    for lane in 0..LANES {
        from[lane] -= a[lane] * b[lane];
    }
}
