//! `jostle compare`: a model on the recorded motion of a shake table, compared with the measurements.

use std::path::{Path, PathBuf};

use jostle_io::{ComparisonMap, MeasuredTable, Overrides};
use jostle_run::{Measurements, earlier_comparison, prepare_comparison, stopped_by};

use crate::failure::Failure;
use crate::open::open_model;
use crate::progress::StageBar;
use crate::stop::stop_on_interrupt;
use crate::terminal;

#[derive(Debug, clap::Args)]
pub(crate) struct CompareArgs {
    /// Model file (TOML or JSON), or the name of a built-in example
    model: PathBuf,
    /// Measurements in the NEES .asc layout
    data: PathBuf,
    /// File that assigns columns of the data to results
    #[arg(long, value_name = "FILE")]
    map: PathBuf,
    /// Folder for the results [default: jostle-out/MODEL-compare; with --json, none]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Accept values outside their usual ranges, like accept_unusual = true in the model file
    #[arg(long)]
    accept_unusual: bool,
    /// Print compare.json and nothing else
    #[arg(long)]
    json: bool,
    /// Replace files in the results folder that jostle did not write
    #[arg(long)]
    force: bool,
}

pub(crate) fn compare(args: &CompareArgs) -> Result<(), Failure> {
    let opened = open_model(
        Some(&args.model),
        &Overrides::default(),
        args.accept_unusual,
    )?;
    let map = ComparisonMap::load(&args.map)?;
    let shown = args.data.display().to_string();
    let table = MeasuredTable::read(&args.data)
        .map_err(|error| Failure::Input(format!("{shown}{error}")))?;
    let data = Measurements {
        table: &table,
        name: &shown,
        map: &map,
        map_name: &args.map.display().to_string(),
    };
    let prepared = prepare_comparison(&opened, data)?;
    let input = &prepared.prepared().input;
    terminal::warn_of_model(input, &input.warnings);
    let out = folder(args, &opened.name);
    if let Some(out) = &out {
        std::fs::create_dir_all(out).map_err(|error| {
            Failure::Input(format!("cannot make the folder {}: {error}", out.display()))
        })?;
        let earlier = earlier_comparison(out, args.force)?;
        if !earlier.is_empty() {
            terminal::remark(&format!(
                "{} holds an earlier comparison, which is replaced: {}",
                out.display(),
                earlier.join(", ")
            ));
        }
    }
    let stop = stop_on_interrupt();
    let mut bar = StageBar::default();
    let mut observer = stopped_by(&stop, |stage, progress| {
        bar.show(stage, progress.time, progress.duration);
    });
    let compared = prepared.run(&mut observer);
    drop(observer);
    bar.finish();
    let Some(comparison) = compared? else {
        return Err(Failure::Stopped);
    };
    if let Some(out) = &out {
        comparison.write(out)?;
    }
    if args.json {
        return terminal::print(&format!("{:#}", comparison.json()));
    }
    terminal::warn_all(&comparison.summary.warnings);
    let page = out.as_deref().map(|out| out.join("compare.html"));
    terminal::print(&comparison.describe(page.as_deref()))
}

/// The folder for results, if any are to be written.
fn folder(args: &CompareArgs, name: &str) -> Option<PathBuf> {
    let default = || (!args.json).then(|| Path::new("jostle-out").join(format!("{name}-compare")));
    args.out.clone().or_else(default)
}
