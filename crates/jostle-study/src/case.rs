//! One case: from the values of its factors to a row.

use std::sync::{Arc, Mutex, PoisonError};

use jostle::{Gap, GroundMotion, Model, Plan, RunEnd, StepError, System};
use jostle_io::{Input, InputError, MotionSource, MotionSpec, PathError, Scaling};
use jostle_run::{Prepared, Ran, SharedShapes};

use crate::design::value_of;
use crate::measures::measures;
use crate::row::{Row, Status};
use crate::study::Study;

/// Data shared by successive cases: assembled systems and records.
#[derive(Default)]
pub struct Workshop {
    /// The last systems, the most recent at the end.
    systems: Mutex<Vec<Assembled>>,
    records: Mutex<Vec<(MotionSource, Arc<GroundMotion>)>>,
}

/// A model, its system, and the shapes for modal stepping.
#[derive(Clone)]
struct Assembled {
    model: Arc<Model>,
    system: Arc<System>,
    shapes: SharedShapes,
}

/// Assembled systems that are kept.
const SYSTEMS: usize = 32;
/// Records that are kept.
const RECORDS: usize = 256;

/// Why a case cannot be stepped.
#[derive(Debug, thiserror::Error)]
pub enum CaseError {
    /// A path leads nowhere.
    #[error("{0}")]
    Path(#[from] PathError),
    /// The model is wrong.
    #[error("{0}")]
    Input(#[from] InputError),
}

impl Workshop {
    /// Reads a case, finds its system and its motion, and plans its steps.
    ///
    /// # Errors
    /// [`CaseError`] with the message of the reader of model files.
    pub fn prepare(&self, study: &Study, case: u64) -> Result<Prepared, CaseError> {
        let tree = study.tree(&study.design.choices(case, &study.file.factors))?;
        self.assemble(tree.input()?)
    }

    /// Assembles a model that has been read, finds its motion, and plans its steps.
    ///
    /// # Errors
    /// [`CaseError`], as the reader of model files says it.
    pub fn assemble(&self, mut input: Input) -> Result<Prepared, CaseError> {
        let Assembled { system, shapes, .. } = self.assembled(&input)?;
        input.note_system(&system);
        let motion = self.motion(&input)?;
        let plan = Plan::choose(&system, &motion, &input.model.analysis)
            .map_err(|faults| input.faults(faults))?;
        let shapes = shapes.find(&system, &plan);
        let prepared = Prepared::new(Arc::new(input), system, motion, plan, shapes);
        prepared.check_digits(None)?;
        Ok(prepared)
    }

    fn assembled(&self, input: &Input) -> Result<Assembled, InputError> {
        let kin = {
            let systems = self.systems.lock().unwrap_or_else(PoisonError::into_inner);
            let known = systems
                .iter()
                .find(|known| same(&known.model, &input.model));
            if let Some(known) = known {
                return Ok(known.clone());
            }
            let kin = systems
                .iter()
                .find(|known| kindred(&known.model, &input.model));
            kin.cloned()
        };
        let assembled = match &kin {
            Some(kin) => kin.system.with_widths_of(&input.model),
            None => System::assemble(&input.model),
        };
        let assembled = Assembled {
            model: Arc::new(input.model.clone()),
            system: Arc::new(assembled.map_err(|faults| input.faults(faults))?),
            shapes: kin.map_or_else(SharedShapes::default, |kin| kin.shapes),
        };
        let mut systems = self.systems.lock().unwrap_or_else(PoisonError::into_inner);
        if systems.len() >= SYSTEMS {
            systems.remove(0);
        }
        systems.push(assembled.clone());
        Ok(assembled)
    }

    /// The motion of a case; a record is read once.
    fn motion(&self, input: &Input) -> Result<GroundMotion, InputError> {
        let Some(spec) = &input.motion else {
            return input.ground_motion();
        };
        if !matches!(spec.source, MotionSource::Record { .. }) {
            return input.ground_motion();
        }
        let known = {
            let records = self.records.lock().unwrap_or_else(PoisonError::into_inner);
            let found = records.iter().find(|(source, _)| *source == spec.source);
            found.map(|(_, motion)| Arc::clone(motion))
        };
        let unscaled = match known {
            Some(motion) => motion,
            None => {
                let plain = MotionSpec {
                    scaling: Scaling::AsRecorded,
                    reverse: false,
                    duration: None,
                    ..spec.clone()
                };
                // The error shows the line of the record.
                let Ok(motion) = plain.resolve() else {
                    return input.ground_motion();
                };
                let motion = Arc::new(motion);
                let mut records = self.records.lock().unwrap_or_else(PoisonError::into_inner);
                if records.len() >= RECORDS {
                    records.remove(0);
                }
                records.push((spec.source.clone(), Arc::clone(&motion)));
                motion
            }
        };
        let given = MotionSpec {
            source: MotionSource::Given(GroundMotion::clone(&unscaled)),
            ..spec.clone()
        };
        given.resolve().or_else(|_| input.ground_motion())
    }
}

/// Whether two models make the same system: what is said about steps and the title makes no difference.
fn same(a: &Model, b: &Model) -> bool {
    a.buildings == b.buildings && a.gaps == b.gaps && a.links == b.links
}

/// Whether two models differ only in the widths of their gaps and in the differences that [`same`] allows.
fn kindred(a: &Model, b: &Model) -> bool {
    let alike = |(a, b): (&Gap, &Gap)| {
        let widths = b.widths.clone();
        a.widths.len() == widths.len()
            && Gap {
                widths,
                ..a.clone()
            } == *b
    };
    a.buildings == b.buildings
        && a.links == b.links
        && a.gaps.len() == b.gaps.len()
        && a.gaps.iter().zip(&b.gaps).all(alike)
}

/// The row of a case without results.
pub(crate) fn blank(study: &Study, case: u64) -> Row {
    let choices = study.design.choices(case, &study.file.factors);
    let mut numbers = Vec::with_capacity(study.layout.count_numbers());
    let mut texts = Vec::new();
    let columns = study.layout.inputs.iter();
    for ((factor, choice), column) in study.file.factors.iter().zip(&choices).zip(columns) {
        let (_, number, label) = value_of(factor, choice);
        if column.kind == crate::layout::Kind::Text {
            texts.push(label);
        } else {
            numbers.push(number);
        }
    }
    texts.push(String::new());
    numbers.resize(study.layout.count_numbers(), None);
    Row {
        case,
        status: Status::Completed,
        reason: String::new(),
        numbers,
        texts,
    }
}

/// The row of a case that could not be computed.
pub(crate) fn failed(study: &Study, case: u64, reason: &str) -> Row {
    Row {
        status: Status::Failed,
        reason: one_line(reason),
        ..blank(study, case)
    }
}

/// A message of several lines without its excerpts of the file.
fn one_line(text: &str) -> String {
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let lines = lines.filter(|line| {
        let excerpt = line.split_once('|').is_some_and(|(number, _)| {
            number.trim().is_empty() || number.trim().parse::<usize>().is_ok()
        });
        !excerpt
            && !line.starts_with('|')
            && !line.contains(" fault in ")
            && !line.contains(" faults in ")
    });
    lines.collect::<Vec<_>>().join("; ")
}

/// The row of a case that ran.
pub(crate) fn row_of(study: &Study, case: u64, ran: &Ran) -> Row {
    let summary = ran.summary();
    let mut row = blank(study, case);
    if let Some(text) = row.texts.last_mut() {
        text.clone_from(&summary.motion.name);
    }
    row.status = match &ran.outcome.end {
        RunEnd::Completed | RunEnd::Stopped => Status::Completed,
        RunEnd::Failed(StepError::Collapse { .. }) => Status::Collapsed,
        RunEnd::Failed(_) => Status::Failed,
    };
    if let RunEnd::Failed(error) = &ran.outcome.end {
        row.reason = error.to_string();
    }
    let offset = row.numbers.len() - study.layout.results.len();
    let mut homeless: Vec<String> = Vec::new();
    let found = measures(&summary, &ran.prepared.system, &ran.prepared.motion);
    for named in found {
        // Peaks up to a failure are not peaks of the whole case.
        let known_anyway = matches!(&named.name[..], "pga_m_s2")
            || named.name.ends_with(".width_m")
            || named.name.ends_with("_t1_m_s2")
            || named.name.ends_with(".period_s");
        if row.status == Status::Failed && !known_anyway {
            continue;
        }
        match study.layout.place(&named.name) {
            Some(place) => row.numbers[offset + place] = named.value,
            None => homeless.push(named.name),
        }
    }
    if row.reason.is_empty() {
        row.reason = summary.warnings.join("; ");
    }
    if !homeless.is_empty() {
        let more = format!("without a column: {}", homeless.join(", "));
        row.reason = if row.reason.is_empty() {
            more
        } else {
            format!("{}; {more}", row.reason)
        };
    }
    row
}
