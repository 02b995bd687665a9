//! Shear of columns with light ties by Sezen and Moehle.

use super::{MPA, RatedMember, ShearStrength};
use crate::formula::Member;

/// Strength of columns that fail in shear after yielding in bending:
///
/// ```text
/// V = k { Av fy d/s + 0.5 √f'c/(a/d) √(1 + P/(0.5 √f'c Ag)) 0.8 Ag }    [MPa]
/// ```
/// 2 ≤ a/d ≤ 4; k falls from 1 at ductility 2 to 0.7 at ductility 6. Tension is not counted.
///
/// H. Sezen and J. P. Moehle (2004), J. Struct. Eng. 130, 1692–1703.
pub(super) fn strength(member: &RatedMember<'_>, compression: f64) -> Option<ShearStrength> {
    if member.member == Member::Beam {
        return None;
    }
    let depth = member.effective_depth();
    let by_ties = member.tie_force()? * depth;
    let root = 0.5 * (MPA * member.section.concrete.strength).sqrt() / MPA;
    let aspect = (member.shear_span() / depth).clamp(2.0, 4.0);
    let area = member.section.area();
    let arch = (1.0 + compression.max(0.0) / (root * area)).sqrt();
    Some(ShearStrength {
        steady: 0.0,
        degrading: by_ties + root / aspect * arch * 0.8 * area,
        limit: f64::INFINITY,
    })
}
