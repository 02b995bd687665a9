use jostle::{Column, LawKind};

use crate::verification::support::{
    LAWS, assembled, column, law, row, run, shaking, steps, tower, two_frames,
};

#[test]
fn forces_never_pull_except_under_the_kelvin_law() {
    let towers = row(
        vec![
            tower("left", 4, 3e4, 0.5),
            tower("middle", 5, 5e4, 0.8),
            tower("right", 3, 4e4, 0.35),
        ],
        0.003,
        law(LawKind::Hertz, 0.4),
    );
    for kind in LAWS {
        for mut model in [towers.clone(), two_frames(0.01, law(kind, 0.4))] {
            for gap in &mut model.gaps {
                gap.law = law(kind, 0.4);
            }
            let system = assembled(&model);
            let outcome = run(&system, &shaking(3.0), &steps(2e-3, 4));
            assert!(!outcome.impacts.is_empty(), "{kind:?}: no impacts");
            let forces: Vec<f64> = (0..system.contacts.len())
                .flat_map(|contact| column(&outcome, Column::contact_force(contact)))
                .collect();
            let least = forces
                .iter()
                .fold(0.0_f64, |least, force| least.min(*force));
            if kind == LawKind::Kelvin {
                assert!(least < 0.0, "the published Kelvin law pulls before release");
            } else {
                assert!(least >= 0.0, "{kind:?} pulls with {least} N");
            }
            assert!(
                outcome.impacts.iter().all(|impact| impact.impulse > 0.0),
                "{kind:?}: impulses push"
            );
        }
    }
}
