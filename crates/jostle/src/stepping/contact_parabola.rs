//! Step control for steppers that take a contact force as a parabola over a step (theory, Eq. Q6).

use std::f64::consts::PI;

use super::control::{Observed, next_division};
use super::predicted_force::PredictedForce;
use super::runner::{RunState, Stepper};
use crate::interface::Contact;
use crate::state::{ContactPhase, Episode};

/// Error of the greatest contact force over half a cycle of steps, in what the force at the end of one of them misses its
/// prediction by.
pub(super) const FORCE_ERROR: f64 = PI / 6.0;
/// Steps of a size after an impact.
const STEPS_AFTERWARDS: u32 = 4;

/// A closed contact that would open and close again within the tried step.
pub(super) fn opens_unseen<S: Stepper>(
    run: &RunState<'_>,
    stepper: &S,
    step: f64,
) -> Option<usize> {
    let closed = run.coupling.closed.iter();
    let closed = closed.filter(|closed| closed.friction.is_none());
    let mut unseen = closed.filter(|closed| {
        let trial = &run.trials[closed.contact];
        let parting = stepper.closing_rate(run, closed.contact) < 0.0;
        if !parting || trial.rate <= 0.0 || closed.law.jumps_at_release() {
            return false;
        }
        let curve = run.indentation_curve(stepper, closed.contact, step);
        let face = closed.memory.crushed;
        curve.turning_points().any(|at| curve.value(at) < face)
    });
    unseen.next().map(|closed| closed.contact)
}

/// A closed contact whose force differs from the prediction by more than the greatest force so far: the predicted mean then
/// says nothing.
pub(super) fn misses_prediction(run: &RunState<'_>, predicted: &[PredictedForce]) -> Option<usize> {
    if !run.plan.chooses_contact_steps() {
        return None;
    }
    let closed = run.coupling.closed.iter();
    let closed = closed.filter(|closed| closed.friction.is_none());
    let mut closed = closed.map(|closed| closed.contact);
    closed.find(|&index| {
        let known = match run.phases[index] {
            ContactPhase::Closed(episode) => episode.force.abs(),
            ContactPhase::Open => 0.0,
        };
        let strongest = run.strongest[run.system.contacts[index].gap];
        let missed = (run.trials[index].force - predicted[index].end).abs();
        missed > known.max(strongest)
    })
}

/// Finer steps where the error of this one endangers the tolerance, coarser ones where the grid allows and the error is far
/// below. `missed`: by how much the force at the end, or the friction there, differs from the prediction \[N\].
///
/// Predicted motion leaves out what is of fourth order in h, and so its force at the end, by e; then the step misses h e/24
/// of the impulse. Over the π/(ωh) steps of half a cycle at the present contact stiffness, that is an error of the force of
/// π e/24; four times as much is allowed for, since forces that set in as t^1.5 are off by more.
pub(super) fn division_after_step(
    run: &RunState<'_>,
    index: usize,
    episode: &Episode,
    [start, step]: [f64; 2],
    missed: f64,
) -> u32 {
    let division = run.contact_division[index];
    if episode.since >= start {
        return division;
    }
    let (contact, trial) = (&run.system.contacts[index], &run.trials[index]);
    let response = contact
        .law
        .follow(trial.indentation, trial.rate, &episode.memory);
    let observed = Observed {
        step,
        stiffness: response.by_indentation,
        damping: response.by_rate,
        error: FORCE_ERROR * missed / run.strongest[contact.gap],
        order: 4,
    };
    if run
        .plan
        .is_too_coarse(division, contact, observed.stiffness)
    {
        run.plan.finer(division)
    } else {
        next_division(run.plan, contact, &observed, division, &run.clock)
    }
}

/// After an impact steps grow back to those of free vibration, doubled every few. `open_steps`: steps that every contact
/// has been open.
pub(super) fn relax_divisions(run: &mut RunState<'_>, open_steps: &mut [u32]) {
    for (index, open_steps) in open_steps.iter_mut().enumerate() {
        let division = run.contact_division[index];
        if division == 1 || !run.is_open(index) {
            continue;
        }
        *open_steps += 1;
        if *open_steps >= STEPS_AFTERWARDS && run.clock.is_on_grid(division / 2) {
            *open_steps = 0;
            run.contact_division[index] /= 2;
        }
    }
}

/// The division of a contact that closes at a rate \[m/s\] under an acceleration \[m/s²\], no coarser than the planned one:
/// a slow touch may be followed by a strong push.
pub(super) fn division_at_touch(
    run: &RunState<'_>,
    contact: &Contact,
    [rate, acceleration]: [f64; 2],
    episode: &Episode,
    planned: u32,
) -> u32 {
    let mut division = planned;
    loop {
        let step = run.plan.step / f64::from(division);
        let end = rate + acceleration * step;
        let reached = 0.5 * step * (rate + end);
        let response = contact.law.follow(reached, end, &episode.memory);
        if !run
            .plan
            .is_too_coarse(division, contact, response.by_indentation)
        {
            return division;
        }
        division = run.plan.finer(division);
    }
}
