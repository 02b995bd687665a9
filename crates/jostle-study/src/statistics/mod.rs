//! What many cases say together.

mod cloud;
mod fragility;
mod resample;
mod sensitivity;

pub use cloud::{CloudFit, fit_cloud};
pub use fragility::{FitError, Lognormal, fit_lognormal};
pub(crate) use resample::percentile;
pub use resample::{Band, bootstrap_band};
pub use sensitivity::{ElementaryEffects, SobolIndex, elementary_effects, sobol_indices};
