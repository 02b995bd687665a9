//! Entries of a matrix that lie next to each other along its diagonal: members beside each other make many of them.
//! Loops over them need no list of indices and fill wide registers, always in the same order: the bits do not depend on
//! the processor.

use crate::small_keys::in_order;

/// The entries (`row`, `column`), (`row` + 1, `column` + 1) and so on, `row` − `column` ≥ `length`.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    column: u32,
    row: u32,
    length: u32,
}

/// Entries below the diagonal, stretch by stretch.
#[derive(Clone, Debug, Default)]
pub(crate) struct Stretches {
    stretches: Vec<Stretch>,
    /// Where the values of these entries are kept, in the order of the stretches.
    places: Vec<u32>,
}

/// Values taken at once.
const LANES: usize = 4;

impl Stretches {
    /// Of entries (row, column, where the value is kept), row > column.
    pub(crate) fn of(entries: &[(u32, u32, u32)]) -> Self {
        let rows = entries.iter().map(|entry| entry.0 as usize + 1);
        let rows = rows.max().unwrap_or(0);
        let by_column = in_order(entries, rows, |entry| entry.1 as usize);
        let entries = in_order(&by_column, rows, |&(row, column, _)| {
            (row - column) as usize
        });
        let mut stretches: Vec<Stretch> = Vec::new();
        for &(row, column, _) in &entries {
            match stretches.last_mut() {
                Some(last)
                    if (row, column) == (last.row + last.length, last.column + last.length)
                        && last.length < row - column =>
                {
                    last.length += 1;
                }
                _ => stretches.push(Stretch {
                    column,
                    row,
                    length: 1,
                }),
            }
        }
        Self {
            stretches,
            places: entries.iter().map(|&(_, _, place)| place).collect(),
        }
    }

    /// Number of entries.
    pub(crate) fn len(&self) -> usize {
        self.places.len()
    }

    /// Lays values out as the loops want them.
    pub(crate) fn lay_out(&self, values: &[f64], laid: &mut Vec<f64>) {
        laid.extend(self.places.iter().map(|&place| values[place as usize]));
    }

    /// x at rows less value · x at columns. No row may be one of the columns.
    #[inline(always)]
    pub(crate) fn pass_on(&self, laid: &[f64], x: &mut [f64]) {
        let mut rest = laid;
        for stretch in &self.stretches {
            let (values, after) = rest.split_at(stretch.length as usize);
            rest = after;
            let (columns, rows) = stretch.split(x);
            subtract(rows, values, columns);
        }
    }

    /// x at columns less value · x at rows. No row may be one of the columns.
    #[inline(always)]
    pub(crate) fn gather(&self, laid: &[f64], x: &mut [f64]) {
        let mut rest = laid;
        for stretch in &self.stretches {
            let (values, after) = rest.split_at(stretch.length as usize);
            rest = after;
            let (columns, rows) = stretch.split(x);
            subtract(columns, values, rows);
        }
    }

    /// Σ value · x at column · x at row.
    #[inline(always)]
    pub(crate) fn bilinear(&self, laid: &[f64], x: &[f64]) -> f64 {
        // Two sums in turn: one would wait for itself.
        let (mut sums, mut left) = ([[0.0; LANES]; 2], 0.0);
        let mut rest = laid;
        for stretch in &self.stretches {
            let length = stretch.length as usize;
            let (values, after) = rest.split_at(length);
            rest = after;
            let (values, short_values) = values.as_chunks::<LANES>();
            let columns = &x[stretch.column as usize..][..length];
            let (columns, short_columns) = columns.as_chunks::<LANES>();
            let (rows, short_rows) = x[stretch.row as usize..][..length].as_chunks::<LANES>();
            for ((value, column), row) in values.iter().zip(columns).zip(rows) {
                let (value, column, row) = (*value, *column, *row);
                let mut sum = sums[0];
                for lane in 0..LANES {
                    sum[lane] += value[lane] * column[lane] * row[lane];
                }
                sums = [sums[1], sum];
            }
            for ((value, column), row) in short_values.iter().zip(short_columns).zip(short_rows) {
                left += value * column * row;
            }
        }
        sums.as_flattened().iter().sum::<f64>() + left
    }
}

impl Stretch {
    /// Of a vector, what stands at the columns and what at the rows.
    #[inline(always)]
    fn split<'a>(&self, x: &'a mut [f64]) -> (&'a mut [f64], &'a mut [f64]) {
        let length = self.length as usize;
        let (before, rows) = x.split_at_mut(self.row as usize);
        (
            &mut before[self.column as usize..][..length],
            &mut rows[..length],
        )
    }
}

#[inline(always)]
fn subtract(from: &mut [f64], values: &[f64], of: &[f64]) {
    let (from, short_from) = from.as_chunks_mut::<LANES>();
    let (values, short_values) = values.as_chunks::<LANES>();
    let (of, short_of) = of.as_chunks::<LANES>();
    for ((from, value), of) in from.iter_mut().zip(values).zip(of) {
        // Whole registers in, one out: nothing can overlap.
        let (mut sum, value, of) = (*from, *value, *of);
        for lane in 0..LANES {
            sum[lane] -= value[lane] * of[lane];
        }
        *from = sum;
    }
    for ((from, value), of) in short_from.iter_mut().zip(short_values).zip(short_of) {
        *from -= value * of;
    }
}

#[cfg(test)]
mod tests {
    use pulp::{Arch, NullaryFnOnce};

    use super::*;

    struct Passes<'a> {
        stretches: &'a Stretches,
        laid: &'a [f64],
        x: &'a mut [f64],
    }

    impl NullaryFnOnce for Passes<'_> {
        type Output = f64;

        #[inline(always)]
        fn call(self) -> f64 {
            self.stretches.pass_on(self.laid, self.x);
            self.stretches.gather(self.laid, self.x);
            self.stretches.bilinear(self.laid, self.x)
        }
    }

    /// Stretches of every length, one at a time: what a loop over single entries gives, to the bit in vectors, and the
    /// same bits in wide registers.
    #[test]
    fn stretches_do_what_single_entries_do() {
        for length in 1..23_u32 {
            let entries: Vec<_> = (0..length).map(|k| (k + 30, k, length - 1 - k)).collect();
            let stretches = Stretches::of(&entries);
            assert_eq!(
                (stretches.stretches.len(), stretches.len()),
                (1, length as usize)
            );
            let values: Vec<f64> = (0..length).map(|k| (0.3 + f64::from(k)).sin()).collect();
            let mut laid = Vec::new();
            stretches.lay_out(&values, &mut laid);
            let start: Vec<f64> = (0..60).map(|k| (1.7 * f64::from(k)).cos()).collect();
            let run = |wide: bool| {
                let mut x = start.clone();
                let passes = Passes {
                    stretches: &stretches,
                    laid: &laid,
                    x: &mut x,
                };
                let sum = if wide {
                    Arch::new().dispatch(passes)
                } else {
                    passes.call()
                };
                (x, sum)
            };
            let (wide, narrow) = (run(true), run(false));
            assert_eq!(wide, narrow, "{length} entries");
            let mut x = start.clone();
            let value = |k: usize| values[length as usize - 1 - k];
            (0..length as usize).for_each(|k| x[k + 30] -= value(k) * x[k]);
            (0..length as usize).for_each(|k| x[k] -= value(k) * x[k + 30]);
            assert_eq!(wide.0, x, "{length} entries");
            let sum: f64 = (0..length as usize)
                .map(|k| value(k) * x[k] * x[k + 30])
                .sum();
            assert!((wide.1 - sum).abs() < 1e-14 * f64::from(length));
        }
    }
}
