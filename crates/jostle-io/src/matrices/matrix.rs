//! A matrix as read from a file.

use std::collections::BTreeMap;

use jostle::Given;

/// A matrix by its entries that are not zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Matrix {
    pub(crate) rows: usize,
    pub(crate) columns: usize,
    entries: BTreeMap<(usize, usize), f64>,
}

/// Greatest difference of two flexibilities that should be equal, in parts of the root of both on the diagonal: programs print few
/// digits.
const ROUNDED: f64 = 0.02;

/// Greatest difference of two entries that should be equal, in parts of the greatest of their row and column.
const SYMMETRY: f64 = 1e-9;

impl Matrix {
    pub(crate) fn new(rows: usize, columns: usize) -> Self {
        Self {
            rows,
            columns,
            entries: BTreeMap::new(),
        }
    }

    /// The number of entries of a matrix of these sizes.
    ///
    /// # Errors
    /// In words, if it is larger than that of a building can be.
    pub(super) fn possible(rows: usize, columns: usize) -> Result<usize, String> {
        let most = Given::MOST_DISPLACEMENTS;
        if rows == 0 || columns == 0 || rows.max(columns) > most {
            return Err(format!(
                "has {rows} rows and {columns} columns; 1 to {most} of each are possible: condense the model at fewer displacements"
            ));
        }
        Ok(rows * columns)
    }

    /// Sets an entry; a value given several times is summed.
    ///
    /// # Errors
    /// In words, if the value is no finite number.
    pub(crate) fn add(&mut self, row: usize, column: usize, value: f64) -> Result<(), String> {
        if !value.is_finite() {
            return Err(format!(
                "has {value} in row {}, column {}, which is no number",
                row + 1,
                column + 1
            ));
        }
        if value != 0.0 {
            *self.entries.entry((row, column)).or_default() += value;
        }
        Ok(())
    }

    pub(crate) fn at(&self, row: usize, column: usize) -> f64 {
        self.entries.get(&(row, column)).copied().unwrap_or(0.0)
    }

    /// The inverse of a matrix of flexibilities, which rounding may have left a little unsymmetric.
    ///
    /// # Errors
    /// The problem in words.
    pub(crate) fn inverse(&self) -> Result<Self, String> {
        let n = self.rows;
        self.is_square(n)?;
        let mut rows = Vec::with_capacity(n);
        for i in 0..n {
            for j in 0..i {
                let (one, other) = (self.at(i, j), self.at(j, i));
                let size = (self.at(i, i) * self.at(j, j)).sqrt();
                if (one - other).abs() > ROUNDED * size || !size.is_finite() {
                    let (i, j) = (i + 1, j + 1);
                    return Err(format!(
                        "must be symmetric, since floor {i} moves under a force at floor {j} as {j} under one at {i}; found {one:e} in row {i}, column {j} and {other:e} in row {j}, column {i}"
                    ));
                }
            }
            let row = (0..=i).map(|j| 0.5 * (self.at(i, j) + self.at(j, i)));
            rows.push(row.collect());
        }
        let inverse = Given::stiffness_of(rows).ok_or(
            "is not positive definite: a force would move the building against its direction; give more digits (smaller units of length, or a greater force), or give the stiffness matrix",
        )?;
        let mut found = Self::new(n, n);
        for (i, row) in inverse.into_iter().enumerate() {
            for (j, value) in row.into_iter().enumerate() {
                found.add(i, j, value)?;
            }
        }
        Ok(found)
    }

    /// A row or a column of `count` values, or the diagonal of a square matrix that has no other entries.
    ///
    /// # Errors
    /// The problem in words.
    pub(crate) fn diagonal(&self, count: usize) -> Result<Vec<f64>, String> {
        if self.rows == 1 && self.columns == count {
            return Ok((0..count).map(|column| self.at(0, column)).collect());
        }
        if self.columns == 1 && self.rows == count {
            return Ok((0..count).map(|row| self.at(row, 0)).collect());
        }
        self.is_square(count)?;
        let off = self.entries.iter().find(|((row, column), _)| row != column);
        match off {
            Some(((row, column), value)) => Err(format!(
                "has {value:e} in row {}, column {}; masses must stand on the diagonal: lump them, as with the sums of the rows",
                row + 1,
                column + 1
            )),
            None => Ok((0..count).map(|row| self.at(row, row)).collect()),
        }
    }

    /// The lower triangle of a symmetric matrix.
    ///
    /// # Errors
    /// The problem in words.
    pub(crate) fn lower_triangle(&self, count: usize) -> Result<Vec<(usize, usize, f64)>, String> {
        self.is_square(count)?;
        let mut sizes = vec![0.0_f64; count];
        for (&(row, column), value) in &self.entries {
            for place in [row, column] {
                sizes[place] = sizes[place].max(value.abs());
            }
        }
        for (&(row, column), value) in &self.entries {
            let mirrored = self.at(column, row);
            let size = sizes[row].max(sizes[column]);
            if !value.is_finite() || (value - mirrored).abs() > SYMMETRY * size {
                let (i, j) = (row + 1, column + 1);
                return Err(format!(
                    "must be symmetric, found {value:e} in row {i}, column {j} and {mirrored:e} in row {j}, column {i}"
                ));
            }
        }
        let lower = self
            .entries
            .iter()
            .filter(|((row, column), _)| row >= column);
        Ok(lower
            .map(|(&(row, column), value)| (row, column, *value))
            .collect())
    }

    fn is_square(&self, count: usize) -> Result<(), String> {
        if self.rows == count && self.columns == count {
            Ok(())
        } else {
            Err(format!(
                "has {} rows and {} columns; {count} of each are needed, as many as the stiffness matrix has",
                self.rows, self.columns
            ))
        }
    }
}
