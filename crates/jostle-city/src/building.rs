//! A building of an inventory.

use geo::Polygon;
use jostle_classes::Level;

/// Height of a storey where only the height of the building is known \[m\].
pub(crate) const STOREY: f64 = 3.2;

/// Heights of a storey that a building may have \[m\].
const STOREYS: std::ops::RangeInclusive<f64> = 2.2..=6.0;

/// A building of a city.
#[derive(Clone, Debug, PartialEq)]
pub struct Building {
    /// Its name in the inventory, or the number of its row.
    pub id: String,
    /// Row of the inventory, from 1.
    pub row: usize,
    /// Outline in the plane \[m\].
    pub outline: Polygon,
    /// Area of the outline without its courts \[m²\].
    pub area: f64,
    /// Storeys above the ground, where known.
    pub storeys: Option<usize>,
    /// Height above the ground, where known \[m\].
    pub height: Option<f64>,
    /// Year of construction, where known.
    pub year: Option<i32>,
    /// Structural type as the inventory names it.
    pub kind: Option<String>,
    /// Design level that the type names, where it does.
    pub level: Option<Level>,
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

    /// Height of a storey by the height of the building, if that is one of a storey, 2.2 to 6 m \[m\].
    #[must_use]
    pub fn storey_height(&self) -> Option<f64> {
        let of_height = |height: f64| height / self.likely_storeys() as f64;
        self.height
            .map(of_height)
            .filter(|height| STOREYS.contains(height))
    }

    /// Height, from the storeys at 3.2 m each where there is none that fits them \[m\].
    #[must_use]
    pub fn likely_height(&self) -> f64 {
        let storey = self.storey_height().unwrap_or(STOREY);
        storey * self.likely_storeys() as f64
    }
}
