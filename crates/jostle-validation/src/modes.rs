//! Frequencies and masses of frames described in model files.

use jostle::System;
use jostle::eigen::modes;
use jostle_io::{Format, read_model_text};
use serde_json::Value;

use crate::data::{at, document, list, number, numbers};
use crate::frames;
use crate::row::Row;

const SOURCE: &str = "theory/oracle_modal";

/// All rows of this family.
#[must_use]
pub fn rows() -> Vec<Row> {
    let stored = document(include_str!("../data/theory/oracle_modal.json"));
    let mut rows = Vec::new();
    // The frames without hinges can be written as model files.
    for (name, segments) in [("A_portal", 1), ("E_2bay5_noHinge_1seg", 1)] {
        let frame = at(&stored, &format!("/{name}"));
        let system = from_model_file(frame, segments);
        let building = &system.buildings[0];
        rows.push(Row::relative(
            SOURCE,
            format!("{name} from a model file, mass [kg]"),
            number(frame, "/total_mass"),
            building.equations.total_mass(),
            1e-12,
        ));
        let expected = high_precision(frame);
        let modes = modes(building, expected.len()).expect("the frame stands");
        for (mode, expected) in modes.iter().zip(expected) {
            let quantity = format!("{name} from a model file, ω [rad/s]");
            rows.push(Row::relative(
                SOURCE,
                quantity,
                expected,
                mode.circular_frequency,
                1e-12,
            ));
        }
    }
    for name in ["B_2bay5", "C_2bay5_axial", "D_3bay10"] {
        let frame = at(&stored, &format!("/{name}"));
        let building = frames::stored(name);
        rows.push(Row::relative(
            SOURCE,
            format!("{name}, mass [kg]"),
            number(frame, "/total_mass"),
            building.equations.total_mass(),
            1e-12,
        ));
        let (condensed, full) = (numbers(frame, "/omega"), numbers(frame, "/omega_full_KM"));
        let modes = modes(&building, condensed.len()).expect("the frame stands");
        for (k, mode) in modes.iter().enumerate() {
            // Two eigenvalue programs, which themselves agree to ten digits.
            let expected = 0.5 * (condensed[k] + full[k]);
            let quantity = format!("{name}, ω of mode {} [rad/s]", k + 1);
            rows.push(Row::relative(
                SOURCE,
                quantity,
                expected,
                mode.circular_frequency,
                1e-9,
            ));
        }
    }
    rows
}

/// Frequencies computed with multiple precision.
fn high_precision(frame: &Value) -> Vec<f64> {
    let text = |omega: &Value| {
        omega
            .as_str()
            .and_then(|text| text.parse().ok())
            .expect("a frequency")
    };
    list(frame, "/omega_mp").iter().map(text).collect()
}

fn from_model_file(frame: &Value, segments: usize) -> System {
    let value = |key: &str| number(frame, &format!("/{key}"));
    let beam = numbers(frame, "/beam");
    let text = format!(
        r#"
        title = "frame"
        [[building]]
        name = "frame"
        kind = "frame"
        storeys = {storeys}
        storey_height = {height:?}
        spans = {spans:?}
        column = {{ width = {column:?}, depth = {column:?} }}
        beam = {{ width = {width:?}, depth = {depth:?} }}
        elastic_modulus = {modulus:?}
        density = {density:?}
        beam_mass = {beam_mass:?}
        column_segments = {segments}
        beam_segments = {segments}
        axial = "rigid"
        damping = {{ alpha = 0.0, beta = 0.0 }}
        "#,
        storeys = value("m"),
        height = value("h"),
        spans = numbers(frame, "/bays"),
        column = value("bc"),
        width = beam[0],
        depth = beam[1],
        modulus = value("E"),
        density = value("rho"),
        beam_mass = value("rho") * beam[0] * beam[1] + value("floor_load_kg_per_m"),
    );
    let input = read_model_text("frame", &text, Format::Toml, "".as_ref()).expect("a valid model");
    System::assemble(&input.model).expect("a sound model")
}
