//! GeoNet (New Zealand) V1A and V2A: for every component 16 lines of text, 40 integers, 60 reals, then
//! accelerations in mm/s², and in V2A velocities and displacements.
//!
//! Layout: Cousins (2008), "GNS accelerogram data files: standard format", GNS Science.

use crate::record::channel::Direction;
use crate::record::contents::{Contents, Peak, Scale, Trace, named_unit};
use crate::record::error::RecordError;
use crate::record::fixed::Fixed;
use crate::record::formats::RecordFormat;
use crate::record::header::{agree, find_phrase, malformed, word_after};
use crate::record::lines::{Lines, printed};

const FORMAT: RecordFormat = RecordFormat::GeoNet;
const TEXT_LINES: usize = 16;
/// From this value on, numbers are printed without decimals, as six characters must do \[mm/s²\].
const WHOLE_FROM: f64 = 1e4;
const REALS: Fixed = Fixed::reals(10, 8).whole_from(WHOLE_FROM);
/// Channels at most.
const MOST_CHANNELS: usize = 64;

pub(crate) fn read(bytes: &[u8]) -> Result<Contents, RecordError> {
    let mut lines = Lines::new(bytes);
    let mut contents = Contents::new(FORMAT, Scale::Stated);
    while let Some(text) = text_lines(&mut lines)? {
        if contents.traces.len() == MOST_CHANNELS {
            let problem = format!("more than {MOST_CHANNELS} components");
            return Err(malformed(FORMAT, lines.number(), problem));
        }
        if contents.traces.is_empty() {
            contents.station =
                format!("{} {}", word_after(&text[1], "site").unwrap_or(""), text[2]);
            contents.event.clone_from(&text[6]);
            contents.date.clone_from(&text[7]);
        }
        let trace = component(&mut lines, &text)?;
        contents.traces.push(trace);
    }
    Ok(contents)
}

/// The text of the next component; nothing at the end of the file.
fn text_lines(lines: &mut Lines<'_>) -> Result<Option<Vec<String>>, RecordError> {
    let text: Vec<_> = lines
        .by_ref()
        .skip_while(|line| line.text.is_empty())
        .take(TEXT_LINES)
        .map(|line| line.text.trim().to_owned())
        .collect();
    let Some(first) = text.first() else {
        return Ok(None);
    };
    let number = lines.number() + 1 - text.len();
    if find_phrase(first, "corrected accelerogram").is_none()
        && find_phrase(first, "uncorrected accelerogram").is_none()
    {
        let problem = "expected the first line of a component, \"Corrected accelerogram …\"";
        return Err(malformed(FORMAT, number, problem));
    }
    if text.len() < TEXT_LINES {
        return Err(malformed(
            FORMAT,
            lines.number(),
            "the file ends in its lines of text",
        ));
    }
    Ok(Some(text))
}

fn component(lines: &mut Lines<'_>, text: &[String]) -> Result<Trace, RecordError> {
    let first = lines.number() + 1 - TEXT_LINES;
    let integers = Fixed::integers(10, 8).read(lines, 40, FORMAT)?.values;
    let reals_line = lines.number() + 1;
    let reals = REALS.read(lines, 60, FORMAT)?.values;
    let counts = [integers[33], integers[34], integers[35]];
    if counts.iter().any(|count| !(0.0..1e9).contains(count)) {
        let problem = "integers 34 to 36 are no numbers of samples";
        return Err(malformed(FORMAT, reals_line - 1, problem));
    }
    let step = reals[25];
    check_text(text, first, step, counts[0])?;

    let block = REALS.read(lines, counts[0] as usize, FORMAT)?;
    // Velocities and displacements are only checked to be there.
    for count in &counts[1..] {
        REALS.read(lines, *count as usize, FORMAT)?;
    }
    let line = first + 13;
    let peak = find_phrase(&text[13], "acceleration:")
        .and_then(|_| word_after(&text[13], "peak"))
        .and_then(printed)
        .map(|(value, digit)| Peak {
            value,
            digit: if value.abs() < WHOLE_FROM {
                digit
            } else {
                // Rounded to whole numbers.
                digit + 0.5
            },
            line,
            // Times leave out what was put before the record for filtering.
            time: word_after(&text[13], "at")
                .and_then(printed)
                .map(|(time, digit)| (time + reals[21].max(0.0), digit)),
        });
    let peak =
        peak.ok_or_else(|| malformed(FORMAT, line, "expected \"Acceleration: peak … mm/s/s\""))?;
    let name = word_after(&text[12], "component").unwrap_or("").to_owned();
    Ok(Trace {
        direction: Direction::parse(&name),
        name,
        unit: named_unit("mm/s2"),
        step: Some(step),
        values: block.values,
        lines: block.lines,
        peak: Some(peak),
    })
}

/// Checks step, number, length and unit in the text against the numbers of the header.
fn check_text(text: &[String], first: usize, step: f64, count: f64) -> Result<(), RecordError> {
    let number = |line: usize, phrase: &str| {
        let value = word_after(&text[line], phrase)?.parse::<f64>().ok()?;
        value.is_finite().then_some(value)
    };
    let stated = number(10, "intervals of").or_else(|| number(10, "data at"));
    let Some(stated) = stated else {
        let problem = "expected the time step, as in \"data at 0.020 sec intervals\"";
        return Err(malformed(FORMAT, first + 10, problem));
    };
    agree(
        FORMAT,
        first + 10,
        "the time step",
        stated,
        step,
        1e-4 * step,
    )?;
    let Some(stated) = number(9, "number of points") else {
        return Err(malformed(
            FORMAT,
            first + 9,
            "expected \"Number of points\"",
        ));
    };
    agree(
        FORMAT,
        first + 9,
        "the number of values",
        stated,
        count,
        0.0,
    )?;
    if let Some(duration) = number(9, "duration") {
        let allowed = 1.01 * step + 0.01;
        agree(
            FORMAT,
            first + 9,
            "the duration",
            duration,
            count * step,
            allowed,
        )?;
    }
    if find_phrase(&text[13], "mm/s/s").is_none() {
        let problem = "expected accelerations in mm/s/s";
        return Err(malformed(FORMAT, first + 13, problem));
    }
    Ok(())
}
