//! Ground that differs, in model files.

use jostle_io::{Input, InputError};
use jostle_testkit::files;

const TOWERS: &str = r#"
[[building]]
name = "A"
kind = "shear"
mass = ["40 t", "40 t"]
stiffness = "30 MN/m"
A_KEYS
[[building]]
name = "B"
kind = "shear"
mass = ["40 t", "40 t"]
stiffness = "30 MN/m"
B_KEYS
[[gap]]
between = ["A", "B"]
width = "20 mm"
"#;

fn read(motion: &str, a: &str, b: &str, rest: &str) -> Result<Input, InputError> {
    let towers = TOWERS.replace("A_KEYS", a).replace("B_KEYS", b);
    let text = format!("[motion]\n{motion}\n{towers}\n{rest}");
    files::read(&text)
}

const EL_CENTRO: &str = "record = \"el-centro-1940-ns\"";

/// The message of a file that is refused, on reading or when its motion is resolved.
fn refused(motion: &str, a: &str, b: &str, rest: &str) -> String {
    let error = match read(motion, a, b, rest) {
        Err(error) => error,
        Ok(input) => match input.ground_motion() {
            Err(error) => return error.to_string(),
            Ok(_) => panic!("not refused: {motion}, {a}, {b}, {rest}"),
        },
    };
    error.to_string()
}

/// A sine of its own needs no duration, and acts to the end of the common motion, as does a share of a common sine.
#[test]
fn sines_of_single_buildings_last_as_long_as_the_motion() {
    let keys = "motion = { kind = \"sine\", amplitude = \"2 m/s2\", period = \"0.2 s\" }";
    let drifting = format!("{EL_CENTRO}\nbaseline = \"as-recorded\"");
    let input = read(&drifting, keys, "", "").expect("sound");
    let motion = input.ground_motion().expect("a motion");
    let common = motion.duration;
    for t in [0.05, 1.05, 10.05, common - 0.15] {
        let expected = 2.0 * (10.0 * std::f64::consts::PI * t).sin();
        let found = motion.under(0).at(t).acceleration[0];
        assert!((found - expected).abs() < 1e-9, "{t}: {found}, {expected}");
    }
    let sine = "kind = \"sine\"\namplitude = \"2 m/s2\"\nperiod = \"0.2 s\"";
    let long = format!("{sine}\nduration = \"30 s\"");
    let input = read(&long, "motion = { scale = 0.5 }", "", "").expect("sound");
    let motion = input.ground_motion().expect("a motion");
    let late = motion.under(0).at(25.05).acceleration[0];
    assert!((late - 1.0).abs() < 1e-9, "{late}");
    let unlimited = refused(sine, "", "", "");
    assert!(unlimited.contains("how long the sine lasts"), "{unlimited}");
}

#[test]
fn arrivals_follow_from_positions_and_velocity() {
    let passing = format!("{EL_CENTRO}\napparent_velocity = \"600 m/s\"");
    let input = read(&passing, "position = \"12 m\"", "position = \"48 m\"", "").expect("sound");
    let motion = input.ground_motion().expect("a motion");
    assert!((motion.under(0).arrival() - 0.02).abs() < 1e-15);
    assert!((motion.under(1).arrival() - 0.08).abs() < 1e-15);
    assert_eq!(motion.corner_step(), Some(0.02));
    let input = read(EL_CENTRO, "", "motion = { arrival = \"30 ms\" }", "").expect("sound");
    let motion = input.ground_motion().expect("a motion");
    assert_eq!([0, 1].map(|b| motion.under(b).arrival()), [0.0, 0.03]);
    assert_eq!(motion.corner_step(), Some(0.01));
    // Nothing differs.
    let input = read(EL_CENTRO, "", "motion = { arrival = 0 }", "").expect("sound");
    assert!(input.ground_motion().expect("a motion").grounds.is_none());
}

#[test]
fn own_motions_have_their_own_scale_or_that_of_all() {
    let scaled = format!("{EL_CENTRO}\npga = \"0.1 g\"");
    let keys = "motion = { record = \"el-centro-1940-ns\", reverse = true }";
    let input = read(&scaled, "", keys, "").expect("sound");
    let motion = input.ground_motion().expect("a motion");
    let scale = motion.scale;
    let under = &motion.grounds.as_ref().expect("grounds").own[1];
    assert_eq!(under.motion.as_ref().expect("its own").scale, -scale);
    let input = read(&scaled, "", "motion = { scale = 0.5 }", "").expect("sound");
    let motion = input.ground_motion().expect("a motion");
    let under = &motion.grounds.as_ref().expect("grounds").own[1];
    assert_eq!(under.motion.as_ref().expect("its own").scale, 0.5 * scale);
    let upwards = format!("{scaled}\nvertical = {{ scale = 0.67 }}");
    let motion = read(&upwards, "", "", "").expect("sound").ground_motion();
    let motion = motion.expect("a motion");
    let vertical = motion.grounds.expect("grounds").own[0].vertical.clone();
    assert!((vertical.expect("vertical").scale - 0.67 * scale).abs() < 1e-15);
}

#[test]
fn coherent_motions_repeat_and_differ_by_their_seed() {
    let make = |seed: u32| {
        let motion = format!(
            "{EL_CENTRO}\ncoherency = {{ alpha = 0.1, shear_wave_velocity = \"300 m/s\", seed = {seed} }}"
        );
        let input = read(&motion, "position = 0", "position = \"40 m\"", "").expect("sound");
        input.ground_motion().expect("a motion")
    };
    assert_eq!(make(1), make(1));
    assert_ne!(make(1), make(2));
    let grounds = make(1).grounds.expect("grounds").own;
    assert!(grounds[0].motion.is_none() && grounds[1].motion.is_some());
}

#[test]
fn walls_stand_on_the_ground_that_they_face() {
    let wall = "[[wall]]\nname = \"moat\"\n[[gap]]\nbetween = [\"B\", \"moat\"]\nwidth = \"1 m\"\n";
    let late = "motion = { arrival = \"30 ms\" }";
    let input = read(EL_CENTRO, "", late, wall).expect("sound");
    let motion = input.ground_motion().expect("a motion");
    assert!(motion.moves_alike(1, 2) && !motion.moves_alike(0, 2));
}

#[test]
fn drifting_records_need_a_baseline() {
    let folder = std::env::temp_dir().join(format!("jostle-grounds-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let rows = |drift: f64| -> String {
        let row = |i: u32| {
            let t = 0.01 * f64::from(i);
            format!("{t:.2} {:.6}\n", 2.0 * (6.0 * t).sin() + drift)
        };
        (0..500).map(row).collect()
    };
    std::fs::write(folder.join("one.txt"), rows(0.0)).expect("a file");
    std::fs::write(folder.join("two.txt"), rows(0.05)).expect("a file");
    let file = |name: &str| {
        format!(
            "record = '{}'\nunit = \"m/s2\"",
            folder.join(name).display()
        )
    };
    let keys = format!("[building.motion]\n{}", file("two.txt"));
    let text = refused(&file("one.txt"), "", &keys, "");
    assert!(
        text.contains("drift apart") && text.contains("baseline"),
        "{text}"
    );
    for baseline in ["as-recorded", "linear", "quadratic"] {
        let motion = format!("{}\nbaseline = \"{baseline}\"", file("one.txt"));
        let input = read(&motion, "", &keys, "").expect("sound");
        let motion = input.ground_motion().expect("a motion");
        let ends = [0, 1].map(|b| motion.under(b).at(4.99).velocity[0]);
        let apart = (ends[0] - ends[1]).abs();
        assert_eq!(apart < 1e-3, baseline != "as-recorded", "{ends:?}");
    }
    std::fs::remove_dir_all(&folder).expect("it is there");
}

#[test]
fn mistakes_name_their_place_and_the_remedy() {
    let passing = format!("{EL_CENTRO}\napparent_velocity = \"600 m/s\"");
    let coherent = format!(
        "{EL_CENTRO}\ncoherency = {{ alpha = 0.1, shear_wave_velocity = \"300 m/s\", seed = 1 }}"
    );
    let wall = "[[wall]]\nname = \"moat\"\n[[gap]]\nbetween = [\"A\", \"moat\"]\nwidth = 1\n[[gap]]\nbetween = [\"moat\", \"B\"]\nwidth = 1\n";
    for (motion, a, b, rest, words) in [
        (
            EL_CENTRO,
            "",
            "motion = { arrival = \"-30 ms\" }",
            "",
            "must not be negative",
        ),
        (
            &passing,
            "position = 0",
            "position = 5\nmotion = { arrival = 1 }",
            "",
            "cannot be combined with position",
        ),
        (&passing, "position = 0", "", "", "position"),
        (
            &passing,
            "position = 0",
            "position = \"-5 m\"",
            "",
            "would arrive before it begins",
        ),
        (
            EL_CENTRO,
            "position = 0",
            "position = 5",
            "",
            "has no use without apparent_velocity",
        ),
        (
            EL_CENTRO,
            "",
            "motion = { duration = 5 }",
            "",
            "belongs under [motion] only",
        ),
        (
            EL_CENTRO,
            "",
            "motion = { record = \"nowhere\" }",
            "",
            "there is no record \"nowhere\"",
        ),
        (
            EL_CENTRO,
            "",
            "motion = { record = [\"a\", \"b\"] }",
            "",
            "must be one record here",
        ),
        (
            EL_CENTRO,
            "",
            "motion = { unit = \"g\" }",
            "",
            "does not go with the record of [motion]",
        ),
        (
            &coherent,
            "position = 0",
            "position = 5\nmotion = { record = \"el-centro-1940-ns\" }",
            "",
            "cannot be combined with coherency",
        ),
        (
            EL_CENTRO,
            "",
            "motion = { arrival = 1 }",
            wall,
            "whose grounds differ",
        ),
        (
            "record = \"el-centro-1940-ns\"\nbaseline = \"cubic\"",
            "",
            "",
            "",
            "\"cubic\" is not known",
        ),
        (
            "record = \"el-centro-1940-ns\"\ncoherency = { alpha = -1, shear_wave_velocity = 300, seed = 1 }",
            "",
            "",
            "",
            "must not be negative",
        ),
        (
            "kind = \"sine\"\namplitude = 1\nperiod = 1\nduration = 5\ncoherency = { alpha = 1, shear_wave_velocity = 300, seed = 1 }",
            "position = 0",
            "position = 5",
            "",
            "coherency needs a record",
        ),
    ] {
        let text = refused(motion, a, b, rest);
        assert!(text.contains(words), "{words}: {text}");
        assert!(text.contains("model.toml:"), "{text}");
    }
}

/// Two towers with plans, the second 10 m to the right and 4 m behind.
const IN_PLAN: &str = r#"
[[building]]
name = "A"
kind = "shear"
storeys = 2
mass = "40 t"
stiffness = "30 MN/m"
plan = ["8 m", "6 m"]
at = ["0 m", "0 m"]
A_KEYS
[[building]]
name = "B"
kind = "shear"
storeys = 2
mass = "40 t"
stiffness = "30 MN/m"
plan = ["8 m", "6 m"]
at = ["10 m", "4 m"]
B_KEYS
"#;

fn read_in_plan(motion: &str, b: &str) -> Result<Input, InputError> {
    let towers = IN_PLAN.replace("A_KEYS", "").replace("B_KEYS", b);
    let text = format!("[motion]\n{EL_CENTRO}\n{motion}\n{towers}");
    files::read(&text)
}

#[test]
fn waves_travel_at_an_angle_through_plans() {
    let arrivals = |motion: &str, b: &str| {
        let input = read_in_plan(motion, b).expect("sound");
        let motion = input.ground_motion().expect("a motion");
        [0, 1].map(|building| motion.under(building).arrival())
    };
    let passing =
        |angle: f64| format!("apparent_velocity = \"500 m/s\"\nwave_angle = \"{angle} deg\"");
    for angle in [0.0_f64, 30.0, 90.0] {
        let (sin, cos) = angle.to_radians().sin_cos();
        let expected = (10.0 * cos + 4.0 * sin) / 500.0;
        let [first, second] = arrivals(&passing(angle), "");
        assert!(first == 0.0 && (second - expected).abs() < 1e-12, "{angle}");
    }
    // From the other side the second is reached first.
    let [first, second] = arrivals(&passing(180.0), "");
    assert!((first - 0.02).abs() < 1e-12 && second.abs() < 1e-12);
    // What a building says of itself comes first.
    let [_, second] = arrivals(&passing(0.0), "motion = { arrival = \"7 ms\" }");
    assert_eq!(second, 0.007);
    let said = refused(
        &format!("{EL_CENTRO}\n{}", passing(10.0)),
        "position = 0",
        "position = 5",
        "",
    );
    assert!(
        said.contains("wave_angle") && said.contains("plan"),
        "{said}"
    );
}

/// The component across and the angle are those of all grounds; both components lose coherency.
#[test]
fn grounds_of_plans_have_both_components() {
    let two = "across = { record = \"el-centro-1940-ns\", scale = 0.5 }\nangle = \"25 deg\"";
    let input = read_in_plan(two, "motion = { arrival = \"20 ms\" }").expect("sound");
    let motion = input.ground_motion().expect("a motion");
    let t = 3.37;
    let (common, late) = (motion.components(t), motion.under(1).at(t + 0.02));
    for (a, b) in common.into_iter().zip(late.acceleration) {
        assert!((a - b).abs() < 1e-12);
    }
    // A record of its own along, the common one across.
    let input = read_in_plan(two, "motion = { scale = 2.0 }").expect("sound");
    let motion = input.ground_motion().expect("a motion");
    let acceleration = motion.under(1).at(t).acceleration;
    let (sin, cos) = 25.0_f64.to_radians().sin_cos();
    let across = motion.across().expect("a component across").acceleration(t);
    let along = motion.acceleration(t);
    let expected = [
        2.0 * along * cos - across * sin,
        2.0 * along * sin + across * cos,
    ];
    for (a, b) in expected.into_iter().zip(acceleration) {
        assert!((a - b).abs() < 1e-12, "{acceleration:?}");
    }
    let loses = "coherency = { alpha = 0.1, shear_wave_velocity = \"200 m/s\", seed = 1 }";
    let input = read_in_plan(&format!("{two}\n{loses}"), "").expect("sound");
    let motion = input.ground_motion().expect("a motion");
    assert_eq!(motion.under(0).at(t).acceleration, common);
    // In the directions of both components.
    let turned = |[x, y, _]: [f64; 3]| [x * cos + y * sin, y * cos - x * sin];
    let (here, there) = (turned(common), turned(motion.under(1).at(t).acceleration));
    for (a, b) in here.into_iter().zip(there) {
        assert!((a - b).abs() > 1e-4, "{here:?}, {there:?}");
    }
}

/// Drift is that along the record, in any direction in plan: a share of the same motion drifts as it does.
#[test]
fn drift_does_not_depend_on_the_angle() {
    let folder = std::env::temp_dir().join(format!("jostle-drift-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let row = |i: u32| {
        let t = 0.01 * f64::from(i);
        format!("{t:.2} {:.6}\n", 2.0 * (6.0 * t).sin() + 0.05)
    };
    let record = folder.join("drifts.txt");
    std::fs::write(&record, (0..500).map(row).collect::<String>()).expect("a file");
    let towers = IN_PLAN.replace("A_KEYS", "");
    let resolved = |keys: &str| {
        let record = record.display();
        let motion = format!("record = '{record}'\nunit = \"m/s2\"\nangle = \"90 deg\"");
        let text = format!("[motion]\n{motion}\n{}", towers.replace("B_KEYS", keys));
        let input = files::read(&text);
        input.expect("sound").ground_motion()
    };
    let same = resolved("motion = { scale = 1.0, arrival = \"10 ms\" }");
    assert!(same.is_ok(), "{same:?}");
    let twice = resolved("motion = { scale = 2.0 }");
    let said = twice.expect_err("it drifts").to_string();
    assert!(said.contains("baseline"), "{said}");
    std::fs::remove_dir_all(&folder).expect("it is there");
}
