//! Stepping of all degrees of freedom, building by building (theory, Eqs. N2 to N4).

mod factors;
mod falling_panels;
mod friction;
mod integrator;
mod joints;
mod kernels;
mod links;
mod plan_forces;
mod solver;
mod springs;
mod tangent_damping;
mod trial;
mod velocity_jump;
mod within_tolerance;

pub(super) use within_tolerance::{longest, within_tolerance};

use std::ops::Range;

use crate::history::MemberHistory;
use crate::interface::PortPair;
use crate::model::Integrator;
use crate::motion::{Ground, GroundMotion};
use crate::simd;
use crate::state::{ContactPhase, Episode, State};
use crate::statics::STANDARD_GRAVITY;
use crate::stepping::clock::{Clock, NextStep};
use crate::stepping::collapse::check_collapse;
use crate::stepping::control::{Observed, half_cycle, next_division};
use crate::stepping::energy::EnergyAudit;
use crate::stepping::events::Cubic;
use crate::stepping::gap_forces::StepForce;
use crate::stepping::member_peaks::MemberPeaks;
use crate::stepping::observe::{Observer, Reached};
use crate::stepping::outcome::{Accuracy, OnProgress, Outcome, RunEnd, Settings, StepError};
use crate::stepping::plan::Plan;
use crate::stepping::recorder::{Instant, Recorder};
use crate::stepping::runner::{ContactTrial, Jump, LinkTouch, RunState, Runner, Stepper};
use crate::stepping::step_friction::FrictionPath;
use crate::stepping::totals::{columns_of_links, columns_of_springs};
use crate::system::System;
use crate::transfer::riccati::RiccatiScratch;
use factors::StepFactors;
use joints::Joints;
use kernels::Advance;
use links::Links;
use solver::SolverEquations;
use springs::YieldingSprings;
use velocity_jump::{JumpFactor, JumpScratch};

/// Runs a system with the steps of the plan, without an estimate of the error.
pub(super) fn run_directly(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    settings: Settings,
    state: State,
    on_progress: &mut OnProgress<'_>,
) -> Outcome {
    let mut run = RunState::new(system, motion, plan, settings);
    run.time = state.time;
    run.take_contacts(&state);
    let stepper = Direct::new(&run, settings, state);
    let mut runner = Runner { run, stepper };
    let end = runner.run_to_end(on_progress);
    runner.report_unfinished_impacts();
    let Runner { run, stepper } = runner;
    stepper.into_outcome(run, end)
}

/// All degrees of freedom of all buildings, and how their steps are solved.
pub(super) struct Direct {
    equations: Vec<SolverEquations>,
    scratch: RiccatiScratch,
    /// The first serves steps off the grid, the others one division of the free-vibration step each.
    factors: Vec<StepFactors>,
    divisions: Vec<u32>,
    /// Displacements, velocities, accelerations and springs; time and contacts are those of the run.
    state: State,
    /// Load that the initial state leaves unbalanced; empty once it has been applied.
    unbalanced: Vec<f64>,
    /// The tried step: first the load, then y, then the displacement over the step.
    increment: Vec<f64>,
    /// D′ of one building, for what K′ and C′ make of it.
    rate_term: Vec<f64>,
    yielding: YieldingSprings,
    joints: Joints,
    links: Links,
    /// For sudden changes of velocity, factorised when first needed.
    jump_factors: Vec<Option<JumpFactor>>,
    jump: JumpScratch,
    audit: EnergyAudit,
    recorder: Recorder,
    members: MemberPeaks,
    observer: Observer,
    /// Slot of the step tried last.
    tried: usize,
    /// Short steps left after a jump of velocities.
    struck_steps: u32,
    /// How far corners are inside of the ends of edges at the end of the tried step, and its rate \[m, m/s\].
    edge_ends: Vec<[f64; 2]>,
    /// Ends of the edge that the corner of every contact touches.
    ends_of: Vec<Range<usize>>,
    /// Friction over the tried step, contact by contact that has any.
    friction_paths: Vec<FrictionPath>,
}

/// Parts of a free-vibration step after a jump of velocities, and the number of such steps. Average acceleration turns
/// what dashpots take within a step into an oscillation of accelerations from step to step, which decays slowly.
const AFTER_JUMP: u32 = 64;

impl Direct {
    fn new(run: &RunState<'_>, settings: Settings, state: State) -> Self {
        let (system, motion, plan) = (run.system, run.motion, run.plan);
        let joints = Joints::new(system);
        let links = Links::starting_from(system, &state);
        let steps = motion.duration / plan.step;
        let mut recorder = Recorder::new(system, &run.grounds, settings);
        let mut members = MemberPeaks::new(system, settings);
        let rows = settings
            .record_interval
            .map_or(0.0, |interval| motion.duration / plan.step.max(interval));
        let rows = (1.2 * rows.min(steps) + 100.0).min(1e6) as usize;
        recorder.reserve(rows);
        members.reserve(rows);
        let buildings = system.buildings.iter();
        Self {
            equations: buildings
                .map(|building| SolverEquations::new(plan.solver, building))
                .collect(),
            scratch: RiccatiScratch::default(),
            factors: vec![StepFactors::blank(system, &joints)],
            divisions: vec![0],
            unbalanced: unbalanced_load(run, &state, &links, plan.integrator),
            increment: vec![0.0; system.len()],
            rate_term: vec![0.0; system.len()],
            joints,
            links,
            jump_factors: system.buildings.iter().map(|_| None).collect(),
            jump: JumpScratch::for_buildings(system),
            audit: EnergyAudit::starting_from(system, &state, &run.grounds),
            yielding: YieldingSprings::starting_from(system, &state),
            recorder,
            members,
            observer: Observer::new(system, motion.duration, plan.vertical.then_some(&state)),
            state,
            tried: 0,
            struck_steps: 0,
            edge_ends: vec![[0.0; 2]; system.edge_ends.len()],
            ends_of: system.edge_ends_of_contacts(),
            friction_paths: vec![FrictionPath::default(); system.frictions().count()],
        }
    }

    fn into_outcome(mut self, mut run: RunState<'_>, end: RunEnd) -> Outcome {
        let energy = self.audit.balance(run.system, &self.state, &run.grounds);
        let contact_step = Some(run.finest_in_contact)
            .filter(|d| *d > 0)
            .map(|d| run.plan.step / f64::from(d));
        let residual = run.plan.frequency_error(run.system, run.motion);
        let accuracy = residual.map(|residual| Accuracy {
            tolerance: run.plan.tolerance(),
            residual,
            doubtful_from: None,
            sensitive_from: None,
        });
        self.state.time = run.time;
        self.state.contacts = std::mem::take(&mut run.phases);
        self.state.crushed = std::mem::take(&mut run.crushed);
        run.work.coupling_operations = run.coupling.operations;
        let acceleration_parts = std::mem::take(&mut self.observer.parts);
        let mut peaks = self.observer.finish();
        peaks.extend(columns_of_links(&self.links.totals));
        peaks.extend(columns_of_springs(&self.yielding.totals));
        let free_step = Some(run.plan.step);
        Outcome {
            acceleration_parts,
            spring_history: self.recorder.springs.take(),
            members: self.members.extremes,
            member_history: self.members.history,
            member_ratios: self.members.ratios.greatest,
            worst_instants: self.members.ratios.worst,
            history: self.recorder.into_history(),
            spring_events: self.yielding.events,
            energy,
            free_step,
            contact_step,
            state: self.state,
            accuracy,
            ..run.into_outcome(peaks, end)
        }
    }

    /// Forces of columns and beams now, where they are asked for.
    fn follow_members(&mut self, run: &RunState<'_>) {
        if self.members.is_asked() {
            self.state.contacts.clone_from(&run.phases);
            self.state.crushed.clone_from(&run.crushed);
            let (links, ground) = (&self.links.forces, run.grounds_at(0));
            let state = &self.state;
            self.members.take(run.system, state, links, ground);
        }
    }

    /// A row of the history, where one is due.
    fn record(&mut self, run: &RunState<'_>, wanted: bool) {
        if self.recorder.is_due(run.time, wanted) {
            self.members.record(run.system, self.state.time);
        }
        let instant = Instant {
            state: &self.state,
            contacts: &run.phases,
            links: &self.links.forces,
            grounds: &run.grounds,
            ground: run.grounds_at(0),
        };
        self.recorder
            .record(run.system, &instant, wanted, &mut self.audit);
    }

    fn factorize(
        &mut self,
        run: &mut RunState<'_>,
        slot: usize,
        step: f64,
    ) -> Result<(), StepError> {
        let tangents = &self.yielding.tangents;
        self.factors[slot]
            .set_step(
                run.plan.integrator,
                step,
                run.system,
                &self.equations,
                tangents,
                &mut run.work,
            )
            .map_err(|(building, source)| self.not_positive(run, building, source))
    }

    /// Rate of change of the closing rate of a contact \[m/s²\].
    fn relative_acceleration(&self, run: &RunState<'_>, contact: usize) -> f64 {
        let ports = &run.system.contacts[contact].ports;
        ports.closing(&self.state.acceleration) + run.grounds.closing(contact, 0)[2]
    }

    /// dF/dt of a contact with the present accelerations \[N/s\].
    fn force_slope(
        &self,
        run: &RunState<'_>,
        contact: usize,
        indentation: f64,
        rate: f64,
        episode: &Episode,
    ) -> f64 {
        let acceleration = self.relative_acceleration(run, contact);
        let law = &run.system.contacts[contact].law;
        let response = law.follow(indentation, rate, &episode.memory);
        response.by_indentation * rate + response.by_rate * acceleration
    }

    /// M Δa of a force that separates two points \[N\].
    fn push_accelerations(&mut self, run: &RunState<'_>, ports: &PortPair, change: f64) {
        for (port, sign) in ports.sides() {
            let building = &run.system.buildings[port.building];
            for &(dof, share) in port.row.entries() {
                let mass = building.equations.mass[dof - building.offset];
                self.state.acceleration[dof] += share * sign * change / mass;
            }
        }
    }

    /// What will be out of balance at the end of the step (theory, Eq. N4): nothing, unless equilibrium is shifted.
    fn carry_unbalanced(&mut self, run: &RunState<'_>, slot: usize) {
        if run.plan.integrator.balances_at_ends() {
            self.unbalanced.clear();
            return;
        }
        let factors = &self.factors[slot];
        let k = factors.coefficients;
        for (building, coefficients) in run.system.buildings.iter().zip(&factors.buildings) {
            for (dof, mass) in building.range().zip(&building.equations.mass) {
                let (v, a) = (self.state.velocity[dof], self.state.acceleration[dof]);
                let change = self.increment[dof] - coefficients.shift * (k.d_v * v + k.d_a * a);
                let gained = k.a * change + k.b_v * v + k.b_a * a;
                self.unbalanced[dof] = k.carried * self.unbalanced[dof] + k.left * mass * gained;
            }
        }
    }

    /// Displacements, velocities and accelerations at the end of the step, and the work done over it.
    fn move_to_end(&mut self, run: &RunState<'_>, slot: usize) -> Result<(), StepError> {
        let factors = &self.factors[slot];
        let k = factors.coefficients;
        let [now, end] = [0, 1].map(|time| run.grounds_at(time));
        let buildings = run.system.buildings.iter().zip(&factors.buildings);
        for (index, (building, coefficients)) in buildings.enumerate() {
            let (range, equations) = (building.range(), &building.equations);
            let rises = &mut self.increment[range.clone()];
            let advance = Advance {
                equations,
                k: &k,
                shift: coefficients.shift,
                increment: rises,
                displacement: &mut self.state.displacement[range.clone()],
                velocity: &mut self.state.velocity[range.clone()],
                acceleration: &mut self.state.acceleration[range.clone()],
            };
            let [driven_rise, moved] = simd::in_wide_registers(range.len(), advance);
            if !driven_rise.is_finite() {
                return Err(StepError::NotFinite { time: run.time });
            }
            let [now, end] = [now, end].map(|ground| ground.of(index));
            self.audit.input -= 0.5 * (now[0] + end[0]) * driven_rise;
            for axis in [1, 2] {
                let mean = 0.5 * (now[axis] + end[axis]);
                if mean != 0.0 {
                    self.audit.input -= mean * simd::dot(equations.driven()[axis], rises);
                }
            }
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
                let sunk = simd::dot(&equations.weighing_mass, rises);
                self.audit.weight -= STANDARD_GRAVITY * sunk;
            }
        }
        Ok(())
    }
}

impl Stepper for Direct {
    /// Where steps follow from the tolerance: without them, accelerations with a peak at a corner would be of first order. Not
    /// where buildings yield, whose forces have corners of their own.
    fn ends_steps_at_corners(&self, run: &RunState<'_>) -> bool {
        run.plan.chooses_contact_steps() && self.state.springs.is_empty()
    }

    fn record_start(&mut self, run: &mut RunState<'_>) {
        self.follow_members(run);
        self.record(run, true);
    }

    fn history_fault(&self) -> Option<&str> {
        let members = self.members.history.as_ref();
        let members = members.and_then(MemberHistory::unstored);
        self.recorder.unstored().or(members)
    }

    fn closing(&self, run: &RunState<'_>, contact: usize) -> f64 {
        let ports = &run.system.contacts[contact].ports;
        ports.closing(&self.state.displacement) + run.grounds.closing(contact, 0)[0]
    }

    fn closing_rate(&self, run: &RunState<'_>, contact: usize) -> f64 {
        let ports = &run.system.contacts[contact].ports;
        ports.closing(&self.state.velocity) + run.grounds.closing(contact, 0)[1]
    }

    fn edge_ends(&self, contact: usize) -> Range<usize> {
        self.ends_of[contact].clone()
    }

    fn edge_end(&self, run: &RunState<'_>, end: usize, tried: bool) -> [f64; 2] {
        if tried {
            return self.edge_ends[end];
        }
        let edge_end = &run.system.edge_ends[end];
        let (u, v) = (&self.state.displacement, &self.state.velocity);
        let [moved, rate, _] = run.grounds.closing(self.joints.of_end(end), 0);
        [
            edge_end.inside + edge_end.ports.closing(u) + moved,
            edge_end.ports.closing(v) + rate,
        ]
    }

    fn division(&self, run: &RunState<'_>) -> u32 {
        let closed = run.phases.iter().zip(&run.contact_division);
        let after_jump = if self.struck_steps > 0 { AFTER_JUMP } else { 1 };
        closed
            .filter(|(phase, _)| matches!(phase, ContactPhase::Closed(_)))
            .map(|(_, d)| *d)
            .fold(after_jump, u32::max)
    }

    fn prepare(&mut self, run: &mut RunState<'_>, next: &NextStep) -> Result<usize, StepError> {
        if !next.regular {
            return self.factorize(run, 0, next.length).map(|()| 0);
        }
        let division = self.division(run);
        if let Some(slot) = self.divisions.iter().position(|d| *d == division) {
            return Ok(slot);
        }
        self.factors
            .push(StepFactors::blank(run.system, &self.joints));
        self.divisions.push(division);
        let slot = self.factors.len() - 1;
        let factorized = self.factorize(run, slot, next.length);
        if factorized.is_err() {
            self.factors.pop();
            self.divisions.pop();
        }
        factorized.map(|()| slot)
    }

    fn prepare_length(&mut self, run: &mut RunState<'_>, length: f64) -> Result<(), StepError> {
        self.factorize(run, 0, length)
    }

    fn length(&self, slot: usize) -> f64 {
        self.factors[slot].coefficients.step
    }

    fn try_step(
        &mut self,
        run: &mut RunState<'_>,
        slot: usize,
        end: Clock,
    ) -> Result<(), StepError> {
        self.tried = slot;
        self.solve_step(run, slot, end)
    }

    fn link_touch(&self, run: &RunState<'_>, step: f64) -> Option<LinkTouch> {
        self.first_link_touch(run, step)
    }

    fn link_overlap(&self, run: &RunState<'_>, link: usize) -> [f64; 2] {
        self.overlap_at_end(run, link)
    }

    fn begin_link_force(&mut self, run: &RunState<'_>, link: usize) -> bool {
        self.begin_dashpot(run, link)
    }

    fn sudden_change(&self, run: &RunState<'_>, step: f64) -> Option<f64> {
        let changes = [self.first_damping_jump(run, step), self.first_fall(run)];
        changes.into_iter().flatten().reduce(f64::min)
    }

    fn make_sudden_changes(&mut self, run: &RunState<'_>) {
        self.drop_panels(run);
        self.jump_dashpots(run);
    }

    fn before_step(&mut self, run: &mut RunState<'_>, _: f64) {
        self.observer
            .before_step(run.system, &self.state, &run.grounds);
    }

    fn gather(
        &mut self,
        run: &mut RunState<'_>,
        closed: usize,
        episode: &mut Episode,
        curve: &Cubic,
        step: f64,
    ) {
        let index = run.coupling.closed[closed].contact;
        let mean = 0.5 * (episode.force + run.trials[index].force);
        episode.impulse += step * mean;
        let work = mean * (curve.end - curve.start);
        episode.work += work;
        self.audit.contact += work;
        self.audit.ground += mean * moved_by_grounds(run, index);
        self.gather_friction(run, index, episode, step);
        let acceleration = self.relative_acceleration(run, index);
        let slope = self.force_slope(run, index, curve.start, curve.start_rise / step, episode);
        let closed = &mut run.coupling.closed[closed];
        (closed.start_acceleration, closed.start_slope) = (acceleration, slope);
    }

    fn advance(&mut self, run: &mut RunState<'_>, slot: usize) -> Result<(), StepError> {
        self.gather_links(run, self.length(slot));
        self.carry_unbalanced(run, slot);
        self.move_to_end(run, slot)
    }

    fn arrive(&mut self, run: &mut RunState<'_>, _: usize) {
        self.state.time = run.time;
        self.commit_springs(run);
    }

    fn end_slope(
        &mut self,
        run: &RunState<'_>,
        contact: usize,
        trial: &ContactTrial,
        episode: &Episode,
        _: f64,
    ) -> f64 {
        self.force_slope(run, contact, trial.indentation, trial.rate, episode)
    }

    /// Finer steps where the error of this one endangers the tolerance, coarser ones where the grid allows and the error is
    /// far below.
    ///
    /// The trapezoidal rule misses h² Δa/12 of a displacement in a step. Over the π/(ωh) steps of half a cycle at the
    /// present contact stiffness, ω² = F′/m, that is an error of the force of F′ h² |Δa|/12 · π/(ωh), relative to the
    /// greatest force of the gap.
    fn next_division(
        &self,
        run: &RunState<'_>,
        closed: usize,
        episode: &Episode,
        _: f64,
        step: f64,
    ) -> u32 {
        let closed = &run.coupling.closed[closed];
        let index = closed.contact;
        let contact = &run.system.contacts[index];
        let strongest = run.strongest[contact.gap];
        let trial = run.trials[index];
        let law = &contact.law;
        let response = law.follow(trial.indentation, trial.rate, &episode.memory);
        let stiffness = response.by_indentation;
        let half_cycle = half_cycle(contact, stiffness);
        let change = self.relative_acceleration(run, index) - closed.start_acceleration;
        let observed = Observed {
            step,
            stiffness,
            damping: 0.0,
            error: stiffness * step * change.abs() / 12.0 * half_cycle / strongest,
            order: 2,
        };
        let division = run.contact_division[index];
        next_division(run.plan, contact, &observed, division, &run.clock)
    }

    fn after_step(
        &mut self,
        run: &mut RunState<'_>,
        _: f64,
        step: f64,
        _: [Ground; 2],
        was_closed: bool,
    ) -> Result<(), StepError> {
        self.struck_steps = self.struck_steps.saturating_sub(1);
        let reached = Reached {
            state: &self.state,
            links: &self.links.forces,
            grounds: &run.grounds,
            ground: run.grounds_at(0),
        };
        self.observer.after_step(run.system, &reached, step);
        self.follow_members(run);
        self.record(run, was_closed);
        check_collapse(run, |building| self.observer.drifts(building))
    }

    fn slip(&self, run: &RunState<'_>, contact: usize) -> [f64; 2] {
        self.slip_now(run, contact)
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

    fn change_friction(&mut self, run: &RunState<'_>, contact: usize, change: f64) {
        if let Some(friction) = &run.system.contacts[contact].friction {
            self.push_accelerations(run, &friction.ports, change);
        }
    }

    /// Changes the accelerations of the two faces (theory, Eq. H2).
    fn change_force(&mut self, run: &RunState<'_>, contact: usize, change: f64) {
        self.push_accelerations(run, &run.system.contacts[contact].ports, change);
    }

    fn jump_velocities(
        &mut self,
        run: &mut RunState<'_>,
        contact: usize,
        restitution: f64,
        rate: f64,
    ) -> Jump {
        if run.plan.chooses_contact_steps() {
            self.struck_steps = AFTER_JUMP;
        }
        self.strike(run, contact, restitution, rate)
    }

    fn after_event(&mut self, run: &RunState<'_>) {
        let ground = run.grounds_at(0);
        self.observer.after_jump(&self.state, ground);
    }

    /// Buildings stay behind: M Δa = −M r Δa_g.
    fn change_ground(&mut self, run: &RunState<'_>, building: usize, change: Ground) {
        let building = &run.system.buildings[building];
        building
            .equations
            .stay_behind(change, &mut self.state.acceleration[building.range()]);
    }
}

/// How much closer the grounds of a joint have moved over the tried step \[m\].
fn moved_by_grounds(run: &RunState<'_>, joint: usize) -> f64 {
    run.grounds.closing(joint, 1)[0] - run.grounds.closing(joint, 0)[0]
}

/// p − M a − C v − K u less the forces of links; empty when the state is in equilibrium to rounding and will stay so at the ends of steps.
fn unbalanced_load(
    run: &RunState<'_>,
    state: &State,
    links: &Links,
    integrator: Integrator,
) -> Vec<f64> {
    let (system, grounds) = (run.system, run.grounds_at(0));
    let mut load = vec![0.0; system.len()];
    let mut largest = 0.0_f64;
    for (index, building) in system.buildings.iter().enumerate() {
        let [along, across, up] = grounds.of(index);
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
            let damped = equations.tangent_damping(spring, memory, v);
            spring.row.push(memory.force() + damped, &mut resisted);
        }
        for (k, dof) in range.enumerate() {
            let inertia = equations.mass[k] * (state.acceleration[dof] + equations.alpha * v[k]);
            let weight = if building.rest.displacement.is_empty() {
                0.0
            } else {
                STANDARD_GRAVITY * equations.weighing_mass[k]
            } + up * equations.vertical_mass[k];
            let across = match equations.driven_across.get(k) {
                Some(driven) => driven * across,
                None => 0.0,
            };
            let driven = equations.driven_mass[k] * along + weight + across;
            load[dof] = -driven - inertia - resisted[k];
            largest = largest
                .max(driven.abs())
                .max(inertia.abs())
                .max(resisted[k].abs());
        }
    }
    for (link, force) in system.links.iter().zip(&links.forces) {
        link.ports.push_apart(*force, &mut load);
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
