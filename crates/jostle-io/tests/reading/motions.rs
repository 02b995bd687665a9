//! Motions that models ask for: named artificial waves, and scaling to a spectrum.

use std::path::Path;

use jostle_io::{Format, builtin_motions, builtin_record, read_model_text};
use jostle_motion::{Accelerogram, Reading, response_spectrum};

const TOWER: &str = "[[building]]\nkind = \"shear\"\nmass = \"40 t\"\nstiffness = \"60 MN/m\"\n";

fn motion_of(motion: &str, base: &Path) -> Result<jostle::GroundMotion, String> {
    let text = format!("[motion]\n{motion}\n{TOWER}");
    let input = read_model_text("m.toml", &text, Format::Toml, base).map_err(|e| e.to_string())?;
    input.ground_motion().map_err(|error| error.to_string())
}

/// Pseudo-acceleration with 5 % damping \[m/s²\].
fn spectral(motion: &jostle::GroundMotion, period: f64) -> f64 {
    let values = (0..motion.points()).map(|i| motion.acceleration(0.02 * i as f64));
    let motion = Accelerogram::new(0.02, values.collect()).expect("a motion");
    let spectrum = response_spectrum(&motion, &[period], &[0.05], Reading::Between);
    spectrum.expect("a spectrum").curves[0].pseudo_acceleration[0]
}

#[test]
fn every_built_in_motion_can_be_had() {
    let names: Vec<_> = builtin_motions()
        .into_iter()
        .map(|(name, _)| name)
        .collect();
    assert!(names.contains(&"el-centro-1940-ns") && names.contains(&"nanjing-artificial"));
    for name in names {
        assert!(
            builtin_record(name).is_some_and(|motion| motion.peak() > 0.1),
            "{name}"
        );
    }
    let motion = motion_of(
        "record = \"nanjing-artificial\"\npga = \"70 cm/s2\"",
        Path::new(""),
    );
    assert!((motion.expect("a motion").peak() - 0.7).abs() < 1e-9);
}

#[test]
fn a_factor_of_zero_is_refused() {
    let error = motion_of("record = \"el-centro-1940-ns\"\nscale = 0", Path::new(""));
    let error = error.expect_err("nothing would shake");
    assert!(
        error.contains("motion.scale: must not be 0, with which nothing shakes"),
        "{error}"
    );
}

#[test]
fn a_motion_is_scaled_to_a_spectrum() {
    let gb = "spectrum = { code = \"gb50011\", intensity = 7.5, site = \"II\", group = 1, level = \"rare\" }";
    let record = "record = \"el-centro-1940-ns\"\nmatch = ";
    let none = Path::new("");
    let motion = motion_of(&format!("{record}{{ {gb}, at = \"0.8 s\" }}"), none).expect("a motion");
    // T_g = 0.40 s, α_max = 0.72: α = 0.72 √(0.5)^1.8.
    let wanted = 9.80665 * 0.72 * 0.5_f64.powf(0.9);
    assert!((spectral(&motion, 0.8) / wanted - 1.0).abs() < 1e-9);
    let motion = motion_of(
        &format!("{record}{{ value = \"3 m/s2\", at = \"1 s\" }}"),
        none,
    );
    assert!((spectral(&motion.expect("a motion"), 1.0) - 3.0).abs() < 1e-9);
    let folder = std::env::temp_dir();
    let file = folder.join(format!("jostle-spectrum-{}.csv", std::process::id()));
    std::fs::write(&file, "# unit = m/s2\n0.1 4.0\n4.0 4.0\n").expect("written");
    let name = file
        .file_name()
        .and_then(|name| name.to_str())
        .expect("a name");
    let wanted = format!("{record}{{ spectrum = \"{name}\", periods = [0.5, 1.5] }}");
    let motion = motion_of(&wanted, &folder).expect("a motion");
    std::fs::remove_file(&file).expect("removed");
    let logarithms =
        (0..100).map(|i| (spectral(&motion, 0.5 * 3.0_f64.powf(f64::from(i) / 99.0)) / 4.0).ln());
    assert!(
        (logarithms.sum::<f64>() / 100.0).abs() < 1e-9,
        "geometric mean"
    );
}

#[test]
fn wrong_matches_name_the_key() {
    let record = "record = \"el-centro-1940-ns\"\n";
    for (wrong, part) in [
        ("match = { at = 1 }", "motion.match.spectrum: is missing"),
        ("match = { value = 3 }", "motion.match.at: is missing"),
        (
            "match = { value = 3, at = 1, periods = [1, 2] }",
            "motion.match.periods: cannot be combined with at",
        ),
        (
            "match = { value = 3, periods = [2, 1] }",
            "the first period must be the shorter one",
        ),
        (
            "match = { value = 3, at = 1, damping = 2 }",
            "motion.match.damping: must lie from 0 to below 1",
        ),
        (
            "pga = 1\nmatch = { value = 3, at = 1 }",
            "motion.match: cannot be combined with pga",
        ),
        (
            "match = { at = 1, spectrum = { code = \"gb50011\", intensity = 5 } }",
            "intensity: must be one of 6, 7",
        ),
        (
            "match = { at = 1, spectrum = { code = \"en1998\", ground = \"B\" } }",
            "motion.match.spectrum.ag: is missing",
        ),
        (
            "match = { at = 9, spectrum = { code = \"en1998\", ground = \"B\", ag = 2 } }",
            "cannot be matched: a period must lie",
        ),
        (
            "match = { at = 1, spectrum = \"nowhere.csv\" }",
            "cannot be read",
        ),
    ] {
        let error = motion_of(&format!("{record}{wrong}"), Path::new("")).expect_err(wrong);
        assert!(error.contains(part), "{wrong}:\n{error}");
    }
}

/// Seven pairs: the components across and vertical of a record go with it, however it is chosen.
#[test]
fn components_are_listed_beside_their_records() {
    let read = |motion: &str| {
        let text = format!("[motion]\n{motion}\n{TOWER}");
        read_model_text("m.toml", &text, Format::Toml, Path::new("")).map_err(|e| e.to_string())
    };
    let pair = "\"el-centro-1940-ns\", \"nanjing-artificial\"";
    let swapped = "\"nanjing-artificial\", \"el-centro-1940-ns\"";
    let names = |input: &jostle_io::Input| {
        let motion = input.ground_motion().expect("a motion");
        let ground = motion
            .grounds
            .as_ref()
            .and_then(|grounds| grounds.own.first());
        let vertical = ground.and_then(|ground| ground.vertical.as_ref());
        let across = motion.bearing.expect("across").across.expect("a motion");
        (
            motion.name,
            across.name,
            vertical.map(|vertical| vertical.name.clone()),
        )
    };
    let (ns, artificial) = (
        "el-centro-1940-ns".to_owned(),
        "nanjing-artificial".to_owned(),
    );
    for across in [
        format!("[{swapped}]"),
        format!("{{ record = [{swapped}], scale = 0.5 }}"),
    ] {
        let text = format!("record = [{pair}]\nacross = {across}");
        let each = read(&text).expect("pairs").each_record();
        let found: Vec<_> = each.iter().map(names).collect();
        let due = [
            (ns.clone(), artificial.clone(), None),
            (artificial.clone(), ns.clone(), None),
        ];
        assert_eq!(found, due);
    }
    // Chosen by its name in the tree of the model, as studies do.
    let text = format!("[motion]\nrecord = [{pair}]\nacross = [{swapped}]\n{TOWER}");
    let mut tree =
        jostle_io::ModelTree::parse("m.toml", &text, Format::Toml, Path::new("")).expect("a model");
    let chosen = jostle_io::TreeValue::Text(artificial.clone());
    tree.set("motion.record", &chosen)
        .expect("a record of the list");
    assert_eq!(
        names(&tree.input().expect("one pair")),
        (artificial, ns, None)
    );

    for (wrong, part) in [
        (
            format!("record = \"el-centro-1940-ns\"\nacross = [{pair}]"),
            "motion.across: lists 2 motions for one record",
        ),
        (
            format!("record = [{pair}]\nvertical = [{pair}, \"c\"]"),
            "motion.vertical: lists 3 motions for 2 records",
        ),
        (
            format!("record = [{pair}]\nacross = {{ record = [{pair}, \"c\"] }}"),
            "motion.across: lists 3 motions for 2 records",
        ),
    ] {
        let error = read(&wrong).expect_err(&wrong);
        assert!(error.contains(part), "{error}");
    }
}

/// A list of factors has one for each record, with its components.
#[test]
fn records_of_a_list_have_factors_of_their_own() {
    let read = |motion: &str| {
        let text = format!("[motion]\n{motion}\n{TOWER}");
        read_model_text("m.toml", &text, Format::Toml, Path::new("")).map_err(|e| e.to_string())
    };
    let pair = "record = [\"el-centro-1940-ns\", \"nanjing-artificial\"]";
    let each = read(&format!("{pair}\nscale = [1.25, 0.8]"))
        .expect("two factors")
        .each_record();
    let scales: Vec<f64> = each
        .iter()
        .map(|input| input.ground_motion().expect("a motion").scale)
        .collect();
    assert_eq!(scales, [1.25, 0.8]);
    for (wrong, part) in [
        (
            format!("{pair}\nscale = [1, 2, 3]"),
            "motion.scale: has 3 entries for 2 records",
        ),
        (
            format!("{pair}\nscale = [1, 0]"),
            "motion.scale[1]: must not be 0",
        ),
        (
            "record = \"el-centro-1940-ns\"\nscale = [1]".to_owned(),
            "motion.scale: is a list, but there is one record",
        ),
    ] {
        let error = read(&wrong).expect_err("a fault");
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn of_several_records_a_run_takes_one() {
    let read = |motion: &str| {
        let text = format!("[motion]\n{motion}\n{TOWER}");
        read_model_text("m.toml", &text, Format::Toml, Path::new("")).map_err(|e| e.to_string())
    };
    let one = read("record = [\"el-centro-1940-ns\"]").expect("one record");
    assert!(one.records().is_empty() && one.ground_motion().is_ok());
    assert_eq!(one.each_record().len(), 1);

    let listed =
        "record = [\"el-centro-1940-ns\",\n  \"nanjing-artificial\",\n  \"lost.at2\"]\npga = 1";
    let several = read(listed).expect("a list");
    assert_eq!(several.records().len(), 3);
    let error = several.ground_motion().expect_err("one too many");
    let error = error.to_string();
    for part in [
        "motion.record: is a list of 3 records, and one analysis takes one",
        "--record el-centro-1940-ns",
        "m.toml:2",
    ] {
        assert!(error.contains(part), "{part} is missing:\n{error}");
    }
    let each = several.each_record();
    let names: Vec<String> = each[..2]
        .iter()
        .map(|input| input.ground_motion().expect("a motion").name)
        .collect();
    assert_eq!(names, ["el-centro-1940-ns", "nanjing-artificial"]);
    // A record that cannot be had is shown at its own line.
    let lost = each[2].ground_motion().expect_err("no file").to_string();
    assert!(
        lost.contains("m.toml:4") && lost.contains("lost.at2"),
        "{lost}"
    );

    for (wrong, part) in [
        ("record = []", "motion.record: is an empty list"),
        (
            "record = [\"a\", \"a\"]",
            "motion.record[1]: \"a\" appears in the list twice",
        ),
        ("record = [\"a\", 3]", "motion.record[1]: "),
        (
            "record = [\"a\", \" \"]",
            "motion.record[1]: must not be empty",
        ),
    ] {
        let error = read(wrong).expect_err(wrong);
        assert!(error.contains(part), "{wrong}:\n{error}");
    }
}

#[test]
fn a_record_chosen_from_a_list_keeps_what_the_list_says_of_it() {
    let folder = std::env::temp_dir().join(format!("jostle-list-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    for name in ["a.txt", "b.txt", "station.NS", "station.EW2"] {
        std::fs::write(folder.join(name), "0.0\n0.1\n-0.2\n0.1\n").expect("written");
    }
    let text = format!(
        "[motion]\nrecord = [\"a.txt\", \"b.txt\"]\nunit = \"g\"\nstep = 0.01\nscale = 2\n{TOWER}"
    );
    let mut input = read_model_text("m.toml", &text, Format::Toml, &folder).expect("a model");
    input
        .apply(&jostle_io::Overrides {
            record: Some("b.txt".into()),
            ..jostle_io::Overrides::default()
        })
        .expect("a record of the list");
    let motion = input.ground_motion().expect("a motion");
    // Files of one station that differ in their direction alone keep it in their names.
    let text = text
        .replace("a.txt", "station.NS")
        .replace("b.txt", "station.EW2");
    let both = read_model_text("m.toml", &text, Format::Toml, &folder).expect("a model");
    let names = both.each_record().into_iter();
    let names: Vec<String> = names
        .map(|input| input.ground_motion().expect("a motion").name)
        .collect();
    assert_eq!(names, ["station.NS", "station.EW2"]);
    std::fs::remove_dir_all(&folder).expect("removed");
    assert_eq!((&motion.name[..], motion.scale), ("b", 2.0));
    assert!((motion.peak() - 0.4 * 9.80665).abs() < 1e-12);
}
