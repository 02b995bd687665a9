//! Ground motions held against closed forms, other algorithms and published values.

mod artificial_waves;
mod design_spectra_are_those_of_the_codes;
mod el_centro_is_known;
mod processing_is_faithful;
mod spectra_are_exact;
mod support;
