//! Scripts for OpenSeesPy, read back as tables. That OpenSees gives the same answers is shown in docs/validation.md.

use crate::script::{export, model, number};
use jostle::System;
use jostle_io::{Input, builtin_model};

/// Rows of a table, cut at commas.
fn table<'a>(text: &'a str, name: &str) -> Vec<Vec<&'a str>> {
    let start = text
        .find(&format!("\n{name} = ["))
        .expect("the table is there");
    text[start + 1..]
        .lines()
        .skip(1)
        .take_while(|line| line.starts_with("    "))
        .filter(|line| !line.trim_start().starts_with('#'))
        .map(|line| {
            let row = line.trim().trim_start_matches('(').trim_end_matches("),");
            row.split(", ").collect()
        })
        .collect()
}

/// Displacements that the supports, the held ones and the ties leave.
fn equations(text: &str) -> usize {
    let nodes = table(text, "NODES").len();
    let fixed: usize = table(text, "SUPPORTS")
        .iter()
        .map(|row| row[1..].iter().filter(|held| **held == "1").count())
        .sum();
    let tied: usize = table(text, "TIES").iter().map(|row| row.len() - 2).sum();
    3 * nodes - fixed - table(text, "HELD").len() - tied
}

#[test]
fn ties_leave_as_many_displacements_as_the_transfer_path() {
    let input = builtin_model("paper").expect("built in");
    let exported = export(&input).expect("it can be exported");
    let system = System::assemble(&input.model).expect("sound");
    assert_eq!(equations(&exported.text), system.len());
    // Mass of both frames, as the validation knows it, less what rests on the ground.
    let mass: f64 = table(&exported.text, "NODES")
        .iter()
        .map(|row| number(row[3]))
        .sum();
    let total_masses: f64 = system
        .buildings
        .iter()
        .map(|building| building.equations.total_mass())
        .sum();
    assert!(
        (mass / total_masses - 1.0).abs() < 1e-12,
        "{mass} against {total_masses}"
    );
}

#[test]
fn no_node_follows_two_nodes_and_none_that_is_followed_follows() {
    let models = [
        builtin_model("paper").expect("built in"),
        model(SPRUNG),
        model(&YIELDING.replace("RULE", "normal")),
    ];
    for input in models {
        let text = export(&input).expect("it can be exported").text;
        let ties = table(&text, "TIES");
        let followers: Vec<&str> = ties.iter().map(|row| row[1]).collect();
        for (index, row) in ties.iter().enumerate() {
            assert!(
                !followers.contains(&row[0]),
                "{row:?} is followed and follows"
            );
            assert!(
                !followers[..index].contains(&row[1]),
                "{row:?} follows twice"
            );
        }
    }
}

/// Columns that keep their length on springs that give way: vertical ties cannot be combined with those of the floors.
const SPRUNG: &str = r#"
title = "sprung"
motion = { kind = "sine", amplitude = 1.0, period = 0.5, duration = 2.0 }
[[building]]
name = "frame"
kind = "frame"
storeys = 2
storey_height = 3.0
spans = [4.0]
column = { width = 0.4, depth = 0.4 }
beam = { width = 0.3, depth = 0.5 }
elastic_modulus = 3e10
beam_mass = 3000
base = { vertical_stiffness = 5e8, rotational_stiffness = 1e8 }
"#;

#[test]
fn what_ties_cannot_hold_is_left_to_stiffness() {
    let text = export(&model(SPRUNG)).expect("it can be exported").text;
    let system = System::assemble(&model(SPRUNG).model).expect("sound");
    // Horizontal ties only: the rest of the difference are the vertical displacements of both column lines.
    let vertical = table(&text, "TIES")
        .iter()
        .filter(|row| row[2..].contains(&"2"))
        .count();
    assert_eq!(vertical, 0, "{:?}", table(&text, "TIES"));
    assert!(equations(&text) > system.len());
}

const YIELDING: &str = r#"
title = "yielding"
motion = { record = "el-centro-1940-ns" }
[[building]]
name = "frame"
kind = "frame"
storeys = 1
storey_height = 3.0
spans = [4.0]
column = { width = 0.4, depth = 0.4 }
beam = { width = 0.3, depth = 0.5 }
elastic_modulus = 3e10
beam_mass = 30000
column_segments = 1
beam_segments = 1
hinges = { rule = "RULE", initial = 100, column = { cracking = 60e3, yield = 150e3, post_cracking = 0.3, post_yield = 0.02 } }
"#;

#[test]
fn springs_in_parallel_add_up_to_the_backbone() {
    let input = model(&YIELDING.replace("RULE", "normal"));
    let text = export(&input).expect("it can be exported").text;
    let system = System::assemble(&input.model).expect("sound");
    let spring = &system.buildings[0].equations.springs[0];
    let materials = table(&text, "MATERIALS");
    let parallel = materials
        .iter()
        .find(|row| row[0] == "\"Parallel\"")
        .expect("springs in parallel");
    let far = spring.hysteresis.backbone();
    for share in [0.5, 1.0, 1.7, 3.0] {
        let deformation = share
            * far
                .side(jostle::hysteresis::Side::Positive)
                .yielding
                .deformation;
        let force: f64 = parallel[2..]
            .iter()
            .map(|tag| {
                let row = materials
                    .iter()
                    .find(|row| row[1] == *tag)
                    .expect("its parts are listed");
                let stretch = match row[0] {
                    "\"ElasticPP\"" => deformation.min(number(row[3])),
                    _ => deformation,
                };
                number(row[2]) * stretch
            })
            .sum();
        let expected = far.force_at(deformation);
        assert!(
            (force / expected - 1.0).abs() < 1e-12,
            "{force} against {expected} at {share} of yield"
        );
    }
}

#[test]
fn what_opensees_does_not_have_is_refused_by_field() {
    let path_of = |input: &Input| {
        let faults = export(input).expect_err("it cannot be exported");
        faults[0].path.clone()
    };
    assert_eq!(
        path_of(&model(&YIELDING.replace("RULE", "takeda"))),
        "building[0].hinges.rule"
    );
    let mut input = builtin_model("paper").expect("built in");
    input.model.gaps[0].law.kind = jostle::LawKind::Restitution;
    assert_eq!(path_of(&input), "gap[0].law");
    let mut input = builtin_model("paper").expect("built in");
    input.model.analysis.integrator = jostle::Integrator::hht(0.1);
    assert_eq!(path_of(&input), "analysis.integrator");
}

/// The first material of a contact of the paper's frames under a law, and the remarks of its script.
fn material_of(kind: jostle::LawKind, stiffness: f64) -> (Vec<String>, String) {
    let mut input = builtin_model("paper").expect("built in");
    let law = &mut input.model.gaps[0].law;
    (law.kind, law.stiffness) = (kind, stiffness);
    let text = export(&input).expect("it can be exported").text;
    let materials = table(&text, "MATERIALS");
    let contact = &table(&text, "CONTACTS")[0];
    let material = materials.iter().find(|row| row[1] == contact[3]);
    let words = material.expect("its material").iter();
    (words.map(|word| word.to_string()).collect(), text.clone())
}

#[test]
fn constants_of_contacts_are_exported() {
    use jostle::contact::{BilinearConstants, Crush, Dashpot, DashpotLaw};
    let (crushing, _) = material_of(
        jostle::LawKind::Crushing(Crush {
            force: 6e5,
            hardening: 0.05,
            hertzian: false,
        }),
        2e8,
    );
    assert_eq!(crushing[0], "\"ElasticPPGap\"");
    assert_eq!(crushing[6], "\"damage\"");
    let numbers: Vec<f64> = crushing[2..6].iter().map(|value| number(value)).collect();
    assert_eq!(numbers, [2e8, -6e5, -0.1, 0.05]);
    let constants = BilinearConstants {
        second_stiffness: 1.2e8,
        yield_indentation: 1.5e-3,
    };
    let (bilinear, text) = material_of(jostle::LawKind::BilinearGiven(constants), 4e8);
    assert_eq!(bilinear[0], "\"ImpactMaterial\"");
    let numbers: Vec<f64> = bilinear[2..].iter().map(|value| number(value)).collect();
    assert_eq!(numbers, [4e8, 1.2e8, -1.5e-3, -0.1]);
    assert!(text.contains("first order of the step"));
    let dashpot = Dashpot {
        law: DashpotLaw::Kelvin,
        damping: 1.1e6,
    };
    let (kelvin, text) = material_of(jostle::LawKind::Dashpot(dashpot), 2e8);
    assert_eq!(kelvin[0], "\"ViscoelasticGap\"");
    let numbers: Vec<f64> = kelvin[2..].iter().map(|value| number(value)).collect();
    assert_eq!(numbers, [2e8, 1.1e6, -0.1]);
    assert!(!text.contains("first order of the step"));
}

#[test]
fn the_damping_of_hertzdamp_is_that_of_the_law() {
    let input = builtin_model("paper").expect("built in");
    let text = export(&input).expect("it can be exported").text;
    let materials = table(&text, "MATERIALS");
    let contact = &table(&text, "CONTACTS")[0];
    let law = materials
        .iter()
        .find(|row| row[1] == contact[3])
        .expect("its material");
    // F = k δ^1.5 (1 + ¾(1 − e²) δ̇/v₀), e = 0.65, 100 mm.
    assert_eq!(law[0], "\"Hertzdamp\"");
    let numbers: Vec<f64> = law[2..].iter().map(|value| number(value)).collect();
    let expected = [2e9, 0.75 * (1.0 - 0.65 * 0.65), -0.1, 1.5];
    for (got, expected) in numbers.iter().zip(expected) {
        assert!((got - expected).abs() <= 1e-12 * expected.abs(), "{law:?}");
    }
}

#[test]
fn names_cannot_break_the_script() {
    let mut input = model(SPRUNG);
    input.model.title = "a \"quoted\\ title\nimport os".to_owned();
    input.model.buildings[0].name = "x\"\ny".to_owned();
    let text = export(&input).expect("it can be exported").text;
    assert!(
        text.contains(r#"TITLE = "a \"quoted\\ title import os""#),
        "{}",
        &text[..400]
    );
    let imports = text.lines().filter(|line| *line == "import os");
    assert_eq!(imports.count(), 1, "the driver's own");
    assert!(text.contains(r#""name": "x\" y""#));
}

/// Energy of damage refers to loading both sides to yield in jostle, and to the whole backbone in OpenSees.
#[test]
fn pinched_storeys_become_hysteretic() {
    let text = r#"
motion = { kind = "ricker", amplitude = "0.1 g", period = "0.5 s" }
[[building]]
kind = "shear"
mass = ["40 t"]
stiffness = ["60 MN/m"]
hinges = { rule = "pinched", pinching = { deformation = 0.7, force = 0.3 }, unloading_exponent = 0.4, damage = { ductility = 0.01, energy = 0.02 }, cracking = "5 mm", yield = "20 mm", post_cracking = 0.3, post_yield = 0.02 }
"#;
    let exported = export(&model(text)).expect("it can be exported");
    let line = exported
        .text
        .lines()
        .find(|line| line.contains("\"Hysteretic\""))
        .expect("the material");
    let row = line.trim().trim_start_matches('(').trim_end_matches("),");
    let numbers: Vec<f64> = row
        .split(", ")
        .filter_map(|word| {
            word.trim_matches(|c| c == '[' || c == ']' || c == '(' || c == ')')
                .parse()
                .ok()
        })
        .collect();
    let last = &numbers[numbers.len() - 5..];
    let [far, force] = [200.0, 570e3 + 0.02 * 60e6 * (200.0 - 0.02)];
    let to_yield = 0.5 * (300e3 * 0.005 + 870e3 * 0.015);
    let whole = to_yield + 0.5 * (570e3 + force) * (far - 0.02);
    assert_eq!([last[0], last[1], last[2], last[4]], [0.7, 0.3, 0.01, 0.4]);
    assert!(
        (last[3] / (0.02 * whole / to_yield) - 1.0).abs() < 1e-12,
        "{last:?}"
    );
}

const BEARINGS: &str = include_str!("../../../jostle-validation/data/opensees/isolated.toml");

#[test]
fn bearings_walls_and_links_are_exported() {
    let exported = export(&model(BEARINGS)).expect("it can be exported");
    let links = table(&exported.text, "LINKS");
    assert_eq!(links.len(), 7);
    let materials = table(&exported.text, "MATERIALS");
    let of = |name: &str| {
        let quoted = format!("\"{name}\"");
        materials.iter().filter(|row| row[0] == quoted).count()
    };
    // Viscous with a spring and maxwell; the stop, the wall's contact, cable and stopper.
    assert_eq!((of("ViscousDamper"), of("ElasticPPGap")), (2, 4));
    assert_eq!(table(&exported.text, "CONTACTS").len(), 1);
    // No spring is empty.
    for row in table(&exported.text, "SPRINGS") {
        assert!(row.len() >= 5 && row[3].starts_with("(("), "{row:?}");
    }
}

#[test]
fn friction_that_rises_with_speed_is_refused() {
    let text = BEARINGS.replace(
        "friction = 0.05",
        "friction = { slow = 0.03, fast = 0.05, rate = 50 }",
    );
    let faults = export(&model(&text)).expect_err("OpenSees cannot do it here");
    assert_eq!(faults.len(), 1, "{faults:?}");
    assert_eq!(faults[0].path, "building[1].isolation.friction");
}

/// Without this refusal the script would have no damping at all.
#[test]
fn the_same_ratio_in_all_modes_is_refused() {
    let text = r#"
motion = { record = "el-centro-1940-ns" }
[[building]]
kind = "shear"
mass = ["40 t"]
stiffness = ["60 MN/m"]
damping = { ratio = 0.05, modes = "all" }
"#;
    let faults = export(&model(text)).expect_err("OpenSees cannot do it");
    assert_eq!(faults.len(), 1, "{faults:?}");
    assert_eq!(faults[0].path, "building[0].damping.modes");
    let text = text.replace("modes = \"all\"", "modes = [1]");
    assert!(export(&model(&text)).is_ok());
}

const FAILING: &str = include_str!("../../../jostle-validation/data/opensees/failing.toml");

/// 260 kN, residual 0.2: the falling branch of the spring ends where it has lost 208 kN.
#[test]
fn columns_that_fail_in_shear_are_exported() {
    let input = model(FAILING);
    let exported = export(&input).expect("it can be exported");
    let materials = table(&exported.text, "MATERIALS");
    let failing = materials.iter().filter(|row| row[0] == "\"LimitState\"");
    let failing: Vec<_> = failing.collect();
    // One for each of three storeys, whose heights differ in one.
    assert_eq!(failing.len(), 2);
    for row in &failing {
        let numbers: Vec<f64> = row[2..].iter().map(|value| number(value)).collect();
        let [v, d, v2, d2, v3, d3, .., slope, residual] = numbers[..] else {
            panic!("too few numbers: {numbers:?}")
        };
        assert_eq!([v, v3, residual], [260e3, 52e3, 52e3]);
        assert!((v2 - 156e3).abs() < 1e-6);
        for (force, deformation) in [(v2, d2), (v3, d3)] {
            let due = v - slope * (deformation - d);
            assert!((force - due).abs() < 1e-6 * v, "{force} instead of {due}");
        }
        for index in 0..6 {
            assert_eq!(numbers[index], -numbers[index + 6]);
        }
    }
    // Springs at the feet of nine columns, and at the heads of three that are struck.
    let tags: Vec<&str> = failing.iter().map(|row| row[1]).collect();
    let springs = table(&exported.text, "SPRINGS");
    let springs = springs.iter().filter(|row| {
        let material = row[4].trim_end_matches([')', ',']);
        row[3] == "((1" && tags.contains(&material)
    });
    assert_eq!(springs.count(), 12);
}

#[test]
fn strength_that_falls_with_ductility_is_refused() {
    let text = include_str!("../../../../examples/columns_that_fail_in_shear.toml");
    let refused = |text: &str| -> Vec<String> {
        let faults = export(&model(text)).expect_err("OpenSees cannot do it");
        faults.into_iter().map(|fault| fault.path).collect()
    };
    let field = "building[0].shear_failure".to_owned();
    assert_eq!(refused(text), [&field, "building[0].hinges.rule"]);
    let normal = text.replace("takeda", "normal");
    assert_eq!(refused(&normal), [field]);
    // A rule without ductility, and columns that cannot yield.
    assert!(export(&model(&normal.replace("sezen-moehle", "aci318"))).is_ok());
    let elastic = text.replace("hinges =", "# hinges =");
    assert!(export(&model(&elastic)).is_ok());
}

/// Stiffness, dashpots and Rayleigh damping of given matrices: no spring without a material, and dashpots without Rayleigh damping, of
/// which OpenSees would leave them out of its matrix.
#[test]
fn springs_of_given_matrices_have_materials_and_their_damping() {
    let text = "[motion]\nrecord = \"el-centro-1940-ns\"\n[[building]]\nname = \"A\"\nkind = \"given\"\nports = { 1 = { dof = 1, height = \"3 m\" }, 2 = { dof = 2, height = \"6 m\" } }\nmatrices = { mass = [1e5, 8e4], stiffness = [[1.5e8, -5e7], [-5e7, 5e7]]";
    let damped = format!("{text}, damping = [[3e5, -1e5], [-1e5, 2e5]] }}\n");
    let by_ratio = format!("{text} }}\ndamping = {{ ratio = 0.03 }}\n");
    for (text, initial, undamped) in [(&damped, 2, 3), (&by_ratio, 2, 0)] {
        let exported = export(&model(text)).expect("it can be exported");
        let springs = table(&exported.text, "SPRINGS");
        assert_eq!(springs.len(), initial + undamped, "{springs:?}");
        assert!(springs.iter().all(|row| row[3] == "((1"), "{springs:?}");
        let damped = springs.iter().filter(|row| row[5] == "\"initial\"");
        assert_eq!(damped.count(), initial, "{springs:?}");
    }
}
