//! The page of classes: how much pounding moves fragility, by storeys of both buildings.

use maud::html;
use serde_json::Value;

use crate::document::render_document;
use crate::{format, message};

const SCRIPTS: [&str; 3] = [
    include_str!("../assets/messages.js"),
    include_str!("../assets/plot.js"),
    include_str!("../assets/classes.js"),
];
const STUDY_STYLE: &str = include_str!("../assets/study.css");

/// Motions below which medians say little of others \[–\].
const FEW_MOTIONS: f64 = 7.0;

/// How much pounding changes the intensity of damage, over all pairs; `None` where no pair has a factor.
fn answer(data: &Value) -> Option<String> {
    let curves = data["curves"].as_array()?.iter();
    let factors = curves.filter_map(|curve| curve["factor"].as_f64());
    let least = factors.clone().min_by(f64::total_cmp)?;
    let most = factors.max_by(f64::total_cmp)?;
    Some(message::classes_answer(
        format::fixed(least, 2),
        format::fixed(most, 2),
    ))
}

/// The page of classes: one HTML file that opens offline. `data` holds `pairs`, `curves`, `gaps`, `states`, `measure`,
/// `range`, counts, deviations, `warnings` and the names of the tables of `capacities` and `damage`; intensities are in g.
#[must_use]
pub fn render_classes(title: &str, data: &Value) -> String {
    let number = |key: &str| data[key].as_f64().unwrap_or(0.0);
    let text = |key: &str| data[key].as_str().unwrap_or("HAZUS");
    let deviation = |key: &str| {
        let percent = format::significant(100.0 * number(key), 2);
        format::unit(percent, "%")
    };
    let warnings = data["warnings"].as_array().map_or(&[][..], Vec::as_slice);
    let body = html! {
        @if let Some(answer) = answer(data) { p.verdict { (answer) } }
        p.quiet { (message::classes_cases(number("cases"), number("motions"), number("draws"))) }
        @if number("checked") > 0.0 {
            p.quiet { (message::classes_checked(number("checked"), deviation("drift_deviation"), deviation("force_deviation"))) }
        }
        @for own in warnings.iter().filter_map(Value::as_str) {
            p.note { b { (message::warning()) } " " (own) @if !own.ends_with('.') { "." } }
        }
        @if number("motions") < FEW_MOTIONS {
            p.note { b { (message::warning()) } " " (message::classes_few_motions(number("motions"))) }
        }
        section {
            h2 { (message::classes_map()) }
            div.controls {
                label { (message::classes_class()) " " select #class {} }
                label { (message::classes_neighbour()) " " select #neighbour {} }
                label { (message::classes_place()) " " select #place {} }
                label { (message::classes_state()) " " select #state {} }
                label { (message::show()) " " select #shown {} }
                label { (message::classes_gap()) " " input #gap type="range" min="0" step="1"; " " output #gap-width {} }
            }
            figure.study-map { div #map {} }
            p.quiet { (message::classes_map_help()) " " span.screen { (message::classes_map_click()) " " } (message::classes_names()) }
        }
        section {
            h2 { (message::classes_curves()) }
            p #chosen {}
            figure.study-map { div #curve {} }
            p.quiet { (message::classes_curves_help()) }
            div.scroll { table #numbers {} }
        }
        section {
            h2 { (message::classes_limits()) }
            p { (message::classes_sources(text("capacities"), text("damage"))) }
            p { (message::classes_limits_text()) }
        }
    };
    render_document(
        title,
        message::fragility_of_classes(),
        &body.0,
        data,
        STUDY_STYLE,
        &SCRIPTS.concat(),
    )
}
