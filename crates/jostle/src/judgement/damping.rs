//! A4: damping of the first modes.

use super::yielding::structure_yields;
use super::{Known, Tally, quoted};
use crate::model::Building;

/// Modes that are looked at.
const MODES: usize = 5;
/// Least share of the mass that a mode carries, along x or across: what higher modes do hardly shows \[–\].
const SHARE: f64 = 0.05;

/// Calls `add` with building, number and share of critical damping of the first lateral modes, by the damping of the building alone:
/// dashpots of bases, soil, bearings and links are meant to damp more.
fn ratios(known: &Known<'_>, mut add: impl FnMut(&Building, usize, f64)) {
    for (building, building_system) in known.model.buildings.iter().zip(&known.system.buildings) {
        // Bearings and soil have modes of their own.
        if building.base.isolation.is_some() || building.base.foundation.is_some() {
            continue;
        }
        for (index, mode) in building_system.lateral_modes().take(MODES).enumerate() {
            let share = mode
                .effective_mass_ratio_x
                .max(mode.effective_mass_ratio_across);
            if share < SHARE {
                continue;
            }
            add(
                building,
                index + 1,
                building_system.damping_by_coefficients(mode),
            );
        }
    }
}

/// Share of critical damping of the first lateral modes.
pub(super) fn modal_damping(known: &Known<'_>, tally: &mut Tally<'_>) {
    ratios(known, |building, mode, ratio| {
        tally.add(ratio, || {
            let text = format!(
                "{}: lateral mode {mode} has {:.1} % of critical damping",
                quoted(&building.name),
                100.0 * ratio
            );
            (format!("{}, mode {mode}", building.name), text)
        });
    });
}

/// Share of critical damping of the first mode of buildings that yield.
pub(super) fn damping_with_hinges(known: &Known<'_>, tally: &mut Tally<'_>) {
    ratios(known, |building, mode, ratio| {
        if mode > 1 || !structure_yields(building) {
            return;
        }
        tally.add(ratio, || {
            let text = format!(
                "{} yields with {:.1} % of critical damping in its first mode: hysteretic dissipation is additional",
                quoted(&building.name),
                100.0 * ratio
            );
            (building.name.clone(), text)
        });
    });
}
