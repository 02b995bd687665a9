//! The recursion of K + s²M for several rates s at once, one lane each.

use pulp::NullaryFnOnce;

use super::{RiccatiFactor, RiccatiSweep};
use crate::linear::{NotPositive, StepMatrix};
use crate::simd::in_wide_registers;

/// Rates processed at once.
pub(crate) const RATES: usize = 8;

/// One value for every rate.
pub(crate) type PerRate = [f64; RATES];

/// Entries of L and pivots of K + s²M for [`RATES`] rates.
#[derive(Clone, Debug)]
pub(crate) struct RateFactors {
    lower: Vec<PerRate>,
    inverse_pivots: Vec<PerRate>,
}

impl RateFactors {
    /// The factor of a single rate in all lanes, for several loads at once.
    pub(crate) fn only(&self, rate: usize) -> Self {
        let of = |list: &[PerRate]| list.iter().map(|values| [values[rate]; RATES]).collect();
        Self {
            lower: of(&self.lower),
            inverse_pivots: of(&self.inverse_pivots),
        }
    }
}

impl RiccatiSweep {
    /// Factorises K + s²M at all rates s ≥ 0 \[1/s\]; springs that yield have their initial stiffness.
    ///
    /// # Errors
    /// [`NotPositive`] if one of them is not positive definite.
    pub(crate) fn factorize_at(&self, rates: &PerRate) -> Result<RateFactors, NotPositive> {
        let mut static_matrix = RiccatiFactor::default();
        let tangents = &self.initial_tangents;
        self.compose(&StepMatrix::STATIC, tangents, &mut static_matrix);
        let mut factors = RateFactors {
            lower: vec![[0.0; RATES]; self.rows.len()],
            inverse_pivots: vec![[0.0; RATES]; self.mass.len()],
        };
        let eliminate = Eliminate {
            sweep: self,
            squares: rates.map(|rate| rate * rate),
            diagonal: &static_matrix.diagonal,
            before: &static_matrix.before,
            factors: &mut factors,
        };
        in_wide_registers(RATES * self.mass.len(), eliminate)?;
        Ok(factors)
    }

    /// Replaces loads by the displacements they cause, at every rate.
    pub(crate) fn solve_at(&self, factors: &RateFactors, loads: &mut [PerRate]) {
        let substitutions = RateSubstitutions {
            sweep: self,
            factors,
            loads,
        };
        in_wide_registers(RATES * self.mass.len(), substitutions);
    }
}

/// L D Lᵀ, row by row.
struct Eliminate<'a> {
    sweep: &'a RiccatiSweep,
    squares: PerRate,
    /// K.
    diagonal: &'a [f64],
    before: &'a [f64],
    factors: &'a mut RateFactors,
}

impl NullaryFnOnce for Eliminate<'_> {
    type Output = Result<(), NotPositive>;

    #[inline(always)]
    fn call(self) -> Result<(), NotPositive> {
        let Self {
            sweep,
            squares,
            diagonal,
            before,
            factors,
        } = self;
        let RateFactors {
            lower,
            inverse_pivots,
        } = factors;
        let mut work = vec![[0.0; RATES]; diagonal.len()];
        for (row, stiffness) in diagonal.iter().enumerate() {
            let entries = sweep.before_starts[row]..sweep.before_starts[row + 1];
            for ((column, _), value) in sweep.before[entries.clone()].iter().zip(&before[entries]) {
                work[*column as usize] = [*value; RATES];
            }
            let diagonals = squares.map(|square| stiffness + square * sweep.mass[row]);
            let mut pivots = diagonals;
            let reached = sweep.reached_starts[row]..sweep.reached_starts[row + 1];
            let columns = sweep.reached[reached.clone()].iter();
            for (&column, &position) in columns.zip(&sweep.positions[reached]) {
                let (column, position) = (column as usize, position as usize);
                let values = std::mem::replace(&mut work[column], [0.0; RATES]);
                let known = sweep.starts[column]..position;
                for (&below, coupling) in sweep.rows[known.clone()].iter().zip(&lower[known]) {
                    subtract(&mut work[below as usize], coupling, &values);
                }
                let inverse = &inverse_pivots[column];
                let mut coupling = values;
                for rate in 0..RATES {
                    coupling[rate] *= inverse[rate];
                }
                subtract(&mut pivots, &coupling, &values);
                lower[position] = coupling;
            }
            let unsound = |rate: usize| super::sound(row, diagonals[rate], pivots[rate]).err();
            if let Some(failure) = (0..RATES).find_map(unsound) {
                return Err(failure);
            }
            inverse_pivots[row] = pivots.map(|pivot| 1.0 / pivot);
        }
        Ok(())
    }
}

/// Both substitutions of loads.
struct RateSubstitutions<'a> {
    sweep: &'a RiccatiSweep,
    factors: &'a RateFactors,
    loads: &'a mut [PerRate],
}

impl NullaryFnOnce for RateSubstitutions<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self {
            sweep,
            factors,
            loads,
        } = self;
        let columns = sweep.starts.windows(2).map(|bounds| bounds[0]..bounds[1]);
        // A force on one side has no effect on earlier rows.
        let pushed = |values: &PerRate| values.iter().any(|value| *value != 0.0);
        let first = loads.iter().position(pushed).unwrap_or(loads.len());
        for (column, entries) in columns.clone().enumerate().skip(first) {
            let passed = loads[column];
            let ahead = sweep.rows[entries.clone()].iter();
            for (row, coupling) in ahead.zip(&factors.lower[entries]) {
                subtract(&mut loads[*row as usize], coupling, &passed);
            }
        }
        let pivots = factors.inverse_pivots.iter();
        for ((column, entries), pivots) in columns.enumerate().zip(pivots).rev() {
            let mut sums = loads[column];
            for (sum, pivot) in sums.iter_mut().zip(pivots) {
                *sum *= pivot;
            }
            let ahead = sweep.rows[entries.clone()].iter();
            for (row, coupling) in ahead.zip(&factors.lower[entries]) {
                subtract(&mut sums, coupling, &loads[*row as usize]);
            }
            loads[column] = sums;
        }
    }
}

#[inline(always)]
fn subtract(from: &mut PerRate, a: &PerRate, b: &PerRate) {
    for rate in 0..RATES {
        from[rate] -= a[rate] * b[rate];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::StepEquations;
    use crate::structure::testkit::frame;

    /// Every lane is the recursion of its own rate, also if a single rate is copied to all lanes.
    #[test]
    fn lanes_are_rates_of_their_own() {
        let building = frame(true);
        let sweep = RiccatiSweep::new(&building);
        let rates = [0.0, 1.0, 7.0, 40.0, 90.0, 400.0, 3e3, 1e5];
        let factors = sweep.factorize_at(&rates).expect("a standing frame");
        let load = |lane: usize, dof: usize| (0.7 * dof as f64 + lane as f64).sin();
        let loads: Vec<PerRate> = (0..building.equations.len())
            .map(|dof| std::array::from_fn(|lane| load(lane, dof)))
            .collect();
        let mut of_all = loads.clone();
        sweep.solve_at(&factors, &mut of_all);
        let mut of_one = loads.clone();
        sweep.solve_at(&factors.only(3), &mut of_one);
        for (lane, lane_rate) in rates.into_iter().enumerate() {
            for (rate, answers) in [(lane_rate, &of_all), (rates[3], &of_one)] {
                let mut factor = RiccatiFactor::default();
                let matrix = StepMatrix::new(1.0, rate * rate);
                let tangents = building.equations.initial_tangents();
                sweep
                    .factorize(&matrix, &tangents, &mut factor)
                    .expect("a standing frame");
                let mut alone: Vec<f64> = loads.iter().map(|values| values[lane]).collect();
                sweep.solve(&factor, &mut alone, &mut Default::default());
                let most = alone.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
                for (answer, alone) in answers.iter().zip(&alone) {
                    assert!((answer[lane] - alone).abs() <= 1e-11 * most, "s = {rate}");
                }
            }
        }
    }
}
