//! The program as a user meets it, and what holds for the whole workspace. One binary: two dozen would take longer to link.

mod codes;
mod collide;
mod commands;
mod common;
mod compare;
mod contact_sensitivity;
mod export;
mod floor_spectra;
mod gap_curve;
mod live_command;
mod mistakes;
mod module_cycles;
mod motion;
mod one_opener;
mod overdamped;
mod pages;
mod promise;
mod replacing;
mod sections;
mod several_records;
mod short_openings;
mod space;
mod study;
mod suite;
mod unusual_models;
mod work_counts;
