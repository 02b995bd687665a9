//! Buildings in one plane through model files, against OpenSees on the exported script: yielding frames, bearings, walls, links,
//! soil, ground that differs and vertical shaking.

use jostle::history::Owner;
use jostle::{Column, Outcome, Pounding, Settings, System};
use jostle_io::Input;
use serde_json::Value;

use crate::data::{at, document, list, number};
use crate::fibre_ends;
use crate::files::{case, model, run_model};
use crate::row::Row;

const CASES: [(&str, &str, &str, f64); 20] = [
    // 1.3·10⁻³ when quartered: of second order, so that a fifteenth of it is left.
    case!("inelastic", 1e-4),
    // When halved; its peak-oriented springs overshoot corners, which is of first order.
    case!("leaning", 9e-4),
    // When halved: 1.2·10⁻⁵ of forces, 1.9·10⁻⁵ of displacements.
    case!("isolated", 5e-5),
    // When halved; LimitState overshoots corners of its cycles, which is of first order.
    case!("failing", 9e-4),
    // When halved: 1.1·10⁻³ of the force of a light blow; of second order, as in the five below.
    case!("soil", 4e-4),
    case!("soil_grounds", 1e-4),
    case!("soil_links", 1e-4),
    case!("delayed", 1e-4),
    case!("grounds", 4e-4),
    case!("upwards", 5e-5),
    // Of second order.
    case!("damping_initial", 5e-5),
    // 3.8·10⁻⁴ when halved: the tangent at the start of a step comes late, which is of first order, so that twice that is left.
    case!("damping_tangent", 8e-4),
    case!("fibres", 3e-4),
    case!("fibre_walls", 1e-4),
    case!("arms", 2e-4),
    // When halved: 2.0·10⁻⁴ of displacements and of a force; of second order.
    case!("continuous", 1e-4),
    // Stepped by 1 ms; when halved: 2·10⁻⁴ of a force. Contact with the ground opens and closes at ends of steps.
    case!("uplift", 3e-4),
    case!("uplift_feet", 1e-4),
    // Stepped by 0.1 ms: panels fall at ends of steps, which is of first order.
    case!("falling", 4e-4),
    // Stepped by 0.1 ms.
    case!("pendulums", 1e-4),
];
/// Ours, on peak forces and displacements \[–\].
const TOLERANCE: f64 = 1e-4;
/// On forces of fibres: axial forces of `fibres` moved by 1.6·10⁻³ when halved, and by 5·10⁻⁴ with two fifths of these steps \[–\].
pub(crate) const OF_FIBRES: f64 = 1e-3;

/// All rows of this family.
#[must_use]
pub fn rows() -> Vec<Row> {
    CASES
        .iter()
        .flat_map(|(name, text, answer, error)| case(name, model(text), &document(answer), *error))
        .collect()
}

fn case(case: &str, mut input: Input, expected: &Value, error: f64) -> Vec<Row> {
    let source = format!("opensees/{case}");
    input.model.analysis.tolerance = TOLERANCE;
    let duration = input
        .ground_motion()
        .expect("the record is built in")
        .duration;
    let settings = Settings {
        pounding: Pounding::Included,
        record_interval: None,
        ..Settings::default()
    };
    let (system, outcome) = run_model(&input, None, settings, duration);
    let tolerance = TOLERANCE + error;
    let mut rows = Vec::new();
    for ((building, floors), expected) in system
        .buildings
        .iter()
        .zip(outcome.peaks.buildings())
        .zip(list(expected, "/buildings"))
    {
        for (key, side) in [
            ("displacement_max_m", "right"),
            ("displacement_min_m", "left"),
        ] {
            let wanted: Vec<f64> = list(expected, "/floors")
                .iter()
                .map(|floor| number(floor, &format!("/{key}")))
                .collect();
            let got: Vec<f64> = floors
                .iter()
                .map(|floor| match side {
                    "right" => floor.displacement_max().value,
                    _ => floor.displacement_min().value,
                })
                .collect();
            rows.push(Row::worst_of(
                &source,
                format!("{}, peak displacements to the {side} [m]", building.name),
                &wanted,
                &got,
                tolerance,
            ));
        }
        let upwards = list(expected, "/floors").iter();
        let upwards = upwards.filter_map(|floor| floor.get("vertical_displacement_peak_m"));
        let wanted: Vec<f64> = upwards.filter_map(Value::as_f64).collect();
        if !wanted.is_empty() {
            let got: Vec<f64> = floors
                .iter()
                .map(|floor| floor.vertical_displacement())
                .collect();
            let quantity = format!("{}, peak vertical displacements [m]", building.name);
            rows.push(Row::worst_of(&source, quantity, &wanted, &got, tolerance));
        }
    }
    for (index, expected) in list(expected, "/buildings").iter().enumerate() {
        let own = fibre_ends::rows(&source, (&system, &outcome), index, expected, OF_FIBRES);
        rows.extend(own);
        if expected.get("foundation").is_none() {
            continue;
        }
        let (name, foundation) = (
            &system.buildings[index].name,
            outcome.peaks.owned_by(Owner::Foundation(index)),
        );
        for (what, [max, min], got) in [
            (
                "sway [m]",
                ["sway_max_m", "sway_min_m"],
                foundation.displacement(),
            ),
            (
                "rocking [rad]",
                ["rocking_max_rad", "rocking_min_rad"],
                foundation.turning().displacement(),
            ),
        ] {
            let wanted = [max, min].map(|key| number(expected, &format!("/foundation/{key}")));
            // Without springs sideways it stays where it is.
            if wanted == [0.0; 2] {
                continue;
            }
            let got = [got.greatest.value, got.least.value];
            let quantity = format!("{name}, foundation, {what}");
            rows.push(Row::worst_of(&source, quantity, &wanted, &got, tolerance));
        }
    }
    for (index, expected) in list(expected, "/contacts").iter().enumerate() {
        let impacts = || {
            let all = outcome.impacts.iter();
            all.filter(move |impact| impact.contact == index)
        };
        let floor = match (at(expected, "/floors/0"), at(expected, "/floors/1")) {
            (Value::Null, Value::Null) => "of a wall".to_owned(),
            (Value::Null, other) => format!("{other} against a column"),
            (number, _) => number.to_string(),
        };
        let wanted = number(expected, "/impact_count");
        rows.push(Row::absolute(
            &source,
            format!("floor {floor}, impacts"),
            wanted,
            impacts().count() as f64,
            0.0,
        ));
        if wanted > 0.0 {
            rows.push(Row::relative(
                &source,
                format!("floor {floor}, peak force [N]"),
                number(expected, "/peak_force_n"),
                impacts().fold(0.0, |peak, impact| peak.max(impact.peak_force)),
                tolerance,
            ));
        }
    }
    rows.extend(of_links(&source, (&system, &outcome), expected, tolerance));
    rows
}

/// Peak forces of links.
pub(crate) fn of_links(
    source: &str,
    (system, outcome): (&System, &Outcome),
    expected: &Value,
    tolerance: f64,
) -> Vec<Row> {
    let Some(expected) = expected.get("links").and_then(Value::as_array) else {
        return Vec::new();
    };
    let wanted = expected.iter().map(|link| number(link, "/peak_force_n"));
    let links = (0..system.model_links().len()).map(Column::link_force);
    let got: Vec<f64> = links.map(|force| outcome.peaks.of(force).size()).collect();
    assert_eq!(expected.len(), got.len(), "as many links");
    let forces = wanted.zip(got).enumerate();
    let rows = forces.map(|(number, (wanted, got))| {
        let law = system.links[number].law.name();
        let quantity = format!("{law} link, peak force [N]");
        Row::relative(source, quantity, wanted, got, tolerance)
    });
    rows.collect()
}
