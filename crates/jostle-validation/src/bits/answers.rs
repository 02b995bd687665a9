//! What jostle says of a model beside its run: modes, capacity curves, required gaps, scripts for OpenSeesPy.

use std::collections::BTreeMap;

use jostle::pushover::{LoadPattern, PushDirection};
use jostle::system::BuildingSystem;
use jostle_export::{Export, openseespy};
use jostle_io::{Input, pushover_tree};
use jostle_run::{GapSettings, Opened, critical_gaps, list_modes, modes_json, pushed_buildings};
use serde_json::{Value, json};

use super::examples;
use super::families::Case;
use super::in_plane;
use super::pinned::Pinned;

/// Modes of a building.
const MODES: usize = 12;
/// Roof displacement over height to which buildings are pushed.
const DRIFT: f64 = 0.02;
/// Models whose required gaps are searched.
const WITH_GAPS: [&str; 6] = [
    "two_towers",
    "timber_and_masonry",
    "two_asymmetric_towers",
    "isolated_hospital",
    "two_towers_on_soil",
    "law-7",
];

/// An answer on a model; `None` where it is refused.
type Answer = fn(&Input) -> Option<Value>;

/// The models.
pub(super) fn models() -> Vec<Pinned> {
    let examples = examples::models().into_iter();
    let drawn = in_plane::models().into_iter();
    let models = examples
        .chain(examples::compared_models())
        .chain(drawn.filter(|model| WITH_GAPS.contains(&&model.name[..])));
    models.collect()
}

/// The answers on a model.
pub(super) fn cases(model: Pinned) -> Vec<Case> {
    let Pinned { name, input, .. } = model;
    let answers: [(&str, Answer); 4] = [
        ("modes", modes),
        ("pushover", pushover),
        ("gap", gap),
        ("export", export),
    ];
    let wanted = |answer: &str| answer != "gap" || WITH_GAPS.contains(&&name[..]);
    let answers = answers.into_iter().filter(|(answer, _)| wanted(answer));
    let cases = answers.map(|(answer, find)| {
        let input = input.clone();
        Case::new(format!("{name} {answer}"), move || {
            let found = input.as_ref().ok().and_then(find);
            found.unwrap_or_else(|| json!({ "refused": true }))
        })
    });
    cases.collect()
}

fn opened(input: &Input) -> Option<Opened> {
    Opened::new(input.clone(), "pinned").ok()
}

fn modes(input: &Input) -> Option<Value> {
    let opened = opened(input)?;
    let listed = list_modes(&opened.system, MODES).ok()?;
    Some(modes_json(&listed, MODES))
}

fn pushover(input: &Input) -> Option<Value> {
    let opened = opened(input)?;
    let buildings: Vec<&BuildingSystem> = opened.system.structures().iter().collect();
    let directions = [PushDirection::Right, PushDirection::Left];
    let pushed = pushed_buildings(&buildings, &directions, LoadPattern::FirstMode, DRIFT).ok()?;
    let mut tree = pushover_tree("", &pushed);
    tree.as_object_mut()?.remove("jostle");
    Some(tree)
}

fn gap(input: &Input) -> Option<Value> {
    let motion = input.ground_motion().ok()?;
    let settings = GapSettings {
        codes: input.codes.clone(),
        ..GapSettings::default()
    };
    let found = critical_gaps(&input.model, &motion, &settings, &|| false).ok()?;
    serde_json::to_value(found).ok()
}

/// The script, section by section: tables and functions by name, each with its lines.
fn export(input: &Input) -> Option<Value> {
    let opened = opened(input)?;
    let (motion, _) = opened.plan().ok()?;
    let exported = openseespy::export(&Export {
        model: &opened.input.model,
        system: &opened.system,
        motion: &motion,
    });
    let exported = exported.ok()?;
    let version = format!("jostle {}", env!("CARGO_PKG_VERSION"));
    let text = exported.text.replace(&version, "jostle");
    let mut sections: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    let mut section = "head".to_owned();
    for line in text.lines() {
        section = name(line).unwrap_or(section);
        let lines = sections.entry(section.clone()).or_default();
        lines.push(line);
    }
    Some(json!({ "script": sections, "remarks": exported.remarks }))
}

/// Name of the section that a line of a script begins.
fn name(line: &str) -> Option<String> {
    let defined = line.strip_prefix("def ").or(line.strip_prefix("class "));
    let found = match defined {
        Some(rest) => rest.split(['(', ':']).next()?,
        None => {
            let word = line.split_once(" = ")?.0;
            let upper = |c: char| c.is_ascii_uppercase() || c == '_';
            Some(word).filter(|word| word.chars().all(upper))?
        }
    };
    Some(found.to_owned())
}
