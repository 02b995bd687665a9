//! Elastic buildings by their modes: exact between the points of a record, coupled at their contacts only (theory,
//! section 14).
//!
//! Between two instants at which loads bend, every mode is known in closed form. Free flight therefore needs no steps
//! but those of the record and of the search for touches; contacts take shorter ones, over which their forces are
//! straight. What it cannot do is refused by [`refusals`].

mod basis;
mod kernels;
mod meeting;
mod peaks;
mod reduced;
mod response;
mod walk;

use std::f64::consts::PI;
use std::ops::ControlFlow;

use super::integrator::Integrator;
use super::outcome::{Outcome, Progress, Settings, StepError};
use super::plan::{ContactSteps, Plan};
use crate::history::Work;
use crate::motion::GroundMotion;
use crate::state::{ContactPhase, State};
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

/// What keeps a run from being made.
fn unsuited(system: &System, plan: &Plan, state: &State) -> Option<String> {
    let buildings = system.buildings.iter();
    let mut reasons = buildings.flat_map(|building| refusals(building, plan.integrator));
    let moving = || {
        let mut values = state.displacement.iter().chain(&state.velocity);
        values.any(|value| *value != 0.0)
    };
    let closed = |phase: &ContactPhase| matches!(phase, ContactPhase::Closed(_));
    reasons.next().or_else(|| {
        if !system.links.is_empty() {
            Some("links join the buildings, so that none has modes of its own".to_owned())
        } else if moving() || state.contacts.iter().any(closed) {
            Some("modal stepping starts from rest".to_owned())
        } else {
            None
        }
    })
}

/// Impact speed at which a contact is judged \[m/s\].
const TYPICAL_SPEED: f64 = 0.5;
/// Share of the tolerance that flexibilities may be off.
const FLEXIBILITY_SHARE: f64 = 0.1;
/// Tolerance that fixed steps stand for \[–\].
const USUAL_TOLERANCE: f64 = 1e-3;

/// Runs a system in modal coordinates from a state, which must be rest.
pub(super) fn simulate(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    settings: Settings,
    state: &State,
    observer: impl FnMut(Progress) -> ControlFlow<()>,
) -> Outcome {
    if let Some(reason) = unsuited(system, plan, state) {
        return Outcome::not_begun(system, StepError::Unsuited { reason });
    }
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
        Err((building, source)) => Outcome::not_begun(
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
