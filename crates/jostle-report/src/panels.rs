//! Infill panels: drift, damage state and force of each.

use jostle::results::summary::{BuildingSummary, PanelDamageSummary};
use maud::{Markup, html};

use crate::{Page, format, message};

/// Most rows of the table.
const MOST_ROWS: usize = 200;

/// The section; `None` where no panel is judged.
pub(crate) fn section(page: &Page) -> Option<Markup> {
    let buildings = page.summary.buildings.iter();
    let buildings = buildings.map(|building| (building, building.damaged_panels()));
    let buildings: Vec<_> = buildings.filter(|(_, panels)| !panels.is_empty()).collect();
    if buildings.is_empty() {
        return None;
    }
    let rows = buildings.iter().flat_map(|(building, panels)| {
        let panels = panels.iter();
        panels.map(|panel| (panel, cells(building, panel)))
    });
    let rows: Vec<_> = rows.collect();
    let columns = [
        (message::drift(), ""),
        (message::damage_state(), ""),
        (message::greatest_compression(), format::FORCE.name()),
        (message::dissipated(), format::ENERGY.name()),
        (message::across_its_plane(), ""),
        (message::falls_at(), "s"),
    ];
    Some(html! {
        section #panels {
            h2 { (message::infill_panels()) }
            @for (building, panels) in &buildings { p { (sentence(&building.name, panels)) } }
            p.quiet { (message::damage_by_drift()) }
            @if rows.len() > MOST_ROWS {
                p.quiet { (message::the_first_of_in_order(MOST_ROWS, rows.len())) }
            }
            div.scroll {
                table {
                    thead { tr {
                        th scope="col" { (message::panel()) }
                        @for (name, unit) in columns {
                            th.number scope="col" { (name) @if !unit.is_empty() { br; span.unit { "[" (unit) "]" } } }
                        }
                    } }
                    tbody {
                        @for (panel, cells) in rows.iter().take(MOST_ROWS) {
                            tr {
                                th scope="row" { (panel.name) }
                                @for value in cells { td.number { (value) } }
                            }
                        }
                    }
                }
            }
        }
    })
}

fn sentence(name: &str, panels: &[PanelDamageSummary]) -> String {
    let counts = (1..=4).rev().filter_map(|state| {
        let count = panels.iter().filter(|panel| panel.state == state).count();
        (count > 0).then(|| message::state_in(state, count))
    });
    let counts: Vec<String> = counts.collect();
    let counts = match counts.is_empty() {
        true => message::no_state_in_any().to_owned(),
        false => counts.join(", "),
    };
    message::panels_of_states(name, counts, panels.len())
}

/// Drift, damage state, greatest compression of its struts, what they dissipated, its ratio across its plane, and when it falls out.
fn cells(building: &BuildingSummary, panel: &PanelDamageSummary) -> [String; 6] {
    let struts = building.parts.iter();
    let struts = struts.filter(|part| part.panel() == panel.name);
    let fallen = struts.clone().find_map(|strut| strut.fallen_s);
    let force = struts.clone().map(|strut| -strut.force_min_n);
    let dissipated: f64 = struts.clone().map(|strut| strut.dissipated_j).sum();
    let across = struts.filter_map(|strut| strut.out_of_plane_ratio);
    let across = across.reduce(f64::max);
    [
        format::fixed(100.0 * panel.drift, 2),
        panel.state.to_string(),
        format::significant(format::FORCE.of(force.fold(0.0, f64::max)), 3),
        format::significant(format::ENERGY.of(dissipated), 3),
        across.map_or_else(
            || format::NOTHING.to_owned(),
            |ratio| format::fixed(ratio, 2),
        ),
        fallen.map_or_else(|| format::NOTHING.to_owned(), |at| format::fixed(at, 3)),
    ]
}
