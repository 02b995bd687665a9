//! Walls that give way among buildings with plans, against the wall of one plane, and turned on the site.

use std::f64::consts::PI;

use jostle::history::Owner;
use jostle::{
    Analysis, Bearing, Building, Gap, GroundMotion, Model, Outcome, PlanPoint, Solver, Structure,
    Tier, TierStorey, Tiers, Wall,
};
use jostle_testkit::compare::close;
use jostle_testkit::models::{CONCRETE, FIVE_PERCENT, equal_storeys, rectangle};
use jostle_testkit::motions::fading;
use jostle_testkit::runs;

const STOREYS: usize = 2;
const FLOOR: [f64; 2] = [150e3, 90e6];

fn building(structure: Structure) -> Building {
    Building {
        name: "A".to_owned(),
        structure,
        damping: FIVE_PERCENT,
        ..Building::default()
    }
}

/// A tower whose plan, and wall, are turned about the origin.
fn turned([x, y]: PlanPoint, angle: f64) -> PlanPoint {
    let (sin, cos) = angle.sin_cos();
    [x * cos - y * sin, x * sin + y * cos]
}

fn in_plan(angle: f64) -> Building {
    let plan = rectangle(0.0, 0.0, 12.0, 10.0);
    let plan: Vec<PlanPoint> = plan
        .into_iter()
        .map(|corner| turned(corner, angle))
        .collect();
    let tier = Tier::uniform(FLOOR[0], plan).expect("an area");
    let storey = TierStorey {
        stiffness: [FLOOR[1], FLOOR[1], FLOOR[1] * 60.0],
        centre: tier.centre,
    };
    building(Structure::Tiers(Tiers {
        floors: vec![tier; STOREYS],
        storeys: vec![storey; STOREYS],
        storey_heights: vec![3.0; STOREYS],
        ..Tiers::default()
    }))
}

/// A retaining wall in front of the face to the right.
fn wall(line: Option<[PlanPoint; 2]>) -> Wall {
    Wall {
        name: "moat".to_owned(),
        stiffness: Some(120e6),
        damping: 1.2e6,
        mass: 25e3,
        line,
    }
}

fn model(building: Building, wall: Wall) -> Model {
    let mut gap = Gap::between([Some(0), Some(1)], 0.01, CONCRETE);
    // The wall of the plane has no heights of its own either.
    gap.in_plan.friction = 0.0;
    Model {
        buildings: vec![building],
        walls: vec![wall],
        gaps: vec![gap],
        analysis: Analysis {
            tolerance: 1e-4,
            solver: Some(Solver::Riccati),
            ..Analysis::default()
        },
        ..Model::default()
    }
}

fn run(model: &Model, angle: Option<f64>) -> Outcome {
    let mut motion: GroundMotion = fading("along", 7.0, [2.0, 2.5], 300);
    motion.bearing = angle.map(|angle| {
        Box::new(Bearing {
            angle,
            across: None,
        })
    });
    let (_, outcome) = runs::run(model, &motion, None);
    assert!(outcome.energy.worst_imbalance < 1e-8);
    outcome
}

/// Peak displacement of the wall, what its dashpot took, and that of the roof.
fn numbers(outcome: &Outcome) -> [f64; 3] {
    let peaks = &outcome.peaks;
    let roof = peaks.floors(0)[STOREYS - 1];
    [
        peaks.sway(1, Some(0)),
        peaks.work(Owner::Support(1)),
        roof.displacement_min()
            .value
            .abs()
            .max(roof.displacement_max().value),
    ]
}

#[test]
fn a_wall_gives_way_as_in_one_plane() {
    let plane = model(
        building(Structure::Shear(equal_storeys(STOREYS, FLOOR))),
        wall(None),
    );
    let face = [[12.01, -1.0], [12.01, 11.0]];
    let space = model(in_plan(0.0), wall(Some(face)));
    let (flat, deep) = (run(&plane, None), run(&space, None));
    assert!(flat.impacts.len() > 4, "{}", flat.impacts.len());
    for (a, b) in numbers(&deep).into_iter().zip(numbers(&flat)) {
        assert!(b > 1e-4, "{b}");
        close(a, b, b, 1e-3, "wall and roof");
    }
    let strongest = |peaks: &mut dyn Iterator<Item = f64>| peaks.fold(0.0, f64::max);
    let of_face = strongest(
        &mut deep
            .face_impacts
            .iter()
            .map(|face_impact| face_impact.peak_force.value),
    );
    let of_contact = strongest(&mut flat.impacts.iter().map(|impact| impact.peak_force));
    close(of_face, of_contact, of_contact, 1e-3, "force");
}

/// A site that is turned, shaking included, has the same impacts: the wall moves along its normal, and the ground with it.
#[test]
fn a_wall_moves_along_its_normal() {
    let face = |angle: f64| Some([[12.01, -1.0], [12.01, 11.0]].map(|end| turned(end, angle)));
    let straight = run(&model(in_plan(0.0), wall(face(0.0))), Some(0.0));
    for angle in [0.5 * PI, -0.5 * PI, PI] {
        let other = run(&model(in_plan(angle), wall(face(angle))), Some(angle));
        assert_eq!(other.face_impacts.len(), straight.face_impacts.len());
        let [a, b] = [&other, &straight].map(numbers);
        close(a[0], b[0], b[0], 1e-4, "wall");
        close(a[1], b[1], b[1], 1e-4, "dashpot");
    }
}
