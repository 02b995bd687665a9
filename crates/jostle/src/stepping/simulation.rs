//! The walk through a ground motion.

use std::ops::ControlFlow;

use super::blow::{BlowFactor, BlowScratch};
use super::clock::{Clock, Stride};
use super::coupling::ContactEquations;
use super::energy::EnergyAudit;
use super::factors::StepFactors;
use super::impacts::Landing;
use super::joints::Joints;
use super::kernels::Advance;
use super::links::Links;
use super::modal;
use super::outcome::{Accuracy, Outcome, Pounding, Progress, RunEnd, Settings, StepError};
use super::plan::Plan;
use super::recorder::Recorder;
use super::springs::YieldingSprings;
use super::trial::ContactTrial;
use super::within_tolerance::within_tolerance;
use crate::history::{Impact, Work};
use crate::model::Integrator;
use crate::model::Solver;
use crate::motion::GroundMotion;
use crate::simd;
use crate::state::{ContactPhase, State};
use crate::statics::STANDARD_GRAVITY;
use crate::stiffness::DirectStiffness;
use crate::structure::StepEquations;
use crate::system::System;
use crate::transfer::ProductEquations;
use crate::transfer::riccati::RiccatiSweep;

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
/// appears within the first step. [`Solver::Modal`] starts from rest only, and refuses every other state.
pub fn simulate_from(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    settings: Settings,
    state: State,
    mut observer: impl FnMut(Progress) -> ControlFlow<()>,
) -> Outcome {
    step_through(system, motion, plan, settings, state, &mut observer)
}

/// [`simulate_from`] for any observer. A trait object keeps stepping out of generic code, which every crate that runs a
/// simulation would compile again, without inlining the functions of this one.
fn step_through(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    settings: Settings,
    state: State,
    observer: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Outcome {
    if plan.solver != Solver::Modal
        && let Some(building) = system.buildings.iter().find(|b| b.modal_damping.is_some())
    {
        let reason = format!(
            "\"{}\" has damping in all modes, which only modal stepping knows",
            building.name
        );
        return Outcome::not_begun(system, StepError::Unsuited { reason });
    }
    match plan.solver {
        Solver::Modal if !modal::is_rest(&state) => {
            let reason = "modal stepping starts from rest".to_owned();
            Outcome::not_begun(system, StepError::Unsuited { reason })
        }
        Solver::Modal => match modal::Reduction::of(system, plan) {
            Ok(shapes) => modal::simulate(system, motion, plan, settings, &shapes, observer),
            Err(error) => Outcome::not_begun(system, error),
        },
        Solver::Riccati => {
            within_tolerance::<RiccatiSweep>(system, motion, plan, settings, state, observer)
        }
        Solver::Stiffness => {
            within_tolerance::<DirectStiffness>(system, motion, plan, settings, state, observer)
        }
        Solver::Product => {
            within_tolerance::<ProductEquations>(system, motion, plan, settings, state, observer)
        }
    }
}

/// Runs a system from rest with the steps of the plan, whatever their error.
pub(super) fn simulate_once(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    settings: Settings,
    observer: impl FnMut(Progress) -> ControlFlow<()>,
) -> Outcome {
    let rest = || State::at_rest(system, motion.acceleration(0.0));
    match plan.solver {
        Solver::Modal => simulate(system, motion, plan, settings, observer),
        Solver::Riccati => {
            Simulation::<RiccatiSweep>::new(system, motion, plan, settings, rest()).run(observer)
        }
        Solver::Stiffness => {
            Simulation::<DirectStiffness>::new(system, motion, plan, settings, rest()).run(observer)
        }
        Solver::Product => {
            Simulation::<ProductEquations>::new(system, motion, plan, settings, rest())
                .run(observer)
        }
    }
}

pub(super) struct Simulation<'a, E: StepEquations> {
    pub(super) system: &'a System,
    pub(super) motion: &'a GroundMotion,
    pub(super) plan: &'a Plan,
    pub(super) pounding: bool,
    pub(super) equations: Vec<E>,
    /// The first serves steps off the grid, the others one division of the free-flight step each.
    pub(super) factors: Vec<StepFactors<E>>,
    pub(super) divisions: Vec<u32>,
    pub(super) state: State,
    pub(super) clock: Clock,
    /// Ground acceleration now and at the end of the tried step.
    pub(super) ground: [f64; 2],
    /// Load that the initial state leaves unbalanced; empty once it has been applied.
    pub(super) unbalanced: Vec<f64>,
    /// The tried step: first the load, then y, then the displacement over the step.
    pub(super) rise: Vec<f64>,
    /// D′ of one building, for what K′ and C′ make of it.
    pub(super) drift: Vec<f64>,
    pub(super) yielding: YieldingSprings,
    pub(super) joints: Joints,
    pub(super) links: Links,
    /// Of contacts, then of links.
    pub(super) trials: Vec<ContactTrial>,
    pub(super) contact_division: Vec<u32>,
    /// Greatest force of every gap so far, measured or expected of an impact under way \[N\].
    pub(super) strongest: Vec<f64>,
    pub(super) coupling: ContactEquations,
    /// For sudden changes of velocity, factorised when first needed.
    pub(super) blows: Vec<Option<BlowFactor<E>>>,
    pub(super) blow: BlowScratch,
    pub(super) finest_in_contact: u32,
    pub(super) impacts: Vec<Impact>,
    pub(super) audit: EnergyAudit,
    pub(super) work: Work,
    pub(super) recorder: Recorder,
}

/// Steps between calls of the observer.
const OBSERVED_EVERY: u64 = 256;
/// How much of a step is tried before it is given up.
const SHORTEST_TRIED: f64 = 1e-6;
/// Events without progress before a run gives up.
const MOST_EVENTS_AT_ONCE: usize = 1000;
/// Storey drift from which a building that yields or leans has collapsed \[–\].
const COLLAPSE_DRIFT: f64 = 0.25;

impl<'a, E: StepEquations> Simulation<'a, E> {
    pub(super) fn new(
        system: &'a System,
        motion: &'a GroundMotion,
        plan: &'a Plan,
        settings: Settings,
        state: State,
    ) -> Self {
        let ground = motion.acceleration(0.0);
        let joints = Joints::of(system);
        let links = Links::starting_from(system, &state);
        let steps = motion.duration / plan.step;
        let mut recorder = Recorder::new(system, motion.duration, settings.record_interval);
        let rows = settings
            .record_interval
            .map_or(0.0, |interval| motion.duration / plan.step.max(interval));
        recorder.reserve((1.2 * rows.min(steps) + 100.0).min(1e6) as usize);
        Self {
            system,
            motion,
            plan,
            pounding: settings.pounding == Pounding::Included,
            equations: system
                .buildings
                .iter()
                .map(|building| E::new(building))
                .collect(),
            factors: vec![StepFactors::blank(system, &joints)],
            divisions: vec![0],
            clock: Clock::new(plan.step),
            ground: [ground, ground],
            unbalanced: unbalanced_load(system, &state, &links, ground, plan.integrator),
            rise: vec![0.0; system.len()],
            drift: vec![0.0; system.len()],
            trials: vec![ContactTrial::default(); system.contacts.len() + system.links.len()],
            joints,
            links,
            contact_division: vec![1; system.contacts.len()],
            strongest: vec![0.0; system.contacts.iter().map(|c| c.gap + 1).max().unwrap_or(0)],
            coupling: ContactEquations::default(),
            blows: system.buildings.iter().map(|_| None).collect(),
            blow: BlowScratch::for_buildings(system),
            finest_in_contact: 0,
            impacts: Vec::new(),
            audit: EnergyAudit::starting_from(system, &state),
            yielding: YieldingSprings::starting_from(system, &state),
            work: Work::default(),
            recorder,
            state,
        }
    }

    pub(super) fn run(mut self, mut observer: impl FnMut(Progress) -> ControlFlow<()>) -> Outcome {
        let duration = self.motion.duration;
        let links = &self.links.forces;
        self.recorder
            .members
            .take(self.system, &self.state, links, self.ground[0]);
        self.recorder.record(
            self.system,
            &self.state,
            &self.links.forces,
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
                self.report_impact(index, &episode, false);
            }
        }
        let energy = self.audit.balance(self.system, &self.state);
        let contact_step = Some(self.finest_in_contact)
            .filter(|d| *d > 0)
            .map(|d| self.plan.step / f64::from(d));
        let residual = self.plan.frequency_error(self.system, self.motion);
        let accuracy = residual.map(|residual| Accuracy {
            tolerance: self.plan.tolerance(),
            residual,
            doubtful_from: None,
            sensitive_from: None,
        });
        Outcome {
            impacts: self.impacts,
            floors: std::mem::take(&mut self.recorder.floors),
            closing: std::mem::take(&mut self.recorder.closing),
            base_shear: std::mem::take(&mut self.recorder.base_shear),
            acceleration_parts: std::mem::take(&mut self.recorder.parts),
            spring_history: self.recorder.springs.take(),
            members: std::mem::take(&mut self.recorder.members.extremes),
            member_history: self.recorder.members.history.take(),
            history: self.recorder.into_history(),
            spring_events: self.yielding.events,
            springs: self.yielding.totals,
            links: self.links.totals,
            energy,
            work: Work {
                coupling_operations: self.coupling.operations,
                ..self.work
            },
            free_step: Some(self.plan.step),
            contact_step,
            state: self.state,
            accuracy,
            end,
        }
    }

    /// One accepted step, ending on the grid or on the first event in between.
    fn step(&mut self) -> Result<(), StepError> {
        for _ in 0..MOST_EVENTS_AT_ONCE {
            let (slot, stride) = self.try_next_stride()?;
            let Some(event) = self.first_event(stride.length) else {
                return self.accept(slot, stride.end);
            };
            self.work.repeated_steps += 1;
            if event.at * stride.length > self.shortest_step(&event) {
                match self.step_to(event, &stride)? {
                    Landing::Later => return Ok(()),
                    Landing::AtStart => continue,
                }
            }
            self.read_contacts();
            self.happen(event);
        }
        Err(StepError::Chattering {
            time: self.state.time,
        })
    }

    /// Tries the next step; where contact forces or springs that yield do not converge, half of it, and so on.
    fn try_next_stride(&mut self) -> Result<(usize, Stride), StepError> {
        let mut stride = self.next_stride();
        let shortest = stride.length * SHORTEST_TRIED;
        loop {
            let tried = match self.factors_for(&stride) {
                Ok(slot) => self.try_step(slot, stride.end).map(|()| slot),
                Err(error) => Err(error),
            };
            match tried {
                Err(
                    StepError::ContactDiverged { .. }
                    | StepError::SpringsDiverged { .. }
                    | StepError::NotPositive { .. },
                ) if stride.length > shortest => {
                    self.work.halved_steps += 1;
                    let length = 0.5 * stride.length;
                    stride = Stride {
                        length,
                        regular: false,
                        end: self.clock.after(length),
                    };
                }
                tried => return tried.map(|slot| (slot, stride)),
            }
        }
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
    pub(super) fn division(&self) -> u32 {
        let closed = self.state.contacts.iter().zip(&self.contact_division);
        closed
            .filter(|(phase, _)| matches!(phase, ContactPhase::Closed(_)))
            .map(|(_, d)| *d)
            .max()
            .unwrap_or(1)
    }

    fn factors_for(&mut self, stride: &Stride) -> Result<usize, StepError> {
        if !stride.regular {
            return self.factorize(0, stride.length).map(|()| 0);
        }
        let division = self.division();
        if let Some(slot) = self.divisions.iter().position(|d| *d == division) {
            return Ok(slot);
        }
        self.factors
            .push(StepFactors::blank(self.system, &self.joints));
        self.divisions.push(division);
        let slot = self.factors.len() - 1;
        let factorized = self.factorize(slot, stride.length);
        if factorized.is_err() {
            self.factors.pop();
            self.divisions.pop();
        }
        factorized.map(|()| slot)
    }

    pub(super) fn factorize(&mut self, slot: usize, step: f64) -> Result<(), StepError> {
        self.factors[slot]
            .set_step(
                self.plan.integrator,
                step,
                self.system,
                &self.equations,
                &self.yielding.tangents,
                &mut self.work,
            )
            .map_err(|(building, source)| StepError::NotPositive {
                building: self.system.buildings[building].name.clone(),
                time: self.state.time,
                source,
            })
    }

    /// Moves on to the end of the tried step.
    pub(super) fn accept(&mut self, slot: usize, end: Clock) -> Result<(), StepError> {
        self.recorder.before_step(self.system, &self.state);
        let step = self.factors[slot].coefficients.step;
        let was_closed = self.in_contact();
        let curves_start = self.state.time;
        self.gather_episodes(step);
        self.gather_links(step);
        self.carry_unbalanced(slot);
        self.advance(slot)?;
        self.clock = end;
        self.state.time = end.time();
        self.commit_springs();
        self.ground[0] = self.ground[1];
        self.finish_episodes(step, curves_start);
        self.work.steps += 1;
        self.work.contact_steps += u64::from(was_closed);
        self.recorder
            .after_step(self.system, &self.state, step, self.ground[0]);
        let links = &self.links.forces;
        self.recorder
            .members
            .take(self.system, &self.state, links, self.ground[0]);
        self.recorder.record(
            self.system,
            &self.state,
            &self.links.forces,
            self.ground[0],
            was_closed,
            &mut self.audit,
        );
        self.check_collapse()
    }

    /// Elastic buildings may lean as far as they like: their numbers are those of their model.
    fn check_collapse(&self) -> Result<(), StepError> {
        for (building, floors) in self.system.buildings.iter().zip(&self.recorder.floors) {
            if building.equations.springs.is_empty() {
                continue;
            }
            let worst = floors
                .iter()
                .enumerate()
                .max_by(|a, b| a.1.storey_drift.total_cmp(&b.1.storey_drift));
            if let Some((storey, peaks)) = worst.filter(|(_, p)| p.storey_drift > COLLAPSE_DRIFT) {
                return Err(StepError::Collapse {
                    building: building.name.clone(),
                    storey: storey + 1,
                    drift: peaks.storey_drift,
                    time: self.state.time,
                });
            }
        }
        Ok(())
    }

    /// What will be out of balance at the end of the step (theory, Eq. N4): nothing, unless equilibrium is shifted.
    fn carry_unbalanced(&mut self, slot: usize) {
        if self.plan.integrator.balances_at_ends() {
            self.unbalanced.clear();
            return;
        }
        let factors = &self.factors[slot];
        let k = factors.coefficients;
        for (building, own) in self.system.buildings.iter().zip(&factors.buildings) {
            for (dof, mass) in building.range().zip(&building.equations.mass) {
                let (v, a) = (self.state.velocity[dof], self.state.acceleration[dof]);
                let change = self.rise[dof] - own.shift * (k.d_v * v + k.d_a * a);
                let gained = k.a * change + k.b_v * v + k.b_a * a;
                self.unbalanced[dof] = k.carried * self.unbalanced[dof] + k.left * mass * gained;
            }
        }
    }

    /// Displacements, velocities and accelerations at the end of the step, and the work done over it.
    fn advance(&mut self, slot: usize) -> Result<(), StepError> {
        let factors = &self.factors[slot];
        let k = factors.coefficients;
        for (building, own) in self.system.buildings.iter().zip(&factors.buildings) {
            let (range, equations) = (building.range(), &building.equations);
            let rises = &mut self.rise[range.clone()];
            let advance = Advance {
                equations,
                k: &k,
                shift: own.shift,
                rise: rises,
                displacement: &mut self.state.displacement[range.clone()],
                velocity: &mut self.state.velocity[range.clone()],
                acceleration: &mut self.state.acceleration[range.clone()],
            };
            let [driven_rise, moved] = simd::in_wide_registers(range.len(), advance);
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
            if !equations.plain {
                self.audit.damped += equations.dashpots.quadratic_form(rises) / k.step;
            }
            if !building.rest.displacement.is_empty() {
                let sunk = simd::dot(&equations.vertical_mass, rises);
                self.audit.input -= STANDARD_GRAVITY * sunk;
            }
        }
        Ok(())
    }
}

/// p − M a − C v − K u less the forces of links; empty when the state is in equilibrium to rounding and will stay so at the ends of steps.
fn unbalanced_load(
    system: &System,
    state: &State,
    links: &Links,
    ground: f64,
    integrator: Integrator,
) -> Vec<f64> {
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
        equations.undamped.multiply_add(u, &mut resisted);
        equations.dashpots.multiply_add(v, &mut resisted);
        let springs = equations.springs.iter();
        for (spring, memory) in springs.zip(&state.springs[building.spring_range()]) {
            spring.push(memory.force(), &mut resisted);
        }
        for (k, dof) in range.enumerate() {
            let inertia = equations.mass[k] * (state.acceleration[dof] + equations.alpha * v[k]);
            let weight = if building.rest.displacement.is_empty() {
                0.0
            } else {
                STANDARD_GRAVITY * equations.vertical_mass[k]
            };
            let driven = equations.driven_mass[k] * ground + weight;
            load[dof] = -driven - inertia - resisted[k];
            largest = largest
                .max(driven.abs())
                .max(inertia.abs())
                .max(resisted[k].abs());
        }
    }
    for (link, force) in system.links.iter().zip(&links.forces) {
        link.faces.push_apart(*force, &mut load);
        largest = largest.max(force.abs());
    }
    // Statics leave rounding behind.
    let rounding = if system
        .buildings
        .iter()
        .any(|building| !building.rest.displacement.is_empty())
    {
        1e-9
    } else {
        1e-15
    };
    if load
        .iter()
        .all(|missing| missing.abs() <= rounding * largest)
    {
        if integrator.balances_at_ends() {
            load.clear();
        } else {
            load.fill(0.0);
        }
    }
    load
}
