//! Errors in requests about ground motions.

/// Why a motion, a spectrum or a wave cannot be had.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MotionFault {
    /// A time step that is not positive.
    #[error("the time step must be positive, found {step} s")]
    Step {
        /// The step \[s\].
        step: f64,
    },
    /// Too few values.
    #[error("a motion needs at least two values, found {found}")]
    TooFew {
        /// Values found.
        found: usize,
    },
    /// A value that is not finite.
    #[error("value {index} of the motion is not a finite number")]
    NotFinite {
        /// Index from 0.
        index: usize,
    },
    /// Too many values.
    #[error(
        "{points} values are more than a motion may have ({most}); choose a larger step or a shorter duration"
    )]
    TooMany {
        /// Values asked for.
        points: usize,
        /// Values allowed.
        most: usize,
    },
    /// A motion that is zero throughout.
    #[error("the motion is zero throughout and cannot be scaled")]
    Zero,
    /// A number out of its range.
    #[error("{what} must lie {range}, found {found}")]
    Range {
        /// Which number.
        what: &'static str,
        /// Admissible range, as in `between 0 and 1`.
        range: &'static str,
        /// The number.
        found: f64,
    },
    /// Two numbers in the wrong order.
    #[error("{smaller} must be smaller than {larger}, found {found:?}")]
    Order {
        /// Name of the smaller.
        smaller: &'static str,
        /// Name of the larger.
        larger: &'static str,
        /// Both numbers.
        found: [f64; 2],
    },
    /// A spectrum without points, or with periods that do not rise.
    #[error(
        "a spectrum needs at least two points with rising periods and positive values; point {point} is not so"
    )]
    Table {
        /// Point, counted from 1.
        point: usize,
    },
    /// A table of one damping ratio asked for another.
    #[error("the spectrum is given for {given} damping and says nothing about {wanted}")]
    OtherDamping {
        /// Damping of the table \[–\].
        given: f64,
        /// Damping asked for \[–\].
        wanted: f64,
    },
    /// The matched spectrum does not come near enough.
    #[error(
        "the wave reaches the spectrum only to {misfit:.2} % (worst at {period:.3} s); ask for a longer duration, a smaller step, a narrower range of periods, or a peak acceleration nearer to that of the spectrum"
    )]
    NoMatch {
        /// Largest relative difference \[%\].
        misfit: f64,
        /// Where it is \[s\].
        period: f64,
    },
}

/// Refuses a number outside a range.
pub(crate) fn within(
    what: &'static str,
    range: &'static str,
    found: f64,
    good: bool,
) -> Result<(), MotionFault> {
    if good && found.is_finite() {
        Ok(())
    } else {
        Err(MotionFault::Range { what, range, found })
    }
}
