//! miniSEED 2 and 3: records of one channel each, in any order of channels.
//!
//! Sources: SEED reference manual 2.4 (FDSN, IRIS, USGS, 2012), chapter 8; miniSEED 3 specification (FDSN, 2023).
//! Own code, because it must withstand damaged headers: circular chains of blockettes, lengths beyond the file,
//! counts beyond the data.

mod block;
mod crc32c;
mod steim;

use crate::quantity::shorten;
use crate::record::channel::Direction;
use crate::record::contents::{Contents, Scale, Trace};
use crate::record::error::RecordError;
use crate::record::formats::RecordFormat;
use crate::record::header::malformed;
use crate::record::lines::LineMap;

pub(crate) use block::is_miniseed;
use block::{Block, Encoding, Layout, is_version_2, is_version_3, version_2, version_3};

const FORMAT: RecordFormat = RecordFormat::MiniSeed;
const MOST_CHANNELS: usize = 256;

/// A channel as far as it has been read.
struct Run {
    source: String,
    date: String,
    rate: f64,
    layout: Layout,
    /// When the next value is due \[ns\].
    due: i128,
    /// Values in the whole file.
    count: usize,
    values: Vec<f64>,
}

pub(crate) fn read(bytes: &[u8]) -> Result<Contents, RecordError> {
    let mut runs: Vec<Run> = Vec::new();
    // The first pass counts, so that the second takes no more memory than it fills.
    for_each_block(bytes, |block| announce(&mut runs, &block))?;
    for_each_block(bytes, |block| append(&mut runs, &block))?;
    let mut contents = Contents::new(FORMAT, Scale::Counts);
    if let Some(first) = runs.first() {
        let station = first
            .source
            .rsplit_once('.')
            .map_or("", |(station, _)| station);
        station
            .trim_end_matches('.')
            .clone_into(&mut contents.station);
        contents.date.clone_from(&first.date);
    }
    for run in runs {
        let channel = run.source.rsplit('.').next().unwrap_or("");
        contents.traces.push(Trace {
            direction: Direction::of_channel_code(channel),
            name: run.source.clone(),
            unit: None,
            step: Some(1.0 / run.rate),
            values: run.values,
            lines: LineMap::default(),
            peak: None,
        });
    }
    if contents.traces.is_empty() {
        return Err(RecordError::TooFew { found: 0 });
    }
    short_names(&mut contents.traces);
    Ok(contents)
}

/// Visits every record that has values.
fn for_each_block<'b>(
    bytes: &'b [u8],
    mut visit: impl FnMut(Block<'b>) -> Result<(), String>,
) -> Result<(), RecordError> {
    let mut at = 0;
    while at < bytes.len() {
        let rest = &bytes[at..];
        // Some writers fill up the last block of a file.
        if rest.iter().all(|byte| *byte == 0) {
            break;
        }
        let bad = |problem: String| malformed(FORMAT, 0, format!("byte {at}: {problem}"));
        let block = if is_version_3(rest) {
            version_3(rest)
        } else if is_version_2(rest) {
            version_2(rest)
        } else {
            Err("no record begins here".to_owned())
        };
        let block = block.map_err(bad)?;
        let length = block.length;
        if block.count > 0 {
            visit(block).map_err(bad)?;
        }
        at += length;
    }
    Ok(())
}

/// With one station in the file, the channel code is name enough.
fn short_names(traces: &mut [Trace]) {
    let short = |name: &str| name.rsplit('.').next().unwrap_or("").to_owned();
    let mut names: Vec<_> = traces.iter().map(|trace| short(&trace.name)).collect();
    names.sort();
    names.dedup();
    if names.len() == traces.len() {
        traces
            .iter_mut()
            .for_each(|trace| trace.name = short(&trace.name));
    }
}

/// Counts the values of a record for its channel.
fn announce(runs: &mut Vec<Run>, block: &Block<'_>) -> Result<(), String> {
    // A frame of 64 bytes holds at most 105 values, a byte at most one half.
    if block.count > block.data.len() / 64 * 105 && block.count > block.data.len() / 2 {
        return Err("the record is too short for its number of values".into());
    }
    if let Some(run) = runs.iter_mut().find(|run| run.source == block.source) {
        run.count += block.count;
        return Ok(());
    }
    if runs.len() == MOST_CHANNELS {
        return Err(format!("more than {MOST_CHANNELS} channels"));
    }
    runs.push(Run {
        source: block.source.clone(),
        date: block.date.clone(),
        rate: block.rate,
        layout: block.layout(),
        due: block.start,
        count: block.count,
        values: Vec::new(),
    });
    Ok(())
}

/// Adds the values of a record to its channel, which they must continue.
fn append(runs: &mut [Run], block: &Block<'_>) -> Result<(), String> {
    let Some(run) = runs.iter_mut().find(|run| run.source == block.source) else {
        return Ok(());
    };
    if (run.rate - block.rate).abs() > 1e-4 * run.rate {
        return Err(format!(
            "the sampling rate changes from {} to {} Hz",
            run.rate, block.rate
        ));
    }
    if run.layout != block.layout() {
        return Err("length, encoding, byte order or start of the data differ from the records before; if that is no damage, write the file anew with equal records".into());
    }
    let period = 1e9 / run.rate;
    let late = (block.start - run.due) as f64;
    if late.abs() > 0.5 * period {
        let what = if late > 0.0 { "a gap" } else { "an overlap" };
        let source = shorten(&run.source);
        return Err(format!(
            "{what} of {} s in {source} before this record",
            1e-9 * late.abs()
        ));
    }
    if run.values.is_empty() {
        run.values.reserve_exact(run.count);
    }
    decode(block, &mut run.values)?;
    run.due = block.start + (block.count as f64 * period).round() as i128;
    Ok(())
}

fn decode(block: &Block<'_>, values: &mut Vec<f64>) -> Result<(), String> {
    let width = match block.encoding {
        Encoding::Steim1 | Encoding::Steim2 => {
            let second = block.encoding == Encoding::Steim2;
            return steim::decode(block.data, block.count, block.big_endian, second, values)
                .map_err(str::to_owned);
        }
        Encoding::Int16 => 2,
        Encoding::Int32 | Encoding::Float32 => 4,
        Encoding::Float64 => 8,
    };
    let data = block
        .count
        .checked_mul(width)
        .and_then(|length| block.data.get(..length));
    let data = data.ok_or("the record is too short for its number of values")?;
    for item in data.chunks_exact(width) {
        let mut bytes = [0; 8];
        for (to, from) in bytes[8 - width..].iter_mut().zip(item) {
            *to = *from;
        }
        if !block.big_endian {
            bytes[8 - width..].reverse();
        }
        let word = u64::from_be_bytes(bytes);
        let value = match block.encoding {
            Encoding::Int16 => f64::from((word as u16).cast_signed()),
            Encoding::Float32 => f64::from(f32::from_bits(word as u32)),
            Encoding::Float64 => f64::from_bits(word),
            _ => f64::from((word as u32).cast_signed()),
        };
        if !value.is_finite() {
            return Err("a value is not a number".into());
        }
        values.push(value);
    }
    Ok(())
}
