//! The buildings are put together once more, with full matrices and all contact forces in one Newton iteration,
//! and stepped over the same instants.

use jostle::contact::ForceLaw;
use jostle::{Column, GroundMotion, LawKind, Model, Outcome, Plan, Solver, Structure};

use crate::verification::support::{
    assembled, column, difference, largest, law, row, run, shaking, steps, tower,
};

type Matrix = Vec<Vec<f64>>;

/// Shear buildings as one dense system.
struct Monolith {
    mass: Vec<f64>,
    stiffness: Matrix,
    damping: Matrix,
    /// Left and right degree of freedom, gap and law.
    contacts: Vec<(usize, usize, f64, ForceLaw)>,
}

fn monolith(model: &Model) -> Monolith {
    let system = assembled(model);
    let shears: Vec<_> = model
        .buildings
        .iter()
        .map(|building| match &building.structure {
            Structure::Shear(shear) => shear,
            _ => panic!("shear buildings only"),
        })
        .collect();
    let n = shears.iter().map(|shear| shear.mass.len()).sum();
    let mut monolith = Monolith {
        mass: Vec::new(),
        stiffness: vec![vec![0.0; n]; n],
        damping: vec![vec![0.0; n]; n],
        contacts: Vec::new(),
    };
    let mut starts = Vec::new();
    for (shear, building) in shears.iter().zip(&system.buildings) {
        let start = monolith.mass.len();
        starts.push(start);
        monolith.mass.extend(&shear.mass);
        for (storey, k) in shear.stiffness.iter().enumerate() {
            let (above, below) = (start + storey, storey.checked_sub(1).map(|s| start + s));
            monolith.stiffness[above][above] += k;
            if let Some(below) = below {
                monolith.stiffness[below][below] += k;
                monolith.stiffness[below][above] -= k;
                monolith.stiffness[above][below] -= k;
            }
        }
        let end = monolith.mass.len();
        for i in start..end {
            for j in start..end {
                monolith.damping[i][j] = building.equations.beta * monolith.stiffness[i][j];
            }
            monolith.damping[i][i] += building.equations.alpha * monolith.mass[i];
        }
    }
    for contact in &system.contacts {
        let dof = |side: usize| {
            let face = contact.ports.0[side].as_ref().expect("no wall");
            starts[face.building] + face.floor.expect("floors meet") - 1
        };
        monolith
            .contacts
            .push((dof(0), dof(1), contact.width, contact.law));
    }
    monolith
}

fn product(a: &Matrix, x: &[f64]) -> Vec<f64> {
    a.iter()
        .map(|row| row.iter().zip(x).map(|(a, x)| a * x).sum())
        .collect()
}

/// Gauss with row exchange.
fn solved(mut a: Matrix, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let best = (k..n)
            .max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()))
            .expect("not empty");
        a.swap(k, best);
        b.swap(k, best);
        for i in k + 1..n {
            let factor = a[i][k] / a[k][k];
            for j in k..n {
                a[i][j] -= factor * a[k][j];
            }
            b[i] -= factor * b[k];
        }
    }
    for k in (0..n).rev() {
        b[k] = (b[k] - (k + 1..n).map(|j| a[k][j] * b[j]).sum::<f64>()) / a[k][k];
    }
    b
}

/// Peak force of every contact, displacements at the end, and how many steps had contacts of both gaps closed.
fn stepped(
    monolith: &Monolith,
    motion: &GroundMotion,
    times: &[f64],
    middle: usize,
) -> (Vec<f64>, Vec<f64>, usize) {
    let n = monolith.mass.len();
    let ground = motion.acceleration(0.0);
    let (mut u, mut v, mut a) = (vec![0.0; n], vec![0.0; n], vec![-ground; n]);
    let mut speeds: Vec<Option<f64>> = vec![None; monolith.contacts.len()];
    let mut peaks = vec![0.0_f64; monolith.contacts.len()];
    let mut on_both_sides = 0;
    for pair in times.windows(2) {
        let h = pair[1] - pair[0];
        for ((left, right, gap, _), speed) in monolith.contacts.iter().zip(&mut speeds) {
            let (indentation, rate) = (u[*left] - u[*right] - gap, v[*left] - v[*right]);
            if speed.is_none() && indentation >= -1e-11 && rate > 0.0 {
                *speed = Some(rate);
            } else if speed.is_some() && indentation <= 0.0 && rate <= 0.0 {
                *speed = None;
            }
        }
        let ground = motion.acceleration(pair[1]);
        let mut next = u.clone();
        let mut forces = vec![0.0; monolith.contacts.len()];
        for _ in 0..50 {
            let rise: Vec<f64> = next.iter().zip(&u).map(|(x, u)| x - u).collect();
            let velocity: Vec<f64> = (0..n).map(|i| 2.0 / h * rise[i] - v[i]).collect();
            let acceleration: Vec<f64> = (0..n)
                .map(|i| 4.0 / (h * h) * rise[i] - 4.0 / h * v[i] - a[i])
                .collect();
            let elastic = product(&monolith.stiffness, &next);
            let viscous = product(&monolith.damping, &velocity);
            let mut residual: Vec<f64> = (0..n)
                .map(|i| -monolith.mass[i] * (ground + acceleration[i]) - elastic[i] - viscous[i])
                .collect();
            let mut tangent = monolith.stiffness.clone();
            for i in 0..n {
                for j in 0..n {
                    tangent[i][j] += 2.0 / h * monolith.damping[i][j];
                }
                tangent[i][i] += 4.0 / (h * h) * monolith.mass[i];
            }
            for (k, (left, right, gap, law)) in monolith.contacts.iter().enumerate() {
                let Some(speed) = speeds[k] else { continue };
                let rate = velocity[*left] - velocity[*right];
                let response = law.respond(next[*left] - next[*right] - gap, rate, speed);
                forces[k] = response.force;
                residual[*left] -= response.force;
                residual[*right] += response.force;
                let slope = response.by_indentation + 2.0 / h * response.by_rate;
                tangent[*left][*left] += slope;
                tangent[*right][*right] += slope;
                tangent[*left][*right] -= slope;
                tangent[*right][*left] -= slope;
            }
            let update = solved(tangent, residual);
            next.iter_mut().zip(&update).for_each(|(x, d)| *x += d);
            if largest(&update) <= 1e-15 * largest(&next) {
                break;
            }
        }
        let rise: Vec<f64> = next.iter().zip(&u).map(|(x, u)| x - u).collect();
        for i in 0..n {
            let (v0, a0) = (v[i], a[i]);
            v[i] = 2.0 / h * rise[i] - v0;
            a[i] = 4.0 / (h * h) * rise[i] - 4.0 / h * v0 - a0;
        }
        u = next;
        for (peak, force) in peaks.iter_mut().zip(&forces) {
            *peak = peak.max(*force);
        }
        let pushes = |gap: &dyn Fn(usize) -> bool| {
            forces
                .iter()
                .enumerate()
                .any(|(k, force)| gap(k) && *force > 0.0)
        };
        on_both_sides += usize::from(pushes(&|k| k < middle) && pushes(&|k| k >= middle));
    }
    (peaks, u, on_both_sides)
}

fn model() -> Model {
    let mut model = row(
        vec![
            tower("left", 3, 3e4, 0.6),
            tower("middle", 3, 2e4, 0.45),
            tower("right", 3, 4e4, 0.3),
        ],
        0.002,
        law(LawKind::HertzDamp, 0.65),
    );
    model.gaps[1].set_width(0.001);
    model
}

/// Greatest recorded force of every contact.
fn recorded_peaks(outcome: &Outcome, contacts: usize) -> Vec<f64> {
    (0..contacts)
        .map(|contact| largest(&column(outcome, Column::contact_force(contact))))
        .collect()
}

#[test]
fn a_row_of_three_buildings_equals_one_system_of_full_matrices() {
    for kind in [LawKind::Hertz, LawKind::HertzDamp, LawKind::Linear] {
        let mut model = model();
        model
            .gaps
            .iter_mut()
            .for_each(|gap| gap.law = law(kind, 0.65));
        let system = assembled(&model);
        let motion = shaking(1.5);
        let outcome = run(&system, &motion, &steps(1e-3, 4));
        let times = column(&outcome, Column::TIME);
        let (peaks, displacement, on_both_sides) = stepped(&monolith(&model), &motion, &times, 3);
        assert!(
            on_both_sides > 20,
            "{kind:?}: the middle one is pressed from both sides in {on_both_sides} steps"
        );
        let got = recorded_peaks(&outcome, system.contacts.len());
        let both_gaps = [&got[..3], &got[3..]].map(largest);
        assert!(
            both_gaps.iter().all(|force| *force > 1e5),
            "{kind:?}: impacts in both gaps, {got:?}"
        );
        assert!(
            difference(&got, &peaks) <= 1e-8,
            "{kind:?}: forces {got:?} against {peaks:?}"
        );
        let floors: Vec<f64> = system
            .buildings
            .iter()
            .flat_map(|building| {
                building
                    .floors
                    .iter()
                    .map(|floor| outcome.state.displacement[floor.dof])
            })
            .collect();
        let apart = difference(&floors, &displacement);
        assert!(apart <= 1e-8, "{kind:?}: displacements are {apart:e} apart");
    }
}

#[test]
fn a_row_of_three_buildings_does_not_depend_on_the_solver() {
    let system = assembled(&model());
    let motion = shaking(1.5);
    let plan = steps(1e-3, 4);
    let riccati = run(&system, &motion, &plan);
    let direct = Plan {
        solver: Solver::Stiffness,
        ..plan
    };
    let direct = run(&system, &motion, &direct);
    assert_eq!(
        riccati.impacts.len(),
        direct.impacts.len(),
        "as many impacts"
    );
    let (a, b) = [&riccati, &direct]
        .map(|outcome| recorded_peaks(outcome, system.contacts.len()))
        .into();
    assert!(difference(&a, &b) <= 1e-8, "{a:?} against {b:?}");
}
