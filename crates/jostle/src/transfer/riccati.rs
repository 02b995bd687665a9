//! The Riccati transfer recursion in its stable form: block LDLᵀ of the step equations along the path.
//!
//! At a cut, the part behind it exerts `b = R a + g` on the part ahead (theory, Eq. R1). Passing one degree of
//! freedom replaces R by a Schur complement (Eq. R3); only the pivots D, the entries of L and the loads are stored.
//! Unlike in the product of transfer matrices, growing and decaying solutions are never mixed, so no digits are
//! lost at small steps or in tall frames.

pub(crate) mod rates;
mod substitution;

use std::convert::Infallible;

use super::batched_chains::BatchedChains;
use super::joint_band::Band;
use super::packed_factor::PackedFactor;
pub use substitution::RiccatiScratch;

use crate::linear::SparseSymmetric;
use crate::linear::counting_sort::in_order;
use crate::linear::{NotPositive, Row, StepMatrix};
use crate::structure::AssembledBuilding;
use crate::structure::Equations;
use crate::structure::StepEquations;

/// The Riccati recursion of one building: the pattern of L, computed once.
///
/// The example solves one step of three storeys with 40 t and 40 MN/m each, by 20 ms, under 40 kN on every floor
/// (docs/method.md, section 2):
///
/// ```
/// use jostle::linear::StepMatrix;
/// use jostle::structure::StepEquations;
/// use jostle::{
///     Building, Damping, Model, RiccatiFactor, RiccatiScratch, RiccatiSweep, Shear, Structure, System,
/// };
///
/// let building = Building {
///     name: "three storeys".to_owned(),
///     structure: Structure::Shear(Shear {
///         mass: vec![40e3; 3],
///         stiffness: vec![40e6; 3],
///         storey_heights: vec![3.0; 3],
///     }),
///     damping: Damping::ratio(0.05, []),
///     ..Building::default()
/// };
/// let model = Model {
///     title: "one step".to_owned(),
///     buildings: vec![building],
///     ..Model::default()
/// };
/// let system = System::assemble(&model).map_err(|faults| faults[0].to_string())?;
///
/// let sweep = RiccatiSweep::new(&system.buildings[0]);
/// let mut factor = RiccatiFactor::default();
/// let matrix = StepMatrix::new(1.0, 4.0 / 0.02_f64.powi(2)); // K + 4/h² M
/// sweep.factorize(&matrix, &[], &mut factor).map_err(|error| error.to_string())?;
/// let mut floors = [40e3; 3]; // loads [N]
/// sweep.solve(&factor, &mut floors, &mut RiccatiScratch::default()); // displacements [m]
///
/// for (displacement, expected) in floors.into_iter().zip([5720.0, 6200.0, 6240.0]) {
///     assert!((displacement / (expected / 1561.0 / 40e3) - 1.0).abs() < 1e-12);
/// }
/// assert_eq!(sweep.entries_of_l(), 2);
/// # Ok::<(), String>(())
/// ```
#[derive(Clone, Debug)]
pub struct RiccatiSweep {
    /// Start of every column of L in `rows`; one longer than the order.
    starts: Vec<usize>,
    /// Row of every entry of L.
    rows: Vec<u32>,
    /// Start of every row's list in `reached`.
    reached_starts: Vec<usize>,
    /// Columns with an entry in a row, in an admissible order of elimination.
    reached: Vec<u32>,
    /// Indices of these entries of L.
    positions: Vec<u32>,
    /// Parent in the elimination tree; itself for the last.
    parent: Vec<u32>,
    /// Diagonal of the parts of the step matrix.
    diagonal: Vec<Parts>,
    /// Rows of the step matrix before the diagonal: start, column, parts.
    before_starts: Vec<usize>,
    before: Vec<(u32, Parts)>,
    mass: Vec<f64>,
    /// Deformations of springs that yield.
    springs: Vec<Row>,
    /// Their tangents on the diagonal, and before it.
    on_diagonal: Vec<TangentPlace>,
    between: Vec<TangentPlace>,
    initial_tangents: Vec<f64>,
    /// The first columns: batched chains.
    batched: BatchedChains,
    /// The others, where they couple to their neighbours only.
    band: Option<Band>,
    packed: PackedFactor,
}

/// Where the tangent of a yielding spring stands in the step matrix, times the product of two shares of its deformation.
#[derive(Clone, Copy, Debug)]
struct TangentPlace {
    spring: usize,
    /// Degree of freedom on the diagonal, or index among the entries before it.
    at: usize,
    shares: [f64; 2],
}

impl TangentPlace {
    fn add(&self, tangents: &[f64], entries: &mut [f64]) {
        entries[self.at] += tangents[self.spring] * self.shares[0] * self.shares[1];
    }
}

/// Parts of an entry of the step matrix.
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

/// Pivots and entries of L of one building for one step size.
#[derive(Clone, Debug, Default)]
pub struct RiccatiFactor {
    lower: Vec<f64>,
    /// Those of batched chains with their inverse pivots, then those of the band, in the order of the substitutions.
    packed: Vec<f64>,
    inverse_pivots: Vec<f64>,
    pivots: Vec<f64>,
    /// The step matrix: diagonal, and entries before it by rows.
    diagonal: Vec<f64>,
    before: Vec<f64>,
    /// Its entries at yielding springs, without these springs.
    bare: [Vec<f64>; 2],
    /// Rows to eliminate again.
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
    /// Entries of L per factor: one solution takes two multiply-adds for each.
    #[must_use]
    pub fn entries_of_l(&self) -> usize {
        self.rows.len()
    }

    /// The recursion of the equations of a building.
    pub(crate) fn through(equations: &Equations) -> Self {
        let n = equations.len();
        let (before_starts, before) = rows_before_diagonal(equations);
        // Parent in the elimination tree.
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
            // Along the path every column follows those it depends on.
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
        let batched = BatchedChains::new(&starts, &rows, &parent);
        let band = Band::new(batched.columns(), &starts, &rows);
        let banded = band.as_ref().map_or(&[][..], Band::places);
        let places = batched.places().iter().chain(banded).copied();
        let entry_between = |a: usize, b: usize| {
            let entries = before_starts[a.max(b)]..before_starts[a.max(b) + 1];
            let place = before[entries.clone()]
                .iter()
                .position(|(column, _)| *column as usize == a.min(b));
            place.map(|place| entries.start + place)
        };
        let springs = equations.springs.iter().map(|spring| spring.row.clone());
        let springs: Vec<Row> = springs.collect();
        let (mut on_diagonal, mut between) = (Vec::new(), Vec::new());
        for (spring, row) in springs.iter().enumerate() {
            for (index, &(dof, share)) in row.entries().iter().enumerate() {
                on_diagonal.push(TangentPlace {
                    spring,
                    at: dof,
                    shares: [share; 2],
                });
                for &(other, before) in &row.entries()[..index] {
                    between.extend(entry_between(other, dof).map(|at| TangentPlace {
                        spring,
                        at,
                        shares: [before, share],
                    }));
                }
            }
        }
        Self {
            packed: PackedFactor::new(places, rows.len(), n),
            band,
            batched,
            springs,
            on_diagonal,
            between,
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

    /// Factorises K − `shift`·M with pivots of any sign, and returns the number of negative ones. It equals the
    /// number of eigenvalues ω² below the shift (Sylvester; theory, Eq. M3).
    pub(crate) fn factorize_shifted(&self, shift: f64, factor: &mut RiccatiFactor) -> Inertia {
        let mut inertia = Inertia {
            negative: 0,
            growth: 0.0,
        };
        let matrix = StepMatrix::new(1.0, -shift);
        self.compose(&matrix, &self.initial_tangents, factor);
        factor.touched.fill(true);
        let never_fails = self.eliminate(factor, |row, diagonal, pivot| {
            // Springs that yield are part of the stiffness here as well.
            let inertia_part = shift * self.mass[row];
            let scale = (diagonal + inertia_part).abs() + inertia_part.abs();
            inertia.growth = (diagonal - pivot).abs().max(inertia.growth * scale) / scale;
            // A part behind the cut resonates with its end fixed: any small pivot serves, its sign does not matter.
            let least = f64::EPSILON * scale;
            let pivot = if pivot.abs() < least { least } else { pivot };
            inertia.negative += usize::from(pivot < 0.0);
            Ok::<_, Infallible>(pivot)
        });
        match never_fails {
            Ok(()) => inertia,
            Err(never) => match never {},
        }
    }

    /// The entries of a step matrix.
    fn compose(&self, matrix: &StepMatrix, tangents: &[f64], factor: &mut RiccatiFactor) {
        let n = self.mass.len();
        factor.lower.resize(self.rows.len(), 0.0);
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
        let RiccatiFactor {
            diagonal,
            before,
            bare: [on_diagonal, between],
            ..
        } = factor;
        on_diagonal.clear();
        on_diagonal.extend(self.on_diagonal.iter().map(|place| diagonal[place.at]));
        between.clear();
        between.extend(self.between.iter().map(|place| before[place.at]));
        self.add_springs(tangents, factor);
    }

    /// The same matrix with other springs.
    fn recompose(&self, tangents: &[f64], factor: &mut RiccatiFactor) {
        let [on_diagonal, between] = &factor.bare;
        for (place, bare) in self.on_diagonal.iter().zip(on_diagonal) {
            factor.diagonal[place.at] = *bare;
        }
        for (place, bare) in self.between.iter().zip(between) {
            factor.before[place.at] = *bare;
        }
        self.add_springs(tangents, factor);
    }

    fn add_springs(&self, tangents: &[f64], factor: &mut RiccatiFactor) {
        for place in &self.on_diagonal {
            place.add(tangents, &mut factor.diagonal);
        }
        for place in &self.between {
            place.add(tangents, &mut factor.before);
        }
    }

    /// L D Lᵀ of the touched rows of the matrix in `factor`; every pivot is the result of `accept` for (row,
    /// diagonal entry of the matrix, pivot).
    fn eliminate<E>(
        &self,
        factor: &mut RiccatiFactor,
        mut accept: impl FnMut(usize, f64, f64) -> Result<f64, E>,
    ) -> Result<(), E> {
        if factor.packed.is_empty() {
            factor.packed.extend_from_slice(self.packed.empty());
        }
        let RiccatiFactor {
            lower,
            inverse_pivots,
            pivots,
            diagonal,
            before,
            touched,
            work,
            packed,
            ..
        } = factor;
        work.fill(0.0);
        for row in (0..self.mass.len()).filter(|&row| touched[row]) {
            let diagonal = diagonal[row];
            let entries = self.before_starts[row]..self.before_starts[row + 1];
            for ((column, _), value) in self.before[entries.clone()].iter().zip(&before[entries]) {
                work[*column as usize] = *value;
            }
            let mut pivot = diagonal;
            let reached = self.reached_starts[row]..self.reached_starts[row + 1];
            let columns = self.reached[reached.clone()].iter();
            for (&column, &position) in columns.zip(&self.positions[reached]) {
                let (column, position) = (column as usize, position as usize);
                let value = std::mem::take(&mut work[column]);
                let known = self.starts[column]..position;
                for (&below, &coupling) in self.rows[known.clone()].iter().zip(&lower[known]) {
                    work[below as usize] -= coupling * value;
                }
                let coupling = value * inverse_pivots[column];
                pivot -= coupling * value;
                lower[position] = coupling;
                self.packed.set_lower(packed, position, coupling);
            }
            let pivot = accept(row, diagonal, pivot)?;
            pivots[row] = pivot;
            inverse_pivots[row] = 1.0 / pivot;
            self.packed
                .set_inverse_pivot(packed, row, inverse_pivots[row]);
        }
        Ok(())
    }
}

/// Accepts a pivot that is not dominated by rounding errors.
fn sound(row: usize, diagonal: f64, pivot: f64) -> Result<f64, NotPositive> {
    if pivot > 1e-14 * diagonal.abs() && pivot.is_finite() {
        Ok(pivot)
    } else {
        Err(NotPositive { dof: row })
    }
}

impl StepEquations for RiccatiSweep {
    type Factor = RiccatiFactor;
    type Scratch = RiccatiScratch;

    fn new(building: &AssembledBuilding) -> Self {
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
        self.eliminate(factor, sound)
    }

    /// Only rows ahead of the changed springs on the transfer path are eliminated again.
    fn update(
        &self,
        _: &StepMatrix,
        tangents: &[f64],
        changed: &[usize],
        factor: &mut RiccatiFactor,
    ) -> Result<(), NotPositive> {
        self.recompose(tangents, factor);
        factor.touched.fill(false);
        for &spring in changed {
            for dof in self.springs[spring].dofs() {
                let mut at = dof;
                while !factor.touched[at] {
                    factor.touched[at] = true;
                    at = self.parent[at] as usize;
                }
            }
        }
        self.eliminate(factor, sound)
    }

    #[inline]
    fn solve(&self, factor: &RiccatiFactor, load: &mut [f64], scratch: &mut RiccatiScratch) {
        self.substitute(factor, load, scratch);
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
        let dofs = || spring.row.dofs();
        for (index, a) in dofs().enumerate() {
            for b in dofs().take(index).filter(|b| *b != a) {
                entries.push((a.max(b) as u32, a.min(b) as u32, Parts::default()));
            }
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

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
    use crate::model::{Axial, FrameHinges, Hinges};
    use crate::structure::testkit::frame_with;

    /// Chains in registers and joints in a band give the same result as single columns, for members of every kind,
    /// more and fewer of them than lanes, and buildings smaller than a register.
    #[test]
    fn substitutions_in_registers_equal_those_one_by_one() {
        let (mut ways, mut bands, mut short) = (BTreeSet::new(), 0, 0);
        for axial in [[false, false], [true, false], [true, true]] {
            for (storeys, bays, segments) in [
                (1, 1, [6, 5]),
                (1, 2, [2, 2]),
                (2, 1, [3, 1]),
                (3, 3, [2, 2]),
                (4, 4, [4, 5]),
                (2, 9, [5, 4]),
                (3, 14, [2, 3]),
            ] {
                let building = frame_with(|frame| {
                    frame.storey_heights = vec![3.0; storeys];
                    frame.spans = (0..bays).map(|bay| 4.0 + 0.3 * bay as f64).collect();
                    frame.columns = vec![frame.columns[0]; storeys];
                    frame.beams = vec![frame.beams[0]; storeys];
                    frame.beam_mass = vec![4000.0; storeys];
                    frame.floor_mass = vec![0.0; storeys];
                    frame.column_segments = segments[0];
                    frame.beam_segments = vec![segments[1]; bays];
                    frame.axial = Axial {
                        columns_flexible: axial[0],
                        beams_flexible: axial[1],
                    };
                    None
                });
                let sweep = RiccatiSweep::new(&building);
                ways.extend(sweep.batched.reaches());
                bands += usize::from(sweep.band.is_some());
                let order = building.equations.len();
                short += usize::from(order < sweep.batched.least_length());
                let one_by_one = RiccatiSweep {
                    batched: BatchedChains::default(),
                    band: None,
                    ..sweep.clone()
                };
                let matrix = StepMatrix::new(1.0, 4e6);
                let tangents = building.equations.initial_tangents();
                let load = (0..order).map(|dof| (0.7 * dof as f64).sin());
                let answer = |sweep: &RiccatiSweep| {
                    let mut factor = RiccatiFactor::default();
                    let found = sweep.factorize(&matrix, &tangents, &mut factor);
                    found.expect("a standing frame");
                    let mut wide: Vec<f64> = load.clone().collect();
                    let mut scratch = RiccatiScratch::default();
                    sweep.solve(&factor, &mut wide, &mut scratch);
                    if order >= sweep.batched.least_length() {
                        let mut narrow: Vec<f64> = load.clone().collect();
                        sweep.substitute_in_narrow_registers(&factor, &mut narrow, &mut scratch);
                        assert_eq!(wide, narrow, "registers of any width, the same bits");
                    }
                    wide
                };
                let (got, expected) = (answer(&sweep), answer(&one_by_one));
                let most = expected.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
                for (got, expected) in got.iter().zip(&expected) {
                    let case = format!("{storeys} storeys, {bays} bays, {segments:?}, {axial:?}");
                    assert!((got - expected).abs() <= 1e-12 * most, "{case}");
                }
            }
        }
        assert_eq!(ways.len(), 4, "{ways:?}");
        assert!(bands > 0 && bands < 21, "{bands} of 21 have a band");
        assert!(short > 0, "none is smaller than a register");
    }

    /// Hinges that change one after another, and back, give the factor of the full matrix bit by bit.
    #[test]
    fn a_factor_brought_up_to_date_is_a_new_one() {
        let building = frame_with(|frame| {
            let corners = Corners::bilinear(1e5, 0.02);
            let backbone = Backbone::from_forces(3e8, corners, corners).expect("sound");
            let hinge = Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("sound");
            let members = |count: usize| vec![vec![hinge; count]; frame.columns.len()];
            Some(Hinges::Frame(FrameHinges {
                columns: members(frame.spans.len() + 1),
                beams: members(frame.spans.len()),
                ..FrameHinges::default()
            }))
        });
        let sweep = RiccatiSweep::new(&building);
        let matrix = StepMatrix::new(1.02, 4e6);
        let mut tangents = building.equations.initial_tangents();
        let initial = tangents.clone();
        assert_eq!(tangents.len(), 30);
        let mut factor = RiccatiFactor::default();
        let solution = |factor: &RiccatiFactor| {
            let loads = 0..building.equations.len();
            let mut load: Vec<f64> = loads.map(|dof| (0.7 * dof as f64).sin()).collect();
            sweep.solve(factor, &mut load, &mut RiccatiScratch::default());
            load
        };
        let sound = sweep.factorize(&matrix, &tangents, &mut factor);
        sound.expect("a standing frame");
        let untouched = solution(&factor);
        for step in 0..60 {
            // Two at a time, thirty times to yield and thirty times back.
            let changed = [(7 * step) % 30, (7 * step + 11) % 30];
            for spring in changed {
                tangents[spring] = if step < 30 {
                    0.02 * initial[spring]
                } else {
                    initial[spring]
                };
            }
            let sound = sweep.update(&matrix, &tangents, &changed, &mut factor);
            sound.expect("a standing frame");
            let mut fresh = RiccatiFactor::default();
            let sound = sweep.factorize(&matrix, &tangents, &mut fresh);
            sound.expect("a standing frame");
            assert_eq!(solution(&factor), solution(&fresh), "{step}");
            assert_eq!(
                solution(&factor) == untouched,
                tangents == initial,
                "{step}"
            );
        }
        assert_eq!(tangents, initial);
    }
}
