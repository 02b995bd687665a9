//! Ground that differs: what `[motion]`, `[building.motion]` and positions say of it.

use jostle::{Model, PlanArea, Structure};
use jostle_motion::Coherency;

use super::motion;
use crate::baseline::Baseline;
use crate::files::Files;
use crate::keys::Section;
use crate::motion_spec::{GroundsSpec, MotionSpec, OwnGroundSpec, OwnMotionSpec};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// Greatest seed, so that every format can write it.
const GREATEST_SEED: u64 = 1 << 53;

/// Keys of `[motion]` about ground that differs, if it has any.
pub(super) fn read_common(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    files: &Files,
) -> Option<Box<GroundsSpec>> {
    let keys = [
        "vertical",
        "apparent_velocity",
        "wave_angle",
        "baseline",
        "coherency",
    ];
    if !keys.into_iter().any(|key| view.has(key)) {
        return None;
    }
    let apparent_velocity = reader
        .get(view, "apparent_velocity")
        .and_then(|field| reader.positive(&field, Dimension::Speed));
    let wave_angle = reader
        .get(view, "wave_angle")
        .and_then(|field| reader.quantity(&field, Dimension::Dimensionless));
    let baseline = reader
        .get(view, "baseline")
        .and_then(|field| reader.choice(&field, &Baseline::NAMES, &[]))
        .and_then(Baseline::from_name);
    let coherency = reader
        .get(view, "coherency")
        .and_then(|field| read_coherency(reader, &field));
    let vertical = reader.get(view, "vertical");
    Some(Box::new(GroundsSpec {
        apparent_velocity,
        wave_angle,
        baseline,
        coherency,
        vertical: vertical.and_then(|field| read_vertical(reader, &field, files)),
        own: Vec::new(),
    }))
}

fn read_coherency(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<Coherency> {
    let view = reader.open(field, &[Section::Coherency])?;
    let alpha = needed(reader, &view, "alpha", "0.08").and_then(|field| {
        let alpha = reader.quantity(&field, Dimension::Dimensionless)?;
        if alpha < 0.0 {
            reader.bad(&field, format!("must not be negative, found {alpha}"));
            return None;
        }
        Some(alpha)
    });
    let velocity = needed(reader, &view, "shear_wave_velocity", "\"300 m/s\"");
    let velocity = velocity.and_then(|field| reader.positive(&field, Dimension::Speed));
    let seed = needed(reader, &view, "seed", "1").and_then(|field| {
        let seed = reader.count(&field)? as u64;
        if seed > GREATEST_SEED {
            reader.bad(&field, format!("must be at most {GREATEST_SEED}"));
            return None;
        }
        Some(seed)
    });
    Some(Coherency {
        alpha: alpha?,
        shear_wave_velocity: velocity?,
        seed: seed?,
    })
}

fn needed<'n>(
    reader: &mut Reader<'_>,
    view: &View<'n>,
    key: &'static str,
    example: &str,
) -> Option<Field<'n>> {
    let field = reader.get(view, key);
    if field.is_none() {
        reader.missing(view, key, format!("add {key} = {example}"));
    }
    field
}

/// A record by name, or a table like `[motion]`.
fn read_vertical(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    files: &Files,
) -> Option<Box<OwnMotionSpec>> {
    if motion::is_named(field) {
        return Some(Box::new(OwnMotionSpec {
            source: Some(motion::named(reader, field, files)?),
            scaling: Default::default(),
            reverse: false,
        }));
    }
    let view = reader.open(field, &[Section::Motion])?;
    refuse_common_keys(reader, &view, &["vertical"]);
    Some(Box::new(motion::read_own(reader, &view, files)?))
}

/// Refuses keys that only `[motion]` may have.
fn refuse_common_keys(reader: &mut Reader<'_>, view: &View<'_>, further: &[&'static str]) {
    let common = [
        "apparent_velocity",
        "wave_angle",
        "baseline",
        "coherency",
        "duration",
        "angle",
        "across",
        "governing",
    ];
    for key in common.iter().chain(further) {
        if let Some(field) = reader.get(view, key) {
            *reader.bad(&field, "belongs under [motion] only") = Some(format!("remove {key}"));
        }
    }
}

/// Grounds of buildings and walls of a model, into the motion.
pub(super) fn read_own(
    reader: &mut Reader<'_>,
    root: &View<'_>,
    motion: &mut Option<MotionSpec>,
    model: &Model,
    files: &Files,
) {
    let buildings: Vec<String> = model
        .buildings
        .iter()
        .map(|building| building.name.clone())
        .collect();
    let walls: Vec<String> = model.walls.iter().map(|wall| wall.name.clone()).collect();
    let entries = |reader: &mut Reader<'_>, key| {
        let field = reader.get(root, key);
        field.and_then(|field| field.entries()).unwrap_or_default()
    };
    let of_buildings = entries(reader, "building");
    let of_walls = entries(reader, "wall");
    let has_motion = root.has("motion");
    let mut grounds = Vec::with_capacity(buildings.len() + walls.len());
    for (field, name) in of_buildings.iter().zip(&buildings) {
        let mut ground = OwnGroundSpec {
            name: name.clone(),
            ..OwnGroundSpec::default()
        };
        if let Some(view) = reader.reopen(field, &[Section::Building]) {
            ground.position = position(reader, &view);
            if let Some(field) = reader.get(&view, "motion") {
                read_building(reader, &field, &mut ground, files);
                if !has_motion {
                    *reader.bad(&field, "needs a common motion") = Some(
                        "add [motion] with a record; buildings without their own have that".into(),
                    );
                }
            }
        }
        grounds.push(ground);
    }
    for (field, name) in of_walls.iter().zip(&walls) {
        let view = reader.reopen(field, &[Section::Wall]);
        grounds.push(OwnGroundSpec {
            name: name.clone(),
            position: view.and_then(|view| position(reader, &view)),
            ..OwnGroundSpec::default()
        });
    }
    let spec = motion.as_ref().and_then(|motion| motion.grounds.as_ref());
    let wave_angle = spec.and_then(|spec| spec.wave_angle);
    if model.is_in_space() {
        if spec.is_some_and(|spec| spec.apparent_velocity.is_some() || spec.coherency.is_some()) {
            place_in_plan(&mut grounds, model, wave_angle.unwrap_or(0.0));
        }
    } else if wave_angle.is_some()
        && let Some(field) = reader.get(root, "motion")
        && let Some(view) = reader.reopen(&field, &[Section::Motion])
        && let Some(field) = reader.get(&view, "wave_angle")
    {
        *reader.bad(&field, "needs buildings with a plan") = Some("remove wave_angle".into());
    }
    let Some(motion) = motion else {
        if !has_motion {
            let spec = GroundsSpec {
                own: grounds,
                ..GroundsSpec::default()
            };
            check_positions(reader, &spec, [&of_buildings, &of_walls]);
        }
        return;
    };
    if grounds.iter().all(|ground| {
        ground.position.is_none()
            && ground.arrival.is_none()
            && ground.motion.is_none()
            && ground.vertical.is_none()
    }) && motion.grounds.is_none()
    {
        return;
    }
    let mut spec = motion.grounds.take().unwrap_or_default();
    spec.own = grounds;
    check_positions(reader, &spec, [&of_buildings, &of_walls]);
    let between = model.gaps.iter().map(|gap| gap.between);
    let between: Vec<_> = between
        .chain(model.links.iter().map(|link| link.between))
        .collect();
    place_walls(reader, &mut spec, &of_walls, buildings.len(), &between);
    motion.grounds = Some(spec);
}

/// Positions of buildings with a plan that have none: how far waves have travelled to the centre of the lowest floor, from the one
/// that they reach first \[m\].
fn place_in_plan(specs: &mut [OwnGroundSpec], model: &Model, wave_angle: f64) {
    let (sin, cos) = libm::sincos(wave_angle);
    let passed = model.buildings.iter().map(|building| {
        let Structure::Tiers(tiers) = &building.structure else {
            return None;
        };
        let [x, y] = PlanArea::new(&tiers.floors.first()?.plan).centroid;
        Some(x * cos + y * sin)
    });
    let passed: Vec<Option<f64>> = passed.collect();
    let first = passed
        .iter()
        .flatten()
        .copied()
        .fold(f64::INFINITY, f64::min);
    for (spec, passed) in specs.iter_mut().zip(passed) {
        if spec.position.is_none() && spec.arrival.is_none() {
            spec.position = passed.map(|passed| passed - first);
        }
    }
}

fn position(reader: &mut Reader<'_>, view: &View<'_>) -> Option<f64> {
    let field = reader.get(view, "position")?;
    reader.quantity(&field, Dimension::Length)
}

/// `[building.motion]`.
fn read_building(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    ground: &mut OwnGroundSpec,
    files: &Files,
) {
    let Some(view) = reader.open(field, &[Section::OwnMotion, Section::Motion]) else {
        return;
    };
    refuse_common_keys(reader, &view, &[]);
    if let Some(arrival) = reader.get(&view, "arrival")
        && let Some(value) = reader.quantity(&arrival, Dimension::Time)
    {
        if value < 0.0 {
            *reader.bad(&arrival, format!("must not be negative, found {value} s")) =
                Some("let the first building have 0, and delay the others".into());
        } else if ground.position.is_some() {
            *reader.bad(&arrival, "cannot be combined with position") = Some(
                "keep position, from which arrival follows by apparent_velocity, or arrival".into(),
            );
        }
        ground.arrival = Some(value.max(0.0));
    }
    let others = ["record", "kind", "scale", "pga", "match", "reverse"];
    let of_sources = ["amplitude", "period", "centre"]
        .iter()
        .chain(motion::RECORD_KEYS);
    if others.iter().chain(of_sources).any(|key| view.has(key)) {
        ground.motion = motion::read_own(reader, &view, files).map(Box::new);
        motion::refuse_several(reader, &view, "record", ground.motion.as_deref());
    }
    let vertical = reader.get(&view, "vertical");
    ground.vertical = vertical.and_then(|field| read_vertical(reader, &field, files));
    motion::refuse_several(reader, &view, "vertical", ground.vertical.as_deref());
}

/// Positions go with a wave velocity or with coherency, and are then complete.
fn check_positions(
    reader: &mut Reader<'_>,
    spec: &GroundsSpec,
    [of_buildings, of_walls]: [&[Field<'_>]; 2],
) {
    let passing = spec.apparent_velocity.is_some();
    let uses = passing || spec.coherency.is_some();
    for (index, (field, ground)) in of_buildings
        .iter()
        .chain(of_walls)
        .zip(&spec.own)
        .enumerate()
    {
        let section: &'static [Section] = match index < of_buildings.len() {
            true => &[Section::Building],
            false => &[Section::Wall],
        };
        let Some(view) = reader.reopen(field, section) else {
            continue;
        };
        match (ground.position, reader.get(&view, "position")) {
            (Some(_), Some(field)) if !uses => {
                *reader.bad(&field, "has no use without apparent_velocity or coherency") =
                    Some("add apparent_velocity = \"600 m/s\" under [motion]".into());
            }
            (Some(place), Some(field)) if passing && place < 0.0 => {
                *reader.bad(
                    &field,
                    format!("must not be negative, found {place} m: the wave would arrive before it begins"),
                ) = Some("count positions from where the wave arrives first".into());
            }
            (None, None) if uses && index < of_buildings.len() && ground.arrival.is_none() => {
                reader.missing(
                    &view,
                    "position",
                    "add position = \"12 m\", which apparent_velocity and coherency need",
                );
            }
            _ => {}
        }
        if spec.coherency.is_some()
            && let Some(motion) = &ground.motion
            && motion.source.is_some()
        {
            let path = format!("{}.motion", view.path);
            *reader.fault(
                &view.span.clone(),
                path,
                "has a record of its own, which cannot be combined with coherency",
            ) = Some("leave out coherency, or this record".into());
        }
    }
}

/// A wall without a position moves with the building that it faces.
fn place_walls(
    reader: &mut Reader<'_>,
    spec: &mut GroundsSpec,
    of_walls: &[Field<'_>],
    buildings: usize,
    between: &[[Option<usize>; 2]],
) {
    for (wall, field) in of_walls.iter().enumerate() {
        let index = buildings + wall;
        let faced = between.iter().filter_map(|pair| match *pair {
            [Some(one), Some(other)] if one == index && other < buildings => Some(other),
            [Some(other), Some(one)] if one == index && other < buildings => Some(other),
            _ => None,
        });
        let faced: Vec<usize> = faced.collect();
        let (Some(first), Some(wall_ground)) = (faced.first(), spec.own.get(index)) else {
            continue;
        };
        if wall_ground.position.is_some() {
            continue;
        }
        let ground = |building: usize| {
            let spec_own = &spec.own[building];
            (
                &spec_own.motion,
                spec.arrival(building),
                spec_own.position.filter(|_| spec.coherency.is_some()),
            )
        };
        if let Some(other) = faced.iter().find(|other| ground(**other) != ground(*first)) {
            let problem = format!(
                "stands between \"{}\" and \"{}\", whose grounds differ",
                spec.own[*first].name, spec.own[*other].name
            );
            *reader.bad(field, problem) = Some("give it a position".into());
        }
        spec.own[index].like = Some(*first);
    }
}
