//! Storey shears and overturning moments against free bodies, springs, and the base shear.

use jostle::history::{Column, PeaksOf};
use jostle::{Analysis, Damping, LawKind, Model, Outcome, Plan, Solver, Structure, System};
use jostle_testkit::compare::near;
use jostle_testkit::models::UNDAMPED;

use crate::verification::support::{assembled, frame, law, run, shaking, two_frames};

fn outcome(system: &System, solver: Solver, tolerance: f64) -> Outcome {
    let motion = shaking(3.0);
    let analysis = Analysis {
        solver: Some(solver),
        tolerance,
        ..Analysis::default()
    };
    let plan = Plan::choose(system, &motion, &analysis).expect("steps are found");
    run(system, &motion, &plan)
}

/// One building of another structure.
fn alone(structure: Structure, damping: Damping) -> Model {
    let mut model = two_frames(0.02, law(LawKind::Linear, 1.0));
    model.buildings.truncate(1);
    model.gaps.clear();
    model.buildings[0].structure = structure;
    model.buildings[0].damping = damping;
    model
}

fn towers() -> Model {
    let mut model = two_frames(0.01, law(LawKind::Kelvin, 0.6));
    for (index, building) in model.buildings.iter_mut().enumerate() {
        let stiffness = 4e7 * (1.0 + index as f64);
        building.structure = Structure::Shear(jostle::Shear {
            mass: vec![5e4; 4],
            stiffness: vec![2.0 * stiffness, 1.5 * stiffness, stiffness, stiffness],
            storey_heights: vec![4.0, 3.0, 3.0, 3.5],
        });
    }
    model
}

#[test]
fn storeys_of_shear_buildings_bear_stiffness_times_drift() {
    let model = towers();
    let system = assembled(&model);
    for solver in [Solver::Modal, Solver::Riccati] {
        let outcome = outcome(&system, solver, 1e-3);
        assert!(!outcome.impacts.is_empty());
        for (index, building) in model.buildings.iter().enumerate() {
            let Structure::Shear(shear) = &building.structure else {
                panic!("a shear building");
            };
            let storeys = shear.stiffness.iter().zip(&shear.storey_heights);
            for ((stiffness, height), peaks) in storeys.zip(&outcome.peaks.floors(index)) {
                let expected = stiffness * peaks.storey_drift() * height;
                near(peaks.storey_shear(), expected, 1e-6, "storey shear");
            }
            let first = outcome.peaks.floor(index, 1).storey_shear();
            near(first, outcome.peaks.base_shear(index), 1e-6, "base shear");
        }
    }
}

/// Without damping and contact, what a storey bears is mass times total acceleration of all floors above.
#[test]
fn frames_bear_the_inertia_above() {
    let mut bare = frame(4, &[5.0, 4.0]);
    bare.column_segments = 1;
    bare.beam_segments = vec![1; 2];
    let system = assembled(&alone(Structure::Frame(bare), UNDAMPED));
    let building = &system.buildings[0];
    let outcome = outcome(&system, Solver::Stiffness, 1e-3);
    let history = outcome.history.as_ref().expect("a history");
    let of_floor = |floor: usize| {
        let column = Column::total_acceleration(0, floor);
        history.column(column).expect("a column")
    };
    let accelerations: Vec<Vec<f64>> = (1..=4).map(of_floor).collect();
    for (storey, peaks) in outcome.peaks.floors(0).iter().enumerate() {
        let base = building.floors[storey].height - building.floors[storey].storey_height;
        let (mut shear, mut moment) = (0.0_f64, 0.0_f64);
        for row in 0..history.len() {
            let above = (storey..4).map(|floor| {
                let at = building.floors[floor];
                let force = building.equations.mass[at.dof] * accelerations[floor][row];
                [force, force * (at.height - base)]
            });
            let sum = above.fold([0.0; 2], |sum, above| {
                [sum[0] + above[0], sum[1] + above[1]]
            });
            shear = shear.max(sum[0].abs());
            moment = moment.max(sum[1].abs());
        }
        near(peaks.storey_shear(), shear, 1e-6, "storey shear");
        near(peaks.overturning_moment(), moment, 1e-6, "moment");
    }
}

fn greatest_difference(a: &Outcome, b: &Outcome, kind: fn(&PeaksOf<'_>) -> f64) -> f64 {
    let buildings = a.peaks.buildings().zip(b.peaks.buildings());
    buildings
        .map(|(a, b)| {
            let greatest = b.iter().map(kind).fold(0.0, f64::max);
            let apart = a.iter().zip(&b).map(|(a, b)| (kind(a) - kind(b)).abs());
            apart.fold(0.0, f64::max) / greatest
        })
        .fold(0.0, f64::max)
}

/// Masses within columns and beams, contact and damping: shapes and a step-by-step solution of the whole building.
#[test]
fn modal_forces_are_those_of_the_whole_frame() {
    let system = assembled(&two_frames(0.02, law(LawKind::HertzDamp, 0.65)));
    let exact = outcome(&system, Solver::Modal, 1e-6);
    for (solver, tolerance) in [(Solver::Modal, 1e-3), (Solver::Stiffness, 1e-3)] {
        let found = outcome(&system, solver, tolerance);
        assert!(!found.impacts.is_empty());
        let kinds: [fn(&PeaksOf<'_>) -> f64; 2] = [
            |floor| floor.storey_shear(),
            |floor| floor.overturning_moment(),
        ];
        for kind in kinds {
            let apart = greatest_difference(&found, &exact, kind);
            assert!(apart <= tolerance, "{solver:?}: {apart}");
        }
    }
}
