//! Shear by GB 50010-2010 (seismic combinations), the formulas that GB 50011-2010, 6.2.9 refers to.

use super::{MPA, RatedMember, ShearStrength};
use crate::concrete::StrengthLevel;
use crate::formula::Member;
use crate::section::Section;

/// γRE of table 11.1.6 for shear.
const SHEAR_REDUCTION: f64 = 0.85;
/// Greatest tie strength in design, 4.2.3, and the characteristic strength of the same grade \[Pa\].
const MOST_TIE_STRENGTH: [f64; 2] = [360e6, 400e6];

/// Shear strength.
///
/// ```text
/// beams    V = (0.42 ft b h₀ + fyv Asv/s h₀) / γRE                                (11.3.4)
/// columns  V = (1.05/(λ + 1) ft b h₀ + fyv Asv/s h₀ + 0.056 N) / γRE              (11.4.7), 1 ≤ λ ≤ 3, N ≤ 0.3 fc A
///          V = (1.05/(λ + 1) ft b h₀ + fyv Asv/s h₀ − 0.2 |N|) / γRE              (11.4.8), at least fyv Asv/s h₀ / γRE
/// at most  0.2 βc fc b h₀ / γRE, 0.15 for columns with λ ≤ 2 and beams with l₀/h ≤ 2.5   (11.3.3, 11.4.6)
/// ```
/// λ = Hn/(2 h₀). γRE = 0.85 with design strengths. With characteristic or mean strengths it is 1, as in checks of ultimate
/// capacity (GB 50011-2010, M.1.2).
pub(super) fn strength(member: &RatedMember<'_>, compression: f64) -> Option<ShearStrength> {
    let section = member.section;
    let ties = section.ties?;
    let depth = member.effective_depth();
    let area = section.width * depth;
    let by_ties = tie_strength(section, member.level) * ties.area() / ties.spacing * depth;
    let (concrete, by_axial, squat) = match member.member {
        Member::Beam => (0.42, 0.0, member.clear_length <= 2.5 * section.depth),
        Member::Column => {
            let ratio = member.shear_span() / depth;
            let crushing = section.concrete.strength * section.area();
            let by_axial = if compression >= 0.0 {
                0.056 * compression.min(0.3 * crushing)
            } else {
                0.2 * compression
            };
            (1.05 / (ratio.clamp(1.0, 3.0) + 1.0), by_axial, ratio <= 2.0)
        }
    };
    let by_concrete = concrete * section.concrete.tensile_strength * area;
    let share = if squat { 0.15 } else { 0.2 };
    let crushing = share * strength_factor(section) * section.concrete.strength * area;
    let reduction = shear_reduction(member.level);
    Some(ShearStrength {
        steady: (by_concrete + by_ties + by_axial).max(by_ties) / reduction,
        degrading: 0.0,
        limit: crushing / reduction,
    })
}

/// Yield strength of the ties that counts \[Pa\].
pub(super) fn tie_strength(section: &Section, level: StrengthLevel) -> f64 {
    let most = MOST_TIE_STRENGTH[usize::from(level != StrengthLevel::Design)];
    section.steel.yield_strength.min(most)
}

/// γRE of table 11.1.6 for shear: 0.85 with design strengths, otherwise 1 \[–\].
pub(super) fn shear_reduction(level: StrengthLevel) -> f64 {
    if level == StrengthLevel::Design {
        SHEAR_REDUCTION
    } else {
        1.0
    }
}

/// βc: it falls from 1 to 0.8 between cube strengths C50 and C80 (6.3.1) \[–\].
pub(super) fn strength_factor(section: &Section) -> f64 {
    let cube = MPA * section.concrete.strength / 0.67;
    (1.0 - 0.2 * (cube - 50.0) / 30.0).clamp(0.8, 1.0)
}

/// γRE of table 11.1.6 for bending: 0.75 for beams and columns with N/(fc A) < 0.15, otherwise 0.8; 1 unless strengths are
/// design values \[–\].
pub(super) fn bending_reduction(member: &RatedMember<'_>, compression: f64) -> f64 {
    if member.level != StrengthLevel::Design {
        return 1.0;
    }
    let light = member.section.axial_ratio(compression) < 0.15;
    if member.member == Member::Beam || light {
        0.75
    } else {
        0.8
    }
}
