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
    /// Of [`LANES`] modes, in the registers at hand.
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
        // Where the series would not converge its numbers are not used.
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
    fn velocities_over(damping: &[f64; N], stiffness: &[f64; N], step: f64) -> [[f64; N]; INPUTS] {
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

    /// All from the answer h to an impulse: a constant load makes ∫h of it, one that rises ∫∫h and its square twice
    /// ∫∫∫h, and a start at rest away from zero is a constant load −k.
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

/// [`LANES`] modes, compiled for the registers at hand.
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

/// What follows a load τ² − τ once free motion has died: factors of τ², τ and 1.
#[inline(always)]
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

/// Greatest of [`radians`].
#[inline(always)]
fn most_radians<const N: usize>(damping: &[f64; N], stiffness: &[f64; N], step: f64) -> f64 {
    let mut most: f64 = 0.0;
    for i in 0..N {
        most = most.max(radians(damping[i], stiffness[i], step));
    }
    most
}

/// d ∫ q̇² dt over a step as a quadratic form in (q₀, q̇₀, p₀, p₁, b), mode by mode: upper triangle row by row, what stands
/// off the diagonal twice. By quadrature, so that the energy balance is a check; where a mode turns or dies too quickly for
/// that, as what its load puts in and its energy does not keep.
pub(super) struct Damped<'a, const N: usize> {
    pub(super) damping: [f64; N],
    pub(super) stiffness: [f64; N],
    pub(super) step: f64,
    pub(super) responses: &'a Responses<N>,
    pub(super) rules: &'a Rules,
}

impl<const N: usize> NullaryFnOnce for Damped<'_, N> {
    type Output = [[f64; N]; PRODUCTS];

    #[inline(always)]
    fn call(self) -> [[f64; N]; PRODUCTS] {
        let Self {
            damping,
            stiffness,
            step,
            responses,
            rules,
        } = self;
        let mut form = [[0.0; N]; PRODUCTS];
        let most = most_radians(&damping, &stiffness, step);
        if most > MANY_POINTS {
            for i in 0..N {
                let (damping, stiffness) = (damping[i], stiffness[i]);
                let alone = if radians(damping, stiffness, step) > MANY_POINTS {
                    damped_by_balance(damping, stiffness, step, &responses.mode(i))
                } else {
                    by_quadrature(&[damping], &[stiffness], step, &rules.many).map(|[value]| value)
                };
                for (form, value) in form.iter_mut().zip(alone) {
                    form[i] = value;
                }
            }
            return form;
        }
        let rule = if most < FEW_POINTS {
            &rules.few
        } else {
            &rules.many
        };
        by_quadrature(&damping, &stiffness, step, rule)
    }
}

#[inline(always)]
fn by_quadrature<const N: usize>(
    damping: &[f64; N],
    stiffness: &[f64; N],
    step: f64,
    rule: &[(f64, f64)],
) -> [[f64; N]; PRODUCTS] {
    let mut form = [[0.0; N]; PRODUCTS];
    for &(at, weight) in rule {
        let mut row = Responses::velocities_over(damping, stiffness, at * step);
        // The load until that instant: another line, with a lesser bend.
        for i in 0..N {
            let (first, second, bent) = (row[2][i], row[3][i], row[4][i]);
            row[2][i] = first + second * (1.0 - at);
            row[3][i] = second * at;
            row[4][i] = second * (at * at - at) + bent * at * at;
        }
        let mut entry = 0;
        for a in 0..INPUTS {
            for b in a..INPUTS {
                let scale = if a == b { weight } else { 2.0 * weight } * step;
                for i in 0..N {
                    form[entry][i] += damping[i] * scale * (row[a][i] * row[b][i]);
                }
                entry += 1;
            }
        }
    }
    form
}

/// What the load of a mode puts in and its energy does not keep.
fn damped_by_balance(
    damping: f64,
    stiffness: f64,
    step: f64,
    response: &Response,
) -> [f64; PRODUCTS] {
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
