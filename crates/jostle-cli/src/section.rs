//! `jostle section`: from reinforcement to the moments at which a member cracks and yields.

use std::fmt::Write;

use jostle_io::shown::follow;
use jostle_run::{FileKind, SectionOptions, read, sections_json, sections_text};

use crate::args::SectionArgs;
use crate::failure::Failure;
use crate::replace::Target;
use crate::terminal;

pub(crate) fn section(args: &SectionArgs) -> Result<(), Failure> {
    let page = Target::of_option(args.html.as_ref(), FileKind::SECTIONS, args.force)?;
    let (title, surveys) = match &args.model {
        Some(path) => {
            let input = read(path)?;
            follow(input.units);
            let surveys = jostle_run::sections(&input, &path.display().to_string())?;
            (input.model.title, surveys)
        }
        None => (
            "Section".to_owned(),
            vec![jostle_run::section(&args.options())?],
        ),
    };
    if let Some(page) = &page {
        page.write(&jostle_report::render_sections(&title, &surveys))?;
    }
    if args.json {
        return terminal::print(&format!("{:#}", sections_json(&surveys)));
    }
    let mut text = sections_text(&surveys);
    if let Some(path) = &args.html {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "Page: {}", path.display());
    }
    terminal::print(&text)
}

impl SectionArgs {
    fn options(&self) -> SectionOptions {
        SectionOptions {
            width: self.width.clone().unwrap_or_default(),
            depth: self.depth.clone().unwrap_or_default(),
            bars: self.bars.clone().unwrap_or_default(),
            concrete: self.concrete.clone(),
            steel: self.steel.clone(),
            strength: self.strength.clone(),
            cover: self.cover.clone(),
            ties: self.ties.clone(),
            axial_load: self.axial_load.clone(),
            length: self.length.clone(),
        }
    }
}
