//! A5 and B1: slender frames, and stability coefficients.

use super::{Known, Tally, quoted};
use crate::model::{Frame, Structure};

/// How tall frames are whose columns keep their length.
pub(super) fn rigid_columns(known: &Known<'_>, tally: &mut Tally<'_>) {
    let mut compare = |name: &str, frame: &Frame| {
        if frame.axial.columns_flexible {
            return;
        }
        tally.add(frame.tallness(), || {
            let (height, width): (f64, f64) =
                (frame.storey_heights.iter().sum(), frame.spans.iter().sum());
            let shape = match width > 0.0 {
                true => format!("{:.1} times as high as wide", height / width),
                false => "on a single column line".to_owned(),
            };
            let text = format!(
                "{}: {} storeys, {shape}, with axially rigid columns: real columns shorten, which makes the building softer",
                quoted(name),
                frame.storey_heights.len(),
            );
            (name.to_owned(), text)
        });
    };
    for building in &known.model.buildings {
        match &building.structure {
            Structure::Frame(frame) => compare(&building.name, frame),
            Structure::Tiers(tiers) => {
                for frame in &tiers.frames {
                    compare(&building.name, &frame.frame);
                }
            }
            Structure::Shear(_) | Structure::Given(_) => {}
        }
    }
}

/// Greatest stability coefficient of the storeys that count, by whether their building has P-Delta, and by the coefficient.
fn stability(known: &Known<'_>, tally: &mut Tally<'_>, counts: impl Fn(bool, f64) -> bool) {
    let Some((summary, _)) = known.results else {
        return;
    };
    for (model, building) in known.model.buildings.iter().zip(&summary.buildings) {
        for floor in &building.floors {
            let theta = floor.response.stability_coefficient.unwrap_or(0.0);
            if !counts(model.gravity.p_delta, theta) {
                continue;
            }
            tally.add(theta, || {
                let place = format!("{}, storey {}", building.name, floor.floor);
                let with = match model.gravity.p_delta {
                    true => "",
                    false => ", but P-Delta is not included",
                };
                let text = format!("{place}: the stability coefficient θ is {theta:.2}{with}");
                (place, text)
            });
        }
    }
}

/// Stability coefficient of storeys without P-Delta; those above the next limit belong to [`coefficient`].
pub(super) fn left_out(known: &Known<'_>, tally: &mut Tally<'_>) {
    stability(known, tally, |p_delta, theta| {
        !p_delta && theta <= super::table::SECOND_ORDER
    });
}

/// Stability coefficient of all storeys.
pub(super) fn coefficient(known: &Known<'_>, tally: &mut Tally<'_>) {
    stability(known, tally, |_, _| true);
}
