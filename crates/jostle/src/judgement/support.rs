//! B11: strokes of bearings.

use super::{Known, Tally, quoted};

/// Displacement of bearings over the one that they allow.
pub(super) fn bearing_stroke(known: &Known<'_>, tally: &mut Tally<'_>) {
    let Some((summary, _)) = known.results else {
        return;
    };
    for building in &summary.buildings {
        let Some((own, limit)) = building
            .isolation
            .as_ref()
            .and_then(|own| Some((own, own.limit_m?)))
        else {
            continue;
        };
        let stroke = own.displacement_peak_m();
        tally.add(stroke / limit, || {
            let what = match own.in_plan {
                Some(_) => "a bearing",
                None => "the mat",
            };
            let text = format!(
                "{what} of {} moves {:.0} mm, beyond the {:.0} mm that its bearings allow",
                quoted(&building.name),
                1e3 * stroke,
                1e3 * limit
            );
            (building.name.clone(), text)
        });
    }
}
