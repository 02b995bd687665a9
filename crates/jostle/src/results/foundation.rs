//! What a run does to foundations on soil.

use super::summary::{FoundationAcross, FoundationSummary};
use crate::history::{Kind, Owner};
use crate::model::PlanFoundationSprings;
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
    if building.foundation_in_plan.is_some() {
        return in_plan(index, building, outcome);
    }
    let foundation = building.foundation?;
    let owner = Owner::Foundation(index);
    let peaks = outcome.peaks.owned_by(owner);
    Some(FoundationSummary {
        sway_peak_m: peaks.displacement().size(),
        rocking_peak_rad: peaks.turning().displacement().size(),
        period_s: foundation.period,
        period_ratio: foundation.period / foundation.fixed_period,
        damping_ratio: foundation.damping,
        damping_ratio_fixed: foundation.fixed_damping,
        sway_stiffness_n_m: foundation.springs.sway_stiffness,
        sway_damping_n_s_m: foundation.springs.sway_damping,
        rocking_stiffness_n_m_rad: foundation.springs.rocking_stiffness,
        rocking_damping_n_m_s_rad: foundation.springs.rocking_damping,
        dimensionless_frequency: foundation.springs.frequency,
        damped_j: outcome.peaks.work(owner),
        in_plan: None,
    })
}

/// The same of a building with a plan.
fn in_plan(
    index: usize,
    building: &BuildingSystem,
    outcome: &Outcome,
) -> Option<FoundationSummary> {
    let foundation = building.foundation_in_plan?;
    let owner = Owner::Foundation(index);
    let peaks = outcome.peaks.owned_by(owner);
    let rocked = [peaks, peaks.across()].map(|peaks| peaks.of(Kind::Rocking).size());
    let PlanFoundationSprings {
        along,
        across,
        torsion,
    } = foundation.springs;
    let ratios = [0, 1].map(|axis| foundation.periods[axis] / foundation.fixed_periods[axis]);
    Some(FoundationSummary {
        sway_peak_m: peaks.displacement().size(),
        rocking_peak_rad: rocked[0],
        period_s: foundation.periods[0],
        period_ratio: ratios[0],
        damping_ratio: foundation.damping[0],
        damping_ratio_fixed: foundation.fixed_damping[0],
        sway_stiffness_n_m: along.sway_stiffness,
        sway_damping_n_s_m: along.sway_damping,
        rocking_stiffness_n_m_rad: along.rocking_stiffness,
        rocking_damping_n_m_s_rad: along.rocking_damping,
        dimensionless_frequency: along.frequency,
        damped_j: outcome.peaks.work(owner),
        in_plan: Some(FoundationAcross {
            sway_across_peak_m: peaks.across().displacement().size(),
            rocking_across_peak_rad: rocked[1],
            torsion_peak_rad: peaks.turning().displacement().size(),
            period_across_s: foundation.periods[1],
            period_ratio_across: ratios[1],
            damping_ratio_across: foundation.damping[1],
            damping_ratio_across_fixed: foundation.fixed_damping[1],
            sway_across_stiffness_n_m: across.sway_stiffness,
            sway_across_damping_n_s_m: across.sway_damping,
            rocking_across_stiffness_n_m_rad: across.rocking_stiffness,
            rocking_across_damping_n_m_s_rad: across.rocking_damping,
            torsional_stiffness_n_m_rad: torsion[0],
            torsional_damping_n_m_s_rad: torsion[1],
        }),
    })
}

/// Energy dissipated in all dashpots of the soil, and the part of those between foundations, which stand among the links;
/// `None` without foundations \[J\].
pub(super) fn soil_energy(system: &System, outcome: &Outcome) -> Option<[f64; 2]> {
    let mut buildings = system.buildings.iter();
    let founded = buildings
        .any(|building| building.foundation.is_some() || building.foundation_in_plan.is_some());
    let buildings = 0..system.buildings.len();
    let works = buildings.map(|building| outcome.peaks.work(Owner::Foundation(building)));
    let dissipated: f64 = works.sum();
    let links = system.links.iter().enumerate();
    let displacement = &outcome.state.displacement;
    let between = links.skip(system.model_links().len()).map(|(index, link)| {
        let work = outcome.peaks.work(Owner::Link(index));
        work - link.strain(link.shortening(displacement))
    });
    let between = between.sum::<f64>();
    founded.then_some([dissipated + between, between])
}

/// Foundations beyond what the formulas for their springs are meant for, one line each.
#[must_use]
pub fn foundation_warnings(system: &System) -> Vec<String> {
    let mut warnings = Vec::new();
    for building in system.structures() {
        let in_plane = building.foundation;
        let in_plane = in_plane.map(|plane| (plane.foundation, plane.springs.frequency));
        let in_plan = building.foundation_in_plan.map(|foundation| {
            let PlanFoundationSprings { along, across, .. } = foundation.springs;
            (foundation.foundation, along.frequency.max(across.frequency))
        });
        let Some((foundation, frequency)) = in_plane.or(in_plan) else {
            continue;
        };
        // Given matrices follow from no formula.
        if frequency == 0.0 {
            continue;
        }
        let name = &building.name;
        let found = [
            foundation.slenderness(),
            frequency,
            foundation.relative_depth(),
        ];
        let what = [
            "the ratio of its sides",
            "its dimensionless frequency a0",
            "its embedment over half its shorter side",
        ];
        for ((value, most), what) in found.into_iter().zip(MEANT_FOR).zip(what) {
            if value > most {
                warnings.push(format!(
                    "the foundation of \"{name}\" is outside the range of the formulas for its springs and dashpots: {what} is {value:.1}; the formulas hold up to {most}"
                ));
            }
        }
    }
    warnings
}
