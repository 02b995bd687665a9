//! The page of a comparison with measurements: histories over each other, impacts, scores.

use jostle::results::comparison::{HistoryScore, ImpactScore};
use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::document::{CALCULATION_STYLE, POLICY, STYLE, on_paper, theme_button, theme_script};
use crate::format;
use crate::message;
use crate::static_plot::{Line, Plot};

const OWN_STYLE: &str = include_str!("../assets/study.css");
/// Colours of measured and of computed lines.
const COLOURS: [usize; 2] = [0, 1];
/// Time shown to either side of the measured peak \[s\].
const AROUND: f64 = 1.5;
/// Pairs of impacts that are listed.
const MOST_PAIRS: usize = 200;

/// What the page of a comparison shows.
#[derive(Clone, Copy, Debug)]
pub struct ComparisonPage<'a> {
    /// Title of the model.
    pub title: &'a str,
    /// What it says, in sentences.
    pub headline: &'a [String],
    /// Warnings of the run.
    pub warnings: &'a [String],
    /// Facts: name and value.
    pub facts: &'a [(String, String)],
    /// Instants of all histories \[s\].
    pub time: &'a [f64],
    /// Histories.
    pub histories: &'a [ComparedHistory<'a>],
    /// Impacts.
    pub impacts: &'a [ComparedImpactTimes<'a>],
    /// Notes.
    pub notes: &'a [String],
}

/// A measured and a computed history at the same instants.
#[derive(Clone, Copy, Debug)]
pub struct ComparedHistory<'a> {
    /// Name in the data.
    pub measured_name: &'a str,
    /// Name in the results.
    pub computed_name: &'a str,
    /// Unit of both.
    pub unit: &'a str,
    /// Measured values.
    pub measured: &'a [f64],
    /// Computed values.
    pub computed: &'a [f64],
    /// How they agree.
    pub score: &'a HistoryScore,
}

/// Instants of measured and computed impacts.
#[derive(Clone, Copy, Debug)]
pub struct ComparedImpactTimes<'a> {
    /// How impacts show in the data.
    pub sign: &'a str,
    /// Contacts that they are compared with.
    pub contacts: &'a [String],
    /// Greatest distance of a pair \[s\].
    pub window: f64,
    /// Measured instants \[s\].
    pub measured: &'a [f64],
    /// Computed instants \[s\].
    pub computed: &'a [f64],
    /// Pairs of their indices.
    pub pairs: &'a [[usize; 2]],
    /// How they agree.
    pub score: &'a ImpactScore,
}

/// The whole page; it loads nothing from outside.
#[must_use]
pub fn render_comparison(page: &ComparisonPage) -> String {
    let markup = html! {
        (DOCTYPE)
        html lang=(message::language_code()) {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="description" content=(page.headline.join(" "));
                title { (message::title_comparison(page.title)) }
                link rel="icon" href="data:,";
                style { (PreEscaped(STYLE)) (PreEscaped(OWN_STYLE)) (PreEscaped(CALCULATION_STYLE)) }
                (on_paper(page.title))
            }
            body {
                @if !page.warnings.is_empty() {
                    aside.warnings role="alert" {
                        @for warning in page.warnings { p { b { (message::warning()) " " } (warning) } }
                    }
                }
                header.head {
                    div { p.kicker { (message::comparison_with_measurements()) } h1 { (page.title) } }
                    (theme_button())
                }
                main {
                    @for sentence in page.headline { p.verdict { (sentence) } }
                    div.tiles {
                        @for (name, value) in page.facts {
                            div.tile { div.tile-name { (name) } div.tile-value.study-value.in-words { (value) } }
                        }
                    }
                    @if !page.histories.is_empty() { (scores(page)) (histories(page)) }
                    @for impacts in page.impacts { (impact_times(page, impacts)) }
                    @if !page.notes.is_empty() {
                        section #notes { h2 { (message::notes()) } ul { @for note in page.notes { li { (note) } } } }
                    }
                    (files())
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

/// Unit in which a history is shown, and how many of it make up one of the SI unit.
fn shown(unit: &str, peak: f64) -> (&str, f64) {
    let quantity = match unit {
        "m" if peak < 1.0 => format::LENGTH,
        "m" => format::HEIGHT,
        "N" => format::FORCE,
        "m/s" => format::SPEED,
        "m/s²" => format::ACCELERATION,
        _ => return (unit, 1.0),
    };
    (quantity.name(), quantity.of(1.0))
}

fn number(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "–".to_owned(), |value| format::fixed(value, digits))
}

fn scores(page: &ComparisonPage) -> Markup {
    html! {
        section #scores {
            h2 { (message::scores()) }
            p.quiet { (message::peaks_are_greatest_magnitudes_difference()) }
            div.scroll {
                table {
                    thead { tr {
                        th scope="col" { (message::measured()) } th scope="col" { (message::computed()) }
                        th.number scope="col" { (message::measured_peak()) } th.number scope="col" { (message::at()) " " span.unit { "[s]" } }
                        th.number scope="col" { (message::computed_peak()) } th.number scope="col" { (message::at()) " " span.unit { "[s]" } }
                        th.number scope="col" { (message::ratio()) } th.number scope="col" { (message::correlation()) } th.number scope="col" { (message::difference()) " " span.unit { "[%]" } }
                    } }
                    tbody {
                        @for history in page.histories {
                            @let score = history.score;
                            @let (unit, size) = shown(history.unit, score.peak_measured);
                            tr {
                                th scope="row" { (history.measured_name) } td { (history.computed_name) }
                                td.number { (format::unit(format::significant(size * score.peak_measured, 4), unit)) } td.number { (format::fixed(score.peak_measured_at_s, 3)) }
                                td.number { (format::unit(format::significant(size * score.peak_computed, 4), unit)) } td.number { (format::fixed(score.peak_computed_at_s, 3)) }
                                td.number { (number(score.peak_ratio, 3)) } td.number { (number(score.correlation, 4)) } td.number { (number(score.rms_difference.map(|d| 100.0 * d), 2)) }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn histories(page: &ComparisonPage) -> Markup {
    html! {
        section #histories {
            h2 { (message::histories()) }
            p.quiet { (message::left_the_whole_run_right()) }
            @for history in page.histories {
                h3 { (history.computed_name) }
                div.static-plots { (plot(page.time, history, None).figure()) (plot(page.time, history, Some(history.score.peak_measured_at_s)).figure()) }
            }
        }
    }
}

fn plot(time: &[f64], history: &ComparedHistory<'_>, around: Option<f64>) -> Plot {
    let (unit, size) = shown(history.unit, history.score.peak_measured);
    let range = around.map(|centre| [centre - AROUND, centre + AROUND]);
    let line = |values: &[f64], name: String, index: usize| Line {
        name,
        points: time
            .iter()
            .zip(values)
            .filter(|(t, _)| range.is_none_or(|[from, to]| (from..=to).contains(t)))
            .map(|(t, v)| [*t, size * v])
            .collect(),
        colour: COLOURS[index],
        dashed: index == 1,
    };
    Plot {
        title: match around {
            None => message::whole_run().into(),
            Some(centre) => message::around_s(format_args!("{:.2}", centre)),
        },
        x_label: message::time_s().into(),
        y_label: message::value_unit(unit),
        logarithmic: false,
        aspect: 0.5,
        lines: vec![
            line(
                history.measured,
                message::measured_measured_name(history.measured_name),
                0,
            ),
            line(history.computed, message::computed().into(), 1),
        ],
    }
}

fn impact_times(page: &ComparisonPage, impacts: &ComparedImpactTimes<'_>) -> Markup {
    let score = impacts.score;
    let end = page.time.last().copied().unwrap_or(0.0);
    let comb = |instants: &[f64], height: f64, name: &str, index: usize| Line {
        name: name.into(),
        points: std::iter::once([0.0, 0.0])
            .chain(
                instants
                    .iter()
                    .flat_map(|t| [[*t, 0.0], [*t, height], [*t, 0.0]]),
            )
            .chain([[end, 0.0]])
            .collect(),
        colour: COLOURS[index],
        dashed: false,
    };
    let plot = Plot {
        title: message::instants_of_impacts().into(),
        x_label: message::time_s().into(),
        y_label: message::up_measured_down_computed().into(),
        logarithmic: false,
        aspect: 0.22,
        lines: vec![
            comb(impacts.measured, 1.0, message::measured(), 0),
            comb(impacts.computed, -1.0, message::computed(), 1),
        ],
    };
    html! {
        section {
            h2 { (message::impacts_title()) }
            p {
                (message::measured_computed_measured_computed_matched(impacts.sign, impacts.contacts.join(", "), score.measured_count, score.computed_count, score.matched_count, format::unit(format::fixed(1e3 * impacts.window, 1), "ms")))
            }
            div style="max-width:640px" { (plot.figure()) }
            @if !impacts.pairs.is_empty() {
                div.scroll {
                    table {
                        thead { tr {
                            th.number scope="col" { (message::measured()) " " span.unit { "[s]" } } th.number scope="col" { (message::computed()) " " span.unit { "[s]" } }
                            th.number scope="col" { (message::difference()) " " span.unit { "[ms]" } }
                        } }
                        tbody {
                            @for [i, j] in impacts.pairs.iter().take(MOST_PAIRS) {
                                tr {
                                    td.number { (format::fixed(impacts.measured[*i], 4)) } td.number { (format::fixed(impacts.computed[*j], 4)) }
                                    td.number { (format::fixed(1e3 * (impacts.computed[*j] - impacts.measured[*i]), 2)) }
                                }
                            }
                        }
                    }
                }
                @if impacts.pairs.len() > MOST_PAIRS { p.quiet { (message::and_more_pairs(impacts.pairs.len() - MOST_PAIRS)) " " code { "compare.json" } "." } }
            }
        }
    }
}

fn files() -> Markup {
    let files = [
        ("compare.json", message::all_scores_and_the_instants()),
        (
            "compare.parquet",
            message::measured_and_computed_histories(),
        ),
    ];
    html! {
        section #files {
            h2 { (message::files()) }
            table { tbody { @for (name, what) in files { tr { td { code { (name) } } td.study-wrap { (what) } } } } }
        }
    }
}
