//! Forces at the ends and struck points of columns and beams, against equilibrium and closed forms.

use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule, Side};
use jostle::linear::StepMatrix;
use jostle::stiffness::DirectStiffness;
use jostle::structure::{MemberPlace, SectionAt, SpringPlace, solve_once};
use jostle::{
    Analysis, Axial, Building, ContactLaw, Damping, FloorPairs, Frame, FrameHinges, Gap, Gravity,
    Hinges, LawKind, Level, Link, MemberRequest, Model, Outcome, Section, Shear, Solver, State,
    Structure, System,
};
use jostle_testkit::models::{self, CONCRETE_REALISED, bending};
use jostle_testkit::motions::two_waves;
use jostle_testkit::runs;

const GRAVITY: f64 = 9.806_65;

fn section(rigidity: f64) -> Section {
    Section {
        axial_rigidity: Some(4e9),
        line_mass: 600.0,
        ..bending(rigidity)
    }
}

fn frame(storeys: usize, spans: &[f64]) -> Frame {
    Frame {
        floor_mass: vec![9000.0; storeys],
        ..models::frame(storeys, spans, section(1.5e8), section(2.0e8))
    }
}

fn building(name: &str, frame: Frame) -> Building {
    models::building(name, Structure::Frame(frame))
}

/// Floors of the right building strike columns of the left one between its floors.
fn neighbours() -> Model {
    let mut right = frame(3, &[5.0, 4.0]);
    right.storey_heights[0] = 4.5;
    right.columns = vec![section(4e8); 3];
    Model {
        title: "Floors against columns".to_owned(),
        buildings: vec![building("A", frame(4, &[6.0, 5.0])), building("B", right)],
        gaps: vec![Gap {
            floors: FloorPairs::Listed(vec![
                [Level::Height(4.5), Level::Floor(1)],
                [Level::Height(7.7), Level::Floor(2)],
                [Level::Floor(3), Level::Height(9.6)],
                [Level::Height(10.9), Level::Floor(3)],
            ]),
            ..Gap::after(0, 0.005, CONCRETE_REALISED)
        }],
        analysis: Analysis {
            members: MemberRequest::all(),
            ..Analysis::default()
        },
        ..Model::default()
    }
}

fn run(model: &Model, solver: Solver, until: f64) -> (System, Outcome) {
    let mut motion = two_waves(300);
    motion.duration = until;
    let mut model = model.clone();
    model.analysis.solver = Some(solver);
    runs::run(&model, &motion, Some(0.0))
}

/// All forces of a building: member by member, section by section.
struct Forces(Vec<(MemberPlace, Vec<SectionForces>)>);

/// Where along the member, height above the base, and axial force, shear and moment.
type SectionForces = (SectionAt, f64, [f64; 3]);

impl Forces {
    fn new(system: &System, index: usize, state: &State, links: &[f64], ground: f64) -> Self {
        let building = &system.buildings[index];
        let mut values = vec![0.0; building.members.forms.len()];
        building.member_forces(state, links, ground, |form, value| values[form] = value);
        let members = building.members.members.iter().map(|member| {
            let sections = member.sections.iter();
            let forces = sections.map(|s| (s.at, s.height, s.forms.map(|form| values[form])));
            (member.place, forces.collect())
        });
        Self(members.collect())
    }

    fn at(&self, place: MemberPlace, at: SectionAt) -> [f64; 3] {
        let member = self.0.iter().find(|(known, _)| *known == place);
        let sections = member.map_or(&[][..], |(_, sections)| sections);
        let found = sections.iter().find(|(known, ..)| *known == at);
        found.map_or([0.0; 3], |(.., forces)| *forces)
    }
}

fn link_forces(system: &System, state: &State) -> Vec<f64> {
    let links = system.links.iter();
    links
        .map(|link| {
            let rate = link.ports.closing(&state.velocity);
            link.force(link.shortening(&state.displacement), rate)
        })
        .collect()
}

/// Horizontal force of contacts and links on a point of a building, positive to the right.
fn pushed(system: &System, state: &State, links: &[f64], index: usize, at: [f64; 2]) -> f64 {
    let contacts = system.contacts.iter().zip(&state.contacts);
    let contacts = contacts.map(|(contact, phase)| (contact.ports.clone(), phase.force()));
    let links = system
        .links
        .iter()
        .map(|link| link.ports.clone())
        .zip(links.iter().copied());
    let width = width(system, index);
    let mut sum = 0.0;
    for (ports, force) in contacts.chain(links) {
        for (port, sign) in ports.sides() {
            let x = if sign < 0.0 { width } else { 0.0 };
            if port.building == index && (port.height - at[1]).abs() < 2e-3 && x == at[0] {
                sum += sign * force;
            }
        }
    }
    sum
}

fn width(system: &System, index: usize) -> f64 {
    let nodes = &system.buildings[index].discretization.stick_model.nodes;
    nodes.iter().map(|node| node.x).fold(0.0, f64::max)
}

/// Greatest out-of-balance force of joints and struck points, relative to the greatest force of a member.
/// `elastic`: the same without weight.
fn out_of_balance(system: &System, elastic: &System, state: &State, ground: f64) -> f64 {
    let links = link_forces(system, state);
    let mut worst = 0.0_f64;
    for (index, building) in system.buildings.iter().enumerate() {
        let forces = Forces::new(system, index, state, &links, ground);
        // What stiffness-proportional damping adds: the forces of the velocities, P-Delta not included.
        let mut moving = State::at_rest(system, 0.0);
        moving.displacement.clone_from(&state.velocity);
        moving.acceleration.fill(0.0);
        let rates = Forces::new(elastic, index, &moving, &vec![0.0; links.len()], 0.0);
        let (alpha, beta) = (building.equations.alpha, building.equations.beta);
        let stick_model = &building.discretization.stick_model;
        let preload = !building.rest.displacement.is_empty();
        let mut lines: Vec<f64> = stick_model.nodes.iter().map(|node| node.x).collect();
        lines.retain(|x| {
            let mut columns = stick_model
                .members
                .iter()
                .map(|m| m.ends.map(|n| stick_model.nodes[n]));
            columns.any(|[a, b]| a.x == *x && b.x == *x)
        });
        lines.sort_by(f64::total_cmp);
        lines.dedup();
        let all = forces.0.iter().flat_map(|(_, sections)| sections);
        let scale = all.fold(1.0_f64, |most, (.., [n, v, _])| {
            most.max(n.abs()).max(v.abs())
        });
        for (floor, properties) in building.floors.iter().enumerate() {
            let dof = properties.dof;
            let total = state.acceleration[dof] + ground;
            for (line, x) in lines.iter().enumerate() {
                let here = |node: &&jostle::structure::Node| {
                    node.x == *x && (node.y - properties.height).abs() < 1e-9
                };
                let mass: f64 = stick_model
                    .nodes
                    .iter()
                    .filter(here)
                    .map(|n| n.mass())
                    .sum();
                let column = |storey| MemberPlace::Column {
                    line: line + 1,
                    storey,
                };
                let beam = |span| MemberPlace::Beam {
                    floor: floor + 1,
                    span,
                };
                let sum = |forces: &Forces| {
                    let below = forces.at(column(floor + 1), SectionAt::Last);
                    let above = forces.at(column(floor + 2), SectionAt::First);
                    let left = forces.at(beam(line), SectionAt::Last);
                    let right = forces.at(beam(line + 1), SectionAt::First);
                    [
                        above[1] - below[1] + right[0] - left[0],
                        above[0] - below[0] + left[1] - right[1],
                        above[2] - below[2] + right[2] - left[2],
                    ]
                };
                let (elastic, damped) = (sum(&forces), sum(&rates));
                // Axial forces of beams that keep their length hold all damping forces already.
                let shears = |forces: &Forces| {
                    forces.at(column(floor + 2), SectionAt::First)[1]
                        - forces.at(column(floor + 1), SectionAt::Last)[1]
                };
                let rigid = stick_model.members.iter().all(|member| {
                    let [a, b] = member.ends.map(|node| stick_model.nodes[node].x);
                    a == b || member.axial_rigidity.is_none()
                });
                let damped_x = if rigid { shears(&rates) } else { damped[0] };
                let push = pushed(system, state, &links, index, [*x, properties.height]);
                let horizontal = elastic[0] + beta * damped_x
                    - mass * total
                    - alpha * mass * state.velocity[dof]
                    + push;
                let weight = if preload { mass * GRAVITY } else { 0.0 };
                let vertical = elastic[1] - weight;
                let turning = elastic[2] + beta * damped[2];
                for value in [horizontal, vertical, turning] {
                    worst = worst.max(value.abs() / scale);
                }
            }
        }
        // Struck points of columns.
        for (place, sections) in &forces.0 {
            let MemberPlace::Column { line, .. } = place else {
                continue;
            };
            for (k, pair) in sections[2..].chunks(2).enumerate() {
                let [
                    (SectionAt::Below, height, below),
                    (SectionAt::Above, _, above),
                ] = pair
                else {
                    panic!("below, then above: {pair:?}");
                };
                let (_, rates) = rates.0.iter().find(|(p, _)| p == place).expect("the same");
                let rate = rates[2 + 2 * k + 1].2[1] - rates[2 + 2 * k].2[1];
                let x = lines[line - 1];
                let node = stick_model.nodes.iter();
                let mut node = node.enumerate().filter(|(_, n)| n.x == x && n.y == *height);
                let (node, properties) = node.next().expect("a node");
                let dof = building.offset + building.equations.horizontal(node).expect("it moves");
                let inertia = properties.mass()
                    * (state.acceleration[dof] + ground + alpha * state.velocity[dof]);
                let push = pushed(system, state, &links, index, [x, *height]);
                let sum = above[1] - below[1] + beta * rate - inertia + push;
                worst = worst
                    .max(sum.abs() / scale)
                    .max((above[2] - below[2]).abs() / scale);
            }
        }
    }
    worst
}

#[test]
fn every_joint_and_struck_point_is_in_equilibrium() {
    let under_weight = |p_delta: bool| {
        let mut model = neighbours();
        for building in &mut model.buildings {
            building.gravity = Gravity {
                preload: true,
                p_delta,
            };
        }
        model
    };
    let mut linked = neighbours();
    linked.links.push(Link {
        between: [Some(0), Some(1)],
        stiffness: 3e6,
        damping: 2e5,
        floors: FloorPairs::Listed(vec![[Level::Height(7.7), Level::Floor(2)]]),
        level_tolerance: 1e-3,
        law: jostle::LinkLaw::Linear,
        ..Link::default()
    });
    let models = [
        ("plain", neighbours()),
        ("weight", under_weight(false)),
        ("P-Delta", under_weight(true)),
        ("links", linked),
    ];
    for (name, mut model) in models {
        // Rounding of accelerations grows as steps shrink, and automatic steps would be refined.
        model.analysis.step = Some(2e-3);
        let mut light = model.clone();
        for building in &mut light.buildings {
            building.gravity = Gravity::default();
        }
        let elastic = System::assemble(&light).expect("sound");
        let (mut worst, mut in_contact) = (0.0_f64, 0);
        for step in 1..=12 {
            let until = 0.247 * f64::from(step);
            let (system, outcome) = run(&model, Solver::Riccati, until);
            let state = &outcome.state;
            in_contact += state.contacts.iter().filter(|c| c.force() > 0.0).count();
            worst = worst.max(out_of_balance(
                &system,
                &elastic,
                state,
                two_waves(300).acceleration(until),
            ));
        }
        assert!(worst < 1e-9, "{name}: {worst:e}");
        assert!(in_contact > 0, "{name}: some instants lie in impacts");
    }
}

/// A frame of one storey and one span, its columns struck at mid-height by walls.
fn portal(columns: f64, beam: f64, height: f64, span: f64) -> System {
    let mut frame = frame(1, &[span]);
    frame.storey_heights = vec![height];
    frame.columns = vec![section(columns)];
    frame.beams = vec![section(beam)];
    frame.beam_segments = vec![2];
    let wall = |between: [Option<usize>; 2]| {
        let middle = Level::Height(0.5 * height);
        let pair = between.map(|side| if side.is_some() { middle } else { Level::Wall });
        Gap {
            floors: FloorPairs::Listed(vec![pair]),
            ..Gap::between(between, 0.02, CONCRETE_REALISED)
        }
    };
    let model = Model {
        title: "Portal".to_owned(),
        buildings: vec![building("P", frame)],
        gaps: vec![wall([None, Some(0)]), wall([Some(0), None])],
        analysis: Analysis {
            members: MemberRequest::all(),
            ..Analysis::default()
        },
        ..Model::default()
    };
    System::assemble(&model).expect("sound")
}

/// Forces under static loads on (x, y, horizontal force, vertical force).
fn under(system: &System, loads: &[[f64; 4]]) -> Forces {
    let building = &system.buildings[0];
    let mut load = vec![0.0; building.equations.len()];
    let nodes = &building.discretization.stick_model.nodes;
    for [x, y, horizontal, vertical] in loads {
        let found = nodes.iter().position(|node| node.x == *x && node.y == *y);
        let node = found.expect("a node there");
        if *horizontal != 0.0 {
            load[building.equations.horizontal(node).expect("free")] += horizontal;
        }
        if *vertical != 0.0 {
            load[building.equations.vertical(node).expect("free")] += vertical;
        }
    }
    let answer = solve_once::<DirectStiffness>(building, &StepMatrix::STATIC, &load);
    let mut state = State::at_rest(system, 0.0);
    state.displacement = answer.expect("it stands");
    state.acceleration.fill(0.0);
    Forces::new(system, 0, &state, &[], 0.0)
}

fn assert_near(found: f64, expected: f64, scale: f64) {
    assert!(
        (found - expected).abs() <= 2e-6 * scale,
        "{found} instead of {expected}"
    );
}

const LEFT: MemberPlace = MemberPlace::Column { line: 1, storey: 1 };
const RIGHT: MemberPlace = MemberPlace::Column { line: 2, storey: 1 };
const BEAM: MemberPlace = MemberPlace::Beam { floor: 1, span: 1 };

#[test]
fn a_struck_column_between_rigid_ends_bears_what_handbooks_say() {
    // Two opposite pushes leave the floor where it is; a rigid beam keeps the joints from turning.
    let (p, l) = (800e3, 3.2);
    let system = portal(1.5e8, 1e16, l, 6.0);
    let forces = under(&system, &[[0.0, 0.5 * l, p, 0.0], [6.0, 0.5 * l, -p, 0.0]]);
    for (column, sign) in [(LEFT, 1.0), (RIGHT, -1.0)] {
        let at = |at| forces.at(column, at);
        // P/2 on either side, PL/8 at the ends and at the point; a push to the right stretches the right face there.
        assert_near(at(SectionAt::First)[1], sign * p / 2.0, p);
        assert_near(at(SectionAt::Below)[1], sign * p / 2.0, p);
        assert_near(at(SectionAt::Above)[1], -sign * p / 2.0, p);
        assert_near(at(SectionAt::Last)[1], -sign * p / 2.0, p);
        for (place, side) in [
            (SectionAt::First, -1.0),
            (SectionAt::Below, 1.0),
            (SectionAt::Above, 1.0),
            (SectionAt::Last, -1.0),
        ] {
            assert_near(at(place)[2], sign * side * p * l / 8.0, p * l);
        }
        assert_near(at(SectionAt::First)[0], 0.0, p);
    }
    // What the push leaves at the floor goes through the beam.
    assert_near(forces.at(BEAM, SectionAt::First)[0], -p / 2.0, p);
}

#[test]
fn a_struck_column_bears_no_more_than_its_plastic_limit() {
    // A heavy neighbour pushes slowly, half way up, on a column whose floor other columns hold: a beam with fixed ends and a load P in
    // its middle fails by hinges at both ends and under the load, at P = 8 M/l.
    let (l, strength) = (3.2, 150e3);
    let hinge = |times: f64| {
        let corners = Corners {
            cracking: 0.8 * times * strength,
            yielding: times * strength,
            post_cracking: 0.5,
            post_yield: 1e-5,
        };
        let backbone = Backbone::from_forces(times * 1e9, corners, corners).expect("sound");
        Hysteresis::new(HysteresisRule::PeakOriented, backbone).expect("sound")
    };
    let light = Section {
        line_mass: 2.0,
        ..section(6e7)
    };
    let frame = Frame {
        floor_mass: vec![2000.0],
        storey_heights: vec![l],
        columns: vec![light],
        own_columns: [[0, 1], [0, 2]]
            .map(|place| (place, Some(section(5e10))))
            .into(),
        beams: vec![section(1e13)],
        ..models::frame(1, &[6.0, 6.0], light, section(1e13))
    };
    let struck = Building {
        // Dashpots beside hinges would bear moments of their own.
        damping: Damping::Rayleigh {
            alpha: 2.0,
            beta: 0.0,
        },
        hinges: Some(Hinges::Frame(FrameHinges {
            columns: vec![vec![hinge(1.0), hinge(1e3), hinge(1e3)]],
            ..FrameHinges::default()
        })),
        ..building("F", frame)
    };
    let heavy = models::equal_storeys(1, [4e5, 1e6]);
    let pusher = Shear {
        storey_heights: vec![0.5 * l],
        ..heavy
    };
    let model = Model {
        title: "Plastic limit".to_owned(),
        buildings: vec![models::building("H", Structure::Shear(pusher)), struck],
        gaps: vec![Gap {
            floors: FloorPairs::Listed(vec![[Level::Floor(1), Level::Height(0.5 * l)]]),
            ..Gap::after(
                0,
                0.02,
                ContactLaw {
                    kind: LawKind::Linear,
                    stiffness: 5e6,
                    ..CONCRETE_REALISED
                },
            )
        }],
        ..Model::default()
    };
    let (system, outcome, summary) = runs::run_and_summary(&model, &two_waves(300));
    let peak = summary.gaps[0].contacts[0].peak_force_n;
    let limit = 8.0 * strength / l;
    assert!(
        (peak / limit - 1.0).abs() < 0.02,
        "{peak} instead of {limit}"
    );
    let places = &system.buildings[1].discretization.spring_places;
    let point = SpringPlace::Struck {
        frame: None,
        member: LEFT,
        axis: None,
        point: 1,
    };
    let at = places
        .iter()
        .position(|place| *place == point)
        .expect("a hinge");
    assert_eq!(
        places.len(),
        7,
        "foot and head of three columns, and the struck point"
    );
    let turned =
        outcome.state.springs[system.buildings[1].spring_offset + at].greatest(Side::Positive);
    assert!(turned > 0.005, "it yields where it is struck: {turned}");
}

#[test]
fn a_soft_beam_leaves_cantilevers() {
    let (p, l) = (100e3, 4.0);
    let system = portal(1.5e8, 1.0, l, 6.0);
    let forces = under(&system, &[[0.0, l, p, 0.0]]);
    for column in [LEFT, RIGHT] {
        let [axial, shear, moment] = forces.at(column, SectionAt::First);
        assert_near(axial, 0.0, p);
        assert_near(shear, p / 2.0, p);
        // Pushed to the right, the left face is stretched.
        assert_near(moment, -p / 2.0 * l, p * l);
        assert_near(forces.at(column, SectionAt::Last)[2], 0.0, p * l);
    }
}

#[test]
fn a_portal_frame_follows_its_closed_forms() {
    // A. Kleinlogel, Rahmenformeln: fixed feet, k = (I_beam/I_column)(h/l).
    let (h, l, i_column, i_beam) = (4.0, 6.0, 1.5e8, 2.4e8);
    let system = portal(i_column, i_beam, h, l);
    let k = i_beam / i_column * h / l;
    // Push P at the left joint: moments ∓Ph/2 (3k + 1)/(6k + 1) at the feet, ±Ph/2 3k/(6k + 1) at the joints.
    let p = 100e3;
    let forces = under(&system, &[[0.0, h, p, 0.0]]);
    let foot = p * h / 2.0 * (3.0 * k + 1.0) / (6.0 * k + 1.0);
    let head = p * h / 2.0 * 3.0 * k / (6.0 * k + 1.0);
    for column in [LEFT, RIGHT] {
        assert_near(forces.at(column, SectionAt::First)[2], -foot, p * h);
        assert_near(forces.at(column, SectionAt::Last)[2], head, p * h);
        assert_near(forces.at(column, SectionAt::First)[1], p / 2.0, p);
    }
    assert_near(forces.at(BEAM, SectionAt::First)[2], head, p * h);
    assert_near(forces.at(BEAM, SectionAt::Last)[2], -head, p * h);
    // The couple 2 M/l is carried by tension on the left and compression on the right.
    assert_near(forces.at(LEFT, SectionAt::First)[0], 2.0 * head / l, p);
    assert_near(forces.at(RIGHT, SectionAt::First)[0], -2.0 * head / l, p);
    // Weight P in the middle of the beam: Pl/8/(k + 2) at the feet, twice that at the joints. The floor does not sway.
    let forces = under(&system, &[[l / 2.0, h, 0.0, -p]]);
    let foot = p * l / 8.0 / (k + 2.0);
    for (column, sign) in [(LEFT, 1.0), (RIGHT, -1.0)] {
        assert_near(forces.at(column, SectionAt::First)[0], -p / 2.0, p);
        assert_near(forces.at(column, SectionAt::First)[2], sign * foot, p * l);
        assert_near(
            forces.at(column, SectionAt::Last)[2],
            -sign * 2.0 * foot,
            p * l,
        );
        assert_near(
            forces.at(column, SectionAt::Last)[1],
            -sign * 3.0 * foot / h,
            p,
        );
    }
    assert_near(forces.at(BEAM, SectionAt::First)[1], p / 2.0, p);
    assert_near(forces.at(BEAM, SectionAt::Last)[1], -p / 2.0, p);
    assert_near(forces.at(BEAM, SectionAt::First)[2], -2.0 * foot, p * l);
    // The thrust of the feet closes the frame.
    assert_near(forces.at(BEAM, SectionAt::First)[0], -3.0 * foot / h, p);
}

/// Greatest difference of the forces of two runs, relative to the greatest of their kind in the building.
fn difference(system: &System, [a, b]: [&Outcome; 2], kinds: &[usize]) -> f64 {
    let mut worst = 0.0_f64;
    for (index, building) in system.buildings.iter().enumerate() {
        for &kind in kinds {
            let members = building.members.members.iter();
            let forms = members.flat_map(|m| m.sections.iter().map(|s| s.forms[kind]));
            let (mut scale, mut change) = (0.0_f64, 0.0_f64);
            for form in forms {
                let [a, b] = [a, b].map(|run| run.members[index][form]);
                for side in 0..2 {
                    scale = scale.max(a[side].abs()).max(b[side].abs());
                    change = change.max((a[side] - b[side]).abs());
                }
            }
            worst = worst.max(change / scale);
        }
    }
    worst
}

#[test]
fn riccati_and_modal_stepping_agree_within_the_tolerance() {
    let mut flexible = neighbours();
    for building in &mut flexible.buildings {
        if let Structure::Frame(frame) = &mut building.structure {
            frame.axial = Axial {
                columns_flexible: true,
                beams_flexible: true,
            };
        }
    }
    for (name, mut model) in [("rigid", neighbours()), ("flexible", flexible)] {
        model.analysis.tolerance = 1e-3;
        let (system, modal) = run(&model, Solver::Modal, 3.0);
        let promised = modal.accuracy.expect("estimated");
        assert!(promised.residual <= 1e-3, "{name}: {promised:?}");
        assert!(!modal.impacts.is_empty());
        model.analysis.tolerance = 1e-4;
        let (_, riccati) = run(&model, Solver::Riccati, 3.0);
        for kind in 0..3 {
            let apart = difference(&system, [&modal, &riccati], &[kind]);
            println!("{name} {kind}: {apart:e}");
            assert!(apart < 1e-3, "{name}: force {kind} differs by {apart:e}");
        }
    }
}

#[test]
fn shears_of_columns_make_up_the_shear_of_their_storey() {
    let mut model = neighbours();
    model.analysis.members =
        MemberRequest::with_histories(&["A.column.1.2", "A.column.2.2", "A.column.3.2"]);
    for (solver, tolerance) in [(Solver::Riccati, 1e-9), (Solver::Modal, 1e-3)] {
        let (system, outcome) = run(&model, solver, 3.0);
        let history = outcome.member_history.as_ref().expect("asked for");
        assert_eq!(history.members().len(), 3);
        let sections: Vec<usize> = history
            .members()
            .iter()
            .map(|[building, member]| {
                system.buildings[*building].members.members[*member]
                    .sections
                    .len()
            })
            .collect();
        let sums = history.rows().map(|row| {
            let (mut sum, mut at) = (0.0, 0);
            for count in &sections {
                sum += row[at][1];
                at += count;
            }
            sum
        });
        let peak = sums.fold(0.0_f64, |most, sum: f64| most.max(sum.abs()));
        let known = outcome.peaks.floor(0, 2).storey_shear();
        assert!(
            (peak / known - 1.0).abs() < tolerance,
            "{solver:?}: {peak} against {known}"
        );
        assert_eq!(
            history.rows().count(),
            outcome.history.expect("recorded").len()
        );
    }
}

#[test]
fn columns_carry_the_overturning_moment() {
    // Statics of the whole frame, axially rigid members: about the foot of the first line, the moments at the feet and the
    // couple of the axial forces balance the loads, and axial forces above any storey add up to the weight on it.
    let spans = [6.0, 5.0];
    let model = Model {
        title: "Overturning".to_owned(),
        buildings: vec![building("A", frame(4, &spans))],
        analysis: Analysis {
            members: MemberRequest::all(),
            ..Analysis::default()
        },
        ..Model::default()
    };
    let system = System::assemble(&model).expect("sound");
    let push = [30e3, 50e3, 20e3, 80e3];
    let mut loads: Vec<[f64; 4]> = Vec::new();
    let mut overturning = 0.0;
    for (floor, force) in push.into_iter().enumerate() {
        let height = 3.2 * (floor + 1) as f64;
        let heights = system.buildings[0].floors.iter().map(|floor| floor.height);
        let height = heights.min_by(|a, b| (a - height).abs().total_cmp(&(b - height).abs()));
        loads.push([0.0, height.expect("a floor"), force, 0.0]);
        overturning += force * height.expect("a floor");
    }
    let forces = under(&system, &loads);
    for storey in 1..=4 {
        let lines = [1, 2, 3].map(|line| MemberPlace::Column { line, storey });
        let foot = |place| forces.at(place, SectionAt::First);
        let sum: f64 = lines.map(|place| foot(place)[0]).iter().sum();
        assert_near(sum, 0.0, overturning);
        let x = [0.0, spans[0], spans[0] + spans[1]];
        let base = 3.2 * (storey - 1) as f64;
        let above: f64 = loads
            .iter()
            .map(|[_, y, force, _]| force * (y - base).max(0.0))
            .sum();
        // Tension on the left pulls down there; a negative moment at a foot bends to the right.
        let couple: f64 = lines
            .iter()
            .zip(x)
            .map(|(place, x)| -foot(*place)[0] * x)
            .sum();
        let moments: f64 = lines.map(|place| -foot(place)[2]).iter().sum();
        assert_near(couple + moments, above, overturning);
        assert!(couple > 0.3 * above, "most is carried by axial forces");
    }
}
