//! Discrete Fourier transforms whose bits depend on no processor.

use std::f64::consts::PI;

use num_complex::Complex64;

/// Replaces values by `Σ x_j e^{2πi s jk/n}`, k from 0; `s`: −1 forwards, 1 backwards, without a factor.
///
/// Lengths that are no powers of two are convolved with a chirp (L. I. Bluestein, 1970, IEEE Trans. Audio Electroacoust. 18, 451–455).
pub(crate) fn transform(values: &mut [Complex64], sign: f64) {
    let n = values.len();
    if n.is_power_of_two() {
        return powers_of_two(values, sign);
    }
    if n == 0 {
        return;
    }
    // j² modulo 2n keeps the angle exact.
    let square = |j: usize| ((j as u128 * j as u128) % (2 * n as u128)) as f64;
    let chirp: Vec<Complex64> = (0..n)
        .map(|j| root(sign * PI * square(j) / n as f64))
        .collect();
    let length = (2 * n - 1).next_power_of_two();
    let mut a = vec![Complex64::default(); length];
    let mut b = a.clone();
    for j in 0..n {
        a[j] = values[j] * chirp[j];
        b[j] = chirp[j].conj();
        b[(length - j) % length] = b[j];
    }
    powers_of_two(&mut a, -1.0);
    powers_of_two(&mut b, -1.0);
    a.iter_mut().zip(&b).for_each(|(a, b)| *a *= b);
    powers_of_two(&mut a, 1.0);
    for ((value, a), w) in values.iter_mut().zip(&a).zip(&chirp) {
        *value = a * w / length as f64;
    }
}

/// e^{iφ}.
fn root(angle: f64) -> Complex64 {
    let (sine, cosine) = libm::sincos(angle);
    Complex64::new(cosine, sine)
}

/// The same for a length that is a power of two (J. W. Cooley, J. W. Tukey, 1965, Math. Comput. 19, 297–301).
fn powers_of_two(values: &mut [Complex64], sign: f64) {
    let n = values.len();
    if n < 2 {
        return;
    }
    let bits = n.trailing_zeros();
    for i in 0..n {
        let j = i.reverse_bits() >> (usize::BITS - bits);
        if i < j {
            values.swap(i, j);
        }
    }
    let roots: Vec<Complex64> = (0..n / 2)
        .map(|k| root(sign * 2.0 * PI * k as f64 / n as f64))
        .collect();
    let mut half = 1;
    while half < n {
        let stride = n / (2 * half);
        for block in values.chunks_exact_mut(2 * half) {
            let (low, high) = block.split_at_mut(half);
            for ((a, b), w) in low.iter_mut().zip(high).zip(roots.iter().step_by(stride)) {
                let turned = *b * w;
                *b = *a - turned;
                *a += turned;
            }
        }
        half *= 2;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sums as they are defined, for lengths that are powers of two, primes and others.
    #[test]
    fn transforms_are_their_sums() {
        for n in [1, 2, 3, 8, 15, 17, 64, 101] {
            let value = |j: usize| Complex64::new((j * j % 7) as f64 - 2.5, (j * 3 % 5) as f64);
            for sign in [-1.0, 1.0] {
                let mut found: Vec<Complex64> = (0..n).map(value).collect();
                transform(&mut found, sign);
                for (k, found) in found.iter().enumerate() {
                    let angle = |j: usize| sign * 2.0 * PI * ((j * k) % n) as f64 / n as f64;
                    let sum: Complex64 = (0..n).map(|j| value(j) * root(angle(j))).sum();
                    assert!(
                        (found - sum).norm() < 1e-12 * n as f64,
                        "{n} {k}: {found} {sum}"
                    );
                }
            }
        }
    }
}
