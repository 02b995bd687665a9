//! Degrading trilinear rule, D-Tri (Fukada, 1969; Muto, 1973).
//!
//! Between the peaks the spring follows a bilinear loop: an elastic range with the height of both cracking forces
//! together and slope β k₁, between two parallel lines of slope β k₂ through the two peaks. Initially the peaks are
//! the yield points; they move along the backbone. The factor
//!
//! ```text
//! β = [ (Fc⁺ + Fc⁻)/k₁ + (F⁺ + F⁻ − Fc⁺ − Fc⁻)/k₂ ] / (d⁺ + d⁻)
//! ```
//!
//! makes the loop connect both peaks; it is 1 until yield and decreases afterwards. The distance of the lines is
//! always (Fc⁺ + Fc⁻)(1 − k₂/k₁), so the height of the elastic range is constant.

use super::backbone::{Backbone, Corner, Side};
use super::memory::{Branch, HysteresisMemory, Response};

/// The peak of a side, with its signs.
fn peak(backbone: &Backbone, memory: &HysteresisMemory, side: Side) -> Corner {
    let curve = backbone.side(side);
    let reached = memory.peaks[side.index()];
    let corner = if reached > curve.yielding.deformation {
        Corner {
            deformation: reached,
            force: curve.force_at(reached),
        }
    } else {
        curve.yielding
    };
    Corner {
        deformation: side.sign() * corner.deformation,
        force: side.sign() * corner.force,
    }
}

/// β: reduction factor of the stiffnesses, 0 < β ≤ 1 \[–\].
pub(super) fn factor(backbone: &Backbone, memory: &HysteresisMemory) -> f64 {
    let [positive, negative] = Side::BOTH.map(|side| peak(backbone, memory, side));
    if Side::BOTH
        .iter()
        .all(|side| memory.peaks[side.index()] == 0.0)
    {
        return 1.0;
    }
    let [a, b] = Side::BOTH.map(|side| backbone.side(side));
    let cracking = a.cracking.force + b.cracking.force;
    (cracking / backbone.initial() + (positive.force - negative.force - cracking) / a.post_cracking)
        / (positive.deformation - negative.deformation)
}

/// Intersection of the elastic line and the line through the peak of a side.
fn corner(backbone: &Backbone, memory: &HysteresisMemory, towards: Side, factor: f64) -> Corner {
    let target = peak(backbone, memory, towards);
    let second = factor * backbone.side(towards).post_cracking;
    let turn = memory.turn;
    let above = target.force + second * (turn.deformation - target.deformation) - turn.force;
    let deformation = turn.deformation + above / (factor * backbone.initial() - second);
    if towards.sign() * (deformation - target.deformation) >= 0.0 {
        return target;
    }
    Corner {
        deformation,
        force: target.force + second * (deformation - target.deformation),
    }
}

/// The branch on which the spring moves towards a side: `Unloading` stands for the elastic range, `Reloading`
/// for the line through a peak.
fn turn_back(memory: &mut HysteresisMemory, towards: Side) {
    let leads = matches!(memory.branch, Branch::Backbone | Branch::Reloading);
    if leads && memory.side != towards {
        memory.turn = memory.point();
        memory.branch = Branch::Unloading;
    }
}

#[inline]
pub(super) fn respond(
    backbone: &Backbone,
    memory: &HysteresisMemory,
    deformation: f64,
) -> Response {
    let towards = Side::from_change(deformation - memory.deformation);
    let sign = towards.sign();
    let factor = factor(backbone, memory);
    let mut next = *memory;
    turn_back(&mut next, towards);
    let target = peak(backbone, memory, towards);
    let second = factor * backbone.side(towards).post_cracking;
    let (mut here, mut work) = (memory.point(), 0.0);
    let mut walk = |to: Corner, here: &mut Corner| {
        work += 0.5 * (to.force + here.force) * (to.deformation - here.deformation);
        *here = to;
        work
    };
    if matches!(next.branch, Branch::Virgin | Branch::Unloading) {
        let end = corner(backbone, &next, towards, factor);
        let slope = factor * backbone.initial();
        if sign * (end.deformation - deformation) > 0.0 {
            let force = next.turn.force + slope * (deformation - next.turn.deformation);
            let work = walk(Corner { deformation, force }, &mut here);
            return Response {
                force,
                tangent: slope,
                work,
                memory: next,
            };
        }
        walk(end, &mut here);
        next.branch = Branch::Reloading;
        next.side = towards;
    }
    if next.branch == Branch::Reloading {
        if sign * (target.deformation - deformation) > 0.0 {
            let force = target.force + second * (deformation - target.deformation);
            let work = walk(Corner { deformation, force }, &mut here);
            return Response {
                force,
                tangent: second,
                work,
                memory: next,
            };
        }
        walk(target, &mut here);
        next.branch = Branch::Backbone;
    }
    let curve = backbone.side(towards);
    next.peaks[towards.index()] = sign * deformation;
    let force = sign * curve.force_at(sign * deformation);
    let work = walk(Corner { deformation, force }, &mut here);
    Response {
        force,
        tangent: curve.post_yield,
        work,
        memory: next,
    }
}

pub(super) fn next_corner(backbone: &Backbone, memory: &HysteresisMemory, towards: Side) -> f64 {
    let sign = towards.sign();
    let mut memory = *memory;
    turn_back(&mut memory, towards);
    let target = peak(backbone, &memory, towards).deformation;
    let elastic = matches!(memory.branch, Branch::Virgin | Branch::Unloading);
    let factor = factor(backbone, &memory);
    let corners = [
        elastic.then(|| corner(backbone, &memory, towards, factor).deformation),
        (memory.branch != Branch::Backbone).then_some(target),
    ];
    corners
        .into_iter()
        .flatten()
        .find(|corner| sign * (corner - memory.deformation) > 0.0)
        .unwrap_or(sign * f64::INFINITY)
}
