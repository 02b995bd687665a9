//! Records that are scaled to intensities: which of a list fit them best, and by what factor.

use jostle::{GroundMotion, Wave};
use jostle_motion::{Accelerogram, Reading, response_spectrum};

use super::{Shaking, Source, Strength};
use crate::fault::CityError;

/// Damping ratio of spectra \[–\].
const DAMPING: f64 = 0.05;
/// Records that need a greater factor, or a smaller one than its inverse, are taken last \[–\].
const GREATEST_FACTOR: f64 = 4.0;

/// No ground shakes more strongly; a greater number is a mistaken unit [g].
pub(super) const GREATEST: f64 = 10.0;

/// Intensities at places.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Intensities {
    /// Periods of pseudo-spectral accelerations, 0 for the peak acceleration of the ground \[s\].
    pub(super) periods: Vec<f64>,
    /// Names of the events.
    pub(super) events: Vec<String>,
    /// Of every place and of every event of it the intensities of all periods \[m/s²\]; 0 is no shaking.
    pub(super) places: Vec<Vec<Vec<f64>>>,
    /// Where they come from, for people.
    pub(super) told: String,
}

/// What is called PGA or SA(T).
pub(super) fn measure_name(period: f64) -> String {
    if period == 0.0 {
        "PGA".to_owned()
    } else {
        format!("SA({period})")
    }
}

/// The best records of every place and event.
///
/// # Errors
/// When a record has no spectrum, or fewer are listed than are wanted.
pub(super) fn scaled(
    sources: Vec<Source>,
    found: &Intensities,
    choose: usize,
) -> Result<Shaking, CityError> {
    if choose > sources.len() {
        return Err(CityError::Input(format!(
            "motion.choose: {choose} of {} records cannot be chosen; list more, or choose fewer",
            sources.len()
        )));
    }
    let mut spectra = Vec::with_capacity(sources.len());
    for source in &sources {
        let motion = source.resolved.as_ref();
        let motion = motion.ok_or_else(|| CityError::Input("motion: no record".to_owned()))?;
        spectra.push(spectrum(motion, &found.periods)?);
    }
    let mut beyond = 0;
    let mut all = 0;
    let places: Vec<Vec<Strength>> = found
        .places
        .iter()
        .map(|events| {
            let best = events
                .iter()
                .flat_map(|event| best(&spectra, event, choose));
            best.inspect(|strength| {
                all += 1;
                let far = libm::log(strength.factor).abs() > libm::log(GREATEST_FACTOR);
                beyond += usize::from(strength.factor > 0.0 && far);
            })
            .collect()
        })
        .collect();
    let names = found.events.iter().flat_map(|event| {
        (1..=choose).map(move |at| match choose {
            1 => event.clone(),
            _ => format!("{event}, record {at}"),
        })
    });
    let mut told = vec![found.told.clone()];
    let factors = || places.iter().flatten().map(|place| place.factor);
    let ends = factors().fold([f64::INFINITY, 0.0], |[least, most], factor| {
        [least.min(factor), f64::max(most, factor)]
    });
    if all > 0 {
        told.push(format!(
            "Every row takes {} of {} records, scaled by {:.2} to {:.2}{}",
            choose,
            sources.len(),
            ends[0],
            ends[1],
            if beyond > 0 {
                format!(
                    "; {:.1} % of the factors lie beyond 1/{GREATEST_FACTOR} and {GREATEST_FACTOR}: records of weaker or stronger \
                     earthquakes would fit better",
                    100.0 * beyond as f64 / all as f64
                )
            } else {
                String::new()
            }
        ));
    }
    Ok(Shaking {
        names: names.collect(),
        has_directions: sources.iter().any(Source::has_bearing),
        sources,
        places: if places.is_empty() {
            vec![Vec::new()]
        } else {
            places
        },
        place_of: Vec::new(),
        told,
    })
}

/// The records whose spectra have the shape of the intensities, each scaled to their mean logarithm.
fn best(spectra: &[Vec<f64>], wanted: &[f64], choose: usize) -> Vec<Strength> {
    if wanted.iter().all(|candidate| *candidate <= 0.0) {
        let still = |motion| Strength {
            motion,
            factor: 0.0,
        };
        return (0..choose).map(still).collect();
    }
    let mut ranked: Vec<(bool, f64, f64, usize)> = spectra
        .iter()
        .enumerate()
        .map(|(motion, spectra)| {
            let ratios: Vec<f64> = wanted
                .iter()
                .zip(spectra)
                .filter(|both| *both.0 > 0.0)
                .map(|(wanted, ordinate)| libm::log(wanted / ordinate))
                .collect();
            let count = ratios.len() as f64;
            let mean = ratios.iter().sum::<f64>() / count;
            let squares = ratios
                .iter()
                .map(|ratios| (ratios - mean) * (ratios - mean));
            let misfit = (squares.sum::<f64>() / count).sqrt();
            let far = mean.abs() > libm::log(GREATEST_FACTOR);
            // Of records that are too weak or too strong, the nearest; of others, the likest.
            let first = if far || ratios.len() == 1 {
                mean.abs()
            } else {
                misfit
            };
            (far, first, mean, motion)
        })
        .collect();
    ranked.sort_by(|a, b| {
        (a.0.cmp(&b.0))
            .then(a.1.total_cmp(&b.1))
            .then(a.3.cmp(&b.3))
    });
    let strength = |candidate: &(bool, f64, f64, usize)| Strength {
        motion: candidate.3,
        factor: libm::exp(candidate.2),
    };
    ranked[..choose].iter().map(strength).collect()
}

/// Intensities of a motion at some periods; of two components the geometric mean \[m/s²\].
fn spectrum(motion: &GroundMotion, periods: &[f64]) -> Result<Vec<f64>, CityError> {
    let fault = |problem: String| CityError::Input(format!("motion: {}: {problem}", motion.name));
    let one = |motion: &GroundMotion| -> Result<Vec<f64>, CityError> {
        let step = match &motion.wave {
            Wave::Sampled { step, .. } => *step,
            Wave::Sine { period, .. } | Wave::Ricker { period, .. } => period / 200.0,
        };
        let points = (motion.duration / step).round() as usize + 1;
        let values = (0..points).map(|at| motion.acceleration(at as f64 * step));
        let record = Accelerogram::new(step, values.collect());
        let record = record.map_err(|error| fault(error.to_string()))?;
        let spectrum = response_spectrum(&record, periods, &[DAMPING], Reading::Between);
        let spectrum = spectrum.map_err(|error| fault(error.to_string()))?;
        Ok(spectrum.curves[0].pseudo_acceleration.clone())
    };
    let mut values = one(motion)?;
    let across = motion
        .bearing
        .as_ref()
        .and_then(|bearing| bearing.across.as_ref());
    if let Some(across) = across {
        for (one, other) in values.iter_mut().zip(one(across)?) {
            *one = (*one * other).sqrt();
        }
    }
    if values.iter().any(|candidate| *candidate <= 0.0) {
        return Err(fault("has no motion to scale".to_owned()));
    }
    Ok(values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_likest_record_is_chosen_and_scaled_to_the_mean_logarithm() {
        let spectra = [vec![1.0, 2.0], vec![2.0, 2.0], vec![1.0, 2.2]];
        // Twice the first record fits without a rest.
        let found = best(&spectra, &[2.0, 4.0], 2);
        assert_eq!(found[0].motion, 0);
        assert!((found[0].factor - 2.0).abs() < 1e-12);
        assert_eq!(found[1].motion, 2);
        let factor = (2.0_f64 * (4.0 / 2.2)).sqrt();
        assert!((found[1].factor - factor).abs() < 1e-12);
        // One intensity knows no shape: the record next in size.
        let found = best(&[vec![1.0], vec![3.0]], &[2.9], 1);
        assert_eq!(found[0].motion, 1);
        // A record of the right shape that is far too weak comes after one that is not.
        let found = best(&[vec![0.1, 0.2], vec![2.0, 2.0]], &[2.0, 4.0], 1);
        assert_eq!(found[0].motion, 1);
        assert_eq!(best(&spectra, &[0.0, 0.0], 1)[0].factor, 0.0);
    }
}
