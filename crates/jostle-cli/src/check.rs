//! `jostle check`: checks a model and prints masses, periods, contacts and the expected work.

use std::path::Path;

use jostle_run::{Check, FileKind, Opened};

use crate::args::CheckArgs;
use crate::failure::Failure;
use crate::replace::Target;
use crate::terminal;

/// Folder of results by default, and the name of the drawing of the site in it.
const RESULTS: &str = "jostle-out";
const SITE: &str = "site.svg";

pub(crate) fn check(args: &CheckArgs) -> Result<(), Failure> {
    let opened = args.model.open()?;
    let target = site_file(args, &opened)?;
    let Check { text, site, .. } = jostle_run::check(&opened)?;
    terminal::print(&text)?;
    if let (Some(target), Some(drawing)) = (target, site) {
        target.write(&drawing)?;
        terminal::print(&format!("→ {}", target.path.display()))?;
    }
    Ok(())
}

/// Where the site is drawn: of models with plans, and only if a folder is named or the usual one may be written.
fn site_file(args: &CheckArgs, opened: &Opened) -> Result<Option<Target>, Failure> {
    if !opened.system.is_in_space() {
        return match &args.out {
            Some(_) => Err(Failure::Input(
                "--out: only models with plans have a drawing of the site".into(),
            )),
            None => Ok(None),
        };
    }
    let usual = || Path::new(RESULTS).join(&opened.name);
    let folder = args.out.clone().unwrap_or_else(usual);
    if let Err(error) = std::fs::create_dir_all(&folder) {
        return match &args.out {
            Some(_) => Err(Failure::Input(format!(
                "--out: cannot make the folder {}: {error}",
                folder.display()
            ))),
            // Nobody asked for a file.
            None => Ok(None),
        };
    }
    Target::new(&folder.join(SITE), FileKind::SITE, args.force).map(Some)
}
