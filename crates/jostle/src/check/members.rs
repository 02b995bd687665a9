//! Names of members whose histories are asked for.

use super::Faults;
use crate::model::{Building, Frame, Model, PlanFrame, SpaceFrame, Structure, Tiers};
use crate::structure::MemberPlace;

pub(super) fn check_members(faults: &mut Faults, model: &Model) {
    let request = &model.analysis.members;
    let has_frame = |building: &Building| match &building.structure {
        Structure::Frame(_) => true,
        Structure::Tiers(tiers) => !tiers.frames.is_empty() || tiers.space_frame.is_some(),
        Structure::Shear(_) | Structure::Given(_) => false,
    };
    faults.require(
        !request.envelopes || model.buildings.iter().any(has_frame),
        "output.members",
        || "no building is a frame, so there are no member forces; storey shears are always reported".into(),
    );
    for (index, name) in request.histories.iter().enumerate() {
        if let Some(problem) = fault_of(name, model) {
            faults.add(format!("output.members[{index}]"), problem);
        }
    }
}

fn fault_of(name: &str, model: &Model) -> Option<String> {
    let rest = |building: &Building| -> Option<String> {
        let rest = name.strip_prefix(building.name.as_str())?;
        rest.strip_prefix('.').map(str::to_owned)
    };
    // The longest name that fits: names of buildings may contain dots.
    let found = model.buildings.iter().filter_map(|b| Some((b, rest(b)?)));
    let Some((building, place)) = found.max_by_key(|(building, _)| building.name.len()) else {
        return Some(format!(
            "\"{name}\" begins with the name of no building; write BUILDING.column.LINE.STOREY or BUILDING.beam.FLOOR.SPAN, such as \"{}.column.1.1\"",
            model.buildings.first().map_or("J1", |first| &first.name)
        ));
    };
    if let Structure::Tiers(tiers) = &building.structure
        && let Some(frame) = &tiers.space_frame
    {
        return fault_in_space(name, &place, building, frame);
    }
    if let Structure::Tiers(tiers) = &building.structure
        && !tiers.frames.is_empty()
    {
        return fault_in_plan(name, &place, building, tiers);
    }
    let Structure::Frame(frame) = &building.structure else {
        return Some(format!(
            "\"{name}\": \"{}\" is no frame and has no columns and beams; its storey shears are in every summary",
            building.name
        ));
    };
    fault_in_frame(name, &place, &building.name, frame)
}

/// The same for frames that stand in a plan, whose names come before those of their members.
fn fault_in_plan(name: &str, place: &str, building: &Building, tiers: &Tiers) -> Option<String> {
    let rest = |frame: &PlanFrame| -> Option<String> {
        let rest = place.strip_prefix(frame.name.as_str())?;
        rest.strip_prefix('.').map(str::to_owned)
    };
    let found = tiers.frames.iter().filter_map(|f| Some((f, rest(f)?)));
    let Some((frame, place)) = found.max_by_key(|(frame, _)| frame.name.len()) else {
        let first = tiers.frames.first().map_or("1", |frame| &frame.name);
        return Some(format!(
            "\"{name}\" names no frame of \"{own}\"; write {own}.FRAME.column.LINE.STOREY or {own}.FRAME.beam.FLOOR.SPAN, such as \"{own}.{first}.column.1.1\"",
            own = building.name
        ));
    };
    let text = format!("{}.{}", building.name, frame.name);
    fault_in_frame(name, &place, &text, &frame.frame)
}

/// The same for a space frame.
fn fault_in_space(
    name: &str,
    place: &str,
    building: &Building,
    frame: &SpaceFrame,
) -> Option<String> {
    let mut members = frame.members.iter();
    let known = members.any(|member| MemberPlace::InSpace(member.place).to_string() == place);
    (!known).then(|| {
        format!(
            "\"{name}\" is no member of \"{own}\"; it has {own}.column.X.Y.STOREY, {own}.beam_x.FLOOR.X.Y and {own}.beam_y.FLOOR.X.Y with lines x 1…{} and y 1…{}, storeys 1…{}, as far as they are not omitted; X and Y are the lines at which a beam begins",
            frame.lines_x.len(),
            frame.lines_y.len(),
            building.floors(),
            own = building.name
        )
    })
}

/// What is wrong with the place of a member in a frame of this name.
fn fault_in_frame(name: &str, place: &str, owner: &str, frame: &Frame) -> Option<String> {
    let storeys = frame.storey_heights.len();
    let lines = frame.spans.len() + 1;
    let within = |text: &str, most: usize| {
        let number = text.parse::<usize>().ok();
        number.is_some_and(|n| (1..=most).contains(&n) && text == n.to_string())
    };
    let index = |text: &str| text.parse().map_or(usize::MAX, |number: usize| number - 1);
    let parts: Vec<&str> = place.split('.').collect();
    let known = match parts[..] {
        ["column", line, storey] => {
            within(line, lines)
                && within(storey, storeys)
                && frame.column(index(storey), index(line)).is_some()
        }
        ["beam", floor, span] => {
            within(floor, storeys)
                && within(span, lines - 1)
                && frame.beam(index(floor), index(span)).is_some()
        }
        _ => false,
    };
    (!known).then(|| {
        let to = |most: usize| if most == 1 { "1".to_owned() } else { format!("1…{most}") };
        format!(
            "\"{name}\" is no member of \"{owner}\"; it has {owner}.column.LINE.STOREY with line {} and storey {}, and {owner}.beam.FLOOR.SPAN with floor {} and span {}{}",
            to(lines),
            to(storeys),
            to(storeys),
            to(lines - 1),
            if frame.is_regular() { "" } else { ", as far as they are not omitted" }
        )
    })
}
