//! Chains of displacements taken abreast: the insides of members, which meet nothing but the joints at their ends.

use std::collections::BTreeMap;

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
        // Ends of one kind of neighbouring chains become neighbours.
        let mut met: BTreeMap<(usize, u32), usize> = BTreeMap::new();
        for column in 0..columns {
            for row in &rows[starts[column]..starts[column + 1]] {
                if *row as usize >= columns {
                    met.insert((chain[column], *row), 0);
                }
            }
        }
        let mut of_chain = (usize::MAX, 0);
        let mut kinds: Vec<(usize, usize, u32)> = Vec::with_capacity(met.len());
        for &(last, row) in met.keys() {
            let kind = if of_chain.0 == last {
                of_chain.1 + 1
            } else {
                0
            };
            of_chain = (last, kind);
            kinds.push((kind, last, row));
        }
        kinds.sort_unstable();
        for (index, &(_, last, row)) in kinds.iter().enumerate() {
            met.insert((last, row), order + index);
        }
        let level = |bounds: &[usize]| {
            let entries = (bounds[0]..bounds[1]).flat_map(|column| {
                let (met, last) = (&met, chain[column]);
                let places = starts[column]..starts[column + 1];
                places.map(move |place| {
                    let row = rows[place];
                    let row = met.get(&(last, row)).map_or(row, |end| *end as u32);
                    (row, column as u32, place as u32)
                })
            });
            Stretches::of(&entries.collect::<Vec<_>>())
        };
        Self {
            levels: bounds.windows(2).map(level).collect(),
            ends: kinds.iter().map(|&(_, _, row)| row).collect(),
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
