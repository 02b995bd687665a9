//! Foundations on soil.

use serde::Serialize;

use crate::quantity::{Quantity, Unit};

/// Rigid foundation of a building, and the springs and dashpots of the soil under it.
#[derive(Clone, Copy, Debug, Default, Serialize, PartialEq)]
pub struct FoundationSummary {
    /// Greatest displacement, either sign \[m\].
    pub sway_peak_m: f64,
    /// Greatest rotation, either sign \[rad\].
    pub rocking_peak_rad: f64,
    /// First lateral period on the soil, without neighbours \[s\].
    pub period_s: f64,
    /// The same over that on rigid ground \[–\].
    pub period_ratio: f64,
    /// Damping ratio of the first lateral mode on the soil, to first order in the dashpots \[–\].
    pub damping_ratio: f64,
    /// Damping ratio of the first lateral mode on rigid ground \[–\].
    pub damping_ratio_fixed: f64,
    /// Stiffness against displacement, without neighbours \[N/m\].
    pub sway_stiffness_n_m: f64,
    /// Dashpot of displacement \[N·s/m\].
    pub sway_damping_n_s_m: f64,
    /// Stiffness against rotation, without neighbours \[N·m/rad\].
    pub rocking_stiffness_n_m_rad: f64,
    /// Dashpot of rotation \[N·m·s/rad\].
    pub rocking_damping_n_m_s_rad: f64,
    /// a₀ = ωB/V_s at which springs and dashpots hold; 0 for given matrices \[–\].
    pub dimensionless_frequency: f64,
    /// Energy dissipated in its own dashpots \[J\].
    pub damped_j: f64,
    /// What it has across and in torsion; `None` in one plane.
    #[serde(flatten)]
    pub in_plan: Option<FoundationAcross>,
}

#[rustfmt::skip]
impl FoundationSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("sway_peak_m", Unit::M, "peak displacement", |f| f.sway_peak_m),
        Quantity::<Self>::real("rocking_peak_rad", Unit::RAD, "peak rotation", |f| f.rocking_peak_rad),
        Quantity::<Self>::real("period_s", Unit::S, "first lateral period on the soil, without neighbours", |f| f.period_s),
        Quantity::<Self>::real("period_ratio", Unit::NONE, "ratio of this period to that on rigid ground", |f| f.period_ratio),
        Quantity::<Self>::real("damping_ratio", Unit::NONE, "damping ratio of the first lateral mode on the soil, to first order in the dashpots", |f| f.damping_ratio),
        Quantity::<Self>::real("damping_ratio_fixed", Unit::NONE, "damping ratio of the first lateral mode on rigid ground", |f| f.damping_ratio_fixed),
        Quantity::<Self>::real("sway_stiffness_n_m", Unit::N_PER_M, "horizontal stiffness, without neighbours", |f| f.sway_stiffness_n_m),
        Quantity::<Self>::real("sway_damping_n_s_m", Unit::NS_PER_M, "horizontal dashpot", |f| f.sway_damping_n_s_m),
        Quantity::<Self>::real("rocking_stiffness_n_m_rad", Unit::NM_PER_RAD, "rocking stiffness, without neighbours", |f| f.rocking_stiffness_n_m_rad),
        Quantity::<Self>::real("rocking_damping_n_m_s_rad", Unit::NMS_PER_RAD, "rocking dashpot", |f| f.rocking_damping_n_m_s_rad),
        Quantity::<Self>::real("dimensionless_frequency", Unit::NONE, "a0 = ωB/Vs at which springs and dashpots are evaluated, where B is half the shorter side; 0 for given matrices", |f| f.dimensionless_frequency),
        Quantity::<Self>::real("damped_j", Unit::J, "energy dissipated in its dashpots", |f| f.damped_j),
    ];
}

/// What the foundation of a building with a plan has across and in torsion.
#[derive(Clone, Copy, Debug, Default, Serialize, PartialEq)]
pub struct FoundationAcross {
    /// Greatest displacement across, either sign \[m\].
    pub sway_across_peak_m: f64,
    /// Greatest rotation that moves floors across, either sign \[rad\].
    pub rocking_across_peak_rad: f64,
    /// Greatest rotation about the vertical axis, either sign \[rad\].
    pub torsion_peak_rad: f64,
    /// Fundamental period across on the soil \[s\].
    pub period_across_s: f64,
    /// The same over that on rigid ground \[–\].
    pub period_ratio_across: f64,
    /// Damping ratio of that mode on the soil, to first order in the dashpots \[–\].
    pub damping_ratio_across: f64,
    /// Damping ratio of the fundamental mode across on rigid ground \[–\].
    pub damping_ratio_across_fixed: f64,
    /// Stiffness against displacement across \[N/m\].
    pub sway_across_stiffness_n_m: f64,
    /// Dashpot of displacement across \[N·s/m\].
    pub sway_across_damping_n_s_m: f64,
    /// Stiffness against rotation that moves floors across \[N·m/rad\].
    pub rocking_across_stiffness_n_m_rad: f64,
    /// Dashpot of that rotation \[N·m·s/rad\].
    pub rocking_across_damping_n_m_s_rad: f64,
    /// Stiffness against rotation about the vertical axis \[N·m/rad\].
    pub torsional_stiffness_n_m_rad: f64,
    /// Dashpot of that rotation \[N·m·s/rad\].
    pub torsional_damping_n_m_s_rad: f64,
}

#[rustfmt::skip]
impl FoundationAcross {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("sway_across_peak_m", Unit::M, "peak displacement across", |f| f.sway_across_peak_m),
        Quantity::<Self>::real("rocking_across_peak_rad", Unit::RAD, "peak rocking rotation that moves floors across", |f| f.rocking_across_peak_rad),
        Quantity::<Self>::real("torsion_peak_rad", Unit::RAD, "peak rotation about the vertical axis", |f| f.torsion_peak_rad),
        Quantity::<Self>::real("period_across_s", Unit::S, "fundamental period across on the soil", |f| f.period_across_s),
        Quantity::<Self>::real("period_ratio_across", Unit::NONE, "ratio of this period to that on rigid ground", |f| f.period_ratio_across),
        Quantity::<Self>::real("damping_ratio_across", Unit::NONE, "damping ratio of that mode on the soil, to first order in the dashpots", |f| f.damping_ratio_across),
        Quantity::<Self>::real("damping_ratio_across_fixed", Unit::NONE, "damping ratio of the fundamental mode across on rigid ground", |f| f.damping_ratio_across_fixed),
        Quantity::<Self>::real("sway_across_stiffness_n_m", Unit::N_PER_M, "horizontal stiffness across", |f| f.sway_across_stiffness_n_m),
        Quantity::<Self>::real("sway_across_damping_n_s_m", Unit::NS_PER_M, "horizontal dashpot across", |f| f.sway_across_damping_n_s_m),
        Quantity::<Self>::real("rocking_across_stiffness_n_m_rad", Unit::NM_PER_RAD, "stiffness against rocking that moves floors across", |f| f.rocking_across_stiffness_n_m_rad),
        Quantity::<Self>::real("rocking_across_damping_n_m_s_rad", Unit::NMS_PER_RAD, "dashpot of this rotation", |f| f.rocking_across_damping_n_m_s_rad),
        Quantity::<Self>::real("torsional_stiffness_n_m_rad", Unit::NM_PER_RAD, "torsional stiffness about the vertical axis", |f| f.torsional_stiffness_n_m_rad),
        Quantity::<Self>::real("torsional_damping_n_m_s_rad", Unit::NMS_PER_RAD, "dashpot of this rotation", |f| f.torsional_damping_n_m_s_rad),
    ];
}
