use jostle::stiffness::DirectStiffness;
use jostle::structure::Discretization;
use jostle::structure::StepEquations;
use jostle::system::BuildingSystem;
use jostle::{Frame, LawKind, Plan, RiccatiSweep, Solver};

use crate::verification::support::{
    Random, assembled, difference, framed, law, random_damping, random_frame, row, run, shaking,
    steps,
};

/// Displacements under a load, by one of the two solvers.
fn solution<E: StepEquations>(building: &BuildingSystem, step: f64, load: &[f64]) -> Vec<f64> {
    let (alpha, beta) = (building.equations.alpha, building.equations.beta);
    // Newmark (1/4, 1/2): velocity 2/h and acceleration 4/h² per displacement.
    let (a, c) = (4.0 / (step * step), 2.0 / step);
    let solver = E::new(building);
    let mut factor = E::Factor::default();
    solver
        .factorize(
            &jostle::linear::StepMatrix::new(1.0 + beta * c, a + alpha * c),
            &[],
            &mut factor,
        )
        .expect("the frame stands");
    let mut answer = load.to_vec();
    solver.solve(&factor, &mut answer, &mut E::Scratch::default());
    answer
}

#[test]
fn riccati_equals_direct_stiffness_for_one_step_of_any_frame() {
    let mut random = Random(1);
    let mut worst = 0.0_f64;
    for number in 0..80 {
        let mut model = framed("frame", random_frame(&mut random));
        model.damping = random_damping(&mut random);
        let mut building = BuildingSystem::new("frame", Discretization::new(&model));
        building
            .damp(&model.damping)
            .expect("coefficients need no modes");
        let equations = &building.equations;
        // Loads of every kind; then of the masses alone, as in a step.
        let any: Vec<f64> = (0..equations.len())
            .map(|_| random.between(-1e5, 1e5))
            .collect();
        let of_masses: Vec<f64> = any
            .iter()
            .zip(&equations.mass)
            .map(|(p, m)| p * m)
            .collect();
        for step in [2e-2, 1e-2, 1e-3, 1e-4, 1e-5] {
            for load in [&any, &of_masses] {
                let riccati = solution::<RiccatiSweep>(&building, step, load);
                let direct = solution::<DirectStiffness>(&building, step, load);
                let apart = difference(&riccati, &direct);
                worst = worst.max(apart);
                assert!(
                    apart <= 1e-10,
                    "frame {number} at h = {step} s: {apart:e}\n{model:?}"
                );
            }
        }
    }
    assert!(
        worst > 0.0,
        "two different eliminations cannot agree to the last bit"
    );
}

#[test]
fn riccati_equals_direct_stiffness_through_a_run_with_impacts() {
    let mut random = Random(7);
    let mut impacts = 0;
    for kind in [LawKind::HertzDamp, LawKind::Kelvin, LawKind::HertzDamp] {
        let left = random_frame(&mut random);
        let mut right = random_frame(&mut random);
        // Floors at equal heights.
        let storeys = left.storey_heights.len().min(right.storey_heights.len());
        right.storey_heights[..storeys].copy_from_slice(&left.storey_heights[..storeys]);
        let floors_at_random: [Frame; 2] = [left, right];
        let [left, right] = floors_at_random.map(|frame| framed("", frame));
        let buildings = vec![
            jostle::Building {
                name: "left".into(),
                ..left
            },
            jostle::Building {
                name: "right".into(),
                ..right
            },
        ];
        let mut model = row(buildings, 2e-4, law(kind, 0.65));
        for building in &mut model.buildings {
            building.damping = random_damping(&mut random);
        }
        let system = assembled(&model);
        let motion = shaking(1.2);
        let plan = steps(1e-3, 4);
        let riccati = run(&system, &motion, &plan);
        let direct = run(
            &system,
            &motion,
            &Plan {
                solver: Solver::Stiffness,
                ..plan
            },
        );
        impacts += riccati.impacts.len();
        assert_eq!(
            riccati.impacts.len(),
            direct.impacts.len(),
            "{kind:?}: as many impacts"
        );
        let apart = difference(&riccati.state.displacement, &direct.state.displacement);
        assert!(
            apart <= 1e-8,
            "{kind:?}: displacements at the end are {apart:e} apart"
        );
        for (a, b) in riccati.impacts.iter().zip(&direct.impacts) {
            assert!(
                (a.peak_force / b.peak_force - 1.0).abs() <= 1e-7,
                "{kind:?}: {a:?} against {b:?}"
            );
        }
    }
    assert!(impacts >= 10, "the runs must have impacts, found {impacts}");
}
