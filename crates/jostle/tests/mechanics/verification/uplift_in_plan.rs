//! Foundations that lift off under buildings with a plan: one plane as their limit, static curves in closed form, and turned models.

use std::f64::consts::{FRAC_1_SQRT_2, TAU};

use jostle::history::{Kind, Owner};
use jostle::statics::{EquilibriumPath, STANDARD_GRAVITY, settle};
use jostle::system::BuildingSystem;
use jostle::{
    Analysis, Base, BearingStrength, Building, Column, Damping, Foundation, Gravity, GroundSprings,
    HalfSpace, Model, PlanArea, PlanPoint, Shear, Soil, SoilCoupling, Solver, Structure, Tier,
    TierStorey, Tiers, Uplift,
};
use jostle_testkit::models::rectangle;
use jostle_testkit::runs::assembled;

use super::foundations_in_plan::{frame, kinds, standing, tiers};
use super::isolation_in_plan::{from, run, shaking};
use crate::verification::support::{column, difference, largest};

const GROUND: GroundSprings = GroundSprings {
    vertical_stiffness: 6e8,
    vertical_damping: 5e6,
    sway: Some([5e8, 2e6]),
};

fn bed(springs: usize, across: usize) -> Uplift {
    Uplift {
        springs_across: Some(across),
        ground: Some(GROUND),
        ..Uplift::with_springs(springs)
    }
}

fn lifting(structure: Structure, foundation: Foundation, solver: Solver) -> Model {
    let alpha = 0.3;
    Model {
        buildings: vec![Building {
            name: "block".to_owned(),
            structure,
            damping: Damping::Rayleigh { alpha, beta: 1e-3 },
            base: Base {
                foundation: Some(foundation),
                ..Base::default()
            },
            gravity: Gravity {
                preload: true,
                p_delta: false,
            },
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

/// A symmetric building moves along either axis as one in one plane on a foundation of that length: on springs of its own with ground that
/// yields, and on a half-space.
#[test]
fn along_an_axis_it_lifts_as_in_one_plane() {
    let plan = rectangle(2.0, 1.0, 12.0, 8.0);
    let deep = tiers(&plan);
    let plane = Structure::Shear(Shear {
        mass: deep.floors.iter().map(|floor| floor.mass).collect(),
        stiffness: deep
            .storeys
            .iter()
            .map(|storey| storey.stiffness[0])
            .collect(),
        storey_heights: deep.storey_heights.clone(),
    });
    let bearing = BearingStrength {
        strength: 250e3,
        hardening: 0.02,
    };
    let yields = Uplift {
        // Springs of a row yield together where all are as stiff as their strips.
        bearing: Some(bearing),
        ..bed(5, 3)
    };
    let on_soil = Uplift {
        ground: None,
        ..bed(5, 4)
    };
    let soil = Soil {
        half_space: Some(HalfSpace {
            shear_wave_velocity: 180.0,
            density: 1900.0,
            poisson_ratio: 0.35,
            damping: 0.03,
        }),
        coupling: SoilCoupling::None,
    };
    for (solver, uplift, soil, axes, sides) in [
        (Solver::Riccati, yields, None, vec![0, 1], [9.0, 7.0]),
        // The vertical spring is that at the longer period, across the shorter side.
        (Solver::Stiffness, on_soil, Some(soil), vec![1], [9.0, 7.0]),
    ] {
        let foundation = Foundation {
            uplift: Some(uplift),
            ..Foundation::rectangle(sides[0], sides[1], 190e3)
        };
        let set = |mut model: Model| {
            model.soil.clone_from(&soil);
            model
        };
        let in_plan = set(lifting(Structure::Tiers(deep.clone()), foundation, solver));
        for axis in axes {
            let mut footing = [foundation, foundation.turned()][axis];
            footing.uplift.as_mut().expect("it lifts").springs_across = None;
            let flat = set(lifting(plane.clone(), footing, solver));
            let motion = shaking("line", 4.0, 1.6);
            let (_, flat) = run(&flat, &motion);
            let angle = 0.25 * TAU * axis as f64;
            let (_, found) = run(&in_plan, &from(motion, angle, None));
            for floor in 1..=3 {
                let place = Column::displacement(0, floor);
                let expected = column(&flat, place);
                let place = [place, place.across()][axis];
                let apart = difference(&column(&found, place), &expected);
                println!("{solver:?} axis {axis} floor {floor}: {apart:e}");
                assert!(largest(&expected) > 1e-3 && apart < 1e-8, "{apart:e}");
            }
            let owner = Owner::Foundation(0);
            let [a, b] = [&found, &flat].map(|outcome| outcome.peaks.work(owner));
            assert!((a / b - 1.0).abs() < 1e-8, "{a} {b}");
            let rise = Column::along(owner, Kind::Displacement).up();
            let sunk = [&found, &flat].map(|outcome| -outcome.peaks.of(rise).least.value);
            println!("greatest sinking {sunk:?}");
            assert!(sunk[0] > 1e-5 && (sunk[0] / sunk[1] - 1.0).abs() < 1e-7);
            let lifted = Column::along(Owner::Spring(0), Kind::Lifted);
            let lifted = [&found, &flat].map(|outcome| outcome.peaks.of(lifted).greatest.value);
            println!("first spring without force for {lifted:?} s");
            assert!((lifted[0] - lifted[1]).abs() < 1e-9, "{lifted:?}");
        }
    }
}

/// Two equal frames at lines of a plan, on one foundation, are one in the plane on half of it.
#[test]
fn frames_at_lines_lift_as_in_one_plane() {
    let slab = 60e3;
    let plan = rectangle(0.0, 0.0, 12.0, 8.0);
    let mut flat = frame(true);
    flat.floor_mass = vec![0.5 * slab; 3];
    flat.axial.columns_flexible = true;
    let half = GroundSprings {
        vertical_stiffness: 0.5 * GROUND.vertical_stiffness,
        vertical_damping: 0.5 * GROUND.vertical_damping,
        sway: GROUND.sway.map(|sway| sway.map(|value| 0.5 * value)),
    };
    let uplift = bed(7, 4);
    let whole = Foundation {
        uplift: Some(uplift),
        ..Foundation::rectangle(12.0, 8.0, 110e3)
    };
    let of_half = Foundation {
        uplift: Some(Uplift {
            ground: Some(half),
            springs_across: None,
            ..uplift
        }),
        ..Foundation::rectangle(12.0, 8.0, 55e3)
    };
    let mut frame = frame(true);
    frame.axial.columns_flexible = true;
    let across = TierStorey {
        stiffness: [0.0, 3e8, 5e9],
        centre: [6.0, 4.0],
    };
    let deep = Tiers {
        floors: vec![Tier::uniform(slab, plan).expect("an area"); 3],
        storeys: vec![across; 3],
        storey_heights: vec![3.2; 3],
        frames: vec![
            standing("1", [0.0, 1.0], frame.clone()),
            standing("2", [0.0, 7.0], frame),
        ],
        ..Tiers::default()
    };
    let motion = shaking("line", 5.0, 3.0);
    for solver in [Solver::Riccati, Solver::Stiffness] {
        let flat = lifting(Structure::Frame(flat.clone()), of_half, solver);
        let deep = lifting(Structure::Tiers(deep.clone()), whole, solver);
        let (_, flat) = run(&flat, &motion);
        let (_, deep) = run(&deep, &motion);
        for floor in 1..=3 {
            let place = Column::displacement(0, floor);
            let [found, known] = [&deep, &flat].map(|run| column(run, place));
            let apart = difference(&found, &known);
            println!("{solver:?} floor {floor}: {apart:e}");
            assert!(largest(&known) > 1e-3 && apart < 1e-8, "{apart:e}");
        }
        let lifted = Column::along(Owner::Spring(0), Kind::Lifted);
        let lifted = deep.peaks.get(lifted).expect("it is followed");
        assert!(lifted.greatest.value > 0.0, "it stays in contact");
    }
}

/// Sums of the forces of the contact springs at rest: the weight, and its moments about the middle \[N, N·m\].
fn at_rest(system: &BuildingSystem) -> [f64; 3] {
    let settled = settle(system, STANDARD_GRAVITY).expect("it bears its weight");
    let bed = &system.discretization.stick_model.bed;
    let first = system.equations.single_springs - bed.len();
    let mut sums = [0.0; 3];
    for (spring, memory) in bed.iter().zip(&settled.springs[first..]) {
        let force = -memory.force();
        for (sum, arm) in sums.iter_mut().zip([1.0, spring.at, spring.across]) {
            *sum += force * arm;
        }
    }
    sums
}

/// Whatever a building without symmetry is made of, the ground bears its weight below its centre of mass.
#[test]
fn the_ground_bears_the_weight_below_its_centre() {
    for (kind, tiers) in kinds() {
        let foundation = Foundation {
            uplift: Some(bed(4, 3)),
            ..Foundation::rectangle(16.0, 12.0, 200e3)
        };
        let middle = PlanArea::new(&tiers.floors[0].plan).centroid;
        let lumped = tiers.lumped_floors();
        let model = lifting(Structure::Tiers(tiers.clone()), foundation, Solver::Riccati);
        // Space frames whose columns keep their length do not bear weight.
        if model.check().is_err() {
            continue;
        }
        let system = assembled(&model);
        let building = &system.buildings[0];
        let [weight, ..] = at_rest(building);
        let due = STANDARD_GRAVITY * building.equations.total_mass();
        println!("{kind}: {weight} N of {due} N");
        assert!((weight / due - 1.0).abs() < 1e-9, "{kind}: {weight} {due}");
        if kind == "storeys" {
            let [_, along, across] = at_rest(building);
            for (axis, found) in [along, across].into_iter().enumerate() {
                let moments = lumped.iter().map(|floor| {
                    STANDARD_GRAVITY * floor.tier.mass * (floor.tier.centre[axis] - middle[axis])
                });
                let due: f64 = moments.sum();
                assert!((found - due).abs() < 1e-9 * weight, "{found} {due}");
            }
        }
    }
}

/// A stiff block, its moment along a direction for a rise of its leaning: along x and across two rows of springs give M = K_z a² φ to
/// W a/2 … W a; along the diagonal of a square the hindmost corner lifts at W a/√2 · 1, both others at W a √2.
#[test]
fn a_block_is_borne_to_the_edge_and_to_the_corner() {
    let plan = rectangle(0.0, 0.0, 6.0, 6.0);
    let mut block = tiers(&plan);
    for storey in &mut block.storeys {
        storey.stiffness = storey.stiffness.map(|stiffness| 1e4 * stiffness);
    }
    let foundation = Foundation {
        uplift: Some(bed(2, 2)),
        ..Foundation::rectangle(5.0, 5.0, 100e3)
    };
    let model = lifting(Structure::Tiers(block), foundation, Solver::Riccati);
    let system = assembled(&model);
    let building = &system.buildings[0];
    let weight = STANDARD_GRAVITY * building.equations.total_mass();
    let (arm, stiffness) = (2.5, GROUND.vertical_stiffness);
    let rocking = building
        .discretization
        .stick_model
        .plan_base
        .expect("a base");
    let node = rocking.rocking.expect("it rocks");
    let dofs = [
        building.equations.horizontal(node),
        building.equations.vertical(node),
    ];
    let dofs = dofs.map(|dof| dof.expect("it moves"));
    let along = |by: f64| {
        let free = stiffness * arm * arm * by;
        free.min(weight * arm)
    };
    let diagonal = |by: f64| {
        // The foremost corner sinks by s more than both others, s = √2 a φ.
        let (k, reach) = (0.25 * stiffness, arm * std::f64::consts::SQRT_2);
        let s = reach * by;
        let all = 2.0 * k * s * reach;
        let three = reach * k * (weight / k + 2.0 * s) / 3.0;
        match s * k / weight {
            part if part <= 0.25 => all,
            part if part <= 1.0 => three,
            _ => weight * reach,
        }
    };
    let curves: [Curve<'_>; 4] = [
        (&along, [1.0, 0.0]),
        (&along, [0.0, 1.0]),
        (&along, [0.0, -1.0]),
        (&diagonal, [FRAC_1_SQRT_2, -FRAC_1_SQRT_2]),
    ];
    for (due, direction) in curves {
        let settled = settle(building, STANDARD_GRAVITY).expect("it bears its weight");
        let mut pattern = vec![0.0; building.equations.len()];
        for (dof, share) in dofs.into_iter().zip(direction) {
            pattern[dof] = share;
        }
        let lead = if direction[1] == 0.0 { 0 } else { 1 };
        let mut path = EquilibriumPath::driven(building, &settled, pattern, dofs[lead]);
        // The edge lifts at W/(K_z a); the last corner at 4 W/(K_z √2 a).
        let unit = weight / (stiffness * arm);
        let mut passed = 0.0;
        for part in [0.4, 0.6, 0.9, 1.3, 2.0, 2.7, 4.0] {
            let by = unit * part;
            let mut left = (by - passed) * direction[lead].abs();
            passed = by;
            while left > 1e-16 {
                path.find_rates().expect("it stands");
                let before = path.displacement()[dofs[lead]];
                path.advance(left).expect("few corners");
                left -= (path.displacement()[dofs[lead]] - before).abs();
            }
            let (found, due) = (path.load().abs(), due(by));
            println!("{direction:?} {part}: {found} {due}");
            assert!(
                (found / due - 1.0).abs() < 1e-9,
                "{direction:?}: {found} {due}"
            );
        }
    }
}

/// A curve, and the direction in which it is followed.
type Curve<'a> = (&'a dyn Fn(f64) -> f64, [f64; 2]);

fn turned(point: PlanPoint) -> PlanPoint {
    [-point[1], point[0]]
}

/// A building without symmetry, and the same with its foundation and its shaking turned by 90°.
#[test]
fn turned_by_a_quarter_it_moves_as_before() {
    let mut known = tiers(&rectangle(0.0, 0.0, 12.0, 8.0));
    known.floors[2].centre = [5.0, 5.0];
    known.floors[0].centre = [7.0, 3.5];
    let mut other = known.clone();
    for floor in &mut other.floors {
        floor.plan = floor.plan.iter().map(|plan| turned(*plan)).collect();
        floor.centre = turned(floor.centre);
    }
    for storey in &mut other.storeys {
        storey.stiffness.swap(0, 1);
        storey.centre = turned(storey.centre);
    }
    let foundation = Foundation {
        uplift: Some(bed(5, 3)),
        torsional_stiffness: Some(4e9),
        ..Foundation::rectangle(9.0, 7.0, 190e3)
    };
    let motion = |angle: f64| {
        let across = shaking("across", 7.0, 1.2);
        from(shaking("line", 4.0, 1.6), angle, Some(across))
    };
    let of = |tiers: Tiers, foundation: Foundation, angle: f64| {
        let model = lifting(Structure::Tiers(tiers), foundation, Solver::Riccati);
        run(&model, &motion(angle)).1
    };
    let known = of(known, foundation, 0.3);
    let other = of(other, foundation.turned(), 0.3 + 0.25 * TAU);
    for floor in 1..=3 {
        let place = Column::displacement(0, floor);
        for (a, b, sign) in [
            (place, place.across(), 1.0),
            (place.across(), place, -1.0),
            (place.turning(), place.turning(), 1.0),
        ] {
            let [a, b] = [column(&known, a), column(&other, b)];
            let b: Vec<f64> = b.iter().map(|value| sign * value).collect();
            let apart = difference(&b, &a);
            println!("floor {floor}: {apart:e}");
            assert!(largest(&a) > 1e-6 && apart < 1e-7, "{apart:e}");
        }
    }
    let lifted = |spring| {
        let place = Column::along(Owner::Spring(spring), Kind::Lifted);
        known
            .peaks
            .get(place)
            .map_or(0.0, |peak| peak.greatest.value)
    };
    assert!((0..15).any(|spring| lifted(spring) > 0.0));
}
