//! A displacement in one direction as a weighted sum of degrees of freedom.

/// Most degrees of freedom of one row: the two translations and the rotation of a rigid floor.
const MOST: usize = 3;

/// A sparse row over degrees of freedom: the displacement of a point in one direction.
///
/// A point of a plane building moves with one degree of freedom, with coefficient 1. A point of a floor that also
/// turns moves with up to three.
///
/// ```
/// use jostle::interface::DofRow;
///
/// let point = DofRow::single(4);
/// assert_eq!(point.value(&[0.0, 0.0, 0.0, 0.0, 0.25]), 0.25);
///
/// // A point 2 m above the centre of mass moves by u − 2 θ along x.
/// let turned = DofRow::new(&[(0, 1.0), (2, -2.0)]).ok_or("at most three")?;
/// assert_eq!(turned.value(&[0.5, 0.0, 0.125]), 0.25);
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DofRow {
    entries: [(usize, f64); MOST],
    count: usize,
}

impl DofRow {
    /// One degree of freedom, with coefficient 1.
    #[must_use]
    pub fn single(dof: usize) -> Self {
        Self {
            entries: [(dof, 1.0); MOST],
            count: 1,
        }
    }

    /// Degrees of freedom with their coefficients; `None` unless there are one to three.
    #[must_use]
    pub fn new(entries: &[(usize, f64)]) -> Option<Self> {
        let first = *entries.first()?;
        if entries.len() > MOST {
            return None;
        }
        let mut row = Self {
            entries: [first; MOST],
            count: entries.len(),
        };
        row.entries[..entries.len()].copy_from_slice(entries);
        Some(row)
    }

    /// Three degrees of freedom with their coefficients.
    #[must_use]
    pub fn three(entries: [(usize, f64); MOST]) -> Self {
        Self {
            entries,
            count: MOST,
        }
    }

    /// Degrees of freedom with their coefficients.
    #[must_use]
    #[inline]
    pub fn entries(&self) -> &[(usize, f64)] {
        &self.entries[..self.count]
    }

    /// The degree of freedom, if there is one alone, with coefficient 1.
    #[must_use]
    pub fn only(&self) -> Option<usize> {
        match *self.entries() {
            [(dof, 1.0)] => Some(dof),
            _ => None,
        }
    }

    /// The value for a vector of all degrees of freedom.
    #[must_use]
    #[inline]
    pub fn value(&self, values: &[f64]) -> f64 {
        let (dof, coefficient) = self.entries[0];
        let mut sum = coefficient * values[dof];
        for &(dof, coefficient) in &self.entries[1..self.count] {
            sum += coefficient * values[dof];
        }
        sum
    }

    /// Adds a force along the direction to a load on all degrees of freedom.
    #[inline]
    pub fn push(&self, force: f64, load: &mut [f64]) {
        for &(dof, coefficient) in self.entries() {
            load[dof] += coefficient * force;
        }
    }

    /// Mass that moves with the point, 1 / Σ c²/m; zero where a degree of freedom has none \[kg\].
    #[must_use]
    pub fn moving_mass(&self, mass: &[f64]) -> f64 {
        if let Some(dof) = self.only() {
            return mass[dof];
        }
        let gives = self.entries().iter().map(|(dof, c)| c * c / mass[*dof]);
        1.0 / gives.sum::<f64>()
    }

    /// The same row over vectors that begin `offset` degrees of freedom earlier.
    #[must_use]
    pub fn moved_up(mut self, offset: usize) -> Self {
        self.entries.iter_mut().for_each(|entry| entry.0 += offset);
        self
    }

    /// The same row over vectors that begin `offset` degrees of freedom later; these are not part of the row.
    #[must_use]
    pub fn moved_down(mut self, offset: usize) -> Self {
        self.entries.iter_mut().for_each(|entry| entry.0 -= offset);
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rigid plate of 8 t with a polar mass of 24 t·m², pushed 3 m beside its centre: 1/m + r²/J.
    #[test]
    fn the_mass_of_a_point_beside_the_centre_is_less() {
        let mass = [8e3, 8e3, 24e3];
        let row = DofRow::new(&[(0, 1.0), (2, -3.0)]).expect("two entries");
        let expected = 1.0 / (1.0 / 8e3 + 9.0 / 24e3);
        assert!((row.moving_mass(&mass) / expected - 1.0).abs() < 1e-15);
        assert_eq!(DofRow::single(1).moving_mass(&mass), 8e3);
        let massless = DofRow::new(&[(0, 1.0), (1, 0.5)]).expect("two entries");
        assert_eq!(massless.moving_mass(&[1.0, 0.0]), 0.0);
    }

    /// Work of a force equals force times displacement of its point.
    #[test]
    fn force_and_displacement_are_conjugate() {
        let row = DofRow::new(&[(1, 0.6), (2, 0.8), (4, -2.5)]).expect("three entries");
        let motion = [9.0, 0.1, 0.2, 9.0, 0.3];
        let mut load = [0.0; 5];
        row.push(7.0, &mut load);
        let work: f64 = load.iter().zip(&motion).map(|(f, u)| f * u).sum();
        assert!((work - 7.0 * row.value(&motion)).abs() < 1e-14);
        assert_eq!(row.moved_up(3).moved_down(3), row);
        assert!(DofRow::new(&[]).is_none() && DofRow::new(&[(0, 1.0); 4]).is_none());
    }
}
