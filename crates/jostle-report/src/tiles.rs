//! The answers of a run, at the head of its page: how sure they are, how much gap, what is hurt, where, and what is left.

use jostle::results::contact_sensitivity::GapSpread;
use jostle::results::summary::{FloorSummary, GapSummary, MemberSummary, StruckSummary, Summary};
use maud::{Markup, html};

use crate::damage::{Damage, damage, footing_name};
use crate::devices::isolated;
use crate::pounding_effect::{Worst, worst};
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
    tiles.extend(effect(summary));
    tiles.extend(drift(summary));
    tiles.extend(failed(summary));
    tiles.extend(members(summary));
    tiles.extend(levels(summary));
    tiles.extend(strains(summary));
    tiles.extend(fallen(summary));
    tiles.extend(struck_column(summary));
    tiles.extend(damaged(page));
    tiles.extend(strokes(page));
    tiles.extend(lifted(summary));
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
            @if unknown {
                @let text = message::numerical_error_alone();
                @let (before, after) = text.split_once("--sensitivity").unwrap_or((text, ""));
                " " b { (before) span.option { "--sensitivity" } (after) }
            }
        }
    }
}

/// What pounding hurts most.
fn effect(summary: &Summary) -> Option<Tile> {
    let Worst { ratio, what } = worst(summary)?;
    let touched = summary.gaps.iter().any(|gap| gap.impact_count > 0);
    let value = message::times_without(format::fixed(ratio, 2));
    touched.then(|| tile(message::worst_effect(), value, what))
}

/// Columns that failed in shear, of those that can.
fn failed(summary: &Summary) -> Option<Tile> {
    let buildings = summary.buildings.iter();
    let all = buildings.filter_map(|building| building.shear_failures.as_ref());
    let total = all.clone().map(|all| all.total).sum::<usize>();
    let some = all.clone().map(|all| all.failed).sum::<usize>();
    let first = all.filter_map(|all| all.first_s).reduce(f64::min);
    let note = first.map_or_else(String::new, |first| {
        message::first_at(format::instant(first))
    });
    (total > 0).then(|| {
        tile(
            message::columns_failed(),
            message::one_of_all(some, total),
            note,
        )
    })
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
    let gaps = &mut summary.gaps.iter();
    summary.gap_needed_at_bounds_m(gaps.position(|other| std::ptr::eq(other, gap))?)
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
        let mut note = message::storey_of(&building.name, floor.floor);
        let along = floor.response.storey_drift_peak;
        if floor
            .in_plan
            .is_some_and(|plan| of(floor) > along.max(plan.storey_drift_across_peak))
        {
            note += message::at_a_corner();
        }
        let value = format::unit(format::fixed(100.0 * of(floor), 2), "%");
        Some(tile(name, value, note))
    };
    let yields = summary
        .buildings
        .iter()
        .any(|building| building.hinges.yielded > 0);
    let left = yields.then(|| of(message::residual_drift(), &residual));
    let bounds = summary.isolation_bounds.as_ref().and_then(|bounds| {
        let buildings = bounds.buildings.iter();
        buildings.max_by(|a, b| a.drift.envelope.total_cmp(&b.drift.envelope))
    });
    let peak = match bounds {
        Some(building) => Some(tile(
            message::greatest_drift(),
            format::unit(format::fixed(100.0 * building.drift.envelope, 2), "%"),
            format!("{}; {}", building.name, message::greatest_over_bounds()),
        )),
        None => of(message::greatest_drift(), &FloorSummary::greatest_drift),
    };
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
    let [beyond, all] = rated.fold([0; 2], |[beyond, all], (_, capacity)| {
        [beyond + capacity.exceeded, all + capacity.rated]
    });
    let buildings = summary.buildings.iter();
    let members: usize = buildings.map(|building| building.members.len()).sum();
    let unrated = members.saturating_sub(all);
    let member = &worst.1.worst;
    let ratio = format::fixed(member.ratio, 2);
    let mut note = message::worst_member(&member.member, member.kind, ratio);
    if unrated > 0 {
        note += &message::without_known_capacity(unrated);
    }
    let value = message::one_of_all(beyond, all);
    Some(tile(message::members_beyond_capacity(), value, note))
}

/// Members beyond stated limits of rotation, by level, and the worst of them.
fn levels(summary: &Summary) -> Option<Tile> {
    let levels = summary.buildings.iter();
    let levels = levels.filter_map(|building| building.rotation_levels.as_ref());
    let worst = levels
        .clone()
        .filter_map(|all| all.list.first())
        .max_by(|a, b| a.ratio.total_cmp(&b.ratio))?;
    let beyond = levels.clone().fold([0; 3], |[io, ls, cp], all| {
        [io + all.beyond_io, ls + all.beyond_ls, cp + all.beyond_cp]
    });
    let members = levels.map(|all| all.members).sum::<usize>();
    let value = beyond.map(|count| count.to_string()).join(" / ");
    let ratio = format::fixed(worst.ratio, 2);
    let note = message::worst_of_members(members, &worst.member, ratio);
    Some(tile(message::members_beyond_io_ls_cp(), value, note))
}

/// Ends of columns of fibres beyond strains that are judged, and when the first was.
fn strains(summary: &Summary) -> Option<Tile> {
    let buildings = summary.buildings.iter();
    let all = buildings.filter_map(|building| building.strains.as_ref());
    let worst = all.clone().map(|all| all.ratio).reduce(f64::max)?;
    let ends = all.clone().map(|all| all.ends).sum::<usize>();
    let passed = summary
        .buildings
        .iter()
        .flat_map(|building| &building.sections);
    let passed = passed.filter(|end| end.limits.iter().any(|limit| limit.passed_s.is_some()));
    let first = all.filter_map(|all| all.first_s).reduce(f64::min);
    let note = match first {
        Some(first) => message::first_at(format::instant(first)),
        None => message::greatest_over_limit(format::fixed(worst, 2)),
    };
    let value = message::one_of_all(passed.count(), ends);
    Some(tile(message::ends_beyond_strains(), value, note))
}

/// Infill panels that fell out, where any did.
fn fallen(summary: &Summary) -> Option<Tile> {
    let buildings = summary.buildings.iter();
    let panels = buildings.filter_map(|building| building.panels.as_ref());
    let fallen = panels.clone().map(|all| all.fallen).sum::<usize>();
    let total = panels.clone().map(|all| all.total).sum::<usize>();
    let first = panels.filter_map(|all| all.first_fall_s).reduce(f64::min)?;
    Some(tile(
        message::panels_fallen(),
        message::one_of_all(fallen, total),
        message::first_at(format::instant(first)),
    ))
}

/// Of the columns that a neighbour struck between floors, the one with the greatest demand over capacity, or with the hardest
/// impact where no capacity is known.
fn struck_column(summary: &Summary) -> Option<Tile> {
    let (hardest, ratio) = (MemberSummary::struck_force_n, MemberSummary::greatest_ratio);
    let members = summary
        .buildings
        .iter()
        .flat_map(|building| &building.members);
    let struck = members.filter(|member| hardest(member) > 0.0);
    let worst = struck.clone().max_by(|a, b| {
        let of = |member| (ratio(member).unwrap_or(0.0), hardest(member));
        let ((a, a_force), (b, b_force)) = (of(a), of(b));
        a.total_cmp(&b).then(a_force.total_cmp(&b_force))
    })?;
    let count = worst
        .struck
        .iter()
        .map(|point: &StruckSummary| point.impact_count);
    let impacts = message::struck_up_to(count.sum::<usize>(), format::force(hardest(worst)));
    let note = format!("{}, {impacts}", worst.name);
    // A column without a known capacity may be worse.
    let unrated =
        struck.filter(|member| ratio(member).is_none() && hardest(member) > hardest(worst));
    let harder = unrated.max_by(|a, b| hardest(a).total_cmp(&hardest(b)));
    let (value, note) = match (ratio(worst), harder) {
        (None, _) => (
            format::force(hardest(worst)),
            message::capacity_unknown(note),
        ),
        (Some(ratio), None) => (message::times_its_capacity(format::fixed(ratio, 2)), note),
        (Some(ratio), Some(harder)) => (
            message::times_its_capacity(format::fixed(ratio, 2)),
            message::harder_without_capacity(note, &harder.name, format::force(hardest(harder))),
        ),
    };
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

/// Displacements of bearings, the greatest over the bounds of their properties where those were run.
fn strokes(page: &Page) -> Vec<Tile> {
    let bounds = page.summary.isolation_bounds.as_ref();
    let tiles = isolated(page).map(|(index, isolation, result)| {
        let bounded = bounds.and_then(|bounds| bounds.buildings.get(index)?.stroke_m);
        let nominal = match &result.in_plan {
            Some(in_plan) => in_plan.stroke_peak_m,
            None => result.displacement_peak_m(),
        };
        let limit = isolation.reach().map(format::millimetres);
        let limit = limit.map_or_else(String::new, message::bearings_reach);
        let note = match bounded {
            Some(_) if limit.is_empty() => message::greatest_over_bounds().to_owned(),
            Some(_) => format!("{limit}; {}", message::greatest_over_bounds()),
            None => limit,
        };
        let stroke = bounded.map_or(nominal, |bounded| bounded.envelope);
        let name = &page.summary.buildings[index].name;
        tile(message::stroke_of(name), format::millimetres(stroke), note)
    });
    let tiles: Vec<Tile> = tiles.collect();
    if tiles.len() <= MOST_EACH {
        tiles
    } else {
        Vec::new()
    }
}

/// The footing of each building that rises furthest, and how long it is off the ground.
fn lifted(summary: &Summary) -> Vec<Tile> {
    let tiles = summary.buildings.iter().filter_map(|building| {
        let lifts = building.parts.iter().filter_map(|part| {
            let share = part.lifted_share.filter(|share| *share > 0.0)?;
            Some((part, share))
        });
        let (part, share) =
            lifts.max_by(|a, b| a.0.deformation_max.total_cmp(&b.0.deformation_max))?;
        Some(tile(
            message::rise_of(footing_name(&part.name)),
            format::millimetres(part.deformation_max),
            message::off_the_ground_for(
                format::percent(share),
                format::unit(format::fixed(share * summary.motion.duration_s, 1), "s"),
            ),
        ))
    });
    let tiles: Vec<Tile> = tiles.collect();
    if tiles.len() <= MOST_EACH {
        tiles
    } else {
        Vec::new()
    }
}

/// The hardest impact, and how many there are.
fn impacts(summary: &Summary) -> Vec<Tile> {
    let count: usize = summary.gaps.iter().map(|gap| gap.impact_count).sum();
    if summary.gaps.is_empty() {
        return Vec::new();
    }
    let bounded = summary.isolation_bounds.as_ref();
    if count == 0 {
        let note = bounded.map_or("", |_| message::of_nominal_bearings());
        let mut tiles = vec![tile(message::impacts_title(), message::none(), note)];
        // Of bearings at their bounds alone.
        let forces = bounded.iter().flat_map(|bounds| &bounds.gaps);
        let force = forces
            .map(|gap| gap.peak_force_n.envelope)
            .fold(0.0, f64::max);
        if force > 0.0 {
            let at = message::greatest_over_bounds();
            tiles.insert(
                0,
                tile(message::peak_force_title(), format::force(force), at),
            );
        }
        return tiles;
    }
    let contacts = summary.gaps.iter().flat_map(|gap| {
        let contacts = gap.contacts.iter();
        contacts.map(move |contact| (gap, contact))
    });
    let hardest = contacts.max_by(|a, b| a.1.peak_force_n.total_cmp(&b.1.peak_force_n));
    let bounds = summary.isolation_bounds.as_ref().map(|bounds| {
        let forces = bounds.gaps.iter().map(|gap| gap.peak_force_n.envelope);
        forces.fold(0.0, f64::max)
    });
    let nominal = hardest.map_or(0.0, |(_, contact)| contact.peak_force_n);
    let force = bounds.unwrap_or(nominal);
    let first = summary.gaps.iter().filter_map(|gap| gap.first_impact_s);
    let first = first.min_by(f64::total_cmp);
    let mut at = hardest.map_or_else(String::new, |(gap, contact)| {
        let at = place(summary, gap, contact);
        match summary.gaps.len() {
            1 => at,
            _ => format!("{} ↔ {}, {at}", gap.between[0], gap.between[1]),
        }
    });
    // Several floors in contact press at the same time.
    let together = hardest.map_or(0.0, |(gap, _)| gap.total_force_peak_n);
    if together > 1.005 * nominal {
        at = message::together_force(at, format::force(together));
    }
    if let Some([least, most]) = force_range(summary) {
        at = message::with_force_range(at, format::force(least), format::force(most));
    }
    if bounds.is_some() {
        at = format!("{at}; {}", message::greatest_over_bounds());
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
        let of = |value| format::in_unit(format::LENGTH, value, 1);
        let [least, most] = [roof.displacement_min_m, roof.displacement_max_m].map(of);
        let range = format!("{least} / +{most}\u{a0}{}", format::LENGTH.name());
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
    let along = message::name_and_peak(&summary.motion.name, peak);
    let motions = match (&summary.motion.across, summary.motion.pga_across_m_s2) {
        (Some(across), Some(peak)) => {
            let peak = format::short(format::ACCELERATION, peak, 3);
            message::along_and_across(along, message::name_and_peak(across, peak))
        }
        _ => along,
    };
    message::under_the_motion(
        motions,
        format::significant(summary.energy.worst_imbalance, 2),
    )
}
