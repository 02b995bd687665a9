//! Displacements that couple only to their next neighbours: the joints of a frame, floor by floor.

use super::packed_factor::Place;

/// Widths for which loops are compiled, so that their data stay in registers.
const WIDTHS: [usize; 4] = [4, 6, 8, 12];

/// The last columns of a factor as a band; missing entries are zero.
#[derive(Clone, Debug)]
pub(super) struct Band {
    width: usize,
    first: usize,
    places: Vec<Place>,
}

impl Band {
    /// Builds the band of a pattern from a column on: starts of its columns, rows of its entries. `None` if
    /// couplings reach too far.
    pub(super) fn new(first: usize, starts: &[usize], rows: &[u32]) -> Option<Self> {
        let order = starts.len() - 1;
        let entries =
            || (first..order).flat_map(|c| (starts[c]..starts[c + 1]).map(move |p| (c, p)));
        let reach = |(column, place): (usize, usize)| rows[place] as usize - column;
        let widest = entries().map(reach).max().unwrap_or(0);
        let width = WIDTHS.into_iter().find(|width| *width >= widest)?;
        let mut places = vec![Place::Zero; (order - first) * width];
        for (column, place) in entries() {
            places[(column - first) * width + reach((column, place)) - 1] =
                Place::Lower(place as u32);
        }
        Some(Self {
            width,
            first,
            places,
        })
    }

    /// Positions of factor entries in the order of the substitutions, with a fixed number per column.
    pub(super) fn places(&self) -> &[Place] {
        &self.places
    }

    /// Forward substitution and division by the pivots.
    #[inline(always)]
    pub(super) fn forward(&self, entries: &[f64], inverse_pivots: &[f64], load: &mut [f64]) {
        let (inverse_pivots, load) = (&inverse_pivots[self.first..], &mut load[self.first..]);
        match self.width {
            4 => forward::<4>(entries, inverse_pivots, load),
            6 => forward::<6>(entries, inverse_pivots, load),
            8 => forward::<8>(entries, inverse_pivots, load),
            _ => forward::<12>(entries, inverse_pivots, load),
        }
    }

    /// Back substitution.
    #[inline(always)]
    pub(super) fn back(&self, entries: &[f64], load: &mut [f64]) {
        let load = &mut load[self.first..];
        match self.width {
            4 => back::<4>(entries, load),
            6 => back::<6>(entries, load),
            8 => back::<8>(entries, load),
            _ => back::<12>(entries, load),
        }
    }
}

#[inline(always)]
fn forward<const WIDTH: usize>(entries: &[f64], inverse_pivots: &[f64], load: &mut [f64]) {
    // The current column and the following ones.
    let mut ahead = [0.0; WIDTH];
    for (entry, value) in ahead.iter_mut().zip(&*load) {
        *entry = *value;
    }
    let columns = entries.as_chunks::<WIDTH>().0.iter().zip(inverse_pivots);
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
fn back<const WIDTH: usize>(entries: &[f64], load: &mut [f64]) {
    let mut ahead = [0.0; WIDTH];
    for (lower, value) in entries.as_chunks::<WIDTH>().0.iter().zip(load).rev() {
        let mut sum = *value;
        // The nearest row last, because its value has just been computed.
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
