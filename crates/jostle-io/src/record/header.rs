//! Helpers for headers of `key: value` lines and for sentences with numbers.

use super::error::RecordError;
use super::formats::RecordFormat;
use crate::quantity::shorten;

/// An error in a line of a format.
pub(crate) fn malformed(
    format: RecordFormat,
    line: usize,
    problem: impl Into<String>,
) -> RecordError {
    RecordError::Malformed {
        format,
        line,
        problem: problem.into(),
    }
}

/// The values of a header by key, each with its line.
pub(crate) struct Header {
    format: RecordFormat,
    entries: Vec<(String, String, usize)>,
    /// Line of the header read last.
    pub(crate) last_line: usize,
}

impl Header {
    pub(crate) fn new(format: RecordFormat) -> Self {
        Self {
            format,
            entries: Vec::new(),
            last_line: 0,
        }
    }

    pub(crate) fn push(&mut self, line: usize, key: &str, value: &str) {
        self.last_line = line;
        self.entries
            .push((key.trim().to_owned(), value.trim().to_owned(), line));
    }

    pub(crate) fn len(&self) -> usize {
        self.entries.len()
    }

    /// The value of a key, with its line; nothing when absent or empty.
    pub(crate) fn find(&self, key: &str) -> Option<(&str, usize)> {
        self.entries
            .iter()
            .find(|(known, value, _)| known.eq_ignore_ascii_case(key) && !value.is_empty())
            .map(|(_, value, line)| (value.as_str(), *line))
    }

    /// The value of a key, or nothing.
    pub(crate) fn text(&self, key: &str) -> String {
        self.find(key)
            .map_or(String::new(), |(value, _)| value.to_owned())
    }

    /// The value of a key that must be there.
    pub(crate) fn need(&self, key: &str) -> Result<(&str, usize), RecordError> {
        self.find(key).ok_or_else(|| {
            let problem = format!("the header has no value for \"{key}\"");
            malformed(self.format, self.last_line, problem)
        })
    }

    /// A whole number that must be there.
    pub(crate) fn count(&self, key: &str) -> Result<(usize, usize), RecordError> {
        let (text, line) = self.need(key)?;
        let count = text
            .parse()
            .map_err(|_| self.bad(line, key, "a whole number", text))?;
        Ok((count, line))
    }

    /// A number greater than zero that must be there.
    pub(crate) fn positive(&self, key: &str) -> Result<(f64, usize), RecordError> {
        let (text, line) = self.need(key)?;
        let value = text
            .parse()
            .ok()
            .filter(|v: &f64| v.is_finite() && *v > 0.0);
        let value = value.ok_or_else(|| self.bad(line, key, "a number above zero", text))?;
        Ok((value, line))
    }

    /// An error on the value of a key.
    pub(crate) fn bad(&self, line: usize, key: &str, expected: &str, found: &str) -> RecordError {
        let found = shorten(found);
        malformed(
            self.format,
            line,
            format!("expected {expected} for \"{key}\", found \"{found}\""),
        )
    }
}

/// Refuses two statements of a header that contradict each other.
pub(crate) fn agree(
    format: RecordFormat,
    line: usize,
    what: &str,
    one: f64,
    other: f64,
    allowed: f64,
) -> Result<(), RecordError> {
    if (one - other).abs() <= allowed {
        return Ok(());
    }
    let problem = format!("the header contradicts itself about {what}: {one} and {other}");
    Err(malformed(format, line, problem))
}

/// The word after a phrase, ignoring case: `.005` after `equally spaced at` in a sentence.
pub(crate) fn word_after<'t>(text: &'t str, phrase: &str) -> Option<&'t str> {
    let at = find_phrase(text, phrase)?;
    let rest = text
        .get(at..)?
        .trim_start_matches(|c: char| c.is_whitespace() || matches!(c, '=' | ':'));
    rest.split([' ', '\t', ',', ';'])
        .next()
        .filter(|word| !word.is_empty())
}

/// End of a phrase of plain letters in a text, ignoring case; a blank matches any number of blanks.
pub(crate) fn find_phrase(text: &str, phrase: &str) -> Option<usize> {
    let mut start = 0;
    let words: Vec<_> = phrase.split_whitespace().collect();
    'next: while let Some(rest) = text.get(start..) {
        let first = words.first()?;
        let at = rest
            .char_indices()
            .map(|(at, _)| at)
            .find(|at| begins(&rest[*at..], first))?;
        let mut end = start + at + first.len();
        for word in &words[1..] {
            let gap = text[end..].len() - text[end..].trim_start().len();
            if gap == 0 || !begins(&text[end + gap..], word) {
                start += at + 1;
                while !text.is_char_boundary(start) {
                    start += 1;
                }
                continue 'next;
            }
            end += gap + word.len();
        }
        return Some(end);
    }
    None
}

fn begins(text: &str, word: &str) -> bool {
    text.get(..word.len())
        .is_some_and(|start| start.eq_ignore_ascii_case(word))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phrases_are_found_whatever_their_case_and_blanks() {
        let text = "É 12000 points of ACCEL  data equally spaced at  .005 sec, in cm/sec2.";
        assert_eq!(word_after(text, "equally spaced at"), Some(".005"));
        assert_eq!(
            word_after(text, "of accel data equally spaced at"),
            Some(".005")
        );
        assert_eq!(word_after("Max  =   .079 g", "max ="), Some(".079"));
        assert_eq!(word_after("Max = -.079 g", "max"), Some("-.079"));
        assert_eq!(word_after("Max", "max"), None);
        assert_eq!(word_after("é", "max"), None);
        assert_eq!(word_after("", ""), None);
    }
}
