//! Every key of the models that are shipped, with slips of units and strange values: no panic, no number that is not finite, and slips
//! of a million are refused or warned of. `JOSTLE_SCAN` sets how many damaged models are tried, `JOSTLE_SEED` which.

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use jostle::{Plan, Settings, System, simulate};
use jostle_io::{Format, TEMPLATE_NAMES, model_names, model_text, read_model_text, template};
use jostle_testkit::scan::{Dice, scanned};

/// Models by name, with the folder of their records.
fn models() -> Vec<(String, String)> {
    let mut models: Vec<(String, String)> = Vec::new();
    let entries = std::fs::read_dir(examples()).expect("examples");
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
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

fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples")
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
    let Ok(mut input) = read_model_text("m.toml", text, Format::Toml, &examples()) else {
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
        let floors = outcome.floors.iter().flatten();
        let mut numbers: Vec<f64> = floors
            .flat_map(|floor| {
                [
                    floor.displacement_max.value,
                    floor.total_acceleration,
                    floor.storey_shear,
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

/// Paths of numbers and quantities of a model; of lists the first entry.
fn leaves(value: &toml::Value, path: &str, into: &mut Vec<String>) {
    match value {
        toml::Value::Table(table) => {
            for (key, value) in table {
                leaves(
                    value,
                    &if path.is_empty() {
                        key.clone()
                    } else {
                        format!("{path}.{key}")
                    },
                    into,
                );
            }
        }
        toml::Value::Array(list) => {
            // Entries of tables differ in their keys.
            let count = if list.first().is_some_and(toml::Value::is_table) {
                list.len()
            } else {
                1
            };
            for (index, value) in list.iter().take(count).enumerate() {
                leaves(value, &format!("{path}[{index}]"), into);
            }
        }
        toml::Value::Float(_) => into.push(path.to_owned()),
        // Units make a quantity; other texts are names.
        toml::Value::String(text) if quantity(text).is_some() => into.push(path.to_owned()),
        _ => {}
    }
}

/// A number and the unit behind it.
fn quantity(text: &str) -> Option<(f64, &str)> {
    let (number, unit) = text.split_once(' ')?;
    Some((number.parse().ok()?, unit))
}

/// The value at a path.
fn at<'v>(value: &'v mut toml::Value, path: &str) -> &'v mut toml::Value {
    let mut here = value;
    for part in path.split('.') {
        let (key, rest) = part.split_once('[').unwrap_or((part, ""));
        here = &mut here[key];
        for index in rest.split('[').filter(|index| !index.is_empty()) {
            let index: usize = index.trim_end_matches(']').parse().expect("an index");
            here = &mut here[index];
        }
    }
    here
}

fn slipped(root: &toml::Value, path: &str, factor: f64) -> String {
    let mut root = root.clone();
    let value = at(&mut root, path);
    let text = value.as_str().map(str::to_owned);
    *value = match text.as_deref().and_then(quantity) {
        Some((number, unit)) => toml::Value::String(format!("{:e} {unit}", number * factor)),
        None => toml::Value::Float(value.as_float().expect("a number") * factor),
    };
    toml::to_string(&root).expect("a model")
}

/// A slip of a thousand may be meant; one of a million may not.
#[test]
fn slips_of_units_are_never_silent() {
    let mut silent: Vec<String> = Vec::new();
    let (mut tried, mut dice) = (0, Dice::new(1));
    // All of them in ./check-all.
    let share = if scanned(300) >= 10_000 { 1 } else { 8 };
    for (name, text) in models() {
        let root: toml::Value = text.parse::<toml::Table>().expect("TOML").into();
        let mut paths = Vec::new();
        leaves(&root, "", &mut paths);
        for path in paths {
            if dice.below(share) != 0 {
                continue;
            }
            let zero = {
                let mut copy = root.clone();
                let value = at(&mut copy, &path);
                value.as_float() == Some(0.0)
                    || value
                        .as_str()
                        .and_then(quantity)
                        .is_some_and(|(number, _)| number == 0.0)
            };
            for factor in [1e3, 1e-3, 1e6, 1e-6, 1e9, 1e-9, -1.0] {
                let outcome = survives(&slipped(&root, &path, factor), false);
                tried += 1;
                let large = factor.abs().log10().abs() > 4.0;
                if large && !zero && outcome == Outcome::Silent {
                    silent.push(format!("{name}: {path} × {factor:e}"));
                }
            }
        }
    }
    assert!(tried > 500, "{tried}");
    assert!(
        silent.is_empty(),
        "{} of {tried} slips are silent:\n{}",
        silent.len(),
        silent.join("\n")
    );
}

/// Damaged models are refused or can be stepped.
#[test]
fn damaged_models_are_refused_or_run() {
    let models = models();
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
