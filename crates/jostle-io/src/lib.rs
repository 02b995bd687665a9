//! Reads model files and ground motions; writes result files.
//!
//! Parsers take text or bytes and never panic. All reading of files goes through [`Files`] and [`read_file`], which refuse
//! what may not be read, what is no plain file and what is too large. Everything that leaves this crate is in SI.

#![cfg_attr(not(test), deny(clippy::disallowed_methods))] // bits of results depend on no processor

mod archive;
mod baseline;
mod builtin;
mod builtin_model;
mod checks_page;
mod choices;
mod city_file;
mod city_motion;
mod classes_file;
mod comparison_map;
mod csv;
mod fault;
mod files;
mod floor_table;
mod grade;
mod json_remedies;
mod keys;
mod knobs;
mod matrices;
mod model_file;
mod model_tree;
mod motion_spec;
mod nearest;
mod origin;
mod output;
mod pushover;
mod quantities_page;
mod quantity;
mod reader;
mod record;
mod record_list;
mod record_text;
mod reference;
mod response_tables;
mod rewrite;
mod schema;
mod selection;
pub mod shown;
mod shown_text;
mod source;
mod study_file;
mod tables;
mod target;
mod templates;
mod tree;
mod types_tables;
mod undamaged;
mod unit;
mod unusual;
mod us_template;

pub use archive::archive_text;
pub use baseline::Baseline;
pub use builtin::{BUILTIN_RECORDS, BuiltinRecord, builtin_motions, builtin_record};
pub use builtin_model::{builtin_model, model_names, model_text};
pub use checks_page::{check_list, check_reference};
pub use city_file::{CityFile, CityLevel};
pub use city_motion::{CityMotion, IntensityFile};
pub use classes_file::{ClassesFile, ClassesMeasure, ClassesSide};
pub use comparison_map::{
    ComparedColumn, ComparedImpacts, ComparisonMap, ImpactSign, NamedColumn, TableMotion,
};
pub use csv::csv_field;
pub use fault::{Fault, InputError};
pub use files::{FileError, Files, open_file, plain, read_file, read_text_file};
pub use floor_table::{floor_spectra_columns, write_floor_spectra_parquet};
pub use grade::{parse_concrete, parse_steel};
/// Standard gravity: the size of the unit `g`, and of a weight given where a mass is wanted \[m/s²\].
pub use jostle::statics::STANDARD_GRAVITY;
pub use keys::LAW_NAMES;
pub use knobs::{Knob, KnobKind};
pub use matrices::numpy_archive;
pub use model_file::{
    CapacityRequest, FloorSpectraRequest, Input, KnownMembers, OverrideError, Overrides,
    ProfiledMember, ReinforcedMember, TitleBlock, read_model_file, read_model_text,
};
pub use model_tree::{ModelTree, PathError, TreeValue};
pub use motion_spec::{
    BearingSpec, GroundsSpec, MatchSpec, MatchTo, MotionError, MotionSource, MotionSpec,
    OwnGroundSpec, OwnMotionSpec, Scaling,
};
pub use nearest::nearest as nearest_name;
pub use output::{
    OutputError, PART_SUFFIX, part_prefix, put_in_place, remove_leftovers, summary_json,
    write_atomically, write_summary_json,
};
pub use pushover::{pushover_csv, pushover_json, pushover_tree};
pub use quantities_page::{quantity_list, quantity_reference};
pub use quantity::{Dimension, QuantityError, in_unit_of, parse_quantity};
pub use record::measured::{MeasuredColumn, MeasuredTable};
pub use record::{
    Channel, Direction, Record, RecordContent, RecordError, RecordFormat, RecordInfo, RecordLayout,
    RecordOptions, describe_record, parse_info, parse_record, parse_record_and_info, read_record,
    read_record_and_info,
};
pub use record_text::{at2_text, csv_text};
pub use reference::model_reference;
pub use response_tables::{
    building_columns, floor_columns, write_buildings_parquet, write_floors_parquet,
};
pub use schema::model_schema;
pub use selection::selection_json;
pub use shown::Units;
pub use shown_text::in_shown_units;
pub use source::Place;
pub use study_file::{
    Correlation, Design, DesignKind, Distribution, Factor, FactorValues, FragilityMethod,
    FragilityWanted, IdaWanted, InputTable, Level, Sampling, SelectionScaling, SelectionWanted,
    Shape, StudyFile, TableColumn,
};
pub use tables::{
    Values, capacity_columns, contact_names, encode_values_parquet, history_names, impact_columns,
    member_columns, member_history_columns, write_capacity_parquet, write_columns_parquet,
    write_hinges_parquet, write_history_parquet, write_impacts_parquet, write_members_parquet,
    write_values_parquet,
};
pub use target::{TARGET_CODES, TargetError, TargetWords, read_target_file};
pub use templates::{TEMPLATE_NAMES, template, template_in};
pub use tree::Format;
pub use types_tables::TypesTables;
pub use undamaged::undamaged;
pub use unusual::parse_option;
