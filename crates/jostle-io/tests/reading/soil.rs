//! Foundations on soil in model files: what is read, and what is refused with its line and a remedy.

use jostle::{BearingStrength, GroundSprings, MassDamping, Soil, SoilCoupling, Uplift};
use jostle_testkit::files::read;

const TWO: &str = r#"[soil]
shear_wave_velocity = "200 m/s"
density = "1.8 t/m3"
poisson_ratio = 0.33
[[building]]
name = "A"
kind = "shear"
mass = ["40 t", "40 t"]
stiffness = "60 MN/m"
storey_height = "3 m"
foundation = { length = "12 m", width = "10 m", mass = "120 t" }
[[building]]
name = "B"
kind = "shear"
mass = ["40 t", "40 t"]
stiffness = "90 MN/m"
storey_height = "3 m"
foundation = { length = "12 m", width = "10 m", mass = "120 t", embedment = "1 m", rotary_inertia = "1500 t.m2" }
[[gap]]
between = ["A", "B"]
width = "30 mm"
law = "linear"
stiffness = "500 MN/m"
"#;

#[test]
fn soil_and_foundations_are_read() {
    let model = read(TWO).expect("a sound model").model;
    let [a, b] = [0, 1].map(|index| model.buildings[index].base.foundation.expect("one"));
    assert_eq!(
        [a.length, a.width, a.mass, a.embedment],
        [12.0, 10.0, 120e3, 0.0]
    );
    assert_eq!(a.rotary_inertia, 120e3 * 144.0 / 12.0);
    assert_eq!([b.embedment, b.rotary_inertia], [1.0, 1.5e6]);
    let soil = model.soil.expect("soil");
    let ground = soil.half_space.expect("a half-space");
    assert_eq!(
        [
            ground.shear_wave_velocity,
            ground.density,
            ground.poisson_ratio,
            ground.damping
        ],
        [200.0, 1800.0, 0.33, 0.0]
    );
    assert_eq!(soil.coupling, SoilCoupling::None);
}

#[test]
fn matrices_replace_the_half_space() {
    let matrices = "[soil]\ncoupling = { stiffness = [[2e9, 0, -1e9, 0], [0, 9e10, 0, 2e10], [-1e9, 0, 2e9, 0], [0, 2e10, 0, 9e10]], damping = [[5e7, 0, 0, 0], [0, 6e7, 0, 0], [0, 0, 5e7, 0], [0, 0, 0, 6e7]] }\n";
    let rest = TWO.split_once("[[building]]").expect("buildings").1;
    let text = format!("{matrices}[[building]]{rest}");
    let soil = read(&text).expect("a sound model").model.soil;
    let Some(Soil {
        half_space: None,
        coupling: SoilCoupling::Given { stiffness, .. },
    }) = soil
    else {
        panic!("matrices alone: {soil:?}");
    };
    assert_eq!(stiffness[0], [2e9, 0.0, -1e9, 0.0]);
}

/// What is replaced by what, the path at fault, and a part of the message.
#[test]
fn faults_name_field_and_remedy() {
    for (old, new, path, part) in [
        (
            "poisson_ratio = 0.33",
            "poisson_ratio = 0.5",
            "soil.poisson_ratio",
            "less than 0.5",
        ),
        (
            "poisson_ratio = 0.33",
            "",
            "soil.poisson_ratio",
            "poisson_ratio = 0.33",
        ),
        (
            "density = \"1.8 t/m3\"",
            "density = \"1.8 m\"",
            "soil.density",
            "a density",
        ),
        (
            "0.33\n",
            "0.33\ncoupling = \"dynamic\"\n",
            "soil.coupling",
            "static",
        ),
        (
            "0.33\n",
            "0.33\ncoupling = \"static\"\n",
            "building[1].foundation.embedment",
            "must be 0",
        ),
        (
            "0.33\n",
            "0.33\ncoupling = { stiffness = [[1]], damping = [[1]] }\n",
            "soil.shear_wave_velocity",
            "no effect",
        ),
        (
            "width = \"10 m\", mass = \"120 t\" }",
            "mass = \"120 t\" }",
            "building[0].foundation.width",
            "is missing",
        ),
        (
            "mass = \"120 t\" }",
            "mass = \"120 t\" }\nbase = { horizontal_stiffness = 1e9 }",
            "building[0].base",
            "combined with foundation",
        ),
        (
            "mass = \"120 t\" }",
            "mass = \"120 t\" }\nisolation = { kind = \"linear\", mat_mass = 1e5, stiffness = 1e7 }",
            "building[0].isolation",
            "combined with foundation",
        ),
        (
            "mass = \"120 t\" }",
            "mass = \"0 t\" }",
            "building[0].foundation.mass",
            "greater than zero",
        ),
    ] {
        let text = TWO.replacen(old, new, 1);
        let error = read(&text).expect_err(path);
        let found = error.faults.iter().find(|fault| fault.path == path);
        let found = found.unwrap_or_else(|| panic!("{path}: {error}"));
        let said = format!("{found:?}");
        assert!(said.contains(part), "{path}: {said}");
    }
    let without = TWO.replacen(
        "[soil]\nshear_wave_velocity = \"200 m/s\"\ndensity = \"1.8 t/m3\"\npoisson_ratio = 0.33\n",
        "",
        1,
    );
    let error = read(&without).expect_err("no soil");
    assert!(error.to_string().contains("needs [soil]"), "{error}");
}

/// A stick on a footing that lifts off.
const LIFTS: &str = r#"[[building]]
name = "A"
kind = "frame"
storeys = 1
storey_height = "9 m"
spans = []
column = { EI = "600 MN.m2", EA = "6 GN" }
beam = { EI = "1 MN.m2" }
floor_mass = "120 t"
density = 0
axial = "flexible"
gravity = true
damping = { alpha = 0.2, relative_to = "ground" }
foundation = { length = "3.6 m", width = "2 m", mass = "40 t", uplift = true, springs = 2, vertical_stiffness = "300 MN/m", vertical_damping = "2 MN.s/m" }
"#;

#[test]
fn footings_that_lift_off_are_read() {
    let model = read(LIFTS).expect("a sound model").model;
    let ground = GroundSprings {
        vertical_stiffness: 300e6,
        vertical_damping: 2e6,
        sway: None,
    };
    let uplift = Uplift {
        ground: Some(ground),
        ..Uplift::with_springs(2)
    };
    let building = &model.buildings[0];
    assert_eq!(building.base.foundation.expect("one").uplift, Some(uplift));
    assert_eq!(building.mass_damping, MassDamping::Ground);
    assert!(building.base.lifts() && building.may_yield());
    let more = "springs = 7, ends = 2.5, sway_stiffness = \"200 MN/m\", sway_damping = \"1 MN.s/m\", bearing_strength = \"300 kPa\", bearing_hardening = 0.1";
    let model = read(&LIFTS.replacen("springs = 2", more, 1))
        .expect("sound")
        .model;
    let found = model.buildings[0].base.foundation.expect("one").uplift;
    let due = Uplift {
        springs: 7,
        springs_across: None,
        ends: Some(2.5),
        ground: Some(GroundSprings {
            sway: Some([2e8, 1e6]),
            ..ground
        }),
        bearing: Some(BearingStrength {
            strength: 3e5,
            hardening: 0.1,
        }),
    };
    assert_eq!(found, Some(due));
    // On the soil of the model, nothing is guessed but what it gives.
    let on_soil = TWO.replace(
        "mass = \"120 t\" }",
        "mass = \"120 t\", uplift = true, springs = 9 }\ngravity = true",
    );
    let model = read(&on_soil).expect("sound").model;
    let found = model.buildings[0].base.foundation.expect("one").uplift;
    assert_eq!(found, Some(Uplift::with_springs(9)));
    assert!(
        model.buildings[1]
            .base
            .foundation
            .expect("one")
            .uplift
            .is_none()
    );
    let feet = LIFTS.replace("damping = { alpha = 0.2, relative_to = \"ground\" }\n", "");
    let feet = feet.split_once("foundation").expect("it has one").0;
    let feet = format!("{feet}base = {{ vertical_stiffness = \"300 MN/m\", uplift = true }}\n");
    assert!(read(&feet).expect("sound").model.buildings[0].base.uplift);
}

/// What is replaced by what, the path at fault, and a part of the message.
#[test]
fn faults_of_uplift_name_field_and_remedy() {
    for (old, new, path, part) in [
        (
            "gravity = true",
            "",
            "building[0].gravity",
            "no weight holds it down",
        ),
        (
            "springs = 2, ",
            "",
            "building[0].foundation.springs",
            "add springs = 11",
        ),
        (
            "springs = 2",
            "springs = 1",
            "building[0].foundation.springs",
            "between 2 and",
        ),
        (
            "uplift = true, ",
            "",
            "building[0].foundation.springs",
            "add uplift = true",
        ),
        (
            "vertical_stiffness = \"300 MN/m\", ",
            "",
            "building[0].foundation.vertical_damping",
            "add vertical_stiffness",
        ),
        (
            "vertical_stiffness = \"300 MN/m\", vertical_damping = \"2 MN.s/m\"",
            "ends = 2",
            "building[0].foundation",
            "add vertical_stiffness, or [soil]",
        ),
        (
            "springs = 2",
            "springs = 2, bearing_hardening = 0.1",
            "building[0].foundation.bearing_hardening",
            "add bearing_strength",
        ),
        (
            "\"ground\"",
            "\"floor\"",
            "building[0].damping.relative_to",
            "foundation",
        ),
    ] {
        let text = LIFTS.replacen(old, new, 1);
        let error = read(&text).expect_err(path);
        let found = error.faults.iter().find(|fault| fault.path == path);
        let found = found.unwrap_or_else(|| panic!("{path}: {error}"));
        let said = format!("{found:?}");
        assert!(said.contains(part), "{said}");
    }
}
