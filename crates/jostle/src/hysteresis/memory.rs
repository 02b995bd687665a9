//! What a spring remembers, and what it answers.

use super::backbone::{Corner, Side};

/// Everything a spring remembers between steps; the default is at rest and never loaded.
///
/// It holds where straight lines begin, not the last increment. A path in one direction therefore leaves the
/// same bits behind however it is divided, and turning back and forth without reaching a corner leaves no trace.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct HysteresisMemory {
    pub(super) deformation: f64,
    pub(super) force: f64,
    /// Greatest deformation so far of either side, as magnitudes.
    pub(super) extremes: [f64; 2],
    /// Deformation of either side at which the backbone is met again, as magnitudes; 0 before cracking.
    pub(super) peaks: [f64; 2],
    /// Deformation at which each slider of the parallel model has no force.
    pub(super) offsets: [f64; 2],
    /// Where the last unloading began.
    pub(super) turn: Corner,
    /// Where the line towards a peak began.
    pub(super) start: Corner,
    /// Slope of the last unloading.
    pub(super) unloading: f64,
    pub(super) branch: Branch,
    /// Branch that unloading turned away from.
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

    /// Greatest deformation so far towards a side, as a magnitude ≥ 0 \[rad or m\].
    #[must_use]
    pub fn greatest(&self, side: Side) -> f64 {
        self.extremes[side.index()]
    }

    /// Stands at a point, reached on the way to a side.
    #[inline]
    pub(super) fn stand_at(&mut self, deformation: f64, force: f64, side: Side) {
        (self.deformation, self.force) = (deformation, force);
        let extreme = &mut self.extremes[side.index()];
        *extreme = extreme.max(side.sign() * deformation);
    }

    pub(super) fn point(&self) -> Corner {
        Corner {
            deformation: self.deformation,
            force: self.force,
        }
    }
}

/// The straight line a spring is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub(super) enum Branch {
    /// Never cracked.
    #[default]
    Virgin,
    /// On the backbone of a side.
    Backbone,
    /// On a line of unloading (and of loading again, until it is left).
    Unloading,
    /// On the way to the peak of a side.
    Reloading,
}

/// Answer to a trial deformation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response {
    /// Force \[N·m or N\].
    pub force: f64,
    /// Slope of the line ahead in the direction of motion; of unloading where nothing moves \[N·m/rad or N/m\].
    pub tangent: f64,
    /// Work done on the spring on the way from the committed deformation, exact \[J\].
    pub work: f64,
    /// What to commit if the trial is taken.
    pub memory: HysteresisMemory,
}

/// How far a spring has ever been loaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum Stage {
    /// Never beyond the cracking deformation.
    #[default]
    Uncracked,
    /// Beyond cracking, not beyond yield.
    Cracked,
    /// Beyond the yield deformation.
    Yielded,
}
