//! The energy audit (theory, Eq. E1): sums over steps that must balance if every step is in equilibrium.

use crate::history::Energy;
use crate::system::System;

/// Work done on and lost by the buildings so far, and the largest error of the balance.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct EnergyAudit {
    pub(crate) input: f64,
    pub(crate) damped: f64,
    pub(crate) contact: f64,
    initial: f64,
    largest: f64,
    worst: f64,
}

/// Kinetic and strain energy of all buildings \[J\].
fn stored(system: &System, displacement: &[f64], velocity: &[f64]) -> (f64, f64) {
    let (mut kinetic, mut strain) = (0.0, 0.0);
    for building in &system.buildings {
        let moving = building
            .equations
            .mass
            .iter()
            .zip(&velocity[building.range()]);
        kinetic += 0.5 * moving.map(|(m, v)| m * v * v).sum::<f64>();
        strain += 0.5
            * building
                .equations
                .stiffness
                .quadratic_form(&displacement[building.range()]);
    }
    (kinetic, strain)
}

impl EnergyAudit {
    /// Starts from a state that may already hold energy.
    pub(crate) fn starting_from(system: &System, displacement: &[f64], velocity: &[f64]) -> Self {
        let (kinetic, strain) = stored(system, displacement, velocity);
        Self {
            initial: kinetic + strain,
            ..Self::default()
        }
    }

    /// The balance now. Energy present at the start counts as input.
    pub(crate) fn balance(
        &mut self,
        system: &System,
        displacement: &[f64],
        velocity: &[f64],
    ) -> Energy {
        let (kinetic, strain) = stored(system, displacement, velocity);
        let mut energy = Energy {
            input: self.input + self.initial,
            kinetic,
            strain,
            damped: self.damped,
            hysteretic: 0.0,
            contact: self.contact,
            worst_imbalance: 0.0,
        };
        self.largest = self.largest.max(energy.input.abs()).max(kinetic + strain);
        if self.largest > 0.0 {
            self.worst = self.worst.max((energy.residual() / self.largest).abs());
        }
        energy.worst_imbalance = self.worst;
        energy
    }
}
