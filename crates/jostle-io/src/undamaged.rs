//! Readers of other libraries that end the program where a file is damaged.

use std::fmt::Display;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// What a reader says; where it panics instead, that the file is damaged. The reader of Parquet does so for some files whose
/// pages are not what their heads say.
///
/// # Errors
/// The reader's own, or that the file is damaged.
pub fn undamaged<T, E: Display>(read: impl FnOnce() -> Result<T, E>) -> Result<T, String> {
    match catch_unwind(AssertUnwindSafe(read)) {
        Ok(read) => read.map_err(|error| error.to_string()),
        Err(_) => {
            Err("is damaged: its pages are not what their heads say; write it again".to_owned())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::undamaged;

    #[test]
    fn a_reader_that_panics_says_that_the_file_is_damaged() {
        let read = |pages: &[u8], at: usize| undamaged(|| Ok::<u8, String>(pages[at]));
        assert_eq!(read(&[7, 8], 1), Ok(8));
        let problem = read(&[7, 8], 2).expect_err("beyond the page");
        assert!(problem.contains("damaged"), "{problem}");
        let problem = undamaged(|| Err::<u8, _>("no such page")).expect_err("its own");
        assert_eq!(problem, "no such page");
    }
}
