//! What cases that follow each other share.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::SystemTime;

use jostle::{Gap, GroundMotion, Model, Plan, System};
use jostle_io::{Input, InputError, MotionSource, MotionSpec, PathError, Scaling};

use crate::prepared::Prepared;
use crate::shapes::SharedShapes;

/// A record that was read.
#[derive(Debug)]
struct KnownRecord {
    source: MotionSource,
    written: Option<(SystemTime, u64)>,
    motion: Arc<GroundMotion>,
}

/// When the file of a record was last written, and its length: a changed one is read anew. `None` of built-in records.
fn last_written(source: &MotionSource) -> Option<(SystemTime, u64)> {
    let MotionSource::Record { name, files, .. } = source else {
        return None;
    };
    let found = std::fs::metadata(files.folder().join(name)).ok()?;
    Some((found.modified().ok()?, found.len()))
}

/// Data shared by successive cases: assembled systems and records.
#[derive(Default)]
pub struct CaseCache {
    /// The last systems, the most recent at the end.
    systems: Mutex<Vec<Assembled>>,
    records: Mutex<Vec<KnownRecord>>,
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

impl CaseCache {
    /// Assembles a model that has been read, finds its motion, and plans its steps.
    ///
    /// # Errors
    /// [`CaseError`] with the message of the reader of model files.
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
        let same_buildings = {
            let systems = self.systems.lock().unwrap_or_else(PoisonError::into_inner);
            let known = systems
                .iter()
                .find(|known| same(&known.model, &input.model));
            if let Some(known) = known {
                return Ok(known.clone());
            }
            let same_buildings = systems
                .iter()
                .find(|known| same_except_gaps(&known.model, &input.model));
            same_buildings.cloned()
        };
        let assembled = match &same_buildings {
            Some(same_buildings) => same_buildings.system.with_gaps_of(&input.model),
            None => System::assemble(&input.model),
        };
        let assembled = Assembled {
            model: Arc::new(input.model.clone()),
            system: Arc::new(assembled.map_err(|faults| input.faults(faults))?),
            shapes: same_buildings.map_or_else(SharedShapes::default, |same_buildings| {
                same_buildings.shapes
            }),
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
        let written = last_written(&spec.source);
        let known = {
            let records = self.records.lock().unwrap_or_else(PoisonError::into_inner);
            let mut known = records.iter();
            let found = known.find(|known| known.source == spec.source && known.written == written);
            found.map(|known| Arc::clone(&known.motion))
        };
        let unscaled = match known {
            Some(motion) => motion,
            None => {
                let plain = MotionSpec {
                    scaling: Scaling::AsRecorded,
                    reverse: false,
                    duration: None,
                    bearing: None,
                    grounds: None,
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
                records.push(KnownRecord {
                    source: spec.source.clone(),
                    written,
                    motion: Arc::clone(&motion),
                });
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

/// What [`System`] is made of besides gaps; steps and the title make no difference. A new field of a model must be named here.
fn parts(model: &Model) -> impl PartialEq + '_ {
    let Model {
        title: _,
        buildings,
        gaps: _,
        links,
        walls,
        soil,
        analysis,
    } = model;
    let followed = (&analysis.members, analysis.link_motion);
    (buildings, links, walls, soil, followed)
}

/// Whether two models make the same system.
fn same(a: &Model, b: &Model) -> bool {
    a.gaps == b.gaps && parts(a) == parts(b)
}

/// Whether two models make the same system except for the widths of their gaps.
fn same_except_gaps(a: &Model, b: &Model) -> bool {
    let alike = |(a, b): (&Gap, &Gap)| {
        let widths = b.widths.clone();
        a.widths.len() == widths.len()
            && Gap {
                widths,
                ..a.clone()
            } == *b
    };
    a.gaps.len() == b.gaps.len() && a.gaps.iter().zip(&b.gaps).all(alike) && parts(a) == parts(b)
}
