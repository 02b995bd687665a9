//! Members against stated limits of the rotation of their hinges: the level that each went beyond, and when.

use jostle::model::RotationLevel;
use jostle::results::summary::{MemberLevel, RotationLevelsSummary};
use maud::{Markup, html};

use crate::{Page, format, message};

/// Rows of the table before the reader asks for all, and at most.
const FIRST_ROWS: usize = 20;
const MOST_ROWS: usize = 200;

/// The section; `None` without limits.
pub(crate) fn section(page: &Page) -> Option<Markup> {
    let buildings = page.summary.buildings.iter();
    let members_beyond: Vec<_> = buildings
        .filter_map(|building| Some((&building.name[..], building.rotation_levels.as_ref()?)))
        .collect();
    if members_beyond.is_empty() {
        return None;
    }
    let all: Vec<&MemberLevel> = members_beyond
        .iter()
        .flat_map(|(_, all)| &all.list)
        .collect();
    Some(html! {
        section #rotation-levels {
            h2 { (message::levels_of_members()) }
            @for (name, all) in &members_beyond { p { (sentence(name, all)) } }
            (table(&all))
        }
    })
}

fn sentence(name: &str, all: &RotationLevelsSummary) -> String {
    message::members_beyond_levels(
        name,
        all.members,
        all.beyond_io,
        all.beyond_ls,
        all.beyond_cp,
    )
}

fn table(all: &[&MemberLevel]) -> Markup {
    html! {
        @if all.len() > MOST_ROWS {
            p.quiet { (message::first_levels_of_members(MOST_ROWS, all.len())) }
        }
        div.scroll {
            table #level-table.clipped {
                caption.quiet { (message::worst_level_first()) }
                thead { tr {
                    th scope="col" { (message::member()) }
                    th scope="col" { (message::at()) }
                    th.number scope="col" { (message::rotation()) br; span.unit { "[mrad]" } }
                    th scope="col" { (message::beyond_level()) }
                    @for level in RotationLevel::ALL {
                        th.number scope="col" { (message::limit_of_level(level.name())) br; span.unit { "[mrad]" } }
                        th.number scope="col" { (message::beyond_at(level.name())) br; span.unit { "[s]" } }
                    }
                } }
                tbody {
                    @for (index, own) in all.iter().take(MOST_ROWS).enumerate() {
                        tr.beyond[index >= FIRST_ROWS] {
                            th scope="row" { (own.member) }
                            td { (own.at) }
                            td.number { (format::significant(1e3 * own.rotation_rad, 3)) }
                            td { (own.beyond.map_or(format::NOTHING, RotationLevel::name)) }
                            @for cell in levels(own) { td.number { (cell) } }
                        }
                    }
                }
            }
        }
        @if all.len() > FIRST_ROWS {
            button.wide.unfold type="button" data-table="level-table" { (message::show_all_members(all.len().min(MOST_ROWS))) }
        }
    }
}

/// Limit and instant of every level; a dash where it is not stated, or not exceeded.
fn levels(member: &MemberLevel) -> Vec<String> {
    let of = |level: RotationLevel| {
        let found = member.limits.iter().find(|limit| limit.level == level);
        let limit = found.map(|limit| format::significant(1e3 * limit.limit_rad, 3));
        let instant = found.and_then(|limit| limit.beyond_s);
        let cells = [limit, instant.map(|at| format::fixed(at, 3))];
        cells.map(|cell| cell.unwrap_or_else(|| format::NOTHING.to_owned()))
    };
    RotationLevel::ALL.into_iter().flat_map(of).collect()
}
