//! Results over the range of the properties of bearings.

use jostle::results::isolation_bounds::Bounded;
use maud::{Markup, html};

use crate::{Page, format, message};

/// The section; nothing where the model states no range.
pub(crate) fn section(page: &Page) -> Markup {
    let Some(found) = &page.summary.isolation_bounds else {
        return html! {};
    };
    let millimetres = |value: f64| format::significant(format::LENGTH.of(value), 4);
    let kilonewtons = |value: f64| format::significant(format::FORCE.of(value), 4);
    let percent = |value: f64| format::fixed(100.0 * value, 2);
    html! {
        section #bounds {
            h2 { (message::bounds_of_bearings()) }
            div.scroll { table {
                thead { tr {
                    th scope="col" { (message::result()) } th.number scope="col" { (message::nominal()) } th.number scope="col" { (message::lower_bounds()) } th.number scope="col" { (message::upper_bounds()) } th.number scope="col" { (message::envelope()) }
                } }
                tbody {
                    @for own in &found.buildings {
                        @if let Some(stroke) = &own.stroke_m { (row(&message::stroke_mm(&own.name), stroke, millimetres)) }
                        @if let Some(force) = &own.force_n { (row(&message::force_of_bearings_kn(&own.name), force, kilonewtons)) }
                        (row(&message::drift_percent(&own.name), &own.drift, percent))
                        (row(&message::storey_shear_of_kn(&own.name), &own.storey_shear_n, kilonewtons))
                    }
                    @for own in &found.gaps {
                        @let between = format!("{} ↔ {}", own.between[0], own.between[1]);
                        (row(&message::peak_force_between_kn(&between), &own.peak_force_n, kilonewtons))
                        (row(&message::impacts_between(&between), &own.impact_count, |count| format::fixed(count, 0)))
                        @if let Some(needed) = &own.closing_without_contact_m { (row(&message::gap_needed_between_mm(&between), needed, millimetres)) }
                    }
                }
            } }
            p.quiet { (message::all_bearings_at_one_bound()) }
        }
    }
}

fn row(name: &str, range: &Bounded, text: impl Fn(f64) -> String) -> Markup {
    html! {
        tr {
            th scope="row" { (name) }
            @for value in [range.nominal, range.lower, range.upper] { td.number { (text(value)) } }
            td.number { b { (text(range.envelope)) } }
        }
    }
}
