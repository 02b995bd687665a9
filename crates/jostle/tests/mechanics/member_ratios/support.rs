//! Two frames whose floors strike columns, capacities that depend on the axial force, and runs.

use jostle::model::{
    CapacityLine, MemberCapacity, RotationLimits, RotationMeasure, RuleCapacity, ShearCapacity,
};
use jostle::{
    Analysis, Building, FloorPairs, Frame, Gap, Level, MemberRequest, Model, Outcome, Section,
    Solver, Structure, Summary, System,
};
use jostle_testkit::models::{self, CONCRETE_REALISED, bending};
use jostle_testkit::motions::two_waves;
use jostle_testkit::runs::run_and_summary;

fn section(rigidity: f64) -> Section {
    Section {
        axial_rigidity: Some(4e9),
        line_mass: 600.0,
        ..bending(rigidity)
    }
}

pub(crate) fn building(name: &str, storeys: usize, first: f64, rigidity: f64) -> Building {
    let mut frame = Frame {
        floor_mass: vec![9000.0; storeys],
        ..models::frame(storeys, &[6.0, 5.0], section(rigidity), section(2.0e8))
    };
    frame.storey_heights[0] = first;
    models::building(name, Structure::Frame(frame))
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
        across: None,
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
            ..Gap::after(0, 0.005, CONCRETE_REALISED)
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
    let mut motion = two_waves(200);
    motion.duration = until;
    let mut model = model.clone();
    model.analysis.solver = Some(solver);
    run_and_summary(&model, &motion)
}
