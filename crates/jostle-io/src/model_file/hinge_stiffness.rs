//! Stiffness of hinges before they crack, to which their ratios refer.

use jostle::hysteresis::Corners;

use crate::quantity::Dimension;
use crate::reader::{Reader, View};

/// Initial stiffness of hinges given by moments, in units of EI/L \[–\].
const DEFAULT_INITIAL: f64 = 100.0;
/// Initial stiffness of rigid hinges in units of EI/L: the member end loses 6·10⁻⁵ of its stiffness \[–\].
const RIGID_INITIAL: f64 = 1e5;

/// Stiffness of a hinge before it cracks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Initial {
    /// In units of EI/L; ratios refer to it.
    Times(f64),
    /// Practically rigid; ratios refer to the member end, 6 EI/L.
    Rigid,
}

impl Initial {
    pub(super) fn stiffness(self, rigidity: f64, length: f64) -> f64 {
        let times = match self {
            Self::Times(times) => times,
            Self::Rigid => RIGID_INITIAL,
        };
        times * rigidity / length
    }

    /// Ratios of the hinge from those of the file. With a rigid hinge they are those of hinge and member in series:
    /// a hinge of K r / (1 − r) in series with a member end of K.
    pub(super) fn ratios(self, given: Corners) -> Corners {
        let in_series = |ratio: f64| 6.0 / RIGID_INITIAL * ratio / (1.0 - ratio);
        match self {
            Self::Times(_) => given,
            Self::Rigid => Corners {
                // A bilinear curve has no second slope to turn into that of the hinge.
                post_cracking: if given.post_cracking < 1.0 {
                    in_series(given.post_cracking)
                } else {
                    given.post_cracking
                },
                post_yield: in_series(given.post_yield),
                ..given
            },
        }
    }
}

/// Reads the initial stiffness of hinges; `None` after a fault.
pub(super) fn read_initial(reader: &mut Reader<'_>, view: &View<'_>) -> Option<Initial> {
    match reader.get(view, "initial") {
        Some(field) if field.as_text() == Some("rigid") => Some(Initial::Rigid),
        Some(field) => reader
            .positive(&field, Dimension::Dimensionless)
            .map(Initial::Times),
        None if view.has("from") => Some(Initial::Rigid),
        None => Some(Initial::Times(DEFAULT_INITIAL)),
    }
}
