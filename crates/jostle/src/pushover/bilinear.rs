//! The capacity curve as two straight lines of equal energy.

use super::PushPoint;

/// Bilinear discretization of a capacity curve (FEMA 356, 2000, section 3.3.3.2.4), up to its greatest base shear: the
/// first line is the secant through 60 % of the yield strength, the second ends on the curve, and the area below both
/// is that below the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bilinear {
    /// Roof displacement at the corner \[m\].
    pub yield_displacement: f64,
    /// Base shear there \[N\].
    pub yield_force: f64,
    /// Roof displacement at the end \[m\].
    pub ultimate_displacement: f64,
    /// Base shear there \[N\].
    pub ultimate_force: f64,
}

/// Number of strengths evaluated before bisection.
const TRIALS: u32 = 1000;
/// Fraction of the yield strength on the first line \[–\].
const SECANT_AT: f64 = 0.6;

impl Bilinear {
    /// For a curve that rises from zero; `None` if it is linear.
    #[must_use]
    pub fn fit(points: &[PushPoint]) -> Option<Self> {
        let mut peak = 0;
        for (index, point) in points.iter().enumerate() {
            if point.base_shear > points[peak].base_shear * (1.0 + 1e-12) {
                peak = index;
            }
        }
        let last = &points[peak];
        let (end, force) = (last.roof, last.base_shear);
        if force <= 0.0 {
            return None;
        }
        // A plateau counts up to its end.
        let flat = points[peak..]
            .iter()
            .take_while(|point| (point.base_shear - force).abs() <= 1e-9 * force);
        let end = flat.last().map_or(end, |point| point.roof);
        let rise: Vec<[f64; 2]> = points[..=peak]
            .iter()
            .map(|point| [point.roof, point.base_shear])
            .chain([[end, force]])
            .collect();
        let energy: f64 = rise
            .windows(2)
            .map(|pair| 0.5 * (pair[1][0] - pair[0][0]) * (pair[1][1] + pair[0][1]))
            .sum();
        if energy <= 0.5 * end * force * (1.0 + 1e-9) {
            return None;
        }
        let corner = |strength: f64| first_at(&rise, SECANT_AT * strength) / SECANT_AT;
        let excess = |strength: f64| {
            let reached = corner(strength);
            0.5 * reached * strength + 0.5 * (end - reached) * (strength + force) - energy
        };
        // The least strength at which both areas agree; above it the secant would leave the steep part of the
        // curve.
        let trials = (1..=TRIALS).map(|trial| force * f64::from(trial) / f64::from(TRIALS));
        let mut high = trials
            .into_iter()
            .find(|strength| excess(*strength) >= -1e-12 * energy)?;
        let mut low = high - force / f64::from(TRIALS);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if excess(middle) > 0.0 {
                high = middle;
            } else {
                low = middle;
            }
        }
        let strength = 0.5 * (low + high);
        Some(Self {
            yield_displacement: corner(strength),
            yield_force: strength,
            ultimate_displacement: end,
            ultimate_force: force,
        })
    }

    /// Secant stiffness \[N/m\].
    #[must_use]
    pub fn stiffness(&self) -> f64 {
        self.yield_force / self.yield_displacement
    }

    /// Slope of the second line over that of the first \[–\].
    #[must_use]
    pub fn hardening(&self) -> f64 {
        (self.ultimate_force - self.yield_force)
            / (self.ultimate_displacement - self.yield_displacement)
            / self.stiffness()
    }

    /// Ultimate over yield displacement \[–\].
    #[must_use]
    pub fn ductility(&self) -> f64 {
        self.ultimate_displacement / self.yield_displacement
    }
}

/// Point at which a curve first reaches a force.
fn first_at(curve: &[[f64; 2]], force: f64) -> f64 {
    for pair in curve.windows(2) {
        let [[d0, f0], [d1, f1]] = [pair[0], pair[1]];
        if f1 >= force {
            let share = if f1 > f0 {
                (force - f0) / (f1 - f0)
            } else {
                0.0
            };
            return d0 + share.clamp(0.0, 1.0) * (d1 - d0);
        }
    }
    curve.last().map_or(0.0, |point| point[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(corners: &[[f64; 2]]) -> Vec<PushPoint> {
        let point = |[roof, base_shear]: &[f64; 2]| PushPoint {
            roof: *roof,
            base_shear: *base_shear,
            floors: Vec::new(),
            storey_drifts: Vec::new(),
            events: Vec::new(),
            displacement: Vec::new(),
        };
        corners.iter().map(point).collect()
    }

    #[test]
    fn two_lines_stay_two_lines() {
        for end in [5.0, 8.0] {
            let two = Bilinear::fit(&curve(&[[0.0, 0.0], [1.0, 5.0], [4.0, end]])).expect("bent");
            assert!((two.yield_displacement - 1.0).abs() < 1e-8, "{two:?}");
            assert!((two.yield_force - 5.0).abs() < 1e-8, "{two:?}");
            assert!((two.hardening() - (end - 5.0) / 15.0).abs() < 1e-8);
            assert!((two.ductility() - 4.0).abs() < 1e-7);
        }
        assert_eq!(
            Bilinear::fit(&curve(&[[0.0, 0.0], [1.0, 5.0], [2.0, 10.0]])),
            None
        );
        assert_eq!(Bilinear::fit(&curve(&[[0.0, 0.0]])), None);
    }

    #[test]
    fn three_lines_keep_their_energy_and_what_falls_is_left_out() {
        // 0.6 V falls on the second line: d₆₀ = 1 + (0.6 V − 4)/2.
        let corners = [[0.0, 0.0], [1.0, 4.0], [3.0, 8.0], [6.0, 9.0], [9.0, 2.0]];
        let two = Bilinear::fit(&curve(&corners)).expect("bent");
        let [dy, vy, du, vu] = [
            two.yield_displacement,
            two.yield_force,
            two.ultimate_displacement,
            two.ultimate_force,
        ];
        assert_eq!([du, vu], [6.0, 9.0]);
        let energy = 2.0 + 12.0 + 25.5;
        assert!((0.5 * dy * vy + 0.5 * (du - dy) * (vy + vu) - energy).abs() < 1e-8);
        let secant = 1.0 + (SECANT_AT * vy - 4.0) / 2.0;
        assert!((dy - secant / SECANT_AT).abs() < 1e-9, "{two:?}");
    }
}
