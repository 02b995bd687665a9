//! Damaged copies of a file in every format give an error or the right data, never wrong data in silence.
//!
//! Where a format has no redundancy at all (a digit of one value; the step of a file that states it once), nothing
//! can notice; these cases are listed. `JOSTLE_DAMAGE=full` flips every bit instead of two of each byte;
//! `JOSTLE_MUTATIONS=n` sets the number of random mutations per fixture.

use crate::fixture::{self, Fixture};
use crate::mutate::{Random, mutate};
use jostle_io::{Record, RecordContent, RecordLayout, RecordOptions, parse_record};

/// Values of the damaged files; enough for several lines and records.
const POINTS: usize = 100;

fn read(fixture: &Fixture, bytes: &[u8]) -> Result<Record, String> {
    parse_record(bytes, &fixture.options).map_err(|error| error.to_string())
}

fn undamaged(fixture: &Fixture) -> Record {
    read(fixture, &fixture.bytes).unwrap_or_else(|error| panic!("{}{error}", fixture.name))
}

/// What became of the data.
#[derive(Debug, PartialEq)]
enum Outcome {
    Refused,
    Right,
    /// One value is another one, which no format can notice unless it is the peak.
    OneValue,
    Wrong(String),
}

fn compare(right: &Record, found: &Result<Record, String>, timed: bool) -> Outcome {
    let Ok(found) = found else {
        return Outcome::Refused;
    };
    let numbers = right.acceleration.len();
    if found.acceleration.len() != numbers {
        return Outcome::Wrong(format!("{} values of {numbers}", found.acceleration.len()));
    }
    // Some formats repeat the step only by the time of their peak, which is trusted to one step.
    let shift_of_peak = (found.step - right.step).abs() * (0.6 * numbers as f64);
    let near_peak = timed && shift_of_peak <= 1.1 * right.step;
    if (found.step / right.step - 1.0).abs() > 1e-4 && !near_peak {
        return Outcome::Wrong(format!("step {} instead of {}", found.step, right.step));
    }
    let peak = right
        .acceleration
        .iter()
        .fold(0.0_f64, |m, a| m.max(a.abs()));
    // A factor can be wrong within the printed digits of the peak.
    let differs = |shift: f64| {
        let pairs = right.acceleration.iter().zip(&found.acceleration);
        pairs
            .filter(|(a, b)| (*a - *b - shift).abs() > 2e-5 * peak)
            .count()
    };
    // With another value, the mean that K-NET files are freed from moves all others.
    let shift = right.acceleration[0] - found.acceleration[0];
    let last = right.acceleration[numbers - 1] - found.acceleration[numbers - 1];
    match differs(0.0).min(differs(shift)).min(differs(last)) {
        0 => Outcome::Right,
        1 => Outcome::OneValue,
        count => Outcome::Wrong(format!("{count} values differ")),
    }
}

/// Headers that nothing else in the file repeats: a damaged digit of the step there is another step.
fn is_stated_once(fixture: &Fixture, at: usize) -> bool {
    let needle: &[u8] = match fixture.name {
        "at2" => b"DT=   .0050 SEC",
        "at2, count first" => b"    0.0100    NPTS",
        "one column" => b"# step = 0.01 s",
        "afad" => b"SAMPLING INTERVAL (sec) : 0.01",
        "simcenter" => b"\"dT\": 0.005",
        // Values that are not packed have neither a checksum nor a last value stated: nothing tells how many the
        // last record of the channel has, the fifth of six.
        "miniseed int32" | "miniseed int16" | "miniseed float32" | "miniseed float64" => {
            return (4 * 512 + 30..4 * 512 + 32).contains(&at);
        }
        _ => return false,
    };
    let found = fixture
        .bytes
        .windows(needle.len())
        .position(|part| part == needle);
    let start = found.unwrap_or_else(|| panic!("{} states its step", fixture.name));
    (start..start + needle.len()).contains(&at)
}

#[test]
fn a_flipped_bit_is_noticed_or_harmless() {
    let full = std::env::var("JOSTLE_DAMAGE").is_ok_and(|value| value == "full");
    for fixture in fixture::all(POINTS) {
        let right = undamaged(&fixture);
        let mut bytes = fixture.bytes.clone();
        let timed = ["smc", "cosmos", "csmip", "geonet", "esm"];
        let timed = timed.iter().any(|format| fixture.name.starts_with(format));
        let (mut tried, mut one_value, mut wrong) = (0, 0, Vec::new());
        for at in 0..bytes.len() {
            let bits = if full {
                (0..8).collect()
            } else {
                vec![at * 3 % 8]
            };
            for bit in bits {
                bytes[at] ^= 1 << bit;
                let outcome = compare(&right, &read(&fixture, &bytes), timed);
                bytes[at] ^= 1 << bit;
                tried += 1;
                match outcome {
                    Outcome::Refused | Outcome::Right => {}
                    Outcome::OneValue => one_value += 1,
                    Outcome::Wrong(_) if is_stated_once(&fixture, at) => {}
                    Outcome::Wrong(what) => {
                        let around = &bytes[at.saturating_sub(30)..(at + 10).min(bytes.len())];
                        let around = String::from_utf8_lossy(around).into_owned();
                        wrong.push(format!("bit {bit} of byte {at} behind {around:?}: {what}"));
                    }
                }
            }
        }
        assert!(wrong.is_empty(), "{}:\n{}", fixture.name, wrong.join("\n"));
        assert!(
            one_value < tried / 2,
            "{}: {one_value} of {tried}",
            fixture.name
        );
    }
}

#[test]
fn a_cut_file_is_refused_or_whole() {
    for fixture in fixture::all(POINTS) {
        let right = undamaged(&fixture);
        for length in 0..fixture.bytes.len() {
            let found = read(&fixture, &fixture.bytes[..length]);
            let what = match compare(&right, &found, false) {
                Outcome::Refused | Outcome::Right => continue,
                other => other,
            };
            // Between two values or records, a file without a count ends as it should.
            let count = found.as_ref().map_or(0, |record| record.acceleration.len());
            let shorter = Record {
                step: right.step,
                acceleration: right.acceleration[..count.min(right.acceleration.len())].to_vec(),
            };
            // Of the first rows nobody can tell how many digits are usual.
            let is_prefix = compare(&shorter, &found, false) == Outcome::Right || count <= 3;
            assert!(
                !fixture.counted && is_prefix,
                "{} cut to {length} bytes: {what:?}",
                fixture.name
            );
        }
    }
}

#[test]
fn line_ends_marks_and_encodings_do_not_matter() {
    for fixture in fixture::all(POINTS)
        .into_iter()
        .filter(|fixture| fixture.text)
    {
        let right = undamaged(&fixture);
        let text = String::from_utf8_lossy(&fixture.bytes).into_owned();
        let latin: Vec<u8> = text
            .chars()
            .map(|c| u8::try_from(u32::from(c)).unwrap_or(b'?'))
            .collect();
        let variants = [
            ("CRLF", text.replace('\n', "\r\n").into_bytes()),
            ("CR", text.replace('\n', "\r").into_bytes()),
            ("CRCRLF", text.replace('\n', "\r\r\n").into_bytes()),
            ("BOM", format!("\u{feff}{text}").into_bytes()),
            ("Latin-1", latin),
            ("no last line end", text.trim_end().as_bytes().to_vec()),
            ("blank lines behind", format!("{text}\n\n\n").into_bytes()),
            (
                "no blanks at line ends",
                text.lines()
                    .map(|line| line.trim_end().to_owned() + "\n")
                    .collect::<String>()
                    .into_bytes(),
            ),
        ];
        for (what, bytes) in variants {
            let found = read(&fixture, &bytes)
                .unwrap_or_else(|error| panic!("{}, {what}{error}", fixture.name));
            assert_eq!(found, right, "{}, {what}", fixture.name);
        }
    }
}

#[test]
fn wrong_and_huge_counts_are_refused() {
    // How every format states its number of values; 100 in the fixtures.
    for (name, stated) in [
        ("at2", "NPTS=   100"),
        ("at2, count first", "100    0.0100"),
        ("one column", "# points = 100"),
        ("knet", "Duration Time(s)  1\n"),
        ("kiknet", "Duration Time(s)  1\n"),
        ("esm", "NDATA: 100"),
        ("afad", "NUMBER OF DATA          : 100"),
        ("smc", "       100    -32768"),
        ("cosmos v2c", "     100 acceleration pts"),
        ("cosmos, two channels", "     100 acceleration pts"),
        ("csmip v2", " 100 points of accel"),
        ("csmip v2", " 100 points of displ"),
        ("csmip v2, 1983", " 100 POINTS OF ACCEL"),
        ("csmip v1", " 100 Accelerogram points"),
        ("csmip v1, film", "NO. OF POINTS =  100"),
        ("geonet v1a", "     100       0       0     100"),
        ("geonet v2a", "     100      25       0     100"),
    ] {
        let fixture = fixture::all(POINTS)
            .into_iter()
            .find(|fixture| fixture.name == name);
        let fixture = fixture.unwrap_or_else(|| panic!("no fixture {name}"));
        let text = String::from_utf8_lossy(&fixture.bytes).into_owned();
        assert!(text.contains(stated), "{name} states {stated:?}");
        let number = if stated.contains("100") { "100" } else { "1\n" };
        for other in [
            "099",
            "101",
            "000",
            "200",
            "-10",
            "1.5",
            "x00",
            "999",
            "9999999999999999999999",
            "1e9",
            "",
        ] {
            let wrong = if number == "1\n" {
                format!("{other}\n")
            } else {
                other.to_owned()
            };
            let wrong = stated.replace(number, &wrong);
            let bytes = text.replacen(stated, &wrong, 1).into_bytes();
            let info = allocation_counter::measure(|| {
                let found = read(&fixture, &bytes);
                assert!(
                    found.is_err(),
                    "{name} with {wrong:?}: {:?}",
                    found.map(|r| r.acceleration.len())
                );
            });
            assert!(
                info.bytes_max < 400_000,
                "{name} with {wrong:?}: {} bytes",
                info.bytes_max
            );
        }
    }
}

#[test]
fn what_is_no_number_is_refused() {
    for fixture in fixture::all(POINTS) {
        let name = fixture.name;
        if !fixture.text {
            continue;
        }
        // The last number of the file before any mark of its end.
        let text = String::from_utf8_lossy(&fixture.bytes).into_owned();
        let end = text
            .rfind(|c: char| c.is_ascii_digit() && !text.is_empty())
            .map_or(0, |at| at + 1);
        let data_end = text
            .rfind("/&")
            .or(text.rfind("End-of-data"))
            .unwrap_or(end);
        let data = text[..data_end].trim_end();
        let start = data.rfind([' ', ',', '\n']).map_or(0, |at| at + 1);
        for bad in [
            "nan", "NaN", "inf", "-inf", "1e999", "****", "0x10", "1.0.0", "--1", "",
        ] {
            let width = data.len() - start;
            let damaged = format!("{}{bad:>width$}{}", &text[..start], &text[data.len()..]);
            let found = read(&fixture, damaged.as_bytes());
            // Empty cells are seen where columns or counts are.
            assert!(
                found.is_err() || bad.is_empty() && !fixture.counted,
                "{name} with {bad:?}"
            );
        }
    }
    for name in [
        "sac little-endian",
        "sac big-endian",
        "miniseed float32",
        "miniseed float64",
    ] {
        let mut fixture = fixture::all(POINTS)
            .into_iter()
            .find(|f| f.name == name)
            .unwrap_or_else(|| panic!("{name}"));
        let length = fixture.bytes.len();
        let at = if name.starts_with("sac") {
            length - 400
        } else {
            64
        };
        for bits in [f64::NAN, f64::INFINITY] {
            let bytes = match name {
                "sac little-endian" => (bits as f32).to_le_bytes().to_vec(),
                "miniseed float64" => bits.to_be_bytes().to_vec(),
                _ => (bits as f32).to_be_bytes().to_vec(),
            };
            fixture.bytes[at..at + bytes.len()].copy_from_slice(&bytes);
            let found = read(&fixture, &fixture.bytes);
            assert!(found.is_err(), "{name} with {bits}");
        }
    }
}

#[test]
fn memory_stays_within_twice_the_file() {
    for fixture in fixture::all(20_000) {
        // Compressed files unfold to eight bytes per value.
        let values = fixture.acceleration.len();
        let compressed = fixture.name.contains("steim") || fixture.name.contains("int16");
        let allowed = if compressed {
            40 * values
        } else {
            2 * fixture.bytes.len()
        };
        let info = allocation_counter::measure(|| {
            let found = read(&fixture, &fixture.bytes);
            assert!(found.is_ok(), "{}: {:?}", fixture.name, found.err());
        });
        let taken = usize::try_from(info.bytes_max).unwrap_or(usize::MAX);
        assert!(
            taken <= allowed + 65_536,
            "{}: {taken} bytes for a file of {}",
            fixture.name,
            fixture.bytes.len()
        );
    }
}

/// Whatever is accepted is a record, also with options that complete what a damaged header has lost.
fn check(bytes: &[u8], options: &RecordOptions) {
    let completed = RecordOptions {
        unit: Some("gal".into()),
        step: Some(0.01),
        column: Some(2),
        scale: Some(1e-3),
        remove_mean: Some(true),
        ..RecordOptions::default()
    };
    let layout = if bytes.len().is_multiple_of(2) {
        RecordLayout {
            skip: Some(1),
            content: Some(RecordContent::Values),
            ..RecordLayout::default()
        }
    } else {
        RecordLayout {
            widths: vec![10],
            content: Some(RecordContent::Pairs),
            ..RecordLayout::default()
        }
    };
    let lines = RecordOptions {
        column: None,
        layout,
        ..completed.clone()
    };
    for options in [options, &completed, &lines] {
        match parse_record(bytes, options) {
            Ok(record) => {
                assert!((1e-6..=10.0).contains(&record.step), "step {}", record.step);
                assert!(record.acceleration.len() >= 2, "at least two values");
                assert!(
                    record.acceleration.iter().all(|a| a.abs() <= 100.0),
                    "possible values"
                );
            }
            Err(error) => assert!(error.to_string().starts_with(':'), "{error}"),
        }
    }
}

#[test]
fn mutated_files_never_panic() {
    let iterations = std::env::var("JOSTLE_MUTATIONS")
        .ok()
        .and_then(|n| n.parse().ok())
        .unwrap_or(60);
    let seed = std::env::var("JOSTLE_SEED")
        .ok()
        .and_then(|n| n.parse().ok())
        .unwrap_or(1);
    let mut random = Random::new(seed);
    let all = fixture::all(POINTS);
    for _ in 0..iterations {
        for fixture in &all {
            let other = &all[random.below(all.len())];
            let bytes = mutate(&fixture.bytes, &other.bytes, &mut random);
            let outcome = std::panic::catch_unwind(|| check(&bytes, &fixture.options));
            if outcome.is_err() {
                let path = std::env::temp_dir().join("jostle-mutated-record");
                std::fs::write(&path, &bytes).unwrap_or_else(|e| panic!("{e}"));
                panic!(
                    "a mutation of {} failed; it lies in {}",
                    fixture.name,
                    path.display()
                );
            }
        }
    }
    if iterations > 60 {
        let count = iterations * all.len();
        eprintln_done(count);
    }
}

#[allow(clippy::print_stderr, reason = "long campaigns say what they did")]
fn eprintln_done(count: usize) {
    eprintln!("{count} mutated files, each read three times");
}
