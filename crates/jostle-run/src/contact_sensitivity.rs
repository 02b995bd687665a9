//! The same run with other contacts: both ends of the advised range of stiffness, lower and higher restitution.

use jostle::judgement::advised_stiffness;
use jostle::results::contact_sensitivity::{
    BuildingChange, ContactSensitivity, ContactVariant, GapSpread, RangeEnd, VariantResult,
};
use jostle::results::summary::{BuildingSummary, FloorSummary};
use jostle::{Model, Summary, System};

use crate::observer::{Observer, Stage};
use crate::run::Ran;

impl Ran {
    /// Runs the model with other contacts, if the run came to its end.
    pub fn run_other_contacts(&mut self, observer: &mut Observer<'_>) {
        if self.prepared.system.contacts.is_empty() {
            self.contact_sensitivity = Some(Err("the model has no gap".to_owned()));
        } else if self.prepared.compares(&self.outcome) {
            let summary = self.prepared.summary(&self.outcome, None, self.wall);
            self.contact_sensitivity = Some(self.other_contacts(&summary, observer));
        }
    }

    fn other_contacts(
        &self,
        summary: &Summary,
        observer: &mut Observer<'_>,
    ) -> Result<ContactSensitivity, String> {
        let mut others = Vec::new();
        for variant in ContactVariant::USUAL {
            let mut model = self.prepared.input.model.clone();
            change(&mut model, &self.prepared.system, variant);
            let words = in_words(variant);
            let assemble = |model: &Model| self.prepared.system.with_gaps_of(model);
            let Some(prepared) = self.prepared.with_model(model, &words, assemble)? else {
                continue;
            };
            let model = &prepared.input.model;
            others.push((
                variant,
                model.gaps.iter().map(|gap| gap.law.stiffness).collect(),
                prepared.run_variant(&words, false, Stage::ContactSensitivity, observer)?,
            ));
        }
        let first_gap = self.prepared.input.model.gaps.first();
        Ok(compare(
            summary,
            first_gap.map_or(1.0, |gap| gap.law.stiffness),
            &others,
        ))
    }
}

/// Lowest restitution of a variant: a body that stays where it hits is another model.
const LEAST_RESTITUTION: f64 = 0.05;

fn change(model: &mut Model, system: &System, variant: ContactVariant) {
    for (index, gap) in model.gaps.iter_mut().enumerate() {
        let range = advised_stiffness(system, index, gap);
        let law = &mut gap.law;
        let stiffness = match variant.stiffness {
            None => law.stiffness,
            Some(RangeEnd::Low) => range.map_or(0.5 * law.stiffness, |range| range.low),
            Some(RangeEnd::High) => range.map_or(2.0 * law.stiffness, |range| range.high),
        };
        *law = law.with_stiffness(stiffness);
        if law.kind.uses_restitution() {
            let least = law
                .least_restitution()
                .max(LEAST_RESTITUTION.min(law.restitution));
            let changed = law.restitution + variant.restitution_change;
            law.restitution = changed.clamp(least, 1.0_f64.max(law.restitution));
        }
    }
}

fn in_words(variant: ContactVariant) -> String {
    match variant.stiffness {
        Some(RangeEnd::Low) => "with the softest advised contact".to_owned(),
        Some(RangeEnd::High) => "with the stiffest advised contact".to_owned(),
        None => format!(
            "with a restitution changed by {:+}",
            variant.restitution_change
        ),
    }
}

/// Compares runs with other contacts with the run itself.
fn compare(
    reference: &Summary,
    stiffness: f64,
    others: &[(ContactVariant, Vec<f64>, Summary)],
) -> ContactSensitivity {
    let variants = others
        .iter()
        .map(|(contact, stiffnesses, summary)| VariantResult {
            contact: *contact,
            stiffness_factor: stiffnesses.first().map_or(1.0, |other| other / stiffness),
            stiffnesses: stiffnesses.clone(),
            peak_force_n: summary
                .gaps
                .iter()
                .map(|gap| gap.peak_force_n)
                .fold(0.0, f64::max),
            impact_count: summary.gaps.iter().map(|gap| gap.impact_count).sum(),
        });
    let all = || std::iter::once(reference).chain(others.iter().map(|(.., summary)| summary));
    let gaps = reference.gaps.iter().enumerate().map(|(index, gap)| {
        let forces = || all().map(|run| run.gaps[index].peak_force_n);
        let counts = || all().map(|run| run.gaps[index].impact_count);
        GapSpread {
            between: gap.between.clone(),
            peak_force_min_n: forces().fold(f64::INFINITY, f64::min),
            peak_force_max_n: forces().fold(0.0, f64::max),
            impact_count_min: counts().min().unwrap_or(0),
            impact_count_max: counts().max().unwrap_or(0),
        }
    });
    let buildings = reference
        .buildings
        .iter()
        .enumerate()
        .map(|(index, building)| {
            let others = || others.iter().map(|(.., run)| &run.buildings[index]);
            let change = |of: fn(&FloorSummary) -> f64| {
                others()
                    .map(|other| greatest_change(building, other, of))
                    .fold(0.0, f64::max)
            };
            let accelerations =
                || all().map(|run| run.buildings[index].response.total_acceleration_peak_m_s2);
            BuildingChange {
                name: building.name.clone(),
                displacement: change(|floor| floor.response.displacement_peak_m()),
                storey_drift: change(|floor| floor.response.storey_drift_peak),
                total_acceleration: change(|floor| floor.response.total_acceleration_peak_m_s2),
                storey_shear: change(|floor| floor.response.storey_shear_peak_n),
                overturning_moment: change(|floor| floor.response.overturning_moment_peak_n_m),
                total_acceleration_min_m_s2: accelerations().fold(f64::INFINITY, f64::min),
                total_acceleration_max_m_s2: accelerations().fold(0.0, f64::max),
            }
        });
    ContactSensitivity {
        variants: variants.collect(),
        gaps: gaps.collect(),
        buildings: buildings.collect(),
    }
}

/// Greatest change at any floor, relative to the greatest of the building.
fn greatest_change(
    building: &BuildingSummary,
    other: &BuildingSummary,
    of: fn(&FloorSummary) -> f64,
) -> f64 {
    let greatest = building.floors.iter().map(of).fold(0.0, f64::max);
    let pairs = building.floors.iter().zip(&other.floors);
    let change = pairs
        .map(|(a, b)| (of(b) - of(a)).abs())
        .fold(0.0, f64::max);
    if greatest > 0.0 {
        change / greatest
    } else {
        0.0
    }
}
