//! What all pages share: style sheet, security policy, colours of buildings, and the button for light and dark.

use crate::message;
use maud::{Markup, PreEscaped, html};

/// The style sheet.
pub(crate) const STYLE: &str = include_str!("../assets/style.css");
/// Plots without scripts, and the page on paper.
pub(crate) const CALCULATION_STYLE: &str = include_str!("../assets/calculation.css");

/// Nothing may be loaded: everything is in the file.
pub(crate) const POLICY: &str =
    "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:";

/// Script of [`theme_button`], for pages without other scripts.
const THEME_SCRIPT: &str = include_str!("../assets/theme.js");

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
