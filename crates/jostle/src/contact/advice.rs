//! Estimates of contact stiffness from slabs and masses, to choose the values of a gap.

use std::f64::consts::PI;

use super::{LawKind, effective_mass};

/// A floor that can be hit, as an elastic rod of uniform section in the direction of the impact.
///
/// All values > 0, except Poisson's ratio 0 ≤ ν < 0.5.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slab {
    /// Length in the direction of the impact \[m\].
    pub length: f64,
    /// Width across it \[m\].
    pub width: f64,
    /// Thickness \[m\].
    pub thickness: f64,
    /// Material.
    pub material: SlabMaterial,
    /// Mass of the floor, that of walls, columns and loads included \[kg\].
    pub mass: f64,
}

/// Material of colliding floors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlabMaterial {
    /// Modulus of elasticity E, > 0 \[Pa\].
    pub modulus: f64,
    /// Poisson's ratio ν, 0 ≤ ν < 0.5 \[–\].
    pub poisson_ratio: f64,
    /// Density ρ, > 0 \[kg/m³\].
    pub density: f64,
}

impl Default for SlabMaterial {
    /// Concrete: 30 GPa, 0.2, 2500 kg/m³.
    fn default() -> Self {
        Self {
            modulus: 30e9,
            poisson_ratio: 0.2,
            density: 2500.0,
        }
    }
}

impl Slab {
    /// Axial stiffness E A/L \[N/m\].
    #[must_use]
    pub fn axial_stiffness(&self) -> f64 {
        self.material.modulus * self.width * self.thickness / self.length
    }

    /// Mass of the slab alone, ρ A L \[kg\].
    #[must_use]
    pub fn own_mass(&self) -> f64 {
        self.material.density * self.width * self.thickness * self.length
    }

    /// The floor as a rod: its whole mass spread evenly over the length.
    #[must_use]
    pub fn rod(&self) -> Rod {
        Rod::new(self.axial_stiffness(), self.mass)
    }
}

/// Radius of the sphere that has a mass, R = (3 m/4πρ)^⅓: the effective radius that Hertz's law takes for a floor \[m\].
///
/// Goldsmith (1960); S. Muthukumar, R. DesRoches (2006), Earthquake Engng Struct. Dyn. 35, 811–828. `mass` > 0 \[kg\];
/// `density` > 0 \[kg/m³\].
#[must_use]
pub fn effective_radius(mass: f64, density: f64) -> f64 {
    libm::cbrt(3.0 * mass / (4.0 * PI * density))
}

/// Stiffness of Hertz's law between two spheres of the masses of two floors \[N/m^1.5\]:
///
/// ```text
/// k = 4/[3π (h₁ + h₂)] √[R₁R₂/(R₁ + R₂)],   h = (1 − ν²)/(πE)                                             (CA1)
/// ```
///
/// Goldsmith (1960); Muthukumar and DesRoches (2006). `masses` > 0 \[kg\].
#[must_use]
pub fn hertz_stiffness(materials: [SlabMaterial; 2], masses: [f64; 2]) -> f64 {
    let [a, b] = materials;
    let [r1, r2] = [
        effective_radius(masses[0], a.density),
        effective_radius(masses[1], b.density),
    ];
    let compliance = |m: SlabMaterial| (1.0 - m.poisson_ratio * m.poisson_ratio) / (PI * m.modulus);
    4.0 / (3.0 * PI * (compliance(a) + compliance(b))) * (r1 * r2 / (r1 + r2)).sqrt()
}

/// An elastic rod that moves along its axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rod {
    /// Time in which a wave runs along it, L/c = √(m L/E A) \[s\].
    pub transit: f64,
    /// Force per particle velocity of a wave, Z = √(E A m/L) = ρ c A \[kg/s\].
    pub impedance: f64,
}

impl Rod {
    /// From the axial stiffness E A/L > 0 \[N/m\] and the mass > 0 \[kg\].
    #[must_use]
    pub fn new(axial_stiffness: f64, mass: f64) -> Self {
        Self {
            transit: (mass / axial_stiffness).sqrt(),
            impedance: (mass * axial_stiffness).sqrt(),
        }
    }

    /// Mass, Z L/c \[kg\].
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.impedance * self.transit
    }
}

/// Collision of two rods by the one-dimensional wave equation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RodCollision {
    /// Greatest contact force \[N\].
    pub peak_force: f64,
    /// Time in contact \[s\].
    pub duration: f64,
    /// Impulse \[N·s\].
    pub impulse: f64,
    /// Separation speed of the centres of mass over the impact speed: below 1, because waves keep energy in the rods
    /// although nothing is lost \[–\].
    pub restitution: f64,
}

/// Longest ratio of the transit times of two rods, beyond which [`rod_collision`] gives no result.
const MOST_TRANSITS: f64 = 1000.0;

/// Two free rods that meet end to end at `speed` > 0 \[m/s\]; `None` if their transit times differ by more than a
/// thousand times.
///
/// The waves of both rods are followed exactly: force and velocity at the contact are constant between the arrivals of
/// waves that the free ends send back. Until the first arrival F = v/(1/Z₁ + 1/Z₂). Contact ends when the force would
/// become tension. Two equal rods exchange their velocities: F = Z v/2 for a time of 2 L/c.
///
/// W. Goldsmith (1960), Impact, chapter III; floors as rods with the mass of the floor spread over the length: G. Cole,
/// R. Dhakal, A. Carr, D. Bull (2011), Earthquake Engng Struct. Dyn. 40, 641–659.
#[must_use]
pub fn rod_collision(rods: [Rod; 2], speed: f64) -> Option<RodCollision> {
    let there_and_back = rods.map(|rod| 2.0 * rod.transit);
    let ratio = there_and_back[0] / there_and_back[1];
    if !(1.0 / MOST_TRANSITS..=MOST_TRANSITS).contains(&ratio) {
        return None;
    }
    let [z1, z2] = rods.map(|rod| rod.impedance);
    let together = z1 * z2 / (z1 + z2);
    // A force wave that leaves the contact comes back from the free end with the opposite sign.
    let mut sent: Vec<[f64; 3]> = Vec::new();
    let (mut time, mut impulse, mut peak_force) = (0.0, 0.0, 0.0_f64);
    // Rounding must neither skip nor repeat an arrival.
    let least = 1e-9 * there_and_back[0].min(there_and_back[1]);
    loop {
        let arriving = [0, 1].map(|rod| {
            let at = time - there_and_back[rod];
            let wave = sent.iter().rev().find(|wave| wave[0] <= at + least);
            wave.map_or(0.0, |wave| -wave[1 + rod])
        });
        let force = together * (speed + 2.0 * arriving[0] / z1 + 2.0 * arriving[1] / z2);
        if force <= 1e-9 * together * speed {
            break;
        }
        peak_force = peak_force.max(force);
        sent.push([time, force - arriving[0], force - arriving[1]]);
        // The next instant at which a change that was sent comes back.
        let next = sent
            .iter()
            .flat_map(|wave| there_and_back.map(|delay| wave[0] + delay))
            .filter(|arrival| *arrival > time + least)
            .fold(f64::INFINITY, f64::min);
        if !next.is_finite() {
            return None;
        }
        impulse += force * (next - time);
        time = next;
    }
    let effective = effective_mass(rods[0].mass(), rods[1].mass());
    Some(RodCollision {
        peak_force,
        duration: time,
        impulse,
        restitution: impulse / (effective * speed) - 1.0,
    })
}

/// Stiffness of the linear spring between two masses that gives the duration of a collision, k = π² m/T² with the
/// effective mass m \[N/m\].
#[must_use]
pub fn spring_of_duration(effective_mass: f64, duration: f64) -> f64 {
    PI * PI * effective_mass / (duration * duration)
}

/// Stiffness of the linear spring that gives the peak force of a collision, k = F²/(m v²) \[N/m\].
#[must_use]
pub fn spring_of_force(effective_mass: f64, speed: f64, peak_force: f64) -> f64 {
    (peak_force / speed).powi(2) / effective_mass
}

/// Stiffness of Hertz's law without damping that gives the peak force of a collision, from
/// F = k^0.4 (5 m v²/4)^0.6 \[N/m^1.5\].
#[must_use]
pub fn hertz_of_force(effective_mass: f64, speed: f64, peak_force: f64) -> f64 {
    let energy = 1.25 * effective_mass * speed * speed;
    libm::pow(peak_force, 2.5) / libm::pow(energy, 1.5)
}

/// Peak force of a collision by Hertz's law without damping, F = k^0.4 (5 m v²/4)^0.6 \[N\].
#[must_use]
pub fn hertz_peak_force(stiffness: f64, effective_mass: f64, speed: f64) -> f64 {
    let energy = 1.25 * effective_mass * speed * speed;
    libm::pow(stiffness, 0.4) * libm::pow(energy, 0.6)
}

/// Stiffness of the Hertz laws that studies use if they state nothing (Muthukumar and DesRoches 2006) \[N/m^1.5\].
pub const USUAL_HERTZ: f64 = 2e9;
/// That fitted by Jankowski (2005) to a test of concrete elements \[N/m^1.5\].
pub const JANKOWSKI_HERTZ: f64 = 2.75e9;
/// Stiffness of linear contact over the lateral stiffness of the stiffer neighbour in many studies: the least and the
/// greatest of a habit, which no test of floors supports \[–\].
pub const LATERAL_FACTORS: [f64; 2] = [10.0, 100.0];
/// Impact speed at which linear and Hertz laws are compared \[m/s\].
const COMPARED_SPEED: f64 = 0.4;
/// Thickness of a usual slab \[m\].
const USUAL_THICKNESS: f64 = 0.15;

/// A stiffness and the range in which it may lie \[N/m^1.5 or N/m\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StiffnessRange {
    /// Recommended value.
    pub value: f64,
    /// Lowest plausible value.
    pub low: f64,
    /// Highest plausible value.
    pub high: f64,
}

/// Range of the contact stiffness between bare floors of two masses \[kg\], one of which may be infinite, if the size of the slabs is
/// not known; `None` for laws of bumpers and of velocities.
///
/// Hertz laws: from what studies use to the stiffness of spheres with these masses ([`hertz_stiffness`]), which is recommended.
/// Linear laws: from those with the same peak force at 0.4 m/s to the axial stiffness E t of a square slab of 150 mm.
#[must_use]
pub fn advised_range(
    kind: LawKind,
    materials: [SlabMaterial; 2],
    masses: [f64; 2],
) -> Option<StiffnessRange> {
    // A wall is as stiff as the floor, and far heavier.
    let heavy = 1e9
        * masses
            .into_iter()
            .filter(|m| m.is_finite())
            .fold(1.0, f64::max);
    let masses = masses.map(|mass| mass.min(heavy));
    let spheres = hertz_stiffness(materials, masses);
    let [low, high] = [USUAL_HERTZ.min(spheres), JANKOWSKI_HERTZ.max(spheres)];
    let effective = effective_mass(masses[0], masses[1]);
    let linear = |hertz: f64| {
        let force = hertz_peak_force(hertz, effective, COMPARED_SPEED);
        spring_of_force(effective, COMPARED_SPEED, force)
    };
    let range = |value, low, high| Some(StiffnessRange { value, low, high });
    match kind {
        LawKind::Rubber(_) | LawKind::Restitution | LawKind::Formula(_) => None,
        kind if kind.is_hertzian() => range(spheres, low, high),
        _ => {
            let slab = USUAL_THICKNESS * materials[0].modulus.min(materials[1].modulus);
            range(linear(spheres), linear(low), linear(high).max(slab))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: f64, due: f64, tolerance: f64, what: &str) {
        assert!(
            (found / due - 1.0).abs() < tolerance,
            "{what}: {found} instead of {due}"
        );
    }

    /// Hertz for two equal spheres of radius R: k = (4/3) E/(2 (1 − ν²)) √(R/2). A steel ball of 1 kg on a steel wall is
    /// the limit of a very heavy second sphere: k = (4/3) E/(2 (1 − ν²)) √R.
    #[test]
    fn hertz_stiffness_is_that_of_spheres() {
        let steel = SlabMaterial {
            modulus: 210e9,
            poisson_ratio: 0.3,
            density: 7850.0,
        };
        let radius = (3.0 / (4.0 * PI * 7850.0)).cbrt();
        assert!((radius - 0.031_21).abs() < 1e-5, "{radius}");
        let half_plane = 210e9 / (2.0 * (1.0 - 0.09));
        let due = 4.0 / 3.0 * half_plane * (radius / 2.0).sqrt();
        near(hertz_stiffness([steel; 2], [1.0, 1.0]), due, 1e-12, "equal");
        let due = 4.0 / 3.0 * half_plane * radius.sqrt();
        near(hertz_stiffness([steel; 2], [1.0, 1e30]), due, 1e-9, "wall");
    }

    fn slab(length: f64, width: f64) -> Slab {
        let mut slab = Slab {
            length,
            width,
            thickness: 0.15,
            material: SlabMaterial::default(),
            mass: 1.0,
        };
        slab.mass = slab.own_mass();
        slab
    }

    /// Two equal rods: c = √(E/ρ) = 3464.1 m/s, T = 2 L/c, F = ρ c A v/2, velocities exchanged.
    #[test]
    fn equal_rods_exchange_their_velocities() {
        let slab = slab(12.0, 10.0);
        let (c, area) = ((30e9_f64 / 2500.0).sqrt(), 1.5);
        let found = rod_collision([slab.rod(); 2], 0.4).expect("comparable");
        near(found.duration, 24.0 / c, 1e-12, "duration");
        near(found.peak_force, 2500.0 * c * area * 0.2, 1e-12, "force");
        near(found.impulse, slab.mass * 0.4, 1e-12, "impulse");
        near(found.restitution, 1.0, 1e-12, "restitution");
        // The springs that give its duration and its force: π²/8 and 1/2 of E A/L.
        let (m, k) = (0.5 * slab.mass, slab.axial_stiffness());
        let of_duration = spring_of_duration(m, found.duration);
        near(of_duration, PI * PI / 8.0 * k, 1e-12, "spring of duration");
        let of_force = spring_of_force(m, 0.4, found.peak_force);
        near(of_force, 0.5 * k, 1e-12, "spring of force");
    }

    /// Rods of one section and different lengths: the shorter is at rest after 2 L₁/c, and the coefficient of
    /// restitution is the ratio of the lengths (Goldsmith 1960).
    #[test]
    fn unequal_lengths_keep_energy_in_waves() {
        for length in [13.0, 17.3, 40.0] {
            let [short, long] = [slab(10.0, 8.0), slab(length, 8.0)];
            for rods in [[short.rod(), long.rod()], [long.rod(), short.rod()]] {
                let found = rod_collision(rods, 0.7).expect("comparable");
                near(found.duration, 2.0 * short.rod().transit, 1e-9, "duration");
                near(found.restitution, 10.0 / length, 1e-9, "restitution");
            }
        }
    }

    /// A rod against one that is hardly stressed: F = ρ c A v for 2 L/c, as against a rigid wall, and it rebounds as fast.
    #[test]
    fn a_rod_rebounds_from_a_wall() {
        let rod = slab(10.0, 8.0).rod();
        let wall = Rod {
            transit: 100.0 * rod.transit,
            impedance: 1e9 * rod.impedance,
        };
        let found = rod_collision([rod, wall], 0.5).expect("comparable");
        near(found.peak_force, rod.impedance * 0.5, 1e-8, "force");
        near(found.duration, 2.0 * rod.transit, 1e-9, "duration");
        near(found.restitution, 1.0, 1e-6, "restitution");
    }

    /// A short wide rod hits a long slender one, Z₁ = 3 Z₂: after each 2 L₁/c its force falls by (Z₁ − Z₂)/(Z₁ + Z₂) = ½,
    /// until the wave of the longer one returns, here after 3.5 such times (Saint-Venant's stepped force).
    #[test]
    fn the_force_of_a_wide_rod_falls_in_steps() {
        let narrow = Rod {
            transit: 3.5,
            impedance: 1.0,
        };
        let wide = Rod {
            transit: 1.0,
            impedance: 3.0,
        };
        let found = rod_collision([wide, narrow], 1.0).expect("comparable");
        near(found.peak_force, 0.75, 1e-12, "first step");
        // 0.75, 0.375, 0.1875 for 2 s each, 0.09375 for 1 s; then tension.
        near(found.duration, 7.0, 1e-12, "duration");
        let impulse = 2.0 * (0.75 + 0.375 + 0.187_5) + 0.093_75;
        near(found.impulse, impulse, 1e-12, "impulse");
    }

    /// Mean force over the contact moves the centres of mass: momentum and energy hold for many pairs.
    #[test]
    fn no_pair_of_rods_gains_energy() {
        for transit in [0.03, 0.2, 0.71, 1.0, 1.9, 7.7, 90.0] {
            for impedance in [0.01, 0.3, 1.0, 4.0, 100.0] {
                let one = Rod {
                    transit: 1.0,
                    impedance: 1.0,
                };
                let other = Rod { transit, impedance };
                let found = rod_collision([one, other], 1.0).expect("comparable");
                assert!(
                    found.restitution <= 1.0 + 1e-9 && found.restitution > -1.0,
                    "{transit} {impedance}: {found:?}"
                );
                let back = rod_collision([other, one], 1.0).expect("comparable");
                assert!((back.impulse / found.impulse - 1.0).abs() < 1e-9);
            }
        }
        let point = Rod {
            transit: 1e-4,
            impedance: 1.0,
        };
        let long = Rod {
            transit: 1.0,
            impedance: 1.0,
        };
        assert_eq!(rod_collision([point, long], 1.0), None);
    }

    /// The spring of Hertz with the force of another collision gives that force again.
    #[test]
    fn equivalent_hertz_stiffness_gives_the_force() {
        let force = hertz_peak_force(2e9, 24e3, 0.4);
        // `jostle collide` integrates 849.5 kN.
        near(force, 849.5e3, 1e-4, "peak force");
        near(hertz_of_force(24e3, 0.4, force), 2e9, 1e-12, "stiffness");
    }
}
