//! The rules of single codes.

use super::{
    Candidate, MainPeriod, Origin, RuleKind, SelectionCheck, SelectionCode, SelectionRule,
};
use crate::fault::MotionFault;
use crate::spectrum::{Reading, response_spectrum, spaced_periods};
use crate::target::TargetSpectrum;

/// A set with what has been computed of it.
pub(super) struct Numbers<'a> {
    pub(super) set: &'a [Candidate],
    pub(super) target: &'a TargetSpectrum,
    pub(super) periods: &'a [MainPeriod],
    pub(super) damping: f64,
    pub(super) check: &'a SelectionCheck,
}

/// Rules with their verdicts, and notes.
type Judged = (Vec<SelectionRule>, Vec<&'static str>);

/// Largest difference of the mean spectrum at main periods, GB 50011 \[–\].
const MEAN_TOLERANCE: f64 = 0.20;
/// Least part of the spectrum that the mean must reach, EN 1998-1 and ASCE 7 \[–\].
const LEAST_PART: f64 = 0.9;
/// Damping ratio of the spectra that these two compare \[–\].
const DAMPING: f64 = 0.05;
/// Periods at which they are compared; neighbours differ by less than 2 %.
const POINTS: usize = 200;
/// Share of the mass that the modes of the period range must move, ASCE 7 \[–\].
const MASS: f64 = 0.9;
/// Rounding of peaks in files \[–\].
const ROUNDING: f64 = 1e-6;

impl Numbers<'_> {
    pub(super) fn judged(&self) -> Result<Judged, MotionFault> {
        match self.check.code {
            SelectionCode::Gb50011 => Ok((self.gb50011(), Vec::new())),
            SelectionCode::En1998 => self.en1998(),
            SelectionCode::Asce7 => self.asce7(),
        }
    }

    fn longest(&self) -> f64 {
        let periods = self.periods.iter().map(|main| main.period);
        periods.fold(0.0, f64::max)
    }

    /// GB 50011-2010 (2016), clause 5.1.2. The upper bounds of 135 and 120 % and the five periods are those of the
    /// commentary.
    fn gb50011(&self) -> Vec<SelectionRule> {
        let check = self.check;
        let count = self.set.len();
        let natural = self
            .set
            .iter()
            .filter(|candidate| candidate.origin == Origin::Natural)
            .count();
        let artificial = count - natural;
        let mean_shear = check.base_shear.iter().sum::<f64>() / count as f64;
        let rule = |kind, found: &str, asked, met| SelectionRule {
            kind,
            clause: "5.1.2",
            found: found.to_owned(),
            asked,
            met,
        };
        vec![
            rule(
                RuleKind::Count,
                &format!("{natural} recorded and {artificial} artificial"),
                "at least two recorded and one artificial; of seven or more, at least five recorded",
                artificial >= 1 && natural >= if count >= 7 { 5 } else { 2 },
            ),
            rule(
                RuleKind::MeanAtPeriods,
                "mean spectrum",
                "within 20 % of the code at the main periods",
                check
                    .mean
                    .iter()
                    .all(|[_, _, difference]| difference.abs() <= MEAN_TOLERANCE),
            ),
            rule(
                RuleKind::BaseShear,
                "base shear, estimated from the modes",
                "each within 65 to 135 %, their mean within 80 to 120 % of the code; to be confirmed with the time histories of the structure",
                check
                    .base_shear
                    .iter()
                    .all(|ratio| (0.65..=1.35).contains(ratio))
                    && (0.8..=1.2).contains(&mean_shear),
            ),
            rule(
                RuleKind::Duration,
                "effective duration",
                "time between the first and the last exceedance of a tenth of the peak, at least five times the longest main period",
                check
                    .effective_duration
                    .iter()
                    .all(|duration| *duration >= 5.0 * self.longest()),
            ),
        ]
    }

    /// EN 1998-1:2004, clause 3.2.3.1.2(4), for artificial accelerograms; by 3.2.3.1.3(3) for recorded ones too.
    fn en1998(&self) -> Result<Judged, MotionFault> {
        self.check_damping()?;
        let count = self.set.len();
        let peaks = self.set.iter().map(|candidate| candidate.motion.peak());
        let mean_peak = peaks.sum::<f64>() / count as f64;
        let wanted = self.target.acceleration(0.0, DAMPING)?;
        let longest = self.longest();
        let (found, met) = self.mean_over([0.2 * longest, 2.0 * longest])?;
        let rules = vec![
            SelectionRule {
                kind: RuleKind::Count,
                clause: "3.2.3.1.2(4)a",
                found: counted(count, "accelerogram"),
                asked: "at least three",
                met: count >= 3,
            },
            SelectionRule {
                kind: RuleKind::ZeroPeriod,
                clause: "3.2.3.1.2(4)b",
                found: format!(
                    "mean of the spectra at zero period {mean_peak:.4} m/s², a_g S = {wanted:.4} m/s²"
                ),
                asked: "at least a_g S",
                met: mean_peak >= (1.0 - ROUNDING) * wanted,
            },
            SelectionRule {
                kind: RuleKind::MeanOverRange,
                clause: "3.2.3.1.2(4)c",
                found,
                asked: "at least 90 % of the elastic spectrum between 0.2 T1 and 2 T1",
                met,
            },
        ];
        let mut notes = vec![if count >= 7 {
            "Seven or more analyses: the mean of their results may be used (4.3.3.4.3(3))."
        } else {
            "Fewer than seven analyses: the most unfavourable of their results counts (4.3.3.4.3(3))."
        }];
        if 2.0 * longest > self.target.range()[1] {
            notes.push("The elastic spectrum ends at 4 s; longer periods are not compared.");
        }
        Ok((rules, notes))
    }

    /// ASCE 7-16 and 7-22, sections 16.2.2, 16.2.3.1 and 16.2.3.2.
    fn asce7(&self) -> Result<Judged, MotionFault> {
        self.check_damping()?;
        let count = self.set.len();
        let longest = self.longest();
        let (shortest, enough_mass) = self.shortest_needed();
        let (found, met) = self.mean_over([shortest.min(0.2 * longest), 2.0 * longest])?;
        let rules = vec![
            SelectionRule {
                kind: RuleKind::Count,
                clause: "16.2.2",
                found: counted(count, "motion"),
                asked: "at least eleven",
                met: count >= 11,
            },
            SelectionRule {
                kind: RuleKind::MeanOverRange,
                clause: "16.2.3",
                found,
                asked: "at least 90 % of the target from 0.2 T1, or the shortest period needed for 90 % of the mass if that is shorter, to 2 T1",
                met,
            },
        ];
        let mut notes = vec![
            "The section asks for the maximum direction of two components; here it is the single component.",
            "The mean must also generally match or exceed the target (16.2.3.2); motions matched to a spectrum need 110 % of it (16.2.3.3). Neither is checked.",
        ];
        if self.target.factor < 1.5 {
            notes.push("The section compares with the MCE_R spectrum, 1.5 times the design spectrum (16.2.1); factor = 1.5 makes it that.");
        }
        if !enough_mass {
            notes.push("The periods given move less than 90 % of the mass: the range may have to begin earlier.");
        }
        Ok((rules, notes))
    }

    fn check_damping(&self) -> Result<(), MotionFault> {
        if self.damping == DAMPING {
            return Ok(());
        }
        Err(MotionFault::OtherDamping {
            given: DAMPING,
            wanted: self.damping,
        })
    }

    /// The shortest of the longest periods that together move 90 % of the mass, and whether there are enough \[s\].
    /// Without shares of the mass every period counts as needed.
    fn shortest_needed(&self) -> (f64, bool) {
        let mut modes = self.periods.to_vec();
        modes.sort_by(|a, b| b.period.total_cmp(&a.period));
        let shortest = modes.last().map_or(0.0, |main| main.period);
        let total: f64 = modes.iter().map(|main| main.mass_ratio).sum();
        if total > 1.0 + ROUNDING {
            return (shortest, true);
        }
        let mut moved = 0.0;
        for main in &modes {
            moved += main.mass_ratio;
            if moved >= MASS - ROUNDING {
                return (main.period, true);
            }
        }
        (shortest, false)
    }

    /// Where the mean spectrum is lowest against the target, in words, and whether it reaches 90 % everywhere.
    fn mean_over(&self, range: [f64; 2]) -> Result<(String, bool), MotionFault> {
        let [first, last] = self.target.range();
        let [from, to] = [range[0].max(first), range[1].min(last)];
        let periods = spaced_periods(from, to, POINTS);
        let mut mean = vec![0.0; periods.len()];
        for candidate in self.set {
            let motion = &candidate.motion;
            let spectrum = response_spectrum(motion, &periods, &[DAMPING], Reading::Between)?;
            let values = &spectrum.curves[0].pseudo_acceleration;
            for (sum, value) in mean.iter_mut().zip(values) {
                *sum += value / self.set.len() as f64;
            }
        }
        let mut worst = (f64::INFINITY, from);
        for (period, mean) in periods.iter().zip(&mean) {
            let part = mean / self.target.acceleration(*period, DAMPING)?;
            if part < worst.0 {
                worst = (part, *period);
            }
        }
        let round = |period: f64| (1e4 * period).round() / 1e4;
        let found = format!(
            "lowest mean spectrum {:.1} % of the code, at {:.3} s, between {} and {} s",
            100.0 * worst.0,
            worst.1,
            round(from),
            round(to)
        );
        Ok((found, worst.0 >= LEAST_PART))
    }
}

fn counted(count: usize, what: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {what}{plural}")
}
