//! Foundations on soil in model files: what is read, and what is refused with its line and a remedy.

use jostle::{Soil, SoilCoupling};
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
            "beside foundation",
        ),
        (
            "mass = \"120 t\" }",
            "mass = \"120 t\" }\nisolation = { kind = \"linear\", mat_mass = 1e5, stiffness = 1e7 }",
            "building[0].isolation",
            "beside foundation",
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
