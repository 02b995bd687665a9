//! One building of a system.

use std::ops::Deref;
use std::sync::Arc;

use super::damping::DampedMode;
use super::falling_panels::FallingPanel;
use super::limited_ends::LimitedEnd;
use super::plan_mat::MatInPlan;
use super::plan_soil::FoundationInPlan;
use super::plan_storey::PlanStorey;
use super::soil::FoundationPlace;
use super::weakening::Weakening;
use crate::eigen::{
    LATERAL_SHARE, Mode, lateral_modes_along, modes_dense, symmetric, vertical_modes_along,
};
use crate::hysteresis::HysteresisMemory;
use crate::linear::Row;
use crate::model::{Building, Gravity, LEVEL_TOLERANCE, PlanColumn, PlanPoint, STANDARD_GRAVITY};
use crate::motion::Ground;
use crate::simd;
use crate::statics::{Collapse, Settled, under_gravity};
use crate::structure::element::{THETA, X, Y, over_nodes};
use crate::structure::motion_at;
use crate::structure::{
    AssembledBuilding, AtRest, Discretization, InnerLink, MemberForces, PlanBase, PointNode,
    SpringPlace,
};
use crate::transfer::riccati::RiccatiSweep;

/// One building of a system: its equations, and where they stand among those of the others.
///
/// Dereferences to the [`AssembledBuilding`], so that its fields read as those of the building.
#[derive(Clone, Debug)]
pub struct BuildingSystem {
    /// Masses, elements and matrices.
    pub structure: AssembledBuilding,
    /// First degree of freedom of this building in the vectors of a [`crate::State`].
    pub offset: usize,
    /// Floors from the ground up.
    pub floors: Vec<Floor>,
    /// Displacements whose peaks are reported: those of the floors, from the ground up; in space then those across, and
    /// then the rotations.
    pub tracks: Vec<Track>,
    /// Corners of the floors in space, whose displacements are reported.
    pub corners: Vec<Corner>,
    /// Storeys in space, whose drifts are those of vertical lines, from the ground up; displacements count from its first.
    pub plan_storeys: Vec<PlanStorey>,
    /// Displacements and springs under self weight, from which a run starts; empty where weight is left out.
    pub rest: Settled,
    /// First spring that yields of this building in the list of a [`crate::State`].
    pub spring_offset: usize,
    /// Degree of freedom of the foot of the first column line in the vectors of a [`crate::State`], where the base
    /// gives way sideways.
    pub foot: Option<usize>,
    /// What moves it as a whole, where results are wanted of it.
    pub support: Option<SpringSupport>,
    /// Its mat, if it is isolated and in space.
    pub mat_in_plan: Option<MatInPlan>,
    /// Of a building in plan on springs: displacements of its footing and its rocking, as far as they move, in the vectors of a
    /// [`crate::State`].
    pub plan_base: Vec<usize>,
    /// The rigid foundation on which it stands, in one plane.
    pub foundation: Option<FoundationPlace>,
    /// The rigid foundation on which it stands, with a plan.
    pub foundation_in_plan: Option<FoundationInPlan>,
    /// The ratio of critical damping that all modes have, where damping is not Rayleigh's \[–\].
    pub modal_damping: Option<f64>,
    /// The modes at which Rayleigh damping has its ratio, of the building fixed on its mat or foundation if it has one; empty without such
    /// modes.
    pub damped_at: Vec<DampedMode>,
    /// Lateral modes, longest period first; empty when the building can move without deforming.
    /// [`crate::eigen::modes`] finds those of all kinds.
    pub modes: Vec<Mode>,
    /// How forces of columns and beams follow from the motion; empty unless they are asked for.
    pub members: MemberForces,
    /// Columns whose shear strength falls with the ductility of their hinges.
    pub(crate) weakening: Vec<Weakening>,
    /// Infill panels that leave the model when they fall.
    pub(crate) falling_panels: Vec<FallingPanel>,
    /// Hinges whose rotations have limits.
    pub limited_ends: Vec<LimitedEnd>,
    /// The same building without neighbours on the soil, where they act on its foundation.
    alone: Option<Arc<AssembledBuilding>>,
    /// The recursion through its equations, shared by all runs.
    pub(crate) sweep: Arc<RiccatiSweep>,
}

/// Spring, friction and dashpot between the ground and a mat or a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringSupport {
    /// Degree of freedom of the mat or the wall in the vectors of a [`crate::State`].
    pub dof: usize,
    /// Elastic stiffness \[N/m\].
    pub stiffness: f64,
    /// Coefficient of the dashpot \[N·s/m\].
    pub damping: f64,
    /// The spring that yields or slides, among those of the building.
    pub spring: Option<usize>,
    /// Unit vector of the displacement on the site; that of a wall is its normal, out of what is solid \[–\].
    pub direction: [f64; 2],
}

/// A floor of a building.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Floor {
    /// Its degree of freedom in the vectors of a [`crate::State`].
    pub dof: usize,
    /// Height above the base \[m\].
    pub height: f64,
    /// Height of the storey below \[m\].
    pub storey_height: f64,
}

/// Direction of a displacement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Direction {
    /// Along the row: x.
    Along,
    /// Across the row: y.
    Across,
    /// Rotation about a vertical axis; of a foundation, about the horizontal one across the row.
    Turning,
    /// Upwards, of buildings in one plane.
    Up,
}

impl Direction {
    /// The component of the ground acceleration in this direction; none turns \[m/s²\].
    #[must_use]
    #[inline]
    pub fn of_ground(self, ground: Ground) -> f64 {
        match self {
            Self::Along => ground[0],
            Self::Across => ground[1],
            Self::Up => ground[2],
            Self::Turning => 0.0,
        }
    }
}

/// A displacement of a floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Track {
    /// Its degree of freedom in the vectors of a [`crate::State`].
    pub dof: usize,
    /// Its direction.
    pub direction: Direction,
    /// Height of the storey below \[m\].
    pub storey_height: f64,
    /// Whether it belongs to the lowest floor.
    pub is_lowest: bool,
    /// Whether its difference from what is below is the drift of one vertical line; otherwise [`BuildingSystem::plan_storeys`] tells
    /// the drift.
    pub is_in_line: bool,
}

/// A corner of a floor in plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Corner {
    /// Index of the floor.
    pub floor: usize,
    /// Its displacements along x and across.
    pub rows: [Row; 2],
}

impl Deref for BuildingSystem {
    type Target = AssembledBuilding;

    #[inline]
    fn deref(&self) -> &AssembledBuilding {
        &self.structure
    }
}

impl BuildingSystem {
    /// Assembles a discretized building, without damping.
    #[must_use]
    pub fn new(name: &str, discretization: Discretization) -> Self {
        Self::from_assembled(AssembledBuilding::new(name, discretization))
    }

    /// Where it stands before it moves.
    pub(crate) fn at_rest(&self) -> AtRest<'_> {
        let Settled {
            displacement,
            springs,
        } = &self.rest;
        let gravity = match displacement.is_empty() {
            true => 0.0,
            false => STANDARD_GRAVITY,
        };
        AtRest {
            gravity,
            displacement,
            springs,
        }
    }

    fn from_assembled(structure: AssembledBuilding) -> Self {
        let sweep = RiccatiSweep::through(&structure.equations);
        let Discretization {
            stick_model,
            floors,
            ..
        } = &structure.discretization;
        let mut below = 0.0;
        let floors = floors.iter().filter_map(|&node| {
            let height = stick_model.nodes[node].y;
            let storey_height = height - std::mem::replace(&mut below, height);
            Some(Floor {
                dof: structure.equations.horizontal(node)?,
                height,
                storey_height,
            })
        });
        let floors: Vec<Floor> = floors.collect();
        let tracks = tracks(&structure, &floors);
        let foot = structure.discretization.foot;
        let foot = foot.and_then(|node| structure.equations.horizontal(node));
        let support = spring_support(&structure);
        let mat_in_plan = MatInPlan::new(&structure);
        let base = structure.discretization.stick_model.plan_base;
        let base = base.into_iter().flat_map(PlanBase::nodes);
        let base = base.flat_map(|node| [X, Y, THETA].map(|component| (node, component)));
        let plan_base = base
            .filter_map(|place| structure.equations.dof(place))
            .collect();
        let modes = modes(&structure, &sweep);
        let mat = support.map(|support| support.dof);
        let falling_panels = FallingPanel::all(&structure, &tracks, mat);
        Self {
            structure,
            offset: 0,
            foot,
            floors,
            tracks,
            corners: Vec::new(),
            plan_storeys: Vec::new(),
            rest: Settled::default(),
            spring_offset: 0,
            support,
            mat_in_plan,
            plan_base,
            foundation: None,
            foundation_in_plan: None,
            modal_damping: None,
            damped_at: Vec::new(),
            modes,
            members: MemberForces::default(),
            weakening: Vec::new(),
            falling_panels,
            limited_ends: Vec::new(),
            alone: None,
            sweep: Arc::new(sweep),
        }
    }

    /// Adds P-Delta and sets the displacements under self weight, as far as each is asked for.
    ///
    /// # Errors
    /// [`Collapse`]; the building is then as it was.
    pub fn put_under_gravity(&mut self, gravity: Gravity) -> Result<(), Collapse> {
        if !gravity.p_delta && !gravity.preload {
            return Ok(());
        }
        let mut asked = gravity;
        if self.is_in_space() {
            // P-Delta is part of its matrices.
            asked.p_delta = false;
            if self.modes.is_empty() {
                return Err(match gravity.p_delta {
                    true => Collapse::Buckles,
                    false => Collapse::Movable,
                });
            }
            if !asked.preload {
                return Ok(());
            }
        }
        let (leaning, rest) = under_gravity(&self.structure, asked)?;
        if let Some(leaning) = leaning {
            *self = Self::from_assembled(leaning);
        }
        self.rest = rest;
        Ok(())
    }

    /// Adds links between its floors: its storey forces contain theirs, and its modes are those with their initial stiffness.
    pub(super) fn link(&mut self, links: Vec<InnerLink>) {
        if links.is_empty() {
            return;
        }
        self.structure.link(links);
        self.modes = modes(&self.structure, &self.sweep);
    }

    /// Gives the soil under its foundation other springs and dashpots over displacement and rotation: uu, uθ, θθ. Modes stay
    /// those of the springs that it had.
    pub(super) fn stand_on(&mut self, stiffness: [f64; 3], damping: [f64; 3]) {
        let mut discretization = self.structure.discretization.clone();
        if let Some(foundation) = &mut discretization.stick_model.foundation {
            (foundation.stiffness, foundation.damping) = (stiffness, damping);
        }
        if let Some(place) = &mut self.foundation {
            (place.own_stiffness, place.own_damping) = (stiffness, damping);
        }
        let mut structure = AssembledBuilding::new(&self.structure.name, discretization);
        let (old, new) = (&self.structure.equations, &mut structure.equations);
        (new.alpha, new.beta) = (old.alpha, old.beta);
        structure.link(self.structure.inner_links.clone());
        self.sweep = Arc::new(RiccatiSweep::through(&structure.equations));
        self.alone = Some(Arc::new(std::mem::replace(&mut self.structure, structure)));
    }

    /// Lets the shear strength of its columns fall with the ductility of their hinges, where the model says so.
    pub(super) fn weaken_with_ductility(&mut self, model: &Building) {
        self.weakening = Weakening::all(model, &self.structure);
    }

    /// Finds the hinges whose rotations the model limits.
    pub(super) fn limit_rotations(&mut self, model: &Building) {
        self.limited_ends = LimitedEnd::all(model, &self.structure);
    }

    /// Lowers shear strengths to those at the ductility so far. `memories`: those of its springs.
    pub(crate) fn weaken(&self, memories: &mut [HysteresisMemory]) {
        for column in &self.weakening {
            column.apply(&self.structure, memories);
        }
    }

    /// Its equations without neighbours on the soil, to which its modes belong.
    #[must_use]
    pub fn alone(&self) -> &AssembledBuilding {
        self.alone.as_deref().unwrap_or(&self.structure)
    }

    /// The building without neighbours on the soil; `None` if none act on its foundation.
    pub(crate) fn without_neighbours(&self) -> Option<Self> {
        let structure = AssembledBuilding::clone(self.alone.as_ref()?);
        Some(Self {
            sweep: Arc::new(RiccatiSweep::through(&structure.equations)),
            structure,
            alone: None,
            ..self.clone()
        })
    }

    /// Drift ratios of its storeys, along x and across, under displacements of this building: in plan of the line through the centre of
    /// mass of the floor above. The motion of its base is no drift \[–\].
    #[must_use]
    pub fn storey_drifts(&self, displacement: &[f64]) -> Vec<[f64; 2]> {
        if !self.plan_storeys.is_empty() {
            let storeys = self.plan_storeys.iter();
            return storeys
                .map(|storey| {
                    let [along, across, _] = storey.apart(displacement);
                    [along, across].map(|apart| apart / storey.height)
                })
                .collect();
        }
        let at = |dof: usize| displacement[dof - self.offset];
        let foundation = self.foundation.as_ref();
        let turned = foundation.map_or(0.0, |foundation| at(foundation.turning));
        let mut below = self.foot.map_or(0.0, at);
        let mut drift = |floor: &Floor| {
            let above = at(floor.dof);
            let apart = above - std::mem::replace(&mut below, above);
            [apart / floor.storey_height + turned, 0.0]
        };
        self.floors.iter().map(&mut drift).collect()
    }

    /// Lateral modes, longest period first.
    pub fn lateral_modes(&self) -> impl Iterator<Item = &Mode> {
        self.modes.iter().filter(|mode| mode.is_lateral())
    }

    /// The mode of the longest period that carries more of the polar mass than of the mass in either direction; none in one plane.
    #[must_use]
    pub fn first_torsional_mode(&self) -> Option<&Mode> {
        self.modes.iter().find(|mode| {
            let lateral = mode
                .effective_mass_ratio_x
                .max(mode.effective_mass_ratio_across);
            mode.effective_mass_ratio_torsion > lateral.max(LATERAL_SHARE)
        })
    }

    /// Periods of the fundamental modes along x and across: the longest of those that carry at least half as much mass that way as any
    /// does; 0 where none carries any \[s\].
    #[must_use]
    pub fn fundamental_periods(&self) -> [f64; 2] {
        let modes = self.fundamental_modes();
        modes.map(|mode| mode.map_or(0.0, Mode::period))
    }

    /// The same modes.
    pub(crate) fn fundamental_modes(&self) -> [Option<&Mode>; 2] {
        let along = |mode: &Mode| mode.effective_mass_ratio_x;
        let across = |mode: &Mode| mode.effective_mass_ratio_across;
        let longest = |mass: fn(&Mode) -> f64| {
            let most = self.lateral_modes().map(mass).fold(0.0, f64::max);
            let mut modes = self.lateral_modes();
            let first = modes.find(|mode| mass(mode) >= 0.5 * most);
            first.filter(|_| most > 0.0)
        };
        [longest(along), longest(across)]
    }

    /// Modes that carry at least 1 % of the mass vertically, longest period first; none where no mass moves vertically, or
    /// where it can move without deforming.
    #[must_use]
    pub fn vertical_modes(&self) -> Vec<Mode> {
        if !self.moves_vertically() {
            return Vec::new();
        }
        vertical_modes_along(&self.structure, &self.sweep).unwrap_or_default()
    }

    /// Every mass that moves along x with its height above the base, bodies that move together as one \[m, kg\].
    #[must_use]
    pub fn horizontal_masses(&self) -> Vec<(f64, f64)> {
        let sticks = &self.discretization.stick_model;
        let mut counted = vec![false; self.equations.mass.len()];
        let nodes = sticks.nodes.iter().enumerate();
        nodes
            .filter_map(|(node, place)| {
                let dof = self.equations.horizontal(node)?;
                let along = place.influence[0].along;
                let new = along != 0.0 && !std::mem::replace(&mut counted[dof], true);
                new.then(|| (place.y, self.equations.mass[dof] * along * along))
            })
            .collect()
    }

    /// Weight at and above every storey, from the ground up \[N\].
    #[must_use]
    pub fn weights_above(&self) -> Vec<f64> {
        let masses = self.horizontal_masses();
        let floors = self.floors.iter();
        floors
            .map(|floor| {
                let base = floor.height - floor.storey_height + LEVEL_TOLERANCE;
                let above = masses.iter().filter(|(height, _)| *height > base);
                STANDARD_GRAVITY * above.map(|(_, mass)| mass).sum::<f64>()
            })
            .collect()
    }

    /// How much of the ground acceleration along the row, across and upwards its displacements in a direction see \[–\].
    pub(crate) fn ground_shares(&self, direction: Direction) -> [f64; 3] {
        match (&self.support, self.discretization.mat) {
            // A wall moves along its normal alone.
            (Some(wall), None) => [wall.direction[0], wall.direction[1], 0.0],
            _ => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
                .map(|unit| direction.of_ground(unit)),
        }
    }

    /// Whether columns of frames hold floors in plan.
    pub(crate) fn has_columns_in_plan(&self) -> bool {
        let discretization = &self.discretization;
        !discretization.frames.is_empty()
            || discretization.space_frame.is_some()
            || discretization.jointed_frame.is_some()
    }

    /// Whether any mass moves vertically.
    #[must_use]
    pub fn moves_vertically(&self) -> bool {
        self.equations.vertical_mass.iter().any(|mass| *mass > 0.0)
    }

    /// Floors, from 0, and degrees of freedom of masses that move vertically there, over the vectors of a
    /// [`crate::State`].
    pub fn vertical_points(&self) -> impl Iterator<Item = (usize, usize)> {
        let nodes = self.discretization.stick_model.nodes.iter().enumerate();
        let places = nodes.flat_map(|(node, place)| {
            let components = place.influence.iter().enumerate();
            let rising = components.filter(|(_, candidate)| candidate.up > 0.0);
            rising.map(move |(component, _)| (place.y, (node, component)))
        });
        places.filter_map(|(height, place)| {
            let dof = self.equations.dof(place)?;
            let at = |floor: &Floor| (floor.height - height).abs() <= LEVEL_TOLERANCE;
            let floor = self.floors.iter().position(at)?;
            (self.equations.vertical_mass[dof] > 0.0).then_some((floor, self.offset + dof))
        })
    }

    /// Share of critical damping that a mode really has, φᵀCφ/(2ω φᵀMφ): Rayleigh damping of what it acts on, dashpots of the base,
    /// and those of links between floors; springs that yield as long as they have not \[–\].
    #[must_use]
    pub fn damping_ratio(&self, mode: &Mode) -> f64 {
        if let Some(ratio) = self.modal_damping {
            return ratio;
        }
        let (equations, shape) = (&self.equations, &mode.shape);
        let mass = simd::weighted_square(&equations.mass, shape);
        let by_members = equations.beta * equations.stiffness.quadratic_form(shape);
        let springs = equations.springs.iter().map(|spring| {
            let dashpot = equations.tangent_dashpot(spring, spring.hysteresis.initial_tangent());
            dashpot * spring.deformation(shape).powi(2)
        });
        let links = self.inner_links.iter();
        let links = links.map(|link| link.damping * link.shortening.value(shape).powi(2));
        let beside = equations.dashpots.quadratic_form(shape);
        let damped = by_members + beside + springs.sum::<f64>() + links.sum::<f64>();
        0.5 * (equations.alpha + damped / mass) / mode.circular_frequency
    }

    /// Whether its floors move in both horizontal directions and turn.
    #[must_use]
    pub fn is_in_space(&self) -> bool {
        !self.structure.discretization.centres.is_empty()
    }

    /// Places the corners of its floors, given on the site from the ground up \[m\].
    pub(crate) fn place_corners(&mut self, plans: &[&[PlanPoint]]) {
        if let (Some(mat), Some(plan)) = (&mut self.mat_in_plan, plans.first()) {
            mat.place_corners(plan);
        }
        let n = self.floors.len();
        for (floor, corners) in plans.iter().enumerate().take(n) {
            let dofs = [0, 1, 2].map(|block| self.tracks[block * n + floor].dof - self.offset);
            for corner in *corners {
                let rows = [0, 1].map(|axis| {
                    let direction = [f64::from(1 - axis), f64::from(axis)];
                    self.point(floor, dofs, *corner, direction)
                });
                self.corners.push(Corner { floor, rows });
            }
        }
        self.place_storeys(plans);
    }

    /// Motions of its base in plan on springs, over the displacements of this building: sway along and across, rotation about the
    /// vertical axis, and rocking along and across, as displacements of floors per height; `None` if its base has no springs.
    pub(crate) fn base_motions(&self) -> Option<[Row; 5]> {
        let sticks = &self.discretization.stick_model;
        let motions = sticks.plan_base?.motions();
        Some(motions.map(|row| self.equations.row(&sticks.carried_row(&row))))
    }

    /// The rise of the middle of its base in plan over the displacements of this building; `None` if it keeps its height.
    pub(crate) fn base_rise(&self) -> Option<Row> {
        let sticks = &self.discretization.stick_model;
        let rise = sticks.plan_base?.rise()?;
        Some(self.equations.row(&sticks.carried_row(&rise)))
    }

    /// The displacement of a point of its footing in a direction, over the vectors of a [`crate::State`]; `None` where it does not move.
    pub(crate) fn footing_row_at(&self, at: PlanPoint, direction: [f64; 2]) -> Option<Row> {
        let plan_base = self.discretization.stick_model.plan_base?;
        let [x, y, _] = motion_at(at, plan_base.centre);
        let shares = [X, Y, THETA].map(|component| {
            let share = direction[0] * x[component] + direction[1] * y[component];
            ((plan_base.footing, component), share)
        });
        let row = self.equations.row(&over_nodes(shares));
        (!row.is_empty()).then(|| row.moved_up(self.offset))
    }

    /// Finds the vertical lines whose drifts are followed.
    fn place_storeys(&mut self, plans: &[&[PlanPoint]]) {
        let n = self.floors.len();
        let mat = self.mat_in_plan.as_ref();
        let mut below = mat.zip(plans.first()).map(|(mat, plan)| {
            let plan: &[PlanPoint] = plan;
            (mat.dofs.map(Some), mat.centre, plan)
        });
        let sticks = &self.discretization.stick_model;
        let base = sticks.plan_base;
        if let (Some(plan_base), Some(plan)) = (base, plans.first()) {
            let dofs =
                [X, Y, THETA].map(|component| self.equations.dof((plan_base.footing, component)));
            below = Some((dofs, plan_base.centre, *plan));
        }
        let rocking = self
            .base_motions()
            .map(|[.., along, across]| [along, across]);
        let mut storeys = Vec::with_capacity(n);
        for (index, (floor, plan)) in self.floors.iter().zip(plans).enumerate() {
            let dofs = [0, 1, 2].map(|block| self.tracks[block * n + index].dof - self.offset);
            let upper = (dofs, self.discretization.centres[index], *plan);
            storeys.push(PlanStorey {
                base: rocking.clone(),
                ..PlanStorey::new(upper, below, floor.storey_height)
            });
            below = Some((dofs.map(Some), upper.1, upper.2));
        }
        for (storey, plan_storey) in storeys.iter().enumerate() {
            for block in [0, 1] {
                self.tracks[block * n + storey].is_in_line = plan_storey.is_in_line();
            }
        }
        self.plan_storeys = storeys;
    }

    /// The displacement of a point of a floor in a direction, over the displacements of this building.
    fn point(&self, floor: usize, dofs: [usize; 3], at: PlanPoint, direction: [f64; 2]) -> Row {
        let [x, y, _] = motion_at(at, self.discretization.centres[floor]);
        let shares = [0, 1, 2].map(|c| direction[0] * x[c] + direction[1] * y[c]);
        dofs.into_iter().zip(shares).collect()
    }

    /// The displacement of a point of a floor, counted from 0, in a direction, over the vectors of a [`crate::State`].
    #[must_use]
    pub fn row_at(&self, floor: usize, at: PlanPoint, direction: [f64; 2]) -> Row {
        let n = self.floors.len();
        let dofs = [0, 1, 2].map(|block| self.tracks[block * n + floor].dof);
        self.point(floor, dofs, at, direction)
    }

    /// The point of a column, so far above the joint at its foot.
    ///
    /// # Errors
    /// Points that cannot be struck.
    pub(crate) fn column_point(
        &self,
        column: PlanColumn,
        above: f64,
    ) -> Result<&PointNode, String> {
        let name = || {
            let place = column.name(&self.discretization.frames);
            format!("{}.{place}", self.name)
        };
        let floor = &self.floors[column.storey];
        let height = floor.height - floor.storey_height + above;
        let mut points = self.discretization.points.iter();
        let point = points.find(|point| {
            point.column == column && (point.height - height).abs() <= LEVEL_TOLERANCE
        });
        let point = point.ok_or_else(|| {
            format!(
                "no point to hit on {} at {height:.3} m: the end of the column is rigid there; leave rigid_ends out, or make them shorter",
                name()
            )
        })?;
        match point.mass > 0.0 {
            true => Ok(point),
            false => Err(format!(
                "{} has no mass where it would be hit; give the building or its frame density, or the section a mass per length",
                name()
            )),
        }
    }

    /// The displacement of such a point in a direction, over the vectors of a [`crate::State`].
    pub(crate) fn row_of_point(&self, point: &PointNode, direction: [f64; 2]) -> Row {
        let moved = point.moved.iter().zip(direction);
        let moved = moved.filter(|(_, share)| *share != 0.0);
        let moved = moved.map(|(row, share)| row.times(share));
        let row = moved.reduce(|a, b| a.plus(&b)).unwrap_or_default();
        self.equations.row(&row).moved_up(self.offset)
    }

    /// Radius of gyration of its lowest floor about a vertical axis; 1 in one plane \[m\].
    pub(crate) fn radius_of_gyration(&self) -> f64 {
        let mass = |track: &Track| self.equations.mass[track.dof - self.offset];
        match self.tracks.get(2 * self.floors.len()) {
            Some(turning) => (mass(turning) / mass(&self.tracks[0])).sqrt(),
            None => 1.0,
        }
    }

    /// Springs that yield of this building in the list of a [`crate::State`].
    #[must_use]
    pub fn spring_range(&self) -> std::ops::Range<usize> {
        self.spring_offset..self.spring_offset + self.equations.springs.len()
    }

    /// Degrees of freedom of this building in the vectors of a [`crate::State`].
    #[must_use]
    pub fn range(&self) -> std::ops::Range<usize> {
        self.offset..self.offset + self.equations.len()
    }
}

/// Lateral modes; all of a building in space. None where it can move without deforming.
fn modes(structure: &AssembledBuilding, sweep: &RiccatiSweep) -> Vec<Mode> {
    let modes = if structure.discretization.stick_model.moves_across() {
        modes_dense(structure, |lower| {
            let (values, vectors) = symmetric::eigen(lower);
            Some(values.into_iter().zip(vectors).collect())
        })
    } else {
        lateral_modes_along(structure, sweep)
    };
    modes.unwrap_or_default()
}

/// Of the mat of an isolated building.
fn spring_support(structure: &AssembledBuilding) -> Option<SpringSupport> {
    let mat = structure.discretization.mat?;
    let places = &structure.discretization.spring_places;
    Some(SpringSupport {
        dof: structure.equations.horizontal(mat.node)?,
        stiffness: mat.stiffness,
        damping: mat.dashpot,
        spring: places
            .iter()
            .position(|place| *place == SpringPlace::Bearings),
        direction: [1.0, 0.0],
    })
}

/// Displacements of the floors whose peaks are reported.
fn tracks(structure: &AssembledBuilding, floors: &[Floor]) -> Vec<Track> {
    let track = |(index, floor): (usize, &Floor), dof, direction| Track {
        dof,
        direction,
        storey_height: floor.storey_height,
        is_lowest: index == 0,
        is_in_line: true,
    };
    let along = floors.iter().enumerate();
    let mut tracks: Vec<Track> = along
        .map(|(index, floor)| track((index, floor), floor.dof, Direction::Along))
        .collect();
    let discretization = &structure.discretization;
    if discretization.stick_model.moves_across() {
        for direction in [Direction::Across, Direction::Turning] {
            let nodes = discretization.floors.iter().zip(floors).enumerate();
            tracks.extend(nodes.filter_map(|(index, (&node, floor))| {
                let equations = &structure.equations;
                let dof = match direction {
                    Direction::Turning => equations.rotation(node),
                    _ => equations.vertical(node),
                };
                Some(track((index, floor), dof?, direction))
            }));
        }
    }
    tracks
}
