//! Steel whose loops bend smoothly, against another program.

use jostle::hysteresis::{Hysteresis, HysteresisMemory, MenegottoPinto};
use serde_json::Value;

/// Yield strength and modulus \[Pa\], ratio of hardening.
const STEEL: [f64; 3] = [400e6, 200e9, 0.015];

/// Bars over strains of [-2 %, 3 %] follow `Steel02` within 10⁻³ of the yield strength.
#[test]
fn bars_follow_steel02() {
    let data: Value = serde_json::from_str(include_str!("data/steel02.json")).expect("JSON");
    let numbers = |of: &Value| -> Vec<f64> {
        let list = of.as_array().expect("a list");
        list.iter()
            .map(|number| number.as_f64().expect("a number"))
            .collect()
    };
    let turns = numbers(&data["turns"]);
    let [steps, kept] = ["steps", "kept"].map(|key| data[key].as_u64().expect("a count"));
    let [strength, modulus, hardening] = STEEL;
    for bar in data["bars"].as_array().expect("bars") {
        let number = |key: &str| bar[key].as_f64().expect("a number");
        let law = MenegottoPinto {
            sharpness: number("R0"),
            loss: number("cR1"),
            half: number("cR2"),
        };
        let menegotto_pinto =
            Hysteresis::menegotto_pinto(modulus, strength, hardening, law).expect("sound");
        let stresses = numbers(&bar["stress_pa"]);
        let mut stresses = stresses.iter();
        let (mut memory, mut from, mut worst) = (HysteresisMemory::default(), 0.0, 0.0_f64);
        for to in &turns {
            for step in 1..=steps {
                let share = step as f64 / steps as f64;
                memory = menegotto_pinto
                    .respond(&memory, from + (to - from) * share)
                    .memory;
                if step % kept == 0 {
                    let due = stresses.next().expect("a stress");
                    worst = worst.max((memory.force() - due).abs());
                }
            }
            from = *to;
        }
        assert_eq!(stresses.next(), None);
        assert!(
            worst < 1e-3 * strength,
            "{law:?}: {:e} of the strength",
            worst / strength
        );
    }
}

/// Numbers out of range are refused in words.
#[test]
fn numbers_out_of_range_are_refused() {
    let usual = MenegottoPinto::USUAL;
    for (law, hardening, part) in [
        (
            MenegottoPinto {
                sharpness: 0.5,
                ..usual
            },
            0.01,
            "R0",
        ),
        (MenegottoPinto { loss: 1.0, ..usual }, 0.01, "cR1"),
        (MenegottoPinto { half: 0.0, ..usual }, 0.01, "cR2"),
        (usual, 1.0, "slope after yield"),
    ] {
        let faults = Hysteresis::menegotto_pinto(2e11, 4e8, hardening, law).expect_err("refused");
        assert!(
            faults.iter().any(|own| own.problem.contains(part)),
            "{faults:?}"
        );
    }
}
