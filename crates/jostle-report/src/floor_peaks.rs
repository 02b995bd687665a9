//! Peaks of every floor as a table, with and without contact.

use jostle::summary::{BuildingSummary, FloorSummary};
use maud::{Markup, html};

use crate::{Page, format};

/// Name, unit, divisor from SI, and the peak with and without contact.
struct Kind {
    name: &'static str,
    unit: &'static str,
    divisor: f64,
    with: fn(&FloorSummary) -> f64,
    without: fn(&FloorSummary) -> Option<f64>,
}

const KINDS: [Kind; 6] = [
    Kind {
        name: "to the right",
        unit: "mm",
        divisor: 1e-3,
        with: |floor| floor.displacement_max_m,
        without: |floor| Some(floor.without_contact?.displacement_max_m),
    },
    Kind {
        name: "to the left",
        unit: "mm",
        divisor: 1e-3,
        with: |floor| -floor.displacement_min_m,
        without: |floor| Some(-floor.without_contact?.displacement_min_m),
    },
    Kind {
        name: "storey drift",
        unit: "%",
        divisor: 1e-2,
        with: |floor| floor.storey_drift_peak,
        without: |floor| Some(floor.without_contact?.storey_drift_peak),
    },
    Kind {
        name: "storey shear",
        unit: "kN",
        divisor: 1e3,
        with: |floor| floor.storey_shear_peak_n,
        without: |floor| Some(floor.without_contact?.storey_shear_peak_n),
    },
    Kind {
        name: "overturning moment",
        unit: "kN·m",
        divisor: 1e3,
        with: |floor| floor.overturning_moment_peak_n_m,
        without: |floor| Some(floor.without_contact?.overturning_moment_peak_n_m),
    },
    Kind {
        name: "total acceleration",
        unit: "m/s²",
        divisor: 1.0,
        with: |floor| floor.total_acceleration_peak_m_s2,
        without: |floor| Some(floor.without_contact?.total_acceleration_peak_m_s2),
    },
];

/// One folded table per building.
pub(crate) fn tables(page: &Page) -> Markup {
    html! {
        @for building in &page.summary.buildings {
            details {
                summary { (building.name) ": peaks of every floor" }
                (table(building))
            }
        }
    }
}

fn table(building: &BuildingSummary) -> Markup {
    let compares = building.floors.iter().any(|f| f.without_contact.is_some());
    html! {
        div.scroll {
            table {
                thead { tr {
                    th scope="col" { "floor" }
                    th.number scope="col" { "height" br; span.unit { "[m]" } }
                    @for kind in &KINDS {
                        th.number scope="col" { (kind.name) br; span.unit { "[" (kind.unit) "]" } }
                    }
                } }
                tbody {
                    @for floor in building.floors.iter().rev() {
                        tr {
                            td { (floor.floor) }
                            td.number { (format::plain(floor.height_m, 4)) }
                            @for kind in &KINDS {
                                td.number {
                                    (format::significant((kind.with)(floor) / kind.divisor, 4))
                                    @if let Some(without) = (kind.without)(floor) {
                                        br; span.quiet { (format::significant(without / kind.divisor, 4)) }
                                    }
                                }
                            }
                        }
                    }
                }
            }
        }
        p.quiet {
            "Storey drift, storey shear and overturning moment are those of the storey below the floor; the moment is about the base of that storey."
            @if compares { " Second line: without contact." }
        }
    }
}
