//! Statistics of many cases.

mod binary;
mod cloud;
mod curve;
mod fragility;
mod given_data;
mod modified_cloud;
mod resample;
mod sensitivity;

pub use cloud::{CloudFit, fit_cloud};
pub use curve::Curve;
pub use fragility::{FitError, Lognormal, fit_lognormal};
pub(crate) use given_data::classes;
pub use given_data::{GivenData, given_data};
pub use modified_cloud::{Logistic, MixedCurve, ModifiedCloud, fit_modified_cloud};
pub use resample::{Band, bootstrap_band};
pub use sensitivity::{ElementaryEffects, SobolIndex, elementary_effects, sobol_indices};
