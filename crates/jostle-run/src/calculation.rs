//! What a calculation document is made from, beside the numbers of a run.

use jostle::eigen::Mode;
use jostle::{GroundMotion, Model, System, Wave};
use jostle_io::TitleBlock;
use jostle_report::{Calculation, TitleBlockPart};
use sha2::{Digest, Sha256};

use crate::modes::floor_shape;
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

fn shapes(system: &System) -> Vec<Vec<(f64, Vec<f64>)>> {
    let buildings = system.structures().iter();
    buildings
        .map(|building| {
            let mat = building
                .support
                .map(|support| support.dof - building.offset);
            let of = |mode: &Mode| (mode.period(), shape_from(mode, mat));
            building.lateral_modes().take(SHAPES).map(of).collect()
        })
        .collect()
}

/// Horizontal shape at the mat, if there is one, and at the floors, the floor that moves most by ±1.
fn shape_from(mode: &Mode, mat: Option<usize>) -> Vec<f64> {
    let floors = floor_shape(mode);
    let pairs = floors.iter().zip(&mode.floors);
    let scale = pairs.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
    let scale = scale.map_or(0.0, |(scaled, unscaled)| scaled / unscaled);
    let mat = mat.map(|dof| scale * mode.shape[dof]);
    mat.into_iter().chain(floors).collect()
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
