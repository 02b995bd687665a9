//! The energy balance (theory, Eq. E1): sums over steps that balance if every step is in equilibrium.

use crate::history::Energy;
use crate::simd;
use crate::state::State;
use crate::system::{RunGrounds, System};

/// Energies so far, and the largest error of the balance.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct EnergyAudit {
    pub(crate) input: f64,
    pub(crate) damped: f64,
    pub(crate) contact: f64,
    /// Work of friction along contacts.
    pub(crate) friction: f64,
    /// Work of the grounds on contacts and links.
    pub(crate) ground: f64,
    /// Work done on yielding springs, recoverable energy included.
    pub(crate) springs: f64,
    /// Work done on links with springs and dashpots, recoverable energy of their springs included.
    pub(crate) links: f64,
    /// The same of links that slip or yield.
    pub(crate) yielding_links: f64,
    /// Work of the weight of buildings that start under it.
    pub(crate) weight: f64,
    /// Recoverable energy of buildings at rest under their weight.
    at_rest: f64,
    /// Other energy at the start.
    initial: f64,
    imbalance: Imbalance,
}

/// The largest error of a balance so far, relative to the largest energy.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Imbalance {
    largest: f64,
    worst: f64,
}

impl Imbalance {
    /// Adds a balance, and writes the worst so far into it.
    pub(crate) fn watch(&mut self, mut energy: Energy) -> Energy {
        let held = energy.kinetic + energy.strain;
        self.largest = self.largest.max(energy.input.abs()).max(held);
        if self.largest > 0.0 {
            self.worst = self.worst.max((energy.residual() / self.largest).abs());
        }
        energy.worst_imbalance = self.worst;
        energy
    }
}

/// Recoverable energy \[J\].
struct Stored {
    kinetic: f64,
    strain: f64,
    /// Of springs that yield.
    springs: f64,
    links: f64,
    /// Of links that slip or yield.
    yielding_links: f64,
}

fn stored(system: &System, state: &State, grounds: &RunGrounds<'_>) -> Stored {
    let (displacement, velocity) = (&state.displacement, &state.velocity);
    let (mut kinetic, mut strain) = (0.0, 0.0);
    for building in &system.buildings {
        let (equations, range) = (&building.equations, building.range());
        kinetic += 0.5 * simd::wide_weighted_square(&equations.mass, &velocity[range.clone()]);
        strain += 0.5 * equations.strain(&displacement[range]);
    }
    let springs = system
        .buildings
        .iter()
        .flat_map(|building| &building.equations.springs);
    let recoverable = springs
        .zip(&state.springs)
        .map(|(spring, memory)| spring.hysteresis.recoverable_energy(memory));
    let (mut links, mut yielding_links) = (0.0, 0.0);
    let links_of_state = system.links.iter().zip(state.link_memories());
    for (index, (link, memory)) in links_of_state.enumerate() {
        let [moved, ..] = grounds.closing(system.contacts.len() + index, 0);
        let energy = link.recoverable(link.shortening(displacement) + moved, &memory);
        *(if link.law.is_hysteretic() {
            &mut yielding_links
        } else {
            &mut links
        }) += energy;
    }
    Stored {
        kinetic,
        strain,
        springs: recoverable.sum(),
        links,
        yielding_links,
    }
}

impl EnergyAudit {
    /// Starts from a state that may already have energy.
    pub(crate) fn starting_from(system: &System, state: &State, grounds: &RunGrounds<'_>) -> Self {
        let stored = stored(system, state, grounds);
        let recoverable = stored.strain + stored.springs + stored.links + stored.yielding_links;
        let mut buildings = system.buildings.iter();
        let bears_weight = buildings.any(|building| !building.rest.displacement.is_empty());
        let at_rest = if bears_weight { recoverable } else { 0.0 };
        Self {
            at_rest,
            initial: stored.kinetic + recoverable - at_rest,
            // Energies at rest round too.
            imbalance: Imbalance {
                largest: at_rest,
                ..Imbalance::default()
            },
            springs: stored.springs,
            links: stored.links,
            yielding_links: stored.yielding_links,
            ..Self::default()
        }
    }

    /// Looks at the balance without asking how much of the work on springs and links is recoverable.
    pub(crate) fn look(&mut self, kinetic: f64, strain: f64) {
        self.imbalance.watch(Energy {
            input: self.input + self.initial,
            kinetic,
            strain: strain - self.at_rest - self.weight,
            damped: self.damped + self.links,
            hysteretic: self.springs + self.yielding_links,
            contact: self.contact,
            ..Energy::default()
        });
    }

    /// The balance now. Energy present at the start counts as input. Strain energy is that beyond rest under weight, less what
    /// the weight gave.
    pub(crate) fn balance(
        &mut self,
        system: &System,
        state: &State,
        grounds: &RunGrounds<'_>,
    ) -> Energy {
        let stored = stored(system, state, grounds);
        let kinetic = stored.kinetic;
        let recoverable = stored.strain + stored.springs + stored.links + stored.yielding_links;
        let strain = recoverable - self.at_rest - self.weight;
        let links = self.links - stored.links;
        self.imbalance.watch(Energy {
            input: self.input + self.initial,
            ground: self.ground,
            kinetic,
            strain,
            damped: self.damped + links,
            links,
            hysteretic: self.springs - stored.springs + self.yielding_links - stored.yielding_links,
            contact: self.contact,
            friction: self.friction,
            worst_imbalance: 0.0,
        })
    }
}
