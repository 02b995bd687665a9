//! The begin of a run from displacements and velocities other than those of rest.

use super::stepper::ModalStepper;
use crate::simd;
use crate::state::{ContactPhase, State};
use crate::stepping::runner::RunState;
use crate::system::System;

/// Why modal stepping cannot begin from a state.
pub(super) fn refusal(system: &System, state: &State) -> Option<String> {
    if state
        .contacts
        .iter()
        .any(|phase| matches!(phase, ContactPhase::Closed(_)))
    {
        return Some("modal stepping begins with open contacts".to_owned());
    }
    (!system.links.is_empty()).then(|| "modal stepping begins from rest where links act".to_owned())
}

impl ModalStepper<'_> {
    /// Takes displacements and velocities of masses: q = φᵀ M u, q̇ = φᵀ M u̇. Massless degrees of freedom follow statically. The
    /// energy of the state counts as input.
    pub(super) fn begin_from(&mut self, run: &RunState<'_>, state: &State) {
        for (building, reduced_building) in run.system.buildings.iter().zip(&self.reduced.buildings)
        {
            let lists = [&state.displacement, &state.velocity];
            for (list, modal) in lists.into_iter().zip([&mut self.q[0], &mut self.v[0]]) {
                let motion = &list[building.range()];
                let momenta = building.equations.mass.iter().zip(motion);
                let momenta: Vec<f64> = momenta.map(|(mass, value)| mass * value).collect();
                let parts = reduced_building
                    .basis
                    .of_shapes(|shape| simd::dot(&momenta, shape));
                modal[reduced_building.modes.clone()].copy_from_slice(&parts);
            }
        }
        self.reduced.show_all(
            [&self.q[0], &self.v[0]],
            [&mut self.u[0], &mut self.rate[0]],
        );
        self.accelerations();
        self.jerks();
        self.show_accelerations(&run.grounds);
        self.energy.input += self.stored();
        let moving = [&self.v[0][..], &self.scratch, &self.jerk];
        self.peaks
            .begin(run.system, self.reduced, &self.u[0], &self.q[0], moving);
    }

    /// Kinetic and strain energy now \[J\].
    fn stored(&self) -> f64 {
        let kinetic = 0.5 * simd::dot(&self.v[0], &self.v[0]);
        kinetic + 0.5 * simd::weighted_square(&self.reduced.stiffness, &self.q[0])
    }
}
