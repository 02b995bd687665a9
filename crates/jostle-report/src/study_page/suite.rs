//! The page of a suite of records: results of every record, governing values, charts.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::{OWN_STYLE, Section, charts};
use crate::document::{CALCULATION_STYLE, POLICY, STYLE, on_paper, theme_button, theme_script};
use crate::format::grouped;
use crate::{checks, format, message};
use jostle::results::summary::Finding;

/// Everything the page of a suite shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SuitePage {
    /// Title of the model.
    pub title: String,
    /// The result in a sentence.
    pub headline: String,
    /// The rule for governing values, in a sentence.
    pub rule: String,
    /// The greatest values over the records: name, value with unit, and the record.
    pub tiles: Vec<[String; 3]>,
    /// Warnings about the governing values.
    pub warnings: Vec<String>,
    /// The accuracy of the worst record, in a sentence; empty if none reached its end.
    pub accuracy: String,
    /// Checks that records did not pass.
    pub checks: Vec<Finding>,
    /// Records, in their order.
    pub records: Vec<SuiteRow>,
    /// Name with unit, governing value, mean, standard deviation, 16 to 84 %, greatest value, its record, governing value without
    /// contact.
    pub quantities: Vec<Vec<String>>,
    /// `mean` or `maximum`: which column governs.
    pub statistic: &'static str,
    /// Charts under their headings.
    pub sections: Vec<Section>,
    /// Files beside the page: name and what it holds.
    pub files: Vec<(String, String)>,
}

/// One record of a suite.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SuiteRow {
    /// Name of the motion.
    pub name: String,
    /// Address of its report.
    pub link: Option<String>,
    /// Peak \[m/s²\], scale, duration \[s\], impacts, peak force \[kN\], gap needed \[mm\].
    pub cells: Vec<String>,
    /// Why it did not reach its end; empty if it did.
    pub remark: String,
}

fn record_columns() -> [(&'static str, &'static str); 6] {
    [
        (message::peak(), format::ACCELERATION.name()),
        (message::scale(), ""),
        (message::duration(), "s"),
        (message::impacts(), ""),
        (message::peak_force(), format::FORCE.name()),
        (
            message::smallest_gap_without_pounding(),
            format::LENGTH.name(),
        ),
    ]
}
fn quantity_columns() -> [&'static str; 7] {
    [
        message::governing(),
        message::mean(),
        message::standard_deviation(),
        message::percentiles_16_to_84(),
        message::greatest(),
        message::of_record(),
        message::without_contact(),
    ]
}

/// The whole page; it loads nothing from outside.
#[must_use]
pub fn render_suite(page: &SuitePage) -> String {
    let markup = html! {
        (DOCTYPE)
        html lang=(message::language_code()) {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="description" content=(page.headline);
                title { (message::title_suite(&page.title)) }
                link rel="icon" href="data:,";
                style { (PreEscaped(STYLE)) (PreEscaped(OWN_STYLE)) (PreEscaped(CALCULATION_STYLE)) }
                (on_paper(&page.title))
            }
            body {
                @if !page.warnings.is_empty() {
                    aside.warnings role="alert" {
                        @for warning in &page.warnings { p { b { (message::warning()) " " } (warning) } }
                    }
                }
                header.head {
                    div {
                        p.kicker { (message::suite_of_records(page.records.len())) }
                        h1 { (page.title) }
                    }
                    (theme_button())
                }
                main {
                    p.verdict { (page.headline) }
                    div.tiles {
                        @for [name, value, note] in &page.tiles {
                            div.tile { p.tile-name { (name) } p.tile-value { (grouped(value)) } p.tile-note { (note) } }
                        }
                    }
                    p.quiet { (page.rule) }
                    @if !page.accuracy.is_empty() { p.quiet { b { (message::accuracy()) " " } (page.accuracy) "." } }
                    (quantities(page))
                    (records(page))
                    (checks::found(&page.checks, &[], &[]))
                    @for section in &page.sections { (charts(section)) }
                    section #files {
                        h2 { (message::files()) }
                        table { tbody {
                            @for (name, what) in &page.files { tr { td { code { (name) } } td.study-wrap { (what) } } }
                        } }
                    }
                }
                footer {
                    (message::made_by_jostle_version(crate::version()))
                }
                (theme_script())
            }
        }
    };
    markup.into_string()
}

fn quantities(page: &SuitePage) -> Markup {
    let governs = if page.statistic == "mean" { 2 } else { 5 };
    // The greatest is not told twice.
    let shown = |column: usize| column != 5 || page.statistic == "mean";
    html! {
        section #governing {
            h2 { (message::governing_values()) }
            p.quiet { (message::all_records_together_the_governs(page.statistic)) }
            div.scroll {
                table {
                    thead { tr {
                        th scope="col" { (message::quantity()) }
                        @for (index, name) in quantity_columns().into_iter().enumerate() { @if shown(index + 1) { th.number[name != message::of_record()] scope="col" { (name) } } }
                    } }
                    tbody {
                        @for row in &page.quantities {
                            tr {
                                @for (index, cell) in row.iter().enumerate() {
                                    @if !shown(index) {}
                                    @else if index == 0 { th scope="row" { (cell) } }
                                    @else if index == 1 { td.number { b { (grouped(cell)) } } }
                                    @else if index == 6 { td { (cell) } }
                                    @else { td.number.governs[index == governs] { (grouped(cell)) } }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn records(page: &SuitePage) -> Markup {
    html! {
        section #records {
            h2 { (message::records()) }
            div.scroll {
                table {
                    thead { tr {
                        th scope="col" { (message::record()) }
                        @for (name, unit) in record_columns() {
                            th.number scope="col" { (name) @if !unit.is_empty() { " " span.unit { "[" (unit) "]" } } }
                        }
                        th scope="col" {}
                    } }
                    tbody {
                        @for row in &page.records {
                            tr {
                                th scope="row" {
                                    @match &row.link {
                                        Some(link) => a href=(link) { (row.name) },
                                        None => (row.name),
                                    }
                                }
                                @for cell in &row.cells { td.number { (grouped(cell)) } }
                                td.study-wrap { (row.remark) }
                            }
                        }
                    }
                }
            }
        }
    }
}
