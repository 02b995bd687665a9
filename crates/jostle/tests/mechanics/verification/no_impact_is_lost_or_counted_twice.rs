use std::f64::consts::PI;

use jostle::contact::effective_mass;
use jostle::stepping::ContactSteps;
use jostle::{Column, LawKind, Plan, RestitutionIs};

use crate::verification::support::{
    LAWS, assembled, column, law, moving, row, run, run_from, shaking, slider, sliders, steps,
    still, tower, two_frames,
};

#[test]
fn impacts_start_before_they_end_and_follow_each_other() {
    for kind in LAWS {
        let system = assembled(&two_frames(0.01, law(kind, 0.65)));
        let outcome = run(&system, &shaking(4.0), &steps(2e-3, 8));
        assert!(
            outcome.impacts.len() > 5,
            "{kind:?}: {} impacts",
            outcome.impacts.len()
        );
        for contact in 0..system.contacts.len() {
            let impacts: Vec<_> = outcome
                .impacts
                .iter()
                .filter(|impact| impact.contact == contact)
                .collect();
            for impact in &impacts {
                if kind == LawKind::Restitution && impact.peak_force == 0.0 {
                    assert!(impact.start == impact.end && impact.impulse > 0.0);
                    continue;
                }
                assert!(impact.start < impact.end, "{kind:?}: {impact:?}");
                assert!(
                    impact.start <= impact.peak_force_at && impact.peak_force_at <= impact.end,
                    "{kind:?}: {impact:?}"
                );
                assert!(
                    impact.impact_speed > 0.0 && impact.peak_force > 0.0,
                    "{kind:?}: {impact:?}"
                );
                assert!(
                    impact.peak_indentation > 0.0 && impact.impulse > 0.0,
                    "{kind:?}: {impact:?}"
                );
            }
            for pair in impacts.windows(2) {
                assert!(pair[0].end <= pair[1].start, "{kind:?}: {pair:?} overlap");
            }
        }
    }
}

/// Between two impacts the recorded force is zero, and it is nowhere else positive.
#[test]
fn forces_act_during_impacts_only() {
    let system = assembled(&two_frames(0.01, law(LawKind::HertzDamp, 0.65)));
    let outcome = run(&system, &shaking(4.0), &steps(2e-3, 8));
    let time = column(&outcome, Column::TIME);
    for contact in 0..system.contacts.len() {
        let force = column(&outcome, Column::contact_force(contact));
        let impacts: Vec<_> = outcome
            .impacts
            .iter()
            .filter(|impact| impact.contact == contact)
            .collect();
        for (t, force) in time.iter().zip(&force) {
            let during = impacts
                .iter()
                .any(|impact| impact.start <= *t && *t <= impact.end);
            assert!(
                during || *force == 0.0,
                "contact {contact}: {force} N at {t} s outside all impacts"
            );
        }
        for impact in impacts {
            let met = time
                .iter()
                .zip(&force)
                .any(|(t, f)| impact.start < *t && *t < impact.end && *f > 0.0);
            assert!(met, "contact {contact}: no force during {impact:?}");
        }
    }
}

#[test]
fn a_step_ends_on_every_touch() {
    let system = assembled(&two_frames(0.01, law(LawKind::HertzDamp, 0.65)));
    let outcome = run(&system, &shaking(4.0), &steps(5e-3, 8));
    let time = column(&outcome, Column::TIME);
    for impact in &outcome.impacts {
        let row = time
            .iter()
            .position(|t| *t == impact.start)
            .expect("an instant of the touch");
        let contact = &system.contacts[impact.contact];
        let [left, right] = [0, 1].map(|side| {
            let face = contact.ports.0[side].as_ref().expect("no wall");
            let (floor, building) = (face.floor.expect("floors meet"), face.building);
            column(&outcome, Column::displacement(building, floor))[row]
        });
        let indentation = left - right - contact.width;
        assert!(
            indentation.abs() <= 1e-12,
            "{indentation:e} m deep at the touch of {impact:?}"
        );
    }
}

#[test]
fn impulse_is_the_change_of_momentum_of_free_masses() {
    let masses = [3e4, 5e4];
    for kind in LAWS {
        let mut law = law(kind, 0.6);
        let mut duration = 0.12;
        if matches!(kind, LawKind::Rubber(_)) {
            // Soft as it is, it would take 0.3 s.
            (law.stiffness, duration) = (5e9, 0.15);
        }
        for (speeds, gap) in [
            ([0.5, -0.2], 0.003),
            ([0.4, 0.1], 0.0),
            ([0.0, -0.05], 1e-4),
        ] {
            let system = sliders(
                vec![
                    slider("left", masses[0], None),
                    slider("right", masses[1], None),
                ],
                gap,
                &law,
            );
            // Until shortly after the impact: a free body forgets no rounding.
            let outcome = run_from(
                &system,
                &still(duration),
                &steps(5e-4, 1),
                moving(&system, &[0.0, 0.0], &speeds),
            );
            let [impact] = outcome.impacts[..] else {
                panic!("{kind:?}, {speeds:?}: {} impacts", outcome.impacts.len());
            };
            let [v1, v2] = [outcome.state.velocity[0], outcome.state.velocity[1]];
            let lost = masses[0] * (speeds[0] - v1);
            let won = masses[1] * (v2 - speeds[1]);
            assert!(
                (impact.impulse / lost - 1.0).abs() <= 1e-10,
                "{kind:?}: left lost {lost}, {impact:?}"
            );
            assert!(
                (impact.impulse / won - 1.0).abs() <= 1e-10,
                "{kind:?}: right won {won}, {impact:?}"
            );
            let expected = (speeds[0] - speeds[1]).abs();
            assert!(
                (impact.impact_speed / expected - 1.0).abs() <= 1e-12,
                "{kind:?}: {impact:?}"
            );
            let parting = v2 - v1;
            assert!(
                (impact.separation_speed / parting - 1.0).abs() <= 1e-3,
                "{kind:?}: {impact:?}, parting {parting}"
            );
        }
    }
}

/// Energy that a free impact loses is the kinetic energy lost.
#[test]
fn work_of_the_contact_is_the_energy_lost() {
    let masses = [3e4, 5e4];
    for kind in LAWS {
        let mut law = law(kind, 0.6);
        law.restitution_is = RestitutionIs::Realised;
        let system = sliders(
            vec![
                slider("left", masses[0], None),
                slider("right", masses[1], None),
            ],
            0.001,
            &law,
        );
        let outcome = run_from(
            &system,
            &still(0.5),
            &steps(1e-4, 1),
            moving(&system, &[0.0, 0.0], &[0.4, -0.3]),
        );
        let impact = outcome.impacts[0];
        let met = 0.5 * effective_mass(masses[0], masses[1]) * impact.impact_speed.powi(2);
        let e = if kind.is_dissipative() { 0.6 } else { 1.0 };
        let lost = met * (1.0 - e * e);
        // The force of Jankowski's law rises as t^¼ at the touch: of order 1¼ only.
        let tolerance = if kind == LawKind::Jankowski {
            1e-3
        } else {
            1e-4
        };
        assert!(
            (impact.dissipated - lost).abs() <= tolerance * met,
            "{kind:?}: {impact:?}, expected {lost} J"
        );
        assert!(
            (impact.realised_restitution() - e).abs() <= tolerance,
            "{kind:?}: {impact:?}"
        );
    }
}

#[test]
fn early_impacts_are_the_same_at_half_the_step() {
    let towers = row(
        vec![tower("left", 3, 3e4, 0.5), tower("right", 4, 5e4, 0.8)],
        0.01,
        law(LawKind::HertzDamp, 0.65),
    );
    let system = assembled(&towers);
    let motion = shaking(1.6);
    let starts = |step: f64| -> Vec<(usize, f64)> {
        let outcome = run(&system, &motion, &steps(step, 8));
        outcome
            .impacts
            .iter()
            .map(|impact| (impact.contact, impact.start))
            .collect()
    };
    let finest = starts(1.25e-4);
    assert!(finest.len() >= 4, "{} impacts", finest.len());
    for step in [1e-3, 5e-4, 2.5e-4] {
        let coarse = starts(step);
        assert_eq!(coarse.len(), finest.len(), "impacts at h = {step} s");
        for (a, b) in coarse.iter().zip(&finest) {
            assert_eq!(a.0, b.0, "contacts close in the same order at h = {step} s");
            assert!(
                (a.1 - b.1).abs() <= 1e-3,
                "touch at {} s, at h = {step} s at {} s",
                b.1,
                a.1
            );
        }
    }
}

/// An oscillator swings almost as far as its neighbour and touches it for a moment between two steps.
#[test]
fn a_short_touch_between_two_steps_is_found() {
    let (amplitude, omega, mass) = (0.01, 2.0 * PI, 1e4);
    let step = 0.04;
    // At the steps before and after the turning point, at 6.25 steps, 20 and 90 µm are missing.
    for missing in [1e-6, 1e-5] {
        let gap = amplitude - missing;
        let system = sliders(
            vec![
                slider("left", mass, Some(mass * omega * omega)),
                slider("right", mass, None),
            ],
            gap,
            &law(LawKind::HertzDamp, 0.65),
        );
        let mut state = moving(&system, &[0.0, 0.0], &[amplitude * omega, 0.0]);
        state.acceleration.fill(0.0);
        // Coarse steps swing as far as exact ones: the rule conserves energy.
        let plan = Plan {
            contact_steps: ContactSteps::PerImpact {
                steps: 60.0,
                tolerance: 5e-4,
            },
            ..steps(step, 1)
        };
        let outcome = run_from(&system, &still(0.45), &plan, state);
        let times = column(&outcome, Column::TIME);
        let on_the_grid: Vec<f64> = column(&outcome, Column::displacement(0, 1))
            .into_iter()
            .zip(times)
            .filter(|(_, t)| ((t / step).round() * step - t).abs() < 1e-12)
            .map(|(u, _)| u)
            .collect();
        assert!(
            on_the_grid.iter().all(|u| *u < gap),
            "every regular step is open"
        );
        assert_eq!(
            outcome.impacts.len(),
            1,
            "{missing} m beyond the gap: found once"
        );
        let impact = outcome.impacts[0];
        let expected = omega * (2.0 * amplitude * missing).sqrt();
        assert!(
            (impact.impact_speed / expected - 1.0).abs() < 0.1,
            "speed {} m/s, expected about {expected} m/s",
            impact.impact_speed
        );
    }
}

/// Two floors of the same pair of towers touch at the same instant: both count, neither twice.
#[test]
fn simultaneous_touches_all_count() {
    let twins = |name: &str| -> Vec<_> {
        (0..3)
            .map(|k| slider(&format!("{name}{k}"), 2e4, None))
            .collect()
    };
    let [a, b, c]: [_; 3] = twins("body").try_into().expect("three");
    let system = sliders(vec![a, b, c], 0.002, &law(LawKind::Hertz, 1.0));
    // The outer ones meet the one in the middle from both sides at once.
    let outcome = run_from(
        &system,
        &still(0.3),
        &steps(1e-3, 4),
        moving(&system, &[0.0; 3], &[0.4, 0.0, -0.4]),
    );
    let contacts: Vec<usize> = outcome
        .impacts
        .iter()
        .map(|impact| impact.contact)
        .collect();
    assert_eq!(contacts.len(), 2, "{contacts:?}");
    assert_eq!(
        outcome.impacts[0].start, outcome.impacts[1].start,
        "at the same instant"
    );
    assert!(
        outcome.state.velocity[1].abs() < 1e-12,
        "the middle one stays: {:?}",
        outcome.state.velocity
    );
}
