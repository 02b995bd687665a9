//! The text of a file, and the line and column of a byte.

use std::ops::Range;

/// Remedy for a Windows path in a TOML string.
pub(crate) const BACKSLASH: &str = "a backslash inside \"…\" starts an escape; in a path write / instead, or put the path in single quotes: 'C:\\records\\a.at2'";

/// Bytes of the text that a value or key covers.
pub(crate) type Span = Range<usize>;

/// A named text with the starts of its lines.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    /// Name shown in messages, normally the path.
    pub(crate) name: String,
    text: String,
    line_starts: Vec<usize>,
}

/// Longest part of a line kept with a place \[characters\].
const WIDTH: usize = 120;

/// A position in a file: lines and columns count from 1, columns in characters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Line.
    pub line: usize,
    /// Column of the first character.
    pub column: usize,
    /// Characters covered on that line, from 1 to 120.
    pub length: usize,
    /// The line, or the part of a long line around the place.
    pub text: String,
    /// Characters of the line before `text` that are left out.
    pub skipped: usize,
}

impl Source {
    pub(crate) fn new(name: &str, text: &str) -> Self {
        let after_newlines = text.match_indices('\n').map(|(at, _)| at + 1);
        Self {
            name: name.to_owned(),
            text: text.to_owned(),
            line_starts: std::iter::once(0).chain(after_newlines).collect(),
        }
    }

    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    /// The place where a span begins.
    pub(crate) fn place(&self, span: &Span) -> Place {
        let start = self.boundary(span.start);
        let line = self.line_starts.partition_point(|first| *first <= start);
        let first = self.line_starts.get(line - 1).copied().unwrap_or(0);
        let rest = self.text.get(first..).unwrap_or("");
        let text = rest.split('\n').next().unwrap_or("").trim_end_matches('\r');
        let end = self.boundary(span.end).min(first + text.len());
        let before = self.text.get(first..start).unwrap_or("").chars().count();
        let covered = self.text.get(start..end.max(start)).unwrap_or("");
        let length = covered.chars().take(WIDTH).count().max(1);
        let skipped = if before + length.min(WIDTH / 2) > WIDTH {
            before.saturating_sub(WIDTH / 4)
        } else {
            0
        };
        Place {
            line,
            column: 1 + before,
            length,
            text: text.chars().skip(skipped).take(WIDTH).collect(),
            skipped,
        }
    }

    /// The nearest character boundary at or before a byte.
    fn boundary(&self, byte: usize) -> usize {
        let byte = byte.min(self.text.len());
        (0..=byte)
            .rev()
            .find(|at| self.text.is_char_boundary(*at))
            .unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_count_lines_and_characters_from_one() {
        let source = Source::new("x", "a = 1\r\nß = \"é é\"\n");
        let place = source.place(&(12..19));
        assert_eq!((place.line, place.column, place.length), (2, 5, 5));
        assert_eq!(place.text, "ß = \"é é\"");
        let end = source.place(&(999..1000));
        assert_eq!((end.line, end.column, end.length), (3, 1, 1));
    }
}
