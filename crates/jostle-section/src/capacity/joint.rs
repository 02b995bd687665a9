//! Shear capacity of the cores of beam–column joints.

use std::cell::RefCell;
use std::collections::BTreeMap;

use jostle::model::{CapacityLine, RuleCapacity, ShearCapacity};

use super::lines::line_over;
use super::{MPA, ShearRule, gb50010};
use crate::concrete::StrengthLevel;
use crate::formula;
use crate::section::Section;

/// A beam–column joint in the plane of a frame. Its ties are those of the column below, continued through the core; beams
/// across the plane are not counted.
#[derive(Clone, Debug, PartialEq)]
pub struct RatedJoint<'a> {
    /// Section of the column below the joint; rules need its ties.
    pub column: &'a Section,
    /// Sections of the beams on the left and on the right.
    pub beams: [Option<&'a Section>; 2],
    /// Level of the strengths in `column`.
    pub level: StrengthLevel,
}

/// Capacity of a joint in two parts: by its concrete and ties, and the greatest that the rule allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointStrength {
    /// Shear that concrete and ties resist \[N\].
    pub resistance: f64,
    /// Upper bound by crushing of the concrete; infinite where the rule has none \[N\].
    pub limit: f64,
}

impl JointStrength {
    /// The smaller of both \[N\].
    #[must_use]
    pub fn least(self) -> f64 {
        self.resistance.min(self.limit)
    }
}

impl RatedJoint<'_> {
    /// Distance between the tension bars and the compression bars of a beam at the joint: the lever arm by which its moment
    /// becomes a force in the core, hb0 − as′ of GB 50010 \[m\].
    #[must_use]
    pub fn lever(beam: &Section) -> f64 {
        let depth = |section: &Section| formula::effective_depth(section);
        let opposite = beam.depth - depth(&beam.flipped());
        (depth(beam) - opposite).max(0.1 * beam.depth)
    }

    fn beams(&self) -> impl Iterator<Item = &Section> {
        self.beams.iter().flatten().copied()
    }

    /// Width of the narrower beam; zero without beams \[m\].
    fn beam_width(&self) -> f64 {
        let widths = self.beams().map(|beam| beam.width);
        widths.min_by(f64::total_cmp).unwrap_or(0.0)
    }

    /// Shortest lever arm of the beams \[m\].
    fn least_lever(&self) -> f64 {
        let levers = self.beams().map(Self::lever);
        levers.min_by(f64::total_cmp).unwrap_or(0.0)
    }

    /// Whether beams frame into two opposite faces.
    fn is_interior(&self) -> bool {
        self.beams.iter().all(Option::is_some)
    }

    /// Area of the ties per length, Asvj/s \[m\].
    fn ties(&self) -> Option<f64> {
        let ties = self.column.ties?;
        Some(ties.area() / ties.spacing)
    }

    /// Shear strength by a rule under the compression of the column above \[N\] (tension negative). `None` without ties,
    /// without beams, and by the rules for members only.
    #[must_use]
    pub fn strength(&self, rule: ShearRule, compression: f64) -> Option<JointStrength> {
        let ties = self.ties()?;
        self.beams().next()?;
        match rule {
            ShearRule::Gb50010 => Some(self.by_gb50010(ties, compression)),
            ShearRule::En1998 => Some(self.by_en1998(ties, compression)),
            ShearRule::Aci318 => Some(self.by_aci318()),
            ShearRule::Asce41 | ShearRule::SezenMoehle => None,
        }
    }

    /// GB 50010-2010, (11.6.3) and (11.6.4-2), with GB 50011-2010, D.1:
    ///
    /// ```text
    /// Vj ≤ 1/γRE [1.1 ηj ft bj hj + 0.05 ηj N bj/bc + fyv Asvj (hb0 − as′)/s] ≤ 1/γRE 0.30 ηj βc fc bj hj
    /// ```
    /// with ηj = 1, 0 ≤ N ≤ 0.5 fc bc hc, and bj = bc, or min(bb + 0.5 hc, bc) for beams narrower than half the column.
    fn by_gb50010(&self, ties: f64, compression: f64) -> JointStrength {
        let (column, concrete) = (self.column, &self.column.concrete);
        let (wide, deep) = (column.width, column.depth);
        let beam = self.beam_width();
        let width = if beam >= 0.5 * wide {
            wide
        } else {
            wide.min(beam + 0.5 * deep)
        };
        let load = compression.clamp(0.0, 0.5 * concrete.strength * wide * deep);
        let by_concrete = 1.1 * concrete.tensile_strength * width * deep;
        let by_ties = gb50010::tie_strength(column, self.level) * ties * self.least_lever();
        let resistance = by_concrete + 0.05 * load * width / wide + by_ties;
        let reduction = gb50010::shear_reduction(self.level);
        let strong = gb50010::strength_factor(column);
        JointStrength {
            resistance: resistance / reduction,
            limit: 0.30 * strong * concrete.strength * width * deep / reduction,
        }
    }

    /// EN 1998-1:2004, 5.5.3.3, (5.33) to (5.35):
    ///
    /// ```text
    /// Vjh ≤ η fc √(1 − νd/η) bj hjc, η = 0.6 (1 − fc/250)                    [MPa]; 0.8 of it in joints with one beam
    /// Vjh ≤ bj hjc √[(fct + νd fc)(fct + Ash fyw/(bj hjw))]
    /// ```
    /// hjc is the distance between the outermost bars of the column, hjw that between the bars of the beam; Ash fyw/(bj hjw)
    /// is fyw Ash/s over bj for ties at a spacing s.
    fn by_en1998(&self, ties: f64, compression: f64) -> JointStrength {
        let (column, concrete) = (self.column, &self.column.concrete);
        let (wide, deep) = (column.width, column.depth);
        let beam = self.beam_width();
        let width = if wide > beam {
            wide.min(beam + 0.5 * deep)
        } else {
            beam.min(wide + 0.5 * deep)
        };
        let depths = column.bars.iter().map(|bar| bar.depth);
        let [least, most] = depths.fold([deep, 0.0], |[least, most], depth| {
            [f64::min(least, depth), f64::max(most, depth)]
        });
        let area = width * (most - least).max(0.0);
        let strength = concrete.strength;
        let axial = (compression / (wide * deep * strength)).max(0.0);
        let reduction = 0.6 * (1.0 - MPA * strength / 250.0);
        let of_place = if self.is_interior() { 1.0 } else { 0.8 };
        let crushing = reduction * strength * (1.0 - axial / reduction).max(0.0).sqrt() * area;
        let tensile = concrete.tensile_strength;
        let confined = tensile + column.steel.yield_strength * ties / width;
        JointStrength {
            resistance: area * ((tensile + axial * strength) * confined).sqrt(),
            limit: of_place * crushing,
        }
    }

    /// ACI 318-14, table 18.8.4.1: γ √f'c Aj in MPa; γ = 1.2 with beams on two opposite faces, each at least ¾ of the effective
    /// width, otherwise 1.0; Aj = hc min(bc, bb + hc), φ = 1.
    fn by_aci318(&self) -> JointStrength {
        let column = self.column;
        let beam = self.beam_width();
        let width = column.width.min(beam + column.depth);
        let confined = self.is_interior() && beam >= 0.75 * width;
        let factor = if confined { 1.2 } else { 1.0 };
        let root = (MPA * column.concrete.strength).sqrt() / MPA;
        JointStrength {
            resistance: factor * root * width * column.depth,
            limit: f64::INFINITY,
        }
    }

    /// Capacity by some rules, as straight lines over the compression of the column above; rules without one are left out.
    #[must_use]
    pub fn capacities(&self, rules: &[ShearRule]) -> Vec<RuleCapacity> {
        let known = rules.iter().filter_map(|&rule| {
            self.strength(rule, 0.0)?;
            let memory: RefCell<BTreeMap<u64, f64>> = RefCell::default();
            let strength = line_over(self.column, |load| {
                let mut memory = memory.borrow_mut();
                *memory.entry(load.to_bits()).or_insert_with(|| {
                    let strength = self.strength(rule, load);
                    strength.map_or(0.0, JointStrength::least)
                })
            });
            let none = || CapacityLine::new(vec![[0.0, f64::INFINITY]]);
            Some(RuleCapacity {
                rule: rule.name(),
                shear: Some(ShearCapacity {
                    steady: strength,
                    degrading: CapacityLine::default(),
                    by_ductility: CapacityLine::default(),
                    limit: f64::INFINITY,
                }),
                bending: [none(), none()],
                across: None,
            })
        });
        known.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Concrete, Reinforcement, Steel, Ties};

    /// 500 × 500 mm, C30 (20.1 and 2.01 MPa), HRB400, 12 d20 at 40 mm, two-leg ties d10 @ 100 mm: fy Ash/s = 628 319 N/m.
    fn column(level: StrengthLevel) -> Section {
        section("12 d20", [0.5, 0.5], "d10 @ 100 mm", level)
    }

    /// Bars at 40 mm of either face: 600 deep, the lever arm is 520 mm.
    fn beam(width: f64) -> Section {
        let level = StrengthLevel::Characteristic;
        section(
            "4 d20 top, 4 d20 bottom",
            [width, 0.6],
            "d8 @ 100 mm",
            level,
        )
    }

    fn section(bars: &str, size: [f64; 2], ties: &str, level: StrengthLevel) -> Section {
        let concrete = Concrete::grade("C30", level).expect("known");
        let steel = Steel::grade("HRB400", level).expect("known");
        let bars = Reinforcement::parse(bars).expect("understood");
        let ties = Ties::parse(ties).ok();
        Section::new(size[0], size[1], concrete, steel, &bars, 0.03, ties).expect("sound")
    }

    #[track_caller]
    fn close(value: f64, due: f64) {
        // Hand calculations carry five digits.
        assert!((value / due - 1.0).abs() < 2e-4, "{value} instead of {due}");
    }

    fn joint<'a>(column: &'a Section, beams: [Option<&'a Section>; 2]) -> RatedJoint<'a> {
        RatedJoint {
            column,
            beams,
            level: StrengthLevel::Characteristic,
        }
    }

    #[test]
    fn gb_50010_by_hand() {
        let (column, wide, narrow) = (column(StrengthLevel::Characteristic), beam(0.3), beam(0.2));
        let of = |beam, load| {
            let joint = joint(&column, [Some(beam), Some(beam)]);
            joint.strength(ShearRule::Gb50010, load).expect("ties")
        };
        // 300 ≥ 250 mm: bj = 500. 1.1 · 2.01 · 250 000 = 552 750 N; ties 628 319 · 0.52 = 326 726 N.
        close(of(&wide, 0.0).resistance, 879_476.0);
        // 1000 kN: 0.05 · 1 000 000 = 50 000 N. More than 0.5 · 20.1 · 250 000 = 2 512 500 N counts no more.
        close(of(&wide, 1e6).resistance, 929_476.0);
        close(of(&wide, 4e6).resistance, 879_476.0 + 125_625.0);
        // Tension: N = 0.
        close(of(&wide, -5e5).resistance, 879_476.0);
        // 0.30 · 20.1 · 250 000 = 1 507 500 N.
        close(of(&wide, 0.0).limit, 1_507_500.0);
        // 200 < 250 mm: bj = min(200 + 250, 500) = 450: 497 475 + 50 000 · 0.9 + 326 726.
        close(of(&narrow, 1e6).resistance, 869_201.0);
        close(of(&narrow, 1e6).limit, 1_356_750.0);
        // Design: 14.3 and 1.43 MPa, 360 MPa; (1.1 · 1.43 · 250 000 + 565 487 · 0.52)/0.85 = (393 250 + 294 053)/0.85.
        let design = self::column(StrengthLevel::Design);
        let strength = RatedJoint {
            level: StrengthLevel::Design,
            ..joint(&design, [Some(&wide), None])
        };
        let strength = strength.strength(ShearRule::Gb50010, 0.0).expect("ties");
        close(strength.resistance, 808_592.0);
        close(strength.limit, 0.3 * 14.3 * 250_000.0 / 0.85);
    }

    #[test]
    fn en_1998_1_by_hand() {
        let (column, beam) = (column(StrengthLevel::Characteristic), beam(0.3));
        let of = |beams, load| {
            let strength = joint(&column, beams).strength(ShearRule::En1998, load);
            strength.expect("ties")
        };
        let both = [Some(&beam), Some(&beam)];
        // bj = min(500, 300 + 250) = 500; hjc = 500 − 2 · 40 = 420; η = 0.6 (1 − 20.1/250) = 0.55176.
        // νd = 1 000 000/(250 000 · 20.1) = 0.19900; √(1 − 0.36067) = 0.79958;
        // 0.55176 · 20.1 · 0.79958 · 210 000 = 1 862 200 N.
        close(of(both, 1e6).limit, 1_862_200.0);
        close(of([Some(&beam), None], 1e6).limit, 0.8 * 1_862_200.0);
        // Without compression 0.55176 · 20.1 · 210 000 = 2 328 979 N; crushed at νd = η.
        close(of(both, -1e5).limit, 2_328_979.0);
        assert_eq!(of(both, 2.8e6).limit, 0.0);
        // Ties: 628 319/0.5 = 1.25664 MPa; (2.01 + 4.0)(2.01 + 1.25664) = 19.6325, root 4.43086; · 210 000 = 930 480 N.
        close(of(both, 1e6).resistance, 930_480.0);
        // Without compression √(2.01 · 3.26664) = 2.56242; 538 108 N.
        close(of(both, 0.0).resistance, 538_108.0);
    }

    #[test]
    fn aci_318_by_hand() {
        let column = column(StrengthLevel::Characteristic);
        let of = |beams| {
            let strength = joint(&column, beams).strength(ShearRule::Aci318, 7e5);
            strength.expect("ties").least()
        };
        let (wide, narrow) = (beam(0.4), beam(0.3));
        // bj = min(500, 400 + 500) = 500; 400 ≥ 375: 1.2 · 4.48330 · 250 000 = 1 344 990 N.
        close(of([Some(&wide), Some(&wide)]), 1_344_990.0);
        // 300 < 375, or one beam: 1.0.
        close(of([Some(&wide), Some(&narrow)]), 1_120_825.0);
        close(of([None, Some(&wide)]), 1_120_825.0);
    }

    #[test]
    fn lines_follow_the_rules_and_rules_for_members_are_left_out() {
        let (column, beam) = (column(StrengthLevel::Characteristic), beam(0.3));
        let joint = joint(&column, [Some(&beam), Some(&beam)]);
        let rules = joint.capacities(&ShearRule::ALL);
        let names: Vec<_> = rules.iter().map(|rule| rule.rule).collect();
        assert_eq!(names, ["gb50010", "en1998-3", "aci318"]);
        for (rule, lines) in ShearRule::ALL
            .iter()
            .filter(|rule| names.contains(&rule.name()))
            .zip(&rules)
        {
            let shear = lines.shear.as_ref().expect("known");
            for step in 0..200 {
                let load = -5e5 + 1.6e4 * f64::from(step);
                let due = joint.strength(*rule, load).expect("ties").least();
                let found = shear.at(load, 1.0);
                assert!(
                    (found - due).abs() < 3e-4 * 1.5e6,
                    "{}: {found} for {due} at {load}",
                    rule.name()
                );
            }
            assert_eq!(lines.bending_ratio(1e6, [3e5, 0.0]), 0.0);
        }
        let mut bare = column.clone();
        bare.ties = None;
        assert!(
            RatedJoint {
                column: &bare,
                ..joint
            }
            .capacities(&ShearRule::ALL)
            .is_empty()
        );
    }
}
