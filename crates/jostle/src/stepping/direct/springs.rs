//! Springs that yield: the outer iteration of a step (theory, Eqs. Y1 to Y3).
//!
//! Every spring is linear near its last known point, m = m_r + k_t (δ − δ_r). The step is solved, contacts
//! included, and repeated with the lines at the new deformations until every spring lies on the line it was solved
//! with. Forces increase with deformation, or fall so slowly that masses outweigh it, so the step has one solution; the
//! number of lines is finite, so it is reached exactly. Damping in proportion to tangents is a dashpot beside the spring, with the
//! tangent at the start of the step.

use super::{Direct, plan_forces};
use crate::history::SpringEvent;
use crate::hysteresis::{HysteresisMemory, HysteresisRule, Rates, Stage};
use crate::linear::NotPositive;
use crate::state::State;
use crate::stepping::outcome::StepError;
use crate::stepping::runner::RunState;
use crate::stepping::totals::SpringTotals;
use crate::structure::YieldingSpring;
use crate::system::{BuildingSystem, System};

/// A spring in the trial step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct SpringTrial {
    /// Start of the line: deformation and force.
    pub(super) deformation: f64,
    force: f64,
    tangent: f64,
    /// What the committed velocity and acceleration take from the change of deformation (theory, Eq. Y2) \[rad or m\].
    rate_term: f64,
    /// Rates of the deformation; that at the end belongs to no change of deformation.
    pub(super) rates: Rates,
    /// Dashpot beside it over the step \[N·s/m, N·m·s/rad\], and its force at the end if the deformation does not change.
    pub(super) dashpot: f64,
    damped: f64,
    /// Force with which the solution before was balanced there.
    pub(super) balance: f64,
    /// Result of the solution: deformation, force on the line, and response of the rule.
    pub(super) reached: f64,
    pub(super) on_line: f64,
    pub(super) answer: f64,
    pub(super) next_tangent: f64,
}

impl SpringTrial {
    /// Difference of the rule from the line, as a fraction of the yield force.
    fn misfit(&self, yield_force: f64) -> f64 {
        (self.answer - self.on_line).abs() / yield_force.max(self.answer.abs())
    }

    /// Motion over the step if it ends at a deformation.
    #[inline]
    pub(super) fn rates_to(&self, memory: &HysteresisMemory, deformation: f64) -> Rates {
        let change = deformation - memory.deformation();
        Rates {
            after: self.rates.after + self.rates.per_deformation * change,
            ..self.rates
        }
    }

    /// Slope of its force over the step, dashpot included.
    fn slope(&self) -> f64 {
        self.tangent + self.dashpot * self.rates.per_deformation
    }

    /// Force of the dashpot beside it at the end of the step, after a change of deformation.
    fn damped_after(&self, change: f64) -> f64 {
        self.damped + self.dashpot * self.rates.per_deformation * change
    }

    /// Whether it is on the line within rounding.
    fn fits(&self, yield_force: f64) -> bool {
        let apart = (self.answer - self.on_line).abs();
        apart <= FIT * yield_force || apart <= FIT * self.answer.abs()
    }
}

/// Data of a run about its yielding springs.
#[derive(Clone, Debug, Default)]
pub(super) struct YieldingSprings {
    pub(super) trials: Vec<SpringTrial>,
    /// Slopes of the springs after the last step.
    pub(super) tangents: Vec<f64>,
    /// Slopes of the current trial lines.
    wanted: Vec<f64>,
    /// Forces with which the last step was balanced; those of the rules differ by rounding.
    pub(super) balanced: Vec<f64>,
    /// Forces of the dashpots beside springs at its end.
    pub(super) damped: Vec<f64>,
    /// Whether dashpots beside springs follow their tangents.
    pub(super) damped_by_tangents: bool,
    /// Loads of the step without springs.
    loads: Vec<f64>,
    stages: Vec<Stage>,
    /// Cracks and first yields so far, and panels that fell.
    pub(super) events: Vec<SpringEvent>,
    /// Greatest force and work of every spring.
    pub(super) totals: Vec<SpringTotals>,
}

impl YieldingSprings {
    pub(super) fn starting_from(system: &System, state: &State) -> Self {
        let springs = || {
            let buildings = system.buildings.iter();
            buildings.flat_map(|building| &building.equations.springs)
        };
        let count = springs().count();
        if count == 0 {
            return Self::default();
        }
        let known = || springs().zip(&state.springs);
        let damped = system.buildings.iter().flat_map(|building| {
            let v = &state.velocity[building.range()];
            let equations = &building.equations;
            let memories = &state.springs[building.spring_range()];
            let known = equations.springs.iter().zip(memories);
            known.map(|(spring, memory)| equations.tangent_damping(spring, memory, v))
        });
        Self {
            trials: vec![SpringTrial::default(); count],
            tangents: known()
                .map(|(spring, memory)| spring.hysteresis.unloading_stiffness(memory))
                .collect(),
            wanted: vec![0.0; count],
            balanced: state.springs.iter().map(HysteresisMemory::force).collect(),
            damped: damped.collect(),
            damped_by_tangents: springs().any(|spring| spring.damped_by_tangent),
            loads: vec![0.0; system.len()],
            stages: known()
                .map(|(spring, memory)| spring.hysteresis.stage(memory))
                .collect(),
            events: Vec::with_capacity(3 * count),
            totals: known()
                .map(|(spring, memory)| SpringTotals {
                    peak_force: memory.force().abs(),
                    work: spring.hysteresis.recoverable_energy(memory),
                })
                .collect(),
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.trials.is_empty()
    }
}

/// Tolerance of a spring on its line, as a fraction of the yield force.
pub(super) const FIT: f64 = 1e-12;
/// Number of iterations before a line search.
const PLAIN_ITERATIONS: usize = 8;
/// Largest number of iterations.
const MOST_ITERATIONS: usize = 30;
/// Bisections of the line search.
const HALVINGS: usize = 12;

impl Direct {
    /// Solves the step whose loads stand in `increment`, springs and contacts together.
    pub(super) fn find_spring_forces(
        &mut self,
        run: &mut RunState<'_>,
        slot: usize,
    ) -> Result<(), StepError> {
        self.yielding.loads.copy_from_slice(&self.increment);
        self.lay_first_lines(run, slot);
        for iteration in 1..=MOST_ITERATIONS {
            self.retune(run, slot)?;
            self.increment.copy_from_slice(&self.yielding.loads);
            self.add_spring_loads(run);
            self.factors[slot].solve(
                run.system,
                &self.equations,
                &mut self.increment,
                &mut self.scratch,
                &mut run.work,
            );
            self.solve_contacts(run, slot)?;
            run.work.outer_iterations += 1;
            if self.follow_springs(run) {
                return Ok(());
            }
            if iteration > PLAIN_ITERATIONS {
                self.search_on_the_way(run);
            }
            for trial in &mut self.yielding.trials {
                trial.deformation = trial.reached;
                trial.force = trial.answer;
                trial.tangent = trial.next_tangent;
                trial.balance = trial.on_line;
            }
        }
        Err(StepError::SpringsDiverged {
            building: self.worst_building(run),
            time: run.time,
        })
    }

    /// Lines through the committed points, with the tangents of the last step: most springs go on as they were.
    fn lay_first_lines(&mut self, run: &RunState<'_>, slot: usize) {
        for (trial, memory) in self.yielding.trials.iter_mut().zip(&self.state.springs) {
            trial.deformation = memory.deformation();
            trial.force = memory.force();
        }
        let factors = &self.factors[slot];
        let k = factors.coefficients;
        for (building, coefficients) in run.system.buildings.iter().zip(&factors.buildings) {
            let range = building.range();
            let (v, a) = (
                &self.state.velocity[range.clone()],
                &self.state.acceleration[range],
            );
            let equations = &building.equations;
            let trials = self.yielding.trials[building.spring_range()].iter_mut();
            let known = trials.zip(&self.yielding.tangents[building.spring_range()]);
            for (spring, (trial, tangent)) in equations.springs.iter().zip(known) {
                let rate = spring.deformation(v);
                let rate_term = k.d_v * rate + k.d_a * spring.deformation(a);
                trial.rate_term = coefficients.shift * rate_term;
                trial.rates = Rates {
                    before: rate,
                    after: rate + rate_term,
                    per_deformation: k.c,
                    step: k.step,
                };
                trial.tangent = *tangent;
                trial.dashpot = equations.tangent_dashpot(spring, *tangent);
                trial.damped = trial.dashpot * trial.rates.after;
            }
        }
    }

    /// Brings the factors of a slot up to the tangents of the present lines.
    fn retune(&mut self, run: &mut RunState<'_>, slot: usize) -> Result<(), StepError> {
        let tangents = self.yielding.trials.iter().map(SpringTrial::slope);
        for (place, tangent) in self.yielding.wanted.iter_mut().zip(tangents) {
            *place = tangent;
        }
        self.factors[slot]
            .retune(
                run.system,
                &self.joints,
                &self.equations,
                &self.yielding.wanted,
                &mut run.work,
            )
            .map_err(|(building, source)| self.not_positive(run, building, source))
    }

    /// The error of equations that are not positive: of a building, or of its springs that fall.
    pub(super) fn not_positive(
        &self,
        run: &RunState<'_>,
        building: usize,
        source: NotPositive,
    ) -> StepError {
        let system_building = &run.system.buildings[building];
        let (building, time) = (system_building.name.clone(), run.time);
        let falls = |tangents: &[f64]| tangents.iter().any(|tangent| *tangent < 0.0);
        let springs = system_building.spring_offset
            ..system_building.spring_offset + system_building.equations.single_springs;
        let yielding = &self.yielding;
        if [&yielding.wanted, &yielding.tangents]
            .iter()
            .any(|tangents| tangents.get(springs.clone()).is_some_and(falls))
        {
            return StepError::FallsTooFast {
                building,
                time,
                source,
            };
        }
        StepError::NotPositive {
            building,
            time,
            source,
        }
    }

    /// −(m_r − m) + k_t (δ_r − δ) + s k_t gᵀ D′ of every spring (theory, Eq. Y2).
    fn add_spring_loads(&mut self, run: &RunState<'_>) {
        for building in &run.system.buildings {
            let (range, springs) = (building.range(), building.spring_range());
            let load = &mut self.increment[range];
            let balanced = self.yielding.balanced[springs.clone()].iter();
            let balanced = balanced.zip(&self.yielding.damped[springs.clone()]);
            let now = self.state.springs[springs.clone()].iter().zip(balanced);
            let trials = &self.yielding.trials[springs];
            for ((spring, trial), (memory, (balanced, damped))) in
                building.equations.springs.iter().zip(trials).zip(now)
            {
                let force = balanced - trial.force
                    + trial.tangent * (trial.deformation - memory.deformation() + trial.rate_term)
                    + (damped - trial.damped_after(-trial.rate_term));
                spring.row.push(force, load);
            }
        }
    }

    /// Deformations at the end of the tried step and what the rules answer; whether all springs are on their lines.
    fn follow_springs(&mut self, run: &RunState<'_>) -> bool {
        let mut all_fit = true;
        for building in &run.system.buildings {
            let (range, springs) = (building.range(), building.spring_range());
            let increment = &self.increment[range];
            let memories = &self.state.springs[springs.clone()];
            let single = building.equations.single_springs;
            let (uniaxial, in_plan) = building.equations.springs.split_at(single);
            let (trials, rows) = self.yielding.trials[springs].split_at_mut(single);
            let reach = |spring: &YieldingSpring, trial: &mut SpringTrial, memory: &_| {
                let change = spring.deformation(increment) - trial.rate_term;
                trial.reached = HysteresisMemory::deformation(memory) + change;
                trial.on_line = trial.force + trial.tangent * (trial.reached - trial.deformation);
            };
            for ((spring, trial), memory) in uniaxial.iter().zip(trials).zip(memories) {
                reach(spring, trial, memory);
                let rates = trial.rates_to(memory, trial.reached);
                [trial.answer, trial.next_tangent] =
                    spring.hysteresis.answer(memory, trial.reached, &rates);
                all_fit &= trial.fits(spring.hysteresis.backbone().yield_force());
            }
            for own in plan_forces::together(in_plan) {
                let (springs, rows) = (&in_plan[own.clone()], &mut rows[own.clone()]);
                let memories = &memories[single..][own];
                for ((spring, row), memory) in springs.iter().zip(&mut *rows).zip(memories) {
                    reach(spring, row, memory);
                }
                all_fit &= plan_forces::follow(springs, rows, memories);
            }
        }
        all_fit
    }

    /// Goes back from the deformations reached to where the potential of the step is least on the way to them: its
    /// slope there is Σ Δδ (m(δ) − m̃), m̃ being the forces that balance the rest of the step (theory, Eq. Y3).
    fn search_on_the_way(&mut self, run: &RunState<'_>) {
        let slope = |share: f64, direct: &Self| -> f64 {
            let mut sum = 0.0;
            for building in &run.system.buildings {
                let range = building.spring_range();
                let single = building.equations.single_springs;
                let (uniaxial, in_plan) = building.equations.springs.split_at(single);
                let trials = &direct.yielding.trials[range.clone()];
                let memories = &direct.state.springs[range];
                let known = trials.iter().zip(memories);
                for (spring, (trial, memory)) in uniaxial.iter().zip(known) {
                    let way = trial.reached - trial.deformation;
                    let at = trial.deformation + share * way;
                    let balance = trial.balance + share * (trial.on_line - trial.balance);
                    let rates = trial.rates_to(memory, at);
                    sum += way * (spring.hysteresis.answer(memory, at, &rates)[0] - balance);
                }
                let (rows, memories) = (&trials[single..], &memories[single..]);
                for own in plan_forces::together(in_plan) {
                    let (springs, rows) = (&in_plan[own.clone()], &rows[own.clone()]);
                    sum += plan_forces::slope(springs, rows, &memories[own], share);
                }
            }
            sum
        };
        // Contact forces do not lie on one line over the way: then simply half of it, and back from there.
        let contacts = run.in_contact();
        if !contacts && slope(1.0, self) <= 0.0 {
            return;
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..if contacts { 1 } else { HALVINGS } {
            let middle = 0.5 * (low + high);
            if contacts || slope(middle, self) > 0.0 {
                high = middle;
            } else {
                low = middle;
            }
        }
        for building in &run.system.buildings {
            let range = building.spring_range();
            let single = building.equations.single_springs;
            let (uniaxial, in_plan) = building.equations.springs.split_at(single);
            let (trials, rows) = self.yielding.trials[range.clone()].split_at_mut(single);
            let memories = &self.state.springs[range];
            let go_back = |trial: &mut SpringTrial| {
                trial.reached = trial.deformation + high * (trial.reached - trial.deformation);
                trial.on_line = trial.balance + high * (trial.on_line - trial.balance);
            };
            for (spring, (trial, memory)) in uniaxial.iter().zip(trials.iter_mut().zip(memories)) {
                go_back(trial);
                let rates = trial.rates_to(memory, trial.reached);
                [trial.answer, trial.next_tangent] =
                    spring.hysteresis.answer(memory, trial.reached, &rates);
            }
            rows.iter_mut().for_each(go_back);
            for own in plan_forces::together(in_plan) {
                let (springs, rows) = (&in_plan[own.clone()], &mut rows[own.clone()]);
                plan_forces::answer(springs, rows, &memories[single..][own]);
            }
        }
    }

    /// Takes over what the springs did in the accepted step.
    pub(super) fn commit_springs(&mut self, run: &RunState<'_>) {
        let springs = run
            .system
            .buildings
            .iter()
            .flat_map(|building| &building.equations.springs);
        let time = run.time;
        for (index, (spring, trial)) in springs.zip(&self.yielding.trials).enumerate() {
            if spring.hysteresis.slides_in_stages() {
                let rows = &self.yielding.trials[index..];
                plan_forces::slide_stages(spring, rows, &mut self.state.springs[index..]);
            }
            let memory = &mut self.state.springs[index];
            let change = trial.reached - memory.deformation();
            let work = 0.5 * (self.yielding.balanced[index] + trial.on_line) * change;
            self.audit.springs += work;
            let damped = trial.damped_after(change);
            self.audit.damped += 0.5 * (self.yielding.damped[index] + damped) * change;
            self.yielding.damped[index] = damped;
            spring
                .hysteresis
                .commit(memory, trial.reached, trial.answer);
            self.yielding.balanced[index] = trial.on_line;
            self.yielding.tangents[index] = trial.next_tangent;
            let known = &mut self.yielding.stages[index];
            let stage = match known {
                // Only braces go further.
                Stage::Yielded
                    if !matches!(spring.hysteresis.rule(), HysteresisRule::Buckling(_)) =>
                {
                    Stage::Yielded
                }
                _ => spring.hysteresis.stage(memory),
            };
            if stage > *known {
                *known = stage;
                self.yielding.events.push(SpringEvent {
                    spring: index,
                    stage,
                    time,
                });
            }
            let totals = &mut self.yielding.totals[index];
            totals.peak_force = totals.peak_force.max(memory.force().abs());
            totals.work += work;
        }
        for building in &run.system.buildings {
            building.weaken(&mut self.state.springs[building.spring_range()]);
        }
    }

    fn worst_building(&self, run: &RunState<'_>) -> String {
        let worst = run.system.buildings.iter().max_by(|a, b| {
            let misfit = |building: &BuildingSystem| {
                let springs = building.equations.springs.iter();
                springs
                    .zip(&self.yielding.trials[building.spring_range()])
                    .map(|(spring, trial)| trial.misfit(spring.hysteresis.backbone().yield_force()))
                    .fold(0.0, f64::max)
            };
            misfit(a).total_cmp(&misfit(b))
        });
        worst.map_or_else(String::new, |building| building.name.clone())
    }
}
