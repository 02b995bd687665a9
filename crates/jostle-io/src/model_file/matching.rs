//! `match` of `[motion]`: the spectrum that a motion is scaled to.

use jostle_motion::{MatchAt, TargetSpectrum};

use crate::files::Files;
use crate::keys::Section;
use crate::motion_spec::{MatchSpec, MatchTo};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};
use crate::target::{TargetError, TargetWords, read_target};
use crate::tree::Value;

pub(super) fn read(reader: &mut Reader<'_>, field: &Field<'_>, files: &Files) -> Option<MatchSpec> {
    let view = reader.open(field, &[Section::Match])?;
    let damping = match reader.get(&view, "damping") {
        Some(field) => {
            let damping = reader.quantity(&field, Dimension::Dimensionless)?;
            if !(0.0..1.0).contains(&damping) {
                reader.bad(
                    &field,
                    format!("must lie from 0 to below 1, found {damping}"),
                );
                return None;
            }
            damping
        }
        None => 0.05,
    };
    let (spectrum, value) = (reader.get(&view, "spectrum"), reader.get(&view, "value"));
    let to = match (spectrum, value) {
        (Some(_), Some(value)) => {
            *reader.bad(&value, "cannot be combined with spectrum") =
                Some("keep one of both".into());
            None
        }
        (Some(spectrum), None) => read_spectrum(reader, &spectrum, files).map(MatchTo::Spectrum),
        (None, Some(value)) => reader
            .positive(&value, Dimension::Acceleration)
            .map(MatchTo::Value),
        (None, None) => {
            let remedy = "add spectrum = { code = \"gb50011\", … }, a file, or value = \"3 m/s2\"";
            reader.missing(&view, "spectrum", remedy);
            None
        }
    };
    let at = place(reader, &view);
    Some(MatchSpec {
        to: to?,
        at: at?,
        damping,
    })
}

/// One period, or a range.
fn place(reader: &mut Reader<'_>, view: &View<'_>) -> Option<MatchAt> {
    match (reader.get(view, "at"), reader.get(view, "periods")) {
        (Some(_), Some(periods)) => {
            *reader.bad(&periods, "cannot be combined with at") = Some("keep one of both".into());
            None
        }
        (Some(at), None) => reader.positive(&at, Dimension::Time).map(MatchAt::Period),
        (None, Some(periods)) => {
            let entries = periods.entries().unwrap_or_default();
            let [first, last] = &entries[..] else {
                *reader.bad(
                    &periods,
                    "expected the first and the last period of a range",
                ) = Some("write periods = [\"0.2 s\", \"1.5 s\"]".into());
                return None;
            };
            let first = reader.positive(first, Dimension::Time)?;
            let last = reader.positive(last, Dimension::Time)?;
            if first >= last {
                reader.bad(&periods, "the first period must be the shorter one");
                return None;
            }
            Some(MatchAt::Range(first, last))
        }
        (None, None) => {
            reader.missing(
                view,
                "at",
                "add at = \"0.7 s\", or periods = [\"0.2 s\", \"1.5 s\"]",
            );
            None
        }
    }
}

/// A spectrum written out, or the file of one.
pub(crate) fn read_spectrum(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    files: &Files,
) -> Option<TargetSpectrum> {
    if let Some(name) = field.as_text() {
        return match read_target(files, name) {
            Ok(target) => Some(target),
            Err(error) => {
                reader.bad(field, error.to_string());
                None
            }
        };
    }
    let view = reader.open(field, &[Section::Spectrum])?;
    let quantities = [
        ("ag", Dimension::Acceleration),
        ("sds", Dimension::Acceleration),
        ("sd1", Dimension::Acceleration),
        ("tl", Dimension::Time),
        ("factor", Dimension::Dimensionless),
    ];
    for (key, dimension) in quantities {
        // Warns of what is unusual; the words below say what is wrong.
        if let Some(field) = reader.get(&view, key) {
            reader.quietly(|reader| reader.quantity(&field, dimension));
        }
    }
    let mut word = |key| {
        reader
            .get(&view, key)
            .and_then(|field| as_word(reader, &field))
    };
    let words = TargetWords {
        code: word("code"),
        intensity: word("intensity"),
        site: word("site"),
        group: word("group"),
        level: word("level"),
        kind: word("type"),
        ground: word("ground"),
        ag: word("ag"),
        sds: word("sds"),
        sd1: word("sd1"),
        tl: word("tl"),
        factor: word("factor"),
    };
    match words.target() {
        Ok(target) => Some(target),
        Err(TargetError::Word { key, problem }) => {
            match reader.get(&view, key) {
                Some(field) => *reader.bad(&field, problem) = None,
                None => reader.missing(&view, key, problem.trim_start_matches("is missing; ")),
            }
            None
        }
        Err(error) => {
            reader.bad(field, error.to_string());
            None
        }
    }
}

/// A text, or a number as text.
fn as_word(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<String> {
    match &field.node.value {
        Value::Text(text) => Some(text.clone()),
        Value::Integer(value) => Some(value.to_string()),
        Value::Number(value) => Some(value.to_string()),
        _ => reader.text(field),
    }
}
