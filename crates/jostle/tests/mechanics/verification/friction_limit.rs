//! Up to which coefficient of friction the forces at a contact of buildings in space are unique.

use jostle::results::friction_warnings;
use jostle::{
    Analysis, Gap, Model, PlanArea, PlanPoint, Solver, Structure, System, Tier, TierStorey, Tiers,
    Wall,
};
use jostle_testkit::models::{CONCRETE, building, rectangle};

/// Sides of the floor \[m\].
const SIDES: [f64; 2] = [24.0, 12.0];

/// A floor of one storey beside a wall along its whole right side.
fn beside_a_wall(polar_share: f64, friction: f64) -> Model {
    let [a, b] = SIDES;
    let plan = rectangle(0.0, 0.0, a, b);
    let mut tier = Tier::uniform(200e3, plan.clone()).expect("an area");
    tier.polar_mass *= polar_share;
    let stiffness = [8e7, 9e7];
    let torsion = TierStorey::torsion_of_even(stiffness, &PlanArea::new(&plan));
    let storey = TierStorey {
        stiffness: [stiffness[0], stiffness[1], torsion],
        centre: tier.centre,
    };
    let structure = Structure::Tiers(Tiers {
        floors: vec![tier],
        storeys: vec![storey],
        storey_heights: vec![3.0],
        ..Tiers::default()
    });
    let mut gap = Gap::between([Some(0), Some(1)], 0.02, CONCRETE);
    gap.in_plan.friction = friction;
    Model {
        title: "friction beside a wall".to_owned(),
        buildings: vec![building("Hall", structure)],
        gaps: vec![gap],
        // Solid on the right of the way upwards.
        walls: vec![Wall {
            name: "boundary".to_owned(),
            stiffness: None,
            damping: 0.0,
            mass: 0.0,
            line: Some([[a + 0.02, -1.0], [a + 0.02, b + 1.0]]),
        }],
        analysis: Analysis {
            solver: Some(Solver::Modal),
            ..Analysis::default()
        },
        ..Model::default()
    }
}

fn least(system: &System) -> f64 {
    let limits = system
        .contacts
        .iter()
        .filter_map(|contact| contact.friction.as_ref());
    limits
        .map(|limit| limit.unique_below)
        .fold(f64::INFINITY, f64::min)
}

/// Acceleration along the normal (1, 0) of a point of a free floor that a force of −1 along it and one along y push there.
fn normal_acceleration(tier: &Tier, at: PlanPoint, along: f64) -> f64 {
    let arm = [at[0] - tier.centre[0], at[1] - tier.centre[1]];
    let force = [-1.0, along];
    let turning = (arm[0] * force[1] - arm[1] * force[0]) / tier.polar_mass;
    force[0] / tier.mass - turning * arm[1]
}

/// Uniform floors: (a² + 4b²)/(3ab) at the ends of the face, at least 4/3 for any rectangle; with the point midway across
/// the gap, which is 10 mm farther from the centre than the face.
#[test]
fn uniform_rectangles_have_the_limit_in_closed_form() {
    let [a, b] = SIDES;
    let system = System::assemble(&beside_a_wall(1.0, 0.4)).expect("sound");
    let expected = (a * a + 4.0 * b * b) / (3.0 * (a + 0.02) * b);
    assert!((least(&system) - expected).abs() < 1e-12 * expected);
    assert!((expected - 4.0 / 3.0).abs() < 2e-3, "{expected}");
    assert!(friction_warnings(&beside_a_wall(1.0, 0.4), &system).is_empty());
}

/// Beyond the limit a push at the contact moves the point of a rigid floor into the wall, so that with the same motion the
/// contact can hold or part: found by bisection on the motion of the floor itself.
#[test]
fn beyond_the_limit_a_pushed_floor_moves_into_the_wall() {
    let share = 0.1;
    let model = beside_a_wall(share, 0.4);
    let system = System::assemble(&model).expect("sound");
    let Structure::Tiers(tiers) = &model.buildings[0].structure else {
        unreachable!("it has a plan")
    };
    let parts = |coefficient: f64| {
        // Points between the middle and the ends have less room than the ends where the mass lies near the centre.
        let mut points = system.contacts.iter().filter_map(|contact| contact.plan);
        points.all(|point| {
            let at = point.at;
            [-coefficient, coefficient]
                .into_iter()
                .all(|along| normal_acceleration(&tiers.floors[0], at, along) < 0.0)
        })
    };
    let (mut low, mut high) = (0.0, 10.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if parts(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    assert!(low < 1.0, "{low}");
    assert!((least(&system) - low).abs() < 1e-9, "{low}");
}

#[test]
fn friction_beyond_the_limit_is_warned_of_with_a_remedy() {
    let share = 0.1;
    let limit = least(&System::assemble(&beside_a_wall(share, 0.4)).expect("sound"));
    for (friction, warned) in [(limit * 0.999, false), (limit, true), (0.9, true)] {
        let model = beside_a_wall(share, friction);
        let system = System::assemble(&model).expect("sound");
        let warnings = friction_warnings(&model, &system);
        assert_eq!(!warnings.is_empty(), warned, "{friction}: {warnings:?}");
        for warning in &warnings {
            for part in ["\"Hall\" and \"boundary\"", "at floor 1", "use friction = "] {
                assert!(warning.contains(part), "{part} is absent from {warning}");
            }
        }
    }
}
