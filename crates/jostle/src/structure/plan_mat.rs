//! The mat of an isolated building in plan, and its bearings.

use super::discretization::{Discretization, Mat};
use super::plan_matrix::{Part, PlanMatrix};
use super::spring_place::SpringPlace;
use super::stick_model::{PlanMat, Support};
use crate::hysteresis::{CircularLaw, ForceRow, Hysteresis};
use crate::model::{Isolation, LumpedFloor, PlanPoint, Tier, TierStorey, Tiers};

/// Adds bearings, dashpots and the stop between the nodes of the ground and of the mat of a building that stands on it.
///
/// Every bearing has an equal share of the weight, the stiffness, the strength and the dashpot.
pub(super) fn put_on_mat(
    tiers: &Tiers,
    isolation: &Isolation,
    mat: &Tier,
    [ground, node]: [usize; 2],
    discretization: &mut Discretization,
) {
    let sticks = &mut discretization.stick_model;
    let mass = sticks.nodes.iter().map(|own| own.mass).sum();
    let weight = isolation.weight_of(mass);
    let dashpot = isolation.dashpot(mass);
    let bearings = tiers.bearing_points();
    let share = 1.0 / bearings.len() as f64;
    let isolator = &isolation.isolator;
    let stiffness = isolator.stiffness(weight);
    let (elastic, slider) = match isolator.yielding(weight) {
        None => (stiffness, None),
        Some([strength, second, _]) => {
            let own = [stiffness - second, strength].map(|value| share * value);
            let rows = Hysteresis::in_plan(CircularLaw::Slider, own[0], own[1]);
            (second, rows.ok())
        }
    };
    let stop = isolation.stops[0];
    let ring = stop.and_then(|stop| {
        let rows = Hysteresis::in_plan(CircularLaw::Ring, stop.stiffness, stop.at);
        rows.ok()
    });
    let lumped = [LumpedFloor::rigid(mat)];
    let mut matrix = PlanMatrix::new(3);
    // Stiffness-proportional damping does not act on bearings.
    for (value, part) in [(-elastic, Part::Softening), (dashpot, Part::Dashpot)] {
        let each: Vec<_> = bearings
            .iter()
            .map(|at| (*at, [share * value; 2]))
            .collect();
        if value != 0.0 {
            matrix.add_storey(&lumped, 0, &TierStorey::of_elements(&each), part);
        }
    }
    sticks.couplings.extend(matrix.couplings(ground, &[node]));
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
        centre: mat.centre,
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
    /// Mass-proportional damping of the motion relative to the mat in plan: Tᵀ α M T instead of α M, with T q the motion of every
    /// floor less that of the mat as a rigid body (theory, Eq. B6).
    pub(super) fn damp_relative_to_mat_in_plan(&mut self, alpha: f64) {
        let Some(mat) = self.stick_model.plan_mat.clone() else {
            return;
        };
        let nodes = &self.stick_model.nodes;
        let Some(ground) = nodes.iter().position(|own| own.support == Support::Fixed) else {
            return;
        };
        let point = |node: usize, centre: PlanPoint| {
            LumpedFloor::rigid(&Tier {
                mass: nodes[node].mass,
                polar_mass: nodes[node].rotary_inertia,
                centre,
                plan: Vec::new(),
            })
        };
        let mut couplings = Vec::new();
        let own = point(mat.node, mat.centre);
        let moved = |floor: &LumpedFloor, factor: f64| TierStorey {
            stiffness: [floor.tier.mass, floor.tier.mass, floor.tier.polar_mass]
                .map(|mass| factor * mass),
            centre: floor.tier.centre,
        };
        for (&floor, &centre) in self.floors.iter().zip(&self.centres) {
            let pair = [own.clone(), point(floor, centre)];
            let mut matrix = PlanMatrix::new(6);
            matrix.add_storey(&pair, 1, &moved(&pair[1], alpha), Part::Dashpot);
            couplings.extend(matrix.couplings(ground, &[mat.node, floor]));
            let mut alone = PlanMatrix::new(3);
            alone.add_storey(&pair[1..], 0, &moved(&pair[1], -alpha), Part::Dashpot);
            couplings.extend(alone.couplings(ground, &[floor]));
        }
        let mut alone = PlanMatrix::new(3);
        let pair = [own];
        alone.add_storey(&pair, 0, &moved(&pair[0], -alpha), Part::Dashpot);
        couplings.extend(alone.couplings(ground, &[mat.node]));
        self.stick_model.couplings.extend(couplings);
    }
}
