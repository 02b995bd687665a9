//! Natural modes: are they all found, and right? Each file is named after what it claims.

mod determinant_misses_what_the_count_finds;
mod frequencies_are_known;
mod lateral_modes_are_complete;
mod movable_buildings_are_refused;
mod multiple_frequencies_are_found;
mod random_frames_agree_with_a_library;
mod shapes_are_orthonormal;
mod support;
mod tall_frames_agree_with_a_library;
mod yielding_springs_count_as_elastic;
