//! Capacity of columns and beams by codes and published models: shear, bending with axial force, drift at axial failure.
//!
//! Strengths are those of the section as given: characteristic, mean or design values. Axial forces are compressions.

mod acceptance;
mod aci318;
mod aisc360;
mod asce41;
mod axial_failure;
mod en1998;
mod gb50010;
mod interaction;
mod joint;
mod lines;
mod oblique;
mod sezen_moehle;
mod shear_failure;

pub use aisc360::SteelMember;
pub use axial_failure::drift_at_axial_failure;
pub use interaction::Interaction;
pub use joint::{JointStrength, RatedJoint};
pub use oblique::ObliqueInteraction;
pub use shear_failure::{NoShearLoss, ShearLoss};

use crate::concrete::StrengthLevel;
use crate::formula::{self, Member};
use crate::section::Section;
use crate::steel::{ASTM_STEEL_GRADES, EN_STEEL_GRADES, STEEL_GRADES};

/// A member whose capacity is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct RatedMember<'a> {
    /// Its section; rules for shear need ties.
    pub section: &'a Section,
    /// Column or beam.
    pub member: Member,
    /// Length between the faces of the adjacent members, > 0 \[m\]. The moment is taken to vanish in its middle, so that
    /// the shear span is half of it.
    pub clear_length: f64,
    /// Level of the strengths in `section`.
    pub level: StrengthLevel,
}

impl RatedMember<'_> {
    /// Distance from the end to the point without moment \[m\].
    #[must_use]
    pub fn shear_span(&self) -> f64 {
        0.5 * self.clear_length
    }

    /// The smaller of the effective depths under positive and negative moments \[m\].
    #[must_use]
    pub fn effective_depth(&self) -> f64 {
        let positive = formula::effective_depth(self.section);
        positive.min(formula::effective_depth(&self.section.flipped()))
    }

    /// Yield force of the ties per length of the member, As fy / s \[N/m\]; `None` without ties.
    fn tie_force(&self) -> Option<f64> {
        let ties = self.section.ties?;
        Some(ties.area() * self.section.steel.yield_strength / ties.spacing)
    }
}

/// A code or a published model for the shear strength of members.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShearRule {
    /// GB 50010-2010 with GB 50011-2010.
    Gb50010,
    /// EN 1998-3:2005, annex A.
    En1998,
    /// ASCE/SEI 41-17.
    Asce41,
    /// ACI 318-14.
    Aci318,
    /// Sezen and Moehle (2004).
    SezenMoehle,
}

impl ShearRule {
    /// Every rule, in the order of the documentation.
    pub const ALL: [Self; 5] = [
        Self::Gb50010,
        Self::En1998,
        Self::Asce41,
        Self::Aci318,
        Self::SezenMoehle,
    ];

    /// The rule for existing members of the country of a grade of reinforcing steel; `None` for a grade that is not known.
    #[must_use]
    pub fn of_steel(grade: &str) -> Option<Self> {
        let lists: [(&[&str], Self); 3] = [
            (&STEEL_GRADES, Self::Gb50010),
            (&EN_STEEL_GRADES, Self::En1998),
            (&ASTM_STEEL_GRADES, Self::Asce41),
        ];
        let row = lists
            .into_iter()
            .find(|(grades, _)| grades.contains(&grade));
        row.map(|(_, rule)| rule)
    }

    /// The rule of a name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|rule| rule.name() == name)
    }

    /// As a model file spells it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Gb50010 => "gb50010",
            Self::En1998 => "en1998-3",
            Self::Asce41 => "asce41",
            Self::Aci318 => "aci318",
            Self::SezenMoehle => "sezen-moehle",
        }
    }

    /// Its document and clauses.
    #[must_use]
    pub const fn source(self) -> &'static str {
        match self {
            Self::Gb50010 => "GB 50010-2010, 11.3.3, 11.3.4 and 11.4.6 to 11.4.8",
            Self::En1998 => "EN 1998-3:2005, A.3.3.1, Eq. (A.12)",
            Self::Asce41 => "ASCE/SEI 41-17, Eq. (10-3); beams by ACI 318-14",
            Self::Aci318 => "ACI 318-14, 22.5 and 18.7.6.2.1",
            Self::SezenMoehle => "Sezen and Moehle (2004)",
        }
    }

    /// Shear strength under an axial compression \[N\] (tension negative). `None` where the rule does not apply: members
    /// without ties, and beams by Sezen and Moehle.
    #[must_use]
    pub fn strength(self, member: &RatedMember<'_>, compression: f64) -> Option<ShearStrength> {
        match self {
            Self::Gb50010 => gb50010::strength(member, compression),
            Self::En1998 => en1998::strength(member, compression),
            Self::Asce41 => asce41::strength(member, compression),
            Self::Aci318 => aci318::strength(member, compression),
            Self::SezenMoehle => sezen_moehle::strength(member, compression),
        }
    }

    /// How the degrading part of the strength falls with ductility.
    #[must_use]
    pub const fn degradation(self) -> Degradation {
        match self {
            Self::Gb50010 | Self::Aci318 => Degradation::None,
            Self::En1998 => Degradation::Plastic,
            Self::Asce41 | Self::SezenMoehle => Degradation::Ductility,
        }
    }

    /// Factor on the moment capacity: 1/γRE of GB 50010, table 11.1.6, for design strengths; 1 otherwise \[–\].
    #[must_use]
    pub fn bending_factor(self, member: &RatedMember<'_>, compression: f64) -> f64 {
        match self {
            Self::Gb50010 => 1.0 / gb50010::bending_reduction(member, compression),
            _ => 1.0,
        }
    }
}

/// The rule for members of steel.
const AISC_360: &str = "aisc360";

/// A rule for the capacity of members.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CapacityRule {
    /// Of reinforced concrete.
    Reinforced(ShearRule),
    /// AISC 360-16, of steel profiles.
    Aisc360,
}

impl CapacityRule {
    /// Every rule, in the order of the documentation.
    pub const ALL: [Self; 6] = {
        let [a, b, c, d, e] = ShearRule::ALL;
        [
            Self::Reinforced(a),
            Self::Reinforced(b),
            Self::Reinforced(c),
            Self::Reinforced(d),
            Self::Reinforced(e),
            Self::Aisc360,
        ]
    };

    /// The rule of a name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|rule| rule.name() == name)
    }

    /// As a model file spells it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Reinforced(rule) => rule.name(),
            Self::Aisc360 => AISC_360,
        }
    }

    /// Its document and clauses.
    #[must_use]
    pub const fn source(self) -> &'static str {
        match self {
            Self::Reinforced(rule) => rule.source(),
            Self::Aisc360 => "AISC 360-16, chapters E to H",
        }
    }

    /// The rule for reinforced concrete, if it is one.
    #[must_use]
    pub const fn reinforced(self) -> Option<ShearRule> {
        match self {
            Self::Reinforced(rule) => Some(rule),
            Self::Aisc360 => None,
        }
    }
}

/// How a strength falls with the ductility μ of the member end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Degradation {
    /// It does not.
    None,
    /// By 1 − 0.05 min(5, μ − 1): EN 1998-3, (A.12).
    Plastic,
    /// By k: 1 up to μ = 2, 0.7 from μ = 6 on, linear between: Sezen and Moehle, ASCE 41.
    Ductility,
}

impl Degradation {
    /// Factor on the degrading part of the strength \[–\].
    #[must_use]
    pub fn factor(self, ductility: f64) -> f64 {
        match self {
            Self::None => 1.0,
            Self::Plastic => 1.0 - 0.05 * (ductility - 1.0).clamp(0.0, 5.0),
            Self::Ductility => 1.0 - 0.3 * ((ductility - 2.0) / 4.0).clamp(0.0, 1.0),
        }
    }
}

/// Shear strength in two parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearStrength {
    /// Part that ductility does not reduce \[N\].
    pub steady: f64,
    /// Part that falls with ductility \[N\].
    pub degrading: f64,
    /// Greatest strength that the rule allows; infinite without a bound \[N\].
    pub limit: f64,
}

impl ShearStrength {
    /// Strength of an end that has not yielded \[N\].
    #[must_use]
    pub fn initial(&self) -> f64 {
        self.at(1.0)
    }

    /// Strength with a factor on the degrading part \[N\].
    #[must_use]
    pub fn at(&self, factor: f64) -> f64 {
        (self.steady + factor * self.degrading).min(self.limit)
    }
}

/// A pascal in MPa.
const MPA: f64 = 1e-6;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Concrete, Reinforcement, Steel, Ties};

    /// 500 × 500 mm, C30 (20.1 and 2.01 MPa) and HRB400, 12 d20, two-leg ties d10 @ 150 mm, 2.7 m clear; effective depth
    /// 460 mm. Two legs of 10 mm are 157.08 mm².
    fn column(level: StrengthLevel) -> Section {
        let concrete = Concrete::grade("C30", level).expect("known");
        let steel = Steel::grade("HRB400", level).expect("known");
        let bars = Reinforcement::parse("12 d20").expect("understood");
        let ties = Ties::parse("d10 @ 150 mm").expect("understood");
        Section::new(0.5, 0.5, concrete, steel, &bars, 0.03, Some(ties)).expect("sound")
    }

    /// 300 × 600 mm, 4 d20 at either face, two-leg ties d8 @ 100 mm (100.53 mm²); effective depth 560 mm; 5.5 m clear.
    fn beam() -> Section {
        let concrete = Concrete::grade("C30", StrengthLevel::Characteristic).expect("known");
        let steel = Steel::grade("HRB400", StrengthLevel::Characteristic).expect("known");
        let bars = Reinforcement::parse("4 d20 top, 4 d20 bottom").expect("understood");
        let ties = Ties::parse("d8 @ 100 mm").expect("understood");
        Section::new(0.3, 0.6, concrete, steel, &bars, 0.03, Some(ties)).expect("sound")
    }

    fn rated(section: &Section, member: Member) -> RatedMember<'_> {
        RatedMember {
            section,
            member,
            clear_length: if member == Member::Column { 2.7 } else { 5.5 },
            level: StrengthLevel::Characteristic,
        }
    }

    #[track_caller]
    fn close(value: f64, due: f64) {
        // Hand calculations carry five digits.
        assert!((value / due - 1.0).abs() < 2e-4, "{value} instead of {due}");
    }

    #[test]
    fn gb_50010_by_hand() {
        let section = column(StrengthLevel::Characteristic);
        let column = rated(&section, Member::Column);
        let shear = |load: f64| {
            let strength = ShearRule::Gb50010.strength(&column, load);
            strength.expect("it has ties").initial()
        };
        // λ = 2700/(2 · 460) = 2.9348.
        // Concrete: 1.05/3.9348 · 2.01 · 500 · 460 = 123 363 N.
        // Ties: 400 · 157.08/150 · 460 = 192 685 N.
        // Under 1000 kN: 0.056 · 1 000 000 = 56 000 N; 0.3 fc A = 0.3 · 20.1 · 250 000 = 1 507 500 N.
        close(shear(1e6), 372_048.0);
        close(shear(0.0), 316_048.0);
        // Beyond 0.3 fc A nothing is added: 0.056 · 1 507 500 = 84 420 N.
        close(shear(3e6), 400_468.0);
        // Tension of 400 kN: 316 048 − 0.2 · 400 000.
        close(shear(-4e5), 236_048.0);
        // Tension of 800 kN would leave 156 048 N; not less than the ties, 192 685 N.
        close(shear(-8e5), 192_685.0);
        // Web crushing, λ > 2: 0.2 · 20.1 · 500 · 460 = 924 600 N.
        let strength = ShearRule::Gb50010.strength(&column, 0.0).expect("ties");
        close(strength.limit, 924_600.0);
        // A short column, λ = 1.5: 0.15 instead of 0.2.
        let short = RatedMember {
            clear_length: 3.0 * 0.46,
            ..column.clone()
        };
        let strength = ShearRule::Gb50010.strength(&short, 0.0).expect("ties");
        close(strength.limit, 693_450.0);
        // Beam: 0.42 · 2.01 · 300 · 560 = 141 826 N and 400 · 100.53/100 · 560 = 225 187 N.
        let section = beam();
        let beam = rated(&section, Member::Beam);
        let strength = ShearRule::Gb50010.strength(&beam, 0.0).expect("ties");
        close(strength.initial(), 367_013.0);
        close(strength.limit, 0.2 * 20.1 * 300.0 * 560.0);
    }

    #[test]
    fn gb_50010_divides_design_strengths() {
        // fc 14.3, ft 1.43, fy 360: 1.05/3.9348 · 1.43 · 230 000 = 87 766; 360 · 157.08/150 · 460 = 173 417;
        // 0.056 · 1 000 000; the sum 317 183 over γRE = 0.85.
        let section = column(StrengthLevel::Design);
        let column = RatedMember {
            level: StrengthLevel::Design,
            ..rated(&section, Member::Column)
        };
        let strength = ShearRule::Gb50010.strength(&column, 1e6).expect("ties");
        close(strength.initial(), 373_156.0);
        // N/(fc A) = 0.28 > 0.15: γRE = 0.8.
        close(ShearRule::Gb50010.bending_factor(&column, 1e6), 1.25);
        close(ShearRule::Gb50010.bending_factor(&column, 1e5), 1.0 / 0.75);
    }

    #[test]
    fn en_1998_3_by_hand() {
        let section = column(StrengthLevel::Characteristic);
        let column = rated(&section, Member::Column);
        let strength = ShearRule::En1998.strength(&column, 0.0).expect("ties");
        // LV/h = 1350/500 = 2.7. ρtot = 3769.9/(500 · 460) = 1.6391 %.
        // 0.16 · 1.6391 · (1 − 0.16 · 2.7) · √20.1 · 230 000 = 0.262256 · 0.568 · 4.48330 · 230 000 = 153 603 N.
        // Vw = 157.08/150 · (460 − 40) · 400 = 175 930 N. Sum 329 533 N over 1.15.
        close(strength.degrading, 286_550.0);
        assert_eq!(strength.steady, 0.0);
        // With N: (h − x)/(2 LV) min(N, 0.55 Ac fc); 0.55 · 230 000 · 20.1 = 2 542 650 N.
        let loaded = ShearRule::En1998.strength(&column, 1e6).expect("ties");
        close(loaded.degrading, strength.degrading);
        let axis = formula::yield_plane_section(&section, 1e6)
            .expect("yields")
            .neutral_axis;
        close(loaded.steady, (0.5 - axis) / 2.7 * 1e6 / 1.15);
        // Ductility 3: plastic part 2, factor 0.9. From 6 on 0.75.
        close(ShearRule::En1998.degradation().factor(3.0), 0.9);
        close(ShearRule::En1998.degradation().factor(9.0), 0.75);
        close(ShearRule::En1998.degradation().factor(0.5), 1.0);
    }

    #[test]
    fn asce_41_in_pounds_and_sezen_moehle_in_megapascals_agree() {
        let section = column(StrengthLevel::Characteristic);
        let column = rated(&section, Member::Column);
        let asce = ShearRule::Asce41.strength(&column, 1e6).expect("ties");
        // a/d = 1350/460 = 2.9348. 0.5 √20.1 = 2.24165 MPa; 1 + 1 000 000/(2.24165 · 250 000) = 2.78440, its root
        // 1.66865; 2.24165/2.9348 · 1.66865 · 0.8 · 250 000 = 254 912 N; ties 192 685 N.
        let sezen = ShearRule::SezenMoehle.strength(&column, 1e6).expect("ties");
        close(sezen.degrading, 447_597.0);
        // In pounds and inches: f'c = 2915.3 psi, 6 √ = 323.96 psi; N/(6 √f'c Ag) = 224 809/(323.96 · 387.50) = 1.79082;
        // 323.96/2.9348 · 1.67057 · 0.8 · 387.50 = 57 166 lb = 254 287 N; s/d = 0.326: all ties.
        close(asce.degrading, 446_972.0);
        assert_eq!(asce.steady, 0.0);
        // Ties 400 mm apart: s/d = 0.8696, so that 0.5217 of 400 · 157.08/400 · 460 = 72 257 N counts.
        let mut wide = section.clone();
        wide.ties = Ties::parse("d10 @ 400 mm").ok();
        let wide = RatedMember {
            section: &wide,
            ..column.clone()
        };
        close(
            ShearRule::Asce41
                .strength(&wide, 1e6)
                .expect("ties")
                .degrading,
            254_287.0 + 37_699.0,
        );
        // a/d below 2 counts as 2, above 4 as 4; tension is not counted.
        let slender = RatedMember {
            clear_length: 6.0,
            ..column.clone()
        };
        close(
            ShearRule::SezenMoehle
                .strength(&slender, -1e6)
                .expect("ties")
                .degrading,
            2.24165 / 4.0 * 200_000.0 + 192_685.0,
        );
        close(ShearRule::SezenMoehle.degradation().factor(4.0), 0.85);
        close(ShearRule::SezenMoehle.degradation().factor(7.0), 0.7);
        let section = beam();
        assert!(
            ShearRule::SezenMoehle
                .strength(&rated(&section, Member::Beam), 0.0)
                .is_none()
        );
    }

    #[test]
    fn aci_318_by_hand() {
        let section = column(StrengthLevel::Characteristic);
        let column = rated(&section, Member::Column);
        let shear = |load: f64| {
            let strength = ShearRule::Aci318.strength(&column, load);
            strength.expect("it has ties").initial()
        };
        // Under 1000 kN: 0.17 (1 + 1 000 000/(14 · 250 000)) √20.1 · 230 000 = 0.17 · 1.285714 · 4.48330 · 230 000
        // = 225 382 N; ties 192 685 N.
        close(shear(1e6), 418_067.0);
        // Below Ag f'c/20 = 251 250 N the concrete is not counted (18.7.6.2.1).
        close(shear(2e5), 192_685.0);
        // Ties of a capacity beyond 0.66 √f'c b d = 680 565 N are cut there.
        let mut strong = section.clone();
        strong.ties = Ties::parse("4 d12 @ 100 mm").ok();
        let strong = RatedMember {
            section: &strong,
            ..column.clone()
        };
        close(
            ShearRule::Aci318
                .strength(&strong, 0.0)
                .expect("ties")
                .initial(),
            680_565.0,
        );
        // Beam: nothing but the ties (18.6.5.2).
        let section = beam();
        let beam = ShearRule::Aci318.strength(&rated(&section, Member::Beam), 0.0);
        close(beam.expect("ties").initial(), 225_187.0);
    }

    #[test]
    fn rules_need_ties() {
        let mut section = column(StrengthLevel::Characteristic);
        section.ties = None;
        for rule in ShearRule::ALL {
            assert!(
                rule.strength(&rated(&section, Member::Column), 0.0)
                    .is_none()
            );
            assert_eq!(ShearRule::from_name(rule.name()), Some(rule));
        }
    }
}
