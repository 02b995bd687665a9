//! Comparisons of numbers.

/// Asserts that two numbers differ by no more than a part of a scale.
#[track_caller]
pub fn close(got: f64, expected: f64, scale: f64, tolerance: f64, what: &str) {
    let error = (got - expected).abs();
    assert!(
        error <= tolerance * scale,
        "{what}: {got:e} instead of {expected:e}, {:.1e} off instead of at most {tolerance:.0e}",
        error / scale
    );
}

/// Asserts that a number differs from the expected one by no more than a part of it.
#[track_caller]
pub fn near(got: f64, expected: f64, tolerance: f64, what: &str) {
    close(got, expected, expected.abs(), tolerance, what);
}

/// Greatest magnitude.
#[must_use]
pub fn largest(values: &[f64]) -> f64 {
    values
        .iter()
        .fold(0.0, |largest, value| largest.max(value.abs()))
}

/// Greatest difference, relative to the greatest expected magnitude.
#[must_use]
#[track_caller]
pub fn difference(got: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(got.len(), expected.len(), "as many values as expected");
    let apart: Vec<f64> = got.iter().zip(expected).map(|(g, e)| g - e).collect();
    largest(&apart) / largest(expected)
}
