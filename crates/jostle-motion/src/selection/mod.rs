//! Selection of accelerograms for time-history analysis: the rules of GB 50011, EN 1998-1 and ASCE 7 for a set.

mod rules;

use crate::Accelerogram;
use crate::fault::MotionFault;
use crate::spectrum::{Reading, response_spectrum};
use crate::target::{TargetKind, TargetSpectrum};
use rules::Numbers;

/// One accelerogram of a set.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// Name for display.
    pub name: String,
    /// The motion as it will be used, scaled.
    pub motion: Accelerogram,
    /// Whether it was recorded or made.
    pub origin: Origin,
}

/// Where an accelerogram comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// Recorded.
    Natural,
    /// Made.
    Artificial,
}

/// A main period of the structure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MainPeriod {
    /// Natural period \[s\].
    pub period: f64,
    /// Share of the mass that takes part \[–\].
    pub mass_ratio: f64,
}

/// Whose rules a set is judged by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SelectionCode {
    /// GB 50011-2010 (2016), clause 5.1.2.
    Gb50011,
    /// EN 1998-1:2004, clause 3.2.3.1.2(4).
    En1998,
    /// ASCE 7-16 and 7-22, section 16.2.
    Asce7,
}

impl SelectionCode {
    /// The code of a design spectrum; GB 50011 for one of the user's own.
    #[must_use]
    pub fn from_target(target: &TargetSpectrum) -> Self {
        match target.kind {
            TargetKind::En1998(_) => Self::En1998,
            TargetKind::Asce7(_) => Self::Asce7,
            TargetKind::Gb50011(_) | TargetKind::Table(_) => Self::Gb50011,
        }
    }

    /// The clause, for display.
    #[must_use]
    pub fn clause(self) -> &'static str {
        match self {
            Self::Gb50011 => "GB 50011, clause 5.1.2",
            Self::En1998 => "EN 1998-1, clause 3.2.3.1.2(4)",
            Self::Asce7 => "ASCE 7, section 16.2",
        }
    }

    /// Bounds of the mean spectrum, as factors on that of the code, with a name \[–\].
    #[must_use]
    pub fn bounds(self) -> &'static [(&'static str, f64)] {
        match self {
            Self::Gb50011 => &[("code ±20 %", 0.8), ("", 1.2)],
            Self::En1998 | Self::Asce7 => &[("90 % of the code", 0.9)],
        }
    }
}

/// Subject of a rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RuleKind {
    /// Number and origin of the motions.
    Count,
    /// Mean spectrum at the main periods.
    MeanAtPeriods,
    /// Base shears.
    BaseShear,
    /// Effective duration.
    Duration,
    /// Mean of the peak accelerations.
    ZeroPeriod,
    /// Mean spectrum over a range of periods.
    MeanOverRange,
}

/// A rule of a code, and whether a set meets it.
#[derive(Clone, Debug, PartialEq)]
pub struct SelectionRule {
    /// Its subject.
    pub kind: RuleKind,
    /// Its source.
    pub clause: &'static str,
    /// Result.
    pub found: String,
    /// Requirement.
    pub asked: &'static str,
    /// Whether it is met.
    pub met: bool,
}

/// Check of a set by a code.
#[derive(Clone, Debug, PartialEq)]
pub struct SelectionCheck {
    /// Whose rules these are.
    pub code: SelectionCode,
    /// Every rule that is checked.
    pub rules: Vec<SelectionRule>,
    /// Notes on the verdict.
    pub notes: Vec<&'static str>,
    /// At every main period: code, mean of the set, and their ratio less one \[m/s², m/s², –\].
    pub mean: Vec<[f64; 3]>,
    /// For every accelerogram: response over code at every main period \[–\].
    pub ratios: Vec<Vec<f64>>,
    /// For every accelerogram: base shear over that of the code's spectrum, both from the main periods by the root of
    /// the sum of squares \[–\].
    pub base_shear: Vec<f64>,
    /// For every accelerogram: time between the first and the last exceedance of a tenth of its peak \[s\].
    pub effective_duration: Vec<f64>,
}

impl SelectionCheck {
    /// Whether everything that is checked here is met.
    #[must_use]
    pub fn passes(&self) -> bool {
        self.rules.iter().all(|rule| rule.met)
    }

    /// Whether a rule is met; `None` if the code has none of this kind.
    #[must_use]
    pub fn met(&self, kind: RuleKind) -> Option<bool> {
        let rule = self.rules.iter().find(|rule| rule.kind == kind);
        rule.map(|rule| rule.met)
    }
}

/// Checks a set of accelerograms against a design spectrum, for the main periods of a structure, by the rules of the
/// code of that spectrum.
///
/// Base shears here are those of the elastic modes; GB 50011 requires those from time histories of the structure
/// itself, for which these are an estimate.
///
/// # Errors
/// [`MotionFault`] when a period or damping ratio is out of range; [`MotionFault::TooFew`] without periods or motions;
/// [`MotionFault::OtherDamping`] for EN 1998-1 and ASCE 7, which compare spectra with 5 % damping only.
pub fn check_selection(
    set: &[Candidate],
    target: &TargetSpectrum,
    periods: &[MainPeriod],
    damping: f64,
) -> Result<SelectionCheck, MotionFault> {
    if set.is_empty() || periods.is_empty() {
        return Err(MotionFault::TooFew { found: 0 });
    }
    let times: Vec<f64> = periods.iter().map(|main| main.period).collect();
    let design: Vec<f64> = times
        .iter()
        .map(|&t| target.acceleration(t, damping))
        .collect::<Result<_, _>>()?;
    let mut ratios = Vec::new();
    for candidate in set {
        let spectrum = response_spectrum(&candidate.motion, &times, &[damping], Reading::Between)?;
        let values = spectrum.curves[0].pseudo_acceleration.iter();
        ratios.push(
            values
                .zip(&design)
                .map(|(a, design)| a / design)
                .collect::<Vec<f64>>(),
        );
    }
    let count = set.len() as f64;
    let mean = (0..times.len())
        .map(|k| {
            let ratio = ratios.iter().map(|of| of[k]).sum::<f64>() / count;
            [design[k], ratio * design[k], ratio - 1.0]
        })
        .collect();
    let shear = |factors: &dyn Fn(usize) -> f64| {
        let modes = periods.iter().enumerate();
        modes
            .map(|(k, main)| (main.mass_ratio * design[k] * factors(k)).powi(2))
            .sum::<f64>()
            .sqrt()
    };
    let base_shear = ratios
        .iter()
        .map(|of| shear(&|k| of[k]) / shear(&|_| 1.0))
        .collect();
    let durations = set
        .iter()
        .map(|candidate| effective_duration(&candidate.motion));
    let mut check = SelectionCheck {
        code: SelectionCode::from_target(target),
        rules: Vec::new(),
        notes: Vec::new(),
        mean,
        ratios,
        base_shear,
        effective_duration: durations.collect(),
    };
    let numbers = Numbers {
        set,
        target,
        periods,
        damping,
        check: &check,
    };
    (check.rules, check.notes) = numbers.judged()?;
    Ok(check)
}

/// Time from the first to the last value of a tenth of the peak \[s\].
fn effective_duration(motion: &Accelerogram) -> f64 {
    let level = 0.1 * motion.peak();
    let a = motion.acceleration();
    let first = a.iter().position(|a| a.abs() >= level).unwrap_or(0);
    let last = a.iter().rposition(|a| a.abs() >= level).unwrap_or(0);
    motion.step() * (last - first) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Asce7, En1998, EnGround, EnType, Envelope, MatchSettings, RECIPES, SineSettings, recipe,
        spectrum_compatible,
    };

    const PERIODS: [MainPeriod; 2] = [
        MainPeriod {
            period: 0.8,
            mass_ratio: 0.8,
        },
        MainPeriod {
            period: 0.25,
            mass_ratio: 0.12,
        },
    ];

    fn candidate(motion: &Accelerogram, origin: Origin, factor: f64) -> Candidate {
        Candidate {
            name: "wave".into(),
            motion: motion.scaled(factor).unwrap(),
            origin,
        }
    }

    #[test]
    fn matched_waves_pass_and_scaled_ones_do_not() {
        use Origin::{Artificial, Natural};
        use RuleKind::{BaseShear, Count, MeanAtPeriods};
        let recipe = recipe(RECIPES[0].name).unwrap();
        let wave = recipe.make().unwrap().motion;
        let set = |factors: [f64; 3]| {
            [Natural, Natural, Artificial]
                .iter()
                .zip(factors)
                .map(|(origin, factor)| candidate(&wave, *origin, factor))
                .collect::<Vec<_>>()
        };
        let check =
            |set: &[Candidate]| check_selection(set, &recipe.target(), &PERIODS, 0.05).unwrap();
        let good = set([1.1, 0.9, 1.0]);
        let answer = check(&good);
        assert!(answer.passes(), "{answer:?}");
        assert_eq!(answer.code, SelectionCode::Gb50011);
        assert!(
            answer
                .mean
                .iter()
                .all(|[_, _, difference]| difference.abs() < 0.05)
        );
        // One wave of 1.4 times the code breaks the rule on single base shears alone.
        let answer = check(&set([1.4, 0.8, 1.0]));
        assert_eq!(answer.met(MeanAtPeriods), Some(true));
        assert_eq!(answer.met(BaseShear), Some(false));
        assert!(!answer.passes());
        assert_eq!(check(&set([0.75; 3])).met(MeanAtPeriods), Some(false));
        assert_eq!(check(&good[..2]).met(Count), Some(false));
        assert!(check_selection(&[], &recipe.target(), &PERIODS, 0.05).is_err());
    }

    /// A motion that follows a spectrum, and the spectrum.
    fn matched(kind: TargetKind) -> (Accelerogram, TargetSpectrum) {
        let target = TargetSpectrum::new(kind);
        let settings = SineSettings {
            step: 0.01,
            envelope: Envelope::of_duration(20.0),
            seed: 1,
            matching: MatchSettings {
                periods: [0.1, 3.0],
                damping: 0.05,
                tolerance: 0.05,
                peak: target.peak_ground_acceleration(),
            },
        };
        let motion = spectrum_compatible(&target, &settings).unwrap().motion;
        (motion, target)
    }

    #[test]
    fn sets_are_judged_by_en_1998_where_the_spectrum_is_its() {
        use RuleKind::{Count, MeanOverRange, ZeroPeriod};
        let (wave, target) = matched(TargetKind::En1998(En1998 {
            kind: EnType::One,
            ground: EnGround::B,
            ground_acceleration: 2.0,
        }));
        let check = |factors: &[f64], damping| {
            let made = factors.iter();
            let set: Vec<_> = made
                .map(|factor| candidate(&wave, Origin::Artificial, *factor))
                .collect();
            check_selection(&set, &target, &PERIODS, damping)
        };
        let met = |factors: &[f64]| {
            let check = check(factors, 0.05).unwrap();
            assert_eq!(check.code, SelectionCode::En1998);
            assert_eq!(check.rules.len(), 3, "no rule of another code");
            [Count, ZeroPeriod, MeanOverRange].map(|kind| check.met(kind).unwrap())
        };
        // Three artificial motions, and none recorded: GB 50011 would refuse them.
        assert_eq!(met(&[1.0; 3]), [true; 3]);
        // Single spectra may be anything; GB 50011 would refuse the base shears.
        assert_eq!(met(&[0.4, 1.6, 1.01]), [true; 3]);
        assert_eq!(met(&[1.0; 2]), [false, true, true]);
        assert_eq!(met(&[0.97; 3]), [true, false, true]);
        assert_eq!(met(&[0.8; 3]), [true, false, false]);
        // There is no upper bound.
        assert_eq!(met(&[2.0; 3]), [true; 3]);
        assert!(matches!(
            check(&[1.0; 3], 0.02),
            Err(MotionFault::OtherDamping { .. })
        ));
        let check = check(&[0.8; 3], 0.05).unwrap();
        assert!(
            check.rules[2].found.ends_with(", between 0.16 and 1.6 s"),
            "{}",
            check.rules[2].found
        );
    }

    #[test]
    fn sets_are_judged_by_asce_7_where_the_spectrum_is_its() {
        use RuleKind::{Count, MeanOverRange};
        let (wave, target) = matched(TargetKind::Asce7(Asce7 {
            short: 10.0,
            one_second: 6.0,
            long_period: 8.0,
        }));
        let check = |count: usize, factor: f64, periods: &[MainPeriod]| {
            let set = vec![candidate(&wave, Origin::Natural, factor); count];
            check_selection(&set, &target, periods, 0.05).unwrap()
        };
        let met = |count, factor| {
            let check = check(count, factor, &PERIODS);
            assert_eq!(check.rules.len(), 2, "no rule of another code");
            [Count, MeanOverRange].map(|kind| check.met(kind).unwrap())
        };
        assert_eq!(met(11, 1.0), [true; 2]);
        assert_eq!(met(10, 1.0), [false, true]);
        assert_eq!(met(11, 0.8), [true, false]);
        // From 0.2 T1, or the shortest period needed for 90 % of the mass if that is shorter, to 2 T1.
        let range = |periods: &[MainPeriod]| {
            let found = check(11, 1.0, periods).rules[1].found.clone();
            found.split(", between ").nth(1).unwrap().to_owned()
        };
        assert_eq!(range(&PERIODS), "0.16 and 1.6 s");
        let third = MainPeriod {
            period: 0.12,
            mass_ratio: 0.05,
        };
        let slight = PERIODS.map(|main| MainPeriod {
            mass_ratio: 0.9 * main.mass_ratio,
            ..main
        });
        assert_eq!(
            range(&[PERIODS[0], PERIODS[1], third]),
            "0.16 and 1.6 s",
            "two modes move 92 %"
        );
        assert!(range(&[slight[0], slight[1], third]).starts_with("0.12 and 1.6 s"));
    }
}
