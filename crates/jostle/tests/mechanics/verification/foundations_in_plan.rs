//! Foundations on soil under buildings with a plan, and frames that rock with them: the plane as their limit, equilibrium and rigid
//! motion in closed form.

use std::f64::consts::TAU;

use jostle::history::Owner;
use jostle::linear::StepMatrix;
use jostle::stiffness::DirectStiffness;
use jostle::structure::solve_once;
use jostle::system::BuildingSystem;
use jostle::{
    AcrossBase, Analysis, Base, Building, Column, Damping, Foundation, Frame, Gravity, HalfSpace,
    MassDamping, Model, PlanArea, PlanFrame, PlanPoint, RiccatiSweep, Shear, Soil, SoilCoupling,
    Solver, SpacePlace, SpaceSection, Structure, Tier, TierStorey, Tiers,
};
use jostle_testkit::models::{UNDAMPED, concrete, frame as plane_frame, rectangle};
use jostle_testkit::runs::assembled;

use super::isolation_in_plan::{from, run, shaking};
use crate::verification::support::{column, difference, largest};

const SOIL: HalfSpace = HalfSpace {
    shear_wave_velocity: 180.0,
    density: 1900.0,
    poisson_ratio: 0.35,
    damping: 0.03,
};

const HEIGHTS: [f64; 3] = [4.0, 3.0, 3.5];
const MASSES: [f64; 3] = [150e3, 140e3, 130e3];
const STIFFNESSES: [f64; 3] = [190e6, 170e6, 150e6];

fn foundation() -> Foundation {
    Foundation {
        embedment: 1.5,
        ..Foundation::rectangle(14.0, 9.0, 190e3)
    }
}

fn on_soil(structure: Structure, foundation: Foundation, solver: Solver) -> Model {
    Model {
        title: "a plan on soil".to_owned(),
        buildings: vec![Building {
            name: "block".to_owned(),
            structure,
            damping: Damping::Rayleigh {
                alpha: 0.4,
                beta: 1.5e-3,
            },
            base: Base {
                foundation: Some(foundation),
                ..Base::default()
            },
            ..Building::default()
        }],
        analysis: Analysis {
            step: Some(1e-3),
            solver: Some(solver),
            ..Analysis::default()
        },
        soil: Some(Soil {
            half_space: Some(SOIL),
            coupling: SoilCoupling::None,
        }),
        ..Model::default()
    }
}

/// Three storeys as stiff across as along.
pub(super) fn tiers(plan: &[PlanPoint]) -> Tiers {
    let floor = |mass: &f64| Tier::uniform(*mass, plan.to_vec()).expect("an area");
    let floors: Vec<Tier> = MASSES.iter().map(floor).collect();
    let storey = |stiffness: &f64| TierStorey {
        stiffness: [
            *stiffness,
            *stiffness,
            TierStorey::torsion_of_even([*stiffness; 2], &PlanArea::new(plan)),
        ],
        centre: PlanArea::new(plan).centroid,
    };
    Tiers {
        floors,
        storeys: STIFFNESSES.iter().map(storey).collect(),
        storey_heights: HEIGHTS.to_vec(),
        ..Tiers::default()
    }
}

/// A symmetric building moves along either axis as one in one plane on a foundation of that length, with its springs and dashpots, and
/// damping relative to the foundation.
#[test]
fn along_an_axis_the_soil_is_that_of_one_plane() {
    let plane = Structure::Shear(Shear {
        mass: MASSES.to_vec(),
        stiffness: STIFFNESSES.to_vec(),
        storey_heights: HEIGHTS.to_vec(),
    });
    let plan = rectangle(2.0, 1.0, 12.0, 8.0);
    for (solver, p_delta, damped) in [
        (Solver::Riccati, false, MassDamping::Support),
        (Solver::Stiffness, true, MassDamping::Ground),
    ] {
        let set = |mut model: Model| {
            model.buildings[0].gravity = Gravity {
                p_delta,
                ..Gravity::default()
            };
            model.buildings[0].mass_damping = damped;
            model
        };
        let deep = set(on_soil(
            Structure::Tiers(tiers(&plan)),
            foundation(),
            solver,
        ));
        for (axis, foundation) in [foundation(), foundation().turned()]
            .into_iter()
            .enumerate()
        {
            let flat = set(on_soil(plane.clone(), foundation, solver));
            let motion = shaking("line", 4.0, 1.0);
            let (known, flat) = run(&flat, &motion);
            let angle = 0.25 * TAU * axis as f64;
            let (system, deep) = run(&deep, &from(motion, angle, None));
            let found = system.buildings[0]
                .foundation_in_plan
                .expect("it stands on one");
            let known = known.buildings[0].foundation.expect("it stands on one");
            for (found, known) in [
                (found.periods[axis], known.period),
                (found.fixed_periods[axis], known.fixed_period),
                (found.damping[axis], known.damping),
                (found.fixed_damping[axis], known.fixed_damping),
            ] {
                assert!(
                    (found / known - 1.0).abs() < 1e-9,
                    "{axis}: {found} {known}"
                );
            }
            for floor in 1..=3 {
                let place = Column::displacement(0, floor);
                let expected = column(&flat, place);
                let place = [place, place.across()][axis];
                let apart = difference(&column(&deep, place), &expected);
                println!("{solver:?} axis {axis} floor {floor}: {apart:e}");
                assert!(largest(&expected) > 1e-3 && apart < 1e-8, "{apart:e}");
            }
            assert!(deep.energy.worst_imbalance < 1e-9);
            let owner = Owner::Foundation(0);
            let [a, b] = [&deep, &flat].map(|outcome| outcome.peaks.work(owner));
            assert!((a / b - 1.0).abs() < 1e-8, "{a} {b}");
            let [deep, flat] = [&deep, &flat].map(|outcome| outcome.peaks.owned_by(owner));
            let deep = [deep, deep.across()][axis];
            for (found, known) in [
                (deep.displacement(), flat.displacement()),
                (
                    deep.of(jostle::history::Kind::Rocking),
                    flat.turning().displacement(),
                ),
            ] {
                let (found, known) = (found.size(), known.size());
                assert!(
                    found > 0.0 && (found / known - 1.0).abs() < 1e-8,
                    "{found} {known}"
                );
            }
        }
    }
}

/// Springs of a rectangle in both directions are those of the plane along either side; torsion is stated, or that of the formula.
#[test]
fn a_foundation_turns_against_its_spring() {
    let plan = rectangle(0.0, 0.0, 12.0, 8.0);
    let period_of_torsion = |foundation: Foundation| {
        let model = on_soil(Structure::Tiers(tiers(&plan)), foundation, Solver::Riccati);
        let system = assembled(&model);
        let building = &system.buildings[0];
        let found = building.foundation_in_plan.expect("it stands on one");
        let mut modes = building.modes.iter();
        let turning = modes.find(|mode| mode.effective_mass_ratio_torsion > 0.5);
        (found.springs.torsion, turning.expect("it turns").period())
    };
    let ([stiffness, dashpot], period) = period_of_torsion(foundation());
    let formula = 1900.0 * 180.0_f64.powi(2) * 4.5_f64.powi(3);
    let formula = formula * (4.25 * (14.0_f64 / 9.0).powf(2.45) + 4.06);
    assert!(
        (stiffness / formula - 1.0).abs() < 1e-12,
        "{stiffness} {formula}"
    );
    assert!(dashpot > 0.0);
    let stated = Foundation {
        torsional_stiffness: Some(stiffness),
        torsional_damping: Some(5e6),
        ..foundation()
    };
    let (torsion, same) = period_of_torsion(stated);
    assert_eq!((torsion, same), ([stiffness, 5e6], period));
    // Nearly rigid above: 2π √(J/k), the footing included.
    let soft = Foundation {
        torsional_stiffness: Some(1e6),
        ..stated
    };
    let polar: f64 = MASSES
        .iter()
        .map(|m| m * (12.0 * 12.0 + 8.0 * 8.0) / 12.0)
        .sum();
    let polar = polar + 190e3 * (14.0 * 14.0 + 9.0 * 9.0) / 12.0;
    let (_, period) = period_of_torsion(soft);
    let expected = TAU * (polar / 1e6).sqrt();
    assert!(
        (period / expected - 1.0).abs() < 1e-3,
        "{period} {expected}"
    );
}

fn base() -> Base {
    Base {
        horizontal_stiffness: Some(4e8),
        horizontal_damping: 3e6,
        rotational_stiffness: Some(9e9),
        rotational_damping: 4e7,
        torsional_stiffness: Some(7e9),
        torsional_damping: 2e7,
        mass: 1.1e5,
        ..Base::default()
    }
}

pub(super) fn frame(columns_mass: bool) -> Frame {
    let mut plane_frame = plane_frame(3, &[5.0, 7.0], concrete(0.5, 0.5), concrete(0.3, 0.6));
    if !columns_mass {
        plane_frame
            .columns
            .iter_mut()
            .for_each(|column| column.line_mass = 0.0);
    }
    plane_frame
}

pub(super) fn standing(name: &str, at: PlanPoint, frame: Frame) -> PlanFrame {
    PlanFrame {
        name: name.to_owned(),
        at,
        direction: [1.0, 0.0],
        lines: Vec::new(),
        base: Base::default(),
        hinges: Default::default(),
        frame,
    }
}

/// Two equal frames at lines of a plan on a base that sways and rocks move as one in the plane on half the base; storeys given by springs
/// hold the floors across.
#[test]
fn frames_at_lines_rock_as_in_one_plane() {
    let slab = 60e3;
    let plan = rectangle(0.0, 0.0, 12.0, 8.0);
    let flexible_base = base();
    let damping = Damping::Rayleigh {
        alpha: 0.3,
        beta: 2e-3,
    };
    let model = |structure: Structure, base: Base, solver: Solver| Model {
        soil: None,
        buildings: vec![Building {
            name: "block".to_owned(),
            structure,
            damping: damping.clone(),
            mass_damping: MassDamping::Support,
            base,
            ..Building::default()
        }],
        ..on_soil(Structure::Tiers(tiers(&plan)), foundation(), solver)
    };
    for (solver, mass) in [(Solver::Riccati, true), (Solver::Stiffness, false)] {
        let mut flat = frame(mass);
        flat.floor_mass = vec![0.5 * slab; 3];
        let half = Foundation::rectangle(12.0, 8.0, 0.5 * flexible_base.mass);
        let flat_base = Base {
            foundation: Some(half),
            ..Base::default()
        };
        let mut flat = model(Structure::Frame(flat), flat_base, solver);
        let [sway, rocking] = [[4e8, 3e6], [9e9, 4e7]];
        let matrix =
            |part: usize| vec![vec![0.5 * sway[part], 0.0], vec![0.0, 0.5 * rocking[part]]];
        flat.soil = Some(Soil {
            half_space: None,
            coupling: SoilCoupling::Given {
                stiffness: matrix(0),
                damping: matrix(1),
            },
        });
        flat.buildings[0].mass_damping = MassDamping::Ground;
        let across = TierStorey {
            stiffness: [0.0, 3e8, 5e9],
            centre: [6.0, 4.0],
        };
        let deep = Tiers {
            floors: vec![Tier::uniform(slab, plan.clone()).expect("an area"); 3],
            storeys: vec![across; 3],
            storey_heights: vec![3.2; 3],
            frames: vec![
                standing("1", [0.0, 1.0], frame(mass)),
                standing("2", [0.0, 7.0], frame(mass)),
            ],
            ..Tiers::default()
        };
        let deep = model(Structure::Tiers(deep), flexible_base, solver);
        let motion = shaking("line", 5.0, 1.0);
        let (_, flat) = run(&flat, &motion);
        let (_, deep) = run(&deep, &motion);
        for floor in 1..=3 {
            let place = Column::displacement(0, floor);
            let [found, known] = [&deep, &flat].map(|run| column(run, place));
            let apart = difference(&found, &known);
            println!("{solver:?} floor {floor}: {apart:e}");
            assert!(largest(&known) > 1e-3 && apart < 1e-8, "{apart:e}");
            let aside = largest(&column(&deep, place.across()));
            assert!(aside < 1e-9 * largest(&known), "{aside:e}");
        }
        assert!(deep.energy.worst_imbalance < 1e-9);
        let [a, b] = [&deep, &flat].map(|outcome| outcome.peaks.base_shear(0));
        println!("base shear {a} {b}");
    }
}

/// Displacements of floors (x, across, rotation) under forces there.
fn pushed(system: &BuildingSystem, forces: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let floors = system.discretization.floors.iter();
    let equations = &system.equations;
    let dofs: Vec<[usize; 3]> = floors
        .map(|floor| {
            let dofs = [
                equations.horizontal(*floor),
                equations.vertical(*floor),
                equations.rotation(*floor),
            ];
            dofs.map(|dof| dof.expect("floors move in plan"))
        })
        .collect();
    let mut load = vec![0.0; equations.len()];
    for (dofs, forces) in dofs.iter().zip(forces) {
        for (dof, force) in dofs.iter().zip(forces) {
            load[*dof] += force;
        }
    }
    let riccati = solve_once::<RiccatiSweep>(system, &StepMatrix::STATIC, &load);
    let direct = solve_once::<DirectStiffness>(system, &StepMatrix::STATIC, &load);
    let [riccati, direct] = [riccati, direct].map(|found| found.expect("it stands"));
    assert!(difference(&riccati, &direct) < 1e-8);
    dofs.iter()
        .map(|dofs| dofs.map(|dof| riccati[dof]))
        .collect()
}

pub(super) fn kinds() -> Vec<(&'static str, Tiers)> {
    let mut all = vec![("storeys", tiers(&rectangle(0.0, 0.0, 12.0, 8.0)))];
    all[0].1.storeys[1].centre = [7.0, 3.0];
    all[0].1.floors[2].centre = [5.0, 5.0];
    for flexible in [false, true] {
        all.push(("frames", super::plan_frames::without_symmetry(flexible).0));
        let flexible = super::space_frames::Flexible {
            axial: flexible,
            shear: true,
        };
        all.push((
            "space frame",
            super::space_frames::without_symmetry(flexible),
        ));
    }
    let flexible = super::space_frames::Flexible {
        axial: true,
        shear: false,
    };
    let mut askew = super::space_frames::without_symmetry(flexible);
    if let Some(frame) = &mut askew.space_frame {
        let (s, c) = 0.4_f64.sin_cos();
        (frame.direction, frame.at) = ([c, s], [1.5, -0.5]);
    }
    all.push(("space frame askew", askew));
    all
}

/// Floors under forces of all kinds move as on rigid ground, plus the motion of the base as a rigid body under their sum: whatever the
/// building is made of.
#[test]
fn a_base_adds_its_own_displacement_under_static_forces() {
    let flexible_base = Base {
        across: Some(AcrossBase {
            horizontal_stiffness: Some(2.5e8),
            rotational_stiffness: Some(3e9),
            ..AcrossBase::default()
        }),
        ..base()
    };
    for (kind, tiers) in kinds() {
        let model = |base: Base| {
            let mut soil = on_soil(
                Structure::Tiers(tiers.clone()),
                foundation(),
                Solver::Riccati,
            );
            soil.soil = None;
            soil.buildings[0].damping = UNDAMPED;
            soil.buildings[0].base = base;
            assembled(&soil)
        };
        let [fixed, soft] = [Base::default(), flexible_base].map(model);
        let lumped = tiers.lumped_floors();
        let middle = PlanArea::new(&tiers.floors[0].plan).centroid;
        let forces: Vec<[f64; 3]> = (0..3)
            .map(|floor| {
                let step = f64::from(floor);
                [1e5 * (step + 0.4), 7e4 * (1.3 - step), 3e5 * (step - 0.6)]
            })
            .collect();
        let [rigid, found] = [&fixed, &soft].map(|system| pushed(&system.buildings[0], &forces));
        let (mut sum, mut moment, mut torque, mut height) = ([0.0; 2], [0.0; 2], 0.0, 0.0);
        let mut heights = Vec::new();
        for (floor, force) in forces.iter().enumerate() {
            height += tiers.storey_heights[floor];
            heights.push(height);
            let arm = [0, 1].map(|axis| lumped[floor].tier.centre[axis] - middle[axis]);
            for axis in 0..2 {
                sum[axis] += force[axis];
                moment[axis] += height * force[axis];
            }
            torque += force[2] + arm[0] * force[1] - arm[1] * force[0];
        }
        let sway = [sum[0] / 4e8, sum[1] / 2.5e8];
        let leant = [moment[0] / 9e9, moment[1] / 3e9];
        let turned = torque / 7e9;
        for floor in 0..3 {
            let arm = [0, 1].map(|axis| lumped[floor].tier.centre[axis] - middle[axis]);
            let expected = [
                rigid[floor][0] + sway[0] - turned * arm[1] + heights[floor] * leant[0],
                rigid[floor][1] + sway[1] + turned * arm[0] + heights[floor] * leant[1],
                rigid[floor][2] + turned,
            ];
            let apart = difference(&found[floor], &expected);
            println!("{kind} floor {floor}: {apart:e}");
            assert!(
                apart < 1e-8,
                "{kind} {floor}: {:?} {expected:?}",
                found[floor]
            );
        }
    }
}

/// det(K − λM) by elimination.
fn determinant(stiffness: &[[f64; 5]; 5], mass: &[[f64; 5]; 5], squared: f64) -> f64 {
    let mut a = *stiffness;
    for (row, mass_row) in a.iter_mut().zip(mass) {
        for (entry, mass) in row.iter_mut().zip(mass_row) {
            *entry -= squared * mass;
        }
    }
    let mut product = 1.0;
    for pivot in 0..5 {
        let largest = (pivot..5).max_by(|p, q| a[*p][pivot].abs().total_cmp(&a[*q][pivot].abs()));
        let largest = largest.expect("there are rows");
        if largest != pivot {
            a.swap(pivot, largest);
            product = -product;
        }
        product *= a[pivot][pivot] / stiffness[pivot][pivot];
        for row in pivot + 1..5 {
            let factor = a[row][pivot] / a[pivot][pivot];
            for column in pivot..5 {
                a[row][column] -= factor * a[pivot][column];
            }
        }
    }
    product
}

/// Frames and a space frame without symmetry, so stiff that they move as rigid bodies: five displacements, with the masses that rise at
/// their columns, whose products of inertia do not vanish.
#[test]
fn stiff_frames_rock_as_a_rigid_body() {
    let flexible_base = base();
    for (kind, mut tiers) in kinds().into_iter().skip(1) {
        for storey in &mut tiers.storeys {
            storey.stiffness = storey.stiffness.map(|value| 1e5 * value);
        }
        let stiff = |section: &mut jostle::Section| {
            section.flexural_rigidity *= 1e5;
            section.axial_rigidity = section
                .axial_rigidity
                .map(|axial_rigidity| 1e5 * axial_rigidity);
        };
        for frame in &mut tiers.frames {
            frame.base = Base::default();
            let frame = &mut frame.frame;
            frame
                .columns
                .iter_mut()
                .chain(&mut frame.beams)
                .for_each(stiff);
        }
        if let Some(frame) = &mut tiers.space_frame {
            for member in &mut frame.members {
                let section: &mut SpaceSection = &mut member.section;
                section.flexural_rigidity = section.flexural_rigidity.map(|value| 1e5 * value);
                section.shear_rigidity = section
                    .shear_rigidity
                    .map(|pair| pair.map(|pair| 1e5 * pair));
                section.axial_rigidity = section
                    .axial_rigidity
                    .map(|axial_rigidity| 1e5 * axial_rigidity);
                section.torsional_rigidity *= 1e5;
            }
        }
        let mut model = on_soil(
            Structure::Tiers(tiers.clone()),
            foundation(),
            Solver::Riccati,
        );
        model.soil = None;
        model.buildings[0].damping = UNDAMPED;
        model.buildings[0].base = flexible_base;
        let system = assembled(&model);
        // Points of the floors' masses, and of columns that carry them.
        let middle = PlanArea::new(&tiers.floors[0].plan).centroid;
        let mut mass = [[0.0; 5]; 5];
        let mut add = |form: [f64; 5], value: f64| {
            for (row, a) in mass.iter_mut().zip(form) {
                for (entry, b) in row.iter_mut().zip(form) {
                    *entry += value * a * b;
                }
            }
        };
        let mut height = 0.0;
        for (index, floor) in tiers.floors.iter().enumerate() {
            height += tiers.storey_heights[index];
            let [x, y] = [0, 1].map(|axis| floor.centre[axis] - middle[axis]);
            add([1.0, 0.0, -y, height, 0.0], floor.mass);
            add([0.0, 1.0, x, 0.0, height], floor.mass);
            add([0.0, 0.0, 1.0, 0.0, 0.0], floor.polar_mass);
            let columns = columns_at(&tiers, index);
            for at in &columns {
                let [x, y] = [0, 1].map(|axis| at[axis] - middle[axis]);
                add([0.0, 0.0, 0.0, -x, -y], floor.mass / columns.len() as f64);
            }
        }
        let area = PlanArea::new(&tiers.floors[0].plan);
        let [across, along] = area
            .second_moments
            .map(|moment| flexible_base.mass * moment / area.area);
        for (place, inertia) in [
            flexible_base.mass,
            flexible_base.mass,
            along + across,
            along,
            across,
        ]
        .into_iter()
        .enumerate()
        {
            mass[place][place] += inertia;
        }
        let mut stiffness = [[0.0; 5]; 5];
        for (place, value) in [4e8, 4e8, 7e9, 9e9, 9e9].into_iter().enumerate() {
            stiffness[place][place] = value;
        }
        assert!(mass[3][4].abs() > 1e-3 * mass[3][3], "{:e}", mass[3][4]);
        let mut found: Vec<f64> = system.buildings[0]
            .modes
            .iter()
            .map(|mode| mode.circular_frequency.powi(2))
            .collect();
        found.sort_by(f64::total_cmp);
        for value in &found[..5] {
            let sides = [1.0 - 3e-4, 1.0 + 3e-4]
                .map(|factor| determinant(&stiffness, &mass, factor * value));
            println!("{kind} {value:e}: {sides:?}");
            assert!(sides[0] * sides[1] < 0.0, "{kind} {value}: {sides:?}");
        }
    }
}

/// Where columns reach a floor; of frames at lines of a plan and of space frames.
fn columns_at(tiers: &Tiers, floor: usize) -> Vec<PlanPoint> {
    let mut found = Vec::new();
    for plan_frame in &tiers.frames {
        let frame = &plan_frame.frame;
        if floor < frame.storey_heights.len() {
            let lines = frame.line_positions();
            found.extend(lines.iter().map(|along| plan_frame.point_at(*along)));
        }
    }
    if let Some(frame) = &tiers.space_frame {
        found.extend(
            frame
                .members
                .iter()
                .filter_map(|member| match member.place {
                    SpacePlace::Column { line, storey } if storey == floor => {
                        Some(frame.point(line))
                    }
                    _ => None,
                }),
        );
    }
    found
}

/// Mass-proportional damping does not act on a building that sways, turns and rocks as a rigid body with its foundation.
#[test]
fn damping_is_relative_to_the_foundation() {
    for (kind, tiers) in kinds() {
        let model = on_soil(
            Structure::Tiers(tiers.clone()),
            foundation(),
            Solver::Riccati,
        );
        let system = assembled(&model);
        let building = &system.buildings[0];
        let equations = &building.equations;
        assert!(equations.alpha > 0.0);
        let springs = building
            .foundation_in_plan
            .expect("it stands on one")
            .springs;
        // Forces on the base alone move everything as a rigid body.
        let base = building
            .discretization
            .stick_model
            .plan_base
            .expect("it has one");
        let rocking = base.uncoupled.or(base.rocking).expect("it rocks");
        let mut load = vec![0.0; equations.len()];
        for (dof, force) in [
            (equations.horizontal(base.footing), 3e6),
            (equations.vertical(base.footing), -2e6),
            (equations.rotation(base.footing), 4e7),
            (equations.horizontal(rocking), 6e7),
            (equations.vertical(rocking), 5e7),
        ] {
            load[dof.expect("it moves")] += force;
        }
        let moved = solve_once::<RiccatiSweep>(building, &StepMatrix::STATIC, &load);
        let moved = moved.expect("it stands");
        let inertia: f64 = equations
            .mass
            .iter()
            .zip(&moved)
            .map(|(m, v)| m * v * v)
            .sum();
        let strained = equations.stiffness.quadratic_form(&moved);
        let damped = equations.alpha * inertia
            + equations.beta * strained
            + equations.dashpots.quadratic_form(&moved);
        // What the springs of the soil do not bear of the same motion, their dashpots take.
        let motions = rigid_motion(building, &moved);
        let soil = [
            springs.along.sway_damping,
            springs.across.sway_damping,
            springs.torsion[1],
            springs.along.rocking_damping,
            springs.across.rocking_damping,
        ];
        let soil: f64 = soil.iter().zip(motions).map(|(c, v)| c * v * v).sum();
        println!("{kind}: {:e}, strained {strained:e}", damped / soil - 1.0);
        assert!(
            (damped / soil - 1.0).abs() < 1e-7,
            "{kind}: {damped} {soil}"
        );
        assert!(strained < 1e-9 * equations.undamped.quadratic_form(&moved));
    }
}

/// Sway along and across of the middle of the footing, its rotation, and rocking, from the motion of the footing and of the floors.
fn rigid_motion(system: &BuildingSystem, moved: &[f64]) -> [f64; 5] {
    let base = system
        .discretization
        .stick_model
        .plan_base
        .expect("it has one");
    let of = |node: usize| {
        let equations = &system.equations;
        let dofs = [
            equations.horizontal(node),
            equations.vertical(node),
            equations.rotation(node),
        ];
        dofs.map(|dof| moved[dof.expect("it moves")])
    };
    let [x, y, turned] = of(base.footing);
    let arm = [0, 1].map(|axis| base.middle[axis] - base.centre[axis]);
    let (x, y) = (x - turned * arm[1], y + turned * arm[0]);
    let roof = system.floors.len() - 1;
    let [roof_x, roof_y, _] = of(system.discretization.floors[roof]);
    let centre = system.discretization.centres[roof];
    let arm = [0, 1].map(|axis| centre[axis] - base.middle[axis]);
    let height = system.floors[roof].height;
    let leant = [
        (roof_x - x + turned * arm[1]) / height,
        (roof_y - y - turned * arm[0]) / height,
    ];
    [x, y, turned, leant[0], leant[1]]
}

#[test]
fn what_a_foundation_in_plan_cannot_have_is_refused() {
    let plan = rectangle(0.0, 0.0, 12.0, 8.0);
    let sound = on_soil(
        Structure::Tiers(tiers(&plan)),
        foundation(),
        Solver::Riccati,
    );
    assert!(sound.check().is_ok());
    let foundation_of = |model: &mut Model, change: &dyn Fn(&mut Foundation)| {
        change(
            model.buildings[0]
                .base
                .foundation
                .as_mut()
                .expect("it stands on one"),
        );
    };
    let mut lifts = sound.clone();
    foundation_of(&mut lifts, &|foundation| {
        foundation.uplift = Some(jostle::Uplift::with_springs(5));
    });
    let mut negative = sound.clone();
    foundation_of(&mut negative, &|foundation| {
        foundation.torsional_damping = Some(-1.0);
    });
    let mut bare = sound.clone();
    bare.soil = None;
    let mut coupled = sound.clone();
    coupled.soil.as_mut().expect("it has soil").coupling = SoilCoupling::Static;
    let mut modal = sound.clone();
    modal.analysis.solver = Some(Solver::Modal);
    for (model, field) in [
        (lifts, "building[0].gravity"),
        (negative, "foundation.torsional_damping"),
        (bare, "building[0].foundation"),
        (coupled, "soil.coupling"),
        (modal, "analysis.solver"),
    ] {
        let faults = model.check().expect_err(field);
        assert!(
            faults.iter().any(|fault| fault.path.ends_with(field)),
            "{field}: {faults:?}"
        );
    }
}
