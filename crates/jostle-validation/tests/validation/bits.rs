//! Results of many models, number by number.

use std::path::Path;

use jostle_validation::bits::{Comparison, compare};

#[test]
fn every_bit_is_as_recorded() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/pins");
    let found = compare(&folder, &[]).expect("the files are part of the repository");
    let Comparison {
        results,
        values,
        moved,
    } = found;
    assert!(
        results > 300 && values > 50_000,
        "only {values} values of {results} results"
    );
    let moved: Vec<String> = moved.iter().map(ToString::to_string).collect();
    assert!(
        moved.is_empty(),
        "{} of {results} results moved; if that is meant, run jostle-validation --bits --write:\n{}",
        moved.len(),
        moved.join("\n")
    );
}
