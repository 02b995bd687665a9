//! The oscillator of one mass that a pushed building is taken for.

use super::pattern::{LoadPattern, loaded_mass};
use super::{Pushover, floor_loads};
use crate::system::BuildingSystem;

/// Mass and participation factor of the shape φ that the load of a pushover implies, φ being the load over the mass of a
/// floor, one at the roof (EN 1998-1:2004, Annex B, B.2; P. Fajfar (2000), Earthquake Spectra 16, 573–592):
///
/// ```text
/// m* = Σ m φ,   Γ = m* / Σ m φ²,   S_d = roof displacement / Γ,   S_a = base shear / (Γ m*)
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EquivalentOscillator {
    /// m*, > 0 \[kg\].
    pub mass: f64,
    /// Γ, > 0 \[–\].
    pub participation: f64,
}

impl EquivalentOscillator {
    /// That of a curve of a building; `None` if the load is zero at the roof, or another floor is without mass.
    #[must_use]
    pub fn new(building: &BuildingSystem, curve: &Pushover) -> Option<Self> {
        let shares = floor_loads(building, &LoadPattern::Uniform.forces(building)?);
        let masses = shares.iter().map(|share| share * loaded_mass(building));
        let masses: Vec<f64> = masses.collect();
        let ratio = |(load, mass): (&f64, &f64)| load / mass;
        let roof = curve.floor_loads.last().zip(masses.last()).map(ratio)?;
        let (mut first, mut second) = (0.0, 0.0);
        for (load, mass) in curve.floor_loads.iter().zip(&masses) {
            if *mass > 0.0 {
                let shape = load / mass / roof;
                first += mass * shape;
                second += mass * shape * shape;
            }
        }
        let found = Self {
            mass: first,
            participation: first / second,
        };
        let sound = |value: f64| value.is_finite() && value > 0.0;
        (sound(found.mass) && sound(found.participation)).then_some(found)
    }

    /// Spectral displacement and acceleration of a roof displacement \[m\] and a base shear \[N\]: \[m, m/s²\].
    #[must_use]
    pub fn spectral(&self, roof: f64, base_shear: f64) -> [f64; 2] {
        let (mass, participation) = (self.mass, self.participation);
        [roof / participation, base_shear / (participation * mass)]
    }
}
