//! Coarse steps, cut-off and lasting contact, the momentum law against stiff ones, stepping against precise collisions.

use jostle::contact::{FreeCollision, effective_mass};
use jostle::results::{counted, find_simultaneous};
use jostle::stepping::ContactSteps;
use jostle::{
    Analysis, ContactLaw, Frame, GroundMotion, LawKind, Outcome, Plan, RestitutionIs, System,
};

use crate::verification::support::{
    LAWS, Random, assembled, frame, framed, law, moving, row, run, run_from, section, shaking,
    slider, sliders, steps, still, tower, two_frames,
};

/// Four steps in an impact at 0.5 m/s, half of what a model may ask for, and fewer in faster ones: forces are found all the
/// same, and energies balance.
#[test]
fn coarse_contact_steps_never_fail() {
    let mut random = Random(11);
    for kind in LAWS {
        for _ in 0..12 {
            let mut law = law(kind, random.between(0.3, 0.95));
            law.stiffness *= 10_f64.powf(random.between(0.0, 2.5));
            let towers = (0..3).map(|k| {
                let (storeys, mass) = (random.whole(1, 4), 10_f64.powf(random.between(3.5, 6.0)));
                tower(
                    &format!("tower {k}"),
                    storeys,
                    mass,
                    random.between(0.1, 1.5),
                )
            });
            let model = row(towers.collect(), random.between(0.0, 0.01), law);
            let step = random.between(2e-3, 1e-2);
            let system = assembled(&model);
            let shortest = system
                .contacts
                .iter()
                .map(|contact| contact.law.elastic_duration(contact.effective_mass(), 0.5))
                .fold(f64::INFINITY, f64::min);
            let division = (step / (0.25 * shortest)).ceil().max(1.0) as u32;
            let outcome = run(&system, &shaking(2.0), &steps(step, division));
            assert!(
                outcome.energy.worst_imbalance <= 1e-8,
                "{kind:?}, h = {step}: {:e} of the energy is missing",
                outcome.energy.worst_imbalance
            );
            for impact in &outcome.impacts {
                assert!(impact.separation_speed >= 0.0, "{kind:?}: {impact:?}");
                // In one or two steps the pull of the Kelvin law may outweigh its push.
                let pulls = kind == LawKind::Kelvin;
                assert!(impact.impulse > 0.0 || pulls, "{kind:?}: {impact:?}");
            }
        }
    }
}

/// The steps of a run know nothing of the precise integrator, nor that of steps.
#[test]
fn stepping_and_precise_collision_agree() {
    for kind in LAWS {
        for is in [RestitutionIs::Input, RestitutionIs::Realised] {
            let law = ContactLaw {
                restitution_is: is,
                ..law(kind, 0.5)
            };
            let (m1, m2, speed) = (3e4, 5e4, 0.6);
            let exact = FreeCollision::new(&law.between(m1, m2), m1, m2, speed);
            let system = sliders(
                vec![slider("left", m1, None), slider("right", m2, None)],
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
            let state = moving(&system, &[0.0, 0.0], &[0.4, -0.2]);
            let outcome = run_from(&system, &still(0.6), &plan, state);
            let [impact] = outcome.impacts[..] else {
                panic!("{kind:?}: {} impacts", outcome.impacts.len());
            };
            let close = |what: &str, got: f64, expected: f64, scale: f64| {
                assert!(
                    (got - expected).abs() <= 4e-4 * scale,
                    "{kind:?}, {is:?}: {what} {got} against {expected}"
                );
            };
            if let Some(peak) = exact.peak_force {
                close("force", impact.peak_force, peak, peak);
                close(
                    "duration",
                    impact.end - impact.start,
                    exact.duration,
                    exact.duration,
                );
            }
            close("impulse", impact.impulse, exact.impulse, exact.impulse);
            let depth = exact.peak_indentation;
            close("indentation", impact.peak_indentation, depth, depth);
            close(
                "parting",
                impact.separation_speed,
                exact.separation_speed,
                speed,
            );
            let energy = 0.5 * effective_mass(m1, m2) * speed * speed;
            close("energy", impact.dissipated, exact.dissipated, energy);
        }
    }
}

#[test]
fn an_impact_cut_off_by_the_end_has_not_separated() {
    for kind in LAWS {
        if kind == LawKind::Restitution {
            continue;
        }
        let system = sliders(
            vec![slider("left", 3e4, None), slider("right", 5e4, None)],
            0.0,
            &law(kind, 0.65),
        );
        let state = moving(&system, &[0.0, 0.0], &[0.5, 0.0]);
        let outcome = run_from(&system, &still(0.004), &steps(1e-4, 1), state);
        let [impact] = outcome.impacts[..] else {
            panic!("{kind:?}: {} impacts", outcome.impacts.len());
        };
        assert!(!impact.finished, "{kind:?}: {impact:?}");
        assert_eq!(impact.separation_speed, 0.0, "{kind:?}: {impact:?}");
    }
}

fn worst_difference(a: &Outcome, b: &Outcome) -> f64 {
    let peaks = |o: &Outcome| -> Vec<f64> {
        let all = o.peaks.buildings().flatten();
        all.flat_map(|f| [f.displacement_max().value, f.displacement_min().value])
            .collect()
    };
    crate::verification::support::difference(&peaks(a), &peaks(b))
}

/// The stiffer the contact, the closer to a change of velocities at once. With frames this also shows that massless
/// joints follow the jump.
#[test]
fn stiff_laws_approach_the_momentum_law() {
    let stocky = Frame {
        columns: vec![section(0.4, 0.4); 1],
        ..frame(1, &[5.0])
    };
    let rows = [
        vec![tower("a", 1, 4e4, 0.5), tower("b", 1, 6e4, 0.8)],
        vec![framed("frame", stocky), tower("tower", 1, 5e4, 0.9)],
    ];
    for buildings in rows {
        let system = |kind: LawKind, stiffness: f64| -> System {
            let law = ContactLaw {
                kind,
                stiffness,
                restitution: 0.6,
                restitution_is: RestitutionIs::Realised,
            };
            let mut buildings = buildings.clone();
            if let jostle::Structure::Shear(shear) = &mut buildings[1].structure {
                shear.storey_heights = vec![3.2];
            }
            assembled(&row(buildings, 0.01, law))
        };
        let motion = shaking(2.5);
        let answer = |system: &System| {
            let analysis = Analysis {
                tolerance: 1e-5,
                ..Analysis::default()
            };
            let plan = Plan::choose(system, &motion, &analysis).expect("usable steps");
            run(system, &motion, &plan)
        };
        let jumps = answer(&system(LawKind::Restitution, 1e9));
        let jump = |outcome: &Outcome| {
            outcome
                .impacts
                .iter()
                .filter(|i| i.impact_speed > 0.05)
                .count()
        };
        assert!(jump(&jumps) > 3, "{} jumps", jump(&jumps));
        for (kind, stiffnesses) in [
            (LawKind::KelvinNoTension, [1e10, 1e12]),
            (LawKind::HertzDamp, [1e12, 1e15]),
        ] {
            let [soft, stiff] =
                stiffnesses.map(|k| worst_difference(&answer(&system(kind, k)), &jumps));
            assert!(
                stiff < 5e-3 && stiff < 0.5 * soft,
                "{kind:?}: {soft:e}, then {stiff:e}"
            );
        }
    }
}

/// Bodies come to rest against each other: bounces become ever smaller, and what follows is one lasting contact.
#[test]
fn lasting_contact_is_counted_once() {
    for kind in LAWS {
        let mut left = slider("left", 3e4, Some(1e6));
        let mut right = slider("right", 5e4, Some(2e7));
        left.structure.equations.alpha = 2.0;
        right.structure.equations.alpha = 4.0;
        let system = sliders(vec![left, right], 0.01, &law(kind, 0.5));
        let motion = GroundMotion::sampled("constant", 20.0, vec![-1.0; 2]);
        let plan = Plan::choose(&system, &motion, &Analysis::default()).expect("usable steps");
        let outcome = run(&system, &motion, &plan);
        let late: Vec<_> = outcome.impacts.iter().filter(|i| i.start > 10.0).collect();
        assert!(late.is_empty(), "{kind:?}: {} impacts at rest", late.len());
        let last = outcome.impacts.last().expect("they touch");
        assert!(
            !last.finished && last.peak_indentation > 0.0,
            "{kind:?}: {last:?}"
        );
        assert!(
            outcome.impacts.len() < 40,
            "{kind:?}: {}",
            outcome.impacts.len()
        );
        // Counted with a pause of a second between impacts it is all one.
        assert_eq!(counted(&outcome.impacts, 1.0).len(), 1, "{kind:?}");
    }
}

/// Equal floors of equal towers meet at the same instants.
#[test]
fn impacts_at_several_floors_are_seen_together() {
    let system = assembled(&two_frames(0.01, law(LawKind::HertzDamp, 0.65)));
    let outcome = run(&system, &shaking(4.0), &steps(1e-3, 4));
    let mut contacts: Vec<_> = (0..system.contacts.len())
        .map(|index| {
            let impacts = outcome.impacts.iter().filter(|i| i.contact == index);
            let mut impacts: Vec<_> = impacts.collect();
            impacts.sort_by(|a, b| a.start.total_cmp(&b.start));
            counted(impacts, 0.0)
        })
        .collect();
    let poundings = find_simultaneous(&mut contacts);
    assert!(
        poundings.multiple > 0 && poundings.most_at_once > 1,
        "{poundings:?}"
    );
    // The same, instant by instant.
    let all: Vec<_> = contacts.iter().flatten().collect();
    for one in &all {
        let at_start = |t: f64| {
            let during = |other: &&&jostle::results::CountedImpact| {
                other.impact.start <= t && t <= other.impact.end
            };
            all.iter().filter(during).count()
        };
        let overlapping = all.iter().filter(|other| {
            other.impact.start >= one.impact.start && other.impact.start <= one.impact.end
        });
        let most = overlapping.map(|other| at_start(other.impact.start)).max();
        assert_eq!(most, Some(one.simultaneous), "{one:?}");
    }
}
