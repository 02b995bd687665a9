//! Elastic buildings by their modes: exact between the points of a record, coupled at their contacts only (theory,
//! section 14).
//!
//! Between two corners of the load, every mode is known in closed form. Free vibration therefore needs only the
//! steps of the record and of the search for contacts; contacts need shorter ones, over which their forces are
//! parabolas. [`refusals`] rejects unsupported features.

mod basis;
mod closed_contacts;
mod corners;
mod damped;
mod defects;
mod energy;
mod estimate;
mod finish;
mod force_rows;
mod forces;
mod free_steps;
mod friction;
mod least_capacities;
mod links;
mod member_kernels;
mod member_ratios;
mod member_reach;
mod member_steps;
mod members;
mod mode_kernels;
mod monitored_points;
mod passed_kernels;
mod peaks;
mod plan_equations;
mod plan_near;
mod plan_rows;
#[cfg(test)]
mod ports;
mod reduced;
mod response;
mod series;
mod span;
#[cfg(test)]
mod sparing_envelopes;
mod start;
mod step_table;
mod stepper;
mod struck;
mod turning;
mod unit_force;

use std::f64::consts::PI;
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, PoisonError};

use super::outcome::{Accuracy, OnProgress, Outcome, Progress, RunEnd, Settings, StepError};
use super::plan::{Plan, USUAL_TOLERANCE};
use super::refined::{MoreShapes, Refined};
use crate::history::Work;
use crate::model::Integrator;
use crate::motion::GroundMotion;
use crate::state::{ContactPhase, State};
use crate::system::System;
use finish::finish;
pub(super) use links::longest_step as longest_step_of_links;
use reduced::{Rates, Reduced};
use stepper::{Refinement, runner};

/// Reasons why modal stepping does not support the buildings; empty if it does.
#[must_use]
pub fn refusals(system: &System, integrator: Integrator) -> Vec<String> {
    let mut reasons = Vec::new();
    for building in &system.buildings {
        let name = &building.name;
        if !building.equations.springs.is_empty() {
            reasons.push(format!(
                "\"{name}\" can yield or lift off: leave out hinges, braces that yield and infill panels"
            ));
        }
        if building.support.is_some() {
            reasons.push(format!(
                "\"{name}\" stands on bearings, or is a flexible wall"
            ));
        }
        if building.foundation.is_some() {
            reasons.push(format!(
                "\"{name}\" stands on a foundation whose dashpots couple its modes"
            ));
        }
        reasons.extend(links::refusal(building));
        if !building.rest.displacement.is_empty() {
            reasons.push(format!(
                "\"{name}\" starts under its weight: leave out gravity"
            ));
        }
    }
    if let Some(link) = system.links.iter().find(|link| !link.is_linear()) {
        reasons.push(format!(
            "link[{}] is {}: only linear links act on modes; leave out the solver, or make the link linear",
            link.link,
            link.law.name()
        ));
    }
    if integrator != Integrator::default() {
        reasons.push("modes are advanced exactly: leave out the integrator".to_owned());
    }
    reasons
}

/// Impact speed for the time scale of a contact \[m/s\].
const TYPICAL_SPEED: f64 = 0.5;
/// Fraction of the tolerance for flexibilities.
const FLEXIBILITY_SHARE: f64 = 0.004;

/// The shapes of the buildings of a system. They depend on buildings, contacts and their laws, and on the
/// tolerance, but not on gap widths or motions, so runs that differ only in these may share them.
pub struct Reduction {
    reduced: Arc<Reduced>,
    /// Work for their computation.
    work: Work,
    /// Shapes that runs needed besides, for the next run that needs the same.
    enriched: Mutex<Vec<Enriched>>,
}

/// Shapes with more shapes added.
#[derive(Clone)]
struct Enriched {
    to: Arc<Reduced>,
    added: MoreShapes,
    reduced: Arc<Reduced>,
    /// Work for their computation.
    work: Work,
}

/// Largest number of enriched shapes that are kept.
const KEPT: usize = 16;

impl Reduction {
    /// Computes the shapes for the tolerance of the plan.
    ///
    /// # Errors
    /// [`StepError::Unsuited`] if modal stepping does not support the system, [`StepError::NotPositive`] if a
    /// building is a mechanism.
    pub fn new(system: &System, plan: &Plan) -> Result<Self, StepError> {
        let mut reasons = refusals(system, plan.integrator).into_iter();
        if let Some(reason) = reasons.next() {
            return Err(StepError::Unsuited { reason });
        }
        let mut work = Work::default();
        let buildings = 0..system.buildings.len();
        let rates: Vec<Rates> = buildings.map(|index| rates(system, index)).collect();
        let closeness = FLEXIBILITY_SHARE * plan.tolerance().min(USUAL_TOLERANCE);
        match Reduced::new(system, &rates, closeness, plan.vertical, &mut work) {
            Ok(reduced) => Ok(Self {
                reduced: Arc::new(reduced),
                work,
                enriched: Mutex::default(),
            }),
            Err((building, source)) => Err(StepError::NotPositive {
                building: system.buildings[building].name.clone(),
                time: 0.0,
                source,
            }),
        }
    }

    /// The same with all natural modes.
    fn complete(system: &System, plan: &Plan) -> Result<Self, StepError> {
        let usual = Self::new(system, plan)?;
        let all = MoreShapes {
            lacking: vec![vec![0]; system.buildings.len()],
            all: true,
        };
        let Some((reduced, work)) = usual.enrich(system, &usual.reduced, &all) else {
            return Ok(usual);
        };
        Ok(Self {
            reduced,
            work,
            enriched: Mutex::default(),
        })
    }

    /// Shapes with more added, and the work of finding them, whoever found them first.
    fn enrich(
        &self,
        system: &System,
        to: &Arc<Reduced>,
        added: &MoreShapes,
    ) -> Option<(Arc<Reduced>, Work)> {
        {
            let known = self.enriched.lock().unwrap_or_else(PoisonError::into_inner);
            let found = known
                .iter()
                .find(|known| Arc::ptr_eq(&known.to, to) && known.added == *added);
            if let Some(found) = found {
                return Some((Arc::clone(&found.reduced), found.work));
            }
        }
        let mut work = Work::default();
        let reduced = to.enriched(system, &added.lacking, added.all, &mut work);
        let reduced = Arc::new(reduced.ok()?);
        let mut known = self.enriched.lock().unwrap_or_else(PoisonError::into_inner);
        if known.len() < KEPT {
            known.push(Enriched {
                to: Arc::clone(to),
                added: added.clone(),
                reduced: Arc::clone(&reduced),
                work,
            });
        }
        Some((reduced, work))
    }
}

/// Runs a system from rest in modal coordinates, with given shapes: of this system, or of one that differs only in
/// gap widths, and for the same tolerance. The result equals that of [`crate::simulate`], bit by bit.
pub fn simulate(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    settings: Settings,
    reduction: &Reduction,
    mut observer: impl FnMut(Progress) -> ControlFlow<()>,
) -> Outcome {
    simulate_with(
        system,
        motion,
        plan,
        settings,
        reduction,
        None,
        &mut observer,
    )
}

/// Runs a system from displacements and velocities that are given, with all natural modes.
pub(super) fn simulate_from(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    settings: Settings,
    start: &State,
    observer: &mut OnProgress<'_>,
) -> Outcome {
    if let Some(reason) = start::refusal(system, start) {
        return Outcome::not_begun(system, StepError::Unsuited { reason });
    }
    match Reduction::complete(system, plan) {
        Ok(shapes) => simulate_with(
            system,
            motion,
            plan,
            settings,
            &shapes,
            Some(start),
            observer,
        ),
        Err(error) => Outcome::not_begun(system, error),
    }
}

/// [`simulate`] for any observer; `start`: a state other than rest.
pub(super) fn simulate_with(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    settings: Settings,
    reduction: &Reduction,
    start: Option<&State>,
    observer: &mut OnProgress<'_>,
) -> Outcome {
    let tolerance = plan.tolerance();
    let mut refinement = Refinement {
        division: 1,
        work: reduction.work,
    };
    let mut reduced = Arc::clone(&reduction.reduced);
    let mut shapes: Vec<MoreShapes> = Vec::new();
    let mut left = MOST_REPEATS;
    loop {
        let mut run = runner(system, motion, plan, settings, &reduced, refinement);
        if let Some(start) = start {
            run.stepper.begin_from(&run.run, start);
        }
        let (mut outcome, verdict) = finish(run, observer);
        let between = verdict.estimate.between;
        let residual = verdict.estimate.both();
        outcome.work.shapes = reduced.modes() as u64;
        outcome.accuracy = Some(Accuracy {
            tolerance,
            residual,
            doubtful_from: verdict.doubtful_from,
            sensitive_from: None,
        });
        outcome.refined = Refined {
            shapes: shapes.clone(),
            division: refinement.division,
        };
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
            let added = MoreShapes {
                lacking: verdict.lacking,
                all: !shapes.is_empty() && work.repeated_runs > 1,
            };
            let Some((more, found)) = reduction.enrich(system, &reduced, &added) else {
                return outcome;
            };
            work.factorizations += found.factorizations;
            work.solves += found.solves;
            reduced = more;
            shapes.push(added);
        }
        if finer {
            // Errors of cubics fall with the fourth power of the step.
            let finer = (between / (0.25 * tolerance)).sqrt().sqrt().min(8.0);
            refinement.division *= (finer.ceil() as u32).next_power_of_two();
        }
        refinement.work = work;
    }
}

/// Runs a system once with the shapes and steps with which a run of it, or of one with other gap widths, met its
/// tolerance.
pub(super) fn simulate_as(
    refined: &Refined,
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    reduction: &Reduction,
    observer: &mut OnProgress<'_>,
) -> Outcome {
    let mut reduced = Arc::clone(&reduction.reduced);
    for added in &refined.shapes {
        if let Some((more, _)) = reduction.enrich(system, &reduced, added) {
            reduced = more;
        }
    }
    let refinement = Refinement {
        division: refined.division.max(1),
        work: Work::default(),
    };
    let settings = Settings {
        record_interval: None,
        ..Settings::default()
    };
    let run = runner(system, motion, plan, settings, &reduced, refinement);
    finish(run, observer).0
}

/// Largest number of repetitions with more shapes or finer steps.
const MOST_REPEATS: u32 = 4;

/// Whether modal stepping can start from a state.
pub(super) fn is_rest(state: &State) -> bool {
    let mut values = state.displacement.iter().chain(&state.velocity);
    values.all(|value| *value == 0.0)
        && !state
            .contacts
            .iter()
            .any(|phase| matches!(phase, ContactPhase::Closed(_)))
}

/// Characteristic rates of a building.
fn rates(system: &System, building: usize) -> Rates {
    let contacts = system
        .contacts
        .iter()
        .filter(|contact| contact.ports.buildings().contains(&Some(building)));
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
