//! Links between points of buildings in plan: as columns at the same points, and as links of the same buildings in one plane.

use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
use jostle::{
    Bearing, Building, ContactLaw, Damping, FloorPairs, Gap, GroundMotion, LawKind, Link, LinkLaw,
    Model, PlanPoint, RestitutionIs, Shear, Solver, Structure, Summary, Tier, TierStorey, Tiers,
};
use jostle_testkit::compare::close;
use jostle_testkit::models::rectangle;
use jostle_testkit::motions::fading;
use jostle_testkit::runs::run_and_summary;

const STOREYS: usize = 3;
const SOLVERS: [Solver; 2] = [Solver::Modal, Solver::Riccati];

/// Mass of every floor \[kg\] and stiffness of every storey \[N/m\].
const FIRST: [f64; 2] = [60e3, 80e6];
const SECOND: [f64; 2] = [40e3, 30e6];

fn in_plan(name: &str, x: f64, mass: f64, storey: &TierStorey) -> Building {
    let plan = rectangle(x, 0.0, x + 10.0, 8.0);
    Building {
        name: name.to_owned(),
        structure: Structure::Tiers(Tiers {
            floors: vec![Tier::uniform(mass, plan).expect("an area"); STOREYS],
            storeys: vec![*storey; STOREYS],
            storey_heights: vec![3.0; STOREYS],
            ..Tiers::default()
        }),
        damping: Damping::Rayleigh {
            alpha: 0.5,
            beta: 0.0,
        },
        ..Building::default()
    }
}

fn in_plane(name: &str, [mass, stiffness]: [f64; 2]) -> Building {
    Building {
        name: name.to_owned(),
        structure: Structure::Shear(Shear {
            mass: vec![mass; STOREYS],
            stiffness: vec![stiffness; STOREYS],
            storey_heights: vec![3.0; STOREYS],
        }),
        damping: Damping::Rayleigh {
            alpha: 0.5,
            beta: 0.0,
        },
        ..Building::default()
    }
}

fn model(buildings: Vec<Building>, links: Vec<Link>, solver: Solver) -> Model {
    let law = ContactLaw {
        kind: LawKind::Hertz,
        stiffness: 1e9,
        restitution: 1.0,
        restitution_is: RestitutionIs::Input,
    };
    let pairs = 1..buildings.len();
    let mut model = Model {
        title: "links".to_owned(),
        gaps: pairs.map(|left| Gap::after(left - 1, 0.02, law)).collect(),
        buildings,
        links,
        ..Model::default()
    };
    model.analysis.solver = Some(solver);
    model.analysis.tolerance = 1e-4;
    model
}

fn shaking() -> GroundMotion {
    fading("along", 9.0, [4.0, 3.0], 120)
}

/// The same from two sides.
fn turned() -> GroundMotion {
    GroundMotion {
        bearing: Some(Box::new(Bearing {
            angle: 0.7,
            across: None,
        })),
        ..shaking()
    }
}

/// Displacements, shears and moments of floors; base shears; forces, strokes and dissipated energies of links.
fn numbers(summary: &Summary) -> [Vec<f64>; 3] {
    let mut all = [const { Vec::new() }; 3];
    for building in &summary.buildings {
        all[1].push(building.response.base_shear_peak_n);
        if let Some(plan) = &building.in_plan {
            all[1].push(plan.base_shear_across_peak_n);
            all[2].push(plan.base_torque_peak_n_m);
        }
        for floor in &building.floors.above {
            let response = &floor.response;
            all[0].extend([response.displacement_max_m, response.displacement_min_m]);
            all[1].push(response.storey_shear_peak_n);
            if let Some(plan) = &floor.in_plan {
                all[0].extend([
                    plan.displacement_across_max_m,
                    plan.displacement_across_min_m,
                ]);
                all[1].push(plan.storey_shear_across_peak_n);
                all[2].push(plan.storey_torque_peak_n_m);
            }
        }
    }
    all
}

fn agree(one: &[Vec<f64>; 3], other: &[Vec<f64>; 3], tolerance: f64, what: &str) {
    for (one, other) in one.iter().zip(other) {
        let most = other
            .iter()
            .fold(0.0_f64, |most, value| most.max(value.abs()));
        assert_eq!(one.len(), other.len());
        for (a, b) in one.iter().zip(other) {
            close(*a, *b, most, tolerance, what);
        }
    }
}

fn laws() -> Vec<Link> {
    let corners = Corners::bilinear(80e3, 0.05);
    let backbone = Backbone::from_forces(20e6, corners, corners).expect("sound");
    let spring = Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("sound");
    let link = |law, stiffness, damping| Link {
        stiffness,
        damping,
        law,
        ..Link::default()
    };
    vec![
        link(LinkLaw::Linear, 20e6, 1e5),
        link(LinkLaw::Viscous { exponent: 0.5 }, 0.0, 1.5e5),
        link(LinkLaw::Maxwell, 20e6, 4e5),
        link(
            LinkLaw::Friction {
                slip_force: 60e3,
                stick_stiffness: 40e6,
            },
            0.0,
            0.0,
        ),
        link(LinkLaw::Yielding(spring), 0.0, 0.0),
        link(LinkLaw::Cable { slack: 5e-3 }, 20e6, 0.0),
        link(LinkLaw::Stopper { gap: 6e-3 }, 60e6, 0.0),
    ]
}

/// An elastic link between a floor and the one below, along x or at an angle, is a column at its place with stiffness in that direction
/// alone: periods, displacements, shears and torques of the whole building are the same.
#[test]
fn a_link_between_floors_is_a_column_in_one_direction() {
    let columns: Vec<(PlanPoint, [f64; 2])> = rectangle(0.0, 0.0, 10.0, 8.0)
        .into_iter()
        .map(|at| (at, [20e6, 15e6]))
        .collect();
    let stiffness = 25e6;
    // Along x at the front, and across at the right.
    for (at, end, direction) in [
        ([2.0, 1.0], [7.0, 1.0], [1.0, 0.0]),
        ([9.0, 6.0], [9.0, 3.0], [0.0, 1.0]),
    ] {
        for solver in SOLVERS {
            let more = direction.map(|share| share * stiffness);
            let all: Vec<_> = columns.iter().copied().chain([(at, more)]).collect();
            let with_column = in_plan("A", 0.0, FIRST[0], &TierStorey::of_elements(&all));
            let bare = in_plan("A", 0.0, FIRST[0], &TierStorey::of_elements(&columns));
            let link = Link {
                between: [Some(0); 2],
                floors: FloorPairs::listed(&[(0, 1), (1, 2), (2, 3)]),
                stiffness,
                at: Some([at, end]),
                ..Link::default()
            };
            let column = model(vec![with_column], Vec::new(), solver);
            let (system, _, expected) = run_and_summary(&column, &turned());
            let (linked, _, got) =
                run_and_summary(&model(vec![bare], vec![link], solver), &turned());
            agree(&numbers(&got), &numbers(&expected), 1e-3, "column");
            let modes = system.buildings[0]
                .modes
                .iter()
                .zip(&linked.buildings[0].modes);
            for (a, b) in modes {
                let frequency = a.circular_frequency;
                close(b.circular_frequency, frequency, frequency, 1e-9, "mode");
            }
        }
    }
}

/// Links through the centres of two symmetrical buildings, or inside one of them, act as in one plane, whatever their law.
#[test]
fn links_through_centres_act_as_in_one_plane() {
    let storey = |stiffness: f64, x: f64| TierStorey {
        stiffness: [stiffness, stiffness, 3e9],
        centre: [x + 5.0, 4.0],
    };
    for law in laws() {
        let solvers = match law.law {
            LinkLaw::Linear => &SOLVERS[..],
            _ => &SOLVERS[1..],
        };
        for &solver in solvers {
            let between = Link {
                between: [Some(0), Some(1)],
                floors: FloorPairs::listed(&[(1, 1), (3, 3)]),
                ..law.clone()
            };
            let inside = Link {
                between: [Some(1); 2],
                floors: FloorPairs::listed(&[(0, 1), (1, 3)]),
                ..law.clone()
            };
            let places = [[[10.0, 4.0], [10.02, 4.0]], [[12.0, 4.0], [18.0, 4.0]]];
            for (link, at) in [between, inside].into_iter().zip(places) {
                let plane = vec![in_plane("A", FIRST), in_plane("B", SECOND)];
                let space = vec![
                    in_plan("A", 0.0, FIRST[0], &storey(FIRST[1], 0.0)),
                    in_plan("B", 10.02, SECOND[0], &storey(SECOND[1], 10.02)),
                ];
                let placed = Link {
                    at: Some(at),
                    ..link.clone()
                };
                let (_, _, expected) =
                    run_and_summary(&model(plane, vec![link], solver), &shaking());
                let (_, _, got) = run_and_summary(&model(space, vec![placed], solver), &shaking());
                let along = |summary: &Summary| {
                    let floors = summary
                        .buildings
                        .iter()
                        .flat_map(|building| &building.floors.above);
                    let moved = floors.clone().flat_map(|floor| {
                        let response = &floor.response;
                        [response.displacement_max_m, response.displacement_min_m]
                    });
                    let shears = floors.map(|floor| floor.response.storey_shear_peak_n);
                    let base = summary.buildings.iter();
                    let base = base.map(|base| base.response.base_shear_peak_n);
                    [moved.collect(), shears.chain(base).collect::<Vec<f64>>()]
                };
                let ([a, b], [c, d]) = (along(&got), along(&expected));
                agree(
                    &[a, b, Vec::new()],
                    &[c, d, Vec::new()],
                    1e-3,
                    got.links[0].law.as_str(),
                );
                let (got, expected) = (&got.links[0], &expected.links[0]);
                close(
                    got.force_peak_n,
                    expected.force_peak_n,
                    expected.force_peak_n,
                    1e-3,
                    "force",
                );
                close(
                    got.stroke_peak_m,
                    expected.stroke_peak_m,
                    expected.stroke_peak_m,
                    1e-3,
                    "stroke",
                );
                assert!(got.force_peak_n > 1e4);
            }
        }
    }
}
