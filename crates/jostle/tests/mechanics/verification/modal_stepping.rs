//! Modal stepping against closed forms, against Riccati's recursion at fine steps, and against its own refusals.

use std::ops::ControlFlow;

use jostle::contact::ForceLaw;
use jostle::stepping::simulate_from;
use jostle::{
    Analysis, Damping, GroundMotion, LawKind, Model, Outcome, Plan, RunEnd, Settings, Shear,
    Solver, State, Structure, System, simulate,
};

use crate::verification::support::{
    EVERYTHING, LAWS, Random, assembled, colliding_towers, frame, framed, law, random_frame, row,
    run, shaking, slider, sliders, steps, still, tower, two_frames,
};

fn modal(plan: &Plan) -> Plan {
    Plan {
        solver: Solver::Modal,
        ..*plan
    }
}

/// Automatic steps.
fn planned(system: &System, motion: &GroundMotion, solver: Solver, tolerance: f64) -> Plan {
    let analysis = Analysis {
        solver: Some(solver),
        tolerance,
        ..Analysis::default()
    };
    Plan::choose(system, motion, &analysis).expect("usable steps")
}

/// A ramp of ground acceleration a t makes u = −a/k (t − d/k) + … of a damped oscillator at rest, whatever the steps.
#[test]
fn a_ramp_is_answered_exactly() {
    let (mass, stiffness, rate) = (3e4, 2.5e6, 0.8);
    for ratio in [0.0, 0.05, 0.6] {
        let mut building = slider("oscillator", mass, Some(stiffness));
        let omega = f64::sqrt(stiffness / mass);
        building.structure.equations.alpha = 2.0 * ratio * omega;
        let system = System::of_buildings(vec![building]);
        let motion = GroundMotion::sampled("ramp", 1.0, vec![0.0, rate, 2.0 * rate, 3.0 * rate]);
        for step in [1.0, 0.1, 0.013] {
            let outcome = run(&system, &motion, &modal(&steps(step, 1)));
            let (t, k, d) = (3.0, omega * omega, 2.0 * ratio * omega);
            // −rate/k (t − d/k + e^(−dt/2) (d/k cos ω′t + (d²/2k − 1)/ω′ sin ω′t))
            let damped_frequency = f64::sqrt(k - 0.25 * d * d);
            let decay = (-0.5 * d * t).exp();
            let wave = d / k * (damped_frequency * t).cos()
                + (0.5 * d * d / k - 1.0) / damped_frequency * (damped_frequency * t).sin();
            let expected = -rate / k * (t - d / k + decay * wave);
            let got = outcome.state.displacement[0];
            assert!(
                (got / expected - 1.0).abs() < 1e-11,
                "ζ = {ratio}, h = {step}: {got} against {expected}"
            );
            assert!(
                outcome.energy.worst_imbalance < 1e-9,
                "{:?}",
                outcome.energy
            );
        }
    }
}

/// Two sliders on springs that meet: energies balance to rounding, whatever the law and however coarse its steps.
#[test]
fn contacts_keep_the_balance_of_energy() {
    for kind in LAWS {
        let system = sliders(
            vec![
                slider("left", 3e4, Some(2e6)),
                slider("right", 8e4, Some(3e7)),
            ],
            0.004,
            &law(kind, 0.6),
        );
        let lost = |division: u32| {
            let outcome = run(&system, &shaking(2.0), &modal(&steps(0.01, division)));
            assert!(outcome.impacts.len() > 1, "{kind:?} hits");
            assert!(
                outcome.energy.worst_imbalance < 1e-9,
                "{kind:?}: {:?}",
                outcome.energy
            );
            outcome.energy.contact / outcome.energy.input
        };
        let (coarse, fine) = (lost(8), lost(64));
        if kind.is_dissipative() {
            assert!(fine > 1e-3, "{kind:?} loses energy: {fine:e}");
        } else {
            // What an elastic law seems to keep or give is the error of its steps.
            assert!(
                coarse.abs() < 1e-5 && fine.abs() < 1e-7,
                "{kind:?} keeps energy: {coarse:e}, {fine:e}"
            );
        }
    }
}

/// Parabolas of the foreseen mean make impacts of fourth order, but for the step in which a force sets in: with its own
/// damping, or as the power 1½ of time.
#[test]
fn peak_force_of_an_impact_is_of_order_two_and_a_half_at_least() {
    for (kind, system) in colliding_towers() {
        let motion = shaking(1.0);
        let peak = |division: u32| {
            let plan = modal(&steps(0.01, division));
            run(&system, &motion, &plan).impacts[0].peak_force
        };
        let exact = peak(4096);
        let error = |n: u32| (peak(1 << n) / exact - 1.0).abs();
        // The phase of the touch scatters single errors.
        let errors = [2, 3, 5, 6].map(error);
        let order = (errors[0].max(errors[1]) / errors[2].max(errors[3])).log2() / 3.0;
        assert!(order >= 2.5, "{kind:?}: order {order}, errors {errors:?}");
    }
}

/// Floors that are hit are pushed hardest within a step: cubics between steps must know how the force changes.
#[test]
fn accelerations_of_struck_floors_agree_with_riccati() {
    for (kind, system) in colliding_towers() {
        let motion = shaking(1.0);
        let peaks = |plan: &Plan| {
            let outcome = run(&system, &motion, plan);
            let floors = outcome.peaks.buildings().flatten();
            floors.map(|f| f.total_acceleration()).collect::<Vec<_>>()
        };
        let fine = peaks(&planned(&system, &motion, Solver::Riccati, 1e-6));
        let got = peaks(&modal(&steps(0.01, 2)));
        for (got, wanted) in got.iter().zip(&fine) {
            let error = got / wanted - 1.0;
            assert!(
                error.abs() < 4e-6,
                "{kind:?}: {got} against {wanted} m/s², {error:e}"
            );
        }
    }
}

fn peak(outcome: &Outcome) -> f64 {
    let forces = outcome.impacts.iter().map(|impact| impact.peak_force);
    forces.fold(0.0, f64::max)
}

fn compare(what: &str, model: &Model, duration: f64) -> bool {
    const TOLERANCE: f64 = 1e-3;
    let system = assembled(model);
    let motion = shaking(duration);
    let fine = run(
        &system,
        &motion,
        &planned(&system, &motion, Solver::Riccati, 1e-5),
    );
    let got = run(
        &system,
        &motion,
        &planned(&system, &motion, Solver::Modal, TOLERANCE),
    );
    let (expected, force) = (peak(&fine), peak(&got));
    assert!(
        (force - expected).abs() <= TOLERANCE * expected,
        "{what}: greatest force {force} against {expected}"
    );
    for (building, (floors, wanted)) in got
        .peaks
        .buildings()
        .zip(fine.peaks.buildings())
        .enumerate()
    {
        let sways = wanted.iter().map(|floor| floor.displacement().size());
        let scale = sways.fold(0.0, f64::max);
        for (floor, (got, wanted)) in floors.iter().zip(wanted).enumerate() {
            for (got, wanted) in [
                (got.displacement_max(), wanted.displacement_max()),
                (got.displacement_min(), wanted.displacement_min()),
            ] {
                assert!(
                    (got.value - wanted.value).abs() <= TOLERANCE * scale,
                    "{what}, building {building}, floor {floor}: {got:?} against {wanted:?}"
                );
            }
        }
    }
    assert!(
        got.energy.worst_imbalance < 1e-8,
        "{what}: {:?}",
        got.energy
    );
    assert!(
        got.work.solves * 3 < fine.work.solves,
        "{what}: modal stepping is there to save steps: {:?}",
        got.work
    );
    expected > 0.0
}

/// Laws of each kind: with and without a dashpot, with and without a corner, and sudden.
#[test]
fn frames_agree_with_riccati() {
    frames_agree(&[
        LawKind::Linear,
        LawKind::Kelvin,
        LawKind::HertzDamp,
        LawKind::Restitution,
    ]);
}

#[test]
#[ignore = "takes a minute; part of check-all"]
fn frames_agree_with_riccati_under_every_law() {
    frames_agree(&LAWS);
}

fn frames_agree(laws: &[LawKind]) {
    for &kind in laws {
        let model = two_frames(0.03, law(kind, 0.65));
        assert!(
            compare(&format!("{kind:?}"), &model, 2.5),
            "{kind:?}: the frames meet"
        );
    }
}

#[test]
fn random_frames_agree_with_riccati() {
    random_frames_agree(4);
}

#[test]
#[ignore = "takes a minute; part of check-all"]
fn more_random_frames_agree_with_riccati() {
    random_frames_agree(12);
}

fn random_frames_agree(pairs: usize) {
    let mut random = Random(77);
    let mut hits = 0;
    for case in 0..pairs {
        let mut frames: Vec<_> = (0..2).map(|_| random_frame(&mut random)).collect();
        for frame in &mut frames {
            // Floors that face each other.
            frame.storey_heights.fill(3.2);
        }
        let names = ["left", "right"];
        let buildings = frames.into_iter().zip(names).map(|(frame, name)| {
            let mut building = framed(name, frame);
            building.damping = Damping::Rayleigh {
                alpha: random.between(0.0, 1.0),
                beta: random.between(5e-4, 4e-3),
            };
            building
        });
        let model = row(buildings.collect(), 0.02, law(LawKind::HertzDamp, 0.65));
        hits += usize::from(compare(&format!("pair {case}"), &model, 1.5));
    }
    assert!(2 * hits >= pairs, "{hits} of {pairs} pairs meet");
}

/// A row of three, the one in the middle hit from both sides.
#[test]
fn a_row_agrees_with_riccati() {
    let towers = vec![
        tower("left", 3, 6e4, 0.5),
        tower("middle", 5, 4e4, 0.9),
        tower("right", 4, 9e4, 0.4),
    ];
    assert!(compare(
        "three towers",
        &row(towers, 0.02, law(LawKind::Hertz, 1.0)),
        3.0
    ));
}

/// With the same ratio in all modes: shear buildings of one storey know no other damping, so that both ways agree.
#[test]
fn damping_in_all_modes_is_that_of_a_single_mode() {
    let with = |damping: Damping| {
        let mut model = row(
            vec![tower("left", 1, 5e4, 0.7), tower("right", 1, 9e4, 0.3)],
            0.02,
            law(LawKind::Hertz, 1.0),
        );
        for building in &mut model.buildings {
            building.damping = damping.clone();
        }
        let system = assembled(&model);
        run(&system, &shaking(4.0), &modal(&steps(0.005, 32)))
    };
    let one = with(Damping::ratio(0.05, [1]));
    let all = with(Damping::AllModes { ratio: 0.05 });
    assert!(!one.impacts.is_empty());
    assert!((peak(&one) / peak(&all) - 1.0).abs() < 1e-12);
}

/// Each mode decays by itself: released in the shape of a mode, a building comes back after one period by e^(−2πζ/√(1−ζ²)).
#[test]
fn every_mode_decays_with_the_ratio() {
    let mut building = framed("frame", frame(3, &[4.0, 5.0]));
    building.damping = Damping::AllModes { ratio: 0.05 };
    let model = Model {
        buildings: vec![building],
        gaps: Vec::new(),
        ..row(
            vec![tower("t", 1, 1e4, 1.0), tower("u", 1, 1e4, 1.0)],
            0.1,
            law(LawKind::Hertz, 1.0),
        )
    };
    let system = assembled(&model);
    // A pulse so short that all modes ring; afterwards the envelope of each is its own.
    let mut values = vec![0.0; 400];
    values[1] = 50.0;
    let motion = GroundMotion::sampled("pulse", 0.002, values);
    let outcome = run(&system, &motion, &modal(&steps(0.002, 1)));
    let modes: Vec<_> = system.buildings[0].lateral_modes().collect();
    let equations = &system.buildings[0].equations;
    for mode in modes {
        // ∫ of the triangular pulse over e^(iωt) is 50·0.002·sinc²; the rest is free motion from its centre on.
        let omega = mode.circular_frequency;
        let (zeta, h): (f64, f64) = (0.05, 0.002);
        let damped_frequency = omega * (1.0 - zeta * zeta).sqrt();
        let amplitude = |displacement: &[f64]| -> f64 {
            let terms = mode.shape.iter().zip(displacement).zip(&equations.mass);
            terms.map(|((shape, u), mass)| shape * mass * u).sum()
        };
        let (q, v) = (
            amplitude(&outcome.state.displacement),
            amplitude(&outcome.state.velocity),
        );
        let energy = (0.5 * (v * v + omega * omega * q * q) + zeta * omega * q * v).sqrt();
        // Exact: the answer to a triangle is the sum of three ramps.
        let ramp = |t: f64| {
            if t <= 0.0 {
                return [0.0; 2];
            }
            let (k, d) = (omega * omega, 2.0 * zeta * omega);
            let decay = (-0.5 * d * t).exp();
            let (sin, cos) = (damped_frequency * t).sin_cos();
            let (a, b) = (d / k, (0.5 * d * d / k - 1.0) / damped_frequency);
            let wave = a * cos + b * sin;
            let slope = -0.5 * d * wave + damped_frequency * (b * cos - a * sin);
            [(t - d / k + decay * wave) / k, (1.0 + decay * slope) / k]
        };
        let end = motion.duration;
        let rate = -mode.participation * 50.0 / h;
        let sum = |index: usize| {
            rate * (ramp(end)[index] - 2.0 * ramp(end - h)[index] + ramp(end - 2.0 * h)[index])
        };
        let (q0, v0) = (sum(0), sum(1));
        let expected = (0.5 * (v0 * v0 + omega * omega * q0 * q0) + zeta * omega * q0 * v0).sqrt();
        assert!(
            (energy / expected - 1.0).abs() < 1e-6,
            "ω = {omega}: {energy} against {expected}"
        );
    }
}

/// Buildings that cannot be stepped by their modes say why.
#[test]
fn what_modes_cannot_do_is_refused() {
    let refused = |change: &dyn Fn(&mut Model)| {
        let mut model = two_frames(0.03, law(LawKind::Hertz, 1.0));
        model.analysis.solver = Some(Solver::Modal);
        change(&mut model);
        let system = assembled(&model);
        let faults = Plan::choose(&system, &shaking(1.0), &model.analysis)
            .expect_err("it should be refused");
        faults[0].clone()
    };
    let fault = refused(&|model| model.buildings[1].gravity.p_delta = true);
    assert_eq!(fault.path, "analysis.solver");
    assert!(
        fault.problem.contains("P-Delta") && fault.problem.contains("riccati"),
        "{fault}"
    );
    let fault = refused(&|model| model.buildings[0].gravity.preload = true);
    assert!(fault.problem.contains("weight"), "{fault}");
    let fault = refused(&|model| model.analysis.integrator = jostle::Integrator::hht(0.1));
    assert!(fault.problem.contains("integrator"), "{fault}");
    let fault = refused(&|model| {
        model.analysis.solver = Some(Solver::Riccati);
        model.buildings[0].damping = Damping::AllModes { ratio: 0.05 };
    });
    assert_eq!(fault.path, "building[0].damping.modes");
}

/// Where no solver is named, modes step whatever they can, and Riccati's recursion the rest.
#[test]
fn the_quickest_solver_that_may_is_chosen() {
    let chosen = |change: &dyn Fn(&mut Model)| {
        let mut model = two_frames(0.03, law(LawKind::Hertz, 1.0));
        change(&mut model);
        let system = assembled(&model);
        Plan::choose(&system, &shaking(1.0), &model.analysis).map(|plan| plan.solver)
    };
    let all = || Damping::AllModes { ratio: 0.05 };
    let modal: [&dyn Fn(&mut Model); 3] = [
        &|_| {},
        &|model| model.buildings[0].damping = all(),
        // Nothing else knows this damping, whatever the steps.
        &|model| {
            model.buildings[0].damping = all();
            model.analysis.step = Some(1e-3);
        },
    ];
    for change in modal {
        assert_eq!(chosen(change), Ok(Solver::Modal));
    }
    let riccati: [&dyn Fn(&mut Model); 5] = [
        &|model| model.buildings[1].gravity.p_delta = true,
        &|model| model.buildings[0].gravity.preload = true,
        &|model| model.analysis.integrator = jostle::Integrator::hht(0.1),
        &|model| model.analysis.step = Some(1e-3),
        &|model| model.analysis.contact_step = Some(1e-4),
    ];
    for change in riccati {
        assert_eq!(chosen(change), Ok(Solver::Riccati));
    }
    let faults = chosen(&|model| {
        model.buildings[0].damping = all();
        model.buildings[1].gravity.p_delta = true;
    });
    let fault = &faults.expect_err("nothing can step this")[0];
    assert_eq!(fault.path, "building[0].damping.modes");
    assert!(fault.problem.contains("P-Delta"), "{fault}");
}

/// From a displacement and a velocity, one mass decays as u₀ e^(−ζωt)(cos ω_d t + …); its energy at the start is the input.
#[test]
fn a_start_in_motion_decays_as_in_closed_form() {
    let (mass, stiffness, ratio): (f64, f64, f64) = (4e4, 6e7, 0.05);
    let (rise, speed) = (0.012, -0.4);
    let shear = Structure::Shear(Shear {
        mass: vec![mass],
        stiffness: vec![stiffness],
        storey_heights: vec![3.0],
    });
    let mut model = two_frames(1.0, law(LawKind::Hertz, 1.0));
    model.gaps.clear();
    model.buildings.truncate(1);
    model.buildings[0].structure = shear;
    let omega = (stiffness / mass).sqrt();
    model.buildings[0].damping = Damping::Rayleigh {
        alpha: ratio * omega,
        beta: ratio / omega,
    };
    let system = assembled(&model);
    let duration = 0.7;
    let mut state = State::at_rest(&system, 0.0);
    (state.displacement[0], state.velocity[0]) = (rise, speed);
    let plan = modal(&steps(0.01, 1));
    let outcome = simulate_from(&system, &still(duration), &plan, EVERYTHING, state, |_| {
        ControlFlow::Continue(())
    });
    assert_eq!(outcome.end, RunEnd::Completed);
    let (decay, damped) = (ratio * omega, omega * (1.0 - ratio * ratio).sqrt());
    let at = |t: f64| {
        let sine = (speed + decay * rise) / damped;
        (-decay * t).exp() * (rise * (damped * t).cos() + sine * (damped * t).sin())
    };
    let end = outcome.state.time;
    assert!((outcome.state.displacement[0] - at(end)).abs() < 1e-12 * rise);
    let input = 0.5 * (stiffness * rise * rise + mass * speed * speed);
    assert!((outcome.energy.input / input - 1.0).abs() < 1e-12);
    assert!(outcome.energy.worst_imbalance < 1e-10);
    let greatest = (0..70_000)
        .map(|k| at(1e-5 * f64::from(k)))
        .fold(0.0, f64::max);
    let peak = outcome.peaks.floor(0, 1).displacement_max().value;
    assert!(
        (peak / greatest - 1.0).abs() < 1e-4,
        "{peak} against {greatest}"
    );
}

/// A plan made by hand is held to the same.
#[test]
fn unsuited_runs_do_not_begin() {
    let end = |system: &System, plan: &Plan, state: State| {
        let motion = still(0.1);
        let outcome = simulate_from(system, &motion, plan, EVERYTHING, state, |_| {
            ControlFlow::Continue(())
        });
        assert_eq!(outcome.work.steps, 0);
        match outcome.end {
            RunEnd::Failed(error) => error.to_string(),
            end => panic!("it should fail: {end:?}"),
        }
    };
    let plan = steps(0.001, 1);
    let mut system = assembled(&two_frames(0.03, law(LawKind::Hertz, 1.0)));
    system.buildings[0].modal_damping = Some(0.05);
    let rest = State::at_rest(&system, 0.0);
    assert!(end(&system, &plan, rest).contains("all modes"));
    let mut model = two_frames(0.03, law(LawKind::Hertz, 1.0));
    model.buildings[1].gravity.p_delta = true;
    let system = assembled(&model);
    let rest = State::at_rest(&system, 0.0);
    assert!(end(&system, &modal(&plan), rest).contains("P-Delta"));
}

/// Rows of histories divide the steps, and what a run calls its step is divided with them.
#[test]
fn the_step_told_is_the_step_taken() {
    let system = assembled(&two_frames(1.0, law(LawKind::Hertz, 1.0)));
    let plan = modal(&steps(0.01, 8));
    for (record_interval, parts) in [(None, 1), (Some(0.004), 4), (Some(0.002), 8)] {
        let settings = Settings {
            record_interval,
            ..EVERYTHING
        };
        let outcome = simulate(&system, &still(1.0), &plan, settings, |_| {
            ControlFlow::Continue(())
        });
        assert_eq!(outcome.work.steps, 100 * parts);
        let told = outcome.free_step.expect("it ran");
        assert!((told * parts as f64 - 0.01).abs() < 1e-15, "{told} s");
    }
}

/// Nothing moves, nothing is lost: a still ground leaves zero behind.
#[test]
fn rest_stays_rest() {
    let system = assembled(&two_frames(0.0, law(LawKind::HertzDamp, 0.65)));
    let outcome = run(&system, &still(1.0), &modal(&steps(0.01, 8)));
    assert!(outcome.impacts.is_empty());
    assert!(outcome.state.displacement.iter().all(|u| *u == 0.0));
    assert!(matches!(system.contacts[0].law, ForceLaw::Hertz { .. }));
}
