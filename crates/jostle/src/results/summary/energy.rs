//! Energies.

use serde::Serialize;

use crate::quantity::{Quantity, Unit};

/// Energies at the end of the run \[J\].
#[derive(Clone, Copy, Debug, Default, Serialize, PartialEq)]
pub struct EnergySummary {
    /// Work of the ground motion.
    pub input_j: f64,
    /// Work of grounds that move apart, through contacts and links; absent where one ground is under all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ground_j: Option<f64>,
    /// Kinetic energy.
    pub kinetic_j: f64,
    /// Strain energy.
    pub strain_j: f64,
    /// Dissipated by viscous damping, that of links included.
    pub damped_j: f64,
    /// The part of links.
    pub links_j: f64,
    /// Dissipated in the dashpots of the soil: the part of damped_j that radiates or heats the soil; absent without foundations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub soil_j: Option<f64>,
    /// Energy of hinges.
    pub hysteretic_j: f64,
    /// Energy of contacts.
    pub contact_j: f64,
    /// Dissipated by friction along faces; absent without.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction_j: Option<f64>,
    /// |input + ground − sum of the others| / input at the end \[–\].
    pub imbalance: f64,
    /// Greatest imbalance over time, relative to the greatest energy until then \[–\].
    pub worst_imbalance: f64,
}

#[rustfmt::skip]
impl EnergySummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("input_j", Unit::J, "work of the ground motion", |e| e.input_j).in_study(),
        Quantity::<Self>::optional("ground_j", Unit::J, "additional work done through contacts and links by differential ground motion; only with different motion under each building", |e| e.ground_j),
        Quantity::<Self>::real("kinetic_j", Unit::J, "kinetic energy", |e| e.kinetic_j),
        Quantity::<Self>::real("strain_j", Unit::J, "strain energy", |e| e.strain_j),
        Quantity::<Self>::real("damped_j", Unit::J, "energy dissipated by viscous damping, including links", |e| e.damped_j).in_study(),
        Quantity::<Self>::real("links_j", Unit::J, "part of this dissipated by links", |e| e.links_j),
        Quantity::<Self>::optional("soil_j", Unit::J, "part of this dissipated by soil dashpots; only with foundations", |e| e.soil_j),
        Quantity::<Self>::real("hysteretic_j", Unit::J, "energy in hinges", |e| e.hysteretic_j).in_study(),
        Quantity::<Self>::real("contact_j", Unit::J, "energy in contacts", |e| e.contact_j).in_study(),
        Quantity::<Self>::optional("friction_j", Unit::J, "energy dissipated by friction along faces; only with friction", |e| e.friction_j),
        Quantity::<Self>::real("imbalance", Unit::NONE, "energy imbalance at the end, relative to the input", |e| e.imbalance).in_study(),
        Quantity::<Self>::real("worst_imbalance", Unit::NONE, "greatest energy imbalance over time, relative to the greatest energy up to that time", |e| e.worst_imbalance).in_study(),
    ];
}
