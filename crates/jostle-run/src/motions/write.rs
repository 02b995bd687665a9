//! Motions as files.

use std::path::Path;

use jostle_io::{at2_text, csv_text, write_atomically};
use jostle_motion::Accelerogram;

use crate::error::RunError;
use crate::replace::may_write;

/// Writes a motion in the format of the file's extension.
///
/// Returns whether a file was replaced.
///
/// # Errors
/// [`RunError`] for another ending, for a file that must stay, or if it cannot be written.
pub fn write_motion(
    path: &Path,
    force: bool,
    name: &str,
    motion: &Accelerogram,
) -> Result<bool, RunError> {
    let extension = path
        .extension()
        .unwrap_or_default()
        .to_string_lossy()
        .to_lowercase();
    let text = match extension.as_str() {
        "at2" => at2_text(name, motion.step(), motion.acceleration()),
        "csv" => csv_text(name, motion.step(), motion.acceleration()),
        _ => {
            let shown = path.display();
            let problem =
                format!("{shown}: a motion is written as .at2 or .csv; give the file such a name");
            return Err(RunError::Argument(problem));
        }
    };
    let replaces = may_write(path, None, force)?;
    write_atomically(path, text.as_bytes())?;
    Ok(replaces)
}
