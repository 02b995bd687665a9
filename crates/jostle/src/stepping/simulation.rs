//! The walk through a ground motion.

use std::ops::ControlFlow;

use super::clock::{Clock, Stride};
use super::coupling::{Closed, ContactEquations};
use super::energy::EnergyAudit;
use super::events::{Crossing, Cubic, bisect};
use super::factors::StepFactors;
use super::lanes;
use super::plan::Plan;
use super::recorder::Recorder;
use super::{NotPositive, StepEquations};
use crate::history::{Energy, Extreme, FloorPeaks, History, Impact, Work};
use crate::model::Solver;
use crate::motion::GroundMotion;
use crate::state::{ContactPhase, Episode, State};
use crate::stiffness::DirectStiffness;
use crate::system::System;
use crate::transfer::riccati::RiccatiSweep;

/// What a run should leave behind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Whether buildings push each other or pass through each other.
    pub pounding: Pounding,
    /// Least time between recorded instants in free flight, zero for every step; every step of a closed contact
    /// is recorded. `None` records no histories \[s\].
    pub record_interval: Option<f64>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            pounding: Pounding::Included,
            record_interval: Some(0.005),
        }
    }
}

/// Whether contacts push.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pounding {
    /// Buildings hit each other.
    Included,
    /// Buildings pass through each other; closings are still followed.
    Excluded,
}

/// How far a run has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Time reached \[s\].
    pub time: f64,
    /// Time to reach \[s\].
    pub duration: f64,
}

/// Everything a run leaves behind.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Time histories, if asked for.
    pub history: Option<History>,
    /// Impacts in the order in which they ended.
    pub impacts: Vec<Impact>,
    /// Peaks of every floor of every building.
    pub floors: Vec<Vec<FloorPeaks>>,
    /// Greatest closing u_left − u_right of every contact \[m\].
    pub closing: Vec<Extreme>,
    /// Greatest elastic base shear of every building \[N\].
    pub base_shear: Vec<f64>,
    /// Energies at the end.
    pub energy: Energy,
    /// Work done.
    pub work: Work,
    /// Smallest regular step taken in contact \[s\].
    pub contact_step: Option<f64>,
    /// State at the end.
    pub state: State,
    /// Why the run ended.
    pub end: RunEnd,
}

/// Why a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum RunEnd {
    /// The end of the motion was reached.
    Completed,
    /// The observer asked to stop.
    Stopped,
    /// A step failed; what came before stands.
    Failed(StepError),
}

/// A step that could not be taken.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StepError {
    /// A building offers no resistance.
    #[error(
        "\"{building}\" cannot be stepped at t = {time:.6} s: {source}; check its supports and stiffnesses"
    )]
    NotPositive {
        /// Name of the building.
        building: String,
        /// Time \[s\].
        time: f64,
        /// Where.
        source: NotPositive,
    },
    /// The contact forces were not found.
    #[error(
        "the contact forces did not converge at t = {time:.6} s ({closed} contacts closed); a smaller contact_step may help"
    )]
    ContactDiverged {
        /// Time \[s\].
        time: f64,
        /// Number of closed contacts.
        closed: usize,
    },
    /// A displacement overflowed.
    #[error(
        "displacements are no longer finite at t = {time:.6} s; check masses, stiffnesses and the ground motion"
    )]
    NotFinite {
        /// Time \[s\].
        time: f64,
    },
    /// Contacts keep closing and opening without time passing.
    #[error(
        "contacts close and open endlessly at t = {time:.6} s; a smaller contact_step or a softer contact may help"
    )]
    Chattering {
        /// Time \[s\].
        time: f64,
    },
}

/// Runs a system from rest through a ground motion. `observer` is called now and then and may stop the run.
///
/// The answer depends on nothing but the arguments, bit for bit.
pub fn simulate(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    settings: Settings,
    observer: impl FnMut(Progress) -> ControlFlow<()>,
) -> Outcome {
    simulate_from(
        system,
        motion,
        plan,
        settings,
        State::at_rest(system, motion.acceleration(0.0)),
        observer,
    )
}

/// Runs a system from a given state at time zero. Where that state is not in equilibrium, the missing load
/// appears within the first step.
pub fn simulate_from(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    settings: Settings,
    state: State,
    observer: impl FnMut(Progress) -> ControlFlow<()>,
) -> Outcome {
    match plan.solver {
        Solver::Riccati => {
            Simulation::<RiccatiSweep>::new(system, motion, plan, settings, state).run(observer)
        }
        Solver::Stiffness => {
            Simulation::<DirectStiffness>::new(system, motion, plan, settings, state).run(observer)
        }
    }
}

/// A contact closes or opens within a step.
#[derive(Clone, Copy, Debug)]
struct Event {
    contact: usize,
    crossing: Crossing,
    /// Share of the step.
    at: f64,
}

/// What a tried step would do at a contact.
#[derive(Clone, Copy, Debug, Default)]
struct ContactTrial {
    indentation: f64,
    rate: f64,
    force: f64,
}

struct Simulation<'a, E: StepEquations> {
    system: &'a System,
    motion: &'a GroundMotion,
    plan: &'a Plan,
    pounding: bool,
    equations: Vec<E>,
    /// The first serves steps off the grid, the others one division of the free-flight step each.
    factors: Vec<StepFactors<E>>,
    divisions: Vec<u32>,
    state: State,
    clock: Clock,
    /// Ground acceleration now and at the end of the tried step.
    ground: [f64; 2],
    /// Load that the initial state leaves unbalanced; empty once it has been applied.
    unbalanced: Vec<f64>,
    /// The tried step: first the load, then y, then the displacement over the step.
    rise: Vec<f64>,
    trials: Vec<ContactTrial>,
    contact_division: Vec<u32>,
    coupling: ContactEquations,
    finest_in_contact: u32,
    impacts: Vec<Impact>,
    audit: EnergyAudit,
    work: Work,
    recorder: Recorder,
}

/// A touch is located when the faces are this close \[m\].
const TOUCH: f64 = 1e-13;
/// Contacts this close to touching, and closing, close together with another \[m\].
const TOGETHER: f64 = 1e-12;
/// An event nearer than this share of a step happens at its start.
const AT_ONCE: f64 = 1e-4;
/// Laws that divide by the impact speed see at least this much \[m/s\].
const SLOWEST_IMPACT: f64 = 1e-6;
/// Steps between calls of the observer.
const OBSERVED_EVERY: u64 = 256;
/// Events without progress before a run gives up.
const MOST_EVENTS_AT_ONCE: usize = 1000;

impl<'a, E: StepEquations> Simulation<'a, E> {
    fn new(
        system: &'a System,
        motion: &'a GroundMotion,
        plan: &'a Plan,
        settings: Settings,
        state: State,
    ) -> Self {
        let ground = motion.acceleration(0.0);
        let steps = motion.duration / plan.step;
        let mut recorder = Recorder::new(system, settings.record_interval);
        let rows = settings
            .record_interval
            .map_or(0.0, |interval| motion.duration / plan.step.max(interval));
        recorder.reserve((1.2 * rows.min(steps) + 100.0).min(1e6) as usize);
        Self {
            system,
            motion,
            plan,
            pounding: settings.pounding == Pounding::Included,
            equations: system.buildings.iter().map(E::of).collect(),
            factors: vec![StepFactors::blank(system)],
            divisions: vec![0],
            clock: Clock::new(plan.step),
            ground: [ground, ground],
            unbalanced: unbalanced_load(system, &state, ground),
            rise: vec![0.0; system.len()],
            trials: vec![ContactTrial::default(); system.contacts.len()],
            contact_division: vec![1; system.contacts.len()],
            coupling: ContactEquations::default(),
            finest_in_contact: 0,
            impacts: Vec::new(),
            audit: EnergyAudit::starting_from(system, &state.displacement, &state.velocity),
            work: Work::default(),
            recorder,
            state,
        }
    }

    fn run(mut self, mut observer: impl FnMut(Progress) -> ControlFlow<()>) -> Outcome {
        let duration = self.motion.duration;
        self.recorder.record(
            self.system,
            &self.state,
            self.ground[0],
            true,
            &mut self.audit,
        );
        let mut end = RunEnd::Completed;
        while duration - self.state.time > 1e-9 * self.plan.step {
            if self.work.steps.is_multiple_of(OBSERVED_EVERY)
                && observer(Progress {
                    time: self.state.time,
                    duration,
                })
                .is_break()
            {
                end = RunEnd::Stopped;
                break;
            }
            if let Err(error) = self.step() {
                end = RunEnd::Failed(error);
                break;
            }
        }
        self.close_books(end)
    }

    fn close_books(mut self, end: RunEnd) -> Outcome {
        for index in 0..self.system.contacts.len() {
            if let ContactPhase::Closed(episode) = self.state.contacts[index] {
                self.report_impact(index, &episode);
            }
        }
        let energy =
            self.audit
                .balance(self.system, &self.state.displacement, &self.state.velocity);
        let contact_step = Some(self.finest_in_contact)
            .filter(|d| *d > 0)
            .map(|d| self.plan.step / f64::from(d));
        Outcome {
            impacts: self.impacts,
            floors: std::mem::take(&mut self.recorder.floors),
            closing: std::mem::take(&mut self.recorder.closing),
            base_shear: std::mem::take(&mut self.recorder.base_shear),
            history: self.recorder.into_history(),
            energy,
            work: self.work,
            contact_step,
            state: self.state,
            end,
        }
    }

    /// One accepted step, ending on the grid or on the first event in between.
    fn step(&mut self) -> Result<(), StepError> {
        for _ in 0..MOST_EVENTS_AT_ONCE {
            let stride = self.next_stride();
            let slot = self.factors_for(&stride)?;
            self.try_step(slot, stride.end)?;
            let Some(event) = self.first_event(stride.length) else {
                return self.accept(slot, stride.end);
            };
            self.work.repeated_steps += 1;
            let shortest =
                AT_ONCE * self.plan.step / f64::from(self.division().max(self.division_at(&event)));
            if event.at * stride.length > shortest {
                return self.step_to(event, &stride);
            }
            self.read_contacts();
            self.happen(event);
        }
        Err(StepError::Chattering {
            time: self.state.time,
        })
    }

    /// The regular step from here, cut at the end of the motion.
    fn next_stride(&self) -> Stride {
        let stride = self.clock.stride(self.division());
        let left = self.motion.duration - self.state.time;
        if stride.length > left * (1.0 + 1e-9) {
            return Stride {
                length: left,
                regular: false,
                end: self.clock.after(left),
            };
        }
        stride
    }

    /// Into how many parts the free-flight step is divided now.
    fn division(&self) -> u32 {
        let closed = self.state.contacts.iter().zip(&self.contact_division);
        closed
            .filter(|(phase, _)| matches!(phase, ContactPhase::Closed(_)))
            .map(|(_, d)| *d)
            .max()
            .unwrap_or(1)
    }

    fn division_at(&self, event: &Event) -> u32 {
        self.plan.division(
            &self.system.contacts[event.contact],
            self.trials[event.contact].rate,
        )
    }

    fn factors_for(&mut self, stride: &Stride) -> Result<usize, StepError> {
        if !stride.regular {
            return self.factorize(0, stride.length).map(|()| 0);
        }
        let division = self.division();
        if let Some(slot) = self.divisions.iter().position(|d| *d == division) {
            return Ok(slot);
        }
        self.factors.push(StepFactors::blank(self.system));
        self.divisions.push(division);
        let slot = self.factors.len() - 1;
        self.factorize(slot, stride.length).map(|()| slot)
    }

    fn factorize(&mut self, slot: usize, step: f64) -> Result<(), StepError> {
        self.factors[slot]
            .set_step(
                self.plan.newmark,
                step,
                self.system,
                &self.equations,
                &mut self.work,
            )
            .map_err(|(building, source)| StepError::NotPositive {
                building: self.system.buildings[building].name.clone(),
                time: self.state.time,
                source,
            })
    }

    /// Solves the step to `end` without accepting it: fills `rise` and `trials`.
    fn try_step(&mut self, slot: usize, end: Clock) -> Result<(), StepError> {
        self.ground[1] = self.motion.acceleration(end.time());
        self.fill_loads(slot);
        self.factors[slot].solve(self.system, &self.equations, &mut self.rise, &mut self.work);
        self.follow_contacts(slot);
        if self
            .trials
            .iter()
            .any(|trial| !trial.indentation.is_finite())
        {
            return Err(StepError::NotFinite {
                time: self.state.time,
            });
        }
        self.list_closed_contacts(slot);
        if self.coupling.closed.is_empty() {
            Ok(())
        } else {
            self.find_contact_forces(slot)
        }
    }

    /// Loads of the incremental step, contacts of its end not yet pushing (theory, Eq. N3).
    fn fill_loads(&mut self, slot: usize) {
        let change = self.ground[1] - self.ground[0];
        for (building, own) in self
            .system
            .buildings
            .iter()
            .zip(&self.factors[slot].buildings)
        {
            let (range, equations) = (building.range(), &building.equations);
            let motion = self.state.velocity[range.clone()]
                .iter()
                .zip(&self.state.acceleration[range.clone()]);
            let masses = equations.mass.iter().zip(&equations.driven_mass);
            for ((load, (v, a)), (mass, driven)) in
                self.rise[range].iter_mut().zip(motion).zip(masses)
            {
                *load = -mass * (own.l_v * v + own.l_a * a) - driven * change;
            }
        }
        for (load, missing) in self.rise.iter_mut().zip(&self.unbalanced) {
            *load += missing;
        }
        for (contact, phase) in self.system.contacts.iter().zip(&self.state.contacts) {
            let force = phase.force();
            if force != 0.0 {
                self.rise[contact.dofs[0]] += force;
                self.rise[contact.dofs[1]] -= force;
            }
        }
    }

    /// Indentations and rates at the end of the tried step.
    fn follow_contacts(&mut self, slot: usize) {
        let factors = &self.factors[slot];
        let k = &factors.coefficients;
        let (u, v, a) = (
            &self.state.displacement,
            &self.state.velocity,
            &self.state.acceleration,
        );
        for (contact, trial) in self.system.contacts.iter().zip(&mut self.trials) {
            let [i, j] = contact.dofs;
            let rise = |side: usize| {
                let dof = contact.dofs[side];
                self.rise[dof]
                    - factors.buildings[contact.buildings[side]].shift
                        * (k.d_v * v[dof] + k.d_a * a[dof])
            };
            let closed_by = rise(0) - rise(1);
            trial.indentation = u[i] - u[j] - contact.width + closed_by;
            trial.rate = k.c * closed_by + (1.0 + k.d_v) * (v[i] - v[j]) + k.d_a * (a[i] - a[j]);
            trial.force = 0.0;
        }
    }

    /// Lists the closed contacts, with the indentations they would have if they did not push.
    fn list_closed_contacts(&mut self, slot: usize) {
        self.coupling.closed.clear();
        for (index, phase) in self.state.contacts.iter().enumerate() {
            if let ContactPhase::Closed(episode) = phase {
                let trial = &self.trials[index];
                self.coupling.closed.push(Closed {
                    contact: index,
                    law: self.system.contacts[index].law,
                    impact_speed: episode.impact_speed,
                    free: trial.indentation,
                    free_rate: trial.rate,
                    rate_gain: self.factors[slot].coefficients.c,
                    indentation: trial.indentation,
                    force: 0.0,
                    start_slope: 0.0,
                });
            }
        }
    }

    /// Solves for the forces of the closed contacts and lets them push (theory, Eqs. P1–P3).
    fn find_contact_forces(&mut self, slot: usize) -> Result<(), StepError> {
        let factors = &mut self.factors[slot];
        for closed in &self.coupling.closed {
            factors.prepare_contact(closed.contact, self.system, &self.equations, &mut self.work);
        }
        self.coupling.compliance.clear();
        for row in &self.coupling.closed {
            for column in &self.coupling.closed {
                let compliance = factors.compliance(
                    &self.system.contacts[row.contact],
                    column.contact,
                    self.system,
                );
                self.coupling.compliance.push(compliance);
            }
        }
        let time = self.state.time;
        let closed = self.coupling.closed.len();
        self.work.iterations += self
            .coupling
            .solve()
            .ok_or(StepError::ContactDiverged { time, closed })?;
        for closed in &self.coupling.closed {
            if closed.force != 0.0 {
                factors.push_apart(closed.contact, closed.force, self.system, &mut self.rise);
            }
        }
        self.follow_contacts(slot);
        for closed in &self.coupling.closed {
            self.trials[closed.contact].force = closed.force;
        }
        Ok(())
    }

    /// Motion of contact `index` over the tried step.
    fn indentation_curve(&self, index: usize, step: f64) -> Cubic {
        let contact = &self.system.contacts[index];
        let [i, j] = contact.dofs;
        let (u, v) = (&self.state.displacement, &self.state.velocity);
        let trial = &self.trials[index];
        Cubic::new(
            u[i] - u[j] - contact.width,
            v[i] - v[j],
            trial.indentation,
            trial.rate,
            step,
        )
    }

    /// The first touch, or release with a jump of force, in the tried step.
    fn first_event(&self, step: f64) -> Option<Event> {
        if !self.pounding {
            return None;
        }
        let mut first: Option<Event> = None;
        for (contact, phase) in self.state.contacts.iter().enumerate() {
            let trial = &self.trials[contact];
            let turned_back = || trial.rate < 0.0 && self.closing_rate(contact) > 0.0;
            let crossing = match phase {
                ContactPhase::Open if trial.indentation > 0.0 || turned_back() => Crossing::Upwards,
                ContactPhase::Closed(_)
                    if trial.indentation < 0.0
                        && self.system.contacts[contact].law.jumps_at_release() =>
                {
                    Crossing::Downwards
                }
                _ => continue,
            };
            if let Some(at) = self
                .indentation_curve(contact, step)
                .first_crossing(crossing)
                && first.is_none_or(|event| at < event.at)
            {
                first = Some(Event {
                    contact,
                    crossing,
                    at,
                });
            }
        }
        first
    }

    /// Repeats the step so that it ends on an event, or on an earlier one met on the way.
    fn step_to(&mut self, mut event: Event, stride: &Stride) -> Result<(), StepError> {
        let mut length = event.at * stride.length;
        for _ in 0..12 {
            self.factorize(0, length)?;
            self.try_step(0, self.clock.after(length))?;
            if let Some(other) = self
                .first_event(length)
                .filter(|other| other.contact != event.contact && other.at < 1.0 - 1e-9)
            {
                event = other;
                length *= other.at;
                continue;
            }
            let trial = self.trials[event.contact];
            let correction = -trial.indentation / trial.rate;
            let corrected = length + correction;
            let wrong_way = (event.crossing == Crossing::Upwards) != (trial.rate > 0.0);
            if trial.indentation.abs() <= TOUCH
                || wrong_way
                || !(corrected > 0.0 && corrected < stride.length)
            {
                break;
            }
            length = corrected;
            self.work.repeated_steps += 1;
        }
        let ContactTrial {
            indentation, rate, ..
        } = self.trials[event.contact];
        let reached = match event.crossing {
            Crossing::Upwards => indentation >= -TOGETHER && rate > 0.0,
            Crossing::Downwards => indentation <= TOGETHER && rate < 0.0,
        };
        self.accept(0, self.clock.after(length))?;
        if reached {
            self.happen(event);
        }
        Ok(())
    }

    /// Rate of closing of a contact at the present instant \[m/s\].
    fn closing_rate(&self, index: usize) -> f64 {
        let [i, j] = self.system.contacts[index].dofs;
        self.state.velocity[i] - self.state.velocity[j]
    }

    /// Sets `trials` to the present.
    fn read_contacts(&mut self) {
        for (index, contact) in self.system.contacts.iter().enumerate() {
            let [i, j] = contact.dofs;
            self.trials[index].indentation =
                self.state.displacement[i] - self.state.displacement[j] - contact.width;
            self.trials[index].rate = self.closing_rate(index);
        }
    }

    /// Closes or opens contacts at the present instant, whose indentations and rates stand in `trials`.
    fn happen(&mut self, event: Event) {
        let time = self.state.time;
        if event.crossing == Crossing::Downwards {
            if let ContactPhase::Closed(mut episode) = self.state.contacts[event.contact] {
                self.jump(event.contact, -episode.force);
                (episode.end, episode.separation_speed) = (time, -self.trials[event.contact].rate);
                self.report_impact(event.contact, &episode);
                self.state.contacts[event.contact] = ContactPhase::Open;
            }
            return;
        }
        for index in 0..self.system.contacts.len() {
            let ContactTrial {
                indentation, rate, ..
            } = self.trials[index];
            let open = self.state.contacts[index] == ContactPhase::Open;
            if index == event.contact || (open && indentation >= -TOGETHER && rate > 0.0) {
                let contact = &self.system.contacts[index];
                let impact_speed = rate.max(SLOWEST_IMPACT);
                let mut episode = Episode::new(time, impact_speed);
                episode.force = contact.law.onset(impact_speed);
                episode.peak_force = episode.force;
                self.contact_division[index] = self.plan.division(contact, impact_speed);
                self.finest_in_contact = self.finest_in_contact.max(self.contact_division[index]);
                self.jump(index, episode.force);
                self.state.contacts[index] = ContactPhase::Closed(episode);
            }
        }
    }

    /// A sudden change of a contact force changes the accelerations of the two faces (theory, Eq. H2).
    fn jump(&mut self, index: usize, change: f64) {
        let contact = &self.system.contacts[index];
        self.state.acceleration[contact.dofs[0]] -= change / contact.masses[0];
        self.state.acceleration[contact.dofs[1]] += change / contact.masses[1];
    }

    /// Moves on to the end of the tried step.
    fn accept(&mut self, slot: usize, end: Clock) -> Result<(), StepError> {
        self.recorder.before_step(self.system, &self.state);
        let step = self.factors[slot].coefficients.step;
        let was_closed = !self.coupling.closed.is_empty();
        let curves_start = self.state.time;
        self.gather_episodes(step);
        self.advance(slot)?;
        self.clock = end;
        self.state.time = end.time();
        self.unbalanced.clear();
        self.ground[0] = self.ground[1];
        self.finish_episodes(step, curves_start);
        self.work.steps += 1;
        self.work.contact_steps += u64::from(was_closed);
        self.recorder
            .after_step(self.system, &self.state, step, self.ground[0]);
        self.recorder.record(
            self.system,
            &self.state,
            self.ground[0],
            was_closed,
            &mut self.audit,
        );
        Ok(())
    }

    /// Displacements, velocities and accelerations at the end of the step, and the work done over it.
    fn advance(&mut self, slot: usize) -> Result<(), StepError> {
        let factors = &self.factors[slot];
        let k = factors.coefficients;
        for (building, own) in self.system.buildings.iter().zip(&factors.buildings) {
            let (range, equations) = (building.range(), &building.equations);
            let rises = &mut self.rise[range.clone()];
            let displacements = &mut self.state.displacement[range.clone()];
            let velocities = &mut self.state.velocity[range.clone()];
            let accelerations = &mut self.state.acceleration[range];
            let motion = displacements.iter_mut().zip(velocities).zip(accelerations);
            for (rise, ((u, v), a)) in rises.iter_mut().zip(motion) {
                let (v0, a0) = (*v, *a);
                let drift = k.d_v * v0 + k.d_a * a0;
                let change = *rise - own.shift * drift;
                *rise = change;
                *u += change;
                *v = v0 + k.c * change + drift;
                *a = a0 + k.a * change + (k.b_v * v0 + k.b_a * a0);
            }
            let driven_rise = lanes::dot(&equations.driven_mass, rises);
            let moved = lanes::weighted_square(&equations.mass, rises);
            if !driven_rise.is_finite() {
                return Err(StepError::NotFinite {
                    time: self.state.time,
                });
            }
            self.audit.input -= 0.5 * (self.ground[0] + self.ground[1]) * driven_rise;
            let strained = if equations.beta > 0.0 {
                equations.stiffness.quadratic_form(rises)
            } else {
                0.0
            };
            self.audit.damped += (equations.alpha * moved + equations.beta * strained) / k.step;
        }
        Ok(())
    }

    /// Before the state moves on: what every closed contact does over the step.
    fn gather_episodes(&mut self, step: f64) {
        for closed in 0..self.coupling.closed.len() {
            let index = self.coupling.closed[closed].contact;
            let ContactPhase::Closed(mut episode) = self.state.contacts[index] else {
                continue;
            };
            let (law, start) = (self.system.contacts[index].law, self.state.time);
            let curve = self.indentation_curve(index, step);
            let trial = self.trials[index];
            let force = [episode.force, trial.force];
            let mean = 0.5 * (force[0] + force[1]);
            episode.impulse += step * mean;
            let work = mean * (curve.end - curve.start);
            episode.work += work;
            self.audit.contact += work;
            let deepest = curve.peak(start, step).map_or(curve.end, |peak| peak.value);
            episode.peak_indentation = episode.peak_indentation.max(deepest);
            if force[0] > 0.0 && force[1] <= 0.0 {
                let (speed, rate) = (episode.impact_speed, |at: f64| curve.rise(at) / step);
                let at = bisect(0.0, 1.0, |at| {
                    law.respond(curve.value(at), rate(at), speed).force <= 0.0
                });
                (episode.end, episode.separation_speed) = (start + at * step, -rate(at));
            } else if force[1] > 0.0 {
                (episode.end, episode.separation_speed) = (start + step, -trial.rate);
            }
            self.state.contacts[index] = ContactPhase::Closed(episode);
            self.coupling.closed[closed].start_slope =
                self.force_slope(index, curve.start, curve.start_rise / step, &episode);
        }
    }

    /// dF/dt of a contact with the present accelerations \[N/s\].
    fn force_slope(&self, index: usize, indentation: f64, rate: f64, episode: &Episode) -> f64 {
        let contact = &self.system.contacts[index];
        let [i, j] = contact.dofs;
        let acceleration = self.state.acceleration[i] - self.state.acceleration[j];
        let response = contact.law.respond(indentation, rate, episode.impact_speed);
        response.by_indentation * rate + response.by_rate * acceleration
    }

    /// After the state has moved on: peaks of the forces, and contacts that have opened.
    fn finish_episodes(&mut self, step: f64, start: f64) {
        for closed in 0..self.coupling.closed.len() {
            let index = self.coupling.closed[closed].contact;
            let ContactPhase::Closed(mut episode) = self.state.contacts[index] else {
                continue;
            };
            let trial = self.trials[index];
            let start_slope = self.coupling.closed[closed].start_slope;
            let end_slope = self.force_slope(index, trial.indentation, trial.rate, &episode);
            let mut peak = Extreme {
                value: trial.force,
                at: start + step,
            };
            if episode.force > 0.0 && trial.force > 0.0 {
                let curve = Cubic::new(episode.force, start_slope, trial.force, end_slope, step);
                peak = curve.peak(start, step).unwrap_or(peak);
            }
            if peak.value > episode.peak_force {
                (episode.peak_force, episode.peak_force_at) = (peak.value, peak.at);
            }
            episode.force = trial.force;
            let leaving = trial.indentation <= 0.0 && trial.rate <= 0.0;
            self.state.contacts[index] =
                if leaving && !self.system.contacts[index].law.jumps_at_release() {
                    self.report_impact(index, &episode);
                    ContactPhase::Open
                } else {
                    ContactPhase::Closed(episode)
                };
        }
    }

    /// Lists an episode as an impact, if it ever pushed.
    fn report_impact(&mut self, contact: usize, episode: &Episode) {
        if episode.peak_force > 0.0 {
            self.impacts.push(Impact {
                contact,
                start: episode.since,
                end: episode.end,
                peak_force: episode.peak_force,
                peak_force_at: episode.peak_force_at,
                peak_indentation: episode.peak_indentation,
                impact_speed: episode.impact_speed,
                separation_speed: episode.separation_speed,
                impulse: episode.impulse,
                dissipated: episode.work,
            });
        }
    }
}

/// p − M a − C v − K u; empty when the state is in equilibrium to rounding.
fn unbalanced_load(system: &System, state: &State, ground: f64) -> Vec<f64> {
    let mut load = vec![0.0; system.len()];
    let mut largest = 0.0_f64;
    for building in &system.buildings {
        let (range, equations) = (building.range(), &building.equations);
        let (u, v) = (
            &state.displacement[range.clone()],
            &state.velocity[range.clone()],
        );
        let elastic: Vec<f64> = u
            .iter()
            .zip(v)
            .map(|(u, v)| u + equations.beta * v)
            .collect();
        let mut resisted = vec![0.0; elastic.len()];
        equations.stiffness.multiply_add(&elastic, &mut resisted);
        for (k, dof) in range.enumerate() {
            let inertia = equations.mass[k] * (state.acceleration[dof] + equations.alpha * v[k]);
            let driven = equations.driven_mass[k] * ground;
            load[dof] = -driven - inertia - resisted[k];
            largest = largest
                .max(driven.abs())
                .max(inertia.abs())
                .max(resisted[k].abs());
        }
    }
    if load.iter().all(|missing| missing.abs() <= 1e-15 * largest) {
        load.clear();
    }
    load
}
