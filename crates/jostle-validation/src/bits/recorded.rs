//! The file of a family: results of its models, compressed.
//!
//! Paths come first, one a line. An empty line follows, then every model: `= NAME` and its values, one a line. A value is that
//! of the path after the path of the value before it; `@N` says that it is path N instead.

use std::collections::HashMap;
use std::io::{Read, Write};

use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;

use super::numbers::Entries;

/// Results of one model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Recorded {
    /// Model and solver.
    pub(super) name: String,
    /// Its paths and values.
    pub(super) entries: Entries,
}

/// The text of a file.
fn text(all: &[Recorded]) -> String {
    let mut places: HashMap<&str, usize> = HashMap::new();
    let mut paths = Vec::new();
    let mut values = String::new();
    for recorded in all {
        values += &format!("= {}\n", recorded.name);
        let mut next = 0;
        for (path, value) in &recorded.entries {
            let place = *places.entry(path).or_insert_with(|| {
                paths.push(path.as_str());
                paths.len() - 1
            });
            if place != next {
                values += &format!("@{place}\n");
            }
            values += value;
            values.push('\n');
            next = place + 1;
        }
    }
    format!("{}\n\n{values}", paths.join("\n"))
}

/// Results of a text; `None` if it is not one of ours.
fn parse(text: &str) -> Option<Vec<Recorded>> {
    let (paths, values) = text.split_once("\n\n")?;
    let paths: Vec<&str> = paths.lines().collect();
    let mut all: Vec<Recorded> = Vec::new();
    let mut next = 0;
    for line in values.lines() {
        if let Some(name) = line.strip_prefix("= ") {
            all.push(Recorded {
                name: name.to_owned(),
                entries: Vec::new(),
            });
            next = 0;
        } else if let Some(place) = line.strip_prefix('@') {
            next = place.parse().ok()?;
        } else {
            let path = paths.get(next)?;
            let entry = ((*path).to_owned(), line.to_owned());
            all.last_mut()?.entries.push(entry);
            next += 1;
        }
    }
    Some(all)
}

/// A file of results.
///
/// # Errors
/// Those of the compression.
pub(super) fn pack(all: &[Recorded]) -> std::io::Result<Vec<u8>> {
    let mut packed = GzEncoder::new(Vec::new(), Compression::best());
    packed.write_all(text(all).as_bytes())?;
    packed.finish()
}

/// Results of a file; `None` if it is not one of ours.
pub(super) fn unpack(bytes: &[u8]) -> Option<Vec<Recorded>> {
    let mut text = String::new();
    GzDecoder::new(bytes).read_to_string(&mut text).ok()?;
    parse(&text)
}

#[cfg(test)]
mod tests {
    use super::{Recorded, pack, unpack};

    #[test]
    fn files_give_back_what_was_recorded() {
        let recorded = |name: &str, entries: &[(&str, &str)]| Recorded {
            name: name.into(),
            entries: entries
                .iter()
                .map(|(path, value)| ((*path).into(), (*value).into()))
                .collect(),
        };
        let all = [
            recorded(
                "a modal",
                &[(".x", "0.1"), (".y[0]", "\"= a @ text\""), (".z", "-3e-7")],
            ),
            recorded("b", &[(".x", "null"), (".new", "17"), (".z", "2")]),
            recorded("nothing", &[]),
        ];
        let packed = pack(&all).expect("it is small");
        assert_eq!(unpack(&packed), Some(all.to_vec()));
        assert_eq!(unpack(&packed[1..]), None);
    }
}
