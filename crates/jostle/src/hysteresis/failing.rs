//! A spring that loses its strength: columns that fail in shear.
//!
//! Elastic with the stiffness *k* up to the strength *V*, at the deformation *d* = *V*/*k*; then the force falls with a
//! given slope to a residual force and stays there. Damage in one direction counts in both: from any peak the spring
//! unloads with *k*, and from zero force it loads straight to the point of the greatest deformation so far, of either
//! direction, on the falling line of its side. (OpenSees' `LimitState` without pinching and with `degrade` = 1; K. J.
//! Elwood, Can. J. Civ. Eng. 31, 2004.)
//!
//! Until it fails, its strength may be lowered ([`HysteresisMemory::weaken`](super::Hysteresis::weaken)).

use super::backbone::{Backbone, Corner, Side};
use super::memory::{Branch, HysteresisMemory, Response, before_corner};

/// What happens beyond the strength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FallingBranch {
    /// Loss of force per deformation, > 0 \[N/m\].
    pub slope: f64,
    /// Force that remains, ≥ 0 \[N\].
    pub residual: f64,
}

impl FallingBranch {
    /// What is wrong with the numbers for a strength \[N\].
    pub(super) fn fault(&self, strength: f64) -> Option<String> {
        if !(self.slope.is_finite() && self.slope > 0.0) {
            return Some(format!(
                "needs a falling slope greater than zero, found {}",
                self.slope
            ));
        }
        (!(0.0..strength).contains(&self.residual)).then(|| {
            format!(
                "needs a residual force of at least zero and less than the strength, found {} N",
                self.residual
            )
        })
    }
}

/// The curve of first loading, as magnitudes, at the present strength.
struct Curve {
    stiffness: f64,
    failure: Corner,
    /// Where the residual force is reached.
    end: Corner,
    slope: f64,
}

impl Curve {
    #[inline]
    fn new(backbone: &Backbone, falling: &FallingBranch, memory: &HysteresisMemory) -> Self {
        let stiffness = backbone.initial();
        let strength = if memory.strength > 0.0 {
            memory.strength
        } else {
            backbone.side(Side::Positive).yielding.force
        };
        let failure = Corner {
            deformation: strength / stiffness,
            force: strength,
        };
        let residual = falling.residual.min(strength);
        let end = Corner {
            deformation: failure.deformation + (strength - residual) / falling.slope,
            force: residual,
        };
        Self {
            stiffness,
            failure,
            end,
            slope: falling.slope,
        }
    }

    fn force_at(&self, deformation: f64) -> f64 {
        if deformation < self.failure.deformation {
            self.stiffness * deformation
        } else if deformation < self.end.deformation {
            self.failure.force - self.slope * (deformation - self.failure.deformation)
        } else {
            self.end.force
        }
    }
}

/// Deformation and force at the ends of the lines of first loading: of failure, and where the residual force is reached.
pub(super) fn corners(
    backbone: &Backbone,
    falling: &FallingBranch,
    memory: &HysteresisMemory,
) -> [Corner; 2] {
    let curve = Curve::new(backbone, falling, memory);
    [curve.failure, curve.end]
}

/// Force on the curve of first loading at the greatest deformation so far.
pub(super) fn strength_left(
    backbone: &Backbone,
    falling: &FallingBranch,
    memory: &HysteresisMemory,
) -> f64 {
    let curve = Curve::new(backbone, falling, memory);
    let peak = memory.peaks[0].max(memory.peaks[1]);
    curve.force_at(peak.max(curve.failure.deformation))
}

/// Lowers the strength of a spring that has not failed; never below its present force.
pub(super) fn weaken(backbone: &Backbone, memory: &mut HysteresisMemory, strength: f64) {
    if memory.branch != Branch::Virgin {
        return;
    }
    let known = if memory.strength > 0.0 {
        memory.strength
    } else {
        backbone.side(Side::Positive).yielding.force
    };
    if strength < known {
        memory.strength = strength.max(memory.force.abs());
    }
}

/// Straight line on which the spring moves in one direction, with its end.
struct Line {
    through: Corner,
    slope: f64,
    /// `None` never ends.
    end: Option<(Corner, Next)>,
}

/// The branch after a line.
#[derive(Clone, Copy)]
enum Next {
    /// The curve of first loading, beyond failure.
    Backbone,
    /// The branch before unloading.
    Return,
    /// Reloading of the other side, towards the greatest deformation.
    Reload,
}

#[inline]
pub(super) fn respond(
    backbone: &Backbone,
    falling: &FallingBranch,
    memory: &HysteresisMemory,
    deformation: f64,
) -> Response {
    let towards = Side::from_change(deformation - memory.deformation);
    let sign = towards.sign();
    let curve = Curve::new(backbone, falling, memory);
    let mut next = *memory;
    turn_back(&curve, &mut next, towards);
    let (mut here, mut work) = (memory.point(), 0.0);
    // Every corner leads to another branch, finally the residual force.
    loop {
        let line = ahead(&curve, &next, towards);
        let reached = line
            .end
            .filter(|(end, _)| sign * (deformation - end.deformation) >= 0.0);
        let Some((end, follows)) = reached else {
            let force = line.through.force + line.slope * (deformation - line.through.deformation);
            if next.branch == Branch::Backbone {
                next.peaks = [sign * deformation; 2];
            }
            return Response {
                force,
                tangent: line.slope,
                work: work + 0.5 * (force + here.force) * (deformation - here.deformation),
                memory: next,
            };
        };
        work += 0.5 * (end.force + here.force) * (end.deformation - here.deformation);
        here = end;
        enter(&mut next, follows, here, towards);
    }
}

/// Force and tangent on the line of the spring; `None` where it turns back or comes to a corner, and on the curve of first loading,
/// where peaks move along.
#[inline]
pub(super) fn on_the_line(
    backbone: &Backbone,
    falling: &FallingBranch,
    memory: &HysteresisMemory,
    deformation: f64,
) -> Option<[f64; 2]> {
    let towards = Side::from_change(deformation - memory.deformation);
    let turns_back = memory.branch == Branch::Reloading && memory.side != towards;
    if turns_back || memory.branch == Branch::Backbone {
        return None;
    }
    let curve = Curve::new(backbone, falling, memory);
    let line = ahead(&curve, memory, towards);
    before_corner(
        line.through,
        line.slope,
        line.end.map(|(end, _)| end),
        [towards.sign(), deformation],
    )
}

/// Leaves a branch in the opposite direction.
fn turn_back(curve: &Curve, memory: &mut HysteresisMemory, towards: Side) {
    let leads = matches!(memory.branch, Branch::Backbone | Branch::Reloading);
    if leads && memory.side != towards {
        memory.unloading = curve.stiffness;
        memory.left = memory.branch;
        memory.turn = memory.point();
        memory.branch = Branch::Unloading;
    }
}

/// The line on which the spring moves towards a side; it is on no branch in the opposite direction.
#[inline]
fn ahead(curve: &Curve, memory: &HysteresisMemory, towards: Side) -> Line {
    let sign = towards.sign();
    let signed = |corner: Corner| Corner {
        deformation: sign * corner.deformation,
        force: sign * corner.force,
    };
    match memory.branch {
        Branch::Virgin | Branch::Gone => Line {
            through: Corner::default(),
            slope: curve.stiffness,
            end: Some((signed(curve.failure), Next::Backbone)),
        },
        Branch::Backbone if memory.peaks[towards.index()] < curve.end.deformation => Line {
            through: signed(curve.failure),
            slope: -curve.slope,
            end: Some((signed(curve.end), Next::Backbone)),
        },
        Branch::Backbone => Line {
            through: signed(curve.end),
            slope: 0.0,
            end: None,
        },
        Branch::Reloading => {
            let peak = memory.peaks[towards.index()];
            let target = signed(Corner {
                deformation: peak,
                force: curve.force_at(peak),
            });
            let start = memory.start;
            Line {
                through: start,
                slope: (target.force - start.force) / (target.deformation - start.deformation),
                end: Some((target, Next::Backbone)),
            }
        }
        Branch::Unloading if memory.side == towards => Line {
            through: memory.turn,
            slope: curve.stiffness,
            end: Some((memory.turn, Next::Return)),
        },
        Branch::Unloading => {
            let end = Corner {
                deformation: memory.turn.deformation - memory.turn.force / curve.stiffness,
                force: 0.0,
            };
            Line {
                through: memory.turn,
                slope: curve.stiffness,
                end: Some((end, Next::Reload)),
            }
        }
    }
}

/// Changes branch at the end of a line.
fn enter(memory: &mut HysteresisMemory, next: Next, here: Corner, towards: Side) {
    match next {
        Next::Backbone => {
            memory.branch = Branch::Backbone;
            memory.side = towards;
            memory.peaks = [towards.sign() * here.deformation; 2];
        }
        Next::Return => memory.branch = memory.left,
        Next::Reload => {
            memory.branch = Branch::Reloading;
            memory.side = towards;
            memory.start = here;
        }
    }
}

pub(super) fn next_corner(
    backbone: &Backbone,
    falling: &FallingBranch,
    memory: &HysteresisMemory,
    towards: Side,
) -> f64 {
    let curve = Curve::new(backbone, falling, memory);
    let mut memory = *memory;
    let sign = towards.sign();
    let here = memory.point();
    turn_back(&curve, &mut memory, towards);
    loop {
        match ahead(&curve, &memory, towards).end {
            None => return sign * f64::INFINITY,
            Some((end, _)) if sign * (end.deformation - here.deformation) > 0.0 => {
                return end.deformation;
            }
            // The corner is here.
            Some((end, next)) => enter(&mut memory, next, end, towards),
        }
    }
}
