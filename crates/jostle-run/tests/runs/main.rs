//! Runs from model files, and what they report.

mod cases;
mod checks;
mod comparison;
mod damage;
mod gap_directions;
mod given;
mod indentation;
mod isolation_bounds;
mod judged_members;
mod kinds_agree;
mod long_histories;
mod loose_tolerance;
mod member_capacity;
mod one_definition;
mod plain_words;
mod registry;
mod shear_failure;
mod space_capacity;
mod space_walls;
mod spectra_of_floors;
mod support;
mod symmetry;
mod tall_frames;
