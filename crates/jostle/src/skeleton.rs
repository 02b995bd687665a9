//! The bar-and-mass idealisation of one building: lumped masses joined by massless beams, hinges and springs.

use crate::hysteresis::Hysteresis;
use crate::model::{Base, Building, Frame, FrameHinges, Hinges, Joint, Section, Shear, Structure};

/// Lumped masses and the massless elements between them, in the plane.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skeleton {
    /// Points with or without mass.
    pub nodes: Vec<Node>,
    /// Straight members, horizontal or vertical.
    pub members: Vec<Member>,
    /// Elastic hinges between coincident nodes.
    pub hinges: Vec<Hinge>,
    /// Horizontal springs.
    pub springs: Vec<Spring>,
}

/// A point that moves by x (right), y (up) and θ (counter-clockwise).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Distance from the left end of the building \[m\].
    pub x: f64,
    /// Height above the base \[m\].
    pub y: f64,
    /// Lumped mass, ≥ 0 \[kg\].
    pub mass: f64,
    /// Rotary inertia, ≥ 0 \[kg·m²\].
    pub rotary_inertia: f64,
    /// Support.
    pub support: Support,
}

/// Support of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Support {
    /// Free.
    Free,
    /// Moves with the ground.
    Fixed,
    /// Guided horizontally: no vertical displacement, no rotation.
    Guided,
}

/// Massless beam between two nodes at the same height or on the same vertical.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member {
    /// Ends.
    pub ends: [usize; 2],
    /// EI, > 0 \[N·m²\].
    pub flexural_rigidity: f64,
    /// EA \[N\]; `None` is axially rigid.
    pub axial_rigidity: Option<f64>,
    /// GA_s \[N\]; `None` neglects shear deformation.
    pub shear_rigidity: Option<f64>,
    /// Axial compression from gravity, for P-Delta in its chord form \[N\].
    pub compression: f64,
}

/// Planar elastic hinge, with dashpots parallel to its springs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hinge {
    /// The two coincident nodes.
    pub ends: [usize; 2],
    /// Moment per relative rotation, > 0; `None` is rigid \[N·m/rad\].
    pub rotational_stiffness: Option<f64>,
    /// Hysteresis of the rotational spring, if it yields; it then replaces `rotational_stiffness`, which must not
    /// be rigid. Positive: rotation of the first end relative to the second.
    pub hysteresis: Option<Hysteresis>,
    /// Force per relative horizontal and vertical displacement; `None` is rigid \[N/m\].
    pub translational_stiffness: [Option<f64>; 2],
    /// Force and moment per relative velocity in x, y, θ, ≥ 0; not used where the hinge is rigid
    /// \[N·s/m, N·s/m, N·m·s/rad\].
    pub dashpots: [f64; 3],
    /// Whether stiffness-proportional damping of the building acts here too; never on a spring that yields.
    pub proportional_damping: bool,
}

impl Hinge {
    /// Flexible in rotation only, with hysteresis.
    #[must_use]
    pub fn yielding(ends: [usize; 2], hysteresis: Hysteresis) -> Self {
        Self {
            hysteresis: Some(hysteresis),
            proportional_damping: false,
            ..Self::rotational(ends, hysteresis.backbone().initial())
        }
    }

    /// Flexible in rotation only, and part of the damping of the building.
    #[must_use]
    pub fn rotational(ends: [usize; 2], stiffness: f64) -> Self {
        Self {
            ends,
            rotational_stiffness: Some(stiffness),
            hysteresis: None,
            translational_stiffness: [None, None],
            dashpots: [0.0; 3],
            proportional_damping: true,
        }
    }
}

/// Horizontal spring with a parallel dashpot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring {
    /// Ends.
    pub ends: [usize; 2],
    /// Force per relative horizontal displacement, ≥ 0 \[N/m\].
    pub stiffness: f64,
    /// Hysteresis of the spring, if it yields; it then replaces `stiffness`. Positive: displacement of the second
    /// end relative to the first.
    pub hysteresis: Option<Hysteresis>,
    /// P/h: reduction of the stiffness by the weight above, ≥ 0 \[N/m\].
    pub softening: f64,
    /// Force per relative velocity, ≥ 0 \[N·s/m\].
    pub dashpot: f64,
    /// Whether stiffness-proportional damping of the building acts here too.
    pub proportional_damping: bool,
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
            proportional_damping: true,
        }
    }
}

/// A skeleton with its floors and contact points.
#[derive(Clone, Debug, PartialEq)]
pub struct Idealisation {
    /// Masses and elements.
    pub skeleton: Skeleton,
    /// The lowest node of the first column line, fixed or not.
    pub foot: Option<usize>,
    /// Reference node of every floor, from the ground up: the joint of the first column line.
    pub floors: Vec<usize>,
    /// Contact nodes of the left side, from the ground up.
    pub left_face: Vec<usize>,
    /// Contact nodes of the right side, from the ground up.
    pub right_face: Vec<usize>,
    /// Positions of the springs that yield, in the order of [`crate::equations::Equations::springs`].
    pub spring_places: Vec<SpringPlace>,
}

impl Idealisation {
    /// Lumped masses, massless members and hinges of a building.
    #[must_use]
    pub fn of(building: &Building) -> Self {
        Self::with_points(building, [&[], &[]])
    }

    /// The same with lumped masses at additional heights of the left and the right side, for contacts with columns
    /// of a frame \[m\]: the nearest lumped mass between the floors moves there if it is within a quarter of a
    /// segment; otherwise a mass is added.
    #[must_use]
    pub fn with_points(building: &Building, points: [&[f64]; 2]) -> Self {
        match &building.structure {
            Structure::Frame(frame) => {
                let hinges = match &building.hinges {
                    Some(Hinges::Frame(hinges)) => hinges,
                    _ => &FrameHinges::default(),
                };
                idealise_frame(frame, &building.base, hinges, points)
            }
            Structure::Shear(shear) => {
                let springs: &[Hysteresis] = match &building.hinges {
                    Some(Hinges::Storeys(springs)) => springs,
                    _ => &[],
                };
                idealise_shear(shear, &building.base, springs)
            }
        }
    }
}

impl Skeleton {
    /// Adds a free node without mass and returns its index.
    fn add_node(&mut self, x: f64, y: f64) -> usize {
        self.nodes.push(Node {
            x,
            y,
            mass: 0.0,
            rotary_inertia: 0.0,
            support: Support::Free,
        });
        self.nodes.len() - 1
    }

    /// Joins two nodes by a beam divided at these fractions of its length; half of each segment's mass goes to
    /// either end. Returns the new nodes in between.
    fn add_line(
        &mut self,
        from: usize,
        to: usize,
        cuts: &[f64],
        line_mass: f64,
        section: &Section,
        flexible: bool,
    ) -> Vec<usize> {
        let (a, b) = (self.nodes[from], self.nodes[to]);
        let interior: Vec<usize> = cuts
            .iter()
            .map(|share| self.add_node(a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)))
            .collect();
        let half_mass = 0.5 * line_mass * (b.x - a.x).hypot(b.y - a.y);
        let segments = cuts.len() + 1;
        let starts = std::iter::once(0.0).chain(cuts.iter().copied());
        let half_masses: Vec<f64> = if *cuts == equal_cuts(segments) {
            // All equal to the last bit.
            vec![half_mass / segments as f64; segments]
        } else {
            let ends = cuts.iter().copied().chain([1.0]);
            let lengths = starts.zip(ends);
            lengths.map(|(a, b)| half_mass * (b - a)).collect()
        };
        let line: Vec<usize> = std::iter::once(from)
            .chain(interior.iter().copied())
            .chain([to])
            .collect();
        for (ends, half_mass) in line.windows(2).zip(half_masses) {
            for &end in ends {
                self.nodes[end].mass += half_mass;
            }
            self.members.push(Member {
                ends: [ends[0], ends[1]],
                flexural_rigidity: section.flexural_rigidity,
                axial_rigidity: section.axial_rigidity.filter(|_| flexible),
                shear_rigidity: section.shear_rigidity,
                compression: 0.0,
            });
        }
        interior
    }

    /// The node itself, or a new node at the same position beyond an elastic hinge.
    fn hinged(&mut self, joint: usize, properties: &Joint) -> usize {
        if *properties == Joint::default() {
            return joint;
        }
        let end = self.add_node(self.nodes[joint].x, self.nodes[joint].y);
        self.hinges.push(Hinge {
            ends: [joint, end],
            rotational_stiffness: properties.rotational_stiffness,
            hysteresis: None,
            translational_stiffness: [
                properties.horizontal_stiffness,
                properties.vertical_stiffness,
            ],
            dashpots: [0.0; 3],
            proportional_damping: true,
        });
        end
    }

    /// Adds a yielding hinge between a joint and the end of a member, and returns the node at the member. Positive:
    /// tension at the bottom of a beam and on the right side of a column, which is a counter-clockwise rotation
    /// along the member, from left to right or upwards.
    fn yielding(&mut self, joint: usize, hysteresis: Hysteresis, end: MemberEnd) -> usize {
        let node = self.add_node(self.nodes[joint].x, self.nodes[joint].y);
        let ends = match end {
            MemberEnd::First => [node, joint],
            MemberEnd::Last => [joint, node],
        };
        self.hinges.push(Hinge::yielding(ends, hysteresis));
        node
    }

    /// The lowest point of a column: a node fixed to the ground, or a new node beyond the springs and dashpots of a
    /// base, with the mass of the footing.
    fn add_foot(&mut self, x: f64, base: &Base) -> usize {
        let ground = self.add_node(x, 0.0);
        self.nodes[ground].support = Support::Fixed;
        if base.is_fixed() {
            return ground;
        }
        let foot = self.add_node(x, 0.0);
        self.nodes[foot].mass = base.mass;
        // A yielding horizontal spring is parallel to the hinge, which then has only the dashpot.
        let horizontal = match base.horizontal_hinge {
            Some(hysteresis) => {
                self.springs.push(Spring {
                    hysteresis: Some(hysteresis),
                    proportional_damping: false,
                    ..Spring::elastic([ground, foot], hysteresis.backbone().initial())
                });
                Some(0.0)
            }
            None => base.horizontal_stiffness,
        };
        self.hinges.push(Hinge {
            // As for a column: positive means tension on its right side, a counter-clockwise rotation of the foot.
            ends: [foot, ground],
            rotational_stiffness: base.rotational_stiffness,
            hysteresis: base.rotational_hinge,
            translational_stiffness: [horizontal, base.vertical_stiffness],
            dashpots: [
                base.horizontal_damping,
                base.vertical_damping,
                base.rotational_damping,
            ],
            proportional_damping: false,
        });
        foot
    }
}

/// End of a member with a hinge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MemberEnd {
    /// The lower end of a column, the left end of a beam.
    First,
    /// The upper end of a column, the right end of a beam.
    Last,
}

/// Position of a yielding spring; floors, storeys, column lines and bays count from 1, from the ground up and from
/// the left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpringPlace {
    /// At an end of a column.
    Column {
        /// Storey.
        storey: usize,
        /// Column line.
        line: usize,
        /// Which end.
        end: MemberEnd,
    },
    /// At an end of a beam.
    Beam {
        /// Floor.
        floor: usize,
        /// Bay.
        bay: usize,
        /// Which end.
        end: MemberEnd,
    },
    /// A whole storey of a shear building.
    Storey {
        /// Storey.
        storey: usize,
    },
    /// Between a column, or a whole shear building, and the ground.
    Base {
        /// Column line; 1 for a shear building.
        line: usize,
        /// Direction of yielding.
        motion: BaseMotion,
    },
}

/// Direction in which a base yields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BaseMotion {
    /// Rotation.
    Rocking,
    /// Horizontal displacement.
    Sliding,
}

impl std::fmt::Display for SpringPlace {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Column { storey, line, end } => {
                let end = match end {
                    MemberEnd::First => "foot",
                    MemberEnd::Last => "head",
                };
                write!(formatter, "column {line}, storey {storey}, {end}")
            }
            Self::Beam { floor, bay, end } => {
                let end = match end {
                    MemberEnd::First => "left",
                    MemberEnd::Last => "right",
                };
                write!(formatter, "beam {bay}, floor {floor}, {end}")
            }
            Self::Storey { storey } => write!(formatter, "storey {storey}"),
            Self::Base { line, motion } => {
                let motion = match motion {
                    BaseMotion::Rocking => "rocking",
                    BaseMotion::Sliding => "sliding",
                };
                write!(formatter, "base {line}, {motion}")
            }
        }
    }
}

fn idealise_frame(
    frame: &Frame,
    base: &Base,
    hinges: &FrameHinges,
    points: [&[f64]; 2],
) -> Idealisation {
    let mut skeleton = Skeleton::default();
    let mut lines: Vec<f64> = vec![0.0];
    for span in &frame.spans {
        lines.push(lines[lines.len() - 1] + span);
    }
    let mut below: Vec<usize> = lines.iter().map(|x| skeleton.add_foot(*x, base)).collect();
    let mut idealisation = Idealisation {
        skeleton: Skeleton::default(),
        foot: Some(below[0]),
        floors: Vec::new(),
        left_face: Vec::new(),
        right_face: Vec::new(),
        spring_places: Vec::new(),
    };
    // Hinges come before springs, in the order of the skeleton.
    let at_the_base =
        |motion| (1..=lines.len()).map(move |line| SpringPlace::Base { line, motion });
    if base.rotational_hinge.is_some() {
        idealisation
            .spring_places
            .extend(at_the_base(BaseMotion::Rocking));
    }
    let mut height = 0.0;
    for (storey, storey_height) in frame.storey_heights.iter().enumerate() {
        height += storey_height;
        let joints: Vec<usize> = lines
            .iter()
            .map(|x| skeleton.add_node(*x, height))
            .collect();
        let column = &frame.columns[storey];
        for (line, (&from, &to)) in below.iter().zip(&joints).enumerate() {
            let mut ends = [from, to];
            if let Some(hysteresis) = hinges.columns.get(storey).and_then(|row| row.get(line)) {
                for (node, end) in ends.iter_mut().zip([MemberEnd::First, MemberEnd::Last]) {
                    *node = skeleton.yielding(*node, *hysteresis, end);
                    idealisation.spring_places.push(SpringPlace::Column {
                        storey: storey + 1,
                        line: line + 1,
                        end,
                    });
                }
            }
            let mut cuts = equal_cuts(frame.column_segments);
            let faces = [line == 0, line + 1 == lines.len()].into_iter().zip(points);
            for point in faces.filter(|(is_face, _)| *is_face).flat_map(|(_, p)| p) {
                cut_at(
                    &mut cuts,
                    (point - height + storey_height) / storey_height,
                    0.25 / frame.column_segments as f64,
                );
            }
            let interior = skeleton.add_line(
                ends[0],
                ends[1],
                &cuts,
                column.line_mass,
                column,
                frame.axial.columns_flexible,
            );
            let face = interior.into_iter().chain([to]);
            if line == 0 {
                idealisation.left_face.extend(face.clone());
            }
            if line + 1 == lines.len() {
                idealisation.right_face.extend(face);
            }
        }
        for (bay, ends) in joints.windows(2).enumerate() {
            let mut ends = [
                skeleton.hinged(ends[0], &frame.joint),
                skeleton.hinged(ends[1], &frame.joint),
            ];
            if let Some(hysteresis) = hinges.beams.get(storey).and_then(|row| row.get(bay)) {
                for (node, end) in ends.iter_mut().zip([MemberEnd::First, MemberEnd::Last]) {
                    *node = skeleton.yielding(*node, *hysteresis, end);
                    idealisation.spring_places.push(SpringPlace::Beam {
                        floor: storey + 1,
                        bay: bay + 1,
                        end,
                    });
                }
            }
            skeleton.add_line(
                ends[0],
                ends[1],
                &equal_cuts(frame.beam_segments[bay]),
                frame.beam_mass[storey],
                &frame.beams[storey],
                frame.axial.beams_flexible,
            );
        }
        for &joint in &joints {
            skeleton.nodes[joint].mass += frame.floor_mass[storey] / joints.len() as f64;
        }
        idealisation.floors.push(joints[0]);
        below = joints;
    }
    if base.horizontal_hinge.is_some() {
        idealisation
            .spring_places
            .extend(at_the_base(BaseMotion::Sliding));
    }
    idealisation.skeleton = skeleton;
    idealisation
}

/// Division points of a line into equal segments, as fractions of its length.
fn equal_cuts(segments: usize) -> Vec<f64> {
    (1..segments).map(|k| k as f64 / segments as f64).collect()
}

/// Adds a division point at a fraction of the length, by moving a point that is near enough, if the fraction lies
/// inside the line.
fn cut_at(cuts: &mut Vec<f64>, share: f64, reach: f64) {
    /// Fractions closer than this coincide.
    const SAME: f64 = 1e-6;
    if !(share > SAME && share < 1.0 - SAME) || cuts.iter().any(|c| (c - share).abs() <= SAME) {
        return;
    }
    let segments = (0.25 / reach).round();
    let is_equal = |cut: f64| (cut * segments - (cut * segments).round()).abs() < SAME;
    match cuts
        .iter_mut()
        .find(|cut| is_equal(**cut) && (**cut - share).abs() <= reach)
    {
        Some(near) => *near = share,
        None => cuts.push(share),
    }
    cuts.sort_by(f64::total_cmp);
}

fn idealise_shear(shear: &Shear, base: &Base, springs: &[Hysteresis]) -> Idealisation {
    let mut skeleton = Skeleton::default();
    let (mut floors, mut spring_places) = (Vec::new(), Vec::new());
    let mut below = skeleton.add_node(0.0, 0.0);
    skeleton.nodes[below].support = Support::Fixed;
    // Floors do not rotate, so only the horizontal spring of a base acts.
    if let Some(stiffness) = base.horizontal_stiffness {
        let foot = skeleton.add_node(0.0, 0.0);
        skeleton.nodes[foot].mass = base.mass;
        skeleton.nodes[foot].support = Support::Guided;
        if base.horizontal_hinge.is_some() {
            spring_places.push(SpringPlace::Base {
                line: 1,
                motion: BaseMotion::Sliding,
            });
        }
        skeleton.springs.push(Spring {
            dashpot: base.horizontal_damping,
            hysteresis: base.horizontal_hinge,
            proportional_damping: false,
            ..Spring::elastic([below, foot], stiffness)
        });
        below = foot;
    }
    let foot = below;
    let mut height = 0.0;
    for ((mass, stiffness), storey_height) in shear
        .mass
        .iter()
        .zip(&shear.stiffness)
        .zip(&shear.storey_heights)
    {
        height += storey_height;
        let floor = skeleton.add_node(0.0, height);
        skeleton.nodes[floor].mass = *mass;
        skeleton.nodes[floor].support = Support::Guided;
        let hysteresis = springs.get(floors.len()).copied();
        skeleton.springs.push(Spring {
            hysteresis,
            proportional_damping: hysteresis.is_none(),
            ..Spring::elastic([below, floor], *stiffness)
        });
        floors.push(floor);
        if hysteresis.is_some() {
            spring_places.push(SpringPlace::Storey {
                storey: floors.len(),
            });
        }
        below = floor;
    }
    Idealisation {
        skeleton,
        foot: Some(foot),
        left_face: floors.clone(),
        right_face: floors.clone(),
        floors,
        spring_places,
    }
}
