//! `hinges` with `rule = "surface"`: ends of columns that yield on a surface of axial force and moment.

use std::collections::BTreeMap;

use jostle::hysteresis::MOST_CORNERS;
use jostle::{ColumnFibres, Frame, FramePlace, SpaceSection};
use jostle_section::capacity::Interaction;
use jostle_section::formula::Member;
use jostle_section::{FibreOptions, Section};

use super::fibre_hinges;
use super::reinforced::ReinforcedMember;
use crate::keys::{FIBRE_ENDS, Section as KeySection};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// Keys that only surfaces use; the last one in space alone.
const OF_SURFACE: [&str; 3] = ["surface", "post_yield", "exponent"];

/// Exponent between both planes of bending where nothing is said. Sections with bars at all faces have 1.3 to 1.7 under a tenth to four
/// tenths of what their concrete bears.
const USUAL_EXPONENT: f64 = 1.5;

/// Share of the stiffness after yield where nothing is said.
const USUAL_POST_YIELD: f64 = 0.01;

/// Whether a table asks for surfaces.
pub(super) fn asked(reader: &mut Reader<'_>, view: &View<'_>) -> bool {
    fibre_hinges::has_rule(reader, view, "surface")
}

/// Notes keys that have no meaning without surfaces.
pub(super) fn refuse(reader: &mut Reader<'_>, view: &View<'_>, in_space: bool) {
    let own = if in_space { 3 } else { 2 };
    for key in OF_SURFACE.into_iter().take(own) {
        if let Some(field) = reader.get(view, key) {
            *reader.bad(&field, "has no meaning without a surface") =
                Some(format!("remove {key}, or set rule = \"surface\""));
        }
    }
}

/// Length, hardening and ends of surfaces.
struct Numbers {
    /// `None`: that of Paulay and Priestley \[m\].
    length: Option<f64>,
    post_yield: f64,
    only_base: bool,
}

impl Numbers {
    /// `None` after a fault.
    fn read(reader: &mut Reader<'_>, view: &View<'_>) -> Option<Self> {
        fibre_hinges::refuse_laws(reader, view);
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
        Some(Self {
            length: length?,
            post_yield,
            only_base,
        })
    }

    fn length_of(&self, section: Option<&Section>, height: f64) -> Option<f64> {
        let usual = section.map(|section| FibreOptions::hinge_length(0.5 * height, section));
        self.length.or(usual)
    }
}

/// How columns of a space frame yield on surfaces.
pub(super) struct AskedSurfaces {
    numbers: Numbers,
    exponent: f64,
    /// Corners of both planes of bending, where they are stated.
    stated: Option<[Vec<[f64; 2]>; 2]>,
}

impl AskedSurfaces {
    /// `None` after faults.
    pub(super) fn read(reader: &mut Reader<'_>, view: &View<'_>) -> Option<Self> {
        let numbers = Numbers::read(reader, view);
        let exponent = match reader.get(view, "exponent") {
            Some(field) => reader.positive(&field, Dimension::Dimensionless)?,
            None => USUAL_EXPONENT,
        };
        let stated = match reader.get(view, "surface") {
            Some(field) => {
                let along = read_corners(reader, &field, true, "moment")?;
                let view = reader.reopen(&field, &[KeySection::SpaceSurface])?;
                let across = match reader.get(&view, "across") {
                    Some(_) => read_corners(reader, &field, true, "across")?,
                    None => along.clone(),
                };
                Some([along, across])
            }
            None => None,
        };
        Some(Self {
            numbers: numbers?,
            exponent,
            stated,
        })
    }

    /// Whether a column of a storey, counted from 0, has them.
    pub(super) fn stand_in(&self, storey: usize) -> bool {
        !self.numbers.only_base || storey == 0
    }

    /// That of a column between the axes of its joints. `section`: with its bars.
    ///
    /// # Errors
    /// The first fault, in words, and its remedy.
    pub(super) fn of_column(
        &self,
        column: &SpaceSection,
        section: Option<&Section>,
        height: f64,
    ) -> Result<ColumnFibres, [String; 2]> {
        let Some(axial) = column.axial_rigidity else {
            return Err([
                "needs columns that change their length: without it their axial force is not known",
                "leave axial = \"rigid\" out",
            ]
            .map(str::to_owned));
        };
        let bars = "add concrete = \"C30\", steel = \"HRB400\" and bars = \"12 d20\" to column, or give surface and a length such as \"0.4 m\"";
        let without = "takes its surface and its length from the section, and has no bars";
        let without = || [without, bars].map(str::to_owned);
        let length = self
            .numbers
            .length_of(section, height)
            .ok_or_else(without)?;
        let corners = match (&self.stated, section) {
            (Some(stated), _) => stated.clone(),
            (None, Some(section)) => {
                let turned = section.turned();
                if !(section.is_symmetric() && turned.is_symmetric()) {
                    return Err([
                        "has other bars at one face than at the opposite one",
                        "give surface with axial forces and moments",
                    ]
                    .map(str::to_owned));
                }
                let [along, mut across] =
                    [section, &turned].map(|own| Interaction::new(own).corners(MOST_CORNERS));
                // Both diagrams are summed over layers of their own, and end at one force.
                let last = across.len() - 1;
                across[0][0] = along[0][0];
                across[last][0] = along[along.len() - 1][0];
                [along, across]
            }
            (None, None) => return Err(without()),
        };
        let [along, across] = column.flexural_rigidity;
        let stiffness = [axial, along, across].map(|rigidity| rigidity / length);
        let at_ends = [true, !self.numbers.only_base];
        let corners = [&corners[0][..], &corners[1][..]];
        let (exponent, post_yield) = (self.exponent, self.numbers.post_yield);
        let made = ColumnFibres::on_surface_in_space(
            length, at_ends, stiffness, corners, exponent, post_yield,
        );
        made.map_err(|faults| {
            let problem = faults.into_iter().next().map(|fault| fault.problem);
            [
                problem.unwrap_or_default(),
                "see surface and exponent".into(),
            ]
        })
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
    let numbers = Numbers::read(reader, view);
    fibre_hinges::needs_flexible_columns(reader, field, frame);
    let stated = match reader.get(view, "surface") {
        Some(field) => Some((read_corners(reader, &field, false, "moment")?, field)),
        None => None,
    };
    let Numbers {
        length,
        post_yield,
        only_base,
    } = numbers?;
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

/// Corners of a surface as axial force and moment; `None` after faults. `moments`: the key of these.
fn read_corners(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    in_space: bool,
    moments: &'static str,
) -> Option<Vec<[f64; 2]>> {
    let sections: &'static [KeySection] = match in_space {
        true => &[KeySection::SpaceSurface],
        false => &[KeySection::HingeSurface],
    };
    let view = match moments {
        "moment" => reader.open(field, sections)?,
        // Its keys were checked with those.
        _ => reader.reopen(field, sections)?,
    };
    let lists = [("axial", Dimension::Force), (moments, Dimension::Moment)];
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
