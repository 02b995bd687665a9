//! The modes at which Rayleigh damping has its ratio.

use jostle::System;
use jostle_testkit::files::{refusal, sound};

/// α and β of the only building, and the ratio of critical damping that each of its lateral modes has.
fn damped(text: &str) -> ((f64, f64), Vec<f64>) {
    let system = System::assemble(&sound(text).model).expect("sound");
    let building = &system.buildings[0];
    let ratios = building
        .lateral_modes()
        .map(|mode| building.damping_ratio(mode));
    let equations = &building.equations;
    ((equations.alpha, equations.beta), ratios.collect())
}

fn near(got: (f64, f64), expected: (f64, f64), tolerance: f64) {
    let off = |got: f64, expected: f64| (got - expected).abs() / expected.abs();
    assert!(
        off(got.0, expected.0) < tolerance && off(got.1, expected.1) < tolerance,
        "{got:?} for {expected:?}"
    );
}

/// Two masses, the lower storey a hundred times softer: the second mode carries less than 1 % of the mass, yet damping needs it, or all
/// higher modes would hardly be damped. Frequencies in closed form.
#[test]
fn a_soft_storey_is_damped_in_its_second_mode_too() {
    let text = |damping: &str| {
        format!(
            "[[building]]\nname = \"A\"\nkind = \"shear\"\nmass = [\"100 t\", \"100 t\"]\nstiffness = [\"10 MN/m\", \"1 GN/m\"]\nstorey_height = \"3 m\"\n{damping}"
        )
    };
    let (soft, stiff, mass): (f64, f64, f64) = (10e6, 1e9, 1e5);
    let (half, product) = (
        (soft + 2.0 * stiff) / (2.0 * mass),
        soft * stiff / mass.powi(2),
    );
    let root = (half * half - product).sqrt();
    let [low, high] = [product / (half + root), half + root].map(f64::sqrt);
    let expected = (
        2.0 * 0.05 * low * high / (low + high),
        2.0 * 0.05 / (low + high),
    );
    let (usual, lateral) = damped(&text(""));
    assert_eq!(lateral.len(), 1, "one mode carries 1 % of the mass");
    near(usual, expected, 1e-10);
    let (named, _) = damped(&text("damping = { ratio = 0.05, modes = [1, 2] }"));
    near(named, expected, 1e-10);
    let refused = refusal(&text("damping = { ratio = 0.05, modes = [1, 3] }"));
    assert!(refused.contains("mode 3 does not exist"), "{refused}");
    let (one, _) = damped(&text("damping = { ratio = 0.05, modes = [1] }"));
    assert_eq!(
        one.1, 0.0,
        "named alone, the first mode means in proportion to mass"
    );
}

/// A frame of columns and beams: bays of 6 m along x and of 4 m along y, or the other way round.
fn space_frame(turned: bool, damping: &str) -> String {
    let (long, short) = (r#"["0 m", "6 m", "12 m"]"#, r#"["0 m", "4 m"]"#);
    let (columns, turned_columns) = (r#"["600 mm", "400 mm"]"#, r#"["400 mm", "600 mm"]"#);
    let (x, y, size) = match turned {
        true => (short, long, turned_columns),
        false => (long, short, columns),
    };
    format!(
        "[[building]]\nname = \"A\"\nkind = \"space-frame\"\nstoreys = 4\nstorey_height = \"3.2 m\"\nlines_x = {x}\nlines_y = {y}\nmass = \"90 t\"\nconcrete = \"C30\"\ncolumn = {{ size = {size} }}\nbeam_x = {{ width = \"300 mm\", depth = \"500 mm\" }}\nbeam_y = {{ width = \"300 mm\", depth = \"500 mm\" }}\n{damping}"
    )
}

/// The same of storeys with a plan.
fn storeys(turned: bool, damping: &str) -> String {
    let (stiffness, plan) = match turned {
        true => (
            r#"{ x = "340 MN/m", y = "60 MN/m", torsion = "9 GN.m/rad" }"#,
            r#"["12 m", "20 m"]"#,
        ),
        false => (
            r#"{ x = "60 MN/m", y = "340 MN/m", torsion = "9 GN.m/rad" }"#,
            r#"["20 m", "12 m"]"#,
        ),
    };
    format!(
        "[[building]]\nname = \"A\"\nkind = \"shear\"\nplan = {plan}\nmass = [\"250 t\", \"250 t\", \"200 t\", \"200 t\"]\nstiffness = {stiffness}\nstorey_height = \"3 m\"\n{damping}"
    )
}

/// Modes along y are those along x of the same building turned by a right angle.
#[test]
fn damping_along_y_is_that_along_x_of_the_turned_building() {
    for kind in [space_frame, storeys] {
        let (across, _) = damped(&kind(false, "damping = { ratio = 0.04, along = \"y\" }"));
        let (turned, _) = damped(&kind(true, "damping = { ratio = 0.04 }"));
        near(across, turned, 1e-9);
        let (along, _) = damped(&kind(false, "damping = { ratio = 0.04, along = \"x\" }"));
        assert!(
            (along.0 / across.0 - 1.0).abs() > 0.05,
            "the directions differ: {along:?}"
        );
    }
}

/// A soft lowest storey under a plan, where one mode each way has nearly all of the mass.
fn soft_storeys(turned: bool, damping: &str) -> String {
    let text = storeys(turned, damping);
    let start = text.find("{ x = ").expect("a stiffness");
    let end = start + text[start..].find('}').expect("its end") + 1;
    let soft = &text[start..end];
    let stiff = soft.replace(" MN/m", " GN/m").replace(" GN.m", "00 GN.m");
    text.replace(soft, &format!("[{soft}, {stiff}, {stiff}, {stiff}]"))
}

/// Above a soft storey modes of sway count across as they do along.
#[test]
fn a_soft_storey_is_damped_across_as_along() {
    let (across, lateral) = damped(&soft_storeys(
        false,
        "damping = { ratio = 0.04, along = \"y\" }",
    ));
    let (turned, _) = damped(&soft_storeys(true, "damping = { ratio = 0.04 }"));
    assert_eq!(
        lateral.len(),
        2,
        "one mode each way carries 1 % of the mass"
    );
    near(across, turned, 1e-9);
}

/// Both ways: no mode between the lowest first and the highest third has more than the ratio, and these two have it.
#[test]
fn damping_of_both_ways_bounds_the_ratio_of_all_modes_between() {
    for kind in [space_frame, storeys] {
        let (_, along) = damped(&kind(false, "damping = { ratio = 0.04 }"));
        let worst = along.iter().take(6).copied().fold(0.0, f64::max);
        assert!(worst > 0.041, "along x only, some mode has more: {along:?}");
        let (both, ratios) = damped(&kind(false, "damping = { ratio = 0.04, along = \"both\" }"));
        let worst = ratios.iter().take(6).copied().fold(0.0, f64::max);
        assert!(worst < 0.04 * (1.0 + 1e-9), "{ratios:?}");
        assert!((ratios[0] - 0.04).abs() < 1e-9, "{ratios:?}");
        let (turned, _) = damped(&kind(true, "damping = { ratio = 0.04, along = \"both\" }"));
        near(both, turned, 1e-9);
    }
}

#[test]
fn a_direction_of_damping_needs_a_plan() {
    let plane = "[[building]]\nname = \"A\"\nkind = \"shear\"\nmass = [\"100 t\"]\nstiffness = [\"10 MN/m\"]\nstorey_height = \"3 m\"\n";
    let refused = refusal(&format!(
        "{plane}damping = {{ ratio = 0.05, along = \"y\" }}"
    ));
    assert!(
        refused.contains("damping.along: is for buildings with a plan"),
        "{refused}"
    );
    let refused = refusal(&format!(
        "{plane}damping = {{ alpha = 0.3, along = \"x\" }}"
    ));
    assert!(
        refused.contains("mixes ratio, modes and along"),
        "{refused}"
    );
}
