//! Links between floors of one building, as far as its storey forces, modes and capacity curve follow from them.

use crate::hysteresis::Hysteresis;
use crate::linear::Row;

/// A link between two floors of a building, or a floor and its base: a brace, an infill, a device.
#[derive(Clone, Debug, PartialEq)]
pub struct InnerLink {
    /// Index among the links of the system.
    pub link: usize,
    /// How much shorter displacements of the building make it, or velocities its rate \[m, m/s\].
    pub shortening: Row,
    /// Initial stiffness, ≥ 0; zero of one that takes no static load \[N/m\].
    pub stiffness: f64,
    /// What resists a slow change of length, compression being positive.
    pub spring: Option<Hysteresis>,
    /// Floors that it joins, from 1; 0 is the base.
    pub floors: [usize; 2],
    /// Force per rate of shortening of one with a linear dashpot beside its spring, otherwise 0 \[N·s/m\].
    pub damping: f64,
    /// Its ends, without one at the base.
    pub ends: Vec<LinkEnd>,
}

/// An end of a link at a floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkEnd {
    /// Height above the base \[m\].
    pub height: f64,
    /// How a compression of 1 N counts among the restoring forces there: along x, across \[–\], and as a torque about the origin of the
    /// site \[m\]; 1 or −1 along x in one plane.
    pub shares: [f64; 3],
}

impl InnerLink {
    /// How its compression counts in the base shear: 0 between two floors, 1 or −1 between a floor and the base, less at an angle in
    /// plan.
    #[must_use]
    pub fn of_base(&self) -> f64 {
        self.ends.iter().map(|end| end.shares[0]).sum()
    }

    /// In words, for the corners of its spring.
    #[must_use]
    pub fn place(&self) -> String {
        match self.floors {
            [0, floor] | [floor, 0] => format!("link between the base and floor {floor}"),
            [one, other] => format!("link between floors {one} and {other}"),
        }
    }
}
