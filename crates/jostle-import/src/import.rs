//! From files to a model file.

use std::fmt::Write;
use std::path::Path;

use jostle_io::InputError;

use crate::facts::{Facts, fault};
use crate::given::{self, Arrays, Built, quoted};
use crate::options::{Direction, ImportOptions, Way};
use crate::units::Units;
use crate::{e2k, listing, s2k, space_frame, tables, text, towers, workbook};

/// The program that wrote the files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Program {
    /// ETABS.
    Etabs,
    /// SAP2000.
    Sap2000,
}

/// A file to import.
#[derive(Clone, Copy, Debug)]
pub struct SourceFile<'a> {
    /// Its name; the part before the first extension names the building.
    pub name: &'a str,
    /// Its content.
    pub bytes: &'a [u8],
}

/// Periods of the source, to compare those of the model with.
#[derive(Clone, Debug, PartialEq)]
pub struct BuildingPeriods {
    /// Name of the building.
    pub name: String,
    /// Where the periods come from; empty where there are none.
    pub origin: String,
    /// Periods of the modes of this direction, or of all \[s\].
    pub periods: Vec<f64>,
    /// Whether they are known to be of the direction of the model.
    pub of_direction: bool,
}

/// A model file, and what must be known about it.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The model file.
    pub toml: String,
    /// NumPy archives beside it, by name.
    pub files: Vec<(String, Vec<u8>)>,
    /// What was read.
    pub read: Vec<String>,
    /// Assumptions and what limits the model.
    pub remarks: Vec<String>,
    /// What is not carried over.
    pub left_out: Vec<String>,
    /// One for each building.
    pub periods: Vec<BuildingPeriods>,
}

/// Kinds of files, in the order in which they are read: units and storeys first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Model,
    Log,
    Out,
    Workbook,
}

fn kind(program: Program, file: &SourceFile<'_>) -> Result<Kind, InputError> {
    let extension = Path::new(file.name)
        .extension()
        .map(|extension| extension.to_string_lossy().to_lowercase());
    match (program, extension.as_deref().unwrap_or("")) {
        (_, "xlsx" | "xlsm") => Ok(Kind::Workbook),
        (Program::Etabs, "e2k" | "$et") | (Program::Sap2000, "s2k" | "$2k") => Ok(Kind::Model),
        (_, "out") => Ok(Kind::Out),
        (_, "log") => Ok(Kind::Log),
        (Program::Etabs, "s2k" | "$2k") => Err(fault(
            file.name,
            "",
            "is a model of SAP2000",
            "run jostle import sap2000",
        )),
        (Program::Sap2000, "e2k" | "$et") => Err(fault(
            file.name,
            "",
            "is a model of ETABS",
            "run jostle import etabs",
        )),
        (_, "edb" | "sdb") => Err(fault(
            file.name,
            "",
            "is a binary model",
            "export it as text (.e2k or .s2k) from the program",
        )),
        _ => Err(fault(
            file.name,
            "",
            "is none of the files that are read",
            "give result tables as .xlsx, a text model (.e2k, $et; .s2k, $2k), or .OUT and .LOG of the analysis",
        )),
    }
}

/// The part of a file name that files of one building share.
fn stem(name: &str) -> String {
    let name = Path::new(name)
        .file_name()
        .map(|file_name| file_name.to_string_lossy().into_owned())
        .unwrap_or_default();
    name.split('.').next().unwrap_or("").trim().to_owned()
}

/// Imports files: those of one name, but for their extension, are of one building; a single workbook or model takes all.
///
/// # Errors
/// What a file lacks, with the object concerned and which table or file would help.
pub fn import(
    program: Program,
    files: &[SourceFile<'_>],
    options: &ImportOptions,
) -> Result<Imported, InputError> {
    let mut sorted = Vec::new();
    for file in files {
        sorted.push((kind(program, file)?, file));
    }
    sorted.sort_by_key(|entry| entry.0);
    let mut names: Vec<String> = Vec::new();
    let principal = |kind: Kind| kind == Kind::Model || kind == Kind::Workbook;
    for file in files {
        let stem = stem(file.name);
        if sorted
            .iter()
            .any(|(kind, other)| principal(*kind) && other.name == file.name)
            && !names.contains(&stem)
        {
            names.push(stem);
        }
    }
    let units = match &options.units {
        Some(text) => Some(Units::parse(text).ok_or_else(|| {
            fault(
                "--units",
                "",
                format!("\"{text}\" is not known"),
                "write force and length, such as --units \"kN, m\"",
            )
        })?),
        None => None,
    };
    if names.is_empty() {
        return Err(fault(
            files.first().map_or("", |file| file.name),
            "",
            "is no model by itself",
            "give a workbook of tables or a text model as well",
        ));
    }
    // Tables and text of one building may have different names.
    let tables_of_one = sorted
        .iter()
        .filter(|candidate| candidate.0 == Kind::Workbook)
        .count()
        <= 1
        && sorted
            .iter()
            .filter(|candidate| candidate.0 == Kind::Model)
            .count()
            <= 1;
    if tables_of_one {
        names.truncate(1);
    }
    if names.len() > 1 && options.gap.is_none() {
        return Err(fault(
            &names.join(", "),
            "",
            "are several buildings",
            "add --gap \"50 mm\", the width between neighbours; files of one building have one name, such as A.xlsx, A.e2k and A.OUT",
        ));
    }
    let mut imported = Imported {
        toml: String::new(),
        files: Vec::new(),
        read: Vec::new(),
        remarks: Vec::new(),
        left_out: Vec::new(),
        periods: Vec::new(),
    };
    let mut blocks = String::new();
    let mut spaces = Vec::new();
    for name in &names {
        let group: Vec<_> = sorted
            .iter()
            .filter(|(_, file)| names.len() == 1 || stem(file.name) == *name)
            .collect();
        let mut facts = Facts {
            name: name.clone(),
            sap2000: program == Program::Sap2000,
            ..Facts::default()
        };
        for (kind, file) in group {
            gather(program, *kind, file, units, options, &mut facts)?;
        }
        towers::choose(&mut facts, options.diaphragm.as_deref())?;
        facts.complete_stories();
        facts.check_order()?;
        refine_periods(&mut facts);
        let built = build(&mut facts, options)?;
        add(
            &mut imported,
            &mut blocks,
            &facts,
            built,
            options,
            &mut spaces,
        )?;
    }
    if let Some((_, file)) = sorted
        .iter()
        .find(|(_, file)| names.len() > 1 && !names.contains(&stem(file.name)))
    {
        return Err(fault(
            file.name,
            "",
            "belongs to none of the buildings",
            format!("give it the name of one of them: {}", names.join(", ")),
        ));
    }
    if spaces.windows(2).any(|pair| pair[0] != pair[1]) {
        return Err(fault(
            &names.join(", "),
            "",
            "one building is modelled in space and one in plane",
            "add --direction x or --direction y for both",
        ));
    }
    if names.len() > 1 && spaces.contains(&true) {
        imported.remarks.push("buildings stand side by side along X in the order of the files; coordinates of the sources do not place them: write at in [[building]] where they stand otherwise".into());
    }
    imported.toml = model_text(program, &imported, &names, &blocks, options.gap);
    Ok(imported)
}

/// Adds what a file says.
fn gather(
    program: Program,
    kind: Kind,
    file: &SourceFile<'_>,
    units: Option<Units>,
    options: &ImportOptions,
    facts: &mut Facts,
) -> Result<(), InputError> {
    facts.files.push(file.name.to_owned());
    match kind {
        Kind::Workbook => {
            let found = workbook::read(file.bytes).map_err(|problem| {
                fault(
                    file.name,
                    "",
                    problem,
                    "give the .xlsx that ETABS writes (File, Export, Tables to Excel)",
                )
            })?;
            for table in &found {
                if !tables::gather(file.name, table, units, options.diaphragm.as_deref(), facts)? {
                    facts
                        .left_out
                        .push(format!("{}: table {}", file.name, table.name));
                }
            }
        }
        Kind::Model => {
            let text = text::decode(file.bytes);
            let stated = match program {
                Program::Etabs => e2k::read(file.name, &text, facts)?,
                Program::Sap2000 => s2k::read(file.name, &text, facts)?,
            };
            facts.units = Some(stated);
        }
        Kind::Log => {
            let text = text::decode(file.bytes);
            facts.units = listing::units(&text).or(facts.units);
            listing::read_log(file.name, &text, facts);
        }
        // Those of the analysis, which need not be those of tables.
        Kind::Out => listing::read_out(
            file.name,
            &text::decode(file.bytes),
            units.or(facts.units),
            facts,
        )?,
    }
    Ok(())
}

/// Puts the digits of the `.LOG` into the periods of tables, if both are of one analysis.
fn refine_periods(facts: &mut Facts) {
    let near = |period: &crate::facts::ModePeriod, solver: f64| {
        (period.period / solver - 1.0).abs() < 0.01
    };
    let solver = facts.solver_periods.clone();
    let other = facts.periods.iter().find(|period| {
        solver
            .get(&period.mode)
            .is_some_and(|solver| !near(period, *solver))
    });
    match other {
        Some(period) => facts.left_out.push(format!("the .LOG file: its period of mode {} is not that of the tables, so it is of another analysis", period.mode)),
        None => {
            for period in &mut facts.periods {
                period.period = solver.get(&period.mode).copied().unwrap_or(period.period);
            }
        }
    }
}

/// By tables where they have stiffness, else by the members of the text model: a space frame where it is one.
fn build(facts: &mut Facts, options: &ImportOptions) -> Result<Built, InputError> {
    let has_tables = !(facts.displacements.is_empty() && facts.stiffness.is_empty());
    let by_text = match options.way {
        None => !has_tables,
        Some(way) => matches!(way, Way::Frame | Way::Members),
    };
    let Some(model) = facts.text.clone().filter(|_| by_text) else {
        return match by_text && options.way.is_some() {
            true => Err(facts.fault(
                "--by frame and --by members",
                "there is no text model",
                "name the .e2k, $et, .s2k or $2k file of the building as well",
            )),
            false => given::build(facts, options),
        };
    };
    let axis = match options.direction {
        Some(Direction::X) => Some(0),
        Some(Direction::Y) => Some(1),
        Some(Direction::Both) | None => None,
    };
    match (options.way, axis) {
        (Some(Way::Frame), Some(_)) => Err(facts.fault(
            "--direction",
            "is for matrices; the space frame of a text model moves both ways",
            "leave it out, or take --by members",
        )),
        (Some(Way::Frame), None) => space_frame::build(facts, &model),
        (Some(Way::Members), _) | (_, Some(_)) => given::assembled(facts, &model, axis),
        (_, None) => {
            let before = facts.left_out.len();
            let irregular = match space_frame::build(facts, &model) {
                Ok(built) => return Ok(built),
                Err(error) => error,
            };
            facts.left_out.truncate(before);
            let mut built = given::assembled(facts, &model, None)?;
            for fault in &irregular.faults {
                built.remarks.insert(
                    0,
                    format!(
                        "taken as elastic matrices, not as a space frame, which could yield: {} {}",
                        fault.path, fault.problem
                    ),
                );
            }
            Ok(built)
        }
    }
}

/// Adds a building to the model.
fn add(
    imported: &mut Imported,
    blocks: &mut String,
    facts: &Facts,
    mut built: Built,
    options: &ImportOptions,
    spaces: &mut Vec<bool>,
) -> Result<(), InputError> {
    spaces.push(built.in_space);
    let axis = built.axis;
    if let Some(arrays) = built.arrays.take() {
        let plain = |c: char| {
            if c.is_alphanumeric() || "-_".contains(c) {
                c
            } else {
                '_'
            }
        };
        let file = format!(
            "{}-{}.npz",
            options.stem,
            facts.name.chars().map(plain).collect::<String>()
        );
        built.block = built.block.replace("\"FILE\"", &quoted(&file));
        let bytes = archive(arrays).map_err(|error| {
            fault(
                &file,
                "",
                error.to_string(),
                "choose another place with --to",
            )
        })?;
        imported.files.push((file, bytes));
    }
    let _ = write!(blocks, "\n{}", built.block);
    imported.read.extend(facts.read.iter().cloned());
    let named = |text: &String| format!("{}: {text}", facts.name);
    imported.remarks.extend(built.remarks.iter().map(named));
    imported.left_out.extend(facts.left_out.iter().cloned());
    // Modes with most of their mass in this direction, where mass ratios say so.
    let of_direction =
        !built.in_space && facts.periods.iter().any(|period| period.shares.is_some());
    let periods = facts.periods.iter().filter(|period| {
        let shares = period.shares.unwrap_or_default();
        period.period > 0.0
            && (!of_direction || (shares[axis] > shares[1 - axis] && shares[axis] >= 0.01))
    });
    imported.periods.push(BuildingPeriods {
        name: facts.name.clone(),
        origin: facts.periods_from.clone(),
        periods: periods.map(|period| period.period).collect(),
        of_direction: of_direction || built.in_space,
    });
    if facts.periods.is_empty() {
        imported.remarks.push(format!("{}: no periods to compare with: export Modal Participating Mass Ratios, or name the .LOG file of the analysis", facts.name));
    }
    Ok(())
}

/// An archive that `jostle` may replace, as those of `jostle export`.
fn archive(arrays: Arrays) -> std::io::Result<Vec<u8>> {
    let mut all: Vec<(&str, &[usize], Vec<f64>)> = arrays
        .iter()
        .map(|(name, sizes, values)| (*name, &sizes[..], values.clone()))
        .collect();
    all.push(("written_by_jostle", &[1], vec![1.0]));
    jostle_io::numpy_archive(&all)
}

/// The whole model file.
fn model_text(
    program: Program,
    imported: &Imported,
    names: &[String],
    blocks: &str,
    gap: Option<f64>,
) -> String {
    let program = match program {
        Program::Etabs => "ETABS",
        Program::Sap2000 => "SAP2000",
    };
    let mut text = format!("# Written by jostle import from {program}.\n");
    let mut list = |title: &str, lines: &[String]| {
        if lines.is_empty() {
            return;
        }
        let _ = writeln!(text, "#\n# {title}");
        for line in lines {
            let line: String = line.chars().filter(|c| !c.is_control()).collect();
            let _ = writeln!(text, "# - {line}");
        }
    };
    list("Read:", &imported.read);
    list("Assumptions:", &imported.remarks);
    list("Not imported:", &imported.left_out);
    let _ = write!(
        text,
        "title = {}\n\n[motion]                          # replace by your own\nrecord = \"el-centro-1940-ns\"\npga = \"0.2 g\"\n{blocks}",
        quoted(&names.join(" and "))
    );
    for pair in names.windows(2) {
        let _ = write!(
            text,
            "\n[[gap]]\nbetween = [{}, {}]\nwidth = \"{} mm\"\n# stiffness = \"2e9 N/m^1.5\"     # of the contact: the default, at the low end of what is known; see jostle contact-advice\n",
            quoted(&pair[0]),
            quoted(&pair[1]),
            given::digits(gap.unwrap_or(0.0) * 1e3)
        );
    }
    text
}
