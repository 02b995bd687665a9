//! Shear by ACI 318-14.

use super::{MPA, RatedMember, ShearStrength};
use crate::formula::Member;

/// Nominal shear strength Vc + Vs, without a strength reduction factor φ, in MPa:
///
/// ```text
/// Vc = 0.17 (1 + N/(14 Ag)) √f'c bw d             (22.5.6.1)
/// Vs = Av fyt d/s ≤ 0.66 √f'c bw d                (22.5.10.5.3, 22.5.1.2)
/// ```
/// √f'c is at most 8.3 MPa (22.5.3.1). Vc is zero in beams (18.6.5.2), and in columns under less than Ag f'c/20 (18.7.6.2.1):
/// the shear of a run comes from the earthquake.
pub(super) fn strength(member: &RatedMember<'_>, compression: f64) -> Option<ShearStrength> {
    let section = member.section;
    let depth = member.effective_depth();
    let root = (MPA * section.concrete.strength).sqrt().min(8.3) / MPA;
    let area = section.width * depth;
    let by_ties = (member.tie_force()? * depth).min(0.66 * root * area);
    let counts = member.member == Member::Column
        && compression >= section.area() * section.concrete.strength / 20.0;
    let by_concrete = if counts {
        0.17 * (1.0 + MPA * compression / (14.0 * section.area())) * root * area
    } else {
        0.0
    };
    Some(ShearStrength {
        steady: by_concrete + by_ties,
        degrading: 0.0,
        limit: f64::INFINITY,
    })
}
