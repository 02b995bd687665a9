//! Time integration rules.

/// Newmark's family, with the shifted equilibrium of the generalised-α method.
///
/// Newmark's (¼, ½) is the default: unconditionally stable, of second order and free of numerical damping. What
/// dissipates, be it γ > ½, HHT or generalised-α, also takes from the energy with which buildings rebound: near
/// contact the restitution comes out too small, by the order of one part in the number of steps per impact. The
/// energy balance holds for (¼, ½) only.
///
/// N. M. Newmark (1959), J. Eng. Mech. Div. ASCE 85, 67–94; H. M. Hilber, T. J. R. Hughes, R. L. Taylor (1977),
/// Earthq. Eng. Struct. Dyn. 5, 283–292; J. Chung, G. M. Hulbert (1993), J. Appl. Mech. 60, 371–375.
///
/// ```
/// use jostle::Integrator;
///
/// assert_eq!(Integrator::default(), Integrator::newmark(0.25, 0.5));
/// assert_eq!(Integrator::hht(0.05).to_string(), "HHT, α = 0.0500");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integrator {
    /// β > 0 \[–\].
    pub beta: f64,
    /// γ ≥ ½ \[–\].
    pub gamma: f64,
    /// α_m < ½: how far before the end of the step inertia is taken \[–\].
    pub alpha_m: f64,
    /// 0 ≤ α_f ≤ ½: how far before the end of the step all other forces are taken \[–\].
    pub alpha_f: f64,
}

impl std::fmt::Display for Integrator {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            beta,
            gamma,
            alpha_m,
            alpha_f,
        } = *self;
        let is = |other: Self| {
            let pairs = [
                (beta, other.beta),
                (gamma, other.gamma),
                (alpha_m, other.alpha_m),
            ];
            pairs.iter().all(|(a, b)| (a - b).abs() < 1e-9)
        };
        if *self == Self::default() {
            formatter.write_str("average acceleration (Newmark, β = 1/4, γ = 1/2)")
        } else if self.balances_at_ends() {
            write!(formatter, "Newmark, β = {beta:.4}, γ = {gamma:.4}")
        } else if is(Self::hht(alpha_f)) {
            write!(formatter, "HHT, α = {alpha_f:.4}")
        } else {
            write!(
                formatter,
                "generalised-α, α_m = {alpha_m:.4}, α_f = {alpha_f:.4}, β = {beta:.4}, γ = {gamma:.4}"
            )
        }
    }
}

impl Default for Integrator {
    fn default() -> Self {
        Self::newmark(0.25, 0.5)
    }
}

impl Integrator {
    /// Newmark's method with β > 0 and γ ≥ ½.
    #[must_use]
    pub const fn newmark(beta: f64, gamma: f64) -> Self {
        Self {
            beta,
            gamma,
            alpha_m: 0.0,
            alpha_f: 0.0,
        }
    }

    /// Hilber, Hughes and Taylor's method, 0 ≤ α ≤ ⅓ (their own α is −α): γ = ½ + α, β = (1 + α)²/4.
    #[must_use]
    pub fn hht(alpha: f64) -> Self {
        Self {
            beta: 0.25 * (1.0 + alpha) * (1.0 + alpha),
            gamma: 0.5 + alpha,
            alpha_m: 0.0,
            alpha_f: alpha,
        }
    }

    /// Chung and Hulbert's generalised-α method by its spectral radius at high frequencies, 0 ≤ ρ ≤ 1; 1 keeps all
    /// energy, 0 removes in one step what the step cannot resolve.
    #[must_use]
    pub fn generalized_alpha(spectral_radius: f64) -> Self {
        let rho = spectral_radius;
        let (alpha_m, alpha_f) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
        let offset = alpha_m - alpha_f;
        Self {
            beta: 0.25 * (1.0 - offset) * (1.0 - offset),
            gamma: 0.5 - offset,
            alpha_m,
            alpha_f,
        }
    }

    /// Whether the integrator itself takes energy from the motion.
    #[must_use]
    pub fn dissipates(&self) -> bool {
        self.gamma > 0.5 + 1e-12
    }

    /// Whether forces balance at the end of every step, rather than some way before it.
    pub(crate) fn balances_at_ends(&self) -> bool {
        self.alpha_m == 0.0 && self.alpha_f == 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_members_of_the_family() {
        let trapezoidal = Integrator::generalized_alpha(1.0);
        assert!((trapezoidal.gamma - 0.5).abs() < 1e-15 && (trapezoidal.beta - 0.25).abs() < 1e-15);
        assert_eq!(Integrator::hht(0.0), Integrator::default());
        // Chung & Hulbert 1993: ρ = 0 is α_m = −1, α_f = 0, γ = 3/2, β = 1.
        let annihilating = Integrator::generalized_alpha(0.0);
        assert_eq!(
            (
                annihilating.alpha_m,
                annihilating.alpha_f,
                annihilating.gamma,
                annihilating.beta
            ),
            (-1.0, 0.0, 1.5, 1.0)
        );
    }
    #[test]
    fn every_member_says_its_name() {
        let names = [
            (
                Integrator::default(),
                "average acceleration (Newmark, β = 1/4, γ = 1/2)",
            ),
            (
                Integrator::newmark(0.3025, 0.6),
                "Newmark, β = 0.3025, γ = 0.6000",
            ),
            (Integrator::hht(0.1), "HHT, α = 0.1000"),
            (
                Integrator::generalized_alpha(0.8),
                "generalised-α, α_m = 0.3333, α_f = 0.4444, β = 0.3086, γ = 0.6111",
            ),
        ];
        for (integrator, name) in names {
            assert_eq!(integrator.to_string(), name);
        }
    }
}
