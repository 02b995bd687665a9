//! The report as a viewer of successive runs: the fixed parts of the page, and the parts of a run.

use maud::html;

use crate::document::STYLE;
use crate::envelope::{self, envelopes};
use crate::page::{self, SCRIPTS};
use crate::{Page, describe, hinges, joints, payload, tables, verdict};

/// Parts of the page that do not change with the run.
#[derive(Clone, Debug)]
pub struct Viewer {
    /// Style sheet.
    pub style: &'static str,
    /// Scripts, one module; `load` and `refresh` show a run.
    pub script: String,
    /// The section with the animation.
    pub motion: String,
    /// All other sections, with an element for each part of a [`Frame`].
    pub sections: String,
    /// The bar of playback.
    pub player: String,
}

impl Viewer {
    /// The viewer of the report, empty.
    #[must_use]
    pub fn new() -> Self {
        let sections = html! {
            div #part-tiles {}
            p #accuracy.quiet {}
            (page::chart_section(true))
            div #part-hinges {}
            section { h2 { "Impacts" } (page::impact_panels()) div #part-impacts {} }
            section { h2 { "Peaks over the height" } div #part-envelopes {} }
            section #code { h2 { "Comparison with code requirements" } div #part-joints {} }
            section { h2 { "What was computed" } div #part-model {} }
        };
        Self {
            style: STYLE,
            script: SCRIPTS.concat(),
            motion: page::motion_section(true, true).into_string(),
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
            p.quiet { "The model has no gap." }
        } @else {
            (tables::impacts(page))
        }
    };
    let peaks = html! {
        (page::legend(page, without.is_some()))
        (envelopes(page, &run, without))
    };
    let joints = html! {
        @if !page.model.gaps.is_empty() { (joints::joints(page, &run, without)) }
    };
    let parts = [
        ("warnings", page::warnings(page)),
        ("tiles", page::tiles(page)),
        ("hinges", hinges::section(page).unwrap_or_default()),
        ("impacts", impacts),
        ("envelopes", peaks),
        ("joints", joints),
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
