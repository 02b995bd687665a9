//! Transfer matrices against closed forms, against the other solvers, and where their product fails.

mod closed_forms;
mod four_ways_one_answer;
mod misfits_are_refused;
mod products_lose_digits;
mod support;
