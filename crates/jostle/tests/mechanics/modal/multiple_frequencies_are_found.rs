//! Symmetric structures have frequencies that occur twice or more often.

use jostle::eigen::{Spectrum, modes};
use jostle::system::BuildingSystem;

use crate::modal::support::{deviation, disorder, frame, framed, joined, library_modes, stacks};

const STACK: [(f64, f64); 3] = [(3e4, 5e7), (2e4, 4e7), (1e4, 3e7)];

fn frequencies(building: &BuildingSystem) -> Vec<f64> {
    let modes = modes(building, usize::MAX).expect("the building stands");
    modes.iter().map(|mode| mode.circular_frequency).collect()
}

#[test]
fn twins_vibrate_at_every_frequency_of_one_twice() {
    let one = frequencies(&stacks(&[&STACK]));
    for copies in 2..=4 {
        let many = stacks(&vec![&STACK[..]; copies]);
        let found = modes(&many, usize::MAX).expect("the stacks stand");
        let expected: Vec<f64> = one.iter().flat_map(|f| vec![*f; copies]).collect();
        assert_eq!(found.len(), expected.len());
        assert!(deviation(&found, &expected) < 1e-13, "{copies} copies");
        assert!(
            disorder(&many, &found) < 1e-12,
            "{copies} copies, orthonormal"
        );
        // The first of each group carries what can be carried, the others nothing.
        for group in found.chunks(copies) {
            assert!(
                group[0].effective_mass_ratio_x > 1e-3,
                "{}",
                group[0].participation
            );
            for other in &group[1..] {
                assert!(
                    other.effective_mass_ratio_x < 1e-20,
                    "{}",
                    other.participation
                );
            }
        }
        let mut spectrum = Spectrum::new(&many).expect("the stacks stand");
        for (j, frequency) in one.iter().enumerate() {
            assert_eq!(spectrum.below(frequency * (1.0 - 1e-12)), copies * j);
            assert_eq!(spectrum.below(frequency * (1.0 + 1e-12)), copies * (j + 1));
        }
    }
}

/// Masses m on springs k₀, every two joined by a spring k: ω² = k₀/m once, (k₀ + nk)/m all other times.
#[test]
fn equal_masses_joined_alike_have_all_but_one_frequency_in_common() {
    for n in 2..=6 {
        let (m, grounded, joining) = (1000.0, 7e5, 3e5);
        let building = joined(n, m, grounded, joining);
        let mut expected = vec![f64::sqrt((grounded + n as f64 * joining) / m); n];
        expected[0] = f64::sqrt(grounded / m);
        let found = modes(&building, n).expect("the masses are held");
        assert!(
            deviation(&found, &expected) < 1e-14,
            "{n} masses: {found:?}"
        );
        assert!(
            disorder(&building, &found) < 1e-13,
            "{n} masses, orthonormal"
        );
        assert!((found[0].effective_mass_ratio_x - 1.0).abs() < 1e-14);
    }
}

/// Nearly equal frequencies: the slices must come apart, or the cluster be solved as one.
#[test]
fn frequencies_close_to_each_other_are_told_apart() {
    for exponent in 2..=13 {
        let part = 10_f64.powi(-exponent);
        let heavier: Vec<(f64, f64)> = STACK.iter().map(|(m, k)| (m * (1.0 + part), *k)).collect();
        let pair = stacks(&[&STACK, &heavier]);
        let one = frequencies(&stacks(&[&STACK]));
        let expected: Vec<f64> = one
            .iter()
            .flat_map(|f| [f / (1.0 + part).sqrt(), *f])
            .collect();
        let found = modes(&pair, usize::MAX).expect("the stacks stand");
        assert!(
            deviation(&found, &expected) < 1e-13,
            "masses {part:e} apart: {:e}",
            deviation(&found, &expected)
        );
        assert!(
            disorder(&pair, &found) < 2e-10,
            "masses {part:e} apart, orthonormal"
        );
    }
}

/// A part of the path that resonates by itself makes a pivot vanish; the frequencies are exact in binary.
#[test]
fn vanishing_pivots_do_not_spoil_the_count() {
    let two = stacks(&[&[(1.0, 1.0), (1.0, 1.0)]]);
    let mut spectrum = Spectrum::new(&two).expect("the stack stands");
    assert_eq!(spectrum.below(2_f64.sqrt()), 1, "first floor alone: ω² = 2");
    // Four storeys, where the part and the whole resonate at once: ω₂² = k/m.
    let four = stacks(&[&[(1.0, 1.0); 4]]);
    let mut spectrum = Spectrum::new(&four).expect("the stack stands");
    assert_eq!(spectrum.below(1.0 - 1e-9), 1);
    assert_eq!(spectrum.below(1.0 + 1e-9), 2);
    assert!((frequencies(&four)[1] - 1.0).abs() < 1e-15);
    // Every single mass resonates at ω² = k₀ + (n − 1)k = 4, below the multiple frequency.
    for n in [3, 5] {
        let building = joined(n, 1.0, 1.0, 3.0 / (n - 1) as f64);
        let mut spectrum = Spectrum::new(&building).expect("the masses are held");
        assert_eq!(spectrum.below(2.0), 1, "{n} masses");
    }
}

/// Soft beams between stiff columns: many beams, each vibrating nearly by itself, and the sways among them.
#[test]
fn symmetric_frames_keep_all_their_modes() {
    for softness in [1e-3, 1e-4, 1e-5, 1e-6] {
        let mut regular = frame(4, &[5.0, 5.0, 5.0, 5.0]);
        regular.joint.rotational_stiffness = None;
        for beam in &mut regular.beams {
            beam.flexural_rigidity *= softness;
        }
        let building = framed(regular);
        let found = modes(&building, usize::MAX).expect("the frame stands");
        let dense = library_modes(&building).expect("the frame stands");
        let expected: Vec<f64> = dense.iter().map(|mode| mode.circular_frequency).collect();
        assert_eq!(found.len(), expected.len());
        let (apart, mixed) = (deviation(&found, &expected), disorder(&building, &found));
        // The library takes both kinds from one matrix, whose rounding is that of the greatest flexibility.
        assert!(
            apart < 3e-14 / softness,
            "beams {softness:e} as stiff: off by {apart:e}"
        );
        assert!(mixed < 1.5e-10, "beams {softness:e} as stiff: {mixed:e}");
    }
}

/// Unequal masses joined to each other, counted where the first of them resonates with the others held.
#[test]
fn vanishing_pivots_do_not_swamp_what_follows() {
    for first in 1..=4 {
        let mut building = joined(6, 1000.0, 7e5, 3e5);
        for dof in 0..6 {
            building.structure.equations.mass[dof] *= 1.0 + 0.37 * dof as f64;
            building.structure.equations.driven_mass[dof] = building.equations.mass[dof];
        }
        building.structure.equations.mass[0] = 1000.0 * f64::from(first) / 3.0;
        let held = f64::sqrt((7e5 + 5.0 * 3e5) / building.equations.mass[0]);
        let dense = library_modes(&building).expect("the masses are held");
        let expected = dense
            .iter()
            .filter(|mode| mode.circular_frequency < held)
            .count();
        let mut spectrum = Spectrum::new(&building).expect("the masses are held");
        assert_eq!(spectrum.below(held), expected, "first mass {first}/3");
    }
}
