//! `jostle motion` as a user meets it.

use crate::common::{complained, folder, jostle, printed};
use serde_json::Value;

fn json_of(folder: &std::path::Path, arguments: &[&str]) -> Value {
    let output = jostle(folder, arguments);
    assert!(
        output.status.success(),
        "{arguments:?}: {}",
        complained(&output)
    );
    serde_json::from_str(&printed(&output)).expect("nothing but JSON")
}

fn near(value: &Value, wanted: f64, relative: f64) -> bool {
    value
        .as_f64()
        .is_some_and(|value| (value / wanted - 1.0).abs() <= relative)
}

#[test]
fn spectra_have_the_shape_of_the_contract() {
    let folder = folder();
    let arguments = [
        "motion",
        "spectrum",
        "el-centro-1940-ns",
        "--damping",
        "0.02,0.05",
        "--periods",
        "0.5,1,2",
        "--json",
    ];
    let spectrum = json_of(folder.path(), &arguments);
    assert_eq!(spectrum["periods_s"], serde_json::json!([0.5, 1.0, 2.0]));
    assert_eq!(spectrum["spectra"][1]["damping"], 0.05);
    // Chopra, Dynamics of Structures: 2.67, 5.97 and 7.47 in.
    for (k, inches) in [2.67, 5.97, 7.47].into_iter().enumerate() {
        let value = &spectrum["spectra"][0]["displacement_m"][k];
        assert!(
            near(value, inches * 0.0254, 5e-3),
            "{value} for {inches} in"
        );
    }
    assert!(spectrum["spectra"][0]["pseudo_acceleration_m_s2"][2].is_f64());
    assert!(spectrum.get("inelastic").is_none());
}

#[test]
fn show_prints_measures_and_writes_a_page() {
    let folder = folder();
    let shown = json_of(
        folder.path(),
        &[
            "motion",
            "show",
            "el-centro-1940-ns",
            "--json",
            "--html",
            "page.html",
        ],
    );
    for (key, wanted) in [
        ("points", 1560.0),
        ("step_s", 0.02),
        ("pga_m_s2", 0.31882 * 9.81),
        ("pgv_m_s", 0.3608),
        ("pgd_m", 0.212),
        ("arias_m_s", 1.8010),
        ("d5_95_s", 23.84),
    ] {
        assert!(near(&shown[key], wanted, 1e-3), "{key}: {}", shown[key]);
    }
    let page = std::fs::read_to_string(folder.path().join("page.html")).expect("the page");
    assert!(page.contains("Response spectra") && !page.contains("http://www.example"));
    let text = printed(&jostle(folder.path(), &["motion", "show", "el-centro"]));
    assert!(
        text.contains("Arias intensity") && text.contains("23.84 s"),
        "{text}"
    );
}

#[test]
fn waves_are_made_converted_and_checked() {
    let folder = folder();
    let run = |arguments: &[&str]| {
        let output = jostle(folder.path(), arguments);
        assert!(
            output.status.success(),
            "{arguments:?}: {}",
            complained(&output)
        );
        printed(&output)
    };
    let text = run(&[
        "motion",
        "synth",
        "recipe",
        "nanjing-artificial",
        "-o",
        "nj.csv",
    ]);
    assert!(
        text.contains("PGA 0.3500 m/s²") && text.contains("largest difference"),
        "{text}"
    );
    run(&[
        "motion",
        "synth",
        "noise",
        "--pga",
        "0.1 g",
        "-o",
        "noise.at2",
    ]);
    run(&[
        "motion",
        "synth",
        "pulse",
        "--shape",
        "makris-b",
        "--velocity",
        "0.5 m/s",
        "--period",
        "1 s",
        "-o",
        "pulse.csv",
    ]);
    let text = run(&[
        "motion",
        "convert",
        "nj.csv",
        "-o",
        "half.at2",
        "--to",
        "20 s",
        "--resample",
        "0.02 s",
        "--low-pass",
        "15 Hz",
        "--detrend",
        "1",
        "--scale",
        "-2",
    ]);
    assert!(text.contains("1001 values, step 0.02 s"), "{text}");
    let shown = json_of(folder.path(), &["motion", "show", "half.at2", "--json"]);
    assert_eq!(shown["points"], 1001);
    run(&[
        "motion",
        "spectrum",
        "half.at2",
        "--ductility",
        "2",
        "--periods",
        "0.3,0.6",
        "--csv",
        "s.csv",
        "--parquet",
        "s.parquet",
    ]);
    let csv = std::fs::read_to_string(folder.path().join("s.csv")).expect("a table");
    assert!(
        csv.starts_with("period_s,sd_5pct_m,psv_5pct_m_s,psa_5pct_m_s2"),
        "{csv}"
    );
    assert!(
        csv.contains("reduction_mu2_5pct") && csv.lines().count() == 3,
        "{csv}"
    );
    assert!(
        std::fs::metadata(folder.path().join("s.parquet"))
            .expect("a table")
            .len()
            > 100
    );
    let code = [
        "--code",
        "gb50011",
        "--intensity",
        "7",
        "--site",
        "II",
        "--group",
        "1",
    ];
    let mut arguments = vec![
        "motion",
        "select",
        "--natural",
        "nj.csv,nj.csv",
        "--artificial",
        "nj.csv",
        "--periods",
        "0.8,0.25",
        "--json",
        "--html",
        "set.html",
    ];
    arguments.extend(code);
    let checked = json_of(folder.path(), &arguments);
    assert_eq!(checked["passes"], true, "{checked}");
    assert!(folder.path().join("set.html").exists());
}

#[test]
fn what_a_record_leaves_open_is_asked_in_options() {
    let folder = folder();
    std::fs::write(folder.path().join("bare.txt"), "0.0\n0.1\n-0.2\n0.1\n").expect("written");
    let ask = |arguments: &[&str]| {
        let output = jostle(folder.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        complained(&output)
    };
    let unit = ask(&["motion", "show", "bare.txt"]);
    assert!(unit.contains("Say it with --unit \"g\""), "{unit}");
    let step = ask(&["motion", "show", "bare.txt", "--unit", "g"]);
    assert!(step.contains("Say it with --step \"0.01 s\""), "{step}");
    let said = [
        "motion", "show", "bare.txt", "--unit", "g", "--step", "0.01 s",
    ];
    assert!(jostle(folder.path(), &said).status.success());
    // Where a command has no such options, another one has.
    let mut arguments = vec![
        "motion",
        "select",
        "--natural",
        "bare.txt",
        "--periods",
        "1",
    ];
    arguments.extend(["--code", "gb50011", "--intensity", "7"]);
    arguments.extend(["--site", "II", "--group", "1"]);
    let set = ask(&arguments);
    assert!(set.contains("motion convert bare.txt"), "{set}");
}

#[test]
fn mistakes_name_the_remedy() {
    let folder = folder();
    for (arguments, part) in [
        (&["motion", "show", "el-zentro"][..], "did you mean"),
        (
            &["motion", "spectrum", "el-centro", "--damping", "1.5"],
            "damping ratio must lie from 0 to below 1",
        ),
        (
            &["motion", "spectrum", "el-centro", "--periods", "2 kg"],
            "--periods: expected a time",
        ),
        (
            &["motion", "convert", "el-centro", "x.mseed"],
            "written as .at2 or .csv",
        ),
        (
            &[
                "motion",
                "convert",
                "el-centro",
                "x.csv",
                "--low-pass",
                "30 Hz",
            ],
            "corner frequency must lie between 0 and half",
        ),
        (
            &[
                "motion",
                "synth",
                "spectrum",
                "--code",
                "gb50011",
                "--intensity",
                "7",
                "-o",
                "x.csv",
            ],
            "--site is missing; one of I0",
        ),
        (
            &[
                "motion",
                "synth",
                "pulse",
                "--shape",
                "square",
                "--velocity",
                "1",
                "--period",
                "1",
                "-o",
                "x.csv",
            ],
            "--shape must be one of",
        ),
        (
            &["motion", "synth", "recipe", "taft", "-o", "x.csv"],
            "known: nanjing-artificial",
        ),
    ] {
        let output = jostle(folder.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let text = complained(&output);
        assert!(text.contains(part), "{arguments:?}: {text}");
        assert!(!folder.path().join("x.csv").exists(), "nothing is written");
    }
}

#[test]
fn a_folder_names_the_records_in_it() {
    let folder = folder();
    let record = "NPTS= 2, DT= .01 SEC\n1 0.5\n";
    std::fs::create_dir(folder.path().join("set")).expect("a folder");
    for name in ["b.at2", "a.at2"] {
        std::fs::write(folder.path().join("set").join(name), record).expect("a record");
    }
    std::fs::write(folder.path().join("set/readme.txt"), "not a record\n").expect("a text");
    let said = |name: &str| {
        let output = jostle(folder.path(), &["motion", "show", name]);
        assert_eq!(output.status.code(), Some(2), "{}", complained(&output));
        complained(&output)
    };
    assert_eq!(
        said("set"),
        "error: set: is a folder, not a record; give one of the records in it: a.at2, b.at2\n"
    );
    std::fs::create_dir(folder.path().join("empty")).expect("a folder");
    assert_eq!(
        said("empty"),
        "error: empty: is a folder, not a record; there is no record in it\n"
    );
    for number in 0..9 {
        let name = format!("c{number}.at2");
        std::fs::write(folder.path().join("set").join(name), record).expect("a record");
    }
    let text = said("set");
    assert!(text.ends_with("c4.at2, c5.at2, …\n"), "{text}");
}

#[cfg(unix)]
#[test]
fn endless_files_are_refused_and_long_ones_read_to_their_limit_only() {
    let folder = folder();
    // Holes take no place on the disk.
    let long = |name: &str, mebibytes: u64| {
        let file = std::fs::File::create(folder.path().join(name)).expect("created");
        file.set_len((mebibytes << 20) + 1)
            .expect("as long as that");
    };
    long("record", 64);
    long("model.toml", 16);
    long("target.csv", 1);
    let said = |arguments: &[&str]| {
        let output = jostle(folder.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{}", complained(&output));
        complained(&output)
    };
    assert_eq!(
        said(&["motion", "show", "/dev/zero"]),
        "error: /dev/zero: is a device, not a file\n"
    );
    assert_eq!(
        said(&["motion", "show", "record"]),
        "error: record: has more than 64 MiB, the most that a record may have; cut the record, or export one component as columns of text\n"
    );
    let text = said(&["run", "model.toml"]);
    assert!(text.contains("more than 16 MiB"), "{text}");
    let text = said(&[
        "motion",
        "synth",
        "spectrum",
        "--target",
        "target.csv",
        "-o",
        "wave.csv",
    ]);
    assert!(
        text.contains("larger than a spectrum can be (1 MiB)"),
        "{text}"
    );
}

#[test]
fn pulses_have_the_peak_velocity_asked_for() {
    let folder = folder();
    for shape in [
        "mavroeidis",
        "makris-a",
        "makris-b",
        "makris-c1",
        "makris-c2",
    ] {
        let output = jostle(
            folder.path(),
            &[
                "motion",
                "synth",
                "pulse",
                "--shape",
                shape,
                "--velocity",
                "0.8 m/s",
                "--period",
                "1.5 s",
                "-o",
                "pulse.csv",
                "--force",
            ],
        );
        assert!(output.status.success(), "{}", complained(&output));
        let text = printed(&output);
        assert!(text.ends_with("PGV 0.8000 m/s\n"), "{text}");
        let shown = json_of(folder.path(), &["motion", "show", "pulse.csv", "--json"]);
        assert!(
            near(&shown["pgv_m_s"], 0.8, 1e-6),
            "{shape}: {}",
            shown["pgv_m_s"]
        );
    }
}

#[test]
fn sets_are_judged_by_the_rules_of_their_code() {
    let folder = folder();
    let codes = [
        (
            "en1998",
            &["--code", "en1998", "--ground", "B", "--ag", "0.2 g"][..],
            3,
        ),
        (
            "asce7",
            &["--code", "asce7", "--sds", "1.0 g", "--sd1", "0.6 g"][..],
            11,
        ),
    ];
    for (name, code, count) in codes {
        let file = format!("{name}.csv");
        let mut make = vec!["motion", "synth", "spectrum", "-o", &file];
        make.extend(code);
        let made = jostle(folder.path(), &make);
        assert!(made.status.success(), "{}", complained(&made));
        let judge = |motions: usize, more: &[&str]| {
            let set = vec![&file[..]; motions].join(",");
            let mut arguments = vec!["motion", "select", "--artificial", &set];
            arguments.extend(["--periods", "0.8,0.25"]);
            arguments.extend(code);
            arguments.extend(more);
            jostle(folder.path(), &arguments)
        };
        let good = judge(count, &[]);
        assert_eq!(good.status.code(), Some(0), "{}", printed(&good));
        let few = judge(count - 1, &["--json"]);
        assert_eq!(few.status.code(), Some(1));
        let json: Value = serde_json::from_str(&printed(&few)).expect("nothing but JSON");
        assert_eq!(json["passes"], false);
        assert_eq!(
            (&json["enough"], &json["mean_suffices"]),
            (&false.into(), &true.into())
        );
        assert!(
            json.get("base_shear_agrees").is_none(),
            "a rule of GB 50011: {json}"
        );
        let page = format!("{name}.html");
        let weak = judge(count, &["--pga", "0.1 g", "--html", &page]);
        assert_eq!(weak.status.code(), Some(1));
        let text = printed(&weak);
        let page = std::fs::read_to_string(folder.path().join(page)).expect("a page");
        for written in [&text, &page] {
            assert!(!written.contains("GB 50011"), "{written}");
            let clause = if name == "en1998" {
                "3.2.3.1.2(4)c"
            } else {
                "16.2.3"
            };
            assert!(written.contains(clause), "{written}");
        }
        let said = complained(&weak);
        let wanted = if name == "en1998" {
            "error: the set fails 2 of 3 rules of EN 1998-1, clause 3.2.3.1.2(4)\n"
        } else {
            "error: the set fails 1 of 2 rules of ASCE 7, section 16.2\n"
        };
        assert_eq!(said, wanted);
    }
}

/// A decaying wave, eight values on a line.
fn wrapped() -> String {
    let value = |i: i32| {
        let t = 0.01 * f64::from(i);
        0.3 * (12.0 * t).sin() * (-(t - 2.0).powi(2)).exp()
    };
    let values: Vec<f64> = (0..400).map(value).collect();
    let line = |line: &[f64]| {
        let cells: String = line.iter().map(|a| format!("{a:10.5}")).collect();
        cells + "\n"
    };
    values.chunks(8).map(line).collect()
}

#[test]
fn options_say_how_lines_are_read() {
    let folder = folder();
    let write = |name: &str, text: &str| {
        std::fs::write(folder.path().join(name), text).expect("a file is written");
    };
    write("eight.acc", &wrapped());
    let show = |more: &[&str]| {
        let mut arguments = vec![
            "motion",
            "show",
            "eight.acc",
            "--json",
            "--unit",
            "g",
            "--step",
            "0.01",
        ];
        arguments.extend(more);
        jostle(folder.path(), &arguments)
    };
    let refused = show(&["--column", "2"]);
    assert_eq!(refused.status.code(), Some(2));
    assert_eq!(
        complained(&refused),
        "error: eight.acc:1: the 8 numbers of a line continue from line to line: they are 8 accelerations, not columns; say --per-line 8 to read all of them, or --content columns with column if they are columns all the same\n"
    );
    for stated in [
        &["--per-line", "8"][..],
        &["--content", "values"],
        &["--content", "values", "--widths", "10"],
    ] {
        let output = show(stated);
        assert!(
            output.status.success(),
            "{stated:?}: {}",
            complained(&output)
        );
        let shown: Value = serde_json::from_str(&printed(&output)).expect("JSON");
        assert_eq!(shown["points"], 400, "{stated:?}");
    }
    let shorter = show(&["--per-line", "8", "--skip", "2", "--last", "12"]);
    let shown: Value = serde_json::from_str(&printed(&shorter)).expect("JSON");
    assert_eq!(shown["points"], 80);
    // Widths are a list, and the message offers them as one.
    write("glued.txt", " 0.010-0.100\n0.020 -0.200\n  0.03 -0.30\n");
    let arguments = ["motion", "show", "glued.txt", "--unit", "g"];
    let text = complained(&jostle(folder.path(), &arguments));
    assert!(text.contains("such as --widths 6\n"), "{text}");
    write("pairs.txt", "0.00 0.1 0.01 0.2\n0.02 -0.3 0.03 0.1\n");
    let arguments = [
        "motion",
        "show",
        "pairs.txt",
        "--unit",
        "g",
        "--pairs",
        "--json",
    ];
    assert_eq!(json_of(folder.path(), &arguments)["points"], 4);
    let both = jostle(
        folder.path(),
        &["motion", "show", "x", "--pairs", "--content", "values"],
    );
    assert!(
        complained(&both).contains("cannot be used with"),
        "{}",
        complained(&both)
    );
}

#[test]
fn matching_says_what_it_changes_and_warns_of_long_periods() {
    let folder = folder();
    let show = |name: &str| json_of(folder.path(), &["motion", "show", name, "--json"]);
    for (ground, level, warns) in [("B", "0.3 g", false), ("D", "0.35 g", true)] {
        let mut arguments = vec![
            "motion",
            "synth",
            "spectrum",
            "--record",
            "el-centro",
            "--code",
            "en1998",
        ];
        arguments.extend([
            "--ground",
            ground,
            "--ag",
            level,
            "--tolerance",
            "0.1",
            "-o",
            "matched.csv",
            "--force",
        ]);
        let output = jostle(folder.path(), &arguments);
        assert!(output.status.success(), "{}", complained(&output));
        let text = printed(&output);
        let row = |name: &str| -> Vec<f64> {
            let line = text
                .lines()
                .find(|line| line.trim_start().starts_with(name));
            let line = line.unwrap_or_else(|| panic!("{name} in {text}"));
            let numbers = line.split(']').nth(1).unwrap_or("").split_whitespace();
            numbers.filter_map(|word| word.parse().ok()).collect()
        };
        let (before, after) = (show("el-centro"), show("matched.csv"));
        for (name, key, digit) in [
            ("peak acceleration", "pga_m_s2", 1e-4),
            ("peak velocity", "pgv_m_s", 1e-4),
            ("peak displacement", "pgd_m", 1e-4),
            ("Arias intensity", "arias_m_s", 1e-4),
            ("duration 5–95 %", "d5_95_s", 1e-2),
        ] {
            let found = row(name);
            let [one, two] = [&before, &after].map(|shown| shown[key].as_f64().expect("a number"));
            // The file holds fewer digits than the motion that was measured.
            let near = |found: f64, wanted: f64| (found - wanted).abs() <= digit + 1e-4 * wanted;
            assert!(
                near(found[0], one) && near(found[1], two),
                "{name}: {found:?}, {one}, {two}"
            );
            assert!(
                (found[2] - two / one).abs() <= 0.006 + 1e-3 * two / one,
                "{name}: {found:?}"
            );
        }
        let ratio =
            |key: &str| after[key].as_f64().unwrap_or(0.0) / before[key].as_f64().unwrap_or(1.0);
        let growth = ratio("pgd_m") / ratio("pga_m_s2");
        assert_eq!(growth > 2.5, warns, "{growth}");
        let complaint = complained(&output);
        assert_eq!(
            complaint.contains("the peak displacement grew from 212 to"),
            warns,
            "{complaint}"
        );
    }
    // Without a record there is nothing to compare with.
    let arguments = [
        "motion",
        "synth",
        "spectrum",
        "--code",
        "en1998",
        "--ground",
        "B",
        "--ag",
        "0.2 g",
        "-o",
        "sines.csv",
    ];
    let text = printed(&jostle(folder.path(), &arguments));
    assert!(
        text.contains("peak displacement") && !text.contains("matched"),
        "{text}"
    );
}
