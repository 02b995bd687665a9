//! A five-storey beside a ten-storey shear building under El Centro.

use jostle::eigen::{Mode, modes};
use jostle::{Outcome, Pounding, Settings, System};
use jostle_io::Input;
use serde_json::Value;

use crate::data::{document, entries, list, number, numbers};
use crate::files::{model, run_model};
use crate::row::Row;

const SOURCE: &str = "literature/E01_shear5_shear10_elcentro220_hertzdamp_muthukumar";
const STEP: f64 = 2e-5;

/// All rows of this family.
#[must_use]
pub fn rows() -> Vec<Row> {
    let case = document(include_str!(
        "../data/literature/E01_shear5_shear10_elcentro220_hertzdamp_muthukumar.json"
    ));
    let input = buildings(&case);
    let duration = number(&case, "/inputs/t_end");
    let run = |pounding, step| {
        let settings = Settings {
            pounding,
            record_interval: None,
            ..Settings::default()
        };
        run_model(&input, Some(step), settings, duration)
    };
    let (system, outcome) = run(Pounding::Included, STEP);
    let (_, apart) = run(Pounding::Excluded, 1e-4);
    let mut rows = derived(&case, &system);
    rows.extend(peaks(&case, "/expected/peaks", "h = 20 µs", &outcome));
    rows.extend(impacts(&case, &outcome));
    rows.extend(peaks(
        &case,
        "/expected/no_pounding_peaks",
        "without contact",
        &apart,
    ));
    rows
}

fn buildings(case: &Value) -> Input {
    let input = |key: &str| number(case, &format!("/inputs/{key}"));
    let building = |side: usize, name: &str| {
        let storeys = input(&format!("n{side}"));
        format!(
            r#"
            [[building]]
            name = "{name}"
            kind = "shear"
            storeys = {storeys}
            mass = {:?}
            stiffness = {:?}
            storey_height = 3.0
            damping = {{ ratio = 0.05, modes = [1, 2] }}
            "#,
            input(&format!("m{side}")),
            input(&format!("k{side}")),
        )
    };
    model(&format!(
        r#"
        title = "shear buildings"
        motion = {{ record = "el-centro-1940-ns", pga = 2.2 }}
        {}
        {}
        [[gap]]
        between = ["low", "high"]
        width = {:?}
        law = "hertz-damp"
        stiffness = {:?}
        restitution = 0.65
        "#,
        building(1, "low"),
        building(2, "high"),
        input("gap"),
        input("contact/k"),
    ))
}

fn derived(case: &Value, system: &System) -> Vec<Row> {
    let mut rows = Vec::new();
    for (building, side) in system.buildings.iter().zip([1, 2]) {
        let expected = numbers(case, &format!("/derived/periods{side}"));
        let modes = modes(building, expected.len()).expect("the building stands");
        let got: Vec<f64> = modes.iter().map(Mode::period).collect();
        rows.push(Row::worst_of(
            SOURCE,
            format!("{}, periods [s]", building.name),
            &expected,
            &got,
            1e-12,
        ));
        let rayleigh = numbers(case, &format!("/derived/rayleigh{side}"));
        let equations = &building.equations;
        rows.push(Row::relative(
            SOURCE,
            format!("{}, α [1/s]", building.name),
            rayleigh[0],
            equations.alpha,
            1e-12,
        ));
        rows.push(Row::relative(
            SOURCE,
            format!("{}, β [s]", building.name),
            rayleigh[1],
            equations.beta,
            1e-12,
        ));
    }
    rows
}

fn peaks(case: &Value, path: &str, run: &str, outcome: &Outcome) -> Vec<Row> {
    let floors: Vec<_> = outcome.peaks.buildings().flatten().collect();
    entries(case, path)
        .map(|(peak, expected)| {
            let (dof, side) = peak[1..].split_once('_').expect("a name such as u3_max");
            let floor = floors[dof.parse::<usize>().expect("a floor") - 1];
            let got = if side == "max" {
                floor.displacement_max()
            } else {
                floor.displacement_min()
            };
            Row::relative(
                SOURCE,
                format!("{run}, {peak} [m]"),
                numbers(expected, "")[0],
                got.value,
                1e-3,
            )
        })
        .collect()
}

fn impacts(case: &Value, outcome: &Outcome) -> Vec<Row> {
    let mut rows = Vec::new();
    for (floor, contact) in list(case, "/expected/contacts").iter().enumerate() {
        let name = |what: &str| format!("h = 20 µs, floor {}, {what}", floor + 1);
        let mut got: Vec<_> = outcome
            .impacts
            .iter()
            .filter(|impact| impact.contact == floor)
            .collect();
        got.sort_by(|a, b| a.start.total_cmp(&b.start));
        let (expected, found) = (number(contact, "/n_impacts"), got.len() as f64);
        rows.push(Row::absolute(
            SOURCE,
            name("number of impacts (grazing ones may differ)"),
            expected,
            found,
            1.0,
        ));
        for (k, (expected, got)) in list(contact, "/impacts")
            .iter()
            .zip(got)
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
        }
    }
    rows
}
