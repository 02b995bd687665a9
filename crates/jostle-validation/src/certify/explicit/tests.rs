//! The reference against closed forms and against the other reference.

use jostle_io::{Format, read_model_text};

use super::*;
use crate::certify::quantities::quantities_of;
use crate::certify::reference::{Accuracy, run as by_modes};
use crate::certify::{draw, read};

fn peaks(text: &str) -> Peaks {
    let input = read_model_text("test", text, Format::Json, "".as_ref()).expect("a sound model");
    let motion = input.ground_motion().expect("a motion");
    let system = System::assemble(&input.model).expect("a sound model");
    run(&system, &motion, Fineness::FINE).expect("a reference")
}

fn near(got: f64, expected: f64, share: f64, what: &str) {
    let error = (got / expected - 1.0).abs();
    assert!(
        error <= share,
        "{what}: {got} for {expected}, off by {error:e}"
    );
}

/// Numbers of random models that do not yield are those of the reference by modes.
#[test]
fn elastic_models_move_as_the_reference_by_modes_says() {
    let (mut compared, mut models) = (0, 0);
    for number in 1..=400 {
        let drawn = draw(71, number);
        let (input, motion) = read(&drawn).expect("a sound file");
        let system = System::assemble(&input.model).expect("a sound model");
        if system.len() > 10 || motion.duration > 9.0 {
            continue;
        }
        // Frames with massless joints and the momentum law are not part of it.
        let Ok(run) = run(&system, &motion, Fineness::FINE) else {
            continue;
        };
        let other = by_modes(&system, &motion, Accuracy::FINE).expect("a reference");
        let wider = by_modes(&system, &motion, Accuracy::OTHER).expect("a reference");
        let all = quantities_of(&system, &other).into_iter();
        let all = all.zip(quantities_of(&system, &wider));
        for ((quantity, wider), got) in all.zip(quantities_of(&system, &run)) {
            let scale = quantity.scale.max(1e-9);
            // What a gap wider by 1e-6 moves is not certain to more digits.
            let moved = (wider.value - quantity.value).abs() / scale;
            let error = (got.value - quantity.value).abs() / scale;
            assert!(
                error <= 2e-6 + moved,
                "model {number}: {quantity:?} is {} here, off by {error:e}",
                got.value
            );
            compared += 1;
        }
        models += 1;
        if models == 6 {
            break;
        }
    }
    assert!(
        models == 6 && compared > 150,
        "{models} models, {compared} numbers"
    );
}

/// A mass on a perfectly plastic spring under half a sine that yields at once goes as the ground and the yield force alone
/// say. It stops where both impulses are even.
#[test]
fn a_plastic_mass_under_a_sine_slides_as_far_as_the_closed_form_says() {
    // Nearly rigid before it yields at a tenth of the force.
    let (mass, amplitude, period) = (1e4_f64, 2.0_f64, 1.0_f64);
    let (strength, stiffness) = (2e3_f64, 1e8_f64);
    let yields = strength / stiffness;
    let text = format!(
        r#"{{"motion": {{"kind": "sine", "amplitude": {amplitude}, "period": {period}, "duration": 0.9}},
        "building": [{{"name": "A", "kind": "shear", "mass": [{mass}], "stiffness": [{stiffness:e}],
        "damping": {{"alpha": 0, "beta": 0}},
        "p_delta": false, "hinges": {{"rule": "bilinear", "yield": {yields:e}, "post_yield": 0}}}}]}}"#
    );
    let got = peaks(&text).buildings[0].least[0];
    // Elastic until it yields, then free under the ground and the yield force, to the instant of rest.
    let (frequency, big) = (
        (stiffness / mass).sqrt(),
        2.0 * std::f64::consts::PI / period,
    );
    let factor = amplitude / (frequency * frequency - big * big);
    let elastic = |t: f64| -factor * ((big * t).sin() - big / frequency * (frequency * t).sin());
    let elastic_rate = |t: f64| -factor * big * ((big * t).cos() - (frequency * t).cos());
    let root = |mut low: f64, mut high: f64, of: &dyn Fn(f64) -> f64| {
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if (of(low) < 0.0) == (of(middle) < 0.0) {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    };
    // The first time at which the spring yields is before it swings back.
    let start = (1..)
        .map(|k| 1e-5 * f64::from(k))
        .find(|t| elastic(*t) <= -yields)
        .expect("it yields");
    let start = root(start - 1e-5, start, &|t| elastic(t) + yields);
    let (x0, v0) = (elastic(start), elastic_rate(start));
    // ẍ = −a sin Ωt + F/m.
    let push = strength / mass;
    let rate = |t: f64| {
        v0 + amplitude / big * ((big * t).cos() - (big * start).cos()) + push * (t - start)
    };
    let end = root(0.5, 0.95, &rate);
    let way = |t: f64| {
        let s = t - start;
        x0 + v0 * s
            + amplitude / big
                * (((big * t).sin() - (big * start).sin()) / big - s * (big * start).cos())
            + 0.5 * push * s * s
    };
    assert!(way(end) < -0.1 * amplitude / (big * big), "it slides far");
    near(got, way(end), 1e-9, "displacement");
}

/// Strength rises from rest to speed as 1 − e^(−rate |v|), and a slider that turns sticks with its strength at rest.
#[test]
fn friction_rises_with_speed_and_sticks_with_its_strength_at_rest() {
    use slider::{Mode, Slider};
    let slider = Slider {
        stiffness: 1e6,
        slow: 1e3,
        fast: 3e3,
        rate: 20.0,
    };
    let slip = Mode::Slip(1.0);
    near(slider.force(slip, 0.0, 0.0), 1e3, 1e-12, "at rest");
    let halfway = 2.0_f64.ln() / 20.0;
    near(slider.force(slip, 0.0, halfway), 2e3, 1e-12, "halfway");
    let stick = slider.next(slip, 0.01, 0.0);
    near(
        slider.force(stick, 0.0095, -0.1),
        500.0,
        1e-9,
        "stuck again",
    );
}

/// A mass against a spring and a dashpot in series: ẍ = −F/m and Ḟ = k ẋ − (k/c) F.
#[test]
fn a_mass_on_a_dashpot_in_series_decays_as_two_roots_say() {
    use bodies::{Answer, Bodies, Link};
    let (mass, k, c) = (2.0_f64, 50.0_f64, 4.0_f64);
    let text = r#"{"motion": {"kind": "sine", "amplitude": 1e-9, "period": 1, "duration": 2},
        "building": [{"name": "A", "kind": "shear", "mass": [2000], "stiffness": [1e3], "damping": {"alpha": 0, "beta": 0}}]}"#;
    let input = read_model_text("test", text, Format::Json, "".as_ref()).expect("a sound model");
    let motion = input.ground_motion().expect("a motion");
    let system = System::assemble(&input.model).expect("a sound model");
    let mut bodies = Bodies::new(&system, 0.0).expect("a body");
    bodies.mass = vec![mass];
    bodies.driven[0] = vec![0.0];
    bodies.stiffness = bodies::Matrix::default();
    bodies.unknowns = 1;
    bodies.links.push(Link {
        row: vec![(0, 1.0)],
        rest: 0.0,
        inside: false,
        answer: Answer::Series {
            k,
            c,
            exponent: 1.0,
            unknown: 0,
        },
    });
    let mut run = Run::new(&system, &motion, &bodies, Fineness::FINE);
    run.state.v[0] = 1.0;
    run.go().expect("a run");
    // λ² + (k/c) λ + k/m = 0.
    let (half, omega) = (0.5 * k / c, (k / mass - 0.25 * k * k / c / c).abs().sqrt());
    assert!(k / mass < 0.25 * k * k / c / c, "two real roots");
    let t = motion.duration;
    let (a, b) = (-half + omega, -half - omega);
    // ẋ(0) = 1, ẍ(0) = 0.
    let rate = (a * (b * t).exp() - b * (a * t).exp()) / (a - b);
    near(run.state.v[0], rate, 1e-7, "rate");
}
