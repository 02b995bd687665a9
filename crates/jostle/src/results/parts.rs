//! Peaks of braces and struts of frames, and of the ground under foundations that lift off.

use super::summarise::springs_of;
use super::summary::{PartSummary, SpringSummary};
use crate::history::{Kind, Owner};
use crate::hysteresis::HysteresisRule;
use crate::stepping::Outcome;
use crate::structure::{DiagonalForce, FrameDiagonal, SpringPlace};
use crate::system::BuildingSystem;

/// Braces and struts of a building in the order of the model, then what it lifts off.
pub(super) fn parts_of(
    index: usize,
    building: &BuildingSystem,
    outcome: &Outcome,
) -> Vec<PartSummary> {
    let diagonals = &building.discretization.diagonals;
    if diagonals.is_empty() && building.equations.springs.is_empty() {
        return Vec::new();
    }
    let springs = springs_of(building, outcome);
    let part = |force: &DiagonalForce| {
        let own = &diagonals[force.diagonal];
        let [most, least] = outcome.members[index][force.form];
        let place = SpringPlace::of_diagonal(own);
        let mut places = building.discretization.spring_places.iter();
        let spring = places.position(|known| *known == place);
        let (deformed, dissipated_j) = match spring {
            Some(spring) => {
                let own = &springs[spring];
                // What is elastic as long as it touches dissipates nothing; rounding errors of its work are no loss.
                let rule = building.equations.springs[spring].hysteresis.rule();
                let elastic = matches!(rule, HysteresisRule::Stop { .. });
                let dissipated = if elastic { 0.0 } else { own.dissipated_j };
                ([own.deformation_max, own.deformation_min], dissipated)
            }
            None => ([most, -least].map(|force| force / own.stiffness), 0.0),
        };
        PartSummary {
            name: format!("{}.{}", building.name, local_name(building, own)),
            kind: own.place.kind.name(),
            force_max_n: most.max(0.0),
            force_min_n: least.min(0.0),
            deformation_max: deformed[0].max(0.0),
            deformation_min: deformed[1].max(0.0),
            dissipated_j,
            lifted_share: None,
            pressure_max_pa: None,
            settlement_m: None,
        }
    };
    let parts = building.members.diagonals.iter().map(part);
    parts
        .chain(footings_of(building, &springs, outcome))
        .collect()
}

/// The ground under the foundation, or under every column that can lift off.
fn footings_of(
    building: &BuildingSystem,
    springs: &[SpringSummary],
    outcome: &Outcome,
) -> Vec<PartSummary> {
    let mut footings: Vec<(Option<usize>, PartSummary)> = Vec::new();
    let foundation = building.discretization.stick_model.foundation.as_ref();
    for own in springs {
        let place = building.discretization.spring_places.get(own.index);
        let Some(&SpringPlace::Footing { line, spring }) = place else {
            continue;
        };
        if footings.last().is_none_or(|(known, _)| *known != line) {
            let number = line.map_or_else(String::new, |line| format!(".{line}"));
            footings.push((
                line,
                empty_footing(format!("{}.footing{number}", building.name)),
            ));
        }
        let Some((_, footing)) = footings.last_mut() else {
            continue;
        };
        let global = building.spring_offset + own.index;
        let law = &building.equations.springs[own.index].hysteresis;
        let lifted = outcome
            .peaks
            .owned_by(Owner::Spring(global))
            .of(Kind::Lifted);
        let strip = foundation.and_then(|own| own.bed.get(spring - 1));
        let raise = |value: &mut f64, to: f64| *value = value.max(to);
        footing.force_min_n = footing.force_min_n.min(-own.peak_force);
        raise(&mut footing.deformation_max, own.deformation_max);
        raise(&mut footing.deformation_min, own.deformation_min);
        // Ground that has not yielded is elastic; rounding errors of its work are no loss.
        if own.yielded_s.is_some() {
            footing.dissipated_j += own.dissipated_j;
        }
        let share = lifted.greatest.value / outcome.state.time.max(f64::MIN_POSITIVE);
        let pressure = strip.map(|strip| own.peak_force / strip.area);
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

fn empty_footing(name: String) -> PartSummary {
    PartSummary {
        name,
        kind: FOOTING,
        force_max_n: 0.0,
        force_min_n: 0.0,
        deformation_max: 0.0,
        deformation_min: 0.0,
        dissipated_j: 0.0,
        lifted_share: None,
        pressure_max_pa: None,
        settlement_m: None,
    }
}

/// Kind of the ground under foundations.
const FOOTING: &str = "footing";

/// Name within the building; only where two cross it says which way it rises.
fn local_name(building: &BuildingSystem, own: &FrameDiagonal) -> String {
    let same = |other: &&FrameDiagonal| {
        let place =
            |own: &FrameDiagonal| (own.frame, own.place.kind, own.place.storey, own.place.bay);
        place(other) == place(own)
    };
    let diagonals = &building.discretization.diagonals;
    let crossed = diagonals.iter().filter(same).count() > 1;
    let name = own.place.to_string();
    let name = match name.rsplit_once('.') {
        Some((bay, _)) if !crossed => bay.to_owned(),
        _ => name,
    };
    let frames = &building.discretization.frames;
    match own.frame.and_then(|frame| frames.get(frame)) {
        Some(frame) => format!("{frame}.{name}"),
        None => name,
    }
}
