//! Texts and pages in US units: no SI unit is left beside what the user typed, and SI texts stay as they are.

use std::fs;
use std::path::Path;

use crate::common::{complained, folder, jostle, printed};

/// Names of SI units that texts show.
const SI: &[&str] = &[
    "N·",
    "kN·",
    "kN",
    "MN",
    "mm",
    "cm",
    "m",
    "t",
    "kN·m",
    "kN.m",
    "kN·s",
    "kJ",
    "MJ",
    "MPa",
    "GPa",
    "kPa",
    "m/s",
    "m/s²",
    "cm/s²",
    "mm/s",
    "N/m",
    "N.s/m",
    "N/m^1.5",
    "N.m/rad",
    "N.m.s/rad",
    "MN.m/rad",
    "kg/m",
];

/// Lines of a text with a number in an SI unit. The first line is a title, and what checks find stays in SI.
fn si_units(text: &str) -> Vec<String> {
    let found = text.lines().skip(1).filter(|line| {
        let is_finding = ["remark:", "note:", "warning:"]
            .iter()
            .any(|word| line.contains(word));
        let words = line.split([' ', '\u{a0}', '\u{202f}', '[', ']', '(', ')', ',', ';', ':']);
        let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
        let is_number = |word: &str| word.ends_with(|last: char| last.is_ascii_digit());
        let mut pairs = words.windows(2);
        !is_finding
            && pairs.any(|pair| is_number(pair[0]) && SI.contains(&pair[1].trim_end_matches('.')))
    });
    found.map(str::to_owned).collect()
}

fn example(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    folder.join(name).display().to_string()
}

fn said(place: &Path, arguments: &[&str]) -> String {
    let output = jostle(place, arguments);
    assert!(
        output.status.success(),
        "{arguments:?}: {}",
        complained(&output)
    );
    printed(&output)
}

#[test]
fn no_text_in_us_units_has_an_si_unit() {
    let place = folder();
    let [five, linked, soil, hospital, reinforced, towers] = [
        "five_and_ten_storeys.toml",
        "linked_by_viscous_dampers.toml",
        "two_towers_on_soil.toml",
        "isolated_hospital.toml",
        "reinforced_frames.toml",
        "two_asymmetric_towers.toml",
    ]
    .map(example);
    let collide = [
        "collide", "--m1", "100t", "--m2", "70t", "--speed", "0.5m/s",
    ];
    let commands: [&[&str]; 12] = [
        &["check", &five],
        &["check", &linked],
        &["check", &soil],
        &["check", &hospital],
        &["check", &reinforced],
        &["check", &towers],
        &["run", &five, "--no-report"],
        &["run", &towers, "--no-report"],
        &["section", &reinforced],
        &["pushover", &reinforced],
        &collide,
        &["motion", "show", "el-centro-1940-ns"],
    ];
    let mut seen = 0;
    for arguments in commands {
        let us = said(place.path(), &[arguments, &["--units", "us"][..]].concat());
        let left = si_units(&us);
        assert!(left.is_empty(), "{arguments:?}: {left:#?}");
        assert!(
            ["in", "kip", "ft"].iter().any(|unit| us.contains(unit)),
            "{us}"
        );
        let si = said(place.path(), arguments);
        seen += si_units(&si).len();
    }
    assert!(seen > 50, "{seen} lines with SI units without the option");
}

/// A width that the file gives in hundredths of an inch is the same in the text of its check: no text is rounded twice.
#[test]
fn texts_of_checks_repeat_stated_widths() {
    let place = folder();
    let text = fs::read_to_string(example("five_and_ten_storeys.toml")).expect("read");
    let width = text
        .lines()
        .find(|line| line.starts_with("width"))
        .expect("a gap");
    for hundredths in [5, 17, 33, 49, 58, 66, 80, 91] {
        let gap = format!("0.{hundredths:02} in");
        let own = text.replace(width, &format!("width = \"{gap}\""));
        fs::write(place.path().join("a.toml"), own).expect("written");
        let us = said(place.path(), &["check", "a.toml", "--units", "us"]);
        let due = format!("the gap of {gap} is smaller than the construction tolerance (0.98 in)");
        assert!(us.contains(&due), "{due}: {us}");
    }
}

/// The same run: a displacement in inches is that in millimetres by 25.4, a force in kip that in kN by 4.448 22.
#[test]
fn a_model_asks_for_us_units_and_the_option_comes_first() {
    let place = folder();
    let text = fs::read_to_string(example("five_and_ten_storeys.toml")).expect("read");
    fs::write(place.path().join("si.toml"), &text).expect("written");
    let us = format!("{text}\n[output]\nunits = \"us\"\n");
    fs::write(place.path().join("us.toml"), us).expect("written");
    let run = |arguments: &[&str]| said(place.path(), arguments);
    let si = run(&["run", "si.toml", "--no-report"]);
    // The last lines say how long it took, and where the results are.
    let results = |text: &str| {
        text.split("\naccuracy")
            .next()
            .unwrap_or_default()
            .to_owned()
    };
    let chosen = run(&["run", "us.toml", "--no-report", "--units", "si"]);
    assert_eq!(results(&si), results(&chosen));
    let us = run(&["run", "us.toml", "--no-report"]);
    assert!(si_units(&us).is_empty(), "{us}");
    let peak = |text: &str, unit: &str| -> f64 {
        let after = text.split(", peak ").find(|part| {
            part.split_whitespace()
                .nth(1)
                .is_some_and(|word| word.starts_with(unit))
        });
        let word = after
            .and_then(|part| part.split_whitespace().next())
            .expect("a peak force");
        word.parse().expect("a number")
    };
    let (kilonewtons, kip) = (peak(&si, "kN"), peak(&us, "kip"));
    assert!(
        (kip - kilonewtons / 4.448_221_615).abs() < 0.07,
        "{kip} kip, {kilonewtons} kN"
    );
}
