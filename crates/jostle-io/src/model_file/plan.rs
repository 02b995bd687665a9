//! Plans of buildings: floors that move in both horizontal directions and turn.

use std::collections::BTreeMap;

use jostle::hysteresis::Hysteresis;
use jostle::interface::narrowest_gap;
use jostle::linear::sort_by_key;
use jostle::{
    Building, Gap, Model, PlanArea, PlanAxis, PlanPoint, PlanSpring, Structure, Tier, TierStorey,
    Tiers,
};

use super::building::{has_length, per_storey, storeys};
use super::hinges;
use super::places::range;
use super::plan_frames;
use super::reinforced::ReinforcedInPlan;
use super::shear::DEFAULT_STOREY_HEIGHT;
use super::space_frame::{self, Grid};
use crate::keys::Section;
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// Greatest difference between the width of a gap and the distance of the plans \[m\].
const AGREES: f64 = 1e-3;

/// A building with a plan, and where it stands; `None` stands in a row.
pub(super) struct Planned {
    pub(super) tiers: Tiers,
    pub(super) at: Option<PlanPoint>,
    /// Sections of its columns and beams that have bars.
    pub(super) reinforced: ReinforcedInPlan,
}

/// What holds floors beside storey springs and elements.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum HeldBy {
    Springs,
    Frames,
    SpaceFrame,
}

/// Reads the keys of a building that has a plan. After a fault, harmless values are used.
///
/// `loads`: compressions of columns by name, as far as they are known \[N\].
pub(super) fn read(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    held_by: HeldBy,
    loads: &BTreeMap<String, f64>,
) -> Planned {
    let has_frames = held_by != HeldBy::Springs;
    let grid = (held_by == HeldBy::SpaceFrame).then(|| Grid::read(reader, view));
    if grid
        .as_ref()
        .is_some_and(|grid| grid.direction != [1.0, 0.0])
    {
        for key in ["stiffness", "element"] {
            if let Some(field) = reader.get(view, key) {
                *reader.bad(
                    &field,
                    "acts along x and y of the site, which is not possible beside angle",
                ) = Some(format!("leave out angle, or {key}"));
            }
        }
    }
    let elements = reader
        .get(view, "element")
        .and_then(|field| field.entries());
    let springs_may_lack = has_frames && !view.has("stiffness");
    let lists: &[&'static str] = if elements.is_some() || springs_may_lack {
        &["mass", "storey_height"]
    } else {
        &["mass", "stiffness", "storey_height"]
    };
    let count = if is_single_floor(reader, view) {
        1
    } else {
        storeys(reader, view, lists).unwrap_or(1)
    };
    let list = |reader: &mut Reader<'_>, key, dimension| {
        let field = reader.get(view, key)?;
        per_storey(reader, &field, dimension, Some(count))
    };
    let masses = list(reader, "mass", Dimension::Mass);
    if !view.has("mass") {
        reader.missing(
            view,
            "mass",
            "add mass = \"250 t\", or a list from the ground up",
        );
    }
    let masses = masses.unwrap_or_else(|| vec![1.0; count]);
    let heights = list(reader, "storey_height", Dimension::Length);
    let polar = list(reader, "polar_mass", Dimension::PolarMass);
    let plans = reader
        .get(view, "plan")
        .and_then(|field| read_plans(reader, &field, count));
    let square = || vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let usual = || grid.as_ref().map_or_else(square, Grid::rectangle);
    let plans = plans.unwrap_or_else(|| vec![usual(); count]);
    let turned = |point: PlanPoint| grid.as_ref().map_or(point, |grid| grid.turned(point));
    let at = reader
        .get(view, "at")
        .and_then(|field| pair(reader, &field));
    let centre = reader
        .get(view, "mass_centre")
        .and_then(|field| pairs(reader, &field, count));
    let mut floors: Vec<Tier> = plans
        .iter()
        .enumerate()
        .map(|(floor, plan)| {
            let area = PlanArea::new(plan);
            // A plan without an area is a fault of the plan alone.
            let gyration = Some(area.gyration()).filter(|size| size.is_finite() && *size > 0.0);
            let centroid = Some(area.centroid).filter(|at| at.iter().all(|x| x.is_finite()));
            let mass = masses.get(floor).copied().unwrap_or(1.0);
            let stated = centre.as_ref().and_then(|list| list.get(floor).copied());
            let centre = stated.or(centroid).unwrap_or_default();
            let polar = polar.as_ref().and_then(|list| list.get(floor).copied());
            Tier {
                mass,
                polar_mass: polar.unwrap_or(mass * gyration.unwrap_or(1.0)),
                centre: turned(centre),
                plan: plan.iter().map(|corner| turned(*corner)).collect(),
            }
        })
        .collect();
    let (mut yielding, mut element_names) = (Vec::new(), Vec::new());
    // A space frame has those of its members.
    let hinges = match held_by {
        HeldBy::SpaceFrame => None,
        HeldBy::Springs | HeldBy::Frames => reader.get(view, "hinges"),
    };
    let storeys = match elements {
        Some(entries) => {
            for key in ["stiffness", "eccentricity"] {
                if let Some(field) = reader.get(view, key) {
                    *reader.bad(&field, "cannot be combined with elements") =
                        Some(format!("remove {key}; the elements give it"));
                }
            }
            if let Some(field) = &hinges {
                *reader.bad(field, "are those of stiffness, which elements replace") =
                    Some("move hinges into the elements that yield".into());
            }
            let read = of_elements(reader, &entries, count);
            (yielding, element_names) = (read.yielding, read.names);
            read.storeys
        }
        None if springs_may_lack => {
            if let Some(field) = reader.get(view, "eccentricity") {
                *reader.bad(&field, "is that of stiffness, which is not given") =
                    Some("remove eccentricity; the places of the frames give it".into());
            }
            if let Some(field) = &hinges {
                *reader.bad(
                    field,
                    "are those of stiffness, which is not given; frames have hinges of their own",
                ) = Some("move hinges into [[building.frame]]".into());
            }
            Vec::new()
        }
        None => {
            let mut storeys = of_stiffness(reader, view, &floors, &plans);
            if let Some(field) = &hinges {
                yielding = of_storeys(reader, field, &mut storeys);
            }
            storeys
        }
    };
    let storey_heights = heights.unwrap_or_else(|| vec![DEFAULT_STOREY_HEIGHT; count]);
    let frames = match held_by {
        HeldBy::Frames => plan_frames::read_all(reader, view, &storey_heights, loads),
        HeldBy::Springs | HeldBy::SpaceFrame => Vec::new(),
    };
    let (frames, of_frames) = frames.into_iter().unzip();
    let space_frame =
        grid.map(|grid| space_frame::read(reader, view, grid, &plans, &storey_heights, loads));
    let (space_frame, of_members) = match space_frame {
        Some(read) => {
            for (index, floor) in floors.iter_mut().enumerate() {
                let panels = read.panels.iter().filter(|(at, _)| *at == index);
                let panels: Vec<_> = panels.map(|(_, mass)| *mass).collect();
                *floor = floor.with_masses(&panels);
            }
            (Some(read.frame), Some(read.sections))
        }
        None => (None, None),
    };
    Planned {
        tiers: Tiers {
            floors,
            storeys,
            storey_heights,
            frames,
            space_frame,
            yielding,
            element_names,
            ..Tiers::default()
        },
        at,
        reinforced: ReinforcedInPlan {
            frames: of_frames,
            members: of_members.unwrap_or_default(),
        },
    }
}

/// Whether nothing speaks of more than one floor.
fn is_single_floor(reader: &mut Reader<'_>, view: &View<'_>) -> bool {
    let counted = view.has("storeys") || view.has("floors");
    let mut single = |key| {
        let field = reader.get(view, key);
        field.is_none_or(|field| field.entries().is_none())
    };
    !counted && single("mass") && single("stiffness") && single("storey_height")
}

/// Two lengths.
pub(super) fn pair(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<PlanPoint> {
    let entries = field.entries().unwrap_or_default();
    let [x, y] = &entries[..] else {
        let found = field.node.describe();
        reader.bad(
            field,
            format!("expected two lengths, along x and across, such as [\"1 m\", \"-0.5 m\"]; found {found}"),
        );
        return None;
    };
    let x = reader.quantity(x, Dimension::Length);
    let y = reader.quantity(y, Dimension::Length);
    Some([x?, y?])
}

/// Two lengths for all storeys, or a list of such pairs from the ground up.
fn pairs(reader: &mut Reader<'_>, field: &Field<'_>, count: usize) -> Option<Vec<PlanPoint>> {
    let entries = field.entries().unwrap_or_default();
    if entries
        .first()
        .is_none_or(|entry| entry.entries().is_none())
    {
        return pair(reader, field).map(|pair| vec![pair; count]);
    }
    has_length(reader, field, entries.len(), Some(count))?;
    let list: Vec<_> = entries.iter().map(|entry| pair(reader, entry)).collect();
    list.into_iter().collect()
}

/// A plan for all floors, or a list of plans from the ground up, each a table with its size or its corners.
pub(super) fn read_plans(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    count: usize,
) -> Option<Vec<Vec<PlanPoint>>> {
    let entries = field.entries().unwrap_or_default();
    let tables = entries
        .first()
        .is_some_and(|entry| entry.named_entries().is_some());
    if !tables {
        return read_plan(reader, field).map(|plan| vec![plan; count]);
    }
    has_length(reader, field, entries.len(), Some(count))?;
    let plans: Vec<_> = entries
        .iter()
        .map(|entry| {
            let view = reader.open(entry, &[Section::FloorPlan])?;
            match (reader.get(&view, "size"), reader.get(&view, "corners")) {
                (Some(field), None) | (None, Some(field)) => read_plan(reader, &field),
                _ => {
                    reader.missing(
                        &view,
                        "size",
                        "give either size = [\"20 m\", \"12 m\"], or corners",
                    );
                    None
                }
            }
        })
        .collect();
    plans.into_iter().collect()
}

/// Most corners of a plan: edges are compared with each other, and with those of neighbours.
const MOST_CORNERS: usize = 300;

/// The width along x and the depth across of a rectangle, or a list of corners.
fn read_plan(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<Vec<PlanPoint>> {
    let entries = field.entries().unwrap_or_default();
    if entries
        .first()
        .is_some_and(|entry| entry.entries().is_some())
    {
        if entries.len() > MOST_CORNERS {
            *reader.bad(
                field,
                format!(
                    "has {} corners; at most {MOST_CORNERS} are possible",
                    entries.len()
                ),
            ) = Some("leave out corners that hardly change the outline".into());
            return None;
        }
        let corners: Vec<_> = entries.iter().map(|entry| pair(reader, entry)).collect();
        return corners.into_iter().collect();
    }
    let [width, depth] = &entries[..] else {
        let found = field.node.describe();
        *reader.bad(field, format!("expected a width and a depth, or corners; found {found}")) =
            Some("write plan = [\"20 m\", \"12 m\"], or plan = [[\"0 m\", \"0 m\"], [\"20 m\", \"0 m\"], …] counter-clockwise".into());
        return None;
    };
    let width = reader.positive(width, Dimension::Length);
    let depth = reader.positive(depth, Dimension::Length);
    let (a, b) = (width?, depth?);
    Some(vec![[0.0, 0.0], [a, 0.0], [a, b], [0.0, b]])
}

/// Stiffness of every storey: one value or table, or a list of them from the ground up.
fn of_stiffness(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    floors: &[Tier],
    plans: &[Vec<PlanPoint>],
) -> Vec<TierStorey> {
    let count = floors.len();
    let eccentricity = reader
        .get(view, "eccentricity")
        .and_then(|field| pairs(reader, &field, count));
    let given = match reader.get(view, "stiffness") {
        Some(field) => springs(reader, &field, count),
        None => {
            reader.missing(
                view,
                "stiffness",
                "add stiffness = { x = \"60 MN/m\", y = \"85 MN/m\" }, or [[building.element]]",
            );
            None
        }
    };
    let given: Vec<Option<Spring>> = given.unwrap_or_else(|| vec![None; count]);
    let storeys = floors.iter().zip(plans).zip(given).enumerate();
    storeys
        .map(|(storey, ((floor, plan), spring))| {
            let [x, y, torsion] = spring.unwrap_or([Some(1.0), Some(1.0), Some(1.0)]);
            let x = x.unwrap_or(1.0);
            let y = y.unwrap_or(x);
            let even = || TierStorey::torsion_of_even([x, y], &PlanArea::new(plan));
            let offset = eccentricity
                .as_ref()
                .and_then(|list| list.get(storey).copied());
            let [ex, ey] = offset.unwrap_or_default();
            TierStorey {
                stiffness: [x, y, torsion.unwrap_or_else(even)],
                centre: [floor.centre[0] + ex, floor.centre[1] + ey],
            }
        })
        .collect()
}

/// Stiffness along x, across and in torsion, as far as it is given.
type Spring = [Option<f64>; 3];

/// One for all storeys, or a list from the ground up.
fn springs(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    storeys: usize,
) -> Option<Vec<Option<Spring>>> {
    match field.entries() {
        Some(entries) => has_length(reader, field, entries.len(), Some(storeys))
            .map(|()| entries.iter().map(|entry| spring(reader, entry)).collect()),
        None => Some(vec![spring(reader, field); storeys]),
    }
}

fn spring(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<Spring> {
    if field.named_entries().is_none() {
        let value = reader.quantity(field, Dimension::Stiffness)?;
        return Some([Some(value), None, None]);
    }
    let view = reader.open(field, &[Section::PlanStiffness])?;
    let mut part = |key, dimension| {
        let field = reader.get(&view, key)?;
        reader.quantity(&field, dimension)
    };
    let found = [
        part("x", Dimension::Stiffness),
        part("y", Dimension::Stiffness),
        part("torsion", Dimension::RotationalStiffness),
    ];
    if !view.has("x") {
        reader.missing(&view, "x", "add x = \"60 MN/m\"");
    }
    Some(found)
}

/// Yielding storey springs; the storey then has no elastic stiffness in that direction. They act at the centre of
/// stiffness.
fn of_storeys(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    storeys: &mut [TierStorey],
) -> Vec<PlanSpring> {
    let stiffness: [Vec<f64>; 2] = [0, 1].map(|axis: usize| {
        storeys
            .iter()
            .map(|storey| storey.stiffness[axis])
            .collect()
    });
    let Some(read) = hinges::read_in_plan(
        reader,
        field,
        stiffness.each_ref().map(|stiffness| &stiffness[..]),
    ) else {
        return Vec::new();
    };
    let mut yielding = Vec::new();
    for (storey, tier_storey) in storeys.iter_mut().enumerate() {
        for (axis, springs) in PlanAxis::BOTH.into_iter().zip(&read) {
            let Some(&hysteresis) = springs.get(storey) else {
                continue;
            };
            tier_storey.stiffness[axis.index()] = 0.0;
            yielding.push(PlanSpring {
                element: None,
                storey,
                at: tier_storey.centre,
                axis,
                hysteresis,
            });
        }
    }
    yielding
}

/// Storeys of columns and walls at points of the plan.
struct OfElements {
    /// What stays elastic.
    storeys: Vec<TierStorey>,
    yielding: Vec<PlanSpring>,
    /// Names of all elements; `None` where they have none.
    names: Vec<Option<String>>,
}

/// Storeys from columns and walls at points of the plan.
fn of_elements(reader: &mut Reader<'_>, entries: &[Field<'_>], count: usize) -> OfElements {
    let mut of_storey: Vec<Vec<(PlanPoint, [f64; 2])>> = vec![Vec::new(); count];
    let mut yielding = Vec::new();
    let mut names: Vec<Option<String>> = vec![None; entries.len()];
    for (element, entry) in entries.iter().enumerate() {
        let Some(view) = reader.open(entry, &[Section::Element]) else {
            continue;
        };
        if let Some(field) = reader.get(&view, "name")
            && let Some(name) = reader.text(&field)
        {
            if names.contains(&Some(name.clone())) {
                *reader.bad(&field, "is the name of another element") =
                    Some("give every element a name of its own, or none".into());
            }
            names[element] = Some(name);
        }
        let at = match reader.get(&view, "at") {
            Some(field) => pair(reader, &field),
            None => {
                reader.missing(&view, "at", "add at = [\"0.5 m\", \"0.5 m\"]");
                None
            }
        };
        let range = range(reader, &view, "storeys", count);
        let springs = match reader.get(&view, "stiffness") {
            Some(field) => range.and_then(|[from, to]| springs(reader, &field, to + 1 - from)),
            None => {
                reader.missing(
                    &view,
                    "stiffness",
                    "add stiffness = { x = \"12 MN/m\", y = \"10 MN/m\" }",
                );
                None
            }
        };
        let springs: Option<Vec<Spring>> = springs.and_then(|all| all.into_iter().collect());
        if let (Some(at), Some(springs), Some([from, _])) = (at, springs, range) {
            let whole = springs.iter().map(|[x, y, _]| {
                let x = x.unwrap_or(0.0);
                [x, y.unwrap_or(x)]
            });
            let whole: Vec<[f64; 2]> = whole.collect();
            let hystereses = yielding_of_element(reader, &view, &whole);
            for (index, whole) in whole.into_iter().enumerate() {
                let (storey, mut elastic) = (from - 1 + index, whole);
                for (axis, list) in PlanAxis::BOTH.into_iter().zip(&hystereses) {
                    if let Some(&hysteresis) = list.get(index) {
                        elastic[axis.index()] = 0.0;
                        yielding.push(PlanSpring {
                            element: Some(element),
                            storey,
                            at,
                            axis,
                            hysteresis,
                        });
                    }
                }
                if elastic != [0.0; 2] || hystereses.iter().all(Vec::is_empty) {
                    of_storey[storey].push((at, elastic));
                }
            }
        }
    }
    // From the ground up, as storeys yield.
    sort_by_key(&mut yielding, |spring| spring.storey);
    OfElements {
        storeys: of_storey
            .iter()
            .map(|elements| TierStorey::of_elements(elements))
            .collect(),
        yielding,
        names,
    }
}

/// What yields of an element along x and across, storey by storey.
fn yielding_of_element(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    stiffness: &[[f64; 2]],
) -> [Vec<Hysteresis>; 2] {
    let field = reader.get(view, "hinges");
    let stiffness = [0, 1].map(|axis: usize| {
        stiffness
            .iter()
            .map(|storey| storey[axis])
            .collect::<Vec<f64>>()
    });
    let read = field.and_then(|field| {
        hinges::read_in_plan(
            reader,
            &field,
            stiffness.each_ref().map(|stiffness| &stiffness[..]),
        )
    });
    read.unwrap_or_default()
}

/// Moves buildings to their places: those with `at` there, the others in a row along x, each as far from the one before as
/// the gap between them is wide.
pub(super) fn place(
    buildings: &mut [Building],
    at: &[Option<PlanPoint>],
    gaps: &[Gap],
) -> Vec<PlanPoint> {
    let mut end = 0.0;
    let mut origins = vec![[0.0; 2]; buildings.len()];
    for index in 0..buildings.len() {
        let Structure::Tiers(tiers) = &mut buildings[index].structure else {
            continue;
        };
        let [from, to] = tiers.extent_along();
        let place = at.get(index).copied().flatten().unwrap_or_else(|| {
            let before = index.checked_sub(1);
            let gap = gaps
                .iter()
                .find(|gap| before.is_some() && gap.between == [before, Some(index)]);
            [end + gap.map_or(0.0, Gap::width) - from, 0.0]
        });
        tiers.move_by(place);
        origins[index] = place;
        end = to + place[0];
    }
    origins
}

/// Notes gaps whose width differs from the distance of the plans.
pub(super) fn check_widths(reader: &mut Reader<'_>, model: &mut Model, gaps: &[Field<'_>]) {
    let narrowest: Vec<Option<f64>> = (0..model.gaps.len())
        .map(|gap| narrowest_gap(model, gap))
        .collect();
    // The last one may stand for several.
    let fields = gaps
        .iter()
        .chain(std::iter::repeat_n(gaps.last(), model.gaps.len()).flatten());
    for ((gap, narrowest), field) in model.gaps.iter_mut().zip(narrowest).zip(fields) {
        let Some(narrowest) = narrowest else {
            continue;
        };
        let view = reader.reopen(field, &[Section::Gap]);
        let stated = view.and_then(|view| reader.get(&view, "width"));
        match stated {
            None => gap.widths = vec![narrowest],
            Some(field) if (gap.width() - narrowest).abs() > AGREES => {
                let (width, narrowest) = (gap.width() * 1e3, narrowest * 1e3);
                *reader.bad(
                    &field,
                    format!("is {width:.1} mm, but at and plan put the buildings {narrowest:.1} mm apart"),
                ) = Some("change at, or leave width out".into());
            }
            Some(_) => {}
        }
    }
}
