//! `jostle import`: buildings of other programs as model files.

use crate::failure::Failure;
use crate::import_opensees::{self, ImportOpenseesArgs};

/// Programs whose models are read.
#[derive(Debug, clap::Subcommand)]
pub(crate) enum ImportCommand {
    /// Run an OpenSeesPy script and write its building by its matrices; needs Python with jostle and openseespy
    Opensees(ImportOpenseesArgs),
}

pub(crate) fn run(command: &ImportCommand) -> Result<(), Failure> {
    match command {
        ImportCommand::Opensees(args) => import_opensees::import(args),
    }
}
