//! Walls and rigid zones of a frame that do not fit it, and beams between walls.

use super::{Faults, each, fibres};
use crate::model::{Frame, FrameWall, WallHinge};

/// Faults of walls and coupling beams. Lengths of lists are right.
pub(super) fn check_walls(faults: &mut Faults, path: &str, frame: &Frame) {
    let (storeys, lines, bays) = (frame.storey_heights.len(), frame.lines(), frame.spans.len());
    for (index, (field, wall)) in each(&frame.walls, &format!("{path}.wall")).enumerate() {
        let ([first, last], line) = (wall.storeys, wall.line);
        faults.positive(wall.length, format!("{field}.length"), "m");
        let inside = 1 <= first && first <= last && last <= storeys && (1..=lines).contains(&line);
        if !inside {
            faults.add(field, format!(
                "stands at line {line} in storeys {first} to {last}, but there are {lines} column lines and {storeys} storeys, counted from 1"
            ));
            continue;
        }
        let has_section = |storey: usize| frame.column(storey, line - 1).is_some();
        faults.require((first - 1..last).all(has_section), field.as_str(), || {
            format!("has no section at line {line} in every storey from {first} to {last}; a wall is a column of the frame as well")
        });
        let astray = wall.hinges.iter().enumerate().find(|(index, hinge)| {
            let before = wall.hinges[..*index].iter();
            let mut same = before
                .filter(|other| (other.storey, other.at_head) == (hinge.storey, hinge.at_head));
            !(first..=last).contains(&hinge.storey) || same.next().is_some()
        });
        if let Some((_, hinge)) = astray {
            faults.add(format!("{field}.hinge"), format!(
                "stands in storey {}, where the wall has none or another one already; it has storeys {first} to {last}",
                hinge.storey
            ));
        }
        check_fibres_of(faults, &format!("{field}.hinge"), frame, wall);
        let shared = frame.walls[..index].iter().position(|other| {
            other.line == line && other.storeys[0] <= last && first <= other.storeys[1]
        });
        if let Some(other) = shared {
            faults.add(field, format!(
                "stands at line {line} in storeys in which wall {} stands already; give them other storeys",
                other + 1
            ));
        }
    }
    check_rigid_zones(faults, path, frame);
    if frame.walls.is_empty() && frame.coupling_beams.is_empty() {
        return;
    }
    let mut said = Vec::new();
    for floor in 0..storeys {
        for bay in (0..bays).filter(|bay| frame.beam(floor, *bay).is_some()) {
            let clear = frame.clear_span([floor, bay]);
            let beside_walls = [bay, bay + 1].map(|line| stands_at(frame, [floor, line]));
            if clear > 0.0 || said.contains(&bay) || beside_walls == [false; 2] {
                continue;
            }
            said.push(bay);
            let arms = [bay, bay + 1].map(|line| frame.arm([floor, line]));
            faults.add(format!("{path}.wall"), format!(
                "no clear span is left for the beam of bay {}: its {} m hold {} m of the wall on the left and {} m of that on the right; make the walls shorter or the bay wider",
                bay + 1,
                frame.spans[bay],
                arms[0],
                arms[1]
            ));
        }
    }
    for (field, beam) in each(&frame.coupling_beams, &format!("{path}.coupling_beam")) {
        let exists = (1..=storeys).contains(&beam.floor) && (1..=bays).contains(&beam.bay);
        if !exists {
            faults.add(field, format!(
                "is at floor {} in bay {}, but there are {storeys} floors and {bays} bays, counted from 1",
                beam.floor, beam.bay
            ));
            continue;
        }
        let place = [beam.floor - 1, beam.bay - 1];
        let column = (0..2).find(|side| !stands_at(frame, [place[0], place[1] + side]));
        if let Some(side) = column {
            faults.add(field, format!(
                "ends at line {} at floor {}, where no wall stands; add the wall, name only floors at which both walls stand (floors = [1, 2]), or leave the table out: the beam of the frame spans the bay then",
                beam.bay + side,
                beam.floor
            ));
        }
    }
    for diagonal in &frame.diagonals {
        if diagonal.place.storey == 0 {
            continue;
        }
        // In the storeys within its ends, and where it crosses one bay at least.
        let ([low, high], lines) = (diagonal.place.floors(), diagonal.place.lines());
        let ends = [(low, lines[0]), (high.saturating_sub(1), lines[1])];
        let mut walls = ends
            .into_iter()
            .filter_map(|place| frame.wall(place.into()));
        if let Some(wall) = walls.next() {
            let kind = diagonal.place.kind.name();
            faults.add(format!("{path}.{kind}"), format!(
                "{} meets the wall at line {}: a bay next to a wall cannot contain braces or panels; leave it out there",
                diagonal.place, wall.line
            ));
        }
    }
}

/// Faults of the fibres of a wall.
fn check_fibres_of(faults: &mut Faults, field: &str, frame: &Frame, wall: &FrameWall) {
    for (storey, of_storey) in &wall.fibres {
        let [first, last] = wall.storeys;
        faults.require((first..=last).contains(storey), field, || {
            format!("has fibres in storey {storey}, where the wall does not stand; it has storeys {first} to {last}")
        });
        let both = |hinge: &&WallHinge| {
            hinge.storey == *storey && of_storey.at_ends[usize::from(hinge.at_head)]
        };
        faults.require(!wall.hinges.iter().any(|hinge| both(&hinge)), field, || {
            format!("has fibres and a moment hinge at one end of storey {storey}; keep one of them")
        });
        fibres::check_fibres(faults, field, of_storey, false);
    }
    faults.require(
        wall.fibres.is_empty() || frame.axial.columns_flexible,
        field,
        || {
            "needs a wall that changes its length: without it its axial force is not known; add axial = \"flexible\" to the building, or leave axial out".into()
        },
    );
}

/// Whether a wall stands below or above a floor at a line, both counted from 0.
fn stands_at(frame: &Frame, [floor, line]: [usize; 2]) -> bool {
    let mut storeys = [floor, floor + 1].into_iter();
    storeys.any(|storey| frame.wall([storey, line]).is_some())
}

/// Faults of the rigid ends of beams and columns.
fn check_rigid_zones(faults: &mut Faults, path: &str, frame: &Frame) {
    let field = format!("{path}.rigid_ends");
    for (&[floor, line], zone) in &frame.rigid_zones {
        let sound = zone.iter().all(|zone| *zone >= 0.0 && zone.is_finite());
        faults.require(sound && frame.has_joint(floor + 1, line), field.as_str(), || {
            format!(
                "gives line {} at floor {} rigid ends of {} and {} m; they must not be negative, and a joint must be there",
                line + 1,
                floor + 1,
                zone[0],
                zone[1]
            )
        });
    }
    if frame.rigid_zones.is_empty() {
        return;
    }
    let columns = frame.all_columns();
    let column = columns
        .map(|(place, _)| place)
        .find(|place| frame.clear_height(*place) <= 0.0);
    if let Some([storey, line]) = column {
        let [foot, head] = frame.rigid_ends_of_column([storey, line]);
        faults.add(field.as_str(), format!(
            "leaves nothing of the column at line {} in storey {} that bends: {foot} m and {head} m of its {} m are rigid; make them shorter",
            line + 1,
            storey + 1,
            frame.storey_heights[storey]
        ));
    }
    let beams = frame.all_beams();
    let beam = beams
        .map(|(place, _)| place)
        .find(|place| frame.clear_span(*place) <= 0.0);
    let beam = beam.filter(|[floor, bay]| {
        let mut ends = [*bay, bay + 1].into_iter();
        !ends.any(|line| stands_at(frame, [*floor, line]))
    });
    if let Some([floor, bay]) = beam {
        faults.add(field.as_str(), format!(
            "leaves nothing of the beam of bay {} at floor {} that bends: {} m and {} m of its {} m are rigid; make them shorter",
            bay + 1,
            floor + 1,
            frame.arm([floor, bay]),
            frame.arm([floor, bay + 1]),
            frame.spans[bay]
        ));
    }
}
