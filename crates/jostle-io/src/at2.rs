//! PEER AT2 records: a short header whose last line gives the number of values and the step, then values in
//! free format.

use crate::quantity::shorten;
use crate::record::{
    Record, RecordError, RecordOptions, Series, acceleration_unit, number, numbered_lines,
    option_unit,
};

/// Lines in which the count and the step must stand.
const HEADER_LINES: usize = 12;

/// Whether one of the first lines speaks of NPTS.
pub(crate) fn is_at2(text: &str) -> bool {
    numbered_lines(text)
        .take(HEADER_LINES)
        .any(|(_, line)| line.to_ascii_uppercase().contains("NPTS"))
}

/// Reads a PEER AT2 record. Accelerations in g are converted with 9.80665 m/s².
///
/// # Errors
/// [`RecordError`] when the header cannot be understood or the number of values is another one.
pub(crate) fn parse_at2(text: &str, options: &RecordOptions) -> Result<Record, RecordError> {
    let mut lines = numbered_lines(text);
    let mut unit = None;
    let (header, stated, step) = loop {
        let no_header = RecordError::NoHeader {
            lines: HEADER_LINES,
        };
        let (line, content) = lines
            .next()
            .filter(|(line, _)| *line <= HEADER_LINES)
            .ok_or(no_header)?;
        if content.to_ascii_uppercase().contains("NPTS") {
            let (stated, step) = count_and_step(content).ok_or_else(|| RecordError::Header {
                line,
                found: shorten(content),
            })?;
            break (line, stated, step);
        }
        if unit.is_none() {
            unit = stated_unit(line, content)?;
        }
    };

    // What the user says explicitly comes before what the header says.
    unit = option_unit(options)?.or(unit);
    let mut series = Series {
        values: Vec::new(),
        lines: Vec::new(),
        unit,
    };
    for (line, content) in lines {
        for token in content.split(|c: char| c.is_whitespace() || c == ',') {
            if !token.is_empty() {
                series.values.push(number(line, token)?);
                series.lines.push(line);
            }
        }
    }
    if series.values.len() != stated {
        return Err(RecordError::Count {
            line: header,
            stated,
            found: series.values.len(),
        });
    }
    series.into_record(options.step.unwrap_or(step))
}

/// Number of values and step from `NPTS= 4000, DT= .0100 SEC` or `4164 0.0100 NPTS, DT`.
fn count_and_step(content: &str) -> Option<(usize, f64)> {
    let upper = content.to_ascii_uppercase();
    let after = |key: &str| {
        let rest = upper.split_once(key)?.1.trim_start();
        let rest = rest.strip_prefix(['=', ':'])?.trim_start();
        let token = rest.split(|c: char| c.is_whitespace() || c == ',').next()?;
        Some(token.to_owned())
    };
    let (count, step) = match (after("NPTS"), after("DT")) {
        (Some(count), Some(step)) => (count, step),
        _ => {
            let mut tokens = upper.split(|c: char| c.is_whitespace() || c == ',');
            let mut next = || tokens.by_ref().find(|token| !token.is_empty());
            (next()?.to_owned(), next()?.to_owned())
        }
    };
    // A few files print the count as a decimal number.
    let count = count.trim_end_matches('.').parse().ok()?;
    let step: f64 = step.trim_end_matches("SEC").parse().ok()?;
    (step.is_finite() && step > 0.0).then_some((count, step))
}

/// The unit of `… IN UNITS OF G. FILTER POINTS …` or `The units are (g)`.
fn stated_unit(line: usize, content: &str) -> Result<Option<(String, f64)>, RecordError> {
    let mut words = content.split_whitespace();
    let is_units = |word: &str| {
        let word = word.trim_matches(|c: char| !c.is_alphabetic());
        word.eq_ignore_ascii_case("unit") || word.eq_ignore_ascii_case("units")
    };
    if !words.by_ref().any(is_units) {
        return Ok(None);
    }
    let Some(word) = words.find(|word| {
        let word = word.to_ascii_uppercase();
        !matches!(word.as_str(), "OF" | "ARE" | "IS" | "IN" | "=" | ":")
    }) else {
        return Ok(None);
    };
    let size = acceleration_unit(word).ok_or_else(|| RecordError::Unit {
        line,
        found: shorten(word),
    })?;
    Ok(Some((word.to_owned(), size)))
}
