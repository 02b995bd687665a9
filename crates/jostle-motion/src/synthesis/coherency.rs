//! Motions at some distance from a record, which lose coherency with it.

use num_complex::Complex64;

use super::random::Random;
use crate::Accelerogram;
use crate::fault::{MotionFault, within};
use crate::fourier::{forward, inverse};
use crate::integration::end_of;

/// How motions lose coherency with distance d and circular frequency ω: |γ| = exp(−(α ω d/V_s)²).
///
/// J. E. Luco, H. L. Wong (1986), Earthq. Eng. Struct. Dyn. 14, 891–908.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coherency {
    /// α, ≥ 0; about 0.02 to 0.5 \[–\].
    pub alpha: f64,
    /// Shear-wave velocity of the ground, > 0 \[m/s\].
    pub shear_wave_velocity: f64,
    /// Seed of the random part.
    pub seed: u64,
}

/// Half the window in which the strength of the random part over time is averaged \[s\].
const TIME_WINDOW: f64 = 0.5;
/// Half the window in which amplitudes are averaged, relative to the frequency.
const FREQUENCY_WINDOW: f64 = 0.1;
/// Its least half width, in coefficients of the record.
const FEWEST: f64 = 2.0;
/// Pivots below this fraction of the greatest are rounding errors.
const NO_PIVOT: f64 = 1e-12;

impl Coherency {
    /// |γ| at a frequency \[Hz\] and a distance \[m\].
    #[must_use]
    pub fn at(&self, frequency: f64, distance: f64) -> f64 {
        libm::exp(-self.exponent(frequency) * distance * distance)
    }

    /// (α ω/V_s)² \[1/m²\].
    fn exponent(&self, frequency: f64) -> f64 {
        let omega = std::f64::consts::TAU * frequency;
        (self.alpha * omega / self.shear_wave_velocity).powi(2)
    }

    fn check(&self) -> Result<(), MotionFault> {
        within(
            "alpha of the coherency",
            "at or above zero",
            self.alpha,
            self.alpha >= 0.0,
        )?;
        within(
            "the shear-wave velocity of the coherency",
            "above zero",
            self.shear_wave_velocity,
            self.shear_wave_velocity > 0.0,
        )
    }
}

/// Motions at some places along a row \[m\], given the record at place 0, without the delay of waves.
///
/// Every Fourier coefficient is A_j = γ_0j A₀ + Σ_k L_jk ξ_k |Ā₀|, with L Lᵀ = Σ_SS − Σ_S0 Σ_0S: its coherency with the
/// record, and of any two of them, is γ, and its strength on average that of the record. The random part ξ is white noise
/// under the envelope of the record, and |Ā₀| the smoothed amplitude of the record. For small ω it goes as √2 α d/V_s ω |A₀|,
/// so velocities do not drift; what the ends of the window cut off is put right, so that every motion ends with the velocity and
/// the displacement of the record. At place 0 the motion is the record.
///
/// Conditional simulation: E. H. Vanmarcke, G. A. Fenton (1991), Struct. Saf. 10, 247–264.
///
/// # Errors
/// [`MotionFault`] when a number is out of range.
pub fn coherent_with(
    record: &Accelerogram,
    places: &[f64],
    coherency: &Coherency,
) -> Result<Vec<Accelerogram>, MotionFault> {
    coherency.check()?;
    // Each place once, so that buildings at the same place move alike.
    let mut apart: Vec<f64> = Vec::new();
    for place in places.iter().filter(|place| **place != 0.0) {
        if !apart.contains(place) {
            apart.push(*place);
        }
    }
    let (n, h) = (record.points(), record.step());
    let length = (2 * n).next_power_of_two();
    let base = forward(record.acceleration(), length);
    let strength = smoothed_amplitude(&base[..=length / 2], n);
    let envelope = envelope(record);
    let mut random = Random::new(coherency.seed);
    let noise: Vec<Vec<Complex64>> = apart
        .iter()
        .map(|_| {
            let mut values = vec![0.0; n];
            for pair in values.chunks_mut(2) {
                for (value, normal) in pair.iter_mut().zip(random.normal_pair()) {
                    *value = normal;
                }
            }
            for (value, share) in values.iter_mut().zip(&envelope) {
                *value *= share;
            }
            forward(&values, length)
        })
        .collect();
    let mut spectra = vec![vec![Complex64::default(); length / 2 + 1]; apart.len()];
    let mut factor = vec![vec![0.0; apart.len()]; apart.len()];
    for k in 0..=length / 2 {
        let frequency = k as f64 / (length as f64 * h);
        factorize(&mut factor, &apart, coherency.exponent(frequency));
        for (j, spectrum) in spectra.iter_mut().enumerate() {
            let mut value = coherency.at(frequency, apart[j]) * base[k];
            for (share, noise) in factor[j].iter().zip(&noise).take(j + 1) {
                value += share * strength[k] * noise[k];
            }
            spectrum[k] = value;
        }
    }
    let end = end_of(h, record.acceleration());
    let made = spectra.iter().map(|spectrum| {
        let mut values = inverse(spectrum, length);
        values.truncate(n);
        Accelerogram::new(h, values).map(|accelerogram| accelerogram.ending_with(end))
    });
    let made = made.collect::<Result<Vec<_>, _>>()?;
    let at = |place: &f64| {
        let index = apart.iter().position(|candidate| candidate == place);
        index.map_or_else(|| record.clone(), |index| made[index].clone())
    };
    Ok(places.iter().map(at).collect())
}

/// Lower factor of γ_ij − γ_0i γ_0j = e^(−s(x_i² + x_j²)) (e^(2 s x_i x_j) − 1), which may be singular.
fn factorize(factor: &mut [Vec<f64>], places: &[f64], s: f64) {
    let entry = |i: usize, j: usize| {
        let (x, y) = (places[i], places[j]);
        // Without overflow at high frequencies.
        libm::exp(-s * (x - y).powi(2)) - libm::exp(-s * (x * x + y * y))
    };
    let exact = |i: usize, j: usize| {
        let (x, y) = (places[i], places[j]);
        let exponent = 2.0 * s * x * y;
        if exponent.abs() < 1.0 {
            libm::exp(-s * (x * x + y * y)) * libm::expm1(exponent)
        } else {
            entry(i, j)
        }
    };
    let greatest = (0..places.len()).map(|i| exact(i, i)).fold(0.0, f64::max);
    for i in 0..places.len() {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
            let left = exact(i, j) - known;
            factor[i][j] = if i == j {
                if left > NO_PIVOT * greatest {
                    left.sqrt()
                } else {
                    0.0
                }
            } else if factor[j][j] > 0.0 {
                left / factor[j][j]
            } else {
                0.0
            };
        }
    }
}

/// Root mean square of the amplitudes around every frequency.
fn smoothed_amplitude(coefficients: &[Complex64], points: usize) -> Vec<f64> {
    let mut sums = Vec::with_capacity(coefficients.len() + 1);
    let mut sum = 0.0;
    sums.push(sum);
    for value in coefficients {
        sum += value.norm_sqr();
        sums.push(sum);
    }
    // Padding puts several coefficients in the place of one of the record.
    let spread = 2.0 * (coefficients.len() - 1) as f64 / points as f64;
    let last = coefficients.len() - 1;
    (0..coefficients.len())
        .map(|k| {
            let half = (FREQUENCY_WINDOW * k as f64).max(FEWEST * spread).round() as usize;
            let half = half.min(k).min(last - k);
            let (first, after) = (k - half, k + half + 1);
            ((sums[after] - sums[first]) / (after - first) as f64).sqrt()
        })
        .collect()
}

/// Strength of the record over time, with a sum of squares of 1.
fn envelope(record: &Accelerogram) -> Vec<f64> {
    let a = record.acceleration();
    let half = (TIME_WINDOW / record.step()).round() as usize;
    let squares: Vec<f64> = std::iter::once(0.0)
        .chain(a.iter().scan(0.0, |sum, a| {
            *sum += a * a;
            Some(*sum)
        }))
        .collect();
    let power: Vec<f64> = (0..a.len())
        .map(|i| {
            let (first, after) = (i.saturating_sub(half), (i + half + 1).min(a.len()));
            (squares[after] - squares[first]) / (after - first) as f64
        })
        .collect();
    let whole: f64 = power.iter().sum();
    power
        .iter()
        .map(|power| {
            if whole > 0.0 {
                (power / whole).sqrt()
            } else {
                0.0
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthesis::{Envelope, GroundFilter, StochasticSettings, stochastic};

    fn record(seed: u64) -> Accelerogram {
        let settings = StochasticSettings {
            step: 0.01,
            envelope: Envelope::of_duration(20.0),
            seed,
            filter: GroundFilter {
                frequency: 2.5,
                damping: 0.6,
                high_pass: Some([0.25, 0.6]),
            },
            peak: 3.0,
        };
        stochastic(&settings).expect("a record")
    }

    const LAW: Coherency = Coherency {
        alpha: 0.2,
        shear_wave_velocity: 300.0,
        seed: 0,
    };

    /// |Σ A* B| / √(Σ|A|² Σ|B|²) over many records and seeds and a band of frequencies.
    #[test]
    fn measured_coherency_is_that_of_the_law() {
        let (places, seeds) = ([30.0, 80.0], 600);
        let length = 2048;
        let bands = [(0.5, 1.0), (1.0, 2.0), (2.0, 3.0), (3.0, 5.0)];
        let pairs = [[0, 1], [0, 2], [1, 2]];
        let mut sums = vec![[0.0; 2]; bands.len() * pairs.len()];
        let mut cross = vec![Complex64::default(); bands.len() * pairs.len()];
        let mut law = vec![[0.0; 2]; bands.len() * pairs.len()];
        for seed in 0..seeds {
            let record = record(1000 + seed);
            let made =
                coherent_with(&record, &places, &Coherency { seed, ..LAW }).expect("motions");
            let spectra: Vec<_> = std::iter::once(&record)
                .chain(&made)
                .map(|motion| forward(motion.acceleration(), length))
                .collect();
            for (band, (low, high)) in bands.iter().enumerate() {
                for (pair, [a, b]) in pairs.iter().enumerate() {
                    let at = band * pairs.len() + pair;
                    let all = [0.0, places[0], places[1]];
                    for k in 1..length / 2 {
                        let f = k as f64 / (length as f64 * 0.01);
                        if !(*low..*high).contains(&f) {
                            continue;
                        }
                        let [x, y] = [spectra[*a][k], spectra[*b][k]];
                        cross[at] += x.conj() * y;
                        sums[at][0] += x.norm_sqr();
                        sums[at][1] += y.norm_sqr();
                        let weight = spectra[0][k].norm_sqr();
                        law[at][0] += weight * LAW.at(f, all[*b] - all[*a]);
                        law[at][1] += weight;
                    }
                }
            }
        }
        for at in 0..sums.len() {
            let measured = cross[at].norm() / (sums[at][0] * sums[at][1]).sqrt();
            let expected = law[at][0] / law[at][1];
            assert!(
                (measured - expected).abs() < 0.015,
                "{at}: {measured}, {expected}"
            );
            // As strong as the record.
            let ratio = sums[at][1] / sums[at][0];
            assert!((ratio - 1.0).abs() < 0.05, "{at}: {ratio}");
        }
    }

    #[test]
    fn the_same_seed_gives_the_same_motion_and_no_distance_the_record() {
        let record = record(5);
        let make = |seed| coherent_with(&record, &[0.0, 40.0, 40.0], &Coherency { seed, ..LAW });
        let [one, same, other] = [3, 3, 4].map(|seed| make(seed).expect("motions"));
        assert_eq!(one, same);
        assert_eq!((&one[0], &one[1]), (&record, &one[2]));
        assert_ne!(one[1], other[1]);
        let coherent = Coherency { alpha: 0.0, ..LAW };
        let alike = coherent_with(&record, &[50.0], &coherent).expect("motions");
        let peak = record
            .acceleration()
            .iter()
            .fold(0.0_f64, |m, a| m.max(a.abs()));
        for (a, b) in alike[0].acceleration().iter().zip(record.acceleration()) {
            assert!((a - b).abs() < 1e-9 * peak, "{a}, {b}");
        }
        assert!(coherent_with(&record, &[1.0], &Coherency { alpha: -1.0, ..LAW }).is_err());
    }

    /// Velocities end as that of the record does, and displacements stay of its size.
    #[test]
    fn motions_do_not_drift() {
        let record = record(5);
        let size = |motion: &Accelerogram| {
            let u = crate::displacement(motion);
            u.iter().fold(0.0_f64, |most, u| most.max(u.abs()))
        };
        let known = size(&record);
        let end = end_of(0.01, record.acceleration());
        for seed in 0..50 {
            let made =
                coherent_with(&record, &[50.0], &Coherency { seed, ..LAW }).expect("motions");
            let [v, u] = end_of(0.01, made[0].acceleration());
            assert!((v - end[0]).abs() < 1e-9, "{v}");
            assert!((u - end[1]).abs() < 1e-9, "{u}");
            assert!(
                size(&made[0]) < 1.25 * known,
                "{} of {known}",
                size(&made[0])
            );
        }
    }
}
