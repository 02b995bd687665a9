//! Symmetric sparse matrix in the order of its degrees of freedom.

use pulp::NullaryFnOnce;

use super::counting_sort::in_order;
use super::diagonal_runs::DiagonalRuns;
use crate::simd;

/// Symmetric sparse matrix: diagonal and strict lower triangle by columns, rows rising.
#[derive(Clone, Debug, Default)]
pub struct SparseSymmetric {
    /// Diagonal.
    pub diagonal: Vec<f64>,
    /// Start of every column in `rows` and `values`; one longer than the diagonal.
    pub starts: Vec<usize>,
    /// Row of every entry below the diagonal.
    pub rows: Vec<u32>,
    /// Value of every entry below the diagonal.
    pub values: Vec<f64>,
    /// The same entries as long loops want them.
    runs: DiagonalRuns,
    packed: Vec<f64>,
}

/// xᵀ A x, compiled for the registers at hand.
struct QuadraticForm<'a> {
    matrix: &'a SparseSymmetric,
    x: &'a [f64],
}

impl NullaryFnOnce for QuadraticForm<'_> {
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        let Self { matrix, x } = self;
        let below = matrix.runs.bilinear(&matrix.packed, x);
        simd::weighted_square(&matrix.diagonal, x) + 2.0 * below
    }
}

/// `product` += A x, compiled for the registers at hand.
struct Product<'a> {
    matrix: &'a SparseSymmetric,
    x: &'a [f64],
    product: &'a mut [f64],
}

impl NullaryFnOnce for Product<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { matrix, x, product } = self;
        for ((product, diagonal), x) in product.iter_mut().zip(&matrix.diagonal).zip(x) {
            *product += diagonal * x;
        }
        matrix.runs.multiply_add(&matrix.packed, x, product);
    }
}

impl SparseSymmetric {
    /// Whether every entry is zero.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.rows.is_empty() && self.diagonal.iter().all(|value| *value == 0.0)
    }

    /// Adds up entries of the lower triangle (row ≥ column), in a fixed order.
    pub(crate) fn from_triplets(n: usize, triplets: &[(usize, usize, f64)]) -> Self {
        let by_row = in_order(triplets, n, |entry| entry.0);
        let mut matrix = Self {
            diagonal: vec![0.0; n],
            starts: vec![0; n + 1],
            ..Self::default()
        };
        let mut previous = None;
        for (row, column, value) in in_order(&by_row, n, |entry| entry.1) {
            if row == column {
                matrix.diagonal[row] += value;
            } else if previous == Some((row, column)) {
                if let Some(last) = matrix.values.last_mut() {
                    *last += value;
                }
            } else {
                matrix.rows.push(row as u32);
                matrix.values.push(value);
                matrix.starts[column + 1] += 1;
                previous = Some((row, column));
            }
        }
        for column in 0..n {
            matrix.starts[column + 1] += matrix.starts[column];
        }
        let mut entries = Vec::with_capacity(matrix.rows.len());
        for column in 0..n {
            for place in matrix.starts[column]..matrix.starts[column + 1] {
                entries.push((matrix.rows[place], column as u32, place as u32));
            }
        }
        matrix.runs = DiagonalRuns::new(entries, n);
        matrix.runs.pack(&matrix.values, &mut matrix.packed);
        matrix
    }

    /// xᵀ A x.
    #[must_use]
    pub fn quadratic_form(&self, x: &[f64]) -> f64 {
        simd::in_wide_registers(x.len(), QuadraticForm { matrix: self, x })
    }

    /// `product` += A x.
    pub fn multiply_add(&self, x: &[f64], product: &mut [f64]) {
        let product = Product {
            matrix: self,
            x,
            product,
        };
        simd::in_wide_registers(x.len(), product);
    }
}
