//! Peaks of braces and struts of frames.

use super::summarise::springs_of;
use super::summary::PartSummary;
use crate::hysteresis::HysteresisRule;
use crate::stepping::Outcome;
use crate::structure::{DiagonalForce, FrameDiagonal, SpringPlace};
use crate::system::BuildingSystem;

/// Braces and struts of a building, in the order of the model.
pub(super) fn parts_of(
    index: usize,
    building: &BuildingSystem,
    outcome: &Outcome,
) -> Vec<PartSummary> {
    let diagonals = &building.discretization.diagonals;
    if diagonals.is_empty() {
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
        }
    };
    building.members.diagonals.iter().map(part).collect()
}

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
