//! M-orthonormal vectors of a building, and their Ritz modes.

use pulp::{Arch, Simd, WithSimd};

use crate::eigen::symmetric;
use crate::linear::NotPositive;
use crate::simd;
use crate::system::BuildingSystem;

/// Remainder of a vector below which it counts as dependent; a smaller one would be rounding, in which massless
/// degrees of freedom do not follow the others and are far too stiff.
const NOTHING_NEW: f64 = 1e-4;

/// M-orthonormal vectors over all degrees of freedom.
pub(super) struct Span<'a> {
    building: &'a BuildingSystem,
    pub(super) vectors: Vec<Vec<f64>>,
    /// vᵀK w between them, lower triangle row by row.
    products: Vec<Vec<f64>>,
    /// Horizontal mass that goes with every vector \[kg^½\].
    pub(super) driven: Vec<f64>,
}

/// The best approximations of natural modes in a span of vectors (Rayleigh and Ritz).
pub(super) struct RitzModes {
    /// ω², ascending \[1/s²\].
    pub(super) stiffness: Vec<f64>,
    /// Vectors over all degrees of freedom, massless ones included, and the coefficients of every shape φ, φᵀMφ = 1
    /// \[kg^−½\].
    pub(super) vectors: Vec<Vec<f64>>,
    pub(super) parts: Vec<Vec<f64>>,
    /// φᵀM r \[kg^½\].
    pub(super) participation: Vec<f64>,
}

impl RitzModes {
    /// A shape over all degrees of freedom \[kg^−½\].
    pub(super) fn shape(&self, mode: usize) -> Vec<f64> {
        let mut shape = vec![0.0; self.vectors.first().map_or(0, Vec::len)];
        for (vector, part) in self.vectors.iter().zip(&self.parts[mode]) {
            simd::add(&mut shape, *part, vector);
        }
        shape
    }
}

impl<'a> Span<'a> {
    pub(super) fn empty(building: &'a BuildingSystem) -> Self {
        Self {
            building,
            vectors: Vec::new(),
            products: Vec::new(),
            driven: Vec::new(),
        }
    }

    /// Adds the part of a vector orthogonal to the others.
    pub(super) fn add(&mut self, mut vector: Vec<f64>) {
        let equations = &self.building.equations;
        let most = equations.mass.iter().filter(|mass| **mass > 0.0).count();
        if self.vectors.len() == most {
            return;
        }
        let length = |vector: &[f64]| simd::wide_weighted_square(&equations.mass, vector).sqrt();
        let before = length(&vector);
        let strip = Strip {
            vector: &mut vector,
            known: &self.vectors,
            mass: &equations.mass,
        };
        Arch::new().dispatch(strip);
        let rest = length(&vector);
        if rest <= NOTHING_NEW * before || rest.is_nan() {
            return;
        }
        vector.iter_mut().for_each(|value| *value /= rest);
        let mut stiff = vec![0.0; vector.len()];
        equations.stiffness.multiply_add(&vector, &mut stiff);
        if !equations.plain {
            equations.undamped.multiply_add(&vector, &mut stiff);
        }
        self.driven.push(simd::dot(&equations.driven_mass, &vector));
        self.vectors.push(vector);
        let mut row = vec![0.0; self.vectors.len()];
        let products = Products {
            with: &stiff,
            vectors: &self.vectors,
            row: &mut row,
        };
        Arch::new().dispatch(products);
        self.products.push(row);
    }

    /// vᵀ(K + s²M)w between all vectors, lower triangle row by row.
    pub(super) fn projected(&self, rate: f64) -> Vec<Vec<f64>> {
        let mut rows = self.products.clone();
        for (i, row) in rows.iter_mut().enumerate() {
            row[i] += rate * rate;
        }
        rows
    }

    /// Eigenvalues and eigenvectors within the vectors (Rayleigh and Ritz).
    pub(super) fn ritz_modes(self) -> Result<RitzModes, NotPositive> {
        let (stiffness, parts) = symmetric::eigen(&self.products);
        if stiffness
            .iter()
            .any(|value| *value <= 0.0 || value.is_nan())
        {
            return Err(NotPositive { dof: 0 });
        }
        let participation = parts.iter().map(|parts| simd::dot(&self.driven, parts));
        Ok(RitzModes {
            participation: participation.collect(),
            stiffness,
            parts,
            vectors: self.vectors,
        })
    }
}

/// Orthogonalises a vector against the M-orthonormal ones (classical Gram–Schmidt).
struct Strip<'a> {
    vector: &'a mut [f64],
    known: &'a [Vec<f64>],
    mass: &'a [f64],
}

impl WithSimd for Strip<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            vector,
            known,
            mass,
        } = self;
        let (mut heavy, mut parts) = (vec![0.0; vector.len()], vec![0.0; known.len()]);
        // Twice is enough.
        for _ in 0..2 {
            for ((heavy, value), mass) in heavy.iter_mut().zip(&*vector).zip(mass) {
                *heavy = value * mass;
            }
            simd::dots(simd, known, &heavy, &mut parts);
            simd::subtract_all(known, &parts, vector);
        }
    }
}

/// Products of a vector with many.
struct Products<'a> {
    with: &'a [f64],
    vectors: &'a [Vec<f64>],
    row: &'a mut [f64],
}

impl WithSimd for Products<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        simd::dots(simd, self.vectors, self.with, self.row);
    }
}
