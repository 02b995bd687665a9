//! A model whose results are on record, and the solvers that run it.

use jostle::Solver;
use jostle_io::{Format, Input, read_model_text};
use serde_json::Value;

/// Every solver, as users can ask for it.
pub(super) const ALL: [Solver; 5] = [
    Solver::Modal,
    Solver::Series,
    Solver::Riccati,
    Solver::Stiffness,
    Solver::Product,
];

/// A model, and what is recorded of it.
pub(super) struct Pinned {
    /// Name.
    pub(super) name: String,
    /// The model, or what the reader says against it.
    pub(super) input: Result<Input, String>,
    /// The solvers that run it; one that refuses it is recorded as such.
    pub(super) solvers: Vec<Solver>,
}

impl Pinned {
    /// A drawn model, given as the tree of a model file.
    pub(super) fn drawn(name: String, tree: &Value, solvers: &[Solver]) -> Self {
        let read = read_model_text(&name, &tree.to_string(), Format::Json, "".as_ref());
        Self {
            name,
            input: read.map_err(|error| error.to_string()),
            solvers: solvers.to_vec(),
        }
    }

    /// The same with a motion that is no longer than this \[s\].
    pub(super) fn shortened(mut self, longest: f64) -> Self {
        if let Ok(input) = &mut self.input {
            shorten(input, longest);
        }
        self
    }
}

/// Cuts the motion of a model to this length, if it is longer \[s\].
pub(super) fn shorten(input: &mut Input, longest: f64) {
    if let Some(motion) = &mut input.motion {
        motion.duration = Some(
            motion
                .duration
                .map_or(longest, |duration| duration.min(longest)),
        );
    }
}
