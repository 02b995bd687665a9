//! Modes by dividing the spectrum: counting isolates them, inverse iteration finds their shapes.

use super::spectrum::{Spectrum, number_of_modes};
use super::{Mode, inner, modes_dense, symmetric};
use crate::linear::NotPositive;
use crate::linear::sort_by;
use crate::simd::add;
use crate::structure::AssembledBuilding;
use crate::structure::StepEquations;
use crate::transfer::riccati::RiccatiScratch;

/// An interval this narrow, relative to ω², counts as one cluster.
const CLUSTER: f64 = 1e-6;
/// An interval this narrow cannot be divided further.
const NARROWEST: f64 = 4e-14;
/// Inverse iteration for a single mode starts if the ends of its interval differ by no more than this ratio.
const CLOSE: f64 = 1.25;
/// Modes within this fraction of ω² of each other are orthogonalised explicitly.
const NEIGHBOURS: f64 = 1e-2;
/// Relative change of a shape at which iteration ends.
const CONVERGED: f64 = 1e-12;
/// Shapes whose ω² differ by no more than this fraction may be rotated.
const EQUAL: f64 = 1e-10;

/// The lowest modes of a building, at most `count`, longest period first.
///
/// Counting negative pivots (theory, Eq. M3) gives the number of modes in an interval of the spectrum. Intervals
/// are divided until each holds a single mode or a cluster of practically equal modes, and inverse iteration in the
/// interval gives shapes and frequencies. A result outside its interval is rejected, and the interval is divided
/// again. So every mode is found, multiple ones as often as they occur. The cost of a mode is a few factorisations,
/// each proportional to the height of the building.
///
/// For equal frequencies the first shape has all of the horizontal mass.
///
/// # Errors
/// [`NotPositive`] when the building can move without deforming.
pub fn modes(building: &AssembledBuilding, count: usize) -> Result<Vec<Mode>, NotPositive> {
    // Pivots are those of the building without links between its floors.
    if building.inner_links.iter().any(|link| link.stiffness > 0.0) {
        let mut modes = modes_dense(building, |lower| {
            let (values, vectors) = symmetric::eigen(lower);
            Some(values.into_iter().zip(vectors).collect())
        })?;
        modes.truncate(count);
        return Ok(modes);
    }
    let mut search = Search {
        mass: &building.equations.mass,
        spectrum: Spectrum::new(building)?,
        found: Vec::new(),
        random: 0x9e37_79b9_7f4a_7c15,
    };
    search.lowest(building, count);
    let mut found = search.polished();
    turn_equal_ones(&mut found, &building.equations.driven_mass);
    found.truncate(count);
    Ok(found
        .into_iter()
        .map(|found| Mode::new(building, found.value, found.shape))
        .collect())
}

struct Search<'a> {
    mass: &'a [f64],
    spectrum: Spectrum,
    found: Vec<Found>,
    random: u64,
}

/// ω² and the mass-normalised shape of a mode.
struct Found {
    value: f64,
    shape: Vec<f64>,
}

/// An end of an interval: ω² and the number of modes below it.
type End = (f64, usize);

impl Search<'_> {
    fn lowest(&mut self, building: &AssembledBuilding, count: usize) {
        let wanted = count.min(number_of_modes(building));
        if wanted == 0 {
            return;
        }
        // With all others restrained, a degree of freedom has a frequency not below the first mode.
        let equations = &building.equations;
        let mut held: Vec<f64> = equations.stiffness.diagonal.clone();
        for (held, undamped) in held.iter_mut().zip(&equations.undamped.diagonal) {
            *held += undamped;
        }
        for spring in &equations.springs {
            for (dof, share) in spring.row.entries() {
                held[*dof] += share * share * spring.hysteresis.initial_tangent();
            }
        }
        let slowest = self
            .mass
            .iter()
            .zip(&held)
            .filter(|(mass, _)| **mass > 0.0)
            .map(|(mass, held)| held / mass)
            .fold(f64::INFINITY, f64::min);
        let (mut low, mut at) = ((0.0, 0), 2.0 * slowest);
        while self.found.len() < wanted && at.is_finite() {
            let high = self
                .spectrum
                .count_at_best((0..5).map(|k| at * (1.0 + 0.01 * f64::from(k))));
            self.search(low, high, wanted);
            (low, at) = (high, 4.0 * high.0);
        }
    }

    /// Finds the modes between two ends, from the lowest up, until enough are known.
    fn search(&mut self, low: End, high: End, wanted: usize) {
        let mut slices = vec![(low, high)];
        while let Some((low, high)) = slices.pop() {
            let held = high.1.saturating_sub(low.1);
            if held == 0 || self.found.len() >= wanted {
                continue;
            }
            let width = high.0 - low.0;
            let narrow = if held == 1 {
                high.0 <= CLOSE * low.0
            } else {
                width <= CLUSTER * high.0
            };
            let last = width <= NARROWEST * high.0;
            if (narrow || last) && self.iterate(low.0, high.0, held, last) {
                continue;
            }
            let middle = self.divide(low, high);
            slices.push((middle, high));
            slices.push((low, middle));
        }
    }

    /// A shift between two ends at which the count is reliable.
    fn divide(&mut self, low: End, high: End) -> End {
        let at = |part: f64| {
            if low.0 == 0.0 {
                high.0 * part * 0.1
            } else if high.0 > 2.0 * low.0 {
                low.0 * libm::pow(high.0 / low.0, part)
            } else {
                low.0 + part * (high.0 - low.0)
            }
        };
        let parts = [0.5, 0.46, 0.54, 0.42, 0.58, 0.38, 0.62];
        let (value, count) = self.spectrum.count_at_best(parts.into_iter().map(at));
        (value, count.clamp(low.1, high.1))
    }

    /// Inverse iteration for the modes of one interval; false if it does not end inside, unless it is the `last`
    /// resort.
    fn iterate(&mut self, low: f64, high: f64, held: usize, last: bool) -> bool {
        let mut shift = 0.5 * (low + high);
        let mut shapes: Vec<Vec<f64>> = (0..held).map(|_| self.random_shape()).collect();
        let neighbours = self
            .found
            .partition_point(|found| found.value < (1.0 - NEIGHBOURS) * low);
        self.orthonormalise(neighbours, &mut shapes);
        self.spectrum.factorize(shift);
        let (mut values, mut previous) = (vec![shift; held], f64::INFINITY);
        let slack = if last { high } else { 1e-13 * high };
        for round in 0..16 {
            let mut images: Vec<Vec<f64>> = shapes.iter().map(|shape| self.solve(shape)).collect();
            let inverses;
            (inverses, shapes, images) = self.rotate(&shapes, &images);
            values = inverses
                .iter()
                .map(|inverse| shift + 1.0 / inverse)
                .collect();
            let change = (0..held)
                .map(|k| self.distance(&images[k], inverses[k], &shapes[k]) / inverses[k].abs())
                .fold(0.0, f64::max);
            shapes = images;
            self.orthonormalise(neighbours, &mut shapes);
            if change <= CONVERGED || (change <= 1e-9 && change > 0.2 * previous) {
                previous = 0.0;
                break;
            }
            let astray = values
                .iter()
                .any(|value| !(low - slack..=high + slack).contains(value));
            if !last && ((round > 0 && astray) || (round > 4 && change > 0.3 * previous)) {
                return false;
            }
            previous = change;
            if held == 1 && round > 0 && !astray {
                shift = values[0];
                self.spectrum.factorize(shift);
            }
        }
        let inside = values
            .iter()
            .all(|value| (low - slack..=high + slack).contains(value));
        if !last && (!inside || previous > 0.0) {
            return false;
        }
        let mut modes: Vec<Found> = values
            .into_iter()
            .zip(shapes)
            .map(|(value, shape)| Found { value, shape })
            .collect();
        sort_by(&mut modes, |a, b| a.value.total_cmp(&b.value));
        self.found.extend(modes);
        true
    }

    /// (K − σM)⁻¹ M φ.
    fn solve(&self, shape: &[f64]) -> Vec<f64> {
        let mut load: Vec<f64> = self.mass.iter().zip(shape).map(|(m, s)| m * s).collect();
        let spectrum = &self.spectrum;
        let scratch = &mut RiccatiScratch::default();
        spectrum.sweep.solve(&spectrum.factor, &mut load, scratch);
        load
    }

    /// Eigenvalues of (K − σM)⁻¹M in the space of the shapes, and shapes and images rotated to its eigenvectors.
    fn rotate(
        &self,
        shapes: &[Vec<f64>],
        images: &[Vec<f64>],
    ) -> (Vec<f64>, Vec<Vec<f64>>, Vec<Vec<f64>>) {
        let n = shapes.len();
        let projected = |i: usize, j: usize| {
            0.5 * (inner(self.mass, &shapes[i], &images[j])
                + inner(self.mass, &shapes[j], &images[i]))
        };
        let lower: Vec<Vec<f64>> = (0..n)
            .map(|i| (0..=i).map(|j| projected(i, j)).collect())
            .collect();
        // Values that are not finite stay so and are rejected.
        let (values, parts) = symmetric::eigen(&lower);
        let turned = |vectors: &[Vec<f64>]| {
            let turn = |k: usize| {
                let mut sum = vec![0.0; self.mass.len()];
                for (vector, part) in vectors.iter().zip(&parts[k]) {
                    add(&mut sum, *part, vector);
                }
                sum
            };
            (0..n).map(turn).collect()
        };
        (values, turned(shapes), turned(images))
    }

    /// Makes shapes orthonormal, to each other and to the modes found from `neighbours` on; twice, to be exact to
    /// rounding.
    fn orthonormalise(&self, neighbours: usize, shapes: &mut [Vec<f64>]) {
        for k in 0..shapes.len() {
            let (before, rest) = shapes.split_at_mut(k);
            let shape = &mut rest[0];
            for _ in 0..2 {
                let known = self.found[neighbours..].iter().map(|found| &found.shape);
                for other in known.chain(before.iter()) {
                    let part = inner(self.mass, other, shape);
                    add(shape, -part, other);
                }
                let norm = inner(self.mass, shape, shape).sqrt();
                for value in shape.iter_mut() {
                    *value /= norm;
                }
            }
        }
    }

    /// |a − f b| in the norm of the mass.
    fn distance(&self, a: &[f64], factor: f64, b: &[f64]) -> f64 {
        let squares = self.mass.iter().zip(a).zip(b);
        squares
            .map(|((m, a), b)| m * (a - factor * b).powi(2))
            .sum::<f64>()
            .sqrt()
    }

    /// Deterministic pseudo-random numbers (xorshift).
    fn random_shape(&mut self) -> Vec<f64> {
        let draw = |_: &f64| {
            self.random ^= self.random << 13;
            self.random ^= self.random >> 7;
            self.random ^= self.random << 17;
            (self.random >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        self.mass.iter().map(draw).collect()
    }

    /// All modes found, with ω² recomputed from the flexibility: 1/ω² = φᵀM K⁻¹ Mφ is of second order in the error
    /// of a shape, and K, being positive definite, loses least to rounding.
    fn polished(mut self) -> Vec<Found> {
        self.spectrum.factorize(0.0);
        for k in 0..self.found.len() {
            let deflection = self.solve(&self.found[k].shape);
            self.found[k].value = 1.0 / inner(self.mass, &self.found[k].shape, &deflection);
        }
        sort_by(&mut self.found, |a, b| a.value.total_cmp(&b.value));
        self.found
    }
}

/// Rotates shapes of equal frequency so that the first has all of their horizontal participation.
fn turn_equal_ones(found: &mut [Found], driven_mass: &[f64]) {
    for group in found.chunk_by_mut(|a, b| b.value - a.value <= EQUAL * b.value) {
        for k in 1..group.len() {
            let (first, second) = group.split_at_mut(k);
            let (a, b) = (&mut first[0].shape, &mut second[0].shape);
            let along =
                |shape: &[f64]| -> f64 { shape.iter().zip(driven_mass).map(|(s, m)| s * m).sum() };
            let (p, q) = (along(a), along(b));
            let r = libm::hypot(p, q);
            if r > 0.0 {
                let (cosine, sine) = (p / r, q / r);
                for (a, b) in a.iter_mut().zip(b) {
                    (*a, *b) = (cosine * *a + sine * *b, cosine * *b - sine * *a);
                }
            }
        }
    }
}
