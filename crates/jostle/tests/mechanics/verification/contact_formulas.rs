//! A law written as a formula gives the run of the law that it writes, whatever the stepper, in one plane and in space.

use jostle::contact::Formula;
use jostle::{Analysis, ContactLaw, LawKind, Outcome, Solver};
use jostle_testkit::runs::planned;

use super::direct_in_space::{apart, around_a_corner, run as run_in_space};
use super::support::{assembled, law, row, run, shaking, tower};

const E: f64 = 0.6;

/// A law, the formula of it, and its stiffness.
const WRITTEN: [(LawKind, &str, f64); 3] = [
    (
        LawKind::HertzDamp,
        "k * d^1.5 * (1 + 0.75 * (1 - e^2) * v / v0)",
        2e9,
    ),
    (
        LawKind::KelvinNoTension,
        "k*d + 2*v*sqrt(k*m) * (-ln(e)) / sqrt(9.869604401089358 + ln(e)^2)",
        2e8,
    ),
    (
        LawKind::Linear,
        "if(d < 0.001, k*d, k*0.001 + k*(d - 0.001))",
        2e8,
    ),
];

fn written(text: &str, stiffness: f64) -> ContactLaw {
    let formula = Formula::parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    ContactLaw {
        stiffness,
        ..law(LawKind::Formula(formula), E)
    }
}

fn by(solver: Solver, tolerance: f64) -> Analysis {
    Analysis {
        solver: Some(solver),
        tolerance,
        ..Analysis::default()
    }
}

/// Greatest differences of forces and impulses, relative to the greatest.
fn impacts_apart(one: &Outcome, other: &Outcome) -> f64 {
    assert_eq!(one.impacts.len(), other.impacts.len());
    let most = |of: &dyn Fn(&jostle::Impact) -> f64| {
        let all = one.impacts.iter().map(of);
        let scale = all.fold(0.0_f64, f64::max);
        let pairs = one.impacts.iter().zip(&other.impacts);
        pairs
            .map(|(a, b)| (of(a) - of(b)).abs() / scale)
            .fold(0.0, f64::max)
    };
    most(&|impact| impact.peak_force).max(most(&|impact| impact.impulse))
}

#[test]
fn formulas_make_the_runs_of_their_laws() {
    for (kind, text, stiffness) in WRITTEN {
        let of = |law: ContactLaw, solver, tolerance| {
            let buildings = vec![tower("left", 3, 4e4, 0.5), tower("right", 2, 6e4, 0.9)];
            let (system, motion) = (assembled(&row(buildings, 0.02, law)), shaking(4.0));
            let plan = planned(&system, &motion, &by(solver, tolerance));
            run(&system, &motion, &plan)
        };
        let built_in = ContactLaw {
            stiffness,
            ..law(kind, E)
        };
        for (solver, tolerance) in [
            (Solver::Modal, 1e-6),
            (Solver::Series, 1e-6),
            (Solver::Riccati, 1e-4),
        ] {
            let one = of(built_in, solver, tolerance);
            let other = of(written(text, stiffness), solver, tolerance);
            assert!(one.impacts.len() > 3);
            let error = impacts_apart(&one, &other);
            assert!(error < 3.0 * tolerance, "{text}, {solver:?}: {error}");
        }
    }
}

/// Points of a face share a formula as they share its law.
#[test]
fn faces_of_plans_share_a_formula() {
    for (kind, text, stiffness) in WRITTEN {
        let built_in = ContactLaw {
            stiffness,
            ..law(kind, E)
        };
        let [one, other] = [built_in, written(text, stiffness)].map(|law| {
            let (model, motion) = around_a_corner(law);
            run_in_space(&model, &motion, by(Solver::Modal, 1e-6)).1
        });
        assert!(one.face_impacts.len() > 3);
        let error = apart(&one, &other);
        assert!(error < 3e-6, "{text}: {error}");
    }
}
