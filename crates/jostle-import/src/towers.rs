//! Models of several towers: the building of one diaphragm.
//!
//! Members, walls and diaphragms connect joints; what is connected with the named diaphragm above the ground is the building.

use std::collections::BTreeSet;

use jostle_io::InputError;

use crate::facts::{Facts, fault, hull, key};
use crate::joints::Joints;
use crate::member::{ONE_HEIGHT, TextModel};
use crate::wall_panel::edges;

/// Points of the plan nearer than this are one \[m\].
const ONE_POINT: f64 = 0.01;
/// Two towers, as the source draws them, are models of their own.
const REMEDY: &str = "add --diaphragm and the name of one: its building has the columns, beams and walls that are connected with it; import each tower in a run of its own";

/// Keeps the building of the named diaphragm. Without a name, no floor may have several.
///
/// # Errors
/// Several diaphragms at one height and none named; a name that no diaphragm has; towers that are connected.
pub(crate) fn choose(facts: &mut Facts, named: Option<&str>) -> Result<(), InputError> {
    let Some(mut model) = facts.text.take() else {
        return Ok(());
    };
    let chosen = of_one(facts, &mut model, named);
    facts.text = Some(model);
    chosen
}

fn of_one(facts: &mut Facts, model: &mut TextModel, named: Option<&str>) -> Result<(), InputError> {
    let floors = &model.diaphragms;
    let height = |floor: usize| floors[floor].joints[0][2];
    let several = |among: &[usize]| {
        let of_pair = |pair: &[usize]| {
            let [a, b] = [pair[0], pair[1]];
            (height(a) - height(b)).abs() < ONE_HEIGHT && floors[a].name != floors[b].name
        };
        let mut sorted = among.to_vec();
        sorted.sort_by(|a, b| height(*a).total_cmp(&height(*b)));
        let found = sorted.windows(2).find(|pair| of_pair(pair));
        found.map(|pair| [pair[0], pair[1]])
    };
    let all: Vec<usize> = (0..floors.len()).collect();
    if let Some(named) = named.filter(|_| floors.is_empty() && !model.members.is_empty()) {
        return Err(fault(
            &model.file,
            format!("diaphragm \"{named}\""),
            "is assigned to no point or area, so that it is not known which members belong to it",
            "leave out --diaphragm if the model is one tower, else export each tower as a model of its own",
        ));
    }
    let Some([a, b]) = several(&all) else {
        return Ok(());
    };
    let both = format!("{} and {}", floors[a].name, floors[b].name);
    let at = format!("height {:.3} m", height(a));
    let Some(named) = named else {
        return Err(fault(
            &model.file,
            at,
            format!("has several diaphragms, {both}: several towers, or floors in parts"),
            format!(
                "{REMEDY}; a floor in parts has no single displacement: give it one rigid diaphragm"
            ),
        ));
    };
    let is_named = |floor: &usize| key(&floors[*floor].name) == key(named);
    if !all.iter().any(is_named) {
        let names: BTreeSet<&str> = floors.iter().map(|floor| floor.name.as_str()).collect();
        let names: Vec<&str> = names.into_iter().collect();
        return Err(fault(
            &model.file,
            format!("diaphragm \"{named}\""),
            format!("is none of its diaphragms, {}", names.join(", ")),
            "name one of them with --diaphragm",
        ));
    }
    let (joints, mut parts, first_floor) = connected(model, facts.base_height());
    let kept: BTreeSet<usize> = all
        .iter()
        .filter(|floor| is_named(floor))
        .map(|floor| parts.part(first_floor + floor))
        .collect();
    let of_tower: Vec<usize> = all
        .iter()
        .filter(|floor| kept.contains(&parts.part(first_floor + **floor)))
        .copied()
        .collect();
    if let Some([a, b]) = several(&of_tower) {
        return Err(fault(
            &model.file,
            format!("height {:.3} m", height(a)),
            format!(
                "has the diaphragms {} and {}, and members connect them, such as those of a common podium or a bridge",
                floors[a].name, floors[b].name
            ),
            "export each tower as a model of its own",
        ));
    }
    let names: BTreeSet<String> = of_tower
        .iter()
        .map(|floor| key(&floors[*floor].name))
        .collect();
    let all_names: BTreeSet<String> = floors.iter().map(|floor| key(&floor.name)).collect();
    let levels: Vec<f64> = of_tower.iter().map(|floor| height(*floor)).collect();
    let mut keeps = |at: &[f64; 3]| {
        joints
            .find(*at)
            .is_some_and(|joint| kept.contains(&parts.part(joint)))
    };
    let count = model.members.len() + model.walls.len();
    model.members.retain(|member| keeps(&member.ends[0]));
    model
        .walls
        .retain(|wall| wall.corners.first().is_some_and(&mut keeps));
    model.supports.retain(|support| keeps(&support.at));
    model.disconnected.retain(&mut keeps);
    let plan: Vec<[f64; 2]> = joints
        .at
        .iter()
        .filter(|at| keeps(at))
        .map(|at| [at[0], at[1]])
        .collect();
    let top = joints
        .at
        .iter()
        .filter(|at| keeps(at))
        .fold(f64::MIN, |top, at| top.max(at[2]));
    let left = count - model.members.len() - model.walls.len();
    facts.left_out.push(format!(
        "{}: {left} members and walls that are not connected with diaphragm \"{named}\"; periods of the source are of the whole model",
        model.file
    ));
    for points in facts.points.values_mut() {
        let near = |point: &[f64; 2]| {
            plan.iter()
                .any(|at| (at[0] - point[0]).hypot(at[1] - point[1]) < ONE_POINT)
        };
        points.retain(near);
    }
    // SAP2000 has no other storeys than heights of diaphragms.
    let is_floor = |z: f64| levels.iter().any(|level| (level - z).abs() < ONE_HEIGHT);
    let by_levels = facts.sap2000;
    facts.stories.retain(|story| match by_levels {
        true => is_floor(story.top),
        false => story.top < top + ONE_HEIGHT,
    });
    if by_levels {
        let feet = model.supports.iter().map(|support| support.at[2]);
        let lowest = feet.fold(f64::INFINITY, f64::min);
        if let Some((_, base)) = facts.base.as_mut().filter(|_| lowest.is_finite()) {
            *base = lowest;
        }
    }
    let outline = hull(&plan);
    for masses in [&mut facts.masses, &mut facts.solver_masses] {
        masses.retain(|mass| {
            let name = key(&mass.diaphragm);
            match all_names.contains(&name) {
                true => names.contains(&name),
                false => mass.centre.is_none_or(|centre| inside(&outline, centre)),
            }
        });
    }
    Ok(())
}

/// Whether a point lies in a convex outline.
fn inside(outline: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let next = outline.iter().cycle().skip(1);
    outline.iter().zip(next).all(|(a, b)| {
        let along = [b[0] - a[0], b[1] - a[1]];
        along[0] * (y - a[1]) - along[1] * (x - a[0]) >= -ONE_POINT * along[0].hypot(along[1])
    })
}

/// Joints, and behind them diaphragms, in connected parts; the number of the first diaphragm.
///
/// Areas and members at the height of the base connect nothing: the ground holds them.
fn connected(model: &TextModel, base: f64) -> (Joints, Parts, usize) {
    let mut joints = Joints::default();
    let ends = model.members.iter().flat_map(|member| member.ends);
    let corners = model
        .walls
        .iter()
        .flat_map(|wall| wall.corners.iter().copied());
    let of_floors = model
        .diaphragms
        .iter()
        .flat_map(|floor| floor.joints.iter().copied());
    let of_areas = model.floor_areas.iter().flatten().copied();
    for at in ends.chain(corners).chain(of_floors).chain(of_areas) {
        joints.add(at);
    }
    let count = joints.at.len();
    let mut parts = Parts((0..count + model.diaphragms.len()).collect());
    let number = |at: [f64; 3]| joints.find(at).unwrap_or(0);
    let above = |at: &[f64; 3]| at[2] > base + ONE_HEIGHT;
    for member in model
        .members
        .iter()
        .filter(|member| member.ends.iter().any(above))
    {
        let pair = member.ends.map(number);
        parts.join(pair[0], pair[1]);
        join_inside(&joints, &mut parts, member.ends);
    }
    for wall in &model.walls {
        for pair in wall.corners.windows(2) {
            parts.join(number(pair[0]), number(pair[1]));
        }
        let Some([foot, head]) = edges(wall) else {
            continue;
        };
        for line in [foot, head, [foot[0], head[0]], [foot[1], head[1]]] {
            join_inside(&joints, &mut parts, line);
        }
    }
    for area in &model.floor_areas {
        let Some(first) = area.first().copied().filter(above) else {
            continue;
        };
        area.iter()
            .for_each(|at| parts.join(number(first), number(*at)));
        // Columns below a slab, and beams below it.
        let outline = hull(&area.iter().map(|at| [at[0], at[1]]).collect::<Vec<_>>());
        for (joint, at) in joints.at.iter().enumerate() {
            if (at[2] - first[2]).abs() < ONE_HEIGHT
                && outline.len() > 2
                && inside(&outline, [at[0], at[1]])
            {
                parts.join(number(first), joint);
            }
        }
    }
    for (floor, diaphragm) in model.diaphragms.iter().enumerate() {
        diaphragm
            .joints
            .iter()
            .for_each(|at| parts.join(count + floor, number(*at)));
    }
    (joints, parts, count)
}

/// Connects a line with the joints on it.
fn join_inside(joints: &Joints, parts: &mut Parts, line: [[f64; 3]; 2]) {
    let end = joints.find(line[0]).unwrap_or(0);
    for joint in 0..joints.at.len() {
        if joints.share(joint, line).is_some() {
            parts.join(end, joint);
        }
    }
}

/// Connected parts: each entry leads to the one that names its part.
struct Parts(Vec<usize>);

impl Parts {
    fn part(&mut self, mut of: usize) -> usize {
        while self.0[of] != of {
            self.0[of] = self.0[self.0[of]];
            of = self.0[of];
        }
        of
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.part(a), self.part(b));
        self.0[a] = b;
    }
}
