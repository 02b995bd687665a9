//! [`Rows`]: the rows of a history in blocks, and [`Storage`]: where full blocks are kept.

use std::fmt::Debug;
use std::sync::{Arc, OnceLock};

/// Keeps the full blocks of a history. This crate has the one of [`Storage::MEMORY`]; one that writes files comes from outside.
pub trait BlockStore: Debug + Send + Sync {
    /// Adds a block behind the others; all have the same length.
    ///
    /// # Errors
    /// Why it cannot be kept, and the remedy, as the end of a sentence.
    fn add(&mut self, block: Vec<f64>) -> Result<(), String>;

    /// Reads numbers of a block, counted from 0, from its number `first` on.
    ///
    /// # Errors
    /// Why it cannot be read, as the end of a sentence.
    fn read(&self, block: usize, first: usize, numbers: &mut [f64]) -> Result<(), String>;
}

/// Where the histories of a run are kept, and in blocks of which size.
///
/// ```
/// use jostle::{Settings, history::Storage};
///
/// assert_eq!(Settings::default().storage, Storage::MEMORY);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Storage {
    /// Size of a block, which is in memory while it fills; at least a row \[bytes\].
    pub block: usize,
    /// Makes an empty store for one history.
    pub store: fn() -> Box<dyn BlockStore>,
}

impl Storage {
    /// In memory, whatever their length.
    pub const MEMORY: Self = Self {
        block: 8 << 20,
        store: || Box::new(InMemory::default()),
    };
    /// Nowhere, for runs whose histories nobody reads.
    pub(crate) const NOWHERE: Self = Self {
        store: || Box::new(Nowhere),
        ..Self::MEMORY
    };
}

impl PartialEq for Storage {
    fn eq(&self, other: &Self) -> bool {
        self.block == other.block && std::ptr::fn_addr_eq(self.store, other.store)
    }
}

/// Blocks in memory.
#[derive(Debug, Default)]
struct InMemory {
    blocks: Vec<Vec<f64>>,
}

impl BlockStore for InMemory {
    fn add(&mut self, block: Vec<f64>) -> Result<(), String> {
        self.blocks.push(block);
        Ok(())
    }

    fn read(&self, block: usize, first: usize, numbers: &mut [f64]) -> Result<(), String> {
        let last = first + numbers.len();
        numbers.copy_from_slice(&self.blocks[block][first..last]);
        Ok(())
    }
}

/// Forgets its blocks.
#[derive(Debug)]
struct Nowhere;

impl BlockStore for Nowhere {
    fn add(&mut self, _: Vec<f64>) -> Result<(), String> {
        Ok(())
    }

    fn read(&self, _: usize, _: usize, _: &mut [f64]) -> Result<(), String> {
        Err("the history was not kept".to_owned())
    }
}

/// Rows of equal width. Full blocks are stored by columns, so that a column is read in long pieces.
#[derive(Clone, Debug)]
pub(crate) struct Rows {
    width: usize,
    rows_per_block: usize,
    store: Arc<dyn BlockStore>,
    /// Number of full blocks.
    full: usize,
    /// The rows behind them, one after the other: less than a block, or all from a block on that could not be stored.
    newest: Vec<f64>,
    /// Why a block could not be stored.
    unstored: Option<String>,
    /// Why a block could not be read; its values are zero.
    unread: OnceLock<String>,
}

impl Rows {
    pub(crate) fn new(width: usize, storage: Storage) -> Self {
        Self {
            width,
            rows_per_block: (storage.block / (8 * width.max(1))).max(1),
            store: (storage.store)().into(),
            full: 0,
            newest: Vec::new(),
            unstored: None,
            unread: OnceLock::new(),
        }
    }

    pub(crate) fn width(&self) -> usize {
        self.width
    }

    pub(crate) fn len(&self) -> usize {
        self.full * self.rows_per_block + self.newest.len() / self.width.max(1)
    }

    /// Why rows fill the memory, and the remedy, as the end of a sentence.
    pub(crate) fn unstored(&self) -> Option<&str> {
        self.unstored.as_deref()
    }

    /// Why values could not be read, and the remedy, as the end of a sentence.
    pub(crate) fn unread(&self) -> Option<&str> {
        self.unread.get().map(String::as_str)
    }

    /// Reserves memory for `rows` further ones, a block at most.
    pub(crate) fn reserve(&mut self, rows: usize) {
        self.newest
            .reserve(rows.min(self.rows_per_block) * self.width);
    }

    /// Appends a row of zeros and returns it.
    pub(crate) fn push(&mut self) -> &mut [f64] {
        if self.newest.len() == self.rows_per_block * self.width {
            self.store_block();
        }
        let start = self.newest.len();
        self.newest.resize(start + self.width, 0.0);
        &mut self.newest[start..]
    }

    fn store_block(&mut self) {
        let mut block = Vec::with_capacity(self.newest.len());
        for column in 0..self.width {
            block.extend(self.newest.iter().skip(column).step_by(self.width));
        }
        let stored = match Arc::get_mut(&mut self.store) {
            Some(store) => store.add(block),
            None => Err("a copy of the history is in use".to_owned()),
        };
        match stored {
            Ok(()) => {
                self.full += 1;
                self.newest.clear();
            }
            Err(reason) => self.unstored = Some(reason),
        }
    }

    /// Reads numbers of a full block; zeros if that fails.
    fn read(&self, block: usize, first: usize, numbers: &mut [f64]) {
        if let Err(reason) = self.store.read(block, first, numbers) {
            numbers.fill(0.0);
            self.unread.get_or_init(|| reason);
        }
    }

    /// The values of a column.
    pub(crate) fn column(&self, column: usize) -> Vec<f64> {
        let mut values = vec![0.0; self.len()];
        let (full, newest) = values.split_at_mut(self.full * self.rows_per_block);
        for (block, values) in full.chunks_mut(self.rows_per_block).enumerate() {
            self.read(block, column * self.rows_per_block, values);
        }
        let recent = self.newest.iter().skip(column).step_by(self.width);
        newest
            .iter_mut()
            .zip(recent)
            .for_each(|(to, from)| *to = *from);
        values
    }

    /// The values of a row.
    pub(crate) fn row(&self, row: usize) -> Vec<f64> {
        if let Some(newest) = row.checked_sub(self.full * self.rows_per_block) {
            return self.newest[newest * self.width..(newest + 1) * self.width].to_vec();
        }
        let (block, within) = (row / self.rows_per_block, row % self.rows_per_block);
        let mut values = vec![0.0; self.width];
        for (column, value) in values.iter_mut().enumerate() {
            let first = column * self.rows_per_block + within;
            self.read(block, first, std::slice::from_mut(value));
        }
        values
    }
}

/// Equal values in equal rows, wherever they are kept.
impl PartialEq for Rows {
    fn eq(&self, other: &Self) -> bool {
        let same = |column| self.column(column) == other.column(column);
        self.width == other.width && self.len() == other.len() && (0..self.width).all(same)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of a width, in blocks of three where a row is 24 bytes.
    fn rows(width: usize, count: usize, block: usize) -> Rows {
        let storage = Storage {
            block,
            ..Storage::MEMORY
        };
        let mut rows = Rows::new(width, storage);
        rows.reserve(count);
        for row in 0..count {
            let values = (0..width).map(|column| (100 * row + column) as f64);
            let place = rows.push().iter_mut();
            place.zip(values).for_each(|(to, from)| *to = from);
        }
        rows
    }

    #[test]
    fn rows_and_columns_are_found_in_blocks() {
        for count in 0..20 {
            for block in [1, 24, 72, 75, 10_000] {
                let rows = rows(3, count, block);
                assert_eq!(rows.len(), count);
                for column in 0..3 {
                    let expected = (0..count).map(|row| (100 * row + column) as f64);
                    let expected: Vec<f64> = expected.collect();
                    assert_eq!(rows.column(column), expected, "{count} rows, {block} bytes");
                }
                for row in 0..count {
                    let [a, b, c] = [0, 1, 2].map(|column| (100 * row + column) as f64);
                    assert_eq!(rows.row(row), [a, b, c]);
                }
                assert_eq!((rows.unstored(), rows.unread()), (None, None));
            }
        }
        assert_eq!(rows(3, 11, 72), rows(3, 11, 10_000));
        assert_ne!(rows(3, 11, 72), rows(3, 12, 72));
    }

    /// A copy shares the full blocks: neither may add one that the other sees.
    #[test]
    fn a_copy_in_use_is_told_and_loses_nothing() {
        let mut first = rows(3, 7, 72);
        let copy = first.clone();
        for _ in 0..6 {
            first.push().fill(1.0);
        }
        assert_eq!(first.unstored(), Some("a copy of the history is in use"));
        assert_eq!((copy.len(), first.len()), (7, 13));
        assert_eq!(first.column(0)[..7], copy.column(0));
        assert_eq!(first.column(0)[7..], [1.0; 6]);
        assert_eq!(first.row(12), [1.0; 3]);
    }

    #[test]
    fn what_is_kept_nowhere_cannot_be_read() {
        let storage = Storage {
            block: 24,
            ..Storage::NOWHERE
        };
        let mut rows = Rows::new(3, storage);
        for _ in 0..3 {
            rows.push().fill(1.0);
        }
        assert_eq!(rows.column(0), [0.0, 0.0, 1.0]);
        assert_eq!(rows.unread(), Some("the history was not kept"));
    }
}
