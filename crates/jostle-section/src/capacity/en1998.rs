//! Shear by EN 1998-3:2005, annex A.

use super::{MPA, RatedMember, ShearStrength};
use crate::formula;
use crate::section::Section;

/// γel of primary seismic elements.
const ELEMENT_FACTOR: f64 = 1.15;

/// Cyclic shear strength controlled by the ties, (A.12):
///
/// ```text
/// VR = 1/γel { (h − x)/(2 LV) min(N, 0.55 Ac fc)
///              + (1 − 0.05 min(5, μΔpl)) [0.16 max(0.5, 100 ρtot) (1 − 0.16 min(5, LV/h)) √fc Ac + Vw] }   [MPa, m, MN]
/// Vw = ρw bw z fyw,  z = d − d′,  Ac = bw d
/// ```
/// with γel = 1.15. x is the depth of the compression zone at yield. Squat columns may fail at less by crushing of the
/// web, (A.15), which is not included.
pub(super) fn strength(member: &RatedMember<'_>, compression: f64) -> Option<ShearStrength> {
    let section = member.section;
    let tie_force = member.tie_force()?;
    let depth = member.effective_depth();
    let span = member.shear_span();
    let area = section.width * depth;
    let lever = depth - (section.depth - formula::effective_depth(&section.flipped()));
    let bars = 100.0 * section.steel_area() / area;
    let slenderness = 1.0 - 0.16 * (span / section.depth).min(5.0);
    let root = (MPA * section.concrete.strength).sqrt() / MPA;
    let by_concrete = 0.16 * bars.max(0.5) * slenderness * root * area;
    let load = compression.clamp(0.0, 0.55 * area * section.concrete.strength);
    let inclined = if load > 0.0 {
        let (axis, _) = yielding(section, compression);
        (section.depth - axis).max(0.0) / (2.0 * span) * load
    } else {
        0.0
    };
    Some(ShearStrength {
        steady: inclined / ELEMENT_FACTOR,
        degrading: (by_concrete + tie_force * lever) / ELEMENT_FACTOR,
        limit: f64::INFINITY,
    })
}

/// Depth of the neutral axis \[m\], at most the whole depth, and curvature \[1/m\] of the cracked elastic section when the bars
/// in tension yield, or the outermost concrete reaches 1.8 fc (A.3.2.4), whichever is first.
pub(super) fn yielding(section: &Section, compression: f64) -> (f64, f64) {
    let depth = formula::effective_depth(section);
    let (concrete, steel) = (section.concrete.modulus, section.steel.modulus);
    let curvature = |axis: f64| {
        let by_concrete = 1.8 * section.concrete.strength / (concrete * axis);
        if axis < depth {
            by_concrete.min(section.steel.yield_strain() / (depth - axis))
        } else {
            by_concrete
        }
    };
    let force = |axis: f64| {
        let below = (axis - section.depth).max(0.0);
        let blocks = 0.5 * concrete * section.width * (axis * axis - below * below);
        let bars = section.bars.iter();
        let bars: f64 = bars
            .map(|bar| steel * bar.area() * (axis - bar.depth))
            .sum();
        curvature(axis) * (blocks + bars)
    };
    let (mut low, mut high) = (1e-6 * section.depth, section.depth);
    if force(high) < compression {
        return (section.depth, curvature(section.depth));
    }
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if force(middle) < compression {
            low = middle;
        } else {
            high = middle;
        }
    }
    let axis = 0.5 * (low + high);
    (axis, curvature(axis))
}
