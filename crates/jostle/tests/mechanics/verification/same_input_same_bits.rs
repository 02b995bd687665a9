use jostle::LawKind;

use crate::verification::support::{assembled, law, run, shaking, steps, two_frames};

#[test]
fn same_input_same_bits_again_and_on_any_thread() {
    let model = two_frames(0.01, law(LawKind::HertzDamp, 0.65));
    let motion = shaking(2.0);
    let plan = steps(1e-3, 4);
    let answer = || {
        // Assembly as well: modes and orders of elimination must not vary.
        let outcome = run(&assembled(&model), &motion, &plan);
        let history = outcome.history.as_ref().expect("histories are recorded");
        let mut bits: Vec<u64> = (0..history.len())
            .flat_map(|k| history.row(k).to_vec())
            .map(f64::to_bits)
            .collect();
        for impact in &outcome.impacts {
            bits.extend(
                [impact.start, impact.end, impact.peak_force, impact.impulse].map(f64::to_bits),
            );
        }
        (bits, outcome.work)
    };
    let first = answer();
    assert!(first.1.contact_steps > 0, "the run must have impacts");
    assert!(answer() == first, "a second run differs");
    std::thread::scope(|scope| {
        let runs: Vec<_> = (0..4).map(|_| scope.spawn(answer)).collect();
        for run in runs {
            assert!(
                run.join().expect("the thread ends") == first,
                "a run on another thread differs"
            );
        }
    });
}
