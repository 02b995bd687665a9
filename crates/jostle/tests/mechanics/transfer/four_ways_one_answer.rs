//! Four eliminations that share nothing but the elements.

use jostle::RiccatiSweep;
use jostle::linear::StepMatrix;
use jostle::stiffness::DirectStiffness;
use jostle::structure::StepEquations;
use jostle::system::BuildingSystem;
use jostle::transfer::{ElementwiseRiccati, ProductEquations, digits_left};

use crate::transfer::support::{
    COLUMN, VARIANTS, Variant, difference, frame, solution, step_factors, step_load, tower,
};

#[test]
fn four_solvers_agree_on_sixty_three_frames() {
    let mut cases = 0;
    let mut worst = [0.0_f64; 3];
    for variant in VARIANTS {
        for spans in [&[4.0, 6.0][..], &[6.0], &[6.0, 3.0, 6.0]] {
            for newmark in [[0.25, 0.5], [1.0 / 6.0, 0.5], [0.3025, 0.6]] {
                let building = frame(variant, spans, 5, COLUMN);
                let factors = step_factors(newmark, 0.02, [0.35, 0.0025]);
                let load = step_load(&building, factors.1);
                let direct = solution::<DirectStiffness>(&building, factors, &load);
                let others = [
                    solution::<RiccatiSweep>(&building, factors, &load),
                    solution::<ElementwiseRiccati>(&building, factors, &load),
                    solution::<ProductEquations>(&building, factors, &load),
                ];
                for (index, other) in others.iter().enumerate() {
                    let apart = difference(other, &direct);
                    worst[index] = worst[index].max(apart);
                    assert!(
                        apart <= 1e-10,
                        "{variant:?}, bays {spans:?}, {newmark:?}, solver {index}: {apart:e}"
                    );
                }
                cases += 1;
            }
        }
    }
    assert_eq!(
        cases, 63,
        "seven variants, three sets of bays, three integrators"
    );
    // Different eliminations do not round alike.
    assert!(worst.iter().all(|worst| *worst > 0.0), "{worst:?}");
}

#[test]
fn a_factor_serves_many_loads_and_steps() {
    let building = frame(Variant::FlexibleMembers, &[6.0, 3.0, 6.0], 4, COLUMN);
    let solver = ProductEquations::new(&building);
    assert_eq!(
        solver.unknowns(),
        3 * (6 * 4 + 3),
        "(n − 1)(6m + 3) unknowns"
    );
    let mut factor = <ProductEquations as StepEquations>::Factor::default();
    for step in [0.02, 0.01, 0.02] {
        let factors = step_factors([0.25, 0.5], step, [0.35, 0.0025]);
        solver
            .factorize(&StepMatrix::new(factors.0, factors.1), &[], &mut factor)
            .expect("the frame stands");
        for dof in [0, 7, building.equations.len() - 1] {
            let mut load = vec![0.0; building.equations.len()];
            load[dof] = 1e5;
            let expected = solution::<DirectStiffness>(&building, factors, &load);
            solver.solve(&factor, &mut load, &mut Default::default());
            let apart = difference(&load, &expected);
            assert!(apart < 1e-9, "load on {dof} at h = {step}: {apart:e}");
        }
    }
}

#[test]
fn four_solvers_agree_on_irregular_frames() {
    // Unequal storeys, bays and segments; single segments; rotary inertia; hinges that give way sideways.
    for variant in VARIANTS {
        for spans in [&[4.0, 6.0][..], &[6.0], &[5.0, 3.0, 4.0, 6.0]] {
            let plain = frame(variant, spans, 3, COLUMN);
            let mut discretization = plain.discretization.clone();
            let stick_model = &mut discretization.stick_model;
            for (index, node) in stick_model.nodes.iter_mut().enumerate() {
                node.y *= 1.0 + 0.07 * node.y / 3.2;
                let more = node.mass() * 0.2 * (index % 3) as f64;
                let turning = 10.0 * (index % 5) as f64;
                *node = node.with_mass(more).with_rotary_inertia(turning);
            }
            for (index, hinge) in stick_model.hinges.iter_mut().enumerate() {
                hinge.translational_stiffness = match index % 4 {
                    0 => [Some(3e8), None],
                    1 => [None, Some(2e8)],
                    2 => [Some(5e8), Some(7e8)],
                    _ => [None, None],
                };
            }
            let building = BuildingSystem::new("irregular", discretization);
            let factors = step_factors([0.25, 0.5], 0.02, [0.35, 0.0025]);
            let load = step_load(&building, factors.1);
            let direct = solution::<DirectStiffness>(&building, factors, &load);
            for other in [
                solution::<RiccatiSweep>(&building, factors, &load),
                solution::<ElementwiseRiccati>(&building, factors, &load),
                solution::<ProductEquations>(&building, factors, &load),
            ] {
                let apart = difference(&other, &direct);
                assert!(apart <= 1e-10, "{variant:?}, bays {spans:?}: {apart:e}");
            }
        }
    }
}

#[test]
fn four_solvers_agree_on_shear_buildings() {
    for storeys in [1, 2, 4, 12] {
        let building = tower(storeys);
        let factors = step_factors([0.25, 0.5], 0.02, [0.35, 0.0025]);
        let load = step_load(&building, factors.1);
        let direct = solution::<DirectStiffness>(&building, factors, &load);
        // Storeys carry so much mass that the product keeps four digits over twelve of them, as it foretells; in each
        // case one rounding of the base forces decides how much of that is lost.
        let foretold = digits_left(&building, &StepMatrix::new(factors.0, factors.1));
        let kept = 10_f64.powf(-foretold).max(1e-13);
        for (other, tolerance) in [
            (solution::<RiccatiSweep>(&building, factors, &load), 1e-13),
            (
                solution::<ElementwiseRiccati>(&building, factors, &load),
                1e-13,
            ),
            (
                solution::<ProductEquations>(&building, factors, &load),
                kept,
            ),
        ] {
            let apart = difference(&other, &direct);
            assert!(apart <= tolerance, "{storeys} storeys: {apart:e}");
        }
        assert_eq!(
            ProductEquations::new(&building).unknowns(),
            3,
            "forces at the one base"
        );
    }
}

#[test]
fn elementwise_riccati_keeps_its_digits_at_small_steps() {
    for variant in VARIANTS {
        for step in [1e-3, 1e-4, 1e-5] {
            let building = frame(variant, &[4.0, 6.0], 20, COLUMN);
            let factors = step_factors([0.25, 0.5], step, [0.0, 0.0]);
            let load = step_load(&building, factors.1);
            let direct = solution::<DirectStiffness>(&building, factors, &load);
            let apart = difference(
                &solution::<ElementwiseRiccati>(&building, factors, &load),
                &direct,
            );
            assert!(apart <= 1e-8, "{variant:?} at h = {step} s: {apart:e}");
        }
    }
}
