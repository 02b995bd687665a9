//! Runs of entries along diagonals of a matrix; adjacent members cause many of them. Loops process one register at
//! a time, always in the same order, so the bits do not depend on the processor.

/// The entries (`row`, `column`), (`row` + 1, `column` + 1) and so on, a register of them. Missing entries are
/// zero.
#[derive(Clone, Copy, Debug)]
struct Chunk {
    column: u32,
    row: u32,
}

/// Entries below the diagonal, run by run, divided into chunks.
#[derive(Clone, Debug, Default)]
pub(crate) struct DiagonalRuns {
    chunks: Vec<Chunk>,
    /// Positions of the values of the chunks; [`NOWHERE`] pads them.
    places: Vec<u32>,
    /// Entries (row, column, where the value is kept) too close to the ends of a vector for a chunk.
    loose: Vec<(u32, u32, u32)>,
}

/// Values processed at once.
const LANES: usize = 8;
const NOWHERE: u32 = u32::MAX;

impl DiagonalRuns {
    /// Of entries (row, column, where the value is kept), row > column, for vectors of `order` values.
    pub(crate) fn new(mut entries: Vec<(u32, u32, u32)>, order: usize) -> Self {
        entries.sort_unstable_by_key(|&(row, column, _)| (row - column, column));
        let mut runs = Self::default();
        let mut rest = &entries[..];
        while let Some(&(row, column, place)) = rest.first() {
            let next = |(step, entry): &(usize, &(u32, u32, u32))| {
                (entry.0 as usize, entry.1 as usize)
                    == (row as usize + step, column as usize + step)
            };
            let length = rest.iter().enumerate().take(LANES).take_while(next).count();
            let (run, after) = rest.split_at(length);
            rest = after;
            // At the end of a vector a chunk begins earlier, padded with zeros.
            let early = (row as usize + LANES).saturating_sub(order) as u32;
            if early > column {
                runs.loose.push((row, column, place));
                let others = run.iter().skip(1);
                runs.loose.extend(others);
                continue;
            }
            runs.chunks.push(Chunk {
                column: column - early,
                row: row - early,
            });
            let places = (0..LANES).map(|lane| {
                let entry = lane.checked_sub(early as usize);
                let entry = entry.and_then(|entry| run.get(entry));
                entry.map_or(NOWHERE, |entry| entry.2)
            });
            runs.places.extend(places);
        }
        runs
    }

    /// Lays values out as the loops want them.
    pub(crate) fn pack(&self, values: &[f64], packed: &mut Vec<f64>) {
        let value = |place: u32| values.get(place as usize).copied().unwrap_or(0.0);
        packed.extend(self.places.iter().map(|place| value(*place)));
        packed.extend(self.loose.iter().map(|&(_, _, place)| value(place)));
    }

    /// Adds A x to a product for the stored triangle and its transpose.
    #[inline(always)]
    pub(crate) fn multiply_add(&self, packed: &[f64], x: &[f64], product: &mut [f64]) {
        let (values, loose) = packed.split_at(self.places.len());
        for (chunk, values) in self.chunks.iter().zip(values.as_chunks().0) {
            add(chunk.row, values, &at(chunk.column, x), product);
            add(chunk.column, values, &at(chunk.row, x), product);
        }
        for (&(row, column, _), value) in self.loose.iter().zip(loose) {
            product[row as usize] += value * x[column as usize];
            product[column as usize] += value * x[row as usize];
        }
    }

    /// Σ value · x at column · x at row.
    #[inline(always)]
    pub(crate) fn bilinear(&self, packed: &[f64], x: &[f64]) -> f64 {
        // Two sums in turn: one would wait for itself.
        let mut sums = [[0.0; LANES]; 2];
        let (values, loose) = packed.split_at(self.places.len());
        for (chunk, values) in self.chunks.iter().zip(values.as_chunks::<LANES>().0) {
            let (columns, rows) = (at(chunk.column, x), at(chunk.row, x));
            let mut sum = sums[0];
            for lane in 0..LANES {
                sum[lane] += values[lane] * columns[lane] * rows[lane];
            }
            sums = [sums[1], sum];
        }
        let loose = self.loose.iter().zip(loose);
        let loose = loose.map(|(&(row, column, _), v)| v * x[row as usize] * x[column as usize]);
        sums.as_flattened().iter().sum::<f64>() + loose.sum::<f64>()
    }
}

/// A register of x.
#[inline(always)]
fn at(first: u32, x: &[f64]) -> [f64; LANES] {
    let mut values = [0.0; LANES];
    let first = first as usize;
    values.copy_from_slice(&x[first..first + LANES]);
    values
}

/// Adds values · x to a product from an index on.
#[inline(always)]
fn add(to: u32, values: &[f64; LANES], x: &[f64; LANES], product: &mut [f64]) {
    let mut sum = at(to, product);
    for lane in 0..LANES {
        sum[lane] += values[lane] * x[lane];
    }
    let to = to as usize;
    product[to..to + LANES].copy_from_slice(&sum);
}

#[cfg(test)]
mod tests {
    use pulp::{Arch, NullaryFnOnce};

    use super::*;

    struct Products<'a> {
        runs: &'a DiagonalRuns,
        packed: &'a [f64],
        x: &'a [f64],
    }

    impl NullaryFnOnce for Products<'_> {
        type Output = (Vec<f64>, f64);

        #[inline(always)]
        fn call(self) -> (Vec<f64>, f64) {
            let mut product = vec![0.0; self.x.len()];
            self.runs.multiply_add(self.packed, self.x, &mut product);
            (product, self.runs.bilinear(self.packed, self.x))
        }
    }

    /// Runs of every length, far from the diagonal and next to it, inside a vector and up to its end, against a
    /// loop over single entries, and with the same bits in wide registers.
    #[test]
    fn stretches_do_what_single_entries_do() {
        for apart in [1, 2, 5, 9, 30] {
            for length in 1..23 {
                for order in [length + apart, length + apart + 3, 60] {
                    compare(apart, length, order);
                }
            }
        }
    }

    fn compare(apart: u32, length: u32, order: u32) {
        let entries: Vec<_> = (0..length)
            .map(|k| (k + apart, k, length - 1 - k))
            .collect();
        let runs = DiagonalRuns::new(entries, order as usize);
        let values: Vec<f64> = (0..length).map(|k| (0.3 + f64::from(k)).sin()).collect();
        let mut packed = Vec::new();
        runs.pack(&values, &mut packed);
        let x: Vec<f64> = (0..order).map(|k| (1.7 * f64::from(k)).cos()).collect();
        let products = || Products {
            runs: &runs,
            packed: &packed,
            x: &x,
        };
        let (wide, narrow) = (Arch::new().dispatch(products()), products().call());
        let case = format!("{length} entries {apart} apart of {order}");
        assert_eq!(wide, narrow, "{case}");
        let (length, apart) = (length as usize, apart as usize);
        let value = |k: usize| values[length - 1 - k];
        let sum: f64 = (0..length).map(|k| value(k) * x[k] * x[k + apart]).sum();
        assert!((wide.1 - sum).abs() < 1e-14 * length as f64, "{case}");
        let mut expected = vec![0.0; order as usize];
        (0..length).for_each(|k| expected[k + apart] += value(k) * x[k]);
        (0..length).for_each(|k| expected[k] += value(k) * x[k + apart]);
        for (got, expected) in wide.0.iter().zip(&expected) {
            assert!((got - expected).abs() < 1e-14, "{case}");
        }
    }
}
