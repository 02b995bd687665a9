//! Motion of points of floors in plan, from the histories of their centres of mass: u = (u_x − θ r_y, u_y + θ r_x).

use jostle::results::summary::ContactSummary;
use jostle::{Column, Gap, History, Model, PlanPoint, Structure};

/// Displacement of a point of a floor, over the rows of a history: along x and across \[m\]; `None` if the floor has no
/// plan or was not recorded. Floors count from 1; 0 is a mat.
pub(crate) fn point_motion(
    model: &Model,
    history: &History,
    (building, floor): (usize, usize),
    point: PlanPoint,
) -> Option<[Vec<f64>; 2]> {
    let model_building = model.buildings.get(building)?;
    let Structure::Tiers(tiers) = &model_building.structure else {
        return None;
    };
    let centre = match floor.checked_sub(1) {
        Some(index) => tiers.lumped_floors().get(index)?.tier.centre,
        None => {
            tiers
                .mat(model_building.base.isolation?.mat_mass)
                .tier
                .centre
        }
    };
    let arm = [point[0] - centre[0], point[1] - centre[1]];
    let turn = history.column(Column::displacement(building, floor).turning())?;
    let mut x = history.column(Column::displacement(building, floor))?;
    let mut y = history.column(Column::displacement(building, floor).across())?;
    for ((x, y), turn) in x.iter_mut().zip(&mut y).zip(&turn) {
        *x -= turn * arm[1];
        *y += turn * arm[0];
    }
    Some([x, y])
}

/// Indentation of the most indented point of a face in every row, negative while it is open; `None` in one plane, and where a column
/// is struck between floors, whose motion no floor has \[m\].
pub(crate) fn face_indentation(
    model: &Model,
    history: &History,
    gap: &Gap,
    contact: &ContactSummary,
) -> Option<Vec<f64>> {
    let plan = contact.in_plan?;
    let mut depths = vec![f64::NEG_INFINITY; history.len()];
    // The motion of a rigid edge is linear along it, so its ends say most; inner points matter where gaps differ.
    for point in plan.points.iter() {
        let side = |side: usize| match (gap.between[side], contact.floors[side]) {
            (Some(building), Some(floor)) => {
                point_motion(model, history, (building, floor), point.place)
            }
            (Some(_), None) => None,
            // Walls on the site move with the ground.
            (None, _) => Some([(); 2].map(|()| vec![0.0; history.len()])),
        };
        let ([ax, ay], [bx, by]) = (side(0)?, side(1)?);
        for (row, depth) in depths.iter_mut().enumerate() {
            let closing =
                plan.normal[0] * (ax[row] - bx[row]) + plan.normal[1] * (ay[row] - by[row]);
            *depth = depth.max(closing - point.gap);
        }
    }
    Some(depths)
}
