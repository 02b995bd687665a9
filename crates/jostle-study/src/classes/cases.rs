//! Motions of classes, and how strong they are.

use jostle_batch::Motion;
use jostle_io::{ClassesFile, ClassesMeasure, InputError, MotionSource, MotionSpec};
use jostle_motion::{Accelerogram, Reading, response_spectrum};

/// Multiples of the first period that AvgSA takes: 0.2, 0.3, …, 3.
const AVERAGED: std::ops::RangeInclusive<u32> = 2..=30;

/// Motions by name, as batches take them.
#[derive(Debug)]
pub(crate) struct Motions {
    pub(crate) names: Vec<String>,
    pub(crate) all: Vec<Motion>,
    records: Vec<Accelerogram>,
}

impl Motions {
    /// Those of a file.
    ///
    /// # Errors
    /// A record that cannot be read, or is not along one line.
    pub(crate) fn new(file: &ClassesFile) -> Result<Self, InputError> {
        let spec = &file.motion;
        if spec.bearing.is_some() || spec.grounds.is_some() {
            return Err(file.fault(
                "motion",
                "classes take one motion along the row: remove angle, across and what differs between buildings",
            ));
        }
        let specs: Vec<MotionSpec> = match &spec.source {
            MotionSource::Records { names, .. } => names
                .iter()
                .filter_map(|name| spec.with_one_of_several(name))
                .collect(),
            _ => vec![spec.clone()],
        };
        let (mut names, mut all, mut records) = (Vec::new(), Vec::new(), Vec::new());
        for spec in &specs {
            let wrong = |problem: String| file.fault("motion.record", problem);
            let motion = spec.resolve().map_err(|error| wrong(error.to_string()))?;
            let record = jostle_run::accelerogram(&motion)
                .map_err(|fault| wrong(format!("{}: {fault}", motion.name)))?;
            all.push(Motion {
                step: record.step(),
                acceleration: record.acceleration().to_vec(),
            });
            records.push(record);
            names.push(motion.name);
        }
        Ok(Self {
            names,
            all,
            records,
        })
    }

    /// Intensity of every motion, unscaled \[m/s²\], for a first period \[s\].
    ///
    /// # Errors
    /// A period out of range.
    pub(crate) fn intensities(
        &self,
        measure: ClassesMeasure,
        period: f64,
    ) -> Result<Vec<f64>, String> {
        let of = |record: &Accelerogram| {
            let periods: Vec<f64> = match measure {
                ClassesMeasure::Pga => vec![0.0],
                ClassesMeasure::SaT1 => vec![period],
                ClassesMeasure::AvgSa => AVERAGED
                    .map(|tenths| 0.1 * f64::from(tenths) * period)
                    .collect(),
            };
            let spectrum = response_spectrum(record, &periods, &[0.05], Reading::Between);
            let spectrum = spectrum.map_err(|fault| fault.to_string())?;
            let curve = spectrum.curves.first();
            let values = curve.map_or(&[][..], |curve| &curve.pseudo_acceleration);
            let logs: f64 = values
                .iter()
                .map(|pseudo_acceleration| libm::log(*pseudo_acceleration))
                .sum();
            Ok(libm::exp(logs / values.len().max(1) as f64))
        };
        self.records.iter().map(of).collect()
    }
}
