//! Braces, struts, walls and coupling beams of frames, and foundations that lift off.

use serde::Serialize;

use crate::quantity::{Quantity, Unit};

/// A brace, a strut of an infill panel, a wall, a coupling beam, or the ground under a foundation, which bears compression alone.
#[derive(Clone, Debug, Default, Serialize, PartialEq)]
pub struct PartSummary {
    /// Name: `BUILDING.brace.STOREY.BAY`, with the way it rises from left to right, `up` or `down`, where two cross;
    /// `BUILDING.wall.NUMBER`; `BUILDING.coupling-beam.FLOOR.BAY`; `BUILDING.footing`, with the column line where every column has
    /// its own.
    pub name: String,
    /// `brace`, `infill`, `wall`, `coupling-beam` or `footing`.
    pub kind: &'static str,
    /// Greatest tension, of a wall at its foot; of a coupling beam its greatest shear, positive as that of beams. Zero if there is none
    /// \[N\].
    pub force_max_n: f64,
    /// Greatest compression, or shear of the other sense, as a negative force; zero if there is none \[N\].
    pub force_min_n: f64,
    /// Greatest elongation, ≥ 0, of a wall between its foot and its top; of a coupling beam, how far its ends rise against
    /// each other beyond their mean rotation; of a footing the greatest rise above the ground as it was, of any contact spring \[m\].
    pub deformation_max: f64,
    /// The same in the other sense, as a magnitude, ≥ 0; of a footing its greatest sinking \[m\].
    pub deformation_min: f64,
    /// Greatest moment at the foot of a wall, positive where the right face is stretched; absent in others \[N·m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moment_max_n_m: Option<f64>,
    /// Least moment there \[N·m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moment_min_n_m: Option<f64>,
    /// Greatest rotation of the hinge at the foot of a wall, zero without one; of a coupling beam that of its chord. Absent in others
    /// \[rad\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation_max_rad: Option<f64>,
    /// The same in the other sense, as a magnitude \[rad\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation_min_rad: Option<f64>,
    /// Energy dissipated \[J\].
    pub dissipated_j: f64,
    /// When a brace first buckled; 0 if weight alone causes it. Absent in those that do not buckle, and in other parts \[s\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub buckled_s: Option<f64>,
    /// Of a panel whose strength across its plane is given: greatest inertia force of the panel, by the total accelerations of the floors
    /// below and above, over that strength. Absent in others \[–\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub out_of_plane_ratio: Option<f64>,
    /// Of a strut whose panel has fallen out and left the model: when. Absent in others \[s\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fallen_s: Option<f64>,
    /// Of a strut of a panel whose damage is judged: greatest drift of its bay that shortens it, ≥ 0. Absent in others \[–\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drift: Option<f64>,
    /// Damage state of the panel by that drift, 0 to 4.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damage_state: Option<usize>,
    /// Of a footing: share of the run in which a contact spring bears nothing, the greatest of all springs, 0…1 \[–\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lifted_share: Option<f64>,
    /// Of a foundation: greatest force of a contact spring over the area of its strip \[Pa\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pressure_max_pa: Option<f64>,
    /// Of a footing: settlement of the ground at the end of the run, the greatest of all springs, ≥ 0 \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub settlement_m: Option<f64>,
}

impl PartSummary {
    /// Name of the panel of a strut: its own without the way in which it rises, such as `Old.infill.2.1`.
    #[must_use]
    pub fn panel(&self) -> &str {
        let without = |name, ends: [&str; 2]| {
            let mut shorter = ends.iter().filter_map(|end| str::strip_suffix(name, *end));
            shorter.next().unwrap_or(name)
        };
        without(without(&self.name, [".foot", ".head"]), [".up", ".down"])
    }
}

#[rustfmt::skip]
impl PartSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("force_max_n", Unit::N, "peak tension, for a wall at its foot; for a coupling beam, peak shear; for a footing, 0", |p| p.force_max_n),
        Quantity::<Self>::real("force_min_n", Unit::N, "peak compression, or shear of opposite sign, negative; for a footing, that of a contact spring", |p| p.force_min_n),
        Quantity::<Self>::real("deformation_max", Unit::M, "peak elongation, for a wall between its foot and its top; for a coupling beam, transverse displacement between its ends; for a footing, uplift above the initial ground level", |p| p.deformation_max),
        Quantity::<Self>::real("deformation_min", Unit::M, "the same with opposite sign, as a magnitude; for a footing, its greatest downward displacement", |p| p.deformation_min),
        Quantity::<Self>::optional("moment_max_n_m", Unit::NM, "greatest moment at the foot of a wall, positive with tension in its right face", |p| p.moment_max_n_m),
        Quantity::<Self>::optional("moment_min_n_m", Unit::NM, "most negative moment at the foot of a wall", |p| p.moment_min_n_m),
        Quantity::<Self>::optional("rotation_max_rad", Unit::RAD, "greatest rotation of the hinge of a wall, or chord rotation of a coupling beam", |p| p.rotation_max_rad),
        Quantity::<Self>::optional("rotation_min_rad", Unit::RAD, "the same with opposite sign, as a magnitude", |p| p.rotation_min_rad),
        Quantity::<Self>::real("dissipated_j", Unit::J, "energy dissipated", |p| p.dissipated_j),
        Quantity::<Self>::optional("buckled_s", Unit::S, "time at which a brace first buckled; absent if it did not", |p| p.buckled_s),
        Quantity::<Self>::optional("out_of_plane_ratio", Unit::NONE, "for a panel: greatest ratio of out-of-plane inertia force, from the accelerations of the floors below and above, to capacity", |p| p.out_of_plane_ratio),
        Quantity::<Self>::optional("fallen_s", Unit::S, "for a strut: time at which its panel fell out and was removed from the model", |p| p.fallen_s),
        Quantity::<Self>::optional("drift", Unit::NONE, "for a strut of a panel: peak drift of its bay in the direction that shortens it; drift is the shortening of the diagonal ÷ (cosine of its angle × storey height)", |p| p.drift),
        Quantity::<Self>::optional("damage_state", Unit::NONE, "for a panel: damage state from this drift, 0 to 4", |p| p.damage_state.map(|damage_state| damage_state as f64)),
        Quantity::<Self>::optional("lifted_share", Unit::NONE, "for a footing: fraction of the run in which a contact spring carries no force, the greatest of all springs", |p| p.lifted_share),
        Quantity::<Self>::optional("pressure_max_pa", Unit::PA, "for a foundation: peak force of a contact spring ÷ area of its strip", |p| p.pressure_max_pa),
        Quantity::<Self>::optional("settlement_m", Unit::M, "for a footing: settlement of the ground at the end of the run, the greatest of all contact springs", |p| p.settlement_m),
    ];
}
