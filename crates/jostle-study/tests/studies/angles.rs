//! The study of the angle of incidence: closed forms without contact, the turned site with contact, its page and tables.

use std::f64::consts::PI;
use std::path::Path;

use jostle_io::{Format, ModelTree};
use jostle_study::dataset::read_columns;
use jostle_study::{Incidence, RunSettings, Study, finish, incidence, run};

const HEAD: &str = r#"
title = "Pair"
[motion]
record = "el-centro-1940-ns"
pga = "0.3 g"
duration = "6 s"
"#;

/// One building without eccentricity, softer across.
const ALONE: &str = r#"
[[building]]
name = "A"
kind = "shear"
plan = ["10 m", "6 m"]
mass = ["100 t", "80 t"]
storey_height = "3 m"
stiffness = { x = "60 MN/m", y = "25 MN/m" }
"#;

/// Two neighbours with eccentricities and a motion across, along x or turned by a right angle.
fn pair(turned: bool) -> String {
    // (x, y) turns to (−y, x).
    let [plan_a, plan_b, at_a, at_b] = match turned {
        false => [
            r#"["10 m", "6 m"]"#,
            r#"["8 m", "7 m"]"#,
            r#"["0 m", "0 m"]"#,
            r#"["10.02 m", "1 m"]"#,
        ],
        true => [
            r#"["6 m", "10 m"]"#,
            r#"["7 m", "8 m"]"#,
            r#"["-6 m", "0 m"]"#,
            r#"["-8 m", "10.02 m"]"#,
        ],
    };
    let stiff = |x: f64, y: f64| match turned {
        false => format!("{{ x = \"{x} MN/m\", y = \"{y} MN/m\" }}"),
        true => format!("{{ x = \"{y} MN/m\", y = \"{x} MN/m\" }}"),
    };
    let off = |x: f64, y: f64| match turned {
        false => format!("[\"{x} m\", \"{y} m\"]"),
        true => format!("[\"{} m\", \"{x} m\"]", -y),
    };
    // Rayleigh damping counts modes that sway along x, so it is given by its coefficients here.
    format!(
        r#"{HEAD}across = {{ kind = "sine", amplitude = "1 m/s2", period = "0.6 s", duration = "6 s" }}
[[building]]
name = "A"
kind = "shear"
plan = {plan_a}
at = {at_a}
mass = ["100 t", "80 t"]
storey_height = "3 m"
stiffness = {}
eccentricity = {}
damping = {{ alpha = 0.4, beta = 0.002 }}
[[building]]
name = "B"
kind = "shear"
plan = {plan_b}
at = {at_b}
mass = ["120 t", "120 t"]
storey_height = "3 m"
stiffness = {}
eccentricity = {}
damping = {{ alpha = 0.4, beta = 0.002 }}
[[gap]]
between = ["A", "B"]
[analysis]
tolerance = 1e-6
"#,
        stiff(60.0, 25.0),
        off(1.0, -0.5),
        stiff(150.0, 90.0),
        off(0.0, 0.8),
    )
}

fn tree(text: &str) -> ModelTree {
    ModelTree::parse("pair.toml", text, Format::Toml, Path::new("")).expect("a model")
}

fn every(step: f64) -> Incidence {
    Incidence {
        step,
        ..Incidence::default()
    }
}

fn made(text: &str, wanted: &Incidence) -> Study {
    let (file, _) = incidence(tree(text), wanted).unwrap_or_else(|error| panic!("{error}"));
    Study::new(file).unwrap_or_else(|error| panic!("{error}"))
}

/// Runs a study, and reads columns of its table.
fn results<const N: usize>(study: &Study, folder: &Path, names: [&str; N]) -> [Vec<f64>; N] {
    let settings = RunSettings {
        jobs: Some(2),
        ..RunSettings::default()
    };
    let done = run(study, folder, &settings, &|| false, &|_| {}, &|_| {});
    let done = done.unwrap_or_else(|error| panic!("{error}"));
    assert!(done.complete && done.failed == 0);
    let table = read_columns(study, folder, &names).unwrap_or_else(|error| panic!("{error}"));
    names.map(|name| {
        let values = table.column(name).iter();
        values.map(|value| value.unwrap_or(f64::NAN)).collect()
    })
}

fn assert_near(a: f64, b: f64, scale: f64, tolerance: f64, what: &str) {
    assert!(
        (a - b).abs() <= tolerance * scale,
        "{what}: {a} against {b}"
    );
}

/// Without eccentricity and with one component, peaks along x go with |cos φ|, peaks across with |sin φ|: the building is
/// linear and both directions are apart.
#[test]
fn peaks_of_a_symmetric_building_are_cosines_of_the_angle() {
    let folder = tempfile::tempdir().expect("a folder");
    let study = made(&format!("{HEAD}{ALONE}"), &every(15.0));
    assert_eq!(study.design.cases, 24);
    let [angle, along, across, torque] = results(
        &study,
        folder.path(),
        [
            "angle_rad",
            "A.base_shear_peak_n",
            "A.base_shear_across_peak_n",
            "A.base_torque_peak_n_m",
        ],
    );
    let (most_x, most_y) = (along[0], across[6]);
    assert!(most_x > 1e5 && most_y > 1e5);
    for (case, angle) in angle.iter().enumerate() {
        assert_near(*angle, PI / 12.0 * case as f64, 1.0, 1e-12, "angle");
        let what = format!("at {angle}");
        assert_near(along[case], most_x * angle.cos().abs(), most_x, 1e-9, &what);
        assert_near(
            across[case],
            most_y * angle.sin().abs(),
            most_y,
            1e-9,
            &what,
        );
        assert!(torque[case] < 1e-6 * most_x, "no torque {what}");
    }
}

/// A motion that comes from the other side is the same with the other sign, so peaks without contact repeat after half a
/// circle; and a site that is turned with its motion keeps every number, with contact as well.
#[test]
fn turning_the_site_turns_the_rose() {
    let folder = tempfile::tempdir().expect("a folder");
    let names = [
        "peak_force_n",
        "impact_count",
        "A.corner_displacement_peak_m",
        "B.base_torque_peak_n_m",
        "A.base_torque_peak_without_contact_n_m",
        "A-B.closing_without_contact_m",
    ];
    let [original, turned] = [false, true].map(|turned| {
        let study = made(&pair(turned), &every(30.0));
        results(&study, &folder.path().join(turned.to_string()), names)
    });
    let greatest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    assert!(
        original[1].iter().any(|impacts| *impacts > 0.0),
        "there is contact"
    );
    for (quantity, name) in names.iter().enumerate() {
        let scale = greatest(&original[quantity]);
        for case in 0..12 {
            let (here, there) = (original[quantity][case], turned[quantity][(case + 3) % 12]);
            assert_near(here, there, scale, 2e-6, &format!("{name}, case {case}"));
        }
    }
    let torque = &original[4];
    for case in 0..6 {
        let (here, there) = (torque[case], torque[case + 6]);
        assert_near(here, there, greatest(torque), 1e-9, "half a circle on");
    }
}

#[test]
fn the_page_has_roses_and_the_worst_angles() {
    let folder = tempfile::tempdir().expect("a folder");
    let study = made(&pair(false), &every(45.0));
    let [force] = results(&study, folder.path(), ["peak_force_n"]);
    finish(&study, folder.path(), false).unwrap_or_else(|error| panic!("{error}"));
    let read = |name: &str| {
        let text = std::fs::read_to_string(folder.path().join(name));
        text.unwrap_or_else(|error| panic!("{name}: {error}"))
    };
    let page = read("report.html");
    for part in [
        "Over the angle of incidence",
        "Greatest contact force",
        "Gap needed",
        "Greatest base torque",
        "without contact",
    ] {
        assert!(page.contains(part), "{part}");
    }
    assert_eq!(page.matches("study-rose\"").count(), 10);
    // Closed curves, all around.
    assert!(page.contains("Z\" style"));
    let table = read("worst_angles.csv");
    let line = table.lines().find(|line| line.starts_with("peak_force_n,"));
    let cells: Vec<&str> = line.expect("the force").split(',').collect();
    let worst = force.iter().copied().fold(0.0, f64::max);
    assert_eq!(cells[2].parse(), Ok(worst));
    let case: usize = cells[4].parse().expect("a case");
    assert_eq!(force[case], worst);
    let angle: f64 = cells[3].parse().expect("an angle");
    assert_near(angle, PI / 4.0 * case as f64, 1.0, 1e-12, "worst angle");
}

#[test]
fn quantities_of_roses_may_be_chosen() {
    let wanted = Incidence {
        quantities: vec!["B.floor1.rotation_max_rad".into()],
        to: 90.0,
        step: 45.0,
        ..Incidence::default()
    };
    let folder = tempfile::tempdir().expect("a folder");
    let study = made(&pair(false), &wanted);
    assert_eq!(study.design.cases, 3);
    let _ = results(&study, folder.path(), ["angle_rad"]);
    finish(&study, folder.path(), false).unwrap_or_else(|error| panic!("{error}"));
    let page = std::fs::read_to_string(folder.path().join("report.html")).expect("a page");
    assert_eq!(page.matches("study-rose\"").count(), 1);
    assert!(page.contains("Rotation max [mrad]"));
    // A quarter is no full circle.
    assert!(!page.contains("Z\" style"));

    let unknown = Incidence {
        quantities: vec!["A.rotation".into()],
        ..wanted
    };
    let (file, _) = incidence(tree(&pair(false)), &unknown).expect("a file");
    let error = Study::new(file)
        .map(|_| ())
        .expect_err("no such column")
        .to_string();
    assert!(
        error.contains("there is no column \"A.rotation\""),
        "{error}"
    );
    assert!(error.contains("A.rotation_peak_rad"), "{error}");
}

#[test]
fn ranges_and_models_that_make_no_study_are_refused() {
    let range = |from: f64, to: f64, step: f64| {
        let wanted = Incidence {
            from,
            to,
            step,
            quantities: Vec::new(),
        };
        wanted.angles()
    };
    assert_eq!(range(-30.0, 30.0, 20.0), Ok(vec![-30.0, -10.0, 10.0, 30.0]));
    assert_eq!(range(0.0, 1.0, 0.3), Ok(vec![0.0, 0.3, 0.6, 0.9]));
    assert_eq!(
        range(10.0, 370.0, 90.0),
        Ok(vec![10.0, 100.0, 190.0, 280.0])
    );
    // A step that does not divide the circle keeps its last angle.
    assert_eq!(range(0.0, 360.0, 100.0), Ok(vec![0.0, 100.0, 200.0, 300.0]));
    for (from, to, step) in [
        (0.0, 360.0, 0.0),
        (0.0, 360.0, -5.0),
        (0.0, 361.0, 5.0),
        (90.0, 90.0, 5.0),
        (0.0, 360.0, 1e-3),
        (f64::NAN, 360.0, 5.0),
    ] {
        assert!(range(from, to, step).is_err(), "{from} to {to} by {step}");
    }
    let plane = r#"
[motion]
record = "el-centro-1940-ns"
[[building]]
name = "A"
kind = "shear"
mass = ["40 t"]
stiffness = ["20 MN/m"]
storey_height = "3 m"
"#;
    let error = incidence(tree(plane), &Incidence::default()).map(|_| ());
    let error = error.expect_err("no plan").to_string();
    assert!(error.contains("have no plan"), "{error}");
}

#[test]
fn a_rose_needs_an_angle_that_varies() {
    let text = r#"
base = "paper"
rose = ["peak_force_n"]
[[vary]]
path = "gap[0].width"
values = ["20 mm", "40 mm"]
"#;
    let error = jostle_io::StudyFile::parse("s.toml", text, Format::Toml, Path::new(""), None);
    let error = error.map(|_| ()).expect_err("no angle").to_string();
    assert!(
        error.contains("rose") && error.contains("motion.angle"),
        "{error}"
    );
}
