//! The mat of an isolated building in plan, and its bearings.

use super::discretization::{Discretization, Mat};
use super::element::{Element, Part, Place, THETA, X, Y};
use super::plan_matrix::PlanMatrix;
use super::spring_place::SpringPlace;
use super::stick_model::{Influence, PlanMat, Support};
use crate::hysteresis::{CircularLaw, ForceRow, Hysteresis};
use crate::model::{
    Isolation, Isolator, LEVEL_TOLERANCE, LumpedFloor, PlanPoint, Tier, TierStorey, Tiers,
};

/// Adds bearings, dashpots and the stop between the nodes of the ground and of the mat of a building that stands on it.
///
/// Every bearing has an equal share of the weight, the stiffness, the strength and the dashpot.
pub(super) fn put_on_mat(
    tiers: &Tiers,
    isolation: &Isolation,
    mat: &LumpedFloor,
    [ground, node]: [usize; 2],
    discretization: &mut Discretization,
) {
    let sticks = &mut discretization.stick_model;
    let mass = sticks.nodes.iter().map(|node| node.mass).sum();
    let weight = isolation.weight_of(mass);
    let dashpot = isolation.dashpot(mass);
    let bearings = tiers.bearing_points();
    let share = 1.0 / bearings.len() as f64;
    let isolator = &isolation.isolator;
    let stiffness = isolator.stiffness(weight);
    let stages = isolator.stages(weight);
    let (elastic, slider) = match (stages, isolator.yielding(weight)) {
        (Some((stages, elastic)), _) => {
            let stages = stages.map(|stage| stage.of_share(share));
            let least = stages.iter().map(|stage| stage.friction);
            let least = least.fold(f64::INFINITY, f64::min);
            let law = CircularLaw::Pendulums(stages);
            let rows = Hysteresis::in_plan(law, share * elastic, least);
            (0.0, rows.ok())
        }
        (None, None) => (stiffness, None),
        (None, Some([strength, second, _])) => {
            let properties = [stiffness - second, strength].map(|value| share * value);
            let law = match *isolator {
                Isolator::Pendulum { friction, .. } if !friction.is_constant() => {
                    CircularLaw::Friction {
                        slow: share * friction.slow * weight,
                        rate: friction.rate,
                    }
                }
                Isolator::Linear { .. }
                | Isolator::LeadRubber { .. }
                | Isolator::HighDampingRubber { .. }
                | Isolator::Pendulum { .. }
                | Isolator::DoublePendulum { .. }
                | Isolator::TriplePendulum { .. } => CircularLaw::Slider,
            };
            let rows = Hysteresis::in_plan(law, properties[0], properties[1]);
            (second, rows.ok())
        }
    };
    let stop = isolation.stops[0];
    let ring = stop.and_then(|stop| {
        let rows = Hysteresis::in_plan(CircularLaw::Ring, stop.stiffness, stop.at);
        rows.ok()
    });
    let lumped = [mat.clone()];
    let mut matrix = PlanMatrix::new(3);
    // Stiffness-proportional damping does not act on bearings.
    for (value, part) in [(elastic, Part::Undamped), (dashpot, Part::Dashpot)] {
        let each: Vec<_> = bearings
            .iter()
            .map(|at| (*at, [share * value; 2]))
            .collect();
        if value != 0.0 {
            matrix.add_storey(&lumped, 0, &TierStorey::of_elements(&each), part);
        }
    }
    sticks.elements.extend(matrix.elements(ground, &[node]));
    let places = &mut discretization.spring_places;
    if slider.is_some() {
        let numbers = 1..=bearings.len();
        places.extend(numbers.flat_map(|bearing| {
            ForceRow::ALL.map(|row| SpringPlace::BearingInPlan { bearing, row })
        }));
    }
    if ring.is_some() {
        places.extend(ForceRow::ALL.map(|row| SpringPlace::Ring { row }));
    }
    sticks.plan_mat = Some(PlanMat {
        node,
        centre: mat.tier.centre,
        bearings,
        slider,
        ring,
    });
    discretization.foot = Some(node);
    discretization.mat = Some(Mat {
        node,
        isolation: *isolation,
        weight,
        stiffness: elastic,
        dashpot,
    });
}

impl Discretization {
    /// Mass-proportional damping of the motion relative to the mat in plan: Tᵀ α M T instead of α M, with T q the motion of everything
    /// less that of the mat as a rigid body (theory, Eq. B6).
    pub(super) fn damp_relative_to_mat_in_plan(&mut self, alpha: f64) {
        let Some(mat) = self.stick_model.plan_mat.clone() else {
            return;
        };
        let nodes = &self.stick_model.nodes;
        let Some(ground) = nodes.iter().position(|node| node.support == Support::Fixed) else {
            return;
        };
        let point = |node: usize, centre: PlanPoint| {
            LumpedFloor::rigid(&Tier {
                mass: nodes[node].mass,
                polar_mass: nodes[node].inertia[THETA],
                centre,
                plan: Vec::new(),
            })
        };
        let mut elements = Vec::new();
        let mat_floor = point(mat.node, mat.centre);
        let moved = |node: usize, centre: PlanPoint, factor: f64| TierStorey {
            stiffness: nodes[node].inertia.map(|inertia| factor * inertia),
            centre,
        };
        for (&floor, &centre) in self.floors.iter().zip(&self.centres) {
            let pair = [mat_floor.clone(), point(floor, centre)];
            let mut matrix = PlanMatrix::new(6);
            matrix.add_storey(&pair, 1, &moved(floor, centre, alpha), Part::Dashpot);
            elements.extend(matrix.elements(ground, &[mat.node, floor]));
            let mut alone = PlanMatrix::new(3);
            alone.add_storey(&pair[1..], 0, &moved(floor, centre, -alpha), Part::Dashpot);
            elements.extend(alone.elements(ground, &[floor]));
        }
        let mut alone = PlanMatrix::new(3);
        let of_mat = moved(mat.node, mat.centre, -alpha);
        alone.add_storey(&[mat_floor], 0, &of_mat, Part::Dashpot);
        elements.extend(alone.elements(ground, &[mat.node]));
        elements.extend(self.between_floors_relative_to_mat(&mat, ground, alpha));
        self.stick_model.elements.extend(elements);
    }

    /// The same of the masses of columns between floors: α m (u − s·q)² − α m u², s being how far motions q of the mat move their line.
    fn between_floors_relative_to_mat(
        &self,
        mat: &PlanMat,
        ground: usize,
        alpha: f64,
    ) -> Vec<Element> {
        let sticks = &self.stick_model;
        let of_mat = [X, Y, THETA].map(|component| (mat.node, component));
        let mut elements = Vec::new();
        let mut add = |ends: [Place; 2], dashpot: f64| {
            if dashpot != 0.0 {
                elements.push(Element::between(ends, Part::Dashpot, dashpot));
            }
        };
        let heights = self.floors.iter().map(|floor| sticks.nodes[*floor].y);
        let heights: Vec<f64> = heights.collect();
        for (node, stick_node) in sticks.nodes.iter().enumerate() {
            let level = heights
                .iter()
                .position(|top| stick_node.y <= top + LEVEL_TOLERANCE);
            let is_floor = stick_node.influence == Influence::OF_FLOOR;
            let Some(level) = level.filter(|_| !is_floor) else {
                continue;
            };
            for component in [X, Y] {
                // About the centre of the mat instead of that of the floor.
                let [along, across, turning] = stick_node.influence[component].horizontal();
                let value = alpha * stick_node.inertia[component];
                if value == 0.0 || [along, across, turning] == [0.0; 3] {
                    continue;
                }
                let [x, y] = [0, 1].map(|axis| self.centres[level][axis] - mat.centre[axis]);
                let shares = [along, across, turning + x * across - y * along];
                let sum: f64 = shares.iter().sum();
                // α m u² cancels. A dashpot between two displacements is minus the entry of the matrix, one to the ground the sum of a row.
                add([(ground, X), (node, component)], -value * sum);
                for (index, (place, share)) in of_mat.into_iter().zip(shares).enumerate() {
                    add([(node, component), place], value * share);
                    add([(ground, X), place], value * share * (sum - 1.0));
                    for (other, of_other) in of_mat.into_iter().zip(shares).skip(index + 1) {
                        add([place, other], -value * share * of_other);
                    }
                }
            }
        }
        elements
    }
}
