//! Ground motions by themselves: processing, artificial motions, sets of motions, files.

mod processing;
mod selection;
mod synthesis;
mod words;
mod write;

pub use processing::Processing;
pub use selection::{Selection, SelectionRequest};
pub use synthesis::{Noise, Pulse, SpectrumMatch, Synthesis, made_by_recipe};
pub use words::{measures_json, motion_in_short, motion_text};
pub use write::write_motion;

use jostle::{GroundMotion, Wave};
use jostle_io::MotionSpec;
use jostle_motion::{Accelerogram, MotionFault};

use crate::error::RunError;

/// Equally spaced accelerations with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedMotion {
    /// Name.
    pub name: String,
    /// Accelerations.
    pub motion: Accelerogram,
}

impl NamedMotion {
    /// The motion that a model or a command names, scaled as it says.
    ///
    /// # Errors
    /// It cannot be read, or is given by a formula.
    pub fn resolve(spec: &MotionSpec) -> Result<Self, String> {
        let motion = spec.resolve().map_err(|error| error.to_string())?;
        let GroundMotion { name, wave, .. } = motion;
        match wave {
            Wave::Sampled { step, acceleration } => Ok(Self {
                name,
                motion: Accelerogram::new(step, acceleration).map_err(|fault| fault.to_string())?,
            }),
            _ => Err(format!("{name} is no record")),
        }
    }
}

/// An error in the request.
fn wrong(fault: MotionFault) -> RunError {
    RunError::Argument(fault.to_string())
}
