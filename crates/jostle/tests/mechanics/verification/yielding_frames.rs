//! Frames and storeys that yield: one Newton iteration on everything at once, with full matrices and over the same
//! instants, must find what the condensed scheme finds; no run may fail; energy must balance.

use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule, Pinching};
use jostle::{
    Analysis, Base, Building, Column, Damping, FrameHinges, Gravity, Hinges, LawKind, Model,
    Outcome, Plan, RunEnd, Solver, Structure, System, simulate,
};
use jostle_testkit::models::equal_storeys;

use crate::verification::monolith::monolith;
use crate::verification::support::{
    EVERYTHING, Random, assembled, column, difference, frame, framed, largest, law, random_frame,
    row, run, shaking, steps, tower,
};

fn rule(number: usize) -> HysteresisRule {
    match number % 5 {
        0 => HysteresisRule::Takeda { exponent: 0.4 },
        1 => HysteresisRule::PeakOriented,
        2 => HysteresisRule::Normal,
        3 => HysteresisRule::DegradingTrilinear,
        _ => PINCHED,
    }
}

const PINCHED: HysteresisRule = HysteresisRule::Pinched(Pinching {
    unloading_exponent: 0.3,
    ..Pinching::USUAL
});

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
                ..FrameHinges::default()
            })
        }
        Structure::Shear(shear) => Hinges::Storeys(
            shear
                .stiffness
                .iter()
                .map(|stiffness| hinge(rule, *stiffness, strength * 0.004 * stiffness))
                .collect(),
        ),
        Structure::Given(_) | Structure::Tiers(_) => panic!("they do not yield"),
    });
    building
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
        let times = column(&outcome, Column::TIME);
        assert!(outcome.impacts.len() > 2 && yielded(&outcome, &system) > 10);
        let (peaks, displacement) = monolith(&system, &motion, &times);
        let got: Vec<f64> = (0..system.contacts.len())
            .map(|contact| largest(&column(&outcome, Column::contact_force(contact))))
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
    let upper = equal_storeys(3, [5e4, 6e7]);
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
    // A hundred in ./check-all.
    let cases = std::env::var("JOSTLE_CASES").map_or(12, |count| count.parse().expect("a number"));
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
            building.damping = Damping::ratio(0.05, []);
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
    for rule in [rule(0), PINCHED] {
        second_order(rule);
    }
}

fn second_order(rule: HysteresisRule) {
    let building = yielding(tower("tower", 3, 2e5, 0.6), rule, 0.5);
    let system = assembled(&row(vec![building], 0.0, law(LawKind::Hertz, 1.0)));
    let motion = shaking(2.0);
    let path = |step: f64| -> Vec<f64> {
        let outcome = run(&system, &motion, &steps(step, 1));
        let roof = column(&outcome, Column::displacement(0, 3));
        let every = (0.01 / step).round() as usize;
        roof.into_iter().step_by(every).collect()
    };
    let exact = path(2e-5);
    let errors = [5e-3, 2.5e-3, 1.25e-3, 6.25e-4].map(|step| difference(&path(step), &exact));
    let order = (errors[0] / errors[3]).log2() / 3.0;
    assert!(
        order > 1.6 && errors[3] < 1e-3,
        "{}: order {order}: {errors:?}",
        rule.name()
    );
}

/// Two pinched shear buildings that pound: the automatic steps of tolerance 10⁻³ hold it against those of 10⁻⁶.
#[test]
fn pinched_storeys_hold_the_tolerance() {
    let pair = [("stiff", 2, 1e5, 0.35), ("soft", 3, 6e4, 0.8)];
    let pair = pair.map(|(name, storeys, mass, period)| {
        yielding(tower(name, storeys, mass, period), PINCHED, 0.5)
    });
    let system = assembled(&row(pair.to_vec(), 0.01, law(LawKind::HertzDamp, 0.6)));
    let motion = shaking(4.0);
    let at = |tolerance: f64| {
        let analysis = Analysis {
            tolerance,
            ..Analysis::default()
        };
        let plan = Plan::choose(&system, &motion, &analysis).expect("steps are found");
        run(&system, &motion, &plan)
    };
    let [usual, fine] = [at(1e-3), at(1e-6)];
    assert_eq!(usual.end, RunEnd::Completed);
    assert!(!fine.impacts.is_empty() && yielded(&fine, &system) > 0);
    assert_eq!(usual.impacts.len(), fine.impacts.len());
    for (building, (found, exact)) in usual
        .peaks
        .buildings()
        .zip(fine.peaks.buildings())
        .enumerate()
    {
        let greatest = exact
            .iter()
            .map(|f| f.total_acceleration())
            .fold(0.0, f64::max);
        for (found, exact) in found.iter().zip(exact) {
            let error = (found.total_acceleration() - exact.total_acceleration()).abs() / greatest;
            println!("building {building}: {error:e}");
            assert!(error <= 1e-3, "{found:?} for {exact:?}");
        }
    }
    println!(
        "{} impacts, {} against {} steps",
        fine.impacts.len(),
        usual.work.steps,
        fine.work.steps
    );
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
        column(&outcome, Column::displacement(0, 2))
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
