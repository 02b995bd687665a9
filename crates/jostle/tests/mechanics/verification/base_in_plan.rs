//! Springs under the base of buildings in plan: the plane as their limit, closed forms, a matrix put together by hand, and what is
//! refused.

use std::f64::consts::TAU;

use jostle::{
    AcrossBase, Analysis, Base, Building, Column, Damping, Foundation, Gravity, MassDamping, Model,
    PlanArea, PlanPoint, Soil, SoilCoupling, Solver, Structure, Tier, TierStorey, Tiers,
};
use jostle_testkit::models::{UNDAMPED, equal_storeys, rectangle};
use jostle_testkit::runs::assembled;

use super::isolation_in_plan::{from, run, shaking};
use crate::verification::support::{column, difference, largest};

const SWAY: [f64; 2] = [4e8, 3e6];
const ROCKING: [f64; 2] = [9e9, 4e7];

/// (ωh)²/8 with ω = 60 rad/s, above the second mode of the building, and h = 1 ms \[–\].
const MISSED: f64 = 4.5e-4;

fn base() -> Base {
    Base {
        horizontal_stiffness: Some(SWAY[0]),
        horizontal_damping: SWAY[1],
        rotational_stiffness: Some(ROCKING[0]),
        rotational_damping: ROCKING[1],
        torsional_stiffness: Some(7e9),
        torsional_damping: 2e7,
        mass: 1.1e5,
        ..Base::default()
    }
}

fn tiers(storeys: usize, [mass, stiffness]: [f64; 2], plan: &[PlanPoint]) -> Tiers {
    let tier = Tier::uniform(mass, plan.to_vec()).expect("an area");
    let torsion = TierStorey::torsion_of_even([stiffness; 2], &PlanArea::new(plan));
    let storey = TierStorey {
        stiffness: [stiffness, stiffness, torsion],
        centre: tier.centre,
    };
    Tiers {
        floors: vec![tier; storeys],
        storeys: vec![storey; storeys],
        storey_heights: vec![3.0; storeys],
        ..Tiers::default()
    }
}

fn model(structure: Structure, damping: Damping, base: Base, solver: Solver) -> Model {
    Model {
        title: "springs under a plan".to_owned(),
        buildings: vec![Building {
            name: "block".to_owned(),
            structure,
            damping,
            base,
            ..Building::default()
        }],
        analysis: Analysis {
            step: Some(1e-3),
            solver: Some(solver),
            ..Analysis::default()
        },
        ..Model::default()
    }
}

/// Shaken along one line, a symmetric building on springs moves as in one plane on soil with the same matrices, also with the site
/// turned, and with P-Delta.
#[test]
fn on_a_line_a_base_is_that_of_one_plane() {
    let (storeys, properties, side) = (3, [1.5e5, 1.2e8], 12.0);
    let base = base();
    let motion = shaking("line", 4.0, 1.0);
    for (solver, damping, p_delta) in [
        (Solver::Riccati, [0.2, 2e-3], false),
        (Solver::Stiffness, [0.2, 2e-3], true),
    ] {
        let [alpha, beta] = damping;
        let damping = Damping::Rayleigh { alpha, beta };
        let shear = Structure::Shear(equal_storeys(storeys, properties));
        let foundation = Foundation::rectangle(side, side, base.mass);
        let flat_base = Base {
            foundation: Some(foundation),
            ..Base::default()
        };
        let mut plane = model(shear, damping.clone(), flat_base, solver);
        let matrix = |sway: f64, rocking: f64| vec![vec![sway, 0.0], vec![0.0, rocking]];
        plane.soil = Some(Soil {
            half_space: None,
            coupling: SoilCoupling::Given {
                stiffness: matrix(SWAY[0], ROCKING[0]),
                damping: matrix(SWAY[1], ROCKING[1]),
            },
        });
        let gravity = Gravity {
            p_delta,
            ..Gravity::default()
        };
        plane.buildings[0].gravity = gravity;
        plane.buildings[0].mass_damping = MassDamping::Ground;
        let (_, flat) = run(&plane, &motion);
        for angle in [0.0, 30.0 * TAU / 360.0, 2.0] {
            let (sin, cos) = angle.sin_cos();
            let plan: Vec<PlanPoint> = rectangle(0.0, 0.0, side, side)
                .into_iter()
                .map(|[x, y]| [cos * x - sin * y, sin * x + cos * y])
                .collect();
            let tiers = Structure::Tiers(tiers(storeys, properties, &plan));
            let mut deep = model(tiers, damping.clone(), base, solver);
            deep.buildings[0].gravity = gravity;
            let (system, deep) = run(&deep, &from(motion.clone(), angle, None));
            for floor in 1..=storeys {
                let place = Column::displacement(0, floor);
                let expected = column(&flat, place);
                let x = column(&deep, place);
                let y = column(&deep, place.across());
                let on = |a: f64, b: f64| -> Vec<f64> {
                    let pairs = x.iter().zip(&y);
                    pairs.map(|(x, y)| a * x + b * y).collect()
                };
                let apart = difference(&on(cos, sin), &expected);
                println!("{solver:?} {angle:.2} floor {floor}: {apart:e}");
                assert!(largest(&expected) > 1e-3);
                assert!(apart < 1e-8, "{solver:?} {angle} {floor}: {apart:e}");
                let aside = largest(&on(-sin, cos));
                assert!(aside < 1e-9 * largest(&expected), "{aside:e}");
                // Rocking is no drift. In one plane direct runs look at drifts at the ends of steps, in plan within them: with h = 1 ms
                // and motion of ω = 60 rad/s they miss up to (ωh)²/8.
                let [found, known] = [&deep, &flat].map(|run| run.peaks.floor(0, floor));
                for (found, share) in [
                    (found.storey_drift(), cos),
                    (found.across().storey_drift(), sin),
                ] {
                    let known = known.storey_drift() * share.abs();
                    let missed = found - known;
                    assert!(
                        missed.abs() < 1e-9 || missed > 0.0 && missed < MISSED * known,
                        "{solver:?} {found} {known}"
                    );
                }
            }
            assert_eq!(system.buildings[0].equations.len(), 14);
        }
    }
}

/// A base that only sways is that of a shear building in one plane, with its base shear: the force of the spring on the ground.
#[test]
fn a_base_that_sways_is_that_of_one_plane() {
    let base = Base {
        rotational_stiffness: None,
        rotational_damping: 0.0,
        torsional_stiffness: None,
        torsional_damping: 0.0,
        ..base()
    };
    let (storeys, properties) = (3, [1.5e5, 1.2e8]);
    let damping = Damping::Rayleigh {
        alpha: 0.2,
        beta: 2e-3,
    };
    let plan = rectangle(0.0, 0.0, 14.0, 9.0);
    let structures = [
        Structure::Shear(equal_storeys(storeys, properties)),
        Structure::Tiers(tiers(storeys, properties, &plan)),
    ];
    let motion = shaking("line", 4.0, 1.0);
    let [flat, deep] = structures.map(|structure| {
        let model = model(structure, damping.clone(), base, Solver::Riccati);
        run(&model, &motion).1
    });
    for floor in 1..=storeys {
        let [a, b] = [&flat, &deep].map(|run| column(run, Column::displacement(0, floor)));
        assert!(largest(&a) > 1e-3 && difference(&a, &b) < 1e-9);
        let [a, b] = [&flat, &deep].map(|run| run.peaks.floor(0, floor).storey_drift());
        assert!(b >= a && b < (1.0 + MISSED) * a, "{a} {b}");
    }
    let [a, b] = [&flat, &deep].map(|run| run.peaks.base_shear(0));
    println!("base shear {a} {b}");
    assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}");
}

/// One floor on a footing without mass: 1/ω² = m (1/k + 1/k_h + h²/k_r) in either direction (A. S. Veletsos and J. W. Meek 1974,
/// Earthquake Engineering and Structural Dynamics 3, 121–138), and in torsion J (1/k_t + 1/k_b).
#[test]
fn springs_of_a_base_act_in_series() {
    let plan = rectangle(0.0, 0.0, 14.0, 9.0);
    let tiers = tiers(1, [2e5, 1.5e8], &plan);
    let (mass, polar) = (tiers.floors[0].mass, tiers.floors[0].polar_mass);
    let torsion = tiers.storeys[0].stiffness[2];
    let across = AcrossBase {
        horizontal_stiffness: Some(2.5e8),
        rotational_stiffness: Some(3e9),
        ..AcrossBase::default()
    };
    let base = Base {
        horizontal_stiffness: Some(4e8),
        rotational_stiffness: Some(9e9),
        torsional_stiffness: Some(6e9),
        across: Some(across),
        ..Base::default()
    };
    let system = assembled(&model(
        Structure::Tiers(tiers),
        UNDAMPED,
        base,
        Solver::Riccati,
    ));
    let mut found: Vec<f64> = (system.buildings[0].modes.iter())
        .map(|mode| mode.circular_frequency.powi(-2))
        .collect();
    let h = 3.0_f64;
    let mut expected = vec![
        mass * (1.0 / 1.5e8 + 1.0 / 4e8 + h * h / 9e9),
        mass * (1.0 / 1.5e8 + 1.0 / 2.5e8 + h * h / 3e9),
        polar * (1.0 / torsion + 1.0 / 6e9),
    ];
    for list in [&mut found, &mut expected] {
        list.sort_by(f64::total_cmp);
    }
    assert_eq!(found.len(), 3);
    for (found, expected) in found.iter().zip(&expected) {
        println!("{:e}", found / expected - 1.0);
        assert!((found / expected - 1.0).abs() < 1e-11, "{found} {expected}");
    }
}

/// Two eccentric floors: strain energy of any displacement, spring by spring at the places where the springs stand.
#[test]
fn an_eccentric_building_has_the_strain_of_its_springs() {
    let plan = rectangle(0.0, 0.0, 14.0, 9.0);
    let mut tiers = tiers(2, [2e5, 1.5e8], &plan);
    tiers.floors[0].centre = [8.0, 4.0];
    tiers.floors[1].centre = [6.5, 5.5];
    tiers.storeys[0].centre = [5.0, 3.0];
    tiers.storeys[1].centre = [9.0, 6.0];
    tiers.storey_heights = vec![4.0, 3.2];
    let base = Base {
        across: Some(AcrossBase {
            horizontal_stiffness: Some(2.5e8),
            rotational_stiffness: Some(3e9),
            ..AcrossBase::default()
        }),
        ..base()
    };
    let structure = Structure::Tiers(tiers.clone());
    let system = assembled(&model(structure, UNDAMPED, base, Solver::Riccati));
    let building = &system.buildings[0];
    let equations = &building.equations;
    let below = building
        .discretization
        .stick_model
        .plan_base
        .expect("it stands on springs");
    let node = |node: usize| {
        [
            equations.horizontal(node).expect("it moves"),
            equations.vertical(node).expect("it moves"),
        ]
    };
    let floor = |at: usize| {
        let [x, y] = node(at);
        [x, y, equations.rotation(at).expect("it turns")]
    };
    let footing = floor(below.footing);
    let rocking = node(below.rocking.expect("it rocks"));
    let levels = [
        footing,
        floor(building.discretization.floors[0]),
        floor(building.discretization.floors[1]),
    ];
    let centres = [[7.0, 4.5], [8.0, 4.0], [6.5, 5.5]];
    assert_eq!(equations.len(), 11);
    let mut seed = 1_u32;
    for _ in 0..20 {
        let u: Vec<f64> = (0..11)
            .map(|_| {
                seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                f64::from(seed) / f64::from(u32::MAX) - 0.5
            })
            .collect();
        // Where a point of a level goes, at the height of that level.
        let at = |level: usize, point: PlanPoint| {
            let [x, y, turned] = levels[level].map(|dof| u[dof]);
            let arm = [0, 1].map(|axis| point[axis] - centres[level][axis]);
            [x - turned * arm[1], y + turned * arm[0], turned]
        };
        let mut strain = 0.0;
        for (storey, spring) in tiers.storeys.iter().enumerate() {
            let (lower, upper) = (at(storey, spring.centre), at(storey + 1, spring.centre));
            let height = tiers.storey_heights[storey];
            let leant = [height * u[rocking[0]], height * u[rocking[1]], 0.0];
            for axis in 0..3 {
                let deformed = upper[axis] - lower[axis] - leant[axis];
                strain += spring.stiffness[axis] * deformed * deformed;
            }
        }
        let moved = at(0, [7.0, 4.5]);
        for (value, moved) in [
            (4e8, moved[0]),
            (2.5e8, moved[1]),
            (7e9, moved[2]),
            (9e9, u[rocking[0]]),
            (3e9, u[rocking[1]]),
        ] {
            strain += value * moved * moved;
        }
        let found = equations.strain(&u);
        assert!((found / strain - 1.0).abs() < 1e-12, "{found} {strain}");
    }
    // The footing is a plate of the plan: m a²/12.
    let inertia = rocking.map(|dof| equations.mass[dof]);
    for (inertia, side) in inertia.into_iter().zip([14.0_f64, 9.0]) {
        assert!((inertia / (1.1e5 * side * side / 12.0) - 1.0).abs() < 1e-12);
    }
}

/// An eccentric building on springs moves alike by its modes and by direct steps.
#[test]
fn modes_and_direct_steps_agree() {
    let mut tiers = tiers(3, [1.5e5, 1.2e8], &rectangle(0.0, 0.0, 14.0, 9.0));
    for storey in &mut tiers.storeys {
        storey.centre = [8.2, 3.9];
    }
    let base = Base {
        horizontal_damping: 0.0,
        rotational_damping: 0.0,
        torsional_damping: 0.0,
        ..base()
    };
    let damping = Damping::Rayleigh {
        alpha: 0.3,
        beta: 0.0,
    };
    let motion = from(
        shaking("skew", 4.0, 1.0),
        0.5,
        Some(shaking("other", 5.0, 0.7)),
    );
    let runs = [Solver::Modal, Solver::Riccati].map(|solver| {
        let mut model = model(
            Structure::Tiers(tiers.clone()),
            damping.clone(),
            base,
            solver,
        );
        model.analysis.step = Some(2.5e-4);
        run(&model, &motion).1
    });
    for floor in 1..=3 {
        for place in [
            Column::displacement(0, floor),
            Column::displacement(0, floor).across(),
        ] {
            let [modal, direct] = [0, 1].map(|at| column(&runs[at], place));
            let apart = difference(&modal, &direct);
            println!("{floor}: {apart:e}");
            assert!(apart < 1e-4, "{apart:e}");
        }
        let [modal, direct] = [0, 1].map(|at| runs[at].peaks.floor(0, floor));
        for [modal, direct] in [
            [modal.storey_drift(), direct.storey_drift()],
            [
                modal.across().storey_drift(),
                direct.across().storey_drift(),
            ],
        ] {
            assert!((modal / direct - 1.0).abs() < 1e-3, "{modal} {direct}");
        }
    }
}

/// A base that is stiff in all its motions is no base.
#[test]
fn a_stiff_base_is_a_fixed_one() {
    let mut tiers = tiers(2, [1.5e5, 1.2e8], &rectangle(0.0, 0.0, 14.0, 9.0));
    tiers.storeys[1].centre = [8.2, 3.9];
    let stiff = Base {
        horizontal_stiffness: Some(1e15),
        rotational_stiffness: Some(1e18),
        torsional_stiffness: Some(1e18),
        ..Base::default()
    };
    let swaying = Base {
        horizontal_stiffness: Some(1e15),
        ..Base::default()
    };
    let twisting = Base {
        torsional_stiffness: Some(1e18),
        ..Base::default()
    };
    let rocking = Base {
        rotational_stiffness: Some(1e18),
        ..Base::default()
    };
    let damping = Damping::ratio(0.05, [1, 2]);
    let periods = |base: Base| {
        let system = assembled(&model(
            Structure::Tiers(tiers.clone()),
            damping.clone(),
            base,
            Solver::Riccati,
        ));
        let building = &system.buildings[0];
        let mut values: Vec<f64> = building
            .modes
            .iter()
            .map(|mode| mode.circular_frequency)
            .collect();
        values.truncate(6);
        values.extend([building.equations.alpha, building.equations.beta]);
        values
    };
    let fixed = periods(Base::default());
    for base in [stiff, swaying, twisting, rocking] {
        for (period, fixed) in periods(base).iter().zip(&fixed) {
            assert!(
                (period / fixed - 1.0).abs() < 1e-5,
                "{period} {fixed} {base:?}"
            );
        }
    }
}

#[test]
fn what_a_base_in_plan_cannot_have_is_refused() {
    let tiers = Structure::Tiers(tiers(1, [1.5e5, 1.2e8], &rectangle(0.0, 0.0, 14.0, 9.0)));
    let mut half = base();
    half.across = Some(AcrossBase {
        horizontal_stiffness: Some(1e8),
        ..AcrossBase::default()
    });
    let mut lifts = base();
    lifts.vertical_stiffness = Some(1e9);
    let mut negative = base();
    negative.torsional_damping = -1.0;
    let mut loose = Base {
        horizontal_stiffness: None,
        ..base()
    };
    loose.horizontal_damping = 1.0;
    for (base, field) in [
        (half, "base.across.rotational_stiffness"),
        (lifts, "base.vertical_stiffness"),
        (negative, "base.torsional_damping"),
        (loose, "base.horizontal_damping"),
    ] {
        let faults = model(tiers.clone(), UNDAMPED, base, Solver::Riccati).check();
        let faults = faults.expect_err(field);
        assert!(
            faults.iter().any(|fault| fault.path.ends_with(field)),
            "{faults:?}"
        );
    }
    let shear = Structure::Shear(equal_storeys(2, [1e5, 1e8]));
    let faults = model(shear, UNDAMPED, base(), Solver::Riccati).check();
    let faults = faults.expect_err("it has no plan");
    assert!(
        faults
            .iter()
            .any(|fault| fault.path.ends_with("torsional_stiffness"))
    );
}
