//! `[site]`: what drawings of the site show beside the model.

use crate::keys::Section;
use crate::quantity::Dimension;
use crate::reader::{Field, Reader};

/// Reads the angle from x to north; `None` after a fault \[rad\].
pub(super) fn read(reader: &mut Reader<'_>, field: &Field<'_>, in_space: bool) -> Option<f64> {
    let view = reader.open(field, &[Section::Site])?;
    if !in_space {
        *reader.bad(field, "is for buildings with a plan") =
            Some("give every building a plan, or leave out [site]".into());
        return None;
    }
    let Some(north) = reader.get(&view, "north") else {
        reader.missing(&view, "north", "add north = \"90 deg\" if y points north");
        return None;
    };
    let angle = reader.quantity(&north, Dimension::Dimensionless)?;
    if angle.abs() > std::f64::consts::TAU {
        *reader.bad(&north, "must be an angle of at most one turn") =
            Some("a number without a unit is in radians; write \"90 deg\" for degrees".into());
        return None;
    }
    Some(angle)
}
