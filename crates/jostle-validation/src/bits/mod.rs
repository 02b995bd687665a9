//! Digests of the results of many models. A change of structure must not change them.

use std::fmt::Write;
use std::ops::ControlFlow;

use jostle::stepping::find_sensitivity;
use jostle::{Column, Outcome, Plan, Pounding, Run, Settings, Summary, System, simulate};
use rayon::prelude::*;
use serde_json::Value;
use sha2::{Digest, Sha256};

mod in_plane;

use in_plane::{Case, cases};

/// One run and the digest of its results.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pin {
    /// Model and solver.
    pub name: String,
    /// SHA-256 of summary, impacts and histories, shortened; or that the solver refuses the model.
    pub digest: String,
}

/// Keys that digests omit: the wall time, and numbers of the summary that were added after the digests were recorded.
const OMITTED: [&str; 3] = ["wall_s", "total_force_peak_n", "total_force_peak_at_s"];

/// The same among the numbers of a building itself.
const OMITTED_OF_BUILDINGS: [&str; 6] = [
    "drift_peak",
    "total_acceleration_peak_m_s2",
    "residual_drift_peak",
    "hinges_cracked",
    "hinges_yielded",
    "ductility",
];

fn is_omitted(path: &str, key: &str) -> bool {
    let of_building = path.starts_with(".buildings[") && path.find(']') == Some(path.len() - 1);
    OMITTED.contains(&key) || (of_building && OMITTED_OF_BUILDINGS.contains(&key))
}

/// Feeds every number of a tree with its path, except omitted ones.
fn numbers(path: &mut String, value: &Value, digest: &mut Sha256) {
    let length = path.len();
    match value {
        Value::Object(map) => {
            for (key, value) in map {
                if is_omitted(path, key) {
                    continue;
                }
                let _ = write!(path, ".{key}");
                numbers(path, value, digest);
                path.truncate(length);
            }
        }
        Value::Array(list) => {
            for (index, value) in list.iter().enumerate() {
                let _ = write!(path, "[{index}]");
                numbers(path, value, digest);
                path.truncate(length);
            }
        }
        Value::Number(number) => {
            digest.update(path.as_bytes());
            digest.update(number.to_string().as_bytes());
        }
        Value::Bool(_) | Value::Null | Value::String(_) => {}
    }
}

fn feed(outcome: &Outcome, summary: &Value, digest: &mut Sha256) {
    numbers(&mut String::new(), summary, digest);
    let mut bits = |values: &[f64]| {
        for value in values {
            digest.update(value.to_bits().to_le_bytes());
        }
    };
    for impact in &outcome.impacts {
        bits(&[
            impact.contact as f64,
            impact.start,
            impact.end,
            impact.peak_force,
            impact.peak_force_at,
            impact.peak_indentation,
            impact.impact_speed,
            impact.separation_speed,
            impact.impulse,
            impact.dissipated,
        ]);
    }
    if let Some(history) = &outcome.history {
        // Closings came later than the recorded digests.
        let older = history
            .columns()
            .iter()
            .map(|column| !matches!(column, Column::Closing { .. }));
        let older: Vec<bool> = older.collect();
        for row in 0..history.len() {
            let values = history.row(row).iter().zip(&older);
            let kept: Vec<f64> = values
                .filter(|(_, kept)| **kept)
                .map(|(value, _)| *value)
                .collect();
            bits(&kept);
        }
    }
    if let Some(springs) = &outcome.spring_history {
        for spring in 0..outcome.springs.len() {
            for [deformation, force] in springs.of_spring(spring) {
                bits(&[deformation.into(), force.into()]);
            }
        }
    }
}

/// `None` where the solver refuses the model.
fn digest(case: &Case) -> Option<String> {
    let input = case.input.clone()?;
    let motion = input.ground_motion().ok()?;
    let mut model = input.model;
    model.analysis.solver = Some(case.solver);
    let system = System::assemble(&model).ok()?;
    let plan = Plan::choose(&system, &motion, &model.analysis).ok()?;
    let mut digest = Sha256::new();
    for pounding in [Pounding::Included, Pounding::Excluded] {
        let settings = Settings {
            pounding,
            record_interval: Some(0.01),
        };
        let go_on = |_| ControlFlow::Continue(());
        let mut outcome = simulate(&system, &motion, &plan, settings, go_on);
        if pounding == Pounding::Included {
            find_sensitivity(&system, &motion, &plan, None, &mut outcome, go_on);
        }
        let summary = Summary::new(&Run {
            model: &model,
            system: &system,
            motion: &motion,
            plan: &plan,
            outcome: &outcome,
            without_contact: None,
            wall: 0.0,
        });
        let summary = serde_json::to_value(summary).ok()?;
        feed(&outcome, &summary, &mut digest);
    }
    Some(
        digest.finalize()[..12]
            .iter()
            .fold(String::new(), |mut text, byte| {
                let _ = write!(text, "{byte:02x}");
                text
            }),
    )
}

/// Digest of what the functions of the system's mathematical library give: other ones, other bits everywhere.
fn library() -> Pin {
    let mut digest = Sha256::new();
    for step in 1..2000 {
        let x = f64::from(step) * 0.007_31;
        for value in [
            x.sin(),
            x.cos(),
            x.tan(),
            x.exp(),
            (-x).exp_m1(),
            x.ln(),
            x.powf(1.5),
            x.powf(0.4),
            x.atan2(2.0),
            x.tanh(),
            x.cbrt(),
            (x / 20.0).asin(),
        ] {
            digest.update(value.to_bits().to_le_bytes());
        }
    }
    let bytes = digest.finalize();
    Pin {
        name: LIBRARY.into(),
        digest: bytes[..12].iter().map(|b| format!("{b:02x}")).collect(),
    }
}

/// Name of the pin of the mathematical library.
pub const LIBRARY: &str = "library";

/// Runs every model; the pin of the mathematical library comes first.
#[must_use]
pub fn pins() -> Vec<Pin> {
    let mut pins = vec![library()];
    let all: Vec<Pin> = cases()
        .into_par_iter()
        .map(|case| Pin {
            digest: digest(&case).unwrap_or_else(|| "none".into()),
            name: case.name,
        })
        .collect();
    pins.extend(all);
    pins
}

/// Pins as the file of data has them.
#[must_use]
pub fn describe(pins: &[Pin]) -> String {
    pins.iter().fold(String::new(), |mut text, pin| {
        let _ = writeln!(text, "{}: {}", pin.name, pin.digest);
        text
    })
}

/// Names of pins that differ from a file of data; `None` where another mathematical library makes other bits.
#[must_use]
pub fn moved(pins: &[Pin], recorded: &str) -> Option<Vec<String>> {
    let recorded: std::collections::HashMap<&str, &str> = recorded
        .lines()
        .filter_map(|line| line.split_once(": "))
        .collect();
    let same = |pin: &Pin| recorded.get(pin.name.as_str()) == Some(&pin.digest.as_str());
    let own = pins.iter().find(|pin| pin.name == LIBRARY)?;
    if !same(own) {
        return None;
    }
    let mut names: Vec<String> = pins
        .iter()
        .filter(|pin| !same(pin))
        .map(|pin| pin.name.clone())
        .collect();
    let gone = recorded
        .keys()
        .filter(|name| pins.iter().all(|pin| pin.name != **name));
    names.extend(gone.map(|name| format!("{name} (no longer run)")));
    names.sort();
    Some(names)
}
