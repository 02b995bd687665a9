//! Points of columns between floors: where neighbours can strike them, and where struts meet those of a space frame.

use std::collections::BTreeMap;

use crate::linear::Row;
use crate::model::{
    ColumnLine, Frame, LumpedFloor, PlanColumn, PointOnColumn, PointsOnColumns, SpaceFrame,
    SpacePlace,
};

/// Where neighbours can strike a building between its floors, or links end.
///
/// ```
/// use jostle::structure::StruckPoints;
///
/// // The right face of a frame, 3.3 m above its base.
/// let points = StruckPoints { faces: [vec![], vec![3.3]], ..StruckPoints::default() };
/// assert!(points.columns.is_empty());
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StruckPoints {
    /// Heights above the base on the left and on the right face of a building in one plane \[m\].
    pub faces: [Vec<f64>; 2],
    /// Heights above the joint at the foot of columns of a building with a plan \[m\].
    pub columns: BTreeMap<PlanColumn, Vec<f64>>,
}

impl StruckPoints {
    /// Those on the faces of a plane frame, by the columns that stand there.
    pub(super) fn on_outer_columns(&self, frame: &Frame) -> PointsOnColumns {
        let mut found = PointsOnColumns::new();
        let mut top = 0.0;
        for (storey, height) in frame.storey_heights.iter().enumerate() {
            top += height;
            for (heights, line) in self
                .faces
                .iter()
                .zip(frame.outer_lines(storey + 1).into_iter().flatten())
            {
                let points = heights.iter().map(|point| PointOnColumn {
                    above: point - top + height,
                    is_pushed: true,
                });
                found.entry([storey, line]).or_default().extend(points);
            }
        }
        found
    }
}

/// A point of a column of a building with a plan between its floors.
#[derive(Clone, Debug, PartialEq)]
pub struct PointNode {
    /// Its column.
    pub column: PlanColumn,
    /// Height above the base \[m\].
    pub height: f64,
    /// Its mass \[kg\].
    pub mass: f64,
    /// Its displacements along x and across, over those of nodes.
    pub moved: [Row; 2],
    /// The node that moves with it alone.
    pub node: usize,
}

/// Points of one column closer than this coincide \[m\].
const SAME: f64 = 1e-6;

/// A point of a column of a space frame that moves by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ColumnPoint {
    pub(super) column: SpacePlace,
    /// Height above the joint at its foot \[m\].
    pub(super) above: f64,
    /// Mass of the halves of both segments that meet there \[kg\].
    pub(super) mass: f64,
    /// Whether a neighbour can strike it, rather than a strut meet it alone.
    pub(super) is_struck: bool,
}

/// All such points of a space frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ColumnPoints {
    /// Column by column, from the lowest of each up.
    pub(super) all: Vec<ColumnPoint>,
    /// Mass of every floor that they carry in its place \[kg\].
    pub(super) taken: Vec<f64>,
}

impl ColumnPoints {
    /// Points where columns can be struck, and where struts meet them. A column whose mass m′h belongs to the floors in halves gives each
    /// point ½ m′ of both segments beside it; the floors keep the rest.
    pub(super) fn new(
        frame: &SpaceFrame,
        storey_heights: &[f64],
        struck: &BTreeMap<PlanColumn, Vec<f64>>,
    ) -> Self {
        let in_grid = struck.iter().filter_map(|(column, heights)| {
            let ColumnLine::Crossing(line) = column.line else {
                return None;
            };
            let storey = column.storey;
            Some((SpacePlace::Column { line, storey }, heights.clone()))
        });
        let struck: BTreeMap<SpacePlace, Vec<f64>> = in_grid.collect();
        let mut heights = struck.clone();
        for (column, above) in frame.ends_of_struts(storey_heights) {
            heights.entry(column).or_default().push(above);
        }
        let mut points = Self {
            all: Vec::new(),
            taken: vec![0.0; storey_heights.len()],
        };
        for (column, mut heights) in heights {
            let mut members = frame.members.iter();
            let Some(member) = members.find(|member| member.place == column) else {
                continue;
            };
            let [first, last] = frame.rigid_ends(column);
            let top = frame.length(column, storey_heights) - last;
            heights.retain(|above| *above > first + SAME && *above < top - SAME);
            heights.sort_by(f64::total_cmp);
            heights.dedup_by(|a, b| (*a - *b).abs() <= SAME);
            let (Some(lowest), Some(highest)) = (heights.first(), heights.last()) else {
                continue;
            };
            let half = 0.5 * member.section.line_mass;
            let storey = column.storey();
            points.taken[storey] += half * (highest - first);
            if let Some(below) = storey.checked_sub(1) {
                points.taken[below] += half * (top - lowest);
            }
            for (index, above) in heights.iter().enumerate() {
                let before = index.checked_sub(1).map_or(first, |before| heights[before]);
                let after = heights.get(index + 1).copied().unwrap_or(top);
                points.all.push(ColumnPoint {
                    column,
                    above: *above,
                    mass: half * (after - before),
                    is_struck: struck.get(&column).is_some_and(|heights| {
                        heights.iter().any(|height| (height - above).abs() <= SAME)
                    }),
                });
            }
        }
        points
    }

    /// Points of a column and their numbers, upwards.
    pub(super) fn of(&self, column: SpacePlace) -> impl Iterator<Item = (usize, &ColumnPoint)> {
        let all = self.all.iter().enumerate();
        all.filter(move |(_, point)| point.column == column)
    }

    /// Number of the point of a column nearest to a height above its foot.
    pub(super) fn nearest(&self, column: SpacePlace, above: f64) -> Option<usize> {
        let off = |point: &ColumnPoint| (point.above - above).abs();
        let nearest = self
            .of(column)
            .min_by(|(_, a), (_, b)| off(a).total_cmp(&off(b)));
        nearest.map(|(number, _)| number)
    }
}

/// Floors without the mass that points of columns carry in their place, spread as that of the floor.
pub(super) fn lightened(floors: &mut [LumpedFloor], taken: &[f64]) {
    for (floor, taken) in floors.iter_mut().zip(taken) {
        let tier = &mut floor.tier;
        tier.polar_mass *= 1.0 - taken / tier.mass;
        tier.mass -= taken;
    }
}
