//! Demands over capacities of columns and beams: against the forces of the same run, by two ways of stepping, and where, when
//! and in which impact they were greatest.

mod against_histories;
mod ductility;
mod envelopes;
mod places;
mod support;
