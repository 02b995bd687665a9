//! What a run does to bearings and walls.

use super::response::FloorResponse;
use super::summary::{FloorSummary, GapSummary, IsolationInPlan, IsolationSummary, WallSummary};
use crate::history::SupportPeaks;
use crate::results::Run;
use crate::results::in_plan::FloorInPlan;
use crate::results::response::Amplification;
use crate::stepping::Outcome;
use crate::structure::SpringPlace;
use crate::system::BuildingSystem;

/// Bearings of a building; `None` if it has none.
pub(super) fn isolation_summary(
    index: usize,
    building: &BuildingSystem,
    outcome: &Outcome,
) -> Option<IsolationSummary> {
    let mat = building.discretization.mat?;
    let support = building.support?;
    let peaks = outcome.supports.get(index).copied().unwrap_or_default();
    let springs = building.equations.springs.iter().enumerate();
    let (mut hysteretic, mut stop) = (0.0, None);
    for (spring, own) in springs {
        let global = building.spring_offset + spring;
        let (Some(totals), Some(place)) = (
            outcome.springs.get(global),
            building.discretization.spring_places.get(spring),
        ) else {
            continue;
        };
        match place {
            SpringPlace::Bearings | SpringPlace::BearingInPlan { .. } => {
                let memory = &outcome.state.springs[global];
                hysteretic += totals.work - own.hysteresis.recoverable_energy(memory);
            }
            SpringPlace::Stop { .. } => {
                stop = Some(totals.peak_force.max(stop.unwrap_or(0.0)));
            }
            SpringPlace::Ring { .. } => {
                stop = peaks.in_plan.map(|own| own.ring_force);
            }
            SpringPlace::Column { .. }
            | SpringPlace::Beam { .. }
            | SpringPlace::Shear { .. }
            | SpringPlace::Storey { .. }
            | SpringPlace::Base { .. }
            | SpringPlace::ColumnInPlan { .. }
            | SpringPlace::BeamInPlan { .. }
            | SpringPlace::InSpace { .. }
            | SpringPlace::PlanStorey { .. }
            | SpringPlace::Element { .. }
            | SpringPlace::Diagonal { .. } => {}
        }
    }
    let (max, min) = (peaks.displacement_max.value, peaks.displacement_min.value);
    Some(IsolationSummary {
        kind: mat.isolation.isolator.name(),
        weight_n: mat.weight,
        displacement_max_m: max,
        displacement_min_m: min,
        force_peak_n: peaks.force,
        residual_m: outcome.state.displacement[support.dof],
        hysteretic_j: hysteretic,
        damped_j: peaks.damped,
        stop_force_peak_n: stop,
        limit_exceeded: mat.isolation.limit.is_some_and(|limit| {
            let stroke = peaks.in_plan.map(|own| own.stroke.value);
            stroke.unwrap_or(max.max(-min)) > limit
        }),
        limit_m: mat.isolation.limit,
        in_plan: isolation_in_plan(building, &peaks, outcome),
    })
}

/// Of bearings in plan; `None` in one plane.
fn isolation_in_plan(
    building: &BuildingSystem,
    peaks: &SupportPeaks,
    outcome: &Outcome,
) -> Option<IsolationInPlan> {
    let (mat, own) = (building.mat_in_plan.as_ref()?, peaks.in_plan?);
    let u = &outcome.state.displacement;
    let residual = mat.bearings.iter().map(|at| {
        let [x, y] = [[1.0, 0.0], [0.0, 1.0]].map(|axis| mat.row_at(*at, axis).value(u));
        libm::hypot(x, y)
    });
    Some(IsolationInPlan {
        bearings: mat.bearings.len(),
        stroke_peak_m: own.stroke.value,
        stroke_peak_at_s: own.stroke.at,
        stroke_bearing: own.bearing + 1,
        residual_stroke_m: residual.fold(0.0, f64::max),
        displacement_across_max_m: own.across[0].value,
        displacement_across_min_m: own.across[1].value,
        residual_across_m: u[mat.dofs[1]],
        force_across_peak_n: own.force_across,
    })
}

/// The mat of an isolated building in plan as its floor 0.
fn mat_in_plan(index: usize, outcome: &Outcome) -> Option<FloorInPlan> {
    let own = outcome.supports.get(index)?.in_plan?;
    let ([across, back], [turned, other]) = (own.across, own.rotation);
    Some(FloorInPlan {
        displacement_across_max_m: across.value,
        displacement_across_max_at_s: across.at,
        displacement_across_min_m: back.value,
        displacement_across_min_at_s: back.at,
        rotation_max_rad: turned.value,
        rotation_max_at_s: turned.at,
        rotation_min_rad: other.value,
        rotation_min_at_s: other.at,
        corner_displacement_peak_m: own.corner,
        total_acceleration_across_peak_m_s2: own.total_acceleration_across,
        storey_drift_across_peak: 0.0,
        storey_drift_corner_peak: 0.0,
        storey_shear_across_peak_n: own.base_shear_across,
        storey_torque_peak_n_m: own.base_torque,
    })
}

/// The mat as floor 0. No storey is below it: its shear is the base shear, and the moment about the ground that of the lowest
/// storey.
fn mat_response(index: usize, outcome: &Outcome, lowest: &FloorResponse) -> FloorResponse {
    let SupportPeaks {
        displacement_max: max,
        displacement_min: min,
        total_acceleration,
        ..
    } = outcome.supports.get(index).copied().unwrap_or_default();
    FloorResponse {
        displacement_max_m: max.value,
        displacement_max_at_s: max.at,
        displacement_min_m: min.value,
        displacement_min_at_s: min.at,
        total_acceleration_peak_m_s2: total_acceleration,
        filtered_acceleration_peak_m_s2: None,
        storey_drift_peak: 0.0,
        storey_shear_peak_n: outcome.base_shear[index],
        overturning_moment_peak_n_m: lowest.overturning_moment_peak_n_m,
        residual_drift: 0.0,
        stability_coefficient: None,
        vertical_displacement_peak_m: None,
    }
}

/// The mat of a building as its floor 0; `floors`: those above.
pub(super) fn mat_summary(
    index: usize,
    floors: &[FloorSummary],
    run: &Run,
) -> Option<FloorSummary> {
    run.system.buildings[index].discretization.mat?;
    let lowest = floors.first()?;
    let response = mat_response(index, run.outcome, &lowest.response);
    let without_contact = run
        .without_contact
        .zip(lowest.without_contact)
        .map(|(outcome, lowest)| mat_response(index, outcome, &lowest));
    Some(FloorSummary {
        floor: 0,
        height_m: 0.0,
        response,
        in_plan: mat_in_plan(index, run.outcome),
        without_contact,
        amplification: without_contact
            .map(|without| Amplification::new(FloorResponse::QUANTITIES, &response, &without)),
    })
}

/// Walls of the model, in its order.
pub(super) fn wall_summaries(run: &Run, gaps: &[GapSummary]) -> Vec<WallSummary> {
    let first = run.model.buildings.len();
    let walls = run.system.walls.iter().enumerate();
    walls
        .map(|(index, wall)| {
            let own = run.model.gaps.iter().zip(gaps);
            let own = own.filter(|(gap, _)| gap.between.contains(&Some(first + index)));
            let force = own.map(|(_, summary)| summary.total_force_peak_n);
            let peaks = wall
                .building
                .and_then(|building| run.outcome.supports.get(building).copied())
                .unwrap_or_default();
            WallSummary {
                name: wall.name.clone(),
                displacement_peak_m: peaks
                    .displacement_max
                    .value
                    .max(-peaks.displacement_min.value),
                force_peak_n: force.fold(0.0, f64::max),
                dissipated_j: peaks.damped,
            }
        })
        .collect()
}
