//! The manifest of a folder of results.

use std::path::{Path, PathBuf};
use std::time::Duration;

use jostle_io::{
    FactorValues, FileError, Format, ModelTree, StudyFile, read_file, write_atomically,
};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::study::{Study, StudyError};

/// `manifest.json`: all data needed to interpret and continue the tables.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Manifest {
    /// Version of this format.
    format: u32,
    /// Version of jostle that computes.
    jostle: String,
    /// Commits of it that have computed, as far as they are known.
    #[serde(default)]
    builds: Vec<String>,
    title: String,
    /// Identity of this study.
    study_sha256: String,
    /// Of the base model.
    model_sha256: String,
    design: String,
    seed: u64,
    cases: u64,
    /// Cases of a part; part k begins with case k times this.
    part_cases: u64,
    /// Varied keys.
    factors: Value,
    /// Columns of the table.
    columns: Vec<String>,
    /// The study and its model, to run it again.
    study: String,
    model: String,
    /// Where they were read from; no part of what a study is.
    #[serde(default)]
    origin: Origin,
}

/// Where a study and its model were read from: names for messages, and folders from which records are looked for.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Origin {
    study_name: String,
    study_folder: PathBuf,
    model_name: String,
    model_folder: PathBuf,
    /// Whether the model is written out in the study.
    model_in_study: bool,
}

const FORMAT: u32 = 2;
/// Age from which a file that was being written is what a killed process left.
const LEFT: Duration = Duration::from_secs(60);
/// Largest manifest \[bytes\]: the texts of a study and a model, twice.
const LARGEST: usize = 128 << 20;

impl Manifest {
    pub(crate) fn new(study: &Study) -> Self {
        let file = &study.file;
        let factors = file.factors.iter().zip(&study.layout.inputs);
        let factors = factors.map(|(factor, column)| {
            json!({
                "name": factor.name,
                "column": column.name,
                "paths": factor.paths,
                "multiplies": factor.multiplies,
                "values": match &factor.values {
                    FactorValues::Listed(levels) => json!(levels.len()),
                    FactorValues::Drawn(distribution) => json!(format!("{distribution:?}")),
                    FactorValues::Table(column) => json!(column.table.rows()),
                },
            })
        });
        Self {
            format: FORMAT,
            jostle: env!("CARGO_PKG_VERSION").to_owned(),
            builds: jostle_report::BUILD
                .map(str::to_owned)
                .into_iter()
                .collect(),
            title: file.title.clone(),
            study_sha256: study.fingerprint.clone(),
            model_sha256: study.model_hash.clone(),
            design: format!("{:?}", file.design.kind),
            seed: file.design.seed,
            cases: study.design.cases,
            part_cases: study.part_cases,
            factors: factors.collect(),
            columns: study
                .layout
                .names()
                .into_iter()
                .map(str::to_owned)
                .collect(),
            study: file.text().to_owned(),
            model: file.base.text().to_owned(),
            origin: Origin {
                study_name: file.name().to_owned(),
                study_folder: absolute(&file.folder),
                model_name: file.base.name().to_owned(),
                model_folder: absolute(file.base.base()),
                model_in_study: file.has_own_model(),
            },
        }
    }

    fn write(&self, folder: &Path) -> Result<(), StudyError> {
        let text = serde_json::to_string_pretty(self).unwrap_or_default() + "\n";
        Ok(write_atomically(&Self::path(folder), text.as_bytes())?)
    }

    fn path(folder: &Path) -> PathBuf {
        folder.join("manifest.json")
    }

    /// The manifest of a folder; `None` without one.
    fn load(folder: &Path) -> Result<Option<Self>, StudyError> {
        let path = Self::path(folder);
        let bytes = match read_file(&path, LARGEST) {
            Ok(bytes) => bytes,
            Err(FileError::Io(error)) if error.kind() == std::io::ErrorKind::NotFound => {
                return Ok(None);
            }
            Err(error) => {
                return Err(StudyError::Folder(format!(
                    "{} {error}; choose another folder with --out",
                    path.display()
                )));
            }
        };
        let manifest = serde_json::from_slice(&bytes).map_err(|error| {
            StudyError::Folder(format!(
                "{} is damaged: {error}; choose another folder with --out, or move the manifest and the folder cases away",
                path.display()
            ))
        })?;
        Ok(Some(manifest))
    }

    /// The study that the folder holds, read from the texts kept in the manifest.
    fn study(&self, folder: &Path) -> Result<Study, StudyError> {
        let origin = &self.origin;
        if self.format != FORMAT || self.jostle != env!("CARGO_PKG_VERSION") {
            return Err(StudyError::Folder(format!(
                "{} was computed by another version of jostle ({})",
                folder.display(),
                self.jostle
            )));
        }
        let base = if origin.model_in_study {
            None
        } else {
            let format = Format::of_text(&self.model);
            let folder = &origin.model_folder;
            Some(ModelTree::parse(
                &origin.model_name,
                &self.model,
                format,
                folder,
            )?)
        };
        let format = Format::of_text(&self.study);
        let file = StudyFile::parse(
            &origin.study_name,
            &self.study,
            format,
            &origin.study_folder,
            base,
        )?;
        let study = Study::new(file)?;
        let manifest = Self::new(&study);
        if self.is_same(&manifest) {
            return Ok(study);
        }
        Err(self.refusal(&manifest, folder))
    }

    /// Whether two manifests are about the same study, wherever it was read from.
    fn is_same(&self, other: &Self) -> bool {
        let other = Self {
            origin: self.origin.clone(),
            builds: self.builds.clone(),
            ..other.clone()
        };
        *self == other
    }

    fn refusal(&self, manifest: &Self, folder: &Path) -> StudyError {
        StudyError::Folder(format!(
            "{} holds {}: {}; choose another folder with --out, or remove this one",
            folder.display(),
            if self.study_sha256 == manifest.study_sha256 {
                "results of another kind"
            } else {
                "another study"
            },
            self.difference(manifest)
        ))
    }

    fn difference(&self, other: &Self) -> String {
        if self.format != other.format || self.jostle != other.jostle {
            "it was computed by another version of jostle".to_owned()
        } else if self.model != other.model {
            format!(
                "the model has changed; the folder was made with the base model {}",
                self.origin.model_name
            )
        } else if self.study != other.study {
            "the study file has changed".to_owned()
        } else {
            "a record has changed".to_owned()
        }
    }
}

/// Makes a folder ready for a study, or makes sure that it holds this one.
///
/// # Errors
/// [`StudyError::Folder`] when it holds another study, [`StudyError::Output`] when it cannot be written.
pub fn settle(study: &Study, folder: &Path) -> Result<(), StudyError> {
    settle_for_part(study, folder)?;
    for inner in [folder.to_owned(), folder.join("cases")] {
        // What another machine is writing is younger.
        jostle_io::remove_leftovers(&inner, LEFT);
    }
    Ok(())
}

/// The same without a look at the other files of the folder.
pub(crate) fn settle_for_part(study: &Study, folder: &Path) -> Result<(), StudyError> {
    for inner in ["cases", "under-way"] {
        let path = folder.join(inner);
        std::fs::create_dir_all(&path)
            .map_err(|error| StudyError::Output(format!("{}: {error}", path.display())))?;
    }
    let manifest = Manifest::new(study);
    let mut found = Manifest::load(folder)?;
    if found.is_none() && has_parts(folder) {
        // Another process may have begun in between.
        found = Manifest::load(folder)?;
        if found.is_none() {
            return Err(StudyError::Folder(format!(
                "{} has parts of a table but no manifest.json that says of what study; choose another folder with --out",
                folder.display()
            )));
        }
    }
    match found {
        Some(mut known) if known.is_same(&manifest) => {
            if manifest
                .builds
                .iter()
                .all(|build| known.builds.contains(build))
            {
                return Ok(());
            }
            if !study.any_build {
                return Err(StudyError::Folder(format!(
                    "{} was computed by another build of jostle ({}; this is {}), whose results may differ; choose another folder with --out, or add --any-build to go on all the same",
                    folder.display(),
                    known.builds.join(", "),
                    manifest.builds.join(", ")
                )));
            }
            known.builds.extend(manifest.builds);
            known.write(folder)
        }
        Some(known) => Err(known.refusal(&manifest, folder)),
        None => manifest.write(folder),
    }
}

/// The study whose results a folder holds, with its model, as the manifest of the folder has them; `None` without a
/// manifest.
///
/// # Errors
/// [`StudyError`] when the manifest is damaged, or when a record of the study is gone or has changed.
pub fn of_folder(folder: &Path) -> Result<Option<Study>, StudyError> {
    match Manifest::load(folder)? {
        Some(manifest) => manifest.study(folder).map(Some),
        None => Ok(None),
    }
}

/// A path that means the same from any folder.
fn absolute(path: &Path) -> PathBuf {
    let here = if path == Path::new("") {
        Path::new(".")
    } else {
        path
    };
    std::path::absolute(here).unwrap_or_else(|_| path.to_owned())
}

/// Whether a folder holds finished parts.
fn has_parts(folder: &Path) -> bool {
    std::fs::read_dir(folder.join("cases")).is_ok_and(|entries| {
        entries
            .flatten()
            .any(|entry| entry.path().extension().is_some_and(|e| e == "parquet"))
    })
}
