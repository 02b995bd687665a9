//! Links.

use serde::Serialize;

use crate::quantity::{Quantity, Unit};

/// Links between two neighbours, or inside one building.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct LinkSummary {
    /// Names of the left and the right building; `wall` is a rigid wall.
    pub between: [String; 2],
    /// Name of the law.
    pub law: String,
    /// Stiffness of each; of links that slip or yield, that before \[N/m\].
    pub stiffness_n_m: f64,
    /// Damping of each; with an exponent α in N·(s/m)^α \[N·s/m\].
    pub damping_n_s_m: f64,
    /// α of viscous links, otherwise 1 \[–\].
    pub exponent: f64,
    /// Greatest force of any of them, either sign \[N\].
    pub peak_force_n: f64,
    /// The same, under the name of the other peaks \[N\].
    pub force_peak_n: f64,
    /// Greatest change of length of any of them, either sign \[m\].
    pub stroke_peak_m: f64,
    /// Greatest rate of change of length of any of them, either sign \[m/s\].
    pub speed_peak_m_s: f64,
    /// Energy dissipated in their dashpots and sliders \[J\].
    pub dissipated_j: f64,
    /// One by one, from the lowest up.
    pub floors: Vec<LinkFloorSummary>,
}

#[rustfmt::skip]
impl LinkSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("stiffness_n_m", Unit::N_PER_M, "stiffness of each spring; for links that slip or yield, the initial stiffness", |l| l.stiffness_n_m),
        Quantity::<Self>::real("damping_n_s_m", Unit::NS_PER_M, "damping coefficient of each dashpot; with an exponent α in N·(s/m)^α", |l| l.damping_n_s_m),
        Quantity::<Self>::real("exponent", Unit::NONE, "exponent α of viscous links, otherwise 1", |l| l.exponent),
        Quantity::<Self>::real("peak_force_n", Unit::N, "greatest force of any of them", |l| l.peak_force_n),
        Quantity::<Self>::real("force_peak_n", Unit::N, "the same as peak_force_n, named like the other peaks", |l| l.force_peak_n).in_study(),
        Quantity::<Self>::real("stroke_peak_m", Unit::M, "greatest change of length of any of them", |l| l.stroke_peak_m).in_study(),
        Quantity::<Self>::real("speed_peak_m_s", Unit::M_S, "greatest rate of change of length of any of them", |l| l.speed_peak_m_s),
        Quantity::<Self>::real("dissipated_j", Unit::J, "energy dissipated in dashpots and sliders", |l| l.dissipated_j).in_study(),
    ];
}

/// One link between two points.
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
pub struct LinkFloorSummary {
    /// Left and right floor, from 1; `null` for a point between floors, and for a wall. Inside a building 0 is its base.
    pub floors: [Option<usize>; 2],
    /// Height above the base \[m\].
    pub height_m: f64,
    /// Force of greatest magnitude, positive in compression \[N\].
    pub peak_force_n: f64,
    /// Its instant \[s\].
    pub peak_force_at_s: f64,
    /// Greatest change of length, either sign \[m\].
    pub peak_stroke_m: f64,
    /// Greatest rate of change of length, either sign \[m/s\].
    pub peak_speed_m_s: f64,
    /// Energy dissipated in its dashpot or slider \[J\].
    pub dissipated_j: f64,
}

#[rustfmt::skip]
impl LinkFloorSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("height_m", Unit::M, "height above the base, or above the datum of elevations", |l| l.height_m),
        Quantity::<Self>::real("peak_force_n", Unit::N, "force of greatest magnitude, positive in compression", |l| l.peak_force_n),
        Quantity::<Self>::real("peak_force_at_s", Unit::S, "time of this peak", |l| l.peak_force_at_s),
        Quantity::<Self>::real("peak_stroke_m", Unit::M, "greatest change of length", |l| l.peak_stroke_m),
        Quantity::<Self>::real("peak_speed_m_s", Unit::M_S, "greatest rate of change of length", |l| l.peak_speed_m_s),
        Quantity::<Self>::real("dissipated_j", Unit::J, "energy dissipated in the dashpot or the slider", |l| l.dissipated_j),
    ];
}
