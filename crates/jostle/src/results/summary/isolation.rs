//! Bearings and walls.

use std::ops::{Deref, DerefMut};

use serde::{Serialize, Serializer};

use super::building::FloorSummary;
use crate::quantity::{Quantity, Unit};

/// Floors of a building from the ground up. They are the list of the floors above the ground or the mat; `summary.json` has the
/// mat before them, as floor 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Floors {
    /// The mat of an isolated building.
    pub mat: Option<FloorSummary>,
    /// Floors above the ground or the mat.
    pub above: Vec<FloorSummary>,
}

impl Floors {
    /// The mat, if there is one, and the floors above.
    pub fn with_mat(&self) -> impl Iterator<Item = &FloorSummary> {
        self.mat.iter().chain(&self.above)
    }
}

impl Deref for Floors {
    type Target = Vec<FloorSummary>;

    fn deref(&self) -> &Vec<FloorSummary> {
        &self.above
    }
}

impl DerefMut for Floors {
    fn deref_mut(&mut self) -> &mut Vec<FloorSummary> {
        &mut self.above
    }
}

impl From<Vec<FloorSummary>> for Floors {
    fn from(above: Vec<FloorSummary>) -> Self {
        Self { mat: None, above }
    }
}

impl FromIterator<FloorSummary> for Floors {
    fn from_iter<I: IntoIterator<Item = FloorSummary>>(floors: I) -> Self {
        Self::from(floors.into_iter().collect::<Vec<_>>())
    }
}

impl<'a> IntoIterator for &'a mut Floors {
    type Item = &'a mut FloorSummary;
    type IntoIter = std::slice::IterMut<'a, FloorSummary>;

    fn into_iter(self) -> Self::IntoIter {
        self.above.iter_mut()
    }
}

impl<'a> IntoIterator for &'a Floors {
    type Item = &'a FloorSummary;
    type IntoIter = std::slice::Iter<'a, FloorSummary>;

    fn into_iter(self) -> Self::IntoIter {
        self.above.iter()
    }
}

impl Serialize for Floors {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.with_mat())
    }
}

/// Bearings of a building, all together.
#[derive(Clone, Debug, Default, Serialize, PartialEq)]
pub struct IsolationSummary {
    /// Kind of the bearings, as a model file spells it.
    pub kind: &'static str,
    /// Weight on the bearings \[N\].
    pub weight_n: f64,
    /// Greatest displacement of the mat to the right \[m\].
    pub displacement_max_m: f64,
    /// Greatest displacement of the mat to the left \[m\].
    pub displacement_min_m: f64,
    /// Greatest force of bearings and dashpot, without stops, either sign \[N\].
    pub force_peak_n: f64,
    /// Displacement of the mat at the end \[m\].
    pub residual_m: f64,
    /// Energy dissipated by yielding or friction \[J\].
    pub hysteretic_j: f64,
    /// Energy dissipated in the dashpot \[J\].
    pub damped_j: f64,
    /// Greatest force of a stop; `None` without stops \[N\].
    pub stop_force_peak_n: Option<f64>,
    /// Whether the mat moved beyond the limit of the bearings; false without a limit.
    pub limit_exceeded: bool,
    /// That limit; `None` without one \[m\].
    #[serde(skip)]
    pub limit_m: Option<f64>,
    /// Stages of bearings with several sliding surfaces, the inner one first, then from the lower to the upper bowl; empty for others.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub stages: Vec<StageSummary>,
    /// Across and over all bearings; absent in one plane.
    #[serde(flatten)]
    pub in_plan: Option<IsolationInPlan>,
}

/// A stage of a bearing with several sliding surfaces: of a triple pendulum both inner surfaces together, then the lower and the
/// upper bowl, each by what the slider turns less.
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
pub struct StageSummary {
    /// Which it is: `inner`, `lower` or `upper`.
    pub name: &'static str,
    /// Greatest travel, either sign \[m\].
    pub travel_peak_m: f64,
    /// Travel at its rim \[m\].
    pub travel_m: f64,
}

#[rustfmt::skip]
impl StageSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("travel_peak_m", Unit::M, "peak displacement on this surface", |s| s.travel_peak_m),
        Quantity::<Self>::real("travel_m", Unit::M, "displacement capacity of this surface, at its rim", |s| s.travel_m),
    ];
}

/// Bearings of a building in plan.
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
pub struct IsolationInPlan {
    /// Number of bearings.
    pub bearings: usize,
    /// Greatest length of the displacement of a bearing \[m\].
    pub stroke_peak_m: f64,
    /// Its instant \[s\].
    pub stroke_peak_at_s: f64,
    /// That bearing, from 1.
    pub stroke_bearing: usize,
    /// Greatest length of the displacement of a bearing at the end \[m\].
    pub residual_stroke_m: f64,
    /// Greatest displacement of the mat across \[m\].
    pub displacement_across_max_m: f64,
    /// Least displacement of the mat across, ≤ 0 \[m\].
    pub displacement_across_min_m: f64,
    /// Displacement of the mat across at the end \[m\].
    pub residual_across_m: f64,
    /// Greatest force of bearings and dashpots across, without stops, either sign \[N\].
    pub force_across_peak_n: f64,
}

#[rustfmt::skip]
impl IsolationInPlan {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::whole("bearings", "number of bearings; four equivalent ones if their positions are not given", |i| i.bearings),
        Quantity::<Self>::real("stroke_peak_m", Unit::M, "peak displacement of a bearing, in any direction", |i| i.stroke_peak_m),
        Quantity::<Self>::real("stroke_peak_at_s", Unit::S, "time of this peak", |i| i.stroke_peak_at_s),
        Quantity::<Self>::whole("stroke_bearing", "number of the bearing with this stroke, from 1", |i| i.stroke_bearing),
        Quantity::<Self>::real("residual_stroke_m", Unit::M, "greatest displacement of a bearing at the end, in any direction", |i| i.residual_stroke_m),
        Quantity::<Self>::real("displacement_across_max_m", Unit::M, "greatest displacement of the mat across the row", |i| i.displacement_across_max_m).in_study(),
        Quantity::<Self>::real("displacement_across_min_m", Unit::M, "largest displacement of the mat towards −y, ≤ 0", |i| i.displacement_across_min_m).in_study(),
        Quantity::<Self>::real("residual_across_m", Unit::M, "displacement of the mat across the row at the end", |i| i.residual_across_m).in_study(),
        Quantity::<Self>::real("force_across_peak_n", Unit::N, "peak force of bearings and dashpots across, without stops", |i| i.force_across_peak_n).in_study(),
    ];
}

impl IsolationSummary {
    /// Greatest displacement of the mat, either sign; in plan that of a bearing in any direction \[m\].
    #[must_use]
    pub fn displacement_peak_m(&self) -> f64 {
        match self.in_plan {
            Some(plan) => plan.stroke_peak_m,
            None => self.displacement_max_m.max(-self.displacement_min_m),
        }
    }

    /// Displacement of the mat at the end, either sign; in plan the greatest of a bearing in any direction \[m\].
    #[must_use]
    pub fn residual_stroke_m(&self) -> f64 {
        match self.in_plan {
            Some(plan) => plan.residual_stroke_m,
            None => self.residual_m.abs(),
        }
    }

    /// Whether every stage of bearings with several sliding surfaces stood at its rim.
    #[must_use]
    pub fn reached_rims(&self) -> bool {
        let at_rim = |stage: &StageSummary| stage.travel_peak_m >= stage.travel_m;
        !self.stages.is_empty() && self.stages.iter().all(at_rim)
    }

    /// Greatest displacement of a bearing over the limit of the bearings; `None` without a limit \[–\].
    #[must_use]
    pub fn stroke_ratio(&self) -> Option<f64> {
        self.limit_m.map(|limit| self.displacement_peak_m() / limit)
    }
}

#[rustfmt::skip]
impl IsolationSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("weight_n", Unit::N, "weight on the bearings", |i| i.weight_n),
        Quantity::<Self>::real("displacement_max_m", Unit::M, "greatest displacement of the mat to the right", |i| i.displacement_max_m).in_study(),
        Quantity::<Self>::real("displacement_min_m", Unit::M, "greatest displacement of the mat to the left", |i| i.displacement_min_m).in_study(),
        Quantity::<Self>::real("force_peak_n", Unit::N, "peak force of bearings and dashpot, without stops", |i| i.force_peak_n).in_study(),
        Quantity::<Self>::real("residual_m", Unit::M, "displacement of the mat at the end", |i| i.residual_m).in_study(),
        Quantity::<Self>::real("hysteretic_j", Unit::J, "energy dissipated by yielding or friction", |i| i.hysteretic_j).in_study(),
        Quantity::<Self>::real("damped_j", Unit::J, "energy dissipated in the dashpot", |i| i.damped_j).in_study(),
        Quantity::<Self>::optional("stop_force_peak_n", Unit::N, "peak force of a stop; absent without stops", |i| i.stop_force_peak_n).in_study(),
        Quantity::<Self>::real("limit_exceeded", Unit::NONE, "whether the mat exceeded the limit of the bearings", |i| f64::from(u8::from(i.limit_exceeded))),
        Quantity::<Self>::real("stroke_peak_m", Unit::M, "peak displacement of a bearing, with a plan in any direction", Self::displacement_peak_m).not_in_summary().in_study(),
        Quantity::<Self>::real("residual_stroke_m", Unit::M, "greatest displacement of a bearing at the end", Self::residual_stroke_m).not_in_summary().in_study(),
        Quantity::<Self>::optional("stroke_ratio", Unit::NONE, "ratio of peak displacement of a bearing to limit; absent without limit", Self::stroke_ratio).not_in_summary().in_study(),
    ];
}

/// A wall with a name.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct WallSummary {
    /// Name.
    pub name: String,
    /// Greatest displacement, either sign; zero for a rigid wall \[m\].
    pub displacement_peak_m: f64,
    /// Greatest total force of the contacts of a gap on it \[N\].
    pub force_peak_n: f64,
    /// Energy dissipated in its dashpot \[J\].
    pub dissipated_j: f64,
}

#[rustfmt::skip]
impl WallSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("displacement_peak_m", Unit::M, "peak displacement", |w| w.displacement_peak_m),
        Quantity::<Self>::real("force_peak_n", Unit::N, "greatest total contact force of a gap on the wall", |w| w.force_peak_n),
        Quantity::<Self>::real("dissipated_j", Unit::J, "energy dissipated in its dashpot", |w| w.dissipated_j),
    ];
}
