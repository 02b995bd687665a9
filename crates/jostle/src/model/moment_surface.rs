//! Moment capacity of a column about both axes as a function of its axial force.

use std::f64::consts::PI;
use std::sync::Arc;

use super::CapacityLine;

/// Moment capacities in all directions against the compression.
///
/// A moment in the first plane and one across are a vector. Its greatest length is known in some directions, at equal angles from
/// the first plane all round, as a line over the compression. Between two directions the edge is straight: where the true surface
/// is convex, this one lies within it.
#[derive(Clone, Debug, PartialEq)]
pub struct MomentSurface {
    lines: Arc<[CapacityLine]>,
    stretch: f64,
}

impl MomentSurface {
    /// From lines over the same compressions, at least four, that of the first plane first, the second one turned towards the
    /// plane across. Directions and lengths are those of vectors whose moment across is multiplied by `stretch` > 0, such as
    /// the depth of the section over its width: then equal angles suit flat sections as well.
    #[must_use]
    pub fn new(lines: Arc<[CapacityLine]>, stretch: f64) -> Self {
        Self { lines, stretch }
    }

    /// Angle between two directions \[rad\].
    fn angle(&self) -> f64 {
        2.0 * PI / self.lines.len() as f64
    }

    /// Length of a pair of moments in its directions \[N·m\].
    pub(crate) fn length(&self, [moment, across]: [f64; 2]) -> f64 {
        let across = self.stretch * across;
        (moment * moment + across * across).sqrt()
    }

    /// Factor between a moment across and its part of such a length \[–\].
    pub(crate) fn stretch(&self) -> f64 {
        self.stretch
    }

    /// Demand over capacity under a compression; see [`super::RuleCapacity::bending_ratio`] \[–\].
    #[must_use]
    pub fn ratio(&self, compression: f64, moments: [f64; 2]) -> f64 {
        let count = self.lines.len();
        if count == 0 {
            return 0.0;
        }
        let angle = self.angle();
        let turned = libm::atan2(self.stretch * moments[1], moments[0]);
        let turned = if turned < 0.0 {
            turned + 2.0 * PI
        } else {
            turned
        };
        let before = ((turned / angle) as usize).min(count - 1);
        let (first, second) = (&self.lines[before], &self.lines[(before + 1) % count]);
        // The unit vector between both is the sum of these shares of their directions.
        let from = turned - before as f64 * angle;
        let share = |value: f64| libm::sin(value) / libm::sin(angle);
        let shares = [share(angle - from), share(from)];
        let second = second.points();
        let between = |point: usize| {
            let one = first.points()[point][1];
            if from == 0.0 {
                return one;
            }
            let other = second.get(point).map_or(0.0, |[_, value]| *value);
            (shares[0] / one + shares[1] / other).recip()
        };
        first.ratio(compression, self.length(moments), between)
    }

    /// No more than the length of a moment that it bears in any direction, over a range of the compression, in rising order
    /// \[N·m\]; zero beyond its ends.
    pub(crate) fn least(&self, range: [f64; 2]) -> f64 {
        if self.lines.iter().any(|line| line.is_left_by(range)) {
            return 0.0;
        }
        // A straight line between two ends comes no nearer than this.
        let nearest = libm::cos(0.5 * self.angle());
        let lines = self.lines.iter().map(|line| line.least(range));
        nearest * lines.fold(f64::INFINITY, f64::min)
    }

    /// Its first line, whose ends are those of all.
    pub(crate) fn first(&self) -> Option<&CapacityLine> {
        self.lines.first()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Eight directions of an octagon of straight edges: 8 N·m along the axes and 6√2 N·m, (6, 6), between, that shrinks to
    /// nothing at 3 N in compression and at −1 N.
    fn octagon(stretch: f64) -> MomentSurface {
        let lines = (0..8).map(|index| {
            let most = if index % 2 == 0 {
                8.0
            } else {
                6.0 * 2.0_f64.sqrt()
            };
            CapacityLine::new(vec![[-1.0, 0.0], [0.0, most], [3.0, 0.0]])
        });
        MomentSurface::new(lines.collect(), stretch)
    }

    #[test]
    fn edges_are_straight_in_every_quarter() {
        // Between (8, 0) and (6, 6): 3 x + y = 24.
        for [x, y] in [[7.0, 3.0], [7.5, 1.5], [6.5, 4.5]] {
            for (a, b) in [
                (x, y),
                (y, x),
                (-x, y),
                (-y, x),
                (-x, -y),
                (-y, -x),
                (x, -y),
                (y, -x),
            ] {
                let found = octagon(1.0).ratio(0.0, [a, b]);
                assert!((found - 1.0).abs() < 1e-14, "{found} at {a}, {b}");
                let half = octagon(1.0).ratio(0.0, [0.5 * a, 0.5 * b]);
                assert!((half - 0.5).abs() < 1e-14, "{half}");
                // Moments across count twice.
                let wide = octagon(2.0).ratio(0.0, [a, 0.5 * b]);
                assert!((wide - 1.0).abs() < 1e-14, "{wide}");
            }
        }
        for axis in [[8.0, 0.0], [0.0, 8.0], [-8.0, 0.0], [0.0, -8.0]] {
            assert_eq!(octagon(1.0).ratio(0.0, axis), 1.0);
        }
    }

    #[test]
    fn beyond_the_surface_the_ray_decides() {
        // (x, y) / λ under 3 N / λ: 3 x + y = 24 λ (1 − N/(3 λ)).
        let [n, x, y] = [2.0, 7.0, 3.0];
        let due = (3.0 * x + y) / 24.0 + n / 3.0;
        let found = octagon(1.0).ratio(n, [x, y]);
        assert!((found - due).abs() < 1e-14, "{found} for {due}");
        // Axial force alone, and inside.
        assert!((octagon(1.0).ratio(6.0, [0.0, 0.0]) - 2.0).abs() < 1e-15);
        assert!((octagon(1.0).ratio(1.5, [1.75, 0.75]) - 0.5).abs() < 1e-14);
    }

    #[test]
    fn no_direction_bears_less_than_the_least() {
        let surface = octagon(1.5);
        let range = [0.5, 1.5];
        let least = surface.least(range);
        assert!(least > 0.0 && surface.least([2.5, 3.5]) == 0.0);
        for step in 0..720 {
            let angle = f64::from(step) * PI / 360.0;
            let moments = [least * angle.cos(), least * angle.sin() / 1.5];
            assert!((surface.length(moments) - least).abs() < 1e-12);
            for compression in [0.5, 0.9, 1.5] {
                assert!(surface.ratio(compression, moments) <= 1.0 + 1e-12);
            }
        }
    }
}
