//! Comparisons with references, in their reduced form.

mod certify;
mod numbers;
