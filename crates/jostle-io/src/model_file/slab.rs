//! Beams whose slab takes part in bending: `slab`.

use jostle::Section;
use jostle_section::{FlangeWidth, Slab, Span};

use super::section::Material;
use crate::keys::{FLANGE_WIDTHS, Section as KeySection};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// A beam whose slab takes part.
#[derive(Clone, Copy)]
pub(super) struct OnSlab {
    slab: Slab,
    width: f64,
    depth: f64,
    /// E of axial force, and E with the factor of cracking \[Pa\].
    moduli: [f64; 2],
}

impl OnSlab {
    /// The section of beam and slab in a span.
    pub(super) fn with(&self, beam: Section, span: Span) -> Section {
        let tee = self.slab.tee(self.width, self.depth, span);
        let [axial, bending] = self.moduli;
        Section {
            flexural_rigidity: bending * tee.inertia,
            axial_rigidity: Some(axial * tee.area),
            ..beam
        }
    }
}

/// A slab that takes part in the bending of a beam.
pub(super) fn read(
    reader: &mut Reader<'_>,
    beam: &View<'_>,
    field: &Field<'_>,
    material: Material,
) -> Option<OnSlab> {
    let view = reader.open(field, &[KeySection::Slab])?;
    if !beam.has("width") || !beam.has("depth") {
        *reader.bad(field, "needs a beam with width and depth") =
            Some("give width and depth of the beam, slab included; or EI of both together instead of slab".into());
        return None;
    }
    // Their faults are noted where the rectangle is read.
    let [web, whole] = ["width", "depth"].map(|key| {
        let field = reader.get(beam, key)?;
        reader.quietly(|reader| reader.positive(&field, Dimension::Length))
    });
    let depth = match reader.get(&view, "depth") {
        Some(field) => {
            let depth = reader.positive(&field, Dimension::Length)?;
            if whole.is_some_and(|whole| depth >= whole) {
                *reader.bad(&field, format!("must be less than the depth of the beam, which includes the slab; found {depth} m")) =
                    Some("give the thickness of the slab, such as \"150 mm\"".into());
                return None;
            }
            depth
        }
        None => {
            reader.missing(&view, "depth", "add depth = \"150 mm\"");
            return None;
        }
    };
    let sides = match reader.get(&view, "sides") {
        Some(field) => match reader.count(&field)? {
            sides @ 1..=2 => sides,
            sides => {
                reader.bad(&field, format!("must be 1 or 2, found {sides}"));
                return None;
            }
        },
        None => 2,
    };
    let Some(stated) = reader.get(&view, "width") else {
        reader.missing(
            &view,
            "width",
            "add width = \"en1992\" or \"aci318\" with spacing, or the effective width, such as \"1.4 m\"",
        );
        return None;
    };
    let spacing = reader.get(&view, "spacing");
    let is_word = stated
        .as_text()
        .is_some_and(|text| text.starts_with(|c: char| c.is_alphabetic()));
    let width = if is_word {
        let rule = reader.choice(&stated, FLANGE_WIDTHS, &[])?;
        let Some(spacing) = spacing else {
            reader.missing(
                &view,
                "spacing",
                format!(
                    "{rule} needs the clear distance to the next beam: add spacing = \"4.7 m\""
                ),
            );
            return None;
        };
        let clear = reader.positive(&spacing, Dimension::Length)?;
        match rule {
            "en1992" => FlangeWidth::En1992 { clear },
            _ => FlangeWidth::Aci318 { clear },
        }
    } else {
        if let Some(field) = spacing {
            *reader.bad(&field, "is for width by a rule") = Some("leave it out".into());
        }
        let width = reader.positive(&stated, Dimension::Length)?;
        if web.is_some_and(|web| width < web) {
            *reader.bad(
                &stated,
                format!("must not be less than the width of the beam, found {width} m"),
            ) = Some("give the effective width, web included".into());
            return None;
        }
        FlangeWidth::Stated(width)
    };
    let modulus = material.modulus?;
    Some(OnSlab {
        slab: Slab {
            depth,
            sides,
            width,
        },
        width: web?,
        depth: whole?,
        moduli: [modulus, modulus * material.factor],
    })
}
