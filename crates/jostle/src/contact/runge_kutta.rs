//! Adaptive Runge–Kutta steps for two unknowns, Dormand & Prince 5(4), with event location.

/// Tableau of J. R. Dormand and P. J. Prince (1980), Journal of Computational and Applied Mathematics 6, 19–26.
const NODES: [f64; 6] = [0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];
const WEIGHTS: [[f64; 6]; 6] = [
    [0.2, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [
        19372.0 / 6561.0,
        -25360.0 / 2187.0,
        64448.0 / 6561.0,
        -212.0 / 729.0,
        0.0,
        0.0,
    ],
    [
        9017.0 / 3168.0,
        -355.0 / 33.0,
        46732.0 / 5247.0,
        49.0 / 176.0,
        -5103.0 / 18656.0,
        0.0,
    ],
    [
        35.0 / 384.0,
        0.0,
        500.0 / 1113.0,
        125.0 / 192.0,
        -2187.0 / 6784.0,
        11.0 / 84.0,
    ],
];
/// Fifth-order minus fourth-order weights.
const ERROR: [f64; 7] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339_200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];

/// Two unknowns of order one at one instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub(super) time: f64,
    pub(super) y: [f64; 2],
}

/// One step of length `h`, with its error estimate.
fn step(point: Point, h: f64, f: &impl Fn(f64, [f64; 2]) -> [f64; 2]) -> (Point, f64) {
    let mut slopes = [[0.0; 2]; 7];
    slopes[0] = f(point.time, point.y);
    let mut y = point.y;
    for stage in 0..6 {
        y = point.y;
        for (slope, weight) in slopes.iter().zip(WEIGHTS[stage]) {
            y[0] += h * weight * slope[0];
            y[1] += h * weight * slope[1];
        }
        slopes[stage + 1] = f(point.time + NODES[stage] * h, y);
    }
    let error = |k: usize| -> f64 {
        let sum: f64 = slopes.iter().zip(ERROR).map(|(s, w)| w * s[k]).sum();
        (h * sum).abs()
    };
    let end = Point {
        time: point.time + h,
        y,
    };
    (end, error(0).max(error(1)))
}

/// Error of one step \[of unknowns of order one\].
const TOLERANCE: f64 = 2e-14;
/// Largest number of steps; a collision takes a few hundred.
const MOST_STEPS: usize = 200_000;

/// Integrates until `reached` first holds, and ends where it starts to hold; `visit` is called with every step. The
/// right side must be smooth up to that point and finite beyond it. `reached` must not hold at the start.
pub(super) fn integrate(
    start: Point,
    first_step: f64,
    f: impl Fn(f64, [f64; 2]) -> [f64; 2],
    reached: impl Fn(&Point) -> bool,
    mut visit: impl FnMut(Point, Point),
) -> Point {
    let mut point = start;
    let mut h = first_step;
    for _ in 0..MOST_STEPS {
        let (end, error) = step(point, h, &f);
        let smallest = 1e-12 * point.time.abs().max(first_step);
        if error > TOLERANCE && h > smallest {
            h *= (0.9 * libm::pow(TOLERANCE / error, 0.2)).clamp(0.1, 0.9);
            continue;
        }
        if reached(&end) {
            let landed = land(point, h, &f, &reached);
            visit(point, landed);
            return landed;
        }
        visit(point, end);
        point = end;
        h *= (0.9 * libm::pow(TOLERANCE / error.max(1e-18), 0.2)).clamp(0.5, 2.0);
        h = h.min(MOST_PER_STEP);
    }
    point
}

/// Longest step, for curves without corners.
const MOST_PER_STEP: f64 = 0.02;

/// The shortest step from `point` after which `reached` holds, given that it does after `h`.
pub(super) fn land(
    point: Point,
    h: f64,
    f: &impl Fn(f64, [f64; 2]) -> [f64; 2],
    reached: &impl Fn(&Point) -> bool,
) -> Point {
    let (mut low, mut high) = (0.0, h);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if reached(&step(point, middle, f).0) {
            high = middle;
        } else {
            low = middle;
        }
    }
    step(point, high, f).0
}
