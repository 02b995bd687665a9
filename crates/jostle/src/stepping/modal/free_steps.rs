//! Free-vibration steps: several regular steps at once while no contact is near.

use pulp::{Arch, Simd, WithSimd};

use super::members::Instant;
use super::mode_kernels::{Ahead, LANES, Lanes, Show, Sums};
use super::peaks::{Taken, Watched};
use super::reduced::Reduced;
use super::step_table::StepTable;
use super::stepper::ModalStepper;
use super::turning::{Loads, StepMotion};
use crate::motion::Ground;
use crate::simd;
use crate::state::ContactPhase;
use crate::stepping::clock::Clock;
use crate::stepping::events::Cubic;
use crate::stepping::near_contacts;
use crate::stepping::runner::RunState;
use crate::system::GroundsAt;

/// Largest and smallest number of steps at once.
const MOST: usize = 16;
const FEWEST: usize = 2;

/// Scratch space for some steps of free vibration.
pub(super) struct FreeSteps {
    /// Length of its steps; zero before the first \[s\].
    step: f64,
    /// Number of steps to try next.
    ahead: usize,
    /// Factors under one component of the ground motion, or under two; the other list is empty.
    lanes: Vec<Lanes<1>>,
    lanes_in_space: Vec<Lanes<2>>,
    by_ground: ByGround,
    /// Modal displacements and velocities now, padded to whole lanes.
    start: [Vec<f64>; 2],
    /// q, q̇, q̈ and jerk without load, step after step.
    modal: [Vec<f64>; 4],
    /// Monitored quantities; the present comes first.
    shown: [Vec<f64>; 4],
    ends: Vec<Clock>,
    ground: Vec<Ground>,
    sums: Vec<Sums>,
}

/// Coefficients of ground accelerations in sums over all modes.
#[derive(Clone, Copy, Debug, Default)]
struct ByGround {
    /// Of the products of two components in the dissipated energy: both at the start, the first there and the second at the
    /// end, both at the end.
    damped: [[[f64; 3]; 2]; 2],
    /// Of every component at both ends in Γ ∫q dt of another.
    area: [[[f64; 2]; 2]; 2],
}

impl ByGround {
    /// Dissipated energy \[J\].
    fn damped(&self, [g0, g1]: [Ground; 2], components: usize) -> f64 {
        let mut sum = 0.0;
        for first in 0..components {
            for second in 0..components {
                let [cc, cd, dd] = self.damped[first][second];
                sum +=
                    g0[first] * (cc * g0[second] + cd * g1[second]) + dd * g1[first] * g1[second];
            }
        }
        sum
    }

    /// Γ ∫q dt of a component.
    fn area(&self, axis: usize, [g0, g1]: [Ground; 2], components: usize) -> f64 {
        let of = |from: usize| {
            let [start, end] = self.area[axis][from];
            start * g0[from] + end * g1[from]
        };
        (1..components).fold(of(0), |sum, from| sum + of(from))
    }
}

/// Factors of a table, with loads from `N` components of the ground motion: p = −Σ Γ a.
fn fill_lanes<const N: usize>(
    lanes: &mut Vec<Lanes<N>>,
    by_ground: &mut ByGround,
    table: &StepTable,
    reduced: &Reduced,
) {
    lanes.clear();
    lanes.resize(reduced.modes().div_ceil(LANES), Lanes::default());
    *by_ground = ByGround::default();
    for mode in 0..reduced.modes() {
        let (block, lane) = (&mut lanes[mode / LANES], mode % LANES);
        for column in 0..2 {
            block.displacement[column][lane] = table.displacement[column][mode];
            block.velocity[column][lane] = table.velocity[column][mode];
        }
        let [aa, ab, ac, ad, _, bb, bc, bd, _, cc, cd, _, dd, _, _] =
            table.damped.each_ref().map(|list| list[mode]);
        for (entry, value) in block.damped.iter_mut().zip([aa, ab, bb]) {
            entry[lane] = value;
        }
        let participations = [&reduced.participation, &reduced.across];
        for (axis, driven) in block.driven.iter_mut().enumerate() {
            let participation = participations[axis][mode];
            for column in 0..2 {
                driven.displacement[column][lane] =
                    -participation * table.displacement[column + 2][mode];
                driven.velocity[column][lane] = -participation * table.velocity[column + 2][mode];
                driven.area[column][lane] = participation * table.area[column][mode];
            }
            for (entry, value) in driven.damped.iter_mut().zip([ac, ad, bc, bd]) {
                entry[lane] = -participation * value;
            }
            driven.participation[lane] = participation;
            for (from, second) in participations[..N].iter().enumerate() {
                let both = participation * second[mode];
                let damped = &mut by_ground.damped[axis][from];
                for (sum, value) in damped.iter_mut().zip([cc, cd, dd]) {
                    *sum += both * value;
                }
                let area = &mut by_ground.area[axis][from];
                for (column, sum) in area.iter_mut().enumerate() {
                    *sum -= both * table.area[column + 2][mode];
                }
            }
        }
        block.damping[lane] = reduced.damping[mode];
        block.stiffness[lane] = reduced.stiffness[mode];
    }
}

impl FreeSteps {
    pub(super) fn new(reduced: &Reduced) -> Self {
        let stride = reduced.modes().div_ceil(LANES) * LANES;
        Self {
            step: 0.0,
            ahead: FEWEST,
            lanes: Vec::new(),
            lanes_in_space: Vec::new(),
            by_ground: ByGround::default(),
            start: [(); 2].map(|()| vec![0.0; stride]),
            modal: [(); 4].map(|()| vec![0.0; stride * MOST]),
            shown: [(); 4].map(|()| vec![0.0; reduced.listed() * (MOST + 1)]),
            ends: Vec::with_capacity(MOST),
            ground: Vec::with_capacity(MOST + 1),
            sums: Vec::with_capacity(MOST),
        }
    }

    /// Uses the factors of a table.
    fn set(&mut self, reduced: &Reduced, table: &StepTable) {
        self.step = table.step;
        let by_ground = &mut self.by_ground;
        if reduced.across.is_empty() {
            fill_lanes(&mut self.lanes, by_ground, table, reduced);
        } else {
            fill_lanes(&mut self.lanes_in_space, by_ground, table, reduced);
        }
    }

    /// All planned steps with these factors.
    fn look_ahead<const N: usize>(&mut self, lanes: &[Lanes<N>], reduced: &Reduced) {
        let [q, v, a, j] = &mut self.modal;
        let [q0, v0] = &self.start;
        Arch::new().dispatch(FreeStepsKernel {
            ahead: Ahead {
                lanes,
                ground: &self.ground,
                start: [q0, v0],
                modal: [q, v, a, j],
                sums: &mut self.sums,
            },
            reduced,
            shown: &mut self.shown,
        });
    }

    /// Monitored quantities after a number of steps.
    fn watched(&self, places: usize, steps: usize) -> Watched<'_> {
        let range = steps * places..(steps + 1) * places;
        let [u, rate, acceleration, unloaded_jerk] = &self.shown;
        Watched {
            u: &u[range.clone()],
            rate: &rate[range.clone()],
            acceleration: &acceleration[range.clone()],
            unloaded_jerk: &unloaded_jerk[range],
        }
    }

    /// Modal displacements and velocities after a number of steps, at least one.
    fn state(&self, modes: usize, steps: usize) -> [&[f64]; 2] {
        let from = (steps - 1) * self.start[0].len();
        let [q, v, ..] = &self.modal;
        [&q[from..from + modes], &v[from..from + modes]]
    }
}

/// Steps ahead, and what they show.
struct FreeStepsKernel<'a, const N: usize> {
    ahead: Ahead<'a, N>,
    reduced: &'a Reduced,
    shown: &'a mut [Vec<f64>; 4],
}

impl<const N: usize> WithSimd for FreeStepsKernel<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            ahead,
            reduced,
            shown,
        } = self;
        let (steps, stride) = (ahead.sums.len(), ahead.start[0].len());
        let places = reduced.listed();
        let [q, v, a, j] = ahead.modal;
        let again = Ahead {
            modal: [&mut *q, &mut *v, &mut *a, &mut *j],
            ..ahead
        };
        again.with_simd(simd);
        let modal = [&*q, &*v, &*a, &*j];
        for step in 0..steps {
            for building in &reduced.buildings {
                let from = step * stride;
                let modes = from + building.modes.start..from + building.modes.end;
                let building_watched = &building.watched;
                let from = (step + 1) * places;
                let places = from + building_watched.start..from + building_watched.end;
                let [first, second, third, fourth] = &mut *shown;
                let show = Show {
                    blocks: &building.blocks,
                    modal: modal.map(|list| &list[modes.clone()]),
                    watched: [
                        &mut first[places.clone()],
                        &mut second[places.clone()],
                        &mut third[places.clone()],
                        &mut fourth[places],
                    ],
                };
                show.with_simd(simd);
            }
        }
        let Some(plan) = &reduced.plan else { return };
        for list in shown {
            for step in 1..=steps {
                let values = &mut list[step * places..(step + 1) * places];
                plan.fill(reduced.arch(), values);
            }
        }
    }
}

impl ModalStepper<'_> {
    /// Takes several regular steps at once in which nothing touches; false when there is none, and a step
    /// is to be taken by itself.
    pub(super) fn take_free(&mut self, run: &mut RunState<'_>) -> bool {
        let quiet = |phase: &ContactPhase| *phase == ContactPhase::Open;
        if !self.reduced.links.is_empty()
            || run.ground_jumps
            || !run.near.iter().all(|contact| quiet(&run.phases[*contact]))
            || run.contact_division.iter().any(|d| *d > 1)
        {
            return false;
        }
        let planned = self.plan_ahead(run);
        if planned == 0 {
            return false;
        }
        self.compute_ahead();
        let free = self.count_free(run);
        self.free_steps.ahead = if free < planned {
            FEWEST
        } else {
            (2 * planned).min(MOST)
        };
        if free == 0 {
            return false;
        }
        for step in 0..free {
            self.record_free_step(run, step, free);
        }
        self.move_to_last(run, free);
        true
    }

    /// Where the next steps end, and how the ground moves there; returns their number.
    fn plan_ahead(&mut self, run: &mut RunState<'_>) -> usize {
        let free_steps = &mut self.free_steps;
        free_steps.ends.clear();
        free_steps.ground.clear();
        free_steps.ground.push(run.ground[0]);
        let (mut clock, mut slot) = (run.clock, None);
        while free_steps.ends.len() < free_steps.ahead {
            let stride = clock.next_step(self.least_division);
            let left = run.motion.duration - clock.time();
            if !stride.regular || stride.length > left * (1.0 + 1e-9) {
                break;
            }
            slot = slot.or(Some(stride));
            clock = stride.end;
            free_steps.ends.push(clock);
            free_steps.ground.push(run.motion.components(clock.time()));
        }
        let planned = free_steps.ends.len();
        if let Some(stride) = slot {
            let slot = self.table_for(run, &stride);
            if self.free_steps.step != stride.length {
                self.free_steps.set(self.reduced, &self.tables[slot]);
            }
        }
        planned
    }

    /// All planned steps, as if nothing touched.
    fn compute_ahead(&mut self) {
        let (free_steps, reduced) = (&mut self.free_steps, self.reduced);
        for (list, now) in free_steps.start.iter_mut().zip([&self.q[0], &self.v[0]]) {
            list[..now.len()].copy_from_slice(now);
        }
        let now = [
            &self.u[0],
            &self.rate[0],
            &self.acceleration[0],
            &self.unloaded_jerk[0],
        ];
        for (list, now) in free_steps.shown.iter_mut().zip(now) {
            list[..now.len()].copy_from_slice(now);
        }
        free_steps.sums.clear();
        free_steps
            .sums
            .resize(free_steps.ends.len(), Sums::default());
        if self.reduced.across.is_empty() {
            let lanes = std::mem::take(&mut free_steps.lanes);
            free_steps.look_ahead(&lanes, reduced);
            free_steps.lanes = lanes;
        } else {
            let lanes = std::mem::take(&mut free_steps.lanes_in_space);
            free_steps.look_ahead(&lanes, reduced);
            free_steps.lanes_in_space = lanes;
        }
    }

    /// How many of the planned steps end before anything can touch, or is no number any more.
    fn count_free(&mut self, run: &RunState<'_>) -> usize {
        let free_steps = &self.free_steps;
        let mut near = self.peaks.near.take();
        let arch = self.reduced.arch();
        let places = self.reduced.listed();
        let mut is_free = |step: usize| {
            let sums = &free_steps.sums[step];
            let energy = sums.kinetic.iter().sum::<f64>() + sums.strain.iter().sum::<f64>();
            if !energy.is_finite() {
                return false;
            }
            let [then, now] = [step, step + 1].map(|at| free_steps.watched(places, at));
            if let Some(near) = &mut near {
                let ends = [[then.u, then.rate], [now.u, now.rate]];
                return !run.pounding || near.find_near(arch, ends, free_steps.step).is_empty();
            }
            !run.pounding
                || (0..run.phases.len()).all(|index| {
                    let closing = |list: &[f64]| self.reduced.closing(index, list);
                    // Near misses are for single steps, which look at them.
                    let width = run.widths[index]
                        - near_contacts::doubt(run, index, self.peaks.closing[index].value);
                    Cubic::new(
                        closing(then.u) - width,
                        closing(then.rate),
                        closing(now.u) - width,
                        closing(now.rate),
                        free_steps.step,
                    )
                    .stays_below_zero()
                })
        };
        let planned = free_steps.ends.len();
        let free = (0..planned)
            .position(|step| !is_free(step))
            .unwrap_or(planned);
        self.peaks.near = near;
        free
    }

    /// Records one free step: energies, peaks, and a row of the history if one is due.
    fn record_free_step(&mut self, run: &mut RunState<'_>, index: usize, free: usize) {
        let (free_steps, places) = (&self.free_steps, self.reduced.listed());
        let step = free_steps.step;
        let [g0, g1] = [free_steps.ground[index], free_steps.ground[index + 1]];
        let sums = &free_steps.sums[index];
        let total = |lanes: &[f64; LANES]| lanes.iter().sum::<f64>();
        let components = if self.reduced.across.is_empty() { 1 } else { 2 };
        let (by_ground, grounds) = (&free_steps.by_ground, [g0, g1]);
        self.energy.damped += total(&sums.damped) + by_ground.damped(grounds, components);
        let participations = [&self.reduced.participation, &self.reduced.across];
        for axis in 0..components {
            let area = total(&sums.area[axis]) + by_ground.area(axis, grounds, components);
            let before = if index == 0 {
                simd::dot(participations[axis], &self.q[0])
            } else {
                total(&free_steps.sums[index - 1].moved[axis])
            };
            // ∫ a_g q̇ dt by parts.
            let moved = total(&sums.moved[axis]);
            let (then, now) = (g0[axis], g1[axis]);
            self.energy.input += (now - then) / step * area - (now * moved - then * before);
        }
        let energy = self
            .energy
            .balance(0.5 * total(&sums.kinetic), 0.5 * total(&sums.strain));
        let start = run.time;
        run.time = free_steps.ends[index].time();
        let now = free_steps.watched(places, index + 1);
        let modes = self.reduced.modes();
        let taken = Taken {
            then: free_steps.watched(places, index),
            now,
            ground: [g0, g1].map(GroundsAt::common),
            start,
            step,
            motion: StepMotion {
                start: match index {
                    0 => [&self.q[0], &self.v[0]],
                    _ => free_steps.state(modes, index),
                },
                loads: Loads::Ground,
                ground: [g0, g1].map(GroundsAt::common),
                step,
            },
        };
        if let Some(near) = &mut self.peaks.near {
            near.open(self.reduced.arch(), now.u);
        }
        self.peaks.after_step(run.system, self.reduced, &taken);
        let [q, v] = free_steps.state(modes, index + 1);
        let [a, jerk] = [2, 3]
            .map(|list| &free_steps.modal[list][index * free_steps.start[0].len()..][..modes]);
        let instant = Instant {
            q,
            v,
            a,
            jerk,
            time: run.time,
            ground: GroundsAt::common(g1),
            phases: &run.phases,
            smooth: true,
        };
        if (index + 1).is_multiple_of(self.rows_per_step) || index + 1 == free {
            self.peaks.follow_forces(run.system, self.reduced, instant);
        }
        if self.peaks.is_due(run.time, false) {
            self.peaks.record(
                run.system,
                self.reduced,
                instant,
                now,
                (&[], &run.grounds),
                &energy,
            );
        }
        run.work.steps += 1;
        run.work.solves += 1;
    }

    /// Moves to the end of the last free step.
    fn move_to_last(&mut self, run: &mut RunState<'_>, steps: usize) {
        let (free_steps, places) = (&self.free_steps, self.reduced.listed());
        let modes = self.reduced.modes();
        let stride = free_steps.start[0].len();
        for step in 0..steps {
            let accelerations = &free_steps.modal[2][step * stride..][..modes];
            if self.reached.widen(accelerations, Some(free_steps.step)) {
                let (watched, ground) = (
                    free_steps.watched(places, step + 1),
                    free_steps.ground[step + 1],
                );
                let (system, reduced) = (run.system, self.reduced);
                reduced.show_forces(
                    free_steps.state(modes, step + 1)[0],
                    &mut self.checked_forces,
                );
                let forces = &self.checked_forces;
                self.reached.look(
                    system,
                    reduced,
                    accelerations,
                    watched,
                    GroundsAt::common(ground),
                    forces,
                );
            }
        }
        let [q, v] = free_steps.state(self.reduced.modes(), steps);
        self.q[0].copy_from_slice(q);
        self.v[0].copy_from_slice(v);
        let now = free_steps.watched(places, steps);
        self.u[0].copy_from_slice(now.u);
        self.rate[0].copy_from_slice(now.rate);
        self.acceleration[0].copy_from_slice(now.acceleration);
        self.unloaded_jerk[0].copy_from_slice(now.unloaded_jerk);
        run.clock = free_steps.ends[steps - 1];
        let ground = free_steps.ground[steps];
        run.ground = [ground; 2];
        self.reduced.set_ground_loads(ground, &mut self.p[0]);
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use super::*;
    use crate::history::{Column, Kind, Owner, Work};
    use crate::stepping::modal::Refinement;
    use crate::stepping::modal::finish::finish;
    use crate::stepping::modal::stepper::runner;
    use crate::stepping::modal::{Rates, rates};
    use crate::{
        Analysis, Building, ContactLaw, Damping, Gap, GroundMotion, LawKind, Model, Outcome, Plan,
        RestitutionIs, Settings, Shear, Solver, Structure, System,
    };

    fn row_of_towers() -> Model {
        let tower = |name: &str, floors: usize, stiffness: f64| Building {
            name: name.into(),
            structure: Structure::Shear(Shear {
                mass: vec![5e4; floors],
                stiffness: vec![stiffness; floors],
                storey_heights: vec![3.0; floors],
            }),
            damping: Damping::ratio(0.05, [1, 2]),
            ..Building::default()
        };
        let law = ContactLaw {
            kind: LawKind::HertzDamp,
            stiffness: 2e9,
            restitution: 0.65,
            restitution_is: RestitutionIs::Input,
        };
        Model {
            title: "row".into(),
            buildings: vec![
                tower("soft", 3, 2e7),
                tower("stiff", 9, 9e7),
                tower("last", 5, 6e7),
            ],
            gaps: vec![Gap::after(0, 0.02, law), Gap::after(1, 0.04, law)],
            analysis: Analysis {
                solver: Some(Solver::Modal),
                ..Analysis::default()
            },
            ..Model::default()
        }
    }

    /// The same run with several steps at once and step by step.
    fn run(model: &Model, record_interval: Option<f64>, most: usize) -> Outcome {
        let system = System::assemble(model).expect("a valid model");
        let shaking = |i: u32| {
            let t = 0.02 * f64::from(i);
            2.5 * (7.0 * t).sin() * (-0.2 * t).exp() + 0.8 * (23.0 * t).cos()
        };
        let motion = GroundMotion::sampled("shaking", 0.02, (0..=700).map(shaking).collect());
        let plan = Plan::choose(&system, &motion, &model.analysis).expect("sensible steps");
        let rates: Vec<Rates> = (0..3).map(|index| rates(&system, index)).collect();
        let mut work = Work::default();
        let reduced = Reduced::new(&system, &rates, 1e-4, false, &mut work).expect("stable");
        let settings = Settings {
            record_interval,
            ..Settings::default()
        };
        let refinement = Refinement { division: 1, work };
        let mut runner = runner(&system, &motion, &plan, settings, &reduced, refinement);
        runner.stepper.free_steps.ahead = most;
        finish(runner, &mut |_| ControlFlow::Continue(())).0
    }

    #[test]
    fn free_steps_at_once_are_so_many_steps() {
        let model = row_of_towers();
        for record_interval in [None, Some(0.004)] {
            let together = run(&model, record_interval, FEWEST);
            // Zero steps at once are never tried.
            let apart = run(&model, record_interval, 0);
            assert!(together.impacts.len() > 10, "{}", together.impacts.len());
            let work = |outcome: &Outcome| (outcome.work.steps, outcome.work.contact_steps);
            assert_eq!(work(&together), work(&apart));
            assert_eq!(together.impacts.len(), apart.impacts.len());
            let close = |a: f64, b: f64, what: &str| {
                assert!(
                    (a - b).abs() <= 1e-9 * a.abs().max(1e-6),
                    "{what}: {a}, {b}"
                );
            };
            for (a, b) in together.impacts.iter().zip(&apart.impacts) {
                close(a.peak_force, b.peak_force, "force");
                close(a.start, b.start, "touch");
            }
            let floors = together.peaks.buildings().flatten();
            for (a, b) in floors.zip(apart.peaks.buildings().flatten()) {
                close(
                    a.displacement_max().value,
                    b.displacement_max().value,
                    "right",
                );
                close(
                    a.displacement_min().value,
                    b.displacement_min().value,
                    "left",
                );
                close(a.displacement_max().at, b.displacement_max().at, "when");
                close(a.storey_drift(), b.storey_drift(), "drift");
                close(
                    a.total_acceleration(),
                    b.total_acceleration(),
                    "acceleration",
                );
            }
            for kind in [Kind::Shear, Kind::Closing] {
                let sizes = |run: &Outcome| {
                    let floors = |column: Column| matches!(column.owner, Owner::Floor { .. });
                    run.peaks
                        .sizes(|column| column.kind == kind && !floors(column))
                };
                for (a, b) in sizes(&together).into_iter().zip(sizes(&apart)) {
                    close(a, b, "shear or closing");
                }
            }
            let (a, b) = (together.energy, apart.energy);
            close(a.input, b.input, "input");
            close(a.damped, b.damped, "damped");
            assert!(a.worst_imbalance < 1e-9, "{}", a.worst_imbalance);
            match (&together.history, &apart.history) {
                (Some(a), Some(b)) => {
                    assert_eq!(a.len(), b.len());
                    for column in a.columns() {
                        let [a, b] = [a, b].map(|history| history.column(*column));
                        let (a, b) = (a.expect("a column"), b.expect("a column"));
                        let most = a.iter().fold(1e-9, |most: f64, a| most.max(a.abs()));
                        let apart = a.iter().zip(&b).map(|(a, b)| (a - b).abs());
                        assert!(apart.fold(0.0, f64::max) <= 1e-8 * most, "{column:?}");
                    }
                }
                (a, b) => assert!(a.is_none() && b.is_none()),
            }
        }
    }
}
