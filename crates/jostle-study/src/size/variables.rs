//! `--vary link.damping=10 kN.s/m..10 MN.s/m`: varied keys and their bounds, as a study.

use std::fmt::Write;

use jostle_io::{Distribution, InputError, KnobKind, ModelTree, Shape, in_unit_of};

use crate::study::StudyError;

/// Bounds without being stated: the value of the model over and times this.
const REACH: f64 = 10.0;
/// Bounds whose ratio is at least this are searched by ratios.
const BY_RATIOS: f64 = 10.0;

/// A varied key.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Variable {
    /// As typed.
    pub(super) name: String,
    /// Path in the model file.
    path: String,
    /// Lower and upper bound as typed, or from the model.
    pub(super) bounds: [String; 2],
}

/// Reads `NAME=LOW..HIGH`, or `NAME` with bounds around the value of the model.
pub(super) fn read(tree: &ModelTree, text: &str) -> Result<Variable, String> {
    let wrong = |problem: String| {
        let text = shown(text);
        format!("--vary \"{text}\": {problem}; write it like --vary \"gap.width=10 mm..200 mm\"")
    };
    let (name, bounds) = match text.split_once('=') {
        Some((name, bounds)) => (name.trim(), Some(bounds)),
        None => (text.trim(), None),
    };
    if name.is_empty() || name.contains(['"', '\\', '\n']) {
        return Err(wrong("the name of a key is missing".into()));
    }
    let path = path_of(tree, name);
    let bounds = match bounds {
        Some(bounds) => {
            let Some((low, high)) = bounds.split_once("..") else {
                return Err(wrong("bounds are missing".into()));
            };
            let [low, high] = [low, high].map(str::trim);
            if low.is_empty() || high.is_empty() {
                return Err(wrong("a bound is missing".into()));
            }
            // A range of a study has one unit.
            let high = in_unit_of(low, high).unwrap_or_else(|| high.to_owned());
            [low.to_owned(), high]
        }
        None => around(tree, &path).ok_or_else(|| {
            wrong(
                "state its bounds, because the model has no single number above zero there".into(),
            )
        })?,
    };
    Ok(Variable {
        name: name.to_owned(),
        path,
        bounds,
    })
}

/// `link.damping` means `link[*].damping`, unless an entry has that name.
fn path_of(tree: &ModelTree, name: &str) -> String {
    let Some((first, rest)) = name.split_once('.') else {
        return name.to_owned();
    };
    let every = format!("{first}[*].{rest}");
    let mut trial = tree.clone();
    let nothing = jostle_io::TreeValue::Number(0.0);
    let known = trial.set(name, &nothing).is_ok();
    if !known && trial.set(&every, &nothing).is_ok() {
        every
    } else {
        name.to_owned()
    }
}

/// A tenth and ten times the value of the model; numbers without unit within their usual range.
fn around(tree: &ModelTree, path: &str) -> Option<[String; 2]> {
    let first = path.replace("[*]", "[0]");
    let knob = tree.knobs().into_iter().find(|knob| knob.path == first)?;
    let number = knob.number.filter(|number| *number > 0.0)?;
    if knob.kind != KnobKind::Quantity {
        return None;
    }
    let (mut low, mut high) = (number / REACH, number * REACH);
    if let (Some([least, most]), true) = (knob.usual, knob.unit.is_empty()) {
        (low, high) = (low.max(least), high.min(most));
    }
    (low < high)
        .then(|| [low, high].map(|bound| format!("{bound} {}", knob.unit).trim().to_owned()))
}

/// A study file in which the variables are distributed between their bounds.
pub(super) fn study_text(title: &str, variables: &[Variable]) -> String {
    let quoted = |text: &str| format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""));
    let bound = |text: &String| match text.parse::<f64>() {
        Ok(number) if number.is_finite() => format!("{number:?}"),
        _ => quoted(text),
    };
    let mut text = format!("title = {}\n", quoted(&title.replace(['\n', '\r'], " ")));
    for variable in variables {
        let [low, high] = &variable.bounds;
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "[[vary]]\npath = {}\nname = {}\ndistribution = {{ kind = \"uniform\", from = {}, to = {} }}\n",
            quoted(&variable.path),
            quoted(&variable.name),
            bound(low),
            bound(high)
        );
    }
    text + "[design]\nsamples = 1\n"
}

/// What was typed, for a message: of bounded length.
fn shown(typed: &str) -> String {
    const LONGEST: usize = 120;
    match typed.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &typed[..end]),
        None => typed.to_owned(),
    }
}

/// Faults of that text, at the options instead.
pub(super) fn at_options(error: StudyError, variables: &[Variable]) -> StudyError {
    let StudyError::Input(errors) = error else {
        return error;
    };
    let moved = errors.into_iter().map(|mut error: InputError| {
        if error.name != NAME {
            return error;
        }
        // Follows from the others.
        if error.faults.len() > 1 {
            error
                .faults
                .retain(|fault| !fault.path.starts_with("design"));
        }
        for fault in &mut error.faults {
            let number = fault.path.strip_prefix("vary[").and_then(|rest| {
                let (number, rest) = rest.split_once(']')?;
                Some((number.parse::<usize>().ok()?, rest.to_owned()))
            });
            if let Some((number, rest)) = number
                && let Some(variable) = variables.get(number)
            {
                let rest = rest.replace(".distribution", "");
                let rest = rest.trim_start_matches([':', '.', ' ']);
                let between = if rest.is_empty() { "" } else { ": " };
                fault.path = format!("--vary {}{between}{rest}", shown(&variable.name));
            }
            fault.place = None;
        }
        error.name = "options".into();
        error
    });
    StudyError::Input(moved.collect())
}

/// Name of that text in messages.
pub(super) const NAME: &str = "--vary";

/// The number at a share of the way between the bounds, in the unit of the distribution: by ratios if they differ by
/// much.
pub(super) fn at(distribution: &Distribution, share: f64) -> f64 {
    let Shape::Uniform { from, to } = distribution.shape else {
        return crate::sampling::quantile(distribution, share);
    };
    let number = if by_ratios(from, to) {
        from * libm::pow(to / from, share)
    } else {
        from + (to - from) * share
    };
    number.clamp(from.min(to), from.max(to))
}

fn by_ratios(from: f64, to: f64) -> bool {
    from > 0.0 && to / from >= BY_RATIOS
}
