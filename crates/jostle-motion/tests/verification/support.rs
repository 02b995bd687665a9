//! Motions to compute with.

use jostle_motion::Accelerogram;

/// El Centro 1940 NS in the digitisation of Peknold, 1560 values at 0.02 s, with g = 9.81 m/s².
pub(crate) fn el_centro() -> Accelerogram {
    let text = include_str!("../../../jostle-io/data/el-centro-1940-ns.csv");
    let values = text
        .lines()
        .filter_map(|line| line.split_once(','))
        .filter_map(|(_, a)| a.parse::<f64>().ok())
        .map(|a| 9.81 * a)
        .collect();
    Accelerogram::new(0.02, values).expect("a motion")
}

/// Uneven values without a pattern.
pub(crate) fn rough(points: usize, step: f64) -> Accelerogram {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let values = (0..points).map(|_| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    });
    Accelerogram::new(step, values.collect()).expect("a motion")
}

pub(crate) fn assert_near(value: f64, wanted: f64, relative: f64, what: &str) {
    let error = (value / wanted - 1.0).abs();
    assert!(
        error <= relative,
        "{what}: {value} instead of {wanted}, off by {error:.1e} instead of at most {relative:.0e}"
    );
}
