//! Buildings in space that yield: the plane as their limit, an eccentric storey against an integration of its own, and the site that
//! may be turned.

use std::f64::consts::PI;

use crate::verification::support::{base_shears, largest, spring_forces};
use jostle::history::{Owner, PeaksOf};
use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
use jostle::system::Direction;
use jostle::{
    Analysis, Base, Bearing, Building, Damping, Frame, FrameHinges, Gap, Gravity, GroundMotion,
    Hinges, MemberRequest, Model, Outcome, PlanArea, PlanAxis, PlanFrame, PlanPoint, PlanSpring,
    Section, Solver, Structure, System, Tier, TierStorey, Tiers,
};
use jostle_testkit::models::{CONCRETE, equal_storeys, rectangle};
use jostle_testkit::motions::fading;
use jostle_testkit::runs::{assembled, completed, planned};

/// A shaking without symmetry, 8 s long.
fn shaking(name: &str, rate: f64, scale: f64) -> GroundMotion {
    fading(name, rate, [scale, 3.0], 400)
}

fn spring(rule: HysteresisRule, stiffness: f64, yielding: f64) -> Hysteresis {
    let corners = match rule {
        HysteresisRule::Bilinear => Corners::bilinear(yielding, 0.05),
        _ => Corners {
            cracking: 0.3 * yielding,
            yielding,
            post_cracking: 0.5,
            post_yield: 0.05,
        },
    };
    let backbone = Backbone::from_deformations(stiffness, corners, corners).expect("sound");
    Hysteresis::new(rule, backbone).expect("sound")
}

fn building(name: &str, structure: Structure, hinges: Option<Hinges>) -> Building {
    Building {
        name: name.to_owned(),
        structure,
        damping: Damping::ratio(0.04, []),
        gravity: Gravity {
            preload: false,
            p_delta: true,
        },
        hinges,
        ..Building::default()
    }
}

fn model(buildings: Vec<Building>, gaps: Vec<Gap>) -> Model {
    Model {
        title: "yielding in space".to_owned(),
        buildings,
        gaps,
        analysis: Analysis {
            step: Some(1e-3),
            contact_step: Some(5e-5),
            // However far they drift: two computations are compared.
            collapse_drift: 1.0,
            ..Analysis::default()
        },
        ..Model::default()
    }
}

fn run(model: &Model, motion: &GroundMotion) -> (System, Outcome) {
    let system = assembled(model);
    let plan = planned(&system, motion, &model.analysis);
    assert_eq!(plan.solver, Solver::Riccati);
    let outcome = completed(&system, motion, &plan, Some(0.0));
    (system, outcome)
}

/// Storeys that yield along both directions about their centre of stiffness, and stay elastic in torsion.
fn tiers(
    storeys: usize,
    [mass, stiffness]: [f64; 2],
    plan: &[PlanPoint],
    eccentricity: PlanPoint,
    rule: HysteresisRule,
) -> Tiers {
    let tier = Tier::uniform(mass, plan.to_vec()).expect("an area");
    let sides = [stiffness, 1.3 * stiffness];
    let torsion = TierStorey::torsion_of_even(sides, &PlanArea::new(plan));
    let centre = [
        tier.centre[0] + eccentricity[0],
        tier.centre[1] + eccentricity[1],
    ];
    let springs = (0..storeys).flat_map(|storey| {
        PlanAxis::BOTH.map(|axis| PlanSpring {
            element: None,
            storey,
            at: centre,
            axis,
            hysteresis: spring(rule, sides[axis.index()], [8e-3, 6e-3][axis.index()]),
        })
    });
    Tiers {
        floors: vec![tier; storeys],
        storeys: vec![
            TierStorey {
                stiffness: [0.0, 0.0, torsion],
                centre,
            };
            storeys
        ],
        storey_heights: vec![3.0; storeys],
        yielding: springs.collect(),
        ..Tiers::default()
    }
}

/// Without eccentricity and across no shaking, a building in space is the one in the plane, step by step, along either direction.
#[test]
fn plans_without_eccentricity_yield_as_in_the_plane() {
    let parts = [(5, [150e3, 90e6], 12.0), (3, [110e3, 200e6], 9.0)];
    for rule in [HysteresisRule::Bilinear, HysteresisRule::PeakOriented] {
        let plane: Vec<Building> = parts
            .iter()
            .map(|&(storeys, [mass, stiffness], _)| {
                let shear = equal_storeys(storeys, [mass, stiffness]);
                let spring = spring(rule, stiffness, 8e-3);
                building(
                    "plane",
                    Structure::Shear(shear),
                    Some(Hinges::Storeys(vec![spring; storeys])),
                )
            })
            .collect();
        let mut x = 0.0;
        let space: Vec<Building> = parts
            .iter()
            .map(|&(storeys, properties, width)| {
                let plan = rectangle(x, 0.0, width, 10.0);
                x += width + 0.02;
                let tiers = tiers(storeys, properties, &plan, [0.0; 2], rule);
                building("space", Structure::Tiers(tiers), None)
            })
            .collect();
        let name = |mut list: Vec<Building>| {
            list.iter_mut()
                .zip(["A", "B"])
                .for_each(|(building, name)| building.name = name.to_owned());
            list
        };
        let gap = || vec![Gap::after(0, 0.02, CONCRETE)];
        let motion = shaking("along", 7.0, 1.5);
        let mut flat_model = model(name(plane), gap());
        flat_model.analysis.solver = Some(Solver::Riccati);
        let (_, flat) = run(&flat_model, &motion);
        let (system, deep) = run(&model(name(space), gap()), &motion);
        assert!(flat.energy.hysteretic > 0.0);
        assert!(flat.impacts.len() > 3 || rule != HysteresisRule::Bilinear);
        let close = |a: f64, b: f64, scale: f64, what: &str| {
            assert!((a - b).abs() <= 1e-9 * scale, "{what}: {a} against {b}");
        };
        let most = |of: &dyn Fn(&PeaksOf<'_>) -> f64| {
            let floors = flat.peaks.buildings().flatten();
            floors.map(|floor| of(&floor)).fold(0.0, f64::max)
        };
        for (building, other) in flat.peaks.buildings().zip(deep.peaks.buildings()) {
            for (a, b) in building.iter().zip(&other) {
                let u = most(&|f| f.displacement_max().value);
                close(
                    a.displacement_max().value,
                    b.displacement_max().value,
                    u,
                    "u",
                );
                close(
                    a.storey_drift(),
                    b.storey_drift(),
                    most(&|f| f.storey_drift()),
                    "drift",
                );
                close(
                    a.storey_shear(),
                    b.storey_shear(),
                    most(&|f| f.storey_shear()),
                    "shear",
                );
                let moments = most(&|f| f.overturning_moment());
                close(
                    a.overturning_moment(),
                    b.overturning_moment(),
                    moments,
                    "moment",
                );
            }
        }
        for (a, b) in base_shears(&flat).iter().zip(&base_shears(&deep)) {
            close(*a, *b, *a, "base shear");
        }
        close(
            flat.energy.hysteretic,
            deep.energy.hysteretic,
            flat.energy.hysteretic,
            "hysteretic energy",
        );
        let [left, right] = [&flat, &deep].map(|run| run.peaks.gap_force(0).value);
        close(left, right, left, "force of the gap");
        for floor in deep.peaks.buildings().flatten() {
            for other in [floor.across(), floor.turning()] {
                assert!(other.displacement_max().value.abs() < 1e-12);
            }
        }
        // Springs along x have the loops of the storeys of the plane.
        let (one, other) = (spring_forces(&flat), spring_forces(&deep));
        for (a, b) in one.iter().zip(other.iter().step_by(2)) {
            close(*a, *b, *a, "force");
        }
        let works = |run: &Outcome| {
            let springs = 0..run.state.springs.len();
            let works = springs.map(|spring| run.peaks.work(Owner::Spring(spring)));
            works.collect::<Vec<f64>>()
        };
        let (one, other) = (works(&flat), works(&deep));
        for (a, b) in one.iter().zip(other.iter().step_by(2)) {
            close(*a, *b, largest(&one), "work");
        }
        assert_eq!(system.buildings[0].equations.springs.len(), 10);
    }
}

/// One storey with two elements that yield along x and one along y, none through the centre of mass.
fn eccentric_storey() -> (Model, Vec<([f64; 3], f64, f64)>) {
    let plan = rectangle(0.0, 0.0, 10.0, 8.0);
    let tier = Tier::uniform(200e3, plan).expect("an area");
    let [ox, oy] = tier.centre;
    // Place, direction, stiffness, yield deformation.
    let elements = [
        ([1.0, 1.0], PlanAxis::X, 30e6, 6e-3),
        ([9.0, 7.0], PlanAxis::X, 55e6, 5e-3),
        ([8.0, 2.0], PlanAxis::Y, 60e6, 7e-3),
        ([0.5, 6.0], PlanAxis::Y, 25e6, 4e-3),
    ];
    let yielding = elements
        .iter()
        .enumerate()
        .map(|(index, &(at, axis, stiffness, yielding))| PlanSpring {
            element: Some(index),
            storey: 0,
            at,
            axis,
            hysteresis: spring(HysteresisRule::Bilinear, stiffness, yielding),
        })
        .collect();
    let rows = elements.iter().map(|&([x, y], axis, stiffness, yielding)| {
        let row = match axis {
            PlanAxis::X => [1.0, 0.0, -(y - oy)],
            PlanAxis::Y => [0.0, 1.0, x - ox],
        };
        (row, stiffness, yielding)
    });
    let rows = rows.collect();
    let tiers = Tiers {
        floors: vec![tier],
        storey_heights: vec![3.0],
        yielding,
        element_names: vec![None; 4],
        ..Tiers::default()
    };
    let mut building = building("eccentric", Structure::Tiers(tiers), None);
    building.damping = Damping::Rayleigh {
        alpha: 0.6,
        beta: 0.0,
    };
    building.gravity = Gravity::default();
    let mut model = model(vec![building], Vec::new());
    model.analysis.contact_step = None;
    (model, rows)
}

fn bearing(mut motion: GroundMotion, across: GroundMotion) -> GroundMotion {
    motion.bearing = Some(Box::new(Bearing {
        angle: 0.3,
        across: Some(across),
    }));
    motion
}

/// Runge and Kutta's method on displacements, velocities and the slips of elastic-plastic springs with hardening:
/// F = α k δ + (1 − α) k (δ − p), ṗ = δ̇ where |(1 − α) k (δ − p)| is at its limit and grows. Returns the greatest displacements,
/// and the work done on the springs: what the sliders took, and what is stored at the end.
fn by_runge_kutta(
    rows: &[([f64; 3], f64, f64)],
    masses: [f64; 3],
    alpha: f64,
    motion: &GroundMotion,
    step: f64,
) -> ([f64; 3], f64) {
    const HARDENING: f64 = 0.05;
    type Vector = [f64; 3];
    let count = rows.len();
    let ground = |t: f64| {
        let [x, y, _] = motion.components(t);
        [x, y, 0.0]
    };
    let (mut u, mut v): (Vector, Vector) = ([0.0; 3], [0.0; 3]);
    let mut slips = vec![0.0; count];
    let (mut peaks, mut taken) = ([0.0_f64; 3], 0.0);
    let deformation = |row: &Vector, u: &Vector| (0..3).map(|k| row[k] * u[k]).sum::<f64>();
    // Return mapping of the slip at given displacements, from the slips at the start of the step.
    let slip = |index: usize, u: &Vector, from: f64| {
        let (row, _, limit) = &rows[index];
        let (d, limit) = (deformation(row, u), *limit);
        from + (d - from - limit).max(0.0) + (d - from + limit).min(0.0)
    };
    let acceleration = |t: f64, u: &Vector, v: &Vector, slips: &[f64]| -> Vector {
        let mut force = [0.0; 3];
        for (index, (row, stiffness, _)) in rows.iter().enumerate() {
            let d = deformation(row, u);
            let p = slip(index, u, slips[index]);
            let spring_force = stiffness * (HARDENING * d + (1.0 - HARDENING) * (d - p));
            (0..3).for_each(|k| force[k] += row[k] * spring_force);
        }
        let a = ground(t);
        std::array::from_fn(|k| -force[k] / masses[k] - alpha * v[k] - a[k])
    };
    let steps = (motion.duration / step).round() as usize;
    let add =
        |a: &Vector, b: &Vector, h: f64| -> Vector { std::array::from_fn(|k| a[k] + h * b[k]) };
    for index in 0..steps {
        let t = index as f64 * step;
        let a1 = acceleration(t, &u, &v, &slips);
        let (u2, v2) = (add(&u, &v, 0.5 * step), add(&v, &a1, 0.5 * step));
        let a2 = acceleration(t + 0.5 * step, &u2, &v2, &slips);
        let (u3, v3) = (add(&u, &v2, 0.5 * step), add(&v, &a2, 0.5 * step));
        let a3 = acceleration(t + 0.5 * step, &u3, &v3, &slips);
        let (u4, v4) = (add(&u, &v3, step), add(&v, &a3, step));
        let a4 = acceleration(t + step, &u4, &v4, &slips);
        let before = slips.clone();
        for k in 0..3 {
            u[k] += step / 6.0 * (v[k] + 2.0 * v2[k] + 2.0 * v3[k] + v4[k]);
            v[k] += step / 6.0 * (a1[k] + 2.0 * a2[k] + 2.0 * a3[k] + a4[k]);
            peaks[k] = peaks[k].max(u[k].abs());
        }
        for (index, plastic_slip) in slips.iter_mut().enumerate() {
            *plastic_slip = slip(index, &u, *plastic_slip);
            let (_, stiffness, limit) = rows[index];
            taken += (1.0 - HARDENING) * stiffness * limit * (*plastic_slip - before[index]).abs();
        }
    }
    for ((row, stiffness, _), slip) in rows.iter().zip(&slips) {
        let d = deformation(row, &u);
        let stored = HARDENING * d * d + (1.0 - HARDENING) * (d - slip).powi(2);
        taken += 0.5 * stiffness * stored;
    }
    (peaks, taken)
}

/// Displacements along x, across and in rotation, and the work on the springs, against an integration with steps of 20 µs.
#[test]
fn an_eccentric_storey_yields_as_integrated_on_its_own() {
    let (mut model, rows) = eccentric_storey();
    let motion = bearing(shaking("along", 9.0, 1.0), shaking("across", 7.5, 0.8));
    let Structure::Tiers(tiers) = &model.buildings[0].structure else {
        unreachable!("it has a plan")
    };
    let floor = &tiers.floors[0];
    let masses = [floor.mass, floor.mass, floor.polar_mass];
    let (expected, taken) = by_runge_kutta(&rows, masses, 0.6, &motion, 2e-5);
    model.analysis.step = Some(5e-5);
    let (_, outcome) = run(&model, &motion);
    let floor = outcome.peaks.floor(0, 1);
    let found =
        [floor, floor.across(), floor.turning()].map(|direction| direction.displacement().size());
    assert!(expected[2] > 1e-3 && taken > 1e4, "{expected:?}, {taken} J");
    for (size, expected) in found.iter().zip(expected) {
        assert!(
            (size / expected - 1.0).abs() < 2e-5,
            "{size} against {expected}"
        );
    }
    let springs = 0..outcome.state.springs.len();
    let works = springs.map(|spring| outcome.peaks.work(Owner::Spring(spring)));
    let work: f64 = works.sum();
    assert!((work / taken - 1.0).abs() < 2e-5, "{work} against {taken}");
    assert!(outcome.energy.worst_imbalance < 1e-9);
    // Shears are the sums of the elements, torques those of their moments about the centre of mass.
    let shear = outcome.peaks.base_shear(0);
    let greatest = rows[0].1 * rows[0].2 + rows[1].1 * rows[1].2;
    assert!(shear > greatest && shear < 2.0 * greatest, "{shear}");
}

/// A site turned by a right angle: what yielded along x yields across.
#[test]
fn a_turned_site_yields_the_same() {
    let rule = HysteresisRule::PeakOriented;
    let plans = [
        rectangle(0.0, 0.0, 12.0, 10.0),
        rectangle(12.015, 2.0, 9.0, 7.0),
    ];
    let buildings = |turned: bool| -> Vec<Building> {
        let parts = [
            (3, [150e3, 60e6], [1.0, -0.5]),
            (2, [100e3, 150e6], [-0.4, 0.3]),
        ];
        let list = parts.iter().zip(&plans).zip(["A", "B"]);
        list.map(|((&(storeys, properties, eccentricity), plan), name)| {
            let mut tiers = tiers(storeys, properties, plan, eccentricity, rule);
            if turned {
                let turn = |p: &mut PlanPoint| *p = [-p[1], p[0]];
                for floor in &mut tiers.floors {
                    turn(&mut floor.centre);
                    floor.plan.iter_mut().for_each(turn);
                }
                for storey in &mut tiers.storeys {
                    turn(&mut storey.centre);
                }
                for spring in &mut tiers.yielding {
                    turn(&mut spring.at);
                    spring.axis = match spring.axis {
                        PlanAxis::X => PlanAxis::Y,
                        PlanAxis::Y => PlanAxis::X,
                    };
                }
            }
            let mut building = building(name, Structure::Tiers(tiers), None);
            building.damping = Damping::Rayleigh {
                alpha: 0.5,
                beta: 2e-3,
            };
            building
        })
        .collect()
    };
    let gap = || vec![Gap::between([Some(0), Some(1)], 0.015, CONCRETE)];
    let motion = bearing(shaking("along", 7.0, 1.5), shaking("across", 5.3, 1.2));
    let mut turned_motion = motion.clone();
    turned_motion.bearing.as_mut().expect("a bearing").angle += 0.5 * PI;
    let (_, one) = run(&model(buildings(false), gap()), &motion);
    let (_, other) = run(&model(buildings(true), gap()), &turned_motion);
    assert!(one.impacts.len() > 10 && one.energy.hysteretic > 1e4);
    assert_eq!(one.impacts.len(), other.impacts.len());
    assert!(
        one.energy.worst_imbalance < 1e-4,
        "{}",
        one.energy.worst_imbalance
    );
    let floors = |run: &Outcome, direction: Direction| -> Vec<[f64; 3]> {
        let all = run.peaks.buildings().flatten();
        let of = |peaks: PeaksOf<'_>| {
            let turned = peaks.turning().displacement_max().value;
            let shear = peaks.to(direction).storey_shear();
            [turned, peaks.corner_displacement(), shear]
        };
        all.map(of).collect()
    };
    let pairs = floors(&one, Direction::Along)
        .into_iter()
        .zip(floors(&other, Direction::Across));
    for (a, b) in pairs.flat_map(|(a, b)| a.into_iter().zip(b)) {
        assert!((a - b).abs() < 1e-8 * a.abs(), "{a} against {b}");
    }
}

/// Elements through one point hold no rotation.
#[test]
fn elements_through_one_point_are_refused() {
    let (mut model, _) = eccentric_storey();
    let Structure::Tiers(tiers) = &mut model.buildings[0].structure else {
        unreachable!("it has a plan")
    };
    for spring in &mut tiers.yielding {
        spring.at = [4.0, 4.0];
    }
    let faults = System::assemble(&model).expect_err("it turns freely");
    assert!(faults[0].path.ends_with("torsion"), "{faults:?}");
    let Structure::Tiers(tiers) = &mut model.buildings[0].structure else {
        unreachable!("it has a plan")
    };
    tiers.yielding[0].storey = 3;
    let faults = System::assemble(&model).expect_err("no such storey");
    assert!(faults[0].path.contains("yielding[0]"), "{faults:?}");
}

/// A frame of two bays and three storeys whose columns and beams yield, with masses at its floors or none.
fn frame(floor_mass: f64) -> (Frame, FrameHinges) {
    let section = |rigidity: f64| Section {
        flexural_rigidity: rigidity,
        axial_rigidity: None,
        shear_rigidity: None,
        line_mass: 0.0,
    };
    let hinge = |rigidity: f64, length: f64, yielding: f64| {
        let corners = Corners {
            cracking: 0.3 * yielding,
            yielding,
            post_cracking: 0.3,
            post_yield: 0.02,
        };
        let backbone = Backbone::from_forces(100.0 * rigidity / length, corners, corners);
        Hysteresis::new(HysteresisRule::PeakOriented, backbone.expect("sound")).expect("sound")
    };
    let (columns, beams) = (150e6, 90e6);
    let frame = Frame {
        storey_heights: vec![3.2; 3],
        spans: vec![6.0, 5.0],
        columns: vec![section(columns); 3],
        beams: vec![section(beams); 3],
        beam_mass: vec![0.0; 3],
        floor_mass: vec![floor_mass; 3],
        column_segments: 1,
        beam_segments: vec![1, 1],
        ..Frame::default()
    };
    let hinges = FrameHinges {
        columns: vec![vec![hinge(columns, 3.2, 500e3); 3]; 3],
        beams: vec![vec![hinge(beams, 6.0, 250e3), hinge(beams, 5.0, 250e3)]; 3],
        ..FrameHinges::default()
    };
    (frame, hinges)
}

/// Two equal frames at either side of a plan carry half of it each, as one plane frame does, hinge by hinge.
#[test]
fn two_equal_frames_in_plan_yield_as_one_in_the_plane() {
    let (heavy, hinges) = frame(80e3);
    let mut plane = building(
        "frame",
        Structure::Frame(heavy),
        Some(Hinges::Frame(hinges)),
    );
    plane.gravity = Gravity::default();
    let (light, hinges) = frame(0.0);
    let standing =
        |name: &str, at: PlanPoint, direction: PlanPoint, hinges: FrameHinges| PlanFrame {
            name: name.to_owned(),
            at,
            direction,
            lines: Vec::new(),
            base: Base::default(),
            hinges,
            frame: light.clone(),
        };
    let across = FrameHinges::default;
    let tier = Tier::uniform(160e3, rectangle(0.0, 0.0, 11.0, 11.0)).expect("an area");
    let tiers = Tiers {
        floors: vec![tier; 3],
        storey_heights: vec![3.2; 3],
        frames: vec![
            standing("1", [0.0, 1.0], [1.0, 0.0], hinges.clone()),
            standing("2", [0.0, 10.0], [1.0, 0.0], hinges),
            standing("A", [0.0, 0.0], [0.0, 1.0], across()),
            standing("C", [11.0, 0.0], [0.0, 1.0], across()),
        ],
        ..Tiers::default()
    };
    let mut space = building("frames", Structure::Tiers(tiers), None);
    space.gravity = Gravity::default();
    let motion = shaking("along", 4.0, 0.8);
    let with = |building: Building| {
        let mut model = model(vec![building], Vec::new());
        model.analysis.contact_step = None;
        model.analysis.solver = Some(Solver::Riccati);
        model.analysis.members = MemberRequest::all();
        model
    };
    let (plane, flat) = run(&with(plane), &motion);
    let (system, deep) = run(&with(space), &motion);
    assert!(flat.energy.hysteretic > 1e3, "{}", flat.energy.hysteretic);
    let same = |a: f64, b: f64, what: &str| {
        assert!((a / b - 1.0).abs() < 1e-9, "{what}: {a} against {b}");
    };
    for (a, b) in flat.peaks.floors(0).iter().zip(&deep.peaks.floors(0)) {
        same(a.displacement_max().value, b.displacement_max().value, "u");
        same(2.0 * a.storey_shear(), b.storey_shear(), "shear");
    }
    let (one, other) = (spring_forces(&flat), spring_forces(&deep));
    assert_eq!(other.len(), 2 * one.len());
    for (building, other) in one.iter().cycle().zip(&other) {
        same(*building, *other, "moment");
    }
    // Members of the first frame have the forces of those of the plane one, moments of hinges included; beams have no axial force.
    let members = system.buildings[0].members.members.iter();
    let members: Vec<_> = members.filter(|member| member.frame == Some(0)).collect();
    let of_plane = &plane.buildings[0].members.members;
    assert_eq!(members.len(), of_plane.len());
    for (member, other) in members.into_iter().zip(of_plane) {
        assert_eq!(member.place, other.place);
        let kinds = if other.place.is_column() { 0..3 } else { 1..3 };
        for (section, of_plane) in member.sections.iter().zip(&other.sections) {
            for kind in kinds.clone() {
                let forces = deep.members[0][section.forms[kind]];
                let expected = flat.members[0][of_plane.forms[kind]];
                for (a, b) in forces.into_iter().zip(expected) {
                    let apart = (a - b).abs();
                    assert!(apart < 1e-9 * 1e6, "{:?}: {a} against {b}", member.place);
                }
            }
        }
    }
    let discretization = &system.buildings[0].discretization;
    let name =
        discretization.spring_places[spring_forces(&flat).len()].named(&[], &discretization.frames);
    assert!(name.starts_with("frame 2, "), "{name}");
}
