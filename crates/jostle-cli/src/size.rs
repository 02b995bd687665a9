//! `jostle size`: the least of something that keeps conditions.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use jostle_io::shown::follow;
use jostle_io::{Dimension, ModelTree, parse_option};
use jostle_study::size::{Over, SizeProblem, SizeProgress, SizeRequest, earlier_size_files};

use crate::failure::Failure;
use crate::progress::Bar;
use crate::stop::stop_on_interrupt;
use crate::terminal;

#[derive(Debug, clap::Args)]
#[command(
    after_help = "Keys and results are named as in `jostle study`. link, gap, contact, building and floor mean the greatest value\n\
                  of their kind: floor.displacement_max_m. A list key without an index means all of its entries.\n\n  \
                  jostle size mine.toml --vary \"link.damping=10 kN.s/m..10 MN.s/m\" --keep \"impact_count == 0\" --minimise link.force_peak_n\n  \
                  jostle size mine.toml --vary \"gap.width=5 mm..300 mm\" --keep \"impact_count == 0\" --minimise gap.width"
)]
pub(crate) struct SizeArgs {
    /// Model file (TOML or JSON), or the name of a built-in example
    model: PathBuf,
    /// Vary this key between bounds, NAME=LOW..HIGH; without bounds, between a tenth and ten times the value of the model;
    /// several separated by commas, or repeat
    #[arg(long, value_name = "KEY", value_delimiter = ',', required = true)]
    vary: Vec<String>,
    /// Condition to meet, such as "impact_count == 0" or "floor.displacement_max_m <= 50 mm"; repeat for several
    #[arg(long, value_name = "CONDITION")]
    keep: Vec<String>,
    /// Quantity to minimise: a key, a result, or a sum such as "2 * link.force_peak_n + gap.peak_force_n"
    #[arg(long, value_name = "EXPRESSION", alias = "minimize")]
    minimise: String,
    /// Use these ground motions: a built-in name or a file; repeat for a set [default: those of the model]
    #[arg(long, value_name = "RECORD")]
    record: Vec<String>,
    /// Scale the motions to this peak ground acceleration
    #[arg(long, value_name = "QUANTITY")]
    pga: Option<String>,
    /// Run every motion with both signs: each counts as two records
    #[arg(long)]
    both_signs: bool,
    /// With several records, use the worst or the mean
    #[arg(long, value_name = "RULE", default_value = "worst", value_parser = Over::NAMES)]
    over: String,
    /// Seed of the search
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Maximum number of trials
    #[arg(long, value_name = "N", default_value_t = 600)]
    trials: usize,
    /// Relative convergence tolerance of the objective
    #[arg(long, value_name = "NUMBER", default_value_t = 1e-4)]
    tolerance: f64,
    /// Number of runs at the same time [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    jobs: Option<u32>,
    /// Folder for the results [default: jostle-out/MODEL-size; with --json, none]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print size.json and nothing else
    #[arg(long)]
    json: bool,
    /// Replace files in the results folder that jostle did not write
    #[arg(long)]
    force: bool,
}

pub(crate) fn size(args: &SizeArgs) -> Result<(), Failure> {
    if let Some(pga) = &args.pga {
        parse_option("--pga", pga, Dimension::Acceleration).map_err(Failure::Input)?;
    }
    let tree = ModelTree::find(&args.model)?;
    follow(tree.units());
    let request = SizeRequest {
        vary: args.vary.clone(),
        keep: args.keep.clone(),
        minimise: args.minimise.clone(),
        records: args.record.clone(),
        pga: args.pga.clone(),
        both_signs: args.both_signs,
        over: Over::from_name(&args.over).unwrap_or(Over::Worst),
        seed: args.seed,
        trials: args.trials,
        tolerance: args.tolerance,
    };
    let problem = SizeProblem::new(tree, &request)?;
    terminal::warn_all(problem.warnings());
    let out = folder(args);
    if let Some(out) = &out {
        let earlier = earlier_size_files(out, args.force)?;
        if !earlier.is_empty() {
            terminal::remark(&format!(
                "{} holds an earlier search, which goes on if it is the same: {}",
                out.display(),
                earlier.join(", ")
            ));
        }
    }
    let stop = stop_on_interrupt();
    let bar = Arc::new(Bar::new(""));
    let (shown, trials) = (Arc::clone(&bar), args.trials);
    let progress = Box::new(move |progress: SizeProgress| {
        shown.show(progress.trials as f64 / trials as f64, || {
            let best = match progress.best {
                Some(best) => format!("least {best:.5e}"),
                None => "none keeps the conditions".to_owned(),
            };
            format!(
                "{} of {trials} trials, generation {}, {best}",
                progress.trials, progress.generation
            )
        });
    });
    let done = problem.run(
        out.as_deref(),
        args.jobs.map(|jobs| jobs as usize),
        &stop,
        progress,
    );
    bar.finish();
    let results = done?;
    if args.json {
        terminal::print(&format!("{:#}", results.json()))?;
    } else {
        if results.earlier > 0 {
            let be = if results.earlier == 1 { "was" } else { "were" };
            let trials = jostle_run::counted(results.earlier, "trial");
            terminal::remark(&format!("{trials} {be} finished already"));
        }
        let page = out.as_deref().map(|out| out.join("size.html"));
        terminal::print(&results.describe(page.as_deref()))?;
    }
    if results.stopped {
        terminal::remark(match out {
            Some(_) => "stopped; the same command continues from here",
            None => "stopped",
        });
        return Err(Failure::Stopped);
    }
    if results.best.is_none() {
        return Err(Failure::Analysis("no trial keeps the conditions".into()));
    }
    Ok(())
}

/// The folder for results, if any are to be written.
fn folder(args: &SizeArgs) -> Option<PathBuf> {
    let name = args.model.file_stem().map_or_else(
        || "model".to_owned(),
        |stem| stem.to_string_lossy().into_owned(),
    );
    let default = || (!args.json).then(|| Path::new("jostle-out").join(format!("{name}-size")));
    args.out.clone().or_else(default)
}
