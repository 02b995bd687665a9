//! The faces of a gap between two buildings with plans.

use super::contact_points::point_pairs;
use super::plan_contacts::{PlanFace, plan_faces};
use crate::model::{Gap, Model, Structure, Tiers};

/// Faces of a gap with the indices of their floors, from the lowest up; `None` where its buildings or floors do not fit.
pub(crate) fn faces_of_gap(model: &Model, gap: &Gap) -> Option<Vec<([usize; 2], PlanFace)>> {
    let [a, b] = gap.between;
    let tiers = |building: Option<usize>| -> Option<&Tiers> {
        match &model.buildings.get(building?)?.structure {
            Structure::Tiers(tiers) => Some(tiers),
            _ => None,
        }
    };
    let sides = [tiers(a)?, tiers(b)?];
    let neighbours = model.neighbours(gap.between);
    let pairs = point_pairs(&gap.floors, neighbours, gap.level_tolerance).ok()?;
    let heights = [
        neighbours[0]?.floor_heights(),
        neighbours[1]?.floor_heights(),
    ];
    let mut found = Vec::new();
    for pair in pairs {
        let floor = |side: usize| {
            heights[side]
                .iter()
                .position(|own| Some(*own) == pair[side])
        };
        let (Some(i), Some(j)) = (floor(0), floor(1)) else {
            continue;
        };
        let plans = (sides[0].floors.get(i)?, sides[1].floors.get(j)?);
        let faces = plan_faces(&plans.0.plan, &plans.1.plan, &gap.in_plan);
        found.extend(faces.into_iter().map(|face| ([i, j], face)));
    }
    found.sort_by_key(|(floors, _)| *floors);
    Some(found)
}

/// Least distance of the plans at the contact points of a gap \[m\]; `None` if it has none.
#[must_use]
pub fn narrowest_gap(model: &Model, gap: usize) -> Option<f64> {
    narrowest(&faces_of_gap(model, model.gaps.get(gap)?)?)
}

/// Least distance of faces and corners \[m\]. Of two corners that pass each other one may already be behind the other; then
/// the distance along the other normal counts.
pub(crate) fn narrowest(faces: &[([usize; 2], PlanFace)]) -> Option<f64> {
    let of_face = |face: &PlanFace| {
        let is_behind = face.ends.iter().any(|end| end.is_indentation);
        let points = face.points.iter().map(|point| point.gap);
        points
            .filter(|gap| !is_behind || *gap >= 0.0)
            .min_by(f64::total_cmp)
    };
    let gaps = faces.iter().filter_map(|(_, face)| of_face(face));
    gaps.min_by(f64::total_cmp)
}
