//! Response spectra against Duhamel's integral and closed forms.

use std::f64::consts::{PI, TAU};

use jostle_motion::Reading::{Between, Steps};
use jostle_motion::{
    Accelerogram, Oscillator, measures, peak_responses, response_spectrum, spaced_periods,
};

use crate::support::{assert_near, el_centro, rough};

/// Duhamel's integral of straight lines of acceleration, each cut into many pieces taken with Simpson's rule;
/// the greatest of all ends of pieces.
fn duhamel(motion: &Accelerogram, period: f64, damping: f64, pieces: usize) -> [f64; 2] {
    let omega = TAU / period;
    let damped = omega * (1.0 - damping * damping).sqrt();
    // u(t) = −1/ω_d ∫ a(τ) e^{−ζω(t−τ)} sin ω_d(t−τ) dτ, kept as the two integrals with cos and sin of τ and
    // brought along by the decay of a piece.
    let h = motion.step() / pieces as f64;
    let decay = (-damping * omega * h).exp();
    let half = (-damping * omega * h / 2.0).exp();
    let (mut c, mut s) = (0.0, 0.0);
    let (mut peak, mut total) = (0.0_f64, 0.0_f64);
    for (i, pair) in motion.acceleration().windows(2).enumerate() {
        let at = |share: f64| pair[0] + share * (pair[1] - pair[0]);
        for piece in 0..pieces {
            let t = motion.step() * i as f64 + h * piece as f64;
            let x = [0.0, 0.5, 1.0].map(|k| at((piece as f64 + k) / pieces as f64));
            let phase = [0.0, 0.5, 1.0].map(|k| damped * (t + k * h));
            let weight = [decay * h / 6.0, half * 4.0 * h / 6.0, h / 6.0];
            c *= decay;
            s *= decay;
            for k in 0..3 {
                c += weight[k] * x[k] * phase[k].cos();
                s += weight[k] * x[k] * phase[k].sin();
            }
            let (sine, cosine) = phase[2].sin_cos();
            let u = -(sine * c - cosine * s) / damped;
            let du = -(cosine * c + sine * s) - damping * omega * u;
            peak = peak.max(u.abs());
            total = total.max((omega * omega * u + 2.0 * damping * omega * du).abs());
        }
    }
    [peak, total]
}

#[test]
fn duhamels_integral_gives_the_same_peaks() {
    let motion = el_centro();
    // Pieces short enough for the greatest of their ends to be the peak within 2e-5.
    for (period, pieces) in [(0.05, 200), (0.2, 60), (0.731, 20), (2.0, 40), (7.0, 40)] {
        for damping in [0.02, 0.1, 0.4] {
            let [u, total] = duhamel(&motion, period, damping, pieces);
            let spectrum =
                response_spectrum(&motion, &[period], &[damping], Between).expect("a spectrum");
            let curve = &spectrum.curves[0];
            let what = format!("T = {period} s, {damping}");
            assert_near(curve.displacement[0], u, 2e-5, &what);
            assert_near(curve.total_acceleration[0], total, 2e-5, &what);
        }
    }
}

#[test]
fn a_suddenly_applied_acceleration_doubles() {
    // From a(0) = 1 on, undamped: ω²u = −(1 − cos ωt), exactly 2 at half a period, wherever the samples lie.
    let motion = Accelerogram::new(0.01, vec![1.0; 500]).expect("a motion");
    for period in [0.003, 0.0131, 0.0377, 0.2, 0.777, 3.1] {
        let response = peak_responses(
            &motion,
            &[Oscillator {
                period,
                damping: 0.0,
            }],
        )[0];
        assert_near(-response.pseudo_acceleration.value, 2.0, 1e-10, "step load");
        assert!(
            ((response.pseudo_acceleration.at / period - 0.5).fract() < 1e-6)
                || ((response.pseudo_acceleration.at / period + 0.5).fract() > 1.0 - 1e-6),
            "at {} of T = {period}",
            response.pseudo_acceleration.at
        );
        // Damped: the first overshoot is 1 + exp(−πζ/√(1−ζ²)).
        let z = 0.1_f64;
        let response = peak_responses(&motion, &[Oscillator { period, damping: z }])[0];
        let overshoot = 1.0 + (-PI * z / (1.0 - z * z).sqrt()).exp();
        assert_near(
            -response.pseudo_acceleration.value,
            overshoot,
            1e-10,
            "damped",
        );
    }
}

#[test]
fn peaks_hold_however_finely_the_record_is_cut() {
    let motion = rough(900, 0.02);
    let cut = 64;
    let fine: Vec<f64> = (0..=899 * cut)
        .map(|i| {
            let (at, part) = (i / cut, (i % cut) as f64 / cut as f64);
            let a = motion.acceleration();
            if at + 1 < a.len() {
                a[at] + part * (a[at + 1] - a[at])
            } else {
                a[at]
            }
        })
        .collect();
    let fine = Accelerogram::new(0.02 / cut as f64, fine).expect("a motion");
    let periods = spaced_periods(0.004, 20.0, 60);
    for damping in [0.0, 0.05, 0.3, 0.95] {
        let coarse = response_spectrum(&motion, &periods, &[damping], Between).expect("a spectrum");
        let fine = response_spectrum(&fine, &periods, &[damping], Between).expect("a spectrum");
        // With phases of 1e-4 in a step, the rounding of the coefficients changes ω² by some 1e-9.
        for (i, period) in periods.iter().enumerate() {
            let what = format!("T = {period}, {damping}");
            let (a, b) = (&coarse.curves[0], &fine.curves[0]);
            assert_near(a.displacement[i], b.displacement[i], 1e-8, &what);
            assert_near(
                a.total_acceleration[i],
                b.total_acceleration[i],
                1e-8,
                &what,
            );
        }
    }
}

#[test]
fn limits_are_the_ground() {
    let motion = el_centro();
    let spectrum =
        response_spectrum(&motion, &[0.0, 1e-7, 1e-3, 900.0], &[0.05], Between).expect("spectrum");
    let curve = &spectrum.curves[0];
    for i in 0..3 {
        assert_near(curve.pseudo_acceleration[i], motion.peak(), 1e-3, "rigid");
        assert_near(curve.total_acceleration[i], motion.peak(), 1e-3, "rigid");
    }
    // A mass on a spring too soft to matter stays where it was.
    let pgd = measures(&motion).expect("measures").pgd.value;
    assert_near(curve.displacement[3], pgd, 2e-2, "soft");
}

#[test]
fn order_and_company_of_oscillators_do_not_matter() {
    let motion = rough(500, 0.01);
    let periods = spaced_periods(0.01, 10.0, 37);
    let all = response_spectrum(&motion, &periods, &[0.02, 0.05], Between).expect("a spectrum");
    for (i, period) in periods.iter().enumerate() {
        let one = response_spectrum(&motion, &[*period], &[0.05], Between).expect("a spectrum");
        assert_near(
            one.curves[0].pseudo_acceleration[0],
            all.curves[1].pseudo_acceleration[i],
            1e-10,
            "alone or in company",
        );
    }
}

#[test]
fn peaks_at_steps_lie_little_below() {
    let motion = rough(2000, 0.01);
    let periods = spaced_periods(0.02, 10.0, 100);
    let at = |reading| response_spectrum(&motion, &periods, &[0.05], reading).expect("a spectrum");
    let (steps, between) = (at(Steps), at(Between));
    for (a, b) in [
        (
            &steps.curves[0].displacement,
            &between.curves[0].displacement,
        ),
        (
            &steps.curves[0].total_acceleration,
            &between.curves[0].total_acceleration,
        ),
    ] {
        for (steps, between) in a.iter().zip(b) {
            let ratio = steps / between;
            assert!((0.987..=1.0 + 1e-12).contains(&ratio), "{ratio}");
        }
    }
}
