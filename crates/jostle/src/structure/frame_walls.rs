//! Walls of a frame: rigid arms from their axes to their faces, and members whose shear yields.

use super::element::{THETA, X, Y, index_of, over_nodes};
use super::spring_place::SpringPlace;
use super::stick_model::{Hinge, StickModel, YieldingElement};
use super::{Discretization, MemberPlace};
use crate::hysteresis::Hysteresis;
use crate::model::ProportionalDamping;

/// Cuts closer than this to the middle of a beam are there, as a fraction of its half \[–\].
const AT_MIDDLE: f64 = 1e-9;

/// A part of a frame, which may be one of several that stand in a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InFrame<T> {
    /// Index of its frame in [`Discretization::frames`]; `None` where the building is one frame.
    pub frame: Option<usize>,
    /// The part.
    pub part: T,
}

impl<T> InFrame<T> {
    /// Of a building that is one frame.
    pub(super) fn alone(part: T) -> Self {
        Self { frame: None, part }
    }

    /// The same in a frame of a plan.
    pub(super) fn in_plan(self, frame: usize) -> Self {
        let frame = Some(frame);
        Self { frame, ..self }
    }
}

impl StickModel {
    /// A new node at the place of another, to which the same beams and walls belong.
    pub(super) fn add_beside(&mut self, node: usize) -> usize {
        let model_node = self.nodes[node];
        let new = self.add_node(model_node.x, model_node.y);
        if self.slides.contains(&node) {
            self.slides.insert(new);
        }
        if let Some(turn) = self.turns.get(&node).copied() {
            self.turns.insert(new, turn);
        }
        for component in [X, Y] {
            if let Some(tie) = self.ties.get(&index_of((node, component))).cloned() {
                self.ties.insert(index_of((new, component)), tie);
            }
        }
        new
    }

    /// The same, which moves with the other except along one component.
    fn add_following(&mut self, node: usize, free: usize) -> usize {
        let new = self.add_beside(node);
        self.ties.remove(&index_of((new, free)));
        let mut translational_stiffness = [None; 2];
        translational_stiffness[free] = Some(0.0);
        self.hinges.push(Hinge {
            ends: [node, new],
            rotational_stiffness: None,
            hysteresis: None,
            translational_stiffness,
            dashpots: [0.0; 3],
            proportional_damping: ProportionalDamping::None,
        });
        new
    }

    /// Where a beam meets the rigid cross-section of a wall, so far to the right of its axis: v_e = v + a θ. The joint itself at a column.
    pub(super) fn face(&mut self, joint: usize, arm: f64) -> usize {
        if arm == 0.0 {
            return joint;
        }
        let face = self.add_following(joint, Y);
        self.nodes[face].x += arm;
        let risen = over_nodes([((joint, Y), 1.0), ((joint, THETA), arm)]);
        self.ties.insert(index_of((face, Y)), risen);
        // It belongs to the column line of the axis.
        self.turns.insert(face, self.turn(joint));
        face
    }

    /// Where a column begins to bend, so far above the joint whose rotation moves it sideways: u_e = u − a θ. The joint itself without a
    /// rigid end.
    pub(super) fn end_of_column(&mut self, joint: usize, rise: f64) -> usize {
        if rise == 0.0 {
            return joint;
        }
        let end = self.add_following(joint, X);
        self.nodes[end].y += rise;
        let moved = over_nodes([((joint, X), 1.0), ((joint, THETA), -rise)]);
        self.ties.insert(index_of((end, X)), moved);
        // It stands on the floor of the joint.
        self.turns.insert(end, self.turn(joint));
        end
    }

    /// Lets the axis of a wall, or a joint, carry the mass at the end of a member beside it, and that of the member between both \[kg\].
    pub(super) fn carry_on_axis(&mut self, joint: usize, end: usize, between: f64) {
        let node = &mut self.nodes[end];
        let mass = node.mass;
        node.add_mass(-mass);
        self.nodes[joint].add_mass(mass + between);
    }

    /// Lets a beam slide at its middle, where its masses are the same on both sides. Returns its halves: their ends, and where they are
    /// cut, as fractions of their lengths.
    pub(super) fn slide_at_middle(
        &mut self,
        ends: [usize; 2],
        cuts: &[f64],
        hysteresis: Hysteresis,
    ) -> Vec<([usize; 2], Vec<f64>)> {
        let [a, b] = ends.map(|end| self.nodes[end]);
        let middle = self.add_node(0.5 * (a.x + b.x), 0.5 * (a.y + b.y));
        let beyond = self.add_sliding(middle, Y, hysteresis);
        // An even number of segments has a cut there already.
        let doubled: Vec<f64> = cuts.iter().map(|cut| 2.0 * cut).collect();
        let before = doubled.iter().copied().filter(|cut| *cut < 1.0 - AT_MIDDLE);
        let after = doubled.iter().map(|cut| cut - 1.0);
        let after = after.filter(|cut| *cut > AT_MIDDLE);
        vec![
            ([ends[0], middle], before.collect()),
            ([beyond, ends[1]], after.collect()),
        ]
    }

    /// Lets a member slide across its axis against a joint by a spring, which is all of its shear deformation; returns the node at the
    /// member. The spring has the sign of the shear of members: positive where a column slides to the right, and a beam down.
    pub(super) fn add_sliding(
        &mut self,
        joint: usize,
        component: usize,
        hysteresis: Hysteresis,
    ) -> usize {
        let end = self.add_following(joint, component);
        if component == X {
            self.slides.insert(end);
        }
        let sign = if component == X { 1.0 } else { -1.0 };
        self.yielding.push(YieldingElement {
            row: over_nodes([((end, component), sign), ((joint, component), -sign)]),
            hysteresis,
            proportional_damping: ProportionalDamping::None,
        });
        end
    }
}

impl Discretization {
    /// Index of the spring at a place of a frame, if something yields there.
    pub(crate) fn spring_at(&self, frame: Option<usize>, place: SpringPlace) -> Option<usize> {
        let wanted = match frame {
            Some(frame) => place.in_frame(frame + 1)?,
            None => place,
        };
        let mut places = self.spring_places.iter();
        places.position(|place| *place == wanted)
    }

    /// Stiffness 12 EI/l³ of the bending of a coupling beam beside its shear, if that is what yields at a place \[N/m\].
    pub(crate) fn bending_behind(&self, place: SpringPlace) -> Option<f64> {
        let SpringPlace::Sliding {
            frame,
            member: member @ MemberPlace::Beam { .. },
        } = place
        else {
            return None;
        };
        let member = self.member_at(frame.map(|number| number - 1), member)?;
        let beams = &self.stick_model.members[member.elements.clone()];
        let (first, last) = (beams.first()?, beams.last()?);
        let nodes = &self.stick_model.nodes;
        let length = nodes[last.ends[1]].x - nodes[first.ends[0]].x;
        Some(12.0 * first.flexural_rigidity / (length * length * length))
    }

    /// Elements of a member of a frame.
    pub(crate) fn member_at(
        &self,
        frame: Option<usize>,
        place: MemberPlace,
    ) -> Option<&super::FrameMember> {
        let mut members = self.members.iter();
        members.find(|member| member.frame == frame && member.place == place)
    }
}
