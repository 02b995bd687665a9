//! The ground under a building, where it differs.

use serde::Serialize;

use super::summarise::Run;
use crate::quantity::{Quantity, Unit};
use crate::system::RunGrounds;

/// The ground under one building.
#[derive(Clone, Copy, Debug, Default, Serialize, PartialEq)]
pub struct GroundSummary {
    /// When the motion arrives \[s\].
    pub arrival_s: f64,
    /// Greatest ground displacement along the row from rest, either sign \[m\]; in space along x.
    pub displacement_peak_m: f64,
    /// Ground displacement at the end of the run, positive to the right \[m\].
    pub displacement_end_m: f64,
    /// Across, of buildings in space; absent in one plane.
    #[serde(flatten)]
    pub in_plan: Option<GroundInPlan>,
}

/// The ground under one building with a plan, across.
#[derive(Clone, Copy, Debug, Default, Serialize, PartialEq)]
pub struct GroundInPlan {
    /// Greatest ground displacement across from rest, either sign \[m\].
    pub displacement_across_peak_m: f64,
    /// Ground displacement across at the end of the run \[m\].
    pub displacement_across_end_m: f64,
}

#[rustfmt::skip]
impl GroundInPlan {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("displacement_across_peak_m", Unit::M, "peak ground displacement across, from rest", |g| g.displacement_across_peak_m),
        Quantity::<Self>::real("displacement_across_end_m", Unit::M, "ground displacement across at the end", |g| g.displacement_across_end_m),
    ];
}

#[rustfmt::skip]
impl GroundSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("arrival_s", Unit::S, "arrival time of the ground motion", |g| g.arrival_s),
        Quantity::<Self>::real("displacement_peak_m", Unit::M, "peak ground displacement, from rest", |g| g.displacement_peak_m),
        Quantity::<Self>::real("displacement_end_m", Unit::M, "ground displacement at the end, positive to the right", |g| g.displacement_end_m),
    ];
}

/// Instants in which a ground displacement is looked at, if its motion is no record.
const INSTANTS: f64 = 2000.0;

/// Of a building; `None` where one ground is under all.
pub(super) fn ground_summary(index: usize, run: &Run<'_>) -> Option<GroundSummary> {
    run.motion.grounds.as_ref()?;
    let path = run.motion.under(index);
    let end = run.outcome.state.time;
    let step = run.motion.corner_step().unwrap_or(end / INSTANTS);
    let count = (end / step).ceil().min(1e7) as u64;
    let mut peaks = [0.0_f64; 2];
    for i in 0..=count {
        let moved = path.at((i as f64 * step).min(end)).displacement;
        for (peak, moved) in peaks.iter_mut().zip(moved) {
            *peak = peak.max(moved.abs());
        }
    }
    let last = path.at(end).displacement;
    let in_space = run.system.is_in_space();
    Some(GroundSummary {
        arrival_s: path.arrival(),
        displacement_peak_m: peaks[0],
        displacement_end_m: last[0],
        in_plan: in_space.then_some(GroundInPlan {
            displacement_across_peak_m: peaks[1],
            displacement_across_end_m: last[1],
        }),
    })
}

/// How much of the closing of a joint at an instant is that of its grounds \[m\]; `None` where one ground is under all. Joints: the
/// contacts of the system, then its links.
pub(super) fn closing_of_grounds(joint: usize, at: f64, run: &Run<'_>) -> Option<f64> {
    let grounds = RunGrounds::new(run.system, run.motion);
    grounds.part.then(|| grounds.closing_at(joint, at))
}
