//! Styles of words in texts for a terminal. The code that prints a text decides whether they are shown.

use anstyle::{AnsiColor, Style};

/// For headings.
pub const BOLD: Style = Style::new().bold();
/// For what may be overlooked.
pub const DIM: Style = Style::new().dimmed();
/// For what must not be overlooked.
pub const LOUD: Style = AnsiColor::Yellow.on_default().bold();

/// Text in a style.
#[must_use]
pub fn styled(style: Style, text: &str) -> String {
    format!("{style}{text}{style:#}")
}

/// A text without its styles.
#[must_use]
pub fn plain(text: &str) -> String {
    anstream::adapter::strip_str(text).to_string()
}
