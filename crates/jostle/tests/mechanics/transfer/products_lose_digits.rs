//! The product of transfer matrices fails at small steps and in tall frames; we know when.

use std::ops::ControlFlow;

use jostle::stepping::ContactSteps;
use jostle::stiffness::DirectStiffness;
use jostle::transfer::{ProductEquations, ProductRefusal, digits_left, measured_loss};
use jostle::{GroundMotion, Plan, RiccatiSweep, RunEnd, Settings, Solver, System, simulate};

use crate::transfer::support::{
    COLUMN, Variant, difference, frame, scattered_load, solution, step_factors, step_load, tower,
};

const UNDAMPED: [f64; 2] = [0.0, 0.0];
const DAMPED: [f64; 2] = [0.35, 0.0025];

/// Rayleigh coefficients, then steps \[s\] and the relative errors of one of them.
type Measured = (f64, [f64; 2], usize, &'static [(f64, f64)]);

/// Relative error of one step of the total transfer equation against direct stiffness, by an independent program:
/// depth of the columns \[m\], damping, storeys, and per step \[s\] the error. Bays of 4 m and 6 m, axially rigid.
/// Of larger errors only the fact counts.
const ERRORS: &[Measured] = &[
    (
        0.5,
        UNDAMPED,
        5,
        &[
            (0.02, 1.1e-13),
            (0.01, 2.1e-12),
            (0.005, 1.7e-10),
            (0.002, 4.8e-07),
            (0.001, 1.5e-02),
            (0.0005, 1.1e+06),
        ],
    ),
    (
        0.5,
        UNDAMPED,
        10,
        &[
            (0.02, 8.2e-11),
            (0.01, 6.3e-09),
            (0.005, 2.2e-05),
            (0.002, 4.2e+02),
        ],
    ),
    (0.5, UNDAMPED, 20, &[(0.02, 1.1e-05), (0.01, 6.3e-01)]),
    (
        0.6,
        UNDAMPED,
        5,
        &[
            (0.02, 7.9e-14),
            (0.01, 4.1e-13),
            (0.005, 1.4e-11),
            (0.002, 5.2e-08),
            (0.001, 2.5e-04),
            (0.0005, 2.1e+03),
        ],
    ),
    (
        0.6,
        UNDAMPED,
        10,
        &[
            (0.02, 2.8e-12),
            (0.01, 1.4e-09),
            (0.005, 8.0e-07),
            (0.002, 1.1e+01),
        ],
    ),
    (
        0.6,
        UNDAMPED,
        20,
        &[(0.02, 2.3e-07), (0.01, 8.2e-03), (0.005, 5.9e+03)],
    ),
    (0.6, UNDAMPED, 40, &[(0.02, 7.1e+03)]),
    (
        0.5,
        DAMPED,
        5,
        &[
            (0.02, 1.8e-13),
            (0.01, 6.8e-13),
            (0.005, 1.4e-11),
            (0.002, 2.5e-09),
            (0.001, 2.1e-07),
            (0.0005, 1.9e-06),
            (0.0001, 1.6e+02),
        ],
    ),
    (
        0.5,
        DAMPED,
        10,
        &[
            (0.02, 5.8e-11),
            (0.01, 9.7e-10),
            (0.005, 2.4e-07),
            (0.002, 7.9e-03),
            (0.001, 5.3e+01),
            (0.0005, 1.9e+03),
        ],
    ),
    (
        0.5,
        DAMPED,
        20,
        &[(0.02, 7.3e-06), (0.01, 5.7e-03), (0.005, 1.0e+02)],
    ),
];

/// Loads whose losses are averaged.
const LOADS: u32 = 9;

#[test]
fn errors_grow_as_an_independent_program_found() {
    let (mut cases, mut same_decade, mut bias) = (0, 0, 0.0);
    for &(depth, damping, storeys, errors) in ERRORS {
        let building = frame(Variant::AxiallyRigid, &[4.0, 6.0], storeys, depth);
        for &(step, error) in errors {
            let (kappa, g) = step_factors([0.25, 0.5], step, damping);
            let matrix = jostle::linear::StepMatrix::new(kappa, g);
            // Rounding is chance: what is usual under many loads says more than one of them.
            let usual = (0..LOADS).map(|index| {
                let load = scattered_load(&building, g, f64::from(index));
                let loss = measured_loss(&building, &matrix, &load).expect("the frame stands");
                loss.log10() / f64::from(LOADS)
            });
            let apart = usual.sum::<f64>() - error.log10();
            assert!(
                apart.abs() <= 2.5,
                "{storeys} storeys, h = {step} s: 10^{apart:.1} times {error:e}"
            );
            cases += 1;
            same_decade += usize::from(apart.abs() <= 1.0);
            bias += apart;
        }
    }
    assert!(cases >= 40, "{cases} cases");
    assert!(
        3 * same_decade >= 2 * cases - 4,
        "{same_decade} of {cases} within a decade"
    );
    assert!(
        (bias / cases as f64).abs() <= 0.6,
        "on the whole {bias:e} decades too many"
    );
}

#[test]
fn the_estimate_foretells_the_error() {
    for &(depth, damping, storeys, errors) in ERRORS {
        let building = frame(Variant::AxiallyRigid, &[4.0, 6.0], storeys, depth);
        for &(step, error) in errors.iter().filter(|(_, error)| *error <= 1e2) {
            let (kappa, g) = step_factors([0.25, 0.5], step, damping);
            let foretold = -digits_left(&building, &jostle::linear::StepMatrix::new(kappa, g));
            assert!(
                (foretold - error.log10()).abs() <= 1.5,
                "{storeys} storeys of {depth} m columns, h = {step} s: 1e{foretold:.1}, not {error:e}"
            );
        }
    }
}

#[test]
fn the_estimate_holds_for_other_frames() {
    // Axially flexible, with other bays, sheared, without hinges, second order.
    for variant in crate::transfer::support::VARIANTS {
        for (spans, storeys) in [(&[6.0][..], 6), (&[6.0, 3.0, 6.0], 8), (&[4.0, 6.0], 14)] {
            let building = frame(variant, spans, storeys, COLUMN);
            for step in [2e-2, 5e-3] {
                let (kappa, g) = step_factors([0.25, 0.5], step, DAMPED);
                let load = step_load(&building, g);
                let loss =
                    measured_loss(&building, &jostle::linear::StepMatrix::new(kappa, g), &load)
                        .expect("the frame stands");
                let foretold = -digits_left(&building, &jostle::linear::StepMatrix::new(kappa, g));
                // Too few digits foretold cost a refusal, too many a wrong answer.
                let pessimism = foretold - loss.log10();
                assert!(
                    (-1.5..=3.5).contains(&pessimism),
                    "{variant:?}, {storeys} storeys, h = {step} s: {loss:e}, not 1e{foretold:.1}"
                );
            }
        }
    }
}

#[test]
fn the_estimate_holds_for_shear_buildings() {
    for storeys in [2, 4, 6, 9, 12, 16, 20] {
        let building = tower(storeys);
        let (kappa, g) = step_factors([0.25, 0.5], 2e-2, DAMPED);
        let loss = measured_loss(
            &building,
            &jostle::linear::StepMatrix::new(kappa, g),
            &step_load(&building, g),
        )
        .expect("it stands");
        let pessimism =
            -digits_left(&building, &jostle::linear::StepMatrix::new(kappa, g)) - loss.log10();
        assert!(
            (-1.5..=3.5).contains(&pessimism),
            "{storeys} storeys: {loss:e}, {pessimism:.1}"
        );
    }
}

#[test]
fn eighty_storeys_at_ten_microseconds_are_for_riccati_alone() {
    let building = frame(Variant::AxiallyRigid, &[4.0, 6.0], 80, COLUMN);
    let (kappa, g) = step_factors([0.25, 0.5], 1e-5, UNDAMPED);
    let load = step_load(&building, g);
    let apart = difference(
        &solution::<RiccatiSweep>(&building, (kappa, g), &load),
        &solution::<DirectStiffness>(&building, (kappa, g), &load),
    );
    assert!(apart <= 1e-8, "{apart:e}");
    match ProductEquations::check(&building, &jostle::linear::StepMatrix::new(kappa, g)) {
        Err(ProductRefusal::DigitsLost {
            digits_left,
            wanted,
            ..
        }) => {
            assert!(
                digits_left < -100.0 && wanted > 0.0,
                "{digits_left} of {wanted}"
            );
        }
        other => panic!("{other:?} instead of a refusal"),
    }
}

#[test]
fn a_refusal_names_the_building_the_digits_and_the_way_out() {
    let building = frame(Variant::AxiallyRigid, &[4.0, 6.0], 10, COLUMN);
    let (kappa, g) = step_factors([0.25, 0.5], 1e-3, UNDAMPED);
    let refusal = ProductEquations::check(&building, &jostle::linear::StepMatrix::new(kappa, g))
        .expect_err("too small a step");
    let text = refusal.to_string();
    for part in [
        "\"AxiallyRigid\"",
        "about -",
        "6 are needed",
        "solver = \"riccati\"",
    ] {
        assert!(text.contains(part), "{part} in: {text}");
    }
    let (kappa, g) = step_factors([0.25, 0.5], 2e-2, UNDAMPED);
    assert_eq!(
        ProductEquations::check(&building, &jostle::linear::StepMatrix::new(kappa, g)),
        Ok(())
    );
}

#[test]
fn a_run_by_products_repeats_a_run_by_riccati_where_it_may() {
    let building = frame(Variant::AxiallyRigid, &[4.0, 6.0], 3, COLUMN);
    let motion = GroundMotion::sampled("push", 0.02, vec![0.0, 3.0, -2.0, 1.0, 0.0, 0.0]);
    let run = |solver: Solver, step: f64| {
        let system = System::of_buildings(vec![building.clone()]);
        let plan = Plan {
            step,
            contact_steps: ContactSteps::Fixed(1),
            integrator: jostle::Integrator::default(),
            solver,
            vertical: false,
            is_given: true,
            collapse_drift: jostle::model::COLLAPSE_DRIFT,
        };
        let outcome = simulate(&system, &motion, &plan, Settings::default(), |_| {
            ControlFlow::Continue(())
        });
        assert_eq!(outcome.end, RunEnd::Completed, "{solver:?}");
        outcome.state.displacement
    };
    let by_steps = |step| difference(&run(Solver::Product, step), &run(Solver::Riccati, step));
    for step in [0.02, 0.005] {
        assert_eq!(
            ProductEquations::check_step(&building, jostle::Integrator::default(), step),
            Ok(())
        );
        let apart = by_steps(step);
        assert!(apart > 0.0 && apart < 1e-7, "h = {step} s: {apart:e}");
    }
    let refused = ProductEquations::check_step(&building, jostle::Integrator::default(), 2e-4);
    assert!(refused.is_err(), "0.2 ms leave nothing");
}
