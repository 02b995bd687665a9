//! `hinges` with `rule = "fibre"`: ends of columns that follow their axial force.

use std::collections::BTreeMap;

use jostle::{ColumnFibres, Frame, FramePlace};
use jostle_section::FibreOptions;
use jostle_section::formula::Member;

use super::reinforced::ReinforcedMember;
use crate::keys::FIBRE_ENDS;
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// Most layers of concrete that a section may be cut into.
const MOST_LAYERS: usize = 400;

/// Keys that belong to fibres alone.
pub(super) const KEYS: [&str; 8] = [
    "length",
    "fibres",
    "ends",
    "peak_strain",
    "residual",
    "ultimate_strain",
    "hardening",
    "beam_rule",
];

/// Whether a table asks for fibres.
pub(super) fn asked(reader: &mut Reader<'_>, view: &View<'_>) -> bool {
    let rule = reader.get(view, "rule");
    rule.is_some_and(|field| field.as_text() == Some("fibre"))
}

/// Notes keys that have no meaning without fibres.
pub(super) fn refuse(reader: &mut Reader<'_>, view: &View<'_>) {
    for key in KEYS {
        if let Some(field) = reader.get(view, key) {
            *reader.bad(&field, "has no meaning without fibres") =
                Some(format!("remove {key}, or set rule = \"fibre\""));
        }
    }
}

/// Fibres of all columns; `None` after faults. `members`: the reinforced members, `None` after faults elsewhere.
pub(super) fn read(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    view: &View<'_>,
    frame: &Frame,
    members: Option<&[ReinforcedMember]>,
) -> Option<BTreeMap<FramePlace, ColumnFibres>> {
    let all = read_all(reader, field, view, frame, members);
    // Each of several faults is said.
    all.filter(|_| frame.axial.columns_flexible)
}

fn read_all(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    view: &View<'_>,
    frame: &Frame,
    members: Option<&[ReinforcedMember]>,
) -> Option<BTreeMap<FramePlace, ColumnFibres>> {
    if !frame.axial.columns_flexible {
        *reader.bad(
            field,
            "needs columns that change their length: without it their axial force is not known",
        ) = Some("add axial = \"flexible\" to the building".into());
    }
    let layers = match reader.get(view, "fibres") {
        Some(field) => {
            let count = reader.count(&field)?;
            if !(2..=MOST_LAYERS).contains(&count) {
                reader.bad(
                    &field,
                    format!("must lie between 2 and {MOST_LAYERS}, found {count}"),
                );
                return None;
            }
            Some(count)
        }
        None => None,
    };
    let length = match reader.get(view, "length") {
        Some(field) if field.as_text() == Some("paulay-priestley") => None,
        Some(field) => Some(reader.positive(&field, Dimension::Length)?),
        None => {
            reader.missing(view, "length", "add length = \"paulay-priestley\" (0.08 L + 0.022 d f), or a length such as \"0.4 m\"");
            return None;
        }
    };
    let only_base = match reader.get(view, "ends") {
        Some(field) => reader.choice(&field, FIBRE_ENDS, &[])? == "base",
        None => false,
    };
    let mut number =
        |key: &'static str, needs: fn(f64) -> bool, range: &str| match reader.get(view, key) {
            Some(field) => {
                let value = reader.quantity(&field, Dimension::Dimensionless)?;
                if needs(value) {
                    return Some(Some(value));
                }
                reader.bad(&field, format!("must {range}, found {value}"));
                None
            }
            None => Some(None),
        };
    let below_one = |value: f64| (0.0..1.0).contains(&value);
    let peak_strain = number("peak_strain", |v| v > 0.0, "be greater than 0");
    let residual = number("residual", below_one, "be at least 0 and less than 1");
    let ultimate_strain = number("ultimate_strain", |v| v > 0.0, "be greater than 0");
    let hardening = number("hardening", below_one, "be at least 0 and less than 1");
    let (peak_strain, ultimate_strain) = (peak_strain?, ultimate_strain?);
    let (residual, hardening) = (residual?, hardening?);
    let columns: Vec<_> = members?
        .iter()
        .filter(|own| own.member == Member::Column)
        .collect();
    if columns.len() != frame.bare_members()[0] {
        let some = if columns.is_empty() {
            "no"
        } else {
            "not every"
        };
        *reader.bad(field, format!("takes fibres from the sections, but {some} column has bars")) = Some(
            "add concrete = \"C30\", steel = \"HRB400\", bars = \"12 d20\", cover = \"35 mm\" to column".into(),
        );
        return None;
    }
    let mut all = BTreeMap::new();
    for own in columns {
        let foot = !only_base || own.floor == 1;
        if !foot {
            continue;
        }
        let length =
            length.unwrap_or_else(|| FibreOptions::hinge_length(0.5 * own.length, &own.section));
        let options = FibreOptions::over(length);
        let options = FibreOptions {
            layers: layers.unwrap_or(options.layers),
            peak_strain,
            residual: residual.unwrap_or(options.residual),
            ultimate_strain,
            hardening,
            ..options
        };
        match own.section.fibres(&options) {
            Ok(fibres) => {
                let column = ColumnFibres {
                    length,
                    at_ends: [true, !only_base],
                    fibres,
                };
                all.insert([own.floor - 1, own.place - 1], column);
            }
            Err(faults) => {
                let problem = faults
                    .first()
                    .map_or_else(String::new, |fault| fault.problem.clone());
                reader.bad(
                    field,
                    format!("column {} of storey {}: {problem}", own.place, own.floor),
                );
                return None;
            }
        }
    }
    Some(all)
}
