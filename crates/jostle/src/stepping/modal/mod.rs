//! Elastic buildings by their modes: exact between the points of a record, coupled at their contacts only (theory,
//! section 14).
//!
//! Between two instants at which loads bend, every mode is known in closed form. Free flight therefore needs no steps
//! but those of the record and of the search for touches; contacts take shorter ones, over which their forces are
//! straight. What it cannot do is refused by [`refusals`].

mod basis;
mod meeting;
mod peaks;
mod reduced;
mod response;
mod walk;

use std::f64::consts::PI;
use std::ops::ControlFlow;

use super::integrator::Integrator;
use super::outcome::{Outcome, Progress, RunEnd, Settings, StepError};
use super::plan::{ContactSteps, Plan};
use crate::history::{Energy, Work};
use crate::motion::GroundMotion;
use crate::state::State;
use crate::system::{BuildingSystem, System};
use reduced::{Rates, Reduced};
use walk::Walk;

/// Why a building cannot be stepped by its modes; empty when it can.
#[must_use]
pub fn refusals(building: &BuildingSystem, integrator: Integrator) -> Vec<String> {
    let mut reasons = Vec::new();
    let name = &building.name;
    if !building.equations.springs.is_empty() {
        reasons.push(format!("\"{name}\" can yield: leave out its hinges"));
    }
    if !building.equations.plain {
        reasons.push(format!(
            "\"{name}\" leans on P-Delta or stands on springs, which Rayleigh damping does not act on: its modes do not damp alone"
        ));
    }
    if !building.rest.is_empty() {
        reasons.push(format!(
            "\"{name}\" starts under its weight: leave out gravity"
        ));
    }
    if integrator != Integrator::default() {
        reasons.push("modes are advanced exactly: leave out the integrator".to_owned());
    }
    reasons
}

/// Impact speed at which a contact is judged \[m/s\].
const TYPICAL_SPEED: f64 = 0.5;
/// Share of the tolerance that flexibilities may be off.
const FLEXIBILITY_SHARE: f64 = 0.1;
/// Tolerance that fixed steps stand for \[–\].
const USUAL_TOLERANCE: f64 = 1e-3;

/// Runs a system from rest in modal coordinates.
pub(super) fn simulate(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    settings: Settings,
    observer: impl FnMut(Progress) -> ControlFlow<()>,
) -> Outcome {
    let mut work = Work::default();
    // Half of what a run may be off is for contacts.
    let tolerance = match plan.contact_steps {
        ContactSteps::PerImpact { tolerance, .. } => 2.0 * tolerance,
        ContactSteps::Fixed(_) => USUAL_TOLERANCE,
    };
    let buildings = 0..system.buildings.len();
    let rates: Vec<Rates> = buildings.map(|index| rates(system, index)).collect();
    match Reduced::of(system, &rates, FLEXIBILITY_SHARE * tolerance, &mut work) {
        Ok(reduced) => Walk::new(system, motion, plan, settings, reduced, work).run(observer),
        Err((building, source)) => not_begun(
            system,
            StepError::NotPositive {
                building: system.buildings[building].name.clone(),
                time: 0.0,
                source,
            },
        ),
    }
}

/// Rates of what happens to a building.
fn rates(system: &System, building: usize) -> Rates {
    let contacts = system
        .contacts
        .iter()
        .filter(|contact| contact.faces.buildings().contains(&Some(building)));
    let durations = contacts
        .filter(|contact| contact.law.stiffness() > 0.0)
        .map(|contact| {
            contact
                .law
                .elastic_duration(contact.effective_mass(), TYPICAL_SPEED)
        });
    let shortest = durations.fold(f64::INFINITY, f64::min);
    let modes = system.buildings[building].lateral_modes().take(3);
    let swaying = modes
        .map(|mode| mode.circular_frequency)
        .fold(0.0, f64::max);
    Rates {
        pushed: (PI / shortest).max(swaying),
        swaying,
    }
}

/// What is left behind by a run that could not begin.
fn not_begun(system: &System, error: StepError) -> Outcome {
    Outcome {
        history: None,
        impacts: Vec::new(),
        floors: system
            .buildings
            .iter()
            .map(|b| vec![Default::default(); b.floors.len()])
            .collect(),
        closing: vec![Default::default(); system.contacts.len()],
        base_shear: vec![0.0; system.buildings.len()],
        spring_events: Vec::new(),
        springs: Vec::new(),
        links: Vec::new(),
        spring_history: None,
        energy: Energy::default(),
        work: Work::default(),
        contact_step: None,
        state: State::at_rest(system, 0.0),
        end: RunEnd::Failed(error),
    }
}
