//! Energy dissipated by damping of modes over a step.

use pulp::NullaryFnOnce;

use super::response::{INPUTS, PRODUCTS, Response, Responses, most_radians};
use super::series::radians;

/// Radians over a step below which four points of Gauss' rule are exact to rounding, and below which twelve are.
const FEW_POINTS: f64 = 0.4;
const MANY_POINTS: f64 = 6.0;

/// Gauss' rules for the dissipated energy.
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

/// d ∫ q̇² dt over a step as a quadratic form in (q₀, q̇₀, p₀, p₁, b), mode by mode: upper triangle row by row,
/// off-diagonal entries doubled. Computed by quadrature, so that the energy balance is a check; for modes too fast
/// for that, as work of the load minus change of energy.
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
        // The load until that instant: another line, with a smaller curvature.
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

/// Work of the load of a mode minus its change of energy.
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
    // ∫p q̇ dt by parts, where the slope of the load is that of the line plus 2τ − 1 times b.
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
            let mut x = libm::cos(std::f64::consts::PI * (index as f64 + 0.75) / (n + 0.5));
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
