//! `joint`: semi-rigid connections between the ends of beams and columns.

use jostle::hysteresis::Hysteresis;
use jostle::{Frame, FrameHinges, Hinges, Joint, SpaceFrame, SpacePlace};

use super::building::or_rigid;
use super::hinges;
use crate::keys::Section;
use crate::quantity::Dimension;
use crate::reader::{Reader, View};

/// The elastic springs of the connections of a frame.
pub(super) fn read(reader: &mut Reader<'_>, view: &View<'_>) -> Joint {
    let Some(field) = reader.get(view, "joint") else {
        return Joint::default();
    };
    let Some(view) = reader.open(&field, &[Section::Joint]) else {
        return Joint::default();
    };
    let turning = or_rigid(
        reader,
        &view,
        "rotational_stiffness",
        Dimension::RotationalStiffness,
    );
    Joint {
        // A spring that yields stands among the hinges.
        rotational_stiffness: turning.filter(|_| !view.has("hinge")),
        horizontal_stiffness: or_rigid(reader, &view, "horizontal_stiffness", Dimension::Stiffness),
        vertical_stiffness: or_rigid(reader, &view, "vertical_stiffness", Dimension::Stiffness),
    }
}

/// Hinges of a frame with the connections that yield, which are those of its beams. `view`: the frame.
pub(super) fn with_hinge(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    frame: &Frame,
    hinges: Option<Hinges>,
) -> Option<Hinges> {
    let table = reader.get(view, "joint");
    let joint = table.and_then(|field| reader.reopen(&field, &[Section::Joint]));
    let hinge = joint.and_then(|joint| Some((reader.get(&joint, "hinge")?, joint)));
    let Some((field, joint)) = hinge else {
        return hinges;
    };
    let stiffness = before_yield(reader, &joint);
    if !joint.has("rotational_stiffness") {
        *reader.bad(
            &field,
            "needs the stiffness of the connection before it yields",
        ) = Some("add rotational_stiffness = \"40 MN.m/rad\", or remove hinge".into());
    }
    let sections = &[Section::BaseRocking];
    let spring = hinges::read_spring(reader, &field, sections, stiffness, Dimension::Moment);
    let mut all = match hinges {
        Some(Hinges::Frame(hinges)) => hinges,
        _ => FrameHinges::default(),
    };
    if !all.beams.is_empty() {
        *reader.bad(&field, "cannot be combined with hinges of beams") =
            Some("keep either joint.hinge or the hinges of beams".into());
        return None;
    }
    all.beams = vec![vec![spring?; frame.spans.len()]; frame.storey_heights.len()];
    Some(Hinges::Frame(all))
}

/// Lets the connections of the beams of a space frame yield in their vertical planes.
pub(super) fn read_in_space(reader: &mut Reader<'_>, view: &View<'_>, frame: &mut SpaceFrame) {
    const OF_BEAMS: [&str; 2] = ["x", "y"];
    let Some(field) = reader.get(view, "joint") else {
        return;
    };
    let Some(joint) = reader.open(&field, &[Section::BeamJoint, Section::SpaceJoint]) else {
        return;
    };
    let springs = if OF_BEAMS.iter().any(|key| joint.has(key)) {
        for key in ["rotational_stiffness", "hinge"] {
            if let Some(stated) = reader.get(&joint, key) {
                *reader.bad(&stated, "cannot be combined with x and y") =
                    Some(format!("move {key} into x and y, or remove these"));
                return;
            }
        }
        OF_BEAMS.map(|key| {
            let field = reader.get(&joint, key)?;
            let along = reader.open(&field, &[Section::BeamJoint])?;
            connection(reader, &along)
        })
    } else {
        [connection(reader, &joint); 2]
    };
    for member in &mut frame.members {
        let spring = match member.place {
            SpacePlace::Column { .. } => continue,
            SpacePlace::BeamX { .. } => springs[0],
            SpacePlace::BeamY { .. } => springs[1],
        };
        if spring.is_some() && member.may_yield() {
            *reader.bad(&field, "cannot be combined with hinges of beams") =
                Some("keep either joint or the hinges of beams".into());
            return;
        }
        member.hinges[0] = member.hinges[0].or(spring);
    }
}

/// Stiffness of a connection before it yields; `None` for `"rigid"` and where it is absent.
fn before_yield(reader: &mut Reader<'_>, view: &View<'_>) -> Option<f64> {
    let field = reader.get(view, "rotational_stiffness")?;
    if field.as_text() == Some("rigid") {
        return None;
    }
    reader.positive(&field, Dimension::RotationalStiffness)
}

/// The spring of connections that yield.
fn connection(reader: &mut Reader<'_>, view: &View<'_>) -> Option<Hysteresis> {
    let stiffness = before_yield(reader, view);
    if !view.has("rotational_stiffness") {
        let remedy =
            "add rotational_stiffness = \"40 MN.m/rad\", that of the connection before it yields";
        reader.missing(view, "rotational_stiffness", remedy);
        return None;
    }
    let Some(field) = reader.get(view, "hinge") else {
        let remedy = "add hinge = { rule = \"bilinear\", yield = \"180 kN.m\", post_yield = 0.03 }: elastic connections are for plane frames";
        reader.missing(view, "hinge", remedy);
        return None;
    };
    let sections = &[Section::BaseRocking];
    hinges::read_spring(reader, &field, sections, stiffness, Dimension::Moment)
}
