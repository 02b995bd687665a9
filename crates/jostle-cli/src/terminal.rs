//! The only place that prints: colours on a terminal, plain text elsewhere, and no complaint when a reader
//! of the output goes away.

use std::io::{IsTerminal, Write};

use anstyle::{AnsiColor, Style};

use crate::failure::Failure;

/// For headings.
pub(crate) const BOLD: Style = Style::new().bold();
/// For what may be overlooked.
pub(crate) const DIM: Style = Style::new().dimmed();
/// For what must not be overlooked.
pub(crate) const LOUD: Style = AnsiColor::Yellow.on_default().bold();
const ERROR: Style = AnsiColor::Red.on_default().bold();

/// Text in a style; plain when printed to a file or a pipe.
pub(crate) fn styled(style: Style, text: &str) -> String {
    format!("{style}{text}{style:#}")
}

/// Prints a text and a line break to standard output.
#[allow(
    clippy::unnecessary_wraps,
    reason = "commands that only print end with it"
)]
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    // A closed pipe, as of `head`, is not an error.
    let _ = writeln!(anstream::stdout().lock(), "{}", text.trim_end());
    Ok(())
}

/// Prints a remark to standard error.
pub(crate) fn remark(text: &str) {
    let _ = writeln!(anstream::stderr().lock(), "{text}");
}

/// Prints a warning to standard error.
pub(crate) fn warn(text: &str) {
    remark(&format!("{} {text}", styled(LOUD, "warning:")));
}

/// Prints an error to standard error.
pub(crate) fn error(text: &str) {
    remark(&format!("{} {}", styled(ERROR, "error:"), text.trim_end()));
}

/// Whether a person watches standard error.
pub(crate) fn is_watched() -> bool {
    std::io::stderr().is_terminal()
}
