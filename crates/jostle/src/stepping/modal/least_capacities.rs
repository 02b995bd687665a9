//! Least capacities of a member over ranges of its compression: they settle most instants without a look at the capacity
//! itself.

use crate::history::SectionRatio;
use crate::model::{CapacityLine, MemberCapacity, RuleCapacity, ShearCapacity};
use crate::stepping::member_ratios::RatedForces;

/// Ranges of the compression.
const RANGES: usize = 128;
/// Ranges on either side of that of the compression in which capacities hold until a section is looked at again.
const BESIDE: usize = 4;
/// Rounding of capacities, relative.
const ROUNDING: f64 = 1e-9;

/// Least capacities by every rule over ranges of the compression.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LeastCapacities {
    /// Where the first range begins, and their width; the first and the last have no outer end \[N\].
    start: f64,
    width: f64,
    /// How far the compression may change before capacities beside its range count \[N\].
    pub(super) reach: f64,
    /// Number of rules.
    rules: usize,
    /// Range by range and rule by rule: shear and bending capacity of members that have not yielded \[N, N·m\]. Infinite
    /// shear capacity where a rule has none.
    within: Vec<[f64; 2]>,
    /// The same with the ranges beside.
    around: Vec<[f64; 2]>,
    /// Factor on moments across in the length of both moments; one for all rules \[–\].
    stretch: f64,
}

impl LeastCapacities {
    pub(super) fn new(capacity: &MemberCapacity) -> Self {
        let rules = &capacity.rules;
        let ends = lines(rules).filter_map(|line| {
            let points = line.points();
            Some([points.first()?[0], points.last()?[0]])
        });
        let [start, end] = ends.fold([f64::INFINITY, f64::NEG_INFINITY], |known, ends| {
            [known[0].min(ends[0]), known[1].max(ends[1])]
        });
        let (start, width) = if start < end {
            (start, (end - start) / RANGES as f64)
        } else {
            (0.0, f64::INFINITY)
        };
        // The first and the last have no outer end.
        let range = |index: usize| {
            let at = |index: usize| match index {
                0 => f64::NEG_INFINITY,
                RANGES => f64::INFINITY,
                _ => start + width * index as f64,
            };
            [at(index), at(index + 1)]
        };
        let within: Vec<[f64; 2]> = (0..RANGES)
            .flat_map(|index| {
                let range = if width.is_finite() {
                    range(index)
                } else {
                    [start; 2]
                };
                rules.iter().map(move |rule| least(rule, range))
            })
            .collect();
        let around = (0..RANGES).flat_map(|index| {
            let near = index.saturating_sub(BESIDE)..=(index + BESIDE).min(RANGES - 1);
            let (within, count) = (&within, rules.len());
            (0..count).map(move |rule| {
                let lists = near.clone().map(|range| within[range * count + rule]);
                lists.fold([f64::INFINITY; 2], |known, least| {
                    [known[0].min(least[0]), known[1].min(least[1])]
                })
            })
        });
        Self {
            start,
            width,
            reach: width * BESIDE as f64,
            rules: rules.len(),
            around: around.collect(),
            within,
            stretch: rules
                .iter()
                .find_map(|rule| rule.across.as_ref())
                .map_or(1.0, |across| across.bending.stretch()),
        }
    }

    /// Sizes of shears and moments that are compared with least capacities.
    #[inline(always)]
    pub(super) fn sizes(&self, forces: &RatedForces) -> [f64; 2] {
        let [[shear, shear_across], [moment, moment_across]] = [forces.shears, forces.moments];
        if shear_across == 0.0 && moment_across == 0.0 {
            return [shear.abs(), moment.abs()];
        }
        let size = |value: f64, across: f64| (value * value + across * across).sqrt();
        [
            size(shear, shear_across),
            size(moment, self.stretch * moment_across),
        ]
    }

    /// How far a shear and a moment of such slacks, and those across, may change each without their sizes using it up.
    pub(super) fn shares(&self, slack: [f64; 2]) -> [[f64; 2]; 2] {
        let both = std::f64::consts::FRAC_1_SQRT_2;
        let [shear, moment] = slack.map(|slack| both * slack);
        [[shear, moment], [shear, moment / self.stretch]]
    }

    #[inline(always)]
    fn range(&self, compression: f64) -> usize {
        // Saturates below and for an infinite width.
        (((compression - self.start) / self.width) as usize).min(RANGES - 1)
    }

    /// Least shear and bending capacity near this compression, rule by rule: a shear or a moment below the product with the
    /// greatest ratio so far cannot exceed it.
    #[inline(always)]
    pub(super) fn within(&self, compression: f64) -> &[[f64; 2]] {
        let first = self.range(compression) * self.rules;
        &self.within[first..first + self.rules]
    }

    /// Shear and moment up to which no ratio comes near the greatest so far by any rule, while the compression changes by no more
    /// than `reach`; `near`: share of that ratio.
    #[inline(always)]
    pub(super) fn near(&self, greatest: &[SectionRatio], compression: f64, near: f64) -> [f64; 2] {
        let first = self.range(compression) * self.rules;
        let least = &self.around[first..first + self.rules];
        let mut most = [f64::INFINITY; 2];
        for (known, least) in greatest.iter().zip(least) {
            // Rules without shear capacity: 0 · ∞ is no number and is passed over.
            most[0] = most[0].min(near * known.shear.ratio * least[0]);
            most[1] = most[1].min(near * known.bending.ratio * least[1]);
        }
        most
    }
}

fn lines(rules: &[RuleCapacity]) -> impl Iterator<Item = &CapacityLine> {
    rules.iter().flat_map(|rule| {
        let across = rule.across.as_ref();
        let shear = rule.shear.iter();
        shear
            .chain(across.and_then(|capacity| capacity.shear.as_ref()))
            .flat_map(|shear| [&shear.steady, &shear.degrading])
            .chain(&rule.bending)
            .chain(across.and_then(|capacity| capacity.bending.first()))
    })
}

/// Least shear and bending capacity by a rule over a range of the compression, a little less for rounding.
fn least(rule: &RuleCapacity, range: [f64; 2]) -> [f64; 2] {
    let of_shear = |shear: Option<&ShearCapacity>| {
        shear.map_or(f64::INFINITY, |shear| {
            let factor = shear.factor(1.0);
            (shear.steady.least(range) + factor * shear.degrading.least(range)).min(shear.limit)
        })
    };
    let shear = of_shear(rule.shear.as_ref());
    let [shear, bending] = match &rule.across {
        Some(across) => [
            shear.min(of_shear(across.shear.as_ref())),
            across.bending.least(range),
        ],
        None => {
            let [one, other] = rule.bending.each_ref().map(|line| {
                // Beyond its ends the axial force alone is too much.
                if line.is_left_by(range) {
                    0.0
                } else {
                    line.least(range)
                }
            });
            [shear, one.min(other)]
        }
    };
    [shear, bending].map(|least| {
        if least.is_finite() {
            least - ROUNDING * least.abs()
        } else {
            least
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::ShearCapacity;

    fn capacity() -> MemberCapacity {
        let line = |points: &[[f64; 2]]| CapacityLine::new(points.to_vec());
        let rule = |factor: f64, shear: bool| RuleCapacity {
            rule: "test",
            shear: shear.then(|| ShearCapacity {
                steady: line(&[[-4e5, 2e4 * factor], [0.0, 1e5], [6e5, 2e5]]),
                degrading: line(&[[0.0, 5e4], [8e5, 9e4 * factor]]),
                by_ductility: line(&[[2.0, 1.0], [6.0, 0.7]]),
                limit: 2.5e5 * factor,
            }),
            bending: [
                line(&[[-6e5, 2e4], [0.0, 1.2e5 * factor], [2e6, 3e4]]),
                line(&[[-6e5, 0.0], [1e5, 1.1e5], [2e6, 0.0]]),
            ],
            across: None,
        };
        MemberCapacity {
            member: "A.column.1.1".to_owned(),
            compression_at_rest: 0.0,
            follows_axial: true,
            axial_failure_drift: CapacityLine::default(),
            rotations: Vec::new(),
            rules: vec![rule(1.0, true), rule(1.7, true), rule(0.6, false)],
        }
    }

    /// Whatever would raise a ratio is let through, and nothing comes near one within its slack.
    #[test]
    fn no_greater_ratio_is_passed_over() {
        let capacity = capacity();
        let least = LeastCapacities::new(&capacity);
        let mut greatest = vec![SectionRatio::default(); 3];
        for (index, known) in greatest.iter_mut().enumerate() {
            known.shear.ratio = if index == 2 {
                0.0
            } else {
                0.5 + 0.3 * index as f64
            };
            known.bending.ratio = 0.8 - 0.1 * index as f64;
        }
        let (mut passed, mut followed) = (0, 0);
        for step in 0..30_000 {
            let part = |factor: f64| (f64::from(step) * factor).sin();
            let compression = 1.8e6 * part(0.137) + 6e5;
            let forces = [1.6e5 * part(0.731), 1.0e5 * part(1.177)];
            let exceeds = |share: f64, compression: f64, forces: [f64; 2]| {
                capacity.rules.iter().zip(&greatest).any(|(rule, known)| {
                    let shear = rule.shear.as_ref();
                    let shear = shear.map(|shear| forces[0].abs() / shear.at(compression, 1.0));
                    shear.is_some_and(|ratio| ratio > share * known.shear.ratio)
                        || rule.bending_ratio(compression, [forces[1], 0.0])
                            > share * known.bending.ratio
                })
            };
            let may_exceed = least.within(compression).iter().zip(&greatest);
            let may_exceed = may_exceed.map(|(least, known)| {
                forces[0].abs() >= known.shear.ratio * least[0]
                    || forces[1].abs() >= known.bending.ratio * least[1]
            });
            if !may_exceed.fold(false, |any, one| any | one) {
                passed += 1;
                assert!(!exceeds(1.0, compression, forces), "step {step}");
            }
            let most = least.near(&greatest, compression, 0.9);
            let slack = [0, 1].map(|kind| most[kind] - forces[kind].abs());
            if slack.iter().all(|slack| *slack > 0.0) {
                followed += 1;
                for (change, sign) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0)] {
                    let moved = compression + 0.999 * change * least.reach;
                    let grown = [0, 1].map(|kind| {
                        forces[kind] + sign * 0.999 * slack[kind] * forces[kind].signum()
                    });
                    assert!(!exceeds(0.9, moved, grown), "step {step}");
                }
            }
        }
        assert!(passed > 1_000 && followed > 500, "{passed} {followed}");
    }

    #[test]
    fn without_rules_nothing_is_known() {
        let none = MemberCapacity {
            rules: Vec::new(),
            ..capacity()
        };
        assert!(LeastCapacities::new(&none).within(1e6).is_empty());
        // Beyond the greatest compression nothing is left.
        assert_eq!(LeastCapacities::new(&capacity()).within(9e6)[0][1], 0.0);
    }
}
