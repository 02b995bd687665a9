//! Gaps required by codes, compared with the gap of the model and the smallest one without pounding.

use jostle::results::summary::GapSummary;
use jostle::separation::Requirements;
use jostle_io::in_shown_units;
use maud::{Markup, html};

use crate::message;
use crate::rules::{required_width, rows_of_rules};
use crate::verdict::peak_closing;
use crate::{Page, format};

/// A length to compare with the gap.
struct Width {
    name: String,
    metres: f64,
    /// The length in words.
    shown: String,
    class: &'static str,
}

/// Required gaps as bars: the gap of the model, the smallest gap without pounding, the gaps of rules.
pub(crate) fn joints(page: &Page) -> Markup {
    let of_gap = |index: usize, summary: &GapSummary| {
        let required = page.summary.required_gaps(page.model, index, page.codes);
        (widths(summary, &required), required)
    };
    let gaps: Vec<_> = page
        .gaps()
        .enumerate()
        .map(|(index, (summary, gap))| (summary, gap, of_gap(index, summary)))
        .collect();
    let mut floors = page
        .summary
        .buildings
        .iter()
        .flat_map(|building| building.floors.iter());
    let is_without_contact = floors.all(|floor| floor.without_contact.is_some());
    let mut rules = gaps.iter().flat_map(|(_, _, (_, found))| &found.rules);
    let combined = rules.any(|rule| rule.name == "SRSS");
    html! {
        @for (summary, gap, (widths, required)) in &gaps {
            @let (longest, cut) = scale(widths);
            div.joint {
                h3 {
                    (message::one_and_other(&summary.between[0], &summary.between[1]))
                    @if let Some(height) = lower_height(page, gap.between) {
                        span.quiet { " " (message::lower_building_m_high(format::plain(format::HEIGHT.of(height), 4))) }
                    }
                }
                div.bars role="table" {
                    @for width in widths {
                        div.bar-row role="row" {
                            span.bar-name role="rowheader" { (width.name) }
                            span.bar-track role="presentation" {
                                span.bar.(width.class).cut[cut && width.metres > longest] style=(format!("width:{:.2}%", (width.metres / longest * 100.0).min(100.0))) {}
                                span.bar-gap style=(format!("left:{:.2}%", (summary.width_m / longest * 100.0).min(100.0))) {}
                            }
                            span.bar-value role="cell" { (width.shown) }
                        }
                    }
                }
                (sources(required))
            }
        }
        p.legend {
            @for (class, name) in [("of-run", message::of_this_run()), ("of-rule", message::rules_of_combination()), ("of-code", message::code_rules())] {
                span.key { span.bar-key.(class) {} (name) }
            }
        }
        p.quiet {
            (message::the_line_marks_the_gap())
            @if gaps.iter().any(|(_, _, (widths, _))| scale(widths).1) { " " (message::a_bar_is_cut()) }
            @if gaps.iter().any(|(_, _, (widths, _))| widths.iter().any(|width| width.name == "DDC")) { " " (message::double_difference()) }
            @if combined {
                " " (message::srss_and_abs_combine()) " "
                @if is_without_contact { (message::of_the_run_without_contact()) } @else { (message::of_this_run_impacts_included()) }
                " " (message::codes_take_the_same_displacements())
            }
        }
    }
}

/// The longest bar \[m\], and whether one that is longer is cut, because it would squeeze all others.
fn scale(widths: &[Width]) -> (f64, bool) {
    let mut sorted: Vec<f64> = widths.iter().map(|width| width.metres).collect();
    sorted.sort_by(|a, b| b.total_cmp(a));
    match sorted[..] {
        [first, second, ..] if first > 2.0 * second && second > 0.0 => (1.1 * second, true),
        [first, ..] => (first.max(1e-9), false),
        [] => (1e-9, false),
    }
}

/// Sources of the rules and the inputs that they used, folded.
fn sources(required: &Requirements) -> Markup {
    let rows = rows_of_rules(&required.rules, |rule| (&rule.name, rule.width));
    let codes: Vec<_> = rows
        .into_iter()
        .filter(|(_, rule)| rule.code.is_some())
        .collect();
    html! {
        @if !codes.is_empty() || !required.left_out.is_empty() {
            details.rules {
                summary { (message::clauses_and_inputs()) }
                div.scroll {
                    table {
                        thead { tr {
                            th scope="col" { (message::rule()) }
                            th scope="col" { (message::clause()) }
                            th scope="col" { (message::inputs()) }
                            th scope="col" { (message::distance_from_the_property_line()) }
                        } }
                        tbody {
                            @for (name, rule) in codes {
                                tr {
                                    th scope="row" { (name) }
                                    td { (in_shown_units(&rule.source)) }
                                    td { (in_shown_units(&rule.inputs.join("; "))) }
                                    td {
                                        @if let Some([left, right]) = rule.setbacks {
                                            (message::one_and_other(format::millimetres(left), format::millimetres(right)))
                                        }
                                    }
                                }
                            }
                        }
                    }
                }
                @for rule in &required.left_out {
                    p.quiet { (message::is_left_out_it_needs(&rule.name, &rule.needs)) }
                }
            }
        }
    }
}

/// Height of the lower of two neighbours; `None` beside a wall, for which codes have no rule.
fn lower_height(page: &Page, between: [Option<usize>; 2]) -> Option<f64> {
    let [left, right] = page.model.buildings_beside(between);
    let buildings = [left?, right?].map(|building| page.model.buildings.get(building));
    buildings
        .into_iter()
        .filter_map(|building| building?.floor_heights().last().copied())
        .min_by(f64::total_cmp)
}

fn widths(summary: &GapSummary, required: &Requirements) -> Vec<Width> {
    let computed = [
        (message::gap(), Some(summary.width_m), "of-gap"),
        (message::peak_closing(), peak_closing(summary), "of-run"),
        (
            message::smallest_gap_without_pounding(),
            summary.closing_without_contact_m,
            "of-run",
        ),
    ];
    let computed = computed.into_iter().filter_map(|(name, metres, class)| {
        let metres = metres.filter(|metres| metres.is_finite() && *metres >= 0.0)?;
        Some(Width {
            name: name.into(),
            metres,
            shown: format::millimetres(metres),
            class,
        })
    });
    let rules = rows_of_rules(&required.rules, |rule| (&rule.name, rule.width));
    let rules = rules.into_iter().map(|(name, rule)| Width {
        name,
        metres: rule.width,
        shown: required_width(rule.width),
        class: if rule.code.is_some() {
            "of-code"
        } else {
            "of-rule"
        },
    });
    let rules = rules.filter(|rule| rule.metres.is_finite() && rule.metres >= 0.0);
    computed.chain(rules).collect()
}
