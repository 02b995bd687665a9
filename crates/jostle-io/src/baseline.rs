//! Correction of records whose velocity does not end at rest.

use jostle::{GroundMotion, Wave};
use jostle_motion::{Accelerogram, MotionFault};

/// What becomes of velocities that do not end at rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Baseline {
    /// Nothing.
    AsRecorded,
    /// The slope of the straight line from rest that fits the velocity best is removed from the acceleration.
    Linear,
    /// The same with the slope of a parabola.
    Quadratic,
}

impl Baseline {
    /// Names in model files.
    pub const NAMES: [&'static str; 3] = ["as-recorded", "linear", "quadratic"];

    /// By its name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        match name {
            "as-recorded" => Some(Self::AsRecorded),
            "linear" => Some(Self::Linear),
            "quadratic" => Some(Self::Quadratic),
            _ => None,
        }
    }

    /// Corrects a record; waves given by a formula stay.
    ///
    /// # Errors
    /// [`MotionFault`] for records that are too short.
    pub(crate) fn correct(self, motion: &mut GroundMotion) -> Result<(), MotionFault> {
        let degree = match self {
            Self::AsRecorded => return Ok(()),
            Self::Linear => 1,
            Self::Quadratic => 2,
        };
        if let Wave::Sampled { step, acceleration } = &mut motion.wave {
            let record = Accelerogram::new(*step, acceleration.clone())?;
            let corrected = record.without_velocity_trend(degree)?;
            *acceleration = corrected.acceleration().to_vec();
        }
        Ok(())
    }
}
