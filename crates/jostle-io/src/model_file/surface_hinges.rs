//! `hinges` with `rule = "surface"`: ends of columns that yield on a surface of axial force and moment.

use std::collections::BTreeMap;

use jostle::hysteresis::MOST_CORNERS;
use jostle::{ColumnFibres, Frame, FramePlace};
use jostle_section::FibreOptions;
use jostle_section::capacity::Interaction;
use jostle_section::formula::Member;

use super::fibre_hinges;
use super::reinforced::ReinforcedMember;
use crate::keys::{FIBRE_ENDS, Section as KeySection};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// Keys that only surfaces use.
const OF_SURFACE: [&str; 2] = ["surface", "post_yield"];

/// Share of the stiffness after yield where nothing is said.
const USUAL_POST_YIELD: f64 = 0.01;

/// Whether a table asks for surfaces.
pub(super) fn asked(reader: &mut Reader<'_>, view: &View<'_>) -> bool {
    fibre_hinges::has_rule(reader, view, "surface")
}

/// Notes keys that have no meaning without surfaces.
pub(super) fn refuse(reader: &mut Reader<'_>, view: &View<'_>) {
    for key in OF_SURFACE {
        if let Some(field) = reader.get(view, key) {
            *reader.bad(&field, "has no meaning without a surface") =
                Some(format!("remove {key}, or set rule = \"surface\""));
        }
    }
}

/// Surfaces of all columns; `None` after faults. `members`: the reinforced members, `None` after faults elsewhere.
pub(super) fn read(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    view: &View<'_>,
    frame: &Frame,
    members: Option<&[ReinforcedMember]>,
) -> Option<BTreeMap<FramePlace, ColumnFibres>> {
    fibre_hinges::refuse_laws(reader, view);
    fibre_hinges::needs_flexible_columns(reader, field, frame);
    let length = match reader.get(view, "length") {
        Some(field) if field.as_text() == Some("paulay-priestley") => Some(None),
        Some(field) => reader.positive(&field, Dimension::Length).map(Some),
        None => {
            let remedy = "add length = \"paulay-priestley\" (0.08 L + 0.022 d f), or a length such as \"0.4 m\"";
            reader.missing(view, "length", remedy);
            None
        }
    };
    let post_yield = match reader.get(view, "post_yield") {
        Some(field) => {
            let value = reader.quantity(&field, Dimension::Dimensionless)?;
            if !(0.0..1.0).contains(&value) {
                let range = format!("must be at least 0 and less than 1, found {value}");
                reader.bad(&field, range);
                return None;
            }
            value
        }
        None => USUAL_POST_YIELD,
    };
    let only_base = match reader.get(view, "ends") {
        Some(field) => reader.choice(&field, FIBRE_ENDS, &[])? == "base",
        None => false,
    };
    let stated = match reader.get(view, "surface") {
        Some(field) => Some((read_corners(reader, &field)?, field)),
        None => None,
    };
    let length = length?;
    let members: Vec<_> = members?
        .iter()
        .filter(|member| member.member == Member::Column)
        .collect();
    if (stated.is_none() || length.is_none()) && members.len() != frame.bare_members()[0] {
        let some = if members.is_empty() {
            "no"
        } else {
            "not every"
        };
        *reader.bad(
            field,
            format!("takes its surface and its length from the sections, but {some} column has bars"),
        ) = Some(
            "add steel = \"HRB400\" and bars = \"12 d20\" to column, or give surface and a length such as \"0.4 m\"".into(),
        );
        return None;
    }
    let mut all = BTreeMap::new();
    for ([storey, line], column) in frame.all_columns() {
        let bare = frame.bare_column(storey, line).is_some();
        let Some(axial_rigidity) = column.axial_rigidity.filter(|_| bare) else {
            continue;
        };
        if only_base && storey > 0 {
            continue;
        }
        let own = members
            .iter()
            .find(|member| [member.floor, member.place] == [storey + 1, line + 1]);
        let usual = own.map(|own| FibreOptions::hinge_length(0.5 * own.length, &own.section));
        let Some(length) = length.or(usual) else {
            continue;
        };
        let place = format!("column {} of storey {}", line + 1, storey + 1);
        let corners = match (&stated, own) {
            (Some((corners, _)), _) => corners.clone(),
            (None, Some(own)) if own.section.is_symmetric() => {
                Interaction::new(&own.section).corners(MOST_CORNERS)
            }
            _ => {
                *reader.bad(
                    field,
                    format!("{place} has other bars at its left than at its right"),
                ) = Some("give surface with axial forces and moments".into());
                return None;
            }
        };
        let stiffness =
            [axial_rigidity, column.flexural_rigidity].map(|rigidity| rigidity / length);
        let at_ends = [true, !only_base];
        match ColumnFibres::on_surface(length, at_ends, stiffness, &corners, post_yield) {
            Ok(surface) => {
                all.insert([storey, line], surface);
            }
            Err(faults) => {
                let problem = faults.into_iter().next().map(|fault| fault.problem);
                let problem = problem.unwrap_or_default();
                match &stated {
                    Some((_, surface)) => reader.bad(surface, problem),
                    None => reader.bad(field, format!("{place}: {problem}")),
                };
                return None;
            }
        }
    }
    // Each of several faults is said.
    Some(all).filter(|_| frame.axial.columns_flexible)
}

/// Corners of a surface as axial force and moment; `None` after faults.
fn read_corners(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<Vec<[f64; 2]>> {
    let view = reader.open(field, &[KeySection::HingeSurface])?;
    let lists = [("axial", Dimension::Force), ("moment", Dimension::Moment)];
    let lists = lists.map(|(key, dimension)| {
        let Some(list) = reader.get(&view, key) else {
            let example = match key {
                "axial" => "axial = [\"-6 MN\", \"-2 MN\", \"1 MN\"]",
                _ => "moment = [\"0 kN.m\", \"500 kN.m\", \"0 kN.m\"]",
            };
            reader.missing(&view, key, format!("add {example}"));
            return None;
        };
        let Some(entries) = list.entries() else {
            reader.bad(
                &list,
                format!("expected a list, found {}", list.node.describe()),
            );
            return None;
        };
        let values = entries
            .iter()
            .map(|entry| reader.quantity(entry, dimension));
        values
            .collect::<Vec<_>>()
            .into_iter()
            .collect::<Option<Vec<f64>>>()
    });
    let [axial, moment] = lists;
    let (axial, moment) = (axial?, moment?);
    if axial.len() != moment.len() {
        let counts = format!(
            "needs as many moments as axial forces, found {} and {}",
            moment.len(),
            axial.len()
        );
        reader.bad(field, counts);
        return None;
    }
    Some(axial.into_iter().zip(moment).map(|(n, m)| [n, m]).collect())
}
