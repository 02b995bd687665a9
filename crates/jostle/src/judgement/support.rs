//! A15, A16 and B11: properties, strokes and uplift of bearings, and soil counted twice.

use super::gap::length;
use super::{Known, Tally, quoted, stated};
use crate::model::{LEVEL_TOLERANCE, PlanPoint, Structure};

/// 1 for an isolated building without bounds of its bearing properties, 0 for others.
pub(super) fn bearing_bounds(known: &Known<'_>, tally: &mut Tally<'_>) {
    for building in &known.model.buildings {
        let Some(isolation) = &building.base.isolation else {
            continue;
        };
        tally.add(f64::from(u8::from(isolation.bounds.is_none())), || {
            let text = format!(
                "{}: only one set of bearing properties; codes require lower and upper bounds, which govern stroke and force",
                quoted(&building.name)
            );
            (building.name.clone(), text)
        });
    }
}

/// Depth over which links to the ground hold an embedded foundation, whose formulas count the soil at its sides already. A link acts on the
/// soil from the middle of the storey below its floor.
pub(super) fn soil_twice(known: &Known<'_>, tally: &mut Tally<'_>) {
    for link in &known.system.links {
        // Those of braces and panels are none of the model's.
        let found_link = known.model.links.get(link.link);
        let Some([Some(index), None] | [None, Some(index)]) = found_link.map(|link| link.between)
        else {
            continue;
        };
        let building = &known.model.buildings[index];
        let Some(foundation) = building.base.foundation else {
            continue;
        };
        let height = link.height - building.base.elevation;
        let floors = building.floor_heights().into_iter();
        let below = floors.filter(|floor| floor + LEVEL_TOLERANCE < height);
        let lowest = 0.5 * (height + below.fold(0.0, f64::max));
        tally.add(foundation.embedment - lowest, || {
            let text = format!(
                "{}: its foundation has an embedment of {:.2} m, and a link to a wall {height:.2} m above the foundation represents the same soil, so the soil is counted twice",
                quoted(&building.name),
                foundation.embedment
            );
            (building.name.clone(), text)
        });
    }
}

/// Displacement of bearings over the one that they allow, at the bounds of their properties too.
pub(super) fn bearing_stroke(known: &Known<'_>, tally: &mut Tally<'_>) {
    let Some((summary, _)) = known.results else {
        return;
    };
    for (index, building) in summary.buildings.iter().enumerate() {
        let Some((isolation, limit)) = building
            .isolation
            .as_ref()
            .and_then(|isolation| Some((isolation, isolation.limit_m?)))
        else {
            continue;
        };
        let bounds = summary.isolation_bounds.as_ref();
        let bounds = bounds.and_then(|all| all.buildings.get(index)?.stroke_m);
        let nominal = isolation.displacement_peak_m();
        let stroke = bounds.map_or(nominal, |bound| bound.envelope);
        tally.add(stroke / limit, || {
            let what = match isolation.in_plan {
                Some(_) => "a bearing",
                None => "the mat",
            };
            let at = match stroke > nominal {
                true => " at a bound of its properties",
                false => "",
            };
            let text = format!(
                "{what} of {} moves {:.1} mm{at}, more than the {} mm capacity of its bearings",
                quoted(&building.name),
                1e3 * stroke,
                stated(1e3 * limit)
            );
            (building.name.clone(), text)
        });
    }
}

/// Overturning moment on the bearings over that at which the outermost one loses its compression: W Σx²/(n x_max) for n bearings at x
/// from their middle, W B/6 for bearings spread evenly over a length B.
pub(super) fn bearing_uplift(known: &Known<'_>, tally: &mut Tally<'_>) {
    let Some((summary, _)) = known.results else {
        return;
    };
    for (model, building) in known.model.buildings.iter().zip(&summary.buildings) {
        let bearings = match &model.structure {
            Structure::Tiers(tiers) => &tiers.bearings[..],
            Structure::Frame(_) | Structure::Shear(_) | Structure::Given(_) => &[],
        };
        let arm = core(bearings).or_else(|| Some(length(model)? / 6.0));
        let (Some(isolation), Some(arm), Some(lowest)) =
            (&building.isolation, arm, building.floors.first())
        else {
            continue;
        };
        let moment = lowest.response.overturning_moment_peak_n_m;
        let ratio = moment / (isolation.weight_n * arm);
        tally.add(ratio, || {
            let text = format!(
                "{}: an overturning moment of {:.0} kN·m puts the outermost bearings in tension, which begins at {:.0} kN·m",
                quoted(&building.name),
                1e-3 * moment,
                1e-3 * isolation.weight_n * arm
            );
            (building.name.clone(), text)
        });
    }
}

/// Greatest eccentricity of the weight along x without uplift of a bearing; `None` for bearings that do not stand apart \[m\].
fn core(bearings: &[PlanPoint]) -> Option<f64> {
    let count = bearings.len() as f64;
    let middle = bearings.iter().map(|bearing| bearing[0]).sum::<f64>() / count;
    let x = || bearings.iter().map(|bearing| bearing[0] - middle);
    let furthest = x().map(f64::abs).fold(0.0, f64::max);
    (furthest > 0.0).then(|| x().map(|x| x * x).sum::<f64>() / (count * furthest))
}

#[cfg(test)]
mod tests {
    /// Two bearings 2a apart: one carries nothing once the weight stands over the other, at a. Many along B: the kern of a line, B/6.
    #[test]
    fn the_core_of_bearings_is_that_of_statics() {
        let two = [[1.0, 0.0], [7.0, 5.0]];
        assert_eq!(super::core(&two), Some(3.0));
        let many: Vec<[f64; 2]> = (0..=2000).map(|i| [0.006 * f64::from(i), 0.0]).collect();
        // n equally spaced: B²/12 (n + 1)/(n − 1) over B/2.
        let due = 2.0 * 2002.0 / 2000.0;
        assert!((super::core(&many).unwrap_or(0.0) - due).abs() < 1e-9);
        assert_eq!(super::core(&[]), None);
    }
}
