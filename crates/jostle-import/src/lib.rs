//! Models of ETABS and SAP2000 as model files of jostle.
//!
//! Input is the bytes of files, output is text; nothing is opened, run or printed. What a file says is gathered in
//! one list of facts, whatever its format; one of these ways makes a building of it: flexibility, modes or storey
//! stiffness of tables, or the members of a text model, as a space frame or as matrices. Nothing is guessed without being listed in [`Imported::remarks`], and what
//! is not carried over is listed in [`Imported::left_out`] with what it means.

mod assembled;
mod beam;
mod e2k;
mod e2k_keys;
mod element;
mod facts;
mod given;
mod import;
mod joints;
mod known;
mod left_out;
mod listing;
mod matrix;
mod member;
mod options;
mod s2k;
mod s2k_keys;
mod section;
mod space_frame;
mod tables;
mod text;
mod towers;
mod units;
mod wall_panel;
mod workbook;

pub use import::{BuildingPeriods, Imported, Program, SourceFile, import};
pub use options::{Direction, ImportOptions, Way};
