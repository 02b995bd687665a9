//! Cases that go through a model file, like a user's.

use std::ops::ControlFlow;

use jostle::{Outcome, Plan, RunEnd, Settings, System, simulate};
use jostle_io::{Format, Input, read_model_text};

use crate::structures::uniform;

/// A case compared with OpenSees: its name, the model, what OpenSees made of it, and what it may be off.
macro_rules! case {
    ($name:literal, $error:literal) => {
        (
            $name,
            include_str!(concat!("../data/opensees/", $name, ".toml")),
            include_str!(concat!("../data/opensees/", $name, ".json")),
            $error,
        )
    };
}
pub(crate) use case;

/// Reads a model.
pub(crate) fn model(text: &str) -> Input {
    match read_model_text("validation case", text, Format::Toml, "".as_ref()) {
        Ok(input) => input,
        Err(error) => panic!("{error}"),
    }
}

/// Runs a model at a uniform step \[s\], or with steps from its own settings, for so long \[s\].
pub(crate) fn run_model(
    input: &Input,
    step: Option<f64>,
    settings: Settings,
    duration: f64,
) -> (System, Outcome) {
    let mut motion = input.ground_motion().expect("the record is built in");
    motion.duration = duration;
    let system = System::assemble(&input.model).expect("a sound model");
    let plan = match step {
        Some(step) => uniform(step),
        None => Plan::choose(&system, &motion, &input.model.analysis).expect("usable steps"),
    };
    let outcome = simulate(&system, &motion, &plan, settings, |_| {
        ControlFlow::Continue(())
    });
    assert_eq!(outcome.end, RunEnd::Completed, "a validation run ends");
    (system, outcome)
}
