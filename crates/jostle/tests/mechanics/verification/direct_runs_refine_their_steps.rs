//! Lightly damped frames that hit each other: the steps of the first run are too long, and refined ones hold the tolerance.

use std::ops::ControlFlow;

use jostle::{Analysis, Damping, GroundMotion, LawKind, Plan, RunEnd, Solver, System, simulate};

use crate::verification::support::{EVERYTHING, assembled, law, run, shaking, two_frames};

fn lightly_damped_frames() -> System {
    let mut frames = two_frames(0.02, law(LawKind::Linear, 1.0));
    for frame in &mut frames.buildings {
        frame.damping = Damping::ratio(0.005, [1]);
    }
    assembled(&frames)
}

fn planned(system: &System, motion: &GroundMotion, solver: Solver, tolerance: f64) -> Plan {
    let analysis = Analysis {
        solver: Some(solver),
        tolerance,
        ..Analysis::default()
    };
    Plan::choose(system, motion, &analysis).expect("steps are found")
}

#[test]
fn accelerations_after_impacts_hold_the_tolerance() {
    let (system, motion) = (lightly_damped_frames(), shaking(3.0));
    let plan = planned(&system, &motion, Solver::Riccati, 1e-3);
    let direct = run(&system, &motion, &plan);
    assert!(direct.work.repeated_runs > 0, "{:?}", direct.work);
    let accuracy = direct.accuracy.expect("an estimate");
    assert!(accuracy.residual <= accuracy.tolerance, "{accuracy:?}");
    let modal = run(
        &system,
        &motion,
        &planned(&system, &motion, Solver::Modal, 1e-5),
    );
    for (found, exact) in direct.peaks.buildings().zip(modal.peaks.buildings()) {
        let accelerations = exact.iter().map(|floor| floor.total_acceleration());
        let greatest = accelerations.fold(0.0, f64::max);
        for (found, exact) in found.iter().zip(exact) {
            let error = found.total_acceleration() - exact.total_acceleration();
            assert!(
                error.abs() <= accuracy.tolerance * greatest,
                "{found:?} for {exact:?}"
            );
        }
    }
}

#[test]
fn stopping_a_refinement_keeps_the_run_before_it() {
    let (system, motion) = (lightly_damped_frames(), shaking(3.0));
    let plan = planned(&system, &motion, Solver::Riccati, 1e-3);
    let (mut begun, mut last) = (0, f64::INFINITY);
    // Longer steps, the planned ones, and then the refinement to be stopped.
    let outcome = simulate(&system, &motion, &plan, EVERYTHING, |at| {
        begun += u32::from(at.time < last);
        last = at.time;
        if begun > 2 && at.time > 1.0 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    assert_eq!((begun, &outcome.end), (3, &RunEnd::Completed));
    assert_eq!(*outcome.end_of_all(), RunEnd::Stopped);
    let accuracy = outcome.accuracy.expect("an estimate");
    assert!(accuracy.residual > accuracy.tolerance, "{accuracy:?}");
}
