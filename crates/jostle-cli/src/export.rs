//! `jostle export`: the model as a script for another program, or as matrices.

use std::path::{Path, PathBuf};

use jostle_export::{Export, matrices, openseespy};
use jostle_run::{FileKind, may_write};

use crate::args::ModelArgs;
use crate::failure::Failure;
use crate::terminal;

/// Model and target program.
#[derive(Debug, clap::Args)]
pub(crate) struct ExportArgs {
    #[command(flatten)]
    model: ModelArgs,
    /// Program to write for
    #[arg(long, value_enum)]
    to: Target,
    /// File for a script, or folder for matrices. A script without a file is printed
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Replace the file even if jostle did not write it
    #[arg(long, requires = "output")]
    force: bool,
}

/// First lines of every script.
const SCRIPT: FileKind = FileKind {
    name: "script that jostle exported",
    marks: &[
        "#!/usr/bin/env python3",
        "# The same model for OpenSeesPy, written by jostle ",
    ],
};

/// Programs that models can be exported to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Target {
    /// A Python script for OpenSeesPy
    Openseespy,
    /// NumPy archives with the matrices of every building, and a list of buildings for a model file
    Matrices,
}

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

pub(crate) fn export(args: &ExportArgs) -> Result<(), Failure> {
    match args.to {
        Target::Openseespy => export_script(args),
        Target::Matrices => export_matrices(args),
    }
}

fn export_matrices(args: &ExportArgs) -> Result<(), Failure> {
    let Some(folder) = &args.output else {
        return Err(Failure::Input(
            "--to matrices writes several files: add --output FOLDER".to_owned(),
        ));
    };
    let opened = args.model.open()?;
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
    std::fs::create_dir_all(folder)
        .map_err(|error| Failure::Input(format!("{} cannot be made: {error}", folder.display())))?;
    may_write(&list, Some(BLOCKS), args.force)?;
    for building in &buildings {
        may_write(
            &folder.join(file_of(&building.name)),
            Some(ARCHIVE),
            args.force,
        )?;
    }
    for building in &buildings {
        let mut arrays: Vec<(&str, &[usize], Vec<f64>)> = building
            .arrays
            .iter()
            .map(|(name, sizes, values)| (*name, &sizes[..], values.clone()))
            .collect();
        arrays.push((MARK, &[1], vec![1.0]));
        let file = file_of(&building.name);
        write_archive(&folder.join(&file), &arrays)?;
        text.push('\n');
        text.push_str(&building.block.replace("FILE", &file));
    }
    jostle_io::write_atomically(&list, text.as_bytes())?;
    terminal::remark(&format!("written: {}", list.display()));
    Ok(())
}

fn write_archive(path: &Path, arrays: &[(&str, &[usize], Vec<f64>)]) -> Result<(), Failure> {
    let bytes = jostle_io::numpy_archive(arrays)
        .map_err(|error| Failure::Analysis(format!("{}: {error}", path.display())))?;
    jostle_io::write_atomically(path, &bytes)?;
    terminal::remark(&format!("written: {}", path.display()));
    Ok(())
}

fn export_script(args: &ExportArgs) -> Result<(), Failure> {
    let replaces = match &args.output {
        Some(path) => may_write(path, Some(SCRIPT), args.force)?,
        None => false,
    };
    let opened = args.model.open()?;
    let (motion, _) = opened.plan()?;
    let export = Export {
        model: &opened.input.model,
        system: &opened.system,
        motion: &motion,
    };
    let exported = openseespy::export(&export);
    let exported = exported.map_err(|faults| opened.input.faults(faults))?;
    for remark in &exported.remarks {
        terminal::remark(&format!(
            "{} {remark}",
            jostle_run::styled(jostle_run::LOUD, "difference:")
        ));
    }
    match &args.output {
        None => terminal::print(&exported.text),
        Some(path) => {
            jostle_io::write_atomically(path, exported.text.as_bytes())?;
            let done = if replaces { "replaced" } else { "written" };
            terminal::remark(&format!("{done}: {}", path.display()));
            Ok(())
        }
    }
}
