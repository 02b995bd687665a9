//! `[motion]`: a record or an analytic wave, and its scaling.

use jostle_motion::GoverningRule;

use super::{grounds, matching};
use crate::files::Files;
use crate::keys::{RECORD_CONTENTS, RECORD_FORMATS, Section, WAVES};
use crate::motion_spec::{BearingSpec, MotionSource, MotionSpec, OwnMotionSpec, Scaling};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};
use crate::record::{
    RecordContent, RecordError, RecordFormat, RecordLayout, RecordOptions, acceleration_unit,
};
use crate::tree::Value;

/// Keys about a record file.
pub(super) const RECORD_KEYS: &[&str] = &[
    "unit",
    "step",
    "column",
    "component",
    "record_scale",
    "remove_mean",
    "format",
    "read",
];

/// Longest analysis \[s\].
const LONGEST: f64 = 10_000.0;

pub(crate) fn read(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    files: &Files,
) -> Option<MotionSpec> {
    read_in(reader, field, files, &[Section::Motion])
}

/// Reads a motion from a table that may have the keys of other sections too.
pub(crate) fn read_in(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    files: &Files,
    sections: &'static [Section],
) -> Option<MotionSpec> {
    let view = reader.open(field, sections)?;
    let duration = reader
        .get(&view, "duration")
        .and_then(|field| duration(reader, &field));
    let source = if view.has("record") || view.has("kind") {
        let source = source(reader, &view, files);
        if matches!(source, Some(MotionSource::Sine { .. })) && !view.has("duration") {
            reader.missing(
                &view,
                "duration",
                "say how long the sine lasts: duration = \"8 s\"",
            );
        }
        source
    } else {
        reader.missing(
            &view,
            "record",
            "add record = \"el-centro-1940-ns\", a path to a record, or kind = \"sine\"",
        );
        None
    };
    let bearing = bearing(reader, &view, files);
    let grounds = grounds::read_common(reader, &view, files);
    let across = bearing.as_ref().and_then(|bearing| bearing.across.as_ref());
    let vertical = grounds.as_ref().and_then(|ground| ground.vertical.as_ref());
    let components = [
        ("across", across.map(|spec| &spec.source)),
        (
            "vertical",
            vertical.and_then(|vertical| vertical.source.as_ref()),
        ),
    ];
    let records = source.as_ref().map_or(1, MotionSource::count);
    for (key, component) in components {
        check_count(reader, &view, key, component, records);
    }
    let scaling = scaling(reader, &view, files, records);
    let reverse = reader
        .get(&view, "reverse")
        .and_then(|field| reader.flag(&field));
    Some(MotionSpec {
        source: source?,
        scaling,
        reverse: reverse.unwrap_or(false),
        duration,
        bearing,
        grounds,
    })
}

/// A motion beside the common one, from a table that need not name a source.
pub(super) fn read_own(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    files: &Files,
) -> Option<OwnMotionSpec> {
    let source = if view.has("record") || view.has("kind") {
        Some(source(reader, view, files)?)
    } else {
        let keys = ["amplitude", "period", "centre"];
        refuse(reader, view, &keys, "the record of [motion]");
        refuse(reader, view, RECORD_KEYS, "the record of [motion]");
        None
    };
    let scaling = scaling(reader, view, files, 1);
    let reverse = reader
        .get(view, "reverse")
        .and_then(|field| reader.flag(&field));
    Some(OwnMotionSpec {
        source,
        scaling,
        reverse: reverse.unwrap_or(false),
    })
}

/// The record or wave of a table that has one.
fn source(reader: &mut Reader<'_>, view: &View<'_>, files: &Files) -> Option<MotionSource> {
    let record = reader.get(view, "record");
    let wave = reader.get(view, "kind");
    match (&record, &wave) {
        (Some(_), Some(wave)) => {
            *reader.bad(wave, "cannot be combined with record") =
                Some("keep either record or kind".into());
            None
        }
        (Some(record), None) => {
            refuse(reader, view, &["amplitude", "period", "centre"], "a record");
            read_record(reader, view, record, files)
        }
        (None, Some(wave)) => {
            refuse(reader, view, RECORD_KEYS, "an analytic wave");
            read_wave(reader, view, wave)
        }
        (None, None) => None,
    }
}

/// The rule for the governing value of several records, if the file names one; a single record has no use for it.
pub(super) fn governing(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<GoverningRule> {
    let view = reader.reopen(field, &[Section::Motion])?;
    let named = reader.get(&view, "governing")?;
    let name = reader.choice(&named, &GoverningRule::NAMES, &[])?;
    GoverningRule::from_name(name)
}

/// `angle` and `across`, if one of them is there.
fn bearing(reader: &mut Reader<'_>, view: &View<'_>, files: &Files) -> Option<Box<BearingSpec>> {
    let angle = reader
        .get(view, "angle")
        .and_then(|field| reader.quantity(&field, Dimension::Dimensionless));
    let across = reader.get(view, "across");
    let across = across.and_then(|field| match is_named(&field) {
        true => Some(MotionSpec {
            source: named(reader, &field, files)?,
            ..MotionSpec::record("")
        }),
        false => {
            let spec = read(reader, &field, files)?;
            if spec.bearing.is_some() {
                *reader.bad(&field, "has an angle or a motion across of its own") =
                    Some("give them under [motion] only".into());
            }
            if spec.grounds.is_some() {
                *reader.bad(&field, "says how grounds differ") =
                    Some("say it under [motion] only".into());
            }
            Some(spec)
        }
    });
    if angle.is_none() && across.is_none() {
        return None;
    }
    Some(Box::new(BearingSpec {
        angle: angle.unwrap_or(0.0),
        across,
    }))
}

/// Whether a component is a record, or a list of records, rather than a table.
pub(super) fn is_named(field: &Field<'_>) -> bool {
    field.as_text().is_some() || field.entries().is_some()
}

/// A record by its name, or several of a list, without further data.
pub(super) fn named(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    files: &Files,
) -> Option<MotionSource> {
    let names = record_names(reader, field)?;
    let options = RecordOptions::default();
    Some(MotionSource::of_records(names, files.clone(), options))
}

/// The ground under one building has one record.
pub(super) fn refuse_several(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    key: &'static str,
    spec: Option<&OwnMotionSpec>,
) {
    let count = spec
        .and_then(|spec| spec.source.as_ref())
        .map_or(1, MotionSource::count);
    if count > 1
        && let Some(field) = reader.get(view, key)
    {
        *reader.bad(&field, "must be one record here") =
            Some("only [motion] may list several".into());
    }
}

/// A list of components goes with as many records, in their order.
fn check_count(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    key: &'static str,
    component: Option<&MotionSource>,
    records: usize,
) {
    let count = component.map_or(1, MotionSource::count);
    if count > 1
        && count != records
        && let Some(field) = reader.get(view, key)
    {
        let problem = format!(
            "lists {count} motions for {}",
            match records {
                1 => "one record".to_owned(),
                several => format!("{several} records"),
            }
        );
        *reader.bad(&field, problem) =
            Some("list one for every entry of record, in the same order".into());
    }
}

fn duration(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<f64> {
    let duration = reader.positive(field, Dimension::Time)?;
    if duration > LONGEST {
        reader.bad(
            field,
            format!("must be at most {LONGEST} s, found {duration} s"),
        );
        return None;
    }
    Some(duration)
}

/// Notes keys that do not go with the source.
fn refuse(reader: &mut Reader<'_>, view: &View<'_>, keys: &[&'static str], source: &str) {
    for key in keys {
        if let Some(field) = reader.get(view, key) {
            *reader.bad(&field, format!("does not go with {source}")) =
                Some(format!("remove {key}"));
        }
    }
}

fn read_record(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    record: &Field<'_>,
    files: &Files,
) -> Option<MotionSource> {
    let names = record_names(reader, record)?;
    let mut options = RecordOptions::default();
    if let Some(field) = reader.get(view, "unit") {
        options.unit = reader.text(&field);
        if options
            .unit
            .as_deref()
            .is_some_and(|unit| acceleration_unit(unit).is_none())
        {
            let found = field.node.describe();
            reader.bad(
                &field,
                format!(
                    "expected a unit of acceleration such as \"g\" or \"cm/s2\", found {found}"
                ),
            );
        }
    }
    if let Some(field) = reader.get(view, "step") {
        options.step = reader.positive(&field, Dimension::Time);
    }
    if let Some(field) = reader.get(view, "column") {
        options.column = reader.count(&field);
        if options.column == Some(0) {
            reader.bad(&field, "columns count from 1");
        }
    }
    if let Some(field) = reader.get(view, "component") {
        options.component = component(reader, &field);
    }
    if let Some(field) = reader.get(view, "record_scale") {
        options.scale = reader.quantity(&field, Dimension::Dimensionless);
        if options.scale == Some(0.0) {
            reader.bad(&field, "must not be zero");
        }
    }
    if let Some(field) = reader.get(view, "remove_mean") {
        options.remove_mean = reader.flag(&field);
    }
    if let Some(field) = reader.get(view, "format") {
        let key = reader.choice(&field, RECORD_FORMATS, &[]);
        options.format = key.and_then(|key| RecordFormat::from_key(key).ok());
    }
    if let Some(field) = reader.get(view, "read") {
        options.layout = read_layout(reader, &field).unwrap_or_default();
    }
    let files = files.clone();
    Some(MotionSource::of_records(names, files.clone(), options))
}

/// How the lines of the file are read.
fn read_layout(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<RecordLayout> {
    let view = reader.open(field, &[Section::Read])?;
    let mut count = |key| {
        let field = reader.get(&view, key)?;
        reader.count(&field)
    };
    let (skip, last, per_line) = (count("skip"), count("last"), count("per_line"));
    let content = reader.get(&view, "content").and_then(|field| {
        let key = reader.choice(&field, RECORD_CONTENTS, &[])?;
        RecordContent::from_key(key)
    });
    let widths = reader.get(&view, "widths").map(|field| {
        let entries = field.entries().unwrap_or_else(|| vec![field.clone()]);
        let widths = entries.iter().map(|entry| reader.count(entry));
        let widths: Option<Vec<usize>> = widths.collect();
        widths.unwrap_or_default()
    });
    let layout = RecordLayout {
        skip,
        last,
        per_line,
        content,
        widths: widths.unwrap_or_default(),
    };
    if let Err(RecordError::Layout { problem }) = layout.check() {
        reader.bad(field, problem);
        return None;
    }
    Some(layout)
}

/// One name or a list of them, none empty, none twice.
fn record_names(reader: &mut Reader<'_>, record: &Field<'_>) -> Option<Vec<String>> {
    let entries = match record.entries() {
        Some(entries) if entries.is_empty() => {
            *reader.bad(record, "is an empty list") =
                Some("name a record, such as \"el-centro-1940-ns\"".into());
            return None;
        }
        Some(entries) => entries,
        None => vec![record.clone()],
    };
    let mut names: Vec<String> = Vec::new();
    let mut good = true;
    for entry in &entries {
        let Some(name) = reader.text(entry) else {
            good = false;
            continue;
        };
        if name.trim().is_empty() {
            reader.bad(entry, "must not be empty");
        } else if names.contains(&name) {
            *reader.bad(entry, format!("\"{name}\" appears in the list twice")) =
                Some("remove one of them".into());
        }
        names.push(name);
    }
    good.then_some(names)
}

/// A name, or the number of a channel.
fn component(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<String> {
    if field.as_text().is_none() && matches!(field.node.value, Value::Integer(_)) {
        return reader.count(field).map(|number| number.to_string());
    }
    let name = reader.text(field)?;
    if name.trim().is_empty() {
        reader.bad(field, "must not be empty");
        return None;
    }
    Some(name)
}

fn read_wave(reader: &mut Reader<'_>, view: &View<'_>, wave: &Field<'_>) -> Option<MotionSource> {
    let kind = reader.choice(wave, WAVES, &[]);
    let amplitude = required(
        reader,
        view,
        "amplitude",
        Dimension::Acceleration,
        "\"2 m/s2\"",
    );
    let period = required(reader, view, "period", Dimension::Time, "\"0.7 s\"").and_then(
        |(field, period)| {
            let good = (1e-3..=LONGEST).contains(&period);
            if !good {
                reader.bad(
                    &field,
                    format!("must lie between 0.001 s and {LONGEST} s, found {period} s"),
                );
            }
            good.then_some(period)
        },
    );
    let centre = reader.get(view, "centre");
    match kind? {
        "ricker" => {
            let centre = match centre {
                Some(field) => duration(reader, &field)?,
                None => 1.5 * period?,
            };
            Some(MotionSource::Ricker {
                amplitude: amplitude?.1,
                period: period?,
                centre,
            })
        }
        _ => {
            if let Some(field) = centre {
                *reader.bad(&field, "does not go with a sine") = Some("remove centre".into());
            }
            Some(MotionSource::Sine {
                amplitude: amplitude?.1,
                period: period?,
            })
        }
    }
}

fn required<'n>(
    reader: &mut Reader<'_>,
    view: &View<'n>,
    key: &'static str,
    dimension: Dimension,
    example: &str,
) -> Option<(Field<'n>, f64)> {
    let Some(field) = reader.get(view, key) else {
        reader.missing(view, key, format!("add {key} = {example}"));
        return None;
    };
    let value = reader.quantity(&field, dimension)?;
    Some((field, value))
}

/// A factor on a motion.
fn factor(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<f64> {
    let factor = reader.quantity(field, Dimension::Dimensionless)?;
    if factor == 0.0 {
        *reader.bad(field, "must not be 0, with which nothing shakes") =
            Some("give a factor other than 0, or leave scale out".into());
        return None;
    }
    Some(factor)
}

/// How a motion is scaled; a list of factors has one for each of its `records`.
fn scaling(reader: &mut Reader<'_>, view: &View<'_>, files: &Files, records: usize) -> Scaling {
    let given = ["pga", "scale", "match"].map(|key| reader.get(view, key));
    let mut first = None;
    for field in given.iter().flatten() {
        match &first {
            None => first = Some(field.path.clone()),
            Some(first) => {
                let first = first.trim_start_matches("motion.").to_owned();
                *reader.bad(field, format!("cannot be combined with {first}")) =
                    Some("keep one of pga, scale and match".into());
            }
        }
    }
    let [pga, scale, wanted] = given;
    let factor = scale.and_then(|field| {
        let Some(entries) = field.entries() else {
            return factor(reader, &field).map(Scaling::Factor);
        };
        if entries.len() != records || records < 2 {
            let problem = match records {
                1 => "is a list, but there is one record".to_owned(),
                _ => format!("has {} entries for {records} records", entries.len()),
            };
            *reader.bad(&field, problem) =
                Some("give one factor, or one for each record of the list".into());
            return None;
        }
        let factors = entries.iter().map(|entry| factor(reader, entry));
        let factors: Vec<Option<f64>> = factors.collect();
        Some(Scaling::FactorOfEach(
            factors.into_iter().collect::<Option<_>>()?,
        ))
    });
    let peak = pga
        .and_then(|field| reader.positive(&field, Dimension::Acceleration))
        .map(Scaling::Pga);
    let matched = wanted
        .and_then(|field| matching::read(reader, &field, files))
        .map(|wanted| Scaling::Match(Box::new(wanted)));
    peak.or(factor).or(matched).unwrap_or_default()
}
