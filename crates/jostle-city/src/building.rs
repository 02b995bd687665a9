//! A building of an inventory.

use geo::Polygon;
use jostle_classes::Level;

/// Height of a storey where only the height of the building is known \[m\].
pub(crate) const STOREY: f64 = 3.2;

/// Heights of a storey that a building may have \[m\].
pub(crate) const STOREYS: std::ops::RangeInclusive<f64> = 2.2..=6.0;

/// A building of a city.
#[derive(Clone, Debug, PartialEq)]
pub struct Building {
    /// Its name in the inventory, or the number of its row.
    pub id: String,
    /// Row of the inventory, from 1.
    pub row: usize,
    /// Outline in the plane, with its courts \[m\].
    pub outline: Polygon,
    /// Area of the outline less that of courts \[m²\].
    pub area: f64,
    /// Storeys above the ground, where known.
    pub storeys: Option<usize>,
    /// Height above the ground, where it is known and gives storeys of 2.2 m to 6 m \[m\].
    pub height: Option<f64>,
    /// Year of construction, where known.
    pub year: Option<i32>,
    /// Level of the code by which it was designed, where its type says it.
    pub level: Option<Level>,
    /// Structural type as the inventory names it.
    pub kind: Option<String>,
}

impl Building {
    /// Storeys, from the height at 3.2 m each if need be, or 1.
    #[must_use]
    pub fn likely_storeys(&self) -> usize {
        let of_height = || {
            self.height
                .map(|height| ((height / STOREY).round() as usize).max(1))
        };
        self.storeys.or_else(of_height).unwrap_or(1)
    }

    /// Height, from the storeys at 3.2 m each if need be \[m\].
    #[must_use]
    pub fn likely_height(&self) -> f64 {
        self.height.unwrap_or(self.likely_storeys() as f64 * STOREY)
    }
}
