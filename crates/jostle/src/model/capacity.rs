//! Shear and bending capacity of columns and beams as functions of their axial force.

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
        let after = self.points.partition_point(|[x, _]| *x <= abscissa);
        match (after.checked_sub(1), self.points.get(after)) {
            (Some(before), Some([b, q])) => {
                let [a, p] = self.points[before];
                p + (q - p) * ((abscissa - a) / (b - a))
            }
            (Some(last), None) => self.points[last][1],
            (None, Some([_, first])) => *first,
            (None, None) => 0.0,
        }
    }

    /// Greatest slope, either sign.
    #[must_use]
    pub fn steepest(&self) -> f64 {
        let slopes = self.points.windows(2);
        let slopes =
            slopes.map(|ends| ((ends[1][1] - ends[0][1]) / (ends[1][0] - ends[0][0])).abs());
        slopes.fold(0.0, f64::max)
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

/// Capacity of a member by one rule.
#[derive(Clone, Debug, PartialEq)]
pub struct RuleCapacity {
    /// Its name, such as `gb50010`.
    pub rule: &'static str,
    /// In shear; `None` where the rule has none.
    pub shear: Option<ShearCapacity>,
    /// Moment that stretches the bottom of a beam or the right face of a column, then that of the other sign, both ≥ 0,
    /// against the compression \[N·m, N\].
    pub bending: [CapacityLine; 2],
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
        let factor = if self.by_ductility.points.is_empty() {
            1.0
        } else {
            self.by_ductility.at(ductility)
        };
        (self.steady.at(compression) + factor * self.degrading.at(compression)).min(self.limit)
    }

    /// Whether ductility reduces it.
    #[must_use]
    pub fn degrades(&self) -> bool {
        !self.by_ductility.points.is_empty()
    }

    /// Greatest change with the compression \[–\].
    #[must_use]
    pub fn steepest(&self) -> f64 {
        self.steady.steepest() + self.degrading.steepest()
    }
}

impl RuleCapacity {
    /// Moment capacity for a moment of this sign under a compression \[N·m\].
    #[must_use]
    pub fn bending_at(&self, compression: f64, moment: f64) -> f64 {
        self.bending[usize::from(moment < 0.0)].at(compression)
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
        assert_eq!(line.steepest(), 2.0);
        assert_eq!(CapacityLine::new(vec![[5.0, 7.0]]).at(-3.0), 7.0);
        assert_eq!(CapacityLine::default().at(1.0), 0.0);
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
