//! Names of members whose histories are asked for.

use super::Faults;
use crate::model::{Building, Model, Structure};

pub(super) fn check_members(faults: &mut Faults, model: &Model) {
    let request = &model.analysis.members;
    let has_frame = |building: &Building| matches!(building.structure, Structure::Frame(_));
    faults.require(
        !request.envelopes || model.buildings.iter().any(has_frame),
        "output.members",
        || "no building is a frame, so that there are no columns and beams: storey shears are in every summary".into(),
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
    let Structure::Frame(frame) = &building.structure else {
        return Some(format!(
            "\"{name}\": \"{}\" is no frame and has no columns and beams; its storey shears are in every summary",
            building.name
        ));
    };
    let storeys = frame.storey_heights.len();
    let lines = frame.spans.len() + 1;
    let within = |text: &str, most: usize| {
        let number = text.parse::<usize>().ok();
        number.is_some_and(|n| (1..=most).contains(&n) && text == n.to_string())
    };
    let parts: Vec<&str> = place.split('.').collect();
    let known = match parts[..] {
        ["column", line, storey] => within(line, lines) && within(storey, storeys),
        ["beam", floor, span] => within(floor, storeys) && within(span, lines - 1),
        _ => false,
    };
    (!known).then(|| {
        let own = &building.name;
        let to = |most: usize| if most == 1 { "1".to_owned() } else { format!("1…{most}") };
        format!(
            "\"{name}\" is no member of \"{own}\"; it has {own}.column.LINE.STOREY with line {} and storey {}, and {own}.beam.FLOOR.SPAN with floor {} and span {}",
            to(lines),
            to(storeys),
            to(storeys),
            to(lines - 1)
        )
    })
}
