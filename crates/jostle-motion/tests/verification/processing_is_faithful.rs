//! Filters, baselines and resampling against closed forms.

use std::f64::consts::{PI, TAU};

use jostle_motion::{Accelerogram, Butterworth, butterworth, displacement, velocity};

use crate::support::{assert_near, el_centro, rough};

fn sine(frequency: f64, step: f64, points: u32) -> Accelerogram {
    let value = |i| (TAU * frequency * step * f64::from(i)).sin();
    Accelerogram::new(step, (0..points).map(value).collect()).expect("a motion")
}

#[test]
fn the_gain_is_that_of_butterworth_and_the_phase_zero() {
    let (step, points) = (0.01, 20_000);
    for order in [2, 4, 8] {
        for frequency in [0.3, 0.5, 1.0, 10.0, 20.0, 30.0] {
            let filter = Butterworth {
                low: Some(0.5),
                high: Some(20.0),
                order,
            };
            let motion = sine(frequency, step, points);
            let filtered = butterworth(&motion, &filter).expect("filtered");
            let warped = |f: f64| (PI * f * step).tan();
            let n = 2 * order as i32;
            let gain = 1.0
                / (1.0 + (warped(0.5) / warped(frequency)).powi(n))
                / (1.0 + (warped(frequency) / warped(20.0)).powi(n));
            // In the middle, where the ends are forgotten: no other amplitude and no other phase.
            for i in 9_000..11_000 {
                let (a, b) = (motion.acceleration()[i], filtered.acceleration()[i]);
                assert!(
                    (b - gain * a).abs() < 2e-4,
                    "order {order}, {frequency} Hz: {b} for {}",
                    gain * a
                );
            }
        }
    }
}

#[test]
fn baselines_take_away_what_was_added() {
    let motion = el_centro();
    let clean = motion.without_polynomial(2).expect("fitted");
    let drift = |i: usize| {
        let x = i as f64 / 1559.0;
        0.02 - 0.05 * x + 0.04 * x * x
    };
    let values = clean
        .acceleration()
        .iter()
        .enumerate()
        .map(|(i, a)| a + drift(i))
        .collect();
    let drifting = Accelerogram::new(0.02, values).expect("a motion");
    let again = drifting.without_polynomial(2).expect("fitted");
    for (a, b) in clean.acceleration().iter().zip(again.acceleration()) {
        assert!((a - b).abs() < 1e-12, "{a} became {b}");
    }
    // A constant offset of the acceleration is a line of the velocity.
    let values = motion.acceleration().iter().map(|a| a + 0.03).collect();
    let shifted = Accelerogram::new(0.02, values).expect("a motion");
    let (a, b) = (
        motion.without_velocity_trend(1),
        shifted.without_velocity_trend(1),
    );
    for (a, b) in a
        .expect("fitted")
        .acceleration()
        .iter()
        .zip(b.expect("fitted").acceleration())
    {
        assert!((a - b).abs() < 1e-12, "{a} became {b}");
    }
}

#[test]
fn a_motion_can_be_brought_to_rest() {
    for motion in [el_centro(), rough(4000, 0.005)] {
        let rested = motion.ending_at_rest();
        let last = motion.points() - 1;
        assert!(velocity(&rested)[last].abs() < 1e-12 && displacement(&rested)[last].abs() < 1e-11);
    }
}

#[test]
fn a_whole_fraction_of_the_step_changes_nothing() {
    let motion = rough(500, 0.02);
    let fine = motion.resampled(0.005).expect("resampled");
    assert_eq!(fine.points(), 499 * 4 + 1);
    let back: Vec<f64> = fine.acceleration().iter().step_by(4).copied().collect();
    assert_eq!(back, motion.acceleration());
    assert_near(
        velocity(&fine)[1996],
        velocity(&motion)[499],
        1e-12,
        "velocity",
    );
}

#[test]
fn a_larger_step_keeps_slow_waves_and_drops_fast_ones() {
    let slow = sine(1.0, 0.005, 8001).resampled(0.02).expect("resampled");
    let fast = sine(60.0, 0.005, 8001).resampled(0.02).expect("resampled");
    assert_eq!(slow.points(), 2001);
    for i in 500..1500 {
        let exact = (TAU * 0.02 * i as f64).sin();
        assert!((slow.acceleration()[i] - exact).abs() < 1e-3, "slow");
        assert!(
            fast.acceleration()[i].abs() < 1e-3,
            "60 Hz cannot be shown at 0.02 s"
        );
    }
}

#[test]
fn cutting_and_padding_keep_the_rest() {
    let motion = rough(100, 0.01);
    let part = motion.cut(0.2, 0.5).expect("cut");
    assert_eq!(part.acceleration(), &motion.acceleration()[20..=50]);
    let padded = part.padded(0.1, 0.3).expect("padded");
    assert_eq!(padded.points(), 10 + 31 + 30);
    assert_eq!(&padded.acceleration()[10..41], part.acceleration());
    assert!(motion.cut(0.5, 0.2).is_err() && motion.padded(-1.0, 0.0).is_err());
    assert!(motion.padded(1e30, 0.0).is_err() && motion.resampled(1e-30).is_err());
    assert!(motion.resampled(f64::NAN).is_err() && motion.cut(f64::NAN, 1.0).is_err());
}
