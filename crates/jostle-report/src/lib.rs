//! The report page of a run: one HTML file that opens offline, animated.
//!
//! [`render`] turns a [`Page`] into the whole text of `report.html`. Pictures and numbers stay apart: the
//! numbers come from the core crate as they are, this crate only chooses, thins, encodes and draws them.

mod describe;
mod encode;
mod envelope;
mod format;
mod method;
mod page;
mod payload;
mod tables;
mod verdict;

pub use method::render_method;

use jostle::summary::GapSummary;
use jostle::{Gap, GroundMotion, History, Model, Summary};

/// Everything a report shows.
#[derive(Clone, Copy, Debug)]
pub struct Page<'a> {
    /// What was computed.
    pub model: &'a Model,
    /// Ground motion as used.
    pub motion: &'a GroundMotion,
    /// Numbers of the run.
    pub summary: &'a Summary,
    /// Time histories of the run.
    pub history: &'a History,
    /// Time histories of the same buildings passing through each other: the same columns, on instants of
    /// their own. `None` when that run was not made.
    pub without_contact: Option<&'a History>,
}

impl<'a> Page<'a> {
    /// Every gap of the summary with its description in the model.
    fn gaps(&self) -> impl Iterator<Item = (&'a GapSummary, &'a Gap)> {
        let (model, summary) = (self.model, self.summary);
        summary.gaps.iter().filter_map(move |gap| {
            let left_name = |candidate: &&Gap| {
                let left = model.buildings.get(candidate.left);
                left.is_some_and(|building| building.name == gap.between[0])
            };
            Some((gap, model.gaps.iter().find(left_name)?))
        })
    }
}

/// The whole HTML page. It loads nothing from outside and stays below 1 MB for ordinary runs.
///
/// The contacts of `summary.gaps`, counted through all gaps, are the contact indices of the histories.
#[must_use]
pub fn render(page: &Page) -> String {
    page::page(page).into_string()
}
