//! Factorised step equations of all buildings for one step size, and what they say about contacts.

use super::newmark::{BuildingCoefficients, Coefficients, Newmark};
use super::{NotPositive, StepEquations};
use crate::history::Work;
use crate::system::{Contact, System};

/// Everything that depends on the step size but not on the state.
pub(crate) struct StepFactors<E: StepEquations> {
    pub(crate) coefficients: Coefficients,
    pub(crate) buildings: Vec<BuildingCoefficients>,
    factors: Vec<E::Factor>,
    /// K̂⁻¹ g of every contact, where already asked for.
    columns: Vec<Option<Columns>>,
    ready: Vec<bool>,
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
            ready: vec![false; system.contacts.len()],
        }
    }

    /// Factorises for a step size; `Err` names the building.
    pub(crate) fn set_step(
        &mut self,
        newmark: Newmark,
        step: f64,
        system: &System,
        equations: &[E],
        work: &mut Work,
    ) -> Result<(), (usize, NotPositive)> {
        self.coefficients = newmark.coefficients(step);
        for (index, building) in system.buildings.iter().enumerate() {
            let own = self.coefficients.of_building(&building.equations);
            equations[index]
                .factorize(
                    own.stiffness_factor,
                    own.mass_factor,
                    &mut self.factors[index],
                )
                .map_err(|failure| (index, failure))?;
            self.buildings[index] = own;
            work.factorizations += 1;
        }
        self.ready.fill(false);
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
        if self.ready[index] {
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
            let building = contact.buildings[side];
            column.fill(0.0);
            column[contact.dofs[side] - system.buildings[building].offset] = 1.0;
            equations[building].solve(&self.factors[building], column);
            work.solves += 1;
        }
        self.ready[index] = true;
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
