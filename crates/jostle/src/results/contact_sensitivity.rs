//! Dependence of results on the contact stiffness and the restitution, which are known only to an order of magnitude.

use serde::Serialize;

/// An end of the advised range of contact stiffness.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum RangeEnd {
    /// Softest.
    Low,
    /// Stiffest.
    High,
}

/// One other contact.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ContactVariant {
    /// End of the advised range ([`advised_range`](crate::contact::advised_range)) to which the stiffness of every gap is set; `None`
    /// keeps it. Gaps without such a range take half and twice their stiffness.
    pub stiffness: Option<RangeEnd>,
    /// Change of the coefficient of restitution of every gap, before it is kept within what its law can do \[–\].
    pub restitution_change: f64,
}

impl ContactVariant {
    /// Both ends of the advised range of stiffness, and a restitution 0.15 lower and higher.
    pub const USUAL: [Self; 4] = [
        Self::new(Some(RangeEnd::Low), 0.0),
        Self::new(Some(RangeEnd::High), 0.0),
        Self::new(None, -0.15),
        Self::new(None, 0.15),
    ];

    const fn new(stiffness: Option<RangeEnd>, restitution_change: f64) -> Self {
        Self {
            stiffness,
            restitution_change,
        }
    }
}

/// Results of runs with other contacts beside those of the run itself.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ContactSensitivity {
    /// The other contacts, and what came out.
    pub variants: Vec<VariantResult>,
    /// Spread of every gap over the run and the others.
    pub gaps: Vec<GapSpread>,
    /// Greatest changes of every building against the run.
    pub buildings: Vec<BuildingChange>,
}

/// A run with another contact.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct VariantResult {
    /// The contact.
    #[serde(flatten)]
    pub contact: ContactVariant,
    /// Factor on the contact stiffness of the first gap \[–\].
    pub stiffness_factor: f64,
    /// Contact stiffness of every gap \[N/m^1.5 or N/m\].
    pub stiffnesses: Vec<f64>,
    /// Greatest force of any gap \[N\].
    pub peak_force_n: f64,
    /// Impacts of all gaps.
    pub impact_count: usize,
}

/// Least and greatest of one gap.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GapSpread {
    /// Names of the left and the right building.
    pub between: [String; 2],
    /// Least greatest force \[N\].
    pub peak_force_min_n: f64,
    /// Greatest one \[N\].
    pub peak_force_max_n: f64,
    /// Fewest impacts.
    pub impact_count_min: usize,
    /// Most impacts.
    pub impact_count_max: usize,
}

/// Greatest changes of peaks at any floor, relative to the greatest of their kind in the building \[–\].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BuildingChange {
    /// Name.
    pub name: String,
    /// Floor displacements, either side.
    pub displacement: f64,
    /// Storey drifts.
    pub storey_drift: f64,
    /// Total accelerations.
    pub total_acceleration: f64,
    /// Storey shears.
    pub storey_shear: f64,
    /// Overturning moments.
    pub overturning_moment: f64,
    /// Least greatest total acceleration of any floor over the run and the others \[m/s²\].
    pub total_acceleration_min_m_s2: f64,
    /// Greatest one \[m/s²\].
    pub total_acceleration_max_m_s2: f64,
}
