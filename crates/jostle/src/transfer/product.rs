//! The total transfer equation: a frame solved only by products of transfer matrices.
//!
//! This is how the method was published for pounding frames (Zhang et al. 2019, doi:10.1155/2019/5706015; the
//! equations are derived again, see docs/theory.md, section 6). All column lines but the last are traversed upwards
//! from their bases, all beams from left to right, the last column line downwards from its top. The unknowns are
//! the base forces of the lines traversed upwards and the states at the left ends of the beams: (n − 1)(6m + 3)
//! numbers for n column lines and m floors. Every beam end gives three equations, H z = H v, every top three more,
//! **b** = 0, and the last base another three, **a** = 0.
//!
//! Exact in theory, it loses digits with every segment (Eq. R0), and more at smaller steps: see [`digits_left`]. It
//! serves for comparison with the literature, and shows why the Riccati form is needed.

use super::digits::{DIGITS_WANTED, digits_left};
use super::layout::{Layout, NotAFrame};
use super::riccati::RiccatiSweep;
use super::{Heading, StateVector, Transfer, apart, one_in_two_out, two_in_one_out};
use crate::linear::full_matrix::{FullMatrix, PivotedLu};
use crate::linear::{NotPositive, StepMatrix};
use crate::model::Integrator;
use crate::structure::AssembledBuilding;
use crate::structure::{StepEquations, solve_once};

/// The total transfer equation of one building, K̂ y = r with K̂ = κ K + g M solved by products of transfer
/// matrices.
///
/// Call [`ProductEquations::check`] before using it.
#[derive(Clone, Debug)]
pub struct ProductEquations {
    layout: Result<Layout, NotAFrame>,
    order: usize,
}

/// Transfer matrices and the factorised total matrix for one step size.
#[derive(Clone, Debug, Default)]
pub struct ProductFactor {
    /// Per column line and index from the first above the base: the link below, and the lumped mass.
    columns: Vec<Vec<[Transfer; 2]>>,
    /// Per beam and link: the link, and the lumped mass at its right end.
    beams: Vec<Vec<[Transfer; 2]>>,
    /// U_all; `None` if it has overflowed.
    total: Option<PivotedLu>,
}

/// Reason why the total transfer equation should not be used for a building and a step.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProductRefusal {
    /// No path of transfer matrices leads through the building.
    #[error(
        "the product of transfer matrices needs a plane frame or a shear building: {0}; use solver = \"riccati\" or \"stiffness\""
    )]
    NotAFrame(#[from] NotAFrame),
    /// Rounding errors would exceed the result.
    #[error(
        "the product of transfer matrices would keep about {digits_left:.0} of 16 digits of \"{building}\" in this step, and {wanted:.0} are needed; use solver = \"riccati\", which loses none, or longer steps, fewer segments or fewer storeys"
    )]
    DigitsLost {
        /// Name of the building.
        building: String,
        /// Digits expected to be right, negative if even the order of magnitude is lost \[–\].
        digits_left: f64,
        /// Digits needed \[–\].
        wanted: f64,
    },
}

impl ProductEquations {
    /// Whether products of transfer matrices are accurate enough for a building and this matrix.
    ///
    /// # Errors
    /// The building is no frame, or too few digits would be left.
    pub fn check(building: &AssembledBuilding, matrix: &StepMatrix) -> Result<(), ProductRefusal> {
        let layout = Layout::new(building)?;
        head_of_last_line(&layout)?;
        let digits_left = digits_left(building, matrix);
        if digits_left < DIGITS_WANTED {
            return Err(ProductRefusal::DigitsLost {
                building: building.name.clone(),
                digits_left,
                wanted: DIGITS_WANTED,
            });
        }
        Ok(())
    }

    /// The same for a step of a given length \[s\].
    ///
    /// # Errors
    /// As [`ProductEquations::check`].
    pub fn check_step(
        building: &AssembledBuilding,
        integrator: Integrator,
        step: f64,
    ) -> Result<(), ProductRefusal> {
        let step = integrator
            .coefficients(step)
            .of_building(&building.equations);
        Self::check(building, &step.matrix())
    }

    /// Number of equations that remain: (n − 1)(6m + 3) for a frame, 3 for a single column line.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        self.layout.as_ref().map_or(0, unknowns)
    }
}

/// Largest difference between the product and the Riccati recursion, relative to the largest displacement: the
/// actual loss of digits, for one load. Infinite if the product overflows.
///
/// # Errors
/// [`NotPositive`] if the building is a mechanism.
pub fn measured_loss(
    building: &AssembledBuilding,
    matrix: &StepMatrix,
    load: &[f64],
) -> Result<f64, NotPositive> {
    let exact = solve_once::<RiccatiSweep>(building, matrix, load)?;
    let product = solve_once::<ProductEquations>(building, matrix, load)?;
    let largest = exact
        .iter()
        .fold(0.0_f64, |largest, y| largest.max(y.abs()));
    let mut apart = 0.0_f64;
    for (p, e) in product.iter().zip(&exact) {
        let difference = (p - e).abs();
        apart = apart.max(if difference.is_finite() {
            difference
        } else {
            f64::INFINITY
        });
    }
    Ok(if apart > 0.0 { apart / largest } else { 0.0 })
}

impl StepEquations for ProductEquations {
    type Factor = ProductFactor;
    type Scratch = ();

    fn new(building: &AssembledBuilding) -> Self {
        let layout = Layout::new(building).and_then(|layout| {
            head_of_last_line(&layout)?;
            Ok(layout)
        });
        Self {
            layout,
            order: building.equations.len(),
        }
    }

    /// Fails for a building that [`ProductEquations::check`] rejects because it is not a frame. A matrix that is
    /// not positive definite is not detected.
    fn factorize(
        &self,
        matrix: &StepMatrix,
        _tangents: &[f64],
        factor: &mut ProductFactor,
    ) -> Result<(), NotPositive> {
        let Ok(layout) = &self.layout else {
            return Err(NotPositive { dof: 0 });
        };
        let mass = |node: usize| layout.mass(node, matrix.mass);
        factor.columns.clear();
        for (column, line) in layout.columns.iter().enumerate() {
            let heading = if is_last(layout, column) {
                Heading::Down
            } else {
                Heading::Up
            };
            let places = line.links.iter().zip(&line.nodes[1..]);
            factor.columns.push(
                places
                    .map(|(&link, &node)| [layout.transfer(link, heading, matrix), mass(node)])
                    .collect(),
            );
        }
        factor.beams.clear();
        for beam in &layout.beams {
            let places = beam.links.iter().zip(&beam.nodes[1..]);
            factor.beams.push(
                places
                    .map(|(&link, &node)| {
                        [layout.transfer(link, Heading::Right, matrix), mass(node)]
                    })
                    .collect(),
            );
        }
        // A column of U_all is the residual at joints, tops and bases due to a unit of one unknown.
        let n = unknowns(layout);
        let mut total = FullMatrix::zeros(n, n);
        let mut unit = vec![0.0; n];
        for column in 0..n {
            unit[column] = 1.0;
            let passage = Passage::through(layout, factor, &unit, None);
            for (row, left) in passage.left_over.iter().enumerate() {
                total[(row, column)] = *left;
            }
            unit[column] = 0.0;
        }
        factor.total = total.is_finite().then(|| PivotedLu::new(total));
        Ok(())
    }

    /// Allocates memory; not optimised. All displacements are NaN if the products have overflowed.
    fn solve(&self, factor: &ProductFactor, load: &mut [f64], (): &mut ()) {
        let load = &mut load[..self.order];
        let (Ok(layout), Some(total)) = (&self.layout, &factor.total) else {
            load.fill(f64::NAN);
            return;
        };
        let n = unknowns(layout);
        let mut unknown = Passage::through(layout, factor, &vec![0.0; n], Some(load)).left_over;
        unknown.iter_mut().for_each(|left| *left = -*left);
        let passage = Passage::through(layout, factor, &total.solve(&unknown), Some(load));
        for (node, carried) in layout.carried.iter().enumerate() {
            for (dof, displacement) in carried.iter().zip(passage.displacements[node]) {
                if let Some(dof) = dof {
                    load[*dof] = displacement;
                }
            }
        }
    }
}

/// One propagation along all beams and column lines.
struct Passage {
    /// Displacements of every node.
    displacements: Vec<[f64; 3]>,
    /// Residuals of the equations at joints, tops and the last base.
    left_over: Vec<f64>,
}

impl Passage {
    fn through(
        layout: &Layout,
        factor: &ProductFactor,
        unknown: &[f64],
        load: Option<&[f64]>,
    ) -> Self {
        let mut passage = Self {
            displacements: vec![[0.0; 3]; layout.carried.len()],
            left_over: Vec::with_capacity(unknown.len()),
        };
        let loaded = |mass: &Transfer, node: usize| -> Transfer {
            let mut mass = *mass;
            if let Some(load) = load {
                let [f_x, f_y, f_m] =
                    layout.carried[node].map(|dof| dof.map_or(0.0, |dof| load[dof]));
                mass.load = [0.0, 0.0, 0.0, f_m, f_x, f_y];
            }
            mass
        };
        // Beams, from left to right.
        let first_beam = 3 * upward_lines(layout);
        let mut beam_ends = Vec::with_capacity(layout.beams.len());
        for (index, beam) in layout.beams.iter().enumerate() {
            let at = first_beam + 6 * index;
            let left = StateVector::from_array(std::array::from_fn(|k| unknown[at + k]));
            let mut z = left;
            for (place, [link, mass]) in factor.beams[index].iter().enumerate() {
                z = link.apply(z);
                let node = beam.nodes[place + 1];
                if place + 1 < beam.links.len() {
                    passage.displacements[node] = z.displacements();
                    z = loaded(mass, node).apply(z);
                }
            }
            beam_ends.push([left, z]);
        }
        let nothing = StateVector::default();
        for (column, line) in layout.columns.iter().enumerate() {
            let beams_at_joint = &layout.beams_at_joint[column];
            let right_end =
                |place: usize| beams_at_joint[place][0].map(|beam: usize| beam_ends[beam][1]);
            let left_end =
                |place: usize| beams_at_joint[place][1].map(|beam: usize| beam_ends[beam][0]);
            if is_last(layout, column) {
                // Downwards; the beam at the top continues into the line.
                let head = line.nodes.len() - 1;
                let mut v = right_end(head).unwrap_or(nothing);
                for place in (1..=head).rev() {
                    let [link, mass] = &factor.columns[column][place - 1];
                    let mass = loaded(mass, line.nodes[place]);
                    passage.displacements[line.nodes[place]] = v.displacements();
                    v = match right_end(place).filter(|_| place < head) {
                        Some(beam) => {
                            passage.left_over.extend(apart(beam, v));
                            two_in_one_out(&mass, v, beam)
                        }
                        None => mass.apply(v),
                    };
                    v = link.apply(v);
                }
                passage.left_over.extend(v.displacements());
            } else {
                let mut w = StateVector::at_base(std::array::from_fn(|k| unknown[3 * column + k]));
                for place in 1..line.nodes.len() {
                    let [link, mass] = &factor.columns[column][place - 1];
                    let v = link.apply(w);
                    passage.displacements[line.nodes[place]] = v.displacements();
                    let mass = loaded(mass, line.nodes[place]);
                    let (left, right) = (right_end(place), left_end(place));
                    for end in [left, right].into_iter().flatten() {
                        passage.left_over.extend(apart(end, v));
                    }
                    w = one_in_two_out(&mass, v, right.unwrap_or(nothing))
                        + left.unwrap_or(nothing).forces_only();
                }
                passage.left_over.extend(w.forces());
            }
        }
        passage
    }
}

fn is_last(layout: &Layout, column: usize) -> bool {
    layout.columns.len() > 1 && column + 1 == layout.columns.len()
}

fn upward_lines(layout: &Layout) -> usize {
    (layout.columns.len() - 1).max(1)
}

fn unknowns(layout: &Layout) -> usize {
    3 * upward_lines(layout) + 6 * layout.beams.len()
}

/// The last of several column lines is entered from a beam.
fn head_of_last_line(layout: &Layout) -> Result<(), NotAFrame> {
    let last = layout.columns.len() - 1;
    let head = layout.columns[last].nodes.len() - 1;
    if last > 0 && layout.beams_at_joint[last][head][0].is_none() {
        let node = layout.columns[last].nodes[head];
        return Err(NotAFrame::HeadWithoutBeam { node });
    }
    Ok(())
}
