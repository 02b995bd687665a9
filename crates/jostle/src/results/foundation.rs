//! What a run does to foundations on soil.

use super::summary::FoundationSummary;
use crate::history::Owner;
use crate::stepping::Outcome;
use crate::system::{BuildingSystem, System};

/// Greatest ratio of the sides of a foundation, of ωB/V_s and of the embedment to half the shorter side for which the formulas are
/// meant (theory, Eqs. B19 to B21).
const MEANT_FOR: [f64; 3] = [10.0, 2.0, 2.0];

/// Foundation of a building; `None` if it has none.
pub(super) fn foundation_summary(
    index: usize,
    building: &BuildingSystem,
    outcome: &Outcome,
) -> Option<FoundationSummary> {
    let own = building.foundation?;
    let owner = Owner::Foundation(index);
    let peaks = outcome.peaks.owned_by(owner);
    Some(FoundationSummary {
        sway_peak_m: peaks.displacement().size(),
        rocking_peak_rad: peaks.turning().displacement().size(),
        period_s: own.period,
        period_ratio: own.period / own.fixed_period,
        damping_ratio: own.damping,
        damping_ratio_fixed: own.fixed_damping,
        sway_stiffness_n_m: own.springs.sway_stiffness,
        sway_damping_n_s_m: own.springs.sway_damping,
        rocking_stiffness_n_m_rad: own.springs.rocking_stiffness,
        rocking_damping_n_m_s_rad: own.springs.rocking_damping,
        dimensionless_frequency: own.springs.frequency,
        damped_j: outcome.peaks.work(owner),
    })
}

/// Energy dissipated in all dashpots of the soil, and the part of those between foundations, which stand among the links;
/// `None` without foundations \[J\].
pub(super) fn soil_energy(system: &System, outcome: &Outcome) -> Option<[f64; 2]> {
    let founded = system.buildings.iter().any(|own| own.foundation.is_some());
    let buildings = 0..system.buildings.len();
    let own = buildings.map(|building| outcome.peaks.work(Owner::Foundation(building)));
    let own: f64 = own.sum();
    let links = system.links.iter().enumerate();
    let displacement = &outcome.state.displacement;
    let between = links.skip(system.model_links().len()).map(|(index, link)| {
        let work = outcome.peaks.work(Owner::Link(index));
        work - link.strain(link.shortening(displacement))
    });
    let between = between.sum::<f64>();
    founded.then_some([own + between, between])
}

/// Foundations beyond what the formulas for their springs are meant for, one line each.
#[must_use]
pub fn foundation_warnings(system: &System) -> Vec<String> {
    let mut warnings = Vec::new();
    for building in system.structures() {
        let Some(own) = building.foundation else {
            continue;
        };
        // Given matrices follow from no formula.
        if own.springs.frequency == 0.0 {
            continue;
        }
        let name = &building.name;
        let found = [
            own.foundation.slenderness(),
            own.springs.frequency,
            own.foundation.relative_depth(),
        ];
        let what = [
            "the ratio of its sides",
            "its dimensionless frequency a0",
            "its embedment over half its shorter side",
        ];
        for ((value, most), what) in found.into_iter().zip(MEANT_FOR).zip(what) {
            if value > most {
                warnings.push(format!(
                    "the foundation of \"{name}\" is outside the range of the formulas for its springs and dashpots: {what} is {value:.1}, and they are meant for at most {most}"
                ));
            }
        }
    }
    warnings
}
