//! Vertical shaking and self weight of frames in plan, against one of these frames in its own plane.

use std::f64::consts::PI;

use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
use jostle::pushover::{PushSettings, pushover};
use jostle::{
    Analysis, Building, Damping, Frame, FrameHinges, Gap, Gravity, GroundMotion, Grounds, Hinges,
    Model, Outcome, OwnGround, Plan, PlanFrame, Section, Solver, SpaceFrame, SpaceMember,
    SpacePlace, SpaceSection, Structure, Tier, TierStorey, Tiers,
};
use jostle_testkit::compare::close;
use jostle_testkit::models::{self, CONCRETE, concrete, rectangle};
use jostle_testkit::motions::fading;
use jostle_testkit::runs;

use super::isolation_in_plan::from;

const STOREYS: usize = 2;

/// Of a slab that frames alone carry \[kg\].
const LIGHT: f64 = 1.0;

fn frame(beam_mass: f64) -> Frame {
    let mut frame = models::frame(STOREYS, &[6.0, 6.0], concrete(0.5, 0.5), concrete(0.3, 0.6));
    frame.axial.columns_flexible = true;
    frame.beam_mass = vec![beam_mass; STOREYS];
    frame.floor_mass = vec![0.0; STOREYS];
    frame.beam_segments = vec![2; 2];
    for column in &mut frame.columns {
        column.line_mass = 0.0;
    }
    frame
}

/// Two equal frames along the row, and two across that carry nothing by themselves.
fn in_plan(slab: f64, along: &Frame, hinges: &FrameHinges) -> Building {
    let across = frame(0.0);
    let standing = |name: &str, at, angle: f64, frame: &Frame, hinges: &FrameHinges| PlanFrame {
        name: name.to_owned(),
        at,
        direction: [angle.cos(), angle.sin()],
        lines: Vec::new(),
        base: Default::default(),
        hinges: hinges.clone(),
        frame: frame.clone(),
    };
    let elastic = FrameHinges::default();
    let frames = vec![
        standing("1", [0.0, 0.0], 0.0, along, hinges),
        standing("2", [0.0, 12.0], 0.0, along, hinges),
        standing("A", [0.0, 0.0], 0.5 * PI, &across, &elastic),
        standing("B", [12.0, 0.0], 0.5 * PI, &across, &elastic),
    ];
    let plan = rectangle(0.0, 0.0, 12.0, 12.0);
    let tier = Tier::uniform(slab, plan).expect("an area");
    let heights = along.storey_heights.clone();
    building(Structure::Tiers(Tiers {
        floors: vec![tier; STOREYS],
        storey_heights: heights,
        frames,
        ..Tiers::default()
    }))
}

/// A frame that carries half of this slab.
fn with_half(mut frame: Frame) -> Frame {
    frame.floor_mass = vec![0.5 * LIGHT; STOREYS];
    frame
}

fn building(structure: Structure) -> Building {
    Building {
        name: "A".to_owned(),
        structure,
        damping: Damping::Rayleigh {
            alpha: 0.4,
            beta: 1e-3,
        },
        gravity: Gravity {
            preload: true,
            ..Gravity::default()
        },
        ..Building::default()
    }
}

fn model(buildings: Vec<Building>, gaps: Vec<Gap>, solver: Option<Solver>) -> Model {
    Model {
        buildings,
        gaps,
        analysis: Analysis {
            tolerance: 1e-5,
            solver,
            ..Analysis::default()
        },
        ..Model::default()
    }
}

/// Along the row, and upwards under as many buildings, scaled by factors.
fn shaking(along: f64, up: f64, buildings: usize) -> GroundMotion {
    let mut motion = fading("along", 5.0, [along, 2.0], 200);
    let vertical = fading("up", 9.0, [up, 2.0], 200);
    let ground = OwnGround {
        vertical: Some(vertical),
        ..OwnGround::default()
    };
    motion.grounds = Some(Box::new(Grounds {
        own: vec![ground; buildings],
    }));
    motion
}

fn run(model: &Model, motion: &GroundMotion) -> Outcome {
    let (_, outcome) = runs::run(model, motion, None);
    assert!(outcome.energy.worst_imbalance < 1e-8);
    outcome
}

fn same_floors(outcome: &Outcome, plane: &Outcome, tolerance: f64) {
    let floors = outcome.peaks.floors(0);
    for (a, b) in floors.iter().zip(&plane.peaks.floors(0)) {
        let [x, y] = [a, b].map(|floor| floor.displacement_max().value);
        close(x, y, y, tolerance, "along");
        let [x, y] = [a, b].map(|floor| floor.vertical_displacement());
        assert!(y > 1e-5, "{y}");
        close(x, y, y, tolerance, "up");
    }
}

/// Frames along the row carry all: each moves in both directions as it does alone.
#[test]
fn frames_rise_as_in_their_own_plane() {
    let frame = frame(6000.0);
    let space = in_plan(LIGHT, &frame, &FrameHinges::default());
    let plane = building(Structure::Frame(with_half(frame)));
    let motion = shaking(3.0, 4.0, 1);
    for solver in [Solver::Riccati, Solver::Stiffness] {
        let [a, b] = [space.clone(), plane.clone()]
            .map(|building| run(&model(vec![building], vec![], Some(solver)), &motion));
        same_floors(&a, &b, 1e-5);
        for floor in a.peaks.floors(0) {
            assert!(floor.across().displacement_max().value.abs() < 1e-9);
        }
    }
}

/// A slab is shared equally by all columns: shaken upwards alone, a frame moves as one that carries its share.
#[test]
fn columns_share_a_slab_equally() {
    let slab = 90e3;
    let frame = frame(0.0);
    let space = in_plan(slab, &frame, &FrameHinges::default());
    let mut plane = frame;
    // Three columns of twelve.
    plane.floor_mass = vec![slab / 4.0; STOREYS];
    let motion = shaking(1e-9, 4.0, 1);
    let [a, b] = [space, building(Structure::Frame(plane))].map(|building| {
        let mut model = model(vec![building], vec![], Some(Solver::Riccati));
        model.analysis.tolerance = 1e-4;
        run(&model, &motion)
    });
    for (a, b) in a.peaks.floors(0).iter().zip(&b.peaks.floors(0)) {
        let [x, y] = [a, b].map(|floor| floor.vertical_displacement());
        close(x, y, y, 1e-4, "up");
    }
}

/// Beams crack under self weight, and yield when shaken: as in the plane.
#[test]
fn self_weight_cracks_beams_in_plan() {
    let frame = frame(9000.0);
    let hinge = |cracking: f64, yielding: f64| {
        let corners = Corners {
            cracking,
            yielding,
            post_cracking: 0.3,
            post_yield: 0.05,
        };
        let backbone = Backbone::from_forces(4e8, corners, corners).expect("sound");
        Hysteresis::new(HysteresisRule::PeakOriented, backbone).expect("sound")
    };
    let hinges = FrameHinges {
        beams: vec![vec![hinge(20e3, 150e3); 2]; STOREYS],
        ..FrameHinges::default()
    };
    let space = in_plan(LIGHT, &frame, &hinges);
    let mut plane = building(Structure::Frame(with_half(frame)));
    plane.hinges = Some(Hinges::Frame(hinges));
    let motion = shaking(4.0, 3.0, 1);
    let [a, b] = [space, plane].map(|building| {
        run(
            &model(vec![building], vec![], Some(Solver::Riccati)),
            &motion,
        )
    });
    same_floors(&a, &b, 1e-4);
    assert!(!a.spring_events.is_empty());
}

/// Vertical shaking of floors whose mass nothing carries is refused with the remedy.
#[test]
fn floors_need_columns_that_carry_them() {
    let mut space = in_plan(80e3, &frame(6000.0), &FrameHinges::default());
    space.gravity.preload = false;
    let system = runs::assembled(&model(vec![space], vec![], None));
    let refused = Plan::choose(&system, &shaking(3.0, 4.0, 1), &Analysis::default());
    let faults = refused.expect_err("it is refused");
    assert!(faults[0].problem.contains("gravity = true"), "{faults:?}");
}

/// All ways of stepping agree on buildings in plan that pound and shake in three directions.
#[test]
fn solvers_agree_in_three_directions() {
    let left = in_plan(80e3, &frame(3000.0), &FrameHinges::default());
    let mut right = in_plan(50e3, &frame(6000.0), &FrameHinges::default());
    right.name = "B".to_owned();
    if let Structure::Tiers(tiers) = &mut right.structure {
        for floor in &mut tiers.floors {
            floor.centre[0] += 12.02;
            floor.plan.iter_mut().for_each(|corner| corner[0] += 12.02);
        }
        for frame in &mut tiers.frames {
            frame.at[0] += 12.02;
        }
    }
    let gap = Gap::between([Some(0), Some(1)], 0.02, CONCRETE);
    let across = Some(fading("across", 4.0, [2.0, 2.0], 200));
    let motion = from(shaking(5.0, 4.0, 2), 0.4, across);
    let [riccati, stiffness] = [Solver::Riccati, Solver::Stiffness].map(|solver| {
        let buildings = vec![left.clone(), right.clone()];
        run(&model(buildings, vec![gap.clone()], Some(solver)), &motion)
    });
    assert!(!riccati.impacts.is_empty());
    for building in 0..2 {
        let floors = riccati.peaks.floors(building);
        for (a, b) in floors.iter().zip(&stiffness.peaks.floors(building)) {
            let moved = [a, b].map(|floor| floor.displacement_max().value);
            let across = [a, b].map(|floor| floor.across().displacement_max().value);
            let up = [a, b].map(|floor| floor.vertical_displacement());
            for [x, y] in [moved, across, up] {
                close(x, y, y, 1e-6, "peak");
            }
        }
    }
}

/// A space frame of one bay deep and two plane frames are one building: columns carry equal shares in both.
#[test]
fn a_space_frame_rises_as_plane_frames() {
    let (columns, beams) = (concrete(0.5, 0.5), concrete(0.3, 0.6));
    let section = |section: &Section| SpaceSection {
        size: [0.5, 0.5],
        flexural_rigidity: [section.flexural_rigidity; 2],
        torsional_rigidity: 1.0,
        axial_rigidity: section.axial_rigidity,
        shear_rigidity: None,
        line_mass: 0.0,
    };
    let mut members = Vec::new();
    for level in 0..STOREYS {
        for (x, y) in [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1)] {
            let place = SpacePlace::Column {
                line: [x, y],
                storey: level,
            };
            members.push(SpaceMember::elastic(place, section(&columns)));
        }
        for (span, line) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let place = SpacePlace::BeamX {
                span,
                line,
                floor: level,
            };
            members.push(SpaceMember::elastic(place, section(&beams)));
        }
    }
    let tier = Tier::uniform(90e3, rectangle(0.0, 0.0, 12.0, 12.0)).expect("an area");
    let across = TierStorey {
        stiffness: [0.0, 80e6, 5e9],
        centre: [6.0, 6.0],
    };
    let tiers = Tiers {
        floors: vec![tier; STOREYS],
        storeys: vec![across; STOREYS],
        storey_heights: vec![3.2; STOREYS],
        space_frame: Some(SpaceFrame {
            at: [0.0, 0.0],
            direction: [1.0, 0.0],
            lines_x: vec![0.0, 6.0, 12.0],
            lines_y: vec![0.0, 12.0],
            members,
            ..SpaceFrame::default()
        }),
        ..Tiers::default()
    };
    let mut plane = frame(0.0);
    plane.floor_mass = vec![45e3; STOREYS];
    let motion = shaking(3.0, 4.0, 1);
    for solver in [Solver::Riccati, Solver::Stiffness] {
        let structures = [
            Structure::Tiers(tiers.clone()),
            Structure::Frame(plane.clone()),
        ];
        let [a, b] = structures.map(|structure| {
            run(
                &model(vec![building(structure)], vec![], Some(solver)),
                &motion,
            )
        });
        same_floors(&a, &b, 1e-5);
    }
}

/// Frames along the row are stiffer than those across, which the first mode moves: a push along the row follows the mode along it.
#[test]
fn a_push_along_the_row_takes_the_mode_along_the_row() {
    let frame = frame(6000.0);
    let plane = with_half(frame.clone());
    let mut space = in_plan(LIGHT, &frame, &FrameHinges::default());
    if let Structure::Tiers(tiers) = &mut space.structure {
        for weak in &mut tiers.frames[2..] {
            for column in &mut weak.frame.columns {
                column.flexural_rigidity *= 0.3;
            }
        }
    }
    let [space, plane] = [space, building(Structure::Frame(plane))].map(|building| {
        let system = runs::assembled(&model(vec![building], vec![], None));
        let first = system.buildings[0].lateral_modes().next().expect("a mode");
        let ratios = [
            first.effective_mass_ratio_x,
            first.effective_mass_ratio_across,
        ];
        let curve = pushover(&system.buildings[0], PushSettings::default()).expect("a curve");
        (ratios, curve.floor_loads)
    });
    assert!(space.0[0] < 1e-9 && space.0[1] > 0.5, "{:?}", space.0);
    for (a, b) in space.1.iter().zip(&plane.1) {
        close(*a, *b, *b, 1e-6, "load");
    }
}

/// Columns that a frame lacks carry nothing, and the others all of it.
#[test]
fn columns_that_stand_carry_the_whole_slab() {
    let slab = 90e3;
    let mut frame = frame(0.0);
    frame.own_columns.insert([STOREYS - 1, 2], None);
    frame.own_beams.insert([STOREYS - 1, 1], None);
    let space = in_plan(slab, &frame, &FrameHinges::default());
    let system = runs::assembled(&model(vec![space], vec![], None));
    let rising: f64 = system.buildings[0].equations.vertical_mass.iter().sum();
    close(rising, slab * STOREYS as f64, rising, 1e-12, "mass");
}
