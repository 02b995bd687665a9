//! `rigid_ends`: columns and beams of a frame or a space frame that are rigid inside their joints.

use std::collections::BTreeMap;

use jostle::{Frame, FramePlace, SpaceFrame, SpacePlace};

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
    let mut all = depths.iter().flatten().flatten();
    let lacks_depths = all.clone().next().is_some() && !all.any(Option::is_some);
    let Some(asked) = Asked::read(reader, view, lacks_depths) else {
        return BTreeMap::new();
    };
    let [columns, beams] = depths;
    let deepest = |grid: &[Vec<Option<f64>>], places: [Option<FramePlace>; 2]| {
        let places = places.into_iter().flatten();
        let grid = places.filter_map(|[row, place]| *grid.get(row)?.get(place)?);
        grid.fold(0.0, f64::max)
    };
    let zone = |[floor, line]: FramePlace| {
        let before = line.checked_sub(1).map(|bay| [floor, bay]);
        [
            asked.of_beams(deepest(
                columns,
                [Some([floor, line]), Some([floor + 1, line])],
            )),
            asked.of_columns(deepest(beams, [before, Some([floor, line])])),
        ]
    };
    let places = (0..frame.storey_heights.len())
        .flat_map(|floor| (0..frame.lines()).map(move |line| [floor, line]));
    let joints = places.filter(|[floor, line]| frame.has_joint(floor + 1, *line));
    let zones = joints.map(|place| (place, zone(place)));
    zones.filter(|(_, zone)| *zone != [0.0; 2]).collect()
}

/// The same of a space frame: beams along x and across, and columns.
pub(super) fn read_in_space(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    frame: &SpaceFrame,
) -> BTreeMap<[usize; 3], [f64; 3]> {
    let Some(asked) = Asked::read(reader, view, false) else {
        return BTreeMap::new();
    };
    // Greatest sizes along x and across of columns, and depths of beams, at every joint.
    let mut sizes: BTreeMap<[usize; 3], [f64; 3]> = BTreeMap::new();
    for member in &frame.members {
        let level = member.place.storey();
        let is_column = matches!(member.place, SpacePlace::Column { .. });
        let below = level.checked_sub(1).filter(|_| is_column);
        for (end, [x, y]) in member.place.crossings().into_iter().enumerate() {
            let floor = match (is_column, end) {
                (true, 0) => below,
                _ => Some(level),
            };
            let Some(floor) = floor else {
                continue;
            };
            let size = sizes.entry([floor, x, y]).or_default();
            let [first, second] = member.section.size;
            let met = match is_column {
                true => [first, second, 0.0],
                false => [0.0, 0.0, second],
            };
            for (size, met) in size.iter_mut().zip(met) {
                *size = f64::max(*size, met);
            }
        }
    }
    let zones = sizes.into_iter().map(|(place, [x, y, depth])| {
        let beams = [x, y].map(|size| asked.of_beams(size));
        (place, [beams[0], beams[1], asked.of_columns(depth)])
    });
    zones.filter(|(_, zone)| *zone != [0.0; 3]).collect()
}

/// Lengths of the columns of a storey (`key` = `"column"`), or of the beams of a floor, between the rigid zones of joints and the faces of
/// walls \[m\].
pub(super) fn bending_lengths(frame: &Frame, key: &str, storey: usize) -> Vec<f64> {
    match key {
        "column" => {
            let lines = 0..frame.lines();
            lines
                .map(|line| frame.clear_height([storey, line]))
                .collect()
        }
        _ => {
            let bays = 0..frame.spans.len();
            bays.map(|bay| frame.clear_span([storey, bay])).collect()
        }
    }
}

/// What a file says of rigid ends.
enum Asked {
    /// A share of half of the deepest member that meets the joint.
    Share(f64),
    /// Lengths of beams and of columns, the same at all joints \[m\].
    Lengths([f64; 2]),
}

impl Asked {
    /// Rigid length of a beam at columns of which the deepest has this depth \[m\].
    fn of_beams(&self, depth: f64) -> f64 {
        match self {
            Self::Share(share) => 0.5 * share * depth,
            Self::Lengths([beams, _]) => *beams,
        }
    }

    /// The same of a column at beams.
    fn of_columns(&self, depth: f64) -> f64 {
        match self {
            Self::Share(share) => 0.5 * share * depth,
            Self::Lengths([_, columns]) => *columns,
        }
    }

    /// Reads `rigid_ends`; `None` without the key, or after a fault. `lacks_depths`: no member has a depth.
    fn read(reader: &mut Reader<'_>, view: &View<'_>, lacks_depths: bool) -> Option<Self> {
        let field = reader.get(view, "rigid_ends")?;
        match field.node.value {
            Value::Table(_) => Self::read_lengths(reader, &field),
            _ => Self::read_share(reader, &field, lacks_depths),
        }
    }

    fn read_lengths(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<Self> {
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
        Some(Self::Lengths([beams?, columns?]))
    }

    fn read_share(reader: &mut Reader<'_>, field: &Field<'_>, lacks_depths: bool) -> Option<Self> {
        let share = reader.quantity(field, Dimension::Dimensionless)?;
        if !(0.0..=1.0).contains(&share) {
            *reader.bad(field, format!("must lie between 0 and 1, found {share}")) = Some(
                "write 1 for members that are rigid up to the faces of joints, 0.5 for half of that, or lengths: rigid_ends = { beams = \"0.25 m\", columns = \"0.3 m\" }".into(),
            );
            return None;
        }
        if share > 0.0 && lacks_depths {
            *reader.bad(
                field,
                "is a share of depths, and no column or beam has a depth",
            ) = Some(
                "give lengths from the axes: rigid_ends = { beams = \"0.25 m\", columns = \"0.3 m\" }"
                    .into(),
            );
            return None;
        }
        Some(Self::Share(share))
    }
}
