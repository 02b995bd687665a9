//! Rigid arms between joints and what they hold: faces of walls, and ends of columns and beams that are rigid inside their joints.

use jostle::structure::{Hinge, StickModel};

/// Stiffness of rigid arms, in units of the stiffest member that they hold \[–\]. Arms at both ends of a member lengthen periods by a
/// fraction of at most 3/4 of its inverse; rounding costs more the stiffer they are beside the softest part of the building.
const STIFF: f64 = 1e5;
pub(super) const REMARK: &str = "Rigid arms are 1e5 times as stiff as the stiffest member that they hold, which lengthens periods by 1e-5 of them at most; \
     stiffer ones would lose more by rounding.";

/// The displacement of the end of a rigid arm that a hinge leaves to the rotation of the joint, if it is one.
pub(super) fn arm(stick_model: &StickModel, hinge: &Hinge) -> Option<usize> {
    let free = |component: &usize| hinge.translational_stiffness[*component] == Some(0.0);
    let component = [0, 1].into_iter().find(free)?;
    let turns_with = hinge.rotational_stiffness.is_none();
    (turns_with && length(stick_model, hinge.ends) > 0.0).then_some(component)
}

/// Distance of two nodes along the frame or upwards \[m\].
pub(super) fn length(stick_model: &StickModel, ends: [usize; 2]) -> f64 {
    let [a, b] = ends.map(|end| stick_model.nodes[end]);
    (b.x - a.x).abs().max((b.y - a.y).abs())
}

/// Stiffness of members: the largest of each kind.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Stiffness {
    /// In bending, against displacements across it \[N/m\].
    pub(super) bending: f64,
    /// Against displacements \[N/m\].
    pub(super) moving: f64,
    /// Against rotations \[N·m/rad\].
    pub(super) turning: f64,
}

impl Stiffness {
    /// Of all members whose ends `counts` takes.
    pub(super) fn of(stick_model: &StickModel, counts: impl Fn([usize; 2]) -> bool) -> Self {
        let mut most = Self::default();
        for member in &stick_model.members {
            if !counts(member.ends) {
                continue;
            }
            let length = length(stick_model, member.ends);
            let turning = member.flexural_rigidity / length;
            let bending = 12.0 * turning / (length * length);
            let axial = member.axial_rigidity.map_or(0.0, |axial| axial / length);
            most.bending = most.bending.max(bending);
            most.moving = most.moving.max(axial).max(bending);
            most.turning = most.turning.max(4.0 * turning);
        }
        most
    }

    /// Of a rigid arm, by the members at its end and behind hinges there; by all members where none stands there.
    pub(super) fn of_arm(stick_model: &StickModel, arm: &Hinge) -> Self {
        let mut held = vec![arm.ends[1]];
        let mut next = 0;
        while let Some(node) = held.get(next).copied() {
            next += 1;
            for hinge in &stick_model.hinges {
                let [a, b] = hinge.ends;
                let other = if a == node { b } else { a };
                let here = (a == node || b == node) && length(stick_model, hinge.ends) == 0.0;
                if here && !held.contains(&other) {
                    held.push(other);
                }
            }
        }
        let most = Self::of(stick_model, |ends| {
            ends.iter().any(|end| held.contains(end))
        });
        let found = most.turning > 0.0;
        let most = if found {
            most
        } else {
            Self::of(stick_model, |_| true)
        };
        most.times(STIFF)
    }

    pub(super) fn times(self, factor: f64) -> Self {
        Self {
            bending: factor * self.bending,
            moving: factor * self.moving,
            turning: factor * self.turning,
        }
    }
}
