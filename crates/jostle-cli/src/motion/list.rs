//! `jostle motion list`: built-in motions.

use crate::failure::Failure;
use crate::terminal;
use jostle_run::{BOLD, styled};

pub(super) fn list() -> Result<(), Failure> {
    let motions = jostle_io::builtin_motions();
    let width = motions
        .iter()
        .map(|(name, _)| name.len())
        .max()
        .unwrap_or(0);
    let lines: Vec<String> = motions
        .iter()
        .map(|(name, description)| {
            let gap = " ".repeat(width - name.len());
            format!("{}{gap}  {description}", styled(BOLD, name))
        })
        .collect();
    terminal::print(&lines.join("\n"))
}
