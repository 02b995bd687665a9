//! AFAD (Türkiye), the older text format: `KEY : value` lines, a row of directions, three columns of values.
//!
//! Layout as in the files of the national strong-motion network. The unit is that of the stated peaks, and the
//! values must have these peaks.

use crate::record::channel::Direction;
use crate::record::contents::{Contents, Peak, Scale, Trace, named_unit};
use crate::record::error::RecordError;
use crate::record::formats::RecordFormat;
use crate::record::header::{Header, malformed};
use crate::record::lines::{LineMap, Lines, check_end, number, printed};

const FORMAT: RecordFormat = RecordFormat::Afad;
const MOST_LINES: usize = 40;
const PEAKS: &str = "RAW PGA VALUES";

pub(crate) fn read(bytes: &[u8]) -> Result<Contents, RecordError> {
    let mut lines = Lines::new(bytes);
    let mut header = Header::new(FORMAT);
    let names = loop {
        let line = lines.next().filter(|line| line.number <= MOST_LINES);
        let Some(line) = line else {
            let problem = "no row of directions such as \"N-S  E-W  U-D\" above the values";
            return Err(malformed(FORMAT, header.last_line, problem));
        };
        if let Some((key, value)) = line.text.split_once(':') {
            header.push(line.number, key, value);
            continue;
        }
        let names: Vec<_> = line.text.split_whitespace().map(str::to_owned).collect();
        let known = |name: &String| Direction::parse(name) != Direction::Unknown;
        if (1..=3).contains(&names.len()) && names.iter().all(known) {
            break names;
        }
    };
    let (stated, stated_line) = header.count("NUMBER OF DATA")?;
    let (step, _) = header.positive("SAMPLING INTERVAL (sec)")?;
    let (unit, peaks) = read_peaks(&header, &names)?;

    let rows = stated.min(lines.lines_left());
    let mut columns: Vec<_> = names.iter().map(|_| Vec::with_capacity(rows)).collect();
    let mut map = LineMap::default();
    for line in lines {
        let found = line.text.split_whitespace().count();
        if found == 0 {
            continue;
        }
        if found != columns.len() {
            return Err(RecordError::Ragged {
                line: line.number,
                found,
                expected: columns.len(),
            });
        }
        for (column, text) in columns.iter_mut().zip(line.text.split_whitespace()) {
            column.push(number(line.number, text)?);
        }
        map.note(line.number, 1);
    }
    let found = columns.first().map_or(0, Vec::len);
    if found != stated {
        return Err(RecordError::Count {
            line: stated_line,
            stated,
            found,
        });
    }
    check_end(bytes)?;
    let mut contents = Contents::new(FORMAT, Scale::Stated);
    contents.station = header.text("STATION ID");
    contents.event = header.text("EARTHQUAKE DATE");
    contents.date = header.text("RECORD TIME");
    for ((name, values), peak) in names.into_iter().zip(columns).zip(peaks) {
        contents.traces.push(Trace {
            direction: Direction::parse(&name),
            name,
            unit: Some(unit.clone()),
            step: Some(step),
            values,
            lines: map.clone(),
            peak: Some(peak),
        });
    }
    Ok(contents)
}

/// `(N-S) 1.218825 (E-W) 1.207812 (U-D) 0.645862` below `RAW PGA VALUES (gal)`.
fn read_peaks(
    header: &Header,
    names: &[String],
) -> Result<((String, f64), Vec<Peak>), RecordError> {
    let key = ["gal", "mg", "g", "cm/s2"]
        .iter()
        .map(|unit| (format!("{PEAKS} ({unit})"), *unit))
        .find(|(key, _)| header.find(key).is_some());
    let Some((key, unit)) = key else {
        let problem = format!("no header line \"{PEAKS} (gal)\", which states the unit");
        return Err(malformed(FORMAT, header.last_line, problem));
    };
    let (text, line) = header.need(&key)?;
    let unit = match unit {
        "mg" => ("mg".to_owned(), 1e-3 * jostle::statics::STANDARD_GRAVITY),
        _ => named_unit(unit).ok_or_else(|| header.bad(line, &key, "a unit", unit))?,
    };
    let peak = |name: &String| {
        let after = text.split_once(&format!("({name})"))?.1;
        let (value, digit) = printed(after.split_whitespace().next()?)?;
        Some(Peak {
            value,
            digit,
            line,
            time: None,
        })
    };
    let bad = || header.bad(line, &key, "a peak for every direction", text);
    let peaks = names.iter().map(|name| peak(name).ok_or_else(bad));
    Ok((unit, peaks.collect::<Result<_, _>>()?))
}
