//! Tables of impacts, of peaks of every floor, and of gaps required by codes compared with computed ones.

use jostle::Gap;
use jostle::contact::{LawKind, RestitutionIs};
use jostle::results::summary::{
    BuildingSummary, ContactSummary, FloorSummary, FloorWithoutContact, GapSummary, ImpactSummary,
};
use jostle::separation::{absolute_sum, gb50011_frame_joint, srss};
use maud::{Markup, html};

use crate::envelope::Envelope;
use crate::verdict::{peak_closing, place};
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
    rows.sort_by(|a, b| b.3.peak_force_n.total_cmp(&a.3.peak_force_n));
    rows.truncate(MOST_ROWS);
    rows.sort_by(|a, b| a.3.start_s.total_cmp(&b.3.start_s));
    let columns: [(&str, &str); 9] = [
        ("start", "s"),
        ("duration", "ms"),
        ("peak force", "kN"),
        ("indentation", "mm"),
        ("impact speed", "m/s"),
        ("separation speed", "m/s"),
        ("restitution", "–"),
        ("impulse", "kN·s"),
        ("dissipated", "kJ"),
    ];
    html! {
        @if all == 0 {
            p.quiet { "No contact between floors." }
        } @else {
            @if all > MOST_ROWS {
                p.quiet { "The " (MOST_ROWS) " strongest of " (all) "  impacts; impacts.parquet contains all of them." }
            }
            div.scroll {
                table #impact-table.sortable.clipped[rows.len() > FIRST_ROWS] data-first=(FIRST_ROWS) {
                    thead { tr {
                        th scope="col" { button type="button" { "where" } }
                        @for (name, unit) in columns {
                            th.number scope="col" aria-sort=[(name == "start").then_some("ascending")] {
                                button type="button" { (name) @if unit != "–" { br; span.unit { "[" (unit) "]" } } }
                            }
                        }
                    } }
                    tbody {
                        @for (i, (gap, contact, index, impact)) in rows.iter().enumerate() {
                            tr.beyond[i >= FIRST_ROWS] data-start=(impact.start_s) data-end=(impact.end_s) data-at=(impact.peak_force_at_s) data-contact=(index) {
                                td { @if several { (gap.between[0]) "–" (gap.between[1]) ", " } (place(contact)) }
                                @for value in cells(impact) { td.number { (value) } }
                            }
                        }
                    }
                }
            }
            @if rows.len() > FIRST_ROWS {
                button #all-impacts.wide type="button" { "Show all " (rows.len()) " impacts" }
            }
            @for gap in summary.gaps.iter().filter(|gap| gap.multiple_pounding_count > 0) {
                p.quiet {
                    @if several { (gap.between[0]) "–" (gap.between[1]) ": " }
                    (gap.multiple_pounding_count) " of " (gap.pounding_count)
                    " poundings are at several floors at the same time, at most " (gap.most_at_once) " at once."
                }
            }
            (restitution_note(page))
        }
    }
}

fn cells(impact: &ImpactSummary) -> [String; 9] {
    [
        format::fixed(impact.start_s, 4),
        format::significant((impact.end_s - impact.start_s) * 1e3, 3),
        format::significant(impact.peak_force_n / 1e3, 4),
        format::significant(impact.peak_indentation_m * 1e3, 3),
        format::significant(impact.impact_speed_m_s, 3),
        format::significant(impact.separation_speed_m_s, 3),
        format::fixed(impact.realised_restitution, 3),
        format::significant(impact.impulse_n_s / 1e3, 3),
        format::significant(impact.dissipated_j / 1e3, 3),
    ]
}

fn restitution_note(page: &Page) -> Markup {
    let summary = page.summary;
    let published = page
        .gaps()
        .map(|(summary, gap)| (summary, gap.law))
        .find(|(_, law)| {
            law.kind == LawKind::HertzDamp && law.restitution_is == RestitutionIs::Input
        });
    html! {
        div.note {
            p {
                "Restitution is separation speed ÷ impact speed, as computed. Two free masses would rebound with "
                @for (i, gap) in summary.gaps.iter().enumerate() {
                    @if i > 0 { ", " }
                    b { (format::fixed(gap.free_restitution, 3)) }
                    @if summary.gaps.len() > 1 { " (" (gap.between[0]) "–" (gap.between[1]) ")" }
                }
                " under this contact law. In a building the storeys and other contacts also act during the impact, so the two ratios differ. After a light impact the ratio may exceed one."
            }
            @if let Some((gap, law)) = published {
                p {
                    "The coefficient in the published hertz-damp formula is not the rebound of free masses: with e = "
                    (format::plain(law.restitution, 3)) " they rebound with " (format::fixed(gap.free_restitution, 3)) "."
                }
            }
        }
    }
}

/// A peak of a floor with and without contact: name, unit, values in that unit, decimals.
type Peak = (
    &'static str,
    &'static str,
    fn(&FloorSummary) -> f64,
    fn(&FloorWithoutContact) -> f64,
    usize,
);

const PEAKS: [Peak; 5] = [
    (
        "displacement",
        "mm",
        |f| 1e3 * f.displacement_max_m.max(-f.displacement_min_m),
        |f| 1e3 * f.displacement_max_m.max(-f.displacement_min_m),
        1,
    ),
    (
        "storey drift",
        "%",
        |f| 100.0 * f.storey_drift_peak,
        |f| 100.0 * f.storey_drift_peak,
        2,
    ),
    (
        "storey shear",
        "kN",
        |f| 1e-3 * f.storey_shear_peak_n,
        |f| 1e-3 * f.storey_shear_peak_n,
        1,
    ),
    (
        "overturning moment",
        "kN·m",
        |f| 1e-3 * f.overturning_moment_peak_n_m,
        |f| 1e-3 * f.overturning_moment_peak_n_m,
        0,
    ),
    (
        "total acceleration",
        "m/s²",
        |f| f.total_acceleration_peak_m_s2,
        |f| f.total_acceleration_peak_m_s2,
        2,
    ),
];

/// Peaks of every floor and of the storey below it, with and without contact: one folded table for each building.
pub(crate) fn peaks(page: &Page) -> Markup {
    html! {
        @for building in &page.summary.buildings {
            details.peaks {
                summary { "Peaks of " (building.name) " in numbers" }
                (peaks_of(building))
            }
        }
    }
}

fn peaks_of(building: &BuildingSummary) -> Markup {
    let compared = building.floors.iter().any(|f| f.without_contact.is_some());
    html! {
        div.scroll {
            table {
                thead {
                    tr {
                        th scope="col" rowspan=[compared.then_some("2")] { "floor" }
                        th.number scope="col" rowspan=[compared.then_some("2")] { "height" br; span.unit { "[m]" } }
                        @for (name, unit, ..) in PEAKS {
                            th.number scope="colgroup" colspan=[compared.then_some("2")] { (name) br; span.unit { "[" (unit) "]" } }
                        }
                    }
                    @if compared {
                        tr { @for _ in PEAKS { th.number scope="col" { "with" } th.number scope="col" { "without" } } }
                    }
                }
                tbody {
                    @for floor in building.floors.iter().rev() {
                        tr {
                            th scope="row" { (floor.floor) }
                            td.number { (format::fixed(floor.height_m, 2)) }
                            @for (_, _, with, without, decimals) in PEAKS {
                                td.number { (format::fixed(with(floor), decimals)) }
                                @if compared {
                                    td.number { (floor.without_contact.as_ref().map_or(format::NOTHING.into(), |f| format::fixed(without(f), decimals))) }
                                }
                            }
                        }
                    }
                }
            }
        }
        p.quiet {
            "Greatest absolute values"
            @if compared { ", with and without contact" }
            ". Drift and shear are those of the storey below the floor; the moment is about the base of that storey."
        }
    }
}

/// A length to compare with the gap.
struct Width {
    name: String,
    metres: f64,
    class: &'static str,
}

/// Required gaps as bars: the gap of the model, the smallest gap without pounding, the gaps of rules.
pub(crate) fn joints(page: &Page, run: &[Envelope], without: Option<&[Envelope]>) -> Markup {
    let of_gap = |summary, gap: &Gap| {
        let envelopes = without.unwrap_or(run);
        widths(page, summary, gap.between, envelopes, without.is_some())
    };
    let gaps: Vec<_> = page
        .gaps()
        .map(|(summary, gap)| (summary, gap, of_gap(summary, gap)))
        .collect();
    let mut all = gaps.iter().flat_map(|(_, _, widths)| widths);
    let combined = all.any(|width| width.class == "of-rule");
    html! {
        @for (summary, gap, widths) in &gaps {
            @let longest = widths.iter().map(|w| w.metres).fold(1e-9, f64::max);
            div.joint {
                h3 {
                    (summary.between[0]) " and " (summary.between[1])
                    @if let Some(height) = lower_height(page, gap.between) {
                        span.quiet { " · lower building " (format::plain(height, 4)) " m high" }
                    }
                }
                div.bars role="table" {
                    @for width in widths {
                        div.bar-row role="row" {
                            span.bar-name role="rowheader" { (width.name) }
                            span.bar-track role="presentation" {
                                span.bar.(width.class) style=(format!("width:{:.2}%", width.metres / longest * 100.0)) {}
                                span.bar-gap style=(format!("left:{:.2}%", summary.width_m / longest * 100.0)) {}
                            }
                            span.bar-value role="cell" { (format::millimetres(width.metres)) }
                        }
                    }
                }
            }
        }
        p.quiet {
            "The line marks the gap. Code: GB 50011-2010 §6.1.4, concrete frames, for the height of the lower building."
            @if combined {
                " SRSS and ABS combine the peak displacements at the highest common floor "
                @if without.is_some() { "of the run without contact." } @else { "of this run, impacts included." }
            }
        }
    }
}

/// Height of the lower of two neighbours; `None` beside a wall, for which codes have no rule.
fn lower_height(page: &Page, between: [Option<usize>; 2]) -> Option<f64> {
    let [left, right] = between;
    let buildings = [left?, right?].map(|building| page.model.buildings.get(building));
    buildings
        .into_iter()
        .filter_map(|building| building?.floor_heights().last().copied())
        .min_by(f64::total_cmp)
}

fn widths(
    page: &Page,
    summary: &GapSummary,
    between: [Option<usize>; 2],
    envelopes: &[Envelope],
    without: bool,
) -> Vec<Width> {
    let mut widths = vec![Width {
        name: "gap".into(),
        metres: summary.width_m,
        class: "of-gap",
    }];
    let mut add = |name: &str, metres: Option<f64>, class| {
        if let Some(metres) = metres.filter(|m| m.is_finite() && *m >= 0.0) {
            widths.push(Width {
                name: name.into(),
                metres,
                class,
            });
        }
    };
    add("peak closing", peak_closing(summary), "of-run");
    add(
        "smallest gap without pounding",
        summary.closing_without_contact_m,
        "of-run",
    );
    let top = summary
        .contacts
        .iter()
        .filter_map(|contact| match contact.floors {
            [Some(l), Some(r)] => Some((l, r, contact.height_m)),
            _ => None,
        })
        .max_by(|a, b| a.2.total_cmp(&b.2));
    if let Some((l, r, _)) = top {
        let peak = |building: usize, floor: usize| {
            let envelope = envelopes.get(building)?;
            let greatest = envelope.greatest.get(floor.wrapping_sub(1))?;
            let least = envelope.least.get(floor.wrapping_sub(1))?;
            Some(greatest.max(-least))
        };
        let [left, right] = between;
        let pair = left
            .and_then(|left| peak(left, l))
            .zip(right.and_then(|right| peak(right, r)));
        let run = if without { "" } else { " (with impacts)" };
        let (square, sum) = (format!("SRSS{run}"), format!("ABS{run}"));
        add(&square, pair.map(|(l, r)| srss(l, r)), "of-rule");
        add(&sum, pair.map(|(l, r)| absolute_sum(l, r)), "of-rule");
    }
    for intensity in 6..=9 {
        let width = lower_height(page, between).and_then(|h| gb50011_frame_joint(h, intensity));
        add(&format!("code, intensity {intensity}"), width, "of-code");
    }
    widths
}
