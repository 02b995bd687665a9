//! Storeys from a class: Lu and Guan's formulas for buildings of equal storeys.

use std::f64::consts::PI;

use jostle_batch::{Building, Rule, Storey};

/// Standard gravity of the formulas \[m/s²\].
const GRAVITY: f64 = 9.8;

/// Least ratio of the accelerations at the end and at yield of a capacity curve \[–\].
const LEAST_OVERSTRENGTH: f64 = 1.0 + 1e-6;

/// Stiffness of a storey beyond its second corner over the initial one \[–\].
const THIRD_RATIO: f64 = 0.001;

/// The four numbers of a HAZUS capacity curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capacity {
    /// Spectral displacement at yield Dy \[m\].
    pub yield_displacement: f64,
    /// Spectral acceleration at yield Ay, in g \[–\].
    pub yield_acceleration: f64,
    /// Ultimate spectral displacement Du \[m\].
    pub ultimate_displacement: f64,
    /// Ultimate spectral acceleration Au, in g \[–\].
    pub ultimate_acceleration: f64,
}

/// What Lu and Guan's formulas need of a class.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients {
    /// First period per storey \[s\].
    pub period_per_storey: f64,
    /// Strength of the base over the weight, before the share of the first mode \[–\].
    pub strength: f64,
    /// Hardening: stiffness beyond the first corner over the initial one, 0…1 \[–\].
    pub hardening: f64,
    /// Force at the second corner over that at the first, ≥ 1 \[–\].
    pub overstrength: f64,
    /// Pinching, 0…1, 1 for none \[–\].
    pub pinching: f64,
    /// Exponent of the unloading stiffness, 0…1 \[–\].
    pub unloading_exponent: f64,
    /// Damping ratio of modes 1 and 3 \[–\].
    pub damping: f64,
}

impl Capacity {
    /// Coefficients of a class whose typical building has `typical_storeys`. Pinching, unloading and damping are not
    /// part of a capacity curve.
    #[must_use]
    pub fn coefficients(
        &self,
        typical_storeys: f64,
        pinching: f64,
        unloading_exponent: f64,
        damping: f64,
    ) -> Coefficients {
        let [dy, ay] = [self.yield_displacement, self.yield_acceleration];
        // A curve that does not harden keeps a trace of it, so that its second corner stays at its end.
        let au = self.ultimate_acceleration.max(ay * LEAST_OVERSTRENGTH);
        let du = self.ultimate_displacement;
        Coefficients {
            period_per_storey: 2.0 * PI * (dy / (ay * 9.81)).sqrt() / typical_storeys,
            strength: ay,
            hardening: (au - ay) / (du - dy) * dy / ay,
            overstrength: au / ay,
            pinching,
            unloading_exponent,
            damping,
        }
    }
}

impl Coefficients {
    /// A building of `storeys` (1–16), mass of a floor \[kg\] and height of a storey \[m\].
    #[must_use]
    pub fn building(&self, storeys: usize, mass: f64, height: f64) -> Building {
        let n = storeys as f64;
        let period = n * self.period_per_storey;
        // λ of the first mode of a chain, so that it has the period.
        let lambda = 0.4053 * n * n + 0.405 * n + 0.1869;
        let stiffness = 4.0 * PI * PI * lambda * mass / (period * period);
        let first_mode = if storeys == 1 {
            1.0
        } else {
            0.09117 / n.powi(3) - 0.3037 / (n * n) + 0.402 / n + 0.8106
        };
        let storey = |below: usize| {
            let below = below as f64;
            let share = 1.0 - below * (below + 1.0) / (n * (n + 1.0));
            let force = self.strength * first_mode * mass * GRAVITY * n * share;
            let first_corner = force / stiffness;
            Storey {
                mass,
                stiffness,
                height,
                first_corner,
                second_corner: first_corner * (1.0 + (self.overstrength - 1.0) / self.hardening),
                second_ratio: self.hardening,
                third_ratio: THIRD_RATIO.min(self.hardening),
            }
        };
        let (alpha, beta) = rayleigh(self.damping, stiffness / mass, storeys);
        Building {
            storeys: (0..storeys).map(storey).collect(),
            rule: Rule::Pinched {
                deformation: self.pinching,
                force: self.pinching,
                unloading_exponent: self.unloading_exponent,
            },
            alpha,
            beta,
        }
    }
}

/// α and β for a ratio in modes 1 and 3 (or the last) of a chain of equal storeys, from k/m \[1/s²\].
fn rayleigh(ratio: f64, k_over_m: f64, storeys: usize) -> (f64, f64) {
    let mode = |i: usize| {
        let angle = (2 * i - 1) as f64 * PI / (2.0 * (2 * storeys + 1) as f64);
        2.0 * k_over_m.sqrt() * libm::sin(angle)
    };
    let (low, high) = (mode(1), mode(storeys.min(3)));
    (
        2.0 * ratio * low * high / (low + high),
        2.0 * ratio / (low + high),
    )
}
