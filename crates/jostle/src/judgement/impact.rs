//! B6, B7 and B9: indentation, duration and spread of impacts.

use super::contact::is_bare;
use super::gap::length;
use super::{Known, Tally};
use crate::contact::{LawKind, SlabMaterial};
use crate::results::summary::{GapSummary, ImpactSummary};

/// Impacts of gaps between bare floors: index of the gap, its numbers, the impact.
fn impacts<'a>(known: &Known<'a>) -> Vec<(usize, &'a GapSummary, &'a ImpactSummary)> {
    let Some((summary, _)) = known.results else {
        return Vec::new();
    };
    let gaps = summary.gaps.iter().zip(&known.model.gaps).enumerate();
    let bare = gaps.filter(|(_, (_, gap))| is_bare(gap.law.kind));
    bare.flat_map(|(index, (own, _))| {
        let contacts = own.contacts.iter().flat_map(|contact| &contact.impacts);
        contacts.map(move |impact| (index, own, impact))
    })
    .collect()
}

/// Greatest indentation.
pub(super) fn indentation(known: &Known<'_>, tally: &mut Tally<'_>) {
    for (_, gap, impact) in impacts(known) {
        let depth = impact.peak_indentation_m;
        tally.add(depth, || {
            let place = gap.between.join(" ↔ ");
            let text = format!(
                "{place}: an impact indents the floors by {:.0} mm; concrete crushes before",
                1e3 * depth
            );
            (place, text)
        });
    }
}

/// Greatest indentation over the length of the shorter floor.
pub(super) fn indentation_share(known: &Known<'_>, tally: &mut Tally<'_>) {
    for (index, gap, impact) in impacts(known) {
        let Some(shortest) = shortest(known, index) else {
            continue;
        };
        let depth = impact.peak_indentation_m;
        tally.add(depth / shortest, || {
            let place = gap.between.join(" ↔ ");
            let text = format!(
                "{place}: an impact indents the floors by {:.1} mm, {:.1} % of their length of {shortest:.1} m",
                1e3 * depth,
                100.0 * depth / shortest
            );
            (place, text)
        });
    }
}

/// Duration of the strongest impact of a gap over the time in which a wave runs along the shorter floor and back.
pub(super) fn duration(known: &Known<'_>, tally: &mut Tally<'_>) {
    let material = SlabMaterial::default();
    let speed = (material.modulus / material.density).sqrt();
    let mut strongest: Vec<Option<(&GapSummary, &ImpactSummary)>> =
        vec![None; known.model.gaps.len()];
    for (index, gap, impact) in impacts(known) {
        let momentum = known.model.gaps[index].law.kind == LawKind::Restitution;
        let weaker =
            strongest[index].is_some_and(|(_, own)| own.peak_force_n >= impact.peak_force_n);
        if impact.finished && !momentum && !weaker {
            strongest[index] = Some((gap, impact));
        }
    }
    for (index, found) in strongest.into_iter().enumerate() {
        let (Some((gap, impact)), Some(shortest)) = (found, shortest(known, index)) else {
            continue;
        };
        let duration = impact.end_s - impact.start_s;
        let there_and_back = 2.0 * shortest / speed;
        tally.add(duration / there_and_back, || {
            let place = gap.between.join(" ↔ ");
            let text = format!(
                "{place}: the strongest impact lasts {:.1} ms, in which a wave runs along a floor of {shortest:.0} m and back {:.1} times: floors are not rigid bodies in it",
                1e3 * duration,
                duration / there_and_back
            );
            (place, text)
        });
    }
}

/// Length of the shorter floor beside a gap, where any is known \[m\].
fn shortest(known: &Known<'_>, gap: usize) -> Option<f64> {
    let sides = known.model.neighbours(known.model.gaps[gap].between);
    let lengths = sides.into_iter().flatten().filter_map(length);
    lengths.min_by(f64::total_cmp)
}

/// Spread of the peak force over the other contacts that were run, relative to that of the run.
pub(super) fn force_spread(known: &Known<'_>, tally: &mut Tally<'_>) {
    let Some((summary, _)) = known.results else {
        return;
    };
    let Some(spread) = &summary.contact_sensitivity else {
        return;
    };
    for (own, gap) in spread.gaps.iter().zip(&summary.gaps) {
        if gap.peak_force_n <= 0.0 {
            continue;
        }
        let (least, most) = (own.peak_force_min_n, own.peak_force_max_n);
        tally.add((most - least) / gap.peak_force_n, || {
            let place = own.between.join(" ↔ ");
            let text = format!(
                "{place}: the peak force lies between {:.0} and {:.0} kN over the range of contact stiffness",
                1e-3 * least,
                1e-3 * most
            );
            (place, text)
        });
    }
}
