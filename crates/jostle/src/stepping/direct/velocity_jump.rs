//! Sudden changes of velocity under the momentum law (docs/contact.md, N1 and N2).

use super::Direct;
use super::solver::{SolverEquations, SolverFactor};
use crate::contact::momentum;
use crate::interface::Port;
use crate::linear::StepMatrix;
use crate::stepping::runner::{Jump, RunState};
use crate::system::{BuildingSystem, System};
use crate::transfer::riccati::RiccatiScratch;

/// K + K′ + s C + G M with s and G so large that damping says how massless degrees of freedom follow, where it acts on
/// them, and that massive ones do not give way.
pub(super) struct JumpFactor {
    factor: SolverFactor,
    mass_factor: f64,
}

/// Ratio of G M to the other terms.
const HEAVY: f64 = 1e13;
/// s: slower processes have no effect on a sudden change \[1/s\].
const SUDDEN: f64 = 1e9;

impl JumpFactor {
    /// `None` when every degree of freedom has mass, or nothing can be said about the others.
    fn new(
        building: &BuildingSystem,
        equations: &SolverEquations,
        tangents: &[f64],
    ) -> Option<Self> {
        let building_equations = &building.equations;
        let mut matrix = StepMatrix {
            stiffness: 1.0 + building_equations.beta * SUDDEN,
            mass: 0.0,
            dashpots: SUDDEN,
        };
        let stiffest =
            (0..building_equations.len()).filter(|&dof| building_equations.mass[dof] > 0.0);
        let stiffest = stiffest
            .map(|dof| {
                let stiffness = matrix.stiffness * building_equations.stiffness.diagonal[dof];
                let dashpots = matrix.dashpots * building_equations.dashpots.diagonal[dof];
                (stiffness + dashpots + building_equations.undamped.diagonal[dof])
                    / building_equations.mass[dof]
            })
            .fold(1.0, f64::max);
        matrix.mass = HEAVY * stiffest;
        let mut stiffness = building_equations.initial_tangents();
        for ((stiffness, spring), tangent) in stiffness
            .iter_mut()
            .zip(&building_equations.springs)
            .zip(tangents)
        {
            *stiffness += SUDDEN * building_equations.tangent_dashpot(spring, *tangent);
        }
        let mut factor = SolverFactor::default();
        equations
            .factorize(&matrix, &stiffness, &mut factor)
            .ok()
            .map(|()| Self {
                factor,
                mass_factor: matrix.mass,
            })
    }

    /// Changes massless degrees of freedom with the massive ones.
    fn follow(
        &self,
        equations: &SolverEquations,
        mass: &[f64],
        change: &mut [f64],
        load: &mut [f64],
        scratch: &mut RiccatiScratch,
    ) {
        for ((load, mass), change) in load.iter_mut().zip(mass).zip(change.iter()) {
            *load = self.mass_factor * mass * change;
        }
        equations.solve(&self.factor, load, scratch);
        for ((change, followed), mass) in change.iter_mut().zip(&*load).zip(mass) {
            if *mass == 0.0 {
                *change = *followed;
            }
        }
    }
}

/// Scratch vector for the changes of one building.
#[derive(Clone, Debug, Default)]
pub(super) struct JumpScratch {
    pub(super) velocity: Vec<f64>,
    acceleration: Vec<f64>,
    load: Vec<f64>,
}

impl JumpScratch {
    pub(super) fn for_buildings(system: &System) -> Self {
        let sizes = system.buildings.iter().map(|b| b.equations.len());
        let room = || Vec::with_capacity(sizes.clone().max().unwrap_or(0));
        Self {
            velocity: room(),
            acceleration: room(),
            load: room(),
        }
    }

    fn clear(&mut self, size: usize) {
        for part in [&mut self.velocity, &mut self.acceleration, &mut self.load] {
            part.clear();
            part.resize(size, 0.0);
        }
    }
}

/// Change of the closing rate of a contact by a unit impulse, gᵀ M⁻¹ g \[1/kg\].
fn compliance_at_once(system: &System, contact: usize) -> f64 {
    let sides = system.contacts[contact].ports.sides();
    let gives = sides.map(|(port, _)| {
        let building = &system.buildings[port.building];
        let row = port.row.moved_down(building.offset);
        1.0 / row.moving_mass(&building.equations.mass)
    });
    gives.sum()
}

impl Direct {
    /// A contact closing at `rate` opens at once with `restitution` times that.
    pub(super) fn strike(
        &mut self,
        run: &mut RunState<'_>,
        index: usize,
        restitution: f64,
        rate: f64,
    ) -> Jump {
        let contact = &run.system.contacts[index];
        let mass = contact.effective_mass();
        let impulse = momentum::impulse(restitution, mass, rate);
        for (port, sign) in contact.ports.sides() {
            self.push_at_once(run, port, sign * impulse);
        }
        let (dissipated, separation_speed) = if contact.plan.is_some() {
            // The mass of a point is its share of that of the face: it gives way more than that mass would.
            let slowed = impulse * compliance_at_once(run.system, index);
            // Other points of the face may have been pushed since.
            let rate = run.trials[index].rate;
            (impulse * (rate - 0.5 * slowed), slowed - rate)
        } else {
            let dissipated = 0.5 * mass * rate * rate * (1.0 - restitution * restitution);
            (dissipated, restitution * rate)
        };
        self.audit.contact += dissipated;
        self.audit.ground += impulse * run.grounds.closing(index, 0)[1];
        Jump {
            impulse,
            dissipated,
            separation_speed,
        }
    }

    /// Changes velocities by an impulse on a point, those of massless degrees of freedom that follow, and accelerations
    /// by what the dampers then say: M Δa = −(α M + β K + C′) Δv.
    fn push_at_once(&mut self, run: &mut RunState<'_>, port: &Port, impulse: f64) {
        let building = port.building;
        let system = &run.system.buildings[building];
        let (range, building_equations) = (system.range(), &system.equations);
        let massless = building_equations.mass.contains(&0.0);
        let springs = system.spring_range();
        // Dashpots at the tangents of springs change from jump to jump.
        let changes = building_equations
            .springs
            .iter()
            .any(|spring| spring.damped_by_tangent);
        if massless && (changes || self.jump_factors[building].is_none()) {
            let tangents = &self.yielding.tangents[springs.clone()];
            self.jump_factors[building] =
                JumpFactor::new(system, &self.equations[building], tangents);
            run.work.factorizations += 1;
        }
        self.jump.clear(building_equations.len());
        let JumpScratch {
            velocity,
            acceleration,
            load,
        } = &mut self.jump;
        for &(dof, share) in port.row.moved_down(system.offset).entries() {
            velocity[dof] = share * impulse / building_equations.mass[dof];
        }
        let mut follow = |motion: &mut [f64]| {
            if let Some(jump) = self.jump_factors[building].as_ref().filter(|_| massless) {
                let (equations, scratch) = (&self.equations[building], &mut self.scratch);
                jump.follow(equations, &building_equations.mass, motion, load, scratch);
            }
        };
        follow(velocity);
        if building_equations.beta > 0.0 {
            building_equations
                .stiffness
                .multiply_add(velocity, acceleration);
            acceleration
                .iter_mut()
                .for_each(|force| *force *= building_equations.beta);
        }
        building_equations
            .dashpots
            .multiply_add(velocity, acceleration);
        if changes {
            let tangents = &self.yielding.tangents[springs.clone()];
            let damped = self.yielding.damped[springs].iter_mut();
            for (spring, (damped, tangent)) in
                building_equations.springs.iter().zip(damped.zip(tangents))
            {
                let rate = spring.deformation(velocity);
                let change = building_equations.tangent_dashpot(spring, *tangent) * rate;
                spring.row.push(change, acceleration);
                *damped += change;
            }
        }
        for ((a, v), mass) in acceleration
            .iter_mut()
            .zip(&*velocity)
            .zip(&building_equations.mass)
        {
            *a = if *mass > 0.0 {
                -building_equations.alpha * v - *a / mass
            } else {
                0.0
            };
        }
        follow(acceleration);
        run.work.solves += if massless { 2 } else { 0 };
        let velocities = self.state.velocity[range.clone()].iter_mut();
        velocities
            .zip(&*velocity)
            .for_each(|(v, change)| *v += change);
        let accelerations = self.state.acceleration[range].iter_mut();
        accelerations
            .zip(&*acceleration)
            .for_each(|(a, change)| *a += change);
        self.jerk_links(run, building);
    }
}
