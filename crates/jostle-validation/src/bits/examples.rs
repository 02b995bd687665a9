//! The examples, and the models that are compared with OpenSees.

use std::path::{Path, PathBuf};

use jostle::Solver;
use jostle_run::read;

use super::pinned::{ALL, Pinned};

/// Longest motion \[s\].
const LONGEST: f64 = 3.0;
/// The same for models that take long \[s\].
const LONGEST_OF_SLOW: f64 = 1.5;
/// Examples that take long.
const SLOW: [&str; 6] = [
    "columns_that_fail_in_shear",
    "frames_in_plan",
    "reinforced_frames",
    "row_with_wall_and_damper",
    "space_frames",
    "yielding_space_frames",
];

/// Every example that is no study, under every solver.
pub(super) fn models() -> Vec<Pinned> {
    in_folder("../../examples", "", &ALL)
}

/// Models that are compared with OpenSees, by direct steps and by those that users get.
pub(super) fn compared_models() -> Vec<Pinned> {
    in_folder(
        "data/opensees",
        "opensees-",
        &[Solver::Modal, Solver::Riccati],
    )
}

fn in_folder(folder: &str, prefix: &str, solvers: &[Solver]) -> Vec<Pinned> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let files = std::fs::read_dir(&folder).into_iter().flatten().flatten();
    let mut files: Vec<PathBuf> = files.map(|file| file.path()).collect();
    files.retain(|file| file.extension().is_some_and(|kind| kind == "toml"));
    files.sort();
    let stem = |file: &Path| {
        let stem = file.file_stem().unwrap_or_default();
        stem.to_string_lossy().into_owned()
    };
    let models = files
        .iter()
        .filter(|file| !stem(file).starts_with("study_"));
    let models = models.map(|file| {
        let longest = if SLOW.contains(&&stem(file)[..]) {
            LONGEST_OF_SLOW
        } else {
            LONGEST
        };
        let model = Pinned {
            name: format!("{prefix}{}", stem(file)),
            input: read(file).map_err(|error| error.to_string()),
            solvers: solvers.to_vec(),
        };
        model.shortened(longest)
    });
    models.collect()
}
