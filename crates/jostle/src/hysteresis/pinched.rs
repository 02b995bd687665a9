//! Pinched loops: timber connections, masonry, concrete that slips.
//!
//! Formulation of the rule that OpenSees publishes as `Hysteretic` (Scott and Filippou, OpenSees command manual,
//! *Hysteretic Material*), as straight lines with exact corners. Unloading from a peak *p* has the slope
//!
//! ```text
//! k = k₁ (dc / p)^exponent,  and not less than F(p) / p
//! ```
//!
//! From zero force at *z* the spring loads towards the peak *p* of the other side in two lines, through
//!
//! ```text
//! d = z + deformation (p − (1 − force) F(p)/k − z),   F = force F(p)
//! ```
//!
//! or, if the way to this point is steeper than *k*, with *k* to the second line. On arrival at zero force, damage
//! moves the peak ahead to *p* (1 + δ), δ = `ductility_damage` (q/dc′ − 1) + `energy_damage` W/W₀: *q* is the peak of
//! the side just left, if beyond its first corner dc′, *W* the work so far, *W₀* that of loading both sides to
//! yield.

use super::backbone::{Backbone, BackboneSide, Corner, Side};
use super::memory::{Branch, HysteresisMemory, Response, before_corner};

/// Damage moves no peak further than this, in yield deformations \[–\].
const FURTHEST: f64 = 1e6;

/// Greatest parameter of damage \[–\].
pub const GREATEST_DAMAGE: f64 = 10.0;

/// Parameters of the rule `pinched` \[–\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pinching {
    /// Where the steep part of reloading starts, 0…1: 0 at the end of unloading, 1 on the unloading line of the peak.
    pub deformation: f64,
    /// Force there over the force at the peak, 0…1.
    pub force: f64,
    /// Exponent with which the unloading stiffness falls with the peak, 0…1; 0 keeps the initial stiffness.
    pub unloading_exponent: f64,
    /// Growth of the peak ahead per unit of ductility beyond the first corner, 0…[`GREATEST_DAMAGE`].
    pub ductility_damage: f64,
    /// Growth of the peak ahead per dissipated energy over [`energy_to_yield`], 0…[`GREATEST_DAMAGE`].
    pub energy_damage: f64,
}

impl Pinching {
    /// 0.8 and 0.2, as in the examples of OpenSees; unloading stays stiff, without damage.
    pub const USUAL: Self = Self {
        deformation: 0.8,
        force: 0.2,
        unloading_exponent: 0.0,
        ductility_damage: 0.0,
        energy_damage: 0.0,
    };

    /// Reloads on the line of unloading, without damage.
    pub(super) const NONE: Self = Self {
        deformation: 1.0,
        force: 1.0,
        unloading_exponent: 0.0,
        ductility_damage: 0.0,
        energy_damage: 0.0,
    };

    /// The first parameter out of range: its name in model files, its range and its value.
    pub(super) fn fault(&self) -> Option<String> {
        let unit = [
            ("pinching.deformation", self.deformation),
            ("pinching.force", self.force),
            ("unloading_exponent", self.unloading_exponent),
        ];
        let damage = [
            ("damage.ductility", self.ductility_damage),
            ("damage.energy", self.energy_damage),
        ];
        let unit = unit
            .into_iter()
            .find(|(_, value)| !(0.0..=1.0).contains(value))
            .map(|(name, value)| format!("{name} must lie between 0 and 1, found {value}"));
        let damage = damage
            .into_iter()
            .find(|(_, value)| !(0.0..=GREATEST_DAMAGE).contains(value))
            .map(|(name, value)| {
                format!("{name} must lie between 0 and {GREATEST_DAMAGE}, found {value}")
            });
        unit.or(damage)
    }
}

/// Energy of loading both sides to yield, W₀ \[J\]; unit of [`Pinching::energy_damage`].
#[must_use]
pub fn energy_to_yield(backbone: &Backbone) -> f64 {
    let side = |side: &BackboneSide| {
        let (c, y) = (side.cracking, side.yielding);
        0.5 * (c.force * c.deformation + (c.force + y.force) * (y.deformation - c.deformation))
    };
    Side::BOTH.iter().map(|s| side(backbone.side(*s))).sum()
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
    /// The backbone of the side.
    Backbone,
    /// The branch before unloading.
    Return,
    /// Reloading of the side from zero force.
    Reload,
    /// The second line of reloading.
    Stiffen,
    /// A strut that bears compression alone opens, or is closed again.
    Open,
    Close,
}

/// Where a spring that bears one side alone has lost its force, if it has none; it has none beyond.
#[inline]
pub(super) fn open_from(backbone: &Backbone, memory: &HysteresisMemory) -> Option<Corner> {
    if memory.force != 0.0 {
        return None;
    }
    backbone.open_side()?;
    match memory.branch {
        Branch::Virgin => Some(Corner::default()),
        Branch::Reloading if memory.start.force == 0.0 => Some(memory.start),
        _ => None,
    }
}

#[inline]
pub(super) fn respond(
    backbone: &Backbone,
    pinching: &Pinching,
    memory: &HysteresisMemory,
    deformation: f64,
) -> Response {
    let towards = Side::from_change(deformation - memory.deformation);
    let sign = towards.sign();
    let mut next = *memory;
    turn_back(backbone, pinching, &mut next, towards);
    let (mut here, mut work) = (memory.point(), 0.0);
    // Every corner leads to another branch, finally the last line of the backbone.
    loop {
        let line = ahead(backbone, &next, towards);
        let reached = line
            .end
            .filter(|(end, _)| sign * (deformation - end.deformation) >= 0.0);
        let Some((end, follows)) = reached else {
            let force = line.through.force + line.slope * (deformation - line.through.deformation);
            if next.branch == Branch::Backbone {
                next.peaks[towards.index()] = sign * deformation;
            }
            return Response {
                force,
                tangent: line.slope,
                work: work + area(here, Corner { deformation, force }),
                memory: next,
            };
        };
        work += area(here, end);
        here = end;
        enter(backbone, pinching, &mut next, follows, here, towards);
    }
}

/// Force and slope of the line on which the spring is, where it neither turns back nor comes to a corner: no state is copied.
#[inline]
pub(super) fn on_the_line(
    backbone: &Backbone,
    memory: &HysteresisMemory,
    deformation: f64,
) -> Option<[f64; 2]> {
    let towards = Side::from_change(deformation - memory.deformation);
    if turns_back(backbone, memory, towards) {
        return None;
    }
    let Line {
        through,
        slope,
        end,
    } = ahead(backbone, memory, towards);
    before_corner(
        through,
        slope,
        end.map(|(end, _)| end),
        [towards.sign(), deformation],
    )
}

/// Whether motion towards a side leaves the branch in the opposite direction.
fn turns_back(backbone: &Backbone, memory: &HysteresisMemory, towards: Side) -> bool {
    let leads = matches!(memory.branch, Branch::Backbone | Branch::Reloading);
    leads && memory.side != towards && open_from(backbone, memory).is_none()
}

/// Work along a straight line.
fn area(from: Corner, to: Corner) -> f64 {
    0.5 * (to.force + from.force) * (to.deformation - from.deformation)
}

/// Adds the work since the start of the line, and starts another.
fn start_line(memory: &mut HysteresisMemory, here: Corner) {
    memory.worked += area(memory.line, here);
    memory.line = here;
}

/// Leaves a branch in the opposite direction.
fn turn_back(
    backbone: &Backbone,
    pinching: &Pinching,
    memory: &mut HysteresisMemory,
    towards: Side,
) {
    if turns_back(backbone, memory, towards) {
        memory.unloading = unloading_stiffness(backbone, pinching, memory);
        memory.left = memory.branch;
        memory.turn = memory.point();
        memory.branch = Branch::Unloading;
        start_line(memory, memory.turn);
    }
}

/// The line on which the spring moves towards a side; it is on no branch in the opposite direction.
#[inline(always)] // a line then stays in registers
fn ahead(backbone: &Backbone, memory: &HysteresisMemory, towards: Side) -> Line {
    let sign = towards.sign();
    if let Some((zero, open)) = open_from(backbone, memory).zip(backbone.open_side())
        && (towards == open || open.sign() * (memory.deformation - zero.deformation) > 0.0)
    {
        return Line {
            through: zero,
            slope: 0.0,
            end: (towards != open).then_some((zero, Next::Close)),
        };
    }
    let curve = backbone.side(towards);
    let signed = |corner: Corner| Corner {
        deformation: sign * corner.deformation,
        force: sign * corner.force,
    };
    match memory.branch {
        // What bears one side alone opens at zero.
        Branch::Virgin if backbone.open_side() == Some(towards) => Line {
            through: Corner::default(),
            slope: backbone.initial(),
            end: Some((Corner::default(), Next::Open)),
        },
        Branch::Virgin => Line {
            through: Corner::default(),
            slope: backbone.initial(),
            end: Some((signed(curve.cracking), Next::Backbone)),
        },
        Branch::Backbone if memory.peaks[towards.index()] < curve.yielding.deformation => Line {
            through: signed(curve.cracking),
            slope: curve.post_cracking,
            end: Some((signed(curve.yielding), Next::Backbone)),
        },
        Branch::Backbone => {
            let peak = memory.peaks[towards.index()];
            match curve.end_of_fall().map(signed) {
                Some(end) if peak >= sign * end.deformation => Line {
                    through: end,
                    slope: 0.0,
                    end: None,
                },
                end => Line {
                    through: signed(curve.yielding),
                    slope: curve.post_yield,
                    end: end.map(|end| (end, Next::Backbone)),
                },
            }
        }
        Branch::Reloading => {
            let peak = memory.peaks[towards.index()];
            let target = signed(Corner {
                deformation: peak,
                force: curve.force_at(peak),
            });
            let (end, next) = if memory.start == memory.knee {
                (target, Next::Backbone)
            } else {
                (memory.knee, Next::Stiffen)
            };
            let start = memory.start;
            Line {
                through: start,
                slope: (end.force - start.force) / (end.deformation - start.deformation),
                end: Some((end, next)),
            }
        }
        Branch::Gone => Line {
            through: Corner::default(),
            slope: 0.0,
            end: None,
        },
        Branch::Unloading if memory.side == towards => Line {
            through: memory.turn,
            slope: memory.unloading,
            end: Some((memory.turn, Next::Return)),
        },
        Branch::Unloading => {
            let end = Corner {
                deformation: memory.turn.deformation - memory.turn.force / memory.unloading,
                force: 0.0,
            };
            Line {
                through: memory.turn,
                slope: memory.unloading,
                end: Some((end, Next::Reload)),
            }
        }
    }
}

/// Changes branch at the end of a line.
fn enter(
    backbone: &Backbone,
    pinching: &Pinching,
    memory: &mut HysteresisMemory,
    next: Next,
    here: Corner,
    towards: Side,
) {
    start_line(memory, here);
    match next {
        Next::Backbone => {
            memory.branch = Branch::Backbone;
            memory.side = towards;
            memory.peaks[towards.index()] = towards.sign() * here.deformation;
        }
        Next::Return => memory.branch = memory.left,
        Next::Open | Next::Close => {
            (memory.deformation, memory.force) = (here.deformation, 0.0);
        }
        Next::Reload => {
            // What bears one side alone stays where it is until it is pressed again.
            let towards = backbone.open_side().map_or(towards, Side::opposite);
            memory.branch = Branch::Reloading;
            memory.side = towards;
            (memory.deformation, memory.force) = (here.deformation, 0.0);
            memory.start = here;
            memory.peaks[towards.index()] = target(backbone, pinching, memory, towards);
            memory.knee = knee(backbone, pinching, memory, towards);
        }
        Next::Stiffen => memory.start = here,
    }
}

/// Deformation towards which a spring at zero force loads, after damage.
fn target(
    backbone: &Backbone,
    pinching: &Pinching,
    memory: &HysteresisMemory,
    towards: Side,
) -> f64 {
    let curve = backbone.side(towards);
    let peak = memory.peaks[towards.index()];
    if peak == 0.0 {
        return curve.cracking.deformation;
    }
    let left = towards.opposite();
    let (behind, first) = (
        memory.peaks[left.index()],
        backbone.side(left).cracking.deformation,
    );
    if behind <= first {
        return peak;
    }
    let energy = (memory.worked / energy_to_yield(backbone)).max(0.0);
    let damage =
        pinching.ductility_damage * (behind / first - 1.0) + pinching.energy_damage * energy;
    let furthest = (FURTHEST * curve.yielding.deformation).max(peak);
    (peak * (1.0 + damage)).min(furthest)
}

/// The point at which reloading from zero force at `memory.start` stiffens; the start itself if there is none.
fn knee(
    backbone: &Backbone,
    pinching: &Pinching,
    memory: &HysteresisMemory,
    towards: Side,
) -> Corner {
    let sign = towards.sign();
    let start = sign * memory.start.deformation;
    let peak = memory.peaks[towards.index()];
    let force = backbone.side(towards).force_at(peak);
    let slope = slope_from(backbone, pinching, towards, peak);
    // Damage may leave the start beyond the unloading line of the peak: the spring then goes straight to it.
    if start >= peak - force / slope {
        return memory.start;
    }
    let pinched = pinching.force * force;
    let on_unloading = peak - (force - pinched) / slope;
    let mut at = (start + pinching.deformation * (on_unloading - start)).min(peak);
    let mut reached = pinched;
    if pinched > slope * (at - start) {
        let second = (force - pinched) / (peak - at);
        let difference = slope - second;
        if difference > 1e-12 * slope {
            at = ((force - second * peak + slope * start) / difference).clamp(start, peak);
            reached = (slope * (at - start)).min(force);
        }
    }
    Corner {
        deformation: sign * at,
        force: sign * reached,
    }
}

/// Slope of unloading from a peak of a side.
///
/// The bound F(p)/p is jostle's own: without it a large exponent lets the unloading line pass the origin before it
/// has lost its force, and the force would jump at the peak of the other side.
fn slope_from(backbone: &Backbone, pinching: &Pinching, side: Side, peak: f64) -> f64 {
    let curve = backbone.side(side);
    if pinching.unloading_exponent == 0.0 || peak <= curve.cracking.deformation {
        return backbone.initial();
    }
    let ratio = curve.cracking.deformation / peak;
    let falling = backbone.initial() * libm::pow(ratio, pinching.unloading_exponent);
    falling.max(curve.force_at(peak) / peak)
}

/// Unloading slope: the present one, or the one after a reversal.
pub(super) fn unloading_stiffness(
    backbone: &Backbone,
    pinching: &Pinching,
    memory: &HysteresisMemory,
) -> f64 {
    if open_from(backbone, memory).is_some_and(|zero| memory.deformation > zero.deformation) {
        return 0.0;
    }
    match memory.branch {
        Branch::Virgin => backbone.initial(),
        Branch::Gone => 0.0,
        Branch::Unloading => memory.unloading,
        Branch::Backbone | Branch::Reloading => slope_from(
            backbone,
            pinching,
            memory.side,
            memory.peaks[memory.side.index()],
        ),
    }
}

pub(super) fn next_corner(
    backbone: &Backbone,
    pinching: &Pinching,
    memory: &HysteresisMemory,
    towards: Side,
) -> f64 {
    let sign = towards.sign();
    let here = memory.point();
    let lies_ahead = |end: Corner| sign * (end.deformation - here.deformation) > 0.0;
    if !turns_back(backbone, memory, towards) {
        match ahead(backbone, memory, towards).end {
            None => return sign * f64::INFINITY,
            Some((end, _)) if lies_ahead(end) => return end.deformation,
            Some(_) => {}
        }
    }
    let mut memory = *memory;
    turn_back(backbone, pinching, &mut memory, towards);
    loop {
        match ahead(backbone, &memory, towards).end {
            None => return sign * f64::INFINITY,
            Some((end, _)) if lies_ahead(end) => return end.deformation,
            // The corner is here.
            Some((end, next)) => enter(backbone, pinching, &mut memory, next, end, towards),
        }
    }
}
