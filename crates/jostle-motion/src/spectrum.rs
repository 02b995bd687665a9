//! Elastic response spectra.

use crate::Accelerogram;
use crate::fault::{MotionFault, within};
use crate::oscillator::Oscillator;
use crate::peaks::{peak_responses, peaks_at_steps};

/// Response spectra of a motion for several damping ratios.
#[derive(Clone, Debug, PartialEq)]
pub struct ResponseSpectrum {
    /// Natural periods \[s\].
    pub periods: Vec<f64>,
    /// One curve per damping ratio.
    pub curves: Vec<SpectrumCurve>,
}

/// Peak responses for one damping ratio, by period.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectrumCurve {
    /// Damping ratio \[–\].
    pub damping: f64,
    /// Peak displacement relative to the ground, SD \[m\].
    pub displacement: Vec<f64>,
    /// Pseudo-velocity, PSV = ω SD \[m/s\].
    pub pseudo_velocity: Vec<f64>,
    /// Pseudo-acceleration, PSA = ω² SD \[m/s²\].
    pub pseudo_acceleration: Vec<f64>,
    /// Peak total acceleration, SA \[m/s²\].
    pub total_acceleration: Vec<f64>,
}

/// Where peaks of the response are read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reading {
    /// At the ends of the steps of the record, cut so that there are at least twenty in a period: the reading of
    /// published tables, up to 1.2 % below the true peak.
    #[default]
    Steps,
    /// Wherever they are: exact for straight lines of ground acceleration.
    Between,
}

/// Response spectra by the exact recursion for straight lines of ground acceleration.
///
/// Periods must be ≥ 0 \[s\] (0 is the rigid oscillator: PSA and SA are the peak ground acceleration), damping
/// ratios in `0..1` \[–\]. Peaks are those within the record; pad it with zeros to include the free vibration after
/// its end.
///
/// # Errors
/// [`MotionFault::Range`] for a period or damping ratio out of range.
pub fn response_spectrum(
    motion: &Accelerogram,
    periods: &[f64],
    dampings: &[f64],
    reading: Reading,
) -> Result<ResponseSpectrum, MotionFault> {
    check_ranges(periods, dampings)?;
    let oscillators: Vec<Oscillator> = dampings
        .iter()
        .flat_map(|&damping| {
            periods
                .iter()
                .map(move |&period| Oscillator { period, damping })
        })
        .collect();
    let peaks = match reading {
        Reading::Steps => peaks_at_steps(motion, &oscillators),
        Reading::Between => {
            let responses = peak_responses(motion, &oscillators);
            let both = responses
                .iter()
                .map(|r| [r.pseudo_acceleration, r.total_acceleration]);
            both.map(|both| both.map(|extreme| extreme.value.abs()))
                .collect()
        }
    };
    let curve = |(i, &damping): (usize, &f64)| {
        curve(
            damping,
            periods,
            &peaks[i * periods.len()..(i + 1) * periods.len()],
        )
    };
    Ok(ResponseSpectrum {
        periods: periods.to_vec(),
        curves: dampings.iter().enumerate().map(curve).collect(),
    })
}

/// Refuses periods and damping ratios out of range.
pub(crate) fn check_ranges(periods: &[f64], dampings: &[f64]) -> Result<(), MotionFault> {
    for &period in periods {
        within(
            "a period",
            "between 0 and 1000 s",
            period,
            (0.0..=1e3).contains(&period),
        )?;
    }
    for &damping in dampings {
        within(
            "a damping ratio",
            "from 0 to below 1",
            damping,
            (0.0..1.0).contains(&damping),
        )?;
    }
    Ok(())
}

pub(crate) fn curve(damping: f64, periods: &[f64], peaks: &[[f64; 2]]) -> SpectrumCurve {
    let tau = std::f64::consts::TAU;
    let all = |f: &dyn Fn(f64, [f64; 2]) -> f64| {
        let pairs = periods.iter().zip(peaks);
        pairs.map(|(&period, &peak)| f(period, peak)).collect()
    };
    SpectrumCurve {
        damping,
        displacement: all(&|t, [pseudo, _]| pseudo * (t / tau).powi(2)),
        pseudo_velocity: all(&|t, [pseudo, _]| pseudo * t / tau),
        pseudo_acceleration: all(&|_, [pseudo, _]| pseudo),
        total_acceleration: all(&|_, [_, total]| total),
    }
}

/// `count` periods at equal ratios from `first` to `last`, both > 0 \[s\].
#[must_use]
pub fn spaced_periods(first: f64, last: f64, count: usize) -> Vec<f64> {
    let ratio = libm::log(last / first) / (count.max(2) - 1) as f64;
    (0..count)
        .map(|i| match i {
            0 => first,
            _ if i + 1 == count => last,
            _ => first * libm::exp(ratio * i as f64),
        })
        .collect()
}
