//! Demand over capacity of columns and beams, instant by instant.

use crate::history::{SectionRatio, WorstInstant};
use crate::model::RuleCapacity;
use crate::state::State;
use crate::structure::MemberSection;
use crate::system::{RatedPart, System};

/// Greatest ratios so far: of every rated member, its sections one after the other, and each by every rule.
#[derive(Debug, Default)]
pub(crate) struct MemberRatios {
    pub(crate) greatest: Vec<SectionRatio>,
    /// Forces of every building when its governing ratio was greatest.
    pub(crate) worst: Vec<WorstInstant>,
}

impl MemberRatios {
    pub(crate) fn new(system: &System) -> Self {
        let ratings = system.ratings.iter();
        let entries = ratings.map(|rating| rating.sections.len() * rating.capacity.rules.len());
        Self {
            greatest: vec![SectionRatio::default(); entries.sum()],
            worst: worst(system),
        }
    }

    /// Takes in a state; `values`: forces of all forms, building by building.
    pub(crate) fn take(&mut self, system: &System, state: &State, values: &[Vec<f64>]) {
        let mut entries = self.greatest.iter_mut();
        for rating in &system.ratings {
            let building = &system.buildings[rating.building];
            let ductility = if rating.degrades() {
                rating.ductility(building, &state.springs[building.spring_range()])
            } else {
                1.0
            };
            let values = &values[rating.building];
            for section in &rating.sections {
                let forces = RatedForces::of(section, |form| values[form]);
                let compression = rating.compression(forces.axial);
                for (rule, entry) in rating.capacity.rules.iter().zip(entries.by_ref()) {
                    take_shear(
                        entry,
                        rule,
                        state.time,
                        forces.shears,
                        compression,
                        ductility,
                    );
                    take_bending(entry, rule, state.time, forces.moments, compression);
                }
            }
        }
        let mut first = 0;
        for rating in &system.ratings {
            let rules = rating.capacity.rules.len();
            let count = rating.sections.len() * rules;
            let governing = self.greatest[first..first + count]
                .iter()
                .step_by(rules.max(1));
            let ratio = governing.map(SectionRatio::greatest).fold(0.0, f64::max);
            let worst = &mut self.worst[rating.building];
            if matches!(rating.part, RatedPart::Member(_)) && ratio > worst.ratio {
                (worst.ratio, worst.time) = (ratio, state.time);
                worst.forces.copy_from_slice(&values[rating.building]);
            }
            first += count;
        }
    }
}

fn worst(system: &System) -> Vec<WorstInstant> {
    let buildings = system.buildings.iter().enumerate();
    buildings
        .map(|(index, building)| {
            let rated = system.ratings.iter().any(|rating| rating.building == index);
            let forms = if rated {
                building.members.forms.len()
            } else {
                0
            };
            WorstInstant {
                forces: vec![0.0; forms],
                ..WorstInstant::default()
            }
        })
        .collect()
}

/// Forces of a section that are compared with capacities; none across where a member bends in one plane.
#[derive(Clone, Copy, Default)]
pub(crate) struct RatedForces {
    /// Positive in tension.
    pub(crate) axial: f64,
    pub(crate) shears: [f64; 2],
    pub(crate) moments: [f64; 2],
}

impl RatedForces {
    /// Of a section whose forces `value` returns by index.
    #[inline]
    pub(crate) fn of(section: &MemberSection, value: impl Fn(usize) -> f64) -> Self {
        let [axial, shear, moment] = section.forms.map(&value);
        let across = section.across.map(|[shear, moment, _]| [shear, moment]);
        let [shear_across, moment_across] = across.map_or([0.0; 2], |forms| forms.map(&value));
        Self {
            axial,
            shears: [shear, shear_across],
            moments: [moment, moment_across],
        }
    }
}

/// Takes in the shears of a section under a compression.
#[inline]
pub(crate) fn take_shear(
    entry: &mut SectionRatio,
    rule: &RuleCapacity,
    time: f64,
    shears: [f64; 2],
    compression: f64,
    ductility: f64,
) {
    if rule.shear.is_some() {
        let ratio = rule.shear_ratio(compression, shears, ductility);
        entry.shear.take(time, shears, ratio, compression);
    }
}

/// Takes in its moments.
#[inline]
pub(crate) fn take_bending(
    entry: &mut SectionRatio,
    rule: &RuleCapacity,
    time: f64,
    moments: [f64; 2],
    compression: f64,
) {
    let ratio = rule.bending_ratio(compression, moments);
    entry.bending.take(time, moments, ratio, compression);
}
