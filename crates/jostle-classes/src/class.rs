//! A class of buildings: a structural type at a design level.

use std::ops::RangeInclusive;
use std::sync::Arc;

use jostle_batch::Building;

use crate::level::Level;
use crate::mdof_lu::Capacity;

/// A structural type at a design level.
#[derive(Clone, Debug, PartialEq)]
pub struct Class {
    /// Name of the type, such as `C1M`.
    pub name: Arc<str>,
    /// Design level.
    pub level: Level,
    /// Capacity curve.
    pub capacity: Capacity,
    /// Storeys that the type is meant for; 16 as the most means no limit.
    pub storeys: RangeInclusive<usize>,
    /// Storeys of its typical building, whose capacity curve is given.
    pub typical_storeys: f64,
    /// Height of a storey \[m\].
    pub storey_height: f64,
    /// Mass of a floor per area of the building \[kg/m²\].
    pub area_mass: f64,
    /// Drift ratios at which slight, moderate, extensive and complete damage begin \[–\].
    pub drifts: [f64; 4],
    /// Pinching, 1 for none \[–\].
    pub pinching: f64,
    /// Exponent of the unloading stiffness \[–\].
    pub unloading_exponent: f64,
    /// Damping ratio \[–\].
    pub damping: f64,
}

impl Class {
    /// A building of the class: storeys 1…16, area of a floor \[m²\].
    #[must_use]
    pub fn building(&self, storeys: usize, area: f64) -> Building {
        self.capacity
            .coefficients(
                self.typical_storeys,
                self.pinching,
                self.unloading_exponent,
                self.damping,
            )
            .building(storeys, self.area_mass * area, self.storey_height)
    }
}
