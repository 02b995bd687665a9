//! B6, B7 and B9: indentation, pressure, duration and spread of impacts.

use super::contact::is_bare;
use super::gap::length;
use super::mass::floor_masses;
use super::{Known, Tally, stated};
use crate::contact::{LawKind, SlabMaterial};
use crate::results::summary::{GapSummary, ImpactSummary};

/// Impacts of gaps between bare floors: index of the gap, its numbers, the impact.
fn impacts<'a>(known: &Known<'a>) -> Vec<(usize, &'a GapSummary, &'a ImpactSummary)> {
    let Some((summary, _)) = known.results else {
        return Vec::new();
    };
    let gaps = summary.gaps.iter().zip(&known.model.gaps).enumerate();
    let bare = gaps.filter(|(_, (_, gap))| is_bare(gap.law.kind));
    bare.flat_map(|(index, (gap, _))| {
        let contacts = gap.contacts.iter().flat_map(|contact| &contact.impacts);
        contacts.map(move |impact| (index, gap, impact))
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
                "{place}: an impact indents the floors by {:.1} mm; concrete would crush before that",
                1e3 * depth
            );
            (place, text)
        });
    }
}

/// Greatest compression of rubber bumpers over their thickness.
pub(super) fn bumper(known: &Known<'_>, tally: &mut Tally<'_>) {
    let Some((summary, _)) = known.results else {
        return;
    };
    for (gap, model) in summary.gaps.iter().zip(&known.model.gaps) {
        let LawKind::Rubber(bumper) = model.law.kind else {
            continue;
        };
        let impacts = gap.contacts.iter().flat_map(|contact| &contact.impacts);
        for depth in impacts.map(|impact| impact.peak_indentation_m) {
            tally.add(depth / bumper.thickness, || {
                let place = gap.between.join(" ↔ ");
                let text = format!(
                    "{place}: a rubber bumper of {} mm is compressed by {:.1} mm",
                    stated(1e3 * bumper.thickness),
                    1e3 * depth
                );
                (place, text)
            });
        }
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
                "{place}: an impact indents the floors by {:.1} mm, {:.1} % of their length of {} m",
                1e3 * depth,
                100.0 * depth / shortest,
                stated(shortest)
            );
            (place, text)
        });
    }
}

/// Thickness of the slabs that are pressed together, where only the force is known \[m\].
const SLAB: f64 = 0.15;
/// Mass of a floor per area, from which the width of a slab follows where it is not known \[kg/m²\].
const FLOOR_DENSITY: f64 = 1000.0;
/// Characteristic strength of concrete where it is not stated: C25/30 of EN 1992-1-1 \[Pa\].
const STRENGTH: f64 = 25e6;

/// Pressure of the strongest impact on the edges of the slabs over the strength of the weaker concrete.
pub(super) fn pressure(known: &Known<'_>, tally: &mut Tally<'_>) {
    let Some((summary, _)) = known.results else {
        return;
    };
    for (gap_summary, gap) in summary.gaps.iter().zip(&known.model.gaps) {
        if !is_bare(gap.law.kind) || gap.law.kind == LawKind::Restitution {
            continue;
        }
        let sides = known.model.buildings_beside(gap.between);
        let strength = |side: usize| known.stated(side).strength.unwrap_or(STRENGTH);
        let strength = sides.into_iter().flatten().map(strength);
        let strength = strength.fold(f64::INFINITY, f64::min);
        for contact in &gap_summary.contacts {
            let width = match contact.in_plan {
                Some(plan) => plan.overlap_m,
                None => {
                    let floors = sides.into_iter().zip(contact.floors);
                    let widths =
                        floors.filter_map(|(side, floor)| slab_width(known, side?, floor?));
                    widths.fold(f64::INFINITY, f64::min)
                }
            };
            // Corners have no width, struck columns no slab.
            if width <= 0.0 || width.is_infinite() {
                continue;
            }
            let pressure = contact.peak_force_n / (width * SLAB);
            tally.add(pressure / strength, || {
                let place = gap_summary.between.join(" ↔ ");
                let text = format!(
                    "{place}: {:.1} kN on a slab of {} mm over {} m is a pressure of {:.1} MPa, above the concrete strength of {} MPa: it would crush",
                    1e-3 * contact.peak_force_n,
                    stated(1e3 * SLAB),
                    stated(width),
                    1e-6 * pressure,
                    stated(1e-6 * strength)
                );
                (place, text)
            });
        }
    }
}

/// Width of the slab of a floor across the row: its mass over its length and 1000 kg/m², or that of a square.
fn slab_width(known: &Known<'_>, building: usize, floor: usize) -> Option<f64> {
    let masses = floor_masses(known.system.buildings.get(building)?);
    let area = masses.get(floor.checked_sub(1)?)? / FLOOR_DENSITY;
    Some(length(&known.model.buildings[building]).map_or(area.sqrt(), |length| area / length))
}

/// Duration of the strongest impact of a gap over the time in which a wave runs along the shorter floor and back.
pub(super) fn duration(known: &Known<'_>, tally: &mut Tally<'_>) {
    let material = SlabMaterial::default();
    let speed = (material.modulus / material.density).sqrt();
    let mut strongest: Vec<Option<(&GapSummary, &ImpactSummary)>> =
        vec![None; known.model.gaps.len()];
    for (index, gap, impact) in impacts(known) {
        let momentum = known.model.gaps[index].law.kind == LawKind::Restitution;
        let weaker = strongest[index]
            .is_some_and(|(_, previous)| previous.peak_force_n >= impact.peak_force_n);
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
                "{place}: the strongest impact lasts {:.1} ms; in this time a wave travels along a floor of {} m and back {:.1} times, so that floors are not rigid bodies",
                1e3 * duration,
                stated(shortest),
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
    for (gap_spread, gap) in spread.gaps.iter().zip(&summary.gaps) {
        if gap.peak_force_n <= 0.0 {
            continue;
        }
        let (least, most) = (gap_spread.peak_force_min_n, gap_spread.peak_force_max_n);
        tally.add((most - least) / gap.peak_force_n, || {
            let place = gap_spread.between.join(" ↔ ");
            let text = format!(
                "{place}: the peak force is between {:.1} and {:.1} kN over the range of contact stiffness",
                1e-3 * least,
                1e-3 * most
            );
            (place, text)
        });
    }
}
