//! φᵀMφ = 1, φᵀKφ = Λ, and the effective masses of all modes are the mass of the building.

use jostle::eigen::modes;

use crate::modal::support::{
    disorder, frame, framed, imbalance, library_modes, stored_frame, stored_frames, tower,
};

#[test]
fn in_the_mass_and_in_the_stiffness() {
    let frames = stored_frames();
    let stored = frames.as_object().expect("named frames");
    for (name, frame) in stored {
        let building = stored_frame(frame, 1.0);
        for (way, modes) in [
            ("sliced", modes(&building, usize::MAX)),
            ("library", library_modes(&building)),
        ] {
            let modes = modes.expect("the frame stands");
            assert!(
                disorder(&building, &modes) < 1e-9,
                "{name}, {way}: {:e}",
                disorder(&building, &modes)
            );
        }
        // Massless degrees of freedom included, K φ = ω² M φ.
        let lowest = modes(&building, 6).expect("the frame stands");
        for mode in lowest.iter().chain(&building.modes) {
            assert!(
                imbalance(&building, mode) < 1e-9,
                "{name}, ω = {}: {:e}",
                mode.circular_frequency,
                imbalance(&building, mode)
            );
        }
    }
}

#[test]
fn their_masses_are_the_mass_of_the_building() {
    let mut buildings = vec![tower(7, 1e5, 2e8), framed(frame(6, &[4.0, 7.0]))];
    // Columns that change length let the masses rise as well.
    let mut flexible = frame(6, &[4.0, 7.0]);
    flexible.axial.columns_flexible = true;
    flexible.axial.beams_flexible = true;
    buildings.push(framed(flexible));
    for building in &buildings {
        let modes = modes(building, usize::MAX).expect("the building stands");
        let x: f64 = modes.iter().map(|mode| mode.effective_mass_ratio_x).sum();
        let y: f64 = modes.iter().map(|mode| mode.effective_mass_ratio_y).sum();
        let rising: f64 = building.equations.vertical_mass.iter().sum();
        let total = building.equations.total_mass();
        assert!((x - 1.0).abs() < 1e-11, "horizontal: {x}");
        assert!((y - rising / total).abs() < 1e-11, "vertical: {y}");
        for mode in &modes {
            let mass = mode.participation.powi(2) / total;
            assert!(mode.participation >= 0.0, "sways to the right");
            assert!((mass - mode.effective_mass_ratio_x).abs() < 1e-14);
        }
    }
}
