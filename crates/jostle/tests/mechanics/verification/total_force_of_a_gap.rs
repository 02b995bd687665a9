//! The peak of the total force of a gap is that of the sum of its contact forces over time.

use jostle::{Column, LawKind, Plan, Solver};

use crate::verification::support::{LAWS, assembled, column, law, run, shaking, two_frames};

/// The history has every step in contact, so its greatest sum is at most the peak, and misses it by what a force gains
/// within one step.
#[test]
fn it_is_the_greatest_sum_of_the_recorded_forces() {
    let motion = shaking(6.0);
    for solver in [Solver::Riccati, Solver::Modal] {
        let mut several = 0;
        for kind in LAWS {
            if kind == LawKind::Restitution {
                continue;
            }
            let mut model = two_frames(0.01, law(kind, 0.65));
            model.analysis.solver = Some(solver);
            let system = assembled(&model);
            let plan = Plan::choose(&system, &motion, &model.analysis).expect("it can be run");
            let outcome = run(&system, &motion, &plan);
            let contacts = 0..system.contacts.len();
            let forces: Vec<Vec<f64>> = contacts
                .map(|contact| column(&outcome, Column::contact_force(contact)))
                .collect();
            let sums = (0..forces[0].len()).map(|row| forces.iter().map(|force| force[row]).sum());
            let recorded = sums.fold(0.0, f64::max);
            let total = outcome.peaks.gap_force(0);
            let strongest = outcome.impacts.iter().map(|impact| impact.peak_force);
            let strongest = strongest.fold(0.0, f64::max);
            assert!(
                recorded <= total.value * (1.0 + 1e-9) && total.value <= 1.005 * recorded,
                "{kind:?}, {solver:?}: {total:?} against {recorded} N of the history"
            );
            assert!(
                total.value >= strongest * (1.0 - 1e-9),
                "{kind:?}, {solver:?}: one contact alone has {strongest} N of {total:?}"
            );
            several += usize::from(total.value > 1.05 * strongest);
        }
        assert!(
            several > 5,
            "{solver:?}: {several} laws with several contacts at once"
        );
    }
}
