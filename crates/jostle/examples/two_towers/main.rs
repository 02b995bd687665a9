//! Two shear buildings, several gaps: how many impacts, and how strong. `cargo run -p jostle --example two_towers`

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;
use std::ops::ControlFlow;

use jostle::{GroundMotion, ModelFault, Plan, Settings, System, simulate};

mod pair;

use pair::pair;

fn main() -> Result<(), Box<dyn Error>> {
    // Ten seconds of a sine that grows and fades, 3 m/s² at its peak.
    let wave = (0..=1000)
        .map(|i| {
            let t = 0.01 * f64::from(i);
            3.0 * (0.1 * std::f64::consts::PI * t).sin() * (9.0 * t).sin()
        })
        .collect();
    let motion = GroundMotion::sampled("growing and fading sine", 0.01, wave);
    println!("gap [mm]  impacts  peak force [kN]  energy imbalance");
    for gap in [0.01, 0.02, 0.05, 0.1, 0.2] {
        let model = pair(gap);
        let system = System::assemble(&model).map_err(first)?;
        let plan = Plan::choose(&system, &motion, &model.analysis).map_err(first)?;
        let settings = Settings {
            record_interval: None,
            ..Settings::default()
        };
        let outcome = simulate(&system, &motion, &plan, settings, |_| {
            ControlFlow::Continue(())
        });
        let peak = outcome
            .impacts
            .iter()
            .fold(0.0_f64, |peak, impact| peak.max(impact.peak_force));
        println!(
            "{:8.0}  {:7}  {:15.1}  {:16.0e}",
            gap * 1e3,
            outcome.impacts.len(),
            peak * 1e-3,
            outcome.energy.imbalance()
        );
    }
    Ok(())
}

/// The first of several faults.
fn first(faults: Vec<ModelFault>) -> Box<dyn Error> {
    faults
        .into_iter()
        .next()
        .map_or_else(|| "no fault named".into(), Into::into)
}
