//! What `jostle collide` prints and writes.

use crate::common::{complained, folder, jostle, printed};
use serde_json::Value;

const BODIES: [&str; 6] = ["--m1", "30 t", "--m2", "50 t", "--speed", "0.7 m/s"];

fn collide(arguments: &[&str]) -> Value {
    let folder = folder();
    let all = [&["collide"], &BODIES[..], arguments, &["--json"]].concat();
    let output = jostle(folder.path(), &all);
    assert!(output.status.success(), "{}", complained(&output));
    serde_json::from_str(&printed(&output)).expect("JSON and nothing else")
}

/// A dashpot instead of the coefficient: e = exp(−πζ/√(1 − ζ²)), and both together are refused.
#[test]
fn a_dashpot_takes_the_place_of_restitution() {
    let given = [
        "--law",
        "kelvin",
        "--stiffness",
        "93.5 MN/m",
        "--damping",
        "0.4 MN.s/m",
    ];
    let got = collide(&given);
    let mass = 30e3 * 50e3 / 80e3_f64;
    let ratio = 0.4e6 / (2.0 * (93.5e6 * mass).sqrt());
    let due = (-std::f64::consts::PI * ratio / (1.0 - ratio * ratio).sqrt()).exp();
    let found = got["realised_restitution"].as_f64().expect("a number");
    assert!((found - due).abs() < 1e-9, "{found}, {due}");
    assert_eq!(got["damping_n_s_m"], 0.4e6);
    assert!(got["restitution"].is_null());
    let folder = folder();
    let both = [&["collide"], &BODIES[..], &given, &["--restitution", "0.5"]].concat();
    let output = jostle(folder.path(), &both);
    assert!(!output.status.success());
    assert!(complained(&output).contains("cannot be used with"));
}

/// Closed forms with 40 digits, see the validation data (A03 and A05).
#[test]
fn one_law_gives_the_numbers_of_the_closed_forms() {
    let kelvin = [
        "--law",
        "kelvin",
        "--stiffness",
        "93.5 MN/m",
        "--restitution",
        "0.65",
    ];
    let damped = [
        "--law",
        "hertz-damp",
        "--stiffness",
        "2.75e9 N/m^1.5",
        "--restitution",
        "0.65",
    ];
    let cases: [(&[&str], [f64; 5]); 2] = [
        (
            &kelvin,
            [
                790_327.122_459_889_6,
                0.044_904_484_910_576_43,
                0.008_142_631_690_129_269,
                0.65,
                2_652.890_625,
            ],
        ),
        (
            &damped,
            [
                1_485_552.721_473_512,
                0.030_599_340_660_794_62,
                0.006_388_458_996_271_618,
                0.774_819_081_179_966_8,
                1_835.916_954_424_891,
            ],
        ),
    ];
    for (arguments, expected) in cases {
        let got = collide(arguments);
        let keys = [
            "peak_force_n",
            "duration_s",
            "peak_indentation_m",
            "realised_restitution",
            "dissipated_j",
        ];
        for (key, expected) in keys.into_iter().zip(expected) {
            let value = got[key].as_f64().expect("a number");
            assert!(
                (value / expected - 1.0).abs() < 1e-9,
                "{arguments:?}: {key} {value}, expected {expected}"
            );
        }
    }
}

#[test]
fn all_laws_realise_what_is_asked() {
    let got = collide(&[
        "--all",
        "--restitution-is",
        "realised",
        "--restitution",
        "0.5",
    ]);
    let laws = got["laws"].as_array().expect("a list");
    assert_eq!(laws.len(), 12);
    for law in laws {
        let elastic = ["linear", "hertz"].contains(&law["law"].as_str().expect("a name"));
        let expected = if elastic { 1.0 } else { 0.5 };
        let e = law["realised_restitution"].as_f64().expect("a number");
        assert!((e - expected).abs() < 1e-6, "{law}");
        assert_eq!(
            law["peak_force_n"].is_null(),
            law["law"] == "restitution",
            "{law}"
        );
    }
}

#[test]
fn curves_and_page_are_written() {
    let folder = folder();
    let files = ["--csv", "curves.csv", "--html", "page.html"];
    let output = jostle(
        folder.path(),
        &[&["collide", "--all"], &BODIES[..], &files].concat(),
    );
    assert!(output.status.success(), "{}", complained(&output));
    let text = printed(&output);
    for part in [
        "hertz-damp",
        "modified-kelvin (mahmoud-jankowski)",
        "page.html",
    ] {
        assert!(text.contains(part), "\"{part}\" should stand in:\n{text}");
    }
    let curves = std::fs::read_to_string(folder.path().join("curves.csv")).expect("the curves");
    assert!(curves.starts_with("law,time_s,indentation_m,rate_m_s,force_n\nlinear,"));
    assert!(curves.lines().count() > 2000);
    let page = std::fs::read_to_string(folder.path().join("page.html")).expect("the page");
    assert!(
        page.contains("id=\"theme\"") && page.contains("<script"),
        "light or dark"
    );
    assert!(page.contains("<svg") && !page.contains("NaN") && !page.contains("inf"));
}

#[test]
fn mistakes_are_explained() {
    let folder = folder();
    for (arguments, expected) in [
        (
            &["--m1", "30 m", "--m2", "50 t", "--speed", "1"][..],
            "--m1: expected a mass",
        ),
        (
            &["--m1", "30 t", "--m2", "0 t", "--speed", "1"],
            "--m2: must be greater than zero",
        ),
        (
            &[
                "--m1",
                "30 t",
                "--m2",
                "5 t",
                "--speed",
                "1",
                "--restitution",
                "1.2",
            ],
            "--restitution: must be greater than 0 and at most 1",
        ),
        (
            &[
                "--m1",
                "30 t",
                "--m2",
                "5 t",
                "--speed",
                "1",
                "--stiffness",
                "3 kg",
            ],
            "--stiffness: expected a Hertz contact stiffness",
        ),
        (
            &[
                "--m1",
                "30 t",
                "--m2",
                "5 t",
                "--speed",
                "1",
                "--law",
                "bilinear",
                "--restitution-is",
                "realised",
                "--restitution",
                "0.1",
            ],
            "bilinear cannot realise 0.1; at least 0.2294",
        ),
    ] {
        let output = jostle(folder.path(), &[&["collide"], arguments].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let complaint = complained(&output);
        assert!(complaint.contains(expected), "{arguments:?}: {complaint}");
    }
}
