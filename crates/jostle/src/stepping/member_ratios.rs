//! Demand over capacity of columns and beams, instant by instant.

use crate::history::{SectionRatio, WorstInstant};
use crate::model::RuleCapacity;
use crate::state::State;
use crate::system::{MemberRating, RatedPart, System};

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
                let forces = section.forms.map(|form| values[form]);
                for (rule, entry) in rating.capacity.rules.iter().zip(entries.by_ref()) {
                    take(entry, rule, rating, state.time, forces, ductility);
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

/// Takes in axial force, shear and moment of a section at an instant.
#[inline]
pub(crate) fn take(
    entry: &mut SectionRatio,
    rule: &RuleCapacity,
    rating: &MemberRating,
    time: f64,
    [axial, shear, moment]: [f64; 3],
    ductility: f64,
) {
    let compression = rating.compression(axial);
    take_shear(entry, rule, time, shear, compression, ductility);
    take_bending(entry, rule, time, moment, compression);
}

/// Takes in the shear of a section under a compression.
#[inline]
pub(crate) fn take_shear(
    entry: &mut SectionRatio,
    rule: &RuleCapacity,
    time: f64,
    shear: f64,
    compression: f64,
    ductility: f64,
) {
    if let Some(capacity) = &rule.shear {
        let ratio = shear.abs() / capacity.at(compression, ductility);
        entry.shear.take(time, shear, ratio, compression);
    }
}

/// Takes in its moment.
#[inline]
pub(crate) fn take_bending(
    entry: &mut SectionRatio,
    rule: &RuleCapacity,
    time: f64,
    moment: f64,
    compression: f64,
) {
    let ratio = rule.bending_ratio(compression, moment);
    entry.bending.take(time, moment, ratio, compression);
}
