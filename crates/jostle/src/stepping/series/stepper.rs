//! Stepping by power series.

use super::building_motion::{BuildingMotion, GAUSS, GroundLine};
use super::peaks::SeriesPeaks;
use super::push::Push;
use crate::contact::momentum;
use crate::history::SpringEvent;
use crate::hysteresis::Stage;
use crate::interface::InterfaceGraph;
use crate::motion::{Ground, GroundMotion};
use crate::simd;
use crate::state::{Episode, State};
use crate::stepping::clock::{Clock, NextStep};
use crate::stepping::collapse::check_collapse;
use crate::stepping::contact_parabola;
use crate::stepping::energy::EnergyAudit;
use crate::stepping::events::Cubic;
use crate::stepping::extremes::greatest_in_step;
use crate::stepping::force_equations::ForceEquations;
use crate::stepping::member_ratios::MemberRatios;
use crate::stepping::near_contacts::{self, NearContacts, Touch};
use crate::stepping::outcome::{Accuracy, OnProgress, Outcome, RunEnd, Settings, StepError};
use crate::stepping::plan::Plan;
use crate::stepping::predicted_force::{AHEAD, PredictedForce};
use crate::stepping::recorder::{Instant, Recorder};
use crate::stepping::runner::{ContactTrial, Jump, RunState, Runner, Stepper};
use crate::stepping::sensitivity::closing_scale;
use crate::stepping::totals::SpringTotals;
use crate::system::System;

/// Displacements of all buildings, and their motion over the tried step.
pub(super) struct SeriesStepper {
    pub(super) motions: Vec<BuildingMotion>,
    /// Displacements, velocities and accelerations; memories of springs are brought up to date for rows of a history and at
    /// the end. Time and contacts are those of the run.
    pub(super) state: State,
    /// Displacements, velocities and accelerations at the end of the tried step.
    tried: [Vec<f64>; 3],
    /// Rates of the accelerations now, where a contact is closed.
    pub(super) jerk: Vec<f64>,
    /// Contact forces over the tried step, building by building.
    pub(super) pushes: Vec<Vec<Push>>,
    pub(super) predicted: Vec<PredictedForce>,
    pub(super) equations: ForceEquations,
    pub(super) tried_forces: Vec<f64>,
    pub(super) graph: InterfaceGraph,
    open_steps: Vec<u32>,
    /// Division of free vibration, so that histories have their rows.
    least_division: u32,
    /// Length of the tried step \[s\].
    length: f64,
    audit: EnergyAudit,
    recorder: Recorder,
    peaks: SeriesPeaks,
    stages: Vec<Stage>,
    /// When every spring last came to the end of a line \[s\].
    line_ended: Vec<f64>,
    events: Vec<SpringEvent>,
    near: NearContacts,
    /// Greatest estimated error of a contact force of every gap \[N\].
    force_error: Vec<f64>,
    /// Estimated error of the greatest closing of every contact \[m\].
    closing_error: Vec<f64>,
}

/// Runs a system with the steps of the plan, without an estimate of the error.
pub(in crate::stepping) fn run(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    settings: Settings,
    state: State,
    observer: &mut OnProgress<'_>,
) -> Outcome {
    let mut run = RunState::new(system, motion, plan, settings);
    run.time = state.time;
    run.take_contacts(&state);
    let mut stepper = SeriesStepper::new(&run, settings, state);
    stepper.turn_springs(system);
    let mut runner = Runner { run, stepper };
    let end = runner.run_to_end(observer);
    runner.report_unfinished_impacts();
    let Runner { run, stepper } = runner;
    stepper.into_outcome(run, end)
}

impl SeriesStepper {
    fn new(run: &RunState<'_>, settings: Settings, state: State) -> Self {
        let (system, motion, plan) = (run.system, run.motion, run.plan);
        let springs = || {
            let buildings = system.buildings.iter();
            let springs = buildings.flat_map(|building| &building.equations.springs);
            springs.zip(&state.springs)
        };
        let totals = springs().map(|(spring, memory)| SpringTotals {
            peak_force: memory.force().abs(),
            work: spring.hysteresis.recoverable_energy(memory),
        });
        let contacts = system.contacts.iter().map(|contact| &contact.ports);
        let mut recorder = Recorder::new(system, &run.grounds, settings);
        let rows = settings
            .record_interval
            .map_or(0.0, |interval| motion.duration / plan.step.max(interval));
        recorder.reserve((1.2 * rows + 100.0).min(1e6) as usize);
        let list = || vec![0.0; system.len()];
        let motions = system.buildings.iter();
        Self {
            motions: motions
                .map(|motion| {
                    BuildingMotion::new(&motion.equations, &state.springs[motion.spring_range()])
                })
                .collect(),
            tried: [list(), list(), list()],
            jerk: list(),
            pushes: vec![Vec::with_capacity(system.contacts.len()); system.buildings.len()],
            predicted: vec![PredictedForce::default(); system.contacts.len()],
            equations: ForceEquations::default(),
            tried_forces: Vec::with_capacity(system.contacts.len()),
            graph: InterfaceGraph::new(contacts, system.buildings.len(), |building| building),
            open_steps: vec![0; system.contacts.len()],
            least_division: settings.rows_per_step(plan),
            length: 0.0,
            audit: EnergyAudit::starting_from(system, &state, &run.grounds),
            recorder,
            peaks: SeriesPeaks::new(system, motion.duration, totals.collect()),
            stages: springs()
                .map(|(spring, memory)| spring.hysteresis.stage(memory))
                .collect(),
            line_ended: vec![0.0; springs().count()],
            events: Vec::with_capacity(2 * springs().count()),
            near: NearContacts::new(system.contacts.len()),
            force_error: vec![0.0; run.strongest.len()],
            closing_error: vec![0.0; system.contacts.len()],
            state,
        }
    }

    /// Estimated error of peaks: by parabolas of contact forces, relative to the greatest of their gap, and by cubics of closings.
    fn residual(&self, run: &RunState<'_>) -> f64 {
        let closings = self.closing_error.iter().zip(&self.peaks.closing);
        let closings = closings.zip(&run.system.contacts);
        let relative = closings.map(|((error, closing), contact)| {
            let scale = closing_scale(contact, closing.value, |building, floor| {
                self.peaks.sway(building, floor)
            });
            error / scale.max(f64::MIN_POSITIVE)
        });
        let forces = self.force_error.iter().zip(&run.strongest);
        let forces = forces.map(|(error, strongest)| error / strongest.max(f64::MIN_POSITIVE));
        relative.chain(forces).fold(0.0, f64::max)
    }

    fn into_outcome(mut self, mut run: RunState<'_>, end: RunEnd) -> Outcome {
        let system = run.system;
        self.bring_springs_up_to_date(system);
        for spring in 0..self.stages.len() {
            self.note_stage(system, spring, None);
        }
        let energy = self.audit.balance(system, &self.state, &run.grounds);
        let residual = self.residual(&run);
        let step_of = |division: u32| run.plan.step / f64::from(division);
        let contact_step = Some(run.finest_in_contact)
            .filter(|d| *d > 0)
            .map(|d| step_of(d.max(self.least_division)));
        self.state.time = run.time;
        self.state.contacts = std::mem::take(&mut run.phases);
        self.state.crushed = std::mem::take(&mut run.crushed);
        run.work.coupling_operations = run.coupling.operations + self.equations.operations;
        let ratios = MemberRatios::new(system);
        let peaks = self.peaks.finish(system);
        Outcome {
            acceleration_parts: self.peaks.parts,
            spring_history: self.recorder.springs.take(),
            members: vec![Vec::new(); system.buildings.len()],
            member_ratios: ratios.greatest,
            worst_instants: ratios.worst,
            history: self.recorder.into_history(),
            spring_events: self.events,
            energy,
            free_step: Some(step_of(self.least_division)),
            contact_step,
            state: self.state,
            accuracy: Some(Accuracy {
                tolerance: run.plan.tolerance(),
                residual,
                doubtful_from: self.near.doubtful_from,
                sensitive_from: None,
            }),
            ..run.into_outcome(peaks, end)
        }
    }

    /// Memories of all springs at the present displacements.
    fn bring_springs_up_to_date(&mut self, system: &System) {
        for (building, motion) in system.buildings.iter().zip(&self.motions) {
            let u = &self.state.displacement[building.range()];
            let memories = motion.memories_at(&building.equations, u);
            let places = &mut self.state.springs[building.spring_range()];
            for (place, memory) in places.iter_mut().zip(memories) {
                *place = memory;
            }
        }
    }

    /// Turns springs that velocities lead the other way than before.
    fn turn_springs(&mut self, system: &System) {
        for (building, motion) in system.buildings.iter().zip(&mut self.motions) {
            let range = building.range();
            let u = &self.state.displacement[range.clone()];
            let v = &self.state.velocity[range];
            motion.turn_springs(&building.equations, [u, v]);
        }
    }

    /// Moves all buildings over the tried step; `pushed_only`: those under contact forces.
    pub(super) fn move_buildings(
        &mut self,
        run: &mut RunState<'_>,
        step: f64,
        pushed_only: bool,
    ) -> Result<(), StepError> {
        let ground = ground_line(run.ground, step);
        let buildings = run.system.buildings.iter().zip(&mut self.motions);
        for ((building, motion), pushes) in buildings.zip(&self.pushes) {
            if pushed_only && pushes.is_empty() {
                continue;
            }
            let range = building.range();
            let from = [
                &self.state.displacement[range.clone()],
                &self.state.velocity[range.clone()],
                &self.state.acceleration[range.clone()],
            ];
            let moved = motion.advance(&building.equations, from, ground, step, pushes);
            let segments = motion.segments();
            run.work.solves += segments.len() as u64;
            run.work.outer_iterations += motion.changes.len() as u64;
            let (Some(()), Some(last)) = (moved, segments.last()) else {
                return Err(StepError::SpringsDiverged {
                    building: building.name.clone(),
                    time: run.time,
                });
            };
            for (to, from) in self.tried.iter_mut().zip(&last.end) {
                let to = &mut to[range.clone()];
                to.copy_from_slice(&from[..to.len()]);
            }
            if !last.end[0].iter().all(|u| u.is_finite()) {
                return Err(StepError::NotFinite { time: run.time });
            }
        }
        Ok(())
    }

    /// Indentations at the end of the tried step.
    pub(super) fn read_trials(&self, run: &mut RunState<'_>) {
        let [u, v, _] = &self.tried;
        let contacts = run.system.contacts.iter().zip(&run.widths);
        for ((contact, width), trial) in contacts.zip(&mut run.trials) {
            trial.indentation = contact.ports.closing(u) - width;
            trial.rate = contact.ports.closing(v);
            trial.force = 0.0;
        }
    }

    /// About how far the closing of a contact is from its cubic within the tried step: h⁴/384 times its fourth derivative
    /// \[m\].
    fn missed_by_cubic(&self, run: &RunState<'_>, contact: usize, step: f64) -> f64 {
        let mut change = 0.0;
        for (port, sign) in run.system.contacts[contact].ports.sides() {
            let offset = run.system.buildings[port.building].offset;
            let row = port.row.moved_down(offset);
            let segments = self.motions[port.building].segments();
            if let (Some(first), Some(last)) = (segments.first(), segments.last()) {
                change -= sign * (row.value(&last.end[3]) - row.value(&first.start[3]));
            }
        }
        step * step * step * change.abs() / 384.0
    }

    /// Lists a stage that a spring has reached: its own one, or that of its memory.
    fn note_stage(&mut self, system: &System, spring: usize, stage: Option<Stage>) {
        let stage = stage.unwrap_or_else(|| {
            let buildings = system.buildings.iter();
            let yielding_spring = buildings
                .flat_map(|building| &building.equations.springs)
                .nth(spring);
            yielding_spring.map_or(Stage::Uncracked, |yielding_spring| {
                yielding_spring
                    .hysteresis
                    .stage(&self.state.springs[spring])
            })
        });
        if stage > self.stages[spring] {
            self.stages[spring] = stage;
            let time = self.line_ended[spring];
            self.events.push(SpringEvent {
                spring,
                stage,
                time,
            });
        }
    }

    /// Accelerations of all buildings under the forces that act now.
    fn find_accelerations(&mut self, run: &RunState<'_>) {
        self.pushes.iter_mut().for_each(Vec::clear);
        for (contact, phase) in run.system.contacts.iter().zip(&run.phases) {
            let force = phase.force();
            for (port, sign) in contact.ports.sides() {
                if force != 0.0 {
                    let offset = run.system.buildings[port.building].offset;
                    self.pushes[port.building].push(Push {
                        row: port.row.moved_down(offset),
                        force: [sign * force, 0.0, 0.0],
                    });
                }
            }
        }
        let buildings = run.system.buildings.iter().zip(&mut self.motions);
        for ((building, motion), pushes) in buildings.zip(&self.pushes) {
            let (equations, range) = (&building.equations, building.range());
            let u = &self.state.displacement[range.clone()];
            let v = &self.state.velocity[range.clone()];
            let a = &mut self.state.acceleration[range];
            motion.accelerations_now(equations, [u, v], run.ground[0][0], pushes, a);
        }
    }

    /// A row of the history, where one is due.
    fn record(&mut self, run: &RunState<'_>, wanted: bool) {
        if !self.recorder.is_due(run.time, wanted) {
            return;
        }
        self.state.time = run.time;
        self.bring_springs_up_to_date(run.system);
        let instant = Instant {
            state: &self.state,
            contacts: &run.phases,
            links: &[],
            grounds: &run.grounds,
            ground: run.grounds_at(0),
        };
        self.recorder
            .record(run.system, &instant, wanted, &mut self.audit);
    }
}

/// The ground acceleration over a step.
fn ground_line([start, end]: [Ground; 2], step: f64) -> GroundLine {
    GroundLine {
        start: start[0],
        slope: (end[0] - start[0]) / step,
    }
}

impl Stepper for SeriesStepper {
    /// No run of this stepper has grounds of its own.
    fn change_ground(&mut self, _: &RunState<'_>, _: usize, _: Ground) {}

    fn ends_steps_at_corners(&self, _: &RunState<'_>) -> bool {
        true
    }

    fn record_start(&mut self, run: &mut RunState<'_>) {
        self.record(run, true);
    }

    fn history_fault(&self) -> Option<&str> {
        self.recorder.unstored()
    }

    fn closing(&self, run: &RunState<'_>, contact: usize) -> f64 {
        let ports = &run.system.contacts[contact].ports;
        ports.closing(&self.state.displacement)
    }

    fn closing_rate(&self, run: &RunState<'_>, contact: usize) -> f64 {
        let ports = &run.system.contacts[contact].ports;
        ports.closing(&self.state.velocity)
    }

    fn division(&self, run: &RunState<'_>) -> u32 {
        let divisions = run.contact_division.iter().copied();
        divisions.fold(self.least_division, u32::max)
    }

    fn prepare(&mut self, _: &mut RunState<'_>, next: &NextStep) -> Result<usize, StepError> {
        self.length = next.length;
        Ok(0)
    }

    fn prepare_length(&mut self, _: &mut RunState<'_>, length: f64) -> Result<(), StepError> {
        self.length = length;
        Ok(())
    }

    fn length(&self, _: usize) -> f64 {
        self.length
    }

    fn try_step(&mut self, run: &mut RunState<'_>, _: usize, end: Clock) -> Result<(), StepError> {
        run.ground[1] = run.motion.components(end.time());
        self.predict_forces(run, self.length);
        self.move_with_contacts(run, self.length)
    }

    fn unresolved_contact(&self, run: &RunState<'_>, step: f64) -> Option<usize> {
        let unseen = contact_parabola::opens_unseen(run, self, step);
        unseen.or_else(|| contact_parabola::misses_prediction(run, &self.predicted))
    }

    fn contact_that_opens_unseen(&self, run: &RunState<'_>, step: f64) -> Option<usize> {
        contact_parabola::opens_unseen(run, self, step)
    }

    fn before_step(&mut self, run: &mut RunState<'_>, step: f64) {
        let mut near = std::mem::replace(&mut self.near, NearContacts::new(0));
        near.at_turns(run, self, step, |contact| self.peaks.closing[contact].value);
        self.near = near;
        for (index, contact) in run.system.contacts.iter().enumerate() {
            let ports = &contact.ports;
            let then = (
                ports.closing(&self.state.displacement),
                ports.closing(&self.state.velocity),
            );
            let now = (ports.closing(&self.tried[0]), ports.closing(&self.tried[1]));
            let greatest = greatest_in_step(then, now, run.time, step);
            if greatest.value > self.peaks.closing[index].value {
                self.peaks.closing[index] = greatest;
                let between = greatest.at < run.time + step;
                self.closing_error[index] = if between {
                    self.missed_by_cubic(run, index, step)
                } else {
                    0.0
                };
            }
        }
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
        let [start, end] = [episode.force, run.trials[index].force];
        let bend = self.predicted[index].bend(start, end);
        if episode.since < run.time {
            let missed = (end - self.predicted[index].end).abs();
            let error = &mut self.force_error[run.system.contacts[index].gap];
            *error = error.max(contact_parabola::FORCE_ERROR * missed);
        }
        episode.impulse += step * (0.5 * (start + end) - bend / 6.0);
        for (share, weight) in GAUSS {
            let force = start + share * (end - start + bend * (share - 1.0));
            episode.work += weight * force * curve.rise(share);
        }
    }

    fn advance(&mut self, run: &mut RunState<'_>, _: usize) -> Result<(), StepError> {
        let ground = ground_line(run.ground, self.length);
        let buildings = run.system.buildings.iter().zip(&mut self.motions);
        for (index, (building, motion)) in buildings.enumerate() {
            let mat = building
                .support
                .map(|support| support.dof - building.offset);
            let work = motion.work(ground, &self.pushes[index], mat);
            self.audit.input += work.input;
            self.audit.damped += work.damped;
            self.audit.contact -= work.pushed;
            if let Some(support) = &building.support {
                self.peaks.supports[index].damped += support.damping * work.followed;
            }
        }
        let State {
            displacement,
            velocity,
            acceleration,
            ..
        } = &mut self.state;
        let now = [displacement, velocity, acceleration];
        for (now, tried) in now.into_iter().zip(&mut self.tried) {
            std::mem::swap(now, tried);
        }
        Ok(())
    }

    fn arrive(&mut self, run: &mut RunState<'_>, _: usize) {
        let start = run.time - self.length;
        for index in 0..self.motions.len() {
            self.motions[index].accept();
            let offset = run.system.buildings[index].spring_offset;
            for place in 0..self.motions[index].changes.len() {
                let change = self.motions[index].changes[place];
                let spring = offset + change.spring;
                self.note_stage(run.system, spring, Some(change.stage));
                if change.at_end {
                    self.line_ended[spring] = start + change.at;
                }
            }
        }
    }

    fn end_slope(
        &mut self,
        run: &RunState<'_>,
        contact: usize,
        trial: &ContactTrial,
        episode: &Episode,
        step: f64,
    ) -> f64 {
        let contact = &run.system.contacts[contact];
        let acceleration = contact.ports.closing(&self.state.acceleration);
        // Before a corner at which the step ends, on its own side.
        let back = if run.at_corner { -AHEAD * step } else { 0.0 };
        let rate = trial.rate + acceleration * back;
        let indentation = trial.indentation + trial.rate * back;
        let response = contact.law.follow(indentation, rate, &episode.memory);
        response.by_indentation * rate + response.by_rate * acceleration
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
        let missed = (run.trials[index].force - self.predicted[index].end).abs();
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
        let ground = ground_line(ground, step);
        let buildings = run.system.buildings.iter().zip(&self.motions);
        for (index, (building, motion)) in buildings.enumerate() {
            for segment in motion.segments() {
                let shaken = [ground.start + ground.slope * segment.at, ground.slope];
                let start = start + segment.at;
                self.peaks
                    .after_segment(index, building, segment, start, shaken);
            }
        }
        self.audit.springs = self.peaks.springs.iter().map(|totals| totals.work).sum();
        let [mut kinetic, mut strain] = [0.0; 2];
        for building in &run.system.buildings {
            let (equations, range) = (&building.equations, building.range());
            let v = &self.state.velocity[range.clone()];
            kinetic += 0.5 * simd::weighted_square(&equations.mass, v);
            if !equations.plain || !equations.stiffness.is_zero() {
                strain += 0.5 * equations.strain(&self.state.displacement[range]);
            }
        }
        self.audit.look(kinetic, strain);
        self.record(run, was_closed);
        check_collapse(run, |building| {
            let floors = self.peaks.floors[building].iter();
            floors.map(|floor| floor.storey_drift).enumerate()
        })
    }

    fn before_touch(&mut self, run: &RunState<'_>, contact: usize, rate: f64) {
        let closing = self.peaks.closing[contact].value;
        let ports = &run.system.contacts[contact].ports;
        let touch = Touch {
            rate,
            acceleration: ports.closing(&self.state.acceleration),
            doubt: near_contacts::doubt(run, contact, closing),
            clearance: None,
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
        let contact = &run.system.contacts[contact];
        let acceleration = contact.ports.closing(&self.state.acceleration);
        contact_parabola::division_at_touch(run, contact, [rate, acceleration], episode, planned)
    }

    fn after_release(&mut self, _: &RunState<'_>, contact: usize) {
        self.open_steps[contact] = 0;
        self.near.after_release(contact);
    }

    fn change_force(&mut self, run: &RunState<'_>, _: usize, _: f64) {
        self.find_accelerations(run);
    }

    fn jump_velocities(
        &mut self,
        run: &mut RunState<'_>,
        contact: usize,
        restitution: f64,
        rate: f64,
    ) -> Jump {
        let contact = &run.system.contacts[contact];
        let mass = contact.effective_mass();
        let impulse = momentum::impulse(restitution, mass, rate);
        for (port, sign) in contact.ports.sides() {
            let building = &run.system.buildings[port.building];
            for &(dof, share) in port.row.entries() {
                let mass = building.equations.mass[dof - building.offset];
                self.state.velocity[dof] += sign * share * impulse / mass;
            }
        }
        let dissipated = 0.5 * mass * rate * rate * (1.0 - restitution * restitution);
        self.audit.contact += dissipated;
        Jump {
            impulse,
            dissipated,
            separation_speed: restitution * rate,
        }
    }

    fn restart(&mut self, run: &RunState<'_>, velocities: bool) {
        if velocities {
            self.turn_springs(run.system);
        }
        self.find_accelerations(run);
    }

    fn after_event(&mut self, run: &RunState<'_>) {
        // The force may have gone with the contact.
        self.find_accelerations(run);
        let ground = run.ground[0][0];
        self.peaks
            .after_jump(run.system, &self.state.acceleration, ground);
    }
}
