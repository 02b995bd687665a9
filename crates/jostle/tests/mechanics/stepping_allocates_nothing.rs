//! Once under way a run takes no memory: a longer one allocates no more often than a shorter one.

use std::ops::ControlFlow;

use jostle::hysteresis::{Backbone, ConcreteFall, Corners, Hysteresis, HysteresisRule};
use jostle::{
    Building, ColumnFibres, Damping, Fibre, FibreLimit, FibreMaterial, FloorPairs, Gap, Gravity,
    GroundMotion, Isolation, Isolator, LawKind, Level, Link, LinkLaw, Model, Plan, Pounding,
    Settings, Solver, SpaceFrame, SpaceMember, SpacePlace, SpaceSection, SpeedFriction, Stop,
    Structure, System, Tier, Tiers, Wall, simulate,
};
use jostle_testkit::models::{CONCRETE, equal_storeys};

fn towers() -> Model {
    let tower = |name: &str, mass: f64, stiffness: f64| Building {
        name: name.into(),
        structure: Structure::Shear(equal_storeys(4, [mass, stiffness])),
        damping: Damping::ratio(0.05, [1, 2]),
        ..Building::default()
    };
    Model {
        title: "towers".into(),
        buildings: vec![tower("soft", 4e4, 2e7), tower("stiff", 6e4, 9e7)],
        gaps: vec![Gap::after(0, 0.03, CONCRETE)],
        ..Model::default()
    }
}

fn shaking(duration: f64) -> GroundMotion {
    let points = (duration / 0.02) as u32;
    let a = (0..=points).map(|i| 2.0 * (0.02 * f64::from(i) * 7.0).sin());
    GroundMotion::sampled("shaking", 0.02, a.collect())
}

#[test]
fn a_longer_run_allocates_no_more_often() {
    let mut model = towers();
    for solver in [Solver::Riccati, Solver::Modal] {
        model.analysis.solver = Some(solver);
        never_more_often(&model);
    }
}

/// The momentum law changes velocities at once; links act in every step; a wall stands on the left.
#[test]
fn blows_and_links_allocate_nothing_either() {
    let mut model = towers();
    model.gaps[0].law.kind = LawKind::Restitution;
    model.gaps[0].law.stiffness = 1e9;
    model
        .gaps
        .push(Gap::between([None, Some(0)], 0.04, model.gaps[0].law));
    model.links = vec![Link {
        between: [Some(0), Some(1)],
        floors: FloorPairs::listed(&[(2, 2)]),
        level_tolerance: 1e-3,
        stiffness: 1e6,
        damping: 5e4,
        law: LinkLaw::Linear,
        ..Link::default()
    }];
    never_more_often(&model);
}

/// Links of all laws, bearings of both kinds that yield, stops, and a wall that gives way.
#[test]
fn links_that_are_not_linear_bearings_and_walls_allocate_nothing_either() {
    let mut model = towers();
    let yielding = {
        let corners = Corners::bilinear(6e4, 0.05);
        let backbone = Backbone::from_forces(3e7, corners, corners).expect("sound");
        Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("it fits")
    };
    let friction = LinkLaw::Friction {
        slip_force: 4e4,
        stick_stiffness: 4e7,
    };
    let link = |law, stiffness, damping| Link {
        between: [Some(0), Some(1)],
        floors: FloorPairs::listed(&[(2, 2)]),
        level_tolerance: 1e-3,
        stiffness,
        damping,
        law,
        ..Link::default()
    };
    model.links = vec![
        link(LinkLaw::Viscous { exponent: 0.4 }, 0.0, 2e4),
        link(LinkLaw::Viscous { exponent: 0.35 }, 5e7, 2e4),
        link(LinkLaw::Maxwell, 1e7, 3e5),
        link(friction, 0.0, 0.0),
        link(LinkLaw::Yielding(yielding), 0.0, 0.0),
        link(LinkLaw::Cable { slack: 0.01 }, 1e7, 0.0),
        link(LinkLaw::Stopper { gap: 0.008 }, 2e7, 4e4),
    ];
    let stops = Stop {
        at: 0.03,
        stiffness: 2e7,
    };
    let lead = Isolator::LeadRubber {
        stiffness: 3e7,
        yield_force: 1e5,
        post_yield: 0.1,
    };
    let pendulum = Isolator::Pendulum {
        radius: 1.5,
        friction: SpeedFriction {
            slow: 0.02,
            fast: 0.05,
            rate: 40.0,
        },
        slip_displacement: 1e-3,
    };
    for (building, isolator) in model.buildings.iter_mut().zip([lead, pendulum]) {
        building.base.isolation = Some(Isolation {
            stops: [Some(stops); 2],
            ..Isolation::new(isolator, 6e4)
        });
    }
    model.walls.push(Wall {
        name: "moat".into(),
        stiffness: Some(1e8),
        damping: 1e6,
        mass: 2e4,
        line: None,
    });
    let mut moat = Gap::between([Some(2), Some(0)], 0.015, model.gaps[0].law);
    moat.floors = FloorPairs::Listed(vec![[Level::Wall, Level::Floor(0)]]);
    model.gaps.push(moat);
    never_more_often(&model);
}

/// A column made of fibres that bends about both axes; their rows have more terms than a row holds by itself.
#[test]
fn fibres_in_space_allocate_nothing_either() {
    let length = 0.3;
    let fall = ConcreteFall {
        residual: 0.2,
        ultimate: 3.0,
    };
    let concrete = Hysteresis::concrete(25e6 * 0.16 / 9.0, 0.002 * length, fall).expect("sound");
    let corners = Corners::bilinear(200e3, 0.01);
    let backbone = Backbone::from_forces(3e8, corners, corners).expect("sound");
    let bar = Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("it fits");
    let places = [-0.13, 0.0, 0.13];
    let parts = places.iter().flat_map(|x| places.map(|y| [*x, y]));
    let parts = parts.map(|at| Fibre {
        at,
        spring: concrete,
        material: FibreMaterial::Cover,
    });
    let corners = [-0.16, 0.16];
    let bars = corners.iter().flat_map(|x| corners.map(|y| [*x, y]));
    let bars = bars.map(|at| Fibre {
        at,
        spring: bar,
        material: FibreMaterial::Bar,
    });
    let fibres = ColumnFibres {
        length,
        at_ends: [true, true],
        fibres: parts.chain(bars).collect(),
        limits: [(FibreLimit::Spalling, 1e-3), (FibreLimit::Fracture, 0.05)].into(),
    };
    let column = SpaceSection::rectangle([0.4, 0.4], 30e9, 0.2, false).expect("a section");
    let beam = SpaceSection::beam([0.3, 0.5], 30e9, 0.2, false).expect("a section");
    let columns = [0, 1].map(|x| SpacePlace::Column {
        line: [x, 0],
        storey: 0,
    });
    let between = SpacePlace::BeamX {
        span: 0,
        line: 0,
        floor: 0,
    };
    let members = columns.map(|place| SpaceMember::elastic(place, column));
    let members = members
        .into_iter()
        .chain([SpaceMember::elastic(between, beam)]);
    let plan = vec![[-1.0, -2.0], [6.0, -2.0], [6.0, 2.0], [-1.0, 2.0]];
    let tiers = Tiers {
        floors: vec![Tier::uniform(60e3, plan).expect("an area")],
        storey_heights: vec![3.0],
        space_frame: Some(SpaceFrame {
            lines_x: vec![0.0, 5.0],
            lines_y: vec![0.0],
            members: members.collect(),
            fibres: columns.map(|place| (place, fibres.clone())).into(),
            ..SpaceFrame::default()
        }),
        ..Tiers::default()
    };
    let mut model = Model {
        buildings: vec![Building {
            name: "A".into(),
            structure: Structure::Tiers(tiers),
            gravity: Gravity {
                preload: true,
                p_delta: false,
            },
            ..Building::default()
        }],
        ..Model::default()
    };
    model.analysis.step = Some(0.004);
    let system = System::assemble(&model).expect("a valid model");
    let count = |duration| allocations(&model, &system, duration, Pounding::Included).0;
    assert_eq!(count(2.0), count(10.0), "five times the steps");
}

/// How often a run takes memory, and its impacts.
fn allocations(model: &Model, system: &System, duration: f64, pounding: Pounding) -> (u64, usize) {
    let motion = shaking(duration);
    let plan = Plan::choose(system, &motion, &model.analysis).expect("sensible steps");
    let settings = Settings {
        pounding,
        record_interval: None,
        ..Settings::default()
    };
    let mut impacts = 0;
    let taken = allocation_counter::measure(|| {
        let outcome = simulate(system, &motion, &plan, settings, |_| {
            ControlFlow::Continue(())
        });
        impacts = outcome.impacts.len();
    });
    (taken.count_total, impacts)
}

fn never_more_often(model: &Model) {
    let mut model = model.clone();
    // However far it drifts: steps are counted.
    model.analysis.collapse_drift = 1.0;
    if model.analysis.solver != Some(Solver::Modal) {
        // Automatic steps would be refined by further runs, more of them in a longer motion.
        model.analysis.step = Some(0.004);
    }
    let system = System::assemble(&model).expect("a valid model");
    let count =
        |duration: f64, pounding: Pounding| allocations(&model, &system, duration, pounding);
    let (short, _) = count(5.0, Pounding::Excluded);
    let (long, _) = count(50.0, Pounding::Excluded);
    assert_eq!(short, long, "ten times the steps in free vibration");
    // With contact only the list of impacts grows, by doubling; factors of a new step size are made once.
    let (short, few) = count(5.0, Pounding::Included);
    let (long, many) = count(50.0, Pounding::Included);
    assert!(few > 0 && many > 5 * few, "{few} and {many} impacts");
    assert!(
        long <= short + 30,
        "{short} allocations for {few} impacts, {long} for {many}"
    );
}
