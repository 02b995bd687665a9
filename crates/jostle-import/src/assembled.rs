//! The members of a text model as one elastic structure, and how its floors move under unit loads.
//!
//! Members of any direction between any points, with released ends and stiff lengths. Joints of a floor move with it in plan; all
//! others are free. Unit loads on the floors give their flexibility, as unit loads in the source would.

use jostle_io::InputError;

use crate::beam::Beam;
use crate::element::{Element, Shares};
use crate::facts::{Facts, Floor, fault};
use crate::joints::{Joints, ONE_JOINT};
use crate::matrix::{Envelope, symmetrise};
use crate::member::TextModel;
use crate::section::rigidity;
use crate::wall_panel::{edges, panels};

/// A displacement whose pivot is less than this part of its stiffness has none: rounding leaves less than 1e-13.
const LEAST_PIVOT: f64 = 1e-11;
/// Most numbers of the factor: one gigabyte.
const MOST_NUMBERS: usize = 125_000_000;
/// Names of displacements of a joint.
const MOVES: [&str; 6] = [
    "move along X",
    "move along Y",
    "move along Z",
    "turn about X",
    "turn about Y",
    "turn about Z",
];

/// What was made of the members.
pub(crate) struct Assembled {
    /// Displacements along X and Y of the centres of mass and turns of all floors, from the ground up, under unit loads there \[m/N\].
    pub(crate) flexibility: Vec<Vec<f64>>,
    /// What it has, for messages.
    pub(crate) remarks: Vec<String>,
}

/// Assembles a text model and loads its floors.
///
/// # Errors
/// What has no stiffness in the file, what is not elastic between joints, and joints that nothing holds.
pub(crate) fn assemble(
    facts: &Facts,
    model: &TextModel,
    floors: &[Floor],
) -> Result<Assembled, InputError> {
    let refuse = |object: &str, problem: String, remedy: &str| {
        Err(fault(&model.file, object, problem, remedy))
    };
    let by_results = "take the stiffness from results instead: unit loads on every diaphragm";
    if let Some(name) = model.semirigid.first() {
        return refuse(
            &format!("diaphragm \"{name}\""),
            "is semi-rigid, but floors of jostle are rigid in their plane".into(),
            by_results,
        );
    }
    if let Some(spring) = model.on_springs.first() {
        return refuse(
            spring,
            "stands on springs, which are not read".into(),
            by_results,
        );
    }
    if model.members.is_empty() && model.walls.is_empty() {
        return refuse(
            "",
            "has no columns, beams or walls".into(),
            "export the whole model again",
        );
    }
    let mut joints = Joints::default();
    for member in &model.members {
        member.ends.iter().for_each(|end| {
            joints.add(*end);
        });
    }
    let panels = panels(model, &mut joints)?;
    let pieces = pieces(model, &joints)?;
    // Floors: joints at their height, except those that the source leaves free.
    let mut floor_of = vec![None; joints.at.len()];
    for (joint, at) in joints.at.iter().enumerate() {
        let height = at[2] - facts.base_height();
        floor_of[joint] = floors
            .iter()
            .position(|floor| (floor.height - height).abs() < ONE_JOINT);
    }
    for at in &model.disconnected {
        if let Some(joint) = joints.find(*at) {
            floor_of[joint] = None;
        }
    }
    let mut held = vec![[false; 6]; joints.at.len()];
    for support in &model.supports {
        let Some(joint) = joints.find(support.at) else {
            continue;
        };
        if floor_of[joint].is_some() && [0, 1, 5].iter().any(|direction| support.held[*direction]) {
            return refuse(
                &support.shown,
                "is held in plan, and its floor has mass: the floor would not move".into(),
                "give the storeys that the ground holds no diaphragm, and export the masses again",
            );
        }
        (0..6).for_each(|direction| held[joint][direction] |= support.held[direction]);
    }
    // What stands on the foot of a wall between two supports is supported as they are.
    for [foot, _] in model.walls.iter().filter_map(edges) {
        let [Some(a), Some(b)] = foot.map(|at| joints.find(at)) else {
            continue;
        };
        let both: [bool; 6] =
            std::array::from_fn(|direction| held[a][direction] && held[b][direction]);
        for joint in 0..joints.at.len() {
            if joints.share(joint, foot).is_some() {
                (0..6).for_each(|direction| held[joint][direction] |= both[direction]);
            }
        }
    }
    if !held.iter().flatten().any(|held| *held) {
        return refuse(
            "",
            "has no supported joints".into(),
            "restrain the feet of the columns in the source and export again",
        );
    }
    let (shares, owners, masters) = numbered(&joints, &floor_of, &held, floors);
    let mut elements = elements(model, &joints, &pieces, &shares)?;
    for panel in &panels {
        panel.elements(model, &joints, &shares, &mut elements)?;
    }
    let mut stiffness = envelope(model, &elements, joints.at.len(), owners.len())?;
    // What no member resists, such as the turn of a joint of hinged members, does not move.
    for row in 0..owners.len() {
        if stiffness.diagonal(row) == 0.0 {
            stiffness.add(row, row, 1.0);
        }
    }
    if let Err(row) = stiffness.factorize(LEAST_PIVOT) {
        let object = match owners[row] {
            Owner::Joint(joint, _) => {
                let [x, y, z] = joints.at[joint].map(|coordinate| format!("{coordinate:.3}"));
                format!("the joint at {x}, {y}, {z} m")
            }
            Owner::Floor(floor) => format!("storey \"{}\"", floors[floor].name),
        };
        let way = match owners[row] {
            Owner::Joint(_, way) => MOVES[way],
            Owner::Floor(_) => "move",
        };
        return refuse(
            &object,
            format!("can {way} without resistance: hinges make a mechanism there or below"),
            "remove releases in the source, or hold what they free",
        );
    }
    let mut flexibility = Vec::new();
    for load in masters.as_flattened() {
        let mut values = vec![0.0; owners.len()];
        values[*load] = 1.0;
        stiffness.solve(&mut values);
        flexibility.push(
            masters
                .as_flattened()
                .iter()
                .map(|row| values[*row])
                .collect(),
        );
    }
    symmetrise(&mut flexibility);
    Ok(Assembled {
        flexibility,
        remarks: remarks(model, &joints, [pieces.len(), panels.len()], owners.len()),
    })
}

/// A part of a member between two joints.
struct Piece {
    member: usize,
    joints: [usize; 2],
    /// Whether its ends are those of the member.
    outer: [bool; 2],
}

/// Members in pieces between the joints that lie on them.
fn pieces(model: &TextModel, joints: &Joints) -> Result<Vec<Piece>, InputError> {
    let mut by_height: Vec<usize> = (0..joints.at.len()).collect();
    by_height.sort_by(|a, b| joints.at[*a][2].total_cmp(&joints.at[*b][2]));
    let heights: Vec<f64> = by_height.iter().map(|joint| joints.at[*joint][2]).collect();
    let mut found = Vec::new();
    for (index, member) in model.members.iter().enumerate() {
        let [a, b] = member.ends;
        let ends = member.ends.map(|end| joints.find(end).unwrap_or(0));
        if ends[0] == ends[1] {
            return Err(fault(
                &model.file,
                member.shown.clone(),
                "has no length",
                "remove it in the source",
            ));
        }
        let (low, high) = (a[2].min(b[2]) - ONE_JOINT, a[2].max(b[2]) + ONE_JOINT);
        let range = heights.partition_point(|z| *z < low)..heights.partition_point(|z| *z <= high);
        let mut inside: Vec<(f64, usize)> = by_height[range]
            .iter()
            .filter(|joint| !ends.contains(joint))
            .filter_map(|joint| Some((joints.share(*joint, member.ends)?, *joint)))
            .collect();
        inside.sort_by(|a, b| a.0.total_cmp(&b.0));
        let all: Vec<usize> = std::iter::once(ends[0])
            .chain(inside.into_iter().map(|inside| inside.1))
            .chain(std::iter::once(ends[1]))
            .collect();
        for (part, pair) in all.windows(2).enumerate() {
            found.push(Piece {
                member: index,
                joints: [pair[0], pair[1]],
                outer: [part == 0, part + 2 == all.len()],
            });
        }
    }
    Ok(found)
}

/// Whose a free displacement is.
#[derive(Clone, Copy)]
enum Owner {
    Joint(usize, usize),
    Floor(usize),
}

/// Numbers free displacements from the ground up, those of a floor behind its joints.
fn numbered(
    joints: &Joints,
    floor_of: &[Option<usize>],
    held: &[[bool; 6]],
    floors: &[Floor],
) -> (Vec<[Shares; 6]>, Vec<Owner>, Vec<[usize; 3]>) {
    let mut order: Vec<usize> = (0..joints.at.len()).collect();
    // Along the longer side of the plan, so that neighbours are near in number.
    let extent = [0, 1].map(|axis| {
        let all = joints.at.iter().map(|at| at[axis]);
        all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
    });
    let longer = usize::from(extent[1] > extent[0]);
    order.sort_by(|a, b| {
        let [a, b] = [joints.at[*a], joints.at[*b]];
        let level = |at: [f64; 3]| (at[2] / (2.0 * ONE_JOINT)).round();
        level(a)
            .total_cmp(&level(b))
            .then(a[longer].total_cmp(&b[longer]))
            .then(a[1 - longer].total_cmp(&b[1 - longer]))
    });
    let mut owners = Vec::new();
    let mut shares: Vec<[Shares; 6]> = vec![Default::default(); joints.at.len()];
    let mut masters = vec![[0; 3]; floors.len()];
    let mut left: Vec<usize> = floors
        .iter()
        .enumerate()
        .map(|(floor, _)| {
            floor_of
                .iter()
                .filter(|candidate| **candidate == Some(floor))
                .count()
        })
        .collect();
    let mut number_floor = |floor: usize, owners: &mut Vec<Owner>| {
        masters[floor] = [0, 1, 2].map(|offset| owners.len() + offset);
        owners.extend([Owner::Floor(floor); 3]);
    };
    for joint in &order {
        for way in 0..6 {
            let moves_with_floor = floor_of[*joint].is_some() && [0, 1, 5].contains(&way);
            if !held[*joint][way] && !moves_with_floor {
                shares[*joint][way] = vec![(owners.len(), 1.0)];
                owners.push(Owner::Joint(*joint, way));
            }
        }
        if let Some(floor) = floor_of[*joint] {
            left[floor] -= 1;
            if left[floor] == 0 {
                number_floor(floor, &mut owners);
            }
        }
    }
    // Floors without joints.
    for (floor, storey) in floors.iter().enumerate() {
        let _ = storey;
        if floor_of.iter().all(|other| *other != Some(floor)) {
            number_floor(floor, &mut owners);
        }
    }
    for (joint, floor) in floor_of.iter().enumerate() {
        let Some(floor) = *floor else { continue };
        let [x, y] = floors[floor].centre.unwrap_or_default();
        let [along, across, turn] = masters[floor];
        let [px, py, _] = joints.at[joint];
        shares[joint][0] = vec![(along, 1.0), (turn, y - py)];
        shares[joint][1] = vec![(across, 1.0), (turn, px - x)];
        shares[joint][5] = vec![(turn, 1.0)];
    }
    (shares, owners, masters)
}

/// The elements of all pieces of members.
fn elements(
    model: &TextModel,
    joints: &Joints,
    pieces: &[Piece],
    shares: &[[Shares; 6]],
) -> Result<Vec<Element>, InputError> {
    let mut found = Vec::new();
    for piece in pieces {
        let member = &model.members[piece.member];
        let refuse = |problem: String, remedy: &str| {
            fault(&model.file, member.shown.clone(), problem, remedy)
        };
        let (rigidity, turn) =
            rigidity(member, model).map_err(|(problem, remedy)| refuse(problem, remedy))?;
        if turn != 0.0 && member.is_released() {
            return Err(refuse(
                "has released ends, and a section whose axes are not principal ones (I23)".into(),
                "take the stiffness from results instead: unit loads on every diaphragm",
            ));
        }
        let mut beam = Beam {
            ends: piece.joints.map(|joint| joints.at[joint]),
            angle: member.angle + turn,
            rigidity,
            releases: member.releases,
            stiff_ends: member.stiff_ends,
        };
        for end in 0..2 {
            if !piece.outer[end] {
                beam.releases[end] = [false; 6];
                beam.stiff_ends[end] = 0.0;
            }
        }
        let Some(stiffness) = beam.stiffness() else {
            return Err(refuse(
                "has stiff end lengths that leave nothing between them, or reach beyond a joint on it".into(),
                "shorten its end offsets in the source",
            ));
        };
        let rows = std::array::from_fn(|row| shares[piece.joints[row / 6]][row % 6].clone());
        found.push(Element::new(rows, &stiffness));
    }
    Ok(found)
}

/// Adds up the stiffness of all elements.
fn envelope(
    model: &TextModel,
    elements: &[Element],
    joints: usize,
    order: usize,
) -> Result<Envelope, InputError> {
    let mut firsts: Vec<usize> = (0..order).collect();
    for (row, column, _) in elements.iter().flat_map(|element| &element.0) {
        firsts[*row] = firsts[*row].min(*column);
    }
    let numbers: usize = firsts
        .iter()
        .enumerate()
        .map(|(row, first)| row + 1 - first)
        .sum();
    if numbers > MOST_NUMBERS {
        return Err(fault(
            &model.file,
            "",
            format!("has {joints} joints: its stiffness matrix is too large"),
            "take the stiffness from results instead: unit loads on every diaphragm",
        ));
    }
    let mut matrix = Envelope::new(firsts);
    for (row, column, value) in elements.iter().flat_map(|element| &element.0) {
        matrix.add(*row, *column, *value);
    }
    Ok(matrix)
}

/// What the structure has, and what it leaves out.
fn remarks(
    model: &TextModel,
    joints: &Joints,
    [pieces, panels]: [usize; 2],
    order: usize,
) -> Vec<String> {
    let count = |what: &dyn Fn(&crate::member::Member) -> bool| {
        model.members.iter().filter(|member| what(member)).count()
    };
    let mut found = vec![format!(
        "elastic, assembled from {} members between {} joints with {order} displacements, of which the floors' are kept",
        model.members.len(),
        joints.at.len()
    )];
    if panels > 0 {
        found.push(format!("{} wall areas as wide columns in {panels} panels between the levels of joints: some percent from shells of fine meshes; compare the periods. Two walls alone that meet at a corner resist torsion by their bending across, which is too soft here: periods of torsion can be longer by half", model.walls.len()));
    }
    let split = pieces - model.members.len();
    if split > 0 {
        found.push(format!(
            "{split} times a member is connected to the end of another that lies on it"
        ));
    }
    let released = count(&|member| member.is_released());
    if released > 0 {
        found.push(format!("{released} members with released ends"));
    }
    let stiff = count(&|member| member.stiff_ends.iter().any(|end| *end > 0.0));
    if stiff > 0 {
        found.push(format!("{stiff} members with stiff end lengths"));
    }
    found
}
