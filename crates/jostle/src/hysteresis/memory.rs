//! State and response of a spring.

use super::backbone::{Corner, Side};

/// State of a spring between steps; the default is at rest and never loaded.
///
/// It stores the starts of straight lines, not the last increment. A path in one direction therefore gives the same
/// bits for any division into steps, and reversals that reach no corner do not change later behaviour.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct HysteresisMemory {
    pub(super) deformation: f64,
    pub(super) force: f64,
    /// Greatest deformation so far of either side, as magnitudes.
    pub(super) extremes: [f64; 2],
    /// Deformation of either side at which the backbone is reached again, as magnitudes; 0 before cracking. Of a brace: 1 once it was
    /// straightened, and its greatest kink.
    pub(super) peaks: [f64; 2],
    /// Deformation at which each slider of the parallel model has no force; how far each stage in series has slid.
    /// Of a brace: plastic elongation, kink by its place on the polygon, and the plastic elongation where its chord starts.
    pub(super) offsets: [f64; 3],
    /// Start of the last unloading.
    pub(super) turn: Corner,
    /// Start of the line towards a peak.
    pub(super) start: Corner,
    /// Point at which a pinched spring stiffens on its way to a peak.
    pub(super) knee: Corner,
    /// Start of the present line of a pinched spring, and the work done until there.
    pub(super) line: Corner,
    pub(super) worked: f64,
    /// Strength of a spring that fails, once lowered, or of a brace in tension, once hardened; 0 before \[N\].
    pub(super) strength: f64,
    /// Slope of the last unloading.
    pub(super) unloading: f64,
    pub(super) branch: Branch,
    /// Branch before the last unloading.
    pub(super) left: Branch,
    /// Side of the branch.
    pub(super) side: Side,
}

impl HysteresisMemory {
    /// Deformation when this was committed \[rad or m\].
    #[must_use]
    pub fn deformation(&self) -> f64 {
        self.deformation
    }

    /// Force when this was committed \[N·m or N\].
    #[must_use]
    pub fn force(&self) -> f64 {
        self.force
    }

    /// Greatest deformation so far, or until it was removed, towards a side, as a magnitude ≥ 0 \[rad or m\].
    #[must_use]
    pub fn greatest(&self, side: Side) -> f64 {
        self.extremes[side.index()]
    }

    /// Whether the spring was removed from the model ([`super::Hysteresis::remove`]).
    #[must_use]
    pub fn is_gone(&self) -> bool {
        self.branch == Branch::Gone
    }

    /// Sets the point reached when moving to a side.
    #[inline]
    pub(super) fn stand_at(&mut self, deformation: f64, force: f64, side: Side) {
        (self.deformation, self.force) = (deformation, force);
        if self.branch == Branch::Gone {
            return;
        }
        let extreme = &mut self.extremes[side.index()];
        *extreme = extreme.max(side.sign() * deformation);
    }

    /// Moves the spring on along its line; on the backbone its peak moves along.
    pub(super) fn move_on_the_line(&mut self, deformation: f64, force: f64) {
        let side = Side::from_change(deformation - self.deformation);
        if self.branch == Branch::Backbone {
            self.peaks[side.index()] = side.sign() * deformation;
        }
        self.stand_at(deformation, force, side);
    }

    pub(super) fn point(&self) -> Corner {
        Corner {
            deformation: self.deformation,
            force: self.force,
        }
    }
}

/// Force and slope of a line through a point at a deformation before its end, towards a side by its sign; `None` where the corner
/// is reached.
#[inline]
pub(super) fn before_corner(
    through: Corner,
    slope: f64,
    end: Option<Corner>,
    [sign, deformation]: [f64; 2],
) -> Option<[f64; 2]> {
    if end.is_some_and(|end| sign * (deformation - end.deformation) >= 0.0) {
        return None;
    }
    Some([
        through.force + slope * (deformation - through.deformation),
        slope,
    ])
}

/// The straight line a spring is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub(super) enum Branch {
    /// Never cracked.
    #[default]
    Virgin,
    /// On the backbone of a side.
    Backbone,
    /// On an unloading line (also when reloading on it).
    Unloading,
    /// Moving towards the peak of a side.
    Reloading,
    /// Removed from the model: without force from then on.
    Gone,
}

/// Response to a trial deformation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response {
    /// Force \[N·m or N\].
    pub force: f64,
    /// Slope of the line ahead in the direction of motion; the unloading slope without motion \[N·m/rad or N/m\].
    pub tangent: f64,
    /// Work done on the spring since the committed deformation, exact \[J\].
    pub work: f64,
    /// State to commit if the trial is accepted.
    pub memory: HysteresisMemory,
}

/// Largest loading stage of a spring so far.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum Stage {
    /// Never beyond the cracking deformation.
    #[default]
    Uncracked,
    /// Beyond cracking, not beyond yield.
    Cracked,
    /// Beyond the yield deformation.
    Yielded,
    /// A brace that has buckled, whether it has yielded in tension or not.
    Buckled,
    /// Removed from the model, as a strut of a panel that has fallen out.
    Gone,
}
