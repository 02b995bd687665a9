//! `[output] capacity`: which members are compared with their capacity.

use jostle_io::Input;
use jostle_testkit::files;

/// A frame of two storeys and two bays with bars; `{}` takes ties.
const FRAME: &str = r#"
[motion]
kind = "sine"
amplitude = "1 m/s2"
period = "0.6 s"
duration = "3 s"
[[building]]
name = "A"
kind = "frame"
storeys = 2
storey_height = ["4 m", "3.2 m"]
spans = ["6 m", "5 m"]
column = { width = "500 mm", depth = "500 mm", concrete = "C30", steel = "HRB400", bars = "12 d20"TIES }
beam = { width = "300 mm", depth = "600 mm", concrete = "C30", steel = "HRB400", bars = "4 d20 top, 4 d20 bottom"TIES }
beam_mass = "3600 kg/m"
GRAVITY
"#;

fn read(ties: bool, gravity: &str, output: &str) -> Result<Input, String> {
    let ties = if ties {
        ", ties = \"d10 @ 150 mm\""
    } else {
        ""
    };
    let text = FRAME.replace("TIES", ties).replace("GRAVITY", gravity);
    let text = format!("{text}[output]\n{output}\n");
    files::read(&text).map_err(|error| error.to_string())
}

fn rules(input: &Input) -> Vec<&'static str> {
    let capacities = &input.model.analysis.members.capacities;
    let first = capacities.first();
    first.map_or_else(Vec::new, |capacity| {
        capacity.rules.iter().map(|rule| rule.rule).collect()
    })
}

/// Of all rules, that of the country of the steel governs; named rules keep their order.
#[test]
fn the_rule_of_the_steel_governs() {
    for (steel, first) in [
        ("HRB400", "gb50010"),
        ("B500C", "en1998-3"),
        ("Grade 60", "asce41"),
        ("400 MPa", "gb50010"),
    ] {
        let text = FRAME.replace("TIES", ", ties = \"d10 @ 150 mm\"");
        let text = text.replace("GRAVITY", "").replace("HRB400", steel);
        for (asked, governing) in [
            ("members = true", first),
            ("capacity = true", first),
            ("capacity = [\"aci318\", \"en1998-3\"]", "aci318"),
        ] {
            let input = files::read(&format!("{text}[output]\n{asked}\n"));
            let input = input.unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(rules(&input)[0], governing, "{steel}, {asked}");
            // ASCE 41 has none for joints: ACI 318 follows.
            if governing == "asce41" {
                assert_eq!(rules(&input)[1], "aci318", "{asked}");
            }
        }
    }
}

#[test]
fn all_rules_where_members_are_asked_for() {
    let input = read(true, "", "members = true").expect("sound");
    assert_eq!(
        rules(&input),
        ["gb50010", "en1998-3", "asce41", "aci318", "sezen-moehle"]
    );
    let capacities = &input.model.analysis.members.capacities;
    // Three columns and two beams in each of two storeys.
    assert_eq!(capacities.len(), 10);
    let names: Vec<&str> = capacities
        .iter()
        .map(|capacity| &capacity.member[..])
        .collect();
    assert!(
        names.contains(&"A.column.3.2") && names.contains(&"A.beam.2.1"),
        "{names:?}"
    );
    // Without weight in the run, that carried at the foot is added: together 3600 kg/m on 11 m and columns of 625 kg/m,
    // less what their feet rest on.
    let ground = capacities
        .iter()
        .filter(|capacity| capacity.member.contains(".column.") && capacity.member.ends_with(".1"));
    let carried: f64 = ground.map(|ground| ground.compression_at_rest).sum();
    let due = 9.80665 * (2.0 * 3600.0 * 11.0 + 3.0 * 625.0 * 7.2);
    assert!((carried / due - 1.0).abs() < 0.05, "{carried} for {due}");
    let beam = capacities
        .iter()
        .find(|capacity| capacity.member == "A.beam.1.1")
        .expect("there");
    assert!(!beam.follows_axial && beam.compression_at_rest == 0.0);
    // Clear lengths exclude beams and columns.
    let of = |name: &str| {
        let member = input.members.reinforced.iter().find(|member| {
            let label = match member.member {
                jostle_section::formula::Member::Column => {
                    format!("column.{}.{}", member.place, member.floor)
                }
                jostle_section::formula::Member::Beam => {
                    format!("beam.{}.{}", member.floor, member.place)
                }
            };
            label == name
        });
        member.expect("there").clear_length
    };
    for (name, due) in [
        ("column.1.1", 3.7),
        ("column.1.2", 2.6),
        ("beam.1.1", 5.5),
        ("beam.2.2", 4.5),
    ] {
        assert!((of(name) - due).abs() < 1e-12, "{name}: {}", of(name));
    }
}

#[test]
fn weight_in_the_run_is_not_added_twice() {
    let input = read(true, "gravity = true", "members = true");
    let input = input.expect("sound");
    let capacities = &input.model.analysis.members.capacities;
    assert!(capacities.iter().all(|own| own.compression_at_rest == 0.0));
}

#[test]
fn nothing_is_prepared_unless_asked_for() {
    for output in ["", "members = false", "members = true\ncapacity = false"] {
        let input = read(true, "", output).expect("sound");
        assert!(
            input.model.analysis.members.capacities.is_empty(),
            "{output}"
        );
    }
    // Without ties there is nothing to compare shear with.
    let input = read(false, "", "members = true").expect("sound");
    assert!(input.model.analysis.members.capacities.is_empty());
}

#[test]
fn named_rules_imply_members_and_the_first_governs() {
    let input = read(true, "", "capacity = [\"en1998-3\", \"gb50010\"]").expect("sound");
    assert!(input.model.analysis.members.envelopes);
    assert_eq!(rules(&input), ["en1998-3", "gb50010"]);
    let input = read(true, "", "capacity = \"asce41\"").expect("sound");
    assert_eq!(rules(&input), ["asce41"]);
    let input = read(true, "", "capacity = true").expect("sound");
    assert_eq!(rules(&input).len(), 5);
}

#[test]
fn mistakes_name_the_remedy() {
    for (ties, output, words) in [
        (
            false,
            "capacity = true",
            ["output.capacity", "ties = \"d10 @ 100 mm\""],
        ),
        (
            true,
            "capacity = \"gb5010\"",
            ["output.capacity", "gb50010"],
        ),
        (true, "capacity = []", ["output.capacity", "names no rule"]),
        (
            true,
            "capacity = 3",
            ["output.capacity", "expected true, false"],
        ),
        (
            true,
            "capacity = [\"gb50010\", \"gb50011\"]",
            ["output.capacity[1]", "sezen-moehle"],
        ),
    ] {
        let error = read(ties, "", output).expect_err(output);
        for word in words {
            assert!(error.contains(word), "{output}: {error}");
        }
    }
}

/// Two storeys of HEB 300 and IPE 400 of S355; `{}` stands for more keys of the building.
const STEEL: &str = r#"
[motion]
kind = "sine"
amplitude = "1 m/s2"
period = "0.6 s"
duration = "3 s"
[[building]]
name = "A"
kind = "frame"
storeys = 2
storey_height = "3.5 m"
spans = ["6 m", "5 m"]
column = { profile = "HEB300", yield_strength = "355 MPa" }
beam = { profile = "IPE400", yield_strength = "355 MPa" }
beam_mass = "3600 kg/m"
"#;

/// HEB 300 of S355 in tables: A = 149.1 cm², W_pl,y = 1869 cm³, d t_w = 33 cm²; plastic strengths times f_y.
#[test]
fn steel_profiles_are_compared_by_aisc() {
    for (asked, rated) in [
        ("members = true", true),
        ("capacity = true", true),
        ("capacity = \"aisc360\"", true),
        ("members = true\ncapacity = false", false),
    ] {
        let input = files::read(&format!("{STEEL}[output]\n{asked}\n"));
        let input = input.unwrap_or_else(|error| panic!("{error}"));
        let capacities = &input.model.analysis.members.capacities;
        assert_eq!(capacities.len(), if rated { 10 } else { 0 }, "{asked}");
        let Some(column) = capacities
            .iter()
            .find(|found| found.member == "A.column.2.1")
        else {
            continue;
        };
        let rule = &column.rules[0];
        assert_eq!(rule.rule, "aisc360");
        let [moment, tension] = [rule.bending[0].at(0.0), -rule.bending[0].points()[0][0]];
        assert!((moment / (355e6 * 1869e-6) - 1.0).abs() < 1e-3, "{moment}");
        assert!(
            (tension / (355e6 * 149.1e-4) - 1.0).abs() < 1e-3,
            "{tension}"
        );
        let shear = rule.shear.as_ref().expect("known").at(0.0, 1.0);
        assert!(
            (shear / (0.6 * 355e6 * 0.3 * 0.011) - 1.0).abs() < 1e-9,
            "{shear}"
        );
        // The middle column carries its floors' share of 3600 kg/m, and half of what its feet rest on does not count.
        assert!(
            column.compression_at_rest > 3e5,
            "{}",
            column.compression_at_rest
        );
        let beam = capacities.iter().find(|found| found.member == "A.beam.1.1");
        assert!(!beam.expect("rated").follows_axial);
    }
}

#[test]
fn yield_strengths_stand_beside_profiles() {
    let said = |text: &str| files::read(text).expect_err("refused").to_string();
    let plain = STEEL.replace(
        "profile = \"HEB300\"",
        "width = \"0.3 m\", depth = \"0.3 m\"",
    );
    let plain = plain.replace(
        "kind = \"frame\"",
        "kind = \"frame\"\nelastic_modulus = \"30 GPa\"",
    );
    let found = said(&plain);
    assert!(
        found.contains("column.yield_strength: is for a profile"),
        "{found}"
    );
    let concrete = format!("{STEEL}[output]\ncapacity = \"gb50010\"\n");
    let found = said(&concrete);
    assert!(found.contains("their capacity is unknown"), "{found}");
    let unasked = files::read(STEEL).expect("sound");
    let text = unasked.unrated().expect("said");
    assert!(text.contains("profiles with a yield strength"), "{text}");
}
