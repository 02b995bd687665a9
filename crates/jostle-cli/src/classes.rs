//! `jostle classes`: fragility of classes of buildings, with and without pounding.

use std::path::PathBuf;
use std::sync::atomic::Ordering;
use std::time::Instant;

use jostle_io::ClassesFile;
use jostle_run::{FolderClaim, may_write, name_of};
use jostle_study::classes::{ClassesError, FILES, run_classes, write_classes};

use crate::failure::Failure;
use crate::progress::Bar;
use crate::stop::stop_on_interrupt;
use crate::terminal;

/// Arguments of `jostle classes`.
#[derive(Debug, clap::Args)]
pub(crate) struct ClassesArgs {
    /// Classes file: classes, neighbours, gaps, motions; see how-to/classes in the documentation
    pub(crate) file: PathBuf,
    /// Folder for the results [default: the name of the file]
    #[arg(long, value_name = "FOLDER")]
    pub(crate) out: Option<PathBuf>,
    /// Number of threads [default: one per core]; results do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1024))]
    pub(crate) jobs: Option<u64>,
    /// Check the file and report errors; run nothing
    #[arg(long)]
    pub(crate) check: bool,
    /// Replace files that jostle did not write
    #[arg(long)]
    pub(crate) force: bool,
}

impl From<ClassesError> for Failure {
    fn from(error: ClassesError) -> Self {
        match error {
            ClassesError::Input(error) => error.into(),
            ClassesError::Analysis(text) => Self::Analysis(text),
        }
    }
}

pub(crate) fn classes(args: &ClassesArgs) -> Result<(), Failure> {
    let file = ClassesFile::load(&args.file)?;
    if args.check {
        terminal::warn_all(&file.warnings);
        let count = jostle_study::classes::count_rows(&file)?;
        return terminal::print(&format!(
            "The file is correct: {count} rows without contact, and as many for every gap that closes."
        ));
    }
    let out = args
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from(name_of(&args.file)));
    std::fs::create_dir_all(&out).map_err(|error| {
        Failure::Input(format!("cannot make the folder {}: {error}", out.display()))
    })?;
    for (name, kind) in FILES {
        may_write(&out.join(name), Some(kind), args.force)?;
    }
    let claim = FolderClaim::new(&out)?;
    let flag = stop_on_interrupt();
    let stop = || flag.load(Ordering::Relaxed);
    let bar = Bar::new("");
    let show = |finished: usize, pairs: usize| bar.show_count(finished, pairs, "pairs");
    let started = Instant::now();
    let jobs = args.jobs.map(|jobs| jobs as usize);
    let results = run_classes(&file, jobs, &stop, &show);
    bar.finish();
    let Some(results) = results? else {
        terminal::remark("stopped: nothing was written");
        return Err(Failure::Stopped);
    };
    terminal::warn_all(&results.warnings);
    let left_out = write_classes(&out, &file, &results)?;
    drop(claim);
    for left_out in left_out {
        terminal::remark(&format!("not in fragility.xml and pelicun.csv: {left_out}"));
    }
    let mut text = results.text();
    text += &format!(
        "in {:.1} s\nPage: {}",
        started.elapsed().as_secs_f64(),
        out.join("index.html").display()
    );
    terminal::print(&text)
}
