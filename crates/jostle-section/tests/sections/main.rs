//! Sections against published formulas, closed forms and another program.

mod capacity_by_hand;
mod closed_forms;
mod curves;
mod oblique_moments;
mod places_of_bars;
mod published_values;
mod support;
