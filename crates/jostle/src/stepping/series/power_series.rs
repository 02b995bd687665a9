//! Displacements of one building as a power series in time (theory, Eqs. PS1 to PS3).

use pulp::NullaryFnOnce;

use crate::linear::Row;

/// Highest power of time.
const HIGHEST: usize = 30;
/// Share of the acceleration that may be left out with the powers beyond the last.
const LEFT_OUT: f64 = 1e-14;
/// Displacements processed at once; lists of displacements are filled up with zeros to a multiple of this.
pub(super) const LANES: usize = 8;

/// Length of a list for a building of this size.
pub(super) fn padded(size: usize) -> usize {
    size.next_multiple_of(LANES)
}

/// u(t + s·h) = Σ w_k s^k for 0 ≤ s ≤ 1.
#[derive(Clone, Debug, Default)]
pub(super) struct PowerSeries {
    /// h \[s\].
    pub(super) step: f64,
    /// Highest power.
    pub(super) order: usize,
    /// Length of a row with its zeros on either side.
    stride: usize,
    length: usize,
    /// Rows w₀, w₁, …; there are [`LANES`] zeros before and after each.
    rows: Vec<f64>,
    /// Σ |w_k| and Σ k |w_k| of the powers from [`FIRST_OF_TAIL`] on.
    pub(super) tail: [Vec<f64>; 2],
}

/// First power that the tail sums up.
pub(super) const FIRST_OF_TAIL: usize = 4;

impl PowerSeries {
    /// Rows for a building of this size; all zero.
    pub(super) fn blank(size: usize) -> Self {
        let length = padded(size);
        let stride = length + 2 * LANES;
        Self {
            step: 0.0,
            order: 0,
            stride,
            length,
            rows: vec![0.0; (HIGHEST + 1) * stride],
            tail: [vec![0.0; length], vec![0.0; length]],
        }
    }

    /// The number of powers that motion of a rate \[1/s\] needs over a step \[s\].
    pub(super) fn order_for(rate: f64, step: f64) -> usize {
        let x = rate * step;
        let mut left = x;
        for power in 2..HIGHEST {
            // Beyond the power p = power + 1 the acceleration misses x^(p − 1)/(p − 1)!.
            left *= x / power as f64;
            if power >= FIRST_OF_TAIL && left <= LEFT_OUT {
                return power + 1;
            }
        }
        HIGHEST
    }

    /// w_k.
    #[inline(always)]
    pub(super) fn row(&self, power: usize) -> &[f64] {
        let start = power * self.stride + LANES;
        &self.rows[start..start + self.length]
    }

    #[inline(always)]
    fn row_mut(&mut self, power: usize) -> &mut [f64] {
        let start = power * self.stride + LANES;
        &mut self.rows[start..start + self.length]
    }

    /// Keeps a share s of the step only.
    pub(super) fn cut(&mut self, s: f64) {
        let mut factor = 1.0;
        for power in 1..=self.order {
            factor *= s;
            self.row_mut(power).iter_mut().for_each(|w| *w *= factor);
        }
        self.step *= s;
    }

    /// Powers of a displacement or a deformation.
    pub(super) fn of(&self, moved: &Row) -> Powers {
        self.form(|displacement| moved.value(displacement))
    }

    /// Powers of a linear form of the displacements.
    pub(super) fn form(&self, form: impl Fn(&[f64]) -> f64) -> Powers {
        let mut powers = Powers {
            values: [0.0; HIGHEST + 1],
            order: self.order,
        };
        for (power, value) in powers.values[..=self.order].iter_mut().enumerate() {
            *value = form(self.row(power));
        }
        powers
    }
}

/// One quantity as a polynomial of the share of the step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Powers {
    values: [f64; HIGHEST + 1],
    order: usize,
}

impl Powers {
    /// A polynomial of given coefficients, from the constant on.
    #[cfg(test)]
    pub(super) fn of(coefficients: &[f64]) -> Self {
        let mut values = [0.0; HIGHEST + 1];
        values[..coefficients.len()].copy_from_slice(coefficients);
        Self {
            values,
            order: coefficients.len() - 1,
        }
    }

    /// Its second derivative with respect to the time, for a step \[s\], and a straight line added to it.
    pub(super) fn second_derivative(&self, step: f64, line: [f64; 2]) -> Self {
        let mut values = [0.0; HIGHEST + 1];
        for power in 2..=self.order {
            let factor = (power * (power - 1)) as f64;
            values[power - 2] = factor * self.values[power] / (step * step);
        }
        values[0] += line[0];
        values[1] += line[1] * step;
        Self {
            values,
            order: self.order - 2,
        }
    }

    /// Its derivative with respect to the time, for a step \[s\].
    pub(super) fn derivative(&self, step: f64) -> Self {
        let mut values = [0.0; HIGHEST + 1];
        for power in 1..=self.order {
            values[power - 1] = power as f64 * self.values[power] / step;
        }
        Self {
            values,
            order: self.order - 1,
        }
    }

    /// The same times a factor.
    pub(super) fn scaled(mut self, factor: f64) -> Self {
        self.values.iter_mut().for_each(|value| *value *= factor);
        self
    }

    /// The sum of two polynomials, the other of lower order.
    pub(super) fn plus(mut self, other: &Self) -> Self {
        for (value, other) in self.values.iter_mut().zip(&other.values) {
            *value += other;
        }
        self
    }

    /// The same from another value at the start.
    pub(super) fn starting_at(mut self, value: f64) -> Self {
        self.values[0] = value;
        self
    }

    pub(super) fn value(&self, s: f64) -> f64 {
        let powers = self.values[..=self.order].iter().rev();
        powers.fold(0.0, |sum, power| sum * s + power)
    }

    /// Rate times the step.
    pub(super) fn rate(&self, s: f64) -> f64 {
        let mut sum = 0.0;
        for power in (1..=self.order).rev() {
            sum = sum * s + power as f64 * self.values[power];
        }
        sum
    }

    /// Value, and rate times the step.
    #[inline]
    pub(super) fn value_and_rate(&self, s: f64) -> [f64; 2] {
        let [mut value, mut rate] = [0.0; 2];
        for power in self.values[..=self.order].iter().rev() {
            rate = rate * s + value;
            value = value * s + power;
        }
        [value, rate]
    }

    /// Rate times the step, and second derivative times its square.
    #[inline]
    pub(super) fn rate_and_curvature(&self, s: f64) -> [f64; 2] {
        let [mut rate, mut curvature] = [0.0; 2];
        for power in (1..=self.order).rev() {
            curvature = curvature * s + rate;
            rate = rate * s + power as f64 * self.values[power];
        }
        [rate, curvature]
    }

    /// Where a function that changes sign between two shares vanishes, by Newton's method within the bracket. `ends`: the
    /// shares and the values there; `function` gives value and slope.
    pub(super) fn root(ends: [(f64, f64); 2], function: impl Fn(f64) -> [f64; 2]) -> f64 {
        let [(mut low, below), (mut high, above)] = ends;
        let rises = above > below;
        let mut at = low + (high - low) * (below / (below - above)).clamp(0.0, 1.0);
        for _ in 0..MOST_ROUNDS {
            let [value, slope] = function(at);
            if (value >= 0.0) == rises {
                high = at;
            } else {
                low = at;
            }
            let newton = at - value / slope;
            let inside = newton >= low && newton <= high;
            let next = if inside { newton } else { 0.5 * (low + high) };
            let moved = (next - at).abs();
            // Newton's method squares this in its next round.
            if inside && moved <= SETTLED || moved <= f64::EPSILON {
                return next;
            }
            at = next;
        }
        at
    }

    /// Shares of the step, in order, at which the rate changes its sign, at most one in each of the parts of the step.
    pub(super) fn turns(&self) -> impl Iterator<Item = f64> + '_ {
        let mut before = self.rate(0.0);
        (1..=PARTS).filter_map(move |part| {
            let [start, end] = [part - 1, part].map(|part| f64::from(part) / f64::from(PARTS));
            let rate = self.rate(end);
            let turned = before != 0.0 && rate != 0.0 && (before > 0.0) != (rate > 0.0);
            let ends = [(start, before), (end, rate)];
            before = if rate == 0.0 { before } else { rate };
            turned.then(|| Self::root(ends, |s| self.rate_and_curvature(s)))
        })
    }

    /// Greatest magnitude at a turn within the step; zero where there is none.
    pub(super) fn greatest_turn(&self) -> f64 {
        let values = self.turns().map(|at| self.value(at).abs());
        values.fold(0.0, f64::max)
    }
}

/// Change of a root at which the next round is exact to rounding.
const SETTLED: f64 = 1e-8;
/// Iterations for a root.
const MOST_ROUNDS: usize = 60;
/// Parts of a step in each of which a motion turns at most once: its rate times the step is at most two.
pub(super) const PARTS: u32 = 4;

/// Σ over lanes.
macro_rules! lanes {
    ($lane:ident, $body:block) => {
        for $lane in 0..LANES $body
    };
}

/// The recursion from power to power, from displacements, velocities and accelerations:
/// (k + 2)(k + 1) u_{k+2} = −M⁻¹K u_k − (k + 1) M⁻¹C u_{k+1} + load_k.
pub(super) struct Expansion<'a> {
    pub(super) step: f64,
    pub(super) order: usize,
    /// Displacements, velocities and accelerations at the start.
    pub(super) start: [&'a [f64]; 3],
    /// Diagonals on either side of the main one.
    pub(super) reach: usize,
    /// By diagonals.
    pub(super) stiffness: &'a [f64],
    pub(super) damping: &'a [f64],
    pub(super) uniform_damping: Option<f64>,
    /// Load per mass that grows with time \[m/s³\] and with its square \[m/s⁴\].
    pub(super) loads: [&'a [f64]; 2],
    pub(super) series: &'a mut PowerSeries,
}

impl NullaryFnOnce for Expansion<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self {
            step,
            order,
            start: [u, v, a],
            reach,
            stiffness,
            damping,
            uniform_damping,
            loads,
            series,
        } = self;
        (series.step, series.order) = (step, order);
        let length = series.length;
        for (power, (from, factor)) in [(u, 1.0), (v, step), (a, 0.5 * step * step)]
            .into_iter()
            .enumerate()
        {
            for (to, from) in series.row_mut(power).iter_mut().zip(from) {
                *to = factor * from;
            }
        }
        let stride = series.stride;
        let [tail, quick_tail] = &mut series.tail;
        let (tail, _) = tail.as_chunks_mut::<LANES>();
        let (quick_tail, _) = quick_tail.as_chunks_mut::<LANES>();
        for (tail, quick) in tail.iter_mut().zip(quick_tail.iter_mut()) {
            (*tail, *quick) = ([0.0; LANES], [0.0; LANES]);
        }
        for power in 1..order - 1 {
            let next = ((power + 2) * (power + 1)) as f64;
            let (by_stiffness, by_damping) = (step * step / next, step / (power + 2) as f64);
            let (known, rest) = series.rows.split_at_mut((power + 2) * stride);
            let u = &known[power * stride..(power + 1) * stride];
            let v = &known[(power + 1) * stride..];
            let (row, _) = rest[LANES..LANES + length].as_chunks_mut::<LANES>();
            let by_time = match power {
                1 => Some((loads[0], step)),
                2 => Some((loads[1], step * step)),
                _ => None,
            };
            for (block, row) in row.iter_mut().enumerate() {
                let first = block * LANES;
                let mut sum = [0.0; LANES];
                if let Some((loads, factor)) = by_time {
                    let loads = &loads[first..first + LANES];
                    lanes!(l, {
                        sum[l] = factor * loads[l];
                    });
                }
                for number in 0..=2 * reach {
                    let k = &stiffness[number * length + first..][..LANES];
                    let u = &u[LANES + first + number - reach..][..LANES];
                    lanes!(l, {
                        sum[l] -= k[l] * u[l];
                    });
                }
                lanes!(l, {
                    sum[l] *= by_stiffness;
                });
                if let Some(alpha) = uniform_damping {
                    let v = &v[LANES + first..][..LANES];
                    let factor = by_damping * alpha;
                    lanes!(l, {
                        sum[l] -= factor * v[l];
                    });
                } else {
                    for number in 0..=2 * reach {
                        let c = &damping[number * length + first..][..LANES];
                        let v = &v[LANES + first + number - reach..][..LANES];
                        lanes!(l, {
                            sum[l] -= by_damping * (c[l] * v[l]);
                        });
                    }
                }
                *row = sum;
                if power + 2 >= FIRST_OF_TAIL {
                    let factor = (power + 2) as f64;
                    let (tail, quick) = (&mut tail[block], &mut quick_tail[block]);
                    lanes!(l, {
                        let size = sum[l].abs();
                        tail[l] += size;
                        quick[l] += factor * size;
                    });
                }
            }
        }
    }
}

/// Displacements, velocities, accelerations and their rates after a share of the step.
pub(super) struct Evaluation<'a> {
    pub(super) series: &'a PowerSeries,
    pub(super) share: f64,
    pub(super) to: &'a mut [Vec<f64>; 4],
}

impl NullaryFnOnce for Evaluation<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { series, share, to } = self;
        let per_time = 1.0 / series.step;
        let scales = [
            1.0,
            per_time,
            2.0 * per_time * per_time,
            6.0 * per_time * per_time * per_time,
        ];
        for block in 0..series.length / LANES {
            let first = block * LANES;
            // Horner's scheme, for the value and its first three derivatives.
            let mut sums = [[0.0; LANES]; 4];
            for power in (0..=series.order).rev() {
                let w = &series.row(power)[first..first + LANES];
                lanes!(l, {
                    sums[3][l] = sums[3][l] * share + sums[2][l];
                    sums[2][l] = sums[2][l] * share + sums[1][l];
                    sums[1][l] = sums[1][l] * share + sums[0][l];
                    sums[0][l] = sums[0][l] * share + w[l];
                });
            }
            for ((to, sum), scale) in to.iter_mut().zip(&sums).zip(scales) {
                let to = &mut to[first..first + LANES];
                lanes!(l, {
                    to[l] = scale * sum[l];
                });
            }
        }
    }
}

/// Velocities after a share of the step, times the step.
pub(super) struct Rates<'a> {
    pub(super) series: &'a PowerSeries,
    pub(super) share: f64,
    pub(super) to: &'a mut [f64],
}

impl Rates<'_> {
    #[inline(always)]
    pub(super) fn find(self) {
        let Self { series, share, to } = self;
        for block in 0..series.length / LANES {
            let first = block * LANES;
            let mut sum = [0.0; LANES];
            for power in (1..=series.order).rev() {
                let factor = power as f64;
                let w = &series.row(power)[first..first + LANES];
                lanes!(l, {
                    sum[l] = sum[l] * share + factor * w[l];
                });
            }
            to[first..first + LANES].copy_from_slice(&sum);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A damped oscillator under a straight line of load, against its closed form.
    #[test]
    fn a_damped_oscillator_moves_as_its_closed_form_says() {
        let (omega, damping, slope) = (7.0_f64, 0.9, 3.0);
        let (u, v) = (0.02, -0.3);
        let a = -omega * omega * u - damping * v;
        for step in [1e-4, 0.01, 0.25] {
            let order = PowerSeries::order_for(omega.max(damping), step);
            let mut series = PowerSeries::blank(1);
            let list = |value: f64| {
                let mut list = vec![0.0; LANES];
                list[0] = value;
                list
            };
            let stiffness = list(omega * omega);
            Expansion {
                step,
                order,
                start: [&list(u), &list(v), &list(a)],
                reach: 0,
                stiffness: &stiffness,
                damping: &[],
                uniform_damping: Some(damping),
                loads: [&list(slope), &list(0.0)],
                series: &mut series,
            }
            .call();
            // u_p = (slope/ω²)(t − c/ω²) beside a free vibration.
            let w2 = omega * omega;
            let particular = [-slope * damping / (w2 * w2), slope / w2];
            let decay = 0.5 * damping;
            let damped_omega = (w2 - decay * decay).sqrt();
            let (p, q) = (u - particular[0], v - particular[1]);
            let (cos, sin) = ((damped_omega * step).cos(), (damped_omega * step).sin());
            let free = (-decay * step).exp() * (p * cos + (q + decay * p) / damped_omega * sin);
            let expected = free + particular[0] + particular[1] * step;
            let mut end = [(); 4].map(|()| vec![0.0; LANES]);
            let share = 1.0;
            let (series, to) = (&series, &mut end);
            Evaluation { series, share, to }.call();
            assert!(
                (end[0][0] - expected).abs() < 1e-16,
                "{step}: {} {expected}",
                end[0][0]
            );
            let balance = slope * step - w2 * end[0][0] - damping * end[1][0];
            assert!(
                (end[2][0] / balance - 1.0).abs() < 1e-12,
                "{step}: {}",
                end[2][0]
            );
            let rate = slope - w2 * end[1][0] - damping * end[2][0];
            assert!(
                (end[3][0] / rate - 1.0).abs() < 1e-9,
                "{step}: {}",
                end[3][0]
            );
        }
    }

    #[test]
    fn roots_and_turns_are_exact() {
        // (s − 0.3)(s − 0.8) turns at 0.55.
        let motion = Powers::of(&[0.24, -1.1, 1.0]);
        let ends = [(0.0, motion.value(0.0)), (0.5, motion.value(0.5))];
        let root = Powers::root(ends, |s| motion.value_and_rate(s));
        assert!((root - 0.3).abs() < 1e-15, "{root}");
        let turns: Vec<f64> = motion.turns().collect();
        assert!(
            turns.len() == 1 && (turns[0] - 0.55).abs() < 1e-15,
            "{turns:?}"
        );
        assert!((motion.greatest_turn() - 0.0625).abs() < 1e-16);
    }
}
