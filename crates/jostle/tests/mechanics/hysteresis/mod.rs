//! Hysteresis rules: against published paths and another program, and what every rule must keep.

mod buckling;
mod lowered_strength;
mod oscillator;
mod properties;
mod published_paths;
mod steel;
mod support;
