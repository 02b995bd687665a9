//! Space frames: closed forms, plane frames as their limit, equilibrium of joints and storeys, turned and mirrored sites.

use std::collections::BTreeMap;

use jostle::linear::StepMatrix;
use jostle::structure::{MemberPlace, solve_once};
use jostle::system::BuildingSystem;
use jostle::{
    Analysis, Axial, Base, Building, Damping, Frame, FrameHinges, Gap, GroundMotion, MemberRequest,
    Model, Outcome, PlanFrame, PlanPoint, RiccatiSweep, Section, Solver, SpaceFrame, SpaceMember,
    SpacePlace, SpaceSection, State, Structure, System, Tier, TierStorey, Tiers,
};
use jostle_testkit::compare::close;
use jostle_testkit::models::{CONCRETE, FIVE_PERCENT};
use jostle_testkit::runs::{self, assembled};

const E: f64 = 30e9;
const NU: f64 = 0.2;

/// Which members deform how.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flexible {
    pub(super) axial: bool,
    pub(super) shear: bool,
}

const FULLY: Flexible = Flexible {
    axial: true,
    shear: true,
};

fn column(size: [f64; 2], flexible: Flexible) -> SpaceSection {
    let mut rectangle = SpaceSection::rectangle(size, E, NU, flexible.shear).expect("a section");
    if !flexible.axial {
        rectangle.axial_rigidity = None;
    }
    rectangle
}

fn beam(size: [f64; 2], flexible: Flexible) -> SpaceSection {
    SpaceSection::beam(size, E, NU, flexible.shear).expect("a section")
}

/// All members of a regular grid.
fn grid(lines_x: &[f64], lines_y: &[f64], storeys: usize, flexible: Flexible) -> SpaceFrame {
    let (nx, ny) = (lines_x.len(), lines_y.len());
    let mut members = Vec::new();
    for storey in 0..storeys {
        for y in 0..ny {
            for x in 0..nx {
                members.push(SpaceMember::elastic(
                    SpacePlace::Column {
                        line: [x, y],
                        storey,
                    },
                    column([0.5, 0.4], flexible),
                ));
                if x + 1 < nx {
                    members.push(SpaceMember::elastic(
                        SpacePlace::BeamX {
                            span: x,
                            line: y,
                            floor: storey,
                        },
                        beam([0.3, 0.6], flexible),
                    ));
                }
                if y + 1 < ny {
                    members.push(SpaceMember::elastic(
                        SpacePlace::BeamY {
                            line: x,
                            span: y,
                            floor: storey,
                        },
                        beam([0.25, 0.5], flexible),
                    ));
                }
            }
        }
    }
    SpaceFrame {
        at: [0.0, 0.0],
        direction: [1.0, 0.0],
        lines_x: lines_x.to_vec(),
        lines_y: lines_y.to_vec(),
        members,
        ..SpaceFrame::default()
    }
}

/// An L of three storeys with a set-back, unequal columns, and beams that are missing.
pub(super) fn without_symmetry(flexible: Flexible) -> Tiers {
    let mut frame = grid(&[0.0, 6.0, 11.0], &[0.0, 5.0, 9.0], 3, flexible);
    frame.members.retain(|member| {
        let [a, b] = member.place.crossings();
        let outside = |[x, y]: [usize; 2]| x == 2 && y == 2;
        // The roof covers the left part only.
        let above = |[x, _]: [usize; 2]| member.place.storey() == 2 && x == 2;
        let missing = member.place
            == SpacePlace::BeamY {
                line: 1,
                span: 0,
                floor: 1,
            };
        !(outside(a) || outside(b) || above(a) || above(b) || missing)
    });
    for member in &mut frame.members {
        if let SpacePlace::Column { line: [0, 1], .. } = member.place {
            member.section = column([0.5, 0.8], flexible);
        }
        if let SpacePlace::Column { line: [2, 0], .. } = member.place {
            member.section = column([0.35, 0.45], flexible);
        }
    }
    let l_shape = vec![
        [0.0, 0.0],
        [11.0, 0.0],
        [11.0, 5.0],
        [6.0, 5.0],
        [6.0, 9.0],
        [0.0, 9.0],
    ];
    let part = vec![[0.0, 0.0], [6.0, 0.0], [6.0, 9.0], [0.0, 9.0]];
    let floor = |mass: f64, plan: &Vec<PlanPoint>| Tier::uniform(mass, plan.clone()).expect("area");
    Tiers {
        floors: vec![
            floor(95e3, &l_shape),
            floor(92e3, &l_shape),
            floor(50e3, &part),
        ],
        storey_heights: vec![4.0, 3.2, 3.2],
        space_frame: Some(frame),
        ..Tiers::default()
    }
}

fn building(name: &str, tiers: Tiers, damping: Damping) -> Building {
    Building {
        name: name.to_owned(),
        structure: Structure::Tiers(tiers),
        damping,
        ..Building::default()
    }
}

fn model(buildings: Vec<Building>, gaps: Vec<Gap>) -> Model {
    Model {
        title: "space frames".to_owned(),
        buildings,
        gaps,
        analysis: Analysis {
            solver: Some(Solver::Modal),
            tolerance: 1e-5,
            members: MemberRequest::all(),
            ..Analysis::default()
        },
        ..Model::default()
    }
}

fn single(tiers: Tiers) -> System {
    assembled(&model(vec![building("A", tiers, FIVE_PERCENT)], vec![]))
}

/// Displacements of the floors, u_x, u_y, θ each, under forces on them.
fn statics(system: &BuildingSystem, pushes: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let n = system.floors.len();
    let answer = pushed(system, pushes);
    (0..n)
        .map(|floor| [0, 1, 2].map(|direction| answer[system.tracks[direction * n + floor].dof]))
        .collect()
}

/// All displacements under forces on the floors.
fn pushed(system: &BuildingSystem, pushes: &[[f64; 3]]) -> Vec<f64> {
    let n = system.floors.len();
    let mut load = vec![0.0; system.equations.len()];
    for (floor, push) in pushes.iter().enumerate() {
        for (direction, force) in push.iter().enumerate() {
            load[system.tracks[direction * n + floor].dof] = *force;
        }
    }
    solve_once::<RiccatiSweep>(system, &StepMatrix::STATIC, &load).expect("it stands")
}

/// Forces at both ends of every member: axial, shear and moment, then shear and moment across and torque.
fn end_forces(system: &System, floors: &[[f64; 3]]) -> Vec<(SpacePlace, [[f64; 6]; 2])> {
    let building = &system.buildings[0];
    let n = floors.len();
    let mut state = State::at_rest(system, 0.0);
    for (floor, moved) in floors.iter().enumerate() {
        for (direction, value) in moved.iter().enumerate() {
            state.displacement[building.tracks[direction * n + floor].dof] = *value;
        }
    }
    end_forces_of(building, &state)
}

/// The same in any state.
fn end_forces_of(building: &BuildingSystem, state: &State) -> Vec<(SpacePlace, [[f64; 6]; 2])> {
    let mut forces = vec![0.0; building.members.forms.len()];
    building.member_forces(state, &[], 0.0, |form, value| forces[form] = value);
    let members = building.members.members.iter();
    members
        .map(|member| {
            let MemberPlace::InSpace(place) = member.place else {
                panic!("a member in space");
            };
            let ends = [0, 1].map(|end| {
                let section = &member.sections[end];
                let [n, v, m] = section.forms.map(|form| forces[form]);
                let across = section.across.expect("in space");
                let [va, ma, t] = across.map(|form| forces[form]);
                [n, v, m, va, ma, t]
            });
            (place, ends)
        })
        .collect()
}

const PUSHES: [[f64; 3]; 3] = [[1e5, -4e4, 3e5], [-2e4, 7e4, -1e5], [5e4, 6e4, 2e5]];

/// Without beams every column is a cantilever: k = 1/(h³/3EI + h/GA) in both directions, and floors turn against
/// Σ k_x y² + k_y x² + GJ/h.
#[test]
fn columns_without_beams_are_cantilevers() {
    let h = 3.6;
    for shear in [false, true] {
        let flexible = Flexible { axial: true, shear };
        let mut frame = grid(&[0.0, 6.0], &[0.0, 5.0], 1, flexible);
        let is_column = |member: &SpaceMember| matches!(member.place, SpacePlace::Column { .. });
        frame.members.retain(is_column);
        let section = frame.members[0].section;
        let plan = vec![[0.0, 0.0], [6.0, 0.0], [6.0, 5.0], [0.0, 5.0]];
        let system = single(Tiers {
            floors: vec![Tier::uniform(60e3, plan).expect("an area")],
            storey_heights: vec![h],
            space_frame: Some(frame),
            ..Tiers::default()
        });
        let [kx, ky] = [0, 1].map(|plane| {
            let bent = h.powi(3) / (3.0 * section.flexural_rigidity[plane]);
            let sheared = section
                .shear_rigidity
                .map_or(0.0, |shear_rigidity| h / shear_rigidity[plane]);
            1.0 / (bent + sheared)
        });
        let torsion = 4.0 * (kx * 2.5 * 2.5 + ky * 3.0 * 3.0 + section.torsional_rigidity / h);
        let expected = [4.0 * kx, 4.0 * ky, torsion];
        for (direction, stiffness) in expected.into_iter().enumerate() {
            let mut push = [0.0; 3];
            push[direction] = stiffness;
            let moved = statics(&system.buildings[0], &[push])[0];
            for (other, value) in moved.iter().enumerate() {
                let wanted = if other == direction { 1.0 } else { 0.0 };
                close(*value, wanted, 1.0, 1e-12, "cantilevers");
            }
        }
    }
}

/// One bay deep and shaken along x, a frame is two plane ones: beams across neither bend nor twist, and columns do not bend across.
#[test]
fn a_pair_of_frames_is_its_plane_limit() {
    let lines = [0.0, 6.0, 11.0];
    let heights = [4.0, 3.2, 3.2];
    for flexible in [
        FULLY,
        Flexible {
            axial: true,
            shear: false,
        },
        Flexible {
            axial: false,
            shear: false,
        },
    ] {
        let space = grid(&lines, &[0.0, 5.0], 3, flexible);
        let plan = vec![[0.0, 0.0], [11.0, 0.0], [11.0, 5.0], [0.0, 5.0]];
        let tier = Tier::uniform(90e3, plan).expect("an area");
        let tiers = |frames: Vec<PlanFrame>, space_frame: Option<SpaceFrame>| Tiers {
            floors: vec![tier.clone(); 3],
            // The plane ones need something across.
            storeys: match frames.is_empty() {
                true => Vec::new(),
                false => vec![
                    TierStorey {
                        stiffness: [0.0, 80e6, 5e9],
                        centre: [5.5, 2.5],
                    };
                    3
                ],
            },
            storey_heights: heights.to_vec(),
            frames,
            space_frame,
            ..Tiers::default()
        };
        let section_of = |section: SpaceSection| Section {
            flexural_rigidity: section.flexural_rigidity[0],
            axial_rigidity: section.axial_rigidity.or(Some(1e9)),
            shear_rigidity: section.shear_rigidity.map(|both| both[0]),
            line_mass: 0.0,
        };
        let plane = Frame {
            storey_heights: heights.to_vec(),
            spans: vec![6.0, 5.0],
            columns: vec![section_of(column([0.5, 0.4], flexible)); 3],
            beams: vec![section_of(beam([0.3, 0.6], flexible)); 3],
            beam_mass: vec![0.0; 3],
            floor_mass: vec![0.0; 3],
            column_segments: 1,
            beam_segments: vec![1; 2],
            axial: Axial {
                columns_flexible: flexible.axial,
                beams_flexible: false,
            },
            ..Frame::default()
        };
        let standing = |name: &str, y: f64| PlanFrame {
            name: name.to_owned(),
            at: [0.0, y],
            direction: [1.0, 0.0],
            lines: Vec::new(),
            base: Base::default(),
            frame: plane.clone(),
            hinges: FrameHinges::default(),
        };
        let of_space = single(tiers(Vec::new(), Some(space)));
        let of_plane = single(tiers(vec![standing("1", 0.0), standing("2", 5.0)], None));
        let pushes = [[1e5, 0.0, 0.0], [-3e4, 0.0, 0.0], [2e5, 0.0, 0.0]];
        let a = statics(&of_space.buildings[0], &pushes);
        let b = statics(&of_plane.buildings[0], &pushes);
        for (a, b) in a.iter().zip(&b) {
            close(a[0], b[0], b[0].abs(), 1e-11, "displacement along x");
            close(a[1], 0.0, b[0].abs(), 1e-11, "displacement across");
            close(a[2], 0.0, b[0].abs(), 1e-11, "rotation");
        }
        // Forces of the first plane frame, and of the members on the first line.
        let building = &of_plane.buildings[0];
        let mut load = vec![0.0; building.equations.len()];
        for (floor, push) in pushes.iter().enumerate() {
            load[building.tracks[floor].dof] = push[0];
        }
        let answer =
            solve_once::<RiccatiSweep>(building, &StepMatrix::STATIC, &load).expect("stands");
        let mut state = State::at_rest(&of_plane, 0.0);
        state.displacement.copy_from_slice(&answer);
        let mut forces = vec![0.0; building.members.forms.len()];
        building.member_forces(&state, &[], 0.0, |form, value| forces[form] = value);
        let in_space = end_forces(&of_space, &a);
        let mut compared = 0;
        for member in building
            .members
            .members
            .iter()
            .filter(|m| m.frame == Some(0))
        {
            let wanted = match member.place {
                MemberPlace::Column { line, storey } => SpacePlace::Column {
                    line: [line - 1, 0],
                    storey: storey - 1,
                },
                MemberPlace::Beam { floor, span } => SpacePlace::BeamX {
                    span: span - 1,
                    line: 0,
                    floor: floor - 1,
                },
                MemberPlace::InSpace(_) => panic!("a plane frame"),
            };
            let same = in_space.iter().find(|(place, _)| *place == wanted);
            let (place, ends) = same.expect("the same member");
            for (end, section) in member.sections.iter().enumerate() {
                for (kind, form) in section.forms.iter().enumerate() {
                    let what = format!("{place:?}, end {end}, kind {kind}, {flexible:?}");
                    close(ends[end][kind], forces[*form], 3e5, 1e-10, &what);
                }
            }
            compared += 1;
        }
        assert_eq!(compared, 3 * (3 + 2));
    }
}

/// Every joint is in equilibrium: vertical forces, and moments about both horizontal axes.
#[test]
fn joints_are_in_equilibrium() {
    for axial in [true, false] {
        for shear in [true, false] {
            let tiers = without_symmetry(Flexible { axial, shear });
            let system = single(tiers);
            let moved = statics(&system.buildings[0], &PUSHES);
            let members = end_forces(&system, &moved);
            assert_eq!(check_joints(&members, &format!("axial {axial}")), 8 + 8 + 6);
        }
    }
}

/// Checks that forces of members on every joint balance; returns the number of joints.
fn check_joints(members: &[(SpacePlace, [[f64; 6]; 2])], what: &str) -> usize {
    let mut sums: BTreeMap<(usize, [usize; 2]), [f64; 3]> = BTreeMap::new();
    let mut scales = [0.0_f64; 2];
    for (place, ends) in members {
        let crossings = place.crossings();
        let level = place.storey();
        for (end, [n, v, m, _, ma, t]) in ends.iter().enumerate() {
            scales[0] = scales[0].max(n.abs()).max(v.abs());
            scales[1] = scales[1].max(m.abs()).max(ma.abs());
            // Of the member on its joint. An end that pushes the other part up pulls its own joint down.
            let side = if end == 0 { 1.0 } else { -1.0 };
            let (floor, force) = match place {
                // Tension pulls the foot up. A moment that stretches the face to +x at the foot turns the joint about −y.
                SpacePlace::Column { .. } => {
                    let floor = if end == 0 {
                        level.checked_sub(1)
                    } else {
                        Some(level)
                    };
                    (floor, [side * n, side * ma, -side * m])
                }
                // A moment that stretches the bottom turns the joint at the left end about −y for beams along x.
                SpacePlace::BeamX { .. } => (Some(level), [-side * v, side * t, -side * m]),
                SpacePlace::BeamY { .. } => (Some(level), [-side * v, side * m, side * t]),
            };
            if let Some(floor) = floor {
                let sum = sums.entry((floor, crossings[end])).or_default();
                for (sum, force) in sum.iter_mut().zip(force) {
                    *sum += force;
                }
            }
        }
    }
    let joints = sums.len();
    for ((floor, crossing), [w, x, y]) in sums {
        let what = format!("joint {crossing:?} at floor {floor}, {what}");
        close(w, 0.0, scales[0], 1e-9, &what);
        close(x, 0.0, scales[1], 1e-9, &what);
        close(y, 0.0, scales[1], 1e-9, &what);
    }
    joints
}

/// Columns carry what pushes the floors: shears and torques storey by storey, and overturning moments by axial forces and moments,
/// whatever their base does.
#[test]
fn columns_of_a_storey_carry_what_is_above() {
    let sways = Base {
        horizontal_stiffness: Some(3e7),
        mass: 2e4,
        ..Base::default()
    };
    let turns = Base {
        torsional_stiffness: Some(4e8),
        ..Base::default()
    };
    let rocks = Base {
        rotational_stiffness: Some(5e9),
        ..sways
    };
    let both = Base {
        torsional_stiffness: Some(4e8),
        ..sways
    };
    let bases = [Base::default(), sways, turns, both, rocks];
    for (axial, footing) in [true, false]
        .into_iter()
        .flat_map(|axial| bases.iter().map(move |base| (axial, base)))
    {
        let tiers = without_symmetry(Flexible { axial, shear: true });
        let on_base = Building {
            base: *footing,
            ..building("A", tiers.clone(), FIVE_PERCENT)
        };
        let system = assembled(&model(vec![on_base], vec![]));
        let frame = tiers.space_frame.as_ref().expect("a space frame");
        let mut state = State::at_rest(&system, 0.0);
        state.displacement = pushed(&system.buildings[0], &PUSHES);
        let members = end_forces_of(&system.buildings[0], &state);
        let tops = [4.0, 7.2, 10.4];
        for storey in 0..3 {
            let base = tops[storey] - tiers.storey_heights[storey];
            // Forces along x and y, torque about the origin, and moments about the base that turn the building over to +x and +y.
            let mut sum = [0.0; 5];
            let mut vertical = 0.0;
            for (place, ends) in &members {
                let SpacePlace::Column {
                    line,
                    storey: place,
                } = place
                else {
                    continue;
                };
                if *place != storey {
                    continue;
                }
                let [x, y] = frame.point(*line);
                let [n, v, m, va, ma, t] = ends[0];
                sum[0] += v;
                sum[1] += va;
                sum[2] += x * va - y * v + t;
                sum[3] -= x * n + m;
                sum[4] -= y * n + ma;
                vertical += n;
            }
            let mut expected = [0.0; 5];
            for (floor, [px, py, torque]) in PUSHES.iter().enumerate().skip(storey) {
                let [x, y] = tiers.floors[floor].centre;
                expected[0] += px;
                expected[1] += py;
                expected[2] += x * py - y * px + torque;
                expected[3] += px * (tops[floor] - base);
                expected[4] += py * (tops[floor] - base);
            }
            for (sum, expected) in sum.iter().zip(expected) {
                close(
                    *sum,
                    expected,
                    1e6,
                    1e-9,
                    &format!("storey {storey} on {footing:?}"),
                );
            }
            if footing.rotational_stiffness.is_none() {
                close(vertical, 0.0, 1e6, 1e-9, "axial forces of a storey");
            }
        }
    }
}

/// Turned with its loads by any angle, a building moves alike.
#[test]
fn a_turned_site_gives_turned_displacements() {
    let tiers = without_symmetry(FULLY);
    let before = statics(&single(tiers.clone()).buildings[0], &PUSHES);
    for angle in [0.5, 2.0, -2.5_f64] {
        let (s, c) = angle.sin_cos();
        let turn = |[x, y]: PlanPoint| [c * x - s * y, s * x + c * y];
        let mut turned = tiers.clone();
        for floor in &mut turned.floors {
            floor.centre = turn(floor.centre);
            floor
                .plan
                .iter_mut()
                .for_each(|corner| *corner = turn(*corner));
        }
        let frame = turned.space_frame.as_mut().expect("a frame");
        frame.direction = [c, s];
        let pushes = PUSHES.map(|[x, y, t]| {
            let [x, y] = turn([x, y]);
            [x, y, t]
        });
        let system = single(turned);
        let after = statics(&system.buildings[0], &pushes);
        for (a, b) in after.iter().zip(&before) {
            let [x, y] = turn([b[0], b[1]]);
            let scale = x.hypot(y);
            close(a[0], x, scale, 1e-11, "along x");
            close(a[1], y, scale, 1e-11, "across");
            close(a[2], b[2], 0.1 * scale, 1e-11, "rotation");
        }
        // Members have the same forces in the axes of their lines.
        let same = single(tiers.clone());
        let (one, other) = (end_forces(&system, &after), end_forces(&same, &before));
        for ((_, a), (_, b)) in one.iter().zip(&other) {
            for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
                close(*a, *b, 3e5, 1e-9, "forces of members");
            }
        }
    }
}

/// Mirrored from left to right, displacements along x and rotations change their sign.
#[test]
fn a_mirrored_frame_gives_mirrored_displacements() {
    let tiers = without_symmetry(FULLY);
    let before = statics(&single(tiers.clone()).buildings[0], &PUSHES);
    let mut mirrored = tiers.clone();
    for floor in &mut mirrored.floors {
        floor.centre[0] *= -1.0;
        floor.plan.iter_mut().for_each(|corner| corner[0] *= -1.0);
        floor.plan.reverse();
    }
    let frame = mirrored.space_frame.as_mut().expect("a frame");
    let last = frame.lines_x.len() - 1;
    frame.lines_x = frame.lines_x.iter().rev().map(|x| -x).collect();
    for member in &mut frame.members {
        member.place = match member.place {
            SpacePlace::Column {
                line: [x, y],
                storey,
            } => SpacePlace::Column {
                line: [last - x, y],
                storey,
            },
            SpacePlace::BeamX { span, line, floor } => SpacePlace::BeamX {
                span: last - 1 - span,
                line,
                floor,
            },
            SpacePlace::BeamY { line, span, floor } => SpacePlace::BeamY {
                line: last - line,
                span,
                floor,
            },
        };
    }
    let pushes = PUSHES.map(|[x, y, t]| [-x, y, -t]);
    let after = statics(&single(mirrored).buildings[0], &pushes);
    for (a, b) in after.iter().zip(&before) {
        let scale = b[0].hypot(b[1]);
        close(a[0], -b[0], scale, 1e-11, "along x");
        close(a[1], b[1], scale, 1e-11, "across");
        close(a[2], -b[2], 0.1 * scale, 1e-11, "rotation");
    }
}

/// P-Delta takes (P/h) diag(1, 1, ρ²) at the centroid of what a storey carries, as in shear buildings in space.
#[test]
fn weight_softens_every_storey() {
    let tiers = without_symmetry(FULLY);
    let plain = single(tiers.clone());
    let mut building = building("A", tiers.clone(), FIVE_PERCENT);
    building.gravity.p_delta = true;
    let leaning = assembled(&model(vec![building], vec![]));
    let moved = [
        [0.01, -0.02, 1e-3],
        [0.03, 0.01, -2e-3],
        [0.05, -0.04, 3e-3],
    ];
    let force = |system: &System| {
        let building = &system.buildings[0];
        let n = moved.len();
        let mut displacement = vec![0.0; building.equations.len()];
        for (floor, moved) in moved.iter().enumerate() {
            for (direction, value) in moved.iter().enumerate() {
                displacement[building.tracks[direction * n + floor].dof] = *value;
            }
        }
        let mut force = vec![0.0; displacement.len()];
        building
            .equations
            .stiffness
            .multiply_add(&displacement, &mut force);
        building
            .equations
            .undamped
            .multiply_add(&displacement, &mut force);
        let energy: f64 = force.iter().zip(&displacement).map(|(f, u)| f * u).sum();
        energy
    };
    let mut expected = 0.0;
    for storey in 0..3 {
        let above = &tiers.floors[storey..];
        let mass: f64 = above.iter().map(|floor| floor.mass).sum();
        let centre =
            [0, 1].map(|axis| above.iter().map(|f| f.mass * f.centre[axis]).sum::<f64>() / mass);
        let at = |floor: usize| {
            let [x, y, turn] = moved[floor];
            let floor_centre = tiers.floors[floor].centre;
            let arm = [centre[0] - floor_centre[0], centre[1] - floor_centre[1]];
            [x - turn * arm[1], y + turn * arm[0], turn]
        };
        let upper = at(storey);
        let lower = storey.checked_sub(1).map_or([0.0; 3], at);
        let area = jostle::PlanArea::new(&tiers.floors[storey].plan);
        let push = mass * 9.80665 / tiers.storey_heights[storey];
        let weights = [push, push, push * area.gyration()];
        for ((a, b), weight) in upper.iter().zip(lower).zip(weights) {
            expected += weight * (a - b).powi(2);
        }
    }
    let (a, b) = (force(&plain), force(&leaning));
    close(a - b, expected, a, 1e-12, "P-Delta");
    assert!(expected > 1e-4 * a, "{expected:e} of {a:e}");
}

fn shaking() -> GroundMotion {
    let at = |i: u32| {
        let t = 0.02 * f64::from(i);
        6.0 * (11.0 * t).sin() * (-0.1 * t).exp() + 3.0 * (27.7 * t).cos() * (-0.3 * t).exp()
    };
    GroundMotion::sampled("along", 0.02, (0..=300).map(at).collect())
}

fn run(model: &Model, duration: f64) -> (System, Outcome) {
    let mut motion = shaking();
    motion.duration = duration;
    runs::run(model, &motion, Some(0.02))
}

fn pounding_pair(tolerance: f64) -> Model {
    let mut first = without_symmetry(FULLY);
    first.move_by([-11.0, 0.0]);
    let mut second = without_symmetry(FULLY);
    for member in &mut second.space_frame.as_mut().expect("a frame").members {
        for rigidity in &mut member.section.flexural_rigidity {
            *rigidity *= 1.7;
        }
    }
    second.move_by([0.01, 0.5]);
    let gap = Gap::between([Some(0), Some(1)], 0.01, CONCRETE);
    let buildings = vec![
        building("A", first, FIVE_PERCENT),
        building("B", second, FIVE_PERCENT),
    ];
    let mut model = model(buildings, vec![gap]);
    model.analysis.tolerance = tolerance;
    model.analysis.members.histories =
        vec!["A.column.1.1.1".to_owned(), "B.beam_y.2.1.1".to_owned()];
    model
}

/// While two frames pound, joints stay in equilibrium.
#[test]
fn joints_are_in_equilibrium_while_frames_pound() {
    let mut model = pounding_pair(1e-4);
    let assembled = assembled(&model);
    let space_members = assembled.buildings[0].members.members.iter();
    model.analysis.members.histories = space_members
        .map(|member| format!("A.{}", member.place))
        .collect();
    let (system, outcome) = run(&model, 3.0);
    assert!(outcome.face_impacts.len() > 2, "they pound");
    let building = &system.buildings[0];
    let history = outcome.member_history.as_ref().expect("asked for");
    let mut checked = 0;
    for (instant, row) in history.rows().enumerate().step_by(7) {
        let places = building
            .members
            .members
            .iter()
            .map(|member| match member.place {
                MemberPlace::InSpace(place) => place,
                _ => panic!("in space"),
            });
        let members: Vec<(SpacePlace, [[f64; 6]; 2])> = places
            .zip(row.chunks_exact(2))
            .map(|(place, ends)| (place, [ends[0], ends[1]]))
            .collect();
        if instant == 0 {
            continue;
        }
        check_joints(&members, &format!("instant {instant}"));
        checked += 1;
    }
    assert!(checked > 10, "{checked} instants");
}

/// Histories stay within the envelopes, reach them nearly, and balance at every instant.
#[test]
fn histories_hold_six_forces() {
    let (system, outcome) = run(&pounding_pair(1e-4), 4.0);
    let history = outcome.member_history.as_ref().expect("asked for");
    let [building, member] = history.members()[0];
    let column = &system.buildings[building].members.members[member];
    assert_eq!(column.place.to_string(), "column.1.1.1");
    let forms: Vec<usize> = {
        let section = &column.sections[0];
        section
            .forms
            .into_iter()
            .chain(section.across.expect("in space"))
            .collect()
    };
    let mut reached = [0.0_f64; 6];
    for row in history.rows() {
        let [foot, head] = [row[0], row[1]];
        // Shear is the slope of the moment, in both planes: h V = M_head − M_foot; moments stretch the side of the push.
        for plane in 0..2 {
            let [v, at_foot, at_head] = [
                foot[[1, 3][plane]],
                foot[[2, 4][plane]],
                head[[2, 4][plane]],
            ];
            close(4.0 * v, at_head - at_foot, 1e6, 1e-9, "shear and moments");
        }
        for (kind, (value, form)) in foot.iter().zip(&forms).enumerate() {
            let [most, least] = outcome.members[building][*form];
            let scale = most.max(-least);
            assert!(*value <= most + 1e-3 * scale && *value >= least - 1e-3 * scale);
            reached[kind] = reached[kind].max(value.abs() / scale);
        }
    }
    assert!(reached.iter().all(|share| *share > 0.9), "{reached:?}");
}
