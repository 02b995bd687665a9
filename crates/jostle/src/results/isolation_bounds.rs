//! Results at the lower and upper bound of the properties of bearings beside those at their nominal values.

use serde::Serialize;

/// A peak at the nominal properties of all bearings, at their lower and at their upper bounds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bounded {
    /// At the properties that the model states.
    pub nominal: f64,
    /// At the lower bounds.
    pub lower: f64,
    /// At the upper bounds.
    pub upper: f64,
    /// Greatest of the three.
    pub envelope: f64,
}

impl Bounded {
    /// The peaks of the three runs: nominal, lower, upper.
    #[must_use]
    pub fn new([nominal, lower, upper]: [f64; 3]) -> Self {
        Self {
            nominal,
            lower,
            upper,
            envelope: nominal.max(lower).max(upper),
        }
    }
}

/// Peaks of all buildings and gaps over the range of the properties of bearings.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct IsolationBounds {
    /// Buildings, in the order of the model.
    pub buildings: Vec<BoundedBuilding>,
    /// Gaps, in the order of the model.
    pub gaps: Vec<BoundedGap>,
}

/// A building over the range.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BoundedBuilding {
    /// Name.
    pub name: String,
    /// Displacement of the mat, or of the worst bearing of a building with a plan; `None` for a building without bearings \[m\].
    pub stroke_m: Option<Bounded>,
    /// Force of the bearings, dashpot included, along x or across, whichever is greater; `None` without bearings \[N\].
    pub force_n: Option<Bounded>,
    /// Drift ratio of any storey \[–\].
    pub drift: Bounded,
    /// Shear of any storey; of an isolated building, of those above the mat \[N\].
    pub storey_shear_n: Bounded,
}

/// A gap over the range.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BoundedGap {
    /// Names of the left and the right building.
    pub between: [String; 2],
    /// Greatest contact force \[N\].
    pub peak_force_n: Bounded,
    /// Impacts.
    pub impact_count: Bounded,
    /// Greatest closing without contact, the gap needed; `None` where no run without contact was made \[m\].
    pub closing_without_contact_m: Option<Bounded>,
}
