//! Response spectra as JSON.

use jostle::GroundMotion;
use jostle::motion::Wave;
use jostle_motion::{
    Accelerogram, DuctilitySpectrum, MotionFault, Reading, ResponseSpectrum, ductility_spectrum,
    response_spectrum,
};
use serde_json::{Value, json};

use crate::error::RunError;

/// An inelastic spectrum and its damping ratio.
pub type Inelastic = (f64, DuctilitySpectrum);

/// Response spectra of a motion \[m/s²\] with a step \[s\], as the JSON of the command; `between` looks for peaks
/// between the samples as well.
///
/// # Errors
/// An error in the motion or the numbers.
pub fn spectrum_json(
    step: f64,
    acceleration: Vec<f64>,
    periods: &[f64],
    dampings: &[f64],
    ductilities: &[f64],
    post_yield: f64,
    between: bool,
) -> Result<String, RunError> {
    let motion = Accelerogram::new(step, acceleration).map_err(wrong)?;
    let reading = if between {
        Reading::Between
    } else {
        Reading::Steps
    };
    let elastic = response_spectrum(&motion, periods, dampings, reading).map_err(wrong)?;
    let mut inelastic = Vec::new();
    for &damping in dampings {
        for &ductility in ductilities {
            let found = ductility_spectrum(&motion, periods, ductility, damping, post_yield);
            inelastic.push((damping, found.map_err(wrong)?));
        }
    }
    Ok(spectra_json(&elastic, &inelastic).to_string())
}

/// A ground motion as equally spaced values, with its scale and its length; a wave given by a formula takes 200 in a
/// period.
///
/// # Errors
/// [`MotionFault`] for fewer than two values, or if one is not finite.
pub fn accelerogram(motion: &GroundMotion) -> Result<Accelerogram, MotionFault> {
    let step = match &motion.wave {
        Wave::Sampled { step, .. } => *step,
        Wave::Sine { period, .. } | Wave::Ricker { period, .. } => period / 200.0,
    };
    let count = ((motion.duration / step).round() as usize).clamp(1, 1 << 22);
    let values = (0..=count).map(|i| motion.acceleration(step * i as f64));
    Accelerogram::new(step, values.collect())
}

/// The JSON of `jostle motion spectrum`.
#[must_use]
pub fn spectra_json(elastic: &ResponseSpectrum, inelastic: &[Inelastic]) -> Value {
    let curve = |curve: &jostle_motion::SpectrumCurve| {
        json!({
            "damping": curve.damping,
            "displacement_m": curve.displacement,
            "pseudo_velocity_m_s": curve.pseudo_velocity,
            "pseudo_acceleration_m_s2": curve.pseudo_acceleration,
            "total_acceleration_m_s2": curve.total_acceleration,
        })
    };
    let ductile = |(damping, spectrum): &Inelastic| {
        json!({
            "damping": damping,
            "ductility": spectrum.ductility,
            "yield_acceleration_m_s2": spectrum.yield_acceleration,
            "reduction": spectrum.reduction,
            "displacement_m": spectrum.displacement,
        })
    };
    let mut value = json!({
        "periods_s": elastic.periods,
        "spectra": elastic.curves.iter().map(curve).collect::<Vec<_>>(),
    });
    if !inelastic.is_empty() {
        value["inelastic"] = inelastic.iter().map(ductile).collect();
    }
    value
}

fn wrong(fault: MotionFault) -> RunError {
    RunError::Argument(fault.to_string())
}
