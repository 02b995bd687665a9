//! Impacts in measurements, and the computed ones beside them.

use std::ops::Range;

use jostle::Summary;
use jostle::linear::sort_by;
use jostle::results::comparison::ImpactScore;
use jostle_io::{
    ComparedImpacts, ComparisonMap, Dimension, ImpactSign, NamedColumn, contact_names,
};

use super::text::four;
use super::{ImpactComparison, Measurements};
use crate::error::RunError;

/// Measured and computed impacts.
pub(super) fn compared(
    data: Measurements<'_>,
    rows: &Range<usize>,
    wanted: &ComparedImpacts,
    summary: &Summary,
) -> Result<ImpactComparison, RunError> {
    let (sign, measured) = measured_instants(data, rows, wanted, summary)?;
    let contacts = contacts(data.map, wanted, summary)?;
    let all = contact_names(summary);
    let mut episodes: Vec<[f64; 2]> = summary
        .gaps
        .iter()
        .flat_map(|gap| &gap.contacts)
        .zip(&all)
        .filter(|(_, name)| contacts.contains(name))
        .flat_map(|(contact, _)| &contact.impacts)
        .map(|impact| [impact.start_s, impact.end_s])
        .collect();
    sort_by(&mut episodes, |a, b| a[0].total_cmp(&b[0]));
    let computed = starts(&episodes, wanted.separation);
    let (score, pairs) = ImpactScore::new(&measured, &computed, wanted.window);
    Ok(ImpactComparison {
        sign,
        contacts,
        window: wanted.window,
        separation: wanted.separation,
        measured,
        computed,
        pairs,
        score,
    })
}

/// The contacts that are meant.
pub(super) fn contacts(
    map: &ComparisonMap,
    wanted: &ComparedImpacts,
    summary: &Summary,
) -> Result<Vec<String>, RunError> {
    let all = contact_names(summary);
    let Some(name) = &wanted.contact else {
        return Ok(all);
    };
    let meant = |contact: &&String| {
        **contact == name.name
            || contact
                .strip_prefix(&name.name)
                .is_some_and(|rest| rest.starts_with('.'))
    };
    let found: Vec<String> = all.iter().filter(meant).cloned().collect();
    if found.is_empty() {
        let problem = format!(
            "the model has no gap or contact \"{}\"; contacts: {}",
            name.name,
            all.join(", ")
        );
        return Err(map.fault(name, problem).into());
    }
    Ok(found)
}

/// How impacts show, and their instants \[s\].
pub(super) fn measured_instants(
    data: Measurements<'_>,
    rows: &Range<usize>,
    wanted: &ComparedImpacts,
    summary: &Summary,
) -> Result<(String, Vec<f64>), RunError> {
    let all = 0..data.table.points();
    let magnitude = |values: &mut [f64]| values.iter_mut().for_each(|v| *v = v.abs());
    let (sign, mut values, level) = match &wanted.sign {
        ImpactSign::Acceleration(column, above) => {
            let values = data.values(column, Dimension::Acceleration, &all)?;
            (
                format!("|{}| above {} m/s²", column.name, four(*above)),
                values,
                *above,
            )
        }
        ImpactSign::Sensor(column, level) => {
            let found = data.column(column)?;
            let sign = format!("|{}| above {level} {}", column.name, found.unit);
            (sign, found.values.clone(), *level)
        }
        ImpactSign::Closing([left, right], width) => {
            let mut values = data.values(left, Dimension::Length, &all)?;
            let other = data.values(right, Dimension::Length, &all)?;
            values.iter_mut().zip(other).for_each(|(l, r)| *l -= r);
            let width = match width {
                Some(width) => *width,
                None => width_of(data.map, left, wanted, summary)?,
            };
            let sign = format!("{} − {} above {} m", left.name, right.name, four(width));
            (sign, values, width)
        }
    };
    data.zero(&mut values, wanted.zero);
    if !matches!(wanted.sign, ImpactSign::Closing(..)) {
        magnitude(&mut values);
    }
    let values = values.get(rows.clone()).unwrap_or_default();
    let episodes = episodes(values, level, data.table.step);
    Ok((sign, starts(&episodes, wanted.separation)))
}

/// The width of the gap that is meant.
fn width_of(
    map: &ComparisonMap,
    at: &NamedColumn,
    wanted: &ComparedImpacts,
    summary: &Summary,
) -> Result<f64, RunError> {
    let found = contacts(map, wanted, summary)?;
    let mut widths = summary.gaps.iter().filter(|gap| {
        let pair = gap.between.join("-");
        found
            .iter()
            .any(|contact| contact.starts_with(&format!("{pair}.")))
    });
    match (widths.next(), widths.next()) {
        (Some(gap), None) => Ok(gap.width_m),
        (None, _) => Err(map
            .fault(at, "the model has no gap; state width = \"20 mm\"")
            .into()),
        (Some(_), Some(_)) => {
            let problem = "the model has several gaps; choose one with contact = \"J1-J2\", or state width = \"20 mm\"";
            Err(map.fault(at, problem).into())
        }
    }
}

/// Intervals in which values lie above a level: the instants of crossing on straight lines between the samples \[s\].
fn episodes(values: &[f64], level: f64, step: f64) -> Vec<[f64; 2]> {
    let mut found: Vec<[f64; 2]> = Vec::new();
    let mut open = false;
    for (k, value) in values.iter().enumerate() {
        let above = *value > level;
        if above == open {
            continue;
        }
        let crossing = match k.checked_sub(1).and_then(|before| values.get(before)) {
            Some(before) => k as f64 - (value - level) / (value - before),
            None => 0.0,
        };
        match (above, found.last_mut()) {
            (false, Some(last)) => last[1] = step * crossing,
            _ => found.push([step * crossing, step * (values.len() - 1) as f64]),
        }
        open = above;
    }
    found
}

/// Starts of intervals, in order of their starts; those that follow the end of the one before sooner than `separation` belong to
/// it \[s\].
fn starts(episodes: &[[f64; 2]], separation: f64) -> Vec<f64> {
    let mut starts = Vec::new();
    let mut end = f64::NEG_INFINITY;
    for [from, to] in episodes {
        if from - end >= separation {
            starts.push(*from);
        }
        end = end.max(*to);
    }
    starts
}

#[cfg(test)]
mod tests {
    use super::{episodes, starts};

    #[test]
    fn crossings_lie_between_samples_and_close_ones_are_one_impact() {
        let values = [0.0, 2.0, 0.0, 0.0, 0.0, 3.0, 3.0, 0.0];
        let found = episodes(&values, 1.0, 0.1);
        assert_eq!(found.len(), 2);
        // 0 → 2 crosses 1 in the middle; 0 → 3 crosses it at a third; 3 → 0 at two thirds.
        for (found, wanted) in
            found
                .iter()
                .flatten()
                .zip([0.05, 0.15, 0.4 + 0.1 / 3.0, 0.6 + 0.2 / 3.0])
        {
            assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
        }
        assert_eq!(starts(&found, 0.2).len(), 2);
        assert_eq!(starts(&found, 0.3).len(), 1);
    }

    #[test]
    fn a_signal_that_is_above_at_both_ends_is_one_impact() {
        let found = episodes(&[2.0, 2.0, 2.0], 1.0, 0.1);
        assert_eq!(found.len(), 1);
        assert!(found[0][0] == 0.0 && (found[0][1] - 0.2).abs() < 1e-12);
    }
}
