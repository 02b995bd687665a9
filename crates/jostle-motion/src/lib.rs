//! Ground motions: measures, processing, response and design spectra, artificial motions.
//!
//! Mathematics only: nothing here opens a file, reads a clock or prints. Everything is in SI and radians, and every
//! result has the same bits for the same input on any register width.

#![cfg_attr(not(test), deny(clippy::disallowed_methods))] // bits of results depend on no processor

mod accelerogram;
mod fault;
mod filter;
mod fourier;
mod governing;
mod inelastic;
mod integration;
mod intensity;
mod lanes;
mod least_squares;
mod oscillator;
mod peaks;
mod processing;
mod scaling;
mod selection;
mod spectrum;
mod synthesis;
mod target;
mod transform;
mod uneven;

pub use accelerogram::{Accelerogram, STANDARD_GRAVITY};
pub use fault::MotionFault;
pub use filter::{Butterworth, butterworth};
pub use fourier::{FourierSpectrum, fourier_spectrum, mean_period};
pub use governing::{Governing, GoverningRule, GoverningStatistic};
pub use inelastic::{DuctilitySpectrum, bilinear_displacement, ductility_spectrum};
pub use integration::{Peak, displacement, velocity};
pub use intensity::{Measures, husid, measures};
pub use oscillator::Oscillator;
pub use peaks::{Extreme, Response, peak_responses};
pub use scaling::{MatchAt, match_factor};
pub use selection::{
    Candidate, MainPeriod, Origin, RuleKind, SelectionCheck, SelectionCode, SelectionRule,
    check_selection,
};
pub use spectrum::{Reading, ResponseSpectrum, SpectrumCurve, response_spectrum, spaced_periods};
pub use synthesis::{
    Coherency, Envelope, GroundFilter, Makris, MatchSettings, Matched, Mavroeidis, PulseShape,
    RECIPES, Recipe, SineSettings, StochasticSettings, coherent_with, match_spectrum, misfit,
    near_fault_pulse, recipe, sine_wave, spectrum_compatible, stochastic,
};
pub use target::{
    Asce7, En1998, EnGround, EnType, Gb50011, GbGroup, GbIntensity, GbLevel, GbSite, SpectrumTable,
    TargetKind, TargetSpectrum,
};
pub use uneven::{UnevenMotion, uneven_spectrum};
