//! Weight that cracks hinges.

use jostle::hysteresis::{HysteresisRule, Stage};
use jostle::statics::STANDARD_GRAVITY;
use jostle::stepping::ContactSteps;
use jostle::system::System;
use jostle::{GroundMotion, Plan, Settings, Solver, State, simulate};

use crate::statics::support::{assembled, frame, hinged, trilinear, under};

fn cracked_by_weight() -> System {
    let weak = |rule, strength| Some(trilinear(rule, 3e8, strength));
    let rule = HysteresisRule::Takeda { exponent: 0.4 };
    let building = hinged(
        frame(3, &[4.0, 8.0], 12e3),
        weak(rule, 400e3),
        weak(rule, 600e3),
    );
    System::of_buildings(vec![assembled(&under(building, true, true))])
}

#[test]
fn cracked_hinges_balance_the_weight() {
    let system = cracked_by_weight();
    let building = &system.buildings[0];
    let springs = building.equations.springs.iter();
    let cracked = springs
        .zip(&building.rest.springs)
        .filter(|(spring, memory)| spring.hysteresis.stage(memory) != Stage::Uncracked)
        .count();
    assert!(cracked >= 4, "{cracked} hinges are cracked");
    let equations = &building.equations;
    let mut missing = vec![0.0; equations.len()];
    equations
        .stiffness
        .multiply_add(&building.rest.displacement, &mut missing);
    equations
        .undamped
        .multiply_add(&building.rest.displacement, &mut missing);
    for (spring, memory) in equations.springs.iter().zip(&building.rest.springs) {
        spring.row.push(memory.force(), &mut missing);
        let gap = spring.deformation(&building.rest.displacement) - memory.deformation();
        assert!(gap.abs() < 1e-14, "{gap}");
    }
    for (dof, mass) in equations.vertical_mass.iter().enumerate() {
        missing[dof] += mass * STANDARD_GRAVITY;
        assert!(missing[dof].abs() < 1e-5, "{} N of 1e5 N", missing[dof]);
    }
}

#[test]
fn a_building_with_cracked_hinges_stays_at_rest() {
    let system = cracked_by_weight();
    let motion = GroundMotion::sampled("still", 1.0, vec![0.0; 3]);
    let plan = Plan {
        step: 2e-3,
        contact_steps: ContactSteps::Fixed(1),
        solver: Solver::Riccati,
        integrator: Default::default(),
        vertical: false,
        is_given: true,
        collapse_drift: jostle::model::COLLAPSE_DRIFT,
    };
    let outcome = simulate(&system, &motion, &plan, Settings::default(), |_| {
        std::ops::ControlFlow::Continue(())
    });
    let start = State::at_rest(&system, 0.0);
    let sag = start
        .displacement
        .iter()
        .fold(0.0_f64, |most, u| most.max(u.abs()));
    assert!(sag > 1e-3);
    for (now, before) in outcome.state.displacement.iter().zip(&start.displacement) {
        assert!(
            (now - before).abs() <= 1e-10 * sag,
            "{:e}",
            (now - before) / sag
        );
    }
    assert!(outcome.spring_events.is_empty());
}
