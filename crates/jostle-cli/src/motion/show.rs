//! `jostle motion show`: a motion in numbers, in a small picture, and as a page.

use std::fmt::Write;

use jostle_motion::measures;
use jostle_report::{MotionPage, render_motion};
use jostle_run::{FileKind, NamedMotion, measures_json, motion_text};

use super::args::ShowArgs;
use super::source::wrong;
use crate::failure::Failure;
use crate::replace::Target;
use crate::terminal;

pub(super) fn show(args: &ShowArgs) -> Result<(), Failure> {
    let target = Target::of_option(args.html.as_ref(), FileKind::REPORT, args.force)?;
    let NamedMotion { name, motion } = args.record.open()?;
    let measures = measures(&motion).map_err(wrong)?;
    if let Some(target) = &target {
        let page = MotionPage {
            name: &name,
            motion: &motion,
            measures: &measures,
        };
        let text = render_motion(&page).map_err(wrong)?;
        target.write(&text)?;
    }
    if args.json {
        return terminal::print(&format!("{:#}", measures_json(&name, &measures)));
    }
    let mut text = motion_text(&name, &motion, &measures)?;
    if let Some(path) = &args.html {
        let _ = writeln!(text, "\n  {}", path.display());
    }
    terminal::print(&text)
}
