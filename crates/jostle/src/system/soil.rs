//! Buildings on the soil: springs at the period that these springs give, and springs between neighbours.

use super::BuildingSystem;
use super::half_space::{Rectangle, influence};
use crate::eigen::Mode;
use crate::interface::{LinkElement, Port, PortPair};
use crate::linear::Row;
use crate::linear::full_matrix::{FullMatrix, PivotedLu};
use crate::model::{
    Building, Damping, Foundation, FoundationSprings, Gravity, GroundSprings, HalfSpace, LinkLaw,
    MassDamping, Model, SoilCoupling,
};
use crate::structure::{Discretization, Equations, RigidFoundation, StruckPoints, Subgrade};

/// The foundation of a building of a system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundationPlace {
    /// Degree of freedom of its displacement in the vectors of a [`crate::State`]; `None` if it is held.
    pub sway: Option<usize>,
    /// Degree of freedom of its rotation there.
    pub turning: usize,
    /// Degree of freedom of its rise there; `None` if it cannot lift off.
    pub rise: Option<usize>,
    /// How far its middle lies to the right of the point that it rises with \[m\].
    pub middle: f64,
    /// Its dimensions.
    pub foundation: Foundation,
    /// Springs and dashpots under it, without neighbours. Of given matrices, those of this foundation alone.
    pub springs: FoundationSprings,
    /// First lateral period on rigid ground \[s\].
    pub fixed_period: f64,
    /// First lateral period on its springs, without neighbours \[s\].
    pub period: f64,
    /// Damping ratio of the first lateral mode on rigid ground \[–\].
    pub fixed_damping: f64,
    /// Damping ratio of the first lateral mode on springs and dashpots, φᵀCφ/(2ω φᵀMφ) \[–\].
    pub damping: f64,
    /// Stiffness of the soil over displacement and rotation in the equations of the building, without that of
    /// [`System::soil_links`](super::System::soil_links): uu, uθ, θθ \[N/m, N, N·m\].
    pub own_stiffness: [f64; 3],
    /// Dashpots of the soil over the same \[N·s/m, N·s, N·m·s\].
    pub own_damping: [f64; 3],
}

/// What a building on soil is assembled from.
pub(super) struct Founded {
    /// Rayleigh damping of motion relative to the foundation.
    pub(super) damping: Damping,
    pub(super) springs: FoundationSprings,
    fixed_period: f64,
    fixed_damping: f64,
    under: Subgrade,
}

/// Relative change of the period at which the search for it ends.
pub(super) const SAME_PERIOD: f64 = 1e-13;
/// Most steps of this search; it gains several digits in each.
pub(super) const MOST_STEPS: usize = 60;

/// Soil under a building: given matrices, a half-space, or springs of the foundation alone.
pub(super) enum Ground<'a> {
    HalfSpace(&'a HalfSpace),
    Springs(GroundSprings),
    /// Stiffness and dashpots of one foundation: uu, uθ, θθ.
    Given([[f64; 3]; 2]),
}

impl<'a> Ground<'a> {
    /// Under a foundation, the one of this number of those on the soil of the model.
    pub(super) fn of(model: &'a Model, foundation: &Foundation, number: usize) -> Option<Self> {
        if let Some(ground) = foundation.uplift.and_then(|uplift| uplift.ground) {
            return Some(Self::Springs(ground));
        }
        let soil = model.soil.as_ref()?;
        match &soil.coupling {
            SoilCoupling::Given { stiffness, damping } => {
                let block = |matrix: &[Vec<f64>]| {
                    let (u, turn) = (2 * number, 2 * number + 1);
                    Some([
                        *matrix.get(u)?.get(u)?,
                        *matrix.get(u)?.get(turn)?,
                        *matrix.get(turn)?.get(turn)?,
                    ])
                };
                Some(Self::Given([block(stiffness)?, block(damping)?]))
            }
            SoilCoupling::None | SoilCoupling::Static => {
                soil.half_space.as_ref().map(Self::HalfSpace)
            }
        }
    }

    /// Springs and dashpots of a foundation in motions of a period \[s\].
    pub(super) fn springs(&self, foundation: &Foundation, period: f64) -> FoundationSprings {
        match self {
            Self::HalfSpace(soil) => soil.springs(foundation, period),
            Self::Given([stiffness, damping]) => FoundationSprings {
                sway_stiffness: stiffness[0],
                sway_damping: damping[0],
                rocking_stiffness: stiffness[2],
                rocking_damping: damping[2],
                ..FoundationSprings::default()
            },
            Self::Springs(springs) => {
                let [sway_stiffness, sway_damping] = springs.sway.unwrap_or_default();
                FoundationSprings {
                    sway_stiffness,
                    sway_damping,
                    vertical_stiffness: springs.vertical_stiffness,
                    vertical_damping: springs.vertical_damping,
                    ..FoundationSprings::default()
                }
            }
        }
    }

    /// What stands under a foundation with these springs, whose rocking becomes that of its contact springs if it can lift off.
    ///
    /// # Errors
    /// Contact springs that the soil does not allow.
    fn under(
        &self,
        foundation: &Foundation,
        springs: &mut FoundationSprings,
    ) -> Result<Subgrade, String> {
        let sways = !matches!(self, Self::Springs(GroundSprings { sway: None, .. }));
        let subgrade = |springs: &FoundationSprings, bed| Subgrade {
            stiffness: [springs.sway_stiffness, 0.0, springs.rocking_stiffness],
            damping: [springs.sway_damping, 0.0, springs.rocking_damping],
            sways,
            bed,
            vertical_damping: springs.vertical_damping,
        };
        match self {
            Self::Given([stiffness, damping]) => Ok(Subgrade {
                stiffness: *stiffness,
                damping: *damping,
                ..subgrade(springs, Vec::new())
            }),
            _ if foundation.uplift.is_none() => Ok(Subgrade {
                vertical_damping: 0.0,
                ..subgrade(springs, Vec::new())
            }),
            _ => {
                let rocking =
                    matches!(self, Self::HalfSpace(_)).then_some(springs.rocking_stiffness);
                let bed = foundation.bed(springs.vertical_stiffness, rocking)?;
                let turned = bed.iter().map(|bed| bed.stiffness * bed.at * bed.at);
                springs.rocking_stiffness = turned.sum();
                if rocking.is_none() {
                    // Dashpots stand beside the springs, and share their sum as they do.
                    let ratio = springs.vertical_damping / springs.vertical_stiffness;
                    springs.rocking_damping = ratio * springs.rocking_stiffness;
                }
                Ok(subgrade(springs, bed))
            }
        }
    }
}

impl Founded {
    /// Springs of a building at its first period on these springs.
    ///
    /// # Errors
    /// The field of the building, and what is wrong with it.
    pub(super) fn new(
        building: &Building,
        fixed: &BuildingSystem,
        points: &StruckPoints,
        foundation: &Foundation,
        ground: &Ground<'_>,
    ) -> Result<Self, (&'static str, String)> {
        let [alpha, beta] = [fixed.equations.alpha, fixed.equations.beta];
        let unstable = || {
            let problem =
                "the building has no lateral mode on its foundation; are masses and springs right?";
            ("foundation", problem.to_owned())
        };
        let first = fixed.lateral_modes().next().ok_or_else(unstable)?;
        let mut found = Self {
            damping: Damping::Rayleigh { alpha, beta },
            springs: FoundationSprings::default(),
            fixed_period: first.period(),
            fixed_damping: damping_ratio(&fixed.equations, first),
            under: Subgrade::default(),
        };
        let mut period = found.fixed_period;
        for _ in 0..MOST_STEPS {
            found.springs = ground.springs(foundation, period);
            found.under = ground
                .under(foundation, &mut found.springs)
                .map_err(|problem| ("foundation", problem))?;
            let mut standing = Discretization::with_points(building, points);
            standing.put_on_foundation(foundation, &found.under);
            let mut standing = BuildingSystem::new(&building.name, standing);
            let leaning = Gravity {
                preload: false,
                ..building.gravity
            };
            standing
                .put_under_gravity(leaning)
                .map_err(|problem| (problem.field(), problem.to_string()))?;
            let next = standing.lateral_modes().next().ok_or_else(unstable)?;
            let change = next.period() / period - 1.0;
            period = next.period();
            if change.abs() <= SAME_PERIOD || !matches!(ground, Ground::HalfSpace(_)) {
                break;
            }
        }
        Ok(found)
    }

    /// Stands a discretized building on its springs.
    pub(super) fn support(
        &self,
        discretization: &mut Discretization,
        foundation: &Foundation,
        damped: MassDamping,
    ) {
        discretization.put_on_foundation(foundation, &self.under);
        if let (Damping::Rayleigh { alpha, .. }, MassDamping::Support) = (&self.damping, damped) {
            discretization.damp_relative_to_foundation(*alpha);
        }
    }

    /// The place of the foundation in the building that stands on it.
    pub(super) fn place(
        &self,
        building: &BuildingSystem,
        foundation: Foundation,
    ) -> Option<FoundationPlace> {
        let RigidFoundation { node, middle, .. } =
            *building.discretization.stick_model.foundation.as_ref()?;
        let first = building.lateral_modes().next()?;
        Some(FoundationPlace {
            sway: building.equations.horizontal(node),
            turning: building.equations.rotation(node)?,
            rise: building.equations.vertical(node),
            middle,
            foundation,
            springs: self.springs,
            fixed_period: self.fixed_period,
            period: first.period(),
            fixed_damping: self.fixed_damping,
            damping: damping_ratio(&building.equations, first),
            own_stiffness: self.under.stiffness,
            own_damping: self.under.damping,
        })
    }
}

/// φᵀCφ/(2ω φᵀMφ) \[–\].
pub(super) fn damping_ratio(equations: &Equations, mode: &Mode) -> f64 {
    let shape = &mode.shape;
    let modal_mass: f64 = equations
        .mass
        .iter()
        .zip(shape)
        .map(|(m, s)| m * s * s)
        .sum();
    let damped = equations.alpha * modal_mass
        + equations.beta * equations.stiffness.quadratic_form(shape)
        + equations.dashpots.quadratic_form(shape);
    damped / (2.0 * mode.circular_frequency * modal_mass)
}

/// Most pairs of foundations whose influence on each other is integrated.
const MOST_PAIRS: usize = 200;

/// Two foundations and the clear distance between them \[m\].
type Pair = ([Rectangle; 2], f64);

/// Stiffness and dashpots of all foundations, from left to right, over displacement and rotation of each; `None` where the
/// foundations do not act on each other.
///
/// # Errors
/// What is wrong with the coupling.
pub(super) fn matrices(
    model: &Model,
    founded: &[(usize, FoundationPlace)],
) -> Result<Option<[FullMatrix; 2]>, String> {
    let Some(soil) = &model.soil else {
        return Ok(None);
    };
    let n = 2 * founded.len();
    match (&soil.coupling, &soil.half_space) {
        (SoilCoupling::None, _) | (SoilCoupling::Static, None) => Ok(None),
        (SoilCoupling::Given { stiffness, damping }, _) => {
            let full = |rows: &[Vec<f64>]| {
                let mut matrix = FullMatrix::zeros(n, n);
                for (i, row) in rows.iter().enumerate().take(n) {
                    for (j, value) in row.iter().enumerate().take(n) {
                        matrix[(i, j)] = *value;
                    }
                }
                matrix
            };
            Ok(Some([full(stiffness), full(damping)]))
        }
        (SoilCoupling::Static, Some(half_space)) => {
            let mut flexibility = FullMatrix::zeros(n, n);
            let mut damping = FullMatrix::zeros(n, n);
            for (k, (_, place)) in founded.iter().enumerate() {
                let springs = &place.springs;
                flexibility[(2 * k, 2 * k)] = 1.0 / springs.sway_stiffness;
                flexibility[(2 * k + 1, 2 * k + 1)] = 1.0 / springs.rocking_stiffness;
                damping[(2 * k, 2 * k)] = springs.sway_damping;
                damping[(2 * k + 1, 2 * k + 1)] = springs.rocking_damping;
            }
            let mut known: Vec<(Pair, [f64; 2])> = Vec::new();
            for right in 1..founded.len() {
                for left in 0..right {
                    let [(a, one), (b, other)] = [&founded[left], &founded[right]];
                    let distance = clear_distance(model, *a, *b)?;
                    let mut rectangles = [one, other].map(|place| Rectangle {
                        length: place.foundation.length,
                        width: place.foundation.width,
                    });
                    // Two rectangles influence each other as their mirror image does.
                    let of = |rectangle: &Rectangle| (rectangle.length, rectangle.width);
                    if of(&rectangles[0]) > of(&rectangles[1]) {
                        rectangles.reverse();
                    }
                    // Rows of equal foundations have few pairs that differ.
                    let pair = (rectangles, distance);
                    let same = known.iter().find(|(known, _)| *known == pair);
                    let found = match same {
                        Some((_, found)) => *found,
                        None if known.len() == MOST_PAIRS => {
                            return Err(format!(
                                "has more than {MOST_PAIRS} pairs of foundations that differ in size or distance; give the matrices instead: coupling = {{ stiffness = …, damping = … }}"
                            ));
                        }
                        None => {
                            let found = influence(half_space, rectangles, distance);
                            known.push((pair, [found.sway, found.rocking]));
                            [found.sway, found.rocking]
                        }
                    };
                    for (k, value) in found.into_iter().enumerate() {
                        flexibility[(2 * left + k, 2 * right + k)] = value;
                        flexibility[(2 * right + k, 2 * left + k)] = value;
                    }
                }
            }
            let factors = PivotedLu::new(flexibility);
            let mut stiffness = FullMatrix::zeros(n, n);
            for column in 0..n {
                let mut unit = vec![0.0; n];
                unit[column] = 1.0;
                for (row, value) in factors.solve(&unit).into_iter().enumerate() {
                    // Sway and rocking do not act on each other.
                    if (row + column).is_multiple_of(2) {
                        stiffness[(row, column)] = value;
                    }
                }
            }
            for row in 0..n {
                for column in 0..row {
                    let mean = 0.5 * (stiffness[(row, column)] + stiffness[(column, row)]);
                    stiffness[(row, column)] = mean;
                    stiffness[(column, row)] = mean;
                }
            }
            Ok(Some([stiffness, damping]))
        }
    }
}

/// Clear distance between the foundations of two buildings of the row, > 0: gaps, and the foundations between them \[m\].
///
/// # Errors
/// Which dimension is missing.
fn clear_distance(model: &Model, left: usize, right: usize) -> Result<f64, String> {
    let mut sum = 0.0;
    for building in left..right {
        sum += model.between_foundations(building)?;
        if building > left
            && let Some(foundation) = model.buildings[building].base.foundation
        {
            sum += foundation.length;
        }
    }
    Ok(sum)
}

/// The soil under every foundation apart from springs and dashpots between two of them.
pub(super) struct Split {
    /// Stiffness and dashpots of every foundation: uu, uθ, θθ.
    pub(super) own: Vec<[[f64; 3]; 2]>,
    /// Springs and dashpots between foundations left and right: shares of their displacements and rotations, stiffness and
    /// damping.
    pub(super) between: Vec<Between>,
}

/// A spring or a dashpot between two foundations.
pub(super) struct Between {
    pub(super) foundations: [usize; 2],
    pub(super) shares: [[f64; 2]; 2],
    pub(super) stiffness: f64,
    pub(super) damping: f64,
}

/// Divides matrices over all foundations into a positive definite part of each and springs between two, all positive: with
/// A = L Lᵀ of the left foundation, C = M Mᵀ of the right one and L⁻¹BM⁻ᵀ = UΣVᵀ, B couples by springs σ over Uᵀ Lᵀ x and
/// −Vᵀ Mᵀ y.
///
/// # Errors
/// The foundation for which nothing positive is left.
pub(super) fn split(matrices: &[FullMatrix; 2], count: usize) -> Result<Split, usize> {
    let mut alone = vec![[[0.0; 3]; 2]; count];
    let mut between = Vec::new();
    for (part, matrix) in matrices.iter().enumerate() {
        let mut rest = vec![[[0.0; 2]; 2]; count];
        let mut roots = vec![[[0.0; 2]; 2]; count];
        for k in 0..count {
            let block = [0, 1].map(|i| [0, 1].map(|j| matrix[(2 * k + i, 2 * k + j)]));
            rest[k] = block;
            roots[k] = root(block);
        }
        for right in 1..count {
            for left in 0..right {
                let block = [0, 1].map(|i| [0, 1].map(|j| matrix[(2 * left + i, 2 * right + j)]));
                if block == [[0.0; 2]; 2] {
                    continue;
                }
                let scaled = times(
                    pseudo_inverse(roots[left]),
                    times(block, transposed(pseudo_inverse(roots[right]))),
                );
                for (size, u, v) in singular(scaled) {
                    if size <= 1e-15 {
                        continue;
                    }
                    let a = apply(roots[left], u);
                    let b = apply(roots[right], v);
                    for i in 0..2 {
                        for j in 0..2 {
                            rest[left][i][j] -= size * a[i] * a[j];
                            rest[right][i][j] -= size * b[i] * b[j];
                        }
                    }
                    // Closing is a·x − (−b)·y: the spring of σ (a·x + b·y)²/2 has the entry σ a bᵀ.
                    let mut values = [0.0; 2];
                    values[part] = size;
                    between.push(Between {
                        foundations: [left, right],
                        shares: [a, b.map(|value| -value)],
                        stiffness: values[0],
                        damping: values[1],
                    });
                }
            }
        }
        for (k, block) in rest.iter().enumerate() {
            let scale = matrix[(2 * k, 2 * k)] * matrix[(2 * k + 1, 2 * k + 1)];
            let determinant = block[0][0] * block[1][1] - block[0][1] * block[1][0];
            let least = if part == 0 { 1e-9 } else { -1e-9 };
            if block[0][0] < 0.0 || block[1][1] < 0.0 || determinant < least * scale {
                return Err(k);
            }
            let mean = 0.5 * (block[0][1] + block[1][0]);
            alone[k][part] = [block[0][0], mean, block[1][1]];
        }
    }
    Ok(Split {
        own: alone,
        between,
    })
}

type Square = [[f64; 2]; 2];

fn times(a: Square, b: Square) -> Square {
    [0, 1].map(|i| [0, 1].map(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j]))
}

fn transposed(a: Square) -> Square {
    [0, 1].map(|i| [0, 1].map(|j| a[j][i]))
}

fn apply(a: Square, x: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|i| a[i][0] * x[0] + a[i][1] * x[1])
}

/// L of a positive semidefinite matrix L Lᵀ, lower triangular.
fn root(a: Square) -> Square {
    let first = a[0][0].max(0.0).sqrt();
    let below = if first > 0.0 { a[1][0] / first } else { 0.0 };
    [
        [first, 0.0],
        [below, (a[1][1] - below * below).max(0.0).sqrt()],
    ]
}

/// Inverse of a lower triangle; rows without a pivot are zero.
fn pseudo_inverse(l: Square) -> Square {
    let inverse = |value: f64| if value > 0.0 { 1.0 / value } else { 0.0 };
    let (first, second) = (inverse(l[0][0]), inverse(l[1][1]));
    [[first, 0.0], [-second * l[1][0] * first, second]]
}

/// Singular values of a matrix of two rows, with unit vectors on the left and on the right.
fn singular(a: Square) -> [(f64, [f64; 2], [f64; 2]); 2] {
    // Rotations by half the sum and half the difference of these angles make it diagonal (J. Demmel, 1997, Applied Numerical
    // Linear Algebra, section 5.4).
    let sum = libm::atan2(a[1][0] - a[0][1], a[0][0] + a[1][1]);
    let difference = libm::atan2(a[1][0] + a[0][1], a[0][0] - a[1][1]);
    let (left, right) = (0.5 * (sum + difference), 0.5 * (difference - sum));
    let u = [
        [libm::cos(left), libm::sin(left)],
        [-libm::sin(left), libm::cos(left)],
    ];
    let v = [
        [libm::cos(right), libm::sin(right)],
        [-libm::sin(right), libm::cos(right)],
    ];
    [0, 1].map(|k| {
        let image = apply(a, v[k]);
        let size = image[0] * u[k][0] + image[1] * u[k][1];
        if size < 0.0 {
            (-size, u[k].map(|value| -value), v[k])
        } else {
            (size, u[k], v[k])
        }
    })
}

/// The springs and dashpots between foundations, as links; they are numbered from `first`.
pub(super) fn links(
    between: &[Between],
    founded: &[(usize, FoundationPlace)],
    buildings: &[BuildingSystem],
    first: usize,
) -> Vec<LinkElement> {
    let port = |foundation: usize, shares: [f64; 2]| {
        let (building, place) = &founded[foundation];
        let building_system = &buildings[*building];
        let dofs = [place.sway, Some(place.turning)];
        let entries = dofs.into_iter().zip(shares);
        let entries = entries.filter_map(|(dof, share)| Some((dof?, share)));
        let row: Row = entries.filter(|(_, share)| *share != 0.0).collect();
        let row_of_own = row.moved_down(building_system.offset);
        (!row.is_empty()).then(|| Port {
            building: *building,
            row,
            mass: row_of_own.moving_mass(&building_system.equations.mass),
            floor: None,
            height: 0.0,
            level: building_system.discretization.elevation,
        })
    };
    between
        .iter()
        .enumerate()
        .map(|(index, between)| LinkElement {
            link: first + index,
            ports: PortPair([
                port(between.foundations[0], between.shares[0]),
                port(between.foundations[1], between.shares[1]),
            ]),
            inside: false,
            height: 0.0,
            stiffness: between.stiffness,
            damping: between.damping,
            closing_at_rest: 0.0,
            law: LinkLaw::Linear,
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parts of every foundation and springs between them add up to the matrices they come from, for matrices with every entry
    /// and for those that are singular.
    #[test]
    fn parts_add_up() {
        let entries = [
            [4.0, 0.6, -2.2, 0.3],
            [0.6, 9.0, 0.4, 1.9],
            [-2.2, 0.4, 3.5, -0.2],
            [0.3, 1.9, -0.2, 8.0],
        ];
        let singular = [
            [1.0, 0.0, -1.0, 0.0],
            [0.0, 0.0, 0.0, 0.0],
            [-1.0, 0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, 2.0],
        ];
        let full = |rows: [[f64; 4]; 4]| {
            let mut matrix = FullMatrix::zeros(4, 4);
            for (i, row) in rows.iter().enumerate() {
                for (j, value) in row.iter().enumerate() {
                    matrix[(i, j)] = *value;
                }
            }
            matrix
        };
        let found = split(&[full(entries), full(singular)], 2).expect("positive parts");
        for (part, rows) in [entries, singular].into_iter().enumerate() {
            let mut sum = [[0.0; 4]; 4];
            for (k, matrices) in found.own.iter().enumerate() {
                let [uu, ut, tt] = matrices[part];
                sum[2 * k][2 * k] += uu;
                sum[2 * k][2 * k + 1] += ut;
                sum[2 * k + 1][2 * k] += ut;
                sum[2 * k + 1][2 * k + 1] += tt;
            }
            for spring in &found.between {
                let size = [spring.stiffness, spring.damping][part];
                assert!(spring.stiffness >= 0.0 && spring.damping >= 0.0);
                let [a, b] = spring.shares;
                let row = [a[0], a[1], -b[0], -b[1]];
                for i in 0..4 {
                    for j in 0..4 {
                        sum[i][j] += size * row[i] * row[j];
                    }
                }
            }
            for i in 0..4 {
                for j in 0..4 {
                    assert!((sum[i][j] - rows[i][j]).abs() < 1e-13, "{part}: {sum:?}");
                }
            }
        }
    }
}
