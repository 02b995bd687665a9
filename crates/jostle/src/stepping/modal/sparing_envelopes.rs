//! Forces of columns and beams that are computed only where they can matter, against those computed in every step.

use std::ops::ControlFlow;

use super::member_steps::{MEMORY, MEMORY_IN_TESTS};
use super::members::LOOK_ALWAYS;
use crate::contact::{ContactLaw, LawKind, RestitutionIs};
use crate::model::{
    Analysis, Base, Building, Damping, FloorPairs, Frame, Gap, Gravity, Level, Link, LinkLaw,
    MemberRequest, Model, PlanFrame, PlanPoint, Section, Solver, SpaceFrame, SpaceMember,
    SpacePlace, SpaceSection, Structure, Tier, TierStorey, Tiers,
};
use crate::motion::GroundMotion;
use crate::stepping::{Outcome, Plan, Settings, simulate};
use crate::system::System;

fn building(name: &str, storeys: usize, axial: Option<f64>, damping: &Damping) -> Building {
    let section = |rigidity: f64| Section {
        flexural_rigidity: rigidity,
        axial_rigidity: axial,
        line_mass: 625.0,
        shear_rigidity: None,
    };
    Building {
        name: name.to_owned(),
        structure: Structure::Frame(Frame {
            storey_heights: vec![3.2; storeys],
            spans: vec![2.4, 6.0],
            columns: vec![section(1.56e8); storeys],
            beams: vec![section(1.62e8); storeys],
            beam_mass: vec![3600.0; storeys],
            floor_mass: vec![0.0; storeys],
            column_segments: 2,
            beam_segments: vec![2, 3],
            ..Frame::default()
        }),
        damping: damping.clone(),
        ..Building::default()
    }
}

fn run(model: &Model, always: bool) -> Outcome {
    let system = System::assemble(model).expect("sound");
    let wave = (0..=400).map(|i| {
        let t = 0.02 * f64::from(i);
        let strength = (t / 2.0).min(1.0) * (-0.3 * (t - 4.0).max(0.0)).exp();
        strength * (4.0 * (7.0 * t).sin() + 2.0 * (23.0 * t).cos() + 1.5 * (61.0 * t).sin())
    });
    let motion = GroundMotion::sampled("sines", 0.02, wave.collect());
    let plan = Plan::choose(&system, &motion, &model.analysis).expect("planned");
    let settings = Settings {
        record_interval: None,
        ..Settings::default()
    };
    LOOK_ALWAYS.set(always);
    let outcome = simulate(&system, &motion, &plan, settings, |_| {
        ControlFlow::Continue(())
    });
    LOOK_ALWAYS.set(false);
    outcome
}

/// Frames against each other, floors against columns, damped in three ways, with and without a link.
fn models() -> Vec<Model> {
    let law = |kind| ContactLaw {
        kind,
        stiffness: 2e9,
        restitution: 0.65,
        restitution_is: RestitutionIs::Realised,
    };
    let pair = |axial: Option<f64>, damping: Damping, gap: Gap, links: Vec<Link>| Model {
        title: "Five and eight storeys".to_owned(),
        buildings: vec![
            building("A", 5, axial, &damping),
            building("B", 8, axial, &damping),
        ],
        gaps: vec![gap],
        links,
        analysis: Analysis {
            solver: Some(Solver::Modal),
            members: MemberRequest::all(),
            ..Analysis::default()
        },
        ..Model::default()
    };
    let ratio = Damping::ratio(0.05, []);
    let hertz = || Gap::after(0, 0.02, law(LawKind::HertzDamp));
    let at_columns = Gap {
        floors: FloorPairs::Listed(vec![
            [Level::Height(4.8), Level::Height(4.8)],
            [Level::Floor(4), Level::Floor(4)],
            [Level::Floor(5), Level::Floor(5)],
        ]),
        ..hertz()
    };
    let link = Link {
        between: [Some(0), Some(1)],
        floors: FloorPairs::Listed(vec![[Level::Floor(3), Level::Floor(3)]]),
        level_tolerance: 1e-3,
        stiffness: 2e7,
        damping: 1e5,
        law: LinkLaw::Linear,
        ..Link::default()
    };
    let beta = Damping::Rayleigh {
        alpha: 0.2,
        beta: 0.004,
    };
    vec![
        pair(None, ratio.clone(), hertz(), Vec::new()),
        pair(Some(4e9), ratio.clone(), hertz(), Vec::new()),
        pair(None, beta, at_columns, Vec::new()),
        pair(None, Damping::AllModes { ratio: 0.03 }, hertz(), Vec::new()),
        pair(None, ratio, hertz(), vec![link]),
    ]
}

/// Frames with P-Delta, with columns that keep their length and with those that stretch.
fn leaning() -> Vec<Model> {
    let mut models: Vec<Model> = models().into_iter().take(2).collect();
    for building in models.iter_mut().flat_map(|model| &mut model.buildings) {
        building.damping = Damping::ratio(0.05, [1]);
        building.gravity = Gravity {
            p_delta: true,
            ..Gravity::default()
        };
    }
    models
}

fn tiers(at: f64, storeys: usize) -> Tiers {
    let plan = [[0.0, 0.0], [11.0, 0.0], [11.0, 9.0], [0.0, 9.0]];
    let plan: Vec<PlanPoint> = plan.iter().map(|[x, y]| [at + x, *y]).collect();
    Tiers {
        floors: vec![Tier::uniform(90e3, plan).expect("an area"); storeys],
        storey_heights: vec![3.2; storeys],
        ..Tiers::default()
    }
}

/// Plane frames at lines of a plan, one of them across, beside a core that is off the centre.
fn frames_in_plan(at: f64, storeys: usize) -> Tiers {
    let Structure::Frame(frame) =
        building("", storeys, Some(4e9), &Damping::AllModes { ratio: 0.05 }).structure
    else {
        unreachable!("a frame")
    };
    let standing = |name: &str, foot: PlanPoint, direction: PlanPoint| PlanFrame {
        name: name.to_owned(),
        at: [at + foot[0], foot[1]],
        direction,
        lines: Vec::new(),
        base: Base::default(),
        hinges: Default::default(),
        frame: frame.clone(),
    };
    let core = TierStorey {
        stiffness: [3e7, 4e7, 2e8],
        centre: [at + 3.0, 2.0],
    };
    Tiers {
        storeys: vec![core; storeys],
        frames: vec![
            standing("1", [0.5, 0.0], [1.0, 0.0]),
            standing("2", [1.0, 8.0], [1.0, 0.0]),
            standing("A", [2.0, 0.2], [0.0, 1.0]),
        ],
        ..tiers(at, storeys)
    }
}

/// A grid of columns and beams, one column stiffer than the others.
fn frame_in_space(at: f64, storeys: usize, axial: bool) -> Tiers {
    let section = |size: [f64; 2]| {
        let mut rectangle = SpaceSection::rectangle(size, 30e9, 0.2, true).expect("a section");
        if !axial {
            rectangle.axial_rigidity = None;
        }
        rectangle
    };
    let beam = |size: [f64; 2]| SpaceSection::beam(size, 30e9, 0.2, true).expect("a section");
    let (lines_x, lines_y) = (vec![0.0, 6.0, 11.0], vec![0.0, 9.0]);
    let mut members = Vec::new();
    for storey in 0..storeys {
        for y in 0..2 {
            for x in 0..3 {
                let depth = if [x, y] == [0, 1] { 0.8 } else { 0.5 };
                members.push(SpaceMember {
                    place: SpacePlace::Column {
                        line: [x, y],
                        storey,
                    },
                    section: section([0.4, depth]),
                    hinges: [None; 2],
                });
                if x < 2 {
                    members.push(SpaceMember {
                        place: SpacePlace::BeamX {
                            span: x,
                            line: y,
                            floor: storey,
                        },
                        section: beam([0.3, 0.6]),
                        hinges: [None; 2],
                    });
                }
                if y == 0 {
                    members.push(SpaceMember {
                        place: SpacePlace::BeamY {
                            line: x,
                            span: y,
                            floor: storey,
                        },
                        section: beam([0.25, 0.5]),
                        hinges: [None; 2],
                    });
                }
            }
        }
    }
    Tiers {
        space_frame: Some(SpaceFrame {
            at: [at, 0.0],
            direction: [1.0, 0.0],
            lines_x,
            lines_y,
            members,
            ..SpaceFrame::default()
        }),
        ..tiers(at, storeys)
    }
}

/// Buildings in space that strike each other.
fn in_space() -> Vec<Model> {
    let pair = |structures: [Tiers; 2]| {
        let mut model = models()[1].clone();
        for (building, tiers) in model.buildings.iter_mut().zip(structures) {
            building.structure = Structure::Tiers(tiers);
        }
        let law = ContactLaw {
            kind: LawKind::HertzDamp,
            stiffness: 2e9,
            restitution: 0.65,
            restitution_is: RestitutionIs::Realised,
        };
        model.gaps = vec![Gap::between([Some(0), Some(1)], 0.01, law)];
        model
    };
    vec![
        pair([frames_in_plan(0.0, 3), frames_in_plan(11.01, 4)]),
        pair([frame_in_space(0.0, 3, true), frame_in_space(11.01, 2, true)]),
        pair([
            frame_in_space(0.0, 3, false),
            frame_in_space(11.01, 2, false),
        ]),
    ]
}

fn compare(models: &[Model]) {
    for (index, model) in models.iter().enumerate() {
        let [always, seldom] = [true, false].map(|always| run(model, always));
        assert!(always.impacts.len() > 3, "model {index}");
        assert_eq!(always.work, seldom.work, "model {index}");
        assert!(
            always.members.iter().all(|own| !own.is_empty()),
            "model {index}"
        );
        // So little that steps are looked at many times.
        MEMORY_IN_TESTS.set(0);
        let often = run(model, false);
        MEMORY_IN_TESTS.set(MEMORY);
        for found in [&seldom, &often] {
            for (of_always, member) in always.members.iter().zip(&found.members) {
                for (form, (due, found)) in of_always.iter().zip(member).enumerate() {
                    assert_eq!(due, found, "model {index}, force {form}");
                }
            }
        }
        let estimate = |outcome: &Outcome| outcome.accuracy.map(|accuracy| accuracy.residual);
        assert_eq!(estimate(&always), estimate(&seldom), "model {index}");
    }
}

/// The envelopes are those of forces computed in every step, bit by bit, and so is the estimate of their errors.
#[test]
fn no_extreme_is_missed() {
    compare(&models());
}

#[test]
fn no_extreme_is_missed_under_weight() {
    compare(&leaning());
}

#[test]
fn no_extreme_is_missed_in_space() {
    compare(&in_space());
}
