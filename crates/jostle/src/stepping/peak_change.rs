//! Difference of the reported peaks of two runs of one system.

use super::outcome::{Outcome, PlanPeaks};
use super::sensitivity::closing_scale;
use crate::history::{Extreme, FloorPeaks, FoundationPeaks, Impact, LinkTotals};
use crate::structure::MemberSection;
use crate::system::System;

/// Weight of differences between parts of runs, which are usually larger than those of the peaks.
const IN_PARTS: f64 = 0.25;

/// Least scale of rotations, in those of displacements over the radius of gyration \[–\].
pub(super) const LEAST_ROTATION: f64 = 1e-3;

/// Axial force, shear, moment.
const MEMBER_FORCES: usize = 3;

/// Greatest difference of peaks, relative to the greatest of its kind in the building or gap \[–\].
pub(super) fn change_of_peaks(system: &System, [a, b]: [&Outcome; 2]) -> f64 {
    let kinds: [fn(&FloorPeaks) -> f64; 7] = [
        |floor| floor.displacement_max.value,
        |floor| floor.displacement_min.value,
        |floor| floor.storey_drift,
        |floor| floor.total_acceleration,
        |floor| floor.storey_shear,
        |floor| floor.overturning_moment,
        |floor| floor.vertical_displacement,
    ];
    let mut worst = 0.0_f64;
    let mut floors_before = 0;
    for (index, (a_floors, b_floors)) in a.floors.iter().zip(&b.floors).enumerate() {
        let shears = [a.base_shear[index], b.base_shear[index]];
        worst = worst.max(relative([shears].into_iter()));
        let bearings = [a, b].map(|run| run.supports[index]);
        worst = worst.max(relative([bearings.map(|own| own.force)].into_iter()));
        // Along x and, in space, across.
        let in_plan = [a, b].map(|run| &run.in_plan[index]);
        let mats = mats(system, [a, b], index);
        let lateral = || {
            let along = a_floors.iter().zip(b_floors);
            let across = in_plan[0].across.iter().zip(&in_plan[1].across);
            let mats = mats.iter().map(|[a, b]| (a, b));
            along.chain(across).chain(mats)
        };
        let turning = || in_plan[0].turning.iter().zip(&in_plan[1].turning);
        let radius = system.buildings[index].radius_of_gyration();
        for (number, kind) in kinds.into_iter().enumerate() {
            let values = |(a, b): (&FloorPeaks, &FloorPeaks)| [kind(a), kind(b)];
            worst = worst.max(relative(lateral().map(values)));
            // Of displacements per radius, of forces times radius.
            let unit = if number < 4 { 1.0 / radius } else { radius };
            let least = LEAST_ROTATION * unit * greatest_of(lateral().map(values));
            worst = worst.max(relative_to(least, turning().map(values)));
        }
        let of_corners: [fn(&PlanPeaks) -> &Vec<f64>; 2] =
            [|own| &own.corner_displacement, |own| &own.corner_drift];
        for of in of_corners {
            let [a, b] = in_plan.map(|own| of(own).iter());
            worst = worst.max(relative(a.zip(b).map(|(a, b)| [*a, *b])));
        }
        let greatest = greatest_of(lateral().map(|(a, b)| [a, b].map(|f| f.total_acceleration)));
        let count = a_floors.len() + in_plan[0].across.len();
        if greatest > 0.0 {
            let parts = [&a.acceleration_parts, &b.acceleration_parts];
            let change = parts[0].change(parts[1], floors_before, count);
            worst = worst.max(IN_PARTS * change / greatest);
        }
        floors_before += count + turning().count();
        let [one, other] = [a, b].map(|run| run.foundations[index]);
        let both = |of: fn(&FoundationPeaks) -> [Extreme; 2]| {
            let pairs = of(&one).into_iter().zip(of(&other));
            relative(pairs.map(|(a, b)| [a.value, b.value]))
        };
        worst = worst
            .max(both(|peaks| peaks.sway))
            .max(both(|peaks| peaks.rocking));
        for kind in 0..MEMBER_FORCES {
            let members = system.buildings[index].members.members.iter();
            let forms = members.flat_map(|m| m.sections.iter().flat_map(MemberSection::by_kind));
            let forms = forms.filter(|(own, _)| *own == kind).map(|(_, form)| form);
            let pairs = forms.flat_map(|form| {
                let [a, b] = [a, b].map(|run| run.members[index][form]);
                [0, 1].map(|side| [a[side], b[side]])
            });
            worst = worst.max(relative(pairs));
        }
    }
    if system.links.iter().any(|link| !link.is_linear()) {
        let models = system.links.iter().map(|link| link.link + 1).max();
        for model in 0..models.unwrap_or(0) {
            worst = worst.max(change_of_link(system, [a, b], model));
        }
    }
    let gaps = system.contacts.last().map_or(0, |contact| contact.gap + 1);
    for gap in 0..gaps {
        let contacts = 0..system.contacts.len();
        let own = contacts.filter(|contact| system.contacts[*contact].gap == gap);
        let own: Vec<usize> = own.collect();
        let both = |of: fn(&Outcome, usize) -> f64| own.iter().map(move |c| [of(a, *c), of(b, *c)]);
        worst = worst.max(relative(both(peak_force)));
        worst = worst.max(relative(both(impulse)));
        let together = [a, b].map(|run| run.gap_forces.get(gap).map_or(0.0, |own| own.value));
        worst = worst.max(relative([together].into_iter()));
        for contact in own {
            let least = closing_scale(&system.contacts[contact], 0.0, &b.floors, &b.supports);
            let closings = [a, b].map(|run| run.closing[contact].value);
            worst = worst.max(relative_to(least, [closings].into_iter()));
        }
    }
    worst
}

/// The mat of an isolated building, or a wall, along x and across, as a floor; none on the ground.
fn mats(system: &System, runs: [&Outcome; 2], index: usize) -> Vec<[FloorPeaks; 2]> {
    if system.buildings[index].support.is_none() {
        return Vec::new();
    }
    let supports = runs.map(|run| run.supports[index]);
    let along = supports.map(|own| FloorPeaks {
        displacement_max: own.displacement_max,
        displacement_min: own.displacement_min,
        total_acceleration: own.total_acceleration,
        ..FloorPeaks::default()
    });
    let across = supports.map(|own| {
        let own = own.in_plan.unwrap_or_default();
        FloorPeaks {
            displacement_max: own.across[0],
            displacement_min: own.across[1],
            total_acceleration: own.total_acceleration_across,
            ..FloorPeaks::default()
        }
    });
    vec![along, across]
}

/// Greatest difference of the peaks of a link of the model.
fn change_of_link(system: &System, [a, b]: [&Outcome; 2], model: usize) -> f64 {
    let kinds: [fn(&LinkTotals) -> f64; 3] = [
        |link| link.peak_force.value.abs(),
        |link| link.peak_shortening,
        |link| link.peak_rate,
    ];
    let pairs = |kind: fn(&LinkTotals) -> f64| {
        let both = a.links.iter().zip(&b.links).zip(&system.links);
        let own = both.filter(move |(_, link)| link.link == model);
        own.map(move |((a, b), _)| [kind(a), kind(b)])
    };
    kinds
        .into_iter()
        .map(|kind| relative(pairs(kind)))
        .fold(0.0, f64::max)
}

fn greatest_of(pairs: impl Iterator<Item = [f64; 2]>) -> f64 {
    pairs
        .flatten()
        .fold(0.0, |most, value| most.max(value.abs()))
}

fn relative(pairs: impl Iterator<Item = [f64; 2]>) -> f64 {
    relative_to(0.0, pairs)
}

/// Greatest difference of pairs over the greatest of their magnitudes, which counts as at least `least`.
fn relative_to(least: f64, pairs: impl Iterator<Item = [f64; 2]>) -> f64 {
    let (mut greatest, mut change) = (least, 0.0_f64);
    for [a, b] in pairs {
        greatest = greatest.max(a.abs()).max(b.abs());
        change = change.max((a - b).abs());
    }
    if greatest > 0.0 {
        change / greatest
    } else {
        0.0
    }
}

pub(super) fn impacts(outcome: &Outcome, contact: usize) -> impl Iterator<Item = &Impact> {
    let own = move |impact: &&Impact| impact.contact == contact;
    outcome.impacts.iter().filter(own)
}

fn peak_force(outcome: &Outcome, contact: usize) -> f64 {
    impacts(outcome, contact).fold(0.0, |most, impact| most.max(impact.peak_force))
}

fn impulse(outcome: &Outcome, contact: usize) -> f64 {
    impacts(outcome, contact).fold(0.0, |sum, impact| sum + impact.impulse)
}
