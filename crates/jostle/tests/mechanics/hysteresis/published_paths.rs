//! Paths of springs computed by others.

use jostle::hysteresis::{
    Backbone, Corners, FallingBranch, Hysteresis, HysteresisMemory, HysteresisRule, Pinching,
};
use serde_json::Value;

fn document(text: &str) -> Value {
    serde_json::from_str(text).expect("stored data are valid JSON")
}

fn numbers(value: &Value) -> Vec<f64> {
    let list = value.as_array().expect("a list");
    list.iter().map(|v| v.as_f64().expect("a number")).collect()
}

fn spring(rule: HysteresisRule, initial: f64, sides: [Corners; 2]) -> Hysteresis {
    let backbone = Backbone::from_deformations(initial, sides[0], sides[1]).expect("sound");
    Hysteresis::new(rule, backbone).expect("the rule fits")
}

#[test]
fn sequences_of_an_independent_prototype() {
    let stored = document(include_str!("data/sequences.json"));
    let corners = Corners {
        cracking: 0.001,
        yielding: 0.006,
        post_cracking: 0.3,
        post_yield: 0.02,
    };
    let rules = [
        ("normal", HysteresisRule::Normal),
        ("takeda", HysteresisRule::Takeda { exponent: 0.4 }),
        ("clough", HysteresisRule::Takeda { exponent: 0.0 }),
    ];
    for (name, rule) in rules {
        let spring = spring(rule, 1e5, [corners; 2]);
        for sequence in ["A", "B", "C"] {
            let at = |key: &str| numbers(&stored["sequences"][name][sequence][key]);
            let mut memory = HysteresisMemory::default();
            for ((rotation, moment), tangent) in at("theta").into_iter().zip(at("M")).zip(at("k")) {
                let response = spring.respond(&memory, rotation);
                assert!(
                    (response.force - moment).abs() < 1e-10 * 250.0,
                    "{name} {sequence} at {rotation}: {} for {moment}",
                    response.force
                );
                // At a corner the stored slope is that of the line behind.
                let from = memory.deformation();
                let behind = spring.respond(&memory, from + (1.0 - 1e-9) * (rotation - from));
                assert!(
                    (behind.tangent - tangent).abs() < 1e-8 * 1e5,
                    "{name} {sequence} at {rotation}: slope {} for {tangent}",
                    behind.tangent
                );
                memory = response.memory;
            }
        }
    }
}

/// Forces at reversals and quarter points, work and zero crossings of one protocol.
fn follows(text: &str, rule: HysteresisRule) {
    let stored = document(text);
    let corners = Corners {
        cracking: 1.0,
        yielding: 4.0,
        post_cracking: 1.0 / 3.0,
        post_yield: 0.05,
    };
    let spring = spring(rule, 100.0, [corners; 2]);
    let protocol = numbers(&stored["inputs"]["protocol"]);
    let expected = &stored["expected"];
    let work = numbers(&expected["cumulative_work_at_reversals"]);
    let mut crossings = numbers(&expected["zero_force_crossings"]).into_iter();
    let (mut memory, mut done) = (HysteresisMemory::default(), 0.0);
    for (leg, ends) in protocol.windows(2).enumerate() {
        let [from, to] = [ends[0], ends[1]];
        let quarters = numbers(&expected["at_quarter_points"][leg]["quarter"]);
        for (share, force) in [0.25, 0.5, 0.75].into_iter().zip(quarters) {
            let response = spring.respond(&memory, from + share * (to - from));
            assert!(
                (response.force - force).abs() < 1e-6,
                "leg {leg}: {} for {force}",
                response.force
            );
        }
        let response = spring.respond(&memory, to);
        let force = expected["at_reversals"][leg + 1]["F"]
            .as_f64()
            .expect("a force");
        assert!(
            (response.force - force).abs() < 1e-6,
            "leg {leg}: {}",
            response.force
        );
        done += response.work;
        let due = work[leg + 1];
        // The stored work is a fine sum, ours is exact.
        assert!(
            (done - due).abs() < 1e-4 * due.abs(),
            "leg {leg}: {done} J for {due} J"
        );
        if memory.force() * response.force < 0.0 {
            let crossing = crossings.next().expect("as many crossings");
            let before = spring
                .respond(&memory, crossing - 0.003 * (to - from).signum())
                .force;
            let after = spring
                .respond(&memory, crossing + 0.003 * (to - from).signum())
                .force;
            assert!(
                before * after <= 0.0,
                "leg {leg}: no crossing at {crossing}"
            );
        }
        memory = response.memory;
    }
    assert_eq!(crossings.count(), 0, "crossings that did not happen");
}

#[test]
fn kinematic_protocol() {
    follows(include_str!("data/normal.json"), HysteresisRule::Normal);
}

#[test]
fn peak_oriented_protocol() {
    follows(
        include_str!("data/peak_oriented.json"),
        HysteresisRule::PeakOriented,
    );
}

#[test]
fn degrading_protocol() {
    follows(
        include_str!("data/degrading.json"),
        HysteresisRule::DegradingTrilinear,
    );
}

#[test]
fn opensees_through_random_histories() {
    let stored = document(include_str!("data/opensees.json"));
    for (number, case) in stored["cases"]
        .as_array()
        .expect("cases")
        .iter()
        .enumerate()
    {
        let rule = match case["rule"].as_str() {
            Some("normal") => HysteresisRule::Normal,
            _ => HysteresisRule::PeakOriented,
        };
        let side = |key: &str| {
            let given = numbers(&case[key]);
            Corners {
                cracking: given[0],
                yielding: given[1],
                post_cracking: given[2],
                post_yield: given[3],
            }
        };
        let spring = spring(rule, 100.0, [side("positive"), side("negative")]);
        let mut memory = HysteresisMemory::default();
        for (to, force) in numbers(&case["deformation"])
            .into_iter()
            .zip(numbers(&case["force"]))
        {
            memory = spring.respond(&memory, to).memory;
            assert!(
                (memory.force() - force).abs() < 1e-9 * 200.0,
                "case {number} at {to}: {} for {force}",
                memory.force()
            );
        }
    }
}

/// Pinched springs at every quarter of every leg. Damage acts when force reaches zero, in OpenSees when unloading
/// starts; an uncracked side has no damage, in OpenSees only until it is first loaded. The histories with damage
/// therefore crack at once and pass zero force after every reversal.
#[test]
fn opensees_pinched() {
    let stored = document(include_str!("data/opensees_pinched.json"));
    for case in stored["cases"].as_array().expect("cases") {
        let name = case["name"].as_str().expect("a name");
        let of = |key: &str| case["pinched"][key].as_f64().expect("a number");
        let rule = HysteresisRule::Pinched(Pinching {
            deformation: of("deformation"),
            force: of("force"),
            unloading_exponent: of("exponent"),
            ductility_damage: of("ductility"),
            energy_damage: of("energy"),
        });
        let side = |key: &str| {
            let given = numbers(&case[key]);
            Corners {
                cracking: given[0],
                yielding: given[1],
                post_cracking: given[2],
                post_yield: given[3],
            }
        };
        let spring = spring(rule, 100.0, [side("positive"), side("negative")]);
        let (mut memory, mut from, mut worst) = (HysteresisMemory::default(), 0.0, 0.0_f64);
        let mut forces = numbers(&case["force"]).into_iter();
        for (leg, to) in numbers(&case["deformation"]).into_iter().enumerate() {
            for (quarter, force) in (1..=4).zip(forces.by_ref()) {
                let at = from + (to - from) * f64::from(quarter) / 4.0;
                let response = spring.respond(&memory, at);
                let difference = (response.force - force).abs() / 200.0;
                worst = worst.max(difference);
                assert!(
                    difference < 1e-9,
                    "{name}, leg {leg} to {to}, quarter {quarter}: {} for {force}",
                    response.force
                );
            }
            memory = spring.respond(&memory, to).memory;
            from = to;
        }
        println!("{name}: {worst:e}");
    }
}

/// A column and its failing spring in series are one failing spring: that of the column as a whole, at every quarter of
/// every leg.
#[test]
fn opensees_column_that_fails_in_shear() {
    let stored = document(include_str!("data/opensees_failing.json"));
    for case in stored["cases"].as_array().expect("cases") {
        let name = case["name"].as_str().expect("a name");
        let of = |key: &str| case[key].as_f64().expect("a number");
        let column = 12.0 * of("rigidity") / of("length").powi(3);
        let stiffness = 1.0 / (1.0 / column + 1.0 / of("spring"));
        let falling = FallingBranch {
            slope: of("slope"),
            residual: of("residual"),
        };
        let spring = Hysteresis::failing(stiffness, of("strength"), falling).expect("sound");
        let (mut memory, mut from) = (HysteresisMemory::default(), 0.0);
        let mut forces = numbers(&case["force"]).into_iter();
        for (leg, to) in numbers(&case["deformation"]).into_iter().enumerate() {
            for (quarter, force) in (1..=4).zip(forces.by_ref()) {
                let at = from + (to - from) * f64::from(quarter) / 4.0;
                let response = spring.respond(&memory, at);
                assert!(
                    (response.force - force).abs() < 1e-9 * of("strength"),
                    "{name}, leg {leg} to {to}, quarter {quarter}: {} for {force}",
                    response.force
                );
            }
            memory = spring.respond(&memory, to).memory;
            from = to;
        }
    }
}

/// A force that falls after yield to a residual: every point of a path with growing and small loops, and the work of all of it.
#[test]
fn pinched_loops_with_a_falling_line() {
    let stored = document(include_str!("data/pinched_falling.json"));
    let corners = stored["corners_d_m_F_n"].as_array().expect("a list");
    let [first, second, third] = [0, 1, 2].map(|at| numbers(&corners[at]));
    let initial = first[1] / first[0];
    let slope = |from: &[f64], to: &[f64]| (to[1] - from[1]) / (to[0] - from[0]) / initial;
    let given = Corners {
        cracking: first[1],
        yielding: second[1],
        post_cracking: slope(&first, &second),
        post_yield: 0.0,
    };
    let (fall, residual) = (slope(&second, &third), third[1] / second[1]);
    let backbone = Backbone::falling(initial, given, given, fall, residual).expect("sound");
    let share = |key: &str| stored[key].as_f64().expect("a number");
    let pinching = Pinching {
        deformation: share("pinch_deformation"),
        force: share("pinch_force"),
        ..Pinching::USUAL
    };
    let spring = Hysteresis::new(HysteresisRule::Pinched(pinching), backbone).expect("it fits");
    let (mut memory, mut work, mut area) = (HysteresisMemory::default(), 0.0, 0.0);
    for point in stored["d_F"].as_array().expect("a list") {
        let [deformation, force] = numbers(point)[..] else {
            panic!("a point has two numbers");
        };
        let response = spring.respond(&memory, deformation);
        // The same way in small steps, by trapezia.
        let (from, mut last) = (memory.deformation(), memory.force());
        let part = (deformation - from) / 2000.0;
        for count in 1..=2000 {
            let at = spring.respond(&memory, from + part * f64::from(count));
            area += 0.5 * part * (at.force + last);
            last = at.force;
        }
        // The stored forces have eight digits.
        assert!(
            (response.force - force).abs() < 1e-7 * second[1],
            "{} for {force} at {deformation}",
            response.force
        );
        work += response.work;
        memory = response.memory;
    }
    assert!((work / area - 1.0).abs() < 1e-5, "{work} and {area}");
    // Stored from forty steps between two reversals.
    assert!((work / share("work_j") - 1.0).abs() < 0.01, "{work}");
}

/// The same in compression alone: no force in tension, however far; pressed again, it bears from where it lost its force, on the lines of the
/// spring that bears both.
#[test]
fn pinched_struts_bear_compression_alone() {
    let corners = Corners {
        cracking: 150e3,
        yielding: 260e3,
        post_cracking: 0.12,
        post_yield: 0.0,
    };
    let backbone = Backbone::falling(120e6, corners, corners, -0.05, 0.2).expect("sound");
    let both = Hysteresis::new(HysteresisRule::Pinched(Pinching::USUAL), backbone).expect("fits");
    let compression = both.in_compression().expect("pinched");
    let go = |spring: &Hysteresis, memory: &HysteresisMemory, to: f64| spring.respond(memory, to);
    let at_rest = HysteresisMemory::default();
    // Never pressed: nothing in tension, the initial stiffness in compression, in one step or in two.
    let open = go(&compression, &at_rest, 2e-3);
    assert_eq!([open.force, open.tangent, open.work], [0.0; 3]);
    let pressed = go(&compression, &open.memory, -1e-3);
    assert!((pressed.force + 120e3).abs() < 1e-6, "{}", pressed.force);
    let first = go(&compression, &at_rest, -1e-3);
    assert!((first.force - pressed.force).abs() < 1e-6);
    assert_eq!(go(&compression, &first.memory, 1e-3).force, 0.0);
    // Pressed past yield, and drawn: it opens where the other one passes zero.
    let (mine, other) = (
        go(&compression, &at_rest, -12e-3),
        go(&both, &at_rest, -12e-3),
    );
    assert_eq!(mine.force, other.force);
    let zero = -12e-3 - mine.force / 120e6;
    let closing = |to: f64| {
        let open = go(&compression, &mine.memory, to);
        assert_eq!(open.force, 0.0);
        [zero - 1e-4, -8e-3, -11e-3, -12e-3, -20e-3]
            .map(|at| go(&compression, &open.memory, at).force)
    };
    let (near, far) = (closing(zero + 1e-9), closing(30e-3));
    for (a, b) in near.into_iter().zip(far) {
        assert!((a - b).abs() < 1e-6, "{a} and {b}");
    }
    assert!(near[0] < 0.0 && near[0] > -0.3 * 260e3, "{near:?}");
    assert!((near[3] - mine.force).abs() < 1e-6, "{near:?}");
    // It never gives back more than it took.
    let mut state: u64 = 7;
    let (mut memory, mut work) = (at_rest, 0.0);
    for _ in 0..2000 {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        let to = 40e-3 * ((state >> 33) as f64 / f64::from(1_u32 << 31) - 0.6);
        let response = go(&compression, &memory, to);
        assert!(response.force <= 0.0);
        work += response.work;
        memory = response.memory;
        assert!(work >= -1e-6, "{work}");
    }
}
