//! `jostle man`: one manual page for the program and one for each command.

use std::path::{Path, PathBuf};

use jostle_io::{OutputError, write_atomically};

use crate::failure::Failure;
use crate::terminal;

#[derive(Debug, clap::Args)]
#[command(
    after_help = "Linux, macOS: jostle man ~/.local/share/man/man1, then: man jostle\n\
                  One page: jostle man pages, then: man -l pages/jostle-run.1"
)]
pub(crate) struct ManArgs {
    /// The folder to write to; it is created if it does not exist
    folder: PathBuf,
}

pub(crate) fn man(args: &ManArgs, mut command: clap::Command) -> Result<(), Failure> {
    let unwritable = |error| OutputError::Io {
        path: args.folder.clone(),
        error,
    };
    std::fs::create_dir_all(&args.folder).map_err(unwritable)?;
    // Subcommands learn their full names and common options.
    command.build();
    let written = write_pages(&args.folder, &command)?;
    terminal::remark(&format!(
        "{written} manual pages written to {}",
        args.folder.display()
    ));
    Ok(())
}

/// Writes the page of a command and those of its subcommands; returns their number.
fn write_pages(folder: &Path, command: &clap::Command) -> Result<usize, Failure> {
    let name = command.get_display_name().unwrap_or("jostle").to_owned();
    let page = clap_mangen::Man::new(command.clone())
        .title(name.to_uppercase())
        .source(concat!("jostle ", env!("CARGO_PKG_VERSION")));
    let path = folder.join(format!("{name}.1"));
    let mut text = Vec::new();
    let unwritable = |error| OutputError::Io {
        path: path.clone(),
        error,
    };
    page.render(&mut text).map_err(unwritable)?;
    write_atomically(&path, &text)?;
    let mut written = 1;
    for part in command.get_subcommands() {
        if part.get_name() != "help" && !part.is_hide_set() {
            written += write_pages(folder, part)?;
        }
    }
    Ok(written)
}
