//! Bearings and stops against closed forms, and together with everything else that a building can have.

use jostle::history::{Kind, Owner};
use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule, Side};
use jostle::model::Hinges;
use jostle::structure::{Discretization, Node, Spring, StickModel, Support};
use jostle::system::BuildingSystem;
use jostle::{
    Building, Column, Damping, FloorPairs, Gap, Integrator, Isolation, Isolator, LawKind, Level,
    Link, LinkLaw, Model, Plan, Shear, Solver, SpeedFriction, Stop, Structure, System, Wall,
};
use jostle_testkit::models::UNDAMPED;

use crate::verification::support::{
    assembled, column, difference, frame, framed, largest, law, moving, row, run, run_from,
    shaking, steps, still, tower,
};

/// A mass on a linear bearing between elastic stops.
fn between_stops(mass: f64, stiffness: f64, stop: Stop) -> System {
    let node = |y, mass, support| Node::at(0.0, y).with_mass(mass).held(support);
    let stops = Side::BOTH.map(|side| Spring {
        hysteresis: Hysteresis::stop(stop.stiffness, stop.at, side).ok(),
        ..Spring::elastic([0, 1], 0.0)
    });
    let mut springs = vec![Spring::elastic([0, 1], stiffness)];
    springs.extend(stops);
    let stick_model = StickModel {
        nodes: vec![
            node(0.0, 0.0, Support::Fixed),
            node(3.0, mass, Support::Guided),
        ],
        springs,
        ..StickModel::default()
    };
    let discretization = Discretization {
        stick_model,
        floors: vec![1],
        left_face: vec![1],
        right_face: vec![1],
        ..Discretization::default()
    };
    System::of_buildings(vec![BuildingSystem::new("mass", discretization)])
}

/// Displacement and velocity at `end` of a mass that starts from zero with a speed: free up to a stop, then half a period
/// about the equilibrium of both springs, and back. Greatest displacement.
fn by_pieces(mass: f64, stiffness: f64, stop: Stop, speed: f64, end: f64) -> [f64; 3] {
    let (slow, fast) = (
        (stiffness / mass).sqrt(),
        ((stiffness + stop.stiffness) / mass).sqrt(),
    );
    let amplitude = speed / slow;
    assert!(amplitude > stop.at);
    // Of a quarter of the free motion up to a stop, and the speed there.
    let reaches = (stop.at / amplitude).asin() / slow;
    let arrives = speed * (slow * reaches).cos();
    // With both springs: u = centre + (at − centre) cos + v/ω sin, until it is back at the stop.
    let centre = stop.stiffness * stop.at / (stiffness + stop.stiffness);
    let (a, b) = (stop.at - centre, arrives / fast);
    let radius = a.hypot(b);
    let touches = 2.0 * b.atan2(a) / fast;
    // Halves of the motion are mirror images of each other.
    let half = 2.0 * reaches + touches;
    let mut t = end;
    let mut sign = 1.0;
    while t > half {
        t -= half;
        sign = -sign;
    }
    let [u, v] = if t < reaches {
        [amplitude * (slow * t).sin(), speed * (slow * t).cos()]
    } else if t < reaches + touches {
        let angle = fast * (t - reaches);
        [
            centre + a * angle.cos() + b * angle.sin(),
            fast * (b * angle.cos() - a * angle.sin()),
        ]
    } else {
        let left = half - t;
        [
            amplitude * (slow * left).sin(),
            -speed * (slow * left).cos(),
        ]
    };
    [sign * u, sign * v, centre + radius]
}

/// Nothing is damped: the error is that of the phase, of second order, and of the steps across a touch. Much smaller steps would
/// meet rounding, which grows as 1/h.
#[test]
fn a_mass_between_elastic_stops_moves_by_the_closed_form() {
    let (mass, stiffness) = (6e5, 4e6);
    let stop = Stop {
        at: 0.08,
        stiffness: 1.2e7,
    };
    let (speed, end) = (0.35, 3.0);
    let system = between_stops(mass, stiffness, stop);
    let [u, v, peak] = by_pieces(mass, stiffness, stop, speed, end);
    let error = |step: f64| {
        let start = moving(&system, &[0.0], &[speed]);
        let outcome = run_from(&system, &still(end), &steps(step, 1), start);
        let state = &outcome.state;
        let most = outcome.peaks.floor(0, 1).displacement_max().value;
        let force = outcome
            .peaks
            .owned_by(Owner::Spring(1))
            .of(Kind::Force)
            .size()
            .max(
                outcome
                    .peaks
                    .owned_by(Owner::Spring(0))
                    .of(Kind::Force)
                    .size(),
            );
        let expected = stop.stiffness * (peak - stop.at);
        assert!(
            outcome.energy.worst_imbalance < 1e-8,
            "{:e}",
            outcome.energy.worst_imbalance
        );
        [
            (state.displacement[0] - u).abs() / peak,
            (state.velocity[0] - v).abs() / speed,
            (most / peak - 1.0).abs(),
            (force / expected - 1.0).abs(),
        ]
    };
    let [coarse, fine] = [1.6e-3, 5e-5].map(|step| largest(&error(step)));
    println!("{coarse:e} {fine:e}");
    assert!(coarse < 1e-4 && fine < 1e-7, "{coarse:e} and {fine:e}");
    assert!(fine < 0.005 * coarse, "{coarse:e} and {fine:e}");
}

fn isolation(isolator: Isolator) -> Isolation {
    Isolation::new(isolator, 6e4)
}

fn lead_rubber() -> Isolation {
    isolation(Isolator::LeadRubber {
        stiffness: 3e7,
        yield_force: 1.2e5,
        post_yield: 0.1,
    })
}

fn pendulum() -> Isolation {
    isolation(Isolator::Pendulum {
        radius: 1.5,
        friction: SpeedFriction {
            slow: 0.03,
            fast: 0.07,
            rate: 40.0,
        },
        slip_displacement: 1e-3,
    })
}

fn alone(building: Building) -> Model {
    row(vec![building], 0.0, law(LawKind::Hertz, 1.0))
}

fn undamped(mut building: Building) -> Building {
    building.damping = UNDAMPED;
    building
}

/// Beams that do not bend and columns that keep their length make a frame a shear building, of 12 EI/h³ for each column.
#[test]
fn a_frame_with_rigid_beams_on_bearings_is_a_shear_building_on_them() {
    for bearing in [
        isolation(Isolator::Linear { stiffness: 4e6 }),
        lead_rubber(),
        pendulum(),
    ] {
        let mut frame = frame(3, &[4.0, 5.0]);
        frame.axial = Default::default();
        for beam in &mut frame.beams {
            beam.flexural_rigidity = 1e14;
        }
        for column in &mut frame.columns {
            column.line_mass = 0.0;
        }
        frame.column_segments = 1;
        frame.beam_segments = vec![1; 2];
        let shear = Shear {
            mass: frame
                .beam_mass
                .iter()
                .zip(&frame.floor_mass)
                .map(|(line, floor)| 9.0 * line + floor)
                .collect(),
            stiffness: (0..3)
                .map(|k| {
                    let height = frame.storey_heights[k];
                    3.0 * 12.0 * frame.columns[k].flexural_rigidity / height.powi(3)
                })
                .collect(),
            storey_heights: frame.storey_heights.clone(),
        };
        let mut buildings = [framed("frame", frame.clone()), framed("shear", frame)];
        buildings[1].structure = Structure::Shear(shear);
        let [framed, sheared] = buildings.map(|building| {
            let mut building = undamped(building);
            building.base.isolation = Some(bearing);
            let system = assembled(&alone(building));
            let outcome = run(&system, &shaking(4.0), &steps(1e-3, 1));
            let u = column(&outcome, Column::displacement(0, 0));
            let roof = column(&outcome, Column::displacement(0, 3));
            assert!(
                outcome.energy.worst_imbalance < 1e-8,
                "{:e}",
                outcome.energy.worst_imbalance
            );
            [u, roof]
        });
        for (a, b) in framed.iter().zip(&sheared) {
            let apart = difference(a, b);
            println!("{}: {apart:e}", bearing.isolator.name());
            assert!(apart < 1e-5, "{}: {apart:e}", bearing.isolator.name());
        }
    }
}

/// P-Delta in chord form takes N/h from the stiffness of a storey, N being the weight above; bearings stay as they are.
#[test]
fn p_delta_above_bearings_softens_storeys_by_their_load() {
    for bearing in [
        isolation(Isolator::Linear { stiffness: 4e6 }),
        lead_rubber(),
    ] {
        let (mass, storeys) = (4e4, 4);
        let mut leaning = undamped(tower("leaning", storeys, mass, 0.9));
        leaning.base.isolation = Some(bearing);
        let mut softer = leaning.clone();
        leaning.gravity.p_delta = true;
        let Structure::Shear(shear) = &mut softer.structure else {
            panic!("it is one");
        };
        for k in 0..storeys {
            let above = jostle::model::STANDARD_GRAVITY * mass * (storeys - k) as f64;
            shear.stiffness[k] -= above / shear.storey_heights[k];
        }
        let [a, b] = [leaning, softer].map(|building| {
            let system = assembled(&alone(building));
            run(&system, &shaking(4.0), &steps(1e-3, 1))
        });
        let apart = difference(&a.state.displacement, &b.state.displacement);
        println!("{apart:e}");
        assert!(apart < 1e-9, "{apart:e}");
    }
}

fn yielding_tower(name: &str, mass: f64, period: f64) -> Building {
    let mut building = tower(name, 3, mass, period);
    let Structure::Shear(shear) = &building.structure else {
        panic!("it is one");
    };
    let storeys = shear.stiffness.iter().map(|stiffness| {
        let corners = Corners::bilinear(0.006, 0.05);
        let backbone = Backbone::from_deformations(*stiffness, corners, corners);
        Hysteresis::new(HysteresisRule::Bilinear, backbone.expect("sound")).expect("it fits")
    });
    building.hinges = Some(Hinges::Storeys(storeys.collect()));
    building
}

fn link(floors: &[(usize, usize)], law: LinkLaw, stiffness: f64, damping: f64) -> Link {
    Link {
        between: [Some(0), Some(1)],
        floors: FloorPairs::listed(floors),
        level_tolerance: 1e-3,
        stiffness,
        damping,
        law,
        ..Link::default()
    }
}

/// One link of every law that is not linear.
fn all_laws() -> Vec<Link> {
    let yielding = {
        let corners = Corners::bilinear(6e4, 0.05);
        let backbone = Backbone::from_forces(3e7, corners, corners).expect("sound");
        Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("it fits")
    };
    let friction = LinkLaw::Friction {
        slip_force: 4e4,
        stick_stiffness: 4e7,
    };
    vec![
        link(&[(1, 1)], LinkLaw::Viscous { exponent: 0.4 }, 0.0, 5e4),
        link(&[(2, 2)], LinkLaw::Viscous { exponent: 0.35 }, 5e7, 5e4),
        link(&[(3, 3)], LinkLaw::Maxwell, 1e7, 3e5),
        link(&[(1, 1)], friction, 0.0, 0.0),
        link(&[(2, 2)], LinkLaw::Yielding(yielding), 0.0, 0.0),
        link(&[(3, 3)], LinkLaw::Cable { slack: 0.004 }, 1e7, 0.0),
        link(&[(3, 3)], LinkLaw::Stopper { gap: 0.002 }, 2e7, 4e4),
        Link {
            between: [Some(1), Some(1)],
            ..link(&[(0, 1)], friction, 0.0, 0.0)
        },
    ]
}

/// Two towers that yield and pound, one of them on bearings, joined by links of all laws, beside a wall that gives way.
fn everything(isolation: Option<Isolation>) -> Model {
    let buildings = vec![
        yielding_tower("left", 3e4, 0.4),
        yielding_tower("right", 5e4, 0.7),
    ];
    let mut model = row(buildings, 0.004, law(LawKind::HertzDamp, 0.65));
    model.links = all_laws();
    model.buildings[0].base.isolation = isolation;
    if isolation.is_some() {
        model.walls.push(Wall {
            name: "moat".to_owned(),
            stiffness: Some(1e8),
            damping: 1e6,
            mass: 2e4,
            line: None,
        });
        let mut moat = Gap::between([Some(2), Some(0)], 0.03, law(LawKind::Linear, 1.0));
        moat.floors = FloorPairs::Listed(vec![[Level::Wall, Level::Floor(0)]]);
        model.gaps.push(moat);
    }
    model
}

/// The recursion and the elimination of whole matrices share only the elements; energy is kept; halving steps converges.
#[test]
fn links_of_all_laws_work_beside_yielding_buildings_and_bearings() {
    let mut motion = shaking(2.5);
    motion.scale = 1.2;
    for bearing in [None, Some(lead_rubber()), Some(pendulum())] {
        let model = everything(bearing);
        let system = assembled(&model);
        let with = |step: f64, solver: Solver| {
            let plan = Plan {
                solver,
                ..steps(step, 8)
            };
            run(&system, &motion, &plan)
        };
        let riccati = with(1e-3, Solver::Riccati);
        let direct = with(1e-3, Solver::Stiffness);
        assert!(riccati.energy.hysteretic > 1e3);
        assert_eq!(riccati.impacts.len(), direct.impacts.len());
        let is_force = |column: Column| column.owner.name() == "link" && column.kind == Kind::Force;
        for (link, force) in riccati.peaks.sizes(is_force).iter().enumerate() {
            assert!(*force > 1e3, "link {link} does nothing");
        }
        let apart = difference(&riccati.state.displacement, &direct.state.displacement);
        println!(
            "{apart:e} {:e} {}",
            riccati.energy.worst_imbalance,
            riccati.impacts.len()
        );
        assert!(apart < 1e-6, "{apart:e}");
        assert!(
            riccati.energy.worst_imbalance < 1e-6,
            "{:e}",
            riccati.energy.worst_imbalance
        );
        let finest = with(1.25e-4, Solver::Riccati);
        let peaks = |outcome: &jostle::Outcome| {
            let floors = outcome.peaks.buildings().flatten();
            floors
                .map(|f| f.displacement_max().value)
                .collect::<Vec<_>>()
        };
        let all = riccati.impacts.len();
        assert!(all > 2, "{all}");
        let errors = [2e-3, 1e-3, 2.5e-4]
            .map(|step| difference(&peaks(&with(step, Solver::Riccati)), &peaks(&finest)));
        println!("{errors:?}");
        assert!(
            errors[2] < 0.2 * errors[0] && errors[2] < 1e-3,
            "{errors:?}"
        );
    }
}

/// HHT dissipates in high modes, by less with smaller steps: it approaches the usual rule.
#[test]
fn hht_runs_with_links_and_bearings_approach_those_of_the_usual_rule() {
    for bearing in [None, Some(lead_rubber())] {
        let mut model = everything(bearing);
        model.gaps.clear();
        model.walls.clear();
        let system = assembled(&model);
        let motion = shaking(3.0);
        let with = |step: f64, integrator: Integrator| {
            let plan = Plan {
                integrator,
                ..steps(step, 1)
            };
            run(&system, &motion, &plan).state.displacement
        };
        let exact = with(1e-4, Integrator::default());
        let errors =
            [2e-3, 1e-3, 5e-4].map(|step| difference(&with(step, Integrator::hht(0.1)), &exact));
        println!("{errors:?}");
        assert!(errors[2] < 0.5 * errors[0], "{errors:?}");
        assert!(errors[2] < 5e-3, "{errors:?}");
    }
}

#[test]
fn very_stiff_bearings_are_a_fixed_base() {
    let mut isolated = tower("isolated", 4, 4e4, 0.6);
    isolated.damping = Damping::Rayleigh {
        alpha: 0.5,
        beta: 1e-3,
    };
    let fixed = isolated.clone();
    isolated.base.isolation = Some(isolation(Isolator::Linear { stiffness: 1e13 }));
    let [a, b] = [isolated, fixed].map(|building| {
        let system = assembled(&alone(building));
        run(&system, &shaking(4.0), &steps(1e-3, 1))
    });
    let roof = |outcome: &jostle::Outcome| column(outcome, Column::displacement(0, 4));
    let apart = difference(&roof(&a), &roof(&b));
    println!("{apart:e}");
    assert!(apart < 1e-5, "{apart:e}");
}
