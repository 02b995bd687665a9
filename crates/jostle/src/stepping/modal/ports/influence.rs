//! What forces at contacts do over one step size: constant matrices between contacts, and factors of the modes.

use super::super::reduced::Reduced;
use super::super::step_table::StepTable;

/// Moments of a force over a step: factors of Legendre's first three polynomials.
pub(super) type Moments = [f64; 3];

/// Factors and matrices of one step size.
pub(super) struct Influence {
    pub(super) table: StepTable,
    /// Displacement and velocity of every mode at the end under the three polynomials.
    pub(super) displacement: [Vec<f64>; 3],
    pub(super) velocity: [Vec<f64>; 3],
    /// Of a force at one contact (column) in the closing of another (row), its rate and acceleration at the end.
    pub(super) ends: Vec<[Moments; 3]>,
}

/// Contacts as rows over all modes, left minus right \[kg^−½\].
pub(super) struct Rows {
    pub(super) shapes: Vec<Vec<f64>>,
    /// R Rᵀ: acceleration of a row by a force at another \[1/kg\].
    pub(super) at_once: Vec<f64>,
}

impl Rows {
    pub(super) fn new(shapes: Vec<Vec<f64>>) -> Self {
        let pairs = shapes
            .iter()
            .flat_map(|one| shapes.iter().map(move |other| (one, other)));
        let at_once = pairs
            .map(|(one, other)| one.iter().zip(other).map(|(a, b)| a * b).sum())
            .collect();
        Self { shapes, at_once }
    }

    pub(super) fn len(&self) -> usize {
        self.shapes.len()
    }
}

impl Influence {
    pub(super) fn new(reduced: &Reduced, rows: &Rows, step: f64) -> Self {
        let mut table = StepTable::default();
        table.set(reduced, step, None);
        // A load from p₀ to p₁ with curvature b: the polynomials are (1, 1, 0), (−1, 1, 0) and (1, 1, 6).
        let polynomials = |factors: &[Vec<f64>; 5]| {
            let [_, _, first, last, bent] = factors;
            let of = |weights: [f64; 3]| -> Vec<f64> {
                let all = first.iter().zip(last).zip(bent);
                all.map(|((first, last), bent)| {
                    weights[0] * first + weights[1] * last + weights[2] * bent
                })
                .collect()
            };
            [
                of([1.0, 1.0, 0.0]),
                of([-1.0, 1.0, 0.0]),
                of([1.0, 1.0, 6.0]),
            ]
        };
        let displacement = polynomials(&table.displacement);
        let velocity = polynomials(&table.velocity);
        let mut ends = Vec::with_capacity(rows.len() * rows.len());
        for one in &rows.shapes {
            for other in &rows.shapes {
                let mut sums = [[0.0; 3]; 3];
                for mode in 0..one.len() {
                    let both = one[mode] * other[mode];
                    for k in 0..3 {
                        let (b, d) = (displacement[k][mode], velocity[k][mode]);
                        let back = reduced.stiffness[mode] * b + reduced.damping[mode] * d;
                        sums[0][k] -= both * b;
                        sums[1][k] -= both * d;
                        sums[2][k] += both * back;
                    }
                }
                ends.push(sums);
            }
        }
        Self {
            table,
            displacement,
            velocity,
            ends,
        }
    }

    /// What the same polynomials do at the middle of a step twice as long: there they are the loads (1, 1, 0), (−1, 0, 0)
    /// and (1, −½, 3/2) over this step.
    pub(super) fn middles(&self, rows: &Rows) -> Vec<Moments> {
        let [_, _, first, last, bent] = &self.table.displacement;
        let mut all = Vec::with_capacity(rows.len() * rows.len());
        for one in &rows.shapes {
            for other in &rows.shapes {
                let mut sums = [0.0; 3];
                for mode in 0..one.len() {
                    let both = one[mode] * other[mode];
                    let (p, q, b) = (first[mode], last[mode], bent[mode]);
                    sums[0] -= both * (p + q);
                    sums[1] += both * p;
                    sums[2] -= both * (p - 0.5 * q + 1.5 * b);
                }
                all.push(sums);
            }
        }
        all
    }
}
