//! Numbers that fill columns of a line without separators: widths that the user states, or that glued numbers show.

use super::error::RecordError;
use super::lines::{Line, number};
use crate::quantity::shorten;

/// Where the numbers of a line end.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Widths {
    /// As stated; numbers may stand anywhere within their width.
    Stated(Vec<usize>),
    /// As all lines show: ends of the numbers, at which every number must end.
    Shown(Vec<usize>),
}

impl Widths {
    /// Widths that the user states; none without.
    pub(crate) fn stated(widths: &[usize]) -> Option<Self> {
        (!widths.is_empty()).then(|| Self::Stated(widths.to_vec()))
    }

    /// The numbers of a line; `None` if it does not fit.
    pub(crate) fn fields<'t>(&self, line: &'t str) -> Option<Vec<&'t str>> {
        if !line.is_ascii() || line.contains('\t') {
            return None;
        }
        match self {
            Self::Stated(widths) => stated_fields(widths, line),
            Self::Shown(ends) => shown_fields(ends, line),
        }
    }

    /// Finds the widths of glued numbers: signs separate them, and all lines must agree on where numbers end.
    ///
    /// # Errors
    /// [`RecordError::Glued`] at the first line that does not agree.
    pub(crate) fn shown<'t>(
        lines: impl Iterator<Item = Line<'t>> + Clone,
    ) -> Result<Self, RecordError> {
        let mut ends: Vec<usize> = Vec::new();
        for line in lines.clone() {
            if let Some(found) = ends_of(&line.text)
                && found.len() > ends.len()
            {
                ends = found;
            }
        }
        let shown = Self::Shown(ends);
        let mut glued = lines.clone().filter(|line| is_glued(&line.text));
        for line in lines {
            let fields = shown.fields(&line.text).filter(|fields| !fields.is_empty());
            let fits = fields.is_some_and(|fields| {
                let mut fields = fields.iter();
                fields.all(|field| number(line.number, field).is_ok())
            });
            // Separated by signs, the same line must give the same numbers.
            let agrees = match (&shown, ends_of(&line.text)) {
                (Self::Shown(ends), Some(found)) => ends.starts_with(&found),
                (_, None) => true,
                (Self::Stated(_), _) => false,
            };
            if !fits || !agrees {
                let line = glued.next().unwrap_or(line);
                let found = line
                    .text
                    .split_whitespace()
                    .find(|word| number(0, word).is_err());
                return Err(RecordError::Glued {
                    line: line.number,
                    found: shorten(found.unwrap_or(line.text.trim())),
                    widths: shown.list(),
                });
            }
        }
        Ok(shown)
    }

    /// The widths, in one number if they are equal.
    fn list(&self) -> Vec<usize> {
        let widths: Vec<usize> = match self {
            Self::Stated(widths) => widths.clone(),
            Self::Shown(ends) => {
                let before = std::iter::once(&0).chain(ends);
                ends.iter()
                    .zip(before)
                    .map(|(end, before)| end - before)
                    .collect()
            }
        };
        match widths.first() {
            Some(first) if widths.iter().all(|width| width == first) => vec![*first],
            _ => widths,
        }
    }
}

fn stated_fields<'t>(widths: &[usize], line: &'t str) -> Option<Vec<&'t str>> {
    let repeats = widths.len() == 1;
    let mut fields = Vec::new();
    let mut rest = line;
    let mut at = 0;
    while !rest.trim().is_empty() {
        let width = *widths.get(if repeats { 0 } else { at })?;
        let (field, after) = rest.split_at(width.min(rest.len()));
        if field.trim().is_empty() {
            return None;
        }
        fields.push(field.trim());
        rest = after;
        at += 1;
    }
    Some(fields)
}

fn shown_fields<'t>(ends: &[usize], line: &'t str) -> Option<Vec<&'t str>> {
    let line = line.trim_end();
    let count = ends.iter().position(|end| *end == line.len())? + 1;
    let mut start = 0;
    let mut fields = Vec::with_capacity(count);
    for end in &ends[..count] {
        let field = &line[start..*end];
        if field.is_empty() || field.ends_with(' ') {
            return None;
        }
        fields.push(field.trim_start());
        start = *end;
    }
    Some(fields)
}

/// Ends of the numbers of a line that signs or blanks separate; `None` if some are no numbers.
fn ends_of(line: &str) -> Option<Vec<usize>> {
    let mut ends = Vec::new();
    let mut start = 0;
    for (at, c) in line.char_indices().chain([(line.len(), ' ')]) {
        let before = line[..at].chars().next_back();
        let is_glue =
            matches!(c, '-' | '+') && before.is_some_and(|c| c.is_ascii_digit() || c == '.');
        if !c.is_whitespace() && !is_glue {
            continue;
        }
        let piece = line[start..at].trim_start();
        if !piece.is_empty() {
            number(0, piece).ok()?;
            ends.push(at);
        }
        start = at;
    }
    (!ends.is_empty()).then_some(ends)
}

/// Whether a line of blanks and numbers has numbers without blanks between them.
pub(crate) fn is_glued(line: &str) -> bool {
    line.is_ascii()
        && !line.contains(['\t', ',', ';'])
        && ends_of(line).is_some_and(|ends| ends.len() > line.split_whitespace().count())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::lines::Lines;

    #[test]
    fn glued_numbers_show_their_widths() {
        let text = "-0.10-0.20 0.30\n 0.10 0.20-0.30\n10.0020.0030.00\n-0.50";
        let shown = Widths::shown(Lines::new(text.as_bytes())).expect("all lines agree");
        assert_eq!(shown.list(), [5]);
        assert_eq!(
            shown.fields("10.0020.0030.00"),
            Some(vec!["10.00", "20.00", "30.00"])
        );
        assert_eq!(shown.fields(" 1.0"), None);
        for other in [
            "0.10-0.20 0.30\n 0.100 0.20-0.30",
            "1.5-105\n 1.5E-06",
            "0.1-0.2\n****",
        ] {
            assert!(
                Widths::shown(Lines::new(other.as_bytes())).is_err(),
                "{other}"
            );
        }
    }

    #[test]
    fn stated_widths_cut_lines() {
        let eight = Widths::stated(&[4]).expect("a width");
        assert_eq!(
            eight.fields(" 0.1 0.20.30"),
            Some(vec!["0.1", "0.2", "0.30"])
        );
        assert_eq!(eight.fields("     0.2"), None);
        let pair = Widths::stated(&[3, 4]).expect("widths");
        assert_eq!(pair.fields("0.1 0.2"), Some(vec!["0.1", "0.2"]));
        assert_eq!(pair.fields("0.1 0.2 0.3"), None);
    }
}
