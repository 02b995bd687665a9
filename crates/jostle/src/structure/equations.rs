//! Mass and stiffness of one building in the order of its transfer path.

use std::sync::Arc;

use crate::hysteresis::{Hysteresis, HysteresisMemory, SpaceSurface};
use crate::linear::{Row, SparseSymmetric};
use crate::model::{LEVEL_TOLERANCE, ProportionalDamping, STANDARD_GRAVITY};
use crate::motion::Ground;
use crate::simd;
use crate::structure::element::{self, Part, Place, X, Y, over_nodes};
use crate::structure::path::Path;
use crate::structure::stick_elements;
use crate::structure::{StickModel, Support};

/// M ü + (α M + β K + C′) u̇ + (K + K′) u = −M r a_g + contact forces, for one building.
///
/// M is diagonal; massless degrees of freedom have zeros there. K, K′ and C′ are symmetric.
#[derive(Clone, Debug)]
pub struct Equations {
    /// Mass of every degree of freedom \[kg, kg·m²\].
    pub mass: Vec<f64>,
    /// M r: the mass on which horizontal ground acceleration acts \[kg\].
    pub driven_mass: Vec<f64>,
    /// M r upwards: the mass that rises and sinks \[kg\].
    pub vertical_mass: Vec<f64>,
    /// The mass that weighs: that which rises and sinks, and that of loads at rest \[kg\].
    pub weighing_mass: Vec<f64>,
    /// M r across the row: the mass on which ground acceleration across acts; empty in one plane \[kg\].
    pub driven_across: Vec<f64>,
    /// M r of a rotation of every floor about its centre of mass; used for participation only; empty in one plane \[kg·m,
    /// kg·m²\].
    pub driven_turning: Vec<f64>,
    /// rᵀ M r of that rotation \[kg·m²\].
    pub polar_mass: f64,
    /// rᵀ M r of a motion of everything along x, and across; the latter zero in one plane \[kg\].
    pub moved_mass: [f64; 2],
    /// K: stiffness of members and joints, which takes part in stiffness-proportional damping.
    pub stiffness: SparseSymmetric,
    /// K′: stiffness without stiffness-proportional damping: P-Delta, and base springs.
    pub undamped: SparseSymmetric,
    /// C′: base dashpots.
    pub dashpots: SparseSymmetric,
    /// Springs that yield: hinges first, then storey springs, then those between any points, each in the order of the stick model, then three rows
    /// of every force in plan that is the same in every direction, and three or six of every section on a surface. They are not part of K + K′. Where stiffness-proportional damping
    /// acts on them with their initial stiffness, that stands in K, and its negative in K′.
    pub springs: Vec<YieldingSpring>,
    /// Number of springs that yield by themselves; the rows of forces in plan, then those of sections on a surface follow.
    pub single_springs: usize,
    /// Mass-proportional damping α \[1/s\].
    pub alpha: f64,
    /// Stiffness-proportional damping β \[s\].
    pub beta: f64,
    /// Whether K′ and C′ are zero.
    pub(crate) plain: bool,
    path: Path,
    base_shear: Row,
    total_mass: f64,
}

/// A spring that yields.
#[derive(Clone, Debug, PartialEq)]
pub struct YieldingSpring {
    /// Its deformation \[rad or m\]: one end minus the other, then rotations that add to it, such as that of the foundation under a
    /// storey, or of two floors in plan.
    pub row: Row,
    /// Rule and backbone.
    pub hysteresis: Hysteresis,
    /// Whether stiffness-proportional damping acts on it with its present stiffness.
    pub damped_by_tangent: bool,
    /// Share of its force in the base shear \[–\].
    pub(crate) in_base_shear: f64,
    /// Its law, if it is the first of six rows of a section that yields on a surface in space.
    pub(crate) surface: Option<Arc<SpaceSurface>>,
}

impl YieldingSpring {
    /// Deformation under displacements of the building \[rad or m\].
    #[must_use]
    #[inline]
    pub fn deformation(&self, displacement: &[f64]) -> f64 {
        self.row.value(displacement)
    }
}

impl Equations {
    /// Assembles an undamped building.
    #[must_use]
    pub fn assemble(stick_model: &StickModel) -> Self {
        let path = Path::through(stick_model);
        let n = path.len();
        let (mut mass, mut driven_mass, mut vertical_mass) =
            (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        let mut loads = vec![0.0; n];
        let across = if stick_model.moves_across() { n } else { 0 };
        let (mut driven_across, mut driven_turning) = (vec![0.0; across], vec![0.0; across]);
        let (mut polar_mass, mut moved_mass) = (0.0, [0.0; 2]);
        let mut total_mass = 0.0;
        for (index, node) in stick_model.nodes.iter().enumerate() {
            if node.support == Support::Fixed {
                continue;
            }
            // Ends of columns beyond hinges stand as still as the feet beside them.
            let moves = [X, Y].into_iter().any(|component| {
                let carried = stick_model.carried((index, component));
                element::places(&carried).any(|(place, _)| path.dof(place.0, place.1).is_some())
            });
            if moves {
                total_mass += node.mass;
            }
            for (component, inertia) in node.inertia.into_iter().enumerate() {
                let carried = stick_model.carried((index, component));
                let moved = node.influence[component];
                // Of a mass that two displacements carry, what couples them adds to nothing over all masses.
                for (place, share) in element::places(&carried) {
                    let Some(dof) = path.dof(place.0, place.1) else {
                        continue;
                    };
                    moved_mass[0] += inertia * moved.along * moved.along;
                    moved_mass[1] += inertia * moved.across * moved.across;
                    mass[dof] += inertia * (share * share);
                    driven_mass[dof] += inertia * share * moved.along;
                    vertical_mass[dof] += inertia * share * moved.up;
                    if moved.up != 0.0 {
                        loads[dof] += node.load * moved.up * share / STANDARD_GRAVITY;
                    }
                    if across > 0 {
                        driven_across[dof] += inertia * share * moved.across;
                        driven_turning[dof] += inertia * share * moved.turning;
                        polar_mass += inertia * moved.turning * moved.turning;
                    }
                }
            }
        }
        let mut triplets = [Vec::new(), Vec::new(), Vec::new()];
        let mut base_shear = Row::default();
        // What elements of a matrix leave of a row at the ground is no force there: the base shear is the sum of all rows.
        let on_soil = stick_model.foundation.is_some();
        let of_supports = on_soil || stick_model.elements.is_empty() && !stick_model.moves_across();
        // Over a foundation, the base shear is what it takes from the building above.
        let sway = stick_model.foundation.as_ref();
        let sway = sway.and_then(|foundation| path.dof(foundation.node, X));
        for (is_soil, (part, a, b, value)) in
            stick_elements::stiffnesses(stick_model).flat_map(|element| {
                let is_soil = element.is_soil;
                element
                    .entries
                    .into_iter()
                    .map(move |entry| (is_soil, entry))
            })
        {
            let on_foundation = sway.is_some() && path.dof(a.0, a.1) == sway;
            if on_foundation
                && !is_soil
                && part != Part::Dashpot
                && let Some(column) = path.dof(b.0, b.1)
            {
                base_shear.add(column, -value);
            }
            match (path.dof(a.0, a.1), path.dof(b.0, b.1)) {
                (Some(row), Some(column)) if row >= column => {
                    triplets[part as usize].push((row, column, value));
                }
                // Forces of the supports on the building.
                (None, Some(column))
                    if of_supports && sway.is_none() && a.1 == X && part != Part::Dashpot =>
                {
                    base_shear.add(column, -value);
                }
                _ => {}
            }
            let along = stick_model.influence(a).along;
            if let (false, Some(_), Some(column)) = (
                of_supports
                    || along == 0.0
                    || part == Part::Dashpot
                    || stands_below(stick_model, a),
                path.dof(a.0, a.1),
                path.dof(b.0, b.1),
            ) {
                base_shear.add(column, along * value);
            }
        }
        if !of_supports || on_soil {
            let mut sums = vec![0.0; n];
            base_shear.push(1.0, &mut sums);
            let sums = sums.into_iter().enumerate();
            base_shear = sums.filter(|(_, sum)| *sum != 0.0).collect();
        }
        let springs = yielding_springs(stick_model, &path);
        let single_springs =
            springs.len() - stick_model.rows_of_bearings() - stick_model.surfaces.len();
        let [stiffness, undamped, dashpots] =
            triplets.map(|triplets| SparseSymmetric::from_triplets(n, &triplets));
        let weighs = vertical_mass.iter().zip(loads);
        Self {
            weighing_mass: weighs.map(|(mass, load)| mass + load).collect(),
            plain: undamped.is_zero() && dashpots.is_zero(),
            mass,
            driven_mass,
            vertical_mass,
            driven_across,
            driven_turning,
            polar_mass,
            moved_mass,
            single_springs,
            springs,
            stiffness,
            undamped,
            dashpots,
            alpha: 0.0,
            beta: 0.0,
            path,
            base_shear,
            total_mass,
        }
    }

    /// M r of the ground acceleration along the row, across, and upwards; empty where nothing moves that way \[kg\].
    pub(crate) fn driven(&self) -> [&[f64]; 3] {
        [&self.driven_mass, &self.driven_across, &self.vertical_mass]
    }

    /// Adds a share of a ground acceleration times these masses to loads, other than what it drives along the row.
    pub(crate) fn add_across_and_up(&self, share: f64, ground: Ground, loads: &mut [f64]) {
        let others = self.driven().into_iter().zip(ground).skip(1);
        for (driven, component) in
            others.filter(|(candidate, c)| *c != 0.0 && !candidate.is_empty())
        {
            simd::add(loads, share * component, driven);
        }
    }

    /// Adds what a change of the ground acceleration does to relative accelerations at once: M Δa = −M r Δa_g.
    pub(crate) fn stay_behind(&self, change: Ground, acceleration: &mut [f64]) {
        let all = self.driven().into_iter().zip(change);
        for (driven, component) in all.filter(|(_, component)| *component != 0.0) {
            let masses = driven.iter().zip(&self.mass);
            for (value, (driven, mass)) in acceleration.iter_mut().zip(masses) {
                if *mass > 0.0 {
                    *value -= driven / mass * component;
                }
            }
        }
    }

    /// Initial stiffness of every spring that yields \[N·m/rad, N/m\].
    pub fn initial_tangents(&self) -> Vec<f64> {
        let springs = self.springs.iter();
        springs
            .map(|spring| spring.hysteresis.initial_tangent())
            .collect()
    }

    /// Coefficient of the dashpot beside a spring that yields, at its present stiffness \[N·s/m, N·m·s/rad\].
    #[must_use]
    #[inline]
    pub fn tangent_dashpot(&self, spring: &YieldingSpring, tangent: f64) -> f64 {
        if spring.damped_by_tangent {
            self.beta * tangent.max(0.0)
        } else {
            0.0
        }
    }

    /// Force of that dashpot at velocities of the building, while the spring goes on as its memory says \[N, N·m\].
    pub(crate) fn tangent_damping(
        &self,
        spring: &YieldingSpring,
        memory: &HysteresisMemory,
        velocity: &[f64],
    ) -> f64 {
        let tangent = spring.hysteresis.unloading_stiffness(memory);
        self.tangent_dashpot(spring, tangent) * spring.deformation(velocity)
    }

    /// xᵀ (K + K′) x: twice the strain energy, P-Delta included \[J\].
    #[must_use]
    pub fn strain(&self, x: &[f64]) -> f64 {
        let strained = self.stiffness.quadratic_form(x);
        if self.plain {
            strained
        } else {
            strained + self.undamped.quadratic_form(x)
        }
    }

    /// Number of degrees of freedom.
    #[must_use]
    pub fn len(&self) -> usize {
        self.mass.len()
    }

    /// Whether there are no degrees of freedom.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.mass.is_empty()
    }

    /// Degree of freedom of (node, component).
    pub(crate) fn dof(&self, place: Place) -> Option<usize> {
        self.path.dof(place.0, place.1)
    }

    /// A row over displacements of nodes, as one over degrees of freedom.
    pub(crate) fn row(&self, over_nodes: &Row) -> Row {
        self.path.row(over_nodes)
    }

    /// Degree of freedom of the horizontal displacement of a node; `None` at supports.
    #[must_use]
    pub fn horizontal(&self, node: usize) -> Option<usize> {
        self.path.dof(node, X)
    }

    /// Degree of freedom of the vertical displacement of a node; `None` if it is restrained.
    #[must_use]
    pub fn vertical(&self, node: usize) -> Option<usize> {
        self.path.dof(node, Y)
    }

    /// Degree of freedom of the rotation of a node; `None` if it is restrained.
    #[must_use]
    pub fn rotation(&self, node: usize) -> Option<usize> {
        self.path.dof(node, element::THETA)
    }

    /// Mass of the nodes that are not fixed \[kg\].
    #[must_use]
    pub fn total_mass(&self) -> f64 {
        self.total_mass
    }

    /// Base shear for a displacement, without that of yielding springs, positive when the building leans to the
    /// right \[N\].
    #[must_use]
    pub fn base_shear(&self, displacement: &[f64]) -> f64 {
        self.base_shear.value(displacement)
    }

    /// Number of places that yield: springs, of which all rows of a section on a surface are one.
    #[must_use]
    pub fn yielding_places(&self) -> usize {
        let springs = self.springs.iter().map(|spring| &spring.hysteresis);
        springs
            .filter(|law| !law.is_on_surface() || law.starts_surface())
            .count()
    }
}

/// Whether a displacement is that of the foundation of a building with a plan, on soil.
fn stands_below(stick_model: &StickModel, place: Place) -> bool {
    let on_soil = stick_model.plan_base.is_some_and(|base| base.on_soil);
    on_soil && stick_model.nodes[place.0].y <= LEVEL_TOLERANCE
}

/// Springs that yield: those by themselves, then bearings in plan, then sections on a surface.
fn yielding_springs(stick_model: &StickModel, path: &Path) -> Vec<YieldingSpring> {
    let foundation = stick_model.foundation.as_ref();
    let sway = foundation.and_then(|foundation| path.dof(foundation.node, X));
    let single = stick_model.single_springs().map(|single_spring| {
        let row = stick_model.carried_row(&single_spring.row);
        // What it pushes along x against the ground or the foundation: as much as everything else the other way. Not every row has a place
        // at the ground.
        let pushed = element::places(&row).map(|(place, share)| {
            let along = share * stick_model.influence(place).along;
            let dof = path.dof(place.0, place.1);
            match sway {
                Some(_) if dof == sway && place.1 == X => -along,
                None if dof.is_some() && !stands_below(stick_model, place) => along,
                _ => 0.0,
            }
        });
        YieldingSpring {
            in_base_shear: pushed.sum(),
            row: path.row(&row),
            hysteresis: single_spring.hysteresis,
            damped_by_tangent: single_spring.proportional_damping == ProportionalDamping::Tangent,
            surface: None,
        }
    });
    let bearings = stick_model.plan_mat.iter().flat_map(|mat| {
        let [x, y, turning] = [X, Y, element::THETA].map(|component| (mat.node, component));
        mat.forces().flat_map(move |(laws, [along, across])| {
            let rows = [
                over_nodes([(x, 1.0), (turning, along)]),
                over_nodes([(y, 1.0), (turning, across)]),
                over_nodes([(x, 1.0), (y, -1.0), (turning, along - across)]),
            ];
            let rows = rows.into_iter().zip(laws).enumerate();
            rows.map(|(row, (moved, hysteresis))| YieldingSpring {
                row: path.row(&moved),
                hysteresis,
                damped_by_tangent: false,
                in_base_shear: f64::from(u8::from(row == 0)),
                surface: None,
            })
        })
    });
    let rows = &stick_model.surfaces;
    let surfaces = rows
        .iter()
        .enumerate()
        .map(|(first, element)| YieldingSpring {
            row: path.row(&stick_model.carried_row(&element.row)),
            hysteresis: element.hysteresis,
            damped_by_tangent: false,
            // It neither slides nor stands on a foundation.
            in_base_shear: 0.0,
            surface: SpaceSurface::of(rows[first..].iter().take(6).map(|row| &row.hysteresis))
                .map(Arc::new),
        });
    single.chain(bearings).chain(surfaces).collect()
}
