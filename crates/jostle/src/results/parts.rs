//! Peaks of braces, struts, walls and coupling beams of frames, and of the ground under foundations that lift off.

use super::summarise::{Run, springs_of};
use super::summary::{BuildingSummary, FibreSummary, PartSummary, SpringSummary};
use crate::history::{Kind, Owner};
use crate::hysteresis::{HysteresisRule, Stage};
use crate::model::Reach;
use crate::stepping::Outcome;
use crate::structure::{
    CouplingForce, DiagonalForce, FrameDiagonal, MemberPlace, SpringPlace, WallForce,
};
use crate::system::BuildingSystem;

/// Braces, struts, walls and coupling beams of a building, each in the order of the model, then what it lifts off.
/// `sections`: its ends made of fibres.
pub(super) fn parts_of(
    index: usize,
    building: &BuildingSystem,
    sections: &[FibreSummary],
    run: &Run,
) -> Vec<PartSummary> {
    let outcome = run.outcome;
    let diagonals = &building.discretization.diagonals;
    if diagonals.is_empty()
        && building.members.walls.is_empty()
        && building.equations.springs.is_empty()
    {
        return Vec::new();
    }
    let springs = springs_of(building, outcome);
    let part = |force: &DiagonalForce| {
        let diagonal = &diagonals[force.diagonal];
        let [most, least] = outcome.members[index][force.form];
        let spring = building.discretization.spring_of_diagonal(diagonal);
        let damage = diagonal.damage.zip(spring).map(|(damage, spring)| {
            let owner = Owner::Spring(building.spring_offset + spring);
            let changed = outcome.peaks.owned_by(owner).of(Kind::Stroke);
            let drift = -changed.least.value * damage.drift_per_shortening;
            (drift, damage.state(drift))
        });
        let fallen_s = spring.and_then(|spring| {
            let global = building.spring_offset + spring;
            let mut events = outcome.spring_events.iter();
            let event = events.find(|event| event.spring == global && event.stage == Stage::Gone);
            event.map(|event| event.time)
        });
        let buckled_s = spring.and_then(|spring| {
            let global = building.spring_offset + spring;
            let law = &building.equations.springs[spring].hysteresis;
            let mut events = outcome.spring_events.iter();
            let event =
                events.find(|event| event.spring == global && event.stage == Stage::Buckled);
            law.has_buckled(&outcome.state.springs[global])
                .then(|| event.map_or(0.0, |event| event.time))
        });
        let (deformed, dissipated_j) = match spring {
            Some(spring) => {
                let spring_summary = &springs[spring];
                // What is elastic as long as it touches dissipates nothing; rounding errors of its work are no loss.
                let rule = building.equations.springs[spring].hysteresis.rule();
                let elastic = matches!(rule, HysteresisRule::Stop { .. }) && fallen_s.is_none();
                let dissipated = if elastic {
                    0.0
                } else {
                    spring_summary.dissipated_j
                };
                (
                    [
                        spring_summary.deformation_max,
                        spring_summary.deformation_min,
                    ],
                    dissipated,
                )
            }
            None => ([most, -least].map(|force| force / diagonal.stiffness), 0.0),
        };
        PartSummary {
            name: name_of(building, diagonal.frame, &local_name(building, diagonal)),
            kind: diagonal.place.kind.name(),
            force_max_n: most.max(0.0),
            force_min_n: least.min(0.0),
            deformation_max: deformed[0].max(0.0),
            deformation_min: deformed[1].max(0.0),
            dissipated_j,
            buckled_s,
            out_of_plane_ratio: diagonal
                .across
                .map(|panel| panel.ratio(acceleration_across(index, building, diagonal, run))),
            fallen_s,
            drift: damage.map(|(drift, _)| drift),
            damage_state: damage.map(|(_, state)| state),
            ..PartSummary::default()
        }
    };
    let members = &building.members;
    let range = |form: usize| outcome.members[index][form];
    let walls = members.walls.iter();
    let beams = members.coupling_beams.iter();
    members
        .diagonals
        .iter()
        .map(part)
        .chain(walls.map(|wall| of_wall(building, &springs, wall, sections, range)))
        .chain(beams.map(|beam| of_coupling_beam(building, &springs, beam, range)))
        .chain(footings_of(building, &springs, outcome))
        .collect()
}

/// Greatest total acceleration across the plane of a panel, of the floors below and above it. In one plane it is that along the row: the
/// building is taken to move as much the other way. Below the lowest storey it is the mat or the ground of the model, in one plane \[m/s²\].
fn acceleration_across(
    index: usize,
    building: &BuildingSystem,
    diagonal: &FrameDiagonal,
    run: &Run,
) -> f64 {
    let in_plan = !building.discretization.centres.is_empty();
    // Shares of motions along x and across in that across the frame.
    let [along, across] = diagonal.direction.map(f64::abs);
    let shares = match in_plan {
        true => [across, along],
        false => [1.0, 0.0],
    };
    let of_floor = |floor: usize| {
        let peaks = run.outcome.peaks.floor(index, floor);
        let across = match shares[1] > 0.0 {
            true => peaks.across().total_acceleration(),
            false => 0.0,
        };
        shares[0] * peaks.total_acceleration() + shares[1] * across
    };
    let below = match diagonal.place.storey {
        1 if in_plan => 0.0,
        1 if building.support.is_some() => of_floor(0),
        1 => run.motion.peak(),
        storey => of_floor(storey - 1),
    };
    below.max(of_floor(diagonal.place.storey))
}

/// Panels that bear less across their plane than their inertia asks.
pub(super) fn panel_warnings(buildings: &[BuildingSummary]) -> Vec<String> {
    let warning = |building: &BuildingSummary| {
        let ratio = |part: &PartSummary| part.out_of_plane_ratio.filter(|ratio| *ratio > 1.0);
        let parts = building.parts.iter();
        let beyond = parts.filter_map(|part| Some((ratio(part)?, &part.name)));
        let worst = beyond.max_by(|a, b| a.0.total_cmp(&b.0))?;
        let fallen = building.fallen_panels();
        if let Some((first, at)) = fallen.iter().min_by(|a, b| a.1.total_cmp(&b.1)) {
            return Some(format!(
                "infill panels of \"{}\" fall out of plane: {}, {first} first at {at:.3} s; their struts carry no force afterwards",
                building.name,
                match fallen.len() {
                    1 => "one".to_owned(),
                    count => count.to_string(),
                }
            ));
        }
        Some(format!(
            "infill panels of \"{}\" can fail out of plane: the demand on {} is {:.2} times its capacity; the model keeps its struts",
            building.name, worst.1, worst.0
        ))
    };
    buildings.iter().filter_map(warning).collect()
}

/// Peaks at the foot of a wall; `sections`: all ends made of fibres; `range`: greatest and least value of a form.
fn of_wall(
    building: &BuildingSystem,
    springs: &[SpringSummary],
    wall: &WallForce,
    sections: &[FibreSummary],
    range: impl Fn(usize) -> [f64; 2],
) -> PartSummary {
    let discretization = &building.discretization;
    let spring = |place| Some(&springs[discretization.spring_at(wall.frame, place)?]);
    let (hinge, sliding) = (spring(wall.hinge), wall.sliding.and_then(spring));
    let upper = wall.upper_hinges.iter().filter_map(|place| spring(*place));
    let dissipated = [hinge, sliding].into_iter().flatten().chain(upper);
    let (force, moment, stretched) = (
        range(wall.axial),
        range(wall.moment),
        range(wall.elongation),
    );
    let foot = wall.foot_section.map(|foot| &sections[foot]);
    let [most, least] = match (hinge, foot) {
        (Some(hinge), _) => [hinge.deformation_max, hinge.deformation_min],
        (None, Some(foot)) => match foot.across.as_ref().filter(|_| wall.across) {
            Some(foot) => [foot.rotation_across_max_rad, -foot.rotation_across_min_rad],
            None => [foot.rotation_max_rad, -foot.rotation_min_rad],
        },
        (None, None) => [0.0; 2],
    };
    let fibres = wall.sections.iter();
    // The sum of nothing is −0.0.
    let of_fibres = fibres.fold(0.0, |sum, section| sum + sections[*section].dissipated_j);
    PartSummary {
        name: name_of(building, wall.frame, &format!("wall.{}", wall.number)),
        kind: "wall",
        force_max_n: force[0].max(0.0),
        force_min_n: force[1].min(0.0),
        deformation_max: stretched[0].max(0.0),
        deformation_min: -stretched[1].min(0.0),
        moment_max_n_m: Some(moment[0]),
        moment_min_n_m: Some(moment[1]),
        rotation_max_rad: Some(most.max(0.0)),
        rotation_min_rad: Some(least.max(0.0)),
        dissipated_j: dissipated.fold(of_fibres, |sum, spring| sum + spring.dissipated_j),
        ..PartSummary::default()
    }
}

/// Peaks of a coupling beam.
fn of_coupling_beam(
    building: &BuildingSystem,
    springs: &[SpringSummary],
    coupling: &CouplingForce,
    range: impl Fn(usize) -> [f64; 2],
) -> PartSummary {
    let discretization = &building.discretization;
    let beam = discretization.coupling_beams[coupling.beam];
    let (floor, span) = (beam.part.floor, beam.part.bay);
    let sliding = SpringPlace::sliding(MemberPlace::Beam { floor, span });
    let spring = discretization.spring_at(beam.frame, sliding);
    let (force, [most, least]) = (range(coupling.shear), range(coupling.chord));
    let (most, least) = (most.max(0.0), -least.min(0.0));
    PartSummary {
        name: name_of(
            building,
            beam.frame,
            &format!("coupling-beam.{floor}.{span}"),
        ),
        kind: "coupling-beam",
        force_max_n: force[0].max(0.0),
        force_min_n: force[1].min(0.0),
        deformation_max: most,
        deformation_min: least,
        rotation_max_rad: Some(most / coupling.length),
        rotation_min_rad: Some(least / coupling.length),
        dissipated_j: spring.map_or(0.0, |index| springs[index].dissipated_j),
        ..PartSummary::default()
    }
}

/// Share of the moment at the base that axial forces of coupled walls bear, by the greatest values of both \[–\].
pub(super) fn degree_of_coupling(
    index: usize,
    building: &BuildingSystem,
    outcome: &Outcome,
) -> Option<f64> {
    let coupling = building.members.coupling?;
    let [couple, total] = [coupling.couple, coupling.total].map(|form| {
        let [most, least] = outcome.members[index][form];
        most.max(-least)
    });
    (total > 0.0).then(|| couple / total)
}

/// The ground under the foundation, or under every column that can lift off.
fn footings_of(
    building: &BuildingSystem,
    springs: &[SpringSummary],
    outcome: &Outcome,
) -> Vec<PartSummary> {
    let mut footings: Vec<(Option<usize>, PartSummary)> = Vec::new();
    let bed = &building.discretization.stick_model.bed;
    for spring_summary in springs {
        let place = building
            .discretization
            .spring_places
            .get(spring_summary.index);
        let Some(&SpringPlace::Footing { line, spring }) = place else {
            continue;
        };
        if footings.last().is_none_or(|(known, _)| *known != line) {
            let number = line.map_or_else(String::new, |line| format!(".{line}"));
            let part = PartSummary {
                name: format!("{}.footing{number}", building.name),
                kind: FOOTING,
                ..PartSummary::default()
            };
            footings.push((line, part));
        }
        let Some((_, footing)) = footings.last_mut() else {
            continue;
        };
        let global = building.spring_offset + spring_summary.index;
        let law = &building.equations.springs[spring_summary.index].hysteresis;
        let lifted = outcome
            .peaks
            .owned_by(Owner::Spring(global))
            .of(Kind::Lifted);
        let strip = bed.get(spring - 1).filter(|_| line.is_none());
        let raise = |value: &mut f64, to: f64| *value = value.max(to);
        footing.force_min_n = footing.force_min_n.min(-spring_summary.peak_force);
        raise(&mut footing.deformation_max, spring_summary.deformation_max);
        raise(&mut footing.deformation_min, spring_summary.deformation_min);
        // Ground that has not yielded is elastic; rounding errors of its work are no loss.
        if spring_summary.yielded_s.is_some() {
            footing.dissipated_j += spring_summary.dissipated_j;
        }
        let share = lifted.greatest.value / outcome.state.time.max(f64::MIN_POSITIVE);
        let pressure = strip.map(|strip| spring_summary.peak_force / strip.area);
        let settled = law.settlement(&outcome.state.springs[global]);
        for (value, found) in [
            (&mut footing.lifted_share, Some(share)),
            (&mut footing.pressure_max_pa, pressure),
            (&mut footing.settlement_m, Some(settled)),
        ] {
            *value = (*value).into_iter().chain(found).reduce(f64::max);
        }
    }
    footings.into_iter().map(|(_, footing)| footing).collect()
}

/// Kind of the ground under foundations.
const FOOTING: &str = "footing";

/// Name of a part, with its building and the frame in plan.
pub(super) fn name_of(building: &BuildingSystem, frame: Option<usize>, part: &str) -> String {
    let frames = &building.discretization.frames;
    match frame.and_then(|frame| frames.get(frame)) {
        Some(frame) => format!("{}.{frame}.{part}", building.name),
        None => format!("{}.{part}", building.name),
    }
}

/// Name within its frame; only where two cross in a bay it says which way it rises.
fn local_name(building: &BuildingSystem, diagonal: &FrameDiagonal) -> String {
    if diagonal.place.reach != Reach::BAY {
        return diagonal.place.to_string();
    }
    let bay = |diagonal: &FrameDiagonal| {
        let place = diagonal.place;
        (
            diagonal.frame,
            place.reach,
            place.kind,
            place.line,
            place.storey,
            place.bay,
        )
    };
    let same = |other: &&FrameDiagonal| bay(other) == bay(diagonal);
    let diagonals = &building.discretization.diagonals;
    let crossed = diagonals.iter().filter(same).count() > 1;
    let name = diagonal.place.to_string();
    match name.rsplit_once('.') {
        Some((bay, _)) if !crossed => bay.to_owned(),
        _ => name,
    }
}
