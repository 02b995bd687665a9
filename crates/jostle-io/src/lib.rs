//! Doors of jostle: model files, ground motions, result files.
//!
//! Parsers take text or bytes and never panic; only [`read_model_file`], [`read_record`] and the writers touch a
//! path. Everything that leaves this crate is in SI.

mod at2;
mod builtin;
mod fault;
mod json_tree;
mod keys;
mod model_file;
mod motion_spec;
mod output;
mod quantity;
mod reader;
mod record;
mod schema;
mod source;
mod tables;
mod templates;
mod text_record;
mod times;
mod toml_tree;
mod tree;
mod unit;

pub use builtin::{
    BUILTIN_RECORDS, BuiltinRecord, builtin_model, builtin_record, model_names, model_text,
};
pub use fault::{Fault, InputError};
pub use model_file::{Input, OverrideError, Overrides, read_model_file, read_model_text};
pub use motion_spec::{MotionError, MotionSource, MotionSpec, Scaling};
pub use output::{OutputError, summary_json, write_atomically, write_summary_json};
pub use quantity::{Dimension, QuantityError, STANDARD_GRAVITY, parse_quantity};
pub use record::{Record, RecordError, RecordOptions, parse_record, read_record};
pub use schema::model_schema;
pub use source::Place;
pub use tables::{write_history_parquet, write_impacts_parquet};
pub use templates::{TEMPLATE_NAMES, template};
pub use tree::Format;
