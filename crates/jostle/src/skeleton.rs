//! The bar-and-mass idealisation of one building: lumped masses joined by massless beams, hinges and springs.

use crate::model::{Building, Frame, Section, Shear, Structure};

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
    /// How it is held.
    pub support: Support,
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

/// Planar elastic hinge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hinge {
    /// The two coincident nodes.
    pub ends: [usize; 2],
    /// Moment per relative rotation, > 0 \[N·m/rad\].
    pub rotational_stiffness: f64,
    /// Force per relative horizontal and vertical displacement; `None` is rigid \[N/m\].
    pub translational_stiffness: [Option<f64>; 2],
}

/// Horizontal spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring {
    /// Ends.
    pub ends: [usize; 2],
    /// Force per relative horizontal displacement, ≥ 0 \[N/m\].
    pub stiffness: f64,
}

/// A skeleton and where its floors and faces are.
#[derive(Clone, Debug, PartialEq)]
pub struct Idealisation {
    /// Masses and elements.
    pub skeleton: Skeleton,
    /// Node that stands for every floor, from the ground up: the joint of the first column line.
    pub floors: Vec<usize>,
    /// Nodes of the left face from the ground up that can be hit.
    pub left_face: Vec<usize>,
    /// Nodes of the right face from the ground up that can be hit.
    pub right_face: Vec<usize>,
}

impl Idealisation {
    /// Lumped masses, massless members and hinges of a building.
    #[must_use]
    pub fn of(building: &Building) -> Self {
        match &building.structure {
            Structure::Frame(frame) => idealise_frame(frame),
            Structure::Shear(shear) => idealise_shear(shear),
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

    /// Joins two nodes by a beam of `segments` equal members; half of each segment's mass goes to either end.
    /// Returns the new nodes in between.
    fn add_line(
        &mut self,
        from: usize,
        to: usize,
        segments: usize,
        line_mass: f64,
        section: &Section,
        flexible: bool,
    ) -> Vec<usize> {
        let (a, b) = (self.nodes[from], self.nodes[to]);
        let at = |k: usize| {
            let share = k as f64 / segments as f64;
            (a.x + share * (b.x - a.x), a.y + share * (b.y - a.y))
        };
        let interior: Vec<usize> = (1..segments)
            .map(|k| self.add_node(at(k).0, at(k).1))
            .collect();
        let half_mass = 0.5 * line_mass * (b.x - a.x).hypot(b.y - a.y) / segments as f64;
        let line: Vec<usize> = std::iter::once(from)
            .chain(interior.iter().copied())
            .chain([to])
            .collect();
        for ends in line.windows(2) {
            for &end in ends {
                self.nodes[end].mass += half_mass;
            }
            self.members.push(Member {
                ends: [ends[0], ends[1]],
                flexural_rigidity: section.flexural_rigidity,
                axial_rigidity: section.axial_rigidity.filter(|_| flexible),
                shear_rigidity: None,
                compression: 0.0,
            });
        }
        interior
    }

    /// The node itself, or behind an elastic hinge a new one at the same place.
    fn hinged(&mut self, joint: usize, rotational_stiffness: Option<f64>) -> usize {
        let Some(rotational_stiffness) = rotational_stiffness else {
            return joint;
        };
        let end = self.add_node(self.nodes[joint].x, self.nodes[joint].y);
        self.hinges.push(Hinge {
            ends: [joint, end],
            rotational_stiffness,
            translational_stiffness: [None, None],
        });
        end
    }
}

fn idealise_frame(frame: &Frame) -> Idealisation {
    let mut skeleton = Skeleton::default();
    let mut lines: Vec<f64> = vec![0.0];
    for span in &frame.spans {
        lines.push(lines[lines.len() - 1] + span);
    }
    let mut below: Vec<usize> = lines.iter().map(|x| skeleton.add_node(*x, 0.0)).collect();
    for &base in &below {
        skeleton.nodes[base].support = Support::Fixed;
    }
    let mut idealisation = Idealisation {
        skeleton: Skeleton::default(),
        floors: Vec::new(),
        left_face: Vec::new(),
        right_face: Vec::new(),
    };
    let mut height = 0.0;
    for (storey, storey_height) in frame.storey_heights.iter().enumerate() {
        height += storey_height;
        let joints: Vec<usize> = lines
            .iter()
            .map(|x| skeleton.add_node(*x, height))
            .collect();
        let column = &frame.columns[storey];
        for (line, (&from, &to)) in below.iter().zip(&joints).enumerate() {
            let interior = skeleton.add_line(
                from,
                to,
                frame.column_segments,
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
            let stiffness = frame.joint.rotational_stiffness;
            let (from, to) = (
                skeleton.hinged(ends[0], stiffness),
                skeleton.hinged(ends[1], stiffness),
            );
            skeleton.add_line(
                from,
                to,
                frame.beam_segments[bay],
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
    idealisation.skeleton = skeleton;
    idealisation
}

fn idealise_shear(shear: &Shear) -> Idealisation {
    let mut skeleton = Skeleton::default();
    let mut below = skeleton.add_node(0.0, 0.0);
    skeleton.nodes[below].support = Support::Fixed;
    let mut height = 0.0;
    let mut floors = Vec::new();
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
        skeleton.springs.push(Spring {
            ends: [below, floor],
            stiffness: *stiffness,
        });
        floors.push(floor);
        below = floor;
    }
    Idealisation {
        skeleton,
        left_face: floors.clone(),
        right_face: floors.clone(),
        floors,
    }
}
