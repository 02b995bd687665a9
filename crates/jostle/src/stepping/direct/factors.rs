//! Factorised step equations of all buildings for one step size, and the compliances of contacts.

use super::integrator::{BuildingCoefficients, Coefficients};
use super::joints::Joints;
use super::links::LinkFactor;
use super::solver::{SolverEquations, SolverFactor};
use crate::history::Work;
use crate::interface::Port;
use crate::linear::NotPositive;
use crate::model::Integrator;
use crate::system::System;
use crate::transfer::riccati::RiccatiScratch;

/// Data that depend on the step size but not on the state.
pub(crate) struct StepFactors {
    pub(crate) coefficients: Coefficients,
    pub(crate) buildings: Vec<BuildingCoefficients>,
    factors: Vec<SolverFactor>,
    /// Stiffness of every spring that yields for which the factors hold.
    tangents: Vec<f64>,
    /// Springs of one building whose stiffness has changed.
    changed: Vec<usize>,
    /// Displacements of its building under a unit force to the right at every point, if computed already.
    columns: Vec<Vec<f64>>,
    ready: Vec<bool>,
    /// Equations of links while no contact is closed.
    pub(super) links: LinkFactor,
}

impl StepFactors {
    pub(super) fn blank(system: &System, joints: &Joints) -> Self {
        Self {
            coefficients: Coefficients::default(),
            buildings: vec![BuildingCoefficients::default(); system.buildings.len()],
            factors: vec![SolverFactor::default(); system.buildings.len()],
            columns: vec![Vec::new(); joints.points.len()],
            tangents: Vec::new(),
            changed: Vec::new(),
            ready: vec![false; joints.points.len()],
            links: LinkFactor::default(),
        }
    }

    /// Factorises for a step size; `Err` names the building.
    pub(crate) fn set_step(
        &mut self,
        integrator: Integrator,
        step: f64,
        system: &System,
        equations: &[SolverEquations],
        tangents: &[f64],
        work: &mut Work,
    ) -> Result<(), (usize, NotPositive)> {
        // Invalid until all buildings are done.
        self.tangents.clear();
        self.coefficients = integrator.coefficients(step);
        for (index, building) in system.buildings.iter().enumerate() {
            let coefficients = self.coefficients.of_building(&building.equations);
            equations[index]
                .factorize(
                    &coefficients.matrix(),
                    &tangents[building.spring_range()],
                    &mut self.factors[index],
                )
                .map_err(|failure| (index, failure))?;
            self.buildings[index] = coefficients;
            work.factorizations += 1;
        }
        self.tangents.extend_from_slice(tangents);
        self.ready.fill(false);
        self.links.forget();
        Ok(())
    }

    /// Updates the factors for other tangents; only changed parts are factorised again. `Err` names the building.
    pub(super) fn retune(
        &mut self,
        system: &System,
        joints: &Joints,
        equations: &[SolverEquations],
        tangents: &[f64],
        work: &mut Work,
    ) -> Result<(), (usize, NotPositive)> {
        let known = self.tangents.len() == tangents.len();
        for (index, building) in system.buildings.iter().enumerate() {
            let springs = building.spring_range();
            if springs.is_empty() {
                continue;
            }
            let (matrix, wanted) = (self.buildings[index].matrix(), &tangents[springs.clone()]);
            let factor = &mut self.factors[index];
            let done = if known {
                let held = &mut self.tangents[springs];
                self.changed.clear();
                let apart = |(spring, (held, wanted)): (usize, (&f64, &f64))| {
                    (held != wanted).then_some(spring)
                };
                let pairs = held.iter().zip(wanted).enumerate();
                self.changed.extend(pairs.filter_map(apart));
                if self.changed.is_empty() {
                    continue;
                }
                held.copy_from_slice(wanted);
                equations[index].update(&matrix, wanted, &self.changed, factor)
            } else {
                equations[index].factorize(&matrix, wanted, factor)
            };
            if let Err(failure) = done {
                self.tangents.clear();
                return Err((index, failure));
            }
            work.factorizations += 1;
            for (ready, point) in self.ready.iter_mut().zip(&joints.points) {
                *ready &= point.building != index;
            }
            self.links.forget();
        }
        if !known {
            self.tangents.clear();
            self.tangents.extend_from_slice(tangents);
        }
        Ok(())
    }

    /// Replaces the loads of all buildings by displacements.
    pub(crate) fn solve(
        &self,
        system: &System,
        equations: &[SolverEquations],
        load: &mut [f64],
        scratch: &mut RiccatiScratch,
        work: &mut Work,
    ) {
        for (index, building) in system.buildings.iter().enumerate() {
            let load = &mut load[building.range()];
            equations[index].solve(&self.factors[index], load, scratch);
        }
        work.solves += system.buildings.len() as u64;
    }

    /// Computes the displacements under a unit force of a contact or a link, if necessary.
    pub(super) fn prepare(
        &mut self,
        index: usize,
        system: &System,
        joints: &Joints,
        equations: &[SolverEquations],
        scratch: &mut RiccatiScratch,
        work: &mut Work,
    ) {
        for point in joints.sides[index].into_iter().flatten() {
            if self.ready[point] {
                continue;
            }
            let Port { building, row, .. } = &joints.points[point];
            let system_building = &system.buildings[*building];
            let column = &mut self.columns[point];
            column.clear();
            column.resize(system_building.equations.len(), 0.0);
            row.moved_down(system_building.offset).push(1.0, column);
            equations[*building].solve(&self.factors[*building], column, scratch);
            work.solves += 1;
            self.ready[point] = true;
        }
    }

    /// g_cᵀ K̂⁻¹ g_d: opening of c due to a unit force of contact or link d, both prepared (theory, Eq. P1)
    /// \[m/N\].
    pub(super) fn compliance(&self, c: usize, d: usize, system: &System, joints: &Joints) -> f64 {
        let mut sum = 0.0;
        for (side, own_sign) in joints.sides[c].into_iter().zip([1.0, -1.0]) {
            for (other, sign) in joints.sides[d].into_iter().zip([1.0, -1.0]) {
                let (Some(one), Some(other)) = (side, other) else {
                    continue;
                };
                let (shown, pushed) = (&joints.points[one], &joints.points[other]);
                if shown.building == pushed.building {
                    let offset = system.buildings[shown.building].offset;
                    let row = shown.row.moved_down(offset);
                    sum += own_sign * sign * row.value(&self.columns[other]);
                }
            }
        }
        sum
    }

    /// Adds the displacements under the force of a contact or a link that is prepared.
    pub(super) fn push_apart(
        &self,
        index: usize,
        force: f64,
        system: &System,
        joints: &Joints,
        displacement: &mut [f64],
    ) {
        for (point, force) in joints.sides[index].into_iter().zip([-force, force]) {
            let Some(point) = point else { continue };
            let range = system.buildings[joints.points[point].building].range();
            let column = &self.columns[point];
            for (value, unit) in displacement[range].iter_mut().zip(column) {
                *value += force * unit;
            }
        }
    }
}
