//! Uniaxial laws: stress as a function of strain. Compression is positive for concrete, tension for steel.

use crate::concrete::Concrete;
use crate::section::Section;
use crate::steel::Steel;

/// Concrete under growing strain, in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConcreteLaw {
    /// Greatest compressive stress \[Pa\].
    pub peak_stress: f64,
    /// Strain there \[–\].
    pub peak_strain: f64,
    /// Initial modulus \[Pa\].
    pub modulus: f64,
    /// Tensile strength: straight up to it, nothing beyond \[Pa\].
    pub tensile_strength: f64,
    /// How fast the stress falls beyond the peak; `None` follows Popovics there too (Mander's confined concrete).
    pub softening: Option<f64>,
    /// Compressive strain at which the concrete is crushed \[–\].
    pub crushing_strain: f64,
}

impl ConcreteLaw {
    /// Unconfined concrete: up to the peak by Popovics with its own modulus and strain; beyond it as GB 50010-2010, C.2.4,
    /// or, if its standard states the strains, further by Popovics. Crushed at [`Concrete::crushing_strain`].
    #[must_use]
    pub fn unconfined(concrete: &Concrete) -> Self {
        let strength = 1e-6 * concrete.strength;
        let softening = (0.157 * libm::pow(strength, 0.785) - 0.905).max(0.0);
        Self {
            peak_stress: concrete.strength,
            peak_strain: concrete.peak_strain(),
            modulus: concrete.modulus,
            tensile_strength: concrete.tensile_strength,
            softening: concrete.strains.is_none().then_some(softening),
            crushing_strain: concrete.crushing_strain(),
        }
    }

    /// Strain at cracking, as a magnitude \[–\].
    #[must_use]
    pub fn cracking_strain(&self) -> f64 {
        self.tensile_strength / self.modulus
    }

    /// Stress at a strain, both positive in compression \[Pa\].
    #[must_use]
    pub fn stress(&self, strain: f64) -> f64 {
        if strain <= 0.0 {
            let stress = self.modulus * strain;
            return if -stress <= self.tensile_strength {
                stress
            } else {
                0.0
            };
        }
        let x = strain / self.peak_strain;
        match self.softening {
            Some(alpha) if x > 1.0 => self.peak_stress * x / (alpha * (x - 1.0) * (x - 1.0) + x),
            _ => {
                // Popovics' curve; its initial slope is the modulus.
                let secant = self.peak_stress / self.peak_strain;
                let n = self.modulus / (self.modulus - secant).max(1e-6 * self.modulus);
                self.peak_stress * x * n / (n - 1.0 + libm::pow(x, n))
            }
        }
    }
}

/// Law of the core of a section whose ties confine it; `None` without ties.
///
/// Mander, Priestley and Park (1988): lateral pressure of rectangular hoops with their legs each way, reduced by
/// the arches between ties and between the bars in the corners; strength by the formula for equal pressures; crushed
/// at 0.004 + 1.4 ρs fy εsu / fcc (Priestley, Seible and Calvi, 1996).
#[must_use]
pub fn confined(section: &Section) -> Option<ConcreteLaw> {
    let ties = section.ties?;
    let plain = ConcreteLaw::unconfined(&section.concrete);
    let (width, depth) = core(section);
    let legs = ties.area();
    let ratios = [legs / (ties.spacing * depth), legs / (ties.spacing * width)];
    let clear = (ties.spacing - ties.diameter).max(0.0);
    // Of the bars only those in the corners are sure to be held.
    let between = [width, depth].map(|side| side * side / 6.0 * 2.0);
    let plan = (1.0 - (between[0] + between[1]) / (width * depth)).max(0.0);
    let arches = plan * (1.0 - 0.5 * clear / width).max(0.0) * (1.0 - 0.5 * clear / depth).max(0.0)
        / (1.0 - section.steel_area() / (width * depth));
    let pressure = arches * 0.5 * (ratios[0] + ratios[1]) * section.steel.yield_strength;
    let relative = pressure / plain.peak_stress;
    let gain = -1.254 + 2.254 * (1.0 + 7.94 * relative).sqrt() - 2.0 * relative;
    let peak_stress = plain.peak_stress * gain;
    let volumetric = ratios[0] + ratios[1];
    let toughness = volumetric * section.steel.yield_strength * section.steel.rupture_strain;
    Some(ConcreteLaw {
        peak_stress,
        peak_strain: plain.peak_strain * (1.0 + 5.0 * (gain - 1.0)),
        softening: None,
        crushing_strain: 0.004 + 1.4 * toughness / peak_stress,
        ..plain
    })
}

/// Width and depth of the core, between the centres of the ties \[m\].
pub(crate) fn core(section: &Section) -> (f64, f64) {
    let inset = core_inset(section);
    (section.width - 2.0 * inset, section.depth - 2.0 * inset)
}

/// Distance of the core from the faces \[m\].
pub(crate) fn core_inset(section: &Section) -> f64 {
    let tie = section.ties.map_or(0.0, |ties| ties.diameter);
    (section.cover - 0.5 * tie).max(0.0)
}

/// Steel with one corner, the same in tension and compression.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteelLaw(pub Steel);

impl SteelLaw {
    /// Stress at a strain \[Pa\].
    #[must_use]
    pub fn stress(&self, strain: f64) -> f64 {
        let Steel {
            yield_strength,
            modulus,
            hardening,
            ..
        } = self.0;
        let elastic = modulus * strain;
        if elastic.abs() <= yield_strength {
            return elastic;
        }
        let beyond = strain.abs() - yield_strength / modulus;
        strain.signum() * (yield_strength + hardening * modulus * beyond)
    }
}
