//! `kind = "shear"`: floor masses on storey springs.

use jostle::Shear;

use super::building::{per_storey, storeys};
use crate::quantity::Dimension;
use crate::reader::{Reader, View};

/// Default storey height of a shear building; only drifts and contacts depend on it \[m\].
pub(super) const DEFAULT_STOREY_HEIGHT: f64 = 3.0;

/// Reads the keys of a shear building; after a fault, harmless values are used.
pub(super) fn read(reader: &mut Reader<'_>, view: &View<'_>) -> Shear {
    let count = if is_single_floor(reader, view) {
        Some(1)
    } else {
        storeys(reader, view, &["mass", "stiffness", "storey_height"])
    };
    let mut list = |key, dimension, example: Option<&str>, stand_in: f64| {
        let values = match (reader.get(view, key), example) {
            (Some(field), _) => per_storey(reader, &field, dimension, count),
            (None, Some(example)) => {
                reader.missing(
                    view,
                    key,
                    format!("add {key} = {example}, or a list from the ground up"),
                );
                None
            }
            (None, None) => None,
        };
        values.unwrap_or_else(|| vec![stand_in; count.unwrap_or(1)])
    };
    let mass = list("mass", Dimension::Mass, Some("\"40 t\""), 1.0);
    let stiffness = list("stiffness", Dimension::Stiffness, Some("\"60 MN/m\""), 1.0);
    let storey_heights = list(
        "storey_height",
        Dimension::Length,
        None,
        DEFAULT_STOREY_HEIGHT,
    );
    note_growth(reader, view, &stiffness);
    Shear {
        mass,
        stiffness,
        storey_heights,
    }
}

/// Warns where every storey of three or more is stiffer than the one below: lists begin at the ground. A soft ground storey is none.
fn note_growth(reader: &mut Reader<'_>, view: &View<'_>, stiffness: &[f64]) {
    let grows = stiffness.windows(2).all(|pair| pair[1] > pair[0]);
    if stiffness.len() < 3 || !grows {
        return;
    }
    if let Some(field) = reader.get(view, "stiffness") {
        reader.warn(
            &field,
            "every storey is stiffer than the one below; lists begin at the ground",
        );
    }
}

/// Whether nothing speaks of more than one floor: one mass, one stiffness, no count and no list.
fn is_single_floor(reader: &mut Reader<'_>, view: &View<'_>) -> bool {
    let counted = view.has("storeys") || view.has("floors");
    let mut single = |key| {
        reader
            .get(view, key)
            .is_none_or(|field| field.entries().is_none())
    };
    let lists_nothing = single("mass") && single("stiffness") && single("storey_height");
    !counted && view.has("mass") && view.has("stiffness") && lists_nothing
}
