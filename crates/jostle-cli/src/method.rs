//! `jostle method`: the accuracy of each solver formulation on the buildings of a model.

use std::fmt::Write;

use jostle_io::Overrides;
use jostle_run::{BOLD, FileKind, methods_text, styled, survey_methods};

use crate::args::MethodArgs;
use crate::failure::Failure;
use crate::open::open_model;
use crate::replace::Target;
use crate::terminal;

pub(crate) fn method(args: &MethodArgs) -> Result<(), Failure> {
    let opened = open_model(args.model.as_deref(), &Overrides::default(), false)?;
    let surveys = survey_methods(&opened.system)?;
    let mut text = methods_text(&surveys);
    if let Some(out) = &args.out {
        std::fs::create_dir_all(out).map_err(|error| {
            Failure::Input(format!("cannot make the folder {}: {error}", out.display()))
        })?;
        let path = out.join("method.html");
        let target = Target::new(&path, FileKind::METHOD, args.force)?;
        let page = jostle_report::render_method(&opened.input.model.title, &surveys);
        target.write(&page)?;
        // Writing to a string cannot fail.
        let _ = writeln!(text, "→ {}", styled(BOLD, &path.display().to_string()));
    }
    terminal::print(&text)
}
