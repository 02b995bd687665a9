//! Drifts in plan are those of vertical lines: rigid rotation of two floors together is none.

use std::ops::ControlFlow;

use jostle::{Column, GroundMotion, Outcome, Plan, Settings, Solver, Structure, System, simulate};
use jostle_testkit::models::rectangle;
use jostle_testkit::runs::assembled;

use crate::verification::space::{model, shaking, tower};

/// A tower with set-backs whose floors have their centres of mass at different places.
fn stepped(stiffness: [f64; 3]) -> jostle::Model {
    let mut building = tower(
        "A",
        3,
        [200e3, 80e6],
        &rectangle(0.0, 0.0, 18.0, 12.0),
        [3.0, 2.0],
    );
    let Structure::Tiers(tiers) = &mut building.structure else {
        panic!("a tower in space has tiers")
    };
    let plans = [
        rectangle(0.0, 0.0, 18.0, 12.0),
        rectangle(0.0, 0.0, 9.0, 8.0),
        rectangle(0.0, 2.0, 5.0, 5.0),
    ];
    for ((floor, plan), mass) in tiers.floors.iter_mut().zip(plans).zip([200e3, 100e3, 30e3]) {
        *floor = jostle::Tier::uniform(mass, plan.to_vec()).expect("an area");
    }
    for (storey, factor) in tiers.storeys.iter_mut().zip(stiffness) {
        storey.stiffness = storey.stiffness.map(|stiffness| factor * stiffness);
    }
    model(vec![building], Vec::new())
}

fn run(model: &jostle::Model, solver: Solver, motion: &GroundMotion) -> (System, Outcome) {
    let system = assembled(model);
    let mut analysis = model.analysis.clone();
    analysis.solver = Some(solver);
    let plan = Plan::choose(&system, motion, &analysis).expect("steps");
    let settings = Settings {
        record_interval: Some(1e-3),
        ..Settings::default()
    };
    let outcome = simulate(&system, motion, &plan, settings, |_| {
        ControlFlow::Continue(())
    });
    (system, outcome)
}

/// A storey a million times stiffer than the one below has no drift on any line, however much both floors turn together.
#[test]
fn floors_that_turn_together_have_no_drift() {
    let motion = shaking("along", 5.0);
    for solver in [Solver::Modal, Solver::Riccati] {
        let (_, outcome) = run(&stepped([1.0, 1e6, 1.0]), solver, &motion);
        let floors = [1, 2].map(|floor| outcome.peaks.floor(0, floor));
        let turned = floors[0].turning().displacement_max().value;
        assert!(turned > 1e-3, "the floors turn by {turned} rad");
        for drifts in [
            floors.map(|floor| floor.storey_drift()),
            floors.map(|floor| floor.across().storey_drift()),
            floors.map(|floor| floor.corner_drift()),
        ] {
            let [flexible, rigid] = drifts;
            assert!(flexible > 1e-3, "{solver:?}: {drifts:?}");
            assert!(rigid < 1e-5 * flexible, "{solver:?}: {drifts:?}");
        }
    }
}

/// Peaks of drifts are those of the motions that a history records, line by line, whichever way the motion is found.
#[test]
fn drifts_are_those_of_recorded_motions() {
    let motion = shaking("along", 5.0);
    let model = stepped([1.0, 0.7, 0.4]);
    let Structure::Tiers(tiers) = &model.buildings[0].structure else {
        panic!("a tower in space has tiers")
    };
    let centres: Vec<[f64; 2]> = tiers.floors.iter().map(|floor| floor.centre).collect();
    for solver in [Solver::Modal, Solver::Riccati] {
        let (_, outcome) = run(&model, solver, &motion);
        let history = outcome.history.as_ref().expect("it was asked for");
        let column = |wanted: Column| history.column(wanted).expect("a column");
        let building = 0;
        for storey in 0..3 {
            let motion_of = |floor: usize| {
                [
                    column(Column::displacement(building, floor)),
                    column(Column::displacement(building, floor).across()),
                    column(Column::displacement(building, floor).turning()),
                ]
            };
            let (above, below) = (
                motion_of(storey + 1),
                (storey > 0).then(|| motion_of(storey)),
            );
            // How far the line through a place of the site moves over the storey, at an instant.
            let drift = |row: usize, at: [f64; 2]| {
                let moved = |floor: &[Vec<f64>; 3], centre: [f64; 2]| {
                    let [x, y, turned] = [0, 1, 2].map(|k| floor[k][row]);
                    [
                        x - turned * (at[1] - centre[1]),
                        y + turned * (at[0] - centre[0]),
                    ]
                };
                let above = moved(&above, centres[storey]);
                let below = below.as_ref();
                let below = below.map_or([0.0; 2], |below| moved(below, centres[storey - 1]));
                [0, 1].map(|axis| (above[axis] - below[axis]) / 3.0)
            };
            let rows = 0..history.len();
            let [mut along, mut across, mut corner] = [0.0_f64; 3];
            for row in rows {
                let [x, y] = drift(row, centres[storey]);
                (along, across) = (along.max(x.abs()), across.max(y.abs()));
                for at in &tiers.floors[storey].plan {
                    let [x, y] = drift(row, *at);
                    corner = corner.max(x.hypot(y));
                }
            }
            let peaks = outcome.peaks.floor(0, storey + 1);
            for (got, known, name) in [
                (peaks.storey_drift(), along, "along"),
                (peaks.across().storey_drift(), across, "across"),
                (peaks.corner_drift(), corner, "corner"),
            ] {
                // Between rows it may be a little more.
                let off = got / known - 1.0;
                assert!(
                    (-1e-9..1e-3).contains(&off),
                    "{solver:?}: storey {storey} {name}: {off:.1e}"
                );
            }
            assert!(corner > 1.02 * along.max(across), "it turns");
        }
    }
}
