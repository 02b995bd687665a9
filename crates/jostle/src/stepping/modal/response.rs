//! One mode over one step, exactly (theory, Eqs. Q1 and Q2).

use pulp::{Arch, NullaryFnOnce};

use super::kernels::LANES;
use super::series::{INTEGRALS, Impulse, SERIES, radians};

/// What a step begins with: q₀, q̇₀, p₀, p₁ and the bend b.
pub(super) const INPUTS: usize = 5;
/// Products of two of these.
pub(super) const PRODUCTS: usize = INPUTS * (INPUTS + 1) / 2;

/// What a mode makes of its state and of a load p₀ + (p₁ − p₀)τ + b(τ² − τ) over a step h, τ = t/h.
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
    /// The row of q̇₁ alone.
    fn velocity_over(damping: f64, stiffness: f64, step: f64) -> [f64; INPUTS] {
        if radians(damping, stiffness, step) >= SERIES {
            let [[_, _], [x21, x22]] = Self::free(damping, stiffness, step);
            return Self::closed_velocity(damping, stiffness, step, [x21, x22]);
        }
        let Impulse {
            slope: [slope],
            value: [value],
            integrals: [[first], [second]],
        } = Impulse::over(&[damping], &[stiffness], step);
        [
            -stiffness * value,
            slope / step,
            value - first,
            first,
            2.0 * second - first,
        ]
    }

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
    pub(super) fn over(damping: f64, stiffness: f64, step: f64) -> Self {
        if radians(damping, stiffness, step) < SERIES {
            let impulse = Impulse::over(&[damping], &[stiffness], step);
            Self::of_impulse(stiffness, step, &impulse, 0)
        } else {
            Self::closed(damping, stiffness, step)
        }
    }

    /// The same of up to [`LANES`] modes at once; what is beyond them means nothing.
    pub(super) fn of_several(
        arch: Arch,
        damping: &[f64],
        stiffness: &[f64],
        step: f64,
    ) -> [Self; LANES] {
        let filled = |list: &[f64]| std::array::from_fn(|i| list[i.min(list.len() - 1)]);
        let several = Several {
            damping: filled(damping),
            stiffness: filled(stiffness),
            step,
        };
        let mut modes = several.damping.iter().zip(&several.stiffness);
        if modes.all(|(d, k)| radians(*d, *k, step) < SERIES) {
            arch.dispatch(several)
        } else {
            std::array::from_fn(|i| Self::over(several.damping[i], several.stiffness[i], step))
        }
    }

    /// Free motion from (q, q̇) = (1, 0) and (0, 1).
    fn free(damping: f64, stiffness: f64, step: f64) -> [[f64; 2]; 2] {
        let half = 0.5 * damping;
        let inside = stiffness - half * half;
        // From here on oscillations and decays cannot be told apart.
        if inside.abs() <= 1e-12 * stiffness {
            let decay = (-half * step).exp();
            return [
                [decay * (1.0 + half * step), decay * step],
                [-decay * stiffness * step, decay * (1.0 - half * step)],
            ];
        }
        if inside > 0.0 {
            let own = inside.sqrt();
            let (sin, cos) = (own * step).sin_cos();
            let decay = (-half * step).exp();
            let s = sin / own;
            return [
                [decay * (cos + half * s), decay * s],
                [-decay * stiffness * s, decay * (cos - half * s)],
            ];
        }
        let fast = -half - (-inside).sqrt();
        let slow = stiffness / fast;
        let (fast_decay, slow_decay) = ((fast * step).exp(), (slow * step).exp());
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

    fn closed(damping: f64, stiffness: f64, step: f64) -> Self {
        let [[x11, x12], [x21, x22]] = Self::free(damping, stiffness, step);
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
        let velocity = Self::closed_velocity(damping, stiffness, step, [x21, x22]);
        // k ∫q = ∫p − Δq̇ − d Δq, and k ∫τq = ∫τp − (q̇₁ − Δq/h) − d(q₁ − ∫q/h): q₀, q̇₀, ∫p/h and ∫τp/h.
        let starts = [
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 0.5, 1.0 / 6.0],
            [0.0, 0.0, 0.5, 1.0 / 3.0],
            [0.0, 0.0, -1.0 / 6.0, -1.0 / 12.0],
        ];
        let (mut area, mut moment) = ([0.0; INPUTS], [0.0; INPUTS]);
        for (column, [q, v, load, leaning]) in starts.into_iter().enumerate() {
            let (end, rate) = (displacement[column], velocity[column]);
            area[column] = (load * step - (rate - v) - damping * (end - q)) * static_rise;
            moment[column] = (leaning * step
                - (rate - (end - q) / step)
                - damping * (end - area[column] / step))
                * static_rise;
        }
        Self {
            displacement,
            velocity,
            area,
            moment,
        }
    }

    /// All from the answer h to an impulse: a constant load makes ∫h of it, one that rises ∫∫h and its square twice
    /// ∫∫∫h, and a start at rest away from zero is a constant load −k.
    #[inline(always)]
    fn of_impulse<const N: usize>(
        stiffness: f64,
        step: f64,
        impulse: &Impulse<N, INTEGRALS>,
        mode: usize,
    ) -> Self {
        let (slope, value) = (impulse.slope[mode], impulse.value[mode]);
        let [first, second, third, fourth, fifth] =
            std::array::from_fn(|times| impulse.integrals[times][mode]);
        let square = step * step;
        Self {
            displacement: [
                1.0 - stiffness * step * first,
                value,
                step * (first - second),
                step * second,
                step * (2.0 * third - second),
            ],
            velocity: [
                -stiffness * value,
                slope / step,
                value - first,
                first,
                2.0 * second - first,
            ],
            area: [
                step * (1.0 - stiffness * step * second),
                step * first,
                square * (second - third),
                square * third,
                square * (2.0 * fourth - third),
            ],
            // ∫τq = ∫q − ∫∫q/h.
            moment: [
                step * (0.5 - stiffness * step * (second - third)),
                step * (first - second),
                square * (second - 2.0 * third + fourth),
                square * (third - fourth),
                square * (3.0 * fourth - third - 2.0 * fifth),
            ],
        }
    }
}

/// Modes that all turn little over a step.
struct Several {
    damping: [f64; LANES],
    stiffness: [f64; LANES],
    step: f64,
}

impl NullaryFnOnce for Several {
    type Output = [Response; LANES];

    #[inline(always)]
    fn call(self) -> [Response; LANES] {
        let impulse = Impulse::over(&self.damping, &self.stiffness, self.step);
        std::array::from_fn(|i| Response::of_impulse(self.stiffness[i], self.step, &impulse, i))
    }
}

/// What follows a load τ² − τ once free motion has died: factors of τ², τ and 1.
fn steady_bend(damping: f64, stiffness: f64, step: f64) -> [f64; 3] {
    let bent = 1.0 / stiffness;
    let slope = -(1.0 + 2.0 * damping * bent / step) * bent;
    let start = -(damping * slope + 2.0 * bent / step) / step * bent;
    [bent, slope, start]
}

/// Below so many radians over a step four points of Gauss' rule have all digits, and up to so many twelve.
const FEW_POINTS: f64 = 0.4;
const MANY_POINTS: f64 = 6.0;

/// Gauss' rules for the energy that damping takes.
pub(super) struct Rules {
    few: Vec<(f64, f64)>,
    many: Vec<(f64, f64)>,
}

impl Rules {
    pub(super) fn new() -> Self {
        Self {
            few: gauss(4),
            many: gauss(12),
        }
    }
}

/// d ∫ q̇² dt over a step as a quadratic form in (q₀, q̇₀, p₀, p₁, b): upper triangle row by row, what stands off the diagonal
/// twice. By quadrature, so that the energy balance is a check; where a mode turns or dies too quickly for that, as what
/// its load puts in and its energy does not keep.
pub(super) fn damped(
    damping: f64,
    stiffness: f64,
    step: f64,
    response: &Response,
    rules: &Rules,
) -> [f64; PRODUCTS] {
    let radians = radians(damping, stiffness, step);
    let mut form = [0.0; PRODUCTS];
    if damping == 0.0 {
        return form;
    }
    let mut add = |scale: f64, a: &[f64; INPUTS], b: &[f64; INPUTS]| {
        let mut entry = 0;
        for i in 0..INPUTS {
            for j in i..INPUTS {
                let twice = if i == j { 0.5 } else { 1.0 };
                form[entry] += scale * twice * (a[i] * b[j] + a[j] * b[i]);
                entry += 1;
            }
        }
    };
    if radians > MANY_POINTS {
        let unit = |at: usize| std::array::from_fn(|i| if i == at { 1.0 } else { 0.0 });
        let [q0, v0, p0, p1] = [0, 1, 2, 3].map(unit);
        // ∫p q̇ dt by parts, the slope of the load being that of the line and 2τ − 1 of the bend.
        let slope = [0.0, 0.0, -1.0, 1.0, -1.0].map(|share| share / step);
        let bend = [0.0, 0.0, 0.0, 0.0, 2.0 / step];
        add(1.0, &p1, &response.displacement);
        add(-1.0, &p0, &q0);
        add(-1.0, &slope, &response.area);
        add(-1.0, &bend, &response.moment);
        add(-0.5, &response.velocity, &response.velocity);
        add(0.5, &v0, &v0);
        add(
            -0.5 * stiffness,
            &response.displacement,
            &response.displacement,
        );
        add(0.5 * stiffness, &q0, &q0);
        return form;
    }
    let rule = if radians < FEW_POINTS {
        &rules.few
    } else {
        &rules.many
    };
    for (at, weight) in rule {
        let [q, v, first, second, bent] = Response::velocity_over(damping, stiffness, at * step);
        // The load until that instant: another line, with a lesser bend.
        let row = [
            q,
            v,
            first + second * (1.0 - at),
            second * at,
            second * (at * at - at) + bent * at * at,
        ];
        add(damping * weight * step, &row, &row);
    }
    form
}

/// Gauss' points and weights on 0…1.
fn gauss(points: usize) -> Vec<(f64, f64)> {
    let n = points as f64;
    let legendre = |x: f64| {
        let (mut before, mut now) = (1.0, x);
        for k in 2..=points {
            let k = k as f64;
            (before, now) = (now, ((2.0 * k - 1.0) * x * now - (k - 1.0) * before) / k);
        }
        (now, n * (x * now - before) / (x * x - 1.0))
    };
    (0..points)
        .map(|index| {
            let mut x = (std::f64::consts::PI * (index as f64 + 0.75) / (n + 0.5)).cos();
            for _ in 0..50 {
                let (value, slope) = legendre(x);
                let change = value / slope;
                x -= change;
                if change.abs() <= 1e-16 {
                    break;
                }
            }
            let slope = legendre(x).1;
            (0.5 * (1.0 - x), 1.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}

#[cfg(test)]
mod tests {
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
                let form = damped(d, k, h, &response, &Rules::new());
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

    /// Many modes at once, and one by one, to the last digits; also where some need the closed forms.
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
        for (slowest, modes) in [(2.0, 8), (2.0, 5), (300.0, 8)] {
            let omegas: Vec<f64> = (0..modes).map(|i| slowest * f64::from(1 + i)).collect();
            let damping: Vec<f64> = omegas.iter().map(|omega| 0.1 * omega).collect();
            let stiffness: Vec<f64> = omegas.iter().map(|omega| omega * omega).collect();
            let several = Response::of_several(Arch::new(), &damping, &stiffness, 7e-4);
            for (i, got) in several[..omegas.len()].iter().enumerate() {
                let one = Response::over(damping[i], stiffness[i], 7e-4);
                for (a, b) in bits(got).iter().zip(bits(&one)) {
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
        // For h → 0: q₁ = p₀ h²/3 + p₁ h²/6 − b h²/12, which the closed forms would lose.
        let response = Response::over(0.4, 16.0, 1e-7);
        assert!((response.displacement[2] / (1e-14 / 3.0) - 1.0).abs() < 1e-6);
        assert!((response.displacement[3] / (1e-14 / 6.0) - 1.0).abs() < 1e-6);
        assert!((response.displacement[4] / (-1e-14 / 12.0) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn gauss_is_exact_for_polynomials() {
        for points in [1, 3, 4, 12] {
            let rule = gauss(points);
            for power in 0..2 * points as i32 {
                let sum: f64 = rule.iter().map(|(x, w)| w * x.powi(power)).sum();
                assert!(
                    (sum - 1.0 / f64::from(power + 1)).abs() < 1e-14,
                    "{points}, {power}"
                );
            }
        }
    }
}
