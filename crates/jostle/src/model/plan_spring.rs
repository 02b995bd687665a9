//! Springs of buildings in plan that yield.

use super::PlanPoint;
use crate::hysteresis::Hysteresis;

/// A direction in plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum PlanAxis {
    /// Along the row.
    X,
    /// Across the row.
    Y,
}

impl PlanAxis {
    /// Both.
    pub const BOTH: [Self; 2] = [Self::X, Self::Y];

    /// 0 for x, 1 for y.
    #[must_use]
    pub fn index(self) -> usize {
        match self {
            Self::X => 0,
            Self::Y => 1,
        }
    }

    /// `x` or `y`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
        }
    }
}

/// A spring between two floors of a building in plan, or between the lowest one and the ground, that yields along x or across.
///
/// At the plan point (x, y) it deforms by Δ(u_x − (y − o_y) θ) or Δ(u_y + (x − o_x) θ), Δ being the upper floor minus the lower one and
/// o the centre of mass of either. Springs of one element do not act on each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanSpring {
    /// The column or wall to which it belongs, counted from 0; `None` is a whole storey.
    pub element: Option<usize>,
    /// Storey, counted from 0.
    pub storey: usize,
    /// Place on the site \[m\].
    pub at: PlanPoint,
    /// Its direction.
    pub axis: PlanAxis,
    /// Its rule, in displacement \[m\] and force \[N\].
    pub hysteresis: Hysteresis,
}
