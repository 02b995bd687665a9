//! From a model file to an assembled model.

use std::path::Path;
use std::sync::Arc;

use jostle::judgement::{Known, judge};
use jostle::results::summary::Finding;
use jostle::{GroundMotion, Plan, System};
use jostle_io::{Input, InputError, ModelTree, Overrides, TreeValue};

use crate::error::RunError;
use crate::prepared::Prepared;
use crate::shapes::SharedShapes;

/// The built-in example that runs if no model is named.
pub const EXAMPLE: &str = "paper";

/// A model, read and assembled.
#[derive(Clone)]
pub struct Opened {
    /// The model file.
    pub input: Arc<Input>,
    /// Name for messages and folders of results.
    pub name: String,
    /// The assembled equations of motion.
    pub system: Arc<System>,
    /// Whether the ground motion was named apart from the model file.
    pub other_record: bool,
    shapes: SharedShapes,
}

/// Reads a model file or a built-in example, changes it and assembles it. `accept_unusual` accepts values outside their
/// usual ranges, as `accept_unusual = true` of the file does.
///
/// # Errors
/// [`RunError::Input`] with all faults, [`RunError::Argument`] if a change is out of range.
pub fn open(
    model: Option<&Path>,
    overrides: &Overrides,
    accept_unusual: bool,
) -> Result<Opened, RunError> {
    let path = model.unwrap_or(Path::new(EXAMPLE));
    let mut input = if accept_unusual {
        read_accepting(path)?
    } else {
        read(path)?
    };
    input
        .apply(overrides)
        .map_err(|error| RunError::Argument(error.to_string()))?;
    let mut opened = Opened::new(input, name_of(path))?;
    opened.other_record = overrides.record.is_some();
    Ok(opened)
}

/// Name of a file without its ending, as a folder for its results may be called: `..toml` and its like are no folder.
#[must_use]
pub fn name_of(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    match stem.trim_matches('.') {
        "" => EXAMPLE.to_owned(),
        _ => stem.into_owned(),
    }
}

/// Reads a model file or a built-in example.
///
/// # Errors
/// Every fault of the file.
pub fn read(path: &Path) -> Result<Input, InputError> {
    // A folder, say of earlier results, may have the name of a built-in model.
    let builtin = path.to_str().filter(|name| {
        (!path.exists() || path.is_dir()) && jostle_io::model_names().contains(name)
    });
    match builtin {
        Some(name) => jostle_io::builtin_model(name),
        None => jostle_io::read_model_file(path),
    }
}

fn read_accepting(path: &Path) -> Result<Input, RunError> {
    let mut tree = ModelTree::find(path)?;
    tree.set("analysis.accept_unusual", &TreeValue::Flag(true))
        .map_err(|error| RunError::Argument(error.to_string()))?;
    Ok(tree.input()?)
}

impl Opened {
    /// Assembles a model that has been read, and adds warnings of what is unusual about it to its own.
    ///
    /// # Errors
    /// Faults that only assembly shows, at their lines of the file.
    pub fn new(mut input: Input, name: impl Into<String>) -> Result<Self, InputError> {
        let system = System::assemble(&input.model).map_err(|faults| input.faults(faults))?;
        input.note_system(&system);
        Ok(Self {
            input: Arc::new(input),
            name: name.into(),
            system: Arc::new(system),
            other_record: false,
            shapes: SharedShapes::default(),
        })
    }

    /// The same assembled model with another reading of its file, which may differ in the ground motion only.
    #[must_use]
    pub fn with_input(&self, input: Input) -> Self {
        Self {
            input: Arc::new(input),
            ..self.clone()
        }
    }

    /// The ground motion and the steps to take through it.
    ///
    /// # Errors
    /// [`RunError::Record`] if the record named apart from the file cannot be used, else [`RunError::Input`].
    pub fn plan(&self) -> Result<(GroundMotion, Plan), RunError> {
        self.plan_of(&self.input)
    }

    /// The same for one of the records of the model.
    ///
    /// # Errors
    /// As [`Self::plan`].
    pub fn plan_of(&self, input: &Input) -> Result<(GroundMotion, Plan), RunError> {
        let motion = input
            .ground_motion()
            .map_err(|error| match &error.faults[..] {
                [fault] if self.other_record => RunError::Record(fault.problem.clone()),
                _ => error.into(),
            })?;
        let plan = Plan::choose(&self.system, &motion, &input.model.analysis)
            .map_err(|faults| input.faults(faults))?;
        Ok((motion, plan))
    }

    /// What the checks of the model find, worst first.
    #[must_use]
    pub fn findings(&self, motion: Option<&GroundMotion>) -> Vec<Finding> {
        judge(&Known {
            model: &self.input.model,
            system: &self.system,
            motion,
            stated: &self.input.stated,
            results: None,
        })
    }

    /// The model with its ground motion and its steps, ready to run.
    ///
    /// # Errors
    /// As [`Self::plan`].
    pub fn prepare(&self) -> Result<Prepared, RunError> {
        let (motion, plan) = self.plan()?;
        let system = Arc::clone(&self.system);
        let shapes = self.shapes.find(&system, &plan);
        Ok(Prepared::new(
            Arc::clone(&self.input),
            system,
            motion,
            plan,
            shapes,
        ))
    }
}
