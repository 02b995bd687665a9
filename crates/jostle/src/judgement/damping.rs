//! A4: damping of the first modes.

use super::{Known, Tally, quoted};

/// Modes that are looked at.
const MODES: usize = 5;
/// Least share of the mass that a mode carries, along x or across: what higher modes do hardly shows \[–\].
const SHARE: f64 = 0.05;

/// Share of critical damping of the first lateral modes, by the damping of the building alone: dashpots of bases, soil, bearings
/// and links are meant to damp more.
pub(super) fn modal_damping(known: &Known<'_>, tally: &mut Tally<'_>) {
    for (building, own) in known.model.buildings.iter().zip(&known.system.buildings) {
        // Bearings and soil have modes of their own.
        if building.base.isolation.is_some() || building.base.foundation.is_some() {
            continue;
        }
        let equations = &own.equations;
        for (index, mode) in own.lateral_modes().take(MODES).enumerate() {
            let share = mode
                .effective_mass_ratio_x
                .max(mode.effective_mass_ratio_across);
            if share < SHARE {
                continue;
            }
            let omega = mode.circular_frequency;
            let by_rayleigh = 0.5 * (equations.alpha / omega + equations.beta * omega);
            let ratio = own.modal_damping.unwrap_or(by_rayleigh);
            tally.add(ratio, || {
                let text = format!(
                    "{}: lateral mode {} has {:.1} % of critical damping",
                    quoted(&building.name),
                    index + 1,
                    100.0 * ratio
                );
                (format!("{}, mode {}", building.name, index + 1), text)
            });
        }
    }
}
