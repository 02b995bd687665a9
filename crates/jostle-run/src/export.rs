//! Models as files for other programs: scripts, and archives of matrices.

use std::path::{Path, PathBuf};

use jostle_export::{Export, Exported, matrices, openseespy};
use jostle_io::write_atomically;

use crate::error::RunError;
use crate::opened::Opened;
use crate::replace::{FileKind, may_write};

/// First lines of every script.
const SCRIPT: FileKind = FileKind {
    name: "script that jostle exported",
    marks: &[
        "#!/usr/bin/env python3",
        "# The same model for OpenSeesPy, written by jostle ",
    ],
};
/// Array that marks archives of jostle.
const MARK: &str = "written_by_jostle";
/// Archives of matrices.
const ARCHIVE: FileKind = FileKind {
    name: "archive of matrices that jostle exported",
    marks: &["written_by_jostle.npy"],
};
const BLOCKS: FileKind = FileKind {
    name: "list of buildings that jostle exported",
    marks: &["# Buildings by their matrices, written by jostle "],
};

/// The model as a script for OpenSeesPy.
///
/// # Errors
/// The ground motion cannot be used, or the model has what that program lacks, field by field.
pub fn export_script(opened: &Opened) -> Result<Exported, RunError> {
    let (motion, _) = opened.plan()?;
    let exported = openseespy::export(&Export {
        model: &opened.input.model,
        system: &opened.system,
        motion: &motion,
    });
    Ok(exported.map_err(|mut faults| {
        for fault in faults
            .iter_mut()
            .filter(|fault| fault.path.ends_with(".infill"))
        {
            // The corners of struts follow from other keys as well.
            let keys = ["strength", "force"].into_iter();
            let mut stated = keys.filter(|key| opened.input.states_in_list(&fault.path, key));
            if let Some(key) = stated.next() {
                fault.problem = fault
                    .problem
                    .replace("with a hinge", &format!("with a {key}"));
                fault.problem = fault
                    .problem
                    .replace("leave out hinge", &format!("leave out {key}"));
            }
        }
        opened.input.faults(faults)
    })?)
}

/// Whether writing a script here replaces an earlier one.
///
/// # Errors
/// [`RunError::Kept`] for a file that jostle did not write, unless with `force`.
pub fn may_write_script(path: &Path, force: bool) -> Result<bool, RunError> {
    may_write(path, Some(SCRIPT), force)
}

/// Writes the matrices of every building as NumPy archives, and a list of buildings for a model file, into a folder.
/// Returns the files, the list last.
///
/// # Errors
/// A building has no matrices, a file must stay, or cannot be written.
pub fn export_matrices(
    opened: &Opened,
    folder: &Path,
    force: bool,
) -> Result<Vec<PathBuf>, RunError> {
    let motion = opened.plan()?.0;
    let buildings = matrices::export(&Export {
        model: &opened.input.model,
        system: &opened.system,
        motion: &motion,
    });
    let buildings = buildings.map_err(|faults| opened.input.faults(faults))?;
    let mut text = format!(
        "# Buildings by their matrices, written by jostle {} from \"{}\". Add [motion], [[gap]] and [[link]].\n",
        env!("CARGO_PKG_VERSION"),
        opened.input.model.title
    );
    let list = folder.join("buildings.toml");
    let file_of = |name: &str| {
        let plain = |c: char| {
            if c.is_alphanumeric() || "-_ ".contains(c) {
                c
            } else {
                '_'
            }
        };
        format!("{}.npz", name.chars().map(plain).collect::<String>())
    };
    std::fs::create_dir_all(folder).map_err(|error| {
        RunError::Argument(format!("{} cannot be made: {error}", folder.display()))
    })?;
    may_write(&list, Some(BLOCKS), force)?;
    for building in &buildings {
        may_write(&folder.join(file_of(&building.name)), Some(ARCHIVE), force)?;
    }
    let mut written = Vec::new();
    for building in &buildings {
        let mut arrays: Vec<(&str, &[usize], Vec<f64>)> = building
            .arrays
            .iter()
            .map(|(name, sizes, values)| (*name, &sizes[..], values.clone()))
            .collect();
        arrays.push((MARK, &[1], vec![1.0]));
        let file = file_of(&building.name);
        let path = folder.join(&file);
        let bytes = jostle_io::numpy_archive(&arrays)
            .map_err(|error| RunError::Analysis(format!("{}: {error}", path.display())))?;
        write_atomically(&path, &bytes)?;
        written.push(path);
        text.push('\n');
        text.push_str(&building.block.replace("FILE", &file));
    }
    write_atomically(&list, text.as_bytes())?;
    written.push(list);
    Ok(written)
}
