//! Elastic buildings by their modes: exact between the points of a record, coupled at their contacts only (theory,
//! section 14).
//!
//! Between two instants at which loads bend, every mode is known in closed form. Free flight therefore needs no steps
//! but those of the record and of the search for touches; contacts take shorter ones, over which their forces are
//! parabolas. What it cannot do is refused by [`refusals`].

mod basis;
mod corners;
mod damped;
mod defects;
mod estimate;
mod flight;
mod forces;
mod kernels;
mod meeting;
mod members;
mod peaks;
mod pushes;
mod reduced;
mod response;
mod series;
mod span;
mod walk;

use std::f64::consts::PI;
use std::ops::ControlFlow;

use super::outcome::{Accuracy, Outcome, Progress, RunEnd, Settings, StepError};
use super::plan::{Plan, USUAL_TOLERANCE};
use crate::history::Work;
use crate::model::Integrator;
use crate::motion::GroundMotion;
use crate::state::{ContactPhase, State};
use crate::system::System;
use reduced::{Rates, Reduced};
use walk::{Refinement, Walk};

/// Why buildings cannot be stepped by their modes; empty when they can.
#[must_use]
pub fn refusals(system: &System, integrator: Integrator) -> Vec<String> {
    let mut reasons = Vec::new();
    if !system.links.is_empty() {
        reasons.push("links join the buildings, so that none has modes of its own".to_owned());
    }
    for building in &system.buildings {
        let name = &building.name;
        if !building.equations.springs.is_empty() {
            reasons.push(format!("\"{name}\" can yield: leave out its hinges"));
        }
        if !building.equations.plain {
            reasons.push(format!(
                "\"{name}\" leans on P-Delta or stands on springs, which Rayleigh damping does not act on: its modes do not damp alone"
            ));
        }
        if !building.rest.displacement.is_empty() {
            reasons.push(format!(
                "\"{name}\" starts under its weight: leave out gravity"
            ));
        }
    }
    if integrator != Integrator::default() {
        reasons.push("modes are advanced exactly: leave out the integrator".to_owned());
    }
    reasons
}

/// Impact speed at which a contact is judged \[m/s\].
const TYPICAL_SPEED: f64 = 0.5;
/// Share of the tolerance that flexibilities may be off.
const FLEXIBILITY_SHARE: f64 = 0.02;

/// The shapes that stand for the buildings of a system. They depend on buildings, on where these meet and by which law,
/// and on the tolerance; not on the widths of gaps nor on motions, so that runs of many of these may share them.
pub struct Reduction {
    reduced: Reduced,
    /// What it took.
    work: Work,
}

impl Reduction {
    /// Finds the shapes, by what the plan tolerates.
    ///
    /// # Errors
    /// [`StepError::Unsuited`] when modes cannot step the system, [`StepError::NotPositive`] when a building can move
    /// without resistance.
    pub fn of(system: &System, plan: &Plan) -> Result<Self, StepError> {
        let mut reasons = refusals(system, plan.integrator).into_iter();
        if let Some(reason) = reasons.next() {
            return Err(StepError::Unsuited { reason });
        }
        let mut work = Work::default();
        let buildings = 0..system.buildings.len();
        let rates: Vec<Rates> = buildings.map(|index| rates(system, index)).collect();
        let closeness = FLEXIBILITY_SHARE * plan.tolerance().min(USUAL_TOLERANCE);
        match Reduced::of(system, &rates, closeness, &mut work) {
            Ok(reduced) => Ok(Self { reduced, work }),
            Err((building, source)) => Err(StepError::NotPositive {
                building: system.buildings[building].name.clone(),
                time: 0.0,
                source,
            }),
        }
    }
}

/// Runs a system from rest in modal coordinates, with shapes found before: of this system, or of one that differs in
/// the widths of its gaps only, and for the same tolerance. The answer is that of [`crate::simulate`], bit for bit.
pub fn simulate(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    settings: Settings,
    reduction: &Reduction,
    mut observer: impl FnMut(Progress) -> ControlFlow<()>,
) -> Outcome {
    let tolerance = plan.tolerance();
    let mut refinement = Refinement {
        tolerance,
        division: 1,
        work: reduction.work,
    };
    let mut enriched: Option<Reduced> = None;
    let mut left = MOST_REPEATS;
    loop {
        let reduced = enriched.as_ref().unwrap_or(&reduction.reduced);
        let run = Walk::new(system, motion, plan, settings, reduced, refinement);
        let (mut outcome, verdict) = run.run(&mut observer);
        let between = verdict.estimate.between;
        let residual = verdict.estimate.both();
        outcome.work.shapes = reduced.modes() as u64;
        outcome.accuracy = Some(Accuracy {
            tolerance,
            residual,
            doubtful_from: verdict.doubtful_from,
            sensitive_from: None,
        });
        if outcome.end != RunEnd::Completed {
            return outcome;
        }
        let finer = between > 0.5 * tolerance && plan.chooses_contact_steps();
        let more = verdict.lacking.iter().any(|modes| !modes.is_empty());
        if residual <= tolerance || left == 0 || !(finer || more) {
            return outcome;
        }
        left -= 1;
        let mut work = Work {
            factorizations: refinement.work.factorizations,
            solves: refinement.work.solves,
            repeated_runs: refinement.work.repeated_runs + 1,
            ..Work::default()
        };
        if more {
            // If one enrichment is not enough, all natural modes are taken.
            let all = enriched.is_some() && work.repeated_runs > 1;
            match reduced.enriched(system, &verdict.lacking, all, &mut work) {
                Ok(more) => enriched = Some(more),
                Err(_) => return outcome,
            }
        }
        if finer {
            // Errors of cubics fall with the fourth power of the step.
            let finer = (between / (0.25 * tolerance)).sqrt().sqrt().min(8.0);
            refinement.division *= (finer.ceil() as u32).next_power_of_two();
        }
        refinement.work = work;
    }
}

/// Runs repeated with more shapes or finer steps before the errors that are left are reported.
const MOST_REPEATS: u32 = 4;

/// Whether a state is one that modal stepping can start from.
pub(super) fn is_rest(state: &State) -> bool {
    let mut values = state.displacement.iter().chain(&state.velocity);
    values.all(|value| *value == 0.0)
        && !state
            .contacts
            .iter()
            .any(|phase| matches!(phase, ContactPhase::Closed(_)))
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
