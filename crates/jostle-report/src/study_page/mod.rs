//! The page of `jostle study`: heat maps, curves, fragility with bands, rankings.

mod bars;
mod chart;
mod heat_map;
mod rose;
mod suite;

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::document::{POLICY, STYLE, on_paper, theme_button, theme_script};
use crate::format;
use crate::message;

pub use bars::{Bar, Bars};
pub use chart::{Chart, Level, Series, Stroke};
pub use heat_map::{Cell, HeatMap};
pub use rose::{Petal, Rose};
pub use suite::{SuitePage, SuiteRow, render_suite};

const OWN_STYLE: &str = include_str!("../../assets/study.css");

/// Characters beyond which a cell of a table is broken into lines.
const LONG: usize = 60;

/// An axis in the unit that people read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// Name.
    pub name: String,
    /// Unit; may be empty.
    pub unit: String,
}

/// Everything the page of a study shows; numbers are in the units of their axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StudyPage {
    /// What it is the page of; empty for a study.
    pub kind: String,
    /// Title.
    pub title: String,
    /// Model and records, as far as the title does not name them; may be empty.
    pub subject: String,
    /// What it says, in sentences.
    pub headline: Vec<String>,
    /// The answers, before the facts: name, value and what it refers to.
    pub answers: Vec<[String; 3]>,
    /// Facts about the study: name and value.
    pub facts: Vec<(String, String)>,
    /// Heat maps, under a heading for each group of them.
    pub maps: Vec<(String, Vec<HeatMap>)>,
    /// Charts under a heading and a remark.
    pub sections: Vec<Section>,
    /// Cases that were not completed: number and reason; at most as many as are to be shown.
    pub failures: Vec<(u64, String)>,
    /// How many there are.
    pub failed: usize,
    /// Cases with histories: number, description, link.
    pub runs: Vec<(u64, String, String)>,
    /// The command that runs one case with its histories, without its number.
    pub command: String,
    /// Files beside the page: name and what it holds.
    pub files: Vec<(String, String)>,
}

/// Charts that belong together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Section {
    /// Heading.
    pub title: String,
    /// How to read them.
    pub remark: String,
    /// Charts.
    pub charts: Vec<Chart>,
    /// Rankings.
    pub bars: Vec<Bars>,
    /// Quantities over an angle.
    pub roses: Vec<Rose>,
    /// A table: heads and rows.
    pub table: Option<(Vec<String>, Vec<Vec<String>>)>,
}

/// The whole page; it loads nothing from outside.
#[must_use]
pub fn render_study(page: &StudyPage) -> String {
    let kind = if page.kind.is_empty() {
        message::study()
    } else {
        &page.kind
    };
    let markup = html! {
        (DOCTYPE)
        html lang=(message::language_code()) {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="description" content=(page.headline.join(" "));
                title { (page.title) " – " (kind.to_lowercase()) }
                link rel="icon" href="data:,";
                style { (PreEscaped(STYLE)) (PreEscaped(OWN_STYLE)) }
                (on_paper(&page.title))
            }
            body {
                header.head {
                    div {
                        p.kicker { (kind) }
                        h1 { (page.title) }
                        @if !page.subject.is_empty() { p.quiet { (page.subject) } }
                    }
                    (theme_button())
                }
                main {
                    @let (first, others) = page.headline.split_at(page.headline.len().min(1));
                    @for sentence in first { p.verdict { (sentence) } }
                    @if !page.answers.is_empty() {
                        div.tiles {
                            @for [name, value, note] in &page.answers {
                                div.tile { p.tile-name { (name) } p.tile-value { (value) } p.tile-note { (note) } }
                            }
                        }
                    }
                    @for sentence in others { p.study-said { (sentence) } }
                    @if !page.facts.is_empty() {
                        dl.study-facts { @for (name, value) in &page.facts { div { dt { (name) } dd { (value) } } } }
                    }
                    @if !page.maps.is_empty() { (maps(page)) }
                    @for section in &page.sections { (charts(section)) }
                    @if !page.runs.is_empty() || !page.command.is_empty() { (runs(page)) }
                    @if page.failed > 0 { (failures(page)) }
                    @if !page.files.is_empty() { (files(page)) }
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

fn maps(page: &StudyPage) -> Markup {
    html! {
        section #maps {
            h2 { (message::maps()) }
            p.quiet { (message::every_cell_is_one_case()) " " span.screen { (message::numbers_and_histories_of_cells()) } }
            @for (heading, maps) in &page.maps {
                @if !heading.is_empty() { h3 { (heading) } }
                div.study-maps { @for map in maps { (heat_map::figure(map)) } }
            }
        }
    }
}

fn charts(section: &Section) -> Markup {
    html! {
        section {
            h2 { (section.title) }
            @if !section.remark.is_empty() { p.quiet { (section.remark) } }
            div.study-charts {
                @for chart in &section.charts { (chart::figure(chart)) }
                @for bars in &section.bars { (bars::figure(bars)) }
            }
            @if !section.roses.is_empty() {
                div.study-roses { @for rose in &section.roses { (rose::figure(rose)) } }
            }
            @if let Some((heads, rows)) = &section.table {
                @let numbers: Vec<bool> = (0..heads.len()).map(|column| is_of_numbers(rows, column)).collect();
                div.scroll {
                    table {
                        thead { tr { @for (head, number) in heads.iter().zip(&numbers) { th.number[*number] scope="col" { (head) } } } }
                        tbody {
                            @for row in rows {
                                tr {
                                    @for (index, cell) in row.iter().enumerate() {
                                        @if index + 1 == row.len() && row.len() < heads.len() {
                                            td.study-wrap colspan=(heads.len() + 1 - row.len()) { (cell) }
                                        } @else {
                                            td.number[numbers[index]] .study-long[cell.chars().count() > LONG] { @if numbers[index] { (format::grouped(cell)) } @else { (cell) } }
                                        }
                                    }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Whether a column of a table has numbers, and nothing else but dashes.
fn is_of_numbers(rows: &[Vec<String>], column: usize) -> bool {
    let whole = rows.iter().filter(|row| row.len() > column);
    let mut cells = whole
        .map(|row| &row[column][..])
        .filter(|cell| !matches!(*cell, "" | "–"))
        .peekable();
    let is_number = |cell: &str| {
        let digits = cell.trim_start_matches(['−', '-', '>', '≤', ' ']);
        digits.starts_with(|first: char| first.is_ascii_digit())
    };
    cells.peek().is_some() && cells.all(is_number)
}

fn runs(page: &StudyPage) -> Markup {
    html! {
        section #runs {
            h2 { (message::runs()) }
            @if !page.runs.is_empty() {
                ul.study-list {
                    @for (case, what, link) in &page.runs {
                        li { a href=(link) { (message::case_case(case)) } " – " (what) }
                    }
                }
            }
            @if !page.command.is_empty() {
                p.quiet { (message::any_other_case_with_histories()) " " code { (page.command) " --case NUMBER" } }
            }
        }
    }
}

fn failures(page: &StudyPage) -> Markup {
    html! {
        section #failures {
            h2 { (message::of_the_cases_did(page.failed)) }
            ul.study-list {
                @for (case, reason) in &page.failures { li { (message::case_case_reason(case, reason)) } }
            }
            @if page.failed > page.failures.len() {
                p.quiet { (message::and_more_see_the_columns(page.failed - page.failures.len())) " " code { "status" } " " (message::and_word()) " " code { "reason" } "." }
            }
        }
    }
}

fn files(page: &StudyPage) -> Markup {
    html! {
        section #files {
            h2 { (message::files()) }
            table {
                tbody {
                    @for (name, what) in &page.files {
                        tr { td { code { (name) } } td.study-wrap { (what) } }
                    }
                }
            }
        }
    }
}

/// A number of the axes and cells of figures, with three digits.
fn number(value: f64) -> String {
    short(value, 3)
}

/// A peak as captions, tables and sentences have it, with four digits.
fn peak(value: f64) -> String {
    short(value, 4)
}

/// A number with the fewest digits.
fn short(value: f64, digits: i32) -> String {
    if value == 0.0 {
        return "0".into();
    }
    if !value.is_finite() {
        return "–".into();
    }
    let text = format::significant(value, digits);
    if text.contains('.') && !text.contains('⁰') && !text.contains('·') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// A number with four significant digits and its unit, which may be empty.
#[must_use]
pub fn with_unit(value: f64, unit: &str) -> String {
    format!("{} {unit}", peak(value)).trim_end().to_owned()
}

/// The same with three digits.
#[must_use]
pub fn with_three_digits(value: f64, unit: &str) -> String {
    format!("{} {unit}", number(value)).trim_end().to_owned()
}

impl Axis {
    /// Name with unit.
    fn label(&self) -> String {
        if self.unit.is_empty() {
            self.name.clone()
        } else {
            format!("{} [{}]", self.name, self.unit)
        }
    }
}
