//! State of a run.

use crate::contact::Memory;
use crate::hysteresis::HysteresisMemory;
use crate::system::System;

/// The state of a row of buildings at one instant; a clone is a checkpoint.
///
/// Vectors hold the degrees of freedom of all buildings, from left to right.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Time \[s\].
    pub time: f64,
    /// Displacement relative to the ground \[m, rad\].
    pub displacement: Vec<f64>,
    /// Velocity relative to the ground \[m/s, rad/s\].
    pub velocity: Vec<f64>,
    /// Acceleration relative to the ground \[m/s², rad/s²\].
    pub acceleration: Vec<f64>,
    /// Springs that yield, of all buildings from left to right.
    pub springs: Vec<HysteresisMemory>,
    /// Contacts, in the order of the system.
    pub contacts: Vec<ContactPhase>,
}

/// Whether a contact is open or closed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactPhase {
    /// The gap is open.
    Open,
    /// The contact is closed.
    Closed(Episode),
}

/// Record since a contact closed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Episode {
    /// Instant of first contact \[s\].
    pub since: f64,
    /// Closing rate at first contact, > 0 \[m/s\].
    pub impact_speed: f64,
    /// Memory of the law.
    pub memory: Memory,
    /// Force now \[N\].
    pub force: f64,
    /// Last instant of force and the opening rate then; meaningful once the force has vanished \[s, m/s\].
    pub end: f64,
    /// Opening rate at `end` \[m/s\].
    pub separation_speed: f64,
    /// Greatest force so far \[N\].
    pub peak_force: f64,
    /// Its instant \[s\].
    pub peak_force_at: f64,
    /// Greatest indentation so far \[m\].
    pub peak_indentation: f64,
    /// Time integral of the force so far \[N·s\].
    pub impulse: f64,
    /// Work done so far \[J\].
    pub work: f64,
}

impl Episode {
    /// The contact closes now.
    #[must_use]
    pub(crate) fn new(since: f64, impact_speed: f64, memory: Memory) -> Self {
        Self {
            since,
            impact_speed,
            memory,
            force: 0.0,
            end: since,
            separation_speed: 0.0,
            peak_force: 0.0,
            peak_force_at: since,
            peak_indentation: 0.0,
            impulse: 0.0,
            work: 0.0,
        }
    }
}

impl ContactPhase {
    /// Contact force now \[N\].
    #[must_use]
    pub fn force(&self) -> f64 {
        match self {
            Self::Open => 0.0,
            Self::Closed(episode) => episode.force,
        }
    }
}

impl State {
    /// All buildings at rest, under self weight if included, and all contacts open, with the ground acceleration at
    /// that instant.
    #[must_use]
    pub fn at_rest(system: &System, ground_acceleration: f64) -> Self {
        let n = system.len();
        let (mut displacement, mut acceleration) = (vec![0.0; n], vec![0.0; n]);
        let mut springs = Vec::new();
        for building in &system.buildings {
            let equations = &building.equations;
            for (value, rest) in displacement[building.range()]
                .iter_mut()
                .zip(&building.rest)
            {
                *value = *rest;
            }
            springs.extend(&building.rest_springs);
            springs.resize(building.spring_range().end, HysteresisMemory::default());
            let masses = equations.driven_mass.iter().zip(&equations.mass);
            for (value, (driven, mass)) in acceleration[building.range()].iter_mut().zip(masses) {
                if *mass > 0.0 {
                    *value = -driven / mass * ground_acceleration;
                }
            }
        }
        Self {
            time: 0.0,
            displacement,
            velocity: vec![0.0; n],
            acceleration,
            springs,
            contacts: vec![ContactPhase::Open; system.contacts.len()],
        }
    }
}
