//! Every number agrees.

use jostle_validation::{Extent, document, families, misses};

#[test]
fn every_number_agrees() {
    let families = families(Extent::Reduced);
    let missed: Vec<String> = misses(&families)
        .map(|(family, row)| document::missed_line(family, row))
        .collect();
    assert!(
        missed.is_empty(),
        "{} numbers miss:\n{}",
        missed.len(),
        missed.join("\n")
    );
    let count: usize = families.iter().map(|family| family.rows.len()).sum();
    assert!(count > 400, "only {count} numbers were compared");
}
