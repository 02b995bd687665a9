//! The massless elements of a stick model: members, hinges, springs and the soil.

use super::element::{
    Element, ElementStiffness, Part, Place, THETA, X, Y, index_of, over_nodes, places,
};
use super::stick_model::{
    Hinge, Influence, Member, Node, RigidFoundation, Spring, StickModel, YieldingElement,
};
use crate::linear::Row;
use crate::model::ProportionalDamping;

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
        .chain(stick_model.elements.iter().map(ElementStiffness::from))
        .chain(
            stick_model
                .space_elements
                .iter()
                .map(ElementStiffness::from),
        )
        .chain(stick_model.yielding.iter().map(of_yielding))
        .chain(foundation.map(of_soil))
}

impl StickModel {
    /// A displacement as a row over those of nodes to which it is tied; over itself if it is free.
    pub(crate) fn carried(&self, place: Place) -> Row {
        let index = index_of(place);
        let tied = self.ties.get(&index).cloned();
        tied.unwrap_or_else(|| Row::single(index))
    }

    /// A row over displacements of nodes with those that are tied replaced by those that carry them.
    pub(crate) fn carried_row(&self, row: &Row) -> Row {
        if self.ties.is_empty() {
            return row.clone();
        }
        let terms = places(row).flat_map(|(place, share)| {
            let carried = self.carried(place).times(share);
            carried.entries().to_vec()
        });
        terms.collect()
    }

    /// Springs that yield by themselves, in the order of [`Equations::springs`](super::Equations::springs): hinges, storeys, then
    /// those between any points.
    pub(crate) fn single_springs(&self) -> impl Iterator<Item = YieldingElement> + '_ {
        let foundation = self.foundation.as_ref();
        let hinges = self.hinges.iter().filter_map(|hinge| {
            Some(YieldingElement {
                row: hinge.rotation(),
                hysteresis: hinge.hysteresis?,
                proportional_damping: hinge.proportional_damping,
            })
        });
        let storeys = self.springs.iter().filter_map(move |spring| {
            Some(YieldingElement {
                row: spring.deformation(foundation),
                hysteresis: spring.hysteresis?,
                proportional_damping: spring.proportional_damping,
            })
        });
        hinges.chain(storeys).chain(self.yielding.iter().cloned())
    }

    /// Number of rows of bearings and of the ring under a building in plan, which come after springs that yield by themselves.
    pub(crate) fn rows_of_bearings(&self) -> usize {
        let forces = self.plan_mat.iter().flat_map(|mat| mat.forces());
        3 * forces.count()
    }

    /// Rows of sections that yield on a surface, which come last.
    pub(crate) fn surface_rows(&self) -> impl DoubleEndedIterator<Item = &YieldingElement> {
        self.surfaces.iter()
    }

    /// How far to the right of the node of its foundation a node stands that rises and sinks with its rotation: a foot, or what
    /// stands on one on columns that keep their length \[m\].
    #[must_use]
    pub fn lever(&self, node: usize) -> Option<f64> {
        let foundation = self.foundation.as_ref()?;
        let tied = self.ties.get(&index_of((node, Y)))?;
        // Faces of walls follow their axes as well.
        let turned = index_of((foundation.node, THETA));
        let mut turned = tied.entries().iter().filter(|(index, _)| *index == turned);
        turned.next().map(|(_, lever)| *lever)
    }

    /// Whether any of it moves across the row.
    #[must_use]
    pub fn moves_across(&self) -> bool {
        let mut all = self.nodes.iter().flat_map(|node| node.influence);
        all.any(|influence| influence.across != 0.0)
    }

    /// What a displacement of a node moves.
    pub(crate) fn influence(&self, (node, component): Place) -> Influence {
        self.nodes[node].influence[component]
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
        let turned = turned.map(|(foundation, lever)| ((foundation.node, THETA), lever));
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
        &[12.0][..],
        &[6.0 * l, (4.0 + phi) * l * l],
        &[-12.0, -6.0 * l, 12.0],
        &[6.0 * l, (2.0 - phi) * l * l, -6.0 * l, (4.0 + phi) * l * l],
    ];
    let moved = [(i, transverse), (i, THETA), (j, transverse), (j, THETA)].into_iter();
    let rows = moved.zip([sign, 1.0, sign, 1.0]);
    let lower = bending.concat().into_iter().map(|value| scale * value);
    let beam = Element::Matrix {
        part: Part::Elastic,
        rows: rows.map(|moved| over_nodes([moved])).collect(),
        lower: lower.collect(),
    };
    let ends = |component: usize| [(i, component), (j, component)];
    let leaning = Element::between(ends(transverse), Part::Undamped, -member.compression / l);
    let stretched = member
        .axial_rigidity
        .map(|ea| Element::between(ends(axial), Part::Elastic, ea / l));
    [beam, leaning].into_iter().chain(stretched).collect()
}

/// Planar hinge (theory, Eq. K2).
pub(crate) fn of_hinge(hinge: &Hinge) -> ElementStiffness {
    let [horizontal, vertical] = hinge.translational_stiffness;
    let turning = hinge.rotational_stiffness;
    let directions = [(X, horizontal), (Y, vertical), (THETA, turning)];
    let of_direction = |(component, value): (usize, Option<f64>)| {
        let ends = hinge.ends.map(|node| (node, component));
        let yields = hinge.hysteresis.is_some() && component == THETA;
        let springs = parts_of(value.unwrap_or(0.0), yields, hinge.proportional_damping);
        let all = springs.chain([(Part::Dashpot, hinge.dashpots[component])]);
        all.map(move |(part, value)| Element::between(ends, part, value))
    };
    directions.into_iter().flat_map(of_direction).collect()
}

/// Storey spring (theory, Eqs. K3 and B22).
pub(crate) fn of_spring(spring: &Spring, foundation: Option<&RigidFoundation>) -> ElementStiffness {
    let ends = spring.ends.map(|node| (node, X));
    let (yields, damping) = (spring.hysteresis.is_some(), spring.proportional_damping);
    let foundation = foundation.filter(|_| spring.lever.is_some());
    let deformed = parts_of(spring.stiffness, yields, damping).map(|(part, stiffness)| {
        if foundation.is_some() {
            let row = spring.deformation(foundation);
            Element::Spring {
                part,
                stiffness,
                row,
            }
        } else {
            Element::between(ends, part, stiffness)
        }
    });
    let moved = [
        (Part::Undamped, -spring.softening),
        (Part::Dashpot, spring.dashpot),
    ];
    let moved = moved.map(|(part, value)| Element::between(ends, part, value));
    deformed.chain(moved).collect()
}

/// Springs and dashpots of the soil under a foundation.
fn of_soil(foundation: &RigidFoundation) -> ElementStiffness {
    let rows = [X, THETA].map(|component| over_nodes([((foundation.node, component), 1.0)]));
    let parts = [
        (Part::Undamped, foundation.stiffness),
        (Part::Dashpot, foundation.damping),
    ];
    let elements = parts.map(|(part, [uu, ut, tt])| Element::Matrix {
        part,
        rows: rows.to_vec(),
        lower: vec![uu, ut, tt],
    });
    ElementStiffness {
        is_soil: true,
        ..elements.into_iter().collect()
    }
}

/// What yields between any points, as far as it is linear.
fn of_yielding(spring: &YieldingElement) -> ElementStiffness {
    let initial = spring.hysteresis.backbone().initial();
    let parts = parts_of(initial, true, spring.proportional_damping);
    let elements = parts.map(|(part, stiffness)| Element::Spring {
        part,
        stiffness,
        row: spring.row.clone(),
    });
    elements.collect()
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
