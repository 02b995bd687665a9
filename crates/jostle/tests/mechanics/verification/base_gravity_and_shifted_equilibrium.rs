//! What is not damped with the stiffness, what has dashpots of its own, and integrators that shift equilibrium:
//! against a dense step-by-step solution whose unknowns are accelerations, and against formulae.

use std::f64::consts::PI;

use jostle::linear::SparseSymmetric;
use jostle::linear::StepMatrix;
use jostle::statics::STANDARD_GRAVITY;
use jostle::stiffness::DirectStiffness;
use jostle::structure::Discretization;
use jostle::structure::solve_once;
use jostle::system::BuildingSystem;
use jostle::transfer::{ElementwiseRiccati, ProductEquations};
use jostle::{
    Base, Building, Column, Damping, Gravity, Integrator, LawKind, RiccatiSweep, Structure, System,
};
use jostle_testkit::models::UNDAMPED;
use nalgebra::{DMatrix, DVector};

use crate::verification::support::{
    Random, assembled, column, frame, framed, law, random_frame, row, run, shaking, steps, still,
    tower,
};

/// Springs and dashpots in all directions.
fn soft_base() -> Base {
    Base {
        rotational_stiffness: Some(2e8),
        horizontal_stiffness: Some(3e8),
        vertical_stiffness: Some(9e8),
        rotational_damping: 2e6,
        horizontal_damping: 4e6,
        vertical_damping: 6e6,
        mass: 3e3,
        ..Base::default()
    }
}

const LEANING: Gravity = Gravity {
    preload: false,
    p_delta: true,
};

/// A building with everything that stands beside K: base, dashpots, P-Delta.
fn with_everything(mut building: Building) -> Building {
    building.base = match building.structure {
        Structure::Frame(_) => soft_base(),
        Structure::Shear(_) | Structure::Tiers(_) | Structure::Given(_) => Base {
            horizontal_stiffness: Some(8e8),
            horizontal_damping: 5e6,
            mass: 2e4,
            ..Base::default()
        },
    };
    building.gravity = LEANING;
    building
}

fn alone(building: Building) -> System {
    assembled(&row(vec![building], 0.0, law(LawKind::Hertz, 1.0)))
}

fn dense(matrix: &SparseSymmetric) -> DMatrix<f64> {
    let n = matrix.diagonal.len();
    let mut full = DMatrix::zeros(n, n);
    for column in 0..n {
        full[(column, column)] = matrix.diagonal[column];
        for entry in matrix.starts[column]..matrix.starts[column + 1] {
            let row = matrix.rows[entry] as usize;
            full[(row, column)] = matrix.values[entry];
            full[(column, row)] = matrix.values[entry];
        }
    }
    full
}

/// First-floor displacements by the textbook form of the generalised-α method: the acceleration is the unknown, and
/// equilibrium is written at the shifted instants. Massless displacements are condensed beforehand, which is
/// possible where nothing damps them.
fn textbook(
    building: &BuildingSystem,
    integrator: Integrator,
    step: f64,
    ground: &[f64],
) -> Vec<f64> {
    let equations = &building.equations;
    let stiffness = dense(&equations.stiffness);
    let all = &stiffness + &dense(&equations.undamped);
    let dashpots = dense(&equations.dashpots);
    let n = equations.len();
    let mass = DMatrix::from_fn(n, n, |i, j| if i == j { equations.mass[i] } else { 0.0 });
    let damping = DMatrix::from_fn(n, n, |i, j| {
        equations.alpha * mass[(i, j)] + equations.beta * stiffness[(i, j)] + dashpots[(i, j)]
    });
    let Integrator {
        beta,
        gamma,
        alpha_m,
        alpha_f,
    } = integrator;
    let (at_m, at_f) = (1.0 - alpha_m, 1.0 - alpha_f);
    let left = DMatrix::from_fn(n, n, |i, j| {
        at_m * mass[(i, j)]
            + at_f * (step * gamma * damping[(i, j)] + step * step * beta * all[(i, j)])
    });
    let left = left.lu();
    let driven = DVector::from_column_slice(&equations.driven_mass);
    let (mut u, mut v) = (DVector::<f64>::zeros(n), DVector::<f64>::zeros(n));
    let mut a = DVector::from_fn(n, |i, _| {
        if equations.mass[i] > 0.0 {
            -equations.driven_mass[i] / equations.mass[i] * ground[0]
        } else {
            0.0
        }
    });
    let floor = building.floors[0].dof - building.offset;
    let mut path = vec![0.0];
    for pair in ground.windows(2) {
        let u_next = &u + step * &v + (0.5 - beta) * step * step * &a;
        let v_next = &v + (1.0 - gamma) * step * &a;
        let load = at_f * pair[1] + alpha_f * pair[0];
        let right = -load * &driven
            - alpha_m * (&mass * &a)
            - &damping * (at_f * &v_next + alpha_f * &v)
            - &all * (at_f * &u_next + alpha_f * &u);
        a = left.solve(&right).expect("a matrix that is not singular");
        u = u_next + step * step * beta * &a;
        v = v_next + step * gamma * &a;
        path.push(u[floor]);
    }
    path
}

#[test]
fn runs_agree_with_the_textbook_form() {
    let step = 2e-3;
    let motion = shaking(1.0);
    let ground: Vec<f64> = (0..=500)
        .map(|k| motion.acceleration(k as f64 * step))
        .collect();
    // Rotary inertia, so that no displacement is without mass.
    let mut heavy = framed("heavy", frame(3, &[4.0, 6.0]));
    heavy.damping = Damping::Rayleigh {
        alpha: 0.3,
        beta: 2e-3,
    };
    let mut shear = tower("tower", 4, 4e5, 0.5);
    shear.damping = heavy.damping.clone();
    for building in [heavy, shear] {
        let building = with_everything(building);
        let mut discretization = alone(building.clone()).buildings[0].discretization.clone();
        for node in &mut discretization.stick_model.nodes {
            *node = node.with_rotary_inertia(0.3 * node.mass());
        }
        let mut whole = BuildingSystem::new("whole", discretization);
        whole.damp(&building.damping).expect("coefficients");
        for integrator in [
            Integrator::default(),
            Integrator::newmark(0.3025, 0.6),
            Integrator::hht(0.1),
            Integrator::generalized_alpha(0.7),
        ] {
            let expected = textbook(&whole, integrator, step, &ground);
            let system = System::of_buildings(vec![whole.clone()]);
            let mut plan = steps(step, 1);
            plan.integrator = integrator;
            let outcome = run(&system, &motion, &plan);
            let got = column(&outcome, Column::displacement(0, 1));
            let largest = expected.iter().fold(0.0_f64, |most, u| most.max(u.abs()));
            let apart = got
                .iter()
                .zip(&expected)
                .fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
            assert_eq!(got.len(), expected.len());
            assert!(
                apart < 1e-10 * largest,
                "{}, {integrator:?}: {:e}",
                building.name,
                apart / largest
            );
        }
    }
}

#[test]
fn four_solvers_agree_on_soft_ground() {
    let mut random = Random(11);
    for case in 0..12 {
        let building = if case % 4 == 3 {
            tower("tower", random.whole(1, 8), 4e5, 0.6)
        } else {
            let mut frame = random_frame(&mut random);
            frame.storey_heights.truncate(4);
            let storeys = frame.storey_heights.len();
            for list in [&mut frame.columns, &mut frame.beams] {
                list.truncate(storeys);
                for section in list {
                    section.shear_rigidity = section.axial_rigidity.map(|ea| ea / 3.0);
                }
            }
            frame.beam_mass.truncate(storeys);
            frame.floor_mass.truncate(storeys);
            frame.joint.horizontal_stiffness = random.coin().then_some(4e8);
            frame.joint.vertical_stiffness = random.coin().then_some(6e8);
            framed("frame", frame)
        };
        let system = alone(with_everything(building));
        let building = &system.buildings[0];
        assert!(!building.equations.undamped.is_zero() && !building.equations.dashpots.is_zero());
        let matrix = StepMatrix {
            stiffness: 1.3,
            mass: 1e4,
            dashpots: 100.0,
        };
        let load: Vec<f64> = (0..building.equations.len())
            .map(|dof| {
                if building.equations.mass[dof] > 0.0 {
                    random.between(-1e4, 1e4)
                } else {
                    0.0
                }
            })
            .collect();
        let expected = solve_once::<DirectStiffness>(building, &matrix, &load).expect("it stands");
        let others = [
            solve_once::<RiccatiSweep>(building, &matrix, &load),
            solve_once::<ElementwiseRiccati>(building, &matrix, &load),
            solve_once::<ProductEquations>(building, &matrix, &load),
        ];
        let largest = expected.iter().fold(0.0_f64, |most, u| most.max(u.abs()));
        for (solver, (other, limit)) in others.into_iter().zip([1e-12, 1e-10, 1e-8]).enumerate() {
            let other = other.expect("it stands");
            let apart = other
                .iter()
                .zip(&expected)
                .fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
            assert!(
                apart <= limit * largest,
                "case {case}, solver {solver}: {:e}",
                apart / largest
            );
        }
    }
}

#[test]
fn weight_lengthens_the_period_of_a_storey() {
    // ω² = (k − m g/h)/m.
    let mut building = tower("storey", 1, 3e5, 1.0);
    building.gravity = LEANING;
    let Structure::Shear(shear) = &building.structure else {
        unreachable!("a tower is a shear building")
    };
    let (mass, stiffness, height) = (shear.mass[0], shear.stiffness[0], shear.storey_heights[0]);
    let expected = ((stiffness - mass * STANDARD_GRAVITY / height) / mass).sqrt();
    let found = alone(building).buildings[0].modes[0].circular_frequency;
    assert!(
        (found / expected - 1.0).abs() < 1e-13,
        "{found} and {expected}"
    );
}

#[test]
fn a_base_in_series_softens_a_storey() {
    // Without mass of its own a base is a spring in series.
    let mut building = tower("storey", 1, 3e5, 0.5);
    building.base.horizontal_stiffness = Some(1e7);
    let Structure::Shear(shear) = &building.structure else {
        unreachable!("a tower is a shear building")
    };
    let together = 1.0 / (1.0 / shear.stiffness[0] + 1.0 / 1e7);
    let expected = (together / shear.mass[0]).sqrt();
    let found = alone(building).buildings[0].modes[0].circular_frequency;
    assert!(
        (found / expected - 1.0).abs() < 1e-13,
        "{found} and {expected}"
    );
}

#[test]
fn a_stiff_frame_rocks_on_its_base() {
    // Rigid beams and columns on vertical springs at x = 0 and L: rocking about the middle, ω² = Σ k (L/2)² / Σ m r².
    let span = 6.0;
    let mut stiff = frame(1, &[span]);
    for section in stiff.columns.iter_mut().chain(&mut stiff.beams) {
        section.flexural_rigidity *= 1e5;
        section.line_mass = 0.0;
    }
    (stiff.beam_mass, stiff.floor_mass) = (vec![0.0], vec![8e4]);
    let mut building = framed("rocking", stiff);
    building.damping = UNDAMPED;
    building.base = Base {
        vertical_stiffness: Some(5e7),
        rotational_stiffness: Some(1e2),
        ..Base::default()
    };
    let system = alone(building);
    let height = system.buildings[0].floors[0].height;
    // Both joints turn about the middle of the base, for feet cannot slide.
    let inertia = 8e4 * (height * height + 0.25 * span * span);
    let expected = (2.0 * 5e7 * 0.25 * span * span / inertia).sqrt();
    let found = system.buildings[0].modes[0].circular_frequency;
    assert!(
        (found / expected - 1.0).abs() < 1e-4,
        "{found} and {expected}"
    );
}

#[test]
fn a_dashpot_takes_what_it_should() {
    // A storey so stiff that it rides on its base: free vibration with ζ = c/(2 √(k m)).
    let mut building = tower("rider", 1, 1e5, 1e-3);
    building.damping = UNDAMPED;
    let (mass, stiffness, ratio) = (1e5_f64, 4e6_f64, 0.1_f64);
    let frequency = (stiffness / mass).sqrt();
    building.base.horizontal_stiffness = Some(stiffness);
    building.base.horizontal_damping = 2.0 * ratio * (stiffness * mass).sqrt();
    let system = alone(building);
    let mut state = jostle::State::at_rest(&system, 0.0);
    state.displacement.fill(0.01);
    let period = 2.0 * PI / frequency / (1.0 - ratio * ratio).sqrt();
    let outcome = crate::verification::support::run_from(
        &system,
        &still(period),
        &steps(period / 4000.0, 1),
        state,
    );
    let left = outcome.state.displacement[system.buildings[0].floors[0].dof] / 0.01;
    let expected = (-2.0 * PI * ratio / (1.0 - ratio * ratio).sqrt()).exp();
    assert!(
        (left / expected - 1.0).abs() < 1e-4,
        "{left} and {expected}"
    );
}

#[test]
fn nothing_stirs_under_its_own_weight() {
    let mut building = with_everything(framed("loaded", frame(3, &[4.0, 7.0])));
    building.gravity = Gravity {
        preload: true,
        p_delta: true,
    };
    let system = alone(building);
    let sag = system.buildings[0]
        .rest
        .displacement
        .iter()
        .fold(0.0_f64, |most, u| most.max(u.abs()));
    assert!(sag > 1e-4, "beams sag: {sag}");
    let outcome = run(&system, &still(2.0), &steps(2e-3, 1));
    let rest = &system.buildings[0].rest.displacement;
    let moved = outcome
        .state
        .displacement
        .iter()
        .zip(rest)
        .fold(0.0_f64, |most, (u, rest)| most.max((u - rest).abs()));
    assert!(moved <= 1e-9 * sag, "{:e}", moved / sag);
}

#[test]
fn weight_adds_to_shaking_without_changing_it() {
    // A linear building moves about its rest as it would without weight.
    let motion = shaking(2.0);
    let plan = steps(2e-3, 1);
    let plain = framed("plain", frame(4, &[4.0, 7.0]));
    let mut loaded = plain.clone();
    loaded.gravity.preload = true;
    let (plain, loaded) = (alone(plain), alone(loaded));
    let (a, b) = (run(&plain, &motion, &plan), run(&loaded, &motion, &plan));
    let rest = &loaded.buildings[0].rest.displacement;
    let largest = a
        .state
        .displacement
        .iter()
        .fold(0.0_f64, |most, u| most.max(u.abs()));
    for (dof, (a, b)) in a
        .state
        .displacement
        .iter()
        .zip(&b.state.displacement)
        .enumerate()
    {
        assert!(
            (a - (b - rest[dof])).abs() < 1e-10 * largest,
            "dof {dof}: {a} and {b}"
        );
    }
    assert!(
        b.energy.worst_imbalance < 1e-9,
        "{:e}",
        b.energy.worst_imbalance
    );
}

#[test]
fn energy_balances_on_soft_ground() {
    let left = with_everything(framed("left", frame(3, &[4.0])));
    let right = with_everything(tower("right", 4, 3e5, 0.7));
    let system = assembled(&row(vec![left, right], 0.01, law(LawKind::HertzDamp, 0.6)));
    let outcome = run(&system, &shaking(4.0), &steps(2e-3, 8));
    assert!(!outcome.impacts.is_empty());
    assert!(
        outcome.energy.worst_imbalance < 1e-9,
        "{:e}",
        outcome.energy.worst_imbalance
    );
}

#[test]
fn shifted_equilibrium_is_of_second_order() {
    let motion = shaking(1.0);
    let system = alone(tower("tower", 3, 2e5, 0.6));
    for integrator in [Integrator::hht(0.2), Integrator::generalized_alpha(0.5)] {
        let roof = |step: f64| {
            let mut plan = steps(step, 1);
            plan.integrator = integrator;
            run(&system, &motion, &plan).state.displacement[2]
        };
        let exact = { run(&system, &motion, &steps(5e-5, 1)).state.displacement[2] };
        let ratio = (roof(5e-3) - exact) / (roof(2.5e-3) - exact);
        assert!((3.3..4.7).contains(&ratio), "{integrator:?}: {ratio}");
    }
}

#[test]
fn an_integrator_that_dissipates_spoils_the_rebound() {
    // Free masses under an elastic law keep their energy; with HHT they must lose some.
    let towers = || vec![tower("a", 1, 1e5, 0.4), tower("b", 1, 2e5, 1.1)];
    let mut model = row(towers(), 0.005, law(LawKind::Hertz, 1.0));
    for building in &mut model.buildings {
        building.damping = UNDAMPED;
    }
    let system = assembled(&model);
    let taken = |integrator: Integrator| {
        let mut plan = steps(2e-3, 4);
        plan.integrator = integrator;
        let energy = run(&system, &shaking(4.0), &plan).energy;
        energy.residual() / energy.input
    };
    assert!(taken(Integrator::default()).abs() < 1e-9);
    assert!(taken(Integrator::hht(0.1)) > 1e-4);
}

#[test]
fn a_building_too_weak_for_its_weight_is_refused() {
    let mut building = tower("weak", 1, 1e6, 8.0);
    building.gravity = LEANING;
    let faults = System::assemble(&row(vec![building], 0.0, law(LawKind::Hertz, 1.0)))
        .expect_err("it would fall over");
    assert_eq!(faults[0].path, "building[0].p_delta");
    assert!(
        faults[0].problem.contains("buckles"),
        "{}",
        faults[0].problem
    );
}

#[test]
fn idealisation_without_base_is_unchanged() {
    let plain = framed("plain", frame(2, &[5.0]));
    let nodes = Discretization::new(&plain).stick_model.nodes.len();
    let mut based = plain.clone();
    based.base = soft_base();
    assert_eq!(
        Discretization::new(&based).stick_model.nodes.len(),
        nodes + 2
    );
}
