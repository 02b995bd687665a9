//! From arguments to an assembled model.

use std::path::Path;

use jostle::{GroundMotion, Plan, System};
use jostle_io::{Dimension, Input, ModelTree, Overrides, TreeValue, parse_option};

use crate::args::ModelArgs;
use crate::failure::Failure;
use crate::terminal;

/// The built-in example that runs without a model file.
pub(crate) const EXAMPLE: &str = "paper";

/// A model ready to be stepped.
pub(crate) struct Opened {
    pub(crate) input: Input,
    /// Name for messages and result folders.
    pub(crate) name: String,
    pub(crate) system: System,
    /// Whether the ground motion comes from the command line.
    other_record: bool,
}

/// Reads a model file, or a built-in example, and assembles it.
pub(crate) fn open(model: Option<&Path>, overrides: &Overrides) -> Result<Opened, Failure> {
    let path = model.unwrap_or(Path::new(EXAMPLE));
    assemble(path, read(path)?, overrides)
}

/// The same with every unusual value accepted, as `accept_unusual = true` of the file does.
pub(crate) fn open_accepting(
    model: Option<&Path>,
    overrides: &Overrides,
) -> Result<Opened, Failure> {
    let path = model.unwrap_or(Path::new(EXAMPLE));
    let mut tree = ModelTree::find(path)?;
    tree.set("analysis.accept_unusual", &TreeValue::Flag(true))
        .map_err(|error| Failure::Input(error.to_string()))?;
    assemble(path, tree.input()?, overrides)
}

fn assemble(path: &Path, mut input: Input, overrides: &Overrides) -> Result<Opened, Failure> {
    input
        .apply(overrides)
        .map_err(|error| Failure::Input(error.to_string()))?;
    let system = System::assemble(&input.model).map_err(|faults| input.faults(faults))?;
    input.note_system(&system);
    let name = path.file_stem().map_or_else(
        || EXAMPLE.to_owned(),
        |stem| stem.to_string_lossy().into_owned(),
    );
    Ok(Opened {
        input,
        name,
        system,
        other_record: overrides.record.is_some(),
    })
}

/// Reads a model file, or a built-in example.
pub(crate) fn read(path: &Path) -> Result<Input, Failure> {
    let builtin = path
        .to_str()
        .filter(|name| !path.exists() && jostle_io::model_names().contains(name));
    Ok(match builtin {
        Some(name) => jostle_io::builtin_model(name)?,
        None => jostle_io::read_model_file(path)?,
    })
}

impl Opened {
    /// Prints warnings to standard error.
    pub(crate) fn warn(&self) {
        for warning in &self.input.warnings {
            terminal::warn(warning);
        }
    }

    /// The ground motion and the steps to take through it.
    pub(crate) fn plan(&self) -> Result<(GroundMotion, Plan), Failure> {
        self.plan_of(&self.input)
    }

    /// The same for one of the records of the model.
    pub(crate) fn plan_of(&self, input: &Input) -> Result<(GroundMotion, Plan), Failure> {
        let motion = input
            .ground_motion()
            .map_err(|error| match &error.faults[..] {
                [fault] if self.other_record => {
                    Failure::Input(format!("--record: {}", fault.problem))
                }
                _ => error.into(),
            })?;
        let plan = Plan::choose(&self.system, &motion, &input.model.analysis)
            .map_err(|faults| input.faults(faults))?;
        Ok((motion, plan))
    }
}

impl ModelArgs {
    /// The model with what the options change.
    pub(crate) fn open(&self) -> Result<Opened, Failure> {
        let open = if self.accept_unusual {
            open_accepting
        } else {
            open
        };
        open(self.model.as_deref(), &self.overrides()?)
    }

    /// Changes by options, in SI.
    fn overrides(&self) -> Result<Overrides, Failure> {
        let quantity = |option: &str, text: &Option<String>, dimension| {
            let parsed = text
                .as_ref()
                .map(|text| parse_option(option, text, dimension))
                .transpose();
            parsed.map_err(Failure::Input)
        };
        Ok(Overrides {
            pga: quantity("--pga", &self.pga, Dimension::Acceleration)?,
            gap: quantity("--gap", &self.gap, Dimension::Length)?,
            record: self.record.clone(),
        })
    }
}
