//! Forward and back substitution with a factor of the recursion.

use pulp::NullaryFnOnce;

use super::{RiccatiFactor, RiccatiSweep};
use crate::simd;
use crate::transfer::batched_chains::Lanes;

/// Scratch memory of the substitutions; it grows to what the largest building needs.
#[derive(Clone, Debug, Default)]
pub struct RiccatiScratch {
    /// Values of links of chains between forward and back substitution.
    links: Vec<Lanes>,
    /// A load that is shorter than a register, with zeros behind it.
    padded: Vec<f64>,
}

impl RiccatiSweep {
    /// Both substitutions over the columns after the chains, for any pattern.
    fn substitute_one_by_one(&self, factor: &RiccatiFactor, load: &mut [f64]) {
        let columns = self.batched.columns()..self.mass.len();
        for column in columns.clone() {
            let entries = self.starts[column]..self.starts[column + 1];
            let value = load[column];
            let ahead = self.rows[entries.clone()].iter();
            for (row, coupling) in ahead.zip(&factor.lower[entries]) {
                load[*row as usize] -= coupling * value;
            }
            load[column] = value * factor.inverse_pivots[column];
        }
        for column in columns.rev() {
            let entries = self.starts[column]..self.starts[column + 1];
            let ahead = self.rows[entries.clone()].iter();
            let mut sum = load[column];
            // The nearest, which has only just been found, last.
            for (row, coupling) in ahead.zip(&factor.lower[entries]).rev() {
                sum -= coupling * load[*row as usize];
            }
            load[column] = sum;
        }
    }

    /// Replaces a load by the displacement it causes.
    #[inline]
    pub(super) fn substitute(
        &self,
        factor: &RiccatiFactor,
        load: &mut [f64],
        scratch: &mut RiccatiScratch,
    ) {
        let RiccatiScratch { links, padded } = scratch;
        links.resize(self.batched.links().max(links.len()), Lanes::default());
        let (order, least) = (load.len(), self.batched.least_length());
        let mut solve = |load: &mut [f64]| {
            let substitutions = Substitutions {
                sweep: self,
                factor,
                load,
                links,
            };
            simd::in_wide_registers(order, substitutions);
        };
        if order < least {
            padded.clear();
            padded.extend_from_slice(load);
            padded.resize(least, 0.0);
            solve(padded);
            load.copy_from_slice(&padded[..order]);
        } else {
            solve(load);
        }
    }

    #[cfg(test)]
    pub(super) fn substitute_in_narrow_registers(
        &self,
        factor: &RiccatiFactor,
        load: &mut [f64],
        scratch: &mut RiccatiScratch,
    ) {
        let substitutions = Substitutions {
            sweep: self,
            factor,
            load,
            links: &mut scratch.links,
        };
        substitutions.call();
    }
}

/// Both substitutions of a load, compiled for the available registers.
struct Substitutions<'a> {
    sweep: &'a RiccatiSweep,
    factor: &'a RiccatiFactor,
    load: &'a mut [f64],
    links: &'a mut [Lanes],
}

impl NullaryFnOnce for Substitutions<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self {
            sweep,
            factor,
            load,
            links,
        } = self;
        let (chains, banded) = factor.packed.split_at(sweep.batched.places().len());
        sweep.batched.forward(chains, load, links);
        match &sweep.band {
            Some(band) => {
                band.forward(banded, &factor.inverse_pivots, load);
                band.back(banded, load);
            }
            None => sweep.substitute_one_by_one(factor, load),
        }
        sweep.batched.back(chains, load, links);
    }
}
