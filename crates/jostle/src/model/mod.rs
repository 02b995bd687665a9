//! Input of an analysis: buildings from left to right, gaps and links between them, and settings.
//!
//! Everything here is plain data in SI units. [`Model::check`] reports every fault at once, each with the
//! path of the field it concerns, so that a reader can point at the line of the file.

mod base;
mod capacity;
mod cuts;
mod diagonal;
mod fibres;
mod floor_matrices;
mod frame_members;
mod frame_wall;
mod gap;
mod given;
mod integrator;
mod isolation;
mod link_law;
mod members;
mod moment_surface;
mod plan_bearings;
mod plan_column;
mod plan_foundation;
mod plan_frame;
mod plan_spring;
mod rotation_limits;
mod shear_spring;
mod soil;
mod space_frame;
mod tiers;
mod uplift;
mod wall;

use std::collections::BTreeMap;

use crate::hysteresis::Hysteresis;

pub use base::{AcrossBase, Base, MassDamping};
pub use capacity::{
    AcrossCapacity, CapacityLine, MemberCapacity, RotationLimits, RotationMeasure, RuleCapacity,
    ShearCapacity, capacity_rule_title,
};
pub(crate) use cuts::{cuts_at, equal_cuts, halves_of_segments};
pub use diagonal::{
    Diagonal, DiagonalKind, DiagonalPlace, GridLine, PanelAcross, PanelDamage, Reach, Rise,
    StrutLine,
};
pub use fibres::{ColumnFibres, Fibre, FibreLimit, FibreMaterial};
pub(crate) use floor_matrices::displacement_in_words;
pub use floor_matrices::{FloorMatrices, GivenFloor, GivenInPlan};
pub use frame_members::FramePlace;
pub use frame_wall::{CouplingBeam, FrameWall, WallHinge};
pub use gap::{FloorPairs, Gap, LEVEL_TOLERANCE, Level, PlanContact};
pub use given::{Given, MatrixEntry};
pub use integrator::Integrator;
pub use isolation::{
    BearingBounds, BearingFactors, Isolation, Isolator, IsolatorDamping, SlidingSurface,
    SpeedFriction, Stop,
};
pub use link_law::LinkLaw;
pub use members::{JointRequest, MemberRequest};
pub use moment_surface::MomentSurface;
pub use plan_column::{ColumnLine, PlanColumn, PointOnColumn, PointsOnColumns};
pub use plan_foundation::PlanFoundationSprings;
pub use plan_frame::{LumpedFloor, PlanFrame, SharedColumn};
pub use plan_spring::{PlanAxis, PlanSpring};
pub use rotation_limits::{LimitedMembers, RotationLevel, RotationLimit};
pub use shear_spring::{ShearEnds, ShearSpring};
pub use soil::{Foundation, FoundationSprings, HalfSpace, Soil, SoilCoupling};
pub use space_frame::{SpaceFrame, SpaceMember, SpacePlace, SpaceSection, SpaceWall};
pub use tiers::{PlanArea, PlanElement, PlanPoint, Tier, TierStorey, Tiers};
pub use uplift::{BearingStrength, BedSpring, GroundSprings, Uplift};
pub use wall::Wall;

/// Buildings in a row, gaps and links between them, and the settings of the analysis.
///
/// [`Model::check`] finds all faults at once:
///
/// ```
/// use jostle::{Building, Damping, Model, Shear, Structure};
///
/// let model = Model {
///     title: "One storey too few".to_owned(),
///     buildings: vec![Building {
///         name: "A".to_owned(),
///         structure: Structure::Shear(Shear {
///             mass: vec![40e3, 40e3],
///             stiffness: vec![60e6], // one storey has no stiffness
///             storey_heights: vec![3.0, 3.0],
///         }),
///         damping: Damping::ratio(0.05, []),
///         ..Building::default()
///     }],
///     ..Model::default()
/// };
/// let faults = model.check().expect_err("the stiffness is missing");
/// assert!(faults[0].path.starts_with("building[0].stiffness"));
/// ```
///
/// The default has no buildings, gaps, links or walls, no soil, and the default [`Analysis`]. The check refuses it until it
/// has a building.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Model {
    /// Title printed on summaries and reports.
    pub title: String,
    /// Buildings from left to right; at least one.
    pub buildings: Vec<Building>,
    /// Gaps between neighbours, and between the ends of the row and walls there.
    pub gaps: Vec<Gap>,
    /// Springs and dashpots that join them.
    pub links: Vec<Link>,
    /// Walls that gaps and links can name. In [`Gap::between`] and [`Link::between`] they are counted on from the buildings.
    pub walls: Vec<Wall>,
    /// Soil under buildings with a foundation; `None` if no building has one.
    pub soil: Option<Soil>,
    /// Step sizes, tolerance and solver.
    pub analysis: Analysis,
}

/// One building: its structure, its damping and where it yields.
///
/// ```
/// use jostle::{Building, Damping, Shear, Structure};
///
/// let building = Building {
///     name: "North".to_owned(),
///     structure: Structure::Shear(Shear {
///         mass: vec![40e3, 40e3],        // kg
///         stiffness: vec![60e6, 60e6],   // N/m
///         storey_heights: vec![4.0, 3.2], // m
///     }),
///     damping: Damping::ratio(0.02, [1, 2]),
///     ..Building::default()
/// };
/// assert_eq!(building.floors(), 2);
/// assert!(building.base.is_fixed());
/// assert!(!building.may_yield());
/// ```
///
/// The default has no name and no floors, so that the check refuses it; it is undamped, elastic, fixed to the ground and
/// without effects of self weight.
#[derive(Clone, Debug, PartialEq)]
pub struct Building {
    /// Name, unique in the model.
    pub name: String,
    /// Frame of beams and columns, or storeys as springs.
    pub structure: Structure,
    /// Viscous damping.
    pub damping: Damping,
    /// Base springs and dashpots.
    pub base: Base,
    /// Effects of self weight.
    pub gravity: Gravity,
    /// Springs that crack and yield; `None` is elastic.
    pub hinges: Option<Hinges>,
    /// What stiffness-proportional damping does on parts that yield; `None` is usual: it acts on storeys and on columns and walls at
    /// points of a plan with their initial stiffness, and not on hinges of members, which stand in series with members that keep
    /// theirs. It never acts on isolators, bases, soil, or columns that fail in shear.
    pub yielding_damping: Option<ProportionalDamping>,
    /// Motion against which mass-proportional damping acts.
    pub mass_damping: MassDamping,
    /// Rotations of hinges at which members reach levels of performance; a later one replaces an earlier one.
    pub rotation_limits: Vec<RotationLimit>,
}

impl Default for Building {
    fn default() -> Self {
        Self {
            name: String::new(),
            structure: Structure::Shear(Shear {
                mass: Vec::new(),
                stiffness: Vec::new(),
                storey_heights: Vec::new(),
            }),
            damping: Damping::Rayleigh {
                alpha: 0.0,
                beta: 0.0,
            },
            base: Base::default(),
            gravity: Gravity::default(),
            hinges: None,
            yielding_damping: None,
            mass_damping: MassDamping::default(),
            rotation_limits: Vec::new(),
        }
    }
}

impl Building {
    /// Whether axial forces of its members contain self weight: where the run starts under it, and, in one plane, where columns lean under
    /// it. In space P-Delta is part of the stiffness alone.
    #[must_use]
    pub fn weight_is_in_axial_forces(&self) -> bool {
        self.gravity.preload
            || (self.gravity.p_delta && !matches!(self.structure, Structure::Tiers(_)))
    }

    /// Whether anything in it, or under it, may crack, yield or lift off.
    #[must_use]
    pub fn may_yield(&self) -> bool {
        self.hinges.is_some()
            || self.base.rotational_hinge.is_some()
            || self.base.horizontal_hinge.is_some()
            || self
                .base
                .isolation
                .is_some_and(|isolation| !isolation.is_linear())
            || self.base.lifts()
            || matches!(&self.structure, Structure::Tiers(own) if own.may_yield())
            || matches!(&self.structure, Structure::Frame(own) if own.has_yielding_parts())
    }
}

/// Effects of the weight of a building.
///
/// ```
/// use jostle::Gravity;
///
/// let gravity = Gravity { p_delta: true, ..Gravity::default() };
/// assert!(!gravity.preload);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Gravity {
    /// The run starts from the displacements under self weight.
    pub preload: bool,
    /// P-Delta from the weight above, in chord form.
    pub p_delta: bool,
}

/// Springs of a building that crack and yield.
///
/// ```
/// use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
/// use jostle::{Building, Damping, Hinges, Model, Shear, Structure, System};
///
/// // Storeys of 60 MN/m that yield at 20 mm and keep 5 % of their stiffness.
/// let corners = || Corners::bilinear(0.02, 0.05);
/// let backbone = Backbone::from_deformations(60e6, corners(), corners())
///     .map_err(|faults| faults[0].problem.clone())?;
/// assert!((backbone.force_at(0.03) / 1.23e6 - 1.0).abs() < 1e-12); // 1.2 MN + 5 % of 0.6 MN
/// let storey = Hysteresis::new(HysteresisRule::Bilinear, backbone)
///     .map_err(|faults| faults[0].problem.clone())?;
///
/// let building = Building {
///     name: "tower".to_owned(),
///     structure: Structure::Shear(Shear {
///         mass: vec![40e3; 2],
///         stiffness: vec![60e6; 2],
///         storey_heights: vec![3.0; 2],
///     }),
///     damping: Damping::ratio(0.05, []),
///     hinges: Some(Hinges::Storeys(vec![storey; 2])),
///     ..Building::default()
/// };
/// let model = Model {
///     title: "Yielding tower".to_owned(),
///     buildings: vec![building],
///     ..Model::default()
/// };
/// let system = System::assemble(&model).map_err(|faults| faults[0].to_string())?;
/// assert_eq!(system.buildings[0].spring_range().len(), 2);
/// # Ok::<(), String>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Hinges {
    /// Rotational hinges at the ends of the members of a frame.
    Frame(FrameHinges),
    /// Springs of the storeys of a shear building, from the ground up, in displacement \[m\] and force \[N\]; their
    /// initial stiffness is that of the storey.
    Storeys(Vec<Hysteresis>),
}

/// Rotational hinges at both ends of the members of a frame, in rotation \[rad\] and moment \[N·m\].
///
/// The positive side means tension at the bottom of a beam and on the right side of a column, at either end. Both
/// ends of a member have the same hinge; its sign as a rotation of the node is set when the hinge is added to the
/// frame ([`Hysteresis::mirrored`]).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrameHinges {
    /// Hinges of the columns by storey and column line; empty if columns are elastic.
    pub columns: Vec<Vec<Hysteresis>>,
    /// Hinges of the beams by floor and bay; empty if beams are elastic.
    pub beams: Vec<Vec<Hysteresis>>,
    /// Failure in shear of the columns by storey and column line; empty if their strength has no limit.
    pub shear: Vec<Vec<ShearSpring>>,
    /// Columns whose ends are made of fibres, by storey and column line from 0; they have no hinge in `columns`.
    pub fibres: BTreeMap<FramePlace, ColumnFibres>,
}

/// Structural type of a building.
#[derive(Clone, Debug, PartialEq)]
pub enum Structure {
    /// Plane frame of lumped masses, massless beams and hinges.
    Frame(Frame),
    /// One mass per floor, one spring per storey.
    Shear(Shear),
    /// Masses, damping and stiffness as matrices.
    Given(Given),
    /// Rigid floors that move in both horizontal directions and turn.
    Tiers(Tiers),
}

/// Plane frame: `storey_heights.len()` storeys, `spans.len() + 1` column lines. A floor has a joint where a column stands below it.
///
/// ```
/// use jostle::{Axial, Frame, Joint, Section};
///
/// // Concrete of 30 GPa: columns 500 × 500 mm, beams 300 × 600 mm.
/// let section = |width: f64, depth: f64| Section {
///     flexural_rigidity: 30e9 * width * depth.powi(3) / 12.0,
///     axial_rigidity: None,
///     shear_rigidity: None,
///     line_mass: 2500.0 * width * depth,
/// };
/// let frame = Frame {
///     storey_heights: vec![3.2; 2],
///     spans: vec![6.0, 6.0],
///     columns: vec![section(0.5, 0.5); 2],
///     beams: vec![section(0.3, 0.6); 2],
///     beam_mass: vec![3000.0; 2],
///     floor_mass: vec![0.0; 2],
///     column_segments: 4,
///     beam_segments: vec![4, 4],
///     ..Frame::default()
/// };
/// assert_eq!(frame.spans.len() + 1, 3); // column lines
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Storey heights from the ground up, > 0 \[m\].
    pub storey_heights: Vec<f64>,
    /// Bay widths from left to right, > 0; at least one \[m\].
    pub spans: Vec<f64>,
    /// Column section of every storey, from the ground up, except where `own_columns` says otherwise: read [`Frame::column`].
    pub columns: Vec<Section>,
    /// Beam section of every floor, from the ground up, except where `own_beams` says otherwise: read [`Frame::beam`]. Its own line mass
    /// is not used; see `beam_mass`.
    pub beams: Vec<Section>,
    /// Columns that differ from those of their storey, by storey and line; `None` where there is no column.
    pub own_columns: BTreeMap<FramePlace, Option<Section>>,
    /// Beams that differ from those of their floor, by floor and bay; `None` where there is no beam.
    pub own_beams: BTreeMap<FramePlace, Option<Section>>,
    /// Mass carried by the beams of every floor, self weight included, ≥ 0 \[kg/m\].
    pub beam_mass: Vec<f64>,
    /// Additional mass of every floor, shared equally by the columns below, ≥ 0 \[kg\].
    pub floor_mass: Vec<f64>,
    /// Weight that the columns of every floor carry beyond that of its masses, shared equally by the columns below; negative where other
    /// columns carry part of that. Empty for none \[N\].
    pub floor_load: Vec<f64>,
    /// Segments of a column line in one storey, ≥ 1 \[–\]; k segments have k − 1 interior masses.
    pub column_segments: usize,
    /// Segments of the beams of every bay, ≥ 1 \[–\].
    pub beam_segments: Vec<usize>,
    /// Axial flexibility of members.
    pub axial: Axial,
    /// Elastic hinge between beam ends and columns.
    pub joint: Joint,
    /// Braces, and struts of infill panels.
    pub diagonals: Vec<Diagonal>,
    /// Walls that stand at column lines; their sections are those of columns.
    pub walls: Vec<FrameWall>,
    /// Beams between them whose forces are followed; their sections are those of beams.
    pub coupling_beams: Vec<CouplingBeam>,
    /// Rigid zones of joints, by floor and line from 0: how far from the axes beams on either side, and columns below and above, are
    /// rigid, ≥ 0; none where there is no entry: read [`Frame::rigid_zone`] \[m\].
    pub rigid_zones: BTreeMap<FramePlace, [f64; 2]>,
    /// Depths of columns along the frame, by storey and line from 0, as far as a plan needs to know how far before their axes their faces
    /// stand; 0 where there is no entry, > 0 \[m\].
    pub column_depths: BTreeMap<FramePlace, f64>,
}

/// Cross-section of a member.
///
/// ```
/// use jostle::Section;
///
/// // A column of 500 × 500 mm, E = 30 GPa, 70 % of EI for cracks.
/// let (modulus, side): (f64, f64) = (30e9, 0.5);
/// let column = Section {
///     flexural_rigidity: 0.7 * modulus * side.powi(4) / 12.0,
///     axial_rigidity: Some(modulus * side * side),
///     shear_rigidity: None,
///     line_mass: 2500.0 * side * side,
/// };
/// assert!((column.flexural_rigidity / 109.375e6 - 1.0).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// Flexural rigidity EI, cracking factor included, > 0 \[N·m²\].
    pub flexural_rigidity: f64,
    /// Axial rigidity EA, > 0; used when the member is axially flexible \[N\].
    pub axial_rigidity: Option<f64>,
    /// Shear rigidity G A_s, > 0; `None` neglects shear deformation \[N\].
    pub shear_rigidity: Option<f64>,
    /// Self mass of columns, ≥ 0 \[kg/m\].
    pub line_mass: f64,
}

/// Axial behaviour of the members of a frame. Model files let columns of tall frames shorten by default ([`Frame::tallness`]).
///
/// ```
/// use jostle::Axial;
///
/// let axial = Axial { columns_flexible: true, ..Axial::default() };
/// assert!(!axial.beams_flexible);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Axial {
    /// Columns are axially flexible (`true`) or rigid (`false`, as in Zhang et al. 2019).
    pub columns_flexible: bool,
    /// Beams are axially flexible (`true`) or rigid, so that a floor moves as one body (`false`, the default).
    pub beams_flexible: bool,
}

/// Planar elastic hinge at both ends of every beam.
///
/// ```
/// use jostle::Joint;
///
/// let joint = Joint { rotational_stiffness: Some(2e8), ..Joint::default() }; // N·m/rad
/// assert_eq!(joint.vertical_stiffness, None); // rigid
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Joint {
    /// Rotational stiffness, > 0; `None` is rigid \[N·m/rad\].
    pub rotational_stiffness: Option<f64>,
    /// Horizontal stiffness, > 0; `None` is rigid \[N/m\].
    pub horizontal_stiffness: Option<f64>,
    /// Vertical stiffness, > 0; `None` is rigid \[N/m\].
    pub vertical_stiffness: Option<f64>,
}

/// Shear building: floor masses joined by storey springs.
///
/// ```
/// use jostle::Shear;
///
/// let shear = Shear { mass: vec![40e3; 3], stiffness: vec![60e6; 3], storey_heights: vec![3.2; 3] };
/// assert_eq!(shear.mass.len(), shear.stiffness.len());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Shear {
    /// Floor masses from the ground up, > 0 \[kg\].
    pub mass: Vec<f64>,
    /// Storey stiffnesses from the ground up, > 0 \[N/m\].
    pub stiffness: Vec<f64>,
    /// Storey heights from the ground up, > 0 \[m\].
    pub storey_heights: Vec<f64>,
}

/// The default lateral modes of [`Damping::Ratio`]: the first and the third, the first two of two, or the only one.
#[must_use]
pub fn usual_damping_modes(lateral_modes: usize) -> &'static [usize] {
    match lateral_modes {
        0 | 1 => &[1],
        2 => &[1, 2],
        _ => &[1, 3],
    }
}

/// Rayleigh damping C = α M + β K, or its definition.
///
/// ```
/// use jostle::Damping;
///
/// let two_percent = Damping::ratio(0.02, [1, 3]);
/// let usual = Damping::ratio(0.05, []); // jostle chooses the modes
/// assert_ne!(two_percent, usual);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Damping {
    /// The same ratio in one or two lateral modes (counted from 1). One mode: mass-proportional. Where fewer carry 1 % of the mass,
    /// as above a soft storey, further modes of sway count too, as many as there are floors.
    Ratio {
        /// Fraction of critical damping, 0 ≤ ratio < 1 \[–\].
        ratio: f64,
        /// Lateral modes with this ratio; empty means [`usual_damping_modes`].
        modes: Vec<usize>,
        /// Whose modes these are, of a building with a plan.
        sway: Sway,
    },
    /// The coefficients themselves.
    Rayleigh {
        /// Mass-proportional coefficient, ≥ 0 \[1/s\].
        alpha: f64,
        /// Stiffness-proportional coefficient, ≥ 0 \[s\].
        beta: f64,
    },
    /// The same ratio in every mode; needs [`Solver::Modal`], since no other solver uses all modes.
    AllModes {
        /// Fraction of critical damping, 0 ≤ ratio < 1 \[–\].
        ratio: f64,
    },
}

impl Damping {
    /// [`Damping::Ratio`] in lateral modes along the row; none named: the usual ones.
    #[must_use]
    pub fn ratio(ratio: f64, modes: impl Into<Vec<usize>>) -> Self {
        Self::Ratio {
            ratio,
            modes: modes.into(),
            sway: Sway::Along,
        }
    }
}

/// Sway of a building with a plan whose modes [`Damping::Ratio`] counts: as if it were held to move that way alone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sway {
    /// Along x.
    #[default]
    Along,
    /// Across, along y.
    Across,
    /// Both: of each mode the lower frequency is taken for the first, the higher one for the second, so that no mode between them
    /// has more than the ratio, in whichever direction.
    Both,
}

/// How stiffness-proportional damping acts on a spring. On an elastic one, both stiffnesses are the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ProportionalDamping {
    /// β times its initial stiffness, whether it has yielded or not.
    #[default]
    Initial,
    /// β times its stiffness at the start of a step, none where that falls.
    Tangent,
    /// Not at all.
    None,
}

/// Springs, dashpots and sliders that join floors of two neighbours, of a building and a rigid wall, or of one building.
/// They have no force while the buildings are at rest. Rayleigh damping of the buildings does not act on them.
///
/// ```
/// use jostle::{FloorPairs, Link};
///
/// let damper = Link {
///     between: [Some(0), Some(1)],
///     floors: FloorPairs::listed(&[(3, 3)]),
///     damping: 400e3, // N·s/m
///     ..Link::default()
/// };
/// assert_eq!(damper.floors, FloorPairs::listed(&[(3, 3)]));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Left and right building, or a wall, as in [`Gap::between`]; or one building twice: then every pair of
    /// [`FloorPairs::Listed`] names two of its floors, 0 being its base.
    pub between: [Option<usize>; 2],
    /// Points that are joined.
    pub floors: FloorPairs,
    /// Floors whose heights differ by no more than this can be joined, > 0 \[m\].
    pub level_tolerance: f64,
    /// Force per relative displacement of every link, ≥ 0 \[N/m\].
    pub stiffness: f64,
    /// Force per relative velocity of every link, ≥ 0; of viscous links per its power \[N·s/m, N·(s/m)^α\].
    pub damping: f64,
    /// How the force follows from the change of length.
    pub law: LinkLaw,
    /// Where the ends of every link stand on the site, for buildings with plans: its force acts along the line between them; inside a
    /// building from the lower to the upper floor of a pair \[m\].
    pub at: Option<[PlanPoint; 2]>,
}

impl Default for Link {
    /// A link without stiffness and damping between a wall on the left and one on the right, which the check refuses.
    fn default() -> Self {
        Self {
            between: [None; 2],
            floors: FloorPairs::Common,
            level_tolerance: LEVEL_TOLERANCE,
            stiffness: 0.0,
            damping: 0.0,
            law: LinkLaw::Linear,
            at: None,
        }
    }
}

impl Link {
    /// Whether it joins two floors of one building.
    #[must_use]
    pub fn is_inside(&self) -> bool {
        matches!(self.between, [Some(one), Some(other)] if one == other)
    }

    /// Stiffness against a small static change of length from rest; 0 of dashpots, and of springs behind a gap or a slack
    /// \[N/m\].
    #[must_use]
    pub fn initial_stiffness(&self) -> f64 {
        match &self.law {
            LinkLaw::Linear => self.stiffness,
            LinkLaw::Friction {
                stick_stiffness, ..
            } => *stick_stiffness,
            LinkLaw::Yielding(hysteresis) => hysteresis.initial_tangent(),
            LinkLaw::Viscous { .. }
            | LinkLaw::Maxwell
            | LinkLaw::Cable { .. }
            | LinkLaw::Stopper { .. } => 0.0,
        }
    }
}

/// Standard gravity \[m/s²\].
pub const STANDARD_GRAVITY: f64 = 9.806_65;

/// Settings of the analysis.
///
/// ```
/// use jostle::{Analysis, Integrator, Solver};
///
/// let analysis = Analysis {
///     tolerance: 1e-4,
///     solver: Some(Solver::Riccati),
///     integrator: Integrator::hht(0.05),
///     ..Analysis::default()
/// };
/// assert_eq!(analysis.solver.map(Solver::name), Some("riccati"));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Analysis {
    /// Free-vibration step; `None` chooses it from `tolerance` \[s\].
    pub step: Option<f64>,
    /// Step while a contact is closed; `None` chooses it from `tolerance` \[s\].
    pub contact_step: Option<f64>,
    /// Relative tolerance with automatic steps on the greatest contact force of a gap and on peak displacements,
    /// 1e-6…0.1; light grazing impacts beside strong impacts may exceed it \[–\].
    pub tolerance: f64,
    /// Storey drift beyond which a building that yields has collapsed and the run ends, 0 < drift ≤ 1 \[–\].
    pub collapse_drift: f64,
    /// Relative energy imbalance above which a run warns, > 0 \[–\].
    pub energy_tolerance: f64,
    /// Solver of the step equations; `None` picks [`Solver::Modal`] if possible with automatic steps, otherwise
    /// [`Solver::Riccati`].
    pub solver: Option<Solver>,
    /// Time integration rule.
    pub integrator: Integrator,
    /// Largest expected work of a run, as [`Plan::expected_work`](crate::Plan::expected_work) counts it; infinity
    /// for no bound \[–\].
    pub most_work: f64,
    /// Forces of columns and beams that are asked for; `[output] members` of a model file.
    pub members: MemberRequest,
    /// Whether histories hold strokes and speeds of links; `[output] links` of a model file.
    pub link_motion: bool,
    /// Least time between rows of histories, ≥ 0; `[output] interval` of a model file \[s\].
    pub row_interval: f64,
}

/// Default of [`Analysis::collapse_drift`], by judgement: members keep their strength here, and equilibrium is that of small drifts;
/// past 10 % neither can be relied on \[–\].
pub const COLLAPSE_DRIFT: f64 = 0.1;

/// Default time between rows of histories \[s\].
pub(crate) const ROW_INTERVAL: f64 = 0.005;

/// Default bound on the work of a run: some hours of computing \[–\].
pub const MOST_WORK: f64 = 5e11;

impl Default for Analysis {
    fn default() -> Self {
        Self {
            step: None,
            contact_step: None,
            tolerance: 1e-3,
            collapse_drift: COLLAPSE_DRIFT,
            energy_tolerance: 1e-6,
            solver: None,
            integrator: Integrator::default(),
            most_work: MOST_WORK,
            members: MemberRequest::default(),
            link_motion: false,
            row_interval: ROW_INTERVAL,
        }
    }
}

/// Solver of the step equations; all give the same result within rounding.
///
/// ```
/// use jostle::Solver;
///
/// assert_eq!(Solver::from_name("modal"), Some(Solver::Modal));
/// assert_eq!(Solver::Riccati.description(), "Riccati transfer matrices");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solver {
    /// Riccati transfer recursion along beams, column lines and storeys.
    Riccati,
    /// Direct stiffness, assembled and factorised by a general sparse elimination: the independent check.
    Stiffness,
    /// Total transfer equation: products of transfer matrices, as published for pounding frames. Loses digits at
    /// small steps and in tall buildings; call [`crate::transfer::ProductEquations::check_step`] first.
    Product,
    /// Elastic buildings by their modes, exact between the points of a record ([`crate::stepping::modal`]).
    Modal,
    /// Buildings of masses and springs that yield, by power series in time between changes of the springs
    /// ([`crate::stepping::series`]).
    Series,
}

impl Solver {
    /// Every solver, in the order of the documentation.
    pub const ALL: [Self; 5] = [
        Self::Riccati,
        Self::Stiffness,
        Self::Product,
        Self::Modal,
        Self::Series,
    ];

    /// The solver of a name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|solver| solver.name() == name)
    }

    /// What it does, in a few words.
    #[must_use]
    pub const fn description(self) -> &'static str {
        match self {
            Self::Riccati => "Riccati transfer matrices",
            Self::Stiffness => "direct stiffness",
            Self::Product => "product of transfer matrices",
            Self::Modal => "modes, exact between the points of the record",
            Self::Series => "power series in time, exact between changes of stiffness",
        }
    }

    /// As a model file spells it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Riccati => "riccati",
            Self::Stiffness => "stiffness",
            Self::Product => "product",
            Self::Modal => "modal",
            Self::Series => "series",
        }
    }
}

/// One fault of a model.
///
/// ```
/// use jostle::System;
/// # mod towers { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/two_towers/pair.rs")); }
/// # use towers::pair;
///
/// let mut model = pair(0.02);
/// model.buildings[0].name = "stiff".to_owned(); // the name of its neighbour
/// model.analysis.tolerance = -1.0;
/// let faults = model.check().expect_err("two faults");
/// assert!(faults.iter().any(|fault| fault.path == "analysis.tolerance"), "{faults:?}");
/// assert!(System::assemble(&model).is_err());
/// ```
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{path}: {problem}")]
pub struct ModelFault {
    /// Field, spelt as in a model file: `building[1].spans[0]`, `gap[0].width`.
    pub path: String,
    /// What is wrong and what would be right.
    pub problem: String,
}

/// How a model names a rigid wall.
pub(crate) const WALL: &str = "wall";

impl Model {
    /// The buildings on both sides of a gap or a link; `None` is a wall of any kind.
    pub(crate) fn neighbours(&self, between: [Option<usize>; 2]) -> [Option<&Building>; 2] {
        between.map(|side| side.and_then(|building| self.buildings.get(building)))
    }
}

impl Model {
    /// Whether the widths of gaps change the motion of buildings that do not touch: foundations act on each other across them.
    #[must_use]
    pub fn moves_by_gaps(&self) -> bool {
        let soil = self.soil.as_ref();
        soil.is_some_and(|soil| soil.coupling == SoilCoupling::Static)
    }

    /// The wall of a side of a gap or a link, if it is one of [`Model::walls`].
    #[must_use]
    pub fn wall(&self, side: Option<usize>) -> Option<&Wall> {
        self.walls.get(side?.checked_sub(self.buildings.len())?)
    }

    /// The buildings on both sides of a gap or a link; `None` is a wall of any kind.
    #[must_use]
    pub fn buildings_beside(&self, between: [Option<usize>; 2]) -> [Option<usize>; 2] {
        between.map(|side| side.filter(|building| *building < self.buildings.len()))
    }

    /// Whether its buildings stand in space, with plans, rather than in one plane.
    #[must_use]
    pub fn is_in_space(&self) -> bool {
        let mut buildings = self.buildings.iter();
        buildings.any(|building| matches!(building.structure, Structure::Tiers(_)))
    }
}

impl Building {
    /// Whether infill panels stand in its plane frame.
    #[must_use]
    pub fn has_panels(&self) -> bool {
        let Structure::Frame(frame) = &self.structure else {
            return false;
        };
        let mut kinds = frame.diagonals.iter().map(|diagonal| diagonal.place.kind);
        kinds.any(|kind| kind == DiagonalKind::Infill)
    }

    /// Height of every floor above the common datum, from the ground up \[m\].
    #[must_use]
    pub fn floor_levels(&self) -> Vec<f64> {
        let heights = self.floor_heights().into_iter();
        heights.map(|height| height + self.base.elevation).collect()
    }

    /// How far the outer joints of a floor, counted from 1, stand inside the left and the right edge of the building; 0 but in a
    /// plane frame with fewer bays above \[m\].
    #[must_use]
    pub fn set_back(&self, floor: usize) -> [f64; 2] {
        match &self.structure {
            Structure::Frame(frame) => frame.set_back(floor),
            _ => [0.0; 2],
        }
    }

    /// Whether neighbours can hit columns of it between floors.
    #[must_use]
    pub fn has_columns_to_hit(&self) -> bool {
        match &self.structure {
            Structure::Frame(_) => true,
            Structure::Tiers(tiers) => tiers.space_frame.is_some() || !tiers.frames.is_empty(),
            Structure::Shear(_) | Structure::Given(_) => false,
        }
    }

    /// Number of floors (= storeys).
    #[must_use]
    pub fn floors(&self) -> usize {
        self.storey_heights().len()
    }

    /// Storey heights from the ground up \[m\].
    #[must_use]
    pub fn storey_heights(&self) -> &[f64] {
        match &self.structure {
            Structure::Frame(frame) => &frame.storey_heights,
            Structure::Shear(shear) => &shear.storey_heights,
            Structure::Given(given) => &given.storey_heights,
            Structure::Tiers(tiers) => &tiers.storey_heights,
        }
    }

    /// Height of every floor above the base, from the ground up \[m\].
    #[must_use]
    pub fn floor_heights(&self) -> Vec<f64> {
        self.storey_heights()
            .iter()
            .scan(0.0, |height, storey| {
                *height += storey;
                Some(*height)
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::ContactLaw;
    use crate::contact::{LawKind, RestitutionIs};

    /// Defaults fill what a model leaves open; none of them is a model.
    #[test]
    fn defaults_without_a_building_or_a_floor_are_refused() {
        let paths = |model: Model| -> Vec<String> {
            let faults = model.check().expect_err("nothing to analyse");
            faults.into_iter().map(|fault| fault.path).collect()
        };
        assert_eq!(paths(Model::default()), ["building"]);
        for structure in [
            Building::default().structure,
            Structure::Tiers(Tiers::default()),
        ] {
            let building = Building {
                name: "empty".to_owned(),
                structure,
                ..Building::default()
            };
            let found = paths(Model {
                buildings: vec![building],
                ..Model::default()
            });
            assert_eq!(found, ["building[0].mass"]);
        }
    }

    #[test]
    fn a_narrower_gap_keeps_its_set_back() {
        let law = ContactLaw {
            kind: LawKind::Hertz,
            stiffness: 2e9,
            restitution: 1.0,
            restitution_is: RestitutionIs::Input,
        };
        let mut gap = Gap::after(0, 0.1, law);
        gap.set_width(0.04);
        assert_eq!(gap.widths, [0.04]);
        gap.widths = vec![0.25, 0.5, 2.0];
        gap.set_width(0.125);
        assert_eq!(gap.widths, [0.125, 0.375, 1.875]);
        assert_eq!((gap.width(), gap.width_of(2)), (0.125, 1.875));
    }
}
