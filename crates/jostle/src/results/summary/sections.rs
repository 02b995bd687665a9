//! Ends of columns that are made of fibres.

use serde::Serialize;

use crate::model::FibreLimit;
use crate::quantity::{Quantity, Unit};

/// An end of a column that is made of fibres. Forces are positive in tension, moments and rotations where they stretch the right side
/// (in a space frame, that to greater x), strains in tension.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct FibreSummary {
    /// Name: `BUILDING.column.LINE.STOREY.foot` or `head`; `BUILDING.column.X.Y.STOREY.foot` in a space frame.
    pub name: String,
    /// Greatest axial force \[N\].
    pub axial_max_n: f64,
    /// Least axial force: greatest compression as a negative force \[N\].
    pub axial_min_n: f64,
    /// Greatest moment \[N·m\].
    pub moment_max_n_m: f64,
    /// Least moment \[N·m\].
    pub moment_min_n_m: f64,
    /// Greatest rotation \[rad\].
    pub rotation_max_rad: f64,
    /// Least rotation \[rad\].
    pub rotation_min_rad: f64,
    /// The same in the plane across, of a column of a space frame.
    #[serde(flatten)]
    pub across: Option<FibreAcrossSummary>,
    /// Greatest elongation of its axis \[m\].
    pub elongation_max_m: f64,
    /// Least elongation: greatest shortening as a negative length \[m\].
    pub elongation_min_m: f64,
    /// Greatest compressive strain of concrete, ≥ 0; absent without concrete \[–\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub concrete_strain: Option<f64>,
    /// When concrete first passed the strain at its strength \[s\]; absent if it did not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crushed_s: Option<f64>,
    /// Share of the concrete fibres that passed it \[–\].
    pub crushed_share: f64,
    /// Greatest strain of bars in tension, ≥ 0; absent without bars \[–\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steel_strain: Option<f64>,
    /// When bars, or the section on its surface, first yielded \[s\]; absent if they did not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub yielded_s: Option<f64>,
    /// Strains that are judged; empty without any.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub limits: Vec<StrainLimitSummary>,
    /// Energy dissipated \[J\].
    pub dissipated_j: f64,
}

/// A strain at which something happens to the section, and whether its fibres passed it.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct StrainLimitSummary {
    /// What happens: `spalling` of the cover, `crushing` of the confined core, `buckling` or `fracture` of bars.
    pub limit: FibreLimit,
    /// The strain: of concrete in compression, of bars in tension, > 0 \[–\].
    pub strain_limit: f64,
    /// Greatest strain of these fibres, ≥ 0 \[–\].
    pub strain: f64,
    /// When they first passed it \[s\]; absent if they did not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub passed_s: Option<f64>,
}

impl StrainLimitSummary {
    /// Greatest strain over its limit \[–\].
    #[must_use]
    pub fn ratio(&self) -> f64 {
        self.strain / self.strain_limit
    }
}

impl FibreSummary {
    /// The greatest strain over its limit; `None` where nothing is judged \[–\].
    #[must_use]
    pub fn worst_ratio(&self) -> Option<f64> {
        let ratios = self.limits.iter().map(StrainLimitSummary::ratio);
        ratios.reduce(f64::max)
    }
}

#[rustfmt::skip]
impl StrainLimitSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("strain_limit", Unit::NONE, "strain limit: of concrete in compression, of bars in tension", |s| s.strain_limit),
        Quantity::<Self>::real("strain", Unit::NONE, "peak strain of these fibres", |s| s.strain),
        Quantity::<Self>::optional("passed_s", Unit::S, "time at which they first exceeded it; absent if they did not", |s| s.passed_s),
    ];
}

/// Moments and rotations of an end of a column of a space frame in the plane across, positive where they stretch the side further
/// across.
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
pub struct FibreAcrossSummary {
    /// Greatest moment \[N·m\].
    pub moment_across_max_n_m: f64,
    /// Least moment \[N·m\].
    pub moment_across_min_n_m: f64,
    /// Greatest rotation \[rad\].
    pub rotation_across_max_rad: f64,
    /// Least rotation \[rad\].
    pub rotation_across_min_rad: f64,
}

#[rustfmt::skip]
impl FibreAcrossSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("moment_across_max_n_m", Unit::NM, "greatest moment in the plane across, positive with tension on the face towards greater y", |s| s.moment_across_max_n_m),
        Quantity::<Self>::real("moment_across_min_n_m", Unit::NM, "most negative moment in the plane across", |s| s.moment_across_min_n_m),
        Quantity::<Self>::real("rotation_across_max_rad", Unit::RAD, "greatest rotation in the plane across, positive with tension on the face towards greater y", |s| s.rotation_across_max_rad),
        Quantity::<Self>::real("rotation_across_min_rad", Unit::RAD, "most negative rotation in the plane across", |s| s.rotation_across_min_rad),
    ];
}

#[rustfmt::skip]
impl FibreSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("axial_max_n", Unit::N, "greatest axial force, positive in tension", |s| s.axial_max_n),
        Quantity::<Self>::real("axial_min_n", Unit::N, "smallest axial force, that is greatest compression, negative", |s| s.axial_min_n),
        Quantity::<Self>::real("moment_max_n_m", Unit::NM, "greatest moment, positive with tension on the right side", |s| s.moment_max_n_m),
        Quantity::<Self>::real("moment_min_n_m", Unit::NM, "most negative moment", |s| s.moment_min_n_m),
        Quantity::<Self>::real("rotation_max_rad", Unit::RAD, "greatest rotation, positive with tension on the right side", |s| s.rotation_max_rad),
        Quantity::<Self>::real("rotation_min_rad", Unit::RAD, "most negative rotation", |s| s.rotation_min_rad),
        Quantity::<Self>::real("elongation_max_m", Unit::M, "greatest elongation of the axis", |s| s.elongation_max_m),
        Quantity::<Self>::real("elongation_min_m", Unit::M, "greatest shortening of the axis, negative", |s| s.elongation_min_m),
        Quantity::<Self>::optional("concrete_strain", Unit::NONE, "greatest compressive strain of concrete", |s| s.concrete_strain),
        Quantity::<Self>::optional("crushed_s", Unit::S, "time at which any concrete fibre, core or cover, first exceeded its strain at peak strength; for the core beyond its strain limit see `strains.crushed`", |s| s.crushed_s),
        Quantity::<Self>::real("crushed_share", Unit::NONE, "fraction of the concrete fibres that exceeded it", |s| s.crushed_share),
        Quantity::<Self>::optional("steel_strain", Unit::NONE, "peak tensile strain of bars", |s| s.steel_strain),
        Quantity::<Self>::optional("yielded_s", Unit::S, "time at which bars first yielded, or the surface of axial force and moment was first passed", |s| s.yielded_s),
        Quantity::<Self>::real("dissipated_j", Unit::J, "energy dissipated", |s| s.dissipated_j),
    ];
}
