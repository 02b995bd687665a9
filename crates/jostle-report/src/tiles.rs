//! The answers of a run, at the head of its page: how sure they are, how much gap, what is hurt, where, and what is left.

use jostle::results::contact_sensitivity::GapSpread;
use jostle::results::summary::{FloorSummary, GapSummary, MemberSummary, StruckSummary, Summary};
use maud::{Markup, html};

use crate::damage::{Damage, damage};
use crate::verdict::{closest_approach, nearest, outside, peak_closing, place};
use crate::{Page, format, message};

/// Most gaps, and most buildings, that have tiles each; of more, the worst stands for all.
const MOST_EACH: usize = 2;

/// A number with its name and what it refers to.
struct Tile {
    name: String,
    value: String,
    note: String,
}

/// The tiles, and the motion they hold for.
pub(crate) fn tiles(page: &Page) -> Markup {
    let summary = page.summary;
    let mut tiles = gaps(summary);
    tiles.extend(drift(summary));
    tiles.extend(members(summary));
    tiles.extend(struck_column(summary));
    tiles.extend(damaged(page));
    tiles.extend(impacts(summary));
    tiles.extend(roofs(summary));
    html! {
        (accuracy(summary))
        div.tiles.muted[outside(summary).is_some()] {
            @for Tile { name, value, note } in &tiles {
                div.tile { p.tile-name { (name) } p.tile-value { (value) } p.tile-note { (note) } }
            }
        }
        p.quiet { (motion(summary)) }
    }
}

/// How sure the numbers are.
fn accuracy(summary: &Summary) -> Markup {
    let words = summary.promise.in_words();
    let words = words.strip_prefix("accuracy: ").unwrap_or(&words);
    // The law of contact is an assumption whose effect no step can show.
    let struck = summary.gaps.iter().any(|gap| gap.impact_count > 0);
    let unknown = struck && summary.contact_sensitivity.is_none();
    html! {
        p.quiet #accuracy {
            b { (message::accuracy()) " " } (words) "."
            @if unknown { " " (message::contact_law_is_not_included()) }
        }
    }
}

fn tile(name: impl Into<String>, value: impl Into<String>, note: impl Into<String>) -> Tile {
    Tile {
        name: name.into(),
        value: value.into(),
        note: note.into(),
    }
}

/// The gap that is needed beside that which there is; of many gaps, the one that lacks most.
fn gaps(summary: &Summary) -> Vec<Tile> {
    let lacking = |gap: &GapSummary| needed(summary, gap).map(|closing| closing - width(gap));
    let all = summary.gaps.iter();
    let shown: Vec<&GapSummary> = if summary.gaps.len() <= MOST_EACH {
        all.collect()
    } else {
        let worst = all.max_by(|a, b| {
            let of = |gap| lacking(gap).unwrap_or(f64::NEG_INFINITY);
            of(a).total_cmp(&of(b))
        });
        worst.into_iter().collect()
    };
    let tiles = shown.into_iter().map(|gap| {
        let pair = match summary.gaps.len() {
            1 => String::new(),
            _ => format!(", {} ↔ {}", gap.between[0], gap.between[1]),
        };
        let there = format::millimetres(width(gap));
        let bounds = match bounded(summary, gap) {
            Some(_) => message::over_the_bounds_of_bearings(),
            None => "",
        };
        match needed(summary, gap) {
            Some(needed) => {
                let spare = width(gap) - needed;
                let note = match spare < 0.0 {
                    true => message::gap_lacks(there, format::millimetres(-spare)),
                    false => message::gap_left(there, format::millimetres(spare)),
                };
                tile(
                    message::gap_needed(&pair),
                    format::millimetres(needed),
                    note + bounds,
                )
            }
            None => closing(gap, &pair),
        }
    });
    tiles.collect()
}

/// Gap needed, over nominal properties and bounds of bearings where they are stated \[m\].
fn needed(summary: &Summary, gap: &GapSummary) -> Option<f64> {
    bounded(summary, gap).or(gap.closing_without_contact_m)
}

/// The greatest over nominal properties and bounds of bearings \[m\].
fn bounded(summary: &Summary, gap: &GapSummary) -> Option<f64> {
    let index = summary
        .gaps
        .iter()
        .position(|other| std::ptr::eq(other, gap))?;
    let bounds = summary.isolation_bounds.as_ref()?.gaps.get(index)?;
    Some(bounds.closing_without_contact_m.as_ref()?.envelope)
}

/// How far a gap closed.
fn closing(gap: &GapSummary, pair: &str) -> Tile {
    let there = format::millimetres(width(gap));
    let left = closest_approach(gap).filter(|left| *left > 0.0 && gap.impact_count == 0);
    let note = match left {
        Some(left) => message::gap_left(there, format::millimetres(left)),
        None => message::gap_width(there),
    };
    let peak = peak_closing(gap).map_or(format::NOTHING.into(), format::millimetres);
    tile(message::peak_closing_title(pair), peak, note)
}

/// Width where a gap closes furthest \[m\].
fn width(gap: &GapSummary) -> f64 {
    nearest(gap).map_or(gap.width_m, |contact| contact.width_m)
}

/// The greatest drift of all buildings, and what is left of it where something yields.
fn drift(summary: &Summary) -> Vec<Tile> {
    let residual = |floor: &FloorSummary| floor.response.residual_drift.abs();
    let greatest = |of: &dyn Fn(&FloorSummary) -> f64| {
        let floors = summary.buildings.iter().flat_map(|building| {
            let storeys = building.floors.iter().filter(|floor| floor.floor > 0);
            storeys.map(move |floor| (building, floor))
        });
        floors.max_by(|a, b| of(a.1).total_cmp(&of(b.1)))
    };
    let of = |name: &str, of: &dyn Fn(&FloorSummary) -> f64| {
        let (building, floor) = greatest(of)?;
        let note = message::storey_of(&building.name, floor.floor);
        let value = format::unit(format::fixed(100.0 * of(floor), 2), "%");
        Some(tile(name, value, note))
    };
    let yields = summary
        .buildings
        .iter()
        .any(|building| building.hinges.yielded > 0);
    let left = yields.then(|| of(message::residual_drift_of_all(), &residual));
    let peak = of(message::greatest_drift(), &FloorSummary::greatest_drift);
    peak.into_iter().chain(left.flatten()).collect()
}

/// Members beyond their capacity, and the worst of them.
fn members(summary: &Summary) -> Option<Tile> {
    let rated = summary.buildings.iter().filter_map(|building| {
        let capacity = building.capacity.as_ref()?;
        Some((building, capacity))
    });
    let worst = rated
        .clone()
        .max_by(|a, b| a.1.worst.ratio.total_cmp(&b.1.worst.ratio))?;
    let (beyond, all) = rated.fold((0, 0), |(beyond, all), (_, capacity)| {
        (beyond + capacity.exceeded, all + capacity.rated)
    });
    let member = &worst.1.worst;
    let ratio = format::fixed(member.ratio, 2);
    let note = message::worst_member(&member.member, member.kind, ratio);
    let value = message::one_of_all(beyond, all);
    Some(tile(message::members_beyond_capacity(), value, note))
}

/// Of the columns that a neighbour struck between floors, the one with the greatest demand over capacity, or with the hardest
/// impact where no capacity is known.
fn struck_column(summary: &Summary) -> Option<Tile> {
    let hardest = |member: &MemberSummary| {
        let forces = member.struck.iter().map(|point| point.peak_force_n);
        forces.fold(0.0, f64::max)
    };
    let ratio = |member: &MemberSummary| {
        let ratio = member.ratio.as_ref()?;
        Some(ratio.bending.max(ratio.shear.unwrap_or(0.0)))
    };
    let members = summary
        .buildings
        .iter()
        .flat_map(|building| &building.members);
    let struck = members.filter(|member| hardest(member) > 0.0);
    let worst = struck.max_by(|a, b| {
        let of = |member| (ratio(member).unwrap_or(0.0), hardest(member));
        let ((a, a_force), (b, b_force)) = (of(a), of(b));
        a.total_cmp(&b).then(a_force.total_cmp(&b_force))
    })?;
    let count = worst
        .struck
        .iter()
        .map(|point: &StruckSummary| point.impact_count);
    let impacts = message::struck_up_to(count.sum::<usize>(), format::force(hardest(worst)));
    let value = match ratio(worst) {
        Some(ratio) => message::times_its_capacity(format::fixed(ratio, 2)),
        None => format::force(hardest(worst)),
    };
    let note = format!("{}, {impacts}", worst.name);
    Some(tile(message::worst_struck_column(), value, note))
}

/// What yielded, buckled and cracked: of few buildings each by itself, of many the worst of every kind.
fn damaged(page: &Page) -> Vec<Tile> {
    let buildings = page.model.buildings.iter().zip(&page.summary.buildings);
    let all: Vec<(&str, Damage)> = buildings
        .flat_map(|(model, summary)| {
            let found = damage(Some(model), summary).into_iter();
            found.map(|one| (&summary.name[..], one))
        })
        .collect();
    let worst = |one: &Damage| {
        let same = all
            .iter()
            .filter(|(_, candidate)| candidate.name == one.name);
        same.max_by_key(|(_, damage)| damage.count[0])
            .is_some_and(|(_, other)| other == one)
    };
    let few = |one: &Damage| {
        all.iter()
            .filter(|(_, candidate)| candidate.name == one.name)
            .count()
            <= MOST_EACH
    };
    let shown = all.iter().filter(|(_, one)| few(one) || worst(one));
    let tiles = shown.map(|(name, one)| {
        let [some, all] = one.count;
        let first = one.first_s.map(format::instant);
        let first = first.map_or_else(String::new, message::first_at);
        tile(
            message::damage_of(format::capital(one.name), name),
            message::one_of_all(some, all),
            match one.note.is_empty() {
                true => first,
                false => one.note.clone(),
            },
        )
    });
    tiles.collect()
}

/// The hardest impact, and how many there are.
fn impacts(summary: &Summary) -> Vec<Tile> {
    let count: usize = summary.gaps.iter().map(|gap| gap.impact_count).sum();
    if summary.gaps.is_empty() {
        return Vec::new();
    }
    if count == 0 {
        return vec![tile(message::impacts_title(), message::none(), "")];
    }
    let contacts = summary.gaps.iter().flat_map(|gap| {
        let contacts = gap.contacts.iter();
        contacts.map(move |contact| (gap, contact))
    });
    let hardest = contacts.max_by(|a, b| a.1.peak_force_n.total_cmp(&b.1.peak_force_n));
    let force = hardest.map_or(0.0, |(_, contact)| contact.peak_force_n);
    let first = summary.gaps.iter().filter_map(|gap| gap.first_impact_s);
    let first = first.min_by(f64::total_cmp);
    let mut at = hardest.map_or_else(String::new, |(gap, contact)| place(gap, contact));
    if let Some([least, most]) = force_range(summary) {
        at = message::with_force_range(at, format::force(least), format::force(most));
    }
    let mut tiles = vec![
        tile(message::peak_force_title(), format::force(force), at),
        tile(
            message::impacts_title(),
            format::fixed(count as f64, 0),
            first.map_or_else(String::new, |at| message::first_at(format::instant(at))),
        ),
    ];
    if let [gap] = &summary.gaps[..]
        && gap.closing_without_contact_m.is_some()
    {
        tiles.push(closing(gap, ""));
    }
    tiles
}

/// Least and greatest peak force of all gaps with other laws of contact, where they were run \[N\].
fn force_range(summary: &Summary) -> Option<[f64; 2]> {
    let gaps = &summary.contact_sensitivity.as_ref()?.gaps;
    let most = |of: fn(&GapSpread) -> f64| gaps.iter().map(of).fold(0.0, f64::max);
    Some([
        most(|gap| gap.peak_force_min_n),
        most(|gap| gap.peak_force_max_n),
    ])
}

/// Roof displacements of few buildings.
fn roofs(summary: &Summary) -> Vec<Tile> {
    let roofs = summary.buildings.iter().filter_map(|building| {
        let roof = building.floors.last()?.response;
        let range = format!(
            "{} / +{}",
            format::in_unit(format::LENGTH, roof.displacement_min_m, 1),
            format::millimetres(roof.displacement_max_m)
        );
        let peak = format::millimetres(roof.displacement_peak_m());
        Some(tile(message::roof_of(&building.name), peak, range))
    });
    let roofs: Vec<Tile> = roofs.collect();
    if roofs.len() <= MOST_EACH {
        roofs
    } else {
        Vec::new()
    }
}

/// The motion, and how well the energies balance.
fn motion(summary: &Summary) -> String {
    let pga = summary.motion.pga_m_s2;
    let peak = format::short(format::ACCELERATION, pga, 3);
    let peak = match format::units() {
        format::Units::Si => {
            let share = format::significant(pga / format::STANDARD_GRAVITY * 100.0, 3);
            format!("{peak} ({share} % g)")
        }
        // It is in g.
        format::Units::Us => peak,
    };
    message::under_the_motion(
        match (&summary.motion.across, summary.motion.pga_across_m_s2) {
            (Some(across), Some(peak)) => message::name_and_across(
                &summary.motion.name,
                across,
                format::short(format::ACCELERATION, peak, 3),
            ),
            _ => summary.motion.name.clone(),
        },
        peak,
        format::significant(summary.energy.worst_imbalance, 2),
    )
}
