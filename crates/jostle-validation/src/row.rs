//! One comparison of a number with what it should be.

/// A computed number and the expected one.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Where the expected number comes from: a file below `data`, or a formula.
    pub source: String,
    /// Compared quantity with its unit.
    pub quantity: String,
    /// Expected value.
    pub expected: f64,
    /// Computed value.
    pub got: f64,
    /// Difference, in the measure of the tolerance.
    pub error: f64,
    /// Admissible difference.
    pub tolerance: Tolerance,
    /// Why the row is not counted when it misses.
    pub known: Option<&'static str>,
}

/// Admissible difference of two numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tolerance {
    /// Relative to the expected number, or to the largest of its kind.
    Relative(f64),
    /// In the unit of the quantity.
    Absolute(f64),
}

impl Tolerance {
    /// The number.
    #[must_use]
    pub fn limit(self) -> f64 {
        match self {
            Self::Relative(limit) | Self::Absolute(limit) => limit,
        }
    }
}

impl Row {
    /// Whether the numbers agree. A number that is not finite never does.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.error <= self.tolerance.limit()
    }

    /// Whether the row counts against the program.
    #[must_use]
    pub fn misses(&self) -> bool {
        !self.passed() && self.known.is_none()
    }

    /// Whether the row misses for a known reason.
    #[must_use]
    pub fn is_known_gap(&self) -> bool {
        !self.passed() && self.known.is_some()
    }

    /// The same row, not counted, for a reason that is printed with it.
    #[must_use]
    pub(crate) fn known_gap(self, reason: &'static str) -> Self {
        Self {
            known: Some(reason),
            ..self
        }
    }

    /// Two numbers that should agree relative to the expected one.
    #[must_use]
    pub fn relative(
        source: &str,
        quantity: impl Into<String>,
        expected: f64,
        got: f64,
        tolerance: f64,
    ) -> Self {
        Self {
            source: source.to_owned(),
            quantity: quantity.into(),
            expected,
            got,
            error: ((got - expected) / expected).abs(),
            tolerance: Tolerance::Relative(tolerance),
            known: None,
        }
    }

    /// Two numbers that should agree to so much of their unit; counts take a tolerance of zero.
    #[must_use]
    pub fn absolute(
        source: &str,
        quantity: impl Into<String>,
        expected: f64,
        got: f64,
        tolerance: f64,
    ) -> Self {
        Self {
            source: source.to_owned(),
            quantity: quantity.into(),
            expected,
            got,
            error: (got - expected).abs(),
            tolerance: Tolerance::Absolute(tolerance),
            known: None,
        }
    }

    /// Lists that should agree, relative to the greatest magnitude expected: shows the entry farthest off.
    #[must_use]
    pub fn worst_of(
        source: &str,
        quantity: impl Into<String>,
        expected: &[f64],
        got: &[f64],
        tolerance: f64,
    ) -> Self {
        let quantity = quantity.into();
        assert_eq!(
            expected.len(),
            got.len(),
            "{quantity}: as many numbers as expected"
        );
        let scale = expected
            .iter()
            .fold(0.0, |largest: f64, e| largest.max(e.abs()));
        let mut worst = (0.0, f64::NAN, f64::NAN);
        for (e, g) in expected.iter().zip(got) {
            let error = (g - e).abs() / scale;
            // Not a number counts as the worst.
            if worst.1.is_nan() || error > worst.0 || error.is_nan() {
                worst = (error, *e, *g);
            }
        }
        Self {
            source: source.to_owned(),
            quantity,
            expected: worst.1,
            got: worst.2,
            error: worst.0,
            tolerance: Tolerance::Relative(tolerance),
            known: None,
        }
    }
}
