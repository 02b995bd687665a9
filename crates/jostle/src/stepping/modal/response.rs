//! One mode over one step, exactly (theory, Eqs. Q1 and Q2).

use pulp::{Arch, NullaryFnOnce};

use super::mode_kernels::LANES;
use super::series::{INTEGRALS, Impulse, SERIES, radians};

/// Inputs of a step: q₀, q̇₀, p₀, p₁ and the curvature term b.
pub(super) const INPUTS: usize = 5;
/// Products of two of these.
pub(super) const PRODUCTS: usize = INPUTS * (INPUTS + 1) / 2;

/// Response of a mode to its state and a load p₀ + (p₁ − p₀)τ + b(τ² − τ) over a step h, τ = t/h.
///
/// q̈ + d q̇ + k q = p with d = 2ζω, k = ω² (N. C. Nigam and P. C. Jennings, 1969, Bull. Seism. Soc. Am. 59,
/// 909–922, for b = 0). All rows are factors of (q₀, q̇₀, p₀, p₁, b).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Response {
    /// q₁.
    pub(super) displacement: [f64; INPUTS],
    /// q̇₁.
    pub(super) velocity: [f64; INPUTS],
    /// ∫ q dt.
    pub(super) area: [f64; INPUTS],
    /// ∫ τ q dt.
    pub(super) moment: [f64; INPUTS],
}

impl Response {
    #[inline(always)]
    fn closed_velocity(
        damping: f64,
        stiffness: f64,
        step: f64,
        [x21, x22]: [f64; 2],
    ) -> [f64; INPUTS] {
        let rise = 1.0 / stiffness;
        let (e1, e2) = (rise / step, damping / (stiffness * stiffness * step));
        let [bent, slope, start] = steady_bend(damping, stiffness, step);
        [
            x21,
            x22,
            -x21 * (rise + e2) + x22 * e1 - e1,
            x21 * e2 - x22 * e1 + e1,
            (2.0 * bent + slope - slope * x22) / step - start * x21,
        ]
    }

    /// `damping` d ≥ 0 \[1/s\], `stiffness` k > 0 \[1/s²\], `step` h > 0 \[s\].
    #[cfg(test)]
    fn over(damping: f64, stiffness: f64, step: f64) -> Self {
        Responses::over(&[damping], &[stiffness], step).mode(0)
    }

    /// Free motion from (q, q̇) = (1, 0) and (0, 1).
    fn free(damping: f64, stiffness: f64, step: f64) -> [[f64; 2]; 2] {
        let half = 0.5 * damping;
        let inside = stiffness - half * half;
        // Near critical damping oscillation and decay cannot be distinguished.
        if inside.abs() <= 1e-12 * stiffness {
            let decay = libm::exp(-half * step);
            return [
                [decay * (1.0 + half * step), decay * step],
                [-decay * stiffness * step, decay * (1.0 - half * step)],
            ];
        }
        if inside > 0.0 {
            let inside = inside.sqrt();
            let (sin, cos) = libm::sincos(inside * step);
            let decay = libm::exp(-half * step);
            let s = sin / inside;
            return [
                [decay * (cos + half * s), decay * s],
                [-decay * stiffness * s, decay * (cos - half * s)],
            ];
        }
        let fast = -half - (-inside).sqrt();
        let slow = stiffness / fast;
        let (fast_decay, slow_decay) = (libm::exp(fast * step), libm::exp(slow * step));
        let apart = slow - fast;
        let s = (slow_decay - fast_decay) / apart;
        [
            [(slow * fast_decay - fast * slow_decay) / apart, s],
            [
                -stiffness * s,
                (slow * slow_decay - fast * fast_decay) / apart,
            ],
        ]
    }
}

/// The same of N modes: for every input a list of factors, mode by mode.
#[derive(Clone, Copy, Debug)]
pub(super) struct Responses<const N: usize> {
    pub(super) displacement: [[f64; N]; INPUTS],
    pub(super) velocity: [[f64; N]; INPUTS],
    pub(super) area: [[f64; N]; INPUTS],
    pub(super) moment: [[f64; N]; INPUTS],
}

impl Responses<LANES> {
    /// Of [`LANES`] modes, in the available registers.
    pub(super) fn of_several(
        arch: Arch,
        damping: [f64; LANES],
        stiffness: [f64; LANES],
        step: f64,
    ) -> Self {
        arch.dispatch(Several {
            damping,
            stiffness,
            step,
        })
    }
}

impl<const N: usize> Responses<N> {
    const NONE: Self = Self {
        displacement: [[0.0; N]; INPUTS],
        velocity: [[0.0; N]; INPUTS],
        area: [[0.0; N]; INPUTS],
        moment: [[0.0; N]; INPUTS],
    };

    /// Of one of the modes.
    pub(super) fn mode(&self, mode: usize) -> Response {
        let of = |rows: &[[f64; N]; INPUTS]| rows.each_ref().map(|row| row[mode]);
        Response {
            displacement: of(&self.displacement),
            velocity: of(&self.velocity),
            area: of(&self.area),
            moment: of(&self.moment),
        }
    }

    #[inline(always)]
    fn over(damping: &[f64; N], stiffness: &[f64; N], step: f64) -> Self {
        let (mut turning, mut still) = (0, 0);
        for i in 0..N {
            if radians(damping[i], stiffness[i], step) < SERIES {
                still += 1;
            } else {
                turning += 1;
            }
        }
        if turning == 0 {
            return Self::of_impulses(stiffness, step, &Impulse::over(damping, stiffness, step));
        }
        let closed = Self::closed(damping, stiffness, step);
        if still == 0 {
            return closed;
        }
        // Results of the series are not used where it does not converge.
        let series = Self::of_impulses(stiffness, step, &Impulse::over(damping, stiffness, step));
        let mut mixed = closed;
        for i in 0..N {
            if radians(damping[i], stiffness[i], step) < SERIES {
                for input in 0..INPUTS {
                    mixed.displacement[input][i] = series.displacement[input][i];
                    mixed.velocity[input][i] = series.velocity[input][i];
                    mixed.area[input][i] = series.area[input][i];
                    mixed.moment[input][i] = series.moment[input][i];
                }
            }
        }
        mixed
    }

    /// The rows of q̇₁ alone.
    #[inline(always)]
    pub(super) fn velocities_over(
        damping: &[f64; N],
        stiffness: &[f64; N],
        step: f64,
    ) -> [[f64; N]; INPUTS] {
        let mut rows = [[0.0; N]; INPUTS];
        if most_radians(damping, stiffness, step) >= SERIES {
            for i in 0..N {
                let (damping, stiffness) = (damping[i], stiffness[i]);
                let row = if radians(damping, stiffness, step) >= SERIES {
                    let [_, free] = Response::free(damping, stiffness, step);
                    Response::closed_velocity(damping, stiffness, step, free)
                } else {
                    Responses::velocities_over(&[damping], &[stiffness], step).map(|[value]| value)
                };
                for (rows, value) in rows.iter_mut().zip(row) {
                    rows[i] = value;
                }
            }
            return rows;
        }
        let Impulse {
            slope,
            value,
            integrals: [first, second],
        } = Impulse::over(damping, stiffness, step);
        for i in 0..N {
            rows[0][i] = -stiffness[i] * value[i];
            rows[1][i] = slope[i] / step;
            rows[2][i] = value[i] - first[i];
            rows[3][i] = first[i];
            rows[4][i] = 2.0 * second[i] - first[i];
        }
        rows
    }

    #[inline(always)]
    fn closed(damping: &[f64; N], stiffness: &[f64; N], step: f64) -> Self {
        let [mut x11, mut x12, mut x21, mut x22] = [[0.0; N]; 4];
        for i in 0..N {
            [[x11[i], x12[i]], [x21[i], x22[i]]] = Response::free(damping[i], stiffness[i], step);
        }
        let mut all = Self::NONE;
        for i in 0..N {
            let (damping, stiffness) = (damping[i], stiffness[i]);
            let (x11, x12) = (x11[i], x12[i]);
            let static_rise = 1.0 / stiffness;
            let (e1, e2) = (static_rise / step, damping / (stiffness * stiffness * step));
            let [bent, slope, start] = steady_bend(damping, stiffness, step);
            let displacement = [
                x11,
                x12,
                -x11 * (static_rise + e2) + x12 * e1 + e2,
                x11 * e2 - x12 * e1 + static_rise - e2,
                bent + slope + start - start * x11 - slope / step * x12,
            ];
            let velocity = Response::closed_velocity(damping, stiffness, step, [x21[i], x22[i]]);
            // k ∫q = ∫p − Δq̇ − d Δq, and k ∫τq = ∫τp − (q̇₁ − Δq/h) − d(q₁ − ∫q/h): q₀, q̇₀, ∫p/h and ∫τp/h.
            const STARTS: [[f64; 4]; INPUTS] = [
                [1.0, 0.0, 0.0, 0.0],
                [0.0, 1.0, 0.0, 0.0],
                [0.0, 0.0, 0.5, 1.0 / 6.0],
                [0.0, 0.0, 0.5, 1.0 / 3.0],
                [0.0, 0.0, -1.0 / 6.0, -1.0 / 12.0],
            ];
            for column in 0..INPUTS {
                let [q, v, load, leaning] = STARTS[column];
                let (end, rate) = (displacement[column], velocity[column]);
                let area = (load * step - (rate - v) - damping * (end - q)) * static_rise;
                all.displacement[column][i] = end;
                all.velocity[column][i] = rate;
                all.area[column][i] = area;
                all.moment[column][i] =
                    (leaning * step - (rate - (end - q) / step) - damping * (end - area / step))
                        * static_rise;
            }
        }
        all
    }

    /// All from the impulse response h: ∫h for a constant load, ∫∫h for a linear one, 2∫∫∫h for a quadratic one; an
    /// initial displacement acts as a constant load −k.
    #[inline(always)]
    fn of_impulses(stiffness: &[f64; N], step: f64, impulse: &Impulse<N, INTEGRALS>) -> Self {
        let mut all = Self::NONE;
        let square = step * step;
        let [firsts, seconds, thirds, fourths, fifths] = &impulse.integrals;
        for i in 0..N {
            let (stiffness, slope, value) = (stiffness[i], impulse.slope[i], impulse.value[i]);
            let (first, second, third) = (firsts[i], seconds[i], thirds[i]);
            let (fourth, fifth) = (fourths[i], fifths[i]);
            all.displacement[0][i] = 1.0 - stiffness * step * first;
            all.displacement[1][i] = value;
            all.displacement[2][i] = step * (first - second);
            all.displacement[3][i] = step * second;
            all.displacement[4][i] = step * (2.0 * third - second);
            all.velocity[0][i] = -stiffness * value;
            all.velocity[1][i] = slope / step;
            all.velocity[2][i] = value - first;
            all.velocity[3][i] = first;
            all.velocity[4][i] = 2.0 * second - first;
            all.area[0][i] = step * (1.0 - stiffness * step * second);
            all.area[1][i] = step * first;
            all.area[2][i] = square * (second - third);
            all.area[3][i] = square * third;
            all.area[4][i] = square * (2.0 * fourth - third);
            // ∫τq = ∫q − ∫∫q/h.
            all.moment[0][i] = step * (0.5 - stiffness * step * (second - third));
            all.moment[1][i] = step * (first - second);
            all.moment[2][i] = square * (second - 2.0 * third + fourth);
            all.moment[3][i] = square * (third - fourth);
            all.moment[4][i] = square * (3.0 * fourth - third - 2.0 * fifth);
        }
        all
    }
}

/// [`LANES`] modes, compiled for the available registers.
struct Several {
    damping: [f64; LANES],
    stiffness: [f64; LANES],
    step: f64,
}

impl NullaryFnOnce for Several {
    type Output = Responses<LANES>;

    #[inline(always)]
    fn call(self) -> Responses<LANES> {
        Responses::over(&self.damping, &self.stiffness, self.step)
    }
}

/// Particular solution for a load τ² − τ: factors of τ², τ and 1.
#[inline(always)]
fn steady_bend(damping: f64, stiffness: f64, step: f64) -> [f64; 3] {
    let bent = 1.0 / stiffness;
    let slope = -(1.0 + 2.0 * damping * bent / step) * bent;
    let start = -(damping * slope + 2.0 * bent / step) / step * bent;
    [bent, slope, start]
}

/// Greatest of [`radians`].
#[inline(always)]
pub(super) fn most_radians<const N: usize>(
    damping: &[f64; N],
    stiffness: &[f64; N],
    step: f64,
) -> f64 {
    let mut most: f64 = 0.0;
    for i in 0..N {
        most = most.max(radians(damping[i], stiffness[i], step));
    }
    most
}

#[cfg(test)]
mod tests {
    use super::super::damped::{Damped, Rules};
    use super::*;

    /// The same by many steps of a Runge–Kutta method of fourth order.
    fn integrated(d: f64, k: f64, h: f64, start: [f64; 2], load: [f64; 3]) -> ([f64; 4], f64) {
        let steps = 20_000;
        let dt = h / f64::from(steps);
        let rate = |t: f64, [q, v, _, _, _]: [f64; 5]| {
            let at = t / h;
            let p = load[0] + (load[1] - load[0]) * at + load[2] * (at * at - at);
            [v, p - d * v - k * q, q, at * q, d * v * v]
        };
        let mut state = [start[0], start[1], 0.0, 0.0, 0.0];
        for step in 0..steps {
            let t = f64::from(step) * dt;
            let moved = |by: f64, r: [f64; 5]| std::array::from_fn(|i| state[i] + by * r[i]);
            let a = rate(t, state);
            let b = rate(t + 0.5 * dt, moved(0.5 * dt, a));
            let c = rate(t + 0.5 * dt, moved(0.5 * dt, b));
            let e = rate(t + dt, moved(dt, c));
            state = std::array::from_fn(|i| {
                state[i] + dt / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + e[i])
            });
        }
        let [q, v, area, moment, lost] = state;
        ([q, v, area, moment], lost)
    }

    #[test]
    fn every_kind_of_mode_is_exact() {
        // ω, ζ: slow, fast, undamped, critical, overdamped; steps on both sides of the series.
        for (omega, zeta) in [
            (3.0, 0.05),
            (60.0, 0.3),
            (20.0, 0.0),
            (25.0, 1.0),
            (40.0, 3.0),
        ] {
            for h in [1e-3, 0.02, 0.07] {
                let (d, k) = (2.0 * zeta * omega, omega * omega);
                let response = Response::over(d, k, h);
                let (start, load) = ([0.3, -1.7], [5.0, -40.0, 30.0]);
                let input = [start[0], start[1], load[0], load[1], load[2]];
                let of =
                    |row: [f64; INPUTS]| row.iter().zip(input).map(|(a, b)| a * b).sum::<f64>();
                let got = [
                    of(response.displacement),
                    of(response.velocity),
                    of(response.area),
                    of(response.moment),
                ];
                let (expected, lost) = integrated(d, k, h, start, load);
                for (got, expected) in got.iter().zip(expected) {
                    assert!(
                        (got - expected).abs() <= 1e-11 * (1.0 + expected.abs()),
                        "ω = {omega}, ζ = {zeta}, h = {h}: {got} against {expected}"
                    );
                }
                let damped = Damped {
                    damping: [d],
                    stiffness: [k],
                    step: h,
                    responses: &Responses::over(&[d], &[k], h),
                    rules: &Rules::new(),
                };
                let form = damped.call().map(|[value]| value);
                let mut sum = 0.0;
                let mut entry = 0;
                for i in 0..INPUTS {
                    for j in i..INPUTS {
                        sum += form[entry] * input[i] * input[j];
                        entry += 1;
                    }
                }
                assert!(
                    (sum - lost).abs() <= 1e-9 * (1.0 + lost),
                    "ω = {omega}, ζ = {zeta}, h = {h}: {sum} against {lost} J"
                );
            }
        }
    }

    /// Many modes at once and one by one agree to the last digits, also if some need the closed forms.
    #[test]
    fn several_modes_are_as_good_as_one() {
        let bits = |response: &Response| {
            let Response {
                displacement,
                velocity,
                area,
                moment,
            } = *response;
            [displacement, velocity, area, moment].concat()
        };
        for slowest in [2.0, 300.0] {
            let omegas: [f64; LANES] = std::array::from_fn(|i| slowest * (1 + i) as f64);
            let damping = omegas.map(|omega| 0.1 * omega);
            let stiffness = omegas.map(|omega| omega * omega);
            let several = Responses::of_several(Arch::new(), damping, stiffness, 7e-4);
            for i in 0..LANES {
                let one = Response::over(damping[i], stiffness[i], 7e-4);
                for (a, b) in bits(&several.mode(i)).iter().zip(bits(&one)) {
                    assert!(
                        (a - b).abs() <= 4e-16 * b.abs(),
                        "ω = {}: {a}, {b}",
                        omegas[i]
                    );
                }
            }
        }
    }

    #[test]
    fn tiny_steps_keep_their_digits() {
        // For h → 0: q₁ = p₀ h²/3 + p₁ h²/6 − b h²/12, where the closed forms lose all digits.
        let response = Response::over(0.4, 16.0, 1e-7);
        assert!((response.displacement[2] / (1e-14 / 3.0) - 1.0).abs() < 1e-6);
        assert!((response.displacement[3] / (1e-14 / 6.0) - 1.0).abs() < 1e-6);
        assert!((response.displacement[4] / (-1e-14 / 12.0) - 1.0).abs() < 1e-6);
    }
}
