//! `[[building]]`: what frames and shear buildings have in common.

use std::collections::BTreeMap;

use jostle::model::{FrameHinges, Hinges};
use jostle::separation::BuildingCodes;
use jostle::{
    AcrossBase, Base, Building, Damping, Gravity, MassDamping, Model, PlanPoint,
    ProportionalDamping, Structure, Sway, Tiers,
};

use super::damper::{self, Damper};
use super::places::is_by_place;
use super::reinforced::{self, KnownMembers, ProfiledMember, ReinforcedInPlan};
use super::{
    codes, frame, given, given_in_plan, hinges, isolation, joint, plan, plan_frames,
    rotation_limits, shear, shear_failure, soil, soil_spring,
};
use crate::files::Files;
use crate::keys::{BUILDING_KINDS, Section};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};
use crate::tree::Value;

/// Most buildings in a row.
const MOST_BUILDINGS: usize = 1000;

/// Most storeys of a building.
const MOST_STOREYS: usize = 200;

/// Buildings, and what a file says of them beyond.
pub(super) struct Buildings {
    pub(super) buildings: Vec<Building>,
    /// Their members of known strength.
    pub(super) members: KnownMembers,
    /// Their factors in codes.
    pub(super) codes: Vec<BuildingCodes>,
    /// Where those with a plan stand on the site; `None` stands in a row.
    pub(super) at: Vec<Option<PlanPoint>>,
    /// Their dampers, in the order of buildings.
    pub(super) dampers: Vec<Damper>,
}

/// Reads the list of buildings; `None` if it is not a list.
pub(super) fn read_all(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    files: &Files,
) -> Option<Buildings> {
    let Some(entries) = field.entries() else {
        let found = field.node.describe();
        *reader.bad(
            field,
            format!("expected a list of buildings, found {found}"),
        ) = Some("write [[building]] with double brackets; in JSON \"building\": [{ … }]".into());
        return None;
    };
    if entries.len() > MOST_BUILDINGS {
        let count = entries.len();
        reader.bad(
            field,
            format!("at most {MOST_BUILDINGS} buildings are possible, found {count}"),
        );
        return None;
    }
    let (mut members, mut of_codes, mut at) = (KnownMembers::default(), Vec::new(), Vec::new());
    let mut dampers = Vec::new();
    let buildings = entries
        .iter()
        .enumerate()
        .map(|(i, entry)| {
            let mut place = None;
            let building = read(reader, entry, i, files, &mut members, &mut place);
            at.push(place);
            of_codes.push(read_codes(reader, entry));
            dampers.extend(damper::read_all(reader, entry, i));
            dampers.extend(soil_spring::read_all(reader, entry, i));
            building
        })
        .collect::<Vec<_>>();
    // If a building is not a table, the positions of the others in the row are unknown.
    let buildings: Option<Vec<_>> = buildings.into_iter().collect();
    Some(Buildings {
        buildings: buildings?,
        members,
        codes: of_codes,
        at,
        dampers,
    })
}

/// Keys that need a plan.
fn refuse_plan_keys(reader: &mut Reader<'_>, view: &View<'_>) {
    for key in [
        "at",
        "mass_centre",
        "polar_mass",
        "eccentricity",
        "element",
        "frame",
    ] {
        if let Some(field) = reader.get(view, key) {
            *reader.bad(&field, "needs a plan") =
                Some("add plan = [\"20 m\", \"12 m\"], or corners".into());
        }
    }
}

/// Factors of a building in codes.
fn read_codes(reader: &mut Reader<'_>, field: &Field<'_>) -> BuildingCodes {
    let view = reader.reopen(field, &[Section::Building]);
    let codes_field = view.and_then(|view| reader.get(&view, "codes"));
    codes_field.map_or_else(BuildingCodes::default, |field| {
        codes::read_building(reader, &field)
    })
}

fn read(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    index: usize,
    files: &Files,
    members: &mut KnownMembers,
    at: &mut Option<PlanPoint>,
) -> Option<Building> {
    let noted = reader.count_faults();
    let kind = kind_of(field);
    let view = match kind {
        Kind::Shear => reader.open(field, &[Section::Building, Section::Shear]),
        Kind::Frame => reader.open(field, &[Section::Building, Section::Frame]),
        Kind::FramesInPlan => reader.open(field, &[Section::Building, Section::Shear]),
        Kind::SpaceFrame => reader.open(
            field,
            &[Section::Building, Section::SpaceFrame, Section::Shear],
        ),
        Kind::Given => reader.open(field, &[Section::Building, Section::Given]),
    }?;
    let name = reader
        .get(&view, "name")
        .and_then(|field| reader.text(&field));
    match reader.get(&view, "kind") {
        Some(kind) => {
            reader.choice(&kind, BUILDING_KINDS, &[]);
        }
        None => match kind {
            Kind::Shear => reader.missing(
                &view,
                "kind",
                "add kind = \"shear\" for masses on storey springs",
            ),
            Kind::Given => reader.missing(
                &view,
                "kind",
                "add kind = \"given\" for matrices or modes of another program",
            ),
            Kind::FramesInPlan => reader.missing(
                &view,
                "kind",
                "add kind = \"frame\" for frames at lines of a plan",
            ),
            Kind::SpaceFrame => reader.missing(
                &view,
                "kind",
                "add kind = \"space-frame\" for columns and beams at grid lines",
            ),
            Kind::Frame => {}
        },
    }
    let no_loads = BTreeMap::new();
    let (mut damped, mut bars_in_plan) = (None, ReinforcedInPlan::default());
    let structure = match kind {
        Kind::Shear if view.has("plan") => {
            if let Some(field) = reader.get(&view, "frame") {
                *reader.bad(&field, "needs kind = \"frame\"") =
                    Some("write kind = \"frame\"; stiffness and elements may stay".into());
            }
            let read = plan::read(reader, &view, plan::HeldBy::Springs, &no_loads);
            (*at, bars_in_plan) = (read.at, read.reinforced);
            Structure::Tiers(read.tiers)
        }
        Kind::FramesInPlan => {
            if !view.has("plan") {
                reader.missing(&view, "plan", "add plan = [\"20 m\", \"12 m\"], or corners");
            }
            let read = plan::read(reader, &view, plan::HeldBy::Frames, &no_loads);
            (*at, bars_in_plan) = (read.at, read.reinforced);
            Structure::Tiers(read.tiers)
        }
        Kind::SpaceFrame => {
            if let Some(field) = reader.get(&view, "frame") {
                *reader.bad(&field, "needs kind = \"frame\"") =
                    Some("leave out [[building.frame]]; walls can be [[building.element]]".into());
            }
            let read = plan::read(reader, &view, plan::HeldBy::SpaceFrame, &no_loads);
            (*at, bars_in_plan) = (read.at, read.reinforced);
            Structure::Tiers(read.tiers)
        }
        Kind::Shear => {
            refuse_plan_keys(reader, &view);
            Structure::Shear(shear::read(reader, &view))
        }
        Kind::Frame => Structure::Frame(frame::read(reader, &view)),
        Kind::Given if view.has("plan") => {
            let read = given_in_plan::read(reader, &view, files);
            damped = read.damping;
            *at = read.given.at;
            Structure::Tiers(read.given.tiers)
        }
        Kind::Given => {
            let read = given::read(reader, &view, files);
            damped = read.damping;
            Structure::Given(read.given)
        }
    };
    let mut building = Building {
        name: name.unwrap_or_else(|| format!("B{}", index + 1)),
        structure,
        damping: Damping::Rayleigh {
            alpha: 0.0,
            beta: 0.0,
        },
        base: Base::default(),
        gravity: Gravity::default(),
        hinges: None,
        yielding_damping: None,
        mass_damping: MassDamping::default(),
        rotation_limits: rotation_limits::read_all(reader, &view),
    };
    let is_shear = kind == Kind::Shear;
    if kind != Kind::Given {
        building.base = read_base(reader, &view, kind != Kind::Frame);
        let places = match &mut building.structure {
            Structure::Tiers(tiers) => Some(&mut tiers.bearings),
            Structure::Frame(_) | Structure::Shear(_) | Structure::Given(_) => None,
        };
        building.base.isolation = isolation::read(reader, &view, places);
        building.base.foundation = soil::read_foundation(reader, &view);
    } else if let Structure::Tiers(tiers) = &mut building.structure {
        building.base.isolation = isolation::read(reader, &view, Some(&mut tiers.bearings));
    }
    let Base {
        isolation,
        foundation,
        ..
    } = building.base;
    if isolation.is_some() || foundation.is_some() {
        // A base beside it is a fault already, and isolation beside a foundation.
        building.base = Base {
            isolation: isolation.filter(|_| foundation.is_none()),
            foundation,
            ..Base::default()
        };
    }
    if let Some(field) = reader.get(&view, "elevation") {
        let elevation = reader.quantity(&field, Dimension::Length);
        building.base.elevation = elevation.unwrap_or(0.0);
    }
    let mut flag = |key| {
        reader
            .get(&view, key)
            .is_some_and(|field| reader.flag(&field).unwrap_or(false))
    };
    building.gravity = Gravity {
        preload: flag("gravity"),
        p_delta: flag("p_delta"),
    };
    let (damping, on_yielding) = match (damped, reader.get(&view, "damping")) {
        (Some(damping), None) => (damping, None),
        (Some(damping), Some(field)) => {
            *reader.bad(&field, "cannot be combined with a damping matrix") =
                Some("leave out damping, or the matrix C".into());
            (damping, None)
        }
        (None, _) => read_damping(reader, &view, building.floors(), is_shear),
    };
    (building.damping, building.yielding_damping) = (damping, on_yielding);
    building.mass_damping = read_mass_damping(reader, &view);
    let stated = match kind {
        Kind::Given => None,
        Kind::Frame | Kind::Shear | Kind::FramesInPlan | Kind::SpaceFrame => {
            reader.get(&view, "hinges")
        }
    };
    building.hinges = match &building.structure {
        Structure::Shear(shear) => {
            stated.and_then(|field| hinges::read_storeys(reader, &field, shear))
        }
        // Those of a plan are part of it.
        Structure::Tiers(_) => {
            let firm = on_firm_ground(&building);
            let here = (reader.count_faults() == noted && is_sound(&firm))
                .then(|| reinforced::members_in_plan(index, &firm, &bars_in_plan));
            let here = sound_members(reader, &view, here);
            if let Structure::Tiers(tiers) = &mut building.structure {
                if let Some(here) = &here {
                    load_hinges(reader, &view, kind, tiers, &here.profiled);
                }
                let here = here.as_ref().map(|here| &here.reinforced[..]);
                let frames = &mut tiers.frames;
                if kind == Kind::FramesInPlan {
                    plan_frames::read_shear_failure(reader, &view, frames, here);
                } else if let Some(frame) = &mut tiers.space_frame
                    && let Some(field) = reader.get(&view, "shear_failure")
                {
                    let heights = &tiers.storey_heights;
                    let read = shear_failure::read_in_space(reader, &field, frame, heights, here);
                    frame.shear = read.unwrap_or_default();
                }
            }
            members.append(here.unwrap_or_default());
            None
        }
        Structure::Given(_) => None,
        Structure::Frame(frame) => {
            let reinforced = reinforced::read(reader, &view, frame);
            let read_hinges = |reader: &mut Reader<'_>, here: Option<&KnownMembers>| {
                let hinges = stated
                    .as_ref()
                    .and_then(|field| hinges::read_frame(reader, field, frame, &reinforced, here));
                joint::with_hinge(reader, &view, frame, hinges)
            };
            let mut firm = on_firm_ground(&building);
            let members_of = |reader: &mut Reader<'_>, firm: &Building| {
                let here = (reader.count_faults() == noted && is_sound(firm))
                    .then(|| reinforced::members(index, firm, &reinforced));
                sound_members(reader, &view, here)
            };
            let mut here = members_of(reader, &firm);
            let mut hinges = read_hinges(reader, here.as_ref());
            if hinges.is_some() && reinforced.asks_gravity() {
                // Springs change what columns bear, and that changes where hinges yield.
                firm.hinges = hinges.clone();
                let with_springs = members_of(reader, &firm);
                if with_springs.is_some() {
                    here = with_springs;
                    hinges = read_hinges(reader, here.as_ref());
                }
            }
            let laid = here.as_ref().map(|here| &here.reinforced[..]);
            let failing = reader
                .get(&view, "shear_failure")
                .map(|field| shear_failure::read(reader, &field, frame, "", laid));
            members.append(here.unwrap_or_default());
            match failing.flatten() {
                Some(shear) => {
                    let mut all = match hinges {
                        Some(Hinges::Frame(hinges)) => hinges,
                        _ => FrameHinges::default(),
                    };
                    all.shear = shear;
                    Some(Hinges::Frame(all))
                }
                None => hinges,
            }
        }
    };
    let in_plan = matches!(&building.structure, Structure::Tiers(tiers) if tiers.may_yield());
    if !view.has("p_delta") {
        // What yields falls over sideways sooner under its weight.
        building.gravity.p_delta = building.hinges.is_some() || in_plan;
    }
    Some(building)
}

/// Lets the axial forces of steel columns of a plan reduce the moments at which they yield, now that these forces are known.
fn load_hinges(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    kind: Kind,
    tiers: &mut Tiers,
    profiled: &[ProfiledMember],
) {
    let held_by = match kind {
        Kind::FramesInPlan => plan::HeldBy::Frames,
        _ => plan::HeldBy::SpaceFrame,
    };
    let loads = profiled.iter().filter(|member| member.compression != 0.0);
    let loads = loads.map(|member| (member.name.clone(), member.compression));
    let loads: BTreeMap<String, f64> = loads.collect();
    if loads.is_empty() || !tiers.may_yield() {
        return;
    }
    let loaded = plan::read(reader, view, held_by, &loads).tiers;
    for (frame, loaded) in tiers.frames.iter_mut().zip(loaded.frames) {
        frame.hinges.columns = loaded.hinges.columns;
    }
    if let (Some(frame), Some(loaded)) = (&mut tiers.space_frame, loaded.space_frame) {
        for (member, loaded) in frame.members.iter_mut().zip(loaded.members) {
            member.hinges = loaded.hinges;
        }
    }
}

/// Members of known strength of a building; notes why they are not known.
fn sound_members(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    found: Option<Result<KnownMembers, String>>,
) -> Option<KnownMembers> {
    match found? {
        Ok(members) => Some(members),
        Err(problem) => {
            let path = format!("{}.column", view.path);
            *reader.fault(&view.span.clone(), path, problem) =
                Some("check its supports, and the yield moments of its hinges".into());
            None
        }
    }
}

/// The building on rigid ground: its soil is not read yet. One rigid foundation under all columns leaves their shares of the weight
/// nearly as they are.
fn on_firm_ground(building: &Building) -> Building {
    let mut firm = building.clone();
    firm.base.foundation = None;
    firm.mass_damping = MassDamping::default();
    firm
}

/// Whether a building by itself would pass the check of a model.
fn is_sound(building: &Building) -> bool {
    let alone = Model {
        buildings: vec![building.clone()],
        ..Model::default()
    };
    alone.check().is_ok()
}

/// Kind of a building.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Frame,
    Shear,
    Given,
    /// Frames at lines of a plan.
    FramesInPlan,
    /// Columns and beams at grid lines.
    SpaceFrame,
}

/// The kind of a building. If `kind` is absent or misspelt, the other keys decide, so that one mistake gives one fault.
fn kind_of(field: &Field<'_>) -> Kind {
    let Value::Table(table) = &field.node.value else {
        return Kind::Frame;
    };
    let has = |key| table.get(key).is_some();
    match table.get("kind").map(|kind| &kind.value) {
        Some(Value::Text(kind)) if kind == "shear" => Kind::Shear,
        Some(Value::Text(kind)) if kind == "given" => Kind::Given,
        Some(Value::Text(kind)) if kind == "space-frame" => Kind::SpaceFrame,
        Some(Value::Text(kind)) if kind == "frame" && (has("plan") || has("frame")) => {
            Kind::FramesInPlan
        }
        Some(Value::Text(kind)) if kind == "frame" => Kind::Frame,
        _ if has("lines_x") || has("lines_y") => Kind::SpaceFrame,
        _ if has("frame") && (has("plan") || has("mass")) => Kind::FramesInPlan,
        _ if has("matrices") || has("ports") || has("shapes") => Kind::Given,
        _ if (has("mass") || has("stiffness")) && !has("spans") && !has("column") => Kind::Shear,
        _ => Kind::Frame,
    }
}

/// The number of storeys: as stated, or as long as the first of the lists.
///
/// Every list is compared with it where it is read.
pub(super) fn storeys(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    lists: &[&'static str],
) -> Option<usize> {
    let (storeys, floors) = (reader.get(view, "storeys"), reader.get(view, "floors"));
    if let (Some(_), Some(floors)) = (&storeys, &floors) {
        *reader.bad(floors, "cannot be combined with storeys") =
            Some("keep either storeys or floors".into());
    }
    if let Some(field) = storeys.or(floors) {
        let count = reader.count(&field)?;
        if (1..=MOST_STOREYS).contains(&count) {
            return Some(count);
        }
        *reader.bad(
            &field,
            format!("must lie between 1 and {MOST_STOREYS}, found {count}"),
        ) = (count == 0).then(|| "a building of one floor has storeys = 1".into());
        return None;
    }
    for list in lists {
        let Some(field) = reader.get(view, list) else {
            continue;
        };
        if is_by_place(reader, view, list) {
            continue;
        }
        match field.entries().map(|entries| entries.len()) {
            Some(0) => {
                reader.bad(&field, "is empty");
                return None;
            }
            Some(count @ 1..=MOST_STOREYS) => return Some(count),
            Some(count) => {
                reader.bad(
                    &field,
                    format!("has {count} entries; at most {MOST_STOREYS} storeys are possible"),
                );
                return None;
            }
            None => {}
        }
    }
    let example = lists.first().copied().unwrap_or("storey_height");
    reader.missing(
        view,
        "storeys",
        format!("add storeys = 5, or a list as {example} from the ground up"),
    );
    None
}

/// One value per storey from the ground up; a single value holds for all. `None` after a fault.
pub(super) fn per_storey(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    dimension: Dimension,
    storeys: Option<usize>,
) -> Option<Vec<f64>> {
    let Some(entries) = field.entries() else {
        let value = reader.quantity(field, dimension)?;
        return Some(vec![value; storeys.unwrap_or(1)]);
    };
    let values: Vec<_> = entries
        .iter()
        .map(|entry| reader.quantity(entry, dimension))
        .collect();
    has_length(reader, field, values.len(), storeys)?;
    values.into_iter().collect()
}

/// Notes a list that is not as long as the building is high.
pub(super) fn has_length(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    count: usize,
    storeys: Option<usize>,
) -> Option<()> {
    match storeys {
        Some(storeys) if storeys != count => {
            let entries = if count == 1 { "entry" } else { "entries" };
            reader.bad(
                field,
                format!("has {count} {entries} for {storeys} storeys; give one value, or one per storey from the ground up"),
            );
            None
        }
        _ => Some(()),
    }
}

fn read_damping(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    floors: usize,
    is_shear: bool,
) -> (Damping, Option<ProportionalDamping>) {
    let usual = Damping::ratio(0.05, []);
    let Some(field) = reader.get(view, "damping") else {
        return (usual, None);
    };
    let Some(view) = reader.open(&field, &[Section::Damping]) else {
        return (usual, None);
    };
    let on_yielding = reader.get(&view, "yielding").and_then(|field| {
        match reader.choice(&field, &["initial", "tangent", "none"], &[])? {
            "initial" => Some(ProportionalDamping::Initial),
            "tangent" => Some(ProportionalDamping::Tangent),
            _ => Some(ProportionalDamping::None),
        }
    });
    let number = |reader: &mut Reader<'_>, key, dimension| {
        let field = reader.get(&view, key)?;
        reader.quantity(&field, dimension)
    };
    let sway = reader.get(&view, "along").and_then(|field| {
        match reader.choice(&field, &["x", "y", "both"], &[])? {
            "y" => Some(Sway::Across),
            "both" => Some(Sway::Both),
            _ => Some(Sway::Along),
        }
    });
    let alpha = number(reader, "alpha", Dimension::Frequency);
    let beta = number(reader, "beta", Dimension::Time);
    let ratio = number(reader, "ratio", Dimension::Dimensionless);
    let mut all = false;
    let modes = reader.get(&view, "modes").map(|field| {
        if field.as_text() == Some("all") {
            all = true;
            return Vec::new();
        }
        let modes = read_modes(reader, &field);
        if modes.is_empty() {
            *reader.bad(&field, "names no mode") =
                Some("name one or two lateral modes, such as [1, 3], or leave it out".into());
        }
        if let (true, Some(highest)) = (is_shear, modes.iter().max().filter(|m| **m > floors)) {
            reader.bad(&field, format!("mode {highest} does not exist; a shear building has as many modes as floors, here {floors}"));
        }
        modes
    });
    if view.has("alpha") || view.has("beta") {
        if ["ratio", "modes", "along"].iter().any(|key| view.has(key)) {
            *reader.bad(&field, "mixes ratio, modes and along with alpha and beta") =
                Some("keep either ratio and modes, or alpha and beta".into());
        }
        let damping = Damping::Rayleigh {
            alpha: alpha.unwrap_or(0.0),
            beta: beta.unwrap_or(0.0),
        };
        return (damping, on_yielding);
    }
    let ratio = ratio.unwrap_or(0.05);
    let damping = if all {
        Damping::AllModes { ratio }
    } else {
        let modes = modes.unwrap_or_default();
        Damping::Ratio {
            ratio,
            modes,
            sway: sway.unwrap_or_default(),
        }
    };
    (damping, on_yielding)
}

/// What damping in proportion to mass acts relative to.
fn read_mass_damping(reader: &mut Reader<'_>, view: &View<'_>) -> MassDamping {
    let damping = reader.get(view, "damping");
    let damping = damping.and_then(|field| reader.reopen(&field, &[Section::Damping]));
    let Some(field) = damping.and_then(|view| reader.get(&view, "relative_to")) else {
        return MassDamping::default();
    };
    match reader.choice(&field, &["foundation", "ground"], &[]) {
        Some("ground") => MassDamping::Ground,
        _ => MassDamping::Support,
    }
}

/// Springs and dashpots under the building.
pub(super) fn read_base(reader: &mut Reader<'_>, view: &View<'_>, is_shear: bool) -> Base {
    let Some(field) = reader.get(view, "base") else {
        return Base::default();
    };
    if field.as_text() == Some("fixed") {
        return Base::default();
    }
    let sections: &'static [Section] = if is_shear {
        &[Section::ShearBase, Section::PlanBase]
    } else {
        &[Section::ShearBase, Section::FrameBase]
    };
    let Some(view) = reader.open(&field, sections) else {
        return Base::default();
    };
    let mut base = Base {
        horizontal_stiffness: or_rigid(reader, &view, "horizontal_stiffness", Dimension::Stiffness),
        ..Base::default()
    };
    let mut quantity = |key, dimension| {
        let value = reader
            .get(&view, key)
            .and_then(|field| reader.quantity(&field, dimension));
        value.unwrap_or(0.0)
    };
    base.horizontal_damping = quantity("horizontal_damping", Dimension::Damping);
    base.mass = quantity("mass", Dimension::Mass);
    base.rotational_damping = quantity("rotational_damping", Dimension::RotationalDamping);
    match is_shear {
        true => {
            let key = "torsional_damping";
            base.torsional_damping = quantity(key, Dimension::RotationalDamping);
        }
        false => base.vertical_damping = quantity("vertical_damping", Dimension::Damping),
    }
    if is_shear {
        let [turning, twisting] = ["rotational_stiffness", "torsional_stiffness"]
            .map(|key| or_rigid(reader, &view, key, Dimension::RotationalStiffness));
        (base.rotational_stiffness, base.torsional_stiffness) = (turning, twisting);
        base.across = read_across(reader, &view, &base);
    }
    if !is_shear {
        base.vertical_stiffness =
            or_rigid(reader, &view, "vertical_stiffness", Dimension::Stiffness);
        let uplift = reader.get(&view, "uplift");
        base.uplift = uplift.is_some_and(|field| reader.flag(&field).unwrap_or(false));
        base.rotational_stiffness = or_rigid(
            reader,
            &view,
            "rotational_stiffness",
            Dimension::RotationalStiffness,
        );
        base.rotational_hinge = hinges::read_base(
            reader,
            &view,
            ["rotational_hinge", "rotational_stiffness"],
            base.rotational_stiffness,
            Dimension::Moment,
        );
    }
    base.horizontal_hinge = hinges::read_base(
        reader,
        &view,
        ["horizontal_hinge", "horizontal_stiffness"],
        base.horizontal_stiffness,
        Dimension::Force,
    );
    base
}

/// What differs across; the rest is as along the row.
fn read_across(reader: &mut Reader<'_>, view: &View<'_>, base: &Base) -> Option<AcrossBase> {
    let field = reader.get(view, "across")?;
    let view = reader.open(&field, &[Section::AcrossBase])?;
    let [mut plan, _] = base.in_plan();
    for (key, dimension, stiffness) in [
        (
            "horizontal_stiffness",
            Dimension::Stiffness,
            &mut plan.horizontal_stiffness,
        ),
        (
            "rotational_stiffness",
            Dimension::RotationalStiffness,
            &mut plan.rotational_stiffness,
        ),
    ] {
        if reader.get(&view, key).is_some() {
            *stiffness = or_rigid(reader, &view, key, dimension);
        }
    }
    for (key, dimension, damping) in [
        (
            "horizontal_damping",
            Dimension::Damping,
            &mut plan.horizontal_damping,
        ),
        (
            "rotational_damping",
            Dimension::RotationalDamping,
            &mut plan.rotational_damping,
        ),
    ] {
        if let Some(field) = reader.get(&view, key) {
            *damping = reader.quantity(&field, dimension).unwrap_or(0.0);
        }
    }
    Some(plan)
}

/// A stiffness; `None` for `"rigid"` and where it is absent.
pub(super) fn or_rigid(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    key: &'static str,
    dimension: Dimension,
) -> Option<f64> {
    let field = reader.get(view, key)?;
    if field.as_text() == Some("rigid") {
        return None;
    }
    reader.quantity(&field, dimension)
}

/// Mode numbers; after a fault, the first mode.
fn read_modes(reader: &mut Reader<'_>, field: &Field<'_>) -> Vec<usize> {
    let modes = match field.entries() {
        Some(entries) => entries.iter().map(|entry| reader.count(entry)).collect(),
        None => reader.count(field).map(|mode| vec![mode]),
    };
    modes.unwrap_or_else(|| vec![1])
}
