//! Hinges and reinforcement in model files.

use jostle::hysteresis::{HysteresisRule, Pinching, Side};
use jostle::pushover::{PushSettings, pushover};
use jostle::{FibreLimit, FrameHinges, Hinges};
use jostle_io::Input;
use jostle_testkit::files;

fn read(text: &str) -> Result<Input, String> {
    files::read(text).map_err(|e| e.to_string())
}

fn frame(column: &str, beam: &str, hinges: &str) -> String {
    format!(
        r#"
[[building]]
storeys = 2
storey_height = "3 m"
spans = ["6 m", "4 m"]
column = {{ width = "500 mm", depth = "500 mm"{column} }}
beam = {{ width = "300 mm", depth = "600 mm"{beam} }}
concrete = "C30"
beam_mass = "3600 kg/m"
{hinges}
"#
    )
}

fn shear(hinges: &str) -> String {
    format!(
        "[[building]]\nkind = \"shear\"\nmass = [\"40 t\", \"40 t\"]\nstiffness = [\"60 MN/m\", \"50 MN/m\"]\n{hinges}\n"
    )
}

fn hinges_of(text: &str) -> FrameHinges {
    let input = read(text).unwrap_or_else(|error| panic!("{error}"));
    match &input.model.buildings[0].hinges {
        Some(Hinges::Frame(hinges)) => hinges.clone(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn moments_become_springs_of_every_member() {
    let hinges = hinges_of(&frame(
        "",
        "",
        r#"hinges = { rule = "peak-oriented", initial = 100,
        column = [{ cracking = "120 kN.m", yield = "400 kN.m", post_cracking = 0.3, post_yield = 0.02 }, { cracking = "100 kN.m", yield = "300 kN.m", post_cracking = 0.3, post_yield = 0.02 }],
        beam = { cracking = "80 kN.m", post_cracking = 0.3, post_yield = 0.02, positive = { yield = "260 kN.m" }, negative = { yield = "320 kN.m", cracking = "90 kN.m" } } }"#,
    ));
    assert_eq!((hinges.columns.len(), hinges.columns[0].len()), (2, 3));
    assert_eq!((hinges.beams.len(), hinges.beams[0].len()), (2, 2));
    let column = hinges.columns[1][2];
    assert_eq!(column.rule(), HysteresisRule::PeakOriented);
    let rigidity = 30e9 * 0.5_f64.powi(4) / 12.0;
    assert!((column.backbone().initial() / (100.0 * rigidity / 3.0) - 1.0).abs() < 1e-12);
    assert_eq!(column.backbone().side(Side::Negative).yielding.force, 300e3);
    let [long, short] = [hinges.beams[0][0], hinges.beams[0][1]];
    let ratio = short.backbone().initial() / long.backbone().initial();
    assert!((ratio - 1.5).abs() < 1e-12, "stiffness goes with 1/L");
    assert_eq!(long.backbone().side(Side::Positive).yielding.force, 260e3);
    assert_eq!(long.backbone().side(Side::Positive).cracking.force, 80e3);
    assert_eq!(long.backbone().side(Side::Negative).cracking.force, 90e3);
}

#[test]
fn rigid_hinges_take_ratios_of_the_member_end() {
    let hinges = hinges_of(&frame(
        "",
        "",
        r#"hinges = { rule = "takeda", gamma = 0.5, initial = "rigid",
        column = { cracking = "120 kN.m", yield = "400 kN.m", post_cracking = 0.25, post_yield = 0.02 } }"#,
    ));
    assert!(hinges.beams.is_empty());
    let column = hinges.columns[0][0];
    assert_eq!(column.rule(), HysteresisRule::Takeda { exponent: 0.5 });
    let end = 6.0 * 30e9 * 0.5_f64.powi(4) / 12.0 / 3.0;
    let slope = column.backbone().side(Side::Positive).post_cracking;
    // In series with the member end: a quarter of its stiffness.
    assert!((1.0 / (1.0 / slope + 1.0 / end) / end - 0.25).abs() < 1e-9);
}

#[test]
fn storeys_crack_and_yield() {
    let text = shear(
        r#"hinges = { rule = "d-tri", cracking = "5 mm", yield = ["20 mm", "25 mm"], post_cracking = 0.3, post_yield = 0.05 }"#,
    );
    let input = read(&text).unwrap_or_else(|error| panic!("{error}"));
    let Some(Hinges::Storeys(springs)) = &input.model.buildings[0].hinges else {
        panic!("no springs");
    };
    assert_eq!(springs[1].backbone().initial(), 50e6);
    assert_eq!(
        springs[1]
            .backbone()
            .side(Side::Positive)
            .yielding
            .deformation,
        0.025
    );
    let force = 60e6 * 0.005 + 18e6 * 0.015;
    assert!((springs[0].backbone().side(Side::Positive).yielding.force - force).abs() < 1e-6);
    let bilinear = shear(r#"hinges = { rule = "bilinear", yield = "20 mm", post_yield = 0.05 }"#);
    assert!(read(&bilinear).is_ok());
}

const COLUMN_BARS: &str = r#", steel = "HRB400", bars = "12 d20", cover = "30 mm""#;
const BEAM_BARS: &str =
    r#", steel = "HRB400", bars = { top = "4 d25", bottom = "3 d20", sides = "2 d12" }"#;

#[test]
fn sections_give_the_moments() {
    for method in ["formula", "fibre"] {
        let hinges = format!(
            r#"hinges = {{ rule = "peak-oriented", from = "section", method = "{method}" }}"#
        );
        let text = frame(COLUMN_BARS, BEAM_BARS, &hinges);
        let input = read(&text).unwrap_or_else(|error| panic!("{error}"));
        let hinges = hinges_of(&text);
        // The middle column of the ground floor carries most and yields last.
        let yields = |line: usize, storey: usize| {
            hinges.columns[storey][line]
                .backbone()
                .side(Side::Positive)
                .yielding
                .force
        };
        assert!(
            yields(1, 0) > yields(0, 0) && yields(0, 0) > yields(0, 1),
            "{method}"
        );
        // More bars at the top: negative moments are carried better.
        let beam = hinges.beams[0][0].backbone();
        let [positive, negative] = Side::BOTH.map(|side| beam.side(side).yielding.force);
        assert!(
            negative > 1.5 * positive,
            "{method}: {positive} and {negative}"
        );
        assert_eq!(input.members.reinforced.len(), 2 * 3 + 2 * 2);
        // Equilibrium: the feet of the columns carry the whole weight.
        let weight: f64 = input
            .members
            .reinforced
            .iter()
            .filter(|member| {
                member.floor == 1 && member.member == jostle_section::formula::Member::Column
            })
            .map(|member| member.compression)
            .sum();
        let mass = 2.0 * (10.0 * 3600.0 + 3.0 * 3.0 * 625.0);
        // The lowest half segments stand on the ground.
        let lowest = 3.0 * 625.0 * 3.0 / 8.0;
        assert!(
            (weight / (9.80665 * (mass - lowest)) - 1.0).abs() < 1e-9,
            "{weight}"
        );
    }
}

#[test]
fn kinematic_rules_take_symmetric_sections_and_refuse_others() {
    for rule in ["normal", "d-tri", "bilinear", "takeda"] {
        for method in ["formula", "fibre"] {
            let hinges =
                format!(r#"hinges = {{ rule = "{rule}", from = "section", method = "{method}" }}"#);
            let even = r#", steel = "HRB400", bars = "4 d25 top, 4 d25 bottom""#;
            let text = frame(COLUMN_BARS, even, &hinges);
            read(&text).unwrap_or_else(|error| panic!("{rule}, {method}: {error}"));
        }
    }
    let hinges = r#"hinges = { rule = "normal", from = "section" }"#;
    let found = faults(&frame(COLUMN_BARS, BEAM_BARS, hinges));
    assert!(
        found[0].contains("beam 1 of storey 1") && found[0].contains("peak-oriented"),
        "{found:?}"
    );
}

#[test]
fn a_load_in_numbers_replaces_gravity() {
    let bars = format!(
        r#"{COLUMN_BARS}, axial_load = "800 kN", ties = "d10 @ 100 mm", strength = "mean""#
    );
    let input = read(&frame(&bars, "", "")).unwrap_or_else(|error| panic!("{error}"));
    assert!(
        input
            .members
            .reinforced
            .iter()
            .all(|member| member.compression == 800e3)
    );
    let section = &input.members.reinforced[0].section;
    assert!(section.ties.is_some());
    assert!((section.concrete.strength / (20.1e6 / (1.0 - 1.645 * 0.172)) - 1.0).abs() < 1e-12);
}

/// The first lines of all faults.
fn faults(text: &str) -> Vec<String> {
    let error = read(text).expect_err(text);
    let lines = error.lines().filter(|line| line.starts_with("model.toml:"));
    lines.map(str::to_owned).collect()
}

#[test]
fn faults_name_the_number_and_what_to_do() {
    let moments =
        r#"cracking = "120 kN.m", yield = "400 kN.m", post_cracking = 0.3, post_yield = 0.02"#;
    for (text, place, word) in [
        (
            frame("", "", "hinges = { column = { } }"),
            "building[0].hinges.rule",
            "is missing",
        ),
        (
            frame("", "", r#"hinges = { rule = "normal" }"#),
            "building[0].hinges",
            "has no moments",
        ),
        (
            frame(
                "",
                "",
                &format!(
                    r#"hinges = {{ rule = "normal", gamma = 0.4, column = {{ {moments} }} }}"#
                ),
            ),
            "building[0].hinges.gamma",
            "no meaning with the rule normal",
        ),
        (
            frame(
                "",
                "",
                &format!(
                    r#"hinges = {{ rule = "takeda", gamma = 1.4, column = {{ {moments} }} }}"#
                ),
            ),
            "building[0].hinges.gamma",
            "between 0 and 1",
        ),
        (
            shear(
                r#"hinges = { rule = "pinched", cracking = "5 mm", yield = "20 mm", post_cracking = 0.3, post_yield = 0.02 }"#,
            ),
            "building[0].hinges.pinching",
            "is missing",
        ),
        (
            shear(
                r#"hinges = { rule = "pinched", pinching = { deformation = 0.8 }, cracking = "5 mm", yield = "20 mm", post_cracking = 0.3, post_yield = 0.02 }"#,
            ),
            "building[0].hinges.pinching.force",
            "is missing",
        ),
        (
            shear(
                r#"hinges = { rule = "pinched", pinching = { deformation = 1.8, force = 0.2 }, cracking = "5 mm", yield = "20 mm", post_cracking = 0.3, post_yield = 0.02 }"#,
            ),
            "building[0].hinges.pinching.deformation",
            "between 0 and 1",
        ),
        (
            shear(
                r#"hinges = { rule = "pinched", pinching = { deformation = 0.8, force = 0.2 }, damage = { energy = -1 }, cracking = "5 mm", yield = "20 mm", post_cracking = 0.3, post_yield = 0.02 }"#,
            ),
            "building[0].hinges.damage.energy",
            "between 0 and 10",
        ),
        (
            shear(
                r#"hinges = { rule = "normal", damage = { energy = 0.1 }, cracking = "5 mm", yield = "20 mm", post_cracking = 0.3, post_yield = 0.02 }"#,
            ),
            "building[0].hinges.damage",
            "no meaning with the rule normal",
        ),
        (
            frame(
                "",
                "",
                &format!(r#"hinges = {{ rule = "bilinear", column = {{ {moments} }} }}"#),
            ),
            "building[0].hinges.column.cracking",
            "does not apply to a bilinear curve",
        ),
        (
            frame(
                "",
                "",
                r#"hinges = { rule = "normal", column = { cracking = "500 kN.m", yield = "400 kN.m", post_cracking = 0.3, post_yield = 0.02 } }"#,
            ),
            "building[0].hinges.column.yield",
            "must not be less than cracking",
        ),
        (
            frame(
                "",
                "",
                r#"hinges = { rule = "normal", beam = [{ cracking = "50 kN.m" }] }"#,
            ),
            "building[0].hinges.beam",
            "1 entry for 2 storeys",
        ),
        (
            frame(
                "",
                "",
                r#"hinges = { rule = "normal", beam = { cracking = "50 kN.m", yield = "400 kN.m", post_cracking = 0.3, post_yield = 0.02, negative = { post_cracking = 0.4 } } }"#,
            ),
            "building[0].hinges.beam.negative.post_cracking",
            "equal on both sides",
        ),
        (
            frame(
                "",
                BEAM_BARS,
                r#"hinges = { rule = "takeda", from = "section" }"#,
            ),
            "building[0].hinges",
            "no column has bars",
        ),
        (
            frame(
                COLUMN_BARS,
                BEAM_BARS,
                &format!(
                    r#"hinges = {{ rule = "takeda", from = "section", beam = {{ {moments} }} }}"#
                ),
            ),
            "building[0].hinges.beam",
            "cannot be combined with",
        ),
        (
            frame(r#", bars = "12 d20""#, "", ""),
            "building[0].column.steel",
            "is missing",
        ),
        (
            frame(r#", steel = "HRB40", bars = "12 d20""#, "", ""),
            "building[0].column.steel",
            "\"HRB40\" is not known",
        ),
        (
            frame(r#", steel = "HRB400", bars = "11 d20""#, "", ""),
            "building[0].column.bars",
            "even number",
        ),
        (
            frame(
                r#", steel = "HRB400", bars = "12 d20", cover = "300 mm""#,
                "",
                "",
            ),
            "building[0].column.cover",
            "no room for the bars",
        ),
        (
            frame(
                r#", steel = "HRB400", bars = "12 d20", axial_load = "8 t""#,
                "",
                "",
            ),
            "building[0].column.axial_load",
            "expected a force",
        ),
        (
            frame("", r#", steel = "HRB400", bars = { top = "4 d25" }"#, ""),
            "building[0].beam.bars.bottom",
            "is missing",
        ),
        (
            shear(
                r#"hinges = { rule = "normal", cracking = "5 mm", yield = ["20 mm", "2 mm"], post_cracking = 0.3, post_yield = 0.05 }"#,
            ),
            "building[0].hinges.yield[1]",
            "must not be less than cracking",
        ),
        (
            shear(
                r#"hinges = { rule = "normal", cracking = "5 mm", yield = "20 mm", post_cracking = 0.3, post_yield = 0.5 }"#,
            ),
            "building[0].hinges.post_yield",
            "must not exceed post_cracking",
        ),
        (
            shear(
                r#"hinges = { rule = "normal", cracking = "5 mm", yield = ["20 mm"], post_cracking = 0.3, post_yield = 0.05 }"#,
            ),
            "building[0].hinges.yield",
            "1 entry for 2 storeys",
        ),
        (
            shear(
                r#"hinges = { rule = "normal", column = {}, cracking = "5 mm", yield = "20 mm", post_cracking = 0.3, post_yield = 0.05 }"#,
            ),
            "building[0].hinges.column",
            "unknown key",
        ),
    ] {
        let found = faults(&text);
        assert!(
            found
                .iter()
                .any(|line| line.contains(&format!(": {place}: ")) && line.contains(word)),
            "{place}: {word}\nfound {found:#?}\nin {text}"
        );
        let also = usize::from(text.contains("bilinear"));
        assert_eq!(found.len(), 1 + also, "{found:#?}");
    }
}

#[test]
fn overload_and_soft_members_are_said_with_their_place() {
    let bars = format!(r#"{COLUMN_BARS}, axial_load = "9000 kN""#);
    let text = frame(
        &bars,
        BEAM_BARS,
        r#"hinges = { rule = "normal", from = "section", method = "fibre" }"#,
    );
    let found = faults(&text);
    assert!(
        found[0].contains("column 1 of storey 1") && found[0].contains("9000 kN"),
        "{found:?}"
    );
}

/// The factor that the message names is enough for the member, and a tenth less is not.
#[test]
fn members_that_are_too_soft_are_told_the_least_factor() {
    let soft = |column: f64| {
        frame(
            COLUMN_BARS,
            BEAM_BARS,
            &format!(
                "stiffness_factor = {{ column = {column}, beam = 0.35 }}\nhinges = {{ rule = \"peak-oriented\", from = \"section\" }}"
            ),
        )
    };
    let found = faults(&soft(0.1));
    let after = found[0].split("raise stiffness_factor to ").nth(1);
    let times = after.and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    let least = 0.1 * times.unwrap_or_else(|| panic!("{found:?}"));
    assert!(least > 0.1 && least < 0.9, "{found:?}");
    let of_columns = |factor: f64| match read(&soft(factor)) {
        Ok(_) => false,
        Err(error) => error.to_string().contains("column 1 of storey 1"),
    };
    assert!(!of_columns(least), "{least}");
    assert!(of_columns(0.9 * least), "{least}");
}

#[test]
fn storeys_may_pinch() {
    let hinges = r#"hinges = { rule = "pinched", pinching = { deformation = 0.7, force = 0.3 }, unloading_exponent = 0.4, damage = { ductility = 0.01 }, cracking = "5 mm", yield = "20 mm", post_cracking = 0.3, post_yield = 0.02 }"#;
    let input = read(&shear(hinges)).unwrap_or_else(|error| panic!("{error}"));
    let Some(Hinges::Storeys(storeys)) = &input.model.buildings[0].hinges else {
        panic!("no storeys");
    };
    let expected = HysteresisRule::Pinched(Pinching {
        deformation: 0.7,
        force: 0.3,
        unloading_exponent: 0.4,
        ductility_damage: 0.01,
        energy_damage: 0.0,
    });
    assert_eq!(storeys[0].rule(), expected);
}

#[test]
fn a_base_may_yield() {
    let base = r#"base = { rotational_stiffness = "200 MN.m/rad", horizontal_stiffness = "90 MN/m",
        rotational_hinge = { rule = "bilinear", yield = "400 kN.m", post_yield = 0.02 },
        horizontal_hinge = { rule = "peak-oriented", cracking = "100 kN", yield = "300 kN", post_cracking = 0.3, post_yield = 0.01 } }"#;
    // Inline tables end with their line.
    let base = base.replace('\n', " ");
    let input = read(&frame("", "", &base)).unwrap_or_else(|error| panic!("{error}"));
    let base = input.model.buildings[0].base;
    let rocking = base.rotational_hinge.expect("read");
    assert_eq!(rocking.rule(), HysteresisRule::Bilinear);
    assert_eq!(rocking.backbone().initial(), 200e6);
    let sliding = base.horizontal_hinge.expect("read");
    let side = sliding.backbone().side(Side::Negative);
    assert_eq!([side.cracking.force, side.yielding.force], [100e3, 300e3]);
}

#[test]
fn a_base_yields_only_where_it_gives_way() {
    for (base, said) in [
        (
            r#"base = { horizontal_hinge = { rule = "bilinear", yield = "300 kN", post_yield = 0 } }"#,
            "add horizontal_stiffness",
        ),
        (
            r#"base = { horizontal_stiffness = "1 MN/m", horizontal_hinge = { rule = "normal", yield = "300 kN", post_yield = 0 } }"#,
            "add cracking",
        ),
        (
            r#"base = { horizontal_stiffness = "1 MN/m", horizontal_hinge = { rule = "bilinear", yield = "300 kN.m", post_yield = 0 } }"#,
            "expected a force",
        ),
        (
            r#"base = { horizontal_stiffness = "1 MN/m", horizontal_hinge = { rule = "bilinear", yield = "-3 kN", post_yield = 0 } }"#,
            "base.horizontal_hinge.yield",
        ),
    ] {
        let error = read(&shear(base)).expect_err(base);
        assert!(error.contains(said), "{error}");
    }
}

/// A frame of two storeys whose columns have bars.
fn of_fibres(building: &str, hinges: &str) -> String {
    let column = r#", steel = "HRB400", bars = "12 d20", cover = "35 mm""#;
    let building = format!("{building}\nhinges = {{ rule = \"fibre\"{hinges} }}");
    frame(column, "", &building)
}

const FLEXIBLE: &str = "axial = \"flexible\"\ngravity = true";

#[test]
fn columns_with_bars_become_fibres() {
    let hinges = hinges_of(&of_fibres(FLEXIBLE, ", length = \"0.4 m\""));
    assert_eq!(hinges.fibres.len(), 6);
    let hinge_fibre = &hinges.fibres[&[1, 2]];
    assert_eq!(
        (hinge_fibre.length, hinge_fibre.at_ends),
        (0.4, [true, true])
    );
    let sums = hinge_fibre
        .fibres
        .iter()
        .fold([0.0; 3], |[area, first, steel], fibre| {
            let backbone = fibre.spring.backbone();
            match fibre.spring.rule() {
                // Characteristic strength of C30 by GB 50010.
                HysteresisRule::Concrete(_) => {
                    let force = backbone.side(Side::Negative).yielding.force;
                    [area + force / 20.1e6, first + force * fibre.at[0], steel]
                }
                _ => [area, first, steel + backbone.yield_force() / 400e6],
            }
        });
    assert!(
        (sums[0] / 0.25 - 1.0).abs() < 1e-12,
        "{} m2 of concrete",
        sums[0]
    );
    assert!(sums[1].abs() < 1e-6, "the axis is in the middle");
    let bars = 12.0 * std::f64::consts::PI * 0.01_f64.powi(2);
    assert!(
        (sums[2] / bars - 1.0).abs() < 1e-12,
        "{} m2 of steel",
        sums[2]
    );
    // 0.08 · 1.5 m + 0.022 · 20 mm · 400.
    let by_rule = hinges_of(&of_fibres(
        FLEXIBLE,
        ", length = \"paulay-priestley\", ends = \"base\"",
    ));
    assert_eq!(by_rule.fibres.len(), 3);
    let fibre = &by_rule.fibres[&[0, 0]];
    assert!((fibre.length - 0.296).abs() < 1e-12, "{} m", fibre.length);
    assert_eq!(fibre.at_ends, [true, false]);
}

#[test]
fn ties_confine_the_core_of_fibres() {
    let column = r#", steel = "HRB400", bars = "12 d20", cover = "35 mm", ties = "4 d10 @ 100 mm""#;
    let text = frame(
        column,
        "",
        &format!("{FLEXIBLE}\nhinges = {{ rule = \"fibre\", length = 0.4, fibres = 20 }}"),
    );
    let hinges = hinges_of(&text);
    let strains =
        hinges.fibres[&[0, 0]]
            .fibres
            .iter()
            .filter_map(|fibre| match fibre.spring.rule() {
                HysteresisRule::Concrete(_) => Some(
                    fibre
                        .spring
                        .backbone()
                        .side(Side::Negative)
                        .yielding
                        .deformation
                        / 0.4,
                ),
                _ => None,
            });
    let strains: Vec<f64> = strains.collect();
    // Layers inside the ties have a core between two covers.
    assert_eq!(strains.len(), 20 + 18);
    let (least, greatest) = strains
        .iter()
        .fold((f64::MAX, 0.0_f64), |(a, b), s| (a.min(*s), b.max(*s)));
    assert!(greatest > 1.5 * least, "{least} and {greatest}");
}

#[test]
fn fibres_that_cannot_be_say_why() {
    let says = |text: &str, expected: &[&str]| {
        let error = read(text).expect_err("a fault");
        for part in expected {
            assert!(error.contains(part), "{part} is not in {error}");
        }
    };
    let length = ", length = \"0.4 m\"";
    says(
        &of_fibres("axial = \"rigid\"\ngravity = true", length),
        &[
            "needs columns that change their length",
            "axial = \"flexible\"",
        ],
    );
    says(&of_fibres(FLEXIBLE, ""), &["length", "paulay-priestley"]);
    says(
        &of_fibres("axial = \"flexible\"", length),
        &["needs the weight of the building", "gravity = true"],
    );
    says(
        &of_fibres(FLEXIBLE, ", length = 0.4, fibres = 1"),
        &["between 2 and 400"],
    );
    says(
        &of_fibres(FLEXIBLE, ", length = 0.4, residual = 1.5"),
        &["at least 0 and less than 1"],
    );
    says(
        &of_fibres(
            FLEXIBLE,
            ", length = 0.4, peak_strain = 0.004, ultimate_strain = 0.003",
        ),
        &["ultimate strain must be greater"],
    );
    says(
        &of_fibres(FLEXIBLE, ", length = 0.4, column = { yield = 1 }"),
        &["cannot be combined with rule = \"fibre\""],
    );
    let bare = frame(
        "",
        "",
        &format!("{FLEXIBLE}\nhinges = {{ rule = \"fibre\", length = 0.4 }}"),
    );
    says(&bare, &["no column has bars"]);
    let other = frame(
        "",
        "",
        "hinges = { rule = \"takeda\", length = 0.4, column = { cracking = 1e5, yield = 2e5, post_cracking = 0.3, post_yield = 0.02 } }",
    );
    says(&other, &["has no meaning without fibres"]);
    let in_plan = r#"
[[building]]
name = "A"
kind = "frame"
storeys = 2
plan = ["12 m", "10 m"]
mass = "150 t"
[[building.frame]]
name = "1"
at = ["0 m", "0 m"]
spans = ["6 m", "6 m"]
column = { width = "500 mm", depth = "500 mm" }
beam = { width = "300 mm", depth = "600 mm" }
concrete = "C30"
axial = "flexible"
hinges = { rule = "fibre", length = 0.4 }
"#;
    says(in_plan, &["no column has bars"]);
    let with_bars = in_plan.replace(
        "depth = \"500 mm\" }",
        "depth = \"500 mm\", steel = \"HRB400\", bars = \"12 d20\" }",
    );
    let held =
        "[[building.element]]\nat = [6, 5]\nstiffness = { x = 1e3, y = 60e6 }\n[[building.frame]]";
    let with_bars = with_bars
        .replace("[[building.frame]]", held)
        .replace("at = [\"0 m\", \"0 m\"]", "at = [[0, 0], [0, 10]]");
    says(&with_bars, &["needs the weight of the building"]);
}

/// A frame of two storeys whose columns yield on a surface.
fn on_surface(column: &str, building: &str, hinges: &str) -> String {
    let building = format!("{building}\nhinges = {{ rule = \"surface\"{hinges} }}");
    frame(column, "", &building)
}

const STATED: &str = ", length = 0.4, surface = { axial = [\"-6 MN\", \"-2 MN\", \"1.2 MN\"], moment = [0.0, \"500 kN.m\", 0.0] }";

#[test]
fn columns_yield_on_surfaces() {
    // EA and EI over the length, by hand.
    let hinges = hinges_of(&on_surface("", FLEXIBLE, STATED));
    assert_eq!(hinges.fibres.len(), 6);
    let column = &hinges.fibres[&[1, 2]];
    let corners = column.corners().remove(0);
    let expected = [[-6e6, 0.0], [-2e6, 5e5], [1.2e6, 0.0]];
    for (corner, expected) in corners.iter().zip(expected) {
        assert!((corner[0] - expected[0]).abs() < 1.0 && (corner[1] - expected[1]).abs() < 1e-3);
    }
    let initial = column.fibres[0].spring.backbone().initial();
    assert!((2.0 * initial / (30e9 * 0.25 / 0.4) - 1.0).abs() < 1e-12);
    assert!((column.fibres[0].at[0] - (0.25_f64 / 12.0).sqrt()).abs() < 1e-12);
    // From bars: pure compression of C30 and 12 d20 of HRB400, and tension of the bars.
    let bars = r#", steel = "HRB400", bars = "12 d20", cover = "35 mm""#;
    let by_rule = ", length = \"paulay-priestley\", ends = \"base\", post_yield = 0.0";
    let hinges = hinges_of(&on_surface(bars, FLEXIBLE, by_rule));
    assert_eq!(hinges.fibres.len(), 3);
    let column = &hinges.fibres[&[0, 0]];
    assert!((column.length - 0.296).abs() < 1e-12, "{} m", column.length);
    let corners = column.corners().remove(0);
    assert_eq!(corners.len(), 12);
    let steel = 12.0 * std::f64::consts::PI * 0.01_f64.powi(2) * 400e6;
    let [compression, tension] = [-corners[0][0], corners[11][0]];
    assert!((tension / steel - 1.0).abs() < 0.1, "{tension} {steel}");
    let both = 20.1e6 * 0.25 + steel;
    assert!(
        (compression / both - 1.0).abs() < 0.1,
        "{compression} {both}"
    );
}

/// Cantilevers that are pushed over under a constant axial force: the greatest shear with fibres, which crack and crush, and with the
/// interaction diagram of the same section.
#[test]
fn surfaces_bear_what_fibres_bear() {
    for load in ["200 kN", "800 kN", "1800 kN"] {
        let text = |hinges: &str| {
            format!(
                "[[building]]\nkind = \"frame\"\nstoreys = 1\nstorey_height = 3\nspans = []\nconcrete = \"C30\"\ndensity = 0\nfloor_mass = \"1 t\"\nfloor_load = \"{load}\"\naxial = {{ columns = \"flexible\", beams = \"rigid\" }}\ngravity = true\ncolumn_segments = 1\ncolumn = {{ width = 0.5, depth = 0.5, steel = \"HRB400\", bars = \"12 d20\", cover = 0.035 }}\nhinges = {{ {hinges}, length = 0.4, ends = \"base\" }}\n"
            )
        };
        let [fibres, surface] =
            ["rule = \"fibre\"", "rule = \"surface\", post_yield = 0.0"].map(|hinges| {
                let input = read(&text(hinges)).unwrap_or_else(|error| panic!("{error}"));
                let system = jostle_testkit::runs::assembled(&input.model);
                let settings = PushSettings {
                    drift: 0.03,
                    ..PushSettings::default()
                };
                let pushed = pushover(&system.buildings[0], settings).expect("it bears");
                let shears = pushed.points.iter().map(|point| point.base_shear);
                shears.fold(0.0, f64::max)
            });
        assert!(
            (surface / fibres - 1.0).abs() < 0.04,
            "{load}: {fibres} {surface}"
        );
    }
}

#[test]
fn surfaces_that_cannot_be_say_why() {
    let says = |text: &str, expected: &[&str]| {
        let error = read(text).expect_err("a fault");
        for part in expected {
            assert!(error.contains(part), "{part} is not in {error}");
        }
    };
    says(
        &on_surface("", "axial = \"rigid\"\ngravity = true", STATED),
        &["needs columns that change their length"],
    );
    says(
        &on_surface("", "axial = \"flexible\"", STATED),
        &["needs the weight of the building"],
    );
    let bent = STATED.replace("500 kN.m", "-500 kN.m");
    says(&on_surface("", FLEXIBLE, &bent), &["at least zero"]);
    let short = STATED.replace("moment = [0.0, ", "moment = [");
    says(
        &on_surface("", FLEXIBLE, &short),
        &["as many moments as axial forces"],
    );
    let turned = STATED.replace("-6 MN", "6 MN");
    says(&on_surface("", FLEXIBLE, &turned), &["ascending order"]);
    says(
        &on_surface("", FLEXIBLE, ", length = 0.4"),
        &["no column has bars"],
    );
    says(
        &on_surface("", FLEXIBLE, ""),
        &["length", "paulay-priestley"],
    );
    let more = |key: &str| format!("{STATED}, {key}");
    says(
        &on_surface("", FLEXIBLE, &more("post_yield = 1.0")),
        &["less than 1"],
    );
    says(
        &on_surface("", FLEXIBLE, &more("residual = 0.2")),
        &["has no meaning without fibres"],
    );
    says(
        &on_surface("", FLEXIBLE, &more("column = { yield = 1 }")),
        &["cannot be combined with rule = \"surface\""],
    );
    let other = "hinges = { rule = \"bilinear\", post_yield = 0.1, beam = { yield = 2e5, post_yield = 0.02 } }";
    says(&frame("", "", other), &["has no meaning without a surface"]);
    let in_space = "[[building]]\nkind = \"space-frame\"\nstoreys = 1\nstorey_height = 3\nlines_x = [0, 5]\nlines_y = [0, 5]\nmass = \"40 t\"\nconcrete = \"C30\"\ncolumn = { size = [0.5, 0.5] }\nbeam_x = { width = 0.3, depth = 0.6 }\nbeam_y = { width = 0.3, depth = 0.6 }\nhinges = { rule = \"surface\", length = 0.4 }\n";
    says(in_space, &["column.1.1.1", "has no bars"]);
}

/// The bars alone bend smoothly; their first line is that of straight loops.
#[test]
fn bars_of_fibres_bend_smoothly() {
    let bars = |more: &str| -> Vec<jostle::hysteresis::Hysteresis> {
        let hinges = hinges_of(&of_fibres(FLEXIBLE, &format!(", length = \"0.4 m\"{more}")));
        let fibres = hinges.fibres[&[1, 2]]
            .fibres
            .iter()
            .map(|fibre| fibre.spring);
        fibres
            .filter(|fibre| !matches!(fibre.rule(), HysteresisRule::Concrete(_)))
            .collect()
    };
    let (straight, bent) = (bars(""), bars(", steel = \"menegotto-pinto\""));
    assert_eq!(straight.len(), bent.len());
    for (straight, bent) in straight.iter().zip(&bent) {
        assert_eq!(straight.backbone(), bent.backbone());
        let HysteresisRule::MenegottoPinto(law) = bent.rule() else {
            panic!("{bent:?}");
        };
        assert_eq!([law.sharpness, law.loss, law.half], [20.0, 0.925, 0.15]);
    }
    let laws = bars(", steel = { rule = \"menegotto-pinto\", R0 = 15 }");
    assert!(matches!(laws[0].rule(), HysteresisRule::MenegottoPinto(law) if law.sharpness == 15.0));
    assert_eq!(bars(", steel = \"bilinear\""), straight);
    for (more, part) in [
        (
            ", length = 0.4, steel = { rule = \"bilinear\", R0 = 15 }",
            "has no meaning with straight lines",
        ),
        (
            ", length = 0.4, steel = { rule = \"menegotto-pinto\", cR1 = 1.2 }",
            "cR1 must be",
        ),
    ] {
        let text = files::refusal(&of_fibres(FLEXIBLE, more));
        assert!(text.contains(part), "{more}: {text}");
    }
}

/// Strains are those of the materials: GB 50010 for the cover of C30, 7.5 % for HRB400, and of the core what ties give by hand; those
/// that are stated replace them.
#[test]
fn strains_are_judged_by_the_section() {
    let limits = |column: &str, more: &str| {
        let building =
            format!("{FLEXIBLE}\nhinges = {{ rule = \"fibre\", length = \"0.4 m\"{more} }}");
        let column = format!(", steel = \"HRB400\", bars = \"12 d20\", cover = \"35 mm\"{column}");
        hinges_of(&frame(&column, "", &building)).fibres[&[0, 0]]
            .limits
            .clone()
    };
    let plain = limits("", "");
    let names: Vec<FibreLimit> = plain.keys().copied().collect();
    assert_eq!(names, [FibreLimit::Spalling, FibreLimit::Fracture]);
    assert_eq!(plain[&FibreLimit::Fracture], 0.075);
    assert!(
        (0.003..0.005).contains(&plain[&FibreLimit::Spalling]),
        "{plain:?}"
    );
    let tied = limits(", ties = \"4 d10 @ 100 mm\"", "");
    // 0.004 + 1.4 ρs fy εsu / fcc, with fcc between 1.1 and 1.6 times 20.1 MPa; the core is 500 − 2 (35 − 5) mm wide.
    let ratio = 2.0 * 4.0 * 78.54e-6 / (0.1 * 0.44);
    let of = |gain: f64| 0.004 + 1.4 * ratio * 400e6 * 0.075 / (gain * 20.1e6);
    let crushing = tied[&FibreLimit::Crushing];
    assert!(of(1.6) < crushing && crushing < of(1.1), "{crushing}");
    let stated = limits(
        ", ties = \"4 d10 @ 100 mm\"",
        ", limits = { spalling = 0.005, crushing = 0.02, buckling = 0.04, fracture = 0.09 }",
    );
    assert_eq!(
        stated.values().copied().collect::<Vec<_>>(),
        [0.005, 0.02, 0.04, 0.09]
    );
    let text = files::refusal(&of_fibres(
        FLEXIBLE,
        ", length = 0.4, limits = { crushing = 0.02 }",
    ));
    assert!(
        text.contains("limits.crushing: needs a core within ties"),
        "{text}"
    );
    let text = files::refusal(&of_fibres(
        FLEXIBLE,
        ", length = 0.4, limits = { fracture = -1 }",
    ));
    assert!(
        text.contains("limits.fracture: must be greater than zero"),
        "{text}"
    );
}
