//! A run: from one accepted step to the next, the same for every stepper.

mod contact_events;
mod corners;
mod episodes;
mod link_touches;
mod run_state;
mod stepper;
mod sudden_changes;

use contact_events::Landing;
pub(super) use contact_events::{ContactTrial, TOGETHER};
pub(super) use link_touches::LinkTouch;
pub(super) use run_state::RunState;
pub(super) use stepper::{Jump, Stepper};

use super::clock::{Clock, NextStep};
use super::outcome::{OnProgress, Progress, RunEnd, StepError};
use crate::state::ContactPhase;

/// Most steps between calls of the observer, and most expected work.
const OBSERVED_EVERY: u64 = 256;
const OBSERVED_WORK: f64 = 1e6;
/// How much of a step is tried before it is given up.
const SHORTEST_TRIED: f64 = 1e-6;
/// Events without progress before a run gives up.
const MOST_EVENTS_AT_ONCE: usize = 1000;
/// How often a step is made finer because it does not resolve what a closed contact does.
const MOST_REFINEMENTS: usize = 12;

/// A run under way.
pub(super) struct Runner<'a, S> {
    pub(super) run: RunState<'a>,
    pub(super) stepper: S,
}

impl<S: Stepper> Runner<'_, S> {
    /// To the end of the motion.
    pub(super) fn run_to_end(&mut self, observer: &mut OnProgress<'_>) -> RunEnd {
        let duration = self.run.motion.duration;
        self.stepper.record_start(&mut self.run);
        let mut next_call = 0;
        let every = self.observed_every();
        while duration - self.run.time > 1e-9 * self.run.plan.step {
            if self.run.work.steps >= next_call {
                next_call = self.run.work.steps + every;
                let time = self.run.time;
                if observer(Progress { time, duration }).is_break() {
                    return RunEnd::Stopped;
                }
            }
            let stepped = match self.stepper.take_free_steps(&mut self.run) {
                true => Ok(()),
                false => self.step(),
            };
            if let Err(error) = stepped.and_then(|()| self.check_histories()) {
                return RunEnd::Failed(error);
            }
        }
        RunEnd::Completed
    }

    /// Ends a run whose histories cannot be kept.
    fn check_histories(&self) -> Result<(), StepError> {
        let time = self.run.time;
        let fault = self.stepper.history_fault().map(str::to_owned);
        fault.map_or(Ok(()), |reason| {
            Err(StepError::HistoryNotKept { time, reason })
        })
    }

    /// Steps between calls of the observer: fewer if steps take long.
    fn observed_every(&self) -> u64 {
        let (plan, system) = (&self.run.plan, self.run.system);
        let of_a_step = plan.expected_work(system, plan.step);
        ((OBSERVED_WORK / of_a_step) as u64).clamp(1, OBSERVED_EVERY)
    }

    /// Lists the impacts that the end of the run cuts off.
    pub(super) fn report_unfinished_impacts(&mut self) {
        for index in 0..self.run.phases.len() {
            if let ContactPhase::Closed(episode) = self.run.phases[index] {
                self.run.report_impact(index, &episode, false);
            }
        }
    }

    /// One accepted step, ending on the grid or on the first event in between.
    fn step(&mut self) -> Result<(), StepError> {
        let mut refinements = 0;
        for _ in 0..MOST_EVENTS_AT_ONCE {
            let (slot, next) = self.try_next_step()?;
            let event = self.first_event(next.length);
            let change = self.stepper.sudden_change(&self.run, next.length);
            let change = change.filter(|at| event.is_none_or(|event| *at < event.at));
            let before = change.unwrap_or(event.map_or(1.0, |event| event.at));
            if self.stepper.ends_steps_at_corners(&self.run)
                && let Some(corner) = self.first_corner(next.length, before)
            {
                self.run.work.repeated_steps += 1;
                match self.step_to_corner(corner, &next)? {
                    Landing::Later => return Ok(()),
                    Landing::AtStart => continue,
                }
            }
            match self.end_at_link_touch(&next, before)? {
                Some(Landing::Later) => return Ok(()),
                Some(Landing::AtStart) => continue,
                None => {}
            }
            if let Some(at) = change {
                match self.step_to_sudden_change(at, slot, &next)? {
                    Landing::Later => return Ok(()),
                    Landing::AtStart => continue,
                }
            }
            let Some(event) = event else {
                let coarse = self.stepper.unresolved_contact(&self.run, next.length);
                if let Some(contact) = coarse.filter(|_| refinements < MOST_REFINEMENTS) {
                    refinements += 1;
                    let division = self.stepper.division(&self.run);
                    self.run.contact_division[contact] = self.run.plan.finer(division);
                    self.run.work.repeated_steps += 1;
                    continue;
                }
                return self.accept(slot, next.end);
            };
            self.run.work.repeated_steps += 1;
            if event.at * next.length > self.shortest_step(&event) {
                match self.step_to(event, &next)? {
                    Landing::Later => return Ok(()),
                    Landing::AtStart => continue,
                }
            }
            self.read_contacts();
            self.apply_event(event);
        }
        Err(StepError::Chattering {
            time: self.run.time,
        })
    }

    /// Tries the next step; where contact forces or springs that yield do not converge, half of it, and so on.
    fn try_next_step(&mut self) -> Result<(usize, NextStep), StepError> {
        let mut next = self.next_step();
        let shortest = next.length * SHORTEST_TRIED;
        loop {
            let (run, stepper) = (&mut self.run, &mut self.stepper);
            let tried = stepper
                .prepare(run, &next)
                .and_then(|slot| stepper.try_step(run, slot, next.end).map(|()| slot));
            match tried {
                Err(
                    StepError::ContactDiverged { .. }
                    | StepError::SpringsDiverged { .. }
                    | StepError::NotPositive { .. }
                    | StepError::FallsTooFast { .. },
                ) if next.length > shortest => {
                    self.run.work.halved_steps += 1;
                    let length = 0.5 * next.length;
                    next = NextStep {
                        length,
                        regular: false,
                        end: self.run.clock.after(length),
                    };
                }
                tried => return tried.map(|slot| (slot, next)),
            }
        }
    }

    /// The regular step from here, cut at the end of the motion.
    fn next_step(&self) -> NextStep {
        let next = self.run.clock.next_step(self.stepper.division(&self.run));
        let left = self.run.motion.duration - self.run.time;
        let left = left.min(self.run.until_corner());
        if next.length > left * (1.0 + 1e-9) {
            return NextStep {
                length: left,
                regular: false,
                end: self.run.clock.after(left),
            };
        }
        next
    }

    /// Passes a jump of the ground acceleration of any building.
    fn pass_ground_jump(&mut self) {
        if !self.run.ground_jumps {
            return;
        }
        let time = self.run.time;
        let mut jumped = false;
        for building in 0..self.run.system.buildings.len() {
            let jump = self.run.grounds.jump(building, time);
            if jump != [0.0; 3] {
                self.stepper.change_ground(&self.run, building, jump);
                jumped = true;
            }
        }
        self.run.grounds.pass_jump(time);
        if jumped {
            self.stepper.restart(&self.run, false);
            self.stepper.after_event(&self.run);
        }
    }

    /// Moves on to the end of the tried step.
    fn accept(&mut self, slot: usize, end: Clock) -> Result<(), StepError> {
        let step = self.stepper.length(slot);
        let was_closed = self.run.in_contact();
        let start = self.run.time;
        self.stepper.before_step(&mut self.run, step);
        self.gather_episodes(step);
        self.stepper.advance(&mut self.run, slot)?;
        self.run.clock = end;
        self.run.time = end.time();
        let ground = self.run.ground;
        self.run.ground[0] = ground[1];
        self.run.grounds.accept();
        self.stepper.arrive(&mut self.run, slot);
        self.finish_episodes(step, start);
        self.stepper.relax_divisions(&mut self.run);
        self.run.work.steps += 1;
        self.run.work.contact_steps += u64::from(was_closed);
        self.stepper
            .after_step(&mut self.run, start, step, ground, was_closed)?;
        self.pass_ground_jump();
        Ok(())
    }
}
