//! Stiffness of the massless elements between lumped masses, in global axes.

use crate::skeleton::{Hinge, Member, Node, Skeleton, Spring};

/// Displacement of a node: horizontal, vertical, rotation.
pub(crate) const X: usize = 0;
pub(crate) const Y: usize = 1;
pub(crate) const THETA: usize = 2;

/// Which end, and which displacement there.
pub(crate) type Place = (usize, usize);

/// Symmetric stiffness of an element between displacements of its ends.
#[derive(Clone, Debug, Default)]
pub(crate) struct ElementStiffness {
    /// Entries (node, component), (node, component), value \[N/m, N, N·m\]; both triangles.
    pub(crate) entries: Vec<(Place, Place, f64)>,
}

/// Stiffness of every element of a skeleton.
pub(crate) fn stiffnesses(skeleton: &Skeleton) -> impl Iterator<Item = ElementStiffness> + '_ {
    let members = skeleton
        .members
        .iter()
        .map(|member| of_member(member, &skeleton.nodes));
    members
        .chain(skeleton.hinges.iter().map(hinge_stiffness))
        .chain(skeleton.springs.iter().map(spring_stiffness))
}

impl Member {
    /// Whether both ends lie on one vertical.
    pub(crate) fn is_vertical(&self, nodes: &[Node]) -> bool {
        let [a, b] = self.ends.map(|end| nodes[end]);
        (b.y - a.y).abs() > (b.x - a.x).abs()
    }
}

/// Bernoulli or Timoshenko beam, axially rigid or not, with chord P-Delta (theory, Eq. K1).
pub(crate) fn of_member(member: &Member, nodes: &[Node]) -> ElementStiffness {
    let vertical = member.is_vertical(nodes);
    let [a, b] = member.ends;
    // From the left or the lower end.
    let along = |node: usize| {
        if vertical {
            nodes[node].y
        } else {
            nodes[node].x
        }
    };
    let (i, j) = if along(a) <= along(b) { (a, b) } else { (b, a) };
    let l = along(j) - along(i);
    let (ei, phi) = (
        member.flexural_rigidity,
        member.shear_rigidity.map_or(0.0, |shear| {
            12.0 * member.flexural_rigidity / (shear * l * l)
        }),
    );
    // Transverse displacement is 90° counter-clockwise from the axis: +y of a beam, −x of a column.
    let (transverse, axial, sign) = if vertical { (X, Y, -1.0) } else { (Y, X, 1.0) };
    let scale = ei / (l * l * l * (1.0 + phi));
    let bending = [
        [12.0, 6.0 * l, -12.0, 6.0 * l],
        [6.0 * l, (4.0 + phi) * l * l, -6.0 * l, (2.0 - phi) * l * l],
        [-12.0, -6.0 * l, 12.0, -6.0 * l],
        [6.0 * l, (2.0 - phi) * l * l, -6.0 * l, (4.0 + phi) * l * l],
    ];
    let places = [(i, transverse), (i, THETA), (j, transverse), (j, THETA)];
    let signs = [sign, 1.0, sign, 1.0];
    let mut stiffness = ElementStiffness::default();
    for (p, row) in bending.iter().enumerate() {
        for (q, value) in row.iter().enumerate() {
            stiffness
                .entries
                .push((places[p], places[q], scale * value * signs[p] * signs[q]));
        }
    }
    stiffness.couple((i, transverse), (j, transverse), -member.compression / l);
    if let Some(ea) = member.axial_rigidity {
        stiffness.couple((i, axial), (j, axial), ea / l);
    }
    stiffness
}

/// Planar hinge (theory, Eq. K2).
fn hinge_stiffness(hinge: &Hinge) -> ElementStiffness {
    let [i, j] = hinge.ends;
    let mut stiffness = ElementStiffness::default();
    stiffness.couple((i, THETA), (j, THETA), hinge.rotational_stiffness);
    for (component, value) in [X, Y].into_iter().zip(hinge.translational_stiffness) {
        if let Some(value) = value {
            stiffness.couple((i, component), (j, component), value);
        }
    }
    stiffness
}

/// Storey spring (theory, Eq. K3).
fn spring_stiffness(spring: &Spring) -> ElementStiffness {
    let [i, j] = spring.ends;
    let mut stiffness = ElementStiffness::default();
    stiffness.couple((i, X), (j, X), spring.stiffness);
    stiffness
}

impl ElementStiffness {
    /// A spring between two displacements.
    fn couple(&mut self, a: Place, b: Place, value: f64) {
        if value != 0.0 {
            self.entries
                .extend([(a, a, value), (b, b, value), (a, b, -value), (b, a, -value)]);
        }
    }
}
