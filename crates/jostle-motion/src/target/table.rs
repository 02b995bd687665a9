//! A design spectrum given by points.

use crate::fault::MotionFault;

/// Points of a design spectrum with straight lines between their logarithms; from a point at period zero the line
/// is straight without logarithms.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectrumTable {
    name: String,
    damping: f64,
    points: Vec<[f64; 2]>,
}

impl SpectrumTable {
    /// A table from points of period ≥ 0, rising \[s\], and pseudo-acceleration > 0 \[m/s²\], for one damping ratio.
    ///
    /// # Errors
    /// [`MotionFault::Table`] with the first wrong point.
    pub fn new(name: &str, damping: f64, points: Vec<[f64; 2]>) -> Result<Self, MotionFault> {
        let good = |i: usize, [t, a]: [f64; 2]| {
            t.is_finite()
                && a.is_finite()
                && t >= 0.0
                && a > 0.0
                && (i == 0 || t > points[i - 1][0])
        };
        if let Some(wrong) = (0..points.len()).find(|&i| !good(i, points[i])) {
            return Err(MotionFault::Table { point: wrong + 1 });
        }
        if points.len() < 2 {
            return Err(MotionFault::Table {
                point: points.len() + 1,
            });
        }
        Ok(Self {
            name: name.to_owned(),
            damping,
            points,
        })
    }

    /// Name for display.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Damping ratio of the table \[–\].
    #[must_use]
    pub fn damping(&self) -> f64 {
        self.damping
    }

    pub(super) fn range(&self) -> [f64; 2] {
        [self.points[0][0], self.points[self.points.len() - 1][0]]
    }

    /// The period must lie in the range.
    pub(super) fn acceleration(&self, period: f64, damping: f64) -> Result<f64, MotionFault> {
        if (damping - self.damping).abs() > 1e-12 {
            return Err(MotionFault::OtherDamping {
                given: self.damping,
                wanted: damping,
            });
        }
        let after = self.points.partition_point(|[t, _]| *t <= period);
        let after = after.clamp(1, self.points.len() - 1);
        let ([t0, a0], [t1, a1]) = (self.points[after - 1], self.points[after]);
        Ok(if t0 > 0.0 {
            let share = libm::log(period / t0) / libm::log(t1 / t0);
            a0 * libm::pow(a1 / a0, share)
        } else {
            a0 + (a1 - a0) * (period - t0) / (t1 - t0)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_straight_in_logarithms() {
        let points = vec![[0.0, 1.0], [0.1, 2.5], [1.0, 2.5], [10.0, 0.25]];
        let table = SpectrumTable::new("own", 0.05, points).unwrap();
        for (t, a) in [
            (0.0, 1.0),
            (0.05, 1.75),
            (0.3, 2.5),
            (2.0, 1.25),
            (10.0, 0.25),
        ] {
            assert!(
                (table.acceleration(t, 0.05).unwrap() - a).abs() < 1e-14,
                "at {t}"
            );
        }
        assert!(table.acceleration(1.0, 0.02).is_err());
        assert!(SpectrumTable::new("", 0.05, vec![[0.1, 1.0], [0.1, 2.0]]).is_err());
        assert!(SpectrumTable::new("", 0.05, vec![[0.1, 1.0]]).is_err());
    }
}
