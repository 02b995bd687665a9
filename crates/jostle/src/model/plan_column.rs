//! Columns of a building with a plan, and points of them between floors that move by themselves.

use std::collections::BTreeMap;

use super::{FramePlace, SpacePlace, Tiers};

/// A line of columns of a building with a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ColumnLine {
    /// At the crossing of these lines x and y of a space frame, from 0.
    Crossing([usize; 2]),
    /// Of a frame that stands in the plan: the frame, and its column line, from 0.
    OfFrame([usize; 2]),
}

/// A column of a building with a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct PlanColumn {
    /// Its line.
    pub line: ColumnLine,
    /// Its storey, from 0.
    pub storey: usize,
}

/// A point of a column between its floors that moves by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointOnColumn {
    /// Height above the joint at the foot of the column \[m\].
    pub above: f64,
    /// Whether neighbours or links push it there, so that it may yield there.
    pub is_pushed: bool,
}

/// Such points of the columns of a plane frame, by storey and line.
pub type PointsOnColumns = BTreeMap<FramePlace, Vec<PointOnColumn>>;

impl ColumnLine {
    /// Its name: `X.Y` in a space frame, `FRAME.LINE` in frames that stand in a plan; lines count from 1. `frames`: names of these.
    #[must_use]
    pub fn name(self, frames: &[String]) -> String {
        match self {
            Self::Crossing([x, y]) => format!("{}.{}", x + 1, y + 1),
            Self::OfFrame([frame, line]) => {
                let frame = frames.get(frame).map_or("", String::as_str);
                format!("{frame}.{}", line + 1)
            }
        }
    }
}

impl PlanColumn {
    /// Its name within the building, as members have it. `frames`: names of those that stand in a plan.
    #[must_use]
    pub fn name(self, frames: &[String]) -> String {
        let Self { line, storey } = self;
        match line {
            ColumnLine::Crossing(line) => SpacePlace::Column { line, storey }.to_string(),
            ColumnLine::OfFrame([frame, line]) => {
                let frame = frames.get(frame).map_or("", String::as_str);
                format!("{frame}.column.{}.{}", line + 1, storey + 1)
            }
        }
    }
}

impl Tiers {
    /// Points of the columns of a frame that neighbours push, given those of all columns. A column that two frames share bends in both
    /// planes and has the same points in both, but is pushed along one.
    pub(crate) fn points_in_frame(
        &self,
        struck: &BTreeMap<PlanColumn, Vec<f64>>,
        frame: usize,
    ) -> PointsOnColumns {
        let shared = self.shared_columns();
        let mut found = PointsOnColumns::new();
        for (column, heights) in struck {
            let ColumnLine::OfFrame(own) = column.line else {
                continue;
            };
            let both = shared.iter().map(|column| column.lines);
            let other = both.filter(|lines| lines.contains(&own)).flatten();
            let lines = std::iter::once(own).chain(other.filter(|line| *line != own));
            for [_, line] in lines.filter(|[of, _]| *of == frame) {
                let points = found.entry([column.storey, line]).or_default();
                points.extend(heights.iter().map(|above| PointOnColumn {
                    above: *above,
                    is_pushed: own[0] == frame,
                }));
            }
        }
        for points in found.values_mut() {
            // Those that are pushed come before the same points that are not.
            points.sort_by(|a, b| {
                let order = a.above.total_cmp(&b.above);
                order.then(b.is_pushed.cmp(&a.is_pushed))
            });
            points.dedup_by(|a, b| (a.above - b.above).abs() <= SAME);
        }
        found
    }
}

/// Points of one column closer than this coincide \[m\].
const SAME: f64 = 1e-6;
