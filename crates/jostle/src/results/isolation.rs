//! What a run does to bearings and walls.

use super::response::FloorResponse;
use super::summary::{
    FloorSummary, GapSummary, IsolationInPlan, IsolationSummary, StageSummary, WallSummary,
};
use crate::history::{Column, Extreme, Kind, Owner};
use crate::results::Run;
use crate::results::in_plan::{FloorInPlan, floor_in_plan};
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
    let peaks = &outcome.peaks;
    let (mat_moves, bearings) = (peaks.floor(index, 0).displacement(), Owner::Support(index));
    let springs = building.equations.springs.iter().enumerate();
    let (mut hysteretic, mut stop, mut stages) = (0.0, None, Vec::new());
    for (spring, yielding_spring) in springs {
        let global = building.spring_offset + spring;
        let Some(place) = building.discretization.spring_places.get(spring) else {
            continue;
        };
        match place {
            SpringPlace::Bearings | SpringPlace::BearingInPlan { .. } => {
                let memory = &outcome.state.springs[global];
                let work = peaks.work(Owner::Spring(global));
                hysteretic += work - yielding_spring.hysteresis.recoverable_energy(memory);
                let force = peaks.owned_by(Owner::Spring(global)).of(Kind::Force);
                let mut travels = yielding_spring.hysteresis.travels(force.size());
                travels.extend(yielding_spring.hysteresis.travels_in_plan(memory));
                let names = ["inner", "lower", "upper"];
                let names = &names[names.len() - travels.len()..];
                for (name, [went, travel_m]) in names.iter().zip(travels) {
                    // Of the bearing that goes furthest.
                    let known = stages
                        .iter_mut()
                        .find(|stage: &&mut StageSummary| stage.name == *name);
                    match known {
                        Some(known) => known.travel_peak_m = known.travel_peak_m.max(went),
                        None => stages.push(StageSummary {
                            name,
                            travel_peak_m: went,
                            travel_m,
                        }),
                    }
                }
            }
            SpringPlace::Stop { .. } => {
                let force = peaks.owned_by(Owner::Spring(global)).of(Kind::Force);
                stop = Some(force.size().max(stop.unwrap_or(0.0)));
            }
            SpringPlace::Ring { .. } => {
                let ring = Column::along(bearings, Kind::RingForce);
                stop = peaks.get(ring).map(|peak| peak.size());
            }
            SpringPlace::Column { .. }
            | SpringPlace::Struck { .. }
            | SpringPlace::Beam { .. }
            | SpringPlace::Shear { .. }
            | SpringPlace::Storey { .. }
            | SpringPlace::Base { .. }
            | SpringPlace::ColumnInPlan { .. }
            | SpringPlace::BeamInPlan { .. }
            | SpringPlace::InSpace { .. }
            | SpringPlace::PlanStorey { .. }
            | SpringPlace::Element { .. }
            | SpringPlace::Fibre { .. }
            | SpringPlace::Surface { .. }
            | SpringPlace::Sliding { .. }
            | SpringPlace::Footing { .. }
            | SpringPlace::Diagonal { .. } => {}
        }
    }
    let (max, min) = (mat_moves.greatest.value, mat_moves.least.value);
    let in_plan = isolation_in_plan(index, building, outcome);
    Some(IsolationSummary {
        kind: mat.isolation.isolator.name(),
        weight_n: mat.weight,
        displacement_max_m: max,
        displacement_min_m: min,
        force_peak_n: peaks.owned_by(bearings).of(Kind::Force).size(),
        residual_m: outcome.state.displacement[support.dof],
        hysteretic_j: hysteretic,
        damped_j: peaks.work(bearings),
        stop_force_peak_n: stop,
        limit_exceeded: mat.isolation.reach().is_some_and(|limit| {
            let stroke = in_plan.as_ref().map(|plan| plan.stroke_peak_m);
            stroke.unwrap_or(max.max(-min)) > limit
        }),
        limit_m: mat.isolation.reach(),
        stages,
        in_plan,
    })
}

/// Of bearings in plan; `None` in one plane.
fn isolation_in_plan(
    index: usize,
    building: &BuildingSystem,
    outcome: &Outcome,
) -> Option<IsolationInPlan> {
    let mat = building.mat_in_plan.as_ref()?;
    let across = outcome.peaks.floor(index, 0).across();
    if !across.moves() {
        return None;
    }
    let u = &outcome.state.displacement;
    let residual = mat.bearings.iter().map(|at| {
        let [x, y] = [[1.0, 0.0], [0.0, 1.0]].map(|axis| mat.row_at(*at, axis).value(u));
        libm::hypot(x, y)
    });
    let stroke = |bearing| {
        let owner = Owner::Bearing {
            building: index,
            bearing,
        };
        outcome.peaks.owned_by(owner).of(Kind::Stroke).greatest
    };
    // The first of those that go as far.
    let strokes = (0..mat.bearings.len()).map(|bearing| (bearing, stroke(bearing)));
    let further = |a: &(usize, Extreme), b: &(usize, Extreme)| {
        let earlier = b.1.at.total_cmp(&a.1.at);
        a.1.value
            .total_cmp(&b.1.value)
            .then(earlier)
            .then(b.0.cmp(&a.0))
    };
    let (bearing, stroke) = strokes.max_by(further)?;
    let forces = outcome.peaks.owned_by(Owner::Support(index)).across();
    Some(IsolationInPlan {
        bearings: mat.bearings.len(),
        stroke_peak_m: stroke.value,
        stroke_peak_at_s: stroke.at,
        stroke_bearing: bearing + 1,
        residual_stroke_m: residual.fold(0.0, f64::max),
        displacement_across_max_m: across.displacement_max().value,
        displacement_across_min_m: across.displacement_min().value,
        residual_across_m: u[mat.dofs[1]],
        force_across_peak_n: forces.of(Kind::Force).size(),
    })
}

/// The mat of an isolated building in plan as its floor 0.
fn mat_in_plan(index: usize, outcome: &Outcome) -> Option<FloorInPlan> {
    let base = outcome.peaks.owned_by(Owner::Building(index));
    Some(FloorInPlan {
        storey_shear_across_peak_n: base.across().storey_shear(),
        storey_torque_peak_n_m: base.turning().storey_shear(),
        ..floor_in_plan(index, 0, outcome)?
    })
}

/// The mat as floor 0. No storey is below it: its shear is the base shear, and the moment about the ground that of the lowest
/// storey.
fn mat_response(index: usize, outcome: &Outcome, lowest: &FloorResponse) -> FloorResponse {
    FloorResponse {
        storey_shear_peak_n: outcome.peaks.base_shear(index),
        overturning_moment_peak_n_m: lowest.overturning_moment_peak_n_m,
        ..FloorResponse::of_peaks(outcome.peaks.floor(index, 0))
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
        without_contact_in_plan: run
            .without_contact
            .and_then(|outcome| mat_in_plan(index, outcome)),
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
            let gaps = run.model.gaps.iter().zip(gaps);
            let wall_gaps = gaps.filter(|(gap, _)| gap.between.contains(&Some(first + index)));
            let force = wall_gaps.map(|(_, summary)| summary.total_force_peak_n);
            let peaks = &run.outcome.peaks;
            let sway = |building| peaks.sway(building, Some(0));
            let damped = |building| peaks.work(Owner::Support(building));
            WallSummary {
                name: wall.name.clone(),
                displacement_peak_m: wall.building.map_or(0.0, sway),
                force_peak_n: force.fold(0.0, f64::max),
                dissipated_j: wall.building.map_or(0.0, damped),
            }
        })
        .collect()
}
