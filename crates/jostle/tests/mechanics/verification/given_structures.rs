//! Buildings given by matrices against the same buildings made of storeys.

use jostle::method::MethodSurvey;
use jostle::{Damping, Given, LawKind, Model, Plan, Shear, Solver, Structure, System};
use jostle_testkit::compare::near;
use jostle_testkit::models::UNDAMPED;

use crate::verification::support::{assembled, base_shears, law, run, shaking, two_frames};

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
    near(found, expected, 1e-9, what);
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
    let survey = MethodSurvey::new(&system.buildings[0]).expect("it resists");
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
            (|g| g.stiffness[5].2 = -1.0) as fn(&mut Given),
            "must be positive definite: displacement",
        ),
        (|g| g.stiffness[2].2 = f64::NAN, "must be finite"),
        (
            |g| g.stiffness[1].1 = 2,
            "rows up to 3 and the lower triangle",
        ),
        (
            |g| g.damping.push((0, 0, -1e3)),
            "building[1].damping: must be positive semidefinite: displacement 1 gains energy",
        ),
        (
            |g| g.damping.push((3, 0, 1.0)),
            "building[1].damping: has an entry in row 4",
        ),
        (
            |g| g.mass[0] = 0.0,
            "floor 1 is displacement 1, which has no mass",
        ),
        (|g| g.mass[1] = -1.0, "building[1].mass[1]"),
        (
            |g| g.floors[1] = 0,
            "floor 2 is displacement 1, as a floor below it is",
        ),
        (|g| g.floors[2] = 7, "floor 3 is displacement 8, of 3"),
        (
            |g| g.influence[2] = 0.0,
            "a floor must move with the ground",
        ),
        (
            |g| g.heights[2] = 1.0,
            "by the heights of the displacements",
        ),
        (|g| g.heights.truncate(1), "heights for 1 displacements"),
        (
            |g| g.storey_heights.truncate(1),
            "has 1 entries for 3 floors",
        ),
        (
            |g| *g = Given::condensed(vec![], &[], vec![]),
            "has 0 displacements",
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

/// A frame by its full matrices, rotations and vertical displacements included, in another order and with horizontal
/// displacements that are measured in other lengths: the same impact forces, storey forces and base shear.
#[test]
fn a_frame_given_by_all_its_displacements_gives_the_same_numbers() {
    let mut frames = two_frames(0.01, law(LawKind::HertzDamp, 0.6));
    for building in &mut frames.buildings {
        building.damping = DAMPING;
    }
    let system = assembled(&frames);
    let mut model = frames.clone();
    for (building_model, building) in model.buildings.iter_mut().zip(&system.buildings) {
        let equations = &building.equations;
        let n = equations.len();
        let mut heights = vec![0.0; n];
        let mut influence = vec![0.0; n];
        for (node, place) in building.discretization.stick_model.nodes.iter().enumerate() {
            if let Some(dof) = equations.horizontal(node) {
                (heights[dof], influence[dof]) = (place.y, 1.0);
            }
        }
        // The first displacement that is no floor, in halves.
        let halved = (0..n)
            .find(|dof| influence[*dof] == 1.0 && !building.floor_dofs.contains(dof))
            .expect("inside a column");
        influence[halved] = 2.0;
        let scale = |dof: usize| if dof == halved { 0.5 } else { 1.0 };
        let place = |dof: usize| n - 1 - dof;
        let entry = |row: usize, column: usize, value: f64| {
            let (a, b) = (place(row), place(column));
            (a.max(b), a.min(b), value * scale(row) * scale(column))
        };
        let k = &equations.stiffness;
        let mut stiffness: Vec<_> = (0..n).map(|dof| entry(dof, dof, k.diagonal[dof])).collect();
        for (column, bounds) in k.starts.windows(2).enumerate() {
            for at in bounds[0]..bounds[1] {
                stiffness.push(entry(k.rows[at] as usize, column, k.values[at]));
            }
        }
        let mut reversed = [equations.mass.clone(), heights, influence];
        reversed[0][halved] *= 0.25;
        reversed.iter_mut().for_each(|list| list.reverse());
        let [mass, heights, influence] = reversed;
        building_model.structure = Structure::Given(Given {
            mass,
            stiffness,
            damping: Vec::new(),
            influence,
            heights,
            floors: building.floor_dofs.iter().map(|dof| place(*dof)).collect(),
            storey_heights: building_model.storey_heights().to_vec(),
        });
    }
    let matrices = assembled(&model);
    for solver in [Solver::Modal, Solver::Stiffness] {
        let expected = outcome(&system, &frames, solver);
        let found = outcome(&matrices, &model, solver);
        assert!(expected.impacts.len() > 2);
        assert_eq!(found.impacts.len(), expected.impacts.len());
        for (found, expected) in found.impacts.iter().zip(&expected.impacts) {
            close(found.peak_force, expected.peak_force, "impact force");
        }
        for (found, expected) in found
            .peaks
            .buildings()
            .flatten()
            .zip(expected.peaks.buildings().flatten())
        {
            close(
                found.storey_shear(),
                expected.storey_shear(),
                "storey shear",
            );
            close(
                found.overturning_moment(),
                expected.overturning_moment(),
                "moment",
            );
            close(
                found.total_acceleration(),
                expected.total_acceleration(),
                "acceleration",
            );
        }
        for (found, expected) in base_shears(&found).iter().zip(&base_shears(&expected)) {
            close(*found, *expected, "base shear");
        }
    }
}

/// A damping matrix that modes do not share: direct steps take it whole, and modal stepping as dashpots.
#[test]
fn a_damping_matrix_acts_as_dashpots() {
    let stiffness = vec![vec![9e7, -4e7], vec![-4e7, 4e7]];
    let mut given = Given::condensed(vec![5e4, 4e4], &stiffness, vec![3.0; 2]);
    given.damping = vec![(0, 0, 9e5), (1, 0, -2e5), (1, 1, 3e5)];
    let mut model = pair(Structure::Shear);
    model.buildings.truncate(1);
    model.gaps.clear();
    model.buildings[0].structure = Structure::Given(given);
    model.buildings[0].damping = UNDAMPED;
    let system = assembled(&model);
    let [modal, direct] = [Solver::Modal, Solver::Riccati].map(|solver| {
        let mut analysis = model.analysis.clone();
        (analysis.solver, analysis.tolerance) = (Some(solver), 1e-5);
        let motion = shaking(3.0);
        let plan = Plan::choose(&system, &motion, &analysis).expect("steps are found");
        run(&system, &motion, &plan)
    });
    for (found, expected) in modal.peaks.floors(0).iter().zip(&direct.peaks.floors(0)) {
        let off = found.displacement_max().value / expected.displacement_max().value - 1.0;
        assert!(off.abs() < 2e-5, "{off:e}");
        let off = found.total_acceleration() / expected.total_acceleration() - 1.0;
        assert!(off.abs() < 2e-5, "{off:e}");
    }
}
