//! Displacements that couple to nothing but their next neighbours: the joints of a frame, floor by floor.

use super::packed_factor::Place;

/// Widths that loops are compiled for: what they need stays in registers.
const WIDTHS: [usize; 4] = [4, 6, 8, 12];

/// The last columns of a factor, each with its entries in the rows that come next; those that a matrix does not have are
/// zero.
#[derive(Clone, Debug)]
pub(super) struct Band {
    width: usize,
    first: usize,
    places: Vec<Place>,
}

impl Band {
    /// Of a pattern from a column on: starts of its columns, rows of its entries. None where they reach too far.
    pub(super) fn of(first: usize, starts: &[usize], rows: &[u32]) -> Option<Self> {
        let order = starts.len() - 1;
        let own = || (first..order).flat_map(|c| (starts[c]..starts[c + 1]).map(move |p| (c, p)));
        let reach = |(column, place): (usize, usize)| rows[place] as usize - column;
        let widest = own().map(reach).max().unwrap_or(0);
        let width = WIDTHS.into_iter().find(|width| *width >= widest)?;
        let mut places = vec![Place::Zero; (order - first) * width];
        for (column, place) in own() {
            places[(column - first) * width + reach((column, place)) - 1] =
                Place::Lower(place as u32);
        }
        Some(Self {
            width,
            first,
            places,
        })
    }

    /// What the passes take, as many entries for every column.
    pub(super) fn places(&self) -> &[Place] {
        &self.places
    }

    /// Every column passes its load on, and is then divided by its pivot.
    #[inline(always)]
    pub(super) fn pass_on(&self, laid: &[f64], inverse_pivots: &[f64], load: &mut [f64]) {
        let (inverse_pivots, load) = (&inverse_pivots[self.first..], &mut load[self.first..]);
        match self.width {
            4 => pass_on::<4>(laid, inverse_pivots, load),
            6 => pass_on::<6>(laid, inverse_pivots, load),
            8 => pass_on::<8>(laid, inverse_pivots, load),
            _ => pass_on::<12>(laid, inverse_pivots, load),
        }
    }

    /// Every column, last first, gathers from the rows ahead of it.
    #[inline(always)]
    pub(super) fn gather(&self, laid: &[f64], load: &mut [f64]) {
        let load = &mut load[self.first..];
        match self.width {
            4 => gather::<4>(laid, load),
            6 => gather::<6>(laid, load),
            8 => gather::<8>(laid, load),
            _ => gather::<12>(laid, load),
        }
    }
}

#[inline(always)]
fn pass_on<const WIDTH: usize>(laid: &[f64], inverse_pivots: &[f64], load: &mut [f64]) {
    // The column whose turn it is, and those after it.
    let mut ahead = [0.0; WIDTH];
    for (own, value) in ahead.iter_mut().zip(&*load) {
        *own = *value;
    }
    let columns = laid.as_chunks::<WIDTH>().0.iter().zip(inverse_pivots);
    for (column, (lower, inverse_pivot)) in columns.enumerate() {
        let passed = ahead[0];
        load[column] = passed * inverse_pivot;
        for entry in 1..WIDTH {
            ahead[entry - 1] = ahead[entry] - lower[entry - 1] * passed;
        }
        let fresh = load.get(column + WIDTH).copied().unwrap_or(0.0);
        ahead[WIDTH - 1] = fresh - lower[WIDTH - 1] * passed;
    }
}

#[inline(always)]
fn gather<const WIDTH: usize>(laid: &[f64], load: &mut [f64]) {
    let mut ahead = [0.0; WIDTH];
    for (lower, value) in laid.as_chunks::<WIDTH>().0.iter().zip(load).rev() {
        let mut sum = *value;
        // The nearest, which has only just been found, last.
        for entry in (0..WIDTH).rev() {
            sum -= lower[entry] * ahead[entry];
        }
        *value = sum;
        for entry in (1..WIDTH).rev() {
            ahead[entry] = ahead[entry - 1];
        }
        ahead[0] = sum;
    }
}
