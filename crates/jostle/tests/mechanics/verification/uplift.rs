//! Foundations and feet of columns that lift off: static curves by bisection, rigid limits, mirrors, and energies.

use jostle::history::Owner;
use jostle::statics::{EquilibriumPath, STANDARD_GRAVITY, settle};
use jostle::system::BuildingSystem;
use jostle::{
    Base, BearingStrength, BedSpring, Building, Column, Damping, Foundation, Frame, Gap, Gravity,
    GroundMotion, GroundSprings, HalfSpace, LawKind, MassDamping, Model, Outcome, Section, Soil,
    SoilCoupling, Solver, Structure, Uplift,
};
use jostle_testkit::compare::close;
use jostle_testkit::runs::run_and_summary;

use crate::verification::support::{
    assembled, column, difference, frame, framed, law, row, run, shaking, steps, tower,
};

const GROUND: GroundSprings = GroundSprings {
    vertical_stiffness: 3e8,
    vertical_damping: 2e6,
    sway: None,
};

fn alone(building: Building) -> Model {
    row(vec![building], 0.0, law(LawKind::Linear, 1.0))
}

/// The building on a foundation that lifts off, under its weight.
fn lifting(building: Building, uplift: Uplift) -> Building {
    let foundation = Foundation {
        uplift: Some(uplift),
        ..Foundation::rectangle(3.6, 2.0, 40e3)
    };
    Building {
        base: Base {
            foundation: Some(foundation),
            ..Base::default()
        },
        gravity: Gravity {
            preload: true,
            p_delta: false,
        },
        ..building
    }
}

fn on_springs(springs: usize) -> Uplift {
    Uplift {
        ground: Some(GROUND),
        ..Uplift::with_springs(springs)
    }
}

/// A mass on a column that shortens.
fn stick() -> Building {
    let section = Section {
        flexural_rigidity: 600e6,
        axial_rigidity: Some(6e9),
        shear_rigidity: None,
        line_mass: 0.0,
    };
    let frame = frame(1, &[]);
    let mut building = framed(
        "A",
        Frame {
            storey_heights: vec![9.0],
            columns: vec![section],
            floor_mass: vec![120e3],
            column_segments: 1,
            ..frame
        },
    );
    let Structure::Frame(frame) = &mut building.structure else {
        unreachable!("it is a frame")
    };
    frame.axial.columns_flexible = true;
    building.damping = Damping::Rayleigh {
        alpha: 0.2,
        beta: 0.0,
    };
    building
}

/// Rise of the node of the foundation and the moment there for rotations \[m, N·m\], along the equilibrium path.
fn by_path(system: &BuildingSystem, rotations: &[f64]) -> Vec<[f64; 2]> {
    let place = system.foundation.expect("it stands on one");
    let [rise, turning] = [place.rise.expect("it lifts"), place.turning];
    let mut pattern = vec![0.0; system.equations.len()];
    pattern[turning] = 1.0;
    let settled = settle(system, STANDARD_GRAVITY).expect("it bears its weight");
    let start = settled.displacement[turning];
    let mut path = EquilibriumPath::driven(system, &settled, pattern, turning);
    rotations
        .iter()
        .map(|rotation| {
            loop {
                let left = start + rotation - path.displacement()[turning];
                if left < 1e-15 {
                    break;
                }
                path.find_rates().expect("it stands");
                path.advance(left).expect("few corners");
            }
            [path.displacement()[rise], path.load()]
        })
        .collect()
}

/// The same from vertical equilibrium by bisection, with forces of first loading.
fn by_bisection(
    system: &BuildingSystem,
    bed: &[BedSpring],
    bearing: Option<BearingStrength>,
    rotation: f64,
) -> [f64; 2] {
    let sticks = &system.discretization.stick_model;
    let place = system.foundation.expect("it stands on one");
    let node = sticks.foundation.as_ref().expect("one").node;
    let origin = sticks.nodes[node].x;
    let weights = sticks
        .nodes
        .iter()
        .map(|node| node.mass() * STANDARD_GRAVITY);
    let weight: f64 = weights.clone().sum();
    let skew = weights.zip(&sticks.nodes);
    let skew: f64 = skew.map(|(w, node)| w * (node.x - origin)).sum();
    let force = |spring: &BedSpring, rise: f64| {
        let sunk = -(rise + (place.middle + spring.at) * rotation);
        let elastic = spring.stiffness * sunk;
        let most = bearing.map_or(elastic, |bearing| {
            let strength = bearing.strength * spring.area;
            elastic.min(strength + bearing.hardening * (elastic - strength))
        });
        most.max(0.0)
    };
    let (mut low, mut high) = (-1.0, 1.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        let borne: f64 = bed.iter().map(|bed| force(bed, middle)).sum();
        if borne > weight {
            low = middle;
        } else {
            high = middle;
        }
    }
    let moment = bed
        .iter()
        .map(|bed| -force(bed, low) * (place.middle + bed.at));
    [low, moment.sum::<f64>() + skew]
}

/// Moment and rise over the rotation: linear until the edge lifts, then falling slopes towards W b; two springs reach W b at once.
#[test]
fn a_foundation_lifts_along_its_static_curve() {
    let uneven = framed("A", frame(2, &[6.0, 3.0]));
    let bearing = BearingStrength {
        strength: 600e3,
        hardening: 0.05,
    };
    let cases = [
        (stick(), on_springs(2), None),
        (stick(), on_springs(5), None),
        (tower("A", 3, 40e3, 0.5), on_springs(11), None),
        (
            uneven.clone(),
            Uplift {
                ends: Some(3.0),
                ..on_springs(6)
            },
            None,
        ),
        (stick(), on_springs(7), Some(bearing)),
    ];
    let rotations: Vec<f64> = (1..=24).map(|k| 2.5e-4 * f64::from(k)).collect();
    for (index, (building, uplift, bearing)) in cases.into_iter().enumerate() {
        let model = alone(lifting(building, Uplift { bearing, ..uplift }));
        let system = assembled(&model);
        let building = &system.buildings[0];
        let foundation = building.foundation.expect("it stands on one").foundation;
        let bed = foundation.bed(3e8, None).expect("sound");
        let start = by_bisection(building, &bed, bearing, 0.0)[1];
        for (rotation, [rise, moment]) in rotations.iter().zip(by_path(building, &rotations)) {
            // Under weight alone an uneven building has turned already.
            let settled = building.rest.displacement[building.foundation.expect("one").turning];
            let due = by_bisection(building, &bed, bearing, rotation + settled);
            let (scale, what) = (3e6, format!("case {index} at {rotation}"));
            close(rise, due[0], 1e-2, 1e-8, &what);
            close(moment, due[1], scale, 1e-8, &what);
        }
        if index < 2 {
            assert!(start.abs() < 1e-3, "{start}");
        }
    }
}

/// Two springs under 160 t, as computed elsewhere.
#[test]
fn two_springs_bear_the_weight_times_half_their_distance() {
    let system = assembled(&alone(lifting(stick(), on_springs(2))));
    let found = by_path(&system.buildings[0], &[5e-4, 2.5e-3, 3e-3, 6e-3]);
    let due = [
        [-0.005_230_213_3, 486_000.0],
        [-0.005_230_213_3, 2_430_000.0],
        [-0.005_060_426_7, 2_824_315.2],
        [0.000_339_573_33, 2_824_315.2],
    ];
    for (found, due) in found.into_iter().zip(due) {
        close(found[0], due[0], 5e-3, 2e-8, "rise");
        close(found[1], due[1], due[1], 1e-9, "moment");
    }
}

fn floors(outcome: &Outcome, count: usize) -> Vec<f64> {
    let floors = (1..=count).flat_map(|floor| column(outcome, Column::displacement(0, floor)));
    floors.collect()
}

fn scaled(scale: f64, duration: f64) -> GroundMotion {
    let mut motion = shaking(duration);
    motion.scale *= scale;
    motion
}

/// Under weak shaking the edges stay down: the foundation then rocks on Σk and Σkx² like one that is held down.
#[test]
fn what_stays_in_contact_is_a_foundation_on_springs() {
    let even = framed("A", frame(3, &[5.0, 5.0]));
    for building in [tower("A", 3, 40e3, 0.5), even] {
        let ground = GroundSprings {
            sway: Some([2e8, 1.5e6]),
            vertical_stiffness: 1e9,
            ..GROUND
        };
        let uplift = Uplift {
            ground: Some(ground),
            ..Uplift::with_springs(4)
        };
        let free = lifting(building.clone(), uplift);
        let foundation = free.base.foundation.expect("one");
        let bed = foundation.bed(1e9, None).expect("sound");
        let turned: f64 = bed.iter().map(|bed| bed.stiffness * bed.at * bed.at).sum();
        let matrix = |uu: f64, tt: f64| vec![vec![uu, 0.0], vec![0.0, tt]];
        let mut held = alone(building);
        held.buildings[0].base.foundation = Some(Foundation {
            uplift: None,
            ..foundation
        });
        held.soil = Some(Soil {
            half_space: None,
            coupling: SoilCoupling::Given {
                stiffness: matrix(2e8, turned),
                damping: matrix(1.5e6, 2e6 / 1e9 * turned),
            },
        });
        let motion = scaled(0.02, 3.0);
        let [a, b] = [alone(free), held].map(|model| {
            let system = assembled(&model);
            let period = system.buildings[0].foundation.expect("one").period;
            (period, run(&system, &motion, &steps(1e-3, 1)))
        });
        close(a.0, b.0, b.0, 1e-9, "period");
        let [found, due] = [&a.1, &b.1].map(|outcome| floors(outcome, 3));
        assert!(difference(&found, &due) < 1e-8);
        let rocked = a.1.peaks.owned_by(Owner::Foundation(0)).turning();
        assert!(rocked.displacement().size() > 1e-6);
    }
}

/// Strong shaking lifts the edges; both solvers agree, energies balance, and left and right can be exchanged.
#[test]
fn lifting_buildings_balance_their_energies_and_mirror() {
    let even = framed("A", frame(3, &[5.0, 5.0]));
    let mut uneven = framed("A", frame(2, &[6.0, 3.0]));
    if let Structure::Frame(frame) = &mut uneven.structure {
        frame.axial.columns_flexible = true;
        for column in &mut frame.columns {
            column.axial_rigidity = Some(5e9);
        }
    }
    let swaying = GroundSprings {
        sway: Some([2e8, 1.5e6]),
        ..GROUND
    };
    let bearing = BearingStrength {
        strength: 700e3,
        hardening: 0.1,
    };
    let yielding = Uplift {
        ground: Some(swaying),
        bearing: Some(bearing),
        ..Uplift::with_springs(5)
    };
    for (building, uplift) in [
        (stick(), on_springs(2)),
        (tower("A", 3, 40e3, 0.5), yielding),
        (even, on_springs(3)),
        (uneven, yielding),
    ] {
        let count = building.floors();
        let mut building = lifting(building, uplift);
        building.damping = Damping::Rayleigh {
            alpha: 0.3,
            beta: 1e-3,
        };
        let mut other = building.clone();
        if let Structure::Frame(frame) = &mut other.structure {
            frame.spans.reverse();
        }
        let motion = scaled(1.0, 4.0);
        let mirrored = scaled(-1.0, 4.0);
        let [a, b] = [(building, &motion), (other, &mirrored)].map(|(building, motion)| {
            let system = assembled(&alone(building));
            let outcome = run(&system, motion, &steps(5e-4, 1));
            let imbalance = outcome.energy.worst_imbalance;
            assert!(imbalance < 1e-6, "{imbalance:e}");
            let direct = jostle::Plan {
                solver: Solver::Stiffness,
                ..steps(5e-4, 1)
            };
            let again = run(&system, motion, &direct);
            let [x, y] = [&outcome, &again].map(|outcome| floors(outcome, count));
            assert!(difference(&x, &y) < 1e-7, "{}", difference(&x, &y));
            let lifted = outcome.peaks.owned_by(Owner::Spring(0));
            assert!(lifted.of(jostle::history::Kind::Lifted).greatest.value > 0.05);
            x
        });
        let b: Vec<f64> = b.into_iter().map(|value| -value).collect();
        assert!(difference(&a, &b) < 1e-7, "{}", difference(&a, &b));
    }
}

/// Springs without stiffness between two that bear everything change nothing.
#[test]
fn what_bears_nothing_changes_nothing() {
    let ends = Uplift {
        ends: Some(1e13),
        ..on_springs(5)
    };
    let [a, b] = [on_springs(2), ends].map(|uplift| {
        let system = assembled(&alone(lifting(stick(), uplift)));
        floors(&run(&system, &scaled(1.0, 3.0), &steps(1e-3, 1)), 1)
    });
    assert!(difference(&a, &b) < 1e-9, "{}", difference(&a, &b));
}

/// Damping relative to the foundation does not act on a rigid motion of it, up, sideways or turning; relative to the ground it does.
#[test]
fn damping_is_relative_to_what_it_says() {
    let ground = GroundSprings {
        sway: Some([2e8, 0.0]),
        vertical_damping: 0.0,
        ..GROUND
    };
    let uplift = Uplift {
        ground: Some(ground),
        ..Uplift::with_springs(3)
    };
    let uneven = framed("A", frame(2, &[6.0, 3.0]));
    for building in [stick(), tower("A", 3, 40e3, 0.5), uneven] {
        for damped in [MassDamping::Support, MassDamping::Ground] {
            let mut building = lifting(building.clone(), uplift);
            building.damping = Damping::Rayleigh {
                alpha: 0.4,
                beta: 0.0,
            };
            building.mass_damping = damped;
            let system = assembled(&alone(building));
            let building = &system.buildings[0];
            let nodes = &building.discretization.stick_model.nodes;
            let base = building.discretization.stick_model.foundation.as_ref();
            let base = nodes[base.expect("one").node];
            let (sway, rise, turned) = (0.3, 0.2, 0.02);
            let mut rigid = vec![0.0; building.equations.len()];
            for (index, node) in nodes.iter().enumerate() {
                let moves = [
                    (building.equations.horizontal(index), sway - node.y * turned),
                    (
                        building.equations.vertical(index),
                        rise + (node.x - base.x) * turned,
                    ),
                    (building.equations.rotation(index), turned),
                ];
                for (dof, value) in moves {
                    if let Some(dof) = dof {
                        rigid[dof] = value;
                    }
                }
            }
            let mass = building.equations.mass.iter().zip(&rigid);
            let inertia: f64 = mass.map(|(m, v)| m * v * v).sum();
            let found = 0.4 * inertia + building.equations.dashpots.quadratic_form(&rigid);
            let due = match damped {
                MassDamping::Support => 0.0,
                MassDamping::Ground => 0.4 * inertia,
            };
            close(found, due, 0.4 * inertia, 1e-12, "damped");
        }
    }
}

/// Two sticks that rock beside each other and meet: impacts are found, energies balance, and the mirror agrees.
#[test]
fn rocking_neighbours_pound() {
    let mut right = stick();
    right.name = "B".to_owned();
    if let Structure::Frame(frame) = &mut right.structure {
        frame.floor_mass = vec![60e3];
    }
    let pair = |motion: &GroundMotion, swapped: bool| {
        let mut buildings: Vec<Building> = [stick(), right.clone()]
            .into_iter()
            .map(|building| lifting(building, on_springs(4)))
            .collect();
        if swapped {
            buildings.reverse();
        }
        let mut model = row(buildings, 0.05, law(LawKind::Kelvin, 0.65));
        model.gaps = vec![Gap::after(0, 0.05, law(LawKind::Kelvin, 0.65))];
        let system = assembled(&model);
        run(&system, motion, &steps(5e-4, 10))
    };
    let [a, b] = [(scaled(0.8, 4.0), false), (scaled(-0.8, 4.0), true)]
        .map(|(motion, swapped)| pair(&motion, swapped));
    assert!(a.impacts.len() > 2, "{}", a.impacts.len());
    assert_eq!(a.impacts.len(), b.impacts.len());
    for (a, b) in a.impacts.iter().zip(&b.impacts) {
        close(a.peak_force, b.peak_force, b.peak_force, 1e-5, "impact");
    }
    assert!(a.energy.worst_imbalance < 1e-6);
}

/// Columns whose feet stay down stand on springs; strong shaking lifts them, and the ground never pulls.
#[test]
fn feet_of_columns_bear_compression_alone() {
    let on_springs = |uplift: bool| {
        let mut building = framed("A", frame(3, &[5.0]));
        building.base = Base {
            vertical_stiffness: Some(4e8),
            vertical_damping: 1e6,
            mass: 5e3,
            uplift,
            ..Base::default()
        };
        building.gravity.preload = true;
        assembled(&alone(building))
    };
    let [held, free] = [false, true].map(on_springs);
    let weak =
        [&held, &free].map(|system| floors(&run(system, &scaled(0.05, 3.0), &steps(1e-3, 1)), 3));
    assert!(difference(&weak[0], &weak[1]) < 1e-8);
    let strong = run(&free, &scaled(2.0, 3.0), &steps(1e-3, 1));
    assert!(strong.energy.worst_imbalance < 1e-6);
    let springs = strong.state.springs.iter();
    assert!(springs.clone().all(|own| own.force() <= 0.0));
    let lifted = |side: usize| {
        let peaks = strong.peaks.owned_by(Owner::Spring(side));
        peaks.of(jostle::history::Kind::Lifted).greatest.value
    };
    assert!(lifted(0) > 0.0 && lifted(1) > 0.0);
}

/// Parts name the foundation with its uplift, pressure and settlement.
#[test]
fn parts_say_how_far_it_lifts_and_settles() {
    let bearing = BearingStrength {
        strength: 400e3,
        hardening: 0.1,
    };
    let uplift = Uplift {
        bearing: Some(bearing),
        ..on_springs(5)
    };
    let model = alone(lifting(stick(), uplift));
    let (system, outcome, summary) = run_and_summary(&model, &scaled(1.0, 3.0));
    let [part] = &summary.buildings[0].parts[..] else {
        panic!("one part")
    };
    assert_eq!((&part.name[..], part.kind), ("A.footing", "footing"));
    let memories = &outcome.state.springs;
    let settled = system.buildings[0].equations.springs.iter().zip(memories);
    let settled = settled.map(|(spring, memory)| spring.hysteresis.settlement(memory));
    let settled = settled.fold(0.0, f64::max);
    assert!(settled > 1e-4);
    assert_eq!(part.settlement_m, Some(settled));
    assert!(part.pressure_max_pa.expect("known") > 400e3);
    assert!(part.dissipated_j > 0.0 && part.force_max_n == 0.0);
    let share = part.lifted_share.expect("it lifts");
    assert!(share > 0.02 && share < 0.9, "{share}");
    assert_eq!(summary.buildings[0].hinges.total, 0);
}

/// On a half-space both sums are its own, at the period that they give.
#[test]
fn a_half_space_gives_both_sums() {
    let half_space = HalfSpace {
        shear_wave_velocity: 200.0,
        density: 1800.0,
        poisson_ratio: 0.33,
        damping: 0.0,
    };
    let mut model = alone(tower("A", 3, 40e3, 0.5));
    model.soil = Some(Soil {
        half_space: Some(half_space),
        coupling: SoilCoupling::None,
    });
    let foundation = Foundation {
        uplift: Some(Uplift::with_springs(9)),
        ..Foundation::rectangle(12.0, 12.0, 60e3)
    };
    model.buildings[0].base.foundation = Some(foundation);
    model.buildings[0].gravity.preload = true;
    let system = assembled(&model);
    let building = &system.buildings[0];
    let place = building.foundation.expect("one");
    let due = half_space.springs(&foundation, place.period);
    let bed = &building.discretization.stick_model.bed;
    let vertical: f64 = bed.iter().map(|bed| bed.stiffness).sum();
    let turned: f64 = bed.iter().map(|bed| bed.stiffness * bed.at * bed.at).sum();
    close(
        vertical,
        due.vertical_stiffness,
        vertical,
        1e-10,
        "vertical",
    );
    close(turned, due.rocking_stiffness, turned, 1e-10, "rocking");
    // The weight sinks by W/K_z.
    let sunk = -building.rest.displacement[place.rise.expect("it lifts")];
    let weight = STANDARD_GRAVITY * building.equations.total_mass();
    close(sunk, weight / vertical, sunk, 1e-12, "sinking");
    // Springs and dashpots of a rectangle as another program computes them, at 0.6 s.
    let there = half_space.springs(&foundation, 0.6);
    close(
        there.vertical_stiffness,
        3_012_677_553.775,
        3e9,
        1e-12,
        "K_z",
    );
    close(there.vertical_damping, 102_914_823.490_7, 1e8, 1e-12, "c_z");
}

#[test]
fn what_cannot_lift_is_refused() {
    type Change = (&'static str, &'static str, fn(&mut Model));
    let changes: [Change; 8] = [
        ("building[0].gravity", "no weight holds it down", |model| {
            model.buildings[0].gravity.preload = false;
        }),
        ("building[0].foundation.springs", "between 2 and", |model| {
            uplift(model).springs = 1;
        }),
        (
            "building[0].foundation.ends",
            "greater than zero",
            |model| {
                uplift(model).ends = Some(0.0);
            },
        ),
        (
            "building[0].foundation",
            "add vertical_stiffness",
            |model| {
                uplift(model).ground = None;
            },
        ),
        (
            "building[0].foundation.vertical_stiffness",
            "greater than zero",
            |model| {
                uplift(model).ground = Some(GroundSprings {
                    vertical_stiffness: 0.0,
                    ..GROUND
                });
            },
        ),
        (
            "building[0].foundation.bearing_hardening",
            "less than 1",
            |model| {
                uplift(model).bearing = Some(BearingStrength {
                    strength: 1e5,
                    hardening: 1.0,
                });
            },
        ),
        ("building[0].damping.relative_to", "leave it out", |model| {
            model.buildings[0].base.foundation = None;
            model.buildings[0].mass_damping = MassDamping::Ground;
        }),
        ("analysis.solver", "riccati", |model| {
            model.analysis.solver = Some(Solver::Modal);
        }),
    ];
    for (path, words, change) in changes {
        let mut model = alone(lifting(stick(), on_springs(2)));
        assert!(model.check().is_ok());
        change(&mut model);
        let faults = model.check().expect_err(path);
        let named =
            |fault: &jostle::ModelFault| fault.path == path && fault.problem.contains(words);
        assert!(faults.iter().any(named), "{path}: {faults:?}");
    }
    let coupled = SoilCoupling::Given {
        stiffness: vec![vec![1e9, 0.0], vec![0.0, 1e9]],
        damping: vec![vec![0.0; 2]; 2],
    };
    let mut model = alone(lifting(stick(), Uplift::with_springs(3)));
    model.soil = Some(Soil {
        half_space: None,
        coupling: coupled,
    });
    let faults = model.check().expect_err("coupled");
    let named =
        |fault: &jostle::ModelFault| fault.problem.contains("leave out coupling, or uplift");
    assert!(faults.iter().any(named), "{faults:?}");
}

fn uplift(model: &mut Model) -> &mut Uplift {
    let foundation = model.buildings[0].base.foundation.as_mut();
    foundation.expect("one").uplift.as_mut().expect("it lifts")
}
