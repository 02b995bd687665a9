//! Zero gaps, rigid contacts, dull and lively restitution, touches on the grid, lasting contact.

use jostle::stepping::ContactSteps;
use jostle::{Analysis, Column, GroundMotion, LawKind, Outcome, Plan, RestitutionIs, System};

use crate::verification::support::{
    LAWS, Random, assembled, column, frame, framed, largest, law, moving, row, run, run_from,
    shaking, slider, sliders, steps, still, tower, two_frames,
};

fn automatic(system: &System, motion: &GroundMotion) -> Plan {
    Plan::choose(system, motion, &Analysis::default()).expect("steps are found")
}

fn assert_sound(outcome: &Outcome, what: &str) {
    assert!(
        outcome.energy.worst_imbalance <= 1e-9,
        "{what}: {:e} of the energy is missing",
        outcome.energy.worst_imbalance
    );
    assert!(
        outcome
            .state
            .displacement
            .iter()
            .all(|u| u.is_finite() && u.abs() < 1.0),
        "{what}: displacements up to {} m",
        largest(&outcome.state.displacement)
    );
    for impact in &outcome.impacts {
        // The momentum law knows no force; its impacts take no time.
        let jump = impact.peak_force == 0.0 && impact.start == impact.end;
        assert!(
            (jump && impact.impulse > 0.0)
                || (impact.start < impact.end && impact.peak_force > 0.0),
            "{what}: {impact:?}"
        );
    }
}

#[test]
fn identical_buildings_without_a_gap_never_push() {
    for kind in LAWS {
        let twins = vec![
            framed("left", frame(3, &[4.0])),
            framed("right", frame(3, &[4.0])),
        ];
        let system = assembled(&row(twins, 0.0, law(kind, 0.65)));
        let motion = shaking(2.0);
        for plan in [steps(2e-3, 4), automatic(&system, &motion)] {
            let outcome = run(&system, &motion, &plan);
            assert_eq!(outcome.impacts, [], "{kind:?}: they move alike");
            assert_sound(&outcome, &format!("{kind:?}"));
        }
    }
}

#[test]
fn different_buildings_without_a_gap_push_from_the_first_step() {
    for kind in LAWS {
        for sign in [1.0, -1.0] {
            let system = assembled(&two_frames(0.0, law(kind, 0.65)));
            let mut motion = shaking(2.0);
            motion.scale = sign;
            for plan in [steps(1e-3, 4), automatic(&system, &motion)] {
                let outcome = run(&system, &motion, &plan);
                assert_sound(&outcome, &format!("{kind:?}, zero gap, {plan:?}, {sign}"));
                assert!(
                    outcome.impacts.len() > 5,
                    "{kind:?}: {} impacts",
                    outcome.impacts.len()
                );
            }
        }
    }
}

#[test]
fn a_very_narrow_gap_is_like_none() {
    let peak = |width: f64| {
        let system = assembled(&two_frames(width, law(LawKind::Hertz, 1.0)));
        let outcome = run(&system, &shaking(1.0), &steps(5e-4, 4));
        outcome
            .impacts
            .iter()
            .fold(0.0_f64, |peak, impact| peak.max(impact.peak_force))
    };
    let closed = peak(0.0);
    for width in [1e-15, 1e-12, 1e-10] {
        let narrow = peak(width);
        assert!(
            (narrow / closed - 1.0).abs() < 1e-2,
            "gap {width:e} m: {narrow} N, no gap: {closed} N"
        );
    }
}

#[test]
fn very_stiff_contacts_are_resolved() {
    for (kind, stiffness) in [
        (LawKind::HertzDamp, 1e13),
        (LawKind::Hertz, 1e13),
        (LawKind::KelvinNoTension, 1e12),
        (LawKind::Kelvin, 1e12),
    ] {
        let mut law = law(kind, 0.65);
        law.stiffness = stiffness;
        let system = assembled(&row(
            vec![tower("left", 3, 3e4, 0.5), tower("right", 4, 5e4, 0.8)],
            0.01,
            law,
        ));
        let motion = shaking(2.0);
        let outcome = run(&system, &motion, &automatic(&system, &motion));
        assert!(
            outcome.impacts.len() > 3,
            "{kind:?}: {} impacts",
            outcome.impacts.len()
        );
        assert!(
            outcome
                .impacts
                .iter()
                .all(|impact| impact.peak_indentation < 1e-3),
            "{kind:?}: hardly any indentation"
        );
        assert_sound(&outcome, &format!("{kind:?}, {stiffness:e}"));
    }
}

#[test]
fn any_restitution_is_possible() {
    for kind in LAWS {
        for restitution in [0.05, 0.2, 0.99, 1.0] {
            for restitution_is in [RestitutionIs::Input, RestitutionIs::Realised] {
                let mut law = law(kind, restitution);
                law.restitution_is = restitution_is;
                let what = format!("{law:?}");
                let mut model = two_frames(0.01, law);
                if model.check().is_err() {
                    assert!(
                        matches!(kind, LawKind::KelvinNoTension | LawKind::Bilinear(_))
                            && restitution < 0.25,
                        "{what} is refused"
                    );
                    continue;
                }
                model.analysis.tolerance = 1e-3;
                let system = assembled(&model);
                let motion = shaking(2.0);
                let outcome = run(&system, &motion, &automatic(&system, &motion));
                assert!(!outcome.impacts.is_empty(), "{what}: no impacts");
                assert_sound(&outcome, &what);

                // Free masses rebound as the formula says.
                let pair = sliders(
                    vec![slider("left", 3e4, None), slider("right", 5e4, None)],
                    0.001,
                    &law,
                );
                let plan = Plan {
                    contact_steps: ContactSteps::PerImpact {
                        steps: 400.0,
                        tolerance: 1e-5,
                    },
                    ..steps(1e-3, 1)
                };
                let outcome = run_from(
                    &pair,
                    &still(0.4),
                    &plan,
                    moving(&pair, &[0.0, 0.0], &[0.5, 0.0]),
                );
                let [impact] = outcome.impacts[..] else {
                    panic!("{what}: free masses meet {} times", outcome.impacts.len());
                };
                let expected = law.free_restitution().expect("a number");
                let got = impact.realised_restitution();
                assert!(
                    (got - expected).abs() <= 2e-3,
                    "{what}: rebound {got} instead of {expected}"
                );
            }
        }
    }
}

#[test]
fn an_impact_in_the_first_step_counts() {
    for kind in LAWS {
        for gap in [0.0, 1e-12, 1e-9, 1e-6] {
            let system = sliders(
                vec![slider("left", 3e4, None), slider("right", 5e4, None)],
                gap,
                &law(kind, 0.65),
            );
            let state = moving(&system, &[0.0, 0.0], &[0.5, 0.0]);
            let outcome = run_from(&system, &still(0.3), &steps(1e-3, 4), state);
            assert_eq!(outcome.impacts.len(), 1, "{kind:?}, gap {gap:e} m");
            let impact = outcome.impacts[0];
            // A touch within a ten-thousandth of a step happens at its start.
            assert!(
                (impact.start - gap / 0.5).abs() < 2.5e-8,
                "{kind:?}, gap {gap:e} m: {impact:?}"
            );
            assert!(
                (impact.impact_speed - 0.5).abs() < 1e-9,
                "{kind:?}, gap {gap:e} m: {impact:?}"
            );
            assert_sound(&outcome, &format!("{kind:?}, gap {gap:e} m"));
        }
    }
}

/// A touch that falls on a regular step, or misses it by a hair, is an ordinary touch.
#[test]
fn tiny_landing_steps_do_not_disturb() {
    for kind in LAWS {
        let peak = |off: f64| {
            // At 0.5 m/s the faces meet after 20 steps of 1 ms.
            let system = sliders(
                vec![slider("left", 3e4, None), slider("right", 5e4, None)],
                0.01 + off,
                &law(kind, 0.65),
            );
            let state = moving(&system, &[0.0, 0.0], &[0.5, 0.0]);
            let outcome = run_from(&system, &still(0.3), &steps(1e-3, 8), state);
            assert_eq!(outcome.impacts.len(), 1, "{kind:?}, off by {off:e} m");
            assert_sound(&outcome, &format!("{kind:?}, off by {off:e} m"));
            let impact = outcome.impacts[0];
            assert!(
                (impact.impact_speed - 0.5).abs() < 1e-9,
                "{kind:?}, off by {off:e} m: {impact:?}"
            );
            impact.impulse
        };
        let exactly = peak(0.0);
        for off in [
            -1e-7, -1e-9, -1e-11, -1e-13, -1e-15, 1e-15, 1e-13, 1e-11, 1e-9, 1e-7,
        ] {
            let near = peak(off);
            assert!(
                (near / exactly - 1.0).abs() < 1e-3,
                "{kind:?}, off by {off:e} m: {near} N·s against {exactly} N·s"
            );
        }
    }
}

/// Under a constant ground acceleration the softer building comes to lean on the stiffer one.
#[test]
fn lasting_contact_settles_on_its_static_force() {
    let (m1, k1, m2, k2): (f64, f64, f64, f64) = (3e4, 1e6, 5e4, 2e7);
    let (gap, acceleration) = (0.01, -1.0);
    for kind in LAWS {
        if matches!(kind, LawKind::Bilinear(_)) {
            // Friction inside: it rests anywhere between loading and unloading.
            continue;
        }
        let law = law(kind, 0.65);
        let mut left = slider("left", m1, Some(k1));
        let mut right = slider("right", m2, Some(k2));
        left.structure.equations.alpha = 2.0 * 0.2 * (k1 / m1).sqrt();
        right.structure.equations.alpha = 2.0 * 0.1 * (k2 / m2).sqrt();
        let system = sliders(vec![left, right], gap, &law);
        let duration = 20.0;
        let motion = GroundMotion::sampled("constant", duration, vec![acceleration; 2]);
        for plan in [steps(2e-3, 4), automatic(&system, &motion)] {
            let outcome = run(&system, &motion, &plan);
            assert_sound(&outcome, &format!("{kind:?}"));
            // Bisection on the force: δ(F) from the law against δ(F) from the springs.
            let (mut low, mut high) = (0.0_f64, -acceleration * m1);
            for _ in 0..200 {
                let force = 0.5 * (low + high);
                let open =
                    (-acceleration * m1 - force) / k1 - (-acceleration * m2 + force) / k2 - gap;
                if system.contacts[0]
                    .law
                    .respond(open.max(0.0), 0.0, 1.0)
                    .force
                    > force
                {
                    low = force;
                } else {
                    high = force;
                }
            }
            let got = outcome.state.contacts[0].force();
            assert!(
                (got / low - 1.0).abs() < 1e-3,
                "{kind:?}: rests with {got} N instead of {low} N"
            );
        }
    }
}

#[test]
fn bodies_of_very_different_mass_meet() {
    for kind in LAWS {
        for masses in [[1.0, 1e9], [1e9, 1.0]] {
            let mut law = law(kind, 0.65);
            law.stiffness = 1e6;
            let system = sliders(
                vec![
                    slider("left", masses[0], None),
                    slider("right", masses[1], None),
                ],
                0.001,
                &law,
            );
            let state = moving(&system, &[0.0, 0.0], &[0.5, 0.0]);
            let plan = Plan {
                contact_steps: ContactSteps::PerImpact {
                    steps: 200.0,
                    tolerance: 1e-4,
                },
                ..steps(1e-3, 1)
            };
            let outcome = run_from(&system, &still(0.1), &plan, state);
            let what = format!("{kind:?}, {masses:?} kg");
            assert_eq!(outcome.impacts.len(), 1, "{what}");
            let (got, expected) = (
                outcome.impacts[0].realised_restitution(),
                law.free_restitution().expect("a number"),
            );
            assert!(
                (got - expected).abs() < 1e-3,
                "{what}: rebound {got} instead of {expected}"
            );
        }
    }
}

/// Three equal bodies in touch: the last one flies off. Elastic, so that energy and momentum say how.
#[test]
fn a_row_of_touching_bodies_passes_the_blow_on() {
    for kind in [LawKind::Linear, LawKind::Hertz] {
        let bodies = ["a", "b", "c"].map(|name| slider(name, 1e4, None)).into();
        let system = sliders(bodies, 0.0, &law(kind, 1.0));
        let state = moving(&system, &[0.0; 3], &[1.0, 0.0, 0.0]);
        let outcome = run_from(&system, &still(0.3), &steps(2e-4, 4), state);
        let v = &outcome.state.velocity;
        let (momentum, energy) = (v.iter().sum::<f64>(), v.iter().map(|v| v * v).sum::<f64>());
        assert!((momentum - 1.0).abs() < 1e-9, "{kind:?}: velocities {v:?}");
        assert!((energy - 1.0).abs() < 1e-4, "{kind:?}: velocities {v:?}");
        assert!(
            v[0] <= v[1] && v[1] <= v[2] && v[2] > 0.9,
            "{kind:?}: velocities {v:?}"
        );
        assert_eq!(outcome.impacts.len(), 2, "{kind:?}: {:?}", outcome.impacts);
    }
}

/// Dull bodies in touch move on together, whatever the law makes of a jump without speed.
#[test]
fn dull_bodies_in_touch_stay_slow() {
    for kind in [
        LawKind::Kelvin,
        LawKind::KelvinNoTension,
        LawKind::HertzDamp,
    ] {
        let bodies = ["a", "b", "c"].map(|name| slider(name, 1e4, None)).into();
        let system = sliders(bodies, 0.0, &law(kind, 0.65));
        let state = moving(&system, &[0.0; 3], &[1.0, 0.0, 0.0]);
        let outcome = run_from(&system, &still(0.1), &steps(1e-3, 8), state);
        let v = &outcome.state.velocity;
        assert!(
            (v.iter().sum::<f64>() - 1.0).abs() < 1e-9,
            "{kind:?}: momentum, velocities {v:?}"
        );
        assert!(
            v.iter().map(|v| v * v).sum::<f64>() < 1.0,
            "{kind:?}: energy is lost, velocities {v:?}"
        );
        assert!(
            v[0] <= v[1] && v[1] <= v[2],
            "{kind:?}: they part, velocities {v:?}"
        );
        assert_sound(&outcome, &format!("{kind:?}"));
    }
}

/// The end of the motion need not be a whole number of steps; a motion may be as short as one.
#[test]
fn runs_end_where_the_motion_ends() {
    let system = assembled(&two_frames(0.01, law(LawKind::HertzDamp, 0.65)));
    for duration in [1e-6, 1e-3, 0.0123, 1.001, 1.9999] {
        let mut motion = shaking(3.0);
        motion.duration = duration;
        let outcome = run(&system, &motion, &steps(2e-3, 4));
        assert!(
            (outcome.state.time - duration).abs() < 1e-12,
            "ends at {} s, not {duration} s",
            outcome.state.time
        );
        assert!(
            outcome.energy.worst_imbalance <= 1e-9,
            "{:e}",
            outcome.energy.worst_imbalance
        );
    }
    let mut nothing = still(1.0);
    nothing.duration = 0.0;
    let outcome = run(&system, &nothing, &steps(2e-3, 4));
    assert_eq!(
        (outcome.work.steps, outcome.impacts.len()),
        (0, 0),
        "nothing happens in no time"
    );
}

/// In a crowd of closed contacts one event can come so soon after another that it must happen at once: a step
/// between them would be so short that accelerations, changes of displacement over h², are lost in rounding.
#[test]
fn no_step_is_too_short_to_be_taken() {
    let mut random = Random(2);
    for number in 0..150 {
        let towers = (0..5).map(|k| {
            let (storeys, mass) = (random.whole(1, 5), 10_f64.powf(random.between(3.0, 6.0)));
            tower(
                &format!("tower {k}"),
                storeys,
                mass,
                random.between(0.1, 1.5),
            )
        });
        let towers = towers.collect();
        let mut law = law(LawKind::Kelvin, random.between(0.3, 0.95));
        law.stiffness *= 10_f64.powf(random.between(0.0, 2.5));
        let system = assembled(&row(towers, 0.0, law));
        let division = random.whole(1, 8) as u32;
        let outcome = run(&system, &shaking(2.0), &steps(1e-3, division));
        let shortest = column(&outcome, Column::TIME)
            .windows(2)
            .fold(f64::INFINITY, |shortest: f64, pair| {
                shortest.min(pair[1] - pair[0])
            });
        assert!(
            shortest >= 5e-5 * 1e-3 / f64::from(division),
            "row {number}: a step of {shortest:e} s, division {division}"
        );
        for impact in &outcome.impacts {
            assert!(
                impact.start < impact.end && impact.impulse > 0.0,
                "row {number}: {impact:?}"
            );
        }
    }
}
