//! Bearings with several sliding surfaces, and rubber of high damping.

use jostle::{Isolator, SlidingSurface};
use jostle_testkit::files::{refusal, sound};

fn model(isolation: &str) -> String {
    format!(
        r#"
motion = {{ record = "el-centro-1940-ns" }}
[[building]]
name = "A"
kind = "shear"
mass = ["100 t", "100 t"]
stiffness = ["100 MN/m", "100 MN/m"]
storey_height = 3
isolation = {{ mat_mass = "100 t", {isolation} }}
"#
    )
}

fn isolator(text: &str) -> Isolator {
    let input = sound(&model(text));
    let isolation = input.model.buildings[0].base.isolation;
    isolation.expect("it is isolated").isolator
}

const TRIPLE: &str = r#"kind = "triple-friction-pendulum", radius = ["2.1 m", "0.3 m", "0.3 m", "2.1 m"], friction = [0.04, 0.015, 0.015, 0.08], capacity = ["300 mm", "50 mm", "50 mm", "300 mm"]"#;

/// One surface for each entry, in its order.
#[test]
fn surfaces_are_read_in_order() {
    let Isolator::TriplePendulum {
        surfaces,
        slip_displacement,
    } = isolator(TRIPLE)
    else {
        panic!("it is one");
    };
    assert_eq!(slip_displacement, 1e-3);
    let surface = |radius, friction, capacity| SlidingSurface {
        radius,
        friction,
        capacity,
    };
    let due = [
        surface(2.1, 0.04, 0.3),
        surface(0.3, 0.015, 0.05),
        surface(0.3, 0.015, 0.05),
        surface(2.1, 0.08, 0.3),
    ];
    assert_eq!(surfaces, due);
    let double = isolator(
        r#"kind = "double-friction-pendulum", radius = [2, 2.5], friction = [0.03, 0.06], capacity = [0.3, 0.2], slip_displacement = "0.5 mm""#,
    );
    let surfaces = [surface(2.0, 0.03, 0.3), surface(2.5, 0.06, 0.2)];
    assert_eq!(
        double,
        Isolator::DoublePendulum {
            surfaces,
            slip_displacement: 5e-4
        }
    );
}

/// The bearings have the secant and the damping of the test again.
#[test]
fn rubber_of_high_damping_has_the_loops_of_its_test() {
    let rubber = isolator(
        r#"kind = "high-damping-rubber", stiffness = "6 MN/m", damping_ratio = 0.15, displacement = "200 mm", yield_displacement = "15 mm""#,
    );
    let [stiffness, ratio] = rubber.equivalent(3e6, 0.2).expect("it yields");
    assert!((stiffness / 6e6 - 1.0).abs() < 1e-12 && (ratio / 0.15 - 1.0).abs() < 1e-12);
    assert_eq!(rubber.name(), "high-damping-rubber");
}

#[test]
fn mistakes_are_explained() {
    let changed = |from: &str, to: &str| TRIPLE.replace(from, to);
    for (text, expected) in [
        (
            changed("[0.04, 0.015, 0.015, 0.08]", "[0.04, 0.015, 0.08]"),
            "must be a list of 4 for a triple-friction-pendulum",
        ),
        (
            changed("[0.04, 0.015, 0.015, 0.08]", "0.04"),
            "write friction = [0.04, 0.015, 0.015, 0.08]",
        ),
        (
            changed("0.015, 0.015", "0.015, 0.02"),
            "must be equal on both inner surfaces",
        ),
        (
            changed("[0.04,", "[0.09,"),
            "greater on the lower bowl and not less on the upper one",
        ),
        (
            changed("\"2.1 m\", \"0.3 m\"", "\"0.2 m\", \"0.3 m\""),
            "must be greater on each bowl than on the inner surface beside it",
        ),
        (
            changed("\"300 mm\"]", "\"0 mm\"]"),
            "isolation.capacity[3]",
        ),
        (
            changed(", capacity = [\"300 mm\", \"50 mm\", \"50 mm\", \"300 mm\"]", ""),
            "add capacity = [\"300 mm\", \"50 mm\", \"50 mm\", \"300 mm\"]",
        ),
        (
            "kind = \"friction-pendulum\", radius = 2, friction = 0.05, capacity = [0.3]".into(),
            "it belongs to double-friction-pendulum and triple-friction-pendulum",
        ),
        (
            "kind = \"high-damping-rubber\", stiffness = 6e6, damping_ratio = 0.6, displacement = 0.2, yield_displacement = 0.015".into(),
            "less than 0.589, that of a loop without hardening",
        ),
        (
            "kind = \"high-damping-rubber\", stiffness = 6e6, damping_ratio = 0.1, displacement = 0.2, yield_displacement = 0.3".into(),
            "must be less than displacement (0.2 m)",
        ),
        (
            "kind = \"high-damping-rubber\", stiffness = 6e6, displacement = 0.2, yield_displacement = 0.02".into(),
            "add damping_ratio = 0.15",
        ),
    ] {
        let shown = refusal(&model(&text));
        assert!(shown.contains(expected), "{text}\n{shown}");
    }
    let in_plan = model(TRIPLE).replace(
        "storey_height = 3",
        "storey_height = 3\nplan = [20, 12]\npolar_mass = [1e7, 1e7]",
    );
    let in_plan = in_plan.replace(
        "stiffness = [\"100 MN/m\", \"100 MN/m\"]",
        "stiffness = [{ x = 1e8, y = 1e8, torsion = 1e9 }, { x = 1e8, y = 1e8, torsion = 1e9 }]",
    );
    assert!(
        jostle_testkit::files::read(&in_plan).is_ok(),
        "it slides in plan"
    );
}
