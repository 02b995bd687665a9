//! A number that depends linearly on displacements.

use super::sorting::sort_by_key;

/// Terms that a row holds without memory of its own: those of a point of a floor in plan, or of a spring between two floors there.
const FEW: usize = 4;

/// What is left of shares that cancel, over the greatest of them \[–\].
const ROUNDING: f64 = 1e-13;

/// Σ share · displacement: of a point in one direction, of a deformation, of a reported number.
///
/// The terms keep the order in which they were given, and are added up in it. By the principle of virtual work, a force acts on the
/// degrees of freedom with the same shares.
///
/// ```
/// use jostle::linear::Row;
///
/// let point = Row::single(4);
/// assert_eq!(point.value(&[0.0, 0.0, 0.0, 0.0, 0.25]), 0.25);
///
/// // A point 2 m above the centre of mass moves by u − 2 θ along x.
/// let turned = Row::new(&[(0, 1.0), (2, -2.0)]);
/// assert_eq!(turned.value(&[0.5, 0.0, 0.125]), 0.25);
///
/// // What lies between both.
/// let between = turned.plus(&point.times(-1.0));
/// assert_eq!(between.entries(), [(0, 1.0), (2, -2.0), (4, -1.0)]);
/// ```
#[derive(Clone, Debug)]
pub struct Row(Terms);

/// Most rows are one displacement or the difference of two: these are told apart by one comparison.
#[derive(Clone, Debug)]
enum Terms {
    One((usize, f64)),
    Two([(usize, f64); 2]),
    Few(u32, [(usize, f64); FEW]),
    Many(Vec<(usize, f64)>),
}

impl Row {
    /// One degree of freedom, with share 1.
    #[must_use]
    pub fn single(dof: usize) -> Self {
        Self::new(&[(dof, 1.0)])
    }

    /// Degrees of freedom with their shares; none is a point that does not move.
    #[must_use]
    pub fn new(entries: &[(usize, f64)]) -> Self {
        Self(match *entries {
            [one] => Terms::One(one),
            [first, second] => Terms::Two([first, second]),
            _ if entries.len() > FEW => Terms::Many(entries.to_vec()),
            _ => {
                let mut few = [(0, 0.0); FEW];
                few[..entries.len()].copy_from_slice(entries);
                Terms::Few(entries.len() as u32, few)
            }
        })
    }

    /// Degrees of freedom with their shares.
    #[must_use]
    #[inline]
    pub fn entries(&self) -> &[(usize, f64)] {
        match &self.0 {
            Terms::One(one) => std::slice::from_ref(one),
            Terms::Two(two) => two,
            Terms::Few(count, few) => &few[..*count as usize],
            Terms::Many(many) => many,
        }
    }

    fn entries_mut(&mut self) -> &mut [(usize, f64)] {
        match &mut self.0 {
            Terms::One(one) => std::slice::from_mut(one),
            Terms::Two(two) => two,
            Terms::Few(count, few) => &mut few[..*count as usize],
            Terms::Many(many) => many,
        }
    }

    /// Degrees of freedom in the order of the terms.
    #[inline]
    pub fn dofs(&self) -> impl Iterator<Item = usize> + '_ {
        self.entries().iter().map(|(dof, _)| *dof)
    }

    /// Whether nothing moves it.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.entries().is_empty()
    }

    /// The degree of freedom, if there is one alone, with share 1.
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
        match &self.0 {
            Terms::One((dof, share)) => share * values[*dof],
            Terms::Two([(a, of_a), (b, of_b)]) => of_a * values[*a] + of_b * values[*b],
            Terms::Few(..) | Terms::Many(_) => self.sum(values),
        }
    }

    fn sum(&self, values: &[f64]) -> f64 {
        let [first, others @ ..] = self.entries() else {
            return 0.0;
        };
        let mut sum = first.1 * values[first.0];
        for (dof, share) in others {
            sum += share * values[*dof];
        }
        sum
    }

    /// The value for numbers that are asked for one by one.
    #[must_use]
    #[inline]
    pub fn value_of(&self, number: impl Fn(usize) -> f64) -> f64 {
        let entries = self.entries().iter();
        entries.map(|(dof, share)| share * number(*dof)).sum()
    }

    /// The most that it can be where displacements are within bounds.
    #[must_use]
    #[inline]
    pub(crate) fn bound(&self, bounds: &[f64]) -> f64 {
        let entries = self.entries().iter();
        entries.fold(0.0, |sum, (dof, share)| sum + share.abs() * bounds[*dof])
    }

    /// The value for several vectors at once, which stand side by side.
    #[must_use]
    #[inline]
    pub fn values<const N: usize>(&self, values: &[[f64; N]]) -> [f64; N] {
        let mut sums = [-0.0; N];
        for (dof, share) in self.entries() {
            for (sum, value) in sums.iter_mut().zip(&values[*dof]) {
                *sum += share * value;
            }
        }
        sums
    }

    /// Adds a force along it to a load on all degrees of freedom.
    #[inline]
    pub fn push(&self, force: f64, load: &mut [f64]) {
        match &self.0 {
            Terms::One((dof, share)) => load[*dof] += share * force,
            Terms::Two([(a, of_a), (b, of_b)]) => {
                load[*a] += of_a * force;
                load[*b] += of_b * force;
            }
            Terms::Few(..) | Terms::Many(_) => {
                for (dof, share) in self.entries() {
                    load[*dof] += share * force;
                }
            }
        }
    }

    /// Mass that moves with the point, 1 / Σ c²/m; zero where a degree of freedom has none, infinite where nothing moves it \[kg\].
    #[must_use]
    pub fn moving_mass(&self, mass: &[f64]) -> f64 {
        if let Some(dof) = self.only() {
            return mass[dof];
        }
        let gives = self.entries().iter().map(|(dof, c)| c * c / mass[*dof]);
        // An empty sum would be −0.
        1.0 / gives.fold(0.0, |sum, give| sum + give)
    }

    /// Adds a term.
    pub fn add(&mut self, dof: usize, share: f64) {
        self.extend([(dof, share)]);
    }

    /// Adds the terms of another row, multiplied.
    pub fn add_times(&mut self, factor: f64, other: &Self) {
        let terms = other.entries().iter();
        self.extend(terms.map(|(dof, share)| (*dof, factor * share)));
    }

    /// The sum of two rows: the terms of both, one after the other.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let both = self.entries().iter().chain(other.entries());
        both.copied().collect()
    }

    /// The row with all shares multiplied.
    #[must_use]
    pub fn times(&self, factor: f64) -> Self {
        let mut row = self.clone();
        row.entries_mut()
            .iter_mut()
            .for_each(|(_, share)| *share *= factor);
        row
    }

    /// Terms of one degree of freedom added up, in the order of degrees of freedom, without those that cancel.
    #[must_use]
    pub fn merged(&self) -> Self {
        let least = ROUNDING * self.greatest();
        let sums = self.summed();
        let kept = sums
            .entries()
            .iter()
            .filter(|(_, share)| share.abs() > least);
        kept.copied().collect()
    }

    /// Terms of one degree of freedom added up, in the order of degrees of freedom.
    pub(crate) fn summed(&self) -> Self {
        let mut entries = self.entries().to_vec();
        sort_by_key(&mut entries, |(dof, _)| *dof);
        entries.dedup_by(|(dof, share), (kept, sum)| {
            let same = dof == kept;
            if same {
                *sum += *share;
            }
            same
        });
        entries.into_iter().collect()
    }

    /// Greatest magnitude of a share.
    pub(crate) fn greatest(&self) -> f64 {
        let shares = self.entries().iter();
        shares.fold(0.0, |most, (_, share)| share.abs().max(most))
    }

    /// The same row over vectors that begin `offset` degrees of freedom earlier.
    #[must_use]
    pub fn moved_up(&self, offset: usize) -> Self {
        let mut row = self.clone();
        row.entries_mut()
            .iter_mut()
            .for_each(|(dof, _)| *dof += offset);
        row
    }

    /// The same row over vectors that begin `offset` degrees of freedom later; these are not part of the row.
    #[must_use]
    pub fn moved_down(&self, offset: usize) -> Self {
        let mut row = self.clone();
        row.entries_mut()
            .iter_mut()
            .for_each(|(dof, _)| *dof -= offset);
        row
    }
}

impl Default for Row {
    /// A point that does not move.
    fn default() -> Self {
        Self::new(&[])
    }
}

impl PartialEq for Row {
    fn eq(&self, other: &Self) -> bool {
        self.entries() == other.entries()
    }
}

impl Extend<(usize, f64)> for Row {
    fn extend<I: IntoIterator<Item = (usize, f64)>>(&mut self, entries: I) {
        for entry in entries {
            if let Terms::Many(many) = &mut self.0 {
                many.push(entry);
                continue;
            }
            let count = self.entries().len();
            let mut list = [entry; FEW + 1];
            list[..count].copy_from_slice(self.entries());
            *self = Self::new(&list[..=count]);
        }
    }
}

impl FromIterator<(usize, f64)> for Row {
    fn from_iter<I: IntoIterator<Item = (usize, f64)>>(entries: I) -> Self {
        let mut entries = entries.into_iter();
        let (mut few, mut count) = ([(0, 0.0); FEW], 0);
        for (place, entry) in few.iter_mut().zip(entries.by_ref()) {
            *place = entry;
            count += 1;
        }
        match entries.next() {
            None => Self::new(&few[..count]),
            Some(next) => {
                let others = few.into_iter().chain([next]);
                Self(Terms::Many(others.chain(entries).collect()))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rigid plate of 8 t with a polar mass of 24 t·m², pushed 3 m beside its centre: 1/m + r²/J.
    #[test]
    fn the_mass_of_a_point_beside_the_centre_is_less() {
        let mass = [8e3, 8e3, 24e3];
        let row = Row::new(&[(0, 1.0), (2, -3.0)]);
        let expected = 1.0 / (1.0 / 8e3 + 9.0 / 24e3);
        assert!((row.moving_mass(&mass) / expected - 1.0).abs() < 1e-15);
        assert_eq!(Row::single(1).moving_mass(&mass), 8e3);
        let massless = Row::new(&[(0, 1.0), (1, 0.5)]);
        assert_eq!(massless.moving_mass(&[1.0, 0.0]), 0.0);
        assert_eq!(Row::default().moving_mass(&mass), f64::INFINITY);
    }

    /// Work of a force equals force times displacement of its point, for any number of terms.
    #[test]
    fn force_and_displacement_are_conjugate() {
        let entries = [(1, 0.6), (2, 0.8), (4, -2.5), (0, 0.3), (3, 1.0), (5, 4.0)];
        let motion = [9.0, 0.1, 0.2, 7.0, 0.3, -2.0];
        for count in 0..=entries.len() {
            let row = Row::new(&entries[..count]);
            let mut load = [0.0; 6];
            row.push(7.0, &mut load);
            let work: f64 = load.iter().zip(&motion).map(|(f, u)| f * u).sum();
            assert!((work - 7.0 * row.value(&motion)).abs() < 1e-13);
            assert_eq!(
                row.values(&motion.map(|u| [u, 2.0 * u]))[1],
                2.0 * row.value(&motion)
            );
            assert_eq!(row.moved_up(3).moved_down(3), row);
            assert_eq!(entries[..count].iter().copied().collect::<Row>(), row);
        }
    }

    /// A point against itself does not move; what remains stands in the order of degrees of freedom.
    #[test]
    fn terms_that_cancel_are_left_out() {
        let row = Row::new(&[(5, 0.1), (2, 0.7), (1, 3.0)]);
        let twice = row.plus(&row).merged();
        assert_eq!(twice.entries(), [(1, 6.0), (2, 1.4), (5, 0.2)]);
        assert!(row.plus(&row.times(-1.0)).merged().is_empty());
    }
}
