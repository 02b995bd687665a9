use crate::verification::support::{
    LAWS, assembled, law, row, run, shaking, steps, tower, two_frames,
};

#[test]
fn energy_balances_for_frames_under_every_law() {
    for kind in LAWS {
        let system = assembled(&two_frames(0.01, law(kind, 0.6)));
        for (step, division) in [(1e-3, 1), (2e-3, 2), (5e-3, 4)] {
            let outcome = run(&system, &shaking(3.0), &steps(step, division));
            assert!(
                !outcome.impacts.is_empty(),
                "{kind:?} at h = {step} s: no impacts"
            );
            let worst = outcome.energy.worst_imbalance;
            assert!(
                worst <= 1e-9,
                "{kind:?} at h = {step}/{division} s: {worst:e} of the energy is missing"
            );
        }
    }
}

#[test]
fn energy_balances_in_a_row_of_towers() {
    for kind in LAWS {
        let towers = vec![
            tower("left", 4, 3e4, 0.5),
            tower("middle", 5, 5e4, 0.8),
            tower("right", 3, 4e4, 0.35),
        ];
        let system = assembled(&row(towers, 0.004, law(kind, 0.5)));
        let outcome = run(&system, &shaking(4.0), &steps(2e-3, 4));
        assert!(
            outcome.impacts.len() > 10,
            "{kind:?}: {} impacts",
            outcome.impacts.len()
        );
        let worst = outcome.energy.worst_imbalance;
        assert!(
            worst <= 1e-9,
            "{kind:?}: {worst:e} of the energy is missing"
        );
    }
}

#[test]
fn contacts_and_dampers_only_take_energy() {
    for kind in LAWS {
        let system = assembled(&two_frames(0.01, law(kind, 0.6)));
        let outcome = run(&system, &shaking(3.0), &steps(1e-3, 8));
        assert!(
            outcome.energy.damped > 0.0,
            "{kind:?}: damping takes {} J",
            outcome.energy.damped
        );
        let elastic = !kind.is_dissipative();
        // What is under way when the run ends still stores energy.
        let over = |impact: &&jostle::Impact| impact.end < outcome.state.time;
        for impact in outcome.impacts.iter().filter(over) {
            let met = impact.peak_force * impact.peak_indentation;
            if elastic {
                // The trapezoidal rule conserves the energy of an elastic impact up to the order of the step.
                assert!(
                    impact.dissipated.abs() <= 2e-2 * met,
                    "{kind:?}: {impact:?}"
                );
            } else {
                assert!(impact.dissipated > 0.0, "{kind:?} gives energy: {impact:?}");
            }
        }
    }
}
