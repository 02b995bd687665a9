//! Time of response spectra on one core.
//!
//! `cargo bench -p jostle-motion`

use divan::Bencher;
use divan::counter::ItemsCount;
use jostle_motion::Reading::{Between, Steps};
use jostle_motion::{Accelerogram, response_spectrum, spaced_periods};

fn main() {
    divan::main();
}

/// A wave as long as the longest of the usual records of El Centro: 5372 values at 0.01 s.
fn record() -> Accelerogram {
    let wave = |i: u32| {
        let t = 0.01 * f64::from(i);
        let beat = (17.3 * t).sin() + 0.7 * (5.1 * t + 1.0).sin() + 0.5 * (61.0 * t).cos();
        (-((t - 12.0) / 9.0).powi(2)).exp() * beat
    };
    Accelerogram::new(0.01, (0..5372).map(wave).collect()).expect("a motion")
}

const DAMPINGS: [f64; 5] = [0.0, 0.02, 0.05, 0.1, 0.2];

/// 200 periods from the given one to 10 s, and 5 damping ratios; items are oscillators.
#[divan::bench(args = [0.02, 0.1])]
fn peaks_at_steps(bencher: Bencher, shortest: f64) {
    let (motion, periods) = (record(), spaced_periods(shortest, 10.0, 200));
    let bencher = bencher.counter(ItemsCount::new(1000_usize));
    bencher.bench(|| response_spectrum(&motion, &periods, &DAMPINGS, Steps));
}

/// The same with the peaks between the ends of steps.
#[divan::bench(args = [0.02, 0.1])]
fn peaks_between(bencher: Bencher, shortest: f64) {
    let (motion, periods) = (record(), spaced_periods(shortest, 10.0, 200));
    let bencher = bencher.counter(ItemsCount::new(1000_usize));
    bencher.bench(|| response_spectrum(&motion, &periods, &DAMPINGS, Between));
}
