//! A shear building in space as lumped masses and entries of its matrix.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::column_points::{ColumnPoints, lightened};
use super::diagonals::FrameDiagonal;
use super::discretization::Discretization;
use super::element::{Part, THETA, X, Y, over_nodes};
use super::plan_frames::add_frames;
use super::plan_mat::put_on_mat;
use super::plan_matrix::PlanMatrix;
use super::space_frame::{Assembly, condense};
use super::space_joints::{AddedJoints, add_space_joints};
use super::spring_place::SpringPlace;
use super::stick_model::{Influence, Node, StickModel, Support, YieldingElement};
use crate::model::{
    Base, Gravity, LumpedFloor, PlanColumn, PlanPoint, ProportionalDamping, SpaceFrame, Tiers,
};

/// Motion of a plan point per displacement of a floor with its centre of mass at `centre`: rows x, across and rotation.
pub(crate) fn motion_at(point: PlanPoint, centre: PlanPoint) -> [[f64; 3]; 3] {
    let (x, y) = (point[0] - centre[0], point[1] - centre[1]);
    [[1.0, 0.0, -y], [0.0, 1.0, x], [0.0, 0.0, 1.0]]
}

/// The lumped masses and the stiffness of a building; with P-Delta, what the weight above every storey takes from it.
/// `struck`: heights on columns above their feet at which they can be struck.
pub(super) fn discretize_tiers(
    tiers: &Tiers,
    gravity: Gravity,
    base: &Base,
    struck: &BTreeMap<PlanColumn, Vec<f64>>,
) -> Discretization {
    let mut stick_model = StickModel::default();
    let points = tiers.space_frame.as_ref();
    let points = points.map(|frame| ColumnPoints::new(frame, &tiers.storey_heights, struck));
    let points = points.unwrap_or_default();
    let lumped = tiers.lumped_floors_with(struck);
    let mut lighter = lumped.clone();
    if !points.all.is_empty() {
        lightened(&mut lighter, &points.taken);
    }
    let mut height = 0.0;
    let mut add = |node: Node| {
        stick_model.nodes.push(Node {
            influence: Influence::OF_FLOOR,
            ..node
        });
        stick_model.nodes.len() - 1
    };
    let ground = add(Node::at(0.0, 0.0).held(Support::Fixed));
    let mat = tiers.carrier_with(base, struck);
    let foot = mat.as_ref().map_or(ground, |mat| add(of_floor(0.0, mat)));
    let mut floors = Vec::with_capacity(tiers.floors.len());
    for (floor, storey_height) in lighter.iter().zip(&tiers.storey_heights) {
        height += storey_height;
        floors.push(add(of_floor(height, floor)));
    }
    // All that moves, from the ground up.
    let first = usize::from(mat.is_some());
    let moving: Vec<_> = mat.iter().chain(&lumped).cloned().collect();
    let below = mat.iter().map(|_| foot);
    let nodes: Vec<usize> = below.chain(floors.iter().copied()).collect();
    let mut matrix = PlanMatrix::new(3 * moving.len());
    for index in 0..floors.len() {
        if let Some(storey) = tiers.storeys.get(index) {
            matrix.add_storey(&moving, first + index, storey, Part::Elastic);
        }
        if gravity.p_delta {
            let mut taken = tiers.softening(&lumped, index);
            taken.stiffness = taken.stiffness.map(|stiffness| -stiffness);
            matrix.add_storey(&moving, first + index, &taken, Part::Undamped);
        }
    }
    // Joints follow the floors until a hinge yields, and without points between floors; what they carry moves them as well. What stands on
    // a base that rocks rises with it.
    let rocks = base.rocks_in_plan();
    let carries = gravity.preload || rocks;
    let has_points = !points.all.is_empty();
    let follows = |frame: &&SpaceFrame| !frame.may_yield() && !carries && !has_points;
    let following = tiers.space_frame.as_ref().filter(follows);
    let condensed = following.and_then(|frame| {
        let condense = condense(frame, &tiers.storey_heights, mat.as_ref(), &lumped, &nodes)?;
        matrix.add_triangle(&condense.stiffness, Part::Elastic);
        Some((Arc::new(condense.frame), condense.elongations))
    });
    let (condensed, following) = condensed.unzip();
    if let Some(given) = &tiers.matrices {
        matrix.add_above(&given.stiffness, mat.as_ref(), &lumped, Part::Elastic);
        matrix.add_above(&given.damping, mat.as_ref(), &lumped, Part::Dashpot);
    }
    stick_model.elements = matrix.elements(ground, &nodes);
    if let (None, Some(footing)) = (&base.isolation, &mat) {
        stick_model.stand_on_footing(base, footing, foot);
    }
    let jointed = tiers
        .space_frame
        .as_ref()
        .filter(|space_frame| !follows(space_frame));
    let jointed = jointed.map(|frame| {
        let assembly = Assembly::new(frame, &tiers.storey_heights, mat.as_ref(), &lumped);
        let base = stick_model
            .plan_base
            .filter(|plan_base| plan_base.rocking.is_some());
        let assembly = assembly.rocking_about(base.map(|base| (base.middle, base.rises)));
        let assembly = assembly.with_points(points.clone());
        let floors = tiers.floors.iter().enumerate();
        let weights = floors.map(|(floor, tier)| [tier.mass, tiers.floor_load(floor)]);
        let carried: Vec<[f64; 2]> = weights.filter(|_| carries).collect();
        let bears_weight = gravity.preload;
        add_space_joints(
            assembly,
            &mut stick_model,
            ground,
            &nodes,
            &carried,
            bears_weight,
        )
    });
    let (jointed, joints) = match jointed {
        Some(mut add_space_joints) => (
            Some(Arc::new(std::mem::take(&mut add_space_joints.frame))),
            add_space_joints,
        ),
        None => (None, AddedJoints::default()),
    };
    let (mut spring_places, sections) = (joints.places, joints.sections);
    for yielding in &tiers.yielding {
        let (storey, axis) = (yielding.storey, yielding.axis);
        let arm = |floor: usize| motion_at(yielding.at, lumped[floor].tier.centre)[axis.index()][2];
        let arm_of_mat = mat.as_ref().map_or(0.0, |mat| {
            motion_at(yielding.at, mat.tier.centre)[axis.index()][2]
        });
        let below = storey.checked_sub(1);
        let component = [X, Y][axis.index()];
        let (lower, upper) = (below.map_or(foot, |below| floors[below]), floors[storey]);
        let row = over_nodes([
            ((upper, component), 1.0),
            ((lower, component), -1.0),
            ((upper, THETA), arm(storey)),
            ((lower, THETA), -below.map_or(arm_of_mat, arm)),
        ]);
        stick_model.yielding.push(YieldingElement {
            row: stick_model.without_rocking(&row),
            hysteresis: yielding.hysteresis,
            proportional_damping: ProportionalDamping::Initial,
        });
        let storey = storey + 1;
        spring_places.push(match yielding.element {
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
        centres: lumped.iter().map(|floor| floor.tier.centre).collect(),
        floors,
        spring_places,
        sections,
        element_names: tiers.element_names.clone(),
        space_frame: condensed,
        jointed_frame: jointed,
        carrier: mat.clone(),
        lumped: lighter,
        points: joints.points,
        ..Discretization::default()
    };
    if let Some(frame) = &tiers.space_frame {
        discretization.space_walls.clone_from(&frame.walls);
        let follows_floors = discretization.space_frame.is_some();
        let of_floors = following.into_iter().flatten().map(|following| {
            let motions = nodes
                .iter()
                .flat_map(|node| [X, Y, THETA].map(|c| (*node, c)));
            let row = over_nodes(motions.zip(following).filter(|(_, share)| *share != 0.0));
            [row.clone(), row]
        });
        let level = |level: usize| match level.checked_sub(1) {
            Some(floor) => discretization.floors[floor],
            None => foot,
        };
        let elongations = of_floors.chain(joints.elongations);
        let found =
            frame
                .diagonals
                .iter()
                .zip(elongations)
                .map(|(diagonal, [row, between_joints])| {
                    let ends = diagonal.place.floors().map(level);
                    FrameDiagonal {
                        between_joints,
                        ..FrameDiagonal::new(diagonal, ends, row).in_space(frame)
                    }
                });
        for space in found.collect::<Vec<_>>() {
            match follows_floors {
                // The stiffness of the frame includes it.
                true => discretization.diagonals.push(space),
                false => discretization.add_diagonal(space),
            }
        }
    }
    let below = mat.as_ref().map(|mat| (foot, mat));
    add_frames(tiers, struck, &lumped, below, carries, &mut discretization);
    if tiers.frames.is_empty() && tiers.space_frame.is_none() {
        let floors = lumped.iter().enumerate();
        let carried =
            floors.map(|(floor, tier_floor)| [tier_floor.tier.mass, tiers.floor_load(floor)]);
        discretization.let_floors_rise(&carried.collect::<Vec<_>>());
    }
    let places = [ground, foot];
    match (&base.isolation, mat) {
        (Some(isolation), Some(mat)) => {
            put_on_mat(tiers, isolation, &mat, places, &mut discretization);
        }
        (None, Some(footing)) => discretization.put_on_springs(base, &footing, places),
        (_, None) => {}
    }
    discretization
}

/// The centre of mass of a floor. Columns between floors of frames that run along move with it across only, and the other way
/// round; they are counted there.
fn of_floor(height: f64, floor: &LumpedFloor) -> Node {
    let LumpedFloor { tier, one_way } = floor;
    Node {
        mass: tier.mass,
        inertia: [
            tier.mass + one_way[0],
            tier.mass + one_way[1],
            tier.polar_mass,
        ],
        ..Node::at(0.0, height)
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
