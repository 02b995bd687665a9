//! Walls of a frame that do not fit it, and beams between them.

use super::{Faults, each};
use crate::model::Frame;

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
    if frame.walls.is_empty() && frame.coupling_beams.is_empty() {
        return;
    }
    let mut said = Vec::new();
    for floor in 0..storeys {
        for bay in (0..bays).filter(|bay| frame.beam(floor, *bay).is_some()) {
            let clear = frame.clear_span([floor, bay]);
            if clear > 0.0 || said.contains(&bay) {
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
        let column = (0..2).find(|side| frame.arm([place[0], place[1] + side]) == 0.0);
        if let Some(side) = column {
            faults.add(field, format!(
                "ends at line {} at floor {}, where no wall stands; add the wall, or make it a beam",
                beam.bay + side,
                beam.floor
            ));
        }
    }
    for own in &frame.diagonals {
        let walls = own.place.lines().map(|line| {
            let storey = own.place.storey.checked_sub(1)?;
            frame.wall([storey, line])
        });
        if let Some(wall) = walls.into_iter().flatten().next() {
            let kind = own.place.kind.name();
            faults.add(format!("{path}.{kind}"), format!(
                "{} meets the wall at line {}, beside which braces and panels are not modelled; leave it out there",
                own.place, wall.line
            ));
        }
    }
}
