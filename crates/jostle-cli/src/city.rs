//! `jostle city`: which neighbours of a city collide, from footprints to a map.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

use jostle_city::{
    Answers, Attribute, City, CityError, Columns, EXAMPLE_FILE, Footprints, PairModel, Position,
    ReadOptions, RunOptions, example_city,
};
use jostle_classes::Types;
use jostle_io::shown::LENGTH;
use jostle_io::{CityFile, Dimension, parse_quantity, write_atomically};
use jostle_live::{Engine, address, export_all};
use jostle_run::{BOLD, FolderClaim, counted_grouped, styled};

use crate::failure::Failure;
use crate::live::module;
use crate::progress::Bar;
use crate::stop::stop_on_interrupt;
use crate::study::shard;
use crate::terminal;

/// Steps from footprints to a map.
#[derive(Debug, clap::Subcommand)]
pub(crate) enum CityCommand {
    /// Read footprints and report contents, repairs and adjacent pairs, without writing anything
    Check(CheckArgs),
    /// Write buildings, pairs of neighbours and blocks as tables
    Pairs(PairsArgs),
    /// Sample gaps and buildings, run every row with and without contact, and write the map
    Run(RunArgs),
    /// Write the map and tables again from a run
    Report(FolderArgs),
    /// Print a pair of buildings from a run as a model file
    Model(ModelArgs),
    /// Print the table of structural types: capacity, storeys, damage drifts and hysteresis, with their sources
    Types,
    /// Write an example city: footprints and a city file
    Example(ExampleArgs),
}

#[derive(Debug, clap::Args)]
pub(crate) struct InventoryArgs {
    /// Footprints: GeoJSON, GeoParquet, or CSV with outlines as WKT or GeoJSON
    inventory: PathBuf,
    /// Column for an attribute whose column has another name, such as storeys=FLOORS; attributes are id, footprint, storeys,
    /// height, year and type
    #[arg(long = "column", value_name = "ATTRIBUTE=NAME")]
    columns: Vec<String>,
    /// Coordinates are in metres instead of degrees of longitude and latitude
    #[arg(long)]
    metres: bool,
    /// Buildings at most this far apart on the map are neighbours [default: "0.5 m"]
    #[arg(long, value_name = "QUANTITY")]
    reach: Option<String>,
}

#[derive(Debug, clap::Args)]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    inventory: InventoryArgs,
    /// Your own table of types, as in the city file [default: HAZUS and GEM]
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
}

#[derive(Debug, clap::Args)]
pub(crate) struct PairsArgs {
    #[command(flatten)]
    inventory: InventoryArgs,
    /// Folder for the tables
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

#[derive(Debug, clap::Args)]
pub(crate) struct RunArgs {
    /// City file
    city: PathBuf,
    /// Folder for the results [default: the name of the city file with -city]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Number of random draws of gaps and buildings for every motion, instead of that of the city file
    #[arg(long)]
    draws: Option<usize>,
    /// Relative error of peaks, 0.01 or 0.001, instead of that of the city file
    #[arg(long)]
    tolerance: Option<f64>,
    /// Run one share of the parts, such as 3/8; the last process to finish writes the map
    #[arg(long, value_name = "I/N", value_parser = shard)]
    shard: Option<(u64, u64)>,
    /// Threads [default: all]
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
}

#[derive(Debug, clap::Args)]
pub(crate) struct FolderArgs {
    /// Folder of a run
    folder: PathBuf,
}

#[derive(Debug, clap::Args)]
pub(crate) struct ModelArgs {
    /// Folder of a run
    folder: PathBuf,
    /// Number of the pair, from the list of the map or worst-pairs.csv
    #[arg(long)]
    pair: usize,
    /// Number of the draw, from 0
    #[arg(long, default_value_t = 0)]
    draw: usize,
    /// Number of the motion, from 0
    #[arg(long, default_value_t = 0)]
    motion: usize,
}

#[derive(Debug, clap::Args)]
pub(crate) struct ExampleArgs {
    /// Folder for city.geojson and city.toml
    folder: PathBuf,
    /// Buildings
    #[arg(long, default_value_t = 2000, value_parser = clap::value_parser!(u32).range(1..=2_000_000))]
    buildings: u32,
    /// Random seed
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Replace existing files
    #[arg(long)]
    force: bool,
}

impl From<CityError> for Failure {
    fn from(error: CityError) -> Self {
        match error {
            CityError::Input(text) => Self::Input(text),
            CityError::Stopped => Self::Stopped,
            other => Self::Analysis(other.to_string()),
        }
    }
}

pub(crate) fn city(command: &CityCommand) -> Result<(), Failure> {
    match command {
        CityCommand::Check(args) => {
            let found = args.inventory.read()?;
            found.check_types(&args.inventory.inventory, args.table.as_deref())?;
            terminal::print(&told(&found))
        }
        CityCommand::Pairs(args) => pairs(args),
        CityCommand::Run(args) => run(args),
        CityCommand::Report(args) => report(&args.folder),
        CityCommand::Model(args) => {
            let folder = City::of_folder(&args.folder)?;
            terminal::print(&folder.model(args.pair, args.draw, args.motion)?)
        }
        CityCommand::Types => terminal::print(Types::text()),
        CityCommand::Example(args) => example(args),
    }
}

impl InventoryArgs {
    fn read(&self) -> Result<Footprints, Failure> {
        let mut columns = Columns::default();
        for text in &self.columns {
            let fault = |problem: String| Failure::Input(format!("--column {text}: {problem}"));
            let (attribute, name) = text
                .split_once('=')
                .ok_or_else(|| fault("expected ATTRIBUTE=NAME, such as storeys=FLOORS".into()))?;
            let attribute: Attribute = attribute.trim().parse().map_err(fault)?;
            columns.0.insert(attribute, name.trim().to_owned());
        }
        let reach = match &self.reach {
            None => 0.5,
            Some(text) => match parse_quantity(text, Dimension::Length) {
                Ok(value) if value > 0.0 && value <= 100.0 => value,
                Ok(_) => {
                    return Err(Failure::Input(format!(
                        "--reach {text}: must be greater than 0 and at most 100 m"
                    )));
                }
                Err(problem) => return Err(Failure::Input(format!("--reach: {problem}"))),
            },
        };
        let options = ReadOptions {
            columns,
            metres: self.metres,
        };
        Ok(Footprints::read(&self.inventory, &options, reach)?)
    }
}

/// What footprints hold, for people.
fn told(found: &Footprints) -> String {
    let inventory = &found.inventory;
    let count = inventory.buildings.len();
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "{}: {} of {} rows",
        styled(BOLD, "Buildings"),
        counted(count, "building"),
        inventory.rows
    );
    let named: Vec<String> = inventory
        .columns
        .iter()
        .map(|(attribute, names)| format!("{} from \"{}\"", attribute.name(), names.join("\", \"")))
        .collect();
    let _ = writeln!(text, "  {}", named.join(", "));
    let known = |of: &dyn Fn(&jostle_city::Building) -> bool| {
        100.0
            * inventory
                .buildings
                .iter()
                .filter(|building| of(building))
                .count() as f64
            / count as f64
    };
    let _ = writeln!(
        text,
        "  storeys of {:.0} %, height of {:.0} %, year of {:.0} %, type of {:.0} % are given",
        known(&|inventory| inventory.storeys.is_some()),
        known(&|inventory| inventory.height.is_some()),
        known(&|inventory| inventory.year.is_some()),
        known(&|inventory| inventory.kind.is_some())
    );
    let mut mends: BTreeMap<&str, usize> = BTreeMap::new();
    for mend in &inventory.mends {
        *mends.entry(mend.what).or_default() += 1;
    }
    if !mends.is_empty() {
        let _ = writeln!(text, "{}:", styled(BOLD, "Mends"));
        for (what, count) in mends {
            let first = inventory
                .mends
                .iter()
                .find(|candidate| candidate.what == what);
            let first = first.map_or_else(String::new, |mend| {
                format!(", such as row {}: {}", mend.row, mend.detail)
            });
            let _ = writeln!(text, "  {count} {what}{first}");
        }
    }
    let pairs = &found.neighbours.pairs;
    let blocks = &found.blocks;
    let held = found.with_neighbours();
    let at = |position: Position| {
        pairs
            .iter()
            .filter(|pair| pair.position == position)
            .count()
    };
    let _ = writeln!(
        text,
        "{} within {} m: {}; {:.0} % of the buildings have one",
        styled(BOLD, "Neighbours"),
        found.reach,
        counted(pairs.len(), "pair"),
        100.0 * held as f64 / count as f64
    );
    let largest = blocks
        .iter()
        .map(|block| block.buildings.len())
        .max()
        .unwrap_or(0);
    let _ = writeln!(
        text,
        "  {} inside, {} at an end, {} at a corner; {}, the largest of {largest}",
        at(Position::Inside),
        at(Position::End),
        at(Position::Corner),
        counted(blocks.len(), "block")
    );
    if !found.neighbours.overlaps.is_empty() {
        let _ = writeln!(
            text,
            "  {} share more than a fifth of the smaller outline and count as no neighbours",
            counted(found.neighbours.overlaps.len(), "pair")
        );
    }
    text
}

fn pairs(args: &PairsArgs) -> Result<(), Failure> {
    let found = args.inventory.read()?;
    found.write(&args.out)?;
    let written = format!(
        "{}Written to {}: buildings.parquet, pairs.parquet, blocks.parquet, mended.csv\n",
        told(&found),
        args.out.display()
    );
    terminal::print(&written)
}

fn run(args: &RunArgs) -> Result<(), Failure> {
    let mut file = CityFile::load(&args.city)?;
    if let Some(draws) = args.draws {
        if !(1..=1 << 16).contains(&draws) {
            return Err(Failure::Input(format!(
                "--draws {draws}: must lie between 1 and 65536"
            )));
        }
        file.draws = draws;
    }
    if let Some(tolerance) = args.tolerance {
        if !(1e-3..=1e-1).contains(&tolerance) {
            return Err(Failure::Input(format!(
                "--tolerance {tolerance}: must lie between 0.001 and 0.1"
            )));
        }
        file.tolerance = tolerance;
    }
    terminal::warn_all(&file.warnings);
    if !file.gap_is_given {
        terminal::warn(
            "gap.median is not given: gaps have a median of 25 mm, which nobody has measured; look at the results for half and \
             double of it",
        );
    }
    let out = args.out.clone().unwrap_or_else(|| {
        let stem = args.city.file_stem().unwrap_or_default().to_string_lossy();
        PathBuf::from(format!("{stem}-city"))
    });
    let work = || -> Result<(), Failure> {
        let city = City::new(file)?;
        for line in city.told() {
            terminal::remark(line);
        }
        std::fs::create_dir_all(&out)
            .map_err(|error| Failure::Analysis(format!("{}: {error}", out.display())))?;
        // Shares work beside each other in one folder: their parts differ, and every file is written whole.
        let claim = match args.shard {
            None => Some(FolderClaim::new(&out)?),
            Some(_) => None,
        };
        let flag = stop_on_interrupt();
        let bar = Bar::new("");
        let shard = args.shard.map(|(at, of)| (at as usize + 1, of as usize));
        let done = city.run(
            &out,
            RunOptions { shard },
            &|| flag.load(Ordering::Relaxed),
            &mut |done| bar.show_count(done.cases, done.of, "pairs"),
        );
        bar.finish();
        drop(claim);
        let done = match done {
            Err(CityError::Stopped) => {
                terminal::remark(
                    "stopped: finished parts are kept; the same command continues from here",
                );
                return Err(Failure::Stopped);
            }
            other => other?,
        };
        if done.missing > 0 {
            return terminal::print(&format!(
                "This share is finished; {} of other shares are missing. Whoever finishes last writes the map.\n",
                counted(done.missing, "part")
            ));
        }
        write_report(&city, &out)
    };
    match args.jobs {
        None => work(),
        Some(jobs) => rayon::ThreadPoolBuilder::new()
            .num_threads(usize::from(jobs))
            .build()
            .map_err(|error| Failure::Analysis(error.to_string()))?
            .install(work),
    }
}

fn report(folder: &Path) -> Result<(), Failure> {
    write_report(&City::of_folder(folder)?, folder)
}

fn write_report(city: &City, folder: &Path) -> Result<(), Failure> {
    let mut has_runner = false;
    let (answers, mut files) = city.report(folder, &mut |models| {
        let links = runner(models, folder)?;
        has_runner = !links.is_empty();
        Ok(links)
    })?;
    if has_runner {
        files.insert(1, folder.join(RUNNER));
    }
    let names: Vec<String> = files
        .iter()
        .filter_map(|file| Some(file.file_name()?.to_string_lossy().into_owned()))
        .collect();
    let written = format!("Written to {}: {}\n", folder.display(), names.join(", "));
    terminal::print(&(described(city, &answers) + &written))
}

/// The page in which pairs of the map run.
const RUNNER: &str = "pairs.html";

/// Writes the page in which pairs run, if its engine is beside the program, and gives the address of each of them there.
fn runner(models: &[PairModel], folder: &Path) -> Result<Vec<String>, CityError> {
    let fault = |problem: String| CityError::Analysis(problem);
    let (Ok(module), false) = (module(None), models.is_empty()) else {
        return Ok(Vec::new());
    };
    let engine = |model: &PairModel| {
        let name = format!("pair-{}.toml", model.pair);
        Engine::from_text(&name, &model.text, Path::new(""))
            .map_err(|error| fault(error.to_string()))
    };
    let engines = models.iter().map(engine).collect::<Result<Vec<_>, _>>()?;
    let page = export_all(&engines, &module).map_err(|error| fault(error.to_string()))?;
    let path = folder.join(RUNNER);
    write_atomically(&path, page.as_bytes()).map_err(|error| fault(error.to_string()))?;
    let link = |model: &PairModel| format!("{RUNNER}#{}", address(&model.text));
    Ok(models.iter().map(link).collect())
}

/// What a run found, for people.
fn described(city: &City, answers: &Answers) -> String {
    let means = answers.means();
    let [half, middle, twice] = means.struck.map(|struck| 100.0 * struck);
    let moderate = means.moderate.map(|moderate| 100.0 * moderate);
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "{}: {} of {} with a neighbour, {} draws, {}",
        styled(BOLD, &city.file.title),
        counted(means.buildings, "building"),
        city.inventory.buildings.len(),
        city.file.draws,
        counted(city.motions().len(), "motion"),
    );
    let _ = writeln!(
        text,
        "  struck by a neighbour: {:.1} % of them (median gap {}; with half the median gap {:.1} %, with twice {:.1} %)",
        middle,
        LENGTH.text(city.file.gap_median, 0),
        half,
        twice
    );
    let _ = writeln!(
        text,
        "  a slab strikes columns: {:.1} %",
        100.0 * means.column
    );
    let _ = writeln!(
        text,
        "  moderate damage and worse: {:.1} % alone, {:.1} % with neighbours; contact worsens the state in {:.1} % of the \
         samples and improves it in {:.1} %",
        moderate[0],
        moderate[1],
        100.0 * answers.changed[0],
        100.0 * answers.changed[1]
    );
    if let Some((within, worst)) = answers.sampled.within(city.file.tolerance) {
        let _ = writeln!(
            text,
            "  {} repeated with the standard solvers: {:.1} % of their peaks within {}, largest difference {worst:.1e}",
            counted(answers.sampled.rows, "row"),
            100.0 * within,
            city.file.tolerance
        );
    }
    let _ = writeln!(
        text,
        "  Probabilities hold over all draws, not for one building; gaps and data missing from the inventory are assumed."
    );
    text
}

fn example(args: &ExampleArgs) -> Result<(), Failure> {
    let [map, file] = ["city.geojson", "city.toml"].map(|name| args.folder.join(name));
    for path in [&map, &file] {
        if path.exists() && !args.force {
            return Err(Failure::Input(format!(
                "{} exists; choose another folder, or replace it with --force",
                path.display()
            )));
        }
    }
    std::fs::create_dir_all(&args.folder)
        .map_err(|error| Failure::Analysis(format!("{}: {error}", args.folder.display())))?;
    write_atomically(
        &map,
        example_city(args.buildings as usize, args.seed).as_bytes(),
    )?;
    write_atomically(&file, EXAMPLE_FILE.as_bytes())?;
    terminal::print(&format!(
        "Written: {} and {}\nNext: jostle city run {}\n",
        map.display(),
        file.display(),
        file.display()
    ))
}

/// A count with its noun.
fn counted(count: usize, thing: &str) -> String {
    counted_grouped(count as u64, thing)
}
