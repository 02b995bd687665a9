//! What a folder of results is about.

use std::path::{Path, PathBuf};

use jostle_io::{FactorValues, write_atomically};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::study::{Study, StudyError};

/// `manifest.json`: enough to know what the tables are and to go on with them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Manifest {
    /// Version of this format.
    format: u32,
    /// Version of jostle that computes.
    jostle: String,
    title: String,
    /// What tells this study from others.
    study_sha256: String,
    /// Of the base model.
    model_sha256: String,
    design: String,
    seed: u64,
    cases: u64,
    /// Cases of a part; part k begins with case k times this.
    part_cases: u64,
    /// What varies.
    factors: Value,
    /// Columns of the table.
    columns: Vec<String>,
    /// The study and its model, to run it again.
    study: String,
    model: String,
}

const FORMAT: u32 = 1;

impl Manifest {
    pub(crate) fn of(study: &Study) -> Self {
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
                },
            })
        });
        Self {
            format: FORMAT,
            jostle: env!("CARGO_PKG_VERSION").to_owned(),
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
        }
    }

    fn path(folder: &Path) -> PathBuf {
        folder.join("manifest.json")
    }

    /// Makes the folder ready for the study, or makes sure that it holds this one.
    pub(crate) fn settle(study: &Study, folder: &Path) -> Result<(), StudyError> {
        let wrong = |path: &Path, error: &dyn std::fmt::Display| {
            StudyError::Output(format!("{}: {error}", path.display()))
        };
        for inner in ["cases", "under-way"] {
            let path = folder.join(inner);
            std::fs::create_dir_all(&path).map_err(|error| wrong(&path, &error))?;
        }
        let path = Self::path(folder);
        let own = Self::of(study);
        let mut found = std::fs::read(&path);
        if found.is_err() && has_parts(folder) {
            // Another process may have begun in between.
            found = std::fs::read(&path);
            if found.is_err() {
                return Err(StudyError::Folder(format!(
                    "{} has parts of a table but no manifest.json that tells of what study; choose another folder with --out",
                    folder.display()
                )));
            }
        }
        match found {
            Ok(bytes) => {
                let known: Self = serde_json::from_slice(&bytes)
                    .map_err(|error| StudyError::Folder(format!("{}: {error}", path.display())))?;
                if known == own {
                    return Ok(());
                }
                Err(StudyError::Folder(format!(
                    "{} holds {}: {}; choose another folder with --out, or remove this one",
                    folder.display(),
                    if known.study_sha256 == own.study_sha256 {
                        "results of another kind"
                    } else {
                        "another study"
                    },
                    known.difference(&own)
                )))
            }
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                let text = serde_json::to_string_pretty(&own).unwrap_or_default() + "\n";
                write_atomically(&path, text.as_bytes())?;
                Ok(())
            }
            Err(error) => Err(wrong(&path, &error)),
        }
    }

    fn difference(&self, other: &Self) -> &'static str {
        if self.format != other.format || self.jostle != other.jostle {
            "it was computed by another version of jostle"
        } else if self.study != other.study {
            "the study file has changed"
        } else if self.model != other.model {
            "the model has changed"
        } else {
            "a record has changed"
        }
    }
}

/// Whether a folder holds finished parts.
fn has_parts(folder: &Path) -> bool {
    std::fs::read_dir(folder.join("cases")).is_ok_and(|entries| {
        entries
            .flatten()
            .any(|entry| entry.path().extension().is_some_and(|e| e == "parquet"))
    })
}
