//! PEER AT2 records: a short header whose last line gives the number of values and the step, then values in
//! free format.

use crate::quantity::shorten;
use crate::record::RecordOptions;
use crate::record::channel::Direction;
use crate::record::contents::{Contents, Scale, Trace};
use crate::record::error::RecordError;
use crate::record::formats::{AT2_HEADER_LINES, RecordFormat};
use crate::record::lines::{LineMap, Lines, check_end, number};
use crate::record::units::{acceleration_unit, wrong_unit};
use crate::record::widths::{Widths, is_glued};

/// Reads a PEER AT2 record. Accelerations in g are converted with 9.80665 m/s².
///
/// # Errors
/// [`RecordError`] when the header cannot be understood or the number of values is another one.
pub(crate) fn read(bytes: &[u8], options: &RecordOptions) -> Result<Contents, RecordError> {
    let mut lines = Lines::new(bytes);
    let mut contents = Contents::new(RecordFormat::At2, Scale::Loose);
    let mut unit = None;
    let (header, stated, step) = loop {
        let no_header = RecordError::NoHeader {
            lines: AT2_HEADER_LINES,
        };
        let line = lines
            .next()
            .filter(|line| line.number <= AT2_HEADER_LINES)
            .ok_or(no_header)?;
        let content = line.text.trim();
        if content.to_ascii_uppercase().contains("NPTS") {
            let (stated, steps) = count_and_step(content).ok_or_else(|| RecordError::Header {
                line: line.number,
                found: shorten(content),
            })?;
            let step = match steps[..] {
                [step] => Some(step),
                // Options take precedence over the file.
                _ if options.step.is_some() => None,
                _ => {
                    return Err(RecordError::SeveralSteps {
                        line: line.number,
                        steps,
                    });
                }
            };
            break (line.number, stated, step);
        }
        if line.number == 2 {
            content.clone_into(&mut contents.event);
        }
        if unit.is_none() {
            unit = stated_unit(line.number, content)?;
        }
    };

    let widths = Widths::stated(&options.layout.widths);
    let (values, map) = match read_values(lines.clone(), stated, widths.as_ref(), options) {
        Err(_) if widths.is_none() && lines.clone().any(|line| is_glued(&line.text)) => {
            let data = lines.clone().filter(|line| !line.text.trim().is_empty());
            let shown = Widths::shown(data)?;
            read_values(lines, stated, Some(&shown), options)?
        }
        read => read?,
    };
    if values.len() != stated {
        return Err(RecordError::Count {
            line: header,
            stated,
            found: values.len(),
        });
    }
    check_end(bytes)?;
    contents.traces.push(Trace {
        name: String::new(),
        direction: Direction::Unknown,
        unit,
        step,
        values,
        lines: map,
        peak: None,
    });
    Ok(contents)
}

/// Reads values in free format, or in widths.
fn read_values(
    lines: Lines<'_>,
    stated: usize,
    widths: Option<&Widths>,
    options: &RecordOptions,
) -> Result<(Vec<f64>, LineMap), RecordError> {
    let mut values = Vec::with_capacity(stated.min(lines.bytes_left() / 8 + 1));
    let mut map = LineMap::default();
    for line in lines.filter(|line| !line.text.trim().is_empty()) {
        let before = values.len();
        match widths {
            Some(widths) => {
                let fields = widths
                    .fields(&line.text)
                    .ok_or_else(|| RecordError::Widths {
                        line: line.number,
                        widths: options.layout.widths.clone(),
                    });
                for field in fields? {
                    values.push(number(line.number, field)?);
                }
            }
            None => {
                for token in words(&line.text) {
                    values.push(number(line.number, token)?);
                }
            }
        }
        map.note(line.number, values.len() - before);
    }
    Ok((values, map))
}

/// Number of values and step from `NPTS= 4000, DT= .0100 SEC` or `4164 0.0100 NPTS, DT`. Damaged headers such as
/// `DT= 4 .0050 SEC` give several steps.
fn count_and_step(content: &str) -> Option<(usize, Vec<f64>)> {
    let upper = content.to_ascii_uppercase();
    let after = |key: &str| {
        let rest = upper.split_once(key)?.1.trim_start();
        Some(rest.strip_prefix(['=', ':'])?.trim_start())
    };
    let (counts, steps) = match (after("NPTS"), after("DT")) {
        (Some(counts), Some(steps)) => (counts, steps),
        _ => {
            let [count, step] = upper.trim_start().splitn(2, is_gap).collect::<Vec<_>>()[..] else {
                return None;
            };
            (count, step)
        }
    };
    // A few files print the count as a decimal number.
    let count = words(counts).next()?.trim_end_matches('.').parse().ok()?;
    let steps: Vec<f64> = words(steps)
        .map_while(|word| word.trim_end_matches("SEC").parse().ok())
        .collect();
    let good = |step: &f64| step.is_finite() && *step > 0.0;
    (!steps.is_empty() && steps.iter().all(good)).then_some((count, steps))
}

fn is_gap(c: char) -> bool {
    c.is_whitespace() || c == ','
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(is_gap).filter(|word| !word.is_empty())
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
    let size = acceleration_unit(word).ok_or_else(|| wrong_unit(line, word))?;
    let plain = word.trim_matches(|c: char| matches!(c, '.' | ',' | ';' | ':' | '(' | ')'));
    Ok(Some((plain.to_owned(), size)))
}
