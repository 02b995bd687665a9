//! `jostle pushover`: how far buildings can be pushed sideways.

use std::path::{Path, PathBuf};

use jostle::pushover::{
    LoadPattern, PushDirection, PushSettings, PushedBuilding, Pushover, pushover as push,
};
use jostle::system::BuildingSystem;
use jostle_io::{Dimension, Overrides, parse_quantity};

use clap::ValueEnum as _;
use jostle::System;

use crate::args::{Push, PushoverArgs, Spread};
use crate::failure::Failure;
use crate::open::open;
use crate::replace::{Kind, Target};
use crate::{pushover_text, terminal};

/// Default folder of results.
const RESULTS: &str = "jostle-out";

pub(crate) fn pushover(args: &PushoverArgs) -> Result<(), Failure> {
    let drift = drift(&args.drift)?;
    let opened = open(args.model.as_deref(), &Overrides::default())?;
    let buildings = chosen(&opened.system.buildings, args.building.as_deref())?;
    let pushed = pushed(&buildings, args.direction, args.pattern, drift)?;
    let title = &opened.input.model.title;
    let json = jostle_io::pushover_json(title, &pushed);
    let default = || (!args.json).then(|| Path::new(RESULTS).join(&opened.name));
    let out: Option<PathBuf> = args.out.clone().or_else(default);
    if let Some(out) = &out {
        std::fs::create_dir_all(out).map_err(|error| {
            Failure::Input(format!("cannot make the folder {}: {error}", out.display()))
        })?;
        let target = |name: &str, kind| Target::new(&out.join(name), kind, args.force);
        let table = target("pushover.csv", Kind::PUSHOVER_CURVES)?;
        let numbers = target("pushover.json", Kind::PUSHOVER_NUMBERS)?;
        let page = target("pushover.html", Kind::PUSHOVER_PAGE)?;
        table.write(&jostle_io::pushover_csv(&pushed))?;
        numbers.write(&json)?;
        page.write(&jostle_report::render_pushover(title, &pushed))?;
    }
    if args.json {
        return terminal::print(&json);
    }
    let page = out.map(|out| out.join("pushover.html"));
    terminal::print(&pushover_text::describe(title, &pushed, page.as_deref()))
}

/// Capacity curves of one building or of all, as the JSON of the command.
///
/// # Errors
/// The complaint, which begins with the option.
pub fn pushover_json(
    title: &str,
    system: &System,
    building: Option<&str>,
    pattern: &str,
    direction: &str,
    drift: f64,
) -> Result<String, String> {
    let drift = checked(drift, &drift.to_string()).map_err(|failure| failure.to_string())?;
    let buildings = chosen(&system.buildings, building).map_err(|failure| failure.to_string())?;
    let pattern = Spread::from_str(pattern, false).map_err(|_| {
        format!("--pattern: expected first-mode, uniform or triangular, found \"{pattern}\"")
    })?;
    let direction = Push::from_str(direction, false)
        .map_err(|_| format!("--direction: expected right, left or both, found \"{direction}\""))?;
    let pushed =
        pushed(&buildings, direction, pattern, drift).map_err(|failure| failure.to_string())?;
    Ok(jostle_io::pushover_json(title, &pushed))
}

fn pushed<'a>(
    buildings: &[&'a BuildingSystem],
    direction: Push,
    pattern: Spread,
    drift: f64,
) -> Result<Vec<PushedBuilding<'a>>, Failure> {
    let directions: &[PushDirection] = match direction {
        Push::Right => &[PushDirection::Right],
        Push::Left => &[PushDirection::Left],
        Push::Both => &[PushDirection::Right, PushDirection::Left],
    };
    let pattern = match pattern {
        Spread::FirstMode => LoadPattern::FirstMode,
        Spread::Uniform => LoadPattern::Uniform,
        Spread::Triangular => LoadPattern::Triangular,
    };
    let mut pushed = Vec::new();
    for &building in buildings {
        let curves = directions.iter().map(|&direction| {
            let settings = PushSettings {
                pattern,
                direction,
                drift,
            };
            push(building, settings)
        });
        let curves: Result<Vec<Pushover>, _> = curves.collect();
        pushed.push(PushedBuilding {
            building,
            curves: curves.map_err(|problem| {
                Failure::Analysis(format!("\"{}\": {problem}", building.name))
            })?,
        });
    }
    Ok(pushed)
}

/// The drift to push to.
fn drift(text: &str) -> Result<f64, Failure> {
    let wrong = |problem: String| Failure::Input(format!("--drift: {problem}"));
    let drift =
        parse_quantity(text, Dimension::Dimensionless).map_err(|error| wrong(error.to_string()))?;
    checked(drift, text)
}

fn checked(drift: f64, text: &str) -> Result<f64, Failure> {
    if drift > 0.0 && drift <= 0.5 {
        Ok(drift)
    } else {
        Err(Failure::Input(format!(
            "--drift: must lie above 0 and be at most 0.5 (the roof displacement over the height), found {text}"
        )))
    }
}

/// The building of a name, or all.
fn chosen<'a>(
    buildings: &'a [BuildingSystem],
    name: Option<&str>,
) -> Result<Vec<&'a BuildingSystem>, Failure> {
    let Some(name) = name else {
        return Ok(buildings.iter().collect());
    };
    let found = buildings.iter().find(|building| building.name == name);
    found.map(|building| vec![building]).ok_or_else(|| {
        let names = buildings
            .iter()
            .map(|building| format!("\"{}\"", building.name));
        let names: Vec<String> = names.collect();
        Failure::Input(format!(
            "--building: there is no building \"{name}\" in the model; it has {}",
            names.join(", ")
        ))
    })
}
