//! What a calculation document is made from, beside the numbers of a run.

use jostle::eigen::Mode;
use jostle::system::{BuildingSystem, Direction};
use jostle::{GroundMotion, Model, System, Wave};
use jostle_io::TitleBlock;
use jostle_report::{Calculation, ShownMode, TitleBlockPart};
use sha2::{Digest, Sha256};

use crate::prepared::Prepared;

/// Mode shapes shown of a building.
const SHAPES: usize = 3;

impl Prepared {
    /// The parts of a report that are known before a run.
    #[must_use]
    pub(crate) fn calculation(&self) -> Calculation<'_> {
        let text = self.input.text();
        Calculation {
            shapes: shapes(&self.system),
            target: self.input.target(),
            title_block: title_block(&self.input.title_block),
            input_text: text,
            input_hash: hex(&Sha256::digest(text.as_bytes())),
            run_hash: run_hash(&self.input.model, &self.motion),
        }
    }
}

/// The entries that a file has.
fn title_block(block: &TitleBlock) -> Vec<(TitleBlockPart, &str)> {
    let parts = [
        (TitleBlockPart::Project, &block.project),
        (TitleBlockPart::Client, &block.client),
        (TitleBlockPart::Author, &block.author),
        (TitleBlockPart::Date, &block.date),
    ];
    let mut stated = Vec::new();
    for (part, text) in parts {
        stated.extend(text.as_deref().map(|text| (part, text)));
    }
    stated
}

fn shapes(system: &System) -> Vec<Vec<ShownMode>> {
    let buildings = system.structures().iter();
    buildings
        .map(|building| {
            let modes = building.lateral_modes().take(SHAPES);
            modes.map(|mode| shown_mode(building, mode)).collect()
        })
        .collect()
}

/// The mode in the direction that carries most of its mass, from what is below the lowest floor up; the greatest is 1.
fn shown_mode(building: &BuildingSystem, mode: &Mode) -> ShownMode {
    let shares = [
        (Direction::Along, mode.effective_mass_ratio_x),
        (Direction::Across, mode.effective_mass_ratio_across),
        (Direction::Turning, mode.effective_mass_ratio_torsion),
    ];
    let more = |most: (Direction, f64), next: (Direction, f64)| {
        if next.1 > most.1 { next } else { most }
    };
    let (direction, _) = shares.into_iter().fold(shares[0], more);
    let at = |dof: usize| mode.shape[dof - building.offset];
    let tracks = building.tracks.iter();
    let floors = tracks.filter(|track| track.direction == direction);
    let base = dof_below(building, direction).map_or(0.0, at);
    let values = std::iter::once(base).chain(floors.map(|track| at(track.dof)));
    let values: Vec<f64> = values.collect();
    let greatest = values.iter().fold(0.0, |greatest: f64, value| {
        if value.abs() > greatest.abs() {
            *value
        } else {
            greatest
        }
    });
    let scale = if greatest == 0.0 { 0.0 } else { 1.0 / greatest };
    ShownMode {
        period: mode.period(),
        direction,
        shape: values.into_iter().map(|value| scale * value).collect(),
    }
}

/// What moves below the lowest floor in a direction: a mat, or a foundation on springs; `None` on the ground.
fn dof_below(building: &BuildingSystem, direction: Direction) -> Option<usize> {
    let mat = building.mat_in_plan.as_ref().map(|mat| mat.dofs);
    match direction {
        Direction::Along => building
            .support
            .map(|support| support.dof)
            .or(building.foot),
        Direction::Across => mat.map(|[_, across, _]| across).or_else(|| {
            let base = building.discretization.stick_model.plan_base?;
            let across = building.equations.vertical(base.footing)?;
            Some(across + building.offset)
        }),
        Direction::Turning => mat.map(|[.., turning]| turning),
        Direction::Up => None,
    }
}

/// Changes with every number of the model and of the motion, and with the version.
fn run_hash(model: &Model, motion: &GroundMotion) -> String {
    let mut hash = Sha256::new();
    hash.update(env!("CARGO_PKG_VERSION").as_bytes());
    // Every number of a model is in its debug form, with all digits.
    hash.update(format!("{model:?} {:?} {:?}", motion.scale, motion.duration).as_bytes());
    match &motion.wave {
        Wave::Sampled { step, acceleration } => {
            hash.update(step.to_le_bytes());
            acceleration
                .iter()
                .for_each(|a| hash.update(a.to_le_bytes()));
        }
        other => hash.update(format!("{other:?}").as_bytes()),
    }
    hex(&hash.finalize())
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
