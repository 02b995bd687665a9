//! Braces and dampers between floors of one building count in everything that is named for the whole building.

use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
use jostle::pushover::{
    PushDirection, PushEnd, PushEventKind, PushSettings, PushedBuilding, pushover,
};
use jostle::{
    Axial, Column, Damping, FloorPairs, Given, Hinges, LawKind, Link, LinkLaw, Model, Outcome,
    Plan, Shear, Solver, Structure, Summary, System, eigen,
};
use jostle_testkit::models::UNDAMPED;

use crate::verification::support::{
    assembled, column, frame, framed, largest, law, row, run, shaking, tower,
};

/// Braces between these floors of the first building \[N/m, N·s/m\].
fn braces(floors: &[(usize, usize)], stiffness: f64, damping: f64) -> Link {
    Link {
        between: [Some(0); 2],
        floors: FloorPairs::listed(floors),
        level_tolerance: 1e-3,
        stiffness,
        damping,
        law: LinkLaw::Linear,
        ..Link::default()
    }
}

const STOREYS: [(usize, usize); 4] = [(0, 1), (1, 2), (2, 3), (3, 4)];

/// A tower of four storeys of 40 MN/m, with links.
fn alone(damping: Damping, links: Vec<Link>) -> Model {
    let mut model = row(
        vec![tower("a", 4, 1e5, 0.9)],
        0.0,
        law(LawKind::Linear, 1.0),
    );
    model.gaps.clear();
    let Structure::Shear(shear) = &mut model.buildings[0].structure else {
        panic!("a tower is a shear building")
    };
    shear.stiffness = vec![4e7; 4];
    model.buildings[0].damping = damping;
    model.links = links;
    model
}

fn outcome(model: &Model, solver: Solver, tolerance: f64) -> (System, Outcome) {
    let system = assembled(model);
    let mut model = model.clone();
    model.analysis.solver = Some(solver);
    model.analysis.tolerance = tolerance;
    let motion = shaking(5.0);
    let plan = Plan::choose(&system, &motion, &model.analysis).expect("steps");
    let outcome = run(&system, &motion, &plan);
    (system, outcome)
}

fn summary(model: &Model, solver: Solver, tolerance: f64) -> Summary {
    let (system, outcome) = outcome(model, solver, tolerance);
    let motion = shaking(5.0);
    let plan = Plan::choose(&system, &motion, &model.analysis).expect("steps");
    Summary::new(&jostle::Run {
        model,
        system: &system,
        motion: &motion,
        plan: &plan,
        outcome: &outcome,
        without_contact: None,
        wall: 0.0,
    })
}

/// Every number of a tree, with its path; a list counts its entries.
fn numbers(path: &str, value: &serde_json::Value, all: &mut Vec<(String, f64)>) {
    use serde_json::Value;
    match value {
        Value::Number(number) => all.push((path.to_owned(), number.as_f64().unwrap_or(f64::NAN))),
        Value::Array(list) => {
            for (index, entry) in list.iter().enumerate() {
                numbers(&format!("{path}[{index}]"), entry, all);
            }
        }
        Value::Object(table) => {
            for (key, entry) in table {
                numbers(&format!("{path}.{key}"), entry, all);
            }
        }
        Value::Null | Value::Bool(_) | Value::String(_) => {}
    }
}

/// How one pair of towers is described.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Described {
    /// Storeys are springs of the building.
    Storeys,
    /// A third of their stiffness is, the rest are links between its floors.
    Braces,
    /// Every storey is two of half its height, with a floor between them that weighs a kilogram.
    HalfStoreys,
    /// By its matrices.
    Matrices,
    /// By matrices of two displacements a floor, each with half its mass, which a stiff spring ties together.
    HalfMasses,
}

/// Matrices of a tower of four storeys of 120 MN/m and 3.2 m; floors in front, then their other halves.
fn matrices(mass: f64, halves: bool) -> Given {
    let of_storeys = |storey: usize| {
        let [below, above] = [storey.checked_sub(1), Some(storey)];
        let ends = [
            (above, above, 1.0),
            (above, below, -1.0),
            (below, below, 1.0),
        ];
        ends.into_iter()
            .filter_map(|(row, column, sign)| Some((row?, column?, 12e7 * sign)))
    };
    let mut stiffness: Vec<_> = (0..4).flat_map(of_storeys).collect();
    let heights: Vec<f64> = (1..=4).map(|floor| 3.2 * f64::from(floor)).collect();
    let mut given = Given::condensed(vec![mass; 4], &[], vec![3.2; 4]);
    if halves {
        for floor in 0..4 {
            let tie = 1e14;
            stiffness.extend([
                (floor, floor, tie),
                (floor + 4, floor, -tie),
                (floor + 4, floor + 4, tie),
            ]);
        }
        given.mass = vec![0.5 * mass; 8];
        given.influence = vec![1.0; 8];
        given.heights = heights.repeat(2);
    }
    given.stiffness = stiffness;
    given
}

fn described(way: Described) -> Model {
    let damping = Damping::Rayleigh {
        alpha: 0.4,
        beta: 0.0,
    };
    let mut model = alone(damping, Vec::new());
    model.buildings.push(model.buildings[0].clone());
    model.buildings[1].name = "b".to_owned();
    for (index, building) in model.buildings.iter_mut().enumerate() {
        let mass = [1e5, 2.2e5][index];
        let shear = |mass: Vec<f64>, stiffness: f64, height: f64| {
            let storeys = mass.len();
            Structure::Shear(Shear {
                mass,
                stiffness: vec![stiffness; storeys],
                storey_heights: vec![height; storeys],
            })
        };
        building.structure = match way {
            Described::Storeys => shear(vec![mass; 4], 12e7, 3.2),
            Described::Braces => shear(vec![mass; 4], 4e7, 3.2),
            Described::HalfStoreys => shear([1.0, mass].repeat(4), 24e7, 1.6),
            Described::Matrices => Structure::Given(matrices(mass, false)),
            Described::HalfMasses => Structure::Given(matrices(mass, true)),
        };
    }
    if way == Described::Braces {
        for building in 0..2 {
            model.links.push(Link {
                between: [Some(building); 2],
                ..braces(&STOREYS, 8e7, 0.0)
            });
        }
    }
    model.gaps = row(model.buildings.clone(), 0.02, law(LawKind::HertzDamp, 0.65)).gaps;
    if way == Described::HalfStoreys {
        let whole: Vec<(usize, usize)> = (1..=4).map(|floor| (2 * floor, 2 * floor)).collect();
        model.gaps[0].floors = FloorPairs::listed(&whole);
    }
    model
}

/// The path of a number in the summary of whole storeys, of one in a summary of halves; `None` if it has no like there.
fn of_whole_storeys(path: &str) -> Option<String> {
    let mut parts: Vec<String> = path.split('.').map(str::to_owned).collect();
    let is_contact = path.contains("contacts[");
    let last = parts.len() - 1;
    for (index, part) in parts.iter_mut().enumerate() {
        let Some((list, number)) = part.split_once('[') else {
            continue;
        };
        let number: usize = number.trim_end_matches(']').parse().ok()?;
        if list == "floors" && !is_contact {
            // Moments are those at the foot of a storey: of its lower half.
            let at = usize::from(!path.contains("overturning_moment"));
            let whole = number.checked_sub(at).filter(|number| number % 2 == 0)?;
            *part = format!("floors[{}]", whole / 2);
        } else if index == last && list.contains("period") && number >= 4 {
            return None;
        }
    }
    Some(parts.join("."))
}

/// What a summary says of buildings and gaps must not depend on how they are described: one pair that pounds, told in five ways, and
/// every number that is named the same. A name means the whole building, whatever carries its forces and its masses.
#[test]
fn every_number_is_that_of_the_whole_building() {
    for (solver, tolerance) in [(Solver::Modal, 1e-6), (Solver::Riccati, 1e-5)] {
        let all_of = |way: Described| {
            let summary = serde_json::to_value(summary(&described(way), solver, tolerance));
            let tree = summary.expect("it is serialised");
            let mut all = Vec::new();
            for key in ["buildings", "gaps"] {
                numbers(key, &tree[key], &mut all);
            }
            all
        };
        let plain = all_of(Described::Storeys);
        assert!(plain.len() > 200, "{} numbers", plain.len());
        for way in [
            Described::Braces,
            Described::HalfStoreys,
            Described::Matrices,
            Described::HalfMasses,
        ] {
            // Direct steps follow the period of a floor of a kilogram, and of a tie.
            let quick = matches!(way, Described::HalfStoreys | Described::HalfMasses);
            if quick && solver == Solver::Riccati {
                continue;
            }
            let mut compared = 0;
            for (path, a) in all_of(way) {
                let like = match way {
                    Described::HalfStoreys => of_whole_storeys(&path),
                    Described::Storeys
                    | Described::Braces
                    | Described::Matrices
                    | Described::HalfMasses => Some(path.clone()),
                };
                // Numbers of floors.
                let counts = path.ends_with(".floor")
                    || path.contains("].floors[") && path.starts_with("gaps");
                let Some(like) = like.filter(|_| !counts) else {
                    continue;
                };
                let Some((_, b)) = plain.iter().find(|(other, _)| *other == like) else {
                    assert_ne!(way, Described::Braces, "{path} has no like");
                    continue;
                };
                compared += 1;
                // What is nearly zero has no scale of its own.
                let scale = b.abs().max(1e-6);
                assert!(
                    (a - b).abs() < 3e-3 * scale,
                    "{solver:?}, {way:?}: {path}: {a} and {b}"
                );
            }
            assert!(
                compared + 20 > plain.len(),
                "{solver:?}, {way:?}: {compared} of {}",
                plain.len()
            );
        }
    }
}

/// Storeys of 40 MN/m with braces of 80 MN/m are storeys of 120 MN/m: with the same damping, every number of building and floors
/// is the same, by both ways of stepping.
#[test]
fn braced_storeys_are_stiffer_storeys() {
    let stiffer = |damping: Damping| {
        let mut model = alone(damping, Vec::new());
        let Structure::Shear(shear) = &mut model.buildings[0].structure else {
            panic!("a tower is a shear building")
        };
        shear.stiffness = vec![12e7; 4];
        model
    };
    let five = Damping::ratio(0.05, []);
    let of_mass = Damping::Rayleigh {
        alpha: 0.4,
        beta: 0.0,
    };
    // Damping in proportion to stiffness acts on the storeys, not on the braces: its coefficients make up for that.
    for damping in [of_mass, five] {
        for solver in [Solver::Modal, Solver::Riccati] {
            let braced = alone(damping.clone(), vec![braces(&STOREYS, 8e7, 0.0)]);
            let [braced, stiff] =
                [&braced, &stiffer(damping.clone())].map(|model| summary(model, solver, 1e-6));
            let [a, b] = [&braced.buildings[0], &stiff.buildings[0]];
            let close = |what: &str, a: f64, b: f64| {
                assert!(
                    (a - b).abs() < 2e-5 * b.abs(),
                    "{solver:?} {damping:?}: {what} {a} and {b}"
                );
            };
            for (a, b) in a.periods_s.iter().zip(&b.periods_s) {
                assert!((a / b - 1.0).abs() < 1e-10, "{a} and {b}");
            }
            close(
                "base",
                a.response.base_shear_peak_n,
                b.response.base_shear_peak_n,
            );
            for (a, b) in a.floors.iter().zip(&b.floors) {
                let (a, b) = (&a.response, &b.response);
                close("shear", a.storey_shear_peak_n, b.storey_shear_peak_n);
                close(
                    "moment",
                    a.overturning_moment_peak_n_m,
                    b.overturning_moment_peak_n_m,
                );
                close("drift", a.storey_drift_peak, b.storey_drift_peak);
                close(
                    "acceleration",
                    a.total_acceleration_peak_m_s2,
                    b.total_acceleration_peak_m_s2,
                );
            }
        }
    }
}

/// What stands above a level is held by all that passes through it: without other damping, the sum of springs, braces and dashpots
/// is that of −m (ü + a_g). Links over two storeys count in both.
#[test]
fn storey_shears_balance_the_inertia_above() {
    let viscous = Link {
        law: LinkLaw::Viscous { exponent: 0.5 },
        ..braces(&[(0, 1)], 0.0, 2e5)
    };
    let model = alone(
        UNDAMPED,
        vec![
            braces(&[(1, 3)], 5e7, 4e6),
            braces(&[(0, 1), (3, 4)], 0.0, 6e6),
        ],
    );
    let mut yielding = model.clone();
    yielding.links.push(viscous);
    for (model, solver) in [
        (&model, Solver::Modal),
        (&model, Solver::Riccati),
        (&yielding, Solver::Riccati),
    ] {
        let (system, outcome) = outcome(model, solver, 1e-4);
        let Structure::Shear(shear) = &model.buildings[0].structure else {
            panic!("a tower is a shear building")
        };
        let accelerations: Vec<Vec<f64>> = (1..=4)
            .map(|floor| column(&outcome, Column::total_acceleration(0, floor)))
            .collect();
        let rows = accelerations[0].len();
        for storey in 0..4 {
            let above = |row: usize| -> f64 {
                (storey..4)
                    .map(|floor| -shear.mass[floor] * accelerations[floor][row])
                    .sum()
            };
            let inertia: Vec<f64> = (0..rows).map(above).collect();
            let inertia = largest(&inertia);
            let found = outcome.peaks.floors(0)[storey].storey_shear();
            // Rows are as close as steps, and peaks are also looked for between them.
            assert!(
                (found / inertia - 1.0).abs() < 4e-3,
                "{solver:?}, storey {storey}: {found} and {inertia}"
            );
        }
        let base = outcome.peaks.base_shear(0);
        let lowest = outcome.peaks.floor(0, 1).storey_shear();
        assert!(
            (base / lowest - 1.0).abs() < 1e-6,
            "{solver:?}: {base} and {lowest}"
        );
        assert_eq!(system.structures().len(), 1);
    }
}

/// All modes of a braced frame are those of the matrix that its flexibility with braces inverts: ω² φᵀMφ = φᵀ(K + RSRᵀ)φ.
#[test]
fn modes_of_braced_frames_have_the_energy_of_braces() {
    let braced = frame(4, &[5.0, 4.0]);
    let mut model = row(vec![framed("a", braced)], 0.0, law(LawKind::Linear, 1.0));
    model.gaps.clear();
    if let Structure::Frame(frame) = &mut model.buildings[0].structure {
        frame.axial = Axial::default();
    }
    let bare = assembled(&model);
    model.links = vec![braces(&[(0, 1), (1, 3)], 9e7, 1e5)];
    let system = assembled(&model);
    let (building, links) = (&system.buildings[0], &system.buildings[0].inner_links);
    assert_eq!(links.len(), 2);
    assert!(building.modes[0].period() < 0.9 * bare.buildings[0].modes[0].period());
    let all = eigen::modes(building, 3).expect("it stands");
    for (mode, lateral) in all.iter().zip(building.lateral_modes()) {
        assert!((mode.period() / lateral.period() - 1.0).abs() < 1e-9);
        let mut force = vec![0.0; building.equations.len()];
        building
            .equations
            .stiffness
            .multiply_add(&mode.shape, &mut force);
        building
            .equations
            .undamped
            .multiply_add(&mode.shape, &mut force);
        let mut energy: f64 = force.iter().zip(&mode.shape).map(|(f, u)| f * u).sum();
        energy += links
            .iter()
            .map(|link| link.stiffness * link.shortening.value(&mode.shape).powi(2))
            .sum::<f64>();
        assert!(
            (energy / mode.circular_frequency.powi(2) - 1.0).abs() < 1e-8,
            "{energy} and {}",
            mode.circular_frequency.powi(2)
        );
    }
}

fn five() -> Damping {
    Damping::ratio(0.05, [])
}

/// A pushover of storeys of 40 MN/m with braces of 80 MN/m is that of storeys of 120 MN/m; dashpots do not resist it.
#[test]
fn a_pushover_counts_braces() {
    let push = |storeys: f64, links: Vec<Link>| {
        let mut model = alone(five(), links);
        let Structure::Shear(shear) = &mut model.buildings[0].structure else {
            panic!("a tower is a shear building")
        };
        shear.stiffness = vec![storeys; 4];
        let system = assembled(&model);
        pushover(&system.buildings[0], PushSettings::default()).expect("a curve")
    };
    let plain = push(12e7, Vec::new());
    for braced in [
        push(4e7, vec![braces(&STOREYS, 8e7, 0.0)]),
        push(12e7, vec![braces(&STOREYS, 0.0, 1e6)]),
    ] {
        assert_eq!(braced.points.len(), plain.points.len());
        for (one, other) in braced.points.iter().zip(&plain.points) {
            assert!((one.base_shear - other.base_shear).abs() <= 1e-9 * other.base_shear);
            for (a, b) in one.floors.iter().zip(&other.floors) {
                assert!((a - b).abs() <= 1e-9 * b.abs());
            }
        }
    }
}

/// At every corner of the curve the forces of storeys and links, each from its own law and its change of length, bear the load; links
/// over several storeys, of every law that resists, pushed either way.
#[test]
fn a_pushover_with_links_is_in_equilibrium() {
    let yielding = {
        let corners = Corners::bilinear(2e5, 0.05);
        let backbone = Backbone::from_forces(5e7, corners, corners).expect("sound");
        Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("it fits")
    };
    let with = |law: LinkLaw, floors: &[(usize, usize)]| {
        let inelastic = matches!(law, LinkLaw::Friction { .. } | LinkLaw::Yielding(_));
        Link {
            law,
            ..braces(floors, if inelastic { 0.0 } else { 6e7 }, 0.0)
        }
    };
    let friction = LinkLaw::Friction {
        slip_force: 3e5,
        stick_stiffness: 7e7,
    };
    let mut model = alone(
        five(),
        vec![
            with(friction, &[(0, 1)]),
            with(LinkLaw::Yielding(yielding), &[(1, 2), (1, 3)]),
            with(LinkLaw::Stopper { gap: 0.01 }, &[(4, 2)]),
            with(LinkLaw::Cable { slack: 0.0 }, &[(0, 2)]),
            with(LinkLaw::Cable { slack: 0.008 }, &[(2, 0)]),
            with(LinkLaw::Linear, &[(0, 4)]),
        ],
    );
    let hinged = Backbone::from_deformations(
        4e7,
        Corners::bilinear(0.02, 0.1),
        Corners::bilinear(0.02, 0.1),
    );
    let hinged =
        Hysteresis::new(HysteresisRule::Bilinear, hinged.expect("sound")).expect("it fits");
    model.buildings[0].hinges = Some(Hinges::Storeys(vec![hinged; 4]));
    let system = assembled(&model);
    let building = &system.buildings[0];
    let clamped = |stiffness: f64, limit: f64, after: f64, by: f64| {
        let corner = limit / stiffness;
        let inside = by.clamp(-corner, corner);
        stiffness * (inside + after * (by - inside))
    };
    for direction in [PushDirection::Right, PushDirection::Left] {
        let settings = PushSettings {
            direction,
            drift: 0.006,
            ..PushSettings::default()
        };
        let curve = pushover(building, settings).expect("a curve");
        assert_eq!(curve.end, PushEnd::Target);
        let events = || curve.points.iter().flat_map(|point| &point.events);
        assert!(events().count() >= 6, "{} corners", events().count());
        assert!(events().any(|event| event.kind == PushEventKind::Closes));
        for point in &curve.points {
            let at = |floor: usize| match floor {
                0 => 0.0,
                floor => point.displacement[building.floors[floor - 1].dof],
            };
            let mut force = [0.0; 5];
            let mut add = |from: usize, to: usize, value: f64| {
                force[from] -= value;
                force[to] += value;
            };
            for storey in 1..=4 {
                let drift = at(storey) - at(storey - 1);
                add(storey - 1, storey, clamped(4e7, 8e5, 0.1, drift));
            }
            for link in &building.inner_links {
                let [from, to] = link.floors;
                // The first end moves to the right against the second: the link is shorter.
                let shorter = at(from) - at(to);
                assert!((link.shortening.value(&point.displacement) - shorter).abs() < 1e-15);
                let value = match (from, to) {
                    (0, 1) => clamped(7e7, 3e5, 0.0, shorter),
                    (1, _) => clamped(5e7, 2e5, 0.05, shorter),
                    (4, 2) => 6e7 * (shorter - 0.01).max(0.0),
                    (0, 2) => -6e7 * (-shorter).max(0.0),
                    (2, 0) => -6e7 * (-shorter - 0.008).max(0.0),
                    _ => 6e7 * shorter,
                };
                add(to, from, value);
            }
            for (floor, share) in curve.floor_loads.iter().enumerate() {
                let load = direction.sign() * share * point.base_shear;
                assert!(
                    (load - force[floor + 1]).abs() < 1e-9 * (1e5 + point.base_shear),
                    "{direction:?}: {load} and {} at {:?}",
                    force[floor + 1],
                    point.floors
                );
            }
        }
    }
}

/// Corners of links are named.
#[test]
fn a_link_that_yields_is_named() {
    let friction = LinkLaw::Friction {
        slip_force: 3e5,
        stick_stiffness: 7e7,
    };
    let slider = Link {
        law: friction,
        ..braces(&[(0, 1), (1, 3)], 0.0, 0.0)
    };
    let system = assembled(&alone(five(), vec![slider]));
    let building = &system.buildings[0];
    let curve = pushover(building, PushSettings::default()).expect("a curve");
    let pushed = PushedBuilding {
        building,
        curves: Vec::new(),
    };
    let events = curve.points.iter().flat_map(|point| &point.events);
    let events =
        events.map(|event| format!("{} {}", pushed.place(event.spring), event.kind.name()));
    let mut events: Vec<String> = events.collect();
    events.sort();
    assert_eq!(
        events,
        [
            "link between floors 1 and 3 yields",
            "link between the base and floor 1 yields",
        ]
    );
    assert_eq!(curve.counts(0), [0, 0]);
}
