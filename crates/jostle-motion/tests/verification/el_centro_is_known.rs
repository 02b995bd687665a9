//! Figures of the digitisation as others print them, to the digits they print.

use jostle_motion::Reading::{Between, Steps};
use jostle_motion::{Accelerogram, STANDARD_GRAVITY, measures, response_spectrum};

use crate::support::{assert_near, el_centro};

/// The printed figures take g = 9.80665 m/s².
#[test]
fn measures_agree_with_the_printed_ones() {
    let factor = STANDARD_GRAVITY / 9.81;
    let values = el_centro()
        .acceleration()
        .iter()
        .map(|a| factor * a)
        .collect();
    let motion = Accelerogram::new(0.02, values).expect("a motion");
    let m = measures(&motion).expect("measures");
    assert_eq!(m.points, 1560);
    let significant = m.d5_95[1] - m.d5_95[0];
    for (value, printed, last_digit, what) in [
        (m.pga.value / STANDARD_GRAVITY, 0.31882, 1e-5, "PGA in g"),
        (m.pga.at, 2.04, 1e-2, "its time"),
        (m.pgv.value, 0.3608, 1e-4, "PGV"),
        (m.pgd.value, 0.212, 1e-3, "PGD"),
        (m.arias, 1.8010, 1e-4, "Arias intensity"),
        (m.cav, 12.61, 1e-2, "CAV"),
        (significant, 23.84, 1e-2, "D5-95"),
    ] {
        assert!(
            (value - printed).abs() <= 0.5 * last_digit,
            "{what}: {value} for {printed}"
        );
    }
}

/// A. K. Chopra, Dynamics of Structures, section 6.4: peak deformations of 2.67, 5.97 and 7.47 in with 2 % damping.
/// They are read at steps of 0.02 s: the true peak at T = 0.5 s is 2.688 in, which the next test confirms.
#[test]
fn deformations_agree_with_chopra() {
    let periods = [0.5, 1.0, 2.0];
    let spectrum = response_spectrum(&el_centro(), &periods, &[0.02], Steps).expect("a spectrum");
    for (value, inches) in spectrum.curves[0]
        .displacement
        .iter()
        .zip([2.67, 5.97, 7.47])
    {
        assert_near(*value, inches * 0.0254, 5e-3, "deformation");
    }
}

/// The constant-average-acceleration method with steps of 0.02/512 s knows nothing of the exact recursion.
#[test]
fn newmarks_method_confirms_the_peaks_between_samples() {
    for period in [0.5, 1.0, 2.0] {
        let (w, z, parts) = (std::f64::consts::TAU / period, 0.02, 512_u32);
        let h = 0.02 / f64::from(parts);
        let (mut u, mut v, mut a, mut peak) = (0.0_f64, 0.0, 0.0, 0.0_f64);
        for pair in el_centro().acceleration().windows(2) {
            for part in 1..=parts {
                let ground = pair[0] + (pair[1] - pair[0]) * f64::from(part) / f64::from(parts);
                let (u_known, v_known) = (u + h * v + h * h / 4.0 * a, v + h / 2.0 * a);
                a = (-ground - 2.0 * z * w * v_known - w * w * u_known)
                    / (1.0 + h * z * w + h * h * w * w / 4.0);
                (u, v) = (u_known + h * h / 4.0 * a, v_known + h / 2.0 * a);
                peak = peak.max(u.abs());
            }
        }
        let spectrum = response_spectrum(&el_centro(), &[period], &[z], Between).expect("spectrum");
        assert_near(spectrum.curves[0].displacement[0], peak, 1e-6, "Newmark");
    }
}
