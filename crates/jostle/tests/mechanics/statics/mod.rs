//! Hinges under gravity and pushed sideways, against closed forms and a second algorithm.

mod closed_forms;
mod gravity;
mod path;
mod second_algorithm;
mod support;
