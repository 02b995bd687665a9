//! Buildings in space by direct steps: the same peaks as by their modes, and the same steps by two eliminations.

use crate::verification::support::base_shears;
use jostle::history::PeaksOf;
use jostle::system::Direction;
use jostle::{
    Analysis, Bearing, ContactLaw, Gap, GroundMotion, LawKind, Model, Outcome, Plan, Solver, System,
};
use jostle_testkit::models::{CONCRETE, rectangle};
use jostle_testkit::motions::fading;
use jostle_testkit::runs::{assembled, completed, planned};

use super::space::tower;

/// A shaking without symmetry, 6 s long.
fn shaking(name: &str, rate: f64) -> GroundMotion {
    fading(name, rate, [1.0, 3.0], 300)
}

/// Three eccentric towers around a corner, shaken along a bearing and across it.
pub(crate) fn around_a_corner(law: ContactLaw) -> (Model, GroundMotion) {
    let plans = [
        rectangle(0.0, 0.0, 12.0, 10.0),
        rectangle(12.02, 2.0, 9.0, 7.0),
        rectangle(1.0, 10.02, 10.0, 8.0),
    ];
    let buildings = vec![
        tower("corner", 3, [150e3, 60e6], &plans[0], [1.0, -0.5]),
        tower("right", 2, [100e3, 150e6], &plans[1], [-0.4, 0.3]),
        tower("behind", 3, [110e3, 170e6], &plans[2], [0.5, 0.6]),
    ];
    let gap = |a: usize, b: usize| Gap::between([Some(a), Some(b)], 0.02, law);
    let mut motion = shaking("along", 7.0);
    motion.bearing = Some(Box::new(Bearing {
        angle: 0.4,
        across: Some(shaking("across", 5.3)),
    }));
    let model = Model {
        title: "corner".to_owned(),
        buildings,
        gaps: vec![gap(0, 1), gap(0, 2)],
        ..Model::default()
    };
    (model, motion)
}

pub(crate) fn run(model: &Model, motion: &GroundMotion, analysis: Analysis) -> (System, Outcome) {
    let system = assembled(model);
    let plan = planned(&system, motion, &analysis);
    let outcome = completed(&system, motion, &plan, None);
    let worst = outcome.energy.worst_imbalance;
    assert!(worst < 1e-4, "{worst}");
    (system, outcome)
}

/// Peaks of every kind of every building, and forces of faces.
fn peaks(outcome: &Outcome) -> Vec<Vec<f64>> {
    let mut kinds = Vec::new();
    for along in outcome.peaks.buildings() {
        for direction in [Direction::Along, Direction::Across, Direction::Turning] {
            let floors = || along.iter().map(|floor| floor.to(direction));
            kinds.push(floors().map(|f| f.displacement_max().value).collect());
            kinds.push(floors().map(|f| f.displacement_min().value).collect());
            kinds.push(floors().map(|f| f.storey_drift()).collect());
            kinds.push(floors().map(|f| f.total_acceleration()).collect());
            kinds.push(floors().map(|f| f.storey_shear()).collect());
            kinds.push(floors().map(|f| f.overturning_moment()).collect());
        }
        kinds.push(along.iter().map(PeaksOf::corner_displacement).collect());
    }
    kinds.push(base_shears(outcome));
    let faces = outcome.face_impacts.iter();
    kinds.push(faces.map(|impact| impact.peak_force.value).collect());
    kinds
}

pub(crate) fn apart(a: &Outcome, b: &Outcome) -> f64 {
    let mut worst = 0.0_f64;
    for (peak, other) in peaks(a).iter().zip(&peaks(b)) {
        assert_eq!(peak.len(), other.len());
        let greatest = peak
            .iter()
            .fold(0.0_f64, |most, value| most.max(value.abs()));
        for (a, b) in peak.iter().zip(other) {
            worst = worst.max((a - b).abs() / greatest);
        }
    }
    worst
}

/// Modes and direct steps share neither equations nor steps.
#[test]
fn direct_steps_have_the_peaks_of_modes() {
    for kind in [LawKind::HertzDamp, LawKind::Linear, LawKind::Kelvin] {
        let (model, motion) = around_a_corner(ContactLaw {
            kind,
            stiffness: if kind == LawKind::HertzDamp { 2e9 } else { 3e8 },
            ..CONCRETE
        });
        let modal = Analysis {
            tolerance: 1e-6,
            ..Analysis::default()
        };
        let (_, reference) = run(&model, &motion, modal);
        assert!(reference.face_impacts.len() > 5);
        for tolerance in [1e-3, 1e-4] {
            let direct = Analysis {
                tolerance,
                solver: Some(Solver::Riccati),
                ..Analysis::default()
            };
            let (_, outcome) = run(&model, &motion, direct);
            let error = apart(&reference, &outcome);
            assert!(error < tolerance, "{kind:?}, {tolerance}: {error}");
        }
    }
}

/// The same matrices, factorised along the transfer path and by a general sparse elimination.
#[test]
fn two_eliminations_have_the_same_steps() {
    let (model, motion) = around_a_corner(CONCRETE);
    let [one, other] = [Solver::Riccati, Solver::Stiffness].map(|solver| {
        let analysis = Analysis {
            step: Some(2e-3),
            contact_step: Some(5e-5),
            solver: Some(solver),
            ..Analysis::default()
        };
        run(&model, &motion, analysis).1
    });
    let error = apart(&one, &other);
    assert!(error < 1e-8, "{error}");
}

/// Bodies that hit at single points by the momentum law lose energy, and steps account for it.
#[test]
fn momentum_laws_act_in_space() {
    let (model, motion) = around_a_corner(ContactLaw {
        kind: LawKind::Restitution,
        stiffness: 1e8,
        ..CONCRETE
    });
    let [one, other] = [Solver::Riccati, Solver::Modal].map(|solver| {
        let analysis = Analysis {
            solver: Some(solver),
            tolerance: 1e-4,
            ..Analysis::default()
        };
        run(&model, &motion, analysis).1
    });
    // Rounding of equilibrium over short steps.
    assert!(one.energy.contact > 0.0 && one.energy.worst_imbalance < 1e-6);
    let [a, b] = [&one, &other].map(|run| {
        run.impacts
            .first()
            .map(|impact| (impact.start, impact.impulse))
    });
    let (Some((a, impulse)), Some((b, expected))) = (a, b) else {
        panic!("no impacts")
    };
    assert!((a - b).abs() < 1e-4 && (impulse - expected).abs() < 1e-3 * expected);
}

/// Friction along faces, by modes with predicted paths and by steps that hold its limits.
#[test]
fn friction_is_that_of_modes() {
    let (mut model, motion) = around_a_corner(CONCRETE);
    for gap in &mut model.gaps {
        gap.in_plan.friction = 0.4;
    }
    let steps = Analysis {
        tolerance: 1e-4,
        solver: Some(Solver::Riccati),
        ..Analysis::default()
    };
    let modes = Analysis {
        tolerance: 1e-5,
        ..Analysis::default()
    };
    let [direct, modal] = [steps, modes].map(|analysis| run(&model, &motion, analysis).1);
    let error = apart(&modal, &direct);
    assert!(error < 1e-4, "{error}");
    let [a, b] = [&direct, &modal].map(|run| run.energy.friction);
    assert!(b > 100.0 && (a / b - 1.0).abs() < 1e-4, "{a} against {b} J");
    let peak = |run: &Outcome| {
        let faces = run.face_impacts.iter();
        faces.fold(0.0_f64, |most, face| most.max(face.peak_friction.value))
    };
    // The slip that turns within a step counts.
    let (a, b) = (peak(&direct), peak(&modal));
    assert!((a / b - 1.0).abs() < 1e-4, "{a} against {b} N");
}

#[test]
fn what_direct_steps_cannot_do_in_space_is_refused() {
    let (model, motion) = around_a_corner(CONCRETE);
    let system = System::assemble(&model).expect("a sound model");
    let said = |solver: Solver| {
        let analysis = Analysis {
            solver: Some(solver),
            ..Analysis::default()
        };
        Plan::choose(&system, &motion, &analysis).expect_err("refused")
    };
    assert!(said(Solver::Product)[0].problem.contains("riccati"));
    assert!(said(Solver::Series)[0].problem.contains("plan"));
}
