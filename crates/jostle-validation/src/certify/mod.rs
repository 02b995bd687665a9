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
//! # Sensitive runs
//!
//! A run that reports `sensitive_from_s = t` promises only the peaks before t. Its motion is cut a contact duration before
//! t, run again and held against a reference cut at the same instant.

mod laws;
mod linear;
mod models;
mod phi;
pub mod record;
mod reference;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::fmt::Write;
use std::ops::ControlFlow;
use std::sync::Arc;

use jostle::stepping::find_sensitivity;
use jostle::{
    GroundMotion, Plan, Pounding, Run, RunEnd, Settings, Solver, Summary, System, simulate,
};
use jostle_io::{Format, Input, read_model_text};
use rayon::prelude::*;

pub use models::{Drawn, draw};
pub use reference::{Accuracy, Peaks, run as reference};

/// Tolerances at which every model is run.
pub const TOLERANCES: [f64; 3] = [1e-2, 1e-3, 1e-4];
/// Solvers that are held.
const SOLVERS: [Solver; 2] = [Solver::Modal, Solver::Riccati];
/// Share of a tolerance that the reference itself may be uncertain by.
const UNCERTAIN: f64 = 0.1;

/// One promised number.
#[derive(Clone, Debug)]
pub struct Quantity {
    /// Its kind.
    pub kind: &'static str,
    /// Which one.
    pub name: String,
    /// The value.
    pub value: f64,
    /// The greatest of its kind in that building or gap.
    pub scale: f64,
}

/// Promised numbers by the reference.
#[derive(Clone, Debug, Default)]
pub struct Truth {
    /// Quantities with the values of the reference.
    pub quantities: Vec<Quantity>,
    /// Their change under the perturbation.
    pub shifts: Vec<f64>,
}

/// The promised numbers of one run held against the reference.
#[derive(Clone, Debug)]
pub struct Held {
    /// Solver.
    pub solver: &'static str,
    /// Tolerance.
    pub tolerance: f64,
    /// The reference: that of the model, or of the cut motion.
    pub truth: Arc<Truth>,
    /// Error over the scale of every quantity whose reference is certain, in the order of the quantities.
    pub errors: Vec<Option<f64>>,
    /// Values of the run.
    pub got: Vec<f64>,
    /// Whether the run, cut if it was sensitive, warned that its peaks may be off.
    pub warned: bool,
    /// Where the motion was cut, as the run was sensitive from there \[s\].
    pub cut: Option<f64>,
    /// Why it failed, if so.
    pub failed: Option<String>,
    /// Wall time \[s\].
    pub seconds: f64,
}

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
    fn of(number: u64, kind: &'static str) -> Self {
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
    let text = serde_json::to_string(&drawn.tree).map_err(|e| e.to_string())?;
    let input = read_model_text("random model", &text, Format::Json, "".as_ref())
        .map_err(|e| e.to_string())?;
    let motion = input.ground_motion().map_err(|e| e.to_string())?;
    Ok((input, motion))
}

fn quantities_of(system: &System, peaks: &Peaks) -> Vec<Quantity> {
    let mut list = Vec::new();
    let most = |values: &[f64]| values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    for (building, own) in system.buildings.iter().zip(&peaks.buildings) {
        let name = &building.name;
        let reach = most(&own.most).max(most(&own.least));
        for (kind, values, scale) in [
            ("displacement max", &own.most, reach),
            ("displacement min", &own.least, reach),
            ("drift", &own.drift, most(&own.drift)),
            ("acceleration", &own.acceleration, most(&own.acceleration)),
        ] {
            for (floor, value) in values.iter().enumerate() {
                list.push(Quantity {
                    kind,
                    name: format!("{name} floor {}", floor + 1),
                    value: *value,
                    scale,
                });
            }
        }
        list.push(Quantity {
            kind: "base shear",
            name: name.clone(),
            value: own.shear,
            scale: own.shear,
        });
    }
    for (kind, values) in [("contact force", &peaks.force), ("impulse", &peaks.impulse)] {
        for (index, contact) in system.contacts.iter().enumerate() {
            let of_gap = system
                .contacts
                .iter()
                .zip(values)
                .filter(|(c, _)| c.gap == contact.gap);
            let scale = of_gap.fold(0.0, |m: f64, (_, v)| m.max(v.abs()));
            list.push(Quantity {
                kind,
                name: format!("gap {} at {:.2} m", contact.gap + 1, contact.height),
                value: values[index],
                scale,
            });
        }
    }
    list
}

/// The same list from a summary.
fn values_of(summary: &Summary, system: &System) -> Vec<f64> {
    let mut list = Vec::new();
    for building in &summary.buildings {
        let floors = || building.floors.iter();
        list.extend(floors().map(|f| f.displacement_max_m));
        list.extend(floors().map(|f| f.displacement_min_m));
        list.extend(floors().map(|f| f.storey_drift_peak));
        list.extend(floors().map(|f| f.total_acceleration_peak_m_s2));
        list.push(building.base_shear_peak_n);
    }
    // Contacts of a summary stand gap by gap, in the order of the system.
    let mut places = vec![0; summary.gaps.len()];
    let mut own = Vec::new();
    for contact in &system.contacts {
        own.push((contact.gap, places[contact.gap]));
        places[contact.gap] += 1;
    }
    list.extend(
        own.iter()
            .map(|(gap, place)| summary.gaps[*gap].contacts[*place].peak_force_n),
    );
    list.extend(
        own.iter()
            .map(|(gap, place)| summary.gaps[*gap].contacts[*place].impulse_n_s),
    );
    list
}

/// Whether a summary says that its peaks may be off.
fn warns(summary: &Summary) -> bool {
    let promise = serde_json::to_value(summary).ok();
    let met = promise.and_then(|value| {
        value
            .pointer("/promise/met")
            .and_then(serde_json::Value::as_bool)
    });
    let said = summary.warnings.iter().chain(&summary.notes);
    met == Some(false) || said.into_iter().any(|text| text.contains("sensitive"))
}

/// One run: its summary, why it failed, and its wall time \[s\].
struct Ran {
    summary: Summary,
    failed: Option<String>,
    seconds: f64,
}

fn ran(
    input: &Input,
    system: &System,
    motion: &GroundMotion,
    solver: Solver,
    tolerance: f64,
) -> Result<Ran, String> {
    let mut model = input.model.clone();
    model.analysis.tolerance = tolerance;
    model.analysis.solver = Some(solver);
    let plan = Plan::choose(system, motion, &model.analysis).map_err(|faults| {
        let problems = faults.iter().map(|fault| fault.problem.clone());
        problems.collect::<Vec<_>>().join("; ")
    })?;
    let begun = std::time::Instant::now();
    let settings = Settings {
        pounding: Pounding::Included,
        record_interval: None,
    };
    let mut outcome = simulate(system, motion, &plan, settings, |_| {
        ControlFlow::Continue(())
    });
    let seconds = begun.elapsed().as_secs_f64();
    find_sensitivity(system, motion, &plan, &mut outcome, |_| {
        ControlFlow::Continue(())
    });
    let summary = Summary::of(&Run {
        model: &model,
        system,
        motion,
        plan: &plan,
        outcome: &outcome,
        without_contact: None,
        wall: seconds,
    });
    let failed = match &outcome.end {
        RunEnd::Completed => None,
        other => Some(format!("{other:?}")),
    };
    Ok(Ran {
        summary,
        failed,
        seconds,
    })
}

/// Cuts that are tried before a run that is still sensitive counts as warned.
const MOST_CUTS: usize = 4;

/// Longest elastic contact at 0.3 m/s: what a cut run leaves out before the sensitive instant \[s\].
fn margin(system: &System) -> f64 {
    let contacts = system.contacts.iter();
    let durations =
        contacts.map(|contact| contact.law.elastic_duration(contact.effective_mass(), 0.3));
    durations.fold(0.0, f64::max)
}

/// Runs a model and holds its peaks to the reference: of the whole motion, or before the instant from which the run
/// calls itself sensitive.
fn hold(
    input: &Input,
    system: &System,
    motion: &GroundMotion,
    truth: &Arc<Truth>,
    solver: Solver,
    tolerance: f64,
) -> Result<Held, String> {
    let mut run = ran(input, system, motion, solver, tolerance)?;
    let seconds = run.seconds;
    let mut truth = truth.clone();
    let mut cut = None;
    for _ in 0..MOST_CUTS {
        let Some(from) = run.summary.promise.sensitive_from_s else {
            break;
        };
        let end = from - margin(system);
        if run.failed.is_some() || cut.is_some_and(|cut| end >= cut) {
            break;
        }
        cut = Some(end.max(0.0));
        let mut shorter = motion.clone();
        shorter.duration = end;
        // Nothing happens, and nothing is promised, before the first points of the motion.
        let promised = end > LEAST_CUT;
        let again = promised.then(|| ran(input, system, &shorter, solver, tolerance));
        let Some(Ok(again)) = again else {
            truth = Arc::default();
            break;
        };
        run = again;
        let mut sooner = shorter.clone();
        sooner.duration = end - ENDS_SOONER;
        match true_peaks(system, [&shorter, &sooner]) {
            Ok((own, ..)) => truth = Arc::new(own),
            Err(why) => run.failed = Some(format!("no reference up to {end:.3} s: {why}")),
        }
    }
    let got = if truth.quantities.is_empty() {
        Vec::new()
    } else {
        values_of(&run.summary, system)
    };
    Ok(Held {
        solver: solver.name(),
        tolerance,
        errors: errors(&truth, &got, tolerance),
        truth,
        got,
        warned: warns(&run.summary),
        cut,
        failed: run.failed,
        seconds,
    })
}

/// A difference over its scale; none of a quantity that stays zero is none.
fn share(difference: f64, scale: f64) -> f64 {
    if difference == 0.0 {
        0.0
    } else {
        difference / scale
    }
}

/// By how much the perturbed reference of a cut motion ends sooner: an impact at the very end is in one run or in the other
/// \[s\].
const ENDS_SOONER: f64 = 1e-4;
/// Shortest motion that a cut leaves \[s\].
const LEAST_CUT: f64 = 0.01;

/// Error of every quantity over its scale; `None` where the reference is uncertain.
fn errors(truth: &Truth, got: &[f64], tolerance: f64) -> Vec<Option<f64>> {
    let all = truth.quantities.iter().zip(&truth.shifts).zip(got);
    all.map(|((quantity, shift), got)| {
        let scale = if quantity.scale > 0.0 {
            quantity.scale
        } else {
            got.abs()
        };
        let relative = |value: f64| share(value, scale).abs();
        (relative(*shift) <= UNCERTAIN * tolerance).then(|| relative(got - quantity.value))
    })
    .collect()
}

/// The reference of a motion with its change under the perturbation, for which the motion may be another, and the peaks it
/// comes from.
fn true_peaks(
    system: &System,
    [motion, perturbed]: [&GroundMotion; 2],
) -> Result<(Truth, Peaks), String> {
    let peaks = reference(system, motion, Accuracy::FINE)?;
    let other = if system.contacts.is_empty() {
        peaks.clone()
    } else {
        reference(system, perturbed, Accuracy::OTHER)?
    };
    let quantities = quantities_of(system, &peaks);
    let others = quantities_of(system, &other);
    let shifts = quantities.iter().zip(&others);
    let shifts = shifts.map(|(a, b)| b.value - a.value).collect();
    Ok((Truth { quantities, shifts }, peaks))
}

/// Holds one model against its reference.
#[must_use]
pub fn certify(seed: u64, number: u64, runs: &[(Solver, f64)]) -> Certified {
    let drawn = draw(seed, number);
    let mut certified = Certified::of(number, drawn.kind);
    if let Err(why) = fill(&drawn, runs, &mut certified) {
        certified.failed = Some(why);
    }
    certified
}

fn fill(drawn: &Drawn, runs: &[(Solver, f64)], certified: &mut Certified) -> Result<(), String> {
    let (input, motion) = read(drawn)?;
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
    let (truth, peaks) = true_peaks(&system, [&motion; 2])?;
    certified.seconds = begun.elapsed().as_secs_f64();
    (certified.touches, certified.lasting, certified.steps) =
        (peaks.touches, peaks.lasting, peaks.steps);
    certified.truth = Arc::new(truth);
    for &(solver, tolerance) in runs {
        let truth = &certified.truth;
        match hold(&input, &system, &motion, truth, solver, tolerance) {
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

/// The promised numbers of a model file: reference, its change under the perturbation, and both solvers.
///
/// # Errors
/// Why the file cannot be read, or has no reference.
pub fn of_file(path: &std::path::Path, tolerances: &[f64]) -> Result<String, String> {
    let tree = std::fs::read_to_string(path).map_err(|e| e.to_string())?;
    let tree = serde_json::from_str(&tree).map_err(|e| e.to_string())?;
    let mut certified = Certified::of(0, "file");
    let runs = every_run(tolerances);
    fill(&Drawn { tree, kind: "file" }, &runs, &mut certified)?;
    let mut text = String::new();
    let truth = &certified.truth;
    for (k, (quantity, shift)) in truth.quantities.iter().zip(&truth.shifts).enumerate() {
        let _ = write!(
            text,
            "{:<18} {:<20} {:>14.7e} ({:+.1e})",
            quantity.kind,
            quantity.name,
            quantity.value,
            share(*shift, quantity.scale)
        );
        for run in &certified.runs {
            let _ = write!(text, "  {} {:.0e}: ", run.solver, run.tolerance);
            match (run.truth.quantities.get(k), run.got.get(k)) {
                (Some(expected), Some(got)) => {
                    let error = share(got - expected.value, expected.scale);
                    let _ = write!(text, "{error:+.1e}");
                }
                _ => text.push_str("nothing promised"),
            }
        }
        text.push('\n');
    }
    let _ = writeln!(
        text,
        "{} touches, {} lasting, {} steps, {:.2} s for two references",
        certified.touches, certified.lasting, certified.steps, certified.seconds
    );
    for run in &certified.runs {
        if let Some(cut) = run.cut {
            let _ = writeln!(
                text,
                "{} at {:.0e} is sensitive: motion and reference end at {cut:.3} s",
                run.solver, run.tolerance
            );
        }
    }
    Ok(text)
}

/// Both solvers at each of these tolerances.
#[must_use]
pub fn every_run(tolerances: &[f64]) -> Vec<(Solver, f64)> {
    SOLVERS
        .into_iter()
        .flat_map(|solver| tolerances.iter().map(move |tolerance| (solver, *tolerance)))
        .collect()
}

/// Certifies models 1 … `count` of a seed, on all processors; `only` picks some.
#[must_use]
pub fn study(count: u64, seed: u64, only: Option<u64>, runs: &[(Solver, f64)]) -> Vec<Certified> {
    let numbers: Vec<u64> = match only {
        Some(number) => vec![number],
        None => (1..=count).collect(),
    };
    numbers
        .par_iter()
        .with_max_len(1)
        .map(|number| certify(seed, *number, runs))
        .collect()
}

#[derive(Default)]
struct Count {
    all: usize,
    within: usize,
    thrice: usize,
    uncertain: usize,
    worst: f64,
    place: String,
}

impl Count {
    fn add(&mut self, ratio: Option<f64>, place: impl Fn() -> String) {
        let Some(ratio) = ratio else {
            self.uncertain += 1;
            return;
        };
        self.all += 1;
        self.within += usize::from(ratio <= 1.0);
        self.thrice += usize::from(ratio <= 3.0);
        if ratio > self.worst || self.place.is_empty() {
            self.worst = ratio;
            self.place = place();
        }
    }

    fn line(&self, name: &str) -> String {
        let share = |part: usize| 100.0 * part as f64 / self.all.max(1) as f64;
        format!(
            "{name:<44} {:>7} {:>8.2} % {:>8.2} % {:>7} {:>10.3}  {}",
            self.all,
            share(self.within),
            share(self.thrice),
            self.uncertain,
            self.worst,
            self.place
        )
    }
}

/// The study in words.
#[must_use]
pub fn describe(all: &[Certified]) -> String {
    let mut text = String::new();
    let mut tables: [BTreeMap<String, Count>; 5] = Default::default();
    let (mut runs, mut off, mut warned, mut warned_for_nothing) = (0, 0, 0, 0);
    let (mut cut, mut nothing) = (0, 0);
    let mut failures = Vec::new();
    for model in all {
        if let Some(why) = &model.failed {
            failures.push(format!("model {}: no reference: {why}", model.number));
            continue;
        }
        for run in &model.runs {
            let way = format!("{} at {:.0e}", run.solver, run.tolerance);
            if let Some(why) = &run.failed {
                failures.push(format!("model {} {way}: {why}", model.number));
                continue;
            }
            runs += 1;
            cut += usize::from(run.cut.is_some());
            nothing += usize::from(run.truth.quantities.is_empty());
            let mut worst: (f64, usize) = (0.0, 0);
            for (k, (quantity, error)) in run.truth.quantities.iter().zip(&run.errors).enumerate() {
                let ratio = error.map(|error| error / run.tolerance);
                if let Some(ratio) = ratio.filter(|ratio| *ratio > worst.0) {
                    worst = (ratio, k);
                }
                let place = || {
                    format!(
                        "model {} {} {}, {way}",
                        model.number, quantity.kind, quantity.name
                    )
                };
                let keys = [
                    way.clone(),
                    format!("{} {}", quantity.kind, run.solver),
                    format!(
                        "law {}",
                        if model.touches > 0 {
                            &model.laws
                        } else {
                            "none touches"
                        }
                    ),
                    format!("{} {}", model.kind, run.solver),
                    "all".into(),
                ];
                for (table, key) in tables.iter_mut().zip(keys) {
                    table.entry(key).or_default().add(ratio, place);
                }
            }
            if worst.0 > 1.0 {
                off += 1;
                warned += usize::from(run.warned);
                let quantity = &run.truth.quantities[worst.1];
                let bad = run
                    .errors
                    .iter()
                    .flatten()
                    .filter(|e| **e > run.tolerance)
                    .count();
                let _ = writeln!(
                    text,
                    "model {:>4} | {:<5} | {} | {} | {way:<16} | {} {} | got {:.6e} | reference {:.6e} | {:.2} times | {bad} of {} | {} touches{}",
                    model.number,
                    model.kind,
                    model.buildings,
                    model.laws,
                    quantity.kind,
                    quantity.name,
                    run.got[worst.1],
                    quantity.value,
                    worst.0,
                    run.errors.len(),
                    model.touches,
                    if model.lasting > 0 {
                        format!(", {} lasting", model.lasting)
                    } else {
                        String::new()
                    },
                );
            } else {
                warned_for_nothing += usize::from(run.warned);
            }
        }
    }
    let _ = writeln!(
        text,
        "\n{:<44} {:>7} {:>10} {:>10} {:>7} {:>10}  where",
        "", "numbers", "within 1", "within 3", "unsure", "worst"
    );
    for table in &tables {
        for (name, count) in table {
            let _ = writeln!(text, "{}", count.line(name));
        }
        text.push('\n');
    }
    let _ = writeln!(
        text,
        "{} models, {runs} runs; {off} runs have a number beyond the tolerance, {warned} of them warned; {warned_for_nothing} others warned.",
        all.len()
    );
    let _ = writeln!(
        text,
        "{cut} runs were sensitive: their peaks before the sensitive instant are counted; {nothing} of them promise nothing.",
    );
    let mut refused: BTreeMap<String, usize> = BTreeMap::new();
    for (solver, why) in all.iter().flat_map(|model| &model.refusals) {
        // Without the names of buildings.
        let why: Vec<&str> = why.split('"').step_by(2).collect();
        *refused
            .entry(format!("{solver}: {}", why.join("…")))
            .or_default() += 1;
    }
    for (why, models) in refused {
        let _ = writeln!(text, "{models} models are refused by {why}");
    }
    let spent: f64 = all.iter().map(|model| model.seconds).sum();
    let own: f64 = all
        .iter()
        .flat_map(|model| &model.runs)
        .map(|run| run.seconds)
        .sum();
    let slowest = all.iter().max_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let _ = writeln!(
        text,
        "References took {spent:.0} s (slowest: model {}, {:.1} s), runs {own:.0} s.",
        slowest.map_or(0, |model| model.number),
        slowest.map_or(0.0, |model| model.seconds)
    );
    for failure in failures {
        let _ = writeln!(text, "{failure}");
    }
    text
}
