//! Peaks of a reference run.

use jostle::System;

use crate::certify::quantities::More;

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
    /// Greatest shear of every storey \[N\].
    pub storey_shear: Vec<f64>,
    /// Greatest overturning moment about the base of every storey \[N·m\].
    pub moment: Vec<f64>,
    /// What only buildings in plan, on bearings or on soil have.
    pub more: Vec<More>,
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
    /// Greatest closing of every contact, signed \[m\].
    pub closing: Vec<f64>,
    /// Greatest force of every link \[N\].
    pub link: Vec<f64>,
    /// Touches.
    pub touches: u64,
    /// Lasting contacts of the momentum law.
    pub lasting: u64,
    /// Steps.
    pub steps: u64,
}

impl Peaks {
    /// Those of a system at rest.
    pub(super) fn new(system: &System) -> Self {
        let buildings = system.buildings.iter().map(|building| {
            let none = vec![0.0; building.floors.len()];
            BuildingPeaks {
                most: none.clone(),
                least: none.clone(),
                drift: none.clone(),
                acceleration: none.clone(),
                shear: 0.0,
                storey_shear: none.clone(),
                moment: none,
                more: Vec::new(),
            }
        });
        Self {
            buildings: buildings.collect(),
            force: vec![0.0; system.contacts.len()],
            impulse: vec![0.0; system.contacts.len()],
            closing: vec![f64::NEG_INFINITY; system.contacts.len()],
            link: vec![0.0; system.links.len()],
            ..Self::default()
        }
    }
}
