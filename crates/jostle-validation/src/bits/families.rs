//! Families of models, each with a file of results.

use serde_json::{Value, json};

use super::numbers::entries;
use super::pinned::Pinned;
use super::recorded::Recorded;
use super::run_results::run;
use super::{
    answers, examples, in_plane, in_space, isolated, linked, on_grounds, on_soil, parts, yielding,
};

/// Models of one kind.
pub(super) struct Family {
    /// Name, also of the file.
    pub(super) name: &'static str,
    /// Its models.
    pub(super) models: fn() -> Vec<Pinned>,
    /// What is recorded of a model.
    of_model: fn(Pinned) -> Vec<Case>,
}

/// All of them.
pub(super) const FAMILIES: [Family; 11] = [
    family("plane", in_plane::models),
    family("examples", examples::models),
    family("opensees", examples::compared_models),
    family("space", in_space::models),
    family("isolated", isolated::models),
    family("soil", on_soil::models),
    family("linked", linked::models),
    family("grounds", on_grounds::models),
    family("yielding", yielding::models),
    family("parts", parts::models),
    Family {
        name: "answers",
        models: answers::models,
        of_model: answers::cases,
    },
];

/// Models that are run.
const fn family(name: &'static str, models: fn() -> Vec<Pinned>) -> Family {
    Family {
        name,
        models,
        of_model: runs,
    }
}

impl Family {
    /// Name of its file.
    pub(super) fn file(&self) -> String {
        format!("{}.txt.gz", self.name)
    }

    /// What is computed for it, in order.
    pub(super) fn cases(&self) -> Vec<Case> {
        (self.models)()
            .into_iter()
            .flat_map(self.of_model)
            .collect()
    }
}

/// A result and how to find it.
pub(super) struct Case {
    /// Model and solver, or model and answer.
    pub(super) name: String,
    find: Box<dyn Fn() -> Value + Send + Sync>,
}

impl Case {
    /// A result of a model.
    pub(super) fn new(name: String, find: impl Fn() -> Value + Send + Sync + 'static) -> Self {
        Self {
            name,
            find: Box::new(find),
        }
    }

    /// Computes it.
    pub(super) fn recorded(&self) -> Recorded {
        Recorded {
            name: self.name.clone(),
            entries: entries(&(self.find)()),
        }
    }
}

/// A model under each of its solvers.
fn runs(model: Pinned) -> Vec<Case> {
    let Pinned {
        name,
        input,
        solvers,
    } = model;
    let one = |solver| {
        let input = input.clone();
        Case::new(
            format!("{name} {}", jostle::Solver::name(solver)),
            move || match &input {
                Ok(input) => run(input, solver),
                Err(problem) => json!({ "unread": problem }),
            },
        )
    };
    solvers.into_iter().map(one).collect()
}
