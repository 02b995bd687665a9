//! Buildings in space: the plane as their limit, and the site that may be turned, mirrored and listed in any order.

use std::f64::consts::PI;

use jostle::history::PeaksOf;
use jostle::{
    Analysis, Bearing, Building, ContactLaw, Damping, Gap, GroundMotion, LawKind, Model, Outcome,
    Plan, PlanArea, PlanContact, PlanPoint, Shear, Solver, Structure, System, Tier, TierStorey,
    Tiers, Wall, Wave,
};
use jostle_testkit::compare::close;
use jostle_testkit::models::{CONCRETE, building, equal_storeys, rectangle};
use jostle_testkit::motions::fading;
use jostle_testkit::runs;

/// A shaking without symmetry, 10 s long.
pub(crate) fn shaking(name: &str, rate: f64) -> GroundMotion {
    fading(name, rate, [1.0, 3.0], 500)
}

pub(crate) fn tower(
    name: &str,
    storeys: usize,
    [mass, stiffness]: [f64; 2],
    plan: &[PlanPoint],
    eccentricity: PlanPoint,
) -> Building {
    let tier = Tier::uniform(mass, plan.to_vec()).expect("an area");
    let area = PlanArea::new(plan);
    let sides = [stiffness, 1.3 * stiffness];
    let storey = TierStorey {
        stiffness: [
            sides[0],
            sides[1],
            TierStorey::torsion_of_even(sides, &area),
        ],
        centre: [
            tier.centre[0] + eccentricity[0],
            tier.centre[1] + eccentricity[1],
        ],
    };
    building(
        name,
        Structure::Tiers(Tiers {
            floors: vec![tier; storeys],
            storeys: vec![storey; storeys],
            storey_heights: vec![3.0; storeys],
            ..Tiers::default()
        }),
    )
}

pub(crate) fn model(buildings: Vec<Building>, gaps: Vec<Gap>) -> Model {
    Model {
        title: "space".to_owned(),
        buildings,
        gaps,
        analysis: Analysis {
            solver: Some(Solver::Modal),
            ..Analysis::default()
        },
        ..Model::default()
    }
}

pub(crate) fn run(model: &Model, motion: &GroundMotion) -> (System, Outcome) {
    let (system, outcome) = runs::run(model, motion, None);
    assert!(outcome.energy.worst_imbalance < 1e-10);
    (system, outcome)
}

#[test]
fn plans_without_eccentricity_keep_the_numbers_of_the_plane() {
    compare_with_the_plane(CONCRETE, &shaking("along", 7.0));
}

/// All points of a face that hits flat are struck at once, so it does not turn.
#[test]
fn faces_rebound_by_the_momentum_law_as_in_the_plane() {
    let law = ContactLaw {
        kind: LawKind::Restitution,
        ..CONCRETE
    };
    compare_with_the_plane(law, &shaking("along", 7.0));
}

/// Without eccentricity and across no shaking, everything is as in one plane, and nothing moves across or turns.
pub(crate) fn compare_with_the_plane(law: ContactLaw, motion: &GroundMotion) {
    let [left, right] = [[150e3, 90e6], [110e3, 200e6]];
    let shear =
        |storeys: usize, properties: [f64; 2]| Structure::Shear(equal_storeys(storeys, properties));
    let plane = model(
        vec![
            building("A", shear(5, left)),
            building("B", shear(3, right)),
        ],
        vec![Gap::after(0, 0.02, law)],
    );
    let space = model(
        vec![
            tower("A", 5, left, &rectangle(0.0, 0.0, 12.0, 10.0), [0.0; 2]),
            tower("B", 3, right, &rectangle(12.02, 0.0, 9.0, 10.0), [0.0; 2]),
        ],
        vec![Gap::after(0, 0.02, law)],
    );
    let (_, flat) = run(&plane, motion);
    let (system, outcome) = run(&space, motion);
    let [ground, other] = [&outcome, &flat].map(|run| run.energy.ground);
    close(ground, other, other.abs().max(1.0), 1e-9, "work of grounds");
    assert!(flat.impacts.len() > 4, "{} impacts", flat.impacts.len());
    for (index, (building, other)) in outcome
        .peaks
        .buildings()
        .zip(flat.peaks.buildings())
        .enumerate()
    {
        let scale = other
            .iter()
            .map(|floor| floor.displacement_max().value)
            .fold(0.0, f64::max);
        for (a, b) in building.iter().zip(&other) {
            let (a_max, b_max) = (a.displacement_max().value, b.displacement_max().value);
            close(a_max, b_max, scale, 1e-9, "right");
            close(
                a.displacement_min().value,
                b.displacement_min().value,
                scale,
                1e-9,
                "left",
            );
            close(
                a.storey_shear(),
                b.storey_shear(),
                b.storey_shear(),
                1e-9,
                "shear",
            );
            close(
                a.total_acceleration(),
                b.total_acceleration(),
                b.total_acceleration(),
                1e-9,
                "acceleration",
            );
        }
        close(
            outcome.peaks.base_shear(index),
            flat.peaks.base_shear(index),
            flat.peaks.base_shear(index),
            1e-9,
            "base shear",
        );
        for floor in building {
            for other in [floor.turning(), floor.across()] {
                assert!(other.displacement_max().value.abs() < 1e-12 * scale);
            }
        }
    }
    // All points of a face together are the contact of the plane.
    let strongest = |peaks: &mut dyn Iterator<Item = f64>| peaks.fold(0.0, f64::max);
    let face = strongest(&mut outcome.face_impacts.iter().map(|i| i.peak_force.value));
    let contact = strongest(&mut flat.impacts.iter().map(|i| i.peak_force));
    close(face, contact, contact, 1e-9, "force");
    let impulse =
        |impacts: &[jostle::Impact]| impacts.iter().map(|impact| impact.impulse).sum::<f64>();
    let [impulse, other] = [&outcome, &flat].map(|run| impulse(&run.impacts));
    close(impulse, other, other, 1e-9, "impulse");
    let instants = |impacts: &[jostle::Impact]| {
        let mut starts: Vec<f64> = impacts.iter().map(|impact| impact.start).collect();
        starts.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
        starts.len()
    };
    assert_eq!(instants(&outcome.impacts), instants(&flat.impacts));
    assert_eq!(outcome.face_impacts.len(), flat.impacts.len());
    assert_eq!(system.contacts.len(), 5 * 3);
}

/// Three eccentric towers around a corner, shaken along a bearing and across it.
pub(crate) fn around_a_corner() -> (Vec<Building>, Vec<Gap>, GroundMotion) {
    let plans = [
        rectangle(0.0, 0.0, 12.0, 10.0),
        rectangle(12.02, 2.0, 9.0, 7.0),
        rectangle(1.0, 10.02, 10.0, 8.0),
    ];
    let buildings = vec![
        tower("corner", 3, [150e3, 60e6], &plans[0], [1.0, -0.5]),
        tower("right", 2, [100e3, 150e6], &plans[1], [-0.4, 0.3]),
        tower("behind", 3, [110e3, 170e6], &plans[2], [0.5, 0.6]),
    ];
    let gap = |a: usize, b: usize| Gap::between([Some(a), Some(b)], 0.02, CONCRETE);
    let mut motion = shaking("along", 7.0);
    motion.bearing = Some(Box::new(Bearing {
        angle: 0.4,
        across: Some(shaking("across", 5.3)),
    }));
    (buildings, vec![gap(0, 1), gap(0, 2)], motion)
}

/// Greatest forces of all faces, in order of size, and the greatest corner displacement of every building.
fn numbers(outcome: &Outcome) -> (Vec<f64>, Vec<f64>) {
    let faces = outcome.face_impacts.iter();
    let mut forces: Vec<f64> = faces.map(|impact| impact.peak_force.value).collect();
    forces.sort_by(f64::total_cmp);
    let corners = outcome.peaks.buildings().map(|floors| {
        let corner_displacement = floors.iter().map(PeaksOf::corner_displacement);
        corner_displacement.fold(0.0, f64::max)
    });
    (forces, corners.collect())
}

pub(crate) fn same(a: &Outcome, b: &Outcome, order: [usize; 3], what: &str) {
    let ((forces, corners), (other_forces, other_corners)) = (numbers(a), numbers(b));
    assert_eq!(forces.len(), other_forces.len(), "{what}: impacts");
    assert!(forces.len() > 10, "{} impacts", forces.len());
    let most = forces[forces.len() - 1];
    for (force, other) in forces.iter().zip(&other_forces) {
        close(*force, *other, most, 1e-8, what);
    }
    for (index, corner) in corners.iter().enumerate() {
        close(*corner, other_corners[order[index]], *corner, 1e-8, what);
    }
}

pub(crate) fn changed(
    buildings: &[Building],
    point: impl Fn(PlanPoint) -> PlanPoint,
    turn_corners: bool,
    stiffness: impl Fn([f64; 3]) -> [f64; 3],
) -> Vec<Building> {
    let mut all = buildings.to_vec();
    for building in &mut all {
        let Structure::Tiers(tiers) = &mut building.structure else {
            unreachable!("all have plans")
        };
        for floor in &mut tiers.floors {
            floor.centre = point(floor.centre);
            floor.plan = floor.plan.iter().map(|p| point(*p)).collect();
            if turn_corners {
                floor.plan.reverse();
            }
        }
        for storey in &mut tiers.storeys {
            storey.centre = point(storey.centre);
            storey.stiffness = stiffness(storey.stiffness);
        }
    }
    all
}

/// The site turned by a right angle with everything on it: along becomes across.
#[test]
fn a_turned_site_has_the_same_impacts() {
    let (mut buildings, gaps, motion) = around_a_corner();
    // Damping counts modes along x, so it is given here.
    for building in &mut buildings {
        building.damping = Damping::Rayleigh {
            alpha: 0.5,
            beta: 2e-3,
        };
    }
    let turned = changed(&buildings, |[x, y]| [-y, x], false, |[x, y, t]| [y, x, t]);
    let mut turned_motion = motion.clone();
    turned_motion.bearing.as_mut().expect("a bearing").angle += 0.5 * PI;
    for friction in [0.0, 0.3] {
        let mut gaps = gaps.clone();
        gaps.iter_mut()
            .for_each(|gap| gap.in_plan.friction = friction);
        let (_, original) = run(&model(buildings.clone(), gaps.clone()), &motion);
        let (_, other) = run(&model(turned.clone(), gaps), &turned_motion);
        same(&original, &other, [0, 1, 2], "turned");
    }
}

/// Everything seen in a mirror along x.
#[test]
fn a_mirrored_site_has_the_same_impacts() {
    let (buildings, gaps, motion) = around_a_corner();
    let (_, original) = run(&model(buildings.clone(), gaps.clone()), &motion);
    let mirrored = changed(&buildings, |[x, y]| [x, -y], true, |k| k);
    let mut mirrored_motion = motion.clone();
    let bearing = mirrored_motion.bearing.as_mut().expect("a bearing");
    bearing.angle = -bearing.angle;
    bearing.across.as_mut().expect("a motion across").scale = -1.0;
    let (_, other) = run(&model(mirrored, gaps), &mirrored_motion);
    same(&original, &other, [0, 1, 2], "mirrored");
}

#[test]
fn the_order_of_buildings_does_not_matter() {
    let (buildings, gaps, motion) = around_a_corner();
    let (_, original) = run(&model(buildings.clone(), gaps.clone()), &motion);
    let shuffled = vec![
        buildings[2].clone(),
        buildings[0].clone(),
        buildings[1].clone(),
    ];
    let gap = |a: usize, b: usize| Gap::between([Some(a), Some(b)], 0.02, CONCRETE);
    // The second named first as well: the normal turns round.
    let (_, other) = run(&model(shuffled, vec![gap(0, 1), gap(1, 2)]), &motion);
    same(&original, &other, [1, 2, 0], "in another order");
}

/// Friction takes energy, is bounded by μ times the contact force, and leaves nothing behind without a coefficient.
#[test]
fn friction_takes_energy_and_vanishes_with_its_coefficient() {
    let (buildings, mut gaps, motion) = around_a_corner();
    for gap in &mut gaps {
        gap.in_plan.friction = 0.3;
    }
    let (_, rough) = run(&model(buildings.clone(), gaps.clone()), &motion);
    assert!(rough.energy.friction > 1.0, "{}", rough.energy.friction);
    assert!(rough.energy.worst_imbalance < 1e-9);
    let works: f64 = rough
        .impacts
        .iter()
        .map(|impact| impact.sliding.friction)
        .sum();
    close(
        works,
        rough.energy.friction,
        works,
        1e-9,
        "work of friction",
    );
    for impact in &rough.impacts {
        let bound = 0.3 * impact.peak_force * (1.0 + 1e-9);
        assert!(impact.sliding.peak_force <= bound, "{impact:?}");
        assert!(impact.sliding.impulse.abs() <= 0.3 * impact.impulse * (1.0 + 1e-6));
        assert!(impact.sliding.friction >= -1e-6 * rough.energy.friction);
    }
    let faces = rough.face_impacts.iter();
    let most = faces
        .map(|face| face.peak_friction.value / face.peak_force.value)
        .fold(0.0, f64::max);
    assert!(most > 0.1 && most <= 0.3 * (1.0 + 1e-9), "{most}");
    let mut finer = model(buildings.clone(), gaps.clone());
    finer.analysis.tolerance = 1e-6;
    let (_, exact) = run(&finer, &motion);
    let accelerations = |outcome: &Outcome| -> Vec<f64> {
        let along = || outcome.peaks.buildings().flatten();
        let across = along().map(PeaksOf::across);
        along()
            .chain(across)
            .map(|floor| floor.total_acceleration())
            .collect()
    };
    let (got, expected) = (accelerations(&rough), accelerations(&exact));
    let most = expected.iter().copied().fold(0.0, f64::max);
    for (got, expected) in got.iter().zip(&expected) {
        close(*got, *expected, most, 1e-3, "acceleration");
    }
    // Hardly any friction is close to none.
    for gap in &mut gaps {
        gap.in_plan.friction = 0.0;
    }
    let (_, smooth) = run(&model(buildings.clone(), gaps.clone()), &motion);
    for gap in &mut gaps {
        gap.in_plan.friction = 1e-9;
    }
    let (_, almost) = run(&model(buildings, gaps), &motion);
    same(&smooth, &almost, [0, 1, 2], "friction of a billionth");
    assert!(rough.impacts.len() != smooth.impacts.len() || rough.impacts != smooth.impacts);
}

/// T = 2π √(m/k_x), 2π √(m/k_y) and 2π √(J/k_θ) without eccentricity.
#[test]
fn torsion_has_the_period_of_its_polar_mass() {
    let plan = rectangle(0.0, 0.0, 10.0, 6.0);
    let tower = tower("A", 1, [1e5, 4e7], &plan, [0.0; 2]);
    let system = System::assemble(&model(vec![tower], Vec::new())).expect("a sound model");
    let mut periods: Vec<f64> = system.buildings[0]
        .modes
        .iter()
        .map(|m| m.period())
        .collect();
    periods.sort_by(f64::total_cmp);
    let polar = 1e5 * (100.0 + 36.0) / 12.0;
    let torsion = 4e7 * 36.0 / 12.0 + 5.2e7 * 100.0 / 12.0;
    let mut expected = [1e5 / 4e7, 1e5 / 5.2e7, polar / torsion].map(|r: f64| 2.0 * PI * r.sqrt());
    expected.sort_by(f64::total_cmp);
    for (got, expected) in periods.iter().zip(expected) {
        close(*got, expected, expected, 1e-12, "period");
    }
}

/// P-Delta takes P/h from both directions and P ρ²/h from torsion.
#[test]
fn weight_softens_all_three_directions() {
    let plan = rectangle(0.0, 0.0, 10.0, 6.0);
    let mut leaning = tower("A", 1, [1e5, 4e7], &plan, [0.0; 2]);
    leaning.gravity.p_delta = true;
    let system =
        System::assemble(&model(vec![leaning.clone()], Vec::new())).expect("a sound model");
    let push = 1e5 * 9.806_65 / 3.0;
    let gyration = (100.0 + 36.0) / 12.0;
    let polar = 1e5 * gyration;
    let torsion = 4e7 * 36.0 / 12.0 + 5.2e7 * 100.0 / 12.0;
    let mut expected = [
        (4e7 - push) / 1e5,
        (5.2e7 - push) / 1e5,
        (torsion - push * gyration) / polar,
    ]
    .map(f64::sqrt);
    expected.sort_by(f64::total_cmp);
    let mut got: Vec<f64> = system.buildings[0]
        .modes
        .iter()
        .map(|mode| mode.circular_frequency)
        .collect();
    got.sort_by(f64::total_cmp);
    for (got, expected) in got.iter().zip(expected) {
        close(*got, expected, expected, 1e-12, "ω");
    }
    // A storey softer than its weight falls over.
    let Structure::Tiers(tiers) = &mut leaning.structure else {
        unreachable!("it has a plan")
    };
    tiers.storeys[0].stiffness = [0.9 * push, 5.2e7, torsion];
    assert!(System::assemble(&model(vec![leaning], Vec::new())).is_err());
}

/// The wave across counts although the first motion is a record.
#[test]
fn a_sine_across_shakes_across() {
    let plan = rectangle(0.0, 0.0, 10.0, 6.0);
    let tower = tower("A", 2, [1e5, 4e7], &plan, [0.0; 2]);
    let mut motion = shaking("along", 7.0);
    motion.bearing = Some(Box::new(Bearing {
        angle: 0.0,
        across: Some(GroundMotion {
            name: "sine".to_owned(),
            scale: 1.0,
            duration: 10.0,
            wave: Wave::Sine {
                amplitude: 1.0,
                period: 0.6,
            },
            bearing: None,
            grounds: None,
        }),
    }));
    let tower_model = model(vec![tower], Vec::new());
    let (_, outcome) = run(&tower_model, &motion);
    // As a building in one plane with the stiffness across.
    let plane = model(
        vec![building(
            "A",
            Structure::Shear(equal_storeys(2, [1e5, 5.2e7])),
        )],
        Vec::new(),
    );
    let mut plane = plane;
    let (system, _) = run(&tower_model, &motion);
    let equations = &system.buildings[0].equations;
    plane.buildings[0].damping = Damping::Rayleigh {
        alpha: equations.alpha,
        beta: equations.beta,
    };
    let across = motion.bearing.as_ref().and_then(|b| b.across.clone());
    let (_, flat) = run(&plane, &across.expect("a motion across"));
    for (a, b) in outcome
        .peaks
        .floors(0)
        .into_iter()
        .map(PeaksOf::across)
        .zip(&flat.peaks.floors(0))
    {
        let scale = b.displacement_max().value;
        close(a.displacement_max().value, scale, scale, 1e-6, "across");
        close(
            a.storey_shear(),
            b.storey_shear(),
            b.storey_shear(),
            1e-6,
            "shear",
        );
    }
}

/// No step could end at the points of both records.
#[test]
fn records_with_steps_that_do_not_fit_are_refused() {
    let (buildings, gaps, mut motion) = around_a_corner();
    let system = System::assemble(&model(buildings, gaps)).expect("a sound model");
    for (step, fits) in [(0.01, true), (0.04, true), (0.03, false), (0.013, false)] {
        let across = GroundMotion::sampled("across", step, vec![0.0, 1.0, 0.5, 0.0]);
        motion.bearing.as_mut().expect("a bearing").across = Some(across);
        let plan = Plan::choose(&system, &motion, &Analysis::default());
        assert_eq!(plan.is_ok(), fits, "{step}");
    }
}

#[test]
fn plans_that_do_not_fit_are_refused() {
    let (buildings, gaps, _) = around_a_corner();
    let said = |buildings: Vec<Building>, gaps: Vec<Gap>| -> String {
        let faults = model(buildings, gaps).check().expect_err("a fault");
        let all: Vec<String> = faults.iter().map(ToString::to_string).collect();
        all.join("\n")
    };
    let mut into = buildings.clone();
    let Structure::Tiers(tiers) = &mut into[1].structure else {
        unreachable!("it has a plan")
    };
    tiers.move_by([-1.0, 0.0]);
    assert!(said(into, gaps.clone()).contains("their plans overlap"));
    // Plans of one size in one place share all sides.
    let mut one_place = buildings.clone();
    one_place[2] = Building {
        name: "twin".into(),
        ..one_place[0].clone()
    };
    assert!(said(one_place, gaps.clone()).contains("their plans overlap"));
    let mut far = gaps.clone();
    far[0].in_plan = PlanContact {
        reach: 0.01,
        ..PlanContact::default()
    };
    assert!(said(buildings.clone(), far).contains("finds no edges"));
    let mut wall = gaps.clone();
    wall[0].between = [Some(0), None];
    assert!(said(buildings.clone(), wall).contains("names a wall"));
    let on_site = |from: PlanPoint, to: PlanPoint| -> String {
        let mut model = model(
            buildings.clone(),
            vec![Gap::between([Some(2), Some(3)], 0.02, CONCRETE)],
        );
        model.walls = vec![super::space::wall("moat", from, to)];
        match model.check() {
            Ok(()) => String::new(),
            Err(faults) => faults.iter().map(ToString::to_string).collect(),
        }
    };
    let (left, right) = ([1.0, 18.04], [11.0, 18.04]);
    assert_eq!(on_site(right, left), "");
    assert!(
        on_site(left, right).contains("inside of the wall"),
        "{}",
        on_site(left, right)
    );
    assert!(on_site(left, left).contains("must be another point"));
    assert!(on_site([0.0, 30.0], [-9.0, 30.0]).contains("finds no edges of"));
    let mut mixed = buildings.clone();
    mixed[1].structure = Structure::Shear(Shear {
        mass: vec![1e5],
        stiffness: vec![1e8],
        storey_heights: vec![3.0],
    });
    assert!(said(mixed, gaps).contains("building[1].plan"));
}

fn wall(name: &str, from: PlanPoint, to: PlanPoint) -> Wall {
    Wall {
        name: name.to_owned(),
        stiffness: None,
        damping: 0.0,
        mass: 0.0,
        line: Some([from, to]),
    }
}

/// A wall across the row is the wall of the plane.
#[test]
fn a_wall_on_the_site_is_that_of_the_plane() {
    let properties = [150e3, 90e6];
    let mut plane = model(
        vec![building(
            "A",
            Structure::Shear(equal_storeys(4, properties)),
        )],
        Vec::new(),
    );
    plane.gaps = vec![Gap::between([Some(0), None], 0.02, CONCRETE)];
    let mut space = model(
        vec![tower(
            "A",
            4,
            properties,
            &rectangle(0.0, 0.0, 12.0, 10.0),
            [0.0; 2],
        )],
        vec![Gap::between([Some(0), Some(1)], 0.02, CONCRETE)],
    );
    // Solid on the right of the way upwards.
    space.walls = vec![wall("boundary", [12.02, -1.0], [12.02, 11.0])];
    let motion = shaking("along", 7.0);
    let (_, flat) = run(&plane, &motion);
    let (system, outcome) = run(&space, &motion);
    assert!(flat.impacts.len() > 4, "{} impacts", flat.impacts.len());
    assert_eq!(outcome.face_impacts.len(), flat.impacts.len());
    assert_eq!(system.contacts.len(), 4 * 5);
    let strongest = |peaks: &mut dyn Iterator<Item = f64>| peaks.fold(0.0, f64::max);
    let face = strongest(&mut outcome.face_impacts.iter().map(|i| i.peak_force.value));
    let contact = strongest(&mut flat.impacts.iter().map(|i| i.peak_force));
    close(face, contact, contact, 1e-9, "force");
    for (a, b) in outcome.peaks.floors(0).iter().zip(&flat.peaks.floors(0)) {
        let scale = b.displacement_max().value - b.displacement_min().value;
        close(
            a.displacement_max().value,
            b.displacement_max().value,
            scale,
            1e-9,
            "right",
        );
        close(
            a.displacement_min().value,
            b.displacement_min().value,
            scale,
            1e-9,
            "left",
        );
    }
}

/// Walls on two sides of a square building that is shaken along the diagonal: the same impacts on both. A wall is a neighbour that
/// does not move, whichever of both is named first.
#[test]
fn walls_around_a_corner_are_neighbours_that_stand_still() {
    let square = rectangle(0.0, 0.0, 10.0, 10.0);
    let mut building = tower("A", 3, [120e3, 70e6], &square, [0.0; 2]);
    if let Structure::Tiers(tiers) = &mut building.structure {
        for storey in &mut tiers.storeys {
            storey.stiffness[1] = storey.stiffness[0];
        }
    }
    let mut motion = shaking("diagonal", 7.0);
    motion.bearing = Some(Box::new(Bearing {
        angle: 0.25 * PI,
        across: None,
    }));
    let mut corner = model(
        vec![building.clone()],
        vec![
            Gap::between([Some(0), Some(1)], 0.02, CONCRETE),
            Gap::between([Some(2), Some(0)], 0.02, CONCRETE),
        ],
    );
    corner.walls = vec![
        wall("right", [10.02, 0.0], [10.02, 10.0]),
        wall("behind", [10.0, 10.02], [0.0, 10.02]),
    ];
    let (_, outcome) = run(&corner, &motion);
    assert!(
        outcome.face_impacts.len() > 8,
        "{}",
        outcome.face_impacts.len()
    );
    for (a, b) in outcome
        .peaks
        .floors(0)
        .iter()
        .map(|floor| (floor, floor.across()))
    {
        let scale = a.displacement_max().value;
        close(
            scale,
            b.displacement_max().value,
            scale,
            1e-9,
            "right and behind",
        );
        close(
            a.displacement_min().value,
            b.displacement_min().value,
            scale,
            1e-9,
            "left and before",
        );
    }
    // A neighbour 10⁷ times as heavy and stiff in place of the wall on the right, an eccentric building, and friction.
    let eccentric = tower("A", 3, [120e3, 70e6], &square, [0.8, -0.5]);
    let mut beside = model(
        vec![eccentric.clone()],
        vec![Gap::between([Some(0), Some(1)], 0.02, CONCRETE)],
    );
    beside.gaps[0].in_plan.friction = 0.3;
    beside.gaps[0].in_plan.tangential_stiffness = Some(150e6);
    let mut heavy = beside.clone();
    beside.walls = vec![wall("right", [10.02, 2.0], [10.02, 10.0])];
    let still = rectangle(10.02, 2.0, 9.0, 8.0);
    heavy
        .buildings
        .push(tower("B", 3, [1e13, 1e20], &still, [0.0; 2]));
    let (_, expected) = run(&heavy, &motion);
    let (_, got) = run(&beside, &motion);
    assert!(got.face_impacts.len() > 4, "{}", got.face_impacts.len());
    assert_eq!(got.face_impacts.len(), expected.face_impacts.len());
    for (a, b) in got.face_impacts.iter().zip(&expected.face_impacts) {
        let most = b.peak_force.value;
        close(a.peak_force.value, most, most, 2e-3, "force");
    }
    for (a, b) in got.peaks.floors(0).iter().zip(&expected.peaks.floors(0)) {
        let scale = b.displacement_max().value;
        close(a.displacement_max().value, scale, scale, 1e-3, "right");
    }
}
