//! What the functions of the system's mathematical library give: other ones, other bits everywhere.

use super::digest::Bits;

/// Digest of values of every function that models use.
pub(super) fn library() -> String {
    let mut bits = Bits::default();
    for step in 1..2000 {
        let x = f64::from(step) * 0.007_31;
        for value in [
            x.sin(),
            x.cos(),
            x.tan(),
            x.exp(),
            (-x).exp_m1(),
            x.ln(),
            x.powf(1.5),
            x.powf(0.4),
            x.atan2(2.0),
            x.tanh(),
            x.cbrt(),
            (x / 20.0).asin(),
        ] {
            bits.number(value);
        }
    }
    bits.short(12)
}
