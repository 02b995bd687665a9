//! Zero-phase Butterworth filters.

use std::f64::consts::PI;

use crate::Accelerogram;
use crate::fault::{MotionFault, within};

/// Corners and order of a filter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Butterworth {
    /// Corner of the high-pass, > 0 and below that of the low-pass; `None` lets low frequencies pass \[Hz\].
    pub low: Option<f64>,
    /// Corner of the low-pass, below the Nyquist frequency; `None` lets high frequencies pass \[Hz\].
    pub high: Option<f64>,
    /// Order of each pass: 2, 4, 6 or 8.
    pub order: usize,
}

/// Filters a motion forwards and backwards.
///
/// A band-pass is a high-pass followed by a low-pass. Each is a cascade of second-order sections by the bilinear
/// transform with the corner kept in place. Both directions together leave the phase alone and have the gain
///
/// ```text
/// |H|² = 1/(1 + (w/w_c)^{±2n}),   w = tan(πf h),  w_c = tan(πf_c h)
/// ```
///
/// that is one half at a corner. The motion is padded with zeros of 1.5 n/f_low on either side while it is filtered
/// (D. M. Boore, 2005, Bull. Seismol. Soc. Am. 95, 745–750) and cut back to its length afterwards.
///
/// # Errors
/// When a corner or the order is out of range.
pub fn butterworth(
    motion: &Accelerogram,
    filter: &Butterworth,
) -> Result<Accelerogram, MotionFault> {
    let order = filter.order;
    let good = matches!(order, 2 | 4 | 6 | 8);
    within(
        "the order of a filter",
        "among 2, 4, 6 and 8",
        order as f64,
        good,
    )?;
    let nyquist = 0.5 / motion.step();
    for corner in [filter.low, filter.high].into_iter().flatten() {
        let good = corner > 0.0 && corner < nyquist;
        within(
            "a corner frequency",
            "between 0 and half the sampling frequency",
            corner,
            good,
        )?;
    }
    if let (Some(low), Some(high)) = (filter.low, filter.high)
        && low >= high
    {
        return Err(MotionFault::Order {
            smaller: "the corner of the high-pass",
            larger: "that of the low-pass",
            found: [low, high],
        });
    }
    let lowest = filter.low.or(filter.high).unwrap_or(nyquist);
    let pad = (1.5 * order as f64 / lowest / motion.step()).ceil();
    crate::accelerogram::check_points(2.0 * pad + motion.points() as f64)?;
    let pad = pad as usize;
    let mut values = vec![0.0; pad];
    values.extend_from_slice(motion.acceleration());
    values.resize(motion.points() + 2 * pad, 0.0);
    for (corner, passes_high) in [(filter.low, true), (filter.high, false)] {
        if let Some(corner) = corner {
            for section in sections(passes_high, corner, order, motion.step()) {
                pass(&mut values, &section);
                values.reverse();
                pass(&mut values, &section);
                values.reverse();
            }
        }
    }
    motion.with(values[pad..pad + motion.points()].to_vec())
}

/// A low-pass alone.
pub(crate) fn low_pass(
    motion: &Accelerogram,
    corner: f64,
    order: usize,
) -> Result<Accelerogram, MotionFault> {
    butterworth(
        motion,
        &Butterworth {
            low: None,
            high: Some(corner),
            order,
        },
    )
}

/// A second-order section: y = (b₀ + b₁ z⁻¹ + b₂ z⁻²)/(1 + a₁ z⁻¹ + a₂ z⁻²) x.
struct Section {
    b: [f64; 3],
    a: [f64; 2],
}

fn pass(values: &mut [f64], section: &Section) {
    let Section {
        b: [b0, b1, b2],
        a: [a1, a2],
    } = *section;
    let (mut first, mut second) = (0.0, 0.0);
    for value in values {
        let input = *value;
        *value = first + b0 * input;
        first = second + b1 * input - a1 * *value;
        second = b2 * input - a2 * *value;
    }
}

/// Second-order sections: poles at the angles (2k + 1) π/2n have the quality 1/(2 cos angle). The bilinear transform keeps the corner
/// (R. Bristow-Johnson, Cookbook formulae for audio equalizer biquad filter coefficients).
fn sections(passes_high: bool, corner: f64, order: usize, step: f64) -> Vec<Section> {
    let (sine, cosine) = libm::sincos(2.0 * PI * corner * step);
    let section = |k: usize| {
        let angle = (2 * k + 1) as f64 * PI / (2 * order) as f64;
        // sin ω/(2 Q).
        let alpha = sine * libm::cos(angle);
        let scale = 1.0 / (1.0 + alpha);
        let (end, middle) = if passes_high {
            (0.5 * (1.0 + cosine), -(1.0 + cosine))
        } else {
            (0.5 * (1.0 - cosine), 1.0 - cosine)
        };
        Section {
            b: [end * scale, middle * scale, end * scale],
            a: [-2.0 * cosine * scale, (1.0 - alpha) * scale],
        }
    };
    (0..order / 2).map(section).collect()
}
