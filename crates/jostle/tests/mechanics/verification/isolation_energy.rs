//! What summaries say of bearings: energy stored and dissipated, against loops of force and displacement in one plane and against
//! the rate equation in plan; residual strokes, limits and the mat as floor 0, against the motion of the mat.

use jostle::history::Owner;
use jostle::results::summary::{BuildingSummary, IsolationInPlan};
use jostle::{
    Column, GroundMotion, Isolation, Isolator, Model, Outcome, Plan, SlidingSurface, Stop,
    Structure, Summary, System,
};

use crate::verification::isolation_in_plan::{
    self as plan, ByRates, PLACES, eccentric_block, two_components,
};
use crate::verification::support::{assembled, column, law, row, shaking, steps, tower};

fn summary(
    model: &Model,
    system: &System,
    motion: &GroundMotion,
    outcome: &Outcome,
) -> BuildingSummary {
    let mut summary = Summary::new(&jostle::Run {
        model,
        system,
        motion,
        plan: &steps(1e-3, 1),
        outcome,
        without_contact: None,
        wall: 0.0,
    });
    summary.buildings.remove(0)
}

/// A tower of three storeys on bearings without a dashpot.
fn isolated(isolator: Isolator, stops: [Option<Stop>; 2]) -> Model {
    let mut building = tower("isolated", 3, 3e4, 0.5);
    let mut isolation = Isolation::new(isolator, 6e4);
    isolation.stops = stops;
    building.base.isolation = Some(isolation);
    row(vec![building], 0.0, law(jostle::LawKind::Hertz, 1.0))
}

fn double_pendulum() -> Isolator {
    let surface = |radius, friction| SlidingSurface {
        radius,
        friction,
        capacity: 0.02,
    };
    Isolator::DoublePendulum {
        surfaces: [surface(1.0, 0.02), surface(1.5, 0.05)],
        slip_displacement: 1e-3,
    }
}

/// Area of the loops of the bearings, as a sum of trapezia over all steps.
fn loops(outcome: &Outcome) -> f64 {
    let force = column(outcome, Column::support_force(0));
    let moved = column(outcome, Column::displacement(0, 0));
    let pairs = force.windows(2).zip(moved.windows(2));
    pairs
        .map(|(f, u)| 0.5 * (f[0] + f[1]) * (u[1] - u[0]))
        .sum()
}

/// Energy of the storeys of a shear building at the end.
fn in_storeys(model: &Model, outcome: &Outcome) -> f64 {
    let Structure::Shear(shear) = &model.buildings[0].structure else {
        panic!("it is one");
    };
    let floors = (0..=3).map(|floor| column(outcome, Column::displacement(0, floor)));
    let ends: Vec<f64> = floors
        .map(|floor| *floor.last().expect("recorded"))
        .collect();
    let storeys = ends.windows(2).zip(&shear.stiffness);
    storeys.map(|(u, k)| 0.5 * k * (u[1] - u[0]).powi(2)).sum()
}

/// What the bearings have dissipated is the area of their loops without what they store: K₂u²/2 of the stiffness after yield, W/R of a
/// pendulum, and f²/2k of what slides beside it; of several surfaces that of every bowl and F²/2k. All is elastic above them, and stops
/// give all back.
#[test]
fn bearings_in_one_plane_dissipate_the_area_of_their_loops() {
    let stop = Stop {
        at: 0.03,
        stiffness: 2e7,
    };
    let weight = jostle::model::STANDARD_GRAVITY * (6e4 + 3.0 * 3e4);
    for (name, isolator, stops) in [
        ("lead-rubber", plan::lead_rubber(), [None; 2]),
        (
            "lead-rubber between stops",
            plan::lead_rubber(),
            [Some(stop); 2],
        ),
        ("pendulum", plan::pendulum(), [None; 2]),
        ("double pendulum", double_pendulum(), [None; 2]),
        (
            "pendulum, rising friction",
            plan::fast_pendulum(),
            [None; 2],
        ),
    ] {
        let model = isolated(isolator, stops);
        let system = assembled(&model);
        // Cut off while it moves.
        let motion = shaking(3.0);
        let outcome = crate::verification::support::run(&system, &motion, &steps(1e-3, 1));
        let isolation = summary(&model, &system, &motion, &outcome)
            .isolation
            .expect("isolated");
        let end = |of| *column(&outcome, of).last().expect("recorded");
        let force = end(Column::support_force(0));
        let moved = end(Column::displacement(0, 0));
        let stored = match isolator {
            Isolator::LeadRubber {
                stiffness,
                post_yield,
                ..
            } => {
                let second = post_yield * stiffness;
                let held = force - second * moved;
                0.5 * second * moved * moved + 0.5 * held * held / (stiffness - second)
            }
            Isolator::Pendulum {
                radius,
                friction,
                slip_displacement,
            } => {
                let (second, slider) =
                    (weight / radius, friction.fast * weight / slip_displacement);
                let held = force - second * moved;
                0.5 * second * moved * moved + 0.5 * held * held / slider
            }
            Isolator::DoublePendulum {
                surfaces,
                slip_displacement,
            } => {
                let [first, second] = surfaces.map(|surface| surface.friction);
                let elastic = first.min(second) * weight / slip_displacement;
                let springs = &system.buildings[0].equations.springs;
                let places = springs[0].hysteresis.places(&outcome.state.springs[0]);
                let sum = places.iter().sum::<f64>() + force / elastic;
                assert!((sum - moved).abs() < 1e-9, "{sum} m and {moved} m");
                let bowls = surfaces.iter().zip(places);
                let bowls = bowls.map(|(surface, at)| 0.5 * weight / surface.radius * at * at);
                0.5 * force * force / elastic + bowls.sum::<f64>()
            }
            Isolator::Linear { .. }
            | Isolator::HighDampingRubber { .. }
            | Isolator::TriplePendulum { .. } => panic!("it is none of them"),
        };
        let area = loops(&outcome);
        let due = area - stored;
        let off = (isolation.hysteretic_j - due).abs() / area;
        assert!(
            off < 1e-8,
            "{name}: {} J instead of {due} J",
            isolation.hysteretic_j
        );
        assert!(
            stored > 1e-3 * area,
            "{name}: {stored} J of {area} J prove nothing"
        );
        // The balance has the same energy, and that stored among what is elastic, with what stops hold. Steps in which a stop is
        // reached make a little.
        let tolerance = if stops[0].is_some() { 2e-4 } else { 1e-8 };
        let off = (outcome.energy.hysteretic - due).abs() / area;
        assert!(off < tolerance, "{name}: {off}");
        let pressed = (moved.abs() - stop.at).max(0.0);
        let held = if stops[0].is_some() {
            0.5 * stop.stiffness * pressed * pressed
        } else {
            0.0
        };
        let elastic = in_storeys(&model, &outcome) + stored + held;
        let off = (outcome.energy.strain / elastic - 1.0).abs();
        assert!(
            off < 1e-8,
            "{name}: {} J instead of {elastic} J",
            outcome.energy.strain
        );
        assert_eq!(isolation.residual_m, moved);
        let stroke = isolation
            .displacement_max_m
            .max(-isolation.displacement_min_m);
        if stops[0].is_some() {
            let peak = stop.stiffness * (stroke - stop.at);
            let found = isolation.stop_force_peak_n.expect("it has stops");
            assert!(
                peak > 1e4 && (found / peak - 1.0).abs() < 1e-3,
                "{found} and {peak}"
            );
        }
    }
}

/// In plan: sliders of four bearings against the rate equation, integrated for itself. Errors of the steps are of second order.
#[test]
fn bearings_in_plan_dissipate_and_store_what_the_rate_equation_says() {
    for (name, isolator) in [
        ("lead-rubber", plan::lead_rubber()),
        ("pendulum", plan::pendulum()),
        ("pendulum, rising friction", plan::fast_pendulum()),
    ] {
        let motion = plan::from(
            plan::shaking("first", 4.0, 0.5),
            0.4,
            Some(plan::shaking("across", 5.3, 0.4)),
        );
        let model = eccentric_block(isolator, 5e-4);
        let rates = ByRates::new(&model);
        let (state, _) = rates.run(&motion, motion.duration, 1e-5);
        let (dissipated, stored) = (state[20], rates.stored(&state));
        let (system, outcome) = plan::run(&model, &motion);
        let told = summary(&model, &system, &motion, &outcome)
            .isolation
            .expect("isolated");
        let found = told.hysteretic_j;
        println!(
            "{name}: {found} and {dissipated}, {} and {stored}",
            outcome.energy.strain
        );
        let off = (found / dissipated - 1.0).abs();
        assert!(off < 2e-5, "{name}: {found} J instead of {dissipated} J");
        assert!(
            (outcome.energy.hysteretic - found).abs() < 1e-9 * found,
            "{name}"
        );
        let off = (outcome.energy.strain - stored).abs();
        assert!(
            off < 1e-6 * dissipated,
            "{name}: {} J instead of {stored} J",
            outcome.energy.strain
        );
        assert!(
            stored > 1e-3 * dissipated,
            "{name}: {stored} J prove nothing"
        );
    }
}

/// Displacements of the mat at every recorded instant: along x, across, and rotation.
fn mat(outcome: &Outcome) -> Vec<[f64; 3]> {
    let (building, floor) = (0, 0);
    let [u, v, turn] = [
        Column::displacement(building, floor),
        Column::displacement(building, floor).across(),
        Column::displacement(building, floor).turning(),
    ]
    .map(|quantity| column(outcome, quantity));
    let rows = u.iter().zip(&v).zip(&turn);
    rows.map(|((u, v), turn)| [*u, *v, *turn]).collect()
}

/// The bearing with the greatest stroke, and that stroke.
fn farthest(motion: &[f64; 3]) -> (usize, f64) {
    let strokes = PLACES.map(|at| {
        let [x, y] = ByRates::bearing(at, motion);
        x.hypot(y)
    });
    let all = strokes.into_iter().enumerate();
    all.fold(
        (0, 0.0),
        |best, stroke| if stroke.1 > best.1 { stroke } else { best },
    )
}

/// The bearing that is farthest from its place counts, during the run and at its end; limits are those of every bearing.
#[test]
fn strokes_are_those_of_the_worst_bearing() {
    let motion = two_components(0.4);
    let model = eccentric_block(plan::lead_rubber(), 1e-3);
    let (system, outcome) = plan::run(&model, &motion);
    let report = summary(&model, &system, &motion, &outcome);
    let told = report.isolation.clone().expect("isolated");
    let in_plan: IsolationInPlan = told.in_plan.expect("in plan");
    let rows = mat(&outcome);
    let end = rows.last().expect("recorded");
    let (last, residual) = farthest(end);
    // Neither the middle of the mat nor another bearing has that stroke.
    let others = PLACES.map(|at| {
        let [x, y] = ByRates::bearing(at, end);
        x.hypot(y)
    });
    let nearest = others.into_iter().fold(f64::INFINITY, f64::min);
    assert!(
        residual > 1.05 * nearest && residual > 1.02 * end[0].hypot(end[1]),
        "{others:?}"
    );
    assert!(
        (in_plan.residual_stroke_m / residual - 1.0).abs() < 1e-9,
        "bearing {last}"
    );
    assert_eq!(told.residual_stroke_m(), in_plan.residual_stroke_m);
    assert_eq!(
        [told.residual_m, in_plan.residual_across_m],
        [end[0], end[1]]
    );
    let peaks: Vec<(usize, f64)> = rows.iter().map(farthest).collect();
    let all = peaks.iter().enumerate();
    let (at, (bearing, stroke)) = all.fold((0, (0, 0.0)), |best, (at, peak)| {
        if peak.1 > best.1.1 { (at, *peak) } else { best }
    });
    assert_eq!(in_plan.stroke_bearing, bearing + 1);
    assert!((in_plan.stroke_peak_m / stroke - 1.0).abs() < 1e-4);
    let time = column(&outcome, Column::TIME)[at];
    assert!((in_plan.stroke_peak_at_s - time).abs() < 2e-3, "{time}");
    let extreme = |axis: usize, sign: f64| {
        let values = rows.iter().map(|row| sign * row[axis]);
        sign * values.fold(0.0, f64::max)
    };
    for (found, due) in [
        (told.displacement_max_m, extreme(0, 1.0)),
        (told.displacement_min_m, extreme(0, -1.0)),
        (in_plan.displacement_across_max_m, extreme(1, 1.0)),
        (in_plan.displacement_across_min_m, extreme(1, -1.0)),
    ] {
        assert!((found / due - 1.0).abs() < 1e-3, "{found} instead of {due}");
    }
    let force = column(&outcome, Column::support_force(0).across());
    let due = force
        .iter()
        .fold(0.0_f64, |most, force| most.max(force.abs()));
    assert!((in_plan.force_across_peak_n / due - 1.0).abs() < 1e-9);
    assert!(
        (told.force_peak_n / due - 1.0).abs() > 0.02,
        "along and across differ"
    );
    // A limit between the displacement of the mat along x and the stroke of the bearing is exceeded, one above the stroke is not.
    let along = told.displacement_max_m.max(-told.displacement_min_m);
    assert!(along < 0.97 * stroke);
    for (limit, exceeded) in [(0.5 * (along + stroke), true), (1.01 * stroke, false)] {
        let mut limited = model.clone();
        if let Some(isolation) = &mut limited.buildings[0].base.isolation {
            isolation.limit = Some(limit);
        }
        let (system, outcome) = plan::run(&limited, &motion);
        let told = summary(&limited, &system, &motion, &outcome)
            .isolation
            .expect("isolated");
        assert_eq!(told.limit_exceeded, exceeded, "{limit}");
        let ratio = told.stroke_ratio().expect("a limit");
        assert!((ratio - in_plan.stroke_peak_m / limit).abs() < 1e-12);
    }
    // The mat is floor 0.
    let floor = report
        .floors
        .mat
        .as_ref()
        .expect("a mat")
        .in_plan
        .expect("in plan");
    assert_eq!(
        floor.displacement_across_max_m,
        in_plan.displacement_across_max_m
    );
    let base = outcome.peaks.owned_by(Owner::Building(0)).across();
    assert_eq!(floor.storey_shear_across_peak_n, base.storey_shear());
}

/// The same in one plane: either side counts.
#[test]
fn limits_in_one_plane_hold_on_both_sides() {
    let model = isolated(plan::lead_rubber(), [None; 2]);
    let with = |scale: f64, limit: f64| {
        let mut model = model.clone();
        if let Some(isolation) = &mut model.buildings[0].base.isolation {
            isolation.limit = Some(limit);
        }
        let mut motion = shaking(4.0);
        motion.scale = scale;
        let system = assembled(&model);
        let plan: Plan = steps(1e-3, 1);
        let outcome = crate::verification::support::run(&system, &motion, &plan);
        let isolation = summary(&model, &system, &motion, &outcome)
            .isolation
            .expect("isolated");
        let moved = column(&outcome, Column::displacement(0, 0));
        assert_eq!(
            isolation.residual_stroke_m(),
            moved.last().expect("recorded").abs()
        );
        (
            isolation.displacement_max_m,
            -isolation.displacement_min_m,
            isolation.limit_exceeded,
            isolation.displacement_peak_m(),
        )
    };
    let (right, left, _, stroke) = with(1.0, 1.0);
    assert_eq!(stroke, right.max(left));
    let limit = 0.5 * (right + left);
    assert!((right / left - 1.0).abs() > 0.02, "{right} and {left}");
    // The other way round, the other side exceeds it.
    for scale in [1.0, -1.0] {
        assert!(with(scale, limit).2 && !with(scale, 1.01 * stroke).2);
    }
}
