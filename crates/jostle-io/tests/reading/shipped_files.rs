//! Every file that comes with the program is valid and means what it says.

use std::path::{Path, PathBuf};

use jostle::{Damping, FloorPairs, GroundMotion, LawKind, Structure, System, Wave};
use jostle_io::{
    Format, Overrides, STANDARD_GRAVITY, Scaling, TEMPLATE_NAMES, builtin_model, builtin_record,
    read_model_file, read_model_text, shown::Units, template, template_in,
};

fn el_centro() -> (f64, Vec<f64>) {
    match builtin_record("el-centro").map(|motion| motion.wave) {
        Some(Wave::Sampled { step, acceleration }) => (step, acceleration),
        other => panic!("the built-in record is sampled, not {other:?}"),
    }
}

/// Integral of a² by the trapezoidal rule from the start to every sample.
fn husid(step: f64, acceleration: &[f64]) -> Vec<f64> {
    let mut sum = vec![0.0];
    for pair in acceleration.windows(2) {
        let last = sum[sum.len() - 1];
        sum.push(last + 0.5 * step * (pair[0] * pair[0] + pair[1] * pair[1]));
    }
    sum
}

#[test]
fn el_centro_is_the_peknold_digitisation() {
    const GRAVITY: f64 = 9.81;
    let (step, acceleration) = el_centro();
    assert_eq!(step, 0.02, "the step is exactly 0.02 s");
    assert_eq!(acceleration.len(), 1560, "1559 values after a zero");
    assert_eq!(acceleration[0], 0.0, "the first value is zero");
    let (at, peak) = acceleration
        .iter()
        .enumerate()
        .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
        .expect("there are values");
    assert!(
        (peak.abs() / GRAVITY - 0.31882).abs() < 1e-12,
        "PGA {peak} m/s2"
    );
    assert_eq!(at, 102, "the peak is at 2.04 s");

    let husid = husid(step, &acceleration);
    let total = husid[husid.len() - 1];
    // The published intensity is that of the values in g, with standard gravity.
    let arias = 0.5 * std::f64::consts::PI * STANDARD_GRAVITY * total / (GRAVITY * GRAVITY);
    assert!((arias - 1.8010).abs() < 5e-5, "Arias intensity {arias} m/s");
    let reaches = |share: f64| {
        let at = husid.partition_point(|sum| *sum < share * total);
        step * ((at - 1) as f64 + (share * total - husid[at - 1]) / (husid[at] - husid[at - 1]))
    };
    let significant = reaches(0.95) - reaches(0.05);
    assert!((significant - 23.84).abs() < 0.03, "D5-95 {significant} s");
}

#[test]
fn paper_example_is_as_documented() {
    let input = builtin_model("paper").unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(input.warnings, Vec::<String>::new());
    let motion = input
        .ground_motion()
        .unwrap_or_else(|error| panic!("{error}"));
    assert!((motion.peak() - 2.2).abs() < 1e-12, "the peak is 220 cm/s2");
    assert!(motion.scale < 0.0, "the record is reversed");
    assert!(
        (motion.duration - 31.18).abs() < 1e-9,
        "{} s",
        motion.duration
    );

    let [j1, j2] = &input.model.buildings[..] else {
        panic!("two buildings");
    };
    let (Structure::Frame(f1), Structure::Frame(f2)) = (&j1.structure, &j2.structure) else {
        panic!("two frames");
    };
    assert_eq!((f1.storey_heights.len(), f2.storey_heights.len()), (5, 10));
    assert_eq!(f1.spans, [2.4, 6.0]);
    assert_eq!(f2.spans, [6.0, 2.4, 6.0]);
    assert_eq!(f1.beam_segments, [4, 8]);
    assert_eq!(f2.beam_segments, [8, 4, 8]);
    let rigidity = 0.5 * 30e9 * 0.5f64.powi(4) / 12.0;
    assert!(
        (f1.columns[4].flexural_rigidity / rigidity - 1.0).abs() < 1e-12,
        "cracked EI"
    );
    assert!(
        (f1.columns[0].line_mass - 625.0).abs() < 1e-9,
        "2500 kg/m3 × 0.25 m2"
    );
    assert_eq!(f1.beam_mass, [5850.0; 5]);
    assert_eq!(j2.damping, Damping::ratio(0.05, [1, 3]));
    let gap = &input.model.gaps[0];
    assert_eq!(
        (gap.between, &gap.floors),
        ([Some(0), Some(1)], &FloorPairs::Common)
    );
    assert!((gap.width() - 0.1).abs() < 1e-15, "100 mm");
    assert_eq!((gap.law.kind, gap.law.stiffness), (LawKind::HertzDamp, 2e9));
}

/// Columns and beams of J1 and J2, less the half segments of columns that rest on the ground.
#[test]
fn paper_example_has_the_documented_masses() {
    let input = builtin_model("paper").unwrap_or_else(|error| panic!("{error}"));
    let masses: Vec<f64> = input
        .model
        .buildings
        .iter()
        .map(|building| {
            let Structure::Frame(frame) = &building.structure else {
                panic!("a frame");
            };
            let lines = (frame.spans.len() + 1) as f64;
            let columns: f64 = frame
                .columns
                .iter()
                .zip(&frame.storey_heights)
                .map(|(section, height)| section.line_mass * height)
                .sum();
            let foot = frame.columns[0].line_mass * frame.storey_heights[0]
                / (2 * frame.column_segments) as f64;
            let width: f64 = frame.spans.iter().sum();
            lines * (columns - foot) + width * frame.beam_mass.iter().sum::<f64>()
        })
        .collect();
    assert!(
        (masses[0] - 274_950.0).abs() < 1e-6,
        "J1 has {} kg",
        masses[0]
    );
    assert!(
        (masses[1] - 956_160.0).abs() < 1e-6,
        "J2 has {} kg",
        masses[1]
    );
}

#[test]
fn templates_are_valid() {
    for name in TEMPLATE_NAMES {
        let text = template(name, "Corner of \"High\" \\ Street\n").expect("the name is listed");
        let input = read_model_text(name, &text, Format::Toml, Path::new(""))
            .unwrap_or_else(|error| panic!("{error}"));
        if jostle_io::model_text(name).is_none() {
            assert_eq!(input.model.title, "Corner of High  Street");
        }
        assert_eq!(input.warnings, Vec::<String>::new(), "{name}");
        input
            .ground_motion()
            .unwrap_or_else(|error| panic!("{error}"));
    }
    assert_eq!(template("castle", "x"), None);
}

/// The same buildings within what rounding to inches, half feet and three digits may change, with the same contacts.
#[test]
fn templates_in_us_units_are_nearly_the_same_models() {
    for name in TEMPLATE_NAMES {
        let Some(text) = template_in(name, "10 m", Units::Us) else {
            assert!(jostle_io::model_text(name).is_some(), "{name}");
            continue;
        };
        let si = template(name, "10 m").expect("the name is listed");
        let [us, si] = [text, si].map(|text| {
            let input = read_model_text(name, &text, Format::Toml, Path::new(""));
            let input = input.unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(input.warnings, Vec::<String>::new(), "{name}");
            let system =
                System::assemble(&input.model).unwrap_or_else(|faults| panic!("{faults:?}"));
            (input, system)
        });
        assert_eq!(us.0.model.title, "10 m");
        assert_eq!((us.0.units, si.0.units), (Some(Units::Us), None), "{name}");
        assert_eq!(us.1.contacts.len(), si.1.contacts.len(), "{name}");
        assert_eq!(us.1.links.len(), si.1.links.len(), "{name}");
        let moduli = [&us, &si].map(|(input, _)| {
            let stated = input.stated.buildings.iter();
            stated.map(|building| building.modulus).collect::<Vec<_>>()
        });
        for (index, (us, si)) in us.1.buildings.iter().zip(&si.1.buildings).enumerate() {
            let (us_mass, due) = (us.equations.total_mass(), si.equations.total_mass());
            assert!(
                (us_mass / due - 1.0).abs() < 0.06,
                "{name}: {us_mass} kg, {due} kg"
            );
            let [period, due] =
                [us, si].map(|system| system.lateral_modes().next().expect("it sways").period());
            // ACI 318 takes concrete softer than GB 50010.
            let softer = match [0, 1].map(|system| moduli[system].get(index).copied().flatten()) {
                [Some(us), Some(si)] => (si / us).sqrt(),
                _ => 1.0,
            };
            assert!(
                (period / (due * softer) - 1.0).abs() < 0.08,
                "{name}: {period} s, {due} s"
            );
        }
        for (us, si) in us.1.contacts.iter().zip(&si.1.contacts) {
            assert!(
                (us.width / si.width - 1.0).abs() < 0.01,
                "{name}: a gap of {} m, {} m",
                us.width,
                si.width
            );
        }
    }
}

/// Units and names of bars that only SI templates have.
#[test]
fn templates_in_us_units_have_no_other_units() {
    for name in TEMPLATE_NAMES {
        let text = template_in(name, "x", Units::Us).unwrap_or_default();
        let words = text.split([' ', '"', ',', ';', ':', ')', '(']);
        let foreign = words.filter(|word| {
            let unit = word.trim_end_matches('.');
            let of_si = [
                "mm", "m", "mm²", "m²", "t", "kN", "MN", "kN/m", "MN/m", "N/m", "MPa", "GPa",
            ];
            of_si.contains(&unit)
                || ["N/m^1.5", "m/s", "cm/s2", "kg/"]
                    .iter()
                    .any(|si| unit.starts_with(si))
                || matches!(unit.as_bytes(), [b'C' | b'd', rest @ ..]
                    if !rest.is_empty() && rest.iter().all(u8::is_ascii_digit))
        });
        // A comment on records without unit lists what it can be.
        let foreign: Vec<&str> = foreign.filter(|word| *word != "cm/s2").collect();
        assert_eq!(foreign, Vec::<&str>::new(), "{name}");
    }
}

#[test]
fn examples_are_valid() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let mut count = 0;
    for entry in std::fs::read_dir(folder)
        .expect("examples are there")
        .flatten()
    {
        let path = entry.path();
        // Studies of models have a reader of their own.
        let is_study = entry.file_name().to_string_lossy().starts_with("study_");
        if !is_study
            && path
                .extension()
                .is_some_and(|extension| extension == "toml")
        {
            let input = read_model_file(&path).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(input.warnings, Vec::<String>::new(), "{}", path.display());
            input
                .ground_motion()
                .unwrap_or_else(|error| panic!("{error}"));
            count += 1;
        }
    }
    assert!(count >= 3, "only {count} examples found");
}

#[test]
fn overrides_change_what_they_name() {
    let mut input = builtin_model("paper").unwrap_or_else(|error| panic!("{error}"));
    let overrides = Overrides {
        pga: Some(0.7),
        gap: Some(0.01),
        record: Some("el-centro".into()),
        angle: None,
    };
    input.apply(&overrides).expect("all three can be changed");
    assert_eq!(input.model.gaps[0].widths, [0.01]);
    let motion: GroundMotion = input
        .ground_motion()
        .unwrap_or_else(|error| panic!("{error}"));
    assert!((motion.peak() - 0.7).abs() < 1e-12);
    assert!(motion.scale < 0.0, "the sign stays reversed");
    assert_eq!(
        input.motion.as_ref().map(|m| m.scaling.clone()),
        Some(Scaling::Pga(0.7))
    );

    let before = input.model.clone();
    let negative = Overrides {
        gap: Some(-0.01),
        ..Overrides::default()
    };
    let error = input
        .apply(&negative)
        .expect_err("a negative gap is refused");
    assert_eq!(
        error.to_string(),
        "the gap must not be negative, found -0.01 m"
    );
    assert_eq!(
        input.model, before,
        "nothing is changed by a refused override"
    );
}
