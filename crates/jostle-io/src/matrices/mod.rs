//! Matrices of buildings: NumPy archives and Matrix Market files.

mod matrix;
mod matrix_market;
mod npz;

pub(crate) use matrix::Matrix;

use std::path::Path;

use crate::bounded::read_at_most;

/// Largest file \[bytes\].
const LARGEST: usize = 256 << 20;

/// Matrices of one building, in the units of the file.
#[derive(Clone, Debug, Default)]
pub(crate) struct Matrices {
    pub(crate) mass: Option<Matrix>,
    pub(crate) stiffness: Option<Matrix>,
    pub(crate) damping: Option<Matrix>,
    pub(crate) influence: Option<Matrix>,
    pub(crate) heights: Option<Matrix>,
    pub(crate) flexibility: Option<Matrix>,
}

/// Names of the matrices in a NumPy archive.
pub(crate) const ARRAYS: [[&str; 2]; 6] = [
    ["M", "mass"],
    ["K", "stiffness"],
    ["C", "damping"],
    ["r", "influence"],
    ["h", "heights"],
    ["F", "flexibility"],
];

impl Matrices {
    /// The place of a matrix, in the order of [`ARRAYS`].
    pub(crate) fn places(&mut self) -> [&mut Option<Matrix>; 6] {
        [
            &mut self.mass,
            &mut self.stiffness,
            &mut self.damping,
            &mut self.influence,
            &mut self.heights,
            &mut self.flexibility,
        ]
    }
}

/// Reads a NumPy archive.
///
/// # Errors
/// The problem in words.
pub(crate) fn read_archive(path: &Path) -> Result<Matrices, String> {
    npz::parse(&read(path)?)
}

/// Reads a Matrix Market file.
///
/// # Errors
/// The problem in words, with its line.
pub(crate) fn read_matrix_market(path: &Path) -> Result<Matrix, String> {
    let bytes = read(path)?;
    let text = std::str::from_utf8(&bytes).map_err(|_| "is not text".to_owned())?;
    matrix_market::parse(text)
}

fn read(path: &Path) -> Result<Vec<u8>, String> {
    let read = read_at_most(path, LARGEST);
    let bytes = read.map_err(|error| format!("cannot be read: {error}"))?;
    bytes.ok_or_else(|| format!("is larger than {} MiB", LARGEST >> 20))
}

/// An archive of arrays that `numpy.load` opens: name, sizes, and numbers row by row.
///
/// # Errors
/// None that writing to memory can have.
pub fn numpy_archive(arrays: &[(&str, &[usize], Vec<f64>)]) -> std::io::Result<Vec<u8>> {
    npz::write(arrays).map_err(std::io::Error::other)
}
