//! Two frames whose floors strike columns, capacities that depend on the axial force, and runs.

use std::ops::ControlFlow;

use jostle::model::{
    CapacityLine, MemberCapacity, RotationLimits, RotationMeasure, RuleCapacity, ShearCapacity,
};
use jostle::{
    Analysis, Axial, Building, ContactLaw, Damping, FloorPairs, Frame, Gap, GroundMotion, Joint,
    LawKind, Level, MemberRequest, Model, Outcome, Plan, RestitutionIs, RunEnd, Section, Settings,
    Solver, Structure, Summary, System, simulate,
};

fn section(rigidity: f64) -> Section {
    Section {
        flexural_rigidity: rigidity,
        axial_rigidity: Some(4e9),
        line_mass: 600.0,
        shear_rigidity: None,
    }
}

pub(crate) fn building(name: &str, storeys: usize, first: f64, rigidity: f64) -> Building {
    let mut heights = vec![3.2; storeys];
    heights[0] = first;
    Building {
        name: name.to_owned(),
        structure: Structure::Frame(Frame {
            storey_heights: heights,
            spans: vec![6.0, 5.0],
            columns: vec![section(rigidity); storeys],
            beams: vec![section(2.0e8); storeys],
            beam_mass: vec![5000.0; storeys],
            floor_mass: vec![9000.0; storeys],
            column_segments: 2,
            beam_segments: vec![3; 2],
            axial: Axial::default(),
            joint: Joint::default(),
        }),
        damping: Damping::Ratio {
            ratio: 0.05,
            modes: Vec::new(),
        },
        ..Building::default()
    }
}

/// Capacities that depend on the axial force, with another rule beside the governing one.
fn capacity(member: String, at_rest: f64) -> MemberCapacity {
    let shear = |factor: f64| ShearCapacity {
        steady: CapacityLine::new(vec![
            [-4e5, 2e4 * factor],
            [0.0, 1e5 * factor],
            [6e5, 2e5 * factor],
        ]),
        degrading: CapacityLine::new(vec![[0.0, 5e4 * factor], [8e5, 9e4 * factor]]),
        by_ductility: CapacityLine::new(vec![[2.0, 1.0], [6.0, 0.7]]),
        limit: 2.5e5 * factor,
    };
    let bending = |factor: f64| {
        let points = [[-6e5, 2e4], [0.0, 1.2e5], [5e5, 2.2e5], [2e6, 3e4]];
        CapacityLine::new(points.map(|[n, m]| [n, factor * m]).to_vec())
    };
    let rule = |rule, factor| RuleCapacity {
        rule,
        shear: Some(shear(factor)),
        bending: [bending(factor), bending(0.8 * factor)],
    };
    MemberCapacity {
        follows_axial: member.contains("column"),
        member,
        compression_at_rest: at_rest,
        axial_failure_drift: CapacityLine::new(vec![[0.0, 0.05], [1e6, 0.03]]),
        rotations: [RotationMeasure::Plastic, RotationMeasure::Chord]
            .map(|measure| RotationLimits {
                rule: "limits",
                measure,
                limits: vec![("low", 1e-3), ("high", 0.5)],
            })
            .to_vec(),
        rules: vec![rule("first", 1.0), rule("second", 2.0)],
    }
}

/// Capacities of all columns and beams of a building.
pub(crate) fn capacities(name: &str, storeys: usize) -> Vec<MemberCapacity> {
    let mut all = Vec::new();
    for storey in 1..=storeys {
        for line in 1..=3 {
            let carried = 9e4 * (storeys + 1 - storey) as f64;
            all.push(capacity(format!("{name}.column.{line}.{storey}"), carried));
        }
        for span in 1..=2 {
            all.push(capacity(format!("{name}.beam.{storey}.{span}"), 0.0));
        }
    }
    all
}

pub(crate) fn model() -> Model {
    let left = building("A", 3, 3.2, 1.5e8);
    let right = building("B", 2, 4.5, 4e8);
    let mut members = MemberRequest::all();
    members.capacities.extend(capacities("A", 3));
    members.capacities.extend(capacities("B", 2));
    members.histories = members
        .capacities
        .iter()
        .map(|c| c.member.clone())
        .collect();
    Model {
        title: "Floors against columns".to_owned(),
        buildings: vec![left, right],
        gaps: vec![Gap {
            floors: FloorPairs::Listed(vec![
                [Level::Height(4.5), Level::Floor(1)],
                [Level::Height(7.7), Level::Floor(2)],
            ]),
            ..Gap::after(
                0,
                0.005,
                ContactLaw {
                    kind: LawKind::HertzDamp,
                    stiffness: 2e9,
                    restitution: 0.65,
                    restitution_is: RestitutionIs::Realised,
                },
            )
        }],
        analysis: Analysis {
            members,
            ..Analysis::default()
        },
        ..Model::default()
    }
}

pub(crate) fn run(model: &Model, solver: Solver) -> (System, Outcome, Summary) {
    run_until(model, solver, 2.0)
}

pub(crate) fn run_until(model: &Model, solver: Solver, until: f64) -> (System, Outcome, Summary) {
    let system = System::assemble(model).expect("sound");
    let wave = (0..=200).map(|i| {
        let t = 0.01 * f64::from(i);
        4.0 * (7.0 * t).sin() + 2.0 * (23.0 * t).cos()
    });
    let mut motion = GroundMotion::sampled("two sines", 0.01, wave.collect());
    motion.duration = until;
    let analysis = Analysis {
        solver: Some(solver),
        ..model.analysis.clone()
    };
    let plan = Plan::choose(&system, &motion, &analysis).expect("planned");
    let settings = Settings {
        record_interval: Some(0.0),
        ..Settings::default()
    };
    let outcome = simulate(&system, &motion, &plan, settings, |_| {
        ControlFlow::Continue(())
    });
    assert_eq!(outcome.end, RunEnd::Completed);
    let summary = Summary::new(&jostle::Run {
        model,
        system: &system,
        motion: &motion,
        plan: &plan,
        outcome: &outcome,
        without_contact: None,
        wall: 0.0,
    });
    (system, outcome, summary)
}
