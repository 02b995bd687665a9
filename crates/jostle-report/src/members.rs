//! Greatest forces of columns and beams: one table for each building, struck columns first.

use jostle::results::summary::{BuildingSummary, MemberSummary, SectionSummary};
use maud::{Markup, html};

use crate::{Page, format};

/// Most rows of a table.
const MOST_ROWS: usize = 400;

/// The section; `None` where no forces of members were asked for.
pub(crate) fn section(page: &Page) -> Option<Markup> {
    let asked = page.summary.buildings.iter().any(|b| !b.members.is_empty());
    asked.then(|| {
        html! {
            section #members {
                h2 { "Columns and beams" }
                @for building in page.summary.buildings.iter().filter(|b| !b.members.is_empty()) {
                    (table(building))
                }
                p.quiet {
                    "Greatest forces of every member, struck columns first, then by shear. Axial forces are positive in tension; "
                    "shear and moment are the greatest of both ends and of both sides of a struck point, either sign. "
                    "Damping forces are no part of shears and moments."
                }
            }
        }
    })
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

fn table(building: &BuildingSummary) -> Markup {
    let hit = |m: &&MemberSummary| m.struck.iter().map(|s| s.peak_force_n).fold(0.0, f64::max);
    let shear = |m: &MemberSummary| greatest(m, |s| s.shear_peak_n);
    let mut members: Vec<&MemberSummary> = building.members.iter().collect();
    members.sort_by(|a, b| {
        let (x, y) = (hit(a), hit(b));
        y.total_cmp(&x).then(shear(b).total_cmp(&shear(a)))
    });
    let all = members.len();
    members.truncate(MOST_ROWS);
    let columns = [
        ("greatest tension", "kN"),
        ("greatest compression", "kN"),
        ("shear", "kN"),
        ("moment", "kN·m"),
    ];
    html! {
        details.peaks open[members.iter().any(|m| hit(m) > 0.0)] {
            summary { "Columns and beams of " (building.name) }
            @if all > MOST_ROWS {
                p.quiet { (MOST_ROWS) " of " (all) " members; summary.json has all of them." }
            }
            div.scroll {
                table {
                    thead { tr {
                        th scope="col" { "member" }
                        th.number scope="col" { "impacts" }
                        th.number scope="col" { "contact force" br; span.unit { "[kN]" } }
                        @for (name, unit) in columns {
                            th.number scope="col" { (name) br; span.unit { "[" (unit) "]" } }
                        }
                    } }
                    tbody {
                        @for member in &members {
                            @let impacts: usize = member.struck.iter().map(|s| s.impact_count).sum();
                            tr {
                                th scope="row" { (member.name) }
                                @if impacts > 0 {
                                    td.number { (impacts) }
                                    td.number { (kilo(hit(member))) }
                                } @else {
                                    td.number { (format::NOTHING) }
                                    td.number { (format::NOTHING) }
                                }
                                td.number { (kilo(greatest(member, |s| s.axial_max_n).max(0.0))) }
                                td.number { (kilo(greatest(member, |s| -s.axial_min_n).max(0.0))) }
                                td.number { (kilo(shear(member))) }
                                td.number { (kilo(greatest(member, |s| s.moment_peak_n_m))) }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn kilo(value: f64) -> String {
    format::fixed(value / 1e3, 1)
}
