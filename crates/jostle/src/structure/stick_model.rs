//! Lumped masses joined by massless beams, hinges and springs.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use super::element::Element;
use super::order::Turn;
use crate::hysteresis::Hysteresis;
use crate::linear::Row;
use crate::model::{BedSpring, ProportionalDamping};

/// Lumped masses and the massless elements between them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StickModel {
    /// Points with or without mass.
    pub nodes: Vec<Node>,
    /// Straight members, horizontal or vertical.
    pub members: Vec<Member>,
    /// Elastic hinges between coincident nodes.
    pub hinges: Vec<Hinge>,
    /// Horizontal springs.
    pub springs: Vec<Spring>,
    /// Springs and dashpots between any displacements, such as those into which given matrices are taken apart.
    pub elements: Vec<Element>,
    /// Members of a space frame whose joints have displacements of their own.
    pub space_elements: Vec<Element>,
    /// Nodes that are rotations of member ends beyond hinges.
    pub space_ends: Range<usize>,
    /// Of those of columns with points between floors: stiffness of the whole column in double curvature \[N·m/rad\].
    pub double_curvature: BTreeMap<usize, f64>,
    /// Springs over any displacements that yield, such as columns and walls at points of a plan.
    pub yielding: Vec<YieldingElement>,
    /// Rows of sections that yield on a surface: three of each, or six of each of a space frame.
    pub surfaces: Vec<YieldingElement>,
    /// The mat of an isolated building in plan.
    pub plan_mat: Option<PlanMat>,
    /// Displacements that move with others, 3 × node + component, as rows over those: joints of frames with rigid floors along their
    /// lines, and nodes that rise and sink with the rotation of a foundation.
    pub ties: BTreeMap<usize, Row>,
    /// Nodes of member ends that slide sideways against the joints beside them.
    pub slides: BTreeSet<usize>,
    /// How the rocking of a base in plan raises displacements that could rise by themselves too, as rows over that rocking.
    pub raised: BTreeMap<usize, Row>,
    /// Rigid ends of columns at joints.
    pub rigid_ends: Vec<RigidEnd>,
    /// Nodes that are not eliminated in the order of their coordinates.
    pub turns: BTreeMap<usize, Turn>,
    /// What a building in plan stands on if its base has springs.
    pub plan_base: Option<PlanBase>,
    /// Rigid foundation on springs and dashpots, if it stands on one.
    pub foundation: Option<RigidFoundation>,
    /// Contact springs of a foundation that can lift off, in one plane or in plan; they stand among the elements that yield.
    pub bed: Vec<BedSpring>,
}

/// The end of a column inside a joint, which turns with it as a rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidEnd {
    /// Node of the joint.
    pub joint: usize,
    /// Its length, > 0 \[m\].
    pub length: f64,
    /// The member of the stick model that goes on from it.
    pub member: usize,
}

/// A rigid body at the foot of a building, on springs and dashpots: it moves sideways and turns. It rises if it can lift off.
#[derive(Clone, Debug, PartialEq)]
pub struct RigidFoundation {
    /// Its node, at height zero; it carries its mass and rotary inertia.
    pub node: usize,
    /// The feet of columns, which move and turn with it.
    pub feet: Vec<usize>,
    /// Stiffness of the soil over displacement and rotation: uu, uθ, θθ \[N/m, N, N·m\].
    pub stiffness: [f64; 3],
    /// Dashpots of the soil over the same \[N·s/m, N·s, N·m·s\].
    pub damping: [f64; 3],
    /// Whether it moves sideways.
    pub sways: bool,
    /// How far its middle lies to the right of its node, which is the centre of the masses that rise with it \[m\].
    pub middle: f64,
}

/// A point with three displacements: in the plane x (right), y (up) and θ (counter-clockwise); of a floor in plan x, across and θ.
/// `influence` says which.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Distance from the left end of the building \[m\].
    pub x: f64,
    /// Height above the base \[m\].
    pub y: f64,
    /// Mass that it adds to that of the building; see [`Node::mass`].
    pub(crate) mass: f64,
    /// Weight that it carries beyond that of its mass, downwards \[N\].
    pub load: f64,
    /// What resists each of its displacements, ≥ 0: two masses and a rotary inertia \[kg, kg, kg·m²\].
    pub inertia: [f64; 3],
    /// What each of its displacements moves.
    pub influence: [Influence; 3],
    /// How it is held.
    pub support: Support,
}

impl Node {
    /// A free point in the plane, without mass.
    #[must_use]
    pub fn at(x: f64, y: f64) -> Self {
        Self {
            x,
            y,
            mass: 0.0,
            load: 0.0,
            inertia: [0.0; 3],
            influence: Influence::IN_PLANE,
            support: Support::Free,
        }
    }

    /// Mass that it adds to that of the building, ≥ 0; zero where another node counts it \[kg\].
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// The same point, held.
    #[must_use]
    pub fn held(self, support: Support) -> Self {
        Self { support, ..self }
    }

    /// Holds all its displacements but the first.
    pub(crate) fn hold_but_along(&mut self) {
        self.support = match self.support {
            Support::Fixed | Support::Turning => Support::Fixed,
            Support::Free | Support::Swaying | Support::Guided => Support::Guided,
        };
    }

    /// The same point with more mass, which resists both of its translations \[kg\].
    #[must_use]
    pub fn with_mass(mut self, mass: f64) -> Self {
        self.add_mass(mass);
        self
    }

    /// The same point with more rotary inertia \[kg·m²\].
    #[must_use]
    pub fn with_rotary_inertia(mut self, inertia: f64) -> Self {
        self.inertia[2] += inertia;
        self
    }

    /// Adds mass that resists both of its translations \[kg\].
    pub fn add_mass(&mut self, mass: f64) {
        self.mass += mass;
        self.inertia[0] += mass;
        self.inertia[1] += mass;
    }
}

/// Motion of the whole building that a displacement follows: what it moves along with a unit of it \[–, m\], and by virtual work what
/// a unit force there adds to the force on the building in that direction. Displacements between joints, such as their
/// rotations about horizontal axes, have none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Influence {
    /// Along the row \[–\].
    pub along: f64,
    /// Across the row \[–\].
    pub across: f64,
    /// Upwards \[–\].
    pub up: f64,
    /// About a vertical axis through the centre of mass of the floor at its height, or of the next above \[m; – for a
    /// rotation\].
    pub turning: f64,
}

impl Influence {
    /// No motion of the whole building.
    pub const NONE: Self = Self {
        along: 0.0,
        across: 0.0,
        up: 0.0,
        turning: 0.0,
    };

    /// A displacement along the row.
    pub const ALONG: Self = Self {
        along: 1.0,
        ..Self::NONE
    };

    /// A displacement upwards.
    pub const UP: Self = Self {
        up: 1.0,
        ..Self::NONE
    };

    /// Displacements of a point in the plane of the row.
    pub const IN_PLANE: [Self; 3] = [Self::ALONG, Self::UP, Self::NONE];

    /// Displacements of the centre of mass of a floor.
    pub const OF_FLOOR: [Self; 3] = [
        Self::ALONG,
        Self {
            across: 1.0,
            ..Self::NONE
        },
        Self {
            turning: 1.0,
            ..Self::NONE
        },
    ];

    /// Along the row, across, and about the vertical axis.
    #[must_use]
    pub fn horizontal(self) -> [f64; 3] {
        [self.along, self.across, self.turning]
    }
}

/// How a node is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Support {
    /// Not at all.
    Free,
    /// Moves with the ground.
    Fixed,
    /// Guided horizontally: neither rises nor turns.
    Guided,
    /// Only turns.
    Turning,
    /// Moves in both directions of its plane, and does not turn.
    Swaying,
}

/// Massless beam between two nodes at the same height or on the same vertical.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member {
    /// Ends.
    pub ends: [usize; 2],
    /// EI, > 0 \[N·m²\].
    pub flexural_rigidity: f64,
    /// EA \[N\]; `None` keeps the length.
    pub axial_rigidity: Option<f64>,
    /// GA_s \[N\]; `None` neglects shear deformation.
    pub shear_rigidity: Option<f64>,
    /// Axial compression from gravity, for P-Delta in its chord form \[N\].
    pub compression: f64,
}

/// Planar elastic hinge, with dashpots beside its springs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hinge {
    /// The two coincident nodes.
    pub ends: [usize; 2],
    /// Moment per relative rotation, > 0; `None` is rigid \[N·m/rad\].
    pub rotational_stiffness: Option<f64>,
    /// What the rotational spring remembers, if it yields; it then replaces `rotational_stiffness`, which must not
    /// be rigid. Positive is the rotation of the first end against the second.
    pub hysteresis: Option<Hysteresis>,
    /// Force per relative horizontal and vertical displacement; `None` is rigid \[N/m\].
    pub translational_stiffness: [Option<f64>; 2],
    /// Force and moment per relative velocity in x, y, θ, ≥ 0; not used where the hinge is rigid
    /// \[N·s/m, N·s/m, N·m·s/rad\].
    pub dashpots: [f64; 3],
    /// How stiffness-proportional damping of the building acts here.
    pub proportional_damping: ProportionalDamping,
}

impl Hinge {
    /// Gives way in rotation only, by a rule that remembers.
    #[must_use]
    pub fn yielding(ends: [usize; 2], hysteresis: Hysteresis) -> Self {
        Self {
            hysteresis: Some(hysteresis),
            proportional_damping: ProportionalDamping::None,
            ..Self::rotational(ends, hysteresis.backbone().initial())
        }
    }

    /// Gives way in rotation only and takes part in the damping of the building.
    #[must_use]
    pub fn rotational(ends: [usize; 2], stiffness: f64) -> Self {
        Self {
            ends,
            rotational_stiffness: Some(stiffness),
            hysteresis: None,
            translational_stiffness: [None, None],
            dashpots: [0.0; 3],
            proportional_damping: ProportionalDamping::Initial,
        }
    }
}

/// Horizontal spring, with a dashpot beside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring {
    /// Ends.
    pub ends: [usize; 2],
    /// Force per relative horizontal displacement, ≥ 0 \[N/m\].
    pub stiffness: f64,
    /// What the spring remembers, if it yields; it then replaces `stiffness`. Positive is the displacement of the
    /// second end against the first.
    pub hysteresis: Option<Hysteresis>,
    /// P/h: what the weight above takes from the stiffness, ≥ 0 \[N/m\].
    pub softening: f64,
    /// Force per relative velocity, ≥ 0 \[N·s/m\].
    pub dashpot: f64,
    /// How stiffness-proportional damping of the building acts here.
    pub proportional_damping: ProportionalDamping,
    /// Height between its ends over a rigid foundation, whose rotation times this height adds to the deformation, counter-clockwise
    /// like a displacement of the second end to the right; P-Delta acts on displacements alone \[m\].
    pub lever: Option<f64>,
}

impl Spring {
    /// An elastic spring that takes part in the damping of the building.
    #[must_use]
    pub fn elastic(ends: [usize; 2], stiffness: f64) -> Self {
        Self {
            ends,
            stiffness,
            hysteresis: None,
            softening: 0.0,
            dashpot: 0.0,
            proportional_damping: ProportionalDamping::Initial,
            lever: None,
        }
    }
}

/// A spring between any points that yields.
#[derive(Clone, Debug, PartialEq)]
pub struct YieldingElement {
    /// Its deformation over displacements of nodes, 3 × node + (0 horizontal, 1 vertical or across, 2 rotation).
    pub row: Row,
    /// Its force, and what it remembers.
    pub hysteresis: Hysteresis,
    /// How stiffness-proportional damping of the building acts here.
    pub proportional_damping: ProportionalDamping,
}

/// The base of a building in plan on springs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanBase {
    /// Node of its footing, which sways along and across and turns, as far as it has springs.
    pub footing: usize,
    /// Centre of mass of the footing on the site \[m\].
    pub centre: [f64; 2],
    /// Where springs act and about which it rocks \[m\].
    pub middle: [f64; 2],
    /// Node of its rocking, if it rocks: displacements of floors per height, along and across \[–\], and its rise \[m\].
    pub rocking: Option<usize>,
    /// Whether it stands on soil: the base shear is then what it takes from the building above.
    pub on_soil: bool,
    /// Whether it rises and sinks, because it can lift off.
    pub rises: bool,
    /// The node that it follows in its place, if masses that rise couple these motions.
    pub uncoupled: Option<usize>,
}

/// A mat on bearings that moves in both horizontal directions and turns.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanMat {
    /// Its node.
    pub node: usize,
    /// Its centre of mass on the site \[m\].
    pub centre: [f64; 2],
    /// Places of the bearings on the site; each takes an equal share of all \[m\].
    pub bearings: Vec<[f64; 2]>,
    /// Rows of the slider of every bearing, if bearings yield or slide.
    pub slider: Option<[Hysteresis; 3]>,
    /// Rows of the ring that stops the centre.
    pub ring: Option<[Hysteresis; 3]>,
}

impl PlanMat {
    /// Forces in plan that are the same in every direction: those of the bearings, then the ring, each with how far a rotation of
    /// the mat moves its point along x and across \[m\].
    pub fn forces(&self) -> impl Iterator<Item = ([Hysteresis; 3], [f64; 2])> + '_ {
        let [x, y] = self.centre;
        let sliders = self.bearings.iter().filter_map(move |at| {
            let levers = [y - at[1], at[0] - x];
            Some((self.slider?, levers))
        });
        sliders.chain(self.ring.map(|ring| (ring, [0.0; 2])))
    }
}
