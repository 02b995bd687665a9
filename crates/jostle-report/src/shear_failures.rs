//! Columns that failed in shear: when, where and during which impact.

use jostle::results::summary::{ShearFailure, ShearFailureSummary};
use maud::{Markup, html};

use crate::members::place_of_impact;
use crate::{Page, format, message};

/// Most rows of the table.
const MOST_ROWS: usize = 200;

/// The section; `None` where no column can fail.
pub(crate) fn section(page: &Page) -> Option<Markup> {
    let buildings = page.summary.buildings.iter();
    let buildings: Vec<_> = buildings
        .filter_map(|building| Some((&building.name[..], building.shear_failures.as_ref()?)))
        .collect();
    if buildings.is_empty() {
        return None;
    }
    let failed: Vec<&ShearFailure> = buildings.iter().flat_map(|(_, all)| &all.list).collect();
    Some(html! {
        section #shear-failures {
            h2 { (message::columns_that_fail_in_shear()) }
            @for (name, all) in &buildings { p { (sentence(name, all)) } }
            @if !failed.is_empty() { (table(&failed)) }
        }
    })
}

fn sentence(name: &str, all: &ShearFailureSummary) -> String {
    match all.first_s {
        Some(first) => message::columns_failed_in_shear(
            name,
            all.failed,
            all.total,
            format::instant(first),
            format::energy(all.dissipated_j),
        ),
        None => message::no_column_fails_in_shear(name, all.total),
    }
}

fn table(failed: &[&ShearFailure]) -> Markup {
    let columns = [
        (message::time(), "s"),
        (message::strength(), format::FORCE.name()),
        (message::greatest_slip(), format::LENGTH.name()),
        (message::strength_left(), "%"),
        (message::dissipated(), format::ENERGY.name()),
    ];
    html! {
        @if failed.len() > MOST_ROWS {
            p.quiet { (message::first_shear_failures(MOST_ROWS, failed.len())) }
        }
        div.scroll {
            table {
                caption.quiet { (message::in_order_of_time_by_building()) }
                thead { tr {
                    th scope="col" { (message::column()) }
                    th scope="col" { (message::at()) }
                    @for (name, unit) in columns {
                        th.number scope="col" { (name) br; span.unit { "[" (unit) "]" } }
                    }
                    th scope="col" { (message::during_the_impact_of()) }
                } }
                tbody {
                    @for own in failed.iter().take(MOST_ROWS) {
                        tr {
                            th scope="row" { (own.column) }
                            td { (own.at) @if let Some(axis) = own.along { ", " (axis) } }
                            @for value in cells(own) { td.number { (value) } }
                            td { (during(own)) }
                        }
                    }
                }
            }
        }
    }
}

fn cells(failure: &ShearFailure) -> [String; 5] {
    [
        format::fixed(failure.failed_s, 3),
        format::significant(format::FORCE.of(failure.strength_n), 4),
        format::significant(format::LENGTH.of(failure.slip_peak_m), 3),
        format::fixed(100.0 * failure.strength_left, 0),
        format::significant(format::ENERGY.of(failure.dissipated_j), 3),
    ]
}

fn during(failure: &ShearFailure) -> String {
    failure.impact.as_ref().map_or_else(
        || format::NOTHING.to_owned(),
        |impact| {
            message::both_at_height_from(
                &impact.between[0],
                &impact.between[1],
                place_of_impact(impact),
                format::plain(format::HEIGHT.of(impact.height_m), 4),
                format::instant(impact.start_s),
            )
        },
    )
}
