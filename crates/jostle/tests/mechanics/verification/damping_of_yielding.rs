//! What damping in proportion to stiffness does where parts yield: nothing new as long as they do not, and what independent
//! integration gives once they do.

use std::f64::consts::PI;

use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
use jostle::{
    Analysis, Building, Damping, GroundMotion, Hinges, LawKind, Model, Outcome, Plan,
    ProportionalDamping, Solver, Structure, System,
};

use crate::verification::support::{assembled, base_shears, law, row, run, shaking, tower};

/// The tower with bilinear storeys that yield at a deformation \[m\].
fn yielding(mut building: Building, deformation: f64, post_yield: f64) -> Building {
    let Structure::Shear(shear) = &building.structure else {
        panic!("towers are shear buildings");
    };
    let storeys = shear.stiffness.iter().map(|stiffness| {
        let corners = Corners::bilinear(stiffness * deformation, post_yield);
        let backbone = Backbone::from_forces(*stiffness, corners, corners).expect("sound");
        Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("the rule fits")
    });
    building.hinges = Some(Hinges::Storeys(storeys.collect()));
    building
}

fn outcome(model: &Model, solver: Option<Solver>, tolerance: f64) -> (System, Outcome) {
    let system = assembled(model);
    let analysis = Analysis {
        solver,
        tolerance,
        ..Analysis::default()
    };
    let motion = shaking(6.0);
    let plan = Plan::choose(&system, &motion, &analysis).expect("steps are found");
    let outcome = run(&system, &motion, &plan);
    (system, outcome)
}

/// Storeys that could yield, but do not, make no difference: peaks of a pair that pounds are those of the elastic pair, whatever
/// advances it. Without damping of what may yield they are far from it.
#[test]
fn storeys_that_never_yield_are_damped_like_elastic_ones() {
    let pair = |damping: Option<Option<ProportionalDamping>>| {
        let towers = [tower("a", 4, 2.5e5, 0.46), tower("b", 6, 3e5, 0.9)];
        let towers = towers.map(|mut building| {
            building.damping = Damping::ratio(0.07, [1, 3]);
            if let Some(damping) = damping {
                building = yielding(building, 0.9, 0.2);
                building.yielding_damping = damping;
            }
            building
        });
        row(towers.to_vec(), 0.02, law(LawKind::HertzDamp, 0.65))
    };
    let peaks = |outcome: &Outcome| -> Vec<f64> {
        let floors = outcome.peaks.buildings().flatten();
        let of_floors = floors.flat_map(|floor| [floor.total_acceleration(), floor.storey_drift()]);
        of_floors.chain(base_shears(outcome)).collect()
    };
    let tolerance = 1e-3;
    let elastic = outcome(&pair(None), None, tolerance).1;
    assert!(elastic.impacts.len() > 1);
    let elastic = peaks(&elastic);
    let off = |damping: Option<ProportionalDamping>, solver: Option<Solver>| {
        let peaks = peaks(&outcome(&pair(Some(damping)), solver, tolerance).1);
        let off = peaks.iter().zip(&elastic).map(|(a, b)| (a / b - 1.0).abs());
        off.fold(0.0, f64::max)
    };
    for solver in [None, Some(Solver::Riccati), Some(Solver::Stiffness)] {
        for damping in [
            None,
            Some(ProportionalDamping::Initial),
            Some(ProportionalDamping::Tangent),
        ] {
            let off = off(damping, solver);
            assert!(
                off < 2.0 * tolerance,
                "{damping:?} by {solver:?}: {off:.1e}"
            );
        }
        assert!(off(Some(ProportionalDamping::None), solver) > 0.1);
    }
}

/// One mass on a bilinear spring with a dashpot β k₀ or β k_t, by the rule of Runge and Kutta in steps of 5 µs.
fn by_runge_and_kutta(
    motion: &GroundMotion,
    [mass, stiffness, limit, post_yield, beta]: [f64; 5],
    damping: ProportionalDamping,
) -> [f64; 2] {
    let step = 5e-6;
    let rates = |time: f64, [u, v, z]: [f64; 3]| {
        let slides = z.abs() >= limit && z * v > 0.0;
        let force = stiffness * (post_yield * u + (1.0 - post_yield) * z);
        let dashpot = beta
            * stiffness
            * match damping {
                ProportionalDamping::Initial => 1.0,
                ProportionalDamping::Tangent if slides => post_yield,
                ProportionalDamping::Tangent => 1.0,
                ProportionalDamping::None => 0.0,
            };
        let a = -(force + dashpot * v) / mass - motion.acceleration(time);
        [v, a, if slides { 0.0 } else { v }]
    };
    let mut state = [0.0; 3];
    let mut peaks = [0.0_f64; 2];
    for k in 0..(motion.duration / step) as usize {
        let time = k as f64 * step;
        let moved = |by: f64, rates: [f64; 3]| std::array::from_fn(|i| state[i] + by * rates[i]);
        let k1 = rates(time, state);
        let k2 = rates(time + 0.5 * step, moved(0.5 * step, k1));
        let k3 = rates(time + 0.5 * step, moved(0.5 * step, k2));
        let k4 = rates(time + step, moved(step, k3));
        for i in 0..3 {
            state[i] += step / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
        }
        state[2] = state[2].clamp(-limit, limit);
        let total = rates(time + step, state)[1] + motion.acceleration(time + step);
        peaks = [peaks[0].max(state[0].abs()), peaks[1].max(total.abs())];
    }
    peaks
}

/// A mass whose spring yields again and again has the peaks that an independent integration finds, for each way of damping, by
/// power series and by direct steps.
#[test]
fn damping_acts_on_what_has_yielded_as_stated() {
    let (mass, period, limit, post_yield) = (1e5, 0.6, 0.01, 0.1);
    let motion = shaking(6.0);
    let stiffness = mass * (2.0 * PI / period).powi(2);
    let beta = 0.02;
    let mut found = Vec::new();
    for damping in [
        ProportionalDamping::Initial,
        ProportionalDamping::Tangent,
        ProportionalDamping::None,
    ] {
        let mut building = yielding(tower("a", 1, mass, period), limit, post_yield);
        building.damping = Damping::Rayleigh { alpha: 0.0, beta };
        building.yielding_damping = Some(damping);
        let mut model = row(vec![building], 0.0, law(LawKind::Linear, 1.0));
        model.gaps.clear();
        let properties = [mass, stiffness, limit, post_yield, beta];
        let known = by_runge_and_kutta(&motion, properties, damping);
        assert!(known[0] > 3.0 * limit, "it yields");
        for (solver, allowed) in [(None, 2e-5), (Some(Solver::Riccati), 2e-5)] {
            let outcome = outcome(&model, solver, 1e-5).1;
            let floor = &outcome.peaks.floor(0, 1);
            let moved = floor
                .displacement_max()
                .value
                .max(-floor.displacement_min().value);
            for (got, known) in [moved, floor.total_acceleration()].iter().zip(known) {
                let off = (got / known - 1.0).abs();
                assert!(
                    off < allowed,
                    "{damping:?} by {solver:?}: {got} for {known}, {off:.1e}"
                );
            }
            let lost = outcome.energy.imbalance();
            assert!(lost < 1e-4, "{damping:?} by {solver:?}: {lost:.1e}");
        }
        found.push(known[0]);
    }
    // The more is damped, the less it moves.
    assert!(
        found[0] < 0.97 * found[1] && found[1] < 0.97 * found[2],
        "{found:?}"
    );
}

/// Where a dashpot follows the tangent, its force jumps as a storey yields, and accelerations jump with it. Direct steps end
/// there: errors of fixed steps fall with the square of the step, and automatic ones keep the tolerance.
#[test]
fn direct_steps_end_where_damping_jumps() {
    let mut building = yielding(tower("a", 4, 4e5, 0.7), 0.003, 0.05);
    building.damping = Damping::Rayleigh {
        alpha: 0.0,
        beta: 0.02,
    };
    building.yielding_damping = Some(ProportionalDamping::Tangent);
    let mut model = row(vec![building], 0.0, law(LawKind::Linear, 1.0));
    model.gaps.clear();
    let peaks = |outcome: &Outcome| -> [Vec<f64>; 2] {
        let floors = &outcome.peaks.floors(0);
        [
            floors.iter().map(|f| f.total_acceleration()).collect(),
            floors.iter().map(|f| f.storey_drift()).collect(),
        ]
    };
    let known = peaks(&outcome(&model, None, 1e-6).1);
    let error = |outcome: &Outcome| {
        let kinds = peaks(outcome).into_iter().zip(&known);
        let errors = kinds.map(|(got, known)| {
            let greatest = known.iter().fold(0.0_f64, |most, v| most.max(*v));
            let apart = got.iter().zip(known).map(|(a, b)| (a - b).abs());
            apart.fold(0.0, f64::max) / greatest
        });
        errors.fold(0.0, f64::max)
    };
    for tolerance in [1e-3, 1e-4, 1e-5] {
        let found = error(&outcome(&model, Some(Solver::Riccati), tolerance).1);
        assert!(found < tolerance, "{found:.1e} at {tolerance}");
    }
    let (system, motion) = (assembled(&model), shaking(6.0));
    let errors = [2e-3, 5e-4].map(|step| {
        let analysis = Analysis {
            solver: Some(Solver::Riccati),
            step: Some(step),
            ..Analysis::default()
        };
        let plan = Plan::choose(&system, &motion, &analysis).expect("steps are found");
        error(&run(&system, &motion, &plan))
    });
    assert!(errors[1] < errors[0] / 10.0, "{errors:?}");
}
