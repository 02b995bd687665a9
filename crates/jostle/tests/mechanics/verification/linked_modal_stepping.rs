//! Linked buildings, bases with mass and P-Delta by modal stepping, against the matrix exponential of the full equations and
//! against Riccati's recursion.

use jostle::history::{Kind, Owner, PeaksOf};
use jostle::{
    Base, Building, Column, Damping, FloorPairs, GroundMotion, LawKind, Link, Model, Outcome, Plan,
    Shear, Solver, Structure,
};

use crate::verification::support::{
    assembled, column, difference, law, row, run, shaking, steps, tower, two_frames,
};

const ALPHA: f64 = 0.5;
const BETA: f64 = 2e-3;
const BASE: [f64; 3] = [6e7, 9e5, 3e4];
const GRAVITY: f64 = 9.80665;

fn shear(name: &str, mass: &[f64], stiffness: &[f64]) -> Building {
    Building {
        name: name.to_owned(),
        structure: Structure::Shear(Shear {
            mass: mass.to_vec(),
            stiffness: stiffness.to_vec(),
            storey_heights: vec![3.0; mass.len()],
        }),
        damping: Damping::Rayleigh {
            alpha: ALPHA,
            beta: BETA,
        },
        ..Building::default()
    }
}

fn link(between: [Option<usize>; 2], floors: &[(usize, usize)], of: [f64; 2]) -> Link {
    Link {
        between,
        floors: FloorPairs::listed(floors),
        level_tolerance: 1e-3,
        stiffness: of[0],
        damping: of[1],
        law: jostle::LinkLaw::Linear,
        ..Link::default()
    }
}

/// A fixed tower, one on a base that slides, and one that leans, each linked to the next.
fn three_towers() -> Model {
    let mut buildings = vec![
        shear("fixed", &[4e4, 4e4, 3e4], &[6e7, 5e7, 4e7]),
        shear("sliding", &[5e4, 5e4], &[7e7, 3e7]),
        shear("leaning", &[6e4, 5e4, 5e4, 4e4], &[3e7, 3e7, 2e7, 2e7]),
    ];
    buildings[1].base = Base {
        horizontal_stiffness: Some(BASE[0]),
        horizontal_damping: BASE[1],
        mass: BASE[2],
        ..Base::default()
    };
    buildings[2].gravity.p_delta = true;
    let mut model = row(buildings, 9.0, law(LawKind::Linear, 1.0));
    model.links = vec![
        link([Some(0), Some(1)], &[(1, 1), (2, 2)], [4e6, 7e5]),
        link([Some(1), Some(2)], &[(2, 2)], [0.0, 2e6]),
    ];
    model
}

type Matrix = Vec<Vec<f64>>;

/// M, C and K of the three towers, written down by hand: three floors, foot and two floors, four floors.
fn full_matrices() -> (Vec<f64>, Matrix, Matrix) {
    let n = 10;
    let mass = [4e4, 4e4, 3e4, BASE[2], 5e4, 5e4, 6e4, 5e4, 5e4, 4e4].to_vec();
    let zero = vec![vec![0.0; n]; n];
    let spring = |matrix: &mut Matrix, ends: [Option<usize>; 2], k: f64| {
        for (a, end) in ends.iter().enumerate() {
            for (b, other) in ends.iter().enumerate() {
                if let (Some(i), Some(j)) = (end, other) {
                    matrix[*i][*j] += if a == b { k } else { -k };
                }
            }
        }
    };
    let mut storeys = zero.clone();
    for (below, above, k) in [
        (None, 0, 6e7),
        (Some(0), 1, 5e7),
        (Some(1), 2, 4e7),
        (Some(3), 4, 7e7),
        (Some(4), 5, 3e7),
        (None, 6, 3e7),
        (Some(6), 7, 3e7),
        (Some(7), 8, 2e7),
        (Some(8), 9, 2e7),
    ] {
        spring(&mut storeys, [below, Some(above)], k);
    }
    let mut stiffness = storeys.clone();
    let mut damping: Matrix = storeys
        .iter()
        .map(|row| row.iter().map(|k| BETA * k).collect())
        .collect();
    for (i, mass) in mass.iter().enumerate() {
        damping[i][i] += ALPHA * mass;
    }
    spring(&mut stiffness, [None, Some(3)], BASE[0]);
    spring(&mut damping, [None, Some(3)], BASE[1]);
    let mut above = 0.0;
    for (floor, below) in [(9, Some(8)), (8, Some(7)), (7, Some(6)), (6, None)] {
        above += GRAVITY * mass[floor];
        spring(&mut stiffness, [below, Some(floor)], -above / 3.0);
    }
    for (ends, k, c) in [([0, 4], 4e6, 7e5), ([1, 5], 4e6, 7e5), ([5, 7], 0.0, 2e6)] {
        let ends = ends.map(Some);
        spring(&mut stiffness, ends, k);
        spring(&mut damping, ends, c);
    }
    (mass, damping, stiffness)
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    a.iter()
        .map(|row| {
            let mut sums = vec![0.0; b[0].len()];
            for (factor, other) in row.iter().zip(b) {
                for (sum, value) in sums.iter_mut().zip(other) {
                    *sum += factor * value;
                }
            }
            sums
        })
        .collect()
}

/// e^A by a series of A/2^k, squared k times.
fn exponential(a: &Matrix) -> Matrix {
    let n = a.len();
    let norm = a
        .iter()
        .map(|row| row.iter().map(|x| x.abs()).sum::<f64>())
        .fold(0.0, f64::max);
    let halvings = norm.log2().ceil().max(0.0) as i32 + 4;
    let scale = 0.5_f64.powi(halvings);
    let small: Matrix = a
        .iter()
        .map(|row| row.iter().map(|x| x * scale).collect())
        .collect();
    let unit = |i: usize, j: usize| f64::from(u8::from(i == j));
    let mut sum: Matrix = (0..n)
        .map(|i| (0..n).map(|j| unit(i, j)).collect())
        .collect();
    let mut term = sum.clone();
    for power in 1..=14 {
        term = product(&term, &small);
        for (term, sum) in term.iter_mut().zip(&mut sum) {
            for (value, sum) in term.iter_mut().zip(sum) {
                *value /= f64::from(power);
                *sum += *value;
            }
        }
    }
    for _ in 0..halvings {
        sum = product(&sum, &sum);
    }
    sum
}

/// Displacements of all degrees of freedom at the points of the motion, exact for linear ground acceleration between them.
fn exact(motion: &GroundMotion, points: usize) -> Vec<Vec<f64>> {
    let (mass, damping, stiffness) = full_matrices();
    let n = mass.len();
    let step = motion.step().expect("a record");
    // u, u̇, ground acceleration and its rate.
    let mut rates = vec![vec![0.0; 2 * n + 2]; 2 * n + 2];
    for i in 0..n {
        rates[i][n + i] = step;
        for j in 0..n {
            rates[n + i][j] = -step * stiffness[i][j] / mass[i];
            rates[n + i][n + j] = -step * damping[i][j] / mass[i];
        }
        rates[n + i][2 * n] = -step;
    }
    rates[2 * n][2 * n + 1] = step;
    let over_step = exponential(&rates);
    let mut state = vec![0.0; 2 * n + 2];
    let mut found = vec![state[..n].to_vec()];
    for point in 0..points {
        let at = |point: usize| motion.acceleration(point as f64 * step);
        state[2 * n] = at(point);
        state[2 * n + 1] = (at(point + 1) - at(point)) / step;
        state = over_step
            .iter()
            .map(|row| row.iter().zip(&state).map(|(a, b)| a * b).sum())
            .collect();
        found.push(state[..n].to_vec());
    }
    found
}

fn by_modes(model: &Model, motion: &GroundMotion, step: f64) -> Outcome {
    let plan = Plan {
        solver: Solver::Modal,
        ..steps(step, 1)
    };
    run(&assembled(model), motion, &plan)
}

#[test]
fn links_bases_and_leaning_columns_are_those_of_the_full_matrices() {
    let motion = shaking(3.0);
    let expected = exact(&motion, 300);
    let model = three_towers();
    let mut errors = Vec::new();
    for step in [1e-3, 5e-4, 2.5e-4] {
        let outcome = by_modes(&model, &motion, step);
        let every = (0.01 / step).round() as usize;
        let mut worst: f64 = 0.0;
        let floors = [(0, 0, 3), (1, 4, 2), (2, 6, 4)];
        for (building, first, floors) in floors {
            for floor in 1..=floors {
                let found = column(&outcome, Column::displacement(building, floor));
                let found: Vec<f64> = found.into_iter().step_by(every).collect();
                let expected: Vec<f64> = expected.iter().map(|u| u[first + floor - 1]).collect();
                worst = worst.max(difference(&found, &expected));
            }
        }
        assert!(outcome.energy.worst_imbalance < 1e-11);
        errors.push(worst);
    }
    assert!(errors[2] < 1e-9, "{errors:?}");
    // Of fourth order.
    assert!(errors[0] / errors[1] > 12.0, "{errors:?}");
}

/// Peaks of a run to a tolerance, and how they compare with those of Riccati's recursion at a smaller one.
fn compare(model: &Model, motion: &GroundMotion, tolerance: f64, expected_within: f64) -> Outcome {
    let system = assembled(model);
    let planned = |solver: Option<Solver>, tolerance: f64| {
        let mut analysis = model.analysis.clone();
        (analysis.solver, analysis.tolerance) = (solver, tolerance);
        let plan = Plan::choose(&system, motion, &analysis).expect("a plan");
        if solver.is_none() {
            assert_eq!(plan.solver, Solver::Modal);
        }
        run(&system, motion, &plan)
    };
    let (found, fine) = (
        planned(None, tolerance),
        planned(Some(Solver::Riccati), 1e-5),
    );
    assert_eq!(found.impacts.len(), fine.impacts.len());
    let mut pairs = Vec::new();
    let most = |of: &dyn Fn(usize) -> f64, count: usize| (0..count).map(of).fold(0.0, f64::max);
    for (building, other) in found.peaks.buildings().zip(fine.peaks.buildings()) {
        for kind in 0..5 {
            let of = |floors: &[PeaksOf], at: usize| {
                let floor = floors[at];
                [
                    floor.displacement().size(),
                    floor.storey_drift(),
                    floor.total_acceleration(),
                    floor.storey_shear(),
                    floor.overturning_moment(),
                ][kind]
            };
            let scale = most(&|at| of(&other, at), other.len());
            let off = most(
                &|at| (of(&building, at) - of(&other, at)).abs(),
                other.len(),
            );
            pairs.push((["u", "drift", "a", "shear", "moment"][kind], off / scale));
        }
    }
    for kind in [Kind::Force, Kind::Stroke] {
        let of = |run: &Outcome| {
            let is_link =
                |column: Column| matches!(column.owner, Owner::Link(_)) && column.kind == kind;
            run.peaks.sizes(is_link)
        };
        for (one, other) in of(&found).into_iter().zip(of(&fine)) {
            pairs.push(("link", (one / other - 1.0).abs()));
        }
    }
    // Impacts that end together may come in either order.
    let touches = |outcome: &Outcome| {
        let impacts = outcome.impacts.iter();
        let mut touches: Vec<(usize, f64)> = impacts.map(|i| (i.contact, i.start)).collect();
        touches.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        touches
    };
    for (touch, other) in touches(&found).iter().zip(touches(&fine)) {
        assert_eq!(touch.0, other.0);
        pairs.push(("touch", (touch.1 - other.1).abs()));
    }
    for (what, off) in &pairs {
        assert!(*off < expected_within, "{what}: {off:e}, {pairs:?}");
    }
    assert!(found.energy.worst_imbalance < 1e-9);
    let taken = found.energy.links / fine.energy.links - 1.0;
    assert!(taken.abs() < expected_within, "links: {taken:e}");
    found
}

/// Frames and towers with dampers that meet under laws of every family.
#[test]
fn linked_buildings_that_meet_agree_with_riccati() {
    let motion = shaking(2.0);
    for kind in [LawKind::HertzDamp, LawKind::Kelvin, LawKind::Restitution] {
        let mut model = two_frames(0.02, law(kind, 0.6));
        model.links = vec![link([Some(0), Some(1)], &[(2, 2), (3, 3)], [2e6, 5e5])];
        let outcome = compare(&model, &motion, 1e-3, 1e-3);
        assert!(!outcome.impacts.is_empty(), "{kind:?}");
    }
}

/// A tower of a row is linked to a wall, the others to each other, and one stands alone.
#[test]
fn links_to_walls_and_across_a_row_agree_with_riccati() {
    let towers = [(3, 3e4, 0.4), (5, 4e4, 0.8), (2, 5e4, 0.3), (4, 4e4, 0.6)];
    let towers = towers.map(|(storeys, mass, period)| tower("x", storeys, mass, period));
    let named = towers
        .into_iter()
        .enumerate()
        .map(|(index, tower)| Building {
            name: format!("tower {index}"),
            ..tower
        });
    let mut model = row(named.collect(), 0.02, law(LawKind::HertzDamp, 0.7));
    model.links = vec![
        link([Some(0), Some(1)], &[(3, 3)], [0.0, 4e5]),
        link([Some(1), Some(2)], &[(1, 1), (2, 2)], [5e6, 1e5]),
    ];
    let mut walled = link([None, Some(0)], &[], [1e7, 2e5]);
    walled.floors = FloorPairs::Listed(vec![[jostle::Level::Wall, jostle::Level::Floor(2)]]);
    model.links.push(walled);
    let outcome = compare(&model, &shaking(3.0), 1e-3, 1e-3);
    assert!(outcome.impacts.len() > 3, "{}", outcome.impacts.len());
    assert!(
        outcome
            .peaks
            .sizes(|own| own.kind == Kind::Work)
            .iter()
            .all(|work| *work > 0.0)
    );
}

/// A link so stiff that modes would take tiny steps is left to Riccati's recursion, unless modes are asked for.
#[test]
fn very_stiff_links_are_for_direct_steps() {
    let mut model = two_frames(9.0, law(LawKind::HertzDamp, 0.6));
    let chosen = |model: &Model| {
        let system = assembled(model);
        let plan = Plan::choose(&system, &shaking(1.0), &model.analysis);
        plan.expect("a plan").solver
    };
    model.links = vec![link([Some(0), Some(1)], &[(3, 3)], [1e8, 0.0])];
    assert_eq!(chosen(&model), Solver::Modal);
    model.links[0].stiffness = 1e14;
    assert_eq!(chosen(&model), Solver::Riccati);
    model.analysis.solver = Some(Solver::Modal);
    assert_eq!(chosen(&model), Solver::Modal);
}
