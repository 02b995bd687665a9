//! Rules oriented to peaks: peak-oriented (Clough and Johnston) and Takeda.
//!
//! Both follow the same four branches: virgin → backbone → unloading → reloading towards the peak of the other side
//! → backbone. They differ in the slope of unloading and when they enter a side that has never been loaded: a
//! peak-oriented spring turns towards its cracking point at zero force, a Takeda spring continues unloading to the
//! cracking force of that side and then turns towards its yield point.

use super::backbone::{Backbone, Corner, Side};
use super::memory::{Branch, HysteresisMemory, Response, before_corner};

/// Straight line on which the spring moves in one direction, with its end and the next branch.
struct Piece {
    through: Corner,
    slope: f64,
    /// `None` never ends.
    end: Option<(Corner, Next)>,
}

/// The branch after a line.
#[derive(Clone, Copy)]
enum Next {
    /// The backbone, from its cracking point on for the first time.
    Crack,
    /// The backbone of the side.
    Backbone,
    /// The branch before unloading.
    Return,
    /// Reloading of the other side, towards a peak.
    Reload { peak: f64 },
    /// The backbone of the other side, at its cracking point.
    CrackOpposite,
}

#[inline]
pub(super) fn respond(
    backbone: &Backbone,
    exponent: Option<f64>,
    memory: &HysteresisMemory,
    deformation: f64,
) -> Response {
    let towards = Side::from_change(deformation - memory.deformation);
    let sign = towards.sign();
    let mut next = *memory;
    turn_back(backbone, exponent, &mut next, towards);
    let (mut here, mut work) = (memory.point(), 0.0);
    // Every corner leads to another branch, finally the backbone.
    loop {
        let piece = ahead(backbone, exponent, &next, towards);
        let reached = piece
            .end
            .filter(|(end, _)| sign * (deformation - end.deformation) >= 0.0);
        let Some((end, follows)) = reached else {
            let force =
                piece.through.force + piece.slope * (deformation - piece.through.deformation);
            if next.branch == Branch::Backbone {
                next.peaks[towards.index()] = sign * deformation;
            }
            return Response {
                force,
                tangent: piece.slope,
                work: work + 0.5 * (force + here.force) * (deformation - here.deformation),
                memory: next,
            };
        };
        work += 0.5 * (end.force + here.force) * (end.deformation - here.deformation);
        here = end;
        enter(&mut next, follows, here, towards);
    }
}

/// Force and slope of the line on which the spring is, where it neither turns back nor comes to a corner: no state is copied.
#[inline]
pub(super) fn on_the_line(
    backbone: &Backbone,
    exponent: Option<f64>,
    memory: &HysteresisMemory,
    deformation: f64,
) -> Option<[f64; 2]> {
    let towards = Side::from_change(deformation - memory.deformation);
    if turns_back(memory, towards) {
        return None;
    }
    let Piece {
        through,
        slope,
        end,
    } = ahead(backbone, exponent, memory, towards);
    before_corner(
        through,
        slope,
        end.map(|(end, _)| end),
        [towards.sign(), deformation],
    )
}

/// Whether motion towards a side leaves the branch in the opposite direction.
fn turns_back(memory: &HysteresisMemory, towards: Side) -> bool {
    matches!(memory.branch, Branch::Backbone | Branch::Reloading) && memory.side != towards
}

/// Leaves a branch in the opposite direction.
fn turn_back(
    backbone: &Backbone,
    exponent: Option<f64>,
    memory: &mut HysteresisMemory,
    towards: Side,
) {
    if turns_back(memory, towards) {
        memory.unloading = unloading_stiffness(backbone, exponent, memory);
        memory.left = memory.branch;
        memory.turn = memory.point();
        memory.branch = Branch::Unloading;
    }
}

/// The line on which the spring moves towards a side; it is on no branch in the opposite direction.
#[inline(always)] // a piece then stays in registers
fn ahead(
    backbone: &Backbone,
    exponent: Option<f64>,
    memory: &HysteresisMemory,
    towards: Side,
) -> Piece {
    let sign = towards.sign();
    let curve = backbone.side(towards);
    let signed = |corner: Corner| Corner {
        deformation: sign * corner.deformation,
        force: sign * corner.force,
    };
    match memory.branch {
        Branch::Virgin | Branch::Gone => Piece {
            through: Corner::default(),
            slope: backbone.initial(),
            end: Some((signed(curve.cracking), Next::Crack)),
        },
        Branch::Backbone if memory.peaks[towards.index()] < curve.yielding.deformation => Piece {
            through: signed(curve.cracking),
            slope: curve.post_cracking,
            end: Some((signed(curve.yielding), Next::Backbone)),
        },
        Branch::Backbone => Piece {
            through: signed(curve.yielding),
            slope: curve.post_yield,
            end: None,
        },
        Branch::Reloading => {
            let peak = memory.peaks[towards.index()];
            let target = signed(Corner {
                deformation: peak,
                force: curve.force_at(peak),
            });
            let start = memory.start;
            let slope = (target.force - start.force) / (target.deformation - start.deformation);
            Piece {
                through: start,
                slope,
                end: Some((target, Next::Backbone)),
            }
        }
        Branch::Unloading if memory.side == towards => Piece {
            through: memory.turn,
            slope: memory.unloading,
            end: Some((memory.turn, Next::Return)),
        },
        Branch::Unloading => {
            let peak = memory.peaks[towards.index()];
            let at_force = |force: f64| Corner {
                deformation: memory.turn.deformation
                    + (force - memory.turn.force) / memory.unloading,
                force,
            };
            let end = if peak > 0.0 {
                (at_force(0.0), Next::Reload { peak })
            } else if exponent.is_none() {
                let peak = curve.cracking.deformation;
                (at_force(0.0), Next::Reload { peak })
            } else if aims_at_cracking(backbone, memory) {
                (signed(curve.cracking), Next::CrackOpposite)
            } else {
                let peak = curve.yielding.deformation;
                (at_force(sign * curve.cracking.force), Next::Reload { peak })
            };
            Piece {
                through: memory.turn,
                slope: memory.unloading,
                end: Some(end),
            }
        }
    }
}

/// Changes branch at the end of a line.
fn enter(memory: &mut HysteresisMemory, next: Next, here: Corner, towards: Side) {
    let reached = towards.sign() * here.deformation;
    match next {
        Next::Crack | Next::Backbone | Next::CrackOpposite => {
            memory.branch = Branch::Backbone;
            memory.side = towards;
            memory.peaks[towards.index()] = reached;
        }
        Next::Return => memory.branch = memory.left,
        Next::Reload { peak } => {
            memory.branch = Branch::Reloading;
            memory.side = towards;
            memory.start = here;
            memory.peaks[towards.index()] = peak;
        }
    }
}

/// Slope from the peak of a side to the cracking point of the other.
fn slope_to_opposite_cracking(backbone: &Backbone, side: Side, peak: f64) -> f64 {
    let (curve, other) = (backbone.side(side), backbone.side(side.opposite()));
    (curve.force_at(peak) + other.cracking.force) / (peak + other.cracking.deformation)
}

/// Whether a Takeda spring that unloads arrives at the cracking point of the other side.
fn aims_at_cracking(backbone: &Backbone, memory: &HysteresisMemory) -> bool {
    let peak = memory.peaks[memory.side.index()];
    memory.unloading == slope_to_opposite_cracking(backbone, memory.side, peak)
}

/// Unloading slope: the present one, or the one after a reversal.
///
/// Takeda: towards the opposite cracking point before yield; after it the slope from the yield point to there,
/// times (yield / peak) to the exponent. Two bounds cover cases that the published rule does not. The slope is
/// never less than that from the peak to that cracking point, which large exponents would undercut. And after a
/// reversal before the peak the line never reaches zero force beyond the point where elastic unloading from the
/// other peak would arrive; otherwise, with very different sides, loading towards that peak would be stiffer than
/// the initial stiffness.
pub(super) fn unloading_stiffness(
    backbone: &Backbone,
    exponent: Option<f64>,
    memory: &HysteresisMemory,
) -> f64 {
    let (Some(exponent), side) = (exponent, memory.side) else {
        return backbone.initial();
    };
    match memory.branch {
        Branch::Virgin | Branch::Gone => backbone.initial(),
        Branch::Unloading => memory.unloading,
        Branch::Backbone | Branch::Reloading => {
            let peak = memory.peaks[side.index()];
            let least = slope_to_opposite_cracking(backbone, side, peak)
                .max(slope_to_elastic_intercept(backbone, memory));
            let yielding = backbone.side(side).yielding.deformation;
            if peak <= yielding {
                return least;
            }
            let at_yield = slope_to_opposite_cracking(backbone, side, yielding);
            (at_yield * libm::pow(yielding / peak, exponent)).max(least)
        }
    }
}

/// Slope from a point of reloading to where elastic unloading from the peak of the other side would arrive at
/// zero force; zero elsewhere.
fn slope_to_elastic_intercept(backbone: &Backbone, memory: &HysteresisMemory) -> f64 {
    let (side, other) = (memory.side, memory.side.opposite());
    let peak = memory.peaks[other.index()];
    if memory.branch != Branch::Reloading || peak == 0.0 {
        return 0.0;
    }
    let intercept = peak - backbone.side(other).force_at(peak) / backbone.initial();
    let span = side.sign() * memory.deformation + intercept;
    if span > 0.0 {
        (side.sign() * memory.force / span).max(0.0)
    } else {
        0.0
    }
}

pub(super) fn next_corner(
    backbone: &Backbone,
    exponent: Option<f64>,
    memory: &HysteresisMemory,
    towards: Side,
) -> f64 {
    let sign = towards.sign();
    let here = memory.point();
    let lies_ahead = |end: Corner| sign * (end.deformation - here.deformation) > 0.0;
    if !turns_back(memory, towards) {
        match ahead(backbone, exponent, memory, towards).end {
            None => return sign * f64::INFINITY,
            Some((end, _)) if lies_ahead(end) => return end.deformation,
            Some(_) => {}
        }
    }
    let mut memory = *memory;
    turn_back(backbone, exponent, &mut memory, towards);
    loop {
        match ahead(backbone, exponent, &memory, towards).end {
            None => return sign * f64::INFINITY,
            Some((end, _)) if lies_ahead(end) => return end.deformation,
            // The corner is here.
            Some((end, next)) => enter(&mut memory, next, end, towards),
        }
    }
}
