//! Chains of displacements taken abreast: the insides of members, which meet nothing but the joints at their ends.

use crate::small_keys::in_order;
use crate::stretches::Stretches;

/// The first columns of a factor, level by level: columns of a level do not couple, and what they couple to beyond the
/// chains is added up at the ends of the chains, so that neighbours in a level are neighbours everywhere.
#[derive(Clone, Debug, Default)]
pub(super) struct Abreast {
    levels: Vec<Stretches>,
    /// Rows beyond the chains, of every end; the ends stand behind the vector.
    ends: Vec<u32>,
    columns: usize,
    order: usize,
}

/// Fewest columns of a level that are worth it.
const FEWEST: usize = 3;

impl Abreast {
    /// Of a pattern: starts of its columns, rows of its entries, the row that each column is eliminated into.
    pub(super) fn of(starts: &[usize], rows: &[u32], parent: &[u32]) -> Self {
        let order = parent.len();
        let mut bounds = vec![0];
        let mut first = 0;
        while first < order {
            let (mut last, mut nearest) = (first, order);
            while last < nearest {
                let ahead = rows[starts[last]..starts[last + 1]].iter().min();
                nearest = nearest.min(ahead.map_or(order, |row| *row as usize));
                last += 1;
            }
            if last - first < FEWEST {
                break;
            }
            bounds.push(last);
            first = last;
        }
        let columns = first;
        // The chain of a column, by its last column.
        let mut chain: Vec<usize> = (0..columns).collect();
        for column in (0..columns).rev() {
            let next = parent[column] as usize;
            if next < columns && next != column {
                chain[column] = chain[next];
            }
        }
        let ends = Ends::of(&starts[..=columns], rows, &chain);
        let level = |bounds: &[usize]| {
            let mut entries = Vec::with_capacity(starts[bounds[1]] - starts[bounds[0]]);
            for column in bounds[0]..bounds[1] {
                for place in starts[column]..starts[column + 1] {
                    let row = rows[place];
                    let row = if row as usize >= columns {
                        (order + ends.place(chain[column], row)) as u32
                    } else {
                        row
                    };
                    entries.push((row, column as u32, place as u32));
                }
            }
            Stretches::of(entries, order + ends.rows.len())
        };
        Self {
            levels: bounds.windows(2).map(level).collect(),
            ends: ends.in_places(),
            columns,
            order,
        }
    }

    /// Columns that are taken here; all others come behind them.
    pub(super) fn columns(&self) -> usize {
        self.columns
    }

    /// Places wanted behind a vector.
    pub(super) fn ends(&self) -> usize {
        self.ends.len()
    }

    /// Lays couplings out as the passes want them.
    pub(super) fn lay_out(&self, couplings: &[f64], laid: &mut Vec<f64>) {
        laid.clear();
        for level in &self.levels {
            level.lay_out(couplings, laid);
        }
    }

    /// Every column passes its load on, the ends theirs to the joints.
    #[inline(always)]
    pub(super) fn pass_on(&self, laid: &[f64], load: &mut [f64]) {
        load[self.order..].fill(0.0);
        let mut rest = laid;
        for level in &self.levels {
            let (own, after) = rest.split_at(level.len());
            level.pass_on(own, load);
            rest = after;
        }
        let (load, ends) = load.split_at_mut(self.order);
        for (&row, end) in self.ends.iter().zip(ends) {
            load[row as usize] += *end;
        }
    }

    /// Every column, last first, gathers from what is ahead of it.
    #[inline(always)]
    pub(super) fn gather(&self, laid: &[f64], load: &mut [f64]) {
        let (inner, ends) = load.split_at_mut(self.order);
        for (&row, end) in self.ends.iter().zip(ends) {
            *end = inner[row as usize];
        }
        let mut rest = laid;
        for level in self.levels.iter().rev() {
            let (before, own) = rest.split_at(rest.len() - level.len());
            level.gather(own, load);
            rest = before;
        }
    }
}

/// Rows beyond the chains that the chains meet.
struct Ends {
    /// Chain by chain, a chain being known by its last column, rows rising.
    rows: Vec<u32>,
    /// Where the rows of every chain begin in the list.
    starts: Vec<usize>,
    /// Places of the rows behind the vector: ends of one kind of neighbouring chains become neighbours.
    places: Vec<usize>,
}

impl Ends {
    /// Of the columns of a pattern, with the chain of each.
    fn of(starts: &[usize], rows: &[u32], chain: &[usize]) -> Self {
        let columns = chain.len();
        let mut met: Vec<(usize, u32)> = Vec::new();
        for (bounds, last) in starts.windows(2).zip(chain) {
            let ahead = rows[bounds[0]..bounds[1]].iter();
            met.extend(
                ahead
                    .filter(|row| **row as usize >= columns)
                    .map(|row| (*last, *row)),
            );
        }
        met.sort_unstable();
        met.dedup();
        let mut first = vec![0; columns + 1];
        for (last, _) in &met {
            first[last + 1] += 1;
        }
        for column in 0..columns {
            first[column + 1] += first[column];
        }
        // The first row of every chain, then the second ones, and so on.
        let listed: Vec<(usize, usize)> = met
            .iter()
            .enumerate()
            .map(|(index, (last, _))| (index - first[*last], index))
            .collect();
        let mut places = vec![0; met.len()];
        let by_kind = in_order(&listed, met.len(), |entry| entry.0);
        for (place, (_, index)) in by_kind.into_iter().enumerate() {
            places[index] = place;
        }
        Self {
            rows: met.into_iter().map(|(_, row)| row).collect(),
            starts: first,
            places,
        }
    }

    /// Where a chain adds up what it passes on to a row.
    fn place(&self, last: usize, row: u32) -> usize {
        let own = self.starts[last]..self.starts[last + 1];
        let known = self.rows[own.clone()]
            .iter()
            .position(|other| *other == row);
        self.places[own.start + known.unwrap_or(0)]
    }

    /// The rows in the order of their places.
    fn in_places(&self) -> Vec<u32> {
        let mut rows = vec![0; self.rows.len()];
        for (row, place) in self.rows.iter().zip(&self.places) {
            rows[*place] = *row;
        }
        rows
    }
}
