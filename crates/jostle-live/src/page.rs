//! The page: the viewer of the report, with input fields around it.

use jostle_report::Viewer;
use jostle_report::message;
use maud::{DOCTYPE, Markup, PreEscaped, html};

const STYLE: &str = include_str!("../assets/live.css");
/// Scripts after those of the viewer, in the order of their dependence. The last one starts the page.
const SCRIPTS: [&str; 4] = [
    include_str!("../assets/model.js"),
    include_str!("../assets/knobs.js"),
    include_str!("../assets/curve.js"),
    include_str!("../assets/map.js"),
];
const START: &str = include_str!("../assets/live.js");
/// How messages reach the engine.
const SOCKET: &str = include_str!("../assets/socket.js");
const WIDGET: &str = include_str!("../assets/widget.js");
const INSIDE: &str = include_str!("../assets/inside.js");

/// What differs between a page of a server and others.
struct Around<'a> {
    /// Name of the model.
    name: &'a str,
    /// Script with `send` and `connect`.
    link: &'a str,
    /// Security policy in the page itself.
    policy: Option<&'a str>,
    /// Mark of scripts that the policy allows.
    nonce: Option<&'a str>,
    /// Elements with the engine and the model.
    inside: Markup,
    footer: &'a str,
}

/// The page of a server, and its security policy.
pub(crate) fn page(name: &str, port: u16, token: &str) -> (String, String) {
    // The token is random and known to this page alone, so it also marks its scripts.
    let policy = format!(
        "default-src 'none'; script-src 'nonce-{token}'; style-src 'unsafe-inline'; img-src data:; \
         connect-src ws://127.0.0.1:{port} ws://localhost:{port}; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    );
    let page = document(&Around {
        name,
        link: SOCKET,
        policy: None,
        nonce: Some(token),
        inside: html! {},
        footer: message::runs_on_this_machine(),
    });
    (page, policy)
}

/// A page with its engine inside: `inside` are the elements that hold engine, worker and model.
pub(crate) fn page_with_engine(name: &str, inside: Markup) -> String {
    document(&Around {
        name,
        link: INSIDE,
        policy: Some(
            "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:; worker-src blob:; \
             style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'",
        ),
        nonce: None,
        inside,
        footer: message::runs_inside_this_page_without(),
    })
}

/// The page of a notebook: it sits in a frame, and the notebook carries its messages.
#[must_use]
pub fn widget_page(name: &str) -> String {
    document(&Around {
        name,
        link: WIDGET,
        policy: Some(
            "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'",
        ),
        nonce: None,
        inside: html! {},
        footer: message::runs_in_this_notebook(),
    })
}

/// All scripts of a page, one module.
fn script(viewer: &Viewer, link: &str) -> String {
    [&viewer.script, "\n", &SCRIPTS.concat(), link, START].concat()
}

fn document(around: &Around) -> String {
    let viewer = Viewer::new();
    let name = std::path::Path::new(around.name)
        .file_name()
        .unwrap_or_default()
        .to_string_lossy();
    let script = script(&viewer, around.link);
    let markup = html! {
        (DOCTYPE)
        html lang=(message::language_code()) {
            head {
                meta charset="utf-8";
                @if let Some(policy) = around.policy { meta http-equiv="Content-Security-Policy" content=(policy); }
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (message::title_jostle_live(&name)) }
                link rel="icon" href="data:,";
                style { (PreEscaped(&viewer.style)) (PreEscaped(STYLE)) }
            }
            body.live {
                a.skip href="#headline" { (message::skip_to_the_results()) }
                header.topbar {
                    h1 { (message::jostle_live()) " " span #model-name.quiet { (name) } }
                    div.buttons role="group" aria-label=(message::this_model()) {
                        button #undo type="button" title=(message::undo_ctrl_z()) disabled { (message::undo()) }
                        button #redo type="button" title=(message::redo_ctrl_shift_z()) disabled { (message::redo()) }
                        button #pin type="button" aria-pressed="false" title=(message::keep_this_run_for_comparison()) { (message::pin()) }
                        button #save-model type="button" { (message::save_model()) }
                        button #save-report type="button" { (message::save_report()) }
                        button #theme.quiet-button type="button" title=(message::switch_between_light_and_dark()) aria-label=(message::switch_between_light_and_dark()) { "◐" }
                    }
                }
                p #connection.connection role="status" hidden {}
                div.columns-of-page {
                    (knobs())
                    main {
                        div #working.working hidden { progress #progress max="1" aria-label=(message::share_of_the_run()) {} output #done {} button #stop type="button" { (message::stop()) } }
                        p #headline.verdict tabindex="-1" aria-live="polite" { (message::running_the_model()) }
                        div #part-warnings {}
                        div #part-tiles {}
                        div.pair {
                            (curve())
                            div #animation { (PreEscaped(viewer.motion)) }
                        }
                        section #compare hidden { h2 { (message::compared_with_the_pinned_run()) } div.scroll { table #comparison {} } }
                        div #result {
                            (PreEscaped(viewer.sections))
                            div #notes.note hidden {}
                        }
                    }
                }
                footer { "jostle " (env!("CARGO_PKG_VERSION")) " " (around.footer) }
                (around.inside)
                (PreEscaped(viewer.player))
                noscript { p.note { (message::this_page_needs_javascript()) } }
                (message::for_scripts(&script))
                script type="module" nonce=[around.nonce] { (PreEscaped(script)) }
            }
        }
    };
    markup.into_string()
}

fn knobs() -> Markup {
    html! {
        aside.knobs aria-label=(message::the_model()) {
            label.search-label { span.wordy-label { (message::find_any_value()) }
                input #search type="search" placeholder=(message::damping_stiffness_column()) autocomplete="off" spellcheck="false";
            }
            label #record-choice hidden { (message::record_of_the_list()) " " select #several {} }
            div #faults.faults role="alert" hidden {}
            p #gap-of-plan.quiet hidden { (message::gap_follows_from_plans()) }
            div #knob-list {}
            datalist #record-names {}
            details #editor {
                summary { (message::model_file()) }
                textarea #text rows="24" spellcheck="false" autocomplete="off" aria-label=(message::text_of_the_model_file()) {}
            }
        }
    }
}

fn curve() -> Markup {
    html! {
        section #curve aria-label=(message::curve()) {
            div.controls {
                label { select #measure aria-label=(message::result_title()) {
                    option value="0" { (message::peak_force_title()) }
                    option value="1" { (message::number_of_impacts()) }
                    option value="2" { (message::peak_storey_drift()) }
                    option value="3" { (message::peak_floor_acceleration()) }
                } }
                label { (message::over()) " " select #over {} }
                label { (message::and_word()) " " select #across {} }
                label { (message::from()) " " input #from size="7" inputmode="decimal"; }
                label { (message::to()) " " input #to size="7" inputmode="decimal"; }
                output #unit.quiet {}
                details.records-of-curve { summary { (message::records()) } div #curve-records {} }
                button #save-study type="button" { (message::save_study()) }
            }
            p #curve-note.quiet { (message::drag_the_line_or_use()) }
            figure.chart { figcaption #curve-caption {} div #curve-picture {} }
            ul #curve-marks.curve-marks {}
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// A browser refuses the whole script of a page that declares a name twice.
    #[test]
    fn scripts_of_a_page_declare_every_name_once() {
        let viewer = Viewer::new();
        for link in [SOCKET, WIDGET, INSIDE] {
            let script = script(&viewer, link);
            let mut known = BTreeSet::new();
            for line in script.lines() {
                let line = line.strip_prefix("async ").unwrap_or(line);
                let Some((word, rest)) = line.split_once(' ') else {
                    continue;
                };
                if !["const", "let", "class", "function"].contains(&word) {
                    continue;
                }
                // Several may be taken out of an object or a list.
                let names = rest.split(['=', '(']).next().unwrap_or(rest);
                let part = |c: char| !(c.is_alphanumeric() || c == '_' || c == '$');
                let name = names.split(part).find(|name| !name.is_empty());
                assert!(known.insert(name), "{line}");
            }
            assert!(known.len() > 100);
        }
    }
}
