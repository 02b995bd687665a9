//! Braces between any two joints of a space frame: the stiffness method with twelve displacements a member, equilibrium of storeys, turned
//! and mirrored frames.

use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule, Stage};
use jostle::linear::StepMatrix;
use jostle::structure::{MemberPlace, solve_once};
use jostle::{
    Bearing, Diagonal, DiagonalKind, DiagonalPlace, GridLine, GroundMotion, Outcome, PlanAxis,
    PlanPoint, Reach, RiccatiSweep, Rise, Solver, SpaceFrame, SpaceMember, SpacePlace,
    SpaceSection, State, StrutLine, System, Tier, Tiers,
};
use jostle_testkit::compare::close;
use jostle_testkit::motions::fading;
use jostle_testkit::runs::{self, assembled};

use super::diagonals_in_space::model;
use super::struck_in_space::{Beams, Dense, condensed, transformed};

const E: f64 = 30e9;
const LINES: [[f64; 3]; 2] = [[0.0, 6.0, 11.0], [0.0, 5.0, 9.0]];
const HEIGHTS: [f64; 2] = [4.0, 3.6];
const CENTRE: PlanPoint = [5.1, 4.7];

/// A joint: floor, 0 for the ground, and lines of x and y from 0.
type Joint = (usize, [usize; 2]);

/// Braces of one storey and several, along the lines, across them, and upright; with their stiffness \[N/m\].
const BRACES: [(Joint, Joint, f64); 5] = [
    ((0, [0, 0]), (2, [2, 2]), 5e7),
    ((0, [2, 0]), (1, [0, 2]), 3e7),
    ((1, [0, 2]), (2, [1, 0]), 4e7),
    ((0, [1, 1]), (2, [1, 1]), 9e7),
    ((0, [2, 2]), (2, [2, 0]), 6e7),
];

fn column(stretches: bool) -> SpaceSection {
    let section = SpaceSection::rectangle([0.5, 0.4], E, 0.2, false).expect("a section");
    SpaceSection {
        axial_rigidity: section.axial_rigidity.filter(|_| stretches),
        ..section
    }
}

fn beam(size: [f64; 2]) -> SpaceSection {
    SpaceSection::beam(size, E, 0.2, false).expect("a section")
}

fn section(place: SpacePlace, stretches: bool) -> SpaceSection {
    match place {
        SpacePlace::Column { .. } => column(stretches),
        SpacePlace::BeamX { .. } => beam([0.3, 0.6]),
        SpacePlace::BeamY { .. } => beam([0.25, 0.5]),
    }
}

/// Every column and beam of the grid.
fn places() -> Vec<SpacePlace> {
    let mut found = Vec::new();
    for storey in 0..HEIGHTS.len() {
        let floor = storey;
        for other in 0..9 {
            let [x, y] = [other % 3, other / 3];
            let line = [x, y];
            found.push(SpacePlace::Column { line, storey });
            if x < 2 {
                let (span, line) = (x, y);
                found.push(SpacePlace::BeamX { span, line, floor });
            }
            if y < 2 {
                let (span, line) = (y, x);
                found.push(SpacePlace::BeamY { line, span, floor });
            }
        }
    }
    found
}

/// A brace by its joints, the lower one first.
fn brace((low, [x, y]): Joint, (high, [to_x, to_y]): Joint, stiffness: f64) -> Diagonal {
    let (along, [from, to], [own, other]) = match x == to_x {
        true if y != to_y => (PlanAxis::Y, [y, to_y], [x, to_x]),
        _ => (PlanAxis::X, [x, to_x], [y, to_y]),
    };
    Diagonal {
        place: DiagonalPlace {
            kind: DiagonalKind::Brace,
            line: Some(GridLine {
                along,
                number: own + 1,
            }),
            storey: low + 1,
            bay: from.min(to) + 1,
            rise: if from <= to { Rise::Right } else { Rise::Left },
            reach: Reach {
                storeys: high - low,
                bays: from.abs_diff(to),
                across: other as isize - own as isize,
            },
            strut: StrutLine::Central,
        },
        stiffness,
        hysteresis: None,
        offsets: [0.0; 2],
        across: None,
        damage: None,
    }
}

fn frame(stretches: bool) -> SpaceFrame {
    let members = places().into_iter();
    let members = members.map(|place| SpaceMember::elastic(place, section(place, stretches)));
    let braces = BRACES
        .iter()
        .filter(|(from, to, _)| stretches || from.1 != to.1);
    SpaceFrame {
        lines_x: LINES[0].to_vec(),
        lines_y: LINES[1].to_vec(),
        members: members.collect(),
        diagonals: braces
            .map(|(from, to, stiffness)| brace(*from, *to, *stiffness))
            .collect(),
        ..SpaceFrame::default()
    }
}

fn tiers(frame: SpaceFrame) -> Tiers {
    let plan = vec![[0.0, 0.0], [11.0, 0.0], [11.0, 9.0], [0.0, 9.0]];
    let mut tier = Tier::uniform(90e3, plan).expect("an area");
    tier.centre = CENTRE;
    Tiers {
        floors: vec![tier; HEIGHTS.len()],
        storey_heights: HEIGHTS.to_vec(),
        space_frame: Some(frame),
        ..Tiers::default()
    }
}

/// K over the motions of both floors, by beams and bars with six displacements at each end.
fn by_hand(braced: bool) -> Dense {
    let node = |level: usize, [x, y]: [usize; 2]| 9 * level + 3 * y + x;
    let mut beams = Beams::new(27);
    for place in places() {
        let section = section(place, true);
        let [first, last] = place.crossings();
        let level = place.storey() + 1;
        let [vertical, sideways] = section.flexural_rigidity;
        let torsion = section.torsional_rigidity;
        match place {
            SpacePlace::Column { storey, .. } => {
                let axial = section.axial_rigidity.expect("it stretches");
                let rigidities = [axial, torsion, vertical, sideways];
                beams.member(
                    [node(storey, first), node(level, last)],
                    2,
                    HEIGHTS[storey],
                    rigidities,
                );
            }
            // Floors hold their length and their bending sideways.
            SpacePlace::BeamX { span, .. } => {
                let length = LINES[0][span + 1] - LINES[0][span];
                let rigidities = [1e9, torsion, sideways, vertical];
                beams.member(
                    [node(level, first), node(level, last)],
                    0,
                    length,
                    rigidities,
                );
            }
            SpacePlace::BeamY { span, .. } => {
                let length = LINES[1][span + 1] - LINES[1][span];
                let rigidities = [1e9, torsion, vertical, sideways];
                beams.member(
                    [node(level, first), node(level, last)],
                    1,
                    length,
                    rigidities,
                );
            }
        }
    }
    let at = |(floor, [x, y]): Joint| {
        let height: f64 = HEIGHTS[..floor].iter().sum();
        [LINES[0][x], LINES[1][y], height]
    };
    for (from, to, stiffness) in BRACES.iter().filter(|_| braced) {
        let ([a, b], way) = ([at(*from), at(*to)], |axis: usize| {
            at(*to)[axis] - at(*from)[axis]
        });
        let length = (0..3)
            .map(|axis| (b[axis] - a[axis]).powi(2))
            .sum::<f64>()
            .sqrt();
        let [first, last] = [from, to].map(|joint| 6 * node(joint.0, joint.1));
        let dofs: Vec<usize> = (0..3)
            .map(|axis| first + axis)
            .chain((0..3).map(|axis| last + axis))
            .collect();
        let share = |k: usize| if k < 3 { -way(k) } else { way(k - 3) } / length;
        let rows: Dense = (0..6)
            .map(|i| (0..6).map(|j| stiffness * share(i) * share(j)).collect())
            .collect();
        let rows: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
        beams.add(&dofs, &rows);
    }
    // Floors, then the rise and both rotations of every joint.
    let mut by = vec![vec![0.0; 6 + 3 * 18]; 6 * 27];
    let mut next = 6;
    for floor in [0, 1] {
        for crossing in 0..9 {
            let line = [crossing % 3, crossing / 3];
            let [x, y, _] = at((floor + 1, line));
            let row = 6 * node(floor + 1, line);
            by[row][3 * floor] = 1.0;
            by[row][3 * floor + 2] = CENTRE[1] - y;
            by[row + 1][3 * floor + 1] = 1.0;
            by[row + 1][3 * floor + 2] = x - CENTRE[0];
            by[row + 5][3 * floor + 2] = 1.0;
            for component in [2, 3, 4] {
                by[row + component][next] = 1.0;
                next += 1;
            }
        }
    }
    condensed(&transformed(&beams.stiffness, &by), 6).0
}

/// Displacements of the floors under forces on them, as u_x, u_y, θ of each in turn.
fn pushed(system: &System, push: [f64; 6]) -> [f64; 6] {
    let building = &system.buildings[0];
    let mut load = vec![0.0; building.equations.len()];
    let dof = |motion: usize| building.tracks[motion % 3 * 2 + motion / 3].dof;
    for (motion, force) in push.into_iter().enumerate() {
        load[dof(motion)] = force;
    }
    let answer =
        solve_once::<RiccatiSweep>(building, &StepMatrix::STATIC, &load).expect("it stands");
    [0, 1, 2, 3, 4, 5].map(|motion| answer[dof(motion)])
}

const PUSHES: [[f64; 6]; 3] = [
    [1e5, -4e4, 3e5, -2e4, 7e4, -1e5],
    [0.0, 0.0, 0.0, 1e5, 0.0, 0.0],
    [0.0, 0.0, 0.0, 0.0, 0.0, 1e6],
];

fn yielding(stiffness: f64) -> Option<Hysteresis> {
    let corners = Corners::bilinear(4e4, 0.03);
    let backbone = Backbone::from_forces(stiffness, corners, corners).expect("sound");
    Hysteresis::new(HysteresisRule::Bilinear, backbone).ok()
}

/// Forces on floors follow from their displacements by the matrix of the test, whether joints follow the floors or move by themselves.
#[test]
fn braces_between_any_joints_follow_the_stiffness_method() {
    for own_joints in [false, true] {
        for braced in [false, true] {
            let mut frame = frame(true);
            frame.diagonals.retain(|_| braced);
            if own_joints {
                for brace in &mut frame.diagonals {
                    brace.hysteresis = yielding(brace.stiffness);
                }
            }
            let system = assembled(&model(tiers(frame), Solver::Riccati));
            let matrix = by_hand(braced);
            for push in PUSHES {
                let moved = pushed(&system, push);
                let scale = push
                    .iter()
                    .fold(0.0_f64, |most, force| most.max(force.abs()));
                for (row, due) in matrix.iter().zip(push) {
                    let terms = row.iter().zip(moved).map(|(k, u)| k * u);
                    close(terms.sum(), due, scale, 1e-9, "force on a floor");
                }
            }
        }
    }
    let [plain, braced] = [false, true].map(by_hand);
    assert!(braced[3][3] > 1.2 * plain[3][3] && braced[4][4] > 1.2 * plain[4][4]);
}

/// Columns and braces that cross a storey bear no weight together, also where columns keep their length.
#[test]
fn storeys_are_in_equilibrium() {
    for stretches in [false, true] {
        for own_joints in [false, true] {
            let mut frame = frame(stretches);
            if own_joints {
                // A hinge in one beam.
                let is_beam =
                    |member: &&mut SpaceMember| matches!(member.place, SpacePlace::BeamX { .. });
                let beam = frame.members.iter_mut().find(is_beam).expect("a beam");
                beam.hinges[0] = yielding(1e9);
            }
            let system = assembled(&model(tiers(frame.clone()), Solver::Riccati));
            let building = &system.buildings[0];
            let mut load = vec![0.0; building.equations.len()];
            for (motion, force) in PUSHES[0].into_iter().enumerate() {
                load[building.tracks[motion % 3 * 2 + motion / 3].dof] = force;
            }
            let answer = solve_once::<RiccatiSweep>(building, &StepMatrix::STATIC, &load);
            let mut state = State::at_rest(&system, 0.0);
            state
                .displacement
                .copy_from_slice(&answer.expect("it stands"));
            let mut forces = vec![0.0; building.members.forms.len()];
            building.member_forces(&state, &[], 0.0, |form, value| forces[form] = value);
            for storey in 0..HEIGHTS.len() {
                let mut sums = [0.0; 2];
                for member in &building.members.members {
                    if let MemberPlace::InSpace(place @ SpacePlace::Column { .. }) = member.place
                        && place.storey() == storey
                    {
                        let force = forces[member.sections[0].forms[0]];
                        sums[0] += force;
                        sums[1] += force.abs();
                    }
                }
                for (force, diagonal) in building.members.diagonals.iter().zip(&frame.diagonals) {
                    let [low, high] = diagonal.place.floors();
                    let [x, y] = frame.run(diagonal.place).expect("in a grid");
                    let rise: f64 = HEIGHTS[low..high].iter().sum();
                    if (low..high).contains(&storey) {
                        sums[0] += forces[force.form] * rise / (x * x + y * y + rise * rise).sqrt();
                    }
                }
                assert!(sums[1] > 1e4);
                close(sums[0], 0.0, sums[1], 1e-9, "storey");
            }
        }
    }
}

fn shaken(tiers: Tiers, angle: f64, sign: f64) -> (System, Outcome) {
    let motion = GroundMotion {
        bearing: Some(Box::new(Bearing {
            angle,
            across: Some(fading("across", 7.0, [1.5 * sign, 3.0], 150)),
        })),
        ..fading("along", 9.0, [2.0, 3.0], 150)
    };
    let (system, outcome) = runs::run(&model(tiers, Solver::Riccati), &motion, Some(2e-3));
    assert!(outcome.energy.worst_imbalance < 1e-6);
    (system, outcome)
}

fn turned(tiers: &Tiers, angle: f64) -> Tiers {
    let mut turned = tiers.clone();
    let (s, c) = angle.sin_cos();
    let turn = |[x, y]: PlanPoint| [c * x - s * y, s * x + c * y];
    for floor in &mut turned.floors {
        floor.centre = turn(floor.centre);
        floor.plan.iter_mut().for_each(|at| *at = turn(*at));
    }
    turned.space_frame.as_mut().expect("a frame").direction = [c, s];
    turned
}

/// Seen from the other side of the y axis.
fn mirrored(tiers: &Tiers) -> Tiers {
    let mut mirrored = tiers.clone();
    for floor in &mut mirrored.floors {
        floor.centre[0] *= -1.0;
        floor.plan.iter_mut().for_each(|corner| corner[0] *= -1.0);
        floor.plan.reverse();
    }
    let frame = mirrored.space_frame.as_mut().expect("a frame");
    frame.lines_x = frame.lines_x.iter().rev().map(|x| -x).collect();
    for member in &mut frame.members {
        member.place = match member.place {
            SpacePlace::Column {
                line: [x, y],
                storey,
            } => SpacePlace::Column {
                line: [2 - x, y],
                storey,
            },
            SpacePlace::BeamX { span, line, floor } => SpacePlace::BeamX {
                span: 1 - span,
                line,
                floor,
            },
            SpacePlace::BeamY { line, span, floor } => SpacePlace::BeamY {
                line: 2 - line,
                span,
                floor,
            },
        };
    }
    for (diagonal, (from, to, stiffness)) in frame.diagonals.iter_mut().zip(BRACES) {
        let [from, to] = [from, to].map(|(floor, [x, y])| (floor, [2 - x, y]));
        diagonal.place = brace(from, to, stiffness).place;
    }
    mirrored
}

/// Braces yield alike in a frame that stands turned with its shaking, and in its mirror image.
#[test]
fn turned_and_mirrored_braces_yield_alike() {
    let mut frame = frame(true);
    for brace in &mut frame.diagonals {
        brace.hysteresis = yielding(brace.stiffness);
    }
    let tiers = tiers(frame);
    let (system, outcome) = shaken(tiers.clone(), 0.3, 1.0);
    let building = &system.buildings[0];
    let all = building
        .equations
        .springs
        .iter()
        .zip(&outcome.state.springs);
    let yielded = all.filter(|(spring, memory)| spring.hysteresis.stage(memory) == Stage::Yielded);
    assert!(yielded.count() >= 4);
    assert_eq!(
        building.discretization.spring_places[0].to_string(),
        "brace, floor 0, x = 1, y = 1 to floor 2, x = 3, y = 3"
    );
    let forces = |(system, outcome): &(System, Outcome)| -> Vec<[f64; 2]> {
        let forces = system.buildings[0].members.diagonals.iter();
        forces.map(|force| outcome.members[0][force.form]).collect()
    };
    let reference = forces(&(system, outcome));
    let others = [
        ("turned", shaken(turned(&tiers, 0.7), 1.0, 1.0)),
        (
            "mirrored",
            shaken(mirrored(&tiers), std::f64::consts::PI - 0.3, -1.0),
        ),
    ];
    for (name, other) in others {
        for (force, other) in reference.iter().zip(forces(&other)) {
            for (force, other) in force.iter().zip(other) {
                close(other, *force, 4e4, 1e-7, name);
            }
        }
    }
}
