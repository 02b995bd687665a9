//! Rotations that codes accept at member ends, and the rotation at which the section crushes.

use jostle::model::{RotationLimits, RotationMeasure};

use super::{MPA, RatedMember, ShearRule, en1998};
use crate::curve::{EventKind, MomentCurvature, Options};
use crate::formula::{self, Member};
use crate::law;
use crate::section::Section;

impl RatedMember<'_> {
    /// Limits of rotations under an axial compression \[N\]: EN 1998-3 (DL, SD, NC), ASCE 41-17 for columns (IO, LS, CP), and
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
            return None;
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
        * 0.3_f64.powf(axial)
        * (member.shear_span() / section.depth).min(9.0).powf(0.35)
        * 25.0_f64.powf(confinement)
        / ELEMENT_FACTOR;
    let of = |tension: f64, opposite: f64| {
        let bars = ratio(opposite).max(0.01) / ratio(tension + between).max(0.01);
        common * (bars * MPA * strength).powf(0.225)
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
