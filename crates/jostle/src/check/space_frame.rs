//! Faults of space frames.

use std::collections::BTreeSet;

use super::frame_places::OffsetLimits;
use super::{Faults, check_diagonals, check_floor_loads, fibres};
use crate::model::{
    Building, ColumnFibres, Diagonal, DiagonalKind, DiagonalPlace, Reach, SpaceFrame, SpacePlace,
    Tiers,
};

/// Least distance of two lines \[m\].
const APART: f64 = 0.01;

/// Most joints: crossings of lines, times floors.
const MOST_JOINTS: usize = 6000;

pub(super) fn check_space_frame(
    faults: &mut Faults,
    path: &str,
    tiers: &Tiers,
    building: &Building,
) {
    let Some(frame) = &tiers.space_frame else {
        return;
    };
    let before = faults.0.len();
    check_lines(faults, path, frame, tiers.floors.len());
    let mut columns = frame.members.iter();
    let columns_are_rigid = columns.any(|column| {
        matches!(column.place, SpacePlace::Column { .. }) && column.section.axial_rigidity.is_none()
    });
    faults.require(
        !building.gravity.preload || !columns_are_rigid || !frame.fibres.is_empty(),
        format!("{path}.gravity"),
        || "needs columns that shorten under the weight that they carry: take axial = \"flexible\", or leave gravity out".into(),
    );
    check_floor_loads(
        faults,
        path,
        &frame.floor_load,
        tiers.floors.len(),
        |floor| tiers.floors.get(floor).map_or(0.0, |floor| floor.mass),
    );
    for member in &frame.members {
        let section = &member.section;
        let shear = section.shear_rigidity.into_iter().flatten();
        let stiff = section.flexural_rigidity.into_iter().chain(shear);
        let stiff = stiff.chain(section.axial_rigidity);
        let all = stiff.chain([section.torsional_rigidity]);
        let mut all = all.chain(section.size);
        faults.require(
            all.all(|value| value.is_finite() && value > 0.0),
            format!("{path}.{}", key(member.place)),
            || {
                format!(
                    "of {} needs sizes and a modulus greater than 0",
                    name(member.place)
                )
            },
        );
    }
    let is_column = |place| matches!(place, SpacePlace::Column { .. });
    let mut beams = frame
        .members
        .iter()
        .filter(|member| !is_column(member.place));
    if let Some(beam) = beams.find(|beam| beam.hinges[1].is_some()) {
        faults.add(
            format!("{path}.{}", key(beam.place)),
            format!(
                "has a second hinge at {}: beams bend in their vertical plane only, because floors are rigid; leave it out",
                name(beam.place)
            ),
        );
    }
    let mut hinges = frame
        .members
        .iter()
        .flat_map(|member| member.hinges)
        .flatten();
    faults.require(
        hinges.all(|hinge| hinge.falling_branch().is_none()),
        format!("{path}.hinges"),
        || "cannot lose their strength in a space frame; take another rule".into(),
    );
    let mut shear = frame.shear.values();
    faults.require(
        shear.all(|column| column.spring.falling_branch().is_some()),
        format!("{path}.shear_failure"),
        || "takes springs that lose their strength, from Hysteresis::failing".into(),
    );
    let stands = |place: SpacePlace| {
        let mut members = frame.members.iter();
        is_column(place) && members.any(|member| member.place == place)
    };
    if let Some((place, _)) = frame.shear.keys().find(|(place, _)| !stands(*place)) {
        faults.add(
            format!("{path}.shear_failure"),
            format!("lets {} fail, and there is none", name(*place)),
        );
    }
    // Of walls their own, of columns those of the building.
    let field = |place: &SpacePlace| match frame.walls.iter().any(|wall| wall.has(*place)) {
        true => format!("{path}.wall"),
        false => format!("{path}.hinges"),
    };
    if let Some((place, _)) = frame.fibres.first_key_value() {
        fibres::check_weight(faults, &field(place), building);
    }
    for (place, member_fibres) in &frame.fibres {
        check_fibres(faults, &field(place), frame, *place, member_fibres);
    }
    if faults.0.len() > before {
        return;
    }
    check_places(faults, path, frame, tiers.floors.len());
    check_diagonals(faults, path, &frame.diagonals, |diagonal| {
        fault_of_diagonal(frame, tiers.floors.len(), diagonal.place)
            .or_else(|| fault_of_offsets(frame, &tiers.storey_heights, diagonal))
    });
    if frame.ends_of_struts(&tiers.storey_heights).next().is_some()
        && let Some(problem) = fault_of_column_masses(tiers)
    {
        faults.add(
            format!("{path}.infill.offset"),
            format!("lets struts meet columns between floors, {problem}"),
        );
    }
    if faults.0.len() == before {
        check_standing(faults, path, frame, tiers.floors.len());
        check_rigid_zones(faults, path, frame, &tiers.storey_heights);
    }
}

/// What is wrong with the place of a diagonal: it is not in the grid, or ends where there is no joint.
fn fault_of_diagonal(frame: &SpaceFrame, floors: usize, place: DiagonalPlace) -> Option<String> {
    let lines = [&frame.lines_x, &frame.lines_y].map(Vec::len);
    let reach = place.reach;
    let crosses = reach == Reach::BAY || (place.kind == DiagonalKind::Brace && reach.storeys > 0);
    let line = place.line.filter(|line| {
        let across = 1..=lines[1 - line.along.index()];
        let upper = line.number.checked_add_signed(reach.across);
        across.contains(&line.number)
            && upper.is_some_and(|upper| across.contains(&upper))
            && place.bay > 0
            && place.bay + reach.bays <= lines[line.along.index()]
            && place.storey > 0
            && place.floors()[1] <= floors
    });
    let Some([lower, upper]) = line.filter(|_| crosses).and_then(|_| place.crossings()) else {
        return Some(format!(
            "{place} is in no bay of a grid of {} lines along x and {} across, with {floors} storeys, counted from 1",
            lines[1], lines[0]
        ));
    };
    let [low, high] = place.floors();
    let keeps_length = |storey| {
        let column = SpacePlace::Column {
            line: lower,
            storey,
        };
        let mut members = frame.members.iter();
        let column = members.find(|member| member.place == column);
        column.is_some_and(|column| column.section.axial_rigidity.is_none())
    };
    if lower == upper && (low..high).all(keeps_length) {
        return Some(format!(
            "{place} is next to axially rigid columns, so it carries no force; take axial = \"flexible\", or leave it out"
        ));
    }
    let stands = |line: &[usize; 2]| {
        let (line, storey) = (*line, low);
        let column = SpacePlace::Column { line, storey };
        frame.members.iter().any(|member| member.place == column)
    };
    let mut crossings = [lower, upper].into_iter();
    let lacking = crossings.find(|line| !stands(line));
    if let Some([x, y]) = lacking.filter(|_| place.kind == DiagonalKind::Infill) {
        return Some(format!(
            "{place} fills a bay without a column at x = {}, y = {}; leave it out there, or add the column",
            x + 1,
            y + 1
        ));
    }
    let mut loose = [(low, lower), (high, upper)].into_iter();
    let (floor, [x, y]) = loose.find(|(floor, at)| !frame.has_joint(*floor, *at))?;
    Some(format!(
        "{place} ends at x = {}, y = {} of floor {floor}, where there is no joint; leave it out there, or add the column",
        x + 1,
        y + 1
    ))
}

/// What is wrong with where the ends of a diagonal, whose place is sound, meet the columns.
fn fault_of_offsets(frame: &SpaceFrame, heights: &[f64], diagonal: &Diagonal) -> Option<String> {
    let crossings = diagonal.place.crossings()?;
    let storey = diagonal.place.storey - 1;
    let ends = [0, 1].map(|end| {
        let line = crossings[end];
        let column = SpacePlace::Column { line, storey };
        let mut members = frame.members.iter();
        let stands = members.any(|member| member.place == column);
        let rigid = frame.rigid_ends(column)[end];
        (diagonal.offsets[end], stands.then_some(rigid), column)
    });
    let limits = OffsetLimits {
        place: diagonal.place,
        storey_height: heights[storey],
    };
    ends.into_iter().find_map(|(offset, rigid, column)| {
        let Some(rigid) = rigid else {
            return (offset != 0.0).then(|| {
                format!(
                    "{} meets {} between floors, and there is none; leave offset and struts out there, or add the column",
                    diagonal.place,
                    name(column)
                )
            });
        };
        limits.fault(&name(column), offset, rigid)
    })
}

/// Why points of columns cannot take the mass of these from the floors; `None` if floors are heavier than half of all columns below and
/// above them.
pub(super) fn fault_of_column_masses(tiers: &Tiers) -> Option<String> {
    let frame = tiers.space_frame.as_ref()?;
    let mut halves = vec![0.0; tiers.floors.len()];
    for member in &frame.members {
        let SpacePlace::Column { storey, .. } = member.place else {
            continue;
        };
        let length = tiers.storey_heights.get(storey).copied().unwrap_or(0.0);
        let half = 0.5 * member.section.line_mass * length;
        let floors = [storey.checked_sub(1), Some(storey)];
        for floor in floors.into_iter().flatten() {
            if let Some(sum) = halves.get_mut(floor) {
                *sum += half;
            }
        }
    }
    let mut floors = halves.into_iter().zip(&tiers.floors).enumerate();
    let (floor, (half, tier)) = floors.find(|(_, (half, floor))| floor.mass <= *half)?;
    Some(format!(
        "whose mass is a part of that of the floors: floor {} has {:.0} kg, and half of the columns below and above it {half:.0} kg; give mass with all columns",
        floor + 1,
        tier.mass
    ))
}

/// Faults of the rigid ends of columns and beams.
fn check_rigid_zones(faults: &mut Faults, path: &str, frame: &SpaceFrame, heights: &[f64]) {
    let field = format!("{path}.rigid_ends");
    for ([floor, x, y], zone) in &frame.rigid_zones {
        let sound = zone.iter().all(|zone| *zone >= 0.0 && zone.is_finite());
        faults.require(sound && frame.has_joint(floor + 1, [*x, *y]), field.as_str(), || {
            format!(
                "gives x = {}, y = {} at floor {} rigid ends of {zone:?} m; they must not be negative, and a joint must be there",
                x + 1,
                y + 1,
                floor + 1
            )
        });
    }
    let mut members = frame.members.iter();
    if let Some(member) = members.find(|member| frame.clear_length(member.place, heights) <= 0.0) {
        let [first, last] = frame.rigid_ends(member.place);
        faults.add(field, format!(
            "leaves no length between the joints of {}: its {} m hold {first} m and {last} m of rigid ends; give less",
            name(member.place),
            frame.length(member.place, heights)
        ));
    }
}

/// Fibres at the ends of a column.
fn check_fibres(
    faults: &mut Faults,
    path: &str,
    frame: &SpaceFrame,
    place: SpacePlace,
    fibres: &ColumnFibres,
) {
    let mut members = frame.members.iter();
    let column = members.find(|member| member.place == place);
    let column = column.filter(|_| matches!(place, SpacePlace::Column { .. }));
    let Some(column) = column else {
        faults.add(
            path,
            format!("has fibres where there is no column: at {}", name(place)),
        );
        return;
    };
    faults.require(column.section.axial_rigidity.is_some(), path, || {
        "needs columns that change their length: without it their axial force is not known; take axial = \"flexible\"".into()
    });
    faults.require(!column.may_yield(), path, || {
        format!("has both hinges and fibres at {}; keep either", name(place))
    });
    fibres::check_fibres(faults, path, fibres, true);
}

/// The key of a member in a model file.
fn key(place: SpacePlace) -> &'static str {
    match place {
        SpacePlace::Column { .. } => "column",
        SpacePlace::BeamX { .. } => "beam_x",
        SpacePlace::BeamY { .. } => "beam_y",
    }
}

/// A place in words, counted from 1.
fn name(place: SpacePlace) -> String {
    let [[x, y], _] = place.crossings();
    let (x, y, level) = (x + 1, y + 1, place.storey() + 1);
    match place {
        SpacePlace::Column { .. } => format!("the column at x = {x}, y = {y} in storey {level}"),
        SpacePlace::BeamX { .. } => {
            format!("the beam from x = {x} on line y = {y} at floor {level}")
        }
        SpacePlace::BeamY { .. } => {
            format!("the beam from y = {y} on line x = {x} at floor {level}")
        }
    }
}

fn check_lines(faults: &mut Faults, path: &str, frame: &SpaceFrame, floors: usize) {
    for (key, lines) in [("lines_x", &frame.lines_x), ("lines_y", &frame.lines_y)] {
        let rising = lines.windows(2).all(|pair| pair[1] - pair[0] >= APART);
        let finite = lines.iter().all(|line| line.is_finite());
        faults.require(
            !lines.is_empty() && finite && rising,
            format!("{path}.{key}"),
            || "must rise from line to line, by 10 mm at least, such as [\"0 m\", \"6 m\", \"11 m\"]".into(),
        );
    }
    faults.require(
        frame.lines_x.len() + frame.lines_y.len() > 2,
        format!("{path}.lines_x"),
        || "has a single line, as has lines_y: a space frame needs two columns at least".into(),
    );
    let joints = frame
        .lines_x
        .len()
        .saturating_mul(frame.lines_y.len())
        .saturating_mul(floors);
    faults.require(joints <= MOST_JOINTS, format!("{path}.lines_x"), || {
        format!(
            "gives {joints} joints with lines_y and all floors; at most {MOST_JOINTS} are possible"
        )
    });
    let length = libm::hypot(frame.direction[0], frame.direction[1]);
    let finite = frame.at.iter().all(|value| value.is_finite());
    faults.require(
        finite && (length - 1.0).abs() < 1e-9,
        format!("{path}.angle"),
        || "must be the angle from x of the site to the lines along x, counter-clockwise, such as \"30 deg\"".into(),
    );
}

/// Places that the grid does not have, or that are taken twice.
fn check_places(faults: &mut Faults, path: &str, frame: &SpaceFrame, floors: usize) {
    let mut taken = BTreeSet::new();
    for member in &frame.members {
        let place = member.place;
        let inside = place
            .crossings()
            .iter()
            .all(|[x, y]| *x < frame.lines_x.len() && *y < frame.lines_y.len());
        faults.require(
            inside && place.storey() < floors,
            format!("{path}.{}", key(place)),
            || format!("has {}, which the grid does not have", name(place)),
        );
        faults.require(
            taken.insert(place),
            format!("{path}.{}", key(place)),
            || format!("has {} twice; keep one", name(place)),
        );
    }
}

/// Storeys without columns, and members that nothing joins to the ground.
fn check_standing(faults: &mut Faults, path: &str, frame: &SpaceFrame, floors: usize) {
    let is_column = |place: SpacePlace| matches!(place, SpacePlace::Column { .. });
    for storey in 0..floors {
        let mut members = frame.members.iter();
        let held = members.any(|member| is_column(member.place) && member.place.storey() == storey);
        faults.require(held, format!("{path}.column"), || {
            format!(
                "leaves storey {} without columns; keep one at least in every storey",
                storey + 1
            )
        });
    }
    // Joint 0 is the ground.
    let crossings = frame.lines_x.len() * frame.lines_y.len();
    let joint = |level: usize, [x, y]: [usize; 2]| match level {
        0 => 0,
        level => 1 + (level - 1) * crossings + y * frame.lines_x.len() + x,
    };
    let ends = |place: SpacePlace| {
        let [first, last] = place.crossings();
        let level = place.storey() + 1;
        let below = if is_column(place) { level - 1 } else { level };
        [joint(below, first), joint(level, last)]
    };
    let mut neighbours = vec![Vec::new(); 1 + crossings * floors];
    for member in &frame.members {
        let [a, b] = ends(member.place);
        neighbours[a].push(b);
        neighbours[b].push(a);
    }
    let mut reached = vec![false; neighbours.len()];
    reached[0] = true;
    let mut open = vec![0];
    while let Some(joint) = open.pop() {
        for next in &neighbours[joint] {
            if !std::mem::replace(&mut reached[*next], true) {
                open.push(*next);
            }
        }
    }
    let mut members = frame.members.iter();
    if let Some(loose) = members.find(|member| !reached[ends(member.place)[0]]) {
        faults.add(
            format!("{path}.{}", key(loose.place)),
            format!(
                "has {}, which no column or beam joins to the ground; remove it with omit = true, or add the column below it",
                name(loose.place)
            ),
        );
    }
}
