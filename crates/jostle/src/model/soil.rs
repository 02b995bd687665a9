//! Soil under buildings, and rigid foundations on it.
//!
//! Springs and dashpots of a rigid rectangle after A. Pais and E. Kausel (1988, Soil Dynamics and Earthquake Engineering 7,
//! 213–227) in the form of NIST GCR 12-917-21 (2012), tables 2-2 and 2-3 (theory, Eqs. B19 to B21).

use std::f64::consts::TAU;

use super::{Building, Gap, Model, Structure, Uplift};

/// Soil under all buildings with a foundation.
///
/// ```
/// use jostle::{HalfSpace, Soil, SoilCoupling};
///
/// let stiff_clay = HalfSpace { shear_wave_velocity: 200.0, density: 1800.0, poisson_ratio: 0.33, damping: 0.05 };
/// let soil = Soil { half_space: Some(stiff_clay), coupling: SoilCoupling::None };
/// assert_eq!(stiff_clay.shear_modulus(), 72e6); // N/m²
/// assert_eq!(soil.coupling, SoilCoupling::None);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Soil {
    /// Elastic half-space from which springs and dashpots follow; needed unless [`SoilCoupling::Given`].
    pub half_space: Option<HalfSpace>,
    /// How foundations act on each other through the soil.
    pub coupling: SoilCoupling,
}

/// Homogeneous elastic half-space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// V_s, > 0 \[m/s\].
    pub shear_wave_velocity: f64,
    /// ρ, > 0 \[kg/m³\].
    pub density: f64,
    /// ν, 0 ≤ ν < 0.5 \[–\].
    pub poisson_ratio: f64,
    /// Hysteretic damping ratio of the soil at the strains of the motion, 0 ≤ β_s < 1; adds 2β_s K/ω to every dashpot \[–\].
    pub damping: f64,
}

/// How foundations act on each other through the soil.
#[derive(Clone, Debug, PartialEq)]
pub enum SoilCoupling {
    /// Every foundation stands on its own springs and dashpots.
    None,
    /// Static flexibility between surface foundations (theory, Eq. B24); dashpots stay uncoupled.
    Static,
    /// Springs and dashpots of all foundations over u_A, θ_A, u_B, θ_B, …, from left to right; θ counter-clockwise.
    Given {
        /// Symmetric and positive definite, by rows \[N/m, N, N·m\].
        stiffness: Vec<Vec<f64>>,
        /// Symmetric and positive semidefinite, by rows \[N·s/m, N·s, N·m·s\].
        damping: Vec<Vec<f64>>,
    },
}

/// Rigid rectangular foundation of a building.
///
/// ```
/// use jostle::Foundation;
///
/// let mat = Foundation::rectangle(12.0, 10.0, 120e3);
/// assert_eq!(mat.rotary_inertia, 120e3 * 12.0 * 12.0 / 12.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foundation {
    /// Along the row, > 0 \[m\].
    pub length: f64,
    /// Across the row, > 0 \[m\].
    pub width: f64,
    /// Depth below the surface, with soil in contact with the side walls, ≥ 0 \[m\].
    pub embedment: f64,
    /// Mass, > 0 \[kg\].
    pub mass: f64,
    /// Rotary inertia about the axis across the row, > 0 \[kg·m²\].
    pub rotary_inertia: f64,
    /// Contact with the ground in compression alone; `None` keeps it down: it then neither rises nor sinks.
    pub uplift: Option<Uplift>,
    /// Moment per rotation about the vertical axis, > 0, under a building with a plan; `None`: that of the half-space at the
    /// surface \[N·m/rad\].
    pub torsional_stiffness: Option<f64>,
    /// Moment per angular velocity about that axis, ≥ 0; `None`: what the soil dissipates itself, without radiation \[N·m·s/rad\].
    pub torsional_damping: Option<f64>,
}

/// Springs and dashpots under a foundation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FoundationSprings {
    /// Force per horizontal displacement \[N/m\].
    pub sway_stiffness: f64,
    /// Force per horizontal velocity \[N·s/m\].
    pub sway_damping: f64,
    /// Moment per rotation \[N·m/rad\].
    pub rocking_stiffness: f64,
    /// Moment per angular velocity \[N·m·s/rad\].
    pub rocking_damping: f64,
    /// Force per vertical displacement; used by foundations that lift off \[N/m\].
    pub vertical_stiffness: f64,
    /// Force per vertical velocity; used by the same \[N·s/m\].
    pub vertical_damping: f64,
    /// a₀ = ωB/V_s at which they hold, B being half the shorter side; 0 for given matrices \[–\].
    pub frequency: f64,
}

impl HalfSpace {
    /// G = ρV_s² \[N/m²\].
    #[must_use]
    pub fn shear_modulus(&self) -> f64 {
        self.density * self.shear_wave_velocity * self.shear_wave_velocity
    }

    /// Ratio of the velocity of the waves that rocking sends down to V_s: √(2(1 − ν)/(1 − 2ν)), at most 2.5 \[–\].
    #[must_use]
    pub fn wave_velocity_ratio(&self) -> f64 {
        let nu = self.poisson_ratio;
        (2.0 * (1.0 - nu) / (1.0 - 2.0 * nu)).sqrt().min(2.5)
    }

    /// Springs and dashpots of a foundation in motions of a period, > 0 \[s\].
    ///
    /// The spring of sway and its dashpot at the surface do not depend on the period; the others do.
    #[must_use]
    pub fn springs(&self, foundation: &Foundation, period: f64) -> FoundationSprings {
        let (length, width) = (0.5 * foundation.length, 0.5 * foundation.width);
        // L ≥ B; x runs along the longer side, and rocking about y moves it up and down.
        let (l, b) = (length.max(width), length.min(width));
        let along_longer = length >= width;
        let (q, depth) = (l / b, foundation.embedment / b);
        let (g, nu, psi) = (
            self.shear_modulus(),
            self.poisson_ratio,
            self.wave_velocity_ratio(),
        );
        let omega = TAU / period;
        let a0 = omega * b / self.shear_wave_velocity;
        let a2 = a0 * a0;
        let embedded_sway = 1.0 + (0.33 + 1.34 / (1.0 + q)) * libm::pow(depth, 0.8);
        let (sway, radiated) = if along_longer {
            (2.4, q + depth * (psi + q))
        } else {
            (0.8 * q + 1.6, q + depth * (1.0 + psi * q))
        };
        let sway_stiffness = g * b / (2.0 - nu) * (6.8 * libm::pow(q, 0.65) + sway) * embedded_sway;
        let impedance = self.density * self.shear_wave_velocity * b * b;
        let sway_radiation = 4.0 * impedance * radiated;
        let rocking_scale = g * b * b * b / (1.0 - nu);
        let cube = q * q * q;
        // η of embedment, the spring at the surface, its change with frequency, and the dashpot over ρ V_s B⁴.
        let [embedded, spring, softening, dashpot] = if along_longer {
            let moving = cube * depth
                + psi * q * depth.powi(3)
                + depth.powi(3)
                + 3.0 * depth * q * q
                + psi * cube;
            [
                1.0 + depth + 1.6 * depth * depth / (0.35 + q.powi(4)),
                3.73 * libm::pow(q, 2.4) + 0.27,
                0.55 * a2 / (0.6 + 1.4 / cube + a2),
                moving * a2 / (1.8 / (1.0 + 1.75 * (q - 1.0)) + a2) + (psi + q) * depth.powi(3),
            ]
        } else {
            let moving =
                depth + depth.powi(3) + psi * q * depth.powi(3) + 3.0 * depth * q + psi * q;
            [
                1.0 + depth + 1.6 * depth * depth / (0.35 + q),
                3.2 * q + 0.8,
                (0.55 + 0.01 * (q - 1.0).sqrt()) * a2 / (2.4 - 0.4 / cube + a2),
                moving * a2 / (2.2 - 0.4 / cube + a2) + (1.0 + psi * q) * depth.powi(3),
            ]
        };
        let rocking_stiffness = rocking_scale * spring * embedded * (1.0 - softening);
        let rocking_radiation = 4.0 / 3.0 * impedance * b * b * dashpot;
        // Vertical motion radiates from the base and along the sides, at every frequency alike.
        let embedded_vertical = 1.0 + (0.25 + 0.25 / q) * libm::pow(depth, 0.8);
        let vertical_softening = (0.4 + 0.2 / q) * a2 / (10.0 / (1.0 + 3.0 * (q - 1.0)) + a2);
        let vertical_stiffness = g * b / (1.0 - nu)
            * (3.1 * libm::pow(q, 0.75) + 1.6)
            * embedded_vertical
            * (1.0 - vertical_softening);
        let vertical_radiation = 4.0 * impedance * (psi * q + depth * (1.0 + q));
        let material = |stiffness: f64| 2.0 * self.damping * stiffness / omega;
        FoundationSprings {
            sway_stiffness,
            sway_damping: sway_radiation + material(sway_stiffness),
            rocking_stiffness,
            rocking_damping: rocking_radiation + material(rocking_stiffness),
            vertical_stiffness,
            vertical_damping: vertical_radiation + material(vertical_stiffness),
            frequency: a0,
        }
    }
}

impl Foundation {
    /// On the surface, with the rotary inertia of a thin plate, m·length²/12.
    #[must_use]
    pub fn rectangle(length: f64, width: f64, mass: f64) -> Self {
        Self {
            length,
            width,
            embedment: 0.0,
            mass,
            rotary_inertia: mass * length * length / 12.0,
            uplift: None,
            torsional_stiffness: None,
            torsional_damping: None,
        }
    }

    /// Longer side over shorter side \[–\].
    #[must_use]
    pub fn slenderness(&self) -> f64 {
        self.length.max(self.width) / self.length.min(self.width)
    }

    /// Embedment over half the shorter side \[–\].
    #[must_use]
    pub fn relative_depth(&self) -> f64 {
        2.0 * self.embedment / self.length.min(self.width)
    }
}

impl Model {
    /// Clear distance between the foundations of a building and the next one, negative where they overlap: the narrowest gap
    /// between the buildings, less what foundations stand out. That of a shear building, whose length is not known, does not
    /// stand out \[m\].
    ///
    /// # Errors
    /// Which dimension is missing.
    pub(crate) fn between_foundations(&self, left: usize) -> Result<f64, String> {
        let pair = [left, left + 1].map(|index| &self.buildings[index]);
        let gaps = self
            .gaps
            .iter()
            .filter(|gap| gap.between == [Some(left), Some(left + 1)] && !gap.widths.is_empty());
        let [a, b] = pair.map(|building| &building.name[..]);
        let width = gaps.map(Gap::width).reduce(f64::min).ok_or_else(|| {
            format!("the distance between the foundations of \"{a}\" and \"{b}\" is unknown: add a [[gap]] between them")
        })?;
        let mut distance = width;
        for building in pair {
            let foundation = building.base.foundation.ok_or_else(|| {
                format!(
                    "\"{}\" stands between foundations that act on each other and has none: give it one, or leave out coupling",
                    building.name
                )
            })?;
            distance -= building.overhang(&foundation);
        }
        Ok(distance)
    }
}

impl Building {
    /// How far a foundation stands out beyond either face; negative if it is shorter \[m\].
    fn overhang(&self, foundation: &Foundation) -> f64 {
        match &self.structure {
            Structure::Frame(frame) => {
                let span: f64 = frame.spans.iter().sum();
                0.5 * (foundation.length - span)
            }
            Structure::Shear(_) | Structure::Given(_) | Structure::Tiers(_) => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOIL: HalfSpace = HalfSpace {
        shear_wave_velocity: 200.0,
        density: 1800.0,
        poisson_ratio: 0.33,
        damping: 0.0,
    };

    /// A surface foundation radiates sway like a rod of soil: c = ρ V_s A, at every frequency and shape.
    #[test]
    fn sway_at_the_surface_radiates_as_a_rod_of_soil() {
        for [length, width] in [[12.0, 12.0], [16.0, 8.0], [8.0, 30.0]] {
            let foundation = Foundation::rectangle(length, width, 1e5);
            for period in [0.1, 0.6, 3.0] {
                let springs = SOIL.springs(&foundation, period);
                let rod = 1800.0 * 200.0 * length * width;
                assert!((springs.sway_damping / rod - 1.0).abs() < 1e-14);
            }
        }
    }

    /// What vanishes with the embedment does so without a jump, and sides may be exchanged for a square.
    #[test]
    fn constants_are_continuous() {
        for [length, width] in [[12.0, 12.0], [16.0, 8.0], [8.0, 16.0]] {
            let surface = Foundation::rectangle(length, width, 1e5);
            let scratched = Foundation {
                embedment: 1e-14,
                ..surface
            };
            let [a, b] = [surface, scratched].map(|foundation| SOIL.springs(&foundation, 0.5));
            assert!((a.rocking_damping / b.rocking_damping - 1.0).abs() < 1e-9);
            assert!((a.rocking_stiffness / b.rocking_stiffness - 1.0).abs() < 1e-9);
            assert!((a.sway_damping / b.sway_damping - 1.0).abs() < 1e-9);
        }
        let [a, b] = [12.0 + 1e-9, 12.0 - 1e-9]
            .map(|length| SOIL.springs(&Foundation::rectangle(length, 12.0, 1e5), 0.5));
        for (a, b) in [
            (a.sway_stiffness, b.sway_stiffness),
            (a.rocking_stiffness, b.rocking_stiffness),
            (a.rocking_damping, b.rocking_damping),
        ] {
            assert!((a / b - 1.0).abs() < 1e-4, "{a} and {b}");
        }
    }

    /// Hysteretic damping β_s of the soil gives a spring the loss 2β_s K/ω.
    #[test]
    fn soil_damping_adds_to_the_dashpots() {
        let foundation = Foundation::rectangle(12.0, 12.0, 1e5);
        let lossy = HalfSpace {
            damping: 0.05,
            ..SOIL
        };
        let [plain, lossy] = [SOIL, lossy].map(|soil| soil.springs(&foundation, 0.6));
        let added = 2.0 * 0.05 * plain.rocking_stiffness * 0.6 / TAU;
        let found = lossy.rocking_damping - plain.rocking_damping;
        assert!((found / added - 1.0).abs() < 1e-12);
    }
}
