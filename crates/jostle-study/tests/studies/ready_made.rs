//! Ready-made studies vary around what stands in the model, and keep the rest of it.

use std::path::Path;

use jostle_io::{Format, ModelTree, MotionSource, StudyFile};
use jostle_study::{Study, ready_made, ready_made_names, varied};

/// A frame and a shear building with inputs that no ready-made study brings along.
const OWN: &str = r#"
[motion]
record = "el-centro-1940-ns"
pga = "0.31 g"
duration = "8 s"
[[building]]
name = "Frame"
storeys = 2
storey_height = "3 m"
spans = ["5 m"]
column = { width = "400 mm", depth = "400 mm" }
beam = { width = "300 mm", depth = "500 mm" }
concrete = "C30"
stiffness_factor = { column = 0.7, beam = 0.35 }
beam_mass = "5000 kg/m"
damping = { alpha = 0.3, beta = 0.002 }
[[building]]
name = "Shear"
kind = "shear"
mass = ["60 t", "50 t"]
stiffness = ["90 MN/m", "80 MN/m"]
storey_height = "3 m"
damping = { ratio = 0.031, modes = [1, 2] }
[[gap]]
between = ["Frame", "Shear"]
width = "50 mm"
law = "kelvin"
stiffness = "512 MN/m"
restitution = 0.87
"#;

fn tree(text: &str) -> ModelTree {
    ModelTree::parse("own.toml", text, Format::Toml, Path::new("")).expect("a model")
}

fn made(name: &str, text: &str) -> (Study, Vec<String>) {
    let (file, notes) =
        ready_made(name, Some(tree(text))).unwrap_or_else(|e| panic!("{name}: {e}"));
    let study = Study::new(file).unwrap_or_else(|error| panic!("{name}: {error}"));
    (study, notes)
}

/// The model of a case.
fn model(study: &Study, case: u64) -> jostle_io::Input {
    let choices = study.design.choices(case, &study.file.factors);
    let tree = study.tree(&choices).expect("the paths lead somewhere");
    tree.input().expect("a valid model")
}

#[test]
fn the_middle_of_a_tornado_is_the_model_itself() {
    // As it is, and with everything left out that has a usual value.
    let bare: String = OWN
        .lines()
        .filter(|line| {
            !["damping", "restitution", "stiffness_factor"]
                .iter()
                .any(|key| line.starts_with(key))
        })
        .map(|line| format!("{line}\n"))
        .collect();
    for text in [OWN, &bare] {
        let (study, notes) = made("tornado", text);
        assert!(notes.is_empty(), "{notes:?}");
        let input = tree(text).input().expect("a model");
        let middle = model(&study, 0);
        assert_eq!(middle.model, input.model);
        assert_eq!(middle.motion, input.motion);
        // Every factor changes the model both ways.
        for case in 1..study.design.cases {
            assert_ne!(model(&study, case).model, input.model, "case {case}");
        }
        let names: Vec<&str> = study
            .file
            .factors
            .iter()
            .map(|factor| &factor.name[..])
            .collect();
        for name in [
            "gap",
            "contact stiffness",
            "restitution",
            "stiffness of Frame",
            "stiffness of Shear",
            "mass of Frame",
            "mass of Shear",
            "damping",
        ] {
            assert!(names.contains(&name), "{name} is missing in {names:?}");
        }
    }
}

#[test]
fn every_study_keeps_the_records_and_says_what_it_varies() {
    let two = OWN.replace(
        "\"el-centro-1940-ns\"",
        "[\"nanjing-artificial\", \"el-centro-1940-ns\"]",
    );
    // That of angles needs buildings with a plan, and has tests of its own.
    let names = ready_made_names()
        .into_iter()
        .filter(|name| *name != "angles");
    for name in names {
        for (text, records) in [
            (OWN, &["el-centro-1940-ns"][..]),
            (&two, &["nanjing-artificial", "el-centro-1940-ns"]),
        ] {
            let (study, _) = made(name, text);
            let base_model = tree(text).input().expect("a model").model;
            let (mut seen, mut itself) = (Vec::new(), false);
            for case in 0..study.design.cases.min(700) {
                let input = model(&study, case);
                match input.motion.expect("a motion").source {
                    MotionSource::Record { name, .. } if !seen.contains(&name) => seen.push(name),
                    MotionSource::Record { .. } => {}
                    other => panic!("{name}: {other:?}"),
                }
                itself |= input.model.gaps == base_model.gaps;
            }
            seen.sort();
            let mut records = records.to_vec();
            records.sort_unstable();
            assert_eq!(seen, records, "{name}");
            let drawn = matches!(name, "sensitivity" | "table2");
            assert!(
                itself || drawn,
                "{name}: the gap of the model is one of those"
            );
            for (one, factor) in varied(&study).iter().zip(&study.file.factors) {
                assert!(one.keys.contains(&factor.paths[0]), "{name}: {one:?}");
                assert!(!one.range.is_empty(), "{name}: {one:?}");
            }
        }
    }
    let (study, _) = made("tornado", OWN);
    let said: Vec<String> = varied(&study)
        .iter()
        .map(jostle_study::Varied::text)
        .collect();
    for part in [
        "gap[*].width: × 0.5 … 1.5 (uniform); in the model 50 mm",
        "in the model 0.7, 0.35",
        "in the model 0.3, 0.002",
    ] {
        assert!(
            said.iter().any(|line| line.contains(part)),
            "{part} is missing in {said:#?}"
        );
    }
}

#[test]
fn what_cannot_be_varied_is_said() {
    let elastic = OWN
        .replace("restitution = 0.87", "restitution = 1")
        .replace("\"50 mm\"", "0");
    let (study, notes) = made("tornado", &elastic);
    let names: Vec<&str> = study
        .file
        .factors
        .iter()
        .map(|factor| &factor.name[..])
        .collect();
    assert!(
        !names.contains(&"restitution") && !names.contains(&"gap"),
        "{names:?}"
    );
    let said = notes.join("\n");
    assert!(
        said.contains("restitution is not varied") && said.contains("gap[0].width is 0"),
        "{said}"
    );

    let alone = OWN.split("[[gap]]").next().unwrap_or_default();
    let refused = ready_made("ida", Some(tree(alone))).map(|_| ());
    let said = refused.expect_err("a model without gap").to_string();
    assert!(said.contains("has no gap"), "{said}");

    let closed = OWN.replace("\"50 mm\"", "0");
    let refused = ready_made("gap-sweep", Some(tree(&closed))).map(|_| ());
    let said = refused.expect_err("a gap that stays closed").to_string();
    assert!(
        said.contains("gap[0].width is 0") && said.contains("building[1].at[0]"),
        "{said}"
    );

    // Records as they are share no peak: they are scaled to common ones, and that is said.
    let two = OWN.replace("pga = \"0.31 g\"\n", "").replace(
        "\"el-centro-1940-ns\"",
        "[\"nanjing-artificial\", \"el-centro-1940-ns\"]",
    );
    let (_, notes) = made("ida", &two);
    assert!(notes.join("\n").contains("common peaks"), "{notes:?}");
}

/// Intensities of the study of fragility begin where the narrowest gap stays open and end where the widest closes.
#[test]
fn intensities_of_fragility_have_both_outcomes() {
    let (study, notes) = made("fragility", OWN);
    assert!(notes.is_empty(), "{notes:?}");
    let peak = |case: u64| {
        model(&study, case)
            .ground_motion()
            .expect("a motion")
            .peak()
    };
    let width = |case: u64| model(&study, case).model.gaps[0].width();
    let cases = 0..study.design.cases;
    let peaks = || cases.clone().map(peak);
    let widths = || cases.clone().map(width);
    let [least, most] = [
        peaks().fold(f64::INFINITY, f64::min),
        peaks().fold(0.0, f64::max),
    ];
    let [narrow, wide] = [
        widths().fold(f64::INFINITY, f64::min),
        widths().fold(0.0, f64::max),
    ];
    let input = tree(OWN).input().expect("a model");
    let impacts = |peak: f64, width: f64| {
        let mut input = input.clone();
        input.model.gaps[0].set_width(width);
        if let Some(motion) = &mut input.motion {
            motion.scaling = jostle_io::Scaling::Pga(peak);
        }
        let cache = jostle_run::CaseCache::default();
        let prepared = cache
            .assemble(input)
            .unwrap_or_else(|error| panic!("{error}"));
        let outcome = prepared.step(prepared.settings(false), |_| {
            std::ops::ControlFlow::Continue(())
        });
        outcome.impacts.len()
    };
    assert_eq!(impacts(least, narrow), 0);
    assert!(impacts(most, wide) > 0);
}

/// A path that leads nowhere is one fault, not one for each factor.
#[test]
fn a_wrong_path_is_the_fault_of_its_factor_alone() {
    let text = r#"
[[vary]]
path = "gap[0].width"
values = ["10 mm", "20 mm"]
[[vary]]
path = "building[1].beam_mass"
multiply = true
values = [0.9, 1.1]
[[vary]]
path = "gap[0].stiffness"
multiply = true
values = [0.5, 2]
"#;
    let file = StudyFile::parse(
        "study.toml",
        text,
        Format::Toml,
        Path::new(""),
        Some(tree(OWN)),
    );
    let said = match Study::new(file.expect("a study file")) {
        Ok(_) => panic!("accepted"),
        Err(error) => error.to_string(),
    };
    assert_eq!(
        said.matches("has no beam_mass to multiply").count(),
        1,
        "{said}"
    );
    assert!(
        said.contains("vary[1]") && !said.contains("vary[0]"),
        "{said}"
    );
}
