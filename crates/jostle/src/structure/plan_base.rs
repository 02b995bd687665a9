//! Springs and dashpots under the base of a building in plan.

use super::discretization::Discretization;
use super::element::{Element, Part, X, Y, over_nodes, places};
use super::order::Turn;
use super::plan_matrix::PlanMatrix;
use super::stick_model::{Influence, Node, PlanBase, StickModel, Support};
use crate::linear::Row;
use crate::model::{Base, LumpedFloor, PlanArea, TierStorey};

impl Discretization {
    /// Puts a building on its base: the node of the footing sways and turns against the ground, and the building rocks about it. Springs
    /// act at the centroid of the plan of the lowest floor.
    ///
    /// A floor at a height h moves by u = u_f + w + h φ: sway of the footing, deformation of the building, and rocking.
    pub(super) fn put_on_springs(
        &mut self,
        base: &Base,
        footing: &LumpedFloor,
        [ground, node]: [usize; 2],
    ) {
        let directions = base.in_plan();
        let sticks = &mut self.stick_model;
        let mut own = PlanBase {
            footing: node,
            centre: footing.tier.centre,
            rocking: None,
        };
        let area = PlanArea::new(&footing.tier.plan);
        let rocking = directions.map(|own| own.rotational_stiffness);
        if let [Some(of_along), Some(of_across)] = rocking {
            let [across, along] = area.second_moments.map(|moment| moment / area.area);
            let inertia = [along, across].map(|squared| base.mass * squared);
            let rocking = sticks.add_rocking(inertia);
            own.rocking = Some(rocking);
            let springs = [
                (Part::Undamped, [of_along, of_across]),
                (Part::Dashpot, directions.map(|own| own.rotational_damping)),
            ];
            for (part, values) in springs {
                let ends = [X, Y].map(|component| [(rocking, component), (ground, component)]);
                let springs = ends
                    .into_iter()
                    .zip(values)
                    .filter(|(_, value)| *value != 0.0);
                let springs = springs.map(|(ends, value)| Element::between(ends, part, value));
                sticks.elements.extend(springs);
            }
        }
        sticks.plan_base = Some(own);
        let sways = directions.map(|own| own.horizontal_stiffness);
        sticks.nodes[node].support = match (sways, base.torsional_stiffness) {
            ([None, None], None) => Support::Fixed,
            ([None, None], Some(_)) => Support::Turning,
            (_, None) => Support::Swaying,
            (_, Some(_)) => Support::Free,
        };
        let [along, across] = directions;
        let torsion = base.torsional_stiffness.unwrap_or(0.0);
        let stiffness = [sways[0].unwrap_or(0.0), sways[1].unwrap_or(0.0), torsion];
        let damping = [
            along.horizontal_damping,
            across.horizontal_damping,
            base.torsional_damping,
        ];
        let mut matrix = PlanMatrix::new(3);
        // Stiffness-proportional damping of the building does not act on them.
        for (stiffness, part) in [(stiffness, Part::Undamped), (damping, Part::Dashpot)] {
            let springs = TierStorey {
                stiffness,
                centre: area.centroid,
            };
            matrix.add_storey(std::slice::from_ref(footing), 0, &springs, part);
        }
        sticks.elements.extend(matrix.elements(ground, &[node]));
        self.foot = Some(node);
    }
}

impl StickModel {
    /// Adds the rocking of the base, as displacements of floors per height along x and across, and subtracts it from all that
    /// deforms above. P-Delta acts on displacements as they are.
    fn add_rocking(&mut self, [along, across]: [f64; 2]) -> usize {
        let node = self.nodes.len();
        self.nodes.push(Node {
            inertia: [along, across, 0.0],
            influence: [Influence::NONE; 3],
            ..Node::at(0.0, 0.0).held(Support::Swaying)
        });
        // After the roof, because it deforms every storey.
        let top = self.nodes.iter().map(|own| own.y).fold(0.0, f64::max);
        let last = Turn {
            position: f64::INFINITY,
            ..Turn::of_floor(top, top)
        };
        self.turns.insert(node, last);
        let nodes = &self.nodes;
        let deformed = |row: &Row| -> Row {
            let rocked = |influence: fn(&Influence) -> f64| -> f64 {
                let shares = places(row).map(|((at, component), share)| {
                    share * nodes[at].y * influence(&nodes[at].influence[component])
                });
                -shares.sum::<f64>()
            };
            let rocked = [
                ((node, X), rocked(|own| own.along)),
                ((node, Y), rocked(|own| own.across)),
            ];
            let rocked = over_nodes(rocked.into_iter().filter(|(_, share)| *share != 0.0));
            row.entries()
                .iter()
                .chain(rocked.entries())
                .copied()
                .collect()
        };
        for element in &mut self.elements {
            match element {
                Element::Spring {
                    part: Part::Undamped,
                    ..
                } => {}
                Element::Spring { row, .. } => *row = deformed(row),
                Element::Matrix { rows, .. } => {
                    for row in rows {
                        *row = deformed(row);
                    }
                }
            }
        }
        for spring in &mut self.yielding {
            spring.row = deformed(&spring.row);
        }
        node
    }
}
