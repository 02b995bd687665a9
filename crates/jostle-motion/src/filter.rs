//! Zero-phase Butterworth filters.

use std::f64::consts::PI;

use biquad::{Biquad, Coefficients, DirectForm2Transposed, ToHertz, Type};

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
    for (corner, kind) in [(filter.low, Type::HighPass), (filter.high, Type::LowPass)] {
        if let Some(corner) = corner {
            for section in sections(kind, corner, order, motion.step())? {
                pass(&mut values, section);
                values.reverse();
                pass(&mut values, section);
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

fn pass(values: &mut [f64], section: Coefficients<f64>) {
    let mut section = DirectForm2Transposed::<f64>::new(section);
    for value in values {
        *value = section.run(*value);
    }
}

/// Second-order sections: poles at the angles (2k + 1) π/2n have the quality 1/(2 cos angle).
fn sections(
    kind: Type<f64>,
    corner: f64,
    order: usize,
    step: f64,
) -> Result<Vec<Coefficients<f64>>, MotionFault> {
    let section = |k: usize| {
        let angle = (2 * k + 1) as f64 * PI / (2 * order) as f64;
        let quality = 0.5 / angle.cos();
        Coefficients::from_params(kind, (1.0 / step).hz(), corner.hz(), quality)
    };
    let sections: Result<Vec<_>, _> = (0..order / 2).map(section).collect();
    sections.map_err(|_| MotionFault::Range {
        what: "a corner frequency",
        range: "between 0 and half the sampling frequency",
        found: corner,
    })
}
