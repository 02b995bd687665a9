//! From the slenderness of a strut to the share of its yield force at which it buckles.

/// A curve of buckling forces over slenderness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BucklingCurve {
    /// EN 1993-1-1, 6.3.1.2, by its imperfection factor α \[–\].
    En1993(f64),
    /// AISC 360, E3.
    Aisc360,
}

/// Curves by their names in model files; imperfection factors of EN 1993-1-1, table 6.1.
const CURVES: [(&str, BucklingCurve); 6] = [
    ("a0", BucklingCurve::En1993(0.13)),
    ("a", BucklingCurve::En1993(0.21)),
    ("b", BucklingCurve::En1993(0.34)),
    ("c", BucklingCurve::En1993(0.49)),
    ("d", BucklingCurve::En1993(0.76)),
    ("aisc360", BucklingCurve::Aisc360),
];

impl BucklingCurve {
    /// Names in model files.
    pub const NAMES: [&str; 6] = [
        CURVES[0].0,
        CURVES[1].0,
        CURVES[2].0,
        CURVES[3].0,
        CURVES[4].0,
        CURVES[5].0,
    ];

    /// The curve of a name; `None` if it is not known.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let mut curves = CURVES.iter();
        curves
            .find(|(known, _)| *known == name)
            .map(|(_, curve)| *curve)
    }

    /// Buckling force over yield force for a slenderness λ = √(Ny/NE), NE being Euler's force, > 0 \[–\]. Without partial factors.
    #[must_use]
    pub fn share(self, slenderness: f64) -> f64 {
        let squared = slenderness * slenderness;
        match self {
            Self::En1993(imperfection) => {
                let half = 0.5 * (1.0 + imperfection * (slenderness - 0.2) + squared);
                (1.0 / (half + (half * half - squared).max(0.0).sqrt())).min(1.0)
            }
            Self::Aisc360 if squared <= 2.25 => libm::pow(0.658, squared),
            Self::Aisc360 => 0.877 / squared,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// χ solves the equation of Ayrton and Perry that the curves are derived from, (1 − χ)(1 − χ λ²) = α (λ − 0.2) χ; no column bears more
    /// than Euler's force.
    #[test]
    fn curves_solve_the_equation_of_perry() {
        for (name, curve) in CURVES {
            assert_eq!(BucklingCurve::named(name), Some(curve));
            let mut last = 1.0;
            for step in 0..60 {
                let slenderness = 0.05 + 0.05 * f64::from(step);
                let share = curve.share(slenderness);
                let squared = slenderness * slenderness;
                assert!(
                    share <= last && share * squared < 1.0,
                    "{name} {slenderness}"
                );
                last = share;
                if let BucklingCurve::En1993(imperfection) = curve
                    && slenderness > 0.2
                {
                    let perry = (1.0 - share) * (1.0 - share * squared);
                    let due = imperfection * (slenderness - 0.2) * share;
                    assert!((perry - due).abs() < 1e-12, "{name} {slenderness}: {share}");
                }
            }
        }
        // Both branches of AISC 360 meet within the rounding of their factors.
        let [below, above] =
            [1.5, 1.500_000_1].map(|slenderness| BucklingCurve::Aisc360.share(slenderness));
        assert!((below / above - 1.0).abs() < 2e-3, "{below} {above}");
        assert_eq!(BucklingCurve::named("e"), None);
    }
}
