//! Stepping in modal coordinates.

use super::closed_contacts::STRUCK_STEPS;
use super::damped::Rules;
use super::energy::Audit;
use super::estimate::Reached;
use super::free_steps::FreeSteps;
use super::links::{LinkMotion, longest_step};
use super::members::Instant;
use super::peaks::{Peaks, Taken, Watched};
use super::plan_equations::PlanEquations;
use super::reduced::Reduced;
use super::step_table::StepTable;
use super::struck::{StruckStep, WithinStep};
use super::turning::{Loads, StepMotion};
use crate::history::{Energy, Work};
use crate::motion::{Ground, GroundMotion};
use crate::state::{ContactPhase, Episode};
use crate::stepping::clock::{Clock, NextStep};
use crate::stepping::contact_parabola;
use crate::stepping::events::Cubic;
use crate::stepping::force_equations::ForceEquations;
use crate::stepping::gap_forces::StepForce;
use crate::stepping::near_contacts::{self, NearContacts, Touch};
use crate::stepping::outcome::{Settings, StepError};
use crate::stepping::plan::Plan;
use crate::stepping::predicted_force::{AHEAD, PredictedForce};
use crate::stepping::runner::{ContactTrial, Jump, RunState, Runner, Stepper};
use crate::stepping::step_friction::FrictionPath;
use crate::system::{RunGrounds, System};

/// Modal coordinates of all buildings, and how their steps are taken.
pub(super) struct ModalStepper<'a> {
    pub(super) reduced: &'a Reduced,
    /// The first serves steps off the grid, the others one division of the free-vibration step each.
    pub(super) tables: Vec<StepTable>,
    divisions: Vec<u32>,
    /// Division of free vibration, so that histories have their rows.
    pub(super) least_division: u32,
    /// Steps taken for each one that the tolerance needs \[–\].
    pub(super) rows_per_step: usize,
    pub(super) free_steps: FreeSteps,
    rules: Rules,
    /// Modal displacement, velocity and load now, and at the end of the tried step.
    pub(super) q: [Vec<f64>; 2],
    pub(super) v: [Vec<f64>; 2],
    pub(super) p: [Vec<f64>; 2],
    /// Bend of the modal load over the tried step: contact forces are parabolas.
    pub(super) bend: Vec<f64>,
    /// ∫q of the accepted step, then anything else that needs a list of modes.
    pub(super) scratch: Vec<f64>,
    /// ∫τq of the accepted step, where a contact is closed.
    pub(super) moment: Vec<f64>,
    /// Monitored displacements and velocities, now and at the end of the tried step. Monitored accelerations, and jerks
    /// without the load term, now and a step ago.
    pub(super) u: [Vec<f64>; 2],
    pub(super) rate: [Vec<f64>; 2],
    pub(super) acceleration: [Vec<f64>; 2],
    pub(super) unloaded_jerk: [Vec<f64>; 2],
    pub(super) jerk: Vec<f64>,
    /// Steps that a contact has been open, while its division still counts.
    pub(super) open_steps: Vec<u32>,
    pub(super) equations: ForceEquations,
    pub(super) plan_equations: PlanEquations,
    /// Forces of closed contacts over the tried step as they could be predicted.
    pub(super) predicted: Vec<PredictedForce>,
    /// Friction over the tried step as it could be predicted.
    pub(super) friction_paths: Vec<FrictionPath>,
    pub(super) links: LinkMotion,
    pub(super) energy: Audit,
    pub(super) peaks: Peaks,
    pub(super) reached: Reached,
    /// Whether errors are looked at after this step.
    checks_errors: bool,
    /// Forces of storeys where errors are looked at \[N, N·m\].
    pub(super) checked_forces: Vec<f64>,
    /// Steps left in which accelerations may still follow a jump of velocities, unlike a cubic.
    pub(super) struck: u32,
    within: WithinStep,
    pub(super) near: NearContacts,
}

/// How much finer a run is than planned, and the work done before it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Refinement {
    /// Division of free steps.
    pub(super) division: u32,
    pub(super) work: Work,
}

/// Into how many parts free steps are divided so that the forces of links follow a cubic over each.
fn division_for_links(system: &System, plan: &Plan) -> u32 {
    let longest = longest_step(system) * libm::pow(plan.tolerance() / 1e-3, 0.25);
    let parts = (plan.step / longest - 1e-9).ceil().clamp(1.0, MOST_PARTS);
    (parts as u32).next_power_of_two()
}

/// Most parts of a free step.
const MOST_PARTS: f64 = 65536.0;

/// A run in modal coordinates, about to begin.
pub(super) fn runner<'a>(
    system: &'a System,
    motion: &'a GroundMotion,
    plan: &'a Plan,
    settings: Settings,
    reduced: &'a Reduced,
    refinement: Refinement,
) -> Runner<'a, ModalStepper<'a>> {
    let mut run = RunState::new(system, motion, plan, settings);
    run.work = refinement.work;
    let stepper = ModalStepper::new(&run, settings, reduced, refinement.division);
    Runner { run, stepper }
}

impl<'a> ModalStepper<'a> {
    fn new(run: &RunState<'a>, settings: Settings, reduced: &'a Reduced, division: u32) -> Self {
        let (system, motion, plan) = (run.system, run.motion, run.plan);
        let grounds = run.grounds_at(0);
        let division = division * division_for_links(system, plan);
        let (modes, watched) = (reduced.modes(), reduced.listed() + run.grounds.joints());
        let pair = |n: usize| [vec![0.0; n], vec![0.0; n]];
        let mut p = pair(modes);
        reduced.set_loads_of(grounds, &mut p[0]);
        let contacts = system.contacts.len();
        let rows = settings
            .record_interval
            .map_or(0.0, |interval| motion.duration / plan.step.max(interval));
        let mut peaks = Peaks::new(system, &run.grounds, reduced, settings, plan.tolerance());
        peaks.reserve((1.2 * rows + 100.0).min(1e6) as usize);
        let mut acceleration = pair(watched);
        // At rest on moving ground buildings stay behind.
        for (index, building) in reduced.buildings.iter().enumerate() {
            let ground = grounds.of(index).map(|value| -value);
            for place in building.watched.clone() {
                acceleration[0][place] = peaks.driven_by(place, ground);
            }
        }
        // In space the grounds and what stays behind cancel.
        if reduced.plan.is_none() {
            for joint in 0..run.grounds.joints() {
                let moved = run.grounds.closing(joint, 0)[2];
                reduced.add_grounds(joint, moved, &mut acceleration[0]);
            }
        }
        Self {
            free_steps: FreeSteps::new(reduced),
            tables: vec![StepTable::default()],
            divisions: vec![0],
            least_division: division.max(settings.rows_per_step(plan)),
            rows_per_step: (settings.rows_per_step(plan) / division).max(1) as usize,
            rules: Rules::new(),
            q: pair(modes),
            v: pair(modes),
            p,
            bend: vec![0.0; modes],
            scratch: vec![0.0; modes],
            moment: vec![0.0; modes],
            u: pair(watched),
            rate: pair(watched),
            acceleration,
            unloaded_jerk: pair(watched),
            jerk: vec![0.0; modes],
            open_steps: vec![0; contacts],
            equations: ForceEquations::default(),
            plan_equations: PlanEquations::new(reduced),
            predicted: vec![PredictedForce::default(); reduced.ports.len()],
            friction_paths: vec![FrictionPath::default(); reduced.ports.len() - contacts],
            links: LinkMotion::new(system, reduced),
            energy: Audit::default(),
            peaks,
            reached: Reached::new(reduced),
            checks_errors: false,
            checked_forces: vec![0.0; reduced.forces()],
            near: NearContacts::new(contacts),
            struck: 0,
            within: WithinStep::default(),
            reduced,
        }
    }

    /// Modal accelerations now, in `scratch`.
    pub(super) fn accelerations(&mut self) {
        let loads = self.p[0].iter().zip(&self.q[0]).zip(&self.v[0]);
        let factors = self.reduced.damping.iter().zip(&self.reduced.stiffness);
        for ((a, ((p, q), v)), (d, k)) in self.scratch.iter_mut().zip(loads).zip(factors) {
            *a = p - d * v - k * q;
        }
    }

    pub(super) fn table_for(&mut self, run: &mut RunState<'_>, next: &NextStep) -> usize {
        if !next.regular {
            self.set_odd(run, next.length);
            return 0;
        }
        let division = self.division(run);
        if let Some(slot) = self.divisions.iter().position(|d| *d == division) {
            return slot;
        }
        let mut table = StepTable::default();
        table.set(self.reduced, next.length, Some(&self.rules));
        run.work.factorizations += 1;
        self.tables.push(table);
        self.divisions.push(division);
        self.tables.len() - 1
    }

    /// Sets the odd table to a length.
    fn set_odd(&mut self, run: &mut RunState<'_>, length: f64) {
        // Seldom enough that what damping takes may come from the balance of every mode.
        self.tables[0].set(self.reduced, length, None);
        run.work.factorizations += 1;
    }

    /// q₁ and q̇₁ under the loads that stand in `p` and `bend`.
    pub(super) fn advance_modes(&mut self, slot: usize) {
        let ([q0, q1], [v0, v1]) = (&mut self.q, &mut self.v);
        let [p0, p1] = &self.p;
        let of = [&q0[..], v0, p0, p1, &self.bend];
        self.tables[slot].advance(self.reduced.arch(), of, [q1, v1]);
    }

    /// Watched displacements, indentations and rates at the end of the tried step.
    fn follow(&mut self, run: &mut RunState<'_>, step: f64) {
        let watched = [&mut self.u[1][..], &mut self.rate[1][..]];
        self.reduced.show_all([&self.q[1], &self.v[1]], watched);
        self.add_grounds(run, 1);
        self.find_near(run, step);
        self.read_trials(run);
    }

    /// Adds the motion of the grounds to closings that have just been filled: now (0), or at the end of the tried step (1).
    pub(super) fn add_grounds(&mut self, run: &RunState<'_>, time: usize) {
        for joint in 0..run.grounds.joints() {
            let [moved, rate, _] = run.grounds.closing(joint, time);
            self.reduced.add_grounds(joint, moved, &mut self.u[time]);
            self.reduced.add_grounds(joint, rate, &mut self.rate[time]);
        }
    }

    /// Lists the contacts that are closed, or that the tried step can bring near touching, if not all are listed.
    fn find_near(&mut self, run: &mut RunState<'_>, step: f64) {
        let Some(near) = &mut self.peaks.near else {
            return;
        };
        let ends = [0, 1].map(|time: usize| [&self.u[time][..], &self.rate[time]]);
        let found = near.find_near(self.reduced.arch(), ends, step);
        let phases = &run.phases;
        let is_open = |contact: &usize| matches!(phases[*contact], ContactPhase::Open);
        run.near.retain(|contact| !is_open(contact));
        let closed = run.near.len();
        run.near
            .extend(found.iter().copied().filter(|contact| is_open(contact)));
        if closed > 0 {
            run.near.sort_unstable();
        }
    }

    /// Sets the trials to the end of the tried step.
    pub(super) fn read_trials(&self, run: &mut RunState<'_>) {
        if self.reduced.plan.is_some() {
            for &index in &run.near {
                let friction = self.reduced.friction[index];
                for port in [Some(index), friction].into_iter().flatten() {
                    let width = if port == index {
                        run.widths[index]
                    } else {
                        0.0
                    };
                    let trial = &mut run.trials[port];
                    trial.indentation = self.reduced.closing(port, &self.u[1]) - width;
                    trial.rate = self.reduced.closing(port, &self.rate[1]);
                    trial.force = 0.0;
                }
            }
            return;
        }
        let contacts = run.system.contacts.len();
        for (index, trial) in run.trials[..contacts].iter_mut().enumerate() {
            let width = run.widths[index];
            trial.indentation = self.reduced.closing(index, &self.u[1]) - width;
            trial.rate = self.reduced.closing(index, &self.rate[1]);
            trial.force = 0.0;
        }
        // Slips of faces with friction follow.
        for (index, trial) in run.trials.iter_mut().enumerate().skip(contacts) {
            if index < self.reduced.ports.len() {
                trial.indentation = self.reduced.closing(index, &self.u[1]);
                trial.rate = self.reduced.closing(index, &self.rate[1]);
                trial.force = 0.0;
            }
        }
    }

    /// Modal jerks now without the load term, into `jerk`; the modal accelerations are in `scratch`.
    pub(super) fn jerks(&mut self) {
        let modes = self.scratch.iter().zip(&self.v[0]);
        let factors = self.reduced.damping.iter().zip(&self.reduced.stiffness);
        for (jerk, ((a, v), (d, k))) in self.jerk.iter_mut().zip(modes.zip(factors)) {
            *jerk = -d * a - k * v;
        }
    }

    /// Adds the peaks of an accepted step, whose modal accelerations at the end are in `scratch` and whose
    /// jerks without the load term, in `jerk`.
    fn look(&mut self, run: &RunState<'_>, common: [Ground; 2], start: f64, step: f64) {
        let reduced = self.reduced;
        let ground = [run.grounds.at(1, common[0]), run.grounds.at(0, common[1])];
        self.acceleration.swap(0, 1);
        self.unloaded_jerk.swap(0, 1);
        self.show_accelerations(&run.grounds);
        let at = |time: usize| Watched {
            u: &self.u[time],
            rate: &self.rate[time],
            acceleration: &self.acceleration[time],
            unloaded_jerk: &self.unloaded_jerk[time],
        };
        let taken = Taken {
            then: at(1),
            now: at(0),
            ground,
            start,
            step,
            motion: StepMotion {
                start: [&self.q[1], &self.v[1]],
                loads: Loads::Parabolas([&self.p[1], &self.p[0], &self.bend]),
                ground,
                step,
            },
        };
        let was_struck = self.struck > 0;
        if was_struck {
            let struck = StruckStep {
                q: &self.q[1],
                v: &self.v[1],
                loads: [&self.p[1], &self.p[0]],
                bend: &self.bend,
                ground,
                step,
            };
            let within = &mut self.within;
            self.peaks
                .after_struck_step(run.system, reduced, &taken, || {
                    within.greatest(reduced, &struck)
                });
        } else {
            self.peaks.after_step(run.system, reduced, &taken);
        }
        self.struck = self.struck.saturating_sub(1);
        let open = run.near.iter().all(|index| run.is_open(*index));
        let now = Instant {
            q: &self.q[0],
            v: &self.v[0],
            a: &self.scratch,
            jerk: &self.jerk,
            time: run.time,
            ground: run.grounds_at(0),
            phases: &run.phases,
            smooth: open && !was_struck,
        };
        self.peaks.follow_forces(run.system, reduced, now);
    }

    /// Adds the rate of a contact force, or of friction, to the modal jerks; in space once [`Self::push_slopes`] is called.
    pub(super) fn push_slope(&mut self, port: usize, slope: f64) {
        match &self.reduced.plan {
            Some(plan) => self.plan_equations.add_rate(plan, port, slope),
            None => self.reduced.push_apart(port, slope, &mut self.jerk),
        }
    }

    fn push_slopes(&mut self) {
        if let Some(plan) = &self.reduced.plan {
            self.plan_equations.push_rates(plan, &mut self.jerk);
        }
    }

    pub(super) fn show_accelerations(&mut self, grounds: &RunGrounds<'_>) {
        self.reduced.show_all(
            [&self.scratch, &self.jerk],
            [&mut self.acceleration[0], &mut self.unloaded_jerk[0]],
        );
        for joint in 0..grounds.joints() {
            let moved = grounds.closing(joint, 0)[2];
            self.reduced
                .add_grounds(joint, moved, &mut self.acceleration[0]);
        }
    }

    /// Accelerations and their rates after a sudden change of loads or of their rates.
    fn start_anew(&mut self, run: &RunState<'_>) {
        self.accelerations();
        self.jerks();
        self.add_link_slopes(&run.grounds);
        let reduced = self.reduced;
        if let Some(plan) = &reduced.plan {
            let near = run.near.iter().copied();
            let closed = near.filter(|index| !run.is_open(*index));
            self.plan_equations.accelerate(plan, closed, &self.scratch);
        }
        for &index in &run.near {
            if run.is_open(index) {
                continue;
            }
            let slope = self.slope_from_here(run, index);
            if slope != 0.0 {
                self.push_slope(index, slope);
            }
            if let ContactPhase::Closed(episode) = &run.phases[index] {
                self.push_friction_slope(
                    run,
                    index,
                    episode.friction.force,
                    [episode.force, slope],
                );
            }
        }
        self.push_slopes();
        self.show_accelerations(&run.grounds);
        let jumped = [&self.v[0][..], &self.scratch, &self.jerk];
        self.peaks.restart(self.reduced, jumped);
    }

    /// Adds a row to the history where one is due.
    fn take_row(&mut self, run: &RunState<'_>, wanted: bool, energy: &Energy) {
        if self.peaks.is_due(run.time, wanted) {
            let watched = Watched {
                u: &self.u[0],
                rate: &self.rate[0],
                acceleration: &self.acceleration[0],
                unloaded_jerk: &self.unloaded_jerk[0],
            };
            let instant = Instant {
                q: &self.q[0],
                v: &self.v[0],
                a: &self.scratch,
                jerk: &self.jerk,
                time: run.time,
                ground: run.grounds_at(0),
                phases: &run.phases,
                smooth: true,
            };
            self.peaks.record(
                run.system,
                self.reduced,
                instant,
                watched,
                (&self.links.forces, &run.grounds),
                energy,
            );
        }
    }
}

impl Stepper for ModalStepper<'_> {
    fn ends_steps_at_corners(&self, _: &RunState<'_>) -> bool {
        true
    }

    fn record_start(&mut self, run: &mut RunState<'_>) {
        let energy = self.balance();
        if self.peaks.members.is_some() {
            self.accelerations();
        }
        self.take_row(run, true, &energy);
    }

    fn history_fault(&self) -> Option<&str> {
        self.peaks.history_fault()
    }

    fn take_free_steps(&mut self, run: &mut RunState<'_>) -> bool {
        self.take_free(run)
    }

    fn closing(&self, _: &RunState<'_>, contact: usize) -> f64 {
        self.reduced.closing(contact, &self.u[0])
    }

    fn closing_rate(&self, _: &RunState<'_>, contact: usize) -> f64 {
        self.reduced.closing(contact, &self.rate[0])
    }

    fn slip(&self, _: &RunState<'_>, contact: usize) -> [f64; 2] {
        self.reduced.friction[contact].map_or([0.0; 2], |place| {
            [&self.u[0], &self.rate[0]].map(|list| self.reduced.closing(place, list))
        })
    }

    fn edge_ends(&self, contact: usize) -> std::ops::Range<usize> {
        self.reduced.ends_of[contact].clone()
    }

    fn edge_end(&self, run: &RunState<'_>, end: usize, tried: bool) -> [f64; 2] {
        let [moved, rate] = [&self.u, &self.rate]
            .map(|lists| self.reduced.moved_from_end(end, &lists[usize::from(tried)]));
        [run.system.edge_ends[end].inside + moved, rate]
    }

    fn follow_friction(
        &mut self,
        run: &RunState<'_>,
        contact: usize,
        episode: &mut Episode,
        pressed: &StepForce,
        span: [f64; 2],
    ) -> Option<FrictionPath> {
        self.finish_friction(run, contact, episode, pressed, span)
    }

    fn change_friction(&mut self, _: &RunState<'_>, contact: usize, change: f64) {
        if let Some(place) = self.reduced.friction[contact] {
            self.reduced.push_apart(place, change, &mut self.p[0]);
        }
    }

    fn division(&self, run: &RunState<'_>) -> u32 {
        let divisions = run.contact_division.iter().copied();
        divisions.fold(self.least_division, u32::max)
    }

    fn prepare(&mut self, run: &mut RunState<'_>, next: &NextStep) -> Result<usize, StepError> {
        Ok(self.table_for(run, next))
    }

    fn prepare_length(&mut self, run: &mut RunState<'_>, length: f64) -> Result<(), StepError> {
        self.set_odd(run, length);
        Ok(())
    }

    fn length(&self, slot: usize) -> f64 {
        self.tables[slot].step
    }

    fn try_step(
        &mut self,
        run: &mut RunState<'_>,
        slot: usize,
        end: Clock,
    ) -> Result<(), StepError> {
        run.move_grounds(end.time());
        self.reduced.set_loads_of(run.grounds_at(1), &mut self.p[1]);
        self.predict_forces(run, self.tables[slot].step);
        self.advance_modes(slot);
        if !self.reduced.links.is_empty() {
            self.press_links(&run.grounds, slot);
        }
        run.work.solves += 1;
        if self.reduced.plan.is_some() {
            if !self.q[1].iter().all(|q| q.is_finite()) {
                return Err(StepError::NotFinite { time: run.time });
            }
            if !run.coupling.closed.is_empty() {
                self.find_forces_in_plan(run, slot)?;
            }
            self.follow(run, self.tables[slot].step);
            for closed in &run.coupling.closed {
                run.trials[closed.contact].force = closed.force;
            }
            return Ok(());
        }
        self.follow(run, self.tables[slot].step);
        if run
            .trials
            .iter()
            .any(|trial| !trial.indentation.is_finite())
            || self.u[1].iter().any(|u| !u.is_finite())
        {
            return Err(StepError::NotFinite { time: run.time });
        }
        self.find_contact_forces(run, slot)
    }

    fn unresolved_contact(&self, run: &RunState<'_>, step: f64) -> Option<usize> {
        let unseen = contact_parabola::opens_unseen(run, self, step);
        unseen.or_else(|| contact_parabola::misses_prediction(run, &self.predicted))
    }

    fn contact_that_opens_unseen(&self, run: &RunState<'_>, step: f64) -> Option<usize> {
        contact_parabola::opens_unseen(run, self, step)
    }

    fn before_step(&mut self, run: &mut RunState<'_>, step: f64) {
        if let Some(near) = &mut self.peaks.near {
            near.open(self.reduced.arch(), &self.u[1]);
        }
        let mut near = std::mem::replace(&mut self.near, NearContacts::new(0));
        near.at_turns(run, self, step, |contact| self.peaks.closing[contact].value);
        self.near = near;
    }

    fn gather(
        &mut self,
        run: &mut RunState<'_>,
        closed: usize,
        episode: &mut Episode,
        _: &Cubic,
        step: f64,
    ) {
        let index = run.coupling.closed[closed].contact;
        let force = [episode.force, run.trials[index].force];
        let bend = self.predicted[index].bend(force[0], force[1]);
        episode.impulse += step * (0.5 * (force[0] + force[1]) - bend / 6.0);
    }

    fn advance(&mut self, run: &mut RunState<'_>, slot: usize) -> Result<(), StepError> {
        let energy = self.step_energy(run, slot, run.in_contact());
        self.energy.input += energy.input;
        self.energy.damped += energy.damped;
        for pair in [
            &mut self.q,
            &mut self.v,
            &mut self.p,
            &mut self.u,
            &mut self.rate,
        ] {
            let [now, end] = pair;
            std::mem::swap(now, end);
        }
        Ok(())
    }

    fn arrive(&mut self, run: &mut RunState<'_>, slot: usize) {
        self.accelerations();
        let free = (slot != 0 && !run.in_contact()).then_some(self.tables[slot].step);
        self.checks_errors = self.reached.widen(&self.scratch, free);
        if let Some(plan) = &self.reduced.plan {
            let (closed, contacts) = (run.coupling.closed.iter(), run.phases.len());
            let closed = closed.map(|closed| closed.contact);
            let closed = closed.filter(|contact| *contact < contacts);
            self.plan_equations.accelerate(plan, closed, &self.scratch);
        }
        self.jerks();
        self.add_link_slopes(&run.grounds);
    }

    fn end_slope(
        &mut self,
        run: &RunState<'_>,
        contact: usize,
        trial: &ContactTrial,
        episode: &Episode,
        step: f64,
    ) -> f64 {
        let law = &run.system.contacts[contact].law;
        let acceleration = self.relative_acceleration(run, contact);
        let slope_at = |indentation: f64, rate: f64| {
            let response = law.follow(indentation, rate, &episode.memory);
            response.by_indentation * rate + response.by_rate * acceleration
        };
        let slope = if run.at_corner {
            // Before the corner at which the step ends, on its own side.
            let back = -AHEAD * step;
            slope_at(
                trial.indentation + trial.rate * back,
                trial.rate + acceleration * back,
            )
        } else {
            slope_at(trial.indentation, trial.rate)
        };
        // Still the slope at the end when the contact opens there.
        self.push_slope(contact, slope);
        if let Some(place) = self.reduced.friction[contact] {
            let force = run.trials[place].force;
            self.push_friction_slope(run, contact, force, [trial.force, slope]);
        }
        slope
    }

    fn next_division(
        &self,
        run: &RunState<'_>,
        closed: usize,
        episode: &Episode,
        start: f64,
        step: f64,
    ) -> u32 {
        let index = run.coupling.closed[closed].contact;
        let mut missed = (run.trials[index].force - self.predicted[index].end).abs();
        if let Some(place) = self.reduced.friction[index] {
            let friction = run.trials[place].force - self.predicted[place].end;
            missed = missed.max(friction.abs());
        }
        contact_parabola::division_after_step(run, index, episode, [start, step], missed)
    }

    fn relax_divisions(&mut self, run: &mut RunState<'_>) {
        contact_parabola::relax_divisions(run, &mut self.open_steps);
    }

    fn after_step(
        &mut self,
        run: &mut RunState<'_>,
        start: f64,
        step: f64,
        ground: [Ground; 2],
        was_closed: bool,
    ) -> Result<(), StepError> {
        self.push_slopes();
        self.look(run, ground, start, step);
        if !self.reduced.links.is_empty() {
            self.follow_links(start, step);
        }
        if self.checks_errors {
            let watched = Watched {
                u: &self.u[0],
                rate: &self.rate[0],
                acceleration: &self.acceleration[0],
                unloaded_jerk: &self.unloaded_jerk[0],
            };
            self.reached.look(
                run.system,
                self.reduced,
                &self.scratch,
                watched,
                run.grounds_at(0),
                self.peaks.forces(),
            );
        }
        let energy = self.balance();
        self.take_row(run, was_closed, &energy);
        Ok(())
    }

    fn before_touch(&mut self, run: &RunState<'_>, contact: usize, rate: f64) {
        let closing = self.peaks.closing[contact].value;
        let touch = Touch {
            rate,
            acceleration: self.reduced.closing(contact, &self.acceleration[0]),
            doubt: near_contacts::doubt(run, contact, closing),
            clearance: match (&self.peaks.near, &self.reduced.plan) {
                (Some(near), Some(plan)) => Some(near.clearance(plan, contact)),
                _ => None,
            },
        };
        self.near.at_touch(run, contact, touch);
    }

    fn division_at_touch(
        &self,
        run: &RunState<'_>,
        contact: usize,
        rate: f64,
        episode: &Episode,
        planned: u32,
    ) -> u32 {
        let acceleration = self.reduced.closing(contact, &self.acceleration[0]);
        let contact = &run.system.contacts[contact];
        contact_parabola::division_at_touch(run, contact, [rate, acceleration], episode, planned)
    }

    fn after_release(&mut self, run: &RunState<'_>, contact: usize) {
        self.near.after_release(contact);
        if let (Some(near), Some(plan)) = (&mut self.peaks.near, &self.reduced.plan) {
            near.after_release(plan, contact, run.widths[contact]);
        }
        self.open_steps[contact] = 0;
    }

    fn change_force(&mut self, _: &RunState<'_>, contact: usize, change: f64) {
        self.reduced.push_apart(contact, change, &mut self.p[0]);
    }

    fn change_ground(&mut self, _: &RunState<'_>, building: usize, change: Ground) {
        let modes = self.reduced.buildings[building].modes.clone();
        self.reduced
            .add_ground_loads(building, change, &mut self.p[0][modes]);
    }

    fn jump_velocities(
        &mut self,
        run: &mut RunState<'_>,
        contact: usize,
        restitution: f64,
        rate: f64,
    ) -> Jump {
        self.strike(run, contact, restitution, rate)
    }

    fn restart(&mut self, run: &RunState<'_>, velocities: bool) {
        if velocities {
            self.struck = STRUCK_STEPS;
        }
        self.start_anew(run);
    }
}
