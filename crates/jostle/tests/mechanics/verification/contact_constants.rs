//! Contact laws with constants as papers print them: dashpots, two stiffnesses, faces that crush and stay crushed.

use jostle::contact::{BilinearConstants, Crush, Dashpot, DashpotLaw, ForceLaw};
use jostle::{Analysis, ContactLaw, Gap, LawKind, Outcome, Solver, System};
use jostle_testkit::runs::planned;

use super::direct_in_space::{apart, around_a_corner, run as run_in_space};
use super::support::{
    assembled, law, moving, row, run, run_from, shaking, slider, sliders, still, tower, two_frames,
};

const CRUSH: Crush = Crush {
    force: 3e5,
    hardening: 0.05,
    hertzian: false,
};

const CRUSHING: [Crush; 2] = [
    CRUSH,
    Crush {
        hertzian: true,
        ..CRUSH
    },
];

fn crushing() -> ContactLaw {
    law(LawKind::Crushing(CRUSH), 1.0)
}

/// How far a face is pressed by a force, and the work of that on a face that does not crush on.
fn pressed(crush: Crush, stiffness: f64, force: f64) -> [f64; 2] {
    let (exponent, part) = match crush.hertzian {
        true => (2.0 / 3.0, 0.4),
        false => (1.0, 0.5),
    };
    let pressed = (force / stiffness).powf(exponent);
    [pressed, part * force * pressed]
}

/// Slope of the force while the face crushes \[N/m\].
fn slope(crush: Crush, stiffness: f64) -> f64 {
    let [pressed, _] = pressed(crush, stiffness, crush.force);
    let elastic = if crush.hertzian { 1.5 } else { 1.0 };
    crush.hardening * elastic * crush.force / pressed
}

/// Depth to which a face is crushed by the greatest force so far \[N\].
fn depth(crush: Crush, stiffness: f64, force: f64) -> f64 {
    let force = force.max(crush.force);
    let [first, now] = [crush.force, force].map(|force| pressed(crush, stiffness, force)[0]);
    first + (force - crush.force) / slope(crush, stiffness) - now
}

/// One floor beside another, one wall beside the first.
fn towers(law: ContactLaw) -> jostle::Model {
    let buildings = vec![tower("left", 1, 4e4, 0.5), tower("right", 1, 6e4, 0.9)];
    let mut model = row(buildings, 0.02, law);
    let mut wall = Gap::between([None, Some(0)], 0.03, law);
    wall.minimum_separation = 0.0;
    model.gaps.insert(0, wall);
    model
}

fn by(solver: Solver, tolerance: f64) -> Analysis {
    Analysis {
        solver: Some(solver),
        tolerance,
        ..Analysis::default()
    }
}

fn solved(model: &jostle::Model, solver: Solver, tolerance: f64) -> (System, Outcome) {
    let (system, motion) = (assembled(model), shaking(4.0));
    let plan = planned(&system, &motion, &by(solver, tolerance));
    let outcome = run(&system, &motion, &plan);
    (system, outcome)
}

/// The dashpot that a coefficient of restitution gives makes the same run, bit by bit.
#[test]
fn a_given_dashpot_is_that_of_its_coefficient() {
    for (dashpot_law, kind) in [
        (DashpotLaw::Kelvin, LawKind::Kelvin),
        (DashpotLaw::KelvinNoTension, LawKind::KelvinNoTension),
    ] {
        let buildings = || vec![tower("left", 1, 4e4, 0.5), tower("right", 1, 6e4, 0.9)];
        let known = assembled(&row(buildings(), 0.02, law(kind, 0.6)));
        let ForceLaw::Kelvin { damping, .. } = known.contacts[0].law else {
            panic!("a Kelvin law");
        };
        let dashpot = LawKind::Dashpot(Dashpot {
            law: dashpot_law,
            damping,
        });
        let given = assembled(&row(buildings(), 0.02, law(dashpot, 1.0)));
        let motion = shaking(3.0);
        for solver in [Solver::Modal, Solver::Riccati, Solver::Series] {
            let of = |system: &System| {
                let plan = planned(system, &motion, &by(solver, 1e-4));
                run(system, &motion, &plan)
            };
            let (one, other) = (of(&known), of(&given));
            assert!(one.impacts.len() > 3);
            assert_eq!(one.impacts, other.impacts, "{dashpot_law:?}, {solver:?}");
            assert_eq!(one.state, other.state, "{dashpot_law:?}, {solver:?}");
        }
        let e = given.contacts[0].equivalent_restitution(&law(dashpot, 1.0));
        assert!((e.expect("a dashpot") - 0.6).abs() < 1e-12, "{e:?}");
    }
}

/// Unlike a coefficient, it is the same at a floor and at a wall.
#[test]
fn a_given_dashpot_does_not_depend_on_masses() {
    let dashpot = Dashpot {
        law: DashpotLaw::KelvinNoTension,
        damping: 8e5,
    };
    let model = towers(law(LawKind::Dashpot(dashpot), 1.0));
    let system = assembled(&model);
    assert_eq!(system.contacts.len(), 2);
    for contact in &system.contacts {
        let ForceLaw::Kelvin { damping, .. } = contact.law else {
            panic!("a Kelvin law");
        };
        assert_eq!(damping, 8e5);
    }
    let [wall, floor] = [0, 1].map(|index| {
        let e = system.contacts[index].equivalent_restitution(&model.gaps[0].law);
        e.expect("a dashpot")
    });
    // The wall stands for an infinite mass.
    assert!(wall > floor, "{wall}, {floor}");
    let (_, reference) = solved(&model, Solver::Modal, 1e-6);
    let (_, direct) = solved(&model, Solver::Riccati, 1e-6);
    assert!(reference.impacts.len() > 5);
    assert_eq!(reference.impacts.len(), direct.impacts.len());
    for (one, other) in reference.impacts.iter().zip(&direct.impacts) {
        assert!((one.start - other.start).abs() < 1e-6, "{one:?}, {other:?}");
    }
}

/// Points of a face share dashpot, second stiffness and crushing force; modes and direct steps agree on them.
#[test]
fn faces_of_plans_share_the_constants() {
    let kinds = [
        LawKind::Dashpot(Dashpot {
            law: DashpotLaw::Kelvin,
            damping: 1.5e6,
        }),
        LawKind::BilinearGiven(BilinearConstants {
            second_stiffness: 9e7,
            yield_indentation: 1e-3,
        }),
        LawKind::Crushing(Crush {
            force: 4e5,
            hardening: 0.1,
            hertzian: false,
        }),
    ];
    for kind in kinds {
        let whole = ContactLaw {
            stiffness: 3e8,
            ..law(kind, 1.0)
        };
        let (model, motion) = around_a_corner(whole);
        let (system, reference) = run_in_space(&model, &motion, by(Solver::Modal, 1e-6));
        let of_face = |face: usize| {
            let contacts = system.contacts.iter();
            contacts.filter(move |contact| contact.plan.is_some_and(|place| place.face == face))
        };
        let first: Vec<f64> = of_face(0)
            .map(|face| match face.law {
                ForceLaw::Kelvin { damping, .. } => damping / 1.5e6,
                ForceLaw::Bilinear(bilinear) => bilinear.second_stiffness / 9e7,
                ForceLaw::Crushing(crushing) => crushing.force / 4e5,
                ref other => panic!("{other:?}"),
            })
            .collect();
        assert!(first.len() > 1);
        assert!((first.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{first:?}");
        assert!(reference.face_impacts.len() > 3);
        // Where sliders start and stop, direct steps are a little beyond their tolerance.
        let [_, (_, direct)] = [1e-3, 1e-4].map(|tolerance| {
            let run = run_in_space(&model, &motion, by(Solver::Riccati, tolerance));
            let error = apart(&reference, &run.1);
            assert!(error < 3.0 * tolerance, "{kind:?}, {tolerance}: {error}");
            run
        });
        if let LawKind::Crushing(_) = kind {
            let crushed = |outcome: &Outcome| -> Vec<f64> {
                (0..system.contacts.len())
                    .map(|point| outcome.state.crushed_depth(point))
                    .collect()
            };
            let (one, other) = (crushed(&reference), crushed(&direct));
            let most = one.iter().fold(0.0_f64, |most, value| most.max(*value));
            assert!(most > 1e-3, "{most}");
            for (a, b) in one.iter().zip(&other) {
                assert!((a - b).abs() < 1e-3 * most, "{a}, {b}");
            }
        }
    }
}

/// A mass on a spring that hits a wall again and again: every impact begins where the last one has left the face, with the
/// energy that is left, and what it dissipates is the area that the face is crushed by.
#[test]
fn a_crushed_gap_stays_wider() {
    for crush in CRUSHING {
        stays_wider(crush);
    }
}

fn stays_wider(crush: Crush) {
    let own_law = law(LawKind::Crushing(crush), 1.0);
    let (mass, spring, width, speed) = (5e4, 2e6, 0.01, 0.6);
    let heavy = slider("heavy", 1e30, None);
    let system = sliders(
        vec![slider("light", mass, Some(spring)), heavy],
        width,
        &own_law,
    );
    let stiffness = own_law.stiffness;
    let motion = still(4.0);
    let plan = planned(&system, &motion, &by(Solver::Riccati, 1e-6));
    let state = moving(&system, &[0.0, 0.0], &[speed, 0.0]);
    let outcome = run_from(&system, &motion, &plan, state);
    assert!(outcome.impacts.len() > 3, "{:?}", outcome.impacts);
    let (mut energy, mut hardest) = (0.5 * mass * speed * speed, crush.force);
    for impact in outcome.impacts.iter().filter(|impact| impact.finished) {
        let before = depth(crush, stiffness, hardest);
        let face = width + before;
        let closing = (2.0 * (energy - 0.5 * spring * face * face) / mass).sqrt();
        assert!(
            (impact.impact_speed / closing - 1.0).abs() < 1e-5,
            "{closing}: {impact:?}"
        );
        let last = hardest;
        hardest = hardest.max(impact.peak_force);
        let crushed = depth(crush, stiffness, hardest) - before;
        let works = [last, hardest].map(|force| pressed(crush, stiffness, force)[1]);
        let further = (hardest - last) / slope(crush, stiffness);
        let lost = 0.5 * (last + hardest) * further + works[0] - works[1];
        assert!(
            (impact.dissipated - lost).abs() < 1e-5 * energy,
            "{lost}: {impact:?}"
        );
        let indentation = crushed + pressed(crush, stiffness, impact.peak_force)[0];
        assert!(
            (impact.peak_indentation - indentation).abs() < 1e-6 * width,
            "{indentation}: {impact:?}"
        );
        energy -= lost;
    }
    let found = outcome.state.crushed_depth(0);
    let due = depth(crush, stiffness, hardest);
    assert!((found / due - 1.0).abs() < 1e-6, "{found}, {due}");
    // Later impacts find a face that bears them.
    assert!(outcome.impacts[1].dissipated < 1e-3 * outcome.impacts[0].dissipated);
}

/// All ways of stepping remember what is crushed, and energies balance.
#[test]
fn all_steppers_crush_alike() {
    for crush in CRUSHING {
        crush_alike(crush);
    }
}

fn crush_alike(crush: Crush) {
    let own_law = law(LawKind::Crushing(crush), 1.0);
    let model = towers(own_law);
    let (system, reference) = solved(&model, Solver::Modal, 1e-6);
    assert!(reference.impacts.len() > 5);
    for contact in 0..system.contacts.len() {
        let impacts = reference
            .impacts
            .iter()
            .filter(|impact| impact.contact == contact);
        let hardest = impacts.fold(0.0, |most: f64, impact| most.max(impact.peak_force));
        let due = depth(crush, own_law.stiffness, hardest);
        let found = reference.state.crushed_depth(contact);
        assert!(
            due > 1e-3 && (found / due - 1.0).abs() < 1e-6,
            "{found}, {due}"
        );
    }
    for solver in [
        Solver::Series,
        Solver::Riccati,
        Solver::Stiffness,
        Solver::Product,
    ] {
        let (_, other) = solved(&model, solver, 1e-6);
        let balance = other.energy.worst_imbalance;
        assert!(balance < 1e-6, "{solver:?}: {balance}");
        assert_eq!(reference.impacts.len(), other.impacts.len(), "{solver:?}");
        for contact in 0..system.contacts.len() {
            let [one, two] =
                [&reference, &other].map(|outcome| outcome.state.crushed_depth(contact));
            assert!((one / two - 1.0).abs() < 1e-4, "{solver:?}: {one}, {two}");
        }
    }
    let taken = reference.impacts.iter().map(|impact| impact.dissipated);
    let taken: f64 = taken.sum();
    assert!(
        (reference.energy.contact / taken - 1.0).abs() < 1e-9,
        "{taken}"
    );
    assert!(reference.energy.worst_imbalance < 1e-10);
}

/// Frames of several floors, each contact with its own memory; without contact nothing is crushed.
#[test]
fn every_contact_crushes_by_itself() {
    let model = two_frames(0.01, crushing());
    let (system, outcome) = solved(&model, Solver::Modal, 1e-5);
    let depths: Vec<f64> = (0..system.contacts.len())
        .map(|contact| outcome.state.crushed_depth(contact))
        .collect();
    for (contact, found) in depths.iter().enumerate() {
        let impacts = outcome
            .impacts
            .iter()
            .filter(|impact| impact.contact == contact);
        let hardest = impacts.fold(0.0, |most: f64, impact| most.max(impact.peak_force));
        let due = depth(CRUSH, crushing().stiffness, hardest);
        assert!(
            (found - due).abs() <= 1e-6 * due,
            "{contact}: {found}, {due}"
        );
    }
    assert!(depths.iter().any(|own| *own > 0.0) && depths.windows(2).any(|own| own[0] != own[1]));
    let far = assembled(&two_frames(5.0, crushing()));
    let motion = shaking(2.0);
    let plan = planned(&far, &motion, &by(Solver::Modal, 1e-4));
    assert_eq!(run(&far, &motion, &plan).state.crushed_depth(0), 0.0);
}
