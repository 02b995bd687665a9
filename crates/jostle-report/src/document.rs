//! What all pages share: style sheet, security policy, colours of buildings, and the button for light and dark.

use crate::message;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use serde_json::Value;

/// The style sheet.
pub(crate) const STYLE: &str = include_str!("../assets/style.css");
/// Plots without scripts, and the page on paper.
pub(crate) const CALCULATION_STYLE: &str = include_str!("../assets/calculation.css");

/// Nothing may be loaded: everything is in the file.
pub(crate) const POLICY: &str =
    "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:";

/// Script of [`theme_button`], for pages without other scripts.
const THEME_SCRIPT: &str = include_str!("../assets/theme.js");

/// The style of the foot of printed pages, which names the document.
pub(crate) fn on_paper(title: &str) -> Markup {
    let escaped: String = title
        .chars()
        .flat_map(|letter| match letter {
            '"' | '\\' => vec!['\\', letter],
            // No tag may end the style, no line the text.
            '<' => "\\3c ".chars().collect(),
            other if other.is_control() => vec![' '],
            other => vec![other],
        })
        .collect();
    let style = format!("@page{{@bottom-left{{content:\"{escaped} – jostle\"}}}}");
    html! { style media="print" { (PreEscaped(style)) } }
}

/// The button that switches between light and dark.
pub(crate) fn theme_button() -> Markup {
    html! {
        button #theme.quiet-button type="button" title=(message::switch_between_light_and_dark()) aria-label=(message::switch_between_light_and_dark()) { "◐" }
    }
}

/// The script of that button, for pages without other scripts.
pub(crate) fn theme_script() -> Markup {
    html! { script type="module" { (PreEscaped(THEME_SCRIPT)) } }
}

/// The style attribute that gives an element the colour of a building.
pub(crate) fn colour(building: usize) -> String {
    format!("--c:var(--c{})", building % 7)
}

/// A page that opens offline, of any content: heading, style sheet, button for light and dark, data as JSON for a script.
///
/// `body` is HTML; `style` follows the style sheet of all pages; `script` is a module that reads `#page-data`.
#[must_use]
pub fn render_document(
    title: &str,
    kicker: &str,
    body: &str,
    data: &Value,
    style: &str,
    script: &str,
) -> String {
    // A closing tag inside a name must not end the script.
    let data = data.to_string().replace('<', "\\u003c");
    let page = html! {
        (DOCTYPE)
        html lang=(message::language_code()) {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                title { (title) " – jostle" }
                link rel="icon" href="data:,";
                style { (PreEscaped(STYLE)) (PreEscaped(style)) }
                (on_paper(title))
            }
            body {
                header.head {
                    div { p.kicker { (kicker) } h1 { (title) } }
                    (theme_button())
                }
                main { (PreEscaped(body)) }
                footer { (message::made_by_jostle_version(crate::version())) }
                noscript { p.note { (message::the_charts_need_javascript()) } }
                script #page-data type="application/json" { (PreEscaped(data)) }
                @if !script.is_empty() {
                    (message::for_scripts(script))
                    script type="module" { (PreEscaped(script)) }
                }
                (theme_script())
            }
        }
    };
    page.into_string()
}
