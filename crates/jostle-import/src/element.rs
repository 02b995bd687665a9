//! Stiffness over rows of free displacements.

use std::collections::BTreeMap;

use crate::beam::Stiffness;

/// What a displacement of a joint is: shares of free displacements of the structure.
pub(crate) type Shares = Vec<(usize, f64)>;

/// A stiffness over rows of free displacements: its entries of the lower triangle.
pub(crate) struct Element(pub(crate) Vec<(usize, usize, f64)>);

impl Element {
    pub(crate) fn new(rows: [Shares; 12], stiffness: &Stiffness) -> Self {
        let mut entries = Vec::new();
        for (row, values) in rows.iter().zip(stiffness) {
            for (column, value) in rows
                .iter()
                .zip(values)
                .filter(|candidate| *candidate.1 != 0.0)
            {
                for (i, a) in row {
                    let below = column.iter().filter(|column| column.0 <= *i);
                    entries.extend(below.map(|(j, b)| (*i, *j, a * b * value)));
                }
            }
        }
        Self(entries)
    }

    /// A spring against one combination of displacements.
    pub(crate) fn spring(row: Shares, stiffness: f64) -> Self {
        let mut entries = Vec::new();
        for (i, a) in &row {
            let below = row.iter().filter(|row| row.0 <= *i);
            entries.extend(below.map(|(j, b)| (*i, *j, a * b * stiffness)));
        }
        Self(entries)
    }
}

/// The sum of rows times factors, each displacement once.
pub(crate) fn combined(rows: &[(&Shares, f64)]) -> Shares {
    let mut sum: BTreeMap<usize, f64> = BTreeMap::new();
    for (row, factor) in rows {
        for (place, share) in *row {
            *sum.entry(*place).or_default() += factor * share;
        }
    }
    sum.into_iter().collect()
}
