//! What forces of columns and beams add to the time of a modal run.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use jostle::{
    Analysis, Building, Frame, Gap, GroundMotion, MemberRequest, Model, Plan, Section, Settings,
    Solver, Structure, System, simulate,
};
use jostle_testkit::models::{self, CONCRETE_REALISED, bending};

fn building(name: &str, storeys: usize) -> Building {
    let section = |rigidity: f64| Section {
        line_mass: 625.0,
        ..bending(rigidity)
    };
    let frame = Frame {
        beam_mass: vec![3600.0; storeys],
        column_segments: 4,
        beam_segments: vec![3, 7],
        ..models::frame(storeys, &[2.4, 6.0], section(1.56e8), section(1.62e8))
    };
    models::building(name, Structure::Frame(frame))
}

/// Frames of five and ten storeys, 100 mm apart.
fn model(members: MemberRequest) -> Model {
    Model {
        title: "Five and ten storeys".to_owned(),
        buildings: vec![building("J1", 5), building("J2", 10)],
        gaps: vec![Gap::after(0, 0.03, CONCRETE_REALISED)],
        analysis: Analysis {
            members,
            ..Analysis::default()
        },
        ..Model::default()
    }
}

/// Thirty seconds of many sines that rise and fall.
fn motion() -> GroundMotion {
    let wave = (0..=1500).map(|i| {
        let t = 0.02 * f64::from(i);
        let strength = (t / 4.0).min(1.0) * (-0.1 * (t - 8.0).max(0.0)).exp();
        let sum: f64 = (1..=40)
            .map(|k| {
                let k = f64::from(k);
                (0.35 * k * std::f64::consts::TAU * t + 2.4 * k * k).sin() / (1.0 + 0.05 * k)
            })
            .sum();
        0.45 * strength * sum
    });
    GroundMotion::sampled("sines", 0.02, wave.collect())
}

fn least_time(members: MemberRequest) -> Duration {
    let model = model(members);
    let system = System::assemble(&model).expect("sound");
    let motion = motion();
    let analysis = Analysis {
        solver: Some(Solver::Modal),
        ..model.analysis.clone()
    };
    let plan = Plan::choose(&system, &motion, &analysis).expect("planned");
    let settings = Settings {
        record_interval: None,
        ..Settings::default()
    };
    let run = |_| {
        let start = Instant::now();
        let outcome = simulate(&system, &motion, &plan, settings, |_| {
            ControlFlow::Continue(())
        });
        let time = start.elapsed();
        assert!(!outcome.impacts.is_empty());
        time
    };
    (0..40).map(run).min().expect("some")
}

#[test]
#[ignore = "measures time"]
fn envelopes_cost_a_share_of_the_run() {
    let [plain, with] = [MemberRequest::default(), MemberRequest::all()].map(least_time);
    let share = with.as_secs_f64() / plain.as_secs_f64() - 1.0;
    println!("without {plain:?}, with {with:?}: {:+.0} %", 100.0 * share);
}
