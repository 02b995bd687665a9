//! Factorised step equations of all buildings for one step size, and what they say about contacts.

use super::integrator::{BuildingCoefficients, Coefficients, Integrator};
use super::{NotPositive, StepEquations};
use crate::history::Work;
use crate::system::{Contact, System};

/// Everything that depends on the step size but not on the state.
pub(crate) struct StepFactors<E: StepEquations> {
    pub(crate) coefficients: Coefficients,
    pub(crate) buildings: Vec<BuildingCoefficients>,
    factors: Vec<E::Factor>,
    /// Stiffness of every spring that yields for which the factors hold.
    tangents: Vec<f64>,
    /// Springs of one building whose stiffness has changed.
    changed: Vec<usize>,
    /// K̂⁻¹ g of every contact, where already asked for.
    columns: Vec<Option<Columns>>,
    ready: Vec<[bool; 2]>,
}

/// Displacements of the left and the right building under a unit push to the right.
struct Columns {
    left: Vec<f64>,
    right: Vec<f64>,
}

impl<E: StepEquations> StepFactors<E> {
    pub(crate) fn blank(system: &System) -> Self {
        Self {
            coefficients: Coefficients::default(),
            buildings: vec![BuildingCoefficients::default(); system.buildings.len()],
            factors: vec![E::Factor::default(); system.buildings.len()],
            columns: system.contacts.iter().map(|_| None).collect(),
            tangents: Vec::new(),
            changed: Vec::new(),
            ready: vec![[false; 2]; system.contacts.len()],
        }
    }

    /// Factorises for a step size; `Err` names the building.
    pub(crate) fn set_step(
        &mut self,
        integrator: Integrator,
        step: f64,
        system: &System,
        equations: &[E],
        tangents: &[f64],
        work: &mut Work,
    ) -> Result<(), (usize, NotPositive)> {
        // Of no use until all buildings are done.
        self.tangents.clear();
        self.coefficients = integrator.coefficients(step);
        for (index, building) in system.buildings.iter().enumerate() {
            let own = self.coefficients.of_building(&building.equations);
            equations[index]
                .factorize(
                    &own.matrix(),
                    &tangents[building.spring_range()],
                    &mut self.factors[index],
                )
                .map_err(|failure| (index, failure))?;
            self.buildings[index] = own;
            work.factorizations += 1;
        }
        self.tangents.extend_from_slice(tangents);
        self.ready.fill([false; 2]);
        Ok(())
    }

    /// Takes over other tangents; only what they change is factorised anew. `Err` names the building.
    pub(crate) fn retune(
        &mut self,
        system: &System,
        equations: &[E],
        tangents: &[f64],
        work: &mut Work,
    ) -> Result<(), (usize, NotPositive)> {
        let known = self.tangents.len() == tangents.len();
        for (index, building) in system.buildings.iter().enumerate() {
            let springs = building.spring_range();
            if springs.is_empty() {
                continue;
            }
            let (own, wanted) = (self.buildings[index].matrix(), &tangents[springs.clone()]);
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
                equations[index].update(&own, wanted, &self.changed, factor)
            } else {
                equations[index].factorize(&own, wanted, factor)
            };
            if let Err(failure) = done {
                self.tangents.clear();
                return Err((index, failure));
            }
            work.factorizations += 1;
            for (ready, contact) in self.ready.iter_mut().zip(&system.contacts) {
                for side in 0..2 {
                    ready[side] &= contact.buildings[side] != index;
                }
            }
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
        equations: &[E],
        load: &mut [f64],
        work: &mut Work,
    ) {
        for (index, building) in system.buildings.iter().enumerate() {
            equations[index].solve(&self.factors[index], &mut load[building.range()]);
        }
        work.solves += system.buildings.len() as u64;
    }

    /// Makes sure that the displacements under a unit force of a contact are known.
    pub(crate) fn prepare_contact(
        &mut self,
        index: usize,
        system: &System,
        equations: &[E],
        work: &mut Work,
    ) {
        if self.ready[index] == [true; 2] {
            return;
        }
        let contact = &system.contacts[index];
        let columns = self.columns[index].get_or_insert_with(|| {
            let size = |side: usize| system.buildings[contact.buildings[side]].equations.len();
            Columns {
                left: vec![0.0; size(0)],
                right: vec![0.0; size(1)],
            }
        });
        for (side, column) in [&mut columns.left, &mut columns.right]
            .into_iter()
            .enumerate()
        {
            if self.ready[index][side] {
                continue;
            }
            let building = contact.buildings[side];
            column.fill(0.0);
            column[contact.dofs[side] - system.buildings[building].offset] = 1.0;
            equations[building].solve(&self.factors[building], column);
            work.solves += 1;
        }
        self.ready[index] = [true; 2];
    }

    /// g_cᵀ K̂⁻¹ g_d: how far a unit force of contact d opens contact c (theory, Eq. P1) \[m/N\].
    pub(crate) fn compliance(&self, c: &Contact, d: usize, system: &System) -> f64 {
        let Some(columns) = &self.columns[d] else {
            return 0.0;
        };
        let of_d = [(&columns.left, 1.0), (&columns.right, -1.0)];
        let mut sum = 0.0;
        for (own_side, own_sign) in [(0, 1.0), (1, -1.0)] {
            for (side, (column, sign)) in of_d.iter().enumerate() {
                let building = system.contacts[d].buildings[side];
                if building == c.buildings[own_side] {
                    sum += own_sign
                        * sign
                        * column[c.dofs[own_side] - system.buildings[building].offset];
                }
            }
        }
        sum
    }

    /// Adds the displacements under the force of a contact.
    pub(crate) fn push_apart(
        &self,
        index: usize,
        force: f64,
        system: &System,
        displacement: &mut [f64],
    ) {
        let Some(columns) = &self.columns[index] else {
            return;
        };
        for (side, (column, force)) in [(&columns.left, -force), (&columns.right, force)]
            .into_iter()
            .enumerate()
        {
            let range = system.buildings[system.contacts[index].buildings[side]].range();
            for (value, unit) in displacement[range].iter_mut().zip(column) {
                *value += force * unit;
            }
        }
    }
}
