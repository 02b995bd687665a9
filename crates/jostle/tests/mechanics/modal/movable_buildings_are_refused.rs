//! What moves without deforming has no modes, and says so.

use jostle::eigen::{Spectrum, lateral_modes, log_determinant, modes};
use jostle::structure::StickModel;
use jostle::system::BuildingSystem;

use crate::modal::support::{assembled, library_modes, stacks, stored_frame, stored_frames};

fn assert_refused(building: &BuildingSystem, why: &str) {
    assert!(modes(building, 3).is_err(), "{why}: slicing");
    assert!(library_modes(building).is_err(), "{why}: library");
    assert!(lateral_modes(building).is_err(), "{why}: Lanczos");
    assert!(Spectrum::new(building).is_err(), "{why}: count");
    assert!(
        log_determinant(building, 1.0).is_err(),
        "{why}: determinant"
    );
    assert!(building.modes.is_empty(), "{why}: nothing is kept");
}

#[test]
fn free_masses_and_loose_floors() {
    assert_refused(&stacks(&[&[(1e4, 0.0)]]), "a free mass");
    assert_refused(
        &stacks(&[&[(1e4, 1e6), (1e4, 0.0), (1e4, 1e6)]]),
        "a loose floor",
    );
    assert_refused(
        &stacks(&[&[(1e4, 1e6)], &[(1e4, 0.0)]]),
        "one of two stacks",
    );
}

#[test]
fn frames_without_supports_and_frames_that_buckle() {
    let mut frame = stored_frames()["F_2bay5_PDelta"].clone();
    assert!(
        modes(&stored_frame(&frame, 1.0), 1).is_ok(),
        "it stands as it is"
    );
    assert_refused(&stored_frame(&frame, 100.0), "a hundred times its weight");
    frame["fixed_nodes"] = serde_json::json!([]);
    assert_refused(&stored_frame(&frame, 0.0), "no support");
}

#[test]
fn nothing_has_no_modes() {
    let nothing = assembled(StickModel::default(), Vec::new());
    assert_eq!(modes(&nothing, 3), Ok(Vec::new()));
    assert_eq!(library_modes(&nothing), Ok(Vec::new()));
    assert_eq!(lateral_modes(&nothing), Ok(Vec::new()));
}
