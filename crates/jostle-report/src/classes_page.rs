//! The page of classes: how much pounding moves fragility, by storeys of both buildings.

use maud::{DOCTYPE, PreEscaped, html};
use serde_json::Value;

use crate::document::{POLICY, STYLE, theme_button};
use crate::message;

const SCRIPTS: [&str; 3] = [
    include_str!("../assets/messages.js"),
    include_str!("../assets/theme.js"),
    include_str!("../assets/classes.js"),
];
const STUDY_STYLE: &str = include_str!("../assets/study.css");

/// The page of classes: one HTML file that opens offline. `data` holds `pairs`, `curves`, `gaps`, `states`, `measure`,
/// `range`, counts, deviations and `warnings`; intensities are in g.
#[must_use]
pub fn render_classes(title: &str, data: &Value) -> String {
    // A closing tag inside a name must not end the script.
    let text = data.to_string().replace('<', "\\u003c");
    let script = SCRIPTS.concat();
    let number = |key: &str| data[key].as_f64().unwrap_or(0.0);
    let deviation = |key: &str| format!("{:.1e}", number(key));
    let warnings = data["warnings"].as_array().map_or(&[][..], Vec::as_slice);
    let page = html! {
        (DOCTYPE)
        html lang=(message::language_code()) {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                title { (title) " – jostle" }
                link rel="icon" href="data:,";
                style { (PreEscaped(STYLE)) (PreEscaped(STUDY_STYLE)) }
            }
            body {
                header.head {
                    div { p.kicker { (message::fragility_of_classes()) } h1 { (title) } }
                    (theme_button())
                }
                main {
                    p.verdict { (message::classes_cases(number("cases"), number("motions"), number("draws"))) }
                    @if number("checked") > 0.0 {
                        p.quiet { (message::classes_checked(number("checked"), deviation("drift_deviation"), deviation("force_deviation"))) }
                    }
                    @for own in warnings.iter().filter_map(Value::as_str) {
                        p.note { (message::warning()) " " (own) }
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
                        p.quiet { (message::classes_map_help()) }
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
                        p { (message::classes_limits_text()) }
                    }
                }
                footer { (message::made_by_jostle_version(crate::version())) }
                noscript { p.note { (message::the_charts_need_javascript()) } }
                script #page-data type="application/json" { (PreEscaped(text)) }
                (message::for_scripts(&script))
                script type="module" { (PreEscaped(script)) }
            }
        }
    };
    page.into_string()
}
