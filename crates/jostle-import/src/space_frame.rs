//! Regular frames of text models as `kind = "space-frame"`: rectangular columns and beams on the lines of a grid.

use std::collections::BTreeMap;
use std::fmt::Write;

use jostle_io::InputError;

use crate::facts::{Facts, Point};
use crate::given::{Built, digits, head, plans, point, quantities};
use crate::left_out::softer;
use crate::member::{Member, SectionFacts, TextModel};

/// Joints nearer than this stand on one line \[m\].
const ONE_LINE: f64 = 0.002;
/// Most lines in one direction.
const MOST_LINES: usize = 60;
/// Remedy for what a space frame cannot hold.
const BY_TABLES: &str = "take the stiffness from results instead: run load cases with a unit force along X, along Y and a unit moment on every diaphragm, export Diaphragm Center Of Mass Displacements as .xlsx and name it beside this file";

/// Place of a member in the grid: line along x, line along y, storey, each from 1.
type Place = [usize; 3];

/// A section in a model file, without its place.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Entry(String);

/// Columns, beams along x and beams along y, by place.
type Places = BTreeMap<Place, Entry>;

/// Makes a space frame of a text model.
///
/// # Errors
/// What is not regular, with the member, and what helps.
pub(crate) fn build(facts: &mut Facts, model: &TextModel) -> Result<Built, InputError> {
    let refuse = |object: &str, problem: String| {
        Err(crate::facts::fault(&model.file, object, problem, BY_TABLES))
    };
    if let Some(name) = model.semirigid.first() {
        return refuse(
            &format!("diaphragm \"{name}\""),
            "is semi-rigid, but floors of jostle are rigid in their plane".into(),
        );
    }
    if let Some(wall) = model.walls.first() {
        return refuse(
            &wall.shown,
            format!(
                "is one of {} walls; a space frame has columns and beams alone",
                model.walls.len()
            ),
        );
    }
    let loose = model
        .supports
        .iter()
        .find(|support| support.held != [true; 6]);
    if let Some(foot) = loose.map(|loose| &loose.shown).or(model.on_springs.first()) {
        return refuse(foot, "is not fixed; columns of a space frame are".into());
    }
    if model.members.is_empty() {
        return refuse("", "has no columns or beams".into());
    }
    let floors = facts.floors()?;
    let base = facts.base_height();
    let on_floor = |at: &[f64; 3]| {
        let is = |floor: &crate::facts::Floor| (floor.height + base - at[2]).abs() < ONE_LINE;
        floors.iter().any(is)
    };
    let of_member = |at: &[f64; 3]| {
        let near = |end: &[f64; 3]| (0..3).all(|axis| (end[axis] - at[axis]).abs() < ONE_LINE);
        model
            .members
            .iter()
            .any(|member| member.ends.iter().any(near))
    };
    let free = model.disconnected.iter().filter(|at| on_floor(at));
    if let Some(at) = free.into_iter().find(|at| of_member(at)) {
        let [x, y, z] = at.map(|coordinate| format!("{coordinate:.3}"));
        return refuse(
            &format!("the joint at {x}, {y}, {z} m"),
            "does not move with the rigid floor; every joint of a space frame does".into(),
        );
    }
    let uneven = |floor: &&crate::facts::Floor| {
        (floor.mass[0] - floor.mass[1]).abs() > 1e-6 * floor.mass[0].max(floor.mass[1])
    };
    if let Some(floor) = floors.iter().find(uneven) {
        return refuse(
            &format!("storey \"{}\"", floor.name),
            "has different masses along X and Y; a floor of a space frame has one".into(),
        );
    }
    if floors.len() != facts.stories.len() {
        let missing = facts
            .stories
            .iter()
            .find(|story| floors.iter().all(|floor| floor.name != story.name));
        let name = missing.map_or("", |story| story.name.as_str());
        return refuse(
            &format!("storey \"{name}\""),
            "has no rigid diaphragm with mass; every floor of a space frame has".into(),
        );
    }
    let mut levels = vec![facts.base_height()];
    levels.extend(facts.stories.iter().map(|story| story.top));
    let level_of = |z: f64| levels.iter().position(|level| (level - z).abs() < ONE_LINE);
    let lines = [0, 1].map(|axis| {
        lines(
            model
                .members
                .iter()
                .flat_map(|member| member.ends.map(|end| end[axis]))
                .collect(),
        )
    });
    if lines.iter().any(|lines| lines.len() > MOST_LINES) {
        let [x, y] = lines.each_ref().map(Vec::len);
        return refuse(
            "",
            format!("has joints on {x} by {y} lines; a grid of at most {MOST_LINES} is regular"),
        );
    }
    let line_of = |axis: usize, at: f64| {
        lines[axis]
            .iter()
            .position(|line| (line - at).abs() <= 2.0 * ONE_LINE)
    };
    let mut places: [Places; 3] = Default::default();
    let mut seen = Sections::default();
    let mut ties = 0;
    for member in &model.members {
        let [mut a, mut b] = member.ends;
        if a[2] > b[2] {
            std::mem::swap(&mut a, &mut b);
        }
        let shown = member.shown.as_str();
        if member.is_released() {
            return refuse(
                shown,
                "has releases at its ends; joints of a space frame are stiff".into(),
            );
        }
        let size = seen.size_of(member, model)?;
        let kind = member_kind(member);
        let (Some(lower), Some(upper)) = (level_of(a[2]), level_of(b[2])) else {
            return refuse(shown, "ends between storeys".into());
        };
        // Every coordinate is on a line.
        let at = |end: [f64; 3]| {
            [
                line_of(0, end[0]).unwrap_or(0),
                line_of(1, end[1]).unwrap_or(0),
            ]
        };
        let ([x0, y0], [x1, y1]) = (at(a), at(b));
        let pieces: Vec<Place> = match kind {
            Some(0) if upper == lower + 1 => vec![[x0, y0, lower]],
            Some(0) => return refuse(shown, "stands over several storeys".into()),
            Some(_) if lower == 0 => {
                ties += 1;
                continue;
            }
            Some(1) => (x0.min(x1)..x0.max(x1))
                .map(|x| [x, y0, lower - 1])
                .collect(),
            Some(_) => (y0.min(y1)..y0.max(y1))
                .map(|y| [x0, y, lower - 1])
                .collect(),
            None => return refuse(shown, "is neither vertical nor along X or Y".into()),
        };
        let kind = kind.unwrap_or(0);
        let entry = seen.entry(kind, member, size, model)?;
        for place in pieces {
            if places[kind]
                .insert(place.map(|place| place + 1), entry.clone())
                .is_some()
            {
                return refuse(shown, "lies where another member is".into());
            }
        }
    }
    if ties > 0 {
        facts.left_out.push(format!(
            "{}: {ties} beams at the level of the fixed feet, which cannot bend there",
            model.file
        ));
    }
    let lengths = model
        .members
        .iter()
        .any(|member| member.stiff_ends.iter().any(|end| *end != 0.0));
    if lengths {
        facts.left_out.push(format!("{}: stiff end lengths of members: those of a space frame bend from joint to joint, so that periods are longer; --by members takes them", model.file));
    }
    softer(facts, model);
    if places[0].is_empty() {
        return refuse("", "has no columns".into());
    }
    let Some((plan, origin)) = plans(facts, &floors) else {
        return refuse("", "has no outline of its floors".into());
    };
    let mut block = head(facts, "space-frame");
    let mut below = 0.0;
    let heights: Vec<f64> = floors
        .iter()
        .map(|floor| floor.height - std::mem::replace(&mut below, floor.height))
        .collect();
    let _ = writeln!(
        block,
        "storey_height = {}",
        quantities(heights.into_iter(), "m")
    );
    for (axis, name) in ["lines_x", "lines_y"].into_iter().enumerate() {
        let _ = writeln!(
            block,
            "{name} = {}",
            quantities(lines[axis].iter().map(|line| line - origin[axis]), "m")
        );
    }
    block.push_str(&plan);
    let mut remarks = vec!["outline of floors: convex hull of their joints, without projecting slabs and re-entrant corners: correct plan where a neighbour is near".to_owned()];
    let _ = writeln!(
        block,
        "mass = {}",
        quantities(
            floors
                .iter()
                .map(|floor| 0.5e-3 * (floor.mass[0] + floor.mass[1])),
            "t"
        )
    );
    let centres: Option<Vec<String>> = floors
        .iter()
        .map(|floor| {
            floor
                .centre
                .map(|[x, y]| point([x - origin[0], y - origin[1]]))
        })
        .collect();
    let inertias: Option<Vec<f64>> = floors.iter().map(|floor| floor.inertia).collect();
    match (centres, inertias) {
        (Some(centres), Some(inertias)) => {
            let _ = writeln!(block, "mass_centre = [{}]", centres.join(", "));
            let _ = writeln!(block, "polar_mass = {}", quantities(inertias.into_iter(), "kg.m2"));
        }
        _ => remarks.push("masses are spread evenly over the plan: the tables have no centres and moments of inertia".into()),
    }
    seen.write(&mut block, &mut remarks);
    // What lies outside of the outline does not exist and cannot be left out.
    let outlines: Vec<Vec<Point>> = floors
        .iter()
        .map(|floor| facts.outline(&floor.name).unwrap_or_default())
        .collect();
    let missing = |ends: [Place; 2]| {
        let [a, b] = ends.map(|[x, y, _]| [lines[0][x - 1], lines[1][y - 1]]);
        let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        [a, middle, b]
            .iter()
            .all(|point| lies_in(&outlines[ends[0][2] - 1], *point))
    };
    let shape = [lines[0].len(), lines[1].len(), floors.len()];
    for (name, occupied, less) in [
        ("column", &places[0], [0, 0, 0]),
        ("beam_x", &places[1], [1, 0, 0]),
        ("beam_y", &places[2], [0, 1, 0]),
    ] {
        let count = [0, 1, 2].map(|axis| shape[axis] - less[axis].min(shape[axis]));
        write_members(&mut block, name, occupied, count, &missing);
    }
    remarks.push(format!(
        "{} columns; {} beam segments along X and {} along Y, on a grid of {} by {} lines",
        places[0].len(),
        places[1].len(),
        places[2].len(),
        shape[0],
        shape[1]
    ));
    Ok(Built {
        block,
        arrays: None,
        remarks,
        in_space: true,
        axis: 0,
    })
}

/// 0 for a column, 1 for a beam along x, 2 for a beam along y.
fn member_kind(member: &Member) -> Option<usize> {
    let [a, b] = member.ends;
    let across = [0, 1, 2].map(|axis| (a[axis] - b[axis]).abs() > ONE_LINE);
    match across {
        [false, false, true] => Some(0),
        [true, false, false] => Some(1),
        [false, true, false] => Some(2),
        _ => None,
    }
}

/// Places of lines: coordinates that lie together are one line, at their median, which is one of them.
fn lines(mut at: Vec<f64>) -> Vec<f64> {
    at.sort_by(f64::total_cmp);
    let together = at.chunk_by(|a, b| b - a <= ONE_LINE);
    together
        .map(|together| together[(together.len() - 1) / 2])
        .collect()
}

/// What the members have in common.
#[derive(Default)]
struct Sections {
    /// Modulus of the first member \[Pa\], and Poisson's ratio.
    material: Option<[f64; 2]>,
    other_poisson: bool,
    /// Factors on EI of columns and beams, by kind.
    factors: [Option<f64>; 2],
    torsion: Option<f64>,
    other_torsion: bool,
    other_areas: bool,
}

impl Sections {
    /// Depth and width of a rectangle.
    fn size_of(&self, member: &Member, model: &TextModel) -> Result<[f64; 2], InputError> {
        let refuse = |problem: String, remedy: &str| {
            Err(crate::facts::fault(
                &model.file,
                member.shown.clone(),
                problem,
                remedy,
            ))
        };
        let name = &member.section;
        let Some(section) = model.sections.get(name).filter(|_| !name.is_empty()) else {
            return refuse(
                format!("has the section \"{name}\", which the file does not define"),
                BY_TABLES,
            );
        };
        let rectangle = ["Concrete Rectangular", "Rectangular"].contains(&section.shape.as_str());
        match section.size {
            [Some(depth), Some(width)] if rectangle && depth > 0.0 && width > 0.0 => {
                Ok([depth, width])
            }
            _ if section.shape.contains("Auto Select") => refuse(
                format!("has the auto-select list \"{name}\": its section is chosen in design"),
                "assign the chosen sections in the source and export again",
            ),
            _ if section.size == [None, None] => refuse(
                format!(
                    "has the section \"{name}\" of shape \"{}\", of which the file has only the name in a catalogue",
                    section.shape
                ),
                BY_TABLES,
            ),
            _ => refuse(
                format!(
                    "has the section \"{name}\" of shape \"{}\"; sections of a space frame are rectangles",
                    section.shape
                ),
                BY_TABLES,
            ),
        }
    }

    /// The keys of a member.
    fn entry(
        &mut self,
        kind: usize,
        member: &Member,
        [depth, width]: [f64; 2],
        model: &TextModel,
    ) -> Result<Entry, InputError> {
        let refuse = |problem: String| {
            Err(crate::facts::fault(
                &model.file,
                member.shown.clone(),
                problem,
                BY_TABLES,
            ))
        };
        let none = SectionFacts::default();
        let section = model.sections.get(&member.section).unwrap_or(&none);
        let name = member.material(section);
        let material = model.materials.get(name);
        let Some([modulus, poisson]) = material.copied().filter(|material| material[0] > 0.0)
        else {
            return refuse(format!(
                "has the material \"{name}\", which has no modulus of elasticity"
            ));
        };
        let [area, shear_2, shear_3, torsion, weak, strong] = member.factors_with(section);
        let of_kind = usize::from(kind > 0);
        if kind == 0 && strong != weak {
            return refuse(format!(
                "has different factors on I33 and I22 (section \"{}\"); a space frame has one",
                member.section
            ));
        }
        if *self.factors[of_kind].get_or_insert(strong) != strong {
            return refuse(format!(
                "has a factor of {strong} on I33 (section \"{}\"), others have another; a space frame has one for all columns and one for all beams",
                member.section
            ));
        }
        self.other_torsion |= *self.torsion.get_or_insert(torsion) != torsion;
        self.other_areas |= [area, shear_2, shear_3] != [1.0; 3];
        let first = *self.material.get_or_insert([modulus, poisson]);
        self.other_poisson |= first[1] != poisson;
        let mut text = match kind {
            0 => {
                // Axis 2 of a column, along its depth, is X unless it is turned.
                let quarters = (member.angle / 90.0).round();
                if (member.angle - 90.0 * quarters).abs() > 0.01 {
                    return refuse(format!(
                        "is turned by {}°; sections of a space frame stand along its lines",
                        member.angle
                    ));
                }
                let size = if quarters % 2.0 == 0.0 {
                    [depth, width]
                } else {
                    [width, depth]
                };
                format!("size = {}", quantities(size.into_iter(), "m"))
            }
            _ if member.angle != 0.0 => {
                return refuse(format!("is turned by {}° about its axis", member.angle));
            }
            _ => format!(
                "width = \"{} m\"\ndepth = \"{} m\"",
                digits(width),
                digits(depth)
            ),
        };
        if modulus != first[0] {
            let _ = write!(
                text,
                "\nelastic_modulus = \"{} MPa\"",
                digits(modulus * 1e-6)
            );
        }
        Ok(Entry(text))
    }

    /// The keys that hold for all members.
    fn write(&self, block: &mut String, remarks: &mut Vec<String>) {
        if let Some([modulus, poisson]) = self.material {
            let _ = writeln!(
                block,
                "elastic_modulus = \"{} MPa\"\npoisson_ratio = {}",
                digits(modulus * 1e-6),
                digits(poisson)
            );
        }
        let [column, beam] = self.factors.map(|factor| factor.unwrap_or(1.0));
        if [column, beam] != [1.0; 2] {
            let _ = writeln!(
                block,
                "stiffness_factor = {{ column = {}, beam = {} }}",
                digits(column),
                digits(beam)
            );
        }
        if let Some(torsion) = self.torsion.filter(|torsion| *torsion != 1.0) {
            let _ = writeln!(block, "torsion_factor = {}", digits(torsion));
        }
        block.push_str("shear = \"flexible\"               # as the source has it\n");
        if self.other_torsion {
            remarks
                .push("factors on torsion differ; that of the first member holds for all, so that periods in torsion differ by some percent: --by members takes each".into());
        }
        if self.other_poisson {
            remarks.push("Poisson's ratios differ; that of the first member holds for all, so that stiffness in shear and torsion differs: --by members takes each".into());
        }
        if self.other_areas {
            remarks
                .push("factors on areas are not carried over: members have the whole area, and are stiffer than the source's: --by members takes them".into());
        }
    }
}

/// Whether a point lies in a convex outline, or within a centimetre of it, as the reader of models has it.
fn lies_in(outline: &[Point], [x, y]: Point) -> bool {
    let next = outline.iter().cycle().skip(1);
    outline.iter().zip(next).all(|(a, b)| {
        let along = [b[0] - a[0], b[1] - a[1]];
        let away = along[0] * (y - a[1]) - along[1] * (x - a[0]);
        away >= -0.01 * along[0].hypot(along[1])
    })
}

/// First and last of the places, of which there are `count` along each axis.
type Box = [[usize; 2]; 3];

/// Writes the members of a kind: the commonest everywhere, then those that differ and those that are missing.
fn write_members(
    block: &mut String,
    name: &str,
    places: &Places,
    count: Place,
    exists: &dyn Fn([Place; 2]) -> bool,
) {
    let end = |[x, y, storey]: Place| match name {
        "beam_x" => [x + 1, y, storey],
        "beam_y" => [x, y + 1, storey],
        _ => [x, y, storey],
    };
    let mut kinds: BTreeMap<Option<&Entry>, Vec<Place>> = BTreeMap::new();
    for x in 1..=count[0] {
        for y in 1..=count[1] {
            for storey in 1..=count[2] {
                let place = [x, y, storey];
                if !places.contains_key(&place) && !exists([place, end(place)]) {
                    continue;
                }
                kinds.entry(places.get(&place)).or_default().push(place);
            }
        }
    }
    let common = kinds
        .iter()
        .filter(|kind| kind.0.is_some())
        .max_by_key(|kind| kind.1.len())
        .and_then(|kind| *kind.0);
    // Beams may be missing in one direction altogether.
    let Some(common) = common else {
        if count.iter().all(|count| *count > 0) {
            let _ = writeln!(block, "\n[[building.{name}]]\nomit = true");
        }
        return;
    };
    let _ = writeln!(block, "\n[[building.{name}]]\n{}", common.0);
    for (entry, places) in kinds.iter().filter(|kind| *kind.0 != Some(common)) {
        for region in boxes(places) {
            let _ = writeln!(block, "\n[[building.{name}]]");
            for ((key, [first, last]), count) in
                ["x", "y", "storeys"].into_iter().zip(region).zip(count)
            {
                let _ = match () {
                    () if first == 1 && last == count => Ok(()),
                    () if first == last => writeln!(block, "{key} = {first}"),
                    () => writeln!(block, "{key} = [{first}, {last}]"),
                };
            }
            let _ = writeln!(block, "{}", entry.map_or("omit = true", |entry| &entry.0));
        }
    }
}

/// Places as few boxes: runs over storeys, then over y, then over x.
fn boxes(places: &[Place]) -> Vec<Box> {
    let mut found: Vec<Box> = places
        .iter()
        .map(|place| place.map(|place| [place, place]))
        .collect();
    for axis in [2, 1, 0] {
        let others = |region: &Box| {
            let mut region = *region;
            region[axis] = [0, 0];
            region
        };
        found.sort_by_key(|region| (others(region), region[axis]));
        let mut merged: Vec<Box> = Vec::new();
        for region in found {
            match merged.last_mut() {
                Some(last)
                    if others(last) == others(&region) && last[axis][1] + 1 == region[axis][0] =>
                {
                    last[axis][1] = region[axis][1];
                }
                _ => merged.push(region),
            }
        }
        found = merged;
    }
    found
}
