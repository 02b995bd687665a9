//! The ground motion of a model: its source and its values.

mod grounds;

pub use grounds::{GroundsSpec, OwnGroundSpec, OwnMotionSpec};

use std::path::Path;

use jostle::{Bearing, GroundMotion, Wave};
use jostle_motion::{
    Accelerogram, MatchAt, MotionFault, SpectrumTable, TargetKind, TargetSpectrum, match_factor,
};

use crate::builtin;
use crate::files::Files;
use crate::nearest::nearest;
use crate::record::{GREATEST_ACCELERATION, RecordError, RecordOptions, read_record_of};
use crate::source::BACKSLASH;

/// The ground motion of a model file.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionSpec {
    /// Where the motion comes from.
    pub source: MotionSource,
    /// How it is scaled.
    pub scaling: Scaling,
    /// Whether its sign is changed.
    pub reverse: bool,
    /// Length of the analysis; `None` is as long as the record \[s\].
    pub duration: Option<f64>,
    /// Direction in plan and motion across, for buildings with plans.
    pub bearing: Option<Box<BearingSpec>>,
    /// Ground that differs under the buildings, and vertical shaking.
    pub grounds: Option<Box<GroundsSpec>>,
}

/// Where a ground motion comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum MotionSource {
    /// A built-in record by name, or else a file.
    Record {
        /// Name or path as written.
        name: String,
        /// Where a file of that name is looked for.
        files: Files,
        /// Data missing in the file.
        options: RecordOptions,
    },
    /// Several records, two at least, of which a run takes one.
    Records {
        /// Names or paths as written.
        names: Vec<String>,
        /// Where files of these names are looked for.
        files: Files,
        /// Data missing in the files.
        options: RecordOptions,
    },
    /// A motion given as values, unscaled.
    Given(GroundMotion),
    /// `amplitude · sin(2π t / period)`.
    Sine {
        /// Amplitude \[m/s²\].
        amplitude: f64,
        /// Period \[s\].
        period: f64,
    },
    /// Ricker pulse.
    Ricker {
        /// Peak acceleration \[m/s²\].
        amplitude: f64,
        /// Period of the strongest harmonic \[s\].
        period: f64,
        /// Time of the peak \[s\].
        centre: f64,
    },
}

impl MotionSource {
    /// A record, or several.
    pub(crate) fn of_records(mut names: Vec<String>, files: Files, options: RecordOptions) -> Self {
        if names.len() == 1 {
            let name = names.remove(0);
            return Self::Record {
                name,
                files,
                options,
            };
        }
        Self::Records {
            names,
            files,
            options,
        }
    }

    /// One of several records; any other source as it is.
    fn one_of_several(&self, index: usize) -> Self {
        match self {
            Self::Records {
                names,
                files,
                options,
            } => Self::Record {
                name: names[index].clone(),
                files: files.clone(),
                options: options.clone(),
            },
            other => other.clone(),
        }
    }

    /// How many records a run may choose from.
    pub(crate) fn count(&self) -> usize {
        match self {
            Self::Records { names, .. } => names.len(),
            _ => 1,
        }
    }

    /// Whether it states the size of its accelerations, which a record in the factor of another motion does not.
    pub(crate) fn states_its_size(&self) -> bool {
        match self {
            Self::Sine { .. } | Self::Ricker { .. } => true,
            Self::Record { .. } | Self::Records { .. } | Self::Given(_) => false,
        }
    }
}

/// Direction of a motion in plan, and the motion across it.
#[derive(Clone, Debug, PartialEq)]
pub struct BearingSpec {
    /// Angle from x to the motion, counter-clockwise \[rad\].
    pub angle: f64,
    /// The motion at a right angle to it.
    pub across: Option<MotionSpec>,
}

/// A spectral value to scale to.
#[derive(Clone, Debug, PartialEq)]
pub struct MatchSpec {
    /// Target value.
    pub to: MatchTo,
    /// Where to reach it.
    pub at: MatchAt,
    /// Damping ratio \[–\].
    pub damping: f64,
}

/// Target of a scaling.
#[derive(Clone, Debug, PartialEq)]
pub enum MatchTo {
    /// A design spectrum.
    Spectrum(TargetSpectrum),
    /// A pseudo-acceleration, the same at all periods of the range, > 0 \[m/s²\].
    Value(f64),
}

/// How a motion is scaled.
#[derive(Clone, Debug, PartialEq, Default)]
pub enum Scaling {
    /// Not at all.
    #[default]
    AsRecorded,
    /// To this peak ground acceleration of the whole record, > 0 \[m/s²\].
    Pga(f64),
    /// By this factor \[–\].
    Factor(f64),
    /// Each of several records by a factor of its own \[–\].
    FactorOfEach(Vec<f64>),
    /// So that its response spectrum agrees with another.
    Match(Box<MatchSpec>),
}

/// Why a ground motion could not be had.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MotionError {
    /// The model has no motion.
    #[error(
        "the model has no ground motion; add [motion] with a record, such as \"el-centro-1940-ns\""
    )]
    None,
    /// The model names several.
    #[error("is a list of {} records, and one analysis takes one", .names.len())]
    Several {
        /// Names as written.
        names: Vec<String>,
    },
    /// Neither a built-in record nor a file.
    #[error("there is no record \"{}\" {folder}{}; built-in records: {}", printable(name), remedy(name, .nearest), builtin::record_names())]
    NotFound {
        /// Name as written.
        name: String,
        /// Where it was looked for, in words.
        folder: String,
        /// Built-in names and files that are spelt similarly.
        nearest: Vec<String>,
    },
    /// The file has a fault.
    #[error("{name}{error}")]
    Record {
        /// Name of the file.
        name: String,
        /// The fault.
        error: RecordError,
    },
    /// A motion without acceleration cannot be scaled to a peak.
    #[error("the record \"{name}\" is zero throughout and cannot be scaled to a peak")]
    Zero {
        /// Name of the record.
        name: String,
    },
    /// A motion cannot be brought to a spectrum.
    #[error("the motion \"{name}\" cannot be matched: {error}")]
    Match {
        /// Name of the record.
        name: String,
        /// The reason.
        error: MotionFault,
    },
    /// A motion under one building, or upwards.
    #[error("{error}")]
    Own {
        /// Its table.
        path: String,
        /// What is wrong.
        error: Box<MotionError>,
    },
    /// Records that end with different velocities pull the grounds apart.
    #[error(
        "the records \"{}\" and \"{}\" end with {:.4} m/s and {:.4} m/s, which differ by more than 1 % of the greatest ground velocity, {peak:.3} m/s: the grounds would drift apart", .names[0], .names[1], .ends[0], .ends[1]
    )]
    Drift {
        /// Names of two records.
        names: [String; 2],
        /// Their velocities at the end \[m/s\].
        ends: [f64; 2],
        /// Greatest ground velocity \[m/s\].
        peak: f64,
    },
    /// A motion cannot lose coherency.
    #[error("no motions can be made that lose coherency: {error}")]
    Coherency {
        /// The reason.
        error: MotionFault,
    },
    /// Coherency of a wave given by a formula.
    #[error("coherency needs a record, since a wave given by a formula has one frequency")]
    NoRecord,
    /// A baseline cannot be removed.
    #[error("the baseline of \"{name}\" cannot be corrected: {error}")]
    Baseline {
        /// Name of the record.
        name: String,
        /// The reason.
        error: MotionFault,
    },
    /// Scaling left the range of numbers.
    #[error(
        "the scaled motion \"{name}\" exceeds 100 m/s2; check pga, scale and the unit of the record"
    )]
    TooStrong {
        /// Name of the record.
        name: String,
    },
}

/// A name with what cannot be seen spelt out, as `\n`.
fn printable(name: &str) -> String {
    let spelt = |c: char| match c {
        _ if c.is_control() => c.escape_default().to_string(),
        _ => c.to_string(),
    };
    name.chars().map(spelt).collect()
}

fn remedy(name: &str, nearest: &[String]) -> String {
    if name.contains(char::is_control) {
        format!("; {BACKSLASH}")
    } else if nearest.is_empty() {
        String::new()
    } else {
        format!(" (did you mean \"{}\"?)", nearest.join("\" or \""))
    }
}

impl MotionSpec {
    /// A record as recorded, by built-in name or by path from the current folder.
    #[must_use]
    pub fn record(name: &str) -> Self {
        Self {
            source: MotionSource::Record {
                name: name.to_owned(),
                files: Files::beside(Path::new("")),
                options: RecordOptions::default(),
            },
            scaling: Scaling::AsRecorded,
            reverse: false,
            duration: None,
            bearing: None,
            grounds: None,
        }
    }

    /// The records that a run may choose from; empty unless there are several.
    #[must_use]
    pub fn records(&self) -> &[String] {
        match &self.source {
            MotionSource::Records { names, .. } => names,
            _ => &[],
        }
    }

    /// The same with one of several records, by its name as written, and with its components across and vertical; `None` if it
    /// is not among them.
    #[must_use]
    pub fn with_one_of_several(&self, record: &str) -> Option<Self> {
        let index = self.records().iter().position(|name| name == record)?;
        let mut one = self.clone();
        one.source = one.source.one_of_several(index);
        if let Scaling::FactorOfEach(factors) = &one.scaling {
            one.scaling = factors.get(index).copied().map(Scaling::Factor)?;
        }
        if let Some(across) = one
            .bearing
            .as_mut()
            .and_then(|bearing| bearing.across.as_mut())
        {
            across.source = across.source.one_of_several(index);
        }
        let vertical = one
            .grounds
            .as_mut()
            .and_then(|ground| ground.vertical.as_mut());
        if let Some(source) = vertical.and_then(|vertical| vertical.source.as_mut()) {
            *source = source.one_of_several(index);
        }
        Some(one)
    }

    /// Reads the record, if it is one, and scales it.
    ///
    /// A peak refers to the whole record, also when the analysis is shorter, so that cutting the end of a
    /// record does not change its beginning.
    ///
    /// # Errors
    /// [`MotionError`] when the record cannot be found or read, or cannot be scaled.
    pub fn resolve(&self) -> Result<GroundMotion, MotionError> {
        let mut motion = match &self.source {
            MotionSource::Record {
                name,
                files,
                options,
            } => find_record(name, files, options)?,
            MotionSource::Records { names, .. } => {
                return Err(MotionError::Several {
                    names: names.clone(),
                });
            }
            MotionSource::Given(motion) => motion.clone(),
            MotionSource::Sine { amplitude, period } => analytic(
                "sine",
                self.duration.unwrap_or(10.0 * period),
                Wave::Sine {
                    amplitude: *amplitude,
                    period: *period,
                },
            ),
            MotionSource::Ricker {
                amplitude,
                period,
                centre,
            } => analytic(
                "Ricker pulse",
                self.duration.unwrap_or(centre + 10.0 * period),
                Wave::Ricker {
                    amplitude: *amplitude,
                    period: *period,
                    centre: *centre,
                },
            ),
        };
        if let Some(baseline) = self.grounds.as_ref().and_then(|grounds| grounds.baseline) {
            let corrected = baseline.correct(&mut motion);
            corrected.map_err(|error| MotionError::Baseline {
                name: motion.name.clone(),
                error,
            })?;
        }
        let peak = motion.unscaled_peak();
        motion.scale = match &self.scaling {
            Scaling::AsRecorded => 1.0,
            Scaling::Factor(factor) => *factor,
            // A run takes one record of several.
            Scaling::FactorOfEach(factors) => factors.first().copied().unwrap_or(1.0),
            Scaling::Match(wanted) => match_scale(&motion, wanted)?,
            Scaling::Pga(_) if peak == 0.0 => {
                return Err(MotionError::Zero { name: motion.name });
            }
            Scaling::Pga(pga) => pga / peak,
        };
        if self.reverse {
            motion.scale = -motion.scale;
        }
        let strongest = motion.scale.abs() * peak;
        if !motion.scale.is_finite() || strongest > GREATEST_ACCELERATION {
            return Err(MotionError::TooStrong { name: motion.name });
        }
        motion.duration = self.duration.unwrap_or(motion.duration);
        let motion_scale = motion.scale;
        if let Some(spec) = &self.bearing {
            let mut across = spec.across.as_ref().map(Self::resolve).transpose()?;
            // Two components of one record keep their ratio; what states an amplitude or a scaling of its own keeps it.
            if let (Some(motion), Some(across_spec)) = (&mut across, &spec.across)
                && across_spec.scaling == Scaling::AsRecorded
                && !across_spec.source.states_its_size()
            {
                motion.scale *= motion_scale;
            }
            motion.bearing = Some(Box::new(Bearing {
                angle: spec.angle,
                across,
            }));
        }
        if let Some(grounds) = &self.grounds {
            motion.grounds = grounds.resolve(self, &motion)?;
        }
        Ok(motion)
    }
}

/// The factor that brings a motion to a spectrum.
fn match_scale(motion: &GroundMotion, wanted: &MatchSpec) -> Result<f64, MotionError> {
    let found = (|| {
        let sampled = sampled(motion)?;
        let target = match &wanted.to {
            MatchTo::Spectrum(target) => target.clone(),
            MatchTo::Value(value) => {
                let points = vec![[0.0, *value], [1e6, *value]];
                let table = SpectrumTable::new("value", wanted.damping, points)?;
                TargetSpectrum::new(TargetKind::Table(table))
            }
        };
        match_factor(&sampled, &target, wanted.at, wanted.damping)
    })();
    found.map_err(|error| MotionError::Match {
        name: motion.name.clone(),
        error,
    })
}

/// A motion as equally spaced values; waves given by a formula take 200 in a period.
fn sampled(motion: &GroundMotion) -> Result<Accelerogram, MotionFault> {
    if let Wave::Sampled { step, acceleration } = &motion.wave {
        return Accelerogram::new(*step, acceleration.clone());
    }
    let step = motion.period().unwrap_or(1.0) / 200.0;
    let points = ((motion.duration / step).ceil() as usize).clamp(2, 1 << 22);
    let values = (0..points).map(|i| motion.acceleration(step * i as f64));
    Accelerogram::new(step, values.collect())
}

fn analytic(name: &str, duration: f64, wave: Wave) -> GroundMotion {
    GroundMotion {
        name: name.to_owned(),
        scale: 1.0,
        duration,
        wave,
        bearing: None,
        grounds: None,
    }
}

/// A built-in record, or the file of that name.
fn find_record(
    name: &str,
    files: &Files,
    options: &RecordOptions,
) -> Result<GroundMotion, MotionError> {
    if let Some(motion) = builtin::builtin_record(name) {
        return Ok(motion);
    }
    let path = files.shown(name);
    let error = |error| MotionError::Record {
        name: path.display().to_string(),
        error,
    };
    if !files.has(name).map_err(|found| error(found.into()))? {
        return Err(MotionError::NotFound {
            name: name.to_owned(),
            folder: files.place_in_words(),
            nearest: similar_names(name, files),
        });
    }
    let record = read_record_of(files, name, options).map_err(error)?;
    let title = if names_a_direction(&path) {
        path.file_name()
    } else {
        path.file_stem()
    };
    let title = title.unwrap_or(path.as_os_str());
    Ok(GroundMotion::sampled(
        &title.to_string_lossy(),
        record.step,
        record.acceleration,
    ))
}

/// Whether the extension distinguishes components of a station: `.NS`, `.EW2`.
fn names_a_direction(path: &Path) -> bool {
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    let letters = extension.trim_end_matches(['1', '2']).to_ascii_uppercase();
    matches!(&letters[..], "NS" | "EW" | "UD")
}

/// The built-in record and the file in the same folder with the most similar names.
fn similar_names(name: &str, files: &Files) -> Vec<String> {
    let aliases = builtin::BUILTIN_RECORDS
        .iter()
        .flat_map(|record| record.aliases);
    let names = builtin::builtin_motions();
    let known = names.iter().map(|(name, _)| *name).chain(aliases.copied());
    let builtin = nearest(name, known).map(str::to_owned);
    let wanted = Path::new(name)
        .file_name()
        .map(|n| n.to_string_lossy().into_owned())
        .unwrap_or_default();
    let beside = files.names_beside(name);
    let file = nearest(&wanted, beside.iter().map(String::as_str)).map(str::to_owned);
    builtin.into_iter().chain(file).collect()
}
