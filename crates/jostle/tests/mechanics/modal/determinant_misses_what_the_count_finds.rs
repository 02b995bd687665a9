//! The determinant of the total transfer equation changes sign at simple frequencies only.

use jostle::eigen::{Spectrum, log_determinant, modes};

use crate::modal::support::{stacks, stored_frame, stored_frames};

/// Frequencies between `low` and `high` found by sign changes on a grid and bisection.
fn sign_changes(spectrum: &mut Spectrum, low: f64, high: f64, samples: usize) -> Vec<f64> {
    let at = |k: usize| low + (high - low) * k as f64 / samples as f64;
    let mut found = Vec::new();
    for k in 0..samples {
        let (mut a, mut b) = (at(k), at(k + 1));
        let sign = spectrum.log_determinant(a).sign;
        if spectrum.log_determinant(b).sign == sign {
            continue;
        }
        while b - a > 1e-13 * b {
            let middle = 0.5 * (a + b);
            if spectrum.log_determinant(middle).sign == sign {
                a = middle;
            } else {
                b = middle;
            }
        }
        found.push(0.5 * (a + b));
    }
    found
}

#[test]
fn simple_frequencies_change_its_sign() {
    let frames = stored_frames();
    let building = stored_frame(&frames["D_3bay10"], 1.0);
    let mut spectrum = Spectrum::new(&building).expect("the frame stands");
    let found = sign_changes(&mut spectrum, 1.0, 90.0, 400);
    let expected = modes(&building, 5).expect("the frame stands");
    assert_eq!(found.len(), 5, "{found:?}");
    for (found, mode) in found.iter().zip(&expected) {
        let error = (found / mode.circular_frequency - 1.0).abs();
        assert!(
            error < 1e-10,
            "{found} instead of {}",
            mode.circular_frequency
        );
    }
}

#[test]
fn double_frequencies_do_not() {
    let (lone, twin) = ([(1e4, 2e6)], [(1e4, 5e6)]);
    let building = stacks(&[&lone, &twin, &twin]);
    let (single, double) = (f64::sqrt(200.0), f64::sqrt(500.0));
    let mut spectrum = Spectrum::new(&building).expect("the stacks stand");
    let found = sign_changes(&mut spectrum, 1.0, 100.0, 1234);
    assert_eq!(
        found.len(),
        1,
        "the double frequency does not show: {found:?}"
    );
    assert!((found[0] / single - 1.0).abs() < 1e-11);
    assert_eq!(spectrum.below(double * 0.999), 1);
    assert_eq!(spectrum.below(double * 1.001), 3, "the count finds both");
    let modes = modes(&building, 3).expect("the stacks stand");
    assert!(
        modes[1..]
            .iter()
            .all(|mode| (mode.circular_frequency / double - 1.0).abs() < 1e-14)
    );
}

/// Three lone masses: det(K − ω²M) = ∏(k − ω²m).
#[test]
fn its_logarithm_is_that_of_the_product() {
    let building = stacks(&[&[(1e4, 2e6)], &[(2e4, 6e6)], &[(5e3, 8e6)]]);
    let frequency = 15.0;
    let factors = [(1e4, 2e6), (2e4, 6e6), (5e3, 8e6)].map(|(m, k)| k - 225.0 * m);
    let determinant = log_determinant(&building, frequency).expect("the stacks stand");
    let product: f64 = factors.iter().product();
    assert_eq!(determinant.sign, product.signum());
    assert!((determinant.logarithm - product.abs().ln()).abs() < 1e-12);
    // Of a whole frame it is far outside of what a number can hold.
    let frames = stored_frames();
    let frame = stored_frame(&frames["D_3bay10"], 1.0);
    let determinant = log_determinant(&frame, frequency).expect("the frame stands");
    assert!(determinant.logarithm > f64::MAX.ln(), "{determinant:?}");
}
