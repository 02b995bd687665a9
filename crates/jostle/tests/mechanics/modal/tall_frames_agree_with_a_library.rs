//! The count does not tire with height.

use jostle::eigen::modes;

use crate::modal::support::{deviation, disorder, frame, framed, library_modes};

#[test]
fn forty_storeys_all_modes() {
    let building = framed(frame(40, &[6.0, 4.0]));
    let dense = library_modes(&building).expect("the frame stands");
    let found = modes(&building, usize::MAX).expect("the frame stands");
    let expected: Vec<f64> = dense.iter().map(|mode| mode.circular_frequency).collect();
    assert_eq!(found.len(), expected.len());
    // The library is as exact as this in the highest modes, whose 1/ω² are the smallest.
    assert!(
        deviation(&found, &expected) < 1e-9,
        "{:e}",
        deviation(&found, &expected)
    );
    assert!(
        disorder(&building, &found[..100]) < 1e-9,
        "{:e}",
        disorder(&building, &found[..100])
    );
}

#[test]
fn eighty_storeys_lowest_modes() {
    let building = framed(frame(80, &[7.0]));
    let dense = library_modes(&building).expect("the frame stands");
    let found = modes(&building, 60).expect("the frame stands");
    let expected: Vec<f64> = dense.iter().map(|mode| mode.circular_frequency).collect();
    assert!(
        deviation(&found, &expected) < 1e-11,
        "{:e}",
        deviation(&found, &expected)
    );
    let lateral: Vec<f64> = dense
        .iter()
        .filter(|mode| mode.is_lateral())
        .map(|mode| mode.circular_frequency)
        .collect();
    assert_eq!(building.modes.len(), lateral.len());
    assert!(deviation(&building.modes, &lateral) < 1e-11);
}
