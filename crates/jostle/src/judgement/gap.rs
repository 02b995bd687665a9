//! A11, B10 and B12: widths of gaps.

use super::{Known, Tally, sides, stated};
use crate::model::{Building, Structure};

/// Deviation from plumb that specifications of concrete work allow up to 30 m of height \[m\].
const PLUMB: f64 = 0.025;
/// Thermal expansion of concrete and steel \[1/K\].
const EXPANSION: f64 = 1e-5;
/// Seasonal change of temperature \[K\].
const TEMPERATURE: f64 = 30.0;

/// Length of a building along the row, where it is known \[m\].
pub(super) fn length(building: &Building) -> Option<f64> {
    match &building.structure {
        Structure::Frame(frame) => Some(frame.spans.iter().sum()),
        Structure::Tiers(tiers) => {
            let corners = || tiers.floors.iter().flat_map(|floor| &floor.plan);
            let x = || corners().map(|corner| corner[0]);
            let length = x().fold(f64::NEG_INFINITY, f64::max) - x().fold(f64::INFINITY, f64::min);
            length.is_finite().then_some(length)
        }
        Structure::Shear(_) | Structure::Given(_) => None,
    }
}

/// Width over construction tolerance and temperature. A gap of zero states buildings that touch.
pub(super) fn tolerance(known: &Known<'_>, tally: &mut Tally<'_>) {
    for (index, gap) in known.model.gaps.iter().enumerate() {
        let lengths = known
            .model
            .neighbours(gap.between)
            .map(|side| side.and_then(length));
        // Each building expands from its middle.
        let expanding = lengths
            .into_iter()
            .flatten()
            .fold(0.0, |sum, length| sum + 0.5 * length);
        let temperature = EXPANSION * TEMPERATURE * expanding;
        let width = gap.width();
        if width <= 0.0 {
            continue;
        }
        tally.add(width / (PLUMB + temperature), || {
            let place = sides(known, index);
            // Without a known length there is no movement to name.
            let thermal = match temperature > 0.0 {
                true => format!(" plus thermal movement ({:.1} mm)", 1e3 * temperature),
                false => String::new(),
            };
            let text = format!(
                "{place}: the gap of {} mm is smaller than the construction tolerance ({} mm){thermal}",
                stated(1e3 * width),
                stated(1e3 * PLUMB)
            );
            (place, text)
        });
    }
}

/// Greatest closing over the width of gaps without impact.
pub(super) fn near_miss(known: &Known<'_>, tally: &mut Tally<'_>) {
    let Some((summary, _)) = known.results else {
        return;
    };
    for gap in summary.gaps.iter().filter(|gap| gap.impact_count == 0) {
        for contact in &gap.contacts {
            let (closing, width) = (contact.closing_peak_m, contact.width_m);
            tally.add(closing / width, || {
                let place = gap.between.join(" ↔ ");
                let text = format!(
                    "{place}: a near miss: the gap of {} mm closes by {:.1} mm without impact",
                    stated(1e3 * width),
                    1e3 * closing
                );
                (place, text)
            });
        }
    }
}

/// Computed gap over that of the codes that the model names.
pub(super) fn code_gap(known: &Known<'_>, tally: &mut Tally<'_>) {
    let Some((summary, codes)) = known.results.filter(|(_, codes)| !codes.shown.is_empty()) else {
        return;
    };
    for (index, gap) in summary.gaps.iter().enumerate() {
        let Some(needed) = gap.closing_without_contact_m else {
            continue;
        };
        let required = summary.required_gaps(known.model, index, codes);
        for rule in required.rules.iter().filter(|rule| rule.code.is_some()) {
            tally.add(needed / rule.width, || {
                let place = gap.between.join(" ↔ ");
                let text = format!(
                    "{place}: this record needs {:.1} mm, more than the {} mm of {}",
                    1e3 * needed,
                    // Up, as tables round it.
                    stated(0.1 * (1e4 * rule.width - 1e-6).ceil()),
                    rule.name
                );
                (place, text)
            });
        }
    }
}
