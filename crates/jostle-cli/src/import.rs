//! `jostle import`: model files from the files of other programs.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use jostle::results::summary::Grade;
use jostle_import::{
    BuildingPeriods, Direction, ImportOptions, Imported, Program, SourceFile, Way,
};
use jostle_io::{Dimension, Overrides, parse_quantity, read_file};
use jostle_run::{BOLD, FileKind, LOUD, finding_with_remedy, list_modes, may_write, open, styled};

use crate::failure::Failure;
use crate::import_opensees::{self, ImportOpenseesArgs};
use crate::terminal;

/// Largest file that is read \[bytes\].
const MOST_BYTES: usize = 64 << 20;
/// Periods compared.
const MODES: usize = 6;

/// First line of every model.
const MODEL: FileKind = FileKind {
    name: "model that jostle imported",
    marks: &["# Written by jostle import from "],
};
const ARCHIVE: FileKind = FileKind {
    name: "archive of matrices that jostle wrote",
    marks: &["written_by_jostle.npy"],
};

/// Programs that models can be imported from.
#[derive(Debug, clap::Subcommand)]
pub(crate) enum ImportCommand {
    /// Result tables (.xlsx), text models (.e2k, $et), and .OUT and .LOG files of ETABS
    Etabs(TableArgs),
    /// Text models (.s2k, $2k), and .OUT and .LOG files of SAP2000
    Sap2000(TableArgs),
    /// Run an OpenSeesPy script and write its building as matrices; requires Python with jostle and openseespy
    Opensees(ImportOpenseesArgs),
}

/// Files and what they do not say.
#[derive(Debug, clap::Args)]
pub(crate) struct TableArgs {
    /// Files of one or several buildings; with several, files of one building must have the same name, such as A.xlsx and A.OUT
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Model file to write
    #[arg(long, value_name = "MODEL")]
    to: PathBuf,
    /// Plane model along x or y, or model in space [default: in space if the files have enough data]
    #[arg(long, value_enum)]
    direction: Option<DirectionName>,
    /// Stiffness from displacements under unit loads, from modes, from storey stiffnesses, or from a text model: its columns and
    /// beams as a space frame, or all its members as matrices [default: the first that there is]
    #[arg(long, value_enum, value_name = "WAY")]
    by: Option<WayName>,
    /// Width of the gaps between neighbours
    #[arg(long, value_name = "QUANTITY")]
    gap: Option<String>,
    /// Load case of Story Stiffness, or modal case
    #[arg(long, value_name = "NAME")]
    case: Option<String>,
    /// Diaphragm of this building, if storeys have several
    #[arg(long, value_name = "NAME")]
    diaphragm: Option<String>,
    /// Force of load cases named "FX STORY" and "FY STORY"
    #[arg(long, value_name = "QUANTITY")]
    unit_force: Option<String>,
    /// Moment of load cases named "MZ STORY"
    #[arg(long, value_name = "QUANTITY")]
    unit_moment: Option<String>,
    /// Units of tables that have no row of units, such as "kN, m"
    #[arg(long, value_name = "UNITS")]
    units: Option<String>,
    /// Replace files even if jostle did not write them
    #[arg(long)]
    force: bool,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum DirectionName {
    X,
    Y,
    Both,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum WayName {
    Flexibility,
    Modes,
    Stiffness,
    Frame,
    Members,
}

pub(crate) fn import(command: &ImportCommand) -> Result<(), Failure> {
    match command {
        ImportCommand::Etabs(args) => terminal::print(&tables(Program::Etabs, args)?),
        ImportCommand::Sap2000(args) => terminal::print(&tables(Program::Sap2000, args)?),
        ImportCommand::Opensees(args) => import_opensees::import(args),
    }
}

/// Imports the files of tables and text models; returns what is printed.
pub(crate) fn imported(command: &ImportCommand) -> Result<String, Failure> {
    match command {
        ImportCommand::Etabs(args) => tables(Program::Etabs, args),
        ImportCommand::Sap2000(args) => tables(Program::Sap2000, args),
        ImportCommand::Opensees(_) => Err(Failure::Input(
            "Python imports OpenSees by itself".to_owned(),
        )),
    }
}

fn tables(program: Program, args: &TableArgs) -> Result<String, Failure> {
    let options = args.options()?;
    let mut contents = Vec::new();
    for path in &args.files {
        let bytes = read_file(path, MOST_BYTES)
            .map_err(|error| Failure::Input(format!("{} {error}", path.display())))?;
        contents.push((path.display().to_string(), bytes));
    }
    let files: Vec<SourceFile<'_>> = contents
        .iter()
        .map(|(name, bytes)| SourceFile { name, bytes })
        .collect();
    let imported = jostle_import::import(program, &files, &options)?;
    write(args, &imported)
}

impl TableArgs {
    fn options(&self) -> Result<ImportOptions, Failure> {
        let quantity = |text: &Option<String>, key: &str, dimension: Dimension| match text {
            None => Ok(None),
            Some(text) => match parse_quantity(text, dimension) {
                Ok(value) if value > 0.0 => Ok(Some(value)),
                Ok(_) => Err(Failure::Input(format!("{key}: must be greater than zero"))),
                Err(error) => Err(Failure::Input(format!("{key}: {error}"))),
            },
        };
        let stem = self.to.file_stem();
        Ok(ImportOptions {
            direction: self.direction.map(|name| match name {
                DirectionName::X => Direction::X,
                DirectionName::Y => Direction::Y,
                DirectionName::Both => Direction::Both,
            }),
            way: self.by.map(|name| match name {
                WayName::Flexibility => Way::Flexibility,
                WayName::Modes => Way::Modes,
                WayName::Stiffness => Way::Stiffness,
                WayName::Frame => Way::Frame,
                WayName::Members => Way::Members,
            }),
            case: self.case.clone(),
            diaphragm: self.diaphragm.clone(),
            unit_force: quantity(&self.unit_force, "--unit-force", Dimension::Force)?,
            unit_moment: quantity(&self.unit_moment, "--unit-moment", Dimension::Moment)?,
            units: self.units.clone(),
            gap: quantity(&self.gap, "--gap", Dimension::Length)?,
            stem: stem.map_or_else(String::new, |stem| stem.to_string_lossy().into_owned()),
        })
    }
}

/// Writes the model and says what was read, what was left out, and periods beside those of the source.
fn write(args: &TableArgs, imported: &Imported) -> Result<String, Failure> {
    let beside = |name: &str| args.to.with_file_name(name);
    may_write(&args.to, Some(MODEL), args.force)?;
    if !args.force && is_edited(&args.to) {
        return Err(Failure::Input(format!(
            "{}: was edited since it was imported\n  help: name another file with --to, or add --force to lose what was edited",
            args.to.display()
        )));
    }
    for (name, _) in &imported.files {
        may_write(&beside(name), Some(ARCHIVE), args.force)?;
    }
    for (name, bytes) in &imported.files {
        jostle_io::write_atomically(&beside(name), bytes)?;
    }
    jostle_io::write_atomically(&args.to, marked(&imported.toml).as_bytes())?;
    let mut text = String::new();
    for (title, lines) in [
        ("Read", &imported.read),
        ("Assumptions", &imported.remarks),
        ("Not imported", &imported.left_out),
    ] {
        if lines.is_empty() {
            continue;
        }
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", styled(BOLD, title));
        for line in lines {
            let _ = writeln!(text, "  {line}");
        }
        text.push('\n');
    }
    let opened = open(Some(&args.to), &Overrides::default(), false).map_err(|error| {
        Failure::Input(format!(
            "{error}\n{} was written, but is no sound model yet: correct it, or the tables",
            args.to.display()
        ))
    })?;
    for (building, modes) in &list_modes(&opened.system, MODES)? {
        let source = imported
            .periods
            .iter()
            .find(|period| period.name == building.name);
        let periods: Vec<f64> = modes.iter().map(|mode| mode.period()).collect();
        compare(&mut text, &building.name, &periods, source);
    }
    // What is unusual is often a unit.
    let findings = opened.findings(None);
    let unusual = findings
        .iter()
        .filter(|finding| finding.grade >= Grade::Note);
    for finding in unusual {
        let _ = writeln!(text, "{}", finding_with_remedy(finding));
    }
    let shown = args.to.display();
    let _ = writeln!(text, "{shown} is ready. Next:\n  jostle check {shown}");
    Ok(text)
}

/// Between the first line of an imported model and the number of its content.
const CONTENT: &str = " Content ";

/// A model whose first line has the number of the rest, by which later edits are seen.
fn marked(model: &str) -> String {
    match model.split_once('\n') {
        Some((first, rest)) => format!("{first}{CONTENT}{:016x}.\n{rest}", fingerprint(rest)),
        None => model.to_owned(),
    }
}

/// Whether an imported model is no longer what was written; files without a number are not known to be.
fn is_edited(path: &Path) -> bool {
    let Ok(text) = jostle_io::read_text_file(path, MOST_BYTES) else {
        return false;
    };
    let number = text.split_once('\n').and_then(|(first, rest)| {
        let (_, number) = first.trim_end_matches(['.', '\r']).rsplit_once(CONTENT)?;
        Some((u64::from_str_radix(number, 16).ok()?, rest))
    });
    number.is_some_and(|(number, rest)| fingerprint(rest) != number)
}

/// 64 bits of a text (Fowler, Noll and Vo's FNV-1a), the same on every computer.
fn fingerprint(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// Periods of the model beside those of the source: of one direction one by one, else the nearest.
fn compare(text: &mut String, name: &str, periods: &[f64], source: Option<&BuildingPeriods>) {
    let _ = writeln!(text, "{}", styled(BOLD, name));
    let Some(source) = source.filter(|source| !source.periods.is_empty()) else {
        for (index, period) in periods.iter().enumerate() {
            let _ = writeln!(text, "  T{} {period:.4} s", index + 1);
        }
        text.push('\n');
        return;
    };
    let which = match source.of_direction {
        true => "",
        false => ", the nearest of all directions",
    };
    let _ = writeln!(
        text,
        "  mode   this model   source ({}{which})",
        source.origin
    );
    let mut most = 0.0_f64;
    for (index, period) in periods.iter().enumerate() {
        let distance = |other: &&f64| (*other / period).ln().abs();
        let other = match source.of_direction {
            true => source.periods.get(index),
            false => source
                .periods
                .iter()
                .min_by(|a, b| distance(a).total_cmp(&distance(b))),
        };
        let Some(other) = other else { break };
        let difference = period / other - 1.0;
        if index == 0 {
            most = difference;
        }
        let _ = writeln!(
            text,
            "  {:>4}   {period:8.4} s   {other:8.4} s  {:+7.2} %",
            index + 1,
            difference * 100.0
        );
    }
    if most.abs() > 0.05 {
        let _ = writeln!(
            text,
            "  {} the first period differs by {:+.1} %: see \"Assumptions\" and \"Not imported\"",
            styled(LOUD, "warning:"),
            most * 100.0
        );
    }
    text.push('\n');
}
