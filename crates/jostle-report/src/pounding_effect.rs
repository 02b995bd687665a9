//! What contact changes: peaks with contact divided by peaks without.

use jostle::results::response::FloorResponse;
use jostle::results::summary::{BuildingSummary, Summary};
use maud::{Markup, html};

use crate::{Page, format, message};

/// Greatest and least ratio over the height of a building, and the floor of each.
pub type Extremes = [(f64, usize); 2];

/// A peak of a floor or of the storey below it.
type OfFloor = fn(&FloorResponse) -> f64;

const KINDS: [OfFloor; 3] = [
    |floor| floor.storey_drift_peak,
    |floor| floor.storey_shear_peak_n,
    |floor| floor.total_acceleration_peak_m_s2,
];

/// Place of the total acceleration among the kinds.
const ACCELERATION: usize = 2;

/// Ratios of storey drift, storey shear and total acceleration; `None` without a run without contact.
#[must_use]
pub fn changes(building: &BuildingSummary) -> [Option<Extremes>; 3] {
    KINDS.map(|peak| {
        let ratios = building.floors.iter().filter_map(|floor| {
            let before = peak(&floor.without_contact?);
            (before > 0.0).then(|| (peak(&floor.response) / before, floor.floor))
        });
        let greatest = ratios.clone().max_by(|a, b| a.0.total_cmp(&b.0))?;
        let least = ratios.min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some([greatest, least])
    })
}

/// The greatest increase of all buildings: the ratio, what increases and where, and its peak with contact.
pub(crate) struct Worst {
    pub(crate) ratio: f64,
    pub(crate) what: String,
}

/// The greatest increase of a peak by contact; `None` where contact increases none.
pub(crate) fn worst(summary: &Summary) -> Option<Worst> {
    let all = summary.buildings.iter().flat_map(|building| {
        let kinds = changes(building).into_iter().enumerate();
        kinds.filter_map(move |(kind, extremes)| Some((building, kind, extremes?[0])))
    });
    let (building, kind, (ratio, floor)) = all.max_by(|a, b| a.2.0.total_cmp(&b.2.0))?;
    let peak = building.floors.iter().find(|known| known.floor == floor)?;
    let peak = KINDS[kind](&peak.response);
    let what = match kind {
        0 => message::drift_of_storey(
            &building.name,
            floor,
            format::unit(format::fixed(100.0 * peak, 2), "%"),
        ),
        ACCELERATION => {
            message::acceleration_of_floor(&building.name, floor, format::acceleration(peak))
        }
        _ => message::shear_of_storey(&building.name, floor, format::force(peak)),
    };
    (ratio > 1.0).then_some(Worst { ratio, what })
}

/// The table on the first page, where buildings touched and were run without contact too.
pub(crate) fn section(page: &Page) -> Option<Markup> {
    let touched = page.summary.gaps.iter().any(|gap| gap.impact_count > 0);
    let buildings = page.summary.buildings.iter();
    let known: Vec<(&str, [Extremes; 3])> = buildings
        .filter_map(|building| match changes(building) {
            [Some(drift), Some(shear), Some(acceleration)] => {
                Some((&building.name[..], [drift, shear, acceleration]))
            }
            _ => None,
        })
        .collect();
    if !touched || known.is_empty() {
        return None;
    }
    let ratio = |(ratio, floor): (f64, usize), kind: usize| match kind {
        ACCELERATION => message::ratio_at_floor(format::fixed(ratio, 2), floor),
        _ => message::ratio_at_storey(format::fixed(ratio, 2), floor),
    };
    Some(html! {
        section #pounding-effect {
            h2 { (message::effect_of_pounding()) }
            p.quiet { (message::with_contact_over_without()) }
            div.scroll { table {
                thead { tr {
                    th scope="col" { (message::building()) }
                    @for kind in [message::storey_drift(), message::storey_shear(), message::total_acceleration()] {
                        th.number scope="col" { (kind) }
                    }
                } }
                tbody { @for (name, kinds) in &known { tr {
                    th scope="row" { (name) }
                    @for (kind, [greatest, least]) in kinds.iter().enumerate() {
                        td.number {
                            (ratio(*greatest, kind))
                            @if greatest.1 != least.1 { br; span.quiet { (ratio(*least, kind)) } }
                        }
                    }
                } } }
            } }
        }
    })
}
