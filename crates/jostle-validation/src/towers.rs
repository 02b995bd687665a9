//! A light, soft tower beside a heavy, stiff block under El Centro, with several contact laws.

use jostle::{Outcome, Pounding, Settings};
use jostle_io::Input;
use serde_json::Value;

use crate::Extent;
use crate::data::{at, document, entries, list, number, numbers};
use crate::files::{model, run_model};
use crate::row::Row;

const SOURCE: &str = "literature/D01_two_sdof_elcentro_T1.2_T0.3";
/// The stored laws and their names in model files. The stored Kelvin law is cut at F = 0.
const LAWS: [(&str, &str); 7] = [
    ("linear", "linear"),
    ("kelvin", "kelvin-no-tension"),
    ("modified_kelvin", "modified-kelvin"),
    ("hertz", "hertz"),
    ("hertzdamp_muthukumar", "hertz-damp"),
    ("hertzdamp_ye", "ye"),
    ("jankowski", "jankowski"),
];

/// All rows of this family.
#[must_use]
pub fn rows(extent: Extent) -> Vec<Row> {
    let case = document(include_str!(
        "../data/literature/D01_two_sdof_elcentro_T1.2_T0.3.json"
    ));
    let step: f64 = match extent {
        Extent::Full => 1e-5,
        Extent::Reduced => 5e-5,
    };
    let mut rows = without_contact(&case);
    for (key, law) in LAWS {
        // The force of Jankowski's law starts as t^¼: fixed steps are of order 1¼ only.
        let step = if law == "jankowski" {
            step.min(2e-5)
        } else {
            step
        };
        rows.extend(with_contact(&case, key, law, step));
    }
    rows
}

fn towers(case: &Value, law: &str) -> Input {
    let input = |key: &str| number(case, &format!("/inputs/{key}"));
    let stiffness = |side: usize| {
        let omega = 2.0 * std::f64::consts::PI / input(&format!("T{side}"));
        input(&format!("m{side}")) * omega * omega
    };
    let contact = if ["hertz", "hertz-damp", "ye", "jankowski"].contains(&law) {
        input("k_hertz")
    } else {
        input("k_linear")
    };
    let restitution = match law {
        "linear" | "hertz" => String::new(),
        // The stored one damps in the approach only.
        "modified-kelvin" => format!(
            "restitution = {}\n        variant = \"mahmoud-jankowski\"",
            input("e")
        ),
        _ => format!("restitution = {}", input("e")),
    };
    model(&format!(
        r#"
        title = "two towers"
        motion = {{ record = "el-centro-1940-ns" }}
        [[building]]
        name = "tower"
        kind = "shear"
        mass = [{m1:?}]
        stiffness = [{k1:?}]
        storey_height = 4.0
        damping = {{ ratio = {zeta}, modes = [1] }}
        [[building]]
        name = "block"
        kind = "shear"
        mass = [{m2:?}]
        stiffness = [{k2:?}]
        storey_height = 4.0
        damping = {{ ratio = {zeta}, modes = [1] }}
        [[gap]]
        between = ["tower", "block"]
        width = {gap:?}
        law = "{law}"
        stiffness = {contact:?}
        {restitution}
        "#,
        m1 = input("m1"),
        m2 = input("m2"),
        k1 = stiffness(1),
        k2 = stiffness(2),
        zeta = input("zeta"),
        gap = input("gap"),
    ))
}

fn settings(pounding: Pounding) -> Settings {
    Settings {
        pounding,
        record_interval: None,
        ..Settings::default()
    }
}

fn peaks(case: &Value, key: &str, name: &dyn Fn(&str) -> String, outcome: &Outcome) -> Vec<Row> {
    let floors = [outcome.peaks.floor(0, 1), outcome.peaks.floor(1, 1)];
    entries(case, &format!("/expected/{key}/peaks"))
        .map(|(peak, expected)| {
            let floor = floors[usize::from(peak.starts_with("u2"))];
            let got = if peak.ends_with("max") {
                floor.displacement_max()
            } else {
                floor.displacement_min()
            };
            Row::relative(
                SOURCE,
                name(&format!("{peak} [m]")),
                numbers(expected, "")[0],
                got.value,
                1e-3,
            )
        })
        .collect()
}

fn without_contact(case: &Value) -> Vec<Row> {
    let (_, outcome) = run_model(
        &towers(case, "linear"),
        Some(1e-3),
        settings(Pounding::Excluded),
        number(case, "/inputs/t_end"),
    );
    peaks(
        case,
        "no_pounding",
        &|what| format!("without contact, {what}"),
        &outcome,
    )
}

fn with_contact(case: &Value, key: &str, law: &str, step: f64) -> Vec<Row> {
    let input = towers(case, law);
    let (_, outcome) = run_model(
        &input,
        Some(step),
        settings(Pounding::Included),
        number(case, "/inputs/t_end"),
    );
    let name = |what: &str| format!("{law}, h = {} µs, {what}", step * 1e6);
    let mut rows = peaks(case, key, &name, &outcome);
    let stored = at(case, &format!("/expected/{key}/contacts/0"));
    for (k, (expected, got)) in list(stored, "/impacts")
        .iter()
        .zip(&outcome.impacts)
        .take(3)
        .enumerate()
    {
        let impact = |what: &str| name(&format!("impact {}, {what}", k + 1));
        rows.push(Row::relative(
            SOURCE,
            impact("peak force [N]"),
            number(expected, "/F_max"),
            got.peak_force,
            1e-2,
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
            impact("impulse [N·s]"),
            number(expected, "/impulse"),
            got.impulse,
            1e-2,
        ));
    }
    rows.push(Row::absolute(
        SOURCE,
        name("number of impacts (grazing ones may differ)"),
        number(stored, "/n_impacts"),
        outcome.impacts.len() as f64,
        1.0,
    ));
    for (time, expected) in entries(case, &format!("/expected/{key}/state")).take(2) {
        let duration = time.parse().expect("a time");
        let (_, outcome) = run_model(&input, Some(step), settings(Pounding::Included), duration);
        let expected = numbers(expected, "");
        rows.push(Row::worst_of(
            SOURCE,
            name(&format!("u at {time} s [m]")),
            &expected[..2],
            &outcome.state.displacement,
            1e-3,
        ));
    }
    rows
}
