//! From the outcome of a run to the numbers of `summary.json`.

use crate::contact::RestitutionIs;
use crate::history::Impact;
use crate::model::{Gap, Model};
use crate::motion::GroundMotion;
use crate::stepping::{Outcome, Plan, RunEnd};
use crate::summary::{
    BuildingSummary, ContactSummary, EnergySummary, FloorSummary, GapSummary, HingeSummary,
    ImpactSummary, MotionSummary, Summary, WorkSummary,
};
use crate::system::{BuildingSystem, System};

/// What a summary is made of.
#[derive(Clone, Copy, Debug)]
pub struct Run<'a> {
    /// What was asked for.
    pub model: &'a Model,
    /// Assembled.
    pub system: &'a System,
    /// Ground motion.
    pub motion: &'a GroundMotion,
    /// Steps.
    pub plan: &'a Plan,
    /// What came out.
    pub outcome: &'a Outcome,
    /// The same buildings passing through each other, if that run was made.
    pub without_contact: Option<&'a Outcome>,
    /// Wall time of the stepping \[s\].
    pub wall: f64,
}

impl Summary {
    /// Sums up a run.
    #[must_use]
    pub fn of(run: &Run) -> Self {
        let Run {
            model,
            system,
            motion,
            outcome,
            ..
        } = *run;
        let buildings = (0..system.buildings.len())
            .map(|index| building_summary(index, system, outcome))
            .collect();
        let gaps = model
            .gaps
            .iter()
            .enumerate()
            .map(|(index, gap)| gap_summary(index, gap, run))
            .collect();
        Self {
            title: model.title.clone(),
            jostle: env!("CARGO_PKG_VERSION").to_owned(),
            motion: MotionSummary {
                name: motion.name.clone(),
                points: motion.points(),
                step_s: motion.step().unwrap_or(0.0),
                pga_m_s2: motion.peak(),
                scale: motion.scale,
                duration_s: motion.duration,
            },
            buildings,
            gaps,
            energy: energy_summary(outcome),
            work: work_summary(run),
            ended_early: match &outcome.end {
                RunEnd::Completed => None,
                RunEnd::Stopped => Some(format!(
                    "stopped at t = {:.3} s of {:.3} s",
                    outcome.state.time, motion.duration
                )),
                RunEnd::Failed(error) => Some(error.to_string()),
            },
            warnings: warnings(run),
            notes: notes(run),
        }
    }
}

fn building_summary(index: usize, system: &System, outcome: &Outcome) -> BuildingSummary {
    let building = &system.buildings[index];
    let floors = building
        .floors
        .iter()
        .zip(&outcome.floors[index])
        .enumerate()
        .map(|(k, (floor, peaks))| FloorSummary {
            floor: k + 1,
            height_m: floor.height,
            displacement_max_m: peaks.displacement_max.value,
            displacement_max_at_s: peaks.displacement_max.at,
            displacement_min_m: peaks.displacement_min.value,
            displacement_min_at_s: peaks.displacement_min.at,
            total_acceleration_peak_m_s2: peaks.total_acceleration,
            storey_drift_peak: peaks.storey_drift,
        });
    BuildingSummary {
        name: building.name.clone(),
        mass_kg: building.equations.total_mass(),
        periods_s: building
            .lateral_modes()
            .map(crate::modal::Mode::period)
            .collect(),
        rayleigh_alpha_per_s: building.equations.alpha,
        rayleigh_beta_s: building.equations.beta,
        floors: floors.collect(),
        base_shear_peak_n: outcome.base_shear[index],
        residual_roof_displacement_m: roof_displacement(building, outcome),
        hinges: HingeSummary::default(),
    }
}

fn roof_displacement(building: &BuildingSystem, outcome: &Outcome) -> f64 {
    building
        .floors
        .last()
        .map_or(0.0, |roof| outcome.state.displacement[roof.dof])
}

fn gap_summary(index: usize, gap: &Gap, run: &Run) -> GapSummary {
    let Run {
        system, outcome, ..
    } = *run;
    let own: Vec<usize> = (0..system.contacts.len())
        .filter(|&contact| system.contacts[contact].gap == index)
        .collect();
    let contacts: Vec<ContactSummary> = own
        .iter()
        .map(|&contact| contact_summary(contact, system, outcome))
        .collect();
    let impacts = contacts.iter().flat_map(|contact| &contact.impacts);
    GapSummary {
        between: [gap.left, gap.left + 1].map(|building| system.buildings[building].name.clone()),
        width_m: gap.width,
        law: gap.law.kind.name().to_owned(),
        free_restitution: gap.law.free_restitution(),
        impact_count: contacts.iter().map(|contact| contact.impact_count).sum(),
        peak_force_n: contacts
            .iter()
            .map(|contact| contact.peak_force_n)
            .fold(0.0, f64::max),
        first_impact_s: impacts.map(|impact| impact.start_s).min_by(f64::total_cmp),
        closing_without_contact_m: run.without_contact.map(|outcome| {
            own.iter()
                .map(|&contact| outcome.closing[contact].value)
                .fold(0.0, f64::max)
        }),
        contacts,
    }
}

fn contact_summary(index: usize, system: &System, outcome: &Outcome) -> ContactSummary {
    let mut impacts: Vec<&Impact> = outcome
        .impacts
        .iter()
        .filter(|impact| impact.contact == index)
        .collect();
    impacts.sort_by(|a, b| a.start.total_cmp(&b.start));
    let strongest = impacts
        .iter()
        .max_by(|a, b| a.peak_force.total_cmp(&b.peak_force));
    let contact = &system.contacts[index];
    ContactSummary {
        floors: contact.floors,
        height_m: contact.height,
        closing_peak_m: outcome.closing[index].value,
        closing_peak_at_s: outcome.closing[index].at,
        impact_count: impacts.len(),
        peak_force_n: strongest.map_or(0.0, |impact| impact.peak_force),
        peak_force_at_s: strongest.map(|impact| impact.peak_force_at),
        // An empty sum would be −0.
        impulse_n_s: impacts.iter().fold(0.0, |sum, impact| sum + impact.impulse),
        impacts: impacts.into_iter().map(ImpactSummary::from).collect(),
    }
}

impl From<&Impact> for ImpactSummary {
    fn from(impact: &Impact) -> Self {
        Self {
            start_s: impact.start,
            end_s: impact.end,
            peak_force_n: impact.peak_force,
            peak_force_at_s: impact.peak_force_at,
            peak_indentation_m: impact.peak_indentation,
            impact_speed_m_s: impact.impact_speed,
            separation_speed_m_s: impact.separation_speed,
            realised_restitution: impact.realised_restitution(),
            impulse_n_s: impact.impulse,
            dissipated_j: impact.dissipated,
        }
    }
}

fn energy_summary(outcome: &Outcome) -> EnergySummary {
    let energy = &outcome.energy;
    EnergySummary {
        input_j: energy.input,
        kinetic_j: energy.kinetic,
        strain_j: energy.strain,
        damped_j: energy.damped,
        hysteretic_j: energy.hysteretic,
        contact_j: energy.contact,
        imbalance: energy.imbalance(),
        worst_imbalance: energy.worst_imbalance,
    }
}

fn work_summary(run: &Run) -> WorkSummary {
    let work = &run.outcome.work;
    WorkSummary {
        steps: work.steps,
        contact_steps: work.contact_steps,
        repeated_steps: work.repeated_steps,
        factorizations: work.factorizations,
        solves: work.solves,
        iterations: work.iterations,
        step_s: run.plan.step,
        contact_step_s: run.outcome.contact_step,
        wall_s: run.wall,
    }
}

/// Reasons not to trust the numbers.
fn warnings(run: &Run) -> Vec<String> {
    let tolerance = run.model.analysis.energy_tolerance;
    let worst = run.outcome.energy.worst_imbalance;
    if worst <= tolerance {
        return Vec::new();
    }
    vec![format!(
        "the energies do not balance: {worst:.1e} of the energy is unaccounted for (tolerance {tolerance:.1e}); do not trust this run"
    )]
}

/// Things worth knowing about the numbers.
fn notes(run: &Run) -> Vec<String> {
    let mut notes = Vec::new();
    for law in run.model.gaps.iter().map(|gap| &gap.law) {
        let (asked, free) = (law.restitution, law.free_restitution());
        let published = law.restitution_is == RestitutionIs::Input && law.kind.is_dissipative();
        if published && (free - asked).abs() > 0.005 {
            notes.push(format!(
                "{} with restitution {asked} lets free masses rebound with {free:.3}; restitution_is = \"realised\" makes it {asked}",
                law.kind.name()
            ));
        }
    }
    notes.dedup();
    notes
}
