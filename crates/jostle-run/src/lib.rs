//! Runs of models, the same for the command line, Python, studies and the live page.
//!
//! [`open()`] reads and assembles a model, [`Opened::prepare`] chooses its steps, [`Prepared::run`] makes the run, and
//! [`Results::write`] writes its files. Progress goes to an observer, which can stop the run. Nothing is printed, and no
//! terminal is read.

#![cfg_attr(not(test), deny(clippy::disallowed_methods))] // bits of results depend on no processor

mod calculation;
mod case_cache;
mod check;
mod checks_text;
#[cfg(not(target_family = "wasm"))]
mod claim;
mod codes_text;
mod collide;
mod comparison;
mod contact_advice;
mod contact_sensitivity;
mod critical_gap;
mod error;
mod expectation;
mod export;
mod files;
mod floor_spectra;
mod floor_spectra_text;
mod footing_text;
mod gap_page;
mod gap_runs;
mod gradients;
mod history_file;
mod isolation_bounds;
mod method;
mod modes;
mod motions;
mod numbers;
mod observer;
mod opened;
mod parts_text;
mod pdf;
mod prepared;
mod pushover;
mod replace;
mod results;
mod run;
mod section;
mod sections_text;
mod shapes;
mod spectra;
mod style;
mod summary_text;
mod variants;
#[cfg(not(target_family = "wasm"))]
mod workbook;

pub use case_cache::{CaseCache, CaseError};
pub use check::{Check, CheckedRecord, ExpectedWork, check};
pub use checks_text::{finding_with_remedy, write_findings};
#[cfg(not(target_family = "wasm"))]
pub use claim::FolderClaim;
pub use collide::{CollideOptions, collide, collision_json};
pub use comparison::{
    Comparison, HistoryComparison, ImpactComparison, Measurements, PreparedComparison,
    earlier_comparison, prepare_comparison,
};
pub use contact_advice::{
    AdviceOptions, ContactAdvice, LEAST_TRANSITS, RangeAdvice, StiffnessEstimate, WaveAdvice,
    contact_advice,
};
pub use critical_gap::{
    CriticalGap, GapOutcome, GapProgress, GapSearch, GapSet, GapSettings, LeftOutRule, RuleGap,
    critical_gaps, gap_sets, search_gaps,
};
pub use error::RunError;
pub use expectation::{Expectation, Pace};
pub use export::{export_matrices, export_script, may_write_script};
pub use files::{Content, earlier_files};
pub use floor_spectra::RunFloorSpectra;
pub use gap_page::{
    PAGE as GAP_PAGE, earlier_gap_files, gap_curve_csv, gap_json, gap_page, gap_rules_csv,
    write_gap_files,
};
pub use gap_runs::{GapError, GapPoint};
pub use gradients::GradientRequest;
pub use history_file::STORAGE;
pub use isolation_bounds::{RunsAtBounds, add_bounds};
pub use method::{methods_text, survey_methods};
pub use modes::{ListedModes, floor_shape, list_modes, modes_json};
pub use motions::{
    NamedMotion, Noise, Processing, Pulse, Selection, SelectionRequest, SpectrumMatch, Synthesis,
    made_by_recipe, measures_json, motion_in_short, motion_text, write_motion,
};
pub use numbers::{counted, counted_grouped, grouped, kn, mm};
pub use observer::{Observer, Stage, stopped_by};
pub use opened::{EXAMPLE, Opened, name_of, open, read};
pub use pdf::{Paper, find_chromium, print_pdf};
pub use prepared::Prepared;
pub use pushover::{checked_drift, chosen_buildings, pushed_buildings, pushover_json};
pub use replace::{FileKind, may_write};
pub use results::Results;
pub use run::Ran;
pub use section::{SectionOptions, section, sections, sections_json, sections_text};
pub use shapes::SharedShapes;
pub use spectra::{Inelastic, accelerogram, spectra_json, spectrum_json};
pub use style::{BOLD, DIM, LOUD, plain, styled};
pub use summary_text::{describe_summary, summary_text};
#[cfg(not(target_family = "wasm"))]
pub use workbook::workbook;
