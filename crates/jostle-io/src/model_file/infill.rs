//! `[[building.infill]]`: panels of masonry in the bays of a frame, as two struts that bear compression alone.

use jostle::hysteresis::Hysteresis;
use jostle::{Diagonal, DiagonalKind, Rise};

use super::brace::{Bays, Stiffness, add, places, tables};
use super::hinges::read_spring;
use crate::keys::Section;
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// Reads the panels of a frame.
pub(super) fn read_all(reader: &mut Reader<'_>, view: &View<'_>, bays: Bays<'_>) -> Vec<Diagonal> {
    let mut struts = Vec::new();
    for entry in tables(reader, view, "infill") {
        let found = read(reader, &entry, bays);
        add(reader, &entry, found.unwrap_or_default(), &mut struts);
    }
    struts
}

fn read(reader: &mut Reader<'_>, entry: &Field<'_>, bays: Bays<'_>) -> Option<Vec<Diagonal>> {
    let view = reader.open(entry, &[Section::Infill])?;
    let mut number = |key, dimension| {
        let field = reader.get(&view, key)?;
        Some(reader.positive(&field, dimension))
    };
    let stiffness = number("stiffness", Dimension::Stiffness);
    let masonry = [
        ("modulus", Dimension::Modulus, "\"4 GPa\""),
        ("thickness", Dimension::Length, "\"200 mm\""),
        (
            "width",
            Dimension::Length,
            "\"1.2 m\", that of the strut across its axis",
        ),
    ];
    let of_masonry = masonry.map(|(key, dimension, _)| number(key, dimension));
    let stiffness_of: &Stiffness<'_> = if let Some(stiffness) = stiffness {
        if let Some((key, ..)) = masonry.iter().find(|(key, ..)| view.has(key)) {
            let field = reader.get(&view, key)?;
            *reader.bad(&field, "and stiffness are both given") = Some("leave out stiffness, or modulus, thickness and width: it is their product over the diagonal of the bay".into());
            return None;
        }
        &move |_| stiffness
    } else {
        for ((key, _, example), value) in masonry.into_iter().zip(&of_masonry) {
            if value.is_none() {
                reader.missing(
                    &view,
                    key,
                    format!("add {key} = {example}; or stiffness, that of one strut, instead"),
                );
            }
        }
        let [modulus, thickness, width] = of_masonry.map(Option::flatten);
        let rigidity = modulus? * thickness? * width?;
        &move |diagonal| Some(rigidity / diagonal)
    };
    let kind = DiagonalKind::Infill;
    let mut struts = places(reader, &view, kind, &Rise::BOTH, bays, stiffness_of)?;
    let hinge = reader.get(&view, "hinge");
    for strut in &mut struts {
        let Some(field) = &hinge else {
            strut.hysteresis = Hysteresis::without_tension(strut.stiffness).ok();
            continue;
        };
        // A fault of one is that of all.
        let (sections, initial) = (&[Section::LinkHinge], Some(strut.stiffness));
        let own = read_spring(reader, field, sections, initial, Dimension::Force)?;
        match own.in_compression() {
            Ok(own) => strut.hysteresis = Some(own),
            Err(fault) => {
                *reader.bad(field, fault.problem) =
                    Some("set rule = \"pinched\" with pinching, or leave hinge out: struts then stay elastic".into());
                return None;
            }
        }
    }
    Some(struts)
}
