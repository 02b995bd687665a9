//! From the text of a model to everything that the page shows.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
#[cfg(not(target_family = "wasm"))]
use std::time::Instant;

use jostle::stepping::Progress;
use jostle::{GroundMotion, Model, Outcome, Pounding, RunEnd, Settings, Summary};
use jostle_io::shown::{ACCELERATION, FORCE, LENGTH, chosen_units, in_units};
use jostle_io::{Files, Format, InputError, ModelTree, TreeValue, Units};
use jostle_run::{CaseCache, CaseError, Prepared, Results, RunsAtBounds, STORAGE, add_bounds};
use serde::Serialize;

use crate::message::{Fault, Run, fault, faults};
use jostle_report::message;

/// Most files of the model's folder that are offered as records.
const MOST_FILES: usize = 60;
/// Names of files that may be records.
const RECORD_ENDINGS: [&str; 10] = [
    "at2", "csv", "v1", "v2", "v2a", "smc", "mseed", "sac", "ns", "asc",
];

/// A model that was opened, and what runs of it share.
pub struct Engine {
    name: String,
    text: String,
    /// What models on the page may read: the folder of the model, and what the opened model names.
    files: Files,
    /// Files that the opened model names, in its words.
    #[cfg(not(target_family = "wasm"))]
    named: Vec<String>,
    /// Those of them that are records of its motion.
    named_records: Vec<String>,
    /// Units that the opened model asks for; the page keeps them.
    pub(crate) units: Option<Units>,
    case_cache: CaseCache,
    /// The last runs without contact, the most recent at the end.
    apart: Mutex<Vec<Apart>>,
}

/// A run without contact.
struct Apart {
    /// Its model, with all gaps closed that it does not depend on.
    model: Model,
    motion: GroundMotion,
    outcome: Arc<Outcome>,
}

/// Runs without contact that are kept.
const MOST_APART: usize = 4;

/// Why there is no frame.
#[derive(Debug)]
pub(crate) enum Trouble {
    /// The model is wrong.
    Faults(Vec<Fault>),
    /// Stopped.
    Stopped,
}

impl From<CaseError> for Trouble {
    fn from(error: CaseError) -> Self {
        match error {
            CaseError::Path(error) => Self::Faults(fault(&error.path, error.problem)),
            CaseError::Input(error) => Self::from(error),
        }
    }
}

impl From<InputError> for Trouble {
    fn from(error: InputError) -> Self {
        Self::Faults(faults(&error))
    }
}

/// One number of a run, to be compared with that of another.
#[derive(Debug, Serialize)]
pub(crate) struct Number {
    name: String,
    unit: &'static str,
    value: f64,
}

/// A model that was run.
pub(crate) struct Solved {
    prepared: Prepared,
    outcome: Outcome,
    without: Option<Arc<Outcome>>,
    bounds: Option<Result<RunsAtBounds, String>>,
    summary: Summary,
}

/// The numbers of a run, with those at the bounds of its bearings.
fn numbers_of(
    prepared: &Prepared,
    outcome: &Outcome,
    without: Option<&Outcome>,
    bounds: Option<&Result<RunsAtBounds, String>>,
    wall: f64,
) -> Summary {
    let mut summary = prepared.summary(outcome, without, wall);
    if let Some(bounds) = bounds {
        add_bounds(&mut summary, bounds);
        prepared.judge(&mut summary);
    }
    summary
}

/// What a frame says beside its data.
#[derive(Serialize)]
struct Head<'a> {
    op: &'static str,
    id: u64,
    text: &'a str,
    knobs: Vec<jostle_io::Knob>,
    records: Vec<String>,
    headline: &'a str,
    parts: &'a [(&'static str, String)],
    numbers: Vec<Number>,
    /// Warnings of the model and notes of the run.
    notes: &'a [String],
    /// Accuracy of the peaks, in words.
    accuracy: String,
    /// Smallest gap without pounding of every gap, from the run without contact \[m\].
    needed: Vec<Option<f64>>,
}

impl Engine {
    /// Opens a model file, or a built-in model.
    ///
    /// # Errors
    /// When the file cannot be read or is not TOML or JSON.
    pub fn open(model: &Path) -> Result<Self, InputError> {
        Ok(Self::new(&ModelTree::find(model)?))
    }

    /// Takes a model from its text. Records are looked for in `base`.
    ///
    /// # Errors
    /// When the text is not TOML or JSON.
    pub fn from_text(name: &str, text: &str, base: &Path) -> Result<Self, InputError> {
        Self::with_files(name, text, Files::beside(base))
    }

    /// Takes a model from its text, and what it may read.
    ///
    /// # Errors
    /// When the text is not TOML or JSON.
    pub fn with_files(name: &str, text: &str, files: Files) -> Result<Self, InputError> {
        let tree = ModelTree::parse_with(name, text, Format::of_text(text), files)?;
        Ok(Self::new(&tree))
    }

    fn new(tree: &ModelTree) -> Self {
        let named = tree.named_files();
        let records = tree.values("motion.record").into_iter();
        let records = records.flat_map(|value| match value {
            TreeValue::List(list) => list,
            one => vec![one],
        });
        let records = records.map(|value| value.to_string());
        Self {
            name: tree.name().to_owned(),
            text: tree.text().to_owned(),
            files: tree.files().confined(&named),
            named_records: records.filter(|name| named.contains(name)).collect(),
            #[cfg(not(target_family = "wasm"))]
            named,
            units: tree.units(),
            case_cache: CaseCache::default(),
            apart: Mutex::default(),
        }
    }

    /// Name of the file.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns what `write` returns, in the units of the page: those that were chosen, else those of the opened model.
    pub(crate) fn in_its_units<T>(&self, write: impl FnOnce() -> T) -> T {
        let units = chosen_units().or(self.units).unwrap_or_default();
        in_units(Some(units), write)
    }

    /// Text of the file.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Values of the opened model; none if it cannot be read.
    pub(crate) fn knobs(&self) -> Vec<jostle_io::Knob> {
        let tree = self.parse(&self.text);
        tree.map_or_else(|_| Vec::new(), |tree| tree.knobs())
    }

    /// What models on the page may read.
    #[cfg(not(target_family = "wasm"))]
    pub(crate) fn files(&self) -> &Files {
        &self.files
    }

    /// Files that the model names, in its words.
    #[cfg(not(target_family = "wasm"))]
    pub(crate) fn named_files(&self) -> &[String] {
        &self.named
    }

    /// Names of records to choose from: the built-in ones, and files of the model's folder.
    pub(crate) fn records(&self) -> Vec<String> {
        let builtin = jostle_io::builtin_motions().into_iter();
        let mut names: Vec<String> = builtin.map(|(name, _)| name.to_owned()).collect();
        let ours = |path: &Path| {
            let ending = path
                .extension()
                .unwrap_or_default()
                .to_string_lossy()
                .to_lowercase();
            RECORD_ENDINGS.contains(&ending.as_str())
        };
        let beside = self.files.names_beside("").into_iter();
        let beside = beside.filter(|name| ours(Path::new(name)));
        let mut files: Vec<String> = beside.take(MOST_FILES).collect();
        files.extend(self.named_records.iter().cloned());
        files.sort();
        files.dedup();
        names.extend(files);
        names
    }

    /// The tree of a text with changes made.
    pub(crate) fn tree(&self, run: &Run) -> Result<ModelTree, Trouble> {
        #[cfg(test)]
        assert_ne!(run.text, FAILS);
        let mut tree = self.parse(&run.text)?;
        for (path, typed) in &run.edits {
            let value = (!typed.trim().is_empty()).then(|| TreeValue::typed(typed));
            let text = tree
                .rewritten(path, value.as_ref())
                .map_err(|error| Trouble::Faults(fault(&error.path, error.problem)))?;
            tree = self.parse(&text)?;
        }
        Ok(tree)
    }

    fn parse(&self, text: &str) -> Result<ModelTree, InputError> {
        let files = self.files.afresh();
        ModelTree::parse_with(&self.name, text, Format::of_text(text), files)
    }

    /// Reads a tree and plans its run.
    pub(crate) fn prepare(&self, tree: &ModelTree, record: usize) -> Result<Prepared, Trouble> {
        let mut tree = tree.clone();
        let several = tree.records().len();
        if several > 1 {
            tree.keep_record(record.min(several - 1));
        }
        Ok(self.case_cache.assemble(tree.input()?)?)
    }

    fn solve(
        &self,
        prepared: Prepared,
        watch: &(dyn Fn(Progress) -> ControlFlow<()> + Sync),
    ) -> Result<Solved, Trouble> {
        let clock = Clock::start();
        let compares = !prepared.system.contacts.is_empty();
        let settings = Settings {
            storage: STORAGE,
            ..Settings::default()
        };
        let apart = Settings {
            pounding: Pounding::Excluded,
            ..settings
        };
        let model = without_gaps(&prepared.input.model);
        let known = {
            let kept = self.apart.lock().unwrap_or_else(PoisonError::into_inner);
            let same = |run: &&Apart| run.model == model && run.motion == prepared.motion;
            kept.iter().find(same).map(|run| Arc::clone(&run.outcome))
        };
        let wanted = compares && known.is_none();
        let step = |settings| {
            let mut outcome = prepared.step(settings, watch);
            prepared.finish_histories(&mut outcome);
            outcome
        };
        let (outcome, computed) = together(|| step(settings), || wanted.then(|| step(apart)));
        let without = known.or(computed.map(Arc::new));
        let stopped = |outcome: &Outcome| *outcome.end_of_all() == RunEnd::Stopped;
        if stopped(&outcome) || without.as_ref().is_some_and(|run| stopped(run)) {
            return Err(Trouble::Stopped);
        }
        let without = without.filter(|run| run.end == RunEnd::Completed);
        if let Some(run) = without.as_ref().filter(|_| wanted) {
            let mut kept = self.apart.lock().unwrap_or_else(PoisonError::into_inner);
            if kept.len() >= MOST_APART {
                kept.remove(0);
            }
            kept.push(Apart {
                model,
                motion: prepared.motion.clone(),
                outcome: Arc::clone(run),
            });
        }
        let wall = clock.seconds();
        let completed = outcome.end == RunEnd::Completed;
        let mut halted = false;
        let mut watched = |_, progress| {
            let flow = watch(progress);
            halted |= flow.is_break();
            flow
        };
        let bounds = completed.then(|| prepared.run_at_bounds(compares, &mut watched));
        let bounds = bounds.flatten();
        if halted {
            return Err(Trouble::Stopped);
        }
        let summary = numbers_of(
            &prepared,
            &outcome,
            without.as_deref(),
            bounds.as_ref(),
            wall,
        );
        Ok(Solved {
            prepared,
            outcome,
            without,
            bounds,
            summary,
        })
    }

    /// Runs a model: the binary message of its frame, and the run itself.
    pub(crate) fn frame(
        &self,
        id: u64,
        tree: &ModelTree,
        record: usize,
        watch: &(dyn Fn(Progress) -> ControlFlow<()> + Sync),
    ) -> Result<(Vec<u8>, Solved), Trouble> {
        let solved = self.solve(self.prepare(tree, record)?, watch)?;
        let frame = self.in_its_units(|| written(id, tree, &solved))?;
        Ok((frame, solved))
    }

    /// Runs a model: the report as one HTML file.
    pub(crate) fn report(
        &self,
        tree: &ModelTree,
        record: usize,
        watch: &(dyn Fn(Progress) -> ControlFlow<()> + Sync),
    ) -> Result<String, Trouble> {
        let mut solved = self.solve(self.prepare(tree, record)?, watch)?;
        let (prepared, wall) = (&solved.prepared, solved.summary.work.wall_s);
        prepared.find_sensitivity(&mut solved.outcome, watch);
        let (without, bounds) = (solved.without.as_deref(), solved.bounds.as_ref());
        solved.summary = numbers_of(prepared, &solved.outcome, without, bounds, wall);
        let report = self.in_its_units(|| solved.results().report());
        report.ok_or(Trouble::Stopped)
    }
}

/// The binary message of the frame of a run.
fn written(id: u64, tree: &ModelTree, solved: &Solved) -> Result<Vec<u8>, Trouble> {
    let frame = solved.results().with_page(jostle_report::frame);
    let frame = frame.ok_or(Trouble::Stopped)?;
    let summary = &solved.summary;
    let head = Head {
        op: "frame",
        id,
        text: tree.text(),
        knobs: tree.knobs(),
        records: tree.records(),
        headline: &frame.headline,
        parts: &frame.parts,
        numbers: numbers(summary),
        notes: &summary.notes,
        accuracy: summary.promise.in_words(),
        needed: (0..summary.gaps.len())
            .map(|gap| summary.gap_needed_m(gap))
            .collect(),
    };
    let head = serde_json::to_string(&head).unwrap_or_default();
    // Two texts, so that the data need not be written twice.
    let json = format!("[{head},{}]", frame.data);
    Ok(crate::message::binary(&json, &frame.numbers))
}

impl Solved {
    /// Finds out from when on results depend on contacts made or missed within the tolerance, which takes another run:
    /// accuracy and notes in words. `None` without contacts.
    pub(crate) fn sensitive(
        mut self,
        watch: &(dyn Fn(Progress) -> ControlFlow<()> + Sync),
    ) -> Option<(String, Vec<String>)> {
        if !self.prepared.compares(&self.outcome) {
            return None;
        }
        self.prepared.find_sensitivity(&mut self.outcome, watch);
        let (wall, without) = (self.summary.work.wall_s, self.without.as_deref());
        let summary = self.prepared.summary(&self.outcome, without, wall);
        Some((summary.promise.in_words(), summary.notes))
    }

    /// What the report shows.
    fn results(&self) -> Results<'_> {
        Results {
            prepared: &self.prepared,
            outcome: &self.outcome,
            summary: &self.summary,
            history: self.outcome.history.as_ref(),
            without_contact: self.without.as_deref().and_then(Results::comparable),
            methods: &[],
        }
    }
}

/// Makes two runs at the same time.
#[cfg(not(target_family = "wasm"))]
fn together<A>(one: impl FnOnce() -> A, other: impl FnOnce() -> Option<A> + Send) -> (A, Option<A>)
where
    A: Send,
{
    std::thread::scope(|scope| {
        let other = scope.spawn(other);
        (one(), other.join().ok().flatten())
    })
}

/// Makes two runs: WebAssembly has one thread.
#[cfg(target_family = "wasm")]
fn together<A>(one: impl FnOnce() -> A, other: impl FnOnce() -> Option<A>) -> (A, Option<A>) {
    (one(), other())
}

/// Time that a run takes; none in WebAssembly, which has no clock.
struct Clock {
    #[cfg(not(target_family = "wasm"))]
    begun: Instant,
}

impl Clock {
    fn start() -> Self {
        Self {
            #[cfg(not(target_family = "wasm"))]
            begun: Instant::now(),
        }
    }

    /// Seconds since the start.
    fn seconds(&self) -> f64 {
        #[cfg(not(target_family = "wasm"))]
        {
            self.begun.elapsed().as_secs_f64()
        }
        #[cfg(target_family = "wasm")]
        0.0
    }
}

/// What a run without contact depends on: the model, whatever the widths of its gaps, unless buildings move otherwise with them.
fn without_gaps(model: &Model) -> Model {
    let mut model = model.clone();
    if model.moves_by_gaps() {
        return model;
    }
    for gap in &mut model.gaps {
        for width in &mut gap.widths {
            *width = 0.0;
        }
    }
    model
}

/// The numbers of a run that two runs are compared by.
fn numbers(summary: &Summary) -> Vec<Number> {
    let mut list = Vec::new();
    let mut add = |name: String, unit, value: f64| list.push(Number { name, unit, value });
    let several = summary.gaps.len() > 1;
    for (index, gap) in summary.gaps.iter().enumerate() {
        let pair = if several {
            format!(" {} ↔ {}", gap.between[0], gap.between[1])
        } else {
            String::new()
        };
        add(
            message::gap_pair(&pair),
            LENGTH.name(),
            LENGTH.of(gap.width_m),
        );
        add(
            message::peak_force_of_pair(&pair),
            FORCE.name(),
            FORCE.of(gap.peak_force_n),
        );
        add(message::impacts_pair(&pair), "", gap.impact_count as f64);
        if let Some(first) = gap.first_impact_s {
            add(message::first_impact(&pair), "s", first);
        }
        if let Some(needed) = summary.gap_needed_m(index) {
            add(message::gap_needed(&pair), LENGTH.name(), LENGTH.of(needed));
        }
    }
    for building in &summary.buildings {
        let name = &building.name;
        let floors = building.floors.iter();
        let sway = floors.map(|f| f.response.displacement_peak_m());
        let sway = sway.fold(0.0, f64::max);
        add(
            message::displacement_of(name),
            LENGTH.name(),
            LENGTH.of(sway),
        );
        add(
            message::storey_drift_of(name),
            "%",
            100.0 * building.response.drift_peak,
        );
        add(
            message::floor_acceleration(name),
            ACCELERATION.name(),
            ACCELERATION.of(building.response.total_acceleration_peak_m_s2),
        );
        add(
            message::base_shear_title(name),
            FORCE.name(),
            FORCE.of(building.response.base_shear_peak_n),
        );
    }
    add(
        message::peak_ground_acceleration().into(),
        ACCELERATION.name(),
        ACCELERATION.of(summary.motion.pga_m_s2),
    );
    list
}

/// The text of a model on which every handler panics, in tests.
#[cfg(test)]
pub(crate) const FAILS: &str = "a handler fails";

#[cfg(test)]
mod tests {
    use super::*;

    fn engine(folder: &Path) -> Engine {
        engine_of(folder, jostle_io::model_text("paper").unwrap_or_default())
    }

    fn engine_of(folder: &Path, text: &str) -> Engine {
        let model = folder.join("model.toml");
        std::fs::write(&model, text).unwrap_or_else(|error| panic!("{error}"));
        Engine::open(&model).unwrap_or_else(|error| panic!("{error}"))
    }

    fn solved_at(engine: &Engine, width: &str) -> Solved {
        let run = Run {
            id: 1,
            text: engine.text.clone(),
            edits: vec![("gap[0].width".into(), width.into())],
            record: 0,
        };
        let tree = engine.tree(&run);
        let tree = tree.unwrap_or_else(|error| panic!("{error:?}"));
        let prepared = engine.prepare(&tree, 0);
        let prepared = prepared.unwrap_or_else(|error| panic!("{error:?}"));
        let solved = engine.solve(prepared, &|_| ControlFlow::Continue(()));
        solved.unwrap_or_else(|error| panic!("{error:?}"))
    }

    /// Foundations that act on each other do so across the gap: buildings move otherwise apart, without contact too.
    #[test]
    fn a_run_without_contact_is_kept_only_if_gaps_do_nothing_else() {
        let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
        let example = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../examples/two_towers_on_soil.toml"
        );
        let text = std::fs::read_to_string(example).unwrap_or_else(|error| panic!("{error}"));
        let [kept, fresh] = [(); 2].map(|()| engine_of(folder.path(), &text));
        let closing = |solved: &Solved| solved.summary.gaps[0].closing_without_contact_m;
        let near = closing(&solved_at(&kept, "25 mm"));
        let far = closing(&solved_at(&kept, "2 m"));
        assert_eq!(far, closing(&solved_at(&fresh, "2 m")));
        assert_ne!(far, near);
    }

    #[test]
    fn a_kept_run_without_contact_is_that_of_the_other_width() {
        let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
        let [kept, fresh] = [engine(folder.path()), engine(folder.path())];
        let solve = solved_at;
        let first = solve(&kept, "90 mm").without;
        let second = solve(&kept, "40 mm");
        let alone = solve(&fresh, "40 mm");
        match (first, &second.without, &alone.without) {
            (Some(first), Some(second), Some(alone)) => {
                assert!(Arc::ptr_eq(&first, second), "computed twice");
                assert_eq!(second.peaks, alone.peaks);
            }
            _ => panic!("no run without contact"),
        }
        assert_eq!(second.summary.gaps, alone.summary.gaps);
    }

    fn with_record(engine: &Engine, record: &str) -> Result<Prepared, Trouble> {
        let run = Run {
            id: 1,
            text: engine.text.clone(),
            edits: vec![("motion.record".into(), record.into())],
            record: 0,
        };
        engine.prepare(&engine.tree(&run)?, 0)
    }

    #[test]
    fn records_outside_the_folder_are_refused() {
        let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
        let inside = folder.path().join("inside");
        std::fs::create_dir(&inside).unwrap_or_else(|error| panic!("{error}"));
        let record = "0.0 0.0\n0.1 1.0\n0.2 -1.0\n0.3 0.0\n";
        for name in ["outside.csv", "inside/own.csv"] {
            std::fs::write(folder.path().join(name), record)
                .unwrap_or_else(|error| panic!("{error}"));
        }
        let engine = engine(&inside);
        // Whether it is a record at all is for the reader to say.
        let record = with_record(&engine, "own.csv");
        assert!(!matches!(record, Err(Trouble::Faults(f)) if f[0].problem.contains("outside")));
        let outside = folder.path().join("outside.csv");
        let outside = outside.to_string_lossy();
        for name in [
            "../outside.csv",
            &*outside,
            "../nothing.csv",
            "/etc/passwd",
            "/etc/nothing",
        ] {
            match with_record(&engine, name) {
                Err(Trouble::Faults(faults)) => {
                    assert!(
                        faults[0].problem.contains("outside the folder"),
                        "{faults:?}"
                    );
                    assert_eq!(faults[0].path, "motion.record");
                }
                other => panic!("{name}: {:?}", other.err()),
            }
        }
        match with_record(&engine, "nothing.csv") {
            Err(Trouble::Faults(faults)) => {
                assert!(faults[0].problem.contains("there is no record"));
            }
            other => panic!("{:?}", other.err()),
        }
    }

    #[cfg(unix)]
    #[test]
    fn links_do_not_lead_out_of_the_folder() {
        let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
        let engine = engine(folder.path());
        std::os::unix::fs::symlink("/etc/passwd", folder.path().join("link.csv"))
            .unwrap_or_else(|error| panic!("{error}"));
        assert!(
            matches!(with_record(&engine, "link.csv"), Err(Trouble::Faults(f)) if f[0].problem.contains("outside"))
        );
    }

    #[test]
    fn files_of_matrices_are_confined_too() {
        let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
        let engine = engine(folder.path());
        for matrices in [
            "\"/etc/a.npz\"",
            "{ stiffness = \"../k.mtx\", mass = [1.0] }",
        ] {
            let text = format!(
                "[motion]\nrecord = \"el-centro-1940-ns\"\n\n[[building]]\nname = \"A\"\nkind = \"given\"\nmatrices = {matrices}\nports = {{ \"1\" = {{ dof = 1, height = \"3 m\" }} }}\n"
            );
            let run = Run {
                id: 1,
                text,
                edits: Vec::new(),
                record: 0,
            };
            let tree = engine
                .tree(&run)
                .unwrap_or_else(|error| panic!("{error:?}"));
            match engine.prepare(&tree, 0) {
                Err(Trouble::Faults(faults)) => {
                    assert!(faults[0].problem.contains("outside the folder"));
                    assert!(faults[0].path.starts_with("building[0].matrices"));
                }
                other => panic!("{matrices}: {:?}", other.err()),
            }
        }
    }

    /// Every table of a model that takes a record takes one of its own folder only, and so do all inside it.
    #[test]
    fn no_key_of_a_motion_leads_out_of_the_folder() {
        let outer = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
        let inner = outer.path().join("inner");
        std::fs::create_dir(&inner).unwrap_or_else(|error| panic!("{error}"));
        let record = "0.0 0.0\n0.1 1.0\n0.2 -1.0\n0.3 0.0\n";
        let spectrum = "# unit = g\n0.1 1\n1.0 0.5\n";
        for (name, text) in [("secret.csv", record), ("target.csv", spectrum)] {
            std::fs::write(outer.path().join(name), text).unwrap_or_else(|error| panic!("{error}"));
        }
        let engine = engine(&inner);
        let motions = ["motion.across", "motion.vertical", "building[0].motion"];
        let mut tried = Vec::new();
        for motion in motions {
            tried.push((format!("{motion}.record"), "../secret.csv".to_owned()));
            for spectrum in ["../target.csv", "/etc/passwd"] {
                let table = format!(
                    "{{ record = \"el-centro-1940-ns\", match = {{ spectrum = \"{spectrum}\", at = \"1 s\" }} }}"
                );
                tried.push((motion.to_owned(), table));
            }
        }
        for motion in &motions[..2] {
            tried.push(((*motion).to_owned(), "../secret.csv".to_owned()));
            tried.push(((*motion).to_owned(), "/proc/self/environ".to_owned()));
        }
        for (path, value) in tried {
            let run = Run {
                id: 1,
                text: engine.text.clone(),
                edits: vec![(path.clone(), value.clone())],
                record: 0,
            };
            let tree = engine.tree(&run);
            let prepared = tree.and_then(|tree| engine.prepare(&tree, 0));
            match prepared {
                Err(Trouble::Faults(faults)) => assert!(
                    faults
                        .iter()
                        .any(|fault| fault.problem.contains("outside the folder")),
                    "{path} = {value}: {faults:?}"
                ),
                other => panic!("{path} = {value}: {:?}", other.err()),
            }
        }
    }

    /// A page that is exported carries every file that the model names.
    #[test]
    fn all_files_of_the_model_are_known() {
        let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
        let record = "0.0 0.0\n0.1 1.0\n0.2 -1.0\n0.3 0.0\n";
        let names = ["a.csv", "b.csv", "c.csv", "d.csv"];
        for name in names {
            std::fs::write(folder.path().join(name), record)
                .unwrap_or_else(|error| panic!("{error}"));
        }
        let text = r#"
[motion]
record = ["a.csv", "b.csv"]
unit = "m/s2"
across = { record = "c.csv", unit = "m/s2" }
baseline = "as-recorded"
[[building]]
name = "A"
kind = "shear"
mass = ["40 t"]
stiffness = ["20 MN/m"]
plan = ["8 m", "6 m"]
motion = { record = "d.csv", unit = "m/s2" }
"#;
        let engine = Engine::from_text("m.toml", text, folder.path());
        let engine = engine.unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(engine.named_files(), names);
        // The same files in memory serve as well, and nothing else does.
        let files = names.map(|name| (name.to_owned(), record.as_bytes().to_vec()));
        let held = Engine::with_files("m.toml", text, Files::held(files.into()));
        let held = held.unwrap_or_else(|error| panic!("{error}"));
        let run = Run {
            id: 1,
            text: text.to_owned(),
            edits: Vec::new(),
            record: 1,
        };
        let tree = held.tree(&run).unwrap_or_else(|error| panic!("{error:?}"));
        assert!(held.prepare(&tree, 1).is_ok());
        assert!(with_record(&held, "/etc/hostname").is_err());
    }

    #[test]
    fn a_spectrum_file_is_confined_too() {
        let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
        let engine = engine(folder.path());
        let run = Run {
            id: 1,
            text: engine.text.clone(),
            edits: vec![(
                "motion.match".into(),
                "{ spectrum = \"/etc/passwd\", at = \"1 s\" }".into(),
            )],
            record: 0,
        };
        let tree = engine
            .tree(&run)
            .unwrap_or_else(|error| panic!("{error:?}"));
        assert!(
            matches!(engine.prepare(&tree, 0), Err(Trouble::Faults(f)) if f[0].problem.contains("outside"))
        );
    }
}
