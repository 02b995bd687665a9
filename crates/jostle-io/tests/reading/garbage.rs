//! Whatever a file contains, readers answer with numbers or with an error; they never panic.

use std::path::Path;

use jostle::{FloorPairs, Structure};
use jostle_io::{
    Dimension, Format, Input, RecordOptions, TEMPLATE_NAMES, model_text, parse_quantity,
    parse_record, read_model_text, template,
};
use proptest::prelude::*;

/// A valid text to damage.
fn valid_texts() -> Vec<String> {
    let templates = TEMPLATE_NAMES.iter().filter_map(|name| template(name, "x"));
    let paper = model_text("paper").map(str::to_owned);
    let json = r#"{ "motion": { "kind": "ricker", "amplitude": "0.3 g", "period": 0.5 },
  "building": [ { "kind": "shear", "mass": ["40 t", 4e4], "stiffness": "60 MN/m", "storey_height": 3 },
  { "kind": "shear", "floors": 2, "mass": "40 t", "stiffness": "90 MN/m", "damping": { "alpha": 0.1, "beta": "1 ms" } } ],
  "gap": [ { "between": ["B1", "B2"], "width": 0.01, "floors": [[1, 1], [2, 2]], "restitution": 0.5 } ] }"#;
    templates.chain(paper).chain([json.to_owned()]).collect()
}

const VALID_RECORDS: [&str; 3] = [
    "A\nB\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS=   4, DT=   .0100 SEC\n .1E-01 -.2E-01\n .3E-02 .1\n",
    "# unit = g\n# gravity = 9.81 m/s2\ntime_s,acceleration_g\n0.00,0\n0.01,0.5\n0.02,-0.25\n0.03,0.1\n",
    "time (s);acc (cm/s2)\n0,00;0\n0,01;5,5\n0,02;-2,5\n",
];

/// Flips bits, cuts, and exchanges words of a text.
fn damage(
    text: &str,
    flips: &[(usize, u8)],
    cut: Option<usize>,
    swaps: &[(usize, usize)],
) -> Vec<u8> {
    let mut words: Vec<&str> = text.split_inclusive([' ', '\n', ',', '"']).collect();
    for (a, b) in swaps {
        let count = words.len();
        words.swap(a % count, b % count);
    }
    let mut bytes = words.concat().into_bytes();
    for (at, bit) in flips {
        let at = at % bytes.len();
        bytes[at] ^= 1 << (bit % 8);
    }
    if let Some(cut) = cut {
        bytes.truncate(cut % (bytes.len() + 1));
    }
    bytes
}

prop_compose! {
    fn damages()(
        flips in prop::collection::vec((any::<usize>(), any::<u8>()), 0..4),
        cut in prop::option::weighted(0.2, any::<usize>()),
        swaps in prop::collection::vec((any::<usize>(), any::<usize>()), 0..3),
    ) -> (Vec<(usize, u8)>, Option<usize>, Vec<(usize, usize)>) {
        (flips, cut, swaps)
    }
}

/// Every number of an accepted model is finite.
fn assert_finite(input: &Input) {
    let mut numbers = Vec::new();
    for building in &input.model.buildings {
        numbers.extend(building.floor_heights());
        match &building.structure {
            Structure::Frame(frame) => {
                numbers.extend(&frame.spans);
                numbers.extend(&frame.beam_mass);
                numbers.extend(&frame.floor_mass);
                numbers.extend(frame.joint.rotational_stiffness);
                for section in frame.columns.iter().chain(&frame.beams) {
                    numbers.extend([section.flexural_rigidity, section.line_mass]);
                    numbers.extend(section.axial_rigidity);
                }
            }
            Structure::Shear(shear) => {
                numbers.extend(&shear.mass);
                numbers.extend(&shear.stiffness);
            }
            Structure::Tiers(tiers) => {
                for floor in &tiers.floors {
                    numbers.extend([floor.mass, floor.polar_mass]);
                    numbers.extend(floor.centre);
                    numbers.extend(floor.plan.iter().flatten());
                }
                for storey in &tiers.storeys {
                    numbers.extend(storey.stiffness);
                    numbers.extend(storey.centre);
                }
            }
            Structure::Given(given) => {
                numbers.extend(&given.mass);
                numbers.extend(given.stiffness.iter().map(|entry| &entry.2));
            }
        }
    }
    for gap in &input.model.gaps {
        numbers.extend(&gap.widths);
        numbers.extend([gap.level_tolerance, gap.law.stiffness, gap.law.restitution]);
        if let FloorPairs::Heights(heights) = &gap.floors {
            numbers.extend(heights);
        }
    }
    for link in &input.model.links {
        numbers.extend([link.level_tolerance, link.stiffness, link.damping]);
    }
    numbers.extend(input.model.analysis.step);
    numbers.extend(input.model.analysis.contact_step);
    numbers.push(input.model.analysis.tolerance);
    if let Some(Ok(motion)) = input.motion.as_ref().map(jostle_io::MotionSpec::resolve) {
        numbers.extend([motion.scale, motion.duration, motion.peak()]);
    }
    assert!(
        numbers.iter().all(|number| number.is_finite()),
        "{numbers:?}"
    );
}

/// Reads a model in both syntaxes; an error must be printable and point into the text.
fn exercise_model(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    for format in [Format::Toml, Format::Json] {
        match read_model_text("m", &text, format, Path::new("/nonexistent")) {
            Ok(input) => assert_finite(&input),
            Err(error) => {
                assert!(!error.faults.is_empty(), "an error has faults");
                assert!(error.to_string().contains("in m"), "an error can be shown");
            }
        }
    }
}

fn exercise_record(bytes: &[u8]) {
    for options in [
        RecordOptions::default(),
        RecordOptions {
            unit: Some("gal".into()),
            step: Some(0.01),
            column: Some(2),
            ..RecordOptions::default()
        },
    ] {
        match parse_record(bytes, &options) {
            Ok(record) => {
                assert!(
                    record.step.is_finite() && record.step > 0.0,
                    "step {}",
                    record.step
                );
                assert!(record.acceleration.len() >= 2, "at least two values");
                assert!(
                    record.acceleration.iter().all(|a| a.abs() <= 100.0),
                    "finite and possible"
                );
            }
            Err(error) => assert!(!error.to_string().is_empty(), "an error says something"),
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    #[test]
    fn damaged_models_never_panic(which in any::<prop::sample::Index>(), (flips, cut, swaps) in damages()) {
        let texts = valid_texts();
        exercise_model(&damage(&texts[which.index(texts.len())], &flips, cut, &swaps));
    }

    #[test]
    fn random_text_never_panics(bytes in prop::collection::vec(any::<u8>(), 0..200), text in "\\PC{0,120}") {
        exercise_model(&bytes);
        exercise_model(text.as_bytes());
        exercise_record(&bytes);
        exercise_record(text.as_bytes());
    }

    #[test]
    fn damaged_records_never_panic(which in 0..3usize, (flips, cut, swaps) in damages()) {
        exercise_record(&damage(VALID_RECORDS[which], &flips, cut, &swaps));
    }

    #[test]
    fn lines_of_numbers_never_panic(text in "[-+0-9.,;eEdD# \t\n]{0,80}") {
        exercise_record(text.as_bytes());
        exercise_record(format!("t_s,acc_g\n{text}").as_bytes());
    }

    #[test]
    fn quantities_are_finite_or_refused(text in "[-+]?[0-9]{0,3}[.]?[0-9]{0,3}(e-?[0-9]{1,3})? ?[a-zA-Z%./*^()0-9² -]{0,12}") {
        for dimension in Dimension::ALL {
            match parse_quantity(&text, dimension) {
                Ok(value) => prop_assert!(value.is_finite()),
                Err(error) => prop_assert!(!error.to_string().is_empty()),
            }
        }
    }

    #[test]
    fn values_of_any_kind_are_reported(key in "[a-zA-Z_]{1,12}", value in "(1|-1|1e400|nan|true|\"x\"|\\[\\]|\\{\\}|\\[\\[\\]\\]|1979-05-27|\\[1, \"a\"\\])") {
        for table in ["", "[motion]", "[[building]]", "[building]", "[[gap]]", "[gap]", "[analysis]"] {
            exercise_model(format!("{table}\n{key} = {value}\n").as_bytes());
        }
    }
}

#[test]
fn deep_nesting_is_refused() {
    for (open, close) in [("[", "]"), ("{\"a\":", "}"), ("{a = ", "}")] {
        let text = format!("x = {}1{}", open.repeat(100_000), close.repeat(100_000));
        exercise_model(text.as_bytes());
        exercise_model(&text.as_bytes()[4..]);
    }
    let keys = format!("{} = 1", vec!["a"; 50_000].join("."));
    exercise_model(keys.as_bytes());
}
