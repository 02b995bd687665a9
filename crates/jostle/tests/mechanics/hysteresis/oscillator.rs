//! One mass on a hysteretic spring: with iteration to convergence a Newmark step is of second order.

use jostle::hysteresis::{
    Backbone, Corners, Hysteresis, HysteresisMemory, HysteresisRule, Pinching,
};

const MASS: f64 = 100.0;
const DAMPING: f64 = 200.0;
const DURATION: f64 = 2.0;

fn load(time: f64) -> f64 {
    120.0 * (9.0 * time).sin() + 90.0 * (21.0 * time + 0.4).sin()
}

fn spring(rule: HysteresisRule) -> Hysteresis {
    let corners = Corners {
        cracking: 0.001,
        yielding: 0.006,
        post_cracking: 0.3,
        post_yield: 0.02,
    };
    let backbone = Backbone::from_deformations(1e5, corners, corners).expect("sound");
    Hysteresis::new(rule, backbone).expect("the rule fits")
}

/// Displacements at every hundredth of a second and the mean number of iterations a step.
///
/// Average acceleration; without `iterate` one solution with the tangent and the acceleration from equilibrium.
fn displacements(spring: &Hysteresis, step: f64, iterate: bool) -> (Vec<f64>, f64) {
    let mut memory = HysteresisMemory::default();
    let (mut speed, mut acceleration) = (0.0, load(0.0) / MASS);
    let steps = (DURATION / step).round() as usize;
    let every = (0.02 / step).round() as usize;
    let (mut kept, mut iterations) = (Vec::new(), 0);
    for n in 1..=steps {
        let force = load(n as f64 * step);
        let start = memory.deformation();
        let at = |u: f64| {
            let a = 4.0 / (step * step) * (u - start) - 4.0 / step * speed - acceleration;
            (speed + 0.5 * step * (acceleration + a), a)
        };
        let mut u = start;
        for round in 1..=30 {
            let response = spring.respond(&memory, u);
            let (v, a) = at(u);
            let residual = force - MASS * a - DAMPING * v - response.force;
            let tangent = 4.0 * MASS / (step * step) + 2.0 * DAMPING / step + response.tangent;
            u += residual / tangent;
            iterations += 1;
            let converged = (residual / tangent).abs() < 1e-13 * 0.01;
            assert!(round < 30 || !iterate, "no convergence");
            if converged || !iterate {
                break;
            }
        }
        let (v, a) = at(u);
        memory = spring.respond(&memory, u).memory;
        speed = v;
        acceleration = if iterate {
            a
        } else {
            (force - DAMPING * v - memory.force()) / MASS
        };
        if n % every == 0 {
            kept.push(u);
        }
    }
    (kept, iterations as f64 / steps as f64)
}

fn error(a: &[f64], b: &[f64]) -> f64 {
    let largest = b.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let worst = a
        .iter()
        .zip(b)
        .fold(0.0_f64, |m, (x, y)| m.max((x - y).abs()));
    worst / largest
}

#[test]
fn iterated_steps_are_of_second_order() {
    let rules = [
        HysteresisRule::Normal,
        HysteresisRule::PeakOriented,
        HysteresisRule::Takeda { exponent: 0.4 },
        HysteresisRule::DegradingTrilinear,
        HysteresisRule::Pinched(Pinching::USUAL),
    ];
    for rule in rules {
        let spring = spring(rule);
        let (reference, _) = displacements(&spring, 2.5e-5, true);
        let errors = [0.01, 0.005, 0.0025, 0.00125].map(|step| {
            let (iterated, rounds) = displacements(&spring, step, true);
            let (single, _) = displacements(&spring, step, false);
            (
                error(&iterated, &reference),
                error(&single, &reference),
                rounds,
            )
        });
        println!("{}: {errors:?}", rule.name());
        let order = (errors[0].0 / errors[3].0).log2() / 3.0;
        assert!(order > 1.6, "{}: order {order}", rule.name());
        let (iterated, single, rounds) = errors[3];
        assert!(iterated < 1e-3, "{}: {iterated}", rule.name());
        assert!(
            single > 10.0 * iterated,
            "{}: {single} without iteration",
            rule.name()
        );
        assert!(rounds < 3.5, "{}: {rounds} iterations a step", rule.name());
    }
}
