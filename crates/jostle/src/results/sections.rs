//! Peaks of ends of columns that are made of fibres.

use super::summarise::springs_of;
use super::summary::{FibreAcrossSummary, FibreSummary, SpringSummary, StrainLimitSummary};
use crate::history::{Kind, Owner};
use crate::hysteresis::{HysteresisRule, Side};
use crate::stepping::Outcome;
use crate::structure::FibreSection;
use crate::system::{BuildingSystem, Direction};

/// Ends of columns that are made of fibres, storey by storey.
pub(super) fn sections_of(
    index: usize,
    building: &BuildingSystem,
    outcome: &Outcome,
) -> Vec<FibreSummary> {
    let sections = &building.discretization.sections;
    if sections.is_empty() {
        return Vec::new();
    }
    let springs = springs_of(building, outcome);
    let all = sections.iter().zip(&building.members.sections).enumerate();
    all.map(|(number, (section, forms))| {
        let fibres = &springs[building.discretization.springs_of_section(section)];
        let force = |form: &usize| outcome.members[index][*form];
        let (axial, moment) = (force(&forms[0]), force(&forms[1]));
        let moved = |direction| {
            let owner = Owner::Section {
                building: index,
                section: number,
            };
            let peaks = outcome.peaks.owned_by(owner).to(direction);
            let peak = peaks.of(Kind::Displacement);
            [peak.greatest.value, peak.least.value]
        };
        let ([elongation_max_m, elongation_min_m], [rotation_max_rad, rotation_min_rad]) =
            (moved(Direction::Up), moved(Direction::Turning));
        let across = forms.get(2).map(|form| {
            let [moment_across_max_n_m, moment_across_min_n_m] = force(form);
            let [rotation_across_max_rad, rotation_across_min_rad] = moved(Direction::Across);
            FibreAcrossSummary {
                moment_across_max_n_m,
                moment_across_min_n_m,
                rotation_across_max_rad,
                rotation_across_min_rad,
            }
        });
        let strains = Strains::of(building, section, fibres);
        let limits = section.limits.iter().map(|(limit, strain_limit)| {
            let judged = section.fibres.iter().zip(fibres);
            let judged = judged.filter(|(candidate, _)| candidate.material == limit.material());
            let strains = judged.map(|(_, fibre)| match limit.side() {
                Side::Positive => fibre.deformation_max,
                Side::Negative => fibre.deformation_min,
            });
            let peaks = outcome.peaks.owned_by(Owner::Section {
                building: index,
                section: number,
            });
            let passed = peaks.of(Kind::Passed(*limit)).greatest;
            StrainLimitSummary {
                limit: *limit,
                strain_limit: *strain_limit,
                strain: strains.fold(0.0, f64::max) / section.length,
                passed_s: (passed.value > 0.0).then_some(passed.at),
            }
        });
        let limits = limits.collect();
        FibreSummary {
            name: format!(
                "{}.{}",
                building.name,
                building.discretization.name_of_section(section)
            ),
            axial_max_n: axial[0],
            axial_min_n: axial[1],
            moment_max_n_m: moment[0],
            moment_min_n_m: moment[1],
            rotation_max_rad,
            rotation_min_rad,
            across,
            elongation_max_m,
            elongation_min_m,
            concrete_strain: strains.concrete,
            crushed_s: strains.crushed_s,
            crushed_share: strains.crushed_share,
            steel_strain: strains.steel,
            yielded_s: strains.yielded_s,
            limits,
            dissipated_j: fibres.iter().map(|fibre| fibre.dissipated_j).sum(),
        }
    })
    .collect()
}

/// What fibres went through.
#[derive(Default)]
struct Strains {
    concrete: Option<f64>,
    crushed_s: Option<f64>,
    crushed_share: f64,
    steel: Option<f64>,
    yielded_s: Option<f64>,
}

impl Strains {
    fn of(building: &BuildingSystem, section: &FibreSection, fibres: &[SpringSummary]) -> Self {
        let mut strains = Self::default();
        let (mut crushed, mut concrete) = (0, 0);
        let earlier = |known: Option<f64>, new: Option<f64>| match (known, new) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (known, new) => known.or(new),
        };
        let greater = |known: &mut Option<f64>, strain: f64| {
            *known = Some(known.unwrap_or(0.0).max(strain / section.length));
        };
        for fibre in fibres {
            let rule = building.equations.springs[fibre.index].hysteresis.rule();
            if let HysteresisRule::Concrete(_) = rule {
                concrete += 1;
                crushed += usize::from(fibre.yielded_s.is_some());
                greater(&mut strains.concrete, fibre.deformation_min);
                strains.crushed_s = earlier(strains.crushed_s, fibre.yielded_s);
            } else {
                if !section.is_surface() {
                    greater(&mut strains.steel, fibre.deformation_max);
                }
                strains.yielded_s = earlier(strains.yielded_s, fibre.yielded_s);
            }
        }
        if concrete > 0 {
            strains.crushed_share = crushed as f64 / concrete as f64;
        }
        strains
    }
}
