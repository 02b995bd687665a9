//! Cities and classes of buildings.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use jostle_city::{
    Attribute, CityError, Columns, EXAMPLE_FILE, Footprints, Position, ReadOptions, RunOptions,
    example_city as made_up,
};
use jostle_classes::Types;
use jostle_io::{CityFile, ClassesFile};
use jostle_run::may_write;
use jostle_study::classes::{ClassesError, FILES, run_classes, write_classes};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use serde_json::{Value, json};

use crate::error::{
    AnalysisError, argument_error, in_python, input_error, output_error, run_error,
};
use crate::watch::watched;

fn city_error(error: CityError) -> PyErr {
    match error {
        CityError::Output(error) => output_error(&error),
        CityError::Analysis(text) => AnalysisError::new_err(in_python(&text)),
        CityError::Stopped => PyKeyboardInterrupt::new_err(""),
        CityError::Input(text) => argument_error(text),
    }
}

/// A city ready to be shaken.
#[pyclass(frozen, module = "jostle._jostle")]
pub(crate) struct City(Arc<jostle_city::City>);

#[pymethods]
impl City {
    /// Reads a city file and its inventory; warnings come with it.
    #[staticmethod]
    #[pyo3(signature = (path, draws=None, tolerance=None))]
    fn read(
        py: Python<'_>,
        path: PathBuf,
        draws: Option<usize>,
        tolerance: Option<f64>,
    ) -> PyResult<Self> {
        let mut file = CityFile::load(&path).map_err(|error| input_error(&error))?;
        file.draws = draws.unwrap_or(file.draws);
        file.tolerance = tolerance.unwrap_or(file.tolerance);
        if !(1..=1 << 16).contains(&file.draws) {
            return Err(argument_error("draws: must lie between 1 and 65536"));
        }
        if !(1e-3..=1e-1).contains(&file.tolerance) {
            return Err(argument_error("tolerance: must lie between 0.001 and 0.1"));
        }
        let detach = py.detach(|| jostle_city::City::new(file));
        Ok(Self(Arc::new(detach.map_err(city_error)?)))
    }

    /// The city whose run a folder holds.
    #[staticmethod]
    fn of_folder(py: Python<'_>, folder: PathBuf) -> PyResult<Self> {
        let detach = py.detach(|| jostle_city::City::of_folder(&folder));
        Ok(Self(Arc::new(detach.map_err(city_error)?)))
    }

    /// Title, counts, names of the motions, what was found of them, warnings, and whether the gap is given, as JSON.
    fn facts(&self) -> String {
        let city = &self.0;
        json!({
            "title": city.file.title,
            "buildings": city.inventory.buildings.len(),
            "pairs": city.neighbours.pairs.len(),
            "cases": city.cases(),
            "motions": city.motions(),
            "notes": city.told(),
            "warnings": city.file.warnings,
            "gap_is_given": city.file.gap_is_given,
        })
        .to_string()
    }

    #[getter]
    fn parts(&self) -> usize {
        self.0.parts()
    }

    /// Makes a folder ready for this city.
    fn settle(&self, py: Python<'_>, folder: PathBuf) -> PyResult<()> {
        py.detach(|| self.0.settle(&folder)).map_err(city_error)
    }

    /// Numbers of the parts that a folder lacks.
    fn missing(&self, py: Python<'_>, folder: PathBuf) -> Vec<usize> {
        py.detach(|| self.0.missing(&folder))
    }

    /// Runs one part of a folder that is ready.
    fn run_part(&self, py: Python<'_>, folder: PathBuf, part: usize) -> PyResult<()> {
        let city = Arc::clone(&self.0);
        watched(py, None, |watch| {
            city.run_one(&folder, part, &|| watch.stops())
        })?
        .map_err(city_error)
    }

    /// Runs what a folder lacks, or a share of it.
    #[pyo3(signature = (folder, jobs=None, shard=None, observer=None))]
    fn run(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        jobs: Option<usize>,
        shard: Option<(usize, usize)>,
        observer: Option<Py<PyAny>>,
    ) -> PyResult<()> {
        let city = Arc::clone(&self.0);
        let done = watched(py, observer.as_ref(), |watch| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(jobs.unwrap_or(0));
            let pool = pool
                .build()
                .map_err(|error| CityError::Analysis(error.to_string()))?;
            pool.install(|| {
                city.run(
                    &folder,
                    RunOptions { shard },
                    &|| watch.stops(),
                    &mut |progress| watch.note(progress.cases as f64, progress.of as f64),
                )
            })
        })?;
        done.map(|_| ()).map_err(city_error)
    }

    /// Writes map and tables of a finished run; returns what it found, as JSON.
    fn report(&self, py: Python<'_>, folder: PathBuf) -> PyResult<String> {
        let done = py.detach(|| self.0.report(&folder, &mut |_| Ok(Vec::new())));
        let (answers, _) = done.map_err(city_error)?;
        let means = answers.means();
        let sampled = answers.sampled.within(self.0.file.tolerance);
        Ok(json!({
            "buildings": means.buildings,
            "struck_half_gaps": means.struck[0],
            "struck": means.struck[1],
            "struck_double_gaps": means.struck[2],
            "column_strike": means.column,
            "moderate_alone": means.moderate[0],
            "moderate": means.moderate[1],
            "worse": answers.changed[0],
            "better": answers.changed[1],
            "sample_rows": answers.sampled.rows,
            "sample_within": sampled.map(|own| own.0),
            "sample_worst": sampled.map(|own| own.1),
        })
        .to_string())
    }

    /// A pair as the text of a model file.
    fn model(&self, py: Python<'_>, pair: usize, draw: usize, motion: usize) -> PyResult<String> {
        py.detach(|| self.0.model(pair, draw, motion))
            .map_err(city_error)
    }
}

/// Counts of footprints and their neighbours, as JSON; writes their tables into a folder if there is one.
#[pyfunction]
#[pyo3(signature = (path, columns, metres, reach, out=None))]
pub(crate) fn footprints(
    py: Python<'_>,
    path: PathBuf,
    columns: HashMap<String, String>,
    metres: bool,
    reach: f64,
    out: Option<PathBuf>,
) -> PyResult<String> {
    let mut named = Columns::default();
    for (attribute, name) in columns {
        let attribute: Attribute = attribute
            .parse()
            .map_err(|problem| argument_error(format!("columns: {problem}")))?;
        named.0.insert(attribute, name);
    }
    let options = ReadOptions {
        columns: named,
        metres,
    };
    py.detach(|| {
        let footprints = Footprints::read(&path, &options, reach)?;
        if let Some(folder) = &out {
            footprints.write(folder)?;
        }
        Ok(counts(&footprints).to_string())
    })
    .map_err(city_error)
}

fn counts(footprints: &Footprints) -> Value {
    let buildings = &footprints.inventory.buildings;
    let known = |of: &dyn Fn(&jostle_city::Building) -> bool| {
        buildings.iter().filter(|building| of(building)).count()
    };
    let mut mends: HashMap<&str, usize> = HashMap::new();
    for mend in &footprints.inventory.mends {
        *mends.entry(mend.what).or_default() += 1;
    }
    let at = |position: Position| {
        let pairs = footprints.neighbours.pairs.iter();
        pairs.filter(|pair| pair.position == position).count()
    };
    let columns = footprints.inventory.columns.iter();
    let columns: HashMap<&str, String> =
        (columns.map(|(of, names)| (of.name(), names.join(", ")))).collect();
    json!({
        "rows": footprints.inventory.rows,
        "buildings": buildings.len(),
        "columns": columns,
        "storeys_known": known(&|footprints| footprints.storeys.is_some()),
        "heights_known": known(&|footprints| footprints.height.is_some()),
        "years_known": known(&|footprints| footprints.year.is_some()),
        "types_known": known(&|footprints| footprints.kind.is_some()),
        "mends": mends,
        "pairs": footprints.neighbours.pairs.len(),
        "overlaps": footprints.neighbours.overlaps.len(),
        "with_neighbours": footprints.with_neighbours(),
        "inside": at(Position::Inside),
        "at_end": at(Position::End),
        "at_corner": at(Position::Corner),
        "blocks": footprints.blocks.len(),
        "largest_block": footprints.blocks.iter().map(|footprints| footprints.buildings.len()).max().unwrap_or(0),
    })
}

/// Footprints of a made-up city, and a city file for them.
#[pyfunction]
pub(crate) fn example_city(
    py: Python<'_>,
    buildings: usize,
    seed: u64,
) -> PyResult<(String, String)> {
    if !(1..=2_000_000).contains(&buildings) {
        return Err(argument_error("buildings: must lie between 1 and 2000000"));
    }
    let map = py.detach(|| made_up(buildings, seed));
    Ok((map, EXAMPLE_FILE.to_owned()))
}

/// The table of structural types as CSV.
#[pyfunction]
pub(crate) const fn city_types() -> &'static str {
    Types::text()
}

/// Runs a classes file into a folder; returns warnings, and what its fragility models leave out.
#[pyfunction]
#[pyo3(signature = (path, folder, force=false, jobs=None, observer=None))]
pub(crate) fn classes(
    py: Python<'_>,
    path: PathBuf,
    folder: PathBuf,
    force: bool,
    jobs: Option<usize>,
    observer: Option<Py<PyAny>>,
) -> PyResult<(Vec<String>, Vec<String>)> {
    let file = ClassesFile::load(&path).map_err(|error| input_error(&error))?;
    for (name, kind) in FILES {
        may_write(&folder.join(name), Some(kind), force).map_err(run_error)?;
    }
    let done = watched(py, observer.as_ref(), |watch| {
        run_classes(&file, jobs, &|| watch.stops(), &|done, of| {
            watch.note(done as f64, of as f64);
        })
    })?;
    let wrong = |error| match error {
        ClassesError::Input(error) => input_error(&error),
        ClassesError::Analysis(text) => AnalysisError::new_err(in_python(&text)),
    };
    let results = done
        .map_err(wrong)?
        .ok_or_else(|| PyKeyboardInterrupt::new_err(""))?;
    let made = std::fs::create_dir_all(&folder);
    made.map_err(|error| argument_error(format!("out: {}: {error}", folder.display())))?;
    let left_out = write_classes(Path::new(&folder), &file, &results);
    let left_out = left_out.map_err(|error| output_error(&error))?;
    Ok((results.warnings, left_out))
}
