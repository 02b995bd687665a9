//! Modes with small ωh, several at once: power series of their impulse responses (theory, section 14).

/// Radians over a step below which the power series is exact to rounding; the closed forms lose digits as (ωh)⁻³.
pub(super) const SERIES: f64 = 1.0;
/// Largest number of terms; the last one is below 10⁻¹⁸.
const TERMS: usize = 20;
/// Largest number of integrals of a response.
pub(super) const INTEGRALS: usize = 5;

/// 1/((n + 1)(n + 2)) for every term, and 1/(n + 1).
const SECOND: [f64; TERMS] = reciprocals(2);
const FIRST: [f64; TERMS + INTEGRALS] = reciprocals(1);

const fn reciprocals<const N: usize>(factors: usize) -> [f64; N] {
    let mut list = [0.0; N];
    let mut n = 0;
    while n < N {
        let next = (n + 1) as f64;
        list[n] = 1.0
            / (if factors == 1 {
                next
            } else {
                next * (next + 1.0)
            });
        n += 1;
    }
    list
}

/// Larger of ωh and dh of a mode \[rad\].
#[inline(always)]
pub(super) fn radians(damping: f64, stiffness: f64, step: f64) -> f64 {
    stiffness.sqrt().max(damping) * step
}

/// Number of terms needed for a number of radians.
#[inline(always)]
fn terms(radians: f64) -> usize {
    match radians {
        r if r < 0.02 => 9,
        r if r < 0.1 => 12,
        r if r < 0.4 => 16,
        _ => TERMS,
    }
}

/// Responses of N modes to a unit impulse, h(0) = 0 and ḣ(0) = 1 without load, at the end of a step.
pub(super) struct Impulse<const N: usize, const I: usize> {
    /// ḣ times the step \[s\].
    pub(super) slope: [f64; N],
    /// h \[s\].
    pub(super) value: [f64; N],
    /// ∫h, ∫∫h and so on over powers of the step \[s\].
    pub(super) integrals: [[f64; N]; I],
}

impl<const N: usize, const I: usize> Impulse<N, I> {
    /// For less than [`SERIES`] radians.
    #[inline(always)]
    pub(super) fn over(damping: &[f64; N], stiffness: &[f64; N], step: f64) -> Self {
        let mut count = 0;
        for i in 0..N {
            count = count.max(terms(radians(damping[i], stiffness[i], step)));
        }
        // In powers of t/h.
        let mut terms = [[0.0; N]; TERMS];
        terms[1] = [step; N];
        for n in 0..count - 2 {
            let (here, next) = (terms[n], terms[n + 1]);
            for i in 0..N {
                let (d, k) = (damping[i] * step, stiffness[i] * step * step);
                terms[n + 2][i] = -(d * (n + 1) as f64 * next[i] + k * here[i]) * SECOND[n];
            }
        }
        let mut answer = Self {
            slope: [0.0; N],
            value: [0.0; N],
            integrals: [[0.0; N]; I],
        };
        // From the smallest term up.
        for n in (1..count).rev() {
            let mut term = terms[n];
            for i in 0..N {
                answer.slope[i] += n as f64 * term[i];
                answer.value[i] += term[i];
            }
            for (times, integral) in answer.integrals.iter_mut().enumerate() {
                for i in 0..N {
                    term[i] *= FIRST[n + times];
                    integral[i] += term[i];
                }
            }
        }
        answer
    }
}
