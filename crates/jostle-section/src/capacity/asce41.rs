//! Shear of columns by ASCE/SEI 41-17.

use super::{RatedMember, ShearStrength, aci318};
use crate::formula::Member;

/// A pound per square inch \[Pa\].
const PSI: f64 = 6_894.757_293_168;

/// Column shear strength, (10-3), in pounds and inches:
///
/// ```text
/// V = knl { αcol Av fyt d/s + λ 6 √f'c / (M/(V d)) √(1 + N/(6 √f'c Ag)) 0.8 Ag }
/// ```
/// with λ = 1, 2 ≤ M/(V d) ≤ 4, tension not counted, αcol = 1 for s/d ≤ 0.75 and 0 for s/d ≥ 1, linear between; knl falls from 1
/// at ductility 2 to 0.7 at ductility 6. Beams follow ACI 318.
pub(super) fn strength(member: &RatedMember<'_>, compression: f64) -> Option<ShearStrength> {
    if member.member == Member::Beam {
        return aci318::strength(member, compression);
    }
    let section = member.section;
    let ties = section.ties?;
    let depth = member.effective_depth();
    let counted = ((1.0 - ties.spacing / depth) / 0.25).clamp(0.0, 1.0);
    let by_ties = counted * member.tie_force()? * depth;
    let root = 6.0 * (section.concrete.strength / PSI).sqrt() * PSI;
    let aspect = (member.shear_span() / depth).clamp(2.0, 4.0);
    let area = section.area();
    let arch = (1.0 + compression.max(0.0) / (root * area)).sqrt();
    Some(ShearStrength {
        steady: 0.0,
        degrading: by_ties + root / aspect * arch * 0.8 * area,
        limit: f64::INFINITY,
    })
}
