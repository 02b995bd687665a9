//! Oscillators whose motion is known exactly: one against a rigid stop, two under a sine.

use jostle::contact::ForceLaw;
use jostle::{GroundMotion, State, Wave};
use serde_json::Value;

use crate::data::{document, entries, list, number, numbers};
use crate::row::Row;
use crate::structures::{free_body, oscillator, pair, run, still, uniform};

/// All rows of this family.
#[must_use]
pub fn rows() -> Vec<Row> {
    let mut rows = against_a_stop();
    rows.extend(under_a_sine());
    rows
}

fn linear(stiffness: f64) -> ForceLaw {
    ForceLaw::Kelvin {
        stiffness,
        damping: 0.0,
        tension: false,
    }
}

/// The stop is a free body of 10³⁰ kg: it moves by less than 10⁻²⁸ m, far below rounding of the rest.
fn against_a_stop() -> Vec<Row> {
    const SOURCE: &str = "literature/B01_free_vibration_elastic_stop";
    // The relative error of a period is (ωh)²/12, here 1.3·10⁻⁷ in contact; rounding adds about 10⁻¹⁵/(ωh)² in
    // free vibration, here 6·10⁻⁸. The closed forms are good to 10⁻⁹.
    const STEP: f64 = 2e-5;
    const TOLERANCE: f64 = 1e-6;
    let case = document(include_str!(
        "../data/literature/B01_free_vibration_elastic_stop.json"
    ));
    let input = |key: &str| number(&case, &format!("/inputs/{key}"));
    let expected = |key: &str| number(&case, &format!("/expected/{key}"));
    let system = pair(
        oscillator("oscillator", input("m"), input("k"), 0.0),
        free_body("stop", 1e30),
        input("gap"),
        |_, _| linear(input("k_contact")),
    );
    let state = State {
        displacement: vec![input("u0"), 0.0],
        velocity: vec![input("v0"), 0.0],
        ..State::at_rest(&system, 0.0)
    };
    // Until shortly after the second contact.
    let outcome = run(
        &system,
        &still(1.2 * expected("period")),
        &uniform(STEP),
        Some(state),
    );
    let (first, second) = (outcome.impacts[0], outcome.impacts[1]);
    let peaks = outcome.peaks.floor(0, 1);
    let values = [
        (
            "first contact [s]",
            expected("t_first_contact"),
            first.start,
        ),
        (
            "impact speed [m/s]",
            expected("v_contact"),
            first.impact_speed,
        ),
        (
            "peak displacement [m]",
            expected("u_max"),
            peaks.displacement_max().value,
        ),
        (
            "peak indentation [m]",
            expected("delta_max"),
            first.peak_indentation,
        ),
        ("peak force [N]", expected("F_max"), first.peak_force),
        (
            "duration [s]",
            expected("contact_duration"),
            first.end - first.start,
        ),
        (
            "least displacement [m]",
            expected("u_min"),
            peaks.displacement_min().value,
        ),
        (
            "from first to second contact [s]",
            expected("period"),
            second.start - first.start,
        ),
        (
            "energy [J]",
            expected("energy"),
            outcome.energy.kinetic + outcome.energy.strain + outcome.energy.contact,
        ),
    ];
    values
        .into_iter()
        .map(|(what, expected, got)| {
            Row::relative(
                SOURCE,
                format!("h = 20 µs, {what}"),
                expected,
                got,
                TOLERANCE,
            )
        })
        .collect()
}

fn under_a_sine() -> Vec<Row> {
    const SOURCE: &str = "literature/B04_two_sdof_harmonic_linear_contact";
    const STEP: f64 = 5e-5;
    let case = document(include_str!(
        "../data/literature/B04_two_sdof_harmonic_linear_contact.json"
    ));
    let input = |key: &str| number(&case, &format!("/inputs/{key}"));
    let building = |name: &str, side: usize| {
        let (mass, period) = (input(&format!("m{side}")), input(&format!("T{side}")));
        let omega = 2.0 * std::f64::consts::PI / period;
        oscillator(
            name,
            mass,
            mass * omega * omega,
            input(&format!("zeta{side}")),
        )
    };
    let system = pair(
        building("left", 1),
        building("right", 2),
        input("gap"),
        |_, _| linear(input("k_contact")),
    );
    let motion = |duration: f64| GroundMotion {
        name: "sine".to_owned(),
        scale: 1.0,
        duration,
        wave: Wave::Sine {
            amplitude: input("A"),
            period: input("Tg"),
        },
        bearing: None,
        grounds: None,
    };
    let outcome = run(&system, &motion(input("t_end")), &uniform(STEP), None);
    let name = |what: &str| format!("h = 0.05 ms, {what}");
    let mut rows = vec![Row::absolute(
        SOURCE,
        name("number of impacts"),
        number(&case, "/expected/n_impacts"),
        outcome.impacts.len() as f64,
        0.0,
    )];
    for (k, (expected, got)) in list(&case, "/expected/impacts")
        .iter()
        .zip(&outcome.impacts)
        .enumerate()
    {
        let impact = |what: &str| name(&format!("impact {}, {what}", k + 1));
        if k < 5 {
            rows.push(Row::relative(
                SOURCE,
                impact("peak force [N]"),
                number(expected, "/F_max"),
                got.peak_force,
                1e-3,
            ));
            rows.push(Row::absolute(
                SOURCE,
                impact("start [s]"),
                number(expected, "/t_start"),
                got.start,
                1e-4,
            ));
            rows.push(Row::relative(
                SOURCE,
                impact("impact speed [m/s]"),
                number(expected, "/v_in"),
                got.impact_speed,
                1e-3,
            ));
        }
    }
    let floors = [outcome.peaks.floor(0, 1), outcome.peaks.floor(1, 1)];
    for (side, floor) in floors.iter().enumerate() {
        for (key, got) in [
            ("max", floor.displacement_max().value),
            ("min", floor.displacement_min().value),
        ] {
            let name_of_peak = format!("u{}_{key}", side + 1);
            let expected = numbers(&case, &format!("/expected/peaks/{name_of_peak}"))[0];
            rows.push(Row::relative(
                SOURCE,
                name(&format!("{name_of_peak} [m]")),
                expected,
                got,
                1e-4,
            ));
        }
    }
    rows.extend(states(SOURCE, &case, &system, motion, STEP));
    rows
}

/// Displacements at given instants, relative to the peaks.
fn states(
    source: &str,
    case: &Value,
    system: &jostle::System,
    motion: impl Fn(f64) -> GroundMotion,
    step: f64,
) -> Vec<Row> {
    entries(case, "/expected/state_u1_u2_v1_v2")
        .map(|(time, expected)| {
            let state = run(
                system,
                &motion(time.parse().expect("a time")),
                &uniform(step),
                None,
            )
            .state;
            let expected = numbers(expected, "");
            Row::worst_of(
                source,
                format!("h = 0.05 ms, u at {time} s [m]"),
                &expected[..2],
                &state.displacement,
                1e-3,
            )
        })
        .collect()
}
