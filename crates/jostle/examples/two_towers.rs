//! Two shear buildings, several gaps: how many impacts, and how strong. `cargo run -p jostle --example two_towers`

use std::error::Error;
use std::ops::ControlFlow;

use jostle::{
    Analysis, Base, Building, ContactLaw, Damping, Gap, Gravity, GroundMotion, LawKind, Model,
    ModelFault, Plan, RestitutionIs, Settings, Shear, Structure, System, simulate,
};

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

/// A soft tower beside a stiff one, `gap` metres apart.
fn pair(gap: f64) -> Model {
    let law = ContactLaw {
        kind: LawKind::HertzDamp,
        stiffness: 2e9,
        restitution: 0.65,
        restitution_is: RestitutionIs::Realised,
    };
    Model {
        title: "Soft and stiff".to_owned(),
        buildings: vec![tower("soft", 40e3, 20e6), tower("stiff", 60e3, 90e6)],
        gaps: vec![Gap::after(0, gap, law)],
        links: Vec::new(),
        analysis: Analysis::default(),
    }
}

/// Three storeys with masses \[kg\] and stiffnesses \[N/m\].
fn tower(name: &str, mass: f64, stiffness: f64) -> Building {
    Building {
        name: name.to_owned(),
        structure: Structure::Shear(Shear {
            mass: vec![mass; 3],
            stiffness: vec![stiffness; 3],
            storey_heights: vec![3.2; 3],
        }),
        damping: Damping::Ratio {
            ratio: 0.05,
            modes: Vec::new(),
        },
        base: Base::default(),
        gravity: Gravity::default(),
        hinges: None,
    }
}
