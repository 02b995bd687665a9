//! Sections against published formulas, closed forms and another program.

mod closed_forms;
mod curves;
mod published_values;
mod support;
