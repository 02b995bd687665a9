//! `rigid_ends`: columns and beams of a frame that are rigid inside their joints.

use std::collections::BTreeMap;

use jostle::{Frame, FramePlace};

use crate::keys::Section;
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};
use crate::tree::Value;

/// Rigid zones of the joints of a frame, whose members have these depths; none without the key, or after a fault.
pub(super) fn read(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    frame: &Frame,
    depths: &[Vec<Vec<Option<f64>>>; 2],
) -> BTreeMap<FramePlace, [f64; 2]> {
    let Some(field) = reader.get(view, "rigid_ends") else {
        return BTreeMap::new();
    };
    let zone = match field.node.value {
        Value::Table(_) => by_lengths(reader, &field),
        _ => by_depths(reader, &field, depths),
    };
    let Some(zone) = zone else {
        return BTreeMap::new();
    };
    let places = (0..frame.storey_heights.len())
        .flat_map(|floor| (0..frame.lines()).map(move |line| [floor, line]));
    let joints = places.filter(|[floor, line]| frame.has_joint(floor + 1, *line));
    let zones = joints.map(|place| (place, zone(place)));
    zones.filter(|(_, zone)| *zone != [0.0; 2]).collect()
}

/// Lengths of the columns of a storey (`key` = `"column"`), or of the beams of a floor, between the rigid zones of joints \[m\].
pub(super) fn bending_lengths(frame: &Frame, key: &str, storey: usize) -> Vec<f64> {
    match key {
        "column" => {
            let lines = 0..frame.lines();
            lines
                .map(|line| frame.clear_height([storey, line]))
                .collect()
        }
        _ => {
            let rigid = |line| frame.rigid_zone([storey, line])[0];
            let spans = frame.spans.iter().enumerate();
            spans
                .map(|(bay, span)| span - rigid(bay) - rigid(bay + 1))
                .collect()
        }
    }
}

/// Half the width and half the height of a joint, as far as they are rigid \[m\].
type Zone<'a> = Box<dyn Fn(FramePlace) -> [f64; 2] + 'a>;

/// The same lengths at all joints.
fn by_lengths<'a>(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<Zone<'a>> {
    let view = reader.open(field, &[Section::RigidEnds])?;
    let mut length = |key: &'static str| match reader.get(&view, key) {
        Some(field) => {
            let length = reader.quantity(&field, Dimension::Length)?;
            if length < 0.0 {
                reader.bad(&field, "must not be negative");
                return None;
            }
            Some(length)
        }
        None => Some(0.0),
    };
    let (beams, columns) = (length("beams"), length("columns"));
    let zone = [beams?, columns?];
    Some(Box::new(move |_| zone))
}

/// A share of the half depths of the members that meet: the deeper of two counts.
fn by_depths<'a>(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    depths: &'a [Vec<Vec<Option<f64>>>; 2],
) -> Option<Zone<'a>> {
    let share = reader.quantity(field, Dimension::Dimensionless)?;
    if !(0.0..=1.0).contains(&share) {
        *reader.bad(field, format!("must lie between 0 and 1, found {share}")) = Some(
            "write 1 for members that are rigid up to the faces of joints, 0.5 for half of that, or lengths: rigid_ends = { beams = \"0.25 m\", columns = \"0.3 m\" }".into(),
        );
        return None;
    }
    let [columns, beams] = depths;
    let mut all = columns.iter().chain(beams).flatten();
    if share > 0.0 && all.clone().next().is_some() && !all.any(Option::is_some) {
        *reader.bad(
            field,
            "is a share of depths, and no column or beam has a depth",
        ) = Some(
            "give lengths from the axes: rigid_ends = { beams = \"0.25 m\", columns = \"0.3 m\" }"
                .into(),
        );
        return None;
    }
    let deepest = move |grid: &[Vec<Option<f64>>], places: [Option<FramePlace>; 2]| {
        let own = places.into_iter().flatten();
        let own = own.filter_map(|[row, place]| *grid.get(row)?.get(place)?);
        0.5 * share * own.fold(0.0, f64::max)
    };
    Some(Box::new(move |[floor, line]| {
        [
            deepest(columns, [Some([floor, line]), Some([floor + 1, line])]),
            deepest(
                beams,
                [
                    line.checked_sub(1).map(|bay| [floor, bay]),
                    Some([floor, line]),
                ],
            ),
        ]
    }))
}
