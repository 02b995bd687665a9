//! Ground motions.

use std::path::{Path, PathBuf};

use jostle::{GroundMotion, Wave};
use jostle_io::{
    Files, MotionError, MotionSource, MotionSpec, Record, RecordContent, RecordFormat,
    RecordLayout, RecordOptions, Scaling,
};
use jostle_motion::{Accelerogram, MotionFault, measures};
use jostle_report::{MotionPage, render_motion};
use jostle_run::NamedMotion;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::error::{argument_error, run_error};

/// A ground motion: its source and scaling, and its values.
#[pyclass(frozen, module = "jostle._jostle")]
pub(crate) struct Motion {
    pub(crate) spec: MotionSpec,
    pub(crate) motion: GroundMotion,
}

impl Motion {
    /// Reads and scales. The values are kept even if the file changes.
    pub(crate) fn from_spec(mut spec: MotionSpec) -> Result<Self, MotionError> {
        let motion = spec.resolve()?;
        if let (MotionSource::Record { .. }, Wave::Sampled { step, acceleration }) =
            (&spec.source, &motion.wave)
        {
            let record = GroundMotion::sampled(&motion.name, *step, acceleration.clone());
            spec.source = MotionSource::Given(record);
        }
        Ok(Self { spec, motion })
    }

    /// Step and scaled values: the samples themselves, so that the bits are those of the command line.
    pub(crate) fn samples(&self) -> (f64, Vec<f64>) {
        let motion = &self.motion;
        if let Wave::Sampled { step, acceleration } = &motion.wave {
            let scaled = acceleration.iter().map(|value| motion.scale * value);
            return (*step, scaled.collect());
        }
        let step = self.drawn_step();
        let points = (motion.duration / step) as usize + 1;
        let at = |k| motion.acceleration(k as f64 * step);
        (step, (0..points).map(at).collect())
    }

    /// The same with its name.
    pub(crate) fn named(&self) -> PyResult<NamedMotion> {
        let (step, acceleration) = self.samples();
        let motion = Accelerogram::new(step, acceleration);
        Ok(NamedMotion {
            name: self.motion.name.clone(),
            motion: motion.map_err(|fault| argument_error(fault.to_string()))?,
        })
    }

    pub(crate) fn of_named(name: &str, motion: &Accelerogram) -> PyResult<Self> {
        let given = GroundMotion::sampled(name, motion.step(), motion.acceleration().to_vec());
        Self::new(MotionSource::Given(given), None)
    }

    fn new(source: MotionSource, duration: Option<f64>) -> PyResult<Self> {
        let spec = MotionSpec {
            source,
            scaling: Scaling::AsRecorded,
            reverse: false,
            duration,
            bearing: None,
            grounds: None,
        };
        Self::from_spec(spec).map_err(|error| argument_error(error.to_string()))
    }
}

/// Skip, last, per_line, content and widths.
type StatedLines = (
    Option<usize>,
    Option<usize>,
    Option<usize>,
    Option<String>,
    Option<Vec<usize>>,
);

/// Name, values and step of a record or numbers of a wave, scaling, sign, length.
type State<'py> = (
    String,
    Option<Bound<'py, PyArray1<f64>>>,
    Vec<f64>,
    Option<f64>,
    Option<f64>,
    bool,
    Option<f64>,
);

#[pymethods]
impl Motion {
    /// Whether grounds of buildings differ, or shake vertically.
    #[getter]
    fn has_own_grounds(&self) -> bool {
        self.motion.has_own_grounds()
    }

    /// A built-in record, or a file.
    #[staticmethod]
    #[pyo3(signature = (name, unit=None, step=None, column=None, component=None, lines=(None, None, None, None, None), format=None, scale=None, remove_mean=None))]
    #[allow(
        clippy::too_many_arguments,
        reason = "they are those of the Python function"
    )]
    fn record(
        py: Python<'_>,
        name: &str,
        unit: Option<String>,
        step: Option<f64>,
        column: Option<usize>,
        component: Option<String>,
        lines: StatedLines,
        format: Option<&str>,
        scale: Option<f64>,
        remove_mean: Option<bool>,
    ) -> PyResult<Self> {
        let format = format.map(RecordFormat::from_key).transpose();
        let format = format.map_err(|error| argument_error(format!("format{error}")))?;
        let (skip, last, per_line, content, widths) = lines;
        let content = match content.as_deref() {
            None => None,
            Some(word) => Some(RecordContent::from_key(word).ok_or_else(|| {
                let known = RecordContent::ALL.map(RecordContent::key).join(", ");
                argument_error(format!(
                    "read: content must be one of {known}; found {word:?}"
                ))
            })?),
        };
        let options = RecordOptions {
            unit,
            step,
            column,
            component,
            format,
            scale,
            remove_mean,
            layout: RecordLayout {
                skip,
                last,
                per_line,
                content,
                widths: widths.unwrap_or_default(),
            },
        };
        let source = MotionSource::Record {
            name: name.to_owned(),
            files: Files::beside(Path::new("")),
            options,
        };
        py.detach(|| Self::new(source, None))
    }

    /// Equally spaced accelerations in a unit.
    #[staticmethod]
    fn sampled(
        name: &str,
        values: PyReadonlyArray1<'_, f64>,
        unit: &str,
        step: f64,
    ) -> PyResult<Self> {
        let values = values.as_array().to_vec();
        let record = Record::from_values(&values, unit, step)
            .map_err(|error| argument_error(format!("{name}{error}")))?;
        let given = GroundMotion::sampled(name, record.step, record.acceleration);
        Self::new(MotionSource::Given(given), None)
    }

    /// A sine wave.
    #[staticmethod]
    fn sine(amplitude: f64, period: f64, duration: f64) -> PyResult<Self> {
        Self::new(MotionSource::Sine { amplitude, period }, Some(duration))
    }

    /// A Ricker pulse.
    #[staticmethod]
    #[pyo3(signature = (amplitude, period, centre, duration=None))]
    fn ricker(amplitude: f64, period: f64, centre: f64, duration: Option<f64>) -> PyResult<Self> {
        let source = MotionSource::Ricker {
            amplitude,
            period,
            centre,
        };
        Self::new(source, duration)
    }

    /// Response spectra as the JSON of `jostle motion spectrum`.
    fn spectrum(
        &self,
        py: Python<'_>,
        periods: Vec<f64>,
        dampings: Vec<f64>,
        ductilities: Vec<f64>,
        post_yield: f64,
        between: bool,
    ) -> PyResult<String> {
        py.detach(|| {
            let (step, acceleration) = self.samples();
            jostle_run::spectrum_json(
                step,
                acceleration,
                &periods,
                &dampings,
                &ductilities,
                post_yield,
                between,
            )
        })
        .map_err(|error| argument_error(error.to_string()))
    }

    /// Measures as the JSON of `jostle motion show`.
    fn measures(&self) -> PyResult<String> {
        let NamedMotion { name, motion } = self.named()?;
        let found = measures(&motion).map_err(|fault| argument_error(fault.to_string()))?;
        Ok(jostle_run::measures_json(&name, &found).to_string())
    }

    /// The page of `jostle motion show`.
    fn page(&self) -> PyResult<String> {
        let NamedMotion { name, motion } = self.named()?;
        let wrong = |fault: MotionFault| argument_error(fault.to_string());
        let found = measures(&motion).map_err(wrong)?;
        let page = MotionPage {
            name: &name,
            motion: &motion,
            measures: &found,
        };
        render_motion(&page).map_err(wrong)
    }

    /// Writes a file in the format of its ending.
    fn write(&self, path: PathBuf, force: bool) -> PyResult<()> {
        let NamedMotion { name, motion } = self.named()?;
        let written = jostle_run::write_motion(&path, force, &name, &motion);
        written.map(drop).map_err(run_error)
    }

    /// The unscaled record as a CSV file with all digits; `None` of a formula.
    fn csv(&self) -> Option<String> {
        match &self.motion.wave {
            Wave::Sampled { step, acceleration } => {
                Some(jostle_io::csv_text(&self.motion.name, *step, acceleration))
            }
            _ => None,
        }
    }

    /// The same motion with the given changes.
    #[pyo3(signature = (pga=None, factor=None, reverse=false, duration=None))]
    fn changed(
        &self,
        pga: Option<f64>,
        factor: Option<f64>,
        reverse: bool,
        duration: Option<f64>,
    ) -> PyResult<Self> {
        let mut spec = self.spec.clone();
        if let Some(pga) = pga {
            spec.scaling = Scaling::Pga(pga);
        }
        if let Some(factor) = factor {
            spec.scaling = match spec.scaling {
                Scaling::AsRecorded => Scaling::Factor(factor),
                Scaling::Factor(old) => Scaling::Factor(old * factor),
                Scaling::Pga(pga) if factor >= 0.0 => Scaling::Pga(pga * factor),
                Scaling::Pga(pga) => {
                    spec.reverse = !spec.reverse;
                    Scaling::Pga(-pga * factor)
                }
                // What the match came to, from now on without it.
                Scaling::Match(_) | Scaling::FactorOfEach(_) => {
                    Scaling::Factor(self.motion.scale.abs() * factor)
                }
            };
        }
        spec.reverse ^= reverse;
        spec.duration = duration.or(spec.duration);
        Self::from_spec(spec).map_err(|error| argument_error(error.to_string()))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.motion.name
    }

    #[getter]
    fn duration(&self) -> f64 {
        self.motion.duration
    }

    #[getter]
    fn step(&self) -> Option<f64> {
        self.motion.step()
    }

    #[getter]
    fn points(&self) -> usize {
        self.motion.points()
    }

    #[getter]
    fn peak(&self) -> f64 {
        self.motion.peak()
    }

    #[getter]
    fn scale(&self) -> f64 {
        self.motion.scale
    }

    /// Spacing of instants that shows the wave: the step of a record, a fraction of the period of a wave.
    #[getter]
    fn drawn_step(&self) -> f64 {
        let of_period = self.motion.period().map(|period| period / 200.0);
        self.motion.step().or(of_period).unwrap_or(0.01)
    }

    /// The full state, to recreate the motion in another process.
    fn state<'py>(&self, py: Python<'py>) -> State<'py> {
        let spec = &self.spec;
        let (values, numbers) = match &spec.source {
            MotionSource::Given(GroundMotion {
                wave: Wave::Sampled { step, acceleration },
                ..
            }) => (Some(PyArray1::from_slice(py, acceleration)), vec![*step]),
            MotionSource::Sine { amplitude, period } => (None, vec![*amplitude, *period]),
            MotionSource::Ricker {
                amplitude,
                period,
                centre,
            } => (None, vec![*amplitude, *period, *centre]),
            MotionSource::Given(_) | MotionSource::Record { .. } | MotionSource::Records { .. } => {
                (None, Vec::new())
            }
        };
        let (pga, factor) = match spec.scaling.clone() {
            Scaling::AsRecorded => (None, None),
            Scaling::Pga(pga) => (Some(pga), None),
            Scaling::Factor(factor) => (None, Some(factor)),
            Scaling::Match(_) | Scaling::FactorOfEach(_) => (None, Some(self.motion.scale.abs())),
        };
        let name = self.motion.name.clone();
        (
            name,
            values,
            numbers,
            pga,
            factor,
            spec.reverse,
            spec.duration,
        )
    }

    /// The motion of a state.
    #[staticmethod]
    fn from_state(
        name: &str,
        values: Option<PyReadonlyArray1<'_, f64>>,
        numbers: Vec<f64>,
        pga: Option<f64>,
        factor: Option<f64>,
        reverse: bool,
        duration: Option<f64>,
    ) -> PyResult<Self> {
        let unscaled = match (values, &numbers[..]) {
            (Some(values), &[step]) => Self::sampled(name, values, "m/s2", step),
            (None, &[amplitude, period]) => Self::sine(amplitude, period, 10.0 * period),
            (None, &[amplitude, period, centre]) => Self::ricker(amplitude, period, centre, None),
            _ => Err(argument_error("this is no state of a motion")),
        }?;
        unscaled.changed(pga, factor, reverse, duration)
    }

    /// Ground acceleration at instants.
    fn at<'py>(
        &self,
        py: Python<'py>,
        times: PyReadonlyArray1<'py, f64>,
    ) -> Bound<'py, PyArray1<f64>> {
        let times = times.as_array();
        let values = times.iter().map(|t| self.motion.acceleration(*t));
        PyArray1::from_vec(py, values.collect())
    }
}
