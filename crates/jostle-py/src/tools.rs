//! Further commands as functions: sections, sizes, artificial motions, sets of motions, templates, schemas.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use jostle_cli::Described;
use jostle_io::{TargetWords, builtin_motions};
use jostle_motion::TargetSpectrum;
use jostle_run::{
    Noise, Processing, Pulse, SectionOptions, Selection, SelectionRequest, SpectrumMatch,
    Synthesis, made_by_recipe, plain, sections_json, sections_text,
};
use jostle_section::SectionSurvey;
use jostle_study::size::{Over, SizeProblem, SizeProgress, SizeRequest, SizeResults};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use serde_json::json;

use crate::base::{Base, tree_of};
use crate::error::{AnalysisError, argument_error, in_python, input_error, run_error, study_error};
use crate::motion::Motion;
use crate::table::Table;

/// Interval at which a search checks for Ctrl-C and reports progress.
const LOOK_UP: Duration = Duration::from_millis(5);

/// JSON, text and page.
pub(crate) type Sections = (String, String, String);

pub(crate) fn section_answer(title: &str, surveys: &[SectionSurvey]) -> Sections {
    (
        sections_json(surveys).to_string(),
        plain(&sections_text(surveys)),
        jostle_report::render_sections(title, surveys),
    )
}

/// A section given by its options, with the names and values of the command line.
#[pyfunction]
pub(crate) fn section(py: Python<'_>, given: HashMap<String, String>) -> PyResult<Sections> {
    let mut options = SectionOptions::default();
    for (name, value) in given {
        match name.as_str() {
            "width" => options.width = value,
            "depth" => options.depth = value,
            "bars" => options.bars = value,
            "concrete" => options.concrete = value,
            "steel" => options.steel = value,
            "strength" => options.strength = value,
            "cover" => options.cover = value,
            "ties" => options.ties = Some(value),
            "axial_load" => options.axial_load = Some(value),
            "length" => options.length = value,
            other => return Err(argument_error(format!("{other}: there is no such option"))),
        }
    }
    let found = py.detach(|| jostle_run::section(&options));
    Ok(section_answer("Section", &[found.map_err(run_error)?]))
}

/// A search for the least of something.
#[pyclass(frozen, module = "jostle._jostle")]
pub(crate) struct Sized(SizeResults);

/// Searches; `request` has the names and values of the command line. `observer` is called with finished and most trials.
#[pyfunction]
#[pyo3(signature = (base, vary, keep, minimise, records, pga, over, both_signs, numbers, folder=None, jobs=None, force=false, observer=None))]
#[allow(
    clippy::too_many_arguments,
    reason = "they are those of the Python function"
)]
pub(crate) fn size(
    py: Python<'_>,
    base: Base,
    vary: Vec<String>,
    keep: Vec<String>,
    minimise: String,
    records: Vec<String>,
    pga: Option<String>,
    over: &str,
    both_signs: bool,
    numbers: (u64, usize, f64),
    folder: Option<PathBuf>,
    jobs: Option<usize>,
    force: bool,
    observer: Option<Py<PyAny>>,
) -> PyResult<(Sized, Vec<String>)> {
    let (seed, trials, tolerance) = numbers;
    let request = SizeRequest {
        vary,
        keep,
        minimise,
        records,
        pga,
        both_signs,
        over: Over::from_name(over).ok_or_else(|| {
            let names = Over::NAMES.join(", ");
            argument_error(format!("over: expected one of {names}, found {over:?}"))
        })?,
        seed,
        trials,
        tolerance,
    };
    let problem = py.detach(|| {
        let tree = tree_of(base).map_err(|error| input_error(&error))?;
        SizeProblem::new(tree, &request).map_err(|error| study_error(&error))
    })?;
    let warnings = problem
        .warnings()
        .iter()
        .map(|text| in_python(text))
        .collect();
    if let Some(folder) = &folder {
        jostle_study::size::earlier_size_files(folder, force).map_err(run_error)?;
    }
    let stop = Arc::new(AtomicBool::new(false));
    let latest: Arc<Mutex<Option<SizeProgress>>> = Arc::default();
    let note = Arc::clone(&latest);
    let progress = Box::new(move |progress| {
        *note.lock().unwrap_or_else(PoisonError::into_inner) = Some(progress);
    });
    let mut stopped: Option<PyErr> = None;
    let done = py.detach(|| {
        std::thread::scope(|scope| {
            let work = scope.spawn(|| problem.run(folder.as_deref(), jobs, &stop, progress));
            // Signals reach Python in its own thread only.
            while !work.is_finished() {
                std::thread::sleep(LOOK_UP);
                if stopped.is_some() {
                    continue;
                }
                let progress = *latest.lock().unwrap_or_else(PoisonError::into_inner);
                let heed = Python::attach(|py| -> PyResult<()> {
                    py.check_signals()?;
                    if let (Some(observer), Some(progress)) = (&observer, progress) {
                        let part = (progress.trials as f64, progress.most as f64);
                        observer.call1(py, part)?;
                    }
                    Ok(())
                });
                if let Err(error) = heed {
                    stopped = Some(error);
                    stop.store(true, Ordering::Relaxed);
                }
            }
            work.join()
        })
    });
    if let Some(error) = stopped {
        return Err(error);
    }
    let done = done.map_err(|_| AnalysisError::new_err("the search failed inside"))?;
    let done = done.map_err(|error| study_error(&error))?;
    if done.stopped {
        return Err(PyKeyboardInterrupt::new_err(()));
    }
    Ok((Sized(done), warnings))
}

#[pymethods]
impl Sized {
    /// The text of size.json.
    fn json(&self) -> String {
        self.0.json().to_string()
    }

    /// One row per trial.
    fn table(&self) -> Table {
        Table::of_columns(self.0.columns())
    }

    /// The search as the command line prints it.
    fn text(&self) -> String {
        in_python(&plain(&self.0.describe(None)))
    }

    /// The page.
    fn page(&self) -> String {
        self.0.page()
    }
}

/// A design spectrum by the words of a code, or from the text of a file of points.
fn target_of(words: HashMap<String, String>) -> PyResult<TargetSpectrum> {
    let mut target_words = TargetWords::default();
    let (mut file, mut factor) = (None, None);
    for (name, value) in words {
        let place = match name.as_str() {
            "code" => &mut target_words.code,
            "intensity" => &mut target_words.intensity,
            "site" => &mut target_words.site,
            "group" => &mut target_words.group,
            "level" => &mut target_words.level,
            "type" => &mut target_words.kind,
            "ground" => &mut target_words.ground,
            "ag" => &mut target_words.ag,
            "sds" => &mut target_words.sds,
            "sd1" => &mut target_words.sd1,
            "tl" => &mut target_words.tl,
            "factor" => {
                factor = Some(value.clone());
                &mut target_words.factor
            }
            "file" => &mut file,
            other => return Err(argument_error(format!("{other}: there is no such key"))),
        };
        *place = Some(value);
    }
    let Some(path) = file else {
        return target_words
            .target()
            .map_err(|error| argument_error(error.to_string()));
    };
    let read = jostle_io::read_target_file(&PathBuf::from(path));
    let mut target = read.map_err(|error| argument_error(error.to_string()))?;
    if let Some(factor) = factor {
        target.factor = crate::quantity::quantity(&factor, "number")?;
    }
    Ok(target)
}

/// Ordinates of a design spectrum at periods, and its name and range of periods.
#[pyfunction]
pub(crate) fn target(
    words: HashMap<String, String>,
    periods: Vec<f64>,
    damping: f64,
) -> PyResult<(String, [f64; 2], Vec<f64>)> {
    let target = target_of(words)?;
    let values = periods
        .iter()
        .map(|period| target.acceleration(*period, damping));
    let values: Result<_, _> = values.collect();
    let values = values.map_err(|fault| argument_error(fault.to_string()))?;
    Ok((target.name(), target.range(), values))
}

fn with_facts(made: &Synthesis) -> PyResult<(Motion, String, Option<String>)> {
    let (name, motion) = made.motion();
    let facts = json!({
        "target": made.target,
        "misfit": made.matched.misfit,
        "worst_period_s": made.matched.worst_period,
        "periods_s": made.matching.periods,
        "damping": made.matching.damping,
        "text": made.closeness(),
    });
    let warning = made.warning().map(|text| in_python(&text));
    Ok((Motion::of_named(name, motion)?, facts.to_string(), warning))
}

/// Sines, or a record, matched to a spectrum: the motion, how well as JSON, and a warning.
/// `numbers` are step, duration, damping and tolerance.
#[pyfunction]
#[pyo3(signature = (words, record, numbers, seed, pga=None, periods=None))]
pub(crate) fn match_spectrum(
    py: Python<'_>,
    words: HashMap<String, String>,
    record: Option<&Motion>,
    numbers: [f64; 4],
    seed: u64,
    pga: Option<f64>,
    periods: Option<[f64; 2]>,
) -> PyResult<(Motion, String, Option<String>)> {
    let target = target_of(words)?;
    let [step, duration, damping, tolerance] = numbers;
    let wanted = SpectrumMatch {
        record: record.map(Motion::named).transpose()?,
        step,
        duration,
        seed,
        peak: pga,
        periods,
        damping,
        tolerance,
    };
    let made = py.detach(|| wanted.make(&target));
    with_facts(&made.map_err(run_error)?)
}

/// A motion made again from its recipe: the motion, how well as JSON, and a warning.
#[pyfunction]
pub(crate) fn recipe(py: Python<'_>, name: &str) -> PyResult<(Motion, String, Option<String>)> {
    let made = py.detach(|| made_by_recipe(name));
    with_facts(&made.map_err(run_error)?)
}

/// Filtered noise: step, duration, peak, frequency and damping of the ground filter, those of the second filter.
#[pyfunction]
pub(crate) fn noise(py: Python<'_>, numbers: [f64; 7], seed: u64) -> PyResult<Motion> {
    let [
        step,
        duration,
        pga,
        frequency,
        ground_damping,
        corner,
        corner_damping,
    ] = numbers;
    let noise = Noise {
        step,
        duration,
        pga,
        seed,
        frequency,
        ground_damping,
        corner,
        corner_damping,
    };
    let made = py.detach(|| noise.make()).map_err(run_error)?;
    Motion::of_named(&made.name, &made.motion)
}

/// A near-fault pulse: peak velocity, period, oscillations, phase, rest before and after, step.
#[pyfunction]
pub(crate) fn pulse(shape: String, numbers: [f64; 7]) -> PyResult<Motion> {
    let [velocity, period, gamma, phase, before, after, step] = numbers;
    let pulse = Pulse {
        shape,
        velocity,
        period,
        gamma,
        phase,
        rest: [before, after],
        step,
    };
    let made = pulse.make().map_err(run_error)?;
    Motion::of_named(&made.name, &made.motion)
}

/// A processed motion; `given` has the names of the command line, with numbers in SI.
#[pyfunction]
pub(crate) fn processed(
    py: Python<'_>,
    motion: &Motion,
    given: HashMap<String, f64>,
) -> PyResult<Motion> {
    let mut processing = Processing::default();
    for (name, value) in given {
        let whole = value as usize;
        match name.as_str() {
            "from" => processing.from = Some(value),
            "to" => processing.to = Some(value),
            "detrend" => processing.detrend = Some(whole),
            "detrend_velocity" => processing.detrend_velocity = Some(whole),
            "high_pass" => processing.high_pass = Some(value),
            "low_pass" => processing.low_pass = Some(value),
            "order" => processing.order = whole,
            "resample" => processing.resample = Some(value),
            "pad_before" => processing.pad_before = Some(value),
            "pad_after" => processing.pad_after = Some(value),
            "at_rest" => processing.at_rest = value != 0.0,
            "scale" => processing.scale = Some(value),
            "pga" => processing.pga = Some(value),
            other => return Err(argument_error(format!("{other}: there is no such key"))),
        }
    }
    let named = motion.named()?;
    let done = py
        .detach(|| processing.apply(named.motion))
        .map_err(run_error)?;
    Motion::of_named(&named.name, &done)
}

/// A set of motions by the rules of a code: JSON, text and page.
#[pyfunction]
#[pyo3(signature = (words, natural, artificial, periods, mass_ratios, damping, pga=None, unscaled=false))]
#[allow(
    clippy::too_many_arguments,
    reason = "they are those of the Python function"
)]
pub(crate) fn select(
    py: Python<'_>,
    words: HashMap<String, String>,
    natural: Vec<PyRef<'_, Motion>>,
    artificial: Vec<PyRef<'_, Motion>>,
    periods: Vec<f64>,
    mass_ratios: Vec<f64>,
    damping: f64,
    pga: Option<f64>,
    unscaled: bool,
) -> PyResult<Sections> {
    let target = target_of(words)?;
    let named = |motions: Vec<PyRef<'_, Motion>>| -> PyResult<Vec<_>> {
        motions.iter().map(|motion| motion.named()).collect()
    };
    let request = SelectionRequest {
        natural: named(natural)?,
        artificial: named(artificial)?,
        periods,
        mass_ratios,
        damping,
        pga,
        unscaled,
    };
    py.detach(|| {
        let found = Selection::new(target, request)?;
        Ok((
            found.json().to_string(),
            plain(&found.text()),
            found.page()?,
        ))
    })
    .map_err(run_error)
}

/// Built-in motions: name and description.
#[pyfunction]
pub(crate) fn motion_list() -> Vec<(String, String)> {
    let motions = builtin_motions().into_iter();
    motions
        .map(|(name, description)| (name.to_string(), description.to_string()))
        .collect()
}

/// The text of a commented model file; `None` if there is no such template.
#[pyfunction]
pub(crate) fn template(name: &str, title: &str) -> Option<String> {
    jostle_io::template(name, title)
}

/// Names of the templates.
#[pyfunction]
pub(crate) fn template_names() -> Vec<&'static str> {
    jostle_io::TEMPLATE_NAMES.to_vec()
}

/// What `jostle schema` prints.
#[pyfunction]
pub(crate) fn schema(what: &str, markdown: bool) -> PyResult<String> {
    let described = match what {
        "model" => Described::Model,
        "results" => Described::Results,
        "checks" => Described::Checks,
        "combinations" => Described::Combinations,
        other => {
            return Err(argument_error(format!(
                "what: expected model, results, checks or combinations, found {other:?}"
            )));
        }
    };
    Ok(jostle_cli::schema(described, markdown))
}

/// Imports files of ETABS or SAP2000; `arguments` are those of `jostle import`. Returns what it prints.
#[pyfunction]
pub(crate) fn import_tables(py: Python<'_>, arguments: Vec<String>) -> PyResult<String> {
    py.detach(|| jostle_cli::import(arguments))
        .map_err(|problem| argument_error(in_python(&problem)))
}

/// All commands with their arguments, as JSON.
#[pyfunction]
pub(crate) fn command_list() -> String {
    jostle_cli::command_list().to_string()
}

/// Writes a text to a file completely or not at all; a file that exists is replaced with `force` only.
#[pyfunction]
pub(crate) fn write_text(path: PathBuf, text: &str, kind: &str, force: bool) -> PyResult<()> {
    use jostle_run::FileKind;
    let known = match kind {
        "page" => Some(FileKind::REPORT),
        "sections" => Some(FileKind::SECTIONS),
        "method" => Some(FileKind::METHOD),
        "site" => Some(FileKind::SITE),
        "size" => Some(FileKind::SIZE_PAGE),
        _ => None,
    };
    match kind {
        "script" => jostle_run::may_write_script(&path, force),
        _ => jostle_run::may_write(&path, known, force),
    }
    .map_err(run_error)?;
    jostle_io::write_atomically(&path, text.as_bytes())
        .map_err(|error| crate::error::output_error(&error))
}
