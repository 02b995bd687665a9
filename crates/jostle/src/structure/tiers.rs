//! A shear building in space as lumped masses and entries of its matrix.

use std::sync::Arc;

use super::discretization::Discretization;
use super::element::{THETA, X, Y};
use super::plan_frames::add_frames;
use super::space_frame::condense;
use super::space_joints::add_space_joints;
use super::spring_place::SpringPlace;
use super::stick_model::{Coupling, Node, StickModel, StickPlanSpring, Support};
use crate::model::{Gravity, LumpedFloor, PlanPoint, TierStorey, Tiers};

/// Displacements of a floor.
const COMPONENTS: [usize; 3] = [X, Y, THETA];

/// Motion of a plan point per displacement of a floor with its centre of mass at `centre`: rows x, across and rotation.
pub(crate) fn motion_at(point: PlanPoint, centre: PlanPoint) -> [[f64; 3]; 3] {
    let (x, y) = (point[0] - centre[0], point[1] - centre[1]);
    [[1.0, 0.0, -y], [0.0, 1.0, x], [0.0, 0.0, 1.0]]
}

/// The lumped masses and the stiffness of a building; with P-Delta, what the weight above every storey takes from it.
pub(super) fn discretize_tiers(tiers: &Tiers, gravity: Gravity) -> Discretization {
    let mut stick_model = StickModel {
        in_plan: true,
        ..StickModel::default()
    };
    let lumped = tiers.lumped_floors();
    let mut height = 0.0;
    let mut add = |height: f64, support, mass, rotary_inertia| {
        stick_model.nodes.push(Node {
            x: 0.0,
            y: height,
            mass,
            rotary_inertia,
            support,
        });
        stick_model.nodes.len() - 1
    };
    let ground = add(0.0, Support::Fixed, 0.0, 0.0);
    let mut floors = Vec::with_capacity(tiers.floors.len());
    let own = lumped.iter().map(|floor| &floor.tier);
    for (floor, storey_height) in own.zip(&tiers.storey_heights) {
        height += storey_height;
        floors.push(add(height, Support::Free, floor.mass, floor.polar_mass));
    }
    let n = floors.len();
    let mut matrix = PlanMatrix::new(3 * n);
    for index in 0..n {
        if let Some(storey) = tiers.storeys.get(index) {
            matrix.add_storey(&lumped, index, storey, Part::Stiffness);
        }
        if gravity.p_delta {
            let softening = tiers.softening(&lumped, index);
            matrix.add_storey(&lumped, index, &softening, Part::Softening);
        }
    }
    // Joints follow the floors until a hinge yields.
    let elastic = tiers.space_frame.as_ref().filter(|own| !own.may_yield());
    let yielding = tiers.space_frame.as_ref().filter(|own| own.may_yield());
    let condensed = elastic.and_then(|frame| {
        let (stiffness, own) = condense(frame, &tiers.storey_heights, &lumped)?;
        matrix.add_stiffness(&stiffness);
        Some(Arc::new(own))
    });
    stick_model.couplings = matrix.couplings(ground, &floors);
    let (jointed, mut spring_places) = match yielding {
        Some(frame) => {
            let heights = &tiers.storey_heights;
            let sticks = &mut stick_model;
            let (own, places) = add_space_joints(frame, heights, &lumped, sticks, ground, &floors);
            (Some(Arc::new(own)), places)
        }
        None => (None, Vec::new()),
    };
    for own in &tiers.yielding {
        let (storey, axis) = (own.storey, own.axis);
        let arm = |floor: usize| motion_at(own.at, lumped[floor].tier.centre)[axis.index()][2];
        let below = storey.checked_sub(1);
        stick_model.plan_springs.push(StickPlanSpring {
            ends: [below.map_or(ground, |below| floors[below]), floors[storey]],
            component: [X, Y][axis.index()],
            levers: [below.map_or(0.0, arm), arm(storey)],
            at: own.at,
            hysteresis: own.hysteresis,
        });
        let storey = storey + 1;
        spring_places.push(match own.element {
            Some(element) => SpringPlace::Element {
                element: element + 1,
                storey,
                axis,
            },
            None => SpringPlace::PlanStorey { storey, axis },
        });
    }
    let mut discretization = Discretization {
        stick_model,
        foot: None,
        mat: None,
        left_face: Vec::new(),
        right_face: Vec::new(),
        centres: lumped.iter().map(|floor| floor.tier.centre).collect(),
        floors,
        spring_places,
        element_names: tiers.element_names.clone(),
        members: Vec::new(),
        frames: Vec::new(),
        shared_columns: Vec::new(),
        space_frame: condensed,
        jointed_frame: jointed,
    };
    add_frames(tiers, &lumped, &mut discretization);
    discretization
}

/// The matrix an entry belongs to.
#[derive(Clone, Copy)]
enum Part {
    Stiffness,
    Softening,
}

/// A symmetric matrix over three displacements of every floor, in parts; block tridiagonal without a space frame.
struct PlanMatrix {
    rows: Vec<Vec<[f64; 2]>>,
}

impl PlanMatrix {
    fn new(order: usize) -> Self {
        Self {
            rows: (0..order).map(|row| vec![[0.0; 2]; row + 1]).collect(),
        }
    }

    /// Adds Bᵀ diag(k) B of a storey.
    fn add_storey(
        &mut self,
        floors: &[LumpedFloor],
        index: usize,
        storey: &TierStorey,
        part: Part,
    ) {
        let upper = motion_at(storey.centre, floors[index].tier.centre);
        let mut places: Vec<(usize, [f64; 3])> = Vec::with_capacity(6);
        if index > 0 {
            let lower = motion_at(storey.centre, floors[index - 1].tier.centre);
            places.extend((0..3).map(|c| (3 * (index - 1) + c, [0, 1, 2].map(|r| -lower[r][c]))));
        }
        places.extend((0..3).map(|c| (3 * index + c, [0, 1, 2].map(|r| upper[r][c]))));
        for (i, (row, a)) in places.iter().enumerate() {
            for (column, b) in &places[..=i] {
                let value: f64 = (0..3).map(|r| storey.stiffness[r] * a[r] * b[r]).sum();
                self.rows[*row][*column][part as usize] += value;
            }
        }
    }

    /// Adds a lower triangle of stiffness over all displacements.
    fn add_stiffness(&mut self, triangle: &[Vec<f64>]) {
        for (row, own) in self.rows.iter_mut().zip(triangle) {
            for (entry, value) in row.iter_mut().zip(own) {
                entry[Part::Stiffness as usize] += value;
            }
        }
    }

    /// As springs between displacements, and between displacements and the ground.
    fn couplings(&self, ground: usize, floors: &[usize]) -> Vec<Coupling> {
        let place = |at: usize| (floors[at / 3], COMPONENTS[at % 3]);
        let coupling = |ends, [stiffness, softening]: [f64; 2]| Coupling {
            ends,
            stiffness,
            softening,
            dashpot: 0.0,
        };
        let mut list = Vec::new();
        let mut sums = vec![[0.0; 2]; self.rows.len()];
        for (row, values) in self.rows.iter().enumerate() {
            for (column, value) in values.iter().enumerate() {
                for part in 0..2 {
                    sums[row][part] += value[part];
                    if row != column {
                        sums[column][part] += value[part];
                    }
                }
                if row != column && *value != [0.0; 2] {
                    list.push(coupling([place(row), place(column)], value.map(|v| -v)));
                }
            }
        }
        for (at, sum) in sums.into_iter().enumerate() {
            if sum != [0.0; 2] {
                list.push(coupling([(ground, X), place(at)], sum));
            }
        }
        list
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A turn moves every point at a right angle to its arm, counter-clockwise, by the length of the arm.
    #[test]
    fn a_turn_is_counter_clockwise_about_the_centre() {
        let (centre, point) = ([2.0, 1.0], [5.0, -3.0]);
        let arm = [point[0] - centre[0], point[1] - centre[1]];
        let [x, y, _] = motion_at(point, centre);
        let moved = [x[2], y[2]];
        assert_eq!(arm[0] * moved[0] + arm[1] * moved[1], 0.0);
        assert_eq!(arm[0] * moved[1] - arm[1] * moved[0], 25.0);
    }
}
