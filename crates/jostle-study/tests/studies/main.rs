//! Studies, suites and searches.

mod angles;
mod capacity_columns;
mod damaged_parts;
mod inputs;
mod isolation_columns;
mod large;
mod pages_in_another_language;
mod ready_made;
mod required_gap;
mod scan;
mod size;
mod studies;
mod suites_in_plan;
mod trends;
