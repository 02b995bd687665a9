//! From the gaps and links of a model to contacts and elements between points.

use std::collections::BTreeSet;

use super::contact_points::{PointPair, SAME, point_pairs};
use super::plan_gap::struck_columns;
use crate::model::{FloorPairs, Model, PlanColumn};
use crate::structure::StruckPoints;

/// Points of all gaps and links of a checked model.
#[derive(Clone, Debug)]
pub(crate) struct JoinedPoints {
    pub(crate) gaps: Vec<Joined>,
    pub(crate) links: Vec<Joined>,
}

/// The pairs of points of one gap or link.
#[derive(Clone, Debug)]
pub(crate) struct Joined {
    pub(crate) between: [Option<usize>; 2],
    pub(crate) pairs: Vec<PointPair>,
}

impl Model {
    /// Heights of the points on the left and on the right face of a building, between its floors, where neighbours can touch
    /// it or links end, above its base \[m\].
    #[must_use]
    pub fn points_between_floors(&self, building: usize) -> [Vec<f64>; 2] {
        JoinedPoints::new(self).points_on_faces(self, building)
    }

    /// Columns of a building with a plan that others can strike between its floors.
    #[must_use]
    pub fn columns_struck_between_floors(&self, building: usize) -> BTreeSet<PlanColumn> {
        struck_columns(self, building).into_keys().collect()
    }
}

impl JoinedPoints {
    pub(crate) fn new(model: &Model) -> Self {
        let joined = |between: [Option<usize>; 2], floors: &FloorPairs, tolerance: f64| Joined {
            between,
            pairs: point_pairs(floors, model.neighbours(between), tolerance).unwrap_or_default(),
        };
        // Links inside a building join floors, which are points already.
        let inside = |between| Joined {
            between,
            pairs: Vec::new(),
        };
        let (gaps, links) = (model.gaps.iter(), model.links.iter());
        Self {
            gaps: gaps
                .map(|gap| joined(gap.between, &gap.floors, gap.level_tolerance))
                .collect(),
            links: links
                .map(|link| match link.is_inside() {
                    true => inside(link.between),
                    false => joined(link.between, &link.floors, link.level_tolerance),
                })
                .collect(),
        }
    }

    /// Points of a building of the model between its floors at which others can strike it, or links end.
    pub(crate) fn struck_points(&self, model: &Model, building: usize) -> StruckPoints {
        StruckPoints {
            faces: self.points_on_faces(model, building),
            columns: struck_columns(model, building),
        }
    }

    /// Heights above its base of the points on the left and on the right face of a building of the model that are not floors \[m\].
    pub(crate) fn points_on_faces(&self, model: &Model, building: usize) -> [Vec<f64>; 2] {
        let building_model = model.buildings.get(building);
        let foot = building_model.map_or(0.0, |building| building.base.elevation);
        let mut points = [Vec::new(), Vec::new()];
        for joined in self.gaps.iter().chain(&self.links) {
            for side in 0..2 {
                if joined.between[side] == Some(building) {
                    // The right one of two neighbours is hit on its left face.
                    let port: &mut Vec<f64> = &mut points[1 - side];
                    let levels = joined.pairs.iter().filter_map(|pair| pair[side]);
                    port.extend(levels.map(|level| level - foot));
                }
            }
        }
        for port in &mut points {
            port.sort_by(f64::total_cmp);
            port.dedup_by(|a, b| (*a - *b).abs() <= SAME);
        }
        points
    }
}
