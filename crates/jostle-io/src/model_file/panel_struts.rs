//! Where the struts of an infill panel end, and the drifts by which its damage is judged.

use jostle::{Diagonal, PanelDamage, StrutLine};

use crate::quantity::Dimension;
use crate::reader::{Reader, View};

/// What a table says of all its panels.
pub(super) struct PanelStruts {
    /// Distance of ends from joints \[m\].
    offset: f64,
    /// Share of the strut between the joints, if there are three \[–\].
    central_share: Option<f64>,
    drifts: [f64; 4],
}

impl PanelStruts {
    /// Reads the table of an infill; `None` after a fault.
    pub(super) fn read(reader: &mut Reader<'_>, view: &View<'_>) -> Option<Self> {
        let offset = match reader.get(view, "offset") {
            Some(field) => match reader.quantity(&field, Dimension::Length)? {
                offset if offset >= 0.0 => offset,
                _ => {
                    reader.bad(&field, "must not be negative");
                    return None;
                }
            },
            None => 0.0,
        };
        Some(Self {
            offset,
            central_share: central_share(reader, view, offset)?,
            drifts: damage_drifts(reader, view)?,
        })
    }

    /// All struts of the panel that one of joints stands for, in a bay of this width and height \[m\].
    pub(super) fn of_panel(&self, whole: Diagonal, [width, height]: [f64; 2]) -> Vec<Diagonal> {
        let damage = Some(PanelDamage {
            drifts: self.drifts,
            drift_per_shortening: libm::hypot(width, height) / (width * height),
        });
        let strut = |strut: StrutLine, share: f64, offsets: [f64; 2]| {
            let mut diagonal = whole;
            diagonal.place.strut = strut;
            diagonal.stiffness *= share;
            diagonal.hysteresis = diagonal.hysteresis.map(|law| law.of_share(share));
            Diagonal {
                offsets,
                damage,
                ..diagonal
            }
        };
        let off = self.offset;
        let Some(central) = self.central_share else {
            return vec![strut(StrutLine::Central, 1.0, [off; 2])];
        };
        let side = 0.5 * (1.0 - central);
        vec![
            strut(StrutLine::Central, central, [0.0; 2]),
            strut(StrutLine::Foot, side, [off, 0.0]),
            strut(StrutLine::Head, side, [0.0, off]),
        ]
    }
}

/// Share of the central one of three struts; nothing inside for one strut, and `None` after a fault.
fn central_share(reader: &mut Reader<'_>, view: &View<'_>, offset: f64) -> Option<Option<f64>> {
    let share = reader.get(view, "central_share");
    let count = match reader.get(view, "struts") {
        Some(field) => match reader.count(&field)? {
            count @ (1 | 3) => count,
            count => {
                reader.bad(&field, format!("must be 1 or 3, found {count}"));
                return None;
            }
        },
        None => 1,
    };
    match (count, share) {
        (1, Some(field)) => {
            *reader.bad(&field, "has no meaning for one strut") =
                Some("add struts = 3, or remove central_share".into());
            None
        }
        (1, None) => Some(None),
        (_, None) => {
            reader.missing(
                view,
                "central_share",
                "add central_share = 0.5: no share is usual, it depends on the contact of panel and columns",
            );
            None
        }
        (_, Some(field)) => {
            let share = reader.quantity(&field, Dimension::Dimensionless)?;
            if !(share > 0.0 && share < 1.0) {
                reader.bad(
                    &field,
                    format!("must be greater than 0 and less than 1, found {share}"),
                );
                return None;
            }
            if offset == 0.0 {
                reader.missing(
                    view,
                    "offset",
                    "add offset = \"300 mm\", the distance of the other two struts from the joints",
                );
                return None;
            }
            Some(Some(share))
        }
    }
}

fn damage_drifts(reader: &mut Reader<'_>, view: &View<'_>) -> Option<[f64; 4]> {
    let Some(field) = reader.get(view, "damage_drifts") else {
        return Some(PanelDamage::SASSUN);
    };
    let entries = field.entries().unwrap_or_default();
    let mut found = Vec::new();
    for entry in &entries {
        found.push(reader.positive(entry, Dimension::Dimensionless)?);
    }
    let drifts: Option<[f64; 4]> = found.try_into().ok();
    let drifts = drifts.filter(|drift| drift.windows(2).all(|pair| pair[0] < pair[1]));
    if drifts.is_none() {
        *reader.bad(&field, "must be four drifts that rise") =
            Some("write damage_drifts = [0.0018, 0.0046, 0.0105, 0.0188]".into());
    }
    drifts
}
