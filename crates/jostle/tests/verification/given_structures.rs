//! Buildings given by matrices against the same buildings made of storeys.

use jostle::method::MethodSurvey;
use jostle::{Damping, Given, LawKind, Model, Plan, Shear, Solver, Structure, System};

use crate::support::{assembled, law, run, shaking, two_frames};

const DAMPING: Damping = Damping::Rayleigh {
    alpha: 0.4,
    beta: 1e-3,
};

fn shear(scale: f64) -> Shear {
    Shear {
        mass: vec![5e4, 4e4, 3e4],
        stiffness: [9e7, 7e7, 5e7].map(|k| k * scale).to_vec(),
        storey_heights: vec![4.0, 3.0, 3.5],
    }
}

/// The tridiagonal matrix of a shear building.
fn given(shear: &Shear) -> Given {
    let n = shear.mass.len();
    let mut stiffness = vec![vec![0.0; n]; n];
    for (storey, k) in shear.stiffness.iter().enumerate() {
        stiffness[storey][storey] += k;
        if storey > 0 {
            stiffness[storey - 1][storey - 1] += k;
            stiffness[storey - 1][storey] -= k;
            stiffness[storey][storey - 1] -= k;
        }
    }
    Given::condensed(shear.mass.clone(), &stiffness, shear.storey_heights.clone())
}

fn pair(structure: impl Fn(Shear) -> Structure) -> Model {
    let mut model = two_frames(0.005, law(LawKind::Kelvin, 0.6));
    for (building, scale) in model.buildings.iter_mut().zip([1.0, 2.5]) {
        building.structure = structure(shear(scale));
        building.damping = DAMPING;
    }
    model
}

fn outcome(system: &System, model: &Model, solver: Solver) -> jostle::Outcome {
    let motion = shaking(3.0);
    let mut analysis = model.analysis.clone();
    analysis.solver = Some(solver);
    analysis.step = Some(1e-3);
    analysis.contact_step = Some(1e-4);
    let plan = Plan::choose(system, &motion, &analysis).expect("steps are given");
    run(system, &motion, &plan)
}

fn close(found: f64, expected: f64, what: &str) {
    assert!(
        (found - expected).abs() <= 1e-9 * expected.abs(),
        "{what}: {found} for {expected}"
    );
}

#[test]
fn a_shear_building_given_by_its_matrices_gives_the_same_numbers() {
    let storeys = pair(Structure::Shear);
    let matrices = pair(|shear| Structure::Given(given(&shear)));
    let systems = [assembled(&storeys), assembled(&matrices)];
    for (expected, found) in systems[0].buildings.iter().zip(&systems[1].buildings) {
        let modes = found.lateral_modes().zip(expected.lateral_modes());
        for (found, expected) in modes {
            close(found.period(), expected.period(), "period");
        }
        assert_eq!(found.lateral_modes().count(), 3);
    }
    for solver in [Solver::Modal, Solver::Riccati, Solver::Stiffness] {
        let expected = outcome(&systems[0], &storeys, solver);
        let found = outcome(&systems[1], &matrices, solver);
        assert!(!expected.impacts.is_empty());
        assert_eq!(found.impacts.len(), expected.impacts.len());
        for (found, expected) in found.impacts.iter().zip(&expected.impacts) {
            close(found.peak_force, expected.peak_force, "impact force");
        }
    }
}

const CANTILEVER_MASS: f64 = 1e4;
const CANTILEVER_K: f64 = 6.0 / 7.0 * 1e7;

fn cantilever() -> Model {
    let (mass, k) = (CANTILEVER_MASS, CANTILEVER_K);
    let mut model = pair(Structure::Shear);
    model.buildings.truncate(1);
    model.gaps.clear();
    model.buildings[0].structure = Structure::Given(Given::condensed(
        vec![mass; 2],
        &[vec![16.0 * k, -5.0 * k], vec![-5.0 * k, 2.0 * k]],
        vec![1.0, 1.0],
    ));
    model
}

/// Condensed at the floors, a cantilever of bending stiffness EI = 1 and unit storeys has the flexibility
/// a² (3 b − a) / 6 for a ≤ b: its inverse has entries of both signs, and no storeys.
#[test]
fn a_condensed_cantilever_has_its_closed_form_periods() {
    // Two floors at 1 and 2: F = [[2, 5], [5, 16]] / 6, so K = 6/7 [[16, −5], [−5, 2]].
    let (mass, k) = (CANTILEVER_MASS, CANTILEVER_K);
    let system = assembled(&cantilever());
    // ω² m / k = 9 ∓ √74.
    let expected = [-1.0, 1.0].map(|sign| ((9.0 + sign * 74.0_f64.sqrt()) * k / mass).sqrt());
    let found: Vec<f64> = system.buildings[0]
        .lateral_modes()
        .map(|mode| std::f64::consts::TAU / mode.period())
        .collect();
    assert_eq!(found.len(), 2);
    for (found, expected) in found.into_iter().zip(expected) {
        close(found, expected, "frequency");
    }
}

#[test]
fn storeys_of_a_condensed_cantilever_bear_the_forces_above_them() {
    let system = assembled(&cantilever());
    let building = &system.buildings[0];
    let mut displacement = vec![0.0; building.equations.len()];
    displacement[building.floor_dofs[0]] = 1.0;
    // Forces 16 k at the lower and −5 k at the upper floor.
    let expected = [(11.0, 6.0), (-5.0, -5.0)];
    let mut storeys = 0;
    building.storeys.for_each(
        &displacement,
        |_| 0.0,
        |storey, found| {
            close(found.shear, expected[storey].0 * CANTILEVER_K, "shear");
            close(found.moment, expected[storey].1 * CANTILEVER_K, "moment");
            storeys += 1;
        },
    );
    assert_eq!(storeys, 2);
}

#[test]
fn a_condensed_cantilever_has_no_transfer_path() {
    let system = assembled(&cantilever());
    let survey = MethodSurvey::of(&system.buildings[0]).expect("it resists");
    assert_eq!(survey.product_unknowns, 0);
    for step in &survey.accuracy {
        assert!(step.riccati < 1e-9, "{step:?}");
    }
}

#[test]
fn bad_matrices_are_refused() {
    let problem = |change: fn(&mut Given)| {
        let mut model = pair(|shear| Structure::Given(given(&shear)));
        if let Structure::Given(given) = &mut model.buildings[1].structure {
            change(given);
        }
        let faults = model.check().expect_err("it is wrong");
        faults[0].to_string()
    };
    for (change, expected) in [
        (
            (|g| g.stiffness[0][1] *= 1.1) as fn(&mut Given),
            "must be symmetric",
        ),
        (|g| g.stiffness[2][2] = -1.0, "must be positive definite"),
        (|g| g.stiffness[1][1] = f64::NAN, "must be finite"),
        (|g| g.stiffness[1].truncate(2), "must be square"),
        (|g| g.stiffness.truncate(2), "has 2 rows for 3 floors"),
        (|g| g.mass[0] = 0.0, "building[1].mass[0]"),
        (
            |g| g.storey_heights.truncate(1),
            "has 1 entries for 3 floors",
        ),
        (
            |g| {
                *g = Given {
                    mass: vec![],
                    stiffness: vec![],
                    storey_heights: vec![],
                }
            },
            "at least one floor",
        ),
    ] {
        let found = problem(change);
        assert!(found.contains(expected), "{found}");
    }
}

#[test]
fn gravity_and_springs_under_the_base_are_refused() {
    let mut model = pair(|shear| Structure::Given(given(&shear)));
    model.buildings[0].gravity.p_delta = true;
    model.buildings[1].base.horizontal_stiffness = Some(1e8);
    let faults = model.check().expect_err("neither is possible");
    let text: Vec<String> = faults.iter().map(ToString::to_string).collect();
    assert!(
        text[0].contains("make P-Delta part of its stiffness matrix"),
        "{text:?}"
    );
    assert!(
        text[1].contains("make the base part of its stiffness matrix"),
        "{text:?}"
    );
}
