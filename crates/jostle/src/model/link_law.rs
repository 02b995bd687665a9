//! How the force of a link follows from its change of length.

use crate::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule, Side};

/// Law of a link; Δ is its shortening since rest, a force in compression is positive.
///
/// [`Link::stiffness`](super::Link::stiffness) and [`Link::damping`](super::Link::damping) are parameters of every law that
/// names them here.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum LinkLaw {
    /// Spring `stiffness` and dashpot `damping` side by side.
    #[default]
    Linear,
    /// F = c |v|^α sgn v with c = `damping` \[N·(s/m)^α\]; with a `stiffness` above zero, spring and dashpot stand in
    /// series and v is the rate of the dashpot (Constantinou and Symans, 1992, NCEER-92-0032).
    Viscous {
        /// α, 0.1…2 \[–\].
        exponent: f64,
    },
    /// Spring `stiffness` and linear dashpot `damping` in series, both > 0 (Maxwell, 1867).
    Maxwell,
    /// Slider: elastic until the force reaches ±`slip_force`.
    Friction {
        /// Force at which it slips, > 0 \[N\].
        slip_force: f64,
        /// Stiffness while it sticks, > 0 \[N/m\].
        stick_stiffness: f64,
    },
    /// Any hysteresis rule; its positive side is compression.
    Yielding(Hysteresis),
    /// F = −k ⟨−Δ − slack⟩ with k = `stiffness`: tension only, once its ends are apart by more than the slack.
    Cable {
        /// Lengthening at which it becomes taut, ≥ 0 \[m\].
        slack: f64,
    },
    /// F = ⟨k (Δ − gap) + c Δ̇⟩ while Δ > gap, with k = `stiffness` and c = `damping`: compression only.
    Stopper {
        /// Shortening at which it is touched, ≥ 0 \[m\].
        gap: f64,
    },
}

/// Least clearance of a cable or a stopper in a static analysis \[m\].
const LEAST_CLEARANCE: f64 = 1e-15;

impl LinkLaw {
    /// Names of all laws in model files, in the order of the documentation.
    pub const NAMES: [&str; 7] = [
        "linear", "viscous", "maxwell", "friction", "yielding", "cable", "stopper",
    ];

    /// Name in model files.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Viscous { .. } => "viscous",
            Self::Maxwell => "maxwell",
            Self::Friction { .. } => "friction",
            Self::Yielding(_) => "yielding",
            Self::Cable { .. } => "cable",
            Self::Stopper { .. } => "stopper",
        }
    }

    /// What resists a slow change of length beside a spring of this stiffness \[N/m\], compression being positive; `None` of
    /// dashpots, and of springs without stiffness.
    #[must_use]
    pub fn slow_spring(&self, stiffness: f64) -> Option<Hysteresis> {
        // A clearance far below the size of an atom stands for none.
        let stop = |clearance: f64, side| {
            Hysteresis::stop(stiffness, clearance.max(LEAST_CLEARANCE), side).ok()
        };
        match *self {
            Self::Linear => Hysteresis::elastic(stiffness).ok(),
            Self::Friction {
                slip_force,
                stick_stiffness,
            } => {
                let corners = Corners::bilinear(slip_force, 0.0);
                let backbone = Backbone::from_forces(stick_stiffness, corners, corners).ok()?;
                Hysteresis::new(HysteresisRule::Bilinear, backbone).ok()
            }
            Self::Yielding(hysteresis) => Some(hysteresis),
            Self::Cable { slack } => stop(slack, Side::Negative),
            Self::Stopper { gap } => stop(gap, Side::Positive),
            Self::Viscous { .. } | Self::Maxwell => None,
        }
    }

    /// Whether its energy beside the recoverable one is hysteretic, rather than viscous.
    #[must_use]
    pub const fn is_hysteretic(&self) -> bool {
        match self {
            Self::Friction { .. } | Self::Yielding(_) => true,
            Self::Linear
            | Self::Viscous { .. }
            | Self::Maxwell
            | Self::Cable { .. }
            | Self::Stopper { .. } => false,
        }
    }
}
