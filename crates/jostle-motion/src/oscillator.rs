//! The exact motion of an elastic oscillator for linear ground acceleration.
//!
//! With ω the circular frequency, ζ the damping ratio, u the displacement relative to the ground, the state is kept
//! as
//!
//! ```text
//! x = ω² u + a_g,    v = ω u̇                                                       (1)
//! dx/dθ = v + σ,     dv/dθ = −x − 2ζ v,    θ = ω t,  σ = ȧ_g/ω                     (2)
//! ```
//!
//! so that the pseudo-acceleration is `ω²u = x − a_g` and the total acceleration `−(x − a_g + 2ζ v)`. A stiff
//! oscillator has x → 0: nothing cancels. Over a step of length θ with σ constant,
//!
//! ```text
//! x₁ = A x₀ + B v₀ + P σ,   v₁ = −B x₀ + D v₀ + (A − 1) σ                          (3)
//! S = sin(θ√(1−ζ²))/√(1−ζ²),  C = cos(θ√(1−ζ²)),  e = exp(−ζθ)
//! A = e(C + ζS),  B = e S,  D = e(C − ζS),  P = B + 2ζ(1 − A)
//! ```
//!
//! which is the recursion of N. C. Nigam and P. C. Jennings (1969), Bull. Seismol. Soc. Am. 59, 909–922, in other
//! variables.

/// An elastic oscillator of one mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oscillator {
    /// Natural period, > 0 \[s\].
    pub period: f64,
    /// Damping ratio, 0 ≤ ζ < 1 \[–\].
    pub damping: f64,
}

impl Oscillator {
    /// Circular frequency \[rad/s\].
    #[must_use]
    pub fn circular_frequency(&self) -> f64 {
        std::f64::consts::TAU / self.period
    }
}

/// State of Eq. (1) \[m/s²\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct State {
    pub(crate) x: f64,
    pub(crate) v: f64,
}

/// The numbers of Eq. (3), `p` and `q = A − 1` as they stand before σ.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Advance {
    pub(crate) a: f64,
    pub(crate) b: f64,
    pub(crate) d: f64,
    pub(crate) p: f64,
    pub(crate) q: f64,
}

impl Advance {
    /// Over a phase θ ≥ 0 \[rad\].
    pub(crate) fn over(theta: f64, damping: f64) -> Self {
        let z = damping;
        let root = ((1.0 - z) * (1.0 + z)).sqrt();
        let (sine, cosine) = libm::sincos(theta * root);
        let s = sine / root;
        let e = libm::exp(-z * theta);
        let (a, b, d) = (e * (cosine + z * s), e * s, e * (cosine - z * s));
        // A − 1 without the loss of digits of small phases.
        let half = libm::sin(0.5 * theta * root);
        let q = libm::expm1(-z * theta) * (cosine + z * s) + (z * s - 2.0 * half * half);
        Self {
            a,
            b,
            d,
            p: b - 2.0 * z * q,
            q,
        }
    }

    pub(crate) fn apply(&self, state: State, sigma: f64) -> State {
        State {
            x: self.a * state.x + self.b * state.v + self.p * sigma,
            v: self.d * state.v - self.b * state.x + self.q * sigma,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_half_steps_make_one() {
        for z in [0.0, 0.05, 0.7] {
            for theta in [1e-4, 0.01, 0.5, 3.0] {
                let start = State { x: 0.3, v: -0.8 };
                let half = Advance::over(theta / 2.0, z);
                let twice = half.apply(half.apply(start, 0.4), 0.4);
                let once = Advance::over(theta, z).apply(start, 0.4);
                assert!((once.x - twice.x).abs() < 1e-14, "{z} {theta}");
                assert!((once.v - twice.v).abs() < 1e-14, "{z} {theta}");
            }
        }
    }

    #[test]
    fn small_steps_obey_the_equation() {
        // Second-order series of Eq. (2).
        let (theta, z, sigma) = (1e-5, 0.05, 0.7);
        let (x, v) = (0.3, -0.8);
        let next = Advance::over(theta, z).apply(State { x, v }, sigma);
        let acceleration = -x - 2.0 * z * v;
        let series_x = x + theta * (v + sigma) + theta * theta / 2.0 * acceleration;
        let series_v =
            v + theta * acceleration - theta * theta / 2.0 * (v + sigma + 2.0 * z * acceleration);
        assert!((next.x - series_x).abs() < 1e-15, "{}", next.x - series_x);
        assert!((next.v - series_v).abs() < 1e-15, "{}", next.v - series_v);
    }
}
