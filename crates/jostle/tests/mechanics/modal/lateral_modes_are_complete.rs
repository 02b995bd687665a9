//! What assembly keeps are all modes with at least 1 % of the mass, and no others.

use jostle::eigen::{Mode, modes};
use jostle::system::BuildingSystem;

use crate::modal::support::{frame, framed, stacks, stored_frame, stored_frames, tower};

fn assert_complete(building: &BuildingSystem, what: &str) {
    let all = modes(building, usize::MAX).expect("the building stands");
    let lateral: Vec<&Mode> = all.iter().filter(|mode| mode.is_lateral()).collect();
    assert_eq!(
        building.modes.len(),
        lateral.len(),
        "{what}: number of lateral modes"
    );
    for (k, (got, expected)) in building.modes.iter().zip(lateral).enumerate() {
        let error = (got.circular_frequency / expected.circular_frequency - 1.0).abs();
        assert!(
            error < 1e-10,
            "{what}, lateral mode {}: ω off by {error:e}",
            k + 1
        );
        let error = (got.effective_mass_ratio_x - expected.effective_mass_ratio_x).abs();
        assert!(
            error < 1e-9,
            "{what}, lateral mode {}: mass off by {error:e}",
            k + 1
        );
        let scale = expected
            .shape
            .iter()
            .fold(0.0_f64, |most, value| most.max(value.abs()));
        for (a, b) in got.shape.iter().zip(&expected.shape) {
            assert!(
                (a - b).abs() < 1e-8 * scale,
                "{what}, lateral mode {}: {a} for {b}",
                k + 1
            );
        }
    }
}

#[test]
fn in_towers() {
    for storeys in [1, 2, 3, 5, 8, 13, 30, 80] {
        assert_complete(&tower(storeys, 1e5, 2e8), &format!("{storeys} storeys"));
    }
}

#[test]
fn in_frames() {
    for (name, stored) in stored_frames().as_object().expect("named frames") {
        assert_complete(&stored_frame(stored, 1.0), name);
    }
    assert_complete(&framed(frame(12, &[3.0, 6.0, 3.0])), "12 storeys");
    // Soft beams resonate among the sways and share their mass with them.
    let mut soft = frame(5, &[6.0, 7.0]);
    for beam in &mut soft.beams {
        beam.flexural_rigidity *= 0.03;
    }
    assert_complete(&framed(soft), "soft beams");
}

/// Forty stacks of their own frequencies carry one fortieth each: all are lateral, none dominates.
#[test]
fn when_the_mass_is_spread_over_many() {
    let stack = |index: usize| vec![(1e4, 1e6 * (1.0 + 0.4 * index as f64))];
    let many: Vec<Vec<(f64, f64)>> = (0..40).map(stack).collect();
    let lists: Vec<&[(f64, f64)]> = many.iter().map(Vec::as_slice).collect();
    let building = stacks(&lists);
    assert_eq!(building.modes.len(), 40);
    assert_complete(&building, "forty stacks");
}

/// Nearly all in one mode, then parts just above and just below 1 %, far away and near to each other.
#[test]
fn when_a_mode_hides_near_the_limit() {
    let (big, above, below) = (9.55e5, 1.01e4, 0.99e4);
    for apart in [1e-1, 1e-3, 1e-5] {
        let stiffness = |mass: f64, squared: f64| (mass, mass * squared);
        let lists = [
            vec![stiffness(big, 50.0)],
            vec![stiffness(above, 1e4)],
            vec![stiffness(below, 1e4 * (1.0 + apart))],
            vec![stiffness(above, 1e4 * (1.0 + 3.0 * apart))],
            vec![stiffness(below, 1e6)],
            vec![stiffness(1e6 - big - 2.0 * above - 2.0 * below, 3e6)],
        ];
        let lists: Vec<&[(f64, f64)]> = lists.iter().map(Vec::as_slice).collect();
        let building = stacks(&lists);
        assert_eq!(building.modes.len(), 3, "{apart:e} apart");
        assert_complete(&building, "near the limit");
    }
}
