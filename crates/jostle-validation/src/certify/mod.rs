//! Every promised number of random models against an event-driven reference of other means.
//!
//! # The reference
//!
//! M, C and K of every building are put together densely and brought to first-order modes (`linear`), where buildings
//! joined by links count as one. Between events every mode is advanced exactly, with the ground acceleration linear
//! between points of a record (polynomials of degree eight for a sine) and contact forces as polynomials of degree
//! eight over each step, found at nine Chebyshev points by Picard iteration. Steps are halved until the last Chebyshev
//! terms of every force are below 1e-10 of the greatest of its gap. Touches are located on the exact motion, corners of a
//! force (cuts, turns, slipping, releases) on its polynomials. Laws are written anew as smooth pieces (`laws`). Peaks are
//! taken at the ends of steps, on both sides of every jump, and at the exact motion wherever the cubic between two
//! ends says that something may be greater than before.
//!
//! A second reference with gaps wider by 1e-6 of their width (and 1e-10 m) and a looser error says which numbers a model
//! determines at all: those that move by more than a tenth of a tolerance are counted apart.
//!
//! Storey shears and overturning moments are sums of rows of the assembled stiffness matrices times displacements.
//!
//! # Sensitive runs
//!
//! A run that reports `sensitive_from_s = t` promises only the peaks before t. Its motion is cut a contact duration before
//! t, run again and held against a reference cut at the same instant.

mod describe;
mod eigen;
mod explicit;
mod families;
mod family_record;
mod hold;
mod laws;
mod linear;
mod models;
mod more_models;
mod of_file;
mod phi;
mod pulse;
mod quantities;
mod random;
pub mod record;
mod reference;
#[cfg(test)]
mod tests;
mod truth;

use std::path::Path;
use std::sync::Arc;

use jostle::{GroundMotion, Solver, System};
use jostle_io::{Format, Input, read_model_text};
use nalgebra::Complex;
use rayon::prelude::*;
use serde_json::{Value, json};

pub use describe::describe;
pub use families::{FAMILIES, Family};
pub use family_record::families_page;
pub use hold::Held;
use hold::hold;
pub use models::{Drawn, draw};
pub(crate) use models::{LAWS, gap};
pub use of_file::of_file;
pub use pulse::Pulse;
pub use quantities::Quantity;
pub(crate) use random::{Random, digits};
pub use reference::{Accuracy, Peaks, run as reference};
pub use truth::Truth;
use truth::true_peaks;

type C64 = Complex<f64>;

/// Tolerances at which every model is run.
pub const TOLERANCES: [f64; 3] = [1e-2, 1e-3, 1e-4];
/// Solvers that are held.
const SOLVERS: [Solver; 2] = [Solver::Modal, Solver::Riccati];
/// The same for families with a reference of their own; not every model is accepted by all.
const SOLVERS_OF_FAMILIES: [Solver; 3] = [Solver::Modal, Solver::Riccati, Solver::Series];

/// One model.
#[derive(Clone, Debug)]
pub struct Certified {
    /// Number.
    pub number: u64,
    /// Kind.
    pub kind: &'static str,
    /// Contact laws.
    pub laws: String,
    /// Number of buildings, and their kinds.
    pub buildings: String,
    /// The reference.
    pub truth: Arc<Truth>,
    /// Runs.
    pub runs: Vec<Held>,
    /// Solvers that refuse the model, and why.
    pub refusals: Vec<(&'static str, String)>,
    /// Touches of the reference.
    pub touches: u64,
    /// Lasting contacts of the momentum law.
    pub lasting: u64,
    /// Steps of the reference.
    pub steps: u64,
    /// Wall time of both references \[s\].
    pub seconds: f64,
    /// Why there is no reference.
    pub failed: Option<String>,
}

impl Certified {
    fn new(number: u64, kind: &'static str) -> Self {
        Self {
            number,
            kind,
            laws: String::new(),
            buildings: String::new(),
            truth: Arc::default(),
            runs: Vec::new(),
            refusals: Vec::new(),
            touches: 0,
            lasting: 0,
            steps: 0,
            seconds: 0.0,
            failed: None,
        }
    }
}

/// Reads a drawn model.
///
/// # Errors
/// What the model file says.
pub fn read(drawn: &Drawn) -> Result<(Input, GroundMotion), String> {
    let Some(pulse) = drawn.pulse else {
        return read_text(&drawn.tree, Path::new(""));
    };
    // Its record has no file: another motion stands in.
    let mut tree = drawn.tree.clone();
    let duration = tree["motion"]["duration"].as_f64().unwrap_or(0.0);
    tree["motion"] = json!({"kind": "sine", "amplitude": 1, "period": 1, "duration": duration});
    let (input, _) = read_text(&tree, Path::new(""))?;
    Ok((input, pulse.motion(duration)))
}

fn read_text(tree: &Value, folder: &Path) -> Result<(Input, GroundMotion), String> {
    let text = serde_json::to_string(tree).map_err(|e| e.to_string())?;
    let input =
        read_model_text("random model", &text, Format::Json, folder).map_err(|e| e.to_string())?;
    let motion = input.ground_motion().map_err(|e| e.to_string())?;
    Ok((input, motion))
}

/// Holds one model against its reference: of a family, or of those that do not yield.
#[must_use]
pub fn certify(
    family: Option<Family>,
    seed: u64,
    number: u64,
    runs: &[(Solver, f64)],
) -> Certified {
    let drawn = match family {
        Some(family) => family.model(seed, number),
        None => draw(seed, number),
    };
    let mut certified = Certified::new(number, drawn.kind);
    let held = read(&drawn).and_then(|(input, motion)| fill(&input, &motion, runs, &mut certified));
    if let Err(why) = held {
        certified.failed = Some(why);
    }
    certified
}

fn fill(
    input: &Input,
    motion: &GroundMotion,
    runs: &[(Solver, f64)],
    certified: &mut Certified,
) -> Result<(), String> {
    let mut laws: Vec<String> = input
        .model
        .gaps
        .iter()
        .map(|gap| gap.law.kind.full_name())
        .collect();
    laws.sort();
    laws.dedup();
    certified.laws = if laws.is_empty() {
        "none".into()
    } else {
        laws.join(" + ")
    };
    let shear = |b: &&jostle::Building| matches!(b.structure, jostle::Structure::Shear(_));
    let all = input.model.buildings.len();
    let shears = input.model.buildings.iter().filter(shear).count();
    certified.buildings = format!("{shears} shear {} frame", all - shears);
    let system = System::assemble(&input.model).map_err(|faults| {
        faults
            .iter()
            .map(ToString::to_string)
            .collect::<Vec<_>>()
            .join("; ")
    })?;
    let begun = std::time::Instant::now();
    let (truth, peaks) = true_peaks(&system, [motion; 2])?;
    certified.seconds = begun.elapsed().as_secs_f64();
    (certified.touches, certified.lasting, certified.steps) =
        (peaks.touches, peaks.lasting, peaks.steps);
    certified.truth = Arc::new(truth);
    for &(solver, tolerance) in runs {
        let truth = &certified.truth;
        match hold(input, &system, motion, truth, solver, tolerance) {
            Ok(held) => certified.runs.push(held),
            Err(why) => {
                let refusal = (solver.name(), why);
                if !certified.refusals.contains(&refusal) {
                    certified.refusals.push(refusal);
                }
            }
        }
    }
    Ok(())
}

/// Every solver that is held of a family, or of models that do not yield, at each of these tolerances.
#[must_use]
pub fn every_run(family: Option<Family>, tolerances: &[f64]) -> Vec<(Solver, f64)> {
    let solvers: &[Solver] = match family {
        Some(_) => &SOLVERS_OF_FAMILIES,
        None => &SOLVERS,
    };
    solvers
        .iter()
        .copied()
        .flat_map(|solver| tolerances.iter().map(move |tolerance| (solver, *tolerance)))
        .collect()
}

/// Certifies models 1 … `count` of a seed, on all processors; `only` picks some.
#[must_use]
pub fn study(
    family: Option<Family>,
    count: u64,
    seed: u64,
    only: Option<u64>,
    runs: &[(Solver, f64)],
) -> Vec<Certified> {
    let numbers: Vec<u64> = match only {
        Some(number) => vec![number],
        None => (1..=count).collect(),
    };
    numbers
        .par_iter()
        .with_max_len(1)
        .map(|number| certify(family, seed, *number, runs))
        .collect()
}
