//! The reference of what yields, slides, stands in plan, on bearings or on soil, or is joined by links that are not linear: the method of
//! Dormand and Prince (1980, J. Comput. Appl. Math. 6, 19–26) on M ü = forces, with steps that end wherever a force comes to another
//! smooth piece.
//!
//! It shares with the steppers of jostle what [`System`] says of a model: masses, stiffness and damping matrices, rows of springs, links
//! and contacts, and the rules of hysteresis ([`jostle::hysteresis::Hysteresis::respond`]), which are verified elsewhere. Contact laws
//! are those of [`super::laws`], links and friction are written anew.
//!
//! Touches, releases, corners, reversals and the starts and ends of slipping are located on polynomials of degree five over a step and
//! the step is taken again up to there. Peaks are those of quartics through five instants of a step.
//!
//! Displacements without mass stand where they are in equilibrium at every instant (`massless`); dashpots and friction act on none of
//! them.

mod bodies;
mod course;
mod events;
mod forces;
mod massless;
mod slider;
#[cfg(test)]
mod tests;
mod watch;

use jostle::{GroundMotion, System};

use super::reference::Peaks;
use bodies::{Bodies, record_steps};
use forces::{Forces, Motion, Phases};
use watch::{Taken, Watch};

/// How fine.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fineness {
    /// Error of one step over the greatest motion so far.
    pub error: f64,
    /// Relative change of every gap.
    pub widen: f64,
}

impl Fineness {
    /// That of the reference.
    pub(super) const FINE: Self = Self {
        error: 1e-11,
        widen: 0.0,
    };
    /// For its conditioning.
    pub(super) const OTHER: Self = Self {
        error: 3e-10,
        widen: 1e-6,
    };
}

/// Steps after which there is no reference.
const MOST_STEPS: u64 = 3_000_000;
/// Events at one instant after which there is none.
const MOST_AT_ONCE: usize = 2_000;
/// The shortest step \[s\].
const SHORTEST: f64 = 1e-14;

/// Whether a system has parts that only this reference knows.
#[must_use]
pub(super) fn is_needed(system: &System) -> bool {
    let of_building = |building: &jostle::system::BuildingSystem| {
        !building.equations.springs.is_empty()
            || building.is_in_space()
            || building.discretization.mat.is_some()
            || building.foundation.is_some()
    };
    system.buildings.iter().any(of_building) || system.links.iter().any(|link| !link.is_linear())
}

/// Runs a system.
///
/// # Errors
/// Why there is no reference.
pub(super) fn run(
    system: &System,
    motion: &GroundMotion,
    fineness: Fineness,
) -> Result<Peaks, String> {
    let bodies = Bodies::new(system, fineness.widen)?;
    let mut run = Run::new(system, motion, &bodies, fineness);
    run.go()?;
    Ok(run.watch.finish(system, run.steps, run.touches))
}

struct Run<'a> {
    motion: &'a GroundMotion,
    bodies: &'a Bodies,
    fineness: Fineness,
    phases: Phases,
    time: f64,
    state: Motion,
    forces: Forces,
    /// Rates and what they do at the seven stages, and the state there.
    stages: [Stage; 7],
    after: Motion,
    after_forces: Forces,
    /// Greatest speed and displacement so far of every kind of displacement, and greatest forces in series.
    greatest: Vec<[f64; 2]>,
    greatest_series: f64,
    watch: Watch,
    steps: u64,
    touches: u64,
}

#[derive(Clone, Default)]
struct Stage {
    velocity: Vec<f64>,
    acceleration: Vec<f64>,
    rates: Vec<f64>,
}

const NODES: [f64; 7] = [0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];
const WEIGHTS: [[f64; 6]; 7] = [
    [0.0; 6],
    [0.2, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [
        19372.0 / 6561.0,
        -25360.0 / 2187.0,
        64448.0 / 6561.0,
        -212.0 / 729.0,
        0.0,
        0.0,
    ],
    [
        9017.0 / 3168.0,
        -355.0 / 33.0,
        46732.0 / 5247.0,
        49.0 / 176.0,
        -5103.0 / 18656.0,
        0.0,
    ],
    [
        35.0 / 384.0,
        0.0,
        500.0 / 1113.0,
        125.0 / 192.0,
        -2187.0 / 6784.0,
        11.0 / 84.0,
    ],
];
/// The weights of fifth order less those of fourth.
const ERRORS: [f64; 7] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339_200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];

impl<'a> Run<'a> {
    fn new(
        system: &System,
        motion: &'a GroundMotion,
        bodies: &'a Bodies,
        fineness: Fineness,
    ) -> Self {
        let n = bodies.len();
        let state = Motion {
            u: bodies.rest.0.clone(),
            v: vec![0.0; n],
            z: vec![0.0; bodies.unknowns],
        };
        let groups = bodies.groups.iter().max().map_or(0, |most| most + 1);
        Self {
            motion,
            bodies,
            fineness,
            phases: Phases::at_rest(bodies),
            time: 0.0,
            after: state.clone(),
            state,
            forces: Forces::default(),
            after_forces: Forces::default(),
            stages: Default::default(),
            // 1 mm/s and 0.1 mm, or as many thousandths of a radian.
            greatest: vec![[1e-3, 1e-4]; groups],
            greatest_series: 1.0,
            watch: Watch::new(system),
            steps: 0,
            touches: 0,
        }
    }

    fn go(&mut self) -> Result<(), String> {
        let duration = self.motion.duration;
        let records = record_steps(self.motion);
        let longest = match self.motion.wave {
            jostle::Wave::Sampled { .. } => 5e-3,
            jostle::Wave::Sine { period, .. } | jostle::Wave::Ricker { period, .. } => {
                (period / 60.0).min(5e-3)
            }
        };
        let mut wanted = longest.min(1e-4);
        let mut at_once = 0;
        while self.time < duration - 1e-12 {
            self.steps += 1;
            if self.steps > MOST_STEPS {
                return Err(format!(
                    "more than {MOST_STEPS} steps by {:.3} s",
                    self.time
                ));
            }
            self.find_tangents();
            self.bodies.forces(
                self.motion,
                self.time,
                &mut self.state,
                &self.phases,
                &mut self.forces,
            );
            let mut end = duration;
            for step in &records {
                let next = step * ((self.time + 1e-10) / step).floor() + step;
                end = end.min(next);
            }
            let left = end - self.time;
            let mut h = wanted.min(longest);
            let mut to_end = false;
            if h > left * (1.0 - 1e-6) {
                h = left;
                to_end = true;
            } else if h > 0.5 * left {
                h = 0.5 * left;
            }
            let error = self.step(h);
            if !error.is_finite() || error > 1.0 && h > SHORTEST {
                let factor = 0.9 * error.powf(-1.0 / 5.0);
                wanted = h * if factor.is_finite() {
                    factor.clamp(0.1, 0.9)
                } else {
                    0.1
                };
                if wanted < SHORTEST * 1e-3 {
                    return Err(format!("steps vanish at {:.9} s", self.time));
                }
                continue;
            }
            let event = self.first_event(h);
            let mut share = 1.0;
            if let Some(event) = &event {
                share = event.share;
                if share > 0.0 {
                    self.step(share * h);
                }
            }
            let reach = share * h;
            if reach > 0.0 {
                let taken = Taken {
                    time: self.time,
                    step: reach,
                    phases: &self.phases,
                    states: [&self.state, &self.after],
                    forces: [&self.forces, &self.after_forces],
                };
                self.watch.take_step(self.bodies, self.motion, &taken);
                std::mem::swap(&mut self.state, &mut self.after);
                self.time = if event.is_none() && to_end {
                    end
                } else {
                    self.time + reach
                };
                self.commit();
            }
            at_once = if reach > 1e-13 { 0 } else { at_once + 1 };
            if at_once > MOST_AT_ONCE {
                return Err(format!("endless events at {:.9} s", self.time));
            }
            if let Some(event) = event {
                self.apply(&event.what);
            } else if !to_end || error > 0.0 {
                let factor = 0.9 * error.max(1e-12).powf(-1.0 / 6.0);
                let grown = h * factor.clamp(0.3, 4.0);
                // A step cut short by the record says little about the next.
                wanted = if to_end {
                    wanted.max(grown.min(4.0 * h))
                } else {
                    grown
                };
            }
        }
        Ok(())
    }

    /// One step, and its error over what is allowed.
    fn step(&mut self, h: f64) -> f64 {
        let n = self.bodies.len();
        for stage in 0..7 {
            if stage == 0 {
                let first = &mut self.stages[0];
                first.velocity.clone_from(&self.state.v);
                first.acceleration.clone_from(&self.forces.acceleration);
                first.rates.clone_from(&self.forces.rates);
                continue;
            }
            let (done, rest) = self.stages.split_at_mut(stage);
            self.after.u.clone_from(&self.state.u);
            self.after.v.clone_from(&self.state.v);
            self.after.z.clone_from(&self.state.z);
            for (earlier_stage, weight) in done.iter().zip(WEIGHTS[stage]) {
                if weight == 0.0 {
                    continue;
                }
                let by = h * weight;
                for k in 0..n {
                    self.after.u[k] += by * earlier_stage.velocity[k];
                    self.after.v[k] += by * earlier_stage.acceleration[k];
                }
                for (z, rate) in self.after.z.iter_mut().zip(&earlier_stage.rates) {
                    *z += by * rate;
                }
            }
            self.bodies.forces(
                self.motion,
                self.time + NODES[stage] * h,
                &mut self.after,
                &self.phases,
                &mut self.after_forces,
            );
            let current_stage = &mut rest[0];
            current_stage.velocity.clone_from(&self.after.v);
            current_stage
                .acceleration
                .clone_from(&self.after_forces.acceleration);
            current_stage.rates.clone_from(&self.after_forces.rates);
        }
        let mut worst: f64 = 0.0;
        let sum = |of: &dyn Fn(&Stage) -> f64| -> f64 {
            let all = self.stages.iter().zip(ERRORS);
            h * all.map(|(stage, weight)| weight * of(stage)).sum::<f64>()
        };
        // Those without mass follow.
        let masses = (0..n).filter(|k| self.bodies.mass[*k] > 0.0);
        for k in masses {
            let [speed, way] = self.greatest[self.bodies.groups[k]];
            worst = worst
                .max(sum(&|stage| stage.velocity[k]).abs() / way)
                .max(sum(&|stage| stage.acceleration[k]).abs() / speed);
        }
        for k in 0..self.bodies.unknowns {
            worst = worst.max(sum(&|stage| stage.rates[k]).abs() / self.greatest_series);
        }
        if self.after.u.iter().any(|u| !u.is_finite()) {
            return f64::INFINITY;
        }
        worst / self.fineness.error
    }

    /// After an accepted step.
    fn commit(&mut self) {
        for (k, group) in self.bodies.groups.iter().enumerate() {
            let most = &mut self.greatest[*group];
            most[0] = most[0].max(self.state.v[k].abs());
            most[1] = most[1].max(self.state.u[k].abs());
        }
        for z in &self.state.z {
            self.greatest_series = self.greatest_series.max(z.abs());
        }
        self.remember();
    }
}
