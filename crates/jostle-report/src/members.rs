//! Greatest forces of columns and beams, and their demand over capacity: one table for each building, struck columns first.

use jostle::Structure;
use jostle::linear::sort_by;
use jostle::model::capacity_rule_title;
use jostle::results::summary::{
    BuildingSummary, CapacitySummary, ExceededSummary, ImpactPlace, JointSummary, MemberSummary,
    RatioPlace, SectionSummary,
};
use jostle_section::capacity::CapacityRule;
use maud::{Markup, html};

use crate::message;
use crate::{Page, format};

/// Ratio from which there is next to no capacity to divide by.
const NO_CAPACITY: f64 = 1e6;
/// Most rows of a table.
const MOST_ROWS: usize = 400;

/// Rows of a table on paper, as in the style sheet.
const PRINTED_ROWS: usize = 40;

/// The section; `None` where no forces of members were asked for.
pub(crate) fn section(page: &Page) -> Option<Markup> {
    let asked = page.summary.buildings.iter().any(|b| !b.members.is_empty());
    let mut rated = page
        .summary
        .buildings
        .iter()
        .filter_map(|b| b.capacity.as_ref());
    let rule = rated
        .next()
        .and_then(|capacity| CapacityRule::from_name(capacity.rule));
    let members = page.summary.buildings.iter().flat_map(|b| &b.members);
    let in_space = members
        .flat_map(sections)
        .any(|section| section.across.is_some());
    asked.then(|| {
        html! {
            section #members {
                h2 { (message::columns_and_beams()) }
                @if let Some(rule) = rule {
                    @for capacity in page.summary.buildings.iter().filter_map(|b| Some((&b.name, b.capacity.as_ref()?))) {
                        p { (verdict(page, capacity.0, capacity.1)) }
                    }
                    p.quiet {
                        (message::capacity_by_with_the_strengths(rule.source()))
                    }
                }
                @for (index, building) in page.summary.buildings.iter().enumerate().filter(|(_, b)| !b.members.is_empty()) {
                    (table(page, building))
                    @if let Some(diagrams) = crate::diagrams::of_building(page, index) { (diagrams) }
                    @if !building.joints.is_empty() { (joints(building)) }
                }
                @if page.summary.buildings.iter().flat_map(|b| &b.members).any(|m| !m.acceptance.is_empty()) {
                    p.quiet {
                        (message::rotations_of_yielding_ends_chord())
                    }
                }
                p.quiet {
                    (message::greatest_forces_of_every_member())
                    @if in_space { " " (message::greatest_of_both_planes_of_bending()) }
                }
            }
        }
    })
}

/// How many members are beyond their capacity, and which.
fn verdict(page: &Page, name: &str, capacity: &CapacitySummary) -> String {
    let place = |exceedance: &ExceededSummary| {
        let during = exceedance
            .impact
            .as_ref()
            .map_or_else(String::new, |impact| {
                let height = format::plain(format::HEIGHT.of(impact.height_m), 4);
                message::during_the_impact(
                    &impact.between[0],
                    &impact.between[1],
                    place_of_impact(impact),
                    height,
                    format::instant(impact.start_s),
                )
            });
        let at = format::instant(exceedance.at_s);
        message::in_at(
            member_name(page, &exceedance.member),
            exceedance.kind,
            exceedance.at,
            &at,
            &during,
        )
    };
    let worst = message::greatest_ratio_title(
        format::fixed(capacity.worst.ratio, 2),
        place(&capacity.worst),
    );
    match &capacity.first {
        Some(first) => message::of_members_are_beyond(
            name,
            capacity.exceeded,
            capacity.rated,
            capacity.exceeded_in_shear,
            place(first),
            &worst,
        ),
        None => message::none_of_members_is_beyond(name, capacity.rated, &worst),
    }
}

/// Whether an impact strikes the member that is spoken of, or lies elsewhere, as a part of a sentence; empty if that is not known.
pub(crate) fn place_of_impact(impact: &ImpactPlace) -> &'static str {
    match impact.on_member {
        Some(true) => message::impact_on_it(),
        Some(false) => message::impact_elsewhere(),
        None => "",
    }
}

/// Name of a member: a storey of a wall, whose results are those of a column on its axis, is named as the wall.
fn member_name(page: &Page, name: &str) -> String {
    let wall = || {
        let (of, place) = name.split_once(".column.")?;
        let (line, storey) = place.split_once('.')?;
        let [line, storey] = [line.parse::<usize>().ok()?, storey.parse::<usize>().ok()?];
        let mut buildings = page.model.buildings.iter();
        match &buildings.find(|building| building.name == of)?.structure {
            Structure::Frame(frame) => frame.wall([storey - 1, line - 1])?,
            _ => return None,
        };
        Some(message::wall_member(of, line, storey))
    };
    wall().unwrap_or_else(|| name.to_owned())
}

/// A ratio of demand to capacity; its place is shown on hovering.
fn ratio(value: Option<f64>, place: Option<&RatioPlace>) -> Markup {
    let Some((value, place)) = value.zip(place) else {
        return html! { td.number { (format::NOTHING) } };
    };
    let class = match value {
        v if v > 1.0 => "number ratio-beyond",
        v if v > 0.8 => "number ratio-near",
        _ => "number",
    };
    let title = format!("{}, {}", place.at, format::instant(place.at_s));
    let text = if value < NO_CAPACITY {
        format::fixed(value, 2)
    } else {
        message::no_capacity().to_owned()
    };
    html! { td class=(class) title=(title) { (text) } }
}

/// A peak with contact over that without.
fn amplification(value: Option<f64>) -> Markup {
    html! { td.number { (value.map_or_else(|| format::NOTHING.to_owned(), |value| format::fixed(value, 2))) } }
}

/// Levels of performance that the rotations of the ends keep, rule by rule.
fn levels(member: &MemberSummary) -> Markup {
    let beyond = member
        .acceptance
        .iter()
        .any(|acceptance| acceptance.level.is_none());
    let texts = member.acceptance.iter().map(|acceptance| {
        let last = acceptance.limits.last().map_or("", |limit| limit.level);
        match acceptance.level {
            Some(level) => level.to_owned(),
            None => message::beyond_last(last),
        }
    });
    let title = member.acceptance.iter().map(|acceptance| {
        let milliradians = format::significant(acceptance.rotation_rad * 1e3, 3);
        message::mrad_at(
            acceptance.rule,
            acceptance.measure,
            &milliradians,
            acceptance.at,
        )
    });
    let (texts, title): (Vec<_>, Vec<_>) = (texts.collect(), title.collect());
    html! {
        td class=[beyond.then_some("ratio-beyond")] title=(title.join("; ")) { (texts.join(" · ")) }
    }
}

fn sections(member: &MemberSummary) -> impl Iterator<Item = &SectionSummary> {
    let struck = member.struck.iter();
    member
        .ends
        .iter()
        .chain(struck.flat_map(|s| [&s.below, &s.above]))
}

fn greatest(member: &MemberSummary, of: fn(&SectionSummary) -> f64) -> f64 {
    sections(member).map(of).fold(f64::NEG_INFINITY, f64::max)
}

fn table(page: &Page, building: &BuildingSummary) -> Markup {
    let hit = |m: &&MemberSummary| m.struck.iter().map(|s| s.peak_force_n).fold(0.0, f64::max);
    let shear = |m: &MemberSummary| {
        greatest(m, |s| {
            s.across.map_or(s.shear_peak_n, |across| {
                s.shear_peak_n.max(across.shear_across_peak_n)
            })
        })
    };
    let moment = |m: &MemberSummary| {
        greatest(m, |s| {
            s.across.map_or(s.moment_peak_n_m, |across| {
                s.moment_peak_n_m.max(across.moment_across_peak_n_m)
            })
        })
    };
    let mut members: Vec<&MemberSummary> = building.members.iter().collect();
    sort_by(&mut members, |a, b| {
        let (x, y) = (hit(a), hit(b));
        y.total_cmp(&x).then(shear(b).total_cmp(&shear(a)))
    });
    let is_rated = building.capacity.is_some();
    let is_compared = building.members.iter().any(|m| m.compared.is_some());
    let turns = building.members.iter().any(|m| !m.acceptance.is_empty());
    if is_rated {
        let ratio = |m: &MemberSummary| {
            let ratio = m.ratio.as_ref();
            ratio.map_or(0.0, |ratio| ratio.bending.max(ratio.shear.unwrap_or(0.0)))
        };
        sort_by(&mut members, |a, b| ratio(b).total_cmp(&ratio(a)));
    }
    let all = members.len();
    members.truncate(MOST_ROWS);
    let columns = [
        (message::greatest_tension(), format::FORCE.name()),
        (message::greatest_compression(), format::FORCE.name()),
        (message::shear(), format::FORCE.name()),
        (message::moment(), format::MOMENT.name()),
    ];
    html! {
        details.peaks.long open[is_rated || members.iter().any(|m| hit(m) > 0.0)] {
            summary { (message::columns_and_beams_title(&building.name)) }
            @if all > MOST_ROWS {
                p.quiet { (message::of_members_summary_json(MOST_ROWS, all)) }
            }
            @if members.len() > PRINTED_ROWS {
                p.quiet.on-paper { (message::members_on_paper(PRINTED_ROWS, all)) }
            }
            div.scroll {
                table {
                    thead { tr {
                        th scope="col" { (message::member()) }
                        // What is judged stands where narrow screens and paper show it.
                        @if is_rated {
                            th.number scope="col" { (message::shear()) br; (message::over_capacity()) }
                            th.number scope="col" { (message::moment()) br; (message::over_capacity()) }
                        }
                        @if turns { th scope="col" { (message::rotation_within()) } }
                        th.number scope="col" { (message::impacts()) }
                        th.number scope="col" { (message::contact_force()) br; span.unit { (format::FORCE.bracketed()) } }
                        @for (name, unit) in columns {
                            th.number scope="col" { (name) br; span.unit { "[" (unit) "]" } }
                        }
                        @if is_compared {
                            th.number scope="col" { (message::shear()) br; (message::over_without_contact()) }
                            th.number scope="col" { (message::moment()) br; (message::over_without_contact()) }
                        }
                    } }
                    tbody {
                        @for member in &members {
                            @let impacts: usize = member.struck.iter().map(|s| s.impact_count).sum();
                            tr {
                                th scope="row" { (member_name(page, &member.name)) }
                                @if is_rated {
                                    @let own = member.ratio.as_ref();
                                    (ratio(own.and_then(|r| r.shear), own.and_then(|r| r.shear_at.as_ref())))
                                    (ratio(own.map(|r| r.bending), own.map(|r| &r.bending_at)))
                                }
                                @if turns { (levels(member)) }
                                @if impacts > 0 {
                                    td.number { (impacts) }
                                    td.number { (format::significant(format::FORCE.of(hit(member)), 4)) }
                                } @else {
                                    td.number { (format::NOTHING) }
                                    td.number { (format::NOTHING) }
                                }
                                td.number { (kilo(greatest(member, |s| s.axial_max_n).max(0.0))) }
                                td.number { (kilo(greatest(member, |s| -s.axial_min_n).max(0.0))) }
                                td.number { (kilo(shear(member))) }
                                td.number { (format::in_unit(format::MOMENT, moment(member), 1)) }
                                @if is_compared {
                                    @let own = member.compared.as_ref();
                                    (amplification(own.and_then(|m| m.shear_amplification)))
                                    (amplification(own.and_then(|m| m.moment_amplification)))
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Shear in the cores of joints, the greatest ratio first.
fn joints(building: &BuildingSummary) -> Markup {
    let ratio_of = |joint: &JointSummary| {
        let all = joint.ratio.iter().chain(&joint.other_ratios);
        all.map(|ratio| ratio.shear).next().unwrap_or(0.0)
    };
    let mut joints: Vec<&JointSummary> = building.joints.iter().collect();
    sort_by(&mut joints, |a, b| ratio_of(b).total_cmp(&ratio_of(a)));
    let all = joints.len();
    joints.truncate(MOST_ROWS);
    let first = building.joints.first();
    let rules: Vec<&str> = first
        .into_iter()
        .flat_map(|joint| joint.ratio.iter().chain(&joint.other_ratios))
        .map(|ratio| ratio.rule)
        .collect();
    let beyond = building.joints.iter().filter(|joint| ratio_of(joint) > 1.0);
    let beyond = beyond.count();
    html! {
        details.peaks.long open[beyond > 0] {
            summary { (message::joints_of_beams_and_columns(&building.name, beyond, all, capacity_rule_title(rules.first().unwrap_or(&"")))) }
            @if all > MOST_ROWS {
                p.quiet { (message::of_joints_summary_json(MOST_ROWS, all)) }
            }
            @if joints.len() > PRINTED_ROWS {
                p.quiet.on-paper { (message::joints_on_paper(PRINTED_ROWS, all)) }
            }
            div.scroll {
                table {
                    thead { tr {
                        th scope="col" { (message::joint()) }
                        th.number scope="col" { (message::shear_of_the_core()) br; span.unit { (format::FORCE.bracketed()) } }
                        @for rule in &rules { th.number scope="col" { (message::shear_capacity()) br; (capacity_rule_title(rule)) } }
                    } }
                    tbody {
                        @for joint in &joints {
                            tr {
                                th scope="row" { (joint.name) }
                                td.number { (kilo(joint.shear_peak_n)) }
                                @for own in joint.ratio.iter().chain(&joint.other_ratios) {
                                    (ratio(Some(own.shear), Some(&own.shear_at)))
                                }
                            }
                        }
                    }
                }
            }
            p.quiet {
                (message::shear_of_the_core_by_equilibrium())
            }
        }
    }
}

fn kilo(value: f64) -> String {
    format::in_unit(format::FORCE, value, 1)
}
