//! `jostle pushover`: capacity curves of the buildings of a model.

use std::path::{Path, PathBuf};

use jostle::pushover::{LoadPattern, PushDirection};
use jostle_io::{Dimension, Overrides, parse_quantity};
use jostle_report::Demand;
use jostle_run::{FileKind, accelerogram, checked_drift, chosen_buildings, pushed_buildings};

use crate::args::{Push, PushoverArgs, Spread};
use crate::failure::Failure;
use crate::open::open_model;
use crate::replace::Target;
use crate::{pushover_text, terminal};

/// Damping ratio of the demand \[–\].
const DAMPING: f64 = 0.05;
/// Default folder of results.
const RESULTS: &str = "jostle-out";

pub(crate) fn pushover(args: &PushoverArgs) -> Result<(), Failure> {
    let drift = drift(&args.drift)?;
    let opened = open_model(args.model.as_deref(), &Overrides::default(), false)?;
    let buildings = chosen_buildings(opened.system.structures(), args.building.as_deref())?;
    let directions: &[PushDirection] = match args.direction {
        Push::Right => &[PushDirection::Right],
        Push::Left => &[PushDirection::Left],
        Push::Both => &[PushDirection::Right, PushDirection::Left],
    };
    let pattern = match args.pattern {
        Spread::FirstMode => LoadPattern::FirstMode,
        Spread::Uniform => LoadPattern::Uniform,
        Spread::Triangular => LoadPattern::Triangular,
    };
    let pushed = pushed_buildings(&buildings, directions, pattern, drift)?;
    let title = &opened.input.model.title;
    let json = jostle_io::pushover_json(title, &pushed);
    let default = || (!args.json).then(|| Path::new(RESULTS).join(&opened.name));
    let out: Option<PathBuf> = args.out.clone().or_else(default);
    if let Some(out) = &out {
        std::fs::create_dir_all(out).map_err(|error| {
            Failure::Input(format!("cannot make the folder {}: {error}", out.display()))
        })?;
        let target = |name: &str, kind| Target::new(&out.join(name), kind, args.force);
        let table = target("pushover.csv", FileKind::PUSHOVER_CURVES)?;
        let numbers = target("pushover.json", FileKind::PUSHOVER_NUMBERS)?;
        let page = target("pushover.html", FileKind::PUSHOVER_PAGE)?;
        table.write(&jostle_io::pushover_csv(&pushed))?;
        numbers.write(&json)?;
        let motion = opened.input.ground_motion().ok();
        let shaken = motion.as_ref().and_then(|motion| accelerogram(motion).ok());
        let demand = motion.as_ref().zip(shaken.as_ref());
        let demand = demand.map(|(motion, shaken)| Demand {
            name: &motion.name,
            motion: shaken,
            damping: DAMPING,
        });
        page.write(&jostle_report::render_pushover(
            title,
            &pushed,
            demand.as_ref(),
            &opened.input.model.buildings,
        ))?;
    }
    if args.json {
        return terminal::print(&json);
    }
    let page = out.map(|out| out.join("pushover.html"));
    terminal::print(&pushover_text::describe(title, &pushed, page.as_deref()))
}

/// The drift to push to.
fn drift(text: &str) -> Result<f64, Failure> {
    let wrong = |problem: String| Failure::Input(format!("--drift: {problem}"));
    let drift =
        parse_quantity(text, Dimension::Dimensionless).map_err(|error| wrong(error.to_string()))?;
    Ok(checked_drift(drift, text)?)
}
