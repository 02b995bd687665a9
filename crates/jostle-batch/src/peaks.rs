//! Greatest responses of a row.

/// Greatest response of a building, per storey or floor from the ground up.
#[derive(Clone, Debug, PartialEq)]
pub struct BuildingPeaks {
    /// Drift \[m\].
    pub drift: Vec<f64>,
    /// Total acceleration of the floor \[m/s²\].
    pub acceleration: Vec<f64>,
    /// Drift at the end of the motion, signed \[m\].
    pub residual: Vec<f64>,
}

/// Greatest response of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPeaks {
    /// Greatest approach of the faces, also without a touch \[m\]; negative where they only part.
    pub closing: f64,
    /// Force \[N\].
    pub force: f64,
    /// Impulse \[N·s\].
    pub impulse: f64,
    /// Touches.
    pub impacts: u32,
    /// A slab strikes columns here.
    pub column: bool,
}

/// Greatest response of a row.
#[derive(Clone, Debug, PartialEq)]
pub struct Peaks {
    /// As the buildings of the row.
    pub buildings: Vec<BuildingPeaks>,
    /// As the gaps of the row, and their contacts.
    pub gaps: Vec<Vec<ContactPeaks>>,
}
