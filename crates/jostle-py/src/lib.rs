//! The compiled part of the Python package `jostle`: models, motions and runs, with numbers in SI.
//!
//! The user-facing part (units, keywords, drawings, tables) is written in Python, in `python/jostle`.

mod base;
mod city;
mod collide;
mod compare;
mod describe;
mod error;
mod gradients;
mod histories;
mod live;
mod matrices;
mod model;
mod motion;
mod quantity;
mod run;
mod study;
mod suite;
mod table;
mod tools;
mod watch;

#[global_allocator]
static MEMORY: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// The compiled part of the package. It is internal and may change at any time.
#[pyo3::pymodule]
mod _jostle {
    #[pymodule_export]
    use super::base::{as_toml, named_files, rewritten};
    #[pymodule_export]
    use super::city::{City, city_types, classes, example_city, footprints};
    #[pymodule_export]
    use super::collide::{collide, contact_advice, contact_laws};
    #[pymodule_export]
    use super::command_line;
    #[pymodule_export]
    use super::compare::{Comparison, compare};
    #[pymodule_export]
    use super::gradients::gradients;
    #[pymodule_export]
    use super::live::{Live, live_page};
    #[pymodule_export]
    use super::model::Model;
    #[pymodule_export]
    use super::motion::Motion;
    #[pymodule_export]
    use super::quantity::quantity;
    #[pymodule_export]
    use super::run::{Run, run};
    #[pymodule_export]
    use super::study::{Study, critical_gaps, incidence, ready_made, ready_made_names};
    #[pymodule_export]
    use super::suite::{Suite, run_suite};
    #[pymodule_export]
    use super::table::Table;
    #[pymodule_export]
    use super::tools::{
        Sized, command_list, import_tables, match_spectrum, motion_list, noise, processed, pulse,
        recipe, schema, section, select, size, target, template, template_names, write_text,
    };

    #[pymodule_export]
    #[allow(non_upper_case_globals, reason = "the name that Python expects")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}

/// Runs the command line with the given arguments, the name of the program first, and returns its exit code.
#[pyo3::pyfunction]
fn command_line(py: pyo3::Python<'_>, arguments: Vec<std::ffi::OsString>) -> u8 {
    py.detach(|| jostle_cli::run(arguments))
}
