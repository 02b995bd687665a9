//! Ends of columns made of fibres: elastic ones as springs of a base, other solvers, mirrored and split models; and loads of floors.

use std::collections::BTreeMap;
use std::sync::Arc;

use jostle::hysteresis::{Backbone, ConcreteFall, Corners, Hysteresis, HysteresisRule, Stage};
use jostle::statics::{STANDARD_GRAVITY, compressions};
use jostle::{
    Base, Building, ColumnFibres, Damping, Fibre, FibreLimit, FibreMaterial, Frame, FrameHinges,
    Gravity, Hinges, Model, Outcome, Plan, Run, Solver, Summary, System,
};
use jostle_testkit::compare::close;
use jostle_testkit::motions::fading;

use crate::verification::support::{assembled, frame, framed, largest, run, steps};

/// Twelve layers of concrete and three rows of bars, more of them on the right if it leans.
pub(super) fn fibres(leans: bool) -> ColumnFibres {
    let (length, depth, width) = (0.35, 0.5, 0.5);
    let layer = depth / 12.0;
    let fall = ConcreteFall {
        residual: 0.2,
        ultimate: 3.0,
    };
    let concrete = Hysteresis::concrete(25e6 * width * layer, 0.002 * length, fall).expect("sound");
    let layers = (0..12).map(|number| Fibre {
        at: [(f64::from(number) + 0.5) * layer - 0.5 * depth, 0.0],
        spring: concrete,
        material: FibreMaterial::Cover,
    });
    let bars = |at: f64, area: f64| {
        let corners = Corners::bilinear(420e6 * area, 0.01);
        let backbone = Backbone::from_forces(200e9 * area / length, corners, corners);
        let spring = Hysteresis::new(HysteresisRule::Bilinear, backbone.expect("sound"));
        Fibre {
            at: [at, 0.0],
            spring: spring.expect("sound"),
            material: FibreMaterial::Bar,
        }
    };
    let more = if leans { 1.4e-3 } else { 1e-3 };
    let bars = [bars(-0.2, 1e-3), bars(0.0, 6e-4), bars(0.2, more)];
    ColumnFibres {
        length,
        at_ends: [true, true],
        fibres: layers.chain(bars).collect(),
        limits: BTreeMap::new(),
    }
}

/// The same, seen from the other side.
fn mirrored(column_fibres: &ColumnFibres) -> ColumnFibres {
    let fibres = column_fibres.fibres.iter().rev().map(|fibre| Fibre {
        at: fibre.at.map(|at| -at),
        ..*fibre
    });
    ColumnFibres {
        fibres: fibres.collect(),
        ..column_fibres.clone()
    }
}

/// Fibres in every column of a frame that shortens and stands under its weight.
pub(super) fn model(mut frame: Frame, fibres: &ColumnFibres) -> Model {
    frame.axial.columns_flexible = true;
    let places = frame.all_columns().map(|(place, _)| place);
    let hinges = FrameHinges {
        fibres: places.map(|place| (place, fibres.clone())).collect(),
        ..FrameHinges::default()
    };
    Model {
        buildings: vec![Building {
            hinges: Some(Hinges::Frame(hinges)),
            gravity: Gravity {
                preload: true,
                p_delta: true,
            },
            damping: Damping::Rayleigh {
                alpha: 0.4,
                beta: 1e-3,
            },
            ..framed("A", frame)
        }],
        ..Model::default()
    }
}

/// Two storeys; spans differ, so that the mirror image is another frame.
pub(super) fn two_storeys() -> Frame {
    let mut frame = frame(2, &[6.0, 4.5]);
    frame.floor_load = vec![300e3, 200e3];
    frame
}

/// In fixed steps: what is compared differs by rounding alone.
pub(super) fn shaken(model: &Model, sign: f64) -> (System, Outcome) {
    let motion = fading("along", 9.0, [sign * 1.8, 3.0], 150);
    let system = assembled(model);
    let plan = Plan {
        solver: model.analysis.solver.unwrap_or(Solver::Riccati),
        ..steps(1e-3, 1)
    };
    let outcome = run(&system, &motion, &plan);
    let imbalance = outcome.energy.worst_imbalance;
    assert!(imbalance < 1e-4, "{imbalance:e}");
    (system, outcome)
}

/// Greatest and least displacements of floors, then axial force and moment of every section.
pub(super) fn answers((system, outcome): &(System, Outcome)) -> [Vec<[f64; 2]>; 3] {
    let floors = outcome.peaks.floors(0);
    let moved = floors.iter().map(|floor| {
        [
            floor.displacement_max().value,
            floor.displacement_min().value,
        ]
    });
    let forces = |kind: usize| {
        let sections = system.buildings[0].members.sections.iter();
        sections
            .map(|section| outcome.members[0][section[kind]])
            .collect()
    };
    [moved.collect(), forces(0), forces(1)]
}

pub(super) fn agree(a: &[[f64; 2]], b: &[[f64; 2]], tolerance: f64, what: &str) {
    assert_eq!(a.len(), b.len());
    let scale = largest(&b.concat());
    for (a, b) in a.concat().into_iter().zip(b.concat()) {
        close(a, b, scale, tolerance, what);
    }
}

/// Riccati's recursion and the stiffness matrix share nothing but the elements.
#[test]
fn both_solvers_agree_while_bars_yield_and_concrete_crushes() {
    let [a, b] = [Solver::Riccati, Solver::Stiffness].map(|solver| {
        let mut model = model(two_storeys(), &fibres(true));
        model.analysis.solver = Some(solver);
        shaken(&model, 1.0)
    });
    let springs = &a.0.buildings[0].equations.springs;
    let reached = |is_concrete: bool| {
        let springs = springs.iter().zip(&a.1.state.springs);
        let pairs = springs.filter(|(spring, _)| {
            matches!(spring.hysteresis.rule(), HysteresisRule::Concrete(_)) == is_concrete
        });
        pairs
            .filter(|(spring, memory)| spring.hysteresis.stage(memory) == Stage::Yielded)
            .count()
    };
    let (yielded, crushed) = (reached(false), reached(true));
    assert!(yielded > 5 && crushed > 5, "{yielded} and {crushed}");
    for (what, (a, b)) in ["floors", "axial forces", "moments"]
        .into_iter()
        .zip(answers(&a).into_iter().zip(answers(&b)))
    {
        agree(&a, &b, 1e-6, what);
    }
}

/// The mirror image of a building answers the mirror image of a motion alike.
#[test]
fn a_mirrored_frame_mirrors_its_answer() {
    let original = shaken(&model(two_storeys(), &fibres(true)), 1.0);
    let mut image = two_storeys();
    image.spans.reverse();
    image.beam_segments.reverse();
    let image = shaken(&model(image, &mirrored(&fibres(true))), -1.0);
    let ([floors, axial, moments], [a, b, c]) = (answers(&original), answers(&image));
    let exchanged = |all: &[[f64; 2]]| -> Vec<[f64; 2]> {
        all.iter().map(|[most, least]| [-least, -most]).collect()
    };
    agree(&floors, &exchanged(&a), 1e-6, "floors");
    // Three columns of two ends each, from the other side.
    let reversed = |all: &[[f64; 2]]| -> Vec<[f64; 2]> {
        let columns = all.chunks(6).map(|storey| storey.chunks(2).rev().flatten());
        columns.flatten().copied().collect()
    };
    agree(&axial, &reversed(&b), 1e-6, "axial forces");
    agree(&moments, &exchanged(&reversed(&c)), 1e-6, "moments");
}

/// Two fibres of half the area are one.
#[test]
fn halves_of_fibres_are_the_whole() {
    let whole = fibres(false);
    let halved: Arc<[Fibre]> = whole
        .fibres
        .iter()
        .flat_map(|fibre| {
            let curve = fibre
                .spring
                .backbone()
                .side(jostle::hysteresis::Side::Negative);
            let spring = match fibre.spring.rule() {
                HysteresisRule::Concrete(fall) => {
                    let top = curve.yielding;
                    Hysteresis::concrete(0.5 * top.force, top.deformation, fall)
                }
                rule => {
                    let corners = Corners::bilinear(0.5 * curve.yielding.force, 0.01);
                    let initial = 0.5 * fibre.spring.backbone().initial();
                    let backbone = Backbone::from_forces(initial, corners, corners);
                    Hysteresis::new(rule, backbone.expect("sound"))
                }
            };
            let spring = spring.expect("sound");
            [Fibre { spring, ..*fibre }; 2]
        })
        .collect();
    let halves = ColumnFibres {
        fibres: halved,
        ..whole.clone()
    };
    let [a, b] = [whole, halves]
        .map(|column_fibres| answers(&shaken(&model(two_storeys(), &column_fibres), 1.0)));
    for (a, b) in a.iter().zip(&b) {
        agree(a, b, 1e-6, "halves");
    }
}

/// Elastic fibres at the feet are the springs of a base: Σ k vertically and Σ k x² in rotation.
#[test]
fn elastic_fibres_at_the_feet_are_springs_of_a_base() {
    let (stiffness, places) = (2e9, [-0.2, -0.05, 0.1, 0.15]);
    let spring = Hysteresis::elastic(stiffness).expect("sound");
    let fibres = ColumnFibres {
        length: 0.3,
        at_ends: [true, false],
        fibres: places
            .iter()
            .map(|at| Fibre {
                at: [*at, 0.0],
                spring,
                material: FibreMaterial::Bar,
            })
            .collect(),
        limits: BTreeMap::new(),
    };
    let mut on_fibres = model(frame(1, &[5.0]), &fibres);
    on_fibres.buildings[0].damping = Damping::Rayleigh {
        alpha: 0.5,
        beta: 0.0,
    };
    // The springs of a base do not couple rise and rotation: places are such that Σ x = 0.
    assert!(places.iter().sum::<f64>().abs() < 1e-12);
    let mut on_base = on_fibres.clone();
    on_base.buildings[0].hinges = None;
    on_base.buildings[0].base = Base {
        vertical_stiffness: Some(4.0 * stiffness),
        rotational_stiffness: Some(stiffness * places.iter().map(|x| x * x).sum::<f64>()),
        ..Base::default()
    };
    on_base.analysis.solver = Some(Solver::Riccati);
    let [a, b] = [on_fibres, on_base].map(|model| {
        let (_, outcome) = shaken(&model, 1.0);
        let floor = &outcome.peaks.floors(0)[0];
        [
            floor.displacement_max().value,
            floor.displacement_min().value,
        ]
    });
    agree(&[a], &[b], 1e-6, "floors");
}

/// Loads of floors press columns as masses of the same weight would, and take no part in the motion.
#[test]
fn loads_of_floors_weigh_and_do_not_sway() {
    let mut heavy = frame(3, &[6.0, 4.5]);
    let mut loaded = heavy.clone();
    heavy.floor_mass = vec![30e3; 3];
    loaded.floor_mass = vec![10e3; 3];
    loaded.floor_load = vec![20e3 * STANDARD_GRAVITY; 3];
    let [a, b] = [heavy, loaded.clone()].map(|heavy| {
        let system = assembled(&Model {
            buildings: vec![framed("A", heavy)],
            ..Model::default()
        });
        let mass = system.buildings[0].equations.total_mass();
        let carried = compressions(&system.buildings[0].structure, STANDARD_GRAVITY);
        (mass, carried.expect("it stands"))
    });
    close(a.0 - b.0, 60e3, 60e3, 1e-9, "masses differ");
    for (a, b) in a.1.iter().zip(&b.1) {
        close(*b, *a, largest(&[*a, 1.0]), 1e-9, "compression");
    }
    // Without weight in the run they change nothing.
    let mut light = loaded.clone();
    light.floor_load.clear();
    let period = |frame: Frame| {
        let system = assembled(&Model {
            buildings: vec![framed("A", frame)],
            ..Model::default()
        });
        let mode = system.buildings[0].lateral_modes().next().expect("a mode");
        mode.period()
    };
    assert_eq!(period(loaded).to_bits(), period(light).to_bits());
}

/// Limits are passed where histories of the fibres first are as far: those below the greatest strain, and none beyond it.
#[test]
fn strains_are_judged_when_fibres_reach_them() {
    let column_fibres = fibres(true);
    let judged = |limits: [f64; 3]| {
        let names = [
            FibreLimit::Spalling,
            FibreLimit::Buckling,
            FibreLimit::Fracture,
        ];
        let fibres = ColumnFibres {
            limits: names.into_iter().zip(limits).collect(),
            ..column_fibres.clone()
        };
        let model = model(two_storeys(), &fibres);
        let (system, outcome) = shaken(&model, 1.0);
        let motion = fading("along", 9.0, [1.8, 3.0], 150);
        let mut summary = Summary::new(&Run {
            model: &model,
            motion: &motion,
            system: &system,
            plan: &steps(1e-3, 1),
            outcome: &outcome,
            without_contact: None,
            wall: 0.0,
        });
        (summary.buildings.remove(0).sections, outcome)
    };
    let (sections, outcome) = judged([0.0015, 0.001, 0.9]);
    let springs = outcome.spring_history.as_ref().expect("recorded");
    let history = outcome.history.as_ref().expect("recorded");
    let times = history.column(jostle::Column::TIME).expect("recorded");
    let count = column_fibres.fibres.len();
    let mut passed = 0;
    for (number, section) in sections.iter().enumerate() {
        for limit in &section.limits {
            let (material, sign) = match limit.limit {
                FibreLimit::Spalling => (FibreMaterial::Cover, -1.0),
                _ => (FibreMaterial::Bar, 1.0),
            };
            let fibres = column_fibres.fibres.iter().enumerate();
            let fibres = fibres.filter(|(_, fibre)| fibre.material == material);
            let rows = fibres.map(|(fibre, _)| {
                let spring = springs.of_spring(number * count + fibre);
                spring
                    .map(|[moved, _]| sign * f64::from(moved) / 0.35)
                    .collect()
            });
            let rows: Vec<Vec<f64>> = rows.collect();
            let strain = |row: usize| rows.iter().map(|strains| strains[row]).fold(0.0, f64::max);
            let first = (0..times.len()).find(|row| strain(*row) >= limit.strain_limit);
            let greatest = (0..times.len()).map(strain).fold(0.0, f64::max);
            close(limit.strain, greatest, greatest, 2e-3, "greatest strain");
            assert_eq!(limit.passed_s.is_some(), first.is_some());
            if let Some((at, row)) = limit.passed_s.zip(first) {
                assert!(at <= times[row] && at > times[row.saturating_sub(1)]);
                passed += 1;
            }
        }
    }
    assert!(passed > 4, "{passed}");
    // A thousandth below and above the greatest strains, nothing else moves.
    let limits = &sections[0].limits;
    for (share, reached) in [(0.999, true), (1.001, false)] {
        let [cover, bars] = [0, 1].map(|index: usize| share * limits[index].strain);
        let (again, same) = judged([cover, bars, bars]);
        assert_eq!(same.state, outcome.state);
        let all = again[0].limits.iter();
        assert!(
            all.clone()
                .all(|column_fibres| column_fibres.passed_s.is_some() == reached)
        );
    }
}
