//! Two one-storey towers under harmonic motion, as observed on a shake table by K. T. Chau, X. X. Wei, X. Guo and
//! C. Y. Shen (2003), *Experimental and theoretical simulations of seismic poundings between two adjacent
//! structures*, Earthquake Engineering and Structural Dynamics 32: impacts are fastest between the natural
//! frequencies; pounding amplifies the stiffer tower and calms the softer one. Masses, periods and damping here are
//! chosen freely. The first observation holds over the whole sweep. The second holds around the natural frequency of
//! the softer tower; around that of the stiffer one the two exchange their parts.

use std::f64::consts::TAU;

use jostle::{GroundMotion, LawKind, Plan, System};

use crate::verification::support::{assembled, column, largest, law, row, run, steps, tower};

/// Natural frequencies of the soft tower on the left and of the stiff one \[Hz\].
const NATURAL: [f64; 2] = [1.0, 2.0];
const DURATION: f64 = 30.0;
/// Results count from here on, when starting has died away \[s\].
const SETTLED: f64 = 15.0;

/// Peaks of the steady state.
struct Steady {
    impact_speed: f64,
    /// Displacement of the soft and the stiff tower \[m\].
    displacement: [f64; 2],
}

fn towers(gap: f64) -> System {
    let [soft, stiff] = NATURAL.map(|frequency| tower("tower", 1, 1e5, 1.0 / frequency));
    let mut model = row(vec![soft, stiff], gap, law(LawKind::HertzDamp, 0.6));
    model.buildings[1].name = "stiff".to_owned();
    assembled(&model)
}

fn shaken(system: &System, frequency: f64, plan: &Plan) -> Steady {
    let step = 0.002;
    let count = (DURATION / step).round() as usize;
    let values = (0..=count).map(|k| {
        let t = k as f64 * step;
        (t / 3.0).min(1.0) * (TAU * frequency * t).sin()
    });
    let motion = GroundMotion::sampled("harmonic", step, values.collect());
    let outcome = run(system, &motion, plan);
    let settled = outcome
        .impacts
        .iter()
        .filter(|impact| impact.start >= SETTLED);
    let displacement = [0, 1].map(|building| {
        let all = column(&outcome, jostle::Column::displacement(building, 1));
        let from = (all.len() as f64 * SETTLED / DURATION) as usize;
        largest(&all[from..])
    });
    Steady {
        impact_speed: settled
            .map(|impact| impact.impact_speed)
            .fold(0.0, f64::max),
        displacement,
    }
}

#[test]
fn impacts_are_fastest_between_the_natural_frequencies_and_each_tower_is_calmed_at_its_own() {
    let (together, apart) = (towers(0.01), towers(10.0));
    let plan = steps(0.002, 20);
    let mut fastest = (0.0, 0.0);
    let mut ratios = Vec::new();
    for k in 0..=40 {
        let frequency = 0.5 + 0.05 * f64::from(k);
        let (with, without) = (
            shaken(&together, frequency, &plan),
            shaken(&apart, frequency, &plan),
        );
        let ratio = [0, 1].map(|b| with.displacement[b] / without.displacement[b]);
        if with.impact_speed > fastest.1 {
            fastest = (frequency, with.impact_speed);
        }
        ratios.push((frequency, ratio));
    }
    assert!(
        NATURAL[0] < fastest.0 && fastest.0 < NATURAL[1],
        "{} m/s at {} Hz",
        fastest.1,
        fastest.0
    );
    for tower in [0, 1] {
        let near = |(frequency, _): &&(f64, _)| (frequency / NATURAL[tower] - 1.0).abs() < 0.06;
        for (frequency, ratio) in ratios.iter().filter(near) {
            assert!(ratio[tower] < 0.5, "{tower} at {frequency} Hz: {ratio:?}");
            assert!(
                ratio[1 - tower] > 2.0,
                "{tower} at {frequency} Hz: {ratio:?}"
            );
        }
    }
}
