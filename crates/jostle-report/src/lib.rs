//! The report page of a run: one HTML file that opens offline, animated.
//!
//! [`render`] turns a [`Page`] into the whole text of `report.html`. Pictures and numbers stay apart: the
//! numbers come from the core crate as they are, this crate only chooses, thins, encodes and draws them.

mod backbones;
mod bounds;
mod build;
mod calculation;
mod checks;
mod classes_page;
mod collisions;
mod comparison;
mod contact_box;
mod damage;
mod describe;
mod devices;
mod diagrams;
mod document;
mod drawn_members;
mod encode;
mod envelope;
mod face_pressure;
mod facts;
mod fibre_paths;
mod fibres;
mod floor_spectra;
mod format;
mod friction;
mod grounds;
mod hinges;
mod joints;
mod members;
pub mod message;
mod method;
mod motion_page;
mod page;
mod panels;
mod payload;
mod plan_motion;
mod pounding_effect;
mod pushover;
mod rotation_levels;
mod rules;
mod scale;
mod section;
mod selection;
mod shear_failures;
mod site_drawing;
mod site_places;
mod site_plan;
mod special;
mod spread;
mod static_plot;
mod study_page;
mod tables;
mod thin_loop;
mod tiles;
mod verdict;
mod viewer;
mod walls;

pub use build::{BUILD, version};
pub use calculation::{Calculation, ShownMode, TitleBlockPart};
pub use classes_page::render_classes;
pub use collisions::{CollidedLaw, Collisions, loops_svg, render_collisions};
pub use comparison::{ComparedHistory, ComparedImpactTimes, ComparisonPage, render_comparison};
pub use contact_box::ContactBox;
pub use damage::{Damage, damage, footing_name};
pub use document::render_document;
pub use format::typeset;
pub use method::render_method;
pub use motion_page::{MotionPage, render_motion};
pub use pounding_effect::{Extremes, changes};
pub use pushover::{Demand, render_pushover};
pub use rules::{required_width, rows_of_rules, rule_name};
pub use section::render_sections;
pub use selection::{CheckedStructure, SelectionPage, render_selection, selection_sections};
pub use site_drawing::site_svg;
pub use site_places::SitePlace;
pub use study_page::{
    Axis, Bar, Bars, Cell, Chart, HeatMap, Level, Petal, Rose, Section, Series, Stroke, StudyPage,
    SuitePage, SuiteRow, render_study, render_suite, with_three_digits, with_unit,
};
pub use verdict::verdict;
pub use viewer::{Frame, Viewer, frame};

use jostle::history::SpringHistory;
use jostle::method::MethodSurvey;
use jostle::results::summary::{GapSummary, LinkSummary};
use jostle::{Gap, GroundMotion, History, Link, Model, Summary, System};
use jostle_section::formula::Member;

/// Everything a report shows.
#[derive(Clone, Copy, Debug)]
pub struct Page<'a> {
    /// What was computed.
    pub model: &'a Model,
    /// Its buildings as they were computed.
    pub system: &'a System,
    /// Ground motion as used.
    pub motion: &'a GroundMotion,
    /// Numbers of the run.
    pub summary: &'a Summary,
    /// Time histories of the run.
    pub history: &'a History,
    /// Time histories of the same buildings without contact: the same columns at other instants.
    /// `None` if there was no such run.
    pub without_contact: Option<&'a History>,
    /// Loops of hinges and yielding storeys at the instants of `history`, if there are any.
    pub springs: Option<&'a SpringHistory>,
    /// Reinforced sections that hinges come from, if the model states them.
    pub sections: &'a [ReinforcedSection<'a>],
    /// Inputs of the separation rules of codes.
    pub codes: &'a jostle::separation::CodeInputs,
    /// Angle from x to north, counter-clockwise; `None` to draw no north \[rad\].
    pub north: Option<f64>,
    /// Contact data beside what masses suggest, by gap; empty to omit them.
    pub contacts: &'a [ContactBox],
    /// Results of `jostle method` for these buildings, shown as a section; empty to omit it.
    pub methods: &'a [MethodSurvey],
    /// What makes the page a calculation document, if it is known.
    pub calculation: Option<&'a Calculation<'a>>,
}

/// A reinforced section and the members of a building that have it.
#[derive(Clone, Debug)]
pub struct ReinforcedSection<'a> {
    /// Index of the building.
    pub building: usize,
    /// Columns or beams.
    pub member: Member,
    /// The section.
    pub section: &'a jostle_section::Section,
    /// Names of its members within the building.
    pub members: Vec<&'a str>,
    /// Lowest and highest storey or floor, from 1.
    pub floors: [usize; 2],
    /// Least and greatest axial compression \[N\].
    pub compression: [f64; 2],
}

impl<'a> ReinforcedSection<'a> {
    /// Adds a member of a storey or a floor, from 1, with its axial compression \[N\].
    pub fn add(&mut self, name: &'a str, floor: usize, compression: f64) {
        self.members.push(name);
        self.floors = [self.floors[0].min(floor), self.floors[1].max(floor)];
        let [low, high] = self.compression;
        self.compression = [low.min(compression), high.max(compression)];
    }
}

impl<'a> Page<'a> {
    /// Every gap of the summary with its description in the model, in the same order.
    fn gaps(&self) -> impl Iterator<Item = (&'a GapSummary, &'a Gap)> {
        self.summary.gaps.iter().zip(&self.model.gaps)
    }

    /// Every link of the summary with its description in the model, in the same order.
    fn links(&self) -> impl Iterator<Item = (&'a LinkSummary, &'a Link)> {
        self.summary.links.iter().zip(&self.model.links)
    }
}

/// The whole HTML page. It loads nothing from outside and stays below 1 MB for ordinary runs.
///
/// The contacts of `summary.gaps`, counted through all gaps, are the contact indices of the histories.
#[must_use]
pub fn render(page: &Page) -> String {
    page::page(page).into_string()
}
