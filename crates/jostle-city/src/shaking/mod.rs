//! What shakes a row of buildings: which motions reach its place, and how strong they are there.

mod event_grid;
mod fields;
mod intensities;
mod shake_map;
mod sites;

use std::borrow::Cow;

use jostle::GroundMotion;
use jostle_io::{CityFile, CityMotion, IntensityFile, MotionSpec};
use sha2::{Digest, Sha256};

use crate::blocks::Block;
use crate::fault::CityError;
use crate::inventory::Inventory;
use crate::plane::Plane;

/// A motion and the factor on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Strength {
    /// Index of the motion.
    pub(crate) motion: usize,
    /// Factor \[–\].
    pub(crate) factor: f64,
}

/// A motion, read already or read when it is needed.
#[derive(Clone, Debug)]
struct Source {
    spec: MotionSpec,
    resolved: Option<GroundMotion>,
}

/// The motions of a city, and those of every place in turn.
#[derive(Clone, Debug)]
pub(crate) struct Shaking {
    sources: Vec<Source>,
    /// Names of the motions that every place has, whichever they are there.
    names: Vec<String>,
    /// Of every place the motions of these names.
    places: Vec<Vec<Strength>>,
    /// Place of every building.
    place_of: Vec<u32>,
    /// What was found, for people.
    told: Vec<String>,
    /// Whether motions act in two directions.
    has_directions: bool,
}

impl Shaking {
    /// The motions of a city file at the blocks of buildings.
    ///
    /// # Errors
    /// When a motion or a map of them cannot be used, or does not reach a block.
    pub(crate) fn of(
        file: &CityFile,
        inventory: &Inventory,
        blocks: &[Block],
    ) -> Result<Self, CityError> {
        let mut place_of = vec![0; inventory.buildings.len()];
        let shaking = match &file.motion {
            CityMotion::Common(spec) => {
                let sources = resolved(spec)?;
                let strengths = (0..sources.len()).map(|motion| Strength {
                    motion,
                    factor: 1.0,
                });
                return Ok(Self {
                    names: sources.iter().map(Source::name).collect(),
                    places: vec![strengths.collect()],
                    has_directions: sources.iter().any(Source::has_bearing),
                    sources,
                    place_of,
                    told: Vec::new(),
                });
            }
            _ if matches!(inventory.plane, Plane::Metres) => {
                return Err(CityError::Input(
                    "motion: places of motions are longitudes and latitudes, and the footprints are in metres; give them in degrees"
                        .to_owned(),
                ));
            }
            CityMotion::Grid { file, unit, reach } => {
                event_grid::read(file, unit, *reach, inventory, blocks, &mut place_of)?
            }
            CityMotion::Scaled {
                intensities,
                records,
                choose,
                reach,
            } => {
                let sources = resolved(records)?;
                let found = match intensities {
                    IntensityFile::ShakeMap(path) => {
                        shake_map::read(path, inventory, blocks, &mut place_of)?
                    }
                    IntensityFile::Fields { file, sites } => {
                        fields::read(file, sites, *reach, inventory, blocks, &mut place_of)?
                    }
                };
                intensities::scaled(sources, &found, *choose)?
            }
        };
        Ok(Self {
            place_of,
            ..shaking
        })
    }

    /// Names of the motions that every place has.
    pub(crate) fn names(&self) -> &[String] {
        &self.names
    }

    /// How many motions every place has.
    pub(crate) fn count(&self) -> usize {
        self.names.len()
    }

    /// What was found, a line each.
    pub(crate) fn told(&self) -> &[String] {
        &self.told
    }

    /// Whether motions act in two directions.
    pub(crate) fn has_directions(&self) -> bool {
        self.has_directions
    }

    /// A motion at a building.
    pub(crate) fn at(&self, building: usize, motion: usize) -> Strength {
        self.places[self.place_of[building] as usize][motion]
    }

    /// Where a motion comes from.
    pub(crate) fn spec(&self, motion: usize) -> &MotionSpec {
        &self.sources[motion].spec
    }

    /// A motion as it is before the factor of a place.
    pub(crate) fn motion(&self, motion: usize) -> Result<Cow<'_, GroundMotion>, CityError> {
        let source = &self.sources[motion];
        match &source.resolved {
            Some(motion) => Ok(Cow::Borrowed(motion)),
            None => resolve(&source.spec).map(Cow::Owned),
        }
    }

    /// Adds all that decides a number.
    pub(crate) fn hash(&self, hash: &mut Sha256) -> Result<(), CityError> {
        for source in &self.sources {
            match &source.resolved {
                Some(motion) => hash.update(format!("{motion:?}")),
                None => event_grid::hash(&source.spec, hash)?,
            }
        }
        if self.places.len() > 1 || !self.told.is_empty() {
            hash.update(format!("{:?}{:?}", self.places, self.place_of));
        }
        Ok(())
    }
}

impl Source {
    fn name(&self) -> String {
        self.resolved
            .as_ref()
            .map_or_else(String::new, |motion| motion.name.clone())
    }

    fn has_bearing(&self) -> bool {
        self.resolved
            .as_ref()
            .is_some_and(|motion| motion.bearing.is_some())
    }
}

fn resolve(spec: &MotionSpec) -> Result<GroundMotion, CityError> {
    spec.resolve()
        .map_err(|error| CityError::Input(format!("motion: {error}")))
}

/// One motion, or every record of a list, read.
fn resolved(spec: &MotionSpec) -> Result<Vec<Source>, CityError> {
    let one = |spec: MotionSpec| {
        let resolved = Some(resolve(&spec)?);
        Ok(Source { spec, resolved })
    };
    if spec.records().is_empty() {
        return Ok(vec![one(spec.clone())?]);
    }
    let each = spec.records().iter();
    let each = each.filter_map(|name| spec.with_one_of_several(name));
    each.map(one).collect()
}
