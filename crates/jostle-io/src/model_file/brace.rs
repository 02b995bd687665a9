//! `[[building.brace]]`: diagonals of the bays of a frame.

use jostle::{Diagonal, DiagonalKind, DiagonalPlace, Rise};

use super::buckling::{self, Strut};
use super::hinges::read_spring;
use super::places::range;
use super::steel_profile;
use crate::keys::{DIRECTIONS, Section};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// Storey heights and bay widths of the frame that diagonals belong to \[m\], and its joints.
#[derive(Clone, Copy)]
pub(super) struct Bays<'a> {
    pub(super) heights: &'a [f64],
    pub(super) widths: &'a [f64],
    /// E I of a column by storey and line, from 0 \[N·m²\]; `None` where there is none.
    pub(super) column_rigidity: &'a dyn Fn([usize; 2]) -> Option<f64>,
    /// Whether a diagonal finds both its joints.
    pub(super) has_joints: &'a dyn Fn(DiagonalPlace) -> bool,
}

/// Force per elongation of what stands in a bay, from its place and its diagonal \[N/m; m\]; `None` after a fault.
pub(super) type Stiffness<'a> = dyn Fn(DiagonalPlace, f64) -> Option<f64> + 'a;

/// Reads the braces of a frame.
pub(super) fn read_all(reader: &mut Reader<'_>, view: &View<'_>, bays: Bays<'_>) -> Vec<Diagonal> {
    let mut braces: Vec<Diagonal> = Vec::new();
    for entry in tables(reader, view, "brace") {
        let found = read(reader, &entry, bays);
        add(reader, &entry, found.unwrap_or_default(), &mut braces);
    }
    braces
}

/// The tables of a list `[[building.key]]`.
pub(super) fn tables<'n>(
    reader: &mut Reader<'_>,
    view: &View<'n>,
    key: &'static str,
) -> Vec<Field<'n>> {
    let Some(field) = reader.get(view, key) else {
        return Vec::new();
    };
    field.entries().unwrap_or_else(|| {
        let found = field.node.describe();
        *reader.bad(&field, format!("expected a list of tables, found {found}")) = Some(format!(
            "write [[building.{key}]] with double brackets; in JSON \"{key}\": [{{ … }}]"
        ));
        Vec::new()
    })
}

/// Adds diagonals of a table to those of tables before; two in one place are a fault.
pub(super) fn add(
    reader: &mut Reader<'_>,
    entry: &Field<'_>,
    found: Vec<Diagonal>,
    all: &mut Vec<Diagonal>,
) {
    let twice = found
        .iter()
        .find(|own| all.iter().any(|known| known.place == own.place));
    if let Some(own) = twice {
        *reader.bad(entry, format!("gives {} a second time", own.place)) =
            Some("leave it out here, or name other storeys and bays".into());
        return;
    }
    all.extend(found);
}

fn read(reader: &mut Reader<'_>, entry: &Field<'_>, bays: Bays<'_>) -> Option<Vec<Diagonal>> {
    let view = reader.open(entry, &[Section::Brace])?;
    let rises = match reader.get(&view, "direction") {
        Some(field) => match reader.choice(&field, DIRECTIONS, &[])? {
            "both" => &Rise::BOTH[..],
            "down" => &[Rise::Left],
            _ => &[Rise::Right],
        },
        None => &[Rise::Right],
    };
    let mut number = |key, dimension| {
        let field = reader.get(&view, key)?;
        Some(reader.positive(&field, dimension))
    };
    let rigidity = number("EA", Dimension::Force);
    let stiffness = number("stiffness", Dimension::Stiffness);
    let profile = match reader.get(&view, "profile") {
        Some(field) => Some(steel_profile::of_brace(reader, &view, &field)?),
        None => {
            if let Some(field) = reader.get(&view, "axis") {
                *reader.bad(&field, "has no meaning without a profile") =
                    Some("add profile, or remove axis".into());
                return None;
            }
            None
        }
    };
    let rigidity = match (rigidity, stiffness, profile) {
        (None, None, Some(own)) => Some(Some(own.modulus * own.profile.area())),
        _ => rigidity,
    };
    let stiffness_of: &Stiffness<'_> = match (rigidity, stiffness) {
        (Some(_), Some(_)) => {
            let field = reader.get(&view, "EA")?;
            *reader.bad(&field, "and stiffness are both given") =
                Some("leave out one of them: stiffness is EA over the length of the brace".into());
            return None;
        }
        (Some(rigidity), None) => &move |_, length| Some(rigidity? / length),
        (None, Some(stiffness)) => &move |_, _| stiffness,
        (None, None) => {
            reader.missing(
                &view,
                "EA",
                "add EA = \"300 MN\", the modulus of the brace times its area; or a profile; or stiffness = \"45 MN/m\"",
            );
            return None;
        }
    };
    let mut braces = places(
        reader,
        &view,
        DiagonalKind::Brace,
        rises,
        bays,
        stiffness_of,
    )?;
    if let Some(field) = reader.get(&view, "hinge") {
        const SECTIONS: &[Section] = &[Section::LinkHinge, Section::Buckling];
        let own = reader.open(&field, SECTIONS)?;
        let buckles = buckling::asked(reader, &own)?;
        for brace in &mut braces {
            // A fault of one is that of all.
            let stiffness = brace.stiffness;
            brace.hysteresis = Some(if buckles {
                let bay = bays.widths[brace.place.bay - 1];
                let strut = Strut {
                    stiffness,
                    length: libm::hypot(bay, bays.heights[brace.place.storey - 1]),
                    profile,
                };
                buckling::read(reader, &field, &own, strut)?
            } else {
                read_spring(reader, &field, SECTIONS, Some(stiffness), Dimension::Force)?
            });
        }
    }
    Some(braces)
}

/// Diagonals that rise these ways in the bays and storeys that a table names; all if it names none. Without bays of its own, it stands
/// only where there are joints.
pub(super) fn places(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    kind: DiagonalKind,
    rises: &[Rise],
    bays: Bays<'_>,
    stiffness: &Stiffness<'_>,
) -> Option<Vec<Diagonal>> {
    let storeys = range(reader, view, "storeys", bays.heights.len());
    let named = range(reader, view, "bay", bays.widths.len());
    let (storeys, named) = (storeys?, named?);
    let mut found = Vec::new();
    for storey in storeys[0]..=storeys[1] {
        for bay in named[0]..=named[1] {
            let length = libm::hypot(bays.widths[bay - 1], bays.heights[storey - 1]);
            for &rise in rises {
                let place = DiagonalPlace {
                    kind,
                    storey,
                    bay,
                    rise,
                };
                if !view.has("bay") && !(bays.has_joints)(place) {
                    continue;
                }
                found.push(Diagonal {
                    place,
                    stiffness: stiffness(place, length)?,
                    hysteresis: None,
                    across: None,
                });
            }
        }
    }
    Some(found)
}
