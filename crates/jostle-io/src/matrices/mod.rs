//! Matrices of buildings: NumPy archives and Matrix Market files.

mod matrix;
mod matrix_market;
mod npz;

pub(crate) use matrix::Matrix;

use crate::files::Files;

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
pub(crate) fn read_archive(files: &Files, name: &str) -> Result<Matrices, String> {
    npz::parse(&read(files, name)?)
}

/// Reads a Matrix Market file.
///
/// # Errors
/// The problem in words, with its line.
pub(crate) fn read_matrix_market(files: &Files, name: &str) -> Result<Matrix, String> {
    let bytes = read(files, name)?;
    let text = std::str::from_utf8(&bytes).map_err(|_| "is not text".to_owned())?;
    matrix_market::parse(text)
}

fn read(files: &Files, name: &str) -> Result<Vec<u8>, String> {
    files.read(name, LARGEST).map_err(|error| error.to_string())
}

/// An archive of arrays that `numpy.load` opens: name, sizes, and numbers row by row.
///
/// # Errors
/// None that writing to memory can have.
pub fn numpy_archive(arrays: &[(&str, &[usize], Vec<f64>)]) -> std::io::Result<Vec<u8>> {
    npz::write(arrays).map_err(std::io::Error::other)
}
