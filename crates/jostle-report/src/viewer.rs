//! The report as a viewer of successive runs: the fixed parts of the page, and the parts of a run.

use maud::html;

use crate::document::STYLE;
use crate::envelope::{self, envelopes};
use crate::message;
use crate::page::{self, IN_SPACE, SCRIPTS};
use crate::site_drawing::SITE_STYLE;
use crate::{
    Page, checks, describe, friction, hinges, joints, payload, site_plan, tables, verdict,
};

/// Parts of the page that do not change with the run.
#[derive(Clone, Debug)]
pub struct Viewer {
    /// Style sheet.
    pub style: String,
    /// Scripts, one module; `load` and `refresh` show a run.
    pub script: String,
    /// The section with the animation.
    pub motion: String,
    /// All other sections, with an element for each part of a [`Frame`] but warnings and tiles, which stand above.
    pub sections: String,
    /// The bar of playback.
    pub player: String,
}

impl Viewer {
    /// The viewer of the report, empty.
    #[must_use]
    pub fn new() -> Self {
        let sections = html! {
            (site_plan::scene())
            div #part-checks {}
            div #part-site {}
            (page::chart_section(true))
            div #part-hinges {}
            section { h2 { (message::impacts_title()) } (page::impact_panels()) div #part-impacts {} }
            section { h2 { (message::peaks_over_the_height()) } div #part-envelopes {} }
            section #code { h2 { (message::comparison_with_code_requirements()) } div #part-joints {} }
            section { h2 { (message::what_was_computed()) } div #part-model {} }
        };
        let motion = page::motion_section(true, true);
        Self {
            style: [STYLE, SITE_STYLE].concat(),
            script: IN_SPACE.concat() + &SCRIPTS.concat(),
            motion: motion.into_string(),
            sections: sections.into_string(),
            player: page::player(true).into_string(),
        }
    }
}

impl Default for Viewer {
    fn default() -> Self {
        Self::new()
    }
}

/// What one run puts into a [`Viewer`].
#[derive(Clone, Debug)]
pub struct Frame {
    /// What happened, in a sentence.
    pub headline: String,
    /// Markup by the name of the element that takes it.
    pub parts: Vec<(&'static str, String)>,
    /// Data of the scripts as JSON; lists of numbers are parts of `numbers`.
    pub data: String,
    /// Histories, in SI.
    pub numbers: Vec<f32>,
}

/// What a run puts into a [`Viewer`].
#[must_use]
pub fn frame(page: &Page) -> Frame {
    let run = envelope::of_run(page);
    let without = envelope::without_contact(page);
    let without = without.as_deref();
    let impacts = html! {
        @if page.model.gaps.is_empty() {
            p.quiet { (message::the_model_has_no_gap()) }
        } @else {
            (tables::impacts(page))
            (friction::section(page))
        }
    };
    let peaks = html! {
        (page::legend(page, without.is_some()))
        (envelopes(page, &run, without))
    };
    let joints = html! {
        @if !page.model.gaps.is_empty() { (joints::joints(page)) }
    };
    let parts = [
        ("warnings", page::warnings(page)),
        ("tiles", crate::tiles::tiles(page)),
        ("checks", checks::section(page)),
        ("hinges", hinges::section(page).unwrap_or_default()),
        ("impacts", impacts),
        ("envelopes", peaks),
        ("joints", joints),
        ("site", site_plan::section(page).unwrap_or_default()),
        ("model", describe::model(page)),
    ];
    let (data, numbers) = payload::frame(page);
    Frame {
        headline: verdict(page.summary),
        parts: parts
            .map(|(name, markup)| (name, markup.into_string()))
            .to_vec(),
        data,
        numbers,
    }
}
