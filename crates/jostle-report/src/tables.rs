//! Tables of impacts and of peaks of every floor.

use jostle::contact::{LawKind, RestitutionIs};
use jostle::linear::sort_by;
use jostle::quantity::{Quantity, Shown};
use jostle::results::response::FloorResponse;
use jostle::results::summary::{BuildingSummary, ContactSummary, GapSummary, ImpactSummary};
use maud::{Markup, html};

use crate::message;
use crate::verdict::{is_outside, place};
use crate::{Page, format};

/// Most impacts in the table; the strongest are kept.
const MOST_ROWS: usize = 1000;
/// Rows shown before the reader asks for all.
const FIRST_ROWS: usize = 30;

/// The table of impacts, in order of time.
pub(crate) fn impacts(page: &Page) -> Markup {
    let summary = page.summary;
    let several = summary.gaps.len() > 1;
    let contacts = summary
        .gaps
        .iter()
        .flat_map(|gap| gap.contacts.iter().map(move |contact| (gap, contact)));
    let mut rows: Vec<(&GapSummary, &ContactSummary, usize, &ImpactSummary)> = contacts
        .enumerate()
        .flat_map(|(index, (gap, contact))| {
            let impacts = contact.impacts.iter();
            impacts.map(move |impact| (gap, contact, index, impact))
        })
        .collect();
    let all = rows.len();
    sort_by(&mut rows, |a, b| {
        b.3.peak_force_n.total_cmp(&a.3.peak_force_n)
    });
    rows.truncate(MOST_ROWS);
    sort_by(&mut rows, |a, b| a.3.start_s.total_cmp(&b.3.start_s));
    let columns: [(&str, &str); 9] = [
        (message::start(), "s"),
        (message::duration(), "ms"),
        (message::peak_force(), format::FORCE.name()),
        (message::indentation(), format::LENGTH.name()),
        (message::impact_speed(), format::SPEED.name()),
        (message::separation_speed(), format::SPEED.name()),
        (message::restitution(), "–"),
        (message::impulse(), format::IMPULSE.name()),
        (message::dissipated(), format::ENERGY.name()),
    ];
    html! {
        @if all == 0 {
            p.quiet { (message::no_contact_between_floors()) }
        } @else {
            @if all > MOST_ROWS {
                p.quiet { (message::the_strongest_of_impacts_impacts(MOST_ROWS, all)) }
            }
            div.scroll {
                table #impact-table.sortable.clipped[rows.len() > FIRST_ROWS] data-first=(FIRST_ROWS) {
                    thead { tr {
                        th scope="col" { button type="button" { (message::where_word()) } }
                        @for (name, unit) in columns {
                            th.number scope="col" aria-sort=[(name == message::start()).then_some("ascending")] {
                                button type="button" { (name) @if unit != "–" { br; span.unit { "[" (unit) "]" } } }
                            }
                        }
                    } }
                    tbody {
                        @for (i, (gap, contact, index, impact)) in rows.iter().enumerate() {
                            tr.beyond[i >= FIRST_ROWS] data-start=(impact.start_s) data-end=(impact.end_s) data-at=(impact.peak_force_at_s) data-contact=(index) {
                                td { @if several { (gap.between[0]) " ↔ " (gap.between[1]) ", " } (place(page.summary, gap, contact)) }
                                @for value in cells(impact) { td.number { (value) } }
                            }
                        }
                    }
                }
            }
            @if rows.len() > FIRST_ROWS {
                button #all-impacts.wide type="button" { (message::show_all_impacts(rows.len())) }
            }
            @for gap in summary.gaps.iter().filter(|gap| gap.multiple_pounding_count > 0) {
                p.quiet {
                    @if several { (gap.between[0]) " ↔ " (gap.between[1]) ": " }
                    @match [gap.multiple_pounding_count, gap.pounding_count] {
                        [_, 1] => (message::only_pounding_is_at_several(gap.most_at_once)),
                        [1, all] => (message::one_of_poundings_is_at_several(all, gap.most_at_once)),
                        [some, all] => (message::of_poundings_are_at_several(some, all, gap.most_at_once)),
                    }
                }
            }
            (restitution_note(page))
        }
    }
}

/// Share of the energy that an impact passes on below which its dissipation is rounding \[–\].
const ROUNDING: f64 = 1e-5;

fn cells(impact: &ImpactSummary) -> [String; 9] {
    let passed_on = impact.impulse_n_s.abs() * impact.impact_speed_m_s.abs();
    let dissipated = match impact.dissipated_j {
        small if small.abs() < ROUNDING * passed_on => 0.0,
        other => other,
    };
    [
        format::fixed(impact.start_s, 4),
        format::significant((impact.end_s - impact.start_s) * 1e3, 3),
        format::significant(format::FORCE.of(impact.peak_force_n), 4),
        format::significant(format::LENGTH.of(impact.peak_indentation_m), 3),
        format::significant(format::SPEED.of(impact.impact_speed_m_s), 3),
        format::significant(format::SPEED.of(impact.separation_speed_m_s), 3),
        format::fixed(impact.realised_restitution, 3),
        format::significant(format::IMPULSE.of(impact.impulse_n_s), 3),
        format::significant(format::ENERGY.of(dissipated), 3),
    ]
}

fn restitution_note(page: &Page) -> Markup {
    let summary = page.summary;
    let gaps = summary.gaps.iter();
    let known: Vec<_> = gaps
        .filter_map(|gap| Some((&gap.between, gap.free_restitution?)))
        .collect();
    let published = page
        .gaps()
        .map(|(summary, gap)| (summary, gap.law))
        .find(|(_, law)| {
            law.kind == LawKind::HertzDamp && law.restitution_is == RestitutionIs::Input
        });
    html! {
        div.note {
            p {
                (message::restitution_is_separation_speed_impact()) " "
                @if !known.is_empty() {
                    (message::two_free_masses_would()) " "
                    @for (i, (between, free)) in known.iter().enumerate() {
                        @if i > 0 { ", " }
                        b { (format::fixed(*free, 3)) }
                        @if summary.gaps.len() > 1 { " (" (between[0]) " ↔ " (between[1]) ")" }
                    }
                    " " (message::under_this_contact_law()) " "
                }
                (message::other_contacts_act_too())
            }
            @if let Some((Some(free), law)) = published.map(|(gap, law)| (gap.free_restitution, law)) {
                p {
                    (message::the_coefficient_in_the_published(format::plain(law.restitution, 3), format::fixed(free, 3)))
                }
            }
        }
    }
}

/// Numbers of the floors of a building, and how they are shown; without those that no floor has.
fn peaks_shown(
    building: &BuildingSummary,
) -> impl Iterator<Item = (&'static Quantity<FloorResponse>, Shown)> + '_ {
    let has = |quantity: &Quantity<FloorResponse>| {
        let mut floors = building.floors.iter();
        floors.any(|floor| quantity.value(&floor.response).is_some())
    };
    let quantities = FloorResponse::QUANTITIES
        .iter()
        .filter(move |quantity| has(quantity));
    quantities.filter_map(|quantity| Some((quantity, quantity.shown?)))
}

/// Heading of a number; that of the mechanics where the table of messages has none.
fn title(quantity: &Quantity<FloorResponse>, shown: Shown) -> &'static str {
    match quantity.name {
        "displacement_peak_m" => message::displacement(),
        "total_acceleration_peak_m_s2" => message::total_acceleration(),
        "filtered_acceleration_peak_m_s2" => message::filtered_acceleration(),
        "storey_drift_peak" => message::storey_drift(),
        "storey_shear_peak_n" => message::storey_shear(),
        "overturning_moment_peak_n_m" => message::overturning_moment(),
        _ => shown.title,
    }
}

/// Peaks of every floor and of the storey below it, with and without contact: one folded table for each building.
pub(crate) fn peaks(page: &Page) -> Markup {
    html! {
        @for (index, building) in page.summary.buildings.iter().enumerate() {
            details.peaks.muted[is_outside(building)] {
                summary { (message::peaks_of_in_numbers(&building.name)) }
                @if is_outside(building) { p { b { (message::outside_the_model()) } } }
                (peaks_of(building, page.model.buildings.get(index).map_or(0.0, |building| building.base.elevation)))
            }
        }
    }
}

/// `elevation`: height of the base above the datum \[m\].
fn peaks_of(building: &BuildingSummary, elevation: f64) -> Markup {
    let filtered = building.response.filtered_acceleration_peak_m_s2.is_some();
    let compared = building.floors.iter().any(|f| f.without_contact.is_some());
    html! {
        div.scroll {
            table {
                thead {
                    tr {
                        th scope="col" rowspan=[compared.then_some("2")] { (message::floor()) }
                        th.number scope="col" rowspan=[compared.then_some("2")] { (message::height()) br; span.unit { (format::HEIGHT.bracketed()) } }
                        @for (quantity, shown) in peaks_shown(building) {
                            th.number scope="colgroup" colspan=[compared.then_some("2")] { (title(quantity, shown)) br; span.unit { "[" (format::unit_of(shown)) "]" } }
                        }
                    }
                    @if compared {
                        tr { @for _ in peaks_shown(building) { th.number scope="col" { (message::with_word()) } th.number scope="col" { (message::without()) } } }
                    }
                }
                tbody {
                    @for floor in building.floors.iter().rev() {
                        tr {
                            th scope="row" { (floor.floor) }
                            td.number { (format::in_unit(format::HEIGHT, elevation + floor.height_m, 2)) }
                            @for (quantity, shown) in peaks_shown(building) {
                                td.number { (peak_cell(quantity, shown, Some(&floor.response))) }
                                @if compared {
                                    td.number { (peak_cell(quantity, shown, floor.without_contact.as_ref())) }
                                }
                            }
                        }
                    }
                }
            }
        }
        p.quiet {
            (message::greatest_absolute_values())
            @if compared { (message::with_and_without_contact()) }
            (message::drift_and_shear_are_those())
            @if filtered { (message::the_filter_of_floor_spectra()) }
            @if elevation != 0.0 { " " (message::heights_from_the_datum()) }
        }
    }
}

fn peak_cell(
    quantity: &Quantity<FloorResponse>,
    shown: Shown,
    floor: Option<&FloorResponse>,
) -> String {
    let value = floor.and_then(|floor| quantity.value(floor));
    value.map_or(format::NOTHING.into(), |value| {
        format::shown_peak(shown, value)
    })
}
