//! Shear and bending capacity of columns and beams as functions of their axial force.

use super::MomentSurface;

/// A straight-line interpolation between points, constant beyond its ends.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CapacityLine {
    points: Vec<[f64; 2]>,
}

impl CapacityLine {
    /// Through points in rising order of their abscissa; a single point is a constant, none is zero.
    #[must_use]
    pub fn new(points: Vec<[f64; 2]>) -> Self {
        Self { points }
    }

    /// The points.
    #[must_use]
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// Value at an abscissa.
    #[must_use]
    pub fn at(&self, abscissa: f64) -> f64 {
        self.at_with(abscissa, |point| self.points[point][1])
    }

    /// The same of other values at its points.
    #[inline]
    pub(super) fn at_with(&self, abscissa: f64, value: impl Fn(usize) -> f64) -> f64 {
        let after = self.points.partition_point(|[x, _]| *x <= abscissa);
        match (after.checked_sub(1), self.points.get(after)) {
            (Some(before), Some([b, _])) => {
                let ([a, _], p, q) = (self.points[before], value(before), value(after));
                p + (q - p) * ((abscissa - a) / (b - a))
            }
            (Some(last), None) => value(last),
            (None, Some(_)) => value(0),
            (None, None) => 0.0,
        }
    }

    /// Least value over a range of abscissas, in rising order.
    #[must_use]
    pub(crate) fn least(&self, [low, high]: [f64; 2]) -> f64 {
        let inside = self.points.iter().filter(|[x, _]| low < *x && *x < high);
        let ends = self.at(low).min(self.at(high));
        inside.fold(ends, |least, [_, value]| least.min(*value))
    }

    /// Whether a range of abscissas, in rising order, goes beyond its ends; never where there is one point only.
    pub(crate) fn is_left_by(&self, [low, high]: [f64; 2]) -> bool {
        match self.points[..] {
            [[first, _], .., [last, _]] => low < first || last < high,
            _ => false,
        }
    }

    /// Abscissa over that of the end beyond which it is, seen from zero; 0 within the ends, and where there is one point only.
    pub(super) fn beyond(&self, abscissa: f64) -> f64 {
        let [[low, _], .., [high, _]] = self.points[..] else {
            return 0.0;
        };
        if abscissa > high && high > 0.0 {
            abscissa / high
        } else if abscissa < low && low < 0.0 {
            abscissa / low
        } else {
            0.0
        }
    }

    /// Factor by which a point beyond a line of these values at its points, seen from the origin, is farther away than the
    /// line; `None` if the ray does not meet it.
    pub(super) fn overshoot(
        &self,
        abscissa: f64,
        value: f64,
        line: impl Fn(usize) -> f64,
    ) -> Option<f64> {
        let met = self
            .points
            .windows(2)
            .enumerate()
            .filter_map(|(index, ends)| {
                let ([a, _], [b, _]) = (ends[0], ends[1]);
                let (p, q) = (line(index), line(index + 1));
                let (wide, rise) = (b - a, q - p);
                // The share s of the ray at which s·value is on the line through both points.
                let share = (p * wide - a * rise) / (value * wide - abscissa * rise);
                let within = (a..=b).contains(&(share * abscissa));
                (share > 0.0 && within).then(|| share.recip())
            });
        met.max_by(f64::total_cmp)
    }
}

/// Capacity of one column or beam.
#[derive(Clone, Debug, PartialEq)]
pub struct MemberCapacity {
    /// The member: `J1.column.LINE.STOREY`, `J1.beam.FLOOR.SPAN`.
    pub member: String,
    /// Compression by self weight that the forces of the run leave out \[N\].
    pub compression_at_rest: f64,
    /// Whether the axial force of the instant counts; otherwise that at rest only, as in beams.
    pub follows_axial: bool,
    /// Drift ratio at which a column that failed in shear loses its axial load, against the compression; empty if
    /// unknown \[–, N\].
    pub axial_failure_drift: CapacityLine,
    /// Rotations of its ends that rules accept.
    pub rotations: Vec<RotationLimits>,
    /// By rule; the first governs.
    pub rules: Vec<RuleCapacity>,
}

/// Rotations of member ends at the limits of some levels of performance.
#[derive(Clone, Debug, PartialEq)]
pub struct RotationLimits {
    /// The rule, such as `asce41`; `section` for crushing of the section.
    pub rule: &'static str,
    /// Which rotation the limits are for.
    pub measure: RotationMeasure,
    /// Levels in rising order, with the greatest rotation of each \[rad\].
    pub limits: Vec<(&'static str, f64)>,
}

/// A rotation of a member end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RotationMeasure {
    /// Beyond the yield rotation of the hinge.
    Plastic,
    /// Of the hinge and of the member, bent in double curvature, together.
    Chord,
}

/// A rule of capacity as it is written: `gb50010` is `GB 50010`.
#[must_use]
pub fn capacity_rule_title(key: &str) -> &str {
    match key {
        "gb50010" => "GB 50010",
        "en1998-3" => "EN 1998-3",
        "asce41" => "ASCE 41",
        "aci318" => "ACI 318",
        "aisc360" => "AISC 360",
        "sezen-moehle" => "Sezen and Moehle",
        other => other,
    }
}

/// Capacity of a member by one rule.
#[derive(Clone, Debug, PartialEq)]
pub struct RuleCapacity {
    /// Its name, such as `gb50010`.
    pub rule: &'static str,
    /// In shear; `None` where the rule has none.
    pub shear: Option<ShearCapacity>,
    /// Moment that stretches the bottom of a beam or the right face of a column, then that of the other sign, both ≥ 0,
    /// against the compression \[N·m, N\]. A line of several points ends at the greatest tension and compression; one point
    /// holds for every axial force.
    pub bending: [CapacityLine; 2],
    /// What a column of a space frame bears beside; `None` for members that bend in one plane.
    pub across: Option<AcrossCapacity>,
}

/// Capacity of a column that bends in two planes.
#[derive(Clone, Debug, PartialEq)]
pub struct AcrossCapacity {
    /// In shear in the plane across; `None` where the rule has none.
    pub shear: Option<ShearCapacity>,
    /// For moments in both planes at once.
    pub bending: MomentSurface,
}

/// Shear capacity against compression \[N\].
#[derive(Clone, Debug, PartialEq)]
pub struct ShearCapacity {
    /// Part that ductility does not reduce.
    pub steady: CapacityLine,
    /// Part that ductility reduces.
    pub degrading: CapacityLine,
    /// Factor on it against the ductility of the member \[–\]; empty for 1.
    pub by_ductility: CapacityLine,
    /// Upper bound; may be infinite.
    pub limit: f64,
}

impl ShearCapacity {
    /// Capacity under a compression \[N\] at a ductility \[–\].
    #[must_use]
    pub fn at(&self, compression: f64, ductility: f64) -> f64 {
        let factor = self.factor(ductility);
        (self.steady.at(compression) + factor * self.degrading.at(compression)).min(self.limit)
    }

    /// Factor on the degrading part at a ductility \[–\].
    pub(crate) fn factor(&self, ductility: f64) -> f64 {
        if self.by_ductility.points.is_empty() {
            1.0
        } else {
            self.by_ductility.at(ductility)
        }
    }

    /// Whether ductility reduces it.
    #[must_use]
    pub fn degrades(&self) -> bool {
        !self.by_ductility.points.is_empty()
    }
}

impl RuleCapacity {
    /// Moment capacity for a moment of this sign under a compression \[N·m\].
    #[must_use]
    pub fn bending_at(&self, compression: f64, moment: f64) -> f64 {
        self.bending[usize::from(moment < 0.0)].at(compression)
    }

    /// Demand over capacity in bending under a compression, of a moment and that in the plane across \[–\].
    ///
    /// Within the capacity this is the moment over the moment capacity in its direction under this compression. Beyond it,
    /// where that may be next to nothing, it is not more than the factor by which compression and moment together exceed the
    /// surface of both. Beyond the greatest compression or tension, at the ends of the line, it is at least that force over the
    /// end, however small the moment: uneven bars give a section a moment capacity at its ends. Members that bend in one plane
    /// bear no moment across.
    #[must_use]
    pub fn bending_ratio(&self, compression: f64, moments: [f64; 2]) -> f64 {
        match &self.across {
            Some(across) => across.bending.ratio(compression, moments),
            None => {
                let [moment, _] = moments;
                let line = &self.bending[usize::from(moment < 0.0)];
                line.ratio(compression, moment.abs(), |point| line.points[point][1])
            }
        }
    }

    /// Demand over capacity in shear, of a shear and that in the plane across; zero where the rule has none \[–\].
    ///
    /// Of two shears the ratios are added up as the legs of a right triangle (GB 50010-2010, 6.3.17): the capacity is an
    /// ellipse with those along both axes.
    #[must_use]
    pub fn shear_ratio(&self, compression: f64, shears: [f64; 2], ductility: f64) -> f64 {
        let ratio = |capacity: &Option<ShearCapacity>, shear: f64| {
            let capacity = capacity.as_ref();
            capacity.map_or(0.0, |capacity| {
                shear.abs() / capacity.at(compression, ductility)
            })
        };
        let along = ratio(&self.shear, shears[0]);
        match &self.across {
            Some(across) => libm::hypot(along, ratio(&across.shear, shears[1])),
            None => along,
        }
    }
}

impl CapacityLine {
    /// Moment over a line of these values at its points; see [`RuleCapacity::bending_ratio`].
    #[inline]
    pub(super) fn ratio(
        &self,
        compression: f64,
        moment: f64,
        line: impl Fn(usize) -> f64 + Copy,
    ) -> f64 {
        let ratio = moment / self.at_with(compression, line);
        let axial = self.beyond(compression);
        if ratio <= 1.0 {
            return ratio.max(axial);
        }
        let together = self.overshoot(compression, moment, line);
        let ratio = match together {
            Some(together) if ratio.is_nan() || together < ratio => together,
            _ => ratio,
        };
        ratio.max(axial)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_interpolate_and_end_level() {
        let line = CapacityLine::new(vec![[-1.0, 2.0], [1.0, 4.0], [3.0, 0.0]]);
        let values = [-2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 9.0].map(|x| line.at(x));
        assert_eq!(values, [2.0, 2.0, 3.0, 4.0, 2.0, 0.0, 0.0]);
        let least =
            [[-3.0, -2.0], [-2.0, 0.5], [0.0, 2.5], [2.5, 9.0]].map(|range| line.least(range));
        assert_eq!(least, [2.0, 2.0, 1.0, 0.0]);
        assert_eq!(CapacityLine::new(vec![[5.0, 7.0]]).at(-3.0), 7.0);
        assert_eq!(CapacityLine::default().at(1.0), 0.0);
    }

    /// A surface of straight lines from −1 N over (0 N, 2 N·m) to 3 N.
    #[test]
    fn beyond_the_surface_compression_and_moment_count_together() {
        let line = CapacityLine::new(vec![[-1.0, 0.0], [0.0, 2.0], [3.0, 0.0]]);
        let rule = RuleCapacity {
            rule: "test",
            shear: None,
            bending: [line.clone(), line],
            across: None,
        };
        // Within: M / (2 (1 − N/3)).
        assert!((rule.bending_ratio(1.5, [-0.5, 0.0]) - 0.5).abs() < 1e-15);
        // On the surface both measures are one.
        assert!((rule.bending_ratio(1.5, [1.0, 0.0]) - 1.0).abs() < 1e-15);
        // At the limit of compression and beyond: M = λ 2 (1 − N/(3 λ)) gives λ = M/2 + N/3.
        for (compression, moment) in [(3.0, 1.0), (6.0, 0.25), (2.9, 3.0)] {
            let expected = 0.5 * moment + compression / 3.0;
            let found = rule.bending_ratio(compression, [moment, 0.0]);
            assert!((found - expected).abs() < 1e-14, "{found} for {expected}");
        }
        // In tension beyond −1 N: M = λ 2 (1 + N/λ) gives λ = M/2 − N.
        assert!((rule.bending_ratio(-2.0, [0.5, 0.0]) - 2.25).abs() < 1e-14);
        assert!((rule.bending_ratio(6.0, [0.0; 2]) - 2.0).abs() < 1e-14);
    }

    /// A section with uneven bars carries a moment at its ends: −2 N with 0.5 N·m, 4 N with 1 N·m.
    #[test]
    fn beyond_the_axial_strength_every_moment_is_too_much() {
        let line = CapacityLine::new(vec![[-2.0, 0.5], [0.0, 3.0], [4.0, 1.0]]);
        let even = CapacityLine::new(vec![[0.0, 3.0]]);
        let rule = RuleCapacity {
            rule: "test",
            shear: None,
            bending: [line, even],
            across: None,
        };
        let ratios = [[4.0, 0.5], [6.0, 0.0], [6.0, 0.5], [-5.0, 0.1]]
            .map(|[n, m]| rule.bending_ratio(n, [m, 0.0]));
        assert_eq!(ratios, [0.5, 1.5, 1.5, 2.5]);
        // The ray through (5, 4) leaves at M = 0.8 N = 3 − 0.5 N, before the end.
        assert!((rule.bending_ratio(5.0, [4.0, 0.0]) - 5.0 / (3.0 / 1.3)).abs() < 1e-14);
        // One point has no ends.
        assert_eq!(rule.bending_ratio(6.0, [-1.5, 0.0]), 0.5);
    }

    #[test]
    fn shear_falls_with_ductility_only_in_part() {
        let shear = ShearCapacity {
            steady: CapacityLine::new(vec![[0.0, 100.0]]),
            degrading: CapacityLine::new(vec![[0.0, 200.0]]),
            by_ductility: CapacityLine::new(vec![[2.0, 1.0], [6.0, 0.7]]),
            limit: 280.0,
        };
        assert_eq!(shear.at(0.0, 1.0), 280.0);
        assert_eq!(shear.at(0.0, 4.0), 100.0 + 0.85 * 200.0);
        assert_eq!(shear.at(0.0, 60.0), 240.0);
    }
}
