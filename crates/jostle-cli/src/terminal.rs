//! The only place that prints: colours on a terminal, plain text elsewhere, and no complaint when a reader
//! of the output goes away.

use std::io::{ErrorKind, IsTerminal, Write};

use anstyle::{AnsiColor, Style};
use jostle_io::{Input, in_shown_units};
use jostle_run::{LOUD, styled};

use crate::failure::Failure;

/// With what colours begin.
const ESCAPE: char = '\x1b';
const ERROR: Style = AnsiColor::Red.on_default().bold();

/// Prints a text and a line break to standard output.
///
/// # Errors
/// The text is lost, say because the disk is full. A reader that goes away, such as `head`, has what it wanted.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let text = text.trim_end();
    let written = if text.contains(ESCAPE) {
        let mut out = anstream::stdout().lock();
        writeln!(out, "{text}").and_then(|()| out.flush())
    } else {
        // Nothing to take out where colours are not wanted: the search for it takes longer than everything else in long output.
        let mut out = std::io::stdout().lock();
        writeln!(out, "{text}").and_then(|()| out.flush())
    };
    unless_gone(written)
}

/// What became of output to standard output: no error if the reader has gone away.
///
/// # Errors
/// The output is lost.
pub(crate) fn unless_gone(written: std::io::Result<()>) -> Result<(), Failure> {
    match written {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::Analysis(format!(
            "standard output cannot be written: {error}"
        ))),
        _ => Ok(()),
    }
}

/// Prints a remark to standard error.
pub(crate) fn remark(text: &str) {
    let _ = writeln!(anstream::stderr().lock(), "{text}");
}

/// Prints a warning to standard error.
pub(crate) fn warn(text: &str) {
    let text = in_shown_units(text);
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

/// Prints warnings about a model to standard error, one line each, with the lines of the file that they are about.
pub(crate) fn warn_of_model(input: &Input, warnings: &[String]) {
    for warning in warnings {
        warn(&input.with_line(warning));
    }
}

/// Prints warnings to standard error, one line each.
pub(crate) fn warn_all<'a>(warnings: impl IntoIterator<Item = &'a String>) {
    for warning in warnings {
        warn(warning);
    }
}
