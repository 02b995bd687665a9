//! The verdict of a run in one sentence.

use jostle::judgement::OUTSIDE_DRIFT;
use jostle::results::isolation_bounds::{BoundedGap, IsolationBounds};
use jostle::results::summary::{
    BuildingSummary, ContactSummary, GapSummary, ImpactSummary, Summary,
};

use crate::format;
use crate::message;

/// The headline of the report: what happened, in a sentence or two.
#[must_use]
pub fn verdict(summary: &Summary) -> String {
    match &summary.isolation_bounds {
        Some(bounds) => {
            let nominal = message::with_nominal_bearings(happened(summary));
            match at_bounds(summary, bounds) {
                Some(more) => format!("{nominal} {more}"),
                None => nominal,
            }
        }
        None => happened(summary),
    }
}

/// Gaps that close at the bounds of the bearings alone.
fn at_bounds(summary: &Summary, bounds: &IsolationBounds) -> Option<String> {
    let gaps = summary.gaps.iter().zip(&bounds.gaps);
    let more =
        gaps.filter(|(gap, bounded)| gap.impact_count == 0 && bounded.impact_count.envelope > 0.0);
    let more: Vec<&BoundedGap> = more.map(|(_, bounded)| bounded).collect();
    let force = |gap: &BoundedGap| gap.peak_force_n.envelope;
    let hardest = more.iter().max_by(|a, b| force(a).total_cmp(&force(b)))?;
    let ([left, right], force) = (&hardest.between, format::force(force(hardest)));
    Some(match more.len() {
        1 => message::at_the_bounds_of_the_bearings(left, right, force),
        count => message::at_the_bounds_of_the_bearings_gaps(count, left, right, force),
    })
}

/// What happened in the run of the model itself.
fn happened(summary: &Summary) -> String {
    let pounding: Vec<&GapSummary> = summary
        .gaps
        .iter()
        .filter(|gap| gap.impact_count > 0)
        .collect();
    let quiet = summary.gaps.len() - pounding.len();
    match (&summary.gaps[..], &pounding[..]) {
        ([], _) => alone(summary),
        ([_], [gap]) => sentence_of(summary, gap),
        ([gap], []) => approach(gap, message::no_contact_but()),
        (gaps, []) => {
            let nearest = gaps
                .iter()
                .filter(|gap| closest_approach(gap).is_some())
                .min_by(|a, b| {
                    let distance = |gap| closest_approach(gap).unwrap_or(f64::INFINITY);
                    distance(a).total_cmp(&distance(b))
                });
            match nearest {
                Some(gap) => approach(gap, &message::no_contact_in_any(gaps.len())),
                None => message::no_contact_in_any_of_gaps(gaps.len()),
            }
        }
        (_, gaps) if gaps.len() <= 2 => {
            let mut text: Vec<String> = gaps.iter().map(|gap| sentence_of(summary, gap)).collect();
            if quiet > 0 {
                text.push(match quiet {
                    1 => message::the_other_gap_stays_open().into(),
                    n => message::the_other_gaps_stay_open(n),
                });
            }
            text.join(" ")
        }
        (all, gaps) => {
            let hardest = gaps
                .iter()
                .max_by(|a, b| a.peak_force_n.total_cmp(&b.peak_force_n));
            message::of_gaps_close(
                gaps.len(),
                all.len(),
                hardest.map_or_else(String::new, |gap| sentence_of(summary, gap)),
            )
        }
    }
}

/// Whether a building drifts further than its model holds (check B2).
pub(crate) fn is_outside(building: &BuildingSummary) -> bool {
    building.greatest_drift() > OUTSIDE_DRIFT
}

/// What stands above results that are outside the model; `None` within it.
pub(crate) fn outside(summary: &Summary) -> Option<String> {
    let buildings = summary
        .buildings
        .iter()
        .filter(|building| is_outside(building));
    let found: Vec<String> = buildings
        .map(|building| {
            message::drift_of(&building.name, format::percent(building.greatest_drift()))
        })
        .collect();
    let limit = format::percent(OUTSIDE_DRIFT);
    (!found.is_empty()).then(|| message::results_are_outside(found.join(", "), limit))
}

fn alone(summary: &Summary) -> String {
    let roof = summary.buildings.iter().filter_map(|building| {
        let roof = building.floors.last()?;
        Some((&building.name, roof.response.displacement_peak_m()))
    });
    match roof.max_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((name, sway)) => {
            message::has_a_peak_roof_displacement(name, format::millimetres(sway))
        }
        None => message::nothing_was_recorded().into(),
    }
}

/// "J1 and J2: 4 impacts …" for a gap with at least one impact.
fn sentence_of(summary: &Summary, gap: &GapSummary) -> String {
    let [left, right] = &gap.between;
    let all = || {
        gap.contacts
            .iter()
            .flat_map(|contact| contact.impacts.iter().map(move |impact| (contact, impact)))
    };
    let first = all().min_by(|a, b| a.1.start_s.total_cmp(&b.1.start_s));
    let hardest = all().max_by(|a, b| a.1.peak_force_n.total_cmp(&b.1.peak_force_n));
    let (Some((first_at, first)), Some((hardest_at, hardest))) = (first, hardest) else {
        return message::impacts_with_up_to(
            left,
            right,
            impacts(gap.impact_count),
            format::force(gap.peak_force_n),
        );
    };
    let force = |impact: &ImpactSummary| format::force(impact.peak_force_n);
    let at = |impact: &ImpactSummary| format::instant(impact.start_s);
    if gap.impact_count == 1 {
        return message::and_one_impact(
            left,
            right,
            place(summary, gap, first_at),
            at(first),
            force(first),
        );
    }
    let head = message::impacts_of_both(left, right, impacts(gap.impact_count));
    let (first_place, hardest_place) = (
        place(summary, gap, first_at),
        place(summary, gap, hardest_at),
    );
    let start = format!("{} ({first_place})", at(first));
    if hardest == first {
        message::the_first_impact(&head, &start, force(hardest))
    } else {
        message::first_at_peak_force(
            &head,
            &start,
            format::instant(hardest.peak_force_at_s),
            &hardest_place,
            force(hardest),
        )
    }
}

fn approach(gap: &GapSummary, head: &str) -> String {
    match closest_approach(gap) {
        Some(distance) => message::the_smallest_distance_between(
            head,
            &gap.between[0],
            &gap.between[1],
            format::millimetres(distance),
        ),
        None => message::no_contact().into(),
    }
}

/// Smallest distance between the two sides of a gap \[m\].
pub(crate) fn closest_approach(gap: &GapSummary) -> Option<f64> {
    nearest(gap).map(|contact| contact.width_m - contact.closing_peak_m)
}

/// The contact of a gap with the smallest distance or the largest indentation.
pub(crate) fn nearest(gap: &GapSummary) -> Option<&ContactSummary> {
    let known = gap.contacts.iter().filter(|c| c.closing_peak_m.is_finite());
    known.max_by(|a, b| {
        let depth = |c: &ContactSummary| c.closing_peak_m - c.width_m;
        depth(a).total_cmp(&depth(b))
    })
}

/// Greatest closing there \[m\].
pub(crate) fn peak_closing(gap: &GapSummary) -> Option<f64> {
    nearest(gap).map(|contact| contact.closing_peak_m)
}

/// Where a contact is: "floor 5", "floors 5 and 4", "floor 5 of Old against a column of New, height 4.80 m", in space "column 1.2".
pub(crate) fn place(summary: &Summary, gap: &GapSummary, contact: &ContactSummary) -> String {
    let [left, right] = &gap.between;
    // Sides that are no buildings are walls; the rigid one at an end of the row has no name of its own.
    let wall = |side: &String| {
        let is_building = summary.buildings.iter().any(|own| own.name == *side);
        let rigid = || message::the_wall().to_owned();
        (!is_building).then(|| {
            if side == "wall" {
                rigid()
            } else {
                side.clone()
            }
        })
    };
    match (contact.floors, wall(left), wall(right)) {
        ([_, Some(0)], Some(wall), _) => return message::mat_against_wall(right, wall),
        ([Some(0), _], _, Some(wall)) => return message::mat_against_wall(left, wall),
        ([_, Some(floor)], Some(wall), _) => {
            return message::floor_against_wall(floor, right, wall);
        }
        ([Some(floor), _], _, Some(wall)) => return message::floor_against_wall(floor, left, wall),
        _ => {}
    }
    let height = message::height_m(format::in_unit(format::HEIGHT, contact.height_m, 2));
    let column = contact
        .struck_column
        .as_ref()
        .map_or_else(|| message::a_column().to_owned(), message::column_at_line);
    match contact.floors {
        [Some(0), Some(0)] => message::mats().to_owned(),
        [Some(0), None] | [None, Some(0)] => message::mat().to_owned(),
        [Some(left), Some(right)] if left == right => message::floor_one(left),
        [Some(left), Some(right)] => message::floors_and(left, right),
        [Some(floor), None] => message::floor_against_column(floor, left, column, right, height),
        [None, Some(floor)] => message::floor_against_column(floor, right, column, left, height),
        [None, None] => height,
    }
}

fn impacts(count: usize) -> String {
    match count {
        1 => message::single_impact().into(),
        n => message::several_impacts(format::fixed(n as f64, 0)),
    }
}
