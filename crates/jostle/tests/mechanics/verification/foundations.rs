//! Buildings on rigid foundations on soil: the same building by its matrices, equilibrium and rigid motion in closed form.

use std::f64::consts::PI;

use jostle::history::Owner;
use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
use jostle::linear::StepMatrix;
use jostle::stiffness::DirectStiffness;
use jostle::structure::solve_once;
use jostle::system::BuildingSystem;
use jostle::{
    Axial, Base, Building, Column, Damping, FloorPairs, Foundation, Gap, Given, HalfSpace, Hinges,
    LawKind, Level, Link, LinkLaw, Model, RiccatiSweep, Shear, Soil, SoilCoupling, Solver,
    Structure, System,
};
use jostle_testkit::models::UNDAMPED;

use crate::verification::monolith::monolith;
use crate::verification::support::{
    assembled, column, difference, frame, framed, largest, law, row, run, shaking, steps, tower,
};

const SOIL: HalfSpace = HalfSpace {
    shear_wave_velocity: 180.0,
    density: 1900.0,
    poisson_ratio: 0.35,
    damping: 0.03,
};

/// The model on this soil, every building on a foundation.
fn on_soil(mut model: Model, foundation: Foundation, coupling: SoilCoupling) -> Model {
    for building in &mut model.buildings {
        building.base = Base {
            foundation: Some(foundation),
            ..Base::default()
        };
    }
    model.soil = Some(Soil {
        half_space: Some(SOIL),
        coupling,
    });
    model
}

fn alone(building: Building) -> Model {
    row(vec![building], 0.0, law(LawKind::Linear, 1.0))
}

fn embedded() -> Foundation {
    Foundation {
        embedment: 1.5,
        ..Foundation::rectangle(14.0, 9.0, 90e3)
    }
}

/// Three storeys of different heights.
fn three_storeys() -> Building {
    Building {
        structure: Structure::Shear(Shear {
            mass: vec![50e3, 40e3, 30e3],
            stiffness: vec![90e6, 70e6, 50e6],
            storey_heights: vec![4.0, 3.0, 3.5],
        }),
        damping: Damping::Rayleigh {
            alpha: 0.6,
            beta: 1.2e-3,
        },
        ..tower("A", 3, 1.0, 1.0)
    }
}

/// The same building as matrices over u₁, u₂, u₃, u_f, θ, written down from w_i = u_i − u_f + h_i θ.
fn by_matrices(building: &BuildingSystem) -> Building {
    let Building {
        structure: Structure::Shear(shear),
        damping: Damping::Rayleigh { alpha, beta },
        ..
    } = three_storeys()
    else {
        panic!("it is a shear building");
    };
    let place = building.foundation.expect("it stands on one");
    let heights = [4.0, 7.0, 10.5];
    let mut stiffness = [[0.0; 5]; 5];
    let mut damping = [[0.0; 5]; 5];
    let add = |matrix: &mut [[f64; 5]; 5], form: [f64; 5], value: f64| {
        for (row, a) in matrix.iter_mut().zip(form) {
            for (entry, b) in row.iter_mut().zip(form) {
                *entry += value * a * b;
            }
        }
    };
    let w = |floor: usize| {
        let mut form = [0.0, 0.0, 0.0, -1.0, heights[floor]];
        form[floor] = 1.0;
        form
    };
    for floor in 0..3 {
        let mut storey = w(floor);
        if floor > 0 {
            storey = std::array::from_fn(|k| storey[k] - w(floor - 1)[k]);
        }
        add(&mut stiffness, storey, shear.stiffness[floor]);
        add(&mut damping, storey, beta * shear.stiffness[floor]);
        add(&mut damping, w(floor), alpha * shear.mass[floor]);
    }
    stiffness[3][3] += place.springs.sway_stiffness;
    stiffness[4][4] += place.springs.rocking_stiffness;
    damping[3][3] += place.springs.sway_damping;
    damping[4][4] += place.springs.rocking_damping;
    let lower = |matrix: [[f64; 5]; 5]| {
        let entries = (0..5).flat_map(|i| (0..=i).map(move |j| (i, j)));
        entries.map(|(i, j)| (i, j, matrix[i][j])).collect()
    };
    let foundation = place.foundation;
    let mut mass = shear.mass;
    mass.extend([foundation.mass, foundation.rotary_inertia]);
    Building {
        name: "A".to_owned(),
        structure: Structure::Given(Given {
            mass,
            stiffness: lower(stiffness),
            damping: lower(damping),
            influence: vec![1.0, 1.0, 1.0, 1.0, 0.0],
            heights: vec![4.0, 7.0, 10.5, 0.0, 0.0],
            floors: vec![0, 1, 2],
            storey_heights: shear.storey_heights,
        }),
        damping: UNDAMPED,
        ..Building::default()
    }
}

#[test]
fn a_shear_building_on_soil_is_the_same_as_by_its_matrices() {
    let model = on_soil(alone(three_storeys()), embedded(), SoilCoupling::None);
    let system = assembled(&model);
    let given = assembled(&alone(by_matrices(&system.buildings[0])));
    for (expected, found) in given.buildings[0]
        .lateral_modes()
        .zip(system.buildings[0].lateral_modes())
    {
        assert!((found.period() / expected.period() - 1.0).abs() < 1e-10);
    }
    let motion = shaking(4.0);
    for solver in [Solver::Riccati, Solver::Stiffness] {
        let plan = jostle::Plan {
            solver,
            ..steps(1e-3, 1)
        };
        let [expected, found] = [&given, &system].map(|system| run(system, &motion, &plan));
        for floor in 1..=3 {
            let of = |outcome| column(outcome, Column::displacement(0, floor));
            assert!(difference(&of(&found), &of(&expected)) < 1e-9);
        }
        let place = system.buildings[0].foundation.expect("it stands on one");
        let there = given.buildings[0].equations.len();
        assert_eq!(there, 5);
        let energies = [found.energy, expected.energy].map(|e| [e.input, e.damped, e.strain]);
        assert!(difference(&energies[0], &energies[1]) < 1e-9);
        assert!(found.energy.worst_imbalance < 1e-9);
        // Storey forces do not know of the foundation; drifts are deformations.
        let [a, b] = [&found, &expected].map(|outcome| {
            outcome
                .peaks
                .floors(0)
                .iter()
                .map(|floor| floor.storey_shear())
                .collect::<Vec<_>>()
        });
        assert!(difference(&a, &b) < 1e-9);
        let lowest = found.peaks.floor(0, 1);
        let deformation = lowest.storey_drift() * 4.0;
        assert!((lowest.storey_shear() / (90e6 * deformation) - 1.0).abs() < 1e-9);
        assert!((found.peaks.base_shear(0) / lowest.storey_shear() - 1.0).abs() < 1e-9);
        let owner = Owner::Foundation(0);
        let peaks = found.peaks.owned_by(owner);
        let swayed = peaks.displacement();
        let rocked = peaks.turning().displacement();
        assert!(swayed.greatest.value > 0.0 && rocked.greatest.value > 0.0);
        let damped = found.peaks.work(owner);
        assert!(damped > 0.0 && damped < found.energy.damped);
        let sway = found.state.displacement[place.sway.expect("it sways")];
        assert!(sway <= swayed.greatest.value && sway >= swayed.least.value);
    }
}

/// Floors under forces to the right, on rigid ground and on soil: u = u_rigid + ΣF/K_x + h ΣFh/K_θ.
#[test]
fn soil_adds_its_own_displacement_under_static_forces() {
    let uneven = framed("A", frame(4, &[6.0, 3.0, 4.5]));
    for building in [three_storeys(), uneven] {
        let heights = building.floor_heights();
        let fixed = assembled(&alone(building.clone()));
        let soft = on_soil(alone(building), embedded(), SoilCoupling::None);
        let system = assembled(&soft);
        let place = system.buildings[0].foundation.expect("it stands on one");
        let forces: Vec<f64> = (0..heights.len()).map(|k| 1e5 * (k as f64 - 0.3)).collect();
        let pushed = |system: &BuildingSystem| {
            let mut load = vec![0.0; system.equations.len()];
            for (floor, force) in system.floors.iter().zip(&forces) {
                load[floor.dof] += force;
            }
            let riccati = solve_once::<RiccatiSweep>(system, &StepMatrix::STATIC, &load);
            let direct = solve_once::<DirectStiffness>(system, &StepMatrix::STATIC, &load);
            let [riccati, direct] = [riccati, direct].map(|found| found.expect("it stands"));
            assert!(difference(&riccati, &direct) < 1e-9);
            let floors = system.floors.iter().map(|floor| riccati[floor.dof]);
            floors.collect::<Vec<f64>>()
        };
        let rigid = pushed(&fixed.buildings[0]);
        let found = pushed(&system.buildings[0]);
        let shear: f64 = forces.iter().sum();
        let moment: f64 = forces.iter().zip(&heights).map(|(f, h)| f * h).sum();
        let expected: Vec<f64> = rigid
            .iter()
            .zip(&heights)
            .map(|(u, h)| {
                u + shear / place.springs.sway_stiffness
                    + h * moment / place.springs.rocking_stiffness
            })
            .collect();
        assert!(
            difference(&found, &expected) < 1e-8,
            "{found:?} {expected:?}"
        );
    }
}

/// A frame so stiff that it moves as a rigid body: two displacements, with the rotary inertia of what rises and sinks.
#[test]
fn a_stiff_frame_rocks_as_a_rigid_body() {
    let mut stiff = frame(3, &[6.0, 3.0]);
    for section in stiff.columns.iter_mut().chain(&mut stiff.beams) {
        section.flexural_rigidity *= 1e6;
    }
    let model = on_soil(alone(framed("A", stiff)), embedded(), SoilCoupling::None);
    let system = assembled(&model);
    let building = &system.buildings[0];
    let place = building.foundation.expect("it stands on one");
    let (mut mass, mut first, mut polar) = (0.0, 0.0, 0.0);
    for node in &building.discretization.stick_model.nodes {
        mass += node.mass();
        first += node.mass() * node.y;
        polar += node.inertia[2] + node.mass() * (node.y.powi(2) + (node.x - 4.5).powi(2));
    }
    let (kx, kt) = (
        place.springs.sway_stiffness,
        place.springs.rocking_stiffness,
    );
    // det(K − λM) = 0 with M = [m −S; −S J].
    let (a, b, c) = (
        mass * polar - first * first,
        -(kx * polar + kt * mass),
        kx * kt,
    );
    let lowest = (-b - (b * b - 4.0 * a * c).sqrt()) / (2.0 * a);
    let expected = 2.0 * PI / lowest.sqrt();
    assert!(
        (place.period / expected - 1.0).abs() < 1e-4,
        "{} {expected}",
        place.period
    );
    assert!(place.period > 3.0 * place.fixed_period);
}

/// Mass-proportional damping does not act on a building that sways and rocks as a rigid body with its foundation.
#[test]
fn damping_is_relative_to_the_foundation() {
    for building in [three_storeys(), framed("A", frame(2, &[6.0, 3.0]))] {
        let model = on_soil(alone(building), embedded(), SoilCoupling::None);
        let system = assembled(&model);
        let building = &system.buildings[0];
        let place = building.foundation.expect("it stands on one");
        assert!(building.equations.alpha > 0.0);
        let nodes = &building.discretization.stick_model.nodes;
        let base = building
            .discretization
            .stick_model
            .foundation
            .as_ref()
            .expect("one");
        let (sway, turned) = (0.3, 0.02);
        let mut rigid = vec![0.0; building.equations.len()];
        for (index, node) in nodes.iter().enumerate() {
            let moves = [
                (building.equations.horizontal(index), sway - node.y * turned),
                (
                    building.equations.vertical(index),
                    (node.x - nodes[base.node].x) * turned,
                ),
                (building.equations.rotation(index), turned),
            ];
            for (dof, value) in moves {
                if let Some(dof) = dof {
                    rigid[dof] = value;
                }
            }
        }
        let inertia: f64 = building
            .equations
            .mass
            .iter()
            .zip(&rigid)
            .map(|(m, v)| m * v * v)
            .sum();
        let strained = building.equations.stiffness.quadratic_form(&rigid);
        let damped = building.equations.alpha * inertia
            + building.equations.beta * strained
            + building.equations.dashpots.quadratic_form(&rigid);
        let soil = place.springs.sway_damping * sway * sway
            + place.springs.rocking_damping * turned * turned;
        assert!((damped / soil - 1.0).abs() < 1e-9, "{damped} {soil}");
        assert!(strained < 1e-9 * place.springs.sway_stiffness);
    }
}

/// Neighbours far apart: K₁₂ = −F₁₂/(F₁₁F₂₂) with F₁₂ = 1/(2πGs).
#[test]
fn static_coupling_is_that_of_the_half_space() {
    let foundation = Foundation::rectangle(12.0, 12.0, 120e3);
    let towers = vec![tower("A", 2, 4e4, 0.4), tower("B", 2, 6e4, 0.5)];
    let mut model = row(towers, 0.02, law(LawKind::HertzDamp, 0.65));
    model.gaps = vec![Gap::after(0, 400.0, law(LawKind::HertzDamp, 0.65))];
    let system = assembled(&on_soil(model, foundation, SoilCoupling::Static));
    assert_eq!(system.soil_links, 2);
    assert!(system.model_links().is_empty());
    let places = [0, 1].map(|k| system.buildings[k].foundation.expect("one"));
    // Rocking is coupled a million times less.
    let coupled = |dofs: [usize; 2]| -> f64 {
        let links = system.links.iter();
        let entry = links.map(|link| {
            let [left, right] = link
                .ports
                .0
                .each_ref()
                .map(|port| port.as_ref().expect("a foundation"));
            let share = |row: &jostle::linear::Row, dof: usize| {
                let entries = row.entries().iter();
                entries
                    .filter(|(candidate, _)| *candidate == dof)
                    .map(|(_, c)| c)
                    .sum::<f64>()
            };
            -link.stiffness * share(&left.row, dofs[0]) * share(&right.row, dofs[1])
        });
        entry.sum()
    };
    let sway = coupled([
        places[0].sway.expect("it sways"),
        places[1].sway.expect("it sways"),
    ]);
    let rocking = coupled([places[0].turning, places[1].turning]);
    let s = 412.0;
    let g = SOIL.shear_modulus();
    let far = 1.0 / (2.0 * PI * g * s);
    let expected = -far * places[0].springs.sway_stiffness * places[1].springs.sway_stiffness;
    assert!((sway / expected - 1.0).abs() < 2e-3, "{sway} {expected}");
    let far = -(1.0 - SOIL.poisson_ratio) / (PI * g * s * s * s);
    let expected = -far * places[0].springs.rocking_stiffness * places[1].springs.rocking_stiffness;
    assert!(
        (rocking / expected - 1.0).abs() < 2e-3,
        "{rocking} {expected}"
    );
}

/// Equal towers beside each other on coupled soil under one motion move alike: the row is as soft as one on soil with the sum of
/// a row of its stiffness matrix.
#[test]
fn equal_neighbours_see_the_sum_of_a_row() {
    let towers = |count: usize| {
        (0..count)
            .map(|k| tower(&format!("T{k}"), 2, 4e4, 0.4))
            .collect::<Vec<_>>()
    };
    let (k, c, t, ct) = (2e9, 5e7, 9e10, 6e7);
    let given = |matrix: Vec<Vec<f64>>, damping: Vec<Vec<f64>>| {
        Some(Soil {
            half_space: None,
            coupling: SoilCoupling::Given {
                stiffness: matrix,
                damping,
            },
        })
    };
    let foundation = Foundation::rectangle(12.0, 12.0, 120e3);
    let mut pair = on_soil(
        row(towers(2), 9.0, law(LawKind::HertzDamp, 0.65)),
        foundation,
        SoilCoupling::None,
    );
    let full = |k: f64, of: f64, t: f64, turned: f64| {
        vec![
            vec![k, 0.0, of, 0.0],
            vec![0.0, t, 0.0, turned],
            vec![of, 0.0, k, 0.0],
            vec![0.0, turned, 0.0, t],
        ]
    };
    pair.soil = given(full(k, -0.5 * k, t, 0.2 * t), full(c, -0.1 * c, ct, 0.0));
    let mut one = on_soil(alone(towers(1).remove(0)), foundation, SoilCoupling::None);
    one.soil = given(
        vec![vec![0.5 * k, 0.0], vec![0.0, 1.2 * t]],
        vec![vec![0.9 * c, 0.0], vec![0.0, ct]],
    );
    let motion = shaking(3.0);
    let [pair, one] = [pair, one].map(|model| {
        let system = assembled(&model);
        let outcome = run(&system, &motion, &steps(1e-3, 1));
        assert!(outcome.energy.worst_imbalance < 1e-9);
        outcome
    });
    for building in 0..2 {
        for floor in 1..=2 {
            let expected = column(&one, Column::displacement(0, floor));
            let found = column(&pair, Column::displacement(building, floor));
            assert!(difference(&found, &expected) < 1e-9);
        }
        let [a, b] = [(&pair, building), (&one, 0)].map(|(run, building)| {
            let turning = run.peaks.owned_by(Owner::Foundation(building)).turning();
            [
                turning.displacement_max().value,
                turning.displacement_min().value,
            ]
        });
        assert!(difference(&a, &b) < 1e-9);
    }
    assert!(
        one.peaks
            .owned_by(Owner::Foundation(0))
            .displacement()
            .size()
            > 0.0
    );
}

/// Storeys that yield on soil that couples their foundations, with impacts, against all displacements at once in full
/// matrices; without yielding as well, and frames.
#[test]
fn condensed_equals_monolithic_on_soil() {
    let foundation = Foundation::rectangle(12.0, 12.0, 120e3);
    let backbone = |stiffness: f64| {
        let corners = Corners::bilinear(0.003, 0.05);
        Backbone::from_deformations(stiffness, corners, corners).expect("sound")
    };
    let yielding = |rule: HysteresisRule| {
        let mut towers = vec![tower("A", 4, 4e4, 0.7), tower("B", 3, 6e4, 0.4)];
        for tower in &mut towers {
            let Structure::Shear(shear) = &tower.structure else {
                panic!("it is a shear building");
            };
            let storeys = shear.stiffness.iter();
            let storeys = storeys.map(|k| Hysteresis::new(rule, backbone(*k)).expect("it fits"));
            tower.hinges = Some(Hinges::Storeys(storeys.collect()));
            tower.gravity.p_delta = true;
        }
        towers
    };
    let mut tall = framed("A", frame(4, &[6.0, 3.0]));
    tall.gravity.p_delta = true;
    for buildings in [
        yielding(HysteresisRule::Bilinear),
        yielding(HysteresisRule::PeakOriented),
        vec![tower("A", 4, 4e4, 0.7), tower("B", 3, 6e4, 0.4)],
        vec![tall, tower("B", 3, 6e4, 0.3)],
    ] {
        let plain = row(buildings, 0.02, law(LawKind::HertzDamp, 0.65));
        let mut model = on_soil(plain, foundation, SoilCoupling::Static);
        let frame_over = model.buildings[0].base.foundation.as_mut().expect("one");
        frame_over.length = 9.0;
        if let Some(soil) = &mut model.soil
            && let Some(half_space) = &mut soil.half_space
        {
            half_space.shear_wave_velocity = 90.0;
        }
        let system = assembled(&model);
        assert_eq!(system.soil_links, 2);
        let motion = shaking(1.6);
        for solver in [Solver::Riccati, Solver::Stiffness] {
            let plan = jostle::Plan {
                solver,
                ..steps(2e-3, 2)
            };
            let outcome = run(&system, &motion, &plan);
            assert!(!outcome.impacts.is_empty());
            let times = column(&outcome, Column::TIME);
            let (peaks, displacement) = monolith(&system, &motion, &times);
            let contacts = 0..system.contacts.len();
            let got: Vec<f64> = contacts
                .map(|contact| largest(&column(&outcome, Column::contact_force(contact))))
                .collect();
            let forces = difference(&got, &peaks[..got.len()]);
            let displacements = difference(&outcome.state.displacement, &displacement);
            assert!(
                forces <= 1e-9 && displacements <= 1e-9,
                "{forces:e} and {displacements:e}"
            );
            assert!(
                outcome.energy.worst_imbalance < 1e-9,
                "{:e}",
                outcome.energy.worst_imbalance
            );
        }
    }
}

/// What cannot stand on a foundation, with the field at fault.
/// Springs and dashpots between floors of a building on soil are the same as a stiffer storey with that damping: the building that rocks
/// as a rigid body does not deform them.
#[test]
fn links_between_floors_on_soil_are_part_of_their_storeys() {
    const BETA: f64 = 1.2e-3;
    let building = |stiffness: Vec<f64>| {
        let Building {
            structure: Structure::Shear(shear),
            ..
        } = three_storeys()
        else {
            panic!("it is a shear building");
        };
        Building {
            structure: Structure::Shear(Shear { stiffness, ..shear }),
            damping: Damping::Rayleigh {
                alpha: 0.0,
                beta: BETA,
            },
            ..three_storeys()
        }
    };
    let soil = SoilCoupling::Given {
        stiffness: vec![vec![9e8, -2e8], vec![-2e8, 1.1e10]],
        damping: vec![vec![2e7, 0.0], vec![0.0, 9e7]],
    };
    let stiff = on_soil(
        alone(building(vec![90e6, 95e6, 50e6])),
        embedded(),
        soil.clone(),
    );
    let mut linked = on_soil(alone(building(vec![60e6, 70e6, 50e6])), embedded(), soil);
    for (pair, stiffness) in [([0, 1], 30e6), ([2, 1], 25e6)] {
        linked.links.push(Link {
            between: [Some(0); 2],
            floors: FloorPairs::Listed(vec![pair.map(Level::Floor)]),
            level_tolerance: 1e-3,
            stiffness,
            damping: BETA * stiffness,
            law: LinkLaw::Linear,
            ..Link::default()
        });
    }
    let (motion, plan) = (shaking(4.0), steps(1e-3, 1));
    let [expected, found] = [&stiff, &linked].map(|model| run(&assembled(model), &motion, &plan));
    for floor in 1..=3 {
        let of = |outcome| column(outcome, Column::displacement(0, floor));
        assert!(difference(&of(&found), &of(&expected)) < 1e-9);
    }
    let rocking = [&found, &expected].map(|outcome| {
        let turning = outcome.peaks.owned_by(Owner::Foundation(0)).turning();
        turning.displacement_max().value
    });
    assert!((rocking[0] / rocking[1] - 1.0).abs() < 1e-9 && rocking[1] > 1e-4);
}

#[test]
fn unsound_foundations_are_refused() {
    let good = || {
        on_soil(
            row(
                vec![tower("A", 2, 4e4, 0.4), tower("B", 2, 6e4, 0.5)],
                0.02,
                law(LawKind::HertzDamp, 0.65),
            ),
            Foundation::rectangle(12.0, 12.0, 120e3),
            SoilCoupling::Static,
        )
    };
    assert!(System::assemble(&good()).is_ok());
    type Change = (&'static str, fn(&mut Model));
    let changes: [Change; 14] = [
        ("building[0].foundation", |model| model.soil = None),
        ("soil.poisson_ratio", |model| {
            half_space(model).poisson_ratio = 0.5;
        }),
        ("soil.shear_wave_velocity", |model| {
            half_space(model).shear_wave_velocity = 0.0;
        }),
        ("soil.density", |model| half_space(model).density = f64::NAN),
        ("building[1].foundation", |model| {
            model.buildings[1].base.horizontal_stiffness = Some(1e9);
        }),
        ("building[0].foundation.mass", |model| {
            foundation(model).mass = 0.0;
        }),
        ("building[0].foundation.embedment", |model| {
            foundation(model).embedment = 1.0;
        }),
        ("building[0].foundation.length", |model| {
            foundation(model).length = -1.0;
        }),
        ("soil.coupling", |model| model.gaps.clear()),
        ("analysis.solver", |model| {
            model.analysis.solver = Some(Solver::Modal);
        }),
        ("soil.coupling.stiffness", |model| {
            give(model, vec![vec![1e9; 2]; 2]);
        }),
        ("soil.coupling.stiffness[0][1]", |model| {
            let mut matrix = diagonal(1e9);
            matrix[0][1] = 1e6;
            give(model, matrix);
        }),
        ("soil.coupling.stiffness", |model| {
            let mut matrix = diagonal(1e9);
            (matrix[0][2], matrix[2][0]) = (1.1e9, 1.1e9);
            give(model, matrix);
        }),
        ("building[1].foundation.length", |model| {
            for building in &mut model.buildings {
                building.structure = Structure::Frame(frame(2, &[5.0]));
            }
        }),
    ];
    for (path, change) in changes {
        let mut model = good();
        change(&mut model);
        let faults = System::assemble(&model).expect_err(path);
        assert!(
            faults.iter().any(|fault| fault.path == path),
            "{path}: {faults:?}"
        );
    }
    let mut flexible = frame(2, &[11.9]);
    flexible.axial = Axial {
        columns_flexible: true,
        beams_flexible: false,
    };
    let model = on_soil(alone(framed("A", flexible)), embedded(), SoilCoupling::None);
    assert!(System::assemble(&model).is_err());
}

fn half_space(model: &mut Model) -> &mut HalfSpace {
    let soil = model.soil.as_mut().expect("it has soil");
    soil.half_space.as_mut().expect("a half-space")
}

fn foundation(model: &mut Model) -> &mut Foundation {
    let foundation = model.buildings[0].base.foundation.as_mut();
    foundation.expect("it has a foundation")
}

fn diagonal(value: f64) -> Vec<Vec<f64>> {
    (0..4)
        .map(|i| (0..4).map(|j| if i == j { value } else { 0.0 }).collect())
        .collect()
}

fn give(model: &mut Model, stiffness: Vec<Vec<f64>>) {
    let soil = model.soil.as_mut().expect("it has soil");
    soil.coupling = SoilCoupling::Given {
        stiffness,
        damping: diagonal(1e6),
    };
}
