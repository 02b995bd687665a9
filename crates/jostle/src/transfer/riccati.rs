//! The Riccati transfer recursion in its stable form: block LDLᵀ of the step equations along the path.
//!
//! At a cut, what lies behind it exerts `b = R a + g` on what lies ahead (theory, Eq. R1). Passing one
//! degree of freedom replaces R by a Schur complement (Eq. R3); the pivots D, the couplings L and the loads
//! are all that need be kept. Unlike the product of transfer matrices no growing and decaying solutions are
//! ever mixed, so that nothing is lost at small steps or in tall frames.

pub(crate) mod rates;

use std::cell::RefCell;
use std::convert::Infallible;

use pulp::NullaryFnOnce;

use super::abreast::Abreast;

use crate::equations::{Equations, SparseSymmetric};
use crate::lanes;
use crate::small_keys::in_order;
use crate::stepping::{NotPositive, StepEquations, StepMatrix};
use crate::system::BuildingSystem;

/// The recursion through one building: the pattern of the couplings, found once.
#[derive(Clone, Debug)]
pub struct RiccatiSweep {
    /// Start of every column of L in `rows`; one longer than the order.
    starts: Vec<usize>,
    /// Row of every coupling.
    rows: Vec<u32>,
    /// Start of every row's list in `reached`.
    reached_starts: Vec<usize>,
    /// Columns that couple to a row, in an order in which they can be eliminated.
    reached: Vec<u32>,
    /// Where the couplings of those columns to the row are kept.
    positions: Vec<u32>,
    /// The displacement that each one is eliminated into; itself for the last.
    parent: Vec<u32>,
    /// Diagonal of the parts of the step matrix.
    diagonal: Vec<Parts>,
    /// Rows of the step matrix before the diagonal: start, column, parts.
    before_starts: Vec<usize>,
    before: Vec<(u32, Parts)>,
    mass: Vec<f64>,
    springs: Vec<SpringPlace>,
    initial_tangents: Vec<f64>,
    /// The first columns: chains abreast.
    abreast: Abreast,
    /// The others, one behind the other.
    runs: Vec<Run>,
}

/// Where the tangent of a spring that yields enters the step matrix.
#[derive(Clone, Copy, Debug)]
struct SpringPlace {
    diagonal: [Option<usize>; 2],
    /// Index among the entries before the diagonal.
    between: Option<usize>,
}

/// What makes up an entry of the step matrix.
#[derive(Clone, Copy, Debug, Default)]
struct Parts {
    elastic: f64,
    undamped: f64,
    dashpot: f64,
}

impl Parts {
    fn in_step(&self, matrix: &StepMatrix) -> f64 {
        matrix.stiffness * self.elastic + self.undamped + matrix.dashpots * self.dashpot
    }
}

/// Pivots and couplings for one step size.
#[derive(Clone, Debug, Default)]
pub struct RiccatiFactor {
    couplings: Vec<f64>,
    /// Those of chains abreast, as the passes want them.
    laid: Vec<f64>,
    /// Load and ends of the chains during a pass.
    scratch: RefCell<Vec<f64>>,
    inverse_pivots: Vec<f64>,
    pivots: Vec<f64>,
    /// The step matrix: diagonal, and entries before it by rows.
    diagonal: Vec<f64>,
    before: Vec<f64>,
    /// Rows to eliminate anew.
    touched: Vec<bool>,
    work: Vec<f64>,
}

/// Signs of the pivots of a shifted factorisation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Inertia {
    /// Negative pivots.
    pub(crate) negative: usize,
    /// Greatest change of a diagonal entry, relative to the stiffness and inertia it is made of: the factor by
    /// which elimination magnifies rounding. At most 1 for positive definite matrices.
    pub(crate) growth: f64,
}

impl RiccatiFactor {
    /// Pivots along the path.
    pub(crate) fn pivots(&self) -> &[f64] {
        &self.pivots
    }
}

impl RiccatiSweep {
    /// Couplings kept per factor: one solution costs two multiply-adds for each.
    #[must_use]
    pub fn couplings(&self) -> usize {
        self.rows.len()
    }

    /// The recursion of the equations of a building.
    pub(crate) fn through(equations: &Equations) -> Self {
        let n = equations.len();
        let (before_starts, before) = rows_before_diagonal(equations);
        // The displacement that each one is eliminated into: the parent in the elimination tree.
        let mut parent = vec![usize::MAX; n];
        let mut met_by = vec![usize::MAX; n];
        let (mut reached, mut reached_starts, mut counts) = (Vec::new(), vec![0], vec![0_usize; n]);
        let mut branch = Vec::new();
        for row in 0..n {
            met_by[row] = row;
            let first = reached.len();
            for &(column, _) in &before[before_starts[row]..before_starts[row + 1]] {
                let mut at = column as usize;
                branch.clear();
                while met_by[at] != row {
                    if parent[at] == usize::MAX {
                        parent[at] = row;
                    }
                    branch.push(at as u32);
                    counts[at] += 1;
                    met_by[at] = row;
                    at = parent[at];
                }
                reached.extend(branch.iter());
            }
            // Along the path every column comes after those it depends on.
            reached[first..].sort_unstable();
            reached_starts.push(reached.len());
        }
        let mut starts = vec![0; n + 1];
        for column in 0..n {
            starts[column + 1] = starts[column] + counts[column];
        }
        let mut next = starts.clone();
        let mut rows = vec![0; starts[n]];
        let mut positions = Vec::with_capacity(reached.len());
        for row in 0..n {
            for &column in &reached[reached_starts[row]..reached_starts[row + 1]] {
                rows[next[column as usize]] = row as u32;
                positions.push(next[column as usize] as u32);
                next[column as usize] += 1;
            }
        }
        let parent: Vec<u32> = (0..n)
            .map(|dof| if parent[dof] == usize::MAX { dof } else { parent[dof] } as u32)
            .collect();
        let abreast = Abreast::of(&starts, &rows, &parent);
        let springs = equations.springs.iter().map(|spring| SpringPlace {
            diagonal: spring.dofs,
            between: match spring.dofs {
                [Some(a), Some(b)] => {
                    let entries = before_starts[a.max(b)]..before_starts[a.max(b) + 1];
                    let place = before[entries.clone()]
                        .iter()
                        .position(|(column, _)| *column as usize == a.min(b));
                    place.map(|place| entries.start + place)
                }
                _ => None,
            },
        });
        Self {
            runs: Run::all(abreast.columns(), &starts),
            abreast,
            springs: springs.collect(),
            initial_tangents: equations.initial_tangents(),
            positions,
            parent,
            starts,
            rows,
            reached_starts,
            reached,
            diagonal: (0..n)
                .map(|dof| Parts {
                    elastic: equations.stiffness.diagonal[dof],
                    undamped: equations.undamped.diagonal[dof],
                    dashpot: equations.dashpots.diagonal[dof],
                })
                .collect(),
            before_starts,
            before,
            mass: equations.mass.clone(),
        }
    }

    /// Factorises K − `shift`·M whatever the signs of its pivots, and returns how many are negative: as many as
    /// there are eigenvalues ω² below the shift (Sylvester; theory, Eq. M3).
    pub(crate) fn factorize_shifted(&self, shift: f64, factor: &mut RiccatiFactor) -> Inertia {
        let mut inertia = Inertia {
            negative: 0,
            growth: 0.0,
        };
        let matrix = StepMatrix::new(1.0, -shift);
        self.compose(&matrix, &self.initial_tangents, factor);
        factor.touched.fill(true);
        let never_fails = self.eliminate(factor, |row, own, pivot| {
            // Springs that yield are part of the stiffness here as well.
            let inertia_part = shift * self.mass[row];
            let scale = (own + inertia_part).abs() + inertia_part.abs();
            inertia.growth = (own - pivot).abs().max(inertia.growth * scale) / scale;
            // A part behind the cut resonates with its end held: any small pivot does, its sign is immaterial.
            let least = f64::EPSILON * scale;
            let pivot = if pivot.abs() < least { least } else { pivot };
            inertia.negative += usize::from(pivot < 0.0);
            Ok::<_, Infallible>(pivot)
        });
        self.lay_out(factor);
        match never_fails {
            Ok(()) => inertia,
            Err(never) => match never {},
        }
    }

    /// The entries of a step matrix.
    fn compose(&self, matrix: &StepMatrix, tangents: &[f64], factor: &mut RiccatiFactor) {
        let n = self.mass.len();
        factor.couplings.resize(self.rows.len(), 0.0);
        factor.pivots.resize(n, 0.0);
        factor.inverse_pivots.resize(n, 0.0);
        factor.touched.resize(n, false);
        factor.work.resize(n, 0.0);
        factor.diagonal.clear();
        let diagonal = self.diagonal.iter().zip(&self.mass);
        factor
            .diagonal
            .extend(diagonal.map(|(parts, mass)| parts.in_step(matrix) + matrix.mass * mass));
        factor.before.clear();
        let before = self.before.iter();
        factor
            .before
            .extend(before.map(|(_, parts)| parts.in_step(matrix)));
        for (spring, tangent) in self.springs.iter().zip(tangents) {
            for dof in spring.diagonal.into_iter().flatten() {
                factor.diagonal[dof] += tangent;
            }
            if let Some(entry) = spring.between {
                factor.before[entry] -= tangent;
            }
        }
    }

    /// Puts the couplings of chains abreast where the passes want them.
    fn lay_out(&self, factor: &mut RiccatiFactor) {
        self.abreast.lay_out(&factor.couplings, &mut factor.laid);
        let ends = self.abreast.ends();
        factor.scratch.get_mut().resize(self.mass.len() + ends, 0.0);
    }

    /// L D Lᵀ of the touched rows of the matrix in `factor`; every pivot is what `accept` makes of (row, entry of the
    /// matrix on the diagonal, pivot).
    fn eliminate<E>(
        &self,
        factor: &mut RiccatiFactor,
        mut accept: impl FnMut(usize, f64, f64) -> Result<f64, E>,
    ) -> Result<(), E> {
        let RiccatiFactor {
            couplings,
            inverse_pivots,
            pivots,
            diagonal,
            before,
            touched,
            work,
            ..
        } = factor;
        work.fill(0.0);
        for row in (0..self.mass.len()).filter(|&row| touched[row]) {
            let own = diagonal[row];
            let entries = self.before_starts[row]..self.before_starts[row + 1];
            for ((column, _), value) in self.before[entries.clone()].iter().zip(&before[entries]) {
                work[*column as usize] = *value;
            }
            let mut pivot = own;
            let reached = self.reached_starts[row]..self.reached_starts[row + 1];
            let columns = self.reached[reached.clone()].iter();
            for (&column, &position) in columns.zip(&self.positions[reached]) {
                let (column, position) = (column as usize, position as usize);
                let value = std::mem::take(&mut work[column]);
                let known = self.starts[column]..position;
                for (&below, &coupling) in self.rows[known.clone()].iter().zip(&couplings[known]) {
                    work[below as usize] -= coupling * value;
                }
                let coupling = value * inverse_pivots[column];
                pivot -= coupling * value;
                couplings[position] = coupling;
            }
            let pivot = accept(row, own, pivot)?;
            pivots[row] = pivot;
            inverse_pivots[row] = 1.0 / pivot;
        }
        Ok(())
    }
}

/// A pivot that leaves digits to what comes after it.
fn sound(row: usize, own: f64, pivot: f64) -> Result<f64, NotPositive> {
    if pivot > 1e-14 * own.abs() && pivot.is_finite() {
        Ok(pivot)
    } else {
        Err(NotPositive { dof: row })
    }
}

impl StepEquations for RiccatiSweep {
    type Factor = RiccatiFactor;

    fn of(building: &BuildingSystem) -> Self {
        Self::through(&building.equations)
    }

    fn factorize(
        &self,
        matrix: &StepMatrix,
        tangents: &[f64],
        factor: &mut RiccatiFactor,
    ) -> Result<(), NotPositive> {
        self.compose(matrix, tangents, factor);
        factor.touched.fill(true);
        self.eliminate(factor, sound)?;
        self.lay_out(factor);
        Ok(())
    }

    /// Only what lies ahead of the changed springs on the transfer path is passed again.
    fn update(
        &self,
        matrix: &StepMatrix,
        tangents: &[f64],
        changed: &[usize],
        factor: &mut RiccatiFactor,
    ) -> Result<(), NotPositive> {
        self.compose(matrix, tangents, factor);
        factor.touched.fill(false);
        for &spring in changed {
            for dof in self.springs[spring].diagonal.into_iter().flatten() {
                let mut at = dof;
                while !factor.touched[at] {
                    factor.touched[at] = true;
                    at = self.parent[at] as usize;
                }
            }
        }
        self.eliminate(factor, sound)?;
        self.lay_out(factor);
        Ok(())
    }

    #[inline]
    fn solve(&self, factor: &RiccatiFactor, load: &mut [f64]) {
        let passes = Passes {
            sweep: self,
            factor,
            load,
        };
        lanes::in_wide_registers(self.mass.len(), passes);
    }
}

/// Both passes over a load, compiled for the registers at hand.
struct Passes<'a> {
    sweep: &'a RiccatiSweep,
    factor: &'a RiccatiFactor,
    load: &'a mut [f64],
}

impl NullaryFnOnce for Passes<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self {
            sweep,
            factor,
            load,
        } = self;
        let n = sweep.mass.len();
        let mut scratch = factor.scratch.borrow_mut();
        let (outer, load) = (load, &mut scratch[..]);
        load[..n].copy_from_slice(&outer[..n]);
        sweep.abreast.pass_on(&factor.laid, load);
        for run in &sweep.runs {
            let (rows, couplings) = run.entries(&sweep.rows, &factor.couplings);
            match run.width {
                0 => {}
                1 => pass_on::<1>(run.first, rows, couplings, load),
                2 => pass_on::<2>(run.first, rows, couplings, load),
                3 => pass_on::<3>(run.first, rows, couplings, load),
                4 => pass_on::<4>(run.first, rows, couplings, load),
                5 => pass_on::<5>(run.first, rows, couplings, load),
                6 => pass_on::<6>(run.first, rows, couplings, load),
                width => pass_on_wide(run.first, width, rows, couplings, load),
            }
        }
        for (value, inverse_pivot) in load.iter_mut().zip(&factor.inverse_pivots) {
            *value *= inverse_pivot;
        }
        for run in sweep.runs.iter().rev() {
            let (rows, couplings) = run.entries(&sweep.rows, &factor.couplings);
            match run.width {
                0 => {}
                1 => gather::<1>(run.first, rows, couplings, load),
                2 => gather::<2>(run.first, rows, couplings, load),
                3 => gather::<3>(run.first, rows, couplings, load),
                4 => gather::<4>(run.first, rows, couplings, load),
                5 => gather::<5>(run.first, rows, couplings, load),
                6 => gather::<6>(run.first, rows, couplings, load),
                width => gather_wide(run.first, width, rows, couplings, load),
            }
        }
        sweep.abreast.gather(&factor.laid, load);
        outer[..n].copy_from_slice(&load[..n]);
    }
}

/// Columns next to each other with equally many couplings.
#[derive(Clone, Debug)]
struct Run {
    /// First column.
    first: usize,
    /// Couplings of every column.
    width: usize,
    /// Where they are in `rows` and in the couplings of a factor.
    start: usize,
    end: usize,
}

impl Run {
    fn entries<'a>(&self, rows: &'a [u32], couplings: &'a [f64]) -> (&'a [u32], &'a [f64]) {
        (
            &rows[self.start..self.end],
            &couplings[self.start..self.end],
        )
    }

    /// The runs, from a column on, of a pattern whose columns begin at `starts`.
    fn all(first: usize, starts: &[usize]) -> Vec<Self> {
        let mut runs: Vec<Self> = Vec::new();
        for (column, bounds) in starts.windows(2).enumerate().skip(first) {
            let width = bounds[1] - bounds[0];
            match runs.last_mut() {
                Some(run) if run.width == width => run.end = bounds[1],
                _ => runs.push(Self {
                    first: column,
                    width,
                    start: bounds[0],
                    end: bounds[1],
                }),
            }
        }
        runs
    }
}

/// Every column passes its load on to the rows ahead of it.
#[inline(always)]
fn pass_on<const W: usize>(first: usize, rows: &[u32], couplings: &[f64], load: &mut [f64]) {
    let columns = rows
        .as_chunks::<W>()
        .0
        .iter()
        .zip(couplings.as_chunks::<W>().0);
    for (offset, (rows, couplings)) in columns.enumerate() {
        let value = load[first + offset];
        for entry in 0..W {
            load[rows[entry] as usize] -= couplings[entry] * value;
        }
    }
}

fn pass_on_wide(first: usize, width: usize, rows: &[u32], couplings: &[f64], load: &mut [f64]) {
    let columns = rows.chunks_exact(width).zip(couplings.chunks_exact(width));
    for (offset, (rows, couplings)) in columns.enumerate() {
        let value = load[first + offset];
        for (row, coupling) in rows.iter().zip(couplings) {
            load[*row as usize] -= coupling * value;
        }
    }
}

/// Every column, last first, gathers from the rows ahead of it.
#[inline(always)]
fn gather<const W: usize>(first: usize, rows: &[u32], couplings: &[f64], load: &mut [f64]) {
    let columns = rows
        .as_chunks::<W>()
        .0
        .iter()
        .zip(couplings.as_chunks::<W>().0);
    for (offset, (rows, couplings)) in columns.enumerate().rev() {
        let (mut even, mut odd) = (load[first + offset], 0.0);
        for entry in 0..W {
            let part = couplings[entry] * load[rows[entry] as usize];
            if entry % 2 == 0 {
                even -= part;
            } else {
                odd += part;
            }
        }
        load[first + offset] = even - odd;
    }
}

fn gather_wide(first: usize, width: usize, rows: &[u32], couplings: &[f64], load: &mut [f64]) {
    let columns = rows.chunks_exact(width).zip(couplings.chunks_exact(width));
    for (offset, (rows, couplings)) in columns.enumerate().rev() {
        let ahead = rows
            .iter()
            .zip(couplings)
            .map(|(row, coupling)| coupling * load[*row as usize]);
        let passed: f64 = ahead.sum();
        load[first + offset] -= passed;
    }
}

/// The strict lower triangles of K, K′ and C′ by rows: starts, columns and values.
fn rows_before_diagonal(equations: &Equations) -> (Vec<usize>, Vec<(u32, Parts)>) {
    let n = equations.len();
    let mut entries: Vec<(u32, u32, Parts)> = Vec::new();
    let mut gather = |matrix: &SparseSymmetric, part: fn(f64) -> Parts| {
        for column in 0..n {
            for entry in matrix.starts[column]..matrix.starts[column + 1] {
                entries.push((
                    matrix.rows[entry],
                    column as u32,
                    part(matrix.values[entry]),
                ));
            }
        }
    };
    gather(&equations.stiffness, |elastic| Parts {
        elastic,
        ..Parts::default()
    });
    gather(&equations.undamped, |undamped| Parts {
        undamped,
        ..Parts::default()
    });
    gather(&equations.dashpots, |dashpot| Parts {
        dashpot,
        ..Parts::default()
    });
    for spring in &equations.springs {
        if let [Some(a), Some(b)] = spring.dofs
            && a != b
        {
            entries.push((a.max(b) as u32, a.min(b) as u32, Parts::default()));
        }
    }
    let by_column = in_order(&entries, n, |entry| entry.1 as usize);
    let entries = in_order(&by_column, n, |entry| entry.0 as usize);
    let (mut starts, mut rows) = (vec![0; n + 1], Vec::<(u32, Parts)>::new());
    let mut last = None;
    for (row, column, parts) in entries {
        match rows.last_mut().filter(|_| last == Some((row, column))) {
            Some((_, sum)) => {
                sum.elastic += parts.elastic;
                sum.undamped += parts.undamped;
                sum.dashpot += parts.dashpot;
            }
            None => {
                rows.push((column, parts));
                starts[row as usize + 1] += 1;
                last = Some((row, column));
            }
        }
    }
    for row in 0..n {
        starts[row + 1] += starts[row];
    }
    (starts, rows)
}
