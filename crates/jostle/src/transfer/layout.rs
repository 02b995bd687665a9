//! Column lines and beams, derived from the geometry of a stick model.

use super::{BeamSegment, Heading, LumpedMass, PlanarHinge, Transfer};
use crate::linear::StepMatrix;
use crate::linear::sort_by;
use crate::structure::AssembledBuilding;
use crate::structure::Equations;
use crate::structure::element::{THETA, X, Y};
use crate::structure::stick_elements;
use crate::structure::{StickModel, Support};

/// Two heights or positions closer than this coincide \[m\].
const SAME: f64 = 1e-6;

/// A stick model without a transfer path.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NotAFrame {
    /// No node is fixed.
    #[error("no node is fixed; transfer starts at fixed bases")]
    NoBase,
    /// A spring yields, and its stiffness changes from step to step.
    #[error(
        "it has hinges or storeys that yield; this form of the method is for elastic buildings"
    )]
    Yields,
    /// Its storeys deform by the rotation of a foundation.
    #[error(
        "it stands on a foundation that turns; this form of the method is for bases that do not"
    )]
    Turns,
    /// Its beams meet the faces of walls.
    #[error(
        "its beams meet walls at their faces; this form of the method is for beams between the axes of columns"
    )]
    Walls,
    /// Its members are rigid inside their joints.
    #[error(
        "its members are rigid inside their joints; this form of the method is for members that bend from axis to axis"
    )]
    RigidEnds,
    /// A node is on no column line and no beam.
    #[error("node {node} lies on no column line and on no beam")]
    LooseNode {
        /// Index of the node.
        node: usize,
    },
    /// An element belongs to no column line and to no beam.
    #[error("{element} belongs to no column line and to no beam between neighbouring column lines")]
    LooseElement {
        /// Name: "member 3", "hinge 0", "spring 1".
        element: String,
    },
    /// A column line branches upwards.
    #[error("more than one element leads up from node {node}")]
    Branches {
        /// Index of the node.
        node: usize,
    },
    /// A beam whose ends are not at one height.
    #[error("the beam from node {from} to node {to} is not level")]
    NotLevel {
        /// Left end.
        from: usize,
        /// Right end.
        to: usize,
    },
    /// A node with a support above the base, other than the floors of a shear building.
    #[error("node {node} is guided, which only floors of a shear building may be")]
    Guided {
        /// Index of the node.
        node: usize,
    },
    /// The last column line is traversed downwards and must begin at a beam.
    #[error("no beam meets the head of the last column line at node {node}")]
    HeadWithoutBeam {
        /// Index of the node.
        node: usize,
    },
}

/// An element of a line and its direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Link {
    Member(usize),
    Hinge(usize),
    Spring(usize),
}

/// A column line: nodes from the base up, and the link below each of them except the first.
#[derive(Clone, Debug)]
pub(super) struct ColumnLine {
    pub(super) nodes: Vec<usize>,
    pub(super) links: Vec<Link>,
}

/// A beam between neighbouring column lines: all nodes from the left joint to the right one, and the links
/// between them.
#[derive(Clone, Debug)]
pub(super) struct BeamLine {
    /// Index of the column line on the left.
    pub(super) bay: usize,
    /// Indices of the joints in the column lines on the left and on the right.
    pub(super) joints: [usize; 2],
    pub(super) nodes: Vec<usize>,
    pub(super) links: Vec<Link>,
}

/// Column lines and beams of a stick model.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    /// From left to right.
    pub(super) columns: Vec<ColumnLine>,
    /// Bay by bay, from the lowest up.
    pub(super) beams: Vec<BeamLine>,
    /// Per column line and index: the beam that ends there and the one that begins there.
    pub(super) beams_at_joint: Vec<Vec<[Option<usize>; 2]>>,
    /// Per node and component: the degree of freedom of which the node has the load and the displacement. A shared
    /// displacement belongs to the first of its nodes.
    pub(super) carried: Vec<[Option<usize>; 3]>,
    pub(super) stick_model: StickModel,
}

impl Layout {
    pub(super) fn new(building: &AssembledBuilding) -> Result<Self, NotAFrame> {
        let stick_model = &building.discretization.stick_model;
        if !building.equations.springs.is_empty() {
            return Err(NotAFrame::Yields);
        }
        if stick_model.foundation.is_some() {
            return Err(NotAFrame::Turns);
        }
        if !building.discretization.walls.is_empty() {
            return Err(NotAFrame::Walls);
        }
        if !building.discretization.stick_model.ties.is_empty() {
            return Err(NotAFrame::RigidEnds);
        }
        let elements = elements(stick_model);
        let mut around = vec![Vec::new(); stick_model.nodes.len()];
        for &(link, [a, b]) in &elements {
            around[a].push((link, b));
            around[b].push((link, a));
        }
        let columns = column_lines(stick_model, &around)?;
        let beams = beam_lines(stick_model, &around, &columns)?;
        let mut beams_at_joint: Vec<Vec<[Option<usize>; 2]>> = columns
            .iter()
            .map(|line| vec![[None; 2]; line.nodes.len()])
            .collect();
        for (index, beam) in beams.iter().enumerate() {
            beams_at_joint[beam.bay][beam.joints[0]][1] = Some(index);
            beams_at_joint[beam.bay + 1][beam.joints[1]][0] = Some(index);
        }
        let layout = Self {
            columns,
            beams,
            beams_at_joint,
            carried: carried(&building.equations, stick_model.nodes.len()),
            stick_model: stick_model.clone(),
        };
        layout.check_all_found(&elements)?;
        Ok(layout)
    }

    /// Transfer through a link, with the stiffness that the step matrix gives it.
    pub(super) fn transfer(&self, link: Link, heading: Heading, matrix: &StepMatrix) -> Transfer {
        match link {
            Link::Member(index) => {
                let member = &self.stick_model.members[index];
                let [a, b] = member.ends.map(|end| self.stick_model.nodes[end]);
                let segment = BeamSegment {
                    length: (b.x - a.x).abs().max((b.y - a.y).abs()),
                    flexural_rigidity: member.flexural_rigidity,
                    axial_rigidity: member.axial_rigidity,
                    shear_rigidity: member.shear_rigidity,
                    compression: member.compression,
                };
                segment.stiffened(matrix.stiffness).transfer(heading)
            }
            Link::Hinge(index) => {
                let hinge = &self.stick_model.hinges[index];
                let weight = stick_elements::part_of(hinge.proportional_damping).weight(matrix);
                let in_step = |stiffness: Option<f64>, component: usize| {
                    stiffness.map(|k| weight * k + matrix.dashpots * hinge.dashpots[component])
                };
                PlanarHinge {
                    rotational_stiffness: in_step(hinge.rotational_stiffness, THETA),
                    horizontal_stiffness: in_step(hinge.translational_stiffness[X], X),
                    vertical_stiffness: in_step(hinge.translational_stiffness[Y], Y),
                }
                .transfer()
            }
            // Floors of a shear building move only horizontally: a hinge that is flexible in x only.
            Link::Spring(index) => {
                let spring = &self.stick_model.springs[index];
                let weight = stick_elements::part_of(spring.proportional_damping).weight(matrix);
                PlanarHinge {
                    horizontal_stiffness: Some(
                        weight * spring.stiffness - spring.softening
                            + matrix.dashpots * spring.dashpot,
                    ),
                    ..PlanarHinge::default()
                }
                .transfer()
            }
        }
    }

    /// Transfer through the lumped mass of a node, without loads.
    pub(super) fn mass(&self, node: usize, mass_factor: f64) -> Transfer {
        let node = &self.stick_model.nodes[node];
        let mass = LumpedMass {
            mass: node.inertia[X],
            rotary_inertia: node.inertia[THETA],
        };
        mass.transfer(mass_factor, [0.0; 3])
    }

    /// Height of a node above the base \[m\].
    pub(super) fn height(&self, node: usize) -> f64 {
        self.stick_model.nodes[node].y
    }

    fn check_all_found(&self, elements: &[(Link, [usize; 2])]) -> Result<(), NotAFrame> {
        if !self.stick_model.elements.is_empty() {
            return Err(NotAFrame::LooseElement {
                element: "an entry of a given matrix".into(),
            });
        }
        let mut met = vec![false; self.stick_model.nodes.len()];
        let mut passed = Vec::new();
        let columns = self.columns.iter().map(|line| (&line.nodes, &line.links));
        let beams = self.beams.iter().map(|line| (&line.nodes, &line.links));
        for (nodes, links) in columns.chain(beams) {
            nodes.iter().for_each(|&node| met[node] = true);
            passed.extend(links.iter().copied());
        }
        let loose = elements.iter().find(|(link, _)| !passed.contains(link));
        if let Some((link, _)) = loose {
            return Err(NotAFrame::LooseElement {
                element: match link {
                    Link::Member(index) => format!("member {index}"),
                    Link::Hinge(index) => format!("hinge {index}"),
                    Link::Spring(index) => format!("spring {index}"),
                },
            });
        }
        if let Some(node) = met.iter().position(|met| !met) {
            return Err(NotAFrame::LooseNode { node });
        }
        for (index, node) in self.stick_model.nodes.iter().enumerate() {
            let at_spring = |(link, ends): &(Link, [usize; 2])| {
                matches!(link, Link::Spring(_)) && ends.contains(&index)
            };
            let at_other = |(link, ends): &(Link, [usize; 2])| {
                !matches!(link, Link::Spring(_)) && ends.contains(&index)
            };
            let guided = node.support == Support::Guided;
            let sound = match node.support {
                Support::Fixed | Support::Turning => true,
                Support::Guided => !elements.iter().any(at_other),
                Support::Free | Support::Swaying => !elements.iter().any(at_spring),
            };
            if !sound {
                return Err(if guided {
                    NotAFrame::Guided { node: index }
                } else {
                    NotAFrame::LooseNode { node: index }
                });
            }
        }
        Ok(())
    }
}

/// Every element with its ends.
fn elements(stick_model: &StickModel) -> Vec<(Link, [usize; 2])> {
    let members = stick_model.members.iter().enumerate();
    let hinges = stick_model.hinges.iter().enumerate();
    let springs = stick_model.springs.iter().enumerate();
    members
        .map(|(index, member)| (Link::Member(index), member.ends))
        .chain(hinges.map(|(index, hinge)| (Link::Hinge(index), hinge.ends)))
        .chain(springs.map(|(index, spring)| (Link::Spring(index), spring.ends)))
        .collect()
}

fn carried(equations: &Equations, nodes: usize) -> Vec<[Option<usize>; 3]> {
    let mut taken = vec![false; equations.len()];
    (0..nodes)
        .map(|node| {
            [X, Y, THETA].map(|component| {
                let dof = equations.dof((node, component))?;
                (!std::mem::replace(&mut taken[dof], true)).then_some(dof)
            })
        })
        .collect()
}

/// From every fixed node up to the top.
fn column_lines(
    stick_model: &StickModel,
    around: &[Vec<(Link, usize)>],
) -> Result<Vec<ColumnLine>, NotAFrame> {
    let nodes = &stick_model.nodes;
    let mut bases: Vec<usize> = (0..nodes.len())
        .filter(|&node| nodes[node].support == Support::Fixed)
        .collect();
    if bases.is_empty() {
        return Err(NotAFrame::NoBase);
    }
    sort_by(&mut bases, |&a, &b| nodes[a].x.total_cmp(&nodes[b].x));
    let mut columns = Vec::new();
    for base in bases {
        let mut line = ColumnLine {
            nodes: vec![base],
            links: Vec::new(),
        };
        let mut at = base;
        loop {
            // Base springs connect the ground to a foot at the same position.
            let on_ground = nodes[at].support == Support::Fixed;
            let mut up = around[at].iter().filter(|(link, to)| {
                let above = nodes[*to].y > nodes[at].y + SAME;
                let foot = on_ground && !matches!(link, Link::Member(_));
                (above || foot) && (nodes[*to].x - nodes[at].x).abs() <= SAME
            });
            let Some(&(link, to)) = up.next() else { break };
            if up.next().is_some() {
                return Err(NotAFrame::Branches { node: at });
            }
            line.links.push(link);
            line.nodes.push(to);
            at = to;
        }
        columns.push(line);
    }
    Ok(columns)
}

/// From every joint to the right, until the next column line.
fn beam_lines(
    stick_model: &StickModel,
    around: &[Vec<(Link, usize)>],
    columns: &[ColumnLine],
) -> Result<Vec<BeamLine>, NotAFrame> {
    let nodes = &stick_model.nodes;
    let mut place = vec![None; nodes.len()];
    for (column, line) in columns.iter().enumerate() {
        for (index, &node) in line.nodes.iter().enumerate() {
            place[node] = Some((column, index));
        }
    }
    let mut beams = Vec::new();
    for (column, line) in columns.iter().enumerate() {
        for (joint, &from) in line.nodes.iter().enumerate().skip(1) {
            for &(link, to) in &around[from] {
                if line.nodes.contains(&to) {
                    continue;
                }
                let (mut links, mut path) = (vec![link], vec![from, to]);
                let mut at = to;
                while place[at].is_none() {
                    let back = links[links.len() - 1];
                    let mut ahead = around[at].iter().filter(|(link, _)| *link != back);
                    let (Some(&(link, next)), None) = (ahead.next(), ahead.next()) else {
                        break;
                    };
                    if path.contains(&next) {
                        break;
                    }
                    links.push(link);
                    path.push(next);
                    at = next;
                }
                // Beams that end at this column line are found from the left one.
                if nodes[at].x < nodes[from].x - SAME {
                    continue;
                }
                if path
                    .iter()
                    .any(|&node| (nodes[node].y - nodes[from].y).abs() > SAME)
                {
                    return Err(NotAFrame::NotLevel { from, to: at });
                }
                let end = place[at].filter(|(right, _)| *right == column + 1);
                let known = |beam: &BeamLine| beam.bay == column && beam.nodes[0] == from;
                // Parallel beams and dead ends remain.
                if let Some((_, end)) = end.filter(|_| !beams.iter().any(known)) {
                    beams.push(BeamLine {
                        bay: column,
                        joints: [joint, end],
                        nodes: path,
                        links,
                    });
                }
            }
        }
    }
    Ok(beams)
}
