//! Comparisons with references, in their reduced form.

mod bits;
mod certify;
mod numbers;
