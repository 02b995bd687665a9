//! Rotations that codes accept at member ends, and the rotation at which the section crushes.

use jostle::model::{RotationLimits, RotationMeasure};

use super::{MPA, RatedMember, ShearRule, en1998};
use crate::curve::{EventKind, MomentCurvature, Options};
use crate::formula::{self, Member};
use crate::law;
use crate::section::Section;

impl RatedMember<'_> {
    /// Limits of rotations under an axial compression \[N\]: EN 1998-3 (DL, SD, NC), ASCE 41-17 (IO, LS, CP), and
    /// crushing of the section by the fibre analysis, each where its inputs are known.
    #[must_use]
    pub fn rotation_limits(&self, compression: f64) -> Vec<RotationLimits> {
        [
            self.en1998_rotations(compression),
            self.asce41_rotations(compression),
            self.crushing(compression),
        ]
        .into_iter()
        .flatten()
        .collect()
    }

    /// Chord rotations of EN 1998-3, A.3.2: yield, ¾ of the ultimate one, the ultimate one.
    fn en1998_rotations(&self, compression: f64) -> Option<RotationLimits> {
        let section = self.section;
        section.ties?;
        let ultimate = en1998_ultimate(self, compression);
        let yielding = en1998_yield(self, compression).min(ultimate);
        Some(RotationLimits {
            rule: ShearRule::En1998.name(),
            measure: RotationMeasure::Chord,
            limits: vec![
                ("DL", yielding),
                ("SD", (0.75 * ultimate).max(yielding)),
                ("NC", ultimate),
            ],
        })
    }

    /// Plastic rotations of ASCE 41-17, table 10-8, for columns whose ties are anchored in the core and whose bars are not
    /// spliced.
    fn asce41_rotations(&self, compression: f64) -> Option<RotationLimits> {
        if self.member == Member::Beam {
            return self.asce41_beam();
        }
        let section = self.section;
        let ties = section.ties?;
        let strength = ShearRule::Asce41.strength(self, compression)?.initial();
        let moment = super::Interaction::new(section).moment(compression);
        let shear = 2.0 * moment / self.clear_length;
        let [a, b] = asce41_parameters(
            section.axial_ratio(compression),
            ties.area() / (section.width * ties.spacing),
            section.concrete.strength / section.steel.yield_strength,
            shear / strength,
        );
        Some(RotationLimits {
            rule: ShearRule::Asce41.name(),
            measure: RotationMeasure::Plastic,
            limits: vec![
                ("IO", (0.15 * a).min(0.005)),
                ("LS", 0.5 * b),
                ("CP", 0.7 * b),
            ],
        })
    }

    /// Plastic rotations of ASCE 41-17, table 10-7, for beams controlled by flexure, for the side with the smaller limits; `None`
    /// for beams whose shear strength is below the shear at their flexural strength.
    fn asce41_beam(&self) -> Option<RotationLimits> {
        let section = self.section;
        let ties = section.ties?;
        let moments = super::Interaction::of_both_signs(section).map(|curve| curve.moment(0.0));
        let shear = (moments[0] + moments[1]) / self.clear_length;
        let strength = ShearRule::Asce41.strength(self, 0.0)?.initial();
        if shear > strength {
            return None;
        }
        let depth = self.effective_depth();
        let by_ties = ties.area() * section.steel.yield_strength * depth / ties.spacing;
        let conforming = ties.spacing <= depth / 3.0 && by_ties >= 0.75 * shear;
        let stress = shear / (section.width * depth);
        let sides = [section, &section.flipped()].map(|side| {
            let ratio = |steel: f64| steel / (section.width * formula::effective_depth(side));
            let bars = [side, &side.flipped()]
                .map(formula::tension_steel)
                .map(ratio);
            let balance = (bars[0] - bars[1]) / balanced_ratio(section);
            asce41_beam_limits(balance, stress, MPA * section.concrete.strength, conforming)
        });
        let [io, ls, cp] = [0, 1, 2].map(|level| sides[0][level].min(sides[1][level]));
        Some(RotationLimits {
            rule: ShearRule::Asce41.name(),
            measure: RotationMeasure::Plastic,
            limits: vec![("IO", io), ("LS", ls), ("CP", cp)],
        })
    }

    /// Plastic rotation at which the outermost concrete, or the confined core, is crushed or the moment has fallen to 0.8 of
    /// its peak because the concrete around it is: the curvature after yield over a
    /// plastic hinge of 0.08 Ls + 0.022 fy db (Paulay and Priestley 1992), for the weaker side. `None` where a bar breaks
    /// first or the section cannot be analysed.
    fn crushing(&self, compression: f64) -> Option<RotationLimits> {
        let side = |section: &Section| {
            let curve = MomentCurvature::new(section, compression, Options::default()).ok()?;
            let crushed = curve.event(EventKind::Crushing);
            let crushed = crushed.or(curve.event(EventKind::Softened))?;
            let fit = curve.trilinear().ok()?;
            let span = self.shear_span();
            let bars = section.bars.iter();
            let thickest = bars.fold(0.0_f64, |most, bar| most.max(bar.diameter));
            let plastic = 0.08 * span + 0.022 * MPA * section.steel.yield_strength * thickest;
            let lever = plastic * (1.0 - 0.5 * plastic / span).max(0.5);
            Some((crushed.curvature - fit.yielding.deformation).max(0.0) * lever)
        };
        let sides = [side(self.section), side(&self.section.flipped())];
        let least = sides.into_iter().flatten().min_by(f64::total_cmp)?;
        Some(RotationLimits {
            rule: "section",
            measure: RotationMeasure::Plastic,
            limits: vec![("crushing", least)],
        })
    }
}

/// γel of primary seismic elements for ultimate rotations.
const ELEMENT_FACTOR: f64 = 1.5;

/// Ultimate chord rotation of EN 1998-3, (A.1), of members detailed for earthquakes, without diagonal bars:
///
/// ```text
/// θum = 1/γel 0.016 · 0.3^ν [max(0.01, ω′)/max(0.01, ω) fc]^0.225 (min(9, LV/h))^0.35 25^(α ρsx fyw/fc)    [MPa]
/// ```
/// ω holds the bars in tension and those between the faces. Confinement α by the bars in the corners. For the side with the
/// smaller rotation.
fn en1998_ultimate(member: &RatedMember<'_>, compression: f64) -> f64 {
    let section = member.section;
    let Some(ties) = section.ties else {
        return 0.0;
    };
    let strength = section.concrete.strength;
    let ratio = |steel: f64| steel * section.steel.yield_strength / (section.area() * strength);
    let faces = [section, &section.flipped()].map(formula::tension_steel);
    let between = (section.steel_area() - faces[0] - faces[1]).max(0.0);
    let (width, depth) = law::core(section);
    let plan = (1.0 - (width * width + depth * depth) / (3.0 * width * depth)).max(0.0);
    let arches = [width, depth].map(|side| (1.0 - 0.5 * ties.spacing / side).max(0.0));
    let confinement = plan * arches[0] * arches[1] * ties.area() / (section.width * ties.spacing)
        * section.steel.yield_strength
        / strength;
    let axial = section.axial_ratio(compression).max(0.0);
    let common = 0.016
        * libm::pow(0.3_f64, axial)
        * libm::pow((member.shear_span() / section.depth).min(9.0), 0.35)
        * libm::pow(25.0_f64, confinement)
        / ELEMENT_FACTOR;
    let of = |tension: f64, opposite: f64| {
        let bars = ratio(opposite).max(0.01) / ratio(tension + between).max(0.01);
        common * libm::pow(bars * MPA * strength, 0.225)
    };
    of(faces[0], faces[1]).min(of(faces[1], faces[0]))
}

/// Chord rotation at yield of EN 1998-3, (A.10b), without a shear crack before yield, in MPa and m:
///
/// ```text
/// θy = φy LV/3 + 0.0014 (1 + 1.5 h/LV) + φy db fy/(8 √fc)
/// ```
fn en1998_yield(member: &RatedMember<'_>, compression: f64) -> f64 {
    let section = member.section;
    let span = member.shear_span();
    let thickest = section
        .bars
        .iter()
        .fold(0.0_f64, |most, bar| most.max(bar.diameter));
    let root = (MPA * section.concrete.strength).sqrt();
    let slip = thickest * MPA * section.steel.yield_strength / (8.0 * root);
    let side = |section: &Section| en1998::yielding(section, compression).1;
    let curvature = side(section).min(side(&section.flipped()));
    curvature * span / 3.0 + 0.0014 * (1.0 + 1.5 * section.depth / span) + curvature * slip
}

/// Parameters a and b of ASCE 41-17, table 10-8, rectangular columns:
///
/// ```text
/// a = 0.042 − 0.043 ν + 0.63 ρt − 0.023 VyE/VColOE ≥ 0
/// b = 0.5/(5 + ν/0.8 · 1/ρt · f'c/fyt) − 0.01 ≥ a for ν ≤ 0.5; linear to 0 at ν = 0.7 beyond, as a is
/// ```
/// with ν ≥ 0.1, 0.0005 ≤ ρt ≤ 0.0175 and VyE/VColOE ≥ 0.2. Columns whose shear at yield exceeds their strength have a = 0.
fn asce41_parameters(axial: f64, ties: f64, strengths: f64, shear: f64) -> [f64; 2] {
    let within = |axial: f64| {
        let ties = ties.clamp(0.0005, 0.0175);
        let a = (0.042 - 0.043 * axial + 0.63 * ties - 0.023 * shear.max(0.2)).max(0.0);
        let b = 0.5 / (5.0 + axial / 0.8 / ties * strengths) - 0.01;
        [a, b.max(a)]
    };
    if axial <= 0.5 {
        return within(axial.max(0.1));
    }
    let share = ((0.7 - axial) / 0.2).max(0.0);
    within(0.5).map(|value| share * value)
}

/// Ratio of tension bars at which concrete crushes as they yield: 0.85 β₁ f'c/fy · 600/(600 + fy) in MPa, with β₁ of ACI 318
/// \[–\].
fn balanced_ratio(section: &Section) -> f64 {
    let [strength, steel] =
        [section.concrete.strength, section.steel.yield_strength].map(|stress| MPA * stress);
    let block = (0.85 - 0.05 * (strength - 28.0) / 7.0).clamp(0.65, 0.85);
    0.85 * block * strength / steel * 600.0 / (600.0 + steel)
}

/// IO, LS and CP of ASCE 41-17, table 10-7, condition i: with conforming ties or not, (ρ − ρ′)/ρbal ≤ 0 or ≥ 0.5, and
/// V/(b d √f'c) ≤ 3 or ≥ 6 in pounds and inches.
const BEAMS: [[[[f64; 3]; 2]; 2]; 2] = [
    [
        [[0.005, 0.02, 0.03], [0.0015, 0.01, 0.015]],
        [[0.005, 0.01, 0.015], [0.0015, 0.005, 0.01]],
    ],
    [
        [[0.01, 0.025, 0.05], [0.005, 0.02, 0.04]],
        [[0.005, 0.02, 0.03], [0.005, 0.015, 0.02]],
    ],
];
/// A psi in MPa.
const PSI: f64 = 0.006_894_757;

/// Limits by linear interpolation in the table; `stress`: shear over b d \[Pa\], `strength`: f'c \[MPa\].
fn asce41_beam_limits(balance: f64, stress: f64, strength: f64, conforming: bool) -> [f64; 3] {
    let shear = MPA * stress / PSI / (strength / PSI).sqrt();
    let [across, along] = [balance / 0.5, (shear - 3.0) / 3.0].map(|share| share.clamp(0.0, 1.0));
    let table = &BEAMS[usize::from(conforming)];
    [0, 1, 2].map(|level| {
        let row = |row: usize| {
            let [low, high] = [table[row][0][level], table[row][1][level]];
            low + along * (high - low)
        };
        row(0) + across * (row(1) - row(0))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Concrete, Reinforcement, Steel, StrengthLevel, Ties};

    fn column() -> Section {
        let concrete = Concrete::grade("C30", StrengthLevel::Characteristic).expect("known");
        let steel = Steel::grade("HRB400", StrengthLevel::Characteristic).expect("known");
        let bars = Reinforcement::parse("12 d20").expect("understood");
        let ties = Ties::parse("d10 @ 150 mm").ok();
        Section::new(0.5, 0.5, concrete, steel, &bars, 0.03, ties).expect("sound")
    }

    fn rated(section: &Section) -> RatedMember<'_> {
        RatedMember {
            section,
            member: Member::Column,
            clear_length: 2.7,
            level: StrengthLevel::Characteristic,
        }
    }

    #[track_caller]
    fn close(value: f64, due: f64) {
        assert!((value / due - 1.0).abs() < 3e-4, "{value} instead of {due}");
    }

    #[test]
    fn asce_41_by_hand() {
        // ν = 0.199, ρt = 157.08/(500 · 150) = 0.0020944, f'c/fyt = 0.05025, shear ratio 0.8:
        // a = 0.042 − 0.008557 + 0.0013195 − 0.0184 = 0.0163625.
        // b = 0.5/(5 + 0.24875 · 477.46 · 0.05025) − 0.01 = 0.5/10.9682 − 0.01 = 0.035587.
        let [a, b] = asce41_parameters(0.199, 0.0020944, 0.05025, 0.8);
        close(a, 0.016_362_5);
        close(b, 0.035_587);
        // Half way from ν = 0.5 to 0.7: a = ½ (0.042 − 0.0215 + 0.0013195 − 0.0184) = 0.00170975.
        close(
            asce41_parameters(0.6, 0.0020944, 0.05025, 0.8)[0],
            0.001_709_75,
        );
        assert_eq!(asce41_parameters(0.71, 0.01, 0.05, 0.8), [0.0; 2]);
        let section = column();
        let limits = rated(&section).asce41_rotations(1e6).expect("ties").limits;
        assert!(
            limits[0].1 < limits[1].1 && limits[1].1 < limits[2].1,
            "{limits:?}"
        );
        close(limits[2].1 / limits[1].1, 1.4);
    }

    #[test]
    fn beams_by_asce_41_by_hand() {
        // On the rows of the table: 3 √psi = 0.249109 √MPa; f'c = 25 MPa, so 1.24555 and 2.4911 MPa.
        let of = |balance, stress, ties| asce41_beam_limits(balance, stress, 25.0, ties);
        assert_eq!(of(-0.2, 1e6, true), [0.01, 0.025, 0.05]);
        assert_eq!(of(0.6, 9e6, true), [0.005, 0.015, 0.02]);
        assert_eq!(of(0.0, 9e6, false), [0.0015, 0.01, 0.015]);
        assert_eq!(of(0.5, 1e6, false), [0.005, 0.01, 0.015]);
        // Half way between all four: LS (25 + 20 + 20 + 15)/4 mrad.
        let middle = of(0.25, 1.868_32e6, true);
        close(middle[1], 0.02);
        close(middle[2], 0.035);
        // 300 × 600 mm, 4 d20 and 2 d20 at 560 mm: (1256.64 − 628.32)/168 000 = 0.0037400. β₁ = 0.85 for 20.1 MPa:
        // ρbal = 0.85 · 0.85 · 20.1/400 · 0.6 = 0.0217834; 0.171690 of it, 0.343380 of the way.
        let concrete = Concrete::grade("C30", StrengthLevel::Characteristic).expect("known");
        let steel = Steel::grade("HRB400", StrengthLevel::Characteristic).expect("known");
        let bars = Reinforcement::parse("4 d20 top, 2 d20 bottom").expect("understood");
        let section = |ties: &str| {
            let ties = Ties::parse(ties).ok();
            Section::new(0.3, 0.6, concrete, steel, &bars, 0.03, ties).expect("sound")
        };
        close(balanced_ratio(&section("d8 @ 100 mm")), 0.021_783_4);
        let limits = |ties: &str| {
            let section = section(ties);
            let member = RatedMember {
                member: Member::Beam,
                clear_length: 5.5,
                ..rated(&section)
            };
            member
                .asce41_rotations(0.0)
                .map(|asce41_rotation| asce41_rotation.limits)
        };
        // Ties at 100 ≤ 560/3 mm carry more than the shear of hinges at both ends, which is below 3 √f'c: conforming.
        let conforming = limits("d8 @ 100 mm").expect("by flexure");
        close(conforming[1].1, 0.025 - 0.343_380 * 0.005);
        close(conforming[2].1, 0.05 - 0.343_380 * 0.02);
        // At 250 mm they do not.
        let other = limits("d8 @ 250 mm").expect("by flexure");
        close(other[2].1, 0.03 - 0.343_380 * 0.015);
        // Shear fails first.
        assert_eq!(limits("d6 @ 500 mm"), None);
    }

    #[test]
    fn en_1998_by_hand() {
        let section = column();
        let member = rated(&section);
        // ν = 1000/5025 = 0.19900; eight bars in tension and between, four opposite: ω′/ω = 0.5; LV/h = 2.7.
        // α = (1 − 150/900)² (1 − 4 · 450²/(6 · 450²)) = 0.69444/3 = 0.23148; ρsx = 0.0020944;
        // α ρsx fyw/fc = 0.0096480; 25^0.0096480 = 1.03154.
        // 0.016 · 0.3^0.199 · (0.5 · 20.1)^0.225 · 2.7^0.35 · 1.03154/1.5
        // = 0.016 · 0.78693 · 1.68064 · 1.41566 · 1.03154/1.5 = 0.020601.
        close(en1998_ultimate(&member, 1e6), 0.020_601);
        // θy with φy of the plane section: φy 1.35/3 + 0.0014 (1 + 1.5/2.7) + φy · 0.02 · 400/(8 · 4.48330).
        let curvature = formula::yield_plane_section(&section, 1e6)
            .expect("yields")
            .curvature;
        close(
            en1998_yield(&member, 1e6),
            curvature * (0.45 + 0.223_050) + 0.002_177_78,
        );
        let limits = member.en1998_rotations(1e6).expect("ties").limits;
        close(limits[1].1, 0.75 * 0.020_601);
    }

    #[test]
    fn sections_crush_after_they_yield() {
        let section = column();
        let limits = rated(&section).rotation_limits(1e6);
        let crushing = limits
            .iter()
            .find(|limits| limits.rule == "section")
            .expect("crushes");
        // (φu − φy) Lp: with Lp = 0.08 · 1.35 + 0.022 · 400 · 0.02 = 0.284 m.
        assert!((0.005..0.1).contains(&crushing.limits[0].1), "{crushing:?}");
        // More axial force, less rotation.
        let more = rated(&section).crushing(2.5e6).expect("crushes").limits[0].1;
        assert!(more < crushing.limits[0].1);
    }
}
