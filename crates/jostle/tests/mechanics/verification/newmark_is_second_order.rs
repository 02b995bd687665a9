use jostle::{GroundMotion, Plan, System};

use crate::verification::support::{
    assembled, colliding_towers, frame, framed, largest, law, row, run, shaking, slider, steps,
};
use jostle::LawKind;

/// Order from the errors at h and h/2.
fn order(coarse: f64, fine: f64) -> f64 {
    (coarse / fine).log2()
}

/// Exact displacement of a damped oscillator under straight pieces of ground acceleration.
fn exact(omega: f64, ratio: f64, step: f64, ground: &[f64]) -> Vec<f64> {
    let (k, damped) = (omega * omega, omega * (1.0 - ratio * ratio).sqrt());
    let (mut u, mut v) = (0.0, 0.0);
    let mut history = vec![0.0];
    for pair in ground.windows(2) {
        // ü + 2ζω u̇ + ω² u = p + s t: particular solution b + c t, then free decay of the rest.
        let (p, s) = (-pair[0], -(pair[1] - pair[0]) / step);
        let c = s / k;
        let b = (p - 2.0 * ratio * omega * c) / k;
        let (x0, v0) = (u - b, v - c);
        let (sin, cos) = (damped * step).sin_cos();
        let decay = (-ratio * omega * step).exp();
        let q = (v0 + ratio * omega * x0) / damped;
        let x = decay * (x0 * cos + q * sin);
        let dx = decay
            * ((-ratio * omega * x0 + q * damped) * cos + (-ratio * omega * q - x0 * damped) * sin);
        u = x + b + c * step;
        v = dx + c;
        history.push(u);
    }
    history
}

#[test]
fn newmark_is_second_order_on_a_damped_oscillator() {
    let (omega, ratio, mass) = (9.0, 0.07, 3e4);
    let mut oscillator = slider("oscillator", mass, Some(mass * omega * omega));
    // Damping split between mass and stiffness: both paths of the equations.
    oscillator.structure.equations.alpha = ratio * omega;
    oscillator.structure.equations.beta = ratio / omega;
    let system = System::of_buildings(vec![oscillator]);
    let motion = shaking(2.0);
    let points: Vec<f64> = (0..=200)
        .map(|k| motion.acceleration(f64::from(k) * 0.01))
        .collect();
    let truth = exact(omega, ratio, 0.01, &points);
    let error = |step: f64| {
        let apart: Vec<f64> = [60, 120, 200]
            .into_iter()
            .map(|k| {
                let cut = GroundMotion {
                    duration: f64::from(k) * 0.01,
                    ..motion.clone()
                };
                run(&system, &cut, &steps(step, 1)).state.displacement[0] - truth[k as usize]
            })
            .collect();
        largest(&apart)
    };
    let errors: Vec<f64> = (0..6).map(|n| error(0.01 / f64::from(1 << n))).collect();
    for (n, pair) in errors.windows(2).enumerate() {
        let order = order(pair[0], pair[1]);
        assert!(
            (order - 2.0).abs() <= 0.1,
            "halving {n}: order {order}, errors {errors:?}"
        );
    }
}

#[test]
fn newmark_is_second_order_on_a_frame() {
    let mut building = framed("frame", frame(4, &[4.0, 6.0]));
    if let jostle::Structure::Frame(frame) = &mut building.structure {
        frame.joint.rotational_stiffness = Some(3e8);
        frame.axial.columns_flexible = true;
    }
    let system = assembled(&row(vec![building], 0.0, law(LawKind::Hertz, 1.0)));
    let motion = shaking(1.5);
    let roof = system.buildings[0].floors[3].dof;
    let at = |step: f64| run(&system, &motion, &steps(step, 1)).state.displacement[roof];
    let answers: Vec<f64> = (0..5).map(|n| at(0.005 / f64::from(1 << n))).collect();
    let changes: Vec<f64> = answers
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).abs())
        .collect();
    for pair in changes.windows(2) {
        let order = order(pair[0], pair[1]);
        assert!(
            (order - 2.0).abs() <= 0.1,
            "order {order}, answers {answers:?}"
        );
    }
}

#[test]
fn linear_acceleration_is_second_order_too() {
    let (omega, mass) = (7.0, 1e4);
    let system = System::of_buildings(vec![slider("oscillator", mass, Some(mass * omega * omega))]);
    let motion = shaking(1.0);
    let points: Vec<f64> = (0..=100)
        .map(|k| motion.acceleration(f64::from(k) * 0.01))
        .collect();
    let truth = exact(omega, 0.0, 0.01, &points)[100];
    let error = |step: f64| {
        let plan = Plan {
            integrator: jostle::Integrator::newmark(1.0 / 6.0, 0.5),
            ..steps(step, 1)
        };
        (run(&system, &motion, &plan).state.displacement[0] - truth).abs()
    };
    for n in 0..4 {
        let step = 0.01 / f64::from(1 << n);
        let order = order(error(step), error(0.5 * step));
        assert!((order - 2.0).abs() <= 0.1, "order {order} at h = {step} s");
    }
}

/// Locating the touch and interpolating the peak keep the order through an impact.
#[test]
fn peak_force_of_an_impact_is_of_second_order() {
    for (kind, system) in colliding_towers() {
        let motion = shaking(1.0);
        let peak = |step: f64| run(&system, &motion, &steps(step, 1)).impacts[0].peak_force;
        let answers: Vec<f64> = (0..5).map(|n| peak(1e-3 / f64::from(1 << n))).collect();
        let changes: Vec<f64> = answers
            .windows(2)
            .map(|pair| (pair[1] - pair[0]).abs())
            .collect();
        // The phase of the touch scatters single changes; three halvings must gain a factor of 64 or so.
        let order = order(changes[0], changes[3]) / 3.0;
        assert!(order >= 1.7, "{kind:?}: order {order}, answers {answers:?}");
    }
}
