//! Artificial waves keep what they promise.

use jostle_motion::Reading::Between;
use jostle_motion::{
    Accelerogram, En1998, EnGround, EnType, Envelope, GroundFilter, MatchSettings, SineSettings,
    StochasticSettings, TargetKind, TargetSpectrum, displacement, fourier_spectrum, match_spectrum,
    recipe, response_spectrum, spectrum_compatible, stochastic, velocity,
};

use crate::support::{assert_near, el_centro};

/// Spectrum of the result against the target on 500 periods that the matching did not see, by the independent reading
/// of the spectrum; velocity and displacement at the end.
fn assert_matched(motion: &Accelerogram, target: &TargetSpectrum, settings: &MatchSettings) {
    let [first, last] = settings.periods;
    let ratio = (last / first).powf(1.0 / 499.0);
    let periods: Vec<f64> = (0..500).map(|i| first * ratio.powi(i)).collect();
    let spectrum =
        response_spectrum(motion, &periods, &[settings.damping], Between).expect("spectrum");
    for (value, &period) in spectrum.curves[0].pseudo_acceleration.iter().zip(&periods) {
        let wanted = target
            .acceleration(period.min(last), settings.damping)
            .expect("in range");
        assert_near(*value, wanted, 0.05, &format!("T = {period}"));
    }
    let (v, u) = (velocity(motion), displacement(motion));
    assert!(
        v[v.len() - 1].abs() < 1e-10,
        "final velocity {}",
        v[v.len() - 1]
    );
    assert!(
        u[u.len() - 1].abs() < 1e-10,
        "final displacement {}",
        u[u.len() - 1]
    );
}

#[test]
fn the_wave_of_nanjing_follows_its_spectrum() {
    let recipe = recipe("nanjing-artificial").expect("the recipe");
    let made = recipe.make().expect("a wave");
    assert_near(made.motion.peak(), 0.35, 1e-9, "PGA");
    assert_near(made.motion.duration(), 40.0, 1e-12, "duration");
    assert_matched(&made.motion, &recipe.target(), &recipe.matching());
    let pgd = displacement(&made.motion)
        .iter()
        .fold(0.0_f64, |m, u| m.max(u.abs()));
    // The spectral displacement at 6 s is 107 mm; a drift would be many times that.
    assert!(pgd < 0.1, "PGD {pgd}");
    assert_eq!(
        recipe.make().expect("again").motion,
        made.motion,
        "the same bits"
    );
}

#[test]
fn other_seeds_and_spectra_are_matched_too() {
    for (seed, ground, step, duration) in [
        (1, EnGround::A, 0.01, 20.0),
        (2, EnGround::C, 0.005, 25.0),
        (99, EnGround::D, 0.01, 40.0),
    ] {
        let target = TargetSpectrum::new(TargetKind::En1998(En1998 {
            kind: EnType::One,
            ground,
            ground_acceleration: 2.5,
        }));
        let matching = MatchSettings {
            peak: target.peak_ground_acceleration(),
            ..MatchSettings::default()
        };
        let settings = SineSettings {
            step,
            envelope: Envelope::of_duration(duration),
            seed,
            matching,
        };
        let made = spectrum_compatible(&target, &settings).expect("a wave");
        assert_near(
            made.motion.peak(),
            matching.peak.expect("a peak"),
            1e-9,
            "PGA",
        );
        assert_near(made.motion.duration(), duration, 1e-12, "duration");
        assert_matched(&made.motion, &target, &matching);
    }
}

#[test]
fn el_centro_is_matched_and_stays_itself() {
    let target = TargetSpectrum::new(TargetKind::En1998(En1998 {
        kind: EnType::One,
        ground: EnGround::C,
        ground_acceleration: 3.0,
    }));
    // Records at 0.02 s show periods from 0.1 s on.
    let settings = MatchSettings {
        periods: [0.1, 3.0],
        ..MatchSettings::default()
    };
    let seed = el_centro();
    let made = match_spectrum(&seed, &target, &settings).expect("a match");
    assert_matched(&made.motion, &target, &settings);
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let (a, b) = (seed.acceleration(), made.motion.acceleration());
    let likeness = product(a, b) / (product(a, a) * product(b, b)).sqrt();
    assert!(likeness > 0.8, "correlation with the record {likeness}");
}

#[test]
fn impossible_matches_say_how_far_they_came() {
    let target = TargetSpectrum::new(TargetKind::En1998(En1998 {
        kind: EnType::One,
        ground: EnGround::C,
        ground_acceleration: 3.0,
    }));
    // A peak acceleration of a tenth of the plateau cannot be.
    let settings = MatchSettings {
        periods: [0.1, 3.0],
        peak: Some(0.5),
        ..MatchSettings::default()
    };
    let error = match_spectrum(&el_centro(), &target, &settings).expect_err("no match");
    assert!(
        error.to_string().contains("reaches the spectrum only to"),
        "{error}"
    );
}

#[test]
fn filtered_noise_has_its_density() {
    let filter = GroundFilter {
        frequency: 2.5,
        damping: 0.6,
        high_pass: Some([0.25, 0.6]),
    };
    let (step, duration) = (0.01, 40.95);
    let envelope = Envelope {
        rise: 0.01,
        decay: 38.9,
        rate: 0.0,
        duration,
    };
    let bands = [0.3, 1.0, 2.5, 5.0, 10.0, 20.0];
    let mut powers = [0.0; 6];
    let members = 60;
    for seed in 0..members {
        let settings = StochasticSettings {
            step,
            envelope,
            seed,
            filter,
            peak: 1.0,
        };
        let motion = stochastic(&settings).expect("a wave");
        assert_near(motion.peak(), 1.0, 1e-12, "peak");
        assert!(velocity(&motion).last().is_some_and(|v| v.abs() < 1e-10));
        // Each wave is scaled to its peak; compare shapes after scaling to equal power.
        let power: f64 = motion.acceleration().iter().map(|a| a * a).sum();
        let spectrum = fourier_spectrum(&motion, 0.03);
        for (band, sum) in bands.iter().zip(&mut powers) {
            let near = spectrum.frequency.iter().zip(&spectrum.amplitude);
            let inside: Vec<f64> = near
                .filter(|(f, _)| (*f / band - 1.0).abs() < 0.15)
                .map(|(f, a)| a * a / filter.density(*f))
                .collect();
            *sum += inside.iter().sum::<f64>() / inside.len() as f64 / power;
        }
    }
    // Every band holds 60 waves with at least three independent frequencies: 180 exponential numbers scatter by 7 %.
    for (band, power) in bands.iter().zip(powers) {
        assert_near(power, powers[2], 0.25, &format!("density at {band} Hz"));
    }
}
