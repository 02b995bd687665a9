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
    /// Greatest ground displacement along the row from rest, either sign \[m\].
    pub displacement_peak_m: f64,
    /// Ground displacement at the end of the run, positive to the right \[m\].
    pub displacement_end_m: f64,
}

#[rustfmt::skip]
impl GroundSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("arrival_s", Unit::S, "when the ground motion arrives", |g| g.arrival_s),
        Quantity::<Self>::real("displacement_peak_m", Unit::M, "greatest displacement of the ground from rest, either sign", |g| g.displacement_peak_m),
        Quantity::<Self>::real("displacement_end_m", Unit::M, "displacement of the ground at the end, positive to the right", |g| g.displacement_end_m),
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
    let displacements = (0..=count).map(|i| path.at((i as f64 * step).min(end)).displacement);
    Some(GroundSummary {
        arrival_s: path.arrival(),
        displacement_peak_m: displacements.fold(0.0, |most, d| most.max(d.abs())),
        displacement_end_m: path.at(end).displacement,
    })
}

/// How much of the closing of a contact at an instant is that of its grounds \[m\]; `None` where one ground is under all.
pub(super) fn closing_of_grounds(contact: usize, at: f64, run: &Run<'_>) -> Option<f64> {
    let grounds = RunGrounds::new(run.system, run.motion);
    grounds.part.then(|| grounds.closing_at(contact, at))
}
