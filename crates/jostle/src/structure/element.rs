//! Stiffness of the massless elements between lumped masses, in global axes.

use crate::linear::{Row, StepMatrix};
use crate::model::ProportionalDamping;
use crate::structure::{Hinge, Member, Node, RigidFoundation, Spring, StickModel, StickPlanSpring};

/// Displacement of a node: horizontal, vertical, rotation.
pub(crate) const X: usize = 0;
pub(crate) const Y: usize = 1;
pub(crate) const THETA: usize = 2;

/// Node, and displacement component there.
pub(crate) type Place = (usize, usize);

/// Index of a displacement in rows over the displacements of nodes.
pub(crate) fn index_of((node, component): Place) -> usize {
    3 * node + component
}

/// Displacement of an index in these rows.
pub(crate) fn place_of(index: usize) -> Place {
    (index / 3, index % 3)
}

/// Displacements of nodes with their shares, as a row over these displacements.
pub(crate) fn over_nodes(entries: impl IntoIterator<Item = (Place, f64)>) -> Row {
    let entries = entries.into_iter();
    entries
        .map(|(place, share)| (index_of(place), share))
        .collect()
}

/// Displacements of nodes in such a row, with their shares.
pub(crate) fn places(row: &Row) -> impl Iterator<Item = (Place, f64)> + Clone {
    row.entries()
        .iter()
        .map(|(index, share)| (place_of(*index), *share))
}

/// The matrix of a building that an entry belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// K: stiffness that takes part in stiffness-proportional damping.
    Elastic,
    /// K′: stiffness that does not: P-Delta, and the springs of a base.
    Undamped,
    /// C′: separate dashpots.
    Dashpot,
}

impl Part {
    /// Weight of this part in a step matrix.
    pub(crate) fn weight(self, matrix: &StepMatrix) -> f64 {
        match self {
            Self::Elastic => matrix.stiffness,
            Self::Undamped => 1.0,
            Self::Dashpot => matrix.dashpots,
        }
    }
}

/// A massless element over displacements of nodes, 3 × node + (0 horizontal, 1 vertical, 2 rotation). Its stiffness may be
/// negative.
#[derive(Clone, Debug, PartialEq)]
pub enum Element {
    /// A spring or a dashpot between any points, in any direction.
    Spring {
        /// The matrix to which it belongs.
        part: Part,
        /// Force per deformation \[N/m, N·m/rad; times s for dashpots\].
        stiffness: f64,
        /// Its deformation.
        row: Row,
    },
    /// Bending between two ends, part of K.
    Bend {
        /// Moment per deformation: of each end by itself, and of each by the other \[N·m/rad\].
        stiffness: [f64; 2],
        /// How far either end is bent.
        rows: [Row; 2],
    },
}

impl Element {
    /// A spring or a dashpot that the difference of two displacements stretches.
    pub(crate) fn between([a, b]: [Place; 2], part: Part, stiffness: f64) -> Self {
        Self::Spring {
            part,
            stiffness,
            row: over_nodes([(a, 1.0), (b, -1.0)]),
        }
    }

    /// Its deformations.
    #[must_use]
    pub fn deformations(&self) -> &[Row] {
        match self {
            Self::Spring { row, .. } => std::slice::from_ref(row),
            Self::Bend { rows, .. } => rows,
        }
    }

    /// Force per deformation: of each by itself, and of each by the other.
    pub(crate) fn stiffness(&self) -> [f64; 2] {
        match self {
            Self::Spring { stiffness, .. } => [*stiffness, 0.0],
            Self::Bend { stiffness, .. } => *stiffness,
        }
    }
}

/// Symmetric matrix of an element between displacements of its ends.
#[derive(Clone, Debug, Default)]
pub(crate) struct ElementStiffness {
    /// Part, (node, component), (node, component), value \[N/m, N, N·m; times s for dashpots\]; both triangles.
    pub(crate) entries: Vec<(Part, Place, Place, f64)>,
    /// Whether it is the soil under a foundation.
    pub(crate) is_soil: bool,
}

/// Stiffness and dashpots of every element of a stick model, over displacements that are not tied to others.
pub(crate) fn stiffnesses(stick_model: &StickModel) -> impl Iterator<Item = ElementStiffness> + '_ {
    untied(stick_model).map(move |mut element| {
        if !stick_model.ties.is_empty() {
            element.tie(stick_model);
        }
        element
    })
}

/// The same over all displacements of nodes.
pub(crate) fn untied(stick_model: &StickModel) -> impl Iterator<Item = ElementStiffness> + '_ {
    let foundation = stick_model.foundation.as_ref();
    let members = stick_model
        .members
        .iter()
        .map(|member| of_member(member, &stick_model.nodes));
    members
        .chain(stick_model.hinges.iter().map(of_hinge))
        .chain(
            stick_model
                .springs
                .iter()
                .map(move |spring| of_spring(spring, foundation)),
        )
        .chain(stick_model.elements.iter().map(of_element))
        .chain(stick_model.space_elements.iter().map(of_element))
        .chain(stick_model.plan_springs.iter().map(of_plan_spring))
        .chain(foundation.map(of_soil))
}

impl StickModel {
    /// A displacement as a row over those of nodes to which it is tied; over itself if it is free.
    pub(crate) fn carried(&self, place: Place) -> Row {
        let index = index_of(place);
        let tied = self.ties.get(&index).cloned();
        tied.unwrap_or_else(|| Row::single(index))
    }

    /// How far to the right of the node of its foundation a node stands that rises and sinks with its rotation: a foot, or what
    /// stands on one on columns that keep their length \[m\].
    #[must_use]
    pub fn lever(&self, node: usize) -> Option<f64> {
        let tied = self.ties.get(&index_of((node, Y)))?;
        tied.entries().first().map(|(_, lever)| *lever)
    }

    /// What a force at a displacement adds to the horizontal forces along x and across, and to the torque about the centre of the
    /// floor at its height, or of the next one above; none for what is vertical or in one plane.
    pub(crate) fn horizontal_shares(&self, (node, component): Place) -> [f64; 3] {
        match self.frame_nodes.get(node) {
            Some(Some(own)) if component == X => own.shares,
            Some(Some(_)) => [0.0; 3],
            _ => {
                let mut shares = [0.0; 3];
                shares[component] = 1.0;
                shares
            }
        }
    }
}

impl Hinge {
    /// How far its first end is turned against the second, over displacements of nodes.
    pub(crate) fn rotation(&self) -> Row {
        let [first, second] = self.ends;
        over_nodes([((first, THETA), 1.0), ((second, THETA), -1.0)])
    }
}

impl Spring {
    /// Its deformation over displacements of nodes, which is positive where the upper floor of a storey is to the right of the lower
    /// one.
    pub(crate) fn deformation(&self, foundation: Option<&RigidFoundation>) -> Row {
        let [lower, upper] = self.ends;
        let turned = foundation.zip(self.lever);
        let turned = turned.map(|(own, lever)| ((own.node, THETA), lever));
        over_nodes(
            [((upper, X), 1.0), ((lower, X), -1.0)]
                .into_iter()
                .chain(turned),
        )
    }
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
            stiffness.entries.push((
                Part::Elastic,
                places[p],
                places[q],
                scale * value * signs[p] * signs[q],
            ));
        }
    }
    stiffness.couple(
        Part::Undamped,
        (i, transverse),
        (j, transverse),
        -member.compression / l,
    );
    if let Some(ea) = member.axial_rigidity {
        stiffness.couple(Part::Elastic, (i, axial), (j, axial), ea / l);
    }
    stiffness
}

/// Planar hinge (theory, Eq. K2).
pub(crate) fn of_hinge(hinge: &Hinge) -> ElementStiffness {
    let [i, j] = hinge.ends;
    let mut stiffness = ElementStiffness::default();
    let [horizontal, vertical] = hinge.translational_stiffness;
    let turning = hinge.rotational_stiffness;
    let directions = [(X, horizontal), (Y, vertical), (THETA, turning)];
    for (component, value) in directions {
        let (a, b) = ((i, component), (j, component));
        let value = value.unwrap_or(0.0);
        let yields = hinge.hysteresis.is_some() && component == THETA;
        for (part, value) in parts_of(value, yields, hinge.proportional_damping) {
            stiffness.couple(part, a, b, value);
        }
        stiffness.couple(Part::Dashpot, a, b, hinge.dashpots[component]);
    }
    stiffness
}

/// Storey spring (theory, Eqs. K3 and B22).
pub(crate) fn of_spring(spring: &Spring, foundation: Option<&RigidFoundation>) -> ElementStiffness {
    let [i, j] = spring.ends;
    let mut stiffness = ElementStiffness::default();
    let (yields, damping) = (spring.hysteresis.is_some(), spring.proportional_damping);
    for (part, value) in parts_of(spring.stiffness, yields, damping) {
        match (spring.lever, foundation) {
            (Some(_), Some(foundation)) => {
                stiffness.combine(part, &spring.deformation(Some(foundation)), value);
            }
            _ => stiffness.couple(part, (i, X), (j, X), value),
        }
    }
    stiffness.couple(Part::Undamped, (i, X), (j, X), -spring.softening);
    stiffness.couple(Part::Dashpot, (i, X), (j, X), spring.dashpot);
    stiffness
}

/// Springs and dashpots of the soil under a foundation.
fn of_soil(foundation: &RigidFoundation) -> ElementStiffness {
    let mut stiffness = ElementStiffness {
        is_soil: true,
        ..ElementStiffness::default()
    };
    let (u, turn) = ((foundation.node, X), (foundation.node, THETA));
    for (part, [uu, ut, tt]) in [
        (Part::Undamped, foundation.stiffness),
        (Part::Dashpot, foundation.damping),
    ] {
        let entries = [(u, u, uu), (u, turn, ut), (turn, u, ut), (turn, turn, tt)];
        let entries = entries.into_iter().filter(|(_, _, value)| *value != 0.0);
        stiffness
            .entries
            .extend(entries.map(|(a, b, value)| (part, a, b, value)));
    }
    stiffness
}

/// Of two deformations k₁₁ d₁d₁ᵀ + k₁₁ d₂d₂ᵀ + k₁₂ (d₁d₂ᵀ + d₂d₁ᵀ).
fn of_element(element: &Element) -> ElementStiffness {
    let mut stiffness = ElementStiffness::default();
    match element {
        Element::Spring {
            part,
            stiffness: value,
            row,
        } => match *row.entries() {
            [(a, 1.0), (b, -1.0)] => stiffness.couple(*part, place_of(a), place_of(b), *value),
            _ => stiffness.combine(*part, row, *value),
        },
        Element::Bend {
            stiffness: [own, other],
            rows: [first, second],
        } => {
            for (row, across) in [(first, second), (second, first)] {
                stiffness.combine(Part::Elastic, row, *own);
                for (a, of_a) in places(row) {
                    for (b, of_b) in places(across) {
                        let value = other * of_a * of_b;
                        stiffness.entries.push((Part::Elastic, a, b, value));
                    }
                }
            }
        }
    }
    stiffness
}

/// What yields between two floors in plan, as far as it is linear.
fn of_plan_spring(spring: &StickPlanSpring) -> ElementStiffness {
    let initial = spring.hysteresis.backbone().initial();
    let mut stiffness = ElementStiffness::default();
    for (part, value) in parts_of(initial, true, spring.proportional_damping) {
        stiffness.combine(part, &spring.row, value);
    }
    stiffness
}

/// The matrix for the stiffness of an elastic hinge or spring.
pub(crate) fn part_of(proportional_damping: ProportionalDamping) -> Part {
    match proportional_damping {
        ProportionalDamping::Initial | ProportionalDamping::Tangent => Part::Elastic,
        ProportionalDamping::None => Part::Undamped,
    }
}

/// The matrices for a stiffness. What yields has its tangent among the springs, see `Equations::springs`; the damping of its initial
/// stiffness stays, that stiffness itself cancels.
fn parts_of(
    stiffness: f64,
    yields: bool,
    damping: ProportionalDamping,
) -> impl Iterator<Item = (Part, f64)> {
    let parts = match (yields, damping) {
        (false, _) => [Some((part_of(damping), stiffness)), None],
        (true, ProportionalDamping::Initial) => [
            Some((Part::Elastic, stiffness)),
            Some((Part::Undamped, -stiffness)),
        ],
        (true, _) => [None, None],
    };
    parts.into_iter().flatten()
}

impl ElementStiffness {
    /// Replaces displacements by those to which they are tied.
    fn tie(&mut self, stick_model: &StickModel) {
        let entries = std::mem::take(&mut self.entries);
        for (part, a, b, value) in entries {
            for (a, of_a) in places(&stick_model.carried(a)) {
                for (b, of_b) in places(&stick_model.carried(b)) {
                    let value = value * of_a * of_b;
                    if value != 0.0 {
                        self.entries.push((part, a, b, value));
                    }
                }
            }
        }
    }

    /// A spring whose deformation is a row over displacements of nodes.
    pub(crate) fn combine(&mut self, part: Part, row: &Row, value: f64) {
        for (a, of_a) in places(row) {
            for (b, of_b) in places(row) {
                self.entries.push((part, a, b, value * of_a * of_b));
            }
        }
    }

    /// A spring between two displacements.
    fn couple(&mut self, part: Part, a: Place, b: Place, value: f64) {
        if value != 0.0 {
            self.entries.extend([
                (part, a, a, value),
                (part, b, b, value),
                (part, a, b, -value),
                (part, b, a, -value),
            ]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A brace at an angle between two points that move both ways: k c cᵀ with the direction c (theory of trusses).
    #[test]
    fn a_brace_at_any_angle_is_an_element() {
        let (stiffness, c, s) = (5e6, 0.8, 0.6);
        let brace = Element::Spring {
            part: Part::Elastic,
            stiffness,
            row: over_nodes([((1, X), c), ((1, Y), s), ((0, X), -c), ((0, Y), -s)]),
        };
        let moved = [[0.0, 0.0], [3e-3, -1e-3]];
        let at = |(node, component): Place| moved[node][component];
        let mut forces = [[0.0; 2]; 2];
        for (part, a, b, value) in of_element(&brace).entries {
            assert_eq!(part, Part::Elastic);
            forces[a.0][a.1] += value * at(b);
        }
        let tension = stiffness * (c * 3e-3 - s * 1e-3);
        for (force, expected) in forces[1].into_iter().zip([c * tension, s * tension]) {
            assert!(
                (force - expected).abs() < 1e-9 * tension,
                "{force} {expected}"
            );
        }
        assert_eq!(forces[0], forces[1].map(|force| -force));
    }

    /// A spring between the ends of two arms of rigid bodies is stretched by their turns as well.
    #[test]
    fn a_spring_between_any_two_points_is_an_element() {
        let row = over_nodes([
            ((1, X), 1.0),
            ((1, THETA), -2.0),
            ((0, X), -1.0),
            ((0, THETA), 0.5),
        ]);
        let dashpot = Element::Spring {
            part: Part::Dashpot,
            stiffness: 4.0,
            row,
        };
        let turned: f64 = of_element(&dashpot)
            .entries
            .iter()
            .filter(|(_, a, b, _)| (*a, *b) == ((1, THETA), (0, THETA)))
            .map(|(.., value)| value)
            .sum();
        assert_eq!(turned, 4.0 * -2.0 * 0.5);
    }
}
