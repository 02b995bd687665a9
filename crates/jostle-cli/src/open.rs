//! From arguments to an assembled model.

use std::path::Path;

use jostle_io::shown::follow;
use jostle_io::{Dimension, Overrides, parse_option};
use jostle_run::Opened;

use crate::args::ModelArgs;
use crate::failure::Failure;

/// The model of a command; what the command prints is in the units that it asks for.
pub(crate) fn open_model(
    model: Option<&Path>,
    overrides: &Overrides,
    accept_unusual: bool,
) -> Result<Opened, Failure> {
    let opened = jostle_run::open(model, overrides, accept_unusual)?;
    follow(opened.input.units);
    Ok(opened)
}

impl ModelArgs {
    /// The model with what the options change.
    pub(crate) fn open(&self) -> Result<Opened, Failure> {
        let overrides = self.overrides()?;
        let model = self.model.as_deref();
        open_model(model, &overrides, self.accept_unusual)
    }

    /// Changes by options, in SI.
    pub(crate) fn overrides(&self) -> Result<Overrides, Failure> {
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
            angle: quantity("--angle", &self.angle, Dimension::Dimensionless)?,
        })
    }
}
