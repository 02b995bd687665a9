//! The same run with other contacts: half and twice the stiffness, lower and higher restitution.

use std::sync::Arc;

use jostle::results::contact_sensitivity::{
    BuildingChange, ContactSensitivity, ContactVariant, GapSpread, VariantResult,
};
use jostle::results::summary::{BuildingSummary, FloorSummary};
use jostle::{LawKind, Model, Plan, RunEnd, Summary};

use crate::observer::{Observer, Stage};
use crate::prepared::Prepared;
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

    /// Adds what came out of other contacts to the numbers of the run, or why it is missing.
    pub fn add_contact_sensitivity(&self, summary: &mut Summary) {
        match &self.contact_sensitivity {
            Some(Ok(found)) => {
                summary.contact_sensitivity = Some(found.clone());
                self.prepared.judge(summary);
            }
            Some(Err(problem)) => summary.warnings.push(format!(
                "results cannot be compared with those of other contacts: {problem}"
            )),
            None => {}
        }
    }

    fn other_contacts(
        &self,
        summary: &Summary,
        observer: &mut Observer<'_>,
    ) -> Result<ContactSensitivity, String> {
        let mut others = Vec::new();
        for variant in ContactVariant::USUAL {
            let Some(prepared) = self.prepared.with_contact(variant)? else {
                continue;
            };
            let outcome = prepared.step(prepared.settings(false), |progress| {
                observer(Stage::ContactSensitivity, progress)
            });
            match &outcome.end {
                RunEnd::Completed => {}
                RunEnd::Stopped => return Err("they were interrupted".to_owned()),
                RunEnd::Failed(error) => return Err(format!("{}: {error}", in_words(variant))),
            }
            others.push((variant, prepared.summary(&outcome, None, 0.0)));
        }
        Ok(compare(summary, &others))
    }
}

impl Prepared {
    /// The same with another contact; `None` if it is the same contact.
    fn with_contact(&self, variant: ContactVariant) -> Result<Option<Self>, String> {
        let mut input = (*self.input).clone();
        change(&mut input.model, variant);
        if input.model == self.input.model {
            return Ok(None);
        }
        let refused = |faults: Vec<jostle::ModelFault>| {
            let problems: Vec<String> = faults.iter().map(ToString::to_string).collect();
            format!("{}: {}", in_words(variant), problems.join("; "))
        };
        let system = self.system.with_gaps_of(&input.model).map_err(refused)?;
        let plan = Plan::choose(&system, &self.motion, &input.model.analysis).map_err(refused)?;
        Ok(Some(Self {
            input: Arc::new(input),
            system: Arc::new(system),
            motion: self.motion.clone(),
            plan,
            shapes: None,
        }))
    }
}

/// Lowest restitution of a variant: a body that stays where it hits is another model.
const LEAST_RESTITUTION: f64 = 0.05;

fn change(model: &mut Model, variant: ContactVariant) {
    for gap in &mut model.gaps {
        let law = &mut gap.law;
        law.stiffness *= variant.stiffness_factor;
        if !matches!(law.kind, LawKind::Linear | LawKind::Hertz) {
            let least = law
                .least_restitution()
                .max(LEAST_RESTITUTION.min(law.restitution));
            let changed = law.restitution + variant.restitution_change;
            law.restitution = changed.clamp(least, 1.0_f64.max(law.restitution));
        }
    }
}

fn in_words(variant: ContactVariant) -> String {
    if variant.restitution_change == 0.0 {
        format!(
            "with {} times the contact stiffness",
            variant.stiffness_factor
        )
    } else {
        format!(
            "with a restitution changed by {:+}",
            variant.restitution_change
        )
    }
}

/// Compares runs with other contacts with the run itself.
fn compare(own: &Summary, others: &[(ContactVariant, Summary)]) -> ContactSensitivity {
    let variants = others.iter().map(|(contact, summary)| VariantResult {
        contact: *contact,
        peak_force_n: summary
            .gaps
            .iter()
            .map(|gap| gap.peak_force_n)
            .fold(0.0, f64::max),
        impact_count: summary.gaps.iter().map(|gap| gap.impact_count).sum(),
    });
    let all = || std::iter::once(own).chain(others.iter().map(|(_, summary)| summary));
    let gaps = own.gaps.iter().enumerate().map(|(index, gap)| {
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
    let buildings = own.buildings.iter().enumerate().map(|(index, building)| {
        let others = || others.iter().map(|(_, run)| &run.buildings[index]);
        let change = |of: fn(&FloorSummary) -> f64| {
            others()
                .map(|other| greatest_change(building, other, of))
                .fold(0.0, f64::max)
        };
        BuildingChange {
            name: building.name.clone(),
            displacement: change(|floor| floor.response.displacement_peak_m()),
            storey_drift: change(|floor| floor.response.storey_drift_peak),
            total_acceleration: change(|floor| floor.response.total_acceleration_peak_m_s2),
            storey_shear: change(|floor| floor.response.storey_shear_peak_n),
            overturning_moment: change(|floor| floor.response.overturning_moment_peak_n_m),
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
    own: &BuildingSummary,
    other: &BuildingSummary,
    of: fn(&FloorSummary) -> f64,
) -> f64 {
    let greatest = own.floors.iter().map(of).fold(0.0, f64::max);
    let pairs = own.floors.iter().zip(&other.floors);
    let change = pairs
        .map(|(a, b)| (of(b) - of(a)).abs())
        .fold(0.0, f64::max);
    if greatest > 0.0 {
        change / greatest
    } else {
        0.0
    }
}
