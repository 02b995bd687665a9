//! The walk through a ground motion in modal coordinates.

use std::ops::ControlFlow;

use super::damped::Rules;
use super::estimate::{Estimate, Reached};
use super::flight::Flight;
use super::forces::ForceEquations;
use super::meeting::Foreseen;
use super::members::Instant;
use super::peaks::{Peaks, Taken, Watched};
use super::reduced::{Reduced, StepEnergy, Table};
use crate::history::{Energy, Impact, Work};
use crate::motion::GroundMotion;
use crate::simd;
use crate::state::{ContactPhase, State};
use crate::stepping::acceleration_parts::AccelerationParts;
use crate::stepping::clock::{Clock, Stride};
use crate::stepping::coupling::ContactEquations;
use crate::stepping::energy::Imbalance;
use crate::stepping::events::Crossing;
use crate::stepping::outcome::{Outcome, Pounding, Progress, RunEnd, Settings, StepError};
use crate::stepping::plan::Plan;
use crate::stepping::trial::ContactTrial;
use crate::system::System;

/// Steps between calls of the observer.
const OBSERVED_EVERY: u64 = 256;
/// Most rows of a history in a step of free flight.
const MOST_ROWS: f64 = 64.0;
/// How often a step is halved in search of an opening within it, or of forces that can be foreseen.
const MOST_HALVINGS: usize = 12;
/// Events without progress before a run gives up.
const MOST_EVENTS_AT_ONCE: usize = 1000;

/// A run under way.
pub(super) struct Walk<'a> {
    pub(super) system: &'a System,
    pub(super) motion: &'a GroundMotion,
    pub(super) plan: &'a Plan,
    pub(super) pounding: bool,
    pub(super) reduced: &'a Reduced,
    /// The first serves steps off the grid, the others one division of the free-flight step each.
    pub(super) tables: Vec<Table>,
    divisions: Vec<u32>,
    /// Division of free flight, so that histories have their rows.
    pub(super) least_division: u32,
    /// How many times as many steps that are as the tolerance asks for.
    pub(super) rows_per_step: usize,
    pub(super) flight: Flight,
    rules: Rules,
    pub(super) clock: Clock,
    pub(super) time: f64,
    /// Ground acceleration now and at the end of the tried step.
    pub(super) ground: [f64; 2],
    /// Modal displacement, velocity and load now, and at the end of the tried step.
    pub(super) q: [Vec<f64>; 2],
    pub(super) v: [Vec<f64>; 2],
    pub(super) p: [Vec<f64>; 2],
    /// Bend of the modal load over the tried step: contact forces are parabolas.
    pub(super) bend: Vec<f64>,
    /// ∫q of the accepted step, then whatever else needs a list of modes.
    pub(super) scratch: Vec<f64>,
    /// ∫τq of the accepted step, where a contact is closed.
    moment: Vec<f64>,
    /// What is watched now, and at the end of the tried step; its accelerations and what their rates are but for the
    /// loads', now and a step ago.
    pub(super) u: [Vec<f64>; 2],
    pub(super) rate: [Vec<f64>; 2],
    pub(super) acceleration: [Vec<f64>; 2],
    pub(super) loose: [Vec<f64>; 2],
    pub(super) jerk: Vec<f64>,
    pub(super) phases: Vec<ContactPhase>,
    pub(super) trials: Vec<ContactTrial>,
    pub(super) contact_division: Vec<u32>,
    /// Steps that a contact has been open, while its division still counts.
    pub(super) open_steps: Vec<u32>,
    pub(super) strongest: Vec<f64>,
    pub(super) coupling: ContactEquations,
    pub(super) equations: ForceEquations,
    /// Forces of closed contacts over the tried step as they could be foreseen.
    pub(super) foreseen: Vec<Foreseen>,
    pub(super) finest_in_contact: u32,
    pub(super) impacts: Vec<Impact>,
    pub(super) energy: Audit,
    pub(super) work: Work,
    pub(super) peaks: Peaks,
    pub(super) reached: Reached,
    /// Forces of storeys where errors are looked at \[N, N·m\].
    pub(super) looked_at: Vec<f64>,
    /// Steps left in which accelerations may still follow a jump of velocities, unlike a cubic.
    pub(super) struck: u32,
    /// Whether this step ends at a corner of a contact force.
    pub(super) at_corner: bool,
    /// How far every open contact has opened since it was closed; infinite before it ever was \[m\].
    pub(super) clearance: Vec<f64>,
    /// Relative tolerance of peaks \[–\].
    pub(super) tolerance: f64,
    /// First instant at which a contact was made or missed by less than the tolerance \[s\].
    pub(super) doubtful_from: Option<f64>,
}

/// Share of the tolerance below which shapes are not what is to be mended.
const LEAST_SHARE: f64 = 0.3;

/// How much finer a run is than planned, and the work done before it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Refinement {
    /// Relative tolerance of peaks \[–\].
    pub(super) tolerance: f64,
    /// Division of free steps.
    pub(super) division: u32,
    pub(super) work: Work,
}

/// What a run says of its own accuracy.
pub(super) struct Verdict {
    pub(super) estimate: Estimate,
    /// Modes of every building that miss too much.
    pub(super) lacking: Vec<Vec<usize>>,
    /// First instant at which a contact was made or missed by less than the tolerance \[s\].
    pub(super) doubtful_from: Option<f64>,
}

/// Into how many parts free steps are divided for rows of a history.
fn rows_per_step(plan: &Plan, settings: Settings) -> u32 {
    settings.record_interval.map_or(1, |interval| {
        if interval == 0.0 {
            return 1;
        }
        let rows = (plan.step / interval * (1.0 - 1e-9)).clamp(1.0, MOST_ROWS);
        (rows.ceil() as u32).next_power_of_two()
    })
}

/// Sums that must balance; every one is exact for loads that are parabolas over a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Audit {
    pub(super) input: f64,
    pub(super) damped: f64,
    pub(super) contact: f64,
    imbalance: Imbalance,
}

impl Audit {
    /// The balance with these energies of the buildings.
    pub(super) fn balance(&mut self, kinetic: f64, strain: f64) -> Energy {
        self.imbalance.watch(Energy {
            input: self.input,
            kinetic,
            strain,
            damped: self.damped,
            links: 0.0,
            hysteretic: 0.0,
            contact: self.contact,
            worst_imbalance: 0.0,
        })
    }
}

impl<'a> Walk<'a> {
    pub(super) fn new(
        system: &'a System,
        motion: &'a GroundMotion,
        plan: &'a Plan,
        settings: Settings,
        reduced: &'a Reduced,
        refinement: Refinement,
    ) -> Self {
        let Refinement {
            division,
            work,
            tolerance,
        } = refinement;
        let ground = motion.acceleration(0.0);
        let (modes, watched) = (reduced.modes(), reduced.watched());
        let pair = |n: usize| [vec![0.0; n], vec![0.0; n]];
        let mut p = pair(modes);
        for (load, participation) in p[0].iter_mut().zip(&reduced.participation) {
            *load = -participation * ground;
        }
        let contacts = system.contacts.len();
        let rows = settings
            .record_interval
            .map_or(0.0, |interval| motion.duration / plan.step.max(interval));
        let mut peaks = Peaks::new(system, reduced, settings.record_interval);
        peaks.reserve((1.2 * rows + 100.0).min(1e6) as usize);
        let mut acceleration = pair(watched);
        // At rest on moving ground buildings stay behind.
        for (acceleration, share) in acceleration[0].iter_mut().zip(peaks.driven()) {
            *acceleration = -share * ground;
        }
        Self {
            flight: Flight::new(reduced),
            tables: vec![Table::default()],
            divisions: vec![0],
            least_division: division.max(rows_per_step(plan, settings)),
            rows_per_step: (rows_per_step(plan, settings) / division).max(1) as usize,
            rules: Rules::new(),
            clock: Clock::new(plan.step),
            time: 0.0,
            ground: [ground; 2],
            q: pair(modes),
            v: pair(modes),
            p,
            bend: vec![0.0; modes],
            scratch: vec![0.0; modes],
            moment: vec![0.0; modes],
            u: pair(watched),
            rate: pair(watched),
            acceleration,
            loose: pair(watched),
            jerk: vec![0.0; modes],
            phases: vec![ContactPhase::Open; contacts],
            trials: vec![ContactTrial::default(); contacts],
            contact_division: vec![1; contacts],
            open_steps: vec![0; contacts],
            strongest: vec![0.0; system.contacts.iter().map(|c| c.gap + 1).max().unwrap_or(0)],
            coupling: ContactEquations::default(),
            equations: ForceEquations::default(),
            foreseen: vec![Foreseen::default(); contacts],
            finest_in_contact: 0,
            impacts: Vec::new(),
            energy: Audit::default(),
            work,
            peaks,
            reached: Reached::new(reduced),
            looked_at: vec![0.0; reduced.forces()],
            clearance: vec![f64::INFINITY; contacts],
            tolerance,
            doubtful_from: None,
            struck: 0,
            at_corner: false,
            pounding: settings.pounding == Pounding::Included,
            system,
            motion,
            plan,
            reduced,
        }
    }

    /// To the end of the motion; with how far peaks may be off.
    pub(super) fn run(
        mut self,
        observer: &mut impl FnMut(Progress) -> ControlFlow<()>,
    ) -> (Outcome, Verdict) {
        let tolerance = self.tolerance;
        let duration = self.motion.duration;
        let energy = self.balance();
        if self.peaks.members.is_some() {
            self.accelerations();
        }
        self.take_row(true, &energy);
        let mut end = RunEnd::Completed;
        let mut next_look = 0;
        while duration - self.time > 1e-9 * self.plan.step {
            let progress = Progress {
                time: self.time,
                duration,
            };
            if self.work.steps >= next_look {
                next_look = self.work.steps + OBSERVED_EVERY;
                if observer(progress).is_break() {
                    end = RunEnd::Stopped;
                    break;
                }
            }
            if self.fly() {
                continue;
            }
            if let Err(error) = self.step() {
                end = RunEnd::Failed(error);
                break;
            }
        }
        let struck = !self.impacts.is_empty();
        let (reduced, system) = (self.reduced, self.system);
        let estimate = Estimate::of(reduced, system, &self.reached, &self.peaks, struck);
        let lacking = if estimate.both() > tolerance && estimate.shapes > LEAST_SHARE * tolerance {
            let (reduced, system) = (self.reduced, self.system);
            self.reached
                .lacking(reduced, system, &self.peaks, tolerance)
        } else {
            Vec::new()
        };
        let doubtful_from = self.doubtful_from;
        let verdict = Verdict {
            estimate,
            lacking,
            doubtful_from,
        };
        (self.close_books(end), verdict)
    }

    fn close_books(mut self, end: RunEnd) -> Outcome {
        for index in 0..self.system.contacts.len() {
            if let ContactPhase::Closed(episode) = self.phases[index] {
                self.report_impact(index, &episode, false);
            }
        }
        self.work.coupling_operations = self.coupling.operations + self.equations.operations;
        let energy = self.balance();
        let step_of = |division: u32| self.plan.step / f64::from(division);
        let contact_step = Some(self.finest_in_contact)
            .filter(|d| *d > 0)
            .map(|d| step_of(d.max(self.least_division)));
        let state = self.full_state();
        let members = self.peaks.members.take();
        let (members, member_history) = members.map_or_else(
            || (vec![Vec::new(); self.system.buildings.len()], None),
            |members| members.finish(self.system, self.reduced),
        );
        Outcome {
            impacts: self.impacts,
            acceleration_parts: AccelerationParts::default(),
            floors: std::mem::take(&mut self.peaks.floors),
            closing: std::mem::take(&mut self.peaks.closing),
            base_shear: std::mem::take(&mut self.peaks.base_shear),
            spring_history: None,
            members,
            member_history,
            history: self.peaks.into_history(),
            spring_events: Vec::new(),
            springs: Vec::new(),
            links: Vec::new(),
            energy,
            work: self.work,
            free_step: Some(step_of(self.least_division)),
            contact_step,
            state,
            accuracy: None,
            end,
        }
    }

    /// Displacements, velocities and accelerations of everything.
    fn full_state(&mut self) -> State {
        let mut state = State::at_rest(self.system, 0.0);
        state.time = self.time;
        self.reduced.expand(&self.q[0], &mut state.displacement);
        self.reduced.expand(&self.v[0], &mut state.velocity);
        self.accelerations();
        self.reduced.expand(&self.scratch, &mut state.acceleration);
        state.contacts.clone_from(&self.phases);
        state
    }

    /// Modal accelerations now, in `scratch`.
    pub(super) fn accelerations(&mut self) {
        let loads = self.p[0].iter().zip(&self.q[0]).zip(&self.v[0]);
        let factors = self.reduced.damping.iter().zip(&self.reduced.stiffness);
        for ((a, ((p, q), v)), (d, k)) in self.scratch.iter_mut().zip(loads).zip(factors) {
            *a = p - d * v - k * q;
        }
    }

    /// One accepted step, ending on the grid or on the first event in between.
    fn step(&mut self) -> Result<(), StepError> {
        let mut halvings = 0;
        for _ in 0..MOST_EVENTS_AT_ONCE {
            let stride = self.next_stride();
            let slot = self.table_for(&stride);
            self.try_step(slot, stride.end)?;
            let event = self.first_event(stride.length);
            let before = event.map_or(1.0, |event| event.at);
            if let Some(corner) = self.first_corner(stride.length, before) {
                self.work.repeated_steps += 1;
                if self.step_to_corner(corner, &stride)? {
                    return Ok(());
                }
                continue;
            }
            let Some(event) = event else {
                let unseen = self.opens_unseen(stride.length);
                let unseen = unseen.or_else(|| self.goes_unforeseen());
                if let Some(contact) = unseen.filter(|_| halvings < MOST_HALVINGS) {
                    halvings += 1;
                    self.contact_division[contact] = self.plan.finer(self.division());
                    self.work.repeated_steps += 1;
                    continue;
                }
                self.accept(slot, stride.end);
                return Ok(());
            };
            self.work.repeated_steps += 1;
            if event.at * stride.length > self.shortest_step(&event) {
                if self.step_to(event, &stride)? {
                    return Ok(());
                }
                continue;
            }
            self.read_contacts();
            self.happen(event);
        }
        Err(StepError::Chattering { time: self.time })
    }

    /// The regular step from here, cut at the end of the motion.
    fn next_stride(&self) -> Stride {
        let stride = self.clock.stride(self.division());
        let left = self.motion.duration - self.time;
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
        let divisions = self.contact_division.iter().copied();
        divisions.fold(self.least_division, u32::max)
    }

    pub(super) fn table_for(&mut self, stride: &Stride) -> usize {
        if !stride.regular {
            self.set_odd(stride.length);
            return 0;
        }
        let division = self.division();
        if let Some(slot) = self.divisions.iter().position(|d| *d == division) {
            return slot;
        }
        let mut table = Table::default();
        table.set(self.reduced, stride.length, Some(&self.rules));
        self.work.factorizations += 1;
        self.tables.push(table);
        self.divisions.push(division);
        self.tables.len() - 1
    }

    /// Sets the odd table to a length.
    pub(super) fn set_odd(&mut self, length: f64) {
        // Seldom enough that what damping takes may come from the balance of every mode.
        self.tables[0].set(self.reduced, length, None);
        self.work.factorizations += 1;
    }

    /// Takes the step to `end` without accepting it.
    pub(super) fn try_step(&mut self, slot: usize, end: Clock) -> Result<(), StepError> {
        self.ground[1] = self.motion.acceleration(end.time());
        let ground = self.ground[1];
        for (load, participation) in self.p[1].iter_mut().zip(&self.reduced.participation) {
            *load = -participation * ground;
        }
        self.let_forces_set_out(self.tables[slot].step);
        self.advance(slot);
        self.work.solves += 1;
        self.follow();
        if self
            .trials
            .iter()
            .any(|trial| !trial.indentation.is_finite())
            || self.u[1].iter().any(|u| !u.is_finite())
        {
            return Err(StepError::NotFinite { time: self.time });
        }
        self.find_contact_forces(slot)
    }

    /// q₁ and q̇₁ under the loads that stand in `p` and `bend`.
    pub(super) fn advance(&mut self, slot: usize) {
        let ([q0, q1], [v0, v1]) = (&mut self.q, &mut self.v);
        let [p0, p1] = &self.p;
        let of = [&q0[..], v0, p0, p1, &self.bend];
        self.tables[slot].advance(self.reduced.arch(), of, [q1, v1]);
    }

    /// Watched displacements, indentations and rates at the end of the tried step.
    pub(super) fn follow(&mut self) {
        let watched = [&mut self.u[1][..], &mut self.rate[1][..]];
        self.reduced.show([&self.q[1], &self.v[1]], watched);
        self.read_trials(1);
    }

    /// Sets `trials` to the present.
    pub(super) fn read_contacts(&mut self) {
        self.read_trials(0);
    }

    /// Sets `trials` to the present or to the end of the tried step.
    pub(super) fn read_trials(&mut self, at: usize) {
        let (u, rate) = (&self.u[at], &self.rate[at]);
        for (index, trial) in self.trials.iter_mut().enumerate() {
            let width = self.system.contacts[index].width;
            trial.indentation = self.reduced.closing(index, u) - width;
            trial.rate = self.reduced.closing(index, rate);
            trial.force = 0.0;
        }
    }

    /// Moves on to the end of the tried step.
    pub(super) fn accept(&mut self, slot: usize, end: Clock) {
        let step = self.tables[slot].step;
        let was_closed = !self.coupling.closed.is_empty();
        let start = self.time;
        self.doubt_turns(step);
        if was_closed {
            self.gather_episodes(step);
        }
        let energy = self.step_energy(slot, was_closed);
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
        self.clock = end;
        self.time = end.time();
        let ground = self.ground;
        self.ground[0] = self.ground[1];
        self.accelerations();
        let free = (slot != 0 && !was_closed).then_some(step);
        let looked_at = self.reached.widen(&self.scratch, free);
        self.jerks();
        if was_closed {
            self.finish_episodes(step, start);
        }
        self.cool_down();
        self.work.steps += 1;
        self.work.contact_steps += u64::from(was_closed);
        self.look(ground, start, step);
        if looked_at {
            let watched = Watched {
                u: &self.u[0],
                rate: &self.rate[0],
                acceleration: &self.acceleration[0],
                loose: &self.loose[0],
            };
            let (system, reduced) = (self.system, self.reduced);
            let ground = self.ground[0];
            self.reached.look(
                system,
                reduced,
                &self.scratch,
                watched,
                ground,
                self.peaks.forces(),
            );
        }
        let energy = self.balance();
        self.take_row(was_closed, &energy);
    }

    /// Rates of modal accelerations now, but for those of the loads, in `jerk`; the accelerations stand in `scratch`.
    fn jerks(&mut self) {
        let modes = self.scratch.iter().zip(&self.v[0]);
        let factors = self.reduced.damping.iter().zip(&self.reduced.stiffness);
        for (jerk, ((a, v), (d, k))) in self.jerk.iter_mut().zip(modes.zip(factors)) {
            *jerk = -d * a - k * v;
        }
    }

    /// Takes in the peaks of a step that was taken, whose modal accelerations at the end stand in `scratch` and whose
    /// jerks, but for the ground's, in `jerk`.
    fn look(&mut self, ground: [f64; 2], start: f64, step: f64) {
        let reduced = self.reduced;
        self.acceleration.swap(0, 1);
        self.loose.swap(0, 1);
        self.show_accelerations();
        let at = |time: usize| Watched {
            u: &self.u[time],
            rate: &self.rate[time],
            acceleration: &self.acceleration[time],
            loose: &self.loose[time],
        };
        let taken = Taken {
            then: at(1),
            now: at(0),
            ground,
            start,
            step,
            struck: self.struck > 0,
        };
        let was_struck = taken.struck;
        self.peaks.after_step(self.system, reduced, &taken);
        self.struck = self.struck.saturating_sub(1);
        let open = self.phases.iter().all(|phase| *phase == ContactPhase::Open);
        let smooth = open && !was_struck;
        let now = Instant {
            q: &self.q[0],
            v: &self.v[0],
            a: &self.scratch,
            jerk: &self.jerk,
            time: self.time,
            ground: self.ground[0],
            phases: &self.phases,
            smooth,
        };
        self.peaks.follow_forces(self.system, reduced, now);
    }

    fn show_accelerations(&mut self) {
        self.reduced.show(
            [&self.scratch, &self.jerk],
            [&mut self.acceleration[0], &mut self.loose[0]],
        );
    }

    /// Accelerations and their rates after a sudden change of loads or of their rates.
    pub(super) fn start_anew(&mut self) {
        self.accelerations();
        self.jerks();
        for index in 0..self.phases.len() {
            let slope = self.slope_from_here(index);
            if slope != 0.0 {
                self.reduced.push_apart(index, slope, &mut self.jerk);
            }
        }
        self.show_accelerations();
    }

    /// What the ground put in and damping took; with closed contacts their work as well.
    fn step_energy(&mut self, slot: usize, was_closed: bool) -> StepEnergy {
        let table = &self.tables[slot];
        let [p0, p1] = &self.p;
        let of = [&self.q[0][..], &self.v[0], p0, p1, &self.bend];
        let arch = self.reduced.arch();
        table.area(arch, of, &mut self.scratch);
        if was_closed {
            table.moment(arch, of, &mut self.moment);
        }
        let end = [&self.q[1][..], &self.v[1]];
        let damped = table.damped(self.reduced, of, end, [&self.scratch, &self.moment]);
        let step = table.step;
        let slope = (self.ground[1] - self.ground[0]) / step;
        // ∫ a_g q̇ dt by parts.
        let driven = |list: &[f64]| simd::dot(&self.reduced.participation, list);
        let [before, after] = [0, 1].map(|time| self.ground[time] * driven(&self.q[time]));
        let input = slope * driven(&self.scratch) - (after - before);
        if was_closed {
            self.contact_work(step);
        }
        StepEnergy { damped, input }
    }

    /// ∫ F δ̇ dt of every closed contact, by parts; ∫q stands in `scratch` and ∫τq in `moment`.
    fn contact_work(&mut self, step: f64) {
        for closed in &self.coupling.closed {
            let index = closed.contact;
            let ContactPhase::Closed(episode) = &mut self.phases[index] else {
                continue;
            };
            let width = self.system.contacts[index].width;
            let closing = self.reduced.closing_of_modes(index, &self.scratch);
            let leaning = 2.0 * self.reduced.closing_of_modes(index, &self.moment) - closing;
            let before = self.reduced.closing(index, &self.u[0]) - width;
            let (first, last) = (episode.force, self.trials[index].force);
            let bent = self.foreseen[index].bend(first, last);
            let work = last * self.trials[index].indentation
                - first * before
                - (last - first) * (closing / step - width)
                - bent * leaning / step;
            episode.work += work;
            self.energy.contact += work;
        }
    }

    /// After an impact steps grow back to those of free flight, doubled every few.
    fn cool_down(&mut self) {
        for (index, phase) in self.phases.iter().enumerate() {
            let division = &mut self.contact_division[index];
            if *division == 1 || matches!(phase, ContactPhase::Closed(_)) {
                continue;
            }
            self.open_steps[index] += 1;
            if self.open_steps[index] >= STEPS_AFTERWARDS && self.clock.is_on_grid(*division / 2) {
                self.open_steps[index] = 0;
                *division /= 2;
            }
        }
    }

    /// The balance now.
    pub(super) fn balance(&mut self) -> Energy {
        let kinetic = 0.5 * simd::dot(&self.v[0], &self.v[0]);
        let strain = 0.5 * simd::weighted_square(&self.reduced.stiffness, &self.q[0]);
        self.energy.balance(kinetic, strain)
    }

    /// Adds a row to the history where one is due.
    fn take_row(&mut self, wanted: bool, energy: &Energy) {
        if self.peaks.is_due(self.time, wanted) {
            let watched = Watched {
                u: &self.u[0],
                rate: &self.rate[0],
                acceleration: &self.acceleration[0],
                loose: &self.loose[0],
            };
            let instant = Instant {
                q: &self.q[0],
                v: &self.v[0],
                a: &self.scratch,
                jerk: &self.jerk,
                time: self.time,
                ground: self.ground[0],
                phases: &self.phases,
                smooth: true,
            };
            self.peaks
                .record(self.system, self.reduced, instant, watched, energy);
        }
    }

    /// Whether a contact is open.
    pub(super) fn is_open(&self, index: usize) -> bool {
        self.phases[index] == ContactPhase::Open
    }

    /// Direction of the crossing that would end the step at a contact.
    pub(super) fn awaited(&self, index: usize) -> Option<Crossing> {
        let trial = &self.trials[index];
        if self.is_open(index) {
            let closing = self.reduced.closing(index, &self.rate[0]);
            let turned_back = trial.rate < 0.0 && closing > 0.0;
            (trial.indentation > 0.0 || turned_back).then_some(Crossing::Upwards)
        } else {
            (trial.indentation < 0.0 && self.system.contacts[index].law.jumps_at_release())
                .then_some(Crossing::Downwards)
        }
    }
}

/// Steps of a size after an impact.
const STEPS_AFTERWARDS: u32 = 4;
