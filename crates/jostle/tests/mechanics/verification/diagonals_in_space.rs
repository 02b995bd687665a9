//! Braces, struts and rigid ends of space frames: closed forms, plane frames as their limit, exchanged axes, equilibrium.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

use jostle::hysteresis::{Backbone, BucklingBrace, Corners, Hysteresis, HysteresisRule};
use jostle::linear::StepMatrix;
use jostle::structure::{MemberPlace, solve_once};
use jostle::{
    Analysis, Axial, Base, Bearing, Building, Damping, Diagonal, DiagonalKind, DiagonalPlace,
    Frame, FrameHinges, Gravity, GridLine, GroundMotion, MemberRequest, Model, Outcome,
    PanelAcross, PlanAxis, PlanFrame, PlanPoint, Reach, RiccatiSweep, Rise, Section, Solver,
    SpaceFrame, SpaceMember, SpacePlace, SpaceSection, Structure, StrutLine, Summary, System, Tier,
    TierStorey, Tiers,
};
use jostle_testkit::compare::close;
use jostle_testkit::motions::fading;
use jostle_testkit::runs::{self, assembled};

const E: f64 = 30e9;

const STIFFNESS: f64 = 4e7;

/// What diagonals do beyond their elastic force.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Law {
    Elastic,
    Yielding,
    Buckling,
    Struts,
}

impl Law {
    fn hysteresis(self) -> Option<Hysteresis> {
        match self {
            Self::Elastic => None,
            Self::Yielding => {
                let corners = Corners::bilinear(60e3, 0.03);
                let backbone = Backbone::from_forces(STIFFNESS, corners, corners).expect("sound");
                Hysteresis::new(HysteresisRule::Bilinear, backbone).ok()
            }
            Self::Buckling => Hysteresis::buckling(BucklingBrace {
                stiffness: STIFFNESS,
                yield_force: 120e3,
                post_yield: 0.02,
                buckling_force: 60e3,
                later: 0.65,
                slenderness: 1.2,
                shortening: 2e-3,
            })
            .ok(),
            Self::Struts => Hysteresis::without_tension(STIFFNESS).ok(),
        }
    }

    fn diagonal(self, line: Option<GridLine>, storey: usize, bay: usize, rise: Rise) -> Diagonal {
        let kind = match self {
            Self::Struts => DiagonalKind::Infill,
            _ => DiagonalKind::Brace,
        };
        let place = DiagonalPlace {
            kind,
            line,
            storey,
            bay,
            rise,
            reach: Reach::BAY,
            strut: StrutLine::Central,
        };
        Diagonal {
            place,
            stiffness: STIFFNESS,
            hysteresis: self.hysteresis(),
            offsets: [0.0; 2],
            across: None,
            damage: None,
        }
    }
}

fn on(along: PlanAxis, number: usize) -> Option<GridLine> {
    Some(GridLine { along, number })
}

/// All members of a regular grid.
fn grid(lines_x: &[f64], lines_y: &[f64], storeys: usize, axial: bool) -> SpaceFrame {
    let mut members = Vec::new();
    let column = SpaceSection {
        axial_rigidity: axial.then_some(E * 0.2),
        ..SpaceSection::rectangle([0.5, 0.4], E, 0.2, true).expect("a section")
    };
    let [along, across] = [[0.3, 0.6], [0.25, 0.5]]
        .map(|size| SpaceSection::beam(size, E, 0.2, true).expect("a section"));
    for storey in 0..storeys {
        for y in 0..lines_y.len() {
            for x in 0..lines_x.len() {
                let line = [x, y];
                let (floor, span) = (storey, x);
                let place = SpacePlace::Column { line, storey };
                members.push(SpaceMember::elastic(place, column));
                if x + 1 < lines_x.len() {
                    let place = SpacePlace::BeamX {
                        span,
                        line: y,
                        floor,
                    };
                    members.push(SpaceMember::elastic(place, along));
                }
                if y + 1 < lines_y.len() {
                    let place = SpacePlace::BeamY {
                        line: x,
                        span: y,
                        floor,
                    };
                    members.push(SpaceMember::elastic(place, across));
                }
            }
        }
    }
    SpaceFrame {
        lines_x: lines_x.to_vec(),
        lines_y: lines_y.to_vec(),
        members,
        ..SpaceFrame::default()
    }
}

/// One building, whose members are followed, at a tolerance of 1e-6 or with steps of 2 ms.
pub(super) fn model(tiers: Tiers, solver: Solver) -> Model {
    Model {
        title: "diagonals".to_owned(),
        buildings: vec![Building {
            name: "A".to_owned(),
            structure: Structure::Tiers(tiers),
            damping: Damping::Rayleigh {
                alpha: 0.4,
                beta: 0.0,
            },
            ..Building::default()
        }],
        analysis: Analysis {
            solver: Some(solver),
            step: (solver != Solver::Modal).then_some(2e-3),
            tolerance: 1e-6,
            members: MemberRequest::all(),
            ..Analysis::default()
        },
        ..Model::default()
    }
}

/// Displacements u_x, u_y, θ of the only floor of a building under a force on it.
fn pushed(system: &System, push: [f64; 3]) -> [f64; 3] {
    let building = &system.buildings[0];
    let mut load = vec![0.0; building.equations.len()];
    for (direction, force) in push.into_iter().enumerate() {
        load[building.tracks[direction].dof] = force;
    }
    let answer =
        solve_once::<RiccatiSweep>(building, &StepMatrix::STATIC, &load).expect("it stands");
    [0, 1, 2].map(|direction| answer[building.tracks[direction].dof])
}

fn single_storey(frame: SpaceFrame, height: f64) -> Tiers {
    let [a, b] = [&frame.lines_x, &frame.lines_y].map(|lines| lines[lines.len() - 1]);
    let plan = vec![[0.0, 0.0], [a, 0.0], [a, b], [0.0, b]];
    Tiers {
        floors: vec![Tier::uniform(60e3, plan).expect("an area")],
        storey_heights: vec![height],
        space_frame: Some(frame),
        ..Tiers::default()
    }
}

/// Four columns that keep their length, without beams, and a brace in every face: every one adds k cos²α along its line, and k cos²α r² to
/// the torsion, r being the distance of its line from the centre.
#[test]
fn braces_add_k_cos_squared_and_its_torsion() {
    let (h, size): (f64, [f64; 2]) = (3.6, [6.0, 5.0]);
    for self_weight in [false, true] {
        let mut frame = grid(&[0.0, size[0]], &[0.0, size[1]], 1, self_weight);
        let is_column = |member: &SpaceMember| matches!(member.place, SpacePlace::Column { .. });
        frame.members.retain(is_column);
        // Under its weight joints have displacements of their own: they hardly move.
        for member in &mut frame.members {
            member.section.axial_rigidity = self_weight.then_some(1e16);
        }
        let section = frame.members[0].section;
        for (number, rise) in [1, 2].into_iter().zip(Rise::BOTH) {
            for along in PlanAxis::BOTH {
                let diagonal = Law::Elastic.diagonal(on(along, number), 1, 1, rise);
                frame.diagonals.push(diagonal);
            }
        }
        let mut model = model(single_storey(frame, h), Solver::Riccati);
        model.buildings[0].gravity = Gravity {
            preload: self_weight,
            ..Gravity::default()
        };
        let system = assembled(&model);
        let of_column = [0, 1].map(|plane| {
            let bent = h.powi(3) / (3.0 * section.flexural_rigidity[plane]);
            let sheared = section
                .shear_rigidity
                .map_or(0.0, |shear_rigidity| h / shear_rigidity[plane]);
            1.0 / (bent + sheared)
        });
        let brace = size.map(|bay| STIFFNESS * bay * bay / (bay * bay + h * h));
        let [kx, ky] = [0, 1].map(|axis| 4.0 * of_column[axis] + 2.0 * brace[axis]);
        let torsion = 4.0 * section.torsional_rigidity / h
            + kx * (0.5 * size[1]).powi(2)
            + ky * (0.5 * size[0]).powi(2);
        for (direction, stiffness) in [kx, ky, torsion].into_iter().enumerate() {
            let mut push = [0.0; 3];
            push[direction] = stiffness;
            let moved = pushed(&system, push);
            for (other, value) in moved.into_iter().enumerate() {
                let wanted = if other == direction { 1.0 } else { 0.0 };
                let within = if self_weight { 1e-7 } else { 1e-11 };
                close(value, wanted, 1.0, within, "k cos²α");
            }
        }
    }
}

/// Columns that hardly bend make a truss: a push P on each of two faces gives its brace P/cos α, the column on which it rests P tan α, and
/// the floor P (l³/(EA b²) + h tan²α/EA), l being the length of the brace, whose EA/l is its stiffness.
#[test]
fn slender_columns_and_braces_are_a_truss() {
    let (h, bay, push) = (3.6_f64, 6.0_f64, 1e5);
    let mut frame = grid(&[0.0, bay], &[0.0, 5.0], 1, true);
    frame
        .members
        .retain(|member| !matches!(member.place, SpacePlace::BeamX { .. }));
    let mut rigidity = 0.0;
    for member in &mut frame.members {
        member.section.flexural_rigidity = member
            .section
            .flexural_rigidity
            .map(|flexural_rigidity| 1e-9 * flexural_rigidity);
        member.section.torsional_rigidity *= 1e-9;
        member.section.shear_rigidity = None;
        if matches!(member.place, SpacePlace::Column { .. }) {
            rigidity = member.section.axial_rigidity.expect("it shortens");
        }
    }
    for number in [1, 2] {
        let line = on(PlanAxis::X, number);
        let diagonal = Law::Elastic.diagonal(line, 1, 1, Rise::Right);
        frame.diagonals.push(diagonal);
    }
    let system = assembled(&model(single_storey(frame, h), Solver::Riccati));
    let building = &system.buildings[0];
    let moved = pushed(&system, [2.0 * push, 0.0, 0.0]);
    let length = bay.hypot(h);
    let expected =
        push * (length / bay).powi(2) / STIFFNESS + push * (h / bay).powi(2) * h / rigidity;
    close(moved[0], expected, expected, 1e-8, "sway");
    let mut state = jostle::State::at_rest(&system, 0.0);
    for (direction, value) in moved.into_iter().enumerate() {
        state.displacement[building.tracks[direction].dof] = value;
    }
    let mut forces = vec![0.0; building.members.forms.len()];
    building.member_forces(&state, &[], 0.0, |form, value| forces[form] = value);
    for brace in &building.members.diagonals {
        let due = push * length / bay;
        close(forces[brace.form], due, push, 1e-8, "brace");
    }
    for member in &building.members.members {
        let MemberPlace::InSpace(SpacePlace::Column { line, .. }) = member.place else {
            continue;
        };
        // The upper end of the braces pulls the column there down.
        let due = if line[0] == 1 { -push * h / bay } else { 0.0 };
        close(
            forces[member.sections[0].forms[0]],
            due,
            push,
            1e-8,
            "column",
        );
    }
}

const HEIGHTS: [f64; 3] = [4.0, 3.2, 3.2];

/// Diagonals of one line along x: in the first bay of all storeys, and both ways in the second bay of the upper ones.
fn line_of(law: Law, line: Option<GridLine>) -> Vec<Diagonal> {
    let mut found = Vec::new();
    for storey in 1..=HEIGHTS.len() {
        match law {
            Law::Struts => found.extend(Rise::BOTH.map(|rise| law.diagonal(line, storey, 1, rise))),
            _ => found.push(law.diagonal(line, storey, 1, Rise::BOTH[storey % 2])),
        }
        if storey > 1 {
            found.extend(Rise::BOTH.map(|rise| law.diagonal(line, storey, 2, rise)));
        }
    }
    found
}

/// Rigid zones of beams along x, across, and of columns, the same at every joint \[m\].
const ZONE: [f64; 3] = [0.25, 0.2, 0.3];

/// Two equal faces along x, three storeys and two bays, and the plane frames that they are.
fn faces(law: Law, axial: bool, rigid: bool) -> [Tiers; 2] {
    let lines = [0.0, 6.0, 11.0];
    let mut space = grid(&lines, &[0.0, 5.0], HEIGHTS.len(), axial);
    for number in [1, 2] {
        space
            .diagonals
            .extend(line_of(law, on(PlanAxis::X, number)));
    }
    let mut zones = BTreeMap::new();
    if rigid {
        for floor in 0..HEIGHTS.len() {
            for line in 0..lines.len() {
                zones.insert([floor, line], [ZONE[0], ZONE[2]]);
                for y in [0, 1] {
                    space.rigid_zones.insert([floor, line, y], ZONE);
                }
            }
        }
    }
    let of = |place: SpacePlace| {
        let mut members = space.members.iter();
        let member = members
            .find(|member| member.place == place)
            .expect("a member");
        Section {
            flexural_rigidity: member.section.flexural_rigidity[0],
            axial_rigidity: member.section.axial_rigidity.or(Some(1e9)),
            shear_rigidity: member.section.shear_rigidity.map(|both| both[0]),
            line_mass: 0.0,
        }
    };
    let column = of(SpacePlace::Column {
        line: [0, 0],
        storey: 0,
    });
    let beam = of(SpacePlace::BeamX {
        span: 0,
        line: 0,
        floor: 0,
    });
    let storeys = HEIGHTS.len();
    let plane = Frame {
        storey_heights: HEIGHTS.to_vec(),
        spans: vec![6.0, 5.0],
        columns: vec![column; storeys],
        beams: vec![beam; storeys],
        beam_mass: vec![0.0; storeys],
        floor_mass: vec![0.0; storeys],
        column_segments: 1,
        beam_segments: vec![1; 2],
        axial: Axial {
            columns_flexible: axial,
            beams_flexible: false,
        },
        diagonals: line_of(law, None),
        rigid_zones: zones,
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
    let plan = vec![[0.0, 0.0], [11.0, 0.0], [11.0, 5.0], [0.0, 5.0]];
    let tier = Tier::uniform(90e3, plan).expect("an area");
    let across = TierStorey {
        stiffness: [0.0, 80e6, 5e9],
        centre: [5.5, 2.5],
    };
    let frames = vec![standing("1", 0.0), standing("2", 5.0)];
    let held = |space_frame: Option<SpaceFrame>, frames: Vec<PlanFrame>, storeys| Tiers {
        floors: vec![tier.clone(); HEIGHTS.len()],
        storeys,
        storey_heights: HEIGHTS.to_vec(),
        frames,
        space_frame,
        ..Tiers::default()
    };
    [
        held(Some(space), Vec::new(), Vec::new()),
        held(None, frames, vec![across; storeys]),
    ]
}

fn along() -> GroundMotion {
    fading("along", 9.0, [2.0, 3.0], 150)
}

/// Greatest displacements of the floors along x, across, and in rotation.
fn sways(outcome: &Outcome) -> Vec<[f64; 3]> {
    let peaks = outcome.peaks.floors(0);
    let of = |peaks: &jostle::history::PeaksOf<'_>| peaks.displacement().size();
    peaks
        .iter()
        .map(|peak| [of(peak), of(&peak.across()), of(&peak.turning())])
        .collect()
}

/// One bay deep and shaken along x, a frame is two plane ones: floors, diagonals and members have the same peaks, whatever diagonals do.
#[test]
fn a_pair_of_faces_is_its_plane_limit() {
    for (law, axial, rigid, solver) in [
        (Law::Elastic, true, false, Solver::Modal),
        (Law::Elastic, false, true, Solver::Modal),
        (Law::Elastic, true, true, Solver::Riccati),
        (Law::Yielding, true, false, Solver::Riccati),
        (Law::Yielding, false, true, Solver::Riccati),
        (Law::Buckling, true, true, Solver::Riccati),
        (Law::Struts, true, false, Solver::Riccati),
        (Law::Struts, false, false, Solver::Riccati),
    ] {
        let what = format!("{law:?}, axial {axial}, rigid {rigid}");
        let [a, b] = faces(law, axial, rigid).map(|tiers| {
            let model = model(tiers, solver);
            let (system, outcome) = runs::run(&model, &along(), Some(0.02));
            assert!(outcome.energy.worst_imbalance < 1e-6, "{what}");
            (system, outcome)
        });
        let within = if solver == Solver::Modal { 1e-7 } else { 1e-9 };
        for (sway, other) in sways(&a.1).iter().zip(sways(&b.1)) {
            close(sway[0], other[0], other[0], within, &what);
            assert!(sway[1].max(sway[2]) < 1e-9 * sway[0], "{what}: {sway:?}");
        }
        // The base carries what the lowest storey does, struts and braces that yield included.
        let [base, other] = [&a.1, &b.1].map(|outcome| outcome.peaks.base_shear(0));
        close(base, other, other, within, &what);
        let lowest = a.1.peaks.floors(0)[0].storey_shear();
        close(base, lowest, lowest, 1e-6, &what);
        let (ea, eb) = (a.1.energy.hysteretic, b.1.energy.hysteretic);
        if matches!(law, Law::Yielding | Law::Buckling) {
            assert!(eb > 1e3, "{what}: {eb}");
        }
        close(ea, eb, eb.max(1.0), 10.0 * within, &what);
        let [one, other] = [&a.0.buildings[0].members, &b.0.buildings[0].members];
        assert_eq!(one.diagonals.len(), 2 * line_of(law, None).len());
        for (diagonal, other) in one.diagonals.iter().zip(&other.diagonals) {
            let [member, other] = [a.1.members[0][diagonal.form], b.1.members[0][other.form]];
            for (model, other) in member.into_iter().zip(other) {
                close(
                    model,
                    other,
                    1e5,
                    10.0 * within,
                    &format!("{what}: diagonal"),
                );
            }
        }
        let mut compared = 0;
        for member in other
            .members
            .iter()
            .filter(|member| member.frame == Some(1))
        {
            let place = match member.place {
                MemberPlace::Column { line, storey } => SpacePlace::Column {
                    line: [line - 1, 1],
                    storey: storey - 1,
                },
                MemberPlace::Beam { floor, span } => SpacePlace::BeamX {
                    span: span - 1,
                    line: 1,
                    floor: floor - 1,
                },
                MemberPlace::InSpace(_) => panic!("a plane frame"),
            };
            let mut members = one.members.iter();
            let same = members.find(|member| member.place == MemberPlace::InSpace(place));
            for (section, other) in same.expect("it").sections.iter().zip(&member.sections) {
                for (form, other) in section.forms.iter().zip(other.forms) {
                    let [member, other] = [a.1.members[0][*form], b.1.members[0][other]];
                    for (model, other) in member.into_iter().zip(other) {
                        close(model, other, 1e5, 1e3 * within, &format!("{what}: {place}"));
                    }
                }
            }
            compared += 1;
        }
        assert_eq!(compared, HEIGHTS.len() * (3 + 2));
    }
}

/// A frame without symmetry, with diagonals along both axes and rigid zones.
fn uneven(law: Law) -> Tiers {
    let mut frame = grid(&[0.0, 6.0, 11.0], &[0.0, 5.0], 2, true);
    frame.diagonals = vec![
        law.diagonal(on(PlanAxis::X, 1), 1, 1, Rise::Right),
        law.diagonal(on(PlanAxis::X, 1), 2, 2, Rise::Left),
        law.diagonal(on(PlanAxis::Y, 3), 1, 1, Rise::Left),
        law.diagonal(on(PlanAxis::Y, 3), 2, 1, Rise::Right),
    ];
    frame.rigid_zones.insert([0, 1, 0], ZONE);
    frame.rigid_zones.insert([1, 2, 1], ZONE);
    let plan = vec![[0.0, 0.0], [11.0, 0.0], [11.0, 5.0], [0.0, 5.0]];
    let mut tier = Tier::uniform(90e3, plan).expect("an area");
    tier.centre = [6.0, 2.1];
    Tiers {
        floors: vec![tier; 2],
        storey_heights: vec![3.6, 3.2],
        space_frame: Some(frame),
        ..Tiers::default()
    }
}

/// The same on the site as seen from above through a mirror that exchanges x and y.
fn exchanged(tiers: &Tiers) -> Tiers {
    let mut tiers = tiers.clone();
    let swap = |[x, y]: PlanPoint| [y, x];
    for floor in &mut tiers.floors {
        floor.centre = swap(floor.centre);
        floor.plan = floor.plan.iter().rev().map(|at| swap(*at)).collect();
    }
    let frame = tiers.space_frame.as_mut().expect("a frame");
    std::mem::swap(&mut frame.lines_x, &mut frame.lines_y);
    for member in &mut frame.members {
        member.place = match member.place {
            SpacePlace::Column { line, storey } => {
                member.section.flexural_rigidity.swap(0, 1);
                if let Some(shear_rigidity) = &mut member.section.shear_rigidity {
                    shear_rigidity.swap(0, 1);
                }
                SpacePlace::Column {
                    line: [line[1], line[0]],
                    storey,
                }
            }
            SpacePlace::BeamX { span, line, floor } => SpacePlace::BeamY { line, span, floor },
            SpacePlace::BeamY { line, span, floor } => SpacePlace::BeamX { span, line, floor },
        };
    }
    for diagonal in &mut frame.diagonals {
        let line = diagonal.place.line.as_mut().expect("a line");
        line.along = match line.along {
            PlanAxis::X => PlanAxis::Y,
            PlanAxis::Y => PlanAxis::X,
        };
    }
    let zones = std::mem::take(&mut frame.rigid_zones);
    let zones = zones.into_iter();
    frame.rigid_zones = zones
        .map(|([floor, x, y], [a, b, c])| ([floor, y, x], [b, a, c]))
        .collect();
    tiers
}

fn shaken(tiers: Tiers, angle: f64, sign: f64, solver: Solver) -> (System, Outcome, Summary) {
    let across = fading("across", 7.0, [1.5 * sign, 3.0], 150);
    let motion = GroundMotion {
        bearing: Some(Box::new(Bearing {
            angle,
            across: Some(across),
        })),
        ..along()
    };
    let model = model(tiers, solver);
    let answer = runs::run_and_summary(&model, &motion);
    assert!(answer.1.energy.worst_imbalance < 1e-6);
    answer
}

fn forces(system: &System, outcome: &Outcome) -> Vec<[f64; 2]> {
    let forces = system.buildings[0].members.diagonals.iter();
    forces.map(|force| outcome.members[0][force.form]).collect()
}

/// A frame that stands turned by 90° with its shaking, and one with x and y exchanged, move and bear the same.
#[test]
fn turned_and_exchanged_frames_bear_the_same() {
    for (law, solver) in [
        (Law::Elastic, Solver::Modal),
        (Law::Yielding, Solver::Riccati),
        (Law::Buckling, Solver::Riccati),
    ] {
        let tiers = uneven(law);
        let (system, outcome, _) = shaken(tiers.clone(), 0.3, 1.0, solver);
        let reference = forces(&system, &outcome);
        assert!(
            reference
                .iter()
                .all(|[most, least]| *most > 1e4 && *least < -1e4)
        );
        let mut turned = tiers.clone();
        let turn = |[x, y]: PlanPoint| [-y, x];
        for floor in &mut turned.floors {
            floor.centre = turn(floor.centre);
            floor.plan = floor.plan.iter().map(|at| turn(*at)).collect();
        }
        turned.space_frame.as_mut().expect("a frame").direction = [0.0, 1.0];
        let turned = shaken(turned, 0.3 + FRAC_PI_2, 1.0, solver);
        // Seen in the mirror, the motion across comes from the other side.
        let mirrored = shaken(exchanged(&tiers), FRAC_PI_2 - 0.3, -1.0, solver);
        let within = if solver == Solver::Modal { 1e-7 } else { 1e-9 };
        for (name, (system, outcome, _)) in [("turned", turned), ("exchanged", mirrored)] {
            for (force, other) in reference.iter().zip(forces(&system, &outcome)) {
                for (force, other) in force.iter().zip(other) {
                    close(other, *force, 1e5, within, &format!("{law:?}, {name}"));
                }
            }
        }
    }
}

/// Panels are compared with the accelerations of their floors across their own plane, as those of plane frames at the same lines.
#[test]
fn panels_are_compared_with_what_shakes_them_across() {
    let panel = |line, storey| {
        let mut diagonal = Law::Struts.diagonal(line, storey, 1, Rise::Right);
        diagonal.across = Some(PanelAcross {
            strength: 1e4,
            surface_mass: 280.0,
            falls: false,
        });
        diagonal
    };
    let mut tiers = uneven(Law::Elastic);
    let frame = tiers.space_frame.as_mut().expect("a frame");
    let [c, s] = [0.8, 0.6];
    frame.direction = [c, s];
    frame.diagonals = vec![panel(on(PlanAxis::X, 2), 1), panel(on(PlanAxis::Y, 1), 2)];
    let turn = |[x, y]: PlanPoint| [c * x - s * y, s * x + c * y];
    for floor in &mut tiers.floors {
        floor.centre = turn(floor.centre);
        floor.plan = floor.plan.iter().map(|at| turn(*at)).collect();
    }
    let (_, outcome, summary) = shaken(tiers, 0.3, 1.0, Solver::Riccati);
    let most = |floor: usize| {
        let peaks = outcome.peaks.floor(0, floor);
        [
            peaks.total_acceleration(),
            peaks.across().total_acceleration(),
        ]
    };
    let [first, second] = [most(1), most(2)];
    let across_x = |[x, y]: [f64; 2]| s * x + c * y;
    let across_y = |[x, y]: [f64; 2]| c * x + s * y;
    let due = [across_x(first), across_y(first).max(across_y(second))];
    let parts = &summary.buildings[0].parts;
    assert_eq!(parts[0].name, "A.infill_x.1.1.2");
    assert_eq!(parts[1].name, "A.infill_y.2.1.1");
    for (part, due) in parts.iter().zip(due) {
        let due = 280.0 * due / 1e4;
        close(
            part.out_of_plane_ratio.expect("it"),
            due,
            due,
            1e-12,
            &part.name,
        );
    }
}

/// Faults of places say which end is wrong.
#[test]
fn diagonals_without_joints_are_refused() {
    let faults = |change: &dyn Fn(&mut SpaceFrame)| {
        let mut tiers = uneven(Law::Elastic);
        change(tiers.space_frame.as_mut().expect("a frame"));
        let faults = System::assemble(&model(tiers, Solver::Riccati)).expect_err("a fault");
        faults
            .iter()
            .map(|fault| format!("{}: {}", fault.path, fault.problem))
            .collect::<Vec<_>>()
            .join("; ")
    };
    let gone = faults(&|frame| {
        frame.members.retain(|member| {
            let [a, b] = member.place.crossings();
            (a != [1, 0] && b != [1, 0]) || member.place.storey() == 0
        });
    });
    assert!(
        gone.contains("brace_x.2.2.1.down ends at x = 2, y = 1 of floor 2"),
        "{gone}"
    );
    let outside = faults(&|frame| frame.diagonals[0].place.bay = 3);
    assert!(
        outside.contains("is in no bay of a grid of 2 lines along x and 3 across"),
        "{outside}"
    );
    let unplaced = faults(&|frame| frame.diagonals[0].place.line = None);
    assert!(unplaced.contains("is in no bay"), "{unplaced}");
    let twice = faults(&|frame| frame.diagonals.push(frame.diagonals[0]));
    assert!(twice.contains("two of brace_x.1.1.1.up"), "{twice}");
    let long = faults(&|frame| {
        frame.rigid_zones.insert([0, 0, 0], [5.9, 0.0, 0.0]);
    });
    assert!(
        long.contains("leaves no length between the joints of the beam from x = 1"),
        "{long}"
    );
}
