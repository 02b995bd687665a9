//! Columns and beams of a frame that do not stand together.

use super::Faults;
use crate::model::{Diagonal, DiagonalKind, DiagonalPlace, Frame, Reach};

/// Members and joints that a frame lacks, as faults at `path`. Lengths of lists are right.
pub(super) fn check_places(faults: &mut Faults, path: &str, frame: &Frame) {
    let (storeys, lines) = (frame.storey_heights.len(), frame.lines());
    let (column, beam) = (format!("{path}.column"), format!("{path}.beam"));
    let outside = |place: &[usize; 2], across: usize| place[0] >= storeys || place[1] >= across;
    for [storey, line] in frame.own_columns.keys().filter(|key| outside(key, lines)) {
        faults.add(column.as_str(), format!(
            "names line {} of storey {}, but there are {lines} column lines and {storeys} storeys, counted from 1",
            line + 1,
            storey + 1
        ));
    }
    for [floor, bay] in frame.own_beams.keys().filter(|key| outside(key, lines - 1)) {
        faults.add(beam.as_str(), format!(
            "names bay {} of floor {}, but there are {} bays and {storeys} floors, counted from 1",
            bay + 1,
            floor + 1,
            lines - 1
        ));
    }
    for storey in 0..storeys {
        if frame.columns_in(storey) == 0 {
            faults.add(column.as_str(), format!(
                "leaves storey {} without any column: leave out the storeys above the roof, or omit fewer columns",
                storey + 1
            ));
            return;
        }
    }
    let unsupported = frame
        .all_columns()
        .map(|(place, _)| place)
        .filter(|[storey, line]| *storey > 0 && frame.column(storey - 1, *line).is_none());
    for [storey, line] in unsupported {
        let (fault, remedy) = if frame.wall([storey, line]).is_some() {
            ("a wall cannot start on a beam", "")
        } else if !frame.beams_cross(storey, line) {
            let fault =
                "a column that starts on a beam needs beams in the bays on both sides of it";
            (fault, ", add the beams")
        } else {
            continue;
        };
        faults.add(format!("{column}[{storey}][{line}]"), format!(
            "line {} has a column in storey {} but none in storey {storey}; {fault}: add the column below{remedy}, or omit this one",
            line + 1,
            storey + 1
        ));
    }
    let hanging = |[floor, bay]: [usize; 2]| {
        let ends = [bay, bay + 1];
        ends.into_iter()
            .find(|line| !frame.has_joint(floor + 1, *line))
    };
    let beams: Vec<_> = frame.all_beams().map(|(place, _)| place).collect();
    for &[floor, bay] in &beams {
        if let Some(line) = hanging([floor, bay]) {
            faults.add(format!("{beam}[{floor}][{bay}]"), format!(
                "bay {} has a beam at floor {} but line {} no joint there, as neither a column stands below it nor the beam of a further bay meets it: omit the beam, or add the column",
                bay + 1,
                floor + 1,
                line + 1
            ));
        }
    }
    for floor in 0..storeys {
        let Some([first, last]) = frame.outer_lines(floor + 1) else {
            continue;
        };
        let Some(bay) = (first..last).find(|bay| frame.beam(floor, *bay).is_none()) else {
            continue;
        };
        let without = [bay, bay + 1]
            .into_iter()
            .find(|line| !frame.has_joint(floor + 1, *line));
        let why = match without {
            Some(line) => format!("it has no joint at line {}", line + 1),
            None => format!("no beam crosses bay {}", bay + 1),
        };
        faults.add(format!("{beam}[{floor}][{bay}]"), format!(
            "floor {} is in two parts, as {why}: towers on one podium are not modelled as one building; close the gap, or omit all that stands on one side of it",
            floor + 1
        ));
    }
}

/// What is wrong with where the ends of a diagonal, whose place is sound, meet the columns.
pub(super) fn fault_of_offsets(frame: &Frame, diagonal: &Diagonal) -> Option<String> {
    let storey = diagonal.place.storey - 1;
    let height = frame.storey_heights[storey];
    let [lower, upper] = diagonal.place.lines();
    let ends = [(lower, 0), (upper, 1)].map(|(line, end)| {
        let rigid = frame.rigid_ends_of_column([storey, line])[end];
        (diagonal.offsets[end], rigid, line + 1)
    });
    let limits = OffsetLimits {
        place: diagonal.place,
        storey_height: height,
    };
    ends.into_iter()
        .find_map(|(offset, rigid, line)| limits.fault(&format!("column {line}"), offset, rigid))
}

/// How far from joints a diagonal may meet columns.
pub(super) struct OffsetLimits {
    pub(super) place: DiagonalPlace,
    pub(super) storey_height: f64,
}

impl OffsetLimits {
    /// What is wrong with an offset at a column that is rigid so far from the joint.
    pub(super) fn fault(&self, column: &str, offset: f64, rigid: f64) -> Option<String> {
        let most = 0.25 * self.storey_height;
        if !(0.0..=most).contains(&offset) {
            return Some(format!(
                "{} meets {column} {offset} m from the joint; give 0 to a quarter of the storey, {most} m",
                self.place
            ));
        }
        (offset > 0.0 && offset <= rigid).then(|| {
            format!(
                "{} meets {column} {offset} m from the joint, where it is rigid over {rigid} m; give a greater offset, or shorter rigid_ends",
                self.place
            )
        })
    }
}

/// What is wrong with the place of a diagonal: it is not in the frame, or ends where there is no joint.
pub(super) fn fault_of_diagonal(frame: &Frame, place: DiagonalPlace) -> Option<String> {
    let (storeys, bays) = (frame.storey_heights.len(), frame.spans.len());
    let crosses =
        place.reach == Reach::BAY || (place.kind == DiagonalKind::Brace && place.reach.storeys > 0);
    let exists = place.storey > 0
        && place.bay > 0
        && place.floors()[1] <= storeys
        && place.bay + place.reach.bays <= bays + 1;
    if !exists || !crosses || place.line.is_some() {
        return Some(format!(
            "{place} is not in a frame of {storeys} storeys and {bays} bays, counted from 1"
        ));
    }
    let [lower, upper] = place.lines();
    let [low, high] = place.floors();
    if lower == upper && !frame.axial.columns_flexible {
        return Some(format!(
            "{place} is next to axially rigid columns, so it carries no force; add axial = \"flexible\" to the building, or leave it out"
        ));
    }
    let mut lines = [lower, upper].into_iter();
    let lacking = lines.find(|line| frame.column(low, *line).is_none());
    if let Some(line) = lacking.filter(|_| place.kind == DiagonalKind::Infill) {
        return Some(format!(
            "{place} fills a bay without a column at line {}; leave it out there, or add the column",
            line + 1
        ));
    }
    let mut loose = [(low, lower), (high, upper)].into_iter();
    let (floor, line) = loose.find(|(floor, line)| !frame.has_joint(*floor, *line))?;
    Some(format!(
        "{place} ends at floor {floor} of line {}, where there is no joint; leave it out there, or add the column or the beams",
        line + 1
    ))
}
