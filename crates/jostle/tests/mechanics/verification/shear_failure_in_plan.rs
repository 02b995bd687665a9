//! Columns that fail in shear in frames at lines of a plan and in space frames: the plane frame of one face is their limit.

use jostle::hysteresis::{Backbone, Corners, FallingBranch, Hysteresis, HysteresisRule};
use jostle::model::CapacityLine;
use jostle::{
    Analysis, Axial, Base, Bearing, Building, Damping, Frame, FrameHinges, GroundMotion, Hinges,
    Model, Outcome, PlanAxis, PlanFrame, Section, ShearEnds, ShearSpring, Solver, SpaceFrame,
    SpaceMember, SpacePlace, SpaceSection, Structure, Summary, System, Tier, TierStorey, Tiers,
};
use jostle_testkit::compare::close;
use jostle_testkit::motions::fading;
use jostle_testkit::runs;

const E: f64 = 30e9;
const SPANS: [f64; 2] = [6.0, 5.0];
const DEPTH: f64 = 5.0;
const HEIGHTS: [f64; 3] = [4.0, 3.2, 3.2];
/// Of a floor of one face \[kg\].
const MASS: f64 = 45e3;

/// What columns do.
#[derive(Clone, Copy, Debug)]
struct Case {
    /// Whether columns and beams have hinges, whose ductility lowers the strength.
    yields: bool,
}

fn column() -> SpaceSection {
    SpaceSection {
        axial_rigidity: None,
        ..SpaceSection::rectangle([0.5, 0.4], E, 0.2, true).expect("a section")
    }
}

fn beam() -> SpaceSection {
    SpaceSection::beam([0.3, 0.6], E, 0.2, true).expect("a section")
}

fn shear(case: Case, storey: usize, line: usize) -> ShearSpring {
    let height: f64 = HEIGHTS[storey];
    let stiffness = 12.0 * column().flexural_rigidity[0] / height.powi(3);
    // Some columns are weaker than others.
    let strength = 6e4 + 2.5e4 * ((storey + line) % 3) as f64;
    let falling = FallingBranch {
        slope: 0.1 * stiffness,
        residual: 0.6 * strength,
    };
    ShearSpring {
        spring: Hysteresis::failing(1e4 * stiffness, strength, falling).expect("sound"),
        ends: ShearEnds::Foot,
        by_ductility: match case.yields {
            true => CapacityLine::new(vec![[1.0, strength], [3.0, 0.5 * strength]]),
            false => CapacityLine::default(),
        },
    }
}

fn hinge(moment: f64) -> Hysteresis {
    let corners = Corners::bilinear(moment, 0.02);
    let backbone = Backbone::from_forces(1e10, corners, corners).expect("sound");
    Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("sound")
}

const HINGES: [f64; 2] = [1.3e5, 0.9e5];

/// One face as a plane frame, and its hinges.
fn face(case: Case) -> (Frame, FrameHinges) {
    let section = |section: SpaceSection| Section {
        flexural_rigidity: section.flexural_rigidity[0],
        axial_rigidity: Some(1e9),
        shear_rigidity: section.shear_rigidity.map(|both| both[0]),
        line_mass: 0.0,
    };
    let storeys = HEIGHTS.len();
    let frame = Frame {
        storey_heights: HEIGHTS.to_vec(),
        spans: SPANS.to_vec(),
        columns: vec![section(column()); storeys],
        beams: vec![section(beam()); storeys],
        beam_mass: vec![0.0; storeys],
        floor_mass: vec![MASS; storeys],
        column_segments: 1,
        beam_segments: vec![1; 2],
        axial: Axial {
            columns_flexible: false,
            beams_flexible: false,
        },
        ..Frame::default()
    };
    let rows = (0..storeys).map(|storey| (0..3).map(|line| shear(case, storey, line)).collect());
    let all = |count: usize, moment: f64| match case.yields {
        true => vec![vec![hinge(moment); count]; storeys],
        false => Vec::new(),
    };
    let hinges = FrameHinges {
        shear: rows.collect(),
        columns: all(3, HINGES[0]),
        beams: all(2, HINGES[1]),
        ..FrameHinges::default()
    };
    (frame, hinges)
}

fn building(structure: Structure, hinges: Option<Hinges>) -> Building {
    Building {
        name: "A".to_owned(),
        structure,
        hinges,
        damping: Damping::Rayleigh {
            alpha: 0.4,
            beta: 0.0,
        },
        ..Building::default()
    }
}

fn in_plan(axis: PlanAxis, frames: Vec<PlanFrame>, space_frame: Option<SpaceFrame>) -> Building {
    let length: f64 = SPANS.iter().sum();
    let [a, b] = match axis {
        PlanAxis::X => [length, DEPTH],
        PlanAxis::Y => [DEPTH, length],
    };
    let plan = vec![[0.0, 0.0], [a, 0.0], [a, b], [0.0, b]];
    let floor = Tier::uniform(2.0 * MASS, plan).expect("an area");
    let mut across = [80e6; 2];
    across[axis.index()] = 0.0;
    // Plane frames need something across.
    let storey = TierStorey {
        stiffness: [across[0], across[1], 5e9],
        centre: [0.5 * a, 0.5 * b],
    };
    let storeys = match frames.is_empty() {
        true => Vec::new(),
        false => vec![storey; HEIGHTS.len()],
    };
    let tiers = Tiers {
        floors: vec![floor; HEIGHTS.len()],
        storeys,
        storey_heights: HEIGHTS.to_vec(),
        frames,
        space_frame,
        ..Tiers::default()
    };
    building(Structure::Tiers(tiers), None)
}

/// Two such faces at lines of a plan.
fn at_lines(axis: PlanAxis, case: Case) -> Building {
    let (mut frame, hinges) = face(case);
    frame.floor_mass = vec![0.0; HEIGHTS.len()];
    let standing = |name: &str, at: f64| PlanFrame {
        name: name.to_owned(),
        at: match axis {
            PlanAxis::X => [0.0, at],
            PlanAxis::Y => [at, 0.0],
        },
        direction: match axis {
            PlanAxis::X => [1.0, 0.0],
            PlanAxis::Y => [0.0, 1.0],
        },
        lines: Vec::new(),
        base: Base::default(),
        frame: frame.clone(),
        hinges: hinges.clone(),
    };
    in_plan(axis, vec![standing("1", 0.0), standing("2", DEPTH)], None)
}

/// The same two faces with beams between them.
fn in_space(axis: PlanAxis, case: Case) -> Building {
    let mut frame = SpaceFrame::default();
    let lines = vec![0.0, SPANS[0], SPANS[0] + SPANS[1]];
    (frame.lines_x, frame.lines_y) = match axis {
        PlanAxis::X => (lines, vec![0.0, DEPTH]),
        PlanAxis::Y => (vec![0.0, DEPTH], lines),
    };
    let mut own = column();
    let at = |line: usize, side: usize| match axis {
        PlanAxis::X => [line, side],
        PlanAxis::Y => [side, line],
    };
    if axis == PlanAxis::Y {
        own.flexural_rigidity.swap(0, 1);
        own.shear_rigidity = own.shear_rigidity.map(|[first, second]| [second, first]);
    }
    for storey in 0..HEIGHTS.len() {
        for (line, side) in (0..3).flat_map(|line| [(line, 0), (line, 1)]) {
            let (floor, crossing) = (storey, at(line, side));
            let place = SpacePlace::Column {
                line: crossing,
                storey,
            };
            let mut member = SpaceMember::elastic(place, own);
            if case.yields {
                member.hinges[axis.index()] = Some(hinge(HINGES[0]));
            }
            frame.members.push(member);
            frame.shear.insert((place, axis), shear(case, storey, line));
            if line < 2 {
                let place = match axis {
                    PlanAxis::X => SpacePlace::BeamX {
                        span: line,
                        line: side,
                        floor,
                    },
                    PlanAxis::Y => SpacePlace::BeamY {
                        line: side,
                        span: line,
                        floor,
                    },
                };
                let mut member = SpaceMember::elastic(place, beam());
                if case.yields {
                    member.hinges[0] = Some(hinge(HINGES[1]));
                }
                frame.members.push(member);
            }
            if side == 0 {
                let place = match axis {
                    PlanAxis::X => SpacePlace::BeamY {
                        line,
                        span: 0,
                        floor,
                    },
                    PlanAxis::Y => SpacePlace::BeamX {
                        span: 0,
                        line,
                        floor,
                    },
                };
                frame.members.push(SpaceMember::elastic(place, beam()));
            }
        }
    }
    in_plan(axis, Vec::new(), Some(frame))
}

fn shaken(building: Building, angle: Option<f64>) -> (System, Outcome, Summary) {
    let model = Model {
        title: "failing columns".to_owned(),
        buildings: vec![building],
        analysis: Analysis {
            solver: Some(Solver::Riccati),
            step: Some(1e-3),
            tolerance: 1e-6,
            ..Analysis::default()
        },
        ..Model::default()
    };
    let bearing = angle.map(|angle| {
        Box::new(Bearing {
            angle,
            across: None,
        })
    });
    let motion = GroundMotion {
        bearing,
        ..fading("along", 9.0, [0.7, 3.0], 150)
    };
    runs::run_and_summary(&model, &motion)
}

/// Greatest displacements of the floors along x and across.
fn sways(outcome: &Outcome) -> Vec<[f64; 2]> {
    let floors = outcome.peaks.floors(0);
    let floors = floors.iter();
    floors
        .map(|peak| {
            [
                peak.displacement().size(),
                peak.across().displacement().size(),
            ]
        })
        .collect()
}

/// Shaken in the direction of its faces, a building moves as one plane frame with half its mass, and its columns fail at the same instants:
/// at lines of a plan and in space, along x and across.
#[test]
fn faces_that_fail_are_their_plane_limit() {
    for yields in [false, true] {
        let case = Case { yields };
        let (frame, hinges) = face(case);
        let plane = building(Structure::Frame(frame), Some(Hinges::Frame(hinges)));
        let (_, plane, summary) = shaken(plane, None);
        assert!(plane.energy.worst_imbalance < 1e-6, "{case:?}");
        let due = summary.buildings[0]
            .shear_failures
            .clone()
            .expect("some can");
        assert!(
            due.failed >= 3 && due.failed < 9,
            "{case:?}: {}",
            due.failed
        );
        let (due_sways, energy) = (sways(&plane), plane.energy.hysteretic);
        assert!(energy > 1e3, "{case:?}: {energy}");
        for axis in PlanAxis::BOTH {
            let angle = (axis == PlanAxis::Y).then_some(std::f64::consts::FRAC_PI_2);
            for building in [at_lines(axis, case), in_space(axis, case)] {
                let what = format!("{case:?}, {axis:?}");
                let (system, outcome, summary) = shaken(building, angle);
                assert!(outcome.energy.worst_imbalance < 1e-6, "{what}");
                for (sway, due) in sways(&outcome).iter().zip(&due_sways) {
                    close(sway[axis.index()], due[0], due[0], 1e-6, &what);
                    assert!(sway[1 - axis.index()] < 1e-9, "{what}: {sway:?}");
                }
                close(
                    outcome.energy.hysteretic,
                    2.0 * energy,
                    2.0 * energy,
                    1e-5,
                    &what,
                );
                let found = summary.buildings[0]
                    .shear_failures
                    .clone()
                    .expect("some can");
                assert_eq!((found.total, found.failed), (18, 2 * due.failed), "{what}");
                close(
                    found.dissipated_j,
                    2.0 * due.dissipated_j,
                    energy,
                    1e-5,
                    &what,
                );
                for (pair, due) in found.list.chunks(2).zip(&due.list) {
                    for own in pair {
                        close(own.failed_s, due.failed_s, 1.0, 1e-6, &what);
                        close(own.strength_n, due.strength_n, 1e5, 1e-6, &what);
                        close(own.slip_peak_m, due.slip_peak_m, 1e-2, 1e-4, &what);
                        assert_eq!(own.at, due.at);
                    }
                }
                let in_space = system.buildings[0].discretization.frames.is_empty();
                let first = &found.list[0];
                let axis_name = in_space.then_some(axis.name());
                assert_eq!(first.along, axis_name, "{what}");
                let name = due.list[0].column.replace("A.column.", "");
                let (line, storey) = name.split_once('.').expect("line and storey");
                let names = match (in_space, axis) {
                    (false, _) => [1, 2].map(|frame| format!("A.{frame}.column.{line}.{storey}")),
                    (_, PlanAxis::X) => [1, 2].map(|y| format!("A.column.{line}.{y}.{storey}")),
                    (_, PlanAxis::Y) => [1, 2].map(|x| format!("A.column.{x}.{line}.{storey}")),
                };
                assert!(names.contains(&first.column), "{what}: {}", first.column);
            }
        }
    }
}

/// Both directions of a column fail by themselves: what fails along x bears its whole strength across.
#[test]
fn directions_fail_by_themselves() {
    let case = Case { yields: false };
    let mut building = in_space(PlanAxis::X, case);
    let Structure::Tiers(tiers) = &mut building.structure else {
        panic!("in plan");
    };
    let frame = tiers.space_frame.as_mut().expect("a frame");
    let across: Vec<_> = frame
        .shear
        .iter()
        .map(|((place, _), spring)| ((*place, PlanAxis::Y), spring.clone()))
        .collect();
    frame.shear.extend(across);
    let (system, outcome, summary) = shaken(building.clone(), None);
    let alone = shaken(in_space(PlanAxis::X, case), None);
    for (both, one) in sways(&outcome).iter().zip(sways(&alone.1)) {
        close(both[0], one[0], one[0], 1e-4, "along x");
    }
    let failures = summary.buildings[0]
        .shear_failures
        .clone()
        .expect("some can");
    assert!(failures.list.iter().all(|own| own.along == Some("x")));
    assert_eq!(failures.total, 18);
    let places = &system.buildings[0].discretization.spring_places;
    assert_eq!(places.len(), 36);
    assert_eq!(places[0].to_string(), "column.1.1.1, shear at the foot, x");
    // Shaken askew, some fail in both directions.
    let (_, outcome, summary) = shaken(building, Some(0.9));
    assert!(outcome.energy.worst_imbalance < 1e-6);
    let failures = summary.buildings[0]
        .shear_failures
        .clone()
        .expect("some can");
    for axis in PlanAxis::BOTH {
        assert!(
            failures
                .list
                .iter()
                .any(|own| own.along == Some(axis.name()))
        );
    }
}
