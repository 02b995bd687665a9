//! What a reference run finds.

/// Peaks of a building.
#[derive(Clone, Debug, Default)]
pub struct BuildingPeaks {
    /// Greatest displacement of every floor, ≥ 0 \[m\].
    pub most: Vec<f64>,
    /// Least, ≤ 0 \[m\].
    pub least: Vec<f64>,
    /// Greatest drift ratio of every storey \[–\].
    pub drift: Vec<f64>,
    /// Greatest total acceleration of every floor \[m/s²\].
    pub acceleration: Vec<f64>,
    /// Greatest base shear \[N\].
    pub shear: f64,
}

/// What a reference run finds.
#[derive(Clone, Debug, Default)]
pub struct Peaks {
    /// By building.
    pub buildings: Vec<BuildingPeaks>,
    /// Greatest force of every contact \[N\].
    pub force: Vec<f64>,
    /// Impulse of every contact \[N·s\].
    pub impulse: Vec<f64>,
    /// Touches.
    pub touches: u64,
    /// Lasting contacts of the momentum law.
    pub lasting: u64,
    /// Steps.
    pub steps: u64,
}
