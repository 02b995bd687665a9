//! Result of reading a format: channels of raw values, checked against the header.

use super::channel::{Channel, Direction};
use super::error::RecordError;
use super::formats::RecordFormat;
use super::header::malformed;
use super::lines::LineMap;
use super::units::{acceleration_unit, option_unit};
use super::{Record, RecordOptions};
use crate::record::GREATEST_ACCELERATION;
use jostle::statics::STANDARD_GRAVITY;

/// Which numbers a channel has, and what may be said about them from outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Scale {
    /// Free text: options take precedence over the file.
    Loose,
    /// Free text whose reader has already applied the options.
    Settled,
    /// The format states unit and scale; options may not contradict.
    Stated,
    /// Counts or unknown: the options must state unit and scale.
    Counts,
}

/// The peak that a header states.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Peak {
    /// With its sign if the format prints one, in the unit of the values.
    pub(crate) value: f64,
    /// Unit of the last printed digit.
    pub(crate) digit: f64,
    /// Line of the header, 0 for binary formats.
    pub(crate) line: usize,
    /// Time of the peak and its last printed digit \[s\].
    pub(crate) time: Option<(f64, f64)>,
}

/// A channel with its values.
#[derive(Clone, Debug)]
pub(crate) struct Trace {
    pub(crate) name: String,
    pub(crate) direction: Direction,
    /// Name and size of the unit of the values.
    pub(crate) unit: Option<(String, f64)>,
    pub(crate) step: Option<f64>,
    pub(crate) values: Vec<f64>,
    pub(crate) lines: LineMap,
    pub(crate) peak: Option<Peak>,
}

/// A whole file.
#[derive(Clone, Debug)]
pub(crate) struct Contents {
    pub(crate) format: RecordFormat,
    pub(crate) scale: Scale,
    pub(crate) station: String,
    pub(crate) event: String,
    pub(crate) date: String,
    pub(crate) traces: Vec<Trace>,
}

impl Contents {
    /// A file that contains only numbers.
    pub(crate) fn new(format: RecordFormat, scale: Scale) -> Self {
        Self {
            format,
            scale,
            station: String::new(),
            event: String::new(),
            date: String::new(),
            traces: Vec::new(),
        }
    }

    pub(crate) fn channels(&self) -> Vec<Channel> {
        let channel = |(at, trace): (usize, &Trace)| Channel {
            number: at + 1,
            name: trace.name.clone(),
            direction: trace.direction,
            unit: trace.unit.as_ref().map(|(name, _)| name.clone()),
            step: trace.step,
            points: trace.values.len(),
            stated_peak: trace.peak.map(|peak| peak.value),
            largest: largest(&trace.values),
        };
        self.traces.iter().enumerate().map(channel).collect()
    }

    /// Compares the values with the peaks that the header states, and their times, which check the step.
    pub(crate) fn check_peaks(&self) -> Result<(), RecordError> {
        for trace in &self.traces {
            let Some(peak) = trace.peak else { continue };
            let found = largest(&trace.values);
            // Peaks are rounded or truncated, and computed from values with other digits.
            let allowed = 1.001 * peak.digit + 1e-6 * found;
            let wanted = peak.value.abs();
            if (found - wanted).abs() > allowed {
                return Err(RecordError::Peak {
                    format: self.format,
                    line: peak.line,
                    stated: peak.value,
                    found,
                });
            }
            if let (Some((time, digit)), Some(step)) = (peak.time, trace.step) {
                let least = wanted - 2.0 * allowed;
                let around = 1.01 * step + digit;
                // Several values may be rounded to the peak.
                let fits = |(at, value): (usize, &f64)| {
                    value.abs() >= least && (at as f64 * step - time).abs() <= around
                };
                if !trace.values.iter().enumerate().any(fits) {
                    let problem = format!(
                        "the peak of the values does not stand at {time} s, where the header has it; one of them is damaged"
                    );
                    return Err(malformed(self.format, peak.line, problem));
                }
            }
        }
        Ok(())
    }

    /// One channel in SI.
    pub(crate) fn into_record(
        mut self,
        index: usize,
        options: &RecordOptions,
    ) -> Result<Record, RecordError> {
        let trace = self.traces.swap_remove(index);
        let mut values = trace.values;
        let largest_raw = largest(&values);
        if values.len() < 2 {
            return Err(RecordError::TooFew {
                found: values.len(),
            });
        }
        let unit = unit(self.format, self.scale, trace.unit, options)?;
        let (unit, size) = unit.ok_or(match self.scale {
            Scale::Counts => RecordError::CountsUnknown {
                format: self.format,
                largest: largest_raw,
            },
            _ => RecordError::UnitUnknown {
                largest: largest_raw,
            },
        })?;
        let step = step(self.format, self.scale, trace.step, options)?;
        let scale = scale(self.format, self.scale, options)?;
        take_off_mean(&mut values, self.scale, options)?;

        let largest = largest(&values) * scale.unwrap_or(1.0).abs();
        let is_g = (size / STANDARD_GRAVITY - 1.0).abs() < 0.01;
        if is_g && largest > 20.0 {
            return Err(RecordError::SurelyNotG { largest });
        }
        let factor = scale.map_or(size, |scale| scale * size);
        for (at, value) in values.iter_mut().enumerate() {
            let acceleration = *value * factor;
            if acceleration.abs() > GREATEST_ACCELERATION || !acceleration.is_finite() {
                return Err(RecordError::TooStrong {
                    line: trace.lines.line_of(at),
                    value: *value * scale.unwrap_or(1.0),
                    unit,
                });
            }
            *value = acceleration;
        }
        check_step(step)?;
        Ok(Record {
            step,
            acceleration: values,
        })
    }
}

pub(crate) fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m: f64, v| m.max(v.abs()))
}

pub(crate) fn mean(values: &[f64]) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    values.iter().sum::<f64>() / values.len() as f64
}

pub(crate) fn check_step(step: f64) -> Result<(), RecordError> {
    if (1e-6..=10.0).contains(&step) {
        Ok(())
    } else {
        Err(RecordError::Step { step })
    }
}

/// The unit, from the options or from the file.
fn unit(
    format: RecordFormat,
    scale: Scale,
    stated: Option<(String, f64)>,
    options: &RecordOptions,
) -> Result<Option<(String, f64)>, RecordError> {
    let wanted = option_unit(options)?;
    match (scale, stated, wanted) {
        (Scale::Stated, Some((name, size)), Some((_, wanted)))
            if (wanted / size - 1.0).abs() > 1e-3 =>
        {
            Err(RecordError::Stated {
                format,
                key: "unit",
                what: "its unit",
                stated: name,
            })
        }
        (Scale::Stated | Scale::Settled, stated @ Some(_), _) => Ok(stated),
        (_, stated, wanted) => Ok(wanted.or(stated)),
    }
}

/// The time step, from the options or from the file.
fn step(
    format: RecordFormat,
    scale: Scale,
    stated: Option<f64>,
    options: &RecordOptions,
) -> Result<f64, RecordError> {
    match (scale, stated, options.step) {
        (Scale::Loose, stated, wanted) => wanted.or(stated),
        (Scale::Settled, stated, _) => stated,
        (_, Some(stated), Some(wanted)) if (wanted / stated - 1.0).abs() > 1e-3 => {
            return Err(RecordError::Stated {
                format,
                key: "step",
                what: "its time step",
                stated: format!("{stated} s"),
            });
        }
        // Within the tolerance above, the step asked for has the digits that the header lost.
        (_, stated, wanted) => wanted.or(stated),
    }
    .ok_or(RecordError::StepUnknown)
}

/// The factor on the numbers that the user gives.
fn scale(
    format: RecordFormat,
    scale: Scale,
    options: &RecordOptions,
) -> Result<Option<f64>, RecordError> {
    match (options.scale, scale) {
        (Some(found), _) if !found.is_finite() || found == 0.0 => {
            Err(RecordError::OptionScale { found })
        }
        (Some(found), Scale::Stated) if found != 1.0 => Err(RecordError::Stated {
            format,
            key: "record_scale",
            what: "the size of its numbers",
            stated: "use scale to scale the motion".into(),
        }),
        (found, _) => Ok(found),
    }
}

/// A mean larger than this part of the swing around it is the zero of an instrument.
const TELLING_OFFSET: f64 = 0.1;

fn take_off_mean(
    values: &mut [f64],
    scale: Scale,
    options: &RecordOptions,
) -> Result<(), RecordError> {
    let remove = match options.remove_mean {
        Some(remove) => remove,
        None if scale == Scale::Counts => {
            let mean = mean(values);
            let swing = values.iter().fold(0.0, |m: f64, v| m.max((v - mean).abs()));
            if mean.abs() > TELLING_OFFSET * swing {
                let rounded = |value: f64| format!("{value:.4e}").parse().unwrap_or(value);
                return Err(RecordError::Offset {
                    mean: rounded(mean),
                    swing: rounded(swing),
                });
            }
            false
        }
        None => false,
    };
    if remove {
        let mean = mean(values);
        values.iter_mut().for_each(|value| *value -= mean);
    }
    Ok(())
}

/// A unit that a format states in words.
pub(crate) fn named_unit(name: &str) -> Option<(String, f64)> {
    acceleration_unit(name).map(|size| (name.to_owned(), size))
}
