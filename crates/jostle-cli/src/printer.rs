//! `--pdf`: reports printed by a Chromium of this machine.

use std::path::{Path, PathBuf};

use jostle_run::{Paper, find_chromium, print_pdf};

use crate::args::RunArgs;
use crate::failure::Failure;

/// Largest page that is printed \[bytes\].
const LARGEST_PAGE: usize = 1 << 30;

/// A Chromium, and the paper it prints on.
pub(crate) struct Printer {
    chromium: PathBuf,
    paper: Paper,
}

impl Printer {
    /// Looks for a Chromium before anything is run, if a PDF is asked for.
    pub(crate) fn find(args: &RunArgs) -> Result<Option<Self>, Failure> {
        if !args.pdf {
            return Ok(None);
        }
        if args.json && args.out.is_none() {
            return Err(Failure::Input(
                "--pdf: needs a folder with --json; add --out DIR".into(),
            ));
        }
        let chromium =
            find_chromium().map_err(|error| Failure::Input(format!("--pdf: {error}")))?;
        Ok(Some(Self {
            chromium,
            paper: Paper::from_name(&args.paper).unwrap_or_default(),
        }))
    }

    /// Prints a page beside itself, `report.html` to `report.pdf`; a page that does not exist is left out.
    pub(crate) fn print(&self, page: &Path) -> Result<(), Failure> {
        let Ok(text) = jostle_io::read_text_file(page, LARGEST_PAGE) else {
            return Ok(());
        };
        let pdf = page.with_extension("pdf");
        Ok(print_pdf(&self.chromium, &text, &pdf, self.paper)?)
    }
}
