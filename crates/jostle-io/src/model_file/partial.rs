//! Neighbours whose floors match in part, and slabs that meet no column.

use jostle::{Building, Model, Structure, UnmatchedFloors, UnmetColumns, floor_and_height};

/// One warning for every pair of neighbours with floors that `"common"` omits although they lie beside the other
/// building, and for slabs that meet no column although `"all"` asks for it.
pub(super) fn warnings(model: &Model) -> Vec<String> {
    let unmatched = model.unmatched_floors();
    let unmatched = unmatched.iter();
    let unmet = model.unmet_columns();
    let unmet = unmet
        .iter()
        .filter_map(|found| without_column(model, found));
    unmatched
        .filter_map(|found| warning(model, found))
        .chain(unmet)
        .collect()
}

fn without_column(model: &Model, found: &UnmetColumns) -> Option<String> {
    let [slabs, columns] = found.between.map(|index| model.buildings.get(index));
    let (slabs, columns, gap) = (slabs?, columns?, model.gaps.get(found.gap)?);
    let named = floors(slabs, &found.floors)?;
    let (first, last) = (found.heights.first()?, found.heights.last()?);
    let (meet, heights) = match found.floors.len() {
        1 => ("meets", format!("at {first:.3} m")),
        _ => ("meet", format!("from {first:.3} m to {last:.3} m")),
    };
    let why = match found.behind {
        true => format!(
            "its columns stand farther than reach = {} m behind the edge of its plan. Raise reach, or give the plan up to the columns",
            gap.in_plan.reach
        ),
        false => "none of its columns stands within the common width of both buildings. Check at, plan and the grid lines; what stands there instead, such as a wall or the edge of a floor between, has to be modelled".to_owned(),
    };
    Some(format!(
        "gap[{}].floors: {named}, {heights}, {meet} no column of \"{}\", so that there is no contact with it: {why}",
        found.gap, columns.name
    ))
}

fn warning(model: &Model, found: &UnmatchedFloors) -> Option<String> {
    let [left, right] = found.between.map(|index| model.buildings.get(index));
    let buildings = [left?, right?];
    let sides = [0, 1].map(|side| floors(buildings[side], &found.floors[side]));
    let sides: Vec<String> = sides.into_iter().flatten().collect();
    let contacts = match found.contacts {
        1 => "The only contact joins floors".to_owned(),
        count => format!("All {count} contacts join floors"),
    };
    let alone = found.floors.iter().map(Vec::len).sum::<usize>() == 1;
    let stand = if alone { "stands" } else { "stand" };
    Some(format!(
        "gap[{}].floors: {} {stand} beside the other building, but between its floors: no contact there with floors = \"common\". {contacts} at equal height; impacts of floors against columns are left out. {}",
        found.gap,
        sides.join(" and "),
        remedy(buildings, found)
    ))
}

/// How to bring these floors into contact.
fn remedy(buildings: [&Building; 2], found: &UnmatchedFloors) -> String {
    let has_columns = buildings.map(Building::has_columns_to_hit);
    let in_space = matches!(buildings[0].structure, Structure::Tiers(_));
    let listed = "list the pairs that can touch";
    match has_columns {
        [true, true] => {
            format!("Write floors = \"all\" to include them, or {listed} to say that they cannot")
        }
        [false, false] if in_space => format!(
            "Of buildings with a plan only frames have columns that can be hit between floors: describe them by frames at lines or as space frames, raise level_tolerance if slabs overlap, or {listed} to say that no others can"
        ),
        [false, false] => format!(
            "Shear buildings and given ones have no columns to hit: describe them as frames, raise level_tolerance if slabs overlap, or {listed} to say that no others can"
        ),
        [left_has, _] => {
            // Floors of the shear building against columns of the frame.
            let (shear, frame) = if left_has { (1, 0) } else { (0, 1) };
            let point = found.floors[shear].first().and_then(|&floor| {
                let height = *buildings[shear].floor_levels().get(floor.checked_sub(1)?)?;
                Some(format!(" as {}", floor_and_height(shear, floor, height)))
            });
            let kind = if in_space { "space frame" } else { "frame" };
            format!(
                "Floors of \"{}\" can hit columns of \"{}\": {listed}{}. Describe \"{}\" as a {kind} to let floors hit its columns too",
                buildings[shear].name,
                buildings[frame].name,
                point.unwrap_or_default(),
                buildings[shear].name
            )
        }
    }
}

/// Floors of a building in words; `None` if there are none.
fn floors(building: &Building, floors: &[usize]) -> Option<String> {
    let mut runs: Vec<[usize; 2]> = Vec::new();
    for &floor in floors {
        match runs.last_mut() {
            Some([_, last]) if *last + 1 == floor => *last = floor,
            _ => runs.push([floor, floor]),
        }
    }
    let runs: Vec<String> = runs
        .into_iter()
        .map(|[first, last]| match last - first {
            0 => first.to_string(),
            1 => format!("{first}, {last}"),
            _ => format!("{first} to {last}"),
        })
        .collect();
    let plural = if floors.len() > 1 { "s" } else { "" };
    (!floors.is_empty())
        .then(|| format!("floor{plural} {} of \"{}\"", runs.join(", "), building.name))
}
