//! Every number of a text record is in the record, or it is known why not: changing or deleting any single one changes
//! the record, or is refused.

use std::collections::BTreeSet;
use std::ops::Range;

use crate::fixture::{self, Fixture};
use crate::layouts::{burst, with};
use jostle_io::{Record, RecordContent, RecordOptions, parse_record};

/// Index of the value that differs most from another record of the same length.
fn most_changed(right: &Record, found: &Record) -> Option<usize> {
    if right.acceleration.len() != found.acceleration.len() || right.step != found.step {
        return None;
    }
    let changes = right.acceleration.iter().zip(&found.acceleration);
    let changes = changes.map(|(a, b)| (a - b).abs()).enumerate();
    let greatest = changes.max_by(|a, b| a.1.total_cmp(&b.1));
    greatest
        .filter(|(_, change)| *change > 0.0)
        .map(|(at, _)| at)
}

/// Places of a digit of every number: the third behind its point, so that no other value becomes the peak, else the
/// first, or the last one of a whole number.
fn digits(bytes: &[u8]) -> Vec<usize> {
    let digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
    let behind_point = (1..bytes.len()).filter(|at| bytes[at - 1] == b'.' && digit(*at));
    let third = |at: usize| if (at..at + 3).all(digit) { at + 2 } else { at };
    let is_part = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+');
    let mut places: Vec<usize> = behind_point.map(third).collect();
    let mut start = 0;
    for (at, byte) in bytes.iter().enumerate() {
        if !is_part(byte) {
            if at > start && !bytes[start..at].contains(&b'.') && digit(at - 1) {
                places.push(at - 1);
            }
            start = at + 1;
        }
    }
    places
}

fn other_digit(bytes: &[u8], at: usize) -> Vec<u8> {
    let mut changed = bytes.to_vec();
    changed[at] = b'0' + (changed[at] - b'0' + 5) % 10;
    changed
}

#[test]
fn every_value_of_every_format_is_one_number_of_the_file() {
    for fixture in fixture::all(100).into_iter().filter(|fixture| fixture.text) {
        let Fixture {
            name,
            bytes,
            options,
            ..
        } = &fixture;
        let read = |bytes: &[u8]| parse_record(bytes, options);
        let right = read(bytes).unwrap_or_else(|error| panic!("{name}{error}"));
        let mut seen = BTreeSet::new();
        let mut refused = 0;
        for at in digits(bytes) {
            match read(&other_digit(bytes, at)) {
                Ok(found) => seen.extend(most_changed(&right, &found)),
                Err(_) => refused += 1,
            }
        }
        let values = right.acceleration.len();
        let missing: Vec<_> = (0..values).filter(|at| !seen.contains(at)).collect();
        // A changed peak contradicts the header; interpolated film depends on two neighbours.
        assert!(
            missing.len() <= 2 && missing.len() <= refused,
            "{name}: no number changes the values {missing:?} alone"
        );
    }
}

/// A text, and the places of all its numbers that are data.
struct Layout {
    name: &'static str,
    text: String,
    options: RecordOptions,
    data: Vec<Range<usize>>,
}

/// Numbers of the lines from one on, in the columns asked for.
fn numbers(text: &str, first_line: usize, keep: impl Fn(usize) -> bool) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut start = 0;
    for (line, content) in text.split_inclusive('\n').enumerate() {
        let mut column = 0;
        let mut from = start;
        for word in content.split([' ', ',', ';', '\t', '\n', '"']) {
            if !word.is_empty() {
                if line + 1 >= first_line && keep(column) {
                    found.push(from..from + word.len());
                }
                column += 1;
            }
            from += word.len() + 1;
        }
        start += content.len();
    }
    found
}

fn layouts() -> Vec<Layout> {
    let values: Vec<f64> = burst()[103..163].to_vec();
    let rows = |row: &dyn Fn(usize, f64) -> String| -> String {
        values
            .iter()
            .enumerate()
            .map(|(i, a)| row(i, *a) + "\n")
            .collect()
    };
    let wrapped = |cell: &dyn Fn(usize, f64) -> String, per_line: usize| -> String {
        let cells: Vec<String> = values
            .iter()
            .enumerate()
            .map(|(i, a)| cell(i, *a))
            .collect();
        cells
            .chunks(per_line)
            .map(|line| line.concat() + "\n")
            .collect()
    };
    let t = |i: usize| 0.01 * i as f64;
    let any = |_: usize| true;
    let all = with(|options| {
        options.unit = Some("g".into());
        options.step = Some(0.01);
    });
    let untimed = with(|options| options.unit = Some("g".into()));
    let per_line = |count: usize| {
        let mut options = all.clone();
        options.layout.per_line = Some(count);
        options
    };
    let make = |name,
                text: String,
                first: usize,
                keep: &dyn Fn(usize) -> bool,
                options: &RecordOptions| Layout {
        name,
        data: numbers(&text, first, keep),
        text,
        options: options.clone(),
    };
    let mut pairs_stated = untimed.clone();
    pairs_stated.layout.content = Some(RecordContent::Pairs);
    let three = rows(&|i, a| format!("{:.3},{a:.5},{:.4}", t(i), 3.0 * a));
    let one = rows(&|_, a| format!("{a:.6}"));
    let eight = wrapped(&|_, a| format!(" {a:9.5}"), 8);
    let pairs = wrapped(&|i, a| format!(" {:9.3} {a:9.5}", t(i)), 4);
    vec![
        make("one column", one.clone(), 1, &any, &all),
        make(
            "one column with a title",
            format!("Burst\n{one}"),
            2,
            &any,
            &all,
        ),
        make(
            "count and step",
            format!("60 0.01\n{one}"),
            1,
            &any,
            &untimed,
        ),
        make(
            "count above step",
            format!("60\n0.01\n{one}"),
            1,
            &any,
            &untimed,
        ),
        make(
            "two columns",
            rows(&|i, a| format!("{:.3} {a:.6}", t(i))),
            1,
            &any,
            &untimed,
        ),
        make(
            "names and units",
            format!(
                "Time\tAcc\ns\tg\n{}",
                rows(&|i, a| format!("{:.3}\t{a:.6}", t(i)))
            ),
            3,
            &any,
            &RecordOptions::default(),
        ),
        make(
            "quotes",
            format!(
                "\"t (s)\",\"a (g)\"\n{}",
                rows(&|i, a| format!("\"{:.3}\",\"{a:.6}\"", t(i)))
            ),
            2,
            &any,
            &RecordOptions::default(),
        ),
        make(
            "three columns",
            format!("t (s),a (g),v (cm/s)\n{three}"),
            2,
            &|column| column < 2,
            &untimed,
        ),
        make("eight on a line", eight.clone(), 1, &any, &per_line(8)),
        make(
            "eight on a line, counted",
            format!("60 0.01\n{eight}"),
            1,
            &any,
            &untimed,
        ),
        make("pairs", pairs.clone(), 1, &any, &untimed),
        make("pairs as stated", pairs, 1, &any, &pairs_stated),
    ]
}

#[test]
fn every_number_of_every_layout_counts() {
    for Layout {
        name,
        text,
        options,
        data,
    } in layouts()
    {
        let bytes = text.as_bytes();
        let read = |bytes: &[u8]| parse_record(bytes, &options);
        let right = read(bytes).unwrap_or_else(|error| panic!("{name}{error}"));
        assert_eq!(right.acceleration.len(), 60, "{name}");
        for place in data {
            let number = &text[place.clone()];
            let differs = |what: &str, changed: &[u8]| {
                let found = read(changed);
                assert!(
                    found.as_ref().ok() != Some(&right),
                    "{name}: {what} {number:?} at byte {} changes nothing",
                    place.start
                );
            };
            let replaced = |with: &str| {
                let text = format!("{}{with}{}", &text[..place.start], &text[place.end..]);
                text.into_bytes()
            };
            let digit = place.clone().rev().find(|at| bytes[*at].is_ascii_digit());
            differs(
                "another digit of",
                &other_digit(bytes, digit.expect("a digit")),
            );
            differs("without", &replaced(""));
            for bad in ["NaN", "****", "x", "1.0.0", "-"] {
                let width = place.len();
                let found = read(&replaced(&format!("{bad:>width$}")));
                assert!(
                    found.is_err(),
                    "{name}: {bad} in place of {number:?} is read"
                );
            }
            // Without its whole line.
            let from = text[..place.start].rfind('\n').map_or(0, |at| at + 1);
            let to = text[place.end..]
                .find('\n')
                .map_or(text.len(), |at| place.end + at + 1);
            let line = format!("{}{}", &text[..from], &text[to..]);
            differs("without the line of", line.as_bytes());
        }
    }
}
