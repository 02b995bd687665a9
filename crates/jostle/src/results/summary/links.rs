//! Links.

use serde::Serialize;

use crate::quantity::{Quantity, Unit};

/// Springs and dashpots between two neighbours.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct LinkSummary {
    /// Names of the left and the right building; `wall` is a rigid wall.
    pub between: [String; 2],
    /// Stiffness of each \[N/m\].
    pub stiffness_n_m: f64,
    /// Damping of each \[N·s/m\].
    pub damping_n_s_m: f64,
    /// Greatest force of any of them, either sign \[N\].
    pub peak_force_n: f64,
    /// Energy dissipated in their dashpots \[J\].
    pub dissipated_j: f64,
    /// One by one, from the lowest up.
    pub floors: Vec<LinkFloorSummary>,
}

#[rustfmt::skip]
impl LinkSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("stiffness_n_m", Unit::N_PER_M, "stiffness of each spring", |l| l.stiffness_n_m),
        Quantity::<Self>::real("damping_n_s_m", Unit::NS_PER_M, "damping of each dashpot", |l| l.damping_n_s_m),
        Quantity::<Self>::real("peak_force_n", Unit::N, "greatest force of any of them", |l| l.peak_force_n),
        Quantity::<Self>::real("dissipated_j", Unit::J, "energy dissipated in the dashpots", |l| l.dissipated_j),
    ];
}

/// One spring and dashpot between two points.
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
pub struct LinkFloorSummary {
    /// Left and right floor, from 1; `null` for a point between floors, and for a wall.
    pub floors: [Option<usize>; 2],
    /// Height above the base \[m\].
    pub height_m: f64,
    /// Force of greatest magnitude, positive in compression \[N\].
    pub peak_force_n: f64,
    /// Its instant \[s\].
    pub peak_force_at_s: f64,
    /// Greatest change of length, either sign \[m\].
    pub peak_stroke_m: f64,
    /// Energy dissipated in its dashpot \[J\].
    pub dissipated_j: f64,
}

#[rustfmt::skip]
impl LinkFloorSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("height_m", Unit::M, "height above the base", |l| l.height_m),
        Quantity::<Self>::real("peak_force_n", Unit::N, "force of greatest magnitude, positive in compression", |l| l.peak_force_n),
        Quantity::<Self>::real("peak_force_at_s", Unit::S, "its instant", |l| l.peak_force_at_s),
        Quantity::<Self>::real("peak_stroke_m", Unit::M, "greatest change of length", |l| l.peak_stroke_m),
        Quantity::<Self>::real("dissipated_j", Unit::J, "energy dissipated in the dashpot", |l| l.dissipated_j),
    ];
}
