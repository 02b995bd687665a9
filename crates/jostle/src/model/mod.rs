//! What the user describes: buildings from left to right, the gaps and links between them, and how to compute.
//!
//! Everything here is plain data in SI units. [`Model::check`] reports every fault at once, each with the
//! path of the field it concerns, so that a reader can point at the line of the file.

mod integrator;

use crate::contact::ContactLaw;
use crate::hysteresis::Hysteresis;

pub use integrator::Integrator;

/// Buildings in a row, what stands between neighbours, and the settings of the analysis.
///
/// [`Model::check`] finds all faults at once:
///
/// ```
/// use jostle::{Analysis, Base, Building, Damping, Gravity, Model, Shear, Structure};
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
///         damping: Damping::Ratio { ratio: 0.05, modes: Vec::new() },
///         base: Base::default(),
///         gravity: Gravity::default(),
///         hinges: None,
///     }],
///     gaps: Vec::new(),
///     links: Vec::new(),
///     analysis: Analysis::default(),
/// };
/// let faults = model.check().expect_err("the stiffness is missing");
/// assert!(faults[0].path.starts_with("building[0].stiffness"));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// Title printed on summaries and reports.
    pub title: String,
    /// Buildings from left to right; at least one.
    pub buildings: Vec<Building>,
    /// Gaps between neighbours, and between the ends of the row and walls there.
    pub gaps: Vec<Gap>,
    /// Springs and dashpots that join them.
    pub links: Vec<Link>,
    /// Step sizes, tolerance and solver.
    pub analysis: Analysis,
}

/// One building: its structure, its damping and where it yields.
#[derive(Clone, Debug, PartialEq)]
pub struct Building {
    /// Name, unique in the model.
    pub name: String,
    /// Frame of beams and columns, or storeys as springs.
    pub structure: Structure,
    /// Viscous damping.
    pub damping: Damping,
    /// What the columns stand on.
    pub base: Base,
    /// What its weight does.
    pub gravity: Gravity,
    /// Where and how it cracks and yields; `None` stays elastic.
    pub hinges: Option<Hinges>,
}

impl Building {
    /// Whether anything in it, or under it, may crack or yield.
    #[must_use]
    pub fn may_yield(&self) -> bool {
        self.hinges.is_some()
            || self.base.rotational_hinge.is_some()
            || self.base.horizontal_hinge.is_some()
    }
}

/// Springs and dashpots under every column of a frame, or under a shear building as a whole. All rigid is the
/// default: the building is fixed to the ground.
///
/// The dashpots are all the damping there is here: Rayleigh damping of the building does not act on a base.
///
/// ```
/// use jostle::{Base, Gravity};
///
/// // Springs under a shear building; it starts from rest under self weight, with P-Delta.
/// let base = Base { horizontal_stiffness: Some(500e6), horizontal_damping: 2e6, ..Base::default() };
/// assert!(!base.is_fixed());
/// let gravity = Gravity { preload: true, p_delta: true };
/// assert_ne!(gravity, Gravity::default());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Base {
    /// Moment per rotation, > 0; `None` is rigid; frames only \[N·m/rad\].
    pub rotational_stiffness: Option<f64>,
    /// Force per horizontal displacement, > 0; `None` is rigid \[N/m\].
    pub horizontal_stiffness: Option<f64>,
    /// Force per vertical displacement, > 0; `None` is rigid; frames only \[N/m\].
    pub vertical_stiffness: Option<f64>,
    /// Moment per angular velocity, ≥ 0; needs a rotational stiffness \[N·m·s/rad\].
    pub rotational_damping: f64,
    /// Force per horizontal velocity, ≥ 0; needs a horizontal stiffness \[N·s/m\].
    pub horizontal_damping: f64,
    /// Force per vertical velocity, ≥ 0; needs a vertical stiffness \[N·s/m\].
    pub vertical_damping: f64,
    /// Mass of the footing, ≥ 0; moves only where the base gives way \[kg\].
    pub mass: f64,
    /// How the rotational spring yields; its initial stiffness is `rotational_stiffness`.
    pub rotational_hinge: Option<Hysteresis>,
    /// How the horizontal spring yields; its initial stiffness is `horizontal_stiffness`.
    pub horizontal_hinge: Option<Hysteresis>,
}

impl Base {
    /// Whether nothing gives way.
    #[must_use]
    pub fn is_fixed(&self) -> bool {
        self.rotational_stiffness.is_none()
            && self.horizontal_stiffness.is_none()
            && self.vertical_stiffness.is_none()
    }
}

/// What the weight of a building does, besides standing there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Gravity {
    /// The run starts from the displacements under self weight.
    pub preload: bool,
    /// The weight above leans on the sway of every column: P-Delta in chord form.
    pub p_delta: bool,
}

/// Where and how a building cracks and yields.
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
/// The positive side of a beam runs its bottom, that of a column its right face, at either end. Both ends of
/// a member have the same hinge; what is positive there as a rotation of the node has to be sorted out where the
/// hinge is put into the frame ([`Hysteresis::mirrored`]).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrameHinges {
    /// Hinges of the columns by storey and column line; empty when columns stay elastic.
    pub columns: Vec<Vec<Hysteresis>>,
    /// Hinges of the beams by floor and bay; empty when beams stay elastic.
    pub beams: Vec<Vec<Hysteresis>>,
}

/// How a building resists lateral motion.
#[derive(Clone, Debug, PartialEq)]
pub enum Structure {
    /// Plane frame of lumped masses, massless beams and hinges.
    Frame(Frame),
    /// One mass per floor, one spring per storey.
    Shear(Shear),
    /// Masses and a stiffness matrix condensed at the floors.
    Given(Given),
}

/// Plane frame: `storey_heights.len()` storeys, `spans.len() + 1` column lines.
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
///     axial: Axial::default(), // members keep their length
///     joint: Joint::default(), // rigid
/// };
/// assert_eq!(frame.spans.len() + 1, 3); // column lines
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Storey heights from the ground up, > 0 \[m\].
    pub storey_heights: Vec<f64>,
    /// Bay widths from left to right, > 0; at least one \[m\].
    pub spans: Vec<f64>,
    /// Column section of every storey, from the ground up.
    pub columns: Vec<Section>,
    /// Beam section of every floor, from the ground up. Its own line mass is not used; see `beam_mass`.
    pub beams: Vec<Section>,
    /// Mass carried by the beams of every floor, self weight included, ≥ 0 \[kg/m\].
    pub beam_mass: Vec<f64>,
    /// Further mass of every floor, shared equally by its joints, ≥ 0 \[kg\].
    pub floor_mass: Vec<f64>,
    /// Segments of a column line in one storey, ≥ 1 \[–\]; k segments have k − 1 interior masses.
    pub column_segments: usize,
    /// Segments of the beams of every bay, ≥ 1 \[–\].
    pub beam_segments: Vec<usize>,
    /// Whether members shorten under axial force.
    pub axial: Axial,
    /// Elastic hinge between beam ends and columns.
    pub joint: Joint,
}

/// Cross-section of a member.
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

/// Axial behaviour of the members of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Axial {
    /// Columns shorten (`true`) or keep their length (`false`, the default, as in Zhang et al. 2019).
    pub columns_flexible: bool,
    /// Beams shorten (`true`) or carry the whole floor along (`false`, the default).
    pub beams_flexible: bool,
}

/// Planar elastic hinge at both ends of every beam.
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
#[derive(Clone, Debug, PartialEq)]
pub struct Shear {
    /// Floor masses from the ground up, > 0 \[kg\].
    pub mass: Vec<f64>,
    /// Storey stiffnesses from the ground up, > 0 \[N/m\].
    pub stiffness: Vec<f64>,
    /// Storey heights from the ground up, > 0 \[m\].
    pub storey_heights: Vec<f64>,
}

/// A building described by matrices that were condensed at its floors, one horizontal displacement each.
///
/// It stays elastic on a fixed base, without gravity.
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    /// Floor masses from the ground up, > 0 \[kg\].
    pub mass: Vec<f64>,
    /// Rows of the stiffness matrix: symmetric, positive definite \[N/m\].
    pub stiffness: Vec<Vec<f64>>,
    /// Storey heights from the ground up, > 0 \[m\].
    pub storey_heights: Vec<f64>,
}

/// The lateral modes that [`Damping::Ratio`] takes where none are named: the first and the third, the first two of
/// two, or the only one.
#[must_use]
pub fn usual_damping_modes(lateral_modes: usize) -> &'static [usize] {
    match lateral_modes {
        0 | 1 => &[1],
        2 => &[1, 2],
        _ => &[1, 3],
    }
}

/// Rayleigh damping C = α M + β K, or what defines it.
///
/// ```
/// use jostle::Damping;
///
/// let two_percent = Damping::Ratio { ratio: 0.02, modes: vec![1, 3] };
/// let usual = Damping::Ratio { ratio: 0.05, modes: Vec::new() }; // jostle chooses the modes
/// assert_ne!(two_percent, usual);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Damping {
    /// The same ratio in one or two lateral modes (counted from 1). One mode: mass-proportional.
    Ratio {
        /// Fraction of critical damping, 0 ≤ ratio < 1 \[–\].
        ratio: f64,
        /// Lateral modes that have it; none stands for [`usual_damping_modes`].
        modes: Vec<usize>,
    },
    /// The coefficients themselves.
    Rayleigh {
        /// Mass-proportional coefficient, ≥ 0 \[1/s\].
        alpha: f64,
        /// Stiffness-proportional coefficient, ≥ 0 \[s\].
        beta: f64,
    },
    /// The same ratio in every mode; needs [`Solver::Modal`], since no other knows all modes.
    AllModes {
        /// Fraction of critical damping, 0 ≤ ratio < 1 \[–\].
        ratio: f64,
    },
}

/// The space between two neighbours, or between the building at an end of the row and a rigid wall there. A pair may
/// have several gaps, such as bumpers at some floors and bare concrete at others.
///
/// ```
/// use jostle::{ContactLaw, FloorPairs, Gap, LawKind, RestitutionIs};
///
/// let law = ContactLaw {
///     kind: LawKind::Hertz,
///     stiffness: 2e9,
///     restitution: 1.0,
///     restitution_is: RestitutionIs::Input,
/// };
/// let mut gap = Gap::after(0, 0.04, law); // 40 mm between the first building and the second
/// gap.widths = vec![0.04, 0.04, 2.0]; // the third contact is set back
/// gap.floors = FloorPairs::listed(&[(1, 1), (2, 2), (3, 3)]);
/// gap.set_width(0.05); // the smallest width; all others shift by the same amount
/// assert_eq!(gap.width(), 0.05);
/// assert!((gap.width_of(2) - 2.01).abs() < 1e-12);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Gap {
    /// Indices of the left and of the right building, the one after it; `None` is a rigid wall that moves with the
    /// ground, left of the first or right of the last building.
    pub between: [Option<usize>; 2],
    /// Widths at rest, ≥ 0: one for all contacts, or one each in the order of `floors`, from the lowest up where
    /// those are not listed \[m\].
    pub widths: Vec<f64>,
    /// Where the buildings can touch.
    pub floors: FloorPairs,
    /// Floors no further apart in height than this meet each other, > 0 \[m\].
    pub level_tolerance: f64,
    /// Contact law of every contact of this gap.
    pub law: ContactLaw,
    /// Impacts of one contact that follow each other sooner count as one, ≥ 0 \[s\].
    pub minimum_separation: f64,
}

impl Gap {
    /// A gap of one width \[m\] between building `left` and the next, wherever floors are at equal height.
    #[must_use]
    pub fn after(left: usize, width: f64, law: ContactLaw) -> Self {
        Self::between([Some(left), Some(left + 1)], width, law)
    }

    /// A gap of one width \[m\] between two neighbours, or a building and a wall, wherever floors meet.
    #[must_use]
    pub fn between(between: [Option<usize>; 2], width: f64, law: ContactLaw) -> Self {
        Self {
            between,
            widths: vec![width],
            floors: FloorPairs::Common,
            level_tolerance: LEVEL_TOLERANCE,
            law,
            minimum_separation: 0.0,
        }
    }

    /// The least width \[m\].
    #[must_use]
    pub fn width(&self) -> f64 {
        self.widths.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Width of the contact at this place of the list \[m\].
    #[must_use]
    pub fn width_of(&self, contact: usize) -> f64 {
        let only = self.widths.first().copied().unwrap_or(0.0);
        self.widths.get(contact).copied().unwrap_or(only)
    }

    /// Changes the least width \[m\]; wider contacts, such as those of a set-back, stay as much wider.
    pub fn set_width(&mut self, width: f64) {
        let least = self.width();
        for own in &mut self.widths {
            *own = width + (*own - least);
        }
    }
}

/// Linear springs and dashpots that join floors of two neighbours, or of a building and a rigid wall, and act in both
/// directions. They are free of force while the buildings are at rest. Rayleigh damping of the buildings does not act
/// on them.
///
/// ```
/// use jostle::{FloorPairs, Link};
///
/// let damper = Link {
///     between: [Some(0), Some(1)],
///     floors: FloorPairs::listed(&[(3, 3)]),
///     level_tolerance: 1e-3,
///     stiffness: 0.0,
///     damping: 400e3, // N·s/m
/// };
/// assert_eq!(damper.floors, FloorPairs::listed(&[(3, 3)]));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Left and right building, or a wall, as in [`Gap::between`].
    pub between: [Option<usize>; 2],
    /// Which points are joined.
    pub floors: FloorPairs,
    /// Floors no further apart in height than this can be joined, > 0 \[m\].
    pub level_tolerance: f64,
    /// Force per relative displacement of every link, ≥ 0 \[N/m\].
    pub stiffness: f64,
    /// Force per relative velocity of every link, ≥ 0 \[N·s/m\].
    pub damping: f64,
}

/// Floors closer in height than this meet, unless a gap or a link says otherwise \[m\].
pub const LEVEL_TOLERANCE: f64 = 1e-3;

/// Which points of two neighbours can touch, or are joined.
///
/// ```
/// use jostle::{FloorPairs, Level};
///
/// let pairs = FloorPairs::Listed(vec![
///     [Level::Floor(4), Level::Floor(5)],
///     [Level::Floor(3), Level::Height(9.6)], // against a column
/// ]);
/// assert_ne!(pairs, FloorPairs::Common);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum FloorPairs {
    /// Every pair of floors at equal height; all floors before a wall.
    Common,
    /// Every floor of either building: against the floor of the other at that height, or against its column.
    All,
    /// Pairs of points, left and right.
    Listed(Vec<[Level; 2]>),
    /// Heights above the base, at floors or between them \[m\].
    Heights(Vec<f64>),
}

/// A point of a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Level {
    /// A floor, counted from 1.
    Floor(usize),
    /// A height above the base, at a floor or at a column between floors \[m\].
    Height(f64),
    /// The wall, opposite the other point of the pair.
    Wall,
}

impl FloorPairs {
    /// Pairs (left floor, right floor), floors counted from 1.
    #[must_use]
    pub fn listed(pairs: &[(usize, usize)]) -> Self {
        let levels = pairs.iter();
        Self::Listed(
            levels
                .map(|&(left, right)| [Level::Floor(left), Level::Floor(right)])
                .collect(),
        )
    }
}

/// How to compute.
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
    /// Step in free flight; `None` chooses it from `tolerance` \[s\].
    pub step: Option<f64>,
    /// Step while a contact is closed; `None` chooses it from `tolerance` \[s\].
    pub contact_step: Option<f64>,
    /// Relative tolerance with automatic steps on the greatest contact force of a gap and on peak displacements,
    /// 1e-6…0.1; weak grazes beside strong impacts may miss it \[–\].
    pub tolerance: f64,
    /// Relative energy imbalance above which a run warns, > 0 \[–\].
    pub energy_tolerance: f64,
    /// Which equations advance a step; `None` takes [`Solver::Modal`] where it may, with automatic steps, and otherwise
    /// [`Solver::Riccati`].
    pub solver: Option<Solver>,
    /// How a step is integrated.
    pub integrator: Integrator,
    /// Most work that a run may be expected to need, as [`Plan::expected_work`](crate::Plan::expected_work) counts it;
    /// infinity for no bound \[–\].
    pub most_work: f64,
}

/// Bound on the work of a run unless more is asked for: some hours of computing \[–\].
pub const MOST_WORK: f64 = 5e11;

impl Default for Analysis {
    fn default() -> Self {
        Self {
            step: None,
            contact_step: None,
            tolerance: 1e-3,
            energy_tolerance: 1e-6,
            solver: None,
            integrator: Integrator::default(),
            most_work: MOST_WORK,
        }
    }
}

/// Which equations advance a step; all give the same answer as far as their rounding allows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solver {
    /// Riccati transfer recursion along beams, column lines and storeys.
    Riccati,
    /// Direct stiffness, assembled and factorised by a general sparse elimination: the independent check.
    Stiffness,
    /// Total transfer equation: products of transfer matrices, as published for pounding frames. Loses digits
    /// at small steps and in tall buildings; ask [`crate::transfer::ProductEquations::check_step`] first.
    Product,
    /// Elastic buildings by their modes, exact between the points of a record ([`crate::stepping::modal`]).
    Modal,
}

impl Solver {
    /// As a model file spells it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Riccati => "riccati",
            Self::Stiffness => "stiffness",
            Self::Product => "product",
            Self::Modal => "modal",
        }
    }
}

/// One fault of a model.
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
    /// The buildings on both sides of a gap or a link; `None` is a wall.
    pub(crate) fn neighbours(&self, between: [Option<usize>; 2]) -> [Option<&Building>; 2] {
        between.map(|side| side.and_then(|building| self.buildings.get(building)))
    }
}

impl Building {
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
    use crate::contact::{LawKind, RestitutionIs};

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
