//! A building in plan by the matrices of another program.

use super::{MatrixEntry, PlanPoint, Tier, Tiers};
use crate::linear::sparse_cholesky::{NoPivot, Pattern, SparseFactor};

/// Stiffness and damping over the motions of all floors of a building in plan: u_x, u_y and θ of each at its centre of mass, from the
/// ground up, relative to what the building stands on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FloorMatrices {
    /// K, symmetric and positive definite: rows of the lower triangle \[N/m, N, N·m\].
    pub stiffness: Vec<Vec<f64>>,
    /// C, symmetric: likewise, or empty where [`Building::damping`](super::Building::damping) describes all damping. Both add up
    /// \[N·s/m, N·s, N·m·s\].
    pub damping: Vec<Vec<f64>>,
}

/// A building in plan by the matrices of M ü + C u̇ + K u = −M r a_g, as another program has them: over x, y and θ of a point of every
/// floor, and over displacements without mass.
///
/// ```
/// use jostle::{GivenFloor, GivenInPlan};
///
/// // 40 t at the middle of 8 m × 6 m; the matrices are those of the origin of the plan.
/// let plan = vec![[0.0, 0.0], [8.0, 0.0], [8.0, 6.0], [0.0, 6.0]];
/// let (mass, polar) = (40e3, 40e3 * 100.0 / 12.0);
/// let given = GivenInPlan {
///     mass: vec![
///         (0, 0, mass),
///         (1, 1, mass),
///         (2, 0, -3.0 * mass),
///         (2, 1, 4.0 * mass),
///         (2, 2, polar + 25.0 * mass),
///     ],
///     stiffness: vec![(0, 0, 60e6), (1, 1, 60e6), (2, 0, -180e6), (2, 1, 240e6), (2, 2, 3e9)],
///     floors: vec![GivenFloor { dofs: [0, 1, 2], at: [0.0, 0.0], height: 3.0, plan }],
///     ..GivenInPlan::default()
/// };
/// let tiers = given.tiers().expect("a building");
/// assert_eq!(tiers.floors[0].centre, [4.0, 3.0]);
/// assert!((tiers.floors[0].polar_mass / polar - 1.0).abs() < 1e-12);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GivenInPlan {
    /// M: symmetric, without coupling between floors \[kg, kg·m, kg·m²\].
    pub mass: Vec<MatrixEntry>,
    /// K: symmetric, positive definite \[N/m, N, N·m\].
    pub stiffness: Vec<MatrixEntry>,
    /// C: symmetric, nothing at displacements without mass; may be empty \[N·s/m, N·s, N·m·s\].
    pub damping: Vec<MatrixEntry>,
    /// Angle from x of the site to x of the matrices, counter-clockwise \[rad\].
    pub angle: f64,
    /// Floors, from the ground up.
    pub floors: Vec<GivenFloor>,
}

/// A floor of such a building.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenFloor {
    /// Its displacements along x and across, in the axes of the matrices, and its rotation, counter-clockwise, counted from 0.
    pub dofs: [usize; 3],
    /// The point that they move, on the site \[m\].
    pub at: PlanPoint,
    /// Height above the base, rising from floor to floor \[m\].
    pub height: f64,
    /// Corners on the site, counter-clockwise \[m\].
    pub plan: Vec<PlanPoint>,
}

/// Masses along x and across, and entries that should be zero, may differ by so much of the mass \[–\].
const ROUNDED: f64 = 1e-9;

/// Masses along x and across may differ by so much; programs print six digits or more \[–\].
const SAME_MASS: f64 = 1e-6;

/// Least stiffness that holds a floor, in parts of that of its displacements one by one \[–\].
const HELD: f64 = 1e-13;

/// Names of the displacements of a floor.
const COMPONENTS: [&str; 3] = ["x", "y", "rotation"];

impl GivenInPlan {
    /// The building: displacements without mass condensed, every floor about its centre of mass.
    ///
    /// # Errors
    /// What cannot be part of such a building, with floor, entry and remedy. Displacements are counted from 1.
    pub fn tiers(&self) -> Result<Tiers, String> {
        let order = self.order();
        let mut place_of = vec![None; order];
        for (place, dof) in self.floors.iter().flat_map(|floor| floor.dofs).enumerate() {
            if dof >= order {
                return Err(format!(
                    "have {order} rows, and floor {} has displacement {}",
                    place / 3 + 1,
                    dof + 1
                ));
            }
            if let Some(other) = place_of[dof].replace(place) {
                return Err(format!(
                    "have displacement {} both as {} and as {}; give every displacement once",
                    dof + 1,
                    displacement_in_words(other),
                    displacement_in_words(place)
                ));
            }
        }
        let floors = self.floor_masses(&place_of)?;
        let pairs = self.floors.iter().zip(&floors);
        let motions: Vec<[[f64; 3]; 3]> = pairs
            .map(|(floor, tier)| motion_of(floor.at, tier.centre, self.direction()))
            .collect();
        let stiffness = about_centres(&self.condensed(&place_of)?, &motions);
        let damping = match self.damping.is_empty() {
            true => Vec::new(),
            false => about_centres(&self.damping_of_floors(&place_of)?, &motions),
        };
        let mut below = 0.0;
        let heights = self.floors.iter().map(|floor| floor.height);
        Ok(Tiers {
            floors,
            storey_heights: heights
                .map(|height| height - std::mem::replace(&mut below, height))
                .collect(),
            matrices: Some(FloorMatrices { stiffness, damping }),
            ..Tiers::default()
        })
    }

    /// Direction of x of the matrices.
    fn direction(&self) -> PlanPoint {
        [libm::cos(self.angle), libm::sin(self.angle)]
    }

    /// Number of displacements.
    fn order(&self) -> usize {
        let entries = self.mass.iter().chain(&self.stiffness).chain(&self.damping);
        entries.map(|(row, ..)| row + 1).max().unwrap_or(0)
    }

    /// Masses and centres: M_xx = M_yy = m, M_xθ = −m (c_y − a_y), M_yθ = m (c_x − a_x), M_θθ = J + m |c − a|² at a point a, in the axes
    /// of the matrices.
    fn floor_masses(&self, place_of: &[Option<usize>]) -> Result<Vec<Tier>, String> {
        let mut blocks = vec![[[0.0; 3]; 3]; self.floors.len()];
        let diagonal = |dof: usize| {
            let mass = self.mass.iter().filter(|e| (e.0, e.1) == (dof, dof));
            mass.map(|entry| entry.2).sum::<f64>()
        };
        let greatest = self.mass.iter().fold(0.0_f64, |most, e| most.max(e.2));
        for &(row, column, value) in &self.mass {
            let (Some(a), Some(b)) = (place_of[row], place_of[column]) else {
                if value.abs() <= ROUNDED * greatest {
                    continue;
                }
                let dof = if place_of[row].is_none() { row } else { column };
                return Err(format!(
                    "have a mass in row {}, column {}, and displacement {} is none of a floor; condense the model in the other program, with all mass at its floors",
                    row + 1,
                    column + 1,
                    dof + 1
                ));
            };
            if a / 3 == b / 3 {
                blocks[a / 3][a % 3][b % 3] += value;
                if row != column {
                    blocks[a / 3][b % 3][a % 3] += value;
                }
            } else if value.abs() > ROUNDED * (diagonal(row) * diagonal(column)).sqrt() {
                return Err(format!(
                    "have {value:e} in row {}, column {} of M, which couples {} and {}; lump masses at floors (a lumped mass matrix in the other program)",
                    row + 1,
                    column + 1,
                    displacement_in_words(a),
                    displacement_in_words(b)
                ));
            }
        }
        let all = self.floors.iter().zip(&blocks).enumerate();
        all.map(|(floor, (given_floor, block))| {
            tier_of(floor, given_floor, block, self.direction())
        })
        .collect()
    }

    /// K over the displacements of floors: K_ff − K_fb K_bb⁻¹ K_bf, all rows.
    fn condensed(&self, place_of: &[Option<usize>]) -> Result<Vec<Vec<f64>>, String> {
        let n = 3 * self.floors.len();
        let mut inner_of = vec![None; place_of.len()];
        let mut inner = Vec::new();
        for dof in (0..place_of.len()).filter(|dof| place_of[*dof].is_none()) {
            inner_of[dof] = Some(inner.len());
            inner.push(dof);
        }
        let mut rows = vec![vec![0.0; n]; n];
        let mut columns = vec![vec![0.0; inner.len()]; n];
        let mut entries: Vec<MatrixEntry> = (0..inner.len()).map(|k| (k, k, 0.0)).collect();
        for &(row, column, value) in &self.stiffness {
            match (
                place_of[row],
                place_of[column],
                inner_of[row],
                inner_of[column],
            ) {
                (Some(a), Some(b), ..) => {
                    rows[a][b] += value;
                    if row != column {
                        rows[b][a] += value;
                    }
                }
                (Some(a), None, _, Some(k)) | (None, Some(a), Some(k), _) => columns[a][k] += value,
                (_, _, Some(k), Some(l)) => entries.push((k.max(l), k.min(l), value)),
                _ => {}
            }
        }
        if inner.is_empty() {
            return Ok(rows);
        }
        let places: Vec<(usize, usize)> = entries.iter().map(|entry| (entry.0, entry.1)).collect();
        let pattern = Pattern::new(inner.len(), &places);
        let mut factor = SparseFactor::default();
        let values = entries.iter().map(|entry| entry.2);
        if let Err(NoPivot(inside)) = pattern.factorize(values, &mut factor) {
            return Err(format!(
                "have displacement {}, which no port names and which can move without resistance; leave out displacements without stiffness, or make it one of a port",
                inner[inside] + 1
            ));
        }
        for a in 0..n {
            let mut moved = columns[a].clone();
            pattern.solve(&factor, &mut moved);
            for b in 0..n {
                let taken = columns[b].iter().zip(&moved).map(|(k, u)| k * u);
                rows[b][a] -= taken.sum::<f64>();
            }
        }
        Ok(rows)
    }

    /// C over the displacements of floors, all rows.
    fn damping_of_floors(&self, place_of: &[Option<usize>]) -> Result<Vec<Vec<f64>>, String> {
        let n = 3 * self.floors.len();
        let mut rows = vec![vec![0.0; n]; n];
        let greatest = self.damping.iter().map(|entry| entry.2.abs());
        let greatest = greatest.fold(0.0, f64::max);
        for &(row, column, value) in &self.damping {
            let (Some(a), Some(b)) = (place_of[row], place_of[column]) else {
                if value.abs() <= ROUNDED * greatest {
                    continue;
                }
                return Err(format!(
                    "have {value:e} in row {}, column {} of C, at a displacement that no port names; condense the model in the other program, or leave out C and give damping",
                    row + 1,
                    column + 1
                ));
            };
            rows[a][b] += value;
            if row != column {
                rows[b][a] += value;
            }
        }
        Ok(rows)
    }
}

/// A displacement of a floor in words, by its place among those of all floors.
pub(crate) fn displacement_in_words(place: usize) -> String {
    format!("{} of floor {}", COMPONENTS[place % 3], place / 3 + 1)
}

/// Motion of a point, in axes with this direction of x, per motion of a floor at its centre, in those of the site.
fn motion_of(at: PlanPoint, centre: PlanPoint, [c, s]: PlanPoint) -> [[f64; 3]; 3] {
    let (x, y) = (at[0] - centre[0], at[1] - centre[1]);
    [
        [c, s, s * x - c * y],
        [-s, c, c * x + s * y],
        [0.0, 0.0, 1.0],
    ]
}

/// Mass and centre of a floor, from 0.
fn tier_of(
    floor: usize,
    given_floor: &GivenFloor,
    block: &[[f64; 3]; 3],
    [c, s]: PlanPoint,
) -> Result<Tier, String> {
    let [[along, coupled, _], [_, across, _], [_, _, turning]] = *block;
    let number = |component: usize| given_floor.dofs[component] + 1;
    let floor = floor + 1;
    for (component, mass) in [along, across, turning].into_iter().enumerate() {
        if mass <= 0.0 || !mass.is_finite() {
            return Err(format!(
                "have no mass at displacement {}, {} of floor {floor}; a floor that can be hit needs mass along x, across and in rotation",
                number(component),
                COMPONENTS[component]
            ));
        }
    }
    let mass = 0.5 * (along + across);
    if (along - across).abs() > SAME_MASS * mass {
        return Err(format!(
            "have {along:e} in row {0}, column {0} of M and {across:e} in row {1}, column {1}, the masses of floor {floor} along x and across; a floor has one mass in all directions: take what moves one way alone to the floors where it is held",
            number(0),
            number(1)
        ));
    }
    if coupled.abs() > ROUNDED * mass {
        return Err(format!(
            "have {coupled:e} in row {}, column {} of M, which couples x and y of floor {floor}; lump masses at points of the floor",
            number(1),
            number(0)
        ));
    }
    let arm = [block[2][1] / mass, -block[2][0] / mass];
    let polar_mass = turning - mass * (arm[0] * arm[0] + arm[1] * arm[1]);
    if polar_mass <= ROUNDED * turning {
        return Err(format!(
            "have {turning:e} in row {0}, column {0} of M, the polar mass of floor {floor} about its reference point; its mass alone, {mass:e} at {arm:.3} m from there, has more: check the units of rotations and the signs of what couples them",
            number(2),
            arm = libm::hypot(arm[0], arm[1])
        ));
    }
    Ok(Tier {
        mass,
        polar_mass,
        centre: [
            given_floor.at[0] + c * arm[0] - s * arm[1],
            given_floor.at[1] + s * arm[0] + c * arm[1],
        ],
        plan: given_floor.plan.clone(),
    })
}

/// Tᵀ A T, the rows of its lower triangle; T are motions of reference points per motion of their floors.
fn about_centres(rows: &[Vec<f64>], motions: &[[[f64; 3]; 3]]) -> Vec<Vec<f64>> {
    let entry = |i: usize, j: usize| -> f64 {
        let (a, b) = (&motions[i / 3], &motions[j / 3]);
        let (first, second) = (3 * (i / 3), 3 * (j / 3));
        let terms = (0..3).flat_map(|k| (0..3).map(move |l| (k, l)));
        let terms = terms.map(|(k, l)| {
            let mean = 0.5 * (rows[first + k][second + l] + rows[second + l][first + k]);
            a[k][i % 3] * b[l][j % 3] * mean
        });
        terms.sum()
    };
    (0..rows.len())
        .map(|i| (0..=i).map(|j| entry(i, j)).collect())
        .collect()
}

impl FloorMatrices {
    /// The first displacement of a floor, by its place among those of all floors, that can move without resistance.
    pub(crate) fn loose(&self) -> Option<usize> {
        let entries = self.stiffness.iter().enumerate().flat_map(|(row, values)| {
            let columns = values.iter().enumerate();
            columns.map(move |(column, value)| {
                // What only rounding holds is loose.
                let kept = if row == column { 1.0 - HELD } else { 1.0 };
                ((row, column), kept * value)
            })
        });
        let (places, values): (Vec<_>, Vec<f64>) = entries.unzip();
        let pattern = Pattern::new(self.stiffness.len(), &places);
        let mut factor = SparseFactor::default();
        let found = pattern.factorize(values.into_iter(), &mut factor);
        found.err().map(|NoPivot(place)| place)
    }
}
