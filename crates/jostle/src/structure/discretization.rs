//! From a building as described to lumped masses and massless elements.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::column_ends::FibreSection;
use super::column_points::{PointNode, StruckPoints};
use super::diagonals::FrameDiagonal;
use super::element::{Element, Part, Place, THETA, X, Y, index_of};
use super::frame_walls::InFrame;
use super::member_forces::{FrameMember, MemberPlace};
use super::order::{Stage, Turn};
use super::space_frame::CondensedFrame;
use super::space_joints::JointedFrame;
use super::spring_place::{BaseMotion, MemberEnd, SpringPlace};
use super::stick_model::{Hinge, Influence, Member, Node, RigidEnd, Spring, StickModel, Support};
use super::tiers::discretize_tiers;
use crate::hysteresis::{Hysteresis, Side};
use crate::model::{
    Base, Building, CouplingBeam, Frame, FrameHinges, FrameWall, Given, Hinges, Isolation, Joint,
    LumpedFloor, PointsOnColumns, ProportionalDamping, Section, SharedColumn, Shear, ShearEnds,
    ShearSpring, SpaceWall, Structure, Wall, cuts_at, equal_cuts, halves_of_segments,
};

/// A stick model and where its floors and faces are. The default has no nodes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Discretization {
    /// Masses and elements.
    pub stick_model: StickModel,
    /// The lowest node of the first column line that has a column, fixed or not.
    pub foot: Option<usize>,
    /// The mat of an isolated building; it is its foot too.
    pub mat: Option<Mat>,
    /// Reference node of every floor, from the ground up: its joint at the first column line that has one.
    pub floors: Vec<usize>,
    /// Contact nodes of the left side, from the ground up.
    pub left_face: Vec<usize>,
    /// Contact nodes of the right side, from the ground up.
    pub right_face: Vec<usize>,
    /// Positions of the springs that yield, in the order of [`crate::structure::Equations::springs`].
    pub spring_places: Vec<SpringPlace>,
    /// Columns and beams, storey by storey from the ground up, columns first; none in a shear building.
    pub members: Vec<FrameMember>,
    /// Braces and struts of frames.
    pub diagonals: Vec<FrameDiagonal>,
    /// Ends of columns that are made of fibres.
    pub sections: Vec<FibreSection>,
    /// Walls of frames.
    pub walls: Vec<InFrame<FrameWall>>,
    /// Walls of a space frame.
    pub space_walls: Vec<SpaceWall>,
    /// Beams between walls of frames.
    pub coupling_beams: Vec<InFrame<CouplingBeam>>,
    /// Centre of mass of every floor on the site, from the ground up; empty for a building in one plane \[m\].
    pub centres: Vec<[f64; 2]>,
    /// What carries a building with a plan, if that moves, and its floors, with the masses that move with them.
    pub carrier: Option<LumpedFloor>,
    /// The floors of a building with a plan, from the ground up.
    pub lumped: Vec<LumpedFloor>,
    /// Points of columns of a building with a plan between its floors that move by themselves.
    pub points: Vec<PointNode>,
    /// Names of the frames that stand in a plan.
    pub frames: Vec<String>,
    /// Columns that two of these frames share.
    pub shared_columns: Vec<SharedColumn>,
    /// The space frame that holds the floors, if no member of it has a hinge.
    pub space_frame: Option<Arc<CondensedFrame>>,
    /// The space frame that holds the floors, if a member of it has a hinge.
    pub jointed_frame: Option<Arc<JointedFrame>>,
    /// Names of the columns and walls at points of a plan, as far as they have one.
    pub element_names: Vec<Option<String>>,
    /// Height of the base above the common datum \[m\].
    pub elevation: f64,
}

/// A mat on bearings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mat {
    /// Its node, at height zero.
    pub node: usize,
    /// Its bearings.
    pub isolation: Isolation,
    /// Weight on the bearings \[N\].
    pub weight: f64,
    /// Elastic stiffness of the bearings, beside what yields or slides \[N/m\].
    pub stiffness: f64,
    /// Coefficient of the dashpot beside them \[N·s/m\].
    pub dashpot: f64,
}

impl Discretization {
    /// Lumped masses, massless members and hinges of a building.
    #[must_use]
    pub fn new(building: &Building) -> Self {
        Self::with_points(building, &StruckPoints::default())
    }

    /// The same with lumped masses at additional points of columns, for contacts between floors. In one plane the nearest lumped mass
    /// between the floors moves there if it is within a quarter of a segment; otherwise a mass is added.
    #[must_use]
    pub fn with_points(building: &Building, points: &StruckPoints) -> Self {
        let mut discretization = match &building.structure {
            Structure::Frame(frame) => {
                let hinges = match &building.hinges {
                    Some(Hinges::Frame(hinges)) => hinges,
                    _ => &FrameHinges::default(),
                };
                let points = points.on_outer_columns(frame);
                discretize_frame(frame, &building.base, hinges, &points)
            }
            Structure::Shear(shear) => {
                let springs: &[Hysteresis] = match &building.hinges {
                    Some(Hinges::Storeys(springs)) => springs,
                    _ => &[],
                };
                discretize_shear(shear, &building.base, springs)
            }
            Structure::Given(given) => discretize_given(given),
            Structure::Tiers(tiers) => {
                discretize_tiers(tiers, building.gravity, &building.base, &points.columns)
            }
        };
        discretization.elevation = building.base.elevation;
        let in_plan = matches!(building.structure, Structure::Tiers(_));
        if let (Some(isolation), false) = (&building.base.isolation, in_plan) {
            discretization.put_on_bearings(isolation);
        }
        if let Some(asked) = building.yielding_damping {
            discretization.damp_what_yields(asked);
        }
        // They stand last among what yields.
        let surfaces = discretization.sections.iter();
        let surfaces = surfaces.filter(|section| section.is_surface());
        let places = surfaces.flat_map(FibreSection::places);
        discretization
            .spring_places
            .extend(places.collect::<Vec<_>>());
        discretization
    }

    /// Sets how stiffness-proportional damping acts on the parts of the building above its base that yield.
    fn damp_what_yields(&mut self, asked: ProportionalDamping) {
        let StickModel {
            hinges,
            springs,
            yielding,
            ..
        } = &mut self.stick_model;
        // In the order of their places.
        let hinges = hinges.iter_mut().filter(|hinge| hinge.hysteresis.is_some());
        let hinges = hinges.map(|hinge| &mut hinge.proportional_damping);
        let springs = springs
            .iter_mut()
            .filter(|spring| spring.hysteresis.is_some());
        let springs = springs.map(|spring| &mut spring.proportional_damping);
        let others = yielding
            .iter_mut()
            .map(|yielding| &mut yielding.proportional_damping);
        let all = hinges.chain(springs).chain(others);
        for (hinge, place) in all.zip(&self.spring_places) {
            if place.is_damped_with_structure() {
                *hinge = asked;
            }
        }
    }

    /// A wall on its spring and dashpot, as a building of one floor that moves in a direction of the site.
    #[must_use]
    pub(crate) fn of_wall(stiffness: f64, wall: &Wall, [along, across]: [f64; 2]) -> Self {
        let mut stick_model = StickModel::default();
        let ground = stick_model.add_node(0.0, 0.0);
        stick_model.nodes[ground].support = Support::Fixed;
        // One metre up, so that it has a drift ratio, which nobody asks for.
        let floor = stick_model.add_node(0.0, 1.0);
        let node = &mut stick_model.nodes[floor];
        node.support = Support::Guided;
        node.add_mass(wall.mass);
        node.influence[X] = Influence {
            along,
            across,
            ..Influence::NONE
        };
        stick_model.springs.push(Spring {
            dashpot: wall.damping,
            proportional_damping: ProportionalDamping::None,
            ..Spring::elastic([ground, floor], stiffness)
        });
        Self {
            stick_model,
            foot: Some(ground),
            floors: vec![floor],
            left_face: vec![floor],
            right_face: vec![floor],
            ..Self::default()
        }
    }

    /// Adds mass-proportional damping of the motion relative to the mat, for a building whose equations have the same on its
    /// motion relative to the ground: C = Tᵀ α M T, T = \[−1 I\] (theory, Eq. B6).
    ///
    /// Dashpots α m between every mass and the mat take the place of those to the ground, which have −α m here.
    pub(crate) fn damp_relative_to_mat(&mut self, alpha: f64) {
        let (Some(mat), true) = (self.mat, alpha > 0.0) else {
            return;
        };
        if self.stick_model.plan_mat.is_some() {
            self.damp_relative_to_mat_in_plan(alpha);
            return;
        }
        let sticks = &mut self.stick_model;
        let Some(ground) =
            (0..sticks.nodes.len()).find(|&n| sticks.nodes[n].support == Support::Fixed)
        else {
            return;
        };
        for node in 0..sticks.nodes.len() {
            let mass = sticks.nodes[node].mass;
            if mass == 0.0 || node == ground {
                continue;
            }
            let dashpot = |from: usize, dashpot: f64| Spring {
                dashpot,
                proportional_damping: ProportionalDamping::None,
                ..Spring::elastic([from, node], 0.0)
            };
            sticks.springs.push(dashpot(ground, -alpha * mass));
            // Feet of the same mat move with it.
            if sticks.nodes[node].y > 0.0 {
                sticks.springs.push(dashpot(mat.node, alpha * mass));
            }
        }
    }

    /// Puts the feet of the building, which are fixed so far, on a mat that moves sideways on bearings.
    fn put_on_bearings(&mut self, isolation: &Isolation) {
        let Some(mat) = self.foot else { return };
        let sticks = &mut self.stick_model;
        let feet: Vec<usize> = (0..sticks.nodes.len())
            .filter(|&node| sticks.nodes[node].support == Support::Fixed)
            .collect();
        for &foot in &feet {
            sticks.nodes[foot].support = Support::Guided;
        }
        // The mat keeps its length, so that all feet move as one.
        for ends in feet.windows(2) {
            sticks.members.push(Member {
                ends: [ends[0], ends[1]],
                flexural_rigidity: 1.0,
                axial_rigidity: None,
                shear_rigidity: None,
                compression: 0.0,
            });
        }
        sticks.nodes[mat].add_mass(isolation.mat_mass);
        let mass = sticks.nodes.iter().map(|node| node.mass).sum();
        let weight = isolation.weight_of(mass);
        let ground = sticks.add_node(0.0, 0.0);
        sticks.nodes[ground].support = Support::Fixed;
        // What yields between any points comes after springs.
        let before = self.spring_places.len() - sticks.yielding.len();
        let mut places = Vec::new();
        let (elastic, yielding) = isolation.isolator.springs(weight);
        let dashpot = isolation.dashpot(mass);
        let spring = |hysteresis: Option<Hysteresis>| Spring {
            hysteresis,
            proportional_damping: ProportionalDamping::None,
            ..Spring::elastic([ground, mat], 0.0)
        };
        sticks.springs.push(Spring {
            stiffness: elastic,
            dashpot,
            ..spring(None)
        });
        if let Some(yielding) = yielding {
            sticks.springs.push(spring(Some(yielding)));
            places.push(SpringPlace::Bearings);
        }
        for (side, stop) in [Side::Negative, Side::Positive]
            .into_iter()
            .zip(isolation.stops)
        {
            if let Some(stop) = stop.and_then(|stop| stop.spring(side)) {
                sticks.springs.push(spring(Some(stop)));
                places.push(SpringPlace::Stop { side });
            }
        }
        self.spring_places.splice(before..before, places);
        self.left_face.insert(0, mat);
        self.right_face.insert(0, feet[feet.len() - 1]);
        self.mat = Some(Mat {
            node: mat,
            isolation: *isolation,
            weight,
            stiffness: elastic,
            dashpot,
        });
    }
}

impl StickModel {
    /// Adds a free node without mass and returns its index.
    pub(super) fn add_node(&mut self, x: f64, y: f64) -> usize {
        self.nodes.push(Node::at(x, y));
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
        let half_mass = 0.5 * line_mass * libm::hypot(b.x - a.x, b.y - a.y);
        let half_masses = halves_of_segments(half_mass, cuts);
        let line: Vec<usize> = std::iter::once(from)
            .chain(interior.iter().copied())
            .chain([to])
            .collect();
        for (ends, half_mass) in line.windows(2).zip(half_masses) {
            for &end in ends {
                self.nodes[end].add_mass(half_mass);
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
        let end = self.add_beside(joint);
        if properties.vertical_stiffness.is_some() {
            self.ties.remove(&index_of((end, Y)));
        }
        self.hinges.push(Hinge {
            ends: [joint, end],
            rotational_stiffness: properties.rotational_stiffness,
            hysteresis: None,
            translational_stiffness: [
                properties.horizontal_stiffness,
                properties.vertical_stiffness,
            ],
            dashpots: [0.0; 3],
            proportional_damping: ProportionalDamping::Initial,
        });
        end
    }

    /// Adds a yielding hinge between a joint and the end of a member, and returns the node at the member. Positive:
    /// tension at the bottom of a beam and on the right side of a column, which is a counter-clockwise rotation
    /// along the member, from left to right or upwards.
    fn yielding(&mut self, joint: usize, hysteresis: Hysteresis, end: MemberEnd) -> usize {
        let node = self.add_beside(joint);
        let ends = match end {
            MemberEnd::First => [node, joint],
            MemberEnd::Last => [joint, node],
        };
        self.hinges.push(Hinge::yielding(ends, hysteresis));
        node
    }

    /// Lets an end of a column move sideways against its joint by a spring that can fail, and returns the node at the
    /// column: `node`, if a hinge stands between it and the joint, otherwise a new one.
    fn shearing(
        &mut self,
        joint: usize,
        node: usize,
        hysteresis: Hysteresis,
        end: MemberEnd,
    ) -> usize {
        let node = if node == joint {
            let node = self.add_beside(joint);
            self.hinges.push(Hinge {
                ends: [joint, node],
                rotational_stiffness: None,
                hysteresis: None,
                translational_stiffness: [None; 2],
                dashpots: [0.0; 3],
                proportional_damping: ProportionalDamping::None,
            });
            node
        } else {
            node
        };
        self.ties.remove(&index_of((node, X)));
        self.slides.insert(node);
        // The spring is parallel to the hinge, which then has no stiffness sideways.
        if let Some(hinge) = self.hinges.last_mut() {
            hinge.translational_stiffness[0] = Some(0.0);
        }
        let ends = match end {
            MemberEnd::First => [joint, node],
            MemberEnd::Last => [node, joint],
        };
        self.springs.push(Spring {
            hysteresis: Some(hysteresis),
            proportional_damping: ProportionalDamping::None,
            ..Spring::elastic(ends, hysteresis.backbone().initial())
        });
        node
    }

    /// The lowest point of a column: a node fixed to the ground, or a new node beyond the springs and dashpots of a
    /// base, with the mass of the footing.
    fn add_foot(&mut self, x: f64, base: &Base) -> usize {
        let ground = self.add_node(x, 0.0);
        self.nodes[ground].support = Support::Fixed;
        if base.is_fixed() || base.isolation.is_some() {
            return ground;
        }
        let foot = self.add_node(x, 0.0);
        self.nodes[foot].add_mass(base.mass);
        // A yielding horizontal spring is parallel to the hinge, which then has only the dashpot.
        let horizontal = match base.horizontal_hinge {
            Some(hysteresis) => {
                self.springs.push(Spring {
                    hysteresis: Some(hysteresis),
                    proportional_damping: ProportionalDamping::None,
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
            // Ground in compression alone stands among what yields.
            translational_stiffness: [
                horizontal,
                base.vertical_stiffness
                    .map(|vertical_stiffness| if base.uplift { 0.0 } else { vertical_stiffness }),
            ],
            dashpots: [
                base.horizontal_damping,
                base.vertical_damping,
                base.rotational_damping,
            ],
            proportional_damping: ProportionalDamping::None,
        });
        foot
    }
}

pub(super) fn discretize_frame(
    frame: &Frame,
    base: &Base,
    hinges: &FrameHinges,
    points: &PointsOnColumns,
) -> Discretization {
    let mut stick_model = StickModel::default();
    let lines = frame.line_positions();
    // Joints by column line, where a column stands below or beams meet; those of the ground are its feet.
    let mut below: Vec<Option<usize>> = (0..lines.len())
        .map(|line| {
            let stands = frame.has_joint(0, line);
            stands.then(|| stick_model.add_foot(lines[line], base))
        })
        .collect();
    let mut discretization = Discretization {
        foot: below.iter().flatten().next().copied(),
        ..Discretization::default()
    };
    let mut all_joints = vec![below.clone()];
    let mut on_columns = BTreeMap::new();
    // Hinges come before springs, in the order of the stick model.
    let feet = (1..=lines.len()).filter(|line| frame.has_joint(0, line - 1));
    let at_the_base = |motion| {
        let feet = feet.clone();
        feet.map(move |line| SpringPlace::Base { line, motion })
    };
    if base.rotational_hinge.is_some() {
        discretization
            .spring_places
            .extend(at_the_base(BaseMotion::Rocking));
    }
    // Springs follow the hinges.
    let (mut shear_places, mut row_places) = (Vec::new(), Vec::new());
    let mut height = 0.0;
    for (storey, storey_height) in frame.storey_heights.iter().enumerate() {
        height += storey_height;
        let outer = frame.outer_lines(storey + 1);
        let joints: Vec<Option<usize>> = (0..lines.len())
            .map(|line| {
                let is_joint = frame.has_joint(storey + 1, line);
                is_joint.then(|| {
                    let node = stick_model.add_node(lines[line], height);
                    // Braces and columns above may meet the beam there.
                    if frame.column(storey, line).is_none() {
                        let stage = Some(Stage::Joints);
                        let turn = stick_model.turn(node);
                        stick_model.turns.insert(node, Turn { stage, ..turn });
                    }
                    node
                })
            })
            .collect();
        for (line, ends) in below.iter().zip(&joints).enumerate() {
            let (Some(column), (&Some(from), &Some(to))) = (frame.column(storey, line), ends)
            else {
                continue;
            };
            let is_outer = [0, 1].map(|side| outer.is_some_and(|outer| outer[side] == line));
            // Inside their joints columns are rigid.
            let rigid = frame.rigid_ends_of_column([storey, line]);
            let faces = [
                stick_model.end_of_column(from, rigid[0]),
                stick_model.end_of_column(to, -rigid[1]),
            ];
            let mut ends = faces;
            let wall = frame.wall([storey, line]);
            let grid = wall.is_none().then_some(hinges);
            let fibres = match wall {
                Some(wall) => wall.fibres.get(&(storey + 1)),
                None => hinges.fibres.get(&[storey, line]),
            };
            let hinge = grid.and_then(|grid| grid.columns.get(storey)?.get(line));
            let hinge = hinge.filter(|_| fibres.is_none());
            let shear = grid.and_then(|grid| grid.shear.get(storey)?.get(line));
            let mut column = *column;
            // A wall slides at its foot alone.
            let lowest = wall.filter(|wall| wall.storeys[0] == storey + 1);
            if let Some(hysteresis) = lowest.and_then(|lowest| lowest.shear) {
                ends[0] = stick_model.add_sliding(from, X, hysteresis);
                column.shear_rigidity = None;
                let (line, storey) = (line + 1, storey + 1);
                row_places.push(SpringPlace::sliding(MemberPlace::Column { line, storey }));
            }
            for end in [MemberEnd::First, MemberEnd::Last] {
                let at_head = end == MemberEnd::Last;
                let Some(hinge) = wall.and_then(|wall| wall.hinge_at(storey + 1, at_head)) else {
                    continue;
                };
                let node = &mut ends[end as usize];
                *node = stick_model.yielding(*node, hinge, end);
                discretization.spring_places.push(SpringPlace::Column {
                    storey: storey + 1,
                    line: line + 1,
                    end,
                });
            }
            for (joint, end) in [(faces[0], MemberEnd::First), (faces[1], MemberEnd::Last)] {
                let node = &mut ends[end as usize];
                if let Some(fibres) = fibres.filter(|fibre| fibre.at_ends[end as usize]) {
                    let place = [storey + 1, line + 1];
                    let (beyond, section) = stick_model.add_fibres(*node, fibres, place, end);
                    *node = beyond;
                    if !section.is_surface() {
                        row_places.extend(section.places());
                    }
                    discretization.sections.push(section);
                }
                if let Some(hysteresis) = hinge {
                    *node = stick_model.yielding(joint, *hysteresis, end);
                    discretization.spring_places.push(SpringPlace::Column {
                        storey: storey + 1,
                        line: line + 1,
                        end,
                    });
                }
                let fails =
                    |shear: &&ShearSpring| end == MemberEnd::First || shear.ends == ShearEnds::Both;
                if let Some(shear) = shear.filter(fails) {
                    *node = stick_model.shearing(joint, *node, shear.spring, end);
                    let (line, storey) = (line + 1, storey + 1);
                    shear_places.push(SpringPlace::Shear {
                        frame: None,
                        member: MemberPlace::Column { line, storey },
                        axis: None,
                        end,
                    });
                }
            }
            let points = points.get(&[storey, line]).into_iter().flatten();
            let cuts = frame.column_cuts([storey, line], points.clone().map(|point| point.above));
            let pushed: Vec<f64> = points
                .filter(|point| point.is_pushed)
                .map(|point| frame.share_of_column([storey, line], point.above))
                .collect();
            let first = stick_model.members.len();
            let interior = stick_model.add_line(
                ends[0],
                ends[1],
                &cuts,
                column.line_mass,
                &column,
                frame.axial.columns_flexible,
            );
            let elements = [first, stick_model.members.len() - 1];
            // A push between the floors bends the column most where it acts.
            for (point, at) in cuts_at(&cuts, &pushed).enumerate() {
                let everywhere = fibres.filter(|own| wall.is_none() && own.at_ends == [true; 2]);
                if let Some(fibres) = everywhere {
                    let (place, end) = ([storey + 1, line + 1], MemberEnd::First);
                    let (above, section) = stick_model.add_fibres(interior[at], fibres, place, end);
                    stick_model.members[first + at + 1].ends[0] = above;
                    let section = FibreSection {
                        point: Some(point + 1),
                        ..section
                    };
                    if !section.is_surface() {
                        row_places.extend(section.places());
                    }
                    discretization.sections.push(section);
                }
                let Some(hysteresis) = hinge else { continue };
                let above = stick_model.yielding(interior[at], *hysteresis, MemberEnd::First);
                stick_model.members[first + at + 1].ends[0] = above;
                let (line, storey) = (line + 1, storey + 1);
                discretization.spring_places.push(SpringPlace::Struck {
                    frame: None,
                    member: MemberPlace::Column { line, storey },
                    axis: None,
                    point: point + 1,
                });
            }
            on_columns.insert([storey, line], interior.clone());
            for (at, joint) in [from, to].into_iter().enumerate() {
                // What slides has its mass on the side of the joint.
                if rigid[at] > 0.0 || stick_model.slides.contains(&ends[at]) {
                    let between = rigid[at] * column.line_mass;
                    stick_model.carry_on_axis(joint, ends[at], between);
                }
                if rigid[at] > 0.0 {
                    stick_model.rigid_ends.push(RigidEnd {
                        joint,
                        length: rigid[at],
                        member: elements[at],
                    });
                }
            }
            discretization.members.push(FrameMember {
                frame: None,
                place: MemberPlace::Column {
                    line: line + 1,
                    storey: storey + 1,
                },
                elements: first..stick_model.members.len(),
            });
            let port = interior.into_iter().chain([to]);
            if is_outer[0] {
                discretization.left_face.extend(port.clone());
            }
            if is_outer[1] {
                discretization.right_face.extend(port);
            }
        }
        for (bay, ends) in joints.windows(2).enumerate() {
            let (Some(beam), &[Some(left), Some(right)]) = (frame.beam(storey, bay), ends) else {
                continue;
            };
            // Between the faces of walls, which turn with their axes.
            let arms = [bay, bay + 1].map(|line| frame.arm([storey, line]));
            let mut ends = [
                stick_model.face(left, arms[0]),
                stick_model.face(right, -arms[1]),
            ];
            for (node, line) in ends.iter_mut().zip([bay, bay + 1]) {
                if !frame.is_continuous(storey + 1, line) {
                    *node = stick_model.hinged(*node, &frame.joint);
                }
            }
            if let Some(hysteresis) = hinges.beams.get(storey).and_then(|row| row.get(bay)) {
                for (node, end) in ends.iter_mut().zip([MemberEnd::First, MemberEnd::Last]) {
                    *node = stick_model.yielding(*node, *hysteresis, end);
                    discretization.spring_places.push(SpringPlace::Beam {
                        floor: storey + 1,
                        bay: bay + 1,
                        end,
                    });
                }
            }
            let first = stick_model.members.len();
            let cuts = equal_cuts(frame.beam_segments[bay]);
            let coupling = frame.coupling_beam([storey, bay]);
            let (beam, parts) = match coupling.and_then(|coupling| coupling.shear) {
                None => (*beam, vec![(ends, cuts)]),
                Some(hysteresis) => {
                    let (floor, span) = (storey + 1, bay + 1);
                    row_places.push(SpringPlace::sliding(MemberPlace::Beam { floor, span }));
                    let rigid_in_shear = Section {
                        shear_rigidity: None,
                        ..*beam
                    };
                    (
                        rigid_in_shear,
                        stick_model.slide_at_middle(ends, &cuts, hysteresis),
                    )
                }
            };
            for (part_ends, cuts) in parts {
                stick_model.add_line(
                    part_ends[0],
                    part_ends[1],
                    &cuts,
                    frame.beam_mass[storey],
                    &beam,
                    frame.axial.beams_flexible,
                );
            }
            for (at, joint) in [left, right].into_iter().enumerate() {
                if arms[at] > 0.0 {
                    let between = arms[at] * frame.beam_mass[storey];
                    stick_model.carry_on_axis(joint, ends[at], between);
                }
            }
            discretization.members.push(FrameMember {
                frame: None,
                place: MemberPlace::Beam {
                    floor: storey + 1,
                    span: bay + 1,
                },
                elements: first..stick_model.members.len(),
            });
        }
        // Columns carry the floor in equal shares.
        let columns = frame.columns_in(storey) as f64;
        for (line, joint) in joints.iter().enumerate() {
            let (Some(joint), Some(_)) = (*joint, frame.column(storey, line)) else {
                continue;
            };
            stick_model.nodes[joint].add_mass(frame.floor_mass[storey] / columns);
            let load = frame.floor_load.get(storey).copied().unwrap_or(0.0);
            stick_model.nodes[joint].load = load / columns;
        }
        discretization.floors.extend(joints.iter().flatten().next());
        all_joints.push(joints.clone());
        below = joints;
    }
    if base.horizontal_hinge.is_some() {
        discretization
            .spring_places
            .extend(at_the_base(BaseMotion::Sliding));
    }
    discretization.spring_places.append(&mut shear_places);
    discretization.spring_places.append(&mut row_places);
    discretization.stick_model = stick_model;
    let walls = frame.walls.iter();
    discretization.walls = walls.map(|wall| InFrame::alone(wall.clone())).collect();
    let beams = frame.coupling_beams.iter();
    discretization.coupling_beams = beams.map(|beam| InFrame::alone(*beam)).collect();
    discretization.add_diagonals(&frame.diagonals, &all_joints, &on_columns);
    if let (Some(stiffness), true) = (base.vertical_stiffness, base.uplift) {
        discretization.let_feet_lift(&all_joints[0], stiffness);
    }
    discretization
}

/// Springs between displacements, and from each to the ground, make any symmetric matrix: off the diagonal stands −k of the
/// spring between two, and the sum of a row is the spring to the ground. Some k are negative.
fn discretize_given(given: &Given) -> Discretization {
    let mut stick_model = StickModel::default();
    let ground = stick_model.add_node(0.0, 0.0);
    stick_model.nodes[ground].support = Support::Fixed;
    let place = |dof: usize| {
        let component = if given.influence[dof] == 0.0 {
            THETA
        } else {
            X
        };
        (ground + 1 + dof, component)
    };
    for dof in 0..given.len() {
        let node = stick_model.add_node(0.0, given.heights[dof]);
        let node = &mut stick_model.nodes[node];
        let mass = given.mass[dof] * given.scale(dof).powi(2);
        if place(dof).1 == X {
            *node = node.held(Support::Guided).with_mass(mass);
        } else {
            *node = node.held(Support::Turning).with_rotary_inertia(mass);
        }
    }
    let lists = [&given.stiffness, &given.damping];
    let mut rows = vec![[0.0; 2]; given.len()];
    let elements = &mut stick_model.elements;
    let mut add = |ends: [Place; 2], part: usize, value: f64| {
        let part = [Part::Elastic, Part::Dashpot][part];
        elements.push(Element::between(ends, part, value));
    };
    for (part, &(row, column, value)) in lists
        .into_iter()
        .enumerate()
        .flat_map(|(part, list)| list.iter().map(move |entry| (part, entry)))
    {
        let value = value * given.scale(row) * given.scale(column);
        rows[row][part] += value;
        if row != column {
            rows[column][part] += value;
            add([place(row), place(column)], part, -value);
        }
    }
    for (dof, sums) in rows.into_iter().enumerate() {
        for (part, sum) in sums.into_iter().enumerate() {
            add([(ground, X), place(dof)], part, sum);
        }
    }
    let floors: Vec<usize> = given.floors.iter().map(|dof| ground + 1 + dof).collect();
    Discretization {
        stick_model,
        foot: Some(ground),
        left_face: floors.clone(),
        right_face: floors.clone(),
        floors,
        ..Discretization::default()
    }
}

fn discretize_shear(shear: &Shear, base: &Base, springs: &[Hysteresis]) -> Discretization {
    let mut stick_model = StickModel::default();
    let (mut floors, mut spring_places) = (Vec::new(), Vec::new());
    let mut below = stick_model.add_node(0.0, 0.0);
    stick_model.nodes[below].support = Support::Fixed;
    // Floors do not turn, so that only the horizontal spring of a base has something to do.
    if let Some(stiffness) = base.horizontal_stiffness {
        let foot = stick_model.add_node(0.0, 0.0);
        stick_model.nodes[foot].add_mass(base.mass);
        stick_model.nodes[foot].support = Support::Guided;
        if base.horizontal_hinge.is_some() {
            spring_places.push(SpringPlace::Base {
                line: 1,
                motion: BaseMotion::Sliding,
            });
        }
        stick_model.springs.push(Spring {
            dashpot: base.horizontal_damping,
            hysteresis: base.horizontal_hinge,
            proportional_damping: ProportionalDamping::None,
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
        let floor = stick_model.add_node(0.0, height);
        stick_model.nodes[floor].add_mass(*mass);
        stick_model.nodes[floor].support = Support::Guided;
        let hysteresis = springs.get(floors.len()).copied();
        stick_model.springs.push(Spring {
            hysteresis,
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
    Discretization {
        stick_model,
        foot: Some(foot),
        left_face: floors.clone(),
        right_face: floors.clone(),
        floors,
        spring_places,
        ..Discretization::default()
    }
}
