//! Dependence of results on the contact stiffness and the restitution, which are known only to an order of magnitude.

use serde::Serialize;

/// One other contact.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ContactVariant {
    /// Factor on the contact stiffness of every gap, > 0 \[–\].
    pub stiffness_factor: f64,
    /// Change of the coefficient of restitution of every gap, before it is kept within what its law can do \[–\].
    pub restitution_change: f64,
}

impl ContactVariant {
    /// Half and twice the stiffness, and a restitution 0.15 lower and higher.
    pub const USUAL: [Self; 4] = [
        Self::new(0.5, 0.0),
        Self::new(2.0, 0.0),
        Self::new(1.0, -0.15),
        Self::new(1.0, 0.15),
    ];

    const fn new(stiffness_factor: f64, restitution_change: f64) -> Self {
        Self {
            stiffness_factor,
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
}
