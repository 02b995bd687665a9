//! Every key of the models that are shipped, with slips of units: slips of a million are refused or warned of. Those models and
//! the ones in `models/` beside this file, which have the keys that no shipped model has, with strange values: no panic, no number
//! that is not finite. `JOSTLE_SCAN` sets how many damaged models are tried, `JOSTLE_SEED` which.

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use jostle::{Plan, Settings, System, simulate};
use jostle_io::{Format, TEMPLATE_NAMES, model_names, model_text, read_model_text, template};
use jostle_testkit::scan::{Dice, scanned};

/// Models by name. Their records are built in or stand in `models/`.
fn models(folders: &[&str]) -> Vec<(String, String)> {
    let mut models: Vec<(String, String)> = Vec::new();
    let mut paths: Vec<PathBuf> = folders
        .iter()
        .flat_map(|folder| std::fs::read_dir(of_crate(folder)).expect("models"))
        .flatten()
        .map(|entry| entry.path())
        .collect();
    paths.sort();
    for path in paths {
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        if name.ends_with(".toml") && !name.starts_with("study") {
            models.push((name, std::fs::read_to_string(&path).expect("a model")));
        }
    }
    for name in TEMPLATE_NAMES {
        models.push((name.to_owned(), template(name, "x").expect("a template")));
    }
    for name in model_names() {
        models.push((
            name.to_owned(),
            model_text(name).expect("a model").to_owned(),
        ));
    }
    models
}

/// Models that are shipped as files.
const EXAMPLES: &str = "../../examples";
/// Models with the keys that no shipped model has.
const MODELS: &str = "tests/reading/models";

fn of_crate(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// What came of a model.
#[derive(Debug, PartialEq)]
enum Outcome {
    Refused,
    Warned,
    Silent,
}

/// Reads, assembles and plans a model, and steps a little of it.
fn exercise(text: &str, steps: bool) -> Outcome {
    let Ok(mut input) = read_model_text("m.toml", text, Format::Toml, &of_crate(MODELS)) else {
        return Outcome::Refused;
    };
    let system = match System::assemble(&input.model) {
        Ok(system) => system,
        Err(faults) => {
            assert!(!input.faults(faults).to_string().is_empty());
            return Outcome::Refused;
        }
    };
    input.note_system(&system);
    let Ok(motion) = input.ground_motion() else {
        return Outcome::Refused;
    };
    if let Some(warning) = input.unusual_motion(&motion) {
        input.warnings.push(warning);
    }
    let plan = match Plan::choose(&system, &motion, &input.model.analysis) {
        Ok(plan) => plan,
        Err(faults) => {
            assert!(!input.faults(faults).to_string().is_empty());
            return Outcome::Refused;
        }
    };
    if steps {
        let settings = Settings {
            record_interval: None,
            ..Settings::default()
        };
        let mut looks = 0;
        let outcome = simulate(&system, &motion, &plan, settings, |_| {
            looks += 1;
            if looks > 1 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        let floors = outcome.peaks.buildings().flatten();
        let mut numbers: Vec<f64> = floors
            .flat_map(|floor| {
                [
                    floor.displacement_max().value,
                    floor.total_acceleration(),
                    floor.storey_shear(),
                ]
            })
            .collect();
        numbers.extend(outcome.impacts.iter().map(|impact| impact.peak_force));
        assert!(
            numbers.iter().all(|number| number.is_finite()),
            "{numbers:?}"
        );
    }
    if input.warnings.is_empty() {
        Outcome::Silent
    } else {
        Outcome::Warned
    }
}

/// The same, with a panic as an error that has the text.
fn survives(text: &str, steps: bool) -> Outcome {
    catch_unwind(AssertUnwindSafe(|| exercise(text, steps)))
        .unwrap_or_else(|_| panic!("a panic with\n{text}"))
}

/// A number of a model with or without a unit: its place in the text, and its parts.
struct Found {
    place: std::ops::Range<usize>,
    number: f64,
    unit: String,
}

/// Quantities of a model: texts of a number and a unit, and numbers with a point.
fn quantities(text: &str) -> Vec<Found> {
    let mut found = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let plain = line.split('#').next().unwrap_or("");
        let mut at = plain.find('=').unwrap_or(plain.len());
        while let Some(digit) = plain[at..].find(|c: char| c.is_ascii_digit()) {
            let number = at + digit;
            let rest = &plain[number..];
            let length = rest.find(|c: char| !c.is_ascii_digit() && !".e_".contains(c));
            at = number + length.unwrap_or(rest.len());
            if let Some(unit) = unit_of(plain, number..at) {
                let space = usize::from(!unit.is_empty());
                found.push(Found {
                    place: start + number..start + at + space + unit.len(),
                    number: plain[number..at].parse().expect("a number"),
                    unit: unit.to_owned(),
                });
                at += space + unit.len();
            }
        }
        start += line.len();
    }
    found
}

/// The unit of a number at a place of a line, empty if it has none; `None` for what is no quantity.
fn unit_of(line: &str, place: std::ops::Range<usize>) -> Option<&str> {
    line[place.clone()].parse::<f64>().ok()?;
    let before = &line[..place.start];
    if before.trim_end_matches('-').ends_with('"') {
        return line[place.end..].strip_prefix(' ')?.split('"').next();
    }
    // Whole numbers may be counts; digits of names and paths are none.
    let alone = before.ends_with([' ', '[', ',', '-']);
    (alone && line[place].contains('.')).then_some("")
}

/// The text with a quantity multiplied.
fn slipped(text: &str, found: &Found, factor: f64) -> String {
    let (before, after) = (&text[..found.place.start], &text[found.place.end..]);
    let number = found.number * factor.abs();
    // A second sign makes it positive again.
    let (before, sign) = match (factor < 0.0, before.strip_suffix('-')) {
        (true, Some(before)) => (before, ""),
        (true, None) => (before, "-"),
        (false, _) => (before, ""),
    };
    let space = if found.unit.is_empty() { "" } else { " " };
    format!("{before}{sign}{number:e}{space}{}{after}", found.unit)
}

/// A slip of a thousand may be meant; one of a million may not.
#[test]
fn slips_of_units_are_never_silent() {
    let mut silent: Vec<String> = Vec::new();
    let (mut tried, mut dice) = (0, Dice::new(1));
    // All of them in ./check-all.
    let share = if scanned(300) >= 10_000 { 1 } else { 24 };
    for (name, text) in models(&[EXAMPLES, MODELS]) {
        for found in quantities(&text) {
            // A slip of a unit scales a whole matrix, which the test of all keys does; one entry, or a number in a formula,
            // may be anything.
            let start = text[..found.place.start].rfind('\n').map_or(0, |at| at + 1);
            let any = ["matrices =", "formula ="]
                .iter()
                .any(|key| text[start..].starts_with(key));
            if any || dice.below(share) != 0 {
                continue;
            }
            for factor in [1e3, 1e-3, 1e6, 1e-6, 1e9, 1e-9, -1.0] {
                let outcome = survives(&slipped(&text, &found, factor), false);
                tried += 1;
                // Places on a site may be those of a national grid, some 10⁷ m.
                let on_grid = ["from =", "to ="]
                    .iter()
                    .any(|key| text[start..].starts_with(key));
                let large = factor.abs().log10().abs() > 4.0 && !(on_grid && factor > 1.0);
                if large && found.number != 0.0 && outcome == Outcome::Silent {
                    let line = text[..found.place.start].matches('\n').count() + 1;
                    silent.push(format!("{name}:{line}: × {factor:e}"));
                }
            }
        }
    }
    assert!(tried > 300, "{tried}");
    assert!(
        silent.is_empty(),
        "{} of {tried} slips are silent:\n{}",
        silent.len(),
        silent.join("\n")
    );
}

/// Every model can be stepped before it is damaged.
#[test]
fn models_run_before_they_are_damaged() {
    for (name, text) in models(&[EXAMPLES, MODELS]) {
        assert_ne!(survives(&text, true), Outcome::Refused, "{name}");
    }
}

/// Damaged models are refused or can be stepped.
#[test]
fn damaged_models_are_refused_or_run() {
    let models = models(&[EXAMPLES, MODELS]);
    let mut dice = Dice::new(2);
    let mut accepted = 0;
    let count = scanned(300);
    for _ in 0..count {
        let (_, text) = dice.one(&models);
        let damaged = dice.damage(text.as_bytes());
        let text = String::from_utf8_lossy(&damaged);
        accepted += usize::from(survives(&text, true) != Outcome::Refused);
    }
    assert!(accepted > count / 20, "{accepted} of {count} were accepted");
}
