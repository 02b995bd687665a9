//! Frames and storeys that yield: one Newton iteration on everything at once, with full matrices and over the same
//! instants, must find what the condensed scheme finds; no run may fail; energy must balance.

use faer::Mat;
use faer::linalg::solvers::Solve;
use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisMemory, HysteresisRule};
use jostle::{
    Base, Building, Column, Damping, FrameHinges, Gravity, GroundMotion, Hinges, LawKind, Model,
    Outcome, Plan, RunEnd, Solver, Structure, System, simulate,
};

use crate::support::{
    EVERYTHING, Random, assembled, column, difference, frame, framed, largest, law, random_frame,
    row, run, shaking, steps, tower,
};

fn rule(number: usize) -> HysteresisRule {
    match number % 4 {
        0 => HysteresisRule::Takeda { exponent: 0.4 },
        1 => HysteresisRule::PeakOriented,
        2 => HysteresisRule::Normal,
        _ => HysteresisRule::DegradingTrilinear,
    }
}

/// A hinge of initial stiffness \[N·m/rad\] and moment of yield \[N·m\].
fn hinge(rule: HysteresisRule, initial: f64, moment: f64) -> Hysteresis {
    let corners = Corners {
        cracking: 0.35 * moment,
        yielding: moment,
        post_cracking: 0.3,
        post_yield: 0.02,
    };
    let backbone = Backbone::from_forces(initial, corners, corners).expect("sound");
    Hysteresis::new(rule, backbone).expect("the rule fits")
}

/// The building with hinges at all member ends, or in all storeys, that yield under strong shaking.
fn yielding(mut building: Building, rule: HysteresisRule, strength: f64) -> Building {
    building.hinges = Some(match &building.structure {
        Structure::Frame(frame) => {
            let storeys = frame.storey_heights.len();
            let row = |section: &jostle::Section, length: f64, count: usize, moment: f64| {
                let initial = 20.0 * section.flexural_rigidity / length;
                vec![hinge(rule, initial, strength * moment); count]
            };
            let lines = frame.spans.len() + 1;
            Hinges::Frame(FrameHinges {
                columns: (0..storeys)
                    .map(|k| row(&frame.columns[k], frame.storey_heights[k], lines, 3e5))
                    .collect(),
                beams: (0..storeys)
                    .map(|k| row(&frame.beams[k], frame.spans[0], lines - 1, 2e5))
                    .collect(),
            })
        }
        Structure::Shear(shear) => Hinges::Storeys(
            shear
                .stiffness
                .iter()
                .map(|stiffness| hinge(rule, *stiffness, strength * 0.004 * stiffness))
                .collect(),
        ),
    });
    building
}

/// Deformation of a spring, from the committed one itself, so that standing still is exactly that.
fn reached(dofs: [Option<usize>; 2], memory: &HysteresisMemory, next: &[f64], now: &[f64]) -> f64 {
    let change = |dof: Option<usize>| dof.map_or(0.0, |dof| next[dof] - now[dof]);
    memory.deformation() + (change(dofs[0]) - change(dofs[1]))
}

/// Peak force of every contact and displacements at the end, by Newton's method on all displacements of all
/// buildings, over given instants.
fn monolith(system: &System, motion: &GroundMotion, times: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let n = system.len();
    let (mut mass, mut driven) = (vec![0.0; n], vec![0.0; n]);
    let (mut stiffness, mut damping) = (Mat::<f64>::zeros(n, n), Mat::<f64>::zeros(n, n));
    let mut springs = Vec::new();
    for building in &system.buildings {
        let (equations, offset) = (&building.equations, building.offset);
        let own = offset..offset + equations.len();
        mass[own.clone()].copy_from_slice(&equations.mass);
        driven[own].copy_from_slice(&equations.driven_mass);
        for dof in 0..equations.len() {
            damping[(offset + dof, offset + dof)] += equations.alpha * equations.mass[dof];
        }
        // What of every matrix stiffens, and what damps.
        for (matrix, stiffens, damps) in [
            (&equations.stiffness, 1.0, equations.beta),
            (&equations.undamped, 1.0, 0.0),
            (&equations.dashpots, 0.0, 1.0),
        ] {
            let mut add = |row: usize, column: usize, value: f64| {
                stiffness[(offset + row, offset + column)] += stiffens * value;
                damping[(offset + row, offset + column)] += damps * value;
            };
            for column in 0..equations.len() {
                add(column, column, matrix.diagonal[column]);
                for entry in matrix.starts[column]..matrix.starts[column + 1] {
                    let row = matrix.rows[entry] as usize;
                    add(row, column, matrix.values[entry]);
                    add(column, row, matrix.values[entry]);
                }
            }
        }
        springs.extend(equations.springs.iter().map(|spring| {
            (
                spring.dofs.map(|dof| dof.map(|dof| dof + offset)),
                spring.hysteresis,
            )
        }));
    }
    let state = jostle::State::at_rest(system, motion.acceleration(0.0));
    let (mut u, mut v, mut a) = (state.displacement, state.velocity, state.acceleration);
    let mut memories = vec![HysteresisMemory::default(); springs.len()];
    let mut speeds: Vec<Option<f64>> = vec![None; system.contacts.len()];
    let mut peaks = vec![0.0_f64; system.contacts.len()];
    for pair in times.windows(2) {
        let h = pair[1] - pair[0];
        for (contact, speed) in system.contacts.iter().zip(&mut speeds) {
            let [left, right] = contact.dofs;
            let (indentation, rate) = (u[left] - u[right] - contact.width, v[left] - v[right]);
            if speed.is_none() && indentation >= -1e-11 && rate > 0.0 {
                *speed = Some(rate);
            } else if speed.is_some() && indentation <= 0.0 && rate <= 0.0 {
                *speed = None;
            }
        }
        let ground = motion.acceleration(pair[1]);
        let mut next = u.clone();
        let mut forces = vec![0.0; system.contacts.len()];
        // What is left over at trial displacements, with its tangent where wanted.
        let left_over = |next: &[f64], tangent: &mut Option<Mat<f64>>, forces: &mut [f64]| {
            let velocity: Vec<f64> = (0..n).map(|i| 2.0 / h * (next[i] - u[i]) - v[i]).collect();
            let acceleration: Vec<f64> = (0..n)
                .map(|i| 4.0 / (h * h) * (next[i] - u[i]) - 4.0 / h * v[i] - a[i])
                .collect();
            let column = |values: &[f64]| Mat::from_fn(n, 1, |i, _| values[i]);
            let resisted = &stiffness * column(next) + &damping * column(&velocity);
            let mut residual: Vec<f64> = (0..n)
                .map(|i| -driven[i] * ground - mass[i] * acceleration[i] - resisted[(i, 0)])
                .collect();
            if let Some(tangent) = tangent {
                *tangent = Mat::from_fn(n, n, |i, j| {
                    let inertia = if i == j { 4.0 / (h * h) * mass[i] } else { 0.0 };
                    stiffness[(i, j)] + 2.0 / h * damping[(i, j)] + inertia
                });
            }
            for ((dofs, hysteresis), memory) in springs.iter().zip(&memories) {
                let response = hysteresis.respond(memory, reached(*dofs, memory, next, &u));
                for (i, sign) in dofs.iter().zip([1.0, -1.0]) {
                    let Some(i) = *i else { continue };
                    residual[i] -= sign * response.force;
                    for (j, other) in dofs.iter().zip([1.0, -1.0]) {
                        if let (Some(j), Some(tangent)) = (*j, tangent.as_mut()) {
                            tangent[(i, j)] += sign * other * response.tangent;
                        }
                    }
                }
            }
            for (k, contact) in system.contacts.iter().enumerate() {
                let Some(speed) = speeds[k] else { continue };
                let [left, right] = contact.dofs;
                let rate = velocity[left] - velocity[right];
                let indentation = next[left] - next[right] - contact.width;
                let response = contact.law.respond(indentation, rate, speed);
                forces[k] = response.force;
                residual[left] -= response.force;
                residual[right] += response.force;
                let slope = response.by_indentation + 2.0 / h * response.by_rate;
                if let Some(tangent) = tangent {
                    for (i, j, sign) in [
                        (left, left, 1.0),
                        (right, right, 1.0),
                        (left, right, -1.0),
                        (right, left, -1.0),
                    ] {
                        tangent[(i, j)] += sign * slope;
                    }
                }
            }
            residual
        };
        let mut previous = f64::INFINITY;
        for round in 0..200 {
            let mut tangent = Some(Mat::zeros(0, 0));
            let residual = left_over(&next, &mut tangent, &mut forces);
            let right = Mat::from_fn(n, 1, |i, _| residual[i]);
            let update = tangent.expect("wanted").partial_piv_lu().solve(&right);
            let moved = |share: f64| -> Vec<f64> {
                (0..n).map(|i| next[i] + share * update[(i, 0)]).collect()
            };
            let size = (0..n).fold(0.0_f64, |most, i| most.max(update[(i, 0)].abs()));
            let small = size <= 1e-14 * largest(&next)
                || (size <= 1e-11 * largest(&next) && size >= previous);
            previous = size;
            // Where the way overshoots, back to where the forces along it vanish.
            let along = |share: f64| -> f64 {
                let mut unused = forces.clone();
                let residual = left_over(&moved(share), &mut None, &mut unused);
                (0..n).map(|i| update[(i, 0)] * residual[i]).sum()
            };
            let (mut low, mut high) = (0.0, 1.0);
            if !small && round > 4 && along(1.0) < 0.0 {
                for _ in 0..20 {
                    let middle = 0.5 * (low + high);
                    if along(middle) < 0.0 {
                        high = middle;
                    } else {
                        low = middle;
                    }
                }
            }
            next = moved(high);
            if small {
                break;
            }
            assert!(
                round < 199,
                "the monolith does not converge at {} s: {size:e}",
                pair[0]
            );
        }
        for i in 0..n {
            let (v0, a0) = (v[i], a[i]);
            v[i] = 2.0 / h * (next[i] - u[i]) - v0;
            a[i] = 4.0 / (h * h) * (next[i] - u[i]) - 4.0 / h * v0 - a0;
        }
        for ((dofs, hysteresis), memory) in springs.iter().zip(&mut memories) {
            *memory = hysteresis
                .respond(memory, reached(*dofs, memory, &next, &u))
                .memory;
        }
        u = next;
        for (peak, force) in peaks.iter_mut().zip(&forces) {
            *peak = peak.max(*force);
        }
    }
    (peaks, u)
}

fn two_yielding_frames(first: usize, second: usize) -> Model {
    let mut left = yielding(framed("left", frame(3, &[4.0, 6.0])), rule(first), 0.5);
    let mut right = yielding(framed("right", frame(5, &[5.0])), rule(second), 0.4);
    for building in [&mut left, &mut right] {
        building.damping = Damping::Rayleigh {
            alpha: 0.3,
            beta: 2e-3,
        };
        building.gravity = Gravity {
            preload: false,
            p_delta: true,
        };
    }
    row(vec![left, right], 0.01, law(LawKind::HertzDamp, 0.65))
}

fn yielded(outcome: &Outcome, system: &System) -> usize {
    let springs = system.buildings.iter().flat_map(|b| &b.equations.springs);
    springs
        .zip(&outcome.state.springs)
        .filter(|(spring, memory)| {
            spring.hysteresis.stage(memory) == jostle::hysteresis::Stage::Yielded
        })
        .count()
}

#[test]
fn condensed_equals_monolithic() {
    for model in [
        two_yielding_frames(0, 1),
        two_yielding_frames(2, 3),
        on_yielding_footings(),
    ] {
        let system = assembled(&model);
        let motion = shaking(1.6);
        let outcome = run(&system, &motion, &steps(2e-3, 2));
        let times = column(&outcome, Column::Time);
        assert!(outcome.impacts.len() > 2 && yielded(&outcome, &system) > 10);
        let (peaks, displacement) = monolith(&system, &motion, &times);
        let got: Vec<f64> = (0..system.contacts.len())
            .map(|contact| largest(&column(&outcome, Column::ContactForce { contact })))
            .collect();
        let (forces, displacements) = (
            difference(&got, &peaks),
            difference(&outcome.state.displacement, &displacement),
        );
        println!(
            "forces {forces:e}, displacements {displacements:e}, {:.2} iterations a step, {:e} out of balance",
            outcome.work.outer_iterations as f64 / outcome.work.steps as f64,
            outcome.energy.worst_imbalance
        );
        assert!(
            forces <= 1e-10 && displacements <= 1e-10,
            "{forces:e} and {displacements:e}"
        );
        assert!(
            outcome.energy.worst_imbalance < 1e-9,
            "{:e}",
            outcome.energy.worst_imbalance
        );
    }
}

/// The two frames on footings that rock and slide.
fn on_yielding_footings() -> Model {
    let mut model = two_yielding_frames(1, 2);
    for building in &mut model.buildings {
        building.base = Base {
            rotational_stiffness: Some(3e8),
            rotational_hinge: Some(hinge(rule(2), 3e8, 1.5e5)),
            horizontal_stiffness: Some(4e8),
            horizontal_hinge: Some(hinge(rule(1), 4e8, 1.2e5)),
            rotational_damping: 1e6,
            horizontal_damping: 2e6,
            mass: 4e3,
            ..Base::default()
        };
    }
    model
}

#[test]
fn a_yielding_base_is_a_yielding_storey() {
    let spring = |rule, stiffness, force| hinge(rule, stiffness, force);
    let elastic = |stiffness| spring(HysteresisRule::Elastic, stiffness, 1e9);
    let upper = jostle::Shear {
        mass: vec![5e4; 3],
        stiffness: vec![6e7; 3],
        storey_heights: vec![3.0; 3],
    };
    let lower = spring(rule(1), 9e7, 1e5);
    let damping = Damping::Rayleigh {
        alpha: 0.2,
        beta: 0.0,
    };
    let mut on_base = framed("base", frame(1, &[4.0]));
    on_base.structure = Structure::Shear(upper.clone());
    on_base.damping = damping.clone();
    on_base.base = Base {
        horizontal_stiffness: Some(9e7),
        horizontal_hinge: Some(lower),
        mass: 3e4,
        ..Base::default()
    };
    let mut taller = on_base.clone();
    taller.base = Base::default();
    taller.structure = Structure::Shear(jostle::Shear {
        mass: [&[3e4], &upper.mass[..]].concat(),
        stiffness: [&[9e7], &upper.stiffness[..]].concat(),
        storey_heights: vec![3.0; 4],
    });
    taller.hinges = Some(Hinges::Storeys(vec![
        lower,
        elastic(6e7),
        elastic(6e7),
        elastic(6e7),
    ]));
    let motion = shaking(4.0);
    let [a, b] = [on_base, taller].map(|building| {
        let system = assembled(&row(vec![building], 0.0, law(LawKind::Hertz, 1.0)));
        run(&system, &motion, &steps(2e-3, 1))
    });
    assert!(a.energy.hysteretic > 1e3);
    let apart = difference(&a.state.displacement, &b.state.displacement);
    assert!(apart < 1e-10, "{apart:e}");
}

#[test]
fn riccati_equals_direct_stiffness_while_hinges_yield() {
    let system = assembled(&two_yielding_frames(1, 2));
    let motion = shaking(3.0);
    let plan = steps(2e-3, 2);
    let direct = Plan {
        solver: Solver::Stiffness,
        ..plan
    };
    let (a, b) = (run(&system, &motion, &plan), run(&system, &motion, &direct));
    assert_eq!(a.impacts.len(), b.impacts.len());
    assert_eq!(a.spring_events, b.spring_events);
    let apart = difference(&a.state.displacement, &b.state.displacement);
    assert!(apart < 1e-8, "{apart:e}");
}

#[test]
fn random_frames_never_fail() {
    let mut random = Random(2024);
    let (mut iterations, mut taken, mut yields) = (0, 0, 0);
    // JOSTLE_CASES=100 takes a minute.
    let cases = std::env::var("JOSTLE_CASES").map_or(20, |count| count.parse().expect("a number"));
    for case in 0..cases {
        let building = |random: &mut Random, name: &str| {
            let plain = if random.whole(0, 3) == 0 {
                tower(
                    name,
                    random.whole(1, 6),
                    random.between(2e4, 3e5),
                    random.between(0.2, 1.5),
                )
            } else {
                let mut frame = random_frame(random);
                frame.column_segments = frame.column_segments.min(2);
                frame.storey_heights.fill(3.2);
                framed(name, frame)
            };
            yielding(plain, rule(random.whole(0, 3)), random.between(0.2, 1.5))
        };
        let pair = vec![building(&mut random, "a"), building(&mut random, "b")];
        let mut model = row(
            pair,
            random.between(0.0, 0.05),
            law(LawKind::HertzDamp, 0.65),
        );
        for building in &mut model.buildings {
            building.damping = Damping::Ratio {
                ratio: 0.05,
                modes: Vec::new(),
            };
        }
        let system = assembled(&model);
        let mut motion = shaking(6.0);
        motion.scale = random.between(0.2, 10.0) / motion.peak();
        let plan = Plan::choose(&system, &motion, &model.analysis).expect("a plan");
        let outcome = simulate(&system, &motion, &plan, EVERYTHING, |_| {
            std::ops::ControlFlow::Continue(())
        });
        let collapsed = matches!(
            outcome.end,
            RunEnd::Failed(jostle::StepError::Collapse { .. })
        );
        assert!(
            outcome.end == RunEnd::Completed || collapsed,
            "case {case}: {:?}",
            outcome.end
        );
        assert_eq!(outcome.work.halved_steps, 0, "case {case}");
        assert!(
            outcome.energy.worst_imbalance < 1e-8,
            "case {case}: {:e}",
            outcome.energy.worst_imbalance
        );
        iterations += outcome.work.outer_iterations;
        taken += outcome.work.steps + outcome.work.repeated_steps;
        yields += usize::from(yielded(&outcome, &system) > 0);
    }
    println!(
        "{:.3} iterations a step, {yields} pairs yield",
        iterations as f64 / taken as f64
    );
    assert!(yields > 10);
}

#[test]
fn mirrored_frames_yield_mirrored() {
    let model = two_yielding_frames(0, 1);
    let mut mirrored = model.clone();
    mirrored.buildings.reverse();
    for building in &mut mirrored.buildings {
        if let Structure::Frame(frame) = &mut building.structure {
            frame.spans.reverse();
            frame.beam_segments.reverse();
        }
    }
    let mut motion = shaking(3.0);
    let plan = steps(2e-3, 2);
    let a = run(&assembled(&model), &motion, &plan);
    motion.scale = -motion.scale;
    let b = run(&assembled(&mirrored), &motion, &plan);
    assert_eq!(a.impacts.len(), b.impacts.len());
    let forces = |outcome: &Outcome| -> Vec<f64> {
        outcome
            .impacts
            .iter()
            .map(|impact| impact.peak_force)
            .collect()
    };
    let apart = difference(&forces(&a), &forces(&b));
    assert!(apart < 1e-7, "{apart:e}");
}

#[test]
fn steps_of_a_yielding_tower_are_of_second_order() {
    let building = yielding(tower("tower", 3, 2e5, 0.6), rule(0), 0.5);
    let system = assembled(&row(vec![building], 0.0, law(LawKind::Hertz, 1.0)));
    let motion = shaking(2.0);
    let path = |step: f64| -> Vec<f64> {
        let outcome = run(&system, &motion, &steps(step, 1));
        let roof = column(
            &outcome,
            Column::Displacement {
                building: 0,
                floor: 3,
            },
        );
        let every = (0.01 / step).round() as usize;
        roof.into_iter().step_by(every).collect()
    };
    let exact = path(2e-5);
    let errors = [5e-3, 2.5e-3, 1.25e-3, 6.25e-4].map(|step| difference(&path(step), &exact));
    let order = (errors[0] / errors[3]).log2() / 3.0;
    assert!(order > 1.6 && errors[3] < 1e-3, "order {order}: {errors:?}");
}

#[test]
fn hinges_that_never_crack_change_nothing() {
    // Rigid in comparison, and strong: the frame moves as if they were not there.
    let plain = framed("plain", frame(2, &[5.0]));
    let mut strong = yielding(plain.clone(), rule(2), 1e6);
    if let Some(Hinges::Frame(hinges)) = &mut strong.hinges {
        for row in hinges.columns.iter_mut().chain(&mut hinges.beams) {
            row.fill(hinge(rule(2), 1e15, 1e12));
        }
    }
    let motion = shaking(2.0);
    let [a, b] = [plain, strong].map(|building| {
        let mut model = row(vec![building], 0.0, law(LawKind::Hertz, 1.0));
        model.buildings[0].damping = Damping::Rayleigh {
            alpha: 0.2,
            beta: 1e-3,
        };
        let outcome = run(&assembled(&model), &motion, &steps(2e-3, 1));
        assert!(outcome.energy.hysteretic.abs() < 1e-3);
        column(
            &outcome,
            Column::Displacement {
                building: 0,
                floor: 2,
            },
        )
    });
    assert!(difference(&a, &b) < 1e-5, "{:e}", difference(&a, &b));
}

#[test]
fn collapse_is_told_with_time_and_place() {
    let mut building = yielding(tower("weak", 2, 3e5, 1.2), rule(1), 0.05);
    building.gravity.p_delta = true;
    let system = assembled(&row(vec![building], 0.0, law(LawKind::Hertz, 1.0)));
    let mut motion = shaking(40.0);
    motion.scale = 4.0;
    let outcome = simulate(&system, &motion, &steps(2e-3, 1), EVERYTHING, |_| {
        std::ops::ControlFlow::Continue(())
    });
    let RunEnd::Failed(error) = outcome.end else {
        panic!("it should collapse")
    };
    let text = error.to_string();
    assert!(text.contains("\"weak\" collapses at t = "), "{text}");
    assert!(outcome.state.time > 0.5 && outcome.state.time < 40.0);
    assert!(outcome.history.is_some_and(|history| history.len() > 100));
}
