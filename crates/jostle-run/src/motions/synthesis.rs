//! Artificial motions: matched to a spectrum, filtered noise, near-fault pulses, recipes.

use jostle_io::shown::LENGTH;
use jostle_motion::{
    Accelerogram, Envelope, GroundFilter, Makris, MatchSettings, Matched, Mavroeidis, Measures,
    PulseShape, RECIPES, SineSettings, StochasticSettings, TargetSpectrum, match_spectrum,
    measures, near_fault_pulse, recipe, spectrum_compatible, stochastic,
};

use super::{NamedMotion, wrong};
use crate::error::RunError;

/// A motion matched to a spectrum, and how well.
#[derive(Clone, Debug)]
pub struct Synthesis {
    /// Name.
    pub name: String,
    /// The motion and its greatest difference from the spectrum.
    pub matched: Matched,
    /// What was asked for.
    pub matching: MatchSettings,
    /// Name of the spectrum.
    pub target: String,
    /// Measures of the record that was matched; `None` of sines.
    pub before: Option<Measures>,
    /// Measures of the motion.
    pub after: Measures,
}

/// Sines under an envelope, or a record, to be matched to a spectrum.
#[derive(Clone, Debug)]
pub struct SpectrumMatch {
    /// The record; `None` for sines. Its step and duration are kept.
    pub record: Option<NamedMotion>,
    /// Time step of sines, > 0 \[s\].
    pub step: f64,
    /// Length of sines, > 0 \[s\].
    pub duration: f64,
    /// Seed of the phases of sines.
    pub seed: u64,
    /// Peak acceleration; by default that of the code for time histories, or of the spectrum at T = 0 \[m/s²\].
    pub peak: Option<f64>,
    /// First and last matched period; by default from 0.05 s, or four steps, to 6 s, or the end of the spectrum \[s\].
    pub periods: Option<[f64; 2]>,
    /// Damping ratio \[–\].
    pub damping: f64,
    /// Largest difference from the spectrum \[–\].
    pub tolerance: f64,
}

impl SpectrumMatch {
    /// The matched motion.
    ///
    /// # Errors
    /// [`RunError::Argument`] for a number outside its range, or if the spectrum cannot be matched.
    pub fn make(&self, target: &TargetSpectrum) -> Result<Synthesis, RunError> {
        let step = self
            .record
            .as_ref()
            .map_or(self.step, |record| record.motion.step());
        let usual = [0.05_f64.max(4.0 * step), 6.0_f64.min(target.range()[1])];
        let matching = MatchSettings {
            periods: self.periods.unwrap_or(usual),
            damping: self.damping,
            tolerance: self.tolerance,
            peak: self.peak.or_else(|| target.peak_ground_acceleration()),
        };
        let matched = match &self.record {
            Some(record) => match_spectrum(&record.motion, target, &matching),
            None => spectrum_compatible(
                target,
                &SineSettings {
                    step,
                    envelope: Envelope::of_duration(self.duration),
                    seed: self.seed,
                    matching,
                },
            ),
        }
        .map_err(wrong)?;
        let name = match &self.record {
            Some(record) => format!("{} matched to {}", record.name, target.name()),
            None => format!("sines of seed {} matched to {}", self.seed, target.name()),
        };
        let before = self.record.as_ref().map(|record| measures(&record.motion));
        Ok(Synthesis {
            name,
            after: measures(&matched.motion).map_err(wrong)?,
            before: before.transpose().map_err(wrong)?,
            matched,
            matching,
            target: target.name(),
        })
    }
}

impl Synthesis {
    /// How close the motion is to its spectrum, in words.
    #[must_use]
    pub fn closeness(&self) -> String {
        let Self {
            matched, matching, ..
        } = self;
        format!(
            "{}: largest difference {:.1} % at {:.3} s, over {} to {} s with {} % damping; ends at rest where it began",
            self.target,
            100.0 * matched.misfit,
            matched.worst_period,
            matching.periods[0],
            matching.periods[1],
            100.0 * matching.damping
        )
    }

    /// A warning if matching made the displacement of a record much greater.
    #[must_use]
    pub fn warning(&self) -> Option<String> {
        displacement_warning(self.before.as_ref()?, &self.after)
    }
}

/// Growth of the peak displacement, over that of the peak acceleration, from which on a matched record is warned
/// about \[–\].
const MOST_GROWTH: f64 = 2.5;

fn displacement_warning(before: &Measures, after: &Measures) -> Option<String> {
    let scaled = before.pgd.value * after.pga.value / before.pga.value;
    let growth = after.pgd.value / scaled;
    (growth > MOST_GROWTH).then(|| {
        format!(
            "the peak displacement grew from {} to {}, {growth:.1} times that of the record with the same peak acceleration: matching added long periods. End the range earlier with --periods, or take another record",
            LENGTH.number(before.pgd.value, 0),
            LENGTH.text(after.pgd.value, 0)
        )
    })
}

/// Filtered white noise.
#[derive(Clone, Debug, PartialEq)]
pub struct Noise {
    /// Time step, > 0 \[s\].
    pub step: f64,
    /// Length, > 0 \[s\].
    pub duration: f64,
    /// Peak acceleration, > 0 \[m/s²\].
    pub pga: f64,
    /// Seed.
    pub seed: u64,
    /// Frequency of the ground filter, > 0 \[Hz\].
    pub frequency: f64,
    /// Damping of the ground filter \[–\].
    pub ground_damping: f64,
    /// Frequency of the second filter; 0 disables it \[Hz\].
    pub corner: f64,
    /// Damping of the second filter \[–\].
    pub corner_damping: f64,
}

impl Noise {
    /// The motion.
    ///
    /// # Errors
    /// [`RunError::Argument`] for a number outside its range.
    pub fn make(&self) -> Result<NamedMotion, RunError> {
        let settings = StochasticSettings {
            step: self.step,
            envelope: Envelope::of_duration(self.duration),
            seed: self.seed,
            filter: GroundFilter {
                frequency: self.frequency,
                damping: self.ground_damping,
                high_pass: (self.corner != 0.0).then_some([self.corner, self.corner_damping]),
            },
            peak: self.pga,
        };
        Ok(NamedMotion {
            name: format!("filtered noise of seed {}", self.seed),
            motion: stochastic(&settings).map_err(wrong)?,
        })
    }
}

/// A near-fault velocity pulse.
#[derive(Clone, Debug, PartialEq)]
pub struct Pulse {
    /// `mavroeidis`, `makris-a`, `makris-b`, `makris-c1`, `makris-c2`, …
    pub shape: String,
    /// Peak velocity, > 0 \[m/s\].
    pub velocity: f64,
    /// Period, > 0 \[s\].
    pub period: f64,
    /// Oscillations of a mavroeidis pulse, > 1 \[–\].
    pub gamma: f64,
    /// Phase of a mavroeidis pulse \[rad\].
    pub phase: f64,
    /// Times at rest before and after the pulse, ≥ 0 \[s\].
    pub rest: [f64; 2],
    /// Time step, > 0 \[s\].
    pub step: f64,
}

impl Pulse {
    /// The motion.
    ///
    /// # Errors
    /// [`RunError::Argument`] for an unknown shape or a number outside its range.
    pub fn make(&self) -> Result<NamedMotion, RunError> {
        let Self {
            velocity, period, ..
        } = *self;
        let motion = near_fault_pulse(&self.form()?, velocity, period, self.step, self.rest);
        Ok(NamedMotion {
            name: format!("{} pulse, {velocity} m/s, {period} s", self.shape),
            motion: motion.map_err(wrong)?,
        })
    }

    fn form(&self) -> Result<PulseShape, RunError> {
        Ok(match self.shape.to_lowercase().as_str() {
            "mavroeidis" => PulseShape::Mavroeidis(Mavroeidis {
                gamma: self.gamma,
                phase: self.phase,
            }),
            "makris-a" => PulseShape::Makris(Makris::A),
            "makris-b" => PulseShape::Makris(Makris::B),
            other => match other.strip_prefix("makris-c").and_then(|n| n.parse().ok()) {
                Some(cycles) => PulseShape::Makris(Makris::C(cycles)),
                None => {
                    let known = "mavroeidis, makris-a, makris-b, makris-c1, makris-c2, …";
                    return Err(RunError::Argument(format!(
                        "--shape must be one of {known}; found \"{}\"",
                        self.shape
                    )));
                }
            },
        })
    }
}

/// A motion with a name, such as `nanjing-artificial`, made again from its recipe.
///
/// # Errors
/// [`RunError::Argument`] if the name is unknown.
pub fn made_by_recipe(name: &str) -> Result<Synthesis, RunError> {
    let Some(recipe) = recipe(name) else {
        let known: Vec<_> = RECIPES.iter().map(|recipe| recipe.name).collect();
        return Err(RunError::Argument(format!(
            "there is no recipe \"{name}\"; known: {}",
            known.join(", ")
        )));
    };
    let matched = recipe.make().map_err(wrong)?;
    Ok(Synthesis {
        name: recipe.name.to_owned(),
        after: measures(&matched.motion).map_err(wrong)?,
        before: None,
        matched,
        matching: recipe.matching(),
        target: recipe.target().name(),
    })
}

impl Synthesis {
    /// The motion with its name.
    #[must_use]
    pub fn motion(&self) -> (&str, &Accelerogram) {
        (&self.name, &self.matched.motion)
    }
}
