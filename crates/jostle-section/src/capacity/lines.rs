//! From rules to the capacity of a member as straight lines over its axial force.

use std::cell::RefCell;
use std::collections::BTreeMap;

use jostle::model::{AcrossCapacity, CapacityLine, RuleCapacity, ShearCapacity};

use super::{
    Degradation, Interaction, ObliqueInteraction, RatedMember, ShearRule, ShearStrength,
    drift_at_axial_failure,
};
use crate::formula::Member;
use crate::section::Section;

/// Error of a line between its points, relative to its greatest value \[–\].
const TOLERANCE: f64 = 1e-4;
/// Halvings of the range of axial forces at most; jumps are this fine.
const MOST_HALVINGS: u32 = 24;
/// Parts from which halving starts.
const PARTS: usize = 8;

impl RatedMember<'_> {
    /// Capacity by some rules. Beams are taken without axial force.
    #[must_use]
    pub fn capacities(&self, rules: &[ShearRule]) -> Vec<RuleCapacity> {
        self.capacities_with(rules, &Interaction::of_both_signs(self.section))
    }

    /// The same with the moments of the section known, for members of one section and several lengths.
    #[must_use]
    pub fn capacities_with(
        &self,
        rules: &[ShearRule],
        interaction: &[Interaction; 2],
    ) -> Vec<RuleCapacity> {
        let rule = |rule: &ShearRule| {
            let bending = interaction.each_ref().map(|curve| {
                let factored = |load: f64| curve.moment(load) * rule.bending_factor(self, load);
                match self.member {
                    Member::Beam => CapacityLine::new(vec![[0.0, factored(0.0)]]),
                    Member::Column => {
                        let loads = curve.points.iter().map(|[load, _]| *load);
                        CapacityLine::new(loads.map(|load| [load, factored(load)]).collect())
                    }
                }
            });
            RuleCapacity {
                rule: rule.name(),
                shear: self.shear(*rule),
                bending,
                across: None,
            }
        };
        rules.iter().map(rule).collect()
    }

    /// Capacities of a column that bends in two planes. `across`: the same column with its section [turned](Section::turned);
    /// `oblique`: the moments of its section in all directions, and `interaction` those in the plane of its depth.
    #[must_use]
    pub fn capacities_in_space(
        &self,
        across: &Self,
        rules: &[ShearRule],
        interaction: &[Interaction; 2],
        oblique: &ObliqueInteraction,
    ) -> Vec<RuleCapacity> {
        let plain = oblique.surface(|_| 1.0);
        let mut capacities = self.capacities_with(rules, interaction);
        for (rule, capacity) in rules.iter().zip(&mut capacities) {
            let factor = |load: f64| rule.bending_factor(self, load);
            let is_plain = oblique.loads().iter().all(|load| factor(*load) == 1.0);
            capacity.across = Some(AcrossCapacity {
                shear: across.shear(*rule),
                bending: match is_plain {
                    true => plain.clone(),
                    false => oblique.surface(factor),
                },
            });
        }
        capacities
    }

    /// Shear capacity by a rule; `None` where the rule has none.
    #[must_use]
    pub fn shear(&self, rule: ShearRule) -> Option<ShearCapacity> {
        let at_rest = rule.strength(self, 0.0)?;
        // Both lines ask for the same loads, and halving asks for each several times.
        let known: RefCell<BTreeMap<u64, Option<ShearStrength>>> = RefCell::default();
        let line = |part: fn(&ShearStrength) -> f64| {
            self.line(|load| {
                let mut known = known.borrow_mut();
                let strength = known
                    .entry(load.to_bits())
                    .or_insert_with(|| rule.strength(self, load));
                strength.as_ref().map_or(0.0, part)
            })
        };
        Some(ShearCapacity {
            steady: line(|strength| strength.steady),
            degrading: line(|strength| strength.degrading),
            by_ductility: match rule.degradation() {
                Degradation::None => CapacityLine::default(),
                Degradation::Plastic => CapacityLine::new(vec![[1.0, 1.0], [6.0, 0.75]]),
                Degradation::Ductility => CapacityLine::new(vec![[2.0, 1.0], [6.0, 0.7]]),
            },
            limit: at_rest.limit,
        })
    }

    /// Drift ratio at axial failure of a column against its compression; empty for beams and without ties.
    #[must_use]
    pub fn axial_failure_drift(&self) -> CapacityLine {
        if self.member == Member::Beam || self.section.ties.is_none() {
            return CapacityLine::default();
        }
        self.line(|load| drift_at_axial_failure(self.section, load).unwrap_or(0.0))
    }

    /// A function of the compression as straight lines, from the tension that all bars carry to the compression that
    /// crushes the section.
    fn line(&self, function: impl Fn(f64) -> f64) -> CapacityLine {
        if self.member == Member::Beam {
            return CapacityLine::new(vec![[0.0, function(0.0)]]);
        }
        line_over(self.section, function)
    }
}

/// A function of the compression as straight lines, from the tension that all bars carry to the compression that crushes
/// the section.
pub(super) fn line_over(section: &Section, function: impl Fn(f64) -> f64) -> CapacityLine {
    let bars = section.steel_area() * section.steel.yield_strength;
    let [low, high] = [
        -1.2 * bars,
        section.area() * section.concrete.strength + 1.2 * bars,
    ];
    let at = |part: usize| low + (high - low) * part as f64 / PARTS as f64;
    let values: Vec<[f64; 2]> = (0..=PARTS)
        .map(|part| [at(part), function(at(part))])
        .collect();
    let scale = values
        .iter()
        .fold(0.0_f64, |most, [_, value]| most.max(value.abs()));
    let mut points = vec![values[0]];
    for ends in values.windows(2) {
        refine(
            [ends[0], ends[1]],
            &function,
            TOLERANCE * scale,
            MOST_HALVINGS,
            &mut points,
        );
    }
    CapacityLine::new(points)
}

/// Adds points after the first end, up to the second.
fn refine(
    [start, end]: [[f64; 2]; 2],
    function: &impl Fn(f64) -> f64,
    tolerance: f64,
    halvings: u32,
    points: &mut Vec<[f64; 2]>,
) {
    let between = |share: f64| start[0] + share * (end[0] - start[0]);
    let off = [0.25, 0.5, 0.75].map(|share| {
        let straight = start[1] + share * (end[1] - start[1]);
        (function(between(share)) - straight).abs()
    });
    if halvings > 0 && off.into_iter().any(|off| off > tolerance) {
        let middle = [between(0.5), function(between(0.5))];
        refine([start, middle], function, tolerance, halvings - 1, points);
        refine([middle, end], function, tolerance, halvings - 1, points);
    } else {
        points.push(end);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Concrete, Reinforcement, Section, Steel, StrengthLevel, Ties};

    #[test]
    fn lines_follow_the_rules_at_every_axial_force() {
        let concrete = Concrete::grade("C30", StrengthLevel::Characteristic).expect("known");
        let steel = Steel::grade("HRB400", StrengthLevel::Characteristic).expect("known");
        let bars = Reinforcement::parse("12 d20").expect("understood");
        let ties = Ties::parse("d10 @ 150 mm").ok();
        let section = Section::new(0.5, 0.5, concrete, steel, &bars, 0.03, ties).expect("sound");
        let member = RatedMember {
            section: &section,
            member: Member::Column,
            clear_length: 2.7,
            level: StrengthLevel::Characteristic,
        };
        for rule in ShearRule::ALL {
            let shear = member.shear(rule).expect("ties");
            let points = shear.steady.points().len() + shear.degrading.points().len();
            assert!(points < 200, "{}: {points}", rule.name());
            for step in 0..500 {
                let load = -1.5e6 + 1.6e4 * f64::from(step);
                let exact = rule.strength(&member, load).expect("ties");
                for ductility in [1.0, 3.0, 9.0] {
                    let due = exact.at(rule.degradation().factor(ductility));
                    let found = shear.at(load, ductility);
                    assert!(
                        (found / due - 1.0).abs() < 1e-3,
                        "{}: {found} for {due} at {load}",
                        rule.name()
                    );
                }
            }
        }
        let drift = member.axial_failure_drift();
        let due = drift_at_axial_failure(&section, 7e5).expect("ties");
        assert!((drift.at(7e5) / due - 1.0).abs() < 1e-3);
    }
}
