//! How computed histories agree with measured ones: peaks, correlation, differences, instants of impacts.

use serde::Serialize;

use crate::linear::sort_by;
use crate::quantity::{Quantity, Unit};

/// Agreement of one computed history with a measured one at the same instants.
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
pub struct HistoryScore {
    /// Greatest magnitude of the measured values.
    pub peak_measured: f64,
    /// Its instant \[s\].
    pub peak_measured_at_s: f64,
    /// Greatest magnitude of the computed values.
    pub peak_computed: f64,
    /// Its instant \[s\].
    pub peak_computed_at_s: f64,
    /// Computed over measured peak; `null` if the measured one is zero \[–\].
    pub peak_ratio: Option<f64>,
    /// Pearson's coefficient of correlation; `null` if a history is constant \[–\].
    pub correlation: Option<f64>,
    /// Root mean square of the difference over that of the measured values; `null` if these are zero \[–\].
    pub rms_difference: Option<f64>,
}

/// Agreement of instants of impacts.
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
pub struct ImpactScore {
    /// Measured impacts.
    pub measured_count: usize,
    /// Computed impacts.
    pub computed_count: usize,
    /// Pairs of a measured and a computed impact within the window.
    pub matched_count: usize,
    /// Mean of computed less measured instants of the pairs; `null` without a pair \[s\].
    pub time_difference_mean_s: Option<f64>,
    /// Greatest magnitude of these differences; `null` without a pair \[s\].
    pub time_difference_peak_s: Option<f64>,
}

#[rustfmt::skip]
impl HistoryScore {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("peak_measured", Unit::OF_COLUMN, "greatest magnitude of the measured values", |s| s.peak_measured).not_in_summary(),
        Quantity::<Self>::real("peak_measured_at_s", Unit::S, "time of this peak", |s| s.peak_measured_at_s).not_in_summary(),
        Quantity::<Self>::real("peak_computed", Unit::OF_COLUMN, "greatest magnitude of the computed values at the measured instants", |s| s.peak_computed).not_in_summary(),
        Quantity::<Self>::real("peak_computed_at_s", Unit::S, "time of this peak", |s| s.peak_computed_at_s).not_in_summary(),
        Quantity::<Self>::optional("peak_ratio", Unit::NONE, "ratio of computed to measured peak; absent if the measured peak is zero", |s| s.peak_ratio).not_in_summary(),
        Quantity::<Self>::optional("correlation", Unit::NONE, "Pearson correlation coefficient; absent if a history is constant", |s| s.correlation).not_in_summary(),
        Quantity::<Self>::optional("rms_difference", Unit::NONE, "RMS of computed minus measured values ÷ RMS of the measured values; absent if these are zero", |s| s.rms_difference).not_in_summary(),
    ];
}

#[rustfmt::skip]
impl ImpactScore {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::whole("measured_count", "measured impacts", |s| s.measured_count).not_in_summary(),
        Quantity::<Self>::whole("computed_count", "computed impacts", |s| s.computed_count).not_in_summary(),
        Quantity::<Self>::whole("matched_count", "matched pairs of measured and computed impacts, within the window", |s| s.matched_count).not_in_summary(),
        Quantity::<Self>::optional("time_difference_mean_s", Unit::S, "mean time difference of the pairs, computed minus measured; absent without a pair", |s| s.time_difference_mean_s).not_in_summary(),
        Quantity::<Self>::optional("time_difference_peak_s", Unit::S, "greatest absolute time difference of the pairs; absent without a pair", |s| s.time_difference_peak_s).not_in_summary(),
    ];
}

impl HistoryScore {
    /// Compares two histories at the same instants \[s\]; all three have the same length, one at least.
    #[must_use]
    pub fn new(time: &[f64], measured: &[f64], computed: &[f64]) -> Self {
        let peak = |values: &[f64]| {
            let magnitudes = values.iter().zip(time).map(|(value, t)| (value.abs(), *t));
            // The first of equal peaks.
            magnitudes.fold((0.0, time.first().copied().unwrap_or(0.0)), |best, now| {
                if now.0 > best.0 { now } else { best }
            })
        };
        let (measured_peak, computed_peak) = (peak(measured), peak(computed));
        let count = measured.len() as f64;
        let mean = |values: &[f64]| values.iter().sum::<f64>() / count;
        let (mean_m, mean_c) = (mean(measured), mean(computed));
        let (mut mm, mut cc, mut mc) = (0.0, 0.0, 0.0);
        let (mut squares, mut difference) = (0.0, 0.0);
        for (m, c) in measured.iter().zip(computed) {
            let (dm, dc) = (m - mean_m, c - mean_c);
            mm += dm * dm;
            cc += dc * dc;
            mc += dm * dc;
            squares += m * m;
            difference += (c - m) * (c - m);
        }
        let ratio = |a: f64, b: f64| Some(a / b).filter(|ratio| ratio.is_finite());
        Self {
            peak_measured: measured_peak.0,
            peak_measured_at_s: measured_peak.1,
            peak_computed: computed_peak.0,
            peak_computed_at_s: computed_peak.1,
            peak_ratio: ratio(computed_peak.0, measured_peak.0),
            correlation: ratio(mc, mm.sqrt() * cc.sqrt()).map(|r| r.clamp(-1.0, 1.0)),
            rms_difference: ratio(difference.sqrt(), squares.sqrt()),
        }
    }
}

impl ImpactScore {
    /// Compares instants of impacts, both in rising order, and returns the pairs of their indices as well: the nearest
    /// measured and computed instants first, each at most once, not further apart than `window` \[s\].
    #[must_use]
    pub fn new(measured: &[f64], computed: &[f64], window: f64) -> (Self, Vec<[usize; 2]>) {
        let mut candidates: Vec<(f64, usize, usize)> = Vec::new();
        for (i, m) in measured.iter().enumerate() {
            let from = computed.partition_point(|c| *c < m - window);
            for (j, c) in computed.iter().enumerate().skip(from) {
                if *c > m + window {
                    break;
                }
                candidates.push(((c - m).abs(), i, j));
            }
        }
        sort_by(&mut candidates, |a, b| {
            a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2))
        });
        let mut used = (vec![false; measured.len()], vec![false; computed.len()]);
        let mut pairs = Vec::new();
        for (_, i, j) in candidates {
            if !used.0[i] && !used.1[j] {
                (used.0[i], used.1[j]) = (true, true);
                pairs.push([i, j]);
            }
        }
        pairs.sort_unstable();
        let differences: Vec<f64> = pairs
            .iter()
            .map(|[i, j]| computed[*j] - measured[*i])
            .collect();
        let some = |value: f64| (!differences.is_empty()).then_some(value);
        let score = Self {
            measured_count: measured.len(),
            computed_count: computed.len(),
            matched_count: pairs.len(),
            time_difference_mean_s: some(
                differences.iter().sum::<f64>() / differences.len() as f64,
            ),
            time_difference_peak_s: some(differences.iter().fold(0.0, |m: f64, d| m.max(d.abs()))),
        };
        (score, pairs)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scores_are_those_computed_by_hand() {
        let time = [0.0, 0.1, 0.2, 0.3];
        let measured = [0.0, 3.0, 0.0, -4.0];
        // Twice the measured values: perfectly correlated, a ratio of 2, a difference as large as the values.
        let twice = measured.map(|m| 2.0 * m);
        let score = HistoryScore::new(&time, &measured, &twice);
        assert_eq!((score.peak_measured, score.peak_measured_at_s), (4.0, 0.3));
        assert_eq!(score.peak_ratio, Some(2.0));
        assert!((score.correlation.unwrap_or(0.0) - 1.0).abs() < 1e-15);
        assert_eq!(score.rms_difference, Some(1.0));
        // (1, −1, 1, −1) against (1, 1, −1, −1): uncorrelated; √(0 + 4 + 4 + 0) / √4 = √2.
        let score = HistoryScore::new(&time, &[1.0, -1.0, 1.0, -1.0], &[1.0, 1.0, -1.0, -1.0]);
        assert_eq!(score.correlation, Some(0.0));
        assert!((score.rms_difference.unwrap_or(0.0) - 2f64.sqrt()).abs() < 1e-15);
        let score = HistoryScore::new(&time, &[0.0; 4], &[1.0; 4]);
        assert_eq!(
            (score.peak_ratio, score.correlation, score.rms_difference),
            (None, None, None)
        );
    }

    #[test]
    fn impacts_are_matched_once_and_within_the_window() {
        let (score, pairs) = ImpactScore::new(&[1.0, 2.0, 2.03, 5.0], &[1.01, 2.02, 4.0], 0.05);
        // 2.03 is nearer to 2.02 than 2.0 is; 5.0 and 4.0 are alone.
        assert_eq!(pairs, [[0, 0], [2, 1]]);
        assert_eq!(
            (
                score.measured_count,
                score.computed_count,
                score.matched_count
            ),
            (4, 3, 2)
        );
        assert!(score.time_difference_mean_s.unwrap_or(1.0).abs() < 1e-12);
        assert!((score.time_difference_peak_s.unwrap_or(0.0) - 0.01).abs() < 1e-12);
        let (none, _) = ImpactScore::new(&[], &[1.0], 0.05);
        assert_eq!((none.matched_count, none.time_difference_mean_s), (0, None));
    }
}
