//! `jostle new`: a commented starter file.

use jostle_io::shown::units;

use crate::args::NewArgs;
use crate::failure::Failure;
use crate::terminal;

pub(crate) fn new(args: &NewArgs) -> Result<(), Failure> {
    let mut path = args.name.clone();
    if path.extension().is_none() {
        path.set_extension("toml");
    }
    let title = path
        .file_stem()
        .map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let text = jostle_io::template_in(&args.template, &title, units());
    // The names are checked before; only built-in models have one system of units.
    let text = text.ok_or_else(|| {
        Failure::Input(format!(
            "\"{}\" is a built-in model and stays in SI: leave out --units us, or take another template",
            args.template
        ))
    })?;
    if path.exists() {
        return Err(Failure::Input(format!(
            "{} exists already; choose another name or remove it first",
            path.display()
        )));
    }
    jostle_io::write_atomically(&path, text.as_bytes())?;
    terminal::print(&format!(
        "{} is ready. Edit it, then:\n  jostle check {0}\n  jostle run {0}",
        path.display()
    ))
}
