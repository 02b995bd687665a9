//! `out_of_plane` of `[[building.infill]]`: what panels bear across their plane.

use jostle::PanelAcross;
use jostle_section::masonry::Arching;

use crate::keys::{ARCHINGS, Section};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// What a table says of all its panels.
pub(super) struct OutOfPlane {
    strength: Strength,
    /// Clear height, if it is not that of the storey \[m\].
    height: Option<f64>,
    thickness: f64,
    surface_mass: f64,
    falls: bool,
}

enum Strength {
    Stated(f64),
    Arching(Arching, f64),
}

/// Reads the table of an infill; `None` without it, and nothing inside after a fault.
pub(super) fn read(reader: &mut Reader<'_>, infill: &View<'_>) -> Option<Option<OutOfPlane>> {
    let field = reader.get(infill, "out_of_plane")?;
    Some(read_table(reader, infill, &field))
}

fn read_table(reader: &mut Reader<'_>, infill: &View<'_>, field: &Field<'_>) -> Option<OutOfPlane> {
    let view = reader.open(field, &[Section::InfillOutOfPlane])?;
    let thickness = match reader.get(infill, "thickness") {
        // Its faults are noted where the strut is read.
        Some(field) => reader.quietly(|reader| reader.positive(&field, Dimension::Length)),
        None => {
            *reader.bad(field, "needs the thickness of the panel") =
                Some("add thickness = \"200 mm\" with modulus and width to the infill".into());
            None
        }
    };
    let density = match reader.get(&view, "density") {
        Some(field) => reader.positive(&field, Dimension::Density),
        None => {
            reader.missing(
                &view,
                "density",
                "add density = \"1400 kg/m3\", that of the masonry with its plaster",
            );
            None
        }
    };
    let height = match reader.get(&view, "height") {
        Some(field) => Some(reader.positive(&field, Dimension::Length)?),
        None => None,
    };
    let falls = match reader.get(&view, "remove") {
        Some(field) => reader.flag(&field),
        None => Some(false),
    };
    let strength = strength(reader, infill, &view, field);
    let (thickness, density) = (thickness?, density?);
    Some(OutOfPlane {
        strength: strength?,
        height,
        thickness,
        surface_mass: density * thickness,
        falls: falls?,
    })
}

fn strength(
    reader: &mut Reader<'_>,
    infill: &View<'_>,
    view: &View<'_>,
    field: &Field<'_>,
) -> Option<Strength> {
    let rule = reader.get(view, "rule");
    let stated = reader.get(view, "strength");
    let compression = reader.get(view, "compression");
    match (rule, stated) {
        (Some(_), Some(stated)) => {
            *reader.bad(&stated, "and rule are both given") = Some("leave out one of them".into());
            None
        }
        (None, Some(stated)) => {
            if let Some(field) = compression {
                *reader.bad(&field, "has no meaning together with strength") =
                    Some("leave it out".into());
            }
            reader
                .positive(&stated, Dimension::Stress)
                .map(Strength::Stated)
        }
        (None, None) => {
            reader.missing(view, "rule", "add rule = \"asce41\" or \"en1996\"; or strength = \"4 kPa\", the pressure that the panel bears");
            None
        }
        (Some(rule), None) => {
            let word = reader.choice(&rule, ARCHINGS, &[]);
            let compression = match compression {
                Some(field) => reader.positive(&field, Dimension::Stress),
                None => {
                    // That of the strut holds here as well.
                    let table = reader.get(infill, "strength");
                    let strength_view =
                        table.and_then(|field| reader.reopen(&field, &[Section::InfillStrength]));
                    let stated = strength_view
                        .and_then(|strength_view| reader.get(&strength_view, "compression"));
                    let known = stated.and_then(|field| {
                        reader.quietly(|reader| reader.positive(&field, Dimension::Stress))
                    });
                    if known.is_none() {
                        reader.missing(view, "compression", "add compression = \"3 MPa\", the strength of the masonry along its height");
                    }
                    known
                }
            };
            if reader.get(infill, "opening").is_some() {
                *reader.bad(field, "cannot arch around an opening") = Some(
                    "give strength = \"2 kPa\", the pressure that the panel bears with its opening, instead of rule".into(),
                );
                return None;
            }
            let mut named = Arching::NAMED.into_iter();
            let word = word?;
            let (_, rule) = named.find(|(name, _)| *name == word)?;
            Some(Strength::Arching(rule, compression?))
        }
    }
}

impl OutOfPlane {
    /// Of a panel in a storey of this height \[m\]; `None` after a fault.
    pub(super) fn panel(
        &self,
        reader: &mut Reader<'_>,
        entry: &Field<'_>,
        storey_height: f64,
    ) -> Option<PanelAcross> {
        let height = self.height.unwrap_or(storey_height);
        let strength = match self.strength {
            Strength::Stated(strength) => strength,
            Strength::Arching(rule, compression) => {
                let Some(strength) = rule.strength(compression, height, self.thickness) else {
                    let slender = height / self.thickness;
                    *reader.bad(entry, format!("has panels {slender:.1} times as high as thick, and arching is not assumed above h/t = {}", Arching::MOST_SLENDER)) = Some(
                        "give out_of_plane its strength instead of rule, or the clear height of the panel".into(),
                    );
                    return None;
                };
                strength
            }
        };
        Some(PanelAcross {
            strength,
            surface_mass: self.surface_mass,
            falls: self.falls,
        })
    }
}
