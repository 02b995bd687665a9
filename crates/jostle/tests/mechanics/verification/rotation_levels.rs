//! Members against stated limits of rotation: instants by runs that end just before and just after them, and chord rotation by the moment
//! of the hinge.

use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
use jostle::model::{LimitedMembers, RotationLevel, RotationLimit, RotationMeasure};
use jostle::results::summary::RotationLevelsSummary;
use jostle::{Analysis, Building, Damping, Frame, FrameHinges, Hinges, Model, Structure};
use jostle_testkit::models::{concrete, frame};
use jostle_testkit::motions::fading;
use jostle_testkit::runs;

const STEP: f64 = 1e-3;

fn hinge(initial: f64, moment: f64) -> Hysteresis {
    let corners = Corners::bilinear(moment, 0.03);
    let backbone = Backbone::from_forces(initial, corners, corners).expect("sound");
    Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("sound")
}

fn limit(of: LimitedMembers, measure: RotationMeasure, values: [f64; 3]) -> RotationLimit {
    RotationLimit {
        of,
        lines: None,
        storeys: None,
        measure,
        limits: RotationLevel::ALL.into_iter().zip(values).collect(),
    }
}

fn model(limits: Vec<RotationLimit>) -> Model {
    let frame: Frame = frame(2, &[5.0], concrete(0.4, 0.4), concrete(0.3, 0.5));
    let hinges = FrameHinges {
        columns: vec![vec![hinge(6e9, 9e4); 2]; 2],
        beams: vec![vec![hinge(4e9, 6e4); 1]; 2],
        ..FrameHinges::default()
    };
    Model {
        title: "limits".to_owned(),
        buildings: vec![Building {
            name: "A".to_owned(),
            structure: Structure::Frame(frame),
            hinges: Some(Hinges::Frame(hinges)),
            damping: Damping::Rayleigh {
                alpha: 0.4,
                beta: 0.0,
            },
            rotation_limits: limits,
            ..Building::default()
        }],
        analysis: Analysis {
            step: Some(STEP),
            ..Analysis::default()
        },
        ..Model::default()
    }
}

fn levels(model: &Model, duration: f64) -> RotationLevelsSummary {
    let mut motion = fading("along", 7.0, [2.0, 3.0], 400);
    motion.duration = duration;
    let (_, _, summary) = runs::run_and_summary(model, &motion);
    let rotation_levels = summary.buildings[0].rotation_levels.clone();
    rotation_levels.expect("it has limits")
}

/// A level is passed in the step at whose end the rotation first exceeds its limit: runs that end a step before have not passed it.
#[test]
fn levels_are_passed_when_rotations_exceed_them() {
    for measure in [RotationMeasure::Plastic, RotationMeasure::Chord] {
        let model = model(vec![
            limit(LimitedMembers::Columns, measure, [2e-3, 8e-3, 0.9]),
            limit(LimitedMembers::Beams, measure, [3e-3, 9e-3, 0.02]),
        ]);
        let found = levels(&model, 8.0);
        println!("{found:?}");
        assert_eq!(found.members, 6);
        assert!(found.beyond_io > 0 && found.beyond_io >= found.beyond_ls);
        for member in found.list.iter().take(2) {
            for level in &member.limits {
                let Some(at) = level.beyond_s else {
                    assert!(member.rotation_rad <= level.limit_rad);
                    continue;
                };
                assert!(member.rotation_rad > level.limit_rad);
                let of = |duration: f64| {
                    let all = levels(&model, duration).list.into_iter();
                    let mut others = all.filter(|other| other.member == member.member);
                    others.next().expect("listed").rotation_rad
                };
                assert!(of(at - STEP) <= level.limit_rad, "{member:?}");
                assert!(of(at) > level.limit_rad, "{member:?}");
            }
        }
    }
}

/// The chord rotation is that of the hinge and M L/6EI of the member; plastic rotation what is beyond yield.
#[test]
fn both_measures_are_those_of_the_hinge() {
    let of = |measure| {
        let levels = levels(
            &model(vec![limit(
                LimitedMembers::Columns,
                measure,
                [1e-4, 1.0, 2.0],
            )]),
            8.0,
        );
        levels.list[0].clone()
    };
    let (plastic, chord) = (of(RotationMeasure::Plastic), of(RotationMeasure::Chord));
    assert_eq!(plastic.member, chord.member);
    let (moment, stiffness) = (9e4, 6e9);
    let section = concrete(0.4, 0.4).flexural_rigidity;
    let reached = moment + 0.03 * stiffness * plastic.rotation_rad;
    let due = plastic.rotation_rad + moment / stiffness + reached * 3.2 / (6.0 * section);
    assert!(
        (chord.rotation_rad / due - 1.0).abs() < 1e-9,
        "{} {due}",
        chord.rotation_rad
    );
}

/// Limits that name no hinge are refused.
#[test]
fn limits_need_hinges() {
    let mut elastic = model(vec![limit(
        LimitedMembers::Columns,
        RotationMeasure::Plastic,
        [1e-3, 2e-3, 3e-3],
    )]);
    elastic.buildings[0].hinges = None;
    let faults = jostle::System::assemble(&elastic).expect_err("no hinges");
    assert!(faults[0].path.ends_with("rotation_limit"), "{faults:?}");
}
