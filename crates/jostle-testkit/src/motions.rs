//! Ground motions.

use jostle::GroundMotion;

/// Two waves that fade, without symmetry: scale · (slow · sin(rate · t) e^(−t/10) + 1.2 cos(3.1 rate · t) e^(−3t/10)) \[m/s²\],
/// with as many steps of 20 ms as said; `rate` is a circular frequency \[rad/s\].
#[must_use]
pub fn fading(name: &str, rate: f64, [scale, slow]: [f64; 2], steps: u32) -> GroundMotion {
    let at = |i: u32| {
        let t = 0.02 * f64::from(i);
        let slow = slow * libm::sin(rate * t) * libm::exp(-0.1 * t);
        scale * (slow + 1.2 * libm::cos(3.1 * rate * t) * libm::exp(-0.3 * t))
    };
    GroundMotion::sampled(name, 0.02, (0..=steps).map(at).collect())
}

/// Two waves that last, with as many steps of 10 ms as said; strong enough to make frames pound.
#[must_use]
pub fn two_waves(steps: u32) -> GroundMotion {
    let wave = (0..=steps).map(|i| {
        let t = 0.01 * f64::from(i);
        4.0 * libm::sin(7.0 * t) + 2.0 * libm::cos(23.0 * t)
    });
    GroundMotion::sampled("two waves", 0.01, wave.collect())
}
